//! Shares of the rows of files by construct of the language, by failure, and by recovery from a failure:
//! the rows' lessons, and their gaps.
//!
//! The faults of single rows are found by [`crate::lint`].

use std::collections::BTreeMap;

use motet_planner::dialogue::Kind;
use motet_stdlib::lang::{ASKING, primitives};
use motet_syntax::ast::{Block, Do, End, EndKind, Policy, Reaction, Step, StepKind};
use motet_syntax::{FileId, Source};
use rustc_hash::FxHashSet;

use crate::format::{Read, Target, UPDATE};

/// Part of the language that a policy uses or does not use.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Construct {
    /// Steps written as `if`.
    Condition,
    /// `repeat` or `each`.
    Loop,
    /// Steps written as `monitor`.
    Monitor,
    /// Steps written as `catch`.
    Handler,
    /// Steps written as `finally`.
    Cleanup,
    /// `within`, of a block or of a call.
    Deadline,
    /// Steps written as `wait`.
    Wait,
    /// Steps written as `parallel`.
    Parallel,
    /// Steps written as `keep`.
    Keep,
    /// A name for a result or a value.
    Binding,
    /// Steps written as `say`.
    Say,
    /// `ask` or `choose`.
    Ask,
    /// Steps written as `ground`.
    Ground,
    /// Steps written as `replan`.
    Replan,
    /// Steps written as `cannot`.
    Cannot,
}

impl Construct {
    /// All constructs, in the order of reports.
    pub const ALL: [Self; 15] = [
        Self::Condition,
        Self::Loop,
        Self::Monitor,
        Self::Handler,
        Self::Cleanup,
        Self::Deadline,
        Self::Wait,
        Self::Parallel,
        Self::Keep,
        Self::Binding,
        Self::Say,
        Self::Ask,
        Self::Ground,
        Self::Replan,
        Self::Cannot,
    ];

    /// Name in reports.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Condition => "condition",
            Self::Loop => "loop",
            Self::Monitor => "monitor",
            Self::Handler => "handler",
            Self::Cleanup => "cleanup",
            Self::Deadline => "deadline",
            Self::Wait => "wait",
            Self::Parallel => "parallel",
            Self::Keep => "keep",
            Self::Binding => "binding",
            Self::Say => "say",
            Self::Ask => "ask",
            Self::Ground => "ground",
            Self::Replan => "replan",
            Self::Cannot => "cannot",
        }
    }
}

/// Kinds of failure, in the order of reports.
const FAILURES: [Kind; 5] =
    [Kind::NotFound, Kind::NotReachable, Kind::AmbiguousReference, Kind::AmbiguousTask, Kind::ActionFailed];

/// Least share of the rows that have a policy, for each construct; also of all rows, for changed requests.
pub const LEAST_CONSTRUCT: f64 = 0.03;
/// Least share of the rows, for each kind of failure.
pub const LEAST_FAILURE: f64 = 0.08;

/// Counts over the rows of files.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Counts {
    rows: usize,
    policies: usize,
    with: BTreeMap<Subject, usize>,
}

/// Subject of a share.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Subject {
    /// Rows whose policy has the construct.
    Construct(Construct),
    /// Rows of a conversation in which the failure happens.
    Failure(Kind),
    /// Rows that come right after the failure.
    Recovery(Kind),
    /// Rows in which a person has changed the request while it was carried out.
    Update,
}

impl Subject {
    /// Group in reports: `construct`, `failure` or `recovery`.
    #[must_use]
    pub const fn group(self) -> &'static str {
        match self {
            Self::Construct(_) => "construct",
            Self::Failure(_) => "failure",
            Self::Recovery(_) => "recovery",
            Self::Update => "task",
        }
    }

    /// Name in its group.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Construct(construct) => construct.name(),
            Self::Failure(kind) | Self::Recovery(kind) => kind.name(),
            Self::Update => UPDATE,
        }
    }

    /// Least share, if there is one.
    #[must_use]
    pub const fn least(self) -> Option<f64> {
        match self {
            Self::Construct(_) | Self::Update => Some(LEAST_CONSTRUCT),
            Self::Failure(_) => Some(LEAST_FAILURE),
            Self::Recovery(_) => None,
        }
    }
}

/// Number of rows with a subject, of all rows that could have it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Share {
    pub subject: Subject,
    pub rows: usize,
    pub of: usize,
}

impl Share {
    /// The share, between 0 and 1; 0 of no rows.
    #[must_use]
    pub fn ratio(self) -> f64 {
        if self.of == 0 { 0.0 } else { self.rows as f64 / self.of as f64 }
    }

    /// True if the share is below its minimum. No rows are below no minimum.
    #[must_use]
    pub fn is_low(self) -> bool {
        self.of > 0 && self.subject.least().is_some_and(|least| self.ratio() < least)
    }
}

impl Counts {
    /// Counts a row. O(steps of its policy).
    pub fn add(&mut self, row: &Read) {
        self.rows += 1;
        if let Target::Policy(text) = &row.target {
            self.policies += 1;
            constructs(text).into_iter().for_each(|construct| self.count(Subject::Construct(construct)));
        }
        if row.task.as_deref() == Some(UPDATE) {
            self.count(Subject::Update);
        }
        let before = row.turn.checked_sub(1).and_then(|turn| row.failures.get(turn));
        for kind in FAILURES {
            if row.failures.iter().any(|name| name == kind.name()) {
                self.count(Subject::Failure(kind));
            }
            if before.is_some_and(|name| name == kind.name()) {
                self.count(Subject::Recovery(kind));
            }
        }
    }

    fn count(&mut self, subject: Subject) {
        *self.with.entry(subject).or_default() += 1;
    }

    /// The shares, in the order of reports. Constructs are counted in rows that have a policy, and have no
    /// shares where no row has one.
    #[must_use]
    pub fn shares(&self) -> Vec<Share> {
        let constructs = Construct::ALL.map(Subject::Construct).into_iter().filter(|_| self.policies > 0);
        let subjects = constructs
            .chain(FAILURES.map(Subject::Failure))
            .chain(FAILURES.map(Subject::Recovery))
            .chain([Subject::Update]);
        let share = |subject| Share {
            subject,
            rows: self.with.get(&subject).copied().unwrap_or_default(),
            of: if matches!(subject, Subject::Construct(_)) { self.policies } else { self.rows },
        };
        subjects.map(share).collect()
    }
}

/// Constructs of the policies of a document, in either syntax. O(steps).
pub(crate) fn constructs(text: &str) -> FxHashSet<Construct> {
    let parsed = motet_syntax::read(&Source::new("row", text), FileId(0));
    let mut used = FxHashSet::default();
    parsed.file.policies().for_each(|policy| of_policy(policy, &mut used));
    used
}

fn of_policy(policy: &Policy, used: &mut FxHashSet<Construct>) {
    if !policy.keeps.is_empty() {
        used.insert(Construct::Keep);
    }
    of_block(&policy.body, used);
    if let Some(cleanup) = &policy.cleanup {
        used.insert(Construct::Cleanup);
        of_block(cleanup, used);
    }
}

fn of_block(block: &Block, used: &mut FxHashSet<Construct>) {
    for step in &block.steps {
        of_step(step, used);
    }
}

fn of_step(step: &Step, used: &mut FxHashSet<Construct>) {
    match &step.kind {
        StepKind::Do(call) => of_call(call, used),
        StepKind::Let { .. } => {
            used.insert(Construct::Binding);
        }
        StepKind::Sequence { body, .. } => of_block(body, used),
        StepKind::If { then, otherwise, .. } => {
            used.insert(Construct::Condition);
            of_block(then, used);
            if let Some(otherwise) = otherwise {
                of_block(otherwise, used);
            }
        }
        StepKind::Wait { .. } | StepKind::Delay { .. } => {
            used.insert(Construct::Wait);
        }
        StepKind::Monitor { whens, body } => {
            used.insert(Construct::Monitor);
            for when in whens {
                of_reaction(&when.reaction, used);
            }
            of_block(body, used);
        }
        StepKind::Try { body, catches } => {
            of_block(body, used);
            for catch in catches {
                used.insert(Construct::Handler);
                of_block(&catch.body, used);
            }
        }
        StepKind::Repeat { body, .. } | StepKind::Each { body, .. } => {
            used.insert(Construct::Loop);
            of_block(body, used);
        }
        StepKind::Parallel { branches } => {
            used.insert(Construct::Parallel);
            for branch in branches {
                of_block(branch, used);
            }
        }
        StepKind::Keep { body, .. } => {
            used.insert(Construct::Keep);
            of_block(body, used);
        }
        StepKind::Within { body, .. } => {
            used.insert(Construct::Deadline);
            of_block(body, used);
        }
        StepKind::Finally { step, cleanup } => {
            used.insert(Construct::Cleanup);
            of_step(step, used);
            of_block(cleanup, used);
        }
        StepKind::End(end) => of_end(end, used),
    }
}

fn of_call(call: &Do, used: &mut FxHashSet<Construct>) {
    if call.bind.is_some() {
        used.insert(Construct::Binding);
    }
    if call.within.is_some() {
        used.insert(Construct::Deadline);
    }
    match call.call.name.text.as_str() {
        primitives::SAY => used.insert(Construct::Say),
        primitives::GROUND => used.insert(Construct::Ground),
        name if ASKING.contains(&name) => used.insert(Construct::Ask),
        _ => false,
    };
}

fn of_reaction(reaction: &Reaction, used: &mut FxHashSet<Construct>) {
    match reaction {
        Reaction::Resume { body, .. } => of_block(body, used),
        Reaction::End(end) => of_end(end, used),
        Reaction::Pause { .. } | Reaction::Restart { .. } => {}
    }
}

fn of_end(end: &End, used: &mut FxHashSet<Construct>) {
    match end.kind {
        EndKind::Replan => used.insert(Construct::Replan),
        EndKind::Cannot => used.insert(Construct::Cannot),
        EndKind::Done | EndKind::Fail => false,
    };
}

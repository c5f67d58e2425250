//! Drafts that follow a walk: from what was said to the steps of a policy that the checker has proved.

use motet_compiler::incremental::IncrementalChecker;
use motet_syntax::ast::{self, Policy, Step};
use motet_syntax::{Span, Syntax};

use super::arena::{Arenas, Event, Id};
use super::build::Builder;
use super::walk::Machine;

/// A draft that follows a walk.
#[derive(Clone, Debug, Default)]
pub(super) struct Follower {
    pub(super) draft: Option<IncrementalChecker>,
    /// The hash of what was said up to the end of what stands before the steps.
    head: u64,
    /// The same of each step.
    steps: Vec<u64>,
}

/// What a walk has said, for a follower to read.
pub(super) struct Told<'w> {
    pub(super) machine: &'w Machine,
    pub(super) arenas: &'w Arenas,
    pub(super) bytes: &'w [u8],
}

impl Told<'_> {
    pub(super) fn step(&self, events: &[Event]) -> Option<Step> {
        self.step_with(events, &[])
    }

    /// The same with any of some steps in its hole.
    pub(super) fn step_with(&self, events: &[Event], choice: &[Step]) -> Option<Step> {
        let Self { machine, arenas, bytes } = self;
        Builder { program: &machine.program, arenas, bytes, events, choice }.step()
    }

    /// Name, robot and goal of the policy, from what was said before its steps.
    fn head(&self, last: Id) -> Policy {
        let events = self.arenas.between(0, last);
        let Self { machine, arenas, bytes } = self;
        let mut text = String::new();
        let mut rest = events.as_slice();
        if let Some((Event::Name(start, len), behind)) = events.split_first() {
            let end = start.saturating_add(*len) as usize;
            text = String::from_utf8_lossy(bytes.get(*start as usize..end).unwrap_or_default()).into_owned();
            rest = behind;
        }
        let program = &machine.program;
        let named = |text: smol_str::SmolStr| ast::Name { text, span: Span::default() };
        let achieves = matches!(rest.first(), Some(Event::Open(_)))
            .then(|| Builder { program, arenas, bytes, events: rest, choice: &[] }.condition());
        let robot = Some(&program.signatures.robot).filter(|robot| !robot.is_empty());
        Policy {
            doc: ast::Doc::default(),
            name: named(text.into()),
            params: Vec::new(),
            robot: robot.cloned().map(named),
            achieves,
            body: ast::Block::default(),
            span: Span::default(),
        }
    }
}

impl Follower {
    /// Follows the walk to the end of the last whole step of the body before `last`, which is the event that ended it.
    pub(super) fn follow(&mut self, told: &Told<'_>, last: Id) -> Option<&mut IncrementalChecker> {
        let hash = told.arenas.hash(last);
        let latest = self.steps.last().copied().unwrap_or(self.head);
        if self.draft.is_some() && latest == hash {
            return self.draft.as_mut();
        }
        let session = &told.machine.session;
        let mut ends = Vec::new();
        let mut at = last;
        while at > 0 {
            ends.push(at);
            at = told
                .arenas
                .said(at)
                .and_then(|said| told.arenas.said(said.below))
                .map_or(0, |said| said.before);
        }
        ends.reverse();
        let (head, steps) = ends.split_first()?;
        if self.draft.is_none() || self.head != told.arenas.hash(*head) {
            let (draft, _) = IncrementalChecker::new(session, &told.head(*head), Syntax::Json);
            self.draft = Some(draft);
            self.head = told.arenas.hash(*head);
            self.steps.clear();
        }
        let draft = self.draft.as_mut()?;
        let known = steps.iter().zip(&self.steps).take_while(|(id, known)| told.arenas.hash(**id) == **known);
        let known = known.count();
        draft.truncate(known);
        self.steps.truncate(known);
        let mut before = known.checked_sub(1).and_then(|last| steps.get(last)).copied().unwrap_or(*head);
        for id in steps.iter().skip(known) {
            let events = told.arenas.between(before, *id);
            let step = told.step(&events)?;
            if !draft.push(session, &step) {
                return None;
            }
            self.steps.push(told.arenas.hash(*id));
            before = *id;
        }
        Some(draft)
    }
}

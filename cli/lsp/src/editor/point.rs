//! Program points of a document: the state of the check before a step, or where a step is to be written.

use motet_compiler::Session;
use motet_compiler::incremental::{IncrementalChecker, KnownFact, PROGRAM_POINT};
use motet_project::DOCUMENT;
use motet_syntax::ast::{Block, Item, Name, Policy, Reaction, Step, StepKind};
use motet_syntax::{Parsed, Source, Span};

use super::names::blocks;

/// Name of the sequence that marks a place in a text; no author has it.
const MARK: &str = "motet_program_point";

/// State of a check at a program point of a document.
#[derive(Debug)]
pub(crate) struct PointState {
    /// Session with the declarations of the document.
    pub(crate) session: Session,
    pub(crate) checker: IncrementalChecker,
}

impl PointState {
    /// State before the step with a span; `None` if the document has no such step in a policy.
    pub(crate) fn before(session: &Session, parsed: &Parsed, step: Span) -> Option<Self> {
        let policy = parsed.file.policies().find(|policy| policy.span.contains(step))?;
        let mut policy = policy.clone();
        let insert = |block: &mut Block| {
            let index = block.steps.iter().position(|other| other.span == step)?;
            block.steps.insert(index, marker(Span { end: step.start, ..step }));
            block.gaps.iter_mut().filter(|gap| **gap as usize >= index).for_each(|gap| *gap += 1);
            Some(())
        };
        in_blocks(&mut policy, &mut { insert })?;
        Self::of(session, parsed, &policy)
    }

    /// State where a text of a document is to be replaced by a step, at `start..end`.
    pub(crate) fn at(session: &Session, source: &Source, start: usize, end: usize) -> Option<Self> {
        let (before, after) = (source.text.get(..start)?, source.text.get(end..)?);
        let text = format!("{before} sequence {MARK} {{ }} {after}");
        let parsed = motet_syntax::read(&Source::new(source.name.clone(), text), DOCUMENT);
        let is_mark =
            |step: &Step| matches!(&step.kind, StepKind::Sequence { name, .. } if name.text == MARK);
        for policy in parsed.file.policies() {
            let mut policy = policy.clone();
            let mark = |block: &mut Block| {
                let step = block.steps.iter_mut().find(|step| is_mark(step))?;
                step.span = PROGRAM_POINT;
                Some(())
            };
            if in_blocks(&mut policy, &mut { mark }).is_some() {
                return Self::of(session, &parsed, &policy);
            }
        }
        None
    }

    fn of(session: &Session, parsed: &Parsed, policy: &Policy) -> Option<Self> {
        let session = session.with_declarations(parsed);
        let checker = IncrementalChecker::at_point(&session, policy, parsed.syntax)?;
        Some(Self { session, checker })
    }

    /// Facts at the point.
    pub(crate) fn facts(&mut self) -> Vec<KnownFact> {
        self.checker.known_facts(&self.session)
    }
}

fn marker(span: Span) -> Step {
    let name = Name { text: MARK.into(), span };
    Step { kind: StepKind::Sequence { name, body: Block::default() }, span: PROGRAM_POINT }
}

/// Visits the blocks of a policy, outer ones first, until one answers.
fn in_blocks(policy: &mut Policy, visit: &mut impl FnMut(&mut Block) -> Option<()>) -> Option<()> {
    let cleanup = policy.cleanup.as_mut();
    std::iter::once(&mut policy.body).chain(cleanup).find_map(|block| in_block(block, visit))
}

fn in_block(block: &mut Block, visit: &mut impl FnMut(&mut Block) -> Option<()>) -> Option<()> {
    if let Some(()) = visit(block) {
        return Some(());
    }
    block.steps.iter_mut().find_map(|step| in_step(step, visit))
}

fn in_step(step: &mut Step, visit: &mut impl FnMut(&mut Block) -> Option<()>) -> Option<()> {
    match &mut step.kind {
        StepKind::Do(_)
        | StepKind::Let { .. }
        | StepKind::Wait { .. }
        | StepKind::Delay { .. }
        | StepKind::End(_) => None,
        StepKind::Sequence { body, .. }
        | StepKind::Repeat { body, .. }
        | StepKind::Each { body, .. }
        | StepKind::Keep { body, .. }
        | StepKind::Within { body, .. } => in_block(body, visit),
        StepKind::If { then, otherwise, .. } => {
            std::iter::once(then).chain(otherwise).find_map(|block| in_block(block, visit))
        }
        StepKind::Monitor { whens, body } => {
            let reactions = whens.iter_mut().filter_map(|when| match &mut when.reaction {
                Reaction::Resume { body, .. } => Some(body),
                Reaction::Pause { .. } | Reaction::Restart { .. } | Reaction::End(_) => None,
            });
            reactions.chain([body]).find_map(|block| in_block(block, visit))
        }
        StepKind::Try { body, catches } => {
            let handlers = catches.iter_mut().map(|catch| &mut catch.body);
            std::iter::once(body).chain(handlers).find_map(|block| in_block(block, visit))
        }
        StepKind::Parallel { branches } => branches.iter_mut().find_map(|block| in_block(block, visit)),
        StepKind::Finally { step, cleanup } => in_step(step, visit).or_else(|| in_block(cleanup, visit)),
    }
}

/// Innermost step that contains an offset; its end counts as well.
pub(crate) fn step_at(parsed: &Parsed, offset: usize) -> Option<&Step> {
    let within = |span: Span| span.range().start <= offset && offset <= span.range().end;
    let mut policies = parsed.file.items.iter().filter_map(Item::policy);
    let policy = policies.rfind(|policy| within(policy.span))?;
    let mut found = None;
    let mut open: Vec<&Block> = std::iter::once(&policy.body).chain(&policy.cleanup).collect();
    while let Some(block) = open.pop() {
        if let Some(step) = block.steps.iter().rfind(|step| within(step.span)) {
            found = Some(step);
            open = blocks(step);
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use motet_compiler::incremental::{FactCause, KnownTruth};
    use motet_project::{DOCUMENT, Discard, Project};
    use motet_syntax::Source;

    use super::{PointState, step_at};

    const TEXT: &str = "policy fetch for hsr {
    go(kitchen_table)
    pick(mug_1)
    if visible(user) {
        go(user)
        handover(mug_1, user)
    }
    say(\"done\")
}";

    fn facts(before: &str) -> Vec<String> {
        let project = Project::builder().robot("hsr").scene("kitchen").without_motions();
        let project = project.open().unwrap().into_session(&mut Discard).unwrap();
        let source = Source::new("fetch.motet", TEXT);
        let parsed = motet_syntax::read(&source, DOCUMENT);
        let step = step_at(&parsed, TEXT.find(before).unwrap()).unwrap();
        let mut state = PointState::before(&project.session, &parsed, step.span).unwrap();
        let facts = state.facts().into_iter();
        let shown = facts.filter_map(|fact| match fact.cause {
            FactCause::Step { name, .. } => Some(format!("{} {:?} {name}", fact.text, fact.truth)),
            FactCause::Start | FactCause::Nothing => None,
        });
        shown.collect()
    }

    #[test]
    fn facts_name_the_steps_that_caused_them() {
        assert!(!facts("go(kitchen_table)").iter().any(|fact| fact.contains("holding")));
        let picked = facts("if visible");
        assert!(picked.contains(&"holding(mug_1) Holds pick(mug_1)".to_owned()), "{picked:?}");
        let inner = facts("go(user)");
        assert!(inner.contains(&"visible(user) Holds if".to_owned()), "{inner:?}");
        let after = facts("say(");
        let differs = format!("holding(mug_1) {:?}", KnownTruth::Differs);
        assert!(after.iter().any(|fact| fact.starts_with(&differs)), "{after:?}");
    }
}

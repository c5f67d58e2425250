//! Incremental proofs that follow the machine: events become steps, and the checker proves them one by one.

use motet_compiler::incremental::IncrementalChecker;
use motet_compiler::signature::{Signatures, Type};
use motet_syntax::ast::{self, Policy, Step};
use motet_syntax::{Span, Syntax};

use super::context::Context;
use super::event_log::{Arenas, Event, Id, meaning};
use super::step_builder::Builder;
use crate::automaton::Meaning;

/// An incremental proof that follows a machine. Steps that the log shares with the last call are kept.
#[derive(Clone, Debug, Default)]
pub(super) struct ProofCursor {
    pub(super) draft: Option<IncrementalChecker>,
    /// The hash of the log up to the first step.
    head: u64,
    /// The hash of the log up to the end of each proved step.
    steps: Vec<u64>,
}

/// The incremental proofs of a machine.
#[derive(Clone, Debug, Default)]
pub(crate) struct Oracle {
    pub(super) place: ProofCursor,
    /// Verifies whole steps.
    pub(super) verifier: ProofCursor,
    /// The hash of the log up to where `place` stands.
    pub(super) stands: Option<u64>,
    /// Number of whole calls that were asked about.
    pub(super) proofs: usize,
}

/// The log of a machine, to be read as syntax.
pub(super) struct Transcript<'w> {
    pub(super) context: &'w Context,
    pub(super) arenas: &'w Arenas,
    pub(super) bytes: &'w [u8],
}

impl Transcript<'_> {
    pub(super) fn step(&self, events: &[Event]) -> Option<Step> {
        self.step_with(events, &[])
    }

    /// As [`step`](Self::step), with a choice of steps in place of the hole.
    pub(super) fn step_with(&self, events: &[Event], choice: &[Step]) -> Option<Step> {
        let Self { context, arenas, bytes } = self;
        Builder { automaton: &context.automaton, arenas, bytes, events, choice, in_cleanup: false }.step()
    }

    /// The name, robot and goal of the policy, from the events before its steps.
    fn head(&self, last: Id) -> Policy {
        let events = self.arenas.between(0, last);
        let Self { context, arenas, bytes } = self;
        let mut text = String::new();
        let mut rest = events.as_slice();
        if let Some((Event::Name(start, len), behind)) = events.split_first() {
            let end = start.saturating_add(*len) as usize;
            text = String::from_utf8_lossy(bytes.get(*start as usize..end).unwrap_or_default()).into_owned();
            rest = behind;
        }
        let automaton = &context.automaton;
        let named = |text: smol_str::SmolStr| ast::Name { text, span: Span::default() };
        let mut result = None;
        if let Some((word, behind)) = rest.split_first()
            && let Some(Meaning::Named(ty)) = meaning(automaton, *word)
        {
            result = automaton.ty(ty).map(|ty| written(ty, &automaton.signatures));
            rest = behind;
        }
        let mut builder = Builder { automaton, arenas, bytes, events: rest, choice: &[], in_cleanup: false };
        let achieves = matches!(rest.first(), Some(Event::Open(_))).then(|| builder.condition());
        if achieves.is_none() {
            builder.next();
        }
        let robot = Some(&automaton.signatures.robot).filter(|robot| !robot.is_empty());
        Policy {
            doc: ast::Doc::default(),
            name: named(text.into()),
            params: Vec::new(),
            result,
            robot: robot.cloned().map(named),
            achieves,
            body: ast::Block::default(),
            keeps: builder.keeps(),
            cleanup: None,
            span: Span::default(),
        }
    }
}

/// A type as a policy writes it.
fn written(ty: &Type, signatures: &Signatures) -> ast::TypeExpr {
    match ty {
        Type::List(element) => ast::TypeExpr::List(Box::new(written(element, signatures)), Span::default()),
        ty => {
            let text = signatures.type_name(ty).into();
            ast::TypeExpr::Named(ast::Name { text, span: Span::default() })
        }
    }
}

impl ProofCursor {
    /// Advances the proof to the last whole step of the body; `last` is the event that ended it.
    pub(super) fn follow(
        &mut self,
        transcript: &Transcript<'_>,
        last: Id,
    ) -> Option<&mut IncrementalChecker> {
        let hash = transcript.arenas.hash(last);
        let latest = self.steps.last().copied().unwrap_or(self.head);
        if self.draft.is_some() && latest == hash {
            return self.draft.as_mut();
        }
        let session = &transcript.context.session;
        let mut ends = Vec::new();
        let mut at = last;
        while at > 0 {
            ends.push(at);
            at = transcript
                .arenas
                .entry(at)
                .and_then(|said| transcript.arenas.entry(said.below))
                .map_or(0, |said| said.before);
        }
        ends.reverse();
        let (head, steps) = ends.split_first()?;
        if self.draft.is_none() || self.head != transcript.arenas.hash(*head) {
            let (draft, _) = IncrementalChecker::new(session, &transcript.head(*head), Syntax::Json);
            self.draft = Some(draft);
            self.head = transcript.arenas.hash(*head);
            self.steps.clear();
        }
        let draft = self.draft.as_mut()?;
        let known =
            steps.iter().zip(&self.steps).take_while(|(id, known)| transcript.arenas.hash(**id) == **known);
        let known = known.count();
        draft.truncate(known);
        self.steps.truncate(known);
        let mut before = known.checked_sub(1).and_then(|last| steps.get(last)).copied().unwrap_or(*head);
        for id in steps.iter().skip(known) {
            let events = transcript.arenas.between(before, *id);
            let step = transcript.step(&events)?;
            if !draft.push(session, &step) {
                return None;
            }
            self.steps.push(transcript.arenas.hash(*id));
            before = *id;
        }
        Some(draft)
    }
}

//! The checker as the machine asks it: may this call stand here, is this step an error, may the policy be
//! done.
//!
//! Two incremental proofs follow the machine ([`Oracle`](super::proof_cursor::Oracle)). One stands where the
//! next step will stand and judges calls; the other verifies whole steps, closed for the time being.

use motet_compiler::Session;
use motet_compiler::incremental::{ArgumentValue, IncrementalChecker, LoopTest, is_used_up};
use motet_compiler::signature::Type;
use motet_syntax::ast::POSE;

use super::context::Question;
use super::event_log::{Event, Id, meaning, mix};
use super::machine::Machine;
use super::proof_cursor::Transcript;
use crate::automaton::Meaning;
use crate::grammar::{Constant, NodeKind};

/// Number of values tried for the next argument of a call that must be proved together with concurrent
/// steps; for each argument behind that, one value is tried. The values are those that nothing refutes
/// locally. An argument that is open here is open when its turn comes, so every call that is begun can be
/// completed.
pub(super) const MOST_SHARED: usize = 3;

/// Number of values that are tried before one proof asks if any of the others can succeed. It takes as long
/// as some of theirs.
const TRIED_ALONE: usize = 3;

/// An argument of a call that is tried.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum Argument {
    One(Event),
    /// A list of one value.
    List(Event),
}

/// The place of a call: the event before it and the scope.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CallSite {
    pub(crate) event: Id,
    pub(crate) scope: Id,
    /// The effects of the call may refute steps elsewhere.
    pub(crate) shared: bool,
    /// The call stands in a cleanup.
    pub(crate) cleans: bool,
    /// The number of values tried for the next argument, if `shared`.
    pub(crate) tries: usize,
}

impl CallSite {
    /// A pose may be written out there as an argument of a primitive. Beside concurrent steps, and in a
    /// policy, its numbers could refute something.
    pub(crate) fn takes_pose(&self, machine: &Machine, callable: u16) -> bool {
        let automaton = &machine.context.automaton;
        let made = automaton.callables.get(usize::from(callable));
        let poses = automaton.signatures.measure(POSE).is_none();
        poses && !self.shared && made.is_some_and(|made| made.primitive.is_some())
    }
}

impl Machine {
    /// Verifies the current step of the body with `more` appended to the log and everything closed.
    pub(crate) fn verify(&mut self, event: Id, more: &[Event]) -> bool {
        let key = self.key(Question::Verify, event, more.iter().copied());
        self.answer(key, |machine| {
            let (before, events) = machine.arenas.present(event, more);
            let transcript =
                Transcript { context: &machine.context, arenas: &machine.arenas, bytes: &machine.bytes };
            let step = transcript.step(&events);
            let draft = machine.oracle.verifier.follow(&transcript, before);
            match (draft, step) {
                (Some(draft), Some(step)) => draft.permits_step(&machine.context.session, &step),
                (Some(_), None) => true,
                (None, _) => false,
            }
        })
    }

    /// As [`verify`](Self::verify), skipping the proof if `more` is independent of everything that runs
    /// concurrently.
    pub(crate) fn verify_beside(&mut self, event: Id, more: &[Event]) -> bool {
        self.is_independent(event, more) || self.verify(event, more)
    }

    /// The proof at the place of the next step, behind `event`; `None` if it is wrong up to there, or if no
    /// effort is left for it.
    fn place(&mut self, event: Id) -> Option<(&mut IncrementalChecker, &Session)> {
        if is_used_up() {
            return None;
        }
        let (before, mut events) = self.arenas.present(event, &[]);
        let transcript = Transcript { context: &self.context, arenas: &self.arenas, bytes: &self.bytes };
        let hash = transcript.arenas.hash(event);
        if self.oracle.stands != Some(hash) {
            self.oracle.stands = None;
            let draft = self.oracle.place.follow(&transcript, before)?;
            let step = if events.is_empty() {
                None
            } else {
                events.push(Event::Hole);
                transcript.step(&events)
            };
            draft.go(&self.context.session, step.as_ref());
            if is_used_up() {
                return None;
            }
            self.oracle.stands = Some(hash);
        }
        Some((self.oracle.place.draft.as_mut()?, &self.context.session))
    }

    /// Evaluates a loop test, a fluent with arguments, at the end of the loop's body, which is behind
    /// `event`.
    pub(crate) fn test(&mut self, event: Id, fluent: u16, negated: bool, args: &[Event]) -> LoopTest {
        let values = args.iter().map(|event| match meaning(&self.context.automaton, *event) {
            Some(Meaning::Any) => Some(None),
            Some(meaning) => Some(Some(meaning.value())),
            None => None,
        });
        // A binding may stand for one of several entities.
        let Some(values) = values.collect::<Option<Vec<_>>>() else { return LoopTest::Open };
        let context = std::sync::Arc::clone(&self.context);
        let Some(name) =
            context.automaton.signatures.fluents.get(usize::from(fluent)).map(|fluent| &fluent.name)
        else {
            return LoopTest::Open;
        };
        self.place(event)
            .map_or(LoopTest::Open, |(draft, session)| draft.test(session, name, &values, negated))
    }

    /// Lets a loop iterate, as far as its own steps tell; its body ends behind `event`. The test is a
    /// fluent, whether it stands under `not`, and its arguments. Returns a number shared by tests that
    /// leave the same facts, or `None` if the next iteration is refuted.
    pub(crate) fn permits_round(&mut self, event: Id, test: Option<(u16, bool, &[Event])>) -> Option<u64> {
        let context = std::sync::Arc::clone(&self.context);
        let Some((fluent, negated, args)) = test else {
            return self.place(event).and_then(|(draft, session)| draft.permits_round(session, None));
        };
        let fluent = context.automaton.signatures.fluents.get(usize::from(fluent));
        let (Some(fluent), Some(_)) = (fluent, self.place(event)) else { return None };
        let site = CallSite { event, scope: 0, shared: false, cleans: false, tries: MOST_SHARED };
        let values = args.iter().map(|arg| match meaning(&context.automaton, *arg) {
            Some(Meaning::Any) => Some(None),
            _ => self.value_of(Argument::One(*arg), site).map(Some),
        });
        let values = values.collect::<Option<Vec<_>>>()?;
        let test = Some((fluent.name.as_str(), values.as_slice(), negated));
        self.place(event).and_then(|(draft, session)| draft.permits_round(session, test))
    }

    /// The policy may be done where the next step will stand.
    pub(crate) fn may_be_done(&mut self, event: Id) -> bool {
        let key = self.key(Question::Done, event, None);
        self.answer(key, |machine| {
            machine.place(event).is_some_and(|(draft, session)| draft.permits_done(session))
        })
    }

    /// The site of a call; `None` if a concurrent branch holds a resource that the callable needs.
    pub(crate) fn site_of(&mut self, callable: u16, site: CallSite) -> Option<CallSite> {
        let made = self.context.automaton.callables.get(usize::from(callable))?;
        // A step of a policy may be one that no cleanup may have.
        let is_policy = site.cleans && made.primitive.is_none();
        if !site.shared && !is_policy {
            return Some(site);
        }
        let uses = made.uses;
        if uses & self.resources_taken(site.event) != 0 {
            return None;
        }
        let call = [Event::Open(NodeKind::Do(callable)), Event::Close];
        Some(CallSite { shared: is_policy || !self.is_independent(site.event, &call), ..site })
    }

    /// Some arguments complete a call of the callable.
    pub(crate) fn can_be_called(&mut self, callable: u16, site: CallSite) -> bool {
        let Some(own) = self.site_of(callable, site) else { return false };
        if own.shared && self.taken.is_none() {
            let made = self.context.automaton.callables.get(usize::from(callable));
            self.probe_callables(site, made.is_some_and(|made| made.primitive.is_none()));
        }
        self.completes_call(callable, &mut Vec::new(), own)
    }

    /// Some arguments complete a call whose first arguments are given.
    pub(crate) fn completes_call(
        &mut self,
        callable: u16,
        given: &mut Vec<Argument>,
        site: CallSite,
    ) -> bool {
        let question = if site.shared { Question::SharedCall } else { Question::Call };
        let key = self.key(question, site.event, of_call(callable, given));
        let key = if site.shared { mix(key, site.tries as u64) } else { key };
        self.answer(key, |machine| machine.completes_anew(callable, given, site))
    }

    fn completes_anew(&mut self, callable: u16, given: &mut Vec<Argument>, site: CallSite) -> bool {
        let context = std::sync::Arc::clone(&self.context);
        let index = usize::from(callable);
        let (Some(made), Some(signature)) =
            (context.automaton.callables.get(index), context.automaton.signatures.callables.get(index))
        else {
            return false;
        };
        let Some(args) = self.permitted(callable, given, site) else { return false };
        let Some(options) = self.options(callable, given, site) else {
            let events: Vec<Event> = of_call(callable, given).collect();
            return !site.shared || self.verify(site.event, &events);
        };
        let proofs = self.oracle.proofs;
        for (tried, option) in options.into_iter().enumerate() {
            // If the first values fail in proofs, perhaps none can succeed: one proof tells.
            if tried == TRIED_ALONE
                && self.oracle.proofs > proofs
                && made.primitive.is_none()
                && !self.place(site.event).is_some_and(|(draft, session)| {
                    draft.permits_open_policy(session, (&signature.name, made.template.as_ref()), &args)
                })
            {
                return false;
            }
            given.push(option);
            let can = self.completes_call(callable, given, CallSite { tries: 1, ..site });
            given.pop();
            if can {
                return true;
            }
        }
        false
    }

    /// The arguments given so far as values of the checker; `None` if the call is refuted at its place.
    fn permitted(
        &mut self,
        callable: u16,
        given: &[Argument],
        site: CallSite,
    ) -> Option<Vec<Option<ArgumentValue>>> {
        let context = std::sync::Arc::clone(&self.context);
        let made = context.automaton.callables.get(usize::from(callable))?;
        let signature = context.automaton.signatures.callables.get(usize::from(callable))?;
        let mut args: Vec<Option<ArgumentValue>> = Vec::with_capacity(signature.params.len());
        for given in given {
            args.push(Some(self.value_of(*given, site)?));
        }
        args.resize_with(signature.params.len(), || None);
        let ask = |machine: &mut Self| {
            machine.oracle.proofs += usize::from(given.len() == signature.params.len());
            machine.place(site.event).is_some_and(|(draft, session)| match made.primitive {
                Some(primitive) => draft.permits_call(session, primitive, &args),
                None => draft.permits_policy(session, (&signature.name, made.template.as_ref()), &args),
            })
        };
        let permits = if site.shared {
            // Asked once when a value is picked and again when it is tried.
            let key = self.key(Question::Permitted, site.event, of_call(callable, given));
            self.answer(key, ask)
        } else {
            ask(self)
        };
        (permits || is_used_up()).then_some(args)
    }

    /// The first completion of a call that nothing refutes at its place: the best candidate for a proof
    /// with concurrent steps.
    pub(super) fn likely_call(
        &mut self,
        callable: u16,
        given: &mut Vec<Argument>,
        site: CallSite,
    ) -> Option<Vec<Event>> {
        self.permitted(callable, given, site)?;
        let Some(options) = self.options(callable, given, site) else {
            return Some(of_call(callable, given).collect());
        };
        options.into_iter().find_map(|option| {
            given.push(option);
            let call = self.likely_call(callable, given, CallSite { tries: 1, ..site });
            given.pop();
            call
        })
    }

    /// Bytes of the policy as text.
    pub(crate) fn spelling(&self, start: u32, len: u32) -> Option<&str> {
        let bytes = self.bytes.get(start as usize..start.saturating_add(len) as usize)?;
        std::str::from_utf8(bytes).ok()
    }

    /// A text, or [`Event::AnyText`] if it describes no entity and so is as good as any other.
    pub(crate) fn plain_text(&self, text: Event) -> Event {
        let Event::Text(start, len) = text else { return text };
        match self.spelling(start, len) {
            Some(written) if self.context.session.describes(written) => text,
            _ => Event::AnyText,
        }
    }

    /// The values to try for the next argument; `None` behind the last.
    fn options(&mut self, callable: u16, given: &mut Vec<Argument>, site: CallSite) -> Option<Vec<Argument>> {
        let index = usize::from(callable);
        let context = std::sync::Arc::clone(&self.context);
        let ty = &context.automaton.signatures.callables.get(index)?.params.get(given.len())?.ty;
        let options = self.values_of(index, given.len(), ty, site);
        if !site.shared {
            return Some(options);
        }
        // Bindings stand last in the list and are meant more often.
        let mut tried = Vec::with_capacity(site.tries);
        for option in options.into_iter().rev() {
            given.push(option);
            if self.permitted(callable, given, site).is_some() {
                tried.push(option);
            }
            given.pop();
            if tried.len() == site.tries {
                break;
            }
        }
        Some(tried)
    }

    /// Candidate values of an argument: every word, and one representative where no contract tells values
    /// apart.
    fn values_of(&self, callable: usize, place: usize, ty: &Type, site: CallSite) -> Vec<Argument> {
        let made = self.context.automaton.callables.get(callable);
        let word = made.and_then(|made| made.words.get(place).copied().flatten());
        let element = made.and_then(|made| made.elements.get(place).copied().flatten());
        let words = |op: Option<u32>| {
            op.map(|op| self.words_of(op, site.scope, Some((callable, place)))).unwrap_or_default()
        };
        match ty {
            Type::Text => vec![Argument::One(Event::AnyText)],
            Type::Bool => vec![Argument::One(Event::Constant(Constant::True))],
            Type::Int | Type::Number | Type::Quantity(_) => {
                let params = self.context.automaton.signatures.callables.get(callable);
                let range =
                    params.and_then(|signature| signature.params.get(place)).and_then(|param| param.range);
                let range = crate::subset::NumberRange::of(ty, range);
                range
                    .map(|range| Argument::One(Event::Number(range.least, range.decimals)))
                    .into_iter()
                    .collect()
            }
            Type::List(_) => {
                let whole = words(word).into_iter().map(Argument::One);
                whole.chain(words(element).into_iter().take(1).map(Argument::List)).collect()
            }
            Type::Entity(_) => {
                let first = self.firsts(ty, site.scope).into_iter();
                first.chain(words(word)).map(Argument::One).collect()
            }
            Type::Pose => {
                let callable = u16::try_from(callable).unwrap_or(u16::MAX);
                let pose = site.takes_pose(self, callable).then_some(Event::AnyText);
                pose.into_iter().chain(words(word)).map(Argument::One).collect()
            }
            Type::Enum(_) | Type::Failure => words(word).into_iter().map(Argument::One).collect(),
        }
    }

    /// A candidate as a value of the checker.
    fn value_of(&mut self, given: Argument, site: CallSite) -> Option<ArgumentValue> {
        let event = match given {
            Argument::List(_) => return Some(ArgumentValue::unknown()),
            Argument::One(event) => event,
        };
        Some(match event {
            Event::Word(..) => meaning(&self.context.automaton, event)?.value(),
            Event::Bound(id) | Event::First(id) => {
                let name = *self.arenas.name(id)?;
                let name = smol_str::SmolStr::new(self.spelling(name.start, name.len)?);
                let Some((draft, _)) = self.place(site.event) else {
                    return is_used_up().then(ArgumentValue::unknown);
                };
                let value = draft.binding(&name)?;
                if matches!(event, Event::First(_)) { value.first() } else { value }
            }
            Event::Text(start, len) => ArgumentValue::text(self.spelling(start, len)?),
            _ => ArgumentValue::unknown(),
        })
    }

    /// The call that is being written: its callable, the arguments so far, and the event before it.
    pub(crate) fn call_so_far(&self, event: Id) -> Option<(u16, Vec<Argument>, Id)> {
        let mut given = Vec::new();
        let mut log = self.arenas.back(event);
        while let Some(said) = log.next() {
            match said.event {
                Event::Open(NodeKind::Do(callable)) => {
                    given.reverse();
                    return Some((callable, given, said.below));
                }
                // The contents of a list decide nothing.
                Event::Close => {
                    log.find(|said| matches!(said.event, Event::Open(NodeKind::List | NodeKind::Pose)));
                    given.push(Argument::One(Event::AnyText));
                }
                event => given.push(Argument::One(event)),
            }
        }
        None
    }
}

/// The events of a call.
fn of_call(callable: u16, given: &[Argument]) -> impl Iterator<Item = Event> {
    let open = Event::Open(NodeKind::Do(callable));
    let args = given.iter().flat_map(|given| match given {
        Argument::One(event) => [Some(*event), None, None],
        Argument::List(event) => [Some(Event::Open(NodeKind::List)), Some(*event), Some(Event::Close)],
    });
    std::iter::once(open).chain(args.flatten()).chain([Event::Close])
}

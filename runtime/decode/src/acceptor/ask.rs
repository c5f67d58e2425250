//! What the checker says of a place of a walk. Two drafts follow the walk: one stands where the next step will stand and
//! is asked of calls, the other is asked whether steps that are closed for the time being are errors.

use motet_compiler::Session;
use motet_compiler::incremental::{Argument, IncrementalChecker, LoopTest};
use motet_compiler::signature::Type;

use super::arena::{Event, Id, mix};
use super::follow::{Follower, Told};
use super::memo::Question;
use super::walk::Walk;
use crate::program::{Kind, Meaning, Op, Plain, Program};

/// The drafts of a walk, and how far they are.
#[derive(Clone, Debug, Default)]
pub(crate) struct Asked {
    /// Asked of calls.
    place: Follower,
    /// Asked of whole steps.
    pub(super) judge: Follower,
    /// The hash of what was said up to where the first of them stands.
    stands: Option<u64>,
}

/// Where a call takes a proof of all that runs at once, so many values are tried of the argument behind those that are given, of
/// values that nothing refutes at the place; of those behind it one. What is open here is open when its turn comes, so what is
/// begun can still be completed.
pub(super) const MOST_SHARED: usize = 3;

/// An argument that is tried.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum Given {
    /// A value.
    One(Event),
    /// A list of this one value.
    List(Event),
}

/// Where a call is tried: the event before it, and what is bound there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spot {
    pub(crate) event: Id,
    pub(crate) scope: Id,
    /// Whether what the call does may refute what stands elsewhere.
    pub(crate) shared: bool,
    /// How many values of the next argument are tried where it may.
    pub(crate) tries: usize,
}

impl Walk {
    /// Whether the step of the body that is being written is no error, with `more` behind what was said and closed.
    pub(crate) fn verify(&mut self, event: Id, more: &[Event]) -> bool {
        let key = self.key(Question::Verify, event, more.iter().copied());
        self.answer(key, |walk| {
            let before = walk.arenas.said(event).map_or(0, |said| said.before);
            let mut events = walk.arenas.between(before, event);
            events.extend_from_slice(more);
            let told = Told { machine: &walk.machine, arenas: &walk.arenas, bytes: &walk.bytes };
            let step = told.step(&events);
            let draft = walk.asked.judge.follow(&told, before);
            match (draft, step) {
                (Some(draft), Some(step)) => draft.permits_step(&walk.machine.session, &step),
                (Some(_), None) => true,
                (None, _) => false,
            }
        })
    }

    /// Whether what stands beside the place behind `event` is no error either, with `more` at the place.
    pub(crate) fn verify_beside(&mut self, event: Id, more: &[Event]) -> bool {
        self.is_apart(event, more) || self.verify(event, more)
    }

    /// The draft where the next step will stand, behind `event`.
    fn place(&mut self, event: Id) -> Option<(&mut IncrementalChecker, &Session)> {
        let before = self.arenas.said(event).map_or(0, |said| said.before);
        let told = Told { machine: &self.machine, arenas: &self.arenas, bytes: &self.bytes };
        let hash = told.arenas.hash(event);
        if self.asked.stands != Some(hash) {
            self.asked.stands = None;
            let draft = self.asked.place.follow(&told, before)?;
            let mut events = told.arenas.between(before, event);
            let step = if events.is_empty() {
                None
            } else {
                events.push(Event::Hole);
                told.step(&events)
            };
            draft.go(&self.machine.session, step.as_ref());
            self.asked.stands = Some(hash);
        }
        Some((self.asked.place.draft.as_mut()?, &self.machine.session))
    }

    /// What a test with this fluent and these arguments tells at the end of a loop's body, which is behind `event`.
    pub(crate) fn test(&mut self, event: Id, fluent: u16, negated: bool, args: &[Event]) -> LoopTest {
        let values = args.iter().map(|event| match meaning(&self.machine.program, *event) {
            Some(Meaning::Any) => Some(None),
            Some(meaning) => Some(Some(meaning.value())),
            None => None,
        });
        // A name may be one of several entities.
        let Some(values) = values.collect::<Option<Vec<_>>>() else { return LoopTest::Open };
        let machine = std::sync::Arc::clone(&self.machine);
        let Some(name) =
            machine.program.signatures.fluents.get(usize::from(fluent)).map(|fluent| &fluent.name)
        else {
            return LoopTest::Open;
        };
        self.place(event)
            .map_or(LoopTest::Open, |(draft, session)| draft.test(session, name, &values, negated))
    }

    /// Whether the loop whose body ends behind `event` may come round, as far as its own steps tell. Its test is a fluent, whether
    /// it stands under `not`, and its arguments. Where it may, a number that tests share which leave the same facts.
    pub(crate) fn permits_round(&mut self, event: Id, test: Option<(u16, bool, &[Event])>) -> Option<u64> {
        let machine = std::sync::Arc::clone(&self.machine);
        let Some((fluent, negated, args)) = test else {
            return self.place(event).and_then(|(draft, session)| draft.permits_round(session, None));
        };
        let fluent = machine.program.signatures.fluents.get(usize::from(fluent));
        let (Some(fluent), Some(_)) = (fluent, self.place(event)) else { return None };
        let spot = Spot { event, scope: 0, shared: false, tries: MOST_SHARED };
        let values = args.iter().map(|arg| match meaning(&machine.program, *arg) {
            Some(Meaning::Any) => Some(None),
            _ => self.value_of(Given::One(*arg), spot).map(Some),
        });
        let values = values.collect::<Option<Vec<_>>>()?;
        let test = Some((fluent.name.as_str(), values.as_slice(), negated));
        self.place(event).and_then(|(draft, session)| draft.permits_round(session, test))
    }

    /// Whether the policy may be done where the next step will stand.
    pub(crate) fn may_be_done(&mut self, event: Id) -> bool {
        let key = self.key(Question::Done, event, None);
        self.answer(key, |walk| walk.place(event).is_some_and(|(draft, session)| draft.permits_done(session)))
    }

    /// Where a call can be tried; none where what runs at once uses what it uses.
    pub(crate) fn spot_of(&self, callable: u16, spot: Spot) -> Option<Spot> {
        let made = self.machine.program.callables.get(usize::from(callable))?;
        if !spot.shared {
            return Some(spot);
        }
        let is_free = made.uses & self.resources_taken(spot.event) == 0;
        let call = [Event::Open(Kind::Do(callable)), Event::Close];
        is_free.then(|| Spot { shared: !self.is_apart(spot.event, &call), ..spot })
    }

    /// Whether a callable can be called with some arguments.
    pub(crate) fn can_be_called(&mut self, callable: u16, spot: Spot) -> bool {
        let Some(own) = self.spot_of(callable, spot) else { return false };
        if own.shared {
            self.foresee_callables(spot);
        }
        self.completes_call(callable, &mut Vec::new(), own)
    }

    /// Whether a call can be completed from the arguments that are given.
    pub(crate) fn completes_call(&mut self, callable: u16, given: &mut Vec<Given>, spot: Spot) -> bool {
        let question = if spot.shared { Question::SharedCall } else { Question::Call };
        let key = self.key(question, spot.event, of_call(callable, given));
        let key = if spot.shared { mix(key, spot.tries as u64) } else { key };
        self.answer(key, |walk| walk.completes_anew(callable, given, spot))
    }

    fn completes_anew(&mut self, callable: u16, given: &mut Vec<Given>, spot: Spot) -> bool {
        let machine = std::sync::Arc::clone(&self.machine);
        let index = usize::from(callable);
        let (Some(made), Some(signature)) =
            (machine.program.callables.get(index), machine.program.signatures.callables.get(index))
        else {
            return false;
        };
        let Some(args) = self.permitted(callable, given, spot) else { return false };
        let Some(options) = self.options(callable, given, spot) else {
            let events: Vec<Event> = of_call(callable, given).collect();
            return !spot.shared || self.verify(spot.event, &events);
        };
        for (tried, option) in options.into_iter().enumerate() {
            // Where the first does not do, it may be that none does.
            if tried == 1
                && made.primitive.is_none()
                && !self.place(spot.event).is_some_and(|(draft, session)| {
                    draft.permits_open_policy(session, (&signature.name, made.template.as_ref()), &args)
                })
            {
                return false;
            }
            given.push(option);
            let can = self.completes_call(callable, given, Spot { tries: 1, ..spot });
            given.pop();
            if can {
                return true;
            }
        }
        false
    }

    /// The arguments of a call, as many as are given, where nothing refutes it at its place.
    fn permitted(&mut self, callable: u16, given: &[Given], spot: Spot) -> Option<Vec<Option<Argument>>> {
        let machine = std::sync::Arc::clone(&self.machine);
        let made = machine.program.callables.get(usize::from(callable))?;
        let signature = machine.program.signatures.callables.get(usize::from(callable))?;
        let mut args: Vec<Option<Argument>> = Vec::with_capacity(signature.params.len());
        for given in given {
            args.push(Some(self.value_of(*given, spot)?));
        }
        args.resize_with(signature.params.len(), || None);
        let ask = |walk: &mut Self| {
            walk.place(spot.event).is_some_and(|(draft, session)| match made.primitive {
                Some(primitive) => draft.permits_call(session, primitive, &args),
                None => draft.permits_policy(session, (&signature.name, made.template.as_ref()), &args),
            })
        };
        let permits = if spot.shared {
            // It is asked of a value when that is picked, and again when it is tried.
            let key = self.key(Question::Permitted, spot.event, of_call(callable, given));
            self.answer(key, ask)
        } else {
            ask(self)
        };
        permits.then_some(args)
    }

    /// The call that is the first to be asked of all that runs at once, with these arguments and some behind them: nothing
    /// refutes it at its place.
    pub(super) fn likely_call(
        &mut self,
        callable: u16,
        given: &mut Vec<Given>,
        spot: Spot,
    ) -> Option<Vec<Event>> {
        self.permitted(callable, given, spot)?;
        let Some(options) = self.options(callable, given, spot) else {
            return Some(of_call(callable, given).collect());
        };
        options.into_iter().find_map(|option| {
            given.push(option);
            let call = self.likely_call(callable, given, Spot { tries: 1, ..spot });
            given.pop();
            call
        })
    }

    /// A text, or what stands for any where it describes nothing and so is as good as any other that does not.
    pub(crate) fn plain_text(&self, text: Event) -> Event {
        let Event::Text(start, len) = text else { return text };
        let bytes = self.bytes.get(start as usize..start.saturating_add(len) as usize);
        let written = bytes.and_then(|bytes| std::str::from_utf8(bytes).ok());
        match written {
            Some(written) if self.machine.session.describes(written) => text,
            _ => Event::AnyText,
        }
    }

    /// What is tried as an argument; none behind the last.
    fn options(&mut self, callable: u16, given: &mut Vec<Given>, spot: Spot) -> Option<Vec<Given>> {
        let index = usize::from(callable);
        let machine = std::sync::Arc::clone(&self.machine);
        let ty = &machine.program.signatures.callables.get(index)?.params.get(given.len())?.ty;
        let options = self.values_of(index, given.len(), ty, spot);
        if !spot.shared {
            return Some(options);
        }
        // Names of the policy's own stand last, and are what is meant more often.
        let mut tried = Vec::with_capacity(spot.tries);
        for option in options.into_iter().rev() {
            given.push(option);
            if self.permitted(callable, given, spot).is_some() {
                tried.push(option);
            }
            given.pop();
            if tried.len() == spot.tries {
                break;
            }
        }
        Some(tried)
    }

    /// What can be tried as an argument: every word, and one of all values between which no contract tells.
    fn values_of(&self, callable: usize, place: usize, ty: &Type, spot: Spot) -> Vec<Given> {
        let made = self.machine.program.callables.get(callable);
        let word = made.and_then(|made| made.words.get(place).copied().flatten());
        let element = made.and_then(|made| made.elements.get(place).copied().flatten());
        let words = |op: Option<u32>| {
            op.map(|op| self.words_of(op, spot.scope, Some((callable, place)))).unwrap_or_default()
        };
        match ty {
            Type::Text => vec![Given::One(Event::AnyText)],
            Type::Bool => vec![Given::One(Event::Plain(Plain::True))],
            Type::Int | Type::Number | Type::Quantity(_) => {
                let params = self.machine.program.signatures.callables.get(callable);
                let range =
                    params.and_then(|signature| signature.params.get(place)).and_then(|param| param.range);
                let range = crate::surface::NumberRange::of(ty, range);
                range
                    .map(|range| Given::One(Event::Number(range.least, range.decimals)))
                    .into_iter()
                    .collect()
            }
            Type::List(_) => {
                let whole = words(word).into_iter().map(Given::One);
                whole.chain(words(element).into_iter().take(1).map(Given::List)).collect()
            }
            Type::Pose | Type::Entity(_) | Type::Enum(_) => words(word).into_iter().map(Given::One).collect(),
        }
    }

    /// A value that is tried, as the checker knows it.
    fn value_of(&mut self, given: Given, spot: Spot) -> Option<Argument> {
        let event = match given {
            Given::List(_) => return Some(Argument::unknown()),
            Given::One(event) => event,
        };
        let text = |start: u32, len: u32| {
            let bytes = self.bytes.get(start as usize..start.saturating_add(len) as usize)?;
            std::str::from_utf8(bytes).ok()
        };
        Some(match event {
            Event::Word(..) => meaning(&self.machine.program, event)?.value(),
            Event::Bound(id) => {
                let name = *self.arenas.name(id)?;
                let name = smol_str::SmolStr::new(text(name.start, name.len)?);
                let (draft, _) = self.place(spot.event)?;
                draft.binding(&name)?
            }
            Event::Text(start, len) => Argument::text(text(start, len)?),
            Event::Plain(_) | Event::Number(..) | Event::AnyText => Argument::unknown(),
            Event::Open(_) | Event::Close | Event::Name(..) | Event::Joined(_) | Event::Hole => {
                Argument::unknown()
            }
        })
    }

    /// The arguments of the call that is being written, and the place before it.
    pub(crate) fn call_so_far(&self, event: Id) -> Option<(u16, Vec<Given>, Id)> {
        let mut given = Vec::new();
        let mut at = event;
        while let Some(said) = self.arenas.said(at).filter(|_| at > 0) {
            at = said.below;
            match said.event {
                Event::Open(Kind::Do(callable)) => {
                    given.reverse();
                    return Some((callable, given, at));
                }
                // A list: nothing depends on what is in it.
                Event::Close => {
                    while let Some(said) = self.arenas.said(at).filter(|_| at > 0) {
                        at = said.below;
                        if said.event == Event::Open(Kind::List) {
                            break;
                        }
                    }
                    given.push(Given::One(Event::AnyText));
                }
                event => given.push(Given::One(event)),
            }
        }
        None
    }
}

/// A call as it is said.
fn of_call(callable: u16, given: &[Given]) -> impl Iterator<Item = Event> {
    let open = Event::Open(Kind::Do(callable));
    let args = given.iter().flat_map(|given| match given {
        Given::One(event) => [Some(*event), None, None],
        Given::List(event) => [Some(Event::Open(Kind::List)), Some(*event), Some(Event::Close)],
    });
    std::iter::once(open).chain(args.flatten()).chain([Event::Close])
}

/// What a word means.
pub(super) fn meaning(program: &Program, event: Event) -> Option<Meaning> {
    let Event::Word(op, index) = event else { return None };
    let Op::Word(words) = program.op(op) else { return None };
    words.table.get(index).map(|entry| entry.meaning)
}

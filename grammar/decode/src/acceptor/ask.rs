//! What the checker says of a place of a walk. Two drafts follow the walk: one stands where the next step will stand and
//! is asked of calls, the other is asked whether steps that are closed for the time being are errors.

use motet_compiler::draft::Draft;
use motet_compiler::{Session, draft::Value};
use motet_syntax::ast::{self, Policy, Step};
use motet_syntax::{Form, Span};

use super::arena::{Arenas, Event, Id};
use super::build::Builder;
use super::walk::{Machine, Walk};
use crate::program::{Kind, Op, Plain};

/// The drafts of a walk, and how far they are.
#[derive(Clone, Debug, Default)]
pub(crate) struct Asked {
    /// Asked of calls.
    place: Follower,
    /// Asked of whole steps.
    judge: Follower,
    /// The event behind which the first of them stands.
    stands: Option<u32>,
}

/// A draft that follows a walk.
#[derive(Clone, Debug, Default)]
struct Follower {
    draft: Option<Draft>,
    /// The event that ended what stands before the steps.
    head: u32,
    /// The event that ended each step.
    steps: Vec<u32>,
}

/// What a walk has said, for a follower to read.
struct Told<'w> {
    machine: &'w Machine,
    arenas: &'w Arenas,
    bytes: &'w [u8],
}

impl Told<'_> {
    fn step(&self, events: &[Event]) -> Option<Step> {
        let Self { machine, arenas, bytes } = self;
        Builder { program: &machine.program, arenas, bytes, events }.step()
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
            .then(|| Builder { program, arenas, bytes, events: rest }.condition());
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
    fn follow(&mut self, told: &Told<'_>, last: Id) -> Option<&mut Draft> {
        let serial = told.arenas.serial(last);
        let latest = self.steps.last().copied().unwrap_or(self.head);
        if self.draft.is_some() && latest == serial {
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
        if self.draft.is_none() || self.head != told.arenas.serial(*head) {
            let (draft, _) = Draft::new(session, &told.head(*head), Form::Json);
            self.draft = Some(draft);
            self.head = told.arenas.serial(*head);
            self.steps.clear();
        }
        let draft = self.draft.as_mut()?;
        let known =
            steps.iter().zip(&self.steps).take_while(|(id, known)| told.arenas.serial(**id) == **known);
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
            self.steps.push(told.arenas.serial(*id));
            before = *id;
        }
        Some(draft)
    }
}

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
}

impl Walk {
    /// Whether the step of the body that is being written is no error, with `more` behind what was said and closed.
    pub(crate) fn verify(&mut self, event: Id, more: &[Event]) -> bool {
        let before = self.arenas.said(event).map_or(0, |said| said.before);
        let mut events = self.arenas.between(before, event);
        events.extend_from_slice(more);
        let told = Told { machine: &self.machine, arenas: &self.arenas, bytes: &self.bytes };
        let step = told.step(&events);
        let draft = self.asked.judge.follow(&told, before);
        match (draft, step) {
            (Some(draft), Some(step)) => draft.permits_step(&self.machine.session, &step),
            (Some(_), None) => true,
            (None, _) => false,
        }
    }

    /// The draft where the next step will stand, behind `event`.
    fn place(&mut self, event: Id) -> Option<(&mut Draft, &Session, &Arenas)> {
        let before = self.arenas.said(event).map_or(0, |said| said.before);
        let told = Told { machine: &self.machine, arenas: &self.arenas, bytes: &self.bytes };
        let serial = told.arenas.serial(event);
        if self.asked.stands != Some(serial) {
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
            self.asked.stands = Some(serial);
        }
        Some((self.asked.place.draft.as_mut()?, &self.machine.session, &self.arenas))
    }

    /// Whether the state where the next step will stand refutes nothing of a step.
    fn permits_here(&mut self, events: &[Event], spot: Spot) -> bool {
        if self.place(spot.event).is_none() {
            return false;
        }
        let told = Told { machine: &self.machine, arenas: &self.arenas, bytes: &self.bytes };
        let Some(step) = told.step(events) else { return false };
        let names = self.arenas.in_scope(spot.scope).map(|(_, name)| {
            let bytes = self.bytes.get(name.start as usize..(name.start + name.len) as usize);
            smol_str::SmolStr::new(String::from_utf8_lossy(bytes.unwrap_or_default()))
        });
        let names: Vec<_> = names.collect();
        let draft = self.asked.place.draft.as_mut();
        draft.is_some_and(|draft| draft.permits_here(&self.machine.session, &step, &names))
    }

    /// Whether the policy may be done where the next step will stand.
    pub(crate) fn may_be_done(&mut self, event: Id) -> bool {
        self.place(event).is_some_and(|(draft, session, _)| draft.permits_done(session))
    }

    /// Whether a call can be completed from the arguments that are given.
    pub(crate) fn can_be_called(&mut self, callable: u16, given: &mut Vec<Given>, spot: Spot) -> bool {
        let machine = std::sync::Arc::clone(&self.machine);
        let index = usize::from(callable);
        let (Some(made), Some(signature)) =
            (machine.program.callables.get(index), machine.program.signatures.callables.get(index))
        else {
            return false;
        };
        // What a branch uses no later one may use; that is seen without a proof.
        if given.is_empty() && spot.shared && made.uses & self.resources_taken(spot.event) != 0 {
            return false;
        }
        if let Some(primitive) = made.primitive {
            let mut args: Vec<Option<Value>> = Vec::with_capacity(signature.params.len());
            for given in &*given {
                let Some(value) = self.value_of(*given, spot) else { return false };
                args.push(Some(value));
            }
            args.resize_with(signature.params.len(), || None);
            let permits = self
                .place(spot.event)
                .is_some_and(|(draft, session, _)| draft.permits_call(session, primitive, &args));
            if !permits {
                return false;
            }
        }
        let is_whole = given.len() >= signature.params.len();
        if made.primitive.is_none() || (is_whole && spot.shared) {
            let mut events = vec![Event::Open(Kind::Do(callable))];
            for given in &*given {
                match given {
                    Given::One(event) => events.push(*event),
                    Given::List(event) => events.extend([Event::Open(Kind::List), *event, Event::Close]),
                }
            }
            events.push(Event::Close);
            let permits = (made.primitive.is_some() || self.permits_here(&events, spot))
                && (!is_whole || !spot.shared || self.verify(spot.event, &events));
            if !permits {
                return false;
            }
        }
        let Some(param) = signature.params.get(given.len()) else { return true };
        let place = given.len();
        for option in self.options(index, place, &param.ty, spot) {
            given.push(option);
            let can = self.can_be_called(callable, given, spot);
            given.pop();
            if can {
                return true;
            }
        }
        false
    }

    /// What the branches use that stand beside those around an event.
    fn resources_taken(&self, event: Id) -> u64 {
        let before = self.arenas.said(event).map_or(0, |said| said.before);
        // Of all that is open: what it is, what its whole parts use, and what all of it uses.
        let mut open: Vec<(Kind, u64, u64)> = Vec::new();
        for event in self.arenas.between(before, event) {
            match event {
                Event::Open(kind) => {
                    if let Kind::Do(callable) = kind {
                        let made = self.machine.program.callables.get(usize::from(callable));
                        let uses = made.map_or(0, |made| made.uses);
                        open.iter_mut().for_each(|(.., all)| *all |= uses);
                    }
                    open.push((kind, 0, 0));
                }
                Event::Close => {
                    let closed = open.pop();
                    if let (Some((Kind::Block, _, uses)), Some((Kind::Parallel, taken, _))) =
                        (closed, open.last_mut())
                    {
                        *taken |= uses;
                    }
                }
                _ => {}
            }
        }
        let parallel = open.iter().filter(|(kind, ..)| *kind == Kind::Parallel);
        parallel.fold(0, |taken, (_, more, _)| taken | more)
    }

    /// What can be tried as an argument: every word, and one of all values between which no contract tells.
    fn options(
        &self,
        callable: usize,
        place: usize,
        ty: &motet_compiler::signature::Type,
        spot: Spot,
    ) -> Vec<Given> {
        use motet_compiler::signature::Type;
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
    fn value_of(&mut self, given: Given, spot: Spot) -> Option<Value> {
        let event = match given {
            Given::List(_) => return Some(Value::unknown()),
            Given::One(event) => event,
        };
        Some(match event {
            Event::Word(op, index) => match self.machine.program.op(op) {
                Op::Word(words) => words.table.get(index)?.meaning.value(),
                _ => return None,
            },
            Event::Bound(id) => {
                let name = *self.arenas.name(id)?;
                let start = name.start as usize;
                let bytes = self.bytes.get(start..start + name.len as usize)?.to_vec();
                let text = String::from_utf8(bytes).ok()?;
                let (draft, ..) = self.place(spot.event)?;
                draft.binding(&text)?
            }
            _ => Value::unknown(),
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

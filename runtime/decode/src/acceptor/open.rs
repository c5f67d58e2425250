//! Which choices are open: names in scope of the right type, calls that nothing refutes, endings that reach the goal,
//! brackets that may close.

use motet_compiler::MAX_FIXPOINTS;

use super::arena::{Event, Flags, Id, State};
use super::ask::{Given, MOST_SHARED, Spot};
use super::walk::{Walk, is_ruled_out};
use super::word::BOUND;
use crate::program::{Bound, Guard, Kind, Op, OpId, Role, Slot, Words};
use crate::surface::{MAX_CONDITION_DEPTH, MAX_STEPS};

impl Walk {
    fn spot(&self, state: &State, event: Id) -> Spot {
        let shared = self.control(state.control).flags.has(Flags::SHARED);
        Spot { event, scope: state.scope, shared, tries: MOST_SHARED }
    }

    /// Whether an alternative that is guarded like this is open.
    pub(crate) fn allows(&mut self, state: &State, guard: Guard) -> bool {
        let control = self.control(state.control);
        let flags = control.flags;
        let is_strict = flags.has(Flags::STRICT);
        let may_be_loose = !is_strict || flags.has(Flags::LOOSE);
        // The last place of a block is for its end.
        let has_room = usize::from(control.count) + 1 < MAX_STEPS;
        let may_nest = has_room && usize::from(control.depth) < self.machine.program.surface.depth;
        let may_fix = may_nest && usize::from(control.fix) < MAX_FIXPOINTS;
        match guard {
            Guard::Open | Guard::Rare => true,
            Guard::Never => false,
            Guard::Below(most) => control.count < most,
            Guard::Close => self.may_close(state, control.slot, flags),
            Guard::Empty => {
                let block = [Event::Open(Kind::Block), Event::Close];
                !flags.has(Flags::SHARED) || self.verify_beside(state.event, &block)
            }
            Guard::Call => has_room && self.can_call_something(state, false),
            Guard::Let => has_room && self.can_call_something(state, true),
            Guard::Callable(number) => has_room && self.can_be_called(number, self.spot(state, state.event)),
            Guard::Nest => may_nest,
            Guard::Fix => may_fix,
            Guard::Wait => {
                let wait = [Event::Open(Kind::Wait)];
                has_room
                    && (!flags.has(Flags::SHARED)
                        || (self.machine.program.measures && self.verify_beside(state.event, &wait))
                        || self.some_condition_holds(state, &wait, false)
                        || self.some_condition_holds(state, &wait, true))
            }
            Guard::Done => {
                let done = [Event::Open(Kind::Done), Event::Close];
                usize::from(control.count) < MAX_STEPS
                    && self.may_be_done(state.event)
                    && (!flags.has(Flags::SHARED) || self.verify_beside(state.event, &done))
            }
            Guard::DoneWhen => self.verify(state.event, &[Event::Open(Kind::Done), Event::Close]),
            Guard::React(Kind::Pause) => {
                let is_plain = !flags.has(Flags::TRIED) && !flags.has(Flags::SHARED);
                is_plain || self.verify_beside(state.event, &[Event::Open(Kind::Pause), Event::Close])
            }
            Guard::React(Kind::Resume) => {
                usize::from(control.depth) < self.machine.program.surface.depth
                    && usize::from(control.fix) < MAX_FIXPOINTS
                    && self.verify(state.event, &[Event::Open(Kind::Resume)])
            }
            Guard::React(kind) => self.verify(state.event, &[Event::Open(kind), Event::Close]),
            Guard::All => !is_strict && usize::from(control.conditions) < MAX_CONDITION_DEPTH,
            Guard::Any => may_be_loose && usize::from(control.conditions) < MAX_CONDITION_DEPTH,
            Guard::Not => {
                usize::from(control.conditions) < MAX_CONDITION_DEPTH
                    && (!is_strict
                        || (!flags.has(Flags::NEGATED)
                            && ((flags.has(Flags::LOOSE) && self.machine.program.measures)
                                || self.some_condition_holds(state, &[], true))))
            }
            Guard::Is => {
                if is_strict {
                    self.some_condition_holds(state, &[], false)
                } else {
                    flags.has(Flags::GOAL)
                        || self.machine.program.signatures.fluents.iter().any(|fluent| fluent.is_observable)
                }
            }
            Guard::Fluent(number) if is_strict => self.condition_holds(state, number, &mut Vec::new()),
            Guard::Fluent(number) => {
                let fluent = self.machine.program.signatures.fluents.get(usize::from(number));
                usize::from(control.conditions) <= MAX_CONDITION_DEPTH
                    && (flags.has(Flags::GOAL) || fluent.is_some_and(|fluent| fluent.is_observable))
            }
            Guard::And => !is_strict && self.may_join(state, control.conditions),
            Guard::Or => may_be_loose && self.may_join(state, control.conditions),
            Guard::Paren(levels) => {
                may_be_loose && usize::from(control.conditions) + usize::from(levels) <= MAX_CONDITION_DEPTH
            }
            Guard::NotParen => {
                let may_be_several = usize::from(control.conditions) < MAX_CONDITION_DEPTH;
                may_be_loose && (may_be_several || self.machine.program.measures)
            }
            Guard::Several => usize::from(control.conditions) <= MAX_CONDITION_DEPTH,
            Guard::Compared => self.last_condition(state.event).is_comparison,
            Guard::Loose => may_be_loose,
            Guard::NoTest => self.needs_no_test(state.event),
        }
    }

    /// Whether a block may end where it is.
    fn may_close(&mut self, state: &State, slot: Slot, flags: Flags) -> bool {
        let close = [Event::Close];
        match slot {
            Slot::Body => self.may_be_done(state.event),
            // What comes back to the head of a loop; a test may keep it away.
            Slot::Loop => {
                self.may_come_round(state.event)
                    || (self.is_repeat(state.event)
                        && (self.some_condition_holds(state, &close, false)
                            || self.some_condition_holds(state, &close, true)))
            }
            Slot::Branch
            | Slot::Reaction
            | Slot::During
            | Slot::Group
            | Slot::Then
            | Slot::Else
            | Slot::Try
            | Slot::Catch => !flags.has(Flags::SHARED) || self.verify_beside(state.event, &close),
        }
    }

    /// Whether the block that is open is the body of a `repeat`.
    fn is_repeat(&self, event: Id) -> bool {
        let mut at = event;
        let mut closed = 0usize;
        while let Some(said) = self.arenas.said(at).filter(|_| at > 0) {
            match said.event {
                Event::Close => closed += 1,
                Event::Open(Kind::Block) if closed == 0 => {}
                Event::Open(kind) if closed == 0 => return kind == Kind::Repeat,
                Event::Open(_) => closed -= 1,
                _ => {}
            }
            at = said.below;
        }
        false
    }

    /// Whether anything can be called, or anything with a result.
    fn can_call_something(&mut self, state: &State, has_result: bool) -> bool {
        let spot = self.spot(state, state.event);
        // Policies take a proof of all their steps: they come last.
        let machine = std::sync::Arc::clone(&self.machine);
        let results = machine.program.signatures.callables.iter().map(|callable| callable.result.is_some());
        let callables = machine.program.callables.iter().zip(0..).zip(results);
        let callables = callables.filter(|(_, has)| *has || !has_result).map(|(callable, _)| callable);
        let mut order: Vec<(bool, u16)> =
            callables.map(|(callable, number)| (callable.primitive.is_none(), number)).collect();
        order.sort_unstable();
        order.into_iter().any(|(_, callable)| self.can_be_called(callable, spot))
    }

    /// Every word of an operation, in the order of the list.
    pub(crate) fn words_of(&self, op: OpId, scope: Id, arg: Option<(usize, usize)>) -> Vec<Event> {
        let Op::Word(words) = self.machine.program.op(op) else { return Vec::new() };
        let ruled_out = |index: u32| {
            let meaning = words.table.get(index).map(|entry| entry.meaning);
            arg.zip(meaning).is_some_and(|((callable, place), meaning)| {
                is_ruled_out(&self.machine, callable, place, meaning)
            })
        };
        let own =
            (0..u32::try_from(words.table.entries.len()).unwrap_or(0)).filter(|index| !ruled_out(*index));
        let own = own.map(|index| Event::Word(op, index));
        own.chain(self.bound_words(words, scope).map(Event::Bound)).collect()
    }

    /// The names in scope that are among the words of a list.
    fn bound_words<'w>(&'w self, words: &Words, scope: Id) -> impl Iterator<Item = Id> + use<'w> {
        use motet_compiler::signature::Type;
        let program = &self.machine.program;
        let bound = words.bound;
        let fits = move |actual: u16| {
            let Some(actual) = program.ty(actual) else { return false };
            match bound {
                Bound::None => false,
                Bound::Lists => matches!(actual, Type::List(_)),
                Bound::Type(wanted) => {
                    program.ty(wanted).is_some_and(|wanted| program.signatures.fits(wanted, actual))
                }
            }
        };
        self.arenas.in_scope(scope).filter(move |(_, name)| fits(name.ty)).map(|(id, _)| id)
    }

    /// The words of an operation that are open, as a range of the list arena.
    pub(crate) fn list(&mut self, state: &State, words: &Words) -> (u32, u32) {
        let mut call = match words.role {
            Role::Argument(_) => self.call_so_far(state.event),
            Role::Callable
            | Role::Fluent
            | Role::Of
            | Role::Alike
            | Role::Head
            | Role::Keyword
            | Role::Free => None,
        };
        let spot = call.as_ref().and_then(|(callable, _, before)| {
            let spot = self.spot(state, *before);
            self.spot_of(*callable, spot)
        });
        let control = self.control(state.control);
        let arg = match (&call, words.role) {
            (Some((callable, ..)), Role::Argument(place)) => {
                Some((usize::from(*callable), usize::from(place)))
            }
            _ => None,
        };
        let mut found: Vec<u32> = Vec::new();
        let mut kind = None;
        let words_of = self.words_of(state.op, state.scope, arg);
        if let (Some((callable, given, _)), Some(spot)) = (&mut call, spot) {
            self.foresee_values(*callable, given, &words_of, spot);
        }
        if words.role == Role::Of && control.flags.has(Flags::STRICT) {
            self.foresee_asked(state, &words_of);
        }
        for event in words_of {
            let (entry, meaning) = match event {
                Event::Word(_, index) => (index, words.table.get(index).map(|entry| entry.meaning)),
                Event::Bound(id) => (BOUND | id, None),
                _ => continue,
            };
            let number = match meaning {
                Some(crate::program::Meaning::Named(number)) => Some(number),
                _ => None,
            };
            let is_open = match words.role {
                Role::Callable => number.is_some_and(|callable| {
                    let spot = self.spot(state, state.event);
                    self.can_be_called(callable, spot)
                }),
                Role::Argument(_) => match (&mut call, spot) {
                    (Some((callable, given, _)), Some(spot)) => {
                        given.push(Given::One(event));
                        let can = self.completes_call(*callable, given, spot);
                        given.pop();
                        can
                    }
                    (Some(_), None) => false,
                    (None, _) => true,
                },
                Role::Fluent if control.flags.has(Flags::STRICT) => {
                    number.is_some_and(|fluent| self.condition_holds(state, fluent, &mut Vec::new()))
                }
                Role::Fluent => {
                    let fluents = &self.machine.program.signatures.fluents;
                    control.flags.has(Flags::GOAL)
                        || number
                            .and_then(|number| fluents.get(usize::from(number)))
                            .is_some_and(|fluent| fluent.is_observable)
                }
                Role::Of if control.flags.has(Flags::STRICT) => match self.fluent_so_far(state.event) {
                    Some((fluent, place)) => self.completes_with(state, fluent, place, event),
                    None => true,
                },
                Role::Alike => {
                    let wanted = *kind.get_or_insert_with(|| self.kind_of_list(state.event));
                    let own = match meaning {
                        Some(crate::program::Meaning::Entity(entity)) => self.kind_of(entity),
                        _ => None,
                    };
                    wanted.is_none() || own == wanted
                }
                Role::Keyword => words.table.get(entry).is_some_and(|entry| {
                    let to = entry.to.unwrap_or(words.next);
                    self.fits(entry.name.len(), to, state.control) && self.allows(state, entry.guard)
                }),
                Role::Of | Role::Head | Role::Free => true,
            };
            if is_open {
                found.push(entry);
            }
        }
        if found.iter().any(|entry| *entry >= BOUND) {
            let walk = &*self;
            let letters = |entry: u32| (0..).map_while(move |pos| walk.letter(words, entry, pos));
            found.sort_by(|a, b| letters(*a).cmp(letters(*b)));
        }
        let lo = u32::try_from(self.arenas.lists.len()).unwrap_or(u32::MAX);
        self.arenas.lists.append(&mut found);
        (lo, u32::try_from(self.arenas.lists.len()).unwrap_or(u32::MAX))
    }

    /// The kind of an entity.
    fn kind_of(&self, entity: u16) -> Option<usize> {
        self.machine.program.signatures.entities.get(usize::from(entity)).map(|(_, kind)| *kind)
    }

    /// The kind of the entities of the list that is being written, or that was just written; none before the first.
    pub(crate) fn kind_of_list(&self, event: Id) -> Option<usize> {
        let mut at = event;
        while let Some(said) = self.arenas.said(at).filter(|_| at > 0) {
            match said.event {
                Event::Word(op, index) => {
                    let Op::Word(words) = self.machine.program.op(op) else { return None };
                    return match words.table.get(index)?.meaning {
                        crate::program::Meaning::Entity(entity) => self.kind_of(entity),
                        _ => None,
                    };
                }
                Event::Close => at = said.below,
                _ => return None,
            }
        }
        None
    }

    /// The fluent of the condition that is being written, and how many arguments it has so far.
    pub(super) fn fluent_so_far(&self, event: Id) -> Option<(u16, usize)> {
        let mut at = event;
        let mut given = 0;
        while let Some(said) = self.arenas.said(at).filter(|_| at > 0) {
            match said.event {
                Event::Open(Kind::Is(fluent)) => return Some((fluent, given)),
                Event::Word(..) | Event::Bound(_) => given += 1,
                _ => return None,
            }
            at = said.below;
        }
        None
    }

    /// Whether it may depend on what the text that is being written says whether it can stand where it does.
    pub(crate) fn text_matters(&mut self) -> bool {
        let state = self.state();
        let op = match self.machine.program.op(state.op) {
            Op::Fork { other, .. } => *other,
            _ => state.op,
        };
        let Op::Text { arg: Some(_) } = self.machine.program.op(op) else { return false };
        let Some((callable, _, before)) = self.call_so_far(state.event) else { return false };
        let made = self.machine.program.callables.get(usize::from(callable));
        let spot = self.spot(&state, before);
        made.is_none_or(|made| made.primitive.is_none())
            || self.spot_of(callable, spot).is_none_or(|spot| spot.shared)
    }

    /// Whether a text may be an argument of the call that is being written: what it describes may matter there.
    pub(crate) fn permits_text(&mut self, state: &State, text: Event) -> bool {
        let Some((callable, mut given, before)) = self.call_so_far(state.event) else { return true };
        let made = self.machine.program.callables.get(usize::from(callable));
        let is_policy = made.is_some_and(|made| made.primitive.is_none());
        let spot = self.spot(state, before);
        if !is_policy && !spot.shared {
            return true;
        }
        let Some(spot) = self.spot_of(callable, spot) else { return false };
        // A policy may ask what a text says.
        let is_plain = made.is_some_and(|made| made.template.as_ref().is_none_or(|made| !made.compares()));
        let text = if is_plain { self.plain_text(text) } else { text };
        given.push(Given::One(text));
        self.completes_call(callable, &mut given, spot)
    }
}

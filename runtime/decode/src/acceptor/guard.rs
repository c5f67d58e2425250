//! Evaluation of guards: which alternatives and which words are open in the current state.

use motet_compiler::MAX_FIXPOINTS;
use motet_compiler::signature::Type;

use super::event_log::{Event, Flags, Id, Name, State};
use super::machine::Machine;
use super::oracle::{Argument, CallSite, MOST_SHARED};
use super::question::PAUSE;
use super::word::BOUND;
use crate::automaton::{BoundNames, CaughtField, Meaning, Op, OpId, WordList};
use crate::grammar::{BlockRole, Guard, NodeKind, WordRole};
use crate::subset::{MAX_CONDITION_DEPTH, MAX_NAME_CHARS, MAX_STEPS, NumberRange};

impl Machine {
    fn site(&self, state: &State, event: Id) -> CallSite {
        let flags = self.frame(state.frame).flags;
        let (shared, cleans) = (flags.has(Flags::SHARED), flags.has(Flags::CLEANUP));
        CallSite { event, scope: state.scope, shared, cleans, tries: MOST_SHARED }
    }

    /// Evaluates a guard.
    pub(crate) fn allows(&mut self, state: &State, guard: Guard) -> bool {
        let frame = self.frame(state.frame);
        let flags = frame.flags;
        let is_strict = flags.has(Flags::STRICT);
        let may_be_loose = !is_strict || flags.has(Flags::LOOSE);
        // The last step of a block is reserved for its ending.
        let has_room = usize::from(frame.count) + 1 < MAX_STEPS;
        let may_nest = has_room && usize::from(frame.depth) < self.context.automaton.subset.depth;
        let may_fix = may_nest && usize::from(frame.fix) < MAX_FIXPOINTS;
        match guard {
            Guard::Open | Guard::Rare => true,
            Guard::Never => false,
            Guard::Below(most) => frame.count < most,
            // A policy with a result ends in an ending.
            Guard::Close if frame.slot == BlockRole::Body && frame.result.is_some() => false,
            Guard::Close => self.may_close(state, frame.slot, flags),
            Guard::Empty => {
                let block = [Event::Open(NodeKind::Block), Event::Close];
                !flags.has(Flags::SHARED) || self.verify_beside(state.event, &block)
            }
            Guard::Call => has_room && self.can_call_something(state, false),
            Guard::Let => has_room && (self.can_name_a_value(state) || self.can_call_something(state, true)),
            Guard::LetValue => has_room && self.can_name_a_value(state),
            Guard::Room => has_room,
            Guard::List => self.has_list(state.scope),
            Guard::OfList => may_be_loose && self.has_list(state.scope),
            Guard::Caught => self.has_caught(state.scope),
            Guard::OfCaught => may_be_loose && self.has_caught(state.scope),
            Guard::Pose => self.takes_pose(state),
            Guard::First(place, ty) => self.can_be_first(state, place, ty),
            Guard::Interrupt => {
                let is_plain = !flags.has(Flags::TRIED) && !flags.has(Flags::SHARED);
                may_fix && (is_plain || self.verify_beside(state.event, &PAUSE))
            }
            Guard::Split(split) => {
                let mut ended = *state;
                self.end_before_deadline(&mut ended, split).is_some() && self.allows(&ended, Guard::Interrupt)
            }
            Guard::If => may_nest && self.may_branch(state, flags),
            Guard::Cleanup => {
                let may_nest = usize::from(frame.depth) < self.context.automaton.subset.depth;
                let cleanup = [Event::Open(NodeKind::Finally), Event::Close];
                may_nest
                    && usize::from(frame.fix) < MAX_FIXPOINTS
                    && (!flags.has(Flags::SHARED) && !self.has_monitor(state.event)
                        || self.verify(state.event, &cleanup))
            }
            Guard::Cleaned => true,
            Guard::Callable(number) => has_room && self.can_be_called(number, self.site(state, state.event)),
            Guard::Nest => may_nest,
            Guard::Fix => may_fix,
            Guard::Wait => {
                let wait = [Event::Open(NodeKind::Wait)];
                has_room
                    && (!flags.has(Flags::SHARED)
                        || (self.context.automaton.measures && self.verify_beside(state.event, &wait))
                        || self.some_condition_holds(state, &wait, false)
                        || self.some_condition_holds(state, &wait, true))
            }
            Guard::Done => {
                let Some(done) = self.done(state) else { return false };
                usize::from(frame.count) < MAX_STEPS
                    && self.may_be_done(state.event)
                    && (!flags.has(Flags::SHARED) || self.verify_beside(state.event, &done))
            }
            Guard::DoneWhen => self.done(state).is_some_and(|done| self.verify(state.event, &done)),
            Guard::React(NodeKind::Pause) => {
                let is_plain = !flags.has(Flags::TRIED) && !flags.has(Flags::SHARED);
                is_plain || self.verify_beside(state.event, &[Event::Open(NodeKind::Pause), Event::Close])
            }
            Guard::React(NodeKind::Resume) => {
                usize::from(frame.depth) < self.context.automaton.subset.depth
                    && usize::from(frame.fix) < MAX_FIXPOINTS
                    && self.verify(state.event, &[Event::Open(NodeKind::Resume)])
            }
            Guard::React(kind) => self.verify(state.event, &[Event::Open(kind), Event::Close]),
            Guard::All => !is_strict && usize::from(frame.conditions) < MAX_CONDITION_DEPTH,
            Guard::Any => may_be_loose && usize::from(frame.conditions) < MAX_CONDITION_DEPTH,
            Guard::Not => {
                usize::from(frame.conditions) < MAX_CONDITION_DEPTH
                    && (!is_strict
                        || (!flags.has(Flags::NEGATED)
                            && ((flags.has(Flags::LOOSE) && self.context.automaton.measures)
                                || self.some_condition_holds(state, &[], true))))
            }
            Guard::Is => {
                if is_strict {
                    self.some_condition_holds(state, &[], false)
                } else {
                    flags.has(Flags::GOAL)
                        || self.context.automaton.signatures.fluents.iter().any(|fluent| fluent.is_observable)
                }
            }
            Guard::Fluent(number) if is_strict => self.condition_holds(state, number, &mut Vec::new()),
            Guard::Fluent(number) => {
                let fluent = self.context.automaton.signatures.fluents.get(usize::from(number));
                usize::from(frame.conditions) <= MAX_CONDITION_DEPTH
                    && (flags.has(Flags::GOAL) || fluent.is_some_and(|fluent| fluent.is_observable))
            }
            Guard::And => !is_strict && self.may_join(state, frame.conditions),
            Guard::Or => may_be_loose && self.may_join(state, frame.conditions),
            Guard::Paren(levels) => {
                may_be_loose && usize::from(frame.conditions) + usize::from(levels) <= MAX_CONDITION_DEPTH
            }
            Guard::NotParen => {
                let may_be_several = usize::from(frame.conditions) < MAX_CONDITION_DEPTH;
                may_be_loose && (may_be_several || self.context.automaton.measures)
            }
            Guard::Several => usize::from(frame.conditions) <= MAX_CONDITION_DEPTH,
            Guard::Compared => self.last_condition(state.event).is_comparison,
            Guard::Loose => may_be_loose,
            Guard::NoTest => self.needs_no_test(state.event),
        }
    }

    /// The range of the number that is being written. A `wait` for a time may last as long as a monitor needs
    /// to fire: where a longer one would be refuted, it ends before.
    pub(super) fn range_of(&mut self, state: &State, range: NumberRange) -> NumberRange {
        let is_delay =
            self.arenas.entry(state.event).map(|said| said.event) == Some(Event::Open(NodeKind::Delay));
        let Some(least) = is_delay.then(|| self.least_hold(state)).flatten() else { return range };
        let longest = [Event::Number(range.greatest, range.decimals), Event::Close];
        if self.verify_beside(state.event, &longest) {
            return range;
        }
        NumberRange { greatest: range.greatest.min(least - 1), ..range }
    }

    /// The shortest time, in milliseconds, for which a condition of the monitors around the open block has to
    /// hold; `None` if there is none.
    pub(super) fn least_hold(&self, state: &State) -> Option<i64> {
        if !self.frame(state.frame).flags.has(Flags::SHARED) {
            return None;
        }
        let (mut closed, mut hold, mut least) = (0usize, None, None::<i64>);
        for said in self.arenas.back(state.event) {
            match said.event {
                Event::Close => closed += 1,
                // What stands directly in a node that has ended.
                Event::Number(units, _) if closed == 1 => hold = Some(units),
                Event::Open(kind) => {
                    if closed == 1 && kind == NodeKind::When {
                        least = least.into_iter().chain(hold.filter(|units| *units > 0)).min();
                    }
                    hold = if closed == 1 { None } else { hold };
                    closed = closed.saturating_sub(1);
                }
                _ => {}
            }
        }
        least
    }

    /// The block may end here.
    fn may_close(&mut self, state: &State, slot: BlockRole, flags: Flags) -> bool {
        let close = [Event::Close];
        match slot {
            BlockRole::Body => self.may_be_done(state.event),
            // The next iteration must not be refuted; a test may prevent it.
            BlockRole::Loop => {
                self.may_iterate(state.event)
                    || (self.is_repeat(state.event)
                        && (self.some_condition_holds(state, &close, false)
                            || self.some_condition_holds(state, &close, true)))
            }
            BlockRole::Else | BlockRole::Catch if self.joins_entities(state.event, slot) => {
                self.verify(state.event, &close)
            }
            _ => !flags.has(Flags::SHARED) || self.verify_beside(state.event, &close),
        }
    }

    /// A step may branch on some condition. In a cleanup a branch may refute the goal.
    fn may_branch(&mut self, state: &State, flags: Flags) -> bool {
        let branch = [Event::Open(NodeKind::If)];
        !(flags.has(Flags::SHARED) && flags.has(Flags::CLEANUP))
            || (self.context.automaton.measures && self.verify_beside(state.event, &branch))
            || self.some_condition_holds(state, &branch, false)
            || self.some_condition_holds(state, &branch, true)
    }

    /// A `let` may give some value a name.
    fn can_name_a_value(&self, state: &State) -> bool {
        self.context.automaton.names_values || self.has_list(state.scope) || self.has_caught(state.scope)
    }

    /// Some failure is bound.
    fn has_caught(&self, scope: Id) -> bool {
        let automaton = &self.context.automaton;
        let is_caught = |name: &Name| automaton.ty(name.ty) == Some(&Type::Failure);
        automaton.catches && self.visible(scope).iter().any(|(_, name)| is_caught(name))
    }

    /// The events of a `done`, with a result if the policy gives one; `None` if nothing can be its result.
    fn done(&self, state: &State) -> Option<Vec<Event>> {
        let result = match self.frame(state.frame).result {
            Some(ty) => Some(self.names_of(state.scope, ty).first().copied().map(Event::Bound)?),
            None => None,
        };
        let done = [Event::Open(NodeKind::Done)];
        Some(done.into_iter().chain(result).chain([Event::Close]).collect())
    }

    /// The names of values of the type with a number.
    fn names_of(&self, scope: Id, ty: u16) -> Vec<Id> {
        let automaton = &self.context.automaton;
        let fits = |name: &Name| {
            automaton
                .ty(ty)
                .zip(automaton.ty(name.ty))
                .is_some_and(|(wanted, actual)| automaton.signatures.fits(wanted, actual))
        };
        let names = self.visible(scope).into_iter().filter(|(_, name)| fits(name));
        names.map(|(id, _)| id).collect()
    }

    /// A pose that is written out may be the next argument of the call that is being written.
    fn takes_pose(&mut self, state: &State) -> bool {
        let call = self.call_so_far(state.event);
        call.is_some_and(|(callable, _, before)| {
            let site = self.site_of(callable, self.site(state, before));
            site.is_some_and(|site| site.takes_pose(self, callable))
        })
    }

    /// Some list is bound.
    fn has_list(&self, scope: Id) -> bool {
        let automaton = &self.context.automaton;
        let is_list = |name: &Name| matches!(automaton.ty(name.ty), Some(Type::List(_)));
        (automaton.counts || automaton.firsts) && self.visible(scope).iter().any(|(_, name)| is_list(name))
    }

    /// The first element of some list may be an argument of the call that is being written.
    fn can_be_first(&mut self, state: &State, place: u8, ty: u16) -> bool {
        let Some((callable, mut given, before)) = self.call_so_far(state.event) else { return false };
        let site = self.site(state, before);
        let Some(site) = self.site_of(callable, site) else { return false };
        let context = std::sync::Arc::clone(&self.context);
        let Some(ty) = context.automaton.ty(ty).filter(|_| given.len() == usize::from(place)) else {
            return false;
        };
        self.firsts(ty, state.scope).into_iter().any(|first| {
            given.push(Argument::One(first));
            let can = self.completes_call(callable, &mut given, site);
            given.pop();
            can
        })
    }

    /// The first elements of lists that fit a type.
    pub(super) fn firsts(&self, ty: &Type, scope: Id) -> Vec<Event> {
        let automaton = &self.context.automaton;
        let fits = |name: &Name| match automaton.ty(name.ty) {
            Some(Type::List(element)) => automaton.signatures.fits(ty, element),
            _ => false,
        };
        if !automaton.firsts {
            return Vec::new();
        }
        let lists = self.visible(scope).into_iter().filter(|(_, name)| fits(name));
        lists.map(|(id, _)| Event::First(id)).collect()
    }

    /// The step before, or at the end of the policy any step, watches something. A reaction that leaves
    /// it needs a proof only if a cleanup follows.
    fn has_monitor(&self, event: Id) -> bool {
        let before = self.arenas.entry(event).map_or(0, |said| said.before);
        let first = if before == event { 0 } else { before };
        let watches = |event: &Event| {
            matches!(event, Event::Open(NodeKind::Monitor | NodeKind::Within | NodeKind::Keep))
        };
        self.arenas.between(first, event).iter().any(watches)
    }

    /// The open block is the body of a `repeat`.
    pub(super) fn is_repeat(&self, event: Id) -> bool {
        let mut closed = 0usize;
        for said in self.arenas.back(event) {
            match said.event {
                Event::Close => closed += 1,
                Event::Open(NodeKind::Block) if closed == 0 => {}
                Event::Open(kind) if closed == 0 => return kind == NodeKind::Repeat,
                Event::Open(_) => closed -= 1,
                _ => {}
            }
        }
        false
    }

    /// Some callable can be called; with `has_result`, one that has a result.
    fn can_call_something(&mut self, state: &State, has_result: bool) -> bool {
        let site = self.site(state, state.event);
        // Policies need a proof of all their steps: they come last.
        let context = std::sync::Arc::clone(&self.context);
        let results = context.automaton.signatures.callables.iter().map(|callable| callable.result.is_some());
        let callables = context.automaton.callables.iter().zip(0..).zip(results);
        let callables = callables.filter(|(_, has)| *has || !has_result).map(|(callable, _)| callable);
        let mut order: Vec<(bool, u16)> =
            callables.map(|(callable, number)| (callable.primitive.is_none(), number)).collect();
        order.sort_unstable();
        order.into_iter().any(|(_, callable)| self.can_be_called(callable, site))
    }

    /// Every word of an operation, in the order of its list.
    pub(crate) fn words_of(&self, op: OpId, scope: Id, arg: Option<(usize, usize)>) -> Vec<Event> {
        let Op::Word(words) = self.context.automaton.op(op) else { return Vec::new() };
        let ruled_out = |index: u32| {
            let meaning = words.table.get(index).map(|entry| entry.meaning);
            arg.zip(meaning).is_some_and(|((callable, place), meaning)| {
                self.context.is_ruled_out(callable, place, meaning)
            })
        };
        let own =
            (0..u32::try_from(words.table.entries.len()).unwrap_or(0)).filter(|index| !ruled_out(*index));
        let own = own.map(|index| Event::Word(op, index));
        let bound = |id| match words.bound {
            BoundNames::First(_) => Event::First(id),
            BoundNames::None
            | BoundNames::Type(_)
            | BoundNames::Lists
            | BoundNames::List
            | BoundNames::Given
            | BoundNames::Caught
            | BoundNames::CaughtField(_) => Event::Bound(id),
        };
        own.chain(self.bound_words(words, scope).map(bound)).collect()
    }

    /// The bindings in scope that are among the words of a list.
    fn bound_words<'w>(&'w self, words: &WordList, scope: Id) -> impl Iterator<Item = Id> + use<'w> {
        let automaton = &self.context.automaton;
        let bound = words.bound;
        let fits = move |actual: u16| {
            let Some(actual) = automaton.ty(actual) else { return false };
            match bound {
                // Its type is that of the policy.
                BoundNames::None | BoundNames::Given => false,
                BoundNames::Caught | BoundNames::CaughtField(_) => *actual == Type::Failure,
                BoundNames::Lists | BoundNames::List => matches!(actual, Type::List(_)),
                BoundNames::First(wanted) => match (automaton.ty(wanted), actual) {
                    (Some(wanted), Type::List(element)) => automaton.signatures.fits(wanted, element),
                    _ => false,
                },
                BoundNames::Type(wanted) => {
                    automaton.ty(wanted).is_some_and(|wanted| automaton.signatures.fits(wanted, actual))
                }
            }
        };
        self.visible(scope).into_iter().filter(move |(_, name)| fits(name.ty)).map(|(id, _)| id)
    }

    /// Evaluates the words of an operation; returns the open ones as a range of the list arena, sorted by
    /// their bytes.
    pub(crate) fn list(&mut self, state: &State, words: &WordList) -> (u32, u32) {
        let mut call = match words.role {
            WordRole::Argument(_) => self.call_so_far(state.event),
            _ => None,
        };
        let site = call.as_ref().and_then(|(callable, _, before)| {
            let site = self.site(state, *before);
            self.site_of(*callable, site)
        });
        let frame = self.frame(state.frame);
        let arg = match (&call, words.role) {
            (Some((callable, ..)), WordRole::Argument(place)) => {
                Some((usize::from(*callable), usize::from(place)))
            }
            _ => None,
        };
        let mut found: Vec<u32> = Vec::new();
        let mut kind = None;
        let mut words_of = match (words.bound, frame.result) {
            (BoundNames::Given, Some(ty)) => {
                self.names_of(state.scope, ty).into_iter().map(Event::Bound).collect()
            }
            _ => self.words_of(state.op, state.scope, arg),
        };
        words_of.retain(|event| match event {
            Event::Word(_, index) => !self.is_out(words, *index, state.pos),
            Event::Bound(id) | Event::First(id) => !self.is_out(words, BOUND | *id, state.pos),
            _ => true,
        });
        if let (Some((callable, given, _)), Some(site)) = (&mut call, site) {
            self.probe_values(*callable, given, &words_of, site);
        }
        if words.role == WordRole::Of && frame.flags.has(Flags::STRICT) {
            self.probe_conditions(state, &words_of);
        }
        for event in words_of {
            let (entry, meaning) = match event {
                Event::Word(_, index) => (index, words.table.get(index).map(|entry| entry.meaning)),
                Event::Bound(id) | Event::First(id) => (BOUND | id, None),
                _ => continue,
            };
            let number = match meaning {
                Some(Meaning::Named(number)) => Some(number),
                _ => None,
            };
            let is_open = match words.role {
                WordRole::Callable => number.is_some_and(|callable| {
                    let site = self.site(state, state.event);
                    self.can_be_called(callable, site)
                }),
                WordRole::Argument(_) => match (&mut call, site) {
                    (Some((callable, given, _)), Some(site)) => {
                        given.push(Argument::One(event));
                        let can = self.completes_call(*callable, given, site);
                        given.pop();
                        can
                    }
                    (Some(_), None) => false,
                    (None, _) => true,
                },
                WordRole::Fluent | WordRole::Head
                    if let Some(guard) = words.table.get(entry).and_then(|entry| of_bound(entry.guard)) =>
                {
                    self.allows(state, guard)
                }
                WordRole::Fluent if frame.flags.has(Flags::STRICT) => {
                    number.is_some_and(|fluent| self.condition_holds(state, fluent, &mut Vec::new()))
                }
                WordRole::Fluent => {
                    let fluents = &self.context.automaton.signatures.fluents;
                    frame.flags.has(Flags::GOAL)
                        || number
                            .and_then(|number| fluents.get(usize::from(number)))
                            .is_some_and(|fluent| fluent.is_observable)
                }
                WordRole::Of if frame.flags.has(Flags::STRICT) => match self.fluent_so_far(state.event) {
                    Some((fluent, place)) => self.completes_with(state, fluent, place, event),
                    None => true,
                },
                WordRole::Alike => {
                    let wanted = *kind.get_or_insert_with(|| self.kind_of_list(state.event));
                    let own = match meaning {
                        Some(Meaning::Entity(entity)) => self.kind_of(entity),
                        _ => None,
                    };
                    wanted.is_none() || own == wanted
                }
                // The field of a failure. What follows its name has a fixed length.
                WordRole::Keyword if entry >= BOUND => {
                    self.fits(MAX_NAME_CHARS, words.next, state.frame)
                        && (words.bound == BoundNames::CaughtField(CaughtField::Text)
                            || self.allows(state, Guard::OfCaught))
                }
                WordRole::Keyword => words.table.get(entry).is_some_and(|entry| {
                    let to = entry.to.unwrap_or(words.next);
                    self.fits(entry.name.len(), to, state.frame) && self.allows(state, entry.guard)
                }),
                WordRole::Of | WordRole::Head | WordRole::Free => true,
            };
            if is_open {
                found.push(entry);
            }
        }
        if found.iter().any(|entry| *entry >= BOUND) {
            let machine = &*self;
            let letters = |entry: u32| (0..).map_while(move |pos| machine.letter(words, entry, pos));
            found.sort_by(|a, b| letters(*a).cmp(letters(*b)));
        }
        let lo = u32::try_from(self.arenas.lists.len()).unwrap_or(u32::MAX);
        self.arenas.lists.append(&mut found);
        (lo, u32::try_from(self.arenas.lists.len()).unwrap_or(u32::MAX))
    }

    /// The kind of an entity of the scene.
    fn kind_of(&self, entity: u16) -> Option<usize> {
        self.context.automaton.signatures.entities.get(usize::from(entity)).map(|(_, kind)| *kind)
    }

    /// The kind of the entities of the list that is being written or was just written; `None` before the
    /// first.
    pub(crate) fn kind_of_list(&self, event: Id) -> Option<usize> {
        let last = self.arenas.back(event).find(|said| said.event != Event::Close)?;
        let Event::Word(op, index) = last.event else { return None };
        let Op::Word(words) = self.context.automaton.op(op) else { return None };
        match words.table.get(index)?.meaning {
            Meaning::Entity(entity) => self.kind_of(entity),
            _ => None,
        }
    }

    /// The fluent that is being written, and the number of its arguments so far.
    pub(super) fn fluent_so_far(&self, event: Id) -> Option<(u16, usize)> {
        let is_argument = |event: Event| matches!(event, Event::Word(..) | Event::Bound(_));
        let (given, said) = self.arenas.back(event).enumerate().find(|(_, said)| !is_argument(said.event))?;
        match said.event {
            Event::Open(NodeKind::Is(fluent)) => Some((fluent, given)),
            _ => None,
        }
    }

    /// The contents of the text that is being written may decide if it can stand there.
    pub(crate) fn text_matters(&mut self) -> bool {
        let state = self.state();
        let op = match self.context.automaton.op(state.op) {
            Op::Fork { other, .. } => *other,
            _ => state.op,
        };
        let Op::Text { arg: Some(_) } = self.context.automaton.op(op) else { return false };
        let Some((callable, _, before)) = self.call_so_far(state.event) else { return false };
        let made = self.context.automaton.callables.get(usize::from(callable));
        let is_policy = made.is_none_or(|made| made.primitive.is_none());
        let compares = made.is_some_and(|made| made.template.as_ref().is_some_and(|made| made.compares()));
        let site = self.site(&state, before);
        if !is_policy && self.site_of(callable, site).is_some_and(|site| !site.shared) {
            return false;
        }
        // A text that describes no entity is as good as any other.
        let begun = self.written(state.pos).and_then(|(start, len)| self.spelling(start, len));
        compares || begun.is_none_or(|begun| self.context.session.may_describe(begun))
    }

    /// A text can be an argument of the call that is being written; the entity that it describes may
    /// matter.
    pub(crate) fn permits_text(&mut self, state: &State, text: Event) -> bool {
        let Some((callable, mut given, before)) = self.call_so_far(state.event) else { return true };
        let made = self.context.automaton.callables.get(usize::from(callable));
        let is_policy = made.is_some_and(|made| made.primitive.is_none());
        // The needs of a policy may compare a text.
        let is_plain = made.is_some_and(|made| made.template.as_ref().is_none_or(|made| !made.compares()));
        let site = self.site(state, before);
        if !is_policy && !site.shared {
            return true;
        }
        let Some(site) = self.site_of(callable, site) else { return false };
        let text = if is_plain { self.plain_text(text) } else { text };
        given.push(Argument::One(text));
        self.completes_call(callable, &mut given, site)
    }
}

/// The guard of a condition about a bound name, where that of its word asks for one.
fn of_bound(guard: Guard) -> Option<Guard> {
    match guard {
        Guard::List => Some(Guard::OfList),
        Guard::Caught => Some(Guard::OfCaught),
        _ => None,
    }
}

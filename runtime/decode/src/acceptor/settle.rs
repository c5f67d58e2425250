//! What is meant where no byte is taken: rules begin and end, names are bound, blocks are entered and left.

use std::sync::Arc;

use super::arena::{Control, Event, Flags, Id, Name, State, UNSEEN};
use super::walk::Walk;
use crate::program::{Act, Asks, Kind, Op, OpId, Slot};

impl Walk {
    /// Goes on at `op`, past all that takes no byte.
    pub(super) fn settle(&mut self, mut state: State, op: OpId) -> State {
        let machine = Arc::clone(&self.machine);
        state.op = op;
        loop {
            match machine.program.op(state.op) {
                Op::Act(act) => {
                    self.act(&mut state, *act);
                    state.op += 1;
                }
                Op::Call(rule) => {
                    let below = self.control(state.control);
                    let rest = machine.program.rest(state.op + 1) + below.rest;
                    let (ret, scope) = (state.op + 1, state.scope);
                    let control = Control { below: state.control, ret, rest, count: 0, scope, ..below };
                    state.control = self.arenas.push_control(control);
                    state.op = *rule;
                }
                Op::Jump(to) => state.op = *to,
                Op::Return => {
                    let control = self.control(state.control);
                    state.control = control.below;
                    state.op = control.ret;
                }
                Op::Literal(_)
                | Op::Choose(_)
                | Op::Maybe(_)
                | Op::Word(_)
                | Op::Fork { .. }
                | Op::Text { .. }
                | Op::Name(_)
                | Op::Number(_)
                | Op::Accept => break,
            }
        }
        (state.pos, state.lo, state.hi) = (0, UNSEEN, UNSEEN);
        state
    }

    fn act(&mut self, state: &mut State, act: Act) {
        let control = self.control(state.control);
        let changed = match act {
            Act::Open(kind) => {
                state.event = self.say(state.event, Event::Open(kind));
                return;
            }
            Act::Close => {
                state.event = self.say(state.event, Event::Close);
                return;
            }
            Act::Say(plain) => {
                state.event = self.say(state.event, Event::Plain(plain));
                return;
            }
            Act::Head => {
                state.event = self.arenas.say_last(state.event);
                return;
            }
            Act::BindItem => {
                let kind = self.kind_of_list(state.event);
                let types = &self.machine.program.types;
                let ty = kind.and_then(|kind| {
                    types.iter().position(|ty| *ty == motet_compiler::signature::Type::Entity(kind))
                });
                let ty = ty.and_then(|ty| u16::try_from(ty).ok()).unwrap_or(u16::MAX);
                if let Some((start, len)) = self.name_before_list(state.event) {
                    state.scope = self.arenas.bind(Name { below: state.scope, start, len, ty });
                }
                return;
            }
            Act::Leave => {
                if control.slot != Slot::Body {
                    state.event = self.say(state.event, Event::Close);
                }
                state.scope = control.scope;
                return;
            }
            Act::Forget => {
                state.scope = self.arenas.name(state.scope).map_or(0, |name| name.below);
                return;
            }
            Act::StepDone => {
                if control.slot == Slot::Body {
                    state.event = self.arenas.say_last(state.event);
                }
                Control { count: control.count.saturating_add(1), ..control }
            }
            Act::Count => Control { count: control.count.saturating_add(1), ..control },
            Act::Enter(slot) => self.enter(state, slot, control),
            Act::Condition(asks) => {
                let flags = control.flags.without(Flags::STRICT).without(Flags::LOOSE);
                let flags = flags.without(Flags::GOAL).without(Flags::NEGATED);
                let flags = match asks {
                    Asks::Goal => flags.with(Flags::GOAL),
                    Asks::Anything => flags,
                    Asks::Wait if flags.has(Flags::SHARED) => {
                        let flags = flags.with(Flags::STRICT);
                        if self.verify_beside(state.event, &[]) { flags.with(Flags::LOOSE) } else { flags }
                    }
                    Asks::Wait => flags,
                    Asks::Until if self.needs_no_test(state.event) => flags,
                    Asks::Until => flags.with(Flags::STRICT),
                };
                Control { flags, conditions: 0, ..control }
            }
            Act::Bind(ty) => {
                if let Some(name) = self.arenas.name(state.scope).copied() {
                    state.event = self.say(state.event, Event::Name(name.start, name.len));
                    state.scope = self.arenas.bind(Name { ty, ..name });
                }
                return;
            }
            Act::Join(kind) => {
                state.event = self.say(state.event, Event::Joined(kind));
                Control { count: control.count.saturating_add(1), ..control }
            }
            Act::Deeper => Control { conditions: control.conditions.saturating_add(1), ..control },
            Act::Loosen => {
                Control { flags: control.flags.without(Flags::STRICT).without(Flags::LOOSE), ..control }
            }
            Act::Negate => Control { flags: control.flags.with(Flags::NEGATED), ..control },
        };
        state.control = self.arenas.push_control(changed);
    }

    fn enter(&mut self, state: &mut State, slot: Slot, control: Control) -> Control {
        let flags = control.flags.without(Flags::STRICT).without(Flags::LOOSE);
        let mut flags = flags.without(Flags::NEGATED).without(Flags::GOAL);
        match slot {
            Slot::Branch | Slot::Reaction => flags = flags.with(Flags::SHARED),
            Slot::During if self.reacts_inside(state.event, flags) => flags = flags.with(Flags::SHARED),
            Slot::Try => flags = flags.with(Flags::TRIED),
            Slot::Body | Slot::Group | Slot::Then | Slot::Else | Slot::Catch | Slot::During | Slot::Loop => {}
        }
        let is_fixpoint = matches!(slot, Slot::Loop | Slot::Branch | Slot::During | Slot::Reaction);
        let (depth, fix) = (control.depth, control.fix);
        if slot != Slot::Body {
            state.event = self.say(state.event, Event::Open(Kind::Block));
        }
        Control {
            count: 0,
            depth: depth.saturating_add(u8::from(slot != Slot::Body)),
            fix: fix.saturating_add(u8::from(is_fixpoint)),
            conditions: 0,
            flags,
            slot,
            scope: state.scope,
            ..control
        }
    }

    /// Whether a reaction of the monitor of which everything but its body was said may be refuted by what the body does.
    fn reacts_inside(&self, event: Id, flags: Flags) -> bool {
        let mut at = event;
        let mut nested = 0usize;
        while let Some(said) = self.arenas.said(at).filter(|_| at > 0) {
            match said.event {
                Event::Close => nested += 1,
                Event::Open(Kind::Monitor) if nested == 0 => return false,
                Event::Open(kind) => {
                    nested = nested.saturating_sub(1);
                    let is_inside = match kind {
                        Kind::Restart | Kind::Resume | Kind::Done | Kind::Field(_) => true,
                        Kind::Pause => flags.has(Flags::TRIED) || flags.has(Flags::SHARED),
                        _ => false,
                    };
                    if is_inside {
                        return true;
                    }
                }
                _ => {}
            }
            at = said.below;
        }
        false
    }
}

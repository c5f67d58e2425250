//! Epsilon transitions: rule calls and returns, and the actions that open nodes, bind names, and enter and
//! leave blocks.

use std::sync::Arc;

use super::event_log::{CallFrame, Event, Flags, Id, Name, State, UNSEEN, meaning};
use super::machine::Machine;
use crate::automaton::{Meaning, Op, OpId};
use crate::grammar::{Action, BlockRole, ConditionUse, Constant, NodeKind, Split};

impl Machine {
    /// Moves to `op` and on to the next operation that takes a byte.
    pub(super) fn follow_epsilon(&mut self, mut state: State, op: OpId) -> State {
        let context = Arc::clone(&self.context);
        state.op = op;
        loop {
            match context.automaton.op(state.op) {
                Op::Action(apply) => {
                    self.apply(&mut state, *apply);
                    state.op += 1;
                }
                Op::Call(rule) => {
                    let below = self.frame(state.frame);
                    let rest = context.automaton.rest(state.op + 1) + below.rest;
                    let (ret, scope) = (state.op + 1, state.scope);
                    let frame = CallFrame { below: state.frame, ret, rest, count: 0, scope, ..below };
                    state.frame = self.arenas.push_frame(frame);
                    state.op = *rule;
                }
                Op::Jump(to) => state.op = *to,
                Op::Gives { then, other } => {
                    let gives = self.frame(state.frame).result.is_some();
                    state.op = if gives { *then } else { *other };
                }
                Op::Return => {
                    let frame = self.frame(state.frame);
                    state.frame = frame.below;
                    state.op = frame.ret;
                }
                _ => break,
            }
        }
        (state.pos, state.lo, state.hi) = (0, UNSEEN, UNSEEN);
        state
    }

    fn apply(&mut self, state: &mut State, apply: Action) {
        let frame = self.frame(state.frame);
        let changed = match apply {
            Action::Open(kind) => {
                state.event = self.record(state.event, Event::Open(kind));
                if !kind.has_blocks() {
                    return;
                }
                CallFrame { begun: state.scope, ..frame }
            }
            Action::Close => {
                state.event = self.record(state.event, Event::Close);
                return;
            }
            Action::Constant(plain) => {
                state.event = self.record(state.event, Event::Constant(plain));
                return;
            }
            Action::Head => {
                state.event = self.arenas.record_step_end(state.event);
                return;
            }
            Action::Gives => {
                let word = self.arenas.entry(state.event).map(|said| said.event);
                let meaning = word.and_then(|word| meaning(&self.context.automaton, word));
                let result = if let Some(Meaning::Named(ty)) = meaning { Some(ty) } else { None };
                CallFrame { result, ..frame }
            }
            Action::Forget => {
                if self.has_caught_name(state.event) {
                    state.scope = self.arenas.name(state.scope).map_or(0, |name| name.below);
                }
                return;
            }
            Action::BindItem => {
                let kind = self.kind_of_list(state.event);
                let types = &self.context.automaton.types;
                let ty = kind.and_then(|kind| {
                    types.iter().position(|ty| *ty == motet_compiler::signature::Type::Entity(kind))
                });
                let ty = ty.and_then(|ty| u16::try_from(ty).ok()).unwrap_or(u16::MAX);
                if let Some((start, len)) = self.name_before_list(state.event) {
                    let item = Name { below: state.scope, start, len, ty, is_free: false };
                    state.scope = self.arenas.bind(item);
                }
                return;
            }
            Action::Leave => {
                state.scope = self.scope_behind(state, frame);
                if frame.slot != BlockRole::Body {
                    state.event = self.record(state.event, Event::Close);
                }
                return;
            }
            Action::Meet => {
                *state = self.meet(*state);
                return;
            }
            Action::StepDone => {
                if frame.slot == BlockRole::Body {
                    state.event = self.arenas.record_step_end(state.event);
                }
                CallFrame { count: frame.count.saturating_add(1), ..frame }
            }
            Action::Count => CallFrame { count: frame.count.saturating_add(1), ..frame },
            Action::Enter(slot) => self.enter(state, slot, frame),
            Action::Condition(asks) => {
                let flags = frame.flags.without(Flags::STRICT).without(Flags::LOOSE);
                let flags = flags.without(Flags::GOAL).without(Flags::NEGATED);
                let flags = match asks {
                    ConditionUse::Goal => flags.with(Flags::GOAL),
                    ConditionUse::Branch if !(flags.has(Flags::SHARED) && flags.has(Flags::CLEANUP)) => flags,
                    ConditionUse::Wait | ConditionUse::Branch if flags.has(Flags::SHARED) => {
                        let flags = flags.with(Flags::STRICT);
                        if self.verify_beside(state.event, &[]) { flags.with(Flags::LOOSE) } else { flags }
                    }
                    ConditionUse::Wait | ConditionUse::Branch => flags,
                    ConditionUse::Until if self.needs_no_test(state.event) => flags,
                    ConditionUse::Until => flags.with(Flags::STRICT),
                };
                CallFrame { flags, conditions: 0, ..frame }
            }
            Action::Bind(ty) => {
                if let Some(name) = self.arenas.name(state.scope).copied() {
                    state.event = self.record(state.event, Event::Name(name.start, name.len));
                    state.scope = self.arenas.bind(Name { ty, ..name });
                }
                return;
            }
            Action::BindFirst => {
                let list = match self.arenas.entry(state.event).map(|said| said.event) {
                    Some(Event::Bound(list)) => self.element(list),
                    _ => u16::MAX,
                };
                self.apply(state, Action::Bind(list));
                return;
            }
            Action::Split(split) => {
                let Some(deadline) = self.end_before_deadline(state, split) else { return };
                state.event = self.record(state.event, Event::Open(NodeKind::Within));
                state.event = self.record(state.event, deadline);
                CallFrame { begun: state.scope, ..self.frame(state.frame) }
            }
            Action::Join(kind) => {
                state.event = self.record(state.event, Event::Joined(kind));
                CallFrame { count: frame.count.saturating_add(1), ..frame }
            }
            Action::Deeper => CallFrame { conditions: frame.conditions.saturating_add(1), ..frame },
            Action::Loosen => {
                CallFrame { flags: frame.flags.without(Flags::STRICT).without(Flags::LOOSE), ..frame }
            }
            Action::Negate => CallFrame { flags: frame.flags.with(Flags::NEGATED), ..frame },
        };
        state.frame = self.arenas.push_frame(changed);
    }

    /// Ends a step before the deadline that ends the log, and returns that.
    pub(super) fn end_before_deadline(&mut self, state: &mut State, split: Split) -> Option<Event> {
        let deadline = self.arenas.entry(state.event).copied()?;
        state.event = deadline.below;
        for _ in 0..split.modifiers {
            state.event = self.record(state.event, Event::Constant(Constant::Null));
        }
        if let Some(ty) = split.bind {
            self.apply(state, Action::Bind(ty));
        }
        state.event = self.record(state.event, Event::Close);
        self.apply(state, Action::StepDone);
        Some(deadline.event)
    }

    fn enter(&mut self, state: &mut State, slot: BlockRole, frame: CallFrame) -> CallFrame {
        let flags = frame.flags.without(Flags::STRICT).without(Flags::LOOSE);
        let mut flags = flags.without(Flags::NEGATED).without(Flags::GOAL);
        match slot {
            BlockRole::Branch | BlockRole::Reaction => flags = flags.with(Flags::SHARED),
            BlockRole::During if self.reacts_inside(state.event, flags) => flags = flags.with(Flags::SHARED),
            BlockRole::Try => flags = flags.with(Flags::TRIED),
            // What a cleanup does may refute the goal at a `done` before it.
            BlockRole::Cleanup if self.goal(state.event) != 0 => {
                flags = flags.with(Flags::CLEANUP).with(Flags::SHARED);
            }
            BlockRole::Cleanup => flags = flags.with(Flags::CLEANUP),
            BlockRole::Body
            | BlockRole::Group
            | BlockRole::Then
            | BlockRole::Else
            | BlockRole::Catch
            | BlockRole::During
            | BlockRole::Loop => {}
        }
        let is_fixpoint = match slot {
            BlockRole::Loop | BlockRole::Branch | BlockRole::During | BlockRole::Reaction => true,
            BlockRole::Cleanup => true,
            BlockRole::Body | BlockRole::Group | BlockRole::Then | BlockRole::Else => false,
            BlockRole::Try | BlockRole::Catch => false,
        };
        let (depth, fix) = (frame.depth, frame.fix);
        let scope = state.scope;
        match slot {
            BlockRole::Body => {}
            BlockRole::Cleanup => {
                state.event = self.record(state.event, Event::Open(NodeKind::Finally));
                state.scope = self.scope_of_cleanup(scope, frame.begun);
            }
            _ => state.event = self.record(state.event, Event::Open(NodeKind::Block)),
        }
        CallFrame {
            count: 0,
            depth: depth.saturating_add(u8::from(slot != BlockRole::Body)),
            fix: fix.saturating_add(u8::from(is_fixpoint)),
            conditions: 0,
            flags,
            slot,
            scope,
            ..frame
        }
    }

    /// The body of the monitor that ends the log may refute one of the monitor's reactions, or make it fire.
    fn reacts_inside(&self, event: Id, flags: Flags) -> bool {
        let mut nested = 0usize;
        for said in self.arenas.back(event) {
            match said.event {
                Event::Close => nested += 1,
                Event::Open(NodeKind::Monitor) if nested == 0 => return false,
                // Both are as a monitor that pauses.
                Event::Open(NodeKind::Within | NodeKind::Keep) if nested == 0 => {
                    return flags.has(Flags::TRIED) || flags.has(Flags::SHARED);
                }
                Event::Open(kind) => {
                    nested = nested.saturating_sub(1);
                    let is_inside = match kind {
                        NodeKind::Restart | NodeKind::Resume | NodeKind::Done | NodeKind::Field(_) => true,
                        // A step of the body may make the monitor fire.
                        NodeKind::Is(_) => true,
                        NodeKind::Pause => flags.has(Flags::TRIED) || flags.has(Flags::SHARED),
                        _ => false,
                    };
                    if is_inside {
                        return true;
                    }
                }
                _ => {}
            }
        }
        false
    }
}

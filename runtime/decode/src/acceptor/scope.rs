//! Names behind a block and a step: definite assignment on the event log, by the same rule as the resolver of
//! the compiler. A name is bound behind a step if every path that goes on has bound it with one type.

use motet_compiler::signature::Type;

use super::event_log::{CallFrame, Event, Id, Name, State};
use super::machine::Machine;
use crate::grammar::{BlockRole, LetValue, NodeKind};

/// Type of a name without a value.
const NO_VALUE: u16 = u16::MAX;

/// A name that a step binds: the start and length of its bytes, and its type.
#[derive(Clone, Copy, Debug)]
struct BoundName {
    start: u32,
    len: u32,
    ty: u16,
}

/// Names that the steps of a node bind, the latest last.
#[derive(Clone, Debug)]
struct Flow {
    names: Vec<BoundName>,
    /// False if control never reaches its end.
    goes_on: bool,
}

/// A reader of the events of a node.
struct FlowReader<'m> {
    machine: &'m Machine,
    events: std::vec::IntoIter<Event>,
}

impl Machine {
    /// The names in scope, the latest first, without those that later ones hide.
    pub(super) fn visible(&self, scope: Id) -> Vec<(Id, Name)> {
        let mut found: Vec<(Id, Name)> = Vec::new();
        for (id, name) in self.arenas.in_scope(scope) {
            let spelled = self.spelled(name.start, name.len);
            if !found.iter().any(|(_, later)| self.spelled(later.start, later.len) == spelled) {
                found.push((id, *name));
            }
        }
        found
    }

    fn spelled(&self, start: u32, len: u32) -> Option<&[u8]> {
        self.bytes.get(start as usize..start.saturating_add(len) as usize)
    }

    /// The scope behind the block that ends the log, before it is closed.
    pub(super) fn scope_behind(&mut self, state: &State, frame: CallFrame) -> Id {
        let mut names: Vec<Name> = self
            .arenas
            .in_scope(state.scope)
            .take_while(|(id, _)| *id != frame.scope)
            .map(|(_, name)| *name)
            .collect();
        let is_repeat = || self.is_repeat(state.event);
        let (below, has_values) = match frame.slot {
            // The steps run at least once, and nothing else runs in their place.
            BlockRole::Group | BlockRole::During => (frame.scope, true),
            BlockRole::Loop if is_repeat() => (frame.scope, true),
            BlockRole::Loop => {
                let item = self.arenas.name(frame.scope).copied();
                names.extend(item);
                (item.map_or(0, |item| item.below), false)
            }
            BlockRole::Reaction => (frame.scope, false),
            // Only the cleanup of the policy may follow.
            BlockRole::Body => return state.scope,
            // What follows is one of several paths, or, behind a cleanup, sees what it saw before.
            BlockRole::Cleanup
            | BlockRole::Then
            | BlockRole::Else
            | BlockRole::Try
            | BlockRole::Catch
            | BlockRole::Branch => return frame.scope,
        };
        let names = names.into_iter().rev();
        names.fold(below, |below, name| {
            let ty = if has_values { name.ty } else { NO_VALUE };
            self.arenas.bind(Name { below, ty, is_free: true, ..name })
        })
    }

    /// The scope in a cleanup: that before its step, with the names that the step binds as names without a
    /// value.
    pub(super) fn scope_of_cleanup(&mut self, scope: Id, before: Id) -> Id {
        let inside = self.arenas.in_scope(scope).take_while(|(id, _)| *id != before);
        let names: Vec<Name> = inside.map(|(_, name)| *name).collect();
        let names = names.into_iter().rev();
        let without = |name: Name, below| Name { below, ty: NO_VALUE, is_free: true, ..name };
        names.fold(before, |below, name| self.arenas.bind(without(name, below)))
    }

    /// The handler that ends the log has named its failure. Its block is closed.
    pub(super) fn has_caught_name(&self, event: Id) -> bool {
        let (mut closed, mut log) = (0usize, self.arenas.back(event));
        while let Some(said) = log.next() {
            match said.event {
                Event::Close => closed += 1,
                Event::Open(_) => closed = closed.saturating_sub(1),
                _ => {}
            }
            if closed == 0 {
                return log.next().is_some_and(|before| matches!(before.event, Event::Name(..)));
            }
        }
        false
    }

    /// Binds the names that are bound behind the paths through the open node.
    pub(super) fn meet(&mut self, mut state: State) -> State {
        let Some((kind, paths)) = self.paths(state.event, 0) else { return state };
        for BoundName { start, len, ty } in self.met(kind, &paths).names {
            let name = Name { below: state.scope, start, len, ty, is_free: true };
            state.scope = self.arenas.bind(name);
        }
        state
    }

    /// Returns whether the end of the open block, the last of several paths so far, makes one entity of what
    /// two paths have found: what follows from each of them alone may then be refuted.
    pub(super) fn joins_entities(&self, event: Id, slot: BlockRole) -> bool {
        // In a handler the block, the handler and the `try` are open.
        let levels = match slot {
            BlockRole::Else => 1,
            BlockRole::Catch => 2,
            _ => return false,
        };
        let Some((_, paths)) = self.paths(event, levels) else { return false };
        let Some((last, earlier)) = paths.split_last() else { return false };
        let mut names = last.names.iter().filter(|name| {
            last.goes_on && matches!(self.context.automaton.ty(name.ty), Some(Type::Entity(_)))
        });
        names.any(|name| {
            let mut others = earlier.iter().filter(|path| path.goes_on).flat_map(|path| &path.names);
            others.any(|other| self.is_same(name, other) && name.ty == other.ty)
        })
    }

    /// The open node around so many other open nodes, and its paths so far, of which the last may be open.
    fn paths(&self, event: Id, mut levels: usize) -> Option<(NodeKind, Vec<Flow>)> {
        let (mut events, mut closed) = (Vec::new(), 0usize);
        for said in self.arenas.back(event) {
            match said.event {
                Event::Close => closed += 1,
                Event::Open(_) if closed > 0 => closed -= 1,
                Event::Open(kind) if levels == 0 => {
                    events.reverse();
                    let mut reader = FlowReader { machine: self, events: events.into_iter() };
                    return Some((kind, reader.blocks().0));
                }
                Event::Open(_) => levels -= 1,
                _ => {}
            }
            events.push(said.event);
        }
        None
    }

    /// The flow behind the paths through a node.
    fn met(&self, kind: NodeKind, paths: &[Flow]) -> Flow {
        let is_parallel = kind == NodeKind::Parallel;
        let live = paths.iter().filter(|path| path.goes_on).count();
        let goes_on = if is_parallel { live == paths.len() } else { live > 0 };
        // Nothing runs behind paths that never go on: all of them count then.
        let counts = |path: &&Flow| is_parallel || live == 0 || path.goes_on;
        let mut names: Vec<BoundName> = Vec::new();
        for name in paths.iter().filter(counts).flat_map(|path| &path.names) {
            if names.iter().any(|known| self.is_same(known, name)) {
                continue;
            }
            let latest =
                |path: &Flow| path.names.iter().rev().find(|known| self.is_same(known, name)).copied();
            let found: Vec<Option<BoundName>> = paths.iter().filter(counts).map(latest).collect();
            let mut values = found.iter().flatten().filter(|name| name.ty != NO_VALUE);
            let first = values.next();
            let is_bound = if is_parallel {
                values.next().is_none()
            } else {
                let is_same =
                    |other: &Option<BoundName>| other.map(|other| other.ty) == first.map(|it| it.ty);
                live == 0 || found.iter().all(is_same)
            };
            let value = first.filter(|_| is_bound).copied();
            names.push(value.unwrap_or(BoundName { ty: NO_VALUE, ..*name }));
        }
        Flow { names, goes_on }
    }

    fn is_same(&self, one: &BoundName, other: &BoundName) -> bool {
        self.spelled(one.start, one.len) == self.spelled(other.start, other.len)
    }
}

impl FlowReader<'_> {
    /// The flows of the blocks in a node up to its end, with those of its handlers; and the names without a
    /// value behind it: that of the node itself, and those of its reactions.
    fn blocks(&mut self) -> (Vec<Flow>, Vec<BoundName>) {
        let (mut blocks, mut others) = (Vec::new(), Vec::new());
        while let Some(event) = self.events.next() {
            match event {
                Event::Close => break,
                Event::Open(kind) => {
                    let flow = self.node(kind);
                    match kind {
                        NodeKind::Block | NodeKind::Catch => blocks.push(flow),
                        _ => others.extend(flow.names),
                    }
                }
                Event::Name(start, len) => others.push(BoundName { start, len, ty: NO_VALUE }),
                _ => {}
            }
        }
        (blocks, others)
    }

    /// The flow behind a node, whose end it reads.
    fn node(&mut self, kind: NodeKind) -> Flow {
        match kind {
            NodeKind::Do(callable) => self.call(callable),
            NodeKind::Let(value) => self.named_value(value),
            NodeKind::Finally => {
                self.blocks();
                Flow { names: Vec::new(), goes_on: true }
            }
            NodeKind::Block => self.block(),
            NodeKind::If | NodeKind::Try | NodeKind::Parallel => {
                let (paths, _) = self.blocks();
                self.machine.met(kind, &paths)
            }
            NodeKind::Sequence | NodeKind::Repeat | NodeKind::Catch | NodeKind::Within | NodeKind::Keep => {
                let (mut blocks, _) = self.blocks();
                blocks.pop().unwrap_or(Flow { names: Vec::new(), goes_on: true })
            }
            NodeKind::Monitor => {
                let (mut blocks, mut names) = self.blocks();
                let body = blocks.pop();
                names.extend(body.iter().flat_map(|body| &body.names));
                Flow { names, goes_on: body.is_none_or(|body| body.goes_on) }
            }
            NodeKind::Each | NodeKind::Resume => {
                let (blocks, mut names) = self.blocks();
                let inside = blocks.iter().flat_map(|block| &block.names);
                names.extend(inside.map(|name| BoundName { ty: NO_VALUE, ..*name }));
                Flow { names, goes_on: true }
            }
            NodeKind::When => Flow { names: self.blocks().1, goes_on: true },
            NodeKind::Done | NodeKind::Fail | NodeKind::Cannot | NodeKind::Replan => {
                self.blocks();
                Flow { names: Vec::new(), goes_on: false }
            }
            _ => {
                self.blocks();
                Flow { names: Vec::new(), goes_on: true }
            }
        }
    }

    /// The flow behind the steps of a block, one after the other.
    fn block(&mut self) -> Flow {
        let mut all = Flow { names: Vec::new(), goes_on: true };
        while let Some(event) = self.events.next() {
            match event {
                Event::Close => break,
                Event::Open(kind) => {
                    let flow = self.node(kind);
                    all.names.extend(flow.names);
                    all.goes_on &= flow.goes_on;
                }
                _ => {}
            }
        }
        all
    }

    /// The flow behind a `let`.
    fn named_value(&mut self, value: LetValue) -> Flow {
        let automaton = &self.machine.context.automaton;
        let signatures = &automaton.signatures;
        let ty = match value {
            LetValue::Count => Some(&Type::Int),
            LetValue::First => None,
            LetValue::CaughtText => Some(&Type::Text),
            LetValue::Get(index) => {
                signatures.measures.get(usize::from(index)).map(|measure| &measure.result)
            }
            LetValue::Field(index) => signatures.fields.get(usize::from(index)).map(|field| &field.ty),
        };
        let ty = ty.and_then(|ty| automaton.types.iter().position(|known| known == ty));
        let mut ty = ty.and_then(|ty| u16::try_from(ty).ok()).unwrap_or(NO_VALUE);
        let mut names = Vec::new();
        for event in self.events.by_ref() {
            match event {
                Event::Close => break,
                Event::Bound(list) if value == LetValue::First => ty = self.machine.element(list),
                Event::Name(start, len) => names.push(BoundName { start, len, ty }),
                _ => {}
            }
        }
        Flow { names, goes_on: true }
    }

    fn call(&mut self, callable: u16) -> Flow {
        let automaton = &self.machine.context.automaton;
        let (mut names, mut nested) = (Vec::new(), 0usize);
        for event in self.events.by_ref() {
            match event {
                Event::Close if nested == 0 => break,
                Event::Close => nested -= 1,
                Event::Open(_) => nested += 1,
                Event::Name(start, len) => {
                    let row = automaton.signatures.callables.get(usize::from(callable));
                    let result = row.and_then(|row| row.result.as_ref());
                    let ty = automaton.types.iter().position(|ty| Some(ty) == result);
                    let ty = ty.and_then(|ty| u16::try_from(ty).ok()).unwrap_or(NO_VALUE);
                    names.push(BoundName { start, len, ty });
                }
                _ => {}
            }
        }
        let goes_on = automaton.callables.get(usize::from(callable)).is_none_or(|callable| callable.goes_on);
        Flow { names, goes_on }
    }
}

//! Definite assignment (Gosling et al., *The Java Language Specification*, chapter 16): a name is bound
//! behind a step if every path that goes on has bound it. A path that ends the policy, or fails, does not
//! count.
//!
//! Paths that bind one name with values of one type share one binding, so that later stages need not know by
//! which path control came. Any other name is left as an unbound name of the scope, with the reason.

use motet_syntax::Span;
use motet_syntax::ast::Block;
use rustc_hash::FxHashMap;
use smallvec::SmallVec;
use smol_str::SmolStr;

use super::step::StepResolver;
use crate::declare::name::{ScopeEntry, ScopeMark};
use crate::declare::unbound::{Unbound, UnboundCause, UnboundName};
use crate::ir::{self, Base, BindingId, BlockSlot, Renumbering, Rewrite, StepId, Term, Ty};

/// Paths through a step that were resolved so far.
pub(super) struct Fork {
    step: StepId,
    scope: ScopeMark,
    /// Numbers of steps and bindings after the first path.
    first: (usize, usize),
    paths: Vec<Path>,
}

/// One path through a step.
struct Path {
    /// Names that it binds, the latest last.
    entries: Vec<ScopeEntry>,
    /// False if control never reaches its end.
    goes_on: bool,
    /// Reason for which a name that it does not bind is not bound behind the step.
    lacks: Unbound,
}

/// A name with its entry on each path that has one, in the order of the paths.
type Found = SmallVec<[(usize, ScopeEntry); 2]>;

impl Fork {
    /// The step whose paths they are.
    pub(super) fn step(&self) -> StepId {
        self.step
    }
}

impl StepResolver<'_> {
    /// Begins the paths through a step.
    pub(super) fn fork(&self, step: StepId) -> Fork {
        Fork { step, scope: self.elaborator.scope.mark(), first: (0, 0), paths: Vec::new() }
    }

    /// Resolves a block as the next path. The paths behind it do not see its names, for the reason `unseen`.
    pub(super) fn path(
        &mut self,
        fork: &mut Fork,
        block: (&Block, BlockSlot),
        name: &str,
        unseen: &Unbound,
    ) -> ir::Block {
        self.path_with(fork, block, name, unseen, Vec::new())
    }

    /// The same with names of its own, which no step behind it sees. A name that hides another one is no
    /// part of the path: what it hides is seen again.
    pub(super) fn path_with(
        &mut self,
        fork: &mut Fork,
        (block, slot): (&Block, BlockSlot),
        name: &str,
        unseen: &Unbound,
        own: Vec<ScopeEntry>,
    ) -> ir::Block {
        let inside = self.elaborator.scope.mark();
        let count = own.len();
        self.elaborator.scope.extend(own);
        let outer = std::mem::replace(&mut self.goes_on, true);
        let body = self.block(block, Some(fork.step), slot);
        let goes_on = std::mem::replace(&mut self.goes_on, outer);
        let mut entries = self.elaborator.scope.take_since(inside);
        let scope = &mut self.elaborator.scope;
        let is_hidden = |entry: &ScopeEntry| scope.find(&entry.name).is_some();
        let own = entries.drain(..count).filter(|entry| !is_hidden(entry));
        let own: Vec<_> = own.map(|entry| without_value(&entry, &Unbound::Caught)).collect();
        entries.splice(..0, own);
        let unseen: Vec<_> = entries
            .iter()
            .filter(|entry| scope.find(&entry.name).is_none())
            .map(|entry| without_value(entry, unseen))
            .collect();
        scope.extend(unseen);
        let end = block.steps.last().map_or(block.span, |step| step.span);
        self.add(fork, Path { entries, goes_on, lacks: Unbound::Path { name: name.into(), end } });
        body
    }

    /// Adds the path around an `if` whose condition does not hold.
    pub(super) fn path_around(&mut self, fork: &mut Fork, condition: Span) {
        let lacks = Unbound::NoElse(condition);
        self.add(fork, Path { entries: Vec::new(), goes_on: true, lacks });
    }

    fn add(&mut self, fork: &mut Fork, path: Path) {
        if fork.paths.is_empty() {
            fork.first = (self.program.steps.len(), self.elaborator.bindings.len());
        }
        fork.paths.push(path);
    }

    /// Leaves names that were bound since a mark without a value.
    pub(super) fn leave(&mut self, mark: ScopeMark, reason: &Unbound) {
        let entries = self.elaborator.scope.take_since(mark);
        self.elaborator.scope.extend(entries.iter().map(|entry| without_value(entry, reason)));
    }

    /// Leads behind a step of which one path is taken.
    pub(super) fn meet(&mut self, fork: Fork) {
        let Fork { scope, first, mut paths, .. } = fork;
        self.elaborator.scope.back_to(scope);
        let live: Vec<usize> = (0..paths.len()).filter(|path| is_live(&paths, *path)).collect();
        let open = live.first().and_then(|path| paths.get(*path)).filter(|_| live.len() < paths.len());
        if let Some(open) = open.filter(|_| self.goes_on) {
            self.result.open_path = Some(open.lacks.clone());
        }
        self.goes_on &= !live.is_empty();
        let (mut entries, mut shared) = (Vec::new(), Vec::new());
        for found in by_name(&mut paths) {
            let missing =
                live.iter().find(|path| !found.iter().any(|(at, entry)| at == *path && is_bound(entry)));
            let Some((_, first)) = found.iter().find(|(_, entry)| is_bound(entry)).or(found.first()) else {
                continue;
            };
            // Nothing runs behind a step that never goes on.
            if live.is_empty() {
                entries.push(first.clone());
                continue;
            }
            // On all paths that go on it is what it was before.
            let is_met = found.iter().any(|(path, _)| is_live(&paths, *path));
            if !is_met && self.elaborator.scope.find(&first.name).is_some() {
                continue;
            }
            let Some(missing) = missing else {
                let bound =
                    found.into_iter().filter(|(path, _)| is_live(&paths, *path)).map(|(_, entry)| entry);
                entries.extend(self.joined(bound.collect(), &mut shared));
                continue;
            };
            let own =
                found.iter().find(|(path, _)| path == missing).and_then(|(_, entry)| entry.unbound.as_ref());
            let cause = match (own, paths.get(*missing)) {
                (Some(unbound), _) => unbound.cause.clone(),
                (None, Some(path)) => UnboundCause::Unbound(path.lacks.clone()),
                (None, None) => continue,
            };
            entries.push(unbound(first, cause, found.iter().map(|(_, entry)| entry)));
        }
        self.share(first, shared, &mut entries);
        self.elaborator.scope.extend(entries.into_iter().map(free));
    }

    /// Leads behind a step of which all paths are taken at once.
    pub(super) fn meet_all(&mut self, fork: Fork) {
        let Fork { scope, mut paths, .. } = fork;
        self.elaborator.scope.back_to(scope);
        self.goes_on &= paths.iter().all(|path| path.goes_on);
        let found = by_name(&mut paths).into_iter();
        let entries = found.filter_map(|found| {
            let mut bound = found.iter().map(|(_, entry)| entry).filter(|entry| is_bound(entry));
            match (bound.next(), bound.next()) {
                (None, _) => found.first().map(|(_, entry)| entry.clone()),
                (Some(only), None) => Some(only.clone()),
                (Some(first), Some(second)) => {
                    let cause = UnboundCause::Unbound(Unbound::TwoBranches { second: second.span });
                    Some(unbound(first, cause, found.iter().map(|(_, entry)| entry)))
                }
            }
        });
        self.elaborator.scope.extend(entries.map(free));
    }

    /// Entry of a name that all paths have bound, if their types are the same. Adds the bindings that become
    /// one.
    fn joined(&mut self, bound: Vec<ScopeEntry>, shared: &mut Vec<Vec<BindingId>>) -> Option<ScopeEntry> {
        let first = bound.first()?;
        if bound.iter().any(|entry| entry.ty.base == Base::Unknown) {
            // An error that was reported.
            bound.iter().flat_map(ids).for_each(|id| self.elaborator.count_use(id));
            return Some(ScopeEntry { term: Term::Unknown, ty: Ty::UNKNOWN, ..first.clone() });
        }
        if let Some(second) = bound.iter().find(|entry| entry.ty != first.ty) {
            let types = [first.ty, second.ty].map(|ty| self.elaborator.library.type_name(ty).into());
            return Some(unbound(first, UnboundCause::Types { types, second: second.span }, bound.iter()));
        }
        if bound.len() > 1 {
            shared.push(bound.iter().flat_map(ids).collect());
        }
        let value = first.value.clone().filter(|_| bound.iter().all(|entry| entry.value == first.value));
        Some(ScopeEntry { value, ..first.clone() })
    }

    /// Makes each group of bindings one: the first of it. All others stand in the paths behind the first.
    fn share(
        &mut self,
        (first_step, first): (usize, usize),
        groups: Vec<Vec<BindingId>>,
        entries: &mut [ScopeEntry],
    ) {
        if groups.is_empty() {
            return;
        }
        let mut one_of: FxHashMap<BindingId, BindingId> = FxHashMap::default();
        for group in groups {
            if let Some((one, others)) = group.split_first() {
                one_of.extend(others.iter().map(|other| (*other, *one)));
            }
        }
        let bindings = &mut self.elaborator.bindings;
        let id = |index: usize| BindingId(u32::try_from(index).unwrap_or(u32::MAX));
        let mut merged: FxHashMap<BindingId, Vec<ir::Binding>> = FxHashMap::default();
        let mut new = Renumbering { first, ids: Vec::new() };
        for (index, binding) in (first..).zip(bindings.split_off(first.min(bindings.len()))) {
            match one_of.get(&id(index)) {
                // The one stands before the others, so its own number is final.
                Some(one) => {
                    let mut one = *one;
                    new.binding(&mut one);
                    new.ids.push(one);
                    merged.entry(one).or_default().push(binding);
                }
                None => {
                    new.ids.push(id(bindings.len()));
                    bindings.push(binding);
                }
            }
        }
        for (one, others) in merged {
            if let Some(binding) = bindings.get_mut(one.index()) {
                binding.merge(others);
            }
        }
        for step in self.program.steps.iter_mut().skip(first_step) {
            new.kind(&mut step.kind);
        }
        self.result.renumber(&new);
        for entry in entries.iter_mut() {
            new.term(&mut entry.term);
            new.terms(&mut entry.value);
            entry.unbound.iter_mut().flat_map(|unbound| &mut unbound.ids).for_each(|id| new.binding(id));
        }
    }
}

fn free(entry: ScopeEntry) -> ScopeEntry {
    ScopeEntry { is_free: true, ..entry }
}

fn is_live(paths: &[Path], path: usize) -> bool {
    paths.get(path).is_some_and(|path| path.goes_on)
}

fn is_bound(entry: &ScopeEntry) -> bool {
    entry.unbound.is_none()
}

/// The names of all paths, each with its latest entries, in the order in which they were bound first.
fn by_name(paths: &mut [Path]) -> Vec<Found> {
    let mut places: FxHashMap<SmolStr, usize> = FxHashMap::default();
    let mut all: Vec<Found> = Vec::new();
    for (index, path) in paths.iter_mut().enumerate() {
        for entry in std::mem::take(&mut path.entries) {
            let place = *places.entry(entry.name.clone()).or_insert_with(|| {
                all.push(Found::new());
                all.len() - 1
            });
            let Some(found) = all.get_mut(place) else { continue };
            match found.last_mut() {
                Some((known, earlier)) if *known == index => *earlier = entry,
                _ => found.push((index, entry)),
            }
        }
    }
    all
}

fn ids(entry: &ScopeEntry) -> SmallVec<[BindingId; 1]> {
    match (&entry.unbound, &entry.term) {
        (Some(unbound), _) => unbound.ids.clone(),
        (None, Term::Binding(id)) => SmallVec::from_elem(*id, 1),
        (None, _) => SmallVec::new(),
    }
}

/// The entry of a name without a value.
fn unbound<'e>(
    entry: &ScopeEntry,
    cause: UnboundCause,
    all: impl Iterator<Item = &'e ScopeEntry>,
) -> ScopeEntry {
    let unbound = UnboundName { cause, ids: all.flat_map(ids).collect() };
    ScopeEntry { term: Term::Unknown, ty: Ty::UNKNOWN, unbound: Some(unbound), ..entry.clone() }
}

pub(super) fn without_value(entry: &ScopeEntry, reason: &Unbound) -> ScopeEntry {
    unbound(entry, UnboundCause::Unbound(reason.clone()), std::iter::once(entry))
}

//! Symbols: entities behind bindings. A description that fits exactly one entity of the scene denotes it; any
//! other binding is a symbol, an entity of its own that may be one of several.

use rustc_hash::FxHashMap;

use crate::declare::Library;
use crate::environment::Environment;
use crate::ir::{Base, Binding, Entity, Kind, NOBODY, Program, StepKind, Term, Ty};

/// Entities and symbols of the bindings.
#[derive(Clone, Debug, Default)]
pub(crate) struct Symbols {
    /// By binding, the entity or symbol for facts; `None` for other types.
    bindings: Vec<Option<Entity>>,
    symbols: Vec<Symbol>,
    first: u16,
}

/// An unknown entity.
#[derive(Clone, Debug)]
pub(crate) struct Symbol {
    pub(crate) kind: Kind,
    /// Entities that it may be; `None` for any of its kind.
    pub(crate) may_be: Option<Vec<Entity>>,
    binding: usize,
}

/// Entities that fit the descriptions of a binding; `None` if it may be another one on some path.
pub(crate) fn described(
    binding: &Binding,
    library: &Library,
    environment: &Environment,
) -> Option<Vec<Entity>> {
    let Ty { base: Base::Entity(kind), lists: 0 } = binding.ty else { return None };
    let mut all = Vec::new();
    for text in binding.descriptions.as_ref()? {
        let found = environment.described(library, text, kind);
        if found.is_empty() {
            return None;
        }
        all.extend(found);
    }
    all.sort_unstable();
    all.dedup();
    Some(all)
}

/// By the binding of an item of an `each`, the elements of its list, if they are entities that are written
/// out.
fn items(program: &Program) -> FxHashMap<usize, Vec<Entity>> {
    let entity = |term: &Term| if let Term::Entity(entity) = term { Some(*entity) } else { None };
    let loops = program.steps.iter().filter_map(|step| {
        let StepKind::Each { item, list: Term::List(terms), .. } = &step.kind else { return None };
        let mut all = terms.iter().map(entity).collect::<Option<Vec<_>>>()?;
        all.sort_unstable();
        all.dedup();
        Some((item.index(), all))
    });
    loops.collect()
}

impl Symbols {
    pub(crate) fn new(program: &Program, library: &Library, environment: &Environment) -> Self {
        let first = Self::first(environment);
        let mut table =
            Self { bindings: Vec::with_capacity(program.bindings.len()), symbols: Vec::new(), first };
        table.extend(program, library, environment);
        table
    }

    /// The number of the first symbol: they follow the entities.
    pub(crate) fn first(environment: &Environment) -> u16 {
        u16::try_from(environment.entities().len()).unwrap_or(u16::MAX)
    }

    /// Adds the bindings that the program has gained.
    pub(crate) fn extend(&mut self, program: &Program, library: &Library, environment: &Environment) {
        if self.bindings.len() >= program.bindings.len() {
            return;
        }
        let items = items(program);
        for (index, binding) in program.bindings.iter().enumerate().skip(self.bindings.len()) {
            let Ty { base: Base::Entity(kind), lists: 0 } = binding.ty else {
                self.bindings.push(None);
                continue;
            };
            let found = items.get(&index).cloned().or_else(|| described(binding, library, environment));
            let entity = match found.as_deref() {
                Some([only]) => Some(*only),
                Some([]) | None => self.add(kind, None),
                Some(several) => self.add(kind, Some(several.to_vec())),
            };
            self.bindings.push(entity);
        }
    }

    /// Numbers of bindings and symbols.
    pub(crate) fn len(&self) -> (usize, usize) {
        (self.bindings.len(), self.symbols.len())
    }

    /// Restores earlier numbers of bindings and symbols.
    pub(crate) fn truncate(&mut self, (bindings, symbols): (usize, usize)) {
        self.bindings.truncate(bindings);
        self.symbols.truncate(symbols);
    }

    /// Adds the symbol of the binding that is added next.
    fn add(&mut self, kind: Kind, may_be: Option<Vec<Entity>>) -> Option<Entity> {
        // The last numbers stand for `any` and for nobody.
        let index = u16::try_from(self.symbols.len()).ok()?.checked_add(self.first);
        let index = index.filter(|id| *id < NOBODY.0)?;
        self.symbols.push(Symbol { kind, may_be, binding: self.bindings.len() });
        Some(Entity(index))
    }

    pub(crate) fn of_binding(&self, index: usize) -> Option<Entity> {
        self.bindings.get(index).copied().flatten()
    }

    pub(crate) fn get(&self, entity: Entity) -> Option<&Symbol> {
        self.symbols.get(usize::from(entity.0.checked_sub(self.first)?))
    }

    /// The binding of a symbol.
    pub(crate) fn binding_of(&self, entity: Entity) -> Option<usize> {
        Some(self.get(entity)?.binding)
    }

    /// The symbols, in the order of their bindings.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (Entity, &Symbol)> {
        (self.first..u16::MAX).map(Entity).zip(&self.symbols)
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.symbols.is_empty()
    }

    pub(crate) fn kind(&self, environment: &Environment, entity: Entity) -> Option<Kind> {
        environment.entities().kind(entity).or_else(|| self.get(entity).map(|symbol| symbol.kind))
    }

    /// Returns whether two entities may be the same.
    pub(crate) fn may_equal(
        &self,
        library: &Library,
        environment: &Environment,
        a: Entity,
        b: Entity,
    ) -> bool {
        if a == b {
            return true;
        }
        match (self.get(a), self.get(b)) {
            (None, None) => false,
            (Some(symbol), None) => Self::may_be(library, environment, symbol, b),
            (None, Some(symbol)) => Self::may_be(library, environment, symbol, a),
            (Some(one), Some(two)) => match (&one.may_be, &two.may_be) {
                (Some(list), _) => list.iter().any(|entity| Self::may_be(library, environment, two, *entity)),
                (None, Some(list)) => {
                    list.iter().any(|entity| Self::may_be(library, environment, one, *entity))
                }
                (None, None) => library.is_kind(one.kind, two.kind) || library.is_kind(two.kind, one.kind),
            },
        }
    }

    fn may_be(library: &Library, environment: &Environment, symbol: &Symbol, entity: Entity) -> bool {
        match &symbol.may_be {
            Some(list) => list.contains(&entity),
            None => {
                environment.entities().kind(entity).is_some_and(|kind| library.is_kind(kind, symbol.kind))
            }
        }
    }
}

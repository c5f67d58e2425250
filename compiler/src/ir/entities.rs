//! Table of entities.

use rustc_hash::FxHashMap;
use smol_str::SmolStr;

use super::{Entity, Kind};

/// Maximal number of entities of an environment. Higher indices are symbols of the prover.
pub const MAX_ENTITIES: usize = 40_000;

/// Entities in order, and by name.
#[derive(Clone, PartialEq, Debug, Default)]
pub(crate) struct Entities {
    list: Vec<(SmolStr, Kind)>,
    names: FxHashMap<SmolStr, Entity>,
}

impl Entities {
    /// Adds an entity; `None` if the name is taken or the table is full.
    pub(crate) fn add(&mut self, name: SmolStr, kind: Kind) -> Option<Entity> {
        if self.list.len() >= MAX_ENTITIES || self.names.contains_key(&name) {
            return None;
        }
        let id = Entity(u16::try_from(self.list.len()).ok()?);
        self.names.insert(name.clone(), id);
        self.list.push((name, kind));
        Some(id)
    }

    pub(crate) fn find(&self, name: &str) -> Option<(Entity, Kind)> {
        let id = *self.names.get(name)?;
        Some((id, self.kind(id)?))
    }

    pub(crate) fn kind(&self, id: Entity) -> Option<Kind> {
        self.list.get(id.index()).map(|(_, kind)| *kind)
    }

    pub(crate) fn name(&self, id: Entity) -> Option<&SmolStr> {
        self.list.get(id.index()).map(|(name, _)| name)
    }

    pub(crate) fn len(&self) -> usize {
        self.list.len()
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = (Entity, &SmolStr, Kind)> {
        self.list
            .iter()
            .enumerate()
            .filter_map(|(index, (name, kind))| Some((Entity(u16::try_from(index).ok()?), name, *kind)))
    }
}

//! Solids of imported rooms.

use smol_str::SmolStr;

use crate::scene::{Entity, EntityShape, Placement};

/// Greatest number of solids of one imported scene. Each is an obstacle of every motion.
pub const MAX_SOLIDS: usize = 5_000;

/// Entity of an imported solid: an obstacle without a use of its own.
pub(super) fn entity(id: SmolStr, kind: &'static str, pose: Placement, shape: EntityShape) -> Entity {
    let mut entity = Entity::place(id, pose);
    entity.kind = SmolStr::new_static(kind);
    entity.shape = Some(shape);
    entity
}

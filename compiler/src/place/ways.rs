//! The worlds that may be met at a step.

use std::sync::Arc;

use motet_geometry::planning::SceneState;
use smol_str::SmolStr;

use crate::ir::StepId;

/// The most worlds that are followed at once.
pub(super) const MOST_WORLDS: usize = 8;

/// A world with its fingerprint: two are the same where their fingerprints are.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Keyed {
    pub(super) world: SceneState,
    pub(super) key: Box<[u8]>,
}

/// A world, and which steps made it so.
#[derive(Clone, Debug)]
pub(super) struct Situation {
    pub(super) at: Arc<Keyed>,
    /// The step that brought the robot where it stands.
    pub(super) stands_since: Option<StepId>,
    /// The step that took what is in the hand.
    pub(super) held_since: Option<StepId>,
    /// What was opened, closed or put somewhere, and by which step.
    pub(super) changed: Vec<(SmolStr, StepId)>,
    /// Whether control comes here for certain on some way; after a failure it may have stopped earlier.
    pub(super) is_certain: bool,
}

impl Situation {
    /// The step that changed an entity last.
    pub(super) fn changer(&self, entity: &str) -> Option<StepId> {
        self.changed.iter().rev().find(|(name, _)| name == entity).map(|(_, step)| *step)
    }
}

/// All that may be the case at a step; nothing where no way leads there.
#[derive(Clone, Debug, Default)]
pub(super) struct Ways {
    pub(super) known: Vec<Situation>,
    /// Why there are worlds beside the known ones, if so.
    pub(super) lost: Option<SmolStr>,
}

impl Ways {
    pub(super) fn lost(why: SmolStr) -> Self {
        Self { known: Vec::new(), lost: Some(why) }
    }

    pub(super) fn is_nowhere(&self) -> bool {
        self.known.is_empty() && self.lost.is_none()
    }

    /// Adds the worlds of another; whether any was new.
    pub(super) fn join(&mut self, other: Self) -> bool {
        let mut is_new = self.lost.is_none() && other.lost.is_some();
        self.lost = self.lost.take().or(other.lost);
        for situation in other.known {
            let is_full = self.known.len() >= MOST_WORLDS;
            match self.known.iter_mut().find(|known| known.at.key == situation.at.key) {
                Some(known) => known.is_certain |= situation.is_certain,
                None if !is_full => {
                    self.known.push(situation);
                    is_new = true;
                }
                None => {
                    is_new |= self.lost.is_none();
                    self.lost = self.lost.take().or(Some(too_many()));
                }
            }
        }
        is_new
    }

    /// The same worlds, of which it is not certain that they are met.
    pub(super) fn uncertain(mut self) -> Self {
        self.known.iter_mut().for_each(|situation| situation.is_certain = false);
        self
    }
}

fn too_many() -> SmolStr {
    smol_str::format_smolstr!("more than {MOST_WORLDS} different worlds may be met here")
}

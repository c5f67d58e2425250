//! Sets of possible worlds at a program point.

use std::sync::Arc;

use motet_geometry::planning::SceneState;
use smol_str::SmolStr;

use crate::ir::StepId;

/// Maximal number of possible worlds at a program point.
pub(super) const MOST_WORLDS: usize = 8;

/// SceneState with its fingerprint; equal fingerprints mean equal worlds.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Fingerprinted {
    pub(super) world: SceneState,
    pub(super) key: Box<[u8]>,
}

/// A possible world, with the steps that led to it.
#[derive(Clone, Debug)]
pub(super) struct PossibleWorld {
    pub(super) at: Arc<Fingerprinted>,
    /// Step that brought the robot to its pose.
    pub(super) stands_since: Option<StepId>,
    /// Step that took the thing in the hand.
    pub(super) held_since: Option<StepId>,
    /// Things that were opened, closed or put somewhere, with the step.
    pub(super) changed: Vec<(SmolStr, StepId)>,
    /// True if the program point is certainly reached in this world on some path; after a failure it may not
    /// be.
    pub(super) is_certain: bool,
}

impl PossibleWorld {
    /// Step that changed an entity last.
    pub(super) fn changer(&self, entity: &str) -> Option<StepId> {
        self.changed.iter().rev().find(|(name, _)| name == entity).map(|(_, step)| *step)
    }
}

/// Possible worlds at a program point; empty if no path leads there.
#[derive(Clone, Debug, Default)]
pub(super) struct Worlds {
    pub(super) known: Vec<PossibleWorld>,
    /// InfeasibleReason why other worlds than the known ones are possible, if they are.
    pub(super) lost: Option<SmolStr>,
}

impl Worlds {
    pub(super) fn lost(why: SmolStr) -> Self {
        Self { known: Vec::new(), lost: Some(why) }
    }

    pub(super) fn is_nowhere(&self) -> bool {
        self.known.is_empty() && self.lost.is_none()
    }

    /// Adds the worlds of another set; returns whether any was new.
    pub(super) fn join(&mut self, other: Self) -> bool {
        let mut is_new = self.lost.is_none() && other.lost.is_some();
        self.lost = self.lost.take().or(other.lost);
        for possible in other.known {
            let is_full = self.known.len() >= MOST_WORLDS;
            match self.known.iter_mut().find(|known| known.at.key == possible.at.key) {
                Some(known) => known.is_certain |= possible.is_certain,
                None if !is_full => {
                    self.known.push(possible);
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

    /// The same worlds, which may not be reached.
    pub(super) fn uncertain(mut self) -> Self {
        self.known.iter_mut().for_each(|possible| possible.is_certain = false);
        self
    }
}

fn too_many() -> SmolStr {
    smol_str::format_smolstr!("more than {MOST_WORLDS} different worlds may be met here")
}

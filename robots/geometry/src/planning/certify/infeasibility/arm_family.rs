//! Arm families: arms whose inverse kinematics has an interval solution over cells.

use nalgebra::Isometry3;

use crate::inverse::interval::{IkCell, IntervalSolution, PoseSet};
use crate::inverse::{LiftArm, ParallelArm, SevenArm};

/// Arm whose solutions are covered by cells.
#[derive(Clone, Copy)]
pub(super) enum ArmFamily<'a> {
    Lift(&'a LiftArm),
    /// Arm, and the height of the base's link above the floor in m.
    Parallel(&'a ParallelArm, f64),
    /// Arm, the pose of the base's link, and the base's pose.
    Seven(&'a SevenArm, Isometry3<f64>, [f64; 3]),
    /// Any other arm: only the hand is covered.
    Any,
}

impl ArmFamily<'_> {
    pub(super) fn cells(self) -> Vec<IkCell> {
        match self {
            Self::Lift(arm) => arm.cells(),
            Self::Parallel(arm, _) => arm.cells(),
            Self::Seven(arm, ..) => arm.cells(),
            Self::Any => vec![IkCell { branch: 0, middle: [0.0; 3], half: [0.0; 3] }],
        }
    }

    pub(super) fn weights(self) -> [f64; 3] {
        match self {
            Self::Lift(arm) => arm.weights(),
            Self::Parallel(arm, _) => arm.weights(),
            Self::Seven(arm, ..) => arm.weights(),
            Self::Any => [0.0; 3],
        }
    }

    pub(super) fn over(self, tips: &PoseSet, cell: &IkCell) -> IntervalSolution {
        match self {
            Self::Lift(arm) => arm.enclose(tips, cell),
            Self::Parallel(arm, height) => arm.enclose(tips, height, cell),
            Self::Seven(arm, map_from_base, base) => arm.enclose(tips, &map_from_base, base, cell),
            Self::Any => IntervalSolution::Unknown,
        }
    }
}

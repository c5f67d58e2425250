//! Inverse kinematics of one arm: in closed form where its chain has one, else in steps.

use motet_robots::card::Drive;
use nalgebra::Isometry3;

use crate::inverse::{LiftArm, ParallelArm, SevenArm, Tolerance, numeric};
use crate::kinematics::KinematicChain;

/// Greatest change of a joint between two points of a hand path, in rad or m.
const JUMP: f64 = 0.5;

/// Solver for the inverse kinematics of one arm, chosen by the shape of its chain.
#[derive(Clone, Debug)]
pub enum IkSolver {
    /// Lift with a spherical wrist, on a base that drives in every direction.
    Lift(LiftArm),
    /// Six joints, three of them parallel.
    Parallel(ParallelArm),
    /// Seven joints as in the Franka arms.
    Seven(SevenArm),
    /// Any other chain: damped least squares.
    Steps(KinematicChain),
}

impl IkSolver {
    /// Chooses the solver of a chain on a base with a drive, whose link is `height` m above the floor.
    #[must_use]
    pub fn of(chain: &KinematicChain, drive: Drive, height: f64) -> Self {
        let drives_anywhere = matches!(drive, Drive::Omnidirectional | Drive::Legged);
        let lift =
            LiftArm::detect(chain).filter(|_| drives_anywhere).map(|arm| Self::Lift(arm.raised(height)));
        let parallel = || ParallelArm::detect(chain).map(Self::Parallel);
        let seven = || SevenArm::detect(chain).map(Self::Seven);
        lift.or_else(parallel).or_else(seven).unwrap_or_else(|| Self::Steps(chain.clone()))
    }

    /// Kinematic chain from the base's link to the tip.
    #[must_use]
    pub fn chain(&self) -> &KinematicChain {
        match self {
            Self::Lift(arm) => arm.chain(),
            Self::Parallel(arm) => arm.chain(),
            Self::Seven(arm) => arm.chain(),
            Self::Steps(chain) => chain,
        }
    }

    /// Joint values for a tip pose near to the one of `values`, without a jump to another branch.
    pub(crate) fn followed(&self, base_from_tip: &Isometry3<f64>, values: &[f64]) -> Option<Vec<f64>> {
        let is_near = |next: &Vec<f64>| next.iter().zip(values).all(|(a, b)| (a - b).abs() <= JUMP);
        let closed = match self {
            // The closed form finds all solutions, so none is near where the nearest is not.
            Self::Parallel(arm) => {
                return arm.nearest(base_from_tip, values.try_into().ok()?).map(Vec::from).filter(is_near);
            }
            Self::Seven(arm) => {
                let last = values.last().copied().unwrap_or_default();
                arm.nearest(base_from_tip, &[last], values, 1).pop().map(Vec::from)
            }
            Self::Lift(_) | Self::Steps(_) => None,
        };
        let numeric = || numeric::refined(self.chain(), base_from_tip, values, 20, Tolerance::EXACT);
        // A jump to another branch leaves the straight line of the hand.
        closed.filter(is_near).or_else(|| numeric().filter(is_near))
    }
}

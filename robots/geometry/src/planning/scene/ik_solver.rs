//! How the joint positions of an arm are found: in closed form where it has one.

use motet_robots::card::Drive;
use nalgebra::Isometry3;

use crate::inverse::{LiftArm, ParallelArm, SevenArm, Tolerance, numeric};
use crate::kinematics::KinematicChain;

/// The largest change of a joint between two places on a line that the hand follows, in rad or m.
const JUMP: f64 = 0.5;

/// How an arm is solved.
#[derive(Clone, Debug)]
pub enum IkSolver {
    /// A lift with a spherical wrist on a base that drives anywhere.
    Lift(LiftArm),
    /// Six joints of which three are parallel.
    Parallel(ParallelArm),
    /// Seven joints as of the Franka arms.
    Seven(SevenArm),
    /// Any other chain, in steps.
    Steps(KinematicChain),
}

impl IkSolver {
    /// How the arm of a chain is solved on a base that drives so, whose link is so high above the floor, in m.
    #[must_use]
    pub fn of(chain: &KinematicChain, drive: Drive, height: f64) -> Self {
        let drives_anywhere = matches!(drive, Drive::Omnidirectional | Drive::Legged);
        let lift =
            LiftArm::detect(chain).filter(|_| drives_anywhere).map(|arm| Self::Lift(arm.raised(height)));
        let parallel = || ParallelArm::detect(chain).map(Self::Parallel);
        let seven = || SevenArm::detect(chain).map(Self::Seven);
        lift.or_else(parallel).or_else(seven).unwrap_or_else(|| Self::Steps(chain.clone()))
    }

    /// The arm's chain, from the base's link to the tip.
    #[must_use]
    pub fn chain(&self) -> &KinematicChain {
        match self {
            Self::Lift(arm) => arm.chain(),
            Self::Parallel(arm) => arm.chain(),
            Self::Seven(arm) => arm.chain(),
            Self::Steps(chain) => chain,
        }
    }

    /// Values of the arm's variables that put the tip at a pose a little way from where it is with others: near to these.
    pub(crate) fn followed(&self, base_from_tip: &Isometry3<f64>, values: &[f64]) -> Option<Vec<f64>> {
        let is_near = |next: &Vec<f64>| next.iter().zip(values).all(|(a, b)| (a - b).abs() <= JUMP);
        let closed = match self {
            // All solutions are known, so that there is none nearby where the nearest is not.
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
        // Another branch of the arm is no straight line.
        closed.filter(is_near).or_else(|| numeric().filter(is_near))
    }
}

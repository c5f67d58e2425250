//! Ways to where a line of the hand begins, searched for when nothing simple does. Base and arm move together where the base goes in every
//! direction: out of a drawer, or between what stands closer than the robot is wide when it is taken for a disc.

use std::f64::consts::TAU;

use crate::planning::checking::collision_checker::CollisionChecker;
use crate::planning::scene::configuration::Configuration;
use crate::planning::scene::contact::AllowedCollisions;
use crate::planning::search::path::plane;
use crate::planning::search::rrt_connect::{PlannedJoints, RrtEffort};

/// How far from where the line begins the base stands with the arm as it was, in m.
const OUT: [f64; 11] = [0.3, 0.45, 0.6, 0.2, 0.1, 0.0, 0.8, 1.0, 1.3, 1.6, 2.0];
/// Directions in which that may be.
const DIRECTIONS: usize = 16;

impl CollisionChecker<'_, '_> {
    /// A way from where the robot is to the beginning of a line of states, which is free, and then along the line. The robot comes from
    /// where the line leads `inwards`, most often.
    pub(crate) fn lead(
        &self,
        line: &[Configuration],
        inwards: [f64; 2],
        effort: RrtEffort,
    ) -> Option<Vec<Configuration>> {
        let context = self.context;
        let first = line.first()?;
        let (from, moving) = if context.slides() {
            (self.landing(first, inwards)?, PlannedJoints::All)
        } else {
            let folded = Configuration { base: first.base, joints: context.state.robot.joints.clone() };
            if self.contact(&folded, AllowedCollisions::default()).is_some() || !context.is_drivable(&folded)
            {
                return None;
            }
            (folded, PlannedJoints::Arm)
        };
        let mut configurations = self.connect(&from, first, moving, effort)?;
        configurations.extend(line.iter().skip(1).cloned());
        context.driven(configurations)
    }

    /// A place near a state to which the base drives with the arm as it was.
    fn landing(&self, near: &Configuration, [x, y]: [f64; 2]) -> Option<Configuration> {
        let context = self.context;
        let [near_x, near_y, yaw] = near.base;
        let outwards = libm::atan2(-y, -x);
        let folded = |far: f64, step: usize| {
            let turn = step.div_ceil(2) as f64 * if step.is_multiple_of(2) { 1.0 } else { -1.0 };
            let (sin, cos) = libm::sincos(outwards + turn * TAU / DIRECTIONS as f64);
            Configuration {
                base: [near_x + cos * far, near_y + sin * far, yaw],
                joints: context.state.robot.joints.clone(),
            }
        };
        let mut places = OUT.into_iter().flat_map(|far| (0..DIRECTIONS).map(move |step| (far, step)));
        places.find_map(|(far, step)| {
            let place = folded(far, step);
            (context.is_at_home(plane(&place)) && context.is_drivable(&place)).then_some(place)
        })
    }
}

//! Which joints move a link, to bound how far any of its points can go.

use nalgebra::{Unit, Vector3};

use super::tree::{Driver, Motion, Tree};

/// A joint on the way from the root to a link.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Lever {
    /// Index of the link whose frame sits in the joint.
    pub frame: usize,
    /// Its axis or direction, in that frame.
    pub axis: Unit<Vector3<f64>>,
    /// Whether it slides, and does not turn.
    pub slides: bool,
    /// Its position in terms of a configuration.
    pub driver: Driver,
}

impl Tree {
    /// The joints that move a link, by index, root first. Of a planar joint the directions are those of its frame as
    /// turned, which leaves their lengths as they are. O(links).
    #[must_use]
    pub fn levers(&self, link: usize) -> Vec<Lever> {
        let mut levers = Vec::new();
        for step in self.steps_to(link).into_iter().filter_map(|step| self.steps.get(step)) {
            let mut add = |axis, slides, driver| {
                levers.push(Lever { frame: step.child, axis, slides, driver });
            };
            match &step.motion {
                Motion::Fixed => {}
                Motion::Turn(axis, driver) => add(*axis, false, *driver),
                Motion::Slide(axis, driver) => add(*axis, true, *driver),
                Motion::Planar { axes: [x, y, normal], first } => {
                    for (axis, slides, variable) in
                        [(x, true, *first), (y, true, first + 1), (normal, false, first + 2)]
                    {
                        add(*axis, slides, Driver { variable, multiplier: 1.0, offset: 0.0 });
                    }
                }
            }
        }
        levers
    }
}

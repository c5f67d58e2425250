//! What touches what: the robot itself, the things around, the floor. How that is found is in `around`.

use nalgebra::Vector3;
use smol_str::SmolStr;

use crate::collision::Solid;
use crate::planning::scene::configuration::Configuration;
use crate::planning::search::context::QueryContext;
use crate::planning::search::path::plane;

/// Padding of every check: the least distance between any two bodies that may not touch, in m.
pub const MIN_CLEARANCE: f64 = 0.002;

/// What may touch what, beside what always may.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct AllowedCollisions {
    /// The hand may touch this entity: it is about to be grasped or has just been let go.
    pub hand: Option<usize>,
    /// What is in the hand may touch this entity: it stands on it.
    pub held: Option<usize>,
}

/// Two things that touch.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Contact {
    /// The robot's link; that of the hand for what is in it.
    pub link: SmolStr,
    /// What it touches: an entity, another link, or `floor`.
    pub other: SmolStr,
    /// Whether that is a part of the robot.
    pub is_own: bool,
}

/// What a pair of solids is looked at for.
#[derive(Clone, Copy)]
pub(crate) enum ContactTarget {
    Obstacle(usize),
    Part(usize),
    Floor,
}

impl QueryContext<'_> {
    /// The first touch in a state, with [`MIN_CLEARANCE`](super::GAP) between everything. O(parts × obstacles near).
    #[must_use]
    pub fn contact(&self, configuration: &Configuration, allowed: AllowedCollisions) -> Option<Contact> {
        self.along(configuration, configuration).contact(configuration, allowed)
    }

    /// The same of each of some states, eight at a time: faster the nearer they are to each other.
    #[must_use]
    pub fn contacts(
        &self,
        configurations: &[Configuration],
        allowed: AllowedCollisions,
    ) -> Vec<Option<Contact>> {
        let checker = self.all_around(configurations, MIN_CLEARANCE);
        let eights = configurations
            .chunks(8)
            .map(|configurations| configurations.iter().collect::<Vec<&Configuration>>());
        eights.flat_map(|configurations| checker.contacts(&configurations, allowed)).collect()
    }

    /// The least distance between the robot and what stands around, the floor included, in m; nothing above 1 m is looked for.
    #[must_use]
    pub fn clearance(&self, configuration: &Configuration, allowed: AllowedCollisions) -> f64 {
        self.around(plane(configuration), 1.0).clearance(configuration, allowed, 1.0)
    }

    /// Whether the straight way between two states is free throughout.
    ///
    /// # Errors
    ///
    /// What touches on the way, or comes so near that nothing certain can be said.
    pub fn edge(
        &self,
        from: &Configuration,
        to: &Configuration,
        allowed: AllowedCollisions,
    ) -> Result<(), Contact> {
        self.along(from, to).edge(from, to, allowed)
    }

    pub(crate) fn told(&self, part: usize, other: ContactTarget) -> Contact {
        let link = |part: usize| {
            let link = self.body.parts().get(part).map_or(0, |part| part.link);
            self.model.tree().links().get(link).cloned().unwrap_or_default()
        };
        let (other, is_own) = match other {
            ContactTarget::Obstacle(at) => {
                (self.obstacles.get(at).map_or_else(SmolStr::default, |it| self.name(it.entity)), false)
            }
            ContactTarget::Part(at) => (link(at), true),
            ContactTarget::Floor => (SmolStr::new_static("floor"), false),
        };
        Contact { link: link(part), other, is_own }
    }
}

/// The greatest distance of a solid's points from the vertical through a point, and the heights between which it is.
pub(crate) fn about_vertical(solid: &Solid, x: f64, y: f64) -> (f64, [f64; 2]) {
    let up = solid.extent(&Vector3::z());
    let aside = libm::hypot(solid.centre.x - x, solid.centre.y - y);
    // Along the way from the vertical to the centre it extends so far; a box's corners may be farther than that.
    let wide = match solid.shape {
        crate::collision::Shape::Capsule { radius, half }
        | crate::collision::Shape::Cylinder { radius, half } => {
            let [_, _, z] = &solid.axes;
            let end = |sign: f64| {
                let end = solid.centre + z * (half * sign);
                libm::hypot(end.x - x, end.y - y)
            };
            end(1.0).max(end(-1.0)) + radius
        }
        crate::collision::Shape::Box(_) | crate::collision::Shape::HalfSpace => aside + solid.reach(),
    };
    (wide, [solid.centre.z - up, solid.centre.z + up])
}

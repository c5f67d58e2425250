//! Obstacles of a planning scene, listed by square of the floor so that a search near a place does not visit
//! all, and contacts with them.

use motet_robots::clearance::Clearance;
use nalgebra::Vector3;
use smol_str::SmolStr;

use crate::collision::Solid;

/// Padding of every check: the least distance between any two bodies that may not touch, in m.
pub const MIN_CLEARANCE: f64 = 0.002;
/// Part of the distance at the start that a motion may give up beside an obstacle that is nearer than the
/// clearance there, in m: room for the certificate of the first edge.
const LEEWAY: f64 = 0.001;

/// Distances in m that the groups of the robot's parts keep from one obstacle, at least [`MIN_CLEARANCE`].
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Padding {
    pub(crate) base: f64,
    pub(crate) arm: f64,
}

impl Padding {
    /// Padding without a clearance.
    pub(crate) const LEAST: Self = Self { base: MIN_CLEARANCE, arm: MIN_CLEARANCE };

    pub(crate) fn new(clearance: Clearance) -> Self {
        Self { base: clearance.base_m.max(MIN_CLEARANCE), arm: clearance.arm_m.max(MIN_CLEARANCE) }
    }

    /// Distance of the arm, or of the other parts.
    pub(crate) fn of(&self, is_carried: bool) -> f64 {
        if is_carried { self.arm } else { self.base }
    }

    /// The greater of both distances.
    pub(crate) fn most(&self) -> f64 {
        self.base.max(self.arm)
    }

    /// The smaller distances of two.
    pub(crate) fn least(self, other: Self) -> Self {
        Self { base: self.base.min(other.base), arm: self.arm.min(other.arm) }
    }

    /// Lets the parts of a group stay where they are: as near as `metres`.
    pub(crate) fn permit(&mut self, is_carried: bool, metres: f64) {
        let slot = if is_carried { &mut self.arm } else { &mut self.base };
        *slot = slot.min((metres - LEEWAY).max(MIN_CLEARANCE));
    }
}

/// Pairs that may be in contact, besides those that always may.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct AllowedCollisions {
    /// Index of the entity that the hand may touch: the one about to be grasped or just released.
    pub hand: Option<usize>,
    /// Index of the entity that the held object may touch: the one on which it stands.
    pub held: Option<usize>,
    /// Index of the entity to which the hand may come nearer than the clearance: the support of the object
    /// that it grasps or released, or the container whose handle it grasps.
    pub near: Option<usize>,
    /// Set before the last approach: the hand and the held object may come near to these entities, but touch
    /// none.
    pub(crate) is_before: bool,
}

impl AllowedCollisions {
    /// No contact, but the hand near an entity.
    #[must_use]
    pub(crate) fn near(entity: usize) -> Self {
        Self { near: Some(entity), ..Self::default() }
    }

    /// The collisions that remain allowed before the last approach.
    #[must_use]
    pub(crate) fn before(self) -> Self {
        Self { is_before: true, ..self }
    }

    /// Checks whether the hand, or the held object, may touch an entity.
    pub(crate) fn touches(self, entity: usize, is_held: bool) -> bool {
        !self.is_before && (self.hand == Some(entity) || (is_held && self.held == Some(entity)))
    }

    /// Checks whether the hand and the held object may come nearer to an entity than the clearance.
    pub(crate) fn is_near(self, entity: usize) -> bool {
        [self.near, self.held, self.hand].contains(&Some(entity))
    }
}

/// Contact between two bodies: they are closer than [`MIN_CLEARANCE`], or than the padding of an obstacle.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Contact {
    /// Link of the robot; the link of the hand for the held object.
    pub link: SmolStr,
    /// Name of the other body: an entity, another link, or `floor`.
    pub other: SmolStr,
    /// Set where the other body is a part of the robot.
    pub is_own: bool,
}

/// Other body of a checked pair.
#[derive(Clone, Copy)]
pub(crate) enum ContactTarget {
    Obstacle(usize),
    Part(usize),
    Floor,
}

/// Height of the lowest point of a solid above the floor, in m.
pub(crate) fn above_floor(solid: &Solid) -> f64 {
    solid.centre.z - solid.extent(&Vector3::z())
}

/// Side of a square in m, for scenes of up to [`SQUARES`] squares a side.
const SIDE: f64 = 1.0;
/// Greatest number of squares along a side.
const SQUARES: usize = 256;
/// Up to this number of obstacles there is no grid.
const FEW: usize = 32;

/// One solid of an entity.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Obstacle {
    /// Index of its entity in the scene.
    pub(crate) entity: usize,
    pub(crate) solid: Solid,
    /// Radius of its bounding ball, in m.
    pub(crate) reach: f64,
    pub(crate) padding: Padding,
}

impl Obstacle {
    pub(crate) fn new(entity: usize, solid: Solid, padding: Padding) -> Self {
        Self { entity, solid, reach: solid.reach(), padding }
    }
}

/// All obstacles of a scene in the scene's order, with a grid over them.
#[derive(Clone, Debug)]
pub(crate) struct ObstacleIndex {
    all: Vec<Obstacle>,
    origin: [f64; 2],
    side: f64,
    size: [usize; 2],
    /// Start of each square's list, and the end of the last.
    starts: Vec<usize>,
    /// Obstacles by the square of their centre, of those no larger than a square.
    listed: Vec<usize>,
    /// Obstacles larger than a square.
    large: Vec<usize>,
}

impl ObstacleIndex {
    /// Builds the index; O(obstacles).
    pub(crate) fn new(all: Vec<Obstacle>) -> Self {
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for obstacle in &all {
            let middle = [obstacle.solid.centre.x, obstacle.solid.centre.y];
            for ((low, high), at) in low.iter_mut().zip(&mut high).zip(middle) {
                (*low, *high) = (low.min(at), high.max(at));
            }
        }
        let span = (high[0] - low[0]).max(high[1] - low[1]).max(0.0);
        let side = SIDE.max(span / SQUARES as f64);
        let mut obstacles =
            Self { origin: low, side, size: [0, 0], starts: vec![], listed: vec![], large: vec![], all };
        if obstacles.all.len() <= FEW {
            return obstacles;
        }
        obstacles.size = [0, 1].map(|axis: usize| {
            let span = high.get(axis).zip(low.get(axis)).map_or(0.0, |(high, low)| high - low);
            libm::floor(span / side) as usize + 1
        });
        let squares: Vec<Option<usize>> =
            obstacles.all.iter().map(|obstacle| obstacles.square(obstacle)).collect();
        let mut counts = vec![0; obstacles.size[0] * obstacles.size[1] + 1];
        for square in squares.iter().flatten() {
            if let Some(count) = counts.get_mut(square + 1) {
                *count += 1;
            }
        }
        let mut sum = 0;
        for count in &mut counts {
            sum += *count;
            *count = sum;
        }
        let mut next = counts.clone();
        obstacles.listed = vec![0; sum];
        for (square, index) in squares.iter().zip(0..) {
            let Some(square) = square else {
                obstacles.large.push(index);
                continue;
            };
            if let Some(slot) = next.get_mut(*square) {
                if let Some(listed) = obstacles.listed.get_mut(*slot) {
                    *listed = index;
                }
                *slot += 1;
            }
        }
        obstacles.starts = counts;
        obstacles
    }

    fn square(&self, obstacle: &Obstacle) -> Option<usize> {
        let middle = [obstacle.solid.centre.x, obstacle.solid.centre.y];
        let at = |axis: usize| {
            let off = middle.get(axis)? - self.origin.get(axis)?;
            Some((libm::floor(off / self.side).max(0.0) as usize).min(self.size.get(axis)?.saturating_sub(1)))
        };
        (obstacle.reach <= self.side).then_some(at(1)? * self.size[0] + at(0)?)
    }

    /// Iterates in the scene's order.
    pub(crate) fn iter(&self) -> std::slice::Iter<'_, Obstacle> {
        self.all.iter()
    }

    /// Obstacle by index.
    pub(crate) fn get(&self, index: usize) -> Option<&Obstacle> {
        self.all.get(index)
    }

    /// Obstacles with a point within `far` m of a place, by rising index; a superset. O(obstacles found).
    pub(crate) fn near(&self, place: [f64; 2], far: f64) -> impl Iterator<Item = (usize, &Obstacle)> {
        let mut found: Vec<usize> = Vec::new();
        let is_every = self.starts.is_empty() || !far.is_finite();
        if !is_every {
            let wide = far + self.side;
            let range = |axis: usize| {
                let count = self.size.get(axis).copied().unwrap_or(0);
                let at = place.get(axis).zip(self.origin.get(axis)).map_or(0.0, |(at, origin)| at - origin);
                let first = libm::floor((at - wide) / self.side).max(0.0) as usize;
                let last = libm::floor((at + wide) / self.side) + 1.0;
                first..(last.max(0.0) as usize).min(count)
            };
            for row in range(1) {
                let columns = range(0);
                let row = row * self.size[0];
                let ends = self.starts.get(row + columns.start).zip(self.starts.get(row + columns.end));
                let Some((first, last)) = ends.filter(|_| !columns.is_empty()) else { continue };
                found.extend(self.listed.get(*first..*last).unwrap_or_default());
            }
            found.extend(&self.large);
            found.sort_unstable();
        }
        let every = if is_every { 0..self.all.len() } else { 0..0 };
        every.chain(found).filter_map(|index| Some((index, self.all.get(index)?)))
    }

    /// Lets some parts stay where they are beside each obstacle, nearer than the padding, which is at most
    /// `most`. Each part has the radius of its bounding ball, and a mark for the arm's.
    /// O(parts × obstacles near).
    pub(crate) fn permit(&mut self, parts: &[(Solid, f64, bool)], most: f64) {
        let Some((first, ..)) = parts.first() else { return };
        let off = |solid: &Solid| (solid.centre - first.centre).norm();
        let wide = parts.iter().map(|(solid, reach, _)| off(solid) + reach).fold(0.0, f64::max);
        let near = self.near([first.centre.x, first.centre.y], wide + most + LEEWAY);
        let near: Vec<usize> = near.map(|(index, _)| index).collect();
        for index in near {
            let Some(obstacle) = self.all.get_mut(index) else { continue };
            for (solid, reach, is_carried) in parts {
                let wanted = obstacle.padding.of(*is_carried) + LEEWAY;
                let metres = solid.distance_to(*reach, &obstacle.solid, obstacle.reach, wanted);
                if metres < wanted {
                    obstacle.padding.permit(*is_carried, metres);
                }
            }
        }
    }

    /// Copy with more obstacles at the end.
    pub(crate) fn with(&self, others: impl IntoIterator<Item = Obstacle>) -> Self {
        Self::new(self.all.iter().copied().chain(others).collect())
    }
}

//! Obstacles of a planning scene, listed by square of the floor so that a search near a place does not visit
//! all, and contacts with them.

use nalgebra::Vector3;
use smol_str::SmolStr;

use crate::collision::Solid;

/// Padding of every check: the least distance between any two bodies that may not touch, in m.
pub const MIN_CLEARANCE: f64 = 0.002;

/// Pairs that may be in contact, besides those that always may.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct AllowedCollisions {
    /// Index of the entity that the hand may touch: the one about to be grasped or just released.
    pub hand: Option<usize>,
    /// Index of the entity that the held object may touch: the one on which it stands.
    pub held: Option<usize>,
}

/// Contact between two bodies: they are closer than [`MIN_CLEARANCE`].
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
}

impl Obstacle {
    pub(crate) fn new(entity: usize, solid: Solid) -> Self {
        Self { entity, solid, reach: solid.reach() }
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

    /// Copy with more obstacles at the end.
    pub(crate) fn with(&self, others: impl IntoIterator<Item = Obstacle>) -> Self {
        Self::new(self.all.iter().copied().chain(others).collect())
    }
}

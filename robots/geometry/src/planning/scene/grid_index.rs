//! What stands in a room, listed by square of the floor, so that what is near a place is found without looking at all.

use crate::collision::Solid;

/// A side of the squares in m, where the room is not too large for it.
const SIDE: f64 = 1.0;
/// The most squares along a side.
const SQUARES: usize = 256;
/// As few things are looked at one by one.
const FEW: usize = 32;

/// A solid of an entity.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Obstacle {
    /// Index of the entity in the scene.
    pub(crate) entity: usize,
    pub(crate) solid: Solid,
    /// The radius of the ball around its centre that holds it, in m.
    pub(crate) reach: f64,
}

impl Obstacle {
    pub(crate) fn new(entity: usize, solid: Solid) -> Self {
        Self { entity, solid, reach: solid.reach() }
    }
}

/// All solids of a room, in the order of the scene.
#[derive(Clone, Debug)]
pub(crate) struct ObstacleIndex {
    all: Vec<Obstacle>,
    origin: [f64; 2],
    side: f64,
    size: [usize; 2],
    /// Where the list of each square begins, and where the last ends.
    starts: Vec<usize>,
    /// By square, those with their middle in it that are no larger than a square.
    listed: Vec<usize>,
    /// Those that are larger.
    large: Vec<usize>,
}

impl ObstacleIndex {
    /// Lists solids. O(things).
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

    /// All of them.
    pub(crate) fn iter(&self) -> std::slice::Iter<'_, Obstacle> {
        self.all.iter()
    }

    /// One by index.
    pub(crate) fn get(&self, index: usize) -> Option<&Obstacle> {
        self.all.get(index)
    }

    /// Those of which a point may be within `far` m of a place in the plane, with their indices, which rise; some may be
    /// farther. O(those).
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

    /// The same with others after them.
    pub(crate) fn with(&self, others: impl IntoIterator<Item = Obstacle>) -> Self {
        Self::new(self.all.iter().copied().chain(others).collect())
    }
}

//! What cuts a place off: the things that a way leads through where none leads past them. Each cell is kept with the first things that a
//! way to it was found through, which finds the fewest most often (Hauser 2014, the minimum constraint removal problem, greedily).

use std::cmp::Ordering;
use std::collections::{BTreeMap, BinaryHeap};

use super::base_map::BaseMap;

/// A side of the squares for each of which the outlines on it are listed, in m.
const SQUARE: f64 = 0.5;

impl BaseMap {
    /// The entities, by their index, that a way from some places leads through to the first place that is wanted, in the order in which it
    /// comes to them: those that weigh least together, and of these ways the shortest. What has no weight is never led through. Empty
    /// where a way leads past all; `None` where none leads there whatever is taken away. O(cells × outlines on each).
    pub(crate) fn through(
        &self,
        from: &[[f64; 2]],
        weight: impl Fn(usize) -> Option<u32>,
        is_wanted: impl Fn([f64; 2]) -> bool,
    ) -> Option<Vec<usize>> {
        let listed = self.listed();
        let mut sets = ObstacleSets::default();
        let mut best: Vec<Option<(u32, f64)>> = vec![None; self.clearance.len()];
        let mut open = BinaryHeap::new();
        for cell in from.iter().map(|place| self.nearest(*place)) {
            open.push(OpenCell { weight: 0, length: 0.0, cell, set: sets.index(vec![]) });
        }
        while let Some(OpenCell { weight: gone, length, cell, set }) = open.pop() {
            let place = self.centre(cell);
            if is_wanted(place) {
                return sets.all.get(set).cloned();
            }
            if best.get(cell).copied().flatten().is_some_and(|known| known < (gone, length)) {
                continue;
            }
            for (next, far) in self.beside(cell) {
                let through = self.covers(&listed, next);
                let Some((set, added)) = sets.with(set, &through, &weight) else { continue };
                let (weight, length) = (gone + added, length + far);
                if let Some(slot) = best.get_mut(next)
                    && slot.is_none_or(|known| (weight, length) < known)
                {
                    *slot = Some((weight, length));
                    open.push(OpenCell { weight, length, cell: next, set });
                }
            }
        }
        None
    }

    /// The neighbours of a cell, free or not; not those between which there is no room though both are free.
    fn beside(&self, cell: usize) -> impl Iterator<Item = (usize, f64)> {
        let [columns, rows] = self.size;
        let (row, column) = ((cell / columns) as i64, (cell % columns) as i64);
        let around = [(0, 1), (1, 0), (0, -1), (-1, 0), (1, 1), (1, -1), (-1, 1), (-1, -1)];
        around.into_iter().filter_map(move |(down, right)| {
            let (row, column) = (usize::try_from(row + down).ok()?, usize::try_from(column + right).ok()?);
            let next = (row < rows && column < columns).then_some(row * columns + column)?;
            let far = self.cell * libm::hypot(down as f64, right as f64);
            let (here, beyond) = (self.free(cell), self.free(next));
            (here <= 0.0 || beyond <= 0.0 || here + beyond > far).then_some((next, far))
        })
    }

    /// The entities that the robot would touch in a cell.
    fn covers(&self, listed: &BTreeMap<[i64; 2], Vec<usize>>, cell: usize) -> Vec<usize> {
        if self.free(cell) > 0.0 {
            return vec![];
        }
        let place = self.centre(cell);
        let near = listed.get(&place.map(square)).into_iter().flatten();
        let touched =
            near.filter(|at| self.outlines.all().get(**at).is_some_and(|it| it.distance(place) <= 0.0));
        let mut owners: Vec<usize> = touched.filter_map(|at| self.owners.get(*at).copied()).collect();
        owners.dedup();
        owners
    }

    /// Which outlines are on each square.
    fn listed(&self) -> BTreeMap<[i64; 2], Vec<usize>> {
        let mut listed: BTreeMap<[i64; 2], Vec<usize>> = BTreeMap::new();
        for (outline, at) in self.outlines.all().iter().zip(0..) {
            let far = outline.reach() + outline.keep_off();
            let [columns, rows] = outline.centre().map(|middle| [square(middle - far), square(middle + far)]);
            let mut open = vec![[columns, rows]];
            while let Some([[left, right], [low, high]]) = open.pop() {
                let middle =
                    [0.5 * SQUARE * (left + right + 1) as f64, 0.5 * SQUARE * (low + high + 1) as f64];
                let [wide, deep] = [right - left + 1, high - low + 1];
                if outline.distance(middle) > 0.5 * SQUARE * libm::hypot(wide as f64, deep as f64) {
                    continue;
                }
                if wide == 1 && deep == 1 {
                    listed.entry([left, low]).or_default().push(at);
                } else if wide >= deep {
                    let half = left + wide / 2;
                    open.extend([[[left, half - 1], [low, high]], [[half, right], [low, high]]]);
                } else {
                    let half = low + deep / 2;
                    open.extend([[[left, right], [low, half - 1]], [[left, right], [half, high]]]);
                }
            }
        }
        listed
    }

    /// The cell that a place is in, or that is nearest to it.
    fn nearest(&self, place: [f64; 2]) -> usize {
        let [column, row] = [0, 1].map(|axis: usize| {
            let off = place.get(axis).zip(self.origin.get(axis)).map_or(0.0, |(at, origin)| at - origin);
            let last = self.size.get(axis).map_or(0, |size| size.saturating_sub(1));
            (libm::round(off / self.cell).max(0.0) as usize).min(last)
        });
        row * self.size[0] + column
    }
}

fn square(at: f64) -> i64 {
    libm::floor(at / SQUARE) as i64
}

/// Sets of entities, each known by its index.
#[derive(Default)]
struct ObstacleSets {
    all: Vec<Vec<usize>>,
    known: BTreeMap<Vec<usize>, usize>,
}

impl ObstacleSets {
    fn index(&mut self, set: Vec<usize>) -> usize {
        let next = self.all.len();
        let index = *self.known.entry(set.clone()).or_insert(next);
        if index == next {
            self.all.push(set);
        }
        index
    }

    /// A set with more in it, and what that weighs beyond; `None` where something has no weight.
    fn with(
        &mut self,
        set: usize,
        more: &[usize],
        weight: impl Fn(usize) -> Option<u32>,
    ) -> Option<(usize, u32)> {
        let before = self.all.get(set)?;
        let new: Vec<usize> = more.iter().filter(|it| !before.contains(it)).copied().collect();
        if new.is_empty() {
            return Some((set, 0));
        }
        let added = new.iter().map(|it| weight(*it)).sum::<Option<u32>>()?;
        let whole = before.iter().copied().chain(new).collect();
        Some((self.index(whole), added))
    }
}

/// A cell that a way leads to, the lightest first, then the nearest, then the lower index.
#[derive(PartialEq)]
struct OpenCell {
    weight: u32,
    length: f64,
    cell: usize,
    set: usize,
}

impl Eq for OpenCell {}

impl Ord for OpenCell {
    fn cmp(&self, other: &Self) -> Ordering {
        let by_weight = other.weight.cmp(&self.weight).then(other.length.total_cmp(&self.length));
        by_weight.then(other.cell.cmp(&self.cell))
    }
}

impl PartialOrd for OpenCell {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

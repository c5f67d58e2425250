//! Minimum constraint removal (Hauser 2014): the fewest obstacles whose absence opens a route of the base.
//!
//! The greedy search keeps the first set of obstacles for each cell, which is minimal in most scenes.

use std::cmp::Ordering;
use std::collections::{BTreeMap, BinaryHeap};

use super::base_map::BaseMap;

/// Side of a square of the list of footprints, in m.
const SQUARE: f64 = 0.5;

impl BaseMap {
    /// Entities on the cheapest route from some places to the first place that is wanted, in order: least
    /// total weight first, then the shortest. An entity without a weight is never crossed. Empty where a
    /// free route exists; `None` where no route exists. O(cells × footprints on each).
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

    /// Neighbours of a cell, free or not, without those that have no clearance between them.
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

    /// Entities in contact with the robot in a cell.
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

    /// Footprints on each square.
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

    /// Cell of a place, or the nearest one.
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

/// Interned sets of entities.
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

    /// Union of a set with more entities, and the weight that they add; `None` where one has no weight.
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

/// Open cell, ordered by weight, then by length, then by index.
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

//! Ways over the cells of a map, from cell to cell and then with their corners cut.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use super::Map;

/// How much longer than the shortest a way along the cells may be before its corners are cut: fewer cells are looked at.
const DETOUR: f64 = 2.0;
/// How far aside of the straight way one with one corner is tried, in m.
const ASIDE: [f64; 5] = [0.3, 0.6, 1.0, 1.5, 2.0];

impl Map {
    /// The corners of a free way between two places, both included; `None` where none was found.
    pub(in crate::query) fn way(&self, from: [f64; 2], to: [f64; 2]) -> Option<Vec<[f64; 2]>> {
        if self.is_clear(from, to) {
            return Some(vec![from, to]);
        }
        if let Some(by) = self.around_something(from, to) {
            return Some(vec![from, by, to]);
        }
        let (start, goal) = (self.entry(from)?, self.entry(to)?);
        // Where the robot goes to is narrower than where it comes from, most often, so fewer cells are looked at from there.
        let cells = self.search(goal, start)?;
        let mut corners = vec![from];
        let all: Vec<[f64; 2]> = cells.into_iter().map(|cell| self.centre(cell)).chain([to]).collect();
        // From each corner to the farthest that can be seen; the next can be, by the cells' clearances.
        let mut at = 0;
        while at < all.len() {
            let here = corners.last().copied().unwrap_or(from);
            let is_seen = |next: &usize| all.get(*next).is_some_and(|next| self.is_clear(here, *next));
            let last = all.len() - 1;
            // In ever larger strides as long as the way is clear.
            let strides = (0..16).map(|power| (at + (1 << power)).min(last));
            let seen = is_seen(&last).then_some(last);
            let next = seen.unwrap_or_else(|| strides.take_while(is_seen).last().unwrap_or(at));
            corners.extend(all.get(next));
            at = next + 1;
        }
        Some(corners)
    }

    /// A place aside of the middle between two by way of which a way leads from one to the other.
    fn around_something(&self, from: [f64; 2], to: [f64; 2]) -> Option<[f64; 2]> {
        let [x, y] = [0.5 * (from[0] + to[0]), 0.5 * (from[1] + to[1])];
        let [along, up] = [to[0] - from[0], to[1] - from[1]];
        let length = libm::hypot(along, up).max(1e-9);
        let places = ASIDE.into_iter().flat_map(|far| [far, -far]).map(|far| far / length);
        let mut places = places.map(|far| [x - up * far, y + along * far]);
        places.find(|by| self.is_clear(to, *by) && self.is_clear(from, *by))
    }

    /// The neighbours of a cell to which the straight way is free, with its length.
    fn next(&self, at: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let [columns, rows] = self.size;
        let (row, column) = (at / columns, at % columns);
        let here = self.free(at);
        let [up, down] = [row > 0, row + 1 < rows];
        let [left, right] = [column > 0, column + 1 < columns];
        let (square, diagonal) = (self.cell, self.cell * std::f64::consts::SQRT_2);
        let around = [
            (right, at.wrapping_add(1), square),
            (down, at.wrapping_add(columns), square),
            (left, at.wrapping_sub(1), square),
            (up, at.wrapping_sub(columns), square),
            (down && right, at.wrapping_add(columns + 1), diagonal),
            (down && left, at.wrapping_add(columns).wrapping_sub(1), diagonal),
            (up && right, at.wrapping_sub(columns).wrapping_add(1), diagonal),
            (up && left, at.wrapping_sub(columns + 1), diagonal),
        ];
        around.into_iter().filter_map(move |(is_within, cell, far)| {
            let beyond = if is_within { self.free(cell) } else { 0.0 };
            (beyond > 0.0 && here + beyond > far).then_some((cell, far))
        })
    }

    /// A way from cell to cell, the last first, no longer than [`DETOUR`] times the shortest (A* with the way where all is free, weighted: Pohl 1970).
    fn search(&self, start: usize, goal: usize) -> Option<Vec<usize>> {
        if self.root(start) != self.root(goal) {
            return None;
        }
        let place = |at: usize| ((at / self.size[0]) as i64, (at % self.size[0]) as i64);
        let (goal_row, goal_column) = place(goal);
        // Straight and diagonal steps alone are no shorter than this where nothing is in the way.
        let left = |at: usize| {
            let (row, column) = place(at);
            let (far, near) = ((goal_row - row).abs(), (goal_column - column).abs());
            let (far, near) = (far.max(near) as f64, far.min(near) as f64);
            DETOUR * self.cell * (far + near * (std::f64::consts::SQRT_2 - 1.0))
        };
        // A search beside another one makes room of its own.
        let (mut kept, mut own) = (self.visits.try_lock().ok(), Visits::default());
        let visits = kept.as_deref_mut().unwrap_or(&mut own);
        visits.begin(self.clearance.len());
        let mut open = BinaryHeap::from([Open { bound: left(start), cell: start }]);
        visits.improve(start, 0.0, start);
        while let Some(Open { cell, bound }) = open.pop() {
            if cell == goal {
                let before = |at: &usize| if *at == start { None } else { visits.before(*at) };
                return Some(std::iter::successors(Some(goal), before).collect());
            }
            let here = visits.cost(cell)?;
            if bound > here + left(cell) + 1e-9 {
                continue;
            }
            for (next, far) in self.next(cell) {
                let whole = here + far;
                if visits.improve(next, whole, cell) {
                    open.push(Open { bound: whole + left(next), cell: next });
                }
            }
        }
        None
    }
}

/// What a search knows of the cells, with room that it leaves to the next.
#[derive(Debug, Default)]
pub(super) struct Visits {
    /// Which search it is.
    round: u32,
    /// For each cell the search that came to it last; nothing is known of what is of another one.
    rounds: Vec<u32>,
    /// The cell before it.
    from: Vec<u32>,
    /// The length of the way to it.
    cost: Vec<f64>,
}

impl Visits {
    /// Begins a search over so many cells.
    fn begin(&mut self, cells: usize) {
        if self.rounds.len() != cells || self.round == u32::MAX {
            *self = Self { round: 0, rounds: vec![0; cells], from: vec![0; cells], cost: vec![0.0; cells] };
        }
        self.round += 1;
    }

    fn is_known(&self, cell: usize) -> bool {
        self.rounds.get(cell) == Some(&self.round)
    }

    fn cost(&self, cell: usize) -> Option<f64> {
        self.cost.get(cell).copied().filter(|_| self.is_known(cell))
    }

    fn before(&self, cell: usize) -> Option<usize> {
        self.from.get(cell).map(|from| *from as usize).filter(|_| self.is_known(cell))
    }

    /// Takes a way to a cell in, where none is known that is as short; whether it was.
    fn improve(&mut self, cell: usize, cost: f64, from: usize) -> bool {
        let is_better = self.cost(cell).is_none_or(|known| cost < known);
        let slots = self.rounds.get_mut(cell).zip(self.from.get_mut(cell)).zip(self.cost.get_mut(cell));
        if let (true, Some(((round, before), known))) = (is_better, slots) {
            (*round, *before, *known) = (self.round, from as u32, cost);
        }
        is_better
    }
}

/// A cell to look at, the least bound first, then the lower index.
#[derive(PartialEq)]
struct Open {
    bound: f64,
    cell: usize,
}

impl Eq for Open {}

impl Ord for Open {
    fn cmp(&self, other: &Self) -> Ordering {
        other.bound.total_cmp(&self.bound).then(other.cell.cmp(&self.cell))
    }
}

impl PartialOrd for Open {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

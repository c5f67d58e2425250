//! Base map: free space of the base with the arm as it is, and routes through it.
//!
//! The robot is a stack of discs about the base's axis, so that its yaw does not matter; an obstacle meets
//! only the discs at its heights. The clearance of a place is 1-Lipschitz, so a straight route is certified
//! by steps as long as the clearance at the start of each.

use std::cmp::Ordering;
use std::collections::BinaryHeap;
use std::sync::Mutex;

use super::footprint::{Footprint, FootprintIndex, PartDisc, about_vertical};
use crate::planning::scene::{Configuration, Obstacle, PlanningScene};

/// Side of a cell in m, for scenes of up to [`CELLS`] cells a side.
const CELL: f64 = 0.05;
/// Greatest number of cells along a side.
const CELLS: usize = 400;
/// Margin of the map around all obstacles, in m.
const MARGIN: f64 = 1.5;
/// Cap of the clearance, in m.
const CAP: f64 = 2.0;
/// Side of a leaf of the quadtree, in cells.
const LEAF: usize = 4;

/// Map of the floor for one arm configuration: clearance and connectivity of its cells.
#[derive(Debug)]
pub(crate) struct BaseMap {
    pub(super) outlines: FootprintIndex,
    /// Entity of each footprint.
    pub(super) owners: Vec<usize>,
    pub(super) origin: [f64; 2],
    pub(super) cell: f64,
    pub(super) size: [usize; 2],
    /// Clearance of each cell: a lower bound in free space, an upper bound in occupied space.
    pub(super) clearance: Vec<f64>,
    /// Union-find forest of the free cells: 1 + the parent's index, 0 for an occupied cell.
    first: Vec<u32>,
    /// Free cells at the border of fully free squares.
    rim: Vec<usize>,
    is_anywhere: bool,
    /// Buffer of the route search.
    visits: Mutex<SearchBuffer>,
}

impl BaseMap {
    /// Builds the map of a scene; O(cells near obstacles × obstacles near them).
    pub(crate) fn new(scene: &PlanningScene<'_>, joints: &[f64]) -> Self {
        let configuration = Configuration { base: [0.0; 3], joints: joints.to_vec() };
        let placed = scene.body.placed(&scene.model.map_from_links(&configuration));
        let discs = placed.iter().zip(0..).map(|(solid, part)| {
            let (radius, heights) = about_vertical(solid, 0.0, 0.0);
            PartDisc { radius, heights, is_carried: scene.is_carried(part) }
        });
        let discs: Vec<PartDisc> = discs.collect();
        let owned = |obstacle: &Obstacle| Some((Footprint::new(obstacle, &discs)?, obstacle.entity));
        let (outlines, owners): (Vec<Footprint>, Vec<usize>) =
            scene.obstacles.iter().filter_map(owned).unzip();
        let [x, y, _] = scene.state.robot.base;
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for outline in &outlines {
            let reach = outline.reach();
            for ((low, high), at) in low.iter_mut().zip(&mut high).zip(outline.centre()) {
                (*low, *high) = (low.min(at - reach), high.max(at + reach));
            }
        }
        let is_around =
            [x, y].iter().zip(low.iter().zip(&high)).all(|(at, (low, high))| low <= at && at <= high);
        if !is_around {
            for ((low, high), at) in low.iter_mut().zip(&mut high).zip([x, y]) {
                (*low, *high) = (low.min(at), high.max(at));
            }
        }
        let origin = low.map(|low| low - MARGIN);
        let span = [high[0] - low[0] + 2.0 * MARGIN, high[1] - low[1] + 2.0 * MARGIN];
        let cell = CELL.max(span[0].max(span[1]) / CELLS as f64);
        let size = span.map(|span| (libm::ceil(span / cell) as usize + 1).min(CELLS + 2));
        let mut map = Self {
            outlines: FootprintIndex::new(outlines, origin, span),
            owners,
            origin,
            cell,
            size,
            clearance: vec![CAP; size[0] * size[1]],
            first: vec![0; size[0] * size[1]],
            rim: vec![],
            is_anywhere: is_around,
            visits: Mutex::default(),
        };
        let all: Vec<u32> = (0..).take(map.outlines.all().len()).collect();
        map.fill([0, 0], [size[0], size[1]], &all);
        map.connect();
        map
    }

    /// Checks whether the map holds for any base pose within it.
    pub(crate) fn is_anywhere(&self) -> bool {
        self.is_anywhere
    }

    /// Fills a rectangle of cells from the footprints that matter there. A quarter is refined only where
    /// the clearance at its middle leaves it open whether a cell is free; elsewhere its cells get the bound
    /// that the middle gives.
    fn fill(&mut self, corner: [usize; 2], size: [usize; 2], near: &[u32]) {
        let [columns, rows] = size;
        if columns == 0 || rows == 0 {
            return;
        }
        let half = [(columns - 1) as f64 / 2.0, (rows - 1) as f64 / 2.0].map(|half| half * self.cell);
        let place =
            |at: usize, axis: usize| self.origin.get(axis).copied().unwrap_or(0.0) + at as f64 * self.cell;
        let middle = [place(corner[0], 0) + half[0], place(corner[1], 1) + half[1]];
        let radius = libm::hypot(half[0], half[1]);
        let distances: Vec<f64> = near
            .iter()
            .map(|at| self.outlines.all().get(*at as usize).map_or(CAP, |outline| outline.distance(middle)))
            .collect();
        let least = distances.iter().copied().fold(CAP, f64::min);
        let is_leaf = columns.max(rows) <= LEAF;
        let is_settled = least - radius > 2.0 * self.cell || least + radius < 0.0;
        let kept: Vec<u32> = near
            .iter()
            .zip(&distances)
            .filter(|(_, distance)| **distance <= least + 2.0 * radius)
            .map(|(at, _)| *at)
            .collect();
        if !is_leaf && !is_settled {
            let (left, above) = (columns / 2, rows / 2);
            let [column, row] = corner;
            self.fill([column, row], [left, above], &kept);
            self.fill([column + left, row], [columns - left, above], &kept);
            self.fill([column, row + above], [left, rows - above], &kept);
            self.fill([column + left, row + above], [columns - left, rows - above], &kept);
            return;
        }
        let first = corner[1] * self.size[0] + corner[0];
        for row in 0..rows {
            let from = first + row * self.size[0];
            if is_settled {
                let value = if least > 0.0 { least - radius } else { least + radius };
                self.clearance.get_mut(from..from + columns).unwrap_or_default().fill(value);
                if least > 0.0 {
                    self.first.get_mut(from..from + columns).unwrap_or_default().fill(first as u32 + 1);
                    let is_end = row == 0 || row + 1 == rows;
                    let inner = if is_end { 1 } else { columns.saturating_sub(1).max(1) };
                    self.rim.extend((from..from + columns).step_by(inner));
                }
                continue;
            }
            for column in 0..columns {
                let at = self.centre(from + column);
                let outlines = kept.iter().filter_map(|at| self.outlines.all().get(*at as usize));
                let value = outlines.map(|outline| outline.distance(at)).fold(CAP, f64::min);
                if let Some(slot) = self.clearance.get_mut(from + column) {
                    *slot = value;
                }
                if value > 0.0 {
                    self.rim.push(from + column);
                }
            }
        }
    }

    /// Clearance of a place in m, capped; negative where the robot would be in contact.
    pub(crate) fn at(&self, place: [f64; 2]) -> f64 {
        self.outlines.at(place)
    }

    /// Component of the cell that a free place reaches: routes connect all places of a component.
    pub(crate) fn component(&self, place: [f64; 2]) -> Option<u32> {
        self.entry(place).map(|at| self.root(at))
    }

    /// Checks whether the nearest cell is in one of some components; fast and approximate.
    pub(crate) fn is_among(&self, place: [f64; 2], components: &[u32]) -> bool {
        let [column, row] = [0, 1].map(|axis: usize| {
            let off = place.get(axis).zip(self.origin.get(axis)).map_or(0.0, |(at, origin)| at - origin);
            off / self.cell + 0.5
        });
        let [columns, rows] = self.size.map(|count| count as f64);
        // Outside of the map all is free and connected.
        let at = if column >= 0.0 && row >= 0.0 && column < columns && row < rows {
            row as usize * self.size[0] + column as usize
        } else {
            0
        };
        self.free(at) > 0.0 && components.contains(&self.root(at))
    }

    /// Checks whether a straight route is free.
    pub(crate) fn is_clear(&self, from: [f64; 2], to: [f64; 2]) -> bool {
        let way = [to[0] - from[0], to[1] - from[1]];
        let length = libm::hypot(way[0], way[1]);
        let mut gone = 0.0;
        loop {
            let part = if length > 0.0 { gone / length } else { 1.0 };
            let clearance = self.at([from[0] + way[0] * part, from[1] + way[1] * part]);
            // A route with hardly any clearance is given up.
            if clearance <= 0.001 && !(clearance > 0.0 && gone + clearance >= length) {
                return false;
            }
            gone += clearance;
            if gone >= length {
                return true;
            }
        }
    }

    /// Checks whether a route connects two places.
    pub(crate) fn is_connected(&self, from: [f64; 2], to: [f64; 2]) -> bool {
        match (self.component(from), self.component(to)) {
            (Some(one), Some(other)) if one == other => true,
            _ => self.is_clear(from, to),
        }
    }

    pub(super) fn centre(&self, at: usize) -> [f64; 2] {
        let (row, column) = (at / self.size[0], at % self.size[0]);
        [self.origin[0] + column as f64 * self.cell, self.origin[1] + row as f64 * self.cell]
    }

    pub(super) fn free(&self, at: usize) -> f64 {
        self.clearance.get(at).copied().unwrap_or(-1.0)
    }

    /// Nearest cell that a straight route from a free place reaches.
    fn entry(&self, place: [f64; 2]) -> Option<usize> {
        let index = |axis: usize| {
            let at = libm::round((place.get(axis)? - self.origin.get(axis)?) / self.cell);
            (at >= 1.0 && at + 2.0 <= *self.size.get(axis)? as f64).then_some(at as usize)
        };
        let (column, row) = (index(0)?, index(1)?);
        let here = self.at(place);
        let mut best: Option<(f64, usize)> = None;
        for other in [row - 1, row, row + 1] {
            for at in [column - 1, column, column + 1] {
                let cell = other * self.size[0] + at;
                let [x, y] = self.centre(cell);
                let far = ((x - place[0]) * (x - place[0]) + (y - place[1]) * (y - place[1])).sqrt();
                let is_reached = here > 0.0 && self.free(cell) > 0.0 && here + self.free(cell) > far;
                if is_reached && best.is_none_or(|(known, _)| far < known) {
                    best = Some((far, cell));
                }
            }
        }
        best.map(|(_, cell)| cell)
    }

    /// Connects neighbouring free cells; O(border cells).
    fn connect(&mut self) {
        let columns = self.size[0];
        let diagonal = self.cell * std::f64::consts::SQRT_2;
        let rim = std::mem::take(&mut self.rim);
        for at in &rim {
            let (at, column, here) = (*at, at % columns, self.free(*at));
            // The other four neighbours connect to this cell themselves; squares that are free throughout
            // are one component.
            let around = [
                (column + 1 < columns, at + 1, self.cell),
                (true, at + columns, self.cell),
                (column + 1 < columns, at + columns + 1, diagonal),
                (column > 0, at + columns - 1, diagonal),
            ];
            for (_, other, far) in around.into_iter().filter(|(is_within, ..)| *is_within) {
                let beyond = self.free(other);
                if beyond > 0.0 && here + beyond > far {
                    let (one, other) = (shortened(&mut self.first, at), shortened(&mut self.first, other));
                    if let Some(slot) = self.first.get_mut(one.max(other)).filter(|_| one != other) {
                        *slot = one.min(other) as u32 + 1;
                    }
                }
            }
        }
        for at in &rim {
            let root = shortened(&mut self.first, *at) as u32;
            if let Some(slot) = self.first.get_mut(*at) {
                *slot = root + 1;
            }
        }
    }

    /// Root of a free cell's component.
    fn root(&self, mut at: usize) -> u32 {
        loop {
            match self.first.get(at).copied() {
                Some(next) if next > 0 && next as usize != at + 1 => at = next as usize - 1,
                _ => return at as u32,
            }
        }
    }
}

/// Root of a free cell's component, with path compression.
fn shortened(first: &mut [u32], mut at: usize) -> usize {
    loop {
        let next = match first.get(at).copied() {
            Some(next) if next > 0 && next as usize != at + 1 => next as usize - 1,
            _ => return at,
        };
        let after = first.get(next).copied().filter(|after| *after > 0).unwrap_or(next as u32 + 1);
        if let Some(slot) = first.get_mut(at) {
            *slot = after;
        }
        at = next;
    }
}

/// Weight of the A* search: a route along cells may be this many times the shortest before its corners are
/// cut.
const DETOUR: f64 = 2.0;
/// Sideways offsets of a route with one corner, in m.
const ASIDE: [f64; 5] = [0.3, 0.6, 1.0, 1.5, 2.0];

impl BaseMap {
    /// Corners of a free route between two places, both included; `None` where none was found.
    pub(crate) fn way(&self, from: [f64; 2], to: [f64; 2]) -> Option<Vec<[f64; 2]>> {
        if self.is_clear(from, to) {
            return Some(vec![from, to]);
        }
        if let Some(by) = self.around_something(from, to) {
            return Some(vec![from, by, to]);
        }
        let (start, goal) = (self.entry(from)?, self.entry(to)?);
        // The goal is usually tighter than the start, so the search from the goal visits fewer cells.
        let cells = self.search(goal, start)?;
        let mut corners = vec![from];
        let all: Vec<[f64; 2]> = cells.into_iter().map(|cell| self.centre(cell)).chain([to]).collect();
        // Cuts corners: from each one to the farthest that a straight route reaches.
        let mut at = 0;
        while at < all.len() {
            let here = corners.last().copied().unwrap_or(from);
            let is_seen = |next: &usize| all.get(*next).is_some_and(|next| self.is_clear(here, *next));
            let last = all.len() - 1;
            // In doubling strides while the route is clear.
            let strides = (0..16).map(|power| (at + (1 << power)).min(last));
            let seen = is_seen(&last).then_some(last);
            let next = seen.unwrap_or_else(|| strides.take_while(is_seen).last().unwrap_or(at));
            corners.extend(all.get(next));
            at = next + 1;
        }
        Some(corners)
    }

    /// Corner of a free route with one corner.
    fn around_something(&self, from: [f64; 2], to: [f64; 2]) -> Option<[f64; 2]> {
        let [x, y] = [0.5 * (from[0] + to[0]), 0.5 * (from[1] + to[1])];
        let [along, up] = [to[0] - from[0], to[1] - from[1]];
        let length = libm::hypot(along, up).max(1e-9);
        let places = ASIDE.into_iter().flat_map(|far| [far, -far]).map(|far| far / length);
        let mut places = places.map(|far| [x - up * far, y + along * far]);
        places.find(|by| self.is_clear(to, *by) && self.is_clear(from, *by))
    }

    /// Free neighbours of a cell with their distance.
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

    /// Cells of a route, the last first, at most [`DETOUR`] times the shortest: weighted A* (Pohl 1970).
    fn search(&self, start: usize, goal: usize) -> Option<Vec<usize>> {
        if self.root(start) != self.root(goal) {
            return None;
        }
        let place = |at: usize| ((at / self.size[0]) as i64, (at % self.size[0]) as i64);
        let (goal_row, goal_column) = place(goal);
        // Octile distance: a lower bound for straight and diagonal steps.
        let left = |at: usize| {
            let (row, column) = place(at);
            let (far, near) = ((goal_row - row).abs(), (goal_column - column).abs());
            let (far, near) = (far.max(near) as f64, far.min(near) as f64);
            DETOUR * self.cell * (far + near * (std::f64::consts::SQRT_2 - 1.0))
        };
        // A concurrent search uses a buffer of its own.
        let (mut kept, mut own) = (self.visits.try_lock().ok(), SearchBuffer::default());
        let visits = kept.as_deref_mut().unwrap_or(&mut own);
        visits.begin(self.clearance.len());
        let mut open = BinaryHeap::from([OpenCell { bound: left(start), cell: start }]);
        visits.improve(start, 0.0, start);
        while let Some(OpenCell { cell, bound }) = open.pop() {
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
                    open.push(OpenCell { bound: whole + left(next), cell: next });
                }
            }
        }
        None
    }
}

/// Buffer of a route search, reused by the next.
#[derive(Debug, Default)]
pub(crate) struct SearchBuffer {
    /// Number of the search.
    round: u32,
    /// Search that last visited each cell; older entries are void.
    rounds: Vec<u32>,
    /// Predecessor of each cell.
    from: Vec<u32>,
    /// Cost of each cell.
    cost: Vec<f64>,
}

impl SearchBuffer {
    /// Begins a search over `cells` cells.
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

    /// Records a shorter route to a cell; returns `false` where a shorter one is known.
    fn improve(&mut self, cell: usize, cost: f64, from: usize) -> bool {
        let is_better = self.cost(cell).is_none_or(|known| cost < known);
        let slots = self.rounds.get_mut(cell).zip(self.from.get_mut(cell)).zip(self.cost.get_mut(cell));
        if let (true, Some(((round, before), known))) = (is_better, slots) {
            (*round, *before, *known) = (self.round, from as u32, cost);
        }
        is_better
    }
}

/// Open cell, ordered by the least bound, then by the lower index.
#[derive(PartialEq)]
struct OpenCell {
    bound: f64,
    cell: usize,
}

impl Eq for OpenCell {}

impl Ord for OpenCell {
    fn cmp(&self, other: &Self) -> Ordering {
        other.bound.total_cmp(&self.bound).then(other.cell.cmp(&self.cell))
    }
}

impl PartialOrd for OpenCell {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

//! Where the base can drive with the arm as it is: the robot as a stack of discs about the base's axis, so that its yaw does
//! not matter. For each obstacle only the parts between its heights count.
//!
//! The clearance of a place changes by no more than the way between two places, so a straight way is certified by steps as
//! long as the clearance where each begins.

use std::sync::Mutex;

use super::outlines::{Outline, Outlines};
use super::room::Room;
use super::state::State;
use super::things::Thing;
use super::touch::about_vertical;

mod through;
mod way;

use way::Visits;

/// A cell's side in m, where the room is not too large for it.
const CELL: f64 = 0.05;
/// The most cells along a side.
const CELLS: usize = 400;
/// How far beyond everything the map goes, in m.
const MARGIN: f64 = 1.5;
/// The greatest clearance that is told, in m.
const CAP: f64 = 2.0;
/// The side of a square of cells that are looked at one by one.
const LEAF: usize = 4;

/// The map of a room for one configuration of the arm.
#[derive(Debug)]
pub(super) struct Map {
    outlines: Outlines,
    /// Of each outline the entity, by its index.
    owners: Vec<usize>,
    origin: [f64; 2],
    cell: f64,
    size: [usize; 2],
    /// Of each cell; where it is wide, no more than the clearance, where nothing is free, no less.
    clearance: Vec<f64>,
    /// For each cell one more than another that it hangs together with, on the way to the first of all these; 0 for that.
    first: Vec<u32>,
    /// Free cells but for those within a square of which all are free.
    rim: Vec<usize>,
    is_anywhere: bool,
    /// Room for a search.
    visits: Mutex<Visits>,
}

impl Map {
    /// The map of a room with the arm at some joints. O(cells of places where it is narrow × obstacles near them).
    pub(super) fn new(room: &Room<'_>, joints: &[f64]) -> Self {
        let state = State { base: [0.0; 3], joints: joints.to_vec() };
        let placed = room.body.placed(&room.machine.map_from_links(&state));
        let discs: Vec<(f64, [f64; 2])> =
            placed.iter().map(|solid| about_vertical(solid, 0.0, 0.0)).collect();
        let owned = |thing: &Thing| Some((Outline::new(&thing.solid, &discs)?, thing.entity));
        let (outlines, owners): (Vec<Outline>, Vec<usize>) = room.things.iter().filter_map(owned).unzip();
        let [x, y, _] = room.world.robot.base;
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
            outlines: Outlines::new(outlines, origin, span),
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

    /// Whether it would be the same with the robot's base elsewhere among the things.
    pub(super) fn is_anywhere(&self) -> bool {
        self.is_anywhere
    }

    /// The clearance of the cells of a rectangle, from a corner, by the outlines that matter there. A quarter is looked at
    /// closer only where the clearance at its middle leaves it open whether a cell is free; elsewhere each cell gets the bound that
    /// the middle gives, from below where it is free and from above where it is not.
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

    /// Clearance of a place in m, or what is much where it is more; negative where the robot would touch something.
    pub(super) fn at(&self, place: [f64; 2]) -> f64 {
        self.outlines.at(place)
    }

    /// The component of the cell that is reached straight from a free place: ways lead from it to all of the same component.
    pub(super) fn component(&self, place: [f64; 2]) -> Option<u32> {
        self.entry(place).map(|at| self.root(at))
    }

    /// Whether the nearest cell is in one of these components: quick, and not exact.
    pub(super) fn is_among(&self, place: [f64; 2], components: &[u32]) -> bool {
        let [column, row] = [0, 1].map(|axis: usize| {
            let off = place.get(axis).zip(self.origin.get(axis)).map_or(0.0, |(at, origin)| at - origin);
            off / self.cell + 0.5
        });
        let [columns, rows] = self.size.map(|count| count as f64);
        // All around is outside, and leads to everywhere outside.
        let at = if column >= 0.0 && row >= 0.0 && column < columns && row < rows {
            row as usize * self.size[0] + column as usize
        } else {
            0
        };
        self.free(at) > 0.0 && components.contains(&self.root(at))
    }

    /// Whether a straight way is free.
    pub(super) fn is_clear(&self, from: [f64; 2], to: [f64; 2]) -> bool {
        let way = [to[0] - from[0], to[1] - from[1]];
        let length = libm::hypot(way[0], way[1]);
        let mut gone = 0.0;
        loop {
            let part = if length > 0.0 { gone / length } else { 1.0 };
            let clearance = self.at([from[0] + way[0] * part, from[1] + way[1] * part]);
            // A way along which there is no room to speak of is not looked at any closer.
            if clearance <= 0.001 && !(clearance > 0.0 && gone + clearance >= length) {
                return false;
            }
            gone += clearance;
            if gone >= length {
                return true;
            }
        }
    }

    /// Whether a way leads from a place to another, straight or along the cells.
    pub(super) fn is_connected(&self, from: [f64; 2], to: [f64; 2]) -> bool {
        match (self.component(from), self.component(to)) {
            (Some(one), Some(other)) if one == other => true,
            _ => self.is_clear(from, to),
        }
    }

    fn centre(&self, at: usize) -> [f64; 2] {
        let (row, column) = (at / self.size[0], at % self.size[0]);
        [self.origin[0] + column as f64 * self.cell, self.origin[1] + row as f64 * self.cell]
    }

    fn free(&self, at: usize) -> f64 {
        self.clearance.get(at).copied().unwrap_or(-1.0)
    }

    /// The nearest cell that is reached straight from a free place.
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

    /// Finds out which cells hang together. O(rim).
    fn connect(&mut self) {
        let columns = self.size[0];
        let diagonal = self.cell * std::f64::consts::SQRT_2;
        let rim = std::mem::take(&mut self.rim);
        for at in &rim {
            let (at, column, here) = (*at, at % columns, self.free(*at));
            // The other four neighbours look at this one, and what is within a square hangs together with it.
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

    /// The first of the cells that a free cell hangs together with.
    fn root(&self, mut at: usize) -> u32 {
        loop {
            match self.first.get(at).copied() {
                Some(next) if next > 0 && next as usize != at + 1 => at = next as usize - 1,
                _ => return at as u32,
            }
        }
    }
}

/// The first of the cells that a cell hangs together with; ways to it become shorter.
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

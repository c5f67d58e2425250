//! A figure placed in eight states.

use pulp::Simd;

use super::figure::{Eight, Figure, Joint, frame_bit};
use super::number::{Number, Vector};

/// Eight numbers, and eight vectors.
pub(super) type Row = [f32; 8];
pub(super) type Rows = [Row; 3];

/// Where all is in eight states, and how far each part goes from there.
#[derive(Debug, Default)]
pub(super) struct Posed {
    frames: Vec<Frame>,
    pub(super) parts: Vec<Place>,
}

/// A frame: its directions and its origin, and the axis of its joint.
#[derive(Clone, Copy, Debug, Default)]
struct Frame {
    turn: [Rows; 3],
    at: Rows,
    axis: Rows,
}

/// A part.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Place {
    pub(super) centre: Rows,
    /// From the centre to an end of its axis.
    pub(super) half: Rows,
    /// How far any of its points goes in the map.
    pub(super) goes: Row,
    /// Whether it goes anywhere.
    pub(super) moves: bool,
    /// Corners of the box around all places that it takes, but for the slack.
    pub(super) low: [f32; 3],
    pub(super) high: [f32; 3],
}

impl Posed {
    /// Places a figure, of its parts those that are needed.
    #[inline(always)]
    pub(super) fn new<S: Simd>(simd: S, figure: &Figure, eight: &Eight, needed: &[bool]) -> Self {
        let none = Place { low: [f32::INFINITY; 3], high: [f32::NEG_INFINITY; 3], ..Place::default() };
        let mut posed = Self {
            frames: vec![Frame::default(); figure.joints.len() + 1],
            parts: vec![none; figure.parts.len()],
        };
        for chunk in 0..8 / S::F32_LANES {
            posed.place(simd, figure, eight, needed, chunk);
        }
        posed
    }

    #[inline(always)]
    fn place<S: Simd>(&mut self, simd: S, figure: &Figure, eight: &Eight, needed: &[bool], chunk: usize) {
        let base = Vector::of(simd, &eight.base, chunk);
        let root = &figure.base_from_root;
        let [sin, cos] = base.0[2].sin_cos();
        if let Some(frame) = self.frames.first_mut() {
            for (slot, column) in frame.turn.iter_mut().zip(root.turn) {
                about(simd, [sin, cos], column).store(slot, chunk);
            }
            let Vector([x, y, z]) = about(simd, [sin, cos], root.at);
            Vector([x + base.0[0], y + base.0[1], z]).store(&mut frame.at, chunk);
        }
        let mut frames = 0;
        for (part, is_needed) in figure.parts.iter().zip(needed) {
            if *is_needed {
                frames |= part.carriers;
            }
        }
        for ((joint, positions), at) in figure.joints.iter().zip(&eight.positions).zip(1..) {
            if frames & frame_bit(at) == 0 {
                continue;
            }
            let Some(parent) = self.frames.get(joint.parent).copied() else { continue };
            if let Some(slot) = self.frames.get_mut(at) {
                parent.carry(simd, joint, Number::of(simd, positions, chunk), slot, chunk);
            }
        }
        for ((place, part), is_needed) in self.parts.iter_mut().zip(&figure.parts).zip(needed) {
            if !*is_needed {
                continue;
            }
            let Some(frame) = self.frames.get(part.frame) else { continue };
            let centre = frame.point(simd, part.centre, chunk);
            centre.store(&mut place.centre, chunk);
            let half = frame.direction(simd, part.half, chunk);
            half.store(&mut place.half, chunk);
            let levers = figure.levers.get(part.frame).map_or(&[][..], Vec::as_slice);
            let goes = goes(simd, &self.frames, figure, eight, levers, (centre, part.reach), chunk);
            let mut whole = goes + Number::splat(simd, eight.slides);
            if eight.turns > 0.0 {
                let Vector([x, y, _]) = centre - base;
                let arm = (x * x + y * y).sqrt() + Number::splat(simd, part.reach);
                whole = whole + Number::splat(simd, eight.turns) * (arm + goes);
            }
            whole.store(&mut place.goes, chunk);
            let wide = whole + Number::splat(simd, part.radius);
            place.moves |= whole.most_lane() > 0.0;
            let (Vector([x, y, z]), Vector([a, b, c])) = (centre, half);
            let (a, b, c) = (a.abs() + wide, b.abs() + wide, c.abs() + wide);
            let [low_x, low_y, low_z] = &mut place.low;
            lower(low_x, (x - a).least_lane());
            lower(low_y, (y - b).least_lane());
            lower(low_z, (z - c).least_lane());
            let [high_x, high_y, high_z] = &mut place.high;
            higher(high_x, (x + a).most_lane());
            higher(high_y, (y + b).most_lane());
            higher(high_z, (z + c).most_lane());
        }
    }

    /// A direction of a frame where it is.
    #[inline(always)]
    pub(super) fn direction<S: Simd>(
        &self,
        simd: S,
        frame: usize,
        vector: [f32; 3],
        chunk: usize,
    ) -> Vector<S> {
        let none = Frame::default();
        self.frames.get(frame).unwrap_or(&none).direction(simd, vector, chunk)
    }

    /// How far a part goes by those of its joints that come after the first so many.
    #[inline(always)]
    pub(super) fn goes_after<S: Simd>(
        &self,
        simd: S,
        figure: &Figure,
        eight: &Eight,
        (part, common): (usize, usize),
        chunk: usize,
    ) -> Number<S> {
        let zero = Number::splat(simd, 0.0);
        let Some((own, place)) = figure.parts.get(part).zip(self.parts.get(part)) else { return zero };
        let levers = figure.levers.get(own.frame).and_then(|levers| levers.get(common..)).unwrap_or_default();
        let centre = Vector::of(simd, &place.centre, chunk);
        goes(simd, &self.frames, figure, eight, levers, (centre, own.reach), chunk)
    }
}

/// A vector turned about the vertical.
#[inline(always)]
fn about<S: Simd>(simd: S, [sin, cos]: [Number<S>; 2], vector: [f32; 3]) -> Vector<S> {
    let Vector([x, y, z]) = Vector::splat(simd, vector);
    Vector([cos * x - sin * y, sin * x + cos * y, z])
}

/// How far a ball goes at most while joints move, joint by joint from the last on: one that turns by `a` moves a point at a
/// distance `r` from its axis by at most `a r`.
#[inline(always)]
fn goes<S: Simd>(
    simd: S,
    frames: &[Frame],
    figure: &Figure,
    eight: &Eight,
    levers: &[usize],
    (centre, reach): (Vector<S>, f32),
    chunk: usize,
) -> Number<S> {
    let mut goes = Number::splat(simd, 0.0);
    for at in levers.iter().rev() {
        let amount = eight.amounts.get(*at).copied().unwrap_or(0.0);
        if amount == 0.0 {
            continue;
        }
        let Some((frame, joint)) = frames.get(at + 1).zip(figure.joints.get(*at)) else { continue };
        goes = goes
            + if joint.slides {
                Number::splat(simd, amount)
            } else {
                let off = centre - Vector::of(simd, &frame.at, chunk);
                let across = off.cross(Vector::of(simd, &frame.axis, chunk));
                Number::splat(simd, amount) * (across.dot(across).sqrt() + Number::splat(simd, reach) + goes)
            };
    }
    goes
}

impl Frame {
    #[inline(always)]
    fn direction<S: Simd>(&self, simd: S, [x, y, z]: [f32; 3], chunk: usize) -> Vector<S> {
        let [a, b, c] = &self.turn;
        Vector::of(simd, a, chunk).times(Number::splat(simd, x))
            + Vector::of(simd, b, chunk).times(Number::splat(simd, y))
            + Vector::of(simd, c, chunk).times(Number::splat(simd, z))
    }

    #[inline(always)]
    fn point<S: Simd>(&self, simd: S, vector: [f32; 3], chunk: usize) -> Vector<S> {
        Vector::of(simd, &self.at, chunk) + self.direction(simd, vector, chunk)
    }

    /// Places the frame of a joint that this one carries.
    #[inline(always)]
    fn carry<S: Simd>(&self, simd: S, joint: &Joint, position: Number<S>, slot: &mut Self, chunk: usize) {
        let axis = self.direction(simd, joint.axis, chunk);
        axis.store(&mut slot.axis, chunk);
        let at = self.point(simd, joint.at, chunk);
        if joint.slides {
            (at + axis.times(position)).store(&mut slot.at, chunk);
            for (slot, column) in slot.turn.iter_mut().zip(joint.still) {
                self.direction(simd, column, chunk).store(slot, chunk);
            }
            return;
        }
        at.store(&mut slot.at, chunk);
        let [sin, cos] = position.sin_cos();
        let rest = Number::splat(simd, 1.0) - cos;
        let [a, b, c] = &self.turn;
        let (a, b, c) = (Vector::of(simd, a, chunk), Vector::of(simd, b, chunk), Vector::of(simd, c, chunk));
        let columns = slot.turn.iter_mut().zip(joint.still).zip(joint.swing.iter().zip(&joint.bend));
        for ((slot, still), (swing, bend)) in columns {
            let local = Vector::splat(simd, still)
                + Vector::splat(simd, *swing).times(sin)
                + Vector::splat(simd, *bend).times(rest);
            let Vector([x, y, z]) = local;
            (a.times(x) + b.times(y) + c.times(z)).store(slot, chunk);
        }
    }
}

#[inline(always)]
fn lower(slot: &mut f32, value: f32) {
    *slot = if value < *slot { value } else { *slot };
}

#[inline(always)]
fn higher(slot: &mut f32, value: f32) {
    *slot = if value > *slot { value } else { *slot };
}

/// How far each part goes in the first of eight states.
#[cfg(test)]
pub(super) fn goes_in_map(figure: &Figure, eight: &Eight) -> Vec<f32> {
    let needed = vec![true; figure.parts.len()];
    let posed = Posed::new(pulp::Scalar, figure, eight, &needed);
    posed.parts.iter().map(|place| place.goes[0]).collect()
}

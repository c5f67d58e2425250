//! A figure placed in eight states.

use pulp::Simd;

use super::bounds::{Bound, Bounds};
use super::drift::{Drift, Drifted, Drifting};
use super::figure::{Eight, Figure, Joint, bit};
use super::number::{Number, Vector};

/// Eight numbers, and eight vectors.
pub(super) type Row = [f32; 8];
pub(super) type Rows = [Row; 3];

/// Where all is in eight states, and how far each part goes from there. What is not needed is anywhere.
#[derive(Debug, Default)]
pub(crate) struct Posed {
    frames: Vec<Frame>,
    pub(super) parts: Vec<Place>,
    /// The boxes of all parts.
    pub(super) bounds: Bounds,
    /// On a way, for each frame: see [`Posed::drift`].
    drifts: Vec<Drifted>,
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
    /// The box around all places that it takes, but for the slack, where it was asked for.
    pub(super) bound: Bound,
}

impl Posed {
    /// Places a figure, of its parts those that are needed, and where they are, with the boxes around them.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn set<S: Simd>(
        &mut self,
        simd: S,
        figure: &Figure,
        eight: &Eight,
        needed: impl Fn(usize) -> bool,
        needs_bounds: bool,
    ) {
        self.frames.resize(figure.joints.len() + 1, Frame::default());
        self.parts.resize(figure.parts.len(), Place::default());
        self.drifts.resize(figure.levers.len() * figure.stride(), Drifted::default());
        let mut frames = 0;
        for (part, at) in figure.parts.iter().zip(0..) {
            if needed(at) {
                frames |= part.carriers;
            }
        }
        for chunk in 0..8 / S::F32_LANES {
            self.carry(simd, figure, eight, frames, chunk);
            if eight.is_way {
                self.drift(simd, figure, eight, frames, chunk);
            }
            self.place(simd, figure, eight, &needed, needs_bounds, chunk);
        }
    }

    /// Places frames, those of which the bit is set.
    #[cfg_attr(optimised, inline(always))]
    fn carry<S: Simd>(&mut self, simd: S, figure: &Figure, eight: &Eight, frames: u64, chunk: usize) {
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
        if let (Some([x, y, z, at]), Some(frame)) = (eight.root, self.frames.first_mut()) {
            (frame.turn, frame.at) = ([x, y, z], at);
        }
        for ((joint, positions), at) in figure.joints.iter().zip(&eight.positions).zip(1..) {
            if frames & bit(at) == 0 {
                continue;
            }
            let Some(parent) = self.frames.get(joint.parent).copied() else { continue };
            if let Some(slot) = self.frames.get_mut(at) {
                parent.carry(simd, joint, Number::of(simd, positions, chunk), slot, chunk);
            }
        }
    }

    #[cfg_attr(optimised, inline(always))]
    fn place<S: Simd>(
        &mut self,
        simd: S,
        figure: &Figure,
        eight: &Eight,
        needed: &impl Fn(usize) -> bool,
        needs_bounds: bool,
        chunk: usize,
    ) {
        let stride = figure.stride();
        for ((place, part), at) in self.parts.iter_mut().zip(&figure.parts).zip(0..) {
            if !needed(at) {
                continue;
            }
            if chunk == 0 {
                place.moves = false;
                place.bound = Bound::NOWHERE;
            }
            let Some(frame) = self.frames.get(part.frame) else { continue };
            let centre = frame.point(simd, part.centre, chunk);
            centre.store(&mut place.centre, chunk);
            let half = frame.direction(simd, part.half, chunk);
            half.store(&mut place.half, chunk);
            let whole = match self.drifts.get(part.frame * stride) {
                Some(drift) if eight.is_way => drift.goes(simd, part.far, chunk),
                Some(_) | None => Number::splat(simd, 0.0),
            };
            whole.store(&mut place.goes, chunk);
            place.moves |= whole.most_lane() > 0.0;
            if !needs_bounds {
                continue;
            }
            let wide = whole + Number::splat(simd, part.radius);
            let (Vector([x, y, z]), Vector([a, b, c])) = (centre, half);
            let (a, b, c) = (a.abs() + wide, b.abs() + wide, c.abs() + wide);
            place.bound.add(&Bound {
                low: [(x - a).least_lane(), (y - b).least_lane(), (z - c).least_lane()],
                high: [(x + a).most_lane(), (y + b).most_lane(), (z + c).most_lane()],
            });
        }
    }

    /// A direction of a frame where it is.
    #[cfg_attr(optimised, inline(always))]
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

    /// How a part drifts by those of its joints that come after the first so many.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn drifting<S: Simd>(
        &self,
        simd: S,
        figure: &Figure,
        (part, common): (usize, usize),
        chunk: usize,
    ) -> Drifting<S> {
        self.drifting_by(simd, figure, part, common + 1, chunk)
    }

    /// How far any place of a part goes by those of its joints that come after the first so many.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn goes<S: Simd>(
        &self,
        simd: S,
        figure: &Figure,
        (part, common): (usize, usize),
        chunk: usize,
    ) -> Number<S> {
        let own = figure.parts.get(part);
        let known =
            own.and_then(|own| Some((own, self.drifts.get(own.frame * figure.stride() + common + 1)?)));
        known.map_or(Number::splat(simd, 0.0), |(own, drift)| drift.goes(simd, own.far, chunk))
    }

    /// The same by all of its joints and by the base.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn drifting_in_map<S: Simd>(
        &self,
        simd: S,
        figure: &Figure,
        part: usize,
        chunk: usize,
    ) -> Drifting<S> {
        self.drifting_by(simd, figure, part, 0, chunk)
    }

    #[cfg_attr(optimised, inline(always))]
    fn drifting_by<S: Simd>(
        &self,
        simd: S,
        figure: &Figure,
        part: usize,
        from: usize,
        chunk: usize,
    ) -> Drifting<S> {
        let Some((own, place)) = figure.parts.get(part).zip(self.parts.get(part)) else {
            return Drifting::still(simd);
        };
        let known = self.frames.get(own.frame).zip(self.drifts.get(own.frame * figure.stride() + from));
        let Some((frame, drift)) = known else { return Drifting::still(simd) };
        let off = Vector::of(simd, &place.centre, chunk) - Vector::of(simd, &frame.at, chunk);
        let half = Vector::of(simd, &place.half, chunk);
        Drifting::new(simd, drift.of(simd, chunk), off, half, [own.radius, own.far])
    }

    /// Finds out how frames drift, those of which the bit is set: each by the base and all of its joints, by all joints, by those after the
    /// first, and so on, one after the other.
    #[cfg_attr(optimised, inline(always))]
    fn drift<S: Simd>(&mut self, simd: S, figure: &Figure, eight: &Eight, frames: u64, chunk: usize) {
        let stride = figure.stride();
        let base = Vector::of(simd, &eight.base, chunk);
        for (levers, own) in figure.levers.iter().zip(0..) {
            if own > 0 && frames & bit(own) == 0 {
                continue;
            }
            let Some(origin) = self.frames.get(own).map(|frame| Vector::of(simd, &frame.at, chunk)) else {
                continue;
            };
            let Some(slots) = self.drifts.get_mut(own * stride..(own + 1) * stride) else { continue };
            let mut drift = Drift::still(simd);
            let mut set = |at: usize, drift: Drift<S>| {
                slots.get_mut(at).into_iter().for_each(|slot| slot.set(drift, chunk));
            };
            set(levers.len() + 1, drift);
            for (place, at) in levers.iter().enumerate().rev() {
                let known = eight.changes.get(*at).zip(eight.amounts.get(*at));
                let known = known.zip(self.frames.get(at + 1)).zip(figure.joints.get(*at));
                if let Some((((change, amount), frame), joint)) = known
                    && *amount > 0.0
                {
                    let axis = Vector::of(simd, &frame.axis, chunk);
                    if joint.slides {
                        drift.slide(simd, axis, [*change, *amount]);
                    } else {
                        drift.turn(
                            simd,
                            origin - Vector::of(simd, &frame.at, chunk),
                            axis,
                            [*change, *amount],
                        );
                    }
                }
                set(place + 1, drift);
            }
            let [x, y, yaw] = eight.shift;
            if eight.turns > 0.0 {
                let Vector([off_x, off_y, _]) = origin - base;
                let off = Vector([off_x, off_y, Number::splat(simd, 0.0)]);
                drift.turn(simd, off, Vector::splat(simd, [0.0, 0.0, 1.0]), [yaw, eight.turns]);
            }
            if eight.slides > 0.0 {
                let share = 1.0 / eight.slides;
                let axis = Vector::splat(simd, [x * share, y * share, 0.0]);
                drift.slide(simd, axis, [eight.slides; 2]);
            }
            set(0, drift);
        }
    }
}

/// A vector turned about the vertical.
#[cfg_attr(optimised, inline(always))]
fn about<S: Simd>(simd: S, [sin, cos]: [Number<S>; 2], vector: [f32; 3]) -> Vector<S> {
    let Vector([x, y, z]) = Vector::splat(simd, vector);
    Vector([cos * x - sin * y, sin * x + cos * y, z])
}

impl Frame {
    #[cfg_attr(optimised, inline(always))]
    fn direction<S: Simd>(&self, simd: S, [x, y, z]: [f32; 3], chunk: usize) -> Vector<S> {
        let [a, b, c] = &self.turn;
        Vector::of(simd, a, chunk).times(Number::splat(simd, x))
            + Vector::of(simd, b, chunk).times(Number::splat(simd, y))
            + Vector::of(simd, c, chunk).times(Number::splat(simd, z))
    }

    #[cfg_attr(optimised, inline(always))]
    fn point<S: Simd>(&self, simd: S, vector: [f32; 3], chunk: usize) -> Vector<S> {
        Vector::of(simd, &self.at, chunk) + self.direction(simd, vector, chunk)
    }

    /// Places the frame of a joint that this one carries.
    #[cfg_attr(optimised, inline(always))]
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

/// How far each part goes in the first of eight states.
#[cfg(test)]
pub(super) fn goes_in_map(figure: &Figure, eight: &Eight) -> Vec<f32> {
    let mut posed = Posed::default();
    posed.set(pulp::Scalar, figure, eight, |_| true, true);
    posed.parts.iter().map(|place| place.goes[0]).collect()
}

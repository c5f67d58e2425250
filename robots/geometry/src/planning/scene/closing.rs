//! Closing of a hand: its fingers between open and closed, and the depths at which they hold a thing.
//!
//! It is planar: only the lines across the hand through the axis on which the tip lies count.

use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use nalgebra::Vector3;

use crate::collision::{Shape, Solid};

/// Overlap of the fingers with a flat face, in m.
pub(super) const GRIP: f64 = 0.01;
/// Greatest distance of a contact from the widest point of a round object, as a share of its radius: the sine
/// of the friction angle of rubber on most materials, with some to spare.
pub(super) const SHORT: f64 = 0.35;
/// Greatest growth of the gap between the fingers along them at a flat face: twice the tangent of that angle.
const WEDGE: f64 = 0.75;
/// Distance between two lines across the hand, and between two depths, in m.
const STEP: f64 = 0.002;
/// Distance within which the fingers are looked for, in m.
const FAR: f64 = 0.25;
/// Gap between finger and face up to which the finger covers it, in m.
const COVERS: f64 = 0.02;
/// Overlap beyond which more does not hold better, in m.
const ENOUGH: f64 = 0.03;

/// Number of stages from the open to the closed hand.
pub(super) const STAGES: usize = 25;

/// Object between the fingers, along their direction.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum FingerContact {
    /// Round about an axis across the fingers, widest at its centre.
    Round,
    /// As wide everywhere, up to half of its extent along the fingers, in m.
    Flat(f64),
}

/// Depths of an object's centre from the tip along the fingers at which they hold it, in m.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct HoldDepths {
    pub(crate) least: f64,
    /// Depth that holds best, the least of equals.
    pub(crate) best: f64,
    pub(crate) most: f64,
}

/// Fingers from open to closed, in the frame of the tip.
#[derive(Clone, Debug)]
pub(crate) struct Closing {
    points: Vector3<f64>,
    closes: Vector3<f64>,
    /// Greatest distance of a contact from the widest point of a round object, as a share of its radius.
    short: f64,
    /// Flag of fingers that turn, and do not only slide.
    turns: bool,
    /// Solids of the palm, and of the fingers stage by stage.
    palm: Vec<Solid>,
    stages: Vec<Vec<Solid>>,
    /// Reach of the fingers in each stage along their direction, in m.
    ends: Vec<f64>,
    /// Position of the first line along the fingers, in m.
    first: f64,
    /// Gaps between the fingers on each line, stage by stage; `None` where one of them does not meet it.
    gaps: OnceLock<Vec<Vec<Option<f64>>>>,
    /// Flag of fingers that are known to close on each other.
    is_known: OnceLock<bool>,
    /// Depths found so far: a search asks for the same few again and again.
    found: Arc<Mutex<Vec<FoundDepths>>>,
}

/// Width, contact and least depth, and the depths for them.
type FoundDepths = ([f64; 2], FingerContact, Option<HoldDepths>);

/// Number of depths that are remembered.
const REMEMBERED: usize = 64;

impl Closing {
    /// Fingers that point and close along unit vectors, before a palm that reaches to `first` m: the solids
    /// of the palm, and of the fingers from open to closed.
    pub(super) fn new(
        [points, closes]: [Vector3<f64>; 2],
        (palm, stages): (Vec<Solid>, Vec<Vec<Solid>>),
        first: f64,
        has_fixed_jaw: bool,
    ) -> Self {
        // A fixed jaw presses straight; its friction lets the other one press at twice the angle.
        let short = if has_fixed_jaw { 2.0 * SHORT * (1.0 - SHORT * SHORT).sqrt() } else { SHORT };
        let end = |solid: &Solid| solid.centre.dot(&points) + solid.extent(&points);
        let ends = stages.iter().map(|solids| solids.iter().map(end).fold(f64::NEG_INFINITY, f64::max));
        let ends = ends.collect();
        let (gaps, is_known, found) = (OnceLock::new(), OnceLock::new(), Arc::default());
        let axes = |solids: Option<&Vec<Solid>>| -> Vec<Vector3<f64>> {
            solids.into_iter().flatten().flat_map(|solid| solid.axes).collect()
        };
        let (open, closed) = (axes(stages.first()), axes(stages.last()));
        let turns = open.iter().zip(&closed).any(|(open, closed)| (open - closed).norm() > 1e-3);
        Self { points, closes, short, turns, ends, stages, palm, first, gaps, is_known, found }
    }

    /// Greatest reach of the fingers in all stages, in m; `None` without fingers.
    pub(crate) fn end(&self) -> Option<f64> {
        let most = self.ends.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        most.is_finite().then_some(most)
    }

    /// Solids of the open hand.
    pub(crate) fn open(&self) -> impl Iterator<Item = &Solid> {
        self.palm.iter().chain(self.stages.first().into_iter().flatten())
    }

    /// Solids of the fingers on their way to an object, where they turn as they close.
    pub(crate) fn sweep(
        &self,
        width: f64,
        depth: f64,
        contact: FingerContact,
    ) -> impl Iterator<Item = &Solid> {
        let at = self.turns.then(|| self.contact(width, depth, contact)).flatten().map_or(0, |(at, _)| at);
        let stages = [at, at * 2 / 3, at / 3].into_iter().filter(|at| *at > 0);
        stages.filter_map(|at| self.stages.get(at)).flatten()
    }

    /// Reach of the fingers until they meet an object, in m.
    pub(crate) fn end_around(&self, width: f64, depth: f64, contact: FingerContact) -> Option<f64> {
        let (at, _) = self.contact(width, depth, contact)?;
        self.ends.get(..=at)?.iter().copied().max_by(f64::total_cmp)
    }

    /// Depths from `from` m on at which the fingers hold an object of a width; `None` where there are none.
    pub(crate) fn depths(&self, width: f64, contact: FingerContact, from: f64) -> Option<HoldDepths> {
        let mut found = self.found.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((.., depths)) = found.iter().find(|known| (known.0, known.1) == ([width, from], contact))
        {
            return *depths;
        }
        let depths = self.search_depths(width, contact, from);
        if found.len() == REMEMBERED {
            found.clear();
        }
        found.push(([width, from], contact, depths));
        depths
    }

    fn search_depths(&self, width: f64, contact: FingerContact, from: f64) -> Option<HoldDepths> {
        let half = match contact {
            FingerContact::Round => width / 2.0,
            FingerContact::Flat(half) => half,
        };
        let steps = libm::ceil(((self.end()? + half - from) / STEP).max(0.0)) as u32;
        let mut found: Option<(HoldDepths, f64)> = None;
        for step in 0..=steps {
            let depth = from + STEP * f64::from(step);
            let Some(worth) = self.worth(width, depth, contact) else { continue };
            let (depths, best) =
                found.get_or_insert((HoldDepths { least: depth, best: depth, most: depth }, worth));
            depths.most = depth;
            if worth > *best + 1e-9 {
                (depths.best, *best) = (depth, worth);
            }
        }
        found.map(|(depths, _)| depths)
    }

    /// Checks whether the fingers are known to close on each other.
    pub(crate) fn is_known(&self) -> bool {
        *self.is_known.get_or_init(|| {
            let least =
                |gaps: Option<&Vec<Option<f64>>>| gaps?.iter().flatten().copied().min_by(f64::total_cmp);
            let (gaps, most) = (self.gaps(), |open: Option<f64>| GRIP.max(open.unwrap_or(FAR) / 2.0));
            least(gaps.last()).is_some_and(|closed| closed < most(least(gaps.first())))
        })
    }

    /// Quality of a hold, the better the greater; `None` where the fingers do not hold.
    fn worth(&self, width: f64, depth: f64, contact: FingerContact) -> Option<f64> {
        let (at, meets) = self.contact(width, depth, contact)?;
        match contact {
            FingerContact::Round => {
                let off = (meets - depth).abs();
                (off <= self.short * width / 2.0 + STEP / 2.0).then_some(-off)
            }
            FingerContact::Flat(half) => {
                let gaps = self.gaps().get(at)?;
                let inside = |at: f64| (at - depth).abs() <= half.max(STEP / 2.0);
                let covers = |(at, gap): &(f64, f64)| inside(*at) && *gap <= width + COVERS;
                let covered = self.lines(gaps, depth, half).filter(covers).count() as f64 * STEP;
                let apart = half.clamp(STEP, 2.0 * STEP);
                // At an edge of the object the finger must not slope away from it.
                let inwards = match meets {
                    _ if meets - STEP < depth - half => Some(apart),
                    _ if meets + STEP > depth + half => Some(-apart),
                    _ => None,
                };
                let is_at = |line: f64, at: f64| (line - at).abs() < STEP / 2.0 + 1e-9;
                let gap = |at: f64| self.lines(gaps, at, STEP).find(|(line, _)| is_at(*line, at));
                let slope = match inwards {
                    None => 0.0,
                    Some(by) => (gap(meets + by)?.1 - gap(meets)?.1) / apart,
                };
                let holds = covered >= GRIP.min(half) - STEP / 2.0 && slope <= WEDGE;
                holds.then(|| covered.min(ENOUGH).min(2.0 * half) - GRIP * slope.max(0.0))
            }
        }
    }

    /// Stage in which the closing fingers meet an object, and the place along them.
    fn contact(&self, width: f64, depth: f64, contact: FingerContact) -> Option<(usize, f64)> {
        let gaps = self.gaps();
        let meets = |at: usize| self.nearest(gaps.get(at)?, width, depth, contact);
        let is_met = |at: usize| meets(at).is_some_and(|(left, _)| left <= 0.0);
        let (mut open, mut closed) = (0, gaps.len().checked_sub(1)?);
        if !is_met(closed) || meets(open).is_some_and(|(left, _)| left < -STEP) {
            return None;
        }
        while closed - open > 1 {
            let middle = usize::midpoint(open, closed);
            *(if is_met(middle) { &mut closed } else { &mut open }) = middle;
        }
        Some((closed, meets(closed)?.1))
    }

    /// Least room between fingers and object on any line, in m, and the place of the line.
    fn nearest(
        &self,
        gaps: &[Option<f64>],
        width: f64,
        depth: f64,
        contact: FingerContact,
    ) -> Option<(f64, f64)> {
        let wide = |at: f64| match contact {
            FingerContact::Round => {
                let (radius, off) = (width / 2.0, at - depth);
                (off.abs() < radius).then(|| 2.0 * (radius * radius - off * off).max(0.0).sqrt())
            }
            FingerContact::Flat(half) => ((at - depth).abs() <= half.max(STEP / 2.0)).then_some(width),
        };
        let half = match contact {
            FingerContact::Round => width / 2.0,
            FingerContact::Flat(half) => half,
        };
        let room = self.lines(gaps, depth, half).filter_map(|(at, gap)| Some((gap - wide(at)?, at)));
        // Of equals the one nearest to the middle.
        room.min_by(|one, other| {
            let off = |place: f64| (place - depth).abs();
            let is_equal = (one.0 - other.0).abs() < 1e-9;
            if is_equal { off(one.1).total_cmp(&off(other.1)) } else { one.0.total_cmp(&other.0) }
        })
    }

    /// Lines of a stage on which the fingers meet, with their gaps: those within `half` m of a place, and a
    /// step more on both sides.
    fn lines<'a>(
        &self,
        gaps: &'a [Option<f64>],
        place: f64,
        half: f64,
    ) -> impl Iterator<Item = (f64, f64)> + use<'a> {
        let first = self.first;
        let from = libm::floor((place - half - first) / STEP - 1.0).max(0.0) as u32;
        let count = libm::ceil((2.0 * half) / STEP + 3.0).clamp(0.0, 400.0) as usize;
        let near = gaps.iter().zip(0_u32..).skip(from as usize).take(count + 1);
        near.filter_map(move |(gap, at)| Some((first + STEP * f64::from(at), (*gap)?)))
    }

    fn gaps(&self) -> &[Vec<Option<f64>>] {
        self.gaps.get_or_init(|| {
            let Some(end) = self.end() else { return vec![] };
            let count = libm::ceil(((end - self.first) / STEP).clamp(0.0, 200.0)) as u32;
            let gap = |solids: &[Solid], at: u32| {
                let from = self.points * (self.first + STEP * f64::from(at));
                let met = |way: Vector3<f64>| {
                    let met = solids.iter().filter_map(|solid| ray(solid, &from, &way));
                    met.fold(None, |least: Option<f64>, at| Some(least.map_or(at, |least| least.min(at))))
                };
                Some(met(self.closes)? + met(-self.closes)?)
            };
            let stage = |solids: &Vec<Solid>| (0..=count).map(|at| gap(solids, at)).collect();
            self.stages.iter().map(stage).collect()
        })
    }
}

/// Distance in m at which a ray meets a solid: 0 from within, `None` where it misses.
fn ray(solid: &Solid, from: &Vector3<f64>, way: &Vector3<f64>) -> Option<f64> {
    let (to, reach) = (solid.centre - from, solid.reach());
    let along = to.dot(way);
    if to.norm_squared() - along * along > reach * reach || along + reach < 0.0 {
        return None;
    }
    if let Shape::Box(half) = solid.shape {
        let (mut enters, mut leaves) = (0.0_f64, FAR);
        for (axis, half) in solid.axes.iter().zip(half.iter()) {
            let (off, speed) = (to.dot(axis), way.dot(axis));
            if speed.abs() < 1e-12 {
                if off.abs() > *half {
                    return None;
                }
                continue;
            }
            let (one, other) = ((off - half) / speed, (off + half) / speed);
            enters = enters.max(one.min(other));
            leaves = leaves.min(one.max(other));
        }
        return (enters <= leaves).then_some(enters);
    }
    let mut at = (along - reach).max(0.0);
    while at < FAR {
        let shape = Shape::Capsule { radius: 0.0, half: 0.0 };
        let distance = solid.distance(&Solid { centre: from + way * at, axes: solid.axes, shape });
        if distance < 1e-6 {
            return Some(at);
        }
        at += distance;
    }
    None
}

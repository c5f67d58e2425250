//! `put`: a place for what is in the hand on a surface or in a container, and a way of the whole robot to it.

use motet_robots::scene::{Entity, Travel};
use nalgebra::{Isometry3, Point3, Translation3, UnitQuaternion, Vector3};

use crate::collision::{Shape, Solid};
use crate::kinematics::planar;
use crate::planning::query::answer::{
    Grasp, GraspSide, Infeasible, InfeasibleReason, Margins, MotionAnswer, MotionWitness, SearchBudget,
    UnknownReason,
};
use crate::planning::scene::configuration::Configuration;
use crate::planning::scene::contact::AllowedCollisions;
use crate::planning::scene::contact::MIN_CLEARANCE;
use crate::planning::scene::obstacle::solid_shape;
use crate::planning::scene::scene_state::HeldObject;
use crate::planning::search::arm_candidates::{PLANE, part};
use crate::planning::search::context::QueryContext;
use crate::planning::search::goal_search::{GoalPose, GoalSpec, LAST};
use crate::planning::search::path::ContactTally;
use crate::planning::search::workspace::ReachEnvelope;

/// How far above its support a thing is let go, in m.
pub(crate) const ABOVE: f64 = 0.004;
/// How far it is lowered straight down before, in m; the shorter where the longer does not do.
const LOWER: [f64; 2] = [0.1, 0.05];
/// Places that are tried with the usual budget: half of them the nearest to the robot, half spread over the face; and half as many
/// along its rim, where a hand beside the thing has room that it has not over the face.
const PLACES: usize = 16;
/// A larger budget tries at most so many times as many.
const MOST_TIMES: usize = 16;
/// Directions in which the thing may be turned.
const TURNS: u32 = 8;

/// A flat rectangle or disc on which things can stand.
pub(crate) struct SupportSurface {
    /// The middle of its upper face, with its directions.
    pub(crate) map_from_face: Isometry3<f64>,
    pub(crate) half: [f64; 2],
    /// How high the walls around it are, in m: what is put there comes from above them.
    walls: f64,
    is_disc: bool,
}

impl SupportSurface {
    /// A place on the rim, so far around it of 1, in parts of half its sides.
    fn rim(&self, around: f64) -> [f64; 2] {
        if self.is_disc {
            let (sin, cos) = libm::sincos(std::f64::consts::TAU * around);
            return [cos, sin];
        }
        // As far from one place to the next on a long side as on a short one.
        let [wide, deep] = self.half;
        // No rim but one place.
        if wide + deep <= 0.0 {
            return [0.0; 2];
        }
        let gone = around * 2.0 * (wide + deep);
        if gone < wide {
            [2.0 * gone / wide - 1.0, -1.0]
        } else if gone < wide + deep {
            [1.0, 2.0 * (gone - wide) / deep - 1.0]
        } else if gone < 2.0 * wide + deep {
            [1.0 - 2.0 * (gone - wide - deep) / wide, 1.0]
        } else {
            [-1.0, 1.0 - 2.0 * (gone - 2.0 * wide - deep) / deep]
        }
    }
}

impl QueryContext<'_> {
    /// A place for what is held.
    pub(crate) fn put(&self, id: &str, on: &str, budget: SearchBudget) -> MotionAnswer {
        let unknown = |why: String| MotionAnswer::Unknown(UnknownReason::Because(why));
        let Some(held) = self.held_thing(id) else {
            return unknown(format!("the hand does not hold `{id}`"));
        };
        let Some((index, entity)) = self.entity(on) else { return unknown(format!("there is no `{on}`")) };
        if id == on {
            return unknown(format!("`{id}` does not stand on itself"));
        }
        let support = match self.support_of(entity) {
            Ok(support) => support,
            Err(answer) => return answer,
        };
        let allowed = AllowedCollisions { hand: None, held: Some(index) };
        let mut met = ContactTally::default();
        let wanted = PLACES * (budget.candidates / SearchBudget::default().candidates).clamp(1, MOST_TIMES);
        let (places, is_cut) = self.places(&held, (&support, index), wanted, &mut met);
        if places.is_empty() {
            let reason = met.none_free();
            let certified = self.is_full(&held, &support, index);
            return MotionAnswer::Infeasible(Infeasible {
                reason,
                change: None,
                certified,
                configuration: None,
            });
        }
        let tip_from_place = held.tip_from_object.inverse();
        let face = support.map_from_face.translation;
        let wide = libm::hypot(support.half[0], support.half[1]);
        let checker = self.around([face.x, face.y], self.farthest(held.hand) + wide + LAST);
        // What comes into a drawer comes from above its walls.
        let over = (support.walls > 0.0).then(|| support.walls + LOWER[1]);
        let tips: Vec<_> = places.iter().map(|place| place * tip_from_place).collect();
        // Upright at one height the wrist is at one height too, wherever it stands and however it is turned.
        let span = self.span(held.hand);
        if let Some((reason, change)) = span.beyond_all(&face.vector, &format!("the top of `{on}`"), &tips) {
            let certified = matches!(span, ReachEnvelope::Heights(..));
            return MotionAnswer::Infeasible(Infeasible { reason, change, certified, configuration: None });
        }
        let goal = GoalSpec {
            hand: held.hand,
            tips,
            manifold: None,
            allowed,
            checker: &checker,
            backs: &|_| over.into_iter().chain(LOWER).map(|up| Vector3::new(0.0, 0.0, up)).collect(),
        };
        match self.search_goal(&goal, budget) {
            Ok((at, path)) => {
                let tip = match at {
                    GoalPose::Tip(at) => goal.tips.get(at).copied(),
                    GoalPose::GraspCandidate(hold) => Some(hold.map_from_tip),
                };
                let Some(tip) = tip else { return MotionAnswer::Unknown(UnknownReason::Budget) };
                MotionAnswer::Feasible(Box::new(self.put_down(&held, path, tip, allowed)))
            }
            // There may be other places, which were not tried.
            Err(MotionAnswer::Infeasible(Infeasible { certified: false, .. })) if is_cut => {
                MotionAnswer::Unknown(UnknownReason::Budget)
            }
            Err(none) => none,
        }
    }

    /// What is in the hand, where it is the thing that is asked for.
    pub(crate) fn held_thing(&self, id: &str) -> Option<HeldObject<'_>> {
        let (held, tip_from_object) = self.state.held.as_ref().filter(|(held, _)| held == id)?;
        let (hand, (_, entity)) = (self.model.hand()?, self.entity(held)?);
        let shape = solid_shape(entity)?;
        let closes = tip_from_object.rotation.inverse() * Vector3::from(hand.card.closes);
        let width = 2.0 * Solid::new(&Isometry3::identity(), shape).extent(&closes);
        Some(HeldObject { id: held.clone(), tip_from_object: *tip_from_object, hand, shape, width })
    }

    fn support_of(&self, entity: &Entity) -> Result<SupportSurface, MotionAnswer> {
        let unknown = |why: String| Err(MotionAnswer::Unknown(UnknownReason::Because(why)));
        let Some((pose, shape)) = self.state.pose(entity).zip(solid_shape(entity)) else {
            return unknown(format!("the place or the shape of `{}` is not known", entity.id));
        };
        let up = pose.rotation * Vector3::z();
        if up.z < 0.999 {
            return unknown(format!("`{}` does not stand upright", entity.id));
        }
        let (half, height, is_disc) = match shape {
            Shape::Box(half) => ([half.x, half.y], half.z, false),
            Shape::Cylinder { radius, half } => ([radius, radius], half, true),
            Shape::Capsule { .. } | Shape::HalfSpace => {
                return unknown(format!("nothing stands on the round shape of `{}`", entity.id));
            }
        };
        if entity.travel.is_some() && !self.state.is_open(entity) {
            let reason = InfeasibleReason::NoFreePose { by: Some(entity.id.clone()), share: None };
            let change = Some(format!("open `{}` before", entity.id));
            return Err(MotionAnswer::Infeasible(Infeasible::proven(reason, change)));
        }
        let (face, inset) = match &entity.travel {
            // Inside, on its bottom.
            Some(Travel::Slide { axis, distance }) => (
                pose * Translation3::from(Vector3::from(*axis) * *distance),
                crate::planning::scene::articulation::WALL,
            ),
            Some(Travel::Hinge { .. }) => (pose, crate::planning::scene::articulation::WALL),
            None => (pose, 0.0),
        };
        let deep = height;
        let height = if entity.travel.is_some() {
            crate::planning::scene::articulation::WALL - height
        } else {
            height
        };
        let map_from_face = face * Translation3::new(0.0, 0.0, height);
        let walls = match &entity.travel {
            Some(Travel::Slide { .. }) => 2.0 * deep,
            Some(Travel::Hinge { .. }) | None => 0.0,
        };
        Ok(SupportSurface { map_from_face, half: half.map(|half| half - inset), walls, is_disc })
    }

    /// So many free places of what is held, or fewer, upright: those nearest to the robot, then others all over the face, and half as
    /// many along its rim. Tells whether there were more.
    fn places(
        &self,
        held: &HeldObject<'_>,
        (on, index): (&SupportSurface, usize),
        wanted: usize,
        met: &mut ContactTally,
    ) -> (Vec<Isometry3<f64>>, bool) {
        let solid = Solid::new(&Isometry3::identity(), held.shape);
        let bottom = solid.extent(&Vector3::z());
        let around = libm::hypot(solid.extent(&Vector3::x()), solid.extent(&Vector3::y()));
        let around = if matches!(held.shape, Shape::Box(_)) { around } else { solid.extent(&Vector3::x()) };
        // What is too large for it may stand out on all sides, with its middle on the middle.
        let spread = on.half.map(|half| (half - around).max(0.0));
        let [base_x, base_y, _] = self.state.robot.base;
        let sorted = |spots: Vec<[f64; 2]>| {
            let spots = spots.into_iter().map(|[x, y]| {
                let spot = on.map_from_face * Point3::new(x * spread[0], y * spread[1], bottom + ABOVE);
                (libm::hypot(spot.x - base_x, spot.y - base_y), spot.coords)
            });
            let mut spots: Vec<(f64, Vector3<f64>)> = spots.collect();
            spots.sort_by(|one, other| one.0.total_cmp(&other.0));
            spots
        };
        let over =
            (0..4 * wanted).map(|at| [part(at, 1, PLANE), part(at, 2, PLANE)].map(|part| 2.0 * part - 1.0));
        let over = over.filter(|[x, y]| !on.is_disc || x * x + y * y <= 1.0).collect();
        let along = (0..2 * wanted).map(|at| on.rim(at as f64 / (2 * wanted) as f64)).collect();
        let turned = |turn: u32| std::f64::consts::TAU * f64::from(turn) / f64::from(TURNS);
        let upright = |spot: Vector3<f64>, turn: u32| {
            let rotation: UnitQuaternion<f64> = planar(0.0, 0.0, turned(turn)).rotation;
            Isometry3::from_parts(Translation3::from(spot), rotation)
        };
        let mut is_free = |spot: &Vector3<f64>| {
            let stands = Solid::new(&upright(*spot, 0), held.shape);
            let others = self
                .obstacles
                .near([spot.x, spot.y], stands.reach() + MIN_CLEARANCE)
                .map(|(_, obstacle)| obstacle);
            let mut others = others.filter(|obstacle| obstacle.entity != index);
            let other = others.find(|obstacle| !stands.is_farther(&obstacle.solid, MIN_CLEARANCE));
            other.inspect(|other| met.add_entity(self.name(other.entity))).is_none()
        };
        let (mut chosen, mut is_cut) = (Vec::new(), false);
        for (spots, wanted) in [(sorted(over), wanted), (sorted(along), wanted / 2)] {
            let free: Vec<Vector3<f64>> =
                spots.into_iter().map(|(_, spot)| spot).filter(|spot| is_free(spot)).collect();
            let (near, far) = free.split_at(free.len().min(wanted / 2));
            // In their order by distance, every so many-th.
            let step = far.len().div_ceil(wanted / 2).max(1);
            chosen.extend(near.iter().chain(far.iter().step_by(step)).copied());
            is_cut |= step > 1;
        }
        let turned = chosen.into_iter().flat_map(|spot| (0..TURNS).map(move |turn| upright(spot, turn)));
        (turned.collect(), is_cut)
    }

    /// The witness of a motion with what is held.
    pub(crate) fn put_down(
        &self,
        held: &HeldObject<'_>,
        path: Vec<Configuration>,
        map_from_tip: Isometry3<f64>,
        allowed: AllowedCollisions,
    ) -> MotionWitness {
        let points = map_from_tip.rotation * Vector3::from(held.hand.card.points);
        let side = if points.z < -0.819 { GraspSide::Top } else { GraspSide::Side };
        let (object, tip_from_object, width) = (held.id.clone(), held.tip_from_object, held.width);
        let grasp = Some(Grasp { object, side, map_from_tip, tip_from_object, width });
        let margins = Margins { payload: None, ..self.margins(&path, allowed) };
        MotionWitness { path, grasp, margins }
    }
}

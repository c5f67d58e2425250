//! `put`: a place for the held object on a surface or in a container, and a path to it.

use motet_robots::scene::{Entity, Travel};
use nalgebra::{Isometry3, Point3, Translation3, UnitQuaternion, Vector3};

use crate::collision::{Shape, Solid};
use crate::kinematics::planar;
use crate::planning::context::QueryContext;
use crate::planning::query::{
    ContactTally, Grasp, GraspSide, Infeasible, InfeasibleReason, Margins, MotionAnswer, MotionWitness,
    SearchBudget, UnknownReason,
};
use crate::planning::scene::{
    ABOVE, AllowedCollisions, Configuration, HeldObject, Padding, SupportSurface, WALL, solid_shape,
};
use crate::planning::search::{GoalPose, GoalSpec, LAST, PLANE, ReachEnvelope, part};

/// Heights in m from which the object is lowered straight down; the shorter where the longer is blocked.
const LOWER: [f64; 2] = [0.1, 0.05];
/// Places of the usual budget: half of them the nearest to the robot, half spread over the face; and half
/// as many along the rim, where the hand has room beside the object.
const PLACES: usize = 16;
/// Greatest factor of the places for a larger budget.
const MOST_TIMES: usize = 16;
/// Number of rotations of the object.
const TURNS: u32 = 8;

/// Answers `put`: a place for the held object.
pub(crate) fn put(context: &QueryContext<'_>, id: &str, on: &str, budget: SearchBudget) -> MotionAnswer {
    let unknown = |why: String| MotionAnswer::Unknown(UnknownReason::Because(why));
    let Some(held) = context.held_object(id) else {
        return unknown(format!("the hand does not hold `{id}`"));
    };
    let Some((index, entity)) = context.entity(on) else { return unknown(format!("there is no `{on}`")) };
    if id == on {
        return unknown(format!("`{id}` does not stand on itself"));
    }
    let support = match support_of(context, entity) {
        Ok(support) => support,
        Err(answer) => return answer,
    };
    let allowed = AllowedCollisions { held: Some(index), ..AllowedCollisions::default() };
    let mut met = ContactTally::default();
    let wanted = PLACES * (budget.candidates / SearchBudget::default().candidates).clamp(1, MOST_TIMES);
    let (places, is_cut) = places(context, &held, (&support, index), wanted, &mut met);
    if places.is_empty() {
        let reason = met.none_free();
        let certified = context.is_full(&held, &support, index);
        return MotionAnswer::Infeasible(Infeasible {
            reason,
            change: None,
            certified,
            configuration: None,
            tight: None,
        });
    }
    let tip_from_place = held.tip_from_object.inverse();
    let face = support.map_from_face.translation;
    let wide = libm::hypot(support.half[0], support.half[1]);
    let checker = context.around([face.x, face.y], context.farthest(held.hand) + wide + LAST);
    // Into a drawer the object comes from above its walls.
    let over = (support.walls > 0.0).then(|| support.walls + LOWER[1]);
    let tips: Vec<_> = places.iter().map(|place| place * tip_from_place).collect();
    // Upright at one height, the wrist is at one height too, wherever the object is and however it is turned.
    let envelope = context.reach_envelope(held.hand);
    if let Some((reason, change)) = envelope.beyond_all(&face.vector, &format!("the top of `{on}`"), &tips) {
        let certified = matches!(envelope, ReachEnvelope::Heights(..));
        return MotionAnswer::Infeasible(Infeasible {
            reason,
            change,
            certified,
            configuration: None,
            tight: None,
        });
    }
    let goal = GoalSpec {
        hand: held.hand,
        tips,
        manifold: None,
        allowed,
        checker: &checker,
        backs: &|_| over.into_iter().chain(LOWER).map(|up| Vector3::new(0.0, 0.0, up)).collect(),
    };
    match context.search_goal(&goal, budget) {
        Ok((at, path)) => {
            let tip = match at {
                GoalPose::Tip(at) => goal.tips.get(at).copied(),
                GoalPose::Grasp(hold) => Some(hold.map_from_tip),
            };
            let Some(tip) = tip else { return MotionAnswer::Unknown(UnknownReason::Budget) };
            MotionAnswer::Feasible(Box::new(put_down(context, &held, path, tip, allowed)))
        }
        // Other places were not tried.
        Err(MotionAnswer::Infeasible(Infeasible { certified: false, .. })) if is_cut => {
            MotionAnswer::Unknown(UnknownReason::Budget)
        }
        Err(none) => none,
    }
}

fn support_of(context: &QueryContext<'_>, entity: &Entity) -> Result<SupportSurface, MotionAnswer> {
    let unknown = |why: String| Err(MotionAnswer::Unknown(UnknownReason::Because(why)));
    let Some((pose, shape)) = context.state.pose(entity).zip(solid_shape(entity)) else {
        return unknown(format!("the pose or the shape of `{}` is unknown", entity.id));
    };
    let up = pose.rotation * Vector3::z();
    if up.z < 0.999 {
        return unknown(format!("`{}` does not stand upright", entity.id));
    }
    let (half, height, is_disc) = match shape {
        Shape::Box(half) => ([half.x, half.y], half.z, false),
        Shape::Cylinder { radius, half } => ([radius, radius], half, true),
        Shape::Capsule { .. } | Shape::HalfSpace => {
            return unknown(format!("no object stands on the round shape of `{}`", entity.id));
        }
    };
    if entity.travel.is_some() && !context.state.is_open(entity) {
        let reason = InfeasibleReason::NoFreePose { by: Some(entity.id.clone()), share: None };
        let change = Some(format!("open `{}` first", entity.id));
        return Err(MotionAnswer::Infeasible(Infeasible::proven(reason, change)));
    }
    let (face, inset) = match &entity.travel {
        // On the bottom of the container.
        Some(Travel::Slide { axis, distance }) => {
            (pose * Translation3::from(Vector3::from(*axis) * *distance), WALL)
        }
        Some(Travel::Hinge { .. }) => (pose, WALL),
        None => (pose, 0.0),
    };
    let deep = height;
    let height = if entity.travel.is_some() { WALL - height } else { height };
    let map_from_face = face * Translation3::new(0.0, 0.0, height);
    let walls = match &entity.travel {
        Some(Travel::Slide { .. }) => 2.0 * deep,
        Some(Travel::Hinge { .. }) | None => 0.0,
    };
    Ok(SupportSurface { map_from_face, half: half.map(|half| half - inset), walls, is_disc })
}

/// Free upright places of the held object, up to a number: the nearest to the robot, others spread over the
/// face, and half as many along the rim. Returns `true` where there are more.
fn places(
    context: &QueryContext<'_>,
    held: &HeldObject<'_>,
    (on, index): (&SupportSurface, usize),
    wanted: usize,
    met: &mut ContactTally,
) -> (Vec<Isometry3<f64>>, bool) {
    let solid = Solid::new(&Isometry3::identity(), held.shape);
    let bottom = solid.extent(&Vector3::z());
    let around = libm::hypot(solid.extent(&Vector3::x()), solid.extent(&Vector3::y()));
    let around = if matches!(held.shape, Shape::Box(_)) { around } else { solid.extent(&Vector3::x()) };
    // An object larger than the surface may overhang, with its centre on the centre.
    let spread = on.half.map(|half| (half - around).max(0.0));
    let [base_x, base_y, _] = context.state.robot.base;
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
        let others = context
            .obstacles
            .near([spot.x, spot.y], stands.reach() + Padding::new(context.clearance).arm)
            .map(|(_, obstacle)| obstacle);
        let mut others = others.filter(|obstacle| obstacle.entity != index);
        let other = others.find(|obstacle| !stands.is_farther(&obstacle.solid, obstacle.padding.arm));
        other.inspect(|other| met.add_entity(context.name(other.entity))).is_none()
    };
    let (mut chosen, mut is_cut) = (Vec::new(), false);
    for (spots, wanted) in [(sorted(over), wanted), (sorted(along), wanted / 2)] {
        let free: Vec<Vector3<f64>> =
            spots.into_iter().map(|(_, spot)| spot).filter(|spot| is_free(spot)).collect();
        let (near, far) = free.split_at(free.len().min(wanted / 2));
        // Every n-th by distance.
        let step = far.len().div_ceil(wanted / 2).max(1);
        chosen.extend(near.iter().chain(far.iter().step_by(step)).copied());
        is_cut |= step > 1;
    }
    let turned = chosen.into_iter().flat_map(|spot| (0..TURNS).map(move |turn| upright(spot, turn)));
    (turned.collect(), is_cut)
}

/// Witness of a motion with the held object.
pub(crate) fn put_down(
    context: &QueryContext<'_>,
    held: &HeldObject<'_>,
    path: Vec<Configuration>,
    map_from_tip: Isometry3<f64>,
    allowed: AllowedCollisions,
) -> MotionWitness {
    let points = map_from_tip.rotation * Vector3::from(held.hand.card.points);
    let side = if points.z < -0.819 { GraspSide::Top } else { GraspSide::Side };
    let (object, tip_from_object, width) = (held.id.clone(), held.tip_from_object, held.width);
    let grasp = Some(Grasp { object, side, map_from_tip, tip_from_object, width });
    let margins = Margins { payload: None, ..context.margins(&path, allowed) };
    MotionWitness { path, grasp, margins }
}

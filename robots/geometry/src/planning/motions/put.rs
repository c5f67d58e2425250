//! `put`: a place for the held object on a surface or in a container, and a path to it.

use motet_robots::scene::{Entity, Travel};
use nalgebra::{Isometry3, Point3, Translation3, Unit, UnitQuaternion, Vector3};

use crate::collision::{Shape, Solid};
use crate::kinematics::planar;
use crate::planning::certify::ExcludedPlaces;
use crate::planning::context::QueryContext;
use crate::planning::motions::place_goal::{PlaceGoal, above};
use crate::planning::placing::{Misfit, PlaceRules};
use crate::planning::query::{
    ContactTally, Grasp, GraspSide, Infeasible, InfeasibleReason, Margins, MotionAnswer, MotionWitness,
    SearchBudget, UnknownReason,
};
use crate::planning::scene::{
    ABOVE, AllowedCollisions, Configuration, HeldObject, Padding, SupportSurface, WALL, solid_shape,
};
use crate::planning::search::{GoalPose, GoalSpec, LAST, PLANE, ReachEnvelope, part};
use crate::trigonometry::turn;

/// Heights in m from which the object is lowered straight down; the shorter where the longer is blocked.
const LOWER: [f64; 2] = [0.1, 0.05];
/// Places of the usual budget: half of them the nearest to the robot, half spread over the face; and half
/// as many along the rim, where the hand has room beside the object.
const PLACES: usize = 16;
/// Greatest factor of the places for a larger budget.
const MOST_TIMES: usize = 16;
/// Number of places that are tried once more by themselves, and of such rounds, where rules leave some only.
const AGAIN: usize = 4;
/// Number of rotations of the object.
const TURNS: u32 = 8;

/// Answers `put`: a place for the held object `id` on `on`, by some rules.
pub(crate) fn put(
    context: &QueryContext<'_>,
    (id, on): (&str, &str),
    rules: &PlaceRules,
    budget: SearchBudget,
) -> MotionAnswer {
    let unknown = |why: String| MotionAnswer::Unknown(UnknownReason::Because(why));
    let Some(held) = context.held_object(id) else {
        return unknown(format!("the hand does not hold `{id}`"));
    };
    if let Some(answer) = context.unheld(&held) {
        return answer;
    }
    let Some((index, entity)) = context.entity(on) else { return unknown(format!("there is no `{on}`")) };
    if id == on {
        return unknown(format!("`{id}` does not stand on itself"));
    }
    let found = support_of(context, entity).and_then(|support| {
        let order = PlaceGoal::new(context, &held, (on, &support), rules)?;
        let task = PutTask { context, held: &held, on, index, support: &support, order: &order, budget };
        let mut met = ContactTally::default();
        let (spots, is_cut) = task.spots(&mut met)?;
        if spots.is_empty() { Err(task.none(rules, &met)) } else { task.path(&spots, is_cut) }
    });
    match found {
        Ok(witness) => MotionAnswer::Feasible(Box::new(witness)),
        Err(answer) => answer,
    }
}

/// One object to put down on one support.
struct PutTask<'t, 'w> {
    context: &'t QueryContext<'w>,
    held: &'t HeldObject<'t>,
    /// Support by its id, its index in the scene and its face.
    on: &'t str,
    index: usize,
    support: &'t SupportSurface,
    order: &'t PlaceGoal,
    budget: SearchBudget,
}

/// Places of an object by spot: at each in one or several turns.
type Spots = Vec<Vec<Isometry3<f64>>>;

impl PutTask<'_, '_> {
    /// Places to try, and `true` where there are more.
    ///
    /// # Errors
    ///
    /// The answer where the pose that is asked for is none on the support.
    fn spots(&self, met: &mut ContactTally) -> Result<(Spots, bool), MotionAnswer> {
        let Self { context, held, on, index, support, order, budget } = *self;
        if let Some(pose) = &order.at {
            let place = order.place_at(pose, held.shape, (on, support))?;
            let is_free = is_free(context, &Solid::new(&place, held.shape), index, met);
            return Ok((if is_free { vec![vec![place]] } else { vec![] }, false));
        }
        let wanted = PLACES * (budget.candidates / SearchBudget::default().candidates).clamp(1, MOST_TIMES);
        Ok(places(context, held, (support, index), order, wanted, met))
    }

    /// Answer where no place is free.
    fn none(&self, rules: &PlaceRules, met: &ContactTally) -> MotionAnswer {
        let order = self.order;
        let reason = if order.excludes {
            let (on, rules, by) = (self.on.into(), Box::new(rules.clone()), met.most());
            InfeasibleReason::NoPlace(Misfit::Taken { on, rules, by })
        } else {
            met.none_free()
        };
        let excluded = |point: [f64; 2], off: f64, radii: [f64; 2]| order.is_excluded(point, off, radii);
        let excluded = order.excludes.then_some(&excluded as &ExcludedPlaces<'_>);
        // One pose was checked as it is; the cover knows upright objects only.
        let certified = order.at.is_some()
            || (!order.may_lie && self.context.is_full(self.held, self.support, self.index, excluded));
        MotionAnswer::Infeasible(Infeasible { certified, ..Infeasible::exhausted(reason) })
    }

    /// Path to one of some places.
    ///
    /// # Errors
    ///
    /// The answer where none was found.
    fn path(&self, spots: &Spots, is_cut: bool) -> Result<MotionWitness, MotionAnswer> {
        let Self { context, held, on, index, support, order, budget } = *self;
        let allowed = AllowedCollisions { held: Some(index), ..AllowedCollisions::default() };
        let face = support.map_from_face.translation;
        let wide = libm::hypot(support.half[0], support.half[1]);
        let checker = context.around([face.x, face.y], context.farthest(held.hand) + wide + LAST);
        // Into a drawer the object comes from above its walls.
        let over = (support.walls > 0.0).then(|| support.walls + LOWER[1]);
        let tip_from_place = held.tip_from_object.inverse();
        let tips_of = |spots: &mut dyn Iterator<Item = &Vec<Isometry3<f64>>>| -> Vec<Isometry3<f64>> {
            spots.flatten().map(|place| place * tip_from_place).collect()
        };
        let tips = tips_of(&mut spots.iter());
        // Upright at one height, the wrist is at one height too, wherever the object is and however it is
        // turned.
        let envelope = context.reach_envelope(held.hand);
        if let Some((reason, change)) =
            envelope.beyond_all(&face.vector, &format!("the top of `{on}`"), &tips)
        {
            let certified = matches!(envelope, ReachEnvelope::Heights(..)) && !order.may_lie;
            let none = Infeasible { change, certified, ..Infeasible::exhausted(reason) };
            return Err(MotionAnswer::Infeasible(none));
        }
        let search = |tips: Vec<Isometry3<f64>>| {
            let goal = GoalSpec {
                closes: &|_| None,
                hand: held.hand,
                tips,
                manifold: None,
                allowed,
                checker: &checker,
                backs: &|_| over.into_iter().chain(LOWER).map(|up| Vector3::new(0.0, 0.0, up)).collect(),
            };
            let (at, path) = context.search_goal(&goal, budget)?;
            let tip = match at {
                GoalPose::Tip(at) => goal.tips.get(at).copied(),
                GoalPose::Grasp(hold) => Some(hold.map_from_tip),
            };
            Ok((tip.ok_or(MotionAnswer::Unknown(UnknownReason::Budget))?, path))
        };
        let mut found = search(tips);
        if found.is_err() && order.may_lie {
            // The poses in which it lies took most of the budget.
            let is_upright = |turns: &&Vec<Isometry3<f64>>| {
                turns.first().is_some_and(|place| (place.rotation * Vector3::z()).z > 0.999)
            };
            found = search(tips_of(&mut spots.iter().filter(is_upright))).or(found);
        }
        if order.excludes && spots.len() > AGAIN {
            // The more poses share the budget, the fewer candidates each has: few places again, spread over
            // all.
            let stride = spots.len().div_ceil(AGAIN);
            let rounds = (0..AGAIN).map(|round| round * stride / AGAIN);
            for first in rounds.take_while(|first| *first < stride) {
                if found.is_err() {
                    found = search(tips_of(&mut spots.iter().skip(first).step_by(stride))).or(found);
                }
            }
        }
        match found {
            Ok((tip, path)) => Ok(put_down(context, held, path, tip, allowed)),
            // Other places were not tried.
            Err(MotionAnswer::Infeasible(Infeasible { certified: false, .. })) if is_cut => {
                Err(MotionAnswer::Unknown(UnknownReason::Budget))
            }
            Err(none) => Err(none),
        }
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

/// Checks whether an object that stands there touches nothing but its support.
fn is_free(context: &QueryContext<'_>, stands: &Solid, support: usize, met: &mut ContactTally) -> bool {
    let place = [stands.centre.x, stands.centre.y];
    let others = context
        .obstacles
        .near(place, stands.reach() + Padding::new(context.clearance).arm)
        .map(|(_, obstacle)| obstacle);
    let mut others = others.filter(|obstacle| obstacle.entity != support);
    let other = others.find(|obstacle| !stands.is_farther(&obstacle.solid, obstacle.padding.arm));
    other.inspect(|other| met.add_entity(context.name(other.entity))).is_none()
}

/// Orientations in which an object may stand, before it is turned about the vertical.
fn rests(shape: Shape, may_lie: bool) -> Vec<UnitQuaternion<f64>> {
    let quarter = |axis: Unit<Vector3<f64>>| turn(&axis, std::f64::consts::FRAC_PI_2);
    let lying = match shape {
        _ if !may_lie => vec![],
        Shape::Box(_) => vec![quarter(Vector3::x_axis()), quarter(Vector3::y_axis())],
        Shape::Cylinder { .. } => vec![quarter(Vector3::x_axis())],
        Shape::Capsule { half, .. } if half > 0.0 => vec![quarter(Vector3::x_axis())],
        Shape::Capsule { .. } | Shape::HalfSpace => vec![],
    };
    std::iter::once(UnitQuaternion::identity()).chain(lying).collect()
}

/// Free places of the held object that fit the rules, up to a number: the nearest to the robot, others
/// spread over the face, half as many along the rim, and some around what the rules name. Returns `true`
/// where there are more.
fn places(
    context: &QueryContext<'_>,
    held: &HeldObject<'_>,
    (on, index): (&SupportSurface, usize),
    order: &PlaceGoal,
    wanted: usize,
    met: &mut ContactTally,
) -> (Spots, bool) {
    let (mut chosen, mut is_cut) = (Vec::new(), false);
    for rest in rests(held.shape, order.may_lie) {
        let lies = Isometry3::from_parts(Translation3::identity(), rest);
        let solid = Solid::new(&lies, held.shape);
        let bottom = solid.extent(&Vector3::z());
        let [wide, deep] = [Vector3::x(), Vector3::y()].map(|axis| solid.extent(&axis));
        let is_round = !matches!(held.shape, Shape::Box(_)) && rest == UnitQuaternion::identity();
        let around = if is_round { wide } else { libm::hypot(wide, deep) };
        // An object larger than the surface may overhang, with its centre on the centre. Away from the rim
        // each turn is checked for itself.
        let from_rim = if order.from_edge > 0.0 { wide.min(deep) + order.from_edge } else { around };
        let spread = on.half.map(|half| (half - from_rim).max(0.0));
        let scaled = |[x, y]: [f64; 2]| {
            (on.map_from_face * Point3::new(x * spread[0], y * spread[1], bottom + ABOVE)).coords
        };
        let over =
            (0..4 * wanted).map(|at| [part(at, 1, PLANE), part(at, 2, PLANE)].map(|part| 2.0 * part - 1.0));
        let over = over.filter(|[x, y]| !on.is_disc || x * x + y * y <= 1.0).map(scaled).collect();
        let along = (0..2 * wanted).map(|at| scaled(on.rim(at as f64 / (2 * wanted) as f64))).collect();
        let is_within = |spot: &Vector3<f64>| {
            let at = on.map_from_face.inverse() * Point3::from(*spot);
            let [x, y] = [at.x, at.y].map(f64::abs);
            if on.is_disc { libm::hypot(x, y) <= spread[0] } else { x <= spread[0] && y <= spread[1] }
        };
        let named = order.spots(around).into_iter().map(|spot| above(on, spot, bottom + ABOVE));
        let named: Vec<Vector3<f64>> = named.filter(is_within).collect();
        let posed = |spot: &Vector3<f64>, step: u32| {
            let angle = std::f64::consts::TAU * f64::from(step) / f64::from(TURNS);
            let rotation: UnitQuaternion<f64> = planar(0.0, 0.0, angle).rotation;
            Isometry3::from_parts(Translation3::from(*spot), rotation * rest)
        };
        let mut fitting = |spot: Vector3<f64>| -> Option<Vec<Isometry3<f64>>> {
            let turned = (0..TURNS).map(|step| posed(&spot, step));
            if !order.excludes {
                let stands = Solid::new(&posed(&spot, 0), held.shape);
                return is_free(context, &stands, index, met).then(|| turned.collect());
            }
            let fits = |place: &Isometry3<f64>| {
                let stands = Solid::new(place, held.shape);
                order.fits(&stands) && is_free(context, &stands, index, met)
            };
            Some(turned.filter(fits).collect()).filter(|turned: &Vec<_>| !turned.is_empty())
        };
        for (spots, wanted) in [(over, wanted), (along, wanted / 2), (named, wanted)] {
            let free: Vec<_> = sorted(context, spots).into_iter().filter_map(&mut fitting).collect();
            let (near, far) = free.split_at(free.len().min(wanted / 2));
            // Every n-th by distance.
            let step = far.len().div_ceil(wanted / 2).max(1);
            chosen.extend(near.iter().chain(far.iter().step_by(step)).cloned());
            is_cut |= step > 1;
        }
    }
    (chosen, is_cut)
}

/// Spots by their distance from the base, the nearest first.
fn sorted(context: &QueryContext<'_>, spots: Vec<Vector3<f64>>) -> Vec<Vector3<f64>> {
    let [base_x, base_y, _] = context.state.robot.base;
    let far = |spot: &Vector3<f64>| libm::hypot(spot.x - base_x, spot.y - base_y);
    let mut spots = spots;
    spots.sort_by(|one, other| far(one).total_cmp(&far(other)));
    spots
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

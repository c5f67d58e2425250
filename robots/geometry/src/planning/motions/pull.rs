//! `pull` and `push` of what opens: the hand takes the handle and follows it along the container's own travel, the whole
//! robot with it.
//!
//! The robot follows in one of two ways. Its base goes along with the arm still: beside the handle, or turning with the
//! door, or half of each, the hand turning about the bar that it holds. Or the base stands still and the arm follows. Each leg is certified
//! with the door or drawer moving: a solid and a part of the robot are far enough from each other in the middle of a leg
//! that what both go until its ends cannot bring them together; else the leg is halved.

use std::ops::ControlFlow;

use nalgebra::{Isometry3, Point3, Translation3, Unit, UnitQuaternion, Vector3};

use crate::collision::{Shape, Solid};
use crate::planning::certify::infeasibility::Certificate;
use crate::planning::grasp::candidates::GraspCandidate;
use crate::planning::grasp::manifold::GraspManifold;
use crate::planning::motions::follow::{FollowMode, HandSlide};
use crate::planning::motions::reach::certain;
use crate::planning::query::answer::{
    Grasp, GraspSide, Infeasible, InfeasibleReason, Margins, MotionAnswer, MotionWitness, SearchBudget,
    UnknownReason,
};
use crate::planning::scene::articulation::{Articulation, THICK};
use crate::planning::scene::configuration::Configuration;
use crate::planning::scene::contact::AllowedCollisions;
use crate::planning::scene::robot_model::HandModel;
use crate::planning::search::context::QueryContext;
use crate::planning::search::goal_search::LAST;
use crate::planning::search::path::{ContactTally, exhausted};
use crate::trigonometry::turn;

/// How far before a handle the hand turns straight towards it, in m; the shorter where the longer does not do.
const BACK: [f64; 2] = [0.1, 0.05];
/// How far the finger tips reach beyond the middle of a handle, in m.
const BEYOND: f64 = 0.01;
/// Directions from which a handle is taken, as angles about it in rad from square to its face.
const TILTS: [f64; 5] = [0.0, 0.52, -0.52, 1.05, -1.05];
/// Places along a handle, as shares of half of its length.
const PLACES: [f64; 3] = [0.0, 0.6, -0.6];

/// A handle to be taken and where it goes.
pub(crate) struct HandlePull<'a> {
    pub(crate) id: &'a str,
    pub(crate) hand: &'a HandModel,
    pub(crate) opening: Articulation,
    /// From how far open to how far open.
    pub(crate) parts: [f64; 2],
    /// How far before the tip the middle of the bar is, in m.
    depth: f64,
}

impl QueryContext<'_> {
    /// A container opened, `parts` `[0, 1]`, or closed, `[1, 0]`, by its handle.
    pub(crate) fn pull(&self, id: &str, parts: [f64; 2], budget: SearchBudget) -> MotionAnswer {
        let unknown = |why: String| MotionAnswer::Unknown(UnknownReason::Because(why));
        let Some((index, entity)) = self.entity(id) else { return unknown(format!("there is no `{id}`")) };
        let Some(hand) = self.model.hand() else {
            return unknown("the card names no hand with a tip".into());
        };
        if let Some((held, _)) = &self.state.held {
            return unknown(format!("the hand holds `{held}`"));
        }
        if entity.travel.is_none() {
            return unknown(format!("`{id}` has nothing that opens"));
        }
        let [from, to] = parts;
        if self.state.is_open(entity) != (from > to) {
            let is = if from > to { "closed" } else { "open" };
            return unknown(format!("`{id}` is {is} already"));
        }
        let Some(opening) = Articulation::new(entity, self.state) else {
            return unknown(format!("how `{id}` opens does not follow from its shape"));
        };
        let (clear, contents) = self.without(index, &opening, from);
        let opening = opening.with(contents);
        if let Some(by) = clear.stops(&opening, parts) {
            let change = Some(format!("take `{by}` out of its way"));
            return certain(InfeasibleReason::BlockedPath { by: Some(by) }, change);
        }
        let depth = (self.front_around(hand, THICK) - BEYOND).max(hand.palm + THICK / 2.0);
        let pull = HandlePull { id, hand, opening, parts, depth };
        let all = pull.holds();
        let tips: Vec<_> = all.iter().map(|hold| hold.map_from_tip).collect();
        let mut poses = ContactTally::default();
        let free = self.free_holds(hand, &all, &tips, &mut poses);
        let answer = self.search_pull(&pull, &clear, &free, budget, poses);
        let MotionAnswer::Infeasible(found) = answer else { return answer };
        let bar = (pull.opening.map_moved(from) * pull.opening.handle().centre).coords;
        MotionAnswer::Infeasible(
            match self.span(hand).beyond_all(&bar, &format!("the handle of `{id}`"), &tips) {
                Some((reason, change)) => Infeasible { reason, change, ..found },
                None => found,
            },
        )
    }

    /// The holds in which the hand alone touches nothing, of those with these poses of its tip. What it touches is in the way of every
    /// arm.
    fn free_holds<'h>(
        &self,
        hand: &HandModel,
        all: &'h [GraspCandidate],
        tips: &[Isometry3<f64>],
        met: &mut ContactTally,
    ) -> Vec<&'h GraspCandidate> {
        let hand_checker = self.palm(hand, tips, AllowedCollisions::default());
        let is_free = |hold: &&GraspCandidate| {
            hand_checker.contact(&hold.map_from_tip).map(|contact| met.add(&contact)).is_none()
        };
        all.iter().filter(is_free).collect()
    }

    fn search_pull(
        &self,
        pull: &HandlePull<'_>,
        clear: &QueryContext<'_>,
        holds: &[&GraspCandidate],
        budget: SearchBudget,
        mut poses: ContactTally,
    ) -> MotionAnswer {
        let end = clear.beside(&pull.opening, pull.parts[1]);
        let bar = pull.opening.map_moved(pull.parts[0]) * pull.opening.handle().centre;
        let wide = self.farthest(pull.hand) + pull.opening.handle().half + pull.depth + LAST;
        let checker = self.around([bar.x, bar.y], wide);
        let mut ways = ContactTally::default();
        let (mut tried, mut is_cut_off, mut is_free) = (0, false, false);
        for at in 0..budget.candidates {
            for hold in holds {
                for configuration in self.candidates(pull.hand, &hold.map_from_tip, at) {
                    if !self.is_near_drivable(configuration.base) {
                        is_cut_off = true;
                        continue;
                    }
                    if let Some(contact) = checker.contact(&configuration, AllowedCollisions::default()) {
                        poses.add(&contact);
                        continue;
                    }
                    is_free = true;
                    let mut path = None;
                    for following in pull.followings(self.model) {
                        let Some(last) = clear.follows_to(pull, hold, &configuration, following) else {
                            continue;
                        };
                        if let Some(contact) = end.contact(&last, AllowedCollisions::default()) {
                            ways.add(&contact);
                            continue;
                        }
                        tried += 1;
                        path = clear.follow(pull, hold, &configuration, following, &mut ways);
                        if path.is_some() {
                            break;
                        }
                    }
                    let found = path.and_then(|way| {
                        Some((self.way_to_handle(pull, hold, &configuration, &mut ways)?, way))
                    });
                    if let Some((way_in, way)) = found {
                        return MotionAnswer::Feasible(Box::new(
                            self.pulled_along(pull, clear, hold, way_in, way),
                        ));
                    }
                    if tried >= budget.paths {
                        return MotionAnswer::Unknown(UnknownReason::Budget);
                    }
                }
            }
        }
        // Where a free state was found there is nothing to prove.
        if !is_free {
            let manifold = pull.manifold();
            let none = AllowedCollisions::default();
            let covered =
                checker.covered(pull.hand, &manifold, none, budget.cells, |_, _| ControlFlow::Break(()));
            if covered == Certificate::Nowhere {
                return certain(poses.none_free(), None);
            }
        }
        exhausted(is_free || is_cut_off, &poses, &ways)
    }

    /// A way from where the robot is to a state at the handle, which the hand then closes around.
    fn way_to_handle(
        &self,
        pull: &HandlePull<'_>,
        hold: &GraspCandidate,
        configuration: &Configuration,
        met: &mut ContactTally,
    ) -> Option<Vec<Configuration>> {
        BACK.into_iter().find_map(|back| {
            let mut line = self.approach(pull.hand, configuration, &hold.map_from_tip, back)?;
            line.push(self.gripping(pull.hand, configuration));
            let inwards = line.first()?.inwards(&hold.map_from_tip.translation.vector);
            self.route_along(&line, inwards, AllowedCollisions::default(), met)
        })
    }

    /// A state with the fingers around a handle.
    pub(crate) fn gripping(&self, hand: &HandModel, configuration: &Configuration) -> Configuration {
        Configuration {
            base: configuration.base,
            joints: hand.around(&configuration.joints, self.model.rest(), THICK),
        }
    }

    fn pulled_along(
        &self,
        pull: &HandlePull<'_>,
        clear: &QueryContext<'_>,
        hold: &GraspCandidate,
        way_in: Vec<Configuration>,
        way: Vec<Configuration>,
    ) -> MotionWitness {
        let none = AllowedCollisions::default();
        let first = self.margins(&way_in, none);
        let second = clear.margins(&way, none);
        let count = way.len().saturating_sub(1).max(1) as f64;
        let [from, to] = pull.parts;
        // The door itself, at the way-points.
        let nearest = way.iter().zip(0..).map(|(configuration, at)| {
            let part = from + (to - from) * (f64::from(at) / count);
            clear.beside(&pull.opening, part).clearance(configuration, none)
        });
        let clearance = nearest.fold(first.clearance.min(second.clearance), f64::min);
        let turns = way_in.last().zip(way.first()).map_or(0.0, |(end, begin)| end.base[2] - begin.base[2]);
        let mut path = way_in;
        path.extend(way.iter().skip(1).map(|configuration| configuration.turned(turns)));
        let limit = [first.limit, second.limit].into_iter().flatten().reduce(f64::min);
        let grasp = Some(Grasp {
            object: pull.id.into(),
            side: hold.side,
            map_from_tip: hold.map_from_tip,
            tip_from_object: hold.map_from_tip.inverse() * pull.map_from_handle(pull.parts[0]),
            width: hold.width,
        });
        MotionWitness { path, grasp, margins: Margins { clearance, limit, payload: None } }
    }
}

impl HandlePull<'_> {
    /// The ways in which the robot may follow.
    pub(crate) fn followings(
        &self,
        model: &crate::planning::scene::robot_model::RobotModel,
    ) -> Vec<FollowMode> {
        use motet_robots::card::Drive;
        let mut all = Vec::new();
        let turns_level = self.opening.hinge().is_none_or(|(axis, _)| axis.z.abs() > 1.0 - 1e-9);
        if turns_level && matches!(model.card().base.drive, Drive::Omnidirectional | Drive::Legged) {
            let turnings: &[f64] = if self.opening.hinge().is_some() { &[1.0, 0.5, 0.0] } else { &[0.0] };
            all.extend(turnings.iter().map(|share| FollowMode::Base(HandSlide(*share))));
        }
        if !matches!(self.hand.solver, crate::planning::scene::ik_solver::IkSolver::Lift(_)) {
            let turnings: &[f64] = if self.opening.hinge().is_some() { &[0.5, 0.0, 1.0] } else { &[0.0] };
            all.extend(turnings.iter().map(|share| FollowMode::Arm(HandSlide(*share))));
        }
        all
    }

    /// The middle of the handle with the directions of its bar.
    fn map_from_handle(&self, part: f64) -> Isometry3<f64> {
        let handle = self.opening.handle();
        let rotation = UnitQuaternion::face_towards(&handle.along, &handle.out);
        self.opening.map_moved(part)
            * Isometry3::from_parts(Translation3::from(handle.centre.coords), rotation)
    }

    /// Poses of the hand around the handle, in a fixed order.
    fn holds(&self) -> Vec<GraspCandidate> {
        let handle = self.opening.handle();
        let moved = self.opening.map_moved(self.parts[0]);
        let axis = Unit::new_normalize(handle.along);
        let mut all = Vec::new();
        for tilt in TILTS {
            let approach = turn(&axis, tilt) * -handle.out;
            let closes = handle.along.cross(&approach);
            for place in PLACES {
                for closes in [closes, -closes] {
                    let bar = handle.centre + handle.along * (place * handle.half);
                    let rotation = self.hand.turned(&approach, &closes);
                    let at = bar.coords - approach * self.depth - closes * self.hand.middle(THICK);
                    let pose = Isometry3::from_parts(Translation3::from(at), rotation);
                    let approach = moved.rotation * approach;
                    let side = if approach.z < -0.819 { GraspSide::Top } else { GraspSide::Side };
                    // From below there is no way for a hand.
                    if approach.z <= 0.5 {
                        all.push(GraspCandidate { map_from_tip: moved * pose, approach, side, width: THICK });
                    }
                }
            }
        }
        all
    }

    /// All of them, and not only these.
    fn manifold(&self) -> GraspManifold<'_> {
        let handle = self.opening.handle();
        let moved = self.opening.map_moved(self.parts[0]);
        let (along, out) = (moved.rotation * handle.along, moved.rotation * handle.out);
        let shape = Shape::Capsule { radius: THICK / 2.0, half: handle.half };
        let bar =
            Solid { centre: (moved * handle.centre).coords, axes: [out, along.cross(&out), along], shape };
        let most = |all: &[f64]| all.iter().copied().fold(0.0, f64::max);
        GraspManifold::of_bar(self.hand, &bar, out, self.depth, [most(&TILTS), most(&PLACES)])
    }

    /// The point of the bar that a hold is about, where the bar is at the beginning.
    pub(crate) fn bar(&self, hold: &GraspCandidate) -> Point3<f64> {
        let closes = hold.map_from_tip.rotation * Vector3::from(self.hand.card.closes);
        let from_tip = hold.approach * self.depth + closes * self.hand.middle(THICK);
        Point3::from(hold.map_from_tip.translation.vector + from_tip)
    }
}

/// Away from what a hand points at.
pub(crate) fn away(map_from_tip: &Isometry3<f64>, hand: &HandModel, far: f64) -> Vector3<f64> {
    map_from_tip.rotation * -Vector3::from(hand.card.points) * far
}

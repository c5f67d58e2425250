//! Tracker of the world of a run, updated as its calls end, for the motions that were deferred.
//!
//! It asks the same queries as the interpretation of a policy, but along the one path of the run. While the
//! pose of the robot or a thing is unknown, every motion is unknown.

use std::collections::BTreeMap;
use std::sync::Arc;

use motet_geometry::planning::{Infeasible, MapPose, MotionAnswer, MotionQuery, UnknownReason};
use motet_graph::{Configuration, Manner, Value, Witness};
use motet_robots::scene::{Entity as SceneEntity, Grip};
use motet_stdlib::lang;
use smol_str::{SmolStr, format_smolstr};

use super::geometry::{Fingerprinted, Geometry, SceneChange};
use super::motion::{
    MotionArg, MotionEffect, failures, makes, may_move, motion_effect, motion_query, moves_blindly,
    moves_robot_only, side_of,
};
use super::transfer::{graph_witness, leaves};
use crate::declare::{Library, PrimitiveDef};
use crate::ir::{Entity, MotionKind, ROBOT, START, Term};

/// World of a run. `Send`; one tracker belongs to one run.
#[derive(Debug)]
pub struct WorldTracker {
    library: Arc<Library>,
    geometry: Arc<Geometry>,
    /// The world, or the reason why it is unknown.
    at: Result<Arc<Fingerprinted>, SmolStr>,
    /// The world but for the place of the robot, until that is known.
    stranded: Option<Arc<Fingerprinted>>,
    /// Thing that the hand may hold or not since a call broke off, until that is known.
    loose: Option<SmolStr>,
    /// True if an observation contradicts the world since something began to move.
    is_doubted: bool,
    /// Number of active calls that move the robot or a thing.
    moving: u32,
    /// Things that were seen while something moved: they stand there once that is over.
    seen: Vec<SceneEntity>,
    /// Grip that the robot felt: the hand holds the thing so once that is over.
    felt: Option<Grip>,
}

/// Forecast of a motion.
#[derive(Clone, PartialEq, Debug)]
pub enum Forecast {
    /// A motion was found.
    Feasible {
        /// Its path, from where the robot stands.
        witness: Box<Witness>,
        /// Configuration in which a success leaves the robot, if it is known.
        leaves: Option<Box<Configuration>>,
    },
    /// Infeasibility is proven.
    Infeasible {
        /// The most specific failure that the primitive lists.
        failure: SmolStr,
        /// Reason with its numbers, and a proposed change.
        why: String,
    },
    Unknown {
        why: String,
    },
}

/// A call of a run: a primitive with the values of its parameters, in order.
#[derive(Clone, Copy, Debug)]
struct ExecutedCall<'a> {
    def: &'a PrimitiveDef,
    args: &'a [(SmolStr, Value)],
    result: Option<&'a Value>,
}

impl WorldTracker {
    pub(crate) fn new(library: Arc<Library>, geometry: Arc<Geometry>) -> Self {
        let at = geometry.start();
        Self {
            library,
            geometry,
            at,
            stranded: None,
            loose: None,
            is_doubted: false,
            moving: 0,
            seen: Vec::new(),
            felt: None,
        }
    }

    /// Forecasts a motion with the arguments `of` for a call of a primitive, in its manner, in the present
    /// world.
    #[must_use]
    pub fn motion(
        &self,
        primitive: &str,
        (args, manner): (&[(SmolStr, Value)], Option<Manner>),
        motion: &str,
        of: &[Value],
    ) -> Forecast {
        let unknown = |why: &str| Forecast::Unknown { why: why.to_owned() };
        let Some(def) = primitive_of(&self.library, primitive) else {
            return unknown("the primitive is not known");
        };
        let at = match &self.at {
            Ok(_) if self.moving > 0 => return unknown("something else moves at the same time"),
            Ok(at) => at,
            Err(why) => return unknown(why),
        };
        let Some(args_of) = of.iter().map(motion_arg).collect::<Option<Vec<_>>>() else {
            return unknown("an argument is not in the scene");
        };
        let Some(kind) = MotionKind::from_name(motion) else { return unknown("the motion is not known") };
        match &*self.geometry.answer(at, &motion_query(kind, &args_of, side(args))) {
            MotionAnswer::Feasible(motion) => {
                let machine = self.geometry.machine();
                let witness = Box::new(graph_witness(machine, &at.world, motion, manner));
                let call = ExecutedCall { def, args, result: None };
                let end = after(&self.library, &self.geometry, at, call);
                let leaves =
                    end.ok().map(|end| Box::new(leaves(machine, &witness, motion, &end.world.robot)));
                Forecast::Feasible { witness, leaves }
            }
            MotionAnswer::Infeasible(why) if why.certified => self.infeasible(def, why),
            MotionAnswer::Infeasible(why) => unknown(&format!("the search found no motion: {}", why.reason)),
            MotionAnswer::Unknown(UnknownReason::Budget) => unknown("the search was cut short"),
            MotionAnswer::Unknown(UnknownReason::Because(why)) => unknown(why),
        }
    }

    /// Records the start of a call.
    pub fn began(&mut self, primitive: &str) {
        self.take_in();
        if self.is_moving(primitive) {
            self.is_doubted &= self.moving > 0;
            self.moving += 1;
            if self.moving > 1 {
                self.lose("two things moved at the same time");
            }
        }
    }

    /// Records the success of a call.
    pub fn succeeded(&mut self, primitive: &str, args: &[(SmolStr, Value)], result: Option<&Value>) {
        self.over(primitive);
        let Some(def) = primitive_of(&self.library, primitive) else { return };
        let Ok(at) = &self.at else {
            // What it did to things is not known of the world before.
            self.stranded = self.stranded.take().filter(|_| moves_robot_only(&self.library, def));
            return;
        };
        match after(&self.library, &self.geometry, at, ExecutedCall { def, args, result }) {
            Ok(at) => self.at = Ok(at),
            Err(lost) => {
                self.lose(&lost.why);
                self.stranded = lost.stranded;
            }
        }
        self.take_in();
    }

    /// Records that a call was refused before it moved anything.
    pub fn refused(&mut self, primitive: &str) {
        self.over(primitive);
        self.take_in();
    }

    /// Records that a call failed or was interrupted.
    pub fn stopped(&mut self, primitive: &str, args: &[(SmolStr, Value)]) {
        self.over(primitive);
        if !self.is_moving(primitive) {
            return;
        }
        let before = self.at.clone().ok().or_else(|| self.stranded.take()).filter(|_| !self.is_doubted);
        let loose = self.loose.take();
        self.lose(&format!("where `{primitive}` stopped is not known"));
        let Some(def) = primitive_of(&self.library, primitive) else { return };
        if moves_robot_only(&self.library, def) {
            (self.stranded, self.loose) = (before, loose);
        } else if let Some((MotionKind::Reach | MotionKind::ReachAt | MotionKind::Put, terms)) = &def.motion {
            let call = ExecutedCall { def, args, result: None };
            self.loose = terms.first().and_then(|term| named(&self.library, term, call));
            self.stranded = before.filter(|_| self.loose.is_some() && loose.is_none());
        }
    }

    /// Takes in where the robot stands: base pose x, y in m and yaw in rad in the frame `map`, and positions
    /// of joints by name, in rad or m. Behind a call that broke off, or that ended where no way back was
    /// found, motions are found from there, unless a joint is beyond its limits; otherwise nothing changes.
    pub fn stands(&mut self, base: [f64; 3], joints: &BTreeMap<SmolStr, f64>) {
        if self.moving > 0 || self.loose.is_some() {
            return;
        }
        let Some(before) = self.stranded.take() else { return };
        if let Some(at) = self.geometry.standing(&before, base, joints) {
            self.at = Ok(at);
            self.take_in();
        }
    }

    /// Records that a hand is free. Behind a grasp that broke off, the thing then stands near its place.
    pub fn freed(&mut self) {
        let hand = self.library.lang_items.hand.and_then(|hand| self.library.enums.get(hand.index()));
        if hand.is_some_and(|hand| hand.cases.len() == 1) {
            self.emptied();
        }
    }

    /// Records that all hands are empty.
    pub fn emptied(&mut self) {
        if let Some(loose) = self.loose.take_if(|_| self.moving == 0)
            && let Some(before) = self.stranded.take()
        {
            let (geometry, before) = self.geometry.without(&before, &loose);
            (self.geometry, self.stranded) = (geometry, Some(before));
        }
    }

    /// Takes in things where they were seen, also those that the scene lacks. What the hand holds stays
    /// there. While something moves, they are taken in when that is over, because the motion was found
    /// without them.
    pub fn saw(&mut self, things: Vec<SceneEntity>) {
        self.seen.retain(|known| things.iter().all(|thing| thing.id != known.id));
        self.seen.extend(things);
        self.take_in();
    }

    /// Takes in how the hand holds a thing, as the robot felt it.
    pub fn felt(&mut self, grip: Grip) {
        self.felt = Some(grip);
        self.take_in();
    }

    fn take_in(&mut self) {
        let Ok(at) = &self.at else { return };
        if self.moving > 0 || (self.seen.is_empty() && self.felt.is_none()) {
            return;
        }
        let seen = std::mem::take(&mut self.seen).into_iter().filter(|thing| !at.world.holds(&thing.id));
        let (geometry, at) = Geometry::seeing(&self.geometry, at, self.felt.take().as_ref(), seen);
        (self.geometry, self.at) = (geometry, Ok(at));
    }

    /// Records an observation of `holding` or `open`. If it contradicts the tracked world, the world is
    /// unknown.
    pub fn observed(&mut self, fluent: &str, entity: &str, holds: bool) {
        if fluent == lang::fluents::HOLDING && self.loose.as_deref() == Some(entity) {
            if !holds {
                self.emptied();
            }
            return;
        }
        let Some(at) = self.at.as_ref().ok().or(self.stranded.as_ref()) else { return };
        let id = self.library.names.fluents.get(fluent).copied();
        let here = id.and_then(|id| self.geometry.holds(&self.library, &at.world, id, entity));
        if here.is_none_or(|here| here == holds) {
            return;
        }
        // While something moves it may be so already.
        self.is_doubted = true;
        if self.moving == 0 {
            self.lose(&format!("`{fluent}({entity})` changed unexpectedly"));
        }
    }

    fn over(&mut self, primitive: &str) {
        if self.is_moving(primitive) {
            self.moving = self.moving.saturating_sub(1);
        }
    }

    fn lose(&mut self, why: &str) {
        (self.stranded, self.loose) = (None, None);
        if self.at.is_ok() {
            self.at = Err(why.into());
        }
    }

    fn is_moving(&self, primitive: &str) -> bool {
        primitive_of(&self.library, primitive).is_some_and(|def| may_move(&self.library, def))
    }

    fn infeasible(&self, def: &PrimitiveDef, why: &Infeasible) -> Forecast {
        let says = match &why.change {
            Some(change) => format!("{}; {change}", why.says()),
            None => why.says(),
        };
        let listed = failures(&self.library, &why.reason).into_iter().flatten();
        match listed.into_iter().find(|failure| def.fails.contains(failure)) {
            Some(failure) => {
                Forecast::Infeasible { failure: self.library.failure_name(failure).into(), why: says }
            }
            None => Forecast::Unknown { why: says },
        }
    }
}

/// Reason for which the world after a call is not known, and that world but for the place of the robot, if
/// only this is unknown.
struct Lost {
    why: SmolStr,
    stranded: Option<Arc<Fingerprinted>>,
}

/// World after a call that succeeded.
fn after(
    library: &Library,
    geometry: &Geometry,
    at: &Arc<Fingerprinted>,
    call: ExecutedCall<'_>,
) -> Result<Arc<Fingerprinted>, Lost> {
    let def = call.def;
    let Some((motion, terms)) = &def.motion else {
        let why = format_smolstr!("the positions of things after `{}` are unknown", def.name);
        let is_blind = moves_blindly(library, def);
        return if is_blind { Err(Lost { why, stranded: None }) } else { Ok(Arc::clone(at)) };
    };
    let lost = || Lost { why: format_smolstr!("the outcome of `{}` is unknown", def.name), stranded: None };
    let args = terms.iter().map(|term| term_arg(library, term, call)).collect::<Option<Vec<_>>>();
    let query = motion_query(*motion, &args.ok_or_else(lost)?, side(call.args));
    let change = match motion_effect(library, def, &query) {
        MotionEffect::Nothing => return Ok(Arc::clone(at)),
        MotionEffect::Unknown => return Err(lost()),
        MotionEffect::Changed(change) => change,
    };
    let step = |at: &Arc<Fingerprinted>, query: &MotionQuery, change| {
        let answer = geometry.answer(at, query);
        let MotionAnswer::Feasible(motion) = &*answer else { return Err(lost()) };
        let next = geometry.after(at, query, change, motion);
        next.ok_or_else(|| Lost { stranded: geometry.outcome(at, change, motion), ..lost() })
    };
    let next = step(at, &query, change)?;
    // A motion of the base may go on to where the robot serves what it found.
    let MotionQuery::GoTo(target) = &query else { return Ok(next) };
    let Some(effect) = makes(library.lang_items.at, def, true) else { return Ok(next) };
    let [Some(robot), Some(place)] = effect.fact.args.as_slice() else { return Ok(next) };
    if *robot != Term::Entity(ROBOT) {
        return Ok(next);
    }
    let place = named(library, place, call).ok_or_else(lost)?;
    if place == *target {
        return Ok(next);
    }
    step(&next, &MotionQuery::GoTo(place), SceneChange::Gone)
}

fn primitive_of<'l>(library: &'l Library, name: &str) -> Option<&'l PrimitiveDef> {
    library.primitive(library.names.primitives.get(name).copied()?)
}

/// Argument of a motion at a call.
fn term_arg(library: &Library, term: &Term, call: ExecutedCall<'_>) -> Option<MotionArg> {
    match term {
        Term::Param(index) => motion_arg(&call.args.get(usize::from(*index))?.1),
        Term::Number(value) => Some(MotionArg::Number(*value)),
        Term::Bool(value) => Some(MotionArg::Truth(*value)),
        Term::Pose { xyz, yaw } => Some(MotionArg::Pose(MapPose::new(*xyz, *yaw))),
        term => named(library, term, call).map(MotionArg::Name),
    }
}

/// Value of a run as an argument of a motion.
fn motion_arg(value: &Value) -> Option<MotionArg> {
    match value {
        Value::Number(value) => Some(MotionArg::Number(*value)),
        Value::Int(value) => Some(MotionArg::Number(*value as f64)),
        Value::Bool(value) => Some(MotionArg::Truth(*value)),
        Value::Pose(pose) => Some(MotionArg::Pose(MapPose::new(pose.xyz, pose.yaw()))),
        Value::Entity(_) | Value::Case(_) | Value::Text(_) | Value::List(_) => {
            name(value).map(MotionArg::Name)
        }
    }
}

/// Name, in the scene, of a term of a contract at a call.
fn named(library: &Library, term: &Term, call: ExecutedCall<'_>) -> Option<SmolStr> {
    match term {
        Term::Entity(id) => fixed(library, *id),
        Term::Case(of, case) => Some(library.case_name(*of, *case).into()),
        Term::Param(index) => name(&call.args.get(usize::from(*index))?.1),
        Term::Result => name(call.result?),
        Term::Binding(_) | Term::Caught(..) | Term::Each | Term::Unknown => None,
        Term::Bool(_) | Term::Int(_) | Term::Number(_) | Term::Text(_) | Term::List(_) => None,
        Term::Pose { .. } => None,
        Term::Field(..) | Term::Measure(..) | Term::Arith(..) => None,
        Term::First(list) => {
            let Term::Param(index) = **list else { return None };
            let Value::List(items) = &call.args.get(usize::from(index))?.1 else { return None };
            name(items.first()?)
        }
        Term::Template(_) | Term::Count(_) => None,
    }
}

/// Name of an entity in a contract.
fn fixed(library: &Library, entity: Entity) -> Option<SmolStr> {
    match entity {
        ROBOT => None,
        START => Some(SmolStr::new_static(lang::entities::START)),
        other => library.names.entities.iter().find(|(_, id)| **id == other).map(|(name, _)| name.clone()),
    }
}

fn name(value: &Value) -> Option<SmolStr> {
    match value {
        Value::Entity(id) | Value::Case(id) => Some(id.clone()),
        Value::Bool(_) | Value::Int(_) | Value::Number(_) => None,
        Value::Text(_) | Value::Pose(_) | Value::List(_) => None,
    }
}

/// Side of a grasp that an argument asks for.
fn side(args: &[(SmolStr, Value)]) -> Option<motet_geometry::planning::GraspSide> {
    args.iter().find_map(|(_, value)| if let Value::Case(case) = value { side_of(case) } else { None })
}

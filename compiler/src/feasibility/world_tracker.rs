//! The world of a run, step by step as its calls end: what this stage could not see beforehand is motion_query for in it.
//!
//! The same queries and the same worlds as in the walk over a policy, but along the one way that the run takes. Where it is no
//! longer known where the robot or a thing is, every motion is unknown.

use std::sync::Arc;

use motet_geometry::query::{Answer, Infeasible, Query, Reason, Unknown};
use motet_graph::Value;
use smol_str::{SmolStr, format_smolstr};

use super::geometry::{Geometry, SceneChange};
use super::motion::{MotionEffect, makes, motion_effect, motion_query, moves, moves_blindly, side_of};
use super::worlds::Fingerprinted;
use crate::declare::{Library, PrimitiveDef};
use crate::ir::{Entity, ROBOT, START, Term};

/// The world that a run has come to.
#[derive(Debug)]
pub struct WorldTracker {
    library: Arc<Library>,
    geometry: Arc<Geometry>,
    /// The world, or why it is not known.
    at: Result<Arc<Fingerprinted>, SmolStr>,
    /// How many calls are under way that move the robot or something.
    moving: u32,
}

/// What is to be expected of a motion.
#[derive(Clone, PartialEq, Debug)]
pub enum Forecast {
    /// It was found.
    Feasible,
    /// It is proven that there is none.
    Infeasible {
        /// A failure that the primitive lists, the one that says most.
        failure: SmolStr,
        /// Why, with its numbers, and what would help.
        why: String,
    },
    /// Neither.
    Unknown {
        /// Why not.
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
        Self { library, geometry, at, moving: 0 }
    }

    /// What is to be expected of a motion, `of` its arguments, that a call of a primitive asks for now.
    #[must_use]
    pub fn motion(&self, primitive: &str, args: &[(SmolStr, Value)], motion: &str, of: &[Value]) -> Forecast {
        let unknown = |why: &str| Forecast::Unknown { why: why.to_owned() };
        let Some(def) = primitive_of(&self.library, primitive) else {
            return unknown("the primitive is not known");
        };
        let at = match &self.at {
            Ok(_) if self.moving > 0 => return unknown("something else moves at the same time"),
            Ok(at) => at,
            Err(why) => return unknown(why),
        };
        let Some(names) = of.iter().map(name).collect::<Option<Vec<_>>>() else {
            return unknown("an argument has no place in the scene");
        };
        match &*self.geometry.answer(at, &motion_query(motion, names, side(args))) {
            Answer::Feasible(_) => Forecast::Feasible,
            Answer::Infeasible(why) if why.certified => self.infeasible(def, why),
            Answer::Infeasible(why) => unknown(&format!("the search found no motion: {}", why.reason)),
            Answer::Unknown(Unknown::Budget) => unknown("the search was cut short"),
            Answer::Unknown(Unknown::Because(why)) => unknown(why),
        }
    }

    /// A call began.
    pub fn began(&mut self, primitive: &str) {
        if self.is_moving(primitive) {
            self.moving += 1;
            if self.moving > 1 {
                self.lose("two things moved at the same time");
            }
        }
    }

    /// A call that began has succeeded.
    pub fn succeeded(&mut self, primitive: &str, args: &[(SmolStr, Value)], result: Option<&Value>) {
        self.over(primitive);
        let Some(def) = primitive_of(&self.library, primitive) else { return };
        let Ok(at) = &self.at else { return };
        self.at = after(&self.library, &self.geometry, at, ExecutedCall { def, args, result });
    }

    /// A call that began was refused: nothing has moved.
    pub fn refused(&mut self, primitive: &str) {
        self.over(primitive);
    }

    /// A call that began has failed or was interrupted.
    pub fn stopped(&mut self, primitive: &str) {
        self.over(primitive);
        if self.is_moving(primitive) {
            self.lose(&format!("where `{primitive}` stopped is not known"));
        }
    }

    /// Something is held or open, or is not. Where that is not so in this world, it is another one.
    pub fn observed(&mut self, fluent: &str, entity: &str, holds: bool) {
        let Ok(at) = &self.at else { return };
        let here = match fluent {
            "holding" => Some(at.world.holds(entity)),
            "open" => self.geometry.is_open(&at.world, entity),
            _ => None,
        };
        // While something moves it may be so already.
        if self.moving == 0 && here.is_some_and(|here| here != holds) {
            self.lose(&format!("`{fluent}({entity})` is not as it was left"));
        }
    }

    fn over(&mut self, primitive: &str) {
        if self.is_moving(primitive) {
            self.moving = self.moving.saturating_sub(1);
        }
    }

    fn lose(&mut self, why: &str) {
        if self.at.is_ok() {
            self.at = Err(why.into());
        }
    }

    fn is_moving(&self, primitive: &str) -> bool {
        primitive_of(&self.library, primitive).is_some_and(|def| match &def.motion {
            Some((name, _)) => moves(&motion_query(name, Vec::new(), None)),
            None => moves_blindly(&self.library, def),
        })
    }

    fn infeasible(&self, def: &PrimitiveDef, why: &Infeasible) -> Forecast {
        let says = match &why.change {
            Some(change) => format!("{}; {change}", why.reason),
            None => why.reason.to_string(),
        };
        let fails =
            |name: &&&str| def.fails.iter().any(|failure| self.library.failure_name(*failure) == **name);
        match kinds(&why.reason).iter().find(fails) {
            Some(kind) => Forecast::Infeasible { failure: (*kind).into(), why: says },
            None => Forecast::Unknown { why: says },
        }
    }
}

/// The world after a call that has succeeded.
fn after(
    library: &Library,
    geometry: &Geometry,
    at: &Arc<Fingerprinted>,
    call: ExecutedCall<'_>,
) -> Result<Arc<Fingerprinted>, SmolStr> {
    let def = call.def;
    let Some((motion, terms)) = &def.motion else {
        return if moves_blindly(library, def) {
            Err(format_smolstr!("where things are after `{}` is not known", def.name))
        } else {
            Ok(Arc::clone(at))
        };
    };
    let lost = || format_smolstr!("how `{}` ended is not known", def.name);
    let names = terms.iter().map(|term| named(library, term, call)).collect::<Option<Vec<_>>>();
    let query = motion_query(motion, names.ok_or_else(lost)?, side(call.args));
    let change = match motion_effect(library, def, &query) {
        MotionEffect::Nothing => return Ok(Arc::clone(at)),
        MotionEffect::Unknown => return Err(lost()),
        MotionEffect::Changed(change) => change,
    };
    let next = step(geometry, at, &query, change).ok_or_else(lost)?;
    // A motion of the base may go on to where the robot serves what it found.
    let Query::GoTo(target) = &query else { return Ok(next) };
    let Some(effect) = makes(library, def, "at", true) else { return Ok(next) };
    let [Some(robot), Some(place)] = effect.fact.args.as_slice() else { return Ok(next) };
    if *robot != Term::Entity(ROBOT) {
        return Ok(next);
    }
    let place = named(library, place, call).ok_or_else(lost)?;
    if place == *target {
        return Ok(next);
    }
    step(geometry, &next, &Query::GoTo(place), SceneChange::Gone).ok_or_else(lost)
}

fn step(
    geometry: &Geometry,
    at: &Arc<Fingerprinted>,
    query: &Query,
    change: SceneChange,
) -> Option<Arc<Fingerprinted>> {
    match &*geometry.answer(at, query) {
        Answer::Feasible(way) => geometry.after(at, query, change, way),
        Answer::Infeasible(_) | Answer::Unknown(_) => None,
    }
}

/// The failures that say what a reason says, the closest first.
const fn kinds(reason: &Reason) -> &'static [&'static str] {
    match reason {
        Reason::OutOfReach { .. } | Reason::TooWide { .. } => &["unreachable"],
        Reason::TooHeavy { .. } => &["too_heavy", "unreachable"],
        Reason::NoFreePose { .. } | Reason::BlockedPath { .. } => &["unreachable", "blocked"],
        Reason::NotInView { .. } => &["unreachable", "blocked", "not_found"],
    }
}

fn primitive_of<'l>(library: &'l Library, name: &str) -> Option<&'l PrimitiveDef> {
    library.primitive(library.names.primitives.get(name).copied()?)
}

/// A term of a contract at a call, by the name that the scene has for it.
fn named(library: &Library, term: &Term, call: ExecutedCall<'_>) -> Option<SmolStr> {
    match term {
        Term::Entity(id) => fixed(library, *id),
        Term::Case(of, case) => Some(library.case_name(*of, *case).into()),
        Term::Param(index) => name(&call.args.get(usize::from(*index))?.1),
        Term::Result => name(call.result?),
        Term::Binding(_) | Term::Each | Term::Unknown => None,
        Term::Bool(_) | Term::Int(_) | Term::Number(_) | Term::Text(_) | Term::List(_) => None,
        Term::Field(..) | Term::Measure(..) | Term::Arith(..) => None,
    }
}

/// An entity that a contract names.
fn fixed(library: &Library, entity: Entity) -> Option<SmolStr> {
    match entity {
        ROBOT => None,
        START => Some(SmolStr::new_static("start")),
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

/// The side from which a thing is to be grasped, where an argument says so.
fn side(args: &[(SmolStr, Value)]) -> Option<motet_geometry::query::Side> {
    args.iter().find_map(|(_, value)| if let Value::Case(case) = value { side_of(case) } else { None })
}

//! The world of a run, step by step as its calls end: what this stage could not see beforehand is asked for in it.
//!
//! The same queries and the same worlds as in the walk over a policy, but along the one way that the run takes. Where it is no
//! longer known where the robot or a thing is, every motion is unknown.

use std::sync::Arc;

use motet_geometry::planning::{Infeasible, InfeasibleReason, MotionAnswer, MotionQuery, UnknownReason};
use motet_graph::Value;
use smol_str::{SmolStr, format_smolstr};

use super::geometry::{Change, Geometry};
use super::meaning::{Leaves, asked, leaves, makes, moves, moves_blindly, side_of};
use super::ways::Keyed;
use crate::ir::{Entity, ROBOT, START, Term};
use crate::library::{Library, PrimitiveDef};

/// The world that a run has come to.
#[derive(Debug)]
pub struct Course {
    library: Arc<Library>,
    geometry: Arc<Geometry>,
    /// The world, or why it is not known.
    at: Result<Arc<Keyed>, SmolStr>,
    /// How many calls are under way that move the robot or something.
    moving: u32,
}

/// What is to be expected of a motion.
#[derive(Clone, PartialEq, Debug)]
pub enum Prospect {
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
struct Deed<'a> {
    def: &'a PrimitiveDef,
    args: &'a [(SmolStr, Value)],
    result: Option<&'a Value>,
}

impl Course {
    pub(crate) fn new(library: Arc<Library>, geometry: Arc<Geometry>) -> Self {
        let at = geometry.start();
        Self { library, geometry, at, moving: 0 }
    }

    /// What is to be expected of a motion, `of` its arguments, that a call of a primitive asks for now.
    #[must_use]
    pub fn motion(&self, primitive: &str, args: &[(SmolStr, Value)], motion: &str, of: &[Value]) -> Prospect {
        let unknown = |why: &str| Prospect::Unknown { why: why.to_owned() };
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
        match &*self.geometry.answer(at, &asked(motion, names, side(args))) {
            MotionAnswer::Feasible(_) => Prospect::Feasible,
            MotionAnswer::Infeasible(why) if why.certified => self.infeasible(def, why),
            MotionAnswer::Infeasible(why) => unknown(&format!("the search found no motion: {}", why.reason)),
            MotionAnswer::Unknown(UnknownReason::Budget) => unknown("the search was cut short"),
            MotionAnswer::Unknown(UnknownReason::Because(why)) => unknown(why),
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
        self.at = after(&self.library, &self.geometry, at, Deed { def, args, result });
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
            Some((name, _)) => moves(&asked(name, Vec::new(), None)),
            None => moves_blindly(&self.library, def),
        })
    }

    fn infeasible(&self, def: &PrimitiveDef, why: &Infeasible) -> Prospect {
        let says = match &why.change {
            Some(change) => format!("{}; {change}", why.reason),
            None => why.reason.to_string(),
        };
        let fails =
            |name: &&&str| def.fails.iter().any(|failure| self.library.failure_name(*failure) == **name);
        match kinds(&why.reason).iter().find(fails) {
            Some(kind) => Prospect::Infeasible { failure: (*kind).into(), why: says },
            None => Prospect::Unknown { why: says },
        }
    }
}

/// The world after a call that has succeeded.
fn after(
    library: &Library,
    geometry: &Geometry,
    at: &Arc<Keyed>,
    deed: Deed<'_>,
) -> Result<Arc<Keyed>, SmolStr> {
    let def = deed.def;
    let Some((motion, terms)) = &def.motion else {
        return if moves_blindly(library, def) {
            Err(format_smolstr!("where things are after `{}` is not known", def.name))
        } else {
            Ok(Arc::clone(at))
        };
    };
    let lost = || format_smolstr!("how `{}` ended is not known", def.name);
    let names = terms.iter().map(|term| named(library, term, deed)).collect::<Option<Vec<_>>>();
    let query = asked(motion, names.ok_or_else(lost)?, side(deed.args));
    let change = match leaves(library, def, &query) {
        Leaves::Nothing => return Ok(Arc::clone(at)),
        Leaves::Unknown => return Err(lost()),
        Leaves::Changed(change) => change,
    };
    let next = step(geometry, at, &query, change).ok_or_else(lost)?;
    // A motion of the base may go on to where the robot serves what it found.
    let MotionQuery::GoTo(target) = &query else { return Ok(next) };
    let Some(effect) = makes(library, def, "at", true) else { return Ok(next) };
    let [Some(robot), Some(place)] = effect.fact.args.as_slice() else { return Ok(next) };
    if *robot != Term::Entity(ROBOT) {
        return Ok(next);
    }
    let place = named(library, place, deed).ok_or_else(lost)?;
    if place == *target {
        return Ok(next);
    }
    step(geometry, &next, &MotionQuery::GoTo(place), Change::Gone).ok_or_else(lost)
}

fn step(geometry: &Geometry, at: &Arc<Keyed>, query: &MotionQuery, change: Change) -> Option<Arc<Keyed>> {
    match &*geometry.answer(at, query) {
        MotionAnswer::Feasible(way) => geometry.after(at, query, change, way),
        MotionAnswer::Infeasible(_) | MotionAnswer::Unknown(_) => None,
    }
}

/// The failures that say what a reason says, the closest first.
const fn kinds(reason: &InfeasibleReason) -> &'static [&'static str] {
    match reason {
        InfeasibleReason::OutOfReach { .. } | InfeasibleReason::TooWide { .. } => &["unreachable"],
        InfeasibleReason::TooHeavy { .. } => &["too_heavy", "unreachable"],
        InfeasibleReason::NoFreePose { .. } | InfeasibleReason::BlockedPath { .. } => {
            &["unreachable", "blocked"]
        }
        InfeasibleReason::NotInView { .. } => &["unreachable", "blocked", "not_found"],
    }
}

fn primitive_of<'l>(library: &'l Library, name: &str) -> Option<&'l PrimitiveDef> {
    library.primitive(library.names.primitives.get(name).copied()?)
}

/// A term of a contract at a call, by the name that the scene has for it.
fn named(library: &Library, term: &Term, deed: Deed<'_>) -> Option<SmolStr> {
    match term {
        Term::Entity(id) => fixed(library, *id),
        Term::Case(of, case) => Some(library.case_name(*of, *case).into()),
        Term::Param(index) => name(&deed.args.get(usize::from(*index))?.1),
        Term::Result => name(deed.result?),
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
fn side(args: &[(SmolStr, Value)]) -> Option<motet_geometry::planning::GraspSide> {
    args.iter().find_map(|(_, value)| if let Value::Case(case) = value { side_of(case) } else { None })
}

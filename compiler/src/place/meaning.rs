//! What a call means to geometry: which motion it asks for, and what its contract changes.

use motet_geometry::planning::{GraspSide, MotionQuery};
use smol_str::{SmolStr, format_smolstr};

use super::geometry::Change;
use super::walk::Walk;
use crate::ir::{Call, Entity, ROBOT, START, Term};
use crate::library::{EffectDef, Library, PrimitiveDef};

impl Walk<'_> {
    /// The motion that a call asks for.
    ///
    /// # Errors
    ///
    /// Why it is not known which.
    pub(super) fn query(&self, call: &Call, def: &PrimitiveDef) -> Result<MotionQuery, SmolStr> {
        let Some((name, args)) = &def.motion else { return Err(SmolStr::new_static("it has no motion")) };
        let mut names = Vec::with_capacity(args.len());
        for arg in args {
            names.push(self.named(arg, call)?);
        }
        Ok(asked(name, names, self.side(call)))
    }

    /// The side from which a thing is to be grasped, where an argument of the call says so.
    fn side(&self, call: &Call) -> Option<GraspSide> {
        let approach = self.library.names.enums.get("Approach").copied()?;
        call.args.iter().find_map(|arg| match arg {
            Term::Case(of, case) if *of == approach => side_of(self.library.case_name(approach, *case)),
            _ => None,
        })
    }

    /// An argument of a contract at a call by the name that the scene has for it.
    ///
    /// # Errors
    ///
    /// Why it is not known what it is.
    pub(super) fn named(&self, term: &Term, call: &Call) -> Result<SmolStr, SmolStr> {
        let entity = |entity: Entity| match entity {
            ROBOT => Err(SmolStr::new_static("the robot is no target")),
            START => Ok(SmolStr::new_static("start")),
            entity if self.symbols.get(entity).is_some() => {
                let bound = self.symbols.binding_of(entity);
                let name = bound.and_then(|index| self.program.bindings.get(index));
                let name = name.map_or("it", |binding| binding.name.as_str());
                Err(format_smolstr!("which thing `{name}` is, only the run can tell"))
            }
            entity => Ok(self.world.name(entity)),
        };
        let unknown = || SmolStr::new_static("an argument is only known in the run");
        match term {
            Term::Entity(id) => entity(*id),
            Term::Case(of, case) => Ok(self.library.case_name(*of, *case).into()),
            Term::Binding(id) => entity(self.symbols.of_binding(id.index()).ok_or_else(unknown)?),
            Term::Param(index) => match call.args.get(usize::from(*index)) {
                Some(Term::Param(_)) | None => Err(unknown()),
                Some(term) => self.named(term, call),
            },
            Term::Result => {
                let bound = call.binds.and_then(|id| self.symbols.of_binding(id.index()));
                entity(bound.ok_or_else(unknown)?)
            }
            Term::Bool(_)
            | Term::Int(_)
            | Term::Number(_)
            | Term::Text(_)
            | Term::List(_)
            | Term::Each
            | Term::Field(..)
            | Term::Measure(..)
            | Term::Arith(..)
            | Term::Unknown => Err(unknown()),
        }
    }

    /// Where a call leaves the robot beyond the target of its motion: `search` ends where it serves what it found.
    pub(super) fn ends_at(&self, call: &Call, def: &PrimitiveDef) -> Option<Result<SmolStr, SmolStr>> {
        let effect = makes(self.library, def, "at", true)?;
        match effect.fact.args.as_slice() {
            [Some(robot), Some(place)] if *robot == Term::Entity(ROBOT) => Some(self.named(place, call)),
            _ => None,
        }
    }
}

/// A motion by its name and its arguments.
pub(super) fn asked(name: &str, args: Vec<SmolStr>, side: Option<GraspSide>) -> MotionQuery {
    let mut args = args.into_iter();
    let (first, second) = (args.next().unwrap_or_default(), args.next());
    match (name, second) {
        ("go_to", None) => MotionQuery::GoTo(first),
        ("reach", None) => MotionQuery::Reach(first, side),
        ("put", Some(on)) => MotionQuery::Put(first, on),
        ("offer", Some(to)) => MotionQuery::Offer(first, to),
        ("look", None) => MotionQuery::Look(first),
        ("pull", None) => MotionQuery::Pull(first),
        ("push", None) => MotionQuery::Push(first),
        ("posture", None) => MotionQuery::Posture(first),
        (name, _) => MotionQuery::Other(name.into()),
    }
}

/// The side of a case of `Approach`; none where any will do.
pub(super) fn side_of(case: &str) -> Option<GraspSide> {
    match case {
        "top" => Some(GraspSide::Top),
        "side" => Some(GraspSide::Side),
        "front" => Some(GraspSide::Front),
        _ => None,
    }
}

/// Whether a motion leaves the robot or a thing elsewhere.
pub(super) const fn moves(query: &MotionQuery) -> bool {
    match query {
        MotionQuery::GoTo(_) | MotionQuery::Reach(..) | MotionQuery::Posture(_) => true,
        MotionQuery::Put(..)
        | MotionQuery::Offer(..)
        | MotionQuery::Pull(_)
        | MotionQuery::Push(_)
        | MotionQuery::Other(_) => true,
        // The head may look elsewhere afterwards, which changes nothing that is kept.
        MotionQuery::Look(_) => false,
    }
}

/// What a motion that succeeded leaves behind.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Leaves {
    /// Nothing that is kept.
    Nothing,
    /// This.
    Changed(Change),
    /// Its contract does not tell.
    Unknown,
}

/// What the contract of a primitive says of a motion that succeeded.
pub(super) fn leaves(library: &Library, def: &PrimitiveDef, query: &MotionQuery) -> Leaves {
    let makes = |fluent: &str, value: bool| makes(library, def, fluent, value).is_some();
    match query {
        MotionQuery::GoTo(_) | MotionQuery::Posture(_) => Leaves::Changed(Change::Gone),
        MotionQuery::Reach(..) if makes("holding", true) => Leaves::Changed(Change::Taken),
        MotionQuery::Reach(..) | MotionQuery::Look(_) => Leaves::Nothing,
        MotionQuery::Put(..) if makes("holding", false) => Leaves::Changed(Change::Put),
        MotionQuery::Offer(..) if makes("holding", false) => Leaves::Changed(Change::Given),
        MotionQuery::Pull(_) if makes("open", true) => Leaves::Changed(Change::Travelled),
        MotionQuery::Push(_) if makes("open", false) => Leaves::Changed(Change::Travelled),
        MotionQuery::Put(..) | MotionQuery::Offer(..) => Leaves::Unknown,
        MotionQuery::Pull(_) | MotionQuery::Push(_) | MotionQuery::Other(_) => Leaves::Unknown,
    }
}

/// Whether a contract makes a fact of a fluent about one thing, not about all of a kind.
pub(super) fn makes<'d>(
    library: &Library,
    def: &'d PrimitiveDef,
    fluent: &str,
    value: bool,
) -> Option<&'d EffectDef> {
    let id = library.names.fluents.get(fluent).copied()?;
    def.makes.iter().find(|effect| {
        effect.fact.fluent == id
            && effect.value == value
            && effect.each.is_none()
            && effect.when.is_none()
            && !effect.fact.args.iter().any(Option::is_none)
    })
}

/// Whether a primitive without a motion may move the robot or something all the same: what it sees is not what it saw, or
/// something is elsewhere.
pub(super) fn moves_blindly(library: &Library, def: &PrimitiveDef) -> bool {
    let fluent = |effect: &EffectDef| library.fluent(effect.fact.fluent).map(|def| def.name.as_str());
    let places = ["at", "on", "in", "holding", "open", "lifted"];
    let elsewhere = |effect: &EffectDef| fluent(effect).is_some_and(|name| places.contains(&name));
    let unseen = def.unsettles.iter().any(|effect| fluent(effect) == Some("visible"));
    unseen || def.makes.iter().chain(&def.unsettles).any(elsewhere)
}

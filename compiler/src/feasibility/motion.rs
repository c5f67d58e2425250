//! Translation of calls to motion queries, and of contracts to changes of the scene.

use motet_geometry::planning::{ExactNumber, GraspSide, InfeasibleReason, MapPose, MotionQuery, PlaceRules};
use motet_stdlib::lang;
use smol_str::SmolStr;

use super::geometry::SceneChange;
use crate::declare::{EffectDef, Library, PrimitiveDef};
use crate::ir::{Failure, Fluent, MotionKind, ROBOT, Term};

/// Argument of a motion.
#[derive(Clone, PartialEq, Debug)]
pub(super) enum MotionArg {
    /// Entity or case, by its name in the scene.
    Name(SmolStr),
    Number(f64),
    Truth(bool),
    Pose(MapPose),
}

/// Motion query of a kind and arguments, of which the pose of a grasp may be missing; one that is not
/// computed where they do not fit the kind.
pub(super) fn motion_query(kind: MotionKind, args: &[MotionArg], side: Option<GraspSide>) -> MotionQuery {
    use MotionArg::{Name, Pose};
    match (kind, args) {
        (MotionKind::GoTo, [Name(to)]) => MotionQuery::GoTo(to.clone()),
        (MotionKind::StandAt, [Pose(pose)]) => MotionQuery::StandAt(*pose),
        (MotionKind::Reach, [Name(object)]) => MotionQuery::Reach(object.clone(), side),
        (MotionKind::ReachAt, [Name(object)]) => MotionQuery::ReachAt(object.clone(), None),
        (MotionKind::ReachAt, [Name(object), Pose(at)]) => MotionQuery::ReachAt(object.clone(), Some(*at)),
        (MotionKind::Put, [Name(object), Name(on), options @ ..]) => match place_rules(on, options) {
            Some(rules) => MotionQuery::Put(object.clone(), on.clone(), rules),
            None => MotionQuery::Other(kind.name().into()),
        },
        (MotionKind::PutAt, [Name(object), Name(on), Pose(at)]) => {
            let rules = PlaceRules { at: Some(*at), ..PlaceRules::default() };
            MotionQuery::Put(object.clone(), on.clone(), rules)
        }
        (MotionKind::Offer, [Name(object), Name(to)]) => MotionQuery::Offer(object.clone(), to.clone()),
        (MotionKind::Look, [Name(at)]) => MotionQuery::Look(at.clone()),
        (MotionKind::Pull, [Name(what)]) => MotionQuery::Pull(what.clone()),
        (MotionKind::Push, [Name(what)]) => MotionQuery::Push(what.clone()),
        (MotionKind::Posture, [Name(name)]) => MotionQuery::Posture(name.clone()),
        (kind, _) => MotionQuery::Other(kind.name().into()),
    }
}

/// Rules for a place on `on`, in the order of [`MotionKind::options`]. What is to be near or beside its own
/// support may be anywhere on it.
fn place_rules(on: &SmolStr, options: &[MotionArg]) -> Option<PlaceRules> {
    let mut rules = PlaceRules::default();
    let other = |id: &SmolStr| (id != on).then(|| id.clone());
    for (index, option) in options.iter().enumerate() {
        match (index, option) {
            (0, MotionArg::Name(id)) => rules.near = other(id),
            (1, MotionArg::Name(id)) => rules.beside = other(id),
            (2, MotionArg::Number(far)) => rules.from_edge = ExactNumber::new(far.max(0.0)),
            (3, MotionArg::Truth(upright)) => rules.may_lie = !upright,
            _ => return None,
        }
    }
    Some(rules)
}

/// Side of a case of `Approach`; `None` if any side is allowed.
pub(super) fn side_of(case: &str) -> Option<GraspSide> {
    match case {
        lang::approaches::TOP => Some(GraspSide::Top),
        lang::approaches::SIDE => Some(GraspSide::Side),
        lang::approaches::FRONT => Some(GraspSide::Front),
        _ => None,
    }
}

/// Change of the scene by a motion that succeeded.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum MotionEffect {
    /// The motion leaves the scene as it is.
    Nothing,
    Changed(SceneChange),
    /// The contract does not determine the change.
    Unknown,
}

/// Change of the scene by a motion that succeeded, from the contract of its primitive.
pub(super) fn motion_effect(library: &Library, def: &PrimitiveDef, query: &MotionQuery) -> MotionEffect {
    let items = &library.lang_items;
    let makes = |fluent: Option<Fluent>, value: bool| makes(fluent, def, value).is_some();
    match query {
        MotionQuery::GoTo(_) | MotionQuery::StandAt(_) | MotionQuery::Posture(_) => {
            MotionEffect::Changed(SceneChange::Gone)
        }
        MotionQuery::Reach(..) | MotionQuery::ReachAt(..) if makes(items.holding, true) => {
            MotionEffect::Changed(SceneChange::Taken)
        }
        MotionQuery::Reach(..) | MotionQuery::ReachAt(..) | MotionQuery::Look(_) => MotionEffect::Nothing,
        MotionQuery::Put(..) if makes(items.holding, false) => MotionEffect::Changed(SceneChange::Put),
        MotionQuery::Offer(..) if makes(items.holding, false) => MotionEffect::Changed(SceneChange::Given),
        MotionQuery::Pull(_) if makes(items.open, true) => MotionEffect::Changed(SceneChange::Travelled),
        MotionQuery::Push(_) if makes(items.open, false) => MotionEffect::Changed(SceneChange::Travelled),
        MotionQuery::Put(..) | MotionQuery::Offer(..) => MotionEffect::Unknown,
        MotionQuery::Pull(_) | MotionQuery::Push(_) | MotionQuery::Other(_) => MotionEffect::Unknown,
    }
}

/// Finds an effect of a contract on a fluent about one thing, without condition and not about all of a kind.
pub(super) fn makes(fluent: Option<Fluent>, def: &PrimitiveDef, value: bool) -> Option<&EffectDef> {
    let id = fluent?;
    def.makes.iter().find(|effect| {
        effect.fact.fluent == id
            && effect.value == value
            && effect.each.is_none()
            && effect.when.is_none()
            && !effect.fact.args.iter().any(Option::is_none)
    })
}

/// Returns whether a primitive without a motion may still move the robot or a thing, by its effects.
pub(super) fn moves_blindly(library: &Library, def: &PrimitiveDef) -> bool {
    let items = &library.lang_items;
    let elsewhere = |effect: &EffectDef| items.poses().any(|fluent| fluent == effect.fact.fluent);
    let unseen = def.unsettles.iter().any(|effect| Some(effect.fact.fluent) == items.visible);
    unseen || def.makes.iter().chain(&def.unsettles).any(elsewhere)
}

/// Returns whether a call of a primitive that breaks off leaves all things and containers as they were.
pub(super) fn moves_robot_only(library: &Library, def: &PrimitiveDef) -> bool {
    let items = &library.lang_items;
    let is_of_robot = |effect: &EffectDef| {
        let of = effect.fact.args.first();
        Some(effect.fact.fluent) == items.at && of == Some(&Some(Term::Entity(ROBOT)))
    };
    let is_of_thing =
        |effect: &EffectDef| items.poses().any(|fluent| fluent == effect.fact.fluent) && !is_of_robot(effect);
    !def.makes.iter().chain(&def.unsettles).any(is_of_thing)
}

/// Returns whether a call of a primitive may move the robot or a thing.
pub(super) fn may_move(library: &Library, def: &PrimitiveDef) -> bool {
    def.motion.as_ref().map_or_else(|| moves_blindly(library, def), |(kind, _)| kind.moves())
}

/// Failures that match a reason, the most specific first.
pub(super) fn failures(library: &Library, reason: &InfeasibleReason) -> [Option<Failure>; 3] {
    let items = &library.lang_items;
    match reason {
        InfeasibleReason::OutOfReach { .. } | InfeasibleReason::TooWide { .. } => {
            [items.unreachable, None, None]
        }
        InfeasibleReason::TooHeavy { .. } => [items.too_heavy, items.unreachable, None],
        InfeasibleReason::NoFreePose { .. }
        | InfeasibleReason::BlockedPath { .. }
        | InfeasibleReason::NoPlace(_) => [items.unreachable, items.blocked, None],
        InfeasibleReason::Beside { .. } => [items.not_found, items.unreachable, None],
        InfeasibleReason::NotInView { .. } => [items.unreachable, items.blocked, items.not_found],
    }
}

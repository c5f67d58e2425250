//! Diagnostics of infeasible motions (M06xx): one code for each reason.

use motet_syntax::{About, Related, Span};
use smol_str::SmolStr;

/// Parts of the diagnostic of an infeasible motion.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct RefusedMotion {
    pub(crate) callee: SmolStr,
    /// The query: `reach(mug_1)`.
    pub(crate) motion: String,
    /// InfeasibleReason with its numbers.
    pub(crate) says: String,
    /// Steps that changed the world before the motion; empty if it is as in the scene.
    pub(crate) story: String,
    /// Proposed change of the scene or the policy.
    pub(crate) change: Option<String>,
    /// True if infeasibility is proven.
    pub(crate) is_certified: bool,
    /// Spans of those steps.
    pub(crate) since: Vec<Related>,
}

fn message(told: &RefusedMotion) -> String {
    let RefusedMotion { callee, motion, says, story, .. } = told;
    format!("`{callee}` cannot perform `{motion}`: {says}{story}")
}

fn help(told: &RefusedMotion) -> Option<String> {
    let left = "not proven infeasible: the search found no motion, so it is checked again at run time";
    match (&told.change, told.is_certified) {
        (Some(change), true) => Some(change.clone()),
        (Some(change), false) => Some(format!("{change}; {left}")),
        (None, false) => Some(left.to_owned()),
        (None, true) => None,
    }
}

fn about(told: &RefusedMotion) -> Option<About> {
    Some(About { primitive: Some(told.callee.clone()), ..About::default() })
}

motet_syntax::mistakes! {
    pub(crate) const CODES;

    /// Target that is too far away, too high or too low.
    OutOfReach("M0601", Error) { told: RefusedMotion }
    message(m) { message(&m.told) }
    help(m) { help(&m.told) }
    related(m) { m.told.since.clone() }
    about(m) { about(&m.told) }

    /// Target for which every configuration of the robot collides.
    NoFreePose("M0602", Error) { told: RefusedMotion }
    message(m) { message(&m.told) }
    help(m) { help(&m.told) }
    related(m) { m.told.since.clone() }
    about(m) { about(&m.told) }

    /// Target without a free path to it.
    BlockedPath("M0603", Error) { told: RefusedMotion }
    message(m) { message(&m.told) }
    help(m) { help(&m.told) }
    related(m) { m.told.since.clone() }
    about(m) { about(&m.told) }

    /// Thing that weighs more than the payload.
    TooHeavy("M0604", Error) { told: RefusedMotion }
    message(m) { message(&m.told) }
    help(m) { help(&m.told) }
    related(m) { m.told.since.clone() }
    about(m) { about(&m.told) }

    /// Thing that is wider than the opening of the hand.
    TooWide("M0605", Error) { told: RefusedMotion }
    message(m) { message(&m.told) }
    help(m) { help(&m.told) }
    related(m) { m.told.since.clone() }
    about(m) { about(&m.told) }

    /// Target that no camera can see.
    NotInView("M0606", Error) { told: RefusedMotion }
    message(m) { message(&m.told) }
    help(m) { help(&m.told) }
    related(m) { m.told.since.clone() }
    about(m) { about(&m.told) }
}

/// Diagnostic of a reason.
pub(crate) fn refused(
    reason: &motet_geometry::planning::InfeasibleReason,
    span: Span,
    told: RefusedMotion,
) -> motet_syntax::Diagnostic {
    use motet_geometry::planning::InfeasibleReason;
    match reason {
        InfeasibleReason::OutOfReach { .. } => OutOfReach { span, told }.into(),
        InfeasibleReason::NoFreePose { .. } => NoFreePose { span, told }.into(),
        InfeasibleReason::BlockedPath { .. } => BlockedPath { span, told }.into(),
        InfeasibleReason::NotInView { .. } => NotInView { span, told }.into(),
        InfeasibleReason::TooHeavy { .. } => TooHeavy { span, told }.into(),
        InfeasibleReason::TooWide { .. } => TooWide { span, told }.into(),
    }
}

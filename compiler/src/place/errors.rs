//! Motions that cannot be done (M06xx): one code for each reason of the language.

use motet_syntax::{About, Related, Span};
use smol_str::SmolStr;

/// What all of them say: which call, why not, in which world, and what would help.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Told {
    /// The primitive.
    pub(crate) callee: SmolStr,
    /// The motion, `reach(mug_1)`.
    pub(crate) motion: String,
    /// The reason with its numbers.
    pub(crate) says: String,
    /// Where the robot stands, what is open, and which step made it so; empty where it is as in the scene.
    pub(crate) story: String,
    /// What would help.
    pub(crate) change: Option<String>,
    /// Whether it is proven.
    pub(crate) is_certified: bool,
    /// The steps of the story.
    pub(crate) since: Vec<Related>,
}

fn message(told: &Told) -> String {
    let Told { callee, motion, says, story, .. } = told;
    format!("`{callee}` cannot do `{motion}`: {says}{story}")
}

fn help(told: &Told) -> Option<String> {
    let left = "that is not proven: a search found no motion, and the run will see";
    match (&told.change, told.is_certified) {
        (Some(change), true) => Some(change.clone()),
        (Some(change), false) => Some(format!("{change}; {left}")),
        (None, false) => Some(left.to_owned()),
        (None, true) => None,
    }
}

fn about(told: &Told) -> Option<About> {
    Some(About { primitive: Some(told.callee.clone()), ..About::default() })
}

motet_syntax::mistakes! {
    pub(crate) const CODES;

    /// A thing is too far away, too high or too low.
    OutOfReach("M0601", Error) { told: Told }
    message(m) { message(&m.told) }
    help(m) { help(&m.told) }
    related(m) { m.told.since.clone() }
    about(m) { about(&m.told) }

    /// Every pose of the robot touches something.
    NoFreePose("M0602", Error) { told: Told }
    message(m) { message(&m.told) }
    help(m) { help(&m.told) }
    related(m) { m.told.since.clone() }
    about(m) { about(&m.told) }

    /// No way leads to a pose that is free.
    BlockedPath("M0603", Error) { told: Told }
    message(m) { message(&m.told) }
    help(m) { help(&m.told) }
    related(m) { m.told.since.clone() }
    about(m) { about(&m.told) }

    /// A thing weighs more than the hand carries.
    TooHeavy("M0604", Error) { told: Told }
    message(m) { message(&m.told) }
    help(m) { help(&m.told) }
    related(m) { m.told.since.clone() }
    about(m) { about(&m.told) }

    /// A thing is wider than the hand opens.
    TooWide("M0605", Error) { told: Told }
    message(m) { message(&m.told) }
    help(m) { help(&m.told) }
    related(m) { m.told.since.clone() }
    about(m) { about(&m.told) }

    /// No camera sees a thing.
    NotInView("M0606", Error) { told: Told }
    message(m) { message(&m.told) }
    help(m) { help(&m.told) }
    related(m) { m.told.since.clone() }
    about(m) { about(&m.told) }
}

/// The diagnostic of a reason.
pub(crate) fn refused(
    reason: &motet_geometry::planning::InfeasibleReason,
    span: Span,
    told: Told,
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

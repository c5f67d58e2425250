//! Diagnostics of infeasible motions (M06xx), one code for each reason, and their explanations: the steps
//! that led to the world in which a motion is infeasible.

use motet_geometry::planning::{Infeasible, InfeasibleReason, Misfit, MotionQuery};
use motet_syntax::{About, Diagnostic, Related, Severity, Span};
use smol_str::SmolStr;

use super::domain::{MotionChecker, PossibleWorld};
use super::plain_reason::{plain_reason, target};
use crate::ir::{StepId, StepKind, Term};

/// Parts of the diagnostic of an infeasible motion.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct RefusedMotion {
    pub(crate) callee: SmolStr,
    /// The query: `reach(mug_1)`.
    pub(crate) motion: String,
    /// Reason with its numbers.
    pub(crate) says: String,
    /// Steps that changed the world before the motion; empty if it is as in the scene.
    pub(crate) story: String,
    /// Proposed change of the scene or the policy.
    pub(crate) change: Option<String>,
    /// True if infeasibility is proven.
    pub(crate) is_certified: bool,
    /// Spans of those steps.
    pub(crate) since: Vec<Related>,
    /// Entity where the motion ends.
    pub(crate) entity: Option<SmolStr>,
    /// Reason in a person's words.
    pub(crate) plain: String,
}

fn message(told: &RefusedMotion) -> String {
    let RefusedMotion { callee, motion, says, story, is_certified, .. } = told;
    if *is_certified {
        format!("`{callee}` cannot perform `{motion}`: {says}{story}")
    } else {
        format!("no motion was found with which `{callee}` performs `{motion}`: {says}{story}")
    }
}

fn help(told: &RefusedMotion) -> Option<String> {
    let left = "this is not proven, so the engine checks the motion again at run time";
    match (&told.change, told.is_certified) {
        (Some(change), true) => Some(change.clone()),
        (Some(change), false) => Some(format!("{change}; {left}")),
        (None, false) => Some(left.to_owned()),
        (None, true) => None,
    }
}

fn about(told: &RefusedMotion) -> Option<About> {
    let (primitive, plain) = (Some(told.callee.clone()), Some(told.plain.clone()));
    Some(About { primitive, plain, entity: told.entity.clone(), ..About::default() })
}

/// Declares the diagnostics of infeasible motions, with the choice among them by the reason, and the one of a
/// scene.
macro_rules! refusals {
    ($($(#[$doc:meta])* $name:ident($code:literal))*) => {
        motet_syntax::mistakes! {
            pub(crate) const CODES;
            $(
                $(#[$doc])*
                $name($code, Error) { told: RefusedMotion }
                message(m) { message(&m.told) }
                help(m) { help(&m.told) }
                related(m) { m.told.since.clone() }
                about(m) { about(&m.told) }
            )*

            /// Visibility in a scene that contradicts what the camera sees.
            SightDisagrees("M0608", Warning) {
                id: SmolStr, says_visible: bool, from: [f64; 2], sees: String
            }
            message(m) {
                let is = if m.says_visible { "is visible" } else { "is not visible" };
                let [x, y] = m.from;
                format!("the scene says `{}` {is}; from ({x:.2}, {y:.2}) {}", m.id, m.sees)
            }
            help(m) {
                let right = !m.says_visible;
                Some(format!("write `\"visible\": {right}`, leave it out, or correct the poses"))
            }

            /// Block of a `keep` that begins where one of its rules is broken.
            BrokenAtStart("M0609", Error) {
                rule: String, place: String, came: Option<String>, related: Option<Related>,
            }
            message(m) {
                let came = match &m.came {
                    Some(step) => format!(", where `{step}` brought it"),
                    None => " at the start".to_owned(),
                };
                format!("`keep {}` is broken where its block begins: the robot {}{came}", m.rule, m.place)
            }
            help(_m) { Some("leave that place in a step before the block".to_owned()) }
            related(m) { m.related.iter().cloned().collect() }

            /// Motion whose path takes longer than its step may.
            TooSlow("M0611", Warning) { callee: SmolStr, takes: f64, within: f64 }
            message(m) {
                let TooSlow { callee, takes, within, .. } = m;
                format!("the path of `{callee}` takes {takes} s, but the step may take only {within} s")
            }
            help(m) { Some(format!("give it more time: `within {} s`", m.takes)) }
            about(m) { Some(About { primitive: Some(m.callee.clone()), ..About::default() }) }
        }

        /// Diagnostic of a reason.
        fn refused(reason: &InfeasibleReason, span: Span, told: RefusedMotion) -> Diagnostic {
            match reason {
                $(InfeasibleReason::$name { .. } => $name { span, told }.into(),)*
            }
        }
    };
}

refusals! {
    /// Target that is too far away, too high or too low.
    OutOfReach("M0601")
    /// Target for which every configuration of the robot collides.
    NoFreePose("M0602")
    /// Target without a free path to it.
    BlockedPath("M0603")
    /// Thing that weighs more than the payload.
    TooHeavy("M0604")
    /// Thing that is wider than the opening of the hand.
    TooWide("M0605")
    /// Point of a grasp that is not at the thing.
    Beside("M0610")
    /// Support without a free place as the step asks for one.
    NoPlace("M0607")
    /// Target that no camera can see.
    NotInView("M0606")
}

impl MotionChecker<'_> {
    /// Diagnostic of a motion that is infeasible in a possible world: an error if that is proven, a warning
    /// if a search found nothing.
    pub(super) fn refusal(
        &self,
        id: StepId,
        callee: &SmolStr,
        query: &MotionQuery,
        why: &Infeasible,
        possible: &PossibleWorld,
    ) -> Option<Diagnostic> {
        let span = self.program.steps.get(id.index())?.span;
        let why = self.geometry.explained(&possible.at, query, why);
        let culprit = match &why.reason {
            InfeasibleReason::NoFreePose { by, .. }
            | InfeasibleReason::BlockedPath { by }
            | InfeasibleReason::NotInView { by, .. } => by.as_ref(),
            InfeasibleReason::NoPlace(Misfit::Taken { by, .. }) => by.as_ref(),
            InfeasibleReason::NoPlace(_)
            | InfeasibleReason::OutOfReach { .. }
            | InfeasibleReason::TooHeavy { .. }
            | InfeasibleReason::TooWide { .. }
            | InfeasibleReason::Beside { .. } => None,
        };
        let rules = self.only_because_of(possible, query);
        let changed = culprit.and_then(|by| Some((by, possible.changer(by)?)));
        let mut story = Vec::new();
        let mut since: Vec<Related> = Vec::new();
        if let Some((by, step)) = changed {
            story.push(format!("`{by}` is as `{}` left it", self.call_name(step)));
            since.extend(self.related("changed here", step));
        }
        if let Some(step) = possible.stands_since {
            story.push(format!("the robot stands where `{}` brought it", self.call_name(step)));
            since.extend(self.related("the robot came here", step));
        }
        if let (Some((held, _)), Some(step)) = (&possible.at.world.held, possible.held_since) {
            story.push(format!("the hand holds `{held}`"));
            since.extend(self.related("taken here", step));
        }
        let story = if story.is_empty() { String::new() } else { format!("; {}", story.join(", ")) };
        let told = RefusedMotion {
            callee: callee.clone(),
            motion: query.to_string(),
            says: match &rules {
                Some(rules) => {
                    format!("{rules} leaves no way: {}; without it there is a motion", why.reason)
                }
                None => why.says(),
            },
            story,
            change: why.change.clone().filter(|_| rules.is_none()),
            is_certified: why.certified,
            since,
            entity: target(query).cloned(),
            plain: plain_reason(self.geometry.scene(), query, &why.reason),
        };
        let mut diagnostic = refused(&why.reason, span, told);
        if !why.certified {
            diagnostic.severity = Severity::Warning;
        }
        Some(diagnostic)
    }

    fn related(&self, message: &'static str, step: StepId) -> Option<Related> {
        Some(Related::new(message, self.program.steps.get(step.index())?.span))
    }

    /// Call of a step in short: `go(sink)`.
    pub(super) fn call_name(&self, step: StepId) -> String {
        let Some(StepKind::Call(call)) = self.program.steps.get(step.index()).map(|step| &step.kind) else {
            return "a step".to_owned();
        };
        let def = self.library.primitive(call.primitive);
        let name = def.map_or("a step", |def| def.name.as_str());
        let args = def.into_iter().flat_map(|def| def.asked(&call.args)).filter_map(|arg| match arg {
            Term::Entity(entity) => Some(self.environment.name(*entity)),
            Term::Binding(id) => self.program.bindings.get(id.index()).map(|binding| binding.name.clone()),
            _ => None,
        });
        let args: Vec<_> = args.collect();
        if args.is_empty() && !call.args.is_empty() {
            return name.to_owned();
        }
        format!("{name}({})", args.join(", "))
    }
}

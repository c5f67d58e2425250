//! Diagnostics of the robot's limits (M04xx), resources (M07xx), durations (M08xx), and style (M09xx).

use motet_syntax::{About, Edit, Fix, Related, Span};
use smol_str::SmolStr;

fn called(callee: &SmolStr) -> Option<About> {
    Some(About { primitive: Some(callee.clone()), ..About::default() })
}

motet_syntax::mistakes! {
    pub(crate) const CODES;

    /// Policy for another robot.
    OtherRobot("M0401", Error) { written: SmolStr, given: SmolStr }
    message(m) { format!("the policy is written for `{}`, but checked for `{}`", m.written, m.given) }
    help(m) { Some(format!("write the policy for `{}`, or pass `--robot {}`", m.given, m.written)) }

    /// Document without exactly one policy to run.
    NoPolicy("M0405", Error) { wanted: Option<SmolStr>, known: Vec<SmolStr> }
    message(m) {
        match (&m.wanted, m.known.as_slice()) {
            (Some(name), _) => format!("there is no policy `{name}` without parameters"),
            (None, []) => "there is no policy without parameters to run".to_owned(),
            (None, several) => format!("there are {} policies to choose from", several.len()),
        }
    }
    help(m) {
        let known: Vec<_> = m.known.iter().map(|name| format!("`{name}`")).collect();
        Some(if known.is_empty() {
            "write `policy NAME { … }`".to_owned()
        } else {
            format!("name one with `--policy`, or keep only one: {}", known.join(", "))
        })
    }

    /// Primitive that the robot does not provide.
    NotProvided("M0402", Error) { primitive: SmolStr, robot: SmolStr }
    message(m) { format!("`{}` does not provide `{}`", m.robot, m.primitive) }
    help(m) { Some(format!("`motet robots show {}` lists its primitives", m.robot)) }

    /// Policy for an unknown robot.
    UnknownRobot("M0447", Error) { name: SmolStr, near: Option<SmolStr>, known: String }
    message(m) { format!("there is no robot `{}`", m.name) }
    help(m) {
        Some(match &m.near {
            Some(near) => format!("did you mean `{near}`?"),
            None => format!("the robots are {}; the card of another is given with `--robot FOLDER`", m.known),
        })
    }
    fix(m) {
        let text = m.near.as_ref()?.to_string();
        Some(Fix { title: format!("write `{text}`"), edits: vec![Edit { span: m.span, text }] })
    }

    /// Condition on a fluent or measure that the robot cannot observe.
    NotObservable("M0403", Error) { what: SmolStr, robot: SmolStr }
    message(m) { format!("`{}` cannot observe `{}`", m.robot, m.what) }
    help(m) { Some(format!("use a fluent or measure that `{}` lists under `observes`", m.robot)) }

    /// Argument outside of the range of the robot.
    BeyondRange("M0404", Error) {
        param: SmolStr, callee: SmolStr, robot: SmolStr, least: String, greatest: String, actual: String,
        degrees: Option<String>,
    }
    message(m) {
        let (param, callee, robot) = (&m.param, &m.callee, &m.robot);
        format!("`{param}` of `{callee}` is {}, but `{robot}` allows {} to {}", m.actual, m.least, m.greatest)
    }
    help(m) {
        Some(match &m.degrees {
            Some(degrees) => format!("a number without a unit is in radians: did you mean `\"{degrees}\"`?"),
            None => format!("write a value from {} to {}", m.least, m.greatest),
        })
    }

    /// Parallel branches that use one resource.
    ResourceConflict("M0701", Error) { resource: SmolStr, one: SmolStr, other: SmolStr, first: Span }
    message(m) { format!("`{}` and `{}` run in parallel, but both use `{}`", m.one, m.other, m.resource) }
    help(_m) { Some("run these steps one after the other".to_owned()) }
    related(m) { vec![Related::new("also used here", m.first)] }

    /// Policy that can take longer than allowed.
    TooLong("M0801", Error) { longest: String, limit: String }
    message(m) { format!("the policy can take {}, but at most {} is allowed", m.longest, m.limit) }
    help(_m) { Some("set shorter deadlines with `within`, or allow fewer rounds".to_owned()) }

    /// Block without steps.
    EmptyBlock("M0802", Error) { what: &'static str }
    message(m) { format!("this {} has no steps", m.what) }
    help(m) {
        Some(match m.what {
            "policy" => "add a step; `done` alone where nothing is to be done".to_owned(),
            _ => "add a step, or remove it".to_owned(),
        })
    }

    /// Ending inside a cleanup.
    EndsCleanup("M0805", Error) { ending: &'static str }
    message(m) { format!("`{}` would end a `finally` before it has cleaned up", m.ending) }
    help(_m) { Some("end the policy before the `finally` or behind it".to_owned()) }

    /// A binding is never used.
    Unused("M0901", Warning) { name: SmolStr, of_each: bool }
    message(m) { format!("`{}` is never used", m.name) }
    help(m) {
        Some(if m.of_each {
            format!("use `{0}` in the steps, or rename it to `_{0}`", m.name)
        } else {
            format!("use `{}`, or remove the binding", m.name)
        })
    }

    /// Description that fits several entities of the scene.
    Ambiguous("M0903", Warning) { callee: SmolStr, text: SmolStr, found: String }
    message(m) { format!("\"{}\" fits {}: the step can fail with `ambiguous`", m.text, m.found) }
    help(_m) { Some("use a description that fits only one, or catch `ambiguous`".to_owned()) }
    about(m) { called(&m.callee) }

    /// Description that fits no entity of the scene.
    Missing("M0904", Warning) { callee: SmolStr, text: SmolStr, near: Option<SmolStr> }
    message(m) { format!("\"{}\" fits nothing in the scene: the step can fail with `not_found`", m.text) }
    help(m) {
        Some(match &m.near {
            Some(near) => format!("did you mean \"{near}\"?"),
            None => "describe an entity of the scene, or catch `not_found`".to_owned(),
        })
    }
    about(m) { called(&m.callee) }
}

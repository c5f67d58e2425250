//! The robot's limits (M04xx), resources (M07xx), bounds (M08xx), and style (M09xx).

use motet_syntax::{About, Edit, Fix, Related, Span};
use smol_str::SmolStr;

fn called(callee: &SmolStr) -> Option<About> {
    Some(About { primitive: Some(callee.clone()), ..About::default() })
}

motet_syntax::mistakes! {
    pub(crate) const CODES;

    /// The policy is written for another robot.
    OtherRobot("M0401", Error) { written: SmolStr, given: SmolStr }
    message(m) { format!("the policy is for `{}`, and is checked for `{}`", m.written, m.given) }
    help(m) { Some(format!("write the policy for `{}`, or pass `--robot {}`", m.given, m.written)) }

    /// A document in which it is not clear which policy is meant.
    NoPolicy("M0405", Error) { wanted: Option<SmolStr>, known: Vec<SmolStr> }
    message(m) {
        match (&m.wanted, m.known.as_slice()) {
            (Some(name), _) => format!("there is no policy `{name}` without parameters"),
            (None, []) => "there is no policy without parameters to run".to_owned(),
            (None, several) => format!("there are {} policies, and it is not said which to run", several.len()),
        }
    }
    help(m) {
        let known: Vec<_> = m.known.iter().map(|name| format!("`{name}`")).collect();
        Some(if known.is_empty() {
            "write `policy NAME { … }`".to_owned()
        } else {
            format!("leave one of them, or name one with `--policy`: {}", known.join(", "))
        })
    }

    /// A primitive that the robot does not provide.
    NotProvided("M0402", Error) { primitive: SmolStr, robot: SmolStr }
    message(m) { format!("`{}` cannot do `{}`", m.robot, m.primitive) }
    help(m) { Some(format!("`motet robots show {}` lists what it can do", m.robot)) }

    /// The policy is written for a robot that nobody knows.
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

    /// A monitor, a wait or a loop on something that the robot cannot observe.
    NotObservable("M0403", Error) { what: SmolStr, robot: SmolStr }
    message(m) { format!("`{}` cannot observe `{}`", m.robot, m.what) }
    help(m) { Some(format!("watch something that `{}` lists under `observes`", m.robot)) }

    /// An argument beyond what the robot can do.
    BeyondRange("M0404", Error) {
        param: SmolStr, callee: SmolStr, robot: SmolStr, least: String, greatest: String, actual: String,
        degrees: Option<String>,
    }
    message(m) {
        format!("`{}` of `{}` is {}; `{}` takes {} to {}", m.param, m.callee, m.actual, m.robot, m.least, m.greatest)
    }
    help(m) {
        Some(match &m.degrees {
            Some(degrees) => format!("a number alone is in radians: did you mean `\"{degrees}\"`?"),
            None => format!("write a value from {} to {}", m.least, m.greatest),
        })
    }

    /// Two things that run at once use one resource.
    ResourceConflict("M0701", Error) { resource: SmolStr, one: SmolStr, other: SmolStr, first: Span }
    message(m) { format!("`{}` and `{}` run at once and both use `{}`", m.one, m.other, m.resource) }
    help(_m) { Some("do these steps one after the other".to_owned()) }
    related(m) { vec![Related::new("also used here", m.first)] }

    /// The policy can take longer than is allowed.
    TooLong("M0801", Error) { longest: String, limit: String }
    message(m) { format!("the policy can take {}, and at most {} is allowed", m.longest, m.limit) }
    help(_m) { Some("set shorter deadlines with `within`, or fewer rounds".to_owned()) }

    /// A block with nothing in it.
    EmptyBlock("M0802", Warning) { what: &'static str }
    message(m) { format!("this {} has no steps", m.what) }
    help(_m) { Some("add a step, or leave it out".to_owned()) }

    /// A binding that nothing uses.
    Unused("M0901", Warning) { name: SmolStr, of_each: bool }
    message(m) { format!("`{}` is never used", m.name) }
    help(m) {
        Some(if m.of_each {
            format!("use `{0}` in the steps, or call it `_{0}`", m.name)
        } else {
            format!("use `{}`, or call the step without binding it", m.name)
        })
    }

    /// A description that fits several entities of the scene.
    Ambiguous("M0903", Warning) { callee: SmolStr, text: SmolStr, found: String }
    message(m) { format!("\"{}\" fits {}: the step can fail with `ambiguous`", m.text, m.found) }
    help(_m) { Some("describe it so that it fits one, or catch `ambiguous`".to_owned()) }
    about(m) { called(&m.callee) }

    /// A description that fits nothing in the scene.
    Missing("M0904", Warning) { callee: SmolStr, text: SmolStr, near: Option<SmolStr> }
    message(m) { format!("\"{}\" fits nothing in the scene: the step can fail with `not_found`", m.text) }
    help(m) {
        Some(match &m.near {
            Some(near) => format!("did you mean \"{near}\"?"),
            None => "describe something that is there, or catch `not_found`".to_owned(),
        })
    }
    about(m) { called(&m.callee) }
}

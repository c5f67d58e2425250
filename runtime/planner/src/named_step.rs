//! Steps that a request asks for by their name, as text of a policy.

use motet_compiler::Session;
use motet_requests::NamedStep;
use motet_robots::card::Robot;
use motet_robots::scene::Scene;
use motet_stdlib::lang::{fluents, kinds, primitives};
use motet_syntax::print;
use smol_str::SmolStr;

use crate::planned::quoted;

/// Primitive of a named step.
const fn primitive(step: &NamedStep) -> &'static str {
    match step {
        NamedStep::Turn { .. } => primitives::TURN,
        NamedStep::WakeUp => primitives::WAKE_UP,
        NamedStep::Home => primitives::HOME,
        NamedStep::Inspect { .. } => primitives::INSPECT,
    }
}

/// True if the robot can do it.
pub(crate) fn has(step: &NamedStep, session: &Session) -> bool {
    session.signatures().callable(primitive(step)).is_some()
}

/// A named step behind `I cannot`.
pub(crate) const fn words(step: &NamedStep) -> &'static str {
    match step {
        NamedStep::Turn { .. } => "turn on the spot",
        NamedStep::WakeUp => "wake up, since I am always ready",
        NamedStep::Home => "fold my arm",
        NamedStep::Inspect { .. } => "look at a single thing",
    }
}

/// Calls of a named step.
pub(crate) fn steps(step: &NamedStep, robot: Option<&Robot>, scene: Option<&Scene>) -> String {
    let name = primitive(step);
    match step {
        NamedStep::Turn { degrees } => format!("{name}({degrees} deg)"),
        NamedStep::WakeUp | NamedStep::Home => format!("{name}()"),
        NamedStep::Inspect { thing, tells } => {
            let id = print::identifier(thing);
            let report = if *tells { report(thing, robot, scene) } else { String::new() };
            format!("{name}({id})\n{report}")
        }
    }
}

/// Steps that tell what the robot sees of a thing: where it is, whether it is open, whether something lies on
/// it.
fn report(thing: &SmolStr, robot: Option<&Robot>, scene: Option<&Scene>) -> String {
    let observes =
        |fluent: &str| robot.is_some_and(|robot| robot.observes.iter().any(|known| known == fluent));
    let entity = scene.and_then(|scene| scene.entities.get(thing));
    let called = |id: &str| scene.map_or_else(|| id.replace('_', " "), |scene| scene.called(id));
    let (id, the) = (print::identifier(thing), format!("The {}", called(thing)));
    let either = |condition: String, [yes, no]: [String; 2]| {
        let (say, yes, no) = (primitives::SAY, quoted(&yes), quoted(&no));
        format!("if {condition} {{ {say}({yes}) }} else {{ {say}({no}) }}\n")
    };
    let mut steps = String::new();
    let support = entity.filter(|entity| !entity.fixed).and_then(|entity| entity.on.as_ref());
    let support = support.filter(|_| observes(fluents::ON));
    if let Some(support) = support {
        let place = called(support);
        let is = [format!("{the} is on the {place}."), format!("{the} is not on the {place}.")];
        steps.push_str(&either(format!("{}({id}, {})", fluents::ON, print::identifier(support)), is));
    }
    if entity.is_some_and(|entity| entity.open.is_some()) && observes(fluents::OPEN) {
        let is = [format!("{the} is open."), format!("{the} is closed.")];
        steps.push_str(&either(format!("{}({id})", fluents::OPEN), is));
    } else if entity.is_some_and(|entity| entity.kind != kinds::CONTAINER) && observes(fluents::CLEAR) {
        let is = ["Nothing lies on it.".to_owned(), "Something lies on it.".to_owned()];
        steps.push_str(&either(format!("{}({id})", fluents::CLEAR), is));
    }
    if steps.is_empty() {
        steps = format!("{}({})\n", primitives::SAY, quoted(&format!("I see the {}.", called(thing))));
    }
    steps
}

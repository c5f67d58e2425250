//! Reasons of problems in a person's words: who cannot do what, and the number that matters. Ids become
//! names, and nothing is quoted from a policy.

use motet_compiler::plan::NoPlan;
use motet_robots::scene::Scene;
use motet_stdlib::lang::{entities, fluents, kinds, primitives};
use motet_syntax::{Diagnostic, Severity};
use smol_str::SmolStr;

/// A reason, with its subject if it has one.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct Reason {
    pub(super) about: Option<SmolStr>,
    /// A sentence without its full stop.
    pub(super) says: String,
}

/// Actions by primitive, behind `I cannot`. `{thing}` stands for the last entity among the arguments.
const ACTIONS: &[(&str, &str)] = &[
    (primitives::GO, "get to {thing}"),
    (primitives::PICK, "pick up {thing}"),
    (primitives::GRASP, "grasp {thing}"),
    (primitives::PLACE, "put it {at} {thing}"),
    (primitives::HANDOVER, "hand it to {thing}"),
    (primitives::OPEN, "open {thing}"),
    (primitives::CLOSE, "close {thing}"),
    (primitives::PUSH, "push {thing}"),
    (primitives::DETECT, "see {thing} from here"),
    (primitives::SEARCH, "look for {thing} there"),
    (primitives::LOCATE, "see {thing} from here"),
    (primitives::INSPECT, "look at {thing} from here"),
    (primitives::GROUND, "see {thing} from here"),
    (primitives::TURN, "turn here"),
    (primitives::HOME, "fold my arm here"),
    (primitives::START_POSE, "bring my arm into position here"),
    (primitives::WAKE_UP, "stand up"),
];

/// An action in words: `pick up the coke can`.
pub(super) fn action(scene: &Scene, primitive: &str, about: Option<&SmolStr>) -> String {
    let thing = about.map_or_else(|| "it".to_owned(), |id| named(scene, id));
    let kind = about.and_then(|id| scene.entities.get(id)).map(|entity| entity.kind.as_str());
    let at = if kind == Some(kinds::CONTAINER) { fluents::IN } else { fluents::ON };
    match ACTIONS.iter().find(|(known, _)| *known == primitive) {
        Some((_, words)) => words.replace("{thing}", &thing).replace("{at}", at),
        None => format!("{} {thing}", primitive.replace('_', " ")),
    }
}

/// An entity in a sentence: `the coke can`, `you`.
pub(super) fn named(scene: &Scene, id: &str) -> String {
    if id == entities::USER { "you".to_owned() } else { format!("the {}", scene.called(id)) }
}

/// Reason behind a plan that does not pass the check.
pub(super) fn refused(diagnostics: &[Diagnostic], scene: &Scene) -> Reason {
    let first = diagnostics.iter().find(|said| said.severity == Severity::Error);
    let Some(first) = first else { return Reason { about: None, says: "I cannot do that".to_owned() } };
    if let Some(about) = &first.about
        && let (Some(primitive), Some(plain)) = (&about.primitive, &about.plain)
    {
        let action = action(scene, primitive, about.entity.as_ref());
        return Reason { about: about.entity.clone(), says: format!("I cannot {action}: {plain}") };
    }
    Reason { about: None, says: format!("I cannot do that: {}", in_words(&first.message, scene)) }
}

/// Reason behind a goal without a plan.
pub(super) fn no_plan(why: &NoPlan, scene: &Scene) -> Reason {
    let blocker = match why {
        NoPlan::Unreachable { blocker, .. } => blocker.as_deref(),
        NoPlan::Budget { .. } => {
            return Reason { about: None, says: "that takes more steps than I can plan".to_owned() };
        }
        NoPlan::NoCondition { .. } | NoPlan::Wrong { .. } | NoPlan::Unwritable { .. } => None,
    };
    let bare = blocker.unwrap_or_default().trim_matches('`');
    if let Some((id, limit)) = bare.split_once('.')
        && let Some(too_much) = too_much(scene, id, limit)
    {
        let says = format!("I cannot pick up the {}: {too_much}", scene.called(id));
        return Reason { about: Some(id.into()), says };
    }
    let args = bare.split_once('(').map(|(_, args)| args.trim_end_matches(')').split(", "));
    let about = args.into_iter().flatten().find(|id| scene.entities.contains_key(*id)).map(SmolStr::from);
    let thing = about.as_ref().map(|id| named(scene, id));
    let says = match (bare.split_once('('), thing) {
        (Some(("not locked", _)), Some(thing)) => format!("I cannot open {thing}: it is locked"),
        (Some((fluents::CLEAR, _)), Some(thing)) => {
            format!("I cannot pick up {thing}: something lies on it, which I cannot take away")
        }
        (_, Some(thing)) => format!("I know of no way to do that with {thing}"),
        (_, None) => "I know of no way to do that".to_owned(),
    };
    Reason { about, says }
}

/// Mass or width of a thing beyond a limit such as `mass <= 1.2`.
fn too_much(scene: &Scene, id: &str, limit: &str) -> Option<String> {
    let entity = scene.entities.get(id)?;
    let (field, limit) = limit.split_once(" <= ")?;
    let limit: f64 = limit.parse().ok()?;
    match field {
        "mass" => Some(format!("it weighs {} kg, I carry {limit} kg", entity.mass_kg?)),
        "width" => {
            let [width, limit] = [entity.width()?, limit].map(|length| length * 100.0);
            Some(format!("it is {width:.1} cm wide, my hand opens to {limit:.1} cm"))
        }
        _ => None,
    }
}

/// A message for authors in words for a person: names in place of ids, and no counts of samples.
pub(super) fn in_words(message: &str, scene: &Scene) -> String {
    let mut words = String::with_capacity(message.len());
    for (index, part) in message.split('`').enumerate() {
        if index % 2 == 0 {
            words.push_str(part);
        } else if scene.entities.contains_key(part) {
            words.push_str(&named(scene, part));
        } else {
            words.push_str(&part.replace(['_', '(', ')'], " ").trim().replace("  ", " "));
        }
    }
    match (words.find(" ("), words.find(" samples)")) {
        (Some(begin), Some(end)) if begin < end => {
            words.replace_range(begin..end + " samples)".len(), "");
            words
        }
        _ => words,
    }
}

#[cfg(test)]
mod tests {
    use super::in_words;

    #[test]
    fn in_words_has_names_and_no_counts() {
        let kitchen = motet_robots::builtin::scene("kitchen").unwrap();
        let message = "every candidate configuration collides, most often with `fridge_1` (28 of 40 samples)";
        let said = "every candidate configuration collides, most often with the refrigerator";
        assert_eq!(in_words(message, &kitchen), said);
        assert_eq!(in_words("`pick(coke)` failed", &kitchen), "pick coke failed");
    }
}

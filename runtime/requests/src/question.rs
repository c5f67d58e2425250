//! Questions to the robot: about the room, about itself, and about what it did. Requests are read elsewhere.

use motet_robots::scene::Entity;
use smol_str::SmolStr;

use crate::engine::effort::bounded;
use crate::engine::english::{PRONOUNS, STEPS_DOING, STEPS_DONE};
use crate::engine::rule::Rules;
use crate::engine::token::{Token, tokens};
use crate::{MAX_REQUEST, RequestContext, called, named};

/// Subject of a question.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Topic {
    /// Location of things: "where is the coke?"
    Location,
    /// Location of the robot: "where are you?"
    Standing,
    /// Thing in the hand: "what do you hold?"
    Held,
    /// Presence of a thing in the hand: "are you holding the coke?"
    Holds,
    /// State of a door or a drawer: "is the drawer open?"
    Open,
    /// The same, asked the other way round.
    Closed,
    /// Presence of a thing at a place: "is the coke in the fridge?"
    Placed,
    /// Things at a place: "what is on the table?"
    Contents,
    /// Presence of a thing in the room: "is there a coke?"
    Existence,
    /// Number of things, in the room or at a place: "how many mugs are there?"
    Count,
    /// Distance of a thing from the robot: "how far away is the coke?"
    Distance,
    /// Feasibility of taking a thing: "can you reach the coke?"
    Reach,
    /// Steps so far: "what did you do?"
    History,
    /// Steps that run: "what are you doing?"
    Activity,
    /// Things in view: "what do you see?"
    View,
    /// Things that were in view so far: "what have you seen?"
    Seen,
}

/// Topics by the words of the rules.
const TOPICS: &[(&str, Topic)] = &[
    ("location", Topic::Location),
    ("standing", Topic::Standing),
    ("held", Topic::Held),
    ("holds", Topic::Holds),
    ("open", Topic::Open),
    ("closed", Topic::Closed),
    ("placed", Topic::Placed),
    ("contents", Topic::Contents),
    ("existence", Topic::Existence),
    ("count", Topic::Count),
    ("distance", Topic::Distance),
    ("reach", Topic::Reach),
    ("history", Topic::History),
    ("activity", Topic::Activity),
    ("view", Topic::View),
    ("seen", Topic::Seen),
];

/// A question with the things that it names.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct RoomQuestion {
    pub topic: Topic,
    /// Things that it is asked of, in the order of the scene. Empty if it names none, or none that is known.
    pub things: Vec<SmolStr>,
    /// Place that it names.
    pub place: Option<SmolStr>,
    /// Words for the things, as they were said; empty for a pronoun that means nothing.
    pub said: String,
}

/// True if a text is a question that [`question`] reads.
#[must_use]
pub fn is_question(text: &str) -> bool {
    read(text).is_some()
}

/// Reads a question. `None` for anything else. The same text and situation give the same question. O(words ·
/// things).
///
/// ```
/// use motet_requests::{RequestContext, Topic, question};
///
/// let kitchen = motet_robots::builtin::scene("kitchen").unwrap();
/// let asked = question("Where is the coke?", &RequestContext::new(&kitchen)).unwrap();
/// assert_eq!((asked.topic, asked.things.as_slice()), (Topic::Location, &["coke".into()][..]));
/// assert_eq!(question("bring me the coke", &RequestContext::new(&kitchen)), None);
/// ```
#[must_use]
pub fn question(text: &str, situation: &RequestContext<'_>) -> Option<RoomQuestion> {
    let (topic, thing, place) = read(text)?;
    let mut things = named(&thing, situation);
    let is_pronoun = things.is_empty() && PRONOUNS.has(&thing);
    if is_pronoun {
        things.extend(situation.spoken_of.last().cloned());
    }
    let (is_at, place) = (place.is_some(), place.and_then(|at| named(&at, situation).into_iter().next()));
    // Nobody counts what is at a place that is not known.
    things.retain(|_| topic != Topic::Count || place.is_some() == is_at);
    let said = ["the ", "a ", "an ", "my ", "any ", "some "].iter().find_map(|lead| thing.strip_prefix(lead));
    let said = if is_pronoun { "" } else { said.unwrap_or(&thing) }.to_owned();
    Some(RoomQuestion { topic, things, place, said })
}

/// Topic, words for the thing, and words for the place.
fn read(text: &str) -> Option<(Topic, String, Option<String>)> {
    if text.len() > MAX_REQUEST {
        return None;
    }
    let mut said = tokens(text);
    said.retain(|token| *token != Token::Comma);
    // One sentence is asked at a time.
    let end = said.iter().position(|token| *token == Token::Stop).unwrap_or(said.len());
    if said.iter().skip(end).any(|token| *token != Token::Stop) {
        return None;
    }
    said.truncate(end);
    let found = bounded(|| Rules("room_questions").at(&said, 0)).flatten()?;
    let (topic, rest) = found.words.split_first()?;
    let topic = TOPICS.iter().find(|(word, _)| *word == topic.word())?.1;
    let words = |tokens: &[Token]| tokens.iter().map(Token::word).collect::<Vec<_>>().join(" ");
    let mut parts = rest.split(|token| token.word() == "|");
    let first = parts.next().map(words).unwrap_or_default();
    let second = parts.next().map(words);
    Some(if topic == Topic::Contents { (topic, String::new(), Some(first)) } else { (topic, first, second) })
}

/// Words for a step that was done: "picked up the coke" for `pick` with the coke. Arguments are ids of the
/// scene or texts. Other primitives are said by their names.
#[must_use]
pub fn step_done(primitive: &str, args: &[SmolStr], situation: &RequestContext<'_>) -> String {
    step(("did", STEPS_DONE.value(&primitive.replace('_', " "))), primitive, args, situation)
}

/// Words for a step that runs, or that was tried: "picking up the coke".
#[must_use]
pub fn step_doing(primitive: &str, args: &[SmolStr], situation: &RequestContext<'_>) -> String {
    step(("doing", STEPS_DOING.value(&primitive.replace('_', " "))), primitive, args, situation)
}

fn step(
    (verb, pattern): (&str, Option<&str>),
    primitive: &str,
    args: &[SmolStr],
    situation: &RequestContext<'_>,
) -> String {
    let words = |id: &SmolStr| the(situation.scene.entities.get(id), id);
    let Some(pattern) = pattern else {
        let known = |id: &SmolStr| situation.scene.entities.contains_key(id);
        let args = args.iter().map(|id| if known(id) { words(id) } else { id.to_string() });
        let args: Vec<String> = args.collect();
        return format!("{verb} `{primitive}` {}", args.join(", ")).trim_end().to_owned();
    };
    let mut text = pattern.to_owned();
    for (index, arg) in args.iter().enumerate() {
        let relation = situation.scene.entities.get(arg).map_or("at", Entity::relation);
        text = text.replace(&format!("\"{{{index}}}\""), &format!("\"{arg}\""));
        text = text.replace(&format!("{{@{index}}}"), &format!("{relation} {}", words(arg)));
        text = text.replace(&format!("{{{index}}}"), &words(arg));
    }
    text
}

/// An entity in the words of a sentence: `the coke`, `you`.
fn the(entity: Option<&Entity>, id: &SmolStr) -> String {
    match entity {
        Some(entity) if entity.kind == motet_stdlib::lang::kinds::PERSON => match id.as_str() {
            motet_stdlib::lang::entities::USER => "you".to_owned(),
            _ => called(entity),
        },
        Some(entity) => format!("the {}", called(entity)),
        None => format!("the {id}"),
    }
}

#[cfg(test)]
mod tests {
    use super::{RoomQuestion, Topic, is_question, question, step_doing, step_done};
    use crate::RequestContext;

    #[test]
    fn question_names_its_topic_its_things_and_its_place() {
        let kitchen = motet_robots::builtin::scene("kitchen").unwrap();
        let mut situation = RequestContext::new(&kitchen);
        situation.spoken_of = vec!["coke".into()];
        for (text, topic, things, place) in [
            ("Where is the coke?", Topic::Location, &["coke"][..], None),
            ("hey robot, do you know where the red mug is?", Topic::Location, &["mug_1"], None),
            ("where are the mugs", Topic::Location, &["mug_1", "mug_2"], None),
            ("Where is it now?", Topic::Location, &["coke"], None),
            ("where did you put the coke", Topic::Location, &["coke"], None),
            ("where is the teddy?", Topic::Location, &[], None),
            ("where are you?", Topic::Standing, &[], None),
            ("What do you hold?", Topic::Held, &[], None),
            ("what's in your hand?", Topic::Held, &[], None),
            ("are you holding the coke?", Topic::Holds, &["coke"], None),
            ("is the fridge open?", Topic::Open, &["fridge_1"], None),
            ("Is the fridge still closed?", Topic::Closed, &["fridge_1"], None),
            ("is the coke on the counter?", Topic::Placed, &["coke"], Some("counter")),
            ("is there a coke in the fridge?", Topic::Placed, &["coke"], Some("fridge_1")),
            ("what is on the counter?", Topic::Contents, &[], Some("counter")),
            ("is there anything in the fridge?", Topic::Contents, &[], Some("fridge_1")),
            ("is there any coke?", Topic::Existence, &["coke"], None),
            ("what did you do?", Topic::History, &[], None),
            ("What have you done so far?", Topic::History, &[], None),
            ("what are you doing right now?", Topic::Activity, &[], None),
            ("what can you see?", Topic::View, &[], None),
            ("what have you seen?", Topic::Seen, &[], None),
            ("is the drawer empty?", Topic::Contents, &[], Some("drawer_1")),
            ("which things are on the table?", Topic::Contents, &[], Some("kitchen_table")),
            ("how many mugs are there?", Topic::Count, &["mug_1", "mug_2"], None),
            ("how many mugs are on the shelf?", Topic::Count, &["mug_1", "mug_2"], Some("shelf")),
            ("did you bring the coke?", Topic::Placed, &["coke"], Some("user")),
            ("How far away is the coke?", Topic::Distance, &["coke"], None),
            ("is anything in your hand?", Topic::Held, &[], None),
            ("can you reach the coke?", Topic::Reach, &["coke"], None),
        ] {
            let asked = question(text, &situation);
            let RoomQuestion { topic: found, things: named, place: at, .. } =
                asked.unwrap_or_else(|| panic!("{text}"));
            assert_eq!((found, named.as_slice(), at.as_deref()), (topic, &*owned(things), place), "{text}");
        }
    }

    fn owned(things: &[&str]) -> Vec<smol_str::SmolStr> {
        things.iter().map(|thing| (*thing).into()).collect()
    }

    #[test]
    fn question_is_no_request() {
        for text in [
            "bring me the coke",
            "can you bring me the coke?",
            "can you reach me the coke?",
            "put the coke where the mug is",
            "where is the coke? bring it to me",
            "is the coke on the table then bring it",
            "open the fridge",
            "the coke is in the fridge",
            "would you tell me a story",
            "stop",
            "",
        ] {
            assert!(!is_question(text), "{text}");
        }
    }

    #[test]
    fn question_step_done_is_in_words() {
        let kitchen = motet_robots::builtin::scene("kitchen").unwrap();
        let situation = RequestContext::new(&kitchen);
        let said = |primitive: &str, args: &[&str]| step_done(primitive, &owned(args), &situation);
        assert_eq!(said("pick", &["coke"]), "picked up the coke can");
        assert_eq!(said("place", &["coke", "counter"]), "put the coke can on the kitchen counter");
        assert_eq!(said("handover", &["coke", "user"]), "handed the coke can to you");
        assert_eq!(said("say", &["the apple"]), "said \"the apple\"");
        assert_eq!(said("search", &["stapler"]), "looked for the stapler");
        assert_eq!(said("dance", &[]), "did `dance`");
        assert_eq!(step_doing("pick", &owned(&["coke"]), &situation), "picking up the coke can");
    }
}

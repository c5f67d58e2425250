#![doc = include_str!("../README.md")]

mod answer;
mod argument;
mod carry_goal;
mod command;
mod command_goal;
mod engine;
mod error;
mod extreme;
mod meaning;
mod named_step;
mod parse;
mod polarity;
mod question;
mod reference;
mod remark;
mod statement;

use motet_robots::scene::Scene;
use smol_str::SmolStr;

use engine::effort::bounded;
use engine::token::Token;

pub use answer::{called, choose, encourages, named, pick};
pub use error::RequestError;
pub use meaning::{Aim, Certainty, Intent};
pub use polarity::{
    Polarity, added, holds, is_wordless, polarity, proceeds, refuses, replaces, seeks, stops, withdrawn,
};
pub use question::{RoomQuestion, Topic, is_question, question, step_doing, step_done};

/// A step that a request asks for by its name.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum NamedStep {
    /// Turns on the spot, by degrees to the left.
    Turn { degrees: i32 },
    /// Gets on its feet.
    WakeUp,
    /// Folds the arm.
    Home,
    /// Looks at a thing closely, and tells about it if somebody asked.
    Inspect {
        thing: SmolStr,
        /// True if the robot says what it saw.
        tells: bool,
    },
}

/// The context of a request: the scene, and what changed or was said since. Plain data; `Send` and `Sync`.
#[derive(Clone, Debug)]
pub struct RequestContext<'a> {
    /// The things of the scene, with their names and where they were at the start.
    pub scene: &'a Scene,
    /// The thing in the hand.
    pub holding: Option<SmolStr>,
    /// Things that are elsewhere than in the scene, each with its support; `None` for nowhere.
    pub supports: Vec<(SmolStr, Option<SmolStr>)>,
    /// Things that were spoken of before, the latest last: the referents of pronouns.
    pub spoken_of: Vec<SmolStr>,
    /// Things with the places that they were last taken from, the latest last.
    pub came_from: Vec<(SmolStr, SmolStr)>,
    /// Positions of things that a camera saw elsewhere than in the scene, in m in the frame `map`.
    pub seen_at: Vec<(SmolStr, [f64; 3])>,
    /// Phrases with the things that they mean, as answers to questions told.
    pub meant: Vec<(String, SmolStr)>,
    /// Preferences that somebody told, the latest last.
    pub prefers: Vec<Preference>,
}

/// Things that somebody would rather have than others.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Preference {
    pub liked: Vec<SmolStr>,
    pub over: Vec<SmolStr>,
}

/// A location of a thing, as a person reported it.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct ReportedLocation {
    pub thing: SmolStr,
    /// `on` or `in`.
    pub relation: &'static str,
    pub place: SmolStr,
}

impl<'a> RequestContext<'a> {
    /// The situation at the start of a scene.
    #[must_use]
    pub fn new(scene: &'a Scene) -> Self {
        let holding = scene.robot.holding.clone().flatten();
        Self {
            scene,
            holding,
            supports: Vec::new(),
            spoken_of: Vec::new(),
            came_from: Vec::new(),
            seen_at: Vec::new(),
            meant: Vec::new(),
            prefers: Vec::new(),
        }
    }
}

/// Reads reported locations from an answer: "it should be in the cupboard" tells a place to whom asked for
/// one, where in a request it says what shall be done. Empty where it says nothing of the kind.
#[must_use]
pub fn told(answer: &str, asked: PendingQuestion, situation: &RequestContext<'_>) -> Vec<ReportedLocation> {
    if answer.len() > MAX_REQUEST {
        return Vec::new();
    }
    let read = || {
        meaning::told(&engine::rewrite::without_courtesy(&engine::token::tokens(answer)), asked, situation)
    };
    bounded(read).unwrap_or_default()
}

/// Question that an answer is given to.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum PendingQuestion {
    /// The place of a thing: a place to open or to go to for a look is where it may be.
    Where,
    /// An act for a thing that could not be taken.
    What,
}

/// Angle of an answer that names a direction to look in, in degrees to the left: `turn left`, `look behind
/// you`.
#[must_use]
pub fn turn(answer: &str) -> Option<i32> {
    if answer.len() > MAX_REQUEST {
        return None;
    }
    bounded(|| turned(answer)).flatten()
}

fn turned(answer: &str) -> Option<i32> {
    let mut tokens = engine::rewrite::without_courtesy(&engine::token::tokens(answer));
    tokens.retain(|token| !token.word().is_empty());
    let begin = engine::asking::skip_leads(&tokens, 0);
    let valued = |list: &engine::phrases::Phrases| list.valued(&tokens, begin);
    let (count, degrees) =
        valued(&engine::english::TURNS_BY).or_else(|| valued(&engine::english::LOOKS_ASIDE))?;
    (begin + count == tokens.len()).then(|| degrees.parse().ok()).flatten()
}

/// True if an answer is a bare noun or place, such as completes a request: "the cupboard", "on the
/// table, please".
#[must_use]
pub fn is_bare(answer: &str) -> bool {
    answer.len() <= MAX_REQUEST && bounded(|| is_bare_noun(answer)).unwrap_or_default()
}

fn is_bare_noun(answer: &str) -> bool {
    let mut tokens = engine::token::tokens(answer);
    tokens.retain(|token| !matches!(token.word(), "please" | ""));
    let place = engine::noun::place(&tokens, 0).map(|(_, end)| end);
    engine::noun::noun(&tokens, 0).map(|(_, end)| end).or(place) == Some(tokens.len())
}

/// The most bytes of a request: what somebody says in one breath, and no document. Longer ones are not read.
pub const MAX_REQUEST: usize = 4096;

/// Understands a request. The same request and situation give the same goals. O(words · things) for what
/// people say; a text that takes more than a bounded number of steps is not read, whatever its length.
///
/// # Errors
///
/// The part that is not understood, not there, or not clear.
pub fn understand(request: &str, situation: &RequestContext<'_>) -> Result<Intent, RequestError> {
    check_length(request)?;
    let found = bounded(|| understand_tokens(&engine::token::tokens(request), request, situation));
    found.unwrap_or_else(|| {
        let why = "the request is too involved for me: say it in shorter sentences".to_owned();
        Err(RequestError::Unfit { why })
    })
}

/// Checks that a request has at most [`MAX_REQUEST`] bytes.
///
/// # Errors
///
/// It has more.
pub fn check_length(request: &str) -> Result<(), RequestError> {
    let why = || format!("a request may have at most {MAX_REQUEST} bytes");
    if request.len() > MAX_REQUEST { Err(RequestError::Unfit { why: why() }) } else { Ok(()) }
}

fn understand_tokens(
    tokens: &[Token],
    request: &str,
    situation: &RequestContext<'_>,
) -> Result<Intent, RequestError> {
    if let Some((preference, rest)) = named_step::preference(tokens, situation) {
        let mut prefers = situation.prefers.clone();
        prefers.push(preference);
        let context = RequestContext { prefers: prefers.clone(), ..situation.clone() };
        let is_all = rest.iter().all(|token| token.word().is_empty());
        let intent = if is_all { Ok(Intent::default()) } else { understand_tokens(&rest, request, &context) };
        return intent.map(|intent| Intent { prefers, ..intent });
    }
    let again = |tokens: &[Token]| understand_tokens(tokens, request, situation);
    if let Some(found) = named_step::excluding(tokens, situation, again) {
        return found;
    }
    let plain = |tokens: &[Token]| {
        let tokens = engine::rewrite::plain(tokens);
        let spoken = parse::parse(&tokens).map_err(|part| RequestError::NotUnderstood { part })?;
        meaning::understood(&spoken, request, situation)
    };
    let found = plain(tokens);
    if found.as_ref().is_ok_and(|intent| !intent.aims.is_empty() || !intent.located.is_empty()) {
        return found;
    }
    named_step::understood(tokens, request, situation).unwrap_or(found)
}

#[cfg(test)]
mod tests {
    use motet_robots::builtin;

    use super::{MAX_REQUEST, PendingQuestion, RequestContext, question, told, turn, understand};

    /// Texts within the limit of bytes whose reading would take seconds to hours, and people's words that are
    /// as long.
    #[test]
    fn understand_text_of_any_length_takes_a_bounded_number_of_steps() {
        let scene = builtin::scene("kitchen").unwrap();
        let context = RequestContext::new(&scene);
        for piece in ["<a>", "the ", "a ", ", ", "it is on the table and ", "the xqzzv and ", "in "] {
            let text = format!("bring {}", piece.repeat((MAX_REQUEST - 6) / piece.len()));
            let read = understand(&text, &context);
            assert!(read.is_err(), "{piece}: {read:?}");
            // They share the bound.
            assert!(told(&text, PendingQuestion::Where, &context).len() < 1000, "{piece}");
            assert_eq!((turn(&text), question(&text, &context)), (None, None), "{piece}");
        }
        let prose = "bring me the coke, then put the apple on the sink. ".repeat(MAX_REQUEST / 52);
        assert!(understand(&prose, &context).is_ok(), "{:?}", understand(&prose, &context).err());
    }
}

//! What an answer to a question means for the task at hand.

use smol_str::SmolStr;

use super::problem::{Kind, Problem};
use crate::request::{self, Located, Puzzle, Situation};

/// What an answer means.
#[derive(Clone, PartialEq, Debug)]
pub enum Answer {
    /// Try again.
    Again,
    /// Leave it.
    GiveUp,
    /// These words mean this thing.
    Means {
        /// The words.
        said: String,
        /// The thing.
        id: SmolStr,
    },
    /// Something is somewhere else than was thought.
    Located(Vec<Located>),
    /// Another request.
    Request(String),
    /// Nothing that helps: the question is asked again.
    NotUnderstood,
}

/// Words that ask for another try.
const YES: &[&str] = &[
    "yes",
    "yeah",
    "yep",
    "sure",
    "ok",
    "okay",
    "please",
    "again",
    "retry",
    "try again",
    "try it again",
    "yes please",
    "go on",
    "please try again",
    "yes try again",
    "once more",
    "try once more",
];
/// Words that give it up.
const NO: &[&str] = &[
    "no",
    "nope",
    "stop",
    "cancel",
    "never mind",
    "nevermind",
    "leave it",
    "forget it",
    "forget about it",
    "give up",
    "no thanks",
    "no thank you",
    "abort",
    "skip it",
    "that is fine",
    "do not bother",
];

/// Reads an answer to a problem with a request.
pub(super) fn read(answer: &str, problem: &Problem, request: &str, situation: &Situation<'_>) -> Answer {
    let bare = bare(answer);
    if bare.is_empty() {
        return Answer::NotUnderstood;
    }
    if NO.contains(&bare.as_str()) {
        return Answer::GiveUp;
    }
    if YES.contains(&bare.as_str()) {
        return match problem.kind {
            // "Shall I bring you something to drink?" "Yes."
            Kind::AmbiguousTask => offered(&problem.question).map_or(Answer::NotUnderstood, Answer::Request),
            Kind::NotFound | Kind::NotReachable | Kind::ActionFailed => Answer::Again,
            Kind::AmbiguousReference => Answer::NotUnderstood,
        };
    }
    // A thing or a place among those that were offered, or any that fits the words in question.
    if let Some(said) = &problem.said
        && problem.kind != Kind::AmbiguousTask
        && let Some(id) = request::pick(answer, &problem.options, situation)
    {
        return Answer::Means { said: said.clone(), id };
    }
    if problem.kind == Kind::AmbiguousTask
        && request::is_bare(answer)
        && let Some(request) = completed(request, answer, situation)
    {
        return Answer::Request(request);
    }
    let about = Situation { spoken_of: spoken(problem, situation), ..situation.clone() };
    if problem.kind == Kind::NotFound {
        let told = request::told(answer, &about);
        if !told.is_empty() {
            return Answer::Located(told);
        }
    }
    match request::understand(answer, &about) {
        Ok(understood) if understood.aims.is_empty() => Answer::Located(understood.located),
        Ok(_) => Answer::Request(answer.to_owned()),
        Err(Puzzle::AmbiguousReference { .. } | Puzzle::NotFound { .. })
            if problem.kind != Kind::AmbiguousTask =>
        {
            place(answer, problem, situation)
        }
        Err(_) => match problem.kind {
            // "Where shall I put the plate?" "In the cupboard."
            Kind::AmbiguousTask => {
                completed(request, answer, situation).map_or(Answer::NotUnderstood, Answer::Request)
            }
            Kind::NotFound | Kind::NotReachable | Kind::ActionFailed | Kind::AmbiguousReference => {
                place(answer, problem, situation)
            }
        },
    }
}

/// What the problem is about is what `it` means.
fn spoken(problem: &Problem, situation: &Situation<'_>) -> Vec<SmolStr> {
    situation.spoken_of.iter().cloned().chain(problem.about.clone()).collect()
}

/// `the cupboard`, `kitchen counter`: a place, asked for where a thing is.
fn place(answer: &str, problem: &Problem, situation: &Situation<'_>) -> Answer {
    let (Some(thing), Kind::NotFound) = (&problem.about, problem.kind) else { return Answer::NotUnderstood };
    let Some(place) = request::pick(answer, &problem.options, situation) else {
        return Answer::NotUnderstood;
    };
    let holds = situation.scene.entities.get(&place).is_some_and(|entity| entity.kind == "Container");
    let relation = if holds { "in" } else { "on" };
    Answer::Located(vec![Located { thing: thing.clone(), relation, place }])
}

/// The request with what was missing behind it, where it then is understood.
fn completed(request: &str, answer: &str, situation: &Situation<'_>) -> Option<String> {
    let request = request.trim_end_matches(['.', '!', '?', ' ']);
    let mut tries = vec![format!("{request} {answer}")];
    for preposition in ["in", "on", "to"] {
        tries.push(format!("{request} {preposition} {answer}"));
        tries.push(format!("{request} {preposition} the {answer}"));
    }
    tries.into_iter().find(|request| request::understand(request, situation).is_ok())
}

/// What a question offers to do: "Shall I bring you something to drink?" is "bring me something to drink".
fn offered(question: &str) -> Option<String> {
    let offer = question.strip_prefix("Shall I ")?.strip_suffix('?')?;
    Some(offer.replace(" you ", " me "))
}

fn bare(answer: &str) -> String {
    let letters = answer
        .to_lowercase()
        .replace('\u{2019}', "'")
        .replace("that's", "that is")
        .replace("don't", "do not");
    let words: Vec<&str> =
        letters.split(|letter: char| !letter.is_alphanumeric()).filter(|word| !word.is_empty()).collect();
    words.join(" ")
}

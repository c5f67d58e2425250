//! Meaning of an answer to a question, for the task at hand.

use motet_requests::token::{self, Token};
use motet_requests::{ReportedLocation, RequestContext, RequestError};
use smol_str::SmolStr;

use super::problem::{Kind, Problem, called};

/// Meaning of an answer.
#[derive(Clone, PartialEq, Debug)]
pub enum Answer {
    Again,
    GiveUp,
    /// A choice: the words of the question, and the entities that they mean.
    Means {
        said: String,
        /// Ids of the chosen entities.
        ids: Vec<SmolStr>,
    },
    /// Locations of objects that are elsewhere than believed.
    ReportedLocation(Vec<ReportedLocation>),
    Request(String),
    /// Nothing useful: the question is asked again.
    NotUnderstood,
}

/// Reads an answer to a problem with a request.
pub(super) fn read(answer: &str, problem: &Problem, request: &str, situation: &RequestContext<'_>) -> Answer {
    let meaning = |said: &str| {
        if is_done(said) { Answer::NotUnderstood } else { meaning(said, problem, request, situation) }
    };
    let retries = matches!(problem.kind, Kind::NotFound | Kind::NotReachable | Kind::ActionFailed);
    let about = RequestContext { spoken_of: spoken(problem, situation), ..situation.clone() };
    if retries
        && motet_requests::encourages(answer)
            .is_some_and(|beside| motet_requests::named(&beside, situation).is_empty())
        && motet_requests::told(answer, &about).is_empty()
    {
        return Answer::Again;
    }
    match polarity(answer) {
        Polarity::Stop => Answer::GiveUp,
        // Who says no, and more that is not understood, still said no.
        Polarity::No(rest) => match meaning(rest) {
            Answer::NotUnderstood => Answer::GiveUp,
            instead => instead,
        },
        Polarity::Yes(rest) if is_done(rest) => match problem.kind {
            // "Shall I bring you something to drink?" "Yes."
            Kind::AmbiguousTask => offered(&problem.question).map_or(Answer::NotUnderstood, Answer::Request),
            Kind::NotFound | Kind::NotReachable | Kind::ActionFailed => Answer::Again,
            Kind::AmbiguousReference => Answer::NotUnderstood,
        },
        Polarity::Yes(rest) => meaning(rest),
        // Where nobody knows more, looking once more is all that is left.
        Polarity::Ignorant if problem.kind == Kind::NotFound => Answer::Again,
        Polarity::Ignorant => Answer::NotUnderstood,
        Polarity::Neither => meaning(answer),
    }
}

/// Reads the words after yes or no.
fn meaning(answer: &str, problem: &Problem, request: &str, situation: &RequestContext<'_>) -> Answer {
    // A thing or a place among those that were offered, or any that fits the words in question.
    if let Some(said) = &problem.said
        && problem.kind != Kind::AmbiguousTask
    {
        let ids = match problem.kind {
            Kind::AmbiguousReference => motet_requests::choose(answer, &problem.options, situation),
            _ => motet_requests::pick(answer, &problem.options, situation).into_iter().collect(),
        };
        if !ids.is_empty() {
            return Answer::Means { said: said.clone(), ids };
        }
    }
    if problem.kind == Kind::AmbiguousTask
        && motet_requests::is_bare(answer)
        && let Some(request) = completed(request, answer, situation)
    {
        return Answer::Request(request);
    }
    // "Where else shall I put the plate?" "On the counter."
    if problem.kind == Kind::NotReachable
        && motet_requests::is_bare(answer)
        && let Some(held) = &situation.holding
        && problem.options.iter().any(|option| situation.scene.entities.contains_key(option))
        && let Some(request) =
            completed(&format!("put the {}", called(situation.scene, held)), answer, situation)
    {
        return Answer::Request(format!("{} instead", request.trim_end_matches(['.', '!', '?', ' '])));
    }
    let about = RequestContext { spoken_of: spoken(problem, situation), ..situation.clone() };
    if problem.kind == Kind::NotFound {
        let told = motet_requests::told(answer, &about);
        if !told.is_empty() {
            return Answer::ReportedLocation(told);
        }
    }
    match motet_requests::understand(answer, &about) {
        Ok(understood) if understood.aims.is_empty() => Answer::ReportedLocation(understood.located),
        Ok(_) => Answer::Request(answer.to_owned()),
        Err(RequestError::AmbiguousReference { .. } | RequestError::NotFound { .. })
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

/// Names of the problem's subject, as antecedents of `it`.
fn spoken(problem: &Problem, situation: &RequestContext<'_>) -> Vec<SmolStr> {
    situation.spoken_of.iter().cloned().chain(problem.about.clone()).collect()
}

/// Reads a bare place, such as `the cupboard`, as the answer to a question for an object's location.
fn place(answer: &str, problem: &Problem, situation: &RequestContext<'_>) -> Answer {
    let (Some(thing), Kind::NotFound) = (&problem.about, problem.kind) else { return Answer::NotUnderstood };
    let Some(place) = motet_requests::pick(answer, &problem.options, situation) else {
        return Answer::NotUnderstood;
    };
    let holds = situation.scene.entities.get(&place).is_some_and(|entity| entity.kind == "Container");
    let relation = if holds { "in" } else { "on" };
    Answer::ReportedLocation(vec![ReportedLocation { thing: thing.clone(), relation, place }])
}

/// The request completed by the answer, if it is then understood.
fn completed(request: &str, answer: &str, situation: &RequestContext<'_>) -> Option<String> {
    let request = request.trim_end_matches(['.', '!', '?', ' ']);
    let mut tries = vec![format!("{request} {answer}")];
    for preposition in ["in", "on", "to"] {
        tries.push(format!("{request} {preposition} {answer}"));
        tries.push(format!("{request} {preposition} the {answer}"));
    }
    tries.into_iter().find(|request| motet_requests::understand(request, situation).is_ok())
}

/// Request that a question offers: "Shall I bring you something to drink?" is "bring me something to drink".
fn offered(question: &str) -> Option<String> {
    let offer = question.strip_prefix("Shall I ")?.strip_suffix('?')?;
    Some(offer.replace(" you ", " me "))
}

/// Polarity of the first words of an answer, with the remaining words.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Polarity<'a> {
    /// Yes; the remaining words may say more.
    Yes(&'a str),
    /// No; the remaining words may name an alternative.
    No(&'a str),
    /// A refusal that ends the request, whatever follows: "don't try again", "stop, that is dangerous".
    Stop,
    /// The person does not know.
    Ignorant,
    /// None of the other polarities.
    Neither,
}

/// Words that agree.
const YES: &[&str] = &[
    "yes",
    "yeah",
    "yep",
    "yup",
    "sure",
    "of course",
    "absolutely",
    "definitely",
    "by all means",
    "sure thing",
    "go for it",
    "certainly",
    "ok",
    "okay",
    "alright",
    "all right",
    "please do",
    "do it",
    "do that",
    "go on",
    "go ahead",
    "carry on",
    "continue",
    "again",
    "retry",
    "try again",
    "try it again",
    "try once more",
    "once more",
    "one more time",
];
/// Words that decline an offer.
const NO: &[&str] = &[
    "no",
    "nope",
    "nah",
    "never mind",
    "nevermind",
    "forget it",
    "forget about it",
    "forget that",
    "no thanks",
    "no thank you",
];
/// Words that end the request.
const STOP: &[&str] = &[
    "stop",
    "halt",
    "cancel",
    "abort",
    "quit",
    "enough",
    "that is enough",
    "that is fine",
    "do not",
    "not now",
    "not again",
    "no more",
    "no way",
    "leave it",
    "leave that",
    "leave them",
    "give up",
    "skip it",
    "skip that",
    "neither",
    "none",
];
/// Words that end the request only if nothing else is said.
const STOP_ALONE: &[&str] = &[
    "nothing",
    "nothing at all",
    "nobody",
    "leave",
    "skip",
    "i'll do it myself",
    "i will do it myself",
    "i'll do it",
    "i will do it",
];
/// Phrases that ask a moving robot to hold still.
const HOLD: &[&str] = &["wait", "hold on", "hold it", "freeze", "pause", "careful", "watch out", "look out"];
/// Words for ignorance.
const IGNORANT: &[&str] = &[
    "no idea",
    "no clue",
    "not sure",
    "i am not sure",
    "do not know",
    "i do not know",
    "i have no idea",
    "who knows",
];
/// Courtesy words without a meaning of their own.
const COURTESY: &[&str] =
    &["please", "thanks", "thank you", "oh", "well", "hm", "hmm", "then", "so", "just", "actually"];
/// Openings of a polite request to stop: "could you stop that".
const ASKING: &[&str] = &[
    "would you",
    "could you",
    "can you",
    "will you",
    "you can",
    "you may",
    "you could",
    "you should",
    "you must",
    "you would better",
    "you had better",
    "go ahead and",
    "i want you to",
    "i would like you to",
];
/// Words that begin a place after `stop` and `leave it`: "stop at the table".
const PLACES: &[&str] = &["at", "by", "in", "on", "near", "next", "beside", "behind", "with", "under"];

/// Reads the polarity of the first words.
pub(super) fn polarity(said: &str) -> Polarity<'_> {
    let rest = skip_all(said, COURTESY);
    if let Some(left) = skip(rest, IGNORANT) {
        return if is_done(left) { Polarity::Ignorant } else { Polarity::Neither };
    }
    let asked = skip_all(skip_all(rest, ASKING), COURTESY);
    if skip(asked, STOP).is_some_and(|left| !begins_place(left)) {
        return Polarity::Stop;
    }
    if skip(rest, STOP_ALONE).is_some_and(|left| is_done(skip_all(left, COURTESY))) {
        return Polarity::Stop;
    }
    if let Some(mut left) = skip(rest, NO) {
        left = skip_all(skip_all(left, NO), COURTESY);
        return if skip(left, STOP).is_some() { Polarity::Stop } else { Polarity::No(left) };
    }
    if let Some(left) = skip(rest, YES) {
        return Polarity::Yes(skip_all(skip_all(skip_all(left, COURTESY), YES), COURTESY));
    }
    // A bare "please" agrees.
    if is_done(rest) && !is_done(said) && skip(said, &["please"]).is_some() {
        return Polarity::Yes(rest);
    }
    Polarity::Neither
}

/// Returns `true` if the words ask a moving robot to stop.
pub(super) fn stops(said: &str) -> bool {
    let rest = skip_all(said, COURTESY);
    skip(rest, HOLD).is_some_and(|left| !begins_place(left))
        || match polarity(said) {
            Polarity::Stop => true,
            Polarity::No(left) => is_done(left),
            Polarity::Yes(_) | Polarity::Ignorant | Polarity::Neither => false,
        }
}

/// Request inside an addition: "also bring me the apple".
pub(super) fn added(said: &str) -> Option<&str> {
    let rest = skip(said, &["also", "and also", "and then", "after that", "afterwards", "then", "and"])?;
    let rest = rest.trim_start_matches([',', ' ']);
    (!rest.is_empty()).then_some(rest)
}

fn begins_place(said: &str) -> bool {
    words(said).next().is_some_and(|(word, _)| PLACES.contains(&word.as_str()))
}

/// Returns `true` if no word is left to read.
pub(super) fn is_done(said: &str) -> bool {
    words(said).next().is_none()
}

/// Strips the longest matching phrase from the beginning.
fn skip<'a>(said: &'a str, phrases: &[&str]) -> Option<&'a str> {
    let behind = |phrase: &&str| {
        let mut said_words = words(said);
        let mut end = 0;
        for wanted in phrase.split(' ') {
            let (word, at) = said_words.next()?;
            if word != wanted {
                return None;
            }
            end = at;
        }
        Some(end)
    };
    phrases.iter().filter_map(behind).max().and_then(|end| said.get(end..))
}

/// Strips matching phrases repeatedly.
fn skip_all<'a>(mut said: &'a str, phrases: &[&str]) -> &'a str {
    while let Some(left) = skip(said, phrases) {
        said = left;
    }
    said
}

/// Words of a text, each with the offset of its end.
fn words(said: &str) -> impl Iterator<Item = (String, usize)> {
    token::pieces(said).into_iter().filter_map(|(token, end)| match token {
        Token::Word(word) => Some((word, end)),
        Token::Comma | Token::Stop => None,
    })
}

#[cfg(test)]
mod tests {
    use super::Polarity;
    use super::added;
    use super::polarity;
    use super::stops;

    #[test]
    fn the_first_words_tell() {
        for said in [
            "No, leave it alone!",
            "please don't",
            "no, don't",
            "no, that's enough",
            "Don’t try again",
            "stop it",
            "not now",
            "stop, that is dangerous!",
            "nothing, thanks",
            "leave it",
            "I'll do it myself",
            "would you stop that",
            "you can stop now, please",
            "go ahead and cancel it",
        ] {
            assert_eq!(polarity(said), Polarity::Stop, "{said}");
        }
        for (said, rest) in [
            ("nope", ""),
            ("no no", ""),
            ("nah, thanks", ""),
            ("no, the blue one", ", the blue one"),
            ("forget it, bring me the apple", ", bring me the apple"),
        ] {
            assert_eq!(polarity(said), Polarity::No(rest), "{said}");
        }
        for (said, rest) in [
            ("Yes.", "."),
            ("please", ""),
            ("ok, try again please", ""),
            ("sure, it is in the cupboard", ", it is in the cupboard"),
        ] {
            assert_eq!(polarity(said), Polarity::Yes(rest), "{said}");
        }
        assert_eq!(polarity("no idea"), Polarity::Ignorant);
        for said in [
            "no idea, I am sitting at the table",
            "wait a moment",
            "what?",
            "stop at the table",
            "would you stop by the table",
            "you can leave it on the table",
            "please bring me the cup",
        ] {
            assert_eq!(polarity(said), Polarity::Neither, "{said}");
        }
    }

    #[test]
    fn who_moves_is_told_to_stop() {
        for said in
            ["stop", "Wait!", "never mind", "cancel that", "hold on a second", "no!", "leave it, please"]
        {
            assert!(stops(said), "{said}");
        }
        for said in ["go on", "wait at the table", "bring me the apple", "no, the blue one", "thanks"] {
            assert!(!stops(said), "{said}");
        }
        assert_eq!(added("also bring me the apple"), Some("bring me the apple"));
        assert_eq!(added("android"), None);
    }
}

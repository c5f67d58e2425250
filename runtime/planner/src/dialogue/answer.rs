//! Meaning of an answer to a question, for the task at hand.

use motet_requests::{
    Aim, PendingQuestion, Polarity, ReportedLocation, RequestContext, RequestError, is_wordless, polarity,
};
use motet_robots::scene::Entity;
use motet_stdlib::lang::{entities, fluents, kinds};
use smol_str::SmolStr;

use super::problem::{Kind, Problem, holders};

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
    /// Another direction to look in: the robot turns by this angle, in degrees to the left, and looks again.
    Look {
        degrees: i32,
    },
    /// Nothing useful: the question is asked again.
    NotUnderstood,
}

/// Reads an answer to a problem with a request.
pub(super) fn read(answer: &str, problem: &Problem, request: &str, situation: &RequestContext<'_>) -> Answer {
    let meaning = |said: &str| {
        if is_wordless(said) { Answer::NotUnderstood } else { meaning(said, problem, request, situation) }
    };
    let retries = matches!(problem.kind, Kind::NotFound | Kind::NotReachable | Kind::ActionFailed);
    let about = RequestContext { spoken_of: spoken(problem, situation), ..situation.clone() };
    if retries
        && motet_requests::encourages(answer)
            .is_some_and(|beside| motet_requests::named(&beside, situation).is_empty())
        && motet_requests::told(answer, asked(problem), &about).is_empty()
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
        Polarity::Yes(rest) if is_wordless(rest) => match problem.kind {
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
            completed(&format!("put the {}", situation.scene.called(held)), answer, situation)
    {
        return Answer::Request(format!("{} instead", request.trim_end_matches(['.', '!', '?', ' '])));
    }
    let about = RequestContext { spoken_of: spoken(problem, situation), ..situation.clone() };
    let understood = motet_requests::understand(answer, &about);
    // `take it from the table` tells where it is, `put it on the table` asks for something.
    let takes = |aim: &Aim| {
        let places = problem.about.as_ref().is_some_and(|thing| aim.places(thing));
        places && !aim.mentions(entities::USER)
    };
    let asks = understood.as_ref().is_ok_and(|understood| understood.aims.iter().any(takes));
    if problem.kind == Kind::NotFound || is_of_object(problem, situation) {
        let told = motet_requests::told(answer, asked(problem), &about);
        if !told.is_empty() && (problem.kind == Kind::NotFound || !asks) {
            return Answer::ReportedLocation(told);
        }
        if let Some(degrees) = motet_requests::turn(answer) {
            return Answer::Look { degrees };
        }
    }
    match understood {
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

/// True if a problem is that an object is missing, out of reach or not taken, so that a place is an answer.
fn is_of_object(problem: &Problem, situation: &RequestContext<'_>) -> bool {
    let about = problem.about.as_ref().and_then(|id| situation.scene.entities.get(id));
    matches!(problem.kind, Kind::NotFound | Kind::NotReachable | Kind::ActionFailed)
        && about.is_some_and(|entity| entity.kind == kinds::OBJECT)
}

/// Meaning of the question behind a problem.
fn asked(problem: &Problem) -> PendingQuestion {
    if problem.kind == Kind::NotFound { PendingQuestion::Where } else { PendingQuestion::What }
}

/// Names of the problem's subject, as antecedents of `it`.
fn spoken(problem: &Problem, situation: &RequestContext<'_>) -> Vec<SmolStr> {
    situation.spoken_of.iter().cloned().chain(problem.about.clone()).collect()
}

/// Reads a bare place, such as `the cupboard`, as the answer to a question for an object's location.
fn place(answer: &str, problem: &Problem, situation: &RequestContext<'_>) -> Answer {
    let Some(thing) = problem.about.as_ref().filter(|_| is_of_object(problem, situation)) else {
        return Answer::NotUnderstood;
    };
    let options = holders(situation.scene);
    let Some(place) = motet_requests::pick(answer, &options, situation) else {
        return Answer::NotUnderstood;
    };
    let relation = situation.scene.entities.get(&place).map_or(fluents::ON, Entity::relation);
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

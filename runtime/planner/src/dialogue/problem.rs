//! Obstacles to a request, by the kinds of InteLiPlan's table of failures, and the one question that each
//! leads to.

use motet_graph::{Graph, NodeKind, Term, Value};
use motet_robots::scene::Scene;
use motet_runtime::{MissingPrimitive, RunEnd};
use motet_stdlib::lang::{ASKING, failures, kinds, primitives};
use motet_syntax::render::capital;
use serde::{Deserialize, Serialize};
use smol_str::SmolStr;

use super::reason::{self, Reason};
use crate::builtin::PlanError;
use motet_requests::{RequestContext, RequestError};

/// The kinds of failure.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// The requested thing is missing, or not where it was believed to be.
    NotFound,
    /// No motion leads there, or something is in the way.
    NotReachable,
    /// Several objects have the name.
    AmbiguousReference,
    /// The request does not say what to do.
    AmbiguousTask,
    /// A step was tried and did not work.
    ActionFailed,
}

/// A problem with its question.
#[derive(Clone, PartialEq, Debug)]
pub struct Problem {
    pub kind: Kind,
    /// Description of the problem, and a question about the next step.
    pub question: String,
    /// Possible answers; empty if any answer is possible.
    pub options: Vec<SmolStr>,
    /// Subject of the problem.
    pub about: Option<SmolStr>,
    /// Subject in the person's words, if the words are the problem.
    pub said: Option<String>,
}

impl Kind {
    /// Name in records and tables.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::NotFound => "not_found",
            Self::NotReachable => "not_reachable",
            Self::AmbiguousReference => "ambiguous_reference",
            Self::AmbiguousTask => "ambiguous_task",
            Self::ActionFailed => "action_failed",
        }
    }
}

impl Problem {
    /// Problem behind a request that got no policy.
    #[must_use]
    pub fn of_planning(why: &PlanError, scene: &Scene) -> Self {
        let bare =
            |kind, question: String| Self { kind, question, options: Vec::new(), about: None, said: None };
        match why {
            PlanError::RequestError(RequestError::NotUnderstood { part }) => Self {
                said: Some(part.clone()),
                ..bare(Kind::AmbiguousTask, format!("I do not understand \"{part}\". What shall I do?"))
            },
            PlanError::RequestError(RequestError::NotFound { what }) => Self {
                said: Some(what.clone()),
                ..bare(Kind::NotFound, format!("I know of no {} here. What do you mean?", bare_noun(what)))
            },
            PlanError::RequestError(RequestError::Unfit { why }) => {
                bare(Kind::AmbiguousTask, format!("{}. What shall I do?", capital(why)))
            }
            PlanError::RequestError(RequestError::Elsewhere { why, thing }) => Self {
                options: holders(scene),
                about: Some(thing.clone()),
                ..bare(Kind::NotFound, format!("{}. Where shall I look for it?", capital(why)))
            },
            PlanError::RequestError(RequestError::AmbiguousReference { what, options }) => {
                let seen: Vec<_> = options.iter().map(|id| described(scene, id)).collect();
                let noun = bare_noun(what);
                let question = format!(
                    "I know {} that could be the {noun}: {}. Which one?",
                    number(options.len()),
                    join(&seen)
                );
                Self {
                    options: options.clone(),
                    said: Some(what.clone()),
                    ..bare(Kind::AmbiguousReference, question)
                }
            }
            PlanError::RequestError(RequestError::AmbiguousTask { question, options }) => {
                Self { options: options.clone(), ..bare(Kind::AmbiguousTask, question.clone()) }
            }
            PlanError::Doubtful { diagnostics, .. } => {
                let doubt = diagnostics.first().map_or("the plan is in doubt", |said| said.message.as_str());
                let options = vec!["yes".into(), "no".into()];
                let question = format!("I am not sure of my plan: {doubt}. Shall I carry it out?");
                Self { options, ..bare(Kind::NotReachable, question) }
            }
            PlanError::Said { words } if words.contains('?') => bare(Kind::AmbiguousTask, words.clone()),
            PlanError::Said { words } => {
                let stop = if words.ends_with(['.', '!']) { "" } else { "." };
                bare(Kind::NotReachable, format!("{words}{stop} What shall I do instead?"))
            }
            PlanError::NoModel { .. } | PlanError::Stopped => bare(Kind::ActionFailed, why.to_string()),
            PlanError::NoPlan(why) => Self::unplanned(reason::no_plan(why, scene)),
            PlanError::Refused { diagnostics, .. } => Self::unplanned(reason::refused(diagnostics, scene)),
        }
    }

    /// Problem of a policy that calls primitives that the driver does not have.
    pub(super) fn lacking(missing: &[MissingPrimitive]) -> Self {
        let names: Vec<String> = missing.iter().map(|one| format!("`{}`", one.name)).collect();
        let says = format!("the driver of the robot does not have {}", join(&names));
        Self::unplanned(Reason { about: None, says })
    }

    /// Problem of a request that no plan carries out, for a reason.
    fn unplanned(Reason { about, says }: Reason) -> Self {
        let question = format!("{}. What shall I do instead?", capital(&says));
        Self { kind: Kind::NotReachable, question, options: Vec::new(), about, said: None }
    }

    /// Problem behind the ending of a run, named with its bindings. `None` if the run is done or declined, or
    /// if a person stopped it.
    #[must_use]
    pub fn of_run(
        end: &RunEnd,
        (graph, bound): (&Graph, &[(SmolStr, Value)]),
        scene: &Scene,
    ) -> Option<Self> {
        match end {
            RunEnd::Done { .. } | RunEnd::Declined { .. } | RunEnd::Interrupted => None,
            RunEnd::Failed { kind, why, node } => {
                Some(failed((kind, why.as_deref()), *node, (graph, bound), scene))
            }
            RunEnd::Replan { why } => Some(Self {
                kind: Kind::ActionFailed,
                question: format!(
                    "I had to stop: {}. Shall I try again?",
                    why.as_deref().unwrap_or("the plan no longer fits")
                ),
                options: vec!["yes".into(), "no".into()],
                about: None,
                said: None,
            }),
            RunEnd::Fault(fault) => Some(Self {
                kind: Kind::ActionFailed,
                question: format!("I could not go on: {fault}. Shall I try again?"),
                options: vec!["yes".into(), "no".into()],
                about: None,
                said: None,
            }),
        }
    }
}

fn failed(
    (kind, why): (&str, Option<&str>),
    node: motet_graph::NodeId,
    (graph, bound): (&Graph, &[(SmolStr, Value)]),
    scene: &Scene,
) -> Problem {
    let call = graph.nodes.get(node.index()).and_then(|node| match &node.kind {
        NodeKind::Call(call) => Some(call),
        _ => None,
    });
    let primitive = call.and_then(|call| graph.primitives.get(call.primitive.index()));
    let args = || call.into_iter().flat_map(|call| &call.args);
    let entity = |arg: &Term| named_entity(graph, bound, arg);
    // What cannot be got at is where the step leads last: of what is put somewhere the place, since the
    // thing is in the hand.
    let about = match (kind, args().next()) {
        (failures::UNREACHABLE | failures::BLOCKED, _) => args().filter_map(entity).next_back(),
        // Who looks for a thing by words names it first.
        (_, Some(Term::Literal(Value::Text(text)))) => Some(described_object(scene, text)),
        (_, _) => args().find_map(entity),
    };
    let words = args().find_map(|arg| match arg {
        Term::Literal(Value::Text(text)) => Some(text.as_str()),
        _ => None,
    });
    let thing = about.as_ref().map_or_else(|| "the thing I need".to_owned(), |id| reason::named(scene, id));
    let name = primitive.map_or("do", |primitive| primitive.name.as_str());
    // A thing is put onto its place, whatever the failure is about.
    let onto = (name == primitives::PLACE).then(|| args().filter_map(entity).next_back()).flatten();
    let doing = reason::action(scene, name, onto.as_ref().or(about.as_ref()));
    let why = why.map(|why| reason::in_words(why, scene));
    let (kind, question, options): (Kind, String, Vec<SmolStr>) = match kind {
        failures::NOT_FOUND => (
            Kind::NotFound,
            format!("I cannot find {thing}{}. Where is it?", believed(scene, about.as_ref())),
            holders(scene),
        ),
        failures::AMBIGUOUS => (
            Kind::AmbiguousReference,
            format!("More than one thing could be {thing}. Which one?"),
            Vec::new(),
        ),
        failures::BLOCKED if primitive.is_some_and(|primitive| primitive.name == primitives::PLACE) => {
            let held = args().find_map(entity).filter(|held| Some(held) != about.as_ref());
            let held = held.map_or_else(|| "it".to_owned(), |id| format!("the {}", scene.called(&id)));
            let others = holders(scene).into_iter().filter(|id| Some(id) != about.as_ref()).collect();
            let question = format!(
                "I find no room on {thing} from where I can reach it. Where else shall I put {held}?"
            );
            (Kind::NotReachable, question, others)
        }
        failures::UNREACHABLE | failures::BLOCKED => (
            Kind::NotReachable,
            format!("I cannot {doing}: {}. What shall I do?", why.unwrap_or_else(|| no_way(kind).to_owned())),
            vec!["try again".into(), "leave it".into()],
        ),
        failures::REFUSED if name == primitives::HANDOVER => {
            let held =
                args().find_map(entity).map_or_else(|| "it".to_owned(), |id| reason::named(scene, &id));
            let whom = args().filter_map(entity).next_back();
            let who = whom.map_or_else(|| "nobody".to_owned(), |id| reason::named(scene, &id));
            let who = capital(&who);
            (
                Kind::ActionFailed,
                format!("{who} did not take {held}. Shall I offer it again?"),
                vec!["yes".into(), "no".into()],
            )
        }
        failures::TOO_HEAVY => (
            Kind::NotReachable,
            format!("I cannot lift {thing}, it is too heavy. What shall I do?"),
            vec!["leave it".into()],
        ),
        failures::REFUSED if primitive.is_some_and(|primitive| ASKING.contains(&primitive.name.as_str())) => {
            (
                Kind::ActionFailed,
                match words {
                    Some(words) => format!("Nobody answered \"{words}\". Shall I ask again?"),
                    None => "Nobody answered my question. Shall I ask again?".to_owned(),
                },
                vec!["yes".into(), "no".into()],
            )
        }
        _ => (
            Kind::ActionFailed,
            format!("I could not {doing}: {}. Shall I try again?", why.unwrap_or_else(|| happened(kind))),
            vec!["yes".into(), "no".into()],
        ),
    };
    Problem { kind, question, options, about, said: None }
}

/// The one object that a description fits, else the description.
fn described_object(scene: &Scene, text: &str) -> SmolStr {
    let named = motet_requests::named(text, &RequestContext::new(scene)).into_iter();
    let is_object = |id: &SmolStr| scene.entities.get(id).is_some_and(|one| one.kind == kinds::OBJECT);
    let objects: Vec<SmolStr> = named.filter(is_object).collect();
    <[SmolStr; 1]>::try_from(objects).map_or_else(|_| text.into(), |[only]| only)
}

/// Words for a motion that ended early.
fn no_way(kind: &str) -> &'static str {
    if kind == failures::BLOCKED { "something is in the way" } else { "I find no way" }
}

/// Words for another failure.
fn happened(kind: &str) -> String {
    match kind {
        failures::SLIPPED => "it slipped out of my hand".to_owned(),
        failures::REFUSED => "it was refused".to_owned(),
        other => other.replace('_', " "),
    }
}

/// Surfaces and containers that can hold a thing.
pub(super) fn holders(scene: &Scene) -> Vec<SmolStr> {
    let holds = scene
        .entities
        .values()
        .filter(|entity| matches!(entity.kind.as_str(), kinds::SURFACE | kinds::CONTAINER));
    holds.map(|entity| entity.id.clone()).collect()
}

/// Believed place of an object in words, such as ` on the counter`.
fn believed(scene: &Scene, id: Option<&SmolStr>) -> String {
    let entity = id.and_then(|id| scene.entities.get(id));
    match entity.map(|entity| (&entity.on, &entity.inside)) {
        Some((Some(support), _)) => format!(" on the {}", scene.called(support)),
        Some((None, Some(container))) => format!(" in the {}", scene.called(container)),
        Some((None, None)) | None => String::new(),
    }
}

/// Name with article and place, such as `the red mug on the table`.
fn described(scene: &Scene, id: &SmolStr) -> String {
    format!("the {}{}", scene.called(id), believed(scene, Some(id)))
}

/// Noun of a phrase, without its article.
pub(super) fn bare_noun(said: &str) -> &str {
    let articles = ["the ", "a ", "an ", "some ", "my ", "that ", "this "];
    articles.iter().find_map(|article| said.strip_prefix(article)).unwrap_or(said)
}

fn number(count: usize) -> String {
    match count {
        2 => "two things".to_owned(),
        3 => "three things".to_owned(),
        more => format!("{more} things"),
    }
}

pub(super) fn join(parts: &[String]) -> String {
    match parts {
        [] => String::new(),
        [only] => only.clone(),
        [rest @ .., last] => format!("{} and {last}", rest.join(", ")),
    }
}

impl Problem {
    /// The request made in between is done; the earlier request may not be.
    pub(super) fn half_done(before: &str) -> Self {
        Self::whether(format!("That is done. Shall I go on with \"{before}\"?"))
    }

    /// Words spoken in between could not be read.
    pub(super) fn interrupted(said: &str, before: &str) -> Self {
        Self::whether(format!(
            "I do not understand \"{said}\", so I have stopped. Shall I go on with \"{before}\"?"
        ))
    }

    fn whether(question: String) -> Self {
        let options = vec!["yes".into(), "no".into()];
        Self { kind: Kind::AmbiguousTask, question, options, about: None, said: None }
    }

    /// Problem that no answer solves.
    pub(super) fn nothing(what: &str) -> Self {
        Self {
            kind: Kind::ActionFailed,
            question: what.to_owned(),
            options: Vec::new(),
            about: None,
            said: None,
        }
    }
}

/// Entity of an argument, given by itself or by a binding.
pub(super) fn named_entity(graph: &Graph, bound: &[(SmolStr, Value)], arg: &Term) -> Option<SmolStr> {
    let value = match arg {
        Term::Literal(value) => value,
        Term::Binding(id) => {
            let name = &graph.bindings.get(id.index())?.name;
            bound.iter().find(|(known, _)| known == name).map(|(_, value)| value)?
        }
        _ => return None,
    };
    match value {
        Value::Entity(id) => Some(id.clone()),
        _ => None,
    }
}

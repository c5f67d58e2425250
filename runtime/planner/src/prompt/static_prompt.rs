//! Parts of a prompt about the robot alone, and two example requests with their policies: built once for all
//! prompts of one robot in one room.

use motet_compiler::{Session, settle};
use motet_robots::card::Robot;
use motet_robots::scene::Scene;
use motet_syntax::ast::{Clause, File, Item, PrimitiveDecl};
use motet_syntax::{Syntax, print};

use crate::builtin;
use motet_requests::RequestContext;

/// The parts of a prompt that do not change.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct StaticPrompt {
    /// Rules of writing a policy.
    pub(super) rules: String,
    /// The robot's primitives with what they need and make.
    pub(super) contracts: String,
    /// The same without.
    pub(super) signatures: String,
    /// Requests with the policies for them, two at most.
    pub(super) examples: Vec<String>,
}

impl StaticPrompt {
    /// Writes them; the examples are planned in the session.
    #[must_use]
    pub fn new(session: &Session, robot: &Robot, scene: &Scene) -> Self {
        Self {
            rules: rules(robot),
            contracts: primitives(session, Detail::Contracts),
            signatures: primitives(session, Detail::Signatures),
            examples: examples(session, robot, scene),
        }
    }
}

fn rules(robot: &Robot) -> String {
    format!(
        "You plan for a robot, {} (`{}`). Answer with one policy for it and nothing else, as JSON:\n\
         {{\"motet\": 1, \"policy\": NAME, \"robot\": \"{}\", \"steps\": [STEP, …]}}\n\
         A STEP runs a primitive: {{\"do\": NAME, PARAMETER: VALUE, …}}, with \"as\": NAME where its result is used \
         later, as \"$NAME\". Other steps: {{\"if\": C, \"then\": […], \"else\": […]}}, \
         {{\"try\": […], \"catch\": [{{\"on\": [FAILURE], \"steps\": […]}}]}}, \
         {{\"monitor\": [{{\"when\": C, \"then\": {{\"react\": \"pause\"}}}}], \"during\": […]}}, \
         {{\"end\": \"done\"}}, {{\"end\": \"replan\", \"why\": TEXT}}. A condition C is a text such as \
         \"holding(mug_1)\" or \"distance(user) < 0.5 m\". Name things by their ids. Where it is not clear what is \
         meant, ask: {{\"do\": \"ask\", \"question\": TEXT, \"as\": \"answer\"}}, then \
         {{\"end\": \"replan\", \"why\": \"$answer\"}}.\n",
        robot.title, robot.name, robot.name
    )
}

fn primitives(session: &Session, detail: Detail) -> String {
    let items = session.library().signatures().map(|decl| Item::Primitive(short(decl, detail)));
    format!("# Primitives\n{}", print::text(&File { items: items.collect() }))
}

/// Two requests of this room with the policies for them.
fn examples(session: &Session, robot: &Robot, scene: &Scene) -> Vec<String> {
    let mut objects = scene.entities.values().filter(|entity| entity.kind == "Object");
    let container = scene.entities.values().find(|entity| entity.kind == "Container");
    let mut requests = Vec::new();
    if let Some(object) = objects.next() {
        requests.push(format!("bring me the {}", motet_requests::called(object)));
    }
    if let (Some(object), Some(container)) = (objects.next(), container) {
        requests.push(format!(
            "put the {} in the {}",
            motet_requests::called(object),
            motet_requests::called(container)
        ));
    }
    let start = RequestContext::new(scene);
    let written = requests.iter().filter_map(|request| {
        let answered = builtin::answer(session, Some(robot), request, &start).ok()?;
        let mut policy = answered.planned.parsed.file.policies().next()?.clone();
        settle(&mut policy, session.library(), Syntax::Json);
        Some(format!("# Example: {request}\n{}\n", one_line(&print::policy_json(&policy))))
    });
    written.collect()
}

/// Amount of detail about a primitive.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Detail {
    /// Signature, first sentence, what it needs, makes and how it fails.
    Contracts,
    /// Signature and first sentence.
    Signatures,
}

fn short(decl: &PrimitiveDecl, detail: Detail) -> PrimitiveDecl {
    let doc = decl.doc.split_inclusive(". ").next().unwrap_or_default().replace('\n', " ");
    let is_kept = |clause: &&Clause| match clause {
        Clause::Needs(_) | Clause::Makes(_) | Clause::Fails(_) => detail == Detail::Contracts,
        Clause::Unsettles(_)
        | Clause::Motion(_)
        | Clause::Uses(_)
        | Clause::Takes { .. }
        | Clause::Lasts(_) => false,
    };
    let clauses = decl.clauses.iter().filter(is_kept).cloned().collect();
    PrimitiveDecl { doc: doc.trim().into(), clauses, ..decl.clone() }
}

/// JSON without line breaks and indents.
fn one_line(json: &str) -> String {
    json.lines().map(str::trim).collect::<Vec<_>>().join(" ")
}

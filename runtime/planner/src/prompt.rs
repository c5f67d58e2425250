//! The prompt: primitives of the robot, the room in words, knowledge, earlier requests, two examples, and
//! the request. The same inputs give the same text within a token budget; only a motion search that takes
//! too long leaves something out.

use std::time::{Duration, Instant};

use motet_compiler::{Access, Session, make_explicit};
use motet_requests::RequestContext;
use motet_robots::card::Robot;
use motet_robots::scene::{Entity, Scene};
use motet_runtime::memory::Memory;
use motet_syntax::ast::{Clause, File, Item, PrimitiveDecl};
use motet_syntax::{Syntax, print};
use smol_str::SmolStr;

use crate::builtin;

/// Bytes of English text and JSON that make about one token of a byte-pair encoding.
const BYTES_PER_TOKEN: usize = 4;
/// Default budget, in tokens.
pub const TOKENS: usize = 6_000;
/// Default time limit for motion searches whose answers are not cached.
pub const TIME: Duration = Duration::from_millis(500);

/// Maximum number of entries of the memory.
const LATEST: usize = 24;

/// Input of a prompt.
#[derive(Clone, Copy, Debug)]
pub struct Prompt<'a> {
    /// Session that checks the policies.
    pub session: &'a Session,
    pub robot: &'a Robot,
    pub scene: &'a Scene,
    /// Context in which the request is read.
    pub situation: &'a RequestContext<'a>,
    /// Earlier requests and their endings.
    pub memory: &'a Memory,
    /// Parts that all prompts of a robot in a room share.
    pub lasting: &'a StaticPrompt,
    /// Maximum number of tokens, estimated from bytes.
    pub tokens: usize,
    /// Time after which no further motion is searched.
    pub time: Duration,
}

/// A prompt, and the names of the sections that did not fit.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Written {
    /// Text of the system message.
    pub system: String,
    /// Text of the user message.
    pub user: String,
    /// Estimated number of tokens of both.
    pub tokens: usize,
    /// Sections that the budget left out.
    pub left_out: Vec<&'static str>,
}

/// Section that may be left out, the least important first.
type Part = (&'static str, String);

impl Prompt<'_> {
    /// Writes the prompt for a request.
    #[must_use]
    pub fn write(&self, request: &str) -> Written {
        let named = motet_requests::named(request, self.situation);
        let room = |entities: &dyn Fn(&SmolStr) -> bool| self.room(entities);
        let examples = &self.lasting.examples;
        let mut parts: Vec<Part> = vec![
            ("what the primitives need and make", self.lasting.contracts.clone()),
            ("the second example", examples.get(1).cloned().unwrap_or_default()),
            ("things that the request does not name", room(&|id| !named.contains(id))),
            ("what was done", self.done()),
            ("the first example", examples.first().cloned().unwrap_or_default()),
        ];
        let mut left_out = Vec::new();
        let fixed = [
            self.lasting.rules.clone(),
            room(&|id| named.contains(id)),
            told(&seen(self.session, self.robot, self.scene, &named, self.time)),
            format!("# Request\n{}\n", request.trim()),
        ];
        let fixed_bytes: usize = fixed.iter().map(String::len).sum();
        let budget = self.tokens.saturating_mul(BYTES_PER_TOKEN);
        let bytes = |parts: &[Part]| fixed_bytes + parts.iter().map(|(_, text)| text.len()).sum::<usize>();
        let mut next = 0;
        while bytes(&parts) > budget && next < parts.len() {
            if let Some((name, text)) = parts.get_mut(next) {
                // Signatures without contracts are still worth their place.
                let shorter = if next == 0 { self.lasting.signatures.clone() } else { String::new() };
                *text = shorter;
                left_out.push(*name);
            }
            next += 1;
        }
        let text = |index: usize| parts.get(index).map(|(_, text)| text.as_str()).unwrap_or_default();
        let [rules, things, seen, asked] = fixed;
        let system = join(&[&rules, text(0), text(4), text(1)]);
        let user = join(&[&things, text(2), &seen, text(3), &asked]);
        let tokens = (system.len() + user.len()).div_ceil(BYTES_PER_TOKEN);
        Written { system, user, tokens, left_out }
    }

    /// The first request, the latest failure, and the latest events.
    fn done(&self) -> String {
        let entries = self.memory.entries();
        let skipped = entries.len().saturating_sub(LATEST).max(1);
        let lines: String = entries.skip(skipped).map(|entry| format!("- {entry}\n")).collect();
        format!("# What was asked and done\n{}{lines}", self.memory.short())
    }

    /// Chosen entities of the scene, one per line.
    fn room(&self, picked: &dyn Fn(&SmolStr) -> bool) -> String {
        let mut text = String::new();
        for entity in self.scene.entities.values().filter(|entity| picked(&entity.id)) {
            let names: Vec<&str> = entity.names.iter().map(SmolStr::as_str).collect();
            let called = if names.is_empty() { entity.class.to_string() } else { names.join(", ") };
            text.push_str(&format!("- {} ({}): {called}", entity.id, entity.kind));
            let now = self.situation.supports.iter().find(|(id, _)| *id == entity.id);
            match now {
                Some((_, Some(support))) => {
                    let holder = self.scene.entities.get(support).map(|holder| holder.kind.as_str());
                    let relation = match holder {
                        Some("Container") => "in",
                        Some("Surface") => "on",
                        Some(_) | None => "at",
                    };
                    text.push_str(&format!("; {relation} {support}"));
                }
                // Only what can be carried is ever nowhere.
                Some((_, None)) if entity.kind == "Object" => text.push_str("; it is not known where"),
                Some((_, None)) | None => {
                    if let Some(support) = &entity.on {
                        text.push_str(&format!("; on {support}"));
                    } else if let Some(container) = &entity.inside {
                        text.push_str(&format!("; in {container}"));
                    }
                }
            }
            for (is, word) in [
                (entity.open, ["open", "closed"]),
                (entity.locked, ["locked", ""]),
                (entity.visible, ["seen", "not seen"]),
            ] {
                let [yes, no] = word;
                match is {
                    Some(true) => text.push_str(&format!("; {yes}")),
                    Some(false) if !no.is_empty() => text.push_str(&format!("; {no}")),
                    Some(false) | None => {}
                }
            }
            text.push('\n');
        }
        if text.is_empty() { text } else { format!("# In the room\n{text}") }
    }
}

fn join(parts: &[&str]) -> String {
    let parts: Vec<&str> = parts.iter().map(|part| part.trim_end()).filter(|part| !part.is_empty()).collect();
    parts.join("\n\n") + "\n"
}

/// Visibility and reachability of one thing.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Sighting {
    pub id: SmolStr,
    /// Visibility to a camera, if the scene states it.
    pub seen: Option<bool>,
    /// Reachability for the robot.
    pub feasible: Reachability,
}

/// Reachability of a thing.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Reachability {
    /// Decided by mass and width; no motion was searched.
    AsFarAsNumbersTell,
    /// A motion was found.
    Yes,
    /// No motion exists, or the hand cannot hold the object; the reason.
    No(String),
    /// A search found no motion and proved nothing; the most frequent obstacle.
    Hardly(String),
    /// Unknown, with the reason.
    Unknown(String),
}

/// Visibility and reachability of the named objects. Motion searches run one after the other until `time` is
/// over; cached answers cost nothing.
#[must_use]
pub fn seen(
    session: &Session,
    robot: &Robot,
    scene: &Scene,
    named: &[SmolStr],
    time: Duration,
) -> Vec<Sighting> {
    let begun = Instant::now();
    let seen = named.iter().filter_map(|id| {
        let entity = scene.entities.get(id)?;
        let left = time.saturating_sub(begun.elapsed());
        Some(Sighting {
            id: id.clone(),
            seen: entity.visible,
            feasible: feasible(session, robot, entity, left),
        })
    });
    seen.collect()
}

fn feasible(session: &Session, robot: &Robot, entity: &Entity, left: Duration) -> Reachability {
    if let Some(hand) = robot.hands.values().next()
        && entity.kind == "Object"
    {
        if let Some(mass) = entity.mass_kg.filter(|mass| *mass > hand.payload_kg) {
            return Reachability::No(format!("too heavy: {mass} kg, payload is {} kg", hand.payload_kg));
        }
        if let Some(width) = entity.width().filter(|width| *width > hand.opening_m) {
            return Reachability::No(format!("too wide: {width} m, opening is {} m", hand.opening_m));
        }
    }
    if left.is_zero() {
        return Reachability::AsFarAsNumbersTell;
    }
    match session.access(&entity.id) {
        None => Reachability::AsFarAsNumbersTell,
        Some(Access::Feasible) => Reachability::Yes,
        Some(Access::Infeasible { why, is_certified: true }) => Reachability::No(why.to_string()),
        Some(Access::Infeasible { why, is_certified: false }) => Reachability::Hardly(why.to_string()),
        Some(Access::Unknown(why)) => Reachability::Unknown(why.to_string()),
    }
}

/// Sightings as text, one object per line.
pub(super) fn told(seen: &[Sighting]) -> String {
    if seen.is_empty() {
        return String::new();
    }
    let lines = seen.iter().map(|one| {
        let sight = match one.seen {
            Some(true) => "seen",
            Some(false) => "not seen",
            None => "not known whether seen",
        };
        let reach = match &one.feasible {
            Reachability::AsFarAsNumbersTell => "feasible".to_owned(),
            Reachability::Yes => "feasible: there is a way to it and a motion there".to_owned(),
            Reachability::No(why) => format!("not feasible: {why}"),
            Reachability::Hardly(why) => format!("no motion was found, which proves nothing: {why}"),
            Reachability::Unknown(why) => format!("not known whether feasible: {why}"),
        };
        format!("- {}: {sight}, {reach}\n", one.id)
    });
    format!("# What the request names\n{}", lines.collect::<String>())
}

/// The parts of a prompt that do not change.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct StaticPrompt {
    /// Rules of writing a policy.
    pub(super) rules: String,
    /// The robot's primitives with needs and effects.
    pub(super) contracts: String,
    /// The robot's primitives without needs and effects.
    pub(super) signatures: String,
    /// Example requests with their policies, two at most.
    pub(super) examples: Vec<String>,
}

impl StaticPrompt {
    /// Writes the parts; the examples are planned in the session.
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
         A STEP runs a primitive: {{\"do\": NAME, PARAMETER: VALUE, …}}, with \"as\": NAME where its result \
         is used later, as \"$NAME\". Other steps: {{\"if\": C, \"then\": […], \"else\": […]}}, \
         {{\"try\": […], \"catch\": [{{\"on\": [FAILURE], \"steps\": […]}}]}}, \
         {{\"monitor\": [{{\"when\": C, \"then\": {{\"react\": \"pause\"}}}}], \"during\": […]}}, \
         {{\"end\": \"done\"}}, {{\"end\": \"replan\", \"why\": TEXT}}. A condition C is a text such as \
         \"holding(mug_1)\" or \"distance(user) < 0.5 m\". Name things by their ids. Where it is not clear \
             what \
         is meant, ask: {{\"do\": \"ask\", \"question\": TEXT, \"as\": \"answer\"}}, then \
         {{\"end\": \"replan\", \"why\": \"$answer\"}}.\n",
        robot.title, robot.name, robot.name
    )
}

fn primitives(session: &Session, detail: Detail) -> String {
    let items = session.library().signatures().map(|decl| Item::Primitive(short(decl, detail)));
    format!("# Primitives\n{}", print::text(&File { items: items.collect() }))
}

/// Two requests of this room with their policies.
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
        make_explicit(&mut policy, session.library(), Syntax::Json);
        Some(format!("# Example: {request}\n{}\n", one_line(&print::policy_json(&policy))))
    });
    written.collect()
}

/// Amount of detail about a primitive.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Detail {
    /// Signature, first sentence, needs, effects and failures.
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

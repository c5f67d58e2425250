//! What a model sees: the robot's primitives, the room in words, what is known, what was asked and done, two examples, and
//! the request. The same inputs give the same text, within a budget of tokens.

use motet_compiler::Session;
use motet_robots::card::Robot;
use motet_robots::scene::Scene;
use motet_runtime::memory::Memory;
use motet_syntax::ast::{Clause, File, Item, PrimitiveDecl};
use motet_syntax::print;
use smol_str::SmolStr;

use crate::builtin;
use crate::request::{self, Situation};

/// Bytes of English text and JSON that make about one token of a byte-pair encoding.
const BYTES_PER_TOKEN: usize = 4;
/// The budget where nothing else is said, in tokens.
pub const TOKENS: usize = 6_000;

/// The most entries of the memory.
const LATEST: usize = 24;

/// What a prompt is made from.
#[derive(Clone, Copy, Debug)]
pub struct Prompt<'a> {
    /// What policies are checked against.
    pub session: &'a Session,
    /// The robot.
    pub robot: &'a Robot,
    /// The room.
    pub scene: &'a Scene,
    /// What is known of it.
    pub situation: &'a Situation<'a>,
    /// What was asked and done.
    pub memory: &'a Memory,
    /// The most tokens, as far as bytes tell.
    pub tokens: usize,
}

/// A prompt, and what had to be left out of it.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Written {
    /// The text for the system's part of a chat.
    pub system: String,
    /// The text for the user's part.
    pub user: String,
    /// About how many tokens both are.
    pub tokens: usize,
    /// What was left out to stay within the budget.
    pub left_out: Vec<&'static str>,
}

/// What is seen of a thing that a request names, and whether it can be reached for.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Seen {
    /// The thing.
    pub id: SmolStr,
    /// Whether a camera sees it, where the scene says.
    pub seen: Option<bool>,
    /// Whether it can be taken, where masses and widths tell; what speaks against it otherwise.
    pub feasible: Result<(), String>,
}

/// A part that may be left out: the least important first.
type Part = (&'static str, String);

impl Prompt<'_> {
    /// Writes the prompt for a request.
    #[must_use]
    pub fn write(&self, request: &str) -> Written {
        let named = request::named(request, self.situation);
        let room = |entities: &dyn Fn(&SmolStr) -> bool| self.room(entities);
        let examples = self.examples();
        let mut parts: Vec<Part> = vec![
            ("what the primitives need and make", self.primitives(Detail::Contracts)),
            ("the second example", examples.get(1).cloned().unwrap_or_default()),
            ("things that the request does not name", room(&|id| !named.contains(id))),
            ("what was done", self.done()),
            ("the first example", examples.first().cloned().unwrap_or_default()),
        ];
        let mut left_out = Vec::new();
        let fixed = [
            self.rules(),
            room(&|id| named.contains(id)),
            seen(&self.seen(&named)),
            format!("# Request\n{}\n", request.trim()),
        ];
        let fixed_bytes: usize = fixed.iter().map(String::len).sum();
        let budget = self.tokens.saturating_mul(BYTES_PER_TOKEN);
        let bytes = |parts: &[Part]| fixed_bytes + parts.iter().map(|(_, text)| text.len()).sum::<usize>();
        let mut next = 0;
        while bytes(&parts) > budget && next < parts.len() {
            if let Some((name, text)) = parts.get_mut(next) {
                // Signatures without contracts are still worth their place.
                let shorter = if next == 0 { self.primitives(Detail::Signatures) } else { String::new() };
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

    fn rules(&self) -> String {
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
            self.robot.title, self.robot.name, self.robot.name
        )
    }

    /// The first request, the latest failure, and the latest of what was said and done.
    fn done(&self) -> String {
        let entries = self.memory.entries();
        let skipped = entries.len().saturating_sub(LATEST).max(1);
        let lines: String = entries.skip(skipped).map(|entry| format!("- {entry}\n")).collect();
        format!("# What was asked and done\n{}{lines}", self.memory.short())
    }

    fn primitives(&self, detail: Detail) -> String {
        let items = self.session.library().signatures().map(|decl| Item::Primitive(short(decl, detail)));
        format!("# Primitives\n{}", print::text(&File { items: items.collect() }))
    }

    /// The entities of the scene that are picked, a line each.
    fn room(&self, picked: &dyn Fn(&SmolStr) -> bool) -> String {
        let mut text = String::new();
        for entity in self.scene.entities.values().filter(|entity| picked(&entity.id)) {
            let names: Vec<&str> = entity.names.iter().map(SmolStr::as_str).collect();
            let called = if names.is_empty() { entity.class.to_string() } else { names.join(", ") };
            text.push_str(&format!("- {} ({}): {called}", entity.id, entity.kind));
            let now = self.situation.supports.iter().find(|(id, _)| *id == entity.id);
            match now {
                Some((_, Some(support))) => text.push_str(&format!("; at {support}")),
                Some((_, None)) => text.push_str("; it is not known where"),
                None => {
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

    /// What is seen of the things that a request names.
    #[must_use]
    pub fn seen(&self, named: &[SmolStr]) -> Vec<Seen> {
        let hand = self.robot.hands.values().next();
        let seen = named.iter().filter_map(|id| {
            let entity = self.scene.entities.get(id)?;
            let heavy = entity.mass_kg.zip(hand).filter(|(mass, hand)| *mass > hand.payload_kg);
            let wide = entity.width().zip(hand).filter(|(width, hand)| *width > hand.opening_m);
            let is_object = entity.kind == "Object";
            let feasible = match (heavy, wide) {
                (Some((mass, hand)), _) if is_object => {
                    Err(format!("too heavy: {mass} kg, payload is {} kg", hand.payload_kg))
                }
                (_, Some((width, hand))) if is_object => {
                    Err(format!("too wide: {width} m, opening is {} m", hand.opening_m))
                }
                _ => Ok(()),
            };
            Some(Seen { id: id.clone(), seen: entity.visible, feasible })
        });
        seen.collect()
    }

    /// Two requests of this room with the policies for them.
    fn examples(&self) -> Vec<String> {
        let mut objects = self.scene.entities.values().filter(|entity| entity.kind == "Object");
        let container = self.scene.entities.values().find(|entity| entity.kind == "Container");
        let mut requests = Vec::new();
        if let Some(object) = objects.next() {
            requests.push(format!("bring me the {}", request::called(object)));
        }
        if let (Some(object), Some(container)) = (objects.next(), container) {
            requests.push(format!(
                "put the {} in the {}",
                request::called(object),
                request::called(container)
            ));
        }
        let start = Situation::new(self.scene);
        let written = requests.iter().filter_map(|request| {
            let answered = builtin::answer(self.session, Some(self.robot), request, &start).ok()?;
            let policy = answered.planned.parsed.file.policies().next()?;
            Some(format!("# Example: {request}\n{}\n", one_line(&print::policy_json(policy))))
        });
        written.collect()
    }
}

/// How much is said of a primitive.
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

fn seen(seen: &[Seen]) -> String {
    if seen.is_empty() {
        return String::new();
    }
    let lines = seen.iter().map(|one| {
        let sight = match one.seen {
            Some(true) => "seen",
            Some(false) => "not seen",
            None => "not known whether seen",
        };
        let reach = one.feasible.as_ref().map_or_else(Clone::clone, |()| "feasible".to_owned());
        format!("- {}: {sight}, {reach}\n", one.id)
    });
    format!("# What the request names\n{}", lines.collect::<String>())
}

fn join(parts: &[&str]) -> String {
    let parts: Vec<&str> = parts.iter().map(|part| part.trim_end()).filter(|part| !part.is_empty()).collect();
    parts.join("\n\n") + "\n"
}

/// JSON without line breaks and indents.
fn one_line(json: &str) -> String {
    json.lines().map(str::trim).collect::<Vec<_>>().join(" ")
}

//! The prompt: the language and the primitives of the robot, the scene in words, the present state, earlier
//! requests, an example, and the request. The same inputs give the same text within a token budget; only a
//! motion search that takes too long leaves something out.

mod language;
mod scene;

use std::time::Duration;

use motet_compiler::Session;
use motet_graph::Value;
use motet_requests::RequestContext;
use motet_robots::card::Robot;
use motet_robots::scene::Scene;
use motet_runtime::memory::{Memory, ShortHistory};
use motet_syntax::render::is_steering;
use smol_str::SmolStr;

pub use language::StaticPrompt;
pub(crate) use scene::told;
pub use scene::{Reachability, Sighting, seen};

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
    /// Results of the steps of the latest policy, by name.
    pub bound: &'a [(SmolStr, Value)],
    /// Parts that all prompts of a robot in a scene share.
    pub lasting: &'a StaticPrompt,
    /// Maximum number of tokens, estimated from bytes.
    pub tokens: usize,
    /// Time after which no further motion is searched.
    pub time: Duration,
}

/// A prompt, and the names of the sections that did not fit.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct WrittenPrompt {
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
type Section = (&'static str, String);

impl Prompt<'_> {
    /// Writes the prompt for a request.
    #[must_use]
    pub fn write(&self, request: &str) -> WrittenPrompt {
        let named = motet_requests::named(request, self.situation);
        let listed = |entities: &dyn Fn(&SmolStr) -> bool| scene::entities(self.situation, entities);
        let mut parts: Vec<Section> = vec![
            ("needs and failures of the primitives", self.lasting.contracts.clone()),
            ("things that the request does not name", listed(&|id| !named.contains(id))),
            ("past requests and their outcome", self.done()),
            ("the example", self.lasting.example.clone()),
        ];
        let mut left_out = Vec::new();
        let fixed = [
            self.lasting.rules.clone(),
            listed(&|id| named.contains(id)),
            scene::now(self.situation, (self.session, self.robot), self.memory) + &scene::bound(self.bound),
            told(&seen(self.session, self.robot, self.scene, &named, self.time)),
            format!("# Request\n{}\n", request.trim()),
        ];
        let fixed_bytes: usize = fixed.iter().map(String::len).sum();
        let budget = self.tokens.saturating_mul(BYTES_PER_TOKEN);
        let bytes = |parts: &[Section]| fixed_bytes + parts.iter().map(|(_, text)| text.len()).sum::<usize>();
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
        let [rules, things, now, seen, asked] = fixed;
        let others = text(1);
        let scene = match (things.is_empty(), others.is_empty()) {
            (true, true) => String::new(),
            (false, true) => format!("# In the room, among other things\n{things}"),
            (true | false, false) => format!("# In the room\n{things}{others}"),
        };
        let system = join(&[&rules, text(0), text(3)]);
        let user = join(&[&scene, &now, &seen, text(2), &asked]);
        let tokens = (system.len() + user.len()).div_ceil(BYTES_PER_TOKEN);
        WrittenPrompt { system, user, tokens, left_out }
    }

    /// The first request, the latest failure, and the latest events.
    fn done(&self) -> String {
        let entries = self.memory.entries();
        let skipped = entries.len().saturating_sub(LATEST).max(1);
        let lines: String =
            entries.skip(skipped).map(|entry| format!("- {}\n", in_line(&entry.to_string()))).collect();
        let due = self.memory.due();
        let due: String =
            due.map(|due| format!("- still to clean up: {}\n", in_line(&due.to_string()))).collect();
        let ShortHistory { request, failure } = self.memory.short();
        if lines.is_empty() && due.is_empty() && failure.is_none() {
            return String::new();
        }
        let line = |text: &dyn ToString, of: &str| format!("{of}: {}\n", in_line(&text.to_string()));
        let request = request.map_or_else(String::new, |request| line(&request, "request"));
        let failure = failure.map_or_else(String::new, |failure| line(&failure, "latest failure"));
        format!("# What was asked and done\n{request}{failure}{lines}{due}")
    }
}

/// Text of others as part of a line: what would begin another one or steer a terminal is a blank.
fn in_line(text: &str) -> String {
    text.chars().map(|letter| if is_steering(letter) { ' ' } else { letter }).collect()
}

fn join(parts: &[&str]) -> String {
    let parts: Vec<&str> = parts.iter().map(|part| part.trim_end()).filter(|part| !part.is_empty()).collect();
    parts.join("\n\n") + "\n"
}

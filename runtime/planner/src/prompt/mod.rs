//! The prompt: primitives of the robot, the room in words, knowledge, earlier requests, two examples, and
//! the request. The same inputs give the same text within a token budget; only a motion search that takes
//! too long leaves something out.

mod sighting;
mod static_prompt;

use std::time::Duration;

use motet_compiler::Session;
use motet_robots::card::Robot;
use motet_robots::scene::Scene;
use motet_runtime::memory::Memory;
use smol_str::SmolStr;

pub use sighting::{Reachability, Sighting, seen};
pub use static_prompt::StaticPrompt;

use motet_requests::RequestContext;

/// Bytes of English text and JSON that make about one token of a byte-pair encoding.
const BYTES_PER_TOKEN: usize = 4;
/// The budget where nothing else is said, in tokens.
pub const TOKENS: usize = 6_000;
/// Default time limit for motion searches whose answers are not cached.
pub const TIME: Duration = Duration::from_millis(500);

/// The most entries of the memory.
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
    /// The most tokens, as far as bytes tell.
    pub tokens: usize,
    /// After how long no further motion is looked for.
    pub time: Duration,
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
    /// Sections that the budget left out.
    pub left_out: Vec<&'static str>,
}

/// A part that may be left out: the least important first.
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
            sighting::told(&seen(self.session, self.robot, self.scene, &named, self.time)),
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

    /// The first request, the latest failure, and the latest of what was said and done.
    fn done(&self) -> String {
        let entries = self.memory.entries();
        let skipped = entries.len().saturating_sub(LATEST).max(1);
        let lines: String = entries.skip(skipped).map(|entry| format!("- {entry}\n")).collect();
        format!("# What was asked and done\n{}{lines}", self.memory.short())
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

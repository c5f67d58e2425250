//! Lists of actions as policies, and policies as lists of actions.

use motet_compiler::Session;
use motet_robots::card::Robot;
use motet_robots::scene::Scene;
use motet_syntax::ast::{Block, Do, ExprKind, Policy, StepKind};
use motet_syntax::print;
use smol_str::SmolStr;
use thiserror::Error;

use super::list;
use motet_requests::RequestContext;

/// A policy from a list of actions, and what was read differently from how it was written.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Loose {
    /// The policy in the text form, not yet checked.
    pub policy: String,
    /// Words that were read as something else, and arguments that were filled in.
    pub warnings: Vec<String>,
}

/// Reasons for which a list of actions is no policy.
#[derive(Error, Clone, PartialEq, Eq, Debug)]
pub enum NoPolicy {
    /// There is nothing in it.
    #[error("there is no action in it")]
    Empty,
    /// An action that no word of the dialect stands for: a sentence, mostly.
    #[error("action {number}, `{action}`: no action is called so")]
    Unknown {
        /// Position in the list, from 1.
        number: usize,
        action: String,
    },
    /// The robot has no such primitive.
    #[error("action {number}, `{action}`: the robot has no `{primitive}`")]
    Lacking {
        /// Position in the list, from 1.
        number: usize,
        action: String,
        /// Primitive that the robot would need.
        primitive: &'static str,
    },
    /// It is not clear which thing is meant, or there is none.
    #[error("action {number}, `{action}`: {what}")]
    Unclear {
        /// Position in the list, from 1.
        number: usize,
        action: String,
        /// Description of the unclear part.
        what: String,
    },
}

/// Words and their primitives. Of two matches the longer one counts; the writer uses the first word of each
/// primitive.
const WORDS: &[(&str, &str)] = &[
    ("go to", "go"),
    ("go", "go"),
    ("navigate to", "go"),
    ("move to", "go"),
    ("drive to", "go"),
    ("walk to", "go"),
    ("pick", "pick"),
    ("pick up", "pick"),
    ("grasp", "pick"),
    ("grab", "pick"),
    ("take", "pick"),
    ("place", "place"),
    ("put", "place"),
    ("put down", "place"),
    ("drop", "place"),
    ("release", "place"),
    ("hand over", "handover"),
    ("handover", "handover"),
    ("give", "handover"),
    ("hand", "handover"),
    ("open", "open"),
    ("close", "close"),
    ("shut", "close"),
    ("detect", "detect"),
    ("find", "detect"),
    ("look for", "detect"),
    ("inspect", "inspect"),
    ("look at", "inspect"),
    ("push", "push"),
    ("lift", "lift"),
    ("home", "home"),
    ("fold arm", "home"),
    ("start pose", "start_pose"),
    ("wake up", "wake_up"),
    ("stand up", "wake_up"),
    ("say", "say"),
    ("ask", "ask"),
];
/// Prepositions between a thing and its destination.
const BETWEEN: &[&str] =
    &[" on top of ", " onto ", " into ", " inside ", " on ", " in ", " at ", " to ", ", "];

/// Reads a list of actions as a policy for a robot in a situation. O(actions · things).
///
/// # Errors
///
/// The first action that is none, that the robot lacks, or whose thing is not clear.
pub fn read(
    text: &str,
    name: &str,
    session: &Session,
    robot: Option<&Robot>,
    situation: &RequestContext<'_>,
) -> Result<Loose, NoPolicy> {
    let items = list::items(text);
    if items.is_empty() {
        return Err(NoPolicy::Empty);
    }
    let mut reader =
        Reader { session, situation, held: situation.holding.clone(), at: None, warnings: Vec::new() };
    let mut policy = format!("policy {}", print::identifier(name));
    if let Some(robot) = robot {
        policy.push_str(&format!(" for {}", print::identifier(&robot.name)));
    }
    policy.push_str(" {\n");
    for (index, item) in items.iter().enumerate() {
        policy.push_str(&reader.action(index + 1, item)?);
        policy.push('\n');
    }
    policy.push_str("}\n");
    Ok(Loose { policy, warnings: reader.warnings })
}

/// State of reading a list.
struct Reader<'a> {
    session: &'a Session,
    situation: &'a RequestContext<'a>,
    held: Option<SmolStr>,
    at: Option<SmolStr>,
    warnings: Vec<String>,
}

impl Reader<'_> {
    fn action(&mut self, number: usize, item: &str) -> Result<String, NoPolicy> {
        // `pick(coke)` is `pick coke`.
        let plain = item.replace(['(', ')', '_'], " ");
        let plain = plain.split_whitespace().collect::<Vec<_>>().join(" ").replace(" ,", ",");
        let fits = WORDS.iter().filter_map(|(words, primitive)| {
            let rest = plain.strip_prefix(words)?;
            (rest.is_empty() || rest.starts_with(' ')).then_some((*words, *primitive, rest.trim()))
        });
        let found = fits.max_by_key(|(words, _, _)| words.len());
        let action = || item.to_owned();
        let Some((words, primitive, rest)) = found else {
            return Err(NoPolicy::Unknown { number, action: action() });
        };
        if !self.session.library().signatures().any(|decl| decl.name.text == primitive) {
            return Err(NoPolicy::Lacking { number, action: action(), primitive });
        }
        let usual = written(primitive);
        if words != usual && words != primitive.replace('_', " ") {
            self.warnings.push(format!("action {number}: read `{words}` as `{usual}`"));
        }
        self.call(number, primitive, rest).map_err(|what| NoPolicy::Unclear {
            number,
            action: action(),
            what,
        })
    }

    /// The call as text. An error says what is not clear.
    fn call(&mut self, number: usize, primitive: &str, rest: &str) -> Result<String, String> {
        let id = print::identifier;
        Ok(match primitive {
            "go" => {
                let place =
                    self.thing(number, rest, &["Surface", "Container", "Place", "Person", "Object"])?;
                self.at = Some(place.clone());
                format!("go({})", id(&place))
            }
            "pick" => {
                let (what, _) = halves(rest).unwrap_or((rest, ""));
                let what = self.thing(number, what, &["Object"])?;
                self.held = Some(what.clone());
                format!("pick({})", id(&what))
            }
            "place" => {
                let (what, to) = self.placed(number, rest)?;
                self.held = None;
                format!("place({}, {})", id(&what), id(&to))
            }
            "handover" => {
                let (what, to) = halves(rest).unwrap_or((rest, ""));
                let what = self.held_or(number, what)?;
                let to = match to {
                    "" | "me" | "you" | "person" | "the person" => SmolStr::new_static("user"),
                    to => self.thing(number, to, &["Person"])?,
                };
                self.held = None;
                format!("handover({}, {})", id(&what), id(&to))
            }
            "open" | "close" => {
                let what = self.thing(number, rest, &["Container"])?;
                format!("{primitive}({})", id(&what))
            }
            "inspect" | "push" => {
                let what = self.thing(number, rest, &["Object", "Container", "Surface"])?;
                format!("{primitive}({})", id(&what))
            }
            "detect" | "say" | "ask" if rest.is_empty() => return Err("of what is not said".to_owned()),
            "detect" | "say" | "ask" => format!("{primitive}({})", quoted(rest)),
            _ if !rest.is_empty() => return Err(format!("`{rest}` is more than it takes")),
            _ => format!("{primitive}()"),
        })
    }

    /// Object and destination of a `place`: `coke on table`, `on table`, `coke`, `table`.
    fn placed(&mut self, number: usize, rest: &str) -> Result<(SmolStr, SmolStr), String> {
        const HOLDERS: &[&str] = &["Surface", "Container", "Object"];
        let padded = format!(" {rest}");
        let (what, to) = halves(&padded).unwrap_or((rest, ""));
        let (what, to) = (what.trim(), to.trim());
        if !to.is_empty() {
            let to = self.thing(number, to, HOLDERS)?;
            return Ok((self.held_or(number, what)?, to));
        }
        // One name: where to, unless it is what the hand holds.
        let is_place = self.thing(number, what, &["Surface", "Container"]);
        match (is_place, &self.at) {
            (Ok(to), _) if !what.is_empty() => Ok((self.held_or(number, "")?, to)),
            (_, Some(at)) => {
                let at = at.clone();
                self.warnings.push(format!("action {number}: put it at `{at}`, where the robot is then"));
                Ok((self.held_or(number, what)?, at))
            }
            (_, None) => Err("where to is not said".to_owned()),
        }
    }

    fn held_or(&mut self, number: usize, what: &str) -> Result<SmolStr, String> {
        match (what, &self.held) {
            ("" | "it" | "object" | "the object", Some(held)) => Ok(held.clone()),
            ("" | "it" | "object" | "the object", None) => Err("the hand holds nothing".to_owned()),
            (what, _) => self.thing(number, what, &["Object"]),
        }
    }

    /// The one thing of some kinds that words mean.
    fn thing(&mut self, number: usize, words: &str, kinds: &[&str]) -> Result<SmolStr, String> {
        let scene = self.situation.scene;
        if let Some(entity) = scene.entities.get(words.replace(' ', "_").as_str()) {
            return Ok(entity.id.clone());
        }
        if matches!(words, "user" | "me" | "the user") {
            return Ok(SmolStr::new_static("user"));
        }
        let of_kind =
            |id: &SmolStr| scene.entities.get(id).is_some_and(|entity| kinds.contains(&entity.kind.as_str()));
        let options: Vec<SmolStr> = scene.entities.keys().filter(|id| of_kind(id)).cloned().collect();
        let found = motet_requests::pick(words, &options, self.situation).or_else(|| {
            // `coke` is the can that was put somewhere by that name.
            let named: Vec<SmolStr> =
                motet_requests::named(words, self.situation).into_iter().filter(of_kind).collect();
            <[SmolStr; 1]>::try_from(named).ok().map(|[only]| only)
        });
        match found {
            Some(id) => {
                self.warnings.push(format!("action {number}: took `{words}` to be `{id}`"));
                Ok(id)
            }
            None => {
                let named = motet_requests::named(words, self.situation).into_iter().filter(of_kind);
                let named: Vec<_> = named.map(|id| format!("`{id}`")).collect();
                Err(match named.as_slice() {
                    [] => format!("`{words}` is nothing here"),
                    several => format!("`{words}` may be {}", several.join(" or ")),
                })
            }
        }
    }
}

/// The two halves around what stands between a thing and a place; the first such word counts.
fn halves(text: &str) -> Option<(&str, &str)> {
    let found = BETWEEN.iter().filter_map(|between| Some((text.find(between)?, *between)));
    let (_, between) = found.min_by_key(|(at, between)| (*at, std::cmp::Reverse(between.len())))?;
    let (what, to) = text.split_once(between)?;
    Some((what.trim(), to.trim()))
}

/// The first words that stand for a primitive.
fn written(primitive: &str) -> &str {
    WORDS.iter().find(|(_, known)| *known == primitive).map_or(primitive, |(words, _)| words)
}

fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\""))
}

/// A policy as a list of actions, and what of it the list leaves out: conditions, monitors, what is done
/// after a failure.
#[must_use]
pub fn write(policy: &Policy, scene: &Scene) -> (String, Vec<String>) {
    let mut writer = Writer { scene, actions: Vec::new(), left_out: Vec::new() };
    writer.block(&policy.body);
    (writer.actions.join(", "), writer.left_out)
}

struct Writer<'a> {
    scene: &'a Scene,
    actions: Vec<String>,
    left_out: Vec<String>,
}

impl Writer<'_> {
    fn block(&mut self, block: &Block) {
        for step in &block.steps {
            match &step.kind {
                StepKind::Do(call) => self.call(call),
                StepKind::Sequence { body, .. } => self.block(body),
                StepKind::Monitor { body, .. } => self.without("a monitor", body),
                StepKind::Try { body, .. } => self.without("what is done after a failure", body),
                StepKind::If { then, .. } => self.without("a condition", then),
                StepKind::Repeat { body, .. } | StepKind::Each { body, .. } => self.without("a loop", body),
                StepKind::Parallel { branches } => {
                    branches.iter().for_each(|branch| self.without("that branches run together", branch));
                }
                StepKind::Wait { .. } => self.left_out.push("a wait".to_owned()),
                StepKind::End(_) => {}
            }
        }
    }

    fn without(&mut self, what: &str, body: &Block) {
        if !self.left_out.iter().any(|known| known == what) {
            self.left_out.push(what.to_owned());
        }
        self.block(body);
    }

    fn call(&mut self, call: &Do) {
        let args: Vec<String> = call.call.args.iter().map(|arg| self.arg(&arg.value.kind)).collect();
        let name = call.call.name.text.as_str();
        // The dialect has no word for it: who goes there sees what is there.
        let looks_there = name == "search" && args.len() == 2;
        let words = written(if looks_there { "go" } else { name }).replace('_', " ");
        let joined = match (name, args.as_slice()) {
            ("search", [_, around]) => around.clone(),
            ("place", [what, to]) => {
                let inside = call.call.args.get(1).is_some_and(|arg| self.is_container(&arg.value.kind));
                format!("{what} {} {to}", if inside { "in" } else { "on" })
            }
            ("handover", [what, to]) => format!("{what} to {to}"),
            _ => args.join(" "),
        };
        self.actions.push(format!("{words} {joined}").trim().to_owned());
    }

    fn arg(&self, value: &ExprKind) -> String {
        match value {
            ExprKind::Name(id) | ExprKind::Plain(id) | ExprKind::Binding(id) => id.replace('_', " "),
            ExprKind::Text(text) => text.to_string(),
            _ => String::new(),
        }
    }

    fn is_container(&self, value: &ExprKind) -> bool {
        let (ExprKind::Name(id) | ExprKind::Plain(id)) = value else { return false };
        self.scene.entities.get(id).is_some_and(|entity| entity.kind == "Container")
    }
}

//! Lists of actions as policies, and policies as lists of actions.

use std::collections::BTreeSet;

use motet_compiler::Session;
use motet_requests::RequestContext;
use motet_robots::card::Robot;
use motet_robots::scene::Scene;
use motet_stdlib::lang::{entities, kinds, primitives};
use motet_syntax::ast::{Block, Do, ExprKind, Policy, Step, StepKind};
use motet_syntax::print;
use smol_str::SmolStr;
use thiserror::Error;

use super::action_list::{NUMBERED, items};
use super::exchange::{QUOTED, untagged};
use crate::planned::quoted;

/// A policy from a list of actions, with the interpretations that the reader made.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct InterpretedPolicy {
    /// The policy in text syntax, not yet checked.
    pub policy: String,
    /// Words that were read as something else, and arguments that were filled in.
    pub warnings: Vec<String>,
}

/// Reasons why a list of actions is not a policy.
#[derive(Error, Clone, PartialEq, Eq, Debug)]
pub enum NoPolicy {
    /// The list is empty.
    #[error("there is no action in it")]
    Empty,
    /// An unknown action, usually a sentence.
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
    /// No object, or several objects, have the name.
    #[error("action {number}, `{action}`: {what}")]
    Unclear {
        /// Position in the list, from 1.
        number: usize,
        action: String,
        /// Description of the unclear part.
        what: String,
    },
}

/// Words for each primitive; the writer uses the first. Of two matches the longer one counts.
const WORDS: &[(&str, &[&str])] = &[
    (primitives::GO, &["go to", "go", "navigate to", "move to", "drive to", "walk to"]),
    (primitives::PICK, &["pick", "pick up", "grasp", "grab", "take"]),
    (primitives::PLACE, &["place", "put", "put down", "drop", "release"]),
    (primitives::HANDOVER, &["hand over", "handover", "give", "hand"]),
    (primitives::OPEN, &["open"]),
    (primitives::CLOSE, &["close", "shut"]),
    (primitives::SEARCH, &["search", "search for", "look for"]),
    (primitives::DETECT, &["detect", "find"]),
    (primitives::TURN, &["turn", "rotate"]),
    (primitives::INSPECT, &["inspect", "look at"]),
    (primitives::PUSH, &["push"]),
    (primitives::LIFT, &["lift"]),
    (primitives::HOME, &["home", "fold arm"]),
    (primitives::START_POSE, &["start pose"]),
    (primitives::WAKE_UP, &["wake up", "stand up"]),
    (primitives::SAY, &["say"]),
    (primitives::ASK, &["ask"]),
];
/// Kinds of what a robot can go to.
const ANYWHERE: &[&str] = &[kinds::SURFACE, kinds::CONTAINER, kinds::PLACE, kinds::PERSON, kinds::OBJECT];
/// Prepositions between an object and its destination.
const BETWEEN: &[&str] =
    &[" on top of ", " onto ", " into ", " inside ", " on ", " in ", " at ", " to ", ", "];

/// The longest action that is read, in bytes.
const MAX_ACTION_BYTES: usize = 4_096;
/// The most actions of a list.
const MAX_ACTIONS: usize = 5_000;
/// The longest name of a thing that is no id, in bytes.
const MAX_NAME_BYTES: usize = 100;

/// Reads a list of actions as a policy for a robot in a context. O(actions · objects).
///
/// ```
/// use motet_compiler::Session;
/// use motet_planner::inteliplan::actions;
/// use motet_requests::RequestContext;
///
/// let robot = motet_robots::builtin::robot("hsr").unwrap().robot;
/// let scene = motet_robots::builtin::scene("kitchen").unwrap();
/// let session = Session::builder().robot(&robot).scene(&scene).build(&mut Default::default());
///
/// let list = "1. go to counter, 2. pick up coke";
/// let read = actions::read(list, "fetch", &session, Some(&robot), &RequestContext::new(&scene))?;
/// assert!(read.policy.contains("pick(coke)"));
/// # Ok::<(), actions::NoPolicy>(())
/// ```
///
/// # Errors
///
/// The first unknown action, the first action that the robot lacks, the first unclear object, or the first
/// action that is too many.
pub fn read(
    text: &str,
    name: &str,
    session: &Session,
    robot: Option<&Robot>,
    situation: &RequestContext<'_>,
) -> Result<InterpretedPolicy, NoPolicy> {
    let items = items(text, situation.scene);
    if items.is_empty() {
        return Err(NoPolicy::Empty);
    }
    if let Some(first) = items.get(MAX_ACTIONS) {
        let action = shown(first, situation.scene).chars().take(QUOTED).collect();
        let what = format!("a list has at most {MAX_ACTIONS} actions; split it into several");
        return Err(NoPolicy::Unclear { number: MAX_ACTIONS + 1, action, what });
    }
    let mut reader = Reader::new(Some(session), situation);
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
    Ok(InterpretedPolicy { policy, warnings: reader.warnings })
}

/// State of reading a list.
struct Reader<'a> {
    /// Session whose library has the primitives of the robot; `None` where all are taken to be there.
    session: Option<&'a Session>,
    situation: &'a RequestContext<'a>,
    /// Ids of the scene as they are written in a list.
    ids: BTreeSet<String>,
    held: Option<SmolStr>,
    at: Option<SmolStr>,
    warnings: Vec<String>,
}

impl<'a> Reader<'a> {
    fn new(session: Option<&'a Session>, situation: &'a RequestContext<'a>) -> Self {
        let ids = situation.scene.entities.keys().map(SmolStr::as_str);
        let ids = ids.chain([entities::USER, entities::START]).map(spelt).collect();
        Self { session, situation, ids, held: situation.holding.clone(), at: None, warnings: Vec::new() }
    }

    fn action(&mut self, number: usize, item: &str) -> Result<String, NoPolicy> {
        if item.len() > MAX_ACTION_BYTES {
            let action = item.chars().take(QUOTED).collect();
            return Err(NoPolicy::Unknown { number, action });
        }
        // `pick(coke)` is `pick coke`.
        let plain = item.replace(['(', ')', '_'], " ");
        let plain = plain.split_whitespace().collect::<Vec<_>>().join(" ").replace(" ,", ",");
        let all = WORDS.iter().flat_map(|(primitive, words)| words.iter().map(|words| (*words, *primitive)));
        let fits = all.filter_map(|(words, primitive)| {
            let rest = plain.strip_prefix(words)?;
            (rest.is_empty() || rest.starts_with(' ')).then_some((words, primitive, rest.trim()))
        });
        let found = fits.max_by_key(|(words, _, _)| words.len());
        let action = || shown(item, self.situation.scene);
        let Some((words, primitive, rest)) = found else {
            return Err(NoPolicy::Unknown { number, action: action() });
        };
        let has = |session: &Session| session.library().signatures().any(|decl| decl.name.text == primitive);
        if !self.session.is_none_or(has) {
            return Err(NoPolicy::Lacking { number, action: action(), primitive });
        }
        let usual = written(primitive);
        if words != usual && words != primitive.replace('_', " ") {
            self.warnings.push(format!("action {number}: read `{words}` as `{usual}`"));
        }
        let action = action();
        self.call(number, primitive, rest).map_err(|what| NoPolicy::Unclear { number, action, what })
    }

    /// The call as text. The error names the unclear part.
    fn call(&mut self, number: usize, primitive: &str, rest: &str) -> Result<String, String> {
        let id = print::identifier;
        Ok(match primitive {
            primitives::GO => {
                let place = match rest {
                    // Who fetches something goes back to the person.
                    "back" | "back to me" | "back to user" => SmolStr::new_static(entities::USER),
                    rest => self.thing(number, rest.strip_prefix("back to ").unwrap_or(rest), ANYWHERE)?,
                };
                self.at = Some(place.clone());
                format!("go({})", id(&place))
            }
            primitives::PICK => {
                let padded = format!(" {}", rest.replace(" from ", " at "));
                let (what, place) =
                    if self.ids.contains(rest) { None } else { self.halves(&padded) }.unwrap_or((rest, ""));
                let what = self.thing(number, what, &[kinds::OBJECT])?;
                let mut steps = String::new();
                if !place.is_empty() {
                    let place = self.thing(number, place, &[kinds::SURFACE, kinds::CONTAINER])?;
                    if self.at.as_ref() != Some(&place) {
                        self.warnings.push(format!("action {number}: goes to `{place}` first"));
                        steps = format!("go({})\n", id(&place));
                    }
                    self.at = Some(place);
                }
                self.held = Some(what.clone());
                format!("{steps}pick({})", id(&what))
            }
            primitives::SEARCH => self.search(number, rest)?,
            primitives::TURN => {
                let degrees = turn(rest).ok_or("by how much is not said, such as `left` or `90 degrees`")?;
                format!("turn({degrees} deg)")
            }
            primitives::PLACE => {
                let (what, to) = self.placed(number, rest)?;
                self.held = None;
                if self.is_person(&to) {
                    self.warnings
                        .push(format!("action {number}: hands it to `{to}`, where the robot is then"));
                    return Ok(format!("handover({}, {})", id(&what), id(&to)));
                }
                format!("place({}, {})", id(&what), id(&to))
            }
            primitives::HANDOVER => {
                let (what, to) = self.halves(rest).unwrap_or((rest, ""));
                let what = self.held_or(number, what)?;
                let to = match to {
                    "" | "me" | "you" | "person" | "the person" => SmolStr::new_static(entities::USER),
                    to => self.thing(number, to, &[kinds::PERSON])?,
                };
                self.held = None;
                format!("handover({}, {})", id(&what), id(&to))
            }
            primitives::OPEN | primitives::CLOSE => {
                let what = self.thing(number, rest, &[kinds::CONTAINER])?;
                format!("{primitive}({})", id(&what))
            }
            primitives::INSPECT | primitives::PUSH => {
                let what = self.thing(number, rest, &[kinds::OBJECT, kinds::CONTAINER, kinds::SURFACE])?;
                format!("{primitive}({})", id(&what))
            }
            primitives::DETECT | primitives::SAY | primitives::ASK if rest.is_empty() => {
                return Err("it has no argument".to_owned());
            }
            primitives::DETECT | primitives::SAY | primitives::ASK => {
                format!("{primitive}({})", quoted(rest))
            }
            _ if !rest.is_empty() => return Err(format!("`{rest}` is more than it takes")),
            _ => format!("{primitive}()"),
        })
    }

    /// A search where the thing is taken to be, else on every surface.
    fn search(&mut self, number: usize, rest: &str) -> Result<String, String> {
        let padded = format!(" {rest}");
        let (what, place) = self.halves(&padded).unwrap_or((rest, ""));
        if what.is_empty() {
            return Err("it has no argument".to_owned());
        }
        let scene = self.situation.scene;
        let known = self.thing(number, what, &[kinds::OBJECT]).ok();
        let moved = known.as_ref().and_then(|id| self.situation.supports.iter().find(|(one, _)| one == id));
        let stands = known.as_ref().and_then(|id| scene.entities.get(id));
        let stands = stands.and_then(|entity| entity.on.clone().or_else(|| entity.inside.clone()));
        let places = match (place, moved.map_or(stands, |(_, place)| place.clone())) {
            ("", Some(place)) => vec![place],
            ("", None) => {
                let surfaces = scene.entities.values().filter(|entity| entity.kind == kinds::SURFACE);
                surfaces.map(|entity| entity.id.clone()).collect()
            }
            (place, _) => vec![self.thing(number, place, ANYWHERE)?],
        };
        self.at = places.first().cloned();
        let name = known.and_then(|id| scene.entities.get(&id)).map(motet_requests::called);
        let places: Vec<String> = places.iter().map(|place| print::identifier(place).to_string()).collect();
        Ok(format!("search({}, [{}])", quoted(&name.unwrap_or_else(|| what.to_owned())), places.join(", ")))
    }

    /// Object and destination of a `place`: `coke on table`, `on table`, `coke`, `table`.
    fn placed(&mut self, number: usize, rest: &str) -> Result<(SmolStr, SmolStr), String> {
        const HOLDERS: &[&str] = &[kinds::SURFACE, kinds::CONTAINER, kinds::OBJECT];
        let padded = format!(" {rest}");
        let (what, to) = self.halves(&padded).unwrap_or((rest, ""));
        let (what, to) = (what.trim(), to.trim());
        if !to.is_empty() {
            let to = self.thing(number, to, HOLDERS)?;
            return Ok((self.held_or(number, what)?, to));
        }
        // One name: where to, unless it is what the hand holds.
        let is_place = self.thing(number, what, &[kinds::SURFACE, kinds::CONTAINER]);
        match (is_place, &self.at) {
            (Ok(to), _) if !what.is_empty() => Ok((self.held_or(number, "")?, to)),
            (_, Some(at)) => {
                let at = at.clone();
                if self.is_person(&at) {
                    return Ok((self.held_or(number, what)?, at));
                }
                self.warnings.push(format!("action {number}: put it at `{at}`, where the robot is then"));
                Ok((self.held_or(number, what)?, at))
            }
            (_, None) => Err("it has no destination".to_owned()),
        }
    }

    /// The two halves around a preposition between an object and a place: the first one with an id on both
    /// sides, which may have prepositions in it, or else the first.
    fn halves<'t>(&self, text: &'t str) -> Option<(&'t str, &'t str)> {
        let all = BETWEEN.iter().flat_map(|between| text.match_indices(between));
        let mut all: Vec<(usize, &str)> = all.collect();
        all.sort_by_key(|(at, between)| (*at, std::cmp::Reverse(between.len())));
        let split = |(at, between): &(usize, &str)| {
            let (what, to) = (text.get(..*at)?, text.get(at + between.len()..)?);
            Some((what.trim(), to.trim()))
        };
        let is_known = |half: &str| half.is_empty() || self.ids.contains(half);
        let mut found = all.iter().filter_map(split);
        let known = found.clone().find(|(what, to)| is_known(what) && self.ids.contains(*to));
        known.or_else(|| found.next())
    }

    fn is_person(&self, id: &SmolStr) -> bool {
        let entity = self.situation.scene.entities.get(id);
        id == entities::USER || entity.is_some_and(|entity| entity.kind == kinds::PERSON)
    }

    fn held_or(&mut self, number: usize, what: &str) -> Result<SmolStr, String> {
        match (what, &self.held) {
            ("" | "it" | "object" | "the object", Some(held)) => Ok(held.clone()),
            ("" | "it" | "object" | "the object", None) => Err("the hand holds nothing".to_owned()),
            (what, _) => self.thing(number, what, &[kinds::OBJECT]),
        }
    }

    /// The only entity of some kinds that the words mean.
    fn thing(&mut self, number: usize, words: &str, kinds: &[&str]) -> Result<SmolStr, String> {
        let scene = self.situation.scene;
        let of_kind =
            |id: &SmolStr| scene.entities.get(id).is_some_and(|entity| kinds.contains(&entity.kind.as_str()));
        let number_of = words.strip_prefix(NUMBERED).and_then(|index| index.parse::<usize>().ok());
        if let Some((id, _)) = number_of.and_then(|index| scene.entities.get_index(index)) {
            return if of_kind(id) { Ok(id.clone()) } else { Err(format!("`{id}` is of another kind")) };
        }
        if let Some(id) = scene.entities.keys().find(|id| of_kind(id) && spelt(id) == words) {
            return Ok(id.clone());
        }
        if matches!(words, entities::USER | "me" | "the user") && kinds.contains(&kinds::PERSON) {
            return Ok(SmolStr::new_static(entities::USER));
        }
        if words == entities::START && kinds.contains(&kinds::PLACE) {
            return Ok(SmolStr::new_static(entities::START));
        }
        if words.len() > MAX_NAME_BYTES {
            return Err(format!("a name has at most {MAX_NAME_BYTES} bytes"));
        }
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

/// An id as a reader finds it in a list.
fn spelt(id: &str) -> String {
    let words = id.to_lowercase().replace(['_', '(', ')'], " ");
    words.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// An item with the names that its numbers stand for.
fn shown(item: &str, scene: &Scene) -> String {
    let words = item.split(' ').map(|word| {
        let number = word.strip_prefix(NUMBERED).and_then(|index| index.parse().ok());
        number.and_then(|index| scene.entities.get_index(index)).map_or(word, |(id, _)| id.as_str())
    });
    words.collect::<Vec<_>>().join(" ")
}

/// Angle to the left of `left`, `around`, `90 degrees to the right`, in degrees.
fn turn(rest: &str) -> Option<i32> {
    let number = rest.trim_start_matches("by ").split_once(' ').map_or(rest, |(number, _)| number);
    let number = number.trim_end_matches(['°', 'g', 'e', 'd']);
    match number.parse::<i32>() {
        Ok(degrees) if rest.ends_with("right") => Some(-degrees),
        Ok(degrees) => Some(degrees),
        Err(_) => motet_requests::turn(&format!("turn {rest}")),
    }
}

/// The first words of a primitive.
fn written(primitive: &str) -> &str {
    let words = WORDS.iter().find(|(known, _)| *known == primitive);
    words.and_then(|(_, words)| words.first().copied()).unwrap_or(primitive)
}

/// A policy as a list of actions, and the parts that the list leaves out: conditions, monitors, handlers.
#[must_use]
pub fn write(policy: &Policy, scene: &Scene) -> (String, Vec<String>) {
    let situation = RequestContext::new(scene);
    let reader = Reader::new(None, &situation);
    let mut writer = Writer { reader, scene, actions: Vec::new(), left_out: Vec::new() };
    if policy.keeps.is_empty() {
        writer.block(&policy.body);
    } else {
        writer.without("a kept distance or zone", &policy.body);
    }
    if let Some(cleanup) = &policy.cleanup {
        writer.without("the cleanup after a failure", cleanup);
    }
    (writer.actions.join(", "), writer.left_out)
}

struct Writer<'a> {
    /// Reader of what is written.
    reader: Reader<'a>,
    scene: &'a Scene,
    actions: Vec<String>,
    left_out: Vec<String>,
}

impl Writer<'_> {
    fn block(&mut self, block: &Block) {
        block.steps.iter().for_each(|step| self.step(step));
    }

    fn step(&mut self, step: &Step) {
        match &step.kind {
            StepKind::Do(call) => self.call(call),
            StepKind::Sequence { body, .. } => self.block(body),
            StepKind::Monitor { body, .. } => self.without("a monitor", body),
            StepKind::Within { body, .. } => self.without("a deadline", body),
            StepKind::Keep { body, .. } => self.without("a kept distance or zone", body),
            StepKind::Try { body, .. } => self.without("the steps after a failure", body),
            StepKind::If { then, .. } => self.without("a condition", then),
            StepKind::Repeat { body, .. } | StepKind::Each { body, .. } => self.without("a loop", body),
            StepKind::Parallel { branches } => {
                branches.iter().for_each(|branch| self.without("the parallel run of branches", branch));
            }
            StepKind::Let { .. } => self.left_out.push("a name for a value".to_owned()),
            StepKind::Wait { .. } | StepKind::Delay { .. } => self.left_out.push("a wait".to_owned()),
            StepKind::Finally { step, cleanup } => {
                self.step(step);
                self.without("the cleanup after a failure", cleanup);
            }
            StepKind::End(_) => {}
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
        let looks_there = name == primitives::SEARCH && args.len() == 2;
        let words = written(if looks_there { primitives::GO } else { name }).replace('_', " ");
        if let (true, Some(ExprKind::List(places))) =
            (looks_there, call.call.args.get(1).map(|arg| &arg.value.kind))
        {
            for place in places {
                let meant = self.meant(primitives::GO, std::iter::once(&place.kind));
                self.push(format!("go {}", self.arg(&place.kind)), meant);
            }
            return;
        }
        let joined = match (name, args.as_slice()) {
            (primitives::SEARCH, [_, around]) => around.clone(),
            (primitives::PLACE, [what, to]) => {
                let inside = call.call.args.get(1).is_some_and(|arg| self.is_container(&arg.value.kind));
                format!("{what} {} {to}", if inside { "in" } else { "on" })
            }
            (primitives::HANDOVER, [what, to]) => format!("{what} to {to}"),
            _ => args.join(" "),
        };
        let meant = self.meant(name, call.call.args.iter().map(|arg| &arg.value.kind));
        self.push(format!("{words} {joined}"), meant);
    }

    /// The call that an action has to be read as, where it is about things of the scene only.
    fn meant<'e>(&self, name: &str, mut args: impl Iterator<Item = &'e ExprKind>) -> Option<String> {
        let is_read = matches!(name, primitives::GO | primitives::PICK | primitives::PLACE)
            || matches!(name, primitives::HANDOVER | primitives::OPEN | primitives::CLOSE)
            || matches!(name, primitives::INSPECT | primitives::PUSH);
        let things = args.by_ref().map(|arg| match arg {
            ExprKind::Name(id) | ExprKind::Plain(id) => Some(id).filter(|id| self.is_thing(id)),
            _ => None,
        });
        let things = things.map(|id| id.map(|id| print::identifier(id).to_string()));
        let things: Vec<String> = things.collect::<Option<_>>().filter(|_| is_read)?;
        Some(format!("{name}({})", things.join(", ")))
    }

    fn is_thing(&self, id: &str) -> bool {
        matches!(id, entities::USER | entities::START) || self.scene.entities.contains_key(id)
    }

    /// Adds an action. A list has no quotes: what would read as several actions, as a part of the next one,
    /// or as another action, is left out.
    fn push(&mut self, action: String, meant: Option<String>) {
        // As an exchange has it.
        let words = untagged(&action.split_whitespace().collect::<Vec<_>>().join(" "));
        let mut read = items(&format!("{words}, {END}"), self.scene);
        if read.first().map(std::slice::from_ref) != Some(items(&words, self.scene).as_slice()) {
            // At the end of a list it reads otherwise.
            read.clear();
        }
        match (read.as_slice(), meant) {
            ([_, end], None) if end == END => self.actions.push(words),
            ([item, end], Some(meant)) if end == END && self.reader.action(1, item) == Ok(meant.clone()) => {
                self.actions.push(words);
            }
            ([_, end], _) if end == END => {
                self.left_out.push(format!("`{words}`, which reads as something else"));
            }
            _ => self.left_out.push(format!("`{words}`, whose marks separate actions")),
        }
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
        self.scene.entities.get(id).is_some_and(|entity| entity.kind == kinds::CONTAINER)
    }
}

/// Action behind another one, to see where that ends.
const END: &str = "home";

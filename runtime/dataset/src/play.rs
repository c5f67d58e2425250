//! A case played from its request to its end, with every turn in which a planner is asked: the request, the
//! answer, and the scene as it was then.

use std::cell::RefCell;
use std::rc::Rc;
use std::time::Duration;

use motet_compiler::CheckOptions;
use motet_decode::{Grammar, canonical};
use motet_planner::builtin::{PlanError, PlannedRequest};
use motet_planner::dialogue::{
    Conversation, DialogueObserver, DialogueSetup, Kind, Outcome, Person, Problem,
};
use motet_planner::inteliplan::{actions, exchange};
use motet_planner::model::ReplyVerdict;
use motet_planner::{Builtin, PlanRequest, Planner, model, prompt};
use motet_requests::Intent;
use motet_robots::scene::{Entity, Scene};
use motet_runtime::{Driver as _, Perception as _, Time};
use motet_sim::{Sim, SimOptions};
use motet_stdlib::lang::{entities, fluents, kinds};
use motet_syntax::{FileId, Source, print};
use smol_str::SmolStr;

use crate::case::Case;
use crate::picture::{Picture, Pictures};
use crate::testbed::{Posture, Testbed};

/// Answers from a list.
struct Scripted(Vec<(Kind, String)>);

impl Person for Scripted {
    fn ask(&mut self, problem: &Problem) -> Option<String> {
        let next = self.0.iter().position(|(kind, _)| *kind == problem.kind)?;
        Some(self.0.remove(next).1)
    }
}

/// A person who changes the request at a time.
struct Change(Option<(f64, String)>);

impl DialogueObserver for Change {
    fn request(&mut self, now: Time) -> Option<String> {
        self.0.take_if(|(secs, _)| Time::from_secs(*secs) <= now).map(|(_, words)| words)
    }

    fn at_least_every(&self) -> Time {
        if self.0.is_some() { Time::from_secs(0.5) } else { Time::NEVER }
    }
}

/// Reason why a case is not played: nothing would go wrong.
pub(crate) const IN_VIEW: &str = "the thing that should be missing is in view";

/// Plays a case where the robot was told the scene of a testbed. Gives its turns, or why it did not go as it
/// was drawn: it came to another end, its goal does not hold, or something that should go wrong was never
/// asked about.
pub(crate) fn play(
    case: &Case,
    testbed: &Testbed,
    (pictures, light): (Pictures, f64),
) -> Result<Vec<Turn>, &'static str> {
    let eye = testbed.geometry.as_ref().and_then(|geometry| geometry.eye());
    let options = SimOptions { faults: case.faults.clone(), eye, ..SimOptions::default() };
    let mut driver = Rc::new(RefCell::new(Sim::new(&testbed.robot, &case.real, options)));
    // What is not where the robot was told that it is would be seen at once.
    let is_in_view = |id: &SmolStr| {
        let seen = driver.borrow_mut().detections(Time::ZERO);
        seen.iter().any(|one| one.entity.as_ref() == Some(id))
    };
    if case.hidden.as_ref().is_some_and(is_in_view) {
        return Err(IN_VIEW);
    }
    let (told, sim) = (testbed.scene.clone(), driver.clone());
    let lesson = case.policy.clone();
    let mut mind = Mind { testbed, told, sim, pictures, light, lesson, is_asking: false, turns: Vec::new() };
    let mut change = Change(case.update.clone());
    let setting = DialogueSetup {
        robot: testbed.robot.clone(),
        scene: testbed.scene.clone(),
        domains: Vec::new(),
        geometry: testbed.geometry.clone(),
        options: CheckOptions::default(),
    };
    let mut person = Scripted(case.answers.clone());
    let mut talk = Conversation::new(&setting).with_session(testbed.base.clone());
    let (outcome, _) =
        talk.carry_out(&case.request, &mut mind, &mut driver, &mut person, &mut change, Time::ZERO);
    if change.0.is_some() {
        return Err("it was over before the person changed the request");
    }
    match (outcome, case.is_given_up) {
        (Outcome::Done, false) | (Outcome::GivenUp, true) => {}
        // A lesson may decline, or ask a question to which nobody has an answer here.
        (Outcome::Declined(_), false) if case.policy.is_some() => {}
        (Outcome::Failed(_), false) if mind.is_asking => {}
        _ => return Err("the conversation came to another end"),
    }
    if !person.0.is_empty() {
        return Err("not everything went wrong that should");
    }
    if let Some((fluent, args, holds)) = case.goal.as_ref().filter(|_| !case.is_given_up) {
        let args: Vec<&str> = args.iter().map(smol_str::SmolStr::as_str).collect();
        if driver.borrow().holds(fluent, &args) != Some(*holds) {
            return Err("the goal does not hold at the end");
        }
    }
    if case.policy.is_some() {
        mind.turns.truncate(1);
    }
    Ok(mind.turns)
}

/// A turn: a planner is asked, and answers.
#[derive(Clone, Debug)]
pub(crate) struct Turn {
    /// The scene as it is then, as far as it is known.
    pub(crate) scene: Scene,
    /// State of the robot's body then, where the card does not say it.
    pub(crate) posture: Posture,
    pub(crate) system: String,
    pub(crate) user: String,
    /// Camera images at that moment.
    pub(crate) pictures: Vec<Picture>,
    pub(crate) request: String,
    pub(crate) history: String,
    pub(crate) vision: String,
    pub(crate) feasibility: String,
    /// On the model surface; why it has no place there otherwise.
    pub(crate) policy: Result<String, String>,
    pub(crate) actions: String,
}

/// A simulator that a planner looks at while the conversation drives it.
pub(crate) type Shared = Rc<RefCell<Sim>>;

/// The planner that needs no model, with a memory of its turns.
pub(crate) struct Mind<'s> {
    testbed: &'s Testbed,
    /// The scene as the robot was told that it is.
    pub(crate) told: Scene,
    pub(crate) sim: Shared,
    pub(crate) pictures: Pictures,
    /// Light of the pictures, where 1 is that of the camera.
    pub(crate) light: f64,
    /// The policy of a lesson, until it is asked for.
    pub(crate) lesson: Option<String>,
    /// True if the policy of the lesson passed the check and may ask for another plan.
    pub(crate) is_asking: bool,
    pub(crate) turns: Vec<Turn>,
}

impl Planner for Mind<'_> {
    fn plan(&mut self, ask: &PlanRequest<'_>) -> Result<PlannedRequest, PlanError> {
        let answer = match self.lesson.take() {
            Some(policy) => {
                let taught = taught(ask, &policy);
                self.is_asking = taught.is_ok() && policy.contains("replan ");
                taught
            }
            None => Builtin.plan(ask),
        };
        let kept = self.testbed.kept();
        let chat = model::chat_with(ask, &kept.lasting, prompt::TOKENS);
        let mut chat = chat.into_iter().map(|message| message.text);
        let (system, user) = (chat.next().unwrap_or_default(), chat.next().unwrap_or_default());
        let (scene, situation) = (ask.situation.scene, ask.situation);
        let now = self.scene_now(ask);
        let named = motet_requests::named(ask.request, situation);
        // The same seed gives the same rows, however fast the machine is.
        let seen = prompt::seen(ask.session, ask.robot, scene, &named, Duration::ZERO);
        let (_, feasibility) = exchange::sight(&seen);
        let vision: Vec<String> = named.iter().filter_map(|id| sight(&now, id)).collect();
        // The first entry is the request itself.
        let entries = ask.memory.entries().skip(1).map(|entry| entry.to_string());
        let history: Vec<String> = std::iter::once(stance(ask, &now)).chain(entries).collect();
        let (policy, actions) = match &answer {
            Ok(answered) => {
                let policy = answered.planned.parsed.file.policies().next();
                let actions = policy.map(|policy| actions::write(policy, scene).0).unwrap_or_default();
                (surfaced(&kept.grammar, &answered.planned.text), actions)
            }
            Err(why) => {
                let question = Problem::of_planning(why, scene).question;
                (surfaced(&kept.grammar, &asking(ask, &question)), question)
            }
        };
        self.turns.push(Turn {
            scene: now,
            posture: self.posture(ask),
            system,
            user,
            pictures: self.pictures(&named),
            request: ask.request.to_owned(),
            history: history.join("; "),
            vision: vision.join(", "),
            feasibility,
            policy,
            actions,
        });
        answer
    }

    fn reads_answers(&self) -> bool {
        true
    }
}

impl Mind<'_> {
    /// Pictures of the room, and of the first named thing that is in view.
    fn pictures(&self, named: &[SmolStr]) -> Vec<Picture> {
        match self.pictures {
            Pictures::None => Vec::new(),
            Pictures::EachRow => {
                let mut sim = self.sim.borrow_mut();
                let now = sim.now();
                let room = sim.image(now);
                let near = named.iter().find_map(|id| sim.view(now, id)).map(|view| view.image);
                let all = room.into_iter().chain(near);
                all.map(|image| Picture(image.bytes.into()).lit(self.light)).collect()
            }
        }
    }

    /// Facts about the robot itself that its card gives for the start, as they are now.
    fn posture(&self, ask: &PlanRequest<'_>) -> Posture {
        let sim = self.sim.borrow();
        if sim.now() == Time::ZERO {
            return Posture::new();
        }
        let initially = ask.robot.initially.iter().filter_map(|fact| {
            let fact = fact.strip_prefix("not ").unwrap_or(fact);
            fact.strip_suffix(&format!("({})", entities::ROBOT))
        });
        let holds = |fluent: &str| Some((fluent.into(), sim.holds(fluent, &[entities::ROBOT])?));
        initially.filter_map(holds).collect()
    }

    /// The scene as it is known: what is believed of things counts where it is not the case.
    fn scene_now(&self, ask: &PlanRequest<'_>) -> Scene {
        let sim = self.sim.borrow();
        let mut scene = self.told.clone();
        let base = sim.base();
        scene.robot.base = [base.x, base.y, base.heading];
        let has_moved = sim.now() > Time::ZERO;
        if has_moved {
            scene.robot.joints.clear();
            scene.robot.holding = Some(ask.situation.holding.clone());
            let serves = |id: &str| sim.holds(fluents::AT, &[entities::ROBOT, id]) == Some(true);
            scene.robot.at = scene.entities.keys().find(|id| serves(id)).cloned();
        }
        let kinds: Vec<_> =
            scene.entities.iter().map(|(id, entity)| (id.clone(), entity.kind.clone())).collect();
        for (id, entity) in &mut scene.entities {
            if has_moved && entity.travel.is_some() {
                entity.open = sim.holds(fluents::OPEN, &[id.as_str()]);
            }
            if entity.kind != kinds::OBJECT || entity.fixed {
                continue;
            }
            // What was in view was so from where the robot stood.
            if has_moved {
                entity.visible = None;
            }
            let believed = ask.situation.supports.iter().find(|(known, _)| known == id);
            let Some((_, support)) = believed else { continue };
            let is_held = ask.situation.holding.as_ref() == Some(id);
            let before = entity.on.as_ref().or(entity.inside.as_ref());
            if !is_held && before == support.as_ref() {
                continue;
            }
            (entity.on, entity.inside, entity.pose, entity.visible) = (None, None, None, None);
            let Some(support) = support.as_ref().filter(|_| !is_held) else { continue };
            let is_container = kinds.iter().any(|(known, kind)| known == support && kind == kinds::CONTAINER);
            if is_container {
                entity.inside = Some(support.clone());
            } else {
                entity.on = Some(support.clone());
            }
        }
        scene
    }
}

/// The robot as it stands, in the words of the dialect.
fn stance(ask: &PlanRequest<'_>, now: &Scene) -> String {
    let mut text = format!("robot: {}", ask.robot.name);
    if let Some(place) = &now.robot.at {
        text.push_str(&format!(", at {place}"));
    }
    if let Some(Some(held)) = &now.robot.holding {
        text.push_str(&format!(", holding {held}"));
    }
    text
}

/// Knowledge of a thing in the words of the dialect: `coke: not seen, in fridge_1 (closed)`.
fn sight(now: &Scene, id: &str) -> Option<String> {
    let entity = now.entities.get(id)?;
    let word = match entity.visible {
        Some(true) => "seen",
        Some(false) => "not seen",
        None => "unknown",
    };
    let state = |entity: &Entity| match entity.open {
        Some(true) => " (open)",
        Some(false) => " (closed)",
        None => "",
    };
    let at = |preposition: &str, holder: &Option<SmolStr>| {
        let holder = now.entities.get(holder.as_ref()?)?;
        Some(format!(", {preposition} {}{}", holder.id, state(holder)))
    };
    let place = at(fluents::ON, &entity.on).or_else(|| at(fluents::IN, &entity.inside)).unwrap_or_default();
    Some(format!("{id}: {word}{}{place}", state(entity)))
}

/// The policy of a lesson, with the steps that it lacks on this robot.
fn taught(ask: &PlanRequest<'_>, policy: &str) -> Result<PlannedRequest, PlanError> {
    match model::judge(ask.session, policy) {
        ReplyVerdict::Good { planned, .. } => {
            Ok(PlannedRequest { understood: Intent::default(), planned: *planned })
        }
        ReplyVerdict::Bad { findings, .. } => {
            Err(PlanError::Refused { text: policy.to_owned(), diagnostics: findings })
        }
    }
}

/// A policy as a model writes it.
fn surfaced(grammar: &Grammar, text: &str) -> Result<String, String> {
    let parsed = motet_syntax::read(&Source::new("plan.motet", text), FileId(0));
    let policy = parsed.file.policies().next().ok_or_else(|| "there is no policy".to_owned())?;
    canonical(policy, grammar).map_err(|outside| outside.why)
}

/// A policy that asks a question, whose answer goes into the next plan.
fn asking(ask: &PlanRequest<'_>, question: &str) -> String {
    let plain: String =
        question.chars().map(|letter| if letter == '"' || letter == '\\' { '\'' } else { letter }).collect();
    let robot = print::identifier(&ask.robot.name);
    format!("policy ask_first for {robot} {{\n    let answer = ask(\"{plain}\")\n    replan answer\n}}\n")
}

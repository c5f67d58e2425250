//! Answers to questions about the room and the robot: from what is known and remembered, and where that does
//! not say, from what the robot finds out when it looks.

use std::time::Duration;

use motet_graph::Value;
use motet_requests::{ReportedLocation, RequestContext, RoomQuestion, Topic, step_doing, step_done};
use motet_robots::scene::{Entity, Scene};
use motet_runtime::memory::{MemoryEvent, StepEnd};
use motet_runtime::{Driver, Pattern, Query, Time, Truth};
use motet_stdlib::lang::{entities, fluents, kinds};
use motet_syntax::render::capital;
use smol_str::SmolStr;

use super::conversation::{Conversation, DialogueObserver, Outcome, Person};
use super::knowledge::Knowledge;
use super::manager::{Area, DialogueManager, SearchEnd};
use super::problem::{Kind, Problem, join};
use super::reason::in_words;
use super::senses::{ask, sense};
use crate::Planner;
use crate::prompt::{Reachability, seen};

/// The most steps that an answer tells.
const MAX_STEPS: usize = 12;

/// Way to find an answer out.
enum Look {
    /// Looks for a thing, given by its id or by words.
    For(SmolStr),
    /// Looks at everything at a place, which a request gets the robot to. The other one puts right what that
    /// has changed.
    At(SmolStr, String, Option<String>),
    /// Carries out a request.
    By(String),
}

impl Conversation<'_> {
    /// Takes in what is in view.
    pub(super) fn look_around(&mut self, driver: &mut dyn Driver, now: Time) {
        if driver.capabilities().detections {
            let seen = driver.detections(now);
            self.known.look(&self.setting.scene, &seen);
        }
    }

    /// Reads a question by what is known now.
    pub(super) fn question(&self, said: &str) -> Option<RoomQuestion> {
        let scene = self.known.scene(&self.setting.scene);
        motet_requests::question(said, &self.known.situation(&scene))
    }

    /// Answers a question at the driver's time `from`. Returns the outcome, done where there is an answer,
    /// and the time at the end.
    pub(super) fn reply(
        &mut self,
        said: &str,
        mut question: RoomQuestion,
        (planner, person, watcher): (&mut dyn Planner, &mut dyn Person, &mut dyn DialogueObserver),
        driver: &mut dyn Driver,
        from: Time,
    ) -> (Outcome, Time) {
        let (mut now, sees) = (from, driver.capabilities().detections);
        if let Some(thing) = self.unseen_here(&question).filter(|_| sees) {
            let request = format!("find the {thing}");
            let mut manager =
                DialogueManager::new(self, (&mut *planner, &mut *person, &mut *watcher), &request, now);
            let end = manager.search(&thing, &[Area::Place], driver);
            now = manager.now;
            if let SearchEnd::Replaced(outcome) = end {
                return (outcome, now);
            }
            self.look_around(driver, now);
        }
        let run = self.next_run();
        now = driver.begin_run(now, &run, None);
        now = self.find_out(&question, driver, now);
        let (mut answer, mut closing) = (self.answer_here(&question, driver, now), None);
        let look = self.look_for(&question, sees).filter(|_| answer.is_none());
        if let Some(look) = look {
            let request = match &look {
                Look::For(thing) => format!("find the {thing}"),
                Look::At(_, request, _) | Look::By(request) => request.clone(),
            };
            let mut manager =
                DialogueManager::new(self, (&mut *planner, &mut *person, &mut *watcher), &request, now);
            let end = match &look {
                Look::For(thing) => manager.search(thing, &[Area::Here, Area::Room], driver),
                Look::At(..) | Look::By(_) => match manager.pursue(driver) {
                    Outcome::Done if !manager.is_replaced(&request) => SearchEnd::Missed,
                    outcome => SearchEnd::Replaced(outcome),
                },
            };
            now = manager.now;
            if let SearchEnd::Replaced(outcome) = end {
                return (outcome, now);
            }
            self.look_around(driver, now);
            if let Look::At(place, _, after) = look {
                if let Some(request) = after {
                    let mut manager =
                        DialogueManager::new(self, (planner, person, &mut *watcher), &request, now);
                    let outcome = manager.pursue(driver);
                    now = manager.now;
                    if outcome == Outcome::Stopped || manager.is_replaced(&request) {
                        return (outcome, now);
                    }
                    closing = Some(outcome).filter(|outcome| *outcome != Outcome::Done);
                }
                self.known.looked_at.push(place);
            }
            let run = self.next_run();
            now = driver.begin_run(now, &run, None);
            // What was seen may be what the words mean.
            question = self.question(said).unwrap_or(question);
            now = self.find_out(&question, driver, now);
            let known = self.answer_here(&question, driver, now);
            answer = known.or_else(|| self.found_here(&question).filter(|_| matches!(end, SearchEnd::Found)));
        }
        // A look says if there is such a thing.
        if question.topic == Topic::Existence && answer.is_none() {
            answer = Some(self.unknown(&question));
        }
        self.known.spoken_of.extend(question.things.iter().cloned());
        self.memory.asked(now, said, answer.as_deref());
        watcher.answered(said, answer.as_deref());
        let unknown = || Problem { kind: Kind::NotFound, ..Problem::nothing(&self.unknown(&question)) };
        let answered = answer.map_or_else(|| Outcome::Failed(unknown()), |_| Outcome::Done);
        // What was opened for the answer may still be open.
        (closing.unwrap_or(answered), now)
    }

    /// Answer from what is known, or from what the driver sees and where it stands now.
    fn answer_here(&self, question: &RoomQuestion, driver: &mut dyn Driver, now: Time) -> Option<String> {
        match question.topic {
            Topic::View => {}
            Topic::Reach => return self.reach(question, driver.base()),
            Topic::Distance => return self.distance(question, driver.base()?),
            _ => return self.known_answer(question, &self.known),
        }
        let scene = &self.known.seen_scene(&self.setting.scene);
        let mut seen: Vec<String> = Vec::new();
        for one in driver.detections(now) {
            let name = match &one.entity {
                Some(id) => the(scene, id),
                None if one.class.is_empty() => continue,
                None => format!("a {}", one.class),
            };
            if !seen.contains(&name) {
                seen.push(name);
            }
        }
        if seen.is_empty() {
            self.known_answer(question, &self.known)
        } else {
            Some(format!("I see {}.", join(&seen)))
        }
    }

    /// Answer by the feasibility of a motion to a thing, without one of the robot.
    fn reach(&self, question: &RoomQuestion, base: Option<[f64; 3]>) -> Option<String> {
        let scene = &self.known.scene(&self.setting.scene);
        let thing = question.things.first()?;
        let name = the(scene, thing);
        // What is nowhere is looked for first.
        let located = self.located(thing, &self.known)?;
        if self.known.holding(scene).as_ref() == Some(thing) {
            return Some(located);
        }
        let session = self.session(scene, &self.known, base);
        let robot = &self.setting.robot;
        let seen = seen(&session, robot, scene, std::slice::from_ref(thing), Duration::MAX).pop()?;
        match seen.feasible {
            Reachability::Yes => Some(format!("Yes, I can reach {name}.")),
            Reachability::AsFarAsNumbersTell => {
                Some(format!("Yes, I can reach {name}, as far as I can tell without a motion."))
            }
            Reachability::No(why) => Some(format!("No, I cannot reach {name}: {}.", in_words(&why, scene))),
            Reachability::Hardly(why) => {
                Some(format!("I find no way to reach {name}: {}.", in_words(&why, scene)))
            }
            Reachability::Unknown(_) => None,
        }
    }

    /// Answer with the distance of a thing, or of its place, from the base at a pose.
    fn distance(&self, question: &RoomQuestion, base: [f64; 3]) -> Option<String> {
        let scene = &self.setting.scene;
        let thing = question.things.first()?;
        let located = self.located(thing, &self.known)?;
        if self.known.holding(scene).as_ref() == Some(thing) {
            return Some(located);
        }
        let (placed, _) = self.known.placed(scene, base)?;
        let at = |id: &SmolStr| placed.entities.get(id)?.pose.map(|pose| pose.xyz);
        let support = || at(&self.known.place_of(scene, thing)?.place);
        let [x, y, _] = at(thing).or_else(support)?;
        let away = (x - base[0]).hypot(y - base[1]);
        let name = capital(&the(&placed, thing));
        let is = if thing == entities::USER { "are" } else { "is" };
        Some(format!("{name} {is} about {away:.1} m away."))
    }

    /// Answer of a robot that does not know, and that did not find out.
    pub(super) fn unknown(&self, question: &RoomQuestion) -> String {
        let scene = &self.known.seen_scene(&self.setting.scene);
        let RoomQuestion { topic, things, place, said } = question;
        let missed = self.known.missed.iter().rev().find(|one| things.contains(&one.thing));
        let looked = missed.map_or_else(String::new, |one| {
            format!(" I looked {} and did not see it.", at(scene, &one.place))
        });
        match topic {
            Topic::Standing => "I do not know where I am.".to_owned(),
            Topic::Contents => match place {
                Some(place) => format!("I do not know what is {}.", at(scene, place)),
                None => "I do not know.".to_owned(),
            },
            Topic::Open | Topic::Closed => {
                let what = things.first().map_or_else(|| format!("the {said}"), |thing| the(scene, thing));
                format!("I do not know if {what} is open.")
            }
            Topic::Location | Topic::Placed | Topic::Distance | Topic::Reach => match things.first() {
                Some(thing) => format!("I do not know where {} is.{looked}", the(scene, thing)),
                None if said.is_empty() => "I do not know what you mean.".to_owned(),
                None => format!("I know of no {said} here."),
            },
            Topic::Existence => format!("No, I know of no {said} here."),
            Topic::Held | Topic::Holds | Topic::Count => "I do not know.".to_owned(),
            Topic::History | Topic::Activity | Topic::View | Topic::Seen => "I do not know.".to_owned(),
        }
    }

    /// Asks the driver for what it observes by itself. Returns the time after that.
    fn find_out(&mut self, question: &RoomQuestion, driver: &mut dyn Driver, now: Time) -> Time {
        let (robot, scene) = (&self.setting.robot, &self.setting.scene);
        let (seen, after) = match question.topic {
            Topic::Held | Topic::Holds | Topic::Standing => sense(driver, robot, scene, now),
            Topic::Open | Topic::Closed if robot.observes.iter().any(|known| known == fluents::OPEN) => {
                let is_unknown = |id: &&SmolStr| self.is_open(id, &self.known).is_none();
                let query = |id: &SmolStr| Query::Fact {
                    fluent: fluents::OPEN.into(),
                    args: vec![Pattern::Is(Value::Entity(id.clone()))],
                };
                let queries: Vec<Query> = question.things.iter().filter(is_unknown).map(query).collect();
                ask(driver, queries, robot, now)
            }
            _ => return now,
        };
        self.known.notice(&seen);
        after
    }

    /// Look that may answer a question; `None` if no look helps. What nobody told of is only seen where the
    /// driver `sees` it.
    fn look_for(&self, question: &RoomQuestion, sees: bool) -> Option<Look> {
        let scene = &self.known.seen_scene(&self.setting.scene);
        let place = question.place.as_ref();
        let place = place.filter(|_| sees && matches!(question.topic, Topic::Contents | Topic::Placed));
        if let Some(look) = place.and_then(|place| self.look_at(place, scene)) {
            return Some(look);
        }
        match question.topic {
            Topic::Location | Topic::Placed | Topic::Distance | Topic::Reach | Topic::Existence => {
                let said = Some(&question.said).filter(|said| sees && !said.is_empty());
                question.things.first().cloned().or_else(|| said.map(SmolStr::from)).map(Look::For)
            }
            Topic::Open | Topic::Closed => {
                let name = scene.called(question.things.first()?);
                Some(Look::By(format!("go to the {name}")))
            }
            Topic::Standing | Topic::Held | Topic::Holds | Topic::Contents => None,
            Topic::Count | Topic::History | Topic::Activity | Topic::View | Topic::Seen => None,
        }
    }

    /// Thing that a question places, where it is believed to be right before the robot and is not in view.
    fn unseen_here(&self, question: &RoomQuestion) -> Option<SmolStr> {
        let scene = &self.known.seen_scene(&self.setting.scene);
        let thing = question.things.first().filter(|_| question.topic == Topic::Placed)?;
        let place = self.known.place_of(&self.setting.scene, thing)?.place;
        let is_shown = match scene.entities.get(&place)?.kind.as_str() {
            kinds::CONTAINER => self.is_open(&place, &self.known) == Some(true),
            kind => kind == kinds::SURFACE,
        };
        let is_here = is_shown && self.known.standing(scene).as_ref() == Some(&place);
        (is_here && self.known.seen_place(&self.setting.scene, thing).is_none()).then(|| thing.clone())
    }

    /// Look at everything on a surface or in a container. `None` where the hand is not free to open it.
    fn look_at(&self, place: &SmolStr, scene: &Scene) -> Option<Look> {
        let (kind, name) = (scene.entities.get(place)?.kind.as_str(), scene.called(place));
        let is_shut = kind == kinds::CONTAINER && self.is_open(place, &self.known) != Some(true);
        let has_been = self.known.looked_at.contains(place);
        if has_been || !matches!(kind, kinds::SURFACE | kinds::CONTAINER) {
            return None;
        }
        if !is_shut {
            return Some(Look::At(place.clone(), format!("go to the {name}"), None));
        }
        let opens = Look::At(place.clone(), format!("open the {name}"), Some(format!("close the {name}")));
        self.known.holding(scene).is_none().then_some(opens)
    }

    /// Answer after a look that found the thing, where no support is known.
    fn found_here(&self, question: &RoomQuestion) -> Option<String> {
        let thing = question.things.first().filter(|_| question.topic == Topic::Location)?;
        let scene = &self.known.seen_scene(&self.setting.scene);
        let at = self.known.standing(scene).filter(|place| place != thing);
        let at = at.map_or_else(String::new, |place| format!(", at {}", the(scene, &place)));
        Some(format!("{} is here{at}.", capital(&the(scene, thing))))
    }

    /// True or false where it is known that something is open.
    fn is_open(&self, id: &SmolStr, known: &Knowledge) -> Option<bool> {
        match known.told(fluents::OPEN, id) {
            Some(Truth::True) => Some(true),
            Some(Truth::False) => Some(false),
            Some(Truth::Unknown) => None,
            None => self.setting.scene.entities.get(id)?.open,
        }
    }

    /// Answer from what is known. `None` if that does not say.
    pub(super) fn known_answer(&self, question: &RoomQuestion, known: &Knowledge) -> Option<String> {
        let scene = &known.seen_scene(&self.setting.scene);
        let things = &question.things;
        let is_at = |id: &SmolStr, place: &SmolStr| {
            known.place_of(&self.setting.scene, id).is_some_and(|one| one.place == *place)
        };
        let held = known.holding(scene);
        match question.topic {
            Topic::Location => {
                let told = things.iter().filter_map(|id| self.located(id, known));
                let told: Vec<String> = told.collect();
                (told.len() == things.len() && !told.is_empty()).then(|| told.join(" "))
            }
            Topic::Standing => {
                let at = known.standing(scene)?;
                Some(format!("I am at {}.", the(scene, &at)))
            }
            Topic::Held => {
                Some(held.map_or_else(
                    || "I hold nothing.".to_owned(),
                    |id| format!("I hold {}.", the(scene, &id)),
                ))
            }
            Topic::Holds => {
                let holds = held.as_ref().is_some_and(|id| things.contains(id));
                Some(match (holds, held) {
                    (true, Some(id)) => format!("Yes, I hold {}.", the(scene, &id)),
                    (_, Some(id)) => format!("No, I hold {}.", the(scene, &id)),
                    (_, None) => "No, I hold nothing.".to_owned(),
                })
            }
            Topic::Open | Topic::Closed => {
                let is_open = self.is_open(things.first()?, known)?;
                let word = if is_open { "open" } else { "closed" };
                let yes = if is_open == (question.topic == Topic::Open) { "Yes" } else { "No" };
                Some(format!("{yes}, {} is {word}.", the(scene, things.first()?)))
            }
            Topic::Placed => {
                let wanted = question.place.as_ref()?;
                if let Some(id) = things.iter().find(|id| is_at(id, wanted)) {
                    return Some(format!("Yes, {}.", there(scene, id, wanted)));
                }
                let told: Option<Vec<String>> = things.iter().map(|id| self.located(id, known)).collect();
                if let Some(told) = told.filter(|told| !told.is_empty()) {
                    return Some(format!("No. {}", told.join(" ")));
                }
                let missed = |one: &ReportedLocation| one.place == *wanted && things.contains(&one.thing);
                let has_looked = known.looked_at.contains(wanted) || known.missed.iter().any(missed);
                let said = things.first().map_or_else(|| question.said.clone(), |id| scene.called(id));
                has_looked.then(|| format!("No, I looked {} and saw no {said}.", at(scene, wanted)))
            }
            Topic::Contents => {
                let wanted = question.place.as_ref()?;
                let is_there = |one: &ReportedLocation| {
                    one.place == *wanted && !known.missed.contains(one) && held.as_ref() != Some(&one.thing)
                };
                let there = known.places(&self.setting.scene).into_iter().filter(is_there);
                let there: Vec<String> = there.map(|one| the(scene, &one.thing)).collect();
                let at = at(scene, wanted);
                match there.as_slice() {
                    [] if known.looked_at.contains(wanted) => Some(format!("I looked {at} and saw nothing.")),
                    [] => None,
                    [only] => Some(format!("{} is {at}.", capital(only))),
                    several => Some(format!("{} are {at}.", capital(&join(several)))),
                }
            }
            Topic::Count => {
                let is_there = |id: &&SmolStr| question.place.as_ref().is_none_or(|place| is_at(id, place));
                let counted: Vec<String> = things.iter().filter(is_there).map(|id| the(scene, id)).collect();
                Some(match counted.len() {
                    0 => "I know of none.".to_owned(),
                    count => format!("I know of {count}: {}.", join(&counted)),
                })
            }
            // Who moves has no base from which these are asked.
            Topic::Distance | Topic::Reach => None,
            Topic::Existence => {
                let told = self.located(things.first()?, known);
                Some(format!("Yes. {}", told.unwrap_or_else(|| "I do not know where it is.".to_owned())))
            }
            Topic::History => Some(self.history()),
            Topic::Activity => {
                let situation = RequestContext::new(scene);
                let words = |call: &str| step_doing(parts(call).0, &parts(call).1, &situation);
                let doing: Vec<String> = self.memory.running().map(|step| words(&step.call)).collect();
                Some(if doing.is_empty() {
                    "I am doing nothing.".to_owned()
                } else {
                    format!("I am {}.", join(&doing))
                })
            }
            Topic::Seen => {
                let kind = |id: &SmolStr| scene.entities.get(id).map(|entity| entity.kind.as_str());
                let seen = known.seen_so_far.iter().filter(|id| kind(id) == Some(kinds::OBJECT)).map(|id| {
                    let place = known.place_of(&self.setting.scene, id).map(|one| one.place);
                    let place = place.filter(|place| kind(place) != Some(kinds::PERSON));
                    let at = place.map(|place| format!(" {}", at(scene, &place)));
                    format!("{}{}", the(scene, id), at.unwrap_or_default())
                });
                let seen: Vec<String> = seen.collect();
                let missed = known.missed.iter().map(|one| {
                    format!(" I did not see {} {}.", the(scene, &one.thing), at(scene, &one.place))
                });
                let seen = if seen.is_empty() { "nothing".to_owned() } else { join(&seen) };
                Some(format!("I have seen {seen}.{}", missed.collect::<String>()))
            }
            Topic::View => {
                let is_visible = |entity: &&Entity| {
                    let told = known.told(fluents::VISIBLE, &entity.id);
                    told.map_or(entity.visible == Some(true), |truth| truth == Truth::True)
                };
                let seen = scene.entities.values().filter(|entity| entity.kind == kinds::OBJECT);
                let seen: Vec<String> = seen.filter(is_visible).map(|one| the(scene, &one.id)).collect();
                Some(if seen.is_empty() {
                    "I see nothing that I know.".to_owned()
                } else {
                    format!("I see {}.", join(&seen))
                })
            }
        }
    }

    /// Location of an entity as a sentence, where it is known.
    fn located(&self, id: &SmolStr, known: &Knowledge) -> Option<String> {
        let scene = &known.seen_scene(&self.setting.scene);
        let name = capital(&the(scene, id));
        if known.holding(scene).as_ref() == Some(id) {
            return Some(format!("I hold {}.", the(scene, id)));
        }
        let entity = scene.entities.get(id)?;
        if entity.kind != kinds::OBJECT {
            let pose = entity.pose?;
            let [x, y, _] = pose.xyz;
            return Some(format!(
                "{name} {} at ({x:.1}, {y:.1}) m.",
                if id == entities::USER { "are" } else { "is" }
            ));
        }
        let place = known.place_of(&self.setting.scene, id)?;
        Some(format!("{}.", capital(&there(scene, id, &place.place))))
    }

    /// Sentence that a person has a thing, where that is known.
    pub(super) fn with_person(&self, thing: &SmolStr) -> Option<String> {
        let place = self.known.place_of(&self.setting.scene, thing)?.place;
        let is_person = self.setting.scene.entities.get(&place)?.kind == kinds::PERSON;
        self.located(thing, &self.known).filter(|_| is_person)
    }

    /// Steps that were carried out, in words.
    fn history(&self) -> String {
        let scene = self.known.seen_scene(&self.setting.scene);
        let situation = RequestContext::new(&scene);
        let mut steps = Vec::new();
        for entry in self.memory.entries() {
            let MemoryEvent::Step { call, ended, .. } = &entry.what else { continue };
            let (primitive, args) = parts(call);
            let doing = || step_doing(primitive, &args, &situation);
            steps.push(match ended {
                StepEnd::Success(_) => step_done(primitive, &args, &situation),
                StepEnd::Failure { kind, .. } => {
                    format!("tried {}, without success ({})", doing(), kind.replace('_', " "))
                }
                StepEnd::Interrupted(_) => format!("began {}", doing()),
            });
        }
        let left_out = steps.len().saturating_sub(MAX_STEPS);
        let mut latest = steps.split_off(left_out);
        match latest.pop() {
            None => "I have done nothing yet.".to_owned(),
            Some(only) if latest.is_empty() => format!("I {only}."),
            Some(last) => {
                let first = if left_out > 0 { "At last I" } else { "I" };
                format!("{first} {}, and then {last}.", latest.join(", "))
            }
        }
    }
}

/// Name and arguments of a call such as `pick(object: mug_1)`.
fn parts(call: &str) -> (&str, Vec<SmolStr>) {
    let Some((name, rest)) = call.split_once('(') else { return (call, Vec::new()) };
    let rest = rest.strip_suffix(')').unwrap_or(rest);
    // A text may hold any marks.
    if let Some((_, text)) = rest.split_once('"') {
        let text = text.rsplit_once('"').map_or(text, |(text, _)| text);
        return (name, vec![text.into()]);
    }
    let arg = |part: &str| part.split_once(": ").map_or(part, |(_, value)| value).trim().into();
    (name, rest.split(", ").filter(|part| !part.is_empty()).map(arg).collect())
}

/// Entity in a sentence: `the red mug`, `you`.
fn the(scene: &Scene, id: &SmolStr) -> String {
    match scene.entities.get(id).map(|entity| entity.kind.as_str()) {
        Some(kinds::PERSON) if id == entities::USER => "you".to_owned(),
        Some(kinds::PERSON) => scene.called(id),
        Some(_) | None => format!("the {}", scene.called(id)),
    }
}

/// Place in a sentence: `on the counter`, `in the fridge`.
fn at(scene: &Scene, place: &SmolStr) -> String {
    let relation = scene.entities.get(place).map_or(fluents::ON, Entity::relation);
    format!("{relation} {}", the(scene, place))
}

/// Thing at a place as a sentence without its full stop: `the coke can is on the counter`, `you have the coke
/// can`.
fn there(scene: &Scene, thing: &SmolStr, place: &SmolStr) -> String {
    let is_person = scene.entities.get(place).is_some_and(|entity| entity.kind == kinds::PERSON);
    match (the(scene, thing), the(scene, place)) {
        (thing, person) if is_person && place == entities::USER => format!("{person} have {thing}"),
        (thing, person) if is_person => format!("{person} has {thing}"),
        (thing, _) => format!("{thing} is {}", at(scene, place)),
    }
}

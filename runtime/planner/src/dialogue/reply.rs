//! Answers to questions about the room and the robot: from what is known and remembered, and where that does
//! not say, from what the robot finds out when it looks.

use motet_graph::Value;
use motet_requests::{RequestContext, RoomQuestion, Topic, step_done};
use motet_robots::scene::{Entity, Scene};
use motet_runtime::memory::{MemoryEvent, StepEnd};
use motet_runtime::{Driver, Pattern, Query, Time, Truth};
use motet_stdlib::lang::{entities, fluents, kinds};
use motet_syntax::render::capital;
use smol_str::SmolStr;

use super::conversation::{Conversation, DialogueObserver, Outcome, Person};
use super::knowledge::Knowledge;
use super::manager::{DialogueManager, SearchEnd};
use super::problem::{Kind, Problem, join, unknown};
use super::senses::{ask, sense};
use crate::Planner;

/// The most steps that an answer tells.
const MAX_STEPS: usize = 12;

impl Conversation<'_> {
    /// Answers a question at the driver's time `from`. Returns the outcome, done where there is an answer,
    /// and the time at the end.
    pub(super) fn reply(
        &mut self,
        said: &str,
        question: &RoomQuestion,
        (planner, person, watcher): (&mut dyn Planner, &mut dyn Person, &mut dyn DialogueObserver),
        driver: &mut dyn Driver,
        from: Time,
    ) -> (Outcome, Time) {
        let run = self.next_run();
        let mut now = driver.begin_run(from, &run, None);
        now = self.find_out(question, driver, now);
        let mut answer = self.answer_here(question, driver, now);
        if let (None, Some(request)) = (&answer, self.look_request(question)) {
            let mut manager = DialogueManager::new(self, (planner, person, &mut *watcher), &request, now);
            let end = match (question.topic, question.things.first()) {
                (Topic::Location | Topic::Placed, Some(thing)) => manager.search(thing, driver),
                _ => match manager.pursue(driver) {
                    Outcome::Stopped => SearchEnd::Replaced(Outcome::Stopped),
                    _ => SearchEnd::Missed,
                },
            };
            now = manager.now;
            if let SearchEnd::Replaced(outcome) = end {
                return (outcome, now);
            }
            let run = self.next_run();
            now = driver.begin_run(now, &run, None);
            now = self.find_out(question, driver, now);
            let known = self.answer_here(question, driver, now);
            answer = known.or_else(|| self.found_here(question).filter(|_| matches!(end, SearchEnd::Found)));
        }
        self.known.spoken_of.extend(question.things.iter().cloned());
        self.memory.asked(now, said, answer.as_deref());
        watcher.answered(said, answer.as_deref());
        let unknown = || Problem { kind: Kind::NotFound, ..Problem::nothing(&unknown(question)) };
        (answer.map_or_else(|| Outcome::Failed(unknown()), |_| Outcome::Done), now)
    }

    /// Answer from what is known, or from what the driver sees now.
    fn answer_here(&self, question: &RoomQuestion, driver: &mut dyn Driver, now: Time) -> Option<String> {
        if question.topic != Topic::View {
            return self.known_answer(question, &self.known);
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

    /// Request whose run may answer a question; `None` if no look helps.
    fn look_request(&self, question: &RoomQuestion) -> Option<String> {
        let thing = question.things.first()?;
        let name = &self.known.seen_scene(&self.setting.scene).called(thing);
        match question.topic {
            Topic::Location | Topic::Placed => Some(format!("find the {name}")),
            Topic::Open | Topic::Closed => Some(format!("go to the {name}")),
            Topic::Standing | Topic::Held | Topic::Holds | Topic::Contents | Topic::Existence => None,
            Topic::History | Topic::Activity | Topic::View => None,
        }
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
        let place_of = |id: &SmolStr| {
            let place = known.places(scene).into_iter().find(|one| one.thing == *id);
            place.map(|one| (one.relation, one.place))
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
                if let Some(id) = things.iter().find(|id| place_of(id).is_some_and(|(_, at)| at == *wanted)) {
                    return Some(format!("Yes, {} is {}.", the(scene, id), at(scene, wanted)));
                }
                let told: Option<Vec<String>> = things.iter().map(|id| self.located(id, known)).collect();
                let told = told.filter(|told| !told.is_empty())?;
                Some(format!("No. {}", told.join(" ")))
            }
            Topic::Contents => {
                let wanted = question.place.as_ref()?;
                let there = known.places(scene).into_iter().filter(|one| one.place == *wanted);
                let there: Vec<String> = there
                    .filter(|one| held.as_ref() != Some(&one.thing))
                    .map(|one| the(scene, &one.thing))
                    .collect();
                let at = at(scene, wanted);
                Some(match there.as_slice() {
                    [] => format!("I know of nothing {at}."),
                    [only] => format!("{} is {at}.", capital(only)),
                    several => format!("{} are {at}.", capital(&join(several))),
                })
            }
            Topic::Existence => Some(match things.as_slice() {
                [] => format!("I know of no {} here.", question.said),
                [first, ..] => {
                    let told = self.located(first, known);
                    format!("Yes. {}", told.unwrap_or_else(|| "I do not know where it is.".to_owned()))
                }
            }),
            Topic::History => Some(self.history()),
            Topic::Activity => {
                let doing: Vec<String> = self.memory.running().map(|step| step.call).collect();
                let doing = doing.iter().map(|call| format!("`{call}`")).collect::<Vec<_>>();
                Some(if doing.is_empty() {
                    "I am doing nothing.".to_owned()
                } else {
                    format!("I am busy with {}.", join(&doing))
                })
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
        let place = known.places(scene).into_iter().find(|one| one.thing == *id)?;
        Some(format!("{name} is {}.", at(scene, &place.place)))
    }

    /// Steps that were carried out, in words.
    fn history(&self) -> String {
        let scene = self.known.seen_scene(&self.setting.scene);
        let situation = RequestContext::new(&scene);
        let mut steps = Vec::new();
        for entry in self.memory.entries() {
            let MemoryEvent::Step { call, ended, .. } = &entry.what else { continue };
            let (primitive, args) = parts(call);
            let said = step_done(primitive, &args, &situation);
            match ended {
                StepEnd::Success(_) => steps.push(said),
                StepEnd::Failure { kind, .. } => steps.push(format!("tried `{call}`, which failed ({kind})")),
                StepEnd::Interrupted(_) => steps.push(format!("began `{call}`")),
            }
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

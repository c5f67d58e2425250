//! Perception in a conversation: what the robot sees and is told changes its scene, beliefs and plans.
use std::time::Duration;

use motet_compiler::CheckOptions;
use motet_planner::builtin::{PlanError, PlannedRequest};
use motet_planner::dialogue::{
    Conversation, DialogueObserver, DialogueSetup, Kind, Outcome, Person, Problem,
};
use motet_planner::inteliplan::exchange;
use motet_planner::prompt::{self, Prompt, StaticPrompt, TOKENS};
use motet_planner::{Builtin, PlanRequest, Planner};
use motet_robots::scene::{Entity, EntityShape, Placement, Scene};
use motet_runtime::{Event, Time};
use motet_sim::{Sim, SimOptions};
use motet_tests::setup;

/// The kitchen as it is, where a thing stands elsewhere than the robot was told.
fn with_thing(told: &Scene, id: &str, xyz: [f64; 3], (on, inside): (Option<&str>, Option<&str>)) -> Scene {
    let mut real = told.clone();
    let thing = real.entities.get_mut(id).unwrap();
    thing.pose = Some(Placement { xyz, rpy: [0.0; 3] });
    (thing.on, thing.inside) = (on.map(Into::into), inside.map(Into::into));
    real
}

/// The kitchen with a stapler that nobody told of.
fn with_stapler(told: &Scene, xyz: [f64; 3], on: &str) -> Scene {
    let mut real = told.clone();
    let stapler = Entity {
        kind: "Object".into(),
        class: "stapler".into(),
        names: vec!["blue stapler".into()],
        shape: Some(EntityShape::Box([0.12, 0.05, 0.06])),
        on: Some(on.into()),
        fixed: false,
        ..Entity::place("stapler".into(), Placement { xyz, rpy: [0.0; 3] })
    };
    real.entities.insert("stapler".into(), stapler);
    real
}

/// Answers in order, and notes questions and what follows from detections.
#[derive(Default)]
struct Beside {
    answers: Vec<&'static str>,
    asked: Vec<Kind>,
    questions: Vec<String>,
    noticed: Vec<String>,
}

impl Person for Beside {
    fn ask(&mut self, problem: &Problem) -> Option<String> {
        self.asked.push(problem.kind);
        self.questions.push(problem.question.clone());
        (!self.answers.is_empty()).then(|| self.answers.remove(0).to_owned())
    }
}

struct Ears<'a>(&'a mut Vec<String>);

impl DialogueObserver for Ears<'_> {
    fn event(&mut self, _now: Time, event: &Event) {
        if let Event::Noticed { query, answer } = event {
            self.0.push(format!("{query} = {answer}"));
        }
    }
}

/// Carries out a request of the HSR in a kitchen that is otherwise than it was told.
fn talk(real: impl Fn(&Scene) -> Scene, request: &str, answers: &[&'static str]) -> (Outcome, Beside, Sim) {
    talk_with("hsr", real, request, answers)
}

fn talk_with(
    robot: &str,
    real: impl Fn(&Scene) -> Scene,
    request: &str,
    answers: &[&'static str],
) -> (Outcome, Beside, Sim) {
    let (robot, scene) = (setup::robot(robot), setup::scene("kitchen"));
    let options = SimOptions { world: Some(real(&scene)), ..SimOptions::default() };
    let mut sim = Sim::new(&robot, &scene, options);
    let options = CheckOptions::default();
    let setting = DialogueSetup { robot, scene, domains: Vec::new(), geometry: None, options };
    let mut conversation = Conversation::new(&setting);
    let mut person = Beside { answers: answers.to_vec(), ..Beside::default() };
    let mut noticed = Vec::new();
    let outcome = conversation
        .carry_out(request, &mut Builtin, &mut sim, &mut person, &mut Ears(&mut noticed), Time::ZERO)
        .0;
    person.noticed = noticed;
    (outcome, person, sim)
}

/// Keeps the replies to questions.
#[derive(Default)]
struct Replies(Vec<String>);

impl DialogueObserver for Replies {
    fn answered(&mut self, _question: &str, answer: Option<&str>) {
        self.0.extend(answer.map(ToOwned::to_owned));
    }
}

/// Says one thing after the other to the HSR in a kitchen that is otherwise than it was told. Returns its
/// replies and its questions.
fn converse(
    real: impl Fn(&Scene) -> Scene,
    said: &[&str],
    answers: &[&'static str],
) -> (Vec<String>, Vec<String>, Sim) {
    let (robot, scene) = (setup::robot("hsr"), setup::scene("kitchen"));
    let options = SimOptions { world: Some(real(&scene)), ..SimOptions::default() };
    let mut sim = Sim::new(&robot, &scene, options);
    let options = CheckOptions::default();
    let setting = DialogueSetup { robot, scene, domains: Vec::new(), geometry: None, options };
    let (mut talk, mut now) = (Conversation::new(&setting), Time::ZERO);
    let (mut person, mut replies) =
        (Beside { answers: answers.to_vec(), ..Beside::default() }, Replies::default());
    for said in said {
        (_, now) = talk.carry_out(said, &mut Builtin, &mut sim, &mut person, &mut replies, now);
    }
    (replies.0, person.questions, sim)
}

/// The kitchen without a thing.
fn without(told: &Scene, id: &str) -> Scene {
    let mut real = told.clone();
    real.entities.shift_remove(id);
    real
}

#[test]
fn perception_question_first_looks_at_the_believed_place() {
    let gone = |told: &Scene| without(told, "sponge");
    let (replies, ..) = converse(gone, &["go to the sink", "is the sponge on the sink?"], &[]);
    assert_eq!(replies, ["No, I looked on the kitchen sink and saw no yellow sponge."]);
    let (replies, ..) = converse(Scene::clone, &["go to the sink", "is the sponge on the sink?"], &[]);
    assert_eq!(replies, ["Yes, the yellow sponge is on the kitchen sink."]);
}

#[test]
fn perception_question_if_there_is_a_thing_looks_for_it() {
    let stapler = |told: &Scene| with_stapler(told, [-1.72, 1.6, 1.03], "shelf");
    let (replies, ..) = converse(stapler, &["is there a stapler?"], &[]);
    assert_eq!(replies, ["Yes. The blue stapler is on the wall shelf."]);
    let (replies, ..) = converse(Scene::clone, &["is there a stapler?"], &[]);
    assert_eq!(replies, ["No, I know of no stapler here."]);
}

#[test]
fn perception_look_in_vain_closes_what_it_opened() {
    let gone = |told: &Scene| without(told, "sponge");
    let (_, questions, sim) = converse(gone, &["look for the sponge"], &["in the fridge", "leave it"]);
    assert_eq!((questions.len(), sim.holds("open", &["fridge_1"])), (2, Some(false)), "{questions:?}");
}

#[test]
fn perception_thing_in_a_persons_hand_is_asked_for() {
    let (_, questions, _) = converse(Scene::clone, &["bring me the coke", "put it on the counter"], &[]);
    assert_eq!(questions, ["You have the coke can. Put it down where I can reach it. Where is it then?"]);
}

#[test]
fn perception_told_place_reaches_the_driver() {
    let hidden = |told: &Scene| with_thing(told, "coke", [3.4, -0.6, 0.5], (None, Some("cupboard_1")));
    let (outcome, person, sim) = talk(hidden, "bring me the coke", &["It is in the cupboard."]);
    assert_eq!((&outcome, &person.asked[..]), (&Outcome::Done, &[Kind::NotFound][..]));
    assert_eq!(sim.holds("at", &["coke", "user"]), Some(true));
}

#[test]
fn perception_thing_in_view_elsewhere_is_fetched_without_a_question() {
    let moved = |told: &Scene| with_thing(told, "coke", [1.96, 0.5, 0.781], (Some("kitchen_table"), None));
    let (outcome, person, sim) = talk(moved, "bring me the coke", &[]);
    assert_eq!((&outcome, &person.asked[..]), (&Outcome::Done, &[][..]));
    assert_eq!(sim.holds("at", &["coke", "user"]), Some(true));
}

#[test]
fn perception_unknown_thing_is_named_by_its_label() {
    let stapler = |told: &Scene| with_stapler(told, [1.96, 0.5, 0.75], "kitchen_table");
    for request in ["bring me the blue stapler", "bring me the stapler", "bring me the blue thing"] {
        let (outcome, person, sim) = talk(stapler, request, &[]);
        assert_eq!((&outcome, &person.asked[..]), (&Outcome::Done, &[][..]), "{request}");
        assert_eq!(sim.holds("at", &["stapler", "user"]), Some(true), "{request}");
    }
}

#[test]
fn perception_during_a_run_is_noticed_by_the_engine() {
    // The shelf is behind the robot at the start.
    let stapler = |told: &Scene| with_stapler(told, [-1.72, 1.6, 1.03], "shelf");
    let (outcome, person, sim) = talk(stapler, "bring me the mug on the shelf", &[]);
    assert_eq!(outcome, Outcome::Done, "{:?}", person.asked);
    assert_eq!(sim.holds("at", &["mug_2", "user"]), Some(true));
    assert!(person.noticed.contains(&"on(stapler, shelf) = true".to_owned()), "{:?}", person.noticed);
}

#[test]
fn perception_thing_that_nobody_saw_is_looked_for() {
    for robot in ["hsr", "anymal_z1"] {
        // The shelf is behind the robot at the start.
        let stapler = |told: &Scene| with_stapler(told, [-1.72, 1.6, 1.03], "shelf");
        let (outcome, person, sim) = talk_with(robot, stapler, "bring me the stapler", &["Yes, please."]);
        assert_eq!(outcome, Outcome::Done, "{robot}: {:?}", person.questions);
        assert_eq!(sim.holds("at", &["stapler", "user"]), Some(true), "{robot}");
        let question = "I know of no stapler here. Shall I look for it, or what do you mean?";
        // The camera at the wrist of the ANYmal sees the shelf from the start.
        assert!(person.questions.iter().eq([question].iter().filter(|_| robot == "hsr")), "{robot}");
        // Who asks to look for it is not asked.
        let (outcome, person, _) = talk_with(robot, stapler, "find the stapler", &[]);
        assert_eq!((outcome, person.asked), (Outcome::Done, vec![]), "{robot}");
        // It is not there: the robot looks once, and says so.
        let (outcome, person, _) = talk_with(robot, Scene::clone, "bring me the stapler", &["look for it"]);
        assert!(matches!(outcome, Outcome::Failed(_)), "{robot}: {outcome:?}");
        let after = "I have looked for it and see no stapler. What do you mean?";
        assert_eq!(person.questions, [question, after], "{robot}");
    }
}

/// Keeps what a model would be shown, and plans without one.
struct PromptCapture(Vec<(String, String)>);

impl Planner for PromptCapture {
    fn plan(&mut self, ask: &PlanRequest<'_>) -> Result<PlannedRequest, PlanError> {
        let scene = ask.situation.scene;
        let prompt = Prompt {
            session: ask.session,
            robot: ask.robot,
            scene,
            situation: ask.situation,
            memory: ask.memory,
            bound: &[],
            lasting: &StaticPrompt::new(ask.session, ask.robot, scene),
            tokens: TOKENS,
            time: Duration::ZERO,
        };
        let named = motet_requests::named(ask.request, ask.situation);
        let seen = prompt::seen(ask.session, ask.robot, scene, &named, Duration::ZERO);
        self.0.push((prompt.write(ask.request).user, exchange::sight(&seen).0));
        Builtin.plan(ask)
    }
}

#[test]
fn perception_is_in_the_prompt_and_in_the_dialect() {
    let stapler = |told: &Scene| with_stapler(told, [1.96, 0.5, 0.75], "kitchen_table");
    let (robot, scene) = (setup::robot("hsr"), setup::scene("kitchen"));
    let options = SimOptions { world: Some(stapler(&scene)), ..SimOptions::default() };
    let mut sim = Sim::new(&robot, &scene, options);
    let options = CheckOptions::default();
    let setting = DialogueSetup { robot, scene, domains: Vec::new(), geometry: None, options };
    let (mut planner, mut person) = (PromptCapture(Vec::new()), Beside::default());
    let mut conversation = Conversation::new(&setting);
    conversation.carry_out("bring me the stapler", &mut planner, &mut sim, &mut person, &mut (), Time::ZERO);
    let (prompt, vision) = &planner.0[0];
    let line = prompt.lines().find(|line| line.starts_with("- stapler (Object)")).unwrap();
    assert!(
        line.contains("blue stapler; on kitchen_table; the camera saw it at 1.96, 0.50, 0.75 m"),
        "{line}"
    );
    assert_eq!(vision, "stapler: seen");
}

//! Recovery by what a person answers: after a thing turned out to be out of reach before anything moved, and
//! after it was not found; and what else a robot does by itself before it asks.

use std::sync::Arc;

use motet_compiler::{CheckOptions, Geometry};
use motet_geometry::planning::SearchBudget;
use motet_planner::Builtin;
use motet_planner::dialogue::{Conversation, DialogueSetup, Kind, Outcome, Person, Problem};
use motet_robots::builtin::{self, RobotWithBody};
use motet_robots::scene::{EntityShape, Placement, Scene};
use motet_runtime::Time;
use motet_sim::{Faults, Sim, SimOptions};
use motet_tests::setup;

/// Answers to a reach failure that is found at planning. The first four are those that an audit quotes, the
/// others say the same in other words, ask for something else, or give up.
const REACH: [(&str, Led); 19] = [
    ("I put it on the kitchen table", Led::Done),
    ("it is on the kitchen table now", Led::Done),
    ("take it from the kitchen table", Led::Done),
    ("the coke is on the kitchen table", Led::Done),
    ("bring me the water bottle instead", Led::Other),
    ("I moved it to the kitchen table", Led::Done),
    ("I have put it on the kitchen table for you", Led::Done),
    ("it's on the kitchen table", Led::Done),
    ("on the kitchen table", Led::Done),
    ("the kitchen table", Led::Done),
    ("look on the kitchen table", Led::Done),
    ("try the kitchen table", Led::Done),
    ("now it is on the dining table", Led::Done),
    ("you can find it on the kitchen table", Led::Done),
    ("get it from the kitchen table", Led::Done),
    ("try again", Led::Asked),
    ("leave it", Led::GivenUp),
    ("I took it down, it is on the kitchen table now", Led::Done),
    ("my wife put it on the kitchen table", Led::Done),
];

/// Answers to a thing that is not found, which is in the fridge. The audit quotes the first nine.
const FIND: [(&str, Led); 19] = [
    ("it is in the fridge", Led::Done),
    ("try the fridge", Led::Done),
    ("check the fridge", Led::Done),
    ("look in the fridge", Led::Done),
    ("the object is in the fridge", Led::Done),
    ("you have to open the fridge first", Led::Done),
    ("open the fridge and look inside", Led::Done),
    ("turn left", Led::Asked),
    ("look behind you", Led::Asked),
    ("open the fridge", Led::Done),
    ("I put it in the fridge", Led::Done),
    ("in the fridge", Led::Done),
    ("maybe the fridge", Led::Done),
    ("the coke is in the fridge", Led::Done),
    ("I think it is in the fridge", Led::Done),
    ("it should be in the fridge", Led::Done),
    ("go to the fridge", Led::Asked),
    ("have a look in the fridge", Led::Done),
    ("the coke can is inside the refrigerator", Led::Done),
];

/// Result to which an answer leads.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Led {
    /// The thing is brought.
    Done,
    /// Something else is done.
    Other,
    /// It is understood, and another question follows.
    Asked,
    GivenUp,
}

fn setting(robot: &str, scene: Scene) -> DialogueSetup {
    let RobotWithBody { robot, urdf } = builtin::robot(robot).unwrap();
    let geometry = Geometry::new(&robot, &urdf, &scene, None, SearchBudget::default());
    let (domains, options) = (Vec::new(), CheckOptions::default());
    DialogueSetup { robot, scene, domains, geometry: Some(Arc::new(geometry)), options }
}

/// The kitchen with a shelf above everybody's reach.
fn with_high_shelf() -> Scene {
    let mut scene = setup::scene("kitchen");
    let mut shelf = scene.entities["shelf"].clone();
    (shelf.id, shelf.names) = ("high_shelf".into(), vec!["high shelf".into()]);
    shelf.pose = Some(Placement { xyz: [1.0, -2.4, 1.88], rpy: [0.0; 3] });
    shelf.shape = Some(EntityShape::Box([0.8, 0.25, 0.04]));
    scene.entities.insert(shelf.id.clone(), shelf);
    // It looks away from the table, so that it knows only what it is told.
    scene.robot.base[2] = std::f64::consts::PI;
    scene
}

fn put(scene: &mut Scene, thing: &str, on: &str, xyz: [f64; 3]) {
    let thing = scene.entities.get_mut(thing).unwrap();
    (thing.on, thing.pose) = (Some(on.into()), Some(Placement { xyz, rpy: [0.0; 3] }));
}

/// Gives answers in order, and keeps what was asked.
struct Answers<'a>(&'a [&'a str], Vec<Problem>);

impl Person for Answers<'_> {
    fn ask(&mut self, problem: &Problem) -> Option<String> {
        self.1.push(problem.clone());
        let (first, rest) = self.0.split_first()?;
        self.0 = rest;
        Some((*first).to_owned())
    }
}

fn carry_out(
    setting: &DialogueSetup,
    sim: &mut Sim,
    request: &str,
    answers: &[&str],
) -> (Outcome, Vec<Problem>) {
    let mut talk = Conversation::new(setting);
    let mut person = Answers(answers, Vec::new());
    let (outcome, _) = talk.carry_out(request, &mut Builtin, sim, &mut person, &mut (), Time::ZERO);
    (outcome, person.1)
}

/// Checks what each answer leads to.
fn check(robot: &str, (told, real): (Scene, &Scene), answers: &[(&str, Led)], kind: Kind) {
    let setting = setting(robot, told);
    let mut wrong = Vec::new();
    for (answer, led) in answers {
        let mut sim = Sim::new(&setting.robot, real, SimOptions::default());
        let (outcome, asked) = carry_out(&setting, &mut sim, "bring me the coke", &[answer]);
        assert_eq!(asked.first().map(|problem| problem.kind), Some(kind), "{asked:?}");
        let is_brought = sim.holds("at", &["coke", "user"]) == Some(true);
        let is_understood = !asked.iter().any(|one| one.question.starts_with("I did not understand"));
        let found = match outcome {
            Outcome::Done if is_brought => Led::Done,
            Outcome::Done => Led::Other,
            Outcome::GivenUp => Led::GivenUp,
            Outcome::Failed(_) | Outcome::Declined(_) | Outcome::Stopped => Led::Asked,
        };
        if !is_understood || found != *led {
            wrong.push(format!("{robot}: {answer}: {found:?}, {:?}", asked.last()));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn recovery_from_a_reach_failure_at_planning_by_each_answer() {
    for robot in ["hsr", "anymal_z1"] {
        let mut told = with_high_shelf();
        let mut real = told.clone();
        put(&mut told, "coke", "high_shelf", [1.0, -2.4, 1.961]);
        put(&mut real, "coke", "kitchen_table", [2.0, 0.5, 0.781]);
        check(robot, (told, &real), &REACH, Kind::NotReachable);
    }
}

#[test]
fn recovery_from_a_thing_that_is_not_found_by_each_answer() {
    for robot in ["hsr", "anymal_z1"] {
        let told = setup::scene("kitchen");
        let mut real = told.clone();
        let coke = real.entities.get_mut("coke").unwrap();
        (coke.on, coke.pose, coke.inside) = (None, None, Some("fridge_1".into()));
        check(robot, (told, &real), &FIND, Kind::NotFound);
    }
}

#[test]
fn recovery_reason_is_in_a_persons_words_with_the_number() {
    let mut told = with_high_shelf();
    put(&mut told, "coke", "high_shelf", [1.0, -2.4, 1.961]);
    let setting = setting("hsr", told);
    let mut sim = Sim::new(&setting.robot, &setting.scene, SimOptions::default());
    let (_, asked) = carry_out(&setting, &mut sim, "bring me the coke", &[]);
    let [problem] = asked.as_slice() else { panic!("{asked:?}") };
    let question =
        "I cannot pick up the coke can: it stands at 1.96 m, I reach 1.42 m. What shall I do instead?";
    assert_eq!(problem.question, question);
    assert_eq!(problem.about.as_deref(), Some("coke"));
}

#[test]
fn recovery_told_place_is_judged_before_the_robot_goes_there() {
    // It is told to be where the arm does not get: geometry says so, though the exact pose is not known.
    let told = with_high_shelf();
    let mut real = told.clone();
    put(&mut real, "coke", "high_shelf", [1.0, -2.4, 1.961]);
    let setting = setting("hsr", told);
    let mut sim = Sim::new(&setting.robot, &real, SimOptions::default());
    let (_, asked) = carry_out(&setting, &mut sim, "bring me the coke", &["it is on the high shelf"]);
    let last = asked.last().unwrap();
    assert_eq!(last.kind, Kind::NotReachable, "{asked:?}");
    assert!(last.question.contains("it stands at 1.96 m, I reach 1.42 m"), "{}", last.question);
}

#[test]
fn recovery_refused_handover_is_asked_about_at_once() {
    let setting = setting("hsr", setup::scene("kitchen"));
    let refuses = r#"{"calls": [{"primitive": "handover", "nth": 1, "then": {"fails": "refused"}}]}"#;
    let faults = Faults::from_json(refuses).unwrap();
    let mut sim = Sim::new(&setting.robot, &setting.scene, SimOptions { faults, ..SimOptions::default() });
    let (outcome, asked) = carry_out(&setting, &mut sim, "bring me the coke", &["yes"]);
    assert_eq!(outcome, Outcome::Done, "{asked:?}");
    let questions: Vec<&str> = asked.iter().map(|problem| problem.question.as_str()).collect();
    assert_eq!(questions, ["You did not take the coke can. Shall I offer it again?"]);
}

#[test]
fn recovery_preference_settles_which_drink() {
    let setting = setting("hsr", setup::scene("kitchen"));
    let mut talk = Conversation::new(&setting);
    let mut now = Time::ZERO;
    let mut sim = Sim::new(&setting.robot, &setting.scene, SimOptions::default());
    let mut person = Answers(&[], Vec::new());
    for request in ["I prefer coke to water", "bring me something to drink"] {
        (_, now) = talk.carry_out(request, &mut Builtin, &mut sim, &mut person, &mut (), now);
    }
    assert_eq!(sim.holds("at", &["coke", "user"]), Some(true), "{:?}", person.1);
}

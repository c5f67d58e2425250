//! The loop around the planner: questions and their answers, tries after a failure, and requests that come
//! in between.
use motet_compiler::CheckOptions;
use motet_graph::{NodeId, NodeKind, Value};
use motet_planner::Builtin;
use motet_planner::dialogue::{
    Conversation, DialogueObserver, DialogueSetup, Kind, NoOperator, OnInstruction, Outcome, Person, Problem,
};
use motet_robots::scene::{Entity, EntityShape, Placement};
use motet_runtime::memory::Memory;
use motet_runtime::{Effect, EngineSettings, Pattern, Query, RunControl, RunEnd, Time, Truth};
use motet_sim::{Faults, Sim, SimOptions};
use motet_syntax::{FileId, Source, Sources};
use motet_tests::setup;

fn setting(robot: &str) -> DialogueSetup {
    let (robot, scene) = (setup::robot(robot), setup::scene("kitchen"));
    DialogueSetup { robot, scene, domains: Vec::new(), geometry: None, options: CheckOptions::default() }
}

/// The robot in a kitchen where the coke is in the cupboard, whatever it was told.
fn coke_in_cupboard(setting: &DialogueSetup) -> Sim {
    let mut real = setting.scene.clone();
    let coke = real.entities.get_mut("coke").unwrap();
    (coke.on, coke.pose, coke.inside) = (None, None, Some("cupboard_1".into()));
    Sim::new(&setting.robot, &real, SimOptions::default())
}

/// Gives answers in order, and keeps what was asked.
struct Answers(Vec<&'static str>, Vec<Problem>);

impl Person for Answers {
    fn ask(&mut self, problem: &Problem) -> Option<String> {
        self.1.push(problem.clone());
        (!self.0.is_empty()).then(|| self.0.remove(0).to_owned())
    }
}

fn talk(
    setting: &DialogueSetup,
    sim: &mut Sim,
    request: &str,
    answers: &[&'static str],
) -> (Outcome, Vec<Problem>, Memory) {
    let mut talk = Conversation::new(setting);
    let mut person = Answers(answers.to_vec(), Vec::new());
    let (outcome, _) = talk.carry_out(request, &mut Builtin, sim, &mut person, &mut (), Time::ZERO);
    (outcome, person.1, talk.memory)
}

#[test]
fn conversation_clear_request_is_done_without_a_question() {
    for robot in ["hsr", "anymal_z1"] {
        let setting = setting(robot);
        let mut sim = Sim::new(&setting.robot, &setting.scene, SimOptions::default());
        let (outcome, asked, _) = talk(&setting, &mut sim, "bring me the coke", &[]);
        assert_eq!(outcome, Outcome::Done, "{asked:?}");
        assert_eq!(sim.holds("at", &["coke", "user"]), Some(true));
    }
}

#[test]
fn conversation_of_two_mugs_the_one_that_is_meant_is_asked_for() {
    let setting = setting("hsr");
    let mut sim = Sim::new(&setting.robot, &setting.scene, SimOptions::default());
    let (outcome, asked, _) = talk(&setting, &mut sim, "bring me the mug", &["the blue one"]);
    assert_eq!(outcome, Outcome::Done);
    assert_eq!(asked[0].kind, Kind::AmbiguousReference);
    assert_eq!(
        asked[0].question,
        "I know two things that could be the mug: the red mug on the kitchen table and the blue mug on the \
         wall shelf. Which one?"
    );
    assert_eq!(sim.holds("at", &["mug_2", "user"]), Some(true));
}

#[test]
fn conversation_answer_that_states_a_fact_becomes_one() {
    let setting = setting("hsr");
    let mut sim = coke_in_cupboard(&setting);
    let (outcome, asked, _) = talk(&setting, &mut sim, "bring me the coke", &["it is in the cupboard"]);
    assert_eq!(outcome, Outcome::Done, "{asked:?}");
    assert_eq!(asked.iter().map(|problem| problem.kind).collect::<Vec<_>>(), [Kind::NotFound]);
    assert_eq!(sim.holds("at", &["coke", "user"]), Some(true));
    assert_eq!(sim.holds("open", &["cupboard_1"]), Some(false), "what was opened is closed again");
}

#[test]
fn conversation_step_that_merely_failed_is_tried_again_before_anyone_is_asked() {
    let setting = setting("hsr");
    let faults =
        Faults::from_json(r#"{"calls": [{"primitive": "pick", "nth": 1, "then": {"fails": "slipped"}}]}"#)
            .unwrap();
    let mut sim = Sim::new(&setting.robot, &setting.scene, SimOptions { faults, ..SimOptions::default() });
    let (outcome, asked, _) = talk(&setting, &mut sim, "bring me the coke", &[]);
    assert_eq!((outcome, asked.len()), (Outcome::Done, 0));
}

#[test]
fn conversation_where_there_is_no_room_it_is_asked_where_else() {
    let setting = setting("hsr");
    let blocked =
        |nth: u32| format!(r#"{{"primitive": "place", "nth": {nth}, "then": {{"fails": "blocked"}}}}"#);
    let sim = |times: u32| {
        let calls: Vec<String> = (1..=times).map(blocked).collect();
        let faults = Faults::from_json(&format!(r#"{{"calls": [{}]}}"#, calls.join(", "))).unwrap();
        Sim::new(&setting.robot, &setting.scene, SimOptions { faults, ..SimOptions::default() })
    };
    for answer in ["On the kitchen table.", "the kitchen table", "put it on the kitchen table instead"] {
        let mut sim = sim(1);
        let (outcome, asked, _) = talk(&setting, &mut sim, "put the sponge on the counter", &[answer]);
        assert_eq!(outcome, Outcome::Done, "{asked:?}");
        let [question] = asked.as_slice() else { panic!("{asked:?}") };
        assert_eq!(question.kind, Kind::NotReachable);
        assert!(question.question.contains("Where else shall I put the"), "{}", question.question);
        assert!(!question.options.iter().any(|option| option == "counter"), "{:?}", question.options);
        assert_eq!(sim.holds("on", &["sponge", "kitchen_table"]), Some(true), "{answer}");
    }
    // What is no place is not taken for one.
    let mut sim = sim(1);
    let (outcome, asked, _) =
        talk(&setting, &mut sim, "put the sponge on the counter", &["the moon", "leave it"]);
    assert_eq!(outcome, Outcome::GivenUp, "{asked:?}");
}

#[test]
fn conversation_drives_elsewhere_before_it_asks() {
    // The fridge stands by the counter: what is taken out of it could be put there from where the robot is,
    // and there is no room.
    let setting = setting("hsr");
    let mut real = setting.scene.clone();
    let coke = real.entities.get_mut("coke").unwrap();
    (coke.on, coke.pose, coke.inside) = (None, None, Some("fridge_1".into()));
    let fails = r#"{"calls": [{"primitive": "place", "nth": 1, "then": {"fails": "unreachable"}}]}"#;
    for faults in [Faults::default(), Faults::from_json(fails).unwrap()] {
        let mut sim = Sim::new(&setting.robot, &real, SimOptions { faults, ..SimOptions::default() });
        let (outcome, asked, _) =
            talk(&setting, &mut sim, "put the coke on the counter", &["It is in the fridge."]);
        assert_eq!(outcome, Outcome::Done, "{asked:?}");
        assert_eq!(asked.iter().map(|asked| asked.kind).collect::<Vec<_>>(), [Kind::NotFound]);
        assert_eq!(sim.holds("on", &["coke", "counter"]), Some(true));
    }
}

#[test]
fn conversation_where_nobody_answers_the_problem_is_the_outcome() {
    let setting = setting("hsr");
    let mut sim = Sim::new(&setting.robot, &setting.scene, SimOptions::default());
    let mut talk = Conversation::new(&setting);
    let (outcome, _) =
        talk.carry_out("wash the dishes", &mut Builtin, &mut sim, &mut NoOperator, &mut (), Time::ZERO);
    assert!(matches!(outcome, Outcome::Failed(problem) if problem.kind == Kind::AmbiguousTask));
}

/// Says something at a time, and counts the starts of picks.
struct Interrupts {
    at: Time,
    says: Option<&'static str>,
    swapped: usize,
    picked: usize,
}

impl DialogueObserver for Interrupts {
    fn request(&mut self, now: Time) -> Option<String> {
        if now < self.at {
            return None;
        }
        self.says.take().map(ToOwned::to_owned)
    }

    fn effect(&mut self, _now: Time, effect: &Effect) {
        if let Effect::Start { command, .. } = effect {
            self.picked += usize::from(command.primitive == "pick");
        }
    }

    fn swapped(&mut self, _now: Time, refusal: Option<&motet_runtime::SwapRefusal>) {
        assert!(refusal.is_none(), "{refusal:?}");
        self.swapped += 1;
    }
}

#[test]
fn conversation_request_in_between_takes_over() {
    for robot in ["hsr", "anymal_z1"] {
        let setting = setting(robot);
        let mut sim = Sim::new(&setting.robot, &setting.scene, SimOptions::default());
        let mut talk = Conversation::new(&setting);
        let mut watcher = Interrupts {
            at: Time::from_secs(3.0),
            says: Some("bring me the apple instead"),
            swapped: 0,
            picked: 0,
        };
        let (outcome, _) = talk.carry_out(
            "bring me the coke",
            &mut Builtin,
            &mut sim,
            &mut NoOperator,
            &mut watcher,
            Time::ZERO,
        );
        assert_eq!(outcome, Outcome::Done);
        assert_eq!((watcher.swapped, watcher.picked), (1, 1), "{robot}");
        assert_eq!(sim.holds("at", &["apple", "user"]), Some(true));
        assert_eq!(sim.holds("at", &["coke", "user"]), Some(false));
    }
}

/// A request and another at a time, where it comes while the robot drives, grasps or carries.
fn changes(robot: &str, request: &str, (at, says): (f64, &'static str), goal: (&str, [&str; 2])) {
    let setting = setting(robot);
    let mut sim = Sim::new(&setting.robot, &setting.scene, SimOptions::default());
    let mut talk = Conversation::new(&setting);
    let at = Time::from_secs(at);
    let mut watcher = Interrupts { at, says: Some(says), swapped: 0, picked: 0 };
    let (outcome, _) =
        talk.carry_out(request, &mut Builtin, &mut sim, &mut NoOperator, &mut watcher, Time::ZERO);
    assert_eq!(outcome, Outcome::Done, "{robot}: {request} {at:?}");
    assert_eq!(sim.holds(goal.0, &goal.1), Some(true), "{robot}: {request} {at:?}");
}

#[test]
fn conversation_what_the_scene_says_of_every_entity_is_not_forgotten_between_policies() {
    // Nothing was touched yet: where the mug is not is as well known as where it is.
    let goal = ("on", ["mug_1", "sink"]);
    changes("hsr", "put the red mug on the counter", (3.5, "no, put it on the sink"), goal);
    changes(
        "hsr",
        "put the apple in the drawer",
        (20.5, "put it in the fridge instead"),
        ("in", ["apple", "fridge_1"]),
    );
}

#[test]
fn conversation_robot_that_is_under_way_is_no_longer_where_it_was() {
    // It carries the coke away from the counter: to put it down there it has to drive back.
    let goal = ("at", ["bottle", "user"]);
    changes("hsr", "bring me the coke", (20.4, "actually, bring me the water bottle"), goal);
}

#[test]
fn conversation_thing_is_looked_for_where_it_is_believed_to_be() {
    let goal = ("at", ["apple", "user"]);
    changes("anymal_z1", "bring me the red mug", (21.5, "bring me the green apple instead"), goal);
}

#[test]
fn conversation_what_was_taken_is_put_back_where_it_was() {
    let setting = setting("hsr");
    let mut sim = Sim::new(&setting.robot, &setting.scene, SimOptions::default());
    let mut talk = Conversation::new(&setting);
    let mut now = Time::ZERO;
    let mut person = Answers(Vec::new(), Vec::new());
    for (request, place) in [("put the sponge on the counter", "counter"), ("put it back", "sink")] {
        let (outcome, then) = talk.carry_out(request, &mut Builtin, &mut sim, &mut person, &mut (), now);
        assert_eq!((outcome, &person.1), (Outcome::Done, &Vec::new()), "{request}");
        assert_eq!(sim.holds("on", &["sponge", place]), Some(true), "{request}");
        now = then;
    }
}

/// A picking hand that slips each time.
fn slipping(setting: &DialogueSetup) -> Sim {
    let faults = r#"{"calls": [{"primitive": "pick", "then": {"fails": "slipped"}}]}"#;
    let faults = Faults::from_json(faults).unwrap();
    Sim::new(&setting.robot, &setting.scene, SimOptions { faults, ..SimOptions::default() })
}

#[test]
fn conversation_does_not_take_no_for_yes() {
    let setting = setting("hsr");
    for no in [
        "No, leave it alone!",
        "please don't",
        "nah",
        "not now",
        "stop, that is dangerous!",
        "I'll do it myself",
    ] {
        let (outcome, asked, _) = talk(&setting, &mut slipping(&setting), "bring me the coke", &[no, "yes"]);
        assert_eq!((outcome, asked.len()), (Outcome::GivenUp, 1), "{no}: {asked:?}");
    }
}

#[test]
fn conversation_answer_that_is_not_understood_is_asked_for_again_and_moves_nothing() {
    let setting = setting("hsr");
    let mut sim = slipping(&setting);
    let (outcome, asked, _) =
        talk(&setting, &mut sim, "bring me the coke", &["what?", "wait a moment", "no"]);
    assert_eq!(outcome, Outcome::GivenUp);
    let questions: Vec<&str> = asked.iter().map(|problem| problem.question.as_str()).collect();
    let [first, second, third] = questions.as_slice() else { panic!("{questions:?}") };
    assert!(first.ends_with("Shall I try again?"), "{first}");
    assert_eq!((*second, *third), (format!("I did not understand that. {first}").as_str(), *second));
}

/// The first request with a line that is said after three seconds.
fn says(request: &str, line: &'static str, answers: &[&'static str]) -> (Outcome, Vec<Problem>, Sim) {
    let setting = setting("hsr");
    let mut sim = Sim::new(&setting.robot, &setting.scene, SimOptions::default());
    let mut talk = Conversation::new(&setting);
    let mut watcher = Interrupts { at: Time::from_secs(3.0), says: Some(line), swapped: 0, picked: 0 };
    let mut person = Answers(answers.to_vec(), Vec::new());
    let (outcome, _) = talk.carry_out(request, &mut Builtin, &mut sim, &mut person, &mut watcher, Time::ZERO);
    (outcome, person.1, sim)
}

#[test]
fn conversation_stops_a_moving_robot_when_told_to() {
    for line in ["stop", "never mind", "that is enough", "leave it, please"] {
        let (outcome, asked, sim) = says("bring me the coke", line, &[]);
        assert_eq!((outcome, asked.len()), (Outcome::GivenUp, 0), "{line}");
        assert_eq!(sim.holds("at", &["coke", "user"]), Some(false), "{line}");
    }
}

#[test]
fn conversation_fact_that_is_said_meanwhile_changes_the_plan_and_not_the_request() {
    let setting = setting("hsr");
    let mut sim = coke_in_cupboard(&setting);
    let mut talk = Conversation::new(&setting);
    let line = Some("the coke is in the cupboard");
    let mut watcher = Interrupts { at: Time::ZERO, says: line, swapped: 0, picked: 0 };
    let request = "bring me the coke";
    let (outcome, _) =
        talk.carry_out(request, &mut Builtin, &mut sim, &mut NoOperator, &mut watcher, Time::ZERO);
    assert_eq!(outcome, Outcome::Done);
    assert_eq!(sim.holds("at", &["coke", "user"]), Some(true));
}

#[test]
fn conversation_fact_alone_is_no_request() {
    let setting = setting("hsr");
    let mut sim = Sim::new(&setting.robot, &setting.scene, SimOptions::default());
    let (outcome, asked, _) = talk(&setting, &mut sim, "the coke is in the fridge", &[]);
    assert!(matches!(outcome, Outcome::Failed(problem) if problem.kind == Kind::AmbiguousTask));
    assert_eq!(asked[0].question, "I take note of that. What shall I do?");
}

#[test]
fn conversation_what_was_asked_for_before_is_not_forgotten() {
    // More of it.
    let (outcome, asked, sim) = says("bring me the coke", "also bring me the apple", &[]);
    assert_eq!((outcome, asked.len()), (Outcome::Done, 0));
    for thing in ["coke", "apple"] {
        assert_eq!(sim.holds("at", &[thing, "user"]), Some(true), "{thing}");
    }
    // Something else first.
    let (outcome, asked, sim) = says("bring me the coke", "bring me the apple", &["yes"]);
    assert_eq!(outcome, Outcome::Done);
    assert_eq!(asked[0].question, "That is done. Shall I go on with \"bring me the coke\"?");
    assert_eq!(sim.holds("at", &["coke", "user"]), Some(true));
    // The first one is not done if nobody wants it any more, or if nobody answers.
    let (outcome, asked, _) = says("bring me the coke", "bring me the apple", &["no"]);
    assert_eq!((outcome, asked.len()), (Outcome::GivenUp, 1));
    let (outcome, asked, _) = says("bring me the coke", "bring me the apple", &[]);
    assert_eq!(outcome, Outcome::Failed(asked[0].clone()));
    // Who replaces it says so.
    let (outcome, asked, _) = says("bring me the coke", "actually, bring me the apple", &[]);
    assert_eq!((outcome, asked.len()), (Outcome::Done, 0));
    // What could not be done is not done, whatever else was.
    let setting = setting("hsr");
    let mut sim = coke_in_cupboard(&setting);
    let (outcome, asked, _) = talk(&setting, &mut sim, "bring me the coke", &["bring me the apple"]);
    assert_eq!((outcome, asked.len()), (Outcome::Failed(asked[1].clone()), 2), "{asked:?}");
    // Nothing that is understood.
    let (outcome, asked, sim) = says("bring me the coke", "faster", &["go on"]);
    assert_eq!(outcome, Outcome::Done, "{asked:?}");
    assert!(asked[0].question.ends_with("Shall I go on with \"bring me the coke\"?"), "{asked:?}");
    assert_eq!(sim.holds("at", &["coke", "user"]), Some(true));
}

#[test]
fn conversation_who_asks_back_is_answered_and_asked_again() {
    let setting = setting("hsr");
    for back in ["where is the coke?", "is the fridge open?", "what do you hold?", "what did you do?"] {
        let mut sim = Sim::new(&setting.robot, &setting.scene, SimOptions::default());
        let answers = [back, "the red one"];
        let (outcome, asked, _) = talk(&setting, &mut sim, "bring me the mug", &answers);
        assert_eq!((outcome, asked.len()), (Outcome::Done, 2), "{back}");
        assert_eq!(asked[0].question, asked[1].question, "{back}");
        assert_eq!(sim.holds("at", &["coke", "user"]), Some(false), "{back}");
        assert_eq!(sim.holds("at", &["mug_1", "user"]), Some(true), "{back}");
    }
}

#[test]
fn conversation_question_that_nobody_answers_is_quoted() {
    let setting = setting("hsr");
    let session = setup::session(Some(&setting.robot), Some(&setting.scene), &mut Sources::default()).0;
    let source = Source::new("p.motet", "policy p for hsr { let a = ask(\"Shall I bring it?\") say(a) }");
    let graph = session.compile(&motet_syntax::read(&source, FileId(9)), None).graph.unwrap();
    let node = graph.nodes.iter().position(|node| matches!(node.kind, NodeKind::Call(_))).unwrap();
    let end =
        RunEnd::Failed { kind: "refused".into(), why: None, node: NodeId(u32::try_from(node).unwrap()) };
    let problem = Problem::of_run(&end, (&graph, &[]), &setting.scene).unwrap();
    assert_eq!(problem.question, "Nobody answered \"Shall I bring it?\". Shall I ask again?");
}

/// Lines at times, with what was answered and held.
#[derive(Default, Debug)]
struct Lines {
    says: Vec<(f64, &'static str)>,
    answers: Vec<Option<String>>,
    held: Vec<(f64, bool)>,
    now: f64,
    policies: usize,
}

impl DialogueObserver for Lines {
    fn reached(&mut self, now: Time) -> RunControl {
        self.now = now.secs();
        RunControl::Continue
    }

    fn at_least_every(&self) -> Time {
        Time::from_secs(0.1)
    }

    fn planned(
        &mut self,
        _: &motet_planner::builtin::PlannedRequest,
        _: &std::sync::Arc<motet_graph::Graph>,
    ) {
        self.policies += 1;
    }

    fn held(&mut self, is_held: bool) {
        self.held.push((self.now, is_held));
    }

    fn answered(&mut self, _question: &str, answer: Option<&str>) {
        self.answers.push(answer.map(ToOwned::to_owned));
    }

    fn request(&mut self, now: Time) -> Option<String> {
        let is_due = self.says.first().is_some_and(|(at, _)| now >= Time::from_secs(*at));
        is_due.then(|| self.says.remove(0).1.to_owned())
    }
}

/// A request with lines at times: its outcome, the end, and the observer.
fn carried_out(
    talk: &mut Conversation<'_>,
    sim: &mut Sim,
    request: &str,
    says: &[(f64, &'static str)],
) -> (Outcome, f64, Lines) {
    let mut lines = Lines { says: says.to_vec(), ..Lines::default() };
    let from = sim.now();
    let (outcome, end) = talk.carry_out(request, &mut Builtin, sim, &mut NoOperator, &mut lines, from);
    (outcome, end.secs(), lines)
}

#[test]
fn conversation_keeps_still_until_it_may_go_on() {
    let setting = setting("hsr");
    let new = || Sim::new(&setting.robot, &setting.scene, SimOptions::default());
    let (mut sim, mut talk) = (new(), Conversation::new(&setting));
    let (outcome, plain, _) = carried_out(&mut talk, &mut sim, "bring me the coke", &[]);
    assert_eq!(outcome, Outcome::Done);
    let (mut sim, mut talk) = (new(), Conversation::new(&setting));
    let says = [(2.0, "wait"), (5.0, "what are you doing?"), (12.0, "go on")];
    let (outcome, end, lines) = carried_out(&mut talk, &mut sim, "bring me the coke", &says);
    assert_eq!(outcome, Outcome::Done);
    assert_eq!(lines.held.iter().map(|(_, is_held)| *is_held).collect::<Vec<_>>(), [true, false]);
    assert!((end - plain - 10.0).abs() < 0.5, "{plain} s and {end} s");
    assert_eq!(lines.answers, [Some("I am looking for the coke can.".to_owned())]);
    // Stopped where it keeps still, it does not move any more.
    let (mut sim, mut talk) = (new(), Conversation::new(&setting));
    let (outcome, end, _) =
        carried_out(&mut talk, &mut sim, "bring me the coke", &[(2.0, "wait"), (6.0, "stop")]);
    assert_eq!(outcome, Outcome::GivenUp);
    assert!((6.0..6.5).contains(&end), "{end}");
}

#[test]
fn conversation_pauses_for_an_instruction_if_it_shall() {
    let setting = setting("hsr");
    for (on_instruction, is_held) in [(OnInstruction::GoOn, false), (OnInstruction::Pause, true)] {
        let mut sim = Sim::new(&setting.robot, &setting.scene, SimOptions::default());
        let mut talk =
            Conversation::new(&setting).with_runs("test", EngineSettings::default(), on_instruction);
        let says = [(3.0, "where is the apple?"), (4.0, "bring me the apple instead")];
        let (outcome, _, lines) = carried_out(&mut talk, &mut sim, "bring me the coke", &says);
        assert_eq!((outcome, lines.policies), (Outcome::Done, 2));
        assert_eq!(sim.holds("at", &["apple", "user"]), Some(true));
        let held: Vec<bool> = lines.held.iter().map(|(_, is_held)| *is_held).collect();
        assert_eq!(held, if is_held { vec![true, false] } else { vec![] });
        assert_eq!(lines.answers.len(), 1);
    }
}

#[test]
fn conversation_looks_where_it_does_not_know() {
    // Without a step of its own, and then at one surface after the other.
    for (xyz, on, policies) in [([1.98, 0.5, 0.77], "kitchen_table", 0), ([-1.72, 1.0, 1.05], "shelf", 2)] {
        let mut setting = setting("hsr");
        let coke = setting.scene.entities.get_mut("coke").unwrap();
        let pose = Some(Placement { xyz, ..Placement::default() });
        let there = Entity { on: Some(on.into()), pose, ..coke.clone() };
        (coke.on, coke.pose) = (None, None);
        let mut world = setting.scene.clone();
        world.entities.insert("coke".into(), there);
        let options = SimOptions { world: Some(world), ..SimOptions::default() };
        let mut sim = Sim::new(&setting.robot, &setting.scene, options);
        let mut talk = Conversation::new(&setting);
        let (outcome, _, lines) = carried_out(&mut talk, &mut sim, "where is the coke?", &[]);
        assert_eq!((outcome, lines.policies), (Outcome::Done, policies), "{:?}", lines.answers);
        assert!(lines.answers[0].as_ref().unwrap().starts_with("The coke can is"), "{:?}", lines.answers);
        // What was seen is remembered.
        let (outcome, _, lines) = carried_out(&mut talk, &mut sim, "where is the coke?", &[]);
        assert_eq!((outcome, lines.policies), (Outcome::Done, 0), "{:?}", lines.answers);
    }
}

#[test]
fn conversation_knows_where_it_saw_a_thing_that_nobody_told_of() {
    let setting = setting("hsr");
    let mut world = setting.scene.clone();
    let stapler = Entity {
        kind: "Object".into(),
        class: "stapler".into(),
        names: vec!["blue stapler".into()],
        shape: Some(EntityShape::Box([0.12, 0.04, 0.06])),
        on: Some("shelf".into()),
        fixed: false,
        ..Entity::place("stapler".into(), Placement { xyz: [-1.72, 1.0, 1.05], rpy: [0.0; 3] })
    };
    world.entities.insert("stapler".into(), stapler);
    let options = SimOptions { world: Some(world), ..SimOptions::default() };
    let mut sim = Sim::new(&setting.robot, &setting.scene, options);
    let mut talk = Conversation::new(&setting);
    // It looks for it once.
    for policies in [1, 0] {
        let (outcome, _, lines) = carried_out(&mut talk, &mut sim, "where is the stapler?", &[]);
        assert_eq!((outcome, lines.policies), (Outcome::Done, policies));
        assert_eq!(lines.answers, [Some("The blue stapler is on the wall shelf.".to_owned())]);
    }
}

/// Asks questions in turn, and compares the answers and the number of policies that each took.
fn check_answers(talk: &mut Conversation<'_>, sim: &mut Sim, asked: &[(&'static str, Option<&str>, usize)]) {
    for (question, answer, policies) in asked {
        let (_, _, lines) = carried_out(talk, sim, question, &[]);
        assert_eq!(lines.answers, [answer.map(ToOwned::to_owned)], "{question}");
        assert_eq!(lines.policies, *policies, "{question}");
    }
}

#[test]
fn conversation_remembers_what_it_did_not_see() {
    let setting = setting("hsr");
    let mut world = setting.scene.clone();
    let coke = world.entities.get_mut("coke").unwrap();
    (coke.on, coke.pose, coke.inside) = (None, None, Some("cupboard_1".into()));
    let options = SimOptions { world: Some(world), ..SimOptions::default() };
    let mut sim = Sim::new(&setting.robot, &setting.scene, options);
    let mut talk = Conversation::new(&setting);
    let mut person = Answers(vec!["where is the coke?", "leave it"], Vec::new());
    let mut lines = Lines::default();
    let request = "bring me the coke";
    let (outcome, _) = talk.carry_out(request, &mut Builtin, &mut sim, &mut person, &mut lines, Time::ZERO);
    assert_eq!(outcome, Outcome::GivenUp);
    let unknown = "I do not know where the coke can is. I looked on the kitchen counter and did not see it.";
    assert_eq!(lines.answers, [Some(unknown.to_owned())]);
    let missed = "No, I looked on the kitchen counter and saw no coke can.";
    let tried = "I tried looking for the coke can, without success (not found).";
    let there = "The coke can is in the kitchen cupboard.";
    check_answers(
        &mut talk,
        &mut sim,
        &[
            ("is the coke on the counter?", Some(missed), 0),
            ("what did you do?", Some(tried), 0),
            // From where it is, and at one surface after the other.
            ("where is the coke?", None, 2),
            ("what is in the cupboard?", Some(there), 2),
            ("where is the coke?", Some(there), 0),
            ("is the coke on the counter?", Some(&format!("No. {there}")), 0),
        ],
    );
    let (_, _, lines) = carried_out(&mut talk, &mut sim, "what have you seen?", &[]);
    assert!(lines.answers[0].as_ref().unwrap().contains("the coke can in the kitchen cupboard"), "{lines:?}");
}

#[test]
fn conversation_looks_into_what_is_closed_and_closes_it_again() {
    let setting = setting("hsr");
    let mut sim = Sim::new(&setting.robot, &setting.scene, SimOptions::default());
    let mut talk = Conversation::new(&setting);
    check_answers(
        &mut talk,
        &mut sim,
        &[
            ("is the drawer empty?", Some("I looked in the top drawer and saw nothing."), 2),
            ("what is in the drawer?", Some("I looked in the top drawer and saw nothing."), 0),
            ("is there milk in the fridge?", Some("No, I looked in the refrigerator and saw no milk."), 2),
        ],
    );
    for container in ["drawer_1", "fridge_1"] {
        assert_eq!(sim.holds("open", &[container]), Some(false), "{container}");
    }
    // What was seen there counts until the next task.
    carried_out(&mut talk, &mut sim, "bring me the coke", &[]);
    let empty = "I looked in the top drawer and saw nothing.";
    check_answers(&mut talk, &mut sim, &[("what is in the drawer?", Some(empty), 2)]);
}

#[test]
fn conversation_question_moves_nothing_that_is_known() {
    let setting = setting("hsr");
    let mut sim = Sim::new(&setting.robot, &setting.scene, SimOptions::default());
    let mut talk = Conversation::new(&setting);
    let reach = "Yes, I can reach the coke can, as far as I can tell without a motion.";
    let mugs = "I know of 2: the red mug and the blue mug.";
    check_answers(
        &mut talk,
        &mut sim,
        &[
            ("can you reach the coke?", Some(reach), 0),
            ("did you bring the coke?", Some("No. The coke can is on the kitchen counter."), 0),
            ("how many mugs are there?", Some(mugs), 0),
            ("is anything in your hand?", Some("I hold nothing."), 0),
            ("how far away is the apple?", Some("The green apple is about 2.1 m away."), 0),
        ],
    );
    assert_eq!(sim.holds("holding", &["coke"]), Some(false));
    carried_out(&mut talk, &mut sim, "bring me the coke", &[]);
    check_answers(
        &mut talk,
        &mut sim,
        &[
            ("where is the coke?", Some("You have the coke can."), 0),
            ("did you bring the coke?", Some("Yes, you have the coke can."), 0),
        ],
    );
}

#[test]
fn conversation_says_of_a_search_that_ended_early_nothing_that_it_did_not_see() {
    let mut setting = setting("hsr");
    let coke = setting.scene.entities.get_mut("coke").unwrap();
    (coke.on, coke.pose) = (None, None);
    for (said, outcome, answer) in [
        ("bring me the apple instead", Outcome::Done, None),
        ("stop", Outcome::GivenUp, None),
        ("the coke is on the shelf", Outcome::Done, Some("The coke can is on the wall shelf.")),
    ] {
        let mut world = setting.scene.clone();
        world.entities.shift_remove("coke");
        let options = SimOptions { world: Some(world), ..SimOptions::default() };
        let mut sim = Sim::new(&setting.robot, &setting.scene, options);
        let mut talk = Conversation::new(&setting);
        let (ended, _, lines) = carried_out(&mut talk, &mut sim, "where is the coke?", &[(10.0, said)]);
        assert_eq!(ended, outcome, "{said}: {:?}", lines.answers);
        assert_eq!(lines.answers.iter().flatten().next().map(String::as_str), answer, "{said}");
    }
}

#[test]
fn conversation_begins_in_the_state_that_it_was_told() {
    let setting = setting("hsr");
    let fact = |fluent: &str, args: &[Value]| Query::Fact {
        fluent: fluent.into(),
        args: args.iter().cloned().map(Pattern::Is).collect(),
    };
    let coke = Value::Entity("coke".into());
    let facts = [
        (fact("on", &[coke.clone(), Value::Entity("counter".into())]), Truth::False),
        (fact("holding", &[coke]), Truth::True),
        (fact("free", &[Value::Case("hand".into())]), Truth::False),
    ];
    let options = SimOptions::default().with_facts(facts.clone());
    let mut sim = Sim::new(&setting.robot, &setting.scene, options);
    let mut talk = Conversation::new(&setting);
    talk.tell(facts);
    let (_, _, lines) = carried_out(&mut talk, &mut sim, "what do you hold?", &[]);
    assert_eq!(lines.answers, [Some("I hold the coke can.".to_owned())]);
    let (outcome, _, _) = carried_out(&mut talk, &mut sim, "put it on the kitchen table", &[]);
    assert_eq!(outcome, Outcome::Done);
    assert_eq!(sim.holds("on", &["coke", "kitchen_table"]), Some(true));
}

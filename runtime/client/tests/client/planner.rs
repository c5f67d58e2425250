//! Replies of a model, good and bad, up to what the robot does with them.

use std::collections::VecDeque;
use std::time::Duration;

use crate::kitchen::{Heard, brisk, carry_out, carry_out_with, planner, right, session, setting};
use crate::server::{Act, Server};
use motet_client::Client;
use motet_decode::{AcceptorFactory, Grammar, Subset};
use motet_planner::builtin::{self, PlannedRequest};
use motet_planner::dialogue::{Conversation, DialogueObserver, NoOperator, Outcome, Person, Problem};
use motet_planner::model::{
    Finish, Message, Model, ModelError, ModelPlanner, Reply, ReplyEvent, Settings, Start, StreamReader,
    StreamVerdict,
};
use motet_requests::RequestContext;
use motet_runtime::{Effect, SwapRefusal, Time};
use motet_sim::{Sim, SimOptions};

const COKE: &str = "bring me the coke";

/// Plays a script for a request; how it ended, and what happened.
fn play(script: Vec<Act>) -> (Outcome, Vec<String>, Server) {
    let (setting, server, heard) = (setting(), Server::new(script), Heard::default());
    let (outcome, _) = carry_out(&setting, &mut planner(brisk(&server), &heard), COKE);
    let heard = heard.0.borrow().clone();
    (outcome, heard, server)
}

#[test]
fn model_planner_right_reply_is_carried_out_however_it_is_written() {
    let line = right(&setting(), COKE);
    let value: serde_json::Value = serde_json::from_str(&line).unwrap();
    let indented = serde_json::to_string_pretty(&value).unwrap();
    let fenced = format!("Sure. Here is the policy:\n```json\n{indented}\n```\nAnything else?");
    let thought = format!("<think>\nA {{brace}} and a coke.\n</think>\n\n{line}");
    let setting = setting();
    let situation = RequestContext::new(&setting.scene);
    let planned = builtin::answer(&session(), Some(&setting.robot), COKE, &situation).unwrap().planned;
    let text = planned.text;
    for reply in [line, indented, fenced, thought, text] {
        let (outcome, heard, _) = play(vec![Act::says(reply.clone())]);
        assert_eq!(outcome, Outcome::Done, "{reply}: {heard:?}");
        assert_eq!(heard, ["asked 0", "taken"], "{reply}");
    }
}

#[test]
fn model_planner_reply_that_is_wrong_goes_back_whole_with_the_reason() {
    let right = right(&setting(), COKE);
    let wrong = right.replacen("\"coke\"", "\"teapot_of_brown_betty\"", 1);
    let worse = right.replacen("\"coke\"", "\"urn_of_the_ancients\"", 1);
    let script = vec![Act::says(wrong.clone()), Act::says(worse.clone()), Act::says(right)];
    let (outcome, heard, server) = play(script);
    assert_eq!(outcome, Outcome::Done, "{heard:?}");
    assert_eq!(heard[0], "asked 0");
    assert!(heard[1].contains("teapot_of_brown_betty"), "{heard:?}");
    assert_eq!(heard[4..], ["asked 2", "taken"], "{heard:?}");
    // The model sees all that it wrote, and all that was found.
    let last = server.heard()[2].body["messages"].clone();
    let message = |at: usize| {
        (last[at]["role"].as_str().unwrap().to_owned(), last[at]["content"].as_str().unwrap().to_owned())
    };
    assert_eq!((message(2), message(4)), (("assistant".into(), wrong), ("assistant".into(), worse)));
    assert!(message(3).1.contains("teapot_of_brown_betty"), "{last}");
    assert!(message(5).1.contains("urn_of_the_ancients"), "{last}");
}

#[test]
fn model_planner_policy_that_does_something_else_goes_back_once_and_then_to_the_person() {
    let nothing = r#"{"motet":1,"policy":"idle","robot":"hsr","steps":[{"end":"done"}]}"#.to_owned();
    let apple = right(&setting(), "bring me the green apple");
    for wrong in [nothing, apple] {
        let (outcome, heard, _) = play(vec![Act::says(wrong.clone()), Act::says(right(&setting(), COKE))]);
        assert_eq!(outcome, Outcome::Done, "{heard:?}");
        assert!(heard[1].contains("at(coke, user)"), "{heard:?}");
        assert_eq!(heard[2..], ["asked 1", "taken"], "{heard:?}");
        // A model that says so again may know better what was meant, so the person decides.
        let (outcome, heard, _) = play(vec![Act::says(wrong.clone())]);
        let Outcome::Failed(problem) = outcome else { panic!("{outcome:?}") };
        assert!(problem.question.contains("at(coke, user)"), "{problem:?}");
        assert_eq!(heard.iter().filter(|line| line.starts_with("asked")).count(), 2, "{heard:?}");
        let (setting, server, heard) = (setting(), Server::new(vec![Act::says(wrong)]), Heard::default());
        let mut planner = planner(brisk(&server), &heard);
        let (outcome, _) = carry_out_with(&setting, &mut planner, &mut Says(Some("yes, do it")), COKE);
        assert_eq!(outcome, Outcome::Done, "{:?}", heard.0.borrow());
    }
}

#[test]
fn model_planner_goal_does_not_bind_a_reply_that_says_asks_or_declines() {
    let policy = |steps: &str| format!(r#"{{"motet":1,"policy":"p","robot":"hsr","steps":[{steps}]}}"#);
    let says = r#"{"do":"say","text":"I know of no coke"}"#;
    let searches = r#"{"try":[{"do":"search","what":"coke","around":"counter"},{"do":"pick","object":"coke"},
        {"do":"go","to":"user"},{"do":"handover","object":"coke","to":"user"}],
        "catch":[{"on":["not_found"],"steps":[{"do":"say","text":"it is not there"}]}]}"#;
    for steps in [says.to_owned(), format!(r#"{{"do":"go","to":"user"}},{says}"#), searches.to_owned()] {
        let (outcome, heard, _) = play(vec![Act::says(policy(&steps))]);
        assert_eq!((outcome, heard.len()), (Outcome::Done, 2), "{steps}: {heard:?}");
    }
    // A goal that is read from other words than the name of the thing is only a guess.
    let (setting, heard) = (setting(), Heard::default());
    let server = Server::new(vec![Act::says(right(&setting, "bring me the green apple"))]);
    let (outcome, _) = carry_out(&setting, &mut planner(brisk(&server), &heard), "bring me the soda");
    assert_eq!(outcome, Outcome::Done);
    assert_eq!(*heard.0.borrow(), ["asked 0", "unmet at(coke, user)", "taken"]);
}

#[test]
fn model_planner_slip_that_has_a_known_fix_is_mended_without_another_round() {
    let wrong = right(&setting(), COKE).replacen("\"object\":\"coke\"", "\"object\":\"cokee\"", 1);
    let (outcome, heard, _) = play(vec![Act::says(wrong)]);
    assert_eq!((outcome, heard.len()), (Outcome::Done, 3), "{heard:?}");
    assert!(heard[1].starts_with("mended ") && heard[1].contains("coke"), "{heard:?}");
}

#[test]
fn model_planner_fix_that_changes_the_steps_is_left_to_the_model() {
    let right = right(&setting(), COKE);
    let mut value: serde_json::Value = serde_json::from_str(&right).unwrap();
    value["steps"].as_array_mut().unwrap().remove(0);
    let wrong = value.to_string();
    let (outcome, heard, _) = play(vec![Act::says(wrong.clone()), Act::says(right)]);
    assert_eq!(outcome, Outcome::Done, "{heard:?}");
    assert!(heard[1].starts_with("refused "), "{heard:?}");
    assert_eq!(heard[heard.len() - 2..], ["asked 1", "taken"], "{heard:?}");
    // To a model that keeps to it the person is asked.
    let (outcome, heard, _) = play(vec![Act::says(wrong)]);
    assert_eq!(heard.iter().filter(|line| line.starts_with("asked")).count(), 2, "{heard:?}");
    let Outcome::Failed(problem) = outcome else { panic!("{outcome:?}") };
    assert!(problem.question.starts_with("I am not sure of my plan: "), "{problem:?}");
}

#[test]
fn model_planner_reply_that_stays_wrong_becomes_a_question() {
    let wrong = |name: &str| Act::says(format!(r#"{{"motet":1,"policy":"p","steps":[{{"do":"{name}"}}]}}"#));
    let (outcome, heard, _) = play(["juggle", "dance", "sing", "swim"].map(wrong).to_vec());
    assert_eq!(heard.iter().filter(|line| line.starts_with("asked")).count(), 4, "{heard:?}");
    let Outcome::Failed(problem) = outcome else { panic!("{outcome:?}") };
    assert!(problem.question.starts_with("I cannot do that"), "{problem:?}");
}

#[test]
fn model_planner_question_or_refusal_in_prose_is_for_the_person() {
    for (words, question) in [
        ("I am sorry, I cannot do that.", "I am sorry, I cannot do that. What shall I do instead?"),
        ("Do you want the red can\nor the blue one?", "Do you want the red can or the blue one?"),
    ] {
        let (outcome, heard, _) = play(vec![Act::says(words)]);
        let Outcome::Failed(problem) = outcome else { panic!("{outcome:?}") };
        assert_eq!(problem.question, question);
        assert_eq!(heard.len(), 2, "{heard:?}");
        assert!(heard[1].starts_with("said "), "{heard:?}");
    }
    // Chatter is neither.
    let (_, heard, _) = play(vec![Act::says("Sure, here it comes."), Act::says(right(&setting(), COKE))]);
    assert!(heard[1].starts_with("refused ") && heard[2..] == ["asked 1", "taken"], "{heard:?}");
}

#[test]
fn model_planner_model_that_cannot_be_asked_is_an_error_and_no_question() {
    let (outcome, heard, _) = play(vec![Act::status("404 Not Found", "")]);
    let Outcome::Failed(problem) = outcome else { panic!("{outcome:?}") };
    assert!(problem.question.contains("404 Not Found"), "{problem:?} {heard:?}");
    assert_eq!(heard.len(), 2);
}

#[test]
fn model_planner_reply_that_breaks_off_is_asked_for_again_and_is_no_repair() {
    let right = right(&setting(), COKE);
    let half: String = right.chars().take(right.len() / 2).collect();
    let broken = Act::BreaksOff { text: half };
    let script = vec![broken.clone(), Act::Nonsense, Act::says(right)];
    let (outcome, heard, _) = play(script);
    assert_eq!(outcome, Outcome::Done, "{heard:?}");
    assert_eq!(heard.iter().filter(|line| line.starts_with("failed")).count(), 2, "{heard:?}");
    assert_eq!(heard.iter().filter(|line| *line == "asked 0").count(), 3, "{heard:?}");
    let (outcome, heard, _) = play(vec![broken]);
    assert!(matches!(outcome, Outcome::Failed(_)), "{outcome:?}");
    assert_eq!(heard.iter().filter(|line| *line == "asked 0").count(), 4, "{heard:?}");
}

#[test]
fn model_planner_silent_server_is_given_up_after_the_time_and_not_asked_again() {
    let (outcome, heard, _) = play(vec![Act::Silent]);
    let Outcome::Failed(problem) = outcome else { panic!("{outcome:?}") };
    assert!(problem.question.contains("it did not answer within 1 s"), "{problem:?}");
    assert_eq!(heard.len(), 2, "{heard:?}");
}

#[test]
fn model_planner_reply_that_never_ends_is_read_to_the_end_of_its_policy_and_no_further() {
    let right = right(&setting(), COKE);
    let (outcome, heard, _) = play(vec![Act::Endless { text: right }]);
    assert_eq!((outcome, heard), (Outcome::Done, vec!["asked 0".to_owned(), "taken".to_owned()]));
    let (outcome, heard, _) = play(vec![Act::Endless { text: "la ".repeat(100) }]);
    assert!(matches!(outcome, Outcome::Failed(_)), "{heard:?}");
    assert!(heard[1].contains("longer than"), "{heard:?}");
}

#[test]
fn stream_reader_tells_an_error_with_the_value_that_has_it() {
    let setting = setting();
    let session = session();
    let prepared = AcceptorFactory::new(&session, Subset::default());
    let right = right(&setting, COKE);
    // In the goal, and in a step.
    for (key, name) in [("what", "umbrella_stand"), ("object", "umbrella_stand"), ("object", "user")] {
        let from = right.find(&format!("\"{key}\":\"coke\"")).unwrap() + key.len() + 4;
        let wrong = right.replacen(&format!("\"{key}\":\"coke\""), &format!("\"{key}\":\"{name}\""), 1);
        let mut reading = StreamReader::new(&session, prepared.acceptor(4_000));
        let verdict = reading.push(&wrong);
        let StreamVerdict::Wrong(found) = verdict else { panic!("{name}: {verdict:?}") };
        assert!((from..from + name.len()).contains(&found.at), "{name}: {found:?}");
        assert!(reading.is_whole() && reading.reply() == wrong);
    }
}

#[test]
fn model_planner_right_reply_is_never_stopped_however_it_is_cut() {
    let setting = setting();
    let session = session();
    let prepared = AcceptorFactory::new(&session, Subset::default());
    for request in
        [COKE, "put the red mug in the cupboard", "open the fridge", "bring me the coke and the apple"]
    {
        let right = right(&setting, request);
        for each in [1, 5, 400] {
            let mut reading = StreamReader::new(&session, prepared.acceptor(16_000));
            let letters: Vec<char> = right.chars().collect();
            let mut last = StreamVerdict::GoOn;
            for piece in letters.chunks(each) {
                last = reading.push(&piece.iter().collect::<String>());
                assert!(!matches!(last, StreamVerdict::Wrong(_)), "{request}: {last:?}");
            }
            assert_eq!(last, StreamVerdict::Whole, "{request}");
        }
    }
}

/// Says one thing.
struct Says(Option<&'static str>);

impl Person for Says {
    fn ask(&mut self, _: &Problem) -> Option<String> {
        self.0.take().map(ToOwned::to_owned)
    }
}

#[test]
fn model_planner_answer_in_any_words_reaches_the_model() {
    let setting = setting();
    let server = Server::new(vec![Act::says("What do you mean?"), Act::says(right(&setting, COKE))]);
    let heard = Heard::default();
    let mut planner = planner(brisk(&server), &heard);
    let mut person = Says(Some("the one with bubbles, obviously"));
    let (outcome, _) = carry_out_with(&setting, &mut planner, &mut person, COKE);
    assert_eq!(outcome, Outcome::Done, "{:?}", heard.0.borrow());
    let last = server.heard().last().unwrap().body["messages"][1]["content"].as_str().unwrap().to_owned();
    assert!(
        last.contains("asked \"What do you mean?\": answered \"the one with bubbles, obviously\""),
        "{last}"
    );
}

/// What a robot was told to do, with the lengths of the policies that ran.
#[derive(Default)]
struct Steps(Vec<String>, Vec<usize>);

impl DialogueObserver for Steps {
    fn planned(&mut self, answered: &PlannedRequest, _: &std::sync::Arc<motet_graph::Graph>) {
        let policy = answered.planned.parsed.file.policies().next().unwrap();
        self.1.push(policy.body.steps.len());
    }

    fn effect(&mut self, _: Time, effect: &Effect) {
        if let Effect::Start { command, .. } = effect {
            self.0.push(format!("{}{:?}", command.primitive, command.args));
        }
    }
}

/// Carries a request out with a reply that comes slowly; what the robot did, and how it ended.
fn steps(script: Vec<Act>, start: Start, request: &str) -> (Outcome, Steps, Vec<String>, Sim) {
    let (setting, server, heard) = (setting(), Server::new(script), Heard::default());
    let how = Settings { start, ..Settings::default() };
    let mut planner = ModelPlanner::new(Client::new(brisk(&server)).unwrap(), heard.clone(), how);
    let mut sim = Sim::new(&setting.robot, &setting.scene, SimOptions::default());
    let (mut talk, mut steps) = (Conversation::new(&setting), Steps::default());
    let (outcome, _) =
        talk.carry_out(request, &mut planner, &mut sim, &mut NoOperator, &mut steps, Time::ZERO);
    let heard = heard.0.borrow().clone();
    (outcome, steps, heard, sim)
}

#[test]
fn model_planner_first_step_begins_while_the_rest_is_written_and_nothing_is_done_twice() {
    for request in [COKE, "put the red mug in the cupboard", "open the fridge"] {
        let says = Act::Says { text: right(&setting(), request), each: 40, pause: Duration::from_millis(2) };
        let (outcome, whole, _, _) = steps(vec![says.clone()], Start::Whole, request);
        assert_eq!((outcome, whole.1.len()), (Outcome::Done, 1), "{request}");
        let (outcome, eager, heard, _) = steps(vec![says], Start::FirstStep, request);
        assert_eq!(outcome, Outcome::Done, "{request}: {heard:?}");
        assert_eq!(eager.0, whole.0, "{request}");
        if whole.1[0] > 1 {
            assert_eq!(heard, ["asked 0", "begun", "taken"], "{request}");
            assert_eq!(eager.1[0], 1, "{request}");
        }
    }
}

#[test]
fn model_planner_rest_that_is_wrong_is_planned_anew_from_where_the_first_step_has_led() {
    let right = right(&setting(), COKE);
    let at = right.rfind("\"handover\"").unwrap();
    let wrong =
        format!("{}{}", right.get(..at).unwrap(), right.get(at..).unwrap().replacen("handover", "juggle", 1));
    let (outcome, steps, heard, sim) =
        steps(vec![Act::says(wrong), Act::says(right)], Start::FirstStep, COKE);
    assert_eq!(outcome, Outcome::Done, "{heard:?}");
    assert_eq!(heard[..2], ["asked 0", "begun"]);
    assert!(heard[2].starts_with("refused") && heard[2].contains("juggle"), "{heard:?}");
    assert_eq!(sim.holds("at", &["coke", "user"]), Some(true), "{:?}", steps.0);
}

/// A model whose replies come a piece each time somebody looks.
struct Told(VecDeque<Vec<ReplyEvent>>);

impl Told {
    fn new(replies: &[String]) -> Self {
        let pieces = |reply: &String| {
            let letters: Vec<char> = reply.chars().collect();
            let pieces = letters.chunks(30).map(|piece| ReplyEvent::Piece(piece.iter().collect()));
            pieces.chain([ReplyEvent::End(Finish::Stop)]).collect()
        };
        Self(replies.iter().map(pieces).collect())
    }
}

impl Model for Told {
    fn ask(&mut self, _: &[Message], _: &Grammar) -> Result<Box<dyn Reply>, ModelError> {
        Ok(Box::new(Bits(self.0.pop_front().unwrap().into_iter())))
    }

    fn name(&self) -> String {
        "told".to_owned()
    }
}

struct Bits(std::vec::IntoIter<ReplyEvent>);

impl Reply for Bits {
    fn next(&mut self, _: Duration) -> ReplyEvent {
        self.0.next().unwrap_or(ReplyEvent::Nothing)
    }
}

/// Somebody who asks for something else after a second.
#[derive(Default)]
struct Impatient {
    has_asked: bool,
    swaps: usize,
}

impl DialogueObserver for Impatient {
    fn at_least_every(&self) -> Time {
        Time::from_secs(0.02)
    }

    fn request(&mut self, now: Time) -> Option<String> {
        let asks =
            now > Time::from_secs(1.0) && !std::mem::replace(&mut self.has_asked, now > Time::from_secs(1.0));
        asks.then(|| "open the fridge".to_owned())
    }

    fn swapped(&mut self, _: Time, refusal: Option<&SwapRefusal>) {
        assert_eq!(refusal, None);
        self.swaps += 1;
    }
}

#[test]
fn model_planner_request_made_meanwhile_is_planned_without_making_the_robot_wait() {
    let setting = setting();
    let heard = Heard::default();
    let told = Told::new(&[right(&setting, COKE), right(&setting, "open the fridge")]);
    let mut planner = ModelPlanner::new(told, heard.clone(), Settings::default());
    let mut sim = Sim::new(&setting.robot, &setting.scene, SimOptions::default());
    let (mut talk, mut watcher) = (Conversation::new(&setting), Impatient::default());
    let (outcome, _) =
        talk.carry_out(COKE, &mut planner, &mut sim, &mut NoOperator, &mut watcher, Time::ZERO);
    // Nobody says whether the robot shall still bring the coke.
    let Outcome::Failed(problem) = outcome else { panic!("{outcome:?}, {:?}", heard.0.borrow()) };
    assert!(problem.question.ends_with("Shall I go on with \"bring me the coke\"?"), "{problem:?}");
    assert_eq!(watcher.swaps, 1);
    assert_eq!(*heard.0.borrow(), ["asked 0", "taken", "asked 0", "taken"]);
    assert_eq!(sim.holds("open", &["fridge_1"]), Some(true), "{:?}", heard.0.borrow());
    assert_eq!(sim.holds("at", &["coke", "user"]), Some(false));
}

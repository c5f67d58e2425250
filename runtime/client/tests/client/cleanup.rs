//! Cleanups that a policy leaves behind, in the prompt and in the state of the policies after it.

use std::cell::RefCell;
use std::collections::VecDeque;
use std::rc::Rc;
use std::time::Duration;

use crate::kitchen::{Heard, setting};
use motet_decode::Grammar;
use motet_planner::dialogue::{Conversation, DialogueObserver, NoOperator, Outcome, RunRecorder};
use motet_planner::model::{Finish, Message, Model, ModelError, ModelPlanner, Reply, ReplyEvent, Settings};
use motet_runtime::{Engine, PendingCleanup, StartState, SwapRefusal, Time};
use motet_sim::{Sim, SimOptions};

const AIRS: &str = r#"policy air for hsr {
    sequence airing {
        go(cupboard_1)
        open(cupboard_1)
        wait 60 s
    } finally {
        go(cupboard_1)
        close(cupboard_1)
    }
}
"#;
const DECLINES: &str = r#"policy no for hsr {
    cannot "I cannot fly."
}
"#;
const SHUTS: &str = r#"policy shut for hsr {
    go(cupboard_1)
    close(cupboard_1)
}
"#;
const GREETS: &str = r#"policy greet for hsr {
    say("Hello.")
}
"#;

/// A model that says one text after the other, and keeps what it is asked.
struct Scripted {
    says: VecDeque<&'static str>,
    asked: Rc<RefCell<Vec<String>>>,
}

impl Model for Scripted {
    fn ask(&mut self, chat: &[Message], _: &Grammar) -> Result<Box<dyn Reply>, ModelError> {
        let text: Vec<&str> = chat.iter().map(|message| message.text.as_str()).collect();
        self.asked.borrow_mut().push(text.join("\n"));
        let says = ReplyEvent::Piece(self.says.pop_front().unwrap().to_owned());
        Ok(Box::new(Pieces(vec![ReplyEvent::End(Finish::Stop), says])))
    }

    fn name(&self) -> String {
        "scripted".to_owned()
    }
}

struct Pieces(Vec<ReplyEvent>);

impl Reply for Pieces {
    fn next(&mut self, _: Duration) -> ReplyEvent {
        self.0.pop().unwrap_or(ReplyEvent::Nothing)
    }
}

/// Somebody who says something at a time, and the cleanups that each run begins with.
#[derive(Default)]
struct Beside {
    says: Option<(f64, &'static str)>,
    left: Vec<Vec<String>>,
    swaps: usize,
}

fn steps(pending: &[PendingCleanup]) -> Vec<String> {
    pending.iter().flat_map(|pending| pending.steps.clone()).collect()
}

impl DialogueObserver for Beside {
    fn scribe(&mut self, _run: &str, engine: &Engine, start: &StartState) -> Option<Box<dyn RunRecorder>> {
        assert_eq!(engine.snapshot().pending, start.pending);
        self.left.push(steps(&start.pending));
        None
    }

    fn at_least_every(&self) -> Time {
        Time::from_secs(0.1)
    }

    fn request(&mut self, now: Time) -> Option<String> {
        let (_, says) = self.says.take_if(|(at, _)| now >= Time::from_secs(*at))?;
        Some(says.to_owned())
    }

    fn swapped(&mut self, _: Time, refusal: Option<&SwapRefusal>) {
        assert_eq!(refusal, None);
        self.swaps += 1;
    }
}

/// The lines of a prompt about cleanups.
fn due(prompt: &str) -> Vec<&str> {
    prompt.lines().filter_map(|line| line.strip_prefix("- still to clean up: ")).collect()
}

#[test]
fn model_planner_that_declines_leaves_a_cleanup_to_the_policies_after_it() {
    let setting = setting();
    let (asked, heard) = (Rc::new(RefCell::new(Vec::new())), Heard::default());
    let says = VecDeque::from([AIRS, DECLINES, SHUTS, GREETS]);
    let model = Scripted { says, asked: Rc::clone(&asked) };
    let mut planner = ModelPlanner::new(model, heard.clone(), Settings::default());
    let mut sim = Sim::new(&setting.robot, &setting.scene, SimOptions::default());
    let mut talk = Conversation::new(&setting);
    let mut beside = Beside { says: Some((25.0, "fly to the moon")), ..Beside::default() };
    let mut now = Time::ZERO;
    let mut outcomes = Vec::new();
    for request in ["let some air in there", "be good", "whistle"] {
        let (outcome, then) =
            talk.carry_out(request, &mut planner, &mut sim, &mut NoOperator, &mut beside, now);
        (now, _) = (then, outcomes.push(outcome));
    }
    let declined = Outcome::Declined("I cannot fly.".to_owned());
    assert_eq!(outcomes, [declined, Outcome::Done, Outcome::Done], "{:?}", heard.0.borrow());
    assert_eq!(beside.swaps, 1);
    // The new policy took over while the cupboard was open, and did nothing about it.
    let both = ["go(cupboard_1)", "close(cupboard_1)"].map(str::to_owned).to_vec();
    assert_eq!(beside.left, [Vec::new(), both, Vec::new()]);
    let asked = asked.borrow();
    let dues: Vec<Vec<&str>> = asked.iter().map(|prompt| due(prompt)).collect();
    let line = vec!["go(cupboard_1), close(cupboard_1)"];
    assert_eq!(dues, [Vec::new(), line.clone(), line, Vec::new()], "{:#?}", asked);
    assert_eq!(sim.holds("open", &["cupboard_1"]), Some(false));
}

#[test]
fn model_planner_is_told_what_a_person_stopped_before_it_was_cleaned_up() {
    let setting = setting();
    let (asked, heard) = (Rc::new(RefCell::new(Vec::new())), Heard::default());
    let model = Scripted { says: VecDeque::from([AIRS, SHUTS]), asked: Rc::clone(&asked) };
    let mut planner = ModelPlanner::new(model, heard.clone(), Settings::default());
    let mut sim = Sim::new(&setting.robot, &setting.scene, SimOptions::default());
    let mut talk = Conversation::new(&setting);
    let mut beside = Beside { says: Some((25.0, "stop")), ..Beside::default() };
    let (outcome, now) = talk.carry_out(
        "let some air in there",
        &mut planner,
        &mut sim,
        &mut NoOperator,
        &mut beside,
        Time::ZERO,
    );
    assert_eq!(outcome, Outcome::GivenUp, "{:?}", heard.0.borrow());
    let (outcome, _) = talk.carry_out("be good", &mut planner, &mut sim, &mut NoOperator, &mut beside, now);
    assert_eq!(outcome, Outcome::Done, "{:?}", heard.0.borrow());
    assert_eq!(due(&asked.borrow()[1]), ["go(cupboard_1), close(cupboard_1)"]);
    assert_eq!(beside.left[1], ["go(cupboard_1)", "close(cupboard_1)"]);
    assert_eq!(sim.holds("open", &["cupboard_1"]), Some(false));
}

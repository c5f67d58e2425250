//! A case played from its request to its end, with every turn in which a planner is asked.

use std::cell::RefCell;
use std::rc::Rc;

use motet_compiler::CheckOptions;
use motet_planner::dialogue::{Conversation, DialogueSetup, Kind, Outcome, Person, Problem};
use motet_runtime::Time;
use motet_sim::{Sim, SimOptions};

use crate::case::Case;
use crate::mind::{Mind, Turn};
use crate::picture::Pictures;
use crate::stage::Stage;

/// Answers from a list.
struct Scripted(Vec<(Kind, String)>);

impl Person for Scripted {
    fn ask(&mut self, problem: &Problem) -> Option<String> {
        let next = self.0.iter().position(|(kind, _)| *kind == problem.kind)?;
        Some(self.0.remove(next).1)
    }
}

/// Plays a case where the robot was told the room of a stage. Gives its turns, or why it did not go as it
/// was drawn: it came
/// to another end, its goal does not hold, or something that should go wrong was never asked about.
pub(crate) fn play(case: &Case, stage: &Stage, pictures: Pictures) -> Result<Vec<Turn>, &'static str> {
    let eye = stage.geometry.as_ref().and_then(|geometry| geometry.eye());
    let options = SimOptions { faults: case.faults.clone(), eye, ..SimOptions::default() };
    let mut driver = Rc::new(RefCell::new(Sim::new(&stage.robot, &case.real, options)));
    let mut mind = Mind { told: stage.scene.clone(), sim: driver.clone(), pictures, turns: Vec::new() };
    let setting = DialogueSetup {
        robot: stage.robot.clone(),
        scene: stage.scene.clone(),
        domains: Vec::new(),
        geometry: stage.geometry.clone(),
        options: CheckOptions::default(),
    };
    let mut person = Scripted(case.answers.clone());
    let mut talk = Conversation::new(&setting);
    let (outcome, _) =
        talk.carry_out(&case.request, &mut mind, &mut driver, &mut person, &mut (), Time::ZERO);
    match (outcome, case.is_given_up) {
        (Outcome::Done, false) | (Outcome::GivenUp, true) => {}
        _ => return Err("the conversation came to another end"),
    }
    if !person.0.is_empty() {
        return Err("not everything went wrong that should");
    }
    let (fluent, args, holds) = &case.goal;
    let args: Vec<&str> = args.iter().map(smol_str::SmolStr::as_str).collect();
    if !case.is_given_up && driver.borrow().holds(fluent, &args) != Some(*holds) {
        return Err("what was asked for does not hold at the end");
    }
    Ok(mind.turns)
}

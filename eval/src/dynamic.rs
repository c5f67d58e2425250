//! Tasks that change while they are carried out, after VLP: another object is asked for during a handover,
//! another goal during execution, and a drawer that is to be closed only where it is open is closed by
//! somebody else meanwhile. When the change comes is drawn at random from the whole time that the task takes
//! without it.
//!
//! A trial succeeds where the goal after the change holds at the end, nothing was dropped, nothing done
//! twice, and nothing left running.

use motet_compiler::CheckOptions;
use motet_planner::dialogue::{Conversation, DialogueSetup, NoOperator, Outcome};
use motet_runtime::Time;
use motet_sim::Faults;
use rand::RngExt as _;
use rand_xoshiro::SplitMix64;
use rand_xoshiro::rand_core::SeedableRng as _;
use serde::{Deserialize, Serialize};

use crate::actions::ActionFaults;
use crate::bench::{Bench, TrialObserver, action_line};
use crate::outcome::{FailureSort, Rate};
use crate::setup;

/// The robots of the trials.
const ROBOTS: [&str; 2] = ["hsr", "anymal_z1"];

/// A task with its change.
#[derive(Clone, Copy, Debug)]
pub struct Task {
    /// `object_changed`
    pub name: &'static str,
    scene: &'static str,
    /// Requests, each with the one that replaces it.
    wordings: &'static [(&'static str, Option<&'static str>)],
    /// Container that somebody closes meanwhile.
    done: Option<&'static str>,
    /// Fact that shall hold at the end, for each wording.
    goals: &'static [(&'static str, &'static [&'static str], bool)],
}

/// The tasks.
pub const TASKS: &[Task] = &[
    Task {
        name: "object_changed_during_handover",
        scene: "kitchen",
        wordings: &[
            ("Bring me the red mug.", Some("Bring me the green apple instead.")),
            ("Could you hand me the coke?", Some("Actually, I would like the water bottle.")),
        ],
        done: None,
        goals: &[("at", &["apple", "user"], true), ("at", &["bottle", "user"], true)],
    },
    Task {
        name: "goal_changed_during_execution",
        scene: "kitchen",
        wordings: &[
            ("Put the red mug on the counter.", Some("No, put it on the sink.")),
            ("Put the apple in the drawer.", Some("Put it in the fridge instead.")),
        ],
        done: None,
        goals: &[("on", &["mug_1", "sink"], true), ("in", &["apple", "fridge_1"], true)],
    },
    Task {
        name: "conditional_drawer_closing",
        scene: "lab",
        wordings: &[
            ("If the upper drawer is open, close it.", None),
            ("Close the upper drawer if it is still open.", None),
        ],
        done: Some("drawer_1"),
        goals: &[("open", &["drawer_1"], false), ("open", &["drawer_1"], false)],
    },
];

/// All instructions of the tasks.
pub fn instructions() -> impl Iterator<Item = &'static str> {
    let wordings = TASKS.iter().flat_map(|task| task.wordings);
    wordings.flat_map(|(request, instead)| std::iter::once(*request).chain(*instead))
}

/// Result of a trial.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct Trial {
    /// The task.
    pub task: String,
    /// The robot.
    pub robot: String,
    /// Time of the change, in s.
    pub changed_at: f64,
    /// True if the goal held at the end by the truth of the world, and the conversation ended as done.
    pub is_reached: bool,
    /// Objects that lay nowhere at the end: not in the hand, on or in anything, or with anybody.
    pub fallen: Vec<String>,
    /// Faults of the actions, counted from the journals.
    pub faults: ActionFaults,
    /// Sort of the failure, where the goal was not reached.
    pub failed_by: Option<FailureSort>,
    /// End of the conversation.
    pub end: String,
}

impl Trial {
    /// True if everything went well.
    #[must_use]
    pub fn is_good(&self) -> bool {
        self.is_reached && self.fallen.is_empty() && self.faults.is_empty()
    }
}

/// A trial of a task: `draw` in `0 .. 1` says when the change comes, as a part of the time without it.
///
/// # Errors
///
/// The driver does not start, or a journal cannot be read.
pub fn run(bench: &Bench, task: &Task, robot: &str, index: usize, draw: f64) -> Result<Trial, String> {
    let (_, whole) = play(bench, task, robot, index, None)?;
    let at = whole.secs() * draw;
    Ok(play(bench, task, robot, index, Some(at))?.0)
}

fn play(
    bench: &Bench,
    task: &Task,
    robot: &str,
    index: usize,
    change_at: Option<f64>,
) -> Result<(Trial, Time), String> {
    let wording = index % task.wordings.len().max(1);
    let (request, instead) = task.wordings.get(wording).copied().unwrap_or_default();
    let setting = DialogueSetup {
        robot: setup::robot(robot),
        scene: setup::scene(task.scene),
        domains: Vec::new(),
        geometry: bench.geometry(robot, &setup::scene(task.scene)),
        options: CheckOptions::default(),
    };
    // Nobody closes a drawer in physics: there it stays open until the robot comes.
    let world = match (task.done, change_at) {
        (Some(what), Some(at)) => format!(r#"{{"world": [{{"at": {at}, "what": {{"closes": "{what}"}}}}]}}"#),
        _ => "{}".to_owned(),
    };
    let faults = Faults::from_json(&world).map_err(|error| error.to_string())?;
    let mut robot_in = bench.robot(&setting.robot, (&setting.scene, &setting.scene), index as u64, faults)?;
    let says = change_at.zip(instead).map(|(at, says)| (Time::from_secs(at), says));
    let mut observer = TrialObserver::new(says)?;
    let mut talk = bench.sighted(Conversation::new(&setting), &robot_in);
    let (driver, mut planner) = (robot_in.driver(), bench.planner.make()?);
    let (outcome, end) =
        talk.carry_out(request, &mut *planner, driver, &mut NoOperator, &mut observer, Time::ZERO);
    let goal = task.goals.get(wording);
    let is_goal = goal.is_none_or(|(fluent, args, wanted)| robot_in.holds(fluent, args) == *wanted);
    let is_reached = is_goal && outcome == Outcome::Done;
    let problem = if let Outcome::Failed(problem) = &outcome { Some(problem.kind) } else { None };
    let last = observer.failures.0.last().copied().or(problem.map(FailureSort::of_problem));
    let trial = Trial {
        task: task.name.to_owned(),
        robot: robot.to_owned(),
        changed_at: change_at.unwrap_or_default(),
        is_reached,
        fallen: robot_in.fallen(&setting.scene),
        faults: observer.journals.faults()?,
        failed_by: (!is_reached).then_some(last.unwrap_or(FailureSort::Planning)),
        end: match outcome {
            Outcome::Failed(problem) => problem.question,
            other => format!("{other:?}"),
        },
    };
    Ok((trial, end))
}

/// All trials: so many of each task on each robot, with the same draws for a seed.
///
/// # Errors
///
/// The reason of [`run`].
pub fn trials(bench: &Bench, seed: u64, count: usize) -> Result<Vec<Trial>, String> {
    let mut random = SplitMix64::seed_from_u64(seed);
    let mut drawn = Vec::new();
    for task in TASKS {
        for robot in ROBOTS {
            drawn.extend((0..count).map(|index| (task, robot, index, random.random())));
        }
    }
    drawn.retain(|(task, robot, _, _): &(&Task, &str, usize, f64)| bench.asks_for(&[robot, task.name]));
    let play = |(task, robot, index, draw): (&Task, &str, usize, f64)| run(bench, task, robot, index, draw);
    bench.workers.spread_kept(drawn, play)
}

/// The tables: success by task as in VLP's figure 8, and by robot with the shares of failures as in its
/// figure 9; and what the journals say of the actions.
#[must_use]
pub fn table(bench: &Bench, trials: &[Trial]) -> Vec<String> {
    let [perception, planning, execution] = ["perception", "planning", "execution"];
    let mut lines = vec![
        format!("world {}, driver {:?}", bench.world, bench.driver),
        format!("{:<34} {:>4} {:>24} {:>24}", "success (VLP, figure 8)", "n", ROBOTS[0], ROBOTS[1]),
    ];
    let of = |task: &'static str, robot: &'static str| {
        trials.iter().filter(move |trial| trial.task == task && trial.robot == robot)
    };
    let rate = |task: &'static str, robot: &'static str, is: &dyn Fn(&Trial) -> bool| Rate {
        part: of(task, robot).filter(|trial| is(trial)).count(),
        of: of(task, robot).count(),
    };
    for task in TASKS {
        let [one, other] = ROBOTS.map(|robot| rate(task.name, robot, &|trial| trial.is_reached));
        lines.push(format!("{:<34} {:>4} {:>24} {:>24}", task.name, one.of, one.text(), other.text()));
    }
    lines.push(format!(
        "{:<34} {:<10} {:>8} {perception:>10} {planning:>10} {execution:>10}",
        "share of trials (VLP, figure 9)", "robot", "success"
    ));
    for task in TASKS {
        for robot in ROBOTS {
            let percent = |rate: Rate| format!("{:.0} %", 100.0 * rate.share());
            let success = percent(rate(task.name, robot, &|trial| trial.is_reached));
            let [seen, planned, done] = FailureSort::ALL
                .map(|sort| percent(rate(task.name, robot, &|trial| trial.failed_by == Some(sort))));
            let name = task.name;
            lines.push(format!("{name:<34} {robot:<10} {success:>8} {seen:>10} {planned:>10} {done:>10}"));
        }
    }
    let fallen: usize = trials.iter().map(|trial| trial.fallen.len()).sum();
    let actions = action_line(trials.iter().map(|trial| &trial.faults));
    lines.push(format!("{actions}; objects that fell: {fallen}"));
    lines
}

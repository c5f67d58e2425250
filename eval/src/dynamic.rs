//! Tasks that change while they are carried out, after VLP: another object is asked for during a handover,
//! another goal during execution, and a drawer that is to be closed only where it is open is closed by
//! somebody else meanwhile. When the change comes is drawn at random from the whole time that the task takes
//! without it.
//!
//! A trial succeeds where the goal after the change holds at the end, nothing was dropped, nothing done
//! twice, and nothing left running.

use std::collections::BTreeMap;

use motet_compiler::CheckOptions;
use motet_planner::Builtin;
use motet_planner::dialogue::{Conversation, DialogueObserver, DialogueSetup, NoOperator, Outcome};
use motet_runtime::{DriverEvent, Effect, Event, GoalId, Outcome as Ending, RunEnd, Time};
use motet_sim::{Faults, Sim, SimOptions};
use rand::RngExt as _;
use rand_xoshiro::SplitMix64;
use rand_xoshiro::rand_core::SeedableRng as _;
use serde::Serialize;

use crate::setup;

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

/// Result of a trial.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Trial {
    /// The task.
    pub task: &'static str,
    /// The robot.
    pub robot: String,
    /// Time of the change, in s.
    pub changed_at: f64,
    /// True if the goal held at the end, and the conversation ended as done.
    pub is_reached: bool,
    /// Objects that lay nowhere at the end: not in the hand, on or in anything, or with anybody.
    pub dropped: Vec<String>,
    /// Calls that were started although the same one ran or its work was done.
    pub doubled: Vec<String>,
    /// Calls that had not ended when their policy had.
    pub orphaned: Vec<String>,
    /// End of the conversation.
    pub end: String,
}

impl Trial {
    /// True if everything went well.
    #[must_use]
    pub fn is_good(&self) -> bool {
        self.is_reached && self.dropped.is_empty() && self.doubled.is_empty() && self.orphaned.is_empty()
    }
}

/// Says something at a time, and follows what is started and what ends.
struct Observer {
    says: Option<(Time, &'static str)>,
    running: BTreeMap<GoalId, String>,
    /// Last action on the hand: the same one again without another between is one too many.
    last: Option<String>,
    doubled: Vec<String>,
    orphaned: Vec<String>,
}

impl DialogueObserver for Observer {
    fn request(&mut self, now: Time) -> Option<String> {
        self.says.take_if(|(at, _)| *at <= now).map(|(_, says)| says.to_owned())
    }

    fn at_least_every(&self) -> Time {
        Time::from_secs(0.05)
    }

    fn effect(&mut self, _now: Time, effect: &Effect) {
        if let Effect::Start { goal, command, .. } | Effect::Update { goal, command, .. } = effect {
            let call = command.to_string();
            let runs_twice = self.running.iter().any(|(other, running)| other != goal && *running == call);
            if runs_twice || self.last.as_ref() == Some(&call) {
                self.doubled.push(call.clone());
            }
            self.running.insert(*goal, call);
        }
    }

    fn event(&mut self, _now: Time, event: &Event) {
        let Event::Driver(event) = event else { return };
        let Some(goal) = event.goal() else { return };
        let done = match event {
            DriverEvent::Ended { outcome, .. } => Some(matches!(outcome, Ending::Success(_))),
            DriverEvent::Refused { .. } | DriverEvent::Stopped { .. } => Some(false),
            _ => None,
        };
        if let Some(succeeded) = done
            && let Some(call) = self.running.remove(&goal)
        {
            let acts =
                ["pick(", "place(", "handover(", "open(", "close("].iter().any(|name| call.starts_with(name));
            if acts && succeeded {
                self.last = Some(call);
            }
        }
    }

    fn ended(&mut self, _now: Time, _end: &RunEnd) {
        self.orphaned.extend(std::mem::take(&mut self.running).into_values());
    }
}

/// A trial of a task: `draw` in `0 .. 1` says when the change comes, as a part of the time without it.
#[must_use]
pub fn run(task: &Task, robot: &str, wording: usize, draw: f64) -> Trial {
    let (_, whole) = play(task, robot, wording, None);
    let at = whole.secs() * draw;
    play(task, robot, wording, Some(at)).0
}

fn play(task: &Task, robot: &str, wording: usize, change_at: Option<f64>) -> (Trial, Time) {
    let wording = wording % task.wordings.len().max(1);
    let (request, instead) = task.wordings.get(wording).copied().unwrap_or_default();
    let setting = DialogueSetup {
        robot: setup::robot(robot),
        scene: setup::scene(task.scene),
        domains: Vec::new(),
        geometry: None,
        options: CheckOptions::default(),
    };
    let world = match (task.done, change_at) {
        (Some(what), Some(at)) => format!(r#"{{"world": [{{"at": {at}, "what": {{"closes": "{what}"}}}}]}}"#),
        _ => "{}".to_owned(),
    };
    let faults = Faults::from_json(&world).unwrap_or_default();
    let mut sim = Sim::new(&setting.robot, &setting.scene, SimOptions { faults, ..SimOptions::default() });
    let mut observer = Observer {
        says: change_at.zip(instead).map(|(at, says)| (Time::from_secs(at), says)),
        running: BTreeMap::new(),
        last: None,
        doubled: Vec::new(),
        orphaned: Vec::new(),
    };
    let mut talk = Conversation::new(&setting);
    let (outcome, end) =
        talk.carry_out(request, &mut Builtin, &mut sim, &mut NoOperator, &mut observer, Time::ZERO);
    let goal = task.goals.get(wording);
    let is_goal = goal.is_none_or(|(fluent, args, wanted)| sim.holds(fluent, args) == Some(*wanted));
    let dropped = setting.scene.entities.values().filter(|entity| entity.kind == "Object");
    let lies = |id: &str| {
        sim.holds("holding", &[id]) == Some(true)
            || setting.scene.entities.keys().any(|other| {
                ["on", "in", "at"].iter().any(|fluent| sim.holds(fluent, &[id, other]) == Some(true))
            })
    };
    let trial = Trial {
        task: task.name,
        robot: robot.to_owned(),
        changed_at: change_at.unwrap_or_default(),
        is_reached: is_goal && outcome == Outcome::Done,
        dropped: dropped.filter(|entity| !lies(&entity.id)).map(|entity| entity.id.to_string()).collect(),
        doubled: observer.doubled,
        orphaned: observer.orphaned,
        end: match outcome {
            Outcome::Failed(problem) => problem.question,
            other => format!("{other:?}"),
        },
    };
    (trial, end)
}

/// All trials: so many of each task on each robot, with the same draws for a seed.
#[must_use]
pub fn trials(seed: u64, count: usize) -> Vec<Trial> {
    let mut random = SplitMix64::seed_from_u64(seed);
    let mut drawn = Vec::new();
    for task in TASKS {
        for robot in ["hsr", "anymal_z1"] {
            drawn.extend((0..count).map(|index| (task, robot, index, random.random())));
        }
    }
    super::spread(drawn, |(task, robot, index, draw)| run(task, robot, index, draw))
}

/// The table: a row a task and robot.
#[must_use]
pub fn table(trials: &[Trial]) -> Vec<String> {
    let mut lines = vec![format!(
        "{:<34} {:<10} {:>4} {:>8} {:>8} {:>8} {:>9}",
        "task", "robot", "n", "success", "dropped", "doubled", "orphaned"
    )];
    for task in TASKS {
        for robot in ["hsr", "anymal_z1"] {
            let own = || trials.iter().filter(|trial| trial.task == task.name && trial.robot == robot);
            let count = |is: fn(&Trial) -> bool| own().filter(|trial| is(trial)).count();
            lines.push(format!(
                "{:<34} {robot:<10} {:>4} {:>8} {:>8} {:>8} {:>9}",
                task.name,
                own().count(),
                count(|trial| trial.is_reached),
                count(|trial| !trial.dropped.is_empty()),
                count(|trial| !trial.doubled.is_empty()),
                count(|trial| !trial.orphaned.is_empty()),
            ));
        }
    }
    lines
}

//! Tasks of the papers, as rows of a file: a request in a room, facts that shall hold at the end, and the
//! failures on the way with the answers of a person. A failure is real: the thing is elsewhere, or out of
//! reach by geometry; nothing is injected.

use std::collections::BTreeMap;
use std::time::Duration;

use motet_compiler::CheckOptions;
use motet_planner::dialogue::{Conversation, DialogueSetup, Kind, Outcome, Person, Problem};
use motet_robots::scene::{self, Scene};
use motet_runtime::Time;
use motet_sim::Faults;
use motet_syntax::{Source, Sources};
use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::actions::ActionFaults;
use crate::bench::{Bench, TrialObserver, action_line};
use crate::outcome::{FailureSort, Rate};
use crate::planners::Timed;
use crate::setup;

/// The robots of the trials.
const ROBOTS: [&str; 2] = ["hsr", "anymal_z1"];

/// Row of a file of tasks.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Task {
    /// Table or figure of a paper, and its cell.
    table: String,
    cell: String,
    /// Built-in scene.
    scene: String,
    /// Entities beside those of the scene.
    #[serde(default)]
    more: Vec<Value>,
    /// Place that the robot was told, and that is real: `on(coke, shelf)`.
    told: Option<String>,
    /// Place that is real, where the robot was told another one.
    hidden: Option<String>,
    request: String,
    /// Facts that shall hold at the end: `in(apple, drawer_1)`, `not open(drawer_1)`.
    goal: Vec<String>,
    /// Failures that the robot has to tell the person.
    #[serde(default)]
    failures: Vec<String>,
    /// Answers of the person by the kind of the problem, in order.
    #[serde(default)]
    answers: BTreeMap<String, Vec<String>>,
}

/// Fact as a row writes it.
#[derive(Clone, Debug)]
struct RowFact {
    is_so: bool,
    fluent: String,
    args: Vec<String>,
}

impl RowFact {
    fn read(text: &str) -> Result<Self, String> {
        let wrong = || format!("`{text}` is no fact such as `on(mug_1, counter)`");
        let (is_so, atom) =
            text.trim().strip_prefix("not ").map_or((true, text.trim()), |atom| (false, atom.trim()));
        let (fluent, args) =
            atom.strip_suffix(')').and_then(|atom| atom.split_once('(')).ok_or_else(wrong)?;
        let args: Vec<String> = args.split(',').map(|arg| arg.trim().to_owned()).collect();
        if fluent.is_empty() || args.iter().any(String::is_empty) {
            return Err(wrong());
        }
        Ok(Self { is_so, fluent: fluent.to_owned(), args })
    }
}

/// Result of a trial.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct TaskTrial {
    pub table: String,
    pub cell: String,
    pub robot: String,
    pub request: String,
    /// True if the first request had a policy that passed the check.
    pub is_planned: bool,
    pub is_reached: bool,
    /// True if the person was told every failure of the row as what it is; `None` without failures.
    pub is_explained: Option<bool>,
    pub failed_by: Option<FailureSort>,
    pub faults: ActionFaults,
    /// Times for the words, the checks and the plans.
    pub times: [Duration; 3],
    /// End of the conversation.
    pub end: String,
}

/// Tasks of a file, with the numbers of their lines.
///
/// # Errors
///
/// A line is no task; the message begins with its number.
pub fn read(lines: &[(usize, &str)]) -> Result<Vec<Task>, String> {
    let read = |(number, line): &(usize, &str)| {
        let task: Task = serde_json::from_str(line).map_err(|error| format!("{number}: {error}"))?;
        let facts = task.goal.iter().chain(&task.hidden).chain(&task.told);
        facts
            .map(|fact| RowFact::read(fact))
            .collect::<Result<Vec<_>, _>>()
            .map_err(|why| format!("{number}: {why}"))?;
        let kinds = task.failures.iter().chain(task.answers.keys());
        match kinds.clone().find(|kind| !KINDS.iter().any(|known| known.name() == kind.as_str())) {
            Some(kind) => Err(format!("{number}: there is no failure `{kind}`")),
            None => Ok(task),
        }
    };
    lines.iter().map(read).collect()
}

/// Kinds of problems.
const KINDS: [Kind; 5] =
    [Kind::NotFound, Kind::NotReachable, Kind::AmbiguousReference, Kind::AmbiguousTask, Kind::ActionFailed];

/// Carries out so many trials of each task on each robot.
///
/// # Errors
///
/// A scene cannot be made, or the driver does not start.
pub fn trials(bench: &Bench, tasks: &[Task], count: usize) -> Result<Vec<TaskTrial>, String> {
    let mut drawn = Vec::new();
    for task in tasks {
        for robot in ROBOTS {
            drawn.extend((0..count).map(|seed| (task, robot, seed as u64)));
        }
    }
    drawn.retain(|(task, robot, _): &(&Task, &str, u64)| {
        bench.asks_for(&[robot, &task.table, &task.cell, &task.request])
    });
    let run = |(task, robot, seed): (&Task, &str, u64)| task.carry_out(bench, robot, seed);
    bench.workers.spread_kept(drawn, run)
}

/// Person who answers by the kind of the problem.
struct Answers {
    left: BTreeMap<String, Vec<String>>,
    asked: Vec<Kind>,
    questions: Vec<String>,
}

impl Person for Answers {
    fn ask(&mut self, problem: &Problem) -> Option<String> {
        self.asked.push(problem.kind);
        self.questions.push(problem.question.clone());
        let left = self.left.get_mut(problem.kind.name()).filter(|left| !left.is_empty())?;
        Some(left.remove(0))
    }
}

impl Task {
    /// The request in words.
    #[must_use]
    pub fn request(&self) -> &str {
        &self.request
    }

    /// True if something goes wrong on the way, which the robot has to tell.
    #[must_use]
    pub fn has_failures(&self) -> bool {
        !self.failures.is_empty()
    }

    /// The room as the robot was told, and as it is.
    fn rooms(&self) -> Result<(Scene, Scene), String> {
        let told = motet_robots::builtin::scene(&self.scene);
        let mut told = told.ok_or_else(|| format!("there is no scene `{}`", self.scene))?;
        if !self.more.is_empty() {
            let mut json: Value =
                serde_json::from_str(&scene::write(&told)).map_err(|error| error.to_string())?;
            let entities = json.get_mut("entities").and_then(Value::as_array_mut);
            entities.ok_or("the scene has no entities")?.extend(self.more.iter().cloned());
            let mut sources = Sources::default();
            let source = Source::new("task.json", json.to_string());
            let id = sources.add(source.clone());
            let (read, said) = scene::read(&source, id);
            told = read.ok_or_else(|| {
                said.first().map_or_else(String::new, |said| format!("{} {}", said.code, said.message))
            })?;
        }
        if let Some(place) = &self.told {
            put(&mut told, place)?;
        }
        let mut real = told.clone();
        if let Some(place) = &self.hidden {
            put(&mut real, place)?;
        }
        Ok((told, real))
    }

    fn carry_out(&self, bench: &Bench, robot: &str, seed: u64) -> Result<TaskTrial, String> {
        let body =
            motet_robots::builtin::robot(robot).ok_or_else(|| format!("there is no robot `{robot}`"))?;
        let (told, real) = self.rooms()?;
        let mut robot_in = bench.robot(&body.robot, (&told, &real), seed, Faults::default())?;
        let geometry = Some(setup::geometry(&body, &told));
        let setting = DialogueSetup {
            robot: body.robot,
            scene: told,
            domains: Vec::new(),
            geometry,
            options: CheckOptions::default(),
        };
        let mut talk = bench.sighted(Conversation::new(&setting), &robot_in);
        let (asked, questions) = (Vec::new(), Vec::new());
        let mut person = Answers { left: self.answers.clone(), asked, questions };
        let mut planner = Timed::new(bench.planner.make()?);
        let mut observer = TrialObserver::new(None)?;
        let driver = robot_in.driver();
        let (outcome, _) =
            talk.carry_out(&self.request, &mut planner, driver, &mut person, &mut observer, Time::ZERO);
        let mut is_true = true;
        for fact in &self.goal {
            let RowFact { is_so, fluent, args } = RowFact::read(fact)?;
            let args: Vec<&str> = args.iter().map(String::as_str).collect();
            is_true &= robot_in.holds(&fluent, &args) == is_so;
        }
        let is_reached = is_true && outcome == Outcome::Done;
        let problem = if let Outcome::Failed(problem) = &outcome { Some(problem.kind) } else { None };
        let last = problem.map(FailureSort::of_problem).or(observer.failures.0.last().copied());
        let was_asked = |kind: &String| person.asked.iter().any(|asked| asked.name() == kind.as_str());
        Ok(TaskTrial {
            table: self.table.clone(),
            cell: self.cell.clone(),
            robot: robot.to_owned(),
            request: self.request.clone(),
            is_planned: planner.is_planned == Some(true),
            is_reached,
            is_explained: (!self.failures.is_empty()).then(|| self.failures.iter().all(was_asked)),
            failed_by: (!is_reached).then_some(last.unwrap_or(FailureSort::Planning)),
            faults: observer.journals.faults()?,
            times: [planner.words, planner.check, planner.plan],
            end: match outcome {
                Outcome::Failed(problem) => problem.question,
                other => format!("{other:?}, asked {:?}", person.questions),
            },
        })
    }
}

/// Puts a thing on or in another: its pose follows from that.
fn put(scene: &mut Scene, place: &str) -> Result<(), String> {
    let RowFact { fluent, args, .. } = RowFact::read(place)?;
    let [thing, support] = args.as_slice() else {
        return Err(format!("`{place}` has no thing and no place"));
    };
    let target = scene.entities.get(support.as_str()).ok_or_else(|| format!("there is no `{support}`"))?;
    let (at, target_half) = (target.pose, half_height(target));
    let thing = scene.entities.get_mut(thing.as_str()).ok_or_else(|| format!("there is no `{thing}`"))?;
    let half = half_height(thing);
    (thing.on, thing.inside, thing.visible) = (None, None, None);
    if fluent == "in" {
        // Where in it nobody knows.
        (thing.inside, thing.pose) = (Some(support.as_str().into()), None);
    } else {
        thing.on = Some(support.as_str().into());
        if let (Some(pose), Some(at)) = (&mut thing.pose, at) {
            pose.xyz = [at.xyz[0], at.xyz[1], at.xyz[2] + target_half + half];
        }
    }
    Ok(())
}

/// Half of the height of an entity as it stands, in m.
fn half_height(entity: &scene::Entity) -> f64 {
    match &entity.shape {
        Some(scene::EntityShape::Box([_, _, z])) => z / 2.0,
        Some(scene::EntityShape::Cylinder { height, .. }) => height / 2.0,
        Some(scene::EntityShape::Sphere { radius }) => *radius,
        Some(scene::EntityShape::Capsule { .. } | scene::EntityShape::Mesh { .. }) | None => 0.0,
    }
}

/// The tables: a row for each cell and robot.
#[must_use]
pub fn table(bench: &Bench, trials: &[TaskTrial]) -> Vec<String> {
    let mut lines =
        vec![format!("world {}, driver {:?}, planner {:?}", bench.world, bench.driver, bench.planner)];
    let mut cells: Vec<(&str, &str)> = Vec::new();
    for trial in trials {
        if !cells.contains(&(trial.table.as_str(), trial.cell.as_str())) {
            cells.push((&trial.table, &trial.cell));
        }
    }
    let mut open = "";
    for (table, cell) in cells {
        if table != open {
            open = table;
            lines.push(format!(
                "{table:<46} {:<10} {:>3} {:>6} {:>22} {:>9} {:>9} {:>10} {:>8} {:>9} {:>17}",
                "robot",
                "n",
                "plan",
                "success",
                "explained",
                "recovered",
                "perception",
                "planning",
                "execution",
                "words/check/plan"
            ));
        }
        for robot in ROBOTS {
            let own: Vec<&TaskTrial> = trials
                .iter()
                .filter(|trial| trial.table == table && trial.cell == cell && trial.robot == robot)
                .collect();
            if !own.is_empty() {
                lines.push(row(cell, robot, &own));
            }
        }
    }
    lines.push(action_line(trials.iter().map(|trial| &trial.faults)));
    lines
}

fn row(cell: &str, robot: &str, own: &[&TaskTrial]) -> String {
    let of = own.len();
    let rate = |is: &dyn Fn(&TaskTrial) -> bool| Rate { part: own.iter().filter(|one| is(one)).count(), of };
    let percent =
        |rate: Rate| if rate.of == 0 { "-".to_owned() } else { format!("{:.0} %", 100.0 * rate.share()) };
    let troubled: Vec<_> = own.iter().filter(|one| one.is_explained.is_some()).collect();
    let among = |is: &dyn Fn(&TaskTrial) -> bool| {
        percent(Rate { part: troubled.iter().filter(|one| is(one)).count(), of: troubled.len() })
    };
    let [seen, planned, done] =
        FailureSort::ALL.map(|sort| percent(rate(&|one: &TaskTrial| one.failed_by == Some(sort))));
    let median = |of: usize| {
        let mut all: Vec<f64> =
            own.iter().filter_map(|one| Some(one.times.get(of)?.as_secs_f64() * 1e3)).collect();
        all.sort_by(f64::total_cmp);
        all.get(all.len() / 2).copied().unwrap_or_default()
    };
    let times = format!("{:.1}/{:.1}/{:.1} ms", median(0), median(1), median(2));
    format!(
        "{cell:<46} {robot:<10} {of:>3} {:>6} {:>22} {:>9} {:>9} \
         {seen:>10} {planned:>8} {done:>9} {times:>17}",
        percent(rate(&|one| one.is_planned)),
        rate(&|one| one.is_reached).text(),
        among(&|one| one.is_explained == Some(true)),
        among(&|one| one.is_reached),
    )
}

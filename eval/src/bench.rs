//! Worlds in which trials run: the simulated one with a profile, or physics in another process, through the
//! same driver as `motet run`.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::str::FromStr;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use motet::driver_camera::DriverCamera;
use motet_compiler::Geometry;
use motet_geometry::planning::RobotModel;
use motet_host::journal::{JournalWriter, RunRecorder as JournalObserver, read};
use motet_host::remote::protocol::Hello;
use motet_host::remote::{DriverAddress, DriverTimeouts, RemoteDriver};
use motet_planner::dialogue::{Conversation, DialogueObserver, RunRecorder};
use motet_robots::builtin;
use motet_robots::card::{CameraMount, Robot};
use motet_robots::scene::{Placement, Scene, write};
use motet_runtime::journal::JournalHead;
use motet_runtime::{Answer, Driver, Engine, Event, Observer, Pattern, Query, RunEnd, StartState, Time, run};
use motet_sim::{Faults, Profile, Sim, SimOptions};

use crate::Workers;
use crate::actions::{ActionFaults, ActionLedger};
use crate::outcome::StepFailures;
use crate::planners::PlannerKind;
use crate::setup;

/// Interpreter of the physics driver.
const PYTHON: &str = "python3";
/// Times that a driver of physics has to start and to answer: time stands still meanwhile, and a machine that
/// plays many trials is slow.
const GREETING: Duration = Duration::from_secs(120);
const STEP: Duration = Duration::from_secs(300);
/// Number of folders that this process made.
static FOLDERS: AtomicU64 = AtomicU64::new(0);

/// Driver that carries trials out.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum DriverKind {
    #[default]
    Kinematic,
    Mujoco,
}

impl FromStr for DriverKind {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "kinematic" => Ok(Self::Kinematic),
            "mujoco" => Ok(Self::Mujoco),
            other => Err(format!("there is no driver `{other}`: write `kinematic` or `mujoco`")),
        }
    }
}

/// World of trials.
#[derive(Clone, Debug)]
pub struct Bench {
    /// Name or file of the profile.
    pub world: String,
    pub profile: Profile,
    pub driver: DriverKind,
    pub planner: PlannerKind,
    pub workers: Workers,
    /// Every which case of a file of wordings is played: 1 for all.
    pub every: usize,
    /// Words of which a trial has one in its name, its robot or its request; without any, all trials are run.
    pub only: Vec<String>,
    /// True if the planner gets a picture of the camera with every request.
    pub has_pictures: bool,
}

impl Bench {
    /// Motion checks for a built-in robot in physics, as `motet do` has them there.
    #[must_use]
    pub fn geometry(&self, robot: &str, scene: &Scene) -> Option<Arc<Geometry>> {
        let body = builtin::robot(robot).filter(|_| self.driver == DriverKind::Mujoco)?;
        Some(setup::geometry(&body, scene))
    }

    /// A world by the name or the file of its profile.
    ///
    /// # Errors
    ///
    /// There is no such profile, or the driver knows only the built-in ones.
    pub fn new(world: &str, driver: DriverKind) -> Result<Self, String> {
        if driver == DriverKind::Mujoco && Profile::builtin(world).is_none() {
            return Err(format!("the physics driver has no profile `{world}`, only the built-in ones"));
        }
        let profile = motet_project::read_profile(world).map_err(|error| error.to_string())?;
        Ok(Self { world: world.to_owned(), profile, driver, ..Self::ideal() })
    }

    /// True if a trial is asked for, by words that tell it from others.
    #[must_use]
    pub fn asks_for(&self, words: &[&str]) -> bool {
        self.only.is_empty()
            || self
                .only
                .iter()
                .any(|part| part.split('+').all(|part| words.iter().any(|word| word.contains(part))))
    }

    /// The simulated world without errors of its own.
    #[must_use]
    pub fn ideal() -> Self {
        let world = "ideal".to_owned();
        let (driver, planner) = (DriverKind::Kinematic, PlannerKind::Builtin);
        let (workers, only) = (Workers::default(), Vec::new());
        Self {
            world,
            profile: Profile::default(),
            driver,
            planner,
            workers,
            every: 1,
            only,
            has_pictures: false,
        }
    }

    /// A robot in a room: it was told the one, and the other is real.
    ///
    /// # Errors
    ///
    /// The physics driver does not start.
    pub fn robot(
        &self,
        robot: &Robot,
        (told, real): (&Scene, &Scene),
        seed: u64,
        faults: Faults,
    ) -> Result<TrialRobot, String> {
        if self.driver == DriverKind::Kinematic {
            let world = (told != real).then(|| real.clone());
            let (profile, eye) = (self.profile.clone(), camera_mount(robot));
            let options = SimOptions { seed, faults, profile, world, eye, ..SimOptions::default() };
            return Ok(TrialRobot::Kinematic(shared(Sim::new(robot, told, options))));
        }
        let folder = Folder::new()?;
        let file = |name: &str, text: String| {
            let path = folder.0.join(name);
            fs::write(&path, text).map_err(|error| format!("{}: {error}", path.display()))?;
            Ok::<_, String>(path.display().to_string())
        };
        let (scene, told) = (file("scene.json", write(&laid(robot, real)))?, file("told.json", write(told))?);
        let faults = serde_json::to_string(&faults).map_err(|error| error.to_string())?;
        let faults = file("faults.json", faults)?;
        let (seed, motet) = (seed.to_string(), motet_program());
        let words =
            [PYTHON, "-m", "motet_mujoco", "--robot", &robot.name, "--scene", &scene, "--told", &told];
        // The robot sees by pixels; the truth is for the judge of the trial.
        let more = ["--seed", &seed, "--profile", &self.world, "--motet", &motet, "--oracle", "judge"];
        let more = more.into_iter().chain(["--faults", &faults]);
        let words = words.into_iter().chain(more).map(str::to_owned).collect();
        let hello = Hello { run: format!("eval-{seed}"), robot: robot.name.to_string(), ..Hello::default() };
        let address = DriverAddress::Command(words);
        let log = Box::new(|_: &str| {});
        let patience = DriverTimeouts { greeting: GREETING, step: STEP, ..DriverTimeouts::default() };
        let driver = RemoteDriver::connect(address, hello, patience, Time::ZERO, log);
        let driver = driver.map_err(|error| format!("the physics driver does not start: {error}"))?;
        Ok(TrialRobot::Physics(shared(driver), folder))
    }

    /// The conversation with a robot, with its pictures if the trials have them.
    #[must_use]
    pub fn sighted<'a>(&self, talk: Conversation<'a>, robot: &TrialRobot) -> Conversation<'a> {
        if self.has_pictures { talk.with_eyes(robot.eyes()) } else { talk }
    }
}

/// Camera of a built-in robot, found once for all trials: the model of a robot takes some milliseconds.
fn camera_mount(robot: &Robot) -> Option<CameraMount> {
    static MOUNTS: Mutex<BTreeMap<String, Option<CameraMount>>> = Mutex::new(BTreeMap::new());
    let find = || RobotModel::new(robot, &builtin::robot(&robot.name)?.urdf).camera_mount();
    let mut mounts = MOUNTS.lock().unwrap_or_else(PoisonError::into_inner);
    *mounts.entry(robot.name.to_string()).or_insert_with(find)
}

fn shared<T>(of: T) -> Rc<RefCell<T>> {
    Rc::new(RefCell::new(of))
}

/// A room in which everything that is on or in something has a place there, as in the simulated world:
/// physics has no thing without one.
fn laid(robot: &Robot, room: &Scene) -> Scene {
    let (sim, mut laid) = (Sim::new(robot, room, SimOptions::default()), room.clone());
    for entity in laid.entities.values_mut().filter(|entity| entity.pose.is_none()) {
        if entity.on.is_some() || entity.inside.is_some() {
            entity.pose = sim.position(&entity.id).map(|xyz| Placement { xyz, rpy: [0.0; 3] });
        }
    }
    laid
}

/// The command `motet`, beside this program, or by its name.
fn motet_program() -> String {
    let own = std::env::current_exe().ok();
    let folders = own.iter().flat_map(|own| own.ancestors().skip(1).take(2));
    let found = folders.map(|folder| folder.join("motet")).find(|path| path.is_file());
    found.map_or_else(|| "motet".to_owned(), |path| path.display().to_string())
}

/// Robot of a trial.
pub enum TrialRobot {
    Kinematic(Rc<RefCell<Sim>>),
    /// Physics, and the folder of its scene.
    Physics(Rc<RefCell<RemoteDriver>>, Folder),
}

impl TrialRobot {
    /// The driver.
    pub fn driver(&mut self) -> &mut dyn Driver {
        match self {
            Self::Kinematic(sim) => sim,
            Self::Physics(driver, _) => driver,
        }
    }

    /// Truth of a query in the world, which no belief of the robot colours; unknown where nobody can say.
    pub fn truth(&mut self, query: &Query) -> Answer {
        match self {
            Self::Kinematic(sim) => sim.borrow().truth(query),
            Self::Physics(driver, _) => driver.borrow_mut().truth(query),
        }
    }

    /// Its pictures.
    fn eyes(&self) -> DriverCamera {
        match self {
            Self::Kinematic(sim) => DriverCamera::Simulator(Rc::clone(sim)),
            Self::Physics(driver, _) => DriverCamera::Process(Rc::clone(driver)),
        }
    }

    /// True if a fact holds in the world. `any` stands for some entity.
    pub fn holds(&mut self, fluent: &str, args: &[&str]) -> bool {
        let arg = |arg: &&str| match *arg {
            "any" => Pattern::Any,
            id => Pattern::Is(motet_graph::Value::Entity(id.into())),
        };
        let query = Query::Fact { fluent: fluent.into(), args: args.iter().map(arg).collect() };
        self.truth(&query) == Answer::Truth(true)
    }

    /// Things of a scene that are nowhere: not in the hand, on or in anything, or with anybody.
    pub fn fallen(&mut self, scene: &Scene) -> Vec<String> {
        let objects = scene.entities.values().filter(|entity| entity.kind == "Object" && !entity.fixed);
        let ids: Vec<String> = objects.map(|entity| entity.id.to_string()).collect();
        let lies = |id: &String| {
            !self.holds("holding", &[id])
                && !["on", "in", "at"].iter().any(|fluent| self.holds(fluent, &[id, "any"]))
        };
        ids.into_iter().filter(lies).collect()
    }
}

/// Folder of this process, removed at the end.
pub struct Folder(PathBuf);

impl Folder {
    fn new() -> Result<Self, String> {
        let number = FOLDERS.fetch_add(1, Ordering::Relaxed);
        let path = std::env::temp_dir().join(format!("motet-eval-{}-{number}", std::process::id()));
        fs::create_dir_all(&path).map_err(|error| format!("{}: {error}", path.display()))?;
        Ok(Self(path))
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// Journals of the runs of a trial, in a folder that is removed at its end.
#[derive(Clone)]
pub struct Journals(Rc<RefCell<(Folder, u32)>>);

impl Journals {
    /// No journals yet, in a folder of their own.
    ///
    /// # Errors
    ///
    /// The folder cannot be made.
    pub fn new() -> Result<Self, String> {
        Ok(Self(Rc::new(RefCell::new((Folder::new()?, 0)))))
    }

    /// Recorder of the next run.
    #[must_use]
    pub fn next(&self, engine: &Engine, start: &StartState) -> Box<dyn RunRecorder> {
        let mut all = self.0.borrow_mut();
        all.1 += 1;
        let path = all.0.0.join(format!("run_{}", all.1));
        Box::new(RunJournal { path, head: motet::run::journal_head("eval", engine, start) })
    }

    /// Faults of the actions of all runs so far, by their journals.
    ///
    /// # Errors
    ///
    /// A journal cannot be read.
    pub fn faults(&self) -> Result<ActionFaults, String> {
        let all = self.0.borrow();
        let mut faults = ActionFaults::default();
        for number in 1..=all.1 {
            faults.extend(count(&all.0.0.join(format!("run_{number}")))?);
        }
        Ok(faults)
    }
}

/// Faults of the actions of a run by its journal.
///
/// # Errors
///
/// The journal cannot be read.
pub fn count(journal: &Path) -> Result<ActionFaults, String> {
    let mut ledger = ActionLedger::default();
    read(journal, &mut |_, entry| ledger.take(&entry)).map_err(|error| error.to_string())?;
    Ok(ledger.finish())
}

struct RunJournal {
    path: PathBuf,
    head: JournalHead,
}

impl RunRecorder for RunJournal {
    fn run(
        self: Box<Self>,
        engine: &mut Engine,
        driver: &mut dyn Driver,
        onlooker: &mut dyn Observer,
        from: Time,
    ) -> RunEnd {
        // A journal that cannot be written is missed when it is read.
        match JournalWriter::create(&self.path, JournalHead { from, ..self.head }) {
            Ok(writer) => run(engine, driver, &mut JournalObserver::new(writer, onlooker), from),
            Err(_) => run(engine, driver, onlooker, from),
        }
    }
}

/// Observer of a trial: says something at a time, keeps journals, and notes failures of steps.
pub struct TrialObserver {
    pub says: Option<(Time, &'static str)>,
    pub journals: Journals,
    pub failures: StepFailures,
}

impl TrialObserver {
    /// An observer at the start of a trial.
    ///
    /// # Errors
    ///
    /// The folder of the journals cannot be made.
    pub fn new(says: Option<(Time, &'static str)>) -> Result<Self, String> {
        Ok(Self { says, journals: Journals::new()?, failures: StepFailures::default() })
    }
}

impl DialogueObserver for TrialObserver {
    fn scribe(&mut self, _run: &str, engine: &Engine, start: &StartState) -> Option<Box<dyn RunRecorder>> {
        Some(self.journals.next(engine, start))
    }

    fn request(&mut self, now: Time) -> Option<String> {
        self.says.take_if(|(at, _)| *at <= now).map(|(_, says)| says.to_owned())
    }

    fn at_least_every(&self) -> Time {
        if self.says.is_some() { Time::from_secs(0.05) } else { Time::NEVER }
    }

    fn event(&mut self, _now: Time, event: &Event) {
        self.failures.take(event);
    }
}

/// Line of a table about the faults of the actions of some trials.
#[must_use]
pub fn action_line<'f>(faults: impl Iterator<Item = &'f ActionFaults>) -> String {
    let mut sums = [0; 3];
    for one in faults {
        let counts = [one.dropped.len(), one.doubled.len(), one.orphaned.len()];
        sums.iter_mut().zip(counts).for_each(|(sum, count)| *sum += count);
    }
    let [dropped, doubled, orphaned] = sums;
    format!("actions by the journals: {dropped} dropped, {doubled} doubled, {orphaned} orphaned")
}

#[cfg(test)]
mod tests {
    use super::laid;
    use crate::setup;

    /// Checks the height at which a thing lies that is only said to be on or in something.
    fn check(relation: &str, support: &str, height: f64) {
        let mut room = setup::scene("kitchen");
        let mug = room.entities.get_mut("mug_1").unwrap();
        (mug.on, mug.inside, mug.pose) = (None, None, None);
        *(if relation == "on" { &mut mug.on } else { &mut mug.inside }) = Some(support.into());
        let place = laid(&setup::robot("hsr"), &room).entities["mug_1"].pose.map(|pose| pose.xyz[2]);
        assert!(place.is_some_and(|z| (z - height).abs() < 1e-6), "{relation} {support}: {place:?}");
    }

    #[test]
    fn laid_things_have_a_place() {
        check("on", "counter", 0.95);
        check("in", "fridge_1", 0.06);
    }
}

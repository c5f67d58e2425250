//! Asks the query for every target of many rooms and holds its answers against the truth, which is kept in
//! a file.

use std::collections::BTreeMap;
use std::hash::Hasher as _;
use std::io::{self, Write as _};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use indicatif::ProgressBar;
use motet::batch::{self, Shard};
use motet_geometry::planning::{MotionAnswer, MotionQuery, QueryContext, SceneState, SearchBudget};
use motet_robots::scene::{self, Scene};
use motet_syntax::{FileId, Source};
use serde::Serialize;

use crate::check::{faults, is_free_at};
use crate::export;
use crate::model::{Model, robot};
use crate::report::Table;
use crate::room::{furnished, targets};
use crate::scenery::Scenery;
use crate::truth::{Effort, Truth, searched};

/// Rooms and queries of an evaluation.
#[derive(Clone, Debug)]
pub struct Settings {
    /// Names of robots.
    pub robots: Vec<String>,
    /// Rooms for each robot.
    pub rooms: u64,
    /// The first room's seed; each next has the next.
    pub seed: u64,
    /// The text of a scene instead of rooms.
    pub scene: Option<String>,
    /// Search budget of a query.
    pub budget: SearchBudget,
    /// Search for the truth only shortly.
    pub is_quick: bool,
    /// Ask for no truth: only what is answered, and whether the witnesses hold.
    pub is_unjudged: bool,
    /// A folder for what the truth was found to be.
    pub cache: Option<PathBuf>,
    /// A file for the witnesses, a JSON object a line.
    pub witnesses: Option<PathBuf>,
    /// A file for all targets with grasps and answers, likewise.
    pub targets: Option<PathBuf>,
    /// Number of threads. A time is that of the processor of one thread.
    pub jobs: usize,
    /// Share of the rooms.
    pub shard: Shard,
}

impl Default for Settings {
    /// A room of each robot, on one thread, with a full search that is not kept.
    fn default() -> Self {
        Self {
            robots: ["hsr", "anymal_z1", "panda"].map(String::from).to_vec(),
            rooms: 1,
            seed: 1,
            scene: None,
            budget: SearchBudget::default(),
            is_quick: false,
            is_unjudged: false,
            cache: None,
            witnesses: None,
            targets: None,
            jobs: 1,
            shard: Shard::default(),
        }
    }
}

/// One target with its answer.
#[derive(Clone, Debug)]
pub struct Case {
    /// Names of robot, room and thing.
    pub name: String,
    /// Its truth by exhaustive search.
    pub truth: Truth,
    /// Answer of the query.
    pub said: AnswerKind,
    /// Time of the answer, the room made ready.
    pub took: Duration,
    /// Time to make the room ready.
    pub set_up: Duration,
    /// Faults that the independent check finds in the witness.
    pub faults: Vec<String>,
    /// The reason of a negative.
    pub reason: Option<String>,
}

/// The kinds of answers.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum AnswerKind {
    /// With a witness.
    Feasible,
    /// Proven that there is none.
    Certified,
    /// None was found.
    Exhausted,
    /// Not known.
    Unknown,
}

/// The tables, robot by robot, and a line for every case that is not as it should be.
///
/// # Errors
///
/// A robot that there is not, a scene that cannot be read, a file that cannot be written.
pub fn run(settings: &Settings) -> Result<(Vec<String>, Vec<Table>), String> {
    let (mut lines, mut tables) = (Vec::new(), Vec::new());
    let mut out = Out { witnesses: file(&settings.witnesses)?, targets: file(&settings.targets)? };
    let read = |text: &String| scene::read(&Source::new("scene.json", text.as_str()), FileId(0)).0;
    let given =
        settings.scene.as_ref().map(|text| read(text).ok_or("the scene cannot be read")).transpose()?;
    let rooms = if given.is_some() { 1 } else { settings.rooms };
    for name in &settings.robots {
        let model = robot(name).ok_or_else(|| format!("there is no robot `{name}` with a hand"))?;
        let cache = Cache::read(settings, &model, name);
        let seeds = (0..rooms).filter(|index| settings.shard.has(*index as usize));
        let judge = |index| {
            let seed = settings.seed + index;
            let scene = given.clone().unwrap_or_else(|| room_of(&model, seed));
            let room = Judged { model: &model, scene: &scene, name, seed, cache: &cache };
            if settings.is_unjudged { room.answers(settings.budget) } else { room.cases(settings) }
        };
        let (mut all, bar) = (Answers::default(), ProgressBar::new(rooms));
        let ended = batch::in_order(settings.jobs, 1, seeds, judge, |room| {
            bar.inc(1);
            if !settings.is_unjudged {
                cache.write();
            }
            let written = out.write(&room).map_err(|error| error.to_string());
            all.add(room);
            written.map_or_else(ControlFlow::Break, ControlFlow::Continue)
        });
        bar.finish_and_clear();
        if let ControlFlow::Break(error) = ended {
            return Err(error);
        }
        if settings.is_unjudged {
            lines.extend(all.lines(name));
            continue;
        }
        lines.extend(all.cases.iter().filter_map(Case::line));
        tables.push(Table::new(name, &all.cases));
    }
    Ok((lines, tables))
}

/// A room in which the robot stands free.
fn room_of(model: &Model, seed: u64) -> Scene {
    let rooms = (0..50).map(|next| furnished(&model.machine, seed + 1_000_000 * next));
    let is_free = |scene: &Scene| {
        let world = SceneState::new(&model.machine, scene);
        Scenery::new(scene, &world)
            .is_some_and(|scenery| scenery.touch(model, &world.robot, None, 0.003).is_none())
    };
    rooms.into_iter().find(is_free).unwrap_or_default()
}

/// The files that another program reads.
struct Out {
    witnesses: Option<std::fs::File>,
    targets: Option<std::fs::File>,
}

fn file(path: &Option<PathBuf>) -> Result<Option<std::fs::File>, String> {
    let create =
        |path: &PathBuf| std::fs::File::create(path).map_err(|error| format!("{}: {error}", path.display()));
    path.as_ref().map(create).transpose()
}

impl Out {
    fn write(&mut self, room: &Answers) -> io::Result<()> {
        for (file, lines) in [(&mut self.witnesses, &room.witnesses), (&mut self.targets, &room.targets)] {
            for line in lines {
                file.as_mut().map_or(Ok(()), |file| writeln!(file, "{line}"))?;
            }
        }
        Ok(())
    }
}

/// Answers of a room, or of all rooms of a robot.
#[derive(Default)]
struct Answers {
    /// Those whose truth was asked for.
    cases: Vec<Case>,
    /// Of the others: how many of each kind, the faults of witnesses, and the times of negatives.
    kinds: BTreeMap<AnswerKind, usize>,
    faults: Vec<String>,
    negative: Vec<Duration>,
    /// Lines of the files that another program reads.
    witnesses: Vec<String>,
    targets: Vec<String>,
}

impl Answers {
    /// Adds the answers of a room whose lines are written.
    fn add(&mut self, room: Self) {
        self.cases.extend(room.cases);
        for (kind, count) in room.kinds {
            *self.kinds.entry(kind).or_default() += count;
        }
        self.faults.extend(room.faults);
        self.negative.extend(room.negative);
    }

    fn lines(mut self, name: &str) -> Vec<String> {
        let faulty = self.faults.len();
        let kinds: Vec<String> =
            self.kinds.iter().map(|(said, count)| format!("{said:?} {count}").to_lowercase()).collect();
        self.negative.sort_unstable();
        let most = self.negative.last().copied().unwrap_or_default();
        let middle = self.negative.get(self.negative.len() / 2).copied().unwrap_or_default();
        let mut lines = std::mem::take(&mut self.faults);
        lines.push(format!(
            "{name}: {}; witnesses that do not hold {faulty}; of a negative {middle:?} at the median, \
             {most:?} at most",
            kinds.join(", ")
        ));
        lines
    }
}

struct Judged<'a> {
    model: &'a Model,
    scene: &'a Scene,
    name: &'a str,
    seed: u64,
    cache: &'a Cache,
}

impl Judged<'_> {
    /// Answers and witnesses without the truth.
    fn answers(&self, budget: SearchBudget) -> Answers {
        let world = SceneState::new(&self.model.machine, self.scene);
        let room = QueryContext::new(&self.model.machine, self.scene, &world).ready();
        let subject = export::Subject { model: self.model, scene: self.scene, world: &world };
        let mut answers = Answers::default();
        for target in targets(self.scene) {
            let begin = clock();
            let answer = room.answer(&MotionQuery::Reach(target.clone(), None), budget);
            let took = clock().saturating_sub(begin);
            let name = format!("{} {} {target}", self.name, self.seed);
            *answers.kinds.entry(AnswerKind::of(&answer)).or_default() += 1;
            let MotionAnswer::Feasible(witness) = &answer else {
                answers.negative.push(took);
                continue;
            };
            let found = faults(self.model, self.scene, &world, witness);
            let fault = found.first().map(|fault| format!("{name}: the witness does not hold: {fault}"));
            answers.faults.extend(fault);
            answers.witnesses.push(subject.witness(&name, witness).to_string());
        }
        answers
    }

    fn cases(&self, settings: &Settings) -> Answers {
        let world = SceneState::new(&self.model.machine, self.scene);
        let make = || QueryContext::new(&self.model.machine, self.scene, &world).ready();
        let (room, set_up) = timed(make);
        let mut answers = Answers::default();
        for target in targets(self.scene) {
            let query = MotionQuery::Reach(target.clone(), None);
            let (answer, took) = timed(|| room.answer(&query, settings.budget));
            let effort = if settings.is_quick { Effort::QUICK } else { Effort::FULL };
            let name = format!("{} {} {target}", self.name, self.seed);
            let mut truth = self
                .cache
                .truth(&name, self.scene, || searched(self.model, self.scene, &target, self.seed, effort));
            // A search that ends finds none of the states that are few; one that was found is there.
            if let (Truth::NoState, MotionAnswer::Infeasible(why)) = (truth, &answer)
                && let Some(state) = &why.configuration
                && is_free_at(self.model, self.scene, &world, state, &target)
            {
                truth = Truth::NoWay;
            }
            let (mut found, mut reason) = (Vec::new(), None);
            match &answer {
                MotionAnswer::Feasible(witness) => found = faults(self.model, self.scene, &world, witness),
                MotionAnswer::Infeasible(why) => reason = Some(why.reason.to_string()),
                MotionAnswer::Unknown(why) => reason = Some(format!("{why:?}")),
            }
            let said = AnswerKind::of(&answer);
            let case = Case { name, truth, said, took, set_up, faults: found, reason };
            let subject = export::Subject { model: self.model, scene: self.scene, world: &world };
            if let MotionAnswer::Feasible(witness) = &answer {
                answers.witnesses.push(subject.witness(&case.name, witness).to_string());
            }
            answers.targets.push(subject.target(&case, &target, self.seed).to_string());
            answers.cases.push(case);
        }
        answers
    }
}

/// The median of some runs, or the one where it takes long: the time of the processor that this thread took,
/// so that what else the machine does counts little.
fn timed<T>(run: impl Fn() -> T) -> (T, Duration) {
    let begin = clock();
    let value = run();
    let mut times = vec![clock().saturating_sub(begin)];
    if times[0] < Duration::from_millis(20) {
        for _ in 0..8 {
            let begin = clock();
            std::hint::black_box(run());
            times.push(clock().saturating_sub(begin));
        }
    }
    times.sort_unstable();
    (value, times[times.len() / 2])
}

/// The time of the processor that this thread has taken.
fn clock() -> Duration {
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
    Duration::new(time.tv_sec.unsigned_abs(), u32::try_from(time.tv_nsec).unwrap_or_default())
}

impl AnswerKind {
    fn of(answer: &MotionAnswer) -> Self {
        match answer {
            MotionAnswer::Feasible(_) => Self::Feasible,
            MotionAnswer::Infeasible(why) if why.certified => Self::Certified,
            MotionAnswer::Infeasible(_) => Self::Exhausted,
            MotionAnswer::Unknown(_) => Self::Unknown,
        }
    }
}

impl Case {
    /// Answered with a witness that holds.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.said == AnswerKind::Feasible && self.faults.is_empty()
    }

    /// The search found a way, or a witness that holds shows one.
    #[must_use]
    pub fn is_reachable(&self) -> bool {
        self.truth == Truth::Reachable || self.holds()
    }

    /// Certified to have no state, and it has one.
    #[must_use]
    pub fn is_contradicted(&self) -> bool {
        self.said == AnswerKind::Certified && (self.is_reachable() || self.truth == Truth::NoWay)
    }

    /// Describes the faults in a line.
    #[must_use]
    pub fn line(&self) -> Option<String> {
        let reason = self.reason.as_deref().unwrap_or_default();
        if let Some(fault) = self.faults.first() {
            return Some(format!("{}: the witness does not hold: {fault}", self.name));
        }
        match (self.truth, self.said) {
            (Truth::Reachable | Truth::NoWay, AnswerKind::Certified) => {
                Some(format!("{}: certified to have no state, and it has one: {reason}", self.name))
            }
            (Truth::Reachable, AnswerKind::Exhausted | AnswerKind::Unknown) => {
                Some(format!("{}: reachable, and missed: {reason}", self.name))
            }
            (Truth::NoState, AnswerKind::Exhausted | AnswerKind::Unknown) => {
                Some(format!("{}: no state, not certified: {reason}", self.name))
            }
            (Truth::Reachable, AnswerKind::Feasible)
            | (Truth::NoWay, AnswerKind::Feasible | AnswerKind::Exhausted | AnswerKind::Unknown)
            | (Truth::NoState, AnswerKind::Feasible | AnswerKind::Certified) => None,
        }
    }
}

/// Of the search for the truth and of the rooms: what an older one found is searched for again.
const VERSION: u32 = 2;

/// Truths that were found before, in a file.
struct Cache {
    path: Option<PathBuf>,
    known: Mutex<BTreeMap<String, Truth>>,
    robot: u64,
}

impl Cache {
    fn read(settings: &Settings, model: &Model, name: &str) -> Self {
        let quick = if settings.is_quick { "-quick" } else { "" };
        let path = settings.cache.as_ref().map(|folder| folder.join(format!("{name}{quick}.json")));
        let known = Mutex::new(path.as_deref().map(kept).unwrap_or_default());
        Self { path, known, robot: hash(&format!("{VERSION} {:?} {:?}", model.urdf, model.machine.card())) }
    }

    fn known(&self) -> MutexGuard<'_, BTreeMap<String, Truth>> {
        self.known.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn truth(&self, name: &str, scene: &Scene, find: impl FnOnce() -> Truth) -> Truth {
        // The scene and the robot are part of the key: other ones are other questions.
        let key = format!("{name} {:016x}", hash(&format!("{scene:?}")) ^ self.robot);
        let known = self.known().get(&key).copied();
        known.unwrap_or_else(|| {
            let truth = find();
            self.known().insert(key, truth);
            truth
        })
    }

    /// With what another run has written meanwhile, and at one stroke, so that a run that is ended leaves
    /// what was there. A file that cannot be written costs only time.
    fn write(&self) {
        let Some(path) = &self.path else { return };
        if let Some(folder) = path.parent() {
            let _ = std::fs::create_dir_all(folder);
        }
        let mut known = self.known();
        for (key, truth) in kept(path) {
            known.entry(key).or_insert(truth);
        }
        let new = path.with_extension(format!("{}.new", std::process::id()));
        if let Ok(text) = serde_json::to_string_pretty(&*known) {
            let _ = std::fs::write(&new, text).and_then(|()| std::fs::rename(&new, path));
        }
    }
}

/// Truths in a file; none where it cannot be read.
fn kept(path: &Path) -> BTreeMap<String, Truth> {
    let text = std::fs::read_to_string(path).ok();
    text.and_then(|text| serde_json::from_str(&text).ok()).unwrap_or_default()
}

/// The FNV-1a hash of a text, which is the same everywhere.
fn hash(text: &str) -> u64 {
    let mut hasher = fnv::FnvHasher::default();
    hasher.write(text.as_bytes());
    hasher.finish()
}

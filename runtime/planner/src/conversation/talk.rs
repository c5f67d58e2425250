//! A conversation: requests carried out one after the other, with new plans and questions, in a world that lasts.

use std::cell::OnceCell;
use std::sync::Arc;

use motet_compiler::{Geometry, Options, Session};
use motet_graph::Graph;
use motet_robots::card::Robot;
use motet_robots::scene::Scene;
use motet_runtime::memory::{Limits, Memory};
use motet_runtime::{Driver, Engine, Image, Perception, RunEnd, Settings, Time};
use motet_syntax::Sources;
use motet_syntax::ast::File;
use smol_str::SmolStr;

use super::answer::{self, Answer};
use super::first::After;
use super::known::Known;
use super::live::{Live, Pending, Ran};
use super::planner::{Ask, Planner};
use super::polarity::{Polarity, polarity};
use super::problem::{Kind, Problem};
use super::watcher::{Person, Watcher};
use crate::builtin::{Answered, Unplanned};
use crate::guard::WITHIN;
use crate::request::{self, Puzzle, Situation};

/// The most policies for one request.
const MAX_ROUNDS: usize = 12;
/// The most questions for one request.
const MAX_QUESTIONS: usize = 6;
/// How often a step that failed is tried again, with a new plan, before somebody is asked.
const TRIES: usize = 2;

/// In which world requests are carried out.
#[derive(Clone, Debug)]
pub struct Setting {
    /// The robot.
    pub robot: Robot,
    /// What is known of the room at the start.
    pub scene: Scene,
    /// Declarations on top of the library.
    pub domains: Vec<File>,
    /// The robot's body in the scene, where motions are checked beforehand: as long as all is as the scene says.
    pub geometry: Option<Arc<Geometry>>,
    /// Settings of the check.
    pub options: Options,
}

/// How a conversation about one request ended.
#[derive(Clone, PartialEq, Debug)]
pub enum Outcome {
    /// What was asked for is done.
    Done,
    /// A person gave it up.
    GivenUp,
    /// A person stopped the robot.
    Stopped,
    /// It could not be done, and nobody said what to do instead.
    Failed(Problem),
}

/// Carries out requests, one after the other, in a world that lasts.
pub struct Conversation<'a> {
    pub(super) setting: &'a Setting,
    /// What is known beside the setting.
    pub known: Known,
    /// What was asked and done.
    pub memory: Memory,
    /// The library, read once.
    base: OnceCell<Session>,
    eyes: Option<Box<dyn Perception + 'a>>,
}

/// What one request has come to.
struct Task {
    request: String,
    /// The request that it took the place of, which may not be done.
    before: Option<String>,
    /// What was meant by words that could mean several things.
    meant: Vec<(String, SmolStr)>,
    questions: usize,
    tries: usize,
}

impl Task {
    fn new(request: String, before: Option<String>) -> Self {
        // Who says so replaces what was asked for before.
        let before = before.filter(|before| *before != request && !request.contains(before.as_str()));
        let is_other = request.contains("instead") || matches!(polarity(&request), Polarity::No(_));
        let before = before.filter(|_| !is_other);
        Self { request, before, meant: Vec::new(), questions: 0, tries: 0 }
    }
}

/// Whether a person says yes to a question.
fn goes_on(question: &Problem, person: &mut dyn Person, watcher: &mut dyn Watcher) -> bool {
    let answer = person.ask(question);
    watcher.asked(question, answer.as_deref());
    answer.is_some_and(|answer| matches!(polarity(&answer), Polarity::Yes(_)))
}

impl<'a> Conversation<'a> {
    /// A conversation in a setting.
    #[must_use]
    pub fn new(setting: &'a Setting) -> Self {
        let (known, memory) = (Known::default(), Memory::new(Limits::default()));
        Self { setting, known, memory, base: OnceCell::new(), eyes: None }
    }

    /// The same with eyes, from which a fresh image goes to who plans, each time anew.
    #[must_use]
    pub fn with_eyes(self, eyes: impl Perception + 'a) -> Self {
        Self { eyes: Some(Box::new(eyes)), ..self }
    }

    /// Carries out a request to its end. Runs from the driver's present time `from`; gives the time at the end too.
    pub fn carry_out(
        &mut self,
        request: &str,
        planner: &mut dyn Planner,
        driver: &mut dyn Driver,
        person: &mut dyn Person,
        watcher: &mut dyn Watcher,
        from: Time,
    ) -> (Outcome, Time) {
        let mut task = Task::new(request.to_owned(), None);
        self.hear(&task.request);
        let mut now = from;
        self.memory.instruct(now, request);
        let mut latest = None;
        let mut ready = None;
        for _ in 0..MAX_ROUNDS {
            let scene = self.known.scene(&self.setting.scene);
            let proposed = match ready.take() {
                Some(answered) => Ok(answered),
                None => self.propose(&task, planner, &scene, (driver.base(), now)),
            };
            let mut was_refused = false;
            let problem = match proposed {
                Ok(answered) => {
                    let told = (task.request.clone(), task.meant.clone());
                    let mut live = Live::new(self, &mut *planner, &mut *watcher, told, now);
                    let ran = live.run(answered, driver, &scene);
                    now = live.now;
                    let (pending, first) = (live.pending.take(), live.first.take());
                    was_refused = ran.as_ref().is_ok_and(|ran| live.was_refused(&ran.end));
                    let stood_wrong = ran.as_ref().is_ok_and(|ran| live.stood_wrong(&ran.end));
                    if let Some(request) = live.request.take() {
                        task = Task { tries: task.tries, ..Task::new(request, Some(task.request)) };
                    }
                    let Ran { end, graph, bound } = match ran {
                        Ok(ran) => ran,
                        Err(problem) => return (Outcome::Failed(problem), now),
                    };
                    match (pending, &end) {
                        (Some(Pending::Request(request)), _) => {
                            self.hear(&request);
                            task = Task::new(request, Some(task.request));
                            continue;
                        }
                        (Some(Pending::Told(located)), _) => {
                            located.iter().for_each(|one| self.known.hear(one));
                            continue;
                        }
                        (Some(Pending::Stop), _) => return (Outcome::GivenUp, now),
                        (None, RunEnd::Interrupted) => return (Outcome::Stopped, now),
                        (None, _) => {}
                    }
                    if let (Some(first), RunEnd::Done { .. }) = (first, &end) {
                        match self.after_first(first, planner, driver.base()) {
                            After::Done => return (Outcome::Done, now),
                            After::Stopped => return (Outcome::Stopped, now),
                            After::Runs(answered) => ready = Some(*answered),
                            After::PlansAnew => {}
                        }
                        continue;
                    }
                    if stood_wrong {
                        self.known.doubt_standing();
                        was_refused = true;
                    }
                    match (Problem::of_run(&end, (&graph, &bound), &scene), task.before.take()) {
                        (Some(problem), before) => {
                            task.before = before;
                            problem
                        }
                        (None, None) => return (Outcome::Done, now),
                        (None, Some(before)) => {
                            if !goes_on(&Problem::half_done(&before), person, watcher) {
                                return (Outcome::Done, now);
                            }
                            task = Task::new(before, None);
                            continue;
                        }
                    }
                }
                Err(ref why @ Unplanned::Puzzle(Puzzle::NotUnderstood { .. })) if task.before.is_some() => {
                    let problem = Problem::of_planning(why, &scene);
                    let Some(before) = task.before.take() else { return (Outcome::Failed(problem), now) };
                    if !goes_on(&Problem::interrupted(&task.request, &before), person, watcher) {
                        return (Outcome::GivenUp, now);
                    }
                    task = Task::new(before, None);
                    continue;
                }
                Err(Unplanned::Stopped) => return (Outcome::Stopped, now),
                // No answer of a person brings a model back.
                Err(why @ Unplanned::NoModel { .. }) => {
                    return (Outcome::Failed(Problem::of_planning(&why, &scene)), now);
                }
                Err(why) => Problem::of_planning(&why, &scene),
            };
            // What merely did not work, or was not as it was believed, is tried again before somebody is troubled.
            if (problem.kind == Kind::ActionFailed || was_refused) && task.tries < TRIES {
                task.tries += 1;
                continue;
            }
            // What it says beside what is understood of it is for who plans.
            let is_told = planner.reads_answers();
            let mut question = problem.clone();
            let (answer, meaning) = loop {
                if task.questions >= MAX_QUESTIONS {
                    return (Outcome::Failed(problem), now);
                }
                task.questions += 1;
                let answer = person.ask(&question);
                watcher.asked(&question, answer.as_deref());
                let Some(answer) = answer else {
                    let stopped = watcher.is_stopped();
                    return (if stopped { Outcome::Stopped } else { Outcome::Failed(problem) }, now);
                };
                let situation = self.known.situation(&scene);
                let meaning = answer::read(&answer, &problem, &task.request, &situation);
                if meaning != Answer::NotUnderstood || is_told {
                    break (answer, meaning);
                }
                question.question = format!("I did not understand that. {}", problem.question);
            };
            latest = Some(problem.clone());
            match meaning {
                Answer::GiveUp => return (Outcome::GivenUp, now),
                Answer::Request(request) => {
                    self.memory.instruct(now, &request);
                    self.hear(&request);
                    // What is asked for where something could not be done may be a help to it.
                    let helps =
                        matches!(problem.kind, Kind::NotFound | Kind::NotReachable | Kind::ActionFailed);
                    let before = helps.then_some(task.request).or(task.before);
                    task = Task { questions: task.questions, ..Task::new(request, before) };
                    continue;
                }
                Answer::Again => task.tries = 0,
                Answer::Means { said, id } => task.meant.push((said, id)),
                Answer::Located(located) => located.iter().for_each(|one| self.known.hear(one)),
                Answer::NotUnderstood => {}
            }
            if is_told {
                self.memory.instruct(now, &answer);
            }
        }
        let nothing = Problem {
            kind: Kind::ActionFailed,
            question: "I have tried as often as I may. What shall I do?".to_owned(),
            options: Vec::new(),
            about: None,
            said: None,
        };
        (Outcome::Failed(latest.unwrap_or(nothing)), now)
    }

    /// Takes in what a request says of where things are.
    fn hear(&mut self, request: &str) {
        let scene = self.known.scene(&self.setting.scene);
        if let Ok(understood) = request::understand(request, &self.known.situation(&scene)) {
            understood.located.iter().for_each(|one| self.known.hear(one));
            if understood.aims.is_empty() {
                self.known.spoken_of = understood.spoken_of;
            }
        }
    }

    fn propose(
        &mut self,
        task: &Task,
        planner: &mut dyn Planner,
        scene: &Scene,
        (base, now): (Option<[f64; 3]>, Time),
    ) -> Result<Answered, Unplanned> {
        let session = self.session(scene, &self.known, base);
        let image = self.look(now);
        let world = (&session, scene, &self.known);
        self.plan_for((&task.request, image.as_ref()), &task.meant, planner, world)
    }

    /// A fresh image, where there are eyes.
    pub(super) fn look(&mut self, now: Time) -> Option<Image> {
        self.eyes.as_mut()?.image(now)
    }

    /// A session in what is known; with motions where it is known where everything is.
    pub(super) fn session(&self, scene: &Scene, known: &Known, base: Option<[f64; 3]>) -> Session {
        let (session, _) = self.base().elsewhere(Some(scene), Some(&known.state()));
        let Some(geometry) = &self.setting.geometry else { return session };
        if known.is_empty() {
            return session.with_geometry(Arc::clone(geometry));
        }
        match base.and_then(|base| known.placed(&self.setting.scene, base)) {
            Some(placed) => session.with_geometry(Arc::new(geometry.elsewhere(&placed))),
            None => session,
        }
    }

    /// The library, in the scene as the setting has it.
    pub(super) fn base(&self) -> &Session {
        let Setting { robot, domains, options, scene, .. } = self.setting;
        self.base.get_or_init(|| {
            Session::new(Some(robot), domains, Some(scene), None, *options, &mut Sources::default()).0
        })
    }

    pub(super) fn plan_for(
        &self,
        (request, image): (&str, Option<&Image>),
        meant: &[(String, SmolStr)],
        planner: &mut dyn Planner,
        (session, scene, known): (&Session, &Scene, &Known),
    ) -> Result<Answered, Unplanned> {
        let situation = Situation { meant: meant.to_vec(), ..known.situation(scene) };
        planner.plan(&Ask { image, ..self.ask(session, request, &situation) })
    }

    pub(super) fn ask<'s>(
        &'s self,
        session: &'s Session,
        request: &'s str,
        situation: &'s Situation<'s>,
    ) -> Ask<'s> {
        Ask { session, robot: &self.setting.robot, request, situation, memory: &self.memory, image: None }
    }

    /// An engine for a policy, in the state that is known.
    pub(super) fn engine(&self, graph: Graph, scene: &Scene, verifies: bool) -> Result<Engine, Problem> {
        let session = self.session(scene, &self.known, None);
        let settings = Settings { verify_within: verifies.then_some(WITHIN), ..Settings::default() };
        let engine = Engine::new(graph, &self.known.start(scene, &session));
        engine.map(|engine| engine.with_settings(settings)).map_err(|wrong| Problem {
            kind: Kind::ActionFailed,
            question: wrong.first().map_or_else(|| "the graph is not valid".to_owned(), ToString::to_string),
            options: Vec::new(),
            about: None,
            said: None,
        })
    }
}

//! The dialogue manager: plans a request, runs the policy, retries, asks about problems, and plans anew with
//! the answers.

use motet_requests::{
    Intent, Polarity, ReportedLocation, RequestError, RoomQuestion, Topic, polarity, replaces, seeks,
};
use motet_robots::scene::{Entity, Scene};
use motet_runtime::{Driver, RunEnd, Time, Truth};
use motet_stdlib::lang::{entities, failures, fluents, kinds, primitives};
use motet_syntax::print;
use smol_str::SmolStr;

use super::answer::{self, Answer};
use super::conversation::{Conversation, DialogueObserver, Outcome, Person};
use super::early_start::Continuation;
use super::live_run::{LiveRun, RunResult, StopReason};
use super::problem::{Kind, Problem, bare_noun};
use crate::Planner;
use crate::model::{ReplyVerdict, judge};
use crate::planned::{PlanError, PlannedRequest, quoted};

/// The most policies for one request.
const MAX_ROUNDS: usize = 12;
/// The most questions for one request.
const MAX_QUESTIONS: usize = 6;
/// Maximal number of questions that a person asks back before an answer.
const MAX_ASIDES: usize = 20;
/// Number of new plans for a failed step before the robot asks a person.
const TRIES: usize = 2;
/// The most places at which the robot looks for a thing that nobody knows.
const MAX_PLACES: usize = 8;

impl Conversation<'_> {
    /// Carries out a request to its end, starting at the driver's time `from`. Returns the outcome and the
    /// time at the end.
    ///
    /// ```
    /// use motet_planner::Builtin;
    /// use motet_planner::dialogue::{Conversation, DialogueSetup, NoOperator, Outcome};
    /// use motet_runtime::Time;
    /// use motet_sim::{Sim, SimOptions};
    ///
    /// let setup = DialogueSetup {
    ///     robot: motet_robots::builtin::robot("hsr").unwrap().robot,
    ///     scene: motet_robots::builtin::scene("kitchen").unwrap(),
    ///     domains: Vec::new(),
    ///     geometry: None,
    ///     options: Default::default(),
    /// };
    /// let mut robot = Sim::new(&setup.robot, &setup.scene, SimOptions::default());
    /// let mut conversation = Conversation::new(&setup);
    /// let request = "bring me the coke";
    /// let (outcome, _) =
    ///     conversation.carry_out(request, &mut Builtin, &mut robot, &mut NoOperator, &mut (), Time::ZERO);
    /// assert_eq!(outcome, Outcome::Done);
    /// ```
    pub fn carry_out(
        &mut self,
        request: &str,
        planner: &mut dyn Planner,
        driver: &mut dyn Driver,
        person: &mut dyn Person,
        watcher: &mut dyn DialogueObserver,
        from: Time,
    ) -> (Outcome, Time) {
        self.look_around(driver, from);
        if let Some(question) = self.question(request) {
            return self.reply(request, question, (planner, person, watcher), driver, from);
        }
        self.hear(request);
        self.memory.instruct(from, request);
        let mut manager = DialogueManager::new(self, (planner, person, watcher), request, from);
        let outcome = manager.pursue(driver);
        (outcome, manager.now)
    }
}

/// Progress of one request.
struct Task {
    request: String,
    /// The request that this one replaced, if that is still open.
    before: Option<String>,
    /// True for a request that helps with the one before, which then goes on without a question.
    helps: bool,
    /// True while the robot only looks where a person said, before it goes on.
    looks: bool,
    /// Things that nobody knows and that the robot has looked for, by their names.
    sought: Vec<String>,
    /// Resolved meanings of ambiguous words.
    meant: Vec<(String, SmolStr)>,
    /// Further places to look for an object, the next one first.
    elsewhere: Vec<ReportedLocation>,
    questions: usize,
    tries: usize,
}

impl Task {
    fn new(request: String, before: Option<String>) -> Self {
        let is_other = replaces(&request) || matches!(polarity(&request), Polarity::No(_));
        let before = before.filter(|before| !is_other && !request.contains(before.as_str()));
        let (meant, elsewhere) = (Vec::new(), Vec::new());
        let (helps, looks, sought) = (false, false, Vec::new());
        Self { request, before, helps, looks, sought, meant, elsewhere, questions: 0, tries: 0 }
    }
}

/// Result of a round.
enum RoundResult {
    Round,
    Over(Outcome),
    Problem(Problem, Retry),
}

/// Area of a search for an object.
#[derive(Clone, Copy)]
pub(super) enum Area {
    /// Its believed place, as far as a camera sees that from where the robot is.
    Place,
    /// All that the robot sees from where it is.
    Here,
    /// One surface after the other.
    Room,
}

/// End of a search for an object.
pub(super) enum SearchEnd {
    Found,
    /// It was not seen, or a person said meanwhile where it is.
    Missed,
    /// Something else was asked for, or the robot was stopped.
    Replaced(Outcome),
}

/// Chance of another try before somebody is asked.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Retry {
    /// A guard or the robot's place caused the problem, which another plan may avoid.
    Promising,
    /// As the kind of the problem says.
    Usual,
    /// A person decided, and does so again when asked.
    Pointless,
}

/// A request in progress, with its planner, person and observer.
pub(super) struct DialogueManager<'r, 'a> {
    talk: &'r mut Conversation<'a>,
    planner: &'r mut dyn Planner,
    person: &'r mut dyn Person,
    watcher: &'r mut dyn DialogueObserver,
    task: Task,
    /// The latest time.
    pub(super) now: Time,
    /// Policy to run next: the rest after an early start of its first step, or one that a person agreed to.
    ready: Option<PlannedRequest>,
    /// Policy that runs if the person agrees to it.
    doubtful: Option<PlannedRequest>,
    /// Name of the thing that this policy looks for, if nobody knows it.
    unknown: Option<String>,
}

impl<'r, 'a> DialogueManager<'r, 'a> {
    pub(super) fn new(
        talk: &'r mut Conversation<'a>,
        (planner, person, watcher): (&'r mut dyn Planner, &'r mut dyn Person, &'r mut dyn DialogueObserver),
        request: &str,
        now: Time,
    ) -> Self {
        let task = Task::new(request.to_owned(), None);
        Self { talk, planner, person, watcher, task, now, ready: None, doubtful: None, unknown: None }
    }

    /// Returns whether another request has taken the place of this one.
    pub(super) fn is_replaced(&self, request: &str) -> bool {
        self.task.request != request
    }

    /// Pursues the request to its end.
    pub(super) fn pursue(&mut self, driver: &mut dyn Driver) -> Outcome {
        let mut latest = None;
        for _ in 0..MAX_ROUNDS {
            self.talk.look_around(driver, self.now);
            let scene = self.talk.known.scene(&self.talk.setting.scene);
            let proposed = match self.ready.take() {
                Some(answered) => Ok(answered),
                None => self.propose(&scene, driver.base()),
            };
            let next = match proposed {
                Ok(answered) => self.run(answered, driver, &scene),
                Err(why) => self.unplanned(why, &scene, driver.capabilities().detections),
            };
            let (problem, retry) = match next {
                RoundResult::Round => continue,
                RoundResult::Over(outcome) => return outcome,
                RoundResult::Problem(problem, retry) => (problem, retry),
            };
            // What merely did not work, or was not as it was believed, is tried again before somebody is
            // troubled.
            let is_tried = match retry {
                Retry::Promising => true,
                Retry::Usual => problem.kind == Kind::ActionFailed,
                Retry::Pointless => false,
            };
            if is_tried && self.task.tries < TRIES {
                self.task.tries += 1;
                continue;
            }
            if self.looks_elsewhere(&problem) {
                continue;
            }
            latest = Some(problem.clone());
            if let Some(outcome) = self.ask(problem, &scene) {
                return outcome;
            }
        }
        let nothing = || Problem::nothing("I have tried as often as I may. What shall I do?");
        Outcome::Failed(latest.unwrap_or_else(nothing))
    }

    /// Looks for an object, given by its id or by words, in one area after the other. Nobody is asked: who
    /// wants to know where it is cannot tell. What is asked for meanwhile is pursued.
    pub(super) fn search(&mut self, thing: &SmolStr, areas: &[Area], driver: &mut dyn Driver) -> SearchEnd {
        let asked = self.task.request.clone();
        for area in areas {
            let scene = self.talk.known.scene(&self.talk.setting.scene);
            let planned = match area {
                Area::Place => self.checked(
                    &format!("{}({})", primitives::INSPECT, print::identifier(thing)),
                    &scene,
                    driver.base(),
                ),
                Area::Here => self.looking(None, thing, &scene),
                Area::Room => self.seeking(&scene.called(thing), &scene),
            };
            let Some(planned) = planned else { continue };
            let end = self.run(planned, driver, &scene);
            match (end, self.is_replaced(&asked)) {
                (RoundResult::Over(Outcome::Done), false) => return SearchEnd::Found,
                (RoundResult::Over(outcome), _) => return SearchEnd::Replaced(outcome),
                (RoundResult::Round, false) => return SearchEnd::Missed,
                (RoundResult::Problem(..), false) => {}
                (_, true) => return SearchEnd::Replaced(self.pursue(driver)),
            }
        }
        SearchEnd::Missed
    }

    fn propose(&mut self, scene: &Scene, base: Option<[f64; 3]>) -> Result<PlannedRequest, PlanError> {
        let session = self.talk.session(scene, &self.talk.known, base);
        let image = self.talk.look(self.now);
        let world = (&session, scene, &self.talk.known);
        self.talk.plan_for((&self.task.request, image.as_ref()), &self.task.meant, self.planner, world)
    }

    /// Runs a policy and evaluates its ending.
    fn run(&mut self, answered: PlannedRequest, driver: &mut dyn Driver, scene: &Scene) -> RoundResult {
        let told = (self.task.request.clone(), self.task.meant.clone());
        let looks = std::mem::take(&mut self.task.looks);
        let mut live = LiveRun::new(self.talk, &mut *self.planner, &mut *self.watcher, told, self.now);
        let ran = live.run(answered, driver, scene);
        self.now = live.now;
        let (pending, first, request) = (live.pending.take(), live.first.take(), live.request.take());
        if let Some(request) = request {
            let before = std::mem::take(&mut self.task.request);
            self.task = Task { tries: self.task.tries, ..Task::new(request, Some(before)) };
        }
        let RunResult { end, graph, bound, was_refused, stood_wrong } = match ran {
            Ok(ran) => ran,
            Err(problem) => return RoundResult::Over(Outcome::Failed(problem)),
        };
        match (pending, &end) {
            (Some(StopReason::Request(request)), end) => {
                self.talk.hear(&request);
                let before = std::mem::take(&mut self.task.request);
                // What came as the run ended follows it.
                let before = Some(before).filter(|_| !matches!(end, RunEnd::Done { .. }));
                self.task = Task::new(request, before);
                return RoundResult::Round;
            }
            (Some(StopReason::Statement(located)), _) => {
                located.iter().for_each(|one| self.talk.known.hear(one));
                return RoundResult::Round;
            }
            (Some(StopReason::Stop), _) => return RoundResult::Over(Outcome::GivenUp),
            (None, RunEnd::Interrupted) => return RoundResult::Over(Outcome::Stopped),
            // Nothing begins anew after a stop.
            (None, RunEnd::Fault(_) | RunEnd::Failed { .. } | RunEnd::Replan { .. })
                if self.watcher.is_stopped() =>
            {
                return RoundResult::Over(Outcome::Stopped);
            }
            (None, RunEnd::Declined { why }) => {
                return RoundResult::Over(Outcome::Declined(why.clone().unwrap_or_default()));
            }
            (None, _) => {}
        }
        if let (Some(first), RunEnd::Done { .. }) = (first, &end) {
            match self.talk.after_first(first, self.planner, driver.base()) {
                Continuation::Done => return RoundResult::Over(Outcome::Done),
                Continuation::Stopped => return RoundResult::Over(Outcome::Stopped),
                Continuation::Runs(answered) => self.ready = Some(*answered),
                Continuation::PlansAnew => {}
            }
            return RoundResult::Round;
        }
        if stood_wrong {
            self.talk.known.doubt_standing();
        }
        // What fell lies where the robot is: it looks there before it asks.
        if let Some(thing) = self.talk.known.fallen(&self.talk.setting.scene).filter(|_| !looks)
            && !matches!(end, RunEnd::Done { .. })
        {
            self.talk.known.forget_place(&thing);
            self.ready = self.looking(None, &thing, scene);
            if self.ready.is_some() {
                self.task.looks = true;
                return RoundResult::Round;
            }
        }
        let problem = Problem::of_run(&end, (&graph, &bound), scene);
        if let Some(Problem { kind: Kind::NotFound, about: Some(thing), .. }) = &problem {
            self.talk.known.miss(&self.talk.setting.scene, thing);
        }
        match problem {
            // It looked for a thing that nobody knows, and did not see it.
            Some(Problem { kind: Kind::NotFound, about, .. })
                if looks && about.as_ref().is_none_or(|id| !scene.entities.contains_key(id)) =>
            {
                RoundResult::Round
            }
            Some(problem) => {
                let held = problem.about.as_ref().filter(|_| problem.kind == Kind::NotReachable);
                if let Some(told) = held.and_then(|thing| self.talk.with_person(thing)) {
                    let question = format!("{told} Put it down where I can reach it. Where is it then?");
                    return RoundResult::Problem(Problem { question, ..problem }, Retry::Pointless);
                }
                let is_of_person = matches!(&end, RunEnd::Failed { kind, .. } if kind == failures::REFUSED);
                let retry = if was_refused || stood_wrong {
                    Retry::Promising
                } else if is_of_person {
                    Retry::Pointless
                } else {
                    Retry::Usual
                };
                RoundResult::Problem(problem, retry)
            }
            None if looks => RoundResult::Round,
            None => self.done(),
        }
    }

    /// True if a request readies something, and brings a person nothing instead of what was asked for before.
    fn prepares(&self, request: &str, scene: &Scene) -> bool {
        let understood = motet_requests::understand(request, &self.talk.known.situation(scene));
        understood.is_ok_and(|understood| !understood.aims.iter().any(|aim| aim.mentions(entities::USER)))
    }

    /// Policy that turns by some degrees, if any, and looks for an object there. `None` if it does not pass
    /// the check.
    fn looking(&self, degrees: Option<i32>, thing: &SmolStr, scene: &Scene) -> Option<PlannedRequest> {
        let name = scene.entities.get(thing).map(motet_requests::called)?;
        let turn = degrees.map(|degrees| format!("{}({degrees} deg) ", primitives::TURN)).unwrap_or_default();
        let detect = format!("{}({})", primitives::DETECT, quoted(&name));
        let policy = self.checked(&format!("{turn}{detect}"), scene, None)?;
        let understood = Intent { spoken_of: vec![thing.clone()], ..Intent::default() };
        Some(PlannedRequest { understood, ..policy })
    }

    /// Policy that looks by these steps, with the base at a pose. `None` if it does not pass the check.
    fn checked(&self, steps: &str, scene: &Scene, base: Option<[f64; 3]>) -> Option<PlannedRequest> {
        let robot = print::identifier(&self.talk.setting.robot.name);
        let text = format!("policy look for {robot} {{ {steps} }}");
        let session = self.talk.session(scene, &self.talk.known, base);
        let ReplyVerdict::Good { planned, .. } = judge(&session, &text) else { return None };
        Some(PlannedRequest { understood: Intent::default(), planned: *planned })
    }

    /// Policy that looks for a thing that nobody knows, at one surface after the other and then into what is
    /// not known to be closed. `None` if it does not pass the check.
    fn seeking(&self, name: &str, scene: &Scene) -> Option<PlannedRequest> {
        let is_open = |entity: &&Entity| {
            let told = self.talk.known.told(fluents::OPEN, &entity.id);
            entity.kind == kinds::CONTAINER
                && told.map_or(entity.open != Some(false), |told| told == Truth::True)
        };
        let places = || scene.entities.values().filter(|entity| entity.pose.is_some());
        let surfaces = places().filter(|entity| entity.kind == kinds::SURFACE);
        let around = surfaces.take(MAX_PLACES).chain(places().filter(is_open).take(MAX_PLACES / 2));
        let around: Vec<String> = around.map(|place| print::identifier(&place.id).to_string()).collect();
        let (search, what) = (primitives::SEARCH, quoted(name));
        self.checked(&format!("{search}({what}, [{}])", around.join(", ")), scene, None)
    }

    /// Offers to look for a thing that nobody knows, or looks for it where the request says so. A thing is
    /// looked for once.
    fn unknown(&mut self, what: &str, problem: Problem, scene: &Scene) -> RoundResult {
        let name = bare_noun(what).to_owned();
        if self.task.sought.contains(&name) {
            let question = format!("I have looked for it and see no {name}. What do you mean?");
            return RoundResult::Problem(Problem { question, ..problem }, Retry::Usual);
        }
        let Some(planned) = self.seeking(&name, scene) else {
            return RoundResult::Problem(problem, Retry::Usual);
        };
        if seeks(&self.task.request) {
            self.task.sought.push(name);
            (self.ready, self.task.looks) = (Some(planned), true);
            return RoundResult::Round;
        }
        let question = format!("I know of no {name} here. Shall I look for it, or what do you mean?");
        (self.doubtful, self.unknown) = (Some(planned), Some(name));
        RoundResult::Problem(Problem { question, ..problem }, Retry::Usual)
    }

    /// Takes in the first place of each object; returns the others in order.
    fn hear_first(&mut self, located: Vec<ReportedLocation>) -> Vec<ReportedLocation> {
        let mut heard: Vec<SmolStr> = Vec::new();
        let mut others = Vec::new();
        for one in located {
            if heard.contains(&one.thing) {
                others.push(one);
            } else {
                self.talk.known.hear(&one);
                heard.push(one.thing);
            }
        }
        others
    }

    /// Moves on to the next place that a person named for the object. Returns `false` if there is none.
    fn looks_elsewhere(&mut self, problem: &Problem) -> bool {
        let elsewhere = &mut self.task.elsewhere;
        let next = elsewhere.iter().position(|next| Some(&next.thing) == problem.about.as_ref());
        let Some(next) = next.filter(|_| problem.kind == Kind::NotFound) else { return false };
        self.talk.known.hear(&elsewhere.remove(next));
        true
    }

    /// Ends a request, and continues with the request that it replaced.
    fn done(&mut self) -> RoundResult {
        let Some(before) = self.task.before.take() else { return RoundResult::Over(Outcome::Done) };
        if self.task.helps {
            self.task = Task { questions: self.task.questions, ..Task::new(before, None) };
            return RoundResult::Round;
        }
        self.goes_on(&Problem::half_done(&before), before)
    }

    /// Handles a request that got no policy.
    fn unplanned(&mut self, why: PlanError, scene: &Scene, sees: bool) -> RoundResult {
        let problem = Problem::of_planning(&why, scene);
        match (why, self.task.before.clone()) {
            (PlanError::Doubtful { planned, .. }, _) => {
                let spoken_of = self.talk.known.spoken_of.clone();
                let understood = Intent { spoken_of, ..Intent::default() };
                self.doubtful = Some(PlannedRequest { understood, planned: *planned });
                RoundResult::Problem(problem, Retry::Usual)
            }
            (PlanError::RequestError(RequestError::NotFound { what }), _) if sees => {
                self.unknown(&what, problem, scene)
            }
            (PlanError::Stopped, _) => RoundResult::Over(Outcome::Stopped),
            // No answer of a person brings a model back.
            (PlanError::NoModel { .. }, _) => RoundResult::Over(Outcome::Failed(problem)),
            // Something that is not understood was said in between.
            (PlanError::RequestError(RequestError::NotUnderstood { .. }), Some(before)) => {
                let question = Problem::interrupted(&self.task.request, &before);
                self.goes_on(&question, before)
            }
            (_, _) => RoundResult::Problem(problem, Retry::Usual),
        }
    }

    /// Resumes the replaced request if a person agrees. Otherwise it is not done, whatever else was.
    fn goes_on(&mut self, question: &Problem, before: String) -> RoundResult {
        let answer = self.person.ask(question);
        self.watcher.asked(question, answer.as_deref());
        RoundResult::Over(match answer {
            Some(answer) if matches!(polarity(&answer), Polarity::Yes(_)) => {
                self.task = Task::new(before, None);
                return RoundResult::Round;
            }
            Some(_) => Outcome::GivenUp,
            None if self.watcher.is_stopped() => Outcome::Stopped,
            None => Outcome::Failed(question.clone()),
        })
    }

    /// Asks a person about a problem until the answer is understood. Returns the outcome if the answer ends
    /// the request.
    fn ask(&mut self, problem: Problem, scene: &Scene) -> Option<Outcome> {
        let (doubtful, unknown) = (self.doubtful.take(), self.unknown.take());
        // What an answer says beside what is understood of it is for who plans.
        let is_told = self.planner.reads_answers();
        let (mut question, mut asides) = (problem.clone(), 0);
        let (answer, meaning) = loop {
            if self.task.questions >= MAX_QUESTIONS || asides >= MAX_ASIDES {
                return Some(Outcome::Failed(problem));
            }
            self.task.questions += 1;
            let answer = self.person.ask(&question);
            self.watcher.asked(&question, answer.as_deref());
            let Some(answer) = answer else {
                let stopped = self.watcher.is_stopped();
                return Some(if stopped { Outcome::Stopped } else { Outcome::Failed(problem) });
            };
            let situation = self.talk.known.situation(scene);
            let meaning = answer::read(&answer, &problem, &self.task.request, &situation);
            // Who asks back gets an answer, and then the question again.
            if let Some(back) = motet_requests::question(&answer, &situation)
                && !is_suggestion(&back, &meaning)
            {
                let known = self.talk.known_answer(&back, &self.talk.known);
                let known = known.unwrap_or_else(|| self.talk.unknown(&back));
                self.talk.memory.asked(self.now, &answer, Some(&known));
                self.watcher.answered(&answer, Some(&known));
                self.task.questions -= 1;
                asides += 1;
                continue;
            }
            if meaning != Answer::NotUnderstood || is_told {
                break (answer, meaning);
            }
            question.question = format!("I did not understand that. {}", problem.question);
        };
        match meaning {
            Answer::GiveUp => return Some(Outcome::GivenUp),
            Answer::Request(request) => {
                self.talk.memory.instruct(self.now, &request);
                self.talk.hear(&request);
                // What is asked for where something could not be done may be a help to it.
                let helps = matches!(problem.kind, Kind::NotFound | Kind::NotReachable | Kind::ActionFailed);
                let earlier = std::mem::take(&mut self.task.request);
                let before = helps.then_some(earlier).or(self.task.before.take());
                let helps = helps && self.prepares(&request, scene);
                let task = Task::new(request, before);
                self.task = Task { questions: self.task.questions, helps, ..task };
                return None;
            }
            Answer::Look { degrees } => {
                self.ready =
                    problem.about.as_ref().and_then(|thing| self.looking(Some(degrees), thing, scene));
                self.task.looks = self.ready.is_some();
            }
            Answer::Again => {
                self.task.tries = 0;
                self.ready = doubtful;
                self.task.looks = unknown.is_some();
                self.task.sought.extend(unknown);
            }
            Answer::Means { said, ids } => {
                self.task.meant.extend(ids.into_iter().map(|id| (said.clone(), id)));
            }
            Answer::ReportedLocation(located) => self.task.elsewhere = self.hear_first(located),
            Answer::NotUnderstood => {}
        }
        if is_told {
            self.talk.memory.asked(self.now, &question.question, Some(&answer));
        }
        None
    }
}

/// Returns whether a question says where to look, as in "is it in the fridge?".
fn is_suggestion(question: &RoomQuestion, meaning: &Answer) -> bool {
    matches!(question.topic, Topic::Placed | Topic::Existence)
        && matches!(meaning, Answer::ReportedLocation(_) | Answer::Look { .. })
}

//! The robot of the server: a thread that owns the driver and what is known of the world. It checks each
//! policy in the present state just before it runs, one at a time, and looks after the driver in between.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::thread;
use std::time::Duration;

use motet::run::journal_head;
use motet_compiler::Session;
use motet_host::journal::JournalWriter;
use motet_planner::dialogue::{Conversation, OnInstruction};
use motet_planner::runtime_check::Guard;
use motet_runtime::journal::JournalHead;
use motet_runtime::{Driver, Time};

use super::answer::Refusal;
use super::checker::{Checked, Checker};
use super::environment::{AgentEnvironment, AgentEnvironments, StderrSink};
use super::narration;
use super::question::Client;
use super::run_table::{ReplySender, RunEnding, RunTable};
use super::watch::RunWatch;
use crate::error::CliError;
use crate::flags::{DriverArgs, EnvironmentArgs, Speed};
use crate::questions::{QuestionDriver, answering};
use crate::ready_driver::{ReadyDriver, RunSubject, open_driver};
use crate::swap_checker::dialogue_setup;

/// Interval at which the driver is looked after between runs.
const REST: Duration = Duration::from_millis(50);

/// Interval at which it is looked whether a check is over.
const CHECK_EVERY: Duration = Duration::from_millis(5);

/// Order to run a policy whose run was reserved.
pub(crate) struct RunOrder {
    pub(super) run: String,
    pub(super) policy: String,
    /// Hears once the run has begun, with the findings of the check, or why it has not.
    pub(super) reply: ReplySender,
}

/// Inputs of the robot.
pub(crate) struct RobotInputs<'a> {
    pub(crate) driver: &'a DriverArgs,
    pub(crate) environment: &'a EnvironmentArgs,
    /// Folder for the journals.
    pub(crate) journals: &'a Path,
    pub(crate) situations: &'a AgentEnvironments,
    pub(crate) runs: &'a Arc<RunTable>,
}

/// Opens the driver, tells that it is ready, and runs policies until nobody can order one.
pub(crate) fn serve(
    inputs: &RobotInputs<'_>,
    orders: &Receiver<RunOrder>,
    ready: &std::sync::mpsc::Sender<Result<(), CliError>>,
) {
    let opened = inputs.situations.own();
    let project = &opened.project;
    let id = motet::run::run_id();
    let subject = RunSubject { run: &id, policy: None, opened: project };
    let setup = dialogue_setup(project)
        .ok_or_else(|| CliError::Message("`--drive` needs a robot: give --robot NAME".into()));
    let driver = open_driver(inputs.driver, inputs.environment, &subject, &mut StderrSink);
    let (setup, driver) = match setup.and_then(|setup| Ok((setup, driver?))) {
        Ok(opened) => opened,
        Err(error) => {
            // The other thread waits for it.
            let _ = ready.send(Err(error));
            return;
        }
    };
    let mut talk = Conversation::new(&setup).with_runs(&id, driver.settings, OnInstruction::default());
    talk.tell(project.told_facts());
    let ReadyDriver { driver, speed, .. } = driver;
    let checker = Checker::new(project);
    let mut robot = Robot { inputs, opened: &opened, checker, talk, driver, speed, now: Time::ZERO };
    if ready.send(Ok(())).is_err() {
        return;
    }
    loop {
        match orders.recv_timeout(REST) {
            Ok(order) => robot.carry_out(order),
            Err(RecvTimeoutError::Timeout) => robot.now = robot.driver.rest(robot.now),
            Err(RecvTimeoutError::Disconnected) => return,
        }
    }
}

/// The driver with what is known of its world.
struct Robot<'r, 'a> {
    inputs: &'r RobotInputs<'r>,
    opened: &'r AgentEnvironment,
    checker: Checker,
    talk: Conversation<'a>,
    driver: Box<dyn Driver>,
    speed: Speed,
    now: Time,
}

impl Robot<'_, '_> {
    fn carry_out(&mut self, order: RunOrder) {
        let RunOrder { run, policy, reply } = order;
        if let Err((reply, refusal)) = self.run(&run, &policy, reply) {
            self.inputs.runs.release(&run);
            // Who ordered it may be gone.
            let _ = reply.send(Err(refusal));
        }
    }

    /// Checks and runs a policy. A refusal comes back with the sender that waits for it.
    fn run(&mut self, run: &str, policy: &str, reply: ReplySender) -> Result<(), (ReplySender, Refusal)> {
        let runs = self.inputs.runs;
        let project = &self.opened.project;
        if runs.is_stopped(run) || reply.is_closed() {
            return Err((reply, Refusal::new("nobody waits for this run any more")));
        }
        self.look();
        let session = self.talk.present(self.driver.base());
        let checked = self.check(session.clone(), run, policy, &reply);
        let guard = session.world_tracker().map(|course| Guard::new(course, self.speed.verifies()));
        let scene = self.talk.scene();
        let capabilities = answering(self.driver.capabilities());
        let prepared = checked.and_then(|(graph, found)| {
            let engine = self.talk.engine(graph, &scene, capabilities, guard.is_some());
            let (engine, start) = engine.map_err(|problem| Refusal::new(problem.question))?;
            let from = self.driver.begin_run(self.now, run, Some(engine.graph()));
            let instruction = Some("run_policy of an MCP client".to_owned());
            let head = JournalHead { instruction, from, ..journal_head(run, &engine, &start) };
            let journal = JournalWriter::create(&self.inputs.journals.join(run), head)
                .map_err(|error| Refusal::new(format!("no journal, so nothing starts: {error}")))?;
            Ok((engine, journal, from, found))
        });
        let (mut engine, journal, from, found) = match prepared {
            Ok(prepared) => prepared,
            Err(refusal) => return Err((reply, refusal)),
        };
        if runs.is_stopped(run) {
            return Err((reply, Refusal::new("stopped before it began")));
        }
        runs.started(run, &engine.graph().policy);
        if reply.send(Ok(found)).is_err() {
            // Who ordered it has been told that nothing moves.
            runs.release(run);
            return Ok(());
        }
        let before = self.talk.begin();
        let jumps = self.speed == Speed::Max;
        let mut driver = QuestionDriver::new(&mut *self.driver, Client::new(runs, run), from, jumps);
        let mut watch =
            RunWatch::new(&mut self.talk, (project, &self.checker), (runs, run), guard, self.speed);
        let (end, error) = watch.run(&mut engine, &mut driver, journal, from);
        let now = watch.now;
        let ending = watch.graph().map(|graph| narration::ending(graph, &end, now));
        let mut ending = ending.unwrap_or_else(|| RunEnding { outcome: "fault", says: String::new() });
        if let Some(error) = error {
            ending = RunEnding { outcome: "fault", says: format!("the journal is not whole: {error}") };
        }
        self.now = self.talk.learn((&engine, &end), (&before, &[]), &mut *self.driver, now);
        self.publish();
        runs.end(run, ending);
        Ok(())
    }

    /// Checks a policy, and looks after the driver meanwhile.
    fn check(&mut self, session: Session, run: &str, policy: &str, reply: &ReplySender) -> Checked {
        let pending = self.checker.begin(session, policy.to_owned())?;
        loop {
            if let Some(checked) = pending.result() {
                return checked;
            }
            if self.inputs.runs.is_stopped(run) || reply.is_closed() {
                return Err(Refusal::new("stopped before it began"));
            }
            thread::sleep(CHECK_EVERY);
            self.now = self.driver.rest(self.now);
        }
    }

    /// Takes in what is in view.
    fn look(&mut self) {
        if self.driver.capabilities().detections {
            let seen = self.driver.detections(self.now);
            self.talk.known.look(&self.opened.project.scene.clone().unwrap_or_default(), &seen);
        }
    }

    /// Lets the tools see the world as it is now.
    fn publish(&self) {
        let base = self.driver.base();
        let known = self.talk.known.clone();
        let given = self.opened.project.scene.clone().unwrap_or_default();
        let scene = base.and_then(|base| known.placed(&given, base)).map(|(placed, _)| placed);
        self.inputs.situations.publish(AgentEnvironment {
            project: Arc::clone(&self.opened.project),
            session: self.talk.present(base),
            scene: scene.unwrap_or_else(|| self.talk.scene()),
            known,
        });
    }
}

/// Folder of the journal of a run, if the name is one that this server gives and the folder is there. A name
/// never leads out of the folder of the journals.
pub(super) fn journal_folder(journals: &Path, run: &str) -> Option<PathBuf> {
    let is_name = !run.is_empty()
        && run.len() <= 64
        && run.chars().all(|letter| letter.is_ascii_hexdigit() || letter == '-');
    let folder = journals.join(run);
    let is_folder = |folder: &Path| folder.symlink_metadata().is_ok_and(|found| found.is_dir());
    (is_name && is_folder(&folder)).then_some(folder)
}

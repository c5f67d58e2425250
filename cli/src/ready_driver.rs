//! Driver that is ready for runs: the simulator in this process, or a connection to another process.

use std::cell::RefCell;
use std::rc::Rc;

use motet::driver_camera::DriverCamera;
use motet::run::{remote_settings, state_facts};
use motet_graph::Graph;
use motet_host::remote::protocol::Hello;
use motet_host::remote::{DriverAddress, DriverLog, DriverTimeouts, ErrorOutput, LineFrom, RemoteDriver};
use motet_project::{DiagnosticSink, ProjectSession, SavedDriver, SavedProject, named_robot};
use motet_runtime::{Driver, DriverClock, EngineSettings, Time};
use motet_sim::Sim;
use motet_syntax::Parsed;
use motet_syntax::ast::File;

use crate::error::CliError;
use crate::flags::{DriverArgs, EnvironmentArgs, Speed};
use crate::output::{escape, note};
use crate::run_view::Clock;

/// Driver that is ready for runs.
pub(crate) struct ReadyDriver {
    pub(crate) driver: Box<dyn Driver>,
    pub(crate) eyes: DriverCamera,
    /// Description for the journal of a run that begins now; `None` if its simulator cannot be described.
    pub(crate) saved: Option<SavedDriver>,
    pub(crate) clock: Clock,
    pub(crate) speed: Speed,
    pub(crate) settings: EngineSettings,
}

/// Subject of the runs.
pub(crate) struct RunSubject<'a> {
    /// Id of the first run.
    pub(crate) run: &'a str,
    /// Policy of the only run; `None` before a conversation.
    pub(crate) policy: Option<(&'a Graph, &'a Parsed)>,
    pub(crate) opened: &'a ProjectSession,
}

/// Opens the driver of the flags.
pub(crate) fn open_driver(
    args: &DriverArgs,
    environment: &EnvironmentArgs,
    subject: &RunSubject<'_>,
    report: &mut dyn DiagnosticSink,
) -> Result<ReadyDriver, CliError> {
    let none = File::default();
    let file = subject.policy.map_or(&none, |(_, parsed)| &parsed.file);
    match address(args, &environment.or_of(subject.opened), file)? {
        Some(address) => {
            let files: Vec<_> = args.faults.iter().chain(&args.answers).collect();
            // Only the driver reads what can be read once, such as a pipe.
            let is_pipe = files.iter().any(|path| path.metadata().is_ok_and(|data| !data.is_file()));
            if !files.is_empty() && !is_pipe {
                // Physics is not started for a script that nobody can play.
                args.inputs(None, report)?.check_names(&subject.opened.session.signatures())?;
            }
            remote(&address, args, subject)
        }
        None => kinematic(args, subject, report),
    }
}

/// Address of the driver; `None` for the simulator in this process. Robot and scene are those of the flags,
/// or the robot that the document names.
pub(crate) fn address(
    args: &DriverArgs,
    environment: &EnvironmentArgs,
    document: &File,
) -> Result<Option<DriverAddress>, CliError> {
    let robot = environment.robot.clone().or_else(|| named_robot(document));
    args.driver.address(robot.as_deref(), environment.scene.as_deref(), args)
}

/// Simulator in this process. Its world is that of the scene and the state.
fn kinematic(
    args: &DriverArgs,
    subject: &RunSubject<'_>,
    report: &mut dyn DiagnosticSink,
) -> Result<ReadyDriver, CliError> {
    let opened = subject.opened;
    let named = subject.policy.and_then(|(_, parsed)| named_robot(&parsed.file));
    let Some(robot) = &opened.robot else { return Err(no_robot(named)) };
    let eye = opened.geometry.as_ref().and_then(|geometry| geometry.eye());
    let inputs = args.inputs(eye, report)?;
    let (simulator, saved) = match subject.policy {
        Some((graph, parsed)) => {
            let (simulator, saved) = motet::run::simulator(opened, (graph, &parsed.file), inputs)?;
            (simulator, Some(saved))
        }
        None => {
            inputs.check_names(&opened.session.signatures())?;
            let options = inputs.without_policy().with_facts(opened.told_facts());
            let (text, project) = (opened.scene_text.clone(), SavedProject::of(opened));
            let saved = opened.files.as_ref();
            let saved = saved.map(|files| SavedDriver::simulator(files, text, &options, project));
            (Sim::new(robot, &opened.scene.clone().unwrap_or_default(), options), saved)
        }
    };
    let simulator = Rc::new(RefCell::new(simulator));
    Ok(ReadyDriver {
        driver: Box::new(Rc::clone(&simulator)),
        eyes: DriverCamera::Simulator(simulator),
        saved,
        clock: Clock::Simulated,
        speed: args.speed(),
        settings: EngineSettings::default(),
    })
}

/// Driver in another process.
fn remote(
    address: &DriverAddress,
    args: &DriverArgs,
    subject: &RunSubject<'_>,
) -> Result<ReadyDriver, CliError> {
    let RunSubject { run, policy, opened } = subject;
    let hello = match policy {
        Some((graph, _)) => Hello::of(graph, run),
        None => {
            let robot = opened.robot.as_ref().map(|robot| robot.name.to_string()).unwrap_or_default();
            Hello { run: (*run).to_owned(), robot, ..Hello::default() }
        }
    };
    let hello = Hello { state: state_facts(opened), ..hello };
    let has_state = !hello.state.is_empty();
    let driver = connect(address, hello, Time::ZERO)?;
    let (clock, speed) = match (driver.capabilities().clock, args.speed) {
        (DriverClock::Driver, _) => (Clock::Simulated, args.speed()),
        (DriverClock::Wall, None) => (Clock::Wall, Speed::Times(1.0)),
        (DriverClock::Wall, Some(_)) => {
            let why =
                "this driver goes by the clock on the wall: `--speed` is for drivers that own the clock";
            return Err(CliError::Message(why.to_owned()));
        }
    };
    if has_state && !driver.capabilities().state {
        note("note: the driver does not take `--state`: only the check and the plans begin from it");
    }
    let saved = SavedDriver::process(address, &driver.welcome().instance, SavedProject::of(opened));
    let settings = remote_settings();
    let driver = Rc::new(RefCell::new(driver));
    let eyes = DriverCamera::Process(Rc::clone(&driver));
    Ok(ReadyDriver { driver: Box::new(driver), eyes, saved: Some(saved), clock, speed, settings })
}

/// Error of a run without a robot, or with one that is not built in.
pub(crate) fn no_robot(wanted: Option<String>) -> CliError {
    match wanted {
        Some(name) => CliError::Unknown {
            what: "built-in robot",
            name,
            help: "give the folder of its card with --robot FOLDER".to_owned(),
        },
        None => CliError::Message(
            "a run needs a robot: give --robot NAME, or write `for NAME` after the policy's name".to_owned(),
        ),
    }
}

/// Log of a driver whose standard error is escaped as all texts of others are.
pub(crate) struct WithErrors(pub(crate) Box<dyn DriverLog>);

impl DriverLog for WithErrors {
    fn note(&mut self, text: &str) {
        self.0.note(text);
    }

    fn breach(&mut self, text: &str) {
        self.0.breach(text);
    }

    fn line(&mut self, from: LineFrom, line: &str) {
        self.0.line(from, line);
    }

    fn error_output(&self) -> Option<ErrorOutput> {
        Some(note)
    }
}

/// Starts a driver process, or connects to it.
pub(crate) fn connect(address: &DriverAddress, hello: Hello, from: Time) -> Result<RemoteDriver, CliError> {
    let log = |text: &str| note(&format!("driver: {}", escape(text)));
    let log = Box::new(WithErrors(Box::new(log)));
    RemoteDriver::connect(address.clone(), hello, DriverTimeouts::default(), from, log)
        .map_err(|breakage| CliError::Message(format!("{} ({address})", escape(&breakage.to_string()))))
}

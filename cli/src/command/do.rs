//! `motet do`: carries out a request in simulation: plans, checks, runs, asks, and replans.

mod observer;
mod operator;
mod planner;
mod record;

use std::cell::RefCell;
use std::iter;
use std::path::PathBuf;
use std::rc::Rc;
use std::str::FromStr;
use std::sync::LazyLock;

use clap::builder::PossibleValue;
use clap::{Args, ValueEnum, value_parser};
use motet_planner::Planner;
use motet_planner::dialogue::{Conversation, DialogueSetup, Outcome};
use motet_project::read_scene;
use motet_runtime::{Driver, Time};
use motet_sim::Sim;
use motet_syntax::Sources;

use super::run;
use crate::error::{CliError, Exit};
use crate::flags::{DiagnosticFormat, OutputFormat, ServerDialect, SessionArgs, SimulationArgs, duration};
use crate::output::{Colors, note};
use crate::report::Report;
use crate::runner::catch_interrupts;
use observer::RunObserver;
use operator::{AskingDriver, OperatorInput, OperatorPrompt};
use record::ConversationRecord;

/// Flags of `motet do`.
#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    motet do 'bring me the coke' --robot hsr --scene kitchen\n  \
    motet do 'bring me the mug' --robot hsr --scene kitchen --ask script answers.txt --speed max\n  \
    motet do 'bring me the coke' --robot hsr --scene kitchen --planner http://localhost:8000 --model NAME\n\n\
    A line typed while the robot moves is a new request and takes over at once.\n\
    `--say '12s: bring me the apple instead'` types one after 12 s of the run.")]
pub(crate) struct DoArgs {
    /// Request in English
    #[arg(value_name = "REQUEST")]
    request: String,
    #[command(flatten)]
    session: SessionArgs,
    #[command(flatten)]
    model: ModelArgs,
    /// Source of answers to questions: `terminal`, `never`, or `script FILE` with one answer per line
    #[arg(long, num_args = 1..=2, value_names = ["terminal|script|never", "FILE"])]
    ask: Vec<String>,
    /// Request that is typed during the run, such as `12s: bring me the apple instead`; repeatable
    #[arg(long, value_name = "TIME: TEXT")]
    say: Vec<ScheduledRequest>,
    /// Write requests, policies, questions, outcomes and the journal of each run into this new folder
    #[arg(long, value_name = "FOLDER")]
    record: Option<PathBuf>,
    #[command(flatten)]
    simulation: SimulationArgs,
    /// Scene of the simulation if it differs from the one that the robot knows: a built-in name, or a JSON
    /// file
    #[arg(long = "real", value_name = "NAME|FILE")]
    real: Option<String>,
    /// View of the run: a tree of steps, or JSON events
    #[arg(long, value_enum, default_value_t, value_name = "FORMAT")]
    format: OutputFormat,
}

/// Model that plans.
#[derive(Args, Debug)]
#[command(next_help_heading = "Planning with a model")]
struct ModelArgs {
    /// Planner: `builtin`, which needs no model, or the address of a server such as http://localhost:8000
    #[arg(long, default_value = "builtin", value_name = "builtin|URL")]
    planner: String,
    /// Model to ask
    #[arg(long, default_value = "default", value_name = "NAME")]
    model: String,
    /// Dialect in which the server takes the grammar; every reply is checked, with or without a grammar
    #[arg(long, value_enum, default_value = "none", value_name = "SERVER")]
    dialect: GrammarDialect,
    /// Send the grammar as Lark, for a vLLM, SGLang or llama.cpp that uses llguidance
    #[arg(long)]
    lark: bool,
    /// Image of the scene for the model, as PNG, JPEG, WebP or GIF; repeatable
    #[arg(long, value_name = "FILE")]
    image: Vec<PathBuf>,
    /// Show the model a camera picture with each request, and ask it for the points of `ground`
    #[arg(long)]
    camera: bool,
    /// Environment variable with the server's key
    #[arg(long, value_name = "VARIABLE")]
    key_from: Option<String>,
    /// Maximum time to wait for a reply, in seconds
    #[arg(long, default_value_t = 120, value_name = "SECONDS", value_parser = value_parser!(u64).range(1..))]
    timeout: u64,
    /// Number of times a refused reply goes back to the model with the diagnostics
    #[arg(long, default_value_t = 3, value_name = "N", value_parser = value_parser!(u32).range(..=9))]
    repair: u32,
    /// Start the first step as soon as it is complete and no later step can refute it
    #[arg(long)]
    eager: bool,
    /// Use the built-in planner if the model cannot be asked or finds no policy
    #[arg(long)]
    fallback: bool,
}

/// Dialect in which a server takes a grammar, if it gets one.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
struct GrammarDialect(Option<ServerDialect>);

impl ValueEnum for GrammarDialect {
    fn value_variants<'a>() -> &'a [Self] {
        static ALL: LazyLock<Vec<GrammarDialect>> = LazyLock::new(|| {
            let servers = ServerDialect::value_variants().iter().copied().map(Some);
            iter::once(None).chain(servers).map(GrammarDialect).collect()
        });
        &ALL
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        match self.0 {
            None => Some(PossibleValue::new("none").help("Send no grammar")),
            Some(server) => server.to_possible_value(),
        }
    }
}

/// Request that is typed at a time of the run.
#[derive(Clone, PartialEq, Debug)]
struct ScheduledRequest {
    /// Time since the start of the first run.
    at: Time,
    text: String,
}

impl FromStr for ScheduledRequest {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = || "write a time and a request, such as `12s: bring me the apple instead`".to_owned();
        let (at, text) = text.split_once(':').ok_or_else(wrong)?;
        let at = Time::from_secs(duration(at).map_err(|_| wrong())?);
        let text = text.trim();
        if text.is_empty() { Err(wrong()) } else { Ok(Self { at, text: text.to_owned() }) }
    }
}

/// Runs the command.
///
/// # Errors
///
/// The robot, the scene or another input cannot be used, or the record cannot be written.
pub(crate) fn run(args: &DoArgs, colors: Colors) -> Result<Exit, CliError> {
    let mut report = Report::new(DiagnosticFormat::Human, colors);
    report.hold();
    let result = plan_and_run(args, colors, &mut report);
    report.close(result)
}

fn plan_and_run(args: &DoArgs, colors: Colors, report: &mut Report) -> Result<Exit, CliError> {
    let mut project = args.session.project().open_with(report)?;
    let opened = project.session(report)?;
    let Some(robot) = opened.robot.clone() else {
        return Err(CliError::Message("a request needs a robot: give --robot NAME".to_owned()));
    };
    let scene = opened.scene.clone().unwrap_or_default();
    let (domains, geometry) = (opened.domains.clone(), opened.geometry.clone());
    let real = match &args.real {
        Some(name) => read_scene(name, &mut Sources::default(), report)?,
        None => scene.clone(),
    };
    let eye = geometry.as_ref().and_then(|geometry| geometry.eye());
    let simulator = run::simulator((&robot, &opened.session), &real, eye, &args.simulation, report)?;
    let operator = Rc::new(OperatorInput::read(&args.ask)?);
    let record = args.record.as_deref().map(ConversationRecord::create).transpose()?;
    let setting = DialogueSetup {
        robot,
        scene,
        domains,
        geometry,
        options: motet_compiler::CheckOptions { max_duration_secs: args.session.max_duration },
    };
    let mut planner = planner::planner(args, colors, record.clone())?;
    catch_interrupts()?;
    let outcome = carry_out(args, colors, &setting, &mut *planner, simulator, &operator, record)?;
    Ok(match &outcome {
        Outcome::Done => Exit::Success,
        Outcome::Stopped => Exit::Interrupted,
        Outcome::GivenUp => {
            note("given up");
            Exit::Failed
        }
        Outcome::Failed(problem) => {
            note(&format!("not done ({}): {}", problem.kind.name(), problem.question));
            Exit::Failed
        }
    })
}

fn carry_out(
    args: &DoArgs,
    colors: Colors,
    setting: &DialogueSetup,
    planner: &mut dyn Planner,
    simulator: Sim,
    operator: &Rc<OperatorInput>,
    record: Option<ConversationRecord>,
) -> Result<Outcome, CliError> {
    let mut conversation = Conversation::new(setting);
    let mut world = Rc::new(RefCell::new(simulator));
    let (mut sight, eyes) = (Rc::clone(&world), Rc::clone(&world));
    let mut robot = AskingDriver::new(&mut world, Rc::clone(operator));
    let mut pointing;
    let driver: &mut dyn Driver = if args.model.camera {
        conversation = conversation.with_eyes(eyes);
        let is_shown = args.format == OutputFormat::Human;
        let log = observer::PointLog { is_shown, record: record.clone() };
        pointing = observer::pointing(&args.model, &mut robot, &mut sight, &setting.scene, log)?;
        &mut pointing
    } else {
        &mut robot
    };
    let mut observer = RunObserver::new(args, colors, Rc::clone(operator), record);
    let mut prompt = OperatorPrompt(Rc::clone(operator));
    observer.requested(&args.request);
    let (outcome, _) =
        conversation.carry_out(&args.request, planner, driver, &mut prompt, &mut observer, Time::ZERO);
    observer.finish(&outcome)?;
    Ok(outcome)
}

#[cfg(test)]
mod tests {
    use super::ScheduledRequest;
    use motet_runtime::Time;

    #[test]
    fn scheduled_request_has_a_time() {
        let request = ScheduledRequest { at: Time::from_secs(1.5), text: "stop: now".to_owned() };
        assert_eq!("1.5s: stop: now".parse(), Ok(request));
        for wrong in ["", "stop", "12: stop", "12s:", "soon: stop", ": stop"] {
            assert!(wrong.parse::<ScheduledRequest>().is_err(), "{wrong}");
        }
    }
}

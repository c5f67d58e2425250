//! The `motet` command: reads the command line, calls the subcommand, and turns its result into an exit code.
//!
//! The executable `motet` and the Python package call it. Programs that embed Motet use the crate `motet`.
//!
//! ```
//! let status = motet_cli::run(["motet", "explain", "M0501"].map(Into::into), None);
//! assert_eq!(status, 0);
//! ```

mod command;
mod conversation;
mod documents;
mod error;
mod flags;
mod interrupt;
mod output;
mod projects;
mod questions;
mod ready_driver;
mod report;
mod result_file;
mod run_view;
mod runner;
mod shared_sessions;
mod sibling;
mod swap_checker;
mod typed_line;
mod view;

use std::ffi::OsString;
use std::path::PathBuf;
use std::sync::OnceLock;

use clap::error::{ContextKind, ContextValue};
use clap::{Parser, Subcommand};
use motet_syntax::render::escaped;

use error::{CliError, Exit};
use output::{ColorChoice, Colors, note, styled_note};

/// Check, format, compile, plan and run robot policies written in Motet
#[derive(Parser, Debug)]
#[command(
    name = "motet",
    version,
    propagate_version = true,
    disable_help_subcommand = true,
    after_help = "Exit codes: 0 success, 1 errors found (or a file would be reformatted), 2 could not run.\n\
                  `motet run`, `do` and `talk`: 0 only if all that was asked was done, 1 refused by the\n\
                  check, 3 failed, stopped by a word or not answered, 130 interrupted."
)]
pub(crate) struct Cli {
    #[command(subcommand)]
    command: Command,
    /// Colours; `auto` uses them in a terminal, unless NO_COLOR is set
    #[arg(long, global = true, value_enum, default_value_t, value_name = "WHEN")]
    color: ColorChoice,
}

/// Subcommands; each has a file of its name in `command`.
#[derive(Subcommand, Debug)]
enum Command {
    /// Check policies before a robot moves
    Check(command::check::CheckArgs),
    /// Format policies, or convert them between text and JSON
    Fmt(command::fmt::FmtArgs),
    /// Compile a policy to its execution graph or a drawing of it
    Compile(command::compile::CompileArgs),
    /// Import files of another planning language
    Import(command::import::ImportArgs),
    /// Carry out a request in words: plan, check, run, ask, and replan
    Do(command::r#do::DoArgs),
    /// Talk with a robot: requests and questions, one after the other
    Talk(command::talk::TalkArgs),
    /// Plan a policy for a request or a goal, without a model
    Plan(command::plan::PlanArgs),
    /// Print the prompt that `motet do` sends to a model for a request
    Prompt(command::prompt::PromptArgs),
    /// Convert plans in the dialect of InteLiPlan to policies, or write an exchange in it
    Dialog(command::dialog::DialogArgs),
    /// Generate instruction and policy pairs for fine-tuning, or lint a file of them
    Dataset(Box<command::dataset::DatasetArgs>),
    /// Serve policies that check to clients of a chat endpoint, in front of a model server
    Serve(Box<command::serve::ServeArgs>),
    /// Check a policy and run it in simulation or on a driver, or check a driver
    Run(command::run::RunArgs),
    /// Check bindings for robots that speak ROS 2, and serve ROS 2; needs the executable `motet-ros2`
    #[command(disable_help_flag = true)]
    Ros2(SiblingArgs),
    /// Run orders of a fleet on this robot, over NATS; needs the executable `motet-fleet`
    #[command(disable_help_flag = true)]
    Agent(SiblingArgs),
    /// See and steer the robots of a fleet, over NATS; needs the executable `motet-fleet`
    #[command(disable_help_flag = true)]
    Fleet(SiblingArgs),
    /// Copy journals into an archive and back; needs the executable `motet-fleet`
    #[command(disable_help_flag = true)]
    Journal(SiblingArgs),
    /// Replay the journal of a run and report the first difference
    Replay(command::replay::ReplayArgs),
    /// Show the journal of a run on a page in a browser, or write the page to a file
    View(command::view::ViewArgs),
    /// Export the journal of a run, or a policy, to another format
    Export(command::export::ExportArgs),
    /// Decide which motions are feasible for a robot in a scene
    Feasible(command::feasible::FeasibleArgs),
    /// List, show and check robots, or write the card of a new one
    Robots(command::robots::RobotsArgs),
    /// List, show, check and draw scenes
    Scenes(command::scenes::ScenesArgs),
    /// Make a folder with settings, a scene and a first policy
    New(command::new::NewArgs),
    /// Serve agents over the Model Context Protocol: check, plan, simulate, and run policies
    Mcp(Box<command::mcp::McpArgs>),
    /// Serve editors over the Language Server Protocol: diagnostics, fixes, completion, facts
    Lsp(Box<command::lsp::LspArgs>),
    /// Explain a diagnostic code
    Explain(command::explain::ExplainArgs),
    /// Print the grammar of policies for constrained decoding, or a request that uses it
    Grammar(Box<command::grammar::GrammarArgs>),
    /// Show the possible continuations of a policy prefix
    Decode(Box<command::decode::DecodeArgs>),
    /// Print the JSON Schema of a file format
    Schema(command::schema::SchemaArgs),
    /// Print completions for a shell
    Completions(command::completions::CompletionsArgs),
}

/// Arguments of a command in an executable of its own, which reads them.
#[derive(clap::Args, Debug)]
struct SiblingArgs {
    #[arg(trailing_var_arg = true, allow_hyphen_values = true, value_name = "ARGUMENTS")]
    arguments: Vec<OsString>,
}

/// Program that other processes call for this command, where it is not the executable of this process.
static PROGRAM: OnceLock<PathBuf> = OnceLock::new();

/// Runs a command line, whose first word is the name of the command, and returns the exit status: 0 to 3,
/// or 130 for an interrupted run. Output goes to stdout and stderr of the process.
///
/// `program` is the path of a program that runs this command, for drivers that call it; without one it is
/// the executable of this process. From its first run of a policy on, the command handles SIGINT,
/// SIGTERM and the other signals that would end the process.
pub fn run(words: impl IntoIterator<Item = OsString>, program: Option<PathBuf>) -> u8 {
    program.into_iter().for_each(|program| {
        let _ = PROGRAM.set(program);
    });
    let exit = main(words);
    output::queue::end();
    exit.status()
}

fn main(words: impl IntoIterator<Item = OsString>) -> Exit {
    let cli = match Cli::try_parse_from(words) {
        Ok(cli) => cli,
        Err(error) if is_drive(&error) => {
            let moved = CliError::Advised {
                problem: "there is no `motet drive` any more".to_owned(),
                help: "write `motet run` with the same flags: `motet run FILE --driver COMMAND|ADDRESS`"
                    .to_owned(),
            };
            print_error(&moved, Colors::new(ColorChoice::default()));
            return Exit::CouldNotRun;
        }
        Err(error) => {
            // Nobody reads the help: a closed pipe is no error.
            let _ = error.print();
            return if error.use_stderr() { Exit::CouldNotRun } else { Exit::Success };
        }
    };
    let colors = Colors::new(cli.color);
    match dispatch(&cli.command, colors) {
        Ok(exit) => exit,
        Err(error) => {
            print_error(&error, colors);
            Exit::CouldNotRun
        }
    }
}

/// Is `true` if the command line names the subcommand that `motet run --driver` has replaced.
fn is_drive(error: &clap::Error) -> bool {
    matches!(error.get(ContextKind::InvalidSubcommand), Some(ContextValue::String(name)) if name == "drive")
}

fn dispatch(command: &Command, colors: Colors) -> Result<Exit, CliError> {
    match command {
        Command::Check(args) => command::check::run(args, colors),
        Command::Fmt(args) => command::fmt::run(args, colors),
        Command::Compile(args) => command::compile::run(args, colors),
        Command::Import(args) => command::import::run(args, colors),
        Command::Do(args) => command::r#do::run(args, colors),
        Command::Talk(args) => command::talk::run(args, colors),
        Command::Prompt(args) => command::prompt::run(args, colors),
        Command::Dialog(args) => command::dialog::run(args, colors),
        Command::Dataset(args) => command::dataset::run(args, colors),
        Command::Plan(args) => command::plan::run(args, colors),
        Command::Serve(args) => command::serve::run(args, colors),
        Command::Run(args) => command::run::run(args, colors),
        Command::Ros2(args) => sibling::run("motet-ros2", &args.arguments),
        Command::Agent(args) => sibling::run_as("motet-fleet", "agent", &args.arguments),
        Command::Fleet(args) => sibling::run_as("motet-fleet", "fleet", &args.arguments),
        Command::Journal(args) => sibling::run_as("motet-fleet", "journal", &args.arguments),
        Command::Replay(args) => command::replay::run(args),
        Command::View(args) => command::view::run(args, colors),
        Command::Export(args) => command::export::run(args, colors),
        Command::Feasible(args) => command::feasible::run(args, colors),
        Command::Robots(args) => command::robots::run(args, colors),
        Command::Scenes(args) => command::scenes::run(args, colors),
        Command::New(args) => command::new::run(args, colors),
        Command::Mcp(args) => command::mcp::run(args),
        Command::Lsp(args) => command::lsp::run(args),
        Command::Explain(args) => command::explain::run(args),
        Command::Grammar(args) => command::grammar::run(args, colors),
        Command::Decode(args) => command::decode::run(args, colors),
        Command::Schema(args) => command::schema::run(args),
        Command::Completions(args) => command::completions::run(args),
    }
}

fn print_error(error: &CliError, colors: Colors) {
    let label = if colors.stderr { "\u{1b}[1;31merror\u{1b}[0m" } else { "error" };
    styled_note(&format!("{label}: {}", escaped(&error.to_string())));
    if let Some(help) = error.help() {
        note(&format!("  help: {help}"));
    }
}

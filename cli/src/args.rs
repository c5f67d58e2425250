//! The command line: every command, flag and help text. What they do is in `command`.

mod act;
mod dataset;
mod decode;
mod dialog;
mod drive;
mod duration;
mod export;
mod feasible;
mod grammar;
mod import;
mod input;
mod journal;
mod model;
mod plan;
mod prompt;
mod run;

pub(crate) use act::{DoArgs, Said};
pub(crate) use dataset::{DatasetArgs, DatasetCommand, LintArgs, LintFormat, MakeArgs, MotionArgs, RowForm};
pub(crate) use decode::{DecodeArgs, DecodeForm};
pub(crate) use dialog::{DialogArgs, DialogForm};
pub(crate) use drive::DriveArgs;
pub(crate) use export::{ExportArgs, ExportCommand, McapArgs};
pub(crate) use feasible::{FeasibleArgs, FeasibleFormat};
pub(crate) use grammar::{GrammarArgs, GrammarCommand, GrammarFormat, ProbeArgs, Server};
pub(crate) use import::{ImportArgs, ImportCommand, PddlArgs};
pub(crate) use input::{DocumentArgs, Format, FormatArgs, KnownArgs, WorldArgs};
pub(crate) use journal::{Moment, ReplayArgs};
pub(crate) use model::{Held, ModelArgs};
pub(crate) use plan::{PlanArgs, PlanForm};
pub(crate) use prompt::PromptArgs;
pub(crate) use run::{RunArgs, RunFormat, SimulatedArgs, Speed};

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};

/// Check, format, compile and run robot policies written in Motet.
#[derive(Parser, Debug)]
#[command(
    name = "motet",
    version,
    propagate_version = true,
    disable_help_subcommand = true,
    after_help = "Exit codes: 0 clean, 1 errors found (or a file would be reformatted), 2 could not run.\n\
                  `motet run`: 0 done, 1 refused by the check, 3 failed, 130 interrupted."
)]
pub(crate) struct Cli {
    /// What to do.
    #[command(subcommand)]
    pub(crate) command: Command,
    /// Colours: `auto` is on in a terminal, unless NO_COLOR is set
    #[arg(long, global = true, value_enum, default_value_t, value_name = "WHEN")]
    pub(crate) color: ColorChoice,
}

/// When to colour what is printed.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, ValueEnum)]
pub(crate) enum ColorChoice {
    /// In a terminal, unless `NO_COLOR` is set.
    #[default]
    Auto,
    /// Always.
    Always,
    /// Never.
    Never,
}

/// The commands.
#[derive(Subcommand, Debug)]
pub(crate) enum Command {
    /// Find what is wrong with policies before a robot moves
    Check(CheckArgs),
    /// Write policies in their canonical layout, or in the other form
    Fmt(FmtArgs),
    /// Compile a policy to its execution graph, a drawing, or either form
    Compile(CompileArgs),
    /// Write the files of another planning language as Motet
    Import(ImportArgs),
    /// Carry out a request in words in simulation: plan, check, run, ask, plan anew
    Do(DoArgs),
    /// Plan a policy for a request or a goal, without a model
    Plan(PlanArgs),
    /// Print what a model would see of a request
    Prompt(PromptArgs),
    /// Read plans in InteLiPlan's dialect as policies, or write the exchange of a request in it
    Dialog(DialogArgs),
    /// Make pairs of instructions and policies for fine-tuning, or find what is wrong with a file of them
    Dataset(Box<DatasetArgs>),
    /// Check a policy and run it in simulation
    Run(RunArgs),
    /// Check a policy and run it on a driver in another process
    Drive(DriveArgs),
    /// Step the engine through the journal of a run again, and say where it differs
    Replay(ReplayArgs),
    /// Write the journal of a run in another format
    Export(ExportArgs),
    /// Find out whether a robot can do a motion in a scene
    Feasible(FeasibleArgs),
    /// Show the robots that are built in
    Robots(RobotsArgs),
    /// Explain a diagnostic code
    Explain(ExplainArgs),
    /// Print a grammar of what a language model may write, or a request that holds it to one
    Grammar(Box<GrammarArgs>),
    /// Show what may follow in a policy that a model has begun
    Decode(Box<DecodeArgs>),
    /// Print the JSON Schema of a file format
    Schema(SchemaArgs),
    /// Print completions for a shell
    Completions(CompletionsArgs),
}

/// `motet check`
#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    motet check fetch_mug.motet --robot hsr --scene kitchen\n  \
    motet check policies/ --format sarif > findings.sarif\n  \
    motet check --fix reply.json --robot hsr --scene kitchen\n  \
    cat reply.txt | motet check - --robot hsr")]
pub(crate) struct CheckArgs {
    /// What to check.
    #[command(flatten)]
    pub(crate) documents: DocumentArgs,
    /// Against what.
    #[command(flatten)]
    pub(crate) world: WorldArgs,
    /// Mend what can be mended: rewrites the files; of standard input the mended document is printed
    #[arg(long)]
    pub(crate) fix: bool,
    /// How to say it.
    #[command(flatten)]
    pub(crate) format: FormatArgs,
}

/// `motet fmt`
#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    motet fmt .                       rewrite every policy below this folder\n  \
    motet fmt --check .               only list what would change, exit 1 if anything would\n  \
    motet fmt --to json a.motet       print the JSON form\n  \
    motet fmt --to text reply.json    print the text form")]
pub(crate) struct FmtArgs {
    /// What to format.
    #[command(flatten)]
    pub(crate) documents: DocumentArgs,
    /// Only list the files that would change
    #[arg(long)]
    pub(crate) check: bool,
    /// Print the other form on standard output instead of rewriting the file
    #[arg(long, value_enum, value_name = "FORM", conflicts_with = "check")]
    pub(crate) to: Option<Form>,
    /// Robot whose primitives name and order arguments: a built-in name, or a folder with a robot.toml
    #[arg(long, value_name = "NAME|FOLDER")]
    pub(crate) robot: Option<String>,
    /// File of further declarations; may be repeated
    #[arg(long, value_name = "FILE")]
    pub(crate) domain: Vec<PathBuf>,
    /// How to say what is wrong.
    #[command(flatten)]
    pub(crate) format: FormatArgs,
}

/// A surface form.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
pub(crate) enum Form {
    /// `.motet`
    Text,
    /// `.json`
    Json,
}

/// `motet compile`
#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    motet compile fetch_mug.motet --robot hsr -o fetch_mug.graph.json\n  \
    motet compile fetch_mug.json --emit text\n  \
    motet compile fetch_mug.motet --emit dot | dot -Tsvg > fetch_mug.svg")]
pub(crate) struct CompileArgs {
    /// The policy: a file, or `-` for standard input
    #[arg(value_name = "FILE")]
    pub(crate) file: PathBuf,
    /// What to write
    #[arg(long, value_enum, default_value_t, value_name = "WHAT")]
    pub(crate) emit: Emit,
    /// Where to write it; standard output where not given
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
    /// Which policy of the file; needed where it has several
    #[arg(long, value_name = "NAME")]
    pub(crate) policy: Option<String>,
    /// Against what.
    #[command(flatten)]
    pub(crate) world: WorldArgs,
    /// How to say what is wrong.
    #[command(flatten)]
    pub(crate) format: FormatArgs,
}

/// What `compile` writes.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, ValueEnum)]
pub(crate) enum Emit {
    /// The execution graph, in its versioned JSON encoding
    #[default]
    Graph,
    /// The policy's JSON form
    Json,
    /// The policy's text form
    Text,
    /// The graph as an indented tree, with guards, effects and durations
    Tree,
    /// A Mermaid flowchart of the graph
    Mermaid,
    /// A Graphviz drawing of the graph
    Dot,
}

/// `motet robots`
#[derive(Args, Debug)]
pub(crate) struct RobotsArgs {
    /// What to show; `list` where not given.
    #[command(subcommand)]
    pub(crate) command: Option<RobotsCommand>,
}

/// What `robots` shows.
#[derive(Subcommand, Debug)]
pub(crate) enum RobotsCommand {
    /// List the robots that are built in
    List,
    /// Show a robot: its body, what it observes, the signature of every primitive
    Show {
        /// A built-in name, or a folder with a robot.toml
        #[arg(value_name = "NAME|FOLDER")]
        name: String,
    },
    /// Check a robot's card, its URDF, and whether they fit each other
    Check {
        /// A built-in name, or a folder with a robot.toml
        #[arg(value_name = "NAME|FOLDER")]
        name: String,
    },
    /// Write a first card for a robot of which there is a URDF, beside it
    Add {
        /// The URDF
        #[arg(value_name = "URDF")]
        urdf: PathBuf,
        /// Where to write robot.toml; the URDF's folder where not given
        #[arg(long, value_name = "FOLDER")]
        to: Option<PathBuf>,
        /// The SRDF; one that lies beside the URDF where not given
        #[arg(long, value_name = "SRDF")]
        srdf: Option<PathBuf>,
    },
}

/// `motet explain`
#[derive(Args, Debug)]
#[command(after_help = "Example:\n  motet explain M0501")]
pub(crate) struct ExplainArgs {
    /// A code such as M0501; every code is listed where none is given
    #[arg(value_name = "CODE")]
    pub(crate) code: Option<String>,
}

/// `motet schema`
#[derive(Args, Debug)]
#[command(after_help = "Example:\n  motet schema policy > policy.schema.json")]
pub(crate) struct SchemaArgs {
    /// Which format
    #[arg(value_enum, value_name = "FORMAT")]
    pub(crate) of: SchemaOf,
}

/// The file formats with a schema.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
pub(crate) enum SchemaOf {
    /// A policy in its JSON form
    Policy,
    /// A scene
    Scene,
    /// A robot card (robot.toml, as JSON)
    Robot,
    /// A diagnostic, as `--format json` prints it
    Diagnostic,
    /// What host and driver say to each other (docs/drivers.md)
    Driver,
    /// What stands in a line of a journal (docs/journal.md)
    Journal,
    /// What `motet run --faults` takes (docs/runtime.md)
    Faults,
}

/// `motet completions`
#[derive(Args, Debug)]
#[command(
    after_help = "Example:\n  motet completions bash > ~/.local/share/bash-completion/completions/motet"
)]
pub(crate) struct CompletionsArgs {
    /// The shell
    #[arg(value_enum)]
    pub(crate) shell: clap_complete::Shell,
}

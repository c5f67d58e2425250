//! `motet prompt`: the prompt that a model would get for a request.

use clap::Args;
use motet_planner::dialogue::Knowledge;
use motet_planner::prompt::{self, Prompt, StaticPrompt};
use motet_runtime::Time;
use motet_runtime::memory::{Memory, MemoryLimits};

use crate::error::{CliError, Exit};
use crate::flags::{DiagnosticFormat, SessionArgs};
use crate::output::{Colors, note};
use crate::report::Report;

/// Flags of `motet prompt`.
#[derive(Args, Debug)]
#[command(after_help = "Example:\n  motet prompt 'bring me the coke' --robot hsr --scene kitchen")]
pub(crate) struct PromptArgs {
    /// Request in English
    #[arg(value_name = "REQUEST")]
    request: String,
    #[command(flatten)]
    session: SessionArgs,
    /// Maximum number of tokens, counted as four bytes each
    #[arg(long, default_value_t = motet_planner::prompt::TOKENS, value_name = "NUMBER")]
    tokens: usize,
}

/// Runs the command.
pub(crate) fn run(args: &PromptArgs, colors: Colors) -> Result<Exit, CliError> {
    Report::run_held(DiagnosticFormat::Human, colors, |report| write(args, report))
}

fn write(args: &PromptArgs, report: &mut Report) -> Result<Exit, CliError> {
    let mut project = args.session.project_here()?.open_with(report)?;
    let opened = project.session(report)?;
    let Some(robot) = &opened.robot else {
        return Err(CliError::Message("a prompt needs a robot: give --robot NAME".to_owned()));
    };
    let scene = opened.scene.clone().unwrap_or_default();
    let known = Knowledge::of(opened.told_facts());
    let situation = known.situation(&scene);
    let mut memory = Memory::new(MemoryLimits::default());
    memory.instruct(Time::ZERO, &args.request);
    let prompt = Prompt {
        session: &opened.session,
        robot,
        scene: &scene,
        situation: &situation,
        memory: &memory,
        bound: &[],
        lasting: &StaticPrompt::new(&opened.session, robot, &scene),
        tokens: args.tokens,
        time: prompt::TIME,
    };
    let written = prompt.write(&args.request);
    report.out.line(written.system.trim_end());
    report.out.line("");
    report.out.line(written.user.trim_end());
    for part in &written.left_out {
        note(&format!("left out to stay within {} tokens: {part}", args.tokens));
    }
    note(&format!("about {} tokens", written.tokens));
    Ok(Exit::Success)
}

//! `motet prompt`: what a model would see of a request.

use motet_planner::prompt::{self, Prompt, StaticPrompt};
use motet_requests::RequestContext;
use motet_runtime::Time;
use motet_runtime::memory::{Memory, MemoryLimits};
use motet_syntax::ast::File;

use crate::args::{Format, PromptArgs};
use crate::exit::{Exit, Trouble};
use crate::out::{Colors, note};
use crate::report::Report;
use crate::workbench::Workbench;

/// Runs the command.
///
/// # Errors
///
/// What it is written for cannot be used.
pub(crate) fn run(args: &PromptArgs, colors: Colors) -> Result<Exit, Trouble> {
    let mut report = Report::new(Format::Human, colors);
    report.hold();
    let result = write(args, &mut report);
    report.close(result)
}

fn write(args: &PromptArgs, report: &mut Report) -> Result<Exit, Trouble> {
    let mut bench = Workbench::open(&args.world, report)?;
    let setting = bench.setting(&File::default(), report)?;
    let Some(robot) = &setting.robot else {
        return Err(Trouble::Other("a robot is needed for a prompt: give --robot NAME".to_owned()));
    };
    let scene = setting.scene.clone().unwrap_or_default();
    let situation = RequestContext::new(&scene);
    let mut memory = Memory::new(MemoryLimits::default());
    memory.instruct(Time::ZERO, &args.request);
    let prompt = Prompt {
        session: &setting.session,
        robot,
        scene: &scene,
        situation: &situation,
        memory: &memory,
        lasting: &StaticPrompt::new(&setting.session, robot, &scene),
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
    Ok(Exit::Clean)
}

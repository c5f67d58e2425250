//! `motet view`: shows the journal of a run on a page, or writes the page to a file; without a journal, a
//! workbench for policies.

use std::net::SocketAddr;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use clap::Args;
use motet::workbench::Workbench;
use motet_project::{DiagnosticSink, ProjectSession};

use crate::error::{CliError, Exit};
use crate::flags::{DiagnosticFormat, EnvironmentArgs, address};
use crate::interrupt::{SLICE, catch_interrupts, is_interrupted};
use crate::output::{Colors, note, replace_file};
use crate::report::Report;
use crate::view::conversation::{ConversationFolder, TALK, session};
use crate::view::file;
use crate::view::hub::Hub;
use crate::view::journal::JournalFolder;
use crate::view::live::LivePage;

/// Shortest time between two looks at a journal that is still written.
const LOOK_EVERY: Duration = Duration::from_millis(200);

/// Flags of `motet view`.
#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    motet view                                 a workbench: write policies, check them, run them\n  \
    motet view --robot my_robot/ --scene my_room.json\n  \
    motet view run/                            the page of a journal, also of one that is still written\n  \
    motet view run/ -o run.html                the same in one file\n  \
    motet view talk/ --robot hsr --scene kitchen\n\n\
    `motet run`, `do` and `talk` show a run that goes on with --view.")]
pub(crate) struct ViewArgs {
    /// Folder of a journal, or of the record of a conversation; without one, the page is a workbench for
    /// policies
    #[arg(value_name = "FOLDER")]
    folder: Option<PathBuf>,
    /// Write one file that shows the run without a server
    #[arg(short, long, value_name = "FILE", requires = "folder")]
    output: Option<PathBuf>,
    /// Address of the page: a port, or an address with a port
    #[arg(long, value_name = "ADDRESS", default_value = "", hide_default_value = true, value_parser = address,
          conflicts_with = "output")]
    address: SocketAddr,
    #[command(flatten)]
    environment: EnvironmentArgs,
}

/// Journal or record.
enum Folder {
    Journal(JournalFolder),
    Conversation(ConversationFolder),
}

impl Folder {
    fn news(&mut self, page: &mut LivePage) -> Result<bool, CliError> {
        match self {
            Self::Journal(journal) => journal.news(page, &mut |_, _| {}),
            Self::Conversation(conversation) => conversation.news(page),
        }
    }

    /// Is `true` once something can be shown.
    fn has_begun(&self) -> bool {
        match self {
            Self::Journal(journal) => journal.has_begun(),
            Self::Conversation(_) => true,
        }
    }
}

/// Runs the command.
pub(crate) fn run(args: &ViewArgs, colors: Colors) -> Result<Exit, CliError> {
    Report::run_held(DiagnosticFormat::Human, colors, |report| show(args, report))
}

fn show(args: &ViewArgs, report: &mut Report) -> Result<Exit, CliError> {
    let Some(path) = &args.folder else { return workbench(args, report) };
    let mut folder = if path.join(TALK).is_file() {
        Folder::Conversation(ConversationFolder::new(path))
    } else {
        Folder::Journal(JournalFolder::new(path))
    };
    let opened = world(path, &args.environment, report)?;
    if let Some(output) = &args.output {
        let hub = Arc::new(Hub::default());
        let mut page = LivePage::silent(Arc::clone(&hub), opened.as_ref(), &[]);
        folder.news(&mut page)?;
        if !folder.has_begun() {
            return Err(CliError::Message(format!("`{}` holds no journal", path.display())));
        }
        replace_file(output, &file::whole(&hub.all()))?;
        note(&format!("wrote {}", output.display()));
        return Ok(Exit::Success);
    }
    if !path.is_dir() {
        return Err(CliError::Message(format!("`{}` is not a folder", path.display())));
    }
    let mut page = LivePage::start(args.address, None, opened.as_ref(), &[])?;
    catch_interrupts()?;
    while !is_interrupted() {
        let begun = Instant::now();
        folder.news(&mut page)?;
        // A long journal takes its time to read again.
        std::thread::sleep(LOOK_EVERY.max(begun.elapsed() * 4));
    }
    page.finish();
    Ok(Exit::Success)
}

/// Serves a workbench until Ctrl-C.
fn workbench(args: &ViewArgs, report: &mut Report) -> Result<Exit, CliError> {
    let project = args.environment.without_motions_in(Path::new("."))?.motion_effort(1);
    let bench = Workbench::new().with_room(project.robot_name(), project.scene_name());
    // What the page cannot open is told here, with its places.
    project.open_with(report)?;
    let page = LivePage::workbench(args.address, bench)?;
    catch_interrupts()?;
    while !is_interrupted() {
        std::thread::sleep(SLICE);
    }
    drop(page);
    Ok(Exit::Success)
}

/// Session with the robot and the room: those of the flags, or those that the journal names.
fn world(
    folder: &Path,
    environment: &EnvironmentArgs,
    sink: &mut dyn DiagnosticSink,
) -> Result<Option<ProjectSession>, CliError> {
    if environment.robot.is_none() && environment.scene.is_none() {
        return Ok(session(folder, sink));
    }
    let project = environment.without_motions().motion_effort(1).open_with(sink)?;
    Ok(Some(project.into_session(sink)?))
}

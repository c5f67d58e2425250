//! `motet dataset from-journal`: rows from recorded conversations.

use std::fs;
use std::io::{Read as _, Seek as _, SeekFrom};
use std::path::{Path, PathBuf};

use clap::Args;
use motet_dataset::generate::{self, HeldOut, Order, RecordedPlan};
use motet_dataset::picture::Pictures;
use motet_dataset::{format, scenery};
use motet_project::files::read_small;
use motet_project::read_scene;
use motet_syntax::Sources;
use serde_json::Value;
use smol_str::SmolStr;

use super::inputs::{RowFormat, body, effort, write};
use super::lint::lines;
use crate::documents::Flow;
use crate::error::{CliError, Exit};
use crate::flags::MotionArgs;
use crate::output::{count, note};
use crate::report::Report;

/// File of a record with its events.
const TALK: &str = "talk.jsonl";

/// Flags of `motet dataset from-journal`.
#[derive(Args, Debug)]
#[command(after_help = "Example:\n  \
    motet do 'bring me the coke' --robot hsr --scene kitchen --speed max --record talk/\n  \
    motet dataset from-journal talk/ --robot hsr --scene kitchen --out own.jsonl\n\n\
    Exit codes: 0 rows were written, 1 no recorded plan became a row, 2 the command could not run.")]
pub(super) struct FromJournalArgs {
    /// Folders that `motet do --record` or `motet talk --record` wrote
    #[arg(value_name = "FOLDER", required = true)]
    folders: Vec<PathBuf>,
    /// File for the rows
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
    /// Robot of the conversations: a built-in name, or a folder with a robot.toml
    #[arg(long, value_name = "NAME|FOLDER")]
    robot: String,
    /// Scene of the conversations: a built-in name, or a JSON file
    #[arg(long, value_name = "NAME|FILE")]
    scene: String,
    /// Row format, by trainer
    #[arg(long, value_enum, default_value_t, value_name = "FORM")]
    form: RowFormat,
    #[command(flatten)]
    motions: MotionArgs,
}

/// Writes the rows of recorded conversations.
pub(super) fn from_journal(args: &FromJournalArgs, report: &mut Report) -> Result<Exit, CliError> {
    let body = body(&args.robot, report)?;
    let scene = read_scene(&args.scene, &mut Sources::default(), report)?;
    let stem = Path::new(&args.scene).file_stem();
    let name = stem.map_or_else(|| args.scene.clone(), |stem| stem.to_string_lossy().into_owned());
    let mut plans = Vec::new();
    for folder in &args.folders {
        read(folder, &mut plans)?;
    }
    let order = Order {
        seed: 0,
        bodies: vec![body],
        bases: vec![(SmolStr::from(name), scene)],
        things: scenery::things(),
        wordings: motet_dataset::wordings::Wordings::default(),
        held_out: HeldOut::own(),
        lessons: Vec::new(),
        scenes: 1,
        cases: 0,
        test: 0.0,
        effort: effort(&args.motions),
        form: args.form.into(),
        pictures: Pictures::None,
    };
    let dataset = generate::gather(&order, vec![(0, generate::recorded(&order, &plans))]);
    write(&args.out, dataset.train.iter().map(|row| format::write(row, order.form)))?;
    for (why, dropped) in &dataset.dropped {
        note(&format!("left out {dropped}: {why}"));
    }
    report.out.line(&format!(
        "{} from {}",
        count(dataset.train.len(), "row"),
        count(plans.len(), "recorded plan")
    ));
    Ok(if dataset.train.is_empty() { Exit::Findings } else { Exit::Success })
}

/// Reads the requests of a record that were done by their first plan. A plan after a failure or a change
/// needs the scene of that moment, which a record does not have.
fn read(folder: &Path, plans: &mut Vec<RecordedPlan>) -> Result<(), CliError> {
    let path = folder.join(TALK);
    let wrong =
        |number: usize, why: &str| CliError::Message(format!("`{}`, line {number}: {why}", path.display()));
    let mut request: Option<String> = None;
    let mut files: Vec<String> = Vec::new();
    let mut is_first = true;
    // A process that was killed may leave a last line that is torn.
    let mut torn: Option<CliError> = None;
    lines(&path, &mut |number, line| {
        if let Some(torn) = torn.take() {
            return Err(torn);
        }
        let event: Value = match serde_json::from_str(line) {
            Ok(event) => event,
            Err(error) => {
                torn = Some(wrong(number, &format!("it is not JSON: {error}")));
                return Ok(Flow::Continue);
            }
        };
        let text = |key: &str| event.get(key).and_then(Value::as_str).map(ToOwned::to_owned);
        let what = text("what").ok_or_else(|| wrong(number, "it is no event: it has no `what`"))?;
        match what.as_str() {
            "request" => {
                request = Some(text("text").ok_or_else(|| wrong(number, "a request without `text`"))?);
                files.clear();
            }
            "policy" => files.push(text("file").ok_or_else(|| wrong(number, "a policy without `file`"))?),
            "outcome" => {
                let is_done = text("outcome").as_deref() == Some("done");
                let plan = (request.take(), files.as_slice());
                if let (true, true, (Some(request), [file])) = (is_done, is_first, plan) {
                    if Path::new(file).components().count() != 1 || file.contains("..") {
                        return Err(wrong(number, "the file of its policy is not in the folder"));
                    }
                    let bytes = read_small(&folder.join(file))?;
                    let policy = String::from_utf8_lossy(&bytes).into_owned();
                    plans.push(RecordedPlan { request, policy });
                }
                is_first = false;
            }
            _ => {}
        }
        Ok(Flow::Continue)
    })?;
    match torn {
        Some(torn) if ends_with_line(&path) => Err(torn),
        Some(_) | None => Ok(()),
    }
}

/// True if the last line of a file has its end.
fn ends_with_line(path: &Path) -> bool {
    let last = |mut file: fs::File| {
        let mut byte = [0];
        file.seek(SeekFrom::End(-1)).and_then(|_| file.read_exact(&mut byte)).map(|()| byte)
    };
    fs::File::open(path).and_then(last).is_ok_and(|byte| byte == *b"\n")
}

//! `motet export`: the journal of a run as an MCAP file, with the simulated scene if the run was a
//! simulation, and policies as behaviour trees.

mod btcpp;

use std::fs::File;
use std::io::{BufWriter, IsTerminal as _, stderr};
use std::path::PathBuf;

use clap::{Args, Subcommand};
use motet_host::mcap::{ExportError, McapBody, McapExporter, McapLimits, McapScene, McapSolid};
use motet_project::SavedDriver;
use motet_robots::scene::{EntityShape, Scene};
use motet_runtime::Time;
use motet_runtime::journal::{DriverReplay, JournalEntry};
use motet_sim::Sim;
use motet_stdlib::lang;
use motet_stdlib::lang::kinds;

use crate::error::{CliError, Exit, journal_error};
use crate::output::{Colors, note, replace_with};
use crate::report::Progress;

/// Flags of `motet export`.
#[derive(Args, Debug)]
pub(crate) struct ExportArgs {
    #[command(subcommand)]
    command: ExportCommand,
}

/// Formats of an export.
#[derive(Subcommand, Debug)]
enum ExportCommand {
    /// Export a journal as an MCAP file, for Foxglove and other viewers
    Mcap(McapArgs),
    /// Export a policy as a behaviour tree of BehaviorTree.CPP 4, for Groot2 too
    Btcpp(btcpp::BtcppArgs),
}

/// Flags of `motet export mcap`.
#[derive(Args, Debug)]
#[command(after_help = "Example:\n  motet export mcap run/ -o run.mcap")]
struct McapArgs {
    /// Folder of the journal
    #[arg(value_name = "FOLDER")]
    folder: PathBuf,
    /// File to write
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// States, and pictures of the scene, in a second of the run; events and effects are all written
    #[arg(long, value_name = "HZ", default_value_t = 10.0, value_parser = rate)]
    rate: f64,
    /// Size of the file in MB from which on the rest of the run is left out
    #[arg(long, value_name = "MB", default_value_t = 1024)]
    max_size: u64,
}

fn rate(text: &str) -> Result<f64, String> {
    let rate = text.parse().ok().filter(|rate: &f64| (0.001..=1e6).contains(rate));
    rate.ok_or_else(|| "a rate is from 0.001 to 1000000".to_owned())
}

/// Runs the command.
pub(crate) fn run(args: &ExportArgs, colors: Colors) -> Result<Exit, CliError> {
    match &args.command {
        ExportCommand::Mcap(args) => mcap(args),
        ExportCommand::Btcpp(args) => btcpp::run(args, colors),
    }
}

fn mcap(args: &McapArgs) -> Result<Exit, CliError> {
    // An earlier file, which may be the journal itself, stays until the new one is complete.
    let (entries, left) = replace_with(&args.output, |file| write(args, file))?;
    note(&format!("wrote {entries} entries to {}", args.output.display()));
    if left == 0 {
        return Ok(Exit::Success);
    }
    note(&format!("{left} more entries are left out: the file has more than {} MB", args.max_size));
    Ok(Exit::Findings)
}

/// Writes a journal as MCAP. Returns the numbers of entries that are in it, and that are not.
fn write(args: &McapArgs, file: &File) -> Result<(u64, u64), CliError> {
    let wrong = |error: ExportError| CliError::Message(error.to_string());
    let limits = McapLimits {
        every: Time::from_secs(1.0 / args.rate),
        most_bytes: args.max_size.saturating_mul(1_000_000),
    };
    let mut exporter = McapExporter::new(BufWriter::new(file), limits).map_err(wrong)?;
    // A bar that nobody sees is not worth another look at the journal.
    let lines = if stderr().is_terminal() { motet_host::journal::lines(&args.folder) } else { 0 };
    let progress = Progress::of_items(lines, "exporting");
    let mut replay = None;
    let (mut result, mut entries, mut left) = (Ok(()), 0, 0);
    let read = motet_host::journal::read(&args.folder, &mut |seq, entry| {
        progress.advance(1);
        if result.is_err() {
            left += 1;
            return;
        }
        if let JournalEntry::Head(head) = &entry {
            replay = SceneReplay::of(&head.driver);
        }
        let picture = replay.as_mut().and_then(|replay: &mut SceneReplay| replay.after(&entry));
        result = exporter.entry(seq, &entry, picture);
        if result.is_ok() { entries += 1 } else { left += 1 }
    });
    read.map_err(journal_error)?;
    if let Err(ExportError::Full(_)) = result {
        result = Ok(());
    }
    result.and_then(|()| exporter.finish()).map_err(wrong)?;
    Ok((entries, left))
}

/// Simulated scene along a journal.
struct SceneReplay {
    sim: Sim,
    scene: Scene,
    retrace: DriverReplay,
}

impl SceneReplay {
    /// Replay from the head of a journal; `None` if the run was not a simulation.
    fn of(driver: &serde_json::Value) -> Option<Self> {
        match SavedDriver::from_json(driver).ok()? {
            SavedDriver::Simulator(saved) => {
                let (sim, scene) = (saved.open().ok()?, saved.scene().ok()?);
                Some(Self { sim, scene, retrace: DriverReplay::default() })
            }
            SavedDriver::Process { .. } => None,
        }
    }

    /// Scene after an entry; `None` once the replay differs from the journal.
    fn after(&mut self, entry: &JournalEntry) -> Option<McapScene> {
        self.retrace.take(&mut self.sim, entry).ok()?;
        let base = self.sim.base();
        let bodies = self.scene.entities.values().filter_map(|entity| {
            // A zone is an area, not a body.
            let pose = entity.pose.filter(|_| entity.kind != kinds::ZONE)?;
            let solid = match entity.shape.as_ref()? {
                EntityShape::Box(size) => McapSolid::Box(*size),
                EntityShape::Cylinder { radius, height } => {
                    McapSolid::Cylinder { radius: *radius, height: *height }
                }
                EntityShape::Capsule { radius, height } => {
                    McapSolid::Cylinder { radius: *radius, height: height + 2.0 * radius }
                }
                EntityShape::Sphere { radius } => McapSolid::Sphere { radius: *radius },
                EntityShape::Mesh { .. } => return None,
            };
            let mut xyz = self.sim.position(&entity.id)?;
            if let (true, McapSolid::Cylinder { height, .. }) = (entity.kind == lang::kinds::PERSON, solid) {
                // A person's pose is that of the feet.
                xyz[2] = 0.5 * height;
            }
            let heading = pose.rpy[2];
            Some(McapBody { id: entity.id.to_string(), xyz, heading, solid })
        });
        Some(McapScene { base: [base.x, base.y, base.heading], bodies: bodies.collect() })
    }
}

//! `motet export mcap`: a journal as an MCAP file, with the simulated world where the run was a simulation.

use std::fs::{self, File};
use std::io::BufWriter;
use std::path::{Path, PathBuf};

use motet_host::mcap::{McapBody, McapExporter, McapScene, McapSolid};
use motet_robots::scene::{EntityShape, Scene};
use motet_runtime::journal::{DriverReplay, JournalEntry};
use motet_sim::Sim;

use super::play::journal_trouble;
use super::saved::Saved;
use crate::args::McapArgs;
use crate::exit::{Exit, Trouble};
use crate::out::note;

/// Runs the command.
///
/// # Errors
///
/// The journal cannot be read, or the file not be written.
pub(crate) fn mcap(args: &McapArgs) -> Result<Exit, Trouble> {
    // An earlier file, which may be the journal itself, is there until the new one is whole.
    let mut partial = args.output.clone().into_os_string();
    partial.push(".partial");
    let partial = PathBuf::from(partial);
    let written = write(&args.folder, &partial);
    let renamed = written.and_then(|entries| match fs::rename(&partial, &args.output) {
        Ok(()) => Ok(entries),
        Err(source) => Err(Trouble::Write { path: args.output.clone(), source }),
    });
    if renamed.is_err() {
        let _ = fs::remove_file(&partial);
    }
    note(&format!("wrote {} entries to {}", renamed?, args.output.display()));
    Ok(Exit::Clean)
}

/// Writes a journal as MCAP. Gives how many entries it has.
fn write(folder: &Path, path: &Path) -> Result<u64, Trouble> {
    let file = File::create(path).map_err(|source| Trouble::Write { path: path.to_owned(), source })?;
    let wrong = |error: motet_host::mcap::ExportError| Trouble::Other(error.to_string());
    let mut exporter = McapExporter::new(BufWriter::new(file)).map_err(wrong)?;
    let mut world = None;
    let (mut result, mut entries) = (Ok(()), 0);
    let read = motet_host::journal::read(folder, &mut |seq, entry| {
        if result.is_err() {
            return;
        }
        if let JournalEntry::Head(head) = &entry {
            world = World::of(&head.driver);
        }
        let picture = world.as_mut().and_then(|world| world.after(&entry));
        result = exporter.entry(seq, &entry, picture);
        entries += 1;
    });
    read.map_err(journal_trouble)?;
    result.and_then(|()| exporter.finish()).map_err(wrong)?;
    Ok(entries)
}

/// The simulated world along a journal.
struct World {
    sim: Sim,
    scene: Scene,
    retrace: DriverReplay,
}

impl World {
    /// None where the run was no simulation.
    fn of(driver: &serde_json::Value) -> Option<Self> {
        match Saved::of(driver).ok()? {
            Saved::Simulator(saved) => {
                let (sim, scene) = (saved.make().ok()?, saved.scene().ok()?);
                Some(Self { sim, scene, retrace: DriverReplay::default() })
            }
            Saved::Process { .. } => None,
        }
    }

    /// The world after an entry; none once it goes another way than it went.
    fn after(&mut self, entry: &JournalEntry) -> Option<McapScene> {
        self.retrace.take(&mut self.sim, entry).ok()?;
        let base = self.sim.base();
        let bodies = self.scene.entities.values().filter_map(|entity| {
            let pose = entity.pose?;
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
            if let (true, McapSolid::Cylinder { height, .. }) = (entity.kind == "Person", solid) {
                // A person's pose is that of the feet.
                xyz[2] = 0.5 * height;
            }
            let heading = pose.rpy[2];
            Some(McapBody { id: entity.id.to_string(), xyz, heading, solid })
        });
        Some(McapScene { base: [base.x, base.y, base.heading], bodies: bodies.collect() })
    }
}

//! Journal of a run for the page, also while another process writes it.

use std::path::{Path, PathBuf};

use motet_host::journal::{JournalError, MotionReader};
use motet_project::SavedDriver;
use motet_runtime::journal::{DriverReplay, JournalEntry};
use motet_runtime::{Driver as _, Time};
use motet_sim::Sim;

use super::answered::AnsweredQuestions;
use super::live::LivePage;
use crate::error::{CliError, journal_error};
use crate::output::note;
use motet::page::source::PolicyText;

/// Span of simulated time between two looks at a replayed simulation.
const LOOK_EVERY: Time = Time::from_nanos(100_000_000);
/// Greatest number of such looks from one entry to the next: a long wait shows nothing new.
const LOOKS: u64 = 600;
/// Names of the file that `--record` writes the policy to.
const TEXTS: [&str; 2] = ["policy.motet", "policy.json"];

/// Folder with the journal of one run.
pub(crate) struct JournalFolder {
    folder: PathBuf,
    /// Number of the next entry.
    next: u64,
    /// Bytes of the journal when it was read last.
    bytes: u64,
    simulation: Option<Simulation>,
    /// Telemetry that was written down, where the run cannot be simulated again.
    motion: MotionReader,
}

/// Simulation along the journal, for motion.
struct Simulation {
    sim: Box<Sim>,
    retrace: DriverReplay,
    now: Time,
    /// Questions that a person answered, if one did.
    questions: Option<AnsweredQuestions>,
}

impl JournalFolder {
    /// Journal in a folder of which nothing is read yet.
    pub(crate) fn new(folder: &Path) -> Self {
        Self {
            folder: folder.to_owned(),
            next: 0,
            bytes: 0,
            simulation: None,
            motion: MotionReader::default(),
        }
    }

    /// Reads what is new, and gives each entry to the page after `before` has seen it. False if nothing is.
    pub(crate) fn news(
        &mut self,
        page: &mut LivePage,
        before: &mut dyn FnMut(&mut LivePage, &JournalEntry),
    ) -> Result<bool, CliError> {
        let bytes = motet_host::journal::size(&self.folder);
        if bytes == self.bytes {
            return Ok(false);
        }
        let folder = self.folder.clone();
        let read = motet_host::journal::read(&folder, &mut |seq, entry| {
            if seq < self.next {
                return;
            }
            self.next = seq + 1;
            before(page, &entry);
            if let JournalEntry::Head(head) = &entry {
                self.simulation = Simulation::of(&head.driver);
                if let Some(text) = recorded_text(&folder) {
                    page.text(text);
                }
            }
            self.simulate(&entry, page);
            page.entry(seq, &entry);
        });
        self.bytes = bytes;
        match read {
            Ok(_) => Ok(true),
            // Its first line is not written yet.
            Err(JournalError::None { .. }) if self.next == 0 => Ok(false),
            Err(error) => Err(journal_error(error)),
        }
    }

    /// Is `true` once an entry was read.
    pub(crate) fn has_begun(&self) -> bool {
        self.next > 0
    }

    fn simulate(&mut self, entry: &JournalEntry, page: &mut LivePage) {
        if let Some(simulation) = &mut self.simulation
            && !simulation.follow(entry, page)
        {
            note("from here on the simulation differs from the journal: the page shows no motion");
            self.simulation = None;
        }
        if self.simulation.is_none()
            && let Some((at, _)) = entry.happened()
        {
            self.motion.until(&self.folder, at, &mut |moved| page.moved(moved));
        }
    }
}

impl Simulation {
    /// Simulation of a run; `None` where the run was none.
    fn of(driver: &serde_json::Value) -> Option<Self> {
        let driver = SavedDriver::from_json(driver).ok()?;
        let questions = driver.asks().then(AnsweredQuestions::default);
        match driver {
            SavedDriver::Simulator(saved) => {
                let sim = Box::new(saved.open().ok()?);
                Some(Self { sim, retrace: DriverReplay::default(), now: Time::ZERO, questions })
            }
            SavedDriver::Process { .. } => None,
        }
    }

    /// Goes on to an entry, and shows the motion until then. False if the simulation does not do the same.
    fn follow(&mut self, entry: &JournalEntry, page: &mut LivePage) -> bool {
        let Some((at, _)) = entry.happened() else { return true };
        let span = at.since(self.now).nanos();
        let every = Time::from_nanos(LOOK_EVERY.nanos().max(span / LOOKS));
        let mut look = self.now.after(every);
        while look < at {
            // A copy looks ahead: the simulation itself reports what it sees whenever it is stepped.
            let mut ahead = self.sim.clone();
            let _ = ahead.advance(look);
            show(&mut ahead, page);
            look = look.after(every);
        }
        let seen = self.questions.as_mut().map(|questions| questions.without(entry));
        if self.retrace.take(&mut *self.sim, seen.as_ref().unwrap_or(entry)).is_err() {
            return false;
        }
        self.now = at.max(self.now);
        show(&mut self.sim, page);
        true
    }
}

/// Shows the motion that a simulation has to report.
fn show(sim: &mut Sim, page: &mut LivePage) {
    while let Some(moved) = sim.telemetry() {
        page.moved(&moved);
    }
}

/// Policy that `--record` has written beside a journal.
pub(crate) fn recorded_text(folder: &Path) -> Option<PolicyText> {
    TEXTS.iter().find_map(|name| {
        let bytes = motet_project::files::read_small(&folder.join(name)).ok()?;
        Some(PolicyText::read(name, &String::from_utf8_lossy(&bytes)))
    })
}

//! Writes the journal of each run of a conversation, which `motet replay` reads.

use motet_host::journal::{self, JournalWriter};
use motet_planner::dialogue::RunRecorder;
use motet_runtime::journal::JournalHead;
use motet_runtime::{Driver, Effect, Engine, Observer, RunControl, RunEnd, StartState, Time};

use super::record::Recorder;
use crate::command::run::{head, journal_trouble};

/// The journal of one run.
pub(super) struct Journal {
    recorder: Recorder,
    head: JournalHead,
}

impl Journal {
    pub(super) fn new(recorder: Recorder, engine: &Engine, start: &StartState, request: &str) -> Self {
        let head = JournalHead { instruction: Some(request.to_owned()), ..head(engine, start) };
        Self { recorder, head }
    }
}

impl RunRecorder for Journal {
    fn run(
        self: Box<Self>,
        engine: &mut Engine,
        driver: &mut dyn Driver,
        onlooker: &mut dyn Observer,
        from: Time,
    ) -> RunEnd {
        let Self { recorder, head } = *self;
        let head = JournalHead { from, ..head };
        let writer = match JournalWriter::create(&recorder.run(), head) {
            Ok(writer) => writer,
            Err(error) => {
                recorder.spoil(journal_trouble(error));
                return motet_runtime::run(engine, driver, &mut Unwritten, from);
            }
        };
        let mut writing = journal::RunRecorder::new(writer, onlooker);
        let end = motet_runtime::run(engine, driver, &mut writing, from);
        if let Err(error) = writing.finish() {
            recorder.spoil(journal_trouble(error));
        }
        end
    }
}

/// Where there is no journal nothing starts.
struct Unwritten;

impl Observer for Unwritten {
    fn commit(&mut self, _now: Time, _effects: &[Effect]) -> RunControl {
        RunControl::Stop
    }
}

//! Writes the journal of each run of a conversation, which `motet replay` reads.

use motet_host::journal::{self, Writer};
use motet_planner::conversation::Scribe;
use motet_runtime::journal::Head;
use motet_runtime::{Control, Driver, Effect, Engine, Onlooker, RunEnd, StartState, Time};

use super::record::Recorder;
use crate::command::run::{head, journal_trouble};

/// The journal of one run.
pub(super) struct Journal {
    recorder: Recorder,
    head: Head,
}

impl Journal {
    pub(super) fn new(recorder: Recorder, engine: &Engine, start: &StartState, request: &str) -> Self {
        let head = Head { instruction: Some(request.to_owned()), ..head(engine, start) };
        Self { recorder, head }
    }
}

impl Scribe for Journal {
    fn run(
        self: Box<Self>,
        engine: &mut Engine,
        driver: &mut dyn Driver,
        onlooker: &mut dyn Onlooker,
        from: Time,
    ) -> RunEnd {
        let Self { recorder, head } = *self;
        let head = Head { from: from.nanos(), ..head };
        let writer = match Writer::create(&recorder.run(), head) {
            Ok(writer) => writer,
            Err(error) => {
                recorder.spoil(journal_trouble(error));
                return motet_runtime::run(engine, driver, &mut Unwritten, from);
            }
        };
        let mut writing = journal::Recorder::new(writer, onlooker);
        let end = motet_runtime::run(engine, driver, &mut writing, from);
        if let Err(error) = writing.finish() {
            recorder.spoil(journal_trouble(error));
        }
        end
    }
}

/// Where there is no journal nothing starts.
struct Unwritten;

impl Onlooker for Unwritten {
    fn commit(&mut self, _now: Time, _effects: &[Effect]) -> Control {
        Control::Stop
    }
}

//! Simulated run of a policy as items of the page, at full speed.

use motet_graph::Graph;
use motet_planner::runtime_check::{CheckMode, Guard};
use motet_project::{ProjectSession, SimulationInputs};
use motet_runtime::journal::JournalEntry;
use motet_runtime::{
    Answer, Detection, Driver as _, Effect, Engine, EngineSettings, Event, Moved, Observer, Query,
    RunControl, Time, ToldThing, Verifier,
};
use motet_sim::Profile;
use motet_syntax::ast::File;
use serde_json::{Value, json};

use crate::page::entries::EntryTracker;
use crate::page::feed::PageFeed;
use crate::page::source::PolicyText;
use crate::page::world::PageWorld;
use crate::run::{ObservedScene, engine, simulator, start_state, undated_head};

/// Number of items after which a run stops.
const MAX_ITEMS: usize = 20_000;
/// Simulated time after which a run stops.
const MAX_TIME: Time = Time::from_nanos(4 * 3600 * 1_000_000_000);
/// Shortest span between two kept reports of motion.
const MOTION_EVERY: Time = Time::from_nanos(150_000_000);
/// Id of every run: a page shows one at a time.
const RUN: &str = "page";

/// Simulates a policy, and returns the items of its page.
pub(super) fn items(
    opened: &ProjectSession,
    (graph, file): (Graph, &File),
    text: PolicyText,
    (seed, profile): (u64, Profile),
) -> Result<Vec<Value>, String> {
    let eye = opened.geometry.as_ref().and_then(|geometry| geometry.eye());
    let inputs = SimulationInputs::with_seed(seed).with_profile(profile).with_eye(eye);
    let (mut driver, _) = simulator(opened, (&graph, file), inputs).map_err(|error| error.to_string())?;
    let guard = opened.session.world_tracker().map(|course| Guard::new(course, CheckMode::AtOnce));
    let start = start_state(opened.scene.as_ref());
    let settings = EngineSettings::default();
    let engine = engine(graph, &start, driver.capabilities(), guard.as_ref(), settings);
    let mut engine = engine.map_err(|error| error.to_string())?;
    let head = undated_head(RUN, &engine, &start);
    let mut world = PageWorld::of(opened);
    let mut items = vec![json!({"t": "hello", "takes": []})];
    items.extend(world.as_mut().map(PageWorld::item));
    let mut feed = PageFeed::new(world);
    feed.text = Some(text);
    items.extend(feed.entry(0, &JournalEntry::Head(Box::new(head))).map(|(_, item)| item));
    let room = ObservedScene::new(opened.scene.clone());
    let entries = EntryTracker::from(1);
    let mut recorder = ItemRecorder { feed, items, entries, room, guard, last_motion: None };
    let from = driver.begin_run(Time::ZERO, RUN, Some(engine.graph()));
    motet_runtime::run(&mut engine, &mut driver, &mut recorder, from);
    Ok(recorder.items)
}

/// Observer that keeps the items of a run.
struct ItemRecorder {
    feed: PageFeed,
    items: Vec<Value>,
    entries: EntryTracker,
    room: ObservedScene,
    guard: Option<Guard>,
    last_motion: Option<Time>,
}

impl Observer for ItemRecorder {
    fn event(&mut self, _now: Time, event: &Event) {
        self.entries.event(event);
    }

    fn commit(&mut self, now: Time, effects: &[Effect]) -> RunControl {
        let entry = self.entries.commit(now, effects);
        let item = entry.and_then(|(number, entry)| self.feed.entry(number, &entry));
        self.items.extend(item.map(|(_, item)| item));
        RunControl::Continue
    }

    fn reached(&mut self, now: Time) -> RunControl {
        let is_long = self.items.len() > MAX_ITEMS || now > MAX_TIME;
        if is_long { RunControl::Stop } else { RunControl::Continue }
    }

    fn wants_telemetry(&self) -> bool {
        true
    }

    fn moved(&mut self, moved: &Moved) {
        if self.last_motion.is_some_and(|last| moved.at < last.after(MOTION_EVERY)) {
            return;
        }
        self.last_motion = Some(moved.at);
        self.items.extend(self.feed.world.as_mut().map(|world| world.moved(moved)));
    }

    fn detected(&mut self, _now: Time, seen: &[Detection], engine: &Engine) -> Vec<(Query, Answer)> {
        self.room.detected(seen, engine, self.guard.as_mut())
    }

    fn tell(&mut self) -> Option<ToldThing> {
        self.room.tell()
    }

    fn verifier(&mut self) -> Option<&mut dyn Verifier> {
        self.guard.as_mut().map(|guard| guard as &mut dyn Verifier)
    }
}

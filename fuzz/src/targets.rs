//! Table of the targets.

use crate::{Target, model_server};
use motet::feasible::{self, Motions};
use motet::project::{Discard, ProjectBuilder, SimulationInputs, read_config};
use motet_compiler::Session;
use motet_compiler::fix::{FixLimits, fix};
use motet_compiler::plan::{Goal, Persistence};
use motet_decode::{EndToken, Vocabulary};
use motet_geometry::planning::RobotModel;
use motet_graph::GraphDocument;
use motet_host::remote::DriverAddress;
use motet_host::remote::protocol::hear;
use motet_pddl::PddlSource;
use motet_planner::inteliplan::{actions, exchange};
use motet_planner::model::{StreamReader, judge};
use motet_requests::RequestContext;
use motet_robots::card::Robot;
use motet_robots::scene::Scene;
use motet_robots::urdf::Urdf;
use motet_robots::{builtin, card, import, mesh, scene, srdf, urdf, xacro};
use motet_runtime::journal::{EngineReplay, JournalEntry, JournalReader, SegmentPosition};
use motet_runtime::{DriverEvent, Effect, Engine, EngineSettings, Event, Outcome, StartState, Time};
use motet_sim::Profile;
use motet_syntax::ast::Item;
use motet_syntax::{FileId, Severity, Source, Sources, Syntax, print, read};
use std::collections::VecDeque;
use std::path::PathBuf;
use std::sync::LazyLock;

/// All targets.
pub const TARGETS: &[Target] = &[
    ("document", document),
    ("text", |bytes| text(bytes, policy_text)),
    ("json", |bytes| text(bytes, policy_json)),
    ("check", |bytes| text(bytes, check)),
    ("fix", |bytes| text(bytes, |source| drop(fix(&ROOM.session, source, FILE, FixLimits::all(20))))),
    ("reply", |bytes| text(bytes, reply)),
    ("model_http", model_server::answer),
    ("scene", |bytes| text(bytes, |source| drop(scene::read(source, FILE)))),
    ("state", |bytes| with_file(bytes, state)),
    ("card", |bytes| text(bytes, |source| drop(card::read(source, FILE, None)))),
    ("urdf", |bytes| text(bytes, |source| drop(urdf::read(source, FILE)))),
    ("srdf", |bytes| text(bytes, |source| drop(srdf::read(source, FILE, &ROOM.urdf)))),
    ("xacro", |bytes| text(bytes, |source| drop(xacro::expand("x", &source.text, &[], &mut NoFiles)))),
    ("sdf", |bytes| text(bytes, |source| drop(import::read_sdf(source, FILE)))),
    ("map", |bytes| text(bytes, |source| drop(import::read_map(source, FILE)))),
    ("map_image", map_image),
    ("stl", |bytes| drop(mesh::read("m.stl", bytes))),
    ("obj", |bytes| drop(mesh::read("m.obj", bytes))),
    ("dae", |bytes| drop(mesh::read("m.dae", bytes))),
    ("pddl", |bytes| text(bytes, pddl)),
    ("btcpp", |bytes| text(bytes, btcpp)),
    ("faults", |bytes| {
        with_file(bytes, |path| drop(SimulationInputs::read(0, Some(&path), None, &mut Discard)))
    }),
    ("answers", |bytes| {
        with_file(bytes, |path| drop(SimulationInputs::read(0, None, Some(&path), &mut Discard)))
    }),
    ("profile", |bytes| text(bytes, |source| drop(Profile::from_toml(&source.text)))),
    ("config", |bytes| with_file(bytes, |path| drop(read_config(&path)))),
    ("dialogue", |bytes| text(bytes, dialogue)),
    ("journal", journal),
    ("graph", |bytes| text(bytes, graph)),
    ("driver", |bytes| text(bytes, |source| source.text.lines().for_each(|line| drop(hear(line))))),
    ("address", |bytes| text(bytes, |source| drop(source.text.parse::<DriverAddress>()))),
    ("goal", |bytes| text(bytes, goal)),
    ("motion", |bytes| text(bytes, motion)),
    ("request", |bytes| text(bytes, request)),
    ("vocabulary", vocabulary),
    ("dataset", |bytes| text(bytes, dataset)),
    ("ros2_binding", |bytes| text(bytes, |source| motet_ros2::outside::binding(&source.text))),
    ("ros2_layouts", |bytes| text(bytes, |source| motet_ros2::outside::layouts(&source.text))),
    ("ros2_message", motet_ros2::outside::message),
];

const FILE: FileId = FileId(u16::MAX);

/// Robot in a room.
struct Room {
    robot: Robot,
    urdf: Urdf,
    scene: Scene,
    machine: RobotModel,
    session: Session,
}

static ROOM: LazyLock<Room> = LazyLock::new(|| {
    let model = builtin::robot("hsr").expect("it is built in");
    let scene = builtin::scene("kitchen").expect("it is built in");
    let session = Session::builder().robot(&model.robot).scene(&scene).build(&mut Sources::default());
    let machine = RobotModel::new(&model.robot, &model.urdf);
    Room { robot: model.robot, urdf: model.urdf, scene, machine, session }
});

/// Session without robot and scene.
static BARE: LazyLock<Session> = LazyLock::new(|| Session::builder().build(&mut Sources::default()));

fn text(bytes: &[u8], read: impl FnOnce(&Source)) {
    if let Ok(text) = motet_syntax::decode(bytes, FILE) {
        read(&Source::new("fuzz", text));
    }
}

/// Writes the bytes to a file, for readers of files.
fn with_file(bytes: &[u8], read: impl FnOnce(PathBuf)) {
    let path = std::env::temp_dir().join(format!("motet-fuzz-{}", std::process::id()));
    std::fs::write(&path, bytes).expect("there is room for a file");
    read(path);
}

/// Parts of a text, which lines of `%%` divide.
fn parts(text: &str) -> [Source; 3] {
    let mut parts = text.split("\n%%\n");
    std::array::from_fn(|_| Source::new("fuzz", parts.next().unwrap_or_default()))
}

fn document(bytes: &[u8]) {
    text(bytes, |source| {
        let parsed = read(source, FILE);
        let _ = print::text(&parsed.file);
        for policy in parsed.file.policies() {
            let _ = print::policy_json(policy);
        }
        let _ = motet_syntax::format(source);
    });
}

fn is_broken(parsed: &motet_syntax::Parsed) -> bool {
    parsed.diagnostics.iter().any(|diagnostic| diagnostic.severity == Severity::Error)
}

/// A tree prints as a text that reads as the same tree, and formatting twice is formatting once.
fn policy_text(source: &Source) {
    let parsed = read(source, FILE);
    if is_broken(&parsed) || parsed.syntax == Syntax::Json {
        return;
    }
    let printed = print::text(&parsed.file);
    let again = read(&Source::new("printed", printed.as_str()), FILE);
    assert!(again.diagnostics.is_empty(), "{printed}");
    assert!(parsed.file == again.file, "{printed}");
    let formatted = motet_syntax::format(source).unwrap_or_default();
    assert_eq!(motet_syntax::format(&Source::new("fuzz", formatted.as_str())).as_ref(), Ok(&formatted));
}

/// A policy prints as JSON that is formatted already.
fn policy_json(source: &Source) {
    let parsed = read(source, FILE);
    if is_broken(&parsed) || parsed.syntax == Syntax::Text {
        return;
    }
    for item in &parsed.file.items {
        let Item::Policy(policy) = item else { continue };
        let printed = print::policy_json(policy);
        let formatted = motet_syntax::format(&Source::new("printed", printed.as_str())).unwrap_or_default();
        assert_eq!(printed, formatted);
    }
}

/// Every stage, without and with a room.
fn check(source: &Source) {
    let parsed = read(source, FILE);
    for session in [&*BARE, &ROOM.session] {
        let _ = session.check(&parsed);
        let _ = session.compile(&parsed, None);
    }
}

/// A reply of a model, as a whole and as it arrives.
fn reply(source: &Source) {
    let _ = judge(&ROOM.session, &source.text);
    let mut stream = StreamReader::new(&ROOM.session, None);
    for letter in source.text.chars() {
        let _ = stream.push(letter.encode_utf8(&mut [0; 4]));
    }
}

fn state(path: PathBuf) {
    let inputs = ProjectBuilder::default().robot("hsr").scene("kitchen").state(path).without_motions();
    let _ = inputs.open_with(&mut Discard).and_then(|project| project.into_session(&mut Discard));
}

struct NoFiles;

impl xacro::XacroFiles for NoFiles {
    fn read(&mut self, path: &str) -> Result<String, String> {
        Err(format!("no {path}"))
    }
    fn package(&mut self, _: &str) -> Option<String> {
        None
    }
}

/// A domain, a problem and a plan.
fn pddl(source: &Source) {
    let parts = parts(&source.text);
    let [domain, problem, plan] = parts.each_ref().map(|source| PddlSource { source, file: FILE });
    let plan = Some(plan).filter(|plan| !plan.source.text.is_empty());
    if let (Some(translation), _) = motet_pddl::import(domain, problem, plan) {
        let read = read(&Source::new("printed", translation.declarations_text()), FILE);
        assert!(!is_broken(&read), "{:?}", read.diagnostics);
    }
}

fn btcpp(source: &Source) {
    if let (Some(file), _) = motet_btcpp::import(source, FILE, &motet_btcpp::Leaves::default()) {
        let read = read(&Source::new("printed", print::text(&file)), FILE);
        assert!(!is_broken(&read), "{:?}", read.diagnostics);
    }
}

fn dialogue(source: &Source) {
    let _ = exchange::read(&source.text);
    let situation = RequestContext::new(&ROOM.scene);
    if let Ok(plan) = actions::read(&source.text, "fetch", &ROOM.session, Some(&ROOM.robot), &situation) {
        let read = read(&Source::new("plan", plan.policy.as_str()), FILE);
        assert!(!is_broken(&read), "{:?}", read.diagnostics);
    }
}

/// A journal whose checksums are right, since nothing else gets past them: each line is an entry.
fn journal(bytes: &[u8]) {
    let _ = JournalReader::default().segment("fuzz", bytes, SegmentPosition::Last, &mut |_, _| ());
    let lines = bytes.split(|byte| *byte == b'\n');
    let mut entries = lines.map_while(|line| serde_json::from_slice::<JournalEntry>(line).ok());
    let Some(JournalEntry::Head(mut head)) = entries.next() else { return };
    head.graph.hash = motet_graph::hash(&head.graph.graph);
    let Ok(mut replay) = EngineReplay::new(&head) else { return };
    for entry in entries {
        if replay.take(&entry).is_err() {
            return;
        }
    }
}

/// A graph whose hash is right, and a run of it in which every call succeeds at once.
fn graph(source: &Source) {
    let _ = motet_graph::decode(&source.text);
    let Ok(document) = serde_json::from_str::<GraphDocument>(&source.text) else { return };
    let Ok(engine) = Engine::new(document.graph, &StartState::default()) else { return };
    let mut engine =
        engine.with_settings(EngineSettings { step_budget: 10_000, ..EngineSettings::default() });
    let (mut events, mut out) = (VecDeque::from([Event::Begin]), Vec::new());
    for tenth in 0..100 {
        engine.handle(
            Time::from_secs(f64::from(tenth) / 10.0),
            events.pop_front().unwrap_or(Event::Tick),
            &mut out,
        );
        for effect in out.drain(..) {
            if let Effect::Start { goal, .. } = effect {
                let outcome = Outcome::Success(None);
                events.push_back(Event::Driver(DriverEvent::Ended { goal, outcome }));
            }
        }
    }
}

fn map_image(bytes: &[u8]) {
    let yaml =
        "image: m\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.2\n";
    let (map, _) = import::read_map(&Source::new("map", yaml), FILE);
    drop(map.expect("it is one").scene(bytes, &import::MapOptions::default()));
}

fn goal(source: &Source) {
    let _ = Goal::read(&source.text, Persistence::ToTheEnd);
    let _ = Goal::read(&source.text, Persistence::Once);
}

fn motion(source: &Source) {
    let motions = [source.text.to_string()];
    let mut sources = Sources::default();
    let body = (&ROOM.machine, &ROOM.scene);
    let _ = feasible::queries(Motions::These(&motions), body, &ROOM.session, &mut sources, &mut Discard);
}

/// Words of a person, in all roles.
fn request(source: &Source) {
    let (text, situation) = (&source.text, RequestContext::new(&ROOM.scene));
    let _ = motet_requests::understand(text, &situation);
    let _ = motet_requests::question(text, &situation);
    let _ = motet_requests::turn(text);
    let _ = (motet_requests::stops(text), motet_requests::holds(text), motet_requests::proceeds(text));
}

fn vocabulary(bytes: &[u8]) {
    let _ = Vocabulary::from_file(bytes, EndToken::Known);
    let _ = Vocabulary::from_tokenizer_json(bytes, EndToken::Known);
    let _ = Vocabulary::from_json_list(bytes, EndToken::Number(0));
    let _ = Vocabulary::from_base64_lines(bytes, EndToken::Number(0));
}

fn dataset(source: &Source) {
    let _ = motet_dataset::format::read(&source.text);
    let _ = motet_dataset::lesson::read(&source.text);
    let _ = motet_dataset::wordings::read(&source.text);
}

//! Cost of planning beside the model, part by part, and the time of the first motion on replayed replies.

#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    clippy::indexing_slicing,
    missing_docs,
    reason = "a benchmark that cannot be set up has failed"
)]

#[path = "../tests/client/kitchen.rs"]
#[allow(dead_code, reason = "the tests use all of it")]
mod kitchen;
#[path = "../tests/client/server.rs"]
#[allow(dead_code, reason = "the tests use all of it")]
mod server;

use std::sync::Arc;
use std::time::{Duration, Instant};

use kitchen::{Heard, brisk, geometry, right, setting};
use motet_client::dialect::{Dialect, GrammarCarrier, request_constraint};
use motet_client::{Client, ClientSettings};
use motet_compiler::{InitialState, Session};
use motet_decode::{AcceptorFactory as Acceptors, Grammar, Subset};
use motet_planner::dialogue::{Conversation, DialogueObserver, DialogueSetup, NoOperator};
use motet_planner::model::{self, ModelPlanner, ReplyVerdict, Start, StreamReader, judge};
use motet_planner::prompt::{Prompt, StaticPrompt, TIME, TOKENS};
use motet_requests::RequestContext;
use motet_runtime::memory::{Memory, MemoryLimits};
use motet_runtime::{Effect, Engine, PreparedSwap, StartState, Time};
use motet_sim::{Sim, SimOptions};
use motet_syntax::Sources;
use server::{Act, Server};

const REQUESTS: &[&str] = &["bring me the coke", "put the red mug in the cupboard", "open the fridge"];
const RUNS: usize = 50;
/// Work that is done while a model is still writing, so that it adds no waiting time.
const AS_IT_ARRIVES: &str = "read as it arrives";

fn main() {
    overhead();
    first_action();
}

fn overhead() {
    let mut setting = setting();
    let geometry = geometry();
    setting.geometry = Some(Arc::clone(&geometry));
    let mut made: Vec<Duration> = Vec::new();
    for _ in 0..RUNS.min(10) {
        let from = Instant::now();
        let _ = Kept::new(&setting);
        made.push(from.elapsed());
    }
    let kept = Kept::new(&setting);
    let mut parts: Vec<(&str, Vec<Duration>)> = Vec::new();
    let (mut all, mut waited) = (Vec::new(), Vec::new());
    for _ in 0..RUNS {
        for request in REQUESTS {
            let reply = right(&setting, request);
            let laps = once(&setting, &kept, request, &reply);
            let own = |is_own: &dyn Fn(&str) -> bool| {
                laps.iter().filter(|(name, _)| is_own(name)).map(|(_, lap)| *lap).sum::<Duration>()
            };
            all.push(own(&|_| true));
            waited.push(own(&|name| name != AS_IT_ARRIVES));
            for (name, lap) in laps {
                match parts.iter_mut().find(|(known, _)| *known == name) {
                    Some((_, laps)) => laps.push(lap),
                    None => parts.push((name, vec![lap])),
                }
            }
        }
    }
    println!("once for the robot in the room: {:.3?}", rank(&mut made, 50));
    println!("kitchen, hsr, {} requests; median, 95th and 99th percentile", all.len());
    let sums = [("together", &mut all), ("without what is read as it arrives", &mut waited)];
    for (name, laps) in parts.iter_mut().map(|(name, laps)| (*name, laps)).chain(sums) {
        let [half, most, nearly_all] = [50, 95, 99].map(|percent| rank(laps, percent));
        println!("  {name:<34} {half:>9.3?} {most:>9.3?} {nearly_all:>9.3?}");
    }
    let fresh: Vec<Duration> = REQUESTS
        .iter()
        .map(|request| {
            let reply = right(&setting, request);
            let new = Arc::new(geometry.elsewhere(&setting.scene));
            let session = session(&setting).with_geometry(new);
            let from = Instant::now();
            let _ = judge(&session, &reply);
            from.elapsed()
        })
        .collect();
    println!("  check, motions and compile where no motion has been asked for before: {fresh:.1?}");
}

/// State that is built once for a robot in a room.
struct Kept {
    session: Session,
    lasting: StaticPrompt,
    grammar: Grammar,
    constraint: String,
    acceptors: Acceptors,
}

impl Kept {
    fn new(setting: &DialogueSetup) -> Self {
        let session = session(setting);
        let grammar = Grammar::new(&session.signatures(), Subset::default());
        let constraint =
            request_constraint(Dialect::Vllm, GrammarCarrier::Usual, &grammar).unwrap().to_string();
        Self {
            lasting: StaticPrompt::new(&session, &setting.robot, &setting.scene),
            acceptors: Acceptors::new(&session, Subset::default()),
            session,
            grammar,
            constraint,
        }
    }
}

fn session(setting: &DialogueSetup) -> Session {
    let (robot, scene) = (Some(&setting.robot), Some(&setting.scene));
    Session::builder().robot(robot).scene(scene).options(setting.options).build(&mut Sources::default())
}

/// Everything between a request and the new policy, with its times.
fn once(setting: &DialogueSetup, kept: &Kept, request: &str, reply: &str) -> Vec<(&'static str, Duration)> {
    let mut laps = Vec::new();
    let mut from = Instant::now();
    let mut lap = |name| {
        let now = Instant::now();
        laps.push((name, now - from));
        from = Instant::now();
    };
    let session = kept.session.with_scene(Some(&setting.scene), Some(&InitialState::default()));
    let session = session.with_geometry(Arc::clone(setting.geometry.as_ref().unwrap()));
    lap("session: scene and state");
    let situation = RequestContext::new(&setting.scene);
    let mut memory = Memory::new(MemoryLimits::default());
    memory.instruct(Time::ZERO, request);
    let prompt = Prompt {
        session: &session,
        robot: &setting.robot,
        scene: &setting.scene,
        situation: &situation,
        memory: &memory,
        bound: &[],
        lasting: &kept.lasting,
        tokens: TOKENS,
        time: TIME,
    };
    let _ = prompt.write(request);
    lap("prompt");
    // As a client does before it sends what it made for the same grammar.
    assert!(kept.grammar == kept.grammar.clone() && !kept.constraint.is_empty());
    lap("constraint");
    let mut reading = StreamReader::new(&session, kept.acceptors.elsewhere(&session).acceptor(16_000));
    let letters: Vec<char> = reply.chars().collect();
    let (before, last) = letters.split_at(letters.len() - 4);
    for piece in before.chunks(4) {
        let _ = reading.push(&piece.iter().collect::<String>());
    }
    lap(AS_IT_ARRIVES);
    let _ = reading.push(&last.iter().collect::<String>());
    lap("read the last piece");
    let judged = judge(&session, reading.policy());
    assert!(matches!(judged, ReplyVerdict::Good { .. }), "{judged:?}");
    let ReplyVerdict::Good { planned, .. } = judged else { return laps };
    lap("check, motions, compile");
    let graph = planned.compiled.graph.unwrap();
    let entities = setting.scene.entities.values().map(|entity| (entity.id.clone(), entity.kind.clone()));
    let start = StartState { entities: entities.collect(), ..StartState::default() };
    let mut engine = Engine::new(graph.clone(), &start).unwrap();
    let mut out = Vec::new();
    // The engine was there before: only the swap counts. It is one before the first step, which takes from
    // the facts that the policy was proved from.
    from = Instant::now();
    let prepared = PreparedSwap::new(graph, &engine.running()).unwrap();
    engine.swap(Time::ZERO, prepared, &mut out).unwrap();
    laps.push(("swap", from.elapsed()));
    laps
}

fn rank(laps: &mut [Duration], percent: usize) -> Duration {
    laps.sort();
    laps[(laps.len() * percent / 100).min(laps.len() - 1)]
}

/// Notes when the robot is first told to do something.
struct First(Instant, Option<Duration>);

impl DialogueObserver for First {
    fn effect(&mut self, _: Time, effect: &Effect) {
        if matches!(effect, Effect::Start { .. }) {
            self.1.get_or_insert(self.0.elapsed());
        }
    }
}

fn first_action() {
    let setting = setting();
    println!("from the request to the first action, replies of 4 characters each 20 ms (50 tokens a second)");
    for request in REQUESTS {
        let reply = right(&setting, request);
        let mut times = Vec::new();
        for start in [Start::Whole, Start::FirstStep] {
            let says = Act::Says { text: reply.clone(), each: 4, pause: Duration::from_millis(20) };
            let server = Server::new(vec![says]);
            let settings = ClientSettings { idle_timeout: Duration::from_secs(5), ..brisk(&server) };
            let how = model::Settings { start, ..model::Settings::default() };
            let mut planner = ModelPlanner::new(Client::new(settings).unwrap(), Heard::default(), how);
            let mut sim = Sim::new(&setting.robot, &setting.scene, SimOptions::default());
            let mut first = First(Instant::now(), None);
            let (outcome, _) = Conversation::new(&setting).carry_out(
                request,
                &mut planner,
                &mut sim,
                &mut NoOperator,
                &mut first,
                Time::ZERO,
            );
            times.push(format!("{:.2} s ({outcome:?})", first.1.unwrap().as_secs_f64()));
        }
        println!("  {request:<34} {} bytes: whole {}, first step {}", reply.len(), times[0], times[1]);
    }
}

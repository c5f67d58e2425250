//! Random policies in random worlds: no need that is proven, or that a guard has passed, is false when its
//! step begins.

use std::collections::{BTreeMap, BTreeSet};

use motet_eval::soundness::{SeededFault, fuzz, fuzz_with, play};
use motet_eval::{Workers, setup};
use motet_graph::{Condition, FactArg, Graph, Need, NodeKind, Term, Value, Verdict};
use motet_runtime::{
    Answer, Driver as _, Effect, Engine, Event, Pattern, Query, StartState, Time, TraceEventKind, Truth,
};
use motet_sim::{Faults, Sim, SimOptions};
use motet_syntax::{FileId, Severity, Source, Sources};

/// Beside the checkout, where the reference data is kept.
const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../shared/data/soundness");

#[test]
fn soundness_no_need_of_a_random_policy_is_broken() {
    let found = fuzz(Workers::default(), 5_000, 7).unwrap();
    assert!(found.sums.findings.is_empty(), "{}", found.findings.join("\n\n"));
    // The policies are worth it: many are accepted, and of those that are refused most break a need.
    let sums = &found.sums;
    assert!(sums.accepted * 5 >= sums.policies, "{sums:?}");
    assert!(sums.refuted * 10 >= sums.policies, "{sums:?}");
    assert!(sums.refuted_in_vain * 2 <= sums.refuted, "{sums:?}");
    // Goals are judged, and some are called proven.
    assert!(sums.goals_proven * 2 >= sums.goals, "{sums:?}");
    assert!(sums.goals * 5 >= sums.accepted, "{sums:?}");
}

#[test]
fn soundness_finds_a_seeded_fault() {
    let sorts: [(SeededFault, &[&str]); 2] =
        [(SeededFault::ProvesTooMuch, &["proven", "goal"]), (SeededFault::ForgetsUnsettled, &["passed"])];
    for (fault, sorts) in sorts {
        let found = fuzz_with(Workers::default(), 600, 7, Some(fault)).unwrap();
        assert!(!found.findings.is_empty(), "{fault:?}");
        for sort in sorts {
            assert!(found.sums.findings.contains_key(*sort), "{fault:?}: {:?}", found.sums);
        }
    }
}

#[test]
fn soundness_the_same_seed_gives_the_same() {
    let sums = || fuzz(Workers::default(), 40, 3).unwrap().sums;
    assert_eq!(sums(), sums());
}

/// Documents of which each had a need that was called proven, or passed by a guard, and did not hold.
fn documents() -> Vec<(String, String)> {
    let files = std::fs::read_dir(FOLDER).unwrap().map(|entry| entry.unwrap().path());
    let mut files: Vec<_> = files.filter(|path| path.extension().is_some_and(|ext| ext == "motet")).collect();
    files.sort();
    let name = |path: &std::path::Path| path.file_name().unwrap().to_string_lossy().into_owned();
    files.iter().map(|path| (name(path), std::fs::read_to_string(path).unwrap())).collect()
}

/// Outcome of each document: no policy of it is accepted; a guard asks for a need that some run breaks where
/// none does; or all needs are proven.
const OUTCOMES: [(&str, &[&str]); 3] = [
    ("refused", &["rcA", "rcK", "rcM"]),
    ("guarded", &["rcB", "rcC", "rcC2", "rcD", "rcE", "rcF", "rcI2", "rcI3", "rcJ", "rcL", "rcP"]),
    ("proven", &["rcG", "rcH"]),
];

#[test]
#[ignore = "needs the reference data beside the checkout"]
fn soundness_no_need_of_a_document_is_broken() {
    let mut outcomes = BTreeMap::from(OUTCOMES.map(|(outcome, _)| (outcome, Vec::new())));
    for document in documents() {
        let document = [document];
        let played = play(&document, 1, None).unwrap();
        assert!(played.sums.findings.is_empty(), "{}", played.findings.join("\n\n"));
        let trusting = play(&document, 1, Some(SeededFault::ProvesTooMuch)).unwrap();
        let outcome = match (played.sums.accepted, trusting.findings.is_empty()) {
            (0, _) => "refused",
            (_, false) => "guarded",
            (_, true) => "proven",
        };
        let [(name, _)] = document;
        outcomes.entry(outcome).or_default().push(name);
    }
    for (outcome, expected) in OUTCOMES {
        let expected: Vec<String> = expected.iter().map(|name| format!("{name}.motet")).collect();
        assert_eq!(outcomes.get(outcome), Some(&expected), "{outcome}");
    }
}

/// Policies over the standard library that once broke a need: the scene, the faults of the runs, and
/// the code with which the check refuses it.
const STANDARD: [(&str, &str, &str, Option<&str>); 17] = [
    ("s_A_any", "kitchen", "", Some("M0501")),
    ("s_C_goal", "k.json", "", None),
    ("s_C_handover", "kitchen", "", Some("M0501")),
    ("s_C_open", "k_nolock.json", "f_lock.json", None),
    ("s_C_pick", "k.json", "f_slip.json", None),
    ("s_C_place", "k.json", "", None),
    ("s_D_locate", "k.json", "f_moved.json", None),
    ("s_E_pick", "k.json", "f_moved.json", None),
    ("s_G", "k.json", "f_walk.json", None),
    ("s_G_pause", "k.json", "f_walk.json", None),
    ("s_I_else", "k_nolock.json", "f_lock.json", None),
    ("s_K_restart", "k.json", "f_slipk.json", Some("M0501")),
    ("s_L", "k.json", "", None),
    ("s_L_alias", "k.json", "", None),
    ("s_L_clear", "k.json", "", None),
    ("s_M", "k.json", "", None),
    ("s_N", "k.json", "", None),
];

#[test]
#[ignore = "needs the reference data beside the checkout"]
fn soundness_no_need_of_a_standard_policy_is_broken() {
    let read = |name: &str| std::fs::read_to_string(format!("{FOLDER}/standard/{name}")).unwrap();
    let (mut told, mut blind) = (Vec::new(), BTreeSet::new());
    for (name, scene, faults, refused) in STANDARD {
        let scene =
            if scene == "kitchen" { setup::scene(scene) } else { setup::scene_from(scene, &read(scene)) };
        let robot = setup::robot("hsr");
        let (session, _) = setup::session(Some(&robot), Some(&scene), &mut Sources::default());
        let parsed = motet_syntax::read(&Source::new(name, read(&format!("{name}.motet"))), FileId(9));
        let compiled = session.compile(&parsed, None);
        let errors = compiled.diagnostics.iter().filter(|found| found.severity == Severity::Error);
        let errors: Vec<&str> = errors.map(|found| found.code.0).collect();
        match (refused, compiled.graph) {
            (Some(code), _) => assert!(errors.contains(&code), "{name}: {errors:?}"),
            (None, None) => panic!("{name}: {errors:?}"),
            (None, Some(graph)) => {
                let mut trusting = graph.clone();
                for node in &mut trusting.nodes {
                    if let NodeKind::Call(call) = &mut node.kind {
                        call.needs.iter_mut().for_each(|need| need.verdict = Verdict::Proven);
                    }
                }
                let faults = if faults.is_empty() { "{}".to_owned() } else { read(faults) };
                let faults = Faults::from_json(&faults).unwrap();
                for seed in 0..20 {
                    let options = SimOptions { seed, faults: faults.clone(), ..SimOptions::default() };
                    let sim = || Sim::new(&robot, &scene, options.clone());
                    told.extend(broken(&graph, sim()).iter().map(|what| format!("{name}, {seed}: {what}")));
                    blind.extend(broken(&trusting, sim()).iter().map(|_| name));
                }
            }
        }
    }
    assert!(told.is_empty(), "{}", told.join("\n"));
    // The same runs break needs where no guard asks.
    assert_eq!(blind, BTreeSet::from(["s_C_goal", "s_C_open", "s_L_alias", "s_L_clear"]));
}

/// Runs a graph in simulation. Returns the needs that are false when their step begins.
fn broken(graph: &Graph, mut sim: Sim) -> Vec<String> {
    let engine = Engine::new(graph.clone(), &StartState::default()).unwrap();
    let mut engine = engine.with_capabilities(sim.capabilities());
    let (mut now, mut event, mut effects, mut broken) = (Time::ZERO, Event::Begin, Vec::new(), Vec::new());
    let mut bound: BTreeMap<usize, Value> = BTreeMap::new();
    loop {
        engine.handle(now, event, &mut effects);
        for effect in std::mem::take(&mut effects) {
            match &effect {
                Effect::Finished(_) => return broken,
                Effect::Report(trace) => {
                    if let TraceEventKind::Bound { binding, value } = &trace.what {
                        bound.insert(binding.index(), (**value).clone());
                    }
                }
                Effect::Start { node, command, .. } => {
                    let NodeKind::Call(call) = &graph.nodes[node.index()].kind else { continue };
                    let of = |condition: &Condition| truth(graph, condition, &sim, &bound);
                    let is_false = |need: &&Need| {
                        need.when.as_ref().is_none_or(|when| of(when) == Truth::True)
                            && of(&need.condition) == Truth::False
                    };
                    for need in call.needs.iter().filter(is_false) {
                        broken.push(format!("{command}: {:?} is {:?}", need.condition, need.verdict));
                    }
                }
                _ => {}
            }
            sim.carry_out(now, &effect);
        }
        let wake = engine.wake_at().unwrap_or(Time::NEVER);
        (now, event) = match sim.advance(wake) {
            Some((at, report)) => (at.max(now), Event::Driver(report)),
            None => (wake, Event::Tick),
        };
        assert!(now < Time::from_secs(3600.0), "the run does not end");
    }
}

/// Truth of a condition in the world, as far as it knows.
fn truth(graph: &Graph, condition: &Condition, sim: &Sim, bound: &BTreeMap<usize, Value>) -> Truth {
    let part = |part: &Condition| truth(graph, part, sim, bound);
    match condition {
        Condition::Literal(value) => Truth::from(*value),
        Condition::Not(inner) => part(inner).negated(),
        Condition::All(parts) => parts.iter().fold(Truth::True, |truth, one| truth.and(part(one))),
        Condition::AnyOf(parts) => parts.iter().fold(Truth::False, |truth, one| truth.or(part(one))),
        Condition::Compare(..) => Truth::Unknown,
        Condition::Fact(fact) => {
            let args = fact.args.iter().map(|arg| match arg {
                FactArg::Any => Some(Pattern::Any),
                FactArg::Term(Term::Literal(value)) => Some(Pattern::Is(value.clone())),
                FactArg::Term(Term::Binding(binding)) => {
                    bound.get(&binding.index()).cloned().map(Pattern::Is)
                }
                FactArg::Term(_) => None,
            });
            let Some(args) = args.collect() else { return Truth::Unknown };
            let fluent = graph.fluents[fact.fluent.index()].name.clone();
            match sim.truth(&Query::Fact { fluent, args }) {
                Answer::Truth(truth) => Truth::from(truth),
                Answer::Unknown | Answer::Value(_) => Truth::Unknown,
            }
        }
    }
}

//! What checking a policy costs: reading, resolving, checking and proving the JSON form, beside what
//! `serde_json` and `jsonschema` take only to validate the same bytes, and how the cost grows with the
//! policy.

#![allow(clippy::expect_used, missing_docs, reason = "a benchmark that cannot be set up has failed")]

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use motet_compiler::Session;
use motet_syntax::{FileId, Source, Sources};
use motet_tests::{generate, setup};

fn session() -> Session {
    let mut sources = Sources::default();
    let (robot, scene) = (setup::robot("hsr"), setup::scene("kitchen"));
    setup::session(Some(&robot), Some(&scene), &mut sources).0
}

fn check(session: &Session, text: &str) -> usize {
    let source = Source::new("policy.json", text);
    session.check(&motet_syntax::read(&source, FileId(u16::MAX))).len()
}

fn twenty_steps(c: &mut Criterion) {
    let session = session();
    let text = generate::policy_of(20);
    let schema = serde_json::to_value(motet_syntax::json::policy_schema()).expect("a schema is JSON");
    let validator = jsonschema::validator_for(&schema).expect("the schema is valid");
    let document: serde_json::Value = serde_json::from_str(&text).expect("the policy is JSON");
    assert!(validator.is_valid(&document), "the exported schema takes the policy");
    assert_eq!(check(&session, &text), 0, "the policy has no findings");

    let mut group = c.benchmark_group("policy of 20 steps");
    group.throughput(Throughput::Elements(20));
    group.bench_function("motet: read, resolve, check, prove", |b| {
        b.iter(|| check(&session, black_box(&text)))
    });
    group.bench_function("serde_json + jsonschema: validate only", |b| {
        b.iter(|| {
            let document: serde_json::Value =
                serde_json::from_str(black_box(&text)).expect("the policy is JSON");
            validator.is_valid(&document)
        });
    });
    group.finish();
}

fn growth(c: &mut Criterion) {
    let session = session();
    let mut group = c.benchmark_group("cost a step");
    for steps in [100, 1_000, 10_000] {
        let text = generate::policy_of(steps);
        group.throughput(Throughput::Elements(steps as u64));
        group.bench_with_input(BenchmarkId::from_parameter(steps), &text, |b, text| {
            b.iter(|| check(&session, text))
        });
    }
    group.finish();
}

/// A symbolic domain of 1,000 entities: long plans, right and with 500 mistakes, and policies of many ways.
fn depot(c: &mut Criterion) {
    const BOXES: usize = 995;
    let mut sources = Sources::default();
    let source = Source::new("depot.motet", generate::depot(BOXES));
    let file = sources.add(source.clone());
    let declared = motet_syntax::read(&source, file).file;
    let session = Session::builder().domains(&[declared]).build(&mut sources);
    let said = session.input_diagnostics().to_vec();
    assert!(said.is_empty(), "the domain has no findings: {said:?}");
    let mut group = c.benchmark_group("symbolic domain of 1,000 entities");
    let right = generate::depot_plan(BOXES, 10_000, None);
    assert_eq!(check(&session, &right), 0, "the plan is right");
    for (name, text) in [
        ("a right plan of 10,000 steps", right),
        ("a plan of 10,000 steps with 500 mistakes", generate::depot_plan(BOXES, 10_000, Some(10))),
        ("20 nested branches", generate::nested_branches(20)),
        ("20 successive branches", generate::successive_branches(20)),
        ("8 nested loops", generate::nested_loops(8)),
    ] {
        group.bench_function(name, |b| b.iter(|| check(&session, black_box(&text))));
    }
    group.finish();
}

criterion_group!(benches, twenty_steps, growth, depot);
criterion_main!(benches);

//! Cost of compiling a policy with the motions in its scene: every policy of `examples/` for the HSR in the
//! kitchen, in a session of its own, then all one after the other in one session, then again.
//!
//! A policy is compiled in milliseconds, and the first time differs from the next, so this is no loop of
//! criterion's.

#![allow(
    clippy::expect_used,
    clippy::indexing_slicing,
    clippy::disallowed_methods,
    clippy::print_stdout,
    missing_docs,
    reason = "a benchmark that cannot be set up has failed"
)]

use std::sync::Arc;
use std::time::Instant;

use motet_compiler::{Geometry, Session};
use motet_geometry::planning::SearchBudget;
use motet_graph::{NodeKind, Verdict};
use motet_robots::builtin::{self, RobotWithBody};
use motet_robots::card::Robot;
use motet_robots::scene::Scene;
use motet_robots::urdf::Urdf;
use motet_syntax::{FileId, Parsed, Source, Sources};

fn session(robot: &Robot, urdf: &Urdf, scene: &Scene) -> Session {
    let session = Session::builder().robot(robot).scene(scene).build(&mut Sources::default());
    session.with_geometry(Arc::new(Geometry::new(robot, urdf, scene, None, SearchBudget::default())))
}

fn examples() -> Vec<(String, Parsed)> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../examples");
    let mut all: Vec<(String, Parsed)> = std::fs::read_dir(folder)
        .expect("examples")
        .filter_map(|entry| {
            let path = entry.ok()?.path();
            let name = path.file_name()?.to_str()?.to_owned();
            let text = name.ends_with(".json").then(|| std::fs::read_to_string(&path).ok())??;
            let parsed = motet_syntax::read(&Source::new(name.as_str(), text.as_str()), FileId(u16::MAX));
            let policy = parsed.file.policies().next()?;
            let is_ours = policy.robot.as_ref().is_some_and(|robot| robot.text == "hsr");
            is_ours.then_some((name, parsed))
        })
        .collect();
    all.sort_by(|one, other| one.0.cmp(&other.0));
    all
}

/// Time in ms, motions, and how many of them are proven; and which are not, with why.
fn compiled(session: &Session, parsed: &Parsed) -> (f64, usize, usize, Vec<String>) {
    let begin = Instant::now();
    let compiled = session.compile(parsed, None);
    let took = begin.elapsed().as_secs_f64() * 1e3;
    let mut left: Vec<String> = compiled
        .diagnostics
        .iter()
        .filter(|it| it.code.0.starts_with("M06"))
        .map(|it| format!("{} {}", it.code, it.message))
        .collect();
    let (mut all, mut proven) = (0, 0);
    for node in compiled.graph.iter().flat_map(|graph| &graph.nodes) {
        let NodeKind::Call(call) = &node.kind else { continue };
        let Some(motion) = &call.motion else { continue };
        all += 1;
        if motion.verdict == Verdict::Proven {
            proven += 1;
        } else {
            left.push(format!("{}: {}", motion.query, motion.why.as_deref().unwrap_or("-")));
        }
    }
    (took, all, proven, left)
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or_default()
}

fn main() {
    let RobotWithBody { robot, urdf } = builtin::robot("hsr").expect("hsr");
    let scene = builtin::scene("kitchen").expect("kitchen");
    let examples = examples();
    let shared = session(&robot, &urdf, &scene);
    let (mut alone, mut first, mut again) = (vec![], vec![], vec![]);
    let (mut motions, mut proven) = (0, 0);
    println!("{:30} {:>9} {:>9} {:>9}  motions proven", "policy", "alone", "shared", "again");
    for (name, parsed) in &examples {
        let own = median((0..5).map(|_| compiled(&session(&robot, &urdf, &scene), parsed).0).collect());
        let (once, all, sure, left) = compiled(&shared, parsed);
        let (twice, ..) = compiled(&shared, parsed);
        println!("{name:30} {own:9.3} {once:9.3} {twice:9.3}  {all:7} {sure:6}");
        left.iter().for_each(|why| println!("    {why}"));
        alone.push(own);
        first.push(once);
        again.push(twice);
        motions += all;
        proven += sure;
    }
    let (alone, first, again) = (median(alone), median(first), median(again));
    println!("{:30} {alone:9.3} {first:9.3} {again:9.3}  {motions:7} {proven:6}", "median in ms, sums");
}

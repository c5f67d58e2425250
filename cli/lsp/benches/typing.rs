//! Time from an edit to its diagnostics, over the protocol: a key is pressed in a policy of 500 lines.

#![allow(
    clippy::expect_used,
    clippy::indexing_slicing,
    clippy::panic,
    clippy::unwrap_used,
    missing_docs,
    reason = "a benchmark that cannot be set up has failed"
)]

#[path = "../tests/protocol/client.rs"]
#[allow(dead_code, reason = "the tests use the rest")]
mod client;

use criterion::{Criterion, criterion_group, criterion_main};

use self::client::Client;

/// Policy of 500 lines that passes: monitors, branches, loops and handlers around calls.
fn policy() -> String {
    let round = "    go(kitchen_table)
    let NAME = detect(\"red mug\")
    try {
        pick(NAME) within 20 s retry 1
    } catch unreachable {
        replan \"I cannot reach it\"
    }
    monitor {
        when distance(user) < 0.5 m for 200 ms then pause
    } during {
        go(counter)
    }
    place(NAME, counter)
    pick(NAME)
    go(kitchen_table)
    place(NAME, kitchen_table)
    if visible(user) {
        say(\"One more time.\")
    } else {
        wait 1 s
    }
";
    let mut text = "policy rounds for hsr {\n".to_owned();
    let mut rounds = 0;
    while text.lines().count() + round.lines().count() < 500 {
        rounds += 1;
        // A name is bound once.
        text.push_str(&round.replace("NAME", &format!("mug{rounds}")));
    }
    while text.lines().count() < 499 {
        text.push_str("    say(\"done\")\n");
    }
    text + "}\n"
}

fn typing(criterion: &mut Criterion) {
    const URI: &str = "file:///home/rounds.motet";
    for (name, with_motions) in [("without motions", false), ("with motions", true)] {
        let mut client = Client::with_motions(with_motions);
        let text = policy();
        let line = u32::try_from(text.lines().count() / 2).unwrap();
        client.open(URI, &text);
        let errors = client.diagnostics(URI, 1).into_iter().filter(|found| found["severity"] == 1);
        assert_eq!(errors.count(), 0);
        let mut version = 1;
        criterion.bench_function(&format!("a key in 500 lines, {name}"), |bencher| {
            bencher.iter(|| {
                version += 1;
                // A blank more or less at the end of a line.
                let edit =
                    if version % 2 == 0 { ([line, 0, line, 0], " ") } else { ([line, 0, line, 1], "") };
                client.change(URI, version, edit.0, edit.1);
                client.diagnostics(URI, version)
            });
        });
        client.end();
    }
}

criterion_group!(benches, typing);
criterion_main!(benches);

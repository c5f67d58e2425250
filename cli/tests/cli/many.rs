//! Many policies at once: threads, shards, files of results, for `motet check`, `run` and `dataset`.

use serde_json::{Value, json};

use crate::support::Place;

/// Policies, of which every third one is wrong, one a line, with an empty line in between.
fn policies(count: usize) -> String {
    let line = |index: usize| {
        let object = if index % 3 == 2 { "no_such_thing" } else { "mug_1" };
        let steps = json!([{"do": "go", "to": "counter"}, {"do": "go", "to": object}]);
        json!({"motet": 1, "policy": format!("p{index}"), "robot": "hsr", "steps": steps}).to_string() + "\n"
    };
    (0..count).map(|index| if index == 1 { format!("\n{}", line(index)) } else { line(index) }).collect()
}

const CHECK: &str = "check all.jsonl --scene kitchen --no-geometry";
const RUN: &str = "run all.jsonl --scene kitchen --no-geometry --profile ideal";

fn place(name: &str) -> Place {
    Place::new(name).file("all.jsonl", policies(100))
}

/// Lines of a file of results.
fn lines(place: &Place, name: &str) -> Vec<Value> {
    place.read(name).lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

#[test]
fn check_prints_the_same_with_any_number_of_threads() {
    let place = place("many_check");
    for format in ["human", "json", "sarif", "llm"] {
        let one = place.run(&format!("{CHECK} --format {format} -j 1"));
        assert_eq!(one.code, Some(1), "{}", one.stderr);
        assert!(one.stderr.contains("checked 100 documents: 33 errors"), "{}", one.stderr);
        for jobs in [2, 7] {
            let more = place.run(&format!("{CHECK} --format {format} -j {jobs}"));
            assert_eq!((more.code, &more.stdout, &more.stderr), (one.code, &one.stdout, &one.stderr));
        }
    }
    for wrong in ["-j 0", "-j x", "--shard 2/2", "--shard 1", "--continue"] {
        place.run(&format!("{CHECK} {wrong}")).check(2, &[]);
    }
}

#[test]
fn check_writes_results_by_shards_that_are_all_of_them_together() {
    let place = place("many_shards");
    place.run(&format!("{CHECK} --out all.out -j 3")).check(1, &["err:checked 100 documents: 33 errors"]);
    let all = lines(&place, "all.out");
    assert_eq!(all.len(), 100);
    let (first, third) = (&all[0], &all[2]);
    assert_eq!((&first["document"], &first["ok"]), (&json!("all.jsonl:1"), &json!(true)));
    // The second line of the file is empty.
    assert_eq!((&third["document"], &third["errors"]), (&json!("all.jsonl:4"), &json!(1)));
    assert!(third["diagnostics"][0]["code"].as_str().is_some_and(|code| code.starts_with("M0")), "{third}");
    let mut merged = vec![Value::Null; 100];
    for shard in 0..3 {
        place.run(&format!("{CHECK} --out {shard}.out --shard {shard}/3"));
        let part = lines(&place, &format!("{shard}.out"));
        part.into_iter().enumerate().for_each(|(index, line)| merged[3 * index + shard] = line);
    }
    assert_eq!(merged, all);
}

#[test]
fn check_continues_a_file_of_results_and_does_nothing_twice() {
    let place = place("many_continue");
    place.run(&format!("{CHECK} --out whole.out"));
    let whole = place.read("whole.out");
    // As of a process that was killed while it wrote the 41st line.
    let torn: String = whole.lines().take(40).map(|line| format!("{line}\n")).collect::<String>() + "{\"docu";
    let place = place.file("torn.out", torn);
    place
        .run(&format!("{CHECK} --out torn.out --continue -j 2"))
        .check(1, &["err:checked 100 documents: 33 errors"]);
    assert_eq!(place.read("torn.out"), whole);
    let again = place.run(&format!("{CHECK} --out torn.out --continue"));
    assert_eq!((again.code, place.read("torn.out")), (Some(1), whole.clone()));
    place.run(&format!("{CHECK} --out torn.out")).check(2, &["err:exists", "err:--continue"]);
    place
        .run("check all.jsonl --no-geometry --out torn.out --continue")
        .check(2, &["err:of other flags", "err:all.jsonl:1"]);
    let place = place.file("all.jsonl", policies(100).replace("p17", "q17"));
    place.run(&format!("{CHECK} --out torn.out --continue")).check(2, &["err:another document"]);
    assert_eq!(place.read("torn.out"), whole);
    let place = place.file("all.jsonl", policies(3)).file("odd.out", "{}\n").file("text.out", "hello\n");
    place.run(&format!("{CHECK} --out torn.out --continue")).check(2, &["err:more lines"]);
    for odd in ["odd.out", "text.out"] {
        place
            .run(&format!("{CHECK} --out {odd} --continue"))
            .check(2, &["err:line 1 of", "err:is no result of this command"]);
    }
    place.run(&format!("{CHECK} --out x.out --fix")).check(2, &["err:give one"]);
}

#[test]
fn run_simulates_a_file_of_policies_the_same_with_any_number_of_threads() {
    let place = Place::new("many_run").file("all.jsonl", policies(9));
    let one = place.run(&format!("{RUN} -j 1"));
    one.check(1, &["err:ran 9 policies: 6 done, 0 not done, 3 refused"]);
    let lines: Vec<Value> = one.stdout.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert_eq!((&lines[0]["policy"], &lines[0]["outcome"]), (&json!("p0"), &json!("done")));
    assert!(lines[0]["at"].as_f64().is_some_and(|at| at > 0.1), "{}", lines[0]);
    assert_eq!((&lines[2]["outcome"], &lines[2]["errors"]), (&json!("refused"), &json!(1)));
    for jobs in [2, 5] {
        let more = place.run(&format!("{RUN} -j {jobs}"));
        assert_eq!((&more.stdout, more.code), (&one.stdout, one.code));
    }
    // Each ends as it does alone.
    let place = place.file("p0.json", policies(1));
    let alone =
        place.run("run p0.json --scene kitchen --no-geometry --profile ideal --speed max --format json");
    let last: Value = serde_json::from_str(alone.stdout.lines().last().unwrap()).unwrap();
    assert_eq!((&last["outcome"], &last["at"]), (&lines[0]["outcome"], &lines[0]["at"]));
    place.run(&format!("{RUN} --out runs.out --shard 0/2"));
    let first = place.read("runs.out");
    assert_eq!(first.lines().count(), 5);
    place.run(&format!("{RUN} --out runs.out --shard 0/2 --continue")).check(1, &["err:ran 5 policies"]);
    assert_eq!(place.read("runs.out"), first);
    for (flags, words) in [("--record kept", "--out"), ("--speed 2", "full speed")] {
        place.run(&format!("{RUN} {flags}")).check(2, &[&format!("err:{words}")]);
    }
    let driven = "run all.jsonl --scene kitchen --driver tcp://127.0.0.1:1";
    place.run(driven).check(2, &["err:full speed"]);
    place.run("run p0.json --scene kitchen --out x.out").check(2, &["err:.jsonl"]);
    place.run("run p0.json --scene kitchen -j 2").check(2, &["err:.jsonl"]);
}

#[test]
fn dataset_is_the_same_with_any_number_of_threads_and_its_shards_have_its_rows() {
    let place = Place::new("many_dataset");
    let make = |out: &str, flags: &str| {
        let line = format!("dataset --out {out} --robot hsr --scenes 4 --cases 2 --no-geometry {flags}");
        let ran = place.run(&line);
        assert_eq!(ran.code, Some(0), "{}", ran.stderr);
        let file = |name: &str| place.read(&format!("{out}/{name}"));
        (file("train.jsonl"), file("test.jsonl"), file("scenes.jsonl"))
    };
    let whole = make("one", "-j 1");
    assert_eq!(make("three", "-j 3"), whole);
    let rows = |(train, test, _): &(String, String, String)| -> (Vec<String>, Vec<String>) {
        let sorted = |text: &str| {
            let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
            lines.sort();
            lines
        };
        (sorted(train), sorted(test))
    };
    let (first, second) = (make("0", "--shard 0/2"), make("1", "--shard 1/2"));
    let both = (first.0 + &second.0, first.1 + &second.1, String::new());
    assert_eq!(rows(&both), rows(&whole));
}

//! `motet dataset`: files of rows made and linted.

use crate::support::Place;

const MAKE: &str = "dataset --robot hsr --room kitchen --scenes 3 --cases 4 --no-geometry --seed 3";

#[test]
fn dataset_is_made_and_passes_lint() {
    let place = Place::new("dataset");
    for form in ["trl", "llamafactory", "qwen-vl", "inteliplan"] {
        place
            .run(&format!("{MAKE} --out {form} --form {form}"))
            .check(0, &["out:train.jsonl: ", "out: in 2 scenes", "out:test.jsonl: "]);
        place
            .run(&format!("dataset lint {form}/train.jsonl {form}/test.jsonl --no-geometry"))
            .check(0, &["err: rows, 0 with findings"]);
    }
    assert!(place.read("llamafactory/dataset_info.json").contains("motet_train"));
    place.run(&format!("{MAKE} --out again")).check(0, &[]);
    for file in ["train.jsonl", "test.jsonl", "scenes.jsonl"] {
        assert_eq!(place.read(&format!("trl/{file}")), place.read(&format!("again/{file}")), "{file}");
    }
    place
        .run("dataset lint trl/train.jsonl --no-geometry --shares")
        .check(0, &["out:construct loop: ", "out:failure not_found: ", "out:recovery not_found: "]);
    // So few rows meet no minimums.
    place.run("dataset lint trl/train.jsonl --no-geometry --minimums").check(1, &["out:, less than 3 %"]);
    // The same rows on both sides are a leak, and duplicates.
    place.run("dataset lint trl/train.jsonl again/train.jsonl --no-geometry").check(
        1,
        &["out:again/train.jsonl:1: duplicate: ", "out:again/train.jsonl:1: leak: its scene `kitchen-"],
    );
}

#[test]
fn dataset_that_was_stopped_is_continued() {
    let place = Place::new("dataset_continued").file("b/train.jsonl/in_the_way", "");
    let making = format!("{MAKE} --images");
    place.run(&format!("{making} --out a")).check(0, &[]);
    assert!(!place.path("a/unfinished.jsonl").exists());
    // All scenes are made, and the rows cannot be written; then all but a line and a half is lost.
    place.run(&format!("{making} --out b")).check(2, &["err:b/train.jsonl"]);
    std::fs::remove_dir_all(place.path("b/train.jsonl")).unwrap();
    let kept = place.read("b/unfinished.jsonl");
    let lines: Vec<&str> = kept.lines().collect();
    assert_eq!(lines.len(), 4, "a head and three scenes");
    let torn = format!("{}\n{}\n{}", lines[0], lines[1], &lines[2][..lines[2].len() / 2]);
    std::fs::write(place.path("b/unfinished.jsonl"), &torn).unwrap();
    for other in [making.clone(), format!("{making} --continue").replace("--seed 3", "--seed 4")] {
        place.run(&format!("{other} --out b")).check(2, &["err:`b` holds a dataset that is not finished"]);
    }
    // What is whole is still there.
    assert!(place.read("b/unfinished.jsonl").starts_with(&kept[..lines[0].len() + 1 + lines[1].len()]));
    place.run(&format!("{making} --out b --continue -j 2")).check(0, &[]);
    for file in ["train.jsonl", "test.jsonl", "scenes.jsonl"] {
        assert_eq!(place.read(&format!("a/{file}")), place.read(&format!("b/{file}")), "{file}");
    }
    let images = |folder: &str| {
        let entries = std::fs::read_dir(place.path(&format!("{folder}/images"))).unwrap();
        let mut all: Vec<_> = entries
            .map(|entry| entry.unwrap())
            .map(|entry| (entry.file_name(), std::fs::read(entry.path()).unwrap()))
            .collect();
        all.sort();
        all
    };
    assert!(!images("a").is_empty() && images("a") == images("b"));
    assert!(!place.path("b/unfinished.jsonl").exists());
}

#[test]
fn images_are_beside_the_rows_and_linted_with_them() {
    let place = Place::new("dataset_images");
    let making = "dataset --robot hsr --room kitchen --scenes 2 --cases 2 --no-geometry --seed 3 --images";
    place.run(&format!("{making} --out d --form qwen-vl")).check(0, &["out:images: ", "out: picture"]);
    let lint = "dataset lint d/train.jsonl --no-geometry";
    place.run(lint).check(0, &["err:, 0 with findings"]);
    let names = place.read("d/train.jsonl");
    let (_, rest) = names.split_once("\"image\":[\"images/").unwrap();
    let (name, _) = rest.split_once('"').unwrap();
    std::fs::rename(place.path(&format!("d/images/{name}")), place.path("d/images/moved.png")).unwrap();
    place
        .run(lint)
        .check(1, &["out:image: its image `images/", "out:d/images/moved.png: image: no row refers to it"]);
    place.run(&format!("{making} --out t --form inteliplan")).check(2, &["err:without images"]);
}

#[test]
fn rows_of_others_are_linted_in_the_room_that_is_given() {
    let policy = "policy p for hsr { go(counter) pick(coke) pick(apple) }";
    let place = Place::new("dataset_lint").file(
        "rows.jsonl",
        format!(
            "\n{{\"prompt\": \"Bring both.\", \"completion\": \"{policy}\"}}\n{{\"text\": \"<user> Go. \
            <robot> go to sink\"}}\n"
        ),
    );
    let lint = "dataset lint rows.jsonl --no-geometry";
    place
        .run(lint)
        .check(1, &["out:rows.jsonl:2: no_world: it does not say for which robot it is: give --robot NAME"]);
    place
        .run(&format!("{lint} --robot hsr --scene kitchen"))
        .check(1, &["out:rows.jsonl:2: cannot_run: ", "out:pick(coke)", "err:2 rows, 1 with findings"]);
    place
        .run(&format!("{lint} --robot hsr --scene kitchen --format json"))
        .check(1, &["out:{\"file\":\"rows.jsonl\",\"row\":2,\"fault\":\"cannot_run\""]);
}

#[test]
fn dataset_reports_unusable_flags_and_files() {
    let place = Place::new("dataset_wrong").file("w.txt", "bring: bring it\n");
    for (line, words) in [
        ("dataset", "--out"),
        ("dataset --out x --wordings w.txt", "line 1: `bring` has no {thing}"),
        ("dataset --out x --test 1", "below 1"),
        ("dataset --out x --robot hs", "did you mean `hsr`?"),
        ("dataset lint gone.jsonl", "cannot read `gone.jsonl`"),
    ] {
        println!("motet {line}");
        place.run(line).check(2, &[&format!("err:{words}")]);
    }
}

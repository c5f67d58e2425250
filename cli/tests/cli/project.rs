//! Folders of policies: `motet new`, and `motet.toml` in the commands that read it.

use crate::support::Place;

#[test]
fn new_makes_a_folder_whose_policy_checks_and_runs() {
    let place = Place::new("project_new");
    for (flags, robot) in [
        ("", "hsr"),
        ("--robot anymal_z1 --scene living_room", "anymal_z1"),
        ("--robot panda --scene lab", "panda"),
        ("--own-robot", "robot"),
    ] {
        let folder = format!("{robot}_home");
        let made = place.run(&format!("new {folder} {flags}"));
        assert_eq!(made.code, Some(0), "{flags}: {made:?}");
        assert!(place.read(&format!("{folder}/motet.toml")).contains(&format!("robot = \"{robot}\"")));
        let checked = place.run(&format!("check {folder}"));
        assert_eq!(checked.code, Some(0), "{flags}: {checked:?}");
        let ran = place.run(&format!("run {folder}/first.motet --speed max --profile ideal"));
        assert_eq!(ran.code, Some(0), "{flags}: {ran:?}");
    }
    let again = place.run("new hsr_home");
    assert_eq!(again.code, Some(2), "{again:?}");
    assert!(again.stderr.contains("is not empty"), "{again:?}");
    let unknown = place.run("new other --robot hrs");
    assert_eq!(unknown.code, Some(2), "{unknown:?}");
    assert!(unknown.stderr.contains("did you mean `hsr`?") && !place.path("other").exists(), "{unknown:?}");
}

#[test]
fn motet_toml_is_read_by_commands_with_a_policy_and_in_the_present_folder() {
    let place =
        Place::new("project_config").file("home/motet.toml", "robot = \"hsr\"\nscene = \"kitchen\"\n").file(
            "home/take.motet",
            "policy take achieves holding(mug_1) {\n    go(mug_1)\n    pick(mug_1)\n}\n",
        );
    for line in [
        "run home/take.motet --speed max --profile ideal",
        "compile home/take.motet",
        "check home/take.motet",
    ] {
        let ran = place.run(line);
        assert_eq!(ran.code, Some(0), "{line}: {ran:?}");
    }
    #[cfg(unix)]
    {
        let motet = env!("CARGO_BIN_EXE_motet");
        let planned = place.shell(&format!("cd home && {motet} plan 'bring me the coke'"));
        assert_eq!(planned.code, Some(0), "{planned:?}");
        let other = place.shell(&format!("cd home && {motet} plan 'bring me the coke' --scene lab"));
        assert_ne!(other.stdout, planned.stdout, "a flag goes before the file");
    }
    let wrong = Place::new("project_config_wrong")
        .file("motet.toml", "robto = \"hsr\"\n")
        .file("a.motet", "policy a { done }\n");
    let ran = wrong.run("run a.motet --speed max");
    assert_eq!(ran.code, Some(2), "{ran:?}");
    assert!(ran.stderr.contains("line 1") && ran.stderr.contains("robto"), "{ran:?}");
}

#[test]
fn scenes_lists_shows_checks_and_draws() {
    let place = Place::new("project_scenes").file(
        "room.json",
        r#"{"motet_scene": 1, "entities": [{"id": "cup", "kind": "Object", "on": "desk"}]}"#,
    );
    for (line, code, text) in [
        ("scenes", 0, "kitchen"),
        ("scenes show kitchen", 0, "mug_1"),
        ("scenes show kitchen", 0, "called \"red mug\""),
        ("scenes check kitchen --robot hsr", 0, "no errors"),
        ("scenes check room.json", 1, "desk"),
        ("scenes show kichten", 2, "did you mean `kitchen`?"),
        ("scenes draw kitchen", 0, "wrote kitchen.svg"),
    ] {
        let ran = place.run(line);
        assert_eq!(ran.code, Some(code), "{line}: {ran:?}");
        assert!(format!("{}{}", ran.stdout, ran.stderr).contains(text), "{line}: {ran:?}");
    }
    assert!(place.says("kitchen.svg", "kitchen_table"));
}

#[test]
fn completions_know_robots_scenes_and_codes() {
    let place = Place::new("project_completions");
    let script = place.run("completions bash").stdout;
    assert!(script.contains("hsr anymal_z1 panda") && script.contains("kitchen living_room lab"));
    assert!(script.contains("M0501") && script.contains("ideal typical harsh"));
}

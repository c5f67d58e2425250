//! Datasets as they are made, written and linted.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing,
    reason = "a test fails by panicking"
)]

use std::collections::BTreeSet;

use motet_dataset::coverage::{Construct, Counts, Subject};
use motet_dataset::format::{self, RowFormat};
use motet_dataset::generate::{self, Dataset, HeldOut, Order};
use motet_dataset::lint::{Finding, ImageCheck, Linter, RowFault, Worlds, family};
use motet_dataset::picture::{self, Pictures};
use motet_dataset::{Body, Row, lesson, scenery, wordings};
use motet_geometry::planning::SearchBudget;
use motet_robots::builtin::{self, RobotWithBody};
use motet_robots::scene;
use serde_json::{Value, json};

const FORMS: [RowFormat; 4] =
    [RowFormat::Trl, RowFormat::LlamaFactory, RowFormat::QwenVl, RowFormat::InteLiPlan];

fn body(name: &str) -> Body {
    let RobotWithBody { robot, urdf } = builtin::robot(name).unwrap();
    Body { robot, urdf: Some(urdf) }
}

fn scene(name: &str) -> scene::Scene {
    builtin::scene(name).unwrap()
}

fn order(form: RowFormat) -> Order {
    Order {
        seed: 5,
        bodies: vec![body("hsr"), body("anymal_z1")],
        bases: ["kitchen", "living_room"].map(|name| (name.into(), scene(name))).to_vec(),
        things: scenery::things(),
        wordings: wordings::read(wordings::OWN).unwrap(),
        held_out: HeldOut::own(),
        lessons: lesson::read(lesson::OWN).unwrap(),
        scenes: 2,
        cases: 3,
        test: 0.3,
        effort: None,
        form,
        pictures: Pictures::None,
    }
}

fn made(order: &Order) -> Dataset {
    let part = |number| (number, generate::part(order, number));
    generate::gather(order, (0..order.scenes).map(part).collect())
}

fn worlds(dataset: &Dataset, effort: Option<SearchBudget>) -> Worlds {
    Worlds {
        bodies: ["hsr", "anymal_z1"].map(|name| (name.into(), body(name))).into_iter().collect(),
        scenes: dataset.scenes.clone(),
        postures: dataset.postures.clone(),
        effort,
        ..Worlds::default()
    }
}

fn linted(worlds: &Worlds, files: &[(&str, Vec<String>)]) -> Vec<Finding> {
    let mut linter = Linter::new(worlds);
    let mut found = Vec::new();
    for (file, lines) in files {
        for (index, line) in lines.iter().enumerate() {
            found.extend(linter.line(file, index + 1, line));
        }
    }
    found
}

fn lines(rows: &[Row], form: RowFormat) -> Vec<String> {
    rows.iter().map(|row| format::write(row, form)).collect()
}

#[test]
fn dataset_rows_pass_lint_in_every_form() {
    for form in FORMS {
        let order = match form {
            RowFormat::Trl | RowFormat::InteLiPlan => order(form),
            RowFormat::LlamaFactory | RowFormat::QwenVl => Order { bodies: vec![body("hsr")], ..order(form) },
        };
        let dataset = made(&order);
        let rows = dataset.train.len() + dataset.test.len();
        assert!(rows >= 3 && !dataset.test.is_empty(), "{form:?}: {rows}, {:?}", dataset.dropped);
        let files = [("train", lines(&dataset.train, form)), ("test", lines(&dataset.test, form))];
        assert_eq!(linted(&worlds(&dataset, None), &files), [], "{form:?}");
    }
}

#[test]
fn dataset_motions_are_verified_too() {
    let order = Order {
        bodies: vec![body("hsr")],
        scenes: 2,
        cases: 3,
        effort: Some(SearchBudget::default()),
        ..order(RowFormat::Trl)
    };
    let dataset = made(&order);
    assert!(dataset.train.len() >= 2, "{:?}", dataset.dropped);
    let files =
        [("train", lines(&dataset.train, RowFormat::Trl)), ("test", lines(&dataset.test, RowFormat::Trl))];
    assert_eq!(linted(&worlds(&dataset, order.effort), &files), []);
}

#[test]
fn dataset_seed_gives_the_same_rows_and_another_seed_others() {
    let one = Order { bodies: vec![body("hsr")], scenes: 2, cases: 2, ..order(RowFormat::Trl) };
    let (first, second) = (made(&one), made(&one));
    assert_eq!((&first.train, &first.test), (&second.train, &second.test));
    let other = made(&Order { seed: 6, ..one });
    assert_ne!(first.train, other.train);
}

#[test]
fn dataset_scenes_are_on_one_side_and_what_happens_varies() {
    let dataset = made(&Order { scenes: 6, cases: 8, ..order(RowFormat::Trl) });
    let scenes = |rows: &[Row]| -> BTreeSet<String> {
        rows.iter().map(|row| family(&row.about.scene).to_owned()).collect()
    };
    let (train, test) = (scenes(&dataset.train), scenes(&dataset.test));
    assert!(train.is_disjoint(&test), "{train:?} {test:?}");
    assert_eq!((train.len(), test.len()), (4, 2));
    let all: Vec<&Row> = dataset.train.iter().chain(&dataset.test).collect();
    let tasks: BTreeSet<_> = all.iter().map(|row| row.about.task.clone()).collect();
    let failures: BTreeSet<_> = all.iter().flat_map(|row| &row.about.failures).collect();
    let requests: BTreeSet<_> = all.iter().map(|row| row.request.as_str()).collect();
    assert!(tasks.len() >= 6 && failures.len() == 5, "{tasks:?} {failures:?}");
    assert!(requests.len() * 2 > all.len(), "{} of {}", requests.len(), all.len());
    assert!(all.iter().any(|row| row.about.turn > 0 && row.policy.contains("\"do\":\"pick\"")), "recoveries");
    assert!(all.iter().any(|row| row.policy.contains("\"do\":\"ask\"")), "questions");
}

#[test]
fn dataset_lessons_changes_and_heights_are_in_the_rows() {
    let order =
        Order { scenes: 8, cases: 12, effort: Some(SearchBudget::default()), ..order(RowFormat::Trl) };
    let dataset = made(&order);
    let all: Vec<&Row> = dataset.train.iter().chain(&dataset.test).collect();
    let tasks: BTreeSet<&str> = all.iter().map(|row| row.about.task.as_str()).collect();
    let taught = order.lessons.iter().filter(|lesson| tasks.contains(lesson.name.as_str())).count();
    assert!(taught > 15 && tasks.contains(format::UPDATE), "{tasks:?} {:?}", dataset.dropped);
    // Out of reach by geometry, in a person's words.
    assert!(all.iter().any(|row| row.policy.contains("I reach")), "heights");
    assert!(all.iter().all(|row| !order.held_out.has(&row.request)));
}

#[test]
fn dataset_held_out_instruction_is_in_no_row() {
    let order = Order { lessons: Vec::new(), ..order(RowFormat::Trl) };
    let requests: Vec<String> = made(&order).train.into_iter().map(|row| row.request).collect();
    let one = requests.first().unwrap().to_uppercase();
    let held_out: HeldOut = [one.as_str()].into_iter().collect();
    let dataset = made(&Order { held_out, ..order });
    let left: Vec<&Row> = dataset.train.iter().chain(&dataset.test).collect();
    assert!(!left.is_empty() && left.iter().all(|row| row.request.to_uppercase() != one), "{one}");
}

#[test]
fn dataset_rows_have_the_shapes_that_trainers_read() {
    let dataset = made(&Order { scenes: 2, cases: 3, ..order(RowFormat::Trl) });
    let row = &dataset.train[0];
    let of = |form| -> Value { serde_json::from_str(&format::write(row, form)).unwrap() };
    let trl = of(RowFormat::Trl);
    let roles: Vec<&str> =
        trl["messages"].as_array().unwrap().iter().map(|one| one["role"].as_str().unwrap()).collect();
    assert_eq!(roles, ["system", "user", "assistant"]);
    let llama = of(RowFormat::LlamaFactory);
    assert_eq!(llama["conversations"][0]["from"], "human");
    assert_eq!(llama["conversations"][1]["from"], "gpt");
    assert_eq!(llama["system"], trl["messages"][0]["content"]);
    let qwen = of(RowFormat::QwenVl);
    assert_eq!(qwen["conversations"].as_array().unwrap().len(), 2);
    assert!(qwen["conversations"][0]["value"].as_str().unwrap().starts_with(&row.system));
    let text = of(RowFormat::InteLiPlan)["text"].as_str().unwrap().to_owned();
    assert!(text.contains("<user> ") && text.contains("<robot> "), "{text}");
    let info: Value = serde_json::from_str(&format::dataset_info(&["train"], Pictures::None)).unwrap();
    assert_eq!(info["motet_train"]["formatting"], "sharegpt");
    for form in FORMS {
        let read = format::read(&format::write(row, form)).unwrap();
        assert_eq!(read.robot.as_deref(), Some(row.about.robot.as_str()));
        assert_eq!(read.scene.as_deref(), Some(row.about.scene.as_str()));
    }
}

/// A row in TRL's form for the HSR in the kitchen.
fn wrong_row(request: &str, policy: &str) -> String {
    json!({
        "messages": [{"role": "user", "content": request}, {"role": "assistant", "content": policy}],
        "motet": {"robot": "hsr", "scene": "kitchen"},
    })
    .to_string()
}

#[test]
fn dataset_rows_that_are_wrong_are_found_each_in_its_way() {
    let mut worlds = worlds(&Dataset::default(), None);
    worlds.scenes.insert("kitchen".into(), scene("kitchen"));
    let fetch = "policy p for hsr { go(counter) pick(coke) }";
    let say = "policy p for hsr { say(\"hello\") }";
    for (name, rows, fault, row, words) in [
        ("not JSON", vec!["{".to_owned()], RowFault::Unreadable, 1, "it is not JSON"),
        ("no row", vec!["{\"a\": 1}".to_owned()], RowFault::Unreadable, 1, "none of `messages`"),
        (
            "the wrong turn",
            vec![json!({"messages": [{"role": "assistant", "content": "x"}]}).to_string()],
            RowFault::Unreadable,
            1,
            "`user`'s turn",
        ),
        (
            "no answer",
            vec![json!({"conversations": [{"from": "human", "value": "x"}]}).to_string()],
            RowFault::Unreadable,
            1,
            "last message is not of `gpt`",
        ),
        (
            "no world",
            vec![json!({"prompt": "Say hello.", "completion": say}).to_string()],
            RowFault::NoWorld,
            1,
            "give --robot",
        ),
        (
            "an unknown scene",
            vec![wrong_row("a", say).replace("kitchen", "cellar")],
            RowFault::NoWorld,
            1,
            "no scene `cellar`",
        ),
        (
            "a misspelt step",
            vec![wrong_row("a", "policy p for hsr { goo(counter) }")],
            RowFault::CannotRun,
            1,
            "goo",
        ),
        (
            "a refuted step",
            vec![wrong_row("a", "policy p for hsr { pick(coke) pick(apple) }")],
            RowFault::CannotRun,
            1,
            "needs",
        ),
        (
            "a step that fails",
            vec![wrong_row("a", "policy p for hsr { let x = detect(\"teddy\") }")],
            RowFault::CannotRun,
            1,
            "not_found",
        ),
        (
            "a new plan",
            vec![wrong_row("a", "policy p for hsr { replan \"no\" }")],
            RowFault::CannotRun,
            1,
            "another plan",
        ),
        ("prose", vec![wrong_row("a", "I cannot do that.")], RowFault::CannotRun, 1, ""),
        (
            "a contract of its own",
            vec![wrong_row("a", "action fly() policy p for hsr { fly() }")],
            RowFault::CannotRun,
            1,
            "beside its policy",
        ),
        (
            "the same twice",
            vec![wrong_row("Fetch the coke.", fetch), wrong_row("fetch  the coke", fetch)],
            RowFault::Duplicate,
            2,
            "the same answer",
        ),
        (
            "two answers",
            vec![wrong_row("Fetch the coke.", fetch), wrong_row("Fetch the coke.", say)],
            RowFault::Contradiction,
            2,
            "another answer",
        ),
        (
            "an action that the robot lacks",
            vec![
                json!({
                    "text": "<user> Fly. <robot> go to counter, fly home",
                    "motet": {"robot": "hsr", "scene": "kitchen"},
                })
                .to_string(),
            ],
            RowFault::CannotRun,
            1,
            "action 2",
        ),
    ] {
        let found = linted(&worlds, &[("rows", rows)]);
        assert_eq!(found.len(), 1, "{name}: {found:?}");
        assert_eq!((found[0].fault, found[0].at.row), (fault, row), "{name}: {found:?}");
        assert!(found[0].message.contains(words), "{name}: {found:?}");
    }
    let ask = "policy p for hsr { let answer = ask(\"Which one?\") replan answer }";
    assert_eq!(linted(&worlds, &[("rows", vec![wrong_row("a", ask), wrong_row("b", fetch)])]), []);
}

#[test]
fn dataset_room_in_two_files_is_found_once() {
    let mut worlds = worlds(&Dataset::default(), None);
    for name in ["kitchen-1", "kitchen-1.2", "kitchen-2"] {
        worlds.scenes.insert(name.into(), scene("kitchen"));
    }
    let row = |request: &str, scene: &str| {
        wrong_row(request, "policy p for hsr { go(counter) }").replace("\"kitchen\"", &format!("\"{scene}\""))
    };
    let train = vec![row("a", "kitchen-1")];
    let test = vec![row("b", "kitchen-2"), row("c", "kitchen-1.2"), row("d", "kitchen-1")];
    let found = linted(&worlds, &[("train", train), ("test", test)]);
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!((found[0].fault, found[0].at.row), (RowFault::Leak, 2));
    assert_eq!(found[0].other.as_ref().map(|other| other.file.as_str()), Some("train"));
}

/// Pictures in memory.
struct Kept<'d>(&'d Dataset);

impl ImageCheck for Kept<'_> {
    fn fault(&mut self, _file: &str, path: &str) -> Option<String> {
        self.0.pictures.get(path).map_or_else(|| Some("missing".to_owned()), |bytes| picture::fault(bytes))
    }
}

#[test]
fn dataset_pictures_go_with_rows_in_every_form_that_has_them() {
    for (form, column) in
        [(RowFormat::Trl, "images"), (RowFormat::LlamaFactory, "images"), (RowFormat::QwenVl, "image")]
    {
        let order = Order { pictures: Pictures::EachRow, bodies: vec![body("hsr")], ..order(form) };
        let dataset = made(&order);
        let rows: Vec<&Row> = dataset.train.iter().chain(&dataset.test).collect();
        let shown: BTreeSet<_> = rows.iter().flat_map(|row| row.images.clone()).collect();
        assert!(rows.iter().all(|row| !row.images.is_empty()), "{form:?}");
        assert!(rows.iter().any(|row| row.images.len() == 2), "{form:?}: the room and a thing");
        assert!(shown.iter().eq(dataset.pictures.keys()), "{form:?}: each is kept, and no other");
        let line: Value = serde_json::from_str(&format::write(rows[0], form)).unwrap();
        assert_eq!(line[column], json!(rows[0].images));
        let worlds = worlds(&dataset, None);
        let mut kept = Kept(&dataset);
        let mut linter = Linter::new(&worlds).with_images(&mut kept);
        for (number, line) in lines(&dataset.train, form).iter().enumerate() {
            assert_eq!(linter.line("train", number + 1, line), [], "{form:?}");
        }
        // The form has no part in what the camera sees.
        if form == RowFormat::Trl {
            assert_eq!(dataset.pictures, made(&order).pictures);
        }
    }
    let info: Value = serde_json::from_str(&format::dataset_info(&["train"], Pictures::EachRow)).unwrap();
    assert_eq!(info["motet_train"]["columns"]["images"], "images");
}

#[test]
fn dataset_pictures_that_are_wrong_are_found() {
    let mut worlds = worlds(&Dataset::default(), None);
    worlds.scenes.insert("kitchen".into(), scene("kitchen"));
    let dataset = Dataset {
        pictures: [
            ("images/good.gif".into(), b"GIF89a".as_slice().into()),
            ("images/half.png".into(), b"\x89PNG\r\n\x1a\nand no more".as_slice().into()),
            ("images/text.png".into(), b"no picture".as_slice().into()),
        ]
        .into(),
        ..Dataset::default()
    };
    let row = |content: Value, images: Value| {
        let policy = "policy p for hsr { say(\"hello\") }";
        json!({"conversations": [{"from": "human", "value": content}, {"from": "gpt", "value": policy}],
            "images": images, "motet": {"robot": "hsr", "scene": "kitchen"}})
        .to_string()
    };
    for (images, content, words) in [
        (json!(["images/gone.png"]), "<image>a", "missing"),
        (json!(["images/half.png"]), "<image>b", "no whole PNG"),
        (json!(["images/text.png"]), "<image>c", "no PNG, JPEG, WebP or GIF"),
        (json!(["images/good.gif"]), "d", "1 images and 0 places"),
        (json!([]), "<image>e", "0 images and 1 places"),
        (json!(["images/good.gif"]), "<image>f", ""),
    ] {
        let mut kept = Kept(&dataset);
        let mut linter = Linter::new(&worlds).with_images(&mut kept);
        let found = linter.line("rows", 1, &row(content.into(), images));
        let expected = usize::from(!words.is_empty());
        assert_eq!(found.len(), expected, "{content}: {found:?}");
        assert!(
            found.iter().all(|one| one.fault == RowFault::Image && one.message.contains(words)),
            "{found:?}"
        );
    }
}

/// Shares above 0 of one row with a policy, as `group name`.
fn shares_of(policy: &str, failures: &str, turn: &str) -> Vec<String> {
    let about = json!({"robot": "hsr", "scene": "kitchen", "failures": failures, "turn": turn});
    let row = json!({"prompt": "Do it.", "completion": policy, "motet": about});
    let mut counts = Counts::default();
    counts.add(&format::read(&row.to_string()).unwrap());
    let shares = counts.shares();
    let is_used = shares.iter().filter(|share| share.rows > 0);
    is_used.map(|share| format!("{} {}", share.subject.group(), share.subject.name())).collect()
}

#[test]
fn shares_find_each_construct_also_inside_others() {
    let inside = [
        ("if near(user) { home() }", vec![Construct::Condition]),
        ("repeat 2 { wait 5 s }", vec![Construct::Loop, Construct::Wait]),
        ("each x in things at most 3 { home() }", vec![Construct::Loop]),
        ("try { home() } catch any { say(\"No.\") }", vec![Construct::Handler, Construct::Say]),
        ("sequence a { home() } finally { home() }", vec![Construct::Cleanup]),
        ("within 9 s { home() }", vec![Construct::Deadline]),
        ("home() within 9 s", vec![Construct::Deadline]),
        (
            "parallel { { home() } { let m = detect(\"mug\") } }",
            vec![Construct::Parallel, Construct::Binding],
        ),
        ("keep out of stairs { home() }", vec![Construct::Keep]),
        ("let a = ask(\"Which?\") replan a", vec![Construct::Binding, Construct::Ask, Construct::Replan]),
        ("cannot \"No.\"", vec![Construct::Cannot]),
        (
            "monitor { when near(user) then replan \"Why?\" } during { home() }",
            vec![Construct::Monitor, Construct::Replan],
        ),
    ];
    for (steps, constructs) in inside {
        let wanted: Vec<String> =
            constructs.iter().map(|construct| format!("construct {}", construct.name())).collect();
        assert_eq!(shares_of(&format!("policy p for hsr {{ {steps} }}"), "", "0"), wanted, "{steps}");
    }
}

#[test]
fn shares_count_a_recovery_right_after_its_failure() {
    let of = |turn: &str| shares_of("policy p for hsr { home() }", "not_found,action_failed", turn);
    let failures = ["failure not_found", "failure action_failed"];
    assert_eq!(of("0"), failures);
    assert_eq!(of("1"), [&failures[..], &["recovery not_found"]].concat());
    assert_eq!(of("2"), [&failures[..], &["recovery action_failed"]].concat());
    assert_eq!(of("3"), failures);
}

#[test]
fn shares_are_of_the_rows_that_can_have_them() {
    let mut counts = Counts::default();
    assert!(counts.shares().iter().all(|share| share.ratio() == 0.0 && !share.is_low()));
    counts.add(&format::read(r#"{"text": "<user> Go. <robot> go to sink"}"#).unwrap());
    // A list of actions has no constructs.
    assert!(!counts.shares().iter().any(|share| matches!(share.subject, Subject::Construct(_))));
    let row = json!({"prompt": "Go.", "completion": "policy p { if near(user) { home() } }"});
    counts.add(&format::read(&row.to_string()).unwrap());
    let low = |construct| {
        let shares = counts.shares();
        let share = shares.iter().find(|share| share.subject == Subject::Construct(construct)).unwrap();
        (share.rows, share.of, share.is_low())
    };
    assert_eq!((low(Construct::Condition), low(Construct::Loop)), ((1, 1, false), (0, 1, true)));
}

//! Tasks of the papers: the file in the repository, and a few trials.

use motet_dataset::generate::HeldOut;
use motet_eval::bench::Bench;
use motet_eval::dynamic;
use motet_eval::planners::PlannerKind;
use motet_eval::tasks;

const PAPERS: &str = include_str!("../../tasks/papers.jsonl");

fn lines(text: &str) -> Vec<(usize, &str)> {
    text.lines().enumerate().map(|(index, line)| (index + 1, line)).collect()
}

#[test]
fn tasks_of_the_papers_are_carried_out() {
    let tasks = tasks::read(&lines(PAPERS)).unwrap();
    let trials = tasks::trials(&Bench::ideal(), &tasks[..3], 1).unwrap();
    assert_eq!(trials.len(), 6);
    for trial in &trials {
        assert!(trial.is_planned && trial.is_reached && trial.faults.is_empty(), "{trial:#?}");
    }
    let table = tasks::table(&Bench::ideal(), &trials).join("\n");
    assert!(table.contains("0 dropped, 0 doubled, 0 orphaned"), "{table}");
}

#[test]
fn tasks_baseline_that_plans_once_does_not_recover() {
    let tasks = tasks::read(&lines(PAPERS)).unwrap();
    let hidden: Vec<_> = tasks.into_iter().filter(tasks::Task::has_failures).take(1).collect();
    let recovered = |planner| {
        let bench = Bench { planner, ..Bench::ideal() };
        let trials = tasks::trials(&bench, &hidden, 1).unwrap();
        trials.iter().filter(|trial| trial.is_reached).count()
    };
    assert_eq!((recovered(PlannerKind::Builtin), recovered(PlannerKind::OneShot)), (2, 0));
}

#[test]
fn tasks_few_shot_baseline_runs_on_replies_in_a_file() {
    let tasks = tasks::read(&lines(PAPERS)).unwrap();
    let wanted = tasks::read(&lines(PAPERS)).unwrap().len();
    let fridge: Vec<_> = tasks.into_iter().skip(11).take(1).collect();
    let reply = |steps: &str| {
        format!(
            r#"{{"request": "Open the fridge.", "policy": {{"motet": 1, "policy": "p", "steps": {steps}}}}}"#
        )
    };
    let right = reply(r#"[{"do": "go", "to": "fridge_1"}, {"do": "open", "what": "fridge_1"}]"#);
    // The check refuses it, and few-shot prompting asks once.
    let wrong = reply(r#"[{"do": "fly"}]"#);
    let reached = |name: &str, text: &str| {
        let file = format!("{}/{name}", env!("CARGO_TARGET_TMPDIR"));
        std::fs::write(&file, text).unwrap();
        let planner = PlannerKind::read(&format!("few-shot:file:{file}"), None).unwrap();
        let trials = tasks::trials(&Bench { planner, ..Bench::ideal() }, &fridge, 1).unwrap();
        trials.iter().filter(|trial| trial.robot == "hsr" && trial.is_reached).count()
    };
    assert!(wanted > 11);
    assert_eq!((reached("right.jsonl", &right), reached("wrong.jsonl", &wrong)), (1, 0));
    let unknown = PlannerKind::read("few-shots", None).unwrap_err();
    assert!(unknown.contains("`few-shots`") && unknown.contains("few-shot:"), "{unknown}");
}

#[test]
fn tasks_that_are_wrong_are_told_with_their_line() {
    let row =
        |more: &str| format!(r#"{{"table": "t", "cell": "c", "scene": "kitchen", "request": "go", {more}}}"#);
    let said = |text: &str| tasks::read(&[(7, text)]).unwrap_err();
    assert!(said("{").starts_with("7: "));
    assert!(said(&row(r#""goal": ["on mug"]"#)).contains("7: `on mug` is no fact"));
    assert!(said(&row(r#""goal": [], "failures": ["lost"]"#)).contains("no failure `lost`"));
    assert!(said(&row(r#""goal": [], "gaol": []"#)).contains("unknown field `gaol`"));
}

#[test]
fn tasks_and_wordings_of_evaluations_are_no_data_for_training() {
    let held_out = HeldOut::own();
    let requests = tasks::read(&lines(PAPERS)).unwrap();
    let mut missing: Vec<String> =
        requests.iter().map(|task| task.request().to_owned()).filter(|one| !held_out.has(one)).collect();
    let changes = dynamic::instructions().map(str::to_owned);
    missing.extend(changes.filter(|one| !held_out.has(one)));
    assert!(missing.is_empty(), "not in runtime/dataset/data/held_out.txt: {missing:#?}");
    // `seen.txt` has what a model has seen; the other wordings are those that it has not.
    let unseen = [
        include_str!("../../wordings/unseen.txt"),
        include_str!("../../wordings/unseen2.txt"),
        include_str!("../../wordings/outside1.txt"),
        include_str!("../../wordings/outside2.txt"),
        include_str!("../../wordings/outside3.txt"),
        include_str!("../../wordings/outside4.txt"),
        include_str!("../../wordings/outside5.txt"),
    ];
    let wording = |line: &'static str| line.split_once(':').map(|(_, wording)| wording);
    let unseen: HeldOut = unseen.iter().flat_map(|text| text.lines()).filter_map(wording).collect();
    let own = motet_dataset::wordings::read(motet_dataset::wordings::OWN).unwrap();
    let lessons = motet_dataset::lesson::read(motet_dataset::lesson::OWN).unwrap();
    let own = own.requests.into_iter().map(|(_, wording)| wording).chain(own.vague).chain(own.instead);
    let both: Vec<String> = own
        .chain(lessons.into_iter().flat_map(|lesson| lesson.wordings))
        .filter(|wording| unseen.has(wording))
        .collect();
    assert!(both.is_empty(), "wordings of evaluations in the data: {both:#?}");
}

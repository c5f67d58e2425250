//! Tasks of the papers: the file in the repository, and a few trials.

use motet_eval::bench::Bench;
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
fn tasks_that_are_wrong_are_told_with_their_line() {
    let row =
        |more: &str| format!(r#"{{"table": "t", "cell": "c", "scene": "kitchen", "request": "go", {more}}}"#);
    let said = |text: &str| tasks::read(&[(7, text)]).unwrap_err();
    assert!(said("{").starts_with("7: "));
    assert!(said(&row(r#""goal": ["on mug"]"#)).contains("7: `on mug` is no fact"));
    assert!(said(&row(r#""goal": [], "failures": ["lost"]"#)).contains("no failure `lost`"));
    assert!(said(&row(r#""goal": [], "gaol": []"#)).contains("unknown field `gaol`"));
}

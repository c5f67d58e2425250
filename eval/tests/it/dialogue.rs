//! The cases that a file of wordings becomes.

use std::collections::BTreeSet;
use std::path::Path;

use motet_eval::bench::{Bench, DriverKind};
use motet_eval::dialogue::{self, Objects, UNSEEN};
use motet_planner::dialogue::Kind;

/// Of the cases of twenty equal wordings and some lines behind them: what is asked for, and what is answered
/// to questions of each kind.
fn said(lines: &str) -> (BTreeSet<String>, BTreeSet<(Kind, String)>) {
    let cases = dialogue::cases(&format!("{}{lines}", "bring: Fetch {thing}.\n".repeat(20)), Objects::Seen);
    let requests = cases.iter().map(|case| case.request.clone()).collect();
    (requests, cases.iter().flat_map(dialogue::Case::answers).collect())
}

#[test]
fn dialogue_cases_take_answers_from_the_file() {
    let (requests, answers) =
        said("vague: About {thing}!\nwhere: Look, {at}!\nagain: Anew!\nyes: Oh yes!\nyes: Go!\n");
    assert!(requests.contains("About the coke can!"), "{requests:?}");
    assert!(requests.iter().all(|request| request.starts_with("Fetch") || request.starts_with("About")));
    assert!(answers.contains(&(Kind::NotFound, "Look, in the fridge!".to_owned())), "{answers:?}");
    let of =
        |kind: Kind| answers.iter().filter(move |(known, _)| *known == kind).map(|(_, said)| said.as_str());
    assert_eq!(of(Kind::NotReachable).collect::<Vec<_>>(), ["Anew!"]);
    assert_eq!(of(Kind::ActionFailed).collect::<Vec<_>>(), ["Go!", "Oh yes!"]);
    assert!(of(Kind::NotFound).all(|said| said.starts_with("Look, ")));
}

#[test]
fn dialogue_cases_have_default_answers() {
    let (requests, answers) = said("");
    assert!(requests.contains("Do something about the coke can."), "{requests:?}");
    let of = |kind: Kind| answers.iter().filter(move |(known, _)| *known == kind).count();
    assert!(of(Kind::NotFound) > 1 && of(Kind::NotReachable) > 1 && of(Kind::ActionFailed) > 1);
}

#[test]
fn dialogue_unseen_objects_are_in_no_list_scene_or_dataset() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut texts = Vec::new();
    for folder in ["runtime/requests/english", "runtime/dataset/data", "robots/scenes", "eval/tasks"] {
        for file in std::fs::read_dir(root.join(folder)).unwrap() {
            texts.push(std::fs::read_to_string(file.unwrap().path()).unwrap().to_lowercase());
        }
    }
    let words = |text: &str| -> Vec<String> {
        let parts = text.split(|letter: char| !letter.is_alphanumeric() && letter != '-');
        parts.filter(|word| !word.is_empty()).map(str::to_owned).collect()
    };
    let texts: Vec<Vec<String>> = texts.iter().map(|text| words(text)).collect();
    for (name, ..) in UNSEEN {
        let name = words(name);
        assert!(!texts.iter().any(|text| text.windows(name.len()).any(|at| at == name)), "{name:?}");
    }
}

#[test]
fn dialogue_with_unseen_objects_reaches_its_goals() {
    let wordings = "bring: Bring me {thing}.\nput: Put {thing} on {place}.\n".repeat(10);
    let cases = dialogue::cases(&wordings, Objects::Unseen);
    for (name, ..) in UNSEEN {
        assert!(cases.iter().any(|case| case.request.contains(&format!("the {name}"))), "{name}");
    }
    let bench = Bench { every: 7, ..Bench::new("ideal", DriverKind::Kinematic).unwrap() };
    let trials = dialogue::trials(&bench, &wordings, Objects::Unseen).unwrap();
    let notes: Vec<_> = trials.iter().filter_map(|trial| trial.note.clone()).collect();
    assert!(trials.len() > 15 && notes.is_empty(), "{} trials: {notes:?}", trials.len());
}

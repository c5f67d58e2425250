//! The cases that a file of wordings becomes.

use std::collections::BTreeSet;

use motet_eval::dialogue;
use motet_planner::dialogue::Kind;

/// Of the cases of twenty equal wordings and some lines behind them: what is asked for, and what is answered
/// to questions of each kind.
fn said(lines: &str) -> (BTreeSet<String>, BTreeSet<(Kind, String)>) {
    let cases = dialogue::cases(&format!("{}{lines}", "bring: Fetch {thing}.\n".repeat(20)));
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

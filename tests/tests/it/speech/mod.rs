//! How people speak: what is said around a request is passed over, and what only sounds like one is not
//! taken for it.
mod answers;
mod asked;
mod courtesy;
mod places;
mod wishes;

use motet_requests::{RequestContext, RequestError};
use motet_syntax::print;
use motet_tests::setup;

fn goals(request: &str) -> Result<Vec<String>, RequestError> {
    let scene = setup::scene("kitchen");
    let understood = motet_requests::understand(request, &RequestContext::new(&scene))?;
    Ok(understood.aims.iter().map(|aim| print::expression(&aim.goal.condition)).collect())
}

/// Each request comes to these goals.
#[track_caller]
fn mean(wanted: &[&str], requests: &[&str]) {
    let wrong: Vec<_> = requests
        .iter()
        .filter_map(|request| match goals(request) {
            Ok(found) if found == wanted => None,
            found => Some(format!("{request}: {found:?}")),
        })
        .collect();
    assert!(wrong.is_empty(), "not {wanted:?}:\n{}", wrong.join("\n"));
}

/// None of them is taken for a request that is understood.
#[track_caller]
fn not_taken(requests: &[&str]) {
    let taken: Vec<_> = requests
        .iter()
        .filter_map(|request| {
            Some(format!("{request}: {:?}", goals(request).ok().filter(|aims| !aims.is_empty())?))
        })
        .collect();
    assert!(taken.is_empty(), "{}", taken.join("\n"));
}

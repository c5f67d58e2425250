//! A refutation tells which fact, needed by which step, made false by which, and on which way.

use motet_eval::check_in_domain;
use motet_syntax::{FileId, Severity, Source, Sources, read};
use motet_tests::setup;

const DOMAIN: &str = "
closed world
fluent wet()
fluent lit()
action rain() makes wet() fails blocked
action light() needs not wet() makes lit() fails blocked
action dry() makes not wet()
";

/// The first error of a policy.
fn story(body: &str) -> String {
    let (said, _) = check_in_domain(DOMAIN, &format!("policy p {{\n{body}\n}}\n"));
    let error = said.into_iter().find(|said| said.severity == Severity::Error);
    error.map(|error| error.message).unwrap_or_default()
}

#[test]
fn explanation_story_tells_the_way() {
    let told = [
        ("rain() light()", "which `rain()` made false"),
        ("if lit() { rain() } light()", ""),
        ("if battery() > 50 % { rain() } light()", "which `rain()` made false where `battery() > 0.5` holds"),
        (
            "if battery() > 50 % { dry() } else { rain() } light()",
            "which `rain()` made false where `battery() > 0.5` does not hold",
        ),
        ("repeat 2 { light() rain() }", "which `rain()` made false in an earlier round"),
        ("try { light() } catch blocked { rain() } light()", "which `rain()` made false after a failure"),
        (
            "monitor when battery() < 20 % for 1 s then resume at most 1 { rain() } during { light() }",
            "which `rain()` made false when its monitor fires",
        ),
        ("if wet() { light() }", ""),
    ];
    for (body, expected) in told {
        let found = story(body);
        if expected.is_empty() {
            assert_eq!(found, "", "{body}");
        } else {
            assert_eq!(found, format!("`light` needs `not wet()`, {expected}"), "{body}");
        }
    }
}

/// A fact that a cleanup would have made true again is told with the cleanup.
#[test]
fn explanation_story_names_the_cleanup() {
    let (robot, scene) = (setup::robot("anymal_z1"), setup::scene("kitchen"));
    let (session, _) = setup::session(Some(&robot), Some(&scene), &mut Sources::default());
    for (cleanup, way) in [
        ("home()", "where `home()` in the `finally` fails"),
        ("if free(hand) { home() }", "where `home()` in the `finally` does not run"),
    ] {
        let text = format!(
            "policy p for anymal_z1 {{ wake_up() go(shelf) sequence look {{ start_pose() inspect(shelf) }} \
             finally {{ {cleanup} }} go(user) }}"
        );
        let found = session.check(&read(&Source::new("p.motet", text.as_str()), FileId(9)));
        let errors: Vec<_> = found.into_iter().filter(|said| said.severity == Severity::Error).collect();
        let story = format!(
            "`go` needs `arm_home(robot) or arm_carry(robot)`, which `start_pose()` made false {way}"
        );
        assert!(errors.iter().any(|said| said.message == story), "{errors:#?}");
    }
}

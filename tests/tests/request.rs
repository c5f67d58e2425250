//! Requests in words and what they are taken to mean, in scenes that come with the robots.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test fails by panicking")]

use motet_planner::request::{self, Puzzle, Situation};
use motet_syntax::print;
use motet_tests::setup;

/// The goals, in order, as text.
#[track_caller]
fn means(scene: &str, request: &str, goals: &[&str]) {
    let scene = setup::scene(scene);
    let understood = request::understand(request, &Situation::new(&scene))
        .unwrap_or_else(|why| panic!("{request}: {why}"));
    let found: Vec<_> = understood.aims.iter().map(|aim| print::expression(&aim.goal.condition)).collect();
    assert_eq!(found, goals, "{request}");
}

#[track_caller]
fn puzzles(scene: &str, request: &str) -> Puzzle {
    let scene = setup::scene(scene);
    match request::understand(request, &Situation::new(&scene)) {
        Err(puzzle) => puzzle,
        Ok(understood) => {
            let found: Vec<_> =
                understood.aims.iter().map(|aim| print::expression(&aim.goal.condition)).collect();
            panic!("{request}: taken to mean {found:?}")
        }
    }
}

#[test]
fn things_are_brought_put_and_thrown_away() {
    means("kitchen", "Bring me the coke.", &["at(coke, user)"]);
    means("kitchen", "could you please fetch the red mug for me", &["at(mug_1, user)"]);
    means("kitchen", "I'd like an apple, please", &["at(apple, user)"]);
    means("kitchen", "put the sponge into the top drawer", &["in(sponge, drawer_1)"]);
    means("kitchen", "Take the plate to the sink", &["on(plate, sink)"]);
    means("kitchen", "throw the apple away", &["in(apple, trash)"]);
    means("kitchen", "get rid of the water bottle", &["in(bottle, trash)"]);
    means("kitchen", "pick the blue mug up", &["holding(mug_2)"]);
    means("living_room", "hand the guest the magazine", &["at(magazine, guest)"]);
    means("living_room", "give the remote to the guest", &["at(remote_1, guest)"]);
    means("living_room", "put the ball in the drawer", &["in(ball, drawer_1)"]);
}

#[test]
fn places_and_doors() {
    means("kitchen", "go to the kitchen table", &["at(robot, kitchen_table)"]);
    means("kitchen", "come here", &["at(robot, user)"]);
    means("kitchen", "open the fridge", &["open(fridge_1)"]);
    means("kitchen", "could you shut the cupboard?", &["not open(cupboard_1)"]);
    means("kitchen", "drive to the sink and then to the door", &["at(robot, sink)", "at(robot, door)"]);
    means(
        "kitchen",
        "There is a sink, a shelf and a table. Visit all of these places.",
        &["at(robot, sink)", "at(robot, shelf)", "at(robot, kitchen_table)"],
    );
}

#[test]
fn several_things_one_after_the_other() {
    means("kitchen", "bring me the coke and the apple", &["at(coke, user)", "at(apple, user)"]);
    means(
        "kitchen",
        "put the red mug on the shelf and the sponge in the drawer",
        &["on(mug_1, shelf)", "in(sponge, drawer_1)"],
    );
    means("kitchen", "pick up the plate and bring it to me", &["holding(plate)", "at(plate, user)"]);
    means(
        "kitchen",
        "open the drawer, then put the sponge in it",
        &["open(drawer_1)", "in(sponge, drawer_1)"],
    );
    means("kitchen", "bring me both mugs", &["at(mug_1, user)", "at(mug_2, user)"]);
}

#[test]
fn what_a_thing_is_and_is_for() {
    means("kitchen", "bring me something to drink", &["at(bottle, user) or at(coke, user)"]);
    means("kitchen", "I spilled my drink, can you bring me something to clean it up?", &["at(sponge, user)"]);
    means("kitchen", "bring me a piece of fruit", &["at(apple, user)"]);
    means("living_room", "bring me something to read from the coffee table", &["at(magazine, user)"]);
}

#[test]
fn what_is_asked_without_an_imperative() {
    means("kitchen", "I need the fridge open", &["open(fridge_1)"]);
    means("kitchen", "make sure that the top drawer is shut", &["not open(drawer_1)"]);
    means("kitchen", "I don't want the cupboard open", &["not open(cupboard_1)"]);
    means("kitchen", "the coke belongs in the fridge", &["in(coke, fridge_1)"]);
    means("kitchen", "can the sponge go in the drawer?", &["in(sponge, drawer_1)"]);
    means("kitchen", "could the coke be brought to me?", &["at(coke, user)"]);
    means("kitchen", "would you mind putting the plate on the counter?", &["on(plate, counter)"]);
    means("kitchen", "the water bottle, please", &["at(bottle, user)"]);
    means("kitchen", "on the sink is where I want the sponge", &["on(sponge, sink)"]);
    means("kitchen", "I want you at the door", &["at(robot, door)"]);
}

#[test]
fn pronouns_and_particles() {
    means("kitchen", "go to the fridge and open it up", &["at(robot, fridge_1)", "open(fridge_1)"]);
    means("kitchen", "I don't need the apple any more, bin it", &["in(apple, trash)"]);
    means("living_room", "the water bottle is rubbish, throw it away", &["in(bottle_1, trash_bin)"]);
    means("kitchen", "get the coke and leave it on the sink", &["holding(coke)", "on(coke, sink)"]);
    means(
        "kitchen",
        "open the drawer and put the sponge inside",
        &["open(drawer_1)", "in(sponge, drawer_1)"],
    );
    means(
        "kitchen",
        "put the coke in the fridge and close it",
        &["in(coke, fridge_1)", "not open(fridge_1)"],
    );
    means("kitchen", "the fridge is open, please close it", &["not open(fridge_1)"]);
    assert!(matches!(puzzles("kitchen", "I forgot the mug, bring it"), Puzzle::AmbiguousReference { .. }));
}

#[test]
fn what_is_not_clear_is_asked() {
    let ambiguous = |request| matches!(puzzles("kitchen", request), Puzzle::AmbiguousReference { .. });
    assert!(ambiguous("bring me the mug"));
    assert!(matches!(puzzles("kitchen", "put the mug away"), Puzzle::AmbiguousReference { .. }));
    assert!(matches!(puzzles("kitchen", "put the plate away"), Puzzle::AmbiguousTask { .. }));
    assert!(matches!(puzzles("kitchen", "bring me the teddy"), Puzzle::NotFound { .. }));
    assert!(matches!(puzzles("kitchen", "I am thirsty"), Puzzle::AmbiguousTask { .. }));
    // There is nothing to drink in it.
    assert!(matches!(puzzles("lab", "I am thirsty"), Puzzle::NotUnderstood { .. }));
}

#[test]
fn what_is_not_understood_is_said() {
    for request in [
        "",
        "wash the dishes",
        "do not bring me the coke",
        "sing a song",
        "what time is it?",
        "bring me the coke unless it is warm",
        "the the the",
        "and and and",
        "brng",
        "peel the apple and bring it to me",
        "if the fridge is open, bring me the coke",
        "the tea set needs polishing",
        "should the coke go in the fridge?",
    ] {
        assert!(matches!(puzzles("kitchen", request), Puzzle::NotUnderstood { .. }), "{request}");
    }
}

//! Requests in words and what they are taken to mean, in scenes that come with the robots.

use motet_requests::{PendingQuestion, RequestContext, RequestError};
use motet_syntax::print;
use motet_tests::setup;

/// The goals, in order, as text.
#[track_caller]
fn means(scene: &str, request: &str, goals: &[&str]) {
    let scene = setup::scene(scene);
    let understood = motet_requests::understand(request, &RequestContext::new(&scene))
        .unwrap_or_else(|why| panic!("{request}: {why}"));
    let found: Vec<_> = understood.aims.iter().map(|aim| print::expression(&aim.goal.condition)).collect();
    assert_eq!(found, goals, "{request}");
}

#[track_caller]
fn puzzles(scene: &str, request: &str) -> RequestError {
    let scene = setup::scene(scene);
    match motet_requests::understand(request, &RequestContext::new(&scene)) {
        Err(puzzle) => puzzle,
        Ok(understood) => {
            let found: Vec<_> =
                understood.aims.iter().map(|aim| print::expression(&aim.goal.condition)).collect();
            panic!("{request}: taken to mean {found:?}")
        }
    }
}

#[test]
fn request_things_are_brought_put_and_thrown_away() {
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
fn request_places_and_doors() {
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
fn request_several_things_one_after_the_other() {
    means("kitchen", "bring me the coke and the apple", &["at(coke, user)", "at(apple, user)"]);
    means(
        "kitchen",
        "put the red mug on the shelf and the sponge in the drawer",
        &["on(mug_1, shelf)", "in(sponge, drawer_1)"],
    );
    means("kitchen", "pick up the plate and bring it to me", &["at(plate, user)"]);
    means(
        "kitchen",
        "open the drawer, then put the sponge in it",
        &["open(drawer_1)", "in(sponge, drawer_1)"],
    );
    means("kitchen", "bring me both mugs", &["at(mug_1, user)", "at(mug_2, user)"]);
}

#[test]
fn request_what_a_thing_is_and_is_for() {
    let drink = puzzles("kitchen", "bring me something to drink");
    assert!(matches!(drink, RequestError::AmbiguousReference { options, .. } if options.len() == 2));
    means("kitchen", "I spilled my drink, can you bring me something to clean it up?", &["at(sponge, user)"]);
    means("kitchen", "bring me a piece of fruit", &["at(apple, user)"]);
    means("living_room", "bring me something to read from the coffee table", &["at(magazine, user)"]);
}

#[test]
fn request_what_is_asked_without_an_imperative() {
    means("kitchen", "I need the fridge open", &["open(fridge_1)"]);
    means("kitchen", "make sure that the top drawer is shut", &["not open(drawer_1)"]);
    means("kitchen", "I don't want the cupboard open", &["not open(cupboard_1)"]);
    means("kitchen", "the coke belongs in the fridge", &["in(coke, fridge_1)"]);
    means("kitchen", "can the sponge go in the drawer?", &["in(sponge, drawer_1)"]);
    means("kitchen", "could the coke be brought to me?", &["at(coke, user)"]);
    means("kitchen", "would you mind putting the plate on the counter?", &["on(plate, counter)"]);
    means("kitchen", "the water bottle, please", &["at(bottle, user)"]);
    means("kitchen", "on the counter is where I want the sponge", &["on(sponge, counter)"]);
    means("kitchen", "I want you at the door", &["at(robot, door)"]);
}

#[test]
fn request_pronouns_and_particles() {
    means("kitchen", "go to the fridge and open it up", &["at(robot, fridge_1)", "open(fridge_1)"]);
    means("kitchen", "I don't need the apple any more, bin it", &["in(apple, trash)"]);
    means("living_room", "the water bottle is rubbish, throw it away", &["in(bottle_1, trash_bin)"]);
    means("kitchen", "get the coke and leave it on the sink", &["on(coke, sink)"]);
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
    assert!(matches!(
        puzzles("kitchen", "I forgot the mug, bring it"),
        RequestError::AmbiguousReference { .. }
    ));
}

#[test]
fn request_what_is_not_clear_is_asked() {
    let ambiguous = |request| matches!(puzzles("kitchen", request), RequestError::AmbiguousReference { .. });
    assert!(ambiguous("bring me the mug"));
    assert!(matches!(puzzles("kitchen", "put the mug away"), RequestError::AmbiguousReference { .. }));
    assert!(matches!(puzzles("kitchen", "put the plate away"), RequestError::AmbiguousTask { .. }));
    assert!(matches!(puzzles("kitchen", "bring me the teddy"), RequestError::NotFound { .. }));
    assert!(matches!(puzzles("kitchen", "I am thirsty"), RequestError::AmbiguousTask { .. }));
    // There is nothing to drink in it.
    assert!(matches!(puzzles("lab", "I am thirsty"), RequestError::NotUnderstood { .. }));
}

#[test]
fn request_what_is_not_understood_is_said() {
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
        "the tea set needs polishing",
        "should the coke go in the fridge?",
    ] {
        assert!(matches!(puzzles("kitchen", request), RequestError::NotUnderstood { .. }), "{request}");
    }
}

/// What is not understood, word for word.
#[track_caller]
fn not_understood(scene: &str, requests: &[&str]) {
    for request in requests {
        assert!(matches!(puzzles(scene, request), RequestError::NotUnderstood { .. }), "{request}");
    }
}

/// The question that a request is answered with.
#[track_caller]
fn asks(scene: &str, request: &str, asked: &str) {
    match puzzles(scene, request) {
        RequestError::AmbiguousTask { question, .. } => assert_eq!(question, asked, "{request}"),
        other => panic!("{request}: {other}"),
    }
}

#[test]
fn request_where_a_thing_is_is_not_where_it_shall_go() {
    means("living_room", "throw away the can on the coffee table", &["in(can, trash_bin)"]);
    means("living_room", "get rid of the cup on the low table", &["in(cup, trash_bin)"]);
    means("living_room", "throw the can on the coffee table in the bin", &["in(can, trash_bin)"]);
    means("living_room", "throw the can in the bin", &["in(can, trash_bin)"]);
    means("living_room", "throw away everything on the sofa", &["in(teddy, trash_bin)"]);
    means(
        "living_room",
        "throw away everything on the coffee table",
        &[
            "in(remote_1, trash_bin)",
            "in(cup, trash_bin)",
            "in(bottle_1, trash_bin)",
            "in(can, trash_bin)",
            "in(toy, trash_bin)",
            "in(magazine, trash_bin)",
        ],
    );
    asks("living_room", "put away everything on the coffee table", "Where shall I put the tv remote?");
    assert!(matches!(
        puzzles("living_room", "put away everything on the shelf"),
        RequestError::NotFound { .. }
    ));
    asks("living_room", "put the toys on the sofa away", "Where shall I put the teddy bear?");
    asks("living_room", "put away the magazine on the coffee table", "Where shall I put the newspaper?");
    asks("living_room", "throw the can on the coffee table", "Shall I throw the can away?");
    means("living_room", "put the remote away in the drawer", &["in(remote_1, drawer_1)"]);
    means("living_room", "store the toys in the basket", &["in(toy, basket)", "in(teddy, basket)"]);
    means("kitchen", "grab the mug on the shelf", &["holding(mug_2)"]);
    means("kitchen", "take the mug on the shelf to the sink", &["on(mug_2, sink)"]);
    means("kitchen", "fetch the coke on the counter", &["at(coke, user)"]);
    means("kitchen", "bring me the mug on the shelf", &["at(mug_2, user)"]);
    means("kitchen", "I want the plate on the counter", &["on(plate, counter)"]);
}

#[test]
fn request_what_is_packed_is_told_by_what_it_is() {
    let not_found = |scene, request| matches!(puzzles(scene, request), RequestError::NotFound { .. });
    for request in
        ["bring me the green bottle", "get the blue bottle", "the red glass, please", "bring me the red can"]
    {
        assert!(not_found("kitchen", request), "{request}");
    }
    assert!(
        not_found("kitchen", "bring me the yellow box") && not_found("living_room", "bring me the red cup")
    );
    assert!(not_found("lab", "bring me the black box") && not_found("living_room", "bring me a cup of tea"));
    means("kitchen", "bring me a bottle of water", &["at(bottle, user)"]);
    means("kitchen", "bring me a can of coke", &["at(coke, user)"]);
    means("kitchen", "bring me the red cup", &["at(mug_1, user)"]);
}

#[test]
fn request_nothing_is_thrown_to_anybody() {
    asks("kitchen", "throw the apple to me", "Shall I bring you the apple?");
    asks("living_room", "throw me the ball", "Shall I bring you the ball?");
    asks("living_room", "toss me the can", "Shall I bring you the can?");
    asks("living_room", "throw the ball at the guest", "Shall I bring the ball to the guest?");
    asks(
        "living_room",
        "chuck the guest the remote control",
        "Shall I bring the remote control to the guest?",
    );
    means("living_room", "throw the ball onto the sofa", &["on(ball, sofa)"]);
    means("kitchen", "throw the apple away for me", &["in(apple, trash)"]);
}

#[test]
fn request_what_shall_not_be_is_not_done() {
    not_understood(
        "lab",
        &[
            "bring me the pen instead of the wrench",
            "bring me the pen rather than the wrench",
            "instead of the wrench, bring me the pen",
            "bring me the pen and not the wrench",
            "put the pen on the desk instead of the bench",
        ],
    );
    means("lab", "bring me the pen instead", &["at(pen, user)"]);
}

#[test]
fn request_near_a_place_is_neither_on_nor_in_it() {
    not_understood(
        "living_room",
        &[
            "put the ball next to the basket",
            "put the cup by the sofa",
            "put the remote beside the guest",
            "the cup belongs in front of the sofa",
            "place the book close to the vase",
            "bring me the cup near the vase",
            "put the ball on top of the basket",
            "put the ball on the guest",
            "put the keys in the cup",
        ],
    );
    not_understood("kitchen", &["put the apple next to the plate", "put the coke on top of the fridge"]);
    means("kitchen", "go stand by the sink", &["at(robot, sink)"]);
    means("kitchen", "put the apple on the plate", &["on(apple, plate)"]);
    means("kitchen", "put the plate in the sink", &["on(plate, sink)"]);
}

#[test]
fn request_what_is_known_and_does_not_fit_is_not_unknown() {
    let unfit = |scene: &str, request: &str, why: &str| {
        let puzzle = puzzles(scene, request);
        assert!(
            matches!(puzzle, RequestError::Unfit { .. } | RequestError::Elsewhere { .. }),
            "{request}: {puzzle}"
        );
        assert_eq!(puzzle.to_string(), why, "{request}");
    };
    unfit("kitchen", "bring me the fridge", "I cannot carry the refrigerator");
    unfit("kitchen", "open the bottle", "I cannot open or close the water bottle");
    unfit(
        "kitchen",
        "bring the coke from the fridge",
        "as far as I know the coke can is on the kitchen counter",
    );
    unfit(
        "kitchen",
        "take the apple in the cupboard",
        "as far as I know the green apple is on the dining table",
    );
    unfit("kitchen", "bring me three mugs", "I know of only 2 of the things that you call `three mugs`");
    unfit("kitchen", "take out the trash", "I cannot carry the rubbish bin");
    unfit("living_room", "dispose of the guest", "I cannot carry the visitor");
    unfit("living_room", "close the door", "I cannot open or close the room door");
    unfit("living_room", "close the window", "I cannot open or close the window");
}

/// Where an answer says that something is; `it` is the coke.
#[track_caller]
fn tells(answer: &str, places: &[&str]) {
    let scene = setup::scene("kitchen");
    let situation = RequestContext { spoken_of: vec!["coke".into()], ..RequestContext::new(&scene) };
    let told = motet_requests::told(answer, PendingQuestion::Where, &situation);
    let found: Vec<_> =
        told.iter().map(|one| format!("{}({}, {})", one.relation, one.thing, one.place)).collect();
    assert_eq!(found, places, "{answer}");
}

#[test]
fn request_answer_tells_a_place_only_where_it_says_that_something_is_there() {
    for answer in [
        "there is nothing in the fridge",
        "I looked in the fridge and it wasn't there",
        "I looked in the fridge, but it was gone",
        "anywhere but in the fridge",
        "on top of the fridge",
        "no idea, I am sitting at the table",
        "I put it in the fridge, but it isn't there any more",
        "put it on the counter",
        "I want you to put it in the fridge",
        "is there a cupboard?",
    ] {
        tells(answer, &[]);
    }
    tells("It is not on the table, it is in the fridge.", &["in(coke, fridge_1)"]);
    tells("try the cupboard", &["in(coke, cupboard_1)"]);
    tells("somebody moved it to the cupboard", &["in(coke, cupboard_1)"]);
    tells("maybe I left it in the cupboard yesterday", &["in(coke, cupboard_1)"]);
    tells("my wife has put it on the shelf", &["on(coke, shelf)"]);
    tells("you will find it in the top drawer", &["in(coke, drawer_1)"]);
    tells("it should be in there, in the drawer", &["in(coke, drawer_1)"]);
    tells("check the fridge first and then the cupboard", &["in(coke, fridge_1)", "in(coke, cupboard_1)"]);
    tells("on the table or in the cupboard", &["on(coke, kitchen_table)", "in(coke, cupboard_1)"]);
}

#[test]
fn request_what_is_said_beside_a_request_is_taken_in() {
    let scene = setup::scene("kitchen");
    for request in [
        "the coke is in the fridge. bring it to me",
        "I put the coke in the fridge, bring it to me",
        "there is a coke in the fridge, please bring it to me",
        "somebody moved the coke to the fridge and I am thirsty. Bring me the coke from the fridge.",
    ] {
        let understood = motet_requests::understand(request, &RequestContext::new(&scene)).unwrap();
        let goals: Vec<_> =
            understood.aims.iter().map(|aim| print::expression(&aim.goal.condition)).collect();
        assert_eq!(goals, ["at(coke, user)"], "{request}");
        let located: Vec<_> =
            understood.located.iter().map(|one| (one.thing.as_str(), one.place.as_str())).collect();
        assert_eq!(located, [("coke", "fridge_1")], "{request}");
    }
}

#[test]
fn request_long_request_is_not_read() {
    let long = "bring me the coke and ".repeat(5000);
    let why = puzzles("kitchen", &long).to_string();
    assert_eq!(why, "a request may have at most 4096 bytes");
}

#[test]
fn request_ordinary_word_is_no_slip() {
    assert!(matches!(puzzles("kitchen", "bring me a cold drink"), RequestError::NotFound { .. }));
    assert!(matches!(puzzles("kitchen", "go charge"), RequestError::NotFound { .. }));
    means("kitchen", "bring me the appel", &["at(apple, user)"]);
    match puzzles("kitchen", "bring me that") {
        RequestError::NotUnderstood { part } => assert_eq!(part, "that"),
        other => panic!("{other}"),
    }
}

#[test]
fn request_what_cannot_hold_together_is_done_in_turn_or_named() {
    let unfit = |scene: &str, request: &str, why: &str| assert_eq!(puzzles(scene, request).to_string(), why);
    means("kitchen", "close the drawer and open it", &["not open(drawer_1)", "open(drawer_1)"]);
    means(
        "kitchen",
        "put the plate on the counter and then put it on the shelf",
        &["on(plate, counter)", "on(plate, shelf)"],
    );
    unfit(
        "living_room",
        "bring me the cup and then bring it to the guest",
        "I cannot take a thing back from you: the tea cup goes there or to the visitor",
    );
    unfit(
        "lab",
        "throw the pen away and bring it to me",
        "a thing in the bin stays there: the black pen goes into the waste bin or to you",
    );
    unfit(
        "kitchen",
        "pick up everything on the counter",
        "I cannot hold the water bottle and the coke can at once",
    );
}

#[test]
fn request_thing_is_looked_for_where_it_is_taken_to_be() {
    means("kitchen", "find the coke", &["at(robot, counter)", "visible(coke)"]);
    means("living_room", "find the keys", &["at(robot, drawer_1)", "open(drawer_1)", "visible(keys)"]);
    means("living_room", "look for the ball in the basket", &["at(robot, basket)", "visible(ball)"]);
    let open = &["open(fridge_1)", "open(cupboard_1)", "open(drawer_1)"];
    means("kitchen", "open everything", open);
}

/// What an answer to "Which one?" means, of the two mugs.
#[track_caller]
fn chooses(answer: &str, chosen: &[&str]) {
    let scene = setup::scene("kitchen");
    let situation = RequestContext { spoken_of: vec!["mug_1".into()], ..RequestContext::new(&scene) };
    let found = motet_requests::choose(answer, &["mug_1".into(), "mug_2".into()], &situation);
    assert_eq!(found, chosen, "{answer}");
}

#[test]
fn request_thing_goes_to_one_place_after_the_other_and_back_where_it_was() {
    let scene = setup::scene("kitchen");
    let goals = |request: &str, situation: &RequestContext<'_>| {
        let understood = motet_requests::understand(request, situation)?;
        let goals = understood.aims.iter().map(|aim| print::expression(&aim.goal.condition));
        Ok::<Vec<String>, RequestError>(goals.collect())
    };
    let start = RequestContext::new(&scene);
    for (request, wanted) in [
        (
            "put the sponge on the counter and then on the kitchen table",
            ["on(sponge, counter)", "on(sponge, kitchen_table)"],
        ),
        (
            "put the sponge on the counter, then in the fridge",
            ["on(sponge, counter)", "in(sponge, fridge_1)"],
        ),
        ("bring the sponge to the counter and then to me", ["on(sponge, counter)", "at(sponge, user)"]),
        ("put the sponge on the counter and then put it back", ["on(sponge, counter)", "on(sponge, sink)"]),
    ] {
        assert_eq!(goals(request, &start).unwrap(), wanted, "{request}");
    }
    // In two places at once it cannot be, and where it was nobody knows who never took it.
    assert!(matches!(
        goals("put the sponge on the counter and on the kitchen table", &start),
        Err(RequestError::NotUnderstood { .. })
    ));
    assert!(matches!(goals("put the sponge back", &start), Err(RequestError::AmbiguousTask { .. })));
    let moved = RequestContext {
        came_from: vec![("sponge".into(), "counter".into())],
        ..RequestContext::new(&scene)
    };
    assert_eq!(goals("put the sponge back", &moved).unwrap(), ["on(sponge, counter)"]);
    assert_eq!(goals("put the sponge back where it was", &moved).unwrap(), ["on(sponge, counter)"]);
    assert!(matches!(goals("put the red mug back", &moved), Err(RequestError::AmbiguousTask { .. })));
}

#[test]
fn request_left_and_right_are_taken_where_they_are_the_same_for_both() {
    let mut scene = setup::scene("kitchen");
    // Both mugs on one table, at a distance ahead of the robot, which looks along x from the origin.
    for (id, side) in [("mug_1", 0.3), ("mug_2", -0.3)] {
        let mug = scene.entities.get_mut(id).unwrap();
        mug.pose.as_mut().unwrap().xyz = [2.0, side, 0.8];
    }
    let options = ["mug_1".into(), "mug_2".into()];
    for (user_x, left, right) in [(-1.0, vec!["mug_1"], vec!["mug_2"]), (4.0, vec![], vec![])] {
        scene.entities.get_mut("user").unwrap().pose.as_mut().unwrap().xyz = [user_x, 0.0, 0.0];
        let situation = RequestContext::new(&scene);
        assert_eq!(motet_requests::choose("the left one", &options, &situation), left, "user at {user_x}");
        assert_eq!(
            motet_requests::choose("the one on the right", &options, &situation),
            right,
            "user at {user_x}"
        );
    }
}

#[test]
fn request_one_is_chosen_in_many_ways_or_none() {
    for (answer, chosen) in [
        ("the red one", "mug_1"),
        ("the blue one, please", "mug_2"),
        ("any", "mug_1"),
        ("I don't care", "mug_1"),
        ("the other one", "mug_2"),
        ("not the red one", "mug_2"),
        ("2", "mug_2"),
        ("mug 2", "mug_2"),
        ("number 1", "mug_1"),
        ("the one that is blue", "mug_2"),
        ("the last one", "mug_2"),
        ("the second one", "mug_2"),
        ("two", "mug_2"),
        ("number two, please", "mug_2"),
        ("one", "mug_1"),
        ("the first", "mug_1"),
        ("the one on the shelf", "mug_2"),
        ("the apple", "apple"),
    ] {
        chooses(answer, &[chosen]);
    }
    chooses("both", &["mug_1", "mug_2"]);
    chooses("the red one and the blue one", &["mug_1", "mug_2"]);
    for answer in ["the red one or the blue one", "hm", "the green one", "7", "not that", "the fridge"] {
        chooses(answer, &[]);
    }
    for answer in ["three", "the third one", "the left one of three"] {
        chooses(answer, &[]);
    }
    let scene = setup::scene("kitchen");
    let meant = vec![("the mug".to_owned(), "mug_1".into()), ("the mug".to_owned(), "mug_2".into())];
    let situation = RequestContext { meant, ..RequestContext::new(&scene) };
    let understood = motet_requests::understand("bring me the mug", &situation).unwrap();
    let goals: Vec<_> = understood.aims.iter().map(|aim| print::expression(&aim.goal.condition)).collect();
    assert_eq!(goals, ["at(mug_1, user)", "at(mug_2, user)"]);
}

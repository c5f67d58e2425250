//! Where something goes.

use super::{goals, mean, not_taken};
use motet_requests::RequestError;

#[test]
fn request_place_can_come_first_or_without_a_verb() {
    mean(
        &["in(apple, trash)"],
        &["The apple is rotten, into the bin with it!", "Into the trash with the apple."],
    );
    mean(
        &["at(robot, sink)"],
        &[
            "Off to the sink with you!",
            "Off you go to the sink.",
            "Next stop is the sink.",
            "I'd like you to be at the sink.",
            "I'll meet you at the sink, you go ahead.",
            "Why don't you go and wait by the sink?",
            "Pop over to the sink for a sec.",
            "Park yourself at the sink and stay there.",
        ],
    );
    mean(
        &["on(sponge, counter)"],
        &[
            "The sponge goes on the counter, so put it there, would you?",
            "I'd like the sponge to be on the counter when I get back.",
            "Let's have the sponge on the counter from now on.",
            "Stick the sponge up on the counter where I can see it.",
            "Carry the sponge to the counter and set it on top.",
            "I want the sponge kept on the counter.",
        ],
    );
    not_taken(&[
        "I don't want the sponge on the counter.",
        "The sponge is on the counter.",
        "The sponge stays on the counter.",
        "Don't put the sponge on the counter.",
        "I'll meet you at the sink.",
        "You could have put the sponge on the counter.",
        "Put the sponge back where it belongs.",
        "Put the sponge on the counter and then put it back where it belongs.",
        "Get the sponge out of my sight.",
    ]);
}

#[test]
fn request_where_something_goes_may_be_said_in_a_clause_of_its_own() {
    mean(
        &["in(sponge, drawer_1)"],
        &[
            "The sponge belongs in the top drawer, could you put it back?",
            "In the top drawer, that's where the sponge should go, please put it away.",
            "The top drawer is where the sponge lives, so put it away.",
            "We always keep the sponge in the top drawer, so could you put it back?",
            "There should be space in the top drawer for the sponge, so put it in.",
            "Shut the sponge away in the top drawer.",
            "Find a spot in the top drawer for the sponge.",
            "It's about time the sponge went into the top drawer.",
            "I'd appreciate the sponge being put in the top drawer.",
            "The top drawer is the right place for the sponge.",
            "The sponge into the top drawer, please.",
            "See the sponge? Put it in the top drawer.",
            "I think the sponge should go in the top drawer.",
            "To keep it clean, put the sponge in the top drawer.",
            "Put the sponge where it belongs, in the top drawer.",
        ],
    );
    mean(
        &["in(sponge, drawer_1)"],
        &[
            "Clear the sponge away, it goes in the top drawer.",
            "I want the sponge out of sight, so put it in the top drawer.",
        ],
    );
    mean(&["on(sponge, counter)"], &["Carry the sponge across and rest it gently on the counter."]);
    mean(
        &["on(sponge, counter)"],
        &[
            "On the counter, please, that's where I want you to put the sponge.",
            "I'll need the sponge later, so put it out ready on the counter.",
            "Would it be possible to have the sponge waiting on the counter?",
            "Lift the sponge onto the counter.",
        ],
    );
    mean(
        &["in(sponge, trash)"],
        &[
            "Out with the sponge!",
            "The sponge is for the bin.",
            "The sponge is old, so out it goes.",
            "The sponge is finished. In the bin, please.",
        ],
    );
    mean(
        &["in(sponge, fridge_1)", "not open(fridge_1)"],
        &[
            "Put the sponge in the fridge and close the door.",
            "Put the sponge in the fridge and then shut it.",
        ],
    );
    not_taken(&[
        "We always keep the sponge in the top drawer.",
        "The sponge must be on the counter.",
        "The sponge on the counter, please.",
        "Put the sponge away.",
        "I'll need the sponge later.",
        "Leave the sponge.",
        "It's about time the kids went to bed.",
        "I want the sponge gone.",
        "Find a spot for the sponge.",
        "In the bin, please.",
        "To keep it clean tomorrow, put the sponge in the top drawer.",
    ]);
}

#[test]
fn request_what_is_spoken_of_and_not_clear_is_asked_of_and_not_guessed() {
    for request in [
        "You know the mug lives in the top drawer, so pop it back in there for me.",
        "I'll tell you later where the mug goes, for now just pick it up.",
    ] {
        let found = goals(request);
        assert!(matches!(found, Err(RequestError::AmbiguousReference { .. })), "{request}: {found:?}");
    }
    mean(&["holding(sponge)"], &["I'll tell you later where the sponge goes, for now just pick it up."]);
}

#[test]
fn request_what_is_held_is_held() {
    mean(
        &["holding(bottle)"],
        &[
            "Grab the water bottle and don't let go.",
            "Pick up the water bottle and hang on to it until I say so.",
            "Take the water bottle in your hand and stay there with it.",
            "Get hold of the water bottle. Don't put it down yet.",
            "Hold the water bottle for me while I look for the lid.",
            "Pick the water bottle up, and keep it in your gripper.",
        ],
    );
    mean(
        &["at(bottle, user)"],
        &["Bring me the water bottle, but don't spill it!", "Don't worry, just bring me the water bottle."],
    );
    not_taken(&[
        "Don't let go.",
        "Bring me the water bottle and don't let go.",
        "Do not pick up the water bottle.",
    ]);
}

#[test]
fn request_place_may_follow_in_a_clause_of_its_own_or_tell_only_where_a_thing_lives() {
    mean(
        &["in(sponge, drawer_1)"],
        &[
            "As you know, the sponge lives in the top drawer, so please put it back.",
            "Would you kindly return the sponge to the top drawer, where it lives?",
            "Get the sponge out of sight, in the top drawer.",
            "Make room in the top drawer for the sponge and put it inside.",
            "Lock the sponge away in the top drawer.",
            "The sponge's proper place is in the top drawer. Put it back there.",
            "In the top drawer, please, with the sponge.",
            "The sponge has to disappear into the top drawer.",
            "The sponge must be put in the top drawer, please.",
            "I suppose the sponge had better go in the top drawer.",
            "It's high time the sponge was put away in the top drawer.",
        ],
    );
    mean(
        &["on(sponge, counter)"],
        &[
            "Get the sponge out of my way and onto the counter.",
            "The sponge should be sitting on the counter, please.",
            "Make the sponge stand on the counter.",
            "On the counter please, the sponge.",
            "Clear a space on the counter and put the sponge there.",
        ],
    );
    mean(
        &["at(robot, sink)"],
        &[
            "Back to the sink with you.",
            "To the sink! Quick march!",
            "Over to the sink now, I'll tell you what to do when you're there.",
        ],
    );
    mean(&["in(apple, trash)"], &["I think the apple has had its day, so out it goes with the rubbish."]);
    not_taken(&[
        "The sponge lives in the top drawer.",
        "Make room in the drawer.",
        "Clear a space on the counter.",
        "The sponge, on the counter.",
        "Lock the fridge.",
        "The sponge must be on the counter.",
        "To me.",
        "The sponge must have been put in the drawer.",
        "The sponge's place is taken.",
        "On the counter please, not the table.",
        "Put the sponge on the counter or in the drawer.",
    ]);
}

//! What somebody wants, or would find nice.

use super::{mean, not_taken};
use motet_requests::RequestContext;
use motet_syntax::print;
use motet_tests::setup;

#[test]
fn request_what_is_wished_is_done_where_it_is_asked_for() {
    mean(
        &["in(sponge, drawer_1)"],
        &[
            "I'd rather have the sponge in the top drawer, out of sight. Do that for me.",
            "I promised I'd put the sponge in the top drawer, but I am too small. You do it!",
            "I meant to put the sponge in the top drawer this morning and never got round to it. Can you do \
             it?",
            "Hide the sponge in the top drawer before anyone sees it.",
            "Shove the sponge in the top drawer so I don't get yelled at.",
            "Please to put the sponge in the top drawer.",
        ],
    );
    mean(
        &["on(sponge, counter)"],
        &[
            "I'd like to see the sponge on the counter. Would you do that?",
            "On the counter, that's where I want the sponge.",
            "It would look nicer if the sponge were on the counter. Could you see to that?",
            "Make the sponge go on the counter!",
            "Would it be possible to have the sponge waiting on the counter when I return?",
            "Can the sponge please go on the counter?",
            "I need the sponge on the counter in two minutes.",
            "Leave the sponge on the counter where I'll see it.",
            "Stick the sponge on the counter, whatever, anywhere on it is fine.",
        ],
    );
    mean(
        &["open(fridge_1)"],
        &[
            "I'd open the fridge myself, but I am tired, so that's your job.",
            "I should like the fridge opened.",
            "I need the fridge open now!",
        ],
    );
    mean(
        &["holding(bottle)"],
        &[
            "I bet you can't pick up the water bottle! Show me, and no putting it down!",
            "Get hold of the water bottle, dear, and don't let go of it.",
            "Take the water bottle in your hand and keep it there until I say so.",
            "You take the water bottle in hand and don't put down.",
        ],
    );
    mean(
        &["at(robot, sink)"],
        &["I need you over at the sink.", "I'm going to want your help at the sink shortly, so go on ahead."],
    );
    not_taken(&[
        "I'd like to see the sponge on the counter.",
        "I'd rather have the sponge in the drawer.",
        "I promised I'd put the sponge in the top drawer.",
        "I'd open the fridge myself.",
        "I'd like to see the sponge on the counter. Show me.",
        "I'd rather have the sponge in the drawer, but don't do that.",
        "I'd like to open the fridge, but that is up to you.",
        "Go to the sink. Stop!",
        "Bring me the coke, no, the apple.",
        "Bring me the coke. No, the apple.",
        "Bring me the water bottle, and no putting it down!",
        "I bet you can't pick up the water bottle!",
        "Put the sponge on the counter in two minutes.",
        "That's where I want the sponge.",
        "I'm going to want your help at the sink.",
        "Could you see to the sponge, please?",
        "I meant to put the sponge in the drawer and never got round to it.",
    ]);
}

#[test]
fn request_who_wants_something_later_or_can_do_it_speaks_of_it_alone() {
    mean(&["on(sponge, counter)"], &["Just leave the sponge on the counter and I'll take it later."]);
    mean(
        &["at(sponge, user)"],
        &["I can see the sponge from here but I can't reach it. Could you get it for me?"],
    );
    mean(&["at(robot, sink)"], &["Come with me to the sink.", "Come to the sink with me."]);
    // In the living room there is a can that is called rubbish, too.
    let scene = setup::scene("living_room");
    let said = "Ugh, the remote control is just rubbish now, isn't it. Would you put it in the bin?";
    let understood = motet_requests::understand(said, &RequestContext::new(&scene)).unwrap();
    let goals: Vec<_> = understood.aims.iter().map(|aim| print::expression(&aim.goal.condition)).collect();
    assert_eq!(goals, ["in(remote_1, trash_bin)"]);
    mean(
        &["holding(sponge)"],
        &[
            "Would you carry the sponge for me for a while?",
            "Hold on tight to the sponge.",
            "Close your hand around the sponge.",
        ],
    );
    mean(
        &["not open(fridge_1)"],
        &[
            "Please, the fridge, you close it.",
            "The fridge, please, you close it.",
            "I forgot to shut the fridge, could you?",
        ],
    );
    mean(
        &["open(cupboard_1)"],
        &[
            "I can't get the cupboard open. Could you?",
            "The cupboard won't open for me, can you do it?",
            "Fancy opening the cupboard for me?",
        ],
    );
    not_taken(&[
        "I can see the sponge, could you?",
        "I'd like to get into the fridge.",
        "The fridge, please, you always close it.",
        "You couldn't bring me the sponge.",
    ]);
}

#[test]
fn request_thing_that_is_wanted_where_it_is_believed_to_be_is_looked_at() {
    mean(&["at(robot, counter)", "visible(coke)", "on(coke, counter)"], &["put the coke on the counter"]);
    mean(&["on(coke, sink)"], &["put the coke on the sink"]);
}

#[test]
fn request_what_would_be_nice_is_wanted() {
    mean(
        &["at(coke, user)"],
        &[
            "The coke would hit the spot right now.",
            "If it isn't a bother, the coke would be nice.",
            "Having the coke here with me would be lovely.",
            "I wouldn't say no to the coke.",
            "I'd quite like the coke.",
            "Is there any way I could have the coke?",
            "Could I, er, have the coke brought over to me?",
            "What I need in my hand right now is the coke.",
            "The coke, if you'd be so kind.",
            "The coke please and thank you!",
            "Quick, the coke, over here to me!",
            "When you come back to me, have the coke with you, please.",
            "Make sure the coke reaches me.",
            "I need the coke for crying out loud.",
        ],
    );
    mean(
        &["not open(fridge_1)"],
        &[
            "Closing the fridge would be a big help right now.",
            "The fridge closed would be lovely.",
            "I'd feel safer with the fridge closed.",
            "I'd prefer the fridge closed, if that's all right with you.",
            "I'd say the fridge wants shutting, pet, and I'm not getting up again.",
        ],
    );
    mean(
        &["on(sponge, counter)"],
        &["I'm going to need the sponge within reach, so just put it on the counter."],
    );
    not_taken(&[
        "A holiday would be nice.",
        "Opening the fridge would be a mistake.",
        "The coke would be nice if it were cold.",
        "The fridge open would be a disaster.",
        "What I need is a holiday.",
        "I could get the coke myself.",
        "I will get the coke.",
        "I wouldn't like the coke.",
        "I'm going to need the coke later.",
        "The plants need the water bottle.",
        "Have the coke with you.",
        "May I take the coke?",
        "May I get the coke myself?",
        "Could I have the coke tomorrow?",
        "I must have the coke somewhere.",
        "I would be happier without the coke.",
        "It would be better to have the fridge closed, but leave it for now.",
        "I'd prefer the fridge closed. Leave it alone.",
        "The coke would be nice later.",
    ]);
}

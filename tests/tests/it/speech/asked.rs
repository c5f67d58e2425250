//! Who is asked to do something, and what they are told not to.

use super::{goals, mean, not_taken};
use motet_requests::RequestError;

#[test]
fn request_what_somebody_cannot_do_or_forgot_is_done_where_they_ask_for_it() {
    mean(
        &["not open(fridge_1)"],
        &[
            "I forgot to close the fridge. Could you do that for me?",
            "I have to close the fridge, but can you do it instead?",
            "I can't close the fridge. Help me out, please.",
            "Somebody has to close the fridge, would you see to it?",
            "The fridge should be closed. Please see to that.",
            "I'd feel better if you closed the fridge.",
            "It would be lovely if the fridge were shut.",
            "Let me know once you have closed the fridge.",
            "Is the fridge open? Please close it.",
            "Why's the fridge open? Shut it, please!",
        ],
    );
    mean(
        &["in(sponge, drawer_1)"],
        &["I've been meaning to put the sponge in the top drawer. Would you do it?"],
    );
    not_taken(&[
        "Could you do that for me?",
        "I forgot to close the fridge.",
        "I have to close the fridge.",
        "I don't have to close the fridge. Could you do it?",
        "I do not want to close the fridge. Would you see to it?",
        "Is the drawer open?",
        "Why is the fridge closed?",
        "Did my wife put the sponge in the drawer?",
        "My mum put the sponge in the drawer.",
        "I need to get into the fridge.",
        "I want to put the sponge in the drawer.",
        "Let's have a look inside the fridge.",
        "The fridge must be open.",
        "It would be nice if it rained.",
    ]);
}

#[test]
fn request_children_and_foreigners_say_who_shall_do_it() {
    mean(
        &["at(coke, user)"],
        &[
            "Please, you bring to me the coke.",
            "You bring me the coke now, okay?",
            "I wish somebody would bring me the coke.",
            "Any chance of you bringing me the coke sometime today?",
            "Might I trouble you to fetch me the coke?",
            "Would you mind going to get the coke for me?",
            "By the way, bring me the coke. Pretty please?",
        ],
    );
    mean(&["at(coke, user)"], &["I am needing the coke, you can give me?"]);
    mean(
        &["not open(fridge_1)"],
        &["The fridge is open, is not good. You close.", "Please, the fridge, you close it."],
    );
    mean(&["open(cupboard_1)"], &["Please, the cupboard, you make open for me.", "You open the cupboard!"]);
    mean(
        &["in(sponge, trash)"],
        &[
            "The sponge is garbage. You throw away.",
            "I think the sponge has had its day, it can go out with the rubbish.",
        ],
    );
    mean(&["at(robot, sink)"], &["You drive to the sink and then you stop!", "You go now to the sink, yes?"]);
    not_taken(&[
        "You always close the fridge.",
        "You put the sponge on the counter.",
        "You keep the fridge open.",
        "You brought me the coke.",
        "You open the fridge when I am asleep.",
        "My mum says, you bring me the coke.",
        "You throw away.",
        "If it rains, you close the fridge.",
        "When the guests arrive, you bring me the coke.",
        "You can give me.",
        "Would you mind going to the doctor?",
    ]);
}

#[test]
fn request_what_is_forbidden_beside_is_no_part_of_what_is_asked_for() {
    mean(
        &["on(sponge, counter)"],
        &[
            "Don't bring me the sponge, just put it on the counter.",
            "You don't have to bring me the sponge. Just put it on the counter.",
            "Put the sponge on the counter, don't bring it to me.",
            "Don't throw the sponge away, put it on the counter.",
            "Don't put the sponge in the fridge, put it on the counter.",
            "No need to bring me the sponge, just leave it on the counter.",
        ],
    );
    mean(
        &["holding(sponge)"],
        &[
            "I want you to pick the sponge up, but don't take it anywhere.",
            "Can you pick the sponge up? Don't bring it to me, just hold it.",
            "Grab the sponge and don't do anything else with it.",
            "Pick up the sponge, don't put it anywhere.",
        ],
    );
    mean(&["in(sponge, drawer_1)"], &["Don't leave the sponge lying about, put it in the top drawer."]);
    mean(&["not open(fridge_1)"], &["Don't leave the fridge open like that, shut it."]);
    not_taken(&[
        "Don't open the fridge, just bring me the coke.",
        "Don't bring me the sponge. Put it on the counter.",
        "Don't bring me the sponge until I put it on the counter.",
        "Don't pick up the sponge, put it on the counter.",
        "Bring me the coke and don't open the fridge.",
        "Don't bring me the sponge, just don't.",
        "Pick up the sponge, but don't take it.",
        "Bring me the coke, don't bring it to me.",
        "Don't go to the counter, just put the sponge on it.",
    ]);
}

#[test]
fn request_what_shall_be_done_with_it_is_asked_where_it_is_not_said() {
    for request in [
        "Would you mind taking care of the sponge for me?",
        "I need your help with the sponge.",
        "Deal with the sponge, please.",
        "Do the thing with the sponge.",
        "Something has to happen with the sponge.",
    ] {
        let found = goals(request);
        assert!(matches!(found, Err(RequestError::NotUnderstood { .. })), "{request}: {found:?}");
    }
}

#[test]
fn request_what_somebody_else_wants_is_done_where_the_speaker_asks_for_it() {
    mean(
        &["on(sponge, counter)"],
        &[
            "My wife wants the sponge on the counter, could you see to that?",
            "My mother asked for the sponge to be put on the counter. Would you?",
            "Daddy says you have to put the sponge on the counter 'cause I asked nicely.",
            "My wife would like you to put the sponge on the counter.",
        ],
    );
    mean(
        &["not open(fridge_1)"],
        &[
            "Please, the fridge must be closed, you do it?",
            "I can't get the fridge closed with this bad wrist, will you do it?",
            "Mum says you should close the fridge.",
        ],
    );
    not_taken(&[
        "My wife wants the sponge on the counter.",
        "Mum says you must not close the fridge.",
        "Mum says you don't have to bring the coke.",
        "Mum said you closed the fridge.",
        "Nobody wants you to open the fridge.",
        "My wife wants you to stay away from the fridge.",
        "The fridge must be closed.",
        "Mum says I have to close the fridge.",
    ]);
}

#[test]
fn request_what_is_left_out_is_what_was_named_just_before() {
    mean(
        &["at(coke, user)"],
        &["I want the coke! Gimme, gimme!", "Need the coke. Here. Now.", "Give it here, the coke."],
    );
    mean(
        &["in(sponge, drawer_1)"],
        &["Quick, hide the sponge! In the top drawer!", "The sponge is dirty, put in the top drawer please."],
    );
    mean(&["at(robot, sink)"], &["Race you to the sink! Go!"]);
    mean(&["not open(fridge_1)"], &["The fridge is open, please close.", "Close! The fridge!"]);
    mean(&["holding(sponge)"], &["Pick the sponge up, there's a love, and keep it."]);
    mean(
        &["in(sponge, trash)"],
        &[
            "Pop the sponge into the bin, please, dear.",
            "Throw, please, the sponge in the bin.",
            "The sponge should have been thrown away ages ago. Do it now, please.",
        ],
    );
    not_taken(&[
        "Give me!",
        "Put in the drawer.",
        "Go!",
        "Want the coke?",
        "Clean the sponge! In the top drawer!",
        "Fetch! The dog loves it.",
        "Open up! The milk is warm.",
    ]);
}

#[test]
fn request_things_that_are_told_apart_by_their_distance() {
    mean(
        &["at(mug_1, user)"],
        &[
            "Bring me the closest mug to the sink.",
            "bring me the mug nearest to the sink",
            "Could you fetch me the mug that is closest to the sink?",
        ],
    );
    mean(&["holding(mug_1)"], &["Pick up the nearest mug to the sink."]);
    mean(&["in(mug_1, cupboard_1)"], &["Put the closest mug to the sink in the cupboard."]);
    // It says where to, and not which.
    not_taken(&["Take the closest mug to the sink."]);
}

#[test]
fn request_order_and_choice_that_are_said_the_other_way_round() {
    mean(
        &["at(robot, counter)", "open(fridge_1)"],
        &["Before you open the fridge, go to the counter.", "Go to the counter before you open the fridge."],
    );
    mean(
        &["at(sponge, user)"],
        &["Bring me not the coke but the sponge.", "Fetch me not the red mug, but rather the sponge."],
    );
}

//! How people speak: what is said around a request is passed over, and what only sounds like one is not taken for it.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test fails by panicking")]

use motet_planner::request::{self, Puzzle, Situation};
use motet_syntax::print;
use motet_tests::setup;

fn goals(request: &str) -> Result<Vec<String>, Puzzle> {
    let scene = setup::scene("kitchen");
    let understood = request::understand(request, &Situation::new(&scene))?;
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

#[test]
fn whom_one_speaks_to_and_what_one_thinks_meanwhile_is_passed_over() {
    mean(
        &["at(coke, user)"],
        &[
            "Hey mate, grab me the coke, yeah?",
            "Darling, would you bring me the coke?",
            "Um, the, uh, coke, please.",
            "Bring me the coke, there's a good lad.",
            "Could you, er, fetch me the coke, sweetie?",
            "Bring me the coke. Cheers!",
            "Oh, I could murder the coke right now, love.",
            "Well, you know, I'd like the coke, if that's okay.",
            "Bring me the coke, will you, pal? Thanks a million.",
            "Excuse me, robot, might you bring me the coke, if it's not too much trouble?",
        ],
    );
    // These are things and no names.
    not_taken(&["Bring me the milk, honey and bread.", "Bring me the pet."]);
}

#[test]
fn reasons_stand_before_or_behind_what_is_asked_for() {
    mean(
        &["at(bottle, user)"],
        &[
            "I'm parched. Get me the water bottle, would you?",
            "Since you're over there, bring me the water bottle.",
            "Bring me the water bottle because I can't get up.",
            "My back is killing me, so please bring me the water bottle.",
            "The doctor says I need to drink more. Bring me the water bottle, please.",
            "Bring me the water bottle so I can take my pills.",
            "Before I forget, bring me the water bottle.",
            "Dinner is ready, so bring me the water bottle, please.",
            "When you're finished over there, could you bring me the water bottle?",
            "Could you bring me the water bottle? I'm too tired to get up.",
        ],
    );
    not_taken(&[
        "My mum says: bring me the coke.",
        "He told me, put the sponge in the sink.",
        "Tomorrow, bring me the coke.",
        "When the guests arrive, bring me the coke.",
        "If it rains, close the cupboard.",
        "Is the fridge open? Then bring me the coke.",
        "You must not open the fridge. Bring me the coke.",
        "I don't want you to go near the sink. Go to the kitchen table.",
        "Wash the dishes that are in the sink and bring me the coke.",
        "Put the mug on the counter before you open the drawer.",
        "Bring me the coke when I get back.",
    ]);
}

#[test]
fn what_somebody_cannot_do_or_forgot_is_done_where_they_ask_for_it() {
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
fn a_place_can_come_first_or_without_a_verb() {
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
fn children_and_foreigners_say_who_shall_do_it() {
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
fn what_is_wished_is_done_where_it_is_asked_for() {
    mean(
        &["in(sponge, drawer_1)"],
        &[
            "I'd rather have the sponge in the top drawer, out of sight. Do that for me.",
            "I promised I'd put the sponge in the top drawer, but I am too small. You do it!",
            "I meant to put the sponge in the top drawer this morning and never got round to it. Can you do it?",
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
fn what_is_forbidden_beside_is_no_part_of_what_is_asked_for() {
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
fn where_something_goes_may_be_said_in_a_clause_of_its_own() {
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
fn who_wants_something_later_or_can_do_it_speaks_of_it_alone() {
    mean(&["on(sponge, counter)"], &["Just leave the sponge on the counter and I'll take it later."]);
    mean(
        &["at(sponge, user)"],
        &["I can see the sponge from here but I can't reach it. Could you get it for me?"],
    );
    mean(&["at(robot, sink)"], &["Come with me to the sink.", "Come to the sink with me."]);
    // In the living room there is a can that is called rubbish, too.
    let scene = setup::scene("living_room");
    let said = "Ugh, the remote control is just rubbish now, isn't it. Would you put it in the bin?";
    let understood = request::understand(said, &Situation::new(&scene)).unwrap();
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
fn who_is_asked_may_be_anyone_and_how_may_be_said() {
    mean(
        &["at(sponge, user)"],
        &[
            "Can somebody bring me the sponge?",
            "Any chance I could have the sponge?",
            "Would it trouble you to bring me the sponge?",
            "I was wondering whether you'd be able to bring me the sponge.",
            "Make sure I get the sponge.",
            "Get me the sponge, and be quick about it.",
            "Look for the sponge and bring it over here when you've found it.",
            "When you've got a moment, I could do with you bringing me the sponge.",
            "Could I trouble you for the sponge?",
            "Put the sponge in my hand.",
        ],
    );
    mean(&["at(sponge, user)"], &["I want the sponge, give."]);
    mean(
        &["at(robot, sink)"],
        &[
            "You're needed at the sink.",
            "To the sink, please.",
            "Your destination is the sink.",
            "I'd rather you waited at the sink.",
            "Head to the sink and wait for me.",
        ],
    );
    mean(
        &["holding(bottle)"],
        &["Pick up the water bottle and wait for further instructions.", "Keep the water bottle with you."],
    );
    not_taken(&[
        "Can somebody see the sponge?",
        "Any chance of rain?",
        "Open the fridge a little.",
        "You know what to do with the sponge.",
        "I want something done about the sponge.",
        "The sponge needs taking care of.",
        "I was wondering whether you'd be able to.",
    ]);
}

#[test]
fn what_is_spoken_of_and_not_clear_is_asked_of_and_not_guessed() {
    for request in [
        "You know the mug lives in the top drawer, so pop it back in there for me.",
        "I'll tell you later where the mug goes, for now just pick it up.",
    ] {
        let found = goals(request);
        assert!(matches!(found, Err(Puzzle::AmbiguousReference { .. })), "{request}: {found:?}");
    }
    mean(&["holding(sponge)"], &["I'll tell you later where the sponge goes, for now just pick it up."]);
}

#[test]
fn what_is_held_is_held() {
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
fn what_shall_be_done_with_it_is_asked_where_it_is_not_said() {
    for request in [
        "Would you mind taking care of the sponge for me?",
        "I need your help with the sponge.",
        "Deal with the sponge, please.",
        "Do the thing with the sponge.",
        "Something has to happen with the sponge.",
    ] {
        let found = goals(request);
        assert!(matches!(found, Err(Puzzle::NotUnderstood { .. })), "{request}: {found:?}");
    }
}

#[test]
fn a_thing_that_is_wanted_where_it_is_believed_to_be_is_looked_at() {
    mean(&["at(robot, counter)", "visible(coke)", "on(coke, counter)"], &["put the coke on the counter"]);
    mean(&["on(coke, sink)"], &["put the coke on the sink"]);
}

#[test]
fn who_wants_another_try_says_so_in_many_ways() {
    for answer in [
        "Give it another shot.",
        "don't give up, try again!",
        "Never mind, have another go",
        "It can't hurt to try again, can it?",
        "Yeah, go for it.",
        "Of course you should!",
        "Oh, would you? That would be lovely.",
        "okay, but be careful this time",
        "No worries. One more time, please.",
        "why don't you try once more?",
        "Would you be so kind as to make a second attempt?",
        "If you would, please.",
        "Well, I can't do it myself, so please keep trying.",
        "Never mind, just try it a second time.",
        "I'd like you to attempt it again.",
        "You'll manage it this time.",
        "If at first you don't succeed, try again.",
        "Good idea.",
        "I think so.",
        "If you don't mind.",
        "You have my permission.",
    ] {
        assert_eq!(request::encourages(answer).as_deref().map(str::trim), Some(""), "{answer}");
    }
    for answer in [
        "Don't try again.",
        "no",
        "Stop.",
        "yes, but not now",
        "try the other one again",
        "I don't want you to try again",
        "okay, forget it",
        "Sure, bring me the apple.",
        "Try again later.",
        "If you would wait.",
        "I can't do it myself.",
        "never again",
        "you can let it be",
        "you may give up",
        "would you bring me the apple?",
        "it is in the fridge",
        "on the right",
        "what did you do again?",
        "I don't think so.",
        "good",
        "not a good idea",
        "I'll do it.",
        "Let me try again.",
        "I'll do it myself",
    ] {
        assert_eq!(request::encourages(answer), None, "{answer}");
    }
}

/// Where an answer says that the coke is.
fn told(answer: &str) -> Vec<String> {
    let scene = setup::scene("kitchen");
    let situation = Situation { spoken_of: vec!["coke".into()], ..Situation::new(&scene) };
    let told = request::told(answer, &situation);
    told.iter().map(|one| format!("{} {}", one.relation, one.place)).collect()
}

#[test]
fn where_a_thing_is_is_told_in_many_ways() {
    for answer in [
        "Isn't it in the fridge?",
        "My wife tells me it's in the fridge now.",
        "Uh, should be in the fridge, I guess",
        "Did you check in the fridge? That's where I saw it last.",
        "We always keep it in the fridge, so look there.",
        "I could have sworn I left it in the fridge, dear.",
        "Chances are it's in the fridge.",
        "Hang on, let me think. Yes, in the fridge, that's where it is.",
        "It is in the fridge, yes, I see it there before.",
        "Sorry, my fault, I moved it. It's in the fridge now.",
        "It's where it always is, in the fridge.",
        "Dunno, probably in the fridge?",
        "I believe it was last seen in the fridge.",
        "Did you check in the fridge? It must be there.",
        "Oh, it should be in the fridge, dear, that's where I put it this morning.",
        "I saw it in the fridge a minute ago.",
        "You will find it in the fridge.",
        "Didn't you check in the fridge? That's where it is.",
        "It's probably still in the fridge from this morning.",
        "My best guess would be in the fridge.",
        "There's a good chance it's in the fridge.",
        "I'd look in the fridge if I were you.",
        "It's got to be in the fridge.",
        "I saw somebody put it in the fridge.",
        "I remember leaving it in the fridge.",
        "If I'm not mistaken, it's in the fridge.",
        "Last I checked it was in the fridge.",
        "You might want to look in the fridge.",
        "See if it's in the fridge.",
    ] {
        assert_eq!(told(answer), ["in fridge_1"], "{answer}");
    }
    for answer in [
        "It isn't in the fridge.",
        "Is the fridge open?",
        "I did not put it in the fridge.",
        "Don't look in the fridge.",
        "I looked in the fridge, but it isn't there.",
        "Put it in the fridge.",
        "It used to be in the fridge, but not any more.",
        "It isn't in the fridge if I remember correctly.",
    ] {
        assert!(told(answer).is_empty(), "{answer}: {:?}", told(answer));
    }
}

#[test]
fn what_is_asked_for_in_passing_is_done() {
    mean(
        &["not open(fridge_1)"],
        &[
            "Would you mind if I asked you to close the fridge?",
            "Would it be an awful bother to close the fridge?",
            "Would it be any trouble to close the fridge?",
            "Gonnae close the fridge?",
            "Close the fridge as you go past.",
            "Did I leave the fridge open? Be a dear and close it for me.",
            "Have I left the fridge open? Please shut it.",
        ],
    );
    mean(
        &["at(robot, sink)"],
        &["Off you trot to the sink, there's a good robot.", "Off you go over to the sink."],
    );
    mean(&["on(sponge, counter)"], &["Once you've got hold of the sponge, put it on the counter."]);
    not_taken(&[
        "Would you mind if I closed the fridge?",
        "Would it be a bother if I closed the fridge?",
        "Gonnae no close the fridge?",
        "Close the fridge as you leave the room.",
        "Did I leave the fridge open?",
        "Did I leave the fridge open? Then close it.",
        "Did I ask you to bring me the coke?",
        "Off you trot.",
        "Once you've got hold of the plumber, put the sponge on the counter.",
    ]);
}

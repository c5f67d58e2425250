//! What is said around a request out of politeness, or for a reason, is passed over.

use super::{mean, not_taken};

#[test]
fn request_whom_one_speaks_to_and_what_one_thinks_meanwhile_is_passed_over() {
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
fn request_reasons_stand_before_or_behind_what_is_asked_for() {
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
fn request_who_is_asked_may_be_anyone_and_how_may_be_said() {
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
fn request_what_is_asked_for_in_passing_is_done() {
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

#[test]
fn request_how_people_ask_is_composed_and_no_table() {
    mean(
        &["at(coke, user)"],
        &[
            "I was rather hoping you might be able to bring me the coke.",
            "It would mean the world to me if you'd fetch the coke.",
            "Would you happen to be free to bring me the coke?",
            "I don't suppose you could bring me the coke?",
            "Could you see your way to fetching the coke for me?",
            "Robot dear, would you mind terribly fetching me the coke?",
            "I'd be over the moon... I mean, could you bring me the coke?",
            "It'd be ever so kind if you brought me the coke.",
            "Is there any chance at all that someone could bring me the coke?",
            "Do me a quick favour: bring me the coke.",
            "Drop whatever you're doing and bring me the coke.",
            "While you're on your feet, could you get me the coke?",
            "You, robot, fetch me the coke. Now.",
            "Somebody bring me the coke, for crying out loud!",
            "Don't just stand there, bring me the coke!",
            "Give me the coke or I'll scream!",
        ],
    );
    mean(&["on(sponge, counter)"], &["Would you mind very much popping the sponge on the counter?"]);
    mean(&["holding(sponge)"], &["Would you mind picking the sponge up and hanging on to it till I say?"]);
    not_taken(&[
        "I wonder if I can get the coke open.",
        "I was glad you could bring me the coke.",
        "You could have brought me the coke.",
        "It's nice of you to bring me the coke.",
        "It would be nice if you didn't open the fridge.",
        "Would you please not open the fridge?",
        "Could you not open the fridge?",
        "I'd prefer you not to open the fridge.",
        "What would you bring me?",
        "Where would you put the sponge?",
        "Would it be okay if I opened the fridge?",
        "Anyone can open the fridge.",
        "Someone should close the fridge.",
        "You would open the fridge if you could.",
        "Somebody closed the fridge.",
        "Bring me the coke or the sponge.",
        "Thanks for closing the fridge.",
        "You are opening the fridge.",
        "I mind opening the fridge.",
        "I was opening the fridge.",
        "You have one minute to decide.",
        "I told you not to close the fridge.",
        "Help me with the drawer.",
        "Go to the sink? No.",
    ]);
    mean(
        &["not open(fridge_1)"],
        &[
            "Give me a hand closing the fridge.",
            "I could use some help closing the fridge.",
            "You have two seconds to close the fridge.",
            "I thought I told you to close the fridge.",
            "Would you be amenable to closing the fridge?",
            "It's about time somebody closed the fridge.",
            "Get off your backside and close the fridge.",
            "Have someone close the fridge.",
        ],
    );
}

#[test]
fn request_why_and_by_when_is_passed_over_and_a_condition_is_not() {
    mean(
        &["on(sponge, counter)"],
        &[
            "Put the sponge on the counter so the dog can't get it.",
            "Put the sponge on the counter so nobody trips over it.",
            "Put the sponge on the counter while I finish this call.",
            "Put the sponge on the counter before Granny arrives.",
            "Put the sponge on the counter, it stinks.",
            "Put the sponge on the counter, not lying about.",
            "Put the sponge on the counter right this minute, would you mate.",
            "Er, let's see... put the sponge on the counter, yes, that'll do.",
            "Be careful with the sponge and put it on the counter.",
            "Wouldn't the sponge look nice on the counter? Put it there for me.",
            "The sponge - put it on the counter, would you?",
            "Before we go out I want the sponge put on the counter.",
        ],
    );
    not_taken(&[
        "Put the sponge on the counter when nobody's looking.",
        "Put the sponge on the counter unless it stinks.",
        "Put the sponge in the drawer before opening the fridge.",
        "Put the sponge on the counter so you can close the fridge.",
        "Be careful with the sponge.",
        "Wouldn't the sponge look nice on the counter?",
        "Put the sponge on the counter, I mean the mug.",
        "Before we go out close it.",
    ]);
}

//! What somebody answers who was asked where a thing is, or whether to try again.

use motet_requests::{PendingQuestion, RequestContext};
use motet_tests::setup;

#[test]
fn answer_who_wants_another_try_says_so_in_many_ways() {
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
        "Er, I suppose so, we're in no rush.",
        "Keep trying till you get it.",
        "Another try won't hurt.",
        "You can do better than that. Try again.",
        "Aw, so close! Again!",
        "Uh-huh!",
        "Mm-hm.",
        "Right you are.",
        "I don't see why not.",
        "Oh dear. No harm done, just do it over.",
    ] {
        assert_eq!(motet_requests::encourages(answer).as_deref().map(str::trim), Some(""), "{answer}");
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
        "I tried again.",
        "Did you try again?",
        "Another try won't help.",
        "Try opening the fridge again.",
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
        assert_eq!(motet_requests::encourages(answer), None, "{answer}");
    }
}

/// Where an answer says that the coke is.
fn told(answer: &str) -> Vec<String> {
    let scene = setup::scene("kitchen");
    let situation = RequestContext { spoken_of: vec!["coke".into()], ..RequestContext::new(&scene) };
    let told = motet_requests::told(answer, PendingQuestion::Where, &situation);
    told.iter().map(|one| format!("{} {}", one.relation, one.place)).collect()
}

#[test]
fn answer_where_a_thing_is_is_told_in_many_ways() {
    for answer in [
        "Isn't it in the fridge?",
        "Tommy put it in the fridge, I saw him do it!",
        "Grandpa had it in the fridge.",
        "You'll see it in the fridge.",
        "The coke lives in the fridge.",
        "The last place I had it was in the fridge.",
        "It might have been put in the fridge.",
        "Wasn't it in the fridge?",
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
        "Tommy put nothing in the fridge.",
        "You won't see it in the fridge.",
        "The fridge lives in the kitchen.",
        "It isn't in the fridge.",
        "Is the fridge open?",
        "I did not put it in the fridge.",
        "Don't look in the fridge.",
        "I looked in the fridge, but it isn't there.",
        "Put it in the fridge.",
        "Open the fridge.",
        "Go to the fridge.",
        "Drive to the kitchen counter, please.",
        "It used to be in the fridge, but not any more.",
        "It isn't in the fridge if I remember correctly.",
    ] {
        assert!(told(answer).is_empty(), "{answer}: {:?}", told(answer));
    }
}

//! What somebody says who wants to have something: `I could do with`, `I'd quite fancy having`, `any chance I might get`.

use super::asking::before_speaker;
use super::token::{Token, longest, run};

/// What someone says who wants to have something.
const WANTS: &[&str] = &[
    "i could do with having",
    "i should like to have",
    "i should like",
    "i am needing",
    "i am wanting",
    "i would like to have",
    "i would like to get",
    "i would like",
    "i would love",
    "i want to have",
    "i want",
    "i need",
    "i could use",
    "i will have",
    "i will take",
    "i could do with",
    "i will need",
    "i am going to need",
    "i feel like having",
    "i feel like",
    "i fancy having",
    "i fancy",
    "i would love to have",
    "i would love to get",
    "i would like to get hold of",
    "i would not mind having",
    "i would not mind",
    "i want to get",
    "i wish to have",
    "i wish for",
    "i am after",
    "let me have",
    "let us have",
    "let me get",
    "may we have",
    "may i get",
    "might i have",
    "could i please have",
    "can i please have",
    "may i please have",
    "could i have",
    "could i get",
    "can i have",
    "can i get",
    "may i have",
    "can we have",
    "could we have",
    "we need",
    "we want",
    "we would like",
    "i need to have",
    "i would kill for",
    "i really need",
    "let me hold",
    "can we get",
    "could we get",
    "i am ready for",
    "i am in need of",
    "i am in want of",
    "i am dying for",
    "i am desperate for",
    "i could murder",
    "i require",
    "we require",
    "me want",
    "me need",
    "me wants",
    "what i need is",
    "the thing i want is",
    "the thing i would like is",
    "the only thing i need is",
    "the only thing i want is",
    "what i want is",
    "what i would like is",
    "what i am after is",
    "all i need is",
    "all i want is",
    "all i ask for is",
    "the thing i need is",
    "i am longing for",
    "i am craving",
    "i have been craving",
    "i would give anything for",
    "may i trouble you for",
    "can i trouble you for",
    "could i trouble you for",
    "might i trouble you for",
    "may i ask you for",
    "can i ask you for",
    "could i ask you for",
    "can i bother you for",
    "could i bother you for",
    "might i bother you for",
    "let me get hold of",
    "let me get a hold of",
    "let me have a hold of",
    "i could do with",
    "we could do with",
    "we could use",
    "we are after",
];
/// Before these somebody asks whether they can have something, which asks for it.
const MAY_I: &[&str] = &[
    "any chance",
    "any chance that",
    "is there any chance",
    "is there any chance that",
    "is there a chance",
    "do you think",
    "do you reckon",
    "do you suppose",
    "you think",
    "i wonder if",
    "i wonder whether",
    "i was wondering if",
    "i was wondering whether",
    "i am wondering if",
    "i was hoping",
    "i was hoping that",
    "i am hoping",
    "i hope",
    "would it be okay if",
    "would it be ok if",
    "would it be all right if",
    "would it be possible that",
    "is it okay if",
    "is it possible that",
];
/// What they then ask for stands behind these.
const HAVE: &[&str] = &[
    "i could have",
    "i can have",
    "i might have",
    "i may have",
    "i could get",
    "i can get",
    "i could possibly have",
    "i could please have",
    "we could have",
    "we can have",
    "i had",
    "i could borrow",
    "i can borrow",
];

/// How many words a wish takes at a place, behind which stands what somebody wants to have.
pub(super) fn wish(tokens: &[Token], at: usize) -> Option<usize> {
    let asked = longest(tokens, at, MAY_I).and_then(|may| Some(may + longest(tokens, at + may, HAVE)?));
    // `would it be possible to have the coke`, `any chance of the coke`
    let have = [
        "would it be possible to have",
        "would it be possible to get",
        "is it possible to have",
        "any chance of having",
        "any chance of",
    ];
    let chance = longest(tokens, at, &have).filter(|count| {
        !tokens.get(at + count).is_some_and(|token| token.word() == "you" || token.word().ends_with("ing"))
    });
    let found = longest(tokens, at, WANTS).max(asked).max(chance);
    found
        .max(cleft(tokens, at))
        .max(wants(tokens, at))
        .max(curt(tokens, at))
        .max(happier(tokens, at))
        .max(may_have(tokens, at))
}

/// Between who wants something and the verb.
const HOW: &[&str] = &[
    "would",
    "could",
    "will",
    "do",
    "am",
    "should",
    "shall",
    "might",
    "just",
    "also",
    "really",
    "quite",
    "rather",
    "very much",
    "so very much",
    "ever so much",
    "so much",
    "sure",
    "certainly",
    "so",
    "still",
    "now",
    "absolutely",
    "dearly",
    "sorely",
    "about",
    "just about",
    "badly",
    "desperately",
    "definitely",
    "simply",
    "have to",
    "must",
    "even",
    "only",
    "honestly",
    "totally",
    "always",
    "kind of",
    "sort of",
    "think i",
    "think i would",
    "believe i would",
    "guess i",
    "suppose i",
    "suppose i would",
    "was hoping i",
];
/// Verbs of wanting, whatever stands before them.
const NEEDS: &[&str] = &[
    "need",
    "want",
    "require",
    "fancy",
    "desire",
    "crave",
    "am after",
    "am in need of",
    "am in want of",
    "am gasping for",
    "am in the mood for",
    "am going to need",
    "am going to want",
    "am longing for",
    "am yearning for",
    "am aching for",
    "am begging for",
    "in need of",
    "in want of",
    "gasping for",
    "dying for",
    "desperate for",
    "longing for",
    "after",
    "craving",
    "going to need",
    "going to want",
    "going to be needing",
    "needing",
    "wanting",
    "be needing",
    "be wanting",
    "feel like",
    "wish to have",
    "wish for",
    "got to have",
    "have to have",
    "must have",
];
/// The same only behind `would` or `could`.
const WOULD: &[&str] = &[
    "like",
    "love",
    "adore",
    "appreciate",
    "use",
    "do with",
    "kill for",
    "murder",
    "go for",
    "not mind",
    "not say no to",
    "not object to",
    "not turn down",
    "never say no to",
    "give anything for",
    "give my right arm for",
    "give a lot for",
    "be glad of",
    "be glad to have",
    "be happy to have",
    "be grateful for",
    "be most grateful for",
    "be very grateful for",
    "be so grateful for",
    "be ever so grateful for",
    "be much obliged for",
    "be obliged for",
    "be most obliged for",
    "be thankful for",
    "be very glad of",
    "be delighted with",
    "welcome",
    "enjoy",
    "be needing",
    "be wanting",
    "prefer",
    "like the use of",
    "be up for",
    "gladly have",
    "happily have",
    "appreciate it if i had",
];
/// What may follow before the thing.
const TO_HAVE: &[&str] = &[
    "to have",
    "to get",
    "having",
    "to have back",
    "to be given",
    "to be handed",
    "to be brought",
    "to hold",
    "to get hold of",
    "to get a hold of",
    "to get my hands on",
    "to borrow",
    "to have a hold of",
];

/// `what I need in my hand right now is`
fn cleft(tokens: &[Token], at: usize) -> Option<usize> {
    let what = [
        "what",
        "all",
        "the thing",
        "the only thing",
        "the one thing",
        "one thing",
        "all that",
        "the thing that",
        "the very thing",
    ];
    let who = at + longest(tokens, at, &what)?;
    let end = who + wants(tokens, who)?;
    let now = [
        "in my hand",
        "in my hands",
        "over here",
        "here",
        "most",
        "most of all",
        "next",
        "now",
        "with me",
        "beside me",
        "by my side",
        "more than anything",
        "at the moment",
        "today",
        "for this",
        "for that",
        "from you",
        "just",
        "in here",
        "badly",
        "first",
    ];
    let end = end + run(tokens, end, &now);
    Some(end + longest(tokens, end, &["is", "would be", "is to have"])? - at)
}

/// `I'd quite like to have`, `we could really use`
fn wants(tokens: &[Token], at: usize) -> Option<usize> {
    let who = longest(tokens, at, &["i", "we", "me", "all i", "this old lady", "this old man"])?;
    let how = run(tokens, at + who, HOW);
    let verb = at + who + how;
    let said = tokens.get(at..verb)?;
    // `I did not want`, `I do not want` are no wishes: the `not` stands in no table but with what it asks for.
    let is_would = said.iter().any(|token| matches!(token.word(), "would" | "could" | "should"));
    let would = longest(tokens, verb, WOULD).filter(|_| is_would);
    let end = verb + longest(tokens, verb, NEEDS).max(would)?;
    Some(end + longest(tokens, end, TO_HAVE).unwrap_or(0) - at)
}

/// `need the coke`, `could do with a drink`: without who wants it, as somebody says in a hurry.
fn curt(tokens: &[Token], at: usize) -> Option<usize> {
    let before = at.checked_sub(1).and_then(|at| tokens.get(at));
    let begins = matches!(before, None | Some(Token::Comma | Token::Stop))
        || before
            .is_some_and(|token| matches!(token.word(), "please" | "hey" | "so" | "robot" | "and" | "just"));
    let words = [
        "need",
        "really need",
        "just need",
        "badly need",
        "want",
        "would like",
        "would love",
        "could use",
        "could do with",
        "could really do with",
        "could really use",
        "would not mind",
        "would not say no to",
        "going to need",
        "desperate for",
        "dying for",
        "gasping for",
        "in need of",
        "in desperate need of",
        "require",
        "requiring",
        "needing",
        "wanting",
        "fancy having",
    ];
    longest(tokens, at, &words).filter(|_| begins)
}

/// `I'd feel safer with`, `it would be nicer to have`: what is wanted is told behind it.
fn happier(tokens: &[Token], at: usize) -> Option<usize> {
    let mut end = at
        + longest(
            tokens,
            at,
            &["i would", "we would", "it would", "it will", "that would", "it is", "would it"],
        )?;
    let begin = end;
    let how = [
        "be",
        "feel",
        "sleep",
        "rest",
        "look",
        "work",
        "a lot",
        "a bit",
        "much",
        "far",
        "so much",
        "so",
        "even",
        "really",
        "very",
        "all",
        "the",
        "most",
        "happier",
        "safer",
        "better",
        "easier",
        "calmer",
        "nicer",
        "neater",
        "tidier",
        "more comfortable",
        "more at ease",
        "comfortable",
        "happy",
        "glad",
        "great",
        "lovely",
        "good",
        "nice",
        "wonderful",
        "grand",
        "handy",
        "useful",
        "helpful",
        "perfect",
        "ideal",
        "fantastic",
        "brilliant",
        "delighted",
        "pleased",
        "grateful",
        "best",
        "possible",
        "okay",
        "ok",
        "dead",
        "for me",
        "for us",
        "a relief",
        "a great help",
        "a big help",
        "a help",
        "a treat",
        "prefer it",
        "like it best",
        "like it better",
        "love it",
    ];
    end += run(tokens, end, &how);
    if end == begin {
        return None;
    }
    Some(end + longest(tokens, end, &["with", "having", "to have", "to see", "to get"])? - at)
}

/// `is there any way I might have`, `could I perhaps get`, `can we please be given`
fn may_have(tokens: &[Token], at: usize) -> Option<usize> {
    let end = at + before_speaker(tokens, at)?;
    let have = [
        "have",
        "get",
        "borrow",
        "be given",
        "be handed",
        "be passed",
        "be brought",
        "have back",
        "get back",
        "get hold of",
        "trouble you for",
        "bother you for",
        "ask you for",
        "pester you for",
        "beg you for",
        "get my hands on",
        "take delivery of",
        "hold",
    ];
    Some(end + longest(tokens, end, &have)? - at)
}

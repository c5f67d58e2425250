//! What stands before a verb out of politeness, and what someone says who wants to have something.

use super::lexicon::VERBS;
use super::opening::LEADS;
use super::token::{Token, longest, run, stands};

/// What someone says who wants to have something.
pub(super) const WANTS: &[&str] = &[
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
    longest(tokens, at, WANTS).max(asked).max(chance)
}

/// Where the request itself begins.
pub(super) fn skip_leads(tokens: &[Token], mut at: usize) -> usize {
    loop {
        if contrasts(tokens, at) {
            return at;
        }
        // `you know what to do` asks for nothing, `no need to` and `gonnae no` for the contrary.
        let knows = longest(tokens, at, &["you know what to", "no need to", "gonnae no"]).is_some();
        let lead = longest(tokens, at, LEADS)
            .max(asked(tokens, at))
            .filter(|_| !knows)
            .or_else(|| be_kind(tokens, at));
        // `let us have the coke` is a wish, and no `let us`.
        let want = wish(tokens, at);
        // `hang on to it` is no `hang on`.
        let verb = VERBS.iter().filter_map(|(verb, _)| stands(tokens, at, verb)).max();
        match lead.filter(|lead| want.max(verb).is_none_or(|longer| longer <= *lead)) {
            Some(count) => at += count,
            None if matches!(tokens.get(at), Some(Token::Comma)) => at += 1,
            None => return at,
        }
    }
}

/// `can somebody`, `would one of you`, `will not you`, `would it bother you to`: how many words it takes.
fn asked(tokens: &[Token], at: usize) -> Option<usize> {
    // `I was wondering whether you would be able to`
    let wonder = longest(
        tokens,
        at,
        &[
            "i wonder",
            "i was wondering",
            "i am wondering",
            "i was just wondering",
            "wondering",
            "just wondering",
        ],
    );
    if let Some(count) = wonder {
        let end = at + count;
        let end = end
            + longest(
                tokens,
                end,
                &[
                    "if you",
                    "whether you",
                    "if somebody",
                    "if someone",
                    "whether somebody",
                    "whether someone",
                    "if anyone",
                    "if anybody",
                ],
            )?;
        let end = end + longest(tokens, end, &["could", "can", "would", "might", "will"])?;
        let able = [
            "be able to",
            "be willing to",
            "be so kind as to",
            "be so good as to",
            "possibly",
            "maybe",
            "perhaps",
            "please",
            "kindly",
            "just",
        ];
        return Some(end + longest(tokens, end, &able).unwrap_or(0) - at);
    }
    let can = longest(tokens, at, &["can", "could", "would", "will", "might"])?;
    // `can we throw it away?`
    if let (Some(count), true) =
        (stands(tokens, at + can, "we"), can == 1 && longest(tokens, at, &["can", "could"]).is_some())
    {
        return Some(
            can + count + longest(tokens, at + can + count, &["please", "just", "maybe"]).unwrap_or(0),
        );
    }
    if stands(tokens, at + can, "it").is_some() {
        let bother = [
            "trouble",
            "bother",
            "kill",
            "hurt",
            "inconvenience",
            "be too much trouble",
            "be too much to ask",
            "be a bother",
            "be an awful bother",
            "be a terrible bother",
            "be too much bother",
            "be any bother",
            "be any trouble",
            "be a nuisance",
            "be an awful nuisance",
            "be an imposition",
        ];
        let mut end = at + can + 1;
        end += longest(tokens, end, &bother)?;
        end += longest(tokens, end, &["for you", "you"]).unwrap_or(0);
        end += longest(tokens, end, &["too much", "very much", "terribly", "much"]).unwrap_or(0);
        return Some(end + stands(tokens, end, "to")? - at);
    }
    // `could not you`: the `not` stands before who is asked, or it is no request.
    let not = stands(tokens, at + can, "not").unwrap_or(0);
    let who = [
        "you",
        "somebody",
        "someone",
        "anybody",
        "anyone",
        "one of you",
        "you guys",
        "you maybe",
        "you perhaps",
    ];
    let who = longest(tokens, at + can + not, &who)?;
    let how = [
        "please",
        "kindly",
        "just",
        "also",
        "quickly",
        "then",
        "go ahead and",
        "try to",
        "manage to",
        "be able to",
        "help me to",
    ];
    let mut end = at + can + not + who;
    end += run(tokens, end, &how);
    Some(end - at)
}

/// `be a dear and`, `be an absolute angel and`, `be so good as to`: how many words it takes.
fn be_kind(tokens: &[Token], at: usize) -> Option<usize> {
    const KIND: &[&str] = &[
        "a",
        "an",
        "so",
        "very",
        "such",
        "my",
        "little",
        "absolute",
        "real",
        "good",
        "nice",
        "kind",
        "helpful",
        "useful",
        "dear",
        "love",
        "darling",
        "angel",
        "sweetheart",
        "sweetie",
        "pal",
        "mate",
        "friend",
        "sport",
        "star",
        "hero",
        "lamb",
        "treasure",
        "gem",
        "boy",
        "girl",
        "lad",
        "robot",
        "helper",
        "doll",
        "pet",
        "champ",
        "buddy",
        "saint",
    ];
    let mut end = at + stands(tokens, at, "be")?;
    let begin = end;
    while tokens.get(end).is_some_and(|token| KIND.contains(&token.word())) {
        end += 1;
    }
    let joint = longest(tokens, end, &["as to", "and"])?;
    (end > begin).then_some(end + joint - at)
}

/// How many words of thanks and the like stand at a place.
pub(super) fn thanks(tokens: &[Token], at: usize) -> Option<usize> {
    if contrasts(tokens, at) {
        return None;
    }
    let soft = [
        "thank you very much",
        "thank you so much",
        "thank you",
        "thanks a lot",
        "thanks",
        "that would be great",
        "that would be nice",
        "if possible",
        "if you can",
        "if you could",
        "when you have time",
        "right away",
        "immediately",
        "again",
        "as soon as possible",
        "for me",
        "when you can",
        "if you would",
        "quickly",
        "now",
        "too",
        "as well",
        "yet",
        "myself",
        "please",
        "today",
        "instead",
        "rather",
    ];
    longest(tokens, at, &soft)
}

/// `instead of the wrench`, `rather than there`: what follows is not wanted.
pub(super) fn contrasts(tokens: &[Token], at: usize) -> bool {
    longest(tokens, at, &["instead of", "rather than", "and not", "but not", "in place of", "in lieu of"])
        .is_some()
}

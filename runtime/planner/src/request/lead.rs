//! What stands before a verb out of politeness, and what someone says who wants to have something.

use super::opening::LEADS;
use super::token::{Token, longest, stands};
use super::verb::VERBS;

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
];

/// Where the request itself begins.
pub(super) fn skip_leads(tokens: &[Token], mut at: usize) -> usize {
    loop {
        if contrasts(tokens, at) {
            return at;
        }
        let lead = longest(tokens, at, LEADS).or_else(|| be_kind(tokens, at));
        // `let us have the coke` is a wish, and no `let us`.
        let want = longest(tokens, at, WANTS);
        // `hang on to it` is no `hang on`.
        let verb = VERBS.iter().filter_map(|(verb, _)| stands(tokens, at, verb)).max();
        match lead.filter(|lead| want.max(verb).is_none_or(|longer| longer <= *lead)) {
            Some(count) => at += count,
            None if matches!(tokens.get(at), Some(Token::Comma)) => at += 1,
            None => return at,
        }
    }
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

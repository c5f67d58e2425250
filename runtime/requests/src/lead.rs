//! What stands before a verb out of politeness, and what someone says who wants to have something.

use super::asking::asking;
use super::lexicon::VERBS;
use super::opening::LEADS;
use super::token::{Token, longest, run, stands};
use super::wish::wish;

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
            .max(asking(tokens, at))
            .filter(|_| !knows)
            .or_else(|| be_kind(tokens, at))
            .or_else(|| does_a_favour(tokens, at));
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

/// `do me a quick favour and`, `do your old mum a kindness`: how many words it takes.
fn does_a_favour(tokens: &[Token], at: usize) -> Option<usize> {
    let mut end =
        at + longest(tokens, at, &["do", "could you do", "would you do", "can you do", "will you do"])?;
    end += longest(
        tokens,
        end,
        &[
            "me",
            "us",
            "your old mum",
            "an old man",
            "an old woman",
            "an old lady",
            "your granny",
            "mummy",
            "grandma",
            "grandpa",
        ],
    )?;
    end += longest(tokens, end, &["a", "this", "one", "the", "this one", "just one", "another"])?;
    end += run(
        tokens,
        end,
        &[
            "quick", "little", "small", "big", "huge", "tiny", "wee", "great", "massive", "enormous",
            "special", "last", "one", "teeny",
        ],
    );
    end += longest(tokens, end, &["favour", "favor", "kindness", "solid", "service", "good turn"])?;
    end += longest(tokens, end, &["would you", "will you", "please", "could you"]).unwrap_or(0);
    end += longest(tokens, end, &["and"]).unwrap_or(0);
    // `do me a favour by opening it` is read with its verb.
    stands(tokens, end, "by").is_none().then_some(end - at)
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
        "show me",
        "show me what you can do",
        "show me how it is done",
        "ready",
        "at the ready",
        "ready and waiting",
        "all ready",
        "here we go",
        "easy does it",
        "quick",
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

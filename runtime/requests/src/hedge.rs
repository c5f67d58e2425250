//! How sure somebody is of what they say, and when they last knew: `I am fairly sure that`, `chances are`, `last I checked`.

use super::token::{Token, longest, run, stands};

/// How many words of it stand before what is told.
pub(super) fn before(tokens: &[Token], at: usize) -> Option<usize> {
    let count = believes(tokens, at)
        .or_else(|| sure(tokens, at))
        .or_else(|| guess(tokens, at))
        .or_else(|| chance(tokens, at))
        .or_else(|| knew(tokens, at))?;
    let that = longest(tokens, at + count, &["that", "is that"]).unwrap_or(0);
    // `I am sure that is it` points at something.
    let points =
        stands(tokens, at + count, "that is").is_some() && stands(tokens, at + count, "that is in").is_none();
    Some(if points { count } else { count + that })
}

/// `I would guess`, `we reckon`
fn believes(tokens: &[Token], at: usize) -> Option<usize> {
    let mut end = at + longest(tokens, at, &["i", "we"])?;
    let how = [
        "would",
        "could",
        "can",
        "do",
        "just",
        "almost",
        "still",
        "rather",
        "have to",
        "must",
        "dare",
        "am going to",
        "will",
        "would have to",
        "am inclined to",
        "seem to",
        "vaguely",
        "distinctly",
        "clearly",
        "really",
        "certainly",
        "strongly",
    ];
    end += run(tokens, end, &how);
    let says = [
        "think",
        "guess",
        "believe",
        "suppose",
        "reckon",
        "bet",
        "suspect",
        "imagine",
        "assume",
        "presume",
        "expect",
        "figure",
        "fancy",
        "say",
        "swear",
        "wager",
        "sworn",
        "have sworn",
        "have thought",
        "thought",
        "have guessed",
        "have said",
        "had a feeling",
        "have a feeling",
        "have a hunch",
        "have the feeling",
        "feel",
        "recall",
        "remember",
        "put money on it",
        "seem to remember",
        "seem to recall",
        "gather",
        "understand",
        "venture",
        "know",
        "see",
        "notice",
    ];
    Some(end + longest(tokens, end, &says)? - at)
}

/// `I am fairly sure`, `pretty sure`
fn sure(tokens: &[Token], at: usize) -> Option<usize> {
    let mut end = at + longest(tokens, at, &["i am", "we are"]).unwrap_or(0);
    let how = [
        "pretty",
        "fairly",
        "quite",
        "very",
        "almost",
        "rather",
        "absolutely",
        "reasonably",
        "relatively",
        "completely",
        "nearly",
        "a hundred percent",
        "100 percent",
        "100",
        "dead",
        "damn",
        "so",
        "totally",
        "positively",
    ];
    end += run(tokens, end, &how);
    Some(
        end + longest(tokens, end, &["sure", "certain", "positive", "confident", "convinced", "afraid"])?
            - at,
    )
}

/// `my best guess is`, `my money is on it being`
fn guess(tokens: &[Token], at: usize) -> Option<usize> {
    let mut end = at + longest(tokens, at, &["my", "the", "a", "at a", "if i had to"])?;
    end += longest(tokens, end, &["best", "first", "good", "wild", "only"]).unwrap_or(0);
    end +=
        longest(tokens, end, &["guess", "bet", "hunch", "feeling", "assumption", "impression", "instinct"])?;
    Some(end + longest(tokens, end, &["would be", "is", "says", "tells me"]).unwrap_or(0) - at)
}

/// `chances are`, `there is a good chance`
fn chance(tokens: &[Token], at: usize) -> Option<usize> {
    let whole = [
        "chances are",
        "odds are",
        "it could well be",
        "it may well be",
        "it may be",
        "it might be",
        "it could be",
        "it is possible",
        "it is likely",
        "it is very likely",
        "it is quite likely",
        "it seems",
        "it seems to me",
        "it looks like",
        "looks like",
        "could be",
        "may be",
        "might be",
        "most likely",
        "very likely",
        "more than likely",
        "in all likelihood",
        "likely",
    ];
    let told = longest(tokens, at, &whole).filter(|count| {
        // `it might be in the fridge` tells it itself.
        tokens
            .get(at + count)
            .is_some_and(|token| matches!(token.word(), "it" | "that" | "the" | "somebody" | "someone"))
    });
    if told.is_some() {
        return told;
    }
    let mut end = at + longest(tokens, at, &["there is", "there might be", "there may be"]).unwrap_or(0);
    end += stands(tokens, end, "a")?;
    end += longest(tokens, end, &["very good", "good", "fair", "decent", "high", "real", "strong", "big"])
        .unwrap_or(0);
    Some(end + longest(tokens, end, &["chance", "possibility", "probability", "likelihood"])? - at)
}

/// `as far as I know`, `last I checked`, `if I am not mistaken`, `yesterday`
fn knew(tokens: &[Token], at: usize) -> Option<usize> {
    let whole = [
        "if memory serves",
        "if memory serves me right",
        "if memory serves me well",
        "if memory serves me correctly",
        "to my knowledge",
        "to the best of my knowledge",
        "from memory",
        "from what i remember",
        "from what i can tell",
        "from what i know",
        "from what i can see",
        "from here i can see",
        "by the looks of it",
        "by the look of it",
        "unless i am mistaken",
        "unless i am wrong",
        "unless somebody moved it",
        "unless someone moved it",
        "for all i know",
        "yesterday",
        "this morning",
        "earlier",
        "earlier today",
        "a minute ago",
        "a moment ago",
        "just now",
        "last night",
        "the other day",
        "normally",
        "usually",
        "ordinarily",
        "generally",
        "as usual",
        "as always",
        "in that case",
        "in fact",
        "in my opinion",
        "by now",
        "i have just seen",
        "let me see",
        "let me think",
        "come to think of it",
        "now that i think of it",
        "now that i think about it",
        "now that you ask",
        "you know",
        "you see",
        "hang on",
        "wait",
        "hold on",
        "one moment",
        "it must be that",
        "it has to be that",
        "oh right",
        "ah yes",
        "of course",
    ];
    if let Some(count) = longest(tokens, at, &whole) {
        return Some(count);
    }
    if let Some(count) = longest(tokens, at, &["if i", "as far as i"]) {
        let end = at + count;
        let not = longest(tokens, end, &["am not"]).unwrap_or(0);
        let end = end + not;
        let end = end
            + longest(
                tokens,
                end,
                &[
                    "remember",
                    "recall",
                    "mistaken",
                    "wrong",
                    "know",
                    "can tell",
                    "can see",
                    "had to guess",
                    "am concerned",
                    "am aware",
                ],
            )?;
        return Some(
            end + longest(tokens, end, &["right", "correctly", "rightly", "well", "it right"]).unwrap_or(0)
                - at,
        );
    }
    // `last time I looked`
    let mut end = at + longest(tokens, at, &["the last time", "last time", "when", "the last", "last"])?;
    end += stands(tokens, end, "i").or_else(|| stands(tokens, end, "we"))?;
    end += stands(tokens, end, "last").unwrap_or(0);
    end += longest(
        tokens,
        end,
        &[
            "checked",
            "looked",
            "saw",
            "saw it",
            "knew",
            "remember",
            "heard",
            "used it",
            "had it",
            "was there",
            "needed it",
            "passed by",
            "noticed",
            "walked by",
            "went by",
        ],
    )?;
    Some(end - at)
}

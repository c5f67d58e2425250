//! How people ask whether somebody would do something: `I was wondering whether you might possibly`, `it would be a great help
//! if you could`, `do you think you'd be able to`. A grammar of what is composed there, since no table has all of it.
//!
//! Words of wishing, thinking and politeness lead up to who is asked and the modal verb; none of them denies or bounds
//! anything. Those that do, `not`, `unless`, `when`, are no part of it but in a few phrases that ask for the contrary of
//! what they say.

use super::inflection::{Form, base, of_past};
use super::token::{Token, longest, run};

/// Words before who is asked, and around.
const OPEN: &[&str] = &[
    "i",
    "we",
    "it",
    "that",
    "there",
    "this",
    "how about",
    "what about",
    "could i get",
    "can i get",
    "could we get",
    "would",
    "could",
    "can",
    "might",
    "may",
    "will",
    "is",
    "are",
    "am",
    "be",
    "do",
    "if",
    "whether",
    "so",
    "as",
    "to",
    "for",
    "of",
    "and",
    "a",
    "an",
    "the",
    "my",
    "me",
    "us",
    "you",
    "your",
    "one",
    "at all",
    "in the world",
    "slightest",
    "remotest",
    "earthly",
    "by any chance",
    "thing",
    "any",
    "some",
    "all",
    "only",
    "just",
    "please",
    "kindly",
    "maybe",
    "perhaps",
    "possibly",
    "really",
    "very",
    "ever",
    "terribly",
    "awfully",
    "dreadfully",
    "frightfully",
    "incredibly",
    "extremely",
    "absolutely",
    "truly",
    "quite",
    "rather",
    "pretty",
    "much",
    "most",
    "more",
    "too",
    "still",
    "also",
    "well",
    "wonder",
    "wondering",
    "was wondering",
    "was just wondering",
    "hope",
    "hoping",
    "was hoping",
    "was rather hoping",
    "was really hoping",
    "was kind of hoping",
    "was thinking",
    "was going to ask",
    "was about to ask",
    "wanted to ask",
    "thought",
    "think",
    "suppose",
    "reckon",
    "believe",
    "guess",
    "trust",
    "do not suppose",
    "can not help wondering",
    "would not mind",
    "do not mind",
    "chance",
    "chances",
    "way",
    "possibility",
    "possible",
    "great",
    "good",
    "nice",
    "nicer",
    "lovely",
    "kind",
    "wonderful",
    "fantastic",
    "marvellous",
    "amazing",
    "awesome",
    "brilliant",
    "super",
    "excellent",
    "grand",
    "handy",
    "useful",
    "helpful",
    "ideal",
    "perfect",
    "cool",
    "sweet",
    "splendid",
    "neat",
    "big",
    "huge",
    "massive",
    "enormous",
    "tremendous",
    "real",
    "total",
    "absolute",
    "dead",
    "help",
    "hand",
    "favour",
    "favor",
    "service",
    "relief",
    "treat",
    "blessing",
    "kindness",
    "lifesaver",
    "honour",
    "pleasure",
    "joy",
    "best",
    "better",
    "appreciate",
    "appreciated",
    "grateful",
    "thankful",
    "obliged",
    "indebted",
    "glad",
    "happy",
    "happier",
    "delighted",
    "pleased",
    "thrilled",
    "overjoyed",
    "chuffed",
    "mean",
    "world",
    "lot",
    "make",
    "day",
    "life",
    "easier",
    "like",
    "love",
    "need",
    "want",
    "wish",
    "prefer",
    "ask",
    "asking",
    "request",
    "suggest",
    "propose",
    "tell",
    "beg",
    "begging",
    "trouble",
    "bother",
    "task",
    "job",
    "time",
    "about",
    "high",
    "okay",
    "ok",
    "alright",
    "right",
    "fine",
    "need someone",
    "someone",
    "somebody",
    "anyone",
    "anybody",
    "out",
    "nobody else",
    "imagine",
    "fancy",
    "go",
    "next",
    "first",
    "now",
    "then",
    "today",
    "here",
    "quickly",
    "actually",
    "honestly",
    "sure",
    "certain",
    "confident",
];

/// Who is asked.
const WHO: &[&str] = &[
    "you",
    "someone",
    "somebody",
    "anyone",
    "anybody",
    "one of you",
    "you guys",
    "you lot",
    "you maybe",
    "you perhaps",
    "you possibly",
    "you please",
    "you just",
    "you also",
    "you kindly",
    "someone please",
    "somebody please",
    "you robot",
];

/// Before who is asked, or behind.
const MODAL: &[&str] = &["could", "can", "would", "will", "might", "may"];

/// Only behind who is asked.
const BEHIND: &[&str] = &[
    "could",
    "can",
    "would",
    "will",
    "might",
    "may",
    "should",
    "must",
    "ought to",
    "had better",
    "to",
    "were to",
    "are to",
    "are able to",
    "were able to",
    "are willing to",
    "are free to",
    "have time to",
    "have got time to",
    "had time to",
    "have a moment to",
    "had a moment to",
    "have a minute to",
    "had a minute to",
    "have the time to",
    "had the time to",
    "could be bothered to",
    "get a chance to",
    "find the time to",
    "found the time to",
    "found time to",
    "fancied",
    "need to",
    "have to",
    "have got to",
];

/// Behind `are you` and the like.
const ABLE: &[&str] = &[
    "able to",
    "willing to",
    "free to",
    "available to",
    "happy to",
    "prepared to",
    "in a position to",
    "kind enough to",
    "good enough to",
    "so kind as to",
    "so good as to",
    "so kind to",
    "so good to",
    "okay to",
    "up to",
    "allowed to",
    "going to",
];

/// What may follow before the verb.
const SOFT: &[&str] = &[
    "ever",
    "please",
    "kindly",
    "just",
    "also",
    "quickly",
    "then",
    "maybe",
    "perhaps",
    "possibly",
    "at all",
    "by any chance",
    "really",
    "for once",
    "next",
    "now",
    "first",
    "first of all",
    "for a moment",
    "for a second",
    "for a sec",
    "for a minute",
    "be able to",
    "be willing to",
    "be happy to",
    "be prepared to",
    "be in a position to",
    "be so kind as to",
    "be so very kind as to",
    "be so good as to",
    "be so kind to",
    "be so good to",
    "be so kind and",
    "be so good and",
    "be kind enough to",
    "be good enough to",
    "be nice enough to",
    "be sweet enough to",
    "be bothered to",
    "be persuaded to",
    "be free to",
    "happen to",
    "happen to be free to",
    "happen to be able to",
    "manage to",
    "try to",
    "try and",
    "attempt to",
    "make an effort to",
    "find the time to",
    "find time to",
    "find a moment to",
    "find a minute to",
    "find it in your heart to",
    "find it in yourself to",
    "see fit to",
    "see your way to",
    "see your way clear to",
    "see if you can",
    "do me a favour and",
    "do me a favor and",
    "do us a favour and",
    "do us a favor and",
    "do me a kindness and",
    "do me the favour to",
    "do me the kindness to",
    "do me the honour to",
    "help me out and",
    "help out and",
    "help me and",
    "help me to",
    "lend me a hand and",
    "give me a hand and",
    "lend a hand and",
    "go ahead and",
    "spare a moment to",
    "spare a minute to",
    "spare a second to",
    "spare the time to",
    "take a moment to",
    "take a minute to",
    "take a second to",
    "take the time to",
    "take the trouble to",
    "get up and",
    "like to",
    "care to",
    "want to",
    "ever so kindly",
    "hurry and",
    "hurry up and",
    "be quick and",
    "be a dear and",
    "have the goodness to",
    "have the kindness to",
    "do the honours and",
    "to",
    "do is",
    "do is to",
    "do now is",
    "do next is",
    "do first is",
    "do for me is",
    "do for me now is",
    "do right now is",
    "for me please",
    "make it your business to",
    "make sure to",
    "be sure to",
    "remember to",
    "not forget to",
];

/// Where the words end that ask somebody for something, as a number of words; what is asked for stands behind.
pub(super) fn asking(tokens: &[Token], at: usize) -> Option<usize> {
    let (mut end, mut last) = (at, None);
    loop {
        if let Some(count) = asks(tokens, end) {
            last = Some(end + count);
        }
        match longest(tokens, end, OPEN) {
            Some(count) => end += count,
            None => break,
        }
    }
    let end = last?;
    Some(end + run(tokens, end, SOFT) - at)
}

/// Where the words end with which somebody asks whether they may: `could I maybe`, `any chance that we might`, as a number of words.
pub(super) fn before_speaker(tokens: &[Token], at: usize) -> Option<usize> {
    const ME: &[&str] = &["i", "we", "one", "this old man", "this old woman"];
    const MAY: &[&str] = &["could", "can", "may", "might"];
    const DOUBTS: &[&str] = &[
        "chance",
        "chances",
        "wonder",
        "wondering",
        "was wondering",
        "hope",
        "hoping",
        "was hoping",
        "if",
        "whether",
        "possible",
        "possibility",
        "way",
        "you",
    ];
    let (mut end, mut last, mut doubts) = (at, None, false);
    loop {
        // `I can get it` tells, `could I get it` and `I wonder if I might get it` ask.
        let told = longest(tokens, end, ME).and_then(|who| Some(who + longest(tokens, end + who, MAY)?));
        let asked =
            longest(tokens, end, MAY).and_then(|modal| Some(modal + longest(tokens, end + modal, ME)?));
        if let Some(count) = told.filter(|_| doubts).max(asked) {
            last = Some(end + count);
        }
        doubts |= longest(tokens, end, DOUBTS).is_some();
        match longest(tokens, end, OPEN) {
            Some(count) => end += count,
            None => break,
        }
    }
    let end = last?;
    Some(end + run(tokens, end, SOFT) - at)
}

/// `could you`, `you would`, `are you able to`: how many words it takes.
fn asks(tokens: &[Token], at: usize) -> Option<usize> {
    if let Some(who) = longest(tokens, at, WHO) {
        let modal = longest(tokens, at + who, BEHIND).or_else(|| has_time(tokens, at + who))?;
        let before = at.checked_sub(1).and_then(|at| tokens.get(at)).map_or("", Token::word);
        let is = |table: &[&str]| longest(tokens, at + who, table) == Some(modal);
        // `anyone can open it`, `you would open it` tell something where nothing leads up to them.
        let is_led = matches!(
            before,
            "if" | "whether"
                | "wish"
                | "hope"
                | "hoping"
                | "chance"
                | "chances"
                | "that"
                | "think"
                | "suppose"
                | "reckon"
                | "way"
                | "possible"
                | "possibility"
                | "need"
                | "want"
                | "like"
                | "love"
                | "for"
                | "ask"
                | "imagine"
                | "trust"
                | "believe"
                | "guess"
        );
        let needs_lead = tokens.get(at).is_some_and(|token| token.word() != "you") || is(&["would"]);
        // `if you should open it` tells when, `it is nice of you to open it` what is done already.
        let tells = match before {
            "if" | "whether" => {
                is(&["should", "must", "ought to", "to", "need to", "have to", "have got to", "are to"])
            }
            "of" => is(&["to"]),
            _ => false,
        };
        return (!tells && (is_led || !needs_lead)).then_some(who + modal);
    }
    if let Some(are) = longest(tokens, at, &["are", "would", "will", "could", "can"]) {
        let who = longest(tokens, at + are, WHO)?;
        let be = longest(tokens, at + are + who, &["be"]).unwrap_or(0);
        if let Some(able) = longest(tokens, at + are + who + be, ABLE) {
            return Some(are + who + be + able);
        }
    }
    let modal = longest(tokens, at, MODAL)?;
    Some(modal + longest(tokens, at + modal, WHO)?)
}

/// `have two seconds to`, `have until I count to three to`: how many words it takes.
fn has_time(tokens: &[Token], at: usize) -> Option<usize> {
    let mut end =
        at + longest(tokens, at, &["have", "have got", "have exactly", "have only got", "have just"])?;
    end += longest(
        tokens,
        end,
        &[
            "a",
            "one",
            "two",
            "three",
            "five",
            "ten",
            "thirty",
            "sixty",
            "a few",
            "a couple of",
            "exactly one",
            "exactly two",
        ],
    )?;
    end += longest(
        tokens,
        end,
        &["second", "seconds", "minute", "minutes", "moment", "moments", "sec", "secs", "min", "mins"],
    )?;
    Some(end + longest(tokens, end, &["to"])? - at)
}

/// Words of somebody who asks for a deed and not for somebody: `would you mind`, `how do you feel about`.
const MINDS: &[&str] = &[
    "use",
    "do with",
    "be amenable to",
    "amenable to",
    "be averse to",
    "see about",
    "set about",
    "go about",
    "get on with",
    "give me",
    "give us",
    "lend me",
    "lend us",
    "help me with",
    "help with",
    "hand with",
    "mind",
    "minding",
    "consider",
    "considering",
    "object to",
    "opposed to",
    "averse to",
    "try",
    "trying",
    "feel like",
    "feel about",
    "feel up to",
    "up for",
    "say to",
    "by",
    "objection to",
    "objections to",
    "against",
    "interested in",
    "see to",
    "look at",
    "start",
    "begin",
    "get round to",
    "get around to",
    "be up for",
    "think about",
    "think of",
    "able to manage",
    "manage",
    "what do",
    "what would",
    "how do",
    "how would",
    "what are",
    "what",
    "in",
    "with",
    "spare",
    "burdening",
    "see your way to",
    "see your way clear to",
];

/// `would you mind terribly popping it on the table`, `I'd be over the moon if you fetched it`: up to where the verb takes
/// the place of it, and the verb.
pub(super) fn in_another_form(tokens: &[Token], at: usize) -> Option<(usize, String)> {
    // `could you see your way to fetching`: what leads up to it was passed over.
    let before = at.checked_sub(1).and_then(|at| tokens.get(at)).map_or("", Token::word);
    if matches!(before, "to" | "by" | "about" | "of" | "mind")
        && let Some((verb, Form::Gerund)) = base(tokens.get(at)?.word())
    {
        return Some((at + 1, verb));
    }
    let next = |end: &usize| {
        let count = longest(tokens, *end, OPEN).max(longest(tokens, *end, MINDS))?;
        Some(end + count)
    };
    let ends: Vec<usize> = std::iter::successors(Some(at), next).skip(1).collect();
    ends.into_iter().rev().find_map(|end| {
        let said = tokens.get(at..end)?;
        let verb = tokens.get(end)?.word();
        let has = |words: &[&str]| said.iter().any(|token| words.contains(&token.word()));
        let last = said.last()?.word();
        // `what are you doing`, `I am closing it` tell or ask what somebody does.
        let tells =
            matches!(last, "am" | "is" | "are" | "be" | "i" | "we" | "start" | "begin" | "it" | "time");
        let sets_about = longest(
            tokens,
            at,
            &["see to", "see about", "set about", "go about", "get on with", "be amenable to", "be up for"],
        );
        let asks = sets_about == Some(said.len())
            || has(&[
                "help",
                "hand",
                "mind",
                "minding",
                "consider",
                "considering",
                "object",
                "opposed",
                "averse",
                "fancy",
                "try",
            ])
            || (has(&["you", "somebody", "someone", "anybody", "anyone"])
                && has(&[
                    "would",
                    "could",
                    "can",
                    "appreciate",
                    "appreciated",
                    "chance",
                    "chances",
                    "about",
                    "possibility",
                    "like",
                    "love",
                ]));
        // `I mind opening it` tells how somebody feels.
        let feels = has(&["i", "we"])
            && !has(&["would", "could", "need", "want", "can", "not", "hoping", "if", "you"]);
        match base(verb) {
            Some((verb, Form::Gerund)) if !feels && asks && !tells => return Some((end + 1, verb)),
            _ => {}
        }
        let who = (1..said.len()).rev().find(|at| said.get(*at).is_some_and(|token| token.word() == "if"))?;
        let mut behind = who + 1 + longest(said, who + 1, WHO)?;
        behind += run(said, behind, SOFT);
        let is_nice = has(&[
            "would",
            "could",
            "grateful",
            "obliged",
            "glad",
            "appreciate",
            "mind",
            "okay",
            "ok",
            "fine",
        ]);
        (behind == said.len() && is_nice).then(|| Some((end + 1, of_past(verb)?)))?
    })
}

//! What is said to whom is asked and asks for nothing: `um`, `, love`, `, would you?`, `no hurry`.

use crate::request::token::{Token, longest, stands};
use crate::request::verb::begins;

/// Sounds that are made while thinking, wherever they stand.
const SOUNDS: &[&str] = &[
    "um", "umm", "uh", "uhm", "er", "erm", "hm", "hmm", "mm", "ugh", "ah", "aah", "oh", "ooh", "aw", "gosh",
    "phew", "whoa", "ahem", "huh", "oops", "blimey", "argh", "eh", "yuck", "ew", "eww", "yikes", "ouch",
    "yay", "wow", "oof", "jeez", "sheesh", "brr",
];
/// Set off by commas on both sides.
const ASIDES: &[&str] = &[
    "like",
    "you know",
    "i mean",
    "i guess",
    "i suppose",
    "i think",
    "i am afraid",
    "honestly",
    "frankly",
    "you see",
    "of course",
    "as usual",
    "as always",
    "as i said",
    "well",
    "so",
    "now",
    "say",
    "let me think",
    "let me see",
    "how do i put it",
    "what was it",
    "what is it called",
    "whatever",
    "anyway",
    "all right then",
    "right then",
    "okay then",
    "ok then",
    "come on",
    "go on",
    "go ahead",
    "go on then",
    "come on then",
    "no offence",
    "no offense",
    "pretty please",
    "by the way",
];
/// Who is spoken to.
const NAMES: &[&str] = &[
    "dear",
    "my dear",
    "love",
    "my love",
    "lovely",
    "sweetheart",
    "sweetie",
    "sweet pea",
    "darling",
    "honey",
    "hon",
    "babe",
    "buddy",
    "bud",
    "mate",
    "pal",
    "friend",
    "my friend",
    "old friend",
    "robot",
    "mister robot",
    "mr robot",
    "robbie",
    "sir",
    "dude",
    "man",
    "kiddo",
    "champ",
    "boss",
    "chief",
    "duck",
    "pet",
    "sunshine",
    "treasure",
    "angel",
    "big guy",
    "little one",
    "little guy",
    "little fella",
    "old chap",
    "old boy",
    "old thing",
    "my good robot",
    "good robot",
    "guys",
    "folks",
    "everyone",
    "team",
    "bot",
    "machine",
];
/// What is called before a name.
const CALLS: &[&str] = &[
    "hey", "hi", "hello", "oi", "yo", "ok", "okay", "thanks", "sorry", "please", "alright", "right",
    "listen", "there",
];
/// At the end of a clause, with or without a comma.
const TAGS: &[&str] = &[
    "pretty please",
    "anywhere is fine",
    "anywhere on it is fine",
    "anywhere in it is fine",
    "anywhere will do",
    "anywhere on it will do",
    "anywhere in it will do",
    "give me some room",
    "give me some space",
    "will you please",
    "would you please",
    "could you please",
    "can you please",
    "will you",
    "would you",
    "can you",
    "could you",
    "will not you",
    "would not you",
    "can not you",
    "could not you",
    "would you mind",
    "do you mind",
    "do you think you could",
    "if you do not mind",
    "if you would not mind",
    "if that is okay",
    "if that is ok",
    "if that is all right",
    "if that is alright",
    "if it is okay",
    "if it is no bother",
    "if it is not a bother",
    "if you please",
    "if you would be so good",
    "if you would be so kind",
    "if you will",
    "if at all possible",
    "is not it",
    "is it not",
    "are not they",
    "does not it",
    "do not you think",
    "there is a love",
    "there is a dear",
    "there is a darling",
    "there is a sweetheart",
    "there is a good boy",
    "there is a good girl",
    "there is a good lad",
    "there is a good robot",
    "there is a good chap",
    "there is a good fellow",
    "ta",
    "ta very much",
    "cheers",
    "many thanks",
    "thanks",
    "thanks a bunch",
    "thanks a million",
    "thanks a lot",
    "thanks so much",
    "thanks ever so much",
    "thanks in advance",
    "thank you kindly",
    "thank you",
    "thank you dear",
    "much appreciated",
    "much obliged",
    "bless you",
    "no hurry",
    "no rush",
    "there is no hurry",
    "there is no rush",
    "i am in no hurry",
    "i am in no rush",
    "take your time",
    "no pressure",
    "real quick",
    "really quick",
    "pronto",
    "asap",
    "chop chop",
    "let me know when you are done",
    "tell me when you are done",
    "be careful",
    "be quick",
    "hurry",
    "hurry up",
    "that is all",
    "quick as you can",
    "as quick as you can",
    "as fast as you can",
    "as soon as you can",
    "if you can manage it",
    "if you can manage",
    "there you go",
    "off you go",
    "on you go",
    "got it",
    "understood",
    "you hear",
    "you hear me",
    "got that",
    "that would be great",
    "that would be lovely",
    "that would be nice",
    "that would be wonderful",
    "that would be fantastic",
    "that would be perfect",
    "that would be brilliant",
    "that would be a great help",
    "that would be a big help",
    "that would be very kind",
    "that would be kind of you",
    "that is very kind of you",
    "that is kind of you",
    "you are a star",
    "you are the best",
    "you are an angel",
    "you are a lifesaver",
    "i would be grateful",
    "i would be much obliged",
    "i would appreciate it",
    "i would appreciate that",
    "i would really appreciate it",
];
/// The same, but only behind a comma or as a sentence: without one they may belong to what is asked for.
const APART: &[&str] = &[
    "whatever",
    "come on",
    "okay",
    "ok",
    "alright",
    "all right",
    "right",
    "yeah",
    "yes",
    "quick",
    "good boy",
    "good girl",
    "good lad",
    "now",
    "remember",
    "deal",
    "go on",
    "go on then",
    "i am afraid",
    "i think",
    "i guess",
    "i suppose",
];

/// A request without them.
pub(in crate::request) fn without_courtesy(tokens: &[Token]) -> Vec<Token> {
    let mut kept: Vec<Token> = Vec::with_capacity(tokens.len());
    let mut at = 0;
    while let Some(token) = tokens.get(at) {
        if SOUNDS.contains(&token.word()) {
            at += 1;
            // `the coke, um, please`
            if is_mark(kept.last()) && tokens.get(at) == Some(&Token::Comma) {
                at += 1;
            }
            // `the, uh, coke`
            if let [.., article, Token::Comma] = kept.as_slice()
                && matches!(article.word(), "the" | "a" | "an" | "my" | "that" | "to" | "in" | "on" | "me")
            {
                kept.pop();
            }
            continue;
        }
        if let Some(end) =
            aside(tokens, at, &kept).or_else(|| called(tokens, at, &kept)).or_else(|| tag(tokens, at, &kept))
        {
            at = end;
            continue;
        }
        kept.push(token.clone());
        at += 1;
    }
    kept
}

fn is_mark(token: Option<&Token>) -> bool {
    matches!(token, None | Some(Token::Comma | Token::Stop))
}

/// `, like,`: with the comma behind it.
fn aside(tokens: &[Token], at: usize, kept: &[Token]) -> Option<usize> {
    let end = at + longest(tokens, at, ASIDES)?;
    (is_mark(kept.last()) && tokens.get(end) == Some(&Token::Comma)).then_some(end + 1)
}

/// `, love`, `hey buddy,`: whom somebody calls, with the comma before it.
fn called(tokens: &[Token], at: usize, kept: &[Token]) -> Option<usize> {
    let comma = usize::from(tokens.get(at) == Some(&Token::Comma));
    let end = at + comma + longest(tokens, at + comma, NAMES)?;
    if !is_mark(tokens.get(end)) {
        return None;
    }
    // `milk, honey, and bread` names three things.
    let goes_on = tokens.get(end) == Some(&Token::Comma)
        && matches!(tokens.get(end + 1).map_or("", Token::word), "and" | "or");
    // `take it, dear, and do not let go`
    let is_thing = matches!(
        tokens.get(end - 1).map_or("", Token::word),
        "honey" | "duck" | "pet" | "treasure" | "machine"
    );
    let goes_on =
        goes_on && (is_thing || (!begins(tokens, end + 2) && stands(tokens, end + 2, "do not").is_none()));
    let is_called = match kept.last() {
        _ if comma == 1 => !kept.is_empty() && !goes_on,
        None | Some(Token::Stop) => tokens.get(end).is_some(),
        Some(Token::Word(word)) => CALLS.contains(&word.as_str()),
        Some(Token::Comma) => false,
    };
    is_called.then_some(end)
}

/// `…, will you?`, `no hurry`: with the comma before it.
fn tag(tokens: &[Token], at: usize, kept: &[Token]) -> Option<usize> {
    let comma = usize::from(tokens.get(at) == Some(&Token::Comma));
    let is_apart = comma == 1 || kept.last() == Some(&Token::Stop);
    let apart = longest(tokens, at + comma, APART).filter(|_| is_apart);
    let end = at + comma + longest(tokens, at + comma, TAGS).max(apart)?;
    (!kept.is_empty() && is_mark(tokens.get(end))).then_some(end)
}

//! Sentences that ask without an imperative, said as imperatives: `I need the fridge open` is `open the fridge`, `could the
//! coke be brought to me` is `bring the coke to me`. What is framed otherwise stays as it is.
//!
//! The frames are constructions with places for nouns, after Goldberg, Constructions (1995): a predicate of place or state
//! (`X belongs in Y`, `I want X shut`), a passive, a causative (`get X open`), a wish, and what politeness puts before them.

mod addressed;
mod clause;
mod courtesy;
mod delegate;
mod favour;
mod fill;
mod filler;
mod link;
mod placed;
mod pleasant;
mod state;
mod tags;

use self::addressed::told_you;
use self::clause::{cause, clause};
pub(super) use self::courtesy::{SOUNDS, without_courtesy};
pub(super) use self::delegate::asks_for_it;
use self::delegate::{delegated, elliptic};
use self::favour::{favour, in_series, stressed, told_when_done};
use self::filler::without_fillers;
use self::placed::wanted_there;
use super::asking::in_another_form;
use super::inflection::{Form, base, of_past};
use super::lead::skip_leads;
use super::noun::noun;
use super::token::{Token, longest, run, stands};
use super::verb::{Act, begins, verb};

/// What asks for the form in `-ing`.
const MIND: &[&str] = &[
    "you would not mind",
    "you do not mind",
    "i hope you do not mind",
    "fancy",
    "do you fancy",
    "would you fancy",
    "do you feel like",
    "feel like",
    "try",
    "please try",
    "why not try",
    "consider",
    "please consider",
    "you could start by",
    "please start by",
    "begin by",
    "finish by",
    "would you mind",
    "do you mind",
    "mind",
    "how about",
    "what about",
    "any chance of you",
    "i could do with you",
    "i could use you",
    "could i have you",
    "can i have you",
    "i would love you",
    "what do you say to",
    "how do you feel about",
    "would you consider",
    "would you object to",
    "would you be opposed to",
    "it would be great you",
    "it would help me out you",
    "help me by",
    "help me out by",
    "help out by",
    "do me a favour by",
    "do me a favor by",
    "you can help me by",
    "you could help me by",
    "you would be helping me by",
    "you would help me by",
    "you would do me a favour by",
    "you would do me a favor by",
    "i am thinking of you",
    "be so kind as to start",
    "get on with",
    "get busy",
    "you can start by",
    "let us start by",
    "would you be up for",
    "is there any chance of you",
    "what are the chances of you",
    "any chance of",
    "is there any chance of",
    "i would appreciate you",
    "after",
    "start by",
];
/// Going somewhere in order to do something there: only the second counts.
const SET_OUT: &[&str] = &[
    "get off your backside and",
    "get off your bottom and",
    "get off your bum and",
    "get off your behind and",
    "get off your high horse and",
    "shift yourself and",
    "stir yourself and",
    "stop dawdling and",
    "stop messing about and",
    "stop messing around and",
    "stop faffing and",
    "stop faffing about and",
    "quit stalling and",
    "do not be lazy and",
    "be quick and",
    "be so good and",
    "be careful and",
    "be gentle and",
    "get out of here and",
    "get out from under my feet and",
    "get out of the road and",
    "get out of my hair and",
    "clear out and",
    "get your skates on and",
    "get a wiggle on and",
    "get cracking and",
    "drop whatever you are doing and",
    "leave whatever you are doing and",
    "leave what you are doing and",
    "stop whatever you are doing and",
    "stop that and",
    "leave that and",
    "take a break from that and",
    "use your arm and",
    "use your hand and",
    "stretch out your arm and",
    "stretch out and",
    "do not just stand there",
    "do not just sit there",
    "do not stand there",
    "do not just sit around",
    "go over and",
    "go back and",
    "go out and",
    "go ahead and",
    "go and",
    "run over and",
    "run and",
    "hurry and",
    "come and",
    "head over and",
    "head on over and",
    "pop over and",
    "pop across and",
    "nip over and",
    "get up and",
    "run along and",
    "go right ahead and",
    "go on over and",
    "go over there and",
    "come over and",
    "come over here and",
    "come here and",
    "make sure to",
    "make sure you",
    "be sure to",
    "take care to",
    "go",
    "run",
    "come",
    "try and",
    "try to",
    "turn around and",
    "turn round and",
    "reach out and",
    "reach over and",
    "bend down and",
    "lean over and",
    "get out of the way and",
    "get out of my way and",
    "move out of the way and",
    "step aside and",
    "move aside and",
    "leave me alone and",
    "leave me in peace and",
    "stop what you are doing and",
    "drop what you are doing and",
    "drop everything and",
    "get a move on and",
    "wake up and",
    "get moving and",
    "come along and",
    "come on and",
    "go along and",
    "go straight over and",
    "take a trip over and",
    "make your way over and",
    "find the time to",
    "tidy up and",
    "clean up and",
    "tidy up a bit and",
];
/// Who sets out to take something goes for it.
const GOES_FOR: &[&str] = &[
    "go and",
    "go over and",
    "run and",
    "run over and",
    "go out and",
    "hurry and",
    "pop over and",
    "nip over and",
    "go on over and",
];

/// Behind a verb of opening or closing: only where it is not so already, which has to be seen first.
pub(super) const ONLY_IF_SO: &str = "if it is open";

/// A request with its frames said plainly.
pub(super) fn plain(tokens: &[Token]) -> Vec<Token> {
    // What is left out may stand between other words that are.
    // `I cannot open it, could you?` has to be read before courtesy is left out.
    let tokens = elliptic(&possessed(tokens));
    let mut tokens = without_courtesy(&without_fillers(&without_courtesy(&tokens)));
    tokens = delegated(&tokens);
    let mut said = Vec::with_capacity(tokens.len());
    let (mut at, mut starts, mut begins_sentence) = (0, true, true);
    // Every rewriting takes words away or goes on behind what it wrote: the bound only guards against a slip of that.
    let mut left = tokens.len() * 4 + 16;
    while at < tokens.len() && left > 0 {
        left -= 1;
        if starts {
            let begin = skip_leads(&tokens, at);
            if let Some((from, words)) = told_you(&tokens, begin).or_else(|| wanted_there(&tokens, begin)) {
                tokens.splice(begin..from, words);
                continue;
            }
            if let Some((from, verb)) = in_another_form(&tokens, begin) {
                tokens.splice(begin..from, [Token::Word(verb)]);
                in_series(&mut tokens, begin);
                continue;
            }
            if let Some((from, words)) = unwrapped(&tokens, begin) {
                tokens.splice(begin..from, words);
                continue;
            }
            if let Some((from, words)) = favour(&tokens, begin) {
                tokens.splice(begin..from, words);
                in_series(&mut tokens, begin);
                continue;
            }
            if let Some((words, after)) = clause(&tokens, begin, begins_sentence) {
                // A comma before a clause that takes the place of a statement stays one.
                said.extend(words);
                (at, starts, begins_sentence) = (after, false, false);
                continue;
            }
        }
        let Some(token) = tokens.get(at) else { break };
        let joins = matches!(token, Token::Comma | Token::Stop)
            || matches!(token.word(), "and" | "so" | "but" | "then" | "because");
        begins_sentence = *token == Token::Stop || (begins_sentence && starts && is_lead(&tokens, at));
        starts = joins;
        said.push(token.clone());
        at += 1;
    }
    said
}

/// Whether something begins here that politeness puts before a request.
fn is_lead(tokens: &[Token], at: usize) -> bool {
    skip_leads(tokens, at) > at
}

/// A frame around an imperative: what stands for the tokens up to where.
fn unwrapped(tokens: &[Token], at: usize) -> Option<(usize, Vec<Token>)> {
    let mind = longest(tokens, at, MIND);
    if let Some(count) = mind
        && let Some((verb, Form::Gerund)) = base(tokens.get(at + count)?.word())
    {
        return Some((at + count + 1, vec![Token::Word(verb)]));
    }
    if let Some(found) = told_when_done(tokens, at).or_else(|| stressed(tokens, at)) {
        return Some(found);
    }
    // `when you come back to me, have it with you`
    let coming = [
        "when you come",
        "when you come back",
        "when you return",
        "when you get back",
        "when you are back",
        "when you next come",
        "when you get here",
        "come",
        "come back",
        "return",
        "get back",
        "come over",
        "next time you come",
        "on your way back",
        "on the way back",
        "on your way here",
    ];
    if let Some(count) = longest(tokens, at, &coming) {
        let mut have = at
            + count
            + run(tokens, at + count, &["over", "here", "to me", "to us", "back", "from there", "again"]);
        have += usize::from(tokens.get(have) == Some(&Token::Comma));
        have += longest(tokens, have, &["and", "then"]).unwrap_or(0);
        if let Some(has) = longest(
            tokens,
            have,
            &[
                "have",
                "make sure you have",
                "you should have",
                "please have",
                "be sure to have",
                "make sure to have",
            ],
        ) && let Some((_, after)) = noun(tokens, have + has)
            && let Some(with) = longest(tokens, after, &["with you", "in your hand", "on you"])
        {
            let mut said = state::words("bring me");
            said.extend_from_slice(tokens.get(have + has..after)?);
            return Some((after + with, said));
        }
    }
    // `would you mind going to get it`
    if let Some(count) = stands(tokens, at, "go to").or_else(|| stands(tokens, at, "go over to"))
        && let "get" | "fetch" | "grab" | "bring" | "pick" | "open" | "close" | "shut" =
            tokens.get(at + count)?.word()
    {
        return Some((at + count, Vec::new()));
    }
    // `I would rather you waited at the sink`
    let rather = [
        "i would rather you",
        "i would sooner you",
        "i would prefer it if you",
        "i would prefer that you",
        "i would prefer you to",
        "i wish you",
        "it is time you",
        "it is about time you",
        "it is high time you",
        "it is time somebody",
        "it is time someone",
        "it is about time somebody",
        "it is about time someone",
        "it is high time somebody",
        "it is high time someone",
        "it is time we",
        "it is about time we",
        "it is high time we",
        "what if you",
        "i would like it if you",
        "i would love it if you",
        "i would be glad if you",
        "i would be happy if you",
    ];
    if let Some(count) = longest(tokens, at, &rather) {
        let word = tokens.get(at + count)?.word();
        if matches!(word, "were" | "was") {
            return Some((at + count + 1, state::words("go")));
        }
        let verb = base(word).filter(|(_, form)| *form == Form::Base).map(|(verb, _)| verb);
        return Some((at + count + 1, vec![Token::Word(verb.or_else(|| of_past(word))?)]));
    }
    // `once you have opened it, …`
    if let Some(count) = longest(tokens, at, &["once you have", "after you have", "as soon as you have"])
        && let Some((verb, Form::Participle)) = base(tokens.get(at + count)?.word())
    {
        return Some((at + count + 1, vec![Token::Word(verb)]));
    }
    // `once you have got hold of it, …`
    let got = ["once you have got hold of", "after you have got hold of", "as soon as you have got hold of"];
    if let Some(count) = longest(tokens, at, &got) {
        return Some((at + count, state::words("get hold of")));
    }
    // `off you trot to the sink`
    if let Some(count) = stands(tokens, at, "off you")
        && let Some((Act::Go, after)) = verb(tokens, at + count)
        && matches!(tokens.get(after)?.word(), "to" | "over" | "across")
    {
        return Some((at + count, Vec::new()));
    }
    // `Daddy says you have to bring it`, `my wife wants you to close it`
    if let Some(count) = relayed(tokens, at) {
        return Some((at + count, Vec::new()));
    }
    // `somebody bring me the coke!`
    if let Some(count) = longest(
        tokens,
        at,
        &["somebody", "someone", "anybody", "anyone", "one of you", "will somebody", "everybody"],
    ) && let Some((verb, Form::Base)) = tokens.get(at + count).and_then(|token| base(token.word()))
        && (of_past(&verb).is_none()
            || tokens
                .get(at..)
                .unwrap_or_default()
                .iter()
                .take_while(|token| **token != Token::Stop)
                .any(|token| token.word() == "please"))
        && begins(tokens, at + count)
    {
        return Some((at + count, Vec::new()));
    }
    // `let me into the drawer`
    if let Some(count) = longest(
        tokens,
        at,
        &[
            "let me into",
            "let us into",
            "let me get into",
            "get me into",
            "let me inside",
            "let me get inside",
            "give me access to",
        ],
    ) && let Some((crate::request::noun::Noun::Phrase(_), after)) = noun(tokens, at + count)
        && matches!(tokens.get(after), None | Some(Token::Stop | Token::Comma))
    {
        return Some((at + count, state::words("open")));
    }
    // `be holding it`
    if let Some(count) = stands(tokens, at, "be")
        && let Some((verb, Form::Gerund)) = tokens.get(at + count).and_then(|token| base(token.word()))
    {
        return Some((at + count + 1, vec![Token::Word(verb)]));
    }
    // `lock it away in the drawer`: the small word behind the thing makes the verb.
    if let Some(found) = apart(tokens, at) {
        return Some(found);
    }
    // `make sure I get the coke`
    let gets = [
        "make sure i get",
        "make sure that i get",
        "make sure i have",
        "see that i get",
        "see to it that i get",
        "see to it that i have",
        "ensure i get",
        "ensure that i get",
    ];
    if let Some(count) = longest(tokens, at, &gets) {
        return Some((at + count, state::words("bring me")));
    }
    if let Some(count) = longest(tokens, at, GOES_FOR)
        && tokens.get(at + count)?.word() == "grab"
        && stands(tokens, at + count + 1, "hold").is_none()
    {
        return Some((at + count + 1, state::words("fetch")));
    }
    // `go over there, pick it up`
    let there = [
        "move out of the way",
        "get out of the way",
        "get out of my way",
        "move aside",
        "step aside",
        "out of the way",
        "come along",
        "come on",
        "go over there",
        "go on over",
        "come over here",
        "come here",
        "turn around",
        "get up",
        "wake up",
        "go ahead",
        "look here",
        "look there",
    ];
    if let Some(count) = longest(tokens, at, &there)
        && tokens.get(at + count) == Some(&Token::Comma)
        && begins(tokens, at + count + 1)
    {
        return Some((at + count + 1, Vec::new()));
    }
    let set_out = longest(tokens, at, SET_OUT)?;
    let next = tokens.get(at + set_out)?.word();
    let is_verb = base(next).is_some_and(|(_, form)| form == Form::Base) && begins(tokens, at + set_out);
    let is_verb = is_verb || cause(tokens, at + set_out).is_some();
    is_verb.then(|| (at + set_out, Vec::new()))
}

/// `the sponge's place is in the drawer`: it belongs there.
fn possessed(tokens: &[Token]) -> Vec<Token> {
    let mut said: Vec<Token> = Vec::with_capacity(tokens.len());
    let mut at = 0;
    while let Some(token) = tokens.get(at) {
        at += 1;
        let whose = token.word().strip_suffix("'s").filter(|whose| !whose.is_empty());
        let how =
            longest(tokens, at, &["usual", "proper", "right", "rightful", "normal", "own"]).unwrap_or(0);
        let place = longest(
            tokens,
            at + how,
            &["place is", "home is", "spot is", "place should be", "place has always been"],
        )
        .filter(|count| {
            longest(tokens, at + how + count, &["in", "on", "inside", "at", "up on", "over on", "back in"])
                .is_some()
        });
        match (whose, place) {
            (Some(whose), Some(count)) => {
                said.push(Token::Word(whose.to_owned()));
                said.push(Token::Word("belongs".to_owned()));
                at += how + count;
            }
            _ => said.push(token.clone()),
        }
    }
    said
}

/// What somebody else wants of the one who is spoken to, as the speaker says: how many words it takes.
fn relayed(tokens: &[Token], at: usize) -> Option<usize> {
    const SAYS: &[&str] = &[
        "says",
        "said",
        "thinks",
        "reckons",
        "told me",
        "tells me",
        "insists",
        "insisted",
        "says that",
        "said that",
        "thinks that",
        "reckons that",
        "insists that",
        "told me that",
        "asked if",
        "asked whether",
        "is asking if",
        "is asking whether",
        "asks if",
        "asks whether",
        "would like it if",
        "wonders if",
        "wonders whether",
        "is wondering if",
        "is wondering whether",
        "would be glad if",
        "would be happy if",
        "suggests",
        "suggests that",
        "hopes",
        "is hoping",
        "would appreciate it if",
    ];
    const YOU: &[&str] = &[
        "you have to",
        "you must",
        "you should",
        "you need to",
        "you are to",
        "you ought to",
        "you had better",
        "you can",
        "you could",
        "you would",
        "you have got to",
        "you might",
        "you will",
    ];
    const WANTS: &[&str] = &[
        "wants you to",
        "needs you to",
        "would like you to",
        "would love you to",
        "asked you to",
        "has asked you to",
        "is asking you to",
        "asks you to",
        "expects you to",
        "would love for you to",
        "would like for you to",
        "requires you to",
        "orders you to",
        "commands you to",
        "begs you to",
    ];
    let is_who = |token: &Token| {
        let word = token.word();
        !word.is_empty()
            && !matches!(
                word,
                "i" | "we"
                    | "you"
                    | "it"
                    | "nobody"
                    | "not"
                    | "never"
                    | "if"
                    | "when"
                    | "who"
                    | "what"
                    | "that"
                    | "no"
            )
    };
    (at + 1..=at + 3).find_map(|end| {
        if !tokens.get(at..end)?.iter().all(is_who) {
            return None;
        }
        if let Some(count) = longest(tokens, end, WANTS) {
            return Some(end + count - at);
        }
        let says = end + longest(tokens, end, SAYS)?;
        Some(says + longest(tokens, says, YOU)? - at)
    })
}

/// `lock it away`, `track it down`: the verb with its small word, and up to where the thing stands that it takes in.
fn apart(tokens: &[Token], at: usize) -> Option<(usize, Vec<Token>)> {
    const VERBS: &[(&str, &str, &str)] = &[
        ("lock", "away", "store"),
        ("lock", "up", "store"),
        ("shut", "up", "store"),
        ("shut", "away", "store"),
        ("file", "away", "store"),
        ("squirrel", "away", "store"),
        ("whisk", "away", "stow"),
        ("track", "down", "find"),
        ("hunt", "down", "find"),
        ("seek", "out", "find"),
        ("dig", "out", "fetch"),
        ("fish", "out", "fetch"),
        ("fish", "up", "fetch"),
        ("do", "away with", "discard"),
        ("snap", "up", "pick up"),
        ("scoop", "up", "pick up"),
        ("whip", "up", "pick up"),
        ("snatch", "up", "pick up"),
        ("gather", "up", "pick up"),
        ("heave", "up", "lift"),
    ];
    let word = tokens.get(at)?.word();
    let (_, after) = noun(tokens, at + 1).filter(|_| VERBS.iter().any(|(verb, _, _)| *verb == word))?;
    let (_, small, means) =
        VERBS.iter().find(|(verb, small, _)| *verb == word && stands(tokens, after, small).is_some())?;
    let count = stands(tokens, after, small)?;
    let mut said = state::words(means);
    said.extend_from_slice(tokens.get(at + 1..after)?);
    Some((after + count, said))
}

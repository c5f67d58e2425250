//! Answers: which of some options one means, whether it agrees to another try; and what a request names.

use motet_robots::scene::{Entity, Scene};
use motet_stdlib::lang::entities;
use smol_str::SmolStr;

use crate::RequestContext;
use crate::engine::asking::skip_leads;
use crate::engine::english::{
    AGAIN, AGREEING_SOUNDS, AGREES, AGREES_AS_CLAUSE, AGREES_PLAINLY, ALL_OF_THEM, ANSWER_LEADS, ANY_OF_THEM,
    BESIDE_THE_POINT, CHOICE_FILLERS, DENIAL_WORDS, FORMER, GIVES_UP, IS_TAG_ASKS, LATTER, MODAL_CAN,
    NEGATES_NO, NUMBERED_THE, NUMBERS, ONE_OF_THEM, ORDINALS, PLAIN_WORDS, REPORT_WORDS, RETRY_WORDS,
    SIDE_THE, SIDES, SKIP_SOFT_SOFT, SOUNDS, THE_OTHER, TRIES_AGAIN,
};
use crate::engine::noun::{Noun, Spot, noun, spot};
use crate::engine::token::{Token, singular, stands, tokens};
use crate::engine::verb::{Act, Inflection, base, verb};
use crate::engine::vocabulary::{Role, Vocabulary};
use crate::meaning::Reader;

const ALL: &[Role] = &[Role::Object, Role::Surface, Role::Container, Role::Place, Role::Person];

/// The one of some options, or of everything where there are none, that an answer means: by name, by what
/// tells it apart ("the red one", "the one on the table"), or by its number ("the second"). None where none
/// or several fit.
#[must_use]
pub fn pick(answer: &str, options: &[SmolStr], situation: &RequestContext<'_>) -> Option<SmolStr> {
    if let Some(id) = options.iter().find(|id| id.as_str() == answer.trim()) {
        return Some(id.clone());
    }
    let vocabulary = Vocabulary::new(situation.scene, &situation.supports);
    let words = tokens(answer);
    let words = without_lead(&words);
    // What is on top of a fridge is not in it.
    let place = |place: Option<Spot>| match place.map(|place| (place.relation, place.noun)) {
        Some((relation, Noun::Phrase(place))) => {
            let thing = vocabulary.meant(&place.words, ALL).first().copied()?;
            relation.fits(thing.role).then(|| thing.id.clone())
        }
        _ => None,
    };
    let (mut told, at): (Vec<String>, Option<SmolStr>) = match noun(words, 0) {
        Some((Noun::Phrase(mut phrase), after)) => {
            // `the one that is blue`
            for (is_so, words) in &phrase.is {
                if !is_so {
                    return None;
                }
                phrase.words.extend(words.iter().cloned());
            }
            let own = phrase.place.map(|place| *place);
            (phrase.words, place(own.or_else(|| spot(words, after).map(|(place, _)| place))))
        }
        _ => (Vec::new(), place(spot(words, 0).map(|(place, _)| place))),
    };
    told.retain(|word| !ONE_OF_THEM.has(word));
    if let [ordinal] = told.as_slice()
        && let Some(number) = ORDINALS.value(ordinal).and_then(|number| number.parse::<usize>().ok())
    {
        return options.get(number.checked_sub(1)?).cloned();
    }
    let is_option = |id: &SmolStr| options.is_empty() || options.contains(id);
    // What is only told by its place is among the options; a bare place is the option itself.
    let fitting = |words: &[String]| -> Vec<SmolStr> {
        let all = if words.is_empty() { Vec::new() } else { vocabulary.told_by(words, ALL) };
        all.into_iter().map(|thing| thing.id.clone()).filter(is_option).collect()
    };
    let mut found = if told.is_empty() { options.to_vec() } else { fitting(&told) };
    if let Some(at) = &at {
        let there =
            |id: &SmolStr| vocabulary.thing(id).is_some_and(|thing| thing.support.as_ref() == Some(at));
        let standing: Vec<SmolStr> = found.iter().filter(|id| there(id)).cloned().collect();
        if told.is_empty() && standing.is_empty() && is_option(at) {
            return Some(at.clone());
        }
        found = standing;
    }
    match found.as_slice() {
        [only] => Some(only.clone()),
        _ => None,
    }
}

/// Resolves the answer to "Which one?" among some options, or to what else it names: `both`, `any`, `not the
/// red one`, `2`, `the last one`. Empty where that is not clear.
#[must_use]
pub fn choose(answer: &str, options: &[SmolStr], situation: &RequestContext<'_>) -> Vec<SmolStr> {
    let mut words: Vec<String> = tokens(answer).iter().map(|token| token.word().to_owned()).collect();
    words.retain(|word| !word.is_empty() && !CHOICE_FILLERS.has(word));
    let said = words.join(" ");
    if ANY_OF_THEM.has(said.as_str()) {
        return options.first().cloned().into_iter().collect();
    }
    if ALL_OF_THEM.has(said.as_str()) && (options.len() == 2 || !said.contains("both") && said != "the two") {
        return options.to_vec();
    }
    if let Some(rest) = said.strip_prefix("not ") {
        let but = pick(rest, options, situation);
        let left = options.iter().filter(|option| Some(*option) != but.as_ref());
        return if but.is_some() && options.len() == 2 { left.cloned().collect() } else { Vec::new() };
    }
    // `the red one and the blue one` are two, `the red one or the blue one` is none.
    if words.iter().any(|word| word == "or") {
        return Vec::new();
    }
    let mut chosen = Vec::new();
    for part in words.split(|word| word == "and").filter(|part| !part.is_empty()) {
        let said = part.join(" ");
        let words: Vec<&str> = part.iter().map(String::as_str).collect();
        if let Some(side) = side(&words) {
            // What is called so is meant before what stands there.
            let named = pick(&said, options, situation);
            let Some(id) = named.or_else(|| farthest(side, options, situation.scene)) else {
                return Vec::new();
            };
            chosen.push(id);
            continue;
        }
        if let Some(id) = extreme(&said, options, situation) {
            chosen.push(id);
            continue;
        }
        let one = numbered(part, options).or_else(|| pick(&said, options, situation));
        let Some(id) = one.or_else(|| other(&said, options, situation)) else { return Vec::new() };
        if !chosen.contains(&id) {
            chosen.push(id);
        }
    }
    chosen
}

/// `the bigger one`, `the mug nearest to me`, of some options.
fn extreme(said: &str, options: &[SmolStr], situation: &RequestContext<'_>) -> Option<SmolStr> {
    let words = tokens(&format!("the {}", said.strip_prefix("the ").unwrap_or(said)));
    let Some((Noun::Phrase(phrase), end)) = noun(&words, 0) else { return None };
    if phrase.extreme.is_none() || end < words.len() {
        return None;
    }
    let mut reader = Reader::new(situation);
    let told: Vec<SmolStr> =
        reader.vocabulary.told_by(&phrase.words, ALL).iter().map(|thing| thing.id.clone()).collect();
    let called = options.iter().filter(|id| phrase.words.is_empty() || told.contains(id)).cloned().collect();
    <[SmolStr; 1]>::try_from(reader.extreme(&phrase, called)).ok().map(|[only]| only)
}

/// `2`, `number two`, `mug 2`, `the last one`, `the other one`
fn numbered(words: &[String], options: &[SmolStr]) -> Option<SmolStr> {
    let number = |word: &str| NUMBERS.value(word)?.parse::<usize>().ok();
    let ordinal = |word: &str| ORDINALS.value(word)?.parse::<usize>().ok();
    let all: Vec<&str> = words.iter().map(String::as_str).collect();
    // `number one` counts, `the red one` does not.
    let is_first = matches!(all.as_slice(), ["one"] | ["number" | "no" | "option", "one"]);
    let kept = all.into_iter().filter(|word| !NUMBERED_THE.has(word) && (is_first || *word != "one"));
    let kept: Vec<&str> = kept.collect();
    match kept.as_slice() {
        [word] if LATTER.has(word) => options.last().cloned(),
        [word] if FORMER.has(word) => options.first().cloned(),
        [word] | ["in", word, "place"] if ordinal(word).is_some() => options.get(ordinal(word)? - 1).cloned(),
        [word] if number(word).is_some() => {
            // The number of a name, where the options have such names, and else that of the option.
            let named: Vec<_> = options.iter().filter(|id| id.ends_with(&format!("_{word}"))).collect();
            let counted = options.get(number(word)? - 1);
            match (named.as_slice(), counted) {
                ([named], Some(counted)) if *named != counted => None,
                ([named], _) => Some((*named).clone()),
                ([], counted) => counted.cloned(),
                _ => None,
            }
        }
        [.., last] if number(last).is_some() => {
            let id = kept.join("_");
            options.iter().find(|option| option.as_str() == id).cloned()
        }
        _ => None,
    }
}

/// `the other one`, of two of which one was spoken of; or another thing of the same kind by its name.
fn other(said: &str, options: &[SmolStr], situation: &RequestContext<'_>) -> Option<SmolStr> {
    if THE_OTHER.has(said) {
        let mut not_spoken_of = options.iter().filter(|id| !situation.spoken_of.contains(id));
        return match (options.len(), not_spoken_of.next(), not_spoken_of.next()) {
            (2, Some(only), None) => Some(only.clone()),
            _ => None,
        };
    }
    // By a name, not by what would only tell it from others: `the healthy one` is no apple.
    let named = <[SmolStr; 1]>::try_from(named(said, situation)).ok().map(|[named]| named)?;
    let is_named = |id: &SmolStr| {
        let vocabulary = Vocabulary::new(situation.scene, &situation.supports);
        let words: Vec<String> = tokens(said).iter().map(|token| singular(token.word())).collect();
        vocabulary.thing(id).is_some_and(|thing| thing.is_named_in(&words))
    };
    if !is_named(&named) {
        return None;
    }
    let kind = |id: &SmolStr| situation.scene.entities.get(id).map(|entity| entity.kind.clone());
    (kind(&named) == kind(options.first()?)).then_some(named)
}

fn without_lead(words: &[Token]) -> &[Token] {
    let is_lead = |token: &&Token| ANSWER_LEADS.has(token.word()) || **token == Token::Comma;
    words.get(words.iter().take_while(is_lead).count()..).unwrap_or_default()
}

/// The things of the scene that a request names, in the order of the scene: what an extractor of objects
/// gives.
#[must_use]
pub fn named(request: &str, situation: &RequestContext<'_>) -> Vec<SmolStr> {
    let vocabulary = Vocabulary::new(situation.scene, &situation.supports);
    let spoken = tokens(request);
    let words: Vec<String> = spoken.iter().map(|token| singular(token.word())).collect();
    let mut found: Vec<SmolStr> = Vec::new();
    let mut at = 0;
    while at < words.len() {
        // `can you get it` names no can.
        if let Some(count) = MODAL_CAN.longest(&spoken, at) {
            at += count;
            continue;
        }
        // The longest run of words that is a name counts.
        let named = (1..=4.min(words.len() - at)).rev().find_map(|count| {
            let run = words.get(at..at + count)?;
            let things =
                if run.iter().any(String::is_empty) { Vec::new() } else { vocabulary.meant(run, ALL) };
            (!things.is_empty())
                .then(|| (count, things.into_iter().map(|thing| thing.id.clone()).collect::<Vec<_>>()))
        });
        match named {
            Some((count, ids)) => {
                found.extend(ids);
                at += count;
            }
            None => at += 1,
        }
    }
    let order = situation.scene.entities.keys();
    order.filter(|id| found.contains(id)).cloned().collect()
}

/// The usual name of a thing: its first other name, else its class, else its id in words.
#[must_use]
pub fn called(entity: &Entity) -> String {
    match (entity.names.first(), entity.class.as_str()) {
        (Some(name), _) => name.to_string(),
        (None, "") => entity.id.replace(['_', '-'], " "),
        (None, class) => class.to_owned(),
    }
}

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Side {
    Left,
    Right,
}

/// The side that words name.
pub(super) fn side(words: &[&str]) -> Option<Side> {
    let kept: Vec<&str> = words.iter().copied().filter(|word| !SIDE_THE.has(word)).collect();
    let [side] = kept.as_slice() else { return None };
    match SIDES.value(side)? {
        "left" => Some(Side::Left),
        _ => Some(Side::Right),
    }
}

/// The option that is farthest to a side, seen from where the person and from where the robot was at the
/// start: whose left is meant nobody says. None where they see it differently, or it is not known where
/// everything is.
pub(super) fn farthest(side: Side, options: &[SmolStr], scene: &Scene) -> Option<SmolStr> {
    let place = |id: &str| scene.entities.get(id)?.pose.map(|pose| [pose.xyz[0], pose.xyz[1]]);
    let places: Option<Vec<[f64; 2]>> = options.iter().map(|id| place(id)).collect();
    let places = places.filter(|places| places.len() > 1)?;
    let [x, y, _] = scene.robot.base;
    let person = seen(side, place(entities::USER)?, &places)?;
    let robot = seen(side, [x, y], &places)?;
    if person == robot { options.get(person).cloned() } else { None }
}

/// The same from one place: which of the places it is, where no other is as far to that side.
fn seen(side: Side, from: [f64; 2], places: &[[f64; 2]]) -> Option<usize> {
    let count = places.len() as f64;
    let sum = places.iter().fold([0.0, 0.0], |sum, place| [sum[0] + place[0], sum[1] + place[1]]);
    let ahead = [sum[0] / count - from[0], sum[1] / count - from[1]];
    // How far to the left of the middle: the cross product.
    let left = |place: &[f64; 2]| ahead[0] * (place[1] - from[1]) - ahead[1] * (place[0] - from[0]);
    let sign = if side == Side::Left { 1.0 } else { -1.0 };
    let mut order: Vec<(f64, usize)> =
        places.iter().enumerate().map(|(at, place)| (sign * left(place), at)).collect();
    order.sort_by(|one, other| other.0.total_cmp(&one.0));
    match order.as_slice() {
        [(first, at), (second, _), ..] if first - second > 1e-6 => Some(*at),
        _ => None,
    }
}

/// Words beside the agreement in an answer that agrees to another try. `None` for an answer that does not
/// agree, or that asks for something else.
#[must_use]
pub fn encourages(answer: &str) -> Option<String> {
    let mut said = tokens(answer);
    // `uh huh` and `mm hm` agree.
    said.retain(|token| {
        let word = token.word();
        !SOUNDS.has(word) || AGREEING_SOUNDS.has(word)
    });
    let (mut agrees, mut beside) = (false, Vec::new());
    for clause in said.split(|token| matches!(token, Token::Comma | Token::Stop)) {
        let begin = skip_soft(clause, 0);
        if clause.get(begin..).is_none_or(<[Token]>::is_empty) {
            agrees |= (0..clause.len()).any(|at| AGREES.longest(clause, at).is_some());
            continue;
        }
        // `if you would, thank you`
        if AGREES_AS_CLAUSE.longest(clause, begin) == Some(clause.len() - begin) {
            agrees = true;
            continue;
        }
        let is_beside =
            BESIDE_THE_POINT.longest(clause, begin).max(BESIDE_THE_POINT.longest(clause, 0)).is_some();
        if !is_beside && (0..clause.len()).any(|at| GIVES_UP.longest(clause, at).is_some()) {
            return None;
        }
        let is_agreed = (0..clause.len())
            .any(|at| AGAIN.longest(clause, at).is_some() || AGREES.longest(clause, at).is_some())
            && is_plain(clause);
        // `I cannot do it myself` says why.
        let is_agreed = is_agreed && stands(clause, begin, "i can not").is_none();
        if let Some(left) = asks_again(clause).filter(|_| !is_agreed) {
            agrees = true;
            beside.extend(left);
            continue;
        }
        let is_denied = !is_beside
            && clause.iter().any(|token| DENIAL_WORDS.has(token.word()))
            && (!is_agreed || negates(clause));
        if is_denied {
            return None;
        }
        // Something else is asked for.
        if !is_agreed && !is_beside && verb(clause, skip_leads(clause, begin)).is_some() {
            return None;
        }
        agrees |= is_agreed;
        if !is_agreed && !is_beside && !is_tag(clause) {
            beside.extend(clause.iter().map(Token::word));
        }
    }
    agrees.then(|| beside.join(" "))
}

fn is_tag(clause: &[Token]) -> bool {
    matches!(clause, [ask, _] if IS_TAG_ASKS.has(ask.word()))
}

/// True if it takes back or bounds something, in words that are no part of what only sounds so.
fn negates(clause: &[Token]) -> bool {
    let mut at = 0;
    while let Some(token) = clause.get(at) {
        match BESIDE_THE_POINT.longest(clause, at).max(AGREES_AS_CLAUSE.longest(clause, at)) {
            Some(count) => at += count,
            None if NEGATES_NO.has(token.word()) => {
                return true;
            }
            None => at += 1,
        }
    }
    false
}

/// Words beside the request for another try in a clause. `None` for a clause that does not ask for one, or
/// that denies it, bounds it or asks for another thing.
fn asks_again(clause: &[Token]) -> Option<Vec<&str>> {
    // Who asks something, or tells what somebody did, asks for nothing.
    let (mut at, mut tries, mut left) = (0, false, Vec::new());
    while let Some(token) = clause.get(at) {
        let taken = TRIES_AGAIN.longest(clause, at);
        match taken {
            Some(count) => {
                let said = clause.get(at..at + count)?;
                tries |= said.iter().any(|token| RETRY_WORDS.has(token.word()));
                at += count;
            }
            None if PLAIN_WORDS.has(token.word()) || AGREES.has(token.word()) => at += 1,
            None if DENIAL_WORDS.has(token.word()) => return None,
            None if verb(clause, at)
                .is_some_and(|(act, _)| !matches!(act, Act::Go | Act::Come | Act::Move)) =>
            {
                return None;
            }
            None if REPORT_WORDS.has(token.word()) => return None,
            // `try opening it again`
            None if matches!(base(token.word()), Some((_, Inflection::Gerund))) => return None,
            None => {
                left.push(token.word());
                at += 1;
            }
        }
    }
    tries.then_some(left)
}

/// True if a clause has no other words than those that agree.
fn is_plain(clause: &[Token]) -> bool {
    let mut at = 0;
    while let Some(token) = clause.get(at) {
        let taken = AGREES_PLAINLY.longest(clause, at);
        match taken {
            Some(count) => at += count,
            None if PLAIN_WORDS.has(token.word()) => at += 1,
            None => return false,
        }
    }
    true
}

/// Past words that only soften.
fn skip_soft(clause: &[Token], mut at: usize) -> usize {
    while clause.get(at).is_some_and(|token| SKIP_SOFT_SOFT.has(token.word())) {
        at += 1;
    }
    at
}

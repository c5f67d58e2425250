//! Noun phrases: a noun with its article, its count and what narrows it down; and places, a noun with a
//! preposition.

use crate::engine::effort;
use crate::engine::english::{
    BEHIND_REPORT, DEICTICS, DETERMINERS, ENDS_AT_CAN, GOES_NOWHERE, IT, KINDS_OF, LOOK_THERE, NARROWED_IS,
    NARROWED_LIKED, NEXT_PLACE, NOUN_ENDS, OPEN_NOUNS, PARTS_OF_THINGS, PHRASE_SOMETHING,
    PREPOSITIONS_OF_DIRECTION, PREPOSITIONS_OF_PLACE, PRONOUNS, SPEAKERS, SPOTS_GOES_ON, SUPERLATIVES,
    THAT_IS, USE_ENDS,
};
use crate::engine::phrases::Phrases;
use crate::engine::token::{Token, singular};
use crate::engine::vocabulary::{Role, good_for, is_package};

/// The determiner of a noun phrase: the one, any, a count, all.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Which {
    /// `the mug`: the one.
    The,
    /// `a mug`, `some chips`, `mug`: any.
    Any,
    Count(usize),
    /// `all mugs`, `every mug`, `both mugs`
    All,
}

/// A noun phrase or a pronoun.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum Noun {
    Speaker,
    /// `it`, `them`, `that`
    Before(&'static str),
    Here,
    There,
    Phrase(Phrase),
}

/// A noun with what narrows it down.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Phrase {
    /// As it was said.
    pub(crate) said: String,
    /// Its words in the singular; none for `something`.
    pub(crate) words: Vec<String>,
    pub(crate) content: Vec<String>,
    pub(crate) which: Which,
    pub(crate) is_plural: bool,
    pub(crate) good_for: Option<&'static str>,
    pub(crate) is: Vec<(bool, Vec<String>)>,
    pub(crate) place: Option<Box<Spot>>,
    /// `something that I would like`
    pub(crate) is_liked: bool,
    /// `the nearest`, `the bigger one`, `the mug nearest to the sink`
    pub(crate) extreme: Option<Extreme>,
}

/// A superlative, with its point of view.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Extreme {
    pub(crate) kind: ExtremeKind,
    pub(crate) from: Viewpoint,
}

/// The measure of a superlative, and the end of it that is meant.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum ExtremeKind {
    Nearest,
    Farthest,
    Largest,
    Smallest,
    Tallest,
    Shortest,
    Heaviest,
    Lightest,
}

/// Point from which distances count.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum Viewpoint {
    /// Nobody says from where: the person and the robot must agree.
    Open,
    /// `nearest to you`
    Robot,
    /// `nearest to the sink`, `nearest to me`
    Thing(Box<Noun>),
}

impl ExtremeKind {
    /// True for a measure that depends on a viewpoint.
    const fn is_distance(self) -> bool {
        match self {
            Self::Nearest | Self::Farthest => true,
            Self::Largest | Self::Smallest | Self::Tallest | Self::Shortest => false,
            Self::Heaviest | Self::Lightest => false,
        }
    }

    /// The measure of a name in the list of superlatives.
    pub(crate) fn named(name: &str) -> Option<Self> {
        Some(match name {
            "nearest" => Self::Nearest,
            "farthest" => Self::Farthest,
            "largest" => Self::Largest,
            "smallest" => Self::Smallest,
            "tallest" => Self::Tallest,
            "shortest" => Self::Shortest,
            "heaviest" => Self::Heaviest,
            "lightest" => Self::Lightest,
            _ => return None,
        })
    }
}

/// A noun that begins at a place, and where it ends.
pub(crate) fn noun(tokens: &[Token], at: usize) -> Option<(Noun, usize)> {
    let word = tokens.get(at).filter(|_| effort::step())?.word();
    if let Some(count) = SPEAKERS.longest(tokens, at) {
        return Some((Noun::Speaker, at + count));
    }
    let pronoun = PRONOUNS.value(word);
    if let Some(pronoun) = pronoun.filter(|_| IT.has(word) || ends(tokens, at + 1)) {
        return Some((Noun::Before(pronoun), at + 1));
    }
    match DEICTICS.value(word) {
        Some("here") => Some((Noun::Here, at + 1)),
        Some(_) => Some((Noun::There, at + 1)),
        None => phrase(tokens, at),
    }
}

fn ends(tokens: &[Token], at: usize) -> bool {
    match tokens.get(at) {
        None | Some(Token::Comma | Token::Stop) => true,
        Some(Token::Word(word)) if word == "can" => ENDS_AT_CAN.longest(tokens, at).is_some(),
        Some(Token::Word(word)) => NOUN_ENDS.has(word.as_str()) || is_direction(tokens, at),
    }
}

fn phrase(tokens: &[Token], begin: usize) -> Option<(Noun, usize)> {
    let (which, mut at) = determiner(tokens, begin);
    let mut words: Vec<String> = Vec::new();
    let mut content_at = None;
    let mut is_plural = false;
    let open = OPEN_NOUNS.valued(tokens, at);
    let is_open = open.is_some();
    let which = match open {
        Some((_, "all")) => Some(Which::All),
        Some(_) => Some(Which::Any),
        None => which,
    };
    at += open.map_or(0, |(count, _)| count);
    let mut extreme = None;
    while !ends(tokens, at) {
        let word = tokens.get(at).map_or("", Token::word);
        if let Some((found, after)) = superlative(tokens, at).filter(|_| extreme.is_none()) {
            (extreme, at) = (Some(found), after);
            continue;
        }
        // `hand the guest the magazine`
        if PHRASE_SOMETHING.has(word) {
            break;
        }
        at += 1;
        if (word == "of" && !words.is_empty()) || (words.is_empty() && KINDS_OF.has(word)) {
            // `the door of the fridge` is no other thing than the fridge.
            if matches!(words.as_slice(), [part] if PARTS_OF_THINGS.has(part)) {
                words.clear();
            }
            // `a bag of the chips`
            if words.last().is_some_and(|word| is_package(word)) {
                content_at = Some(words.len());
            }
            at = determiner(tokens, at).1;
            continue;
        }
        let one = singular(word);
        is_plural = one != word;
        words.push(one);
    }
    if words.is_empty() && !is_open && which.is_none() {
        return None;
    }
    let is_counted = matches!(which, Some(Which::All | Which::Count(_)));
    if words.is_empty() && !is_open && !is_counted && extreme.is_none() {
        return None;
    }
    // `the closest mug to the sink`
    if let Some(Extreme { from: from @ Viewpoint::Open, kind }) = &mut extreme
        && kind.is_distance()
        && let Some((point, after)) =
            viewpoint(tokens, at).filter(|(_, after)| is_viewpoint(tokens, (begin, at, *after)))
    {
        (*from, at) = (point, after);
    }
    let mut phrase = Phrase {
        said: String::new(),
        content: content_at.and_then(|at| words.get(at..)).unwrap_or_default().to_vec(),
        words,
        which: which.unwrap_or(Which::Any),
        is_plural,
        good_for: None,
        is: Vec::new(),
        place: None,
        is_liked: false,
        extreme,
    };
    if which.is_none() && !is_plural && !is_open {
        // `bring me sponge`: said in a hurry, and the one is meant as well as any.
        phrase.which = Which::Any;
    }
    let at = narrowed(tokens, at, &mut phrase);
    let said: Vec<_> = tokens.get(begin..at).unwrap_or_default().iter().map(Token::word).collect();
    phrase.said = said.join(" ");
    Some((Noun::Phrase(phrase), at))
}

/// Reads what comes behind a noun and narrows it down: `to eat`, `that is not a fruit`, `I would like`, `that
/// is on the table`.
fn narrowed(tokens: &[Token], mut at: usize, phrase: &mut Phrase) -> usize {
    loop {
        let word = tokens.get(at).map_or("", Token::word);
        let next = tokens.get(at + 1).map_or("", Token::word);
        if word == "to"
            && let Some(good_for) = good_for(next)
        {
            phrase.good_for = Some(good_for);
            at = rest_of_use(tokens, at + 2);
            continue;
        }
        if let Some(count) = NARROWED_LIKED.longest(tokens, at) {
            phrase.is_liked = true;
            at += count;
            continue;
        }
        if let Some(count) = NARROWED_IS.longest(tokens, at) {
            let after = at + count;
            let (is_so, after) = match tokens.get(after).map_or("", Token::word) {
                "not" => (false, after + 1),
                _ => (true, after),
            };
            if let (true, Some((place, end))) = (is_so, spot(tokens, after)) {
                phrase.place = Some(Box::new(place));
                at = end;
                continue;
            }
            let begin = determiner(tokens, after).1;
            if let (true, Some((extreme, end))) = (is_so, superlative(tokens, begin)) {
                phrase.extreme = Some(extreme);
                at = end;
                continue;
            }
            let mut end = begin;
            while !ends(tokens, end) {
                end += 1;
            }
            if end > begin {
                let words = tokens.get(begin..end).unwrap_or_default();
                let words = words.iter().map(|token| singular(token.word())).collect();
                phrase.is.push((is_so, words));
                at = end;
                continue;
            }
        }
        return at;
    }
}

/// `nearest`, `bigger one`, `nearest to the sink`, and where it ends.
fn superlative(tokens: &[Token], at: usize) -> Option<(Extreme, usize)> {
    let (count, name) = SUPERLATIVES.valued(tokens, at)?;
    let (kind, at) = (ExtremeKind::named(name)?, at + count);
    if !kind.is_distance() || !is_joint(tokens, at) {
        return Some((Extreme { kind, from: Viewpoint::Open }, at));
    }
    let (from, after) = viewpoint(tokens, at)?;
    Some((Extreme { kind, from }, after))
}

fn is_joint(tokens: &[Token], at: usize) -> bool {
    tokens.get(at).is_some_and(|token| matches!(token.word(), "to" | "from"))
}

/// `to the sink`, `from me`: from where a distance counts, and where it ends.
fn viewpoint(tokens: &[Token], at: usize) -> Option<(Viewpoint, usize)> {
    if !is_joint(tokens, at) {
        return None;
    }
    if tokens.get(at + 1).is_some_and(|token| token.word() == "you") {
        return Some((Viewpoint::Robot, at + 2));
    }
    let (noun, after) = noun(tokens, at + 1)?;
    Some((Viewpoint::Thing(Box::new(noun)), after))
}

/// True if what stands behind `the closest mug` says to what it is closest, and not where it is taken: the
/// place is said otherwise, or there is none.
fn is_viewpoint(tokens: &[Token], (begin, at, after): (usize, usize, usize)) -> bool {
    if tokens.get(at).is_some_and(|token| token.word() == "from") {
        return true;
    }
    let goes_nowhere =
        (begin.saturating_sub(2)..begin).any(|from| GOES_NOWHERE.longest(tokens, from) == Some(begin - from));
    let is_for_somebody = begin > 0 && SPEAKERS.longest(tokens, begin - 1) == Some(1);
    let is_alone = begin == 0 && matches!(tokens.get(after), None | Some(Token::Stop));
    goes_nowhere || is_for_somebody || is_alone || place(tokens, after).is_some()
}

/// `to clean it up with`: what still belongs to the use.
fn rest_of_use(tokens: &[Token], mut at: usize) -> usize {
    while let Some(Token::Word(word)) = tokens.get(at) {
        if USE_ENDS.has(word) {
            break;
        }
        at += 1;
    }
    at
}

/// An article or a count, and where the noun begins.
fn determiner(tokens: &[Token], at: usize) -> (Option<Which>, usize) {
    let word = tokens.get(at).map_or("", Token::word);
    // `the one that is blue`
    if THAT_IS.longest(tokens, at).is_some() {
        return (None, at);
    }
    let which = match DETERMINERS.value(word) {
        Some("the") => Which::The,
        Some("all") => Which::All,
        Some("any") => Which::Any,
        Some(count) => count.parse().map_or(Which::Any, Which::Count),
        None => return (None, at),
    };
    // `all the mugs`, `both of the mugs`, `one of the mugs`, `the two mugs`
    let mut at = at + 1;
    if tokens.get(at).is_some_and(|token| token.word() == "of") {
        at += 1;
    }
    match (which, determiner(tokens, at)) {
        (Which::All | Which::Count(_), (Some(Which::The | Which::All), after)) => (Some(which), after),
        (Which::The, (Some(Which::Count(_)), after)) => (Some(Which::All), after),
        (Which::Any, (Some(Which::Count(count)), after)) => (Some(Which::Count(count)), after),
        _ => (Some(which), at),
    }
}

/// A spatial relation of a thing to a place.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Relation {
    On,
    In,
    At,
    /// `to`: whichever the place asks for.
    To,
    /// `next to`, `near`, `in front of`: near a place, and neither on nor in it.
    Beside,
}

/// A place with its preposition.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Spot {
    pub(crate) relation: Relation,
    /// The preposition as it was said.
    pub(crate) preposition: String,
    pub(crate) noun: Noun,
    pub(crate) is_behind_thing: bool,
}

impl Spot {
    /// True if it can only say where to: `onto`, `into`, `to`.
    pub(crate) fn moves(&self) -> bool {
        !PREPOSITIONS_OF_PLACE.has(&self.preposition)
    }

    /// As it was said.
    pub(crate) fn said(&self) -> String {
        let noun = match &self.noun {
            Noun::Speaker => "me",
            Noun::Before(word) => word,
            Noun::Here => "here",
            Noun::There => "there",
            Noun::Phrase(phrase) => &phrase.said,
        };
        format!("{} {noun}", self.preposition)
    }
}

impl Relation {
    /// The relation of a name in the lists of prepositions.
    fn named(name: &str) -> Option<Self> {
        Some(match name {
            "on" => Self::On,
            "in" => Self::In,
            "at" => Self::At,
            "to" => Self::To,
            "beside" => Self::Beside,
            _ => return None,
        })
    }

    /// True if something can be so to a thing of this role: on a shelf, in a drawer. A sink and a
    /// shelf have things in them as well as on them; what lies in a mug is not known.
    pub(crate) const fn fits(self, role: Role) -> bool {
        match self {
            Self::On => matches!(role, Role::Surface | Role::Object | Role::Place),
            Self::In => matches!(role, Role::Surface | Role::Container | Role::Place),
            Self::At | Self::To => true,
            Self::Beside => false,
        }
    }
}

/// `on the table`, `in the drawer`, `at the counter`
pub(crate) fn located(tokens: &[Token], at: usize) -> Option<(Noun, usize)> {
    spot(tokens, at).map(|(spot, after)| (spot.noun, after))
}

/// The same with its preposition.
pub(crate) fn spot(tokens: &[Token], at: usize) -> Option<(Spot, usize)> {
    let is_static = PREPOSITIONS_OF_DIRECTION.longest(tokens, at) < PREPOSITIONS_OF_PLACE.longest(tokens, at);
    is_static.then(|| placed(tokens, at, &PREPOSITIONS_OF_PLACE)).flatten()
}

/// A place with a preposition of place or of direction.
pub(crate) fn place(tokens: &[Token], at: usize) -> Option<(Spot, usize)> {
    spot(tokens, at).or_else(|| direction(tokens, at))
}

/// `to the table`, `into the drawer`, `next to the sink`: where to, or near what.
pub(crate) fn direction(tokens: &[Token], at: usize) -> Option<(Spot, usize)> {
    placed(tokens, at, &PREPOSITIONS_OF_DIRECTION)
}

/// True if a preposition of direction, or of near by, stands here.
pub(crate) fn is_direction(tokens: &[Token], at: usize) -> bool {
    PREPOSITIONS_OF_DIRECTION.longest(tokens, at) > PREPOSITIONS_OF_PLACE.longest(tokens, at)
}

fn placed(tokens: &[Token], at: usize, prepositions: &Phrases) -> Option<(Spot, usize)> {
    let (count, relation) = prepositions.valued(tokens, at)?;
    let relation = Relation::named(relation)?;
    let (noun, after) = noun(tokens, at + count)?;
    let preposition: Vec<_> = tokens.get(at..at + count)?.iter().map(Token::word).collect();
    Some((Spot { relation, preposition: preposition.join(" "), noun, is_behind_thing: false }, after))
}

/// Places to the end of a clause: `in the fridge or in the cupboard`, `the fridge first and then the drawer`.
pub(crate) fn spots(tokens: &[Token], mut at: usize, may_be_bare: bool) -> Option<Vec<Spot>> {
    let mut spots: Vec<Spot> = Vec::new();
    loop {
        // `the cupboard yesterday`, `the fridge first and then …`: a place ends before such words, `the first
        // drawer` does not.
        let whole = tokens;
        let is_end = |end: &usize| {
            let after = skip(whole, *end, &BEHIND_REPORT);
            after > *end && (after == whole.len() || NEXT_PLACE.longest(whole, after).is_some())
        };
        let end = (at + 1..whole.len()).find(is_end).unwrap_or(whole.len());
        let tokens = whole.get(..end)?;
        let bare = || {
            let (noun, after) = noun(tokens, at)?;
            let is_named = matches!(noun, Noun::Phrase(_));
            let spot =
                Spot { relation: Relation::To, preposition: String::new(), noun, is_behind_thing: false };
            (is_named && (may_be_bare || !spots.is_empty())).then_some((spot, after))
        };
        let (spot, after) = place(tokens, at).or_else(bare)?;
        spots.push(spot);
        at = skip(whole, after, &BEHIND_REPORT);
        if at >= whole.len() || (at > 0 && SPOTS_GOES_ON.longest(whole, at).is_some()) {
            return Some(spots);
        }
        at += NEXT_PLACE.longest(whole, at)?;
        at = skip(whole, at, &LOOK_THERE);
    }
}

/// Past phrases of a list that stand one behind another.
pub(crate) fn skip(tokens: &[Token], at: usize, skipped: &Phrases) -> usize {
    at + skipped.run(tokens, at)
}

#[cfg(test)]
mod tests {
    use super::{Noun, Phrase, Relation, Which, direction, noun, spot};
    use crate::engine::token::tokens;

    fn phrase(text: &str) -> (Phrase, usize) {
        match noun(&tokens(text), 0) {
            Some((Noun::Phrase(phrase), end)) => (phrase, end),
            other => panic!("{text}: {other:?}"),
        }
    }

    #[test]
    fn noun_phrase_has_a_determiner_words_and_an_end() {
        for (text, which, words, end) in [
            ("the red mugs on the table", Which::The, "red mug", 3),
            ("two of the glasses", Which::Count(2), "glass", 4),
            ("everything on the table", Which::All, "", 1),
            ("a can of the coke", Which::Any, "can coke", 5),
        ] {
            let (phrase, after) = phrase(text);
            assert_eq!((phrase.which, phrase.words.join(" ").as_str(), after), (which, words, end), "{text}");
        }
    }

    #[test]
    fn noun_phrase_is_narrowed_by_what_follows() {
        assert_eq!(phrase("something to drink").0.good_for, Some("drink"));
        assert_eq!(phrase("something that is not a coke").0.is, [(false, vec!["coke".to_owned()])]);
    }

    #[test]
    fn pronouns_are_nouns() {
        assert_eq!(noun(&tokens("it"), 0), Some((Noun::Before("it"), 1)));
        assert_eq!(noun(&tokens("me"), 0), Some((Noun::Speaker, 1)));
        assert_eq!(noun(&tokens("there"), 0), Some((Noun::There, 1)));
    }

    #[test]
    fn spot_has_a_static_preposition_and_direction_a_dynamic_one() {
        assert_eq!(spot(&tokens("on the table"), 0).map(|(spot, _)| spot.relation), Some(Relation::On));
        assert_eq!(spot(&tokens("onto the table"), 0), None);
        assert!(direction(&tokens("into the drawer"), 0).is_some_and(|(place, _)| place.moves()));
        assert_eq!(
            direction(&tokens("next to the sink"), 0).map(|(place, _)| place.relation),
            Some(Relation::Beside)
        );
    }
}

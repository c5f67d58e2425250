//! Readers that the rules call by name: nouns, places and verbs, and what stands around them.

use std::cell::RefCell;
use std::collections::HashMap;

use crate::engine::asking::{overtures, skip_leads, wish};
use crate::engine::english::{DEICTICS, OF_IT};
use crate::engine::noun::{Noun, Relation, Spot, direction, is_direction, noun, place, spot, spots};
use crate::engine::phrases::{List, list};
use crate::engine::rewrite::remark_end;
use crate::engine::token::{Token, words};
use crate::engine::verb::{Act, Inflection, apart, base, begins, of_past, verb};

/// Tokens of a request, with what a rule knows of the place where it began.
pub(crate) struct Clause<'a> {
    pub(crate) tokens: &'a [Token],
    pub(crate) begin: usize,
    /// The act of the command that this belongs to, or that stands before it.
    act: Option<Act>,
    /// Names of what that command says.
    facts: &'a [&'a str],
    /// Ends that a noun may have, by where it begins.
    things: RefCell<HashMap<usize, Vec<usize>>>,
}

/// An end, and what is read where it is other than the words that stand there.
type Read = (usize, Option<Vec<Token>>);

type Reader = fn(&Clause<'_>, &'static str, usize) -> Vec<Read>;

/// The readers by name. One that takes no word only checks.
const READERS: &[(&str, Reader)] = &[
    // Words and marks.
    ("word", |clause, _, at| clause.taken(!clause.word(at).is_empty(), at, 1)),
    ("end", |clause, _, at| clause.check(clause.is_end(at), at)),
    ("rest", |clause, _, at| vec![(clause.clause_end(at), None)]),
    ("some", |clause, _, at| (at + 1..=clause.clause_end(at)).map(|end| (end, None)).collect()),
    ("any", |clause, _, at| (at..=clause.clause_end(at)).map(|end| (end, None)).collect()),
    ("owner", |clause, _, at| {
        let owner = clause.word(at).strip_suffix("'s").filter(|owner| !owner.is_empty());
        owner.map(|owner| (at + 1, Some(words(owner)))).into_iter().collect()
    }),
    ("adverb", |clause, _, at| {
        clause.taken(clause.word(at).len() > 4 && clause.word(at).ends_with("ly"), at, 1)
    }),
    // Nouns.
    ("noun", |clause, _, at| clause.noun(at, |_| true)),
    ("short", |clause, _, at| {
        clause.noun(at, |_| true).into_iter().filter(|(end, _)| end - at <= 4).collect()
    }),
    ("phrase", |clause, _, at| clause.noun(at, |noun| matches!(noun, Noun::Phrase(_)))),
    ("pronoun", |clause, _, at| clause.noun(at, |noun| matches!(noun, Noun::Before(_)))),
    ("speaker", |clause, _, at| clause.noun(at, |noun| matches!(noun, Noun::Speaker))),
    ("item", |clause, _, at| {
        clause.noun(
            at,
            |noun| matches!(noun, Noun::Phrase(phrase) if !phrase.words.is_empty() && phrase.place.is_none()),
        )
    }),
    ("named", |clause, _, at| {
        let named = |end: &usize| {
            matches!(noun(clause.tokens.get(..*end).unwrap_or_default(), at),
                Some((Noun::Phrase(phrase), _)) if !phrase.words.is_empty())
        };
        clause.things(at).into_iter().filter(named).map(|end| (end, None)).collect()
    }),
    ("thing", |clause, _, at| clause.things(at).into_iter().map(|end| (end, None)).collect()),
    // Places.
    ("spot", |clause, _, at| one(spot(clause.tokens, at).map(|(_, end)| end))),
    ("located", |clause, _, at| clause.place(at, |_| true)),
    ("anywhere", |clause, _, at| {
        clause.place(at, |place| !matches!(place.noun, Noun::Before(_)) && place.relation != Relation::Beside)
    }),
    ("place", |clause, _, at| {
        clause.place(at, |place| matches!(place.noun, Noun::Phrase(_)) && place.relation != Relation::Beside)
    }),
    ("inside", |clause, _, at| {
        clause.place(at, |place| {
            matches!(place.noun, Noun::Phrase(_)) && matches!(place.relation, Relation::In | Relation::On)
        })
    }),
    ("to", |clause, _, at| {
        let to = direction(clause.tokens, at)
            .filter(|(place, _)| place.relation == Relation::To && matches!(place.noun, Noun::Phrase(_)));
        one(to.map(|(_, end)| end))
    }),
    ("toward", |clause, _, at| clause.check(is_direction(clause.tokens, at), at)),
    ("somewhere", |clause, _, at| {
        let leads = direction(clause.tokens, at).is_some_and(|(place, _)| place.relation != Relation::To);
        clause.check(leads || spot(clause.tokens, at).is_some() || clause.stands("whereto", at).is_some(), at)
    }),
    // Verbs, each read as its base.
    ("base", |clause, _, at| clause.form(at, Inflection::Base)),
    ("gerund", |clause, _, at| clause.form(at, Inflection::Gerund)),
    ("participle", |clause, _, at| clause.form(at, Inflection::Participle)),
    ("past", |clause, _, at| clause.verb(at, of_past(clause.word(at)))),
    ("verb", |clause, argument, at| {
        let is_it = |act: &Act| argument.is_empty() || Act::named(argument) == Some(*act);
        one(verb(clause.tokens, at).filter(|(act, _)| is_it(act)).map(|(_, end)| end))
    }),
    ("begins", |clause, _, at| clause.check(begins(clause.tokens, at), at)),
    ("leads", |clause, _, at| {
        // What leads up to a request may be the first words of it: `help me out`.
        let is_led = |end: &usize| clause.tokens.get(..*end).is_some_and(|here| skip_leads(here, at) == *end);
        (at..=skip_leads(clause.tokens, at)).rev().filter(is_led).map(|end| (end, None)).collect()
    }),
    ("wish", |clause, _, at| one(wish(clause.tokens, at).map(|count| at + count))),
    ("wants", |clause, _, at| {
        let state = clause.stands("wants_state", at).map(|count| at + count);
        one(state.max(wish(clause.tokens, at).map(|count| at + count)))
    }),
    ("apart", |clause, _, at| {
        apart(clause.tokens, at).map(|(end, said)| (end, Some(said))).into_iter().collect()
    }),
    ("overture", |clause, _, at| {
        overtures(clause.tokens, at).into_iter().rev().map(|end| (end, None)).collect()
    }),
    // What was said before.
    ("opening", |clause, _, at| clause.check(at == 0, at)),
    ("first", |clause, _, at| clause.check(at == 0 || clause.tokens.get(at - 1) == Some(&Token::Stop), at)),
    ("later", |clause, _, at| {
        clause.check(clause.tokens.get(..at).unwrap_or_default().contains(&Token::Stop), at)
    }),
    ("start", |clause, _, at| clause.check(at == 0 || clause.is_end(at - 1), at)),
    ("did", |clause, argument, at| {
        let acts = argument.split(' ').filter_map(Act::named);
        clause.check(acts.into_iter().any(|act| clause.act == Some(act)), at)
    }),
    ("is", |clause, argument, at| clause.check(clause.facts.contains(&argument), at)),
    ("lacks", |clause, argument, at| {
        clause.check(!argument.split(' ').any(|fact| clause.facts.contains(&fact)), at)
    }),
    ("said", |clause, argument, at| {
        let sentence = clause.tokens.get(clause.sentence(at)..at).unwrap_or_default();
        clause.check(has(sentence, argument), at)
    }),
    ("earlier", |clause, argument, at| {
        clause.check(has(clause.tokens.get(..at).unwrap_or_default(), argument), at)
    }),
    ("matched", |clause, argument, at| {
        clause.check(has(clause.tokens.get(clause.begin..at).unwrap_or_default(), argument), at)
    }),
    ("opened", |clause, argument, at| {
        let end = |token: &Token| matches!(token, Token::Comma | Token::Stop);
        let before = clause.tokens.get(..at).unwrap_or_default();
        let begin = before.iter().rposition(end).map_or(0, |at| at + 1);
        clause.check(clause.stands(argument, begin).is_some(), at)
    }),
    ("unasked", |clause, _, at| clause.check((0..at).all(|at| verb(clause.tokens, at).is_none()), at)),
    ("bare", |clause, _, at| {
        let before = clause.tokens.get(..at).unwrap_or_default();
        let sentence = before.rsplit(|token| *token == Token::Stop).next().unwrap_or_default();
        let named = noun(sentence, skip_leads(sentence, 0));
        let is_bare = matches!(named, Some((Noun::Phrase(_), end)) if end == sentence.len());
        clause.check(is_bare && !begins(sentence, 0), at)
    }),
    ("asked", |clause, _, at| {
        let before = clause.tokens.get(..at).unwrap_or_default();
        let sentence = before.rsplit(|token| *token == Token::Stop).next().unwrap_or_default();
        clause.check(has(before, "and") || verb(sentence, skip_leads(sentence, 0)).is_some(), at)
    }),
    // What comes behind.
    ("remark", |clause, argument, at| {
        let end = remark_end(clause.tokens, at);
        let is_bound = !argument.is_empty() && has(clause.tokens.get(at..end).unwrap_or_default(), argument);
        one((!is_bound).then_some(end))
    }),
    ("goes_on", |clause, _, at| {
        let end = remark_end(clause.tokens, clause.begin);
        clause.check((end..clause.tokens.len()).any(|at| begins(clause.tokens, at)), at)
    }),
    ("spots", |clause, _, at| clause.check(spots(clause.tokens, at, false).is_some(), at)),
    ("holds", |clause, argument, at| {
        clause.check(has(clause.tokens.get(at..clause.clause_end(at)).unwrap_or_default(), argument), at)
    }),
    ("ahead", |clause, argument, at| {
        let rest = clause.tokens.get(at..).unwrap_or_default();
        clause.check(has(rest.split(|token| *token == Token::Stop).next().unwrap_or_default(), argument), at)
    }),
    ("handled", |clause, _, at| {
        // What was named last is done something with.
        let limit = clause.clause_end(at);
        let please = usize::from(clause.word(limit + 1) == "please");
        let mut begin = limit + 1 + please;
        while clause.tokens.get(begin) == Some(&Token::Comma) || clause.word(begin) == "and" {
            begin += 1;
        }
        begin = skip_leads(clause.tokens, begin);
        begin += usize::from(clause.word(begin) == "you");
        let here = clause.tokens.get(begin..clause.clause_end(begin)).unwrap_or_default();
        let is_of_it =
            here.iter().any(|token| OF_IT.has(token.word()) || DEICTICS.value(token.word()) == Some("there"));
        clause.check(is_of_it && begins(clause.tokens, begin), at)
    }),
];

/// The number of the reader of a name.
pub(crate) fn number(name: &str) -> Option<usize> {
    READERS.iter().position(|(known, _)| *known == name)
}

/// All ends of what a reader finds at a place, in the order in which they are tried.
pub(crate) fn read(clause: &Clause<'_>, number: usize, argument: &'static str, at: usize) -> Vec<Read> {
    READERS.get(number).map(|(_, reader)| reader(clause, argument, at)).unwrap_or_default()
}

/// True if a phrase of a list, or a word, stands among some tokens.
fn has(tokens: &[Token], what: &str) -> bool {
    match list(what) {
        Some(List::Phrases(phrases)) => (0..tokens.len()).any(|at| phrases.longest(tokens, at).is_some()),
        Some(List::Rules(_)) => false,
        None => tokens.iter().any(|token| token.word() == what),
    }
}

fn one(end: Option<usize>) -> Vec<Read> {
    end.map(|end| (end, None)).into_iter().collect()
}

impl<'a> Clause<'a> {
    pub(crate) fn new(tokens: &'a [Token], begin: usize, act: Option<Act>, facts: &'a [&'a str]) -> Self {
        Self { tokens, begin, act, facts, things: RefCell::default() }
    }

    fn word(&self, at: usize) -> &str {
        self.tokens.get(at).map_or("", Token::word)
    }

    fn is_end(&self, at: usize) -> bool {
        matches!(self.tokens.get(at), None | Some(Token::Comma | Token::Stop))
    }

    fn clause_end(&self, at: usize) -> usize {
        (at..self.tokens.len()).find(|at| self.is_end(*at)).unwrap_or(self.tokens.len().max(at))
    }

    /// The beginning of the sentence before a place.
    fn sentence(&self, at: usize) -> usize {
        let before = self.tokens.get(..at.saturating_sub(1)).unwrap_or_default();
        before.iter().rposition(|token| *token == Token::Stop).map_or(0, |at| at + 1)
    }

    fn stands(&self, name: &str, at: usize) -> Option<usize> {
        match list(name)? {
            List::Phrases(phrases) => phrases.longest(self.tokens, at),
            List::Rules(_) => None,
        }
    }

    fn check(&self, is_so: bool, at: usize) -> Vec<Read> {
        self.taken(is_so, at, 0)
    }

    fn taken(&self, is_so: bool, at: usize, count: usize) -> Vec<Read> {
        one(is_so.then_some(at + count))
    }

    fn noun(&self, at: usize, fits: fn(&Noun) -> bool) -> Vec<Read> {
        one(noun(self.tokens, at).filter(|(noun, _)| fits(noun)).map(|(_, end)| end))
    }

    /// The ends that a noun has if what comes behind them is no part of it.
    fn things(&self, at: usize) -> Vec<usize> {
        if let Some(ends) = self.things.borrow().get(&at) {
            return ends.clone();
        }
        let ends_at = |end: &usize| {
            self.tokens.get(..*end).and_then(|here| noun(here, at)).is_some_and(|(_, after)| after == *end)
        };
        let ends: Vec<usize> = (at + 1..=self.clause_end(at)).filter(ends_at).collect();
        self.things.borrow_mut().insert(at, ends.clone());
        ends
    }

    fn place(&self, at: usize, fits: fn(&Spot) -> bool) -> Vec<Read> {
        one(place(self.tokens, at).filter(|(place, _)| fits(place)).map(|(_, end)| end))
    }

    fn form(&self, at: usize, form: Inflection) -> Vec<Read> {
        self.verb(at, base(self.word(at)).filter(|(_, found)| *found == form).map(|(verb, _)| verb))
    }

    fn verb(&self, at: usize, verb: Option<String>) -> Vec<Read> {
        verb.map(|verb| (at + 1, Some(words(&verb)))).into_iter().collect()
    }
}

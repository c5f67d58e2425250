//! Sentences as commands and statements: which verb, what it is about, where from and where to.

use crate::argument::part;
use crate::engine::english::{
    BUT_DO_NOT, GOES_ON_AT_HITHER, GOES_ON_DO_NOT, ONTO, PART_FOLLOWS_OVER, PREDICATES, SAYS_WHERE, SERIES,
    WHERE_IT_BELONGS,
};
use crate::engine::noun::{Noun, Relation, Spot, Which, is_direction, located, noun, place, spot};
use crate::engine::rule::Rules;
use crate::engine::token::{Token, stands};
use crate::engine::verb::{Act, begins, is_want, verb};
use crate::remark::is_boundary;

/// One thing that is asked for.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Command {
    pub(super) act: Act,
    pub(super) items: Vec<Noun>,
    pub(super) to_whom: Option<Noun>,
    pub(super) to: Option<Spot>,
    pub(super) from: Option<Noun>,
    /// `away`, `down`, `up`, `back`, `over`: what the verb goes with.
    pub(super) with: Vec<String>,
    pub(super) thing_end: usize,
}

/// Among what a verb goes with: it is done only where it is not so yet.
pub(super) const ONLY_IF: &str = "only_if";

/// Among what a verb goes with: where it belongs, which was said or has to be.
pub(super) const BELONGS: &str = "belongs";

/// Among what a verb goes with: it shall stay there, since it belongs there.
pub(super) const KEPT: &str = "kept";

/// Among what a verb goes with: it is no verb, but somebody says that they want something.
pub(super) const WANTED: &str = "wanted";

pub(super) fn words(tokens: &[Token], begin: usize, end: usize) -> String {
    let words: Vec<_> = tokens.get(begin..end).unwrap_or_default().iter().map(Token::word).collect();
    words.join(" ").trim().to_owned()
}

/// Reads one command, or several that share a verb; where the next thing begins.
pub(super) fn command(tokens: &[Token], begin: usize, commands: &mut Vec<Command>) -> Result<usize, String> {
    let Some((act, mut at)) = verb(tokens, begin) else { return Err(words(tokens, begin, tokens.len())) };
    let mut now = Command::new(act);
    let lost = |at: usize| Err(words(tokens, begin, tokens.len().min(at + 4)));
    if is_want(tokens, begin) {
        now.with.push(WANTED.to_owned());
    }
    if stands(tokens, begin, "keep").is_some() {
        now.with.push(KEPT.to_owned());
    }
    loop {
        match tokens.get(at) {
            None | Some(Token::Stop) => break,
            // `pick it up, but do not bring it`
            Some(Token::Word(_)) if BUT_DO_NOT.longest(tokens, at).is_some() => break,
            Some(Token::Word(word)) if !SERIES.has(word) => {
                at = part(tokens, begin, at, &mut now)?;
            }
            Some(Token::Comma | Token::Word(_)) => {
                let after = skip_and(tokens, at);
                // `to the drawer, where it lives`
                if now.to.is_some()
                    && let Some(count) = WHERE_IT_BELONGS.longest(tokens, after)
                    && is_boundary(tokens, after + count)
                {
                    at = after + count;
                    continue;
                }
                if begins(tokens, after) {
                    break;
                }
                if goes_on(&mut now, commands, tokens, after) {
                    at = after;
                    continue;
                }
                if !is_another_place(&now, tokens, after) {
                    break;
                }
                // `put it on the table and then on the shelf`: first there, then there. Without `then` it is
                // in no two places.
                if !tokens
                    .get(at..after)
                    .is_some_and(|joint| joint.iter().any(|token| token.word() == "then"))
                {
                    return lost(after);
                }
                let next =
                    Command { items: now.items.clone(), with: now.with.clone(), ..Command::new(now.act) };
                commands.push(std::mem::replace(&mut now, next));
                at = after;
            }
        }
    }
    left_out(&mut now, commands);
    // `race you to the sink! Go!`
    let is_echo = stands(tokens, begin, "go").is_some()
        && now.act == Act::Go
        && now.items.is_empty()
        && now.to.is_none()
        && commands.last().is_some_and(|last| last.act == now.act && last.to.is_some());
    if !is_echo {
        commands.push(now);
    }
    Ok(at)
}

/// `take the mug and put in the drawer`, `I want it! Give me!`: of what it is not said, it is that of which
/// it was said just before.
fn left_out(now: &mut Command, commands: &[Command]) {
    let carries = |act: Act| !matches!(act, Act::Go | Act::Come | Act::Open | Act::Close | Act::Find);
    let says_more =
        now.to.is_some() || now.to_whom.is_some() || now.with.iter().any(|word| SAYS_WHERE.has(word));
    let before = commands.iter().rev().find(|command| carries(command.act) && !command.items.is_empty());
    if carries(now.act) && now.act != Act::Release && now.items.is_empty() && says_more && before.is_some() {
        now.items.push(Noun::Before("it"));
    }
}

/// True if another place follows for a thing that has one already.
fn is_another_place(now: &Command, tokens: &[Token], at: usize) -> bool {
    let Some((place, end)) = place(tokens, at) else { return false };
    let is_placed = now.to.is_some() && !now.items.is_empty();
    let is_named = matches!(place.noun, Noun::Phrase(_) | Noun::Speaker);
    is_placed && is_named && place.relation != Relation::Beside && is_boundary(tokens, end)
}

fn skip_and(tokens: &[Token], mut at: usize) -> usize {
    while tokens.get(at).is_some_and(|token| SERIES.has(token.word()) || *token == Token::Comma) {
        at += 1;
    }
    at
}

/// Behind an `and` or a comma another thing follows for the same verb. What had its place already is a
/// command of its own.
fn goes_on(now: &mut Command, commands: &mut Vec<Command>, tokens: &[Token], at: usize) -> bool {
    // `… and do not let go`, `…, it is hot`: a clause of its own.
    let is = |after: usize| tokens.get(after).is_some_and(|token| PREDICATES.has(token.word()));
    let is_clause = GOES_ON_DO_NOT.longest(tokens, at).is_some();
    let another = noun(tokens, at).is_some_and(|(noun, after)| match noun {
        Noun::Phrase(_) => !is(after) && !is_clause,
        // `…, it stinks` tells something of it.
        Noun::Before(_) => is_boundary(tokens, after) || part_follows(tokens, after),
        Noun::Speaker | Noun::Here | Noun::There => false,
    });
    let another_place = located(tokens, at).is_some() || stands(tokens, at, "to").is_some();
    let is_place = another_place && matches!(now.act, Act::Go | Act::Move);
    // `put it where it belongs, in the drawer`, `get it out of here and into the bin`
    if now.to.is_none() && (another_place && now.has("back") || is_place_for_it(now, tokens, at)) {
        return true;
    }
    if !(another || is_place) {
        return false;
    }
    // `give it here, the coke`: what `it` is.
    let is_apart = at.checked_sub(1).is_some_and(|at| tokens.get(at) == Some(&Token::Comma));
    if is_apart
        && now.act == Act::Fetch
        && now.to.as_ref().is_none_or(|to| to.noun == Noun::Speaker)
        && matches!(now.items.as_slice(), [Noun::Before(_)])
    {
        let named =
            noun(tokens, at).filter(|(_, after)| matches!(tokens.get(*after), None | Some(Token::Stop)));
        if matches!(named, Some((Noun::Phrase(_), _))) {
            now.items.clear();
            return true;
        }
    }
    if now.to.is_some() && !matches!(now.act, Act::Go | Act::Come) {
        let next = Command { with: now.with.clone(), to_whom: None, ..Command::new(now.act) };
        commands.push(std::mem::replace(now, next));
    } else if let (Act::Go | Act::Come | Act::Move, Some(_)) = (now.act, &now.to) {
        let next = Command::new(Act::Go);
        commands.push(std::mem::replace(now, next));
    }
    true
}

/// True if what follows a thing says where it goes or for whom.
fn part_follows(tokens: &[Token], at: usize) -> bool {
    spot(tokens, at).is_some() || is_direction(tokens, at) || PART_FOLLOWS_OVER.longest(tokens, at).is_some()
}

/// True if a place follows for what is taken, hidden or put, of which it was not said before where to.
fn is_place_for_it(now: &Command, tokens: &[Token], at: usize) -> bool {
    let takes = matches!(
        now.act,
        Act::Put
            | Act::Stow
            | Act::Store
            | Act::Take
            | Act::Throw
            | Act::Move
            | Act::Pick
            | Act::Lift
            | Act::Fetch
    );
    takes
        && !now.items.is_empty()
        && place(tokens, at).is_some_and(|(place, end)| {
            place.relation != Relation::Beside
                && is_boundary(tokens, end)
                && (now.act != Act::Fetch || now.to_whom.is_none())
        })
}

impl Command {
    /// `hide it! In the drawer!`: a place that is said in a sentence of its own; where it ends.
    pub(super) fn goes_on_at(&mut self, tokens: &[Token], at: usize) -> Option<usize> {
        let takes = matches!(
            self.act,
            Act::Put | Act::Stow | Act::Store | Act::Take | Act::Throw | Act::Move | Act::Fetch
        );
        if !takes || self.items.is_empty() || self.to.is_some() {
            return None;
        }
        let is_end = |end: usize| matches!(tokens.get(end), None | Some(Token::Stop | Token::Comma));
        if let Some(end) =
            GOES_ON_AT_HITHER.longest(tokens, at).map(|count| at + count).filter(|end| is_end(*end))
        {
            self.to_whom.get_or_insert(Noun::Speaker);
            return Some(end);
        }
        let (place, end) = place(tokens, at)?;
        let is_named = matches!(place.noun, Noun::Phrase(_)) && place.relation != Relation::Beside;
        // Who brings something in a place is told where it is.
        if !is_named || !is_end(end) || (self.act == Act::Fetch && !self.has(WANTED) && !place.moves()) {
            return None;
        }
        self.put_at(place);
        if self.act == Act::Move {
            self.act = Act::Put;
        }
        Some(end)
    }

    /// `fetch! The sponge!`: what it is about, in a sentence of its own; where it ends.
    pub(super) fn is_about(&mut self, tokens: &[Token], at: usize) -> Option<usize> {
        if !self.items.is_empty() || matches!(self.act, Act::Go | Act::Come | Act::Find | Act::Move) {
            return None;
        }
        let (thing, end) = noun(tokens, at)?;
        let is_end = matches!(tokens.get(end), None | Some(Token::Stop | Token::Comma));
        if !is_end || !matches!(&thing, Noun::Phrase(phrase) if phrase.which == Which::The) {
            return None;
        }
        self.items.push(thing);
        Some(end)
    }

    /// Takes what was spoken of for the thing where none is said, but where it goes.
    pub(super) fn is_of_what_was_said(&mut self) {
        let puts = matches!(self.act, Act::Put | Act::Store | Act::Stow | Act::Throw | Act::Discard);
        let is_whole = matches!(self.act, Act::Discard | Act::Open | Act::Close);
        if self.items.is_empty() && ((puts && self.to.is_some()) || is_whole) {
            self.items.push(Noun::Before("it"));
        }
    }

    fn new(act: Act) -> Self {
        let (items, with) = (Vec::new(), Vec::new());
        Self { act, items, to_whom: None, to: None, from: None, with, thing_end: 0 }
    }

    /// Takes in a place. `put the mug on the table in the drawer`: the last is where to, the others say
    /// which.
    pub(super) fn put_at(&mut self, place: Spot) {
        // `over there on the table`
        if self.to.as_ref().is_some_and(|to| to.noun == Noun::There) {
            self.to = None;
        }
        if let Some(before) = self.to.replace(place)
            && !before.moves()
            && self.from.is_none()
        {
            self.from = Some(before.noun);
        }
    }

    /// The verb with its small words.
    pub(super) fn act(&self) -> Act {
        let found = Rules("act").given(&[], 0, self.act, &self.facts());
        found.and_then(|found| Act::named(found.words.first()?.word())).unwrap_or(self.act)
    }

    /// Names of what it says, for the rules.
    pub(super) fn facts(&self) -> Vec<&str> {
        let is = [
            ("items", !self.items.is_empty()),
            ("to", self.to.is_some()),
            ("whom", self.to_whom.is_some()),
            ("from", self.from.is_some()),
            ("moving", self.to.as_ref().is_some_and(Spot::moves)),
            ("onto", self.to.as_ref().is_some_and(|to| ONTO.has(&to.preposition))),
        ];
        let said = is.into_iter().filter(|(_, is_so)| *is_so).map(|(name, _)| name);
        said.chain(self.with.iter().map(String::as_str)).collect()
    }

    pub(super) fn has(&self, particle: &str) -> bool {
        self.with.iter().any(|word| word == particle)
    }
}

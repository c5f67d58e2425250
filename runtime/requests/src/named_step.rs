//! Requests beside goals: steps by their name, conditions that a request waits for or depends on, what stays
//! out of it, and preferences. They are read where a request has no other reading.

use motet_compiler::plan::{Persistence, fact};
use motet_stdlib::lang::{entities, fluents};
use motet_syntax::Span;
use motet_syntax::ast::{Expr, ExprKind};
use smol_str::SmolStr;

use crate::command::{Command, words};
use crate::command_goal::{all_of, not};
use crate::engine::asking::skip_leads;
use crate::engine::english::{STATES, TURNS_BY};
use crate::engine::noun::noun;
use crate::engine::rewrite::plain;
use crate::engine::rule::Rules;
use crate::engine::token::Token;
use crate::engine::vocabulary::Role;
use crate::meaning::{HOLDERS, OBJECTS, Reader};
use crate::parse::{self, Spoken};
use crate::{Aim, Intent, NamedStep, Preference, RequestContext, RequestError};

/// Pieces of a request, in order.
enum Piece {
    /// A step: its name, and the words of what it is about.
    Step(Vec<Token>),
    Turn(i32),
    Words(Vec<Token>),
}

/// A condition of a request.
struct Guard {
    /// `open`, `closed`, `empty` or `full`.
    state: &'static str,
    thing: Vec<Token>,
    /// True if it is waited for.
    waits: bool,
    /// True if it stands before what is asked for.
    leads: bool,
}

/// Understands a request that asks for steps by their name, or that depends on a condition. `None` for any
/// other request.
pub(super) fn understood(
    tokens: &[Token],
    request: &str,
    situation: &RequestContext<'_>,
) -> Option<Result<Intent, RequestError>> {
    let mut rest = tokens.to_vec();
    let begin = skip_leads(&rest, 0);
    let watched = Rules("watches").at(&rest, begin);
    if let Some(watched) = &watched {
        rest.drain(..watched.end);
    }
    let guard = guard(&mut rest);
    let pieces = pieces(&rest);
    let has_step = pieces.iter().any(|piece| !matches!(piece, Piece::Words(_)));
    if !has_step && guard.is_none() {
        return None;
    }
    let topic = watched.map(|watched| watched.words).unwrap_or_default();
    Some(aims(Reader::new(situation), (&topic, guard.as_ref(), &pieces), request))
}

/// The aims of the pieces of a request, behind what was spoken of first.
fn aims(
    mut reader: Reader<'_>,
    (topic, guard, pieces): (&[Token], Option<&Guard>, &[Piece]),
    request: &str,
) -> Result<Intent, RequestError> {
    if !topic.is_empty() {
        reader.topic(topic)?;
    }
    let mut condition = None;
    if let Some(guard) = guard.filter(|guard| guard.leads) {
        condition = Some(reader.condition(guard)?);
    }
    for piece in pieces {
        reader.piece(piece)?;
    }
    if let Some(guard) = guard.filter(|guard| !guard.leads) {
        condition = Some(reader.condition(guard)?);
    }
    if reader.said.aims.is_empty() {
        return Err(RequestError::NotUnderstood { part: request.trim().to_owned() });
    }
    if let Some((guard, (condition, thing))) = guard.zip(condition) {
        reader.depends(guard, condition, &thing);
    }
    Ok(reader.said)
}

/// Takes the condition out of a request.
fn guard(tokens: &mut Vec<Token>) -> Option<Guard> {
    let (at, found) = (0..tokens.len()).find_map(|at| Some((at, Rules("conditions").at(tokens, at)?)))?;
    let (kind, said) = found.words.split_first()?;
    let middle = said.iter().rposition(|token| token.word() == "as")?;
    let state = words(said, middle + 1, said.len());
    let guard = Guard {
        state: STATES.value(&state)?,
        thing: said.get(..middle)?.to_vec(),
        waits: kind.word() == "when",
        leads: skip_leads(tokens, 0) >= at,
    };
    tokens.splice(at..found.end, [Token::Comma]);
    let is_joint = |token: &Token| matches!(token, Token::Comma | Token::Stop) || token.word() == "then";
    while tokens.first().is_some_and(|token| is_joint(token) || token.word() == "and") {
        tokens.remove(0);
    }
    while tokens.last().is_some_and(is_joint) {
        tokens.pop();
    }
    Some(guard)
}

/// Splits a request at the steps that it names.
fn pieces(tokens: &[Token]) -> Vec<Piece> {
    let mut pieces = Vec::new();
    let (mut from, mut at, mut starts) = (0, 0, true);
    while let Some(token) = tokens.get(at) {
        let begin = skip_leads(tokens, at);
        let step = || Some((Rules("steps_by_name").at(tokens, begin)?, None));
        let turn = || {
            let (count, degrees) = TURNS_BY.valued(tokens, begin)?;
            Some((begin + count, degrees.parse().ok()?))
        };
        let is_end = |end: usize| {
            tokens.get(end).is_none_or(|token| {
                matches!(token, Token::Comma | Token::Stop) || matches!(token.word(), "and" | "then")
            })
        };
        let named = match (turn().filter(|(end, _)| starts && is_end(*end)), starts) {
            (Some((end, degrees)), _) => Some((end, Piece::Turn(degrees))),
            (None, true) => step().map(|(found, _): (_, Option<i32>)| (found.end, Piece::Step(found.words))),
            (None, false) => None,
        };
        if let Some((end, piece)) = named {
            push(&mut pieces, tokens.get(from..at).unwrap_or_default());
            pieces.push(piece);
            (from, at) = (end, end);
            continue;
        }
        starts = matches!(token, Token::Comma | Token::Stop) || matches!(token.word(), "and" | "then");
        at += 1;
    }
    push(&mut pieces, tokens.get(from..).unwrap_or_default());
    pieces
}

/// Adds the words between two steps, without what joins them.
fn push(pieces: &mut Vec<Piece>, words: &[Token]) {
    let is_joint = |token: &&Token| {
        matches!(token, Token::Comma | Token::Stop) || matches!(token.word(), "and" | "then")
    };
    let begin = words.iter().take_while(is_joint).count();
    let end = words.len() - words.iter().rev().take_while(is_joint).count();
    if let Some(words) = words.get(begin..end).filter(|words| !words.is_empty()) {
        pieces.push(Piece::Words(words.to_vec()));
    }
}

impl Reader<'_> {
    fn piece(&mut self, piece: &Piece) -> Result<(), RequestError> {
        match piece {
            Piece::Turn(degrees) => self.add_step("turn_around", NamedStep::Turn { degrees: *degrees }),
            Piece::Words(words) => {
                let spoken =
                    parse::parse(&plain(words)).map_err(|part| RequestError::NotUnderstood { part })?;
                self.commands(&spoken)?;
            }
            Piece::Step(said) => {
                let (name, about) =
                    said.split_first().map_or(("", said.as_slice()), |(name, about)| (name.word(), about));
                match name {
                    "wake_up" => self.add_step("stand_up", NamedStep::WakeUp),
                    "home" => self.add_step("fold_arm", NamedStep::Home),
                    "start" => {
                        let goal = fact(fluents::AT, &[entities::ROBOT, entities::START]);
                        self.aim("go_home".to_owned(), goal, Persistence::ToTheEnd);
                    }
                    tells => {
                        let thing = self.named_thing(about)?;
                        self.near(&thing);
                        let tells = tells == "tell";
                        self.add_step(&format!("inspect_{thing}"), NamedStep::Inspect { thing, tells });
                    }
                }
            }
        }
        Ok(())
    }

    fn commands(&mut self, spoken: &Spoken) -> Result<(), RequestError> {
        for (index, command) in spoken.commands.iter().enumerate() {
            let later: &[Command] = spoken.commands.get(index + 1..).unwrap_or_default();
            self.command(command, later)?;
        }
        Ok(())
    }

    /// Adds an aim without a goal, which is its step.
    fn add_step(&mut self, name: &str, step: NamedStep) {
        let goal = all_of(Vec::new());
        let aims = self.said.aims.len();
        self.aim(name.to_owned(), goal, Persistence::Once);
        // The same step may be asked for twice.
        if self.said.aims.len() == aims
            && let Some(last) = self.said.aims.last().cloned()
        {
            self.said.aims.push(Aim { name: name.to_owned(), only_if: None, ..last });
        }
        if let Some(aim) = self.said.aims.last_mut() {
            aim.named_step = Some(step);
        }
    }

    /// The thing that words name.
    fn named_thing(&mut self, said: &[Token]) -> Result<SmolStr, RequestError> {
        let part = || RequestError::NotUnderstood { part: words(said, 0, said.len()) };
        let (noun, _) = noun(said, 0).ok_or_else(part)?;
        let found = self.things(&noun, OBJECTS, None);
        let found = match found {
            Err(RequestError::AmbiguousReference { .. }) | Ok(_) => found,
            Err(_) => self.things(&noun, HOLDERS, None),
        }?;
        let thing = found.into_iter().next().ok_or_else(part)?;
        self.said.spoken_of.push(thing.clone());
        Ok(thing)
    }

    /// Takes in a thing that somebody speaks of first.
    fn topic(&mut self, said: &[Token]) -> Result<(), RequestError> {
        let thing = self.named_thing(said)?;
        self.places.push(thing);
        Ok(())
    }

    /// The condition of a guard, with the thing that it is about.
    fn condition(&mut self, guard: &Guard) -> Result<(Expr, SmolStr), RequestError> {
        let (noun, _) = noun(&guard.thing, 0)
            .ok_or_else(|| RequestError::NotUnderstood { part: words(&guard.thing, 0, guard.thing.len()) })?;
        let found = self.things(&noun, &[Role::Container, Role::Surface], None)?;
        let unclear = || RequestError::NotUnderstood { part: words(&guard.thing, 0, guard.thing.len()) };
        let [thing] = found.as_slice() else { return Err(unclear()) };
        let is_container = self.vocabulary.thing(thing).is_some_and(|one| one.role == Role::Container);
        let holds_any = || {
            let mut held = fact(if is_container { fluents::IN } else { fluents::ON }, &["any", thing]);
            if let ExprKind::Call(call) = &mut held.kind
                && let Some(first) = call.args.first_mut()
            {
                first.value = Expr { kind: ExprKind::Any, span: Span::default() };
            }
            held
        };
        let condition = match guard.state {
            "open" => fact(fluents::OPEN, &[thing]),
            "closed" => not(fact(fluents::OPEN, &[thing])),
            "empty" => not(holds_any()),
            _ => holds_any(),
        };
        let has_door = self.situation.scene.entities.get(thing).is_some_and(|one| one.open.is_some());
        if matches!(guard.state, "open" | "closed") && !has_door {
            let why = format!("the {} has no door", self.called(thing));
            return Err(RequestError::Unfit { why });
        }
        self.said.spoken_of.push(thing.clone());
        Ok((condition, thing.clone()))
    }

    /// Makes everything that was asked for depend on a condition, which the robot sees where the thing is.
    fn depends(&mut self, guard: &Guard, condition: Expr, thing: &SmolStr) {
        let mut asked = std::mem::take(&mut self.said.aims);
        self.near(thing);
        if guard.waits {
            if let Some(first) = asked.first_mut() {
                first.awaits = Some(condition);
            }
        } else {
            asked.iter_mut().for_each(|aim| aim.only_if = Some(condition.clone()));
        }
        self.said.aims.extend(asked);
    }

    /// Goes where a thing is seen.
    fn near(&mut self, thing: &SmolStr) {
        let role = self.vocabulary.thing(thing).map(|thing| thing.role);
        let support = self.vocabulary.thing(thing).and_then(|thing| thing.support.clone());
        let place = if role == Some(Role::Object) { support.as_ref().unwrap_or(thing) } else { thing };
        let goal = fact(fluents::AT, &[entities::ROBOT, place]);
        self.aim(format!("go_to_{place}"), goal, Persistence::Once);
    }
}

impl Intent {
    /// Leaves what an object is asked for out of the aims.
    ///
    /// # Errors
    ///
    /// Nothing was asked for it.
    fn without(mut self, things: &[SmolStr]) -> Result<Self, RequestError> {
        let before = self.aims.len();
        self.aims.retain(|aim| !things.iter().any(|thing| aim.mentions(thing)));
        if self.aims.len() == before {
            return Err(RequestError::Unfit { why: "that is no part of the request".to_owned() });
        }
        Ok(self)
    }
}

/// Reads a request from which something is left out: `bring me all mugs but without the red one`. `None` for
/// any other.
pub(super) fn excluding(
    tokens: &[Token],
    situation: &RequestContext<'_>,
    understand: impl Fn(&[Token]) -> Result<Intent, RequestError>,
) -> Option<Result<Intent, RequestError>> {
    let (at, found) = (1..tokens.len()).find_map(|at| Some((at, Rules("excluded").at(tokens, at)?)))?;
    let mut rest = tokens.get(..at)?.to_vec();
    while rest.last().is_some_and(|token| *token == Token::Comma) {
        rest.pop();
    }
    let mut reader = Reader::new(situation);
    let (noun, _) = noun(&found.words, 0)?;
    let things = reader.things(&noun, OBJECTS, None).ok()?;
    let is_taken_back = tokens.get(at).is_some_and(|token| token.word() == "but");
    match understand(&rest).and_then(|intent| intent.without(&things)) {
        Ok(intent) => Some(Ok(intent)),
        Err(why) => is_taken_back.then_some(Err(why)),
    }
}

/// Reads a preference, with the rest of the request.
pub(super) fn preference(
    tokens: &[Token],
    situation: &RequestContext<'_>,
) -> Option<(Preference, Vec<Token>)> {
    let begin = (0..tokens.len()).find(|at| {
        let before = at.checked_sub(1).and_then(|before| tokens.get(before));
        before.is_none_or(|before| matches!(before, Token::Comma | Token::Stop) || before.word() == "and")
            && Rules("prefers").at(tokens, *at).is_some()
    })?;
    let found = Rules("prefers").at(tokens, begin)?;
    let middle = found.words.iter().position(|token| token.word() == "over")?;
    let one = |said: &[Token]| -> Option<Vec<SmolStr>> {
        let (noun, _) = noun(said, 0)?;
        Reader::new(situation).choices(&noun, None).ok().map(|found| found.concat())
    };
    let liked = one(found.words.get(..middle)?)?;
    let over = one(found.words.get(middle + 1..)?)?;
    let rest =
        [tokens.get(..begin).unwrap_or_default(), tokens.get(found.end..).unwrap_or_default()].concat();
    Some((Preference { liked, over }, rest))
}

//! Remarks beside a request, which ask for nothing: facts, reasons, questions, cautions; and prohibitions:
//! `do not bring it to me, just put it on the table`.

use crate::command::{Command, command};
use crate::engine::asking::skip_leads;
use crate::engine::english::{ELSEWHERE, FORBIDDEN_NOT, FORBIDDEN_UNTIL, TURNS};
use crate::engine::noun::Noun;
use crate::engine::rule::Rules;
use crate::engine::token::Token;
use crate::engine::verb::{Act, verb};

/// True if words are a remark. Anything else that is no command is not understood.
pub(super) fn is_remark(tokens: &[Token], begin: usize, end: usize) -> bool {
    let is = |rules: &'static str| Rules(rules).end(tokens, begin).is_some();
    end >= begin + 2 && !is("no_remarks") && is("remarks")
}

/// `is the fridge still open?`
pub(super) fn is_question(tokens: &[Token], begin: usize) -> bool {
    Rules("questions").end(tokens, begin).is_some()
}

/// The end of what is said beside a request in its own clause: why, and how long something is held.
pub(super) fn beside(tokens: &[Token], at: usize, act: Act) -> Option<usize> {
    Some(Rules("beside").behind(tokens, at, Some(act))?.end)
}

/// True if a phrase ends at a place.
pub(super) fn is_boundary(tokens: &[Token], at: usize) -> bool {
    Rules("boundary").end(tokens, at).is_some()
}

/// `do not drop it`, `do not let go`: what to mind with what is asked for anyway. Where it ends.
pub(super) fn caution(tokens: &[Token], begin: usize, before: Option<Act>) -> Option<usize> {
    Some(Rules("caution").behind(tokens, begin, before)?.end)
}

/// A request not to do something, which takes nothing from what is asked for, since that is something else:
/// where it ends, and whether it stands before what is asked for.
pub(super) fn forbidden(tokens: &[Token], begin: usize, asked: &[Command]) -> Option<(usize, When)> {
    let at = begin + FORBIDDEN_NOT.longest(tokens, begin)?;
    let (found, end) = one(tokens, at)?;
    let is_bound = |token: &Token| FORBIDDEN_UNTIL.has(token.word());
    let said = tokens.get(at..end)?;
    if said.iter().any(is_bound) {
        return None;
    }
    if let Some(last) = asked.last() {
        let is_of_it = found.items.iter().all(|item| matches!(item, Noun::Before(_)));
        if is_boundary(tokens, end) && is_of_it && is_other(&found, last) {
            return Some((end, When::Behind));
        }
    }
    // `do not bring it to me. Just put it on the table`
    let joint = tokens.get(end)?;
    let next = skip_leads(tokens, end + 1);
    let led = tokens.get(end..next)?;
    let turns = |token: &Token| TURNS.has(token.word());
    let is_turned = *joint == Token::Comma || turns(joint) || led.iter().any(turns);
    let (then, after) = one(tokens, next)?;
    let differs = tokens.get(next..after)? != said;
    (is_turned && differs && is_other(&found, &then)).then_some((end, When::Before))
}

/// The position of a prohibition, before or behind the request.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum When {
    Before,
    Behind,
}

/// The one command that stands at a place, and its end.
fn one(tokens: &[Token], at: usize) -> Option<(Command, usize)> {
    verb(tokens, at)?;
    let mut found = Vec::new();
    let end = command(tokens, at, &mut found).ok()?;
    match <[Command; 1]>::try_from(found) {
        Ok([one]) => Some((one, end)),
        Err(_) => None,
    }
}

/// True if what is forbidden is no part of what is asked for.
fn is_other(forbidden: &Command, asked: &Command) -> bool {
    let puts = |act: Act| matches!(act, Act::Put | Act::Stow | Act::Store | Act::Release | Act::Move);
    let clears = |act: Act| matches!(act, Act::Discard | Act::Throw);
    let (not, act) = (forbidden.act(), asked.act());
    let is_of_it = |command: &Command| command.items.iter().any(|item| matches!(item, Noun::Before(_)));
    let is_of_it = is_of_it(forbidden) || is_of_it(asked);
    // `do not take it anywhere`, of what is only to be picked up
    let is_away = forbidden.with.iter().any(|word| ELSEWHERE.has(word)) || forbidden.to.is_some();
    match act {
        Act::Pick | Act::Lift => {
            not == Act::Fetch
                || puts(not)
                || clears(not)
                || (is_away && matches!(not, Act::Take | Act::Pick | Act::Go))
        }
        Act::Fetch => puts(not) || clears(not) || (not == act && forbidden.items != asked.items && !is_of_it),
        Act::Put | Act::Stow | Act::Store | Act::Move | Act::Take => {
            not == Act::Fetch || clears(not) || (puts(not) && forbidden.to != asked.to && not != Act::Release)
        }
        Act::Discard | Act::Throw => not == Act::Fetch || puts(not),
        Act::Open => not == Act::Close,
        Act::Close => not == Act::Open,
        Act::Go | Act::Come => matches!(not, Act::Go | Act::Come) && forbidden.to != asked.to,
        Act::Release | Act::Find => false,
    }
}

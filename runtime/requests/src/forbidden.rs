//! What is forbidden beside a request: `do not drop it`, `do not bring it to me, just put it on the table`.

use super::command::{Command, command};
use super::lead::skip_leads;
use super::noun::Noun;
use super::remark::{is_boundary, remark_end};
use super::token::{Token, stands};
use super::verb::{Act, verb};
use crate::english::{
    CAUTION_DO_NOT_YOU_DARE, CAUTION_PUTTING_IT_DOWN, FORBIDDEN_NOT, FORBIDDEN_UNTIL, LETTING_GO, MISHAPS,
};
use crate::phrases::Phrases;

/// `do not drop it`, `do not let go`: what to mind with what is asked for anyway. Where it ends.
pub(super) fn caution(tokens: &[Token], begin: usize, before: Option<Act>) -> Option<usize> {
    // `no putting it down`: the `no` was passed over.
    let is_no = begin.checked_sub(1).is_some_and(|at| stands(tokens, at, "no").is_some());
    if let (true, Some(count)) = (is_no, CAUTION_PUTTING_IT_DOWN.longest(tokens, begin)) {
        let is_held = matches!(before, Some(Act::Pick | Act::Lift));
        return (is_held && is_boundary(tokens, begin + count)).then_some(begin + count);
    }
    let at = begin + CAUTION_DO_NOT_YOU_DARE.longest(tokens, begin)?;
    let of = |list: &Phrases| list.longest(tokens, at).is_some();
    // `do not forget the mug` may ask for it, `do not forget!` minds what was said.
    let forgets = stands(tokens, at, "forget").is_some();
    let end = remark_end(tokens, at);
    let is_minded = of(&MISHAPS) && (!forgets || end == at + 1);
    let is_held = of(&LETTING_GO) && matches!(before, Some(Act::Pick | Act::Lift));
    let says_more = (at..end)
        .any(|at| tokens.get(at).is_some_and(|token| matches!(token.word(), "and" | "or" | "but" | "just")));
    ((is_minded || is_held) && !says_more).then_some(end)
}

/// A request not to do something, which takes nothing from what is asked for, since that is something else: where it ends, and
/// whether it stands before what is asked for.
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
    let turns = |token: &Token| matches!(token.word(), "just" | "instead" | "but" | "rather");
    let is_turned = *joint == Token::Comma || turns(joint) || led.iter().any(turns);
    let (then, after) = one(tokens, next)?;
    let differs = tokens.get(next..after)? != said;
    (is_turned && differs && is_other(&found, &then)).then_some((end, When::Before))
}

/// Where something forbidden stands.
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

/// Whether what is forbidden is no part of what is asked for.
fn is_other(forbidden: &Command, asked: &Command) -> bool {
    let puts = |act: Act| matches!(act, Act::Put | Act::Stow | Act::Store | Act::Release | Act::Move);
    let clears = |act: Act| matches!(act, Act::Discard | Act::Throw);
    let (not, act) = (forbidden.act(), asked.act());
    let is_of_it = |command: &Command| command.items.iter().any(|item| matches!(item, Noun::Before(_)));
    let is_of_it = is_of_it(forbidden) || is_of_it(asked);
    // `do not take it anywhere`, of what is only to be picked up
    let is_away =
        ["anywhere", "away", "elsewhere"].iter().any(|word| forbidden.has(word)) || forbidden.to.is_some();
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

//! Consistency of a state about the hands: the robot holds no more things than it has hands, and a hand with
//! a thing is not free.

use indexmap::IndexSet;
use motet_syntax::{Diagnostic, Span};

use super::Environment;
use super::errors::Contradiction;
use crate::declare::Library;
use crate::ir::{Base, Entity, Fact, Fluent, Term};

/// Entry of a state: the fact, its truth value (`None` for unknown), and its span.
pub(super) type StateEntry = (Fact, Option<bool>, Span);

/// Finds a contradiction between the facts of a state and those of the scene.
pub(super) fn contradiction(
    library: &Library,
    environment: &Environment,
    said: &[StateEntry],
) -> Option<Diagnostic> {
    let holding = fluent(library, library.lang_items.holding, |ty| matches!(ty, Base::Entity(_)))?;
    let free = fluent(library, library.lang_items.free, |ty| matches!(ty, Base::Enum(_)))?;
    let hand = library.lang_items.hand.and_then(|hand| library.enums.get(hand.index()))?;
    let about = |of: Fluent| said.iter().filter(move |(fact, ..)| fact.fluent == of);
    let says_all = about(holding).find(|(fact, value, _)| *value == Some(true) && fact.args == [None]);
    if let Some((_, _, span)) = says_all {
        let what = "`holding(any)` means that the robot holds every thing".to_owned();
        let remedy = "name the thing, such as \"holding(mug_1)\": true; \"holding(any)\": false means that the hands are empty";
        return Some(Contradiction { span: *span, what, remedy: remedy.to_owned(), other: None }.into());
    }
    // What the scene says counts where the state is silent. The last word that was given counts.
    let mut held: IndexSet<Entity> = IndexSet::new();
    for (fact, value) in &environment.given {
        match fact.args.as_slice() {
            [Some(Term::Entity(entity))] if fact.fluent == holding => {
                if *value {
                    held.insert(*entity)
                } else {
                    held.shift_remove(entity)
                };
            }
            [None] if fact.fluent == holding && !value => held.clear(),
            _ => {}
        }
    }
    let place_of = |entity: Entity| {
        let is_it = |(fact, value, _): &&StateEntry| {
            *value == Some(true) && fact.args == [Some(Term::Entity(entity))] && fact.fluent == holding
        };
        said.iter().find(is_it).map(|(.., span)| *span)
    };
    let names: Vec<_> = held.iter().map(|entity| format!("`{}`", environment.name(*entity))).collect();
    let last = held.iter().rev().find_map(|entity| Some((*entity, place_of(*entity)?)));
    if held.len() > hand.cases.len() {
        let (last, span) = last?;
        let other = held.iter().filter(|entity| **entity != last).find_map(|entity| place_of(*entity));
        let hands = hand.cases.len();
        let hands = if hands == 1 { "one hand".to_owned() } else { format!("{hands} hands") };
        let what = format!("the robot holds {}, but has {hands}", names.join(" and "));
        let first = held.iter().find(|entity| **entity != last).map(|entity| environment.name(*entity))?;
        let remedy = format!("remove one, or add \"holding({first})\": false to override the scene");
        return Some(Contradiction { span, what, remedy, other }.into());
    }
    let is_spare = |(fact, value, _): &&StateEntry| fact.fluent == free && *value == Some(true);
    let spare = said.iter().rfind(is_spare).map(|(.., span)| *span);
    let all = hand.cases.len();
    let open = said.iter().filter(is_spare).map(|(fact, ..)| if fact.args == [None] { all } else { 1 });
    let hands_left = all.saturating_sub(open.sum());
    if let Some(span) = spare.filter(|_| held.len() > hands_left) {
        let held = names.join(" and ");
        let what = if hand.cases.len() == 1 {
            format!("the hand cannot be free: it holds {held}")
        } else {
            format!("too many hands are free: one of the others must hold {held}")
        };
        let remedy = "remove `free`, or state that the hands are empty: \"holding(any)\": false".to_owned();
        return Some(Contradiction { span, what, remedy, other: last.map(|(_, span)| span) }.into());
    }
    None
}

/// Finds a fluent with one parameter of a suitable type.
fn fluent(library: &Library, fluent: Option<Fluent>, takes: impl Fn(Base) -> bool) -> Option<Fluent> {
    let fluent = fluent?;
    let def = library.fluent(fluent)?;
    matches!(def.params.as_slice(), [(_, ty)] if ty.lists == 0 && takes(ty.base)).then_some(fluent)
}

//! Goals that cannot hold together. One that is only on the way to another need hold only once; else the
//! clash is named.

use motet_compiler::plan::Persistence;
use motet_syntax::ast::{Expr, ExprKind};
use smol_str::SmolStr;

use super::RequestError;
use super::meaning::Reader;
use super::vocabulary::Role;
use crate::Aim;

/// A goal that says one thing of one thing.
#[derive(PartialEq, Eq)]
enum Simple {
    /// It is there.
    Placed(SmolStr, SmolStr),
    /// It is in the hand.
    Held(SmolStr),
    Open(SmolStr),
    Closed(SmolStr),
}

impl Reader<'_> {
    /// `close the drawer and open it` closes it once. What is with a person, or in the bin, stays there.
    pub(super) fn settle(&mut self) -> Result<(), RequestError> {
        for later in 1..self.said.aims.len() {
            for earlier in 0..later {
                let goal = |at: usize| {
                    self.said.aims.get(at).filter(|aim| aim.goal.persistence == Persistence::ToTheEnd)
                };
                let (Some(first), Some(second)) = (goal(earlier), goal(later)) else { continue };
                let (first, second) = (simple(&first.goal.condition), simple(&second.goal.condition));
                let (Some(first), Some(second)) = (first, second) else { continue };
                if self.clash(&first, &second)?
                    && let Some(aim) = self.said.aims.get_mut(earlier)
                {
                    aim.goal.persistence = Persistence::Once;
                }
            }
        }
        Ok(())
    }

    /// `take it and put it there` asks for one thing: that it is held on the way goes without saying, unless
    /// it is believed to be there already.
    pub(super) fn join(&mut self) {
        let aims = &self.said.aims;
        let is_implied = |(index, aim): (usize, &Aim)| {
            let held =
                (aim.goal.persistence == Persistence::Once).then(|| simple(&aim.goal.condition)).flatten();
            let next = aims.get(index + 1).and_then(|next| simple(&next.goal.condition));
            let (Some(Simple::Held(one)), Some(Simple::Placed(other, place))) = (held, next) else {
                return false;
            };
            let support = self.vocabulary.thing(&one).and_then(|thing| thing.support.clone());
            one == other && support != Some(place)
        };
        let implied: Vec<bool> = aims.iter().enumerate().map(is_implied).collect();
        let mut implied = implied.into_iter();
        self.said.aims.retain(|_| !implied.next().unwrap_or_default());
    }

    /// A place or a person in a sentence.
    fn whom(&self, id: &SmolStr) -> String {
        if id == "user" { "you".to_owned() } else { format!("the {}", self.called(id)) }
    }

    /// Checks whether the first cannot hold any more when the second does, and can be undone for it.
    fn clash(&self, first: &Simple, second: &Simple) -> Result<bool, RequestError> {
        let unfit = |why: String| Err(RequestError::Unfit { why });
        match (first, second) {
            (Simple::Open(one), Simple::Closed(other)) | (Simple::Closed(one), Simple::Open(other)) => {
                Ok(one == other)
            }
            (Simple::Held(one), Simple::Held(other)) if one != other => {
                let (one, other) = (self.called(one), self.called(other));
                unfit(format!("I cannot hold the {one} and the {other} at once"))
            }
            (Simple::Placed(thing, there), Simple::Placed(other, to)) if thing == other && there != to => {
                let role = self.vocabulary.thing(there).map(|thing| thing.role);
                let (what, first, then) = (self.called(thing), self.whom(there), self.whom(to));
                if role == Some(Role::Person) {
                    unfit(format!(
                        "what I give to {first} I cannot take back: the {what} goes there or to {then}"
                    ))
                } else if self.bins().contains(there) {
                    unfit(format!(
                        "what is thrown away stays there: the {what} goes into {first} or to {then}"
                    ))
                } else {
                    Ok(true)
                }
            }
            _ => Ok(false),
        }
    }
}

fn simple(condition: &Expr) -> Option<Simple> {
    let (call, is_not) = match &condition.kind {
        ExprKind::Call(call) => (call, false),
        ExprKind::Not(inner) => match &inner.kind {
            ExprKind::Call(call) => (call, true),
            _ => return None,
        },
        _ => return None,
    };
    let names: Option<Vec<SmolStr>> = call
        .args
        .iter()
        .map(|arg| match &arg.value.kind {
            ExprKind::Name(name) => Some(name.clone()),
            _ => None,
        })
        .collect();
    match (call.name.text.as_str(), names?.as_slice(), is_not) {
        ("in" | "on" | "at", [thing, place], false) if thing != "robot" => {
            Some(Simple::Placed(thing.clone(), place.clone()))
        }
        ("holding", [thing], false) => Some(Simple::Held(thing.clone())),
        ("open", [what], false) => Some(Simple::Open(what.clone())),
        ("open", [what], true) => Some(Simple::Closed(what.clone())),
        _ => None,
    }
}

//! Commands as goals: what shall be true when somebody goes, opens, closes, lets go, takes and puts.

use motet_compiler::plan::{Persistence, fact};
use motet_stdlib::lang::{entities, fluents};
use motet_syntax::Span;
use motet_syntax::ast::{Expr, ExprKind};
use smol_str::SmolStr;

use crate::RequestError;
use crate::command::{Command, ONLY_IF};
use crate::engine::noun::{Noun, Which};
use crate::engine::verb::Act;
use crate::engine::vocabulary::Role;
use crate::meaning::{ANYWHERE, HOLDERS, OBJECTS, Reader};

impl Reader<'_> {
    pub(super) fn command(&mut self, command: &Command, later: &[Command]) -> Result<(), RequestError> {
        let act = command.act();
        match act {
            Act::Go | Act::Come | Act::Move => self.go(command, later.is_empty()),
            Act::Open | Act::Close => self.doors(command, act, later),
            Act::Release => self.release(command),
            Act::Find => self.find(command, later),
            Act::Fetch
            | Act::Pick
            | Act::Lift
            | Act::Put
            | Act::Take
            | Act::Stow
            | Act::Store
            | Act::Discard
            | Act::Throw => self.carry(command, act, later),
        }
    }

    fn go(&mut self, command: &Command, is_last: bool) -> Result<(), RequestError> {
        let mut targets = Vec::new();
        if command.act == Act::Come && command.to.is_none() {
            targets.push(SmolStr::new_static(entities::USER));
        }
        let to = command.to.as_ref().map(|to| &to.noun);
        for place in command.items.iter().chain(to).chain(&command.to_whom) {
            // `meet me at the door`
            if matches!(place, Noun::Speaker) && !targets.is_empty() {
                continue;
            }
            targets.extend(self.destination(place)?);
        }
        if targets.is_empty() {
            return Err(self.ask("Where shall I go?", ANYWHERE));
        }
        let last = targets.len() - 1;
        for (index, target) in targets.into_iter().enumerate() {
            let lasts = if is_last && index == last { Persistence::ToTheEnd } else { Persistence::Once };
            self.aim(format!("go_to_{target}"), fact(fluents::AT, &[entities::ROBOT, &target]), lasts);
            self.said.spoken_of.push(target);
        }
        Ok(())
    }

    /// Finds where to go: places, then things.
    fn destination(&mut self, noun: &Noun) -> Result<Vec<SmolStr>, RequestError> {
        if let Noun::Phrase(phrase) = noun
            && phrase.which == Which::All
            && matches!(
                phrase.words.last().map(String::as_str),
                Some("location" | "place" | "spot" | "station")
            )
        {
            let known = self.vocabulary.things.iter().filter(|thing| {
                matches!(thing.role, Role::Surface | Role::Container | Role::Place)
                    && thing.id != entities::START
            });
            let known = known.map(|thing| thing.id.clone()).collect();
            return Ok(if self.places.is_empty() { known } else { self.places.clone() });
        }
        self.things(noun, ANYWHERE, None).or_else(|error| {
            // Of several things it is asked which.
            self.things(noun, OBJECTS, None).map_err(|other| match other {
                RequestError::AmbiguousReference { .. } => other,
                _ => error,
            })
        })
    }

    fn doors(&mut self, command: &Command, act: Act, later: &[Command]) -> Result<(), RequestError> {
        if command.items.is_empty() {
            let question = if act == Act::Open { "What shall I open?" } else { "What shall I close?" };
            return Err(self.ask(question, &[Role::Container]));
        }
        for item in &command.items {
            let mut found = match self.things(item, &[Role::Container], None) {
                Err(puzzle) => vec![self.own_door(item).ok_or(puzzle)?],
                Ok(found) => found,
            };
            // Of everything only what has a door.
            if matches!(item, Noun::Phrase(phrase) if phrase.words.is_empty()) {
                let scene = self.situation.scene;
                found.retain(|id| scene.entities.get(id).is_some_and(|entity| entity.open.is_some()));
            }
            for what in found {
                let is_open = fact(fluents::OPEN, &[&what]);
                let closed_later = later.iter().any(|later| later.act == Act::Close);
                let (name, goal, lasts) = match act {
                    Act::Open if closed_later => (format!("open_{what}"), is_open, Persistence::Once),
                    Act::Open => (format!("open_{what}"), is_open, Persistence::ToTheEnd),
                    _ => (format!("close_{what}"), not(is_open), Persistence::ToTheEnd),
                };
                if command.has(ONLY_IF) {
                    // How it is has to be seen when it is its turn: somebody may have been there before.
                    self.aim(
                        format!("look_at_{what}"),
                        fact(fluents::AT, &[entities::ROBOT, &what]),
                        Persistence::Once,
                    );
                    self.aim(format!("look_at_{what}"), fact(fluents::VISIBLE, &[&what]), Persistence::Once);
                }
                let is_open = fact(fluents::OPEN, &[&what]);
                let only_if = if act == Act::Open { not(is_open) } else { is_open };
                self.places.push(what.clone());
                self.said.spoken_of.push(what);
                self.aim(name, goal, lasts);
                if let Some(aim) = self.said.aims.last_mut().filter(|_| command.has(ONLY_IF)) {
                    aim.only_if = Some(only_if);
                }
            }
        }
        Ok(())
    }

    /// `put it in the fridge and close the door`: that of what was spoken of last.
    fn own_door(&self, item: &Noun) -> Option<SmolStr> {
        let Noun::Phrase(phrase) = item else { return None };
        let [part] = phrase.words.as_slice() else { return None };
        let last = self.places.last().filter(|_| matches!(part.as_str(), "door" | "lid"))?;
        let has_door = self.situation.scene.entities.get(last).is_some_and(|entity| entity.open.is_some());
        has_door.then(|| last.clone())
    }

    /// `find the mug`: it shall be seen; where something else follows that is done with it, that finds it
    /// too.
    fn find(&mut self, command: &Command, later: &[Command]) -> Result<(), RequestError> {
        let Some(item) = command.items.first() else { return Err(self.ask(question(Act::Find), OBJECTS)) };
        let from = match (&command.to, &command.from) {
            (Some(to), _) => Some(vec![self.holder(to)?]),
            (None, Some(from)) => Some(self.things(from, HOLDERS, None)?),
            (None, None) => None,
        };
        let found = self.things(item, OBJECTS, from.as_deref())?;
        for thing in found {
            if later.is_empty() {
                self.look_at(&thing);
            }
            self.said.spoken_of.push(thing);
        }
        Ok(())
    }

    /// A thing is looked for where it is taken to be, until it is seen.
    pub(super) fn look_at(&mut self, thing: &SmolStr) {
        self.go_and_look(thing);
        self.aim(format!("find_{thing}"), fact(fluents::VISIBLE, &[thing]), Persistence::Once);
    }

    /// To find a thing is to go to where it is taken to be, and to open what it is shut in.
    fn go_and_look(&mut self, thing: &SmolStr) {
        let support = self.vocabulary.thing(thing).and_then(|thing| thing.support.clone());
        let Some(place) = support.and_then(|support| self.vocabulary.thing(&support)) else { return };
        let (place, role) = (place.id.clone(), place.role);
        let name = format!("find_{thing}");
        if matches!(role, Role::Surface | Role::Container) {
            self.aim(name.clone(), fact(fluents::AT, &[entities::ROBOT, &place]), Persistence::Once);
        }
        let has_door = self.situation.scene.entities.get(&place).is_some_and(|entity| entity.open.is_some());
        if role == Role::Container && has_door {
            self.aim(name, fact(fluents::OPEN, &[&place]), Persistence::Once);
        }
    }

    fn release(&mut self, command: &Command) -> Result<(), RequestError> {
        // `open it and drop the coke in`
        if command.to.is_some() || command.to_whom.is_some() || (command.has("in") && !self.places.is_empty())
        {
            return self.carry(command, Act::Put, &[]);
        }
        let items = match command.items.first() {
            Some(item) => self.things(item, OBJECTS, None)?,
            None => match &self.situation.holding {
                Some(held) => vec![held.clone()],
                None => return Err(self.ask("What shall I put down?", OBJECTS)),
            },
        };
        for item in items {
            self.aim(
                format!("put_down_{item}"),
                not(fact(fluents::HOLDING, &[&item])),
                Persistence::ToTheEnd,
            );
        }
        Ok(())
    }
}

/// Persistence of holding something: to the end, unless it is put somewhere later.
pub(super) fn hold_on(later: &[Command]) -> Persistence {
    let goes = |later: &Command| matches!(later.act, Act::Go | Act::Come | Act::Pick | Act::Lift);
    if later.iter().all(goes) { Persistence::ToTheEnd } else { Persistence::Once }
}

pub(super) fn question(act: Act) -> &'static str {
    match act {
        Act::Discard | Act::Throw => "What shall I throw away?",
        Act::Put | Act::Stow | Act::Store => "What shall I put there?",
        Act::Fetch => "What shall I bring?",
        Act::Find => "What shall I look for?",
        _ => "What do you mean?",
    }
}

pub(super) fn not(condition: Expr) -> Expr {
    Expr { kind: ExprKind::Not(Box::new(condition)), span: Span::default() }
}

pub(super) fn any_of(mut parts: Vec<Expr>) -> Expr {
    if parts.len() == 1 {
        parts.remove(0)
    } else {
        Expr { kind: ExprKind::AnyOf(parts), span: Span::default() }
    }
}

pub(super) fn all_of(parts: Vec<Expr>) -> Expr {
    Expr { kind: ExprKind::All(parts), span: Span::default() }
}

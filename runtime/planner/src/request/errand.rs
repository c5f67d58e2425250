//! Commands as goals: what shall be true when somebody goes, opens, closes, lets go, takes and puts.

use motet_compiler::plan::{Lasts, fact};
use motet_syntax::Span;
use motet_syntax::ast::{Expr, ExprKind};
use smol_str::SmolStr;

use super::Puzzle;
use super::command::{Command, ONLY_IF};
use super::meaning::{ANYWHERE, HOLDERS, OBJECTS, Reader};
use super::noun::{Noun, Which};
use super::verb::Act;
use super::vocabulary::Role;

impl Reader<'_> {
    pub(super) fn command(&mut self, command: &Command, later: &[Command]) -> Result<(), Puzzle> {
        let act = command.act();
        match act {
            Act::Go | Act::Come | Act::Move => self.go(command, later.is_empty()),
            Act::Open | Act::Close => self.doors(command, act, later),
            Act::Release => self.release(command),
            Act::Find => self.find(command, later),
            Act::Fetch | Act::Pick | Act::Lift | Act::Put | Act::Take | Act::Stow | Act::Discard => {
                self.carry(command, act, later)
            }
        }
    }

    fn go(&mut self, command: &Command, is_last: bool) -> Result<(), Puzzle> {
        let mut targets = Vec::new();
        if command.act == Act::Come && command.to.is_none() {
            targets.push(SmolStr::new_static("user"));
        }
        for place in command.items.iter().chain(&command.to).chain(&command.to_whom) {
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
            let lasts = if is_last && index == last { Lasts::ToTheEnd } else { Lasts::Once };
            self.aim(format!("go_to_{target}"), fact("at", &["robot", &target]), lasts);
            self.said.spoken_of.push(target);
        }
        Ok(())
    }

    /// Where to go: places, then things.
    fn destination(&mut self, noun: &Noun) -> Result<Vec<SmolStr>, Puzzle> {
        if let Noun::Phrase(phrase) = noun
            && phrase.which == Which::All
            && matches!(
                phrase.words.last().map(String::as_str),
                Some("location" | "place" | "spot" | "station")
            )
        {
            let known = self.vocabulary.things.iter().filter(|thing| {
                matches!(thing.role, Role::Surface | Role::Container | Role::Place) && thing.id != "start"
            });
            let known = known.map(|thing| thing.id.clone()).collect();
            return Ok(if self.places.is_empty() { known } else { self.places.clone() });
        }
        self.things(noun, ANYWHERE, None)
            .or_else(|puzzle| self.things(noun, OBJECTS, None).map_err(|_| puzzle))
    }

    fn doors(&mut self, command: &Command, act: Act, later: &[Command]) -> Result<(), Puzzle> {
        if command.items.is_empty() {
            let question = if act == Act::Open { "What shall I open?" } else { "What shall I close?" };
            return Err(self.ask(question, &[Role::Container]));
        }
        for item in &command.items {
            for what in self.things(item, &[Role::Container, Role::Place], None)? {
                let is_open = fact("open", &[&what]);
                let closed_later = later.iter().any(|later| later.act == Act::Close);
                let (name, goal, lasts) = match act {
                    Act::Open if closed_later => (format!("open_{what}"), is_open, Lasts::Once),
                    Act::Open => (format!("open_{what}"), is_open, Lasts::ToTheEnd),
                    _ => (format!("close_{what}"), not(is_open), Lasts::ToTheEnd),
                };
                if command.has(ONLY_IF) {
                    // How it is has to be seen when it is its turn: somebody may have been there before.
                    self.aim(format!("look_at_{what}"), fact("at", &["robot", &what]), Lasts::Once);
                    self.aim(format!("look_at_{what}"), fact("visible", &[&what]), Lasts::Once);
                }
                let is_open = fact("open", &[&what]);
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

    /// `find the mug`: it shall be seen; where something else follows that is done with it, that finds it too.
    fn find(&mut self, command: &Command, later: &[Command]) -> Result<(), Puzzle> {
        let Some(item) = command.items.first() else { return Err(self.ask(question(Act::Find), OBJECTS)) };
        let found = self.things(item, OBJECTS, None)?;
        for thing in found {
            if later.is_empty() {
                self.aim(format!("find_{thing}"), fact("visible", &[&thing]), Lasts::Once);
            }
            self.said.spoken_of.push(thing);
        }
        Ok(())
    }

    fn release(&mut self, command: &Command) -> Result<(), Puzzle> {
        if command.to.is_some() || command.to_whom.is_some() {
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
            self.aim(format!("put_down_{item}"), not(fact("holding", &[&item])), Lasts::ToTheEnd);
        }
        Ok(())
    }

    /// Everything that takes a thing into the hand.
    fn carry(&mut self, command: &Command, act: Act, later: &[Command]) -> Result<(), Puzzle> {
        let from = match &command.from {
            Some(from) => Some(self.things(from, HOLDERS, None)?),
            None => None,
        };
        // `bring me the mug on the table`: where it is, not where to.
        let says_where = matches!(act, Act::Fetch | Act::Pick | Act::Lift) && command.to.is_some();
        let target = match (&command.to, &command.to_whom) {
            (Some(to), None) if says_where && !self.is_person(to) && act != Act::Fetch => {
                Target::Where(self.one(to, HOLDERS)?)
            }
            (Some(to), _) if act == Act::Fetch && command.to_whom.is_some() => {
                Target::Where(self.one(to, HOLDERS)?)
            }
            (Some(to), _) => Target::To(self.one(to, HOLDERS)?),
            (None, Some(whom)) => Target::To(self.one(whom, HOLDERS)?),
            (None, None) => Target::None,
        };
        let mut from = from;
        if let Target::Where(place) = &target {
            from.get_or_insert_with(|| vec![place.clone()]);
        }
        if command.items.is_empty() {
            return Err(self.ask(question(act), OBJECTS));
        }
        let items = command.items.clone();
        for item in &items {
            let choices = self.choices(item, from.as_deref())?;
            for choice in choices {
                self.carry_one(act, &choice, &target, command, later)?;
            }
        }
        Ok(())
    }

    /// One thing, or any one of several.
    fn carry_one(
        &mut self,
        act: Act,
        choice: &[SmolStr],
        target: &Target,
        command: &Command,
        later: &[Command],
    ) -> Result<(), Puzzle> {
        let name = choice.first().cloned().unwrap_or_default();
        let any = |goal: &dyn Fn(&str) -> Expr| any_of(choice.iter().map(|id| goal(id)).collect());
        let user = SmolStr::new_static("user");
        let (verb, goal, lasts) = match (act, target) {
            (Act::Discard, _) => {
                let bin = match &command.to {
                    Some(to) => self.one(to, HOLDERS)?,
                    None => self.bin()?,
                };
                ("throw_away", any(&|id| self.put(id, &bin)), Lasts::ToTheEnd)
            }
            (Act::Fetch, Target::To(to)) => ("bring", any(&|id| self.put(id, to)), Lasts::ToTheEnd),
            (Act::Fetch, Target::Where(_) | Target::None) => {
                ("bring", any(&|id| self.put(id, &user)), Lasts::ToTheEnd)
            }
            (Act::Put | Act::Take | Act::Stow, Target::To(to)) => {
                ("put", any(&|id| self.put(id, to)), Lasts::ToTheEnd)
            }
            (Act::Put | Act::Stow, Target::Where(_) | Target::None) => {
                let what =
                    self.vocabulary.thing(&name).map_or_else(|| name.to_string(), |thing| thing.called());
                let question = format!("Where shall I put the {what}?");
                return Err(self.ask(&question, &[Role::Surface, Role::Container]));
            }
            (Act::Lift, _) => {
                let both = |id: &str| all_of(vec![fact("holding", &[id]), fact("lifted", &[id])]);
                ("lift", any(&both), hold_on(later))
            }
            _ => ("pick", any(&|id| fact("holding", &[id])), hold_on(later)),
        };
        if let Target::To(place) = target {
            self.said.spoken_of.push(place.clone());
        }
        self.said.spoken_of.extend(choice.iter().rev().cloned());
        self.aim(format!("{verb}_{name}"), goal, lasts);
        Ok(())
    }

    /// That something is where it was put.
    fn put(&self, id: &str, to: &str) -> Expr {
        let name = match self.vocabulary.thing(to).map(|thing| thing.role) {
            Some(Role::Container) => "in",
            Some(Role::Surface | Role::Object) => "on",
            Some(Role::Place | Role::Person) | None => "at",
        };
        fact(name, &[id, to])
    }

    /// Where rubbish goes.
    fn bin(&self) -> Result<SmolStr, Puzzle> {
        let is_bin =
            |words: &str| self.vocabulary.meant(&[words.to_owned()], &[Role::Container, Role::Surface]);
        let bins: Vec<SmolStr> = is_bin("trash").into_iter().map(|thing| thing.id.clone()).collect();
        match bins.as_slice() {
            [only] => Ok(only.clone()),
            [] => Err(Puzzle::NotFound { what: "bin".to_owned() }),
            _ => Err(Puzzle::AmbiguousReference { what: "the bin".to_owned(), options: bins }),
        }
    }
}

/// Where a command takes a thing.
enum Target {
    /// To a place or a person.
    To(SmolStr),
    /// It only says where the thing is.
    Where(SmolStr),
    /// Nowhere in particular.
    None,
}

impl Command {
    /// The verb with its small words.
    pub(super) fn act(&self) -> Act {
        match self.act {
            Act::Put if self.has("away") || (self.has("back") && self.to.is_none()) => Act::Stow,
            Act::Put if self.has("down") && self.to.is_none() => Act::Release,
            Act::Take if self.has("out") && self.from.is_none() && self.to.is_none() => Act::Pick,
            // `grab me a drink`, `take the mug to me`
            Act::Take if self.to_whom.is_some() && self.to.is_none() => Act::Fetch,
            Act::Take if self.to.is_none() => Act::Pick,
            Act::Move if self.items.is_empty() => Act::Go,
            Act::Move => Act::Put,
            act => act,
        }
    }
}

/// Whether something has to stay in the hand: not where it is put somewhere later.
fn hold_on(later: &[Command]) -> Lasts {
    let goes = |later: &Command| matches!(later.act, Act::Go | Act::Come | Act::Pick | Act::Lift);
    if later.iter().all(goes) { Lasts::ToTheEnd } else { Lasts::Once }
}

fn question(act: Act) -> &'static str {
    match act {
        Act::Discard => "What shall I throw away?",
        Act::Put | Act::Stow => "What shall I put there?",
        Act::Fetch => "What shall I bring?",
        Act::Find => "What shall I look for?",
        Act::Go
        | Act::Come
        | Act::Pick
        | Act::Lift
        | Act::Take
        | Act::Release
        | Act::Open
        | Act::Close
        | Act::Move => "What do you mean?",
    }
}

fn not(condition: Expr) -> Expr {
    Expr { kind: ExprKind::Not(Box::new(condition)), span: Span::default() }
}

fn any_of(mut parts: Vec<Expr>) -> Expr {
    if parts.len() == 1 {
        parts.remove(0)
    } else {
        Expr { kind: ExprKind::AnyOf(parts), span: Span::default() }
    }
}

fn all_of(parts: Vec<Expr>) -> Expr {
    Expr { kind: ExprKind::All(parts), span: Span::default() }
}

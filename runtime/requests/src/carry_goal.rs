//! Commands that take a thing into the hand, as goals: which thing, and where to.

use motet_compiler::plan::{Persistence, fact};
use motet_stdlib::lang::{entities, fluents};
use motet_syntax::ast::Expr;
use smol_str::SmolStr;

use crate::RequestError;
use crate::command::{BELONGS, Command, KEPT, WANTED};
use crate::command_goal::{all_of, any_of, hold_on, not, question};
use crate::engine::noun::{Noun, Relation, Spot, Which};
use crate::engine::verb::Act;
use crate::engine::vocabulary::Role;
use crate::meaning::{HOLDERS, OBJECTS, Reader};

/// The target of a command that takes a thing somewhere.
enum Target {
    /// To a place or a person.
    To(SmolStr),
    /// It only says where the thing is.
    Where(SmolStr),
    /// Nowhere in particular.
    None,
}

impl Reader<'_> {
    /// Everything that takes a thing into the hand.
    pub(super) fn carry(
        &mut self,
        command: &Command,
        act: Act,
        later: &[Command],
    ) -> Result<(), RequestError> {
        if command.items.is_empty() {
            return Err(self.ask(question(act), OBJECTS));
        }
        let mut from = match &command.from {
            Some(from) => Some(self.things(from, HOLDERS, None)?),
            None => self.opened_before(command).map(|place| vec![place]),
        };
        let out_of = self.opened_before(command);
        let target = self.target(command, act)?;
        if let Target::Where(place) = &target {
            from.get_or_insert_with(|| vec![place.clone()]);
        }
        let items = command.items.clone();
        for item in &items {
            let choices = self.choices(item, from.as_deref())?;
            for choice in choices {
                // `the coke belongs in the fridge, put it back where it belongs`
                let is_placed = !matches!(target, Target::None)
                    || !(command.has(BELONGS) || matches!(act, Act::Put | Act::Stow | Act::Store));
                if !is_placed && self.has_its_place(&choice) {
                    continue;
                }
                let own = if is_placed { None } else { self.own_place(command, &choice) };
                self.carry_one(act, &choice, own.as_ref().unwrap_or(&target), later)?;
                // What is taken out and let go of for the door is not put back.
                if let (Some(place), [thing], Persistence::Once) =
                    (&out_of, choice.as_slice(), hold_on(later))
                {
                    let goal = not(fact(fluents::IN, &[thing, place]));
                    self.aim(format!("take_out_{thing}"), goal, Persistence::ToTheEnd);
                }
                if let Some(aim) =
                    self.said.aims.last_mut().filter(|aim| command.has(KEPT) && aim.name.starts_with("put_"))
                {
                    aim.name = aim.name.replacen("put_", "keep_", 1);
                }
            }
        }
        Ok(())
    }

    /// `open the fridge, take the bottle out`: out of what was opened just before.
    fn opened_before(&self, command: &Command) -> Option<SmolStr> {
        let is_out = command.act == Act::Take
            && command.has("out")
            && command.from.is_none()
            && command.to.is_none()
            && command.to_whom.is_none();
        let place = self.places.last().filter(|_| is_out)?;
        let opened = format!("open_{place}");
        self.said.aims.iter().any(|aim| aim.name == opened).then(|| place.clone())
    }

    /// Target that a place behind a thing names, or the place where the thing is: `throw the can in the bin`,
    /// `throw away the can on the table`. An error asks if both could be meant.
    fn target(&mut self, command: &Command, act: Act) -> Result<Target, RequestError> {
        if let Some(whom) = self.thrown_to(command, act) {
            return Err(self.bring_instead(command, &whom)?);
        }
        let Some(to) = &command.to else {
            return match &command.to_whom {
                Some(whom) => Ok(Target::To(self.one(whom, HOLDERS)?)),
                None => Ok(Target::None),
            };
        };
        let place = self.holder(to)?;
        let puzzle = || RequestError::NotUnderstood { part: to.said() };
        if self.is_person(&to.noun) {
            return match act {
                Act::Pick | Act::Lift | Act::Stow | Act::Store => Err(puzzle()),
                _ => Ok(Target::To(place)),
            };
        }
        let is_where = match act {
            Act::Fetch if command.to_whom.is_some() => true,
            // `I want the mug on the table`
            Act::Fetch if command.has(WANTED) => false,
            // `get it on the table`: who says `it` need not say which.
            Act::Fetch if command.items.iter().all(|item| matches!(item, Noun::Before(_))) => false,
            Act::Fetch => !to.moves(),
            Act::Pick | Act::Lift => true,
            // `gather all toys in the basket` asks for something else than `take the mug on the table`.
            Act::Take
                if !to.moves() && to.relation == Relation::In && command.items.iter().any(is_several) =>
            {
                return Err(puzzle());
            }
            Act::Take => !to.moves(),
            Act::Discard => !to.moves() && !self.bins().contains(&place),
            Act::Throw if to.moves() || self.bins().contains(&place) => false,
            Act::Throw if self.are_there(command, &place) => return Err(self.throw_away(command)),
            Act::Stow => !to.moves() && to.is_behind_thing && self.is_stowed_from(command, to, &place),
            Act::Put if command.act == Act::Move => !to.moves() && self.are_there(command, &place),
            _ => false,
        };
        if is_where && to.moves() {
            return Err(puzzle());
        }
        Ok(if is_where { Target::Where(place) } else { Target::To(place) })
    }

    /// Reads what a place is, where something can be so to it.
    pub(super) fn holder(&mut self, spot: &Spot) -> Result<SmolStr, RequestError> {
        let not_understood = || RequestError::NotUnderstood { part: spot.said() };
        if spot.relation == Relation::Beside {
            return Err(not_understood());
        }
        let place = self.one(&spot.noun, HOLDERS)?;
        let fits = self.vocabulary.thing(&place).is_none_or(|thing| spot.relation.fits(thing.role));
        if fits { Ok(place) } else { Err(not_understood()) }
    }

    /// To whom something is thrown.
    fn thrown_to(&self, command: &Command, act: Act) -> Option<Noun> {
        if !matches!(act, Act::Throw | Act::Discard) {
            return None;
        }
        let place = command.to.as_ref().map(|to| &to.noun).filter(|noun| self.is_person(noun));
        command.to_whom.as_ref().or(place).cloned()
    }

    /// Nothing is thrown to anybody: whether it shall be brought.
    fn bring_instead(&mut self, command: &Command, whom: &Noun) -> Result<RequestError, RequestError> {
        let what = self.said(command)?;
        let question = match whom {
            Noun::Speaker | Noun::Here => format!("Shall I bring you {what}?"),
            Noun::Phrase(phrase) => format!("Shall I bring {what} to {}?", phrase.said),
            Noun::Before(_) | Noun::There => {
                return Err(RequestError::NotUnderstood { part: "throw".to_owned() });
            }
        };
        Ok(RequestError::AmbiguousTask { question, options: Vec::new() })
    }

    /// `throw the can on the table`, where it lies already.
    fn throw_away(&mut self, command: &Command) -> RequestError {
        match self.said(command) {
            Ok(what) => RequestError::AmbiguousTask {
                question: format!("Shall I throw {what} away?"),
                options: Vec::new(),
            },
            Err(puzzle) => puzzle,
        }
    }

    /// The things of a command in words, without pronouns.
    fn said(&mut self, command: &Command) -> Result<String, RequestError> {
        let mut said = Vec::new();
        for item in &command.items {
            if let Noun::Phrase(phrase) = item {
                said.push(phrase.said.clone());
                continue;
            }
            for id in self.things(item, OBJECTS, None)? {
                said.push(format!("the {}", self.called(&id)));
            }
        }
        Ok(said.join(" and "))
    }

    /// True if something that is meant is at a place.
    fn are_there(&mut self, command: &Command, place: &SmolStr) -> bool {
        let items = command.items.clone();
        items.iter().any(|item| {
            let there = self.choices(item, Some(std::slice::from_ref(place)));
            there.is_ok_and(|choices| !choices.is_empty()) || self.is_one_of_several_there(item, place)
        })
    }

    /// Several things there may be meant: which one is not clear, that they are there is.
    fn is_one_of_several_there(&mut self, item: &Noun, place: &SmolStr) -> bool {
        let there = self.things(item, OBJECTS, Some(std::slice::from_ref(place)));
        matches!(there, Err(RequestError::AmbiguousReference { .. }))
    }

    /// `put the toys on the sofa away`, `put away everything on the table`: where they are. `put the sponge
    /// away in the drawer`, `put away the sponge in the drawer`: where to, unless it is there.
    fn is_stowed_from(&mut self, command: &Command, to: &Spot, place: &SmolStr) -> bool {
        let is_several = command.items.iter().any(is_several);
        command.act != Act::Stow
            || (is_several && to.relation != Relation::In)
            || self.are_there(command, place)
    }

    /// True if it was said before where a thing shall be.
    fn has_its_place(&self, choice: &[SmolStr]) -> bool {
        let [thing] = choice else { return false };
        self.said.aims.iter().any(|aim| aim.name == format!("keep_{thing}"))
    }

    /// Finds where a thing goes of which it is not said: where it is usually kept, where it was, or into what
    /// was spoken of last.
    fn own_place(&self, command: &Command, choice: &[SmolStr]) -> Option<Target> {
        let [thing] = choice else { return None };
        let usual =
            || self.usual.iter().rev().find(|(known, _)| known == thing).map(|(_, place)| place.clone());
        let last = |fits: Role| {
            let place = self.places.last()?;
            (self.vocabulary.thing(place)?.role == fits).then(|| place.clone())
        };
        let place = if command.has(BELONGS) || command.has("away") {
            usual()
        } else if command.has("back") {
            usual().or_else(|| self.was_at(thing))
        } else if command.has("in") {
            last(Role::Container)
        } else if command.has("on") {
            last(Role::Surface)
        } else {
            None
        };
        place.map(Target::To)
    }

    /// Finds where a thing was before it was taken: by this request, or before.
    fn was_at(&self, thing: &SmolStr) -> Option<SmolStr> {
        let taken = format!("_{thing}");
        let support = self.vocabulary.thing(thing).and_then(|thing| thing.support.clone());
        if self.said.aims.iter().any(|aim| aim.name.ends_with(&taken))
            && support.is_some()
            && self.situation.holding.as_ref() != Some(thing)
        {
            return support;
        }
        self.situation
            .came_from
            .iter()
            .rev()
            .find(|(known, _)| known == thing)
            .map(|(_, place)| place.clone())
    }

    /// One thing, or any one of several.
    fn carry_one(
        &mut self,
        act: Act,
        choice: &[SmolStr],
        target: &Target,
        later: &[Command],
    ) -> Result<(), RequestError> {
        let name = choice.first().cloned().unwrap_or_default();
        let any = |goal: &dyn Fn(&str) -> Expr| any_of(choice.iter().map(|id| goal(id)).collect());
        let user = SmolStr::new_static(entities::USER);
        // Who wants a thing where it is taken to be already may know better: it is looked at.
        if let (
            Act::Fetch | Act::Put | Act::Take | Act::Stow | Act::Store | Act::Throw | Act::Discard,
            Target::To(to),
            [thing],
        ) = (act, target, choice)
            && self.is_taken_to_be(thing, to)
        {
            self.look_at(thing);
        }
        let (verb, goal, lasts) = match (act, target) {
            (Act::Discard, target) => {
                let bin = match target {
                    Target::To(bin) => bin.clone(),
                    Target::Where(_) | Target::None => self.bin()?,
                };
                ("throw_away", any(&|id| self.put(id, &bin)), Persistence::ToTheEnd)
            }
            (Act::Fetch, Target::To(to)) => ("bring", any(&|id| self.put(id, to)), Persistence::ToTheEnd),
            (Act::Fetch, Target::Where(_) | Target::None) => {
                ("bring", any(&|id| self.put(id, &user)), Persistence::ToTheEnd)
            }
            (Act::Put | Act::Take | Act::Stow | Act::Store | Act::Throw, Target::To(to)) => {
                ("put", any(&|id| self.put(id, to)), Persistence::ToTheEnd)
            }
            (Act::Put | Act::Stow | Act::Store, Target::Where(_) | Target::None) => {
                let question = format!("Where shall I put the {}?", self.called(&name));
                return Err(self.ask(&question, &[Role::Surface, Role::Container]));
            }
            (Act::Lift, _) => {
                let both =
                    |id: &str| all_of(vec![fact(fluents::HOLDING, &[id]), fact(fluents::LIFTED, &[id])]);
                ("lift", any(&both), hold_on(later))
            }
            _ => ("pick", any(&|id| fact(fluents::HOLDING, &[id])), hold_on(later)),
        };
        if let Target::To(place) = target {
            self.said.spoken_of.push(place.clone());
        }
        self.said.spoken_of.extend(choice.iter().rev().cloned());
        self.aim(format!("{verb}_{name}"), goal, lasts);
        Ok(())
    }

    /// True if a thing is believed to be somewhere already, and no part of the request takes it there.
    fn is_taken_to_be(&self, thing: &SmolStr, place: &SmolStr) -> bool {
        let support = self.vocabulary.thing(thing).and_then(|thing| thing.support.as_ref());
        support == Some(place) && self.situation.holding.as_ref() != Some(thing) && self.said.aims.is_empty()
    }

    /// Reads what a thing is called.
    pub(super) fn called(&self, id: &SmolStr) -> String {
        self.vocabulary.thing(id).map_or_else(|| id.to_string(), |thing| thing.called())
    }

    /// States that something is where it was put.
    fn put(&self, id: &str, to: &str) -> Expr {
        let name = match self.vocabulary.thing(to).map(|thing| thing.role) {
            Some(Role::Container) => fluents::IN,
            Some(Role::Surface | Role::Object) => fluents::ON,
            Some(Role::Place | Role::Person) | None => fluents::AT,
        };
        fact(name, &[id, to])
    }

    /// Finds where rubbish can go.
    pub(super) fn bins(&self) -> Vec<SmolStr> {
        let bins = self.vocabulary.meant(&["trash".to_owned()], &[Role::Container, Role::Surface]);
        bins.into_iter().map(|thing| thing.id.clone()).collect()
    }

    /// Finds where rubbish goes.
    fn bin(&self) -> Result<SmolStr, RequestError> {
        let bins = self.bins();
        match bins.as_slice() {
            [only] => Ok(only.clone()),
            [] => Err(RequestError::NotFound { what: "bin".to_owned() }),
            _ => Err(RequestError::AmbiguousReference { what: "the bin".to_owned(), options: bins }),
        }
    }
}

/// True if a noun is of several things.
fn is_several(noun: &Noun) -> bool {
    matches!(noun, Noun::Phrase(phrase) if phrase.is_plural || phrase.which == Which::All)
}

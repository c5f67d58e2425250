//! Commands as goals: each noun becomes the things that it means, each verb what shall then be true.

use motet_compiler::plan::{Goal, Lasts, fact};
use motet_syntax::Span;
use motet_syntax::ast::{Expr, ExprKind};
use smol_str::SmolStr;

use super::command::{Command, Spoken, Statement};
use super::noun::{Noun, Phrase, Which, located, noun};
use super::token::Token;
use super::verb::{Act, stands};
use super::vocabulary::{Role, Vocabulary};
use super::{Located, Puzzle, Situation};
use crate::builtin::Aim;

/// What can be carried.
const OBJECTS: &[Role] = &[Role::Object];
/// What one can go to.
const ANYWHERE: &[Role] = &[Role::Surface, Role::Container, Role::Place, Role::Person];
/// What things can be put on, in or with.
const HOLDERS: &[Role] = &[Role::Surface, Role::Container, Role::Person, Role::Place, Role::Object];

/// What a request means.
#[derive(Clone, Debug, Default)]
pub struct Understood {
    /// What shall come about, in order.
    pub aims: Vec<Aim>,
    /// Where things were said to be.
    pub located: Vec<Located>,
    /// What was read differently from how it was written.
    pub notes: Vec<String>,
    /// What was spoken of, the latest last.
    pub spoken_of: Vec<SmolStr>,
}

/// Understands what was spoken.
pub(super) fn understood(
    spoken: &Spoken,
    request: &str,
    situation: &Situation<'_>,
) -> Result<Understood, Puzzle> {
    let vocabulary = Vocabulary::new(situation.scene, &situation.supports);
    let mut reader = Reader {
        vocabulary,
        situation,
        said: Understood { spoken_of: situation.spoken_of.clone(), ..Understood::default() },
        left: None,
        liked: Vec::new(),
        places: Vec::new(),
    };
    for statement in &spoken.statements {
        reader.state(statement);
    }
    if spoken.commands.is_empty() && reader.said.located.is_empty() {
        return Err(match reader.wished(spoken) {
            Some(question) => Puzzle::AmbiguousTask { question, options: Vec::new() },
            None => Puzzle::NotUnderstood { part: request.trim().to_owned() },
        });
    }
    let mut commands = spoken.commands.clone();
    // `lift and hold the can`: the first verb shares what the next is about.
    for index in (0..commands.len().saturating_sub(1)).rev() {
        let next = commands.get(index + 1).map(|next| next.items.clone()).unwrap_or_default();
        if let Some(command) = commands.get_mut(index)
            && command.needs_items()
        {
            command.items = next;
        }
    }
    for command in &mut commands {
        reader.dative(command);
    }
    for (index, command) in commands.iter().enumerate() {
        let later = commands.get(index + 1..).unwrap_or_default();
        reader.command(command, later)?;
    }
    Ok(reader.said)
}

impl Command {
    /// Whether it says nothing of what it is about, though its verb asks for it.
    fn needs_items(&self) -> bool {
        self.items.is_empty() && matches!(self.act, Act::Pick | Act::Lift | Act::Take | Act::Fetch)
    }
}

struct Reader<'a> {
    vocabulary: Vocabulary,
    situation: &'a Situation<'a>,
    said: Understood,
    /// `I left something on the table`
    left: Option<Phrase>,
    /// `I like fruits`
    liked: Vec<Vec<String>>,
    /// Places that were spoken of.
    places: Vec<SmolStr>,
}

impl Reader<'_> {
    /// Takes in what was said beside the request: what was mentioned, liked, left somewhere, and where things are.
    fn state(&mut self, statement: &Statement) {
        let tokens = &statement.tokens;
        if self.tell(tokens) {
            return;
        }
        for (index, _) in tokens.iter().enumerate() {
            for like in ["i like", "i love", "i prefer", "i enjoy"] {
                if let Some(count) = stands(tokens, index, like)
                    && let Some((Noun::Phrase(phrase), _)) = noun(tokens, index + count)
                {
                    self.liked.push(phrase.words);
                }
            }
        }
        let mut at = 0;
        while at < tokens.len() {
            let Some((Noun::Phrase(mut phrase), after)) = noun(tokens, at) else {
                at += 1;
                continue;
            };
            if phrase.words.is_empty() {
                if let Some((place, _)) = located(tokens, after) {
                    phrase.place = Some(Box::new(place));
                    self.left = Some(phrase);
                }
                at = after.max(at + 1);
                continue;
            }
            // A noun may begin behind a verb: the longest ending that is a name counts.
            for start in 0..phrase.words.len() {
                let ending = phrase.words.get(start..).unwrap_or_default();
                let found: Vec<SmolStr> =
                    self.vocabulary.meant(ending, OBJECTS).iter().map(|thing| thing.id.clone()).collect();
                if !found.is_empty() {
                    self.said.spoken_of.extend(found);
                    break;
                }
                let places = self.vocabulary.meant(ending, ANYWHERE);
                if let [place] = places.as_slice() {
                    self.places.push(place.id.clone());
                    break;
                }
            }
            at = after.max(at + 1);
        }
    }

    /// `the coke is in the fridge`, `it is on the table`, `in the cupboard`: a fact. Whether it was one.
    fn tell(&mut self, tokens: &[Token]) -> bool {
        let subject = match noun(tokens, 0) {
            Some((subject, after)) => ["is now", "are now", "is", "are", "must be", "should be"]
                .iter()
                .find_map(|word| Some((subject.clone(), after + stands(tokens, after, word)?))),
            None => None,
        };
        let (subject, at) = subject.unwrap_or((Noun::Before, 0));
        let Some((place, _)) = located(tokens, at).filter(|(_, end)| *end == tokens.len()) else {
            return false;
        };
        let (Ok(things), Ok(places)) =
            (self.things(&subject, OBJECTS, None), self.things(&place, HOLDERS, None))
        else {
            return false;
        };
        let ([thing], [place]) = (things.as_slice(), places.as_slice()) else { return false };
        let Some(role) = self.vocabulary.thing(place).map(|place| place.role) else { return false };
        let relation = if role == Role::Container { "in" } else { "on" };
        self.said.located.push(Located { thing: thing.clone(), relation, place: place.clone() });
        self.said.spoken_of.push(thing.clone());
        true
    }

    /// What somebody may want who only says how they are.
    fn wished(&self, spoken: &Spoken) -> Option<String> {
        let says = |word: &str| {
            let mut words = spoken.statements.iter().flat_map(|statement| &statement.tokens);
            words.any(|token| token.word() == word)
        };
        if says("thirsty") {
            return Some("Shall I bring you something to drink?".to_owned());
        }
        (says("hungry") || says("starving")).then(|| "Shall I bring you something to eat?".to_owned())
    }

    fn command(&mut self, command: &Command, later: &[Command]) -> Result<(), Puzzle> {
        let act = command.act();
        match act {
            Act::Go | Act::Come | Act::Move => self.go(command, later.is_empty()),
            Act::Open | Act::Close => self.doors(command, act, later),
            Act::Release => self.release(command),
            Act::Fetch | Act::Pick | Act::Lift | Act::Put | Act::Take | Act::Stow | Act::Discard => {
                self.carry(command, act, later)
            }
        }
    }

    /// `hand the guest the magazine`: the first of two nouns is who gets it.
    fn dative(&self, command: &mut Command) {
        if command.act() == Act::Fetch
            && command.to_whom.is_none()
            && command.items.len() > 1
            && command.items.first().is_some_and(|first| self.is_person(first))
        {
            command.to_whom = Some(command.items.remove(0));
        }
    }

    fn go(&mut self, command: &Command, is_last: bool) -> Result<(), Puzzle> {
        let mut targets = Vec::new();
        if command.act == Act::Come && command.to.is_none() {
            targets.push(SmolStr::new_static("user"));
        }
        for place in command.items.iter().chain(&command.to).chain(&command.to_whom) {
            targets.extend(self.destination(place)?);
        }
        if targets.is_empty() {
            return Err(self.ask("Where shall I go?", ANYWHERE));
        }
        let last = targets.len() - 1;
        for (index, target) in targets.into_iter().enumerate() {
            let lasts = if is_last && index == last { Lasts::ToTheEnd } else { Lasts::Once };
            self.aim(format!("go_to_{target}"), fact("at", &["robot", &target]), lasts);
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
                self.said.spoken_of.push(what);
                self.aim(name, goal, lasts);
            }
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

    fn is_person(&self, noun: &Noun) -> bool {
        match noun {
            Noun::Speaker | Noun::Here => true,
            Noun::Before | Noun::There => false,
            Noun::Phrase(phrase) => !self.vocabulary.meant(&phrase.words, &[Role::Person]).is_empty(),
        }
    }

    fn one(&mut self, noun: &Noun, roles: &[Role]) -> Result<SmolStr, Puzzle> {
        // Furniture before what stands on it: `the table` is no toy table.
        let fixed: Vec<Role> = roles.iter().copied().filter(|role| *role != Role::Object).collect();
        let found = self
            .things(noun, &fixed, None)
            .or_else(|puzzle| self.things(noun, roles, None).map_err(|_| puzzle))?;
        let said = if let Noun::Phrase(phrase) = noun { phrase.said.clone() } else { "there".to_owned() };
        match found.as_slice() {
            [only] => Ok(only.clone()),
            [] => Err(Puzzle::NotFound { what: said }),
            _ => Err(Puzzle::AmbiguousReference { what: said, options: found }),
        }
    }

    /// For each thing that is meant, what it may be: several where any will do.
    fn choices(&mut self, noun: &Noun, from: Option<&[SmolStr]>) -> Result<Vec<Vec<SmolStr>>, Puzzle> {
        let Noun::Phrase(phrase) = noun else {
            return Ok(self.things(noun, OBJECTS, from)?.into_iter().map(|id| vec![id]).collect());
        };
        let found = self.candidates(phrase, OBJECTS, from)?;
        Ok(match phrase.which {
            Which::The if found.len() > 1 && !phrase.is_plural => return Err(ambiguous(phrase, found)),
            Which::The | Which::All => found.into_iter().map(|id| vec![id]).collect(),
            Which::Count(count) if found.len() < count => {
                return Err(Puzzle::NotFound { what: phrase.said.clone() });
            }
            Which::Count(1) | Which::Any => vec![found],
            Which::Count(count) => found.into_iter().take(count).map(|id| vec![id]).collect(),
        })
    }

    /// The things that are meant; of a single noun the one.
    fn things(
        &mut self,
        noun: &Noun,
        roles: &[Role],
        from: Option<&[SmolStr]>,
    ) -> Result<Vec<SmolStr>, Puzzle> {
        match noun {
            Noun::Speaker | Noun::Here => Ok(vec![SmolStr::new_static("user")]),
            Noun::There => match self.places.last() {
                Some(place) => Ok(vec![place.clone()]),
                None => Err(Puzzle::NotUnderstood { part: "there".to_owned() }),
            },
            Noun::Before => self.before(roles),
            Noun::Phrase(phrase) => {
                let found = self.candidates(phrase, roles, from)?;
                let is_one = !matches!(phrase.which, Which::All) && !phrase.is_plural;
                if is_one && found.len() > 1 {
                    return Err(ambiguous(phrase, found));
                }
                if roles.contains(&Role::Surface) {
                    self.places.extend(found.iter().cloned());
                }
                Ok(found)
            }
        }
    }

    /// What `it` is.
    fn before(&mut self, roles: &[Role]) -> Result<Vec<SmolStr>, Puzzle> {
        if let Some(left) = self.left.clone()
            && roles.contains(&Role::Object)
        {
            let found = self.candidates(&left, roles, None)?;
            if let [_] = found.as_slice() {
                return Ok(found);
            }
            return Err(ambiguous(&left, found));
        }
        let fits = |id: &&SmolStr| self.vocabulary.thing(id).is_some_and(|thing| roles.contains(&thing.role));
        let last = self.said.spoken_of.iter().rev().find(fits);
        let held = self.situation.holding.as_ref().filter(|held| fits(held));
        match last.or(held) {
            Some(id) => Ok(vec![id.clone()]),
            None => Err(Puzzle::NotUnderstood { part: "it".to_owned() }),
        }
    }

    /// All things that a noun may mean.
    fn candidates(
        &mut self,
        phrase: &Phrase,
        roles: &[Role],
        from: Option<&[SmolStr]>,
    ) -> Result<Vec<SmolStr>, Puzzle> {
        let place = match &phrase.place {
            Some(place) => Some(self.things(&place.clone(), HOLDERS, None)?),
            None => from.map(<[SmolStr]>::to_vec),
        };
        // Words of which it was found out what they mean.
        if let Some((_, id)) = self.situation.meant.iter().rev().find(|(said, _)| *said == phrase.said)
            && self.vocabulary.thing(id).is_some_and(|thing| roles.contains(&thing.role))
        {
            return Ok(vec![id.clone()]);
        }
        let mut words = phrase.words.clone();
        // What someone says of a thing that they opened or emptied tells nothing about which it is.
        words.retain(|word| !matches!(word.as_str(), "open" | "opened" | "nice" | "good" | "other" | "new"));
        let found = self.named(&words, roles);
        let found = if found.is_empty() && !words.is_empty() {
            match self.vocabulary.respelt(&words) {
                Some(respelt) => {
                    let found = self.named(&respelt, roles);
                    if !found.is_empty() {
                        self.said.notes.push(format!(
                            "I read `{}` as `{}`",
                            words.join(" "),
                            respelt.join(" ")
                        ));
                    }
                    found
                }
                None => found,
            }
        } else {
            found
        };
        let vocabulary = &self.vocabulary;
        let is = |id: &SmolStr, words: &[String]| {
            vocabulary.meant(words, roles).iter().any(|thing| thing.id == *id)
        };
        let mut found: Vec<SmolStr> = found
            .into_iter()
            .filter(|id| phrase.is.iter().all(|(is_so, words)| is(id, words) == *is_so))
            .filter(|id| {
                let thing = vocabulary.thing(id);
                phrase.good_for.is_none_or(|what| thing.is_some_and(|thing| thing.is(what)))
            })
            .filter(|id| {
                place.as_ref().is_none_or(|places| {
                    let support = vocabulary.thing(id).and_then(|thing| thing.support.clone());
                    support.is_some_and(|support| places.contains(&support))
                })
            })
            .collect();
        if phrase.is_liked || (phrase.words.is_empty() && !self.liked.is_empty()) {
            found.retain(|id| self.liked.iter().any(|words| is(id, words)));
        }
        // `an open can`: of several the one that was spoken of.
        if found.len() > 1 {
            let spoken: Vec<_> =
                found.iter().filter(|id| self.said.spoken_of.contains(id)).cloned().collect();
            if let [_] = spoken.as_slice()
                && phrase.which != Which::All
                && !matches!(phrase.which, Which::Count(_))
                && !phrase.words.is_empty()
            {
                found = spoken;
            }
        }
        let is_open = phrase.words.is_empty() && phrase.good_for.is_none() && phrase.is.is_empty();
        if found.is_empty() {
            return Err(Puzzle::NotFound { what: phrase.said.clone() });
        }
        if is_open
            && place.is_none()
            && !phrase.is_liked
            && self.liked.is_empty()
            && phrase.which != Which::All
        {
            return Err(self.ask("What do you mean by that?", roles));
        }
        Ok(found)
    }

    fn named(&self, words: &[String], roles: &[Role]) -> Vec<SmolStr> {
        let things: Vec<_> = if words.is_empty() {
            self.vocabulary.things.iter().filter(|thing| roles.contains(&thing.role)).collect()
        } else {
            self.vocabulary.meant(words, roles)
        };
        things.into_iter().map(|thing| thing.id.clone()).collect()
    }

    fn aim(&mut self, name: String, condition: Expr, lasts: Lasts) {
        let name =
            name.chars().map(|letter| if letter.is_ascii_alphanumeric() { letter } else { '_' }).collect();
        self.said.aims.push(Aim { goal: Goal { condition, lasts }, name });
    }

    fn ask(&self, question: &str, roles: &[Role]) -> Puzzle {
        let options = self.vocabulary.things.iter().filter(|thing| roles.contains(&thing.role));
        let options = options.map(|thing| thing.id.clone()).collect();
        Puzzle::AmbiguousTask { question: question.to_owned(), options }
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
    fn act(&self) -> Act {
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

fn ambiguous(phrase: &Phrase, options: Vec<SmolStr>) -> Puzzle {
    Puzzle::AmbiguousReference { what: phrase.said.clone(), options }
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

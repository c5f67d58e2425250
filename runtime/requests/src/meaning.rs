//! The reader of a whole request: its statements first, then its commands in order, as goals that hold
//! together.

use motet_compiler::plan::{Goal, Persistence};
use motet_stdlib::lang::{entities, fluents};
use motet_syntax::ast::{Expr, ExprKind};
use smol_str::SmolStr;

use crate::NamedStep;
use crate::command::Command;
use crate::engine::noun::{Noun, Phrase};
use crate::engine::token::{Token, singular, tokens};
use crate::engine::verb::Act;
use crate::engine::vocabulary::{Role, Vocabulary};
use crate::parse::Spoken;
use crate::{PendingQuestion, Preference, ReportedLocation, RequestContext, RequestError};

/// Roles of the things that can be carried.
pub(super) const OBJECTS: &[Role] = &[Role::Object];
/// Roles of the things that a robot can go to.
pub(super) const ANYWHERE: &[Role] = &[Role::Surface, Role::Container, Role::Place, Role::Person];
/// Roles of the things that others are put on, in or with.
pub(super) const HOLDERS: &[Role] =
    &[Role::Surface, Role::Container, Role::Person, Role::Place, Role::Object];

/// The intent of a request: goals in order, and what was told beside them.
#[derive(Clone, Debug, Default)]
pub struct Intent {
    /// Goals, in the order in which they are to be reached.
    pub aims: Vec<Aim>,
    /// Locations that the person told beside the request.
    pub located: Vec<ReportedLocation>,
    /// Corrections of misspelt words, to be told to the person: a request is never corrected silently.
    pub notes: Vec<String>,
    /// Things that were spoken of, the latest last.
    pub spoken_of: Vec<SmolStr>,
    /// Preference that the person told.
    pub prefers: Vec<Preference>,
    /// Confidence in the goals.
    pub certainty: Certainty,
}

/// Confidence in the reading of a request.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Certainty {
    /// No word was corrected, and the request calls every thing of its goals by a name.
    Certain,
    /// A word was corrected, or a thing was found by its category, by a pronoun, or by earlier words.
    #[default]
    Guess,
}

/// Understands what was spoken.
pub(super) fn understood(
    spoken: &Spoken,
    request: &str,
    situation: &RequestContext<'_>,
) -> Result<Intent, RequestError> {
    let mut reader = Reader::new(situation);
    for statement in &spoken.statements {
        reader.state(statement);
    }
    if spoken.commands.is_empty() && reader.said.located.is_empty() {
        return Err(match reader.wished(spoken) {
            Some(question) => RequestError::AmbiguousTask { question, options: Vec::new() },
            None => RequestError::NotUnderstood { part: request.trim().to_owned() },
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
    // `I want the can, give`
    if let [.., before, last] = commands.as_mut_slice()
        && last.act == Act::Fetch
        && last.needs_items()
        && !before.items.is_empty()
    {
        last.items.push(Noun::Before("it"));
    }
    for command in &mut commands {
        reader.dative(command);
    }
    for index in 1..commands.len() {
        let takes_it = commands.get(index).is_some_and(Command::takes_it);
        // `get the mug, go to the table and put it there`
        let goes = |command: &&Command| matches!(command.act(), Act::Go | Act::Open);
        let between = commands.get(..index).unwrap_or_default().iter().rev().take_while(goes).count();
        let first = (index - 1).checked_sub(between);
        if let Some(first) = first.and_then(|at| commands.get_mut(at)).filter(|_| takes_it) {
            first.only_takes();
        }
    }
    for (index, command) in commands.iter().enumerate() {
        let later = commands.get(index + 1..).unwrap_or_default();
        reader.command(command, later)?;
    }
    reader.settle()?;
    reader.join();
    reader.said.certainty = reader.certainty(request);
    Ok(reader.said)
}

/// Finds where somebody says that things are, in words that would otherwise ask for something.
pub(super) fn told(
    tokens: &[Token],
    asked: PendingQuestion,
    situation: &RequestContext<'_>,
) -> Vec<ReportedLocation> {
    Reader::new(situation).told(tokens, asked)
}

impl Command {
    /// True if it says what becomes of a thing that was spoken of just before.
    fn takes_it(&self) -> bool {
        let carries = matches!(
            self.act(),
            Act::Fetch
                | Act::Put
                | Act::Take
                | Act::Stow
                | Act::Store
                | Act::Discard
                | Act::Throw
                | Act::Release
                | Act::Pick
                | Act::Lift
        );
        carries && matches!(self.items.as_slice(), [Noun::Before(_)])
    }

    /// `get the mug and leave it on the table`: getting it is taking it, where nobody is named who gets it.
    fn only_takes(&mut self) {
        // `get it out of my sight, put it in the drawer`
        if matches!(self.act(), Act::Fetch | Act::Take | Act::Stow | Act::Put | Act::Store)
            && self.to.is_none()
            && self.to_whom.is_none()
        {
            self.act = Act::Pick;
        }
    }

    /// True if it says nothing of what it is about, though its verb asks for it.
    fn needs_items(&self) -> bool {
        self.items.is_empty() && matches!(self.act, Act::Pick | Act::Lift | Act::Take | Act::Fetch)
    }
}

/// State of the reader of one request.
pub(super) struct Reader<'a> {
    pub(super) vocabulary: Vocabulary,
    pub(super) situation: &'a RequestContext<'a>,
    pub(super) said: Intent,
    /// `I left something on the table`
    pub(super) left: Option<Phrase>,
    /// `I like fruits`
    pub(super) liked: Vec<Vec<String>>,
    /// Places that were spoken of.
    pub(super) places: Vec<SmolStr>,
    pub(super) usual: Vec<(SmolStr, SmolStr)>,
}

impl<'a> Reader<'a> {
    pub(super) fn new(situation: &'a RequestContext<'a>) -> Self {
        Self {
            vocabulary: Vocabulary::new(situation.scene, &situation.supports),
            situation,
            said: Intent { spoken_of: situation.spoken_of.clone(), ..Intent::default() },
            left: None,
            liked: Vec::new(),
            places: Vec::new(),
            usual: Vec::new(),
        }
    }
}

impl Reader<'_> {
    /// `hand the guest the magazine`: the first of two nouns is who gets it.
    fn dative(&self, command: &mut Command) {
        if matches!(command.act(), Act::Fetch | Act::Throw | Act::Discard)
            && command.to_whom.is_none()
            && command.items.len() > 1
            && command.items.first().is_some_and(|first| self.is_person(first))
        {
            command.to_whom = Some(command.items.remove(0));
        }
    }

    /// Confidence in the goals that were read.
    fn certainty(&self, request: &str) -> Certainty {
        let words: Vec<String> = tokens(request).iter().map(|token| singular(token.word())).collect();
        let is_named = |id: &SmolStr| {
            let is_answered = self.situation.meant.iter().any(|(_, meant)| meant == id);
            // Only things of the scene have names; the robot and its person need none.
            is_answered
                || self
                    .vocabulary
                    .thing(id)
                    .is_none_or(|thing| thing.is_named_in(&words) || id == entities::USER)
        };
        let mut things = self.said.aims.iter().flat_map(|aim| entities(&aim.goal.condition));
        if self.said.notes.is_empty() && things.all(|id| is_named(&id)) {
            Certainty::Certain
        } else {
            Certainty::Guess
        }
    }

    pub(super) fn aim(&mut self, name: String, condition: Expr, lasts: Persistence) {
        let name =
            name.chars().map(|letter| if letter.is_ascii_alphanumeric() { letter } else { '_' }).collect();
        let is_known = !matches!(&condition.kind, ExprKind::All(parts) if parts.is_empty())
            && self
                .said
                .aims
                .iter()
                .any(|aim| aim.goal.persistence == lasts && same(&aim.goal.condition, &condition));
        if is_known {
            return;
        }
        let goal = Goal { condition, persistence: lasts };
        self.said.aims.push(Aim { goal, name, only_if: None, awaits: None, named_step: None });
    }

    pub(super) fn ask(&self, question: &str, roles: &[Role]) -> RequestError {
        let options = self.vocabulary.things.iter().filter(|thing| roles.contains(&thing.role));
        let options = options.map(|thing| thing.id.clone()).collect();
        RequestError::AmbiguousTask { question: question.to_owned(), options }
    }
}

/// True if two conditions read the same: `the coke belongs in the fridge, please put it there` asks
/// once.
fn same(one: &Expr, other: &Expr) -> bool {
    motet_syntax::print::expression(one) == motet_syntax::print::expression(other)
}

/// A goal with a name for the steps that reach it.
#[derive(Clone, Debug)]
pub struct Aim {
    pub goal: Goal,
    /// Name of the group of steps, such as `fetch_coke`.
    pub name: String,
    /// Condition that must hold when the aim's turn comes; otherwise its steps are skipped.
    pub only_if: Option<Expr>,
    /// Condition that is waited for before the aim's turn.
    pub awaits: Option<Expr>,
    /// Step that the request names, behind the steps of the goal.
    pub named_step: Option<NamedStep>,
}

impl Aim {
    /// True if the goal names an entity.
    #[must_use]
    pub fn mentions(&self, id: &str) -> bool {
        entities(&self.goal.condition).iter().any(|named| named == id)
    }
}

impl Aim {
    /// True if the goal is that a thing is somewhere.
    #[must_use]
    pub fn places(&self, id: &str) -> bool {
        matches!(simple(&self.goal.condition), Some(Simple::Placed(thing, _)) if thing == id)
    }
}

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
        if id == entities::USER { "you".to_owned() } else { format!("the {}", self.called(id)) }
    }

    /// True if the first cannot hold any more when the second does, and can be undone for it.
    ///
    /// # Errors
    ///
    /// The first cannot be undone for the second.
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
                        "I cannot take a thing back from {first}: the {what} goes there or to {then}"
                    ))
                } else if self.bins().contains(there) {
                    unfit(format!(
                        "a thing in the bin stays there: the {what} goes into {first} or to {then}"
                    ))
                } else {
                    Ok(true)
                }
            }
            _ => Ok(false),
        }
    }
}

/// Names in a condition.
fn entities(condition: &Expr) -> Vec<SmolStr> {
    match &condition.kind {
        ExprKind::Name(name) => vec![name.clone()],
        ExprKind::Call(call) => call.args.iter().flat_map(|arg| entities(&arg.value)).collect(),
        ExprKind::Not(inner) => entities(inner),
        ExprKind::All(parts) | ExprKind::AnyOf(parts) => parts.iter().flat_map(entities).collect(),
        _ => Vec::new(),
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
        (fluents::IN | fluents::ON | fluents::AT, [thing, place], false) if thing != entities::ROBOT => {
            Some(Simple::Placed(thing.clone(), place.clone()))
        }
        (fluents::HOLDING, [thing], false) => Some(Simple::Held(thing.clone())),
        (fluents::OPEN, [what], false) => Some(Simple::Open(what.clone())),
        (fluents::OPEN, [what], true) => Some(Simple::Closed(what.clone())),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use motet_robots::builtin;

    use super::Certainty;
    use crate::{RequestContext, understand};

    #[test]
    fn reading_is_certain_where_the_request_names_its_things() {
        let scene = builtin::scene("kitchen").unwrap();
        let mut context = RequestContext::new(&scene);
        let read =
            |request: &str, context: &RequestContext<'_>| understand(request, context).unwrap().certainty;
        for request in
            ["bring me the coke", "could you put a mug in the sink?", "take the coke and bring it to me"]
        {
            assert_eq!(read(request, &context), Certainty::Certain, "{request}");
        }
        for request in ["bring me the soda", "bring me the coek"] {
            assert_eq!(read(request, &context), Certainty::Guess, "{request}");
        }
        // What a person said that the words mean is certain.
        context.meant = vec![("the soda".to_owned(), "coke".into())];
        assert_eq!(read("bring me the soda", &context), Certainty::Certain);
        context.spoken_of = vec!["apple".into()];
        for request in ["bring it to me", "It fell behind the sofa, can you get it out for me?"] {
            assert_eq!(read(request, &context), Certainty::Guess, "{request}");
        }
    }
}

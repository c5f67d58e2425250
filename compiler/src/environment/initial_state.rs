//! Initial state: facts at the start that are given beside the scene, and their consistency: the robot holds
//! no more things than it has hands, and a hand with a thing is not free.

use indexmap::{IndexMap, IndexSet};
use motet_robots::scene::{Grip, Placement, Scene, StateEntry};
use motet_stdlib::lang;
use motet_syntax::ast::MAX_MISTAKES;
use motet_syntax::located::Spanned;
use motet_syntax::{Diagnostic, Span, Syntax};
use rustc_hash::FxHashMap;
use smol_str::{SmolStr, format_smolstr};

use super::Environment;
use super::diagnostics::{Contradiction, NotAFact};
use crate::declare::elaborator::Elaborator;
use crate::declare::{Library, MAX_INITIALLY, MAX_PATTERNS, PerceptionLifetime};
use crate::ir::{Base, Entities, Entity, Fact, Fluent, Term};

/// Facts at the start with their truth values, in order, in text syntax: `{"holding(mug_1)": true}`.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct InitialState {
    /// Facts with their truth value (`None` for unknown) and span.
    pub facts: IndexMap<String, (Option<bool>, Span)>,
    /// Grip of a thing, which counts while the hand holds that: `{"grip(mug_1)": {"xyz": …, "rpy": …}}`.
    pub grip: Option<Grip>,
    /// Lifetimes of those facts that a perception has made.
    pub lasting: Vec<FactLifetime>,
}

/// Lifetime of a fact that a perception has made before the start.
#[derive(Clone, PartialEq, Debug)]
pub struct FactLifetime {
    /// The fact, as the state writes it.
    pub fact: String,
    /// Names of the resources whose use ends it.
    pub uses: Vec<SmolStr>,
    /// Names of entities: an action that changes something about one of them ends it.
    pub entities: Vec<SmolStr>,
}

impl FactLifetime {
    /// The lifetime in a library; names that it does not know end nothing.
    fn of(&self, library: &Library, entities: &Entities) -> PerceptionLifetime {
        let is_named = |name: &SmolStr| self.uses.contains(name);
        let used = library.resources.iter().filter(|resource| is_named(&resource.name));
        PerceptionLifetime {
            resources: used.fold(0, |all, resource| all | resource.closure),
            entities: self.entities.iter().filter_map(|name| Some(entities.find(name)?.0)).collect(),
        }
    }
}

impl FromIterator<(Spanned<String>, StateEntry)> for InitialState {
    /// State of the entries of a file. A pose of anything but a grip is kept as a fact that does not parse.
    fn from_iter<I: IntoIterator<Item = (Spanned<String>, StateEntry)>>(entries: I) -> Self {
        let mut state = Self::default();
        for (Spanned { value: text, span }, entry) in entries {
            let grip = |pose| {
                let of = text.trim().strip_prefix(lang::GRIP)?.trim().strip_prefix('(')?.strip_suffix(')')?;
                Grip::at(of.trim().trim_matches('`').into(), pose)
            };
            match entry {
                StateEntry::Truth(truth) => drop(state.facts.insert(text, (truth, span))),
                StateEntry::Grip { xyz, rpy } => match grip(Placement { xyz, rpy }) {
                    Some(grip) => state.grip = Some(grip),
                    None => drop(state.facts.insert(format!("{text}: pose"), (None, span))),
                },
            }
        }
        state
    }
}

impl InitialState {
    /// Puts what the hand holds and which containers are open into a scene.
    ///
    /// # Errors
    ///
    /// The fact that only a pose could express.
    pub fn put_into(&self, scene: &mut Scene) -> Result<(), SmolStr> {
        for (fact, (holds, _)) in &self.facts {
            let Some((fluent, args)) = fact.split_once('(') else { continue };
            let arg = args.trim_end_matches(')').trim().trim_matches('`');
            match fluent.trim() {
                lang::fluents::OPEN => {
                    if let Some(entity) = scene.entities.get_mut(arg) {
                        entity.open = *holds;
                    }
                }
                lang::fluents::HOLDING if *holds == Some(true) => {
                    scene.robot.holding = Some(Some(arg.into()));
                }
                lang::fluents::AT | lang::fluents::ON | lang::fluents::IN | lang::fluents::HOLDING => {
                    return Err(format_smolstr!(
                        "the state says `{fact}`, but the scene gives no pose for it"
                    ));
                }
                _ => {}
            }
        }
        scene.robot.grip = self.grip.clone().or_else(|| scene.robot.grip.take());
        Ok(())
    }

    /// Records every fact of the state in an environment, where it overrides the scene.
    pub(super) fn apply(&self, library: &Library, environment: &mut Environment) -> Vec<Diagnostic> {
        let mut diagnostics = Vec::new();
        let entities = environment.entities().clone();
        let (mut said, mut patterns) = (Vec::new(), 0);
        let says_free = self.facts.keys().any(|text| text.trim_start().starts_with(lang::fluents::FREE));
        let lasting: FxHashMap<&str, &FactLifetime> =
            self.lasting.iter().map(|lifetime| (lifetime.fact.as_str(), lifetime)).collect();
        for (index, (text, (value, span))) in self.facts.iter().enumerate() {
            if diagnostics.len() > MAX_MISTAKES {
                break;
            }
            if index == MAX_INITIALLY {
                let why = format!("a state has at most {MAX_INITIALLY} facts");
                diagnostics.push(NotAFact { span: *span, text: text.clone(), why, remedy: None }.into());
                break;
            }
            let parsed = match motet_syntax::text::parse_condition(text) {
                Ok(expr) => expr,
                Err(mistake) => {
                    diagnostics.push(
                        NotAFact { span: *span, text: text.clone(), why: mistake, remedy: None }.into(),
                    );
                    continue;
                }
            };
            let mut elaborator = Elaborator::new(library, &entities, environment.has_scene(), Syntax::Text);
            let fact = match &parsed.kind {
                motet_syntax::ast::ExprKind::Call(call) => elaborator.fact(call),
                _ => None,
            };
            let why = elaborator.diagnostics.into_iter().next();
            match (fact, why) {
                (Some(fact), None) => {
                    patterns += usize::from(fact.args.contains(&None));
                    if patterns > MAX_PATTERNS {
                        let why = format!("a state has at most {MAX_PATTERNS} facts about `any`");
                        let text = text.clone();
                        diagnostics.push(NotAFact { span: *span, text, why, remedy: None }.into());
                        break;
                    }
                    let is_holding = library.lang_items.holding == Some(fact.fluent);
                    if let (true, true, false, [Some(Term::Entity(held))]) =
                        (is_holding, *value == Some(true), says_free, fact.args.as_slice())
                    {
                        super::scene_facts::held(library, environment, *held);
                    }
                    super::base_pose_facts::doubt(library, environment, &fact, *value);
                    said.push((fact.clone(), *value, *span));
                    let Some(value) = value else {
                        environment.forget(&fact);
                        continue;
                    };
                    environment.assert_fact(fact.clone(), *value);
                    if let Some(lifetime) = lasting.get(text.as_str()) {
                        environment.limit(&fact, *value, lifetime.of(library, &entities));
                    }
                }
                (_, why) => {
                    let unasked = || ("expected a fluent".to_owned(), None);
                    let (why, remedy) = why.map_or_else(unasked, |why| (why.message, why.help));
                    diagnostics.push(NotAFact { span: *span, text: text.clone(), why, remedy }.into());
                }
            }
        }
        diagnostics.extend(contradiction(library, environment, &said));
        diagnostics
    }
}

/// Entry of a state: the fact, its truth value (`None` for unknown), and its span.
type StatedFact = (Fact, Option<bool>, Span);

/// Finds a contradiction between the facts of a state and those of the scene.
pub(super) fn contradiction(
    library: &Library,
    environment: &Environment,
    said: &[StatedFact],
) -> Option<Diagnostic> {
    let holding = fluent(library, library.lang_items.holding, |ty| matches!(ty, Base::Entity(_)))?;
    let free = fluent(library, library.lang_items.free, |ty| matches!(ty, Base::Enum(_)))?;
    let hand = library.lang_items.hand.and_then(|hand| library.enums.get(hand.index()))?;
    let about = |of: Fluent| said.iter().filter(move |(fact, ..)| fact.fluent == of);
    let says_all = about(holding).find(|(fact, value, _)| *value == Some(true) && fact.args == [None]);
    if let Some((_, _, span)) = says_all {
        let what = "`holding(any)` means that the robot holds every thing".to_owned();
        let remedy = "name the thing, such as \"holding(mug_1)\": true; \
                      \"holding(any)\": false means that the hands are empty";
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
        let is_it = |(fact, value, _): &&StatedFact| {
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
    let is_spare = |(fact, value, _): &&StatedFact| fact.fluent == free && *value == Some(true);
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

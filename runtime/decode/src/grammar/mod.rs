//! The grammar of the canonical subset in one syntax: the single description of what a constrained model
//! may write.
//!
//! Built from the signatures of a session. The byte automaton ([`crate::automaton`]) and the grammars for
//! servers ([`crate::export`]) and the canonical printer ([`crate::canonical`]) derive from it. The automaton
//! carries out the [`Action`]s between the bytes and evaluates the [`Guard`]s of alternatives against the
//! checker; an exported grammar has neither, and writes recursion out to the depth of the subset. [`json`]
//! and [`text`] say how a syntax spells each step; everything else is said here, for both.

mod action;
mod json;
mod named;
mod part;
mod text;

use std::sync::Arc;

use motet_compiler::signature::{Signatures, Type};
use motet_syntax::Syntax;
use motet_syntax::words::RESERVED;
use smol_str::SmolStr;

pub(crate) use self::action::{
    Action, BlockRole, ConditionUse, Constant, Guard, LetValue, NameUse, NodeKind, Split, WordRole,
};
pub(crate) use self::part::{
    Alternative, ChoiceStyle, CleanupOf, Part, Relation, Repeat, ValuePlace, ValueSet,
};
use crate::subset::{MAX_RETRIES, Modifiers, NumberRange, Subset};

/// Above this number of entities and cases an exported name of the text syntax may be one of theirs: a
/// grammar that excludes them all would be larger than the rest of it.
const MAX_EXCLUDED: usize = 1_000;

/// The grammar of the canonical subset for the signatures of one session.
///
/// Two grammars are equal if they were built from the same signatures (the same allocation) for the same
/// subset.
///
/// ```
/// use motet_decode::{Environment, Grammar, Subset, export};
///
/// let texts = Environment { robot: Some("hsr"), scene: Some("kitchen"), ..Environment::default() };
/// let session = texts.session()?;
/// let grammar = Grammar::new(&session.signatures(), Subset::default());
/// let schema = export::json_schema(&grammar).expect("the JSON syntax has a schema");
/// assert_eq!(schema["type"], "object");
/// # Ok::<(), motet_decode::EnvironmentError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Grammar {
    pub(crate) subset: Subset,
    pub(crate) signatures: Arc<Signatures>,
    /// The types that a name of the policy can have, see [`Signatures::bindable`].
    pub(crate) bindable: Vec<Type>,
    pub(crate) document: Vec<Part>,
    /// The alternatives of a step, without what separates steps.
    pub(crate) steps: Vec<Alternative>,
    /// Conditions without another one inside.
    pub(crate) atoms: Vec<Atom>,
}

/// A condition without another one inside.
#[derive(Clone, Debug)]
pub(crate) struct Atom {
    pub(crate) sort: AtomSort,
    pub(crate) spelled: Alternative,
    /// The robot can observe it, so that a step may ask for it; a goal may ask for any.
    pub(crate) is_observable: bool,
    /// The automaton writes it.
    pub(crate) is_decoded: bool,
}

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum AtomSort {
    /// A fluent, or a list without elements.
    Fluent,
    /// A comparison of a measure, or of the length of a list, with a value.
    Measure,
    /// A comparison of a field with a value.
    Field,
}

impl AtomSort {
    /// The key and the opening quote before the name of an atom in JSON.
    pub(crate) fn lead(self) -> &'static str {
        match self {
            Self::Fluent => "is\":\"",
            Self::Measure => "get\":\"",
            Self::Field => "field\":\"",
        }
    }
}

/// A step of this kind may stand in a cleanup, beside calls and names for values: one that always ends, and
/// whose end nothing but the steps in it can refute.
fn cleans(kind: NodeKind) -> bool {
    matches!(kind, NodeKind::Sequence | NodeKind::If | NodeKind::Wait | NodeKind::Try)
}

impl PartialEq for Grammar {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.signatures, &other.signatures) && self.subset == other.subset
    }
}

impl Grammar {
    /// Builds the grammar of a subset. O(declarations × kinds of entities).
    #[must_use]
    pub fn new(signatures: &Arc<Signatures>, subset: Subset) -> Self {
        let mut grammar = Self {
            subset,
            signatures: Arc::clone(signatures),
            bindable: named::bindable(signatures),
            document: Vec::new(),
            steps: Vec::new(),
            atoms: Vec::new(),
        };
        grammar.atoms = grammar.all_atoms();
        (grammar.document, grammar.steps) = match subset.syntax {
            Syntax::Json => (json::document(&grammar), json::steps(&grammar)),
            Syntax::Text => (text::document(&grammar), text::steps(&grammar)),
        };
        grammar
    }

    /// The subset that the grammar describes.
    #[must_use]
    pub fn subset(&self) -> Subset {
        self.subset
    }

    /// The spelling of `not`, `all` or `any`: the bytes before, between and behind the conditions in it;
    /// `None` for another kind of node.
    pub(crate) fn connective(&self, kind: NodeKind) -> Option<[&'static str; 3]> {
        Some(match (self.subset.syntax, kind) {
            (Syntax::Json, NodeKind::Not) => ["{\"not\":", "", "}"],
            (Syntax::Json, NodeKind::All) => ["{\"all\":[", ",", "]}"],
            (Syntax::Json, NodeKind::Any) => ["{\"any\":[", ",", "]}"],
            (Syntax::Text, NodeKind::Not) => ["not ", "", ""],
            (Syntax::Text, NodeKind::All) => ["", " and ", ""],
            (Syntax::Text, NodeKind::Any) => ["", " or ", ""],
            _ => return None,
        })
    }

    /// Names and words that a name given by the policy may not be in the text syntax. Entities and cases
    /// are left out where they are more than [`MAX_EXCLUDED`].
    pub(crate) fn excluded_names(&self) -> Vec<SmolStr> {
        let mut words: Vec<SmolStr> = RESERVED.iter().map(|word| SmolStr::new_static(word)).collect();
        let cases = self.signatures.enums.iter().flat_map(|def| def.cases.iter());
        let entities = self.signatures.entities.iter().map(|row| &row.0);
        let named: Vec<_> = entities.chain(cases).cloned().collect();
        if named.len() <= MAX_EXCLUDED {
            words.extend(named);
        }
        words
    }

    /// Number of entities, where they are so many that an exported grammar of the text syntax does not keep a
    /// name of the policy from being one of theirs.
    #[must_use]
    pub fn unexcluded_entities(&self) -> Option<usize> {
        let count = self.signatures.entities.len();
        (self.subset.syntax == Syntax::Text && count > MAX_EXCLUDED).then_some(count)
    }

    /// A goal can ask for something.
    fn has_goals(&self) -> bool {
        !self.atoms.is_empty()
    }

    /// A step can ask for something.
    fn has_conditions(&self) -> bool {
        self.atoms.iter().any(|atom| atom.is_observable)
    }

    /// The guard of steps that ask for conditions: the automaton asks for observable fluents first.
    fn when_observed(&self, guard: Guard) -> Guard {
        let observes = self.signatures.fluents.iter().any(|fluent| fluent.is_observable);
        if observes { guard } else { Guard::Never }
    }

    /// The list of an `each` can be written.
    fn has_lists(&self) -> bool {
        !self.signatures.entities.is_empty() || self.binds_lists()
    }

    /// The robot that a policy names.
    pub(crate) fn robot(&self) -> Option<&SmolStr> {
        Some(&self.signatures.robot).filter(|robot| !robot.is_empty())
    }

    /// Parts for a list of arguments; none if nothing can stand for one of them.
    fn arguments<'p>(
        &self,
        params: impl Iterator<Item = (&'p SmolStr, &'p Type, Option<(f64, f64)>)>,
        place: impl Fn(usize) -> ValuePlace,
    ) -> Option<Vec<Part>> {
        let mut parts = Vec::new();
        for (index, (name, ty, range)) in params.enumerate() {
            let place = place(index);
            if !ValueSet::is_fillable(ty, range, place, self) {
                return None;
            }
            match self.subset.syntax {
                Syntax::Json => parts.push(Part::literal(format!(",\"{name}\":"))),
                Syntax::Text if index > 0 => parts.push(Part::literal(", ")),
                Syntax::Text => {}
            }
            parts.push(Part::Value { ty: ty.clone(), range, place });
        }
        Some(parts)
    }

    /// The calls that a step may make, each without the brace or parenthesis that ends it in JSON.
    fn calls(&self) -> Vec<(Alternative, bool)> {
        let is_json = self.subset.syntax == Syntax::Json;
        let mut calls = Vec::new();
        for (number, callable) in (0u16..).zip(&self.signatures.callables) {
            let params = callable.params.iter().map(|param| (&param.name, &param.ty, param.range));
            let place = |index: usize| ValuePlace::Argument(u8::try_from(index).unwrap_or(u8::MAX));
            let Some(arguments) = self.arguments(params, place) else { continue };
            let mut parts = vec![Part::open(NodeKind::Do(number))];
            parts.extend(arguments);
            if !is_json {
                parts.push(Part::literal(")"));
            }
            if callable.moves && self.subset.modifiers == Modifiers::Written {
                parts.push(Part::Manner);
            }
            if !callable.is_policy {
                parts.extend(self.modifier("within", NumberRange::DEADLINE));
                parts.extend(self.modifier("retry", NumberRange::whole(0, MAX_RETRIES)));
            }
            if let Some(ty) = &callable.result {
                let ty = self.type_number(ty);
                if is_json {
                    parts.extend([Part::literal(",\"as\":"), Part::Name(NameUse::Result(ty))]);
                } else {
                    parts.push(Part::Action(Action::Bind(ty)));
                }
            }
            let guard = if is_json { Guard::Open } else { Guard::Callable(number) };
            let call =
                self.applied(&callable.name, guard, number, parts).named(format!("do_{}", callable.name));
            calls.push((call.cleaning(), callable.result.is_some()));
        }
        calls
    }

    /// The bytes before a word for a manner.
    pub(crate) fn manner_lead(&self) -> &'static str {
        match self.subset.syntax {
            Syntax::Json => ",\"manner\":",
            Syntax::Text => " ",
        }
    }

    /// A deadline or retries, where the subset has them.
    fn modifier(&self, word: &str, range: NumberRange) -> Option<Part> {
        let lead = match self.subset.syntax {
            Syntax::Json => format!(",\"{word}\":"),
            Syntax::Text => format!(" {word} "),
        };
        let is_written = self.subset.modifiers == Modifiers::Written;
        is_written.then(|| Part::OptionalNumber { lead: lead.into(), range })
    }

    /// An alternative that begins with the name of what is applied: `go"` in JSON, `go(` in text.
    fn applied(&self, name: &str, guard: Guard, number: u16, parts: Vec<Part>) -> Alternative {
        let literal = match self.subset.syntax {
            Syntax::Json => format!("{name}\""),
            Syntax::Text => format!("{}(", motet_syntax::print::identifier(name)),
        };
        Alternative { name: name.into(), number, ..Alternative::new(literal, guard, parts) }
    }

    /// The atoms that may be asked for in a goal, or in another condition. In a goal nothing is bound, so an
    /// atom with a value that only a binding could fill is left out.
    pub(crate) fn asked_atoms(&self, in_goal: bool) -> impl Iterator<Item = &Atom> {
        let is_unfilled = move |part: &Part| match part {
            Part::ListName | Part::Caught => in_goal,
            Part::Value { ty, range, place } => ValueSet::of(ty, *range, *place, in_goal, self).is_empty(),
            _ => false,
        };
        let atoms = self.atoms.iter().filter(move |atom| atom.is_observable || in_goal);
        atoms.filter(move |atom| !atom.spelled.parts.iter().any(is_unfilled))
    }

    fn all_atoms(&self) -> Vec<Atom> {
        let signatures = &self.signatures;
        let mut atoms = Vec::new();
        for (number, fluent) in (0u16..).zip(&signatures.fluents) {
            let params = fluent.params.iter().map(|(name, ty)| (name, ty, None));
            let Some(arguments) = self.arguments(params, |_| ValuePlace::OfFluent) else { continue };
            let mut parts = vec![Part::open(NodeKind::Is(number))];
            parts.extend(arguments);
            parts.extend(self.atom_end(")"));
            let guard = if self.subset.syntax == Syntax::Json { Guard::Open } else { Guard::Fluent(number) };
            let spelled =
                self.applied(&fluent.name, guard, number, parts).named(format!("is_{}", fluent.name));
            let is_decoded = fluent.name != "monitored" && crate::subset::is_text(&fluent.name);
            atoms.push(Atom {
                sort: AtomSort::Fluent,
                spelled,
                is_observable: fluent.is_observable,
                is_decoded,
            });
        }
        let is_written_out = |ty: &Type| ValueSet::is_fillable(ty, None, ValuePlace::Operand, self);
        for (number, measure) in (0u16..).zip(&signatures.measures) {
            let params = measure.params.iter().map(|(name, ty)| (name, ty, None));
            let Some(arguments) = self.arguments(params, |_| ValuePlace::Plain) else { continue };
            if !is_written_out(&measure.result) || measure.params.iter().any(|(name, _)| name == "than") {
                continue;
            }
            let mut parts = vec![Part::open(NodeKind::Get(number))];
            parts.extend(arguments);
            parts.extend(self.comparison(") ", &measure.result));
            let spelled = self.applied(&measure.name, Guard::Loose, number, parts);
            let spelled = spelled.named(format!("get_{}", measure.name));
            let has_values = measure.params.iter().all(|(_, ty)| match ty {
                Type::Entity(_) | Type::Enum(_) => is_written_out(ty),
                _ => false,
            });
            let is_decoded = measure.is_observable && has_values;
            atoms.push(Atom {
                sort: AtomSort::Measure,
                spelled,
                is_observable: measure.is_observable,
                is_decoded,
            });
        }
        let mut known: Vec<&SmolStr> = Vec::new();
        for (number, field) in (0u16..).zip(&signatures.fields) {
            // Of two kinds with a field of one name the first counts.
            if known.contains(&&field.name) {
                continue;
            }
            known.push(&field.name);
            let of = Type::Entity(field.kind);
            if !ValueSet::is_fillable(&of, None, ValuePlace::Plain, self) || !is_written_out(&field.ty) {
                continue;
            }
            let has_one = is_written_out(&of);
            let of = Part::Value { ty: of, range: None, place: ValuePlace::Plain };
            let (spelled, is_decoded) = match self.subset.syntax {
                Syntax::Json => {
                    let mut parts = vec![Part::open(NodeKind::Field(number)), Part::literal(",\"of\":"), of];
                    parts.extend(self.comparison("", &field.ty));
                    (self.applied(&field.name, Guard::Loose, number, parts), has_one)
                }
                // The field stands behind the entity: the automaton would have to tell it from a fluent
                // only there.
                Syntax::Text => {
                    let lead = format!(".{} ", motet_syntax::print::identifier(&field.name));
                    let mut parts = vec![Part::open(NodeKind::Field(number)), of];
                    parts.extend(self.comparison(&lead, &field.ty));
                    (Alternative::new("", Guard::Loose, parts), false)
                }
            };
            let spelled = spelled.named(format!("field_{}", field.name));
            atoms.push(Atom { sort: AtomSort::Field, spelled, is_observable: true, is_decoded });
        }
        atoms.extend(self.list_atoms());
        atoms.extend(self.caught_atom());
        atoms
    }

    /// The relation and the value of a comparison; in text `lead` stands before the relation.
    fn comparison(&self, lead: &str, ty: &Type) -> Vec<Part> {
        let operand = Part::Value { ty: ty.clone(), range: None, place: ValuePlace::Operand };
        let mut parts = match self.subset.syntax {
            Syntax::Json => {
                vec![
                    Part::literal(",\"is\":"),
                    Part::Relation(ty.clone()),
                    Part::literal(",\"than\":"),
                    operand,
                ]
            }
            Syntax::Text => vec![Part::literal(lead), Part::Relation(ty.clone()), operand],
        };
        parts.extend(self.atom_end(""));
        parts
    }

    fn atom_end(&self, text: &str) -> Vec<Part> {
        let end = if self.subset.syntax == Syntax::Json { "}" } else { text };
        let end = (!end.is_empty()).then(|| Part::literal(end));
        end.into_iter().chain([Part::Action(Action::Close)]).collect()
    }
}

impl Grammar {
    /// Returns `true` if a loop may iterate over a list that a step has bound.
    pub(crate) fn binds_lists(&self) -> bool {
        self.bindable.iter().any(|ty| matches!(ty, Type::List(_)))
    }

    /// The entities of each kind that has any of its own, for the list of an `each`.
    pub(crate) fn entities_by_kind(&self) -> Vec<Vec<SmolStr>> {
        let own = |kind: usize| {
            let own = self.signatures.entities.iter().filter(move |row| row.1 == kind && row.0 != "any");
            own.map(|row| row.0.clone()).collect::<Vec<_>>()
        };
        (0..self.signatures.kinds.len()).map(own).filter(|names| !names.is_empty()).collect()
    }

    /// The number of a type among those that a name can have.
    pub(crate) fn type_number(&self, ty: &Type) -> u16 {
        let at = self.bindable.iter().position(|known| known == ty);
        at.and_then(|at| u16::try_from(at).ok()).unwrap_or(u16::MAX)
    }

    /// The guard of a condition that may be left out.
    fn when_asked(&self, asked: ConditionUse) -> Guard {
        match asked {
            ConditionUse::Goal if self.signatures.fluents.is_empty() => Guard::Never,
            ConditionUse::Goal | ConditionUse::Branch => Guard::Open,
            ConditionUse::Wait | ConditionUse::Until => self.when_observed(Guard::Open),
        }
    }
}

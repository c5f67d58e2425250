//! Productions of what is new in a policy beside calls: values that a `let` names, terms on lists, and the
//! rules of a `keep`.

use motet_compiler::signature::{Signatures, Type};
use motet_stdlib::lang;
use motet_syntax::Syntax;
use motet_syntax::ast::POSE;
use motet_syntax::print::identifier;
use motet_syntax::unit::{Dimension, Unit};
use smol_str::SmolStr;

use super::{
    Action, Alternative, Atom, AtomSort, ChoiceStyle, Grammar, Guard, LetValue, NodeKind, Part, ValuePlace,
    ValueSet, WordRole,
};
use crate::subset::{NumberRange, is_name};

/// The terms on lists that the language itself has.
const TERMS: [&str; 3] = ["count", "first", "is_empty"];

/// The types that a name can have: those of results and items, and those of values that a `let` names.
pub(super) fn bindable(signatures: &Signatures) -> Vec<Type> {
    let mut found = signatures.bindable();
    let length = found.iter().any(|ty| matches!(ty, Type::List(_))).then_some(&Type::Int);
    let measures = signatures.measures.iter().filter(|measure| measure.is_observable);
    let fields = signatures.fields.iter().map(|field| &field.ty);
    let caught = (!signatures.failures.is_empty()).then_some(&Type::Failure);
    for ty in length.into_iter().chain(caught).chain(measures.map(|measure| &measure.result)).chain(fields) {
        if !found.contains(ty) {
            found.push(ty.clone());
        }
    }
    found
}

fn literal(text: &str) -> Part {
    Part::literal(text)
}

impl Grammar {
    /// A term on a bound list can be written: no declaration replaces it.
    pub(crate) fn has_term(&self, name: &str) -> bool {
        let signatures = &self.signatures;
        self.binds_lists()
            && signatures.measures.iter().all(|measure| measure.name != name)
            && signatures.fluents.iter().all(|fluent| fluent.name != name)
    }

    /// A pose can be written out: no measure has its name.
    pub(crate) fn has_poses(&self) -> bool {
        self.signatures.measure(POSE).is_none()
    }

    /// The kind and the text of a caught failure can be written: no field of a kind has their names.
    pub(crate) fn has_caught(&self) -> bool {
        let is_ours = |name: &str| name == "kind" || name == "text";
        self.can_bind(&Type::Failure) && !self.signatures.fields.iter().any(|field| is_ours(&field.name))
    }

    /// The types that a policy may give, with the numbers of the types of names and with their spelling.
    pub(crate) fn result_types(&self) -> Vec<(u16, SmolStr)> {
        let mut found: Vec<(u16, SmolStr)> = Vec::new();
        for ty in self.bindable.iter().filter(|ty| **ty != Type::Failure) {
            let name = SmolStr::new(self.signatures.type_name(ty));
            let plain = name.trim_start_matches("List<").trim_end_matches('>');
            let is_spelled = is_name(plain) && identifier(plain) == plain;
            let has_name = !matches!(ty, Type::Quantity(dimension) if dimension.type_name().is_none());
            if is_spelled && has_name && found.iter().all(|(_, known)| *known != name) {
                found.push((self.type_number(ty), name));
            }
        }
        found
    }

    /// The condition on the kind of a caught failure.
    pub(super) fn caught_atom(&self) -> Option<Atom> {
        let mut parts = vec![Part::open(NodeKind::Caught)];
        let relation = Part::Relation(Type::Failure);
        let spelled = if self.is_json() {
            parts.extend([literal(",\"of\":"), Part::Caught, literal(",\"is\":"), relation]);
            parts.extend([literal(",\"than\":"), Part::FailureKind]);
            parts.extend(self.atom_end(""));
            self.applied("kind", Guard::Caught, u16::MAX, parts)
        } else {
            // The name of the failure stands before the word.
            parts.extend([Part::Caught, literal(".kind "), relation, Part::FailureKind]);
            parts.extend(self.atom_end(""));
            Alternative::new("", Guard::OfCaught, parts)
        };
        let spelled = spelled.named("caught_kind");
        let atom = Atom { sort: AtomSort::Field, spelled, is_observable: true, is_decoded: true };
        self.has_caught().then_some(atom)
    }

    /// The conditions on bound lists.
    pub(super) fn list_atoms(&self) -> Vec<Atom> {
        let [count, _, is_empty] = TERMS;
        let mut atoms = Vec::new();
        let guard = |bare: Guard| if self.is_json() { Guard::List } else { bare };
        let atom = |sort, spelled: Alternative| Atom { sort, spelled, is_observable: true, is_decoded: true };
        if self.has_term(is_empty) {
            let mut parts = vec![Part::open(NodeKind::IsEmpty)];
            parts.extend(self.of_list());
            parts.extend(self.atom_end(")"));
            let spelled = self.applied(is_empty, guard(Guard::OfList), u16::MAX, parts);
            atoms.push(atom(AtomSort::Fluent, spelled.named(is_empty)));
        }
        if self.has_term(count) {
            let mut parts = vec![Part::open(NodeKind::Count)];
            parts.extend(self.of_list());
            parts.extend(self.comparison(") ", &Type::Int));
            let spelled = self.applied(count, guard(Guard::OfList), u16::MAX, parts);
            atoms.push(atom(AtomSort::Measure, spelled.named("get_count")));
        }
        atoms
    }

    /// The list of a term, behind its name.
    fn of_list(&self) -> Vec<Part> {
        let key = self.is_json().then(|| literal(",\"of\":"));
        key.into_iter().chain([Part::ListName]).collect()
    }

    pub(super) fn is_json(&self) -> bool {
        self.subset.syntax == Syntax::Json
    }

    /// A value can be named wherever no list is bound.
    pub(crate) fn names_values(&self) -> bool {
        self.subset.syntax == Syntax::Json && !self.signatures.fields.is_empty()
            || self.signatures.measures.iter().any(|measure| measure.is_observable)
    }

    /// The values that a `let` names, by the key before the name of a value in JSON.
    fn let_values(&self) -> [(&'static str, Vec<Alternative>); 2] {
        let [count, first, _] = TERMS;
        let (mut gets, mut fields) = (Vec::new(), Vec::new());
        let end = |value: LetValue, ty: &Type| {
            let bind = match value {
                LetValue::First => Action::BindFirst,
                LetValue::Count | LetValue::Get(_) | LetValue::Field(_) | LetValue::CaughtText => {
                    Action::Bind(self.type_number(ty))
                }
            };
            let end = if self.is_json() { "}" } else { ")" };
            [literal(end), Part::Action(bind)]
        };
        for (name, value) in [(count, LetValue::Count), (first, LetValue::First)] {
            if self.has_term(name) {
                let mut parts = vec![Part::open(NodeKind::Let(value))];
                parts.extend(self.of_list());
                parts.extend(end(value, &Type::Int));
                let named = self.applied(name, Guard::List, u16::MAX, parts);
                gets.push(named.named(format!("let_{name}")));
            }
        }
        for (number, measure) in (0u16..).zip(&self.signatures.measures) {
            let params = measure.params.iter().map(|(name, ty)| (name, ty, None));
            let arguments = self.arguments(params, |_| ValuePlace::Plain);
            let Some(arguments) = arguments.filter(|_| measure.is_observable) else { continue };
            let value = LetValue::Get(number);
            let mut parts = vec![Part::open(NodeKind::Let(value))];
            parts.extend(arguments);
            parts.extend(end(value, &measure.result));
            let named = self.applied(&measure.name, Guard::Open, number, parts);
            gets.push(named.named(format!("let_{}", measure.name)));
        }
        for (number, field) in (0u16..).zip(&self.signatures.fields) {
            let of = Type::Entity(field.kind);
            let is_first = self.signatures.fields.iter().position(|known| known.name == field.name);
            if is_first != Some(usize::from(number))
                || !ValueSet::is_fillable(&of, None, ValuePlace::Plain, self)
            {
                continue;
            }
            let value = LetValue::Field(number);
            let of = Part::Value { ty: of, range: None, place: ValuePlace::Plain };
            let open = Part::open(NodeKind::Let(value));
            let [close, bind] = end(value, &field.ty);
            let named = if self.is_json() {
                let parts = vec![open, literal(",\"of\":"), of, close, bind];
                self.applied(&field.name, Guard::Open, number, parts)
            } else {
                // As in a comparison, the field stands behind the entity.
                let name = literal(&format!(".{}", identifier(&field.name)));
                Alternative::new("", Guard::Never, vec![open, of, name, bind])
            };
            fields.push(named.named(format!("let_{}", field.name)));
        }
        if self.has_caught() {
            let open = Part::open(NodeKind::Let(LetValue::CaughtText));
            let [close, bind] = end(LetValue::CaughtText, &Type::Text);
            let named = if self.is_json() {
                let parts = vec![open, literal(",\"of\":"), Part::Caught, close, bind];
                self.applied("text", Guard::Caught, u16::MAX, parts)
            } else {
                Alternative::new("", Guard::Caught, vec![open, Part::Caught, literal(".text"), bind])
            };
            fields.push(named.named("let_caught_text"));
        }
        [("get", gets), ("field", fields)]
    }

    /// The step that names a value in JSON.
    pub(super) fn let_step(&self) -> Option<Alternative> {
        let mut alternatives = Vec::new();
        for (key, values) in self.let_values() {
            let guard = match key {
                "get" if !self.names_measures() => Guard::List,
                "field" if self.signatures.fields.is_empty() => Guard::Caught,
                _ => Guard::Open,
            };
            if !values.is_empty() {
                let values = Part::Choice(ChoiceStyle::Names(WordRole::Head), values);
                alternatives.push(Alternative::new(format!("{key}\":\""), guard, vec![values]));
            }
        }
        let parts = vec![
            Part::Name(super::NameUse::Let),
            literal(",\"be\":{\""),
            Part::Choice(ChoiceStyle::Literals, alternatives.clone()),
        ];
        (!alternatives.is_empty()).then(|| Alternative::new("let\":", Guard::LetValue, parts).cleaning())
    }

    /// The values that a `let` names in text.
    pub(super) fn let_words(&self) -> Vec<Alternative> {
        self.let_values().into_iter().flat_map(|(_, values)| values).collect()
    }

    fn names_measures(&self) -> bool {
        self.signatures.measures.iter().any(|measure| measure.is_observable)
    }

    /// One rule of a `keep`; none if the robot does not observe distances. The values are at a place where
    /// names may be bound, or not.
    pub(crate) fn keep_rule(&self, place: ValuePlace) -> Option<Vec<Part>> {
        const LENGTH: Type = Type::Quantity(Dimension::LENGTH);
        let least =
            NumberRange { least: 0, greatest: 1_000_000, decimals: 3, unit: Unit::si(Dimension::LENGTH) };
        let signatures = &self.signatures;
        let is_watched = signatures.measure(lang::measures::DISTANCE).is_some_and(|measure| {
            let to = measure.params.as_slice();
            measure.is_observable && measure.result == LENGTH && matches!(to, [(_, Type::Entity(0))])
        });
        if !is_watched {
            return None;
        }
        let entity = |kind: usize| Part::Value { ty: Type::Entity(kind), range: None, place };
        let is_fillable = |kind| ValueSet::is_fillable(&Type::Entity(kind), None, place, self);
        let close = || Part::Action(Action::Close);
        let [out, distance] = if self.is_json() {
            let end = || literal("}");
            [
                ("{\"out_of\":", vec![end()]),
                ("{\"distance\":", vec![literal(",\"at_least\":"), Part::Number(least), end()]),
            ]
        } else {
            [("out of ", Vec::new()), ("distance(", vec![literal(") >= "), Part::Number(least)])]
        };
        let zone = signatures.kinds.iter().position(|kind| kind.name == lang::kinds::ZONE);
        let mut alternatives = Vec::new();
        for (kind, node, (word, rest)) in
            [(zone, NodeKind::OutOf, out), (Some(0), NodeKind::Distance, distance)]
        {
            let Some(kind) = kind.filter(|kind| is_fillable(*kind)) else { continue };
            let mut parts = vec![Part::open(node), entity(kind)];
            parts.extend(rest);
            parts.push(close());
            let fixed = if place == ValuePlace::Operand { "_fixed" } else { "" };
            let name = if node == NodeKind::OutOf { "out_of" } else { "distance" };
            alternatives
                .push(Alternative::new(word, Guard::Open, parts).named(format!("keep_{name}{fixed}")));
        }
        let style = if self.is_json() { ChoiceStyle::Literals } else { ChoiceStyle::Keywords };
        (!alternatives.is_empty()).then(|| vec![Part::Choice(style, alternatives)])
    }
}

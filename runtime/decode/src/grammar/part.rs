//! The elements of productions.

use motet_compiler::signature::Type;
use smol_str::SmolStr;

use super::{Action, BlockRole, ConditionUse, Guard, NameUse, NodeKind, WordRole};
use crate::subset::NumberRange;

/// An element of a production. Values, names, conditions and blocks are spelled as the syntax of the
/// grammar spells them.
#[derive(Clone, Debug)]
pub(crate) enum Part {
    Literal(SmolStr),
    /// No byte: an action of the automaton.
    Action(Action),
    /// A name that the policy gives, with what ends it: quotes around it in JSON, a space behind it in text.
    Name(NameUse),
    /// A value of a type; `range` bounds a number, in SI units.
    Value {
        ty: Type,
        range: Option<(f64, f64)>,
        place: ValuePlace,
    },
    /// A number, in text with its unit.
    Number(NumberRange),
    /// A number or its default: in JSON `null` behind the lead, in text nothing at all.
    OptionalNumber {
        lead: SmolStr,
        range: NumberRange,
    },
    /// A relation between values of a type; in text with the space behind it.
    Relation(Type),
    /// The kinds of failure of a handler, with brackets in JSON, with the space behind them in text.
    Failures,
    /// The list of an `each`: a binding, or entities of one kind.
    EntityList,
    /// A condition, asked for as told.
    Condition(ConditionUse),
    /// A block of at least so many steps, 0 or 1.
    Block(BlockRole, u32),
    /// One of several.
    Choice(ChoiceStyle, Vec<Alternative>),
    /// An alternative or nothing but the actions of `absent`.
    Optional {
        present: Box<Alternative>,
        absent: Vec<Part>,
        absent_guard: Guard,
    },
    /// The same several times.
    Repeat(Box<Repeat>),
}

/// Position of a value.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum ValuePlace {
    /// The argument of a call with this number.
    Argument(u8),
    /// An argument of a fluent, which may be `any`.
    OfFluent,
    /// The right side of a comparison: written out, never a binding.
    Operand,
    /// Any other place.
    Plain,
}

/// Method by which the automaton tells the alternatives of a choice apart.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum ChoiceStyle {
    /// By literals of which none begins another.
    Literals,
    /// By names in quotes, of which the opening one stands before the choice.
    Names(WordRole),
    /// By words, some of which depend on the state of the policy.
    Keywords,
}

/// An alternative of a choice.
#[derive(Clone, Debug)]
pub(crate) struct Alternative {
    /// A name for the rule of an exported grammar.
    pub(crate) name: SmolStr,
    /// The bytes by which it is told from the others.
    pub(crate) literal: SmolStr,
    /// When it is open.
    pub(crate) guard: Guard,
    /// The number of the declaration that it names.
    pub(crate) number: u16,
    pub(crate) parts: Vec<Part>,
    /// It ends the policy: no step behind it in its block is ever reached.
    pub(crate) is_ending: bool,
}

/// A part that is repeated from `least` to `most` times.
#[derive(Clone, Debug)]
pub(crate) struct Repeat {
    pub(crate) open: SmolStr,
    pub(crate) item: Vec<Part>,
    pub(crate) separator: SmolStr,
    /// The bytes behind the last item; none if what follows the repetition tells that it is over.
    pub(crate) end: SmolStr,
    /// 1 or 2.
    pub(crate) least: u8,
    pub(crate) most: u8,
}

impl Part {
    pub(crate) fn literal(text: impl Into<SmolStr>) -> Self {
        Self::Literal(text.into())
    }

    pub(crate) fn open(kind: NodeKind) -> Self {
        Self::Action(Action::Open(kind))
    }

    pub(crate) fn repeat(
        [open, separator, end]: [&'static str; 3],
        [least, most]: [usize; 2],
        item: Vec<Self>,
    ) -> Self {
        let [open, separator, end] = [open, separator, end].map(SmolStr::new_static);
        let [least, most] = [least, most].map(|count| u8::try_from(count).unwrap_or(u8::MAX));
        Self::Repeat(Box::new(Repeat { open, item, separator, end, least, most }))
    }
}

impl Alternative {
    pub(crate) fn new(literal: impl Into<SmolStr>, guard: Guard, parts: Vec<Part>) -> Self {
        let literal: SmolStr = literal.into();
        let name = literal.chars().take_while(char::is_ascii_alphabetic).collect();
        Self { name, literal, guard, number: 0, parts, is_ending: false }
    }

    pub(crate) fn named(self, name: impl Into<SmolStr>) -> Self {
        Self { name: name.into(), ..self }
    }

    pub(crate) fn ending(self) -> Self {
        Self { is_ending: true, ..self }
    }

    /// Alternatives of which none begins with a choice of its own, behind a prefix: the literals of a
    /// choice at the beginning of an alternative become part of its own.
    pub(crate) fn flattened(alternatives: &[Self], prefix: &str) -> Vec<Self> {
        let mut flat = Vec::new();
        for way in alternatives {
            let literal = format!("{prefix}{}", way.literal);
            let first = way.parts.iter().position(|part| !matches!(part, Part::Action(_)));
            match first.and_then(|at| Some((at, way.parts.get(at)?))) {
                Some((at, Part::Choice(_, inner))) if !way.literal.is_empty() => {
                    let (before, rest) = way.parts.split_at_checked(at).unwrap_or_default();
                    for inner in Self::flattened(inner, &literal) {
                        let parts = before.iter().chain(&inner.parts).chain(rest.iter().skip(1)).cloned();
                        flat.push(Self { parts: parts.collect(), ..inner });
                    }
                }
                _ => flat.push(Self { literal: literal.into(), ..way.clone() }),
            }
        }
        flat
    }

    /// It has blocks of its own, one level below the step.
    pub(crate) fn is_composite(&self) -> bool {
        matches!(self.guard, Guard::Nest | Guard::Fix)
            || self.parts.iter().any(|part| matches!(part, Part::Block(..)))
    }
}

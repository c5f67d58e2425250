//! The elements of productions, and the values that may stand at one place.

use motet_compiler::signature::Type;
use motet_syntax::ast::CompareOp;
use smol_str::SmolStr;

use super::{Action, BlockRole, ConditionUse, Grammar, Guard, NameUse, NodeKind, WordRole};
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
    /// A manner of a call, or nothing, as an optional number.
    Manner,
    /// The name of a bound list.
    ListName,
    /// The name of a bound failure.
    Caught,
    /// A kind of failure with which that of a bound one is compared.
    FailureKind,
    /// The name that a handler gives its failure, or nothing; in JSON with its key.
    CaughtName,
    /// The type of the policy's result, or nothing; in text with its arrow, and with the space behind it.
    ResultType,
    /// The result of a `done`, if the policy gives one, between bytes that are only written with it.
    Given {
        lead: &'static str,
        end: &'static str,
    },
    /// A relation between values of a type; in text with the space behind it.
    Relation(Type),
    /// The kinds of failure of a handler, with brackets in JSON, with the space behind them in text.
    Failures,
    /// The list of an `each`: a binding, or entities of one kind.
    EntityList,
    /// A condition with its use.
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
    /// The cleanup of the step or of the policy before it, or nothing.
    Cleanup(CleanupOf),
    /// The same several times.
    Repeat(Box<Repeat>),
}

/// Owner of a cleanup.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum CleanupOf {
    Step,
    /// The policy: in JSON its key is always there.
    Policy,
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
    /// The bytes that distinguish it from the others.
    pub(crate) literal: SmolStr,
    /// The condition under which it is open.
    pub(crate) guard: Guard,
    /// The number of the declaration that it names.
    pub(crate) number: u16,
    pub(crate) parts: Vec<Part>,
    /// It ends the policy: no step behind it in its block is ever reached.
    pub(crate) is_ending: bool,
    /// It may stand in a cleanup.
    pub(crate) cleans: bool,
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
        Self { name, literal, guard, number: 0, parts, is_ending: false, cleans: false }
    }

    pub(crate) fn named(self, name: impl Into<SmolStr>) -> Self {
        Self { name: name.into(), ..self }
    }

    pub(crate) fn ending(self) -> Self {
        Self { is_ending: true, ..self }
    }

    pub(crate) fn cleaning(self) -> Self {
        Self { cleans: true, ..self }
    }

    /// Alternatives of which none begins with a choice of its own, behind a prefix: the literals of a
    /// choice at the beginning of an alternative become part of its own.
    pub(crate) fn flattened(alternatives: &[Self], prefix: &str) -> Vec<Self> {
        let mut flat = Vec::new();
        for alternative in alternatives {
            let literal = format!("{prefix}{}", alternative.literal);
            let first = alternative.parts.iter().position(|part| !matches!(part, Part::Action(_)));
            match first.and_then(|at| Some((at, alternative.parts.get(at)?))) {
                Some((at, Part::Choice(_, inner))) if !alternative.literal.is_empty() => {
                    let (before, rest) = alternative.parts.split_at_checked(at).unwrap_or_default();
                    for inner in Self::flattened(inner, &literal) {
                        let parts = before.iter().chain(&inner.parts).chain(rest.iter().skip(1)).cloned();
                        flat.push(Self { parts: parts.collect(), ..inner });
                    }
                }
                _ => flat.push(Self { literal: literal.into(), ..alternative.clone() }),
            }
        }
        flat
    }

    /// It is the alternative of a node, or one within a choice of it is.
    pub(crate) fn opens(&self, kind: NodeKind) -> bool {
        self.parts.iter().any(|part| match part {
            Part::Action(Action::Open(opened)) => *opened == kind,
            Part::Choice(_, alternatives) => alternatives.iter().any(|alternative| alternative.opens(kind)),
            _ => false,
        })
    }

    /// It has blocks of its own, one level below the step.
    pub(crate) fn is_composite(&self) -> bool {
        matches!(self.guard, Guard::Nest | Guard::Fix | Guard::If | Guard::Interrupt)
            || self.parts.iter().any(|part| matches!(part, Part::Block(..)))
    }
}

/// Operator of a comparison.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(crate) struct Relation(pub(crate) CompareOp);

impl Relation {
    /// Those of numbers.
    pub(crate) const ALL: [Self; 6] = [
        Self(CompareOp::Less),
        Self(CompareOp::AtMost),
        Self(CompareOp::Equal),
        Self(CompareOp::More),
        Self(CompareOp::AtLeast),
        Self(CompareOp::Unequal),
    ];
    /// Those of anything else.
    pub(crate) const EQUALITY: [Self; 2] = [Self(CompareOp::Equal), Self(CompareOp::Unequal)];

    #[must_use]
    pub(crate) fn word(self) -> &'static str {
        self.0.key()
    }

    #[must_use]
    pub(crate) fn symbol(self) -> &'static str {
        self.0.symbol()
    }

    /// The same with the sides exchanged.
    #[must_use]
    pub(crate) fn turned(self) -> Self {
        Self(match self.0 {
            CompareOp::Equal => CompareOp::Equal,
            CompareOp::Unequal => CompareOp::Unequal,
            CompareOp::Less => CompareOp::More,
            CompareOp::AtMost => CompareOp::AtLeast,
            CompareOp::More => CompareOp::Less,
            CompareOp::AtLeast => CompareOp::AtMost,
        })
    }
}

/// The values that an exported grammar allows at a place.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct ValueSet {
    /// A name for the rule, after the type.
    pub(crate) name: String,
    /// The entities or cases.
    pub(crate) names: Vec<SmolStr>,
    pub(crate) number: Option<NumberRange>,
    pub(crate) text: bool,
    pub(crate) bool: bool,
    pub(crate) any: bool,
    /// A name that a step has bound.
    pub(crate) binding: bool,
    /// The first element of a bound list.
    pub(crate) first: bool,
    /// A pose that is written out.
    pub(crate) pose: bool,
    /// The items of a list that is written out.
    pub(crate) items: Option<Box<Self>>,
}

impl ValueSet {
    /// The values of a type at a place; in a goal nothing is bound.
    pub(crate) fn of(
        ty: &Type,
        range: Option<(f64, f64)>,
        place: ValuePlace,
        in_goal: bool,
        grammar: &Grammar,
    ) -> Self {
        let signatures = &grammar.signatures;
        let binds = !in_goal && place != ValuePlace::Operand;
        let any = place == ValuePlace::OfFluent;
        let names = match ty {
            // `any` means something else where it may stand.
            Type::Entity(kind) => {
                signatures.entities_of(*kind).filter(|name| *name != "any").cloned().collect()
            }
            Type::Enum(id) => signatures.enums.get(*id).map(|def| def.cases.clone()).unwrap_or_default(),
            _ => Vec::new(),
        };
        let items = match ty {
            Type::List(element) => Some(Self::of(element, None, place, in_goal, grammar)),
            _ => None,
        };
        let first = matches!((place, ty), (ValuePlace::Argument(_), Type::Entity(_)))
            && grammar.has_term("first")
            && grammar.can_bind(&Type::List(Box::new(ty.clone())));
        let (any_mark, goal_mark) = (if any { "_any" } else { "" }, if binds { "" } else { "_fixed" });
        let first_mark = if first { "_or_first" } else { "" };
        Self {
            name: format!("{}{any_mark}{goal_mark}{first_mark}", signatures.type_name(ty)),
            names,
            number: NumberRange::of(ty, range),
            text: *ty == Type::Text,
            bool: *ty == Type::Bool,
            any,
            binding: binds && grammar.can_bind(ty),
            first,
            pose: Self::is_pose(ty, place, grammar),
            items: items.filter(|items| !items.is_empty()).map(Box::new),
        }
    }

    /// Something can stand at a place for a value of a type.
    pub(crate) fn is_fillable(
        ty: &Type,
        range: Option<(f64, f64)>,
        place: ValuePlace,
        grammar: &Grammar,
    ) -> bool {
        let signatures = &grammar.signatures;
        let is_written = match ty {
            Type::Entity(kind) => signatures.entities_of(*kind).any(|name| name != "any"),
            Type::Enum(id) => signatures.enums.get(*id).is_some_and(|def| !def.cases.is_empty()),
            Type::Text | Type::Bool => true,
            Type::Int | Type::Number | Type::Quantity(_) => NumberRange::of(ty, range).is_some(),
            Type::Pose => Self::is_pose(ty, place, grammar),
            Type::Failure => false,
            Type::List(element) => Self::is_fillable(element, None, place, grammar),
        };
        is_written || place == ValuePlace::OfFluent || (place != ValuePlace::Operand && grammar.can_bind(ty))
    }

    /// Nothing can stand at the place.
    pub(crate) fn is_empty(&self) -> bool {
        self.names.is_empty()
            && self.number.is_none()
            && !(self.text || self.bool || self.any || self.binding || self.first || self.pose)
            && self.items.is_none()
    }

    /// A pose may be written out at a place: an argument of a call.
    fn is_pose(ty: &Type, place: ValuePlace, grammar: &Grammar) -> bool {
        *ty == Type::Pose && matches!(place, ValuePlace::Argument(_)) && grammar.has_poses()
    }

    /// The values have an order, so that they can be compared by more than equality.
    pub(crate) fn is_ordered(ty: &Type) -> bool {
        NumberRange::of(ty, None).is_some()
    }
}

impl Grammar {
    /// Some step or loop can bind a name that fits a type.
    pub(crate) fn can_bind(&self, ty: &Type) -> bool {
        self.bindable.iter().any(|actual| self.signatures.fits(ty, actual))
    }
}

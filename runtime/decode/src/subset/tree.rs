//! The tree of a policy in the canonical subset: every argument given and in order, every value of one
//! kind, every default named. [`crate::canonical`] makes it from a policy and prints it.

use motet_syntax::ast::{CompareOp, EndKind};
use motet_syntax::unit::Unit;
use smol_str::SmolStr;

use super::Decimal;

#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Document {
    pub(crate) name: SmolStr,
    /// The robot of the library; none where it has none.
    pub(crate) robot: Option<SmolStr>,
    /// Goal of the policy.
    pub(crate) achieves: Option<Condition>,
    /// Its steps, one at least.
    pub(crate) steps: Vec<Step>,
}

#[derive(Clone, PartialEq, Debug)]
pub(crate) enum Step {
    /// `{"do":"pick","object":"$mug","from":"auto"}`, `pick(mug, auto)`
    Do(Call),
    /// `{"sequence":"tidy","steps":[…]}`, `sequence tidy { … }`
    Sequence(SmolStr, Vec<Step>),
    /// `{"if":c,"then":[…],"else":[…]}`, `if c { … } else { … }`; in text an empty `else` is left out.
    If(Condition, Vec<Step>, Vec<Step>),
    /// `{"wait":c}`, `wait until c`, with modifiers with a deadline in seconds.
    Wait(Condition, Option<Decimal>),
    /// `{"monitor":[…],"during":[…]}`, `monitor { when … } during { … }`
    Monitor(Vec<When>, Vec<Step>),
    /// `{"try":[…],"catch":[…]}`, `try { … } catch a, b { … }`
    Try(Vec<Step>, Vec<Catch>),
    /// `{"repeat":3,"steps":[…],"until":null}`, `repeat 3 { … }`
    Repeat(u32, Vec<Step>, Option<Condition>),
    /// `{"each":"cup","in":"$cups","at_most":5,"steps":[…]}`, `each cup in cups at most 5 { … }`
    Each {
        /// The name of each item.
        item: SmolStr,
        /// The list: a name, or entities that are all of one kind.
        list: Value,
        /// The longest list that is taken.
        at_most: u32,
        steps: Vec<Step>,
    },
    /// `{"parallel":[[…],[…]]}`, `parallel { { … } { … } }`
    Parallel(Vec<Vec<Step>>),
    End(End),
}

/// A call of a primitive or a policy.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Call {
    pub(crate) name: SmolStr,
    /// The arguments with the names of their parameters, all of them, in order.
    pub(crate) args: Vec<(SmolStr, Value)>,
    /// Marks a call of a policy, which has no modifiers.
    pub(crate) is_policy: bool,
    /// The deadline, in seconds.
    pub(crate) within: Option<Decimal>,
    pub(crate) retry: Option<u32>,
    /// The name of its result; always there where it has one.
    pub(crate) bind: Option<SmolStr>,
}

/// A condition that is watched, and what then happens.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct When {
    pub(crate) condition: Condition,
    /// Time in seconds for which the condition must hold; `null` in JSON for the default.
    pub(crate) hold: Option<Decimal>,
    pub(crate) reaction: Reaction,
}

/// Reaction of a monitor.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum Reaction {
    /// `{"react":"pause"}`, `pause`, with modifiers with its longest time in seconds.
    Pause(Option<Decimal>),
    /// `{"react":"restart","at_most":3}`, `restart at most 3`
    Restart(u32),
    /// `{"react":"resume","at_most":3,"steps":[…]}`, `resume at most 3 { … }`
    Resume(u32, Vec<Step>),
    End(End),
}

#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Catch {
    /// The kinds of failure; `any` where there is none.
    pub(crate) on: Vec<SmolStr>,
    /// Its steps; there may be none.
    pub(crate) steps: Vec<Step>,
}

#[derive(Clone, PartialEq, Debug)]
pub(crate) struct End {
    pub(crate) kind: EndKind,
    /// The reason: always there but for `done`; a text or a name.
    pub(crate) why: Option<Value>,
}

#[derive(Clone, PartialEq, Debug)]
pub(crate) enum Condition {
    Is(SmolStr, Vec<(SmolStr, Value)>),
    /// `{"not":c}`, `not c`
    Not(Box<Condition>),
    /// `{"all":[…]}`, `a and b`; two or more.
    All(Vec<Condition>),
    /// `{"any":[…]}`, `a or b`; two or more.
    Any(Vec<Condition>),
    /// `{"get":"distance","to":"user","is":"less","than":0.5}`, `distance(user) < 0.5 m`
    Compare(Subject, Relation, Value),
}

/// Left side of a comparison.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum Subject {
    Measure(SmolStr, Vec<(SmolStr, Value)>),
    /// A field of an entity.
    Field(SmolStr, Value),
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
        match self.0 {
            CompareOp::Equal => "equal",
            CompareOp::Unequal => "unequal",
            CompareOp::Less => "less",
            CompareOp::AtMost => "at_most",
            CompareOp::More => "more",
            CompareOp::AtLeast => "at_least",
        }
    }

    #[must_use]
    pub(crate) fn symbol(self) -> &'static str {
        match self.0 {
            CompareOp::Equal => "==",
            CompareOp::Unequal => "!=",
            CompareOp::Less => "<",
            CompareOp::AtMost => "<=",
            CompareOp::More => ">",
            CompareOp::AtLeast => ">=",
        }
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

#[derive(Clone, PartialEq, Debug)]
pub(crate) enum Value {
    /// `"$mug"`, `mug`: what a step has bound.
    Binding(SmolStr),
    /// `"mug_1"`, `mug_1`: an entity or a case.
    Name(SmolStr),
    /// `0.5`, `0.5 m`: a number, in SI units, and the unit of the text form.
    Number(Decimal, Option<Unit>),
    Text(SmolStr),
    Bool(bool),
    /// `any`, of a fluent.
    Any,
    /// `["$a","mug_1"]`, `[a, mug_1]`
    List(Vec<Value>),
}

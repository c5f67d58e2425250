//! A policy of the model subset: every argument given and in order, every value of one kind, nothing left to a default
//! but by name. [`crate::canonical`] makes it from a policy and prints it.

use motet_syntax::ast::{CompareOp, EndKind};
use motet_syntax::unit::Unit;
use smol_str::SmolStr;

use super::Decimal;

/// A policy.
#[derive(Clone, PartialEq, Debug)]
pub struct Document {
    /// Its name.
    pub name: SmolStr,
    /// The robot of the library; none where it has none.
    pub robot: Option<SmolStr>,
    /// What holds where it is done.
    pub achieves: Option<Condition>,
    /// Its steps, one at least.
    pub steps: Vec<Step>,
}

/// A step.
#[derive(Clone, PartialEq, Debug)]
pub enum Step {
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
        /// The body.
        steps: Vec<Step>,
    },
    /// `{"parallel":[[…],[…]]}`, `parallel { { … } { … } }`
    Parallel(Vec<Vec<Step>>),
    /// `{"end":"done"}`, `done`
    End(End),
}

/// A call of a primitive or a policy.
#[derive(Clone, PartialEq, Debug)]
pub struct Call {
    /// What is called.
    pub name: SmolStr,
    /// The arguments with the names of their parameters, all of them, in order.
    pub args: Vec<(SmolStr, Value)>,
    /// Whether it is a policy, which has no modifiers.
    pub is_policy: bool,
    /// The deadline, in seconds.
    pub within: Option<Decimal>,
    /// The retries.
    pub retry: Option<u32>,
    /// The name of its result; always there where it has one.
    pub bind: Option<SmolStr>,
}

/// A condition that is watched, and what then happens.
#[derive(Clone, PartialEq, Debug)]
pub struct When {
    /// The condition.
    pub condition: Condition,
    /// How long it must hold, in seconds; `null` in JSON where nothing is said.
    pub hold: Option<Decimal>,
    /// What then happens.
    pub reaction: Reaction,
}

/// What a monitor does.
#[derive(Clone, PartialEq, Debug)]
pub enum Reaction {
    /// `{"react":"pause"}`, `pause`, with modifiers with its longest time in seconds.
    Pause(Option<Decimal>),
    /// `{"react":"restart","at_most":3}`, `restart at most 3`
    Restart(u32),
    /// `{"react":"resume","at_most":3,"steps":[…]}`, `resume at most 3 { … }`
    Resume(u32, Vec<Step>),
    /// An ending.
    End(End),
}

/// A handler.
#[derive(Clone, PartialEq, Debug)]
pub struct Catch {
    /// The kinds of failure; `any` where there is none.
    pub on: Vec<SmolStr>,
    /// Its steps; there may be none.
    pub steps: Vec<Step>,
}

/// An ending.
#[derive(Clone, PartialEq, Debug)]
pub struct End {
    /// Which.
    pub kind: EndKind,
    /// The reason: always there but for `done`; a text or a name.
    pub why: Option<Value>,
}

/// A condition.
#[derive(Clone, PartialEq, Debug)]
pub enum Condition {
    /// `{"is":"holding","object":"$mug"}`, `holding(mug)`
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

/// What is compared.
#[derive(Clone, PartialEq, Debug)]
pub enum Subject {
    /// A measure.
    Measure(SmolStr, Vec<(SmolStr, Value)>),
    /// A field of an entity.
    Field(SmolStr, Value),
}

/// How it is compared.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Relation(pub CompareOp);

impl Relation {
    /// Those of numbers.
    pub const ALL: [Self; 6] = [
        Self(CompareOp::Less),
        Self(CompareOp::AtMost),
        Self(CompareOp::Equal),
        Self(CompareOp::More),
        Self(CompareOp::AtLeast),
        Self(CompareOp::Unequal),
    ];
    /// Those of anything else.
    pub const EQUALITY: [Self; 2] = [Self(CompareOp::Equal), Self(CompareOp::Unequal)];

    /// In JSON.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self.0 {
            CompareOp::Equal => "equal",
            CompareOp::Unequal => "unequal",
            CompareOp::Less => "less",
            CompareOp::AtMost => "at_most",
            CompareOp::More => "more",
            CompareOp::AtLeast => "at_least",
        }
    }

    /// In text.
    #[must_use]
    pub fn symbol(self) -> &'static str {
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
    pub fn turned(self) -> Self {
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

/// A value.
#[derive(Clone, PartialEq, Debug)]
pub enum Value {
    /// `"$mug"`, `mug`: what a step has bound.
    Binding(SmolStr),
    /// `"mug_1"`, `mug_1`: an entity or a case.
    Name(SmolStr),
    /// `0.5`, `0.5 m`: a number, in SI units, and the unit of the text form.
    Number(Decimal, Option<Unit>),
    /// `"red mug"`
    Text(SmolStr),
    /// `true`
    Bool(bool),
    /// `any`, of a fluent.
    Any,
    /// `["$a","mug_1"]`, `[a, mug_1]`
    List(Vec<Value>),
}

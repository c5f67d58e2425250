//! The abstract syntax of both surfaces. Every node carries its span.
//!
//! Nothing here is resolved: a name is text, a call may not exist. Invariant: a tree made by a front end is at most
//! [`MAX_NESTING`] blocks and expressions deep, so recursion over it is safe.

mod equal;

pub use equal::same;

use smol_str::SmolStr;

use crate::source::Span;
use crate::unit::Unit;

/// How deep blocks, conditions and brackets may nest in a document of either form.
pub const MAX_NESTING: usize = 64;
/// The largest document, in bytes.
pub const MAX_BYTES: usize = 16 * 1024 * 1024;
/// The most steps that one document may hold.
pub const MAX_STEPS: usize = 100_000;
/// The most words, numbers, texts and marks (in JSON: keys and values) that one document may hold.
pub const MAX_TOKENS: usize = 4_000_000;

/// An identifier where it is written.
#[derive(Clone, Debug)]
pub struct Name {
    /// Its text, without back-quotes or `$`.
    pub text: SmolStr,
    /// Where it stands.
    pub span: Span,
}

/// A file of the text form: declarations in order.
#[derive(Clone, Debug, Default)]
pub struct File {
    /// The declarations.
    pub items: Vec<Item>,
}

impl File {
    /// The policies, in order.
    pub fn policies(&self) -> impl Iterator<Item = &Policy> {
        self.items.iter().filter_map(Item::policy)
    }

    /// The policies without parameters: those that can be run.
    pub fn runnable(&self) -> impl Iterator<Item = &Policy> {
        self.policies().filter(|policy| policy.params.is_empty())
    }
}

/// One declaration.
#[derive(Clone, Debug)]
pub enum Item {
    /// `kind Object: Entity { mass: Mass }`
    Kind(KindDecl),
    /// `fluent holding(object: Object)`
    Fluent(FluentDecl),
    /// `measure distance(to: Entity) -> Length`
    Measure(MeasureDecl),
    /// `failure slipped`
    Failure(FailureDecl),
    /// `enum Approach { auto, top }`
    Enum(EnumDecl),
    /// `action pick(…)` or `perception detect(…)`
    Primitive(PrimitiveDecl),
    /// `policy fetch_mug for hsr { … }`
    Policy(Policy),
    /// `entity block_a, block_b: Object`
    Entities(EntitiesDecl),
    /// `initially on(block_a, block_b), not holding(block_a)`
    Initially(InitiallyDecl),
    /// `closed world`
    ClosedWorld(Span),
}

impl Item {
    /// The policy, where it is one.
    #[must_use]
    pub fn policy(&self) -> Option<&Policy> {
        match self {
            Self::Policy(policy) => Some(policy),
            Self::Kind(_)
            | Self::Fluent(_)
            | Self::Measure(_)
            | Self::Failure(_)
            | Self::Enum(_)
            | Self::Primitive(_)
            | Self::Entities(_)
            | Self::Initially(_)
            | Self::ClosedWorld(_) => None,
        }
    }

    /// The whole declaration.
    #[must_use]
    pub fn span(&self) -> Span {
        match self {
            Self::Kind(decl) => decl.span,
            Self::Fluent(decl) => decl.span,
            Self::Measure(decl) => decl.span,
            Self::Failure(decl) => decl.span,
            Self::Enum(decl) => decl.span,
            Self::Primitive(decl) => decl.span,
            Self::Policy(decl) => decl.span,
            Self::Entities(decl) => decl.span,
            Self::Initially(decl) => decl.span,
            Self::ClosedWorld(span) => *span,
        }
    }
}

/// Text of `///` lines above a declaration, joined by line breaks; empty where there is none.
pub type Doc = SmolStr;

/// `kind Object: Entity { width: Length, mass: Mass }`
#[derive(Clone, Debug)]
pub struct KindDecl {
    /// Its documentation.
    pub doc: Doc,
    /// Its name.
    pub name: Name,
    /// Its parent; only `Entity` has none.
    pub parent: Option<Name>,
    /// Its fields, beside those of its parent.
    pub fields: Vec<Param>,
    /// The whole declaration.
    pub span: Span,
}

/// `fluent holding(object: Object)`
#[derive(Clone, Debug)]
pub struct FluentDecl {
    /// Its documentation.
    pub doc: Doc,
    /// Its name.
    pub name: Name,
    /// Its parameters.
    pub params: Vec<Param>,
    /// The whole declaration.
    pub span: Span,
}

/// `measure distance(to: Entity) -> Length`
#[derive(Clone, Debug)]
pub struct MeasureDecl {
    /// Its documentation.
    pub doc: Doc,
    /// Its name.
    pub name: Name,
    /// Its parameters.
    pub params: Vec<Param>,
    /// What it gives.
    pub result: TypeExpr,
    /// The whole declaration.
    pub span: Span,
}

/// `failure slipped`
#[derive(Clone, Debug)]
pub struct FailureDecl {
    /// Its documentation.
    pub doc: Doc,
    /// Its name.
    pub name: Name,
    /// The whole declaration.
    pub span: Span,
}

/// `enum Approach { auto, top, side, front }`
#[derive(Clone, Debug)]
pub struct EnumDecl {
    /// Its documentation.
    pub doc: Doc,
    /// Its name.
    pub name: Name,
    /// Its cases, at least one.
    pub cases: Vec<Name>,
    /// The whole declaration.
    pub span: Span,
}

/// `entity block_a, block_b: Object`
#[derive(Clone, Debug)]
pub struct EntitiesDecl {
    /// Its documentation.
    pub doc: Doc,
    /// The entities.
    pub names: Vec<Name>,
    /// Their kind.
    pub kind: Name,
    /// The whole declaration.
    pub span: Span,
}

/// `initially on(block_a, block_b), not holding(block_a)`
#[derive(Clone, Debug)]
pub struct InitiallyDecl {
    /// Fluents, each perhaps under one `not`.
    pub facts: Vec<Expr>,
    /// The whole declaration.
    pub span: Span,
}

/// A parameter of a declaration, or a field of a kind.
#[derive(Clone, Debug)]
pub struct Param {
    /// Its name.
    pub name: Name,
    /// Its type.
    pub ty: TypeExpr,
    /// What stands in for a missing argument; never on a field.
    pub default: Option<Expr>,
}

/// A type as written.
#[derive(Clone, Debug)]
pub enum TypeExpr {
    /// `Object`, `Length`, `Text`
    Named(Name),
    /// `List<Object>`
    List(Box<TypeExpr>, Span),
}

impl TypeExpr {
    /// Where it stands.
    #[must_use]
    pub fn span(&self) -> Span {
        match self {
            Self::Named(name) => name.span,
            Self::List(_, span) => *span,
        }
    }
}

/// Whether a primitive acts or perceives.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum PrimitiveForm {
    /// It may change the world.
    Action,
    /// It only looks.
    Perception,
}

/// `action pick(object: Object) needs … makes …`
#[derive(Clone, Debug)]
pub struct PrimitiveDecl {
    /// Its documentation.
    pub doc: Doc,
    /// Action or perception.
    pub form: PrimitiveForm,
    /// Its name.
    pub name: Name,
    /// Its parameters.
    pub params: Vec<Param>,
    /// What it binds.
    pub result: Option<TypeExpr>,
    /// Its contract, in the order written.
    pub clauses: Vec<Clause>,
    /// The whole declaration.
    pub span: Span,
}

/// One clause of a contract.
#[derive(Clone, Debug)]
pub enum Clause {
    /// `needs free(hand), open(c) for each c: Container when in(object, c)`
    Needs(Vec<Quantified>),
    /// `makes holding(object), not on(object, any), clear(s) for each s: Object when on(object, s)`
    Makes(Vec<Quantified>),
    /// `unsettles visible(any)`
    Unsettles(Vec<Quantified>),
    /// `motion reach(object)`
    Motion(Call),
    /// `uses base, arm`
    Uses(Vec<Name>),
    /// `takes 3 s .. 15 s`
    Takes {
        /// Least duration.
        least: Expr,
        /// Greatest duration: the default deadline.
        greatest: Expr,
    },
    /// `fails not_found, slipped`
    Fails(Vec<Name>),
    /// `lasts until base, object`
    Lasts(Vec<Name>),
}

/// One entry of `needs`, `makes` or `unsettles`: `at(x, to) for each x: Object when in(x, c)`. Both tails may be absent.
#[derive(Clone, Debug)]
pub struct Quantified {
    /// In `needs` a condition; in `makes` a fluent, perhaps under one `not`; in `unsettles` a fluent.
    pub expr: Expr,
    /// The quantified variable, `x: Object`: the entry is meant for every entity of that kind.
    pub each: Option<(Name, TypeExpr)>,
    /// The condition under which it is meant; of an effect, evaluated before the effects.
    pub when: Option<Expr>,
}

/// A policy or a sub-policy.
#[derive(Clone, Debug)]
pub struct Policy {
    /// Its documentation.
    pub doc: Doc,
    /// Its name.
    pub name: Name,
    /// Its parameters; a policy that is run has none.
    pub params: Vec<Param>,
    /// The robot that it is written for.
    pub robot: Option<Name>,
    /// The goal that the prover must not find refuted where it is done.
    pub achieves: Option<Expr>,
    /// Its steps.
    pub body: Block,
    /// The whole document in JSON, the declaration in text.
    pub span: Span,
}

/// A list of steps that run one after the other.
#[derive(Clone, Debug, Default)]
pub struct Block {
    /// The steps.
    pub steps: Vec<Step>,
    /// The braces or brackets, with what is between them.
    pub span: Span,
}

/// One step.
#[derive(Clone, Debug)]
pub struct Step {
    /// What it does.
    pub kind: StepKind,
    /// The whole step.
    pub span: Span,
}

/// What a step does.
#[derive(Clone, Debug)]
pub enum StepKind {
    /// `let m = detect("mug") within 2 s retry 1`
    Do(Do),
    /// `sequence tidy { … }`
    Sequence {
        /// The group's name.
        name: Name,
        /// Its steps.
        body: Block,
    },
    /// `if c { … } else { … }`
    If {
        /// The condition.
        condition: Expr,
        /// Steps where it holds.
        then: Block,
        /// Steps where it does not.
        otherwise: Option<Block>,
    },
    /// `wait until c within 60 s`
    Wait {
        /// What is waited for.
        condition: Expr,
        /// The deadline; 60 s where nothing is said.
        within: Option<Expr>,
    },
    /// `monitor { when … } during { … }`
    Monitor {
        /// What is watched, in order; at least one.
        whens: Vec<When>,
        /// What runs meanwhile.
        body: Block,
    },
    /// `try { … } catch slipped { … }`
    Try {
        /// What may fail.
        body: Block,
        /// The handlers, first match wins; at least one.
        catches: Vec<Catch>,
    },
    /// `repeat 3 { … } until c`
    Repeat {
        /// How often at most: a whole number.
        times: Expr,
        /// The body.
        body: Block,
        /// The test after each run.
        until: Option<Expr>,
    },
    /// `each cup in cups at most 5 { … }`
    Each {
        /// The loop's binding.
        item: Name,
        /// The list.
        list: Expr,
        /// The longest list that is taken: a whole number.
        at_most: Expr,
        /// The body.
        body: Block,
    },
    /// `parallel { { … } { … } }`
    Parallel {
        /// The branches; at least one.
        branches: Vec<Block>,
    },
    /// `done`, `fail "why"`, `replan "why"`
    End(End),
}

/// A call of a primitive or of a sub-policy, as a step.
#[derive(Clone, Debug)]
pub struct Do {
    /// The call.
    pub call: Call,
    /// The binding of its result.
    pub bind: Option<Name>,
    /// Its deadline: a duration.
    pub within: Option<Expr>,
    /// How often it is tried again after a failure: a whole number.
    pub retry: Option<Expr>,
}

/// A name applied to arguments: a primitive, a sub-policy, a fluent, a measure or a motion.
#[derive(Clone, Debug)]
pub struct Call {
    /// What is called.
    pub name: Name,
    /// The arguments.
    pub args: Vec<Arg>,
    /// The whole call.
    pub span: Span,
}

/// One argument.
#[derive(Clone, Debug)]
pub struct Arg {
    /// Its parameter, where it is named.
    pub name: Option<Name>,
    /// Its value.
    pub value: Expr,
    /// Name and value.
    pub span: Span,
}

/// `when c for 200 ms then R`
#[derive(Clone, Debug)]
pub struct When {
    /// What is watched for.
    pub condition: Expr,
    /// How long it must hold: a duration.
    pub hold: Option<Expr>,
    /// What then happens.
    pub reaction: Reaction,
    /// All of it.
    pub span: Span,
}

/// What a monitor does when it fires.
#[derive(Clone, Debug)]
pub enum Reaction {
    /// `pause within 60 s`
    Pause {
        /// The longest pause: a duration; 60 s where nothing is said.
        within: Option<Expr>,
        /// The reaction as written.
        span: Span,
    },
    /// `restart at most 3`
    Restart {
        /// How often: a whole number.
        at_most: Expr,
        /// The reaction as written.
        span: Span,
    },
    /// `resume at most 3 { … }`
    Resume {
        /// How often: a whole number.
        at_most: Expr,
        /// What runs in between.
        body: Block,
        /// The reaction as written.
        span: Span,
    },
    /// `done`, `fail "…"`, `replan "…"`
    End(End),
}

/// `catch slipped, blocked { … }`
#[derive(Clone, Debug)]
pub struct Catch {
    /// Which failures.
    pub on: CatchOn,
    /// What then runs.
    pub body: Block,
    /// All of it.
    pub span: Span,
}

/// Which failures a `catch` takes.
#[derive(Clone, Debug)]
pub enum CatchOn {
    /// `any`
    Any(Span),
    /// The named kinds; at least one.
    Kinds(Vec<Name>),
}

/// An ending of the policy.
#[derive(Clone, Debug)]
pub struct End {
    /// Which ending.
    pub kind: EndKind,
    /// The reason: a text; never on `done`.
    pub why: Option<Expr>,
    /// All of it.
    pub span: Span,
}

/// The ways a policy can end by its own word.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum EndKind {
    /// It reached what it was for.
    Done,
    /// It gives up.
    Fail,
    /// It asks for a new policy.
    Replan,
}

/// A condition or a term. One grammar serves both, so that `(a + b) < c` and `(a and b)` need no look-ahead; the
/// check stage tells them apart by their types.
#[derive(Clone, Debug)]
pub struct Expr {
    /// What it is.
    pub kind: ExprKind,
    /// Where it stands, without surrounding parentheses.
    pub span: Span,
}

/// What an expression is.
#[derive(Clone, Debug)]
pub enum ExprKind {
    /// `true`, `false`
    Bool(bool),
    /// `3`, `0.5`: a number without a unit.
    Number(f64),
    /// `20 cm`: a number and its unit as written.
    Quantity(f64, Unit),
    /// `"red mug"`
    Text(SmolStr),
    /// `mug`: a binding, parameter, entity, enumeration case or resource.
    Name(SmolStr),
    /// `"$mug"` in JSON: a binding or parameter and nothing else.
    Binding(SmolStr),
    /// A plain string in JSON: an entity, a case, a quantity or a text, as the type where it stands says.
    Plain(SmolStr),
    /// `any` in an argument position.
    Any,
    /// `[a, b]`
    List(Vec<Expr>),
    /// `holding(mug)`, `distance(user)`
    Call(Call),
    /// `mug.mass`
    Field(Box<Expr>, Name),
    /// `not c`
    Not(Box<Expr>),
    /// `a and b and c`; two or more, or any number in JSON.
    All(Vec<Expr>),
    /// `a or b or c`; two or more, or any number in JSON.
    AnyOf(Vec<Expr>),
    /// `a < b`
    Compare(CompareOp, Box<Expr>, Box<Expr>),
    /// `a + b`
    Arith(ArithOp, Box<Expr>, Box<Expr>),
}

/// A comparison.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum CompareOp {
    /// `==`, JSON `equal`
    Equal,
    /// `!=`, JSON `unequal`
    Unequal,
    /// `<`, JSON `less`
    Less,
    /// `<=`, JSON `at_most`
    AtMost,
    /// `>`, JSON `more`
    More,
    /// `>=`, JSON `at_least`
    AtLeast,
}

/// An arithmetic operation.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum ArithOp {
    /// `+`, JSON `add`
    Add,
    /// `-`, JSON `subtract`
    Subtract,
    /// `*`, JSON `multiply`
    Multiply,
    /// `/`, JSON `divide`
    Divide,
}

//! Wire types of a policy in JSON. From them it is read, written, and described (`motet schema policy`: their
//! doc comments are its descriptions). They are not the AST: [`super::convert`] turns one into the other.
//!
//! A step is an object that has one of the keys `do let sequence if wait monitor try repeat each parallel
//! within keep end`; a condition or a term is a literal or an object that has one of the keys of [`Form`].
//!
//! Beyond the forms of the language page: `more`, `at_least`, `unequal` compare; `add`, `subtract`,
//! `multiply`, `divide` calculate; `true` and `false` are conditions; an array is a list; the plain string
//! `"any"` as an argument of `is` or `get` is `any`; `"on": ["any"]` is `catch any`.

use std::borrow::Cow;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Serialize};
use smol_str::SmolStr;

use super::term::{Args, Awaited, Condition, Count, Do, Duration, Form, Manner, Term};
use super::{Fallible, Spanned};

/// A Motet policy.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "Motet policy", rename = "Policy")]
pub(crate) struct Document {
    /// Version of the format: 1.
    #[schemars(extend("const" = 1))]
    pub(crate) motet: Spanned<u32>,
    /// The policy's name.
    pub(crate) policy: Spanned<SmolStr>,
    /// Type of the result that `done` gives.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) result: Option<Spanned<SmolStr>>,
    /// The robot that it is written for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) robot: Option<Spanned<SmolStr>>,
    /// Condition that holds when the policy is done.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) achieves: Option<Condition>,
    /// Where the robot may not go while the policy runs.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) keep: Option<Keeps>,
    /// Steps of the policy, in order.
    pub(crate) steps: Steps,
    /// Steps that run once, however the policy ends.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) finally: Cleanup,
}

/// Steps that run one after the other.
pub(crate) type Steps = Spanned<Vec<Fallible<Spanned<Step>>>>;

/// Steps that run once, however the step before them is left.
pub(crate) type Cleanup = Option<Box<Steps>>;

// What is large and rare is boxed, here and in `Do`: on its way out of the deserializer a step is moved
// often.
/// One step; its first key names the form.
#[derive(Clone, PartialEq, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
#[schemars(rename = "Step", untagged)]
pub(crate) enum Step {
    /// A call of a primitive or sub-policy.
    Do(Do),
    /// A name for a value.
    Let(Box<Let>),
    /// A named group.
    Sequence(Sequence),
    /// A choice between steps.
    If(Box<If>),
    /// Waiting for a condition.
    Wait(Wait),
    /// Steps that are watched over.
    Monitor(Monitor),
    /// Steps whose failures are handled.
    Try(Try),
    /// A bounded loop.
    Repeat(Box<Repeat>),
    /// A bounded loop over a list.
    Each(Box<Each>),
    /// Steps at the same time.
    Parallel(Parallel),
    /// Steps during which the robot stays away from something.
    Keep(Keep),
    /// An ending of the policy.
    End(End),
    /// Steps that have a deadline.
    Within(Within),
}

/// Gives a value a name. The value is found once, when the step runs.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Let {
    /// The name; `"$name"` stands for the value afterwards.
    pub(crate) r#let: Spanned<SmolStr>,
    /// The value that is named.
    pub(crate) be: Spanned<Term>,
}

/// A named group of steps.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Sequence {
    /// Name of the group.
    pub(crate) sequence: Spanned<SmolStr>,
    /// Steps of the group.
    pub(crate) steps: Steps,
    /// Steps that run once, however the group is left.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) finally: Cleanup,
}

/// Runs `then` if the condition holds and `else` otherwise.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct If {
    /// The condition to test.
    pub(crate) r#if: Condition,
    /// Steps where it holds.
    pub(crate) then: Steps,
    /// Steps where it does not.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) r#else: Option<Steps>,
    /// Steps that run once, however the choice is left.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) finally: Cleanup,
}

/// Blocks until the condition holds, else fails with `timeout`; or for a time, which is a number of seconds
/// or a string with a unit.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Wait {
    /// The condition to test, or a time.
    pub(crate) wait: Awaited,
    /// Of a condition: the deadline; 60 s where nothing is said.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) within: Option<Box<Duration>>,
}

/// Runs `during` while watching every condition.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Monitor {
    /// Watched conditions with their reactions.
    #[schemars(length(min = 1))]
    pub(crate) monitor: Spanned<Vec<Fallible<Spanned<When>>>>,
    /// Steps that run meanwhile.
    pub(crate) during: Steps,
    /// Steps that run once, however the monitor is left. It does not watch them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) finally: Cleanup,
}

/// A watched condition and what happens when it holds.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct When {
    /// The condition to test.
    pub(crate) when: Condition,
    /// Duration for which the condition must hold before the reaction starts.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) r#for: Option<Duration>,
    /// Reaction to the condition.
    pub(crate) then: Spanned<Reaction>,
}

/// Reaction of a monitor; its first key names the form.
#[derive(Clone, PartialEq, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
#[schemars(rename = "Reaction", untagged)]
pub(crate) enum Reaction {
    /// The policy goes on.
    React(React),
    /// The policy ends.
    End(End),
}

/// `pause` holds until the condition is false again; `restart` runs the body again from its start; `resume`
/// runs `steps` and goes on.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct React {
    /// Kind of the reaction.
    pub(crate) react: Spanned<ReactKind>,
    /// Of `pause`: the longest pause; 60 s where nothing is said.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) within: Option<Duration>,
    /// Of `restart` and `resume`: how often.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) at_most: Option<Count>,
    /// Of `resume`: what runs in between.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) steps: Option<Steps>,
}

/// A reaction after which the policy goes on.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(crate) enum ReactKind {
    /// Hold, and go on when the condition is false again.
    Pause,
    /// Run the body again from its start.
    Restart,
    /// Interrupt, run some steps, and go on.
    Resume,
}

/// Runs steps and handles their failures by kind; the first handler that fits.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Try {
    /// Steps that may fail.
    pub(crate) r#try: Steps,
    /// Handlers, tried in order; may be left out beside `finally`.
    #[schemars(length(min = 1))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) catch: Option<Spanned<Vec<Fallible<Spanned<Catch>>>>>,
    /// Steps that run once, however the steps and their handlers are left.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) finally: Cleanup,
}

/// A handler of failures.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Catch {
    /// The kinds of failure, or `["any"]`.
    #[schemars(length(min = 1))]
    pub(crate) on: Spanned<Vec<Spanned<SmolStr>>>,
    /// A name for the failure, in these steps; it has the fields `kind` and `text`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) r#as: Option<Spanned<SmolStr>>,
    /// Steps that handle the failure.
    pub(crate) steps: Steps,
}

/// Runs the steps, then tests; with `until`, not true after the last run is the failure `exhausted`.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Repeat {
    /// Greatest number of runs.
    pub(crate) repeat: Count,
    /// Steps of the loop.
    pub(crate) steps: Steps,
    /// The test after each run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) until: Option<Condition>,
    /// Steps that run once, however the loop is left.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) finally: Cleanup,
}

/// Runs the steps for each element of a list; a longer list is the failure `exhausted`.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Each {
    /// The name that each element is bound to.
    pub(crate) each: Spanned<SmolStr>,
    /// List of the elements.
    pub(crate) r#in: Spanned<Term>,
    /// The longest list that is taken.
    pub(crate) at_most: Count,
    /// Steps of the loop.
    pub(crate) steps: Steps,
    /// Steps that run once, however the loop is left.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) finally: Cleanup,
}

/// Runs all branches at the same time.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Parallel {
    /// The branches, each a list of steps.
    #[schemars(length(min = 1))]
    pub(crate) parallel: Spanned<Vec<Steps>>,
    /// Steps that run once, however the branches are left.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) finally: Cleanup,
}

/// Runs the steps, and interrupts them after a time: the failure `timeout`.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Within {
    /// Time that the steps have.
    pub(crate) within: Duration,
    /// Steps that have this time.
    pub(crate) steps: Steps,
    /// Steps that run once, however the steps are left. They are not in the deadline.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) finally: Cleanup,
}

/// Runs the steps while the robot stays out of zones, or at a distance.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Keep {
    /// Where the robot may not go.
    #[schemars(length(min = 1))]
    pub(crate) keep: Keeps,
    /// Steps that run meanwhile.
    pub(crate) steps: Steps,
    /// Steps that run once, however the steps are left. Nothing is kept during them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) finally: Cleanup,
}

/// Rules of where the robot may not go.
pub(crate) type Keeps = Spanned<Vec<Fallible<Spanned<KeepRule>>>>;

/// Rule of where the robot may not go; its first key names the form.
#[derive(Clone, PartialEq, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(rename = "Rule", untagged)]
pub(crate) enum KeepRule {
    /// A zone that nothing of the robot enters.
    OutOf(OutOf),
    /// A least distance.
    Distance(KeptDistance),
}

/// A zone that nothing of the robot enters.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct OutOf {
    /// Zone to stay out of.
    pub(crate) out_of: Spanned<Term>,
}

/// A least distance between the robot and an entity.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct KeptDistance {
    /// Entity to stay away from.
    pub(crate) distance: Spanned<Term>,
    /// The least distance: in m, or a string with a unit.
    pub(crate) at_least: Spanned<Term>,
}

/// Ends the policy.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct End {
    /// Kind of the ending.
    pub(crate) end: Spanned<EndKind>,
    /// The result, of `done`, in a policy that gives one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) result: Option<Spanned<Term>>,
    /// The reason, of `fail`, `cannot` and `replan`: a text.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) why: Option<Spanned<Term>>,
}

/// The ways a policy can end by its own word.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(crate) enum EndKind {
    /// It reached what it was for.
    Done,
    /// It gives up.
    Fail,
    /// It declines what was asked.
    Cannot,
    /// It asks for a new policy.
    Replan,
}

impl Step {
    /// Gives the step a cleanup; only a step with steps of its own has one.
    pub(crate) fn set_finally(&mut self, steps: Steps) {
        let cleanup = match self {
            Self::Sequence(step) => &mut step.finally,
            Self::If(step) => &mut step.finally,
            Self::Monitor(step) => &mut step.finally,
            Self::Try(step) => &mut step.finally,
            Self::Repeat(step) => &mut step.finally,
            Self::Each(step) => &mut step.finally,
            Self::Parallel(step) => &mut step.finally,
            Self::Within(step) => &mut step.finally,
            Self::Keep(step) => &mut step.finally,
            Self::Do(_) | Self::Let(_) | Self::Wait(_) | Self::End(_) => return,
        };
        *cleanup = Some(Box::new(steps));
    }
}

impl Serialize for Step {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Do(step) => step.serialize(serializer),
            Self::Let(step) => step.serialize(serializer),
            Self::Sequence(step) => step.serialize(serializer),
            Self::If(step) => step.serialize(serializer),
            Self::Wait(step) => step.serialize(serializer),
            Self::Monitor(step) => step.serialize(serializer),
            Self::Try(step) => step.serialize(serializer),
            Self::Repeat(step) => step.serialize(serializer),
            Self::Each(step) => step.serialize(serializer),
            Self::Parallel(step) => step.serialize(serializer),
            Self::Within(step) => step.serialize(serializer),
            Self::Keep(step) => step.serialize(serializer),
            Self::End(step) => step.serialize(serializer),
        }
    }
}

impl Serialize for KeepRule {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::OutOf(kept) => kept.serialize(serializer),
            Self::Distance(kept) => kept.serialize(serializer),
        }
    }
}

impl Serialize for Reaction {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::React(react) => react.serialize(serializer),
            Self::End(end) => end.serialize(serializer),
        }
    }
}

impl JsonSchema for Term {
    fn schema_name() -> Cow<'static, str> {
        "Term".into()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "A literal, a binding `\"$x\"`, or an object that says how the value is found.",
            "anyOf": [
                {"type": "string"},
                {"type": "number"},
                {"type": "boolean"},
                {"type": "array", "items": generator.subschema_for::<Term>()},
                generator.subschema_for::<Form>(),
            ],
        })
    }
}

impl JsonSchema for Args {
    fn schema_name() -> Cow<'static, str> {
        "Arguments".into()
    }
    fn inline_schema() -> bool {
        true
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        json_schema!({"type": "object", "additionalProperties": generator.subschema_for::<Term>()})
    }
}

impl JsonSchema for Condition {
    fn schema_name() -> Cow<'static, str> {
        "Condition".into()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "A condition: an object, `true`, `false`, or a string in the text form.",
            "anyOf": [{"type": "string"}, {"type": "boolean"}, generator.subschema_for::<Form>()],
        })
    }
}

impl JsonSchema for Awaited {
    fn schema_name() -> Cow<'static, str> {
        "Awaited".into()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "A condition, or a time: seconds, or a string with a unit such as `\"5 s\"`.",
            "anyOf": [
                {"type": "number"},
                {"type": "string"},
                {"type": "boolean"},
                generator.subschema_for::<Form>(),
            ],
        })
    }
}

impl JsonSchema for Duration {
    fn schema_name() -> Cow<'static, str> {
        "Duration".into()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "A duration: seconds, a string with a unit such as `\"200 ms\"`, or a binding.",
            "anyOf": [{"type": "number"}, {"type": "string"}, generator.subschema_for::<Form>()],
        })
    }
}

impl JsonSchema for Manner {
    fn schema_name() -> Cow<'static, str> {
        "Manner".into()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "How a call moves: `\"slowly\"`, `\"gently\"`, or a part of the robot's speed and \
                            acceleration, such as `\"30 %\"` or `0.3`.",
            "anyOf": [
                {"type": "string"},
                {"type": "number"},
                generator.subschema_for::<Form>(),
            ],
        })
    }
}

impl JsonSchema for Count {
    fn schema_name() -> Cow<'static, str> {
        "Count".into()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "A whole number, or a binding.",
            "anyOf": [{"type": "integer"}, {"type": "string"}, generator.subschema_for::<Form>()],
        })
    }
}

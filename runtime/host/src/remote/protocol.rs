//! Messages of the driver protocol. Values, queries, commands and outcomes have the JSON form of
//! `motet-runtime`.

mod sight;

pub(crate) use sight::heard;
pub use sight::{Camera, DepthMap, DetectedThing, Detections, LookParams, LookResult, MovedParams, PngImage};

use motet_graph::Graph;
use motet_runtime::{
    Answer, Capabilities, Command, FailureReport, GoalId, Heard, Outcome, Query, Time, ToldThing,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};
use smol_str::SmolStr;
use std::sync::Arc;
use std::time::Duration;

/// The version of the protocol.
pub const VERSION: u32 = 2;
/// The error code of a start that is refused; its data names the failure kind.
pub const REFUSED: i64 = 1;

/// Calls of the host. Each is a JSON-RPC request with its own number and is answered, except `bye`. If the
/// driver owns the clock, the parameters of each call but `bye` also have `at`, the seconds of the run;
/// `hello` always has it.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "method", content = "params", rename_all = "snake_case")]
pub enum DriverCall {
    /// The greeting, first on every connection. Answered by [`Welcome`].
    Hello(Hello),
    /// Start a goal. Answered by `{}`: it is accepted and runs; or by the error 1: it is refused. Of a goal
    /// that was started before the same answer is given again, and nothing else is done.
    Start(StartParams),
    /// Give a running goal new arguments. Answered by `{}`.
    Update(StartParams),
    /// End a goal early. Answered by `{}`: heard; the goal's end is said by `ended`. Of a goal that has ended
    /// it is ignored.
    Cancel(GoalParams),
    /// Keep a goal still. Answered by `{}`, or by any error: it cannot be held.
    Hold(GoalParams),
    /// Let a held goal go on. Answered by `{}`.
    Proceed(GoalParams),
    /// Bring everything that a goal uses to a safe stop, also of a goal that has ended or was never heard of.
    /// Answered by `{}`: heard; that everything stands still is said by `stopped`.
    SafeStop(GoalParams),
    /// Answer a question once. Answered by [`QueryResult`].
    Observe(QueryParams),
    /// Answer a question, and say `observed` whenever the answer changes. Answered by [`QueryResult`].
    Watch(QueryParams),
    /// No longer watch. Answered by `{}`.
    Unwatch(QueryParams),
    /// Let time pass until the first report, but not beyond `until`. Only for a driver that owns the clock.
    /// Answered by [`AdvanceResult`], after the reports.
    Advance(AdvanceParams),
    /// Take a picture. Only for a driver that says it can. Answered by [`LookResult`], or by any error.
    Look(LookParams),
    /// Say what is in view. Only for a driver that says it can. Answered by [`Detections`].
    Detections(EmptyParams),
    /// Take in where a thing is. Only for a driver that says it can. Answered by `{}`.
    Told(ToldParams),
    /// Answer a question by the truth of a simulated world, whatever the robot knows of it. Only judges ask.
    /// Answered by [`QueryResult`], or by any error: the driver knows no more than the robot.
    Truth(QueryParams),
    /// Asks for the state of some goals after a crash. Answered by [`StatusResult`].
    Status(StatusParams),
    /// A sign of life is asked for. Answered by `{}`.
    Ping(EmptyParams),
    /// The host goes. Not answered. Whatever still moves comes to a safe stop.
    Bye(EmptyParams),
}

/// Notification from a driver.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "method", content = "params", rename_all = "snake_case")]
pub enum DriverReport {
    /// A goal has ended and uses none of its resources any longer. Said once.
    Ended(EndedParams),
    /// A goal that was told to hold cannot be held.
    NotHeld(GoalParams),
    /// Everything that a goal used stands still: the answer to `safe_stop`.
    Stopped(GoalParams),
    /// The driver does not know what became of a goal.
    Lost(GoalParams),
    /// The answer to a watched question has changed, or something was noticed in passing.
    Observed(ObservedParams),
    /// Progress of a goal for people; without effect on the run.
    Feedback(FeedbackParams),
    /// Telemetry: where the robot and the things are. No event of the run.
    Moved(MovedParams),
    /// The driver saw something new.
    Detected(Detections),
    /// A person said something that nobody had asked for.
    Heard(Heard),
}

impl DriverReport {
    /// True if it tells of the goals and questions of one run, and means nothing in another.
    pub(crate) const fn is_of_a_run(&self) -> bool {
        match self {
            Self::Ended(_) | Self::NotHeld(_) | Self::Stopped(_) | Self::Lost(_) => true,
            Self::Observed(_) | Self::Feedback(_) => true,
            Self::Moved(_) | Self::Detected(_) | Self::Heard(_) => false,
        }
    }
}

/// Parameters of `hello`, the greeting.
#[derive(Clone, PartialEq, Debug, Default, Serialize, Deserialize, JsonSchema)]
pub struct Hello {
    /// The version of the protocol that the host speaks.
    pub protocol: u32,
    /// Id of the run, the same after a resume and on every connection. A driver that hears another one than
    /// its last stops what moves and forgets the goals and watches of that one.
    pub run: String,
    /// True if the host goes on with a run that it began before.
    pub resumed: bool,
    /// The robot that the policy is for.
    pub robot: String,
    pub policy: String,
    /// The primitives that it calls.
    pub primitives: Vec<CalledPrimitive>,
    /// Facts at the start, besides those of the scene. Only for a driver that says it takes them, or to find
    /// out.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub state: Vec<StateFact>,
}

/// A fact at the start.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
pub struct StateFact {
    pub query: Query,
    pub holds: bool,
    /// Value of a field, as of `grip`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value: Option<motet_graph::Value>,
}

/// A primitive that a policy calls.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
pub struct CalledPrimitive {
    pub name: String,
    /// The type of its result as the language writes it, such as `Object`, `Text` or `List<Object>`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub result: Option<String>,
    /// The failures in which it may end, besides `timeout`.
    #[serde(default)]
    pub fails: Vec<SmolStr>,
}

/// The answer to the greeting.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
pub struct Welcome {
    /// The version of the protocol that the driver speaks: the same.
    pub protocol: u32,
    /// The driver's name and version, for people.
    pub driver: String,
    /// A text that is another one after every start of the driver: what it knows of goals, it knows since
    /// then.
    pub instance: String,
    /// Abilities; each has a default, and unknown ones are ignored.
    #[serde(default)]
    pub capabilities: Capabilities,
}

/// Time of a call, among its parameters.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
pub struct CallTime {
    /// Seconds of the run.
    pub at: f64,
}

/// Parameters of `advance`.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
pub struct AdvanceParams {
    /// Seconds of the run, at most half a second later than now.
    pub until: f64,
}

/// The answer to `advance`.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
pub struct AdvanceResult {
    /// Seconds of the run: the time of the reports that came before this answer, or `until`.
    pub now: f64,
}

/// A goal with what it does.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
pub struct StartParams {
    /// Its number, which the host chooses and never uses twice in a run.
    pub goal: GoalId,
    pub command: Arc<Command>,
}

/// Parameters of calls about one goal.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
pub struct GoalParams {
    pub goal: GoalId,
}

/// Parameters of `status`.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
pub struct StatusParams {
    pub goals: Vec<GoalId>,
}

/// Parameters of `observe`, `watch`, `unwatch` and `truth`.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
pub struct QueryParams {
    pub query: Query,
}

impl From<&motet_runtime::Query> for QueryParams {
    fn from(query: &motet_runtime::Query) -> Self {
        Self { query: query.clone() }
    }
}

/// Parameters of `told`.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
pub struct ToldParams {
    pub thing: ToldThing,
}

/// The answer to a question.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
pub struct QueryResult {
    pub answer: Answer,
}

/// Result of `status`.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
pub struct StatusResult {
    /// Of each that was asked for.
    pub goals: Vec<GoalState>,
}

/// State of a goal, by its number.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
pub struct GoalState {
    pub goal: GoalId,
    pub state: GoalStatus,
}

/// State of a goal as the driver knows it.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum GoalStatus {
    /// The driver has never heard of it.
    Unknown,
    /// It runs, held or not.
    Running,
    /// It was refused, in this failure.
    Refused(FailureReport),
    /// It has ended.
    Ended(Outcome),
    /// It was stopped safely.
    Stopped,
}

/// The end of a goal.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
pub struct EndedParams {
    pub goal: GoalId,
    pub outcome: Outcome,
}

/// Something that was observed.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
pub struct ObservedParams {
    pub query: Query,
    pub answer: Answer,
}

/// Parameters of `feedback`.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
pub struct FeedbackParams {
    pub goal: GoalId,
    pub text: String,
    /// Set where the driver planned a motion itself and does not follow the witness of the command.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub own_motion: bool,
}

/// Empty parameters or an empty result.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize, JsonSchema)]
pub struct EmptyParams {}

/// Data of the error of a refused start.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
pub struct RefusedData {
    /// The failure in which the goal ends.
    pub failure: FailureReport,
}

/// A message from a driver.
#[derive(Clone, PartialEq, Debug)]
pub enum DriverMessage {
    /// The answer to the call of a number.
    Answer(u64, Result<Value, RpcError>),
    Report(DriverReport),
}

/// The error that a call was answered with.
#[derive(Clone, PartialEq, Debug, Deserialize, JsonSchema)]
pub struct RpcError {
    /// 1 for a refused start; else as JSON-RPC has it.
    pub code: i64,
    pub message: String,
    /// More, such as [`RefusedData`].
    #[serde(default)]
    pub data: Value,
}

/// The line of a call, without a line feed. `at` is the time of the run, for a driver that owns the clock.
///
/// ```
/// use motet_host::remote::protocol::{DriverCall, GoalParams, say};
/// use motet_runtime::GoalId;
///
/// let line = say(3, &DriverCall::Cancel(GoalParams { goal: GoalId::from_number(7) }), None);
/// assert_eq!(line, r#"{"jsonrpc":"2.0","id":3,"method":"cancel","params":{"goal":7}}"#);
/// ```
#[must_use]
pub fn say(id: u64, call: &DriverCall, at: Option<Time>) -> String {
    let mut message = Map::new();
    message.insert("jsonrpc".to_owned(), json!("2.0"));
    if !matches!(call, DriverCall::Bye(_)) {
        message.insert("id".to_owned(), json!(id));
    }
    // These types are written as maps, and writing them does not fail.
    if let Ok(Value::Object(mut call)) = serde_json::to_value(call) {
        if let Some((at, params)) = at.zip(call.get_mut("params").and_then(Value::as_object_mut)) {
            let time = serde_json::to_value(CallTime { at: at.secs() });
            params.extend(time.ok().and_then(|time| time.as_object().cloned()).into_iter().flatten());
        }
        message.extend(call);
    }
    Value::Object(message).to_string()
}

/// Parses a line from a driver.
///
/// ```
/// use motet_host::remote::protocol::{DriverMessage, hear};
///
/// let message = hear(r#"{"jsonrpc": "2.0", "id": 3, "result": {}}"#)?;
/// assert!(matches!(message, DriverMessage::Answer(3, Ok(_))));
/// assert!(hear("ready!").is_err());
/// # Ok::<(), String>(())
/// ```
///
/// # Errors
///
/// Why it is no message of this protocol.
pub fn hear(line: &str) -> Result<DriverMessage, String> {
    let message: Value = serde_json::from_str(line).map_err(|error| format!("it is not JSON: {error}"))?;
    if depth(&message) > MAX_DEPTH {
        return Err(format!("it is nested more than {MAX_DEPTH} deep"));
    }
    let Value::Object(mut message) = message else { return Err("it is no JSON object".to_owned()) };
    if message.remove("jsonrpc") != Some(json!("2.0")) {
        return Err("it does not say `\"jsonrpc\": \"2.0\"`".to_owned());
    }
    if message.contains_key("method") {
        if message.contains_key("id") {
            return Err("the host takes no requests".to_owned());
        }
        let report = serde_json::from_value(Value::Object(message));
        return report.map(DriverMessage::Report).map_err(|error| format!("it is no report: {error}"));
    }
    let id = message.get("id").and_then(Value::as_u64).ok_or("it has neither a method nor a number")?;
    match (message.remove("result"), message.remove("error")) {
        (Some(result), None) => Ok(DriverMessage::Answer(id, Ok(result))),
        (None, Some(error)) => serde_json::from_value(error)
            .map(|wrong| DriverMessage::Answer(id, Err(wrong)))
            .map_err(|error| format!("its error is none: {error}")),
        (Some(_), Some(_)) => Err("it has both a result and an error".to_owned()),
        (None, None) => Err("it has neither a result nor an error".to_owned()),
    }
}

/// Nesting depth of a message. A parsed one is not nested deeper than the parser goes.
fn depth(value: &Value) -> usize {
    match value {
        Value::Array(values) => 1 + values.iter().map(depth).max().unwrap_or(0),
        Value::Object(fields) => 1 + fields.values().map(depth).max().unwrap_or(0),
        Value::Null | Value::Bool(_) | Value::Number(_) | Value::String(_) => 0,
    }
}

/// All that is said, for a schema: each kind of message by name.
#[derive(JsonSchema)]
#[schemars(title = "Motet driver protocol, version 2")]
#[allow(dead_code, reason = "only its schema is used")]
struct ProtocolSchema {
    /// Calls of the host: with `jsonrpc` and, but for `bye`, `id` beside it.
    call: DriverCall,
    /// Beside the parameters of `hello`, and of all calls but `bye` to a driver that owns the clock.
    call_time: CallTime,
    /// Notification from a driver: with `jsonrpc` beside it.
    report: DriverReport,
    /// The result of `hello`.
    hello_result: Welcome,
    /// The result of `observe`, `watch` and `truth`.
    observe_result: QueryResult,
    /// The result of `status`.
    status_result: StatusResult,
    /// The result of `advance`.
    advance_result: AdvanceResult,
    /// The result of `look`.
    look_result: LookResult,
    /// The result of `detections`.
    detections_result: Detections,
    /// The result of every other call.
    other_result: EmptyParams,
    /// The data of error 1, with which `start` is refused.
    refused_data: RefusedData,
}

/// The JSON Schema of the protocol.
#[must_use]
pub fn schema() -> schemars::Schema {
    schemars::schema_for!(ProtocolSchema)
}

impl Hello {
    /// The greeting before a graph is run, in a run of this id.
    #[must_use]
    pub fn of(graph: &Graph, run: &str) -> Self {
        let fails = |primitive: &motet_graph::Primitive| {
            primitive.fails.iter().filter_map(|id| graph.failures.get(id.index()).cloned()).collect()
        };
        let primitive = |primitive: &motet_graph::Primitive| CalledPrimitive {
            name: primitive.name.to_string(),
            result: primitive.result.as_ref().map(|ty| graph.type_name(ty)),
            fails: fails(primitive),
        };
        Self {
            protocol: VERSION,
            run: run.to_owned(),
            resumed: false,
            robot: graph.robot.to_string(),
            policy: graph.policy.to_string(),
            primitives: graph.primitives.iter().map(primitive).collect(),
            state: Vec::new(),
        }
    }
}

/// The longest line in bytes that a driver may say.
pub(crate) const MAX_LINE_BYTES: usize = 1024 * 1024;
/// The longest line in bytes while an answer to `look` is due.
pub(crate) const MAX_LOOK_BYTES: usize = 16 * 1024 * 1024;
/// The longest step of time that a driver with its own clock is asked for.
pub(crate) const PIECE: Time = Time::from_nanos(500_000_000);
/// The longest failure kind in bytes that a driver may name. Another one, or one that is no name, counts as
/// `failed`.
pub(crate) const MAX_KIND_BYTES: usize = 64;
/// The most lines that a driver may say in a second of the wall clock. One that says more counts as gone:
/// what is important would come too late.
pub(crate) const MAX_LINES_A_SECOND: u32 = 20_000;
/// The longest part in bytes of a line of a driver's standard error that is passed on at once.
pub(crate) const MAX_ERROR_LINE_BYTES: u64 = 4096;
/// The most lines of a driver's standard error in a second of the wall clock that are passed on.
pub(crate) const MAX_ERROR_LINES_A_SECOND: u32 = 1_000;
/// Number of the last of its lines that are passed on though there were more.
pub(crate) const MAX_LAST_LINES: usize = 40;
/// The most feedback of a driver in a second of the wall clock that is shown and recorded.
pub(crate) const MAX_FEEDBACK_A_SECOND: u32 = 200;
/// The most facts that a driver may report in a second of the wall clock without being asked to watch them.
/// One that reports more counts as gone: a fact that was dropped would be believed as it was before.
pub(crate) const MAX_FACTS_A_SECOND: u32 = 2_000;
/// The most things that a driver may report as `detected` in a second of the wall clock. One that reports
/// more counts as gone: to take all of them into the scene would hold the run up.
pub(crate) const MAX_DETECTIONS_A_SECOND: u32 = 5_000;
/// The longest line in bytes that tells a fact which is not watched. A driver that says a longer one counts
/// as gone: such facts are kept until the run ends.
pub(crate) const MAX_FACT_BYTES: usize = 4_096;
/// The most bytes of reports in a second of the wall clock. A driver that says more counts as gone: what is
/// important would come too late.
pub(crate) const MAX_REPORT_BYTES_A_SECOND: u32 = 32 * 1024 * 1024;
/// The most joints and things that a driver may tell of by `moved` in a run. Others are dropped.
pub(crate) const MAX_MOVED_NAMES: usize = 10_000;
/// The most promises that a driver may break in a run before it counts as gone.
pub(crate) const MAX_BREACHES: u32 = 1_000;
/// The most lines that wait to be heard, and the most that wait to be said.
pub(crate) const MAX_WAITING: usize = 1_024;

/// The most reports of a driver between a call and its answer.
pub(crate) const MAX_BEFORE_ANSWER: usize = 16 * MAX_WAITING;
/// Greatest nesting depth of a driver's message, so that a journal with it can be read again.
pub(crate) const MAX_DEPTH: usize = 32;
/// The most characters of a feedback that are kept.
pub(crate) const MAX_FEEDBACK: usize = 1_000;
/// Number of times a start is said before its goal counts as lost.
pub(crate) const SAYINGS: u32 = 2;

/// Time limits for a driver in another process.
///
/// ```
/// use motet_host::remote::DriverTimeouts;
/// use std::time::Duration;
///
/// let patient = DriverTimeouts { silence: Duration::from_secs(20), ..DriverTimeouts::default() };
/// assert!(patient.recovery() > DriverTimeouts::default().recovery());
/// ```
#[derive(Clone, Copy, Debug)]
pub struct DriverTimeouts {
    /// To answer the greeting after it was started or called.
    pub greeting: Duration,
    /// To answer a command. It is an answer to have heard it; what it does may take as long as it takes.
    pub answer: Duration,
    /// To answer a call of a driver that owns the clock: time stands still meanwhile.
    pub step: Duration,
    /// Silence of either side after which the host asks for a sign of life.
    pub heartbeat: Duration,
    /// Silence of the driver after which it counts as lost.
    pub silence: Duration,
    /// Number of times it is started or called again after it was gone.
    pub restarts: u32,
    /// Time limit for a process to stop all motion and to end after `bye`. Then it is killed.
    pub farewell: Duration,
    /// True once no answer and no report is waited for any more. It is asked every 50 ms.
    pub is_over: fn() -> bool,
}

impl Default for DriverTimeouts {
    /// 10 s for the greeting, 2 s for an answer, a sign of life every second and at least every 5 s, 3
    /// restarts, 5 s to end. A driver that owns the clock may take 30 s for an answer.
    fn default() -> Self {
        Self {
            greeting: Duration::from_secs(10),
            answer: Duration::from_secs(2),
            step: Duration::from_secs(30),
            heartbeat: Duration::from_secs(1),
            silence: Duration::from_secs(5),
            restarts: 3,
            farewell: Duration::from_secs(5),
            is_over: || false,
        }
    }
}

impl DriverTimeouts {
    /// The longest that it takes until a driver that went silent is noticed, called again, greeted and told:
    /// how long a safe stop has to be waited for at least.
    #[must_use]
    pub const fn recovery(&self) -> Duration {
        self.silence.saturating_add(self.greeting).saturating_add(self.answer)
    }
}

//! The tools: names, descriptions, arguments and annotations. None of them moves a joint.

use rmcp::handler::server::common::schema_for_type;
use rmcp::model::{JsonObject, Tool, ToolAnnotations};
use schemars::JsonSchema;
use serde::Deserialize;
use serde::de::DeserializeOwned;

use super::answer::Refusal;

/// Robot and scene of a call.
#[derive(Deserialize, JsonSchema, Debug, Default)]
#[serde(deny_unknown_fields)]
pub(super) struct SituationArgs {
    /// Built-in robot, see `robots`; by default the robot of this server
    pub(super) robot: Option<String>,
    /// Built-in scene, see `robots`; by default the scene of this server
    pub(super) scene: Option<String>,
}

/// Arguments of a tool that takes none.
#[derive(Deserialize, JsonSchema, Debug)]
#[serde(deny_unknown_fields)]
pub(super) struct NoArgs {}

/// Arguments of `primitives`.
#[derive(Deserialize, JsonSchema, Debug)]
#[serde(deny_unknown_fields)]
pub(super) struct PrimitivesArgs {
    /// Built-in robot; by default the robot of this server
    pub(super) robot: Option<String>,
    /// Primitive to show; by default all
    pub(super) name: Option<String>,
}

/// Arguments of `check_policy`.
#[derive(Deserialize, JsonSchema, Debug)]
#[serde(deny_unknown_fields)]
pub(super) struct CheckArgs {
    /// Policy in the text or the JSON syntax of Motet
    pub(super) policy: String,
    /// Built-in robot; by default the robot of this server
    pub(super) robot: Option<String>,
    /// Built-in scene; by default the scene of this server
    pub(super) scene: Option<String>,
}

/// Arguments of `explain`.
#[derive(Deserialize, JsonSchema, Debug)]
#[serde(deny_unknown_fields)]
pub(super) struct ExplainArgs {
    /// Code of a finding, such as M0501
    pub(super) code: String,
}

/// Arguments of `feasible`.
#[derive(Deserialize, JsonSchema, Debug)]
#[serde(deny_unknown_fields)]
pub(super) struct FeasibleArgs {
    /// Motions such as `reach(mug_1)`, `go_to(shelf)`, `put(mug_1, shelf)`, `pull(fridge_1)`; by default all
    /// of the scene
    #[serde(default)]
    pub(super) motions: Vec<String>,
    /// Built-in robot; by default the robot of this server
    pub(super) robot: Option<String>,
    /// Built-in scene; by default the scene of this server
    pub(super) scene: Option<String>,
}

/// Arguments of `plan`.
#[derive(Deserialize, JsonSchema, Debug)]
#[serde(deny_unknown_fields)]
pub(super) struct PlanArgs {
    /// Request in plain English, such as `bring me the red mug`
    pub(super) request: Option<String>,
    /// Conditions to reach one after the other, such as `on(mug_1, shelf)`, in place of a request
    #[serde(default)]
    pub(super) goals: Vec<String>,
    /// Built-in robot; by default the robot of this server
    pub(super) robot: Option<String>,
    /// Built-in scene; by default the scene of this server
    pub(super) scene: Option<String>,
}

/// Arguments of `simulate_policy`.
#[derive(Deserialize, JsonSchema, Debug)]
#[serde(deny_unknown_fields)]
pub(super) struct SimulateArgs {
    /// Policy in the text or the JSON syntax of Motet
    pub(super) policy: String,
    /// Seed of all randomness: the same seed gives the same run
    #[serde(default)]
    pub(super) seed: u64,
    /// Errors that the world makes by itself: `ideal`, `typical` or `harsh`; by default `typical`
    pub(super) profile: Option<String>,
    /// Answers of the simulated person to the questions of the policy, in order
    #[serde(default)]
    pub(super) answers: Vec<String>,
    /// Built-in robot; by default the robot of this server
    pub(super) robot: Option<String>,
    /// Built-in scene; by default the scene of this server
    pub(super) scene: Option<String>,
}

/// Arguments of `run_policy`.
#[derive(Deserialize, JsonSchema, Debug)]
#[serde(deny_unknown_fields)]
pub(super) struct RunArgs {
    /// Policy in the text or the JSON syntax of Motet
    pub(super) policy: String,
    /// Seconds to wait for the end of the run or a question, 0 to 50; by default 20. The run goes on after
    /// them. A client with the tasks extension gets a task at once.
    pub(super) wait_secs: Option<u32>,
}

/// Arguments of `swap_policy`.
#[derive(Deserialize, JsonSchema, Debug)]
#[serde(deny_unknown_fields)]
pub(super) struct SwapArgs {
    /// Policy that takes over, in the text or the JSON syntax of Motet
    pub(super) policy: String,
    /// Id of the run; by default the one that goes on
    pub(super) run: Option<String>,
}

/// Arguments of `stop`.
#[derive(Deserialize, JsonSchema, Debug)]
#[serde(deny_unknown_fields)]
pub(super) struct StopArgs {
    /// Id of the run; by default the one that goes on
    pub(super) run: Option<String>,
}

/// Arguments of `run_status`.
#[derive(Deserialize, JsonSchema, Debug)]
#[serde(deny_unknown_fields)]
pub(super) struct StatusArgs {
    /// Id of the run; by default the latest one
    pub(super) run: Option<String>,
    /// Seconds to wait for the end of the run or a question, 0 to 50; by default 0
    pub(super) wait_secs: Option<u32>,
}

/// Arguments of `answer_question`.
#[derive(Deserialize, JsonSchema, Debug)]
#[serde(deny_unknown_fields)]
pub(super) struct AnswerArgs {
    /// Id of the run that asks
    pub(super) run: String,
    /// Answer: one of the options, or any text where there are none; leave it out to decline
    pub(super) answer: Option<String>,
}

/// Tool that the server offers.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum ToolName {
    Robots,
    Scene,
    Primitives,
    CheckPolicy,
    Explain,
    Feasible,
    Plan,
    SimulatePolicy,
    RunPolicy,
    SwapPolicy,
    Stop,
    RunStatus,
    AnswerQuestion,
}

impl ToolName {
    /// All tools. The last five are for a server with a driver.
    const ALL: [Self; 13] = [
        Self::Robots,
        Self::Scene,
        Self::Primitives,
        Self::CheckPolicy,
        Self::Explain,
        Self::Feasible,
        Self::Plan,
        Self::SimulatePolicy,
        Self::RunPolicy,
        Self::SwapPolicy,
        Self::Stop,
        Self::RunStatus,
        Self::AnswerQuestion,
    ];

    /// Finds a tool by its name.
    pub(super) fn find(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|tool| tool.name() == name)
    }

    const fn name(self) -> &'static str {
        match self {
            Self::Robots => "robots",
            Self::Scene => "scene",
            Self::Primitives => "primitives",
            Self::CheckPolicy => "check_policy",
            Self::Explain => "explain",
            Self::Feasible => "feasible",
            Self::Plan => "plan",
            Self::SimulatePolicy => "simulate_policy",
            Self::RunPolicy => "run_policy",
            Self::SwapPolicy => "swap_policy",
            Self::Stop => "stop",
            Self::RunStatus => "run_status",
            Self::AnswerQuestion => "answer_question",
        }
    }

    /// True for a tool that needs the driver.
    pub(super) const fn needs_driver(self) -> bool {
        use ToolName::{AnswerQuestion, RunPolicy, RunStatus, Stop, SwapPolicy};
        matches!(self, RunPolicy | SwapPolicy | Stop | RunStatus | AnswerQuestion)
    }

    const fn description(self) -> &'static str {
        match self {
            Self::Robots => {
                "Lists the built-in robots and scenes, names the robot of this server, and says if it can \
                 run policies."
            }
            Self::Scene => "Lists the entities of the scene with their places, and the facts that hold now.",
            Self::Primitives => {
                "Shows what a robot can do: each primitive with its parameters, needs, effects and failures."
            }
            Self::CheckPolicy => {
                "Checks a policy before anything moves: names, types, limits, needs and motions. Returns the \
                 findings, what is left to the run, and a fixed policy where safe fixes are known."
            }
            Self::Explain => "Explains the code of a finding, with an example and its correction.",
            Self::Feasible => {
                "Decides which motions are feasible, with the reason where one is not, and draws the scene \
                 from above (SVG)."
            }
            Self::Plan => {
                "Plans a policy for a request in English or for conditions, without a model. The policy \
                 passes the check."
            }
            Self::SimulatePolicy => {
                "Checks a policy and runs it in a simulation in virtual time. The robot of this server does \
                 not move."
            }
            Self::RunPolicy => {
                "Runs a policy on the robot. It is checked in the present state first, and refused with \
                 findings unless it has no error. One run at a time."
            }
            Self::SwapPolicy => {
                "Replaces the policy of the run that goes on by another one, which is checked in the state \
                 of this moment. If it is refused, the one before goes on."
            }
            Self::Stop => "Stops the run safely, and waits until the robot stands still.",
            Self::RunStatus => "Shows a run: its status, events, the open question, and how it ended.",
            Self::AnswerQuestion => "Answers the open question of a run, or declines to.",
        }
    }

    fn annotations(self) -> ToolAnnotations {
        let (reads_only, is_destructive, is_idempotent) = match self {
            Self::RunPolicy | Self::SwapPolicy => (false, true, false),
            Self::Stop => (false, false, true),
            Self::AnswerQuestion => (false, false, false),
            Self::Robots
            | Self::Scene
            | Self::Primitives
            | Self::CheckPolicy
            | Self::Explain
            | Self::Feasible
            | Self::Plan
            | Self::SimulatePolicy
            | Self::RunStatus => (true, false, true),
        };
        let title = self.name().replace('_', " ");
        let moves = matches!(self, Self::RunPolicy | Self::SwapPolicy);
        ToolAnnotations::from_raw(
            Some(title),
            Some(reads_only),
            Some(is_destructive),
            Some(is_idempotent),
            // A robot acts in the world of people.
            Some(moves),
        )
    }

    fn schema(self) -> std::sync::Arc<JsonObject> {
        match self {
            Self::Robots => schema_for_type::<NoArgs>(),
            Self::Scene => schema_for_type::<SituationArgs>(),
            Self::Primitives => schema_for_type::<PrimitivesArgs>(),
            Self::CheckPolicy => schema_for_type::<CheckArgs>(),
            Self::Explain => schema_for_type::<ExplainArgs>(),
            Self::Feasible => schema_for_type::<FeasibleArgs>(),
            Self::Plan => schema_for_type::<PlanArgs>(),
            Self::SimulatePolicy => schema_for_type::<SimulateArgs>(),
            Self::RunPolicy => schema_for_type::<RunArgs>(),
            Self::SwapPolicy => schema_for_type::<SwapArgs>(),
            Self::Stop => schema_for_type::<StopArgs>(),
            Self::RunStatus => schema_for_type::<StatusArgs>(),
            Self::AnswerQuestion => schema_for_type::<AnswerArgs>(),
        }
    }

    fn tool(self) -> Tool {
        let mut tool = Tool::new(self.name(), self.description(), self.schema());
        tool.annotations = Some(self.annotations());
        tool
    }
}

/// Tools of a server, with or without a driver.
pub(super) fn list(drives: bool) -> Vec<Tool> {
    let offered = ToolName::ALL.into_iter().filter(|tool| drives || !tool.needs_driver());
    offered.map(ToolName::tool).collect()
}

/// Finds an offered tool.
pub(super) fn offered(name: &str, drives: bool) -> Option<Tool> {
    ToolName::find(name).filter(|tool| drives || !tool.needs_driver()).map(ToolName::tool)
}

/// Reads the arguments of a call.
pub(super) fn arguments<T: DeserializeOwned>(given: Option<JsonObject>) -> Result<T, Refusal> {
    let given = serde_json::Value::Object(given.unwrap_or_default());
    serde_json::from_value(given).map_err(|error| Refusal::new(format!("the arguments do not fit: {error}")))
}

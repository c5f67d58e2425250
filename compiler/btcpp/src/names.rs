//! Names that the trees share with whoever reads or runs them: nodes of BehaviorTree.CPP, ports, and
//! entries of the blackboard that stand for what a policy knows of its endings and failures.

/// Entry with the way in which the policy ends: `done`, `fail`, `cannot` or `replan`; empty while it runs.
pub(crate) const ENDED: &str = "ended";
/// Entry and output port with the kind of the last failure.
pub(crate) const FAILURE: &str = "failure";
/// Output port of a result.
pub(crate) const RESULT: &str = "result";
/// Input port of a condition node: whether the fact is true or false.
pub(crate) const IS: &str = "is";
/// Input port of a condition node that compares: the number beside the measure.
pub(crate) const THAN: &str = "than";
/// Input ports of a manner.
pub(crate) const SPEED: &str = "speed";
pub(crate) const ACCELERATION: &str = "acceleration";
/// Name of a sequence of guards and the action behind them.
pub(crate) const NEEDS: &str = "needs";
/// Milliseconds between two looks at a condition that is waited for.
pub(crate) const POLL_MSEC: &str = "50";

/// Nodes that BehaviorTree.CPP registers itself.
pub(crate) const BUILT_IN: &[&str] = &[
    "Action",
    "AlwaysFailure",
    "AlwaysSuccess",
    "AsyncFallback",
    "AsyncSequence",
    "BehaviorTree",
    "Condition",
    "Control",
    "Decorator",
    "Delay",
    "Fallback",
    "ForceFailure",
    "ForceSuccess",
    "IfThenElse",
    "Inverter",
    "KeepRunningUntilFailure",
    "LoopBool",
    "LoopDouble",
    "LoopInt",
    "LoopString",
    "Parallel",
    "ParallelAll",
    "Precondition",
    "ReactiveFallback",
    "ReactiveSequence",
    "Repeat",
    "RetryUntilSuccessful",
    "RunOnce",
    "Script",
    "ScriptCondition",
    "Sequence",
    "SequenceWithMemory",
    "SetBlackboard",
    "Sleep",
    "SubTree",
    "Switch2",
    "Switch3",
    "Switch4",
    "Switch5",
    "Switch6",
    "TestNode",
    "Timeout",
    "TryCatch",
    "UnsetBlackboard",
    "WhileDoElse",
];

/// Checks if a name is one of a node that can be registered, and an element of XML.
pub(crate) fn is_node_name(name: &str) -> bool {
    is_entry(name) && !BUILT_IN.contains(&name)
}

/// Checks if a name is one of an entry of the blackboard that scripts can read.
pub(crate) fn is_entry(name: &str) -> bool {
    name.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
        && name.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_')
}

/// Checks if a parameter can be a port beside those that a tree adds.
pub(crate) fn is_port(name: &str) -> bool {
    let added = [IS, THAN, RESULT, FAILURE, SPEED, ACCELERATION, "name", "ID"];
    is_entry(name) && !name.starts_with('_') && !added.contains(&name)
}

/// Name of the condition node for the needs of an action.
pub(crate) fn can(action: &str) -> String {
    format!("can_{action}")
}

/// Entry of the kind of the failure of one step.
pub(crate) fn failure_of(node: u32) -> String {
    format!("failure_{node}")
}

/// Entry that tells whether the test of a loop was met.
pub(crate) fn met_of(node: u32) -> String {
    format!("met_{node}")
}

/// Checks if an entry is one that a tree adds.
pub(crate) fn is_added(entry: &str) -> bool {
    let numbered = |prefix: &str| {
        entry.strip_prefix(prefix).is_some_and(|rest| rest.bytes().all(|byte| byte.is_ascii_digit()))
    };
    entry == ENDED || entry == FAILURE || numbered("failure_") || numbered("met_")
}

//! Names of nodes and ports on which export and import agree, and the names that BehaviorTree.CPP permits.

/// Stem of the condition that tests a fluent.
pub(crate) const FLUENT: &str = "is_";
/// Stem of the condition that compares a measure.
pub(crate) const MEASURE: &str = "compare_";
/// Condition that compares a field of an entity.
pub(crate) const FIELD: &str = "compare_field";
/// Condition that compares the length of a list.
pub(crate) const COUNT: &str = "compare_count";
/// Condition that compares two names or texts.
pub(crate) const VALUE: &str = "compare_value";
/// Condition that compares two numbers.
pub(crate) const NUMBER: &str = "compare_number";
/// Stem of the condition that the open needs of a primitive hold.
pub(crate) const NEEDS: &str = "can_";
/// Condition that a failure is of one of some kinds.
pub(crate) const FAILURE_IS: &str = "failure_is";
/// Name of the sequence that checks the goal.
pub(crate) const GOAL: &str = "achieves";
/// Names of the actions that end a policy without success.
pub(crate) const ENDINGS: [&str; 3] = ["fail", "cannot", "replan"];

/// Output port of a result.
pub(crate) const AS: &str = "as";
/// Input port of a manner, the parts of speed and acceleration.
pub(crate) const MANNER: &str = "manner";
/// Output port of the kind of a failure.
pub(crate) const FAILURE: &str = "failure";
/// Input port of a truth value or of a comparison.
pub(crate) const IS: &str = "is";
/// Input port of the other side of a comparison.
pub(crate) const THAN: &str = "than";
/// Input port of what is compared, or counted.
pub(crate) const OF: &str = "of";

/// Nodes that BehaviorTree.CPP registers itself.
const BUILT_IN: &str = "\
    Action AlwaysFailure AlwaysSuccess AsyncFallback AsyncSequence BehaviorTree Condition Control Decorator \
    Delay Fallback ForceFailure ForceSuccess IfThenElse Inverter KeepRunningUntilFailure LoopBool \
    LoopDouble LoopInt LoopString Parallel ParallelAll Precondition ReactiveFallback ReactiveSequence \
    Repeat RetryUntilSuccessful Root RunOnce Script ScriptCondition Sequence SequenceWithMemory \
    SetBlackboard SkipUnlessUpdated Sleep SubTree Switch2 Switch3 Switch4 Switch5 Switch6 Timeout \
    TreeNodesModel TryCatch UnsetBlackboard WaitValueUpdate WasEntryUpdated WhileDoElse root include";

/// Checks if a node of a library may have this name.
pub(crate) fn is_node_name(name: &str) -> bool {
    name.starts_with(|char: char| char.is_ascii_alphabetic() || char == '_')
        && !name.chars().any(is_forbidden)
        && !BUILT_IN.split_whitespace().any(|built_in| built_in == name)
}

/// Checks if a port may have this name.
pub(crate) fn is_port_name(name: &str) -> bool {
    name.starts_with(|char: char| char.is_ascii_alphabetic())
        && !name.chars().any(is_forbidden)
        && !["name", "ID"].contains(&name)
}

/// Characters that a name may not have, and those that XML does not have in the name of an attribute.
fn is_forbidden(char: char) -> bool {
    !(char.is_ascii_alphanumeric() || matches!(char, '_' | '-'))
}

/// Checks if a text reaches a port as it is: not as the name of an entry or as JSON.
pub(crate) fn is_plain(text: &str) -> bool {
    let bare = text.trim_matches(' ');
    let is_entry = bare.len() >= 3 && bare.starts_with('{') && bare.ends_with('}');
    !is_entry && text != "=" && !text.starts_with("json:")
}

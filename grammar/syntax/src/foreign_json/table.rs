//! Shapes that models write, as data: for each word or key the one of the language.

use crate::located::Located;

/// Keys that name the callee of a step, as `do` does.
pub(super) const CALLEES: [&str; 9] =
    ["action", "tool", "tool_name", "function", "primitive", "skill", "command", "call", "type"];

/// Key that names the callee where the arguments have a key of their own; elsewhere it may be an argument.
pub(super) const NAME: &str = "name";

/// Keys around a whole call.
pub(super) const WRAPPERS: [&str; 8] =
    ["function", "function_call", "tool_call", "tool_use", "call", "action", "tool", "do"];

/// Keys of the arguments of a call.
pub(super) const ARGUMENTS: [&str; 6] = ["args", "arguments", "parameters", "params", "input", "kwargs"];

/// Keys beside a call in the manner of tools that say nothing about it.
pub(super) const NOISE: [&str; 6] = ["type", "id", "call_id", "tool_call_id", "tool_use_id", "index"];

/// Values of `type` that name no callee.
pub(super) const TYPES: [&str; 8] =
    ["function", "function_call", "tool_call", "tool_use", "tool", "call", "action", "step"];

/// Keys that name a fluent, as `is` does.
pub(super) const FLUENTS: [&str; 3] = ["fluent", "fact", "predicate"];

/// Names of fluents that are one letter from a key of a form.
pub(super) const SHORT_FLUENTS: [&str; 3] = ["in", "on", "at"];

/// Names of callees that are one letter from a key of a form.
pub(super) const SHORT_CALLEES: [&str; 1] = ["go"];

/// Other keys and operators of conditions.
pub(super) const CONDITIONS: [(&str, &str); 20] = [
    ("and", "all"),
    ("or", "any"),
    ("<", "less"),
    ("lt", "less"),
    ("less_than", "less"),
    ("<=", "at_most"),
    ("le", "at_most"),
    ("lte", "at_most"),
    ("==", "equal"),
    ("eq", "equal"),
    ("equals", "equal"),
    (">", "more"),
    ("gt", "more"),
    ("greater", "more"),
    ("greater_than", "more"),
    (">=", "at_least"),
    ("ge", "at_least"),
    ("gte", "at_least"),
    ("!=", "unequal"),
    ("not_equal", "unequal"),
];

/// Other words for the ways in which a policy ends.
pub(super) const ENDINGS: [(&str, &str); 10] = [
    ("success", "done"),
    ("succeed", "done"),
    ("finish", "done"),
    ("finished", "done"),
    ("complete", "done"),
    ("completed", "done"),
    ("failure", "fail"),
    ("failed", "fail"),
    ("abort", "fail"),
    ("give_up", "fail"),
];

/// Keys whose value may be the word for the form of a step.
pub(super) const STEP_KINDS: [&str; 5] = ["do", "type", "kind", "step", "action"];

/// Words for the forms of steps, each with the key of the form.
pub(super) const STEP_WORDS: [(&str, &str); 15] = [
    ("if", "if"),
    ("branch", "if"),
    ("repeat", "repeat"),
    ("loop", "repeat"),
    ("each", "each"),
    ("for", "each"),
    ("foreach", "each"),
    ("for_each", "each"),
    ("wait", "wait"),
    ("monitor", "monitor"),
    ("try", "try"),
    ("sequence", "sequence"),
    ("parallel", "parallel"),
    ("let", "let"),
    ("keep", "keep"),
];

/// Keys that stand for the key of a form whose name is a word.
pub(super) const STEP_HEADS: [(&str, &[&str]); 9] = [
    ("if", &["condition", "cond", "test", "when"]),
    ("repeat", &["times", "count", "max_times", "iterations"]),
    ("each", &["item", "var", "variable", "for", "foreach", "for_each"]),
    ("wait", &["until", "condition", "seconds", "duration", "time"]),
    ("monitor", &["whens", "conditions", "watch"]),
    ("try", &["body", "steps"]),
    ("sequence", &["name", "label"]),
    ("parallel", &["branches"]),
    ("let", &["name", "var", "variable"]),
];

/// Keys of the kinds of failure in a handler.
pub(super) const HANDLERS: [&str; 5] = ["on", "error", "errors", "failure", "failures"];

/// Keys of a time around it.
pub(super) const TIMES: [&str; 4] = ["seconds", "duration", "time", "for"];

/// Keys beside a step that only say something about it.
pub(super) const LABELS: [&str; 6] = ["reason", "note", "step", "name", "label", "title"];

/// Key of a document that holds its goal: a condition, or prose.
pub(super) const GOAL: &str = "goal";

/// Keys that name the kind of a reaction or an ending.
pub(super) const KINDS: [&str; 6] = ["react", "end", "reaction", "action", "do", "type"];

/// Other keys of the object with the first key, each read as the last one where that is missing.
pub(super) const KEYS: [(&str, &[&str], &str); 15] = [
    ("on", &["then", "do", "body", "actions", "handler"], "steps"),
    ("on", &["error", "errors", "failure", "failures"], "on"),
    ("when", &["condition", "if"], "when"),
    ("when", &["reaction", "react", "action", "do"], "then"),
    ("monitor", &["body", "do", "steps", "while"], "during"),
    ("repeat", &["body", "do", "actions"], "steps"),
    ("each", &["body", "do", "actions"], "steps"),
    ("try", &["except", "on_failure", "on_error"], "catch"),
    ("if", &["steps", "body", "do", "actions"], "then"),
    ("if", &["otherwise", "else_steps"], "else"),
    ("each", &["list", "items", "over"], "in"),
    ("each", &["max", "limit", "max_items"], "at_most"),
    ("sequence", &["body", "do", "actions"], "steps"),
    ("let", &["value", "to"], "be"),
    ("end", &["reason", "because", "message"], "why"),
];

/// Keys whose value is a new name, which has no `$`.
pub(super) const NAMES: [&str; 3] = ["as", "each", "let"];

/// Keys of a document that hold its steps, as `steps` does.
pub(super) const PLANS: [&str; 6] = ["plan", "actions", "program", "commands", "tool_calls", "calls"];

/// Keys of a document that hold prose.
pub(super) const PROSE: [&str; 11] = [
    "thought",
    "thoughts",
    "reasoning",
    "rationale",
    "explanation",
    "comment",
    "comments",
    "notes",
    "description",
    "summary",
    "analysis",
];

/// Keys of a point or a pose as an object, for the numbers of a pose in order.
pub(super) const POSE: [&[&str]; 4] = [&["x"], &["y"], &["z"], &["yaw", "theta", "heading", "angle"]];

/// Reading of a key that says nothing to the robot.
pub(super) const IGNORED: &str = "prose, which is ignored";

/// Name of a group of steps that has none.
pub(super) const UNNAMED_GROUP: &str = "steps";

/// Name of a policy that has none.
pub(super) const UNNAMED: &str = "plan";

/// Key of the language for a key or an operator of a condition.
pub(super) fn condition_key(key: &str) -> &str {
    CONDITIONS.iter().find(|(alias, _)| *alias == key).map_or(key, |(_, own)| *own)
}

/// Checks if a key is one of these tables that names no callee itself.
pub(super) fn is_own(key: &Located<'_>) -> bool {
    let tables: [&[&str]; 7] = [&CALLEES, &WRAPPERS, &ARGUMENTS, &NOISE, &FLUENTS, &PLANS, &PROSE];
    key.text().is_some_and(|key| key == NAME || tables.iter().any(|words| words.contains(&key)))
}

//! WordList of the text form that are never a bare name.

/// They are those of the rule `reserved` of the text grammar, which a test holds them against.
pub const RESERVED: &[&str] = &[
    "let", "sequence", "if", "else", "wait", "until", "monitor", "when", "then", "during", "try", "catch",
    "repeat", "each", "parallel", "done", "fail", "replan", "and", "or", "not", "true", "false", "any",
];

//! The words of the language: reserved words, declaration words and JSON keys. `motet.pest` spells the same
//! words as rules; a test below holds it against these lists.

use std::borrow::Cow;
use std::sync::LazyLock;

pub use motet_stdlib::lang::{RESERVED, is_bare_name};

use crate::render::is_steering;

const GRAMMAR: &str = include_str!("motet.pest");

/// Words at the start of a declaration.
pub const DECLARATIONS: [&str; 11] = [
    "policy",
    "action",
    "perception",
    "kind",
    "fluent",
    "measure",
    "failure",
    "enum",
    "entity",
    "initially",
    "closed",
];

/// Words at the start of a clause of a contract.
pub const CLAUSES: [&str; 8] = ["needs", "makes", "unsettles", "motion", "uses", "takes", "fails", "lasts"];

/// Reserved words at the start of a step or of one of its parts.
pub const STEP_WORDS: [&str; 19] = [
    "let", "sequence", "if", "wait", "monitor", "try", "repeat", "each", "parallel", "done", "fail",
    "cannot", "replan", "catch", "finally", "else", "until", "when", "during",
];

/// Keys of a `do` step in JSON that are not arguments.
pub const CALL_KEYS: [&str; 5] = ["do", "as", "manner", "within", "retry"];

/// Key of a deadline in JSON. It names the form of a step only if no other key does.
pub const DEADLINE: &str = "within";

/// Keys of all other JSON steps that name their form.
pub const STEP_KEYS: [&str; 11] =
    ["let", "if", "wait", "monitor", "try", "repeat", "each", "parallel", "keep", "end", "sequence"];

/// Keys of parts of JSON steps, of conditions and of terms, each with the form that it belongs to. `on` and
/// `result` are not among them: `on` names the failures of a `catch`, and `result` the result of a `done`.
/// Neither has arguments, and `on` is the natural name for a support.
pub const FORM_KEYS: [(&str, &str); 18] = [
    ("be", "`let`"),
    ("then", "`if` and to a monitor's `when`"),
    ("else", "`if`"),
    ("during", "`monitor`"),
    ("catch", "`try`"),
    ("finally", "the steps that have steps of their own"),
    ("until", "`repeat`"),
    ("steps", "`sequence`, `repeat`, `each`, `within` and `keep`"),
    ("in", "`each`"),
    ("at_most", "`each` and to the reactions"),
    ("why", "`end`"),
    ("when", "`monitor`"),
    ("for", "a monitor's `when`"),
    ("react", "a monitor's `then`"),
    ("is", "conditions"),
    ("get", "terms"),
    ("field", "terms"),
    ("of", "`field`"),
];

/// Checks if a text is a keyword of the text syntax, by the rules `kw_…` of the grammar. Those outside of
/// [`RESERVED`] can be names elsewhere.
#[must_use]
pub fn is_keyword(text: &str) -> bool {
    static KEYWORDS: LazyLock<Vec<&str>> = LazyLock::new(|| {
        let rules = GRAMMAR.lines().filter(|line| line.starts_with("kw_"));
        rules.filter_map(|rule| rule.split('"').nth(1)).collect()
    });
    KEYWORDS.contains(&text)
}

/// Form that a key of [`STEP_KEYS`] or [`FORM_KEYS`] belongs to, in words. `None` for any other key.
#[must_use]
pub fn json_key_owner(key: &str) -> Option<&'static str> {
    if STEP_KEYS.contains(&key) {
        return Some("a step of its own");
    }
    FORM_KEYS.iter().find(|(known, _)| *known == key).map(|(_, owner)| *owner)
}

/// Checks if a key has a meaning of its own in JSON, so that no parameter of a primitive may bear it.
///
/// ```
/// use motet_syntax::words::is_json_key;
///
/// assert!(is_json_key("within") && is_json_key("steps"));
/// assert!(!is_json_key("object"));
/// ```
#[must_use]
pub fn is_json_key(key: &str) -> bool {
    CALL_KEYS.contains(&key) || json_key_owner(key).is_some()
}

/// Checks if a text can stand as a name, in back-quotes where it is not a bare one: it is not empty, does not
/// begin with `$`, and has no back-quote and nothing that steers a terminal but the tab.
#[must_use]
pub fn is_name(text: &str) -> bool {
    let is_barred = |letter: char| letter == '`' || (letter != '\t' && is_steering(letter));
    text.chars().next().is_some_and(|first| first != '$') && !text.contains(is_barred)
}

/// The name as the text syntax writes it: in back-quotes where it needs them.
pub(crate) fn spelled(name: &str) -> Cow<'_, str> {
    if is_bare_name(name) { Cow::Borrowed(name) } else { Cow::Owned(format!("`{name}`")) }
}

#[cfg(test)]
mod tests {
    use super::{CLAUSES, DECLARATIONS, GRAMMAR, RESERVED, STEP_WORDS, is_keyword};

    /// Words between double quotes in the definition of a rule.
    fn words_of(rule: &str) -> Vec<&'static str> {
        let (_, start) = GRAMMAR.split_once(&format!("\n{rule} = _{{")).unwrap();
        let (body, _) = start.split_once("\n}").unwrap();
        body.split('"').skip(1).step_by(2).collect()
    }

    #[test]
    fn reserved_words_are_those_of_the_grammar() {
        assert_eq!(words_of("reserved"), RESERVED);
    }

    #[test]
    fn keywords_are_rules_of_the_grammar() {
        for word in DECLARATIONS.iter().chain(&CLAUSES).chain(&RESERVED) {
            assert!(is_keyword(word), "{word}");
        }
        assert!(STEP_WORDS.iter().all(|word| RESERVED.contains(word)));
    }
}

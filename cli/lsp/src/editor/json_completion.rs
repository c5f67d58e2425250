//! Completion in the JSON syntax: keys and values by the keys around them.

use std::sync::LazyLock;

use motet_compiler::Session;
use motet_syntax::Parsed;
use motet_syntax::json::policy_schema;
use motet_syntax::text::lexer::{TokenKind, tokens};
use motet_syntax::words::{DEADLINE, STEP_KEYS};
use serde_json::Value;
use smol_str::SmolStr;

use super::completion::{Completer, Completion, Suggestion, SuggestionKind};
use super::context::ArgumentPlace;
use super::point::{PointState, step_at};

/// Keys of a policy.
static POLICY_KEYS: LazyLock<Vec<String>> = LazyLock::new(|| {
    let schema = policy_schema();
    let properties = schema.get("properties").and_then(Value::as_object);
    properties.into_iter().flatten().map(|(key, _)| key.clone()).collect()
});

/// Place in a JSON document.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
struct JsonPlace {
    /// Range of the string that is written, without its quotes; empty before one.
    word: (usize, usize),
    is_quoted: bool,
    /// Key whose value is written; `None` for a key or an element.
    key: Option<String>,
    /// True for the place of a key.
    is_key: bool,
    /// Members of the object around it, as far as they are texts.
    members: Vec<(String, String)>,
    /// Key of the object or list around it.
    around: Option<String>,
}

/// Completes the string at an offset of a document in the JSON syntax.
pub(crate) fn complete(session: &Session, parsed: &Parsed, offset: usize) -> Completion {
    let place = place(&parsed.text, offset);
    let step = step_at(parsed, offset);
    let state = step.and_then(|step| PointState::before(session, parsed, step.span));
    let signatures = state.as_ref().map_or_else(|| session.signatures(), |state| state.session.signatures());
    let mut completer = Completer { session, signatures: &signatures, state, found: Vec::new() };
    let callee = place.members.iter().find(|(key, _)| key == "do").map(|(_, name)| name.clone());
    let key = place.key.as_deref();
    match (key, callee) {
        _ if place.is_key => return keys(&completer, &place),
        (Some("do"), _) => completer.callables(|_| true),
        (Some("robot"), _) => completer.robots(),
        (Some("is" | "get"), _) => completer.relations(),
        (Some("end"), _) => completer.plain(&["done", "fail", "cannot", "replan"]),
        (Some("react"), _) => completer.plain(&["pause", "restart", "resume"]),
        (Some("manner"), _) => completer.plain(&["slowly", "gently"]),
        (Some(label), Some(callee)) => {
            let others = place.members.iter().filter(|(key, _)| key != "do" && key != label);
            let others =
                others.map(|(key, value)| (Some(SmolStr::from(key.as_str())), value.as_str().into()));
            completer.argument(&ArgumentPlace {
                callee: callee.into(),
                label: Some(label.into()),
                index: 0,
                others: others.collect(),
            });
        }
        (None, _) if place.around.as_deref() == Some("on") => completer.failures(),
        (Some(_), None) => completer.values(None, &mut |_, _| true),
        (None, _) => {}
    }
    let suggestions = std::mem::take(&mut completer.found).into_iter();
    let suggestions = suggestions.map(|one| {
        let mark = if one.kind == SuggestionKind::Binding { "$" } else { "" };
        let name = format!("{mark}{}", one.label);
        let insert = if place.is_quoted { name } else { format!("\"{name}\"") };
        Suggestion { insert, is_snippet: false, ..one }
    });
    Completion { word: place.word, suggestions: suggestions.collect() }
}

impl Completer<'_> {
    fn plain(&mut self, words: &[&str]) {
        let words = words.iter().map(|word| Suggestion {
            label: (*word).to_owned(),
            kind: SuggestionKind::Keyword,
            detail: String::new(),
            insert: (*word).to_owned(),
            is_snippet: false,
        });
        self.found.extend(words);
    }
}

/// Keys that the object around a place lacks.
fn keys(completer: &Completer<'_>, place: &JsonPlace) -> Completion {
    let has = |name: &str| place.members.iter().any(|(key, _)| key == name);
    let callee = place.members.iter().find(|(key, _)| key == "do").map(|(_, name)| name);
    let mut keys: Vec<(String, SuggestionKind)> = Vec::new();
    let word = |key: &str| (key.to_owned(), SuggestionKind::Keyword);
    match callee {
        Some(callee) => {
            let callable = completer.signatures.callable(callee);
            let params = callable.iter().flat_map(|callable| &callable.params);
            keys.extend(params.map(|param| (param.name.to_string(), SuggestionKind::Label)));
            keys.extend(["as", "within", "retry", "manner"].map(word));
        }
        None if place.around.is_none() => {
            keys.extend(POLICY_KEYS.iter().map(|key| word(key)));
        }
        None => keys.extend(STEP_KEYS.into_iter().chain(["do", DEADLINE, "finally"]).map(word)),
    }
    let suggestions = keys.into_iter().filter(|(key, _)| !has(key)).map(|(key, kind)| {
        let insert = if place.is_quoted { key.clone() } else { format!("\"{key}\": ") };
        Suggestion { label: key, kind, detail: String::new(), insert, is_snippet: false }
    });
    Completion { word: place.word, suggestions: suggestions.collect() }
}

/// Object or list that is open.
struct OpenValue {
    is_object: bool,
    key: Option<String>,
    /// Key whose value comes next.
    next: Option<String>,
    members: Vec<(String, String)>,
}

/// Place of an offset in a document, however broken. O(bytes).
fn place(text: &str, offset: usize) -> JsonPlace {
    let mut open: Vec<OpenValue> = Vec::new();
    let mut last_text: Option<String> = None;
    let mut found: Option<(usize, JsonPlace)> = None;
    for token in tokens(text, 0) {
        let is_text = matches!(token.kind, TokenKind::Text | TokenKind::Open) && token.text.starts_with('"');
        let is_inside =
            is_text && (offset < token.end() || token.kind == TokenKind::Open && offset == token.end());
        if found.is_none() && (token.start >= offset || is_inside) {
            let is_quoted = is_text && token.start < offset;
            let closing = usize::from(token.kind == TokenKind::Text);
            let word = match is_quoted {
                true => (token.start + 1, token.end() - closing),
                false => (offset, offset),
            };
            found = Some((open.len(), at(&open, word, is_quoted)));
        }
        let depth = open.len();
        match token.text {
            "{" | "[" => {
                let key = open.last_mut().and_then(|around| match around.is_object {
                    true => around.next.take(),
                    false => around.key.clone(),
                });
                open.push(OpenValue { is_object: token.text == "{", key, next: None, members: Vec::new() });
            }
            "}" | "]" => {
                if let (Some((level, place)), Some(closed)) = (&mut found, open.pop())
                    && *level == depth
                {
                    place.members = closed.members;
                    return std::mem::take(place);
                }
            }
            ":" => {
                if let Some(around) = open.last_mut() {
                    around.next = last_text.take();
                }
            }
            text if is_text => {
                let text = text.trim_matches('"').to_owned();
                match open.last_mut() {
                    Some(around) if around.is_object && around.next.is_some() => {
                        around.members.extend(around.next.take().map(|key| (key, text)));
                    }
                    _ => last_text = Some(text),
                }
            }
            "," => {}
            _ => {
                if let Some(around) = open.last_mut() {
                    around.next = None;
                }
            }
        }
    }
    let mut place = found.map_or_else(|| at(&open, (offset, offset), false), |(_, place)| place);
    if let Some(around) = open.pop() {
        place.members = around.members;
    }
    place
}

fn at(open: &[OpenValue], word: (usize, usize), is_quoted: bool) -> JsonPlace {
    let around = open.last();
    let is_object = around.is_some_and(|around| around.is_object);
    let key = around.and_then(|around| around.next.clone());
    JsonPlace {
        word,
        is_quoted,
        is_key: is_object && key.is_none(),
        key,
        members: Vec::new(),
        around: around.and_then(|around| around.key.clone()),
    }
}

#[cfg(test)]
mod tests {
    use motet_project::{DOCUMENT, Discard, Project};
    use motet_syntax::Source;

    fn check(steps: &str, has: &[&str], lacks: &[&str]) {
        let project = Project::builder().robot("hsr").scene("kitchen").without_motions();
        let project = project.open().unwrap().into_session(&mut Discard).unwrap();
        let text = format!("{{\"motet\": 1, \"policy\": \"p\", \"steps\": [{steps}]}}");
        let offset = text.find('|').unwrap();
        let source = Source::new("p.json", text.replacen('|', "", 1));
        let parsed = motet_syntax::read(&source, DOCUMENT);
        let found = super::complete(&project.session, &parsed, offset);
        let inserts: Vec<&str> = found.suggestions.iter().map(|one| one.insert.as_str()).collect();
        for insert in has {
            assert!(inserts.contains(insert), "{insert} is not in {inserts:?} of {text}");
        }
        for insert in lacks {
            assert!(!inserts.contains(insert), "{insert} is in {inserts:?} of {text}");
        }
    }

    #[test]
    fn complete_offers_what_passes_in_json() {
        check(r#"{"do": "|"}"#, &["go", "detect"], &[]);
        check(r#"{"do": "go", "to": "|"}"#, &["kitchen_table", "user"], &["go"]);
        let go = r#"{"do": "go", "to": "kitchen_table"}, "#;
        check(&format!(r#"{go}{{"do": "pick", "object": "|"}}"#), &["mug_1"], &["mug_2", "user"]);
        let detect = r#"{"do": "detect", "what": "red mug", "as": "m"}, "#;
        check(&format!(r#"{go}{detect}{{"do": "pick", "object": "|"}}"#), &["$m"], &["m"]);
        check(r#"{"do": "pick", "|"}"#, &["object", "from", "as"], &["do", "if"]);
        check(r#"{|"#, &["\"do\": ", "\"if\": ", "\"within\": "], &["do", "\"then\": "]);
        check(r#"{"end": "|"}"#, &["done", "replan"], &["go"]);
        check(r#"{"try": [], "catch": [{"on": ["|"]}]}"#, &["timeout"], &["go"]);
    }
}

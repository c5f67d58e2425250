//! Continuations of a policy prefix: the words and the tokens that may follow, with descriptions, and the
//! words that may not, with the checker's reasons.

use std::io::Read;
use std::path::Path;

use motet_compiler::Signatures;
use motet_compiler::signature::{ParamSignature, Type};
use motet_decode::vocabulary::MAX_FILE_BYTES;
use motet_decode::{Acceptor, AcceptorFactory, EndToken, Vocabulary};
use motet_syntax::{Diagnostic, Syntax};

use crate::error::CliError;

/// Innermost JSON object of a prefix, and the key whose value comes next.
#[derive(Debug, Default)]
struct PrefixEnd {
    /// First key of the object, such as `do`, `is` or `end`.
    kind: String,
    /// Value of the first key; empty if it is not written yet.
    name: String,
    key: String,
    /// Part of the word that is written already.
    started: String,
}

impl PrefixEnd {
    /// End of a prefix in JSON without white space.
    fn of(prefix: &[u8]) -> Self {
        let prefix = String::from_utf8_lossy(prefix);
        let Some((_, object)) = prefix.rsplit_once("{\"") else { return Self::default() };
        let parts: Vec<&str> = object.split('"').collect();
        let at = |index: usize| parts.get(index).copied().unwrap_or_default().to_owned();
        let value = parts.iter().rposition(|part| part.starts_with(':'));
        let in_string = parts.len() % 2 == 1;
        Self {
            kind: at(0),
            name: if parts.len() > 3 { at(2) } else { String::new() },
            key: value.and_then(|value| value.checked_sub(1)).map(at).unwrap_or_default(),
            started: if in_string { at(parts.len() - 1) } else { String::new() },
        }
    }

    /// Words that names and types alone would allow here; none if no name is expected.
    fn words<'s>(&self, signatures: &'s Signatures) -> Vec<&'s str> {
        let mut words: Vec<&str> = match (self.kind.as_str(), self.key.as_str()) {
            ("do", "do") => signatures.callables.iter().map(|callable| callable.name.as_str()).collect(),
            ("is", "is") => signatures.fluents.iter().map(|fluent| fluent.name.as_str()).collect(),
            ("get", "get") => signatures.measures.iter().map(|measure| measure.name.as_str()).collect(),
            _ => match self.ty(signatures) {
                Some(Type::Entity(kind)) => signatures.entities_of(*kind).map(|name| name.as_str()).collect(),
                Some(Type::Enum(id)) => {
                    let cases = signatures.enums.get(*id).map(|id| id.cases.iter());
                    cases.into_iter().flatten().map(|case| case.as_str()).collect()
                }
                _ => Vec::new(),
            },
        };
        words.retain(|word| word.starts_with(&self.started));
        words
    }

    /// Is `true` if the name of a callable comes next.
    fn is_call(&self) -> bool {
        self.kind == "do" && self.key == "do"
    }

    /// Is `true` if an argument of a call comes next.
    fn is_argument(&self) -> bool {
        self.kind == "do" && self.key != "do"
    }

    fn ty<'s>(&self, signatures: &'s Signatures) -> Option<&'s Type> {
        let of = |params: &'s [(smol_str::SmolStr, Type)]| {
            params.iter().find(|(name, _)| *name == self.key).map(|(_, ty)| ty)
        };
        match self.kind.as_str() {
            "do" => {
                let callable = signatures.callable(&self.name)?;
                callable.params.iter().find(|param| param.name == self.key).map(|param| &param.ty)
            }
            "is" => of(&signatures.fluent(&self.name)?.params),
            "get" => of(&signatures.measure(&self.name)?.params),
            _ => None,
        }
    }
}

/// Describes a word.
fn describe(signatures: &Signatures, place: &PrefixEnd, word: &str) -> String {
    let bare = word.trim_start_matches(['{', '[', '"']);
    let whole = format!("{}{bare}", place.started);
    let params = |params: &mut dyn Iterator<Item = (&str, &Type)>| {
        let written: Vec<String> =
            params.map(|(name, ty)| format!("{name}: {}", signatures.type_name(ty))).collect();
        written.join(", ")
    };
    let callable = signatures.callable(&whole).filter(|_| place.is_call());
    if let Some(callable) = callable {
        let params = params(&mut callable.params.iter().map(|param| (param.name.as_str(), &param.ty)));
        let result = callable.result.as_ref().map(|ty| format!(" -> {}", signatures.type_name(ty)));
        return format!("calls {whole}({params}){}", result.unwrap_or_default());
    }
    let fluent = signatures.fluent(&whole).filter(|_| place.key == "is");
    if let Some(fluent) = fluent {
        return format!(
            "asks {whole}({})",
            params(&mut fluent.params.iter().map(|(name, ty)| (name.as_str(), ty)))
        );
    }
    let measure = signatures.measure(&whole).filter(|_| place.key == "get");
    if let Some(measure) = measure {
        let params = params(&mut measure.params.iter().map(|(name, ty)| (name.as_str(), ty)));
        return format!("measures {whole}({params}) -> {}", signatures.type_name(&measure.result));
    }
    let entity = signatures.entities.iter().find(|(name, _)| *name == whole);
    if let Some(kind) = entity.and_then(|(_, kind)| signatures.kinds.get(*kind)) {
        return format!("{} of the scene", kind.name);
    }
    if let Some(Type::Enum(id)) = place.ty(signatures) {
        return signatures.enums.get(*id).map(|id| format!("case of {}", id.name)).unwrap_or_default();
    }
    if whole.starts_with('$') {
        return "bound by the policy".to_owned();
    }
    structure(word, bare).to_owned()
}

/// Describes a word of the text syntax at any position.
fn describe_text(signatures: &Signatures, word: &str) -> String {
    let bare = word.trim();
    let at = |kind: &str, key: &str| PrefixEnd { kind: kind.into(), key: key.into(), ..PrefixEnd::default() };
    let places = [at("do", "do"), at("is", "is"), at("get", "get")];
    let mut found = places.iter().map(|place| describe(signatures, place, bare));
    found.find(|text| !text.is_empty()).unwrap_or_default()
}

/// Describes a word of the syntax itself.
fn structure(word: &str, bare: &str) -> &'static str {
    match (word, bare) {
        (",", _) => "continues the list",
        ("]" | "}", _) => "closes",
        ("\"", _) => "ends the name or text",
        (_, "do") => "a call",
        (_, "let") => "a name for a result or a value",
        (_, "end") => "an ending: done, fail, cannot or replan",
        (_, "sequence") => "a named group of steps",
        (_, "if") => "steps under a condition",
        (_, "wait") => "waits until a condition holds, or for a time",
        (_, "monitor") => "steps with conditions that are monitored",
        (_, "try") => "steps with handlers of failures",
        (_, "repeat") => "a loop",
        (_, "each") => "a loop over a list",
        (_, "parallel") => "parallel branches",
        (_, "within") => "steps with a deadline",
        (_, "keep") => "steps during which the robot stays away from something",
        (_, "finally") => "a cleanup",
        (_, "is") => "a fluent, or whether a list is empty",
        (_, "get") => "a comparison of a measure or of the length of a list",
        (_, "field") => "a comparison of a field",
        (_, "not" | "all" | "any") => "a combined condition",
        (_, "react") => "a reaction: pause, restart or resume",
        (_, "null") => "no value",
        _ => "",
    }
}

/// Maximum number of argument lists that are tried for a reason.
const ATTEMPTS: usize = 8;

/// Describes the refused words, each with a reason.
pub(super) fn refused(acceptor: &Acceptor, signatures: &Signatures, next: &Next) -> String {
    let place = PrefixEnd::of(acceptor.bytes());
    let offered = |word: &str| {
        let rest = word.strip_prefix(place.started.as_str()).unwrap_or(word);
        next.words.iter().any(|offered| offered.trim_start_matches(['{', '[', '"']) == rest)
    };
    let words: Vec<&str> = place.words(signatures).into_iter().filter(|word| !offered(word)).collect();
    if words.is_empty() {
        return String::new();
    }
    let width = words.iter().map(|word| word.chars().count()).max().unwrap_or_default().min(24);
    let mut text = "may not:\n".to_owned();
    for word in words {
        text.push_str(&format!("  {word:width$}  {}\n", reason(acceptor, signatures, &place, word)));
    }
    text
}

fn reason(acceptor: &Acceptor, signatures: &Signatures, place: &PrefixEnd, word: &str) -> String {
    if place.is_call() || place.is_argument() {
        let callable = if place.is_call() { word } else { place.name.as_str() };
        let rest = word.strip_prefix(place.started.as_str()).unwrap_or(word);
        for attempt in attempts(signatures, place, callable) {
            let why = acceptor.why_not(format!("{rest}\"{attempt}").as_bytes());
            if let Some(found) = about(&why, callable) {
                return format!("{}: {}", found.code, found.message);
            }
        }
        return "no argument makes it valid".to_owned();
    }
    let fluent = signatures.fluent(word).filter(|fluent| !fluent.is_observable);
    let measure = signatures.measure(word).filter(|measure| !measure.is_observable);
    if place.key == "is" && fluent.is_some() || place.key == "get" && measure.is_some() {
        return "the robot does not observe it".to_owned();
    }
    "no argument makes it valid".to_owned()
}

/// Diagnostic about a call, or else the first one.
fn about<'w>(why: &'w [Diagnostic], callable: &str) -> Option<&'w Diagnostic> {
    let is_about = |found: &&Diagnostic| {
        found.about.as_ref().and_then(|about| about.primitive.as_deref()) == Some(callable)
            || found.message.contains(&format!("`{callable}`"))
    };
    why.iter().find(is_about).or_else(|| why.first())
}

/// Possible rests of the call after the word.
fn attempts(signatures: &Signatures, place: &PrefixEnd, callable: &str) -> Vec<String> {
    let Some(callable) = signatures.callable(callable) else { return Vec::new() };
    let given = callable.params.iter().position(|param| param.name == place.key).map_or(0, |given| given + 1);
    let params = callable.params.get(given..).unwrap_or_default();
    let mut written = vec![String::new()];
    for param in params {
        let values = values(signatures, param);
        let with = |before: &String| {
            let values: Vec<String> =
                values.iter().map(|value| format!("{before},\"{}\":{value}", param.name)).collect();
            values
        };
        written = written.iter().flat_map(with).take(ATTEMPTS).collect();
    }
    let bound = if callable.result.is_some() { ",\"as\":\"it\"" } else { "" };
    written.iter().map(|arguments| format!("{arguments}{bound}}}")).collect()
}

/// Sample values of a parameter, as JSON.
fn values(signatures: &Signatures, param: &ParamSignature) -> Vec<String> {
    let quoted = |name: &smol_str::SmolStr| format!("\"{name}\"");
    match &param.ty {
        Type::Entity(kind) => signatures.entities_of(*kind).take(ATTEMPTS).map(quoted).collect(),
        Type::Enum(id) => {
            let cases = signatures.enums.get(*id).map(|id| id.cases.iter().take(1).map(quoted));
            cases.into_iter().flatten().collect()
        }
        Type::Text => vec!["\"something\"".to_owned()],
        Type::Bool => vec!["true".to_owned()],
        Type::Int | Type::Number | Type::Quantity(_) => {
            vec![param.range.map_or(1.0, |(least, _)| least).to_string()]
        }
        Type::Pose => vec!["{\"pose\":[0,0,0,0]}".to_owned()],
        Type::Failure | Type::List(_) => Vec::new(),
    }
}

/// Number of possible bytes above which the next word is free.
const FREE: usize = 40;
/// Maximum number of tried bytes; a scene with thousands of entities has more words.
const MAX_TRIES: usize = 4000;

/// Continuations of a prefix.
#[derive(Debug)]
pub(super) struct Next {
    /// Words in the order of their bytes, with the brackets and quotes before them.
    pub(super) words: Vec<String>,
    /// Kinds of values without a list: `a text`, `a name`, `a number`.
    free: Vec<&'static str>,
    /// Is `true` if some words are missing.
    is_cut: bool,
    syntax: Syntax,
}

/// Continuations of the bytes of an acceptor, which stays as it is.
pub(super) fn next_words(acceptor: &mut Acceptor, syntax: Syntax) -> Next {
    let first = acceptor.next_bytes();
    let mut next = Next { words: Vec::new(), free: Vec::new(), is_cut: false, syntax };
    if first.len() > FREE {
        let is_text =
            acceptor.bytes().iter().filter(|byte| **byte == b'"').count() % 2 == 1 && syntax == Syntax::Text;
        let is_text = is_text || (syntax == Syntax::Json && first.contains(&b' '));
        next.free.push(if is_text { "a text" } else { "a name" });
        next.words.extend(first.contains(&b'"').then(|| "\"".to_owned()));
        return next;
    }
    let in_string = acceptor.bytes().iter().filter(|byte| **byte == b'"').count() % 2 == 1;
    let (mut word, mut tries) = (Vec::new(), MAX_TRIES);
    for byte in first {
        if !in_string && (byte.is_ascii_digit() || matches!(byte, b'-' | b'.')) {
            if next.free.is_empty() {
                next.free.push("a number");
            }
        } else {
            grow(acceptor, byte, &mut word, &mut next, &mut tries);
        }
    }
    next
}

/// Follows a possible byte to the end of each word that starts with it.
fn grow(acceptor: &mut Acceptor, byte: u8, word: &mut Vec<u8>, next: &mut Next, tries: &mut usize) {
    if *tries == 0 {
        next.is_cut = true;
        return;
    }
    *tries -= 1;
    if acceptor.accept(&[byte]) == 0 {
        return;
    }
    word.push(byte);
    let opens = word.iter().all(|byte| b"{[\"".contains(byte));
    if byte == b'"'
        && word.len() == 1
        && acceptor.bytes().iter().filter(|byte| **byte == b'"').count() % 2 == 0
    {
        // The quote closes the string before it.
        next.words.push(text(word));
    } else if is_mark(byte, next.syntax) && !opens {
        next.words.push(text(word));
    } else {
        let follow = acceptor.next_bytes();
        if follow.len() > FREE {
            next.words.push(text(word) + "…");
        } else {
            let (marks, rest): (Vec<u8>, Vec<u8>) = follow
                .into_iter()
                .partition(|byte| is_mark(*byte, next.syntax) && !(opens && b"{[\"".contains(byte)));
            if !marks.is_empty() {
                next.words.push(text(word));
            }
            for byte in rest {
                grow(acceptor, byte, word, next, tries);
            }
        }
    }
    word.pop();
    acceptor.forget(1);
}

/// Is `true` for bytes between words.
fn is_mark(byte: u8, syntax: Syntax) -> bool {
    match syntax {
        Syntax::Json => b"{}[],:\"".contains(&byte),
        Syntax::Text => b"{}[](), \"".contains(&byte),
    }
}

fn text(word: &[u8]) -> String {
    String::from_utf8_lossy(word).into_owned()
}

impl Next {
    /// Describes the continuations, one per line.
    pub(super) fn describe(&self, signatures: &Signatures, acceptor: &Acceptor) -> String {
        let place = PrefixEnd::of(acceptor.bytes());
        let mut text = "may follow:\n".to_owned();
        for free in &self.free {
            text.push_str(&format!("  {free}\n"));
        }
        let width = self.words.iter().map(|word| word.chars().count()).max().unwrap_or_default().min(24);
        for word in &self.words {
            let description = match self.syntax {
                Syntax::Json => describe(signatures, &place, word),
                Syntax::Text => describe_text(signatures, word),
            };
            let line = format!("  {word:width$}  {description}");
            text.push_str(line.trim_end());
            text.push('\n');
        }
        if self.is_cut {
            text.push_str("  … and more\n");
        }
        if self.words.is_empty() && self.free.is_empty() {
            text.push_str(&format!("  nothing after {}\n", quoted(acceptor.bytes())));
        }
        text
    }
}

/// Maximum number of tokens that are shown.
const SHOWN: usize = 32;

/// Vocabularies that the feature `tiktoken` builds in.
const ENCODINGS: [&str; 2] = ["cl100k", "o200k"];

/// Builds the vocabulary of an encoding.
fn encoding(name: &str) -> Result<Vocabulary, CliError> {
    #[cfg(feature = "tiktoken")]
    if let Some(encoding) = motet_decode::vocabulary::Encoding::named(name) {
        return Vocabulary::of_encoding(encoding)
            .map_err(|error| CliError::Message(format!("`{name}`: {error}")));
    }
    Err(CliError::Message(format!(
        "this build of motet does not contain `{name}`; give a tokenizer file, or install motet with \
         `--features tiktoken`"
    )))
}

/// Reads the vocabulary of an encoding or a file.
pub(super) fn read_vocabulary(name: &str, end: Option<&str>) -> Result<Vocabulary, CliError> {
    if ENCODINGS.contains(&name.strip_suffix("_base").unwrap_or(name)) {
        if end.is_some() {
            return Err(CliError::Message(format!("`{name}` defines its end; `--end` is only for files")));
        }
        return encoding(name);
    }
    let end = match end {
        None => EndToken::Known,
        Some(end) => end.parse().map_or(EndToken::Named(end), EndToken::Number),
    };
    let path = Path::new(name);
    let unread = |source| CliError::read(path, source);
    let file = std::fs::File::open(path).map_err(unread)?;
    let mut bytes = Vec::new();
    // One byte above the limit shows that the file is too large.
    file.take(MAX_FILE_BYTES as u64 + 1).read_to_end(&mut bytes).map_err(unread)?;
    Vocabulary::from_file(&bytes, end).map_err(|error| CliError::Message(format!("`{name}`: {error}")))
}

/// Describes the tokens that may follow an accepted prefix.
pub(super) fn describe_tokens(
    prepared: &AcceptorFactory,
    vocabulary: &Vocabulary,
    prefix: &[u8],
    budget: usize,
) -> Result<String, CliError> {
    let decoder = prepared.decoder(vocabulary, budget);
    let mut decoder =
        decoder.ok_or_else(|| CliError::Message(format!("no policy fits into {budget} bytes")))?;
    decoder.acceptor().accept(prefix);
    let mask = decoder.mask();
    let may = |token: &u32| mask.get(*token as usize / 32).is_some_and(|word| word >> (token % 32) & 1 == 1);
    let count = u32::try_from(vocabulary.len()).unwrap_or(u32::MAX);
    let tokens: Vec<u32> = (0..count).filter(may).collect();
    let mut text = format!("tokens: {} of {count}\n", tokens.len());
    for token in tokens.iter().take(SHOWN) {
        let bytes = vocabulary.bytes(*token);
        let shown = if bytes.is_empty() { "the end".to_owned() } else { quoted(bytes) };
        text.push_str(&format!("  {token} {shown}\n"));
    }
    if tokens.len() > SHOWN {
        text.push_str(&format!("  … {} more\n", tokens.len() - SHOWN));
    }
    Ok(text)
}

/// Bytes as a JSON string.
pub(super) fn quoted(bytes: &[u8]) -> String {
    serde_json::Value::from(String::from_utf8_lossy(bytes)).to_string()
}

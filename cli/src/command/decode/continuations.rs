//! Position in a policy at which a prefix ends, and descriptions of the words that may follow there.

use motet_compiler::Signatures;
use motet_compiler::signature::Type;

/// Innermost JSON object of a prefix, and the key whose value comes next.
#[derive(Debug, Default)]
pub(super) struct PrefixEnd {
    /// First key of the object, such as `do`, `is` or `end`.
    kind: String,
    /// Value of the first key; empty if it is not written yet.
    pub(super) name: String,
    pub(super) key: String,
    /// Part of the word that is written already.
    pub(super) started: String,
}

impl PrefixEnd {
    /// End of a prefix in JSON without white space.
    pub(super) fn of(prefix: &[u8]) -> Self {
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
    pub(super) fn words<'s>(&self, signatures: &'s Signatures) -> Vec<&'s str> {
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
    pub(super) fn is_call(&self) -> bool {
        self.kind == "do" && self.key == "do"
    }

    /// Is `true` if an argument of a call comes next.
    pub(super) fn is_argument(&self) -> bool {
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
pub(super) fn describe(signatures: &Signatures, place: &PrefixEnd, word: &str) -> String {
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
pub(super) fn describe_text(signatures: &Signatures, word: &str) -> String {
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
        (_, "let") => "a call with a result",
        (_, "end") => "an ending: done, fail or replan",
        (_, "sequence") => "a named group of steps",
        (_, "if") => "steps under a condition",
        (_, "wait") => "waits until a condition holds",
        (_, "monitor") => "steps with conditions that are monitored",
        (_, "try") => "steps with handlers of failures",
        (_, "repeat") => "a loop",
        (_, "each") => "a loop over a list",
        (_, "parallel") => "parallel branches",
        (_, "is") => "a fluent",
        (_, "get") => "a comparison of a measure",
        (_, "field") => "a comparison of a field",
        (_, "not" | "all" | "any") => "a combined condition",
        (_, "react") => "a reaction: pause, restart or resume",
        (_, "null") => "no value",
        _ => "",
    }
}

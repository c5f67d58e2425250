//! Parameters of macros.

/// Parameter of a macro.
#[derive(Clone)]
pub(super) struct Parameter {
    pub(super) name: String,
    pub(super) kind: ParameterKind,
}

/// What a call gives for a parameter.
#[derive(Clone)]
pub(super) enum ParameterKind {
    Needed,
    /// Default, and whether the value of the caller's property of this name counts before it.
    Default(Option<String>, bool),
    /// Block: the next element of the call, or what is in it.
    Block(bool),
}

/// Reads `a b:=1 c:=^ d:=^|2 *e **f`.
pub(super) fn parameters(text: &str) -> Result<Vec<Parameter>, String> {
    let mut parameters = Vec::new();
    for word in words(text) {
        let (name, kind) = match word.split_once(":=").or_else(|| word.split_once('=')) {
            Some((name, default)) => {
                let (is_passed, default) = match default.strip_prefix('^') {
                    Some("") => (true, None),
                    Some(rest) => (true, rest.strip_prefix('|').map(unquoted)),
                    None => (false, Some(unquoted(default))),
                };
                (name, ParameterKind::Default(default, is_passed))
            }
            None => match (word.strip_prefix("**"), word.strip_prefix('*')) {
                (Some(name), _) => (name, ParameterKind::Block(true)),
                (None, Some(name)) => (name, ParameterKind::Block(false)),
                (None, None) => (word.as_str(), ParameterKind::Needed),
            },
        };
        if name.is_empty() {
            return Err(format!("`{word}` is no parameter"));
        }
        parameters.push(Parameter { name: name.to_owned(), kind });
    }
    Ok(parameters)
}

/// Words between blanks, with quotes and `${…}` in one piece.
fn words(text: &str) -> Vec<String> {
    let (mut words, mut word, mut quote, mut depth) = (Vec::new(), String::new(), None, 0_usize);
    for letter in text.chars() {
        match letter {
            '\'' | '"' if quote.is_none() => quote = Some(letter),
            _ if quote == Some(letter) => quote = None,
            '{' | '(' => depth += 1,
            '}' | ')' => depth = depth.saturating_sub(1),
            _ if letter.is_whitespace() && quote.is_none() && depth == 0 => {
                if !word.is_empty() {
                    words.push(std::mem::take(&mut word));
                }
                continue;
            }
            _ => {}
        }
        word.push(letter);
    }
    if !word.is_empty() {
        words.push(word);
    }
    words
}

fn unquoted(text: &str) -> String {
    let inner = ['\'', '"'].into_iter().find_map(|quote| text.strip_prefix(quote)?.strip_suffix(quote));
    inner.unwrap_or(text).to_owned()
}

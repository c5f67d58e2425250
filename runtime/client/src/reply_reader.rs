//! Reads what a server says: objects of an answer become pieces of a reply, its end and its tokens. A key
//! that the server sends back is cut out, also where it is spread over several pieces.

use std::sync::mpsc::Sender;

use motet_planner::model::{Finish, ModelError, ReplyEvent, TokenUsage};
use serde_json::Value;

use crate::dialect::{self, Dialect, Meaning, WireProtocol, kind};
use crate::settings::{ApiKey, ClientSettings};

/// Number of characters of a server's words that are shown.
const SHOWN_CHARS: usize = 320;

/// Reader of one reply.
pub(crate) struct ReplyReader<'a> {
    protocol: &'static WireProtocol,
    key: Option<&'a ApiKey>,
    news: &'a Sender<ReplyEvent>,
    /// End of the text so far that may be the beginning of a key.
    held: String,
    /// Words with which the model declines, so far.
    refusal: String,
    usage: TokenUsage,
    finish: Option<Finish>,
}

impl<'a> ReplyReader<'a> {
    pub(crate) fn new(settings: &'a ClientSettings, news: &'a Sender<ReplyEvent>) -> Self {
        Self {
            protocol: dialect::protocol(settings.dialect),
            key: settings.key.as_ref(),
            news,
            held: String::new(),
            refusal: String::new(),
            usage: TokenUsage::default(),
            finish: None,
        }
    }

    /// Finish of the reply, once an object has said it.
    pub(crate) const fn finish(&self) -> Option<Finish> {
        self.finish
    }

    /// Takes an object. Returns `true` if none follows.
    pub(crate) fn take(&mut self, text: &str) -> Result<bool, ModelError> {
        let answer: Value = serde_json::from_str(text)
            .map_err(|error| ModelError::Malformed { why: format!("it is no JSON: {error}") })?;
        self.count(&answer);
        if let Some(why) = error(self.protocol, &answer) {
            return Err(ModelError::CutOff { why: self.shown(&why) });
        }
        let refusals = self.protocol.refusals.iter().flat_map(|place| place.texts(&answer));
        self.refusal.extend(refusals);
        let texts = self.protocol.texts.iter().flat_map(|place| place.texts(&answer));
        for said in texts.collect::<Vec<_>>() {
            self.say(&said);
        }
        let mut endings = self.protocol.endings.iter();
        if let Some((means, word)) = endings.find_map(|ending| Some((ending.means, ending.word(&answer)?))) {
            match means {
                Meaning::Ended(finish) if self.refusal.is_empty() => self.finish = Some(finish),
                Meaning::Ended(_) => return Err(self.declined("")),
                Meaning::Declined => return Err(self.declined(&word)),
                Meaning::Broken => return Err(ModelError::CutOff { why: self.shown(&word) }),
            }
        }
        Ok(self.protocol.last.contains(&kind(&answer)))
    }

    /// Passes on what is held back, and the number of tokens. To be called at the end.
    pub(crate) fn close(&mut self) {
        let rest = std::mem::take(&mut self.held);
        self.pass(rest);
        if self.usage != TokenUsage::default() {
            let _ = self.news.send(ReplyEvent::Used(self.usage));
        }
    }

    fn say(&mut self, text: &str) {
        self.held.push_str(text);
        let Some(key) = self.key else {
            let whole = std::mem::take(&mut self.held);
            return self.pass(whole);
        };
        let mut ready = key.cut_from(&self.held);
        let kept = key.begun_at(&ready);
        self.held = ready.split_off(kept);
        self.pass(ready);
    }

    fn pass(&self, text: String) {
        if !text.is_empty() {
            // Who no longer listens has hung up, and this task is being ended.
            let _ = self.news.send(ReplyEvent::Piece(text));
        }
    }

    fn count(&mut self, answer: &Value) {
        let number = |paths: &[&str]| paths.iter().find_map(|path| answer.pointer(path)?.as_u64());
        let (input, output) = self.protocol.tokens;
        self.usage.input = number(input).or(self.usage.input);
        self.usage.output = number(output).or(self.usage.output);
    }

    fn declined(&self, word: &str) -> ModelError {
        let why = if self.refusal.is_empty() { word } else { &self.refusal };
        ModelError::Declined { why: self.shown(why) }
    }

    fn shown(&self, why: &str) -> String {
        shown(self.key, why)
    }
}

/// Message of an error in an answer.
fn error(protocol: &WireProtocol, answer: &Value) -> Option<String> {
    protocol.errors.iter().find_map(|place| place.texts(answer).next())
}

/// Words of a server in one line, without the key, and not too many.
pub(crate) fn shown(key: Option<&ApiKey>, words: &str) -> String {
    let cut = |words: &str| key.map_or_else(|| words.to_owned(), |key| key.cut_from(words));
    let words = cut(words).split_whitespace().collect::<Vec<_>>().join(" ");
    // The key may have been broken by the white space.
    cut(&words).chars().take(SHOWN_CHARS).collect()
}

/// Texts of a whole answer without a key.
pub(crate) fn without_key(key: &ApiKey, answer: &mut Value) {
    match answer {
        Value::String(text) => *text = key.cut_from(text),
        Value::Array(items) => items.iter_mut().for_each(|item| without_key(key, item)),
        Value::Object(keys) => keys.values_mut().for_each(|value| without_key(key, value)),
        Value::Null | Value::Bool(_) | Value::Number(_) => {}
    }
}

/// The text of a whole answer in the protocol of a dialect; `None` if it has none.
///
/// ```
/// use motet_client::dialect::Dialect;
/// use serde_json::json;
///
/// let openai = json!({"choices": [{"message": {"role": "assistant", "content": "yes"}}]});
/// assert_eq!(motet_client::content(None, &openai).as_deref(), Some("yes"));
/// let ollama = json!({"message": {"content": "no"}, "done": true});
/// assert_eq!(motet_client::content(Some(Dialect::Ollama), &ollama).as_deref(), Some("no"));
/// let anthropic = json!({"type": "message", "content": [{"type": "text", "text": "maybe"}]});
/// assert_eq!(motet_client::content(Some(Dialect::Anthropic), &anthropic).as_deref(), Some("maybe"));
/// ```
#[must_use]
pub fn content(dialect: Option<Dialect>, answer: &Value) -> Option<String> {
    let texts = dialect::protocol(dialect).texts.iter().flat_map(|place| place.texts(answer));
    texts.reduce(|all, next| all + &next)
}

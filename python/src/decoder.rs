//! Environments, vocabularies and decoders. Names of files and tokenizers of other libraries are handled in
//! `motet/*.py`.

use motet_decode::vocabulary::Encoding;
use motet_decode::{AcceptorFactory, EndToken, Environment as Texts, Modifiers, Session, Subset};
use motet_syntax::{FileId, Source, Sources, Syntax, render};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::errors::wrong;

/// The tokens of a language model.
#[pyclass(frozen, module = "motet._motet")]
pub(crate) struct Vocabulary(motet_decode::Vocabulary);

#[pymethods]
impl Vocabulary {
    /// Reads tokenizer.json, a list in JSON or lines in base64. `end` is the name or the number of the
    /// token that ends a sequence; the default is the token with a well-known name.
    #[staticmethod]
    #[pyo3(signature = (file, end = None))]
    fn from_file(py: Python<'_>, file: &[u8], end: Option<EndOfSequence>) -> PyResult<Self> {
        py.detach(|| motet_decode::Vocabulary::from_file(file, EndOfSequence::as_end(end.as_ref())))
            .map(Self)
            .map_err(wrong)
    }

    /// The vocabulary `cl100k` or `o200k`.
    #[staticmethod]
    fn of_encoding(py: Python<'_>, name: &str) -> PyResult<Self> {
        let encoding = Encoding::named(name)
            .ok_or_else(|| wrong(format!("there is no encoding `{name}`: cl100k or o200k")))?;
        py.detach(|| motet_decode::Vocabulary::of_encoding(encoding)).map(Self).map_err(wrong)
    }

    /// Tokens as bytes in the order of their numbers; one without bytes is special.
    #[staticmethod]
    fn from_tokens(py: Python<'_>, tokens: Vec<Vec<u8>>, end: u32) -> PyResult<Self> {
        py.detach(|| motet_decode::Vocabulary::from_tokens(tokens, end)).map(Self).map_err(wrong)
    }

    /// The token that ends a sequence.
    #[getter]
    fn end(&self) -> u32 {
        self.0.end()
    }

    fn __len__(&self) -> usize {
        self.0.len()
    }

    /// The bytes of a token.
    fn token<'py>(&self, py: Python<'py>, token: u32) -> Bound<'py, PyBytes> {
        PyBytes::new(py, self.0.bytes(token))
    }

    /// The tokens of a text, the longest first at each place.
    fn tokenize(&self, py: Python<'_>, text: &[u8]) -> Vec<u32> {
        py.detach(|| self.0.tokenize(text))
    }
}

/// The token that ends a sequence, by its name or its number.
#[derive(FromPyObject)]
enum EndOfSequence {
    Number(u32),
    Name(String),
}

impl EndOfSequence {
    fn as_end(end: Option<&Self>) -> EndToken<'_> {
        match end {
            None => EndToken::Known,
            Some(Self::Number(number)) => EndToken::Number(*number),
            Some(Self::Name(name)) => EndToken::Named(name),
        }
    }
}

/// A robot, a scene and facts, prepared.
#[pyclass(frozen, module = "motet._motet")]
pub(crate) struct Environment {
    session: Session,
    prepared: AcceptorFactory,
}

#[pymethods]
impl Environment {
    /// Takes names of built-in robots and scenes, or texts.
    #[new]
    #[expect(clippy::too_many_arguments, reason = "they are keywords")]
    #[pyo3(signature = (
        *, robot = None, declarations = None, scene = None, state = None, domain = None,
        modifiers = false, text = false
    ))]
    fn new(
        py: Python<'_>,
        robot: Option<&str>,
        declarations: Option<&str>,
        scene: Option<&str>,
        state: Option<&str>,
        domain: Option<&str>,
        modifiers: bool,
        text: bool,
    ) -> PyResult<Self> {
        let texts = Texts { robot, declarations, scene, state, domain };
        let session = py.detach(|| texts.session()).map_err(wrong)?;
        let modifiers = if modifiers { Modifiers::Written } else { Modifiers::Default };
        let syntax = if text { Syntax::Text } else { Syntax::Json };
        let subset = Subset { syntax, modifiers, ..Subset::default() };
        let prepared = py.detach(|| AcceptorFactory::new(&session, subset));
        Ok(Self { session, prepared })
    }

    /// The diagnostics of a policy in either syntax: JSON objects, one a line.
    fn check(&self, py: Python<'_>, policy: &str) -> String {
        py.detach(|| {
            let (source, sources) = sources(policy);
            let parsed = motet_syntax::read(&source, FileId(0));
            render::json(&self.session.check(&parsed), &sources)
        })
    }

    /// Creates a decoder for a policy of at most `budget` bytes.
    fn decoder(&self, py: Python<'_>, vocabulary: &Vocabulary, budget: usize) -> PyResult<Decoder> {
        let decoder = py.detach(|| self.prepared.decoder(&vocabulary.0, budget));
        let decoder = decoder.ok_or_else(|| wrong(format!("no policy has at most {budget} bytes")))?;
        Ok(Decoder { decoder, words: vocabulary.0.len().div_ceil(32) })
    }
}

/// Follows one policy token by token.
#[pyclass(module = "motet._motet")]
pub(crate) struct Decoder {
    decoder: motet_decode::Decoder,
    /// The number of words of a mask.
    words: usize,
}

#[pymethods]
impl Decoder {
    /// The mask, one bit per token, the lowest first, in 32-bit words of the machine's order.
    #[pyo3(signature = (effort = None))]
    fn mask<'py>(&mut self, py: Python<'py>, effort: Option<u64>) -> Bound<'py, PyBytes> {
        let words = self.words;
        let mask = py.detach(|| {
            let mask = match effort {
                Some(effort) => self.decoder.mask_within(effort),
                None => self.decoder.mask(),
            };
            mask.get(..words).unwrap_or_default().to_vec()
        });
        let bytes: Vec<u8> = mask.iter().flat_map(|word| word.to_ne_bytes()).collect();
        PyBytes::new(py, &bytes)
    }

    /// Takes a token if it may follow.
    fn accept(&mut self, py: Python<'_>, token: u32) -> bool {
        py.detach(|| self.decoder.accept(token))
    }

    /// The text that must come next; empty if there is a choice.
    fn forced(&mut self, py: Python<'_>) -> String {
        py.detach(|| String::from_utf8_lossy(&self.decoder.acceptor().forced()).into_owned())
    }

    /// Takes back the last tokens.
    #[pyo3(signature = (tokens = 1))]
    fn rollback(&mut self, py: Python<'_>, tokens: usize) {
        py.detach(|| self.decoder.rollback(tokens));
    }

    /// The errors of the checker for a text that may not follow: JSON objects, one a line.
    fn why_not(&mut self, py: Python<'_>, text: &str) -> String {
        py.detach(|| {
            let acceptor = self.decoder.acceptor();
            let (_, sources) = sources(&(String::from_utf8_lossy(acceptor.bytes()) + text));
            render::json(&acceptor.why_not(text.as_bytes()), &sources)
        })
    }

    /// The text so far.
    #[getter]
    fn text(&mut self) -> String {
        String::from_utf8_lossy(self.decoder.acceptor().bytes()).into_owned()
    }

    /// Returns `true` if the last mask may have tokens that cannot follow.
    #[getter]
    fn is_wide(&self) -> bool {
        self.decoder.is_wide()
    }

    /// Returns `true` if the text so far is a whole policy.
    #[getter]
    fn is_accepting(&mut self, py: Python<'_>) -> bool {
        py.detach(|| self.decoder.acceptor().is_accepting())
    }

    /// Another decoder in the same state.
    fn clone(&self) -> Self {
        Self { decoder: self.decoder.clone(), words: self.words }
    }
}

fn sources(text: &str) -> (Source, Sources) {
    let mut sources = Sources::default();
    let source = Source::new("policy", text);
    sources.add(source.clone());
    (source, sources)
}

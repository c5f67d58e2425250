//! The notation of the files under `english/`: named lists of templates, and their parser.
//!
//! A list is a name in the first column with a colon, and templates on the indented lines below it. A
//! template is a row of words with `(a|b)` for alternatives, `[a]` for an optional part, `a*` and `a+` for
//! repetition, and `<name>` for another list. Several templates may share a line, divided by `|`. `=> value`
//! behind a template gives what it stands for. A line in quotes is an example; the tests hold that one
//! reaches each template. `#` begins a comment. The notation is that of JSGF with the layout of hassil's
//! sentence files. [`crate::engine::phrases`] compiles what is read here.
//!
//! A list of rules has slots besides: `{noun}` reads a noun, `{thing:noun}` keeps it under another name, and
//! `{x:<list>}` keeps what a list reads. `&a` and `!a` look ahead, `^a` and `!^a` look back, `,` and `.` are
//! the marks of a sentence. `=> put {thing}` writes what takes the place of all that was read, or is the
//! value of the rule in another one. [`crate::engine::rule`] interprets them.

use std::collections::BTreeMap;
use std::fmt;

/// A part of a template.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) enum Part {
    Word(&'static str),
    /// A reference to another list.
    List(&'static str),
    Sequence(Vec<Part>),
    Choice(Vec<Part>),
    /// Zero or more times.
    Repeat(Box<Part>),
    /// A part whose words are kept under a name.
    Slot(&'static str, Box<Part>),
    /// A reader of [`crate::engine::reader`] by its number, with its argument.
    Read(usize, &'static str),
    /// A part that stands here, or does not, and is not taken.
    Look(Side, bool, Box<Part>),
}

/// The side of a place on which a part is looked for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Side {
    Ahead,
    Behind,
}

/// One template of a list, with the value that it stands for.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Template {
    pub(crate) part: Part,
    pub(crate) value: Option<&'static str>,
}

/// All lists of a language, by name.
pub(crate) type Lists = BTreeMap<&'static str, Vec<Template>>;

/// A line that is not in the notation.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct TemplateError {
    pub(crate) line: usize,
    pub(crate) why: String,
}

impl fmt::Display for TemplateError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}: {}", self.line, self.why)
    }
}

/// Reads the lists of a file into `lists`. O(bytes).
///
/// # Errors
///
/// The first line that is not in the notation, or that names a list a second time.
pub(crate) fn read(text: &'static str, lists: &mut Lists) -> Result<(), TemplateError> {
    let mut current: Option<&'static str> = None;
    for (index, line) in text.lines().enumerate() {
        let line_error = |why: String| TemplateError { line: index + 1, why };
        let content = line.split('#').next().unwrap_or_default().trim_end();
        if content.trim().is_empty() {
            continue;
        }
        if !content.starts_with(' ') {
            let name = content.strip_suffix(':').filter(|name| is_name(name));
            let name = name.ok_or_else(|| line_error(format!("`{content}` is no name of a list")))?;
            if lists.insert(name, Vec::new()).is_some() {
                return Err(line_error(format!("the list `{name}` is defined twice")));
            }
            current = Some(name);
            continue;
        }
        if content.trim_start().starts_with('"') {
            continue;
        }
        let Some(name) = current else {
            return Err(line_error("a template stands before the first name of a list".to_owned()));
        };
        let (said, value) = match content.split_once("=>") {
            Some((said, value)) => (said, Some(value.trim())),
            None => (content, None),
        };
        let part = parse(said).map_err(line_error)?;
        // The alternatives of a line are templates of their own.
        let parts = match part {
            Part::Choice(parts) => parts,
            one => vec![one],
        };
        let templates = parts.into_iter().map(|part| Template { part, value });
        lists.entry(name).or_default().extend(templates);
    }
    Ok(())
}

/// An example of a file: its list, what the list reads, and for a rule what takes its place.
#[cfg(test)]
pub(crate) type Example = (&'static str, &'static str, Option<&'static str>);

/// The examples of a file.
#[cfg(test)]
pub(crate) fn examples(text: &'static str) -> Vec<Example> {
    let mut examples = Vec::new();
    let mut current = "";
    for line in text.lines() {
        if let Some(name) = line.strip_suffix(':') {
            current = name;
        } else if let Some(example) = line.trim().strip_prefix('"').and_then(|rest| rest.strip_suffix('"')) {
            match example.split_once("\" => \"") {
                Some((said, becomes)) => examples.push((current, said, Some(becomes))),
                None => examples.push((current, example, None)),
            }
        }
    }
    examples
}

/// Parses one template.
///
/// # Errors
///
/// A description of the fault.
pub(crate) fn parse(text: &'static str) -> Result<Part, String> {
    let mut parser = Parser { rest: text };
    let part = parser.choice()?;
    if parser.rest.is_empty() { Ok(part) } else { Err(format!("`{}` is left over", parser.rest)) }
}

fn is_name(name: &str) -> bool {
    !name.is_empty()
        && name.bytes().all(|byte| byte.is_ascii_lowercase() || byte.is_ascii_digit() || byte == b'_')
}

struct Parser {
    rest: &'static str,
}

impl Parser {
    fn choice(&mut self) -> Result<Part, String> {
        let mut parts = vec![self.sequence()?];
        while self.take('|') {
            parts.push(self.sequence()?);
        }
        Ok(one_or(parts, Part::Choice))
    }

    fn sequence(&mut self) -> Result<Part, String> {
        let mut parts = Vec::new();
        while let Some(part) = self.item()? {
            parts.push(part);
        }
        if parts.is_empty() {
            return Err("an alternative is empty".to_owned());
        }
        Ok(one_or(parts, Part::Sequence))
    }

    fn item(&mut self) -> Result<Option<Part>, String> {
        self.rest = self.rest.trim_start();
        for (mark, is_wanted) in [('&', true), ('!', false), ('^', true)] {
            if self.take(mark) {
                let side = if mark == '^' || self.take('^') { Side::Behind } else { Side::Ahead };
                let part = self.item()?.ok_or("nothing stands behind a look")?;
                return Ok(Some(Part::Look(side, is_wanted, Box::new(part))));
            }
        }
        let part = if self.take('(') {
            let part = self.choice()?;
            self.expect(')')?;
            part
        } else if self.take('{') {
            self.slot()?
        } else if self.take(',') {
            Part::Word(",")
        } else if self.take('[') {
            let part = self.choice()?;
            self.expect(']')?;
            Part::Choice(vec![part, Part::Sequence(Vec::new())])
        } else if self.take('<') {
            let (name, rest) = self.rest.split_once('>').ok_or("`<` has no `>`")?;
            self.rest = rest;
            if !is_name(name) {
                return Err(format!("`{name}` is no name of a list"));
            }
            Part::List(name)
        } else {
            let is_word = |letter: char| letter.is_alphanumeric() || matches!(letter, '\'' | '.');
            let end = self.rest.find(|letter| !is_word(letter)).unwrap_or(self.rest.len());
            let (word, rest) = self.rest.split_at_checked(end).unwrap_or_default();
            if word.is_empty() {
                return Ok(None);
            }
            self.rest = rest;
            Part::Word(word)
        };
        if self.take('*') {
            return Ok(Some(Part::Repeat(Box::new(part))));
        }
        if self.take('+') {
            return Ok(Some(Part::Sequence(vec![part.clone(), Part::Repeat(Box::new(part))])));
        }
        self.rest = self.rest.trim_start();
        Ok(Some(part))
    }

    /// `name}`, `kind argument}`, `name:kind argument}`, `name:<list>}`, `name:(a|b)}`.
    fn slot(&mut self) -> Result<Part, String> {
        let end = self.rest.find([':', '}']).ok_or("`{` has no `}`")?;
        let (name, rest) = self.rest.split_at(end);
        let is_named = rest.starts_with(':');
        let inner = rest.trim_start_matches(':');
        if is_named && inner.starts_with(['<', '(']) {
            self.rest = inner;
            let part = self.item()?.ok_or("a slot is empty")?;
            self.expect('}')?;
            return Ok(Part::Slot(name, Box::new(part)));
        }
        let (reader, rest) =
            inner.split_once('}').filter(|_| is_named).unwrap_or((name, inner.get(1..).unwrap_or("")));
        self.rest = rest;
        let (kind, argument) = reader.split_once(' ').unwrap_or((reader, ""));
        let number = crate::engine::reader::number(kind).ok_or_else(|| format!("nothing reads `{kind}`"))?;
        let name = if is_named { name } else { kind };
        Ok(Part::Slot(name, Box::new(Part::Read(number, argument))))
    }

    fn take(&mut self, mark: char) -> bool {
        let rest = self.rest.trim_start().strip_prefix(mark);
        if let Some(rest) = rest {
            self.rest = rest.trim_start();
        }
        rest.is_some()
    }

    fn expect(&mut self, mark: char) -> Result<(), String> {
        if self.take(mark) { Ok(()) } else { Err(format!("a `{mark}` is missing before `{}`", self.rest)) }
    }
}

fn one_or(mut parts: Vec<Part>, several: fn(Vec<Part>) -> Part) -> Part {
    match parts.pop() {
        Some(only) if parts.is_empty() => only,
        last => {
            parts.extend(last);
            several(parts)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Lists, Part, parse, read};

    #[test]
    fn template_parts_nest() {
        let word = |word| Part::Word(word);
        assert_eq!(parse("bring me"), Ok(Part::Sequence(vec![word("bring"), word("me")])));
        assert_eq!(
            parse("(that|it) is"),
            Ok(Part::Sequence(vec![Part::Choice(vec![word("that"), word("it")]), word("is"),]))
        );
        assert_eq!(parse("<how>*"), Ok(Part::Repeat(Box::new(Part::List("how")))));
        for wrong in ["(a", "a)", "[]", "<A>", "a||b", "a $"] {
            assert!(parse(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn template_file_is_read_by_line() {
        let mut lists = Lists::new();
        assert_eq!(read("# how\nhow:\n  very | so\n  brought => bring\n", &mut lists), Ok(()));
        let how = &lists["how"];
        assert_eq!(how.len(), 3);
        assert_eq!(how[2].value, Some("bring"));
        assert_eq!(read("how:\n", &mut lists).unwrap_err().line, 1);
        assert!(read("  very\n", &mut Lists::new()).is_err());
    }
}

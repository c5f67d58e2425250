//! Classes of the words of a document, for colours: names by what they are declared as, and the words,
//! numbers and texts around them.

use std::collections::BTreeMap;

use motet_syntax::text::lexer::{Token, TokenKind, tokens as lexed};
use motet_syntax::words::is_keyword;
use motet_syntax::{Parsed, Syntax, unit};

use super::declarations::{DeclarationKind, Declarations};
use super::names::{NameSpace, Occurrence, occurrences};

/// Class of a token.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(crate) enum TokenClass {
    Keyword,
    Comment,
    Text,
    Number,
    Callable,
    Relation,
    Type,
    Entity,
    Case,
    Failure,
    Local,
    Label,
    Robot,
    Group,
}

/// Token with its class.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct ClassedToken {
    pub(crate) start: usize,
    pub(crate) end: usize,
    pub(crate) class: TokenClass,
    pub(crate) is_declaration: bool,
    /// True for a name that the library or the robot declares.
    pub(crate) is_library: bool,
}

/// Tokens with classes, in order, none over more than one line but texts. In JSON only the names have a
/// class: editors colour the rest. O(bytes).
pub(crate) fn tokens(parsed: &Parsed, project: &Declarations) -> Vec<ClassedToken> {
    let own = Declarations::of_file(&parsed.file);
    let all = occurrences(parsed);
    let class_of = |place: &Occurrence| {
        let declared = own.get(place.space, &place.name);
        let library = project.get(place.space, &place.name);
        let class = class(place, declared.or(library).map(|found| found.kind))?;
        let range = place.span.range();
        Some(ClassedToken {
            start: range.start,
            end: range.end,
            class,
            is_declaration: place.is_declaration,
            is_library: declared.is_none() && library.is_some(),
        })
    };
    let names = all.iter().filter_map(class_of);
    if parsed.syntax == Syntax::Json {
        return names.collect();
    }
    let mut named: BTreeMap<usize, ClassedToken> = names.map(|token| (token.start, token)).collect();
    let mut found = Vec::new();
    let mut before: Option<Token<'_>> = None;
    for token in lexed(&parsed.text, 0) {
        let (start, end) = (token.start, token.end());
        // The place of a name is behind its quote.
        let at = if token.kind == TokenKind::Quoted { start + 1 } else { start };
        let name = named.remove(&at);
        match (name, word_class(token, before)) {
            (Some(name), _) => found.push(name),
            (None, Some(TokenClass::Text)) => {
                // Names in the braces of a text stand out of it.
                let inner: Vec<_> = named.range(start..end).map(|(_, name)| *name).collect();
                let mut at = start;
                for name in inner {
                    found.push(plain(at, name.start, TokenClass::Text));
                    found.push(name);
                    at = name.end;
                }
                found.push(plain(at, end, TokenClass::Text));
            }
            (None, Some(class)) => found.push(plain(start, end, class)),
            (None, None) => {}
        }
        before = Some(token);
    }
    found.retain(|token| token.start < token.end);
    found
}

fn plain(start: usize, end: usize, class: TokenClass) -> ClassedToken {
    ClassedToken { start, end, class, is_declaration: false, is_library: false }
}

fn class(place: &Occurrence, declared: Option<DeclarationKind>) -> Option<TokenClass> {
    Some(match (place.space, declared) {
        (NameSpace::Callable, _) => TokenClass::Callable,
        (NameSpace::Relation, _) => TokenClass::Relation,
        (NameSpace::Type, _) => TokenClass::Type,
        (NameSpace::Value, Some(DeclarationKind::Case)) => TokenClass::Case,
        (NameSpace::Value, Some(DeclarationKind::Failure)) => TokenClass::Failure,
        (NameSpace::Value, Some(_)) => TokenClass::Entity,
        // A text of JSON, or a name that nothing declares.
        (NameSpace::Value, None) => return None,
        (NameSpace::Local, _) => TokenClass::Local,
        (NameSpace::Label, _) => TokenClass::Label,
        (NameSpace::Robot, _) => TokenClass::Robot,
        (NameSpace::Resource | NameSpace::Motion | NameSpace::Group, _) => TokenClass::Group,
    })
}

fn word_class(token: Token<'_>, before: Option<Token<'_>>) -> Option<TokenClass> {
    match token.kind {
        TokenKind::Comment | TokenKind::Doc => Some(TokenClass::Comment),
        TokenKind::Text => Some(TokenClass::Text),
        TokenKind::Number => Some(TokenClass::Number),
        TokenKind::Word => {
            let text = token.text;
            let is_unit = before.is_some_and(|before| {
                before.kind == TokenKind::Number && unit::parse_quantity(&format!("1 {text}")).is_some()
            });
            if is_unit { Some(TokenClass::Number) } else { is_keyword(text).then_some(TokenClass::Keyword) }
        }
        TokenKind::Quoted | TokenKind::Mark | TokenKind::Open => None,
    }
}

#[cfg(test)]
mod tests {
    use motet_syntax::{FileId, Source};

    use crate::editor::declarations::Declarations;

    fn shown(text: &str) -> Vec<String> {
        let parsed = motet_syntax::read(&Source::new("", text), FileId(0));
        let tokens = super::tokens(&parsed, &Declarations::default());
        let mut at = 0;
        let shown = tokens.iter().map(|token| {
            assert!(at <= token.start && token.start < token.end, "{token:?}");
            at = token.end;
            format!("{:?} {}", token.class, text.get(token.start..token.end).unwrap())
        });
        shown.collect()
    }

    #[test]
    fn tokens_have_the_class_of_their_names() {
        let text = "entity cup: Object // ok\npolicy within for hsr { let x = ask(\"a {x} b\") go(cup) \
            within 3 cm }";
        assert_eq!(
            shown(text),
            [
                "Keyword entity",
                "Entity cup",
                "Type Object",
                "Comment // ok",
                "Keyword policy",
                "Callable within",
                "Keyword for",
                "Robot hsr",
                "Keyword let",
                "Local x",
                "Callable ask",
                "Text \"a {",
                "Local x",
                "Text } b\"",
                "Callable go",
                "Entity cup",
                "Keyword within",
                "Number 3",
                "Number cm"
            ]
        );
        let json = r#"{"policy": "p", "steps": [{"do": "detect", "what": "red", "as": "x"}]}"#;
        assert_eq!(shown(json), ["Callable p", "Callable detect", "Label what", "Local x"]);
    }
}

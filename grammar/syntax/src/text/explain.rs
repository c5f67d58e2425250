//! What the grammar refuses, in plain words: what was expected at the furthest place that the parser reached, what is
//! there instead, and what other languages' habit explains it.

use pest::error::{Error, ErrorVariant, InputLocation};

use super::Rule;
use super::errors::{TextSyntax, UnknownUnit};
use super::token::{Token, TokenKind, tokens};
use crate::diagnostic::Diagnostic;
use crate::errors::Empty;
use crate::source::{FileId, Span};
use crate::suggest;

/// The diagnostic for an error of the parser.
pub(super) fn explain(text: &str, error: &Error<Rule>, file: FileId) -> Diagnostic {
    let at = match error.location {
        InputLocation::Pos(at) | InputLocation::Span((at, _)) => at,
    };
    let expected: &[Rule] = match &error.variant {
        ErrorVariant::ParsingError { positives, .. } => positives,
        ErrorVariant::CustomError { .. } => &[],
    };
    let place = Place::find(text, at, expected);
    if let Some(unit) = place.unknown_unit() {
        return UnknownUnit { span: unit.span(file), unit: unit.text.into() }.into();
    }
    if place.found.is_none() && place.before.is_none() {
        return Empty { span: Span::new(file, 0, 0) }.into();
    }
    let end = text.trim_end().len();
    let span = place.found.map_or(Span::new(file, end, end), |token| token.span(file));
    let found = match place.found {
        None => "the end of the text".into(),
        Some(token) if token.kind == TokenKind::Doc => "a `///` comment".into(),
        Some(token) if token.kind == TokenKind::Text => format!("the text {}", short(token.text)),
        Some(token) => format!("`{}`", short(token.text)),
    };
    let message = match words(expected) {
        Some(expected) => format!("expected {expected}, found {found}"),
        None => format!("{found} does not fit here"),
    };
    let (help, fix) = place.advice();
    TextSyntax { span, message, help, related: None, fix }.into()
}

fn short(text: &str) -> String {
    if text.chars().count() <= 30 {
        return text.into();
    }
    text.chars().take(29).chain(['…']).collect()
}

/// The rules that could have gone on, as a phrase.
fn words(expected: &[Rule]) -> Option<String> {
    let mut labels: Vec<(u8, &'static str)> = expected.iter().filter_map(|rule| label(*rule)).collect();
    labels.sort_unstable();
    labels.dedup();
    let has = |words: &str| labels.iter().any(|(_, label)| *label == words);
    let (step, value) = (has(STEP), has(VALUE));
    let only_operator =
        labels.iter().all(|(_, label)| *label == OPERATOR || *label == "`(`" || *label == "`.`");
    labels.retain(|(_, label)| match *label {
        NAME => !step && !value,
        OPERATOR => only_operator,
        "`(`" | "`.`" | "`[`" => !step && !value && labels_len_is_small(expected),
        _ => true,
    });
    match labels.as_slice() {
        [] => None,
        [(_, only)] => Some((*only).into()),
        [rest @ .., (_, last)] => {
            let rest: Vec<&str> = rest.iter().take(5).map(|(_, label)| *label).collect();
            Some(format!("{} or {last}", rest.join(", ")))
        }
    }
}

/// Whether so few rules could have gone on that each is worth naming.
fn labels_len_is_small(expected: &[Rule]) -> bool {
    expected.len() <= 2
}

const STEP: &str = "a step";
const DECLARATION: &str = "a declaration such as `policy`";
const CLAUSE: &str = "a clause such as `needs`";
const VALUE: &str = "a value or a condition";
const NAME: &str = "a name";
const OPERATOR: &str = "an operator";

/// What a rule is called, and its rank in an enumeration; `None` for what nobody would miss.
fn label(rule: Rule) -> Option<(u8, &'static str)> {
    Some(match rule {
        Rule::do_step
        | Rule::sequence
        | Rule::if_else
        | Rule::wait
        | Rule::monitor
        | Rule::try_catch
        | Rule::repeat
        | Rule::each
        | Rule::parallel
        | Rule::end
        | Rule::kw_let
        | Rule::kw_sequence
        | Rule::kw_wait
        | Rule::kw_monitor
        | Rule::kw_try
        | Rule::kw_repeat
        | Rule::kw_parallel
        | Rule::kw_done => (0, STEP),
        Rule::item
        | Rule::kind
        | Rule::fluent
        | Rule::measure
        | Rule::failure
        | Rule::enumeration
        | Rule::entities
        | Rule::initially
        | Rule::closed_world
        | Rule::action
        | Rule::perception
        | Rule::policy
        | Rule::kw_kind
        | Rule::kw_policy => (0, DECLARATION),
        Rule::needs
        | Rule::makes
        | Rule::unsettles
        | Rule::motion
        | Rule::uses
        | Rule::takes
        | Rule::fails
        | Rule::lasts
        | Rule::kw_needs
        | Rule::kw_makes => (4, CLAUSE),
        Rule::expr
        | Rule::operand
        | Rule::quantity
        | Rule::number
        | Rule::text
        | Rule::kw_true
        | Rule::kw_false
        | Rule::kw_not
        | Rule::list
        | Rule::group
        | Rule::arg
        | Rule::quantified => (1, VALUE),
        Rule::name | Rule::names | Rule::call | Rule::param => (2, NAME),
        Rule::type_name | Rule::list_type | Rule::kw_list => (2, "a type"),
        Rule::lt | Rule::gt | Rule::plus | Rule::minus | Rule::times | Rule::over | Rule::eq | Rule::ne => {
            (9, OPERATOR)
        }
        Rule::le | Rule::ge | Rule::kw_or | Rule::kw_and => (9, OPERATOR),
        Rule::block | Rule::lbrace | Rule::cases | Rule::fields => (5, "`{`"),
        Rule::rbrace => (5, "`}`"),
        Rule::args | Rule::params | Rule::lparen => (5, "`(`"),
        Rule::rparen => (5, "`)`"),
        Rule::lbracket => (5, "`[`"),
        Rule::rbracket => (5, "`]`"),
        Rule::comma => (6, "`,`"),
        Rule::colon => (6, "`:`"),
        Rule::arrow | Rule::result => (6, "`->`"),
        Rule::assign => (6, "`=`"),
        Rule::dots => (6, "`..`"),
        Rule::dot | Rule::field => (6, "`.`"),
        Rule::kw_if => (7, "`if`"),
        Rule::kw_else => (7, "`else`"),
        Rule::kw_until | Rule::until => (7, "`until`"),
        Rule::kw_when | Rule::when | Rule::given => (7, "`when`"),
        Rule::kw_then => (7, "`then`"),
        Rule::kw_during => (7, "`during`"),
        Rule::kw_catch | Rule::catch => (7, "`catch`"),
        Rule::kw_in => (7, "`in`"),
        Rule::kw_each => (7, "`each`"),
        Rule::kw_at | Rule::kw_most | Rule::at_most => (7, "`at most`"),
        Rule::kw_within | Rule::within => (7, "`within`"),
        Rule::kw_retry | Rule::retry => (7, "`retry`"),
        Rule::kw_for | Rule::for_robot | Rule::for_each | Rule::hold => (7, "`for`"),
        Rule::kw_achieves | Rule::achieves => (7, "`achieves`"),
        Rule::kw_world => (7, "`world`"),
        Rule::kw_any => (3, "`any`"),
        Rule::pause | Rule::restart | Rule::resume | Rule::kw_pause | Rule::kw_restart | Rule::kw_resume => {
            (0, "a reaction such as `pause`")
        }
        Rule::EOI => (8, "the end of the text"),
        _ => return None,
    })
}

/// The tokens about an error.
struct Place<'t> {
    found: Option<Token<'t>>,
    before: Option<Token<'t>>,
    after: Option<Token<'t>>,
    expected: &'t [Rule],
}

/// Words of other languages for what Motet calls otherwise.
const HABITS: &[(&str, &str)] = &[
    ("elif", "write `else if`"),
    ("elsif", "write `else if`"),
    ("while", "loops are bounded: write `repeat 10 { … } until c`"),
    ("loop", "loops are bounded: write `repeat 10 { … } until c`"),
    ("for", "write `each x in xs at most 5 { … }` over a list, or `repeat 3 { … }`"),
    ("foreach", "write `each x in xs at most 5 { … }`"),
    ("return", "a policy returns nothing: write `done`, `fail \"why\"` or `replan \"why\"`"),
    ("break", "loops end by `until`: write `repeat 10 { … } until c`"),
    ("stop", "write `done` or `fail \"why\"`"),
    ("abort", "write `fail \"why\"`"),
    ("var", "write `let`"),
    ("const", "write `let`"),
    ("def", "write `policy name { … }`"),
    ("fn", "write `policy name { … }`"),
    ("func", "write `policy name { … }`"),
    ("function", "write `policy name { … }`"),
    ("except", "write `catch any { … }`"),
    ("finally", "write the steps after the `try`"),
    ("switch", "write `if c { … } else if d { … }`"),
    ("match", "write `if c { … } else if d { … }`"),
    ("do", "write the call itself: `pick(mug)`"),
    ("call", "write the call itself: `pick(mug)`"),
    ("null", "leave it out: there is no null"),
    ("None", "leave it out: there is no null"),
    ("True", "write `true`"),
    ("False", "write `false`"),
];

/// Keywords with which a step or a declaration begins, for a guess at a misspelt one.
const STARTERS: &[&str] = &[
    "let", "sequence", "if", "wait", "monitor", "try", "repeat", "each", "parallel", "done", "fail",
    "replan", "catch", "else", "until", "when", "during",
];
const DECLARATIONS: &[&str] = &[
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
const CLAUSES: &[&str] = &["needs", "makes", "unsettles", "motion", "uses", "takes", "fails", "lasts"];

impl<'t> Place<'t> {
    fn find(text: &'t str, at: usize, expected: &'t [Rule]) -> Self {
        let mut place = Place { found: None, before: None, after: None, expected };
        for token in tokens(text, 0).filter(|token| token.kind != TokenKind::Comment) {
            if token.end() <= at {
                place.before = Some(token);
            } else if place.found.is_none() {
                place.found = Some(token);
            } else {
                place.after = Some(token);
                break;
            }
        }
        place
    }

    fn expects(&self, words: &str) -> bool {
        self.expected.iter().filter_map(|rule| label(*rule)).any(|(_, label)| label == words)
    }

    /// `20 sec`: a word on the place of a unit that cannot be anything else there.
    fn unknown_unit(&self) -> Option<Token<'t>> {
        let (number, word) = (self.before?, self.found?);
        let adjoins = number.kind == TokenKind::Number && word.kind == TokenKind::Word;
        let is_call = self.after.is_some_and(|after| after.text == "(");
        let is_known = STARTERS.contains(&word.text) || CLAUSES.contains(&word.text);
        let follows = self.expected.contains(&Rule::unit) || word.start == number.end();
        (adjoins && follows && !is_call && !is_known).then_some(word)
    }

    /// Help, and what to write in place of the token where that is sure.
    fn advice(&self) -> (Option<String>, Option<&'static str>) {
        let Some(found) = self.found else { return (None, None) };
        let say = |words: &str| (Some(String::from(words)), None);
        let mend = |words: &str, fix: &'static str| (Some(String::from(words)), Some(fix));
        let before = self.before.map_or("", |token| token.text);
        let after = self.after.map_or("", |token| token.text);
        match (found.kind, found.text) {
            (_, ";") => mend("steps need no separator: remove `;`", ""),
            (_, "&&") => mend("write `and`", "and"),
            (_, "||") => mend("write `or`", "or"),
            (_, "!") => mend("write `not`", "not "),
            (_, "=") if self.expects(OPERATOR) => mend("compare with `==`", "=="),
            (_, "=") => say("a binding is written `let name = …`"),
            (_, "'" | "‘" | "’" | "“" | "”") => {
                say("texts stand in straight double quotes: `\"red mug\"`")
            }
            (_, "#") => say("comments begin with `//`"),
            (_, "/") if after == "*" => say("comments begin with `//` and end with the line"),
            (_, "$") => say("write the name alone: `$` marks bindings in JSON only"),
            (_, "-") if self.expects(VALUE) => say("write `0 - x`: only a number can begin with `-`"),
            (TokenKind::Doc, _) => say("`///` documents a declaration: write `//` here"),
            (_, "else") => say("`else` stands after the block of an `if` and nowhere else"),
            (_, "catch") => say("`catch` stands after the block of a `try`"),
            (_, "{") if before == "else" => say("write `else { … }` after the block of an `if`"),
            (_, ",") if self.expects(STEP) => mend("steps need no separator: remove `,`", ""),
            (_, ":") if self.expects(STEP) => say("blocks stand in braces: `{ … }`"),
            (_, ":") if self.expects("`{`") => say("blocks stand in braces: `{ … }`"),
            (_, "{") if self.expects(DECLARATION) => {
                say("a policy begins with its name: `policy name { … }`")
            }
            (_, "\"") => say("close the text with `\"`"),
            (TokenKind::Word, word) => (self.word(word, after), None),
            (TokenKind::Text, _) if self.expects(STEP) => {
                say("a text is no step: call something with it, `say(\"…\")`")
            }
            (_, _) if self.expected.contains(&Rule::at_most) => {
                say("a loop over a list has a bound: `at most 5`")
            }
            (_, _) if self.expected.contains(&Rule::kw_during) => {
                say("a monitor ends with what it watches over: `during { … }`")
            }
            (_, _) if self.expected.contains(&Rule::catch) => {
                say("a `try` needs a handler: `catch any { … }`")
            }
            (_, _) if self.expects("`(`") && self.expected.len() <= 3 => {
                say("a call needs its parentheses: `home()`")
            }
            (_, _) => (None, None),
        }
    }

    /// Help for a word.
    fn word(&self, word: &str, after: &str) -> Option<String> {
        let is_start = self.expects(STEP) || self.expects(DECLARATION);
        if let Some((_, advice)) =
            HABITS.iter().find(|(habit, _)| *habit == word).filter(|_| is_start || self.expects(VALUE))
        {
            return Some((*advice).into());
        }
        if self.expects(NAME) && super::is_reserved(word) && !is_start {
            return Some(format!(
                "`{word}` is a word of the language: choose another name, or write `` `{word}` ``"
            ));
        }
        if self.expected.contains(&Rule::at_most) {
            return Some("a loop over a list has a bound: `at most 5`".into());
        }
        let mut candidates: Vec<&'static str> = Vec::new();
        if self.expects(STEP) {
            candidates.extend(STARTERS);
        }
        if self.expects(DECLARATION) {
            candidates.extend(DECLARATIONS);
        }
        if self.expects(CLAUSE) {
            candidates.extend(CLAUSES);
        }
        candidates.extend(self.expected.iter().filter_map(|rule| keyword(*rule)));
        if let Some(meant) = suggest::closest(word, candidates).filter(|meant| *meant != word) {
            return Some(format!("did you mean `{meant}`?"));
        }
        if self.before.is_some_and(|before| before.kind == TokenKind::Word) && self.expects("`(`") {
            let name = self.before.map_or("", |before| before.text);
            if let Some(meant) =
                suggest::closest(name, STARTERS.iter().copied()).filter(|meant| *meant != name)
            {
                return Some(format!("did you mean `{meant}` instead of `{name}`?"));
            }
            return Some(format!("a call needs its parentheses: `{name}()`"));
        }
        if self.expects(DECLARATION) && after == "(" {
            return Some("steps stand in a policy: `policy name { … }`".into());
        }
        None
    }
}

/// The word of a keyword rule.
fn keyword(rule: Rule) -> Option<&'static str> {
    label(rule)
        .and_then(|(_, label)| label.strip_prefix('`')?.strip_suffix('`'))
        .filter(|word| word.len() > 1)
}

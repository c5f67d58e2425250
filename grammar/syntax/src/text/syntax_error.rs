//! Explanation of parse errors in plain words: the rules expected at the furthest offset that the parser
//! reached, the token found there, and the habit of another language behind it.

use pest::error::{Error, ErrorVariant, InputLocation};

use super::Rule;
use super::lexer::{Token, TokenKind, tokens};
use super::recover::Refusal;
use crate::diagnostic::Diagnostic;
use crate::diagnostics::{DocumentKind, Empty, TextSyntax, UnknownUnit};
use crate::source::{FileId, Span};
use crate::suggest;
use crate::unit::Unit;
use crate::words::{CLAUSES, DECLARATIONS, STEP_WORDS, is_bare_name};

/// The diagnostic for an error of the parser, and where it stopped.
pub(super) fn refusal(text: &str, error: &Error<Rule>, file: FileId) -> Refusal {
    let expected: &[Rule] = match &error.variant {
        ErrorVariant::ParsingError { positives, .. } => positives,
        ErrorVariant::CustomError { .. } => &[],
    };
    let begins = |rule: &Rule| matches!(label(*rule), Some((_, STEP | DECLARATION)));
    let diagnostic = Box::new(diagnostic(text, error, expected, file));
    // A word alone is blamed where something else was expected behind it.
    let is_earlier = location(error) > diagnostic.span.start as usize;
    Refusal { diagnostic, is_between: is_earlier || expected.iter().any(begins) }
}

fn diagnostic(text: &str, error: &Error<Rule>, expected: &[Rule], file: FileId) -> Diagnostic {
    let place = ErrorContext::find(text, location(error), expected);
    if let Some(unit) = place.unknown_unit() {
        return UnknownUnit { span: unit.span(file), unit: unit.text.into() }.into();
    }
    if place.found.is_none() && place.before.is_none() {
        return Empty { span: Span::new(file, 0, 0), wanted: DocumentKind::Policy }.into();
    }
    if let Some(word) = place.lone_word() {
        let message = format!("`{}` is no step", short(word.text));
        let (help, fix) = place.advice_on_lone(word, text);
        return TextSyntax { span: word.span(file), message, help, related: None, fix }.into();
    }
    let end = text.trim_end().len();
    let span = place.found.map_or(Span::new(file, end, end), |token| token.span(file));
    let found = match place.found {
        None => "the end of the text".into(),
        Some(token) if token.kind == TokenKind::Doc => "a `///` comment".into(),
        Some(token) if token.kind == TokenKind::Text => format!("the text {}", short(token.text)),
        Some(token) if is_control(token) => {
            format!("the control character `{}`", token.text.escape_debug())
        }
        Some(token) => format!("`{}`", short(token.text)),
    };
    let message = match words(expected) {
        Some(expected) => format!("expected {expected}, found {found}"),
        None => format!("{found} does not fit here"),
    };
    let (help, fix) = place.advice();
    TextSyntax { span, message, help, related: None, fix }.into()
}

fn location(error: &Error<Rule>) -> usize {
    match error.location {
        InputLocation::Pos(at) | InputLocation::Span((at, _)) => at,
    }
}

fn is_control(token: Token<'_>) -> bool {
    token.text.chars().all(char::is_control)
}

fn short(text: &str) -> String {
    if text.chars().count() <= 30 {
        return text.into();
    }
    text.chars().take(29).chain(['…']).collect()
}

/// The tokens about an error.
struct ErrorContext<'t> {
    earlier: Option<Token<'t>>,
    before: Option<Token<'t>>,
    found: Option<Token<'t>>,
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
    ("return", "write `done`, or `done x` in a policy with a result: `policy find_mug() -> Object { … }`"),
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
    ("switch", "write `if c { … } else if d { … }`"),
    ("match", "write `if c { … } else if d { … }`"),
    ("do", "write the call itself: `pick(mug)`"),
    ("call", "write the call itself: `pick(mug)`"),
    ("sleep", "write `wait 5 s`"),
    ("fast", "leave it out: only slower manners have a word, `slowly` and `gently`"),
    ("quickly", "leave it out: only slower manners have a word, `slowly` and `gently`"),
    ("carefully", "write `go(user) gently`"),
    ("slow", "write `go(user) slowly`, or `at 30 %`"),
    ("timeout", "write `within 20 s`"),
    ("deadline", "write `within 20 s`"),
    ("retries", "write `retry 2`"),
    ("times", "leave it out: `repeat 3 { … }`"),
    ("begin", "blocks stand in braces: `{ … }`"),
    ("end", "blocks stand in braces: `{ … }`"),
    ("print", "write `say(\"…\")` to speak, and `//` for a comment"),
    ("null", "leave it out: there is no null"),
    ("None", "leave it out: there is no null"),
    ("True", "write `true`"),
    ("False", "write `false`"),
];

impl<'t> ErrorContext<'t> {
    fn find(text: &'t str, at: usize, expected: &'t [Rule]) -> Self {
        let mut place = ErrorContext { earlier: None, before: None, found: None, after: None, expected };
        for token in tokens(text, 0).filter(|token| token.kind != TokenKind::Comment) {
            if token.end() <= at {
                place.earlier = place.before.replace(token);
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

    /// `20 sec`: a word on the place of a unit. What else a word after a number could be is left alone.
    fn unknown_unit(&self) -> Option<Token<'t>> {
        let candidates = [(self.before, self.found, self.after), (self.earlier, self.before, self.found)];
        candidates.into_iter().find_map(|(number, word, after)| {
            let (number, word) = (number?, word?);
            let adjoins = number.kind == TokenKind::Number && word.kind == TokenKind::Word;
            let is_spelling =
                Unit::from_spelling(word.text).is_some() && after.is_none_or(|after| after.text != "(");
            let is_glued = word.start == number.end();
            (adjoins && Unit::parse(word.text).is_none() && (is_spelling || is_glued)).then_some(word)
        })
    }

    /// A word where a step should begin, without the `(` of a call after it. It is the mistake, not what
    /// follows it.
    fn lone_word(&self) -> Option<Token<'t>> {
        let needs_args = self.expected.iter().all(|rule| matches!(rule, Rule::args | Rule::lparen));
        let word = self.before.filter(|before| before.kind == TokenKind::Word)?;
        let declares = self
            .earlier
            .is_some_and(|earlier| DECLARATIONS.contains(&earlier.text) || earlier.text == "motion");
        (needs_args && !self.expected.is_empty() && !declares).then_some(word)
    }

    fn advice_on_lone(&self, word: Token<'_>, text: &str) -> (Option<String>, Option<String>) {
        if let Some((_, advice)) = HABITS.iter().find(|(habit, _)| *habit == word.text) {
            return (Some((*advice).into()), None);
        }
        let next = self.found.map_or("", |token| token.text);
        if next == "=" {
            return (
                Some(format!("a binding is written `let {} = …`", word.text)),
                Some(format!("let {}", word.text)),
            );
        }
        let behind = text.get(word.end()..).unwrap_or("").trim_start();
        let behind = behind.trim_start_matches(|letter: char| letter.is_ascii_digit());
        if word.text == "retry" && behind.trim_start().starts_with('{') {
            let advice = "`repeat 3 { … } until c` runs steps again until `c` holds, and `try { … } catch \
                          slipped { … }` handles their failure; a call alone is tried again by \
                          `pick(mug) retry 2`";
            return (Some(advice.into()), None);
        }
        if matches!(word.text, "retry" | "within" | "slowly" | "gently") {
            let advice = "a manner, `within` and `retry` stand once behind a call, in this order: \
                          `pick(mug) gently within 20 s retry 2`";
            return (Some(advice.into()), None);
        }
        let starters = STEP_WORDS.into_iter().chain(DECLARATIONS).chain(CLAUSES);
        if let Some(meant) = suggest::closest(word.text, starters).filter(|meant| *meant != word.text) {
            return (Some(format!("did you mean `{meant}`?")), Some(meant.into()));
        }
        let rest = text.get(word.end()..).unwrap_or("");
        let ends_line = rest.trim_start_matches([' ', '\t', '\r']).starts_with(['\n', '}']);
        // `pick mug`: what stands behind it on its line is its argument.
        let argument = self.found.filter(|found| {
            let is_value = matches!(
                found.kind,
                TokenKind::Word | TokenKind::Quoted | TokenKind::Number | TokenKind::Text
            );
            let between = text.get(word.end()..found.start).unwrap_or("\n");
            is_value && !between.contains('\n') && is_bare_name(found.text.trim_matches(['`', '"']))
        });
        let call = format!("{}({})", word.text, argument.map_or("", |argument| argument.text));
        (Some(format!("a call needs its parentheses: `{call}`")), ends_line.then_some(call))
    }

    /// Help, and what to write in place of the token where that is sure.
    fn advice(&self) -> (Option<String>, Option<String>) {
        let Some(found) = self.found else { return (self.structure().map(Into::into), None) };
        let say = |words: &str| (Some(String::from(words)), None);
        let mend = |words: &str, fix: &str| (Some(String::from(words)), Some(fix.into()));
        let before = self.before.map_or("", |token| token.text);
        let after = self.after.map_or("", |token| token.text);
        match (found.kind, found.text) {
            (_, ";") => mend("steps need no separator: remove `;`", ""),
            (_, "&&") => mend("write `and`", "and"),
            (_, "||") => mend("write `or`", "or"),
            (_, "!") => mend("write `not`", "not "),
            (_, "=") if self.expects("`:`") => mend("an argument is named with `:`", ":"),
            (_, "=") if self.expects(OPERATOR) => mend("compare with `==`", "=="),
            (_, ">") if self.expected == [Rule::ge] => mend("a rule has a least distance: write `>=`", ">="),
            (_, "is") => say("a condition is a fluent such as `is_empty(xs)`, or a comparison with `==`"),
            (_, "{") if before == "if" => say("a condition follows `if`: `if near(user) { … }`"),
            (_, "for") if before == "wait" => mend("a time follows `wait`: `wait 5 s`", ""),
            (_, "'" | "‘" | "’" | "“" | "”") => {
                say("texts stand in straight double quotes: `\"red mug\"`")
            }
            (_, "#") => say("comments begin with `//`"),
            (_, "°") => mend("an angle is written `90 deg`", " deg"),
            (_, _) if is_control(found) => mend("remove it", ""),
            (_, "{") if before == "sequence" => say("a sequence has a name: `sequence tidy { … }`"),
            _ if before == "retry" && self.expects(VALUE) => say("say how often: `retry 2`"),
            _ if before == "within" && self.expects(VALUE) => say("say how long: `within 20 s`"),
            _ if before == "at" && self.expects(VALUE) => {
                say("say at which part of the robot's speed: `go(user) at 30 %`")
            }
            _ if matches!(before, "and" | "or" | "not") && self.expects(VALUE) => {
                say("a condition follows: `holding(mug) and not lifted(mug)`")
            }
            (_, "/") if after == "*" => say("comments begin with `//` and end with the line"),
            (_, "$") => say("a bound name follows `$`, and nothing else: write it alone"),
            (_, "-") if self.expects(VALUE) => say("write `0 - x`: only a number can begin with `-`"),
            (TokenKind::Doc, _) => say("`///` documents a declaration: write `//` here"),
            (_, "else") => say("`else` stands after the block of an `if` and nowhere else"),
            (_, "catch") if self.expects(STEP) => say("`catch` stands after the block of a `try`"),
            (_, "finally") => {
                say("`finally` stands behind a step that has blocks, and behind a whole policy")
            }
            (_, "{") if before == "repeat" => say("a loop has a bound: `repeat 3 { … }`"),
            (_, "{") if self.expects(DECLARATION) => {
                say("a policy begins with its name: `policy name { … }`")
            }
            (_, ",") if self.expects(STEP) => mend("steps need no separator: remove `,`", ""),
            (_, ":") if self.expects(STEP) || self.expects("`{`") => say("blocks stand in braces: `{ … }`"),
            (TokenKind::Text, _) if self.expects(STEP) => {
                say("a text is no step: call something with it, `say(\"…\")`")
            }
            (TokenKind::Word, word) => {
                (self.word(word, after).or_else(|| self.structure().map(Into::into)), None)
            }
            (_, _) => (self.structure().map(Into::into), None),
        }
    }

    /// Example of the construct that the author is writing.
    fn structure(&self) -> Option<&'static str> {
        let wants = |rules: &[Rule]| self.expected.iter().any(|rule| rules.contains(rule));
        if wants(&[Rule::at_most, Rule::kw_at, Rule::kw_most]) {
            return Some("it has a bound: write `at most 5`");
        }
        if wants(&[Rule::kw_during]) {
            return Some("a monitor ends with its block: `monitor when c then R during { … }`");
        }
        if wants(&[Rule::catch, Rule::kw_catch]) {
            return Some("a `try` has a handler: `try { … } catch any { … }`");
        }
        if wants(&[Rule::kw_then]) {
            return Some("the reaction follows `then`: `when c then pause`");
        }
        if wants(&[Rule::kw_until]) && self.before.is_some_and(|before| before.text == "wait") {
            return Some("write `wait until c within 60 s`, or a time: `wait 5 s`");
        }
        if wants(&[Rule::pause, Rule::kw_pause]) {
            return Some(
                "the reactions are `pause`, `restart at most 3`, `resume at most 3 { … }`, `done`, \
                 `fail \"why\"`, `cannot \"why\"` and `replan \"why\"`",
            );
        }
        if wants(&[Rule::block, Rule::lbrace]) {
            return Some("blocks stand in braces: `{ … }`");
        }
        if self.expected == [Rule::colon] {
            return Some("a parameter has a type: `name: Type`");
        }
        None
    }

    /// Help for a word.
    fn word(&self, word: &str, after: &str) -> Option<String> {
        let is_start = self.expects(STEP) || self.expects(DECLARATION);
        let habit =
            HABITS.iter().find(|(habit, _)| *habit == word).filter(|_| is_start || self.expects(VALUE));
        if let Some((_, advice)) = habit {
            return Some((*advice).into());
        }
        if self.expects(NAME) && !is_bare_name(word) && !is_start {
            return Some(format!(
                "`{word}` is a word of the language: choose another name, or write `` `{word}` ``"
            ));
        }
        let mut candidates: Vec<&'static str> = Vec::new();
        if self.expects(STEP) {
            candidates.extend(STEP_WORDS);
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
        if self.expects(DECLARATION) && (after == "(" || STEP_WORDS.contains(&word)) {
            return Some("steps stand in a policy: `policy name { … }`".into());
        }
        None
    }
}

/// Phrase for the rules that could have continued.
fn words(expected: &[Rule]) -> Option<String> {
    if expected == [Rule::ge] {
        return Some("`>=`".into());
    }
    let mut labels: Vec<(u8, &'static str)> = expected.iter().filter_map(|rule| label(*rule)).collect();
    labels.sort_unstable();
    labels.dedup();
    let has = |words: &str| labels.iter().any(|(_, label)| *label == words);
    // What always goes is named only where nothing else does.
    let (step, declaration, value) = (has(STEP), has(DECLARATION), has(VALUE));
    let strong = labels.iter().any(|(_, label)| !matches!(*label, OPERATOR | "`(`" | "`.`" | "`[`"));
    labels.retain(|(_, label)| match *label {
        STEP | DECLARATION => true,
        "`}`" | CLAUSE => step || declaration || !value,
        VALUE => !step && !declaration,
        _ if step || declaration || value => false,
        OPERATOR | "`(`" | "`.`" | "`[`" => !strong,
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

const STEP: &str = "a step";
const DECLARATION: &str = "a declaration such as `policy`";
const CLAUSE: &str = "a clause such as `needs`";
const VALUE: &str = "a value";
const NAME: &str = "a name";
const OPERATOR: &str = "an operator";

/// Name of a rule and its rank in an enumeration; `None` for a rule that a message leaves out.
fn label(rule: Rule) -> Option<(u8, &'static str)> {
    Some(match rule {
        Rule::do_step
        | Rule::let_step
        | Rule::sequence
        | Rule::if_else
        | Rule::wait
        | Rule::monitor
        | Rule::try_catch
        | Rule::repeat
        | Rule::each
        | Rule::parallel
        | Rule::timed
        | Rule::keep
        | Rule::end
        | Rule::kw_let
        | Rule::kw_sequence
        | Rule::kw_wait
        | Rule::kw_monitor
        | Rule::kw_try
        | Rule::kw_repeat
        | Rule::kw_parallel
        | Rule::kw_done => (0, STEP),
        Rule::file
        | Rule::item
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
        Rule::lbracket | Rule::index => (5, "`[`"),
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
        Rule::kw_as | Rule::caught_as => (7, "`as`"),
        Rule::kw_finally | Rule::finally => (7, "`finally`"),
        Rule::kw_in => (7, "`in`"),
        Rule::kw_each => (7, "`each`"),
        Rule::kw_at | Rule::kw_most | Rule::at_most => (7, "`at most`"),
        Rule::kw_slowly | Rule::kw_gently | Rule::manner => (7, "a manner such as `slowly`"),
        Rule::kw_within | Rule::within => (7, "`within`"),
        Rule::kw_retry | Rule::retry => (7, "`retry`"),
        Rule::kw_for | Rule::for_robot | Rule::for_each | Rule::hold => (7, "`for`"),
        Rule::kw_achieves | Rule::achieves => (7, "`achieves`"),
        Rule::kw_keep | Rule::keeps => (7, "`keep`"),
        Rule::kw_out | Rule::kw_of | Rule::kept => (7, "`out of`"),
        Rule::kw_distance => (7, "`distance`"),
        Rule::kw_world => (7, "`world`"),
        Rule::kw_any => (3, "`any`"),
        Rule::pause | Rule::restart | Rule::resume | Rule::kw_pause | Rule::kw_restart | Rule::kw_resume => {
            (0, "a reaction such as `pause`")
        }
        Rule::EOI => (8, "the end of the text"),
        _ => return None,
    })
}

/// The word of a keyword rule.
fn keyword(rule: Rule) -> Option<&'static str> {
    label(rule)
        .and_then(|(_, label)| label.strip_prefix('`')?.strip_suffix('`'))
        .filter(|word| word.len() > 1)
}

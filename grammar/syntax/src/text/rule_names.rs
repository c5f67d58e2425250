//! Names of the grammar's rules in messages.

use super::Rule;

/// Phrase for the rules that could have continued.
pub(super) fn words(expected: &[Rule]) -> Option<String> {
    let mut labels: Vec<(u8, &'static str)> = expected.iter().filter_map(|rule| label(*rule)).collect();
    labels.sort_unstable();
    labels.dedup();
    let has = |words: &str| labels.iter().any(|(_, label)| *label == words);
    // What always goes is named only where nothing else does.
    let (step, declaration, value) = (has(STEP), has(DECLARATION), has(VALUE));
    let strong = labels.iter().any(|(_, label)| !matches!(*label, OPERATOR | "`(`" | "`.`"));
    labels.retain(|(_, label)| match *label {
        STEP | DECLARATION => true,
        "`}`" | CLAUSE => step || declaration || !value,
        VALUE => !step && !declaration,
        _ if step || declaration || value => false,
        OPERATOR | "`(`" | "`.`" => !strong,
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

pub(super) const STEP: &str = "a step";
pub(super) const DECLARATION: &str = "a declaration such as `policy`";
pub(super) const CLAUSE: &str = "a clause such as `needs`";
pub(super) const VALUE: &str = "a value";
pub(super) const NAME: &str = "a name";
pub(super) const OPERATOR: &str = "an operator";

/// Name of a rule and its rank in an enumeration; `None` for a rule that a message leaves out.
pub(super) fn label(rule: Rule) -> Option<(u8, &'static str)> {
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

/// The word of a keyword rule.
pub(super) fn keyword(rule: Rule) -> Option<&'static str> {
    label(rule)
        .and_then(|(_, label)| label.strip_prefix('`')?.strip_suffix('`'))
        .filter(|word| word.len() > 1)
}

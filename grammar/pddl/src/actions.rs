//! Actions: `:parameters`, `:precondition`, `:effect`.

use motet_syntax::{Diagnostic, Span};
use smol_str::SmolStr;

use crate::errors::{Unsupported, WrongName};
use crate::formula::{Literal, Scope, literal, literals};
use crate::s_expression::SExpr;
use crate::typed::{self, DomainNames, ListItem, TypedName};

/// An action of a domain.
#[derive(Clone, Debug)]
pub(crate) struct Action {
    pub(crate) name: SmolStr,
    pub(crate) params: Vec<TypedName>,
    pub(crate) needs: Vec<Literal>,
    pub(crate) makes: Vec<Effect>,
    pub(crate) span: Span,
}

/// An effect, perhaps for all of a type, perhaps under conditions.
#[derive(Clone, Debug)]
pub(crate) struct Effect {
    pub(crate) literal: Literal,
    pub(crate) each: Option<TypedName>,
    pub(crate) when: Vec<Literal>,
}

/// Reads the parts of an action after `(:action`.
pub(crate) fn read(
    tree: &SExpr,
    parts: &[SExpr],
    words: &DomainNames,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<Action> {
    let Some((name, rest)) = parts.split_first().and_then(|(name, rest)| Some((name.word()?, rest))) else {
        diagnostics.push(tree.not("`(:action NAME …)`").into());
        return None;
    };
    let mut action = Action {
        name: name.clone(),
        params: Vec::new(),
        needs: Vec::new(),
        makes: Vec::new(),
        span: tree.span,
    };
    let (mut precondition, mut effect) = (None, None);
    let mut rest = rest.iter();
    while let Some(key) = rest.next() {
        let Some(value) = rest.next() else {
            diagnostics.push(key.not("a keyword with what belongs to it").into());
            return None;
        };
        match key.word().map(SmolStr::as_str) {
            Some(":parameters") => match value.list() {
                Some(items) => action.params = typed::read(items, ListItem::Variables, diagnostics),
                None => diagnostics.push(value.not("a list of variables").into()),
            },
            Some(":precondition") => precondition = Some(value),
            Some(":effect") => effect = Some(value),
            Some(other) if other.starts_with(':') => {
                diagnostics
                    .push(Unsupported { span: key.span, what: format!("`{other}` of an action") }.into());
            }
            _ => {
                diagnostics.push(key.not("`:parameters`, `:precondition` or `:effect`").into());
                return None;
            }
        }
    }
    typed::check(&action.params, &words.types, diagnostics);
    for (index, param) in action.params.iter().enumerate() {
        if action.params.iter().take(index).any(|other| other.name == param.name) {
            let what = format!("the parameter `?{}` is declared twice", param.name);
            diagnostics.push(WrongName { span: param.span, what, help: None }.into());
        }
    }
    let scope = Scope { words, variables: &action.params, objects: &words.constants };
    let needs = precondition.map(|tree| literals(tree, scope, "a precondition", diagnostics));
    let mut makes = Vec::new();
    if let Some(tree) = effect {
        effects(tree, scope, None, &[], &mut makes, diagnostics);
    }
    action.needs = needs.unwrap_or_default();
    action.makes = makes;
    Some(action)
}

/// The effects of a tree, all under `each` and `when`. Nesting was bounded when the tree was read.
fn effects(
    tree: &SExpr,
    scope: Scope<'_>,
    each: Option<&TypedName>,
    when: &[Literal],
    found: &mut Vec<Effect>,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let refuse = |what: String| Diagnostic::from(Unsupported { span: tree.span, what });
    match tree.form() {
        None if tree.list().is_some_and(<[SExpr]>::is_empty) => {}
        Some((head, parts)) if head == "and" => {
            parts.iter().for_each(|part| effects(part, scope, each, when, found, diagnostics));
        }
        Some((head, parts)) if head == "when" => {
            let [condition, inner] = parts else {
                diagnostics.push(tree.not("`(when CONDITION EFFECT)`").into());
                return;
            };
            let mut when = when.to_vec();
            when.extend(literals(condition, scope, "the condition of an effect", diagnostics));
            effects(inner, scope, each, &when, found, diagnostics);
        }
        Some((head, parts)) if head == "forall" => {
            let ([variables, inner], true) = (parts, each.is_none()) else {
                diagnostics.push(refuse("an effect `forall` within another".into()));
                return;
            };
            let variables =
                typed::read(variables.list().unwrap_or_default(), ListItem::Variables, diagnostics);
            typed::check(&variables, &scope.words.types, diagnostics);
            let [variable] = variables.as_slice() else {
                diagnostics.push(refuse("an effect `forall` over other than one variable".into()));
                return;
            };
            if scope.variables.iter().any(|one| one.name == variable.name) {
                diagnostics.push(refuse(format!("a `forall` whose `?{}` hides another", variable.name)));
                return;
            }
            let mut inside = scope.variables.to_vec();
            inside.push(variable.clone());
            let scope = Scope { variables: &inside, ..scope };
            effects(inner, scope, Some(variable), when, found, diagnostics);
        }
        Some((head, _))
            if matches!(head.as_str(), "increase" | "decrease" | "assign" | "scale-up" | "scale-down") =>
        {
            diagnostics.push(refuse(format!("the numeric effect `{head}`")));
        }
        Some((head, _)) if matches!(head.as_str(), "oneof" | "probabilistic" | "or") => {
            diagnostics.push(refuse(format!("`{head}` in an effect")));
        }
        _ => {
            let Some(literal) = literal(tree, scope, "an effect", diagnostics) else { return };
            if literal.atom.predicate.is_none() {
                diagnostics.push(tree.not("an effect, which cannot make things equal,").into());
                return;
            }
            found.push(Effect { literal, each: each.cloned(), when: when.to_vec() });
        }
    }
}

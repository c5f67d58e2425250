//! Actions: `:parameters`, `:precondition`, `:effect`.

use motet_syntax::{Diagnostic, Span};
use smol_str::SmolStr;

use crate::domain::Vocabulary;
use crate::errors::{Unsupported, WrongName};
use crate::formula::{Literal, Scope, literal, literals};
use crate::tree::Tree;
use crate::typed::{self, Typed, Wanted};

/// An action of a domain.
#[derive(Clone, Debug)]
pub(crate) struct Action {
    pub(crate) name: SmolStr,
    pub(crate) params: Vec<Typed>,
    pub(crate) needs: Vec<Literal>,
    pub(crate) makes: Vec<Effect>,
    pub(crate) span: Span,
}

/// An effect, perhaps for all of a type, perhaps under conditions.
#[derive(Clone, Debug)]
pub(crate) struct Effect {
    pub(crate) literal: Literal,
    pub(crate) each: Option<Typed>,
    pub(crate) when: Vec<Literal>,
}

/// Reads the parts of an action after `(:action`.
pub(crate) fn read(
    tree: &Tree,
    parts: &[Tree],
    words: &Vocabulary,
    said: &mut Vec<Diagnostic>,
) -> Option<Action> {
    let Some((name, rest)) = parts.split_first().and_then(|(name, rest)| Some((name.word()?, rest))) else {
        said.push(tree.not("`(:action NAME …)`").into());
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
            said.push(key.not("a keyword with what belongs to it").into());
            return None;
        };
        match key.word().map(SmolStr::as_str) {
            Some(":parameters") => match value.list() {
                Some(items) => action.params = typed::read(items, Wanted::Variables, said),
                None => said.push(value.not("a list of variables").into()),
            },
            Some(":precondition") => precondition = Some(value),
            Some(":effect") => effect = Some(value),
            Some(other) if other.starts_with(':') => {
                said.push(Unsupported { span: key.span, what: format!("`{other}` of an action") }.into());
            }
            _ => {
                said.push(key.not("`:parameters`, `:precondition` or `:effect`").into());
                return None;
            }
        }
    }
    typed::check(&action.params, &words.types, said);
    for (index, param) in action.params.iter().enumerate() {
        if action.params.iter().take(index).any(|other| other.name == param.name) {
            let what = format!("the parameter `?{}` is declared twice", param.name);
            said.push(WrongName { span: param.span, what, help: None }.into());
        }
    }
    let scope = Scope { words, variables: &action.params, objects: &words.constants };
    let needs = precondition.map(|tree| literals(tree, scope, "a precondition", said));
    let mut makes = Vec::new();
    if let Some(tree) = effect {
        effects(tree, scope, None, &[], &mut makes, said);
    }
    action.needs = needs.unwrap_or_default();
    action.makes = makes;
    Some(action)
}

/// The effects of a tree, all under `each` and `when`. Nesting was bounded when the tree was read.
fn effects(
    tree: &Tree,
    scope: Scope<'_>,
    each: Option<&Typed>,
    when: &[Literal],
    found: &mut Vec<Effect>,
    said: &mut Vec<Diagnostic>,
) {
    let refuse = |what: String| Diagnostic::from(Unsupported { span: tree.span, what });
    match tree.form() {
        None if tree.list().is_some_and(<[Tree]>::is_empty) => {}
        Some((head, parts)) if head == "and" => {
            parts.iter().for_each(|part| effects(part, scope, each, when, found, said));
        }
        Some((head, parts)) if head == "when" => {
            let [condition, inner] = parts else {
                said.push(tree.not("`(when CONDITION EFFECT)`").into());
                return;
            };
            let mut when = when.to_vec();
            when.extend(literals(condition, scope, "the condition of an effect", said));
            effects(inner, scope, each, &when, found, said);
        }
        Some((head, parts)) if head == "forall" => {
            let ([variables, inner], true) = (parts, each.is_none()) else {
                said.push(refuse("an effect `forall` within another".into()));
                return;
            };
            let variables = typed::read(variables.list().unwrap_or_default(), Wanted::Variables, said);
            typed::check(&variables, &scope.words.types, said);
            let [variable] = variables.as_slice() else {
                said.push(refuse("an effect `forall` over other than one variable".into()));
                return;
            };
            if scope.variables.iter().any(|one| one.name == variable.name) {
                said.push(refuse(format!("a `forall` whose `?{}` hides another", variable.name)));
                return;
            }
            let mut inside = scope.variables.to_vec();
            inside.push(variable.clone());
            let scope = Scope { variables: &inside, ..scope };
            effects(inner, scope, Some(variable), when, found, said);
        }
        Some((head, _))
            if matches!(head.as_str(), "increase" | "decrease" | "assign" | "scale-up" | "scale-down") =>
        {
            said.push(refuse(format!("the numeric effect `{head}`")));
        }
        Some((head, _)) if matches!(head.as_str(), "oneof" | "probabilistic" | "or") => {
            said.push(refuse(format!("`{head}` in an effect")));
        }
        _ => {
            let Some(literal) = literal(tree, scope, "an effect", said) else { return };
            if literal.atom.predicate.is_none() {
                said.push(tree.not("an effect, which cannot make things equal,").into());
                return;
            }
            found.push(Effect { literal, each: each.cloned(), when: when.to_vec() });
        }
    }
}

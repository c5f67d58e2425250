//! Conditions, which are conjunctions of literals and of equalities, and the actions of a domain, which have
//! them as `:precondition` and in `:effect`. All other formulas of PDDL are refused by name.

use motet_syntax::{Diagnostic, Span};
use smol_str::SmolStr;

use crate::diagnostics::{Unsupported, WrongName, unknown};
use crate::s_expression::SExpr;
use crate::typed::{self, DomainNames, ListItem, Objects, TypedName, is_type};

/// An argument of a predicate.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) enum Argument {
    /// Without its `?`.
    Variable(SmolStr),
    /// A constant or an object.
    Name(SmolStr),
}

/// A predicate applied to arguments, or an equality.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Atom {
    /// `None` for `=`.
    pub(crate) predicate: Option<SmolStr>,
    pub(crate) args: Vec<Argument>,
    pub(crate) span: Span,
}

/// An atom and whether it is asserted.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Literal {
    pub(crate) atom: Atom,
    pub(crate) truth: bool,
}

/// The names that a formula may use.
#[derive(Clone, Copy)]
pub(crate) struct Scope<'a> {
    pub(crate) words: &'a DomainNames,
    pub(crate) variables: &'a [TypedName],
    pub(crate) objects: &'a Objects,
}

/// Collects the literals of a conjunction. `place` names it in messages: "a precondition".
pub(crate) fn literals(
    tree: &SExpr,
    scope: Scope<'_>,
    place: &str,
    diagnostics: &mut Vec<Diagnostic>,
) -> Vec<Literal> {
    let mut found = Vec::new();
    collect(tree, scope, place, &mut found, diagnostics);
    found
}

// Nesting was bounded when the tree was read.
fn collect(
    tree: &SExpr,
    scope: Scope<'_>,
    place: &str,
    found: &mut Vec<Literal>,
    diagnostics: &mut Vec<Diagnostic>,
) {
    match tree.form() {
        None if tree.list().is_some_and(<[SExpr]>::is_empty) => {}
        Some((head, parts)) if head == "and" => {
            parts.iter().for_each(|part| collect(part, scope, place, found, diagnostics));
        }
        Some((head, _)) if is_refused(head) => {
            diagnostics.push(Unsupported { span: tree.span, what: format!("`{head}` in {place}") }.into());
        }
        _ => found.extend(literal(tree, scope, place, diagnostics)),
    }
}

/// Checks for an operator of PDDL conditions that the import does not support.
fn is_refused(head: &str) -> bool {
    matches!(
        head,
        "or" | "imply"
            | "exists"
            | "forall"
            | "when"
            | "preference"
            | "at-end"
            | ">"
            | "<"
            | ">="
            | "<="
            | "always"
            | "sometime"
            | "within"
            | "at-most-once"
            | "hold-during"
            | "hold-after"
    )
}

/// An atom, perhaps under one `not`.
pub(crate) fn literal(
    tree: &SExpr,
    scope: Scope<'_>,
    place: &str,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<Literal> {
    if let Some((head, inner)) = tree.form()
        && head == "not"
    {
        let [inner] = inner else {
            diagnostics.push(tree.not("one condition under `not`").into());
            return None;
        };
        if let Some((head, _)) = inner.form()
            && (matches!(head.as_str(), "and" | "not") || is_refused(head))
        {
            diagnostics.push(
                Unsupported { span: inner.span, what: format!("`{head}` under `not` in {place}") }.into(),
            );
            return None;
        }
        return Some(Literal { atom: atom(inner, scope, place, diagnostics)?, truth: false });
    }
    Some(Literal { atom: atom(tree, scope, place, diagnostics)?, truth: true })
}

fn atom(tree: &SExpr, scope: Scope<'_>, place: &str, diagnostics: &mut Vec<Diagnostic>) -> Option<Atom> {
    let Some((head, parts)) = tree.form() else {
        diagnostics.push(tree.not(format!("a predicate in {place}")).into());
        return None;
    };
    if parts.iter().any(|part| part.list().is_some()) {
        let what = format!("a numeric or object fluent in `{head}`");
        diagnostics.push(Unsupported { span: tree.span, what }.into());
        return None;
    }
    let before = diagnostics.len();
    let args: Vec<_> = parts.iter().filter_map(|part| arg(part, scope, diagnostics)).collect();
    if diagnostics.len() > before {
        return None;
    }
    let span = tree.span;
    if head == "=" {
        if args.len() != 2 {
            diagnostics.push(tree.not("`=` with two arguments").into());
            return None;
        }
        return Some(Atom { predicate: None, args: args.into_iter().map(|(arg, _)| arg).collect(), span });
    }
    let Some(params) = scope.words.predicates.get(head) else {
        let known = scope.words.predicates.keys().map(SmolStr::as_str);
        diagnostics.push(unknown(tree.span, "predicate", head, known).into());
        return None;
    };
    if params.len() != args.len() {
        let what = format!("`{head}` takes {} arguments, and here are {}", params.len(), args.len());
        diagnostics.push(WrongName { span, what, help: None }.into());
        return None;
    }
    for ((_, ty), param) in args.iter().zip(params) {
        // A variable of a wider type may be of the right one where it counts: the effect then says nothing of
        // others.
        if !is_type(&scope.words.types, ty, &param.ty) {
            let what =
                format!("`{head}` takes {} `{}`, and this is {} `{ty}`", a(&param.ty), param.ty, a(ty));
            diagnostics.push(WrongName { span, what, help: None }.into());
            return None;
        }
    }
    Some(Atom { predicate: Some(head.clone()), args: args.into_iter().map(|(arg, _)| arg).collect(), span })
}

fn a(word: &str) -> &'static str {
    if word.starts_with(['a', 'e', 'i', 'o', 'u']) { "an" } else { "a" }
}

/// An argument and its type.
fn arg(tree: &SExpr, scope: Scope<'_>, diagnostics: &mut Vec<Diagnostic>) -> Option<(Argument, SmolStr)> {
    let word = tree.word()?;
    let Some(name) = word.strip_prefix('?') else {
        if let Some(object) = scope.objects.get(word) {
            return Some((Argument::Name(word.clone()), object.ty.clone()));
        }
        let known = scope.objects.keys().map(SmolStr::as_str);
        diagnostics.push(unknown(tree.span, "object", word, known).into());
        return None;
    };
    // An inner variable hides an outer one.
    let Some(variable) = scope.variables.iter().rev().find(|one| one.name == name) else {
        let known = scope.variables.iter().map(|one| one.name.as_str());
        diagnostics.push(unknown(tree.span, "variable", word, known).into());
        return None;
    };
    Some((Argument::Variable(name.into()), variable.ty.clone()))
}

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
pub(crate) fn read_action(
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
            diagnostics.push(key.not("a keyword with its value").into());
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

//! PDDL domains, with types, constants, predicates and actions, and problems, with objects, initial facts and
//! goal.

use indexmap::IndexMap;
use motet_syntax::Diagnostic;
use smol_str::SmolStr;

use crate::MAX_ARITY;
use crate::diagnostics::{Unsupported, WrongName};
use crate::formula::{self, Action, Literal, Scope, literal, literals};
use crate::s_expression::SExpr;
use crate::typed::{self, DomainNames, ListItem, Objects, TypedName};

/// Requirements that the import supports.
const REQUIREMENTS: [&str; 5] =
    [":strips", ":typing", ":negative-preconditions", ":equality", ":conditional-effects"];

/// A domain after reading.
#[derive(Clone, Debug)]
pub(crate) struct Domain {
    pub(crate) name: SmolStr,
    pub(crate) words: DomainNames,
    pub(crate) actions: IndexMap<SmolStr, Action>,
}

/// Reads a definition `(define (domain NAME) …)`.
pub(crate) fn read(tree: &SExpr, diagnostics: &mut Vec<Diagnostic>) -> Option<Domain> {
    let (name, sections) = define(tree, "domain", diagnostics)?;
    let mut domain = Domain { name, words: DomainNames::default(), actions: IndexMap::new() };
    for section in sections {
        let Some((head, parts)) = section.form() else {
            diagnostics.push(section.not("a section such as `(:predicates …)`").into());
            continue;
        };
        let words = &mut domain.words;
        match head.as_str() {
            ":requirements" => requirements(parts, diagnostics),
            ":types" => {
                words.types = typed::hierarchy(&typed::read(parts, ListItem::Names, diagnostics), diagnostics)
            }
            ":constants" => {
                let constants = typed::read(parts, ListItem::Names, diagnostics);
                typed::check(&constants, &words.types, diagnostics);
                words.constants = constants.into_iter().map(|one| (one.name.clone(), one)).collect();
            }
            ":predicates" => parts.iter().for_each(|part| predicate(part, words, diagnostics)),
            ":action" => {
                let Some(action) = formula::read_action(section, parts, words, diagnostics) else { continue };
                let (name, span) = (action.name.clone(), action.span);
                if domain.actions.insert(name.clone(), action).is_some() {
                    let what = format!("the action `{name}` is declared twice");
                    diagnostics.push(WrongName { span, what, help: None }.into());
                }
            }
            _ => diagnostics.push(refused_section(section, head)),
        }
    }
    Some(domain)
}

/// Splits a definition into its name and its sections.
fn define<'t>(
    tree: &'t SExpr,
    what: &str,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<(SmolStr, &'t [SExpr])> {
    let inside = tree.form().filter(|(head, _)| *head == "define").map(|(_, rest)| rest);
    let (head, sections) = inside.and_then(<[SExpr]>::split_first).unzip();
    let name = match head.and_then(SExpr::form) {
        Some((word, [name])) if word == what => name.word(),
        _ => None,
    };
    if name.is_none() {
        diagnostics.push(tree.not(format!("`(define ({what} NAME) …)`")).into());
    }
    name.cloned().zip(sections)
}

/// Reports an unsupported section by the name that PDDL authors know.
fn refused_section(section: &SExpr, head: &str) -> Diagnostic {
    let name = match head {
        ":durative-action" => "a durative action",
        ":functions" => "numeric functions",
        ":derived" => "a derived predicate",
        ":constraints" => "trajectory constraints",
        ":metric" => "a metric",
        ":process" => "a process",
        ":event" => "an event",
        _ if head.starts_with(':') => {
            return Unsupported { span: section.span, what: format!("`{head}`") }.into();
        }
        _ => return section.not("a section such as `(:predicates …)`").into(),
    };
    Unsupported { span: section.span, what: format!("{name}, `{head}`,") }.into()
}

fn requirements(parts: &[SExpr], diagnostics: &mut Vec<Diagnostic>) {
    for part in parts {
        match part.word() {
            Some(word) if REQUIREMENTS.contains(&word.as_str()) => {}
            Some(word) if word.starts_with(':') => {
                diagnostics
                    .push(Unsupported { span: part.span, what: format!("the requirement `{word}`") }.into());
            }
            _ => diagnostics.push(part.not("a requirement such as `:typing`").into()),
        }
    }
}

fn predicate(tree: &SExpr, words: &mut DomainNames, diagnostics: &mut Vec<Diagnostic>) {
    let Some((name, params)) = tree.form() else {
        diagnostics.push(tree.not("a predicate such as `(on ?a ?b)`").into());
        return;
    };
    let params = typed::read(params, ListItem::Variables, diagnostics);
    typed::check(&params, &words.types, diagnostics);
    if params.len() > MAX_ARITY {
        let what = format!("a predicate with more than {MAX_ARITY} parameters");
        diagnostics.push(Unsupported { span: tree.span, what }.into());
    }
    if words.predicates.insert(name.clone(), params).is_some() {
        let what = format!("the predicate `{name}` is declared twice");
        diagnostics.push(WrongName { span: tree.span, what, help: None }.into());
    }
}

/// A problem after reading.
#[derive(Clone, Debug)]
pub(crate) struct Problem {
    pub(crate) name: SmolStr,
    /// The domain's constants and its own objects.
    pub(crate) objects: Objects,
    pub(crate) init: Vec<Literal>,
    pub(crate) goal: Vec<Literal>,
}

/// Reads `(define (problem NAME) …)` for a domain.
pub(crate) fn read_problem(
    tree: &SExpr,
    domain: &Domain,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<Problem> {
    let (name, sections) = define(tree, "problem", diagnostics)?;
    let objects = domain.words.constants.clone();
    let mut problem = Problem { name, objects, init: Vec::new(), goal: Vec::new() };
    // Objects may stand behind what speaks of them.
    for section in sections {
        if let Some((":objects", parts)) = section.form().map(|(head, parts)| (head.as_str(), parts)) {
            let found = typed::read(parts, ListItem::Names, diagnostics);
            typed::check(&found, &domain.words.types, diagnostics);
            for object in found {
                let TypedName { name, ty, span } = object.clone();
                if problem.objects.entry(name.clone()).or_insert(object).ty != ty {
                    let what = format!("the object `{name}` is declared twice");
                    diagnostics.push(WrongName { span, what, help: None }.into());
                }
            }
        }
    }
    let mut has_goal = false;
    for section in sections {
        let Some((head, parts)) = section.form() else {
            diagnostics.push(section.not("a section such as `(:init …)`").into());
            continue;
        };
        let scope = Scope { words: &domain.words, variables: &[], objects: &problem.objects };
        match (head.as_str(), parts) {
            (":domain", [of]) => {
                if let Some(of) = of.word().filter(|of| **of != domain.name) {
                    let what =
                        format!("the problem is for the domain `{of}`, and the domain is `{}`", domain.name);
                    diagnostics.push(WrongName { span: section.span, what, help: None }.into());
                }
            }
            (":requirements", parts) => requirements(parts, diagnostics),
            (":objects", _) => {}
            (":init", facts) => {
                problem.init = facts.iter().filter_map(|fact| initial(fact, scope, diagnostics)).collect();
            }
            (":goal", [goal]) => {
                has_goal = true;
                problem.goal = literals(goal, scope, "a goal", diagnostics);
            }
            (head, _) => diagnostics.push(refused_section(section, head)),
        }
    }
    if !has_goal {
        diagnostics.push(tree.not("a problem with a `(:goal …)`").into());
    }
    Some(problem)
}

fn initial(tree: &SExpr, scope: Scope<'_>, diagnostics: &mut Vec<Diagnostic>) -> Option<Literal> {
    if let Some((head, [first, ..])) = tree.form() {
        let is_number = |tree: &SExpr| tree.word().is_some_and(|word| word.parse::<f64>().is_ok());
        if head == "=" {
            diagnostics
                .push(Unsupported { span: tree.span, what: "the value of a numeric function".into() }.into());
            return None;
        }
        if head == "at" && is_number(first) {
            diagnostics.push(Unsupported { span: tree.span, what: "a timed initial literal".into() }.into());
            return None;
        }
    }
    literal(tree, scope, "`:init`", diagnostics)
}

//! PDDL problems: objects, initial facts and goal.

use motet_syntax::Diagnostic;
use smol_str::SmolStr;

use crate::domain::{Domain, define, refused_section, requirements};
use crate::errors::{Unsupported, WrongName};
use crate::formula::{Literal, Scope, literal, literals};
use crate::s_expression::SExpr;
use crate::typed::{self, ListItem, TypedName};

/// A problem after reading.
#[derive(Clone, Debug)]
pub(crate) struct Problem {
    pub(crate) name: SmolStr,
    /// The domain's constants and its own objects.
    pub(crate) objects: Vec<TypedName>,
    pub(crate) init: Vec<Literal>,
    pub(crate) goal: Vec<Literal>,
}

/// Reads `(define (problem NAME) …)` for a domain.
pub(crate) fn read(tree: &SExpr, domain: &Domain, diagnostics: &mut Vec<Diagnostic>) -> Option<Problem> {
    let (name, sections) = define(tree, "problem", diagnostics)?;
    let objects = domain.words.constants.clone();
    let mut problem = Problem { name, objects, init: Vec::new(), goal: Vec::new() };
    // Objects may stand behind what speaks of them.
    for section in sections {
        if let Some((":objects", parts)) = section.form().map(|(head, parts)| (head.as_str(), parts)) {
            let found = typed::read(parts, ListItem::Names, diagnostics);
            typed::check(&found, &domain.words.types, diagnostics);
            for object in found {
                match problem.objects.iter().find(|other| other.name == object.name) {
                    None => problem.objects.push(object),
                    Some(other) if other.ty == object.ty => {}
                    Some(_) => {
                        let what = format!("the object `{}` is declared twice", object.name);
                        diagnostics.push(WrongName { span: object.span, what, help: None }.into());
                    }
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

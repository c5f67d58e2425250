//! PDDL domains: types, constants, predicates and actions.

use indexmap::IndexMap;
use motet_syntax::Diagnostic;
use smol_str::SmolStr;

use crate::MAX_ARITY;
use crate::actions::{self, Action};
use crate::errors::{Unsupported, WrongName};
use crate::tree::Tree;
use crate::typed::{self, Typed, Types, Wanted};

/// Requirements that the import supports.
const REQUIREMENTS: [&str; 5] =
    [":strips", ":typing", ":negative-preconditions", ":equality", ":conditional-effects"];

/// Declarations that the formulas of a domain and its problems refer to.
#[derive(Clone, Debug, Default)]
pub(crate) struct Vocabulary {
    pub(crate) types: Types,
    pub(crate) predicates: IndexMap<SmolStr, Vec<Typed>>,
    pub(crate) constants: Vec<Typed>,
}

/// A domain after reading.
#[derive(Clone, Debug)]
pub(crate) struct Domain {
    pub(crate) name: SmolStr,
    pub(crate) words: Vocabulary,
    pub(crate) actions: IndexMap<SmolStr, Action>,
}

/// Reads a definition `(define (domain NAME) …)`.
pub(crate) fn read(tree: &Tree, said: &mut Vec<Diagnostic>) -> Option<Domain> {
    let (name, sections) = define(tree, "domain", said)?;
    let mut domain = Domain { name, words: Vocabulary::default(), actions: IndexMap::new() };
    for section in sections {
        let Some((head, parts)) = section.form() else {
            said.push(section.not("a section such as `(:predicates …)`").into());
            continue;
        };
        let words = &mut domain.words;
        match head.as_str() {
            ":requirements" => requirements(parts, said),
            ":types" => words.types = typed::hierarchy(&typed::read(parts, Wanted::Names, said), said),
            ":constants" => {
                words.constants = typed::read(parts, Wanted::Names, said);
                typed::check(&words.constants, &words.types, said);
            }
            ":predicates" => parts.iter().for_each(|part| predicate(part, words, said)),
            ":action" => {
                let Some(action) = actions::read(section, parts, words, said) else { continue };
                let (name, span) = (action.name.clone(), action.span);
                if domain.actions.insert(name.clone(), action).is_some() {
                    let what = format!("the action `{name}` is declared twice");
                    said.push(WrongName { span, what, help: None }.into());
                }
            }
            _ => said.push(refused_section(section, head)),
        }
    }
    Some(domain)
}

/// Splits a definition into its name and its sections.
pub(crate) fn define<'t>(
    tree: &'t Tree,
    what: &str,
    said: &mut Vec<Diagnostic>,
) -> Option<(SmolStr, &'t [Tree])> {
    let inside = tree.form().filter(|(head, _)| *head == "define").map(|(_, rest)| rest);
    let (head, sections) = inside.and_then(<[Tree]>::split_first).unzip();
    let name = match head.and_then(Tree::form) {
        Some((word, [name])) if word == what => name.word(),
        _ => None,
    };
    if name.is_none() {
        said.push(tree.not(format!("`(define ({what} NAME) …)`")).into());
    }
    name.cloned().zip(sections)
}

/// Reports an unsupported section by the name that PDDL authors know.
pub(crate) fn refused_section(section: &Tree, head: &str) -> Diagnostic {
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

pub(crate) fn requirements(parts: &[Tree], said: &mut Vec<Diagnostic>) {
    for part in parts {
        match part.word() {
            Some(word) if REQUIREMENTS.contains(&word.as_str()) => {}
            Some(word) if word.starts_with(':') => {
                said.push(Unsupported { span: part.span, what: format!("the requirement `{word}`") }.into());
            }
            _ => said.push(part.not("a requirement such as `:typing`").into()),
        }
    }
}

fn predicate(tree: &Tree, words: &mut Vocabulary, said: &mut Vec<Diagnostic>) {
    let Some((name, params)) = tree.form() else {
        said.push(tree.not("a predicate such as `(on ?a ?b)`").into());
        return;
    };
    let params = typed::read(params, Wanted::Variables, said);
    typed::check(&params, &words.types, said);
    if params.len() > MAX_ARITY {
        let what = format!("a predicate with more than {MAX_ARITY} parameters");
        said.push(Unsupported { span: tree.span, what }.into());
    }
    if words.predicates.insert(name.clone(), params).is_some() {
        let what = format!("the predicate `{name}` is declared twice");
        said.push(WrongName { span: tree.span, what, help: None }.into());
    }
}

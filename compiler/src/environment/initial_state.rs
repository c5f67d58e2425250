//! Initial state: facts at the start that are given beside the scene.

use indexmap::IndexMap;
use motet_stdlib::lang;
use motet_syntax::{Diagnostic, Span, Syntax};

use super::errors::NotAFact;
use super::{Environment, hands};
use crate::declare::Library;
use crate::declare::elaborator::Elaborator;
use crate::ir::Term;

/// Facts at the start with their truth values, in order, in text syntax: `{"holding(mug_1)": true}`.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct InitialState {
    /// Facts with their truth value (`None` for unknown) and span.
    pub facts: IndexMap<String, (Option<bool>, Span)>,
}

impl InitialState {
    /// Records every fact of the state in an environment, where it overrides the scene.
    pub(super) fn apply(&self, library: &Library, environment: &mut Environment) -> Vec<Diagnostic> {
        let mut diagnostics = Vec::new();
        let entities = environment.entities().clone();
        let mut said = Vec::new();
        let says_free = self.facts.keys().any(|text| text.trim_start().starts_with(lang::fluents::FREE));
        for (text, (value, span)) in &self.facts {
            let parsed = match motet_syntax::text::parse_condition(text) {
                Ok(expr) => expr,
                Err(mistake) => {
                    diagnostics.push(
                        NotAFact { span: *span, text: text.clone(), why: mistake, remedy: None }.into(),
                    );
                    continue;
                }
            };
            let mut elaborator = Elaborator::new(library, &entities, environment.has_scene(), Syntax::Text);
            let fact = match &parsed.kind {
                motet_syntax::ast::ExprKind::Call(call) => elaborator.fact(call),
                _ => None,
            };
            let why = elaborator.diagnostics.into_iter().next();
            match (fact, why) {
                (Some(fact), None) => {
                    let is_holding = library.lang_items.holding == Some(fact.fluent);
                    if let (true, true, false, [Some(Term::Entity(held))]) =
                        (is_holding, *value == Some(true), says_free, fact.args.as_slice())
                    {
                        super::scene_facts::held(library, environment, *held);
                    }
                    said.push((fact.clone(), *value, *span));
                    match value {
                        Some(value) => environment.assert_fact(fact, *value),
                        None => environment.forget(&fact),
                    }
                }
                (_, why) => {
                    let unasked = || ("expected a fluent".to_owned(), None);
                    let (why, remedy) = why.map_or_else(unasked, |why| (why.message, why.help));
                    diagnostics.push(NotAFact { span: *span, text: text.clone(), why, remedy }.into());
                }
            }
        }
        diagnostics.extend(hands::contradiction(library, environment, &said));
        diagnostics
    }
}

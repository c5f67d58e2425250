//! A state given from outside: facts known at the start, beside the scene.

use indexmap::IndexMap;
use motet_syntax::{Diagnostic, Span, Syntax};

use super::errors::NotAFact;
use super::{World, hands};
use crate::ir::Term;
use crate::library::Library;
use crate::resolve::expr::Resolver;

/// Facts in their text form with their values, in order: `{"holding(mug_1)": true}`.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct State {
    /// Each fact, whether it holds, none where that is not known, and where it stands.
    pub facts: IndexMap<String, (Option<bool>, Span)>,
}

impl State {
    /// Records every fact of the state in a world. What the scene says otherwise is overridden.
    pub(super) fn tell(&self, library: &Library, world: &mut World) -> Vec<Diagnostic> {
        let mut diagnostics = Vec::new();
        let entities = world.entities().clone();
        let mut said = Vec::new();
        let says_free = self.facts.keys().any(|text| text.trim_start().starts_with("free"));
        for (text, (value, span)) in &self.facts {
            let parsed = match motet_syntax::text::parse_condition(text) {
                Ok(expr) => expr,
                Err(mistake) => {
                    diagnostics
                        .push(NotAFact { span: *span, text: text.clone(), why: mistake, mend: None }.into());
                    continue;
                }
            };
            let mut resolver = Resolver::new(library, &entities, world.has_scene(), Syntax::Text);
            let fact = match &parsed.kind {
                motet_syntax::ast::ExprKind::Call(call) => resolver.fact(call),
                _ => None,
            };
            let why = resolver.diagnostics.into_iter().next();
            match (fact, why) {
                (Some(fact), None) => {
                    let is_holding = library.fluent(fact.fluent).is_some_and(|def| def.name == "holding");
                    if let (true, true, false, [Some(Term::Entity(held))]) =
                        (is_holding, *value == Some(true), says_free, fact.args.as_slice())
                    {
                        super::seed::held(library, world, *held);
                    }
                    said.push((fact.clone(), *value, *span));
                    match value {
                        Some(value) => world.tell(fact, *value),
                        None => world.forget(&fact),
                    }
                }
                (_, why) => {
                    let unasked = || ("a fluent is asked for".to_owned(), None);
                    let (why, mend) = why.map_or_else(unasked, |why| (why.message, why.help));
                    diagnostics.push(NotAFact { span: *span, text: text.clone(), why, mend }.into());
                }
            }
        }
        diagnostics.extend(hands::contradiction(library, world, &said));
        diagnostics
    }
}

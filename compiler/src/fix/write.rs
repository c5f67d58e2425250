//! What the prover proposes, as edits of a document in its own form and layout.

use motet_syntax::ast::{Arg, Call, Do, Expr, ExprKind, Name};
use motet_syntax::{Code, Diagnostic, Edit, Fix, Form, Parsed, Span, print};
use smol_str::{SmolStr, format_smolstr};

use crate::ir::{Program, Step, StepId, StepKind, Term};
use crate::library::Library;
use crate::prove::mend::{Mend, Offer, Proposed};
use crate::world::World;

/// A document and what it means.
pub(super) struct Writer<'a> {
    pub(super) parsed: &'a Parsed,
    pub(super) program: &'a Program,
    pub(super) library: &'a Library,
    pub(super) world: &'a World,
}

impl Writer<'_> {
    /// The edits of an offer, the best first.
    pub(super) fn fixes(&self, offer: &Offer) -> Vec<Fix> {
        offer.mends.iter().filter_map(|mend| self.fix(mend)).collect()
    }

    fn fix(&self, mend: &Mend) -> Option<Fix> {
        match mend {
            Mend::Before(id, calls) => {
                let calls: Vec<_> = calls.iter().map(|call| self.call(call)).collect::<Option<_>>()?;
                let (title, texts) = (title("insert", &calls, "before"), self.texts(&calls));
                Some(Fix { title, edits: vec![self.insert_before(self.step(*id)?.span, &texts)?] })
            }
            Mend::After(id, calls) => {
                let calls: Vec<_> = calls.iter().map(|call| self.call(call)).collect::<Option<_>>()?;
                let (title, texts) = (title("add", &calls, "at the end"), self.texts(&calls));
                Some(Fix { title, edits: vec![self.insert_after(self.step(*id)?.span, &texts)?] })
            }
            Mend::Again { found, before, used } => self.again(*found, *before, *used),
            Mend::Drop(id) => {
                let span = self.step(*id)?.span;
                let edit = self.without(span)?;
                Some(Fix {
                    title: "leave this step out: what it does is done already".to_owned(),
                    edits: vec![edit],
                })
            }
        }
    }

    /// For a step that is never reached: it and all behind it in its block left out. The first of a block stays, since a
    /// block without steps means nothing.
    pub(super) fn leaving_out(&self, said: &Diagnostic) -> Option<Fix> {
        if said.code.0 != "M0902" {
            return None;
        }
        let step = self.program.steps.iter().find(|step| step.span == said.span)?;
        let place = step.place;
        let block = self
            .program
            .steps
            .iter()
            .filter(|other| other.place.parent == place.parent && other.place.slot == place.slot);
        let last = block.filter(|other| other.span.file == step.span.file).map(|other| other.span).max()?;
        if place.index == 0 {
            return None;
        }
        Some(Fix {
            title: "leave out what is never reached".to_owned(),
            edits: vec![self.without(step.span.to(last))?],
        })
    }

    /// Perceives again: later, where nothing else looks at the value; else a second time, under a name of its own.
    fn again(&self, found: StepId, before: StepId, used: Span) -> Option<Fix> {
        let (found, before) = (self.step(found)?, self.step(before)?);
        let StepKind::Call(call) = &found.kind else { return None };
        let binding = self.program.bindings.get(call.binds?.index())?;
        let bound = &binding.name;
        let proposed = Proposed { primitive: call.primitive, args: call.args.clone() };
        let mut step = self.call(&proposed)?;
        let is_one_block = found.place.parent == before.place.parent && found.place.slot == before.place.slot;
        if binding.uses <= 1 && is_one_block {
            step.bind = Some(Name { text: bound.clone(), span: Span::default() });
            let insert = self.insert_before(before.span, &self.texts(&[step]))?;
            let edits = vec![self.without(found.span)?, insert];
            return Some(Fix { title: format!("perceive `{bound}` just before it is used"), edits });
        }
        let is_taken = |name: &SmolStr| self.program.bindings.iter().any(|other| other.name == *name);
        let fresh = (2..).map(|count| format_smolstr!("{bound}_{count}")).find(|name| !is_taken(name))?;
        step.bind = Some(Name { text: fresh.clone(), span: Span::default() });
        let written = match self.parsed.form {
            Form::Text => print::identifier(&fresh),
            Form::Json => format!("\"${fresh}\""),
        };
        let title = format!("perceive it again as `{fresh}`");
        let insert = self.insert_before(before.span, &self.texts(&[step]))?;
        Some(Fix { title, edits: vec![insert, Edit { span: used, text: written }] })
    }

    /// A name in place of another as the form has it: in JSON with the quotes and the `$` of what it replaces, in text in
    /// back-quotes where it needs them. A quantity, which is no name, stays.
    pub(super) fn in_form(&self, code: Code, fix: &mut Fix) {
        for edit in fix.edits.iter_mut().filter(|_| code.0 != "M0302") {
            let old = self.parsed.text.get(edit.span.range()).unwrap_or_default();
            edit.text = match old.strip_prefix('"') {
                None => print::identifier(&edit.text),
                Some(rest) => {
                    let sigil = if rest.starts_with('$') { "$" } else { "" };
                    format!("\"{sigil}{}\"", edit.text.replace('\\', "\\\\").replace('"', "\\\""))
                }
            };
        }
    }

    fn step(&self, id: StepId) -> Option<&Step> {
        self.program.steps.get(id.index())
    }

    fn texts(&self, calls: &[Do]) -> Vec<String> {
        calls.iter().map(|call| print::call(call, self.parsed.form)).collect()
    }

    /// A call as the document would write it. Defaults are left unsaid.
    fn call(&self, proposed: &Proposed) -> Option<Do> {
        let def = self.library.primitive(proposed.primitive)?;
        let span = Span::default();
        let mut args = Vec::new();
        let mut is_plain = self.parsed.form == Form::Text;
        for (term, param) in proposed.args.iter().zip(&def.params) {
            if param.default.as_ref() == Some(term) {
                is_plain = false;
                continue;
            }
            let value = Expr { kind: self.value(term)?, span };
            let name = (!is_plain).then(|| Name { text: param.name.clone(), span });
            args.push(Arg { name, value, span });
        }
        let call = Call { name: Name { text: def.name.clone(), span }, args, span };
        Some(Do { call, bind: None, within: None, retry: None })
    }

    fn value(&self, term: &Term) -> Option<ExprKind> {
        Some(match term {
            // A symbol has no name but that of a binding.
            Term::Entity(entity) => ExprKind::Name(self.world.entities().name(*entity)?.clone()),
            Term::Binding(id) => ExprKind::Binding(self.program.bindings.get(id.index())?.name.clone()),
            Term::Case(of, case) => ExprKind::Name(self.library.case_name(*of, *case).into()),
            Term::Text(text) => ExprKind::Text(text.clone()),
            Term::Bool(value) => ExprKind::Bool(*value),
            // A number would need the unit that its parameter has; no primitive that makes a fact asks for one.
            Term::Int(_)
            | Term::Number(_)
            | Term::List(_)
            | Term::Param(_)
            | Term::Result
            | Term::Each
            | Term::Field(..)
            | Term::Measure(..)
            | Term::Arith(..)
            | Term::Unknown => return None,
        })
    }

    /// Steps before the one at a place, each on a line of its own where that one has one.
    fn insert_before(&self, place: Span, steps: &[String]) -> Option<Edit> {
        let gap = self.gap(place)?;
        let comma = self.comma();
        let text = steps.iter().map(|step| format!("{step}{comma}{gap}")).collect();
        Some(Edit { span: Span { end: place.start, ..place }, text })
    }

    /// Steps behind the one at a place.
    fn insert_after(&self, place: Span, steps: &[String]) -> Option<Edit> {
        let gap = self.gap(place)?;
        let comma = self.comma();
        let text = steps.iter().map(|step| format!("{comma}{gap}{step}")).collect();
        Some(Edit { span: Span { start: place.end, ..place }, text })
    }

    fn comma(&self) -> &'static str {
        match self.parsed.form {
            Form::Text => "",
            Form::Json => ",",
        }
    }

    /// What stands between steps: a line break and the step's own indentation; a blank where it shares its line.
    fn gap(&self, place: Span) -> Option<String> {
        let before = self.parsed.text.get(..place.start as usize)?;
        let line = before.rsplit('\n').next().unwrap_or_default();
        let is_alone = before.contains('\n') && line.trim().is_empty();
        Some(if is_alone { format!("\n{line}") } else { " ".to_owned() })
    }

    /// The text without a step, and in JSON without a comma beside it.
    fn without(&self, place: Span) -> Option<Edit> {
        let text = &self.parsed.text;
        let before = text.get(..place.start as usize)?;
        let after = text.get(place.end as usize..)?;
        let kept = before.trim_end();
        let mut span = Span { start: u32::try_from(kept.len()).ok()?, ..place };
        if self.parsed.form == Form::Json {
            if let Some(kept) = kept.strip_suffix(',') {
                span.start = u32::try_from(kept.len()).ok()?;
            } else if let Some(rest) = after.trim_start().strip_prefix(',') {
                span.start = place.start;
                span.end += u32::try_from(after.len() - rest.trim_start().len()).ok()?;
            }
        }
        Some(Edit { span, text: String::new() })
    }
}

/// "insert `go(table)` before"
fn title(verb: &str, calls: &[Do], place: &str) -> String {
    let calls: Vec<_> = calls.iter().map(|call| format!("`{}`", print::call(call, Form::Text))).collect();
    format!("{verb} {} {place}", calls.join(", "))
}

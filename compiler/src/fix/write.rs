//! What the prover proposes, as edits of a document in its own form and layout.

use motet_syntax::ast::{Arg, Call, Do, Expr, ExprKind, Name};
use motet_syntax::{Code, Diagnostic, Edit, Fix, Parsed, Span, Syntax, print};
use smallvec::SmallVec;
use smol_str::{SmolStr, format_smolstr};

use crate::ir::{BindingId, Fluent, Program, Step, StepId, StepKind, Term};
use crate::library::Library;
use crate::prove::mend::{Mend, Offer, Proposed};
use crate::world::World;

/// Bindings by their new names.
type Renamed = SmallVec<[(BindingId, SmolStr); 2]>;

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
                let step = self.step(*id)?;
                let (calls, renamed) = self.calls(calls)?;
                let (title, texts) = (title("insert", &calls, "before"), self.texts(&calls));
                let mut edits = vec![self.insert_before(step.span, &texts)?];
                edits.extend(self.in_place_of(step, &renamed));
                Some(Fix { title, edits })
            }
            Mend::After(id, calls) => {
                let (calls, _) = self.calls(calls)?;
                let (title, texts) = (title("add", &calls, "at the end"), self.texts(&calls));
                Some(Fix { title, edits: vec![self.insert_after(self.step(*id)?.span, &texts)?] })
            }
            Mend::Watch(id, fluent) => self.watched(*id, *fluent),
            Mend::Again { found, before, used } => self.again(*found, *before, *used),
            Mend::Drop(id) => {
                let edit = self.without(self.step(*id)?.span)?;
                Some(Fix {
                    title: "leave this step out: what it does is done already".to_owned(),
                    edits: vec![edit],
                })
            }
        }
    }

    /// A monitor around a step that binds nothing which is used behind it.
    fn watched(&self, id: StepId, fluent: Fluent) -> Option<Fix> {
        let step = self.step(id)?;
        if !matches!(&step.kind, StepKind::Call(call) if call.binds.is_none()) {
            return None;
        }
        let name = &self.library.fluent(fluent)?.name;
        let place = step.span;
        let (before, after) = match self.parsed.syntax {
            Syntax::Text => {
                (format!("monitor when {}() then pause during {{ ", print::identifier(name)), " }")
            }
            Syntax::Json => (
                format!(
                    "{{\"monitor\": [{{\"when\": {{\"is\": \"{name}\"}}, \"then\": {{\"react\": \"pause\"}}}}], \"during\": ["
                ),
                "]}",
            ),
        };
        let edits = vec![
            Edit { span: Span { end: place.start, ..place }, text: before },
            Edit { span: Span { start: place.end, ..place }, text: after.to_owned() },
        ];
        Some(Fix { title: format!("watch `{name}` meanwhile, and pause"), edits })
    }

    /// The values that stand for bindings, by their new names, in the arguments of a step.
    fn in_place_of(&self, step: &Step, renamed: &Renamed) -> Vec<Edit> {
        let StepKind::Call(call) = &step.kind else { return Vec::new() };
        let args = call.args.iter().zip(&call.spans);
        let edits = args.filter_map(|(arg, span)| {
            let (_, name) = renamed.iter().find(|(id, _)| *arg == Term::Binding(*id))?;
            Some(Edit { span: *span, text: self.binding(name) })
        });
        edits.collect()
    }

    /// A binding as the form writes it.
    fn binding(&self, name: &str) -> String {
        match self.parsed.syntax {
            Syntax::Text => print::identifier(name),
            Syntax::Json => format!("\"${name}\""),
        }
    }

    /// A name that nothing is bound to yet: `mug_2`.
    fn fresh(&self, bound: &str) -> Option<SmolStr> {
        let is_taken = |name: &SmolStr| self.program.bindings.iter().any(|other| other.name == *name);
        (2..).map(|count| format_smolstr!("{bound}_{count}")).find(|name| !is_taken(name))
    }

    /// For a value that is missing, or of the wrong kind, where the world has just one entity that fits: that.
    pub(super) fn only_one(&self, said: &Diagnostic) -> Option<Fix> {
        let is_missing = match said.code.0 {
            "M0303" => true,
            "M0202" | "M0301" => false,
            _ => return None,
        };
        let mut calls = self.program.steps.iter().filter_map(|step| match &step.kind {
            StepKind::Call(call) => Some(call),
            _ => None,
        });
        let (call, at) = calls.find_map(|call| {
            let mut args = call.args.iter().zip(&call.spans);
            let at = args.position(|(arg, span)| *arg == Term::Unknown && *span == said.span)?;
            Some((call, at))
        })?;
        let param = self.library.primitive(call.primitive)?.params.get(at)?;
        let kind = param.ty.kind().filter(|_| param.ty.lists == 0)?;
        let mut fitting = self.world.entities().iter().filter(|row| self.library.is_kind(row.2, kind));
        let (Some((_, name, _)), None) = (fitting.next(), fitting.next()) else { return None };
        let written = match self.parsed.syntax {
            Syntax::Text => print::identifier(name),
            Syntax::Json => format!("\"{name}\""),
        };
        let edit = if is_missing {
            self.argument(said.span, &param.name, &written)?
        } else {
            Edit { span: said.span, text: written }
        };
        Some(Fix { title: format!("write `{name}`, the only one there is"), edits: vec![edit] })
    }

    /// One more argument of a call.
    fn argument(&self, call: Span, param: &str, written: &str) -> Option<Edit> {
        let text = self.parsed.text.get(call.range())?;
        let inside = text.strip_suffix([')', '}'])?;
        let end = call.start + u32::try_from(inside.trim_end().len()).ok()?;
        let comma = if inside.trim_end().ends_with(['(', '{', ',']) { "" } else { ", " };
        let text = match self.parsed.syntax {
            Syntax::Text => format!("{comma}{}: {written}", print::identifier(param)),
            Syntax::Json => format!("{comma}\"{param}\": {written}"),
        };
        Some(Edit { span: Span { start: end, end, ..call }, text })
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
        let again = call.binds;
        let proposed = Proposed { primitive: call.primitive, args: call.args.to_vec(), result: None, again };
        let mut step = self.call(&proposed, &Renamed::new())?;
        let is_one_block = found.place.parent == before.place.parent && found.place.slot == before.place.slot;
        if binding.uses <= 1 && is_one_block {
            step.bind = Some(Name { text: bound.clone(), span: Span::default() });
            let insert = self.insert_before(before.span, &self.texts(&[step]))?;
            let edits = vec![self.without(found.span)?, insert];
            return Some(Fix { title: format!("perceive `{bound}` just before it is used"), edits });
        }
        let fresh = self.fresh(bound)?;
        step.bind = Some(Name { text: fresh.clone(), span: Span::default() });
        let written = self.binding(&fresh);
        let title = format!("perceive it again as `{fresh}`");
        let insert = self.insert_before(before.span, &self.texts(&[step]))?;
        Some(Fix { title, edits: vec![insert, Edit { span: used, text: written }] })
    }

    /// A name in place of another as the form has it: in JSON with the quotes and the `$` of what it replaces, in text in
    /// back-quotes where it needs them. A number or a quantity, which is no name, stays.
    pub(super) fn in_form(&self, code: Code, fix: &mut Fix) {
        let is_number = matches!(code.0, "M0302" | "M0310");
        for edit in fix.edits.iter_mut().filter(|_| !is_number) {
            let old = self.parsed.text.get(edit.span.range()).unwrap_or_default();
            edit.text = match old.strip_prefix('"') {
                None => print::identifier(&edit.text),
                Some(rest) => {
                    // The same name without its `$` is an entity where no binding is.
                    let is_entity = rest.strip_prefix('$').and_then(|rest| rest.strip_suffix('"'))
                        == Some(edit.text.as_str());
                    let sigil = if rest.starts_with('$') && !is_entity { "$" } else { "" };
                    format!("\"{sigil}{}\"", edit.text.replace('\\', "\\\\").replace('"', "\\\""))
                }
            };
        }
    }

    fn step(&self, id: StepId) -> Option<&Step> {
        self.program.step(id)
    }

    fn texts(&self, calls: &[Do]) -> Vec<String> {
        calls.iter().map(|call| print::call(call, self.parsed.syntax)).collect()
    }

    /// Calls as the document would write them, and the new names of what they perceive once more.
    fn calls(&self, proposed: &[Proposed]) -> Option<(Vec<Do>, Renamed)> {
        let mut renamed = Renamed::new();
        let mut calls = Vec::with_capacity(proposed.len());
        for call in proposed {
            let mut step = self.call(call, &renamed)?;
            if let Some(again) = call.again {
                let name = self.fresh(&self.program.bindings.get(again.index())?.name)?;
                step.bind = Some(Name { text: name.clone(), span: Span::default() });
                renamed.push((again, name));
            }
            calls.push(step);
        }
        Some((calls, renamed))
    }

    /// A call as the document would write it, with bindings by their new names. Defaults are left unsaid.
    fn call(&self, proposed: &Proposed, renamed: &Renamed) -> Option<Do> {
        let def = self.library.primitive(proposed.primitive)?;
        let span = Span::default();
        let mut args = Vec::new();
        let mut is_plain = self.parsed.syntax == Syntax::Text;
        for (term, param) in proposed.args.iter().zip(&def.params) {
            if param.default.as_ref() == Some(term) {
                is_plain = false;
                continue;
            }
            let value = Expr { kind: self.value(term, renamed)?, span };
            let name = (!is_plain).then(|| Name { text: param.name.clone(), span });
            args.push(Arg { name, value, span });
        }
        let call = Call { name: Name { text: def.name.clone(), span }, args, span };
        Some(Do { call, bind: None, within: None, retry: None })
    }

    fn value(&self, term: &Term, renamed: &Renamed) -> Option<ExprKind> {
        let new =
            |id: &BindingId| renamed.iter().rev().find(|(old, _)| old == id).map(|(_, name)| name.clone());
        if let Term::Binding(id) = term {
            let bound = self.program.bindings.get(id.index())?;
            return Some(ExprKind::Binding(new(id).unwrap_or_else(|| bound.name.clone())));
        }
        spelled(term, self.library, self.world)
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
        match self.parsed.syntax {
            Syntax::Text => "",
            Syntax::Json => ",",
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
        if self.parsed.syntax == Syntax::Json {
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

/// A value as a policy writes it; none for one that has no word in the language, or whose word its place decides.
pub(crate) fn spelled(term: &Term, library: &Library, world: &World) -> Option<ExprKind> {
    Some(match term {
        // A symbol has no name but that of a binding.
        Term::Entity(entity) => ExprKind::Name(world.entities().name(*entity)?.clone()),
        Term::Case(of, case) => ExprKind::Name(library.case_name(*of, *case).into()),
        Term::Text(text) => ExprKind::Text(text.clone()),
        Term::Bool(value) => ExprKind::Bool(*value),
        // A number would need the unit that its parameter has; no primitive that makes a fact asks for one.
        Term::Int(_)
        | Term::Number(_)
        | Term::List(_)
        | Term::Binding(_)
        | Term::Param(_)
        | Term::Result
        | Term::Each
        | Term::Field(..)
        | Term::Measure(..)
        | Term::Arith(..)
        | Term::Unknown => return None,
    })
}

/// "insert `go(table)` before"
fn title(verb: &str, calls: &[Do], place: &str) -> String {
    let calls: Vec<_> = calls.iter().map(|call| format!("`{}`", print::call(call, Syntax::Text))).collect();
    format!("{verb} {} {place}", calls.join(", "))
}

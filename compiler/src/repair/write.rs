//! Repairs as edits of a document, in its own syntax and layout.

use std::cell::OnceCell;

use motet_syntax::ast::{Do, Name};
use motet_syntax::{Code, Diagnostic, Edit, Fix, Parsed, Span, Syntax, print};
use rustc_hash::FxHashMap;
use smallvec::SmallVec;
use smol_str::{SmolStr, format_smolstr};

use super::{Applicability, Repair};
use crate::declare::Library;
use crate::environment::Environment;
use crate::ir::{BindingId, Fluent, Kind, Program, Step, StepId, StepKind, Term};
use crate::plan::achievers::{CandidateCall, spell_call};

/// New names of bindings.
type Renamed = SmallVec<[(BindingId, SmolStr); 2]>;

/// A document with its meaning.
pub(super) struct Writer<'a> {
    pub(super) parsed: &'a Parsed,
    pub(super) program: &'a Program,
    pub(super) library: &'a Library,
    pub(super) environment: &'a Environment,
    /// First step at each span.
    pub(super) spans: OnceCell<FxHashMap<Span, StepId>>,
}

impl Writer<'_> {
    /// Writes a repair as edits; `None` if a call has no spelling.
    pub(super) fn fix(&self, repair: &Repair) -> Option<Fix> {
        match repair {
            Repair::Before(id, calls) | Repair::Earlier(id, calls) => {
                let step = self.step(*id)?;
                let (calls, renamed) = self.calls(calls)?;
                let texts = self.texts(&calls);
                let title = title("insert", &texts, "before this step");
                let mut edits = vec![self.insert_before(step.span, &texts)?];
                edits.extend(self.in_place_of(step, &renamed));
                Some(Fix { title, edits })
            }
            Repair::After(id, calls) => {
                let (calls, _) = self.calls(calls)?;
                let texts = self.texts(&calls);
                let title = title("add", &texts, "at the end");
                Some(Fix { title, edits: vec![self.insert_after(self.step(*id)?.span, &texts)?] })
            }
            Repair::Watch(id, fluent) => self.watched(*id, *fluent),
            Repair::Test(id, condition) => self.tested(*id, condition),
            Repair::Again { found, before, used } => self.again(*found, *before, *used),
            Repair::Drop(id) => {
                let edit = self.without(self.step(*id)?.span)?;
                Some(Fix {
                    title: "remove this step: its effects already hold".to_owned(),
                    edits: vec![edit],
                })
            }
        }
    }

    /// Degree to which a repair of a code may be applied without asking.
    pub(super) fn applicability(&self, repair: &Repair, code: Code) -> Applicability {
        match repair {
            Repair::Before(_, calls) | Repair::Earlier(_, calls) | Repair::After(_, calls)
                if !self.are_named(calls) =>
            {
                Applicability::Shown
            }
            // A lint of intent: what the policy ends with may be what it is for.
            Repair::Before(..) | Repair::Earlier(..) | Repair::After(..) if code.0.starts_with("M09") => {
                Applicability::Unsafe
            }
            Repair::Before(..) | Repair::Earlier(..) | Repair::After(..) => Applicability::Safe,
            Repair::Again { .. } | Repair::Watch(..) => Applicability::Safe,
            Repair::Drop(_) | Repair::Test(..) => Applicability::Unsafe,
        }
    }

    /// Returns whether the document names every entity in calls, by its name or by a description.
    fn are_named(&self, calls: &[CandidateCall]) -> bool {
        let entities = calls.iter().flat_map(|call| &call.args).filter_map(|arg| match arg {
            Term::Entity(entity) => Some(*entity),
            _ => None,
        });
        entities.into_iter().all(|entity| {
            let is_described =
                |text: &SmolStr| self.environment.described(self.library, text, Kind::ROOT).contains(&entity);
            let mut texts = self.program.bindings.iter().flat_map(|binding| &binding.descriptions).flatten();
            texts.any(is_described) || has_word(&self.parsed.text, &self.environment.name(entity))
        })
    }

    /// Puts a monitor around a step that binds no value.
    fn watched(&self, id: StepId, fluent: Fluent) -> Option<Fix> {
        let step = self.step(id)?;
        if !matches!(&step.kind, StepKind::Call(call) if call.binds.is_none()) {
            return None;
        }
        let name = &self.library.fluent(fluent)?.name;
        let (before, after) = match self.parsed.syntax {
            Syntax::Text => {
                (format!("monitor when {}() then pause during {{ ", print::identifier(name)), " }")
            }
            Syntax::Json => (
                format!(
                    "{{\"monitor\": [{{\"when\": {{\"is\": \"{name}\"}}, \
                     \"then\": {{\"react\": \"pause\"}}}}], \"during\": ["
                ),
                "]}",
            ),
        };
        let edits = around(step.span, before, after);
        Some(Fix { title: format!("watch `{name}` meanwhile, and pause"), edits })
    }

    /// Puts a test around a step that binds no value.
    fn tested(&self, id: StepId, condition: &str) -> Option<Fix> {
        let step = self.step(id)?;
        if !matches!(&step.kind, StepKind::Call(call) if call.binds.is_none()) {
            return None;
        }
        let (before, after) = match self.parsed.syntax {
            Syntax::Text => (format!("if {condition} {{ "), " }"),
            Syntax::Json => (format!("{{\"if\": \"{}\", \"then\": [", self.with_sigils(condition)), "]}"),
        };
        let edits = around(step.span, before, after);
        Some(Fix { title: format!("test it first: `if {condition} {{ … }}`"), edits })
    }

    /// A condition with a `$` before every name that is bound, as JSON needs it.
    fn with_sigils(&self, condition: &str) -> String {
        let is_part = |letter: char| letter.is_alphanumeric() || letter == '_';
        let mut text = String::new();
        for piece in condition.split_inclusive(|letter| !is_part(letter)) {
            let name = piece.trim_end_matches(|end| !is_part(end));
            let is_bound = self.program.bindings.iter().any(|bound| bound.name == name);
            if is_bound && !piece.ends_with('(') {
                text.push('$');
            }
            text.push_str(piece);
        }
        text
    }

    /// Replaces bindings by their new names in the arguments of a step.
    fn in_place_of(&self, step: &Step, renamed: &Renamed) -> Vec<Edit> {
        let StepKind::Call(call) = &step.kind else { return Vec::new() };
        let args = call.args.iter().zip(&call.spans);
        let edits = args.filter_map(|(arg, span)| {
            let (_, name) = renamed.iter().find(|(id, _)| *arg == Term::Binding(*id))?;
            Some(Edit { span: *span, text: self.binding(name) })
        });
        edits.collect()
    }

    /// Spelling of a binding in the syntax of the document.
    fn binding(&self, name: &str) -> String {
        match self.parsed.syntax {
            Syntax::Text => print::identifier(name),
            Syntax::Json => format!("\"${name}\""),
        }
    }

    /// An unused name: `mug_2`.
    fn fresh(&self, bound: &str) -> Option<SmolStr> {
        let is_taken = |name: &SmolStr| self.program.bindings.iter().any(|other| other.name == *name);
        (2..).map(|count| format_smolstr!("{bound}_{count}")).find(|name| !is_taken(name))
    }

    /// Fix for a missing or wrong value, if only one entity of the environment fits.
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
        let mut fitting = self.environment.entities().iter().filter(|row| self.library.is_kind(row.2, kind));
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
        Some(Fix { title: format!("write `{name}`, the only one that fits"), edits: vec![edit] })
    }

    /// Adds an argument to a call.
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

    /// Fix for an unreachable step: removes it and the rest of its block. The first step of a block stays,
    /// since a block must not be empty, and so does all that has a mistake: to remove it would not mend it.
    pub(super) fn leaving_out(&self, said: &Diagnostic, wrong: &[Span]) -> Option<Fix> {
        if said.code.0 != "M0902" {
            return None;
        }
        let spans = self.spans.get_or_init(|| {
            let mut first = FxHashMap::default();
            for (id, step) in (0..).map(StepId).zip(&self.program.steps) {
                first.entry(step.span).or_insert(id);
            }
            first
        });
        let step = self.step(*spans.get(&said.span)?)?;
        let place = step.position;
        if place.index == 0 {
            return None;
        }
        let rest = self.program.steps.iter().filter(|other| {
            let position = other.position;
            position.parent == place.parent && position.slot == place.slot && position.index >= place.index
        });
        let mut removed = step.span;
        for other in rest {
            // What could not be read has the span of its whole block.
            if matches!(other.kind, StepKind::Unknown) {
                return None;
            }
            if other.span.file == step.span.file {
                removed = removed.to(other.span);
            }
        }
        if wrong.iter().any(|span| removed.contains(*span)) {
            return None;
        }
        Some(Fix { title: "remove the unreachable steps".to_owned(), edits: vec![self.without(removed)?] })
    }

    /// Repeats a perception: moves it if its value has no other use, else copies it under a new name.
    fn again(&self, found: StepId, before: StepId, used: Span) -> Option<Fix> {
        let (found, before) = (self.step(found)?, self.step(before)?);
        let StepKind::Call(call) = &found.kind else { return None };
        let binding = self.program.bindings.get(call.binds?.index())?;
        let bound = &binding.name;
        let again = call.binds;
        let proposed =
            CandidateCall { primitive: call.primitive, args: call.args.to_vec(), result: None, again };
        let mut step = self.call(&proposed, &Renamed::new())?;
        let is_one_block =
            found.position.parent == before.position.parent && found.position.slot == before.position.slot;
        if binding.uses <= 1 && is_one_block {
            step.bind = Some(Name { text: bound.clone(), span: Span::default() });
            let insert = self.insert_before(before.span, &self.texts(&[step]))?;
            let edits = vec![self.without(found.span)?, insert];
            return Some(Fix { title: format!("perceive `{bound}` just before its use"), edits });
        }
        let fresh = self.fresh(bound)?;
        step.bind = Some(Name { text: fresh.clone(), span: Span::default() });
        let written = self.binding(&fresh);
        let title = format!("perceive it again as `{fresh}`");
        let insert = self.insert_before(before.span, &self.texts(&[step]))?;
        Some(Fix { title, edits: vec![insert, Edit { span: used, text: written }] })
    }

    /// Adapts the name in a fix to the syntax: in JSON with the quotes and the `$` of the name that it
    /// replaces, in text in back-quotes if it needs them. Numbers, quantities, manners, whole steps and other
    /// notations stay.
    /// `None` if the name is not written in the document as it is: in a string with escapes, or as a part of
    /// a shape.
    pub(super) fn in_form(&self, code: Code, mut fix: Fix) -> Option<Fix> {
        let is_no_name = matches!(code.0, "M0226" | "M0302" | "M0310" | "M0315");
        for edit in fix.edits.iter_mut().filter(|_| !is_no_name) {
            let old = self.parsed.text.get(edit.span.range()).unwrap_or_default();
            let is_object = edit.text.starts_with('{');
            if is_object || is_step(old) && is_step(&edit.text) {
                continue;
            }
            if old.starts_with(['{', '[']) || old.starts_with('"') && old.contains('\\') {
                return None;
            }
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
        Some(fix)
    }

    fn step(&self, id: StepId) -> Option<&Step> {
        self.program.step(id)
    }

    fn texts(&self, calls: &[Do]) -> Vec<String> {
        calls.iter().map(|call| print::call(call, self.parsed.syntax)).collect()
    }

    /// Writes calls, and the new names of the values that they perceive again.
    fn calls(&self, proposed: &[CandidateCall]) -> Option<(Vec<Do>, Renamed)> {
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

    /// Writes a call, with bindings by their new names, without defaults.
    fn call(&self, proposed: &CandidateCall, renamed: &Renamed) -> Option<Do> {
        let name_of = |id: BindingId| match renamed.iter().rev().find(|(old, _)| *old == id) {
            Some((_, name)) => Some(name.clone()),
            None => Some(self.program.bindings.get(id.index())?.name.clone()),
        };
        spell_call(proposed, self.library, self.environment, self.parsed.syntax, name_of)
    }

    /// Inserts steps before a span, each on its own line if the step there has one.
    fn insert_before(&self, place: Span, steps: &[String]) -> Option<Edit> {
        let gap = self.gap(place)?;
        let comma = self.comma();
        let text = steps.iter().map(|step| format!("{step}{comma}{gap}")).collect();
        Some(Edit { span: Span { end: place.start, ..place }, text })
    }

    /// Inserts steps after a span.
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

    /// Separator between steps: a line break with the indentation of the step, or a blank if it shares its
    /// line.
    fn gap(&self, place: Span) -> Option<String> {
        let before = self.parsed.text.get(..place.start as usize)?;
        let line = before.rsplit('\n').next().unwrap_or_default();
        let is_alone = before.contains('\n') && line.trim().is_empty();
        Some(if is_alone { format!("\n{line}") } else { " ".to_owned() })
    }

    /// Removes a step, and in JSON a comma beside it.
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

/// Edits that put text around a step.
fn around(place: Span, before: String, after: &str) -> Vec<Edit> {
    vec![
        Edit { span: Span { end: place.start, ..place }, text: before },
        Edit { span: Span { start: place.end, ..place }, text: after.to_owned() },
    ]
}

/// Checks if a text has a name as a whole word.
fn has_word(text: &str, name: &str) -> bool {
    let is_part = |letter: char| letter.is_alphanumeric() || letter == '_';
    !name.is_empty()
        && text.match_indices(name).any(|(at, _)| {
            let (before, after) = (text.get(..at), text.get(at + name.len()..));
            let joins = |letter: Option<char>| letter.is_some_and(is_part);
            !joins(before.and_then(|before| before.chars().next_back()))
                && !joins(after.and_then(|after| after.chars().next()))
        })
}

/// Checks if a text is a step or an ending and no name.
fn is_step(text: &str) -> bool {
    let first = text.split(' ').next().unwrap_or_default();
    text.starts_with('{')
        || text.ends_with(')')
        || matches!(first, "done" | "fail" | "cannot" | "replan" | "wait")
}

/// Title of a fix: "insert `go(table)` before this step".
fn title(verb: &str, steps: &[String], place: &str) -> String {
    let steps: Vec<_> = steps.iter().map(|step| format!("`{step}`")).collect();
    format!("{verb} {} {place}", steps.join(", "))
}

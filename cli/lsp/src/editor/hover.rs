//! Explanations of a place in a document, as Markdown: the declaration of the name there, the verdicts on the
//! step, and the facts that the check knows before it.

use std::collections::BTreeSet;

use motet_compiler::incremental::{FactCause, KnownFact, KnownTruth};
use motet_compiler::{MotionInspection, Session, StepInspection};
use motet_syntax::ast::Step;
use motet_syntax::{Parsed, Source, Span};

use super::declarations::{Declaration, DeclarationKind, Declarations};
use super::names::{NameSpace, Occurrence, name_at, occurrences};
use super::point::{PointState, step_at};

/// Greatest number of facts that are shown of one group.
const MAX_FACTS: usize = 24;

/// Document with what its names mean.
pub(crate) struct HoverSource<'a> {
    pub(crate) session: &'a Session,
    pub(crate) parsed: &'a Parsed,
    /// Declarations of the project, and those of the document.
    pub(crate) declarations: [&'a Declarations; 2],
    /// Source of a file of the project.
    pub(crate) source: &'a dyn Fn(Span) -> Option<Source>,
    /// Result of the last check, of the same text.
    pub(crate) steps: &'a [StepInspection],
}

/// Explanation of a range.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct HoverText {
    pub(crate) markdown: String,
    pub(crate) span: Span,
}

/// Explains the place at an offset; `None` outside of names and steps.
pub(crate) fn hover(given: &HoverSource<'_>, offset: usize) -> Option<HoverText> {
    let all = occurrences(given.parsed);
    let named = name_at(&all, offset);
    let step = step_at(given.parsed, offset);
    let mut parts = Vec::new();
    parts.extend(named.and_then(|named| given.name(named)));
    if let Some(step) = step {
        parts.extend(given.verdict(step));
        parts.extend(given.known(step, &all));
    }
    let span = named.map(|named| named.span).or(step.map(|step| step.span))?;
    (!parts.is_empty()).then(|| HoverText { markdown: parts.join("\n\n---\n\n"), span })
}

impl HoverSource<'_> {
    /// Explanation of a name.
    fn name(&self, named: &Occurrence) -> Option<String> {
        let declared = self.declarations.iter().rev().find_map(|all| all.get(named.space, &named.name));
        if let Some(declared) = declared {
            return self.declaration(named, declared);
        }
        let signatures = self.session.signatures();
        match named.space {
            NameSpace::Value => {
                let entity = signatures.entities.iter().find(|(name, _)| *name == named.name);
                let kind = entity.and_then(|(_, kind)| signatures.kinds.get(*kind));
                kind.map(|kind| code(&format!("entity {}: {}", named.name, kind.name)))
            }
            NameSpace::Callable => {
                let def = signatures.callable(&named.name)?;
                let params = def.params.iter();
                let params =
                    params.map(|param| format!("{}: {}", param.name, signatures.type_name(&param.ty)));
                let word = if def.is_policy { "policy" } else { "action" };
                let params = params.collect::<Vec<_>>().join(", ");
                Some(code(&format!("{word} {}({params})", named.name)))
            }
            _ => None,
        }
    }

    fn declaration(&self, named: &Occurrence, declared: &Declaration) -> Option<String> {
        let source = (self.source)(declared.span)?;
        let mut text = match declared.kind {
            DeclarationKind::Entity => {
                let entity = self.session.scene().and_then(|scene| scene.entities.get(&named.name));
                let line = match entity {
                    Some(entity) => {
                        let mut line = format!("entity {}: {}", named.name, entity.kind);
                        if let Some(mass) = entity.mass_kg {
                            line.push_str(&format!(", {mass} kg"));
                        }
                        if let Some(width) = entity.width() {
                            line.push_str(&format!(", {:.1} cm wide", width * 100.0));
                        }
                        line
                    }
                    None => source.slice(declared.whole).to_owned(),
                };
                code(&line)
            }
            DeclarationKind::Robot => code(&format!("robot {}", named.name)),
            DeclarationKind::Policy => {
                let whole = source.slice(declared.whole);
                let head = whole.split_once('{').map_or(whole, |(head, _)| head);
                code(&without_doc(head))
            }
            _ => code(&without_doc(source.slice(declared.whole))),
        };
        if !declared.doc.is_empty() {
            text.push_str("\n\n");
            text.push_str(&declared.doc);
        }
        let place = if source.name.is_empty() { "this document" } else { &*source.name };
        text.push_str(&format!("\n\n*{} of {place}*", declared.kind.word()));
        Some(text)
    }

    /// Verdicts of the last check on a call.
    fn verdict(&self, step: &Step) -> Option<String> {
        let found = self.steps.iter().find(|found| found.span == step.span)?;
        let mut text = format!("**Takes** {}", time(found.least_secs, found.greatest_secs));
        let Some(call) = &found.call else { return Some(text) };
        if call.needs > 0 {
            let proven = call.needs - call.guards.len().min(call.needs);
            text.push_str(&format!("  \n**Needs** {proven} of {} proven", call.needs));
            if !call.guards.is_empty() {
                text.push_str(&format!("; checked just before the step: {}", call.guards.join(", ")));
            }
        }
        match &call.motion {
            MotionInspection::Absent => {}
            MotionInspection::Feasible => text.push_str("  \n**Motion** feasible, with a path as witness"),
            MotionInspection::Deferred(None) => text.push_str("  \n**Motion** left to the run"),
            MotionInspection::Deferred(Some(why)) => {
                text.push_str(&format!("  \n**Motion** left to the run: {why}"));
            }
            MotionInspection::Caught(why) => {
                text.push_str(&format!("  \n**Motion** infeasible, and caught: {why}"));
            }
        }
        Some(text)
    }

    /// Facts that are known before a step.
    fn known(&self, step: &Step, all: &[Occurrence]) -> Option<String> {
        let mut state = PointState::before(self.session, self.parsed, step.span)?;
        if !state.checker.is_live() {
            return Some("Nothing leads to this step.".to_owned());
        }
        let named: BTreeSet<&str> = all
            .iter()
            .filter(|place| step.span.contains(place.span))
            .filter(|place| matches!(place.space, NameSpace::Local | NameSpace::Value))
            .map(|place| place.name.as_str())
            .collect();
        let facts = state.facts();
        let (changed, start): (Vec<_>, Vec<_>) =
            facts.iter().partition(|fact| matches!(fact.cause, FactCause::Step { .. }));
        // Of all that holds at the start, only what the step speaks of.
        let is_named = |fact: &&&KnownFact| fact.args.iter().any(|arg| named.contains(arg.as_str()));
        let start: Vec<_> = start.iter().filter(is_named).copied().collect();
        let mut lines = vec!["**Known here**".to_owned()];
        for group in [changed, start] {
            lines.extend(group.iter().take(MAX_FACTS).map(|fact| self.fact(fact)));
            if let Some(more) = group.len().checked_sub(MAX_FACTS).filter(|more| *more > 0) {
                lines.push(format!("- … and {more} more"));
            }
        }
        (lines.len() > 1).then(|| lines.join("\n"))
    }

    fn fact(&self, fact: &KnownFact) -> String {
        let text = match fact.truth {
            KnownTruth::Holds => format!("- `{}`", fact.text),
            KnownTruth::Fails => format!("- `not {}`", fact.text),
            KnownTruth::Differs => format!("- `{}` on some paths only", fact.text),
            KnownTruth::Unobserved => format!("- `{}` is unknown", fact.text),
        };
        let why = match &fact.cause {
            FactCause::Nothing => String::new(),
            FactCause::Start => " since the start".to_owned(),
            FactCause::Step { span, name } => match (self.source)(*span) {
                Some(source) if source.name.is_empty() => {
                    format!(" by `{name}` in line {}", source.line_column(span.start).0)
                }
                Some(_) | None => format!(" by `{name}`"),
            },
        };
        text + &why
    }
}

/// Bounds of a duration in words.
pub(crate) fn time(least: f64, greatest: f64) -> String {
    let shown = |secs: f64| match secs {
        secs if secs < 10.0 => format!("{} s", (secs * 10.0).round() / 10.0),
        secs if secs < 120.0 => format!("{} s", secs.round()),
        secs if secs < 7200.0 => format!("{} min", (secs / 60.0).round()),
        secs => format!("{} h", (secs / 3600.0).round()),
    };
    match (shown(least), shown(greatest)) {
        (least, greatest) if least == greatest => least,
        (least, greatest) => format!("{least} to {greatest}"),
    }
}

fn code(text: &str) -> String {
    format!("```motet\n{}\n```", text.trim())
}

/// Text of a declaration without the `///` lines above it.
fn without_doc(text: &str) -> String {
    let lines = text.lines().filter(|line| !line.trim_start().starts_with("///"));
    lines.collect::<Vec<_>>().join("\n")
}

#[cfg(test)]
mod tests {
    use motet_project::{DOCUMENT, Discard, Project};
    use motet_syntax::{Source, Span};

    use super::{HoverSource, hover};
    use crate::editor::declarations::Declarations;

    fn shown(text: &str, at: &str) -> String {
        let project = Project::builder().robot("hsr").scene("kitchen").without_motions();
        let project = project.open().unwrap().into_session(&mut Discard).unwrap();
        let source = Source::new("", text);
        let parsed = motet_syntax::read(&source, DOCUMENT);
        let (_, steps) = project.session.inspect_document(&parsed);
        let (own, library) = (Declarations::of_file(&parsed.file), Declarations::of_project(&project));
        let sources = project.sources(source);
        let given = HoverSource {
            session: &project.session,
            parsed: &parsed,
            declarations: [&library, &own],
            source: &|span: Span| sources.get(span.file).cloned(),
            steps: &steps,
        };
        hover(&given, text.find(at).unwrap()).map(|found| found.markdown).unwrap_or_default()
    }

    #[test]
    fn hover_explains_a_call_and_what_is_known() {
        let text = "policy p for hsr {\n    go(kitchen_table)\n    pick(mug_1)\n    go(user)\n}";
        let pick = shown(text, "pick");
        for part in [
            "action pick(object: Object",
            "needs ",
            "*action of stdlib/manipulation.motet*",
            "**Needs**",
            "- `on(mug_1, kitchen_table)` since the start",
            "by `go(kitchen_table)` in line 2",
        ] {
            assert!(pick.contains(part), "{part} is not in\n{pick}");
        }
        let go = shown(text, "go(user)");
        assert!(go.contains("- `holding(mug_1)` by `pick(mug_1)` in line 3"), "{go}");
        assert!(shown(text, "mug_1").contains("entity mug_1: Object, 0.3 kg"));
        assert!(shown(text, "hsr").contains("robot hsr"));
    }

    #[test]
    fn hover_explains_what_the_document_declares() {
        let text = "/// Lights a lamp.\naction light(what: Entity) makes not clear(what)\n\
            policy p { light(user) done light(user) }";
        let light = shown(text, "light(user)");
        assert!(light.contains("Lights a lamp.") && light.contains("this document"), "{light}");
        assert!(!light.contains("///"));
        assert_eq!(shown("policy p { }", "{"), "");
        assert!(shown(text, "light(user) }").contains("Nothing leads to this step."));
    }
}

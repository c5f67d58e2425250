//! Tools that decide about policies before anything moves: check, fix, explain and plan.

use motet::plan::aims;
use motet_compiler::explain_pages;
use motet_compiler::fix::{FixLimits, fix};
use motet_planner::builtin::{self, PlanError};
use motet_project::DOCUMENT;
use motet_syntax::{Diagnostic, Severity, Source, Sources, render, suggest};
use serde_json::{Value, json};

use super::answer::{Refusal, first};
use super::environment::AgentEnvironment;
use super::text::{read, within};

/// The most diagnostics of an answer.
const MAX_DIAGNOSTICS: usize = 40;
/// The most fixes that are applied to a policy.
const MAX_FIXES: usize = 100;

/// Checks a policy. Returns its findings, what is left to the run, and a fixed policy where the safe fixes
/// change it.
pub(super) fn check(situation: &AgentEnvironment, text: &str) -> Result<Value, Refusal> {
    let (source, parsed) = read(text)?;
    let session = &situation.session;
    let checked = session.check_document(&parsed);
    let is_runnable = parsed.file.runnable().next().is_some();
    let has_error = checked.diagnostics.iter().any(is_error);
    let left: usize = checked.policies.iter().map(|one| one.deferred_motions).sum();
    let fixed = fix(session, &source, DOCUMENT, FixLimits::safe(MAX_FIXES));
    let sources = situation.project.sources(source);
    let mut answer = findings(&checked.diagnostics, &sources);
    if let Some(answer) = answer.as_object_mut() {
        answer.insert("ok".to_owned(), (is_runnable && !has_error).into());
        answer.insert("robot".to_owned(), situation.robot_name().into());
        let policies: Vec<&str> = checked.policies.iter().map(|one| one.name.as_str()).collect();
        answer.insert("policies".to_owned(), json!(policies));
        let notes: Vec<String> =
            checked.deferred_notes.iter().map(|found| found.message.to_string()).collect();
        answer.insert(
            "left_to_run".to_owned(),
            json!({"motions": left, "needs": first(&notes, MAX_DIAGNOSTICS)}),
        );
        if !fixed.applied.is_empty() {
            let titles: Vec<&str> = fixed.applied.iter().map(|applied| applied.title.as_str()).collect();
            let has_error = fixed.diagnostics.iter().any(is_error);
            let fixed = json!({"policy": fixed.text, "applied": titles, "has_errors": has_error});
            answer.insert("fixed".to_owned(), fixed);
        }
    }
    Ok(answer)
}

/// Diagnostics as data, and in sentences for a model.
pub(super) fn findings(diagnostics: &[Diagnostic], sources: &Sources) -> Value {
    let records = diagnostics.iter().take(MAX_DIAGNOSTICS).map(|found| render::record(found, sources));
    let records: Vec<Value> =
        records.map(|record| serde_json::to_value(record).unwrap_or_default()).collect();
    json!({
        "says": render::llm(diagnostics, sources),
        "errors": diagnostics.iter().filter(|found| is_error(found)).count(),
        "diagnostics": records,
        "not_shown": diagnostics.len().saturating_sub(MAX_DIAGNOSTICS),
    })
}

fn is_error(found: &Diagnostic) -> bool {
    found.severity == Severity::Error
}

/// Page of a diagnostic code.
pub(super) fn explain(code: &str) -> Result<Value, Refusal> {
    let code = code.trim();
    if let Some(page) = explain_pages::page(code) {
        return Ok(json!({"code": page.code, "page": page.text}));
    }
    let near =
        suggest::closest(&code.to_ascii_uppercase(), explain_pages::PAGES.iter().map(|page| page.code));
    let help = match near {
        Some(near) => format!("did you mean `{near}`?"),
        None => "a code looks like M0501; `check_policy` gives them".to_owned(),
    };
    Err(Refusal::unknown("diagnostic code", code, help))
}

/// Plans a policy for a request in English, or for conditions.
pub(super) fn plan(
    situation: &AgentEnvironment,
    request: Option<&str>,
    conditions: &[String],
) -> Result<Value, Refusal> {
    let robot = Some(situation.robot()?);
    let session = &situation.session;
    let (planned, notes) = match (request, conditions) {
        (Some(request), []) => {
            within("request", request)?;
            let scene = situation.known.scene(situation.project.scene.as_ref().unwrap_or(&situation.scene));
            let context = situation.known.situation(&scene);
            match builtin::answer(session, robot, request, &context) {
                Ok(answered) => (Ok(answered.planned), answered.understood.notes),
                Err(why) => (Err(why), Vec::new()),
            }
        }
        (None, [_, ..]) => {
            conditions.iter().try_for_each(|condition| within("condition", condition))?;
            let planned = aims(conditions).map_err(PlanError::from);
            (planned.and_then(|aims| builtin::plan(session, robot, "plan", &aims)), Vec::new())
        }
        (Some(_), [_, ..]) | (None, []) => {
            return Err(Refusal::new("give `request` or `goals`, and not both"));
        }
    };
    match planned {
        Ok(planned) => {
            let sources = situation.project.sources(Source::new("plan", planned.text.as_str()));
            let warnings = render::llm(&planned.compiled.diagnostics, &sources);
            let left = planned.compiled.graph.as_ref().map_or(0, motet_graph::Graph::deferred_motions);
            let left = json!({"motions": left});
            Ok(json!({"policy": planned.text, "notes": notes, "warnings": warnings, "left_to_run": left}))
        }
        Err(why) => Err(no_plan(situation, &why)),
    }
}

/// Refusal of a request or a goal; with the policy that nearly is one.
fn no_plan(situation: &AgentEnvironment, why: &PlanError) -> Refusal {
    let refusal = Refusal::new(format!("no plan: {why}"));
    match why {
        PlanError::RequestError(_) => refusal.with_help(
            "ask for one thing at a time, named as `scene` names it, or give `goals` such as \
             on(mug_1, shelf)",
        ),
        PlanError::Refused { text, diagnostics } => {
            let found = findings(diagnostics, &situation.project.sources(Source::new("plan", text.as_str())));
            refusal
                .with_help("change the policy that does not check, or ask for less")
                .with(json!({"policy": text, "says": found.get("says")}))
        }
        _ => refusal.with_help("write a policy yourself, and let `check_policy` check it"),
    }
}

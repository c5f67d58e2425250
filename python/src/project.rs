//! Projects: a robot in a scene, against which policies are checked, compiled, planned and run.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use motet::document::{self, MAX_FIXES, is_broken, is_reply};
use motet::planner::builtin::PlanError;
use motet::project::files::{Bytes, read_file};
use motet::project::{DOCUMENT, DiagnosticSink, ProjectError};
use motet::{Compiled, ProjectSession, plan};
use motet_compiler::fix::{Applicability, FixLimits, fix};
use motet_robots::clearance::ClearanceOverride;
use motet_syntax::ast::MAX_BYTES;
use motet_syntax::{Parsed, Source};
use pyo3::prelude::*;

use crate::errors::{input_error, raised};
use crate::findings::Findings;
use crate::graph::{Graph, Opened, syntax_of};

/// A robot in a scene, opened from names, paths and JSON.
#[pyclass(frozen, module = "motet._motet")]
pub(crate) struct Project {
    inner: Mutex<Inner>,
    /// Findings on the files of the project.
    inputs: Findings,
}

struct Inner {
    project: motet::Project,
    /// Findings on the files of each robot, by its name.
    of_robots: BTreeMap<String, Findings>,
}

/// Document after its fixes, each fix as code, title and safety, and the findings on what is left.
type Fixed = (Option<String>, Vec<(String, String, bool)>, Findings);

/// Document that is read, with its session and the findings on the inputs.
struct Read {
    source: Source,
    parsed: Parsed,
    opened: Opened,
    findings: Findings,
    /// Is `true` if the source is the document as it is.
    is_text: bool,
}

impl Project {
    /// Session for a document, and the findings on all inputs of it.
    fn session(&self, parsed: &Parsed) -> Result<(Opened, Findings), ProjectError> {
        let mut inner = self.inner.lock().unwrap_or_else(PoisonError::into_inner);
        let Inner { project, of_robots } = &mut *inner;
        let mut news = Findings::default();
        let opened = project.shared_session_for(&parsed.file, &mut news)?;
        let robot = opened.robot.as_ref().map(|robot| robot.name.to_string()).unwrap_or_default();
        let known = of_robots.entry(robot).or_insert(news);
        let mut all = self.inputs.clone();
        all.extend(known);
        Ok((opened, all))
    }

    /// Reads a document from its bytes, or else from the file of its name.
    fn read(&self, name: &str, bytes: Option<&[u8]>) -> Result<Read, ProjectError> {
        let bytes = match bytes {
            None => read_file(Path::new(name))?,
            Some(bytes) if bytes.len() > MAX_BYTES => Bytes::TooMany(bytes.len()),
            Some(bytes) => Bytes::All(bytes.to_vec()),
        };
        let (source, parsed) = document::parse(name, &bytes, None);
        let (opened, findings) = self.session(&parsed)?;
        let is_text = matches!(&bytes, Bytes::All(bytes) if bytes == source.text.as_bytes());
        Ok(Read { source, parsed, opened, findings, is_text })
    }

    /// Reads and compiles a document. The findings are those on the inputs and on the document.
    fn compiled(
        &self,
        name: &str,
        bytes: Option<&[u8]>,
        policy: Option<&str>,
    ) -> Result<(Read, Compiled), ProjectError> {
        let mut read = self.read(name, bytes)?;
        let compiled = read.opened.session.compile(&read.parsed, policy);
        read.findings.report(&compiled.diagnostics, &read.opened.sources(read.source.clone()));
        Ok((read, compiled))
    }
}

/// Exception for inputs that cannot be used.
fn refused(py: Python<'_>, error: ProjectError) -> PyErr {
    input_error(py, &motet::Error::from(error))
}

#[pymethods]
impl Project {
    /// Takes names, paths or JSON. `effort` is the factor of the search for motions; without one every motion
    /// is left to the run.
    #[new]
    #[expect(clippy::too_many_arguments, reason = "they are keywords")]
    #[pyo3(signature = (*, robot, scene, state, domains, max_duration, effort, base_m, arm_m))]
    fn new(
        py: Python<'_>,
        robot: Option<&str>,
        scene: Option<&str>,
        state: Option<PathBuf>,
        domains: Vec<PathBuf>,
        max_duration: Option<f64>,
        effort: Option<u16>,
        base_m: Option<f64>,
        arm_m: Option<f64>,
    ) -> PyResult<Self> {
        let mut inputs = motet::Project::builder().clearance(ClearanceOverride { base_m, arm_m });
        inputs = match effort {
            Some(effort) => inputs.motion_effort(effort),
            None => inputs.without_motions(),
        };
        inputs = robot.into_iter().fold(inputs, motet::ProjectBuilder::robot);
        inputs = scene.into_iter().fold(inputs, motet::ProjectBuilder::scene);
        inputs = state.into_iter().fold(inputs, motet::ProjectBuilder::state);
        inputs = domains.into_iter().fold(inputs, motet::ProjectBuilder::domain);
        inputs = max_duration.into_iter().fold(inputs, motet::ProjectBuilder::max_duration);
        let mut findings = Findings::default();
        let project = py.detach(|| inputs.open_with(&mut findings)).map_err(|error| refused(py, error))?;
        let inner = Mutex::new(Inner { project, of_robots: BTreeMap::new() });
        Ok(Self { inner, inputs: findings })
    }

    /// Findings of a check of a document.
    fn check(&self, py: Python<'_>, name: &str, document: Option<&[u8]>) -> PyResult<Findings> {
        let checked = py.detach(|| {
            let Read { source, parsed, opened, mut findings, .. } = self.read(name, document)?;
            let checked = opened.session.check_document(&parsed);
            let listed = document::listed(checked, &opened, false);
            if !listed.is_empty() {
                findings.report(&listed, &opened.sources(source));
            }
            Ok(findings)
        });
        checked.map_err(|error| refused(py, error))
    }

    /// Document after its fixes, the fixes as code, title and applicability, and the findings on what is
    /// left. A reply with prose around its policy stays as it is, and so does what is not text.
    fn fix(
        &self,
        py: Python<'_>,
        name: &str,
        document: Option<&[u8]>,
        unsafe_fixes: bool,
    ) -> PyResult<Fixed> {
        let limits = if unsafe_fixes { FixLimits::all(MAX_FIXES) } else { FixLimits::safe(MAX_FIXES) };
        let (text, applied) = py
            .detach(|| {
                let Read { source, parsed, opened, is_text, .. } = self.read(name, document)?;
                if !is_text || is_reply(&parsed) {
                    return Ok((None, Vec::new()));
                }
                let fixed = fix(&opened.session, &source, DOCUMENT, limits);
                let applied = fixed
                    .applied
                    .into_iter()
                    .map(|fix| (fix.code.0.to_owned(), fix.title, fix.applicability == Applicability::Safe));
                Ok((Some(fixed.text), applied.collect()))
            })
            .map_err(|error| refused(py, error))?;
        let left = text.as_ref().map(String::as_bytes).or(document);
        let findings = self.check(py, name, left)?;
        Ok((text, applied, findings))
    }

    /// Document in the canonical layout, or in another syntax; `None` with errors of syntax. The findings are
    /// those of syntax.
    fn fmt(
        &self,
        py: Python<'_>,
        name: &str,
        document: Option<&[u8]>,
        to: Option<&str>,
    ) -> PyResult<(Option<String>, Findings)> {
        let to = to.map(syntax_of).transpose()?;
        let written = py.detach(|| {
            let Read { source, parsed, opened, mut findings, .. } = self.read(name, document)?;
            findings.report(&parsed.diagnostics, &opened.sources(source.clone()));
            if is_broken(&parsed) || (to.is_none() && is_reply(&parsed)) {
                return Ok((Ok(None), findings));
            }
            let text = match to {
                None => motet_syntax::format(&source).map_err(|_| "the document is not whole".to_owned()),
                Some(to) => document::write(&parsed, None, opened.session.library(), to),
            };
            Ok((text.map(Some), findings))
        });
        let (text, findings) = written.map_err(|error| refused(py, error))?;
        let text = text.map_err(|why| raised(py, "PolicyError", (why,)))?;
        Ok((text, findings))
    }

    /// Compiled policy; `None` if the check refuses it. The findings are those on the document and its
    /// inputs.
    #[pyo3(signature = (name, document, policy))]
    pub(crate) fn compile(
        &self,
        py: Python<'_>,
        name: &str,
        document: Option<&[u8]>,
        policy: Option<String>,
    ) -> PyResult<(Option<Graph>, Findings)> {
        let compiled = py.detach(|| self.compiled(name, document, policy.as_deref()));
        let (Read { parsed, opened, findings, .. }, compiled) =
            compiled.map_err(|error| refused(py, error))?;
        let graph = compiled.graph.map(|graph| Graph { graph, parsed, opened, chosen: policy });
        Ok((graph, findings))
    }

    /// Policy for a request in English, or for conditions, as its text, the planner's notes and the compiled
    /// graph.
    #[pyo3(signature = (request, goals))]
    fn plan(
        &self,
        py: Python<'_>,
        request: Option<&str>,
        goals: Vec<String>,
    ) -> PyResult<(String, Vec<String>, Graph, Findings)> {
        let session = py.detach(|| self.session(&unnamed()));
        let (opened, mut findings) = session.map_err(|error| refused(py, error))?;
        let planned = py.detach(|| match request {
            Some(request) => plan::for_request(&opened, request)
                .map(|answered| (answered.planned, answered.understood.notes)),
            None => plan::for_goals(&opened, &goals).map(|planned| (planned, Vec::new())),
        });
        let (planned, notes) = planned.map_err(|error| no_plan(py, &error, &opened))?;
        let sources = opened.sources(Source::new("plan.motet", planned.text.as_str()));
        findings.report(&planned.compiled.diagnostics, &sources);
        let Some(graph) = planned.compiled.graph else {
            return Err(raised(py, "PlanError", ("the plan does not compile", findings.lines())));
        };
        let graph = Graph { graph, parsed: planned.parsed, opened, chosen: None };
        Ok((planned.text, notes, graph, findings))
    }
}

/// Document that names no robot.
fn unnamed() -> Parsed {
    motet_syntax::read(&Source::new("", ""), DOCUMENT)
}

fn no_plan(py: Python<'_>, error: &PlanError, opened: &ProjectSession) -> PyErr {
    let diagnostics = match error {
        PlanError::Refused { diagnostics, .. } => diagnostics.as_slice(),
        PlanError::NoPlan(motet_compiler::plan::NoPlan::Wrong { diagnostics }) => diagnostics.as_slice(),
        _ => &[],
    };
    let sources = opened.sources(Source::new("plan.motet", ""));
    let mut findings = Findings::default();
    findings.report(diagnostics, &sources);
    raised(py, "PlanError", (format!("no plan: {error}"), findings.lines()))
}

//! The story of a motion that cannot be done: which steps made the world in which it cannot.

use motet_geometry::planning::{Infeasible, InfeasibleReason, MotionQuery};
use motet_syntax::{Diagnostic, Related, Severity};
use smol_str::SmolStr;

use super::errors::{Told, refused};
use super::walk::Walk;
use super::ways::Situation;
use crate::ir::{StepId, StepKind, Term};

impl Walk<'_> {
    /// The diagnostic of a motion that is infeasible in a situation: an error where that is proven, a warning where a search
    /// found none.
    pub(super) fn refusal(
        &self,
        id: StepId,
        callee: &SmolStr,
        query: &MotionQuery,
        why: &Infeasible,
        situation: &Situation,
    ) -> Option<Diagnostic> {
        let span = self.program.steps.get(id.index())?.span;
        let why = self.geometry.explained(&situation.at, query, why);
        let culprit = match &why.reason {
            InfeasibleReason::NoFreePose { by, .. }
            | InfeasibleReason::BlockedPath { by }
            | InfeasibleReason::NotInView { by, .. } => by.as_ref(),
            InfeasibleReason::OutOfReach { .. }
            | InfeasibleReason::TooHeavy { .. }
            | InfeasibleReason::TooWide { .. } => None,
        };
        let changed = culprit.and_then(|by| Some((by, situation.changer(by)?)));
        let mut story = Vec::new();
        let mut since: Vec<Related> = Vec::new();
        if let Some((by, step)) = changed {
            story.push(format!("`{by}` is as `{}` left it", self.call_name(step)));
            since.extend(self.related("changed here", step));
        }
        if let Some(step) = situation.stands_since {
            story.push(format!("the robot stands where `{}` brought it", self.call_name(step)));
            since.extend(self.related("the robot came here", step));
        }
        if let (Some((held, _)), Some(step)) = (&situation.at.world.held, situation.held_since) {
            story.push(format!("the hand holds `{held}`"));
            since.extend(self.related("taken here", step));
        }
        let story = if story.is_empty() { String::new() } else { format!("; {}", story.join(", ")) };
        let told = Told {
            callee: callee.clone(),
            motion: query.to_string(),
            says: why.reason.to_string(),
            story,
            change: why.change.clone(),
            is_certified: why.certified,
            since,
        };
        let mut diagnostic = refused(&why.reason, span, told);
        if !why.certified {
            diagnostic.severity = Severity::Warning;
        }
        Some(diagnostic)
    }

    fn related(&self, message: &'static str, step: StepId) -> Option<Related> {
        Some(Related::new(message, self.program.steps.get(step.index())?.span))
    }

    /// A step in a word: `go(sink)`.
    fn call_name(&self, step: StepId) -> String {
        let Some(StepKind::Call(call)) = self.program.steps.get(step.index()).map(|step| &step.kind) else {
            return "a step".to_owned();
        };
        let name = self.library.primitive(call.primitive).map_or("a step", |def| def.name.as_str());
        let args = call.args.iter().filter_map(|arg| match arg {
            Term::Entity(entity) => Some(self.world.name(*entity)),
            Term::Binding(id) => self.program.bindings.get(id.index()).map(|binding| binding.name.clone()),
            _ => None,
        });
        format!("{name}({})", args.collect::<Vec<_>>().join(", "))
    }
}

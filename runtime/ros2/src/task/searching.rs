//! Steps that look for things: detections, searches from place to place, and answers that name things.

use super::{Ending, Phase, Surroundings, Task};
use crate::bind::{Direction, Step, StepKind};
use crate::observe::Found;
use crate::plan::written;
use motet_graph::Value as Argument;
use motet_host::remote::protocol::DetectedThing;
use motet_runtime::FailureReport;
use motet_stdlib::lang::failures;

impl Task {
    /// True if the primitive gives everything that is found.
    pub(super) fn finds_all(&self) -> bool {
        self.called.result.as_deref().is_some_and(|result| result.starts_with("List<"))
    }

    /// Takes in detections. What the step looks for and the scene lacks becomes a thing of the room, unless a
    /// known thing is seen that is described so: a detector may see one thing twice.
    pub(super) fn hear_detections(&mut self, around: &mut Surroundings<'_>, things: &[DetectedThing]) {
        let known: Vec<String> = things.iter().filter_map(|thing| thing.id.clone()).collect();
        let what = self.words().into_iter().next().unwrap_or_default();
        let is_seen = around.world.matches(&what).iter().any(|id| known.contains(id));
        if !is_seen {
            let unknown = things.iter().filter(|thing| thing.id.is_none());
            self.detected.extend(unknown.filter_map(|thing| around.world.discover(&what, thing)));
        }
        self.detected.extend(known);
    }

    /// Ends the step if what was looked for is detected. True if it is over.
    pub(super) fn find_detected(&mut self, around: &mut Surroundings<'_>, is_late: bool) -> bool {
        let what = self.words().into_iter().next().unwrap_or_default();
        let wanted = around.world.matches(&what);
        let mut found: Vec<String> = wanted.into_iter().filter(|id| self.detected.contains(id)).collect();
        found.sort();
        if self.finds_all() {
            if is_late {
                self.result = Some(Argument::List(found.iter().map(|id| entity(id)).collect()));
                self.step_done();
            }
            return is_late;
        }
        let ambiguous = self.called.fails.iter().any(|kind| kind == failures::AMBIGUOUS);
        match found.as_slice() {
            [] if is_late && !self.elsewhere.is_empty() => {
                self.look_elsewhere();
                true
            }
            [] if is_late => {
                self.end_in(failures::NOT_FOUND, format!("no detection is called {what}"), around);
                true
            }
            [] => false,
            [_, _, ..] if ambiguous => {
                self.end_in(
                    failures::AMBIGUOUS,
                    format!("{} detections are called {what}", found.len()),
                    around,
                );
                true
            }
            [id, ..] => {
                if let Some(place) = &self.place {
                    around.world.found(place, id);
                }
                match self.told_of(around, id) {
                    Ok(result) => {
                        self.result = result;
                        self.elsewhere.clear();
                        self.step_done();
                    }
                    Err(why) => self.fail(around, why),
                }
                true
            }
        }
    }

    fn end_in(&mut self, kind: &'static str, text: String, around: &mut Surroundings<'_>) {
        let failure = FailureReport { kind: kind.into(), text: Some(text.into()) };
        self.stop(around, Ending::Fail(failure));
    }

    /// Result of the primitive for a thing that was detected: where it is, the thing, or nothing.
    fn told_of(&self, around: &Surroundings<'_>, id: &str) -> Result<Option<Argument>, String> {
        match self.called.result.as_deref() {
            None => Ok(None),
            Some("Pose") => match around.world.pose(id) {
                Some(pose) => Ok(Some(Argument::Pose(pose.pose()))),
                None => Err(format!("the detection of `{id}` has no pose")),
            },
            Some(_) => Ok(Some(entity(id))),
        }
    }

    /// Result of an answer. Where the primitive gives a thing, the answer has to name one, of those in the
    /// argument `among` if there is one.
    pub(super) fn answered(
        &self,
        around: &Surroundings<'_>,
        found: Found,
    ) -> Result<Option<Argument>, String> {
        if self.called.result.is_none() {
            return Ok(None);
        }
        let text = match found {
            Found::Truth(truth) => return Ok(Some(Argument::Bool(truth))),
            Found::Number(number) => return Ok(Some(Argument::Number(number))),
            Found::Text(text) => text,
        };
        if self.called.result.as_deref() == Some("Text") {
            return Ok(Some(Argument::Text(text.into())));
        }
        let among = match self.arg("among") {
            Some(Argument::List(among)) => Some(among),
            _ => None,
        };
        let mut named = around.world.matches(&text);
        named.retain(|id| among.is_none_or(|among| among.contains(&entity(id))));
        match named.as_slice() {
            [id] => Ok(Some(entity(id))),
            named => Err(format!("the answer {text:?} names {} of the things", named.len())),
        }
    }

    fn arg(&self, name: &str) -> Option<&Argument> {
        self.command.args.iter().find(|(own, _)| own == name).map(|(_, value)| value)
    }

    /// Begins a search: each place of `around` has a way there, a look and a detection.
    pub(super) fn begin_search(&mut self, around: &mut Surroundings<'_>) -> bool {
        let places = match self.arg("around") {
            Some(Argument::List(places)) => places.clone(),
            Some(one) => vec![one.clone()],
            None => Vec::new(),
        };
        let id =
            |place: &Argument| if let Argument::Entity(id) = place { Some(id.to_string()) } else { None };
        self.elsewhere = places.iter().filter_map(id).collect();
        if self.elsewhere.is_empty() {
            self.fail(around, "the command has no argument `around` with places".to_owned());
            return true;
        }
        if let Some(step) = self.steps.front_mut() {
            step.kind = StepKind::Detect;
        }
        self.look_elsewhere();
        true
    }

    /// Goes to the next place before the detection that is due.
    fn look_elsewhere(&mut self) {
        let (Some(place), Some(step)) = (self.elsewhere.pop_front(), self.steps.front().cloned()) else {
            return;
        };
        // The command has a path to the first place.
        let leads = |motion: &motet_runtime::PlannedMotion| {
            motion.query == "go_to" && motion.args == [entity(&place)]
        };
        let way = match self.command.motions.first() {
            Some(motion) if leads(motion) => StepKind::Motion(Direction::There),
            _ => StepKind::Go(place.clone()),
        };
        self.steps.push_front(Step { kind: StepKind::Look, ..step.clone() });
        self.steps.push_front(Step { kind: way, ..step });
        (self.place, self.phase) = (Some(place), Phase::Next);
    }

    /// Motion of a step that is not that of the command, as the language writes it.
    pub(super) fn way(&self) -> Option<String> {
        match &self.steps.front()?.kind {
            StepKind::Posture(name) => Some(format!("posture({name})")),
            StepKind::Go(place) => Some(format!("go_to({})", written(&entity(place)))),
            _ => None,
        }
    }

    /// Looks for the path of such a step.
    pub(super) fn begin_way(&mut self, around: &mut Surroundings<'_>) -> bool {
        if let Some(missing) = super::unheard(around.robot) {
            return !self.waits_for(around, &missing) && self.stopping.is_some();
        }
        // What the path before has moved is elsewhere now.
        if let Some(motion) = self.command.motions.first().filter(|_| self.path.is_some())
            && let Some(Argument::Entity(id)) = motion.args.first()
            && around.world.scene.entities.get(id.as_str()).is_some_and(|entity| entity.open.is_some())
            && matches!(motion.query.as_str(), "pull" | "push")
        {
            around.world.moved(id, motion.query == "pull");
        }
        let Some(way) = self.way() else { return true };
        if let Err(why) = self.plan(around, way) {
            self.fail(around, why);
            return true;
        }
        false
    }
}

fn entity(id: &str) -> Argument {
    Argument::Entity(id.into())
}

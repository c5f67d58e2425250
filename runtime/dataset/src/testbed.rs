//! A robot in a scene, as plans are tried in it: checked, with their motions, and run in simulation.

use std::cell::OnceCell;
use std::collections::BTreeMap;
use std::sync::Arc;

use motet_compiler::{Geometry, InitialState, Session};
use motet_decode::{Grammar, Subset};
use motet_geometry::planning::SearchBudget;
use motet_graph::NodeKind;
use motet_planner::prompt::StaticPrompt;
use motet_project::{Discard, SessionInputs};
use motet_robots::card::Robot;
use motet_robots::scene::Scene;
use motet_robots::urdf::Urdf;
use motet_runtime::{Driver, Engine, RunEnd, StartState, Time};
use motet_sim::{Sim, SimOptions};
use motet_stdlib::lang::{ASKING, entities};
use motet_syntax::ast::{File, Item};
use motet_syntax::{Diagnostic, FileId, Severity, Source, Sources, Span, render};
use smol_str::SmolStr;

/// A robot with its body.
#[derive(Clone, Debug)]
pub struct Body {
    pub robot: Robot,
    /// Its links and joints; without them no motion is looked for.
    pub urdf: Option<Urdf>,
}

/// Facts about the robot itself by fluent, such as `standing`, where they are not those of its card.
pub type Posture = BTreeMap<SmolStr, bool>;

/// A robot in a scene.
#[derive(Debug)]
pub struct Testbed {
    /// Session that checks the plans.
    pub session: Session,
    /// The same without motions.
    pub(crate) base: Session,
    /// The robot's body in the scene, where motions are looked for.
    pub geometry: Option<Arc<Geometry>>,
    pub robot: Robot,
    pub scene: Scene,
    pub posture: Posture,
    kept: OnceCell<StageParts>,
}

/// Parts of prompts and replies that depend on robot and scene only.
#[derive(Debug)]
pub(crate) struct StageParts {
    pub(crate) lasting: StaticPrompt,
    pub(crate) grammar: Grammar,
}

impl Testbed {
    /// Puts a robot into a scene. With an effort, motions are looked for.
    ///
    /// # Errors
    ///
    /// Reason why the robot cannot be in that scene.
    pub fn new(
        body: &Body,
        (scene, posture): (&Scene, &Posture),
        effort: Option<SearchBudget>,
    ) -> Result<Self, String> {
        let open = |inputs: &SessionInputs<'_>| {
            inputs.open("scene", &mut Sources::default(), &mut Discard).map_err(|error| {
                let first = error.diagnostics().first();
                first.map_or_else(|| error.to_string(), |error| format!("{}: {}", error.code, error.message))
            })
        };
        Self::opened(body, (scene, posture), effort, open)
    }

    /// Puts the same robot into another scene. The library is not read again.
    ///
    /// # Errors
    ///
    /// Reason why the robot cannot be in that scene.
    pub(crate) fn elsewhere(
        &self,
        body: &Body,
        (scene, posture): (&Scene, &Posture),
        effort: Option<SearchBudget>,
    ) -> Result<Self, String> {
        let open = |inputs: &SessionInputs<'_>| {
            let session = self.base.with_scene(inputs.scene, inputs.state);
            let error = session.input_diagnostics().iter().find(|said| said.severity == Severity::Error);
            match error.map(|error| format!("{}: {}", error.code, error.message)) {
                Some(why) => Err(why),
                None => Ok(session),
            }
        };
        Self::opened(body, (scene, posture), effort, open)
    }

    fn opened(
        body: &Body,
        (scene, posture): (&Scene, &Posture),
        effort: Option<SearchBudget>,
        open: impl FnOnce(&SessionInputs<'_>) -> Result<Session, String>,
    ) -> Result<Self, String> {
        let robot = &body.robot;
        let fact = |(fluent, holds): (&SmolStr, &bool)| (written(fluent), (Some(*holds), Span::default()));
        let state = InitialState { facts: posture.iter().map(fact).collect(), ..InitialState::default() };
        let inputs = SessionInputs::of(robot, scene, Some(&state).filter(|_| !posture.is_empty()));
        let base = open(&inputs)?;
        let (session, geometry) = match (effort, &body.urdf) {
            (Some(budget), Some(urdf)) => inputs.add_motions(base.clone(), urdf, budget),
            (None, _) | (_, None) => (base.clone(), None),
        };
        let (scene, posture) = (scene.clone(), posture.clone());
        Ok(Self { session, base, geometry, robot: robot.clone(), scene, posture, kept: OnceCell::new() })
    }

    /// Parts of prompts and replies, made once.
    pub(crate) fn kept(&self) -> &StageParts {
        self.kept.get_or_init(|| StageParts {
            lasting: StaticPrompt::new(&self.session, &self.robot, &self.scene),
            grammar: Grammar::new(&self.session.signatures(), Subset::default()),
        })
    }

    /// Carries a plan out in either syntax and returns its fault. A plan without one passes the check with
    /// its motions, and a simulated run reaches the end, or the question that the plan asks.
    #[must_use]
    pub fn fault(&self, plan: &str) -> Option<String> {
        let parsed = motet_syntax::read(&Source::new("plan", plan), FileId(0));
        if let Some(extra) = parsed.file.items.iter().find(|item| !matches!(item, Item::Policy(_))) {
            return Some(format!("it declares something beside its policy: {}", what(extra)));
        }
        let compiled = self.session.compile(&parsed, None);
        let errors: Vec<Diagnostic> =
            compiled.diagnostics.into_iter().filter(|said| said.severity == Severity::Error).collect();
        let Some(graph) = compiled.graph.filter(|_| errors.is_empty()) else {
            let words = render::llm(&errors, &Sources::default());
            return Some(words.lines().next().unwrap_or("it is no policy").to_owned());
        };
        let asks = graph.nodes.iter().any(|node| {
            let NodeKind::Call(call) = &node.kind else { return false };
            let primitive = graph.primitives.get(call.primitive.index());
            primitive.is_some_and(|primitive| ASKING.contains(&primitive.name.as_str()))
        });
        let of_robot = |(fluent, holds): (&SmolStr, &bool)| ((fluent.clone(), vec![ROBOT]), *holds);
        let initial_facts = self.posture.iter().map(of_robot).collect();
        let options = SimOptions { initial_facts, ..SimOptions::default() };
        let mut sim = Sim::new(&self.robot, &self.scene, options);
        let entities = self.scene.entities.iter().map(|(id, entity)| (id.clone(), entity.kind.clone()));
        let start = StartState { entities: entities.collect(), ..StartState::default() };
        let mut engine = match Engine::new(graph, &start) {
            Ok(engine) => engine.with_capabilities(sim.capabilities()),
            Err(wrong) => {
                return Some(
                    wrong.first().map_or_else(|| "its graph is not valid".to_owned(), ToString::to_string),
                );
            }
        };
        match motet_runtime::run(&mut engine, &mut sim, &mut (), Time::ZERO) {
            RunEnd::Done { .. } | RunEnd::Declined { .. } => None,
            RunEnd::Replan { .. } if asks => None,
            RunEnd::Replan { why } => Some(format!(
                "in simulation it asks for another plan: {}",
                why.as_deref().unwrap_or("without a reason")
            )),
            RunEnd::Failed { kind, why, .. } => {
                let why = why.map(|why| format!(", {why}")).unwrap_or_default();
                Some(format!("in simulation it fails with {kind}{why}"))
            }
            RunEnd::Interrupted => Some("in simulation it is interrupted".to_owned()),
            RunEnd::Fault(fault) => Some(format!("in simulation it comes to {fault}")),
        }
    }
}

const ROBOT: SmolStr = SmolStr::new_static(entities::ROBOT);

/// A fact of a posture, as a state has it.
pub(crate) fn written(fluent: &str) -> String {
    format!("{fluent}({ROBOT})")
}

/// Description of a document's item, for messages.
fn what(item: &Item) -> String {
    let text = motet_syntax::print::text(&File { items: vec![item.clone()] });
    let line = text.lines().find(|line| !line.trim_start().starts_with("//")).unwrap_or_default();
    format!("`{}`", line.trim())
}

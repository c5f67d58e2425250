//! Scene as the robot knows it during a run, with all that it has seen.

use motet_planner::dialogue::Knowledge;
use motet_planner::runtime_check::Guard;
use motet_robots::scene::Scene;
use motet_runtime::{Answer, Detection, Engine, Query, ToldThing};

/// Scene that changes by the detections of the driver. Observers of a run pass their calls of the same name
/// on.
#[derive(Debug, Default)]
pub struct ObservedScene(Option<(Scene, Knowledge)>);

impl ObservedScene {
    /// The observed scene of a scene; without one, detections change nothing.
    #[must_use]
    pub fn new(scene: Option<Scene>) -> Self {
        Self(scene.map(|scene| (scene, Knowledge::default())))
    }

    /// Takes what the driver detects: the guard checks motions against it. Returns the facts that follow.
    pub fn detected(
        &mut self,
        seen: &[Detection],
        engine: &Engine,
        guard: Option<&mut Guard>,
    ) -> Vec<(Query, Answer)> {
        let Some((scene, known)) = &mut self.0 else { return Vec::new() };
        let (news, facts) = known.notice_seen(scene, seen, engine);
        if let Some(guard) = guard {
            guard.saw(news);
        }
        facts
    }

    /// Next thing of which the driver is to be told.
    pub fn tell(&mut self) -> Option<ToldThing> {
        self.0.as_mut()?.1.take_untold()
    }
}

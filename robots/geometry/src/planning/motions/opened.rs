//! The world after a container was opened or closed by its handle.

use crate::planning::motions::pull::away;
use crate::planning::query::answer::MotionWitness;
use crate::planning::scene::articulation::Articulation;
use crate::planning::scene::configuration::Configuration;
use crate::planning::scene::contact::AllowedCollisions;
use crate::planning::scene::scene_state::SceneState;
use crate::planning::search::context::QueryContext;
use crate::planning::search::goal_search::LAST;
use crate::planning::search::path::{ContactTally, plane};

/// How far the hand draws back from a handle, in m.
const BACK: [f64; 2] = [0.1, 0.05];
/// How far the fingers open to let go of a handle, in m.
const OPENED: [f64; 3] = [f64::INFINITY, 0.06, 0.03];

impl QueryContext<'_> {
    /// The world after a container was pulled open, or pushed closed, as a witness says: what lies in a drawer has gone with it, and
    /// the robot is back where it began; where no way leads back there, where it let go of the handle, with the arm as it was.
    /// `None` where neither was found.
    #[must_use]
    pub fn after_pull(&self, witness: &MotionWitness) -> Option<SceneState> {
        let none = AllowedCollisions::default();
        let grasp = witness.grasp.as_ref()?;
        let (hand, end) = (self.model.hand()?, witness.path.last()?);
        let (_, entity) = self.entity(&grasp.object)?;
        let opening = Articulation::new(entity, self.state)?;
        let was_open = self.state.is_open(entity);
        let (from, to) = if was_open { (1.0, 0.0) } else { (0.0, 1.0) };
        let mut state = self.state.clone();
        state.open.insert(grasp.object.clone(), !was_open);
        let moved = opening.map_moved(to) * opening.map_moved(from).inverse();
        for inside in self.scene.entities.values().filter(|entity| !entity.fixed) {
            if let Some(pose) = self.state.pose(inside)
                && opening.carries(&pose.translation.vector, from)
            {
                state.moved.insert(inside.id.clone(), moved * pose);
            }
        }
        let map_from_tip = self.model.map_from_links(end).get(hand.tip).copied()?;
        let mut there = None;
        let context = self.in_state(&state);
        let ways = OPENED.into_iter().flat_map(|width| BACK.map(|far| (width, far)));
        for (width, far) in ways {
            // No farther than the door beside it leaves room for.
            let fingers = |configuration: &Configuration| {
                hand.around(&configuration.joints, self.model.rest(), width.min(hand.card.opening_m))
            };
            let open = Configuration { base: end.base, joints: fingers(end) };
            if context.edge(end, &open, none).is_err() {
                continue;
            }
            let shift = away(&map_from_tip, hand, far);
            let Some(line) = context.line(hand, &open, &map_from_tip, &shift) else { continue };
            let line: Vec<Configuration> = line
                .iter()
                .map(|configuration| Configuration {
                    base: configuration.base,
                    joints: fingers(configuration),
                })
                .collect();
            let is_free =
                context.around(plane(&open), LAST).is_free(&line, none, &mut ContactTally::default());
            let Some(first) = line.first().filter(|_| is_free) else { continue };
            if context.leads_back(first, &map_from_tip.translation.vector) {
                return Some(state);
            }
            let [x, y, yaw] = first.base;
            let base = [x, y, crate::trigonometry::wrapped(yaw)];
            let (first, folded) =
                (first.at(base), Configuration { base, joints: self.state.robot.joints.clone() });
            let is_folded = context.unfold(&first, &folded, &mut ContactTally::default()).is_some();
            there = there.or(is_folded.then_some(folded));
        }
        drop(context);
        state.robot = there?;
        Some(state)
    }
}

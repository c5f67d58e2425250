//! Check of what a scene says about visibility: an entity that the camera sees as it stands is visible, and
//! one that it cannot be turned to see is not. Whatever geometry does not decide for certain is left alone.

use motet_geometry::planning::{
    Infeasible, InfeasibleReason, MotionAnswer, MotionQuery, ReachLength, SearchBudget,
};
use motet_robots::scene::Entity;
use motet_syntax::Diagnostic;

use super::diagnostics::SightDisagrees;
use super::geometry::{Fingerprinted, Geometry};

/// Margin by which an entity has to be beyond the range of the camera, in m: its head moves.
const BEYOND_RANGE_M: f64 = 0.3;
/// Margin by which an entity has to be beside the view of the camera, in rad: it has an extent.
const BESIDE_VIEW_RAD: f64 = 0.1;

impl Geometry {
    /// Warnings for entities of which the scene says the opposite of what the camera sees from the pose of
    /// the robot in the scene. O(entities with `visible` × candidates of the search).
    #[must_use]
    pub fn contradicted_sight(&self) -> Vec<Diagnostic> {
        let Ok(start) = self.start() else { return vec![] };
        let [x, y, _] = start.world.robot.base;
        let told = self.scene().entities.values().filter_map(|entity| {
            let sees = if entity.visible? { self.misses(&start, entity) } else { self.sees(&start, entity) }?;
            let (span, id, says_visible) = (entity.spans.visible, entity.id.clone(), entity.visible?);
            Some(SightDisagrees { span, id, says_visible, from: [x, y], sees }.into())
        });
        told.collect()
    }

    /// Sight of an entity by the camera as it stands, in words; `None` where it is not certain.
    fn sees(&self, at: &Fingerprinted, entity: &Entity) -> Option<String> {
        let as_it_stands = SearchBudget { candidates: 1, ..self.budget() };
        let query = MotionQuery::Look(entity.id.clone());
        let MotionAnswer::Feasible(witness) = self.room(&at.world).answer(&query, as_it_stands) else {
            return None;
        };
        let camera = self.machine().card().cameras.values().next()?.frame.as_ref()?;
        let link = self.machine().tree().link(camera).ok()?;
        let map_from_camera = self.machine().map_from_links(witness.path.last()?).get(link).copied()?;
        let place = at.world.pose(entity)?.translation.vector;
        let metres = (place - map_from_camera.translation.vector).norm();
        Some(format!("the camera sees it at {metres:.1} m"))
    }

    /// Reason for which no turn of the camera brings an entity into view, in words; `None` where it is not
    /// certain.
    fn misses(&self, at: &Fingerprinted, entity: &Entity) -> Option<String> {
        let answer = self.answer(at, &MotionQuery::Look(entity.id.clone()));
        let MotionAnswer::Infeasible(Infeasible { reason, .. }) = &*answer else { return None };
        let is_certain = match reason {
            InfeasibleReason::OutOfReach { length: ReachLength::Sight, needs, reach } => {
                *needs > reach + BEYOND_RANGE_M
            }
            InfeasibleReason::NotInView { by: None, aside: Some(aside) } => {
                aside.needs.abs() > aside.limit + BESIDE_VIEW_RAD
            }
            // A closed container hides what is in it, wherever the camera is.
            InfeasibleReason::NotInView { by: Some(by), .. } => {
                entity.inside.as_ref() == Some(by) && self.is_open(&at.world, by) == Some(false)
            }
            _ => false,
        };
        is_certain.then(|| match reason {
            InfeasibleReason::NotInView { by: Some(by), .. } => format!("`{by}` hides it from the camera"),
            _ => format!("it {reason}"),
        })
    }
}

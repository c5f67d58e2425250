//! What keeps the base from where it would have to stand: the things through which every way leads, those that can be taken away first.

use crate::planning::motions::explain::targets;
use crate::planning::query::answer::{Infeasible, MotionQuery};
use crate::planning::search::context::QueryContext;
use crate::planning::search::path::plane;

/// What is no object, and what never moves, weigh as much as so many objects that can be taken away.
const LARGE: u32 = 8;
const FIXED: u32 = 100;
/// How far from where the base stands in the end a way may lead to, in m: from there it comes in straight.
const STRAIGHT: f64 = 0.55;

impl QueryContext<'_> {
    /// The entities, by their index, through which every way of the base leads to where it would have to stand for a motion, or some
    /// of them: as few as were found, objects that `may_go` says can be taken away before others, in the order from where the robot is. Empty where a way
    /// leads past all of them, or where that is not known. O(cells of the map × obstacles near).
    pub(crate) fn barrier(
        &self,
        query: &MotionQuery,
        why: &Infeasible,
        may_go: impl Fn(&str) -> bool,
    ) -> Vec<usize> {
        let asks = matches!(
            query,
            MotionQuery::GoTo(_)
                | MotionQuery::Reach(..)
                | MotionQuery::Put(..)
                | MotionQuery::Pull(_)
                | MotionQuery::Push(_)
        );
        let Some(map) = self.map().filter(|_| asks) else { return vec![] };
        let target = targets(query).next_back().and_then(|id| self.entity(id));
        let Some((index, entity)) = target else { return vec![] };
        let Some(pose) = self.state.pose(entity) else { return vec![] };
        let start = plane(&self.state.robot);
        let from: Vec<[f64; 2]> =
            std::iter::once(start).chain(self.escapes(map).iter().map(|(_, place)| *place)).collect();
        // What is asked for is never in the way, nor what is in the hand.
        let weight = |at: usize| {
            let (id, entity) = self.scene.entities.get_index(at).filter(|_| at != index)?;
            Some(match (may_go(id), entity.kind.as_str()) {
                (true, "Object") => 1,
                (true, _) => LARGE,
                (false, _) => FIXED,
            })
        };
        let reach = match (query, self.model.hand()) {
            (MotionQuery::GoTo(_), _) => self.served_within(entity),
            (_, Some(hand)) => self.farthest(hand),
            (_, None) => return vec![],
        };
        let centre = pose.translation.vector;
        let far = self.far_from(index, entity, [centre.x, centre.y]);
        let found = map.through(&from, weight, |[x, y]| far(x, y) <= reach).unwrap_or_default();
        // Near enough on the other side of a wall is of no use.
        match &why.configuration {
            Some(configuration) if found.is_empty() && !self.is_near_drivable(configuration.base) => {
                let [to_x, to_y] = plane(configuration);
                let is_near = |[x, y]: [f64; 2]| libm::hypot(x - to_x, y - to_y) <= STRAIGHT;
                map.through(&from, weight, is_near).unwrap_or_default()
            }
            Some(_) | None => found,
        }
    }
}

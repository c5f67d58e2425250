//! Entry points of the motion queries, as methods of the query context: the answer to a query, and the scene
//! state after its witness.
//!
//! A motion of the base ends where its path ends. A motion of the hand ends with the robot back at the
//! start, and only where a path back was certified: lifted off the support, or straight back, and then the
//! way it came.

use nalgebra::Vector3;

use super::{go_to, look, offer, pull, push, put, reach};
use crate::planning::context::QueryContext;
use crate::planning::query::{
    ContactTally, MotionAnswer, MotionQuery, MotionWitness, SearchBudget, UnknownReason,
};
use crate::planning::scene::{
    AllowedCollisions, Articulation, Configuration, Contact, SceneState, away, plane,
};
use crate::planning::search::LAST;

impl QueryContext<'_> {
    /// Fills the caches that are otherwise filled by the first query.
    #[must_use]
    pub fn ready(self) -> Self {
        self.prepare();
        self
    }

    /// Answers a query. The same context, query and budget give the same answer, bit for bit.
    ///
    /// The answer is unknown where a shape is a mesh, or where the robot collides at the start.
    #[must_use]
    pub fn answer(&self, query: &MotionQuery, budget: SearchBudget) -> MotionAnswer {
        if let Some(why) = self.blind_spot() {
            return MotionAnswer::Unknown(UnknownReason::Because(why));
        }
        if let Some(Contact { link, other, .. }) = self.start_contact() {
            let why = format!("at the start `{link}` touches `{other}`");
            return MotionAnswer::Unknown(UnknownReason::Because(why));
        }
        match query {
            MotionQuery::GoTo(to) => go_to::go_to(self, to, budget),
            MotionQuery::Reach(object, side) => reach::reach(self, object, *side, budget),
            MotionQuery::ReachAt(object, at) => reach::reach_at(self, object, at.as_ref(), budget),
            MotionQuery::StandAt(pose) => go_to::stand_at(self, pose),
            MotionQuery::Put(object, on, rules) => put::put(self, (object, on), rules, budget),
            MotionQuery::Offer(object, to) => offer::offer(self, object, to, budget),
            MotionQuery::Look(at) => look::look(self, at, budget),
            MotionQuery::Pull(id) => pull::pull(self, id, [0.0, 1.0], budget),
            MotionQuery::Push(id) => push::push(self, id, budget),
            MotionQuery::Posture(name) => go_to::to_posture(self, name),
            MotionQuery::Other(name) => {
                MotionAnswer::Unknown(UnknownReason::Because(format!("`{name}` is not computed yet")))
            }
        }
    }

    /// State after the robot followed a path, with nothing picked up or put down.
    #[must_use]
    pub fn after_move(&self, witness: &MotionWitness) -> SceneState {
        let mut state = self.state.clone();
        if let Some(last) = witness.path.last() {
            state.robot = last.clone();
        }
        let [_, _, yaw] = &mut state.robot.base;
        *yaw = crate::trigonometry::wrapped(*yaw);
        state
    }

    /// State after the grasp of a witness of `reach`, wherever the robot is: its hand holds the object.
    #[must_use]
    pub fn taken(&self, witness: &MotionWitness) -> Option<SceneState> {
        let (grasp, hand) = (witness.grasp.as_ref()?, self.model.hand()?);
        let mut state = self.state.clone();
        state.held = Some((grasp.object.clone(), grasp.tip_from_object));
        state.moved.remove(&grasp.object);
        state.robot.joints = hand.around(&state.robot.joints, self.model.rest(), grasp.width);
        Some(state)
    }

    /// State after the grasp of a witness of `reach`, with the robot back at the start and the object in its
    /// hand; `None` where no path back was found.
    #[must_use]
    pub fn after_reach(&self, witness: &MotionWitness) -> Option<SceneState> {
        let grasp = witness.grasp.as_ref()?;
        let hand = self.model.hand()?;
        let end = witness.path.last()?;
        let state = self.taken(witness)?;
        let rest = self.model.rest();
        let end = &Configuration { base: end.base, joints: hand.around(&end.joints, rest, grasp.width) };
        let (index, _) = self.entity(&grasp.object)?;
        let support = self.support(index);
        let mut after = self.in_state(&state);
        // Beside what it stood nearer to than the clearance, the object is lifted off.
        after.planning.permit_held(&grasp.map_from_tip);
        let held = AllowedCollisions { held: support, ..AllowedCollisions::default() };
        let up = Vector3::new(0.0, 0.0, LIFT);
        let back = |far: f64| away(&grasp.map_from_tip, hand, far);
        let ways = [up, back(BACK[0]), back(BACK[1]), up + back(BACK[0])];
        let is_back = ways.into_iter().any(|shift| {
            let Some(line) = after.line(hand, end, &grasp.map_from_tip, &shift) else { return false };
            let inwards = line.first().map(|first| first.inwards(&grasp.map_from_tip.translation.vector));
            inwards.is_some_and(|inwards| {
                after.route_along(&line, inwards, held, &mut ContactTally::default()).is_some()
            })
        });
        is_back.then_some(state)
    }

    /// State after a witness of `put`, wherever the robot is by then: the object stands where it was put.
    #[must_use]
    pub fn put_down(&self, witness: &MotionWitness) -> Option<SceneState> {
        let grasp = witness.grasp.as_ref()?;
        let mut state = self.state.clone();
        state.held = None;
        state.moved.insert(grasp.object.clone(), grasp.map_from_tip * grasp.tip_from_object);
        Some(state)
    }

    /// State after a witness of `put`, with the robot back at the start; `None` where no path back was found.
    #[must_use]
    pub fn after_put(&self, witness: &MotionWitness) -> Option<SceneState> {
        let grasp = witness.grasp.as_ref()?;
        let (hand, end) = (self.model.hand()?, witness.path.last()?);
        let state = self.put_down(witness)?;
        let (index, _) = self.entity(&grasp.object)?;
        let after = self.in_state(&state);
        let allowed = AllowedCollisions::of_grasp(&after, index);
        // The fingers open before the hand draws back.
        let open = Configuration { base: end.base, joints: hand.opened(&end.joints) };
        after.edge(end, &open, allowed).ok()?;
        let is_back = BACK.into_iter().any(|far| {
            let shift = away(&grasp.map_from_tip, hand, far);
            let Some(line) = after.line(hand, &open, &grasp.map_from_tip, &shift) else { return false };
            let inwards = line.first().map(|first| first.inwards(&grasp.map_from_tip.translation.vector));
            inwards.is_some_and(|inwards| {
                after.route_along(&line, inwards, allowed, &mut ContactTally::default()).is_some()
            })
        });
        is_back.then_some(state)
    }

    /// State after a person took the held object, with the robot back at the start by the path on which it
    /// came.
    #[must_use]
    pub fn after_offer(&self, to: &str) -> Option<SceneState> {
        let mut state = self.state.clone();
        let (held, _) = state.held.take()?;
        let (_, person) = self.entity(to)?;
        // In a person's hands the object is in nobody's way.
        state.moved.insert(held, self.state.pose(person)?);
        Some(state)
    }

    /// State after a container was opened or closed as a witness of `pull` or `push` says, wherever the robot
    /// is by then: the contents of a drawer moved with it.
    #[must_use]
    pub fn travelled(&self, witness: &MotionWitness) -> Option<SceneState> {
        let grasp = witness.grasp.as_ref()?;
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
        Some(state)
    }

    /// State after a container was opened or closed as a witness of `pull` or `push` says: the contents of a
    /// drawer moved with it. The robot is back at the start, or at the handle with its arm folded where no
    /// path leads back; `None` where neither was found.
    #[must_use]
    pub fn after_pull(&self, witness: &MotionWitness) -> Option<SceneState> {
        let grasp = witness.grasp.as_ref()?;
        let (hand, end) = (self.model.hand()?, witness.path.last()?);
        let (index, _) = self.entity(&grasp.object)?;
        let allowed = AllowedCollisions::near(index);
        let mut state = self.travelled(witness)?;
        let map_from_tip = self.model.map_from_links(end).get(hand.tip).copied()?;
        let mut there = None;
        let after = self.in_state(&state);
        let ways = OPENED.into_iter().flat_map(|width| BACK.map(|far| (width, far)));
        for (width, far) in ways {
            // At most as far as the door beside the hand permits.
            let fingers = |configuration: &Configuration| {
                hand.around(&configuration.joints, self.model.rest(), width.min(hand.card.opening_m))
            };
            let open = Configuration { base: end.base, joints: fingers(end) };
            if after.edge(end, &open, allowed).is_err() {
                continue;
            }
            let shift = away(&map_from_tip, hand, far);
            let Some(line) = after.line(hand, &open, &map_from_tip, &shift) else { continue };
            let line: Vec<Configuration> = line
                .iter()
                .map(|configuration| Configuration {
                    base: configuration.base,
                    joints: fingers(configuration),
                })
                .collect();
            let is_free =
                after.around(plane(&open), LAST).is_free(&line, allowed, &mut ContactTally::default());
            let Some(first) = line.first().filter(|_| is_free) else { continue };
            if leads_back(&after, first, &map_from_tip.translation.vector, allowed) {
                return Some(state);
            }
            let [x, y, yaw] = first.base;
            let base = [x, y, crate::trigonometry::wrapped(yaw)];
            let (first, folded) =
                (first.at(base), Configuration { base, joints: self.state.robot.joints.clone() });
            let is_folded = after.unfold(&first, &folded, &mut ContactTally::default()).is_some();
            there = there.or(is_folded.then_some(folded));
        }
        drop(after);
        state.robot = there?;
        Some(state)
    }
}

/// Lift off the support before the robot moves on, in m.
const LIFT: f64 = 0.05;
/// Distances of the straight way back, in m.
const BACK: [f64; 2] = [0.1, 0.05];

/// Openings that release a handle, in m; the first is the widest.
const OPENED: [f64; 3] = [f64::INFINITY, 0.06, 0.03];

/// Checks whether a path connects the start with a configuration in front of a place.
pub(crate) fn leads_back(
    context: &QueryContext<'_>,
    configuration: &Configuration,
    place: &Vector3<f64>,
    allowed: AllowedCollisions,
) -> bool {
    let inwards = configuration.inwards(place);
    context
        .route_along(std::slice::from_ref(configuration), inwards, allowed, &mut ContactTally::default())
        .is_some()
}

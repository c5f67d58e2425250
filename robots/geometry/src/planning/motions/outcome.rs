//! The world after a motion: where the robot then is, what it holds.
//!
//! A motion of the base ends where its path ends. A motion of the hand ends with the robot back where it began it, with what
//! it took, and only where a way back was certified: lifted off its support, or straight back, and then as it came.

use nalgebra::Vector3;

use crate::collision::Solid;
use crate::planning::motions::pull::away;
use crate::planning::query::answer::MotionWitness;
use crate::planning::scene::configuration::Configuration;
use crate::planning::scene::contact::AllowedCollisions;
use crate::planning::scene::contact::MIN_CLEARANCE;
use crate::planning::scene::grid_index::Obstacle;
use crate::planning::scene::scene_state::SceneState;
use crate::planning::search::context::QueryContext;
use crate::planning::search::path::ContactTally;

/// How far a thing is lifted off what it stands on before the robot moves on, in m.
const LIFT: f64 = 0.05;
/// How far the hand draws back, in m.
const BACK: [f64; 2] = [0.1, 0.05];

impl QueryContext<'_> {
    /// The world after the robot went a way, without anything taken or put down.
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

    /// The world after a thing was taken as a witness of `reach` says, with the robot back where it began; `None` where no way
    /// back was found.
    #[must_use]
    pub fn after_reach(&self, witness: &MotionWitness) -> Option<SceneState> {
        let grasp = witness.grasp.as_ref()?;
        let hand = self.model.hand()?;
        let end = witness.path.last()?;
        let mut state = self.state.clone();
        state.held = Some((grasp.object.clone(), grasp.tip_from_object));
        state.moved.remove(&grasp.object);
        let rest = self.model.rest();
        state.robot.joints = hand.around(&state.robot.joints, rest, grasp.width);
        let end = &Configuration { base: end.base, joints: hand.around(&end.joints, rest, grasp.width) };
        let (index, _) = self.entity(&grasp.object)?;
        let support = self.support(index);
        let context = self.in_state(&state);
        let held = AllowedCollisions { hand: None, held: support };
        let up = Vector3::new(0.0, 0.0, LIFT);
        let back = |far: f64| away(&grasp.map_from_tip, hand, far);
        let ways = [up, back(BACK[0]), back(BACK[1]), up + back(BACK[0])];
        let is_back = ways.into_iter().any(|shift| {
            let Some(line) = context.line(hand, end, &grasp.map_from_tip, &shift) else { return false };
            let inwards = line.first().map(|first| first.inwards(&grasp.map_from_tip.translation.vector));
            inwards.is_some_and(|inwards| {
                context.route_along(&line, inwards, held, &mut ContactTally::default()).is_some()
            })
        });
        is_back.then_some(state)
    }

    /// The world after a thing was put where a witness of `put` says, with the robot back where it began; `None` where no way
    /// back was found.
    #[must_use]
    pub fn after_put(&self, witness: &MotionWitness) -> Option<SceneState> {
        let grasp = witness.grasp.as_ref()?;
        let (hand, end) = (self.model.hand()?, witness.path.last()?);
        let mut state = self.state.clone();
        state.held = None;
        state.moved.insert(grasp.object.clone(), grasp.map_from_tip * grasp.tip_from_object);
        let (index, _) = self.entity(&grasp.object)?;
        let context = self.in_state(&state);
        let allowed = AllowedCollisions { hand: Some(index), held: None };
        // The fingers open, then the hand draws back from the thing.
        let open = Configuration { base: end.base, joints: hand.opened(&end.joints) };
        context.edge(end, &open, allowed).ok()?;
        let is_back = BACK.into_iter().any(|far| {
            let shift = away(&grasp.map_from_tip, hand, far);
            let Some(line) = context.line(hand, &open, &grasp.map_from_tip, &shift) else { return false };
            let inwards = line.first().map(|first| first.inwards(&grasp.map_from_tip.translation.vector));
            inwards.is_some_and(|inwards| {
                context.route_along(&line, inwards, allowed, &mut ContactTally::default()).is_some()
            })
        });
        is_back.then_some(state)
    }

    /// The world after a person took what was held out to them: the robot is back where it began, by the way it came.
    #[must_use]
    pub fn after_offer(&self, to: &str) -> Option<SceneState> {
        let mut state = self.state.clone();
        let (held, _) = state.held.take()?;
        let (_, person) = self.entity(to)?;
        // With them it stands in nobody's way.
        state.moved.insert(held, self.state.pose(person)?);
        Some(state)
    }

    /// Whether a way leads between where the robot is in this room and a state in front of a place.
    pub(crate) fn leads_back(&self, configuration: &Configuration, place: &Vector3<f64>) -> bool {
        let (inwards, none) = (configuration.inwards(place), AllowedCollisions::default());
        self.route_along(std::slice::from_ref(configuration), inwards, none, &mut ContactTally::default())
            .is_some()
    }

    /// What an entity stands on: the first other that is no farther from it than everything stays from everything.
    pub(crate) fn support(&self, entity: usize) -> Option<usize> {
        let own: Vec<&Solid> = self.solids_of(entity).collect();
        let gap = MIN_CLEARANCE + 0.001;
        let is_near = |obstacle: &Obstacle| own.iter().any(|own| !own.is_farther(&obstacle.solid, gap));
        let all =
            own.iter().flat_map(|own| self.obstacles.near([own.centre.x, own.centre.y], own.reach() + gap));
        let others = all.filter(|(_, obstacle)| obstacle.entity != entity && is_near(obstacle));
        others.min_by_key(|(index, _)| *index).map(|(_, obstacle)| obstacle.entity)
    }
}

//! The world after a motion: where the robot then is, what it holds.
//!
//! A motion of the base ends where its path ends. A motion of the hand ends with the robot back where it began it, with what
//! it took, and only where a way back was certified: lifted off its support, or straight back, and then as it came.

use nalgebra::Vector3;

use super::answer::Witness;
use super::pull::away;
use super::room::{GAP, Room};
use super::state::State;
use super::things::Thing;
use super::touch::Allowed;
use super::travel::Tally;
use super::world::World;
use crate::collision::Solid;

/// How far a thing is lifted off what it stands on before the robot moves on, in m.
const LIFT: f64 = 0.05;
/// How far the hand draws back, in m.
const BACK: [f64; 2] = [0.1, 0.05];

impl Room<'_> {
    /// The world after the robot went a way, without anything taken or put down.
    #[must_use]
    pub fn gone_along(&self, witness: &Witness) -> World {
        let mut world = self.world.clone();
        if let Some(last) = witness.path.last() {
            world.robot = last.clone();
        }
        let [_, _, yaw] = &mut world.robot.base;
        *yaw = crate::trigonometry::wrapped(*yaw);
        world
    }

    /// The world after a thing was taken as a witness of `reach` says, with the robot back where it began; `None` where no way
    /// back was found.
    #[must_use]
    pub fn taken(&self, witness: &Witness) -> Option<World> {
        let grasp = witness.grasp.as_ref()?;
        let hand = self.machine.hand()?;
        let end = witness.path.last()?;
        let mut world = self.world.clone();
        world.held = Some((grasp.object.clone(), grasp.tip_from_object));
        world.moved.remove(&grasp.object);
        let rest = self.machine.rest();
        world.robot.joints = hand.around(&world.robot.joints, rest, grasp.width);
        let end = &State { base: end.base, joints: hand.around(&end.joints, rest, grasp.width) };
        let (index, _) = self.entity(&grasp.object)?;
        let support = self.support(index);
        let room = self.in_world(&world);
        let held = Allowed { hand: None, held: support };
        let up = Vector3::new(0.0, 0.0, LIFT);
        let back = |far: f64| away(&grasp.map_from_tip, hand, far);
        let ways = [up, back(BACK[0]), back(BACK[1]), up + back(BACK[0])];
        let is_back = ways.into_iter().any(|shift| {
            let Some(line) = room.line(hand, end, &grasp.map_from_tip, &shift) else { return false };
            let inwards = line.first().map(|first| first.inwards(&grasp.map_from_tip.translation.vector));
            inwards.is_some_and(|inwards| {
                room.route_along(&line, inwards, held, &mut Tally::default()).is_some()
            })
        });
        is_back.then_some(world)
    }

    /// The world after a thing was put where a witness of `put` says, with the robot back where it began; `None` where no way
    /// back was found.
    #[must_use]
    pub fn put_there(&self, witness: &Witness) -> Option<World> {
        let grasp = witness.grasp.as_ref()?;
        let (hand, end) = (self.machine.hand()?, witness.path.last()?);
        let mut world = self.world.clone();
        world.held = None;
        world.moved.insert(grasp.object.clone(), grasp.map_from_tip * grasp.tip_from_object);
        let (index, _) = self.entity(&grasp.object)?;
        let room = self.in_world(&world);
        let allowed = Allowed { hand: Some(index), held: None };
        // The fingers open, then the hand draws back from the thing.
        let open = State { base: end.base, joints: hand.opened(&end.joints) };
        room.edge(end, &open, allowed).ok()?;
        let is_back = BACK.into_iter().any(|far| {
            let shift = away(&grasp.map_from_tip, hand, far);
            let Some(line) = room.line(hand, &open, &grasp.map_from_tip, &shift) else { return false };
            let inwards = line.first().map(|first| first.inwards(&grasp.map_from_tip.translation.vector));
            inwards.is_some_and(|inwards| {
                room.route_along(&line, inwards, allowed, &mut Tally::default()).is_some()
            })
        });
        is_back.then_some(world)
    }

    /// The world after a person took what was held out to them: the robot is back where it began, by the way it came.
    #[must_use]
    pub fn given(&self, to: &str) -> Option<World> {
        let mut world = self.world.clone();
        let (held, _) = world.held.take()?;
        let (_, person) = self.entity(to)?;
        // With them it stands in nobody's way.
        world.moved.insert(held, self.world.pose(person)?);
        Some(world)
    }

    /// Whether a way leads between where the robot is in this room and a state in front of a place.
    pub(super) fn leads_back(&self, state: &State, place: &Vector3<f64>) -> bool {
        let (inwards, none) = (state.inwards(place), Allowed::default());
        self.route_along(std::slice::from_ref(state), inwards, none, &mut Tally::default()).is_some()
    }

    /// What an entity stands on: the first other that is no farther from it than everything stays from everything.
    pub(super) fn support(&self, entity: usize) -> Option<usize> {
        let own: Vec<&Solid> = self.solids_of(entity).collect();
        let gap = GAP + 0.001;
        let is_near = |thing: &Thing| own.iter().any(|own| !own.is_farther(&thing.solid, gap));
        let all =
            own.iter().flat_map(|own| self.things.near([own.centre.x, own.centre.y], own.reach() + gap));
        let others = all.filter(|(_, thing)| thing.entity != entity && is_near(thing));
        others.min_by_key(|(index, _)| *index).map(|(_, thing)| thing.entity)
    }
}

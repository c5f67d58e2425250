//! The world after a container was opened or closed by its handle.

use super::answer::Witness;
use super::opening::Opening;
use super::pull::away;
use super::room::Room;
use super::seek::LAST;
use super::state::State;
use super::touch::Allowed;
use super::travel::{Tally, plane};
use super::world::World;

/// How far the hand draws back from a handle, in m.
const BACK: [f64; 2] = [0.1, 0.05];
/// How far the fingers open to let go of a handle, in m.
const OPENED: [f64; 3] = [f64::INFINITY, 0.06, 0.03];

impl Room<'_> {
    /// The world after a container was pulled open, or pushed closed, as a witness says: what lies in a drawer has gone with it, and
    /// the robot is back where it began; where no way leads back there, where it let go of the handle, with the arm as it was.
    /// `None` where neither was found.
    #[must_use]
    pub fn travelled(&self, witness: &Witness) -> Option<World> {
        let none = Allowed::default();
        let grasp = witness.grasp.as_ref()?;
        let (hand, end) = (self.machine.hand()?, witness.path.last()?);
        let (_, entity) = self.entity(&grasp.object)?;
        let opening = Opening::new(entity, self.world)?;
        let was_open = self.world.is_open(entity);
        let (from, to) = if was_open { (1.0, 0.0) } else { (0.0, 1.0) };
        let mut world = self.world.clone();
        world.open.insert(grasp.object.clone(), !was_open);
        let moved = opening.map_moved(to) * opening.map_moved(from).inverse();
        for inside in self.scene.entities.values().filter(|entity| !entity.fixed) {
            if let Some(pose) = self.world.pose(inside)
                && opening.carries(&pose.translation.vector, from)
            {
                world.moved.insert(inside.id.clone(), moved * pose);
            }
        }
        let map_from_tip = self.machine.map_from_links(end).get(hand.tip).copied()?;
        let mut there = None;
        let room = self.in_world(&world);
        let ways = OPENED.into_iter().flat_map(|width| BACK.map(|far| (width, far)));
        for (width, far) in ways {
            // No farther than the door beside it leaves room for.
            let fingers = |state: &State| {
                hand.around(&state.joints, self.machine.rest(), width.min(hand.card.opening_m))
            };
            let open = State { base: end.base, joints: fingers(end) };
            if room.edge(end, &open, none).is_err() {
                continue;
            }
            let shift = away(&map_from_tip, hand, far);
            let Some(line) = room.line(hand, &open, &map_from_tip, &shift) else { continue };
            let line: Vec<State> =
                line.iter().map(|state| State { base: state.base, joints: fingers(state) }).collect();
            let is_free = room.around(plane(&open), LAST).is_free(&line, none, &mut Tally::default());
            let Some(first) = line.first().filter(|_| is_free) else { continue };
            if room.leads_back(first, &map_from_tip.translation.vector) {
                return Some(world);
            }
            let [x, y, yaw] = first.base;
            let base = [x, y, crate::trigonometry::wrapped(yaw)];
            let (first, folded) = (first.at(base), State { base, joints: self.world.robot.joints.clone() });
            let is_folded = room.unfold(&first, &folded, &mut Tally::default()).is_some();
            there = there.or(is_folded.then_some(folded));
        }
        drop(room);
        world.robot = there?;
        Some(world)
    }
}

//! Room to spare along a path.

use super::answer::Margins;
use super::around::Around;
use super::room::Room;
use super::state::State;
use super::touch::Allowed;
use super::travel::plane;

impl Room<'_> {
    /// Room to spare along a path.
    pub(super) fn margins(&self, path: &[State], allowed: Allowed) -> Margins {
        let [x, y] = path.last().map_or([0.0; 2], plane);
        self.around([x, y], 1.0).margins(path, allowed)
    }
}

impl Around<'_, '_> {
    /// Room to spare along a path, at its way-points and half-way between them.
    pub(super) fn margins(&self, path: &[State], allowed: Allowed) -> Margins {
        // The last states are where it is tightest, most often: after them little is looked at closely.
        let mut clearance = path.last().map_or(1.0, |last| self.clearance_at(last, allowed, 1.0));
        for pair in path.windows(2).rev() {
            let [one, other] = pair else { continue };
            clearance = self.clearance_at(&one.towards(other, 0.5), allowed, clearance);
            clearance = self.clearance_at(one, allowed, clearance);
        }
        let variables = self.room.machine.tree().variables().iter();
        // An open hand is at its limit by intent.
        let hand = self.room.machine.hand();
        let is_finger = |at: usize| hand.is_some_and(|hand| hand.open.iter().any(|(own, _)| *own == at));
        let ends = path.first().zip(path.last());
        let rooms = ends.into_iter().flat_map(|(first, last)| {
            let values = first.joints.iter().zip(&last.joints).zip(variables.clone()).zip(0..);
            let moved = values.filter(|(((before, after), _), at)| before != after && !is_finger(*at));
            moved.map(|(((_, after), known), _)| known.room(*after))
        });
        Margins { clearance, limit: rooms.reduce(f64::min), payload: None }
    }
}

//! Margins of a path: its clearance and the distance to joint limits.

use super::collision_checker::CollisionChecker;
use crate::planning::context::QueryContext;
use crate::planning::query::Margins;
use crate::planning::scene::{AllowedCollisions, Configuration, plane};
use crate::simd::NearPair;

/// Clearances to try first, in m, in two batches.
const NEARBY: [[f32; 8]; 2] =
    [[0.003, 0.005, 0.007, 0.01, 0.013, 0.017, 0.022, 0.03], [0.04, 0.05, 0.065, 0.08, 0.1, 0.13, 0.16, 0.2]];

impl<'w> QueryContext<'w> {
    /// Checker for everything within `metres` of the robot in some configurations.
    pub(crate) fn all_around(
        &self,
        configurations: &[Configuration],
        metres: f64,
    ) -> CollisionChecker<'_, 'w> {
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for configuration in configurations {
            for ((low, high), at) in low.iter_mut().zip(&mut high).zip(plane(configuration)) {
                (*low, *high) = (low.min(at), high.max(at));
            }
        }
        let [wide, deep] = [0.5 * (high[0] - low[0]), 0.5 * (high[1] - low[1])];
        self.around([low[0] + wide, low[1] + deep], libm::hypot(wide, deep) + metres + 1e-6)
    }
}

impl QueryContext<'_> {
    /// Margins of a path.
    pub(crate) fn margins(&self, path: &[Configuration], allowed: AllowedCollisions) -> Margins {
        let [x, y] = path.last().map_or([0.0; 2], plane);
        self.around([x, y], 1.0).margins(path, allowed)
    }
}

impl CollisionChecker<'_, '_> {
    /// Margins of a path, sampled at its way-points and half-way between them.
    pub(crate) fn margins(&self, path: &[Configuration], allowed: AllowedCollisions) -> Margins {
        // The goal is usually the tightest, so it rules out most of the rest.
        let mut clearance = path.last().map_or(1.0, |last| self.clearance_of(last, allowed));
        let mut configurations: Vec<Configuration> = Vec::with_capacity(2 * path.len());
        for pair in path.windows(2).rev() {
            let [one, other] = pair else { continue };
            configurations.extend([one.towards(other, 0.5), one.clone()]);
        }
        for configurations in configurations.chunks(8) {
            let checker = self.context.all_around(configurations, clearance);
            let all: Vec<&Configuration> = configurations.iter().collect();
            // Rounded up, so that the prefilter keeps every pair.
            let metres = (clearance * (1.0 + 1e-6)) as f32;
            let near = checker.within(&all, allowed, [metres; 8]);
            for (configuration, lane) in configurations.iter().zip(0..) {
                clearance = match &near {
                    Some(near) => checker.clearance_among(configuration, in_lane(near, lane), clearance),
                    None => checker.clearance(configuration, allowed, clearance),
                };
            }
        }
        let dofs = self.context.model.tree().dofs().iter();
        // The joints of an open hand are at their limits by intent.
        let hand = self.context.model.hand();
        let is_finger = |at: usize| hand.is_some_and(|hand| hand.open.iter().any(|(own, _)| *own == at));
        let ends = path.first().zip(path.last());
        let rooms = ends.into_iter().flat_map(|(first, last)| {
            let values = first.joints.iter().zip(&last.joints).zip(dofs.clone()).zip(0..);
            let moved = values.filter(|(((before, after), _), at)| before != after && !is_finger(*at));
            moved.map(|(((_, after), known), _)| known.limit_margin(*after))
        });
        Margins { clearance, required: self.context.clearance, limit: rooms.reduce(f64::min), payload: None }
    }

    /// Clearance of a configuration, with the nearest obstacles first.
    fn clearance_of(&self, configuration: &Configuration, allowed: AllowedCollisions) -> f64 {
        for nearby in NEARBY {
            let Some(near) = self.within(&[configuration], allowed, nearby) else { break };
            for (metres, lane) in nearby.into_iter().map(f64::from).zip(0..) {
                let found = self.clearance_among(configuration, in_lane(&near, lane), metres);
                if found < metres {
                    return found;
                }
            }
        }
        self.clearance_at(configuration, allowed, 1.0)
    }
}

/// Pairs that may be near in one lane of a batch.
fn in_lane(near: &[NearPair], lane: usize) -> impl Iterator<Item = &NearPair> {
    near.iter().filter(move |near| near.still >> lane & 1 == 1)
}

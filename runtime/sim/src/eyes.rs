//! The simulator's eyes: what is in view, where it truly is, and no doubt about it. There are no pictures of a world that has
//! no surfaces.

use crate::sim::Sim;
use crate::thing::Role;
use motet_graph::Pose;
use motet_runtime::{Detection, Image, Perception, Time};
use smol_str::SmolStr;

impl Perception for Sim {
    fn detections(&mut self, now: Time) -> Vec<Detection> {
        // Looking moves nothing: what is seen is as of the time that the world has reached.
        let at = self.now().min(now);
        let in_view = self.world.things.iter().filter(|(id, thing)| {
            matches!(thing.role, Role::Object | Role::Surface | Role::Container) && self.world.is_visible(id)
        });
        let seen = in_view.map(|(id, thing)| {
            let (sin, cos) = (thing.body.yaw / 2.0).sin_cos();
            Detection {
                entity: Some(id.clone()),
                class: self
                    .scene
                    .entities
                    .get(id)
                    .map_or_else(SmolStr::default, |entity| entity.class.clone()),
                pose: Some(Pose { xyz: thing.body.xyz, quaternion: [0.0, 0.0, sin, cos] }),
                confidence: 1.0,
                at,
            }
        });
        seen.collect()
    }

    fn image(&mut self, _now: Time) -> Option<Image> {
        None
    }
}

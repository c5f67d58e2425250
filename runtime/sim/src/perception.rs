//! The simulator's eyes: what is in view, as well as the camera tells, and pictures of it.
//!
//! The camera is where the options say and turns to wherever it has to, within its view to show where most is
//! to be seen. What stands in front hides what is behind.

use crate::body::turned;
use crate::camera::{CameraLens, encoded, render};
use crate::chance::Chance;
use crate::sim::Sim;
use crate::world::{Role, ViewDirection};
use motet_graph::Pose;
use motet_robots::scene::EntityShape;
use motet_runtime::{CameraImage, Detection, Perception, RgbdView, Time};
use smol_str::SmolStr;
use std::f64::consts::TAU;

/// Downward tilt of the camera in an overview image in rad: towards the tops of tables.
const BELOW: f64 = 0.35;
/// Horizontal angle within which a thing is well in an image, in rad; the image itself reaches 0.7.
const ASIDE: f64 = 0.55;
/// By how much the camera turns from one look to the next, in rad.
const TURN: f64 = 0.2;
/// Weight of a graspable thing relative to a piece of furniture in the choice of a view.
const FURNITURE: i64 = 4;

impl Perception for Sim {
    fn image(&mut self, now: Time) -> Option<CameraImage> {
        Some(self.overview(now, None)?.image)
    }

    fn view(&mut self, now: Time, of: &str) -> Option<RgbdView> {
        if !self.world.sees(of, ViewDirection::Around) {
            return None;
        }
        let middle = self.world.thing(of)?.body.middle();
        self.shot(&self.world.lens(ViewDirection::Around, middle), now)
    }
}

impl Sim {
    /// Detections of the things in view, as well as the camera tells, the surest first.
    pub(crate) fn detected_at(&self, now: Time) -> Vec<Detection> {
        // Looking moves nothing: what is seen is as of the time that the world has reached.
        let at = self.now().min(now);
        // The same moment gives the same errors, whatever was looked at before.
        let (chance, rates) = (Chance::new(self.seed, at.nanos()), &self.profile.camera);
        let in_view = self.world.things.iter().filter(|(id, thing)| {
            matches!(thing.role, Role::Object | Role::Surface | Role::Container)
                && self.world.is_visible(id, ViewDirection::Ahead)
        });
        let seen = in_view.filter_map(|(id, thing)| {
            let [miss, share] = self.world.miss(id, rates.miss, ViewDirection::Ahead);
            if chance.comes(miss, "detect", id) {
                return None;
            }
            let far = self.world.base.distance_to(thing.body.x(), thing.body.y());
            let [dx, dy] = chance.error(rates.error_per_m * far, "detect", id);
            let ([x, y, z], (sin, cos)) = (thing.body.xyz, (thing.body.yaw / 2.0).sin_cos());
            let pose = Pose { xyz: [x + dx, y + dy, z], quaternion: [0.0, 0.0, sin, cos] };
            Some(self.detection(id, pose, rates.error_per_m * far, ((1.0 - miss) * share, at)))
        });
        let mut seen: Vec<Detection> = seen.collect();
        seen.sort_by(|one, other| other.confidence.total_cmp(&one.confidence));
        seen
    }

    /// Detection of a thing of the world. What the scene of the robot lacks keeps its name in the world: the
    /// robot knows it again by this.
    pub(crate) fn detection(
        &self,
        id: &SmolStr,
        pose: Pose,
        error_m: f64,
        (confidence, at): (f64, Time),
    ) -> Detection {
        let entity = self.scene.entities.get(id);
        let named = entity.and_then(|entity| entity.names.first().or(Some(&entity.class)));
        let is_told = self.told.contains_key(id);
        let class = match entity {
            Some(entity) if is_told => entity.class.clone(),
            Some(_) | None => named.cloned().unwrap_or_default(),
        };
        let extent = entity.and_then(|entity| match entity.shape.as_ref()? {
            EntityShape::Box(sides) => Some(*sides),
            EntityShape::Cylinder { radius, height } => Some([2.0 * radius, 2.0 * radius, *height]),
            EntityShape::Sphere { radius } => Some([2.0 * radius; 3]),
            EntityShape::Capsule { .. } | EntityShape::Mesh { .. } => None,
        });
        Detection {
            entity: Some(id.clone()),
            class,
            pose: Some(pose),
            extent,
            error_m: Some(error_m),
            confidence,
            at,
        }
    }

    /// A picture of most of what is visible. There is one camera, the first of the card.
    pub(crate) fn overview(&self, now: Time, camera: Option<&str>) -> Option<RgbdView> {
        if camera.is_some_and(|name| self.camera.as_deref() != Some(name)) {
            return None;
        }
        let (heading, [least, greatest]) = (self.world.base.heading + self.gaze(), self.world.eye.tilt);
        let below = -(-BELOW).clamp(least, greatest);
        let lens = CameraLens::new(self.world.eye_in_map(), heading, below);
        self.shot(&lens, now)
    }

    /// Pan angle in rad that brings most visible things into the image; ties go to the angle nearest to
    /// straight ahead.
    fn gaze(&self) -> f64 {
        let base = self.world.base;
        let view = self.world.cameras.first().map_or(0.0, |camera| camera.view_rad.min(TAU));
        let steps = ((view / 2.0 - ASIDE).max(0.0) / TURN).floor() as i64;
        let seen: Vec<(f64, i64)> = self
            .world
            .things
            .iter()
            .filter(|(id, _)| self.world.is_visible(id, ViewDirection::Ahead))
            .filter_map(|(_, thing)| {
                let worth = match thing.role {
                    Role::Object => FURNITURE,
                    Role::Surface | Role::Container | Role::Person => 1,
                    Role::Place => return None,
                };
                Some((base.bearing_of(thing.body.x(), thing.body.y()), worth))
            })
            .collect();
        let worth = |turn: f64| -> i64 {
            seen.iter()
                .filter(|(bearing, _)| turned(bearing - turn).abs() < ASIDE)
                .map(|(_, worth)| worth)
                .sum()
        };
        let turns = (-steps..=steps).map(|step| step as f64 * TURN);
        let best = turns
            .max_by(|one, other| worth(*one).cmp(&worth(*other)).then(other.abs().total_cmp(&one.abs())));
        best.unwrap_or(0.0)
    }

    /// A picture as of now; none of a robot without a camera.
    fn shot(&self, lens: &CameraLens, now: Time) -> Option<RgbdView> {
        let camera = self.camera.clone()?;
        let shot = render(&self.world, &self.scene, lens);
        let image = CameraImage {
            camera,
            media_type: SmolStr::new_static("image/png"),
            bytes: encoded(&shot)?,
            at: self.now().min(now),
        };
        Some(RgbdView { image, depth: shot.depth, camera: lens.camera() })
    }
}

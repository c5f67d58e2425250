//! Rooms at random: tables and counters, shelves, cabinets with an open drawer, narrow passages, clutter on
//! the floor, and things to grasp on, in and under all of it.

use motet_geometry::planning::RobotModel;
use motet_robots::card::Drive;
use motet_robots::clearance::ClearanceOverride;
use motet_robots::scene::{Entity, EntityShape, Placement, Scene, Travel};
use rand_xoshiro::SplitMix64;
use smol_str::{SmolStr, format_smolstr};

use crate::chance::{Chance, seeded};

/// The room of a seed for a robot, which stands at its origin in the posture `home`.
#[must_use]
pub fn furnished(machine: &RobotModel, seed: u64) -> Scene {
    let mut made = RoomBuilder { scene: Scene::default(), chance: seeded(seed), outlines: vec![], turn: 0.0 };
    match machine.card().base.drive {
        Drive::Fixed => made.bench(),
        Drive::Omnidirectional | Drive::Legged | Drive::Differential => {
            made.rooms(2.0 * machine.card().base.radius_m);
        }
    }
    // The judge knows the padding of every check, and no clearance beyond it.
    made.scene.clearance = ClearanceOverride { base_m: Some(0.0), arm_m: Some(0.0) };
    made.scene
}

/// The things that are to be grasped, in the order of the scene.
#[must_use]
pub fn targets(scene: &Scene) -> Vec<SmolStr> {
    scene.entities.values().filter(|entity| entity.kind == "Object").map(|entity| entity.id.clone()).collect()
}

struct RoomBuilder {
    scene: Scene,
    chance: SplitMix64,
    /// Centres and radii of what stands on the floor.
    outlines: Vec<([f64; 2], f64)>,
    turn: f64,
}

/// A frame on the floor.
#[derive(Clone, Copy)]
struct Place {
    x: f64,
    y: f64,
    yaw: f64,
}

impl Place {
    /// A point in the frame, in the map.
    fn at(self, x: f64, y: f64) -> [f64; 2] {
        let (sin, cos) = self.yaw.sin_cos();
        [self.x + cos * x - sin * y, self.y + sin * x + cos * y]
    }
}

impl RoomBuilder {
    /// A room about a robot so wide.
    fn rooms(&mut self, wide: f64) {
        self.outlines.push(([0.0, 0.0], wide * 0.8 + 0.1));
        if self.chance.is(0.5) {
            // A wall with a gap that the robot fits through, most often.
            let gap = wide * self.chance.between(1.0, 1.6) + 0.04;
            let (x, y) = (self.chance.between(1.0, 1.4), self.chance.between(-0.5, 0.5));
            let side = if self.chance.is(0.5) { 0.0 } else { std::f64::consts::PI };
            let place = Place { x: 0.0, y: 0.0, yaw: side };
            for sign in [-1.0, 1.0] {
                let [wall_x, wall_y] = place.at(x, y + sign * (gap / 2.0 + 1.0));
                self.add("wall", "Place", [wall_x, wall_y, 1.0], side, EntityShape::Box([0.1, 2.0, 2.0]));
                for part in [-0.8, -0.4, 0.0, 0.4, 0.8] {
                    self.outlines.push((place.at(x, y + sign * (gap / 2.0 + 1.0) + part), 0.25));
                }
            }
            let middle = place.at(x, y);
            self.outlines.push((middle, wide / 2.0 + 0.1));
        }
        for _ in 0..4 + self.chance.below(3) {
            match self.chance.below(4) {
                0 => self.counter(),
                1 => self.table(),
                2 => self.shelf(),
                _ => self.cabinet(),
            }
        }
        for _ in 0..self.chance.below(6) {
            let radius = self.chance.between(0.05, 0.2);
            let Some(place) = self.free(radius, 2.6) else { continue };
            let height = self.chance.between(0.2, 0.9);
            let shape = if self.chance.is(0.5) {
                EntityShape::Cylinder { radius, height }
            } else {
                EntityShape::Box([radius * 1.4, radius * 1.4, height])
            };
            self.add("stool", "Place", [place.x, place.y, height / 2.0], place.yaw, shape);
        }
        for _ in 0..1 + self.chance.below(2) {
            if let Some(place) = self.free(0.1, 2.4) {
                self.thing(place, [0.0, 0.0], 0.0);
            }
        }
    }

    /// A workbench about a robot that is bolted to it.
    fn bench(&mut self) {
        let top = 0.715;
        self.add("bench", "Place", [0.35, 0.0, top / 2.0], 0.0, EntityShape::Box([1.3, 1.4, top]));
        let place = Place { x: 0.0, y: 0.0, yaw: 0.0 };
        for _ in 0..2 + self.chance.below(5) {
            let (x, y) = self.on_bench();
            let height = self.chance.between(0.1, 0.5);
            let radius = self.chance.between(0.02, 0.08);
            let shape = if self.chance.is(0.5) {
                EntityShape::Cylinder { radius, height }
            } else {
                EntityShape::Box([radius * 2.0, radius * 3.0, height])
            };
            let yaw = self.chance.between(-3.1, 3.1);
            self.add("block", "Place", [x, y, top + height / 2.0], yaw, shape);
            self.outlines.push(([x, y], radius * 1.8 + 0.02));
        }
        if self.chance.is(0.5) {
            let height = self.chance.between(0.25, 0.5);
            let (x, y) = (self.chance.between(0.4, 0.6), self.chance.between(-0.3, 0.3));
            self.add("board", "Place", [x, y, top + height], 0.0, EntityShape::Box([0.3, 0.6, 0.02]));
            for sign in [-1.0, 1.0] {
                let centre = [x, y + sign * 0.3, top + height / 2.0];
                self.add("post", "Place", centre, 0.0, EntityShape::Box([0.3, 0.02, height - 0.02]));
            }
            self.thing(place, [x, y], top + height + 0.01);
        }
        for _ in 0..8 {
            let (x, y) = self.on_bench();
            self.thing(place, [x, y], top);
        }
        let far = self.chance.between(0.9, 1.3);
        self.add("stand", "Place", [far + 0.2, 0.9, 0.4], 0.0, EntityShape::Box([0.4, 0.4, 0.8]));
        self.thing(place, [far + 0.2, 0.9], 0.8);
    }

    fn on_bench(&mut self) -> (f64, f64) {
        let (sin, cos) = self.chance.between(-1.4, 1.4).sin_cos();
        let far = self.chance.between(0.32, 0.85);
        (far * cos, (far * sin).clamp(-0.65, 0.65))
    }

    fn counter(&mut self) {
        let (deep, wide) = (self.chance.between(0.45, 0.8), self.chance.between(0.6, 1.4));
        let height = self.chance.between(0.35, 1.05);
        let Some(place) = self.free(deep.hypot(wide) / 2.0, 2.4) else { return };
        let [x, y] = place.at(0.0, 0.0);
        self.add("counter", "Place", [x, y, height / 2.0], place.yaw, EntityShape::Box([deep, wide, height]));
        self.things(place, [deep, wide], height);
    }

    fn table(&mut self) {
        let (deep, wide) = (self.chance.between(0.5, 0.9), self.chance.between(0.7, 1.4));
        let height = self.chance.between(0.45, 0.9);
        let Some(place) = self.free(deep.hypot(wide) / 2.0, 2.4) else { return };
        let [x, y] = place.at(0.0, 0.0);
        self.add("table", "Place", [x, y, height - 0.015], place.yaw, EntityShape::Box([deep, wide, 0.03]));
        for (a, b) in [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)] {
            let [x, y] = place.at(a * (deep / 2.0 - 0.04), b * (wide / 2.0 - 0.04));
            let tall = height - 0.03;
            self.add(
                "leg",
                "Place",
                [x, y, tall / 2.0],
                0.0,
                EntityShape::Cylinder { radius: 0.025, height: tall },
            );
        }
        self.things(place, [deep, wide], height);
        if self.chance.is(0.3) {
            self.thing(place, [0.0, 0.0], 0.0);
        }
    }

    fn shelf(&mut self) {
        let (deep, wide) = (self.chance.between(0.25, 0.4), self.chance.between(0.6, 1.0));
        let rise = self.chance.between(0.28, 0.45);
        let boards = 3 + self.chance.below(2);
        let tall = rise * boards as f64;
        let Some(place) = self.free(deep.hypot(wide) / 2.0, 2.4) else { return };
        for sign in [-1.0, 1.0] {
            let [x, y] = place.at(0.0, sign * (wide / 2.0 - 0.01));
            self.add("side", "Place", [x, y, tall / 2.0], place.yaw, EntityShape::Box([deep, 0.02, tall]));
        }
        let [x, y] = place.at(-deep / 2.0 + 0.005, 0.0);
        self.add("back", "Place", [x, y, tall / 2.0], place.yaw, EntityShape::Box([0.01, wide - 0.04, tall]));
        for board in 0..=boards {
            let height = (rise * board as f64).max(0.05);
            let [x, y] = place.at(0.006, 0.0);
            let extents = [deep - 0.012, wide - 0.04, 0.02];
            self.add("shelf", "Place", [x, y, height - 0.01], place.yaw, EntityShape::Box(extents));
            if self.chance.is(0.6) {
                let off = self.chance.between(-0.35, 0.35) * wide;
                let out = self.chance.between(-0.3, 0.3) * deep;
                self.thing(place, [out, off], height);
            }
        }
    }

    fn cabinet(&mut self) {
        let (deep, wide) = (self.chance.between(0.4, 0.55), self.chance.between(0.4, 0.6));
        let height = self.chance.between(0.5, 0.95);
        let Some(place) = self.free(deep.hypot(wide) / 2.0 + 0.2, 2.4) else { return };
        // The drawer takes up the upper part.
        let part = self.chance.between(0.14, 0.22);
        let body = height - part;
        let [x, y] = place.at(0.0, 0.0);
        self.add("cabinet", "Place", [x, y, body / 2.0], place.yaw, EntityShape::Box([deep, wide, body]));
        self.add("top", "Place", [x, y, height + 0.01], place.yaw, EntityShape::Box([deep, wide, 0.02]));
        let extents = [deep - 0.02, wide - 0.04, part - 0.02];
        let id =
            self.add("drawer", "Container", [x, y, body + part / 2.0], place.yaw, EntityShape::Box(extents));
        let out = self.chance.between(0.2, 0.35);
        let is_open = self.chance.is(0.7);
        if let Some(drawer) = self.scene.entities.get_mut(&id) {
            drawer.travel = Some(Travel::Slide { axis: [1.0, 0.0, 0.0], distance: out });
            drawer.open = Some(is_open);
        }
        if is_open {
            let place = Place { x: place.at(out, 0.0)[0], y: place.at(out, 0.0)[1], ..place };
            let (inside, aside) = (deep / 2.0 - out / 2.0, self.chance.between(-0.2, 0.2) * wide);
            self.thing(place, [inside, aside], body + 0.02);
        }
        if self.chance.is(0.5) {
            self.thing(place, [0.0, 0.0], height + 0.02);
        }
    }

    /// Things on a rectangle, some next to each other.
    fn things(&mut self, place: Place, [deep, wide]: [f64; 2], height: f64) {
        for _ in 0..1 + self.chance.below(4) {
            let x = self.chance.between(-0.42, 0.42) * deep;
            let y = self.chance.between(-0.42, 0.42) * wide;
            self.thing(place, [x, y], height);
        }
    }

    /// Something to grasp, where nothing else stands.
    fn thing(&mut self, place: Place, [x, y]: [f64; 2], height: f64) {
        let (kind, shape, tall, round): (&str, EntityShape, f64, f64) = match self.chance.below(5) {
            0 => {
                let (radius, height) = (self.chance.between(0.025, 0.05), self.chance.between(0.08, 0.26));
                ("bottle", EntityShape::Cylinder { radius, height }, height, radius)
            }
            1 => {
                let (radius, height) = (self.chance.between(0.03, 0.06), self.chance.between(0.06, 0.13));
                ("can", EntityShape::Cylinder { radius, height }, height, radius)
            }
            2 => {
                let radius = self.chance.between(0.02, 0.042);
                ("ball", EntityShape::Sphere { radius }, 2.0 * radius, radius)
            }
            3 => {
                let [a, b, c] = [0.03, 0.03, 0.04].map(|least| self.chance.between(least, 0.11));
                ("box", EntityShape::Box([a, b, c]), c, a.hypot(b) / 2.0)
            }
            _ => {
                let [a, b, c] = [0.03, 0.12, 0.12].map(|least| self.chance.between(least, least + 0.08));
                ("packet", EntityShape::Box([a, b, c]), c, a.hypot(b) / 2.0)
            }
        };
        let yaw = self.chance.between(-3.1, 3.1);
        let at = place.at(x, y);
        let low = height + 0.001;
        let overlaps = self.scene.entities.values().any(|other| {
            let Some(pose) = other.pose.filter(|_| other.kind == "Object") else { return false };
            let far = (pose.xyz[0] - at[0]).hypot(pose.xyz[1] - at[1]);
            far < round + 0.09 && (pose.xyz[2] - low).abs() < 0.3
        });
        if !overlaps {
            self.add(kind, "Object", [at[0], at[1], low + tall / 2.0], yaw, shape);
        }
    }

    /// A free place on the floor for something so large, no farther away than `far`.
    fn free(&mut self, radius: f64, far: f64) -> Option<Place> {
        for _ in 0..30 {
            let (x, y) = (self.chance.between(-far, far), self.chance.between(-far, far));
            self.turn = self.chance.between(-std::f64::consts::PI, std::f64::consts::PI);
            let overlaps =
                self.outlines.iter().any(|([a, b], wide)| (a - x).hypot(b - y) < wide + radius + 0.02);
            if !overlaps {
                self.outlines.push(([x, y], radius));
                return Some(Place { x, y, yaw: self.turn });
            }
        }
        None
    }

    fn add(&mut self, class: &str, kind: &str, xyz: [f64; 3], yaw: f64, shape: EntityShape) -> SmolStr {
        let id = format_smolstr!("{class}_{}", self.scene.entities.len());
        let pose = Placement { xyz, rpy: [0.0, 0.0, yaw] };
        let mut entity = Entity::place(id.clone(), pose);
        entity.kind = kind.into();
        entity.class = class.into();
        entity.fixed = kind != "Object";
        entity.shape = Some(shape);
        self.scene.entities.insert(id.clone(), entity);
        id
    }
}

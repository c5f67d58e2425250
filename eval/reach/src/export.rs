//! Rooms, witnesses and targets for other programs, a JSON object each: lengths in m, angles in rad, poses in
//! the map as `x y z` and the quaternion `x y z w`.

use motet_geometry::planning::{Configuration, MotionWitness, RobotModel, SceneState, components};
use motet_robots::scene::Scene;
use nalgebra::Isometry3;
use serde_json::{Value, json};

use crate::grasp::Grasp;
use crate::judge::Case;
use crate::model::Model;
use crate::scenery::Scenery;
use crate::truth;

/// Grasps that are written for a target.
const GRASPS: usize = 40;

/// A robot in a room.
#[derive(Clone, Copy)]
pub(crate) struct Subject<'a> {
    pub(crate) model: &'a Model,
    pub(crate) scene: &'a Scene,
    pub(crate) world: &'a SceneState,
}

fn pose(pose: &Isometry3<f64>) -> Value {
    let (xyz, xyzw) = components(pose);
    json!([xyz[0], xyz[1], xyz[2], xyzw[0], xyzw[1], xyzw[2], xyzw[3]])
}

fn state(state: &Configuration) -> Value {
    json!({"base": state.base, "joints": state.joints})
}

impl Subject<'_> {
    /// All that another program needs to check a witness.
    pub(crate) fn witness(self, name: &str, witness: &MotionWitness) -> Value {
        let mut line = self.room(name);
        let grasp = witness.grasp.as_ref();
        line["path"] = witness.path.iter().map(state).collect();
        line["object"] = json!(grasp.map(|grasp| &grasp.object));
        line["map_from_tip"] = json!(grasp.map(|grasp| pose(&grasp.map_from_tip)));
        line
    }

    /// All that another program needs to look for a way to a target itself, with what was answered and what
    /// is true.
    pub(crate) fn target(self, case: &Case, target: &str, seed: u64) -> Value {
        let mut line = self.room(&case.name);
        let machine = &self.model.machine;
        let start = &self.world.robot;
        line["start"] = state(start);
        // With the hand open, as it is at a grasp: where the arm is folded there may be no room for that.
        line["open"] = json!(machine.hand().map(|hand| hand.opened(&start.joints)));
        line["object"] = json!(target);
        let grasps = truth::grasps(self.model, self.scene, target, seed, GRASPS);
        let grasp =
            |it: &Grasp| json!({"map_from_tip": pose(&it.map_from_tip), "approach": it.approach.as_slice()});
        line["grasps"] = grasps.iter().map(grasp).collect();
        line["moves"] = self.moves();
        line["reach"] = json!(machine.hand().map(|hand| hand.card.reach_m));
        line["said"] = json!(case.said);
        line["is_reachable"] = json!(case.is_reachable());
        line["took_us"] = json!(case.took.as_secs_f64() * 1e6);
        line
    }

    /// The joints that a search may move; the base aside.
    fn moves(self) -> Value {
        let dofs = self.model.machine.tree().dofs();
        self.model.movable().iter().flatten().map(|at| json!(dofs[*at].name)).collect()
    }

    fn room(self, name: &str) -> Value {
        let Self { model, scene, world } = self;
        let machine: &RobotModel = &model.machine;
        let obstacles: Vec<_> = Scenery::new(scene, world).map_or_else(Vec::new, |scenery| {
            let shown = scenery.solids.iter().filter_map(|(entity, solid)| {
                let (id, _) = scene.entities.get_index(*entity)?;
                let shape = if let Some(it) = solid.shape.as_cuboid() {
                    let half = it.half_extents;
                    json!({"box": [half.x * 2.0, half.y * 2.0, half.z * 2.0]})
                } else if let Some(it) = solid.shape.as_cylinder() {
                    json!({"cylinder_along_y": [it.radius, it.half_height * 2.0]})
                } else {
                    json!({"ball": solid.shape.as_ball()?.radius})
                };
                Some(json!({"entity": id, "pose": pose(&solid.pose), "shape": shape}))
            });
            shown.collect()
        });
        let body = machine.body();
        let links =
            |pair: &[usize; 2]| pair.map(|part| machine.tree().links()[body.parts()[part].link].clone());
        let mut apart: Vec<_> = body.pairs().iter().map(links).collect();
        apart.sort();
        apart.dedup();
        let chosen = |is: &dyn Fn(usize) -> bool| -> Vec<_> {
            (0..model.urdf.links.len())
                .filter(|at| is(*at))
                .map(|at| model.urdf.links[at].name.clone())
                .collect()
        };
        let card = machine.card();
        let tip = machine.hand().map(|hand| machine.tree().links()[hand.tip].clone());
        json!({
            "name": name,
            "robot": card.name,
            "base_link": card.model.as_ref().and_then(|model| model.base.clone()),
            "height": card.model.as_ref().map_or(0.0, |model| model.height_m),
            "tip": tip,
            "drives": machine.drives(),
            "variables": machine.tree().dofs().iter().map(|known| known.name.clone()).collect::<Vec<_>>(),
            "apart": apart,
            "carried": chosen(&|at| model.is_carried(at)),
            "members": chosen(&|at| model.in_hand(at)),
            "obstacles": obstacles,
        })
    }
}

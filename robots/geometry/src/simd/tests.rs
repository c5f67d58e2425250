//! Batch checks give the same results on every processor, and agree with `f64` checks of each configuration.

use motet_robots::builtin;
use nalgebra::Isometry3;
use pulp::Arch;

use super::{Batch8, BatchCheck, BatchModel, NearPair, Obb, ObbSet, PairTarget, PosedBatch};
use crate::collision::{CollisionModel, Shape, Solid};
use crate::kinematics::{KinematicTree, planar, quasi_random};

struct Robot {
    tree: KinematicTree,
    body: CollisionModel,
    batch_model: BatchModel,
    rest: Vec<f64>,
}

fn robot(name: &str) -> Robot {
    let urdf = builtin::robot(name).unwrap().urdf;
    let tree = KinematicTree::new(&urdf);
    let body = CollisionModel::new(&urdf, &tree, &[]);
    let rest = tree.neutral();
    let reduced = tree.reduced(&rest, |at| !is_leg(&tree, at)).unwrap();
    let batch_model = BatchModel::new(&reduced, &Isometry3::translation(0.0, 0.0, 0.3), &body).unwrap();
    Robot { tree, body, batch_model, rest }
}

/// Legs turn farther than the accurate range, and are fixed.
fn is_leg(tree: &KinematicTree, at: usize) -> bool {
    ["HAA", "HFE", "KFE"].iter().any(|end| tree.dofs()[at].name.ends_with(end))
}

impl Robot {
    fn joints(&self, index: usize) -> Vec<f64> {
        let mut joints = quasi_random(self.tree.dofs(), index);
        for (at, value) in joints.iter_mut().enumerate() {
            if is_leg(&self.tree, at) {
                *value = self.rest[at];
            }
        }
        joints
    }

    /// Pairs of solids with their distances, without those that do not move relative to each other, which are
    /// not checked.
    fn moved_pairs<'a>(
        &'a self,
        placed: &'a [Solid],
        still: &'a [Solid],
    ) -> impl Iterator<Item = ([usize; 2], f64)> + 'a {
        let apart = |solids: &[Solid], [one, other]: [usize; 2]| solids[one].distance(&solids[other]);
        let pairs = self.body.pairs().iter().map(move |pair| (*pair, apart(placed, *pair)));
        pairs.filter(move |(pair, distance)| (distance - apart(still, *pair)).abs() >= 1e-9)
    }

    fn placed(&self, base: [f64; 3], joints: &[f64]) -> Vec<Solid> {
        let map_from_root = planar(base[0], base[1], base[2]) * Isometry3::translation(0.0, 0.0, 0.3);
        let poses: Vec<_> =
            self.tree.root_from_links(joints).iter().map(|pose| map_from_root * pose).collect();
        self.body.placed(&poses)
    }
}

fn base(index: usize) -> [f64; 3] {
    let part = |step: f64| (index as f64 * step).fract() * 2.0 - 1.0;
    [part(0.618) * 2.0, part(0.755) * 2.0, part(0.57) * 3.1]
}

fn things() -> Vec<Solid> {
    let thing = |index: usize| {
        let [x, y, yaw] = base(index * 7 + 3);
        let pose = Isometry3::new([x, y, 0.1 * (index % 14) as f64].into(), [yaw * 0.3, 0.2, yaw].into());
        let shape = match index % 3 {
            0 => Shape::Box([0.3, 0.05, 0.2].into()),
            1 => Shape::Cylinder { radius: 0.2, half: 0.1 },
            _ => Shape::Capsule { radius: 0.1, half: 0.2 },
        };
        Solid::new(&pose, shape)
    };
    (0..12).map(thing).collect()
}

fn near_pairs(robot: &Robot, batch: &Batch8, obbs: &ObbSet, gap: f32, arch: Arch) -> Vec<NearPair> {
    let beyond = |_: usize, _: Option<usize>| Some(0.0);
    let (batch_model, pairs, posed) = (&robot.batch_model, None, &mut PosedBatch::default());
    let gaps = [gap; 8];
    BatchCheck {
        batch_model,
        batch,
        obbs,
        gaps,
        is_own: true,
        is_first: false,
        pairs,
        posed,
        most_beyond: 0.0,
        beyond,
    }
    .near_pairs_on(arch)
}

const GAP: f32 = 0.01;

#[test]
fn batch_check_finds_all_near_pairs() {
    let things = things();
    let obbs: ObbSet = things.iter().map(|thing| Obb::new(thing, [0.0; 2]).unwrap()).collect();
    for name in ["hsr", "anymal_z1", "panda"] {
        let robot = robot(name);
        let (mut told, mut near, mut sure) = (0, 0, 0);
        for block in 0..8 {
            let mut batch = robot.batch_model.batch();
            let states: Vec<_> =
                (0..8).map(|lane| (base(block * 8 + lane), robot.joints(block * 8 + lane))).collect();
            for (lane, (base, joints)) in states.iter().enumerate() {
                assert!(robot.batch_model.set(&mut batch, lane, *base, joints));
            }
            let met = near_pairs(&robot, &batch, &obbs, GAP, Arch::new());
            let is_met = |part: usize, is: &dyn Fn(PairTarget) -> bool, lane: usize| {
                met.iter()
                    .any(|met| met.pair.part == part && is(met.pair.target) && met.lanes >> lane & 1 == 1)
            };
            for (lane, (base, joints)) in states.iter().enumerate() {
                let placed = robot.placed(*base, joints);
                for met in met.iter().filter(|met| met.sure >> lane & 1 == 1) {
                    let one = &placed[met.pair.part];
                    let is_near = match met.pair.target {
                        PairTarget::Obb(at) => !one.is_farther(&things[at], f64::from(GAP)),
                        PairTarget::Part(at, _) => !one.is_farther(&placed[at], f64::from(GAP)),
                        PairTarget::Floor => {
                            one.centre.z - one.extent(&nalgebra::Vector3::z()) <= f64::from(GAP)
                        }
                    };
                    assert!(is_near, "{name}: {met:?}");
                    sure += 1;
                }
                told += met.iter().map(|met| u32::from(met.lanes >> lane & 1)).sum::<u32>();
                for (part, solid) in placed.iter().enumerate() {
                    for (at, thing) in things.iter().enumerate() {
                        let is_near = !solid.is_farther(thing, f64::from(GAP));
                        near += u32::from(is_near);
                        assert!(!is_near || is_met(part, &|it| it == PairTarget::Obb(at), lane), "{name}");
                    }
                    let above = solid.centre.z - solid.extent(&nalgebra::Vector3::z());
                    let is_near = above <= f64::from(GAP);
                    near += u32::from(is_near);
                    assert!(!is_near || is_met(part, &|it| it == PairTarget::Floor, lane), "{name}");
                }
                let still = robot.placed(*base, &robot.joints(0));
                for ([one, other], distance) in robot.moved_pairs(&placed, &still) {
                    let is_near = distance <= f64::from(GAP);
                    near += u32::from(is_near);
                    let is = |it| matches!(it, PairTarget::Part(at, _) if at == other);
                    assert!(!is_near || is_met(one, &is, lane), "{name}: {one} {other} {distance}");
                }
            }
        }
        // Boxes around cylinders and capsules report some more pairs, but not many.
        assert!(near > 50 && told < 2 * near, "{name}: {near} near, {told} told");
        assert!(sure > 30, "{name}: {sure} for certain");
    }
}

#[test]
fn batch_check_is_equal_on_every_processor() {
    let obbs: ObbSet = things().iter().map(|thing| Obb::new(thing, [0.0; 2]).unwrap()).collect();
    for name in ["hsr", "anymal_z1", "panda"] {
        let robot = robot(name);
        for block in 0..24 {
            let mut batch = robot.batch_model.batch();
            for lane in 0..8 {
                let at = block * 8 + lane;
                robot.batch_model.set(&mut batch, lane, base(at), &robot.joints(at));
            }
            if block % 2 == 1 {
                robot.batch_model.set_motion(&mut batch, [0.02, 0.01, 0.03], |at| 0.01 * (at % 4) as f64);
            }
            let told = [Arch::Scalar, Arch::new()].map(|arch| near_pairs(&robot, &batch, &obbs, GAP, arch));
            assert_eq!(told[0], told[1], "{name}");
            assert!(!told[0].is_empty());
        }
    }
}

/// Pairs reported as apart on an edge segment are apart at every configuration of it.
#[test]
fn batch_check_is_sound_along_an_edge() {
    let things = things();
    let obbs: ObbSet = things.iter().map(|thing| Obb::new(thing, [0.0; 2]).unwrap()).collect();
    for name in ["hsr", "anymal_z1", "panda"] {
        let robot = robot(name);
        let (mut near, mut told) = (0, 0);
        for block in 0..40 {
            let (from, to) = (robot.joints(block), robot.joints(block + 1));
            let start = base(block);
            // Every third moves only joints, as most edges of an arm do.
            let end =
                if block % 3 == 0 { start } else { [0, 1, 2].map(|at| start[at] + [0.3, -0.2, 0.4][at]) };
            let half = [0.01, 0.03, 0.1][block % 3];
            let shares = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8];
            let mut batch = robot.batch_model.batch();
            assert!(robot.batch_model.set_on(&mut batch, [(start, &from), (end, &to)], &shares, half));
            let met = near_pairs(&robot, &batch, &obbs, GAP, Arch::new());
            told += met.iter().map(|met| met.lanes.count_ones()).sum::<u32>();
            for (lane, share) in shares.iter().enumerate() {
                let at = |part: f64| {
                    let part = share + half * part;
                    let joints: Vec<f64> = from.iter().zip(&to).map(|(a, b)| a + (b - a) * part).collect();
                    robot
                        .placed([0, 1, 2].map(|axis| start[axis] + (end[axis] - start[axis]) * part), &joints)
                };
                let is_met = |part: usize, is: &dyn Fn(PairTarget) -> bool| {
                    let mut all = met.iter().filter(|met| met.lanes >> lane & 1 == 1);
                    all.any(|met| met.pair.part == part && is(met.pair.target))
                };
                let still = robot.placed(start, &from);
                for placed in [-1.0, -0.6, -0.2, 0.3, 0.7, 1.0].map(at) {
                    for (part, solid) in placed.iter().enumerate() {
                        for (at, thing) in things.iter().enumerate() {
                            // Solids that do not move on an edge are free.
                            let is_near =
                                !solid.is_farther(thing, f64::from(GAP)) && moves(solid, &still[part]);
                            near += u32::from(is_near);
                            assert!(
                                !is_near || is_met(part, &|it| it == PairTarget::Obb(at)),
                                "{name} {block}"
                            );
                        }
                    }
                    for ([one, other], distance) in robot.moved_pairs(&placed, &still) {
                        let is_near = distance <= f64::from(GAP);
                        near += u32::from(is_near);
                        let is = |it| matches!(it, PairTarget::Part(at, _) if at == other);
                        assert!(!is_near || is_met(one, &is), "{name} {block}: {one} {other} {distance}");
                    }
                }
            }
        }
        assert!(near > 500 && told > 200, "{name}: {near} near, {told} told");
    }
}

fn moves(one: &Solid, other: &Solid) -> bool {
    (one.centre - other.centre).norm() > 1e-9
        || one.axes.iter().zip(other.axes).any(|(a, b)| (a - b).norm() > 1e-9)
}

/// No point of a part moves farther than its bound.
#[test]
fn batch_motion_bounds_are_sound() {
    for name in ["hsr", "anymal_z1", "panda"] {
        let robot = robot(name);
        for block in 0..12 {
            let (from, to) = (robot.joints(block), robot.joints(block + 1));
            let (start, change) = (base(block), [0.05, -0.03, 0.1]);
            let share = 0.05;
            let mut batch = robot.batch_model.batch();
            for lane in 0..8 {
                assert!(robot.batch_model.set(&mut batch, lane, start, &from));
            }
            robot
                .batch_model
                .set_motion(&mut batch, change.map(|value| value * share), |at| (to[at] - from[at]) * share);
            let goes = super::posed_batch::displacements_in_map(&robot.batch_model, &batch);
            let at = |part: f64| {
                let joints: Vec<f64> =
                    from.iter().zip(&to).map(|(a, b)| a + (b - a) * share * part).collect();
                let base = [0, 1, 2].map(|axis| start[axis] + change[axis] * share * part);
                robot.placed(base, &joints)
            };
            let first = at(0.0);
            for part in [-1.0, -0.5, 0.5, 1.0] {
                for ((one, other), goes) in first.iter().zip(at(part)).zip(&goes) {
                    for axis in one.axes.iter().zip(other.axes).map(|(a, b)| [*a, b]) {
                        for sign in [-1.0, 1.0] {
                            let end = |solid: &Solid, axis: nalgebra::Vector3<f64>| {
                                let half = match solid.shape {
                                    Shape::Capsule { .. } => solid.reach() * axis.dot(&solid.axes[2]).abs(),
                                    _ => solid.extent(&axis),
                                };
                                solid.centre + axis * (half * sign)
                            };
                            let [a, b] = axis;
                            let far = (end(one, a) - end(&other, b)).norm();
                            assert!(far <= f64::from(*goes) + 1e-5, "{name}: {far} {goes}");
                        }
                    }
                }
            }
        }
    }
}

//! Soundness of cells and certificates: bounds hold for every configuration of a cell, and a covered scene
//! has no free one. Every grasp that a search tries is in some patch.

use motet_robots::scene::{Entity, EntityShape, Placement, Scene};
use nalgebra::{Isometry3, Vector3};
use proptest::prelude::*;

use super::Certificate;
use super::cover::{ArmFamily, CellModel, CellPlacement, ContactGroup};
use super::relative::PairGroup;
use super::split::SplitCause;
use crate::collision::{Shape, Solid};
use crate::inverse::interval::{DisplacementBound, IkCell, IntervalSolution, PoseSet};
use crate::planning::certify::deflate::DeflatedPart;
use crate::planning::context::QueryContext;
use crate::planning::grasp::{GraspManifold, grasp_candidates};
use crate::planning::query::GraspSide;
use crate::planning::scene::{
    AllowedCollisions, Configuration, HandModel, RobotModel, SceneState, solid_shape,
};
use crate::planning::search::{SPACE, part};
use crate::trigonometry::wrapped;

/// Configuration with the arm's joints at shares of their ranges.
fn configuration(
    context: &QueryContext<'_>,
    hand: &HandModel,
    base: [f64; 3],
    shares: &[f64],
) -> (Configuration, Vec<f64>) {
    let dofs = &hand.solver.chain().dofs;
    let values: Vec<f64> = dofs
        .iter()
        .zip(shares)
        .map(|(dof, share)| {
            let (lower, upper) = dof.limits.unwrap();
            lower + share * (upper - lower)
        })
        .collect();
    (context.with(hand, base, &values), values)
}

/// Free parameters of a configuration, each with a flag for angles modulo full turns.
fn parameters(family: ArmFamily<'_>, yaw: f64, values: &[f64]) -> [f64; 3] {
    match family {
        ArmFamily::Lift(_) => [yaw, values[1], 0.0],
        // All parallel axes of the Z1 point the same way.
        ArmFamily::Parallel(..) => [wrapped(yaw + values[0]), wrapped(values[1] + values[2]), yaw],
        ArmFamily::Seven(..) => [values[6], 0.0, 0.0],
        ArmFamily::Any => [0.0; 3],
    }
}

/// Distance of the farthest point of a part from its place in a cell.
fn off(one: &DeflatedPart, other: &DeflatedPart) -> f64 {
    let along = |solid: &Solid| match solid.shape {
        Shape::Capsule { half, .. } | Shape::Cylinder { half, .. } => solid.axes[2] * half,
        Shape::Box(_) | Shape::HalfSpace => Vector3::zeros(),
    };
    let ends = [1.0, -1.0].map(|sign| {
        let (one, other) = (&one.solid, &other.solid);
        (one.centre + along(one) * sign - other.centre - along(other) * sign).norm()
    });
    ends[0].max(ends[1])
}

/// Checks that a configuration is in its cell; `tilt` turns and shifts the tip from the cell's middle.
fn a_state_is_in_its_cell(
    name: &str,
    base: [f64; 3],
    shares: &[f64],
    places: [f64; 3],
    [size, tilt]: [f64; 2],
) {
    let model = RobotModel::embedded(name);
    let scene = Scene::default();
    let state = SceneState::new(&model, &scene);
    let context = QueryContext::new(&model, &scene, &state);
    let hand = model.hand().unwrap();
    let checker = context.around([0.0; 2], 10.0);
    let cover = CellModel::new(&checker, hand, AllowedCollisions::default()).unwrap();
    let (configuration, values) = configuration(&context, hand, base, shares);
    let tip = model.map_from_links(&configuration)[hand.tip];
    let middle = parameters(cover.family, base[2], &values);
    let roots = cover.family.cells();
    let [x, y, z] = places.map(|place| 2.0 * place - 1.0);
    let axis = Vector3::new(x, y, z + 1e-3).normalize();
    let about = tip.translation.vector + axis * 0.1;
    let turned = nalgebra::UnitQuaternion::from_scaled_axis(axis * tilt);
    let at = about + turned * (tip.translation.vector - about) + axis * (0.2 * tilt);
    let map_from_tip = Isometry3::from_parts(at.into(), turned * tip.rotation);
    // Along the axis of the turn, so that the order does not matter.
    let still = DisplacementBound::none();
    let drift = match x > 0.0 {
        true => still.shifted(0.2 * tilt).turned(about, tilt),
        false => still.slid(axis * (0.2 * tilt)).spun(axis, about, tilt),
    };
    let tips = PoseSet::new(map_from_tip, drift);
    let mut nearest = (f64::INFINITY, String::new());
    for root in &roots {
        let half = root.half.map(|half| half * size);
        let middle = [0, 1, 2].map(|at: usize| middle[at] + (2.0 * places[at] - 1.0) * half[at]);
        let IntervalSolution::Enclosed(enclosure) =
            cover.family.over(&tips, &IkCell { branch: root.branch, middle, half })
        else {
            continue;
        };
        let mut placing = CellPlacement::default();
        cover.place(&enclosure, &mut placing);
        let parts = 0..context.body.parts().len() as u16;
        let placed: Vec<DeflatedPart> = parts.map(|part| *cover.part(&mut placing, part).unwrap()).collect();
        let poses = model.map_from_links(&configuration);
        let solids = context.body.placed(&poses);
        let beyond = placed.iter().zip(&solids).map(|(placed, solid)| {
            let there = DeflatedPart { solid: *solid, ..*placed };
            off(placed, &there) - placed.drift
        });
        let beyond = beyond.fold(f64::NEG_INFINITY, f64::max);
        let joints = enclosure.values.iter().zip(&values).zip(&hand.solver.chain().dofs);
        let joints = joints.map(|(([middle, far], value), dof)| {
            let off = if dof.name.contains("lift") { value - middle } else { wrapped(value - middle) };
            off.abs() - far
        });
        let beyond = beyond.max(joints.fold(f64::NEG_INFINITY, f64::max));
        let beyond = beyond.max(cover.beyond_ties(&mut placing, &solids, &poses));
        if beyond < nearest.0 {
            nearest = (beyond, format!("way {}", root.branch));
        }
    }
    assert!(nearest.0 < 1e-5, "{name}, {values:?}: {} m or rad beyond, {}", nearest.0, nearest.1);
}

/// Can in a box without a front, with inner width, height and depth, at a height above the floor.
fn niche([wide, high, deep]: [f64; 3], [ahead, up]: [f64; 2], [x, y]: [f64; 2]) -> Scene {
    let mut scene = Scene::default();
    let mut add = |id: &str, kind: &str, xyz: [f64; 3], shape: EntityShape| {
        let mut entity = Entity::place(id.into(), Placement { xyz, rpy: [0.0; 3] });
        entity.kind = kind.into();
        entity.shape = Some(shape);
        scene.entities.insert(id.into(), entity);
    };
    let middle = ahead + deep / 2.0;
    add("below", "Place", [middle, 0.0, up / 2.0], EntityShape::Box([deep, wide + 0.3, up]));
    add("above", "Place", [middle, 0.0, up + high + 0.1], EntityShape::Box([deep, wide + 0.3, 0.2]));
    add(
        "back",
        "Place",
        [ahead + deep + 0.1, 0.0, up + high / 2.0],
        EntityShape::Box([0.2, wide + 0.3, high]),
    );
    for (id, side) in [("left", 0.5), ("right", -0.5)] {
        let aside = side * (wide + 0.15);
        add(id, "Place", [middle, aside, up + high / 2.0], EntityShape::Box([deep, 0.15, high]));
    }
    let (radius, height) = (0.03, 0.1);
    let at = [ahead + 0.04 + x * (deep - 0.08), (y - 0.5) * (wide - 0.08), up + height / 2.0 + 0.001];
    add("can", "Object", at, EntityShape::Cylinder { radius, height });
    scene
}

/// Tip poses in which the hand alone is free.
fn poses(
    context: &QueryContext<'_>,
    hand: &HandModel,
    scene: &Scene,
) -> (Vec<Isometry3<f64>>, AllowedCollisions, Solid) {
    let (index, _, entity) = scene.entities.get_full("can").unwrap();
    let allowed = AllowedCollisions::of_grasp(context, index);
    let pose = context.state.pose(entity).unwrap();
    let object = Solid::new(&pose, solid_shape(entity).unwrap());
    let (holds, _) = grasp_candidates(hand, &object, None, context.state.robot.base, None);
    let tips: Vec<_> = holds.iter().map(|hold| hold.map_from_tip).collect();
    let palm = context.hand_checker(hand, &tips, allowed);
    (tips.into_iter().filter(|tip| palm.contact(tip).is_none()).collect(), allowed, object)
}

/// Verdict of a certificate in a niche; random configurations try to contradict it.
fn covered(name: &str, scene: &Scene, cells: usize, draws: &[[f64; 4]]) -> Option<bool> {
    let model = RobotModel::embedded(name);
    let state = SceneState::new(&model, scene);
    let context = QueryContext::new(&model, scene, &state);
    let hand = model.hand().unwrap();
    let (tips, allowed, object) = poses(&context, hand, scene);
    let checker = context.around([2.0, 0.0], 4.0);
    let manifold = GraspManifold::new(hand, &object, None, state.robot.base);
    let covered = checker.covered(hand, &manifold, allowed, cells, |hold, configuration| {
        assert!(model.tree().allows(&configuration.joints));
        assert_eq!(checker.contact_exactly(&configuration, allowed), None);
        let tip = model.map_from_links(&configuration)[hand.tip].inverse() * hold.map_from_tip;
        assert!(tip.translation.vector.norm() < 1e-6 && tip.rotation.angle() < 1e-6);
        std::ops::ControlFlow::Break(())
    });
    let said = match covered {
        Certificate::Nowhere => !tips.is_empty(),
        Certificate::Somewhere => return Some(false),
        Certificate::Open => return None,
    };
    let cover = CellModel::new(&checker, hand, allowed).unwrap();
    for (tip, [a, b, c, d]) in tips.iter().flat_map(|tip| draws.iter().map(move |draw| (tip, draw))) {
        let yaw = a * std::f64::consts::TAU;
        let configurations: Vec<Configuration> = match cover.family {
            ArmFamily::Lift(arm) => arm
                .solve(tip, yaw, -2.62 * b)
                .iter()
                .map(|placed| context.with(hand, placed.base, &placed.values))
                .collect(),
            ArmFamily::Parallel(arm, _) => {
                let (sin, cos) = (c * std::f64::consts::TAU).sin_cos();
                let base = [tip.translation.x + d * cos, tip.translation.y + d * sin, yaw];
                let found = arm.solve(&(context.map_from_base(base).inverse() * tip));
                found.iter().map(|values| context.with(hand, base, values)).collect()
            }
            ArmFamily::Seven(arm, map_from_base, base) => {
                let found = arm.solve(&(map_from_base.inverse() * tip), 5.8 * a - 2.9);
                found.iter().map(|values| context.with(hand, base, values)).collect()
            }
            ArmFamily::Any => vec![],
        };
        for configuration in configurations {
            assert!(
                checker.contact_exactly(&configuration, allowed).is_some(),
                "{name}: {configuration:?} is free"
            );
        }
    }
    Some(said)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    #[test]
    fn cell_of_the_hsr_contains_its_configurations(
        base in [-2.0..2.0_f64, -2.0..2.0_f64, -3.1..3.1_f64],
        shares in prop::collection::vec(0.0..1.0_f64, 5),
        places in [0.0..1.0_f64, 0.0..1.0_f64, 0.0..1.0_f64],
        size in prop::sample::select(vec![0.0, 1e-3, 0.01, 0.1, 0.5]),
        off in prop::sample::select(vec![0.0, 1e-3, 0.02, 0.2]),
    ) {
        a_state_is_in_its_cell("hsr", base, &shares, places, [size, off]);
    }

    #[test]
    fn cell_of_the_anymal_contains_its_configurations(
        base in [-2.0..2.0_f64, -2.0..2.0_f64, -3.1..3.1_f64],
        shares in prop::collection::vec(0.0..1.0_f64, 6),
        places in [0.0..1.0_f64, 0.0..1.0_f64, 0.0..1.0_f64],
        size in prop::sample::select(vec![0.0, 1e-3, 0.01, 0.1, 0.5]),
        off in prop::sample::select(vec![0.0, 1e-3, 0.02, 0.2]),
    ) {
        a_state_is_in_its_cell("anymal_z1", base, &shares, places, [size, off]);
    }

    #[test]
    fn cell_of_the_panda_contains_its_configurations(
        shares in prop::collection::vec(0.0..1.0_f64, 7), place in 0.0..1.0_f64,
        size in prop::sample::select(vec![0.0, 1e-3, 0.01, 0.1, 0.5]),
        off in prop::sample::select(vec![0.0, 1e-3, 0.02, 0.2]),
    ) {
        a_state_is_in_its_cell("panda", [0.0; 3], &shares, [place, 0.3, 0.9], [size, off]);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    #[test]
    fn certificate_excludes_every_sampled_configuration(
        size in [0.15..0.6_f64, 0.12..0.5_f64, 0.2..0.8_f64], up in 0.05..1.1_f64,
        place in [0.0..1.0_f64, 0.0..1.0_f64],
        draws in prop::collection::vec([0.0..1.0_f64, 0.0..1.0_f64, 0.0..1.0_f64, 0.0..1.0_f64], 60),
        name in prop::sample::select(vec!["hsr", "anymal_z1", "panda"]),
    ) {
        // The Panda stands on its bench.
        let at = if name == "panda" { [0.3, 0.6 + 0.5 * up] } else { [1.5, up] };
        covered(name, &niche(size, at, place), 20_000, &draws);
    }
}

#[test]
fn certificate_of_the_hsr_covers_only_unreachable_objects() {
    let draws: Vec<[f64; 4]> = (0..200).map(|at| [1, 2, 3, 4].map(|n| part(at, n, SPACE))).collect();
    // Low and deep: room for the hand, none for the arm.
    let deep = niche([0.6, 0.4, 1.8], [1.5, 0.3], [1.0, 0.5]);
    assert_eq!(covered("hsr", &deep, 200_000, &draws), Some(true));
    assert_eq!(covered("hsr", &deep, 20, &draws), None);
    let open = niche([1.2, 0.8, 0.4], [1.5, 0.5], [0.0, 0.5]);
    assert_eq!(covered("hsr", &open, 200_000, &draws), Some(false));
}

#[test]
fn certificate_of_the_panda_covers_only_unreachable_objects() {
    let draws: Vec<[f64; 4]> = (0..200).map(|at| [1, 2, 3, 4].map(|n| part(at, n, SPACE))).collect();
    let far = niche([0.9, 0.7, 0.4], [0.9, 0.8], [1.0, 0.5]);
    assert_eq!(covered("panda", &far, 100_000, &draws), Some(true));
    let near = niche([0.9, 0.7, 0.4], [0.3, 0.8], [0.2, 0.5]);
    assert_eq!(covered("panda", &near, 100_000, &draws), Some(false));
}

/// Split causes are consistent: a cell closed for a share is closed for every smaller one, the cause is the
/// nearest, and no parameter moves a body more than all do.
fn culprit_is_nearest_to_closing_its_cell(name: &str, scene: &Scene, places: [f64; 3], size: f64) -> bool {
    let model = RobotModel::embedded(name);
    let state = SceneState::new(&model, scene);
    let context = QueryContext::new(&model, scene, &state);
    let hand = model.hand().unwrap();
    let (tips, allowed, _) = poses(&context, hand, scene);
    let checker = context.around([2.0, 0.0], 4.0);
    let cover = CellModel::new(&checker, hand, allowed).unwrap();
    let ([_, groups], pair_groups) = (cover.groups(), cover.pair_groups());
    let Some(tip) = tips.first() else { return false };
    let tips = PoseSet::new(*tip, DisplacementBound::none().shifted(0.1 * size));
    let root = cover.family.cells()[0];
    let half = root.half.map(|half| half * size);
    let middle = [0, 1, 2].map(|at: usize| root.middle[at] + (2.0 * places[at] - 1.0) * root.half[at]);
    let cell = IkCell { branch: root.branch, middle, half };
    let IntervalSolution::Enclosed(enclosure) = cover.family.over(&tips, &cell) else { return false };
    let (mut placing, mut aside) = (CellPlacement::default(), CellPlacement::default());
    cover.place(&enclosure, &mut placing);
    let found = cover.split_cause(&mut placing, &enclosure, &groups, &pair_groups);
    let pairs =
        groups.iter().flat_map(ContactGroup::pairs).chain(pair_groups.iter().flat_map(PairGroup::pairs));
    let limits = (0..enclosure.values.len()).map(SplitCause::Joint).chain([SplitCause::Short]);
    for split_cause in limits.chain(pairs.map(SplitCause::Pair)) {
        let mut closes = |share: f64| cover.closes(&mut placing, &enclosure, split_cause, share);
        let shares = [1.0, 0.5, 0.25, 0.125, 0.0625];
        assert!(shares.windows(2).all(|pair| !closes(pair[0]) || closes(pair[1])), "{name}: {split_cause:?}");
        let most = shares[1..].iter().find(|share| closes(**share));
        assert!(
            most.copied().unwrap_or(0.0) <= found.map_or(0.0, |(_, share)| share),
            "{name}: {split_cause:?}"
        );
    }
    let Some((split_cause, share)) = found else { return false };
    let split_gain = cover.split_gain(&mut aside, &tips, &cell, split_cause, share);
    let all = match split_cause {
        SplitCause::Joint(at) => enclosure.values[at][1],
        SplitCause::Short => enclosure.short[1],
        SplitCause::Pair(pair) => cover.off_by(&mut placing, pair),
    };
    assert!(
        split_gain.cell.iter().all(|off| *off <= all + 1e-9) && split_gain.patch <= all + 1e-9,
        "{name}: {split_gain:?} {all}"
    );
    true
}

#[test]
fn split_cause_names_the_open_constraint() {
    let scene = niche([0.6, 0.4, 0.8], [0.7, 0.4], [0.2, 0.5]);
    let mut told = 0;
    for name in ["hsr", "anymal_z1", "panda"] {
        for at in 0..60 {
            let places = [1, 2, 3].map(|n| part(at, n, SPACE));
            let size = [0.2, 0.05, 0.01][at % 3];
            told += u32::from(culprit_is_nearest_to_closing_its_cell(name, &scene, places, size));
        }
    }
    assert!(told > 20, "{told}");
}

/// Patches contain every grasp that a search tries.
#[test]
fn patch_contains_the_grasps_of_an_object() {
    let model = RobotModel::embedded("hsr");
    let hand = model.hand().unwrap();
    let shapes = [
        Shape::Cylinder { radius: 0.03, half: 0.08 },
        Shape::Cylinder { radius: 0.05, half: 0.02 },
        Shape::Capsule { radius: 0.03, half: 0.06 },
        Shape::Capsule { radius: 0.04, half: 0.0 },
        Shape::Box(Vector3::new(0.02, 0.05, 0.09)),
    ];
    let lean = nalgebra::UnitQuaternion::from_euler_angles(0.4, 0.2, 1.0);
    let upright = nalgebra::UnitQuaternion::from_euler_angles(0.0, 0.0, 1.0);
    for (shape, rotation) in shapes.into_iter().flat_map(|shape| [(shape, upright), (shape, lean)]) {
        let pose = Isometry3::from_parts(nalgebra::Translation3::new(1.0, 0.3, 0.8), rotation);
        let object = Solid::new(&pose, shape);
        for side in [None, Some(GraspSide::Top), Some(GraspSide::Side), Some(GraspSide::Front)] {
            let manifold = GraspManifold::new(hand, &object, side, [0.0; 3]);
            let (holds, _) = grasp_candidates(hand, &object, side, [0.0; 3], None);
            assert!(side.is_some() || !holds.is_empty(), "{shape:?}");
            // Small ones, so that how far they say they go is not more than a hand is long.
            let (mut open, mut patches) = (manifold.patches(), vec![]);
            while let Some(patch) = open.pop() {
                let (size, across) = manifold.widest(&patch);
                if size > 0.08 {
                    open.extend(patch.halves(across));
                } else {
                    patches.push(patch);
                }
            }
            let tips: Vec<_> = patches.iter().filter_map(|patch| manifold.over(patch)).collect();
            for hold in &holds {
                let is_in = |(tip, drift): &(Isometry3<f64>, DisplacementBound)| {
                    [Vector3::zeros(), Vector3::x(), Vector3::y(), Vector3::z()].iter().all(|at| {
                        let at = nalgebra::Point3::from(at * 0.2);
                        let (one, other) = (hold.map_from_tip * at, tip * at);
                        let ball = Shape::Capsule { radius: 0.0, half: 0.0 };
                        let place = Isometry3::from_parts(other.coords.into(), upright);
                        (one - other).norm() <= drift.of(&Solid::new(&place, ball)) + 1e-6
                    })
                };
                assert!(tips.iter().any(is_in), "{shape:?}, {side:?}: {hold:?}");
            }
        }
    }
}

/// Patches of the handle contain every grasp that a search tries in steps.
#[test]
fn patch_contains_the_grasps_of_a_handle() {
    let model = RobotModel::embedded("anymal_z1");
    let hand = model.hand().unwrap();
    let (along, out) = (Vector3::new(0.0, 0.6, 0.8), Vector3::x());
    let centre = Vector3::new(1.0, 0.2, 0.7);
    let bar = Solid {
        centre,
        axes: [out, along.cross(&out), along],
        shape: Shape::Capsule { radius: 0.008, half: 0.2 },
    };
    let manifold = GraspManifold::of_bar(hand, &bar, out, 0.03, [1.05, 0.6]);
    for (tilt, place, sign) in [(0.0, 0.0, 1.0), (0.9, 0.6, -1.0), (-0.52, -0.6, 1.0), (-0.9, 0.3, -1.0)] {
        let turned = nalgebra::UnitQuaternion::from_scaled_axis(along * tilt);
        let approach = turned * -out;
        let closes = along.cross(&approach) * sign;
        let at = centre + along * (place * 0.2) - approach * 0.03 - closes * hand.middle(0.016);
        let tip = Isometry3::from_parts(at.into(), hand.turned(&approach, &closes));
        let mut open = manifold.patches();
        for _ in 0..12 {
            let halves = open.iter().flat_map(|patch| patch.halves(manifold.widest(patch).1));
            open = halves.collect();
            open.retain(|patch| {
                let Some((other, drift)) = manifold.over(patch) else { return false };
                [Vector3::zeros(), Vector3::x(), Vector3::y()].iter().all(|point| {
                    let point = nalgebra::Point3::from(point * 0.2);
                    let (one, other) = (tip * point, other * point);
                    (one - other).norm() <= drift.point(&other.coords, 0.0) + 1e-6
                })
            });
        }
        assert!(!open.is_empty(), "{tilt}, {place}, {sign}");
    }
}

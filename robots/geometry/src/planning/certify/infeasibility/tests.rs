//! What cells say of a robot holds for every one of its states, and what is covered has no free one.

use motet_robots::scene::{Entity, EntityShape, Placement, Scene};
use nalgebra::{Isometry3, Vector3};
use proptest::prelude::*;

use super::cover::{CellModel, CellPlacement, ContactGroup};
use super::relative::PairGroup;
use super::split::SplitCause;
use super::{ArmFamily, Certificate, GraspManifold};
use crate::collision::{Shape, Solid};
use crate::inverse::interval::{DisplacementBound, IkCell, IntervalSolution, PoseSet};
use crate::planning::certify::deflate::DeflatedPart;
use crate::planning::scene::configuration::Configuration;
use crate::planning::scene::contact::AllowedCollisions;
use crate::planning::scene::robot_model::{HandModel, RobotModel};
use crate::planning::scene::scene_state::SceneState;
use crate::planning::search::context::QueryContext;
use crate::trigonometry::wrapped;

mod grips;

/// A state with the arm's joints at shares of their ranges.
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

/// The free parameters of a state, and whether each is an angle of which full turns do not matter.
fn parameters(family: ArmFamily<'_>, yaw: f64, values: &[f64]) -> [f64; 3] {
    match family {
        ArmFamily::Lift(_) => [yaw, values[1], 0.0],
        // All axes of the Z1's parallel joints point alike.
        ArmFamily::Parallel(..) => [wrapped(yaw + values[0]), wrapped(values[1] + values[2]), yaw],
        ArmFamily::Seven(..) => [values[6], 0.0, 0.0],
        ArmFamily::Any => [0.0; 3],
    }
}

/// How far the farthest point of a part is off where a cell puts it.
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

/// `tilt` is how far the tip is turned and shifted from where the cell is about.
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
    // Along the axis about which it is turned, so that the order does not matter.
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

/// A can in a box without a front: walls, a floor and a ceiling, so wide, high and deep inside, and so high above the floor.
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

/// Poses in which the hand alone is free.
fn poses(
    context: &QueryContext<'_>,
    hand: &HandModel,
    scene: &Scene,
) -> (Vec<Isometry3<f64>>, AllowedCollisions, Solid) {
    let (index, _, entity) = scene.entities.get_full("can").unwrap();
    let allowed = AllowedCollisions { hand: Some(index), held: None };
    let pose = context.state.pose(entity).unwrap();
    let object = Solid::new(&pose, crate::planning::scene::obstacle::solid_shape(entity).unwrap());
    let (holds, _) =
        crate::planning::grasp::candidates::grasp_candidates(hand, &object, None, context.state.robot.base);
    let tips: Vec<_> = holds.iter().map(|hold| hold.map_from_tip).collect();
    let palm = context.palm(hand, &tips, allowed);
    (tips.into_iter().filter(|tip| palm.contact(tip).is_none()).collect(), allowed, object)
}

/// Whether it is covered that no state is free in a niche, with so many cells; draws states at random to contradict it.
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
    fn a_state_of_the_hsr_is_in_its_cell(
        base in [-2.0..2.0_f64, -2.0..2.0_f64, -3.1..3.1_f64], shares in prop::collection::vec(0.0..1.0_f64, 5),
        places in [0.0..1.0_f64, 0.0..1.0_f64, 0.0..1.0_f64], size in prop::sample::select(vec![0.0, 1e-3, 0.01, 0.1, 0.5]), off in prop::sample::select(vec![0.0, 1e-3, 0.02, 0.2]),
    ) {
        a_state_is_in_its_cell("hsr", base, &shares, places, [size, off]);
    }

    #[test]
    fn a_state_of_the_anymal_is_in_its_cell(
        base in [-2.0..2.0_f64, -2.0..2.0_f64, -3.1..3.1_f64], shares in prop::collection::vec(0.0..1.0_f64, 6),
        places in [0.0..1.0_f64, 0.0..1.0_f64, 0.0..1.0_f64], size in prop::sample::select(vec![0.0, 1e-3, 0.01, 0.1, 0.5]), off in prop::sample::select(vec![0.0, 1e-3, 0.02, 0.2]),
    ) {
        a_state_is_in_its_cell("anymal_z1", base, &shares, places, [size, off]);
    }

    #[test]
    fn a_state_of_the_panda_is_in_its_cell(
        shares in prop::collection::vec(0.0..1.0_f64, 7), place in 0.0..1.0_f64,
        size in prop::sample::select(vec![0.0, 1e-3, 0.01, 0.1, 0.5]), off in prop::sample::select(vec![0.0, 1e-3, 0.02, 0.2]),
    ) {
        a_state_is_in_its_cell("panda", [0.0; 3], &shares, [place, 0.3, 0.9], [size, off]);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    #[test]
    fn no_state_that_is_drawn_is_free_where_none_is_said_to_be(
        size in [0.15..0.6_f64, 0.12..0.5_f64, 0.2..0.8_f64], up in 0.05..1.1_f64, place in [0.0..1.0_f64, 0.0..1.0_f64],
        draws in prop::collection::vec([0.0..1.0_f64, 0.0..1.0_f64, 0.0..1.0_f64, 0.0..1.0_f64], 60),
        name in prop::sample::select(vec!["hsr", "anymal_z1", "panda"]),
    ) {
        // The Panda stands still on its bench.
        let at = if name == "panda" { [0.3, 0.6 + 0.5 * up] } else { [1.5, up] };
        covered(name, &niche(size, at, place), 20_000, &draws);
    }
}

#[test]
fn what_no_arm_gets_into_is_covered_and_what_one_does_is_not() {
    let draws: Vec<[f64; 4]> = (0..200)
        .map(|at| {
            [1, 2, 3, 4].map(|n| {
                crate::planning::search::arm_candidates::part(
                    at,
                    n,
                    crate::planning::search::arm_candidates::SPACE,
                )
            })
        })
        .collect();
    // Low and deep: the hand has room, and what carries it has none.
    let deep = niche([0.6, 0.4, 1.8], [1.5, 0.3], [1.0, 0.5]);
    assert_eq!(covered("hsr", &deep, 200_000, &draws), Some(true));
    assert_eq!(covered("hsr", &deep, 20, &draws), None);
    let open = niche([1.2, 0.8, 0.4], [1.5, 0.5], [0.0, 0.5]);
    assert_eq!(covered("hsr", &open, 200_000, &draws), Some(false));
}

#[test]
fn what_a_panda_does_not_get_to_is_covered_and_what_it_does_is_not() {
    let draws: Vec<[f64; 4]> = (0..200)
        .map(|at| {
            [1, 2, 3, 4].map(|n| {
                crate::planning::search::arm_candidates::part(
                    at,
                    n,
                    crate::planning::search::arm_candidates::SPACE,
                )
            })
        })
        .collect();
    let far = niche([0.9, 0.7, 0.4], [0.9, 0.8], [1.0, 0.5]);
    assert_eq!(covered("panda", &far, 100_000, &draws), Some(true));
    let near = niche([0.9, 0.7, 0.4], [0.3, 0.8], [0.2, 0.5]);
    assert_eq!(covered("panda", &near, 100_000, &draws), Some(false));
}

/// What closes a cell does so however much less all goes in it, what is said to be nearest to that is, and nothing goes farther by one
/// parameter than by all.
fn what_is_nearest_to_closing_a_cell_is_told(name: &str, scene: &Scene, places: [f64; 3], size: f64) -> bool {
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
    for split_cause in limits.chain(pairs.map(SplitCause::BodyPair)) {
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
        SplitCause::BodyPair(pair) => cover.off_by(&mut placing, pair),
    };
    assert!(
        split_gain.cell.iter().all(|off| *off <= all + 1e-9) && split_gain.patch <= all + 1e-9,
        "{name}: {split_gain:?} {all}"
    );
    true
}

#[test]
fn what_keeps_a_cell_open_is_told() {
    let scene = niche([0.6, 0.4, 0.8], [0.7, 0.4], [0.2, 0.5]);
    let mut told = 0;
    for name in ["hsr", "anymal_z1", "panda"] {
        for at in 0..60 {
            let places = [1, 2, 3].map(|n| {
                crate::planning::search::arm_candidates::part(
                    at,
                    n,
                    crate::planning::search::arm_candidates::SPACE,
                )
            });
            let size = [0.2, 0.05, 0.01][at % 3];
            told += u32::from(what_is_nearest_to_closing_a_cell_is_told(name, &scene, places, size));
        }
    }
    assert!(told > 20, "{told}");
}

//! Inverse kinematics: what is found is where it was asked for and within limits, and what is there is found.

use std::f64::consts::PI;

use motet_geometry::inverse::batch::BatchSolver;
use motet_geometry::inverse::{LiftArm, ParallelArm, SevenArm, Tolerance, numeric};
use motet_geometry::kinematics::{Dof, KinematicChain, KinematicTree, planar};
use motet_robots::urdf;
use motet_syntax::{FileId, Source};
use proptest::prelude::*;

fn read(text: &str) -> KinematicTree {
    let (urdf, found) = urdf::read(&Source::new("robot.urdf", text), FileId(0));
    assert_eq!(found, []);
    KinematicTree::new(&urdf.unwrap())
}

fn chain(robot: &str, base: &str, tip: &str) -> KinematicChain {
    let text =
        std::fs::read_to_string(format!("{}/../models/{robot}/robot.urdf", env!("CARGO_MANIFEST_DIR")));
    let tree = read(&text.unwrap());
    KinematicChain::new(&tree, tree.link(base).unwrap(), tree.link(tip).unwrap()).unwrap()
}

fn hsr() -> KinematicChain {
    chain("hsr", "base_footprint", "hand_palm_link")
}

fn z1() -> KinematicChain {
    chain("anymal_z1", "link00", "hand_tip")
}

fn panda() -> KinematicChain {
    chain("panda", "panda_link0", "panda_hand_tcp")
}

/// An arm in the proportions of the UR family: axes 2 to 4 parallel and offset along themselves, limits of
/// two turns.
fn ur() -> KinematicChain {
    let link = |n: usize| format!("<link name='l{n}'/>");
    let joint = |n: usize, xyz: &str, axis: &str| {
        format!(
            "<joint name='j{n}' type='revolute'><parent link='l{}'/><child link='l{n}'/><origin xyz='{xyz}'/>
             <axis xyz='{axis}'/><limit lower='-6.2831853' upper='6.2831853' velocity='1' \
                 effort='1'/></joint>",
            n - 1
        )
    };
    let joints = [
        joint(1, "0 0 0.16", "0 0 1"),
        joint(2, "0 0.14 0", "0 1 0"),
        joint(3, "0.43 -0.12 0", "0 1 0"),
        joint(4, "0.39 0 0", "0 1 0"),
        joint(5, "0 0.11 0", "0 0 -1"),
        joint(6, "0 0 -0.1", "0 1 0"),
    ];
    let text = format!("<robot>{}{}</robot>", (0..7).map(link).collect::<String>(), joints.concat());
    let tree = read(&text);
    KinematicChain::new(&tree, 0, 6).unwrap()
}

/// Values of a chain from numbers in 0..1, one each.
fn spread(chain: &KinematicChain, parts: &[f64]) -> Vec<f64> {
    let limits = chain.dofs.iter().map(|dof| dof.limits.unwrap_or((-PI, PI)));
    limits.zip(parts).map(|((lower, upper), part)| lower + part * (upper - lower)).collect()
}

#[test]
fn closed_forms_are_detected_by_the_axes() {
    assert!(LiftArm::detect(&hsr()).is_some() && ParallelArm::detect(&hsr()).is_none());
    assert!(ParallelArm::detect(&z1()).is_some() && LiftArm::detect(&z1()).is_none());
    assert!(ParallelArm::detect(&ur()).is_some());
    assert!(ParallelArm::detect(&panda()).is_none() && LiftArm::detect(&panda()).is_none());
    assert!(SevenArm::detect(&panda()).is_some() && SevenArm::detect(&z1()).is_none());
}

/// Each solution is within the limits and at the pose, and one is `values`, up to full turns.
fn contains(arm: &ParallelArm, values: &[f64]) -> Result<(), TestCaseError> {
    let wanted = arm.chain().base_from_tip(values);
    let found = arm.solve(&wanted);
    for solution in &found {
        prop_assert!(arm.chain().allows(solution));
        prop_assert!(Tolerance::EXACT.covers(&arm.chain().base_from_tip(solution), &wanted));
    }
    let off = |angle: f64| (angle - 2.0 * PI * (angle / (2.0 * PI)).round()).abs();
    let nearest =
        found.iter().map(|solution| solution.iter().zip(values).map(|(a, b)| off(a - b)).fold(0.0, f64::max));
    let nearest = nearest.fold(f64::INFINITY, f64::min);
    prop_assert!(nearest < 1e-5, "{nearest} from {values:?} in {} solutions", found.len());
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn seven_arm_solves_poses_of_the_panda(parts in prop::array::uniform7(0.0..=1.0_f64)) {
        let arm = SevenArm::detect(&panda()).unwrap();
        let values = spread(arm.chain(), &parts);
        let wanted = arm.chain().base_from_tip(&values);
        let found = arm.solve(&wanted, values[6]);
        for solution in &found {
            prop_assert!(arm.chain().allows(solution));
            prop_assert!(Tolerance::EXACT.covers(&arm.chain().base_from_tip(solution), &wanted));
        }
        let far = |solution: &[f64; 7]| solution.iter().zip(&values).map(|(a, b)| (a - b).abs()).fold(0.0,
            f64::max);
        let nearest = found.iter().map(far).fold(f64::INFINITY, f64::min);
        prop_assert!(nearest < 1e-4, "{nearest} from {values:?} in {} solutions", found.len());
    }

    #[test]
    fn lift_arm_solves_poses_of_the_hsr(
        parts in prop::array::uniform5(0.0..=1.0_f64), x in -3.0..3.0_f64, y in -3.0..3.0_f64, yaw in -PI..PI,
    ) {
        let arm = LiftArm::detect(&hsr()).unwrap();
        let values = spread(arm.chain(), &parts);
        let wanted = planar(x, y, yaw) * arm.chain().base_from_tip(&values);
        let found = arm.solve(&wanted, yaw, values[1]);
        for placed in &found {
            prop_assert!(arm.chain().allows(&placed.values));
            prop_assert!(Tolerance::EXACT.covers(&arm.map_from_tip(placed), &wanted));
        }
        // Where the wrist is stretched only the sum of its outer angles counts.
        prop_assume!(values[3].sin().abs() > 1e-3);
        let near = |a: f64, b: f64| (a - b).abs() < 1e-6;
        prop_assert!(found.iter().any(|placed| {
            near(placed.base[0], x) && near(placed.base[1], y) && near(placed.base[2], yaw)
                && placed.values.iter().zip(&values).all(|(a, b)| near(*a, *b))
        }), "{values:?} is not among {found:?}");
    }

    #[test]
    fn parallel_arm_finds_all_solutions_of_the_z1(parts in prop::array::uniform6(0.0..=1.0_f64)) {
        let arm = ParallelArm::detect(&z1()).unwrap();
        let values = spread(arm.chain(), &parts);
        // At the singularity, where the last axis is parallel to the inner three, a family is stood for by
        // one.
        prop_assume!((PI / 2.0 - values[4].abs()).abs() > 1e-3);
        contains(&arm, &values)?;
    }

    #[test]
    fn parallel_arm_finds_all_solutions_of_a_ur(parts in prop::array::uniform6(0.0..=1.0_f64)) {
        let arm = ParallelArm::detect(&ur()).unwrap();
        let values = spread(arm.chain(), &parts);
        prop_assume!(values[4].sin().abs() > 1e-3);
        contains(&arm, &values)?;
    }
}

/// With room for many turns a joint has one value for each place, the nearest to what it is near to, and
/// within its limits.
#[test]
fn parallel_arm_solutions_are_nearest_among_full_turns() {
    let mut chain = ur();
    for dof in &mut chain.dofs {
        dof.limits = Some((-40.0, 60.0));
    }
    let arm = ParallelArm::detect(&chain).unwrap();
    let values = [0.3, -1.1, 1.4, 0.2, -0.9, 2.0];
    let pose = chain.base_from_tip(&values);
    let found = arm.solve(&pose);
    assert!(found.len() <= 8);
    assert!(found.iter().flatten().all(|value| value.abs() <= PI + 1e-9));
    let turned = values.map(|value| value + 4.0 * PI);
    let near = arm.nearest(&pose, &turned).unwrap();
    assert!(near.iter().zip(turned).all(|(one, other)| (one - other).abs() < 1e-6));
    // Beyond the limits the last turn within them.
    let beyond = arm.nearest(&pose, &values.map(|value| value + 40.0 * PI)).unwrap();
    assert!(beyond.iter().all(|value| (60.0 - 2.0 * PI..=60.0).contains(value)));
}

/// Limits count unless both ends are as good as none.
#[test]
fn dof_keeps_limits_on_one_side() {
    let limits = |limit: &str| {
        let joint = format!(
            "<joint name='j' type='revolute'><parent link='a'/><child link='b'/><axis xyz='0 0 1'/>
             <limit {limit} velocity='1' effort='1'/></joint>"
        );
        read(&format!("<robot name='r'><link name='a'/><link name='b'/>{joint}</robot>")).dofs()[0].clone()
    };
    assert_eq!(limits("lower='0' upper='1e16'").limits, Some((0.0, 1e16)));
    assert_eq!(limits("lower='0' upper='1e16'").sampling_range(), (0.0, 2.0 * PI));
    let none = limits("lower='-1e16' upper='1e16'");
    assert_eq!((none.limits, none.is_continuous), (None, true));
}

/// The heights of a wrist are the same some turns further.
#[test]
fn lift_arm_heights_are_independent_of_full_turns() {
    let chain = hsr();
    let mut turned = chain.clone();
    let far = 8.0 * PI;
    turned.dofs[1].limits = chain.dofs[1].limits.map(|(lower, upper)| (lower + far, upper + far));
    let [one, other] = [chain, turned].map(|chain| LiftArm::detect(&chain).unwrap().heights());
    assert!(one.iter().zip(other).all(|(a, b)| (a - b).abs() < 1e-9), "{one:?} and {other:?}");
}

#[test]
fn dof_sampling_range_is_at_most_one_turn() {
    let limited = |limits: Option<(f64, f64)>, slides: bool| {
        let is_continuous = limits.is_none() && !slides;
        Dof { name: "it".into(), limits, is_continuous, is_prismatic: slides, speed: None }.sampling_range()
    };
    assert_eq!(limited(None, false), (-PI, PI));
    assert_eq!(limited(None, true), (-1.0, 1.0));
    assert_eq!(limited(Some((-2.0, 1.0)), false), (-2.0, 1.0));
    assert_eq!(limited(Some((-50.0, 50.0)), false), (-PI, PI));
    assert_eq!(limited(Some((1.0, 50.0)), false), (1.0, 1.0 + 2.0 * PI));
    assert_eq!(limited(Some((-50.0, 1.0)), false), (1.0 - 2.0 * PI, 1.0));
    assert_eq!(limited(Some((0.0, 30.0)), true), (0.0, 30.0));
}

/// Every solution found is right, and nearly all are found: the numeric search may miss one at the edge of
/// the limits.
#[test]
fn numeric_solver_solves_any_arm() {
    let chain = panda();
    let middle = spread(&chain, &[0.5; 7]);
    let poses = 300;
    let mut solved = 0;
    // The search starts from the first of these values itself.
    for index in 1000..1000 + poses {
        let wanted = chain.base_from_tip(&motet_geometry::kinematics::quasi_random(&chain.dofs, index));
        let Some(found) = numeric::solve(&chain, &wanted, &middle, numeric::NumericSettings::default())
        else {
            continue;
        };
        assert!(chain.allows(&found));
        assert!(Tolerance::EXACT.covers(&chain.base_from_tip(&found), &wanted));
        solved += 1;
    }
    assert!(solved * 100 >= poses * 98, "{solved} of {poses}");
}

#[test]
fn numeric_solver_finds_nothing_out_of_reach() {
    let chain = panda();
    let far = nalgebra::Isometry3::translation(3.0, 0.0, 0.0);
    assert_eq!(
        numeric::solve(&chain, &far, &[0.0; 7], numeric::NumericSettings { starts: 5, ..Default::default() }),
        None
    );
    assert!(ParallelArm::detect(&z1()).unwrap().solve(&far).is_empty());
    let high = nalgebra::Isometry3::translation(0.0, 0.0, 3.0);
    assert!(LiftArm::detect(&hsr()).unwrap().solve(&high, 0.0, -1.0).is_empty());
}

/// Every candidate of the fast path is a solution of the exact one, to what `f32` can tell, and the other
/// way round.
#[test]
fn batch_solver_agrees_with_the_exact_one() {
    let arm = LiftArm::detect(&hsr()).unwrap();
    let manifold = BatchSolver::new(&arm);
    let origin = [1.5, -0.5];
    let poses: Vec<_> = (0..8)
        .map(|at| {
            let values = [0.35, -1.2, 0.4 - 0.1 * f64::from(at), -0.9, 0.3 + 0.2 * f64::from(at)];
            (planar(2.0, -1.0, 0.7) * arm.chain().base_from_tip(&values), 0.1 * f64::from(at))
        })
        .collect();
    let ready = manifold.poses(&poses, origin);
    let (mut fast, mut exact, mut same) = (0, 0, 0);
    for step in 0..64 {
        let (further, shoulder) = (0.1 * f64::from(step) - 3.2, -2.6 + 0.04 * f64::from(step));
        let block = manifold.block(&ready, further, shoulder);
        let of = |lanes: wide::f32x8, lane: usize| f64::from(lanes.to_array()[lane]);
        for (lane, ((wanted, from), yaw)) in poses.iter().zip(block.yaws).enumerate() {
            let off = (yaw - from - further) / std::f64::consts::TAU;
            assert!((off - off.round()).abs() < 1e-9);
            let solutions = arm.solve(wanted, yaw, shoulder);
            exact += solutions.len();
            for branch in block.branches.iter().filter(|branch| branch.allowed >> lane & 1 == 1) {
                fast += 1;
                let near = |a: f64, b: f64| (a - b).abs() < 5e-6;
                let found = solutions.iter().any(|placed| {
                    near(placed.base[0], origin[0] + of(block.base[0], lane))
                        && near(placed.base[1], origin[1] + of(block.base[1], lane))
                        && near(placed.values[0], of(block.lift, lane))
                        && (0..3).all(|at| near(placed.values[at + 2], of(branch.values[at], lane)))
                });
                same += usize::from(found);
            }
        }
    }
    assert!(fast > 100, "{fast} candidates");
    assert_eq!((fast, exact), (same, same));
}

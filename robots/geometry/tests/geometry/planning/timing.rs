//! Times of a path keep the speeds and accelerations of URDF and card, and are no longer than needed.

use super::{model, motion_query};
use motet_geometry::planning::{
    Configuration, MotionAnswer, MotionLimits, PathTime, QueryContext, RobotModel, SceneState, SearchBudget,
    SpeedShare,
};
use motet_robots::builtin::{self, RobotWithBody};
use motet_robots::urdf::Urdf;

/// Greatest shares of speed and of acceleration that an edge uses, by an own computation from the URDF's
/// joints. A motion from rest to rest with even ramps over `far` has the speed `far / (span - ramp)`.
fn shares(model: &RobotModel, urdf: &Urdf, edge: [&Configuration; 2], times: [PathTime; 2]) -> [f64; 2] {
    let (span, ramp) = (times[1].at - times[0].at, times[1].ramp);
    assert!(ramp > 0.0 && ramp <= span / 2.0 + 1e-12, "{times:?}");
    let base = &model.card().base;
    let [from, to] = edge;
    let mut far = vec![
        (
            (to.base[0] - from.base[0]).hypot(to.base[1] - from.base[1]),
            base.speed_m_per_s,
            base.speed_m_per_s,
        ),
        ((to.base[2] - from.base[2]).abs(), base.turn_rad_per_s, base.turn_rad_per_s),
    ];
    let given = &model.card().model.as_ref().unwrap().accelerations;
    for joint in &urdf.joints {
        let (mut factor, mut own) = (1.0, joint);
        while let Some(mimic) = own.mimic {
            factor *= mimic.multiplier;
            own = &urdf.joints[mimic.joint];
        }
        let Ok(dof) = model.tree().dof(&own.name) else { continue };
        let moved = (to.joints[dof] - from.joints[dof]).abs();
        if let Some(speed) = joint.velocity {
            let acceleration = given.get(&joint.name).copied().unwrap_or(2.0 * speed);
            far.push((moved * factor.abs(), speed, acceleration));
        }
    }
    let peak = far.iter().map(|(far, speed, _)| far / (span - ramp) / speed).fold(0.0, f64::max);
    let strongest = far.iter().map(|(far, _, most)| far / (ramp * (span - ramp)) / most).fold(0.0, f64::max);
    [peak, strongest]
}

#[test]
fn timing_keeps_the_limits_and_uses_them() {
    for (robot, room) in [("hsr", "kitchen"), ("anymal_z1", "lab")] {
        let (model, urdf) = model(robot);
        let scene = builtin::scene(room).unwrap();
        let state = SceneState::new(&model, &scene);
        let room = QueryContext::new(&model, &scene, &state);
        let mut edges = 0;
        for id in scene.entities.keys() {
            for query in [format!("go_to({id})"), format!("reach({id})")] {
                let MotionAnswer::Feasible(found) =
                    room.answer(&motion_query(&query), SearchBudget::default())
                else {
                    continue;
                };
                for share in [SpeedShare::FULL, SpeedShare { speed: 0.3, acceleration: 0.25 }] {
                    let times = MotionLimits::of(&model).times(&found.path, share);
                    assert_eq!(times.len(), found.path.len());
                    assert_eq!(times[0], PathTime::default());
                    for (edge, times) in found.path.windows(2).zip(times.windows(2)) {
                        if edge[0] == edge[1] {
                            assert_eq!(times[0].at, times[1].at);
                            continue;
                        }
                        let used = shares(&model, &urdf, [&edge[0], &edge[1]], [times[0], times[1]]);
                        let [speed, acceleration] = [used[0] / share.speed, used[1] / share.acceleration];
                        let most = speed.max(acceleration);
                        assert!(most <= 1.0 + 1e-9, "{robot} {query}: {speed} {acceleration}");
                        assert!(most > 0.98, "{robot} {query} could be faster: {speed} {acceleration}");
                        edges += 1;
                    }
                }
            }
        }
        assert!(edges > 20, "{robot}: {edges} edges");
    }
}

#[test]
fn timing_with_something_in_the_hand_accelerates_it_gently() {
    let RobotWithBody { robot, urdf } = builtin::robot("anymal_z1").unwrap();
    let model = RobotModel::new(&robot, &urdf);
    let from = Configuration { base: [0.0; 3], joints: model.tree().neutral() };
    let mut to = from.clone();
    to.joints[model.tree().dof("joint1").unwrap()] += 1.0;
    let limits = MotionLimits::of(&model);
    let path = [from, to];
    let last = |load| *limits.times_with_load(&path, SpeedShare::FULL, load).last().unwrap();
    let (fast, gentle) = (last(None), last(Some(&model)));
    assert_eq!(fast, *limits.times(&path, SpeedShare::FULL).last().unwrap());
    // The hand turns by 1 rad with the shoulder, and accelerates with 3 rad/s².
    let turns = |time: PathTime| 1.0 / ((time.at - time.ramp) * time.ramp);
    assert!(turns(fast) > 3.5, "{fast:?}: {}", turns(fast));
    assert!((2.9..3.001).contains(&turns(gentle)), "{gentle:?}: {}", turns(gentle));
}

#[test]
fn timing_takes_the_accelerations_of_the_card() {
    let RobotWithBody { mut robot, urdf } = builtin::robot("hsr").unwrap();
    let path = |model: &RobotModel, joint: &str| {
        let from = Configuration { base: [0.0; 3], joints: model.tree().neutral() };
        let mut to = from.clone();
        to.joints[model.tree().dof(joint).unwrap()] += 0.3;
        [from, to]
    };
    let secs = |model: &RobotModel| {
        let times = MotionLimits::of(model).times(&path(model, "arm_lift_joint"), SpeedShare::FULL);
        times[1].at
    };
    let usual = secs(&RobotModel::new(&robot, &urdf));
    robot.model.as_mut().unwrap().accelerations.insert("arm_lift_joint".into(), 0.01);
    let slow = secs(&RobotModel::new(&robot, &urdf));
    // Half of the way with even acceleration, the other half with even braking.
    assert!((slow - 2.0 * (0.3_f64 / 0.01).sqrt()).abs() < 1e-5, "{slow}");
    assert!(usual < slow);
    // The base is limited by the card's speed, and a metre takes a second more for the ramps.
    let model = RobotModel::new(&robot, &urdf);
    let from = Configuration { base: [0.0; 3], joints: model.tree().neutral() };
    let to = Configuration { base: [0.6, 0.8, 0.0], joints: from.joints.clone() };
    let times = MotionLimits::of(&model).times(&[from, to], SpeedShare::FULL);
    assert!((times[1].at - (1.0 / robot.base.speed_m_per_s + 1.0)).abs() < 1e-5, "{times:?}");
    assert!((times[1].ramp - 1.0).abs() < 1e-5, "{times:?}");
}

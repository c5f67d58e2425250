//! Places by rules: near, beside, away from the rim, lying, at a pose; and poses of the base. A witness
//! satisfies the rules by an outline of its own, and what is proven infeasible has no place on a grid.

use std::sync::OnceLock;

use motet_geometry::planning::{ExactNumber, MapPose, Misfit, PlaceRules};
use motet_robots::scene::EntityShape;
use nalgebra::{Isometry3, Vector3};

use super::*;

/// Points of the rim of a thing from above, every few millimetres.
fn rim(shape: &EntityShape, pose: &Isometry3<f64>) -> Vec<[f64; 2]> {
    let spread = |half: Vector3<f64>| -> Vec<Vector3<f64>> {
        (0..800)
            .map(|step| f64::from(step) / 200.0)
            .map(|part| {
                let along = part.fract() * 2.0 - 1.0;
                match part as u32 {
                    0 => Vector3::new(half.x, along * half.y, 0.0),
                    1 => Vector3::new(-half.x, along * half.y, 0.0),
                    2 => Vector3::new(along * half.x, half.y, 0.0),
                    _ => Vector3::new(along * half.x, -half.y, 0.0),
                }
            })
            .collect()
    };
    let points: Vec<Vector3<f64>> = match shape {
        EntityShape::Box([x, y, _]) => spread(Vector3::new(x / 2.0, y / 2.0, 0.0)),
        EntityShape::Cylinder { radius, height } if (pose.rotation * Vector3::z()).z.abs() < 0.1 => {
            let lies = [Vector3::new(*radius, 0.0, 0.0), Vector3::new(0.0, *radius, 0.0)];
            lies.into_iter()
                .flat_map(|side| [side, -side])
                .flat_map(|side| [0.5, -0.5].map(|end| side + Vector3::new(0.0, 0.0, end * height)))
                .collect()
        }
        EntityShape::Cylinder { radius, .. } | EntityShape::Sphere { radius } => (0..720)
            .map(|step| f64::from(step).to_radians() / 2.0)
            .map(|angle| Vector3::new(radius * angle.cos(), radius * angle.sin(), 0.0))
            .collect(),
        other => panic!("{other:?}"),
    };
    let at = pose.translation.vector;
    points.into_iter().map(|point| at + pose.rotation * point).map(|point| [point.x, point.y]).collect()
}

fn gap(one: &[[f64; 2]], other: &[[f64; 2]]) -> f64 {
    let all = one.iter().flat_map(|a| other.iter().map(move |b| (a[0] - b[0]).hypot(a[1] - b[1])));
    all.fold(f64::INFINITY, f64::min)
}

/// Scene with a mug in the hand.
fn holding(change: impl FnOnce(&mut Scene)) -> Scene {
    changed(|scene| {
        scene.entities["mug_1"].on = None;
        scene.robot.holding = Some(Some("mug_1".into()));
        scene.robot.base = [1.4, 0.4, 0.0];
        change(scene);
    })
}

/// State in which the hand holds the mug as it grasped it on the table.
fn grasped(model: &RobotModel, scene: &Scene) -> SceneState {
    static HOLD: OnceLock<SceneState> = OnceLock::new();
    let hold = HOLD.get_or_init(|| {
        let kitchen = embedded("kitchen");
        let state = SceneState::new(model, &kitchen);
        let context = QueryContext::new(model, &kitchen, &state);
        let reach = context.answer(&motion_query("reach(mug_1, top)"), SearchBudget::default());
        let MotionAnswer::Feasible(witness) = reach else { panic!("{reach:?}") };
        context.after_reach(&witness).unwrap()
    });
    let mut state = SceneState::new(model, scene);
    state.robot.joints.clone_from(&hold.robot.joints);
    state.held.clone_from(&hold.held);
    state
}

struct Put<'s> {
    scene: &'s Scene,
    on: &'static str,
    rules: PlaceRules,
}

impl Put<'_> {
    fn answer(&self) -> MotionAnswer {
        let (model, urdf) = model("hsr");
        let state = grasped(&model, self.scene);
        let context = QueryContext::new(&model, self.scene, &state);
        let query = MotionQuery::Put("mug_1".into(), self.on.into(), self.rules.clone());
        let answer = context.answer(&query, SearchBudget::default());
        if let MotionAnswer::Feasible(witness) = &answer {
            let faults = verify::faults(&model, &urdf, self.scene, &state, witness, Some(self.on));
            assert!(faults.is_empty(), "{query}: {:?}", &faults[..faults.len().min(5)]);
            self.check(witness);
        }
        answer
    }

    /// Checks the place of a witness against the rules.
    fn check(&self, witness: &motet_geometry::planning::MotionWitness) {
        let grasp = witness.grasp.as_ref().unwrap();
        let place = grasp.map_from_tip * grasp.tip_from_object;
        self.check_place(&place).unwrap_or_else(|why| panic!("{}: {why}, {place}", self.rules));
    }

    fn check_place(&self, place: &Isometry3<f64>) -> Result<(), String> {
        let (model, _) = model("hsr");
        let state = SceneState::new(&model, self.scene);
        let entities = &self.scene.entities;
        let rim_of =
            |id: &str| rim(entities[id].shape.as_ref().unwrap(), &state.pose(&entities[id]).unwrap());
        let own = rim(entities["mug_1"].shape.as_ref().unwrap(), place);
        // The rims are sampled, so that their gap is a little larger than the real one.
        let (off, rules) = (0.003, &self.rules);
        let within = |what: &str, value: f64, least: f64, most: f64| {
            let fits = (least - 1e-6..=most + off).contains(&value);
            if fits { Ok(()) } else { Err(format!("{what} {value}")) }
        };
        if let Some(near) = &rules.near {
            within("near", gap(&own, &rim_of(near)), 0.0, 0.3)?;
        }
        if let Some(beside) = &rules.beside {
            within("beside", gap(&own, &rim_of(beside)), 0.02, 0.15)?;
        }
        if rules.from_edge.get() > 0.0 {
            within("from the edge", gap(&own, &rim_of(self.on)), rules.from_edge.get(), f64::INFINITY)?;
        }
        let tilt = (place.rotation * Vector3::z()).z;
        if !rules.may_lie && tilt < 1.0 - 1e-9 {
            return Err(format!("not upright: {tilt}"));
        }
        if let Some(at) = &rules.at {
            let [x, y, _] = at.xyz();
            within("off the pose by", (place.translation.x - x).hypot(place.translation.y - y), 0.0, 1e-9)?;
        }
        Ok(())
    }

    fn feasible(self) {
        let answer = self.answer();
        assert!(matches!(answer, MotionAnswer::Feasible(_)), "{}: {answer:?}", self.rules);
    }

    fn infeasible(self, says: &str) {
        let (why, certified) = reason(self.answer());
        assert_eq!((why.to_string().as_str(), certified), (says, true));
    }
}

fn rules(change: impl FnOnce(&mut PlaceRules)) -> PlaceRules {
    let mut rules = PlaceRules::default();
    change(&mut rules);
    rules
}

#[test]
fn put_keeps_to_its_rules() {
    let (scene, on) = (holding(|_| {}), "kitchen_table");
    for id in ["apple", "glass_1", "plate"] {
        Put { scene: &scene, on, rules: rules(|it| it.near = Some(id.into())) }.feasible();
        Put { scene: &scene, on, rules: rules(|it| it.beside = Some(id.into())) }.feasible();
    }
    for far in [0.05, 0.1] {
        Put { scene: &scene, on, rules: rules(|it| it.from_edge = ExactNumber::new(far)) }.feasible();
    }
    let both = rules(|it| {
        it.beside = Some("apple".into());
        it.near = Some("glass_1".into());
        it.from_edge = ExactNumber::new(0.1);
    });
    Put { scene: &scene, on, rules: both }.feasible();
    let tall = holding(|scene| {
        let mug = scene.entities.get_mut("mug_1").unwrap();
        mug.shape = Some(EntityShape::Cylinder { radius: 0.03, height: 0.12 });
    });
    for scene in [&scene, &tall] {
        Put { scene, on, rules: rules(|it| it.may_lie = true) }.feasible();
    }
    for (x, y, yaw) in [(1.95, 0.5, 0.0), (2.0, 0.3, 1.0), (1.9, 0.6, -2.0)] {
        let at = Some(MapPose::new([x, y, 0.0], yaw));
        Put { scene: &scene, on, rules: rules(|it| it.at = at) }.feasible();
        let at = Some(MapPose::new([x, y, 0.77], yaw));
        Put { scene: &scene, on, rules: rules(|it| it.at = at) }.feasible();
    }
}

#[test]
fn put_without_a_place_says_what_matters() {
    let (scene, on) = (holding(|_| {}), "kitchen_table");
    let ask = |rules: PlaceRules, says: &str| Put { scene: &scene, on, rules }.infeasible(says);
    ask(rules(|it| it.beside = Some("coke".into())), "`coke` is not on `kitchen_table`");
    ask(
        rules(|it| it.from_edge = ExactNumber::new(0.5)),
        "needs 0.50 m to the rim of `kitchen_table`, there are at most 0.36 m",
    );
    ask(
        rules(|it| it.near = Some("bottle".into())),
        "nothing of `kitchen_table` within 0.30 m of `bottle` is free",
    );
    let at = |x: f64, y: f64, z: f64| rules(|it| it.at = Some(MapPose::new([x, y, z], 0.0)));
    ask(at(1.79, 0.5, 0.0), "at the pose it reaches 0.05 m beyond the rim of `kitchen_table`");
    ask(at(2.0, 0.5, 0.3), "the pose is 0.30 m high, on `kitchen_table` its middle is 0.77 m high");
    ask(at(1.96, 0.75, 0.0), "the pose on `kitchen_table` is not free: `apple` is there");
    // All around the apple something stands.
    let crowded = holding(|scene| {
        let wall = scene.entities["glass_1"].clone();
        for step in 0..24 {
            let (sin, cos) = (f64::from(step) * std::f64::consts::TAU / 24.0).sin_cos();
            let mut one = wall.clone();
            one.id = format!("glass_{}", step + 2).into();
            one.shape = Some(EntityShape::Cylinder { radius: 0.05, height: 0.12 });
            one.pose.as_mut().unwrap().xyz = [1.96 + 0.16 * cos, 0.75 + 0.16 * sin, 0.78];
            scene.entities.insert(one.id.clone(), one);
        }
    });
    let asks = rules(|it| it.beside = Some("apple".into()));
    let (why, certified) = reason(Put { scene: &crowded, on, rules: asks }.answer());
    assert!(
        matches!(why, InfeasibleReason::NoPlace(Misfit::Taken { by: Some(_), .. })) && certified,
        "{why}"
    );
}

/// Only a person's outline matters, and what is unknown stays so.
#[test]
fn put_near_what_is_no_thing() {
    let scene = holding(|scene| {
        scene.entities["user"].pose.as_mut().unwrap().xyz = [2.2, 1.45, 0.0];
        scene.entities["plate"].pose = None;
    });
    let on = "kitchen_table";
    Put { scene: &scene, on, rules: rules(|it| it.near = Some("user".into())) }.feasible();
    for id in ["plate", "mug_1", "nothing"] {
        let answer = Put { scene: &scene, on, rules: rules(|it| it.near = Some(id.into())) }.answer();
        assert!(matches!(answer, MotionAnswer::Unknown(UnknownReason::Because(_))), "{id}: {answer:?}");
    }
}

#[test]
fn stand_at_a_pose() {
    let ((model, urdf), scene) = (model("hsr"), embedded("kitchen"));
    let state = SceneState::new(&model, &scene);
    let context = QueryContext::new(&model, &scene, &state);
    let ask = |x: f64, y: f64, yaw: f64| {
        let query = MotionQuery::StandAt(MapPose::new([x, y, 0.0], yaw));
        context.answer(&query, SearchBudget::default())
    };
    for (x, y, yaw) in [(0.5, 0.5, 0.0), (-1.0, 0.3, 2.0), (1.4, 0.4, -1.5), (0.0, 0.0, 3.0)] {
        let MotionAnswer::Feasible(witness) = ask(x, y, yaw) else { panic!("{x} {y} {yaw}") };
        let faults = verify::faults(&model, &urdf, &scene, &state, &witness, None);
        assert!(faults.is_empty(), "{x} {y} {yaw}: {:?}", &faults[..faults.len().min(5)]);
        let [to_x, to_y, to_yaw] = context.after_move(&witness).robot.base;
        let turned = (to_yaw - yaw + std::f64::consts::PI).rem_euclid(std::f64::consts::TAU);
        assert!((to_x - x).hypot(to_y - y) < 1e-9 && (turned - std::f64::consts::PI).abs() < 1e-9);
    }
    let (why, certified) = reason(ask(2.2, 0.5, 0.0));
    assert!(
        matches!(why, InfeasibleReason::NoFreePose { by: Some(by), .. } if by == "kitchen_table")
            && certified
    );
    let panda = self::model("panda").0;
    let (scene, pose) = (embedded("kitchen"), MapPose::new([0.5, 0.0, 0.0], 0.0));
    let state = SceneState::new(&panda, &scene);
    let fixed = QueryContext::new(&panda, &scene, &state)
        .answer(&MotionQuery::StandAt(pose), SearchBudget::default());
    assert!(matches!(fixed, MotionAnswer::Unknown(_)), "{fixed:?}");
}

/// Size and turn of a table, the things on it, the rules that apply, and a distance from the rim.
type RandomTable = ([f64; 2], f64, Vec<(f64, f64, f64, bool)>, [bool; 2], f64);

/// A table with things on it and rules about one of them.
fn tables() -> impl Strategy<Value = RandomTable> {
    let thing = (-0.5..0.5_f64, -0.5..0.5_f64, 0.02..0.16_f64, any::<bool>());
    (
        [0.25..0.8_f64, 0.25..1.2_f64],
        -3.0..3.0_f64,
        prop::collection::vec(thing, 1..14),
        [any::<bool>(), any::<bool>()],
        prop_oneof![Just(0.0), 0.0..0.35_f64],
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// Random tables: a place that is found fits the rules, and where none is proven a grid finds none.
    #[test]
    fn put_by_rules_is_sound((size, yaw, things, asks, from_edge) in tables()) {
        let kitchen = embedded("kitchen");
        let scene = holding(|scene| {
            scene.entities.retain(|id, _| id == "mug_1" || id == "kitchen_table");
            let table = scene.entities.get_mut("kitchen_table").unwrap();
            table.pose = Some(Placement { xyz: [2.0, 0.4, 0.36], rpy: [0.0, 0.0, yaw] });
            table.shape = Some(EntityShape::Box([size[0], size[1], 0.72]));
            for ((x, y, radius, is_box), at) in things.iter().zip(0..) {
                let mut thing = kitchen.entities["glass_1"].clone();
                thing.id = format!("thing_{at}").into();
                let (sin, cos) = yaw.sin_cos();
                let [u, v] = [x * (size[0] - 0.05), y * (size[1] - 0.05)];
                let xyz = [2.0 + cos * u - sin * v, 0.4 + sin * u + cos * v, 0.72 + 0.06];
                thing.pose = Some(Placement { xyz, rpy: [0.0, 0.0, 3.0 * x] });
                thing.shape = Some(if *is_box {
                    EntityShape::Box([2.0 * radius, *radius, 0.12])
                } else {
                    EntityShape::Cylinder { radius: *radius, height: 0.12 }
                });
                scene.entities.insert(thing.id.clone(), thing);
            }
        });
        let asked = rules(|it| {
            it.near = asks[0].then(|| "thing_0".into());
            it.beside = asks[1].then(|| "thing_0".into());
            it.from_edge = ExactNumber::new(from_edge);
        });
        let put = Put { scene: &scene, on: "kitchen_table", rules: asked };
        let answer = put.answer();
        if let MotionAnswer::Infeasible(why) = &answer
            && why.certified
            && matches!(why.reason, InfeasibleReason::NoPlace(_))
        {
            let (model, _) = model("hsr");
            let state = SceneState::new(&model, &scene);
            let context = QueryContext::new(&model, &scene, &state);
            let others: Vec<_> = context.obstacles().filter(|(id, _)| id != "kitchen_table").collect();
            let shape = motet_geometry::collision::Shape::Cylinder { radius: 0.04, half: 0.05 };
            for (u, v) in (0..41).flat_map(|u| (0..41).map(move |v| (u, v))) {
                let share = |step: i32| f64::from(step) / 20.0 - 1.0;
                let half = |size: f64, step: i32| (size / 2.0 - 0.04).max(0.0) * share(step);
                let (u, v) = (half(size[0], u), half(size[1], v));
                let (sin, cos) = yaw.sin_cos();
                let place = Isometry3::translation(2.0 + cos * u - sin * v, 0.4 + sin * u + cos * v, 0.774);
                let stands = motet_geometry::collision::Solid::new(&place, shape);
                let is_free = others.iter().all(|(_, other)| stands.is_farther(other, 0.002));
                prop_assert!(!is_free || put.check_place(&place).is_err(), "{place} fits, but {why:?}");
            }
        }
    }
}

/// Answer to a grasp of the mug at a point from its middle, with the point.
fn at_point(scene: &Scene, off: [f64; 3]) -> (MotionAnswer, Vector3<f64>) {
    let (model, urdf) = model("hsr");
    let state = SceneState::new(&model, scene);
    let context = QueryContext::new(&model, scene, &state);
    let point = Vector3::from(scene.entities["mug_1"].pose.unwrap().xyz) + Vector3::from(off);
    let query = MotionQuery::ReachAt("mug_1".into(), Some(MapPose::new(point.into(), 1.0)));
    let answer = context.answer(&query, SearchBudget::default());
    if let MotionAnswer::Feasible(witness) = &answer {
        let faults = verify::faults(&model, &urdf, scene, &state, witness, None);
        assert!(faults.is_empty(), "{off:?}: {:?}", &faults[..faults.len().min(5)]);
        let (grasp, hand) = (witness.grasp.as_ref().unwrap(), model.hand().unwrap());
        let closes = Vector3::from(hand.card.closes);
        let local = grasp.map_from_tip.inverse() * nalgebra::Point3::from(point);
        assert!(
            local.coords.dot(&closes).abs() < 1e-6,
            "{off:?}: the fingers close beside the point, {local}"
        );
        let held = grasp.tip_from_object.translation.vector;
        assert!(
            held.dot(&closes).abs() < 1e-6,
            "{off:?}: closed fingers have the object in the middle, {held}"
        );
    }
    (answer, point)
}

#[test]
fn reach_at_closes_the_fingers_at_the_point() {
    let scene = embedded("kitchen");
    for off in [[0.0; 3], [0.035, 0.0, 0.03], [0.0, 0.04, 0.0], [-0.03, -0.03, -0.02], [0.0, 0.0, 0.09]] {
        let (answer, _) = at_point(&scene, off);
        assert!(matches!(answer, MotionAnswer::Feasible(_)), "{off:?}: {answer:?}");
    }
    for (off, far) in [([0.0, 0.0, -0.77], 0.72), ([0.0, 0.14, 0.0], 0.1), ([-2.6, 0.0, -0.77], 2.66)] {
        let (why, certified) = reason(at_point(&scene, off).0);
        let InfeasibleReason::Beside { needs, limit: 0.05 } = why else { panic!("{why:?}") };
        assert!((needs - far).abs() < 0.01 && certified, "{off:?}: {needs}");
    }
    // What does not depend on the point is known without it.
    let unknown = MotionQuery::ReachAt("mug_1".into(), None);
    let answer = |scene: &Scene| {
        let model = model("hsr").0;
        let state = SceneState::new(&model, scene);
        QueryContext::new(&model, scene, &state).answer(&unknown, SearchBudget::default())
    };
    assert!(matches!(answer(&scene), MotionAnswer::Unknown(_)));
    let heavy = changed(|scene| scene.entities["mug_1"].mass_kg = Some(2.0));
    assert!(matches!(reason(answer(&heavy)), (InfeasibleReason::TooHeavy { .. }, true)));
}

#[test]
fn reach_at_takes_a_long_thing_at_the_end_that_is_asked_for() {
    let scene = changed(|scene| {
        scene.entities.retain(|id, entity| entity.kind != "Object" || id == "mug_1");
        let mug = &mut scene.entities["mug_1"];
        mug.shape = Some(EntityShape::Box([0.04, 0.4, 0.08]));
        mug.pose.as_mut().unwrap().xyz = [1.9, 0.4, 0.76];
    });
    for off in [-0.18, 0.0, 0.1] {
        let (answer, point) = at_point(&scene, [0.0, off, 0.0]);
        let MotionAnswer::Feasible(witness) = answer else { panic!("{off}: {answer:?}") };
        let tip = witness.grasp.as_ref().unwrap().map_from_tip.translation.vector;
        assert!((tip.y - point.y).abs() < 0.02, "{off}: {tip} for {point}");
    }
}

#[test]
fn reach_at_moves_the_object_against_nothing() {
    let beside_rail = |has_rail: bool| {
        changed(|scene| {
            scene.entities.retain(|id, entity| entity.kind != "Object" || id == "mug_1");
            let mug = &mut scene.entities["mug_1"];
            mug.shape = Some(EntityShape::Box([0.2, 0.06, 0.1]));
            mug.pose.as_mut().unwrap().xyz = [1.9, 0.4, 0.77];
            let mut rail = mug.clone();
            rail.id = "rail".into();
            rail.shape = Some(EntityShape::Box([0.2, 0.02, 0.02]));
            rail.pose.as_mut().unwrap().xyz = [1.9, 0.45, 0.73];
            if has_rail {
                scene.entities.insert("rail".into(), rail);
            }
        })
    };
    // Low enough for the fingers, it is 1 cm from the object, which they would move by 3 cm.
    let is_feasible = |has_rail: bool, off: f64| {
        matches!(at_point(&beside_rail(has_rail), [0.0, off, 0.0]).0, MotionAnswer::Feasible(_))
    };
    assert_eq!([-0.03, 0.0, 0.03].map(|off| is_feasible(true, off)), [true, true, false]);
    assert!(is_feasible(false, 0.03));
}

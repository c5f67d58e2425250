//! Motion queries on a thread with a stack of 2 MiB, which is what `std::thread` gives, with nothing
//! optimised.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::disallowed_methods,
    reason = "a test fails by panicking"
)]

use motet_geometry::planning::{
    Configuration, MotionAnswer, MotionQuery, PlaceRules, QueryContext, RobotModel, SceneState, SearchBudget,
};
use motet_robots::builtin::{self, RobotWithBody};
use motet_robots::scene::Scene;

const STACK: usize = 2 * 1024 * 1024;

/// A small budget: the frames are the same, and an unoptimised search takes long.
const BUDGET: SearchBudget = SearchBudget { candidates: 16, paths: 4, cells: 256 };

fn robot(name: &str) -> RobotModel {
    let RobotWithBody { robot, urdf } = builtin::robot(name).unwrap();
    RobotModel::new(&robot, &urdf)
}

fn kitchen() -> Scene {
    builtin::scene("kitchen").unwrap()
}

/// Answers the queries of one robot, from wherever `go_to` leads it, and explains those that are infeasible.
fn answers(name: &str, queries: &[MotionQuery], holding: bool) {
    let (model, scene) = (robot(name), kitchen());
    let mut state = SceneState::new(&model, &scene);
    if holding {
        let mut held = scene.clone();
        held.robot.holding = Some(Some("mug_1".into()));
        state.held = SceneState::new(&model, &held).held;
    }
    for query in queries {
        let context = QueryContext::new(&model, &scene, &state);
        match context.answer(query, BUDGET) {
            MotionAnswer::Feasible(witness) => {
                let start: &Configuration = context.start();
                assert_eq!(witness.path.first(), Some(start), "{name}: {query}");
                drop((context.after_reach(&witness), context.after_put(&witness)));
                drop(context.after_pull(&witness));
            }
            MotionAnswer::Infeasible(why) => drop(context.explain(query, &why, BUDGET)),
            MotionAnswer::Unknown(_) => {}
        }
    }
}

fn on_a_small_stack(name: &'static str) {
    let thread = std::thread::Builder::new().stack_size(STACK).spawn(move || {
        let queries = [
            MotionQuery::GoTo("kitchen_table".into()),
            MotionQuery::Reach("mug_1".into(), None),
            MotionQuery::Pull("drawer_1".into()),
            MotionQuery::Pull("fridge_1".into()),
            MotionQuery::Look("apple".into()),
            MotionQuery::Push("apple".into()),
        ];
        answers(name, &queries, false);
        let put = MotionQuery::Put("mug_1".into(), "kitchen_table".into(), PlaceRules::default());
        answers(name, &[put], true);
    });
    thread.unwrap().join().unwrap();
}

#[test]
fn queries_of_the_hsr_fit_a_small_stack() {
    on_a_small_stack("hsr");
}

#[test]
fn queries_of_the_anymal_fit_a_small_stack() {
    on_a_small_stack("anymal_z1");
}

#[test]
fn queries_of_the_panda_fit_a_small_stack() {
    on_a_small_stack("panda");
}

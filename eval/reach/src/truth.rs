//! The truth of a target, by exhaustive search: grasps at random, states of the whole robot that make
//! them, and a way to one.

use motet_geometry::planning::{Configuration, SceneState};
use motet_robots::scene::Scene;
use nalgebra::Isometry3;
use rand_xoshiro::SplitMix64;
use serde::{Deserialize, Serialize};

use crate::chance::{Chance, seeded};
use crate::grasp;
use crate::model::{Model, Solid};
use crate::plan::{GAP, Search, is_free, scatter, solve};
use crate::scenery::Scenery;

/// Truth of a target, as far as it was found.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Truth {
    /// A grasp, a free state that makes it, and a way there.
    Reachable,
    /// Free states, and no way to any of them.
    NoWay,
    /// No free state that makes any grasp.
    NoState,
}

/// Effort of a search.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Effort {
    /// Grasps drawn.
    pub(crate) grasps: usize,
    /// States tried for all grasps whose hand is free.
    pub(crate) states: usize,
    /// States to which a way is looked for.
    pub(crate) ways: usize,
    /// Extensions of the trees for each.
    pub(crate) steps: usize,
}

impl Effort {
    pub(crate) const FULL: Self = Self { grasps: 3000, states: 6000, ways: 12, steps: 1200 };
    pub(crate) const QUICK: Self = Self { grasps: 600, states: 600, ways: 4, steps: 300 };
}

/// The truth of one target. The same seed gives the same.
#[must_use]
pub fn truth(model: &Model, scene: &Scene, target: &str, seed: u64) -> Truth {
    searched(model, scene, target, seed, Effort::FULL)
}

pub(crate) fn searched(model: &Model, scene: &Scene, target: &str, seed: u64, effort: Effort) -> Truth {
    let world = SceneState::new(&model.machine, scene);
    let found = Target::new(model, scene, &world, target);
    found.map_or(Truth::NoState, |target| target.search(seed, effort))
}

/// Grasps at random in which the hand is free, at most so many.
pub(crate) fn grasps(
    model: &Model,
    scene: &Scene,
    target: &str,
    seed: u64,
    most: usize,
) -> Vec<grasp::Grasp> {
    let world = SceneState::new(&model.machine, scene);
    let target = Target::new(model, scene, &world, target);
    let mut free = target.map_or_else(Vec::new, |it| it.grasps(Effort::QUICK.grasps, &mut seeded(seed)));
    free.truncate(most);
    free
}

struct Target<'a> {
    model: &'a Model,
    scene: &'a Scene,
    scenery: Scenery,
    index: usize,
    pose: Isometry3<f64>,
    /// State of the robot, its hand as it is: it opens on the way.
    start: &'a Configuration,
    /// The same with the hand open.
    open: Configuration,
    members: Vec<(Isometry3<f64>, &'a Solid)>,
    reach: f64,
}

impl<'a> Target<'a> {
    fn new(model: &'a Model, scene: &'a Scene, world: &'a SceneState, target: &str) -> Option<Self> {
        let scenery = Scenery::new(scene, world)?;
        let (index, _, entity) = scene.entities.get_full(target)?;
        let pose = world.pose(entity)?;
        let hand = model.machine.hand()?;
        let start = &world.robot;
        let open = Configuration { base: start.base, joints: hand.opened(&start.joints) };
        let poses = model.links(&open);
        let members = model.parts.iter().filter(|(link, _)| model.in_hand(*link));
        let members = members.map(|(link, part)| (poses[hand.tip].inverse() * poses[*link], part)).collect();
        // No arm is longer than this by far.
        let reach = hand.card.reach_m + 0.6;
        Some(Self { model, scene, scenery, index, pose, start, open, members, reach })
    }

    /// Of so many grasps at random those in which the hand is free.
    fn grasps(&self, draws: usize, chance: &mut SplitMix64) -> Vec<grasp::Grasp> {
        let Some((_, entity)) = self.scene.entities.get_index(self.index) else { return vec![] };
        let machine = &self.model.machine;
        let mut drawn: Vec<_> =
            (0..draws).filter_map(|_| grasp::draw(machine, entity, &self.pose, chance)).collect();
        drawn.retain(|grasp| !self.scenery.hand_touches(&self.members, &grasp.map_from_tip, self.index, GAP));
        drawn
    }

    fn search(&self, seed: u64, effort: Effort) -> Truth {
        let mut chance = seeded(seed);
        let machine = &self.model.machine;
        let free = self.grasps(effort.grasps, &mut chance);
        if free.is_empty() {
            return Truth::NoState;
        }
        let (mut states, mut ways) = (0, 0);
        while states < effort.states {
            states += 1;
            let grasp = &free[chance.below(free.len())];
            let tip = grasp.map_from_tip.translation;
            let from = scatter(self.model, &self.open, [tip.x, tip.y], self.reach, &mut chance);
            let Some(state) = solve(self.model, &grasp.map_from_tip, &from, machine.drives()) else {
                continue;
            };
            if self.scenery.touch(self.model, &state, Some(self.index), GAP).is_some() {
                continue;
            }
            ways += 1;
            if self.is_reached(grasp, &state, effort.steps, &mut chance) {
                return Truth::Reachable;
            }
            if ways >= effort.ways {
                return Truth::NoWay;
            }
        }
        if ways > 0 { Truth::NoWay } else { Truth::NoState }
    }

    /// True if a way leads to a state: to one a little back along the fingers, and from there straight in.
    fn is_reached(
        &self,
        grasp: &grasp::Grasp,
        state: &Configuration,
        steps: usize,
        chance: &mut SplitMix64,
    ) -> bool {
        [0.05, 0.1].into_iter().any(|back| {
            let mut before = grasp.map_from_tip;
            before.translation.vector -= grasp.approach * back;
            let Some(first) = solve(self.model, &before, state, self.model.machine.drives()) else {
                return false;
            };
            let exempt = Some(self.index);
            if !is_free(self.model, &self.scenery, &first, state, 0.004, exempt)
                || self.scenery.touch(self.model, &first, None, GAP).is_some()
            {
                return false;
            }
            let mut first = first;
            let turn = std::f64::consts::TAU;
            first.base[2] -= turn * ((first.base[2] - self.start.base[2]) / turn).round();
            let search = Search { model: self.model, scenery: &self.scenery, steps, apart: 0.015 };
            // The hand opens on the way: where the robot is there may be no room for it.
            search.connects(self.start, &first, chance)
        })
    }
}

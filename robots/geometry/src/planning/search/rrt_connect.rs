//! RRT-Connect (Kuffner and LaValle 2000) for the arm, or for base and arm: two trees of certified edges
//! that grow towards a low-discrepancy sequence, so that the search is deterministic.

use crate::kinematics::{Dof, quasi_random_in};
use crate::planning::checking::CollisionChecker;
use crate::planning::scene::{AllowedCollisions, Configuration};

/// Degrees of freedom of a search.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum PlannedJoints {
    /// The arm, with the base still.
    Arm,
    /// Base and arm.
    All,
}

/// Effort of a search.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum RrtEffort {
    /// Long enough for most searches that succeed.
    Short,
    Long,
}

impl RrtEffort {
    /// Number of samples.
    fn samples(self) -> usize {
        match self {
            Self::Short => 80,
            Self::Long => 400,
        }
    }
}

impl PlannedJoints {
    /// Greatest length of an edge.
    fn step(self) -> f64 {
        match self {
            Self::Arm => 0.7,
            Self::All => 0.4,
        }
    }

    /// Distance of two configurations: for the arm the largest change of a joint, in rad or m; for base and
    /// arm a length in m that weighs a turn or a joint by a third.
    fn far(self, from: &Configuration, to: &Configuration) -> f64 {
        let changes = from.joints.iter().zip(&to.joints).map(|(a, b)| (a - b).abs());
        match self {
            Self::Arm => changes.fold(0.0, f64::max),
            Self::All => {
                let [x, y, yaw] = [0, 1, 2].map(|at: usize| match (from.base.get(at), to.base.get(at)) {
                    (Some(a), Some(b)) => b - a,
                    _ => 0.0,
                });
                let turns = changes.map(|change| change * change).sum::<f64>() + yaw * yaw;
                (x * x + y * y + 0.1 * turns).sqrt()
            }
        }
    }
}

/// Margin of the base samples beside both ends, in m.
const ASIDE: f64 = 0.8;

/// Tree of configurations, each with the index of its parent.
struct RrtTree(Vec<(Configuration, usize)>);

/// Sample sequence between two configurations.
struct SampleSequence<'a> {
    moving: PlannedJoints,
    from: &'a Configuration,
    to: &'a Configuration,
    /// Sampled ranges: of the base where it moves, then of the arm.
    ranges: Vec<(f64, f64)>,
    /// Indices of the arm's joints in a configuration.
    joints: &'a [usize],
}

impl<'a> SampleSequence<'a> {
    fn new(
        moving: PlannedJoints,
        from: &'a Configuration,
        to: &'a Configuration,
        arm: &'a [Dof],
        joints: &'a [usize],
    ) -> Self {
        let between = |one: f64, other: f64, aside: f64| (one.min(other) - aside, one.max(other) + aside);
        let base = from.base.iter().zip(to.base).zip([ASIDE, ASIDE, std::f64::consts::PI]);
        let base = base.map(|((one, other), aside)| between(*one, other, aside));
        let base: Vec<(f64, f64)> = if moving == PlannedJoints::All { base.collect() } else { vec![] };
        let ranges = base.into_iter().chain(arm.iter().map(Dof::sampling_range)).collect();
        Self { moving, from, to, ranges, joints }
    }

    /// Sample of the sequence. Some keep the arm or the goal's arm: in open space the arm need not move.
    fn aim(&self, sample: usize) -> Option<Configuration> {
        let mut aim = self.to.clone();
        let values = quasi_random_in(self.ranges.iter().copied(), sample);
        let (base, arm) = values.split_at(values.len().checked_sub(self.joints.len())?);
        aim.base.iter_mut().zip(base).for_each(|(slot, value)| *slot = *value);
        match (self.moving, sample / 2 % 4) {
            (PlannedJoints::All, 1) => aim.joints.clone_from(&self.from.joints),
            (PlannedJoints::All, 3) => {}
            (PlannedJoints::All | PlannedJoints::Arm, _) => {
                for (at, value) in self.joints.iter().zip(arm) {
                    *aim.joints.get_mut(*at)? = *value;
                }
            }
        }
        Some(aim)
    }
}

impl CollisionChecker<'_, '_> {
    /// Path between two free configurations, both included.
    pub(crate) fn connect(
        &self,
        from: &Configuration,
        to: &Configuration,
        moving: PlannedJoints,
        effort: RrtEffort,
    ) -> Option<Vec<Configuration>> {
        let chain = self.context.model.hand()?.solver.chain();
        let samples = SampleSequence::new(moving, from, to, &chain.dofs, &chain.in_tree);
        let mut trees = [RrtTree(vec![(from.clone(), 0)]), RrtTree(vec![(to.clone(), 0)])];
        for sample in 0..effort.samples() {
            let aim = samples.aim(sample)?;
            let [first, second] = &mut trees;
            let is_turned = sample % 2 == 1;
            let (near, far) = if is_turned { (second, first) } else { (first, second) };
            let Some(new) = self.grow(near, &aim, moving) else { continue };
            while let Some(next) = self.grow(far, &new, moving) {
                if next != new {
                    continue;
                }
                let (near, far) = (near.back(), far.back());
                let (mut path, rest) = if is_turned { (far, near) } else { (near, far) };
                path.reverse();
                path.extend(rest.into_iter().skip(1));
                return Some(self.shortened(path));
            }
        }
        None
    }

    /// Extends a tree by one step towards a sample; the new configuration where its edge is free.
    fn grow(&self, tree: &mut RrtTree, aim: &Configuration, moving: PlannedJoints) -> Option<Configuration> {
        let best = tree.0.iter().map(|(configuration, _)| moving.far(configuration, aim)).enumerate();
        let (at, way) = best.reduce(|best, next| if next.1 < best.1 { next } else { best })?;
        if way == 0.0 {
            return None;
        }
        let near = tree.0.get(at).map(|(configuration, _)| configuration)?;
        let step = moving.step();
        let next = if way <= step { aim.clone() } else { near.towards(aim, step / way) };
        if self.contact(&next, AllowedCollisions::default()).is_some() {
            return None;
        }
        self.between(near, &next, AllowedCollisions::default()).ok()?;
        tree.0.push((next.clone(), at));
        Some(next)
    }

    /// Path with its corners cut.
    fn shortened(&self, path: Vec<Configuration>) -> Vec<Configuration> {
        let mut kept: Vec<Configuration> = Vec::new();
        let mut rest = path.as_slice();
        while let [first, after @ ..] = rest {
            kept.push(first.clone());
            let seen = (1..after.len()).rev().find(|at| {
                after
                    .get(*at)
                    .is_some_and(|next| self.between(first, next, AllowedCollisions::default()).is_ok())
            });
            rest = after.get(seen.unwrap_or(0)..).unwrap_or_default();
        }
        kept
    }
}

impl RrtTree {
    /// Configurations from the last one back to the root.
    fn back(&self) -> Vec<Configuration> {
        let mut configurations = Vec::new();
        let mut at = self.0.len().saturating_sub(1);
        while let Some((configuration, before)) = self.0.get(at) {
            configurations.push(configuration.clone());
            if at == 0 {
                break;
            }
            at = *before;
        }
        configurations
    }
}

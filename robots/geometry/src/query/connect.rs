//! RRT-Connect (Kuffner and LaValle 2000) for the arm with the base still: two trees of certified edges towards samples of a
//! low-discrepancy sequence, so that the same question has the same answer.

use super::around::Around;
use super::state::State;
use super::touch::Allowed;
use crate::kinematics::spread;

/// The largest change of a joint on one edge, in rad or m.
const STEP: f64 = 0.7;
/// Samples that the trees grow towards.
const SAMPLES: usize = 80;

/// A tree of states, each with the index of the one before it.
struct Grown(Vec<(State, usize)>);

impl Around<'_, '_> {
    /// A way of the arm between two free states with the base at one place, both included.
    pub(super) fn connect(&self, from: &State, to: &State) -> Option<Vec<State>> {
        let machine = self.room.machine;
        let chain = machine.hand()?.solver.chain();
        // The fingers first: the trees move the arm alone.
        let mut start = to.clone();
        for at in &chain.in_tree {
            *start.joints.get_mut(*at)? = *from.joints.get(*at)?;
        }
        self.edge(from, &start, Allowed::default()).ok()?;
        let mut trees = [Grown(vec![(start, 0)]), Grown(vec![(to.clone(), 0)])];
        for sample in 0..SAMPLES {
            let mut aim = to.clone();
            for (at, value) in chain.in_tree.iter().zip(spread(&chain.variables, sample)) {
                *aim.joints.get_mut(*at)? = value;
            }
            let [first, second] = &mut trees;
            let is_turned = sample % 2 == 1;
            let (near, far) = if is_turned { (second, first) } else { (first, second) };
            let Some(new) = self.grow(near, &aim) else { continue };
            while let Some(next) = self.grow(far, &new) {
                if next.joints != new.joints {
                    continue;
                }
                let (near, far) = (near.back(), far.back());
                let (mut path, rest) = if is_turned { (far, near) } else { (near, far) };
                path.reverse();
                path.extend(rest.into_iter().skip(1));
                let mut path = self.shortened(path);
                path.insert(0, from.clone());
                return Some(path);
            }
        }
        None
    }

    /// One step of a tree towards a state: the new state, where the way to it is free.
    fn grow(&self, tree: &mut Grown, aim: &State) -> Option<State> {
        let far = |state: &State| {
            state.joints.iter().zip(&aim.joints).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
        };
        let best = tree.0.iter().map(|(state, _)| far(state)).enumerate();
        let (at, way) = best.reduce(|best, next| if next.1 < best.1 { next } else { best })?;
        if way == 0.0 {
            return None;
        }
        let near = tree.0.get(at).map(|(state, _)| state)?;
        let next = if way <= STEP { aim.clone() } else { near.towards(aim, STEP / way) };
        if self.touch(&next, Allowed::default()).is_some() {
            return None;
        }
        self.between(near, &next, Allowed::default()).ok()?;
        tree.0.push((next.clone(), at));
        Some(next)
    }

    /// The same way without corners that can be cut.
    fn shortened(&self, path: Vec<State>) -> Vec<State> {
        let mut kept: Vec<State> = Vec::new();
        let mut rest = path.as_slice();
        while let [first, after @ ..] = rest {
            kept.push(first.clone());
            let seen = (1..after.len()).rev().find(|at| {
                after.get(*at).is_some_and(|next| self.between(first, next, Allowed::default()).is_ok())
            });
            rest = after.get(seen.unwrap_or(0)..).unwrap_or_default();
        }
        kept
    }
}

impl Grown {
    /// The states from the last one back to the root.
    fn back(&self) -> Vec<State> {
        let mut states = Vec::new();
        let mut at = self.0.len().saturating_sub(1);
        while let Some((state, before)) = self.0.get(at) {
            states.push(state.clone());
            if at == 0 {
                break;
            }
            at = *before;
        }
        states
    }
}

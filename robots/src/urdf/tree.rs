//! Resolution of names to indices, and check that links and joints form one tree and mimic rules no cycle.
//! Nothing recurses, and all is linear in links and joints.

use motet_syntax::{Diagnostic, suggest};
use rustc_hash::FxHashMap;

use super::diagnostics::{
    EmptyLimits, LinkCycle, MimicCycle, SeveralRoots, TwoParents, UnknownLink, UnknownMimic,
};
use super::element::{RawJoint, SpannedName};
use super::model::{Joint, JointLimits, Link, Mimic, Urdf};

/// Tolerance for the limits of a follower.
const ROUNDED: f64 = 1e-9;

/// Builds the tree of a URDF; `None` if the parts do not form one.
pub(super) fn build_tree(
    name: &str,
    links: Vec<Link>,
    spans: &[SpannedName<'_>],
    raw: Vec<RawJoint<'_>>,
    found: &mut Vec<Diagnostic>,
) -> Option<Urdf> {
    let before = found.len();
    let by_name: FxHashMap<&str, usize> =
        spans.iter().enumerate().map(|(at, (name, _))| (*name, at)).collect();
    let ends: Vec<Option<(usize, usize)>> = raw
        .iter()
        .map(|joint| {
            let (parent, child) = (link(joint.parent, &by_name, found), link(joint.child, &by_name, found));
            parent.zip(child)
        })
        .collect();
    // Unknown links have been reported; what they would break is no second mistake.
    if found.len() > before {
        return None;
    }
    let ends: Vec<(usize, usize)> = ends.into_iter().flatten().collect();
    let carriers = carriers(&ends, &raw, spans, found)?;
    let root = root(&ends, &carriers, spans, found)?;
    let order = order(&ends, root, links.len());
    let leaders = leaders(&raw, found)?;
    // Joints are reordered along the tree, so their indices change.
    let mut moved = vec![0; raw.len()];
    for (new, old) in order.iter().enumerate() {
        if let Some(slot) = moved.get_mut(*old) {
            *slot = new;
        }
    }
    let joints = order.iter().filter_map(|at| {
        let (joint, (parent, child)) = (raw.get(*at)?, ends.get(*at).copied()?);
        let leader = leaders.get(*at).copied().flatten().and_then(|leader| moved.get(leader).copied());
        let mimic = joint.mimic.as_ref().zip(leader).map(|(mimic, joint)| Mimic {
            joint,
            multiplier: mimic.multiplier,
            offset: mimic.offset,
        });
        Some(Joint {
            name: joint.name.0.into(),
            kind: joint.kind,
            parent,
            child,
            parent_from_joint: joint.parent_from_joint,
            axis: joint.axis,
            limits: joint.limits,
            velocity: joint.velocity,
            mimic,
        })
    });
    let mut joints: Vec<Joint> = joints.collect();
    follow(&mut joints, &raw, &moved, found);
    Some(Urdf { name: name.into(), links, joints, root, may_touch: vec![] })
}

/// Narrows the limits of joints to those of all that follow them.
fn follow(joints: &mut [Joint], raw: &[RawJoint<'_>], moved: &[usize], found: &mut Vec<Diagnostic>) {
    let ranges = ranges(joints);
    for (joint, at) in raw.iter().zip(moved) {
        let (Some(own), Some(Some(range))) = (joints.get_mut(*at), ranges.get(*at)) else { continue };
        if range.lower <= range.upper {
            own.limits = Some(*range);
        } else if own.limits.is_none_or(|own| own.lower <= own.upper) {
            let (name, span) = joint.name;
            let (joint, lower, upper) = (name.to_owned(), range.lower, range.upper);
            found.push(EmptyLimits { span, joint, lower, upper, is_followed: true }.into());
        }
    }
}

/// For each joint the limits that keep it and its followers within theirs; `lower` is above `upper` if there
/// are none. Chains of followers may be long, but only one of them.
fn ranges(joints: &[Joint]) -> Vec<Option<JointLimits>> {
    let mut ranges: Vec<Option<JointLimits>> = joints.iter().map(|joint| joint.limits).collect();
    for joint in joints {
        let Some(own) = joint.limits else { continue };
        let (mut multiplier, mut offset, mut next) = (1.0, 0.0, joint.mimic);
        while let Some(mimic) = next {
            offset += multiplier * mimic.offset;
            multiplier *= mimic.multiplier;
            next = joints.get(mimic.joint).and_then(|leader| leader.mimic);
            let Some(slot) = ranges.get_mut(mimic.joint).filter(|_| next.is_none() && multiplier != 0.0)
            else {
                continue;
            };
            let (one, other) = ((own.lower - offset) / multiplier, (own.upper - offset) / multiplier);
            let (lower, upper) = (one.min(other), one.max(other));
            let known = slot.unwrap_or(JointLimits { lower: f64::NEG_INFINITY, upper: f64::INFINITY });
            *slot = Some(JointLimits {
                lower: if lower > known.lower + ROUNDED { lower } else { known.lower },
                upper: if upper < known.upper - ROUNDED { upper } else { known.upper },
            });
        }
    }
    ranges
}

fn link(
    (name, span): SpannedName<'_>,
    by_name: &FxHashMap<&str, usize>,
    found: &mut Vec<Diagnostic>,
) -> Option<usize> {
    let known = by_name.get(name).copied();
    if known.is_none() {
        let mut names: Vec<&str> = by_name.keys().copied().collect();
        names.sort_unstable();
        let near = suggest::closest(name, names).map(str::to_owned);
        found.push(UnknownLink { span, link: name.to_owned(), near }.into());
    }
    known
}

/// For each link the joint that moves it.
fn carriers(
    ends: &[(usize, usize)],
    raw: &[RawJoint<'_>],
    spans: &[SpannedName<'_>],
    found: &mut Vec<Diagnostic>,
) -> Option<Vec<Option<usize>>> {
    let before = found.len();
    let mut carriers: Vec<Option<usize>> = vec![None; spans.len()];
    for (at, ((_, child), joint)) in ends.iter().zip(raw).enumerate() {
        let Some(slot) = carriers.get_mut(*child) else { continue };
        match slot.and_then(|other| raw.get(other)) {
            Some(other) => {
                let (link, span) = joint.child;
                let (link, first) = (link.to_owned(), other.child.1);
                let (joint, other) = (joint.name.0.to_owned(), other.name.0.to_owned());
                found.push(TwoParents { span, link, joint, other, first }.into());
            }
            None => *slot = Some(at),
        }
    }
    (found.len() == before).then_some(carriers)
}

/// The only link that no joint moves.
fn root(
    ends: &[(usize, usize)],
    carriers: &[Option<usize>],
    spans: &[SpannedName<'_>],
    found: &mut Vec<Diagnostic>,
) -> Option<usize> {
    let before = found.len();
    let parent_of = |link: usize| {
        let joint = carriers.get(link).copied().flatten()?;
        ends.get(joint).map(|(parent, _)| *parent)
    };
    // Each link is visited once: 0 for unseen, else the number of the walk that saw it.
    let mut seen = vec![0_usize; carriers.len()];
    for start in 0..carriers.len() {
        let mut at = start;
        while seen.get(at) == Some(&0) {
            if let Some(slot) = seen.get_mut(at) {
                *slot = start + 1;
            }
            let Some(parent) = parent_of(at) else { break };
            if seen.get(parent) == Some(&(start + 1)) {
                found.push(ring(parent, parent_of, spans));
                break;
            }
            at = parent;
        }
    }
    let mut roots = (0..carriers.len()).filter(|link| carriers.get(*link) == Some(&None));
    let root = roots.next();
    if let Some((first, place)) = root.and_then(|root| spans.get(root)) {
        for (link, span) in roots.filter_map(|other| spans.get(other)) {
            let (link, first) = ((*link).to_owned(), (*first).to_owned());
            found.push(SeveralRoots { span: *span, link, first, place: *place }.into());
        }
    }
    root.filter(|_| found.len() == before)
}

fn ring(start: usize, parent_of: impl Fn(usize) -> Option<usize>, spans: &[SpannedName<'_>]) -> Diagnostic {
    const SHOWN: usize = 8;
    let name = |link: usize| spans.get(link).map_or(String::new(), |(name, _)| (*name).to_owned());
    let span = spans.get(start).map_or_else(Default::default, |(_, span)| *span);
    let mut chain = vec![name(start)];
    let mut at = start;
    while let Some(parent) = parent_of(at).filter(|parent| *parent != start && chain.len() < SHOWN) {
        chain.push(name(parent));
        at = parent;
    }
    LinkCycle { span, chain }.into()
}

/// Joints in breadth-first order from the root, those of one link in the order of the file.
fn order(ends: &[(usize, usize)], root: usize, links: usize) -> Vec<usize> {
    let mut on: Vec<Vec<usize>> = vec![Vec::new(); links];
    for (joint, (parent, _)) in ends.iter().enumerate() {
        if let Some(joints) = on.get_mut(*parent) {
            joints.push(joint);
        }
    }
    let mut order: Vec<usize> = on.get(root).cloned().unwrap_or_default();
    let mut next = 0;
    while let Some(joint) = order.get(next).copied() {
        let child = ends.get(joint).map(|(_, child)| *child);
        order.extend(child.and_then(|child| on.get(child)).into_iter().flatten());
        next += 1;
    }
    order
}

/// For each joint its direct leader.
fn leaders(raw: &[RawJoint<'_>], found: &mut Vec<Diagnostic>) -> Option<Vec<Option<usize>>> {
    let before = found.len();
    let by_name: FxHashMap<&str, usize> =
        raw.iter().enumerate().map(|(at, joint)| (joint.name.0, at)).collect();
    let mut leaders = Vec::with_capacity(raw.len());
    for joint in raw {
        let Some(mimic) = &joint.mimic else {
            leaders.push(None);
            continue;
        };
        let (leader, span) = mimic.leader;
        let known = by_name.get(leader).copied();
        let fits = known.filter(|at| raw.get(*at).is_some_and(|leader| leader.kind.has_one_position()));
        if fits.is_none() {
            let names = raw.iter().filter(|other| other.kind.has_one_position()).map(|other| other.name.0);
            let near = if known.is_none() { suggest::closest(leader, names) } else { None };
            let (joint, leader, near) = (joint.name.0.to_owned(), leader.to_owned(), near.map(str::to_owned));
            found.push(UnknownMimic { span, joint, leader, near, is_joint: known.is_some() }.into());
        }
        leaders.push(fits);
    }
    rings_of_mimics(raw, &leaders, found);
    (found.len() == before).then_some(leaders)
}

fn rings_of_mimics(raw: &[RawJoint<'_>], leaders: &[Option<usize>], found: &mut Vec<Diagnostic>) {
    let mut seen = vec![0_usize; leaders.len()];
    for start in 0..leaders.len() {
        let mut walked = Vec::new();
        let mut at = start;
        while let Some(slot) = seen.get_mut(at).filter(|slot| **slot == 0) {
            *slot = start + 1;
            walked.push(at);
            let Some(leader) = leaders.get(at).copied().flatten() else { break };
            if seen.get(leader) == Some(&(start + 1)) {
                let ring = walked.iter().skip_while(|joint| **joint != leader).take(8);
                let chain = ring.filter_map(|joint| raw.get(*joint)).map(|joint| joint.name.0.to_owned());
                let span = raw.get(leader).and_then(|joint| joint.mimic.as_ref()).map(|mimic| mimic.leader.1);
                found.push(MimicCycle { span: span.unwrap_or_default(), chain: chain.collect() }.into());
                break;
            }
            at = leader;
        }
    }
}

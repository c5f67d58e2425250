//! What an SRDF says of the arm and the hand: its end effectors, and its groups.

use smol_str::SmolStr;

use crate::srdf::{JointGroup, Srdf};
use crate::urdf::{JointKind, Urdf};

/// A hand as it is described.
pub(super) struct Described {
    /// The link that the hand is mounted on, or with which the arm ends.
    pub(super) mount: usize,
    /// The links of the hand.
    pub(super) links: Vec<usize>,
    /// The joints of the hand.
    pub(super) joints: Vec<usize>,
    /// Whether the arm ends here, with nothing said of a hand.
    pub(super) is_end: bool,
    /// What says so.
    pub(super) why: String,
}

impl Described {
    /// The end effector on the longest arm, or the end of the longest chain of a group; `length` counts the joints between the
    /// base and a link.
    pub(super) fn find(urdf: &Urdf, srdf: &Srdf, length: impl Fn(usize) -> usize) -> Option<Self> {
        let hands = srdf.end_effectors.iter().rev().max_by_key(|(_, hand)| length(hand.parent));
        if let Some((name, hand)) = hands {
            let (links, joints) = members(urdf, srdf, &hand.group);
            let why = format!("the end effector `{}`", name.escape_debug());
            return Some(Self { mount: hand.parent, links, joints, is_end: false, why });
        }
        let ends = srdf.groups.iter().flat_map(|(name, group)| ends(urdf, group).map(move |end| (name, end)));
        // Of several that are as long, the first.
        let (name, mount) = ends.collect::<Vec<_>>().into_iter().rev().max_by_key(|(_, end)| length(*end))?;
        let why = format!("the end of the group `{}`", name.escape_debug());
        Some(Self { mount, links: vec![], joints: vec![], is_end: true, why })
    }
}

/// Where the chains of a group end, and what its last joint moves.
fn ends<'a>(urdf: &'a Urdf, group: &'a JointGroup) -> impl Iterator<Item = usize> + 'a {
    // Each joint stands after the one that carries its parent.
    let last = group.joints.iter().max().and_then(|joint| urdf.joints.get(*joint)).map(|joint| joint.child);
    group.chains.iter().map(|[_, tip]| *tip).chain(last)
}

/// The links and joints of a group and of those in it, with what its joints move.
fn members(urdf: &Urdf, srdf: &Srdf, group: &str) -> (Vec<usize>, Vec<usize>) {
    let (mut links, mut joints): (Vec<usize>, Vec<usize>) = (Vec::new(), Vec::new());
    let mut open = vec![SmolStr::new(group)];
    let mut next = 0;
    while let Some(group) = open.get(next).and_then(|name| srdf.groups.get(name)) {
        links.extend(&group.links);
        joints.extend(&group.joints);
        for inner in &group.groups {
            if !open.contains(inner) {
                open.push(inner.clone());
            }
        }
        next += 1;
    }
    links.extend(joints.iter().filter_map(|joint| urdf.joints.get(*joint)).map(|joint| joint.child));
    // A joint that is fixed is in the lists of some tools.
    joints.retain(|joint| urdf.joints.get(*joint).is_some_and(|joint| joint.kind != JointKind::Fixed));
    (links, joints)
}

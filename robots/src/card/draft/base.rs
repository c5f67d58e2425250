//! Which link of a URDF is the base: what a root that stands for the room carries, and joints by which the base itself moves.

use crate::quaternion::{mul, rotate};
use crate::urdf::{Joint, JointKind, Urdf};

use super::parts::has_word;

/// The base.
#[derive(Clone, Copy)]
pub(super) struct DraftBase {
    pub(super) link: usize,
    pub(super) why: &'static str,
    /// Whether joints before it slide it over the floor.
    pub(super) is_planar: bool,
}

impl DraftBase {
    /// The root, or what hangs on links that stand for the room. O(joints²) of the links before the base.
    pub(super) fn find(urdf: &Urdf) -> Self {
        let mut base = Self { link: urdf.root, why: "the root", is_planar: false };
        while let Some(joint) = only(urdf, base.link) {
            let name = urdf.links.get(base.link).map_or("", |link| link.name.as_str());
            if let Some(link) = slid(urdf, base.link) {
                return Self { link, why: "what joints along x and y move", is_planar: true };
            }
            base = match joint.kind {
                JointKind::Planar => {
                    return Self { link: joint.child, why: "what a planar joint moves", is_planar: true };
                }
                JointKind::Floating => Self { link: joint.child, why: "what a floating joint moves", ..base },
                JointKind::Fixed if has_word(name, &["world", "map", "odom"]) => {
                    Self { link: joint.child, why: "what the root carries", ..base }
                }
                // What turns on a root of whatever name is an arm.
                JointKind::Fixed | JointKind::Revolute | JointKind::Continuous | JointKind::Prismatic => {
                    return base;
                }
            };
        }
        base
    }
}

/// The joint of a link that carries no other.
fn only(urdf: &Urdf, link: usize) -> Option<&Joint> {
    let mut hanging = urdf.joints.iter().filter(|joint| joint.parent == link);
    hanging.next().filter(|_| hanging.next().is_none())
}

/// What a chain of joints moves that slides along x and along y, and may turn about z, with no shape before its last link: a
/// machine that slides has beams.
fn slid(urdf: &Urdf, from: usize) -> Option<usize> {
    let (mut at, mut turn) = (from, [0.0, 0.0, 0.0, 1.0]);
    // Along x, along y, about z.
    let mut has = [false; 3];
    while let Some(joint) = only(urdf, at).filter(|joint| joint.mimic.is_none()) {
        if urdf.links.get(at).is_none_or(|link| !link.collisions.is_empty() || !link.visuals.is_empty()) {
            break;
        }
        turn = mul(turn, joint.parent_from_joint.quaternion_xyzw);
        let along = rotate(turn, joint.axis).map(|part| part.abs() > 0.999);
        let which = match (joint.kind, along) {
            (JointKind::Prismatic, [true, _, _]) => 0,
            (JointKind::Prismatic, [_, true, _]) => 1,
            (JointKind::Revolute | JointKind::Continuous, [_, _, true]) => 2,
            _ => break,
        };
        match has.get_mut(which) {
            Some(is_known) if !*is_known => *is_known = true,
            Some(_) | None => break,
        }
        at = joint.child;
    }
    matches!(has, [true, true, _]).then_some(at)
}

//! The joints of a robot as a flat list, each after the one that carries it, and the variables that move them.

use std::f64::consts::{PI, TAU};

use motet_robots::urdf::{Joint, JointKind, JointLimits, Pose, Urdf};
use nalgebra::{Isometry3, Quaternion, Translation3, Unit, UnitQuaternion, Vector3};
use smol_str::{SmolStr, format_smolstr};

/// A robot's kinematics: links, and variables that move them.
///
/// A *configuration* is one number for each variable, in the order of [`KinematicTree::dofs`]. A revolute, continuous or
/// prismatic joint that follows no other has one variable of its name. A planar joint has three, `NAME/x`, `NAME/y` and
/// `NAME/theta`. The position of a joint that follows others is a multiple of one variable plus an offset, which is
/// worked out here once; the variable's limits are those of the joint and of all that follow it.
#[derive(Clone, PartialEq, Debug)]
pub struct KinematicTree {
    pub(super) links: Vec<SmolStr>,
    /// Index of the step that places a link; `None` for the root.
    pub(super) placed_by: Vec<Option<usize>>,
    pub(super) root: usize,
    dofs: Vec<Dof>,
    pub(super) segments: Vec<Segment>,
}

/// What a robot moves by itself.
#[derive(Clone, PartialEq, Debug)]
pub struct Dof {
    /// Its name.
    pub name: SmolStr,
    /// Least and greatest value in rad or m; `None` where it has no limits.
    pub limits: Option<(f64, f64)>,
    /// Whether a full turn brings it back, so that it is an angle without limits.
    pub is_continuous: bool,
    /// Whether it is a length in m, and no angle.
    pub is_prismatic: bool,
}

/// JointLimits as far from 0 as that on both sides, in rad and in m, are none: "unlimited" is often written as 1e16.
const UNLIMITED: [f64; 2] = [1000.0 * TAU, 1000.0];

impl Dof {
    /// Whether a value lies within the limits, both ends included.
    #[must_use]
    pub fn allows(&self, value: f64) -> bool {
        self.limits.is_none_or(|(lower, upper)| lower <= value && value <= upper) && value.is_finite()
    }

    /// Where values are looked for: within the limits, of an angle within one full turn, about 0 as far as they allow it; half a turn or
    /// 1 m either way where there are none.
    #[must_use]
    pub fn sampling_range(&self) -> (f64, f64) {
        match self.limits {
            None if self.is_continuous => (-PI, PI),
            None => (-1.0, 1.0),
            Some((lower, upper)) if upper - lower > TAU && !self.is_prismatic => {
                let least = (-PI).clamp(lower, upper - TAU);
                (least, least + TAU)
            }
            Some((lower, upper)) if self.is_prismatic => {
                let [_, most] = UNLIMITED;
                (lower.clamp(-most, most), upper.clamp(-most, most))
            }
            Some(limits) => limits,
        }
    }

    /// Room to the nearer limit in rad or m, negative outside; infinite where there is no limit.
    #[must_use]
    pub fn limit_margin(&self, value: f64) -> f64 {
        self.limits.map_or(f64::INFINITY, |(lower, upper)| (value - lower).min(upper - value))
    }
}

/// From a link to the next: a fixed pose, then at most one motion.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Segment {
    pub(super) parent: usize,
    pub(super) child: usize,
    pub(super) parent_from_joint: Isometry3<f64>,
    pub(super) motion: JointMotion,
}

/// What a step moves.
#[derive(Clone, PartialEq, Debug)]
pub(super) enum JointMotion {
    /// Nothing.
    Fixed,
    /// A rotation about an axis.
    Turn(Unit<Vector3<f64>>, JointCoupling),
    /// A shift along an axis.
    Slide(Unit<Vector3<f64>>, JointCoupling),
    /// A shift along two axes, then a rotation about the third; the three variables follow each other.
    Planar {
        /// Directions of x, y and the normal.
        axes: [Unit<Vector3<f64>>; 3],
        /// Index of the variable for x.
        first: usize,
    },
}

/// A joint position in terms of a variable: `multiplier * dof + offset`.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct JointCoupling {
    /// Index of the variable.
    pub dof: usize,
    /// Factor.
    pub multiplier: f64,
    /// Offset in rad or m.
    pub offset: f64,
}

impl JointCoupling {
    /// The joint's position.
    #[must_use]
    pub fn position(&self, configuration: &[f64]) -> f64 {
        self.multiplier * configuration.get(self.dof).copied().unwrap_or(0.0) + self.offset
    }
}

/// A link or a variable that a robot does not have.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct UnknownName(pub SmolStr);

impl std::fmt::Display for UnknownName {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "the robot has no `{}`", self.0)
    }
}

impl std::error::Error for UnknownName {}

impl KinematicTree {
    /// The tree of a URDF. O(links + joints).
    #[must_use]
    pub fn new(urdf: &Urdf) -> Self {
        let mut dofs = Vec::new();
        let mut is_followed = vec![false; urdf.joints.len()];
        for mimic in urdf.joints.iter().filter_map(|joint| joint.mimic) {
            is_followed.get_mut(mimic.joint).into_iter().for_each(|slot| *slot = true);
        }
        let joints = urdf.joints.iter().zip(is_followed);
        let couplings: Vec<Option<JointCoupling>> =
            joints.map(|(joint, is_followed)| own_dof(joint, is_followed, &mut dofs)).collect();
        let segments = urdf.joints.iter().zip(0..).map(|(joint, at)| {
            let axis = Unit::new_unchecked(Vector3::from(joint.axis));
            let motion = match (joint.kind, resolved(urdf, &couplings, at)) {
                (JointKind::Revolute | JointKind::Continuous, Some(coupling)) => {
                    JointMotion::Turn(axis, coupling)
                }
                (JointKind::Prismatic, Some(coupling)) => JointMotion::Slide(axis, coupling),
                (JointKind::Planar, Some(coupling)) => {
                    JointMotion::Planar { axes: plane(axis), first: coupling.dof }
                }
                (JointKind::Fixed | JointKind::Floating, _) | (_, None) => JointMotion::Fixed,
            };
            Segment {
                parent: joint.parent,
                child: joint.child,
                parent_from_joint: isometry(&joint.parent_from_joint),
                motion,
            }
        });
        let segments: Vec<Segment> = segments.collect();
        let mut placed_by = vec![None; urdf.links.len()];
        for (segment, at) in segments.iter().zip(0..) {
            if let Some(slot) = placed_by.get_mut(segment.child) {
                *slot = Some(at);
            }
        }
        let links = urdf.links.iter().map(|link| link.name.clone()).collect();
        Self { links, placed_by, root: urdf.root, dofs, segments }
    }

    /// The variables, in the order of a configuration.
    #[must_use]
    pub fn dofs(&self) -> &[Dof] {
        &self.dofs
    }

    /// The links' names, in the order of the URDF.
    #[must_use]
    pub fn links(&self) -> &[SmolStr] {
        &self.links
    }

    /// Index of the root link.
    #[must_use]
    pub fn root(&self) -> usize {
        self.root
    }

    /// Index of a link. O(links).
    ///
    /// # Errors
    ///
    /// There is no such link.
    pub fn link(&self, name: &str) -> Result<usize, UnknownName> {
        self.links.iter().position(|link| link == name).ok_or_else(|| UnknownName(name.into()))
    }

    /// Index of a variable. O(variables).
    ///
    /// # Errors
    ///
    /// There is no such variable.
    pub fn dof(&self, name: &str) -> Result<usize, UnknownName> {
        self.dofs.iter().position(|known| known.name == name).ok_or_else(|| UnknownName(name.into()))
    }

    /// A configuration with zero where the limits allow it, else the nearer limit.
    #[must_use]
    pub fn neutral(&self) -> Vec<f64> {
        self.dofs.iter().map(|known| known.limits.map_or(0.0, |(l, u)| 0.0_f64.clamp(l, u))).collect()
    }

    /// Whether a configuration is within the limits of every variable.
    #[must_use]
    pub fn allows(&self, configuration: &[f64]) -> bool {
        configuration.len() == self.dofs.len()
            && self.dofs.iter().zip(configuration).all(|(known, value)| known.allows(*value))
    }
}

/// The variable of a joint that follows no other.
fn own_dof(joint: &Joint, is_followed: bool, dofs: &mut Vec<Dof>) -> Option<JointCoupling> {
    if joint.mimic.is_some() {
        return None;
    }
    let first = dofs.len();
    let is_prismatic = joint.kind == JointKind::Prismatic;
    let [angle, length] = UNLIMITED;
    let most = if is_prismatic { length } else { angle };
    let limits = joint.limits.map(|JointLimits { lower, upper }| (lower, upper));
    // One that is followed has limits for the sake of others, in whatever unit.
    let limits = limits.filter(|(lower, upper)| is_followed || -most < *lower || *upper < most);
    match joint.kind {
        JointKind::Fixed | JointKind::Floating => return None,
        JointKind::Revolute | JointKind::Continuous | JointKind::Prismatic => {
            let is_continuous = !is_prismatic && limits.is_none();
            dofs.push(Dof { name: joint.name.clone(), limits, is_continuous, is_prismatic });
        }
        JointKind::Planar => {
            for part in ["x", "y", "theta"] {
                let name = format_smolstr!("{}/{part}", joint.name);
                let is_continuous = part == "theta";
                dofs.push(Dof { name, limits: None, is_continuous, is_prismatic: !is_continuous });
            }
        }
    }
    Some(JointCoupling { dof: first, multiplier: 1.0, offset: 0.0 })
}

/// What moves a joint in the end: follows the chain of mimic rules, which has no ring.
fn resolved(urdf: &Urdf, couplings: &[Option<JointCoupling>], joint: usize) -> Option<JointCoupling> {
    let (mut multiplier, mut offset, mut at) = (1.0, 0.0, joint);
    while let Some(mimic) = urdf.joints.get(at)?.mimic {
        offset += multiplier * mimic.offset;
        multiplier *= mimic.multiplier;
        at = mimic.joint;
    }
    let dof = couplings.get(at).copied().flatten()?.dof;
    Some(JointCoupling { dof, multiplier, offset })
}

/// Two directions that make a right-handed frame with a normal; x and y for the normal z.
fn plane(normal: Unit<Vector3<f64>>) -> [Unit<Vector3<f64>>; 3] {
    let helper = if normal.x.abs() < 0.9 { Vector3::x() } else { Vector3::y() };
    let x = Unit::new_normalize(helper - normal.into_inner() * normal.dot(&helper));
    [x, Unit::new_normalize(normal.cross(&x)), normal]
}

/// A pose as a URDF writes it.
pub(crate) fn isometry(pose: &Pose) -> Isometry3<f64> {
    let [x, y, z] = pose.xyz;
    let [i, j, k, w] = pose.quaternion_xyzw;
    Isometry3::from_parts(
        Translation3::new(x, y, z),
        UnitQuaternion::new_unchecked(Quaternion::new(w, i, j, k)),
    )
}

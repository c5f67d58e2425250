//! Kinematic tree: the joints of a robot as a flat list, each after the joint that carries it, the degrees of
//! freedom that move them, and quasi-random values of these.

use std::f64::consts::{PI, TAU};

use motet_robots::urdf::{Joint, JointKind, JointLimits, Pose, Urdf};
use nalgebra::{Isometry3, Quaternion, Translation3, Unit, UnitQuaternion, Vector3};
use smol_str::{SmolStr, format_smolstr};

/// Kinematic tree of a robot.
///
/// A *configuration* is one number for each degree of freedom, in the order of [`KinematicTree::dofs`]. A
/// revolute, continuous or prismatic joint that follows no other has one degree of freedom of its name. A
/// planar joint has three: `NAME/x`, `NAME/y` and `NAME/theta`. The position of a mimic joint is a multiple
/// of one degree of freedom plus an offset, resolved here once; the limits of a degree of freedom are those
/// of its joint and of all that follow it.
///
/// ```
/// use motet_geometry::KinematicTree;
/// use motet_robots::builtin;
///
/// let tree = KinematicTree::new(&builtin::robot("panda").unwrap().urdf);
/// let hand = tree.link("panda_hand").unwrap();
/// let root_from_hand = tree.root_from_link(&tree.neutral(), hand);
/// assert!(root_from_hand.translation.vector.norm() > 0.3);
/// ```
#[derive(Clone, PartialEq, Debug)]
pub struct KinematicTree {
    pub(super) links: Vec<SmolStr>,
    /// Index of the segment that ends at a link; `None` for the root.
    pub(super) placed_by: Vec<Option<usize>>,
    pub(super) root: usize,
    dofs: Vec<Dof>,
    pub(super) segments: Vec<Segment>,
}

/// Degree of freedom: one independent joint variable.
#[derive(Clone, PartialEq, Debug)]
pub struct Dof {
    pub name: SmolStr,
    /// Least and greatest value in rad or m; `None` without limits.
    pub limits: Option<(f64, f64)>,
    /// True for an angle without limits, for which a full turn is the identity.
    pub is_continuous: bool,
    /// True for a length in m, false for an angle in rad.
    pub is_prismatic: bool,
    /// Greatest speed in rad/s or m/s at which neither its joint nor any that follows it is too fast; `None`
    /// if the URDF gives none.
    pub speed: Option<f64>,
}

/// Limits as far from 0 as that on both sides, in rad and in m, are none: "unlimited" is often written
/// as 1e16.
const UNLIMITED: [f64; 2] = [1000.0 * TAU, 1000.0];

impl Dof {
    /// Checks whether a value is within the limits, both ends included.
    #[must_use]
    pub fn allows(&self, value: f64) -> bool {
        self.limits.is_none_or(|(lower, upper)| lower <= value && value <= upper) && value.is_finite()
    }

    /// Range that is searched and sampled: the limits; for an angle at most one full turn, about 0 as far as
    /// the limits allow; half a turn or 1 m to either side without limits.
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

    /// Distance to the nearer limit in rad or m, negative outside; infinite without limits.
    #[must_use]
    pub fn limit_margin(&self, value: f64) -> f64 {
        self.limits.map_or(f64::INFINITY, |(lower, upper)| (value - lower).min(upper - value))
    }
}

/// Segment of the tree, from a link to the next: a fixed pose, then at most one joint motion.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Segment {
    pub(super) parent: usize,
    pub(super) child: usize,
    pub(super) parent_from_joint: Isometry3<f64>,
    pub(super) motion: JointMotion,
}

/// Motion of the joint of a segment.
#[derive(Clone, PartialEq, Debug)]
pub(super) enum JointMotion {
    Fixed,
    /// Rotation about an axis.
    Turn(Unit<Vector3<f64>>, JointCoupling),
    /// Translation along an axis.
    Slide(Unit<Vector3<f64>>, JointCoupling),
    /// Translation along two axes, then a rotation about the third, by three consecutive degrees of freedom.
    Planar {
        /// Directions of x, y and the normal.
        axes: [Unit<Vector3<f64>>; 3],
        /// Index of the degree of freedom for x.
        first: usize,
    },
}

/// Coupling of a joint to a degree of freedom: `position = multiplier * dof + offset`.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct JointCoupling {
    /// Index of the degree of freedom.
    pub dof: usize,
    pub multiplier: f64,
    pub offset: f64,
}

impl JointCoupling {
    /// Position of the joint at a configuration, in rad or m.
    #[must_use]
    pub fn position(&self, configuration: &[f64]) -> f64 {
        self.multiplier * configuration.get(self.dof).copied().unwrap_or(0.0) + self.offset
    }
}

/// Error for a link or degree of freedom that the robot does not have.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct UnknownName(pub SmolStr);

impl std::fmt::Display for UnknownName {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "the robot has no `{}`", self.0)
    }
}

impl std::error::Error for UnknownName {}

impl KinematicTree {
    /// Builds the kinematic tree of a URDF. O(links + joints).
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
        for (joint, at) in urdf.joints.iter().zip(0..) {
            let Some(coupling) = resolved(urdf, &couplings, at) else { continue };
            let speed = joint.velocity.map(|speed| speed / coupling.multiplier.abs());
            if let Some((dof, speed)) = dofs.get_mut(coupling.dof).zip(speed) {
                dof.speed = Some(dof.speed.map_or(speed, |own| own.min(speed)));
            }
        }
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

    /// Degrees of freedom, in the order of a configuration.
    #[must_use]
    pub fn dofs(&self) -> &[Dof] {
        &self.dofs
    }

    /// Names of the links, in the order of the URDF.
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

    /// Index of a degree of freedom. O(degrees of freedom).
    pub fn dof(&self, name: &str) -> Result<usize, UnknownName> {
        self.dofs.iter().position(|known| known.name == name).ok_or_else(|| UnknownName(name.into()))
    }

    /// Configuration with zeros where the limits allow them, else the nearer limits.
    #[must_use]
    pub fn neutral(&self) -> Vec<f64> {
        self.dofs.iter().map(|known| known.limits.map_or(0.0, |(l, u)| 0.0_f64.clamp(l, u))).collect()
    }

    /// Checks whether a configuration is within the limits of every degree of freedom.
    #[must_use]
    pub fn allows(&self, configuration: &[f64]) -> bool {
        configuration.len() == self.dofs.len()
            && self.dofs.iter().zip(configuration).all(|(known, value)| known.allows(*value))
    }
}

/// Adds the degrees of freedom of a joint that follows no other.
fn own_dof(joint: &Joint, is_followed: bool, dofs: &mut Vec<Dof>) -> Option<JointCoupling> {
    if joint.mimic.is_some() {
        return None;
    }
    let first = dofs.len();
    let is_prismatic = joint.kind == JointKind::Prismatic;
    let [angle, length] = UNLIMITED;
    let most = if is_prismatic { length } else { angle };
    let limits = joint.limits.map(|JointLimits { lower, upper }| (lower, upper));
    // The limits of a leader include those of its followers, in whatever unit.
    let limits = limits.filter(|(lower, upper)| is_followed || -most < *lower || *upper < most);
    match joint.kind {
        JointKind::Fixed | JointKind::Floating => return None,
        JointKind::Revolute | JointKind::Continuous | JointKind::Prismatic => {
            let is_continuous = !is_prismatic && limits.is_none();
            dofs.push(Dof { name: joint.name.clone(), limits, is_continuous, is_prismatic, speed: None });
        }
        JointKind::Planar => {
            for part in ["x", "y", "theta"] {
                let name = format_smolstr!("{}/{part}", joint.name);
                let is_continuous = part == "theta";
                dofs.push(Dof {
                    name,
                    limits: None,
                    is_continuous,
                    is_prismatic: !is_continuous,
                    speed: None,
                });
            }
        }
    }
    Some(JointCoupling { dof: first, multiplier: 1.0, offset: 0.0 })
}

/// Coupling of a joint to a degree of freedom, through the chain of mimic rules, which has no cycle.
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

/// Two directions that complete a normal to a right-handed frame; x and y for the normal z.
fn plane(normal: Unit<Vector3<f64>>) -> [Unit<Vector3<f64>>; 3] {
    let helper = if normal.x.abs() < 0.9 { Vector3::x() } else { Vector3::y() };
    let x = Unit::new_normalize(helper - normal.into_inner() * normal.dot(&helper));
    [x, Unit::new_normalize(normal.cross(&x)), normal]
}

/// Converts a pose of a URDF.
pub(crate) fn isometry(pose: &Pose) -> Isometry3<f64> {
    let [x, y, z] = pose.xyz;
    let [i, j, k, w] = pose.quaternion_xyzw;
    Isometry3::from_parts(
        Translation3::new(x, y, z),
        UnitQuaternion::new_unchecked(Quaternion::new(w, i, j, k)),
    )
}

/// Configuration `index` of the R sequence over the sampling ranges (Roberts 2018: multiples of powers of a
/// generalised golden ratio); the middle for index 0. O(degrees of freedom).
///
/// ```
/// use motet_geometry::KinematicTree;
/// use motet_geometry::kinematics::quasi_random;
/// use motet_robots::builtin;
///
/// let tree = KinematicTree::new(&builtin::robot("panda").unwrap().urdf);
/// assert!((0..100).all(|index| tree.allows(&quasi_random(tree.dofs(), index))));
/// ```
#[must_use]
pub fn quasi_random(dofs: &[Dof], index: usize) -> Vec<f64> {
    quasi_random_in(dofs.iter().map(Dof::sampling_range), index)
}

/// Point `index` of the R sequence over some ranges.
pub(crate) fn quasi_random_in(ranges: impl ExactSizeIterator<Item = (f64, f64)>, index: usize) -> Vec<f64> {
    // The root of x^(n+1) = x + 1: this iteration converges from any start.
    let mut ratio = 1.5_f64;
    for _ in 0..40 {
        ratio = libm::pow(1.0 + ratio, 1.0 / (ranges.len() as f64 + 1.0));
    }
    let mut power = 1.0;
    let values = ranges.map(|(lower, upper)| {
        power /= ratio;
        let part = 0.5 + power * index as f64;
        lower + (part - libm::floor(part)) * (upper - lower)
    });
    values.collect()
}

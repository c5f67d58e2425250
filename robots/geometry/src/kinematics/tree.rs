//! The joints of a robot as a flat list, each after the one that carries it, and the variables that move them.

use std::f64::consts::{PI, TAU};

use motet_robots::urdf::{Joint, JointKind, Limits, Pose, Urdf};
use nalgebra::{Isometry3, Quaternion, Translation3, Unit, UnitQuaternion, Vector3};
use smol_str::{SmolStr, format_smolstr};

/// A robot's kinematics: links, and variables that move them.
///
/// A *configuration* is one number for each variable, in the order of [`Tree::variables`]. A revolute, continuous or
/// prismatic joint that follows no other has one variable of its name. A planar joint has three, `NAME/x`, `NAME/y` and
/// `NAME/theta`. The position of a joint that follows others is a multiple of one variable plus an offset, which is
/// worked out here once; the variable's limits are those of the joint and of all that follow it.
#[derive(Clone, PartialEq, Debug)]
pub struct Tree {
    pub(super) links: Vec<SmolStr>,
    /// Index of the step that places a link; `None` for the root.
    pub(super) placed_by: Vec<Option<usize>>,
    pub(super) root: usize,
    variables: Vec<Variable>,
    pub(super) steps: Vec<Step>,
}

/// What a robot moves by itself.
#[derive(Clone, PartialEq, Debug)]
pub struct Variable {
    /// Its name.
    pub name: SmolStr,
    /// Least and greatest value in rad or m; `None` where it has no limits.
    pub limits: Option<(f64, f64)>,
    /// Whether a full turn brings it back, so that it is an angle without limits.
    pub is_turn: bool,
    /// Whether it is a length in m, and no angle.
    pub slides: bool,
}

/// Limits as far from 0 as that on both sides, in rad and in m, are none: "unlimited" is often written as 1e16.
const UNLIMITED: [f64; 2] = [1000.0 * TAU, 1000.0];

impl Variable {
    /// Whether a value lies within the limits, both ends included.
    #[must_use]
    pub fn allows(&self, value: f64) -> bool {
        self.limits.is_none_or(|(lower, upper)| lower <= value && value <= upper) && value.is_finite()
    }

    /// Where values are looked for: within the limits, of an angle within one full turn, about 0 as far as they allow it; half a turn or
    /// 1 m either way where there are none.
    #[must_use]
    pub fn span(&self) -> (f64, f64) {
        match self.limits {
            None if self.is_turn => (-PI, PI),
            None => (-1.0, 1.0),
            Some((lower, upper)) if upper - lower > TAU && !self.slides => {
                let least = (-PI).clamp(lower, upper - TAU);
                (least, least + TAU)
            }
            Some((lower, upper)) if self.slides => {
                let [_, most] = UNLIMITED;
                (lower.clamp(-most, most), upper.clamp(-most, most))
            }
            Some(limits) => limits,
        }
    }

    /// Room to the nearer limit in rad or m, negative outside; infinite where there is no limit.
    #[must_use]
    pub fn room(&self, value: f64) -> f64 {
        self.limits.map_or(f64::INFINITY, |(lower, upper)| (value - lower).min(upper - value))
    }
}

/// From a link to the next: a fixed pose, then at most one motion.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Step {
    pub(super) parent: usize,
    pub(super) child: usize,
    pub(super) parent_from_joint: Isometry3<f64>,
    pub(super) motion: Motion,
}

/// What a step moves.
#[derive(Clone, PartialEq, Debug)]
pub(super) enum Motion {
    /// Nothing.
    Fixed,
    /// A rotation about an axis.
    Turn(Unit<Vector3<f64>>, Driver),
    /// A shift along an axis.
    Slide(Unit<Vector3<f64>>, Driver),
    /// A shift along two axes, then a rotation about the third; the three variables follow each other.
    Planar {
        /// Directions of x, y and the normal.
        axes: [Unit<Vector3<f64>>; 3],
        /// Index of the variable for x.
        first: usize,
    },
}

/// A joint position in terms of a variable: `multiplier * variable + offset`.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Driver {
    /// Index of the variable.
    pub variable: usize,
    /// Factor.
    pub multiplier: f64,
    /// Offset in rad or m.
    pub offset: f64,
}

impl Driver {
    /// The joint's position.
    #[must_use]
    pub fn position(&self, configuration: &[f64]) -> f64 {
        self.multiplier * configuration.get(self.variable).copied().unwrap_or(0.0) + self.offset
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

impl Tree {
    /// The tree of a URDF. O(links + joints).
    #[must_use]
    pub fn new(urdf: &Urdf) -> Self {
        let mut variables = Vec::new();
        let mut is_followed = vec![false; urdf.joints.len()];
        for mimic in urdf.joints.iter().filter_map(|joint| joint.mimic) {
            is_followed.get_mut(mimic.joint).into_iter().for_each(|slot| *slot = true);
        }
        let joints = urdf.joints.iter().zip(is_followed);
        let drivers: Vec<Option<Driver>> =
            joints.map(|(joint, is_followed)| own_variable(joint, is_followed, &mut variables)).collect();
        let steps = urdf.joints.iter().zip(0..).map(|(joint, at)| {
            let axis = Unit::new_unchecked(Vector3::from(joint.axis));
            let motion = match (joint.kind, resolved(urdf, &drivers, at)) {
                (JointKind::Revolute | JointKind::Continuous, Some(driver)) => Motion::Turn(axis, driver),
                (JointKind::Prismatic, Some(driver)) => Motion::Slide(axis, driver),
                (JointKind::Planar, Some(driver)) => {
                    Motion::Planar { axes: plane(axis), first: driver.variable }
                }
                (JointKind::Fixed | JointKind::Floating, _) | (_, None) => Motion::Fixed,
            };
            Step {
                parent: joint.parent,
                child: joint.child,
                parent_from_joint: isometry(&joint.parent_from_joint),
                motion,
            }
        });
        let steps: Vec<Step> = steps.collect();
        let mut placed_by = vec![None; urdf.links.len()];
        for (step, at) in steps.iter().zip(0..) {
            if let Some(slot) = placed_by.get_mut(step.child) {
                *slot = Some(at);
            }
        }
        let links = urdf.links.iter().map(|link| link.name.clone()).collect();
        Self { links, placed_by, root: urdf.root, variables, steps }
    }

    /// The variables, in the order of a configuration.
    #[must_use]
    pub fn variables(&self) -> &[Variable] {
        &self.variables
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
    pub fn variable(&self, name: &str) -> Result<usize, UnknownName> {
        self.variables.iter().position(|known| known.name == name).ok_or_else(|| UnknownName(name.into()))
    }

    /// A configuration with zero where the limits allow it, else the nearer limit.
    #[must_use]
    pub fn neutral(&self) -> Vec<f64> {
        self.variables.iter().map(|known| known.limits.map_or(0.0, |(l, u)| 0.0_f64.clamp(l, u))).collect()
    }

    /// Whether a configuration is within the limits of every variable.
    #[must_use]
    pub fn allows(&self, configuration: &[f64]) -> bool {
        configuration.len() == self.variables.len()
            && self.variables.iter().zip(configuration).all(|(known, value)| known.allows(*value))
    }
}

/// The variable of a joint that follows no other.
fn own_variable(joint: &Joint, is_followed: bool, variables: &mut Vec<Variable>) -> Option<Driver> {
    if joint.mimic.is_some() {
        return None;
    }
    let first = variables.len();
    let slides = joint.kind == JointKind::Prismatic;
    let [angle, length] = UNLIMITED;
    let most = if slides { length } else { angle };
    let limits = joint.limits.map(|Limits { lower, upper }| (lower, upper));
    // One that is followed has limits for the sake of others, in whatever unit.
    let limits = limits.filter(|(lower, upper)| is_followed || -most < *lower || *upper < most);
    match joint.kind {
        JointKind::Fixed | JointKind::Floating => return None,
        JointKind::Revolute | JointKind::Continuous | JointKind::Prismatic => {
            let is_turn = !slides && limits.is_none();
            variables.push(Variable { name: joint.name.clone(), limits, is_turn, slides });
        }
        JointKind::Planar => {
            for part in ["x", "y", "theta"] {
                let name = format_smolstr!("{}/{part}", joint.name);
                let is_turn = part == "theta";
                variables.push(Variable { name, limits: None, is_turn, slides: !is_turn });
            }
        }
    }
    Some(Driver { variable: first, multiplier: 1.0, offset: 0.0 })
}

/// What moves a joint in the end: follows the chain of mimic rules, which has no ring.
fn resolved(urdf: &Urdf, drivers: &[Option<Driver>], joint: usize) -> Option<Driver> {
    let (mut multiplier, mut offset, mut at) = (1.0, 0.0, joint);
    while let Some(mimic) = urdf.joints.get(at)?.mimic {
        offset += multiplier * mimic.offset;
        multiplier *= mimic.multiplier;
        at = mimic.joint;
    }
    let variable = drivers.get(at).copied().flatten()?.variable;
    Some(Driver { variable, multiplier, offset })
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

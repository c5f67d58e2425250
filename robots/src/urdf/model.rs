//! A URDF after reading: names are unique, every number is finite and in range, and the links form one tree.

use smol_str::SmolStr;

/// A robot's links and joints. There is at least one link.
#[derive(Clone, PartialEq, Debug)]
pub struct Urdf {
    /// What the file calls the robot; may be empty.
    pub name: SmolStr,
    /// The links, in the order of the file.
    pub links: Vec<Link>,
    /// The joints, each after the joint that carries its parent link.
    pub joints: Vec<Joint>,
    /// Index of the link that no joint moves.
    pub root: usize,
    /// Pairs of links whose collision does not count, the lower index first: none from the file itself, what
    /// [`crate::srdf::read`] finds in an SRDF.
    pub may_touch: Vec<[usize; 2]>,
}

impl Urdf {
    /// Index of the link with this name. O(links).
    #[must_use]
    pub fn link(&self, name: &str) -> Option<usize> {
        self.links.iter().position(|link| link.name == name)
    }

    /// Index of the joint with this name. O(joints).
    #[must_use]
    pub fn joint(&self, name: &str) -> Option<usize> {
        self.joints.iter().position(|joint| joint.name == name)
    }

    /// The joint that carries a link; `None` for the root. O(joints).
    #[must_use]
    pub fn carrier(&self, link: usize) -> Option<&Joint> {
        self.joints.iter().find(|joint| joint.child == link)
    }
}

/// A rigid part.
#[derive(Clone, PartialEq, Debug)]
pub struct Link {
    /// Its name, unique among links.
    pub name: SmolStr,
    /// Its shapes for collision, in the link's frame.
    pub collisions: Vec<LinkShape>,
    /// Its shapes for showing, in the link's frame.
    pub visuals: Vec<LinkShape>,
}

/// A shape somewhere on a link.
#[derive(Clone, PartialEq, Debug)]
pub struct LinkShape {
    /// Pose of the shape's centre in the link's frame.
    pub link_from_shape: Pose,
    /// What it is.
    pub shape: UrdfShape,
}

/// A shape, centred at its origin; lengths in m, none negative.
#[derive(Clone, PartialEq, Debug)]
pub enum UrdfShape {
    /// A box with its full extents along x, y and z.
    Box([f64; 3]),
    /// A cylinder along z.
    Cylinder {
        /// Radius.
        radius: f64,
        /// Full length.
        length: f64,
    },
    /// A capsule along z.
    Capsule {
        /// Radius of the tube and of both ends.
        radius: f64,
        /// Length of the tube, without the round ends.
        length: f64,
    },
    /// A sphere.
    Sphere {
        /// Radius.
        radius: f64,
    },
    /// Triangles from a file.
    Mesh {
        /// The file as the URDF names it: `package://…`, `file://…` or a path beside the URDF.
        file: String,
        /// Factors along x, y and z, none zero; a negative one mirrors.
        scale: [f64; 3],
    },
}

/// A rigid transform.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Pose {
    /// Translation in m.
    pub xyz: [f64; 3],
    /// Rotation as a unit quaternion, x, y, z, w.
    pub quaternion_xyzw: [f64; 4],
}

impl Pose {
    /// No motion at all.
    pub const IDENTITY: Self = Self { xyz: [0.0; 3], quaternion_xyzw: [0.0, 0.0, 0.0, 1.0] };
}

/// How a link hangs on its parent.
#[derive(Clone, PartialEq, Debug)]
pub struct Joint {
    /// Its name, unique among joints.
    pub name: SmolStr,
    /// What it allows.
    pub kind: JointKind,
    /// Index of the link that it hangs on.
    pub parent: usize,
    /// Index of the link that it moves.
    pub child: usize,
    /// Pose of the joint, and of the child at position 0, in the parent's frame.
    pub parent_from_joint: Pose,
    /// Unit vector in the joint's frame: axis of rotation, direction of travel, or normal of the plane.
    pub axis: [f64; 3],
    /// Range of positions in rad or m; `None` for a joint without (fixed, continuous, planar, floating). For one
    /// that moves by itself it is where all that follow it are within theirs, too.
    pub limits: Option<JointLimits>,
    /// Greatest speed in rad/s or m/s; `None` where the file gives none.
    pub velocity: Option<f64>,
    /// The joint that it follows. No chain of these comes back to itself.
    pub mimic: Option<Mimic>,
}

/// The kind of a joint.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum JointKind {
    /// Does not move.
    Fixed,
    /// Turns within limits.
    Revolute,
    /// Turns without limits.
    Continuous,
    /// Slides within limits.
    Prismatic,
    /// Slides in a plane and turns about its normal.
    Planar,
    /// Moves freely; held at its origin, which a warning says.
    Floating,
}

impl JointKind {
    /// The kinds by the word that a URDF uses.
    pub const WORDS: [(&'static str, Self); 6] = [
        ("fixed", Self::Fixed),
        ("revolute", Self::Revolute),
        ("continuous", Self::Continuous),
        ("prismatic", Self::Prismatic),
        ("planar", Self::Planar),
        ("floating", Self::Floating),
    ];

    /// Whether one number says where it is.
    #[must_use]
    pub fn has_one_position(self) -> bool {
        matches!(self, Self::Revolute | Self::Continuous | Self::Prismatic)
    }
}

/// A closed interval of joint positions; `lower <= upper`, both finite.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct JointLimits {
    /// Least, in rad or m.
    pub lower: f64,
    /// Greatest.
    pub upper: f64,
}

/// A joint that follows another: `position = multiplier * other + offset`.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Mimic {
    /// Index of the joint that it follows.
    pub joint: usize,
    /// Factor.
    pub multiplier: f64,
    /// Offset in rad or m.
    pub offset: f64,
}

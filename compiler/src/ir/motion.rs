//! The closed set of motion queries that a contract can ask for.

use std::fmt;

/// Kind of a motion query.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum MotionKind {
    GoTo,
    Reach,
    Put,
    Pull,
    Push,
    Offer,
    Look,
    Posture,
}

impl MotionKind {
    /// All kinds, in the order of the language page.
    pub(crate) const ALL: &[Self] =
        &[Self::GoTo, Self::Reach, Self::Put, Self::Pull, Self::Push, Self::Offer, Self::Look, Self::Posture];

    /// Name of the motion in a contract.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::GoTo => "go_to",
            Self::Reach => "reach",
            Self::Put => "put",
            Self::Pull => "pull",
            Self::Push => "push",
            Self::Offer => "offer",
            Self::Look => "look",
            Self::Posture => "posture",
        }
    }

    /// Kind with a name.
    pub(crate) fn from_name(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|kind| kind.name() == name)
    }

    /// Number of arguments.
    pub(crate) const fn arity(self) -> usize {
        match self {
            Self::Put | Self::Offer => 2,
            Self::GoTo | Self::Reach | Self::Pull | Self::Push | Self::Look | Self::Posture => 1,
        }
    }

    /// Returns whether the motion changes the pose of the robot or of a thing. The head may turn in `look`,
    /// but no pose
    /// that is tracked changes.
    pub(crate) fn moves(self) -> bool {
        self != Self::Look
    }
}

impl fmt::Display for MotionKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

#[cfg(test)]
mod tests {
    use super::MotionKind;

    #[test]
    fn motion_kind_from_name_inverts_name() {
        for kind in MotionKind::ALL {
            assert_eq!(MotionKind::from_name(kind.name()), Some(*kind));
        }
        assert_eq!(MotionKind::from_name("fly"), None);
    }
}

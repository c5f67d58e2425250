//! Rules for the place of a thing on its support, and poses in the map, as parts of a motion query; and the
//! reasons for which no place fits.

use std::fmt;

use motet_robots::scene::{PLACED_BESIDE_M, PLACED_NEAR_M};
use smol_str::SmolStr;

/// Finite number with an identity: two are equal if their bits are.
#[derive(Clone, Copy, Debug, Default)]
pub struct ExactNumber(f64);

impl ExactNumber {
    /// The number; 0 for one that is not finite.
    #[must_use]
    pub fn new(value: f64) -> Self {
        // The sum makes the negative zero positive.
        Self(if value.is_finite() { value + 0.0 } else { 0.0 })
    }

    /// The number as a float.
    #[must_use]
    pub fn get(self) -> f64 {
        self.0
    }
}

impl PartialEq for ExactNumber {
    fn eq(&self, other: &Self) -> bool {
        self.0.to_bits() == other.0.to_bits()
    }
}

impl Eq for ExactNumber {}

impl std::hash::Hash for ExactNumber {
    fn hash<H: std::hash::Hasher>(&self, state: &mut H) {
        self.0.to_bits().hash(state);
    }
}

/// Upright pose in the map: a point and a turn about the vertical.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct MapPose {
    xyz: [ExactNumber; 3],
    yaw: ExactNumber,
}

impl MapPose {
    /// Pose of a point in m and a yaw in rad. A height of 0 leaves the height open.
    #[must_use]
    pub fn new(xyz: [f64; 3], yaw: f64) -> Self {
        Self { xyz: xyz.map(ExactNumber::new), yaw: ExactNumber::new(yaw) }
    }

    /// Point in m.
    #[must_use]
    pub fn xyz(&self) -> [f64; 3] {
        self.xyz.map(ExactNumber::get)
    }

    /// Turn about the vertical, in rad.
    #[must_use]
    pub fn yaw(&self) -> f64 {
        self.yaw.get()
    }
}

impl fmt::Display for MapPose {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let rounded = |value: f64| (value * 1e4).round() / 1e4 + 0.0;
        let [x, y, z] = self.xyz().map(rounded);
        let yaw = rounded(self.yaw().to_degrees());
        let height = if z == 0.0 { String::new() } else { format!("{z} m, ") };
        write!(f, "pose({x} m, {y} m, {height}{yaw} deg)")
    }
}

/// Rules for the place of a thing on its support. By default any free place does.
#[derive(Clone, PartialEq, Eq, Hash, Debug, Default)]
pub struct PlaceRules {
    /// Entity from whose outline its own is at most [`PLACED_NEAR_M`] away.
    pub near: Option<SmolStr>,
    /// Entity on the same support, from whose outline its own is [`PLACED_BESIDE_M`] away.
    pub beside: Option<SmolStr>,
    /// Least distance in m of its whole outline to the rim of the support.
    pub from_edge: ExactNumber,
    /// Set where it may also lie on a side.
    pub may_lie: bool,
    /// Pose of its middle.
    pub at: Option<MapPose>,
}

impl PlaceRules {
    /// Checks whether the rules exclude any place.
    pub(crate) fn excludes(&self) -> bool {
        self.near.is_some() || self.beside.is_some() || self.from_edge.get() > 0.0 || self.at.is_some()
    }
}

impl fmt::Display for PlaceRules {
    /// The rules as further arguments of a motion, each behind a comma.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(near) = &self.near {
            write!(f, ", near: {near}")?;
        }
        if let Some(beside) = &self.beside {
            write!(f, ", beside: {beside}")?;
        }
        if self.from_edge.get() > 0.0 {
            write!(f, ", away_from_edge: {} m", self.from_edge.get())?;
        }
        if self.may_lie {
            f.write_str(", upright: false")?;
        }
        self.at.iter().try_for_each(|at| write!(f, ", at: {at}"))
    }
}

/// Reason for which no place on a support fits the rules.
#[derive(Clone, PartialEq, Debug)]
pub enum Misfit {
    /// Every place that the rules leave is taken.
    Taken {
        on: SmolStr,
        rules: Box<PlaceRules>,
        /// Entity that takes most of them.
        by: Option<SmolStr>,
    },
    /// The thing beside which it should be is not on the support.
    Elsewhere { on: SmolStr, beside: SmolStr },
    /// Nowhere on the support is a thing as far from the rim; both in m.
    Narrow { on: SmolStr, needs: f64, limit: f64 },
    /// At the pose it sticks out beyond the support, by this length in m.
    Overhang { on: SmolStr, beyond: f64 },
    /// On the support it is at another height than the pose; both in m.
    Height { on: SmolStr, needs: f64, actual: f64 },
}

impl fmt::Display for Misfit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Taken { on, rules, by } if rules.at.is_some() => {
                write!(f, "the pose on `{on}` is not free")?;
                by.iter().try_for_each(|by| write!(f, ": `{by}` is there"))
            }
            Self::Taken { on, rules, by } => {
                let mut asked: Vec<String> = Vec::new();
                asked.extend(rules.near.iter().map(|to| format!("within {PLACED_NEAR_M:.2} m of `{to}`")));
                let [least, most] = PLACED_BESIDE_M;
                asked
                    .extend(rules.beside.iter().map(|to| format!("{least:.2} to {most:.2} m beside `{to}`")));
                let from_edge = rules.from_edge.get();
                if from_edge > 0.0 {
                    asked.push(format!("at least {from_edge:.2} m from its rim"));
                }
                let asked =
                    if asked.is_empty() { String::new() } else { format!(" {}", asked.join(" and ")) };
                write!(f, "nothing of `{on}`{asked} is free")?;
                by.iter().try_for_each(|by| write!(f, ", most often `{by}` is there"))
            }
            Self::Elsewhere { on, beside } => write!(f, "`{beside}` is not on `{on}`"),
            Self::Narrow { on, needs, limit } => {
                write!(
                    f,
                    "needs {needs:.2} m to the rim of `{on}`, there are at most {:.2} m",
                    limit.max(0.0)
                )
            }
            Self::Overhang { on, beyond } => {
                write!(f, "at the pose it reaches {beyond:.2} m beyond the rim of `{on}`")
            }
            Self::Height { on, needs, actual } => {
                write!(f, "the pose is {needs:.2} m high, on `{on}` its middle is {actual:.2} m high")
            }
        }
    }
}

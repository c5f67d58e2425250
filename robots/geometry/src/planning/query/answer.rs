//! What is asked, and what is answered.

use smol_str::SmolStr;

use crate::planning::scene::configuration::Configuration;

/// From where a thing is grasped.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum GraspSide {
    /// From above: within 35° of straight down.
    Top,
    /// From any side.
    Side,
    /// From the side on which the robot is: within 45° of the direction from its base.
    Front,
}

/// A motion that is asked for. Names are ids of the scene.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub enum MotionQuery {
    /// To a standing place from which a thing is served.
    GoTo(SmolStr),
    /// A grasp of a thing, from a side where one is given.
    Reach(SmolStr, Option<GraspSide>),
    /// What is in the hand onto a surface, or into a container.
    Put(SmolStr, SmolStr),
    /// What is in the hand held out to a person.
    Offer(SmolStr, SmolStr),
    /// A thing in view.
    Look(SmolStr),
    /// The handle of what is closed along its travel until it is open.
    Pull(SmolStr),
    /// The handle of what is open along its travel until it is closed; any other thing a little away from the robot.
    Push(SmolStr),
    /// To a posture of the card.
    Posture(SmolStr),
    /// Any other motion, which is not computed: its name.
    Other(SmolStr),
}

impl MotionQuery {
    /// A query as it is written: `reach(mug_1)`, `reach(mug_1, top)`, `go_to(sink)`. `None` where it is none.
    #[must_use]
    pub fn parse(text: &str) -> Option<Self> {
        let (name, rest) = text.trim().split_once('(')?;
        let mut args = rest.strip_suffix(')')?.split(',').map(|arg| arg.trim().trim_matches('`'));
        let (first, second, third) = (args.next().filter(|arg| !arg.is_empty())?, args.next(), args.next());
        if let ("put" | "offer", Some(second), None) = (name, second, third) {
            let (object, second) = (first.into(), second.into());
            return Some(if name == "put" { Self::Put(object, second) } else { Self::Offer(object, second) });
        }
        let side = match second {
            None | Some("auto") => None,
            Some("top") => Some(GraspSide::Top),
            Some("side") => Some(GraspSide::Side),
            Some("front") => Some(GraspSide::Front),
            Some(_) => return None,
        };
        match name {
            _ if third.is_some() => None,
            "reach" => Some(Self::Reach(first.into(), side)),
            "go_to" if second.is_none() => Some(Self::GoTo(first.into())),
            "posture" if second.is_none() => Some(Self::Posture(first.into())),
            "look" if second.is_none() => Some(Self::Look(first.into())),
            "pull" if second.is_none() => Some(Self::Pull(first.into())),
            "push" if second.is_none() => Some(Self::Push(first.into())),
            _ => None,
        }
    }
}

impl std::fmt::Display for MotionQuery {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::GoTo(to) => write!(f, "go_to({to})"),
            Self::Reach(object, None) => write!(f, "reach({object})"),
            Self::Reach(object, Some(side)) => {
                let side = match side {
                    GraspSide::Top => "top",
                    GraspSide::Side => "side",
                    GraspSide::Front => "front",
                };
                write!(f, "reach({object}, {side})")
            }
            Self::Put(object, on) => write!(f, "put({object}, {on})"),
            Self::Offer(object, to) => write!(f, "offer({object}, {to})"),
            Self::Look(at) => write!(f, "look({at})"),
            Self::Pull(what) => write!(f, "pull({what})"),
            Self::Push(what) => write!(f, "push({what})"),
            Self::Posture(name) => write!(f, "posture({name})"),
            Self::Other(name) => write!(f, "{name}(…)"),
        }
    }
}

/// How long to look; a larger one finds more and contradicts nothing.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct SearchBudget {
    /// Candidates for the base and the arm that are tried for each grasp.
    pub candidates: usize,
    /// Free candidates to which a path is looked for.
    pub paths: usize,
    /// Cells of states, and patches of grasps, that are looked at to prove that no state is free where no candidate was. What is not
    /// proven then stays a search that ended.
    pub cells: usize,
}

impl SearchBudget {
    /// So many times as large.
    #[must_use]
    pub fn times(self, factor: usize) -> Self {
        let [candidates, paths, cells] =
            [self.candidates, self.paths, self.cells].map(|count| count.saturating_mul(factor));
        Self { candidates, paths, cells }
    }
}

impl Default for SearchBudget {
    fn default() -> Self {
        Self { candidates: 512, paths: 64, cells: 32_768 }
    }
}

/// The answer to a query.
#[derive(Clone, PartialEq, Debug)]
pub enum MotionAnswer {
    /// There is such a motion: this one.
    Feasible(Box<MotionWitness>),
    /// There is none, or the search, which was not cut short, found none: see [`Infeasible::certified`].
    Infeasible(Infeasible),
    /// It is not known.
    Unknown(UnknownReason),
}

/// A motion that was found.
#[derive(Clone, PartialEq, Debug)]
pub struct MotionWitness {
    /// States from where the robot is to the last; between two the robot moves straight in base and joints.
    pub path: Vec<Configuration>,
    /// The grasp, where one was asked for. The last leg of the path brings the hand to it from in front of the thing, which the
    /// hand may touch on that leg.
    pub grasp: Option<Grasp>,
    /// How much room there is.
    pub margins: Margins,
}

/// How a thing is held.
#[derive(Clone, PartialEq, Debug)]
pub struct Grasp {
    /// What.
    pub object: SmolStr,
    /// From where.
    pub side: GraspSide,
    /// The pose of the hand's tip in the map.
    pub map_from_tip: nalgebra::Isometry3<f64>,
    /// The pose of the thing in the tip's frame.
    pub tip_from_object: nalgebra::Isometry3<f64>,
    /// How wide the hand has to be open, in m.
    pub width: f64,
}

/// Room to spare.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Margins {
    /// The least distance to what stands around and to the floor, in m and at most 1, at the way-points and half-way between
    /// them; on the whole way it is at least [`super::MIN_CLEARANCE`].
    pub clearance: f64,
    /// Room of the last state to the nearest limit of a joint that the motion moved, in rad or m; `None` where none was.
    pub limit: Option<f64>,
    /// What the hand could carry beyond, in kg; `None` where no mass is known.
    pub payload: Option<f64>,
}

/// Why there is no motion.
#[derive(Clone, PartialEq, Debug)]
pub struct Infeasible {
    /// The kind.
    pub reason: InfeasibleReason,
    /// What would help, where something is known to.
    pub change: Option<String>,
    /// Whether it is proven, for all ways to grip and not only those that are tried; else the search ended without finding anything.
    pub certified: bool,
    /// A free state with the hand where it is wanted, where one was found to which no way was; never where it is proven that there
    /// is none.
    pub configuration: Option<Box<Configuration>>,
}

impl Infeasible {
    /// What is proven.
    pub(crate) fn proven(reason: InfeasibleReason, change: Option<String>) -> Self {
        Self { reason, change, certified: true, configuration: None }
    }

    /// What a search that ended says.
    pub(crate) fn exhausted(reason: InfeasibleReason) -> Self {
        Self { reason, change: None, certified: false, configuration: None }
    }
}

/// The reasons of the language.
#[derive(Clone, PartialEq, Debug)]
pub enum InfeasibleReason {
    /// It is too far away, too high or too low: what is needed and what is reached, both in m, and in which direction.
    OutOfReach {
        /// What is measured: `height`, `distance`, or `sight`.
        what: &'static str,
        /// What is needed.
        needs: f64,
        /// What is reached.
        reach: f64,
    },
    /// Every configuration touches something: most often this.
    NoFreePose {
        /// What is touched most often.
        by: Option<SmolStr>,
        /// How often, where that was counted.
        share: Option<ContactShare>,
    },
    /// There are free configurations, and no way to one was found.
    BlockedPath {
        /// What is touched most often on the way.
        by: Option<SmolStr>,
    },
    /// No camera sees it from here: what hides it, where something does.
    NotInView {
        /// What stands before it most often.
        by: Option<SmolStr>,
        /// Where it is beyond the camera's view, by how much.
        aside: Option<BearingLimit>,
    },
    /// It weighs more than the hand carries, both in kg.
    TooHeavy {
        /// Its mass.
        needs: f64,
        /// The payload.
        limit: f64,
    },
    /// It is wider than the hand opens, both in m.
    TooWide {
        /// Its least width.
        needs: f64,
        /// The opening.
        limit: f64,
    },
}

impl InfeasibleReason {
    /// Its name in the language.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::OutOfReach { .. } => "out_of_reach",
            Self::NoFreePose { .. } => "no_free_pose",
            Self::BlockedPath { .. } => "blocked_path",
            Self::NotInView { .. } => "not_in_view",
            Self::TooHeavy { .. } => "too_heavy",
            Self::TooWide { .. } => "too_wide",
        }
    }
}

impl std::fmt::Display for InfeasibleReason {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::OutOfReach { what: "sight", needs, reach } => {
                write!(f, "is {needs:.2} m away, the camera sees {reach:.2} m")
            }
            Self::NotInView { by: Some(by), .. } => write!(f, "{} hides it from the camera", named(by)),
            Self::NotInView { by: None, aside: Some(BearingLimit { needs, limit }) } => {
                let (to, needs) = (if *needs > 0.0 { "left" } else { "right" }, needs.abs().to_degrees());
                write!(
                    f,
                    "is {needs:.0}° to the {to}, the camera sees {:.0}° to either side",
                    limit.to_degrees()
                )
            }
            Self::NotInView { by: None, aside: None } => f.write_str("the camera does not turn there"),
            Self::OutOfReach { what, needs, reach } => {
                write!(f, "needs a {what} of {needs:.2} m, the hand reaches {reach:.2} m")
            }
            Self::NoFreePose { by: Some(by), share } => {
                write!(f, "no pose of the robot is free, and most often {} is in the way", named(by))?;
                match share {
                    Some(ContactShare { touching, tried }) => {
                        write!(f, " ({touching} of {tried} that were tried)")
                    }
                    None => Ok(()),
                }
            }
            Self::NoFreePose { by: None, .. } => f.write_str("no pose of the robot serves it"),
            Self::BlockedPath { by: Some(by) } => write!(f, "{} blocks the way", named(by)),
            Self::BlockedPath { by: None } => f.write_str("no way leads there"),
            Self::TooHeavy { needs, limit } => {
                write!(f, "weighs {needs:.2} kg, the hand carries {limit:.2} kg")
            }
            Self::TooWide { needs, limit } => {
                write!(f, "is {needs:.3} m wide, the hand opens to {limit:.3} m")
            }
        }
    }
}

/// How many poses touch something, of those of the robot or, where none is free of the hand alone, of the hand that were tried.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct ContactShare {
    /// Those that touch it before anything else that is looked at.
    pub touching: usize,
    /// All.
    pub tried: usize,
}

/// How far aside of the direction of the base something is, and how far the camera sees: both in rad, the first positive to the
/// left, the second to either side.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct BearingLimit {
    /// Where it is.
    pub needs: f64,
    /// How far the camera sees.
    pub limit: f64,
}

/// What is in the way, as it is written: the robot itself has no name in the scene.
fn named(by: &str) -> String {
    if by.starts_with(ITSELF) { by.to_owned() } else { format!("`{by}`") }
}

/// How the robot is called where it is in its own way.
pub(crate) const ITSELF: &str = "the robot itself";

/// Why nothing is known.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum UnknownReason {
    /// The search was cut short.
    Budget,
    /// The question cannot be asked of this robot in this scene, or not yet of any.
    Because(String),
}

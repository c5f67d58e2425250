//! Things of the cases, as in InteLiPlan's table II: those of the rooms, or others in their places that no
//! word list, scene or row of a dataset knows.

use std::str::FromStr;

use motet_robots::scene::{Entity, EntityShape, Scene};

use super::rooms::{Named, Room};

/// Things of the cases.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Objects {
    /// Those of the rooms.
    #[default]
    Seen,
    /// Others, which no word list knows.
    Unseen,
}

impl FromStr for Objects {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "seen" => Ok(Self::Seen),
            "unseen" => Ok(Self::Unseen),
            _ => Err(format!("objects are `seen` or `unseen`, and not `{text}`")),
        }
    }
}

/// Names of the unseen things, with their extents in m and their mass in kg. Either robot can carry them.
pub const UNSEEN: [(&str, [f64; 3], f64); 20] = [
    ("harmonica", [0.10, 0.03, 0.03], 0.10),
    ("stapler", [0.13, 0.04, 0.05], 0.25),
    ("tape measure", [0.06, 0.04, 0.06], 0.20),
    ("metronome", [0.06, 0.06, 0.12], 0.30),
    ("kaleidoscope", [0.05, 0.05, 0.15], 0.15),
    ("abacus", [0.12, 0.03, 0.09], 0.20),
    ("figurine", [0.05, 0.05, 0.11], 0.15),
    ("padlock", [0.05, 0.03, 0.07], 0.20),
    ("corkscrew", [0.10, 0.04, 0.04], 0.15),
    ("whistle", [0.05, 0.03, 0.03], 0.05),
    ("sextant", [0.06, 0.06, 0.10], 0.30),
    ("castanet", [0.07, 0.06, 0.04], 0.08),
    ("thimble", [0.03, 0.03, 0.04], 0.03),
    ("shuttlecock", [0.06, 0.06, 0.08], 0.03),
    ("hourglass", [0.06, 0.06, 0.13], 0.20),
    ("yo-yo", [0.06, 0.04, 0.06], 0.08),
    ("trophy", [0.06, 0.06, 0.14], 0.30),
    ("periscope", [0.05, 0.05, 0.15], 0.20),
    ("gyroscope", [0.06, 0.06, 0.08], 0.15),
    ("ocarina", [0.10, 0.05, 0.05], 0.15),
];

/// The thing of a case: its id, and its name with an article.
#[derive(Clone, Debug)]
pub(super) struct CaseThing {
    pub(super) id: String,
    pub(super) name: String,
    /// Things that stand where those of the room did.
    pub(super) swaps: Vec<Swap>,
}

/// Unseen thing in the place of one of the room.
#[derive(Clone, Debug)]
pub(super) struct Swap {
    /// Thing of the room.
    of: &'static str,
    /// Number of the unseen thing.
    index: usize,
    /// Word that tells it apart from another of its kind.
    colour: Option<&'static str>,
}

impl CaseThing {
    fn seen((id, name): Named) -> Self {
        Self { id: id.to_owned(), name: name.to_owned(), swaps: Vec::new() }
    }
}

impl Objects {
    /// The thing of a turn in a room.
    pub(super) fn thing(self, room: &Room, turn: usize) -> Option<CaseThing> {
        let seen = *room.things.get(turn % room.things.len().max(1))?;
        match self {
            Self::Seen => Some(CaseThing::seen(seen)),
            Self::Unseen => {
                let swap = Swap { of: seen.0, index: turn % UNSEEN.len(), colour: None };
                Some(CaseThing { id: swap.id(), name: format!("the {}", swap.name()), swaps: vec![swap] })
            }
        }
    }

    /// The thing of a turn that shares its name with another, and the answers that tell it apart.
    pub(super) fn shared(self, room: &Room, turn: usize) -> Option<(CaseThing, Vec<String>)> {
        match self {
            Self::Seen => {
                let (name, id, told) = room.shared;
                Some((CaseThing::seen((id, name)), told.iter().map(|told| (*told).to_owned()).collect()))
            }
            Self::Unseen => {
                let count = room.things.len().max(1);
                let (one, other) = (room.things.get(turn % count)?, room.things.get((turn + 1) % count)?);
                let swap = |of, colour| Swap { of, index: turn % UNSEEN.len(), colour: Some(colour) };
                let (red, blue) = (swap(one.0, "red"), swap(other.0, "blue"));
                let told = vec!["the red one".to_owned(), format!("the red {}", red.name())];
                let (id, name) = (red.id(), format!("the {}", red.name()));
                Some((CaseThing { id, name, swaps: vec![red, blue] }, told))
            }
        }
    }
}

impl Swap {
    fn name(&self) -> &'static str {
        UNSEEN.get(self.index).map_or("", |(name, ..)| name)
    }

    fn id(&self) -> String {
        let stem = self.name().replace([' ', '-'], "_");
        self.colour.map_or_else(|| stem.clone(), |colour| format!("{stem}_{colour}"))
    }

    /// Puts the unseen thing where the one of the room stands.
    pub(super) fn make(&self, scene: &mut Scene) {
        let Some((name, sides, mass)) = UNSEEN.get(self.index) else { return };
        let Some(old) = scene.entities.shift_remove(self.of) else { return };
        let before = old.shape.as_ref().and_then(height);
        let pose = old.pose.map(|mut pose| {
            pose.xyz[2] += before.map_or(0.0, |before| (sides[2] - before) / 2.0);
            pose
        });
        let own = self.colour.map_or_else(|| (*name).to_owned(), |colour| format!("{colour} {name}"));
        let new = Entity {
            id: self.id().into(),
            class: (*name).into(),
            names: vec![own.into()],
            categories: Vec::new(),
            pose,
            shape: Some(EntityShape::Box(*sides)),
            mass_kg: Some(*mass),
            ..old
        };
        scene.entities.insert(new.id.clone(), new);
    }
}

fn height(shape: &EntityShape) -> Option<f64> {
    match *shape {
        EntityShape::Box([_, _, high]) => Some(high),
        EntityShape::Cylinder { height, .. } => Some(height),
        EntityShape::Sphere { radius } => Some(2.0 * radius),
        EntityShape::Capsule { radius, height } => Some(height + 2.0 * radius),
        EntityShape::Mesh { .. } => None,
    }
}

//! Faults in files of rows: unreadable rows, plans that cannot run on their robot, different replies to one
//! input, repeated rows, scenes in more than one file, and missing images.

use indexmap::IndexMap;
use motet_geometry::planning::SearchBudget;
use motet_planner::inteliplan::actions;
use motet_requests::RequestContext;
use motet_robots::scene::Scene;
use rustc_hash::{FxHashMap, FxHashSet};
use smol_str::SmolStr;

use crate::format::{self, Read, Target};
use crate::testbed::{Body, Posture, Testbed};

/// RowFault of a row.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum RowFault {
    /// It is no row in any of the forms.
    Unreadable,
    /// Neither the row nor anybody else says on which robot and in which scene its plan is to run.
    NoWorld,
    /// Its plan cannot run there.
    CannotRun,
    /// The same input has another answer elsewhere.
    Contradiction,
    /// The same input has the same answer elsewhere.
    Duplicate,
    /// Its scene is in another file too.
    Leak,
    /// A picture is missing, cannot be read, or has no place in the row; or no row refers to it.
    Image,
}

impl RowFault {
    /// As it is written in reports.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Unreadable => "unreadable",
            Self::NoWorld => "no_world",
            Self::CannotRun => "cannot_run",
            Self::Contradiction => "contradiction",
            Self::Duplicate => "duplicate",
            Self::Leak => "leak",
            Self::Image => "image",
        }
    }
}

/// A row: its file, and its line from 1.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Place {
    /// The file's name.
    pub file: String,
    /// The line, from 1; 0 of a file as a whole.
    pub row: usize,
}

/// Something that is wrong with a row.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Finding {
    pub at: Place,
    pub fault: RowFault,
    /// The same in words.
    pub message: String,
    /// The other row, where two are compared.
    pub other: Option<Place>,
}

/// The robots and scenes that rows can be about.
#[derive(Clone, Debug, Default)]
pub struct Worlds {
    /// Robots by name.
    pub bodies: IndexMap<SmolStr, Body>,
    /// Scenes by name.
    pub scenes: IndexMap<SmolStr, Scene>,
    /// State of the robot's body in scenes where it is not that of the card.
    pub postures: IndexMap<SmolStr, Posture>,
    /// The robot of rows that name none.
    pub robot: Option<SmolStr>,
    /// The scene of rows that name none.
    pub scene: Option<SmolStr>,
    /// Budget of a motion search; without one, no motion is searched.
    pub effort: Option<SearchBudget>,
}

/// Looks after the pictures that rows refer to.
pub trait ImageCheck {
    /// Checks the image at a path that a row of `file` names, and returns its fault.
    fn fault(&mut self, file: &str, path: &str) -> Option<String>;
}

/// Looks at the rows of files, one after the other.
pub struct Linter<'w> {
    worlds: &'w Worlds,
    images: Option<&'w mut dyn ImageCheck>,
    /// Robot and scene of the row before, and their testbed: rows of one scene mostly follow each other.
    testbed: Option<((SmolStr, SmolStr), Result<Testbed, String>)>,
    /// Faults of the replies on this testbed: many inputs have the same one.
    faults: FxHashMap<Target, Option<String>>,
    /// Inputs, with the answer and where it stands.
    inputs: FxHashMap<String, (String, Place)>,
    /// In which file a scene, or a variation of it, was first.
    families: FxHashMap<SmolStr, Place>,
    leaked: FxHashSet<(String, SmolStr)>,
}

impl<'w> Linter<'w> {
    /// Looks at rows about these robots and scenes.
    #[must_use]
    pub fn new(worlds: &'w Worlds) -> Self {
        Self {
            worlds,
            images: None,
            testbed: None,
            faults: FxHashMap::default(),
            inputs: FxHashMap::default(),
            families: FxHashMap::default(),
            leaked: FxHashSet::default(),
        }
    }

    /// Has the pictures of rows looked at, too.
    #[must_use]
    pub fn with_images(self, images: &'w mut dyn ImageCheck) -> Self {
        Self { images: Some(images), ..self }
    }

    /// Checks line `number` of a file, counted from 1. An empty line has no fault.
    pub fn line(&mut self, file: &str, number: usize, line: &str) -> Vec<Finding> {
        if line.trim().is_empty() {
            return Vec::new();
        }
        let at = Place { file: file.to_owned(), row: number };
        let mut found = Vec::new();
        let mut find = |fault, message: String, other: Option<Place>| {
            found.push(Finding { at: at.clone(), fault, message, other });
        };
        let row = match format::read(line) {
            Ok(row) => row,
            Err(why) => {
                find(RowFault::Unreadable, why, None);
                return found;
            }
        };
        let (input, target) = (normal(&row.input), squeezed(row.target.text()));
        match self.inputs.get(&input) {
            Some((known, other)) if *known == target => {
                find(
                    RowFault::Duplicate,
                    "the same input with the same answer".to_owned(),
                    Some(other.clone()),
                );
            }
            Some((_, other)) => {
                let message = "the same input has another answer".to_owned();
                find(RowFault::Contradiction, message, Some(other.clone()));
            }
            None => {
                self.inputs.insert(input, (target, at.clone()));
            }
        }
        if let Some(other) = self.leak(&row, &at) {
            let message = format!("its scene `{}` is in another file too", family(&other.1));
            find(RowFault::Leak, message, Some(other.0));
        }
        if let Some(places) = row.places.filter(|places| *places != row.images.len()) {
            let message = format!("it has {} images and {places} places for them", row.images.len());
            find(RowFault::Image, message, None);
        }
        if let Some(images) = &mut self.images {
            for why in row.images.iter().filter_map(|image| images.fault(file, image)) {
                find(RowFault::Image, why, None);
            }
        }
        match self.fault(&row) {
            Ok(None) => {}
            Ok(Some(why)) => find(RowFault::CannotRun, why, None),
            Err(why) => find(RowFault::NoWorld, why, None),
        }
        found
    }

    /// Finds the scene of a row in another file. Reports each scene and file once.
    fn leak(&mut self, row: &Read, at: &Place) -> Option<(Place, SmolStr)> {
        let scene = row.scene.clone()?;
        let family = SmolStr::from(family(&scene));
        let first = self.families.entry(family.clone()).or_insert_with(|| at.clone()).clone();
        let is_new = first.file != at.file && self.leaked.insert((at.file.clone(), family));
        is_new.then_some((first, scene))
    }

    /// Checks that the plan of a row can run, and returns its fault.
    ///
    /// # Errors
    ///
    /// It is not known where it should.
    fn fault(&mut self, row: &Read) -> Result<Option<String>, String> {
        if let Target::Question(_) = row.target {
            return Ok(None);
        }
        let worlds = self.worlds;
        let missing = |what: &str, flag: &str| format!("it does not say {what}: give {flag}");
        let robot = row.robot.clone().or_else(|| worlds.robot.clone());
        let robot = robot.ok_or_else(|| missing("for which robot it is", "--robot NAME"))?;
        let scene = row.scene.clone().or_else(|| worlds.scene.clone());
        let scene = scene.ok_or_else(|| missing("in which scene it is", "--scene NAME"))?;
        let key = (robot, scene);
        if self.testbed.as_ref().is_none_or(|(known, _)| *known != key) {
            let (robot, scene) = &key;
            let body = worlds.bodies.get(robot).ok_or_else(|| format!("there is no robot `{robot}`"))?;
            let known = worlds.scenes.get(scene).ok_or_else(|| format!("there is no scene `{scene}`"))?;
            let at_start = Posture::new();
            let posture = worlds.postures.get(scene).unwrap_or(&at_start);
            let testbed = Testbed::new(body, (known, posture), worlds.effort);
            self.testbed = Some((key, testbed));
            self.faults.clear();
        }
        match self.testbed.as_ref().map(|(_, testbed)| testbed) {
            Some(Ok(testbed)) => {
                let known = self.faults.entry(row.target.clone());
                Ok(known.or_insert_with_key(|target| fault(testbed, target)).clone())
            }
            Some(Err(why)) => Err(format!("its robot cannot be in its scene: {why}")),
            None => Ok(None),
        }
    }
}

/// Checks that a reply can be carried out on a testbed, or asks something, and returns its fault.
#[must_use]
pub fn fault(testbed: &Testbed, target: &Target) -> Option<String> {
    match target {
        Target::Policy(policy) => testbed.fault(policy),
        Target::Question(_) => None,
        Target::Actions(list) => {
            let situation = RequestContext::new(&testbed.scene);
            match actions::read(list, "plan", &testbed.session, Some(&testbed.robot), &situation) {
                Ok(loose) => testbed.fault(&loose.policy),
                Err(why) => Some(why.to_string()),
            }
        }
    }
}

/// The varied scene of a scene in which something has happened: its name before the last point.
///
/// ```
/// assert_eq!(motet_dataset::lint::family("kitchen_7.2"), "kitchen_7");
/// ```
#[must_use]
pub fn family(scene: &str) -> &str {
    scene.rsplit_once('.').map_or(scene, |(family, _)| family)
}

/// An input as it is compared: letter case, white space and the marks of sentences do not count.
///
/// ```
/// assert_eq!(motet_dataset::lint::normal("Bring me  the mug!"), "bring me the mug");
/// ```
#[must_use]
pub fn normal(input: &str) -> String {
    let letters = input.chars().filter(|letter| !matches!(letter, '.' | ',' | '!' | '?' | ';'));
    squeezed(&letters.flat_map(char::to_lowercase).collect::<String>())
}

fn squeezed(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

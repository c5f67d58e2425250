//! Check of a card against its URDF: the links and joints that the card names.

use indexmap::IndexMap;
use motet_syntax::unit::Dimension;
use motet_syntax::{Diagnostic, FileId, Source, Span, suggest};
use smol_str::SmolStr;

use super::diagnostics::{
    BeyondLimit, NoArm, NoFile, NoFolder, NoPlace, NotInUrdf, SameAxis, WrongDimension,
};
use super::model::ModelSpec;
use super::quantity::{QuantityReader, Sign, units_of};
use super::read::CardReader;
use super::wire;
use super::wire::{Direction, TomlSpanned, WrittenQuantity};
use crate::urdf::{Joint, JointKind, Urdf};

impl CardReader {
    pub(super) fn model(&mut self, model: &wire::ModelTable) -> ModelSpec {
        let height = model.height.as_ref();
        ModelSpec {
            urdf: model.urdf.get().clone(),
            srdf: model.srdf.as_ref().map(|file| file.get().clone()),
            base: model.base.as_ref().map(|link| link.get().into()),
            height_m: height.map_or(0.0, |height| {
                self.numbers.of("model.height", height, Dimension::LENGTH, Sign::NotNegative)
            }),
            rest: self.positions("model.rest", &model.rest),
            accelerations: self.accelerations(&model.accelerations),
            packages: model.packages.iter().map(|folder| folder.get().clone()).collect(),
        }
    }

    /// Reads accelerations of joints, in rad/s² or m/s².
    fn accelerations(&mut self, joints: &IndexMap<String, TomlSpanned<f64>>) -> IndexMap<SmolStr, f64> {
        let read = joints.iter().map(|(name, value)| {
            let key = format!("model.accelerations.{name}");
            (name.into(), self.numbers.plain(&key, value, Sign::Positive))
        });
        read.collect()
    }

    /// Reads joint positions, in rad or m.
    pub(super) fn positions(
        &mut self,
        key: &str,
        joints: &IndexMap<String, TomlSpanned<WrittenQuantity>>,
    ) -> IndexMap<SmolStr, f64> {
        let positions = joints.iter().filter_map(|(name, position)| {
            let key = format!("{key}.{name}");
            let (value, _) = self.numbers.any(&key, position)?;
            let span = self.numbers.span(position);
            Some((name.into(), self.numbers.checked(&key, span, value, Sign::Any)))
        });
        positions.collect()
    }

    /// Reads the pointing and the closing direction of a hand.
    pub(super) fn directions(&mut self, name: &str, hand: &wire::HandTable) -> ([f64; 3], [f64; 3]) {
        let points = hand.points.as_ref().map_or(Direction::Z, |at| *at.get());
        let closes = hand.closes.as_ref().map_or(Direction::Y, |at| *at.get());
        let (points, closes) = (vector(points), vector(closes));
        let along: f64 = points.iter().zip(closes).map(|(one, other)| one * other).sum();
        if let Some(at) = hand.points.as_ref().or(hand.closes.as_ref()).filter(|_| along != 0.0) {
            let span = self.numbers.span(at);
            self.numbers.found.push(SameAxis { span, hand: name.to_owned() }.into());
        }
        (points, closes)
    }
}

fn vector(direction: Direction) -> [f64; 3] {
    match direction {
        Direction::X => [1.0, 0.0, 0.0],
        Direction::MinusX => [-1.0, 0.0, 0.0],
        Direction::Y => [0.0, 1.0, 0.0],
        Direction::MinusY => [0.0, -1.0, 0.0],
        Direction::Z => [0.0, 0.0, 1.0],
        Direction::MinusZ => [0.0, 0.0, -1.0],
    }
}

/// Checks a card without errors against its URDF: the named links and joints exist, positions are within
/// limits, and hands and cameras have a link. O(bytes + links).
///
/// ```
/// use motet_robots::{builtin, card};
/// use motet_syntax::{FileId, Source};
///
/// let texts = builtin::robot_texts("hsr").unwrap();
/// let source = Source::new("robot.toml", texts.card.replace("hand_palm_link", "hand_plam_link"));
/// let found = card::fit(&source, FileId(0), &texts.urdf().unwrap());
/// assert_eq!(found[0].message, "the URDF has no link `hand_plam_link`");
/// assert_eq!(found[0].help.as_deref(), Some("did you mean `hand_palm_link`?"));
/// ```
#[must_use]
pub fn fit(toml: &Source, file: FileId, urdf: &Urdf) -> Vec<Diagnostic> {
    let Ok(card) = toml::from_str::<wire::CardTable>(&toml.text) else { return vec![] };
    let mut fit = UrdfFit { numbers: QuantityReader { file, found: Vec::new() }, urdf };
    if let Some(model) = &card.model {
        fit.link(model.base.as_ref());
        fit.positions(&model.rest);
        for (name, acceleration) in &model.accelerations {
            let span = fit.numbers.span(acceleration);
            fit.numbers.found.extend(found(name, span, urdf).err().map(Diagnostic::from));
        }
    }
    for (name, hand) in &card.hands {
        fit.place("hand", name, hand, hand.get().tip.as_ref(), "tip");
        fit.arm(name, hand.get().tip.as_ref(), card.model.as_ref().and_then(|model| model.base.as_ref()));
        fit.positions(&hand.get().open);
    }
    for (name, camera) in &card.cameras {
        fit.place("camera", name, camera, camera.get().frame.as_ref(), "frame");
    }
    for posture in card.postures.values() {
        fit.positions(posture.get());
    }
    let mut found = fit.numbers.found;
    found.sort_by_key(|diagnostic| diagnostic.span);
    found
}

/// Diagnostic for a missing file or folder that the card names; `None` if the card names none.
#[must_use]
pub fn missing(toml: &Source, file: FileId, which: ModelFile) -> Option<Diagnostic> {
    let card = toml::from_str::<wire::CardTable>(&toml.text).ok()?;
    let model = card.model.as_ref()?;
    let span = |name: &TomlSpanned<String>| QuantityReader { file, found: Vec::new() }.span(name);
    let (key, name) = match which {
        ModelFile::Urdf => ("urdf", &model.urdf),
        ModelFile::Srdf => ("srdf", model.srdf.as_ref()?),
        ModelFile::Package(at) => {
            let folder = model.packages.get(at)?;
            return Some(NoFolder { span: span(folder), folder: folder.get().clone() }.into());
        }
    };
    let span = span(name);
    Some(NoFile { span, key, file: name.get().clone() }.into())
}

/// File or folder under `[model]` of a card.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum ModelFile {
    Urdf,
    Srdf,
    /// One of `packages`, from 0.
    Package(usize),
}

struct UrdfFit<'u> {
    numbers: QuantityReader,
    urdf: &'u Urdf,
}

impl UrdfFit<'_> {
    fn link(&mut self, link: Option<&TomlSpanned<String>>) {
        let Some(link) = link.filter(|link| self.urdf.link(link.get()).is_none()) else { return };
        let known = self.urdf.links.iter().map(|link| link.name.as_str());
        let near = suggest::closest(link.get(), known).map(str::to_owned);
        let (span, name) = (self.numbers.span(link), link.get().clone());
        self.numbers.found.push(NotInUrdf { span, what: "link", name, near }.into());
    }

    fn place<T>(
        &mut self,
        what: &'static str,
        name: &str,
        part: &TomlSpanned<T>,
        link: Option<&TomlSpanned<String>>,
        key: &'static str,
    ) {
        if link.is_none() {
            let span = self.numbers.span(part);
            self.numbers.found.push(NoPlace { span, what, name: name.to_owned(), key }.into());
        }
        self.link(link);
    }

    /// Checks that a joint moves the tip of a hand relative to the link of the base.
    fn arm(&mut self, name: &str, tip: Option<&TomlSpanned<String>>, base: Option<&TomlSpanned<String>>) {
        let Some(tip) = tip else { return };
        let base = base.map_or(Some(self.urdf.root), |base| self.urdf.link(base.get()));
        // Missing links have been reported.
        let (Some(link), Some(base)) = (self.urdf.link(tip.get()), base) else { return };
        let (mut at, mut moves) = (link, false);
        // Backwards, each joint comes after the one that carries its parent.
        for joint in self.urdf.joints.iter().rev() {
            if joint.child == at && at != base {
                moves |= !matches!(joint.kind, JointKind::Fixed | JointKind::Floating);
                at = joint.parent;
            }
        }
        let is_carried = at == base;
        if !is_carried || !moves {
            let span = self.numbers.span(tip);
            let base = self.urdf.links.get(base).map_or("", |link| link.name.as_str()).to_owned();
            let (hand, tip) = (name.to_owned(), tip.get().clone());
            self.numbers.found.push(NoArm { span, hand, tip, base, is_carried }.into());
        }
    }

    fn positions(&mut self, positions: &IndexMap<String, TomlSpanned<WrittenQuantity>>) {
        for (name, position) in positions {
            let span = self.numbers.span(position);
            let joint = match found(name, span, self.urdf) {
                Ok(joint) => joint,
                Err(told) => {
                    self.numbers.found.push(told.into());
                    continue;
                }
            };
            let Some((value, unit)) = self.numbers.any(name, position) else { continue };
            let dimension = match joint.kind {
                JointKind::Prismatic => Dimension::LENGTH,
                JointKind::Fixed
                | JointKind::Revolute
                | JointKind::Continuous
                | JointKind::Planar
                | JointKind::Floating => Dimension::ANGLE,
            };
            if let Some(unit) = unit.filter(|unit| unit.dimension() != dimension) {
                let (key, unit, units) = (name.clone(), unit.symbol(), units_of(dimension));
                self.numbers.found.push(WrongDimension { span, key, unit, units }.into());
                continue;
            }
            self.numbers.found.extend(JointPosition { joint: name, value, span }.beyond(joint));
        }
    }
}

/// Joint position as written, in m or rad, with its span.
#[derive(Clone, Copy, Debug)]
pub(crate) struct JointPosition<'a> {
    pub(crate) joint: &'a str,
    pub(crate) value: f64,
    pub(crate) span: Span,
}

impl JointPosition<'_> {
    /// Checks the position against a URDF.
    pub(crate) fn fault(self, urdf: &Urdf) -> Option<Diagnostic> {
        // A planar joint has no limits.
        let (joint, part) = self.joint.rsplit_once('/').unwrap_or_default();
        let is_planar = |it: &Joint| it.name == joint && it.kind == JointKind::Planar;
        if matches!(part, "x" | "y" | "theta") && urdf.joints.iter().any(is_planar) {
            return None;
        }
        match found(self.joint, self.span, urdf) {
            Ok(joint) => self.beyond(joint),
            Err(told) => Some(told.into()),
        }
    }

    fn beyond(self, joint: &Joint) -> Option<Diagnostic> {
        let Self { joint: name, value, span } = self;
        let limits = joint.limits.filter(|limits| !(limits.lower..=limits.upper).contains(&value))?;
        let (joint, least, greatest) = (name.to_owned(), limits.lower, limits.upper);
        Some(BeyondLimit { span, joint, value, least, greatest }.into())
    }
}

/// Finds the joint with a name that moves by itself, or the mistake.
fn found<'u>(name: &str, span: Span, urdf: &'u Urdf) -> Result<&'u Joint, NotInUrdf> {
    let moves = |joint: &&Joint| joint.kind.has_one_position() && joint.mimic.is_none();
    urdf.joints.iter().filter(moves).find(|joint| joint.name == name).ok_or_else(|| {
        let known = urdf.joints.iter().filter(moves).map(|joint| joint.name.as_str());
        let near = suggest::closest(name, known).map(str::to_owned);
        let what = "joint that moves by itself called";
        NotInUrdf { span, what, name: name.to_owned(), near }
    })
}

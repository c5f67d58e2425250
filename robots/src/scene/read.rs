//! From JSON to a [`Scene`]: ids, the robot, and what stands on what. Entities are checked one by one in
//! [`super::check`], their relations in [`super::relations`].

use indexmap::IndexMap;
use motet_syntax::json::{self, Spanned};
use motet_syntax::{Diagnostic, FileId, Source, Span};
use smol_str::SmolStr;

use super::check;
use super::errors::{BadId, DuplicateId, Frame, ReservedId, TooManyEntities, Version};
use super::model::{Entity, JointSpans, RobotState, Scene};
use super::number::{NumberReader, SceneQuantity};
use super::relations;
use super::wire;

/// The most entities of one scene.
pub const MAX_ENTITIES: usize = 20_000;

/// Ids that mean something else in a policy.
const RESERVED: &[&str] = &["robot", "any"];

/// Reads a scene, with everything that is wrong with it.
///
/// A scene comes with every error but those after which nothing could be read; what is wrong is left out of it, so it
/// keeps the invariants of the model. O(bytes).
#[must_use]
pub fn read(source: &Source, file: FileId) -> (Option<Scene>, Vec<Diagnostic>) {
    let (document, mut found) = json::read::<wire::Document>(source, file);
    let Some(document) = document else { return (None, found) };
    if document.motet_scene.value != 1 {
        let version = Version { span: document.motet_scene.span, found: document.motet_scene.value };
        found.push(version.into());
        return (None, found);
    }
    let mut numbers = NumberReader::default();
    if let Some(frame) = document.frame.as_ref().filter(|frame| frame.value != "map") {
        numbers.found.push(Frame { span: frame.span, found: frame.value.clone() }.into());
    }
    let count = document.entities.len();
    if let Some(first) = document.entities.iter().skip(MAX_ENTITIES).find_map(|entity| entity.0.as_ref()) {
        numbers.found.push(TooManyEntities { span: first.id.span, count }.into());
    }
    let wires: Vec<_> =
        document.entities.into_iter().take(MAX_ENTITIES).filter_map(|entity| entity.0).collect();
    let robot = document.robot.0.unwrap_or_default();
    let mut scene = Scene {
        entities: entities(&wires, &mut numbers),
        views: document.views.iter().filter_map(|view| check::view(view.0.as_ref()?, &mut numbers)).collect(),
        robot: at_start(&robot, &mut numbers),
    };
    found.append(&mut numbers.found);
    found.extend(relations::resolve_relations(&mut scene, &wires, &robot));
    found.sort_by_key(|diagnostic| diagnostic.span.start);
    (Some(scene), found)
}

fn entities(wires: &[Spanned<wire::Entity>], numbers: &mut NumberReader) -> IndexMap<SmolStr, Entity> {
    let mut entities = IndexMap::with_capacity(wires.len());
    let mut places: IndexMap<SmolStr, Span> = IndexMap::with_capacity(wires.len());
    for wire in wires {
        let (id, span) = (wire.id.value.clone(), wire.id.span);
        if id.is_empty() || id.chars().any(|letter| letter == '`' || letter.is_control()) {
            numbers.found.push(BadId { span, id }.into());
        } else if RESERVED.contains(&id.as_str()) {
            numbers.found.push(ReservedId { span, id }.into());
        } else if let Some(first) = places.get(&id).copied() {
            numbers.found.push(DuplicateId { span, id, first }.into());
        } else {
            places.insert(id.clone(), span);
            entities.insert(id, check::entity(wire, numbers));
        }
    }
    entities
}

fn at_start(robot: &wire::Robot, numbers: &mut NumberReader) -> RobotState {
    let base = robot.base.0.as_ref().and_then(|base| {
        let [x, y, heading] = base.value;
        let x = numbers.one(&Spanned::new(x, base.span), SceneQuantity::Coordinate)?;
        let y = numbers.one(&Spanned::new(y, base.span), SceneQuantity::Coordinate)?;
        Some([x, y, numbers.one(&Spanned::new(heading, base.span), SceneQuantity::Angle)?])
    });
    let joints = robot.joints.iter().filter_map(|(name, value)| {
        let value = numbers.one(value, SceneQuantity::Joint)?;
        Some((name.clone(), value))
    });
    RobotState {
        base: base.unwrap_or_default(),
        joints: joints.collect(),
        holding: robot.holding.as_ref().map(|held| held.as_ref().map(|id| id.value.clone())),
        at: robot.at.as_ref().map(|at| at.value.clone()),
        spans: JointSpans(robot.joints.iter().map(|(name, value)| (name.clone(), value.span)).collect()),
    }
}

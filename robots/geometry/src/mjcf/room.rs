//! Room of a MuJoCo model: furniture, containers with their drawers and doors, things and people.

use motet_robots::scene::{Colour, Entity, PERSON_COLOUR, Palette, Scene, Travel, colour};
use motet_stdlib::lang::kinds;
use nalgebra::{Isometry3, Translation3, Vector3};

use super::element::{XmlText, name, number, numbers, pose, vector};
use super::geom::{geom, volume};
use crate::collision::{Shape, Solid};
use crate::planning::{Articulation, RobotModel, STANDS_OUT, SceneState, THICK, WALL, solid_shape, walls};
use crate::trigonometry::sin_cos;

/// Density of doors and drawers in kg/m³.
pub(super) const DOOR_DENSITY: f64 = 500.0;
/// Density of things without a mass in kg/m³, and the range of their masses in kg.
const THING_DENSITY: f64 = 400.0;
const THING_MASSES: [f64; 2] = [0.01, 5.0];
/// Number of flat walls around a round container.
const AROUND: u32 = 12;
/// Radius and height in m of a person without a shape.
const PERSON: [f64; 2] = [0.3, 1.7];

/// Room as it was written.
#[derive(Debug, Default)]
pub(super) struct RoomLayout {
    /// Positions of the joints, in the order of the model.
    pub(super) positions: Vec<f64>,
    /// Names of containers with a drawer or a door, and the position of it if it is locked.
    doors: Vec<(String, Option<f64>)>,
}

/// Writes the entities.
pub(super) fn bodies(xml: &mut XmlText, model: &RobotModel, scene: &Scene, state: &SceneState) -> RoomLayout {
    let mut layout = RoomLayout::default();
    let map_from_tip =
        model.hand().and_then(|hand| model.map_from_links(&state.robot).get(hand.tip).copied());
    for entity in scene.entities.values() {
        if entity.kind == kinds::PLACE || entity.kind == kinds::ZONE {
            continue;
        }
        if entity.kind == kinds::PERSON {
            person(xml, entity, state);
            continue;
        }
        let held = state.held.as_ref().filter(|(id, _)| *id == entity.id).zip(map_from_tip);
        let held = held.map(|((_, tip_from_object), map_from_tip)| map_from_tip * tip_from_object);
        let (Some(at), Some(shape)) = (held.or_else(|| state.pose(entity)), solid_shape(entity)) else {
            continue;
        };
        match Articulation::new(entity, state).filter(|_| held.is_none()) {
            Some(opening) => container(xml, entity, &at, &opening, state, &mut layout),
            None if is_free(entity) || held.is_some() => thing(xml, entity, &at, shape, &mut layout),
            None => {
                let attributes = named(entity, &at);
                xml.open("body", &attributes);
                let rgba = painted(colour(&entity.id, Some(entity), Palette::Furniture));
                for solid in hollow(entity, shape) {
                    xml.leaf("geom", &shaped(&solid, "fixed", &rgba));
                }
                xml.close();
            }
        }
    }
    layout
}

/// Checks whether an entity is a thing that moves freely. Furniture does where it has a mass and is not
/// fixed.
fn is_free(entity: &Entity) -> bool {
    let is_furniture = entity.kind == kinds::SURFACE || entity.kind == kinds::CONTAINER;
    !entity.fixed && (!is_furniture || entity.mass_kg.is_some())
}

fn named(entity: &Entity, at: &Isometry3<f64>) -> Vec<(&'static str, String)> {
    let mut attributes = vec![("name", name(&entity.id))];
    attributes.extend(pose(at));
    attributes
}

fn thing(xml: &mut XmlText, entity: &Entity, at: &Isometry3<f64>, shape: Shape, layout: &mut RoomLayout) {
    xml.open("body", &named(entity, at));
    xml.leaf("freejoint", &[("name", name(&entity.id))]);
    let solids = hollow(entity, shape);
    let whole: f64 = solids.iter().map(volume).sum();
    let [least, most] = THING_MASSES;
    let mass = entity.mass_kg.unwrap_or_else(|| (whole * THING_DENSITY).clamp(least, most));
    let rgba = painted(colour(&entity.id, Some(entity), Palette::Things));
    for solid in &solids {
        let mut attributes = shaped(solid, "thing", &rgba);
        attributes.push(("mass", number((mass * volume(solid) / whole.max(1e-12)).max(1e-4))));
        xml.leaf("geom", &attributes);
    }
    xml.close();
    let [x, y, z, w]: [f64; 4] = at.rotation.coords.into();
    layout.positions.extend(at.translation.vector.iter().copied().chain([w, x, y, z]));
}

/// Writes a person: a body that moves as it is told, and gives way to nothing.
fn person(xml: &mut XmlText, entity: &Entity, state: &SceneState) {
    let Some(at) = state.pose(entity) else { return };
    let [radius, height] = PERSON;
    let (at, shape) = match solid_shape(entity) {
        Some(shape) => (at, shape),
        None => {
            (at * Translation3::new(0.0, 0.0, height / 2.0), Shape::Cylinder { radius, half: height / 2.0 })
        }
    };
    let mut attributes = named(entity, &at);
    attributes.push(("mocap", "true".into()));
    xml.open("body", &attributes);
    let solid = Solid::new(&Isometry3::identity(), shape);
    xml.leaf("geom", &shaped(&solid, "fixed", &painted(PERSON_COLOUR)));
    xml.close();
}

/// Writes a container with its drawer or door and the bar on it, which the hand pulls.
fn container(
    xml: &mut XmlText,
    entity: &Entity,
    at: &Isometry3<f64>,
    opening: &Articulation,
    state: &SceneState,
    layout: &mut RoomLayout,
) {
    let own = |solid: &Solid| solid.moved(&at.inverse());
    let rgba = painted(colour(&entity.id, Some(entity), Palette::Furniture));
    let id = name(&entity.id);
    xml.open("body", &named(entity, at));
    for solid in opening.still() {
        xml.leaf("geom", &shaped(&own(solid), "fixed", &rgba));
    }
    xml.open("body", &[("name", format!("{id}/door")), ("gravcomp", "1".into())]);
    let travel = format!("{id}/travel");
    let opened = match entity.travel {
        Some(Travel::Slide { axis, distance }) => {
            let friction = [("frictionloss", "4".to_owned()), ("damping", "15".to_owned())];
            self::travel(xml, &travel, "slide", axis, None, distance, friction);
            distance
        }
        Some(Travel::Hinge { axis, at, angle }) => {
            let friction = [("frictionloss", "0.6".to_owned()), ("damping", "2".to_owned())];
            self::travel(xml, &travel, "hinge", axis, Some(at), angle, friction);
            angle
        }
        None => 0.0,
    };
    for solid in opening.moving(0.0) {
        xml.leaf("geom", &shaped(&own(&solid), "door", &rgba));
    }
    handle(xml, &id, opening, at);
    xml.close();
    xml.close();
    let position = if state.is_open(entity) { opened } else { 0.0 };
    layout.positions.push(position);
    layout.doors.push((id, (entity.locked == Some(true)).then_some(position)));
}

fn travel(
    xml: &mut XmlText,
    name: &str,
    kind: &str,
    axis: [f64; 3],
    at: Option<[f64; 3]>,
    most: f64,
    friction: [(&'static str, String); 2],
) {
    let mut attributes = vec![
        ("name", name.to_owned()),
        ("type", kind.to_owned()),
        ("axis", numbers(axis)),
        ("range", numbers([0.0_f64.min(most), 0.0_f64.max(most)])),
        ("armature", "0.1".into()),
    ];
    attributes.extend(at.map(|at| ("pos", numbers(at))));
    attributes.extend(friction);
    xml.leaf("joint", &attributes);
}

/// Writes the bar of a handle, with two posts that only show.
fn handle(xml: &mut XmlText, id: &str, opening: &Articulation, at: &Isometry3<f64>) {
    let handle = opening.handle();
    let grey = "0.5 0.5 0.52 1".to_owned();
    let solid = opening.bar(0.0).moved(&at.inverse());
    let mut attributes = shaped(&solid, "door", &grey);
    attributes.push(("name", format!("{id}/handle")));
    xml.leaf("geom", &attributes);
    for end in [handle.half, -handle.half] {
        let out = at.rotation.inverse() * handle.out;
        let from = solid.centre + (at.rotation.inverse() * handle.along) * end;
        let to = from - out * STANDS_OUT;
        xml.leaf(
            "geom",
            &[
                ("class", "shown".into()),
                ("type", "capsule".into()),
                ("fromto", format!("{} {}", vector(&from), vector(&to))),
                ("size", number(THICK / 2.0)),
                ("rgba", grey.clone()),
            ],
        );
    }
}

/// Solids of an entity without a drawer or a door in its own frame. What is put on a container falls into it:
/// it is open at the top.
fn hollow(entity: &Entity, shape: Shape) -> Vec<Solid> {
    let identity = Isometry3::identity();
    match shape {
        _ if entity.kind != kinds::CONTAINER => vec![Solid::new(&identity, shape)],
        Shape::Box(half) => walls(&identity, &half, &Vector3::z()),
        Shape::Cylinder { radius, half } => {
            let thin = (WALL / 2.0).min(half).min(radius / 2.0);
            let bottom = Translation3::new(0.0, 0.0, thin - half);
            let mut solids = vec![Solid::new(&bottom.into(), Shape::Cylinder { radius, half: thin })];
            let turn = std::f64::consts::TAU / f64::from(AROUND);
            let wide = radius * libm::tan(turn / 2.0);
            for step in 0..AROUND {
                let (sin, cos) = sin_cos(turn * f64::from(step));
                let middle = Vector3::new(cos, sin, 0.0) * (radius - thin);
                let rotation = crate::trigonometry::turn(&Vector3::z_axis(), turn * f64::from(step));
                let wall = Isometry3::from_parts(Translation3::from(middle), rotation);
                solids.push(Solid::new(&wall, Shape::Box(Vector3::new(thin, wide, half))));
            }
            solids
        }
        Shape::Capsule { .. } | Shape::HalfSpace => vec![Solid::new(&identity, shape)],
    }
}

fn shaped(solid: &Solid, class: &str, rgba: &str) -> Vec<(&'static str, String)> {
    let mut attributes = vec![("class", class.to_owned())];
    attributes.extend(geom(solid));
    attributes.push(("rgba", rgba.to_owned()));
    attributes
}

fn painted(colour: Colour) -> String {
    let parts = colour.map(|part| libm::round(f64::from(part) / 255.0 * 1000.0) / 1000.0);
    numbers(parts.into_iter().chain([1.0]))
}

impl RoomLayout {
    /// Writes the locks: each keeps a door where it is until it is made inactive.
    pub(super) fn locks(&self, xml: &mut XmlText) {
        for (id, locked) in &self.doors {
            xml.leaf(
                "joint",
                &[
                    ("name", format!("{id}/lock")),
                    ("joint1", format!("{id}/travel")),
                    ("polycoef", numbers([locked.unwrap_or_default(), 0.0, 0.0, 0.0, 0.0])),
                    ("active", locked.is_some().to_string()),
                    ("solref", "0.004 1".into()),
                ],
            );
        }
    }

    /// Writes the pairs of bodies that slide within each other.
    pub(super) fn exclusions(&self, xml: &mut XmlText) {
        for (id, _) in &self.doors {
            xml.leaf("exclude", &[("body1", id.clone()), ("body2", format!("{id}/door"))]);
        }
    }
}

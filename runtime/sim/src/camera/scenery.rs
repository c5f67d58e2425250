//! Visible solids of a world with their colours. Open containers are hollow, so that their content shows; a
//! thing has the colour in its name, else one of its own.

use super::solid::{Form, Solid};
use crate::world::{Role, SimWorld, Thing};
use motet_robots::scene::{Colour, Outline, PERSON_COLOUR, Palette, Scene, Travel, colour};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

/// Thickness of the walls of open containers in m.
const WALL_M: f64 = 0.02;

/// A solid with its colour.
pub(super) struct Painted {
    pub(super) solid: Solid,
    pub(super) colour: Colour,
}

/// Everything that is not shut away, in the order of the world.
pub(super) fn scenery(world: &SimWorld, scene: &Scene) -> Vec<Painted> {
    let mut all = Vec::new();
    for (id, thing) in &world.things {
        let entity = scene.entities.get(id);
        let colour = match thing.role {
            // A place is nothing that one sees.
            Role::Place => continue,
            Role::Person => PERSON_COLOUR,
            Role::Surface | Role::Container => colour(id, entity, Palette::Furniture),
            Role::Object => colour(id, entity, Palette::Things),
        };
        if world.shut_in(id).is_some() {
            continue;
        }
        all.extend(parts(thing).into_iter().map(|solid| Painted { solid, colour }));
    }
    all
}

/// The solids of a thing: one, or the walls of an open container.
pub(super) fn parts(thing: &Thing) -> Vec<Solid> {
    let whole = solid(thing);
    match whole.form {
        Form::Box(half) if thing.role == Role::Container && thing.is_open() => hollow(&whole, half, thing),
        Form::Cylinder { radius, half } if thing.role == Role::Container && thing.is_open() => {
            barrel(&whole, radius, half)
        }
        Form::Box(_) | Form::Cylinder { .. } | Form::Sphere { .. } => vec![whole],
    }
}

/// The staves and the floor of a bin that is open at the top.
fn barrel(whole: &Solid, radius: f64, half: f64) -> Vec<Solid> {
    let wall = (WALL_M / 2.0).min(radius / 2.0);
    let away = radius - wall;
    let stave = |step: i32| {
        let turn = f64::from(step) * FRAC_PI_4;
        let (sin, cos) = turn.sin_cos();
        Solid {
            centre: placed(whole, [away * cos, away * sin, 0.0]),
            yaw: whole.yaw + turn,
            form: Form::Box([wall, radius * (FRAC_PI_4 / 2.0).tan(), half]),
        }
    };
    let floor = wall.min(half);
    let bottom = Solid {
        centre: placed(whole, [0.0, 0.0, floor - half]),
        form: Form::Cylinder { radius, half: floor },
        ..*whole
    };
    (0..8).map(stave).chain([bottom]).collect()
}

/// A thing as one solid: in its own shape, or as the world takes it.
fn solid(thing: &Thing) -> Solid {
    let body = &thing.body;
    let half = (body.top() - body.bottom()) / 2.0;
    let form = thing.shape.as_ref().and_then(Form::of).unwrap_or(match body.outline {
        Outline::Disc { radius } => Form::Cylinder { radius, half },
        Outline::Rectangle { half: [x, y] } => Form::Box([x, y, half]),
    });
    Solid { centre: [body.x(), body.y(), body.bottom() + half], yaw: body.yaw, form }
}

/// The walls of an open box: without the face that its door closes, and with the door where that now is; what
/// slides or has no door is open at the top.
fn hollow(whole: &Solid, half: [f64; 3], thing: &Thing) -> Vec<Solid> {
    let door = thing.door.and_then(|door| match door.travel? {
        Travel::Hinge { axis, at, angle } if axis[2].abs() > 0.5 => {
            Some(swing(half, at, angle * axis[2].signum()))
        }
        Travel::Hinge { .. } | Travel::Slide { .. } => None,
    });
    let open = door.map_or([0.0, 0.0, 1.0], |door| door.face);
    let mut parts: Vec<Solid> = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
        .into_iter()
        .flat_map(|axis| [axis, axis.map(|part: f64| -part)])
        .filter(|face| *face != open)
        .map(|face| wall(whole, half, face))
        .collect();
    parts.extend(door.map(|door| door.solid(whole, half)));
    parts
}

/// Direction in the frame `map` in which a container opens, where its door or drawer says so.
pub(crate) fn front(thing: &Thing) -> Option<[f64; 2]> {
    let whole = solid(thing);
    let face = match (thing.door?.travel?, whole.form) {
        (Travel::Slide { axis, .. }, _) => axis,
        (Travel::Hinge { axis, at, angle }, Form::Box(half)) if axis[2].abs() > 0.5 => {
            swing(half, at, angle * axis[2].signum()).face
        }
        (Travel::Hinge { .. }, Form::Box(_) | Form::Cylinder { .. } | Form::Sphere { .. }) => return None,
    };
    let [x, y, _] = thing.body.turned_out(face);
    (x.hypot(y) > 0.5).then_some([x, y])
}

/// The wall of a face, given by its normal in the frame of the box.
fn wall(whole: &Solid, half: [f64; 3], face: [f64; 3]) -> Solid {
    let (mut extents, mut middle) = (half, [0.0; 3]);
    for (((extent, at), face), half) in extents.iter_mut().zip(&mut middle).zip(face).zip(half) {
        if face != 0.0 {
            *extent = (WALL_M / 2.0).min(half);
            *at = face * (half - *extent);
        }
    }
    Solid { centre: placed(whole, middle), yaw: whole.yaw, form: Form::Box(extents) }
}

/// A door that has swung open about the vertical, in the frame of its box.
#[derive(Clone, Copy)]
struct Door {
    /// The face that it closes.
    face: [f64; 3],
    /// Position where its middle is.
    middle: [f64; 2],
    angle: f64,
}

/// Of the faces beside a hinge that whose door comes to lie farthest outside.
fn swing(half: [f64; 3], hinge: [f64; 3], angle: f64) -> Door {
    let ([a, b, _], [x, y, _], (sin, cos)) = (half, hinge, angle.sin_cos());
    let mut doors: Vec<(f64, Door)> = Vec::new();
    for face in [[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0]] {
        let [nx, ny, _] = face;
        if ((nx * x + ny * y) - (nx.abs() * a + ny.abs() * b)).abs() > 0.02 {
            continue;
        }
        let (dx, dy) = (nx * a - x, ny * b - y);
        let middle = [x + cos * dx - sin * dy, y + sin * dx + cos * dy];
        let outside = nx * middle[0] + ny * middle[1] - (nx.abs() * a + ny.abs() * b);
        doors.push((outside, Door { face, middle, angle }));
    }
    doors.sort_by(|(one, _), (other, _)| other.total_cmp(one));
    let none = Door { face: [1.0, 0.0, 0.0], middle: [a, 0.0], angle: 0.0 };
    doors.first().map_or(none, |(_, door)| *door)
}

impl Door {
    fn solid(&self, whole: &Solid, [a, b, height]: [f64; 3]) -> Solid {
        let [nx, _, _] = self.face;
        let (width, across) = if nx == 0.0 { (a, FRAC_PI_2) } else { (b, 0.0) };
        let [x, y] = self.middle;
        Solid {
            centre: placed(whole, [x, y, 0.0]),
            yaw: whole.yaw + self.angle + across,
            form: Form::Box([WALL_M / 2.0, width, height]),
        }
    }
}

/// A point of a solid's frame in the frame `map`.
fn placed(whole: &Solid, [x, y, z]: [f64; 3]) -> [f64; 3] {
    let ((sin, cos), [cx, cy, cz]) = (whole.yaw.sin_cos(), whole.centre);
    [cx + cos * x - sin * y, cy + sin * x + cos * y, cz + z]
}

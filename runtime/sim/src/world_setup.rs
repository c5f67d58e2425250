//! The world at the start, from a card and a scene. What they leave open is filled in: a thing without a
//! place stands in a row beside the room, an object without mass or width is light and slim.

use crate::body::{BasePose, UprightBody};
use crate::chance::Chance;
use crate::observation::InitialFacts;
use crate::profile::RoomRates;
use crate::sim::SimOptions;
use crate::world::{ArmPose, Door, HandState, Rest, Role, SimWorld, Thing};
use indexmap::IndexMap;
use motet_robots::card::{CameraMount, Robot};
use motet_robots::scene::{Entity, EntityShape, Placement, Scene};
use motet_runtime::Time;
use motet_stdlib::lang::{entities, fluents, kinds};
use smol_str::SmolStr;
use std::collections::BTreeSet;

/// Metres between things that are filled in.
const ROW_M: f64 = 2.5;
/// Position of the camera of a robot that does not say where it is: about as high as a sitting person's eyes.
const EYE: [f64; 3] = [0.0, 0.0, 1.1];
/// Default mass of an object in kg.
const MASS_KG: f64 = 0.2;
/// Default width of an object in m.
const WIDTH_M: f64 = 0.06;

impl SimWorld {
    pub(crate) fn new(robot: &Robot, scene: &Scene, options: &SimOptions) -> Self {
        let [x, y, heading] = scene.robot.base;
        let grip = |hand| HandState { hand, holds: None, lifted: false };
        let mut world = Self {
            now: Time::ZERO,
            base: BasePose { x, y, heading },
            motion: None,
            drive: robot.base.clone(),
            hands: robot.hands.iter().map(|(name, hand)| (name.clone(), grip(hand.clone()))).collect(),
            cameras: robot.cameras.values().cloned().collect(),
            eye: options.eye.unwrap_or(CameraMount::free(EYE)),
            gaze: None,
            things: IndexMap::new(),
            arm: ArmPose::Home,
            standing: !robot.initially.iter().any(|fact| fact.trim() == "not standing(robot)"),
            battery: 1.0,
            unmoved: true,
            served_at_start: scene.robot.at.clone(),
            visited: scene.robot.at.clone().into_iter().collect::<BTreeSet<_>>(),
        };
        if robot.initially.iter().any(|fact| fact.trim() == "arm_ready(robot)") {
            world.arm = ArmPose::Ready;
        }
        let entities = entities(scene, options);
        let mut row = Row::beside(scene);
        for entity in &entities {
            let thing = thing(entity, options, &mut row);
            world.things.insert(entity.id.clone(), thing);
        }
        world.settle(&entities);
        if let Some(Some(held)) = &scene.robot.holding {
            world.hold_at_start(held);
        }
        world.believe(&options.initial_facts);
        world.carry();
        for (id, thing) in &mut world.things {
            let said = scene.entities.get(id).and_then(|entity| entity.visible).or(thing.visible_at_start);
            thing.moved = false;
            thing.seen_at = (said == Some(true)).then_some(thing.body.xyz);
        }
        world
    }

    /// Gives things a spot of which only the support is known, supports first.
    fn settle(&mut self, entities: &[Entity]) {
        let mut open: Vec<&Entity> = entities.iter().filter(|entity| entity.pose.is_none()).collect();
        while !open.is_empty() {
            let waits = |entity: &Entity| {
                let support = entity.on.as_ref().or(entity.inside.as_ref());
                support.is_some_and(|support| open.iter().any(|other| other.id == *support))
            };
            let (later, ready): (Vec<_>, Vec<_>) = open.iter().copied().partition(|entity| waits(entity));
            if ready.is_empty() {
                return;
            }
            for entity in ready {
                let Some(rest) = self.thing(&entity.id).map(|thing| thing.rest.clone()) else { continue };
                let Some(support) = rest.support().cloned() else { continue };
                self.lay(&entity.id, &support, rest);
            }
            open = later;
        }
    }

    /// Puts a thing on or in another without a hand: a free spot, or the middle where there is none.
    pub(crate) fn lay(&mut self, id: &str, support: &str, rest: Rest) {
        let Some(target) = self.thing(support).map(|thing| thing.body) else { return };
        let middle = [target.x(), target.y()];
        let spot = self.free_spot(id, support, (middle, 0.05), |_, _| true).unwrap_or(middle);
        let bottom = if matches!(rest, Rest::In(_)) { target.bottom() + 0.01 } else { target.top() };
        self.put(id, spot, bottom, rest);
    }

    pub(crate) fn hold_at_start(&mut self, held: &SmolStr) {
        if let Some(thing) = self.things.get_mut(held) {
            thing.rest = Rest::Free;
            if let Some(grip) = self.hands.values_mut().next() {
                grip.holds = Some(held.clone());
                grip.lifted = true;
            }
        }
    }
}

/// All entities: of the scene, of the standard library, and of the options.
fn entities(scene: &Scene, options: &SimOptions) -> Vec<Entity> {
    let mut entities: Vec<Entity> = scene.entities.values().cloned().collect();
    let [x, y, heading] = scene.robot.base;
    let mut add = |id: &str, kind: &str, pose| {
        if id != "robot" && !entities.iter().any(|entity| entity.id == id) {
            entities.push(Entity::new(id.into(), kind.into(), pose));
        }
    };
    add("start", kinds::PLACE, Some(Placement { xyz: [x, y, 0.0], rpy: [0.0, 0.0, heading] }));
    add("user", kinds::PERSON, None);
    for (id, kind) in &options.entities {
        add(id, kind, None);
    }
    entities
}

fn thing(entity: &Entity, options: &SimOptions, row: &mut Row) -> Thing {
    let role = role(entity, options);
    let rest = match (&entity.on, &entity.inside) {
        (_, Some(container)) => Rest::In(container.clone()),
        (Some(support), None) => Rest::On(support.clone()),
        (None, None) => Rest::Free,
    };
    let usual = usual_shape(role);
    let shape = entity.shape.as_ref().or(usual.as_ref());
    let stands_on_pose = matches!(role, Role::Person | Role::Place);
    let is_lost = entity.pose.is_none();
    let mut body = UprightBody::new(entity.pose.unwrap_or_default(), shape, stands_on_pose);
    if is_lost {
        let [x, y] = row.next_spot();
        body.put(x, y, 0.0);
    }
    let has_door = entity.travel.is_some() || entity.open.is_some() || entity.locked.is_some();
    let door = Door {
        open: entity.open.unwrap_or(false),
        locked: entity.locked.unwrap_or(false),
        travel: entity.travel,
    };
    Thing {
        role,
        name: name(entity),
        placed: !is_lost,
        seen_at: None,
        lost: false,
        body,
        shape: entity.shape.clone(),
        rest,
        fixed: entity.fixed,
        door: has_door.then_some(door),
        visible_at_start: entity.visible.filter(|_| is_lost),
        walk: None,
        moved: false,
        mass_kg: entity.mass_kg.unwrap_or(MASS_KG),
        width_m: entity.width().unwrap_or(WIDTH_M),
        fields: entity.fields.clone(),
    }
}

/// Name of an entity in words: its first, else its id.
fn name(entity: &Entity) -> SmolStr {
    if entity.kind == kinds::PERSON {
        return format!("`{}`", entity.id).into();
    }
    let words = entity.names.first().unwrap_or(&entity.id);
    format!("the {}", words.replace('_', " ")).into()
}

/// The standard kind that an entity's kind descends from. Of a kind that nobody declared, the entity itself
/// tells.
fn role(entity: &Entity, options: &SimOptions) -> Role {
    let mut kind = &entity.kind;
    for _ in 0..=options.kinds.len() {
        match kind.as_str() {
            kinds::PLACE | kinds::ZONE => return Role::Place,
            kinds::SURFACE => return Role::Surface,
            kinds::CONTAINER => return Role::Container,
            kinds::OBJECT => return Role::Object,
            kinds::PERSON => return Role::Person,
            _ => {}
        }
        match options.kinds.get(kind) {
            Some(parent) => kind = parent,
            None => break,
        }
    }
    match (entity.open.is_some() || entity.travel.is_some(), entity.fixed) {
        (true, _) => Role::Container,
        (false, true) => Role::Surface,
        (false, false) => Role::Object,
    }
}

/// The shape of a thing of which none is given.
const fn usual_shape(role: Role) -> Option<EntityShape> {
    match role {
        Role::Place => Some(EntityShape::Cylinder { radius: 0.01, height: 0.0 }),
        Role::Surface => Some(EntityShape::Box([0.8, 1.2, 0.72])),
        Role::Container => Some(EntityShape::Box([0.5, 0.5, 0.7])),
        Role::Person => Some(EntityShape::Cylinder { radius: 0.3, height: 1.7 }),
        Role::Object => None,
    }
}

/// A row of spots beside everything that has a place.
struct Row {
    x: f64,
    y: f64,
}

impl Row {
    fn beside(scene: &Scene) -> Self {
        let [x, y, _] = scene.robot.base;
        let placed = scene.entities.values().filter_map(|entity| entity.pose);
        let far = placed.map(|pose| pose.xyz[0]).fold(x, f64::max);
        Self { x: far, y }
    }

    fn next_spot(&mut self) -> [f64; 2] {
        self.x += ROW_M;
        [self.x, self.y]
    }
}

impl SimWorld {
    /// Makes the facts true that are not yet, in order. A fact of something that does not exist is left out,
    /// and so is one that can only come about, such as `visited`.
    pub(crate) fn believe(&mut self, initial_facts: &InitialFacts) {
        for ((fluent, args), holds) in initial_facts {
            let args: Vec<&str> = args.iter().map(SmolStr::as_str).collect();
            if self.fact(fluent, &args, &InitialFacts::new()).is_none_or(|is| is == *holds) {
                continue;
            }
            self.make(fluent, &args, *holds);
        }
    }

    fn make(&mut self, fluent: &str, args: &[&str], holds: bool) {
        match (fluent, args, holds) {
            (fluents::ON, [id, support], true) => self.lay(id, support, Rest::On((*support).into())),
            (fluents::IN, [id, container], true) => self.lay(id, container, Rest::In((*container).into())),
            (fluents::ON | fluents::IN, [id, _], false) => self.set_rest(id, Rest::Free),
            (fluents::HOLDING, [id], true) => self.hold_at_start(&(*id).into()),
            (fluents::HOLDING, [id], false) => self.slip(id),
            (fluents::OPEN, [id], open) => self.set_open(id, open),
            (fluents::LOCKED, [id], locked) => self.set_locked(id, locked),
            (fluents::STANDING, [entities::ROBOT], standing) => self.standing = standing,
            (fluents::AT, [entities::ROBOT, place], true) => {
                if let Some(stance) = self.place_for(place) {
                    self.base = stance;
                }
            }
            (fluents::VISIBLE, [id], visible) => {
                if let Some(thing) = self.things.get_mut(*id).filter(|thing| !thing.placed) {
                    thing.visible_at_start = Some(visible);
                }
            }
            (_, _, _) => {}
        }
    }

    fn set_rest(&mut self, id: &str, rest: Rest) {
        if let Some(thing) = self.things.get_mut(id) {
            thing.rest = rest;
        }
    }
}

impl SimWorld {
    /// The world as it is, where this one is as the robot was told: what stands on something stands a little
    /// elsewhere on it, or on something else.
    pub(crate) fn displaced(&self, rates: &RoomRates, seed: u64) -> Self {
        let (mut world, chance) = (self.clone(), Chance::new(seed, 0));
        let is_loose = |(id, thing): &(&SmolStr, &Thing)| {
            thing.role == Role::Object && !thing.fixed && self.holder(id).is_none()
        };
        let loose: Vec<SmolStr> = self.things.iter().filter(is_loose).map(|(id, _)| id.clone()).collect();
        for id in &loose {
            let Some(Rest::On(support)) = self.thing(id).map(|thing| thing.rest.clone()) else { continue };
            if chance.comes(rates.misplaced, "misplaced", id) {
                world.misplace(id, &support, chance.share("surface", id));
                continue;
            }
            let [dx, dy] = chance.error(rates.shift_m, "shift", id);
            world.nudge(id, [dx, dy]);
        }
        for thing in world.things.values_mut() {
            thing.moved = false;
        }
        world
    }

    /// Puts a thing on another surface, drawn by a number in `0 .. 1`.
    fn misplace(&mut self, id: &str, support: &str, drawn: f64) {
        let is_other = |(other, thing): &(&SmolStr, &Thing)| thing.role == Role::Surface && *other != support;
        let others: Vec<SmolStr> =
            self.things.iter().filter(is_other).map(|(other, _)| other.clone()).collect();
        let index = (drawn * others.len() as f64) as usize;
        if let Some(other) = others.get(index) {
            self.lay(id, other, Rest::On(other.clone()));
        }
    }

    /// Moves a thing a little on its support, unless it would leave it or touch something else on it.
    pub(crate) fn nudge(&mut self, id: &str, [dx, dy]: [f64; 2]) {
        let Some(thing) = self.thing(id) else { return };
        let mut body = thing.body;
        (body.xyz[0], body.xyz[1]) = (body.x() + dx, body.y() + dy);
        let Some(support) = thing.rest.support().and_then(|support| self.thing(support)) else { return };
        let placed = body.placed();
        let stays = support.body.holds_disc(body.x(), body.y(), 0.0);
        let mut others = self.things.iter().filter(|(other, beside)| {
            *other != id && beside.rest == thing.rest && beside.role == Role::Object
        });
        if stays && others.all(|(_, other)| other.body.placed().gap(&placed) > 0.005) {
            self.shift(id, [dx, dy, 0.0]);
        }
    }
}

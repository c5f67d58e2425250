//! Manipulation: effects of the hands on the world, and their failures.

use crate::body::BasePose;
use crate::camera::front;
use crate::command::Placing;
use crate::failure::Failure;
use crate::motion::standing_place;
use crate::world::{Rest, Role, SimWorld, Thing};
use motet_graph::Pose;
use motet_robots::scene::{
    PLACED_BESIDE_M, PLACED_NEAR_M, PLACED_TOLERANCE_M, ServedKind, person_gap, serving_gap,
};
use motet_stdlib::lang::failures;
use smol_str::SmolStr;

/// Distance that the base may shuffle along what it stands at, in m, while the hand is used.
const SHUFFLE_M: f64 = 1.5;
/// Distance that `push` pushes, in m.
const PUSH_M: f64 = 0.1;
/// Between the base's rim and what it stands at, in m.
const MARGIN_M: f64 = 0.03;
/// Share of the reach that the base's own extent takes. A robot with a long body stands sideways.
const BASE_SHARE: f64 = 0.4;
/// Distance in m from a thing's outline within which a hand that closes at a point still holds the thing.
const NEAR_GRASP_M: f64 = 0.05;

impl SimWorld {
    /// True if a hand reaches a point from a stance: distance in the plane and height.
    pub(crate) fn serves(&self, stance: BasePose, xyz: [f64; 3]) -> bool {
        let [x, y, z] = xyz;
        let near = stance.distance_to(x, y) <= self.reach() + 1e-6;
        let level = |grip: &crate::world::HandState| {
            (grip.hand.heights_m.least..=grip.hand.heights_m.greatest).contains(&z)
        };
        near && self.hands.values().any(level)
    }

    /// Position where the base stands to serve an entity: for an object in or on something, at the edge of
    /// that.
    pub(crate) fn place_for(&self, id: &str) -> Option<BasePose> {
        let root = self.root(id).to_owned();
        let (thing, target) = (self.thing(id)?, self.thing(&root)?);
        if target.role == Role::Place && root == id {
            let [x, y, heading] = [target.body.x(), target.body.y(), target.body.yaw];
            return Some(BasePose { x, y, heading });
        }
        let radius = self.drive.radius_m;
        let clearance = match target.role {
            Role::Person => person_gap(radius, self.reach()),
            Role::Surface | Role::Container | Role::Object | Role::Place => self.base_extent() + MARGIN_M,
        };
        let wanted: Vec<[f64; 2]> = if root == id {
            self.resting(id).map(|(_, thing)| [thing.body.x(), thing.body.y()]).collect()
        } else {
            vec![[thing.body.x(), thing.body.y()]]
        };
        let others = self.obstacles(&root);
        let mut stance = standing_place(
            (&target.body, front(target)),
            clearance,
            self.reach(),
            self.base,
            &wanted,
            &others,
            radius,
        )?;
        if root != id {
            stance.heading += stance.bearing_of(thing.body.x(), thing.body.y());
        }
        Some(stance)
    }

    /// The stance from which a hand reaches a thing without going elsewhere: here, or a shuffle along what it
    /// stands at.
    pub(crate) fn stance_for_hand(&self, id: &str) -> Option<BasePose> {
        let thing = self.thing(id)?;
        if self.serves(self.base, thing.body.xyz) {
            return Some(self.base);
        }
        let root = self.root(id);
        if root == id || !self.stands_at(root) {
            return None;
        }
        let stance = self.place_for(id)?;
        let close = stance.distance_to(self.base.x, self.base.y) <= SHUFFLE_M;
        (close && self.serves(stance, thing.body.xyz)).then_some(stance)
    }

    /// True if the robot stands so that it serves an entity.
    pub(crate) fn stands_at(&self, id: &str) -> bool {
        if self.served_at_start.as_deref() == Some(id) {
            return true;
        }
        let Some(thing) = self.thing(id) else { return false };
        if self.is_lifted(id) {
            return false;
        }
        thing.body.gap(self.base.x, self.base.y) <= self.serving_gap(thing.role) + 1e-6
    }

    /// The greatest distance in m from the base's axis to the outline of what it serves.
    fn serving_gap(&self, role: Role) -> f64 {
        let kind = match role {
            Role::Place => ServedKind::Place,
            Role::Person => ServedKind::Person,
            Role::Object => ServedKind::Object,
            Role::Surface | Role::Container => ServedKind::Furniture,
        };
        serving_gap(kind, self.reach())
    }

    /// Failure with which a hand cannot take a thing at its place, if any.
    pub(crate) fn cannot_take(&self, id: &str) -> Option<Failure> {
        let name = self.name(id);
        let Some(thing) = self.thing(id) else {
            return Some(Failure::new(failures::NOT_FOUND, format!("there is no {name}")));
        };
        let any = |fits: fn(&crate::world::HandState, &Thing) -> bool| {
            self.hands.values().any(|grip| fits(grip, thing))
        };
        if let Some(container) = self.shut_in(id) {
            let text = format!("{name} is in {}, which is closed", self.name(container));
            Some(Failure::new(failures::BLOCKED, text))
        } else if self.stance_for_hand(id).is_none() {
            let far = self.base.distance_to(thing.body.x(), thing.body.y());
            let text = format!("{name} is {far:.2} m away, and the hand reaches {:.2} m", self.reach());
            Some(Failure::new(failures::UNREACHABLE, text))
        } else if thing.fixed {
            Some(Failure::new(failures::TOO_HEAVY, format!("{name} is fixed")))
        } else if !any(|grip, thing| thing.mass_kg <= grip.hand.payload_kg) {
            Some(Failure::new(failures::TOO_HEAVY, format!("{name} weighs {} kg", thing.mass_kg)))
        } else if !any(|grip, thing| thing.width_m <= grip.hand.opening_m) {
            Some(Failure::new(failures::UNREACHABLE, format!("{name} is {} m wide", thing.width_m)))
        } else {
            None
        }
    }

    /// Distance in m by which a grasp of a thing may miss its middle: half of the room between the fingers.
    pub(crate) fn grasp_margin(&self, id: &str) -> f64 {
        let Some(thing) = self.thing(id) else { return 0.0 };
        let spare = |grip: &crate::world::HandState| (grip.hand.opening_m - thing.width_m) / 2.0;
        self.hands.values().map(spare).fold(0.0, f64::max)
    }

    /// Checks a pose that a hand is to close at: within reach, and at the thing.
    pub(crate) fn grasp_at(&self, id: &str, at: &Pose) -> Result<(), Failure> {
        let ([x, y, z], name) = (at.xyz, self.name(id));
        let Some(thing) = self.thing(id) else {
            return Err(Failure::new(failures::NOT_FOUND, format!("there is no {name}")));
        };
        if !self.serves(self.base, at.xyz) {
            let far = self.base.distance_to(x, y);
            let reach = self.reach();
            let text = format!(
                "the point is {far:.2} m away at a height of {z:.2} m, the hand reaches {reach:.2} m"
            );
            return Err(Failure::new(failures::UNREACHABLE, text));
        }
        let body = &thing.body;
        let beyond = (z - body.top()).max(body.bottom() - z).max(0.0);
        let off = body.gap(x, y).hypot(beyond);
        if off > NEAR_GRASP_M {
            let text = format!("the hand closes {off:.2} m beside {name}");
            return Err(Failure::new(failures::NOT_FOUND, text));
        }
        Ok(())
    }

    /// True if a motion that grasps a thing from here exists.
    pub(crate) fn is_reachable(&self, id: &str) -> bool {
        self.holder(id).is_none() && self.cannot_take(id).is_none()
    }

    /// Closes a free hand of `uses` around a thing.
    pub(crate) fn grasp(&mut self, id: &str, uses: &[SmolStr]) -> Result<(), Failure> {
        let used =
            |name: &SmolStr| !uses.iter().any(|used| self.hands.contains_key(used)) || uses.contains(name);
        if self.holder(id).is_some() {
            return Err(Failure::new(failures::FAILED, format!("the hand holds {} already", self.name(id))));
        }
        let free = self.hands.iter().find(|(name, grip)| grip.holds.is_none() && used(name));
        let Some(hand) = free.map(|(name, _)| name.clone()) else {
            return Err(Failure::new(failures::FAILED, "no hand is free"));
        };
        self.cannot_take(id).map_or(Ok(()), Err)?;
        if let Some(grip) = self.hands.get_mut(&hand) {
            grip.holds = Some(id.into());
            grip.lifted = false;
        }
        Ok(())
    }

    /// Lifts what the hands hold.
    pub(crate) fn lift(&mut self) -> Result<(), Failure> {
        let held: Vec<_> = self.hands.values().filter_map(|grip| grip.holds.clone()).collect();
        if held.is_empty() {
            return Err(Failure::new(failures::SLIPPED, "the hand holds nothing"));
        }
        for id in held {
            if let Some(thing) = self.things.get_mut(&id) {
                thing.rest = Rest::Free;
            }
        }
        for grip in self.hands.values_mut() {
            grip.lifted = grip.holds.is_some();
        }
        self.carry();
        Ok(())
    }

    /// Opens the hand that holds a thing.
    fn release(&mut self, id: &str) {
        for grip in self.hands.values_mut() {
            if grip.holds.as_deref() == Some(id) {
                grip.holds = None;
                grip.lifted = false;
            }
        }
    }

    /// Puts a held thing down where the rules allow it.
    pub(crate) fn place(&mut self, id: &str, on: &str, rules: &Placing) -> Result<(), Failure> {
        self.must_hold(id)?;
        let name = self.name(on);
        let target = self
            .thing(on)
            .ok_or_else(|| Failure::new(failures::UNREACHABLE, format!("there is no {name}")))?;
        if on == id {
            return Err(failures::BLOCKED.into());
        }
        self.must_stand_at(on)?;
        let (body, role) = (target.body, target.role);
        let (rest, bottom) = match role {
            Role::Container if !target.is_open() || self.shut_in(on).is_some() => {
                return Err(Failure::new(failures::BLOCKED, format!("{name} is closed")));
            }
            Role::Container => (Rest::In(on.into()), body.bottom() + 0.01),
            Role::Surface | Role::Object => (Rest::On(on.into()), body.top()),
            Role::Place => (Rest::Free, 0.0),
            Role::Person => return Err(Failure::new(failures::BLOCKED, "things are handed to people")),
        };
        let no_spot = || Failure::new(failures::BLOCKED, format!("there is no free spot on {name}"));
        let spot = self.spot(id, on, rules, Some(self.base)).ok_or_else(no_spot)?;
        if rules.at.is_some() && !self.serves(self.base, [spot[0], spot[1], bottom]) {
            return Err(Failure::new(failures::UNREACHABLE, format!("the spot on {name} is out of reach")));
        }
        self.release(id);
        if let (Some(pose), Some(thing)) = (&rules.at, self.things.get_mut(id)) {
            thing.body.yaw = pose.yaw();
        }
        self.put(id, spot, bottom, rest);
        Ok(())
    }

    fn must_hold(&self, id: &str) -> Result<(), Failure> {
        if self.holder(id).is_some() {
            return Ok(());
        }
        Err(Failure::new(failures::SLIPPED, format!("the hand does not hold {}", self.name(id))))
    }

    fn must_stand_at(&self, id: &str) -> Result<(), Failure> {
        if self.stands_at(id) {
            return Ok(());
        }
        let (name, reach) = (self.name(id), self.reach());
        let far = self.thing(id).map(|thing| thing.body.gap(self.base.x, self.base.y));
        Err(Failure::new(
            failures::UNREACHABLE,
            match far {
                Some(far) => format!("{name} is {far:.2} m away, and the hand reaches {reach:.2} m"),
                None => format!("there is no {name}"),
            },
        ))
    }

    /// The spot on a support for a thing; on a surface one that is served `from` a stance, if there is one.
    fn spot(&self, id: &str, on: &str, rules: &Placing, from: Option<BasePose>) -> Option<[f64; 2]> {
        let target = self.thing(on)?;
        let body = target.body;
        if let Some(pose) = &rules.at {
            return self.spot_at(id, on, pose);
        }
        if target.role != Role::Surface {
            return Some([body.x(), body.y()]).filter(|spot| self.fits(id, on, rules, *spot));
        }
        let (stance, ahead) = (from.unwrap_or(self.base), 0.8 * self.reach());
        let near = [stance.x + ahead * stance.heading.cos(), stance.y + ahead * stance.heading.sin()];
        let step = if rules.is_any() { 0.05 } else { 0.02 };
        self.free_spot(id, on, (near, step), |x, y| {
            let is_served = from.is_none_or(|from| self.serves(from, [x, y, body.top()]));
            is_served && self.fits(id, on, rules, [x, y])
        })
    }

    /// The stance from which a thing is put where the rules allow it: here, or a shuffle along the support.
    pub(crate) fn stance_for_place(&self, id: &str, on: &str, rules: &Placing) -> BasePose {
        let serves = |stance: BasePose, [x, y]: [f64; 2]| {
            self.thing(on).is_some_and(|target| self.serves(stance, [x, y, target.body.top()]))
        };
        let here = self.spot(id, on, rules, Some(self.base)).filter(|spot| serves(self.base, *spot));
        let elsewhere = || {
            let (spot, target) = (self.spot(id, on, rules, None)?, self.thing(on)?);
            let others = self.obstacles(on);
            let (reach, radius, clearance) =
                (self.reach(), self.drive.radius_m, self.base_extent() + MARGIN_M);
            let stance = standing_place(
                (&target.body, front(target)),
                clearance,
                reach,
                self.base,
                &[spot],
                &others,
                radius,
            )?;
            let is_close = stance.distance_to(self.base.x, self.base.y) <= SHUFFLE_M;
            (is_close && serves(stance, spot)).then_some(stance)
        };
        if here.is_some() || !self.stands_at(on) { self.base } else { elsewhere().unwrap_or(self.base) }
    }

    /// The stance from which a container is opened and closed: before its front, if that is a shuffle away.
    pub(crate) fn stance_for_door(&self, id: &str) -> BasePose {
        let has_front = self.thing(id).is_some_and(|thing| front(thing).is_some());
        let before =
            || self.place_for(id).filter(|stance| stance.distance_to(self.base.x, self.base.y) <= SHUFFLE_M);
        if has_front && self.stands_at(id) { before().unwrap_or(self.base) } else { self.base }
    }

    /// Checks if a thing put on a spot keeps to the rules for its place.
    fn fits(&self, id: &str, on: &str, rules: &Placing, [x, y]: [f64; 2]) -> bool {
        let (Some(thing), Some(support)) = (self.thing(id), self.thing(on)) else { return false };
        let mut body = thing.body;
        body.put(x, y, support.body.top());
        let stands = body.placed();
        let gap = |other: &SmolStr| self.thing(other).map(|other| other.body.placed().gap(&stands));
        let is_near = |other: &SmolStr| gap(other).is_some_and(|gap| gap <= PLACED_NEAR_M);
        let is_beside = |other: &SmolStr| {
            let is_there = self.resting(on).any(|(resting, _)| resting == other);
            let [least, most] = PLACED_BESIDE_M;
            is_there && gap(other).is_some_and(|gap| (least..=most).contains(&gap))
        };
        let room = support.body.placed().room_around(&stands);
        rules.near.as_ref().is_none_or(is_near)
            && rules.beside.as_ref().is_none_or(is_beside)
            && (rules.from_edge == 0.0 || room >= rules.from_edge - PLACED_TOLERANCE_M)
    }

    /// The point of a pose as a spot on a support, if the thing has room there.
    fn spot_at(&self, id: &str, on: &str, pose: &Pose) -> Option<[f64; 2]> {
        let ([x, y, _], support) = (pose.xyz, self.thing(on)?.body);
        let mut body = self.thing(id)?.body;
        body.yaw = pose.yaw();
        body.put(x, y, support.top());
        let stands = body.placed();
        let mut others = self.resting(on).filter(|(other, _)| *other != id);
        let is_on = support.placed().room_around(&stands) >= -PLACED_TOLERANCE_M;
        (is_on && others.all(|(_, other)| other.body.placed().gap(&stands) > 0.0)).then_some([x, y])
    }

    /// Checks if the base has room at a point.
    pub(crate) fn has_room_at(&self, x: f64, y: f64) -> bool {
        self.obstacles("").iter().all(|other| other.gap(x, y) >= self.base_extent())
    }

    /// Distance in m from the base's axis that the base takes towards what it stands at.
    pub(crate) fn base_extent(&self) -> f64 {
        self.drive.radius_m.min(BASE_SHARE * self.reach())
    }

    /// Hands a held thing to a person.
    pub(crate) fn hand_over(&mut self, id: &str, to: &str) -> Result<(), Failure> {
        self.must_hold(id)?;
        self.must_stand_at(to)?;
        let person = self.thing(to).ok_or(failures::UNREACHABLE)?.body;
        self.release(id);
        self.put(id, [person.x(), person.y()], person.bottom() + 1.0, Rest::With(to.into()));
        Ok(())
    }

    /// Drops a held thing to the floor.
    pub(crate) fn slip(&mut self, id: &str) {
        if self.holder(id).is_none() {
            return;
        }
        let lifted = self.is_lifted(id);
        self.release(id);
        if lifted && let Some(body) = self.thing(id).map(|thing| thing.body) {
            self.put(id, [body.x(), body.y()], 0.0, Rest::Free);
        }
    }

    /// The hand opens or closes a container.
    pub(crate) fn work_door(&mut self, id: &str, open: bool) -> Result<(), Failure> {
        self.must_stand_at(id)?;
        self.must_have_a_hand()?;
        let thing = self.thing(id).ok_or(failures::UNREACHABLE)?;
        match thing.door {
            None if open => return Ok(()),
            None => return Err(Failure::new(failures::BLOCKED, format!("{} has no door", thing.name))),
            Some(door) if open && door.locked && !door.open => {
                return Err(Failure::new(failures::REFUSED, format!("{} is locked", thing.name)));
            }
            Some(_) => {}
        }
        self.set_open(id, open);
        Ok(())
    }

    fn must_have_a_hand(&self) -> Result<(), Failure> {
        if self.hands.values().all(|grip| grip.holds.is_some()) {
            return Err(Failure::new(failures::BLOCKED, "no hand is free"));
        }
        Ok(())
    }

    /// A container opens or closes, whoever does it.
    pub(crate) fn set_open(&mut self, id: &str, open: bool) {
        let Some(thing) = self.things.get_mut(id) else { return };
        let slide = thing.slide();
        let Some(door) = thing.door.as_mut().filter(|door| door.open != open) else { return };
        door.open = open;
        self.shift(id, if open { slide } else { slide.map(|part| -part) });
    }

    /// The hand pushes a thing away from the robot. On its support it goes no further than the edge.
    pub(crate) fn push(&mut self, id: &str) -> Result<(), Failure> {
        if self.stance_for_hand(id).is_none() {
            self.must_stand_at(id)?;
        }
        self.must_have_a_hand()?;
        let thing = self.thing(id).ok_or(failures::UNREACHABLE)?;
        if thing.fixed {
            return Err(Failure::new(failures::BLOCKED, format!("{} is fixed", thing.name)));
        }
        let (dx, dy) = (thing.body.x() - self.base.x, thing.body.y() - self.base.y);
        let length = dx.hypot(dy).max(1e-6);
        let by = [PUSH_M * dx / length, PUSH_M * dy / length, 0.0];
        let stays =
            thing.rest.support().and_then(|support| self.thing(support)).is_none_or(|support| {
                support.body.gap(thing.body.x() + by[0], thing.body.y() + by[1]) <= 0.0
            });
        if stays {
            self.shift(id, by);
        }
        Ok(())
    }
}

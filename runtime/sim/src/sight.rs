//! Sight of the robot: what a look sees of the world as it is, what it takes it for, and what the robot
//! believes from then on.
//!
//! The belief about a thing changes by sight and touch alone. What is in view is noted, up to the error of
//! the camera; what is not seen where it was believed to be, although nothing hides that place, is lost.

use crate::body::distance;
use crate::chance::Chance;
use crate::failure::Failure;
use crate::sim::Sim;
use crate::world::{Rest, Role, SimWorld, Thing, ViewDirection};
use motet_graph::Pose;
use motet_robots::scene::{Entity, Palette, colour};
use motet_runtime::{ToldSupport, ToldThing};
use motet_stdlib::lang::failures;
use smol_str::SmolStr;

/// Least share of a thing that has to show for the robot to see it.
const SEEN_SHARE: f64 = 0.25;
/// Least share of a place that has to show for the robot to see that nothing is there.
const EMPTY_SHARE: f64 = 0.6;
/// Difference in m between a belief and the truth that is none.
const SAME_M: f64 = 0.01;
/// Apparent size in rad for which a profile gives the rate of misses: 10 cm at 1 m.
const MISS_RAD: f64 = 0.1;
/// Greatest probability of a miss.
const MOST_MISSED: f64 = 0.95;
/// Difference in m between a belief and what is seen from which on it is news.
const NEWS_M: f64 = 0.02;

impl SimWorld {
    /// True if a look sees a thing now. What is said of one that has no place in the scene counts until the
    /// base has moved or the thing has, except for a look all around.
    pub(crate) fn is_visible(&self, id: &str, look: ViewDirection) -> bool {
        let Some(thing) = self.thing(id) else { return false };
        if let Some(said) = thing.visible_at_start
            && look != ViewDirection::Around
            && self.unmoved
            && !thing.moved
        {
            return said;
        }
        self.sees(id, look)
    }

    /// True if a thing is in range and view, not shut in, and enough of it shows.
    pub(crate) fn sees(&self, id: &str, look: ViewDirection) -> bool {
        let Some(thing) = self.thing(id) else { return false };
        self.is_in_range(thing)
            && self.shut_in(id).is_none()
            && self.seen_share(id, thing, look) >= SEEN_SHARE
    }

    fn is_in_range(&self, thing: &Thing) -> bool {
        let gap = thing.body.gap(self.base.x, self.base.y);
        self.cameras.iter().any(|camera| gap <= camera.range_m)
    }

    /// Probability that a look misses a thing in view, for a rate of misses; and the share of it that shows.
    pub(crate) fn miss(&self, id: &str, rate: f64, look: ViewDirection) -> [f64; 2] {
        let Some(thing) = self.thing(id) else { return [MOST_MISSED, 0.0] };
        let (share, body) = (self.seen_share(id, thing, look), &thing.body);
        let size = (2.0 * body.radius()).max(body.top() - body.bottom());
        let far = self.base.distance_to(body.x(), body.y()).max(0.1);
        let angle = (size / far).max(1e-6);
        [(rate * MISS_RAD / angle / share.max(0.05)).min(MOST_MISSED), share]
    }
}

impl Sim {
    /// Draws of the present occasion: the call that runs, and the look within it.
    pub(crate) const fn chance(&self) -> Chance {
        Chance::new(self.seed, self.occasion)
    }

    /// The robot feels what it does: where it stands, and what its hands hold.
    pub(crate) fn feel(&mut self) {
        let (world, belief) = (&self.world, &mut self.belief);
        belief.now = world.now;
        belief.base = world.base;
        belief.arm = world.arm;
        belief.standing = world.standing;
        belief.battery = world.battery;
        belief.unmoved = world.unmoved;
        if belief.served_at_start.is_some() && world.served_at_start.is_none() {
            belief.served_at_start = None;
        }
        for (name, grip) in &world.hands {
            let held = belief.hands.get(name).and_then(|before| before.holds.clone());
            if let Some(before) = held.filter(|before| Some(before) != grip.holds.as_ref()) {
                belief.slip(&before);
            }
            if let Some(now) = &grip.holds
                && grip.lifted
                && let Some(thing) = belief.things.get_mut(now)
            {
                thing.rest = Rest::Free;
                thing.lost = false;
            }
            if let Some(own) = belief.hands.get_mut(name) {
                own.holds.clone_from(&grip.holds);
                own.lifted = grip.lifted;
            }
        }
        belief.carry();
    }

    /// Notes a thing as it is, up to the error of the camera: after sight or touch.
    pub(crate) fn notice(&mut self, id: &str) {
        let Some(truth) = self.world.thing(id).cloned() else { return };
        let far = self.world.base.distance_to(truth.body.x(), truth.body.y());
        let error_m = if truth.fixed { 0.0 } else { self.profile.camera.error_per_m * far };
        let mut seen = truth.body.xyz;
        let before = self.belief.thing(id).map(|thing| (thing.body.xyz, thing.lost));
        match before {
            // A second look from here says the same as the first.
            Some((known, false)) if distance(known, seen) <= 2.0 * error_m => seen = known,
            Some(_) | None => {
                let [dx, dy] = self.chance().error(error_m, "camera", id);
                (seen[0], seen[1]) = (seen[0] + dx, seen[1] + dy);
            }
        }
        if let Some((known, _)) = before {
            self.belief.shift(id, [seen[0] - known[0], seen[1] - known[1], seen[2] - known[2]]);
        } else {
            self.belief.things.insert(id.into(), truth.clone());
        }
        if let Some(thing) = self.belief.things.get_mut(id) {
            thing.body = truth.body;
            thing.body.xyz = seen;
            (thing.rest, thing.door) = (truth.rest, truth.door);
            (thing.walk, thing.visible_at_start) = (None, None);
        }
        self.belief.saw(id);
        let is_news =
            before.is_none_or(|(known, lost)| lost || distance(known, seen) > NEWS_M.max(2.0 * error_m));
        if is_news && !truth.fixed {
            let (sin, cos) = (truth.body.yaw / 2.0).sin_cos();
            let pose = Pose { xyz: seen, quaternion: [0.0, 0.0, sin, cos] };
            let seen = self.detection(&id.into(), pose, error_m, (1.0, self.world.now));
            self.sighted.retain(|known| known.entity != seen.entity);
            self.sighted.push_back(seen);
        }
    }

    /// Takes in what the robot is told of a thing. It believes this until it sees something else; what its
    /// hand holds it feels.
    pub(crate) fn hear_of(&mut self, told: &ToldThing) {
        let id = &told.id;
        if self.world.holder(id).is_some() {
            return;
        }
        if !self.belief.things.contains_key(id)
            && let Some(thing) = self.world.thing(id).cloned()
        {
            self.belief.things.insert(id.clone(), thing);
        }
        match &told.support {
            Some(ToldSupport::On(place)) => self.belief.lay(id, place, Rest::On(place.clone())),
            Some(ToldSupport::In(place)) => self.belief.lay(id, place, Rest::In(place.clone())),
            Some(ToldSupport::At(place)) => self.belief.lay(id, place, Rest::With(place.clone())),
            None => {}
        }
        let Some(thing) = self.belief.things.get_mut(id) else { return };
        if let Some(pose) = told.pose {
            thing.body.xyz = pose.xyz;
        }
        (thing.lost, thing.seen_at, thing.visible_at_start) = (false, None, None);
    }

    /// Look that answers a question: the robot turns its camera, unless the arm bears it and is in use.
    pub(crate) fn glance(&self) -> ViewDirection {
        let is_busy = self.world.eye.is_on_arm && !self.tasks.is_empty();
        if is_busy { ViewDirection::Still } else { ViewDirection::Ahead }
    }

    /// Compares the belief about a thing with what is in view.
    pub(crate) fn refresh(&mut self, id: &str, look: ViewDirection) {
        if self.world.holder(id).is_some() {
            return;
        }
        let truth = self.world.thing(id);
        // A laser sees people on all sides.
        let look = match truth.map(|thing| thing.role) {
            Some(Role::Person) => ViewDirection::Around,
            Some(Role::Place) => return,
            Some(Role::Surface | Role::Container | Role::Object) | None => look,
        };
        if self.world.is_visible(id, look) {
            self.notice(id);
            return;
        }
        let Some(believed) = self.belief.thing(id).filter(|thing| !thing.lost) else { return };
        let is_right = truth.is_some_and(|truth| {
            distance(truth.body.xyz, believed.body.xyz) <= SAME_M && truth.rest == believed.rest
        });
        if !is_right
            && self.world.is_in_range(believed)
            && self.world.seen_share(id, believed, look) >= EMPTY_SHARE
            && let Some(thing) = self.belief.things.get_mut(id)
        {
            (thing.lost, thing.seen_at, thing.rest) = (true, None, Rest::Free);
        }
    }

    /// Compares the belief about everything that moves with what is in view.
    pub(crate) fn look_about(&mut self, look: ViewDirection) {
        let loose = self.world.things.iter().filter(|(_, thing)| !thing.fixed || thing.door.is_some());
        let ids: Vec<SmolStr> = loose.map(|(id, _)| id.clone()).collect();
        ids.iter().for_each(|id| self.refresh(id, look));
    }

    /// The objects in view that a look takes for what is described, in the order of the scene.
    pub(crate) fn found(&mut self, what: &str, look: ViewDirection) -> Vec<SmolStr> {
        let (chance, rates) = (self.chance(), &self.profile.camera);
        let is_seen = |id: &SmolStr| {
            let [miss, _] = self.world.miss(id, rates.miss, look);
            self.world.is_visible(id, look) && !chance.comes(miss, "miss", id)
        };
        let fitting = self.described(what);
        let mut found: Vec<SmolStr> = fitting.iter().filter(|id| is_seen(id)).cloned().collect();
        if chance.comes(rates.confuse, "confuse", what)
            && let Some(meant) = fitting.first()
        {
            let alike = |id: &&SmolStr| {
                !fitting.contains(id) && self.is_object(id) && self.look_alike(meant, id) && is_seen(id)
            };
            if let Some(other) = self.world.things.keys().find(alike) {
                found = vec![other.clone()];
            }
        }
        found.iter().for_each(|id| self.notice(id));
        if let Some(thing) = found.first().and_then(|id| self.world.thing(id)) {
            self.world.gaze = Some(self.world.aim(look, thing.body.middle()));
        }
        found
    }

    fn is_object(&self, id: &str) -> bool {
        self.world.thing(id).is_some_and(|thing| thing.role == Role::Object)
    }

    /// The objects that fit a description, seen or not.
    fn described(&self, what: &str) -> Vec<SmolStr> {
        let fitting = self.scene.matches(what).into_iter().map(|entity| entity.id.clone());
        let mut fitting: Vec<SmolStr> = fitting.filter(|id| self.is_object(id)).collect();
        // Entities that only the options name are called by their name.
        let added = self.world.things.keys().filter(|id| id.as_str() == what && self.is_object(id));
        for id in added {
            if !fitting.contains(id) {
                fitting.push(id.clone());
            }
        }
        fitting
    }

    /// True if two things are of one class or category, or have the same colour in a picture.
    fn look_alike(&self, one: &str, other: &str) -> bool {
        let [a, b] = [one, other].map(|id| self.scene.entities.get(id));
        let hue = |id: &str, entity: Option<&Entity>| colour(id, entity, Palette::Things);
        let is_alike = a.zip(b).is_some_and(|(a, b)| {
            (!a.class.is_empty() && a.class == b.class)
                || a.categories.iter().any(|category| b.categories.contains(category))
        });
        is_alike || hue(one, a) == hue(other, b)
    }

    /// Looks at a thing, turned towards where it is believed to be.
    pub(crate) fn look_at(&mut self, id: &str) -> Result<(), Failure> {
        if self.world.holder(id).is_some() {
            return Ok(());
        }
        let name = self.belief.name(id);
        let Some(believed) = self.belief.thing(id).map(|thing| thing.body) else {
            return Err(Failure::new(failures::NOT_FOUND, format!("there is no {name}")));
        };
        let look = ViewDirection::Ahead;
        if !self.world.frames(look, believed.middle()) {
            let bearing = self.world.base.bearing_of(believed.x(), believed.y());
            self.world.base.heading += bearing;
            self.world.carry();
            self.feel();
        }
        // The scene's word counts no longer, now that it is looked at.
        if let Some(thing) = self.world.things.get_mut(id) {
            thing.visible_at_start = None;
        }
        self.world.gaze = Some(self.world.aim(look, believed.middle()));
        let [miss, _] = self.world.miss(id, self.profile.camera.miss, look);
        if self.world.is_visible(id, look) && !self.chance().comes(miss, "miss", id) {
            self.notice(id);
            return Ok(());
        }
        self.refresh(id, look);
        let is_lost = self.belief.thing(id).is_some_and(|thing| thing.lost);
        let text = match self.belief.shut_in(id) {
            _ if is_lost => format!("{name} is not where it was believed to be"),
            Some(container) => format!("{name} is in {}, which is closed", self.belief.name(container)),
            None => format!("{name} is not in view from here"),
        };
        Err(Failure::new(failures::NOT_FOUND, text))
    }
}

/// The one of several, or why there is none.
pub(crate) fn the_one(found: Vec<SmolStr>, what: &str) -> Result<SmolStr, Failure> {
    let count = found.len();
    let mut found = found.into_iter();
    match (found.next(), found.next()) {
        (None, _) => Err(Failure::new(failures::NOT_FOUND, format!("nothing in view is \"{what}\""))),
        (Some(only), None) => Ok(only),
        (Some(_), Some(_)) => {
            Err(Failure::new(failures::AMBIGUOUS, format!("{count} things in view are \"{what}\"")))
        }
    }
}

//! Visibility of things, and matching of descriptions.

use crate::hand::Failure;
use crate::thing::{Role, Thing};
use crate::world::SimWorld;
use motet_robots::scene::Scene;
use smol_str::SmolStr;

/// Freedom of the robot to turn while it looks.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum ViewDirection {
    /// It looks where it looks.
    Ahead,
    /// It turns until it has seen everything about it.
    Around,
}

impl SimWorld {
    /// True if a camera sees a thing now. What the scene says of it counts until the base has moved or the
    /// thing has.
    pub(crate) fn is_visible(&self, id: &str) -> bool {
        let Some(thing) = self.thing(id) else { return false };
        if let Some(said) = thing.visible_at_start
            && self.unmoved
            && !thing.moved
        {
            return said;
        }
        self.sees(id, ViewDirection::Ahead)
    }

    /// True if a thing is in range and view and not shut in.
    pub(crate) fn sees(&self, id: &str, look: ViewDirection) -> bool {
        let Some(thing) = self.thing(id) else { return false };
        let body = &thing.body;
        let (distance, bearing) =
            (body.gap(self.base.x, self.base.y), self.base.bearing_of(body.x(), body.y()).abs());
        let in_view = self.cameras.iter().any(|camera| {
            let beside = distance < 1e-9 || bearing <= camera.view_rad / 2.0;
            distance <= camera.range_m && (beside || look == ViewDirection::Around)
        });
        in_view && self.shut_in(id).is_none()
    }

    /// The objects in view that fit a description, in the order of the scene.
    pub(crate) fn found(&self, scene: &Scene, what: &str, look: ViewDirection) -> Vec<SmolStr> {
        let in_view = |id: &SmolStr| match look {
            ViewDirection::Ahead => self.is_visible(id),
            ViewDirection::Around => self.sees(id, ViewDirection::Around),
        };
        self.described(scene, what).into_iter().filter(in_view).collect()
    }

    /// The objects that fit a description, seen or not.
    pub(crate) fn described(&self, scene: &Scene, what: &str) -> Vec<SmolStr> {
        let is_object = |id: &SmolStr| self.thing(id).is_some_and(|thing| thing.role == Role::Object);
        let mut fitting: Vec<SmolStr> =
            scene.matches(what).into_iter().map(|entity| entity.id.clone()).filter(is_object).collect();
        // Entities that only the options name are called by their name.
        let added = self.things.keys().filter(|id| id.as_str() == what && is_object(id));
        for id in added {
            if !fitting.contains(id) {
                fitting.push(id.clone());
            }
        }
        fitting
    }

    /// The one of several, or why there is none.
    pub(crate) fn the_one(found: Vec<SmolStr>) -> Result<SmolStr, Failure> {
        let mut found = found.into_iter();
        match (found.next(), found.next()) {
            (None, _) => Err("not_found"),
            (Some(only), None) => Ok(only),
            (Some(_), Some(_)) => Err("ambiguous"),
        }
    }

    /// Looks at a thing, turning towards it.
    pub(crate) fn look_at(&mut self, id: &str) -> Result<&Thing, Failure> {
        if !self.sees(id, ViewDirection::Around) {
            return Err("not_found");
        }
        if !self.is_visible(id) {
            // The scene's word counts no longer, now that it has been looked at.
            if let Some(thing) = self.things.get_mut(id) {
                thing.visible_at_start = None;
            }
            if !self.sees(id, ViewDirection::Ahead)
                && let Some(body) = self.thing(id).map(|thing| thing.body)
            {
                self.base.heading += self.base.bearing_of(body.x(), body.y());
                self.carry();
            }
        }
        self.saw(id);
        self.thing(id).ok_or("not_found")
    }
}

//! The hand alone at a pose: what it touches there is in the way of every arm.

use nalgebra::{Isometry3, Vector3};

use super::around::{above_floor, touches};
use super::machine::Hand;
use super::room::{GAP, Room};
use super::things::Thing;
use super::touch::{Allowed, Touch};
use crate::collision::Solid;

/// An open hand without its arm, and what is near the thing that it goes around.
pub(super) struct Palm<'r, 'w> {
    room: &'r Room<'w>,
    /// What is in the hand may touch this entity.
    beneath: Option<usize>,
    parts: Vec<Own>,
    things: Vec<Thing>,
}

/// A part of the hand, or what it holds.
struct Own {
    link: usize,
    is_held: bool,
    /// In the tip's frame.
    solid: Solid,
    reach: f64,
}

impl<'w> Room<'w> {
    /// The hand with its tip at any of some poses; `allowed` may be touched.
    pub(super) fn palm(&self, hand: &Hand, tips: &[Isometry3<f64>], allowed: Allowed) -> Palm<'_, 'w> {
        let joints = &self.world.robot.joints;
        // Around something the fingers stay as they are.
        let joints = if self.world.held.is_some() { joints.clone() } else { hand.opened(joints) };
        let poses = self.machine.tree().root_from_links(&joints);
        let tip_from_root = poses.get(hand.tip).map(Isometry3::inverse).unwrap_or_default();
        let parts = self.body.parts().iter().zip(0..);
        let parts = parts.filter(|(part, _)| hand.members.get(part.link) == Some(&true));
        let parts = parts.filter_map(|(part, at)| {
            let solid = part.solid.moved(&(tip_from_root * poses.get(part.link)?));
            Some(Own { link: part.link, is_held: self.held == Some(at), solid, reach: solid.reach() })
        });
        let parts: Vec<Own> = parts.collect();
        // The tip is this near to the middle of the poses, and a part reaches so far from the tip.
        let places = tips.iter().map(|tip| tip.translation.vector);
        let centre = places.clone().sum::<Vector3<f64>>() / (tips.len().max(1) as f64);
        let far = places.map(|place| (place - centre).norm()).fold(0.0, f64::max);
        let reach = parts.iter().map(|own| own.solid.centre.norm() + own.reach).fold(0.0, f64::max);
        let far = far + reach + GAP;
        let near = self.things.near([centre.x, centre.y], far).filter(|(_, thing)| {
            let wide = far + thing.reach;
            allowed.hand != Some(thing.entity) && (thing.solid.centre - centre).norm_squared() <= wide * wide
        });
        let things = near.map(|(_, thing)| *thing).collect();
        Palm { room: self, beneath: allowed.held, parts, things }
    }
}

impl Palm<'_, '_> {
    /// What it touches.
    pub(super) fn touch(&self, map_from_tip: &Isometry3<f64>) -> Option<Touch> {
        for own in &self.parts {
            let solid = own.solid.moved(map_from_tip);
            let told = |other| {
                let link = self.room.machine.tree().links().get(own.link).cloned().unwrap_or_default();
                Some(Touch { link, other, is_own: false })
            };
            for thing in &self.things {
                if own.is_held && self.beneath == Some(thing.entity) {
                    continue;
                }
                if touches(&solid, own.reach, &thing.solid, thing.reach) {
                    return told(self.room.name(thing.entity));
                }
            }
            if above_floor(&solid) <= GAP {
                return told("floor".into());
            }
        }
        None
    }
}

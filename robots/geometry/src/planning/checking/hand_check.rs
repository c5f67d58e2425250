//! Hand-only collision check: a contact of the hand alone excludes a grasp for every arm configuration.

use std::cell::{OnceCell, RefCell};

use nalgebra::{Isometry3, Translation3, Vector3};
use smol_str::SmolStr;

use super::collision_checker::is_nearer;
use crate::collision::Solid;
use crate::planning::scene::{
    AllowedCollisions, Contact, HandModel, MIN_CLEARANCE, Obstacle, Padding, PlanningScene, above_floor,
};
use crate::simd::{BatchCheck, BatchModel, NearPair, Obb, ObbSet, PairTarget, PosedBatch};

/// Open hand without its arm, and the obstacles near the object that it grasps.
pub(crate) struct HandChecker<'r, 'w> {
    scene: &'r PlanningScene<'w>,
    allowed: AllowedCollisions,
    parts: Vec<HandPart>,
    obstacles: Vec<Obstacle>,
    /// Mean position of the poses.
    middle: Vector3<f64>,
    /// Prefilter data seen from there, filled at first use; `None` where it does not apply.
    prefilter: OnceCell<Option<(BatchModel, ObbSet)>>,
    posed: RefCell<PosedBatch>,
}

/// Part of the hand, or the held object.
struct HandPart {
    link: usize,
    is_held: bool,
    /// Solid in the tip's frame.
    solid: Solid,
    reach: f64,
}

impl<'w> PlanningScene<'w> {
    /// Checker of the hand at any of some tip poses.
    pub(crate) fn hand_checker(
        &self,
        hand: &HandModel,
        tips: &[Isometry3<f64>],
        allowed: AllowedCollisions,
    ) -> HandChecker<'_, 'w> {
        let joints = &self.state.robot.joints;
        // Fingers around a held object stay closed.
        let joints = if self.state.held.is_some() { joints.clone() } else { hand.opened(joints) };
        let poses = self.model.tree().root_from_links(&joints);
        let tip_from_root = poses.get(hand.tip).map(Isometry3::inverse).unwrap_or_default();
        let parts = self.body.parts().iter().zip(0..);
        let parts = parts.filter(|(part, _)| hand.members.get(part.link) == Some(&true));
        let parts = parts.filter_map(|(part, at)| {
            let solid = part.solid.moved(&(tip_from_root * poses.get(part.link)?));
            Some(HandPart { link: part.link, is_held: self.held == Some(at), solid, reach: solid.reach() })
        });
        let parts: Vec<HandPart> = parts.collect();
        // Bound on the distance of any hand point from the mean position.
        let places = tips.iter().map(|tip| tip.translation.vector);
        let centre = places.clone().sum::<Vector3<f64>>() / (tips.len().max(1) as f64);
        let far = places.map(|place| (place - centre).norm()).fold(0.0, f64::max);
        let reach = parts.iter().map(|own| own.solid.centre.norm() + own.reach).fold(0.0, f64::max);
        let far = far + reach + Padding::new(self.clearance).most();
        let near = self.obstacles.near([centre.x, centre.y], far).filter(|(_, obstacle)| {
            let wide = far + obstacle.reach;
            allowed.hand != Some(obstacle.entity)
                && (obstacle.solid.centre - centre).norm_squared() <= wide * wide
        });
        let obstacles: Vec<Obstacle> = near.map(|(_, obstacle)| *obstacle).collect();
        let middle = Vector3::new(centre.x, centre.y, 0.0);
        HandChecker {
            scene: self,
            allowed,
            parts,
            obstacles,
            middle,
            prefilter: OnceCell::new(),
            posed: RefCell::default(),
        }
    }
}

impl HandChecker<'_, '_> {
    /// First contact at each of up to eight poses.
    pub(crate) fn contacts(&self, map_from_tips: &[Isometry3<f64>]) -> Vec<Option<Contact>> {
        let Some(near) = self.near(map_from_tips) else {
            return map_from_tips.iter().map(|tip| self.contact(tip)).collect();
        };
        let contact = |(tip, lane): (&Isometry3<f64>, usize)| {
            let sure = near.iter().find(|met| met.sure >> lane & 1 == 1);
            let mut near = near.iter().filter(|met| met.still >> lane & 1 == 1);
            sure.or_else(|| near.find(|met| self.is_touching(met, tip)))
                .and_then(|met| self.named_contact(met))
        };
        map_from_tips.iter().zip(0..).map(contact).collect()
    }

    /// Batch model of the hand and the obstacles; `None` where one is too large or has no box.
    fn prefilter(&self) -> Option<&(BatchModel, ObbSet)> {
        let place = [self.middle.x, self.middle.y];
        let make = || {
            let obbs = self.obstacles.iter().map(|obstacle| Obb::new(&obstacle.solid, place));
            let obbs = obbs.collect::<Option<ObbSet>>()?;
            Some((BatchModel::rigid(self.parts.iter().map(|own| &own.solid))?, obbs))
        };
        self.prefilter.get_or_init(make).as_ref()
    }

    /// Pairs that are near each other at some poses; `None` where the prefilter does not apply.
    fn near(&self, map_from_tips: &[Isometry3<f64>]) -> Option<Vec<NearPair>> {
        let (batch_model, obbs) = self.prefilter()?;
        let seen = |tip: &Isometry3<f64>| {
            Isometry3::from_parts(Translation3::from(tip.translation.vector - self.middle), tip.rotation)
        };
        let batch = batch_model.at(&map_from_tips.iter().map(seen).collect::<Vec<_>>())?;
        let beyond = |part: usize, obstacle: Option<usize>| {
            let own = self.parts.get(part)?;
            let Some(at) = obstacle else { return Some(0.0) };
            Some((self.padding(own, self.obstacles.get(at)?)? - MIN_CLEARANCE) as f32)
        };
        let most = Padding::new(self.scene.clearance).most() - MIN_CLEARANCE;
        let look = BatchCheck {
            batch_model,
            batch: &batch,
            obbs,
            gaps: [MIN_CLEARANCE as f32; 8],
            is_own: false,
            is_first: true,
            pairs: None,
            posed: &mut self.posed.borrow_mut(),
            most_beyond: most as f32,
            beyond,
        };
        Some(look.near_pairs())
    }

    /// Checks whether a pair is in contact at a pose.
    fn is_touching(&self, met: &NearPair, map_from_tip: &Isometry3<f64>) -> bool {
        let Some(own) = self.parts.get(met.pair.part) else { return false };
        let solid = own.solid.moved(map_from_tip);
        match met.pair.target {
            PairTarget::Obb(at) => self.obstacles.get(at).is_some_and(|obstacle| {
                let pad = self.padding(own, obstacle);
                pad.is_some_and(|pad| is_nearer(&solid, own.reach, &obstacle.solid, obstacle.reach, pad))
            }),
            PairTarget::Floor => above_floor(&solid) <= MIN_CLEARANCE,
            PairTarget::Part(..) => false,
        }
    }

    /// Distance in m that a part keeps from an obstacle; `None` where it may touch it.
    fn padding(&self, own: &HandPart, obstacle: &Obstacle) -> Option<f64> {
        let is_near = self.allowed.is_near(obstacle.entity);
        let pad = if is_near { MIN_CLEARANCE } else { obstacle.padding.arm };
        (!self.allowed.touches(obstacle.entity, own.is_held)).then_some(pad)
    }

    /// Contact of a pair.
    fn named_contact(&self, met: &NearPair) -> Option<Contact> {
        let own = self.parts.get(met.pair.part)?;
        match met.pair.target {
            PairTarget::Obb(at) => {
                Some(self.contact_of(own, self.scene.name(self.obstacles.get(at)?.entity)))
            }
            PairTarget::Floor => Some(self.contact_of(own, "floor".into())),
            PairTarget::Part(..) => None,
        }
    }

    fn contact_of(&self, own: &HandPart, other: SmolStr) -> Contact {
        let link = self.scene.model.tree().links().get(own.link).cloned().unwrap_or_default();
        Contact { link, other, is_own: false }
    }

    /// First contact at a pose.
    pub(crate) fn contact(&self, map_from_tip: &Isometry3<f64>) -> Option<Contact> {
        for own in &self.parts {
            let solid = own.solid.moved(map_from_tip);
            for obstacle in &self.obstacles {
                let Some(pad) = self.padding(own, obstacle) else { continue };
                if is_nearer(&solid, own.reach, &obstacle.solid, obstacle.reach, pad) {
                    return Some(self.contact_of(own, self.scene.name(obstacle.entity)));
                }
            }
            if above_floor(&solid) <= MIN_CLEARANCE {
                return Some(self.contact_of(own, "floor".into()));
            }
        }
        None
    }
}

//! Reasons of infeasible motions in a person's words: names in place of ids, the number that matters, and no
//! counts of samples. A dialogue tells them; the diagnostics for authors have their own.

use motet_geometry::planning::{InfeasibleReason, Misfit, MotionQuery, ReachLength};
use motet_robots::scene::Scene;
use motet_stdlib::lang::kinds;
use smol_str::SmolStr;

/// Height in m from which a thing is high up, so that its height explains that the arm finds no way to it.
const HIGH_M: f64 = 1.2;

/// Entity where a motion ends.
pub(super) fn target(query: &MotionQuery) -> Option<&SmolStr> {
    query.entities().next_back()
}

/// A reason as a clause behind `I cannot pick up the coke:`, in which `it` is the target.
pub(super) fn plain_reason(scene: &Scene, query: &MotionQuery, reason: &InfeasibleReason) -> String {
    let named = |by: &SmolStr| match scene.entities.get(by) {
        Some(entity) if entity.kind == kinds::PERSON => "a person".to_owned(),
        Some(_) => format!("the {}", scene.called(by)),
        // The robot's own parts and the rules of `keep` have no id.
        None => "my own body or a rule for where I may go".to_owned(),
    };
    match reason {
        InfeasibleReason::OutOfReach { length: ReachLength::Height, needs, reach } => {
            format!("it stands at {needs:.2} m, I reach {reach:.2} m")
        }
        InfeasibleReason::OutOfReach { length: ReachLength::Distance, needs, reach } => {
            format!("it is {needs:.2} m away, I reach {reach:.2} m")
        }
        InfeasibleReason::OutOfReach { length: ReachLength::Sight, needs, reach } => {
            format!("it is {needs:.1} m away, I see {reach:.1} m far")
        }
        InfeasibleReason::NoFreePose { by: Some(by), .. } if target(query) != Some(by) => {
            format!("{} is in the way of my arm{}", named(by), height(scene, query))
        }
        InfeasibleReason::NoFreePose { .. } => {
            format!("my arm does not get there{}", height(scene, query))
        }
        InfeasibleReason::BlockedPath { by: Some(by) } => format!("{} is in the way", named(by)),
        InfeasibleReason::BlockedPath { by: None } => "I find no way there".to_owned(),
        InfeasibleReason::NoPlace(misfit) => no_place(misfit, named),
        InfeasibleReason::NotInView { by: Some(by), .. } => format!("{} hides it", named(by)),
        InfeasibleReason::NotInView { by: None, .. } => "I cannot turn my camera there".to_owned(),
        InfeasibleReason::TooHeavy { needs, limit } => {
            format!("it weighs {needs:.1} kg, I carry {limit:.1} kg")
        }
        InfeasibleReason::Beside { needs, .. } => format!("the point is {needs:.2} m beside it"),
        InfeasibleReason::TooWide { needs, limit } => {
            let [needs, limit] = [needs, limit].map(|length| length * 100.0);
            format!("it is {needs:.1} cm wide, my hand opens to {limit:.1} cm")
        }
    }
}

/// Height of a target that is high up.
fn height(scene: &Scene, query: &MotionQuery) -> String {
    let pose = target(query).and_then(|id| scene.entities.get(id)?.pose);
    match pose.map(|pose| pose.xyz) {
        Some([_, _, z]) if z > HIGH_M => format!(", {z:.2} m above the floor"),
        Some(_) | None => String::new(),
    }
}

fn no_place(misfit: &Misfit, named: impl Fn(&SmolStr) -> String) -> String {
    match misfit {
        Misfit::Taken { by: Some(by), .. } => format!("there is no room, {} is there", named(by)),
        Misfit::Taken { by: None, .. } => "there is no room on it".to_owned(),
        Misfit::Elsewhere { beside, .. } => format!("{} is not there", named(beside)),
        Misfit::Narrow { needs, limit, .. } => {
            format!("it shall be {needs:.2} m from the rim, and there are {:.2} m", limit.max(0.0))
        }
        Misfit::Overhang { beyond, .. } => format!("it would stick out by {beyond:.2} m"),
        Misfit::Height { needs, actual, .. } => {
            format!("the place is {needs:.2} m high, and there it stands at {actual:.2} m")
        }
    }
}

//! `the left one`: which of several things is farther to a side, where that is so for the person and for the
//! robot.

use crate::english::SIDE_THE;
use motet_robots::scene::Scene;
use smol_str::SmolStr;

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Side {
    Left,
    Right,
}

/// The side that words name.
pub(super) fn side(words: &[&str]) -> Option<Side> {
    let kept: Vec<&str> = words.iter().copied().filter(|word| !SIDE_THE.has(word)).collect();
    match kept.as_slice() {
        ["left" | "leftmost"] => Some(Side::Left),
        ["right" | "rightmost"] => Some(Side::Right),
        _ => None,
    }
}

/// The option that is farthest to a side, seen from where the person and from where the robot was at the
/// start: whose left is meant nobody says. None where they see it differently, or it is not known where
/// everything is.
pub(super) fn farthest(side: Side, options: &[SmolStr], scene: &Scene) -> Option<SmolStr> {
    let place = |id: &str| scene.entities.get(id)?.pose.map(|pose| [pose.xyz[0], pose.xyz[1]]);
    let places: Option<Vec<[f64; 2]>> = options.iter().map(|id| place(id)).collect();
    let places = places.filter(|places| places.len() > 1)?;
    let [x, y, _] = scene.robot.base;
    let person = seen(side, place("user")?, &places)?;
    let robot = seen(side, [x, y], &places)?;
    if person == robot { options.get(person).cloned() } else { None }
}

/// The same from one place: which of the places it is, where no other is as far to that side.
fn seen(side: Side, from: [f64; 2], places: &[[f64; 2]]) -> Option<usize> {
    let count = places.len() as f64;
    let sum = places.iter().fold([0.0, 0.0], |sum, place| [sum[0] + place[0], sum[1] + place[1]]);
    let ahead = [sum[0] / count - from[0], sum[1] / count - from[1]];
    // How far to the left of the middle: the cross product.
    let left = |place: &[f64; 2]| ahead[0] * (place[1] - from[1]) - ahead[1] * (place[0] - from[0]);
    let sign = if side == Side::Left { 1.0 } else { -1.0 };
    let mut order: Vec<(f64, usize)> =
        places.iter().enumerate().map(|(at, place)| (sign * left(place), at)).collect();
    order.sort_by(|one, other| other.0.total_cmp(&one.0));
    match order.as_slice() {
        [(first, at), (second, _), ..] if first - second > 1e-6 => Some(*at),
        _ => None,
    }
}

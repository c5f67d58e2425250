//! Superlatives: of several things the nearest, the largest, the heaviest. Comparatives mean the same: `the
//! bigger one`.
//!
//! A measure that is unknown, or too close to tell, decides nothing: then the robot asks.

use motet_robots::scene::Scene;
use motet_stdlib::lang::entities;
use smol_str::SmolStr;

use crate::engine::noun::{ExtremeKind, Phrase, Viewpoint};
use crate::engine::vocabulary::Role;
use crate::meaning::Reader;

/// Roles of the things from which distances count.
const VIEWPOINTS: &[Role] = &[Role::Object, Role::Surface, Role::Container, Role::Place, Role::Person];
/// Least difference of two measures, as a part of the larger one.
const CLEARLY: f64 = 0.03;

const fn is_least(kind: ExtremeKind) -> bool {
    match kind {
        ExtremeKind::Nearest | ExtremeKind::Smallest | ExtremeKind::Shortest | ExtremeKind::Lightest => true,
        ExtremeKind::Farthest | ExtremeKind::Largest | ExtremeKind::Tallest | ExtremeKind::Heaviest => false,
    }
}

/// Measure of a thing in SI units, seen from a point in the plane; none where it is not known.
fn measure(
    kind: ExtremeKind,
    scene: &Scene,
    (id, support): (&SmolStr, Option<&SmolStr>),
    from: [f64; 2],
) -> Option<f64> {
    let entity = scene.entities.get(id)?;
    match kind {
        ExtremeKind::Nearest | ExtremeKind::Farthest => {
            let holder = || scene.entities.get(support?)?.pose;
            let [x, y, _] = entity.pose.or_else(holder)?.xyz;
            let [along, across] = [x - from[0], y - from[1]];
            Some((along * along + across * across).sqrt())
        }
        ExtremeKind::Largest | ExtremeKind::Smallest => entity.extents().map(|[x, y, z]| x * y * z),
        ExtremeKind::Tallest | ExtremeKind::Shortest => entity.extents().map(|[_, _, z]| z),
        ExtremeKind::Heaviest | ExtremeKind::Lightest => entity.mass_kg,
    }
}

impl Reader<'_> {
    /// Of several things the one that a superlative means; all of them where that is not known.
    pub(crate) fn extreme(&mut self, phrase: &Phrase, found: Vec<SmolStr>) -> Vec<SmolStr> {
        let Some(extreme) = phrase.extreme.clone().filter(|_| found.len() > 1) else { return found };
        let scene = self.situation.scene;
        let [x, y, _] = scene.robot.base;
        let place = |id: &str| scene.entities.get(id)?.pose.map(|pose| [pose.xyz[0], pose.xyz[1]]);
        let points = match &extreme.from {
            Viewpoint::Open => std::iter::once([x, y]).chain(place(entities::USER)).collect(),
            Viewpoint::Robot => vec![[x, y]],
            Viewpoint::Thing(noun) => match self.one(noun, VIEWPOINTS).ok().and_then(|id| place(&id)) {
                Some(point) => vec![point],
                None => return found,
            },
        };
        let mut chosen = points.iter().map(|point| self.farthest_out(extreme.kind, &found, *point));
        let first = chosen.next().flatten();
        let is_agreed = chosen.all(|other| other == first);
        match first.filter(|_| is_agreed) {
            Some(only) => vec![only],
            None => found,
        }
    }

    /// The thing at the end of a measure; none where a measure is not known, or two are about the same.
    fn farthest_out(&self, kind: ExtremeKind, found: &[SmolStr], from: [f64; 2]) -> Option<SmolStr> {
        let measured = found.iter().map(|id| {
            let support = self.vocabulary.thing(id).and_then(|thing| thing.support.as_ref());
            Some((measure(kind, self.situation.scene, (id, support), from)?, id))
        });
        let mut measured: Vec<(f64, &SmolStr)> = measured.collect::<Option<_>>()?;
        measured.sort_by(|(one, _), (other, _)| one.total_cmp(other));
        if !is_least(kind) {
            measured.reverse();
        }
        let [(best, id), (next, _), ..] = measured.as_slice() else { return None };
        ((best - next).abs() > CLEARLY * best.max(*next)).then(|| (*id).clone())
    }
}

#[cfg(test)]
mod tests {
    use motet_robots::builtin;

    use crate::engine::noun::noun;
    use crate::engine::token::tokens;
    use crate::meaning::{OBJECTS, Reader};
    use crate::{RequestContext, RequestError, choose};

    /// The thing of the kitchen that words mean; none where they leave it open.
    fn meant(said: &str) -> Option<String> {
        let scene = builtin::scene("kitchen").unwrap();
        let context = RequestContext::new(&scene);
        let words = tokens(said);
        let (noun, end) = noun(&words, 0).unwrap();
        assert_eq!(end, words.len(), "{said}");
        match Reader::new(&context).things(&noun, OBJECTS, None) {
            Ok(found) => Some(found.iter().map(ToString::to_string).collect::<Vec<_>>().join(" ")),
            Err(RequestError::AmbiguousReference { .. }) => None,
            Err(other) => panic!("{said}: {other}"),
        }
    }

    fn chosen(answer: &str, options: &[&str]) -> String {
        let scene = builtin::scene("kitchen").unwrap();
        let options: Vec<_> = options.iter().map(|id| (*id).into()).collect();
        let chosen = choose(answer, &options, &RequestContext::new(&scene));
        chosen.iter().map(ToString::to_string).collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn superlative_of_distance_counts_from_where_somebody_says() {
        for (said, thing) in [
            ("the mug nearest to me", Some("mug_2")),
            ("the mug closest to you", Some("mug_1")),
            ("the mug that is closest to the sink", Some("mug_1")),
            ("the closest mug to the sink", Some("mug_1")),
            ("the farthest mug from the sink", Some("mug_2")),
            ("the mug farthest from the sink", Some("mug_2")),
            // The red one is nearer to the robot, the blue one to the person.
            ("the nearest mug", None),
            // Both are of one size.
            ("the bigger mug", None),
        ] {
            assert_eq!(meant(said).as_deref(), thing, "{said}");
        }
    }

    #[test]
    fn superlative_chooses_among_options() {
        for (answer, options, thing) in [
            ("the bigger one", ["coke", "bottle"], "bottle"),
            ("The lighter one, please.", ["coke", "bottle"], "coke"),
            ("the tallest", ["coke", "bottle"], "bottle"),
            ("the closest", ["apple", "plate"], "apple"),
            ("the one nearest to the sink", ["mug_1", "mug_2"], "mug_1"),
            ("the heavier one", ["mug_1", "mug_2"], ""),
        ] {
            assert_eq!(chosen(answer, &options), thing, "{answer}");
        }
    }
}

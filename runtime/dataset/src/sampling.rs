//! Stratified sampling of the kinds of conversations: they are drawn without replacement, so that each has
//! its share of the rows, however few conversations there are.
//!
//! The sequence goes on over all scenes of a dataset, and its order depends on the seed alone. So each scene
//! knows its place in it, whoever makes the others.

use motet_planner::dialogue::Kind;

use crate::coverage::Construct;
use crate::lesson::Lesson;
use crate::random::{self, Draw as _};

/// Kind of a conversation to draw.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum CaseKind {
    /// A request that somebody changes while it is carried out.
    Changed,
    /// A request, and the failures on its way; none of a request that succeeds at once.
    Request(&'static [Kind]),
    /// A lesson with a construct.
    Lesson(Construct),
}

/// Number of the requests in a round, by the failures on their way. A failed step has more rows than others.
const REQUESTS: &[(usize, CaseKind)] = &[
    (2, CaseKind::Request(&[])),
    (4, CaseKind::Changed),
    (5, CaseKind::Request(&[Kind::NotFound])),
    (8, CaseKind::Request(&[Kind::NotReachable])),
    (4, CaseKind::Request(&[Kind::AmbiguousReference])),
    (3, CaseKind::Request(&[Kind::AmbiguousTask])),
    (2, CaseKind::Request(&[Kind::ActionFailed])),
    (1, CaseKind::Request(&[Kind::AmbiguousReference, Kind::NotFound])),
    (1, CaseKind::Request(&[Kind::NotFound, Kind::ActionFailed])),
    (1, CaseKind::Request(&[Kind::AmbiguousTask, Kind::NotReachable])),
];

/// Number of the lessons in a round, by a construct that they have. The others come with these, or with the
/// policies of the built-in planner.
const LESSONS: &[(usize, CaseKind)] = &[
    (1, CaseKind::Lesson(Construct::Condition)),
    (2, CaseKind::Lesson(Construct::Loop)),
    (2, CaseKind::Lesson(Construct::Handler)),
    (2, CaseKind::Lesson(Construct::Cleanup)),
    (2, CaseKind::Lesson(Construct::Deadline)),
    (1, CaseKind::Lesson(Construct::Wait)),
    (3, CaseKind::Lesson(Construct::Parallel)),
    (3, CaseKind::Lesson(Construct::Keep)),
    (3, CaseKind::Lesson(Construct::Ground)),
    (3, CaseKind::Lesson(Construct::Cannot)),
    (1, CaseKind::Lesson(Construct::Ask)),
];

/// Salt of the generators that shuffle, so that scenes draw other numbers.
const SALT: u64 = 0x5bd1_e995_9d1c_44f3;

/// Kinds in the order of a seed, without an end: each round has each kind as often as the tables say.
#[derive(Clone, Debug)]
pub(crate) struct StratifiedSampler {
    seed: u64,
    kinds: Vec<CaseKind>,
    /// Number and order of the round that was drawn from last.
    shuffled: Option<(u64, Vec<CaseKind>)>,
}

impl StratifiedSampler {
    /// Sampler of requests, and of those lessons that there are.
    pub(crate) fn new(seed: u64, lessons: &[Lesson]) -> Self {
        let is_taught = |kind: &CaseKind| match kind {
            CaseKind::Lesson(construct) => lessons.iter().any(|lesson| lesson.constructs.contains(construct)),
            CaseKind::Changed | CaseKind::Request(_) => true,
        };
        let all = REQUESTS.iter().chain(LESSONS).filter(|(_, kind)| is_taught(kind));
        let kinds = all.flat_map(|(count, kind)| std::iter::repeat_n(*kind, *count)).collect();
        Self { seed, kinds, shuffled: None }
    }

    /// Kind at a place, from 0.
    pub(crate) fn at(&mut self, place: usize) -> CaseKind {
        let count = self.kinds.len().max(1);
        let number = u64::try_from(place / count).unwrap_or(u64::MAX);
        let (_, kinds) = match self.shuffled.take() {
            Some(known) if known.0 == number => self.shuffled.insert(known),
            Some(_) | None => {
                let mut kinds = self.kinds.clone();
                random::part(self.seed ^ SALT, number).shuffle(&mut kinds);
                self.shuffled.insert((number, kinds))
            }
        };
        kinds.get(place % count).copied().unwrap_or(CaseKind::Request(&[]))
    }
}

#[cfg(test)]
mod tests {
    use super::{CaseKind, LESSONS, REQUESTS, StratifiedSampler};
    use crate::coverage::Construct;
    use crate::lesson::{OWN, read};

    #[test]
    fn sampler_draws_each_kind_as_often_as_it_says_and_in_another_order_each_time() {
        let lessons = read(OWN).unwrap();
        let mut sampler = StratifiedSampler::new(7, &lessons);
        let count: usize = REQUESTS.iter().chain(LESSONS).map(|(count, _)| count).sum();
        let drawn = |sampler: &mut StratifiedSampler, from: usize| -> Vec<CaseKind> {
            (from..from + count).map(|place| sampler.at(place)).collect()
        };
        let (first, second) = (drawn(&mut sampler, 0), drawn(&mut sampler, count));
        for (count, kind) in REQUESTS.iter().chain(LESSONS) {
            for drawn in [&first, &second] {
                assert_eq!(drawn.iter().filter(|one| *one == kind).count(), *count, "{kind:?}");
            }
        }
        assert_ne!(first, second);
        assert_eq!(first, drawn(&mut StratifiedSampler::new(7, &lessons), 0), "of the seed alone");
        assert_ne!(first, drawn(&mut StratifiedSampler::new(8, &lessons), 0));
    }

    #[test]
    fn sampler_without_lessons_has_requests_alone() {
        let mut sampler = StratifiedSampler::new(7, &[]);
        assert!((0..200).all(|place| !matches!(sampler.at(place), CaseKind::Lesson(_))));
        let two = "lesson: a\nsay: A.\ndo:\nkeep distance(user) >= 1 m { home() }\n";
        let mut sampler = StratifiedSampler::new(7, &read(two).unwrap());
        assert!((0..200).any(|place| sampler.at(place) == CaseKind::Lesson(Construct::Keep)));
        assert!((0..200).all(|place| sampler.at(place) != CaseKind::Lesson(Construct::Loop)));
    }
}

//! Deck of the kinds of conversations: they are drawn without replacement, so that each has its share of the
//! rows, however few conversations there are.
//!
//! The deck goes on over all scenes of a dataset, and its order depends on the seed alone. So each scene
//! knows its place in it, whoever makes the others.

use motet_planner::dialogue::Kind;

use crate::lesson::Lesson;
use crate::random::{self, Draw as _};
use crate::share::Construct;

/// Kind of a conversation to draw.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum DeckWish {
    /// A request that somebody changes while it is carried out.
    Changed,
    /// A request, and the failures on its way; none of a request that succeeds at once.
    Request(&'static [Kind]),
    /// A lesson with a construct.
    Lesson(Construct),
}

/// Number of the requests in a deck, by the failures on their way. A failed step has more rows than others.
const REQUESTS: &[(usize, DeckWish)] = &[
    (2, DeckWish::Request(&[])),
    (4, DeckWish::Changed),
    (5, DeckWish::Request(&[Kind::NotFound])),
    (8, DeckWish::Request(&[Kind::NotReachable])),
    (4, DeckWish::Request(&[Kind::AmbiguousReference])),
    (3, DeckWish::Request(&[Kind::AmbiguousTask])),
    (2, DeckWish::Request(&[Kind::ActionFailed])),
    (1, DeckWish::Request(&[Kind::AmbiguousReference, Kind::NotFound])),
    (1, DeckWish::Request(&[Kind::NotFound, Kind::ActionFailed])),
    (1, DeckWish::Request(&[Kind::AmbiguousTask, Kind::NotReachable])),
];

/// Number of the lessons in a deck, by a construct that they have. The others come with these, or with the
/// policies of the built-in planner.
const LESSONS: &[(usize, DeckWish)] = &[
    (1, DeckWish::Lesson(Construct::Condition)),
    (2, DeckWish::Lesson(Construct::Loop)),
    (2, DeckWish::Lesson(Construct::Handler)),
    (2, DeckWish::Lesson(Construct::Cleanup)),
    (2, DeckWish::Lesson(Construct::Deadline)),
    (1, DeckWish::Lesson(Construct::Wait)),
    (3, DeckWish::Lesson(Construct::Parallel)),
    (3, DeckWish::Lesson(Construct::Keep)),
    (3, DeckWish::Lesson(Construct::Ground)),
    (3, DeckWish::Lesson(Construct::Cannot)),
    (1, DeckWish::Lesson(Construct::Ask)),
];

/// Salt of the generators that shuffle, so that scenes draw other numbers.
const SALT: u64 = 0x5bd1_e995_9d1c_44f3;

/// Wishes in the order of a seed, without an end.
#[derive(Clone, Debug)]
pub(crate) struct Deck {
    seed: u64,
    wishes: Vec<DeckWish>,
    /// Number and order of the deck that was drawn from last.
    shuffled: Option<(u64, Vec<DeckWish>)>,
}

impl Deck {
    /// A deck of requests, and of those lessons that there are.
    pub(crate) fn new(seed: u64, lessons: &[Lesson]) -> Self {
        let is_taught = |wish: &DeckWish| match wish {
            DeckWish::Lesson(construct) => lessons.iter().any(|lesson| lesson.constructs.contains(construct)),
            DeckWish::Changed | DeckWish::Request(_) => true,
        };
        let all = REQUESTS.iter().chain(LESSONS).filter(|(_, wish)| is_taught(wish));
        let wishes = all.flat_map(|(count, wish)| std::iter::repeat_n(*wish, *count)).collect();
        Self { seed, wishes, shuffled: None }
    }

    /// The wish at a place, from 0.
    pub(crate) fn at(&mut self, place: usize) -> DeckWish {
        let count = self.wishes.len().max(1);
        let number = u64::try_from(place / count).unwrap_or(u64::MAX);
        let (_, wishes) = match self.shuffled.take() {
            Some(known) if known.0 == number => self.shuffled.insert(known),
            Some(_) | None => {
                let mut wishes = self.wishes.clone();
                random::part(self.seed ^ SALT, number).shuffle(&mut wishes);
                self.shuffled.insert((number, wishes))
            }
        };
        wishes.get(place % count).copied().unwrap_or(DeckWish::Request(&[]))
    }
}

#[cfg(test)]
mod tests {
    use super::{Deck, DeckWish, LESSONS, REQUESTS};
    use crate::lesson::{OWN, read};
    use crate::share::Construct;

    #[test]
    fn deck_has_each_wish_as_often_as_it_says_and_in_another_order_each_time() {
        let lessons = read(OWN).unwrap();
        let mut deck = Deck::new(7, &lessons);
        let count: usize = REQUESTS.iter().chain(LESSONS).map(|(count, _)| count).sum();
        let drawn = |deck: &mut Deck, from: usize| -> Vec<DeckWish> {
            (from..from + count).map(|place| deck.at(place)).collect()
        };
        let (first, second) = (drawn(&mut deck, 0), drawn(&mut deck, count));
        for (count, wish) in REQUESTS.iter().chain(LESSONS) {
            for drawn in [&first, &second] {
                assert_eq!(drawn.iter().filter(|one| *one == wish).count(), *count, "{wish:?}");
            }
        }
        assert_ne!(first, second);
        assert_eq!(first, drawn(&mut Deck::new(7, &lessons), 0), "of the seed alone");
        assert_ne!(first, drawn(&mut Deck::new(8, &lessons), 0));
    }

    #[test]
    fn deck_without_lessons_has_requests_alone() {
        let mut deck = Deck::new(7, &[]);
        assert!((0..200).all(|place| !matches!(deck.at(place), DeckWish::Lesson(_))));
        let two = "lesson: a\nsay: A.\ndo:\nkeep distance(user) >= 1 m { home() }\n";
        let mut deck = Deck::new(7, &read(two).unwrap());
        assert!((0..200).any(|place| deck.at(place) == DeckWish::Lesson(Construct::Keep)));
        assert!((0..200).all(|place| deck.at(place) != DeckWish::Lesson(Construct::Loop)));
    }
}

//! Many at once: work on several threads whose results come in the order of the items, and shards of a set of
//! items for several machines.

use std::any::Any;
use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::str::FromStr;
use std::sync::mpsc::{self, Receiver};
use std::sync::{Mutex, PoisonError};
use std::thread;

/// Number of packets for each thread that are given out before the first of them is done: so much is kept in
/// memory, and a slow item holds the others up only behind so many.
const AHEAD: usize = 4;

/// Packet of items with its number, or of results.
type Packet<T> = (usize, Vec<T>);

/// Works on items with `jobs` threads and passes each result to `each`, in the order of the items, on the
/// calling thread. Items are read as they are needed, `packet` of them at a time for one thread: many for
/// short work, 1 for long work. The results are the same for any number of threads if `work` is a function
/// of the item.
///
/// ```
/// use std::ops::ControlFlow;
///
/// let mut squares = Vec::new();
/// let all = motet::batch::in_order(2, 1, 1..=4, |item| item * item, |square| {
///     squares.push(square);
///     if square == 9 { ControlFlow::Break("enough") } else { ControlFlow::Continue(()) }
/// });
/// assert_eq!((squares, all), (vec![1, 4, 9], ControlFlow::Break("enough")));
/// ```
///
/// # Panics
///
/// A panic of `work` goes on in the caller.
pub fn in_order<I: Send, T: Send, B>(
    jobs: usize,
    packet: usize,
    items: impl IntoIterator<Item = I>,
    work: impl Fn(I) -> T + Sync,
    mut each: impl FnMut(T) -> ControlFlow<B>,
) -> ControlFlow<B> {
    let mut items = items.into_iter();
    if jobs <= 1 {
        return items.map(work).try_for_each(each);
    }
    let (give, take) = mpsc::sync_channel::<Packet<I>>(jobs * AHEAD);
    let take = Mutex::new(take);
    let (done, results) = mpsc::channel::<Result<Packet<T>, Box<dyn Any + Send>>>();
    thread::scope(|scope| {
        // Ends the threads when it is dropped, however this ends.
        let give = give;
        for _ in 0..jobs {
            let (take, work, done) = (&take, &work, done.clone());
            scope.spawn(move || {
                while let Some((number, items)) = next(take) {
                    let worked =
                        catch_unwind(AssertUnwindSafe(|| items.into_iter().map(work).collect::<Vec<_>>()));
                    if done.send(worked.map(|results| (number, results))).is_err() {
                        return;
                    }
                }
            });
        }
        drop(done);
        let (mut given, mut passed) = (0, 0);
        let mut early = BTreeMap::new();
        loop {
            while given - passed < jobs * AHEAD {
                let packet: Vec<I> = items.by_ref().take(packet.max(1)).collect();
                if packet.is_empty() || give.send((given, packet)).is_err() {
                    break;
                }
                given += 1;
            }
            if given == passed {
                return ControlFlow::Continue(());
            }
            match results.recv() {
                Ok(Ok((number, results))) => drop(early.insert(number, results)),
                Ok(Err(panic)) => resume_unwind(panic),
                Err(_) => return ControlFlow::Continue(()),
            }
            while let Some(results) = early.remove(&passed) {
                passed += 1;
                results.into_iter().try_for_each(&mut each)?;
            }
        }
    })
}

/// Next packet for a thread; `None` once there are no more.
fn next<I>(take: &Mutex<Receiver<Packet<I>>>) -> Option<Packet<I>> {
    take.lock().unwrap_or_else(PoisonError::into_inner).recv().ok()
}

/// Share of a set of items: each n-th of them. The n shards have every item exactly once.
///
/// ```
/// use motet::batch::Shard;
///
/// let shard: Shard = "1/3".parse()?;
/// assert_eq!((0..8).filter(|index| shard.has(*index)).collect::<Vec<_>>(), [1, 4, 7]);
/// assert!("3/3".parse::<Shard>().is_err());
/// # Ok::<(), String>(())
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Shard {
    number: usize,
    of: usize,
}

impl Default for Shard {
    /// The only one.
    fn default() -> Self {
        Self { number: 0, of: 1 }
    }
}

impl Shard {
    /// True if the item of this index, from 0, belongs to the shard.
    #[must_use]
    pub const fn has(self, index: usize) -> bool {
        index % self.of == self.number
    }

    /// True if the shard has all items.
    #[must_use]
    pub const fn is_whole(self) -> bool {
        self.of == 1
    }
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = || "write a number and how many there are, from 0/4 to 3/4 for four shards".to_owned();
        let (number, of) = text.split_once('/').ok_or_else(wrong)?;
        let (number, of) = (number.trim().parse(), of.trim().parse());
        let (Ok(number), Ok(of)) = (number, of) else { return Err(wrong()) };
        if number < of { Ok(Self { number, of }) } else { Err(wrong()) }
    }
}

#[cfg(test)]
mod tests {
    use std::ops::ControlFlow;

    use super::{Shard, in_order};

    /// Results of doubling so many items.
    fn doubled(jobs: usize, packet: usize, items: usize) -> Vec<usize> {
        let mut all = Vec::new();
        let work = |item: usize| {
            // Later items are done earlier.
            for _ in item..items {
                std::thread::yield_now();
            }
            2 * item
        };
        let end = in_order(jobs, packet, 0..items, work, |result| {
            all.push(result);
            ControlFlow::<()>::Continue(())
        });
        assert_eq!(end, ControlFlow::Continue(()));
        all
    }

    #[test]
    fn in_order_gives_the_same_for_any_number_of_threads() {
        let expected: Vec<usize> = (0..97).map(|item| 2 * item).collect();
        for (jobs, packet) in [(1, 1), (2, 1), (3, 8), (8, 64), (200, 0)] {
            assert_eq!(doubled(jobs, packet, 97), expected, "{jobs} {packet}");
        }
        assert_eq!(doubled(4, 4, 0), [0; 0]);
    }

    #[test]
    fn in_order_stops_and_reads_no_more_than_it_needs() {
        let mut read = 0;
        let items = (0..1_000_000).inspect(|_| read += 1);
        let end = in_order(
            2,
            2,
            items,
            |item| item,
            |item| {
                if item == 5 { ControlFlow::Break(item) } else { ControlFlow::Continue(()) }
            },
        );
        assert_eq!(end, ControlFlow::Break(5));
        assert!(read < 100, "{read}");
    }

    #[test]
    #[should_panic(expected = "an odd item")]
    fn in_order_passes_a_panic_on() {
        let work = |item: usize| assert!(item != 3, "an odd item");
        let _ = in_order(2, 1, 0..100, work, |()| ControlFlow::<()>::Continue(()));
    }

    #[test]
    fn shard_reads_a_number_below_the_count() {
        assert_eq!("0/1".parse(), Ok(Shard::default()));
        for wrong in ["", "1", "1/1", "-1/2", "2/1", "0/0", "a/b", "1/2/3"] {
            assert!(wrong.parse::<Shard>().is_err(), "{wrong}");
        }
        let shards: Vec<Shard> = ["0/3", "1/3", "2/3"].iter().map(|text| text.parse().unwrap()).collect();
        assert!((0..20).all(|index| shards.iter().filter(|shard| shard.has(index)).count() == 1));
    }
}

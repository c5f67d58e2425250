//! Time at which the engine wants to be woken: at most one instant a key, in a heap that knows where each key
//! is.

use crate::time::Time;

/// Not in the heap.
const NOWHERE: u32 = u32::MAX;

/// Instants by key. Setting, clearing and taking the next cost the logarithm of how many are set.
#[derive(Clone, Debug)]
pub(crate) struct Timers {
    heap: Vec<(Time, u32)>,
    places: Vec<u32>,
}

impl Timers {
    /// None set; keys are below `keys`.
    pub(crate) fn new(keys: usize) -> Self {
        Self { heap: Vec::new(), places: vec![NOWHERE; keys] }
    }

    /// The earliest instant; of equal ones that of the smallest key.
    #[inline]
    pub(crate) fn next(&self) -> Option<(Time, u32)> {
        self.heap.first().copied()
    }

    /// A key's instant.
    #[inline]
    pub(crate) fn get(&self, key: u32) -> Option<Time> {
        let place = self.places.get(key as usize)?;
        self.heap.get(*place as usize).map(|(at, _)| *at)
    }

    /// Sets a key's instant, in place of an earlier one.
    #[inline]
    pub(crate) fn set(&mut self, key: u32, at: Time) {
        let Some(own) = self.places.get_mut(key as usize) else { return };
        let place = *own as usize;
        if *own == NOWHERE {
            let last = self.heap.len();
            *own = last as u32;
            self.heap.push((at, key));
            if last > 0 {
                self.rise(last);
            }
        } else if let Some(entry) = self.heap.get_mut(place) {
            entry.0 = at;
            self.rise(place);
            self.sink(self.places.get(key as usize).map_or(0, |place| *place as usize));
        }
    }

    /// Forgets a key's instant.
    #[inline]
    pub(crate) fn clear(&mut self, key: u32) {
        let Some(place) = self.places.get_mut(key as usize) else { return };
        let hole = std::mem::replace(place, NOWHERE);
        if hole == NOWHERE {
            return;
        }
        let hole = hole as usize;
        if hole + 1 == self.heap.len() {
            self.heap.pop();
            return;
        }
        self.heap.swap_remove(hole);
        self.note(hole);
        self.rise(hole);
        self.sink(hole);
    }

    fn note(&mut self, index: usize) {
        if let Some((_, key)) = self.heap.get(index)
            && let Some(place) = self.places.get_mut(*key as usize)
        {
            *place = index as u32;
        }
    }

    fn swap(&mut self, a: usize, b: usize) {
        self.heap.swap(a, b);
        self.note(a);
        self.note(b);
    }

    #[inline(never)]
    fn rise(&mut self, mut index: usize) {
        while index > 0 {
            let parent = (index - 1) / 2;
            if self.heap.get(parent) <= self.heap.get(index) {
                return;
            }
            self.swap(parent, index);
            index = parent;
        }
    }

    fn sink(&mut self, mut index: usize) {
        loop {
            let (left, right) = (2 * index + 1, 2 * index + 2);
            let mut least = index;
            for child in [left, right] {
                if child < self.heap.len() && self.heap.get(child) < self.heap.get(least) {
                    least = child;
                }
            }
            if least == index {
                return;
            }
            self.swap(least, index);
            index = least;
        }
    }
}

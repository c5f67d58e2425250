//! A table that is total: a wrong index reads and writes a spare row instead of ending the program.
//!
//! A validated graph never has a wrong index; this keeps the promise of no panic without a branch in every
//! caller.

/// Rows by index.
#[derive(Clone, Debug)]
pub(crate) struct Table<T> {
    rows: Vec<T>,
    spare: T,
}

impl<T: Clone> Table<T> {
    /// So many equal rows.
    pub(crate) fn new(len: usize, row: T) -> Self {
        Self { rows: vec![row.clone(); len], spare: row }
    }
}

impl<T> Table<T> {
    #[inline]
    pub(crate) fn at(&self, index: usize) -> &T {
        self.rows.get(index).unwrap_or(&self.spare)
    }

    #[inline]
    pub(crate) fn at_mut(&mut self, index: usize) -> &mut T {
        self.rows.get_mut(index).unwrap_or(&mut self.spare)
    }
}

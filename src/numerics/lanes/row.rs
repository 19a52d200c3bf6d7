//! Numbers in memory whose start suits the widest registers.
//!
//! What is written across the border of two cache lines and read soon after is read late; a row that starts on such a
//! border has every register's worth of numbers within one line.

use std::ops::{Deref, DerefMut};

/// Bytes in a cache line, and in the widest register.
const LINE: usize = 64;

/// Numbers that start on the border of a cache line. Their count does not change.
#[derive(Debug)]
pub struct Row {
    /// From `start` to the end.
    numbers: Vec<f64>,
    start: usize,
}

impl Row {
    /// So many zeros.
    pub fn zeros(len: usize) -> Self {
        let mut numbers = vec![0.0; len + LINE / size_of::<f64>()];
        let start = numbers.as_ptr().align_offset(LINE).min(LINE / size_of::<f64>());
        numbers.truncate(start + len);
        Self { numbers, start }
    }

    /// Those of an iterator.
    pub fn from_fn(len: usize, of: impl FnMut(usize) -> f64) -> Self {
        let mut row = Self::zeros(len);
        for (number, value) in row.iter_mut().zip((0..len).map(of)) {
            *number = value;
        }
        row
    }
}

impl Default for Row {
    fn default() -> Self {
        Self::zeros(0)
    }
}

impl Clone for Row {
    fn clone(&self) -> Self {
        Self::from_fn(self.len(), |i| self[i])
    }
}

impl PartialEq for Row {
    fn eq(&self, other: &Self) -> bool {
        self[..] == other[..]
    }
}

impl Deref for Row {
    type Target = [f64];

    #[inline(always)]
    fn deref(&self) -> &[f64] {
        &self.numbers[self.start..]
    }
}

impl DerefMut for Row {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut [f64] {
        &mut self.numbers[self.start..]
    }
}

#[test]
fn a_row_and_its_copy_start_on_a_border() {
    for len in [0, 1, 8, 40] {
        let row = Row::from_fn(len, |i| i as f64);
        let copy = row.clone();
        for row in [&row, &copy] {
            assert_eq!((row.as_ptr() as usize % LINE, row.len()), (0, len));
        }
        assert_eq!(row, copy);
    }
}

//! How vectors of states are parted among registers.

use super::{Each, Lists, QUAD, Wide, after, padded};

/// How a vector of states is made up: two lists of equal length, which are treated with all lanes there are, and a
/// rest, which is treated by four. Whoever writes and whoever reads a vector soon after must part it in the same way: a
/// register that was written in parts is read late.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Partition {
    /// Numbers in each list.
    pub count: usize,
    /// Numbers in the rest, a multiple of [`QUAD`].
    pub rest: usize,
}

impl Partition {
    /// Start of the second list.
    pub fn second(self) -> usize {
        padded(self.count)
    }

    /// Start of the rest.
    pub fn third(self) -> usize {
        2 * padded(self.count)
    }

    /// Length of the whole.
    pub fn len(self) -> usize {
        self.third() + self.rest
    }

    /// Whether there is nothing.
    pub fn is_empty(self) -> bool {
        self.len() == 0
    }

    /// Treats all slots.
    #[inline(always)]
    pub fn for_each<S: Wide, E: Each<I, 1>, const I: usize>(
        self,
        simd: S,
        from: [&[f64]; I],
        to: &mut [f64],
        each: &E,
        sum: &mut E::Sum,
    ) {
        if S::F64_LANES == QUAD {
            return Lists { from, to: [to] }.for_each(simd, self.len(), each, sum);
        }
        let (lists, rest) = to.split_at_mut(self.third());
        Lists { from, to: [lists] }.for_each(simd, self.third(), each, sum);
        Lists { from: after(from, self.third()), to: [rest] }.for_each(simd.quad(), self.rest, each, sum);
    }

    /// Treats all slots of lists that are only read.
    #[inline(always)]
    pub fn read<S: Wide, E: Each<I, 0>, const I: usize>(self, simd: S, from: [&[f64]; I], each: &E, sum: &mut E::Sum) {
        Lists { from, to: [] }.for_each(simd, self.third(), each, sum);
        Lists { from: after(from, self.third()), to: [] }.for_each(simd.quad(), self.rest, each, sum);
    }
}

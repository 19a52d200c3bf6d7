//! Chance that a seed repeats: splitmix64 (Steele, Lea and Flood, OOPSLA 2014). Or what a fuzzer wants: its bytes come
//! first.

pub(crate) struct Chance {
    seed: u64,
    bytes: std::vec::IntoIter<u8>,
}

impl Chance {
    pub(crate) fn new(seed: u64) -> Self {
        Self::of_bytes(seed, &[])
    }

    /// Takes these bytes before it goes on by itself.
    pub(crate) fn of_bytes(seed: u64, bytes: &[u8]) -> Self {
        Self { seed, bytes: Vec::from(bytes).into_iter() }
    }

    pub(crate) fn has_bytes(&self) -> bool {
        self.bytes.len() > 0
    }

    pub(crate) fn number(&mut self) -> u64 {
        if self.has_bytes() {
            return self.bytes.by_ref().take(8).fold(0, |number, byte| number << 8 | u64::from(byte));
        }
        self.seed = self.seed.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.seed;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A whole number from 0 to `end` − 1.
    pub(crate) fn below(&mut self, end: usize) -> usize {
        // A byte for a choice: a fuzzer changes one of them at a time.
        if end <= 256
            && let Some(byte) = self.bytes.next()
        {
            return usize::from(byte) % end;
        }
        (self.number() % end as u64) as usize
    }

    pub(crate) fn one_in(&mut self, count: usize) -> bool {
        self.below(count) == 0
    }

    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.number() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Between two positive numbers, equally often in each decade.
    pub(crate) fn decades(&mut self, low: f64, high: f64) -> f64 {
        self.between(low.ln(), high.ln()).exp()
    }

    pub(crate) fn pick<'a, T>(&mut self, list: &'a [T]) -> &'a T {
        &list[self.below(list.len())]
    }
}

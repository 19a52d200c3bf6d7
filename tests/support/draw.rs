//! Numbers drawn by chance that are always the same.

/// Drawn by Marsaglia's xorshift.
pub struct Draw(u64);

impl Draw {
    pub fn new(seed: u64) -> Self {
        let mut draw = Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1);
        for _ in 0..10 {
            draw.part();
        }
        draw
    }

    /// From 0 to below 1.
    pub fn part(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn chance(&mut self, of: f64) -> bool {
        self.part() < of
    }

    pub fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.part()
    }

    /// Any order of magnitude between two numbers as likely as any other.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low * (high / low).powf(self.part())
    }

    pub fn or_zero(&mut self, low: f64, high: f64) -> f64 {
        if self.chance(0.5) { 0.0 } else { self.between(low, high) }
    }
}

//! Random numbers from a seed, and which seeds a test runs through.

use std::cell::Cell;
use std::f64::consts::TAU;

/// Numbers that follow from a seed alone: SplitMix64 (Steele, Lea and Flood 2014).
pub struct Draw(u64);

impl Draw {
    pub fn new(seed: u64) -> Self {
        let mut draw = Self(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ 0xD1B5_4A32_D192_ED03);
        draw.bits();
        draw
    }

    /// Other numbers from the same seed, whatever is drawn here before or after.
    pub fn independent(&self) -> Self {
        Self::new(self.0 ^ 0x5851_F42D_4C95_7F2D)
    }

    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// From 0 up to 1.
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Evenly over the orders of magnitude between two positive numbers.
    pub fn log(&mut self, low: f64, high: f64) -> f64 {
        low * (high / low).powf(self.unit())
    }

    pub fn below(&mut self, count: usize) -> usize {
        (self.bits() % count as u64) as usize
    }

    pub fn chance(&mut self, share: f64) -> bool {
        self.unit() < share
    }

    pub fn sign(&mut self) -> f64 {
        if self.chance(0.5) { 1.0 } else { -1.0 }
    }

    pub fn pick<T: Clone>(&mut self, from: &[T]) -> T {
        from[self.below(from.len())].clone()
    }

    /// A vector of this length in any direction.
    pub fn vector(&mut self, length: f64) -> [f64; 2] {
        let (sin, cos) = self.between(0.0, TAU).sin_cos();
        [length * cos, length * sin]
    }
}

/// The seeds that a test runs through: `short` of them, or what the environment asks for.
pub fn seeds(short: u64) -> std::ops::Range<u64> {
    let number = |name: &str| -> Option<u64> {
        let text = std::env::var(name).ok()?;
        Some(text.parse().unwrap_or_else(|_| panic!("{name} = {text}: a whole number is wanted")))
    };
    let (first, count) = (number("BRINELL_SEED"), number("BRINELL_SCENES"));
    let start = first.unwrap_or(0);
    start..start + count.unwrap_or(if first.is_some() { 1 } else { short })
}

/// As [`for_seeds`], of a check that says whether it has compared anything: of several seeds two must have.
pub fn for_compared(short: u64, check: impl Fn(u64, &mut Draw) -> Result<bool, String>) {
    let (tried, compared) = (Cell::new(0), Cell::new(0));
    for_seeds(short, |seed, draw| {
        tried.set(tried.get() + 1);
        compared.set(compared.get() + u32::from(check(seed, draw)?));
        Ok(())
    });
    let (tried, compared) = (tried.get(), compared.get());
    assert!(compared >= 2 || tried < 6, "of {tried} seeds {compared} were compared");
}

/// Runs a check on all seeds and fails with those that failed, each with its reason.
pub fn for_seeds(short: u64, check: impl Fn(u64, &mut Draw) -> Result<(), String>) {
    let failed: Vec<String> = seeds(short)
        .filter_map(|seed| check(seed, &mut Draw::new(seed)).err().map(|why| format!("BRINELL_SEED={seed}: {why}")))
        .collect();
    assert!(failed.is_empty(), "{} failed:\n{}", failed.len(), failed.join("\n"));
}

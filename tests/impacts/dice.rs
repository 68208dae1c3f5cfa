//! Random numbers.

use volary::math::Vector;

/// A stream of random numbers: splitmix64.
pub struct Dice(pub u64);

impl Dice {
    pub fn share(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.share()
    }

    /// Between two numbers above 0, with even chances for each magnitude.
    pub fn magnitude(&mut self, low: f64, high: f64) -> f64 {
        low * (high / low).powf(self.share())
    }

    pub fn direction<const D: usize>(&mut self) -> Vector<D> {
        loop {
            let at = Vector::<D>::from_fn(|_, _| self.between(-1.0, 1.0));
            if (0.1..1.0).contains(&at.norm()) {
                return at.normalize();
            }
        }
    }
}

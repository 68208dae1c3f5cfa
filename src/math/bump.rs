//! The bump function ρ.

use std::f64::consts::{FRAC_PI_4, PI};

use crate::math::turn::quarter;

/// The bump function ρ of Olfati-Saber (2003), (16): 1 up to k0, 0 from 1 on, and
/// ½(1 + cos(π(z − k0)/(1 − k0))) in between.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bump {
    start: f64,
}

impl Bump {
    /// A bump that leaves 1 at `start` = k0, within (0, 1).
    pub fn new(start: f64) -> Self {
        debug_assert!(start > 0.0 && start < 1.0);
        Self { start }
    }

    /// ρ(z), within [0, 1].
    #[inline]
    pub fn value(&self, z: f64) -> f64 {
        self.value_and_slope(z).0
    }

    /// ρ'(z), within [−π/(2(1 − k0)), 0].
    #[inline]
    pub fn slope(&self, z: f64) -> f64 {
        self.value_and_slope(z).1
    }

    /// ρ(z) and ρ'(z) at once. Without branches, so that many can be found in lanes.
    #[inline]
    pub fn value_and_slope(&self, z: f64) -> (f64, f64) {
        // With the phase θ = π(z − k0)/(1 − k0) written as π/2 + 2y, half a turn of θ
        // becomes a quarter turn of y, which needs no reduction:
        // cos θ = −2 sin y cos y and sin θ = 1 − 2 sin² y.
        let rate = PI / (1.0 - self.start);
        let falling = z.max(self.start).min(1.0);
        let (sin, cos) = quarter(0.5 * rate * (falling - self.start) - FRAC_PI_4);
        let value = (0.5 - sin * cos).max(0.0);
        let slope = -0.5 * rate * (1.0 - 2.0 * sin * sin);
        let value = if z <= self.start { 1.0 } else { value };
        let slope = if z <= self.start { 0.0 } else { slope };
        if z >= 1.0 { (0.0, 0.0) } else { (value, slope) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reaches_its_plateaus_and_halves_in_the_middle() {
        let bump = Bump::new(0.6);
        assert_eq!(bump.value(0.6), 1.0);
        assert_eq!(bump.value(1.0), 0.0);
        assert!((bump.value(0.8) - 0.5).abs() < 1e-15);
    }

    #[test]
    fn equals_its_formula_to_rounding() {
        let start = 5.0 / 6.0;
        let bump = Bump::new(start);
        for k in 1..10_000 {
            let z = start + (1.0 - start) * f64::from(k) / 10_000.0;
            let phase = PI * (z - start) / (1.0 - start);
            assert!(
                (bump.value(z) - 0.5 * (1.0 + phase.cos())).abs() < 1e-15,
                "{z}"
            );
            let slope = -0.5 * PI / (1.0 - start) * phase.sin();
            assert!((bump.slope(z) - slope).abs() < 1e-14, "{z}");
        }
    }

    #[test]
    fn slope_is_the_derivative() {
        let bump = Bump::new(5.0 / 6.0);
        for k in 0..200 {
            let z = 0.7 + 0.4 * f64::from(k) / 200.0 + 1e-4;
            let h = 1e-6;
            let numeric = (bump.value(z + h) - bump.value(z - h)) / (2.0 * h);
            assert!((numeric - bump.slope(z)).abs() < 1e-4, "z = {z}");
        }
    }
}

//! The action function φ_α and its potential ψ_α.

/// The uneven sigmoid of Olfati-Saber (2003), (29), with c = |a − b|/(2√(ab)):
///
/// - φ(z) = (a + b)/2 · (z + c)/√(1 + (z + c)²) + (a − b)/2, from −b to a, zero at 0;
/// - ψ(z) = ∫₀ᶻ φ, zero at 0, positive elsewhere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Action {
    half_sum: f64,
    half_difference: f64,
    shift: f64,
    base: f64,
}

impl Action {
    /// From the limits of attraction a and repulsion b, b ≥ a > 0.
    pub fn new(attraction: f64, repulsion: f64) -> Self {
        let (a, b) = (attraction, repulsion);
        debug_assert!(b >= a && a > 0.0);
        let shift = (b - a) / (2.0 * (a * b).sqrt());
        Self {
            half_sum: 0.5 * (a + b),
            half_difference: 0.5 * (a - b),
            shift,
            base: (1.0 + shift * shift).sqrt(),
        }
    }

    /// φ(z): negative (repulsion) below 0, positive (attraction) above.
    #[inline]
    pub fn force(&self, z: f64) -> f64 {
        let s = z + self.shift;
        self.half_sum * s / (1.0 + s * s).sqrt() + self.half_difference
    }

    /// ψ(z), the potential with ψ' = φ and ψ(0) = 0.
    #[inline]
    pub fn potential(&self, z: f64) -> f64 {
        let s = z + self.shift;
        self.half_sum * ((1.0 + s * s).sqrt() - self.base) + self.half_difference * z
    }

    /// φ_β(z) = min(φ(z), 0): repulsion alone.
    #[inline]
    pub fn repulsion(&self, z: f64) -> f64 {
        self.force(z).min(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn is_zero_at_zero_and_tends_to_its_limits() {
        let action = Action::new(1.0, 5.0);
        assert!(action.force(0.0).abs() < 1e-15);
        assert_eq!(action.potential(0.0), 0.0);
        assert!((action.force(1e8) - 1.0).abs() < 1e-9);
        assert!((action.force(-1e8) + 5.0).abs() < 1e-9);
        assert_eq!(action.repulsion(3.0), 0.0);
    }

    #[test]
    fn force_is_the_potential_s_derivative() {
        for (a, b) in [(1.0, 5.0), (4.0, 40.0), (2.0, 2.0)] {
            let action = Action::new(a, b);
            for k in -50..50 {
                let z = 0.3 * f64::from(k);
                let h = 1e-5;
                let numeric = (action.potential(z + h) - action.potential(z - h)) / (2.0 * h);
                assert!((numeric - action.force(z)).abs() < 1e-7 * b, "z = {z}");
                assert!(action.potential(z) >= 0.0);
            }
        }
    }
}

//! Orientation bias: Djokam & Rathinam, (2.4).

use crate::math::{Vector, sin_cos};
use crate::world::spec::OrientationSpec;

/// The factor f + (1 − f) S(c), where c = ⟨σ_i, x_j − x_i⟩/√(|x_j − x_i|² + ℓ²) with
/// σ_i = v_i/√(|v_i|² + b²), and S rises from 0 to 1 between cos θ − w and cos θ + w as
/// 3s² − 2s³. It is continuously differentiable everywhere, and at least f > 0.
#[derive(Debug, Clone)]
pub(super) struct Orientation {
    /// cos θ.
    cosine: f64,
    /// w.
    softness: f64,
    /// f.
    floor: f64,
    /// b.
    speed: f64,
    /// ℓ.
    length: f64,
}

impl Orientation {
    pub(super) fn new(spec: &OrientationSpec) -> Self {
        Self {
            cosine: sin_cos(spec.angle).1,
            softness: spec.softness,
            floor: spec.floor,
            speed: spec.speed,
            length: spec.length,
        }
    }

    /// The factor for an agent of this velocity, of another that is `offset` away.
    pub(super) fn factor<const D: usize>(&self, velocity: &Vector<D>, offset: &Vector<D>) -> f64 {
        let looks = velocity / velocity.norm().hypot(self.speed);
        let along = offset / offset.norm().hypot(self.length);
        let above = looks.dot(&along) - self.cosine;
        let share = (0.5 + 0.5 * above / self.softness).clamp(0.0, 1.0);
        self.floor + (1.0 - self.floor) * share * share * (3.0 - 2.0 * share)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn forward(cosine: f64) -> Orientation {
        Orientation {
            cosine,
            softness: 0.2,
            floor: 0.05,
            speed: 0.5,
            length: 0.1,
        }
    }

    #[test]
    fn what_lies_ahead_counts_and_the_rest_is_at_the_floor() {
        let factor = |v: [f64; 2], x: [f64; 2]| forward(0.3).factor::<2>(&v.into(), &x.into());
        assert_eq!(factor([3.0, 0.0], [2.0, 0.5]), 1.0);
        assert_eq!(factor([3.0, 0.0], [-2.0, 0.5]), 0.05);
        // At rest, and for agents at the same point, c = 0, here below the cone.
        assert_eq!(factor([0.0, 0.0], [2.0, 0.5]), 0.05);
        assert_eq!(factor([3.0, 0.0], [0.0, 0.0]), 0.05);
        // Halfway at the angle itself, for those fast and far.
        let at = [1e6 * 0.3, 1e6 * 0.91f64.sqrt()];
        assert!((factor([1e6, 0.0], at) - 0.525).abs() < 1e-9);
    }

    #[test]
    fn it_is_smooth_even_at_rest_and_where_agents_meet() {
        // Along lines through the critical points, slopes from both sides agree.
        let orientation = forward(0.0);
        let slopes = |f: &dyn Fn(f64) -> f64, t: f64| {
            let h = 1e-6;
            [(f(t + h) - f(t)) / h, (f(t) - f(t - h)) / h]
        };
        let (v, x) = (Vector::<2>::new(0.7, 0.2), Vector::<2>::new(1.0, -0.4));
        let by_velocity = |t: f64| orientation.factor(&(v * t), &x);
        let by_offset = |t: f64| orientation.factor(&v, &(x * t));
        for k in -200..=200 {
            let t = f64::from(k) * 0.01;
            for f in [&by_velocity as &dyn Fn(f64) -> f64, &by_offset] {
                let [right, left] = slopes(f, t);
                assert!((right - left).abs() < 1e-2, "{t}: {right} {left}");
                assert!(f(t) >= 0.05 && f(t) <= 1.0);
            }
        }
        assert!(slopes(&by_velocity, 0.0)[0] > 0.1);
        assert!(slopes(&by_offset, 0.0)[0] > 0.1);
    }
}

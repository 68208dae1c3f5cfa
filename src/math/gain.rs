//! Gains of velocity alignment.

use crate::math::Vector;

/// A gain that may fall with what it multiplies, so that the product stays bounded.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Gain {
    /// The same for every u.
    Constant(f64),
    /// ξ(u) = A/√(a² + |u|²): Djokam & Rathinam, (2.3). Then |ξ(u)u| < A, (2.2).
    Bounded {
        /// A, the bound of the product.
        bound: f64,
        /// a > 0, the size of u at which the product is A/√2.
        scale: f64,
    },
}

impl Gain {
    /// The gain where |u| is `size` ≥ 0.
    pub fn at(self, size: f64) -> f64 {
        match self {
            Self::Constant(gain) => gain,
            Self::Bounded { bound, scale } => bound / scale.hypot(size),
        }
    }

    /// The largest gain of any u.
    pub fn largest(self) -> f64 {
        self.at(0.0)
    }

    /// The gain times a factor ≥ 0.
    pub fn scaled(self, factor: f64) -> Self {
        match self {
            Self::Constant(gain) => Self::Constant(gain * factor),
            Self::Bounded { bound, scale } => Self::Bounded {
                bound: bound * factor,
                scale,
            },
        }
    }

    /// The product g(|u|)u; where the gain is bounded, never longer than the bound, not
    /// even by rounding.
    pub fn of<const D: usize>(self, u: &Vector<D>) -> Vector<D> {
        let product = u * self.at(u.norm());
        match self {
            Self::Bounded { bound, .. } => shortened(product, bound),
            Self::Constant(_) => product,
        }
    }
}

/// A vector, shortened to at most a length.
pub fn shortened<const D: usize>(vector: Vector<D>, length: f64) -> Vector<D> {
    let norm = vector.norm();
    if norm <= length {
        return vector;
    }
    let mut short = vector * (length / norm);
    // Rounding may leave it a hair too long, and more where squares underflow.
    let mut hair = f64::EPSILON;
    while short.norm() > length && hair < 1.0 {
        short *= 1.0 - hair;
        hair *= 2.0;
    }
    if short.norm() > length {
        return Vector::zeros();
    }
    short
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bounded_gain_keeps_its_promise_for_any_vector() {
        let gain = Gain::Bounded {
            bound: 10.0,
            scale: 0.1f64.sqrt(),
        };
        for size in [0.0, 1e-300, 1e-8, 0.3, 1.0, 7.7, 1e8, 1e150, 1e300] {
            for k in 0..100 {
                let (sin, cos) = crate::math::sin_cos(f64::from(k) * 0.7);
                let product = gain.of(&(Vector::<2>::new(cos, sin) * size));
                assert!(product.norm() <= 10.0, "{size}: {}", product.norm());
                if size > 1.0 {
                    assert!(product.norm() > 9.0 || size > 1e140, "{size}");
                }
            }
        }
        for length in [1e-320, 2.7e-162, 1e-155, 0.0] {
            let short = shortened(Vector::<2>::new(1.0, 1.0), length);
            assert!(short.norm() <= length);
        }
        assert!((gain.largest() - 10.0 / 0.1f64.sqrt()).abs() < 1e-12);
        assert_eq!(gain.scaled(2.0).at(0.3), 2.0 * gain.at(0.3));
    }
}

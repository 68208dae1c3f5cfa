//! Angles between vectors, without the platform's trigonometry.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use crate::math::Vector;

/// The angle between two vectors, from 0 to π, to about 1e-15 for unit vectors: no digits
/// are lost near 0 and π, as the arc cosine would. 0 where one of them is zero.
#[inline]
pub fn angle_between<const D: usize>(a: &Vector<D>, b: &Vector<D>) -> f64 {
    let mut squared = 0.0;
    for row in 0..D {
        for column in 0..row {
            let part = a[row] * b[column] - a[column] * b[row];
            squared += part * part;
        }
    }
    arc(squared.sqrt(), a.dot(b))
}

/// How near to half a turn the angle between headings may be before there is no telling
/// which way to turn.
const OPPOSITE: f64 = 1e-9;

/// The shortest turn from one unit vector to another: tangent at `from`, as long as the
/// angle between them. In the plane it is θ_to − θ_from wrapped to (−π, π), to the left
/// where positive. Zero where the two are opposite (to 1e-9), since no way is shorter.
#[inline]
pub fn turn_between<const D: usize>(from: &Vector<D>, to: &Vector<D>) -> Vector<D> {
    // (to ∧ from) · from: the part of `to` across `from`, exactly zero where they are
    // parallel to the last bit.
    let across = Vector::<D>::from_fn(|row, _| {
        (0..D)
            .map(|k| (to[row] * from[k] - from[row] * to[k]) * from[k])
            .sum()
    });
    let sine = across.norm();
    let angle = arc(sine, from.dot(to));
    if sine > 0.0 && PI - angle > OPPOSITE {
        across * (angle / sine)
    } else {
        Vector::zeros()
    }
}

/// The angle, 0 to π, whose sine and cosine are in this ratio, the sine not negative.
fn arc(sine: f64, cosine: f64) -> f64 {
    let acute = match (sine, cosine.abs()) {
        (0.0, _) => 0.0,
        (y, x) if y <= x => arc_tangent(y / x),
        (y, x) => FRAC_PI_2 - arc_tangent(x / y),
    };
    if cosine < 0.0 { PI - acute } else { acute }
}

/// The arc tangent within [0, 1], to about one unit in the last place: the reduction and
/// the minimax polynomial of fdlibm.
fn arc_tangent(t: f64) -> f64 {
    const HALF: f64 = 4.636_476_090_008_061e-1;
    if t < 0.4375 {
        arc_tangent_series(t)
    } else if t < 0.6875 {
        HALF + arc_tangent_series((2.0 * t - 1.0) / (2.0 + t))
    } else {
        FRAC_PI_4 + arc_tangent_series((t - 1.0) / (t + 1.0))
    }
}

fn arc_tangent_series(t: f64) -> f64 {
    const ODD: [f64; 11] = [
        1.628_582_011_536_578_2e-2,
        -3.653_157_274_421_691_6e-2,
        4.976_877_994_615_932e-2,
        -5.833_570_133_790_573e-2,
        6.661_073_137_387_531e-2,
        -7.691_876_205_044_83e-2,
        9.090_887_133_436_507e-2,
        -1.111_111_040_546_235_6e-1,
        1.428_571_427_250_346_6e-1,
        -1.999_999_999_987_648_3e-1,
        3.333_333_333_333_293e-1,
    ];
    let z = t * t;
    t - t * z * ODD.iter().fold(0.0, |sum, c| sum * z + c)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equals_the_library_s_arc_tangent() {
        for k in 0..=20_000 {
            let angle = PI * f64::from(k) / 20_000.0;
            let (sine, cosine) = angle.sin_cos();
            let expected = sine.max(0.0).atan2(cosine);
            assert!((arc(sine.max(0.0), cosine) - expected).abs() < 1e-15);
        }
        for k in -300..300 {
            let (sine, cosine) = (1.3f64.powi(k), 1.0);
            let error = arc(sine, cosine) - sine.atan2(cosine);
            assert!(error.abs() <= 3e-16 * sine.min(1.0), "{sine}: {error}");
        }
    }

    #[test]
    fn angles_near_none_and_half_a_turn_keep_their_digits() {
        let along = Vector::<3>::new(1.0, 0.0, 0.0);
        let tilted = |by: f64| Vector::<3>::new(1.0, by, 0.0);
        assert!((angle_between(&along, &tilted(1e-12)) - 1e-12).abs() < 1e-26);
        let back = angle_between(&along, &-tilted(1e-7));
        assert!((PI - back - 1e-7).abs() < 1e-15);
        assert_eq!(angle_between(&along, &Vector::<3>::zeros()), 0.0);
    }

    #[test]
    fn turns_are_tangent_and_as_long_as_the_angle() {
        let heading = |angle: f64| Vector::<2>::new(angle.cos(), angle.sin());
        for k in -31..=31 {
            let by = 0.1 * f64::from(k);
            let turn = turn_between(&heading(0.7), &heading(0.7 + by));
            let left = Vector::<2>::new(-(0.7f64).sin(), 0.7f64.cos());
            assert!((turn - left * by).norm() < 1e-14, "{by}");
        }
        let (a, b) = (
            Vector::<3>::new(0.6, 0.0, 0.8),
            Vector::<3>::new(0.0, 1.0, 0.0),
        );
        assert!((turn_between(&a, &b) - b * FRAC_PI_2).norm() < 1e-15);
        assert_eq!(turn_between(&a, &-a), Vector::<3>::zeros());
        assert_eq!(turn_between(&a, &a), Vector::<3>::zeros());
    }
}

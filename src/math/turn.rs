//! Sine and cosine, the same on every platform.

use std::f64::consts::{FRAC_PI_4, TAU};

/// Sine and cosine of an angle in radians. Beyond a quarter turn the angle is taken in
/// turns, which costs rounding in proportion to its size and nothing else.
pub fn sin_cos(angle: f64) -> (f64, f64) {
    if angle.abs() <= FRAC_PI_4 {
        quarter(angle)
    } else {
        sin_cos_of_turns(angle / TAU)
    }
}

/// Sine and cosine of an angle in whole turns, as exact for many turns as the number
/// itself is.
pub fn sin_cos_of_turns(turns: f64) -> (f64, f64) {
    // Both subtractions are exact.
    let rest = turns - turns.round();
    let quarters = (4.0 * rest).round();
    let (sin, cos) = quarter((rest - 0.25 * quarters) * TAU);
    match quarters as i64 {
        0 => (sin, cos),
        1 => (cos, -sin),
        -1 => (-cos, sin),
        // Two quarters, either way.
        _ => (-sin, -cos),
    }
}

/// Sine and cosine of an angle within a quarter turn, −π/4 to π/4, to about one unit in
/// the last place: minimax polynomials of degree 13 and 14. Much quicker than the
/// library's, whose range reduction is not needed, and the same on every platform.
#[inline]
pub(super) fn quarter(y: f64) -> (f64, f64) {
    const SIN: [f64; 6] = [
        1.589_690_995_211_55e-10,
        -2.505_076_025_340_686_3e-8,
        2.755_731_370_707_006_8e-6,
        -1.984_126_982_985_795e-4,
        8.333_333_333_322_49e-3,
        -1.666_666_666_666_663_2e-1,
    ];
    const COS: [f64; 6] = [
        -1.135_964_755_778_819_5e-11,
        2.087_572_321_298_175e-9,
        -2.755_731_435_139_066_3e-7,
        2.480_158_728_947_673e-5,
        -1.388_888_888_887_411e-3,
        4.166_666_666_666_66e-2,
    ];
    let z = y * y;
    let polynomial = |coefficients: [f64; 6]| coefficients.iter().fold(0.0, |sum, c| sum * z + c);
    let sin = y + y * z * polynomial(SIN);
    let cos = 1.0 - 0.5 * z + z * z * polynomial(COS);
    (sin, cos)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agrees_with_the_library() {
        for k in -4_000..4_000 {
            let angle = 0.0137 * f64::from(k);
            let (sin, cos) = sin_cos(angle);
            let error = (sin - angle.sin()).abs().max((cos - angle.cos()).abs());
            assert!(error < 2e-14, "{angle}: {error}");
        }
    }

    #[test]
    fn turns_are_exact_however_many() {
        for whole in [0.0, 1.0, -7.0, 1e6, 1e12] {
            assert_eq!(sin_cos_of_turns(whole + 0.25), (1.0, 0.0));
            assert_eq!(sin_cos_of_turns(whole + 0.5), (0.0, -1.0));
            assert_eq!(sin_cos_of_turns(whole - 0.25), (-1.0, 0.0));
            let (sin, cos) = sin_cos_of_turns(whole + 0.125);
            assert!((sin - 0.5f64.sqrt()).abs() < 1e-15 && (cos - sin).abs() < 1e-15);
        }
    }
}

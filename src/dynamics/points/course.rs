//! Where functions of time that are known at an instant or two are zero.

/// The first t > 0 at which c + bt + at² is zero, for c > 0.
pub(super) fn first_root([c, b, a]: [f64; 3]) -> Option<f64> {
    let inner = b * b - 4.0 * a * c;
    if inner.is_nan() || inner < 0.0 {
        return None;
    }
    let root = inner.sqrt();
    let time = match b < 0.0 {
        true => 2.0 * c / (root - b),
        false if a < 0.0 => (b + root) / (-2.0 * a),
        false => return None,
    };
    time.is_finite().then_some(time)
}

/// The polynomial of degree 5 with value and first two derivatives given at both ends of a step,
/// over the share of it.
pub(super) fn quintic(step: f64, begin: [f64; 3], end: [f64; 3]) -> impl Fn(f64) -> f64 {
    let scaled = |[value, rate, bend]: [f64; 3]| [value, rate * step, bend * step * step];
    let ([a, da, dda], [b, db, ddb]) = (scaled(begin), scaled(end));
    let way = b - a;
    let coefficients = [
        a,
        da,
        0.5 * dda,
        10.0 * way - 6.0 * da - 4.0 * db - 0.5 * (3.0 * dda - ddb),
        -15.0 * way + 8.0 * da + 7.0 * db + 0.5 * (3.0 * dda - 2.0 * ddb),
        6.0 * way - 3.0 * (da + db) - 0.5 * (dda - ddb),
    ];
    move |share| {
        coefficients
            .iter()
            .rev()
            .fold(0.0, |sum, c| sum * share + c)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_are_the_first_ones_ahead() {
        let near = |found: Option<f64>, wanted: f64| {
            assert!(
                found.is_some_and(|found| (found - wanted).abs() < 1e-14),
                "{found:?}"
            );
        };
        near(first_root([2.0, -3.0, 1.0]), 1.0);
        near(first_root([2.0, 1.0, -1.0]), 2.0);
        near(first_root([1.0, -4.0, 0.0]), 0.25);
        for none in [
            [1.0, 0.0, 1.0],
            [1.0, 1.0, 0.0],
            [1.0, 2.0, 1.0],
            [f64::NAN, 1.0, 1.0],
        ] {
            assert_eq!(first_root(none), None);
        }
    }

    #[test]
    fn polynomials_of_degree_five_are_found_from_their_ends() {
        let value = |t: f64| 1.0 + t * (2.0 - t * (1.0 - t * (0.5 + t * (0.25 - t))));
        let rate = |t: f64| 2.0 - t * (2.0 - t * (1.5 + t * (1.0 - t * 5.0)));
        let bend = |t: f64| -2.0 + t * (3.0 + t * (3.0 - t * 20.0));
        let path = quintic(
            0.5,
            [value, rate, bend].map(|f| f(0.0)),
            [value, rate, bend].map(|f| f(0.5)),
        );
        for share in [0.0, 0.3, 0.9, 1.0] {
            assert!((path(share) - value(0.5 * share)).abs() < 1e-14);
        }
    }
}

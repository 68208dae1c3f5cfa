//! Lanes against the formulas for one number.

use pulp::{Simd, WithSimd};

use crate::math::{Influence, Potential, Radial, WithRadial, vectorized};

/// Squared distances over the whole range, some thousands of them, a whole number of lanes.
fn squares() -> Vec<f64> {
    let mut squares = vec![0.0, f64::from_bits(1), 1e-310, f64::MIN_POSITIVE, 1.0, 2.0];
    squares.extend((-1000..=1000).map(|power| libm::exp2(f64::from(power))));
    // The golden ratio spreads them evenly.
    squares.extend((1..6000).map(|k| libm::exp2(12.0 * ((f64::from(k) * 0.618_033_988_75) % 1.0))));
    squares.extend((1..6000).map(|k| libm::exp2(2000.0 * ((f64::from(k) * 0.618) % 1.0) - 1000.0)));
    squares.truncate(squares.len() / 8 * 8);
    squares
}

/// The values at some squared distances, by whole registers, over the scale.
struct Fill<'a, K> {
    radial: K,
    squares: &'a [f64],
    values: &'a mut [f64],
}

impl<K: Radial> WithSimd for Fill<'_, K> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let (squares, _) = S::as_simd_f64s(self.squares);
        let (values, _) = S::as_mut_simd_f64s(self.values);
        for (value, square) in values.iter_mut().zip(squares) {
            *value = self.radial.lanes(simd, *square);
        }
    }
}

/// Compares lanes to a formula, to some units in the last place of its largest part.
struct Compare<F, G> {
    formula: F,
    part: G,
    ulps: f64,
    what: String,
}

impl<F: Fn(f64) -> f64, G: Fn(f64) -> f64> WithRadial for Compare<F, G> {
    type Output = ();

    fn with<K: Radial>(self, radial: K) {
        let squares = squares();
        let mut values = vec![f64::NAN; squares.len()];
        vectorized(Fill {
            radial,
            squares: &squares,
            values: &mut values,
        });
        let mut worst = 0.0f64;
        for (&square, &value) in squares.iter().zip(&values) {
            let value = value * radial.scale();
            let what = &self.what;
            assert_eq!(value.to_bits(), radial.value(square).to_bits(), "{what}");
            let formula = (self.formula)(square);
            assert!(!value.is_nan(), "{what} at {square:e}");
            if value == formula {
                continue;
            }
            let part = (self.part)(square).abs();
            // What is not normal, lanes take for nothing.
            if part < 1e3 * f64::MIN_POSITIVE && value.abs() <= 1e3 * f64::MIN_POSITIVE {
                continue;
            }
            let error = (value - formula).abs() / (part * f64::EPSILON);
            worst = worst.max(error);
            assert!(
                error <= self.ulps,
                "{what} at {square:e}: {value:e}, {formula:e}, {error}"
            );
        }
        println!("{}: {worst:.2}", self.what);
    }
}

fn compare_influence(influence: &Influence, ulps: f64) {
    let formula = |squared| influence.value(squared);
    let compared = influence.with_radial(Compare {
        formula,
        part: formula,
        ulps,
        what: format!("{influence:?}"),
    });
    assert!(compared.is_some(), "{influence:?}");
}

fn cucker_smale(strength: f64, length: f64, exponent: f64) -> Influence {
    Influence::CuckerSmale {
        strength,
        length,
        exponent,
    }
}

#[test]
fn powers_are_accurate_to_a_few_units_in_the_last_place() {
    for length in [1e-150, 0.3, 1.0, 1e150] {
        for quarters in 0..=16 {
            let exponent = 0.25 * f64::from(quarters);
            compare_influence(&cucker_smale(2.0, length, exponent), 6.0);
        }
        for exponent in [1e-6, 0.1, 0.3, 0.4, 0.6, 0.99, 1.01, 1.7, 2.3, 3.9] {
            compare_influence(&cucker_smale(1.0, length, exponent), 4.0);
        }
    }
}

#[test]
fn exponentials_are_accurate_to_a_few_units_in_the_last_place() {
    compare_influence(&Influence::Constant(3.0), 0.0);
    // The argument's own rounding counts as often as it is large, and is at most 745.
    for length in [0.01, 1.0, 40.0] {
        let (strength, ulps) = (2.0, 1500.0);
        compare_influence(&Influence::Exponential { strength, length }, ulps);
    }
}

//! Lanes against the formulas for one number.

use pulp::{Simd, WithSimd};

use crate::math::{Influence, Potential, Radial, Repulsion, WithRadial, vectorized};

/// Squared distances over the whole range, some thousands of them, a whole number of lanes.
fn squares() -> Vec<f64> {
    let mut squares = vec![0.0, f64::from_bits(1), 1e-310, f64::MIN_POSITIVE, 1.0, 2.0];
    squares.extend((-200..=200).map(|power| libm::exp2(5.0 * f64::from(power))));
    // The golden ratio spreads them evenly.
    squares.extend((1..1500).map(|k| libm::exp2(12.0 * ((f64::from(k) * 0.618_033_988_75) % 1.0))));
    squares.extend((1..1500).map(|k| libm::exp2(2000.0 * ((f64::from(k) * 0.618) % 1.0) - 1000.0)));
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
    /// The value from which an exponential falls; 0 where there is none. Its argument is
    /// rounded, so ulps grow with it.
    height: f64,
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
            let argument = libm::log((self.height / part).max(1.0));
            let allowed = self.ulps + 2.0 * argument;
            assert!(
                error <= allowed,
                "{what} at {square:e}: {value:e}, {formula:e}, {error}"
            );
        }
    }
}

fn compare_influence(influence: &Influence, ulps: f64, height: f64) {
    let formula = |squared| influence.value(squared);
    let compared = influence.with_radial(Compare {
        formula,
        part: formula,
        ulps,
        height,
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
            compare_influence(&cucker_smale(2.0, length, exponent), 6.0, 0.0);
        }
        for exponent in [1e-6, 0.1, 0.3, 0.4, 0.6, 0.99, 1.01, 1.7, 2.3, 3.9] {
            compare_influence(&cucker_smale(1.0, length, exponent), 4.0, 0.0);
        }
    }
}

#[test]
fn exponentials_are_accurate_to_a_few_units_in_the_last_place() {
    compare_influence(&Influence::Constant(3.0), 0.0, 0.0);
    for length in [0.01, 1.0, 40.0] {
        let strength = 2.0;
        compare_influence(&Influence::Exponential { strength, length }, 4.0, strength);
    }
}

/// Potentials, and the largest of the terms that their forces are a difference of.
#[test]
fn forces_are_accurate_to_a_few_units_in_the_last_place_of_their_terms() {
    let bond = |stiffness, length| Potential::Bond { stiffness, length };
    let attraction = Potential::Attraction { stiffness: 0.3 };
    let gaussian = |height, decay| Potential::Gaussian { height, decay };
    let compare = |potential: Potential, terms: &[Potential], ulps: f64, height: f64| {
        // Nearer than lanes can tell, forces are not what they would be.
        let near = |squared: f64| squared > 0.0 && squared < f64::MIN_POSITIVE;
        let formula = |squared: f64| match near(squared) {
            true => potential.force_over_distance(f64::MIN_POSITIVE),
            false => potential.force_over_distance(squared),
        };
        let part = |squared: f64| {
            let size = |term: &Potential| term.force_over_distance(squared).abs();
            terms
                .iter()
                .map(size)
                .fold(formula(squared).abs(), f64::max)
        };
        let compared = potential.with_radial(Compare {
            formula,
            part,
            ulps,
            height,
            what: format!("{potential:?}"),
        });
        assert!(compared.is_some(), "{potential:?}");
    };
    compare(
        bond(0.7, 1.5),
        &[Potential::Attraction { stiffness: 0.7 }],
        4.0,
        0.0,
    );
    compare(attraction, &[], 0.0, 0.0);
    compare(gaussian(4.0, 1.8), &[], 4.0, 4.0 * 3.6);
    let (attraction, repulsion) = (1.0, 20.0);
    let squared_length = 0.2;
    let gazi_passino = Potential::GaziPassino {
        attraction,
        repulsion,
        squared_length,
    };
    compare(
        gazi_passino,
        &[Potential::Attraction { stiffness: 1.0 }],
        6.0,
        20.0,
    );
    let (attraction, repulsion) = (0.5, 2.5);
    let logarithmic = Potential::Logarithmic {
        attraction,
        repulsion,
    };
    let term = Potential::Logarithmic {
        attraction: 0.0,
        repulsion,
    };
    compare(logarithmic, &[term], 6.0, 0.0);
    let morse = |attraction, repulsion| Potential::Morse {
        attraction,
        attraction_length: 2.0,
        repulsion,
        repulsion_length: 0.5,
    };
    compare(
        morse(0.5, 1.0),
        &[morse(0.0, 1.0), morse(0.5, 0.0)],
        8.0,
        2.0,
    );
}

#[test]
fn repulsions_are_accurate_to_a_few_units_in_the_last_place() {
    for exponent in [1.1, 1.5, 2.0, 3.0] {
        let repulsion = Repulsion {
            strength: 2.0,
            exponent,
            squared_distance: 1.5,
            floor: 1e-6,
        };
        let formula = |squared: f64| repulsion.value(squared);
        let compared = repulsion.with_radial(Compare {
            formula,
            part: formula,
            ulps: 6.0,
            height: 0.0,
            what: format!("{repulsion:?}"),
        });
        assert!(compared.is_some(), "{exponent}");
    }
}

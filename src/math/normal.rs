//! The normal distribution's quantiles, without the platform's logarithm.

use std::f64::consts::{LN_2, SQRT_2};

/// The standard normal quantile Φ⁻¹(p) for p within (0, 1), to about 1e-15 of its size:
/// M. J. Wichura, Algorithm AS 241 (PPND16), Applied Statistics 37, 1988.
pub fn normal_quantile(p: f64) -> f64 {
    const A: [f64; 8] = [
        2.509_080_928_730_122_7e3,
        3.343_057_558_358_813e4,
        6.726_577_092_700_87e4,
        4.592_195_393_154_987e4,
        1.373_169_376_550_946e4,
        1.971_590_950_306_551_4e3,
        1.331_416_678_917_843_8e2,
        3.387_132_872_796_366_6,
    ];
    const B: [f64; 8] = [
        5.226_495_278_852_855e3,
        2.872_908_573_572_194_3e4,
        3.930_789_580_009_271e4,
        2.121_379_430_158_66e4,
        5.394_196_021_424_751e3,
        6.871_870_074_920_579e2,
        4.231_333_070_160_091e1,
        1.0,
    ];
    const C: [f64; 8] = [
        7.745_450_142_783_414e-4,
        2.272_384_498_926_918_5e-2,
        2.417_807_251_774_506e-1,
        1.270_458_252_452_368_4,
        3.647_848_324_763_204_5,
        5.769_497_221_460_691,
        4.630_337_846_156_546,
        1.423_437_110_749_683_5,
    ];
    const D: [f64; 8] = [
        1.050_750_071_644_416_9e-9,
        5.475_938_084_995_345e-4,
        1.519_866_656_361_645_7e-2,
        1.481_039_764_274_800_8e-1,
        6.897_673_349_851e-1,
        1.676_384_830_183_803_8,
        2.053_191_626_637_759,
        1.0,
    ];
    const E: [f64; 8] = [
        2.010_334_399_292_288_1e-7,
        2.711_555_568_743_487_6e-5,
        1.242_660_947_388_078_4e-3,
        2.653_218_952_657_612_4e-2,
        2.965_605_718_285_048_7e-1,
        1.784_826_539_917_291_3,
        5.463_784_911_164_114,
        6.657_904_643_501_103,
    ];
    const F: [f64; 8] = [
        2.044_263_103_389_939_8e-15,
        1.421_511_758_316_446e-7,
        1.846_318_317_510_054_8e-5,
        7.868_691_311_456_133e-4,
        1.487_536_129_085_061_5e-2,
        1.369_298_809_227_358e-1,
        5.998_322_065_558_88e-1,
        1.0,
    ];
    let ratio = |over: [f64; 8], under: [f64; 8], r: f64| {
        let sum = |coefficients: [f64; 8]| coefficients.iter().fold(0.0, |sum, c| sum * r + c);
        sum(over) / sum(under)
    };
    let q = p - 0.5;
    if q.abs() <= 0.425 {
        return q * ratio(A, B, 0.180_625 - q * q);
    }
    let r = (-ln(p.min(1.0 - p))).sqrt();
    let size = match r <= 5.0 {
        true => ratio(C, D, r - 1.6),
        false => ratio(E, F, r - 5.0),
    };
    size.copysign(q)
}

/// The natural logarithm of a normal number, to a few units in the last place: the
/// exponent, and the series of the inverse hyperbolic tangent for the rest.
fn ln(x: f64) -> f64 {
    const MANTISSA: u64 = (1 << 52) - 1;
    let mut exponent = ((x.to_bits() >> 52) as i64 - 1023) as f64;
    let mut rest = f64::from_bits((x.to_bits() & MANTISSA) | 1.0f64.to_bits());
    if rest > SQRT_2 {
        rest *= 0.5;
        exponent += 1.0;
    }
    let s = (rest - 1.0) / (rest + 1.0);
    // |s| ≤ 0.172: twelve terms leave less than 1e-19.
    let series = (0..12)
        .rev()
        .fold(0.0, |sum, k| sum * s * s + 1.0 / f64::from(2 * k + 1));
    exponent * LN_2 + 2.0 * s * series
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn logarithms_equal_the_library_s() {
        for k in 1..200_000 {
            let x = f64::from(k) / 200_000.0;
            assert!(
                (ln(x) - x.ln()).abs() < 1e-15 * x.ln().abs().max(0.1),
                "{x}"
            );
        }
        for k in 1..300 {
            let x = 10f64.powi(-k);
            assert!((ln(x) - x.ln()).abs() < 1e-15 * x.ln().abs(), "{x}");
        }
    }

    #[test]
    fn quantiles_equal_known_ones_and_are_odd() {
        // Tables of the normal distribution, as Wichura's paper quotes them.
        for (p, expected) in [
            (0.25, -0.674_489_750_196_081_7),
            (0.001, -3.090_232_306_167_813_5),
            (1e-20, -9.262_340_089_798_408),
        ] {
            let error = normal_quantile(p) - expected;
            assert!(error.abs() < 4e-15 * expected.abs(), "{p}: {error}");
        }
        assert_eq!(normal_quantile(0.5), 0.0);
        for p in [0.4, 0.0625, 0.0078125] {
            assert_eq!(normal_quantile(1.0 - p), -normal_quantile(p));
        }
    }

    #[test]
    fn quantiles_invert_the_integral_of_the_density() {
        // Simpson's rule, from one quantile to the next: each piece holds a hundredth.
        let density = |x: f64| (-0.5 * x * x).exp() / (2.0 * std::f64::consts::PI).sqrt();
        for k in 1..99 {
            let p = f64::from(k) / 100.0;
            let (from, to) = (normal_quantile(p), normal_quantile(p + 0.01));
            let pieces = 32;
            let h = (to - from) / f64::from(2 * pieces);
            let sum: f64 = (0..pieces)
                .map(|i| from + h * f64::from(2 * i))
                .map(|x| density(x) + 4.0 * density(x + h) + density(x + 2.0 * h))
                .sum();
            assert!((sum * h / 3.0 - 0.01).abs() < 1e-12, "{p}");
        }
    }
}

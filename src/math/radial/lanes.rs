//! Elementary functions of lanes of numbers.
//!
//! They are made of additions, products, fused products and sums, and shifts, all of which
//! are the same on every processor: so are their bits.

use pulp::{Simd, bytemuck::cast};

/// A first guess of x^(−1/R), from the exponent and the leading digits of x as an integer, and
/// a polynomial in e = 1 − x y^R that makes an accurate guess of it.
struct Guess {
    /// What the upper half of x over R is taken from.
    bits: u64,
    /// (1 − e)^(−1/R) for the guess's |e|, fitted to the least relative error; the highest
    /// power first.
    polynomial: &'static [f64],
}

const GUESSES: [Guess; 3] = [
    // |e| < 0.0506; error left: 8e-7.
    Guess {
        bits: 0x7fde_622a_0000_0000,
        polynomial: &[
            1.0025589977510823,
            1.002558997749339,
            0.9999991830092358,
            0.9999991830092398,
        ],
    },
    // |e| < 0.0682; error left: 1.5e-6.
    Guess {
        bits: 0x5fe6_e8dd_0000_0000,
        polynomial: &[
            0.31390308014013407,
            0.3762748822554759,
            0.49999844239041663,
            0.9999992588127283,
        ],
    },
    // |e| < 0.1236; error left: 6e-7.
    Guess {
        bits: 0x4feb_02fc_0000_0000,
        polynomial: &[
            0.09697927224300751,
            0.11875169191183266,
            0.15623871753470214,
            0.2499940040315677,
            1.000000011513893,
        ],
    },
];

/// x^(−1/R) for R = 1, 2 or 4 and normal x up to 2^1000, to one unit in the last place.
#[inline(always)]
pub(super) fn inverse_root<S: Simd, const R: u32>(simd: S, x: S::f64s) -> S::f64s {
    let shift = R.trailing_zeros();
    let guess = &GUESSES[shift as usize];
    // The lower half's digits are shifted on their own; they are below the guess's error.
    let shifted = simd.wrapping_dyn_shr_u32s(cast(x), simd.splat_u32s(shift));
    let bits = simd.sub_u32s(cast(simd.splat_u64s(guess.bits)), shifted);
    let y = cast(bits);
    let y = simd.mul_f64s(
        y,
        polynomial(simd, guess.polynomial, residual::<S, R>(simd, x, y)),
    );
    // Two terms of the series of (1 − e)^(−1/R).
    let e = residual::<S, R>(simd, x, y);
    let first = 1.0 / f64::from(R);
    let second = 0.5 * first * (first + 1.0);
    let series = simd.mul_add_f64s(e, simd.splat_f64s(second), simd.splat_f64s(first));
    simd.mul_add_f64s(simd.mul_f64s(y, e), series, y)
}

/// 1 − x y^R, in an order in which no product underflows or overflows.
#[inline(always)]
fn residual<S: Simd, const R: u32>(simd: S, x: S::f64s, y: S::f64s) -> S::f64s {
    let product = match R {
        1 => x,
        2 => simd.mul_f64s(x, y),
        _ => {
            let square = simd.mul_f64s(y, y);
            simd.mul_f64s(simd.mul_f64s(x, square), y)
        }
    };
    simd.negate_mul_add_f64s(product, y, simd.splat_f64s(1.0))
}

/// A polynomial of at least one coefficient, the highest power first.
#[inline(always)]
fn polynomial<S: Simd>(simd: S, coefficients: &[f64], x: S::f64s) -> S::f64s {
    let mut sum = simd.splat_f64s(coefficients[0]);
    for &coefficient in &coefficients[1..] {
        sum = simd.mul_add_f64s(sum, x, simd.splat_f64s(coefficient));
    }
    sum
}

/// 2^f for |f| ≤ ½, fitted to the least relative error, 4e-18; the highest power first.
const EXP2: [f64; 12] = [
    4.4307278926159093e-10,
    7.073810162632353e-9,
    1.0178229258162927e-7,
    1.3215435106206315e-6,
    1.525273341214025e-5,
    0.0001540353045751891,
    0.0013333558146874727,
    0.009618129107593736,
    0.05550410866481954,
    0.24022650695910133,
    std::f64::consts::LN_2,
    1.0,
];

/// What rounds a number to an integer when it is added and taken off again.
const ROUNDER: f64 = 1.5 * (1u64 << 52) as f64;

/// The integer nearest to x, |x| < 2^51.
#[inline(always)]
fn rounded<S: Simd>(simd: S, x: S::f64s) -> S::f64s {
    let rounder = simd.splat_f64s(ROUNDER);
    simd.sub_f64s(simd.add_f64s(x, rounder), rounder)
}

/// A shift of the upper half of each number, where the exponent is; the lower half is to be 0.
const TO_EXPONENT: u64 = 20 << 32;

/// 2^n for integers n: 0 below −1022, infinite above 1023.
#[inline(always)]
fn power_of_two<S: Simd>(simd: S, n: S::f64s) -> S::f64s {
    let n = simd.max_f64s(n, simd.splat_f64s(-1023.0));
    let n = simd.min_f64s(n, simd.splat_f64s(1024.0));
    // n + 1023 as an integer in the last digits of the upper half, then in the exponent.
    let digits = simd.add_f64s(n, simd.splat_f64s(f64::from(1u32 << 20) + 1023.0));
    let by = cast(simd.splat_u64s(TO_EXPONENT));
    cast(simd.wrapping_dyn_shl_u32s(cast(digits), by))
}

/// exp(x) for x ≤ 0, to two units in the last place; 0 below 2^−1022.
#[inline(always)]
pub(crate) fn exp<S: Simd>(simd: S, x: S::f64s) -> S::f64s {
    let x = simd.max_f64s(x, simd.splat_f64s(-800.0));
    let scale = simd.splat_f64s(std::f64::consts::LOG2_E);
    let n = rounded(simd, simd.mul_f64s(x, scale));
    // What the constant's rounding leaves out.
    let rest = simd.mul_f64s(x, simd.splat_f64s(2.0355273740931033e-17));
    let f = simd.add_f64s(simd.mul_sub(x, scale, n), rest);
    simd.mul_f64s(polynomial(simd, &EXP2, f), power_of_two(simd, n))
}

/// x^(−β) for an exponent β ≥ 0 that is known beforehand.
///
/// With x = 2^k m, 1 ≤ m < 2, it is 2^(−βk) m^(−β). The second factor is a polynomial of N
/// coefficients that is made for the exponent; −βk is split into an integer and a rest
/// exactly.
#[derive(Debug, Clone, Copy)]
pub(super) struct InversePower<const N: usize> {
    exponent: f64,
    /// m^(−β) as a polynomial in t = 2m − 3, the highest power first.
    mantissa: [f64; N],
}

impl<const N: usize> InversePower<N> {
    /// With 21 coefficients accurate up to an exponent of 1, with 28 up to 4.
    pub(super) fn new(exponent: f64) -> Self {
        Self {
            exponent,
            mantissa: shortened_series(exponent),
        }
    }

    /// x^(−β) for normal x up to 2^1000, to 3 units in the last place; 0 below 2^−1022.
    #[inline(always)]
    pub(super) fn of<S: Simd>(&self, simd: S, x: S::f64s) -> S::f64s {
        let bits = simd.transmute_u64s_f64s(x);
        // The biased exponent as the last digits of the upper half of a number near 2^20.
        let exponent = simd.and_u64s(bits, simd.splat_u64s(0x7ff0_0000_0000_0000));
        let digits = simd.wrapping_dyn_shr_u32s(cast(exponent), cast(simd.splat_u64s(TO_EXPONENT)));
        let near = simd.splat_f64s(f64::from(1u32 << 20));
        let k = simd.sub_f64s(
            simd.or_f64s(cast(digits), near),
            simd.splat_f64s(f64::from(1u32 << 20) + 1023.0),
        );
        let digits = simd.and_u64s(bits, simd.splat_u64s(0x000f_ffff_ffff_ffff));
        let m = simd.or_f64s(simd.transmute_f64s_u64s(digits), simd.splat_f64s(1.0));
        let t = simd.mul_add_f64s(m, simd.splat_f64s(2.0), simd.splat_f64s(-3.0));
        let mantissa = polynomial(simd, &self.mantissa, t);

        let minus_beta = simd.splat_f64s(-self.exponent);
        let product = simd.mul_f64s(minus_beta, k);
        let n = rounded(simd, product);
        let rest = simd.mul_sub(minus_beta, k, product);
        let f = simd.add_f64s(simd.sub_f64s(product, n), rest);
        let power = simd.mul_f64s(mantissa, polynomial(simd, &EXP2, f));
        simd.mul_f64s(power, power_of_two(simd, n))
    }
}

/// The polynomial of m^(−β) in t = 2m − 3, |t| ≤ 1, the highest power first: its binomial
/// series (3/2)^(−β) (1 + t/3)^(−β), with the powers above the degree taken off one after the
/// other, each with the Chebyshev polynomial that it begins.
fn shortened_series<const N: usize>(exponent: f64) -> [f64; N] {
    const TERMS: usize = 48;
    let mut series = [0.0; TERMS];
    series[0] = libm::pow(1.5, -exponent);
    for k in 1..TERMS {
        let k_ = k as f64;
        series[k] = -series[k - 1] * (exponent + k_ - 1.0) / (3.0 * k_);
    }
    let chebyshev = chebyshev::<TERMS>();
    for n in (N..TERMS).rev() {
        let share = series[n] / chebyshev[n][n];
        for k in 0..=n {
            series[k] -= share * chebyshev[n][k];
        }
    }
    std::array::from_fn(|k| series[N - 1 - k])
}

/// The coefficients of the first N Chebyshev polynomials, the lowest power first.
fn chebyshev<const N: usize>() -> Vec<[f64; N]> {
    let mut all = vec![[0.0; N]; N];
    all[0][0] = 1.0;
    all[1][1] = 1.0;
    for n in 2..N {
        for k in 0..N {
            let twice = if k > 0 { 2.0 * all[n - 1][k - 1] } else { 0.0 };
            all[n][k] = twice - all[n - 2][k];
        }
    }
    all
}

/// A fused product less a number.
trait MulSub: Simd {
    /// ab − c, rounded once.
    fn mul_sub(self, a: Self::f64s, b: Self::f64s, c: Self::f64s) -> Self::f64s;
}

impl<S: Simd> MulSub for S {
    #[inline(always)]
    fn mul_sub(self, a: S::f64s, b: S::f64s, c: S::f64s) -> S::f64s {
        self.mul_add_f64s(a, b, self.neg_f64s(c))
    }
}

//! The explicit method of order 8.
//!
//! P. J. Prince and J. R. Dormand, "High order embedded Runge-Kutta formulae", 1981, with the
//! error by E. Hairer, S. P. Nørsett and G. Wanner, "Solving Ordinary Differential Equations
//! I", 1993, II.10: known as DOP853. Two embedded solutions, of orders 5 and 3, tell the error.

use super::{Method, Stand, System};

/// The explicit method of Dormand and Prince of order 8; see the module.
#[derive(Debug, Clone, Default)]
pub struct DormandPrince {
    /// The slopes at the stages.
    slopes: [Vec<f64>; 12],
}

impl DormandPrince {
    /// Order of the method.
    pub const ORDER: usize = 8;
}

impl Method for DormandPrince {
    const POWER: f64 = 8.0;

    fn attempt(
        &mut self,
        system: &mut impl System,
        stand: Stand<'_>,
        step: f64,
        end: &mut Vec<f64>,
    ) -> Option<f64> {
        for slope in &mut self.slopes {
            slope.resize(stand.state.len(), 0.0);
        }
        self.slopes[0].copy_from_slice(stand.slope);
        let shares = TIMES[1..].iter().copied().chain([1.0]);
        for (stage, share) in (1..).zip(shares) {
            let weights = STAGES.get(stage - 1).copied().unwrap_or(&END);
            end.clear();
            end.extend_from_slice(stand.state);
            for (weight, slope) in weights.iter().zip(&self.slopes) {
                if *weight != 0.0 {
                    for (y, slope) in end.iter_mut().zip(slope) {
                        *y += step * weight * slope;
                    }
                }
            }
            if stage == TIMES.len() {
                return Some(self.error(system, stand, step, end));
            }
            system.slope(stand.time + share * step, end, &mut self.slopes[stage]);
        }
        None
    }
}

impl DormandPrince {
    /// The error of a step, as a share of the one allowed.
    fn error(&self, system: &impl System, stand: Stand<'_>, step: f64, end: &[f64]) -> f64 {
        let (mut fifth, mut third): (f64, f64) = (0.0, 0.0);
        for (k, (before, after)) in stand.state.iter().zip(end).enumerate() {
            let sum = |weights: &[f64; 12]| -> f64 {
                let terms = weights.iter().zip(&self.slopes);
                terms.map(|(weight, slope)| weight * slope[k]).sum()
            };
            let allowed = system.scale(k, *before, *after) * stand.tolerance;
            for (largest, weights) in [(&mut fifth, &FIFTH), (&mut third, &THIRD)] {
                let error = (step * sum(weights)).abs();
                // Nothing where nothing moves, whatever the scale.
                let share = if error == 0.0 { 0.0 } else { error / allowed };
                if !share.is_finite() {
                    return f64::NAN;
                }
                *largest = largest.max(share);
            }
        }
        match fifth {
            0.0 => 0.0,
            _ => fifth * (fifth / f64::hypot(fifth, 0.1 * third)),
        }
    }
}

/// The times of the stages, as shares of the step.
const TIMES: [f64; 12] = [
    0.0,
    0.05260015195876773,
    0.0789002279381516,
    0.1183503419072274,
    0.2816496580927726,
    0.3333333333333333,
    0.25,
    0.3076923076923077,
    0.6512820512820513,
    0.6,
    0.8571428571428571,
    1.0,
];

/// What each stage after the first makes of those before it.
const STAGES: [&[f64]; 11] = [
    &[0.05260015195876773],
    &[0.0197250569845379, 0.0591751709536137],
    &[0.02958758547680685, 0.0, 0.08876275643042054],
    &[
        0.2413651341592667,
        0.0,
        -0.8845494793282861,
        0.924834003261792,
    ],
    &[
        0.037037037037037035,
        0.0,
        0.0,
        0.17082860872947386,
        0.12546768756682242,
    ],
    &[
        0.037109375,
        0.0,
        0.0,
        0.17025221101954405,
        0.06021653898045596,
        -0.017578125,
    ],
    &[
        0.03709200011850479,
        0.0,
        0.0,
        0.17038392571223998,
        0.10726203044637328,
        -0.015319437748624402,
        0.008273789163814023,
    ],
    &[
        0.6241109587160757,
        0.0,
        0.0,
        -3.3608926294469414,
        -0.868219346841726,
        27.59209969944671,
        20.154067550477894,
        -43.48988418106996,
    ],
    &[
        0.47766253643826434,
        0.0,
        0.0,
        -2.4881146199716677,
        -0.590290826836843,
        21.230051448181193,
        15.279233632882423,
        -33.28821096898486,
        -0.020331201708508627,
    ],
    &[
        -0.9371424300859873,
        0.0,
        0.0,
        5.186372428844064,
        1.0914373489967295,
        -8.149787010746927,
        -18.52006565999696,
        22.739487099350505,
        2.4936055526796523,
        -3.0467644718982196,
    ],
    &[
        2.273310147516538,
        0.0,
        0.0,
        -10.53449546673725,
        -2.0008720582248625,
        -17.9589318631188,
        27.94888452941996,
        -2.8589982771350235,
        -8.87285693353063,
        12.360567175794303,
        0.6433927460157636,
    ],
];

/// The solution of order 8.
const END: [f64; 12] = [
    0.054293734116568765,
    0.0,
    0.0,
    0.0,
    0.0,
    4.450312892752409,
    1.8915178993145003,
    -5.801203960010585,
    0.3111643669578199,
    -0.1521609496625161,
    0.20136540080403034,
    0.04471061572777259,
];

/// The same less a solution of order 3.
const THIRD: [f64; 12] = [
    -0.18980075407240762,
    0.0,
    0.0,
    0.0,
    0.0,
    4.450312892752409,
    1.8915178993145003,
    -5.801203960010585,
    -0.4226823213237919,
    -0.1521609496625161,
    0.20136540080403034,
    0.02265179219836082,
];

/// The same less a solution of order 5.
const FIFTH: [f64; 12] = [
    0.01312004499419488,
    0.0,
    0.0,
    0.0,
    0.0,
    -1.2251564463762044,
    -0.4957589496572502,
    1.6643771824549864,
    -0.35032884874997366,
    0.3341791187130175,
    0.08192320648511571,
    -0.022355307863886294,
];

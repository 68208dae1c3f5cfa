//! ψ(r), the least influence of any agent on any other while the flock is at most r across, (3.8).

use super::model::Model;
use crate::math::{DormandPrince, Influence, Solution};
use crate::world::spec::{KernelSpec, NormalisationSpec};

/// The relative accuracy of integrals, for each step of them.
const ACCURACY: f64 = 1e-13;

/// ψ = w/(N − 1 + w) with Motsch–Tadmor, otherwise w/N, where w(r) = f φ(r)/φ(0) and f is the
/// least that orientation and masking leave of an influence.
///
/// Without these (f = 1) it is exact, as φ falls: an agent at the distance r whose other
/// neighbours are all where it is gets no less from anyone. With them it is a lower bound, and
/// what follows from it follows from ψ.
pub(super) struct Psi {
    kernel: Decay,
    /// f.
    floor: f64,
    agents: f64,
    /// Whether influences are divided by their sum.
    shared: bool,
}

enum Decay {
    Constant,
    /// σ and β.
    Power(f64, f64),
    /// ℓ.
    Exponential(f64),
}

impl Psi {
    /// Of a law; nothing where some influence may end, or jump: Assumption 2.
    pub fn of<const D: usize>(model: &Model<'_, '_, D>, sees_all: bool) -> Option<Self> {
        let law = model.law;
        let sight = law.line_of_sight.as_ref();
        let clear = sight.is_none_or(|it| it.agents == 1.0 && it.obstacles == 1.0);
        let own = law.self_influence || law.normalisation != NormalisationSpec::MotschTadmor;
        let present = law.kernel.influence().value(0.0) > 0.0;
        if law.range.is_some() || law.graph.is_some() || !(clear && own && present && sees_all) {
            return None;
        }
        let kernel = match law.kernel {
            KernelSpec::Constant { .. } => Decay::Constant,
            KernelSpec::CuckerSmale {
                length, exponent, ..
            } => Decay::Power(length, exponent),
            KernelSpec::Exponential { length, .. } => Decay::Exponential(length),
            KernelSpec::Bump { .. } => return None,
        };
        let agents = model.count() as f64;
        let ahead = law.orientation.as_ref().map_or(1.0, |it| it.floor);
        let masked = law.masking.as_ref().map_or(0.0, |it| {
            let most = 2.0 - it.onset;
            it.strength * most * most * most * (agents - 2.0).max(0.0)
        });
        Some(Self {
            kernel,
            floor: ahead * libm::exp(-masked),
            agents,
            shared: law.normalisation == NormalisationSpec::MotschTadmor,
        })
    }

    /// ψ(r).
    pub fn at(&self, r: f64) -> f64 {
        let unit = match self.kernel {
            Decay::Constant => Influence::Constant(1.0),
            Decay::Power(length, exponent) => Influence::CuckerSmale {
                strength: 1.0,
                length,
                exponent,
            },
            Decay::Exponential(length) => Influence::Exponential {
                strength: 1.0,
                length,
            },
        };
        let w = self.floor * unit.value(r * r) / unit.value(0.0);
        w * self.over(w)
    }

    /// ψ/w.
    fn over(&self, w: f64) -> f64 {
        match self.shared {
            true => 1.0 / (self.agents - 1.0 + w),
            false => 1.0 / self.agents,
        }
    }

    /// ∫ ψ^k dr from r to infinity, infinite where φ falls no faster than r^(−1/k).
    ///
    /// The variable is changed so that the way is finite and the integrand smooth: e^(−r/ℓ),
    /// or (r/σ)^(1 − 2βk) beyond σ.
    pub fn integral(&self, from: f64, k: i32) -> f64 {
        match self.kernel {
            Decay::Constant => f64::INFINITY,
            Decay::Exponential(length) => {
                let of = |w: f64| w.powi(k - 1) * self.over(w).powi(k);
                length * integral(of, 0.0, self.floor * libm::exp(-from / length))
            }
            Decay::Power(length, exponent) => {
                let power = 2.0 * exponent * f64::from(k);
                if power <= 1.0 {
                    return f64::INFINITY;
                }
                let near = |t: f64| self.at(length * t).powi(k);
                let (start, split) = (from / length, f64::max(from / length, 1.0));
                let far = |z: f64| {
                    // 1/t².
                    let inverse = libm::pow(z, 2.0 / (power - 1.0));
                    let flat = self.floor * libm::pow(1.0 + inverse, -exponent);
                    let w = flat * libm::pow(inverse, exponent);
                    (flat * self.over(w)).powi(k)
                };
                let end = libm::pow(split, 1.0 - power);
                let beyond = integral(far, 0.0, end) / (power - 1.0);
                length * (integral(near, start, split) + beyond)
            }
        }
    }
}

/// ∫ f from `from` to `to` of an f that is positive and smooth.
fn integral(of: impl Fn(f64) -> f64, from: f64, to: f64) -> f64 {
    if to <= from {
        return 0.0;
    }
    let width = to - from;
    let size = of(from).max(of(to)).max(of(0.5 * (from + to)));
    let slope = |s: f64, _: &[f64], out: &mut [f64]| out[0] = of(from + s * width) / size;
    let mut sum = Solution::new(slope, DormandPrince::default(), 0.0, vec![0.0], ACCURACY);
    match sum.advance_to(1.0) {
        Ok(()) => sum.state()[0] * width * size,
        Err(_) => f64::NAN,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn psi(kernel: Decay, floor: f64, agents: f64, shared: bool) -> Psi {
        Psi {
            kernel,
            floor,
            agents,
            shared,
        }
    }

    #[test]
    fn integrals_are_those_in_closed_form() {
        let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-10 * b, "{a} {b}");
        for a in [0.0, 0.3, 1.0, 20.0] {
            // φ = 1/(1 + r²), N = 2: ψ = 1/(2 + r²).
            let left = |x: f64| std::f64::consts::FRAC_PI_2 - x.atan();
            let two = psi(Decay::Power(1.0, 1.0), 1.0, 2.0, true);
            near(two.at(a), 1.0 / (2.0 + a * a));
            let root = 2f64.sqrt();
            near(two.integral(a, 1), left(a / root) / root);
            let square = left(a / root) / (4.0 * root) - a / (4.0 * (a * a + 2.0));
            near(two.integral(a, 2), square);
            // φ = 1/(1 + r²/4), N = 5, not shared.
            let five = psi(Decay::Power(2.0, 1.0), 0.5, 5.0, false);
            near(five.integral(a, 1), 0.5 * 2.0 * left(a / 2.0) / 5.0);
            // φ = e^(−r/3), N = 4.
            let four = psi(Decay::Exponential(3.0), 0.7, 4.0, true);
            let w = 0.7 * (-a / 3.0).exp();
            near(four.integral(a, 1), 3.0 * (w / 3.0).ln_1p());
            // As ln(1 + x) − x/(1 + x), which keeps its digits.
            let x = w / 3.0;
            near(four.integral(a, 2), 3.0 * (x.ln_1p() - x / (1.0 + x)));
        }
    }

    #[test]
    fn slow_kernels_never_end() {
        let of = |exponent: f64, k: i32| {
            psi(Decay::Power(1.0, exponent), 1.0, 7.0, true).integral(3.0, k)
        };
        assert_eq!(of(0.3, 1), f64::INFINITY);
        assert_eq!(of(0.5, 1), f64::INFINITY);
        assert_eq!(of(0.25, 2), f64::INFINITY);
        assert!(of(0.3, 2).is_finite() && of(0.5001, 1).is_finite());
        let constant = psi(Decay::Constant, 1.0, 7.0, true);
        assert_eq!(constant.integral(1.0, 2), f64::INFINITY);
    }

    #[test]
    fn slow_tails_are_whole() {
        // Against a plain sum to 1e6 and the tail ∫ (r/σ)^(−p) f/(N − 1) in closed form.
        let it = psi(Decay::Power(1.0, 0.6), 1.0, 3.0, true);
        let steps = 200_000;
        let (low, high) = (2f64.ln(), 1e6f64.ln());
        let width = (high - low) / f64::from(steps);
        let middle = (0..steps).map(|k| (low + (f64::from(k) + 0.5) * width).exp());
        let sum: f64 = middle.map(|r| it.at(r) * r * width).sum();
        // ψ = w/2 − w²/4 + …, with w = r^(−1.2) far out.
        let tail = 1e6f64.powf(-0.2) / (2.0 * 0.2) - 1e6f64.powf(-1.4) / (4.0 * 1.4);
        let found = it.integral(2.0, 1);
        assert!(
            (found - sum - tail).abs() < 1e-8 * found,
            "{found} {sum} {tail}"
        );
    }
}

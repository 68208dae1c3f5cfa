//! The force and the potential between two α-agents.

use pulp::Arch;

use crate::math::{Action, Bump};

/// The interaction of two α-agents at a distance: Olfati-Saber (2003), (30), (34) to (36).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AlphaPair {
    /// The action function φ_α.
    pub action: Action,
    /// Desired distance d_α.
    pub spacing: f64,
    /// Interaction range r.
    pub range: f64,
    /// How the interaction ends at its range.
    pub fade: Fade,
}

/// How an interaction ends at its range.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Fade {
    /// At once: a_ij is 1 up to the range, (8).
    Sharp,
    /// By the bump function: a_ij = ρ(distance/r), (17).
    Smooth(Bump),
    /// As `Smooth`, but the force leaves out the gradient of a_ij, (36).
    Approximate(Bump),
}

impl AlphaPair {
    /// The weight a_ij at a distance within the range, from 0 to 1.
    #[inline]
    pub fn weight(&self, distance: f64) -> f64 {
        match self.fade {
            Fade::Sharp => 1.0,
            Fade::Smooth(bump) | Fade::Approximate(bump) => {
                bump.value(distance * self.range.recip())
            }
        }
    }

    /// The acceleration towards the other agent at a distance within the range;
    /// negative away from it. But for `Approximate` it is the potential's derivative.
    #[inline]
    pub fn force(&self, distance: f64) -> f64 {
        self.force_and_weight(distance).0
    }

    /// The force and the weight a_ij at once.
    #[inline]
    pub fn force_and_weight(&self, distance: f64) -> (f64, f64) {
        match self.fade {
            Fade::Sharp => self.sharp(distance),
            Fade::Smooth(bump) => self.smooth(bump, distance),
            Fade::Approximate(bump) => self.approximate(bump, distance),
        }
    }

    /// For many pairs at once, from the squares of their distances: what to multiply the way
    /// to the other agent by to get the force, nothing where there is no way, into `ratios`;
    /// and the weights. In the lanes that the processor has, with the same result on all.
    pub fn ratios_and_weights(&self, squared: &[f64], ratios: &mut [f64], weights: &mut [f64]) {
        let out = ratios.iter_mut().zip(weights);
        let pairs = squared.iter().zip(out);
        Arch::new().dispatch(
            #[inline(always)]
            || match self.fade {
                Fade::Sharp => each(pairs, |distance| self.sharp(distance)),
                Fade::Smooth(bump) => each(pairs, |distance| self.smooth(bump, distance)),
                Fade::Approximate(bump) => each(pairs, |distance| self.approximate(bump, distance)),
            },
        );
    }

    #[inline(always)]
    fn sharp(&self, distance: f64) -> (f64, f64) {
        (self.action.force(distance - self.spacing), 1.0)
    }

    #[inline(always)]
    fn smooth(&self, bump: Bump, distance: f64) -> (f64, f64) {
        let z = distance - self.spacing;
        let per_range = self.range.recip();
        let (weight, slope) = bump.value_and_slope(distance * per_range);
        let falling = slope * per_range * self.action.potential(z);
        // Where the bump is flat, a potential too large to compute must not matter.
        let falling = if slope < 0.0 { falling } else { 0.0 };
        (weight * self.action.force(z) + falling, weight)
    }

    #[inline(always)]
    fn approximate(&self, bump: Bump, distance: f64) -> (f64, f64) {
        let weight = bump.value(distance * self.range.recip());
        (weight * self.action.force(distance - self.spacing), weight)
    }

    /// The pair's share a_ij ψ_α of the structural potential V, at a distance within
    /// the range.
    #[inline]
    pub fn potential(&self, distance: f64) -> f64 {
        self.weight(distance) * self.action.potential(distance - self.spacing)
    }
}

/// Works out the pairs one after the other, in code without branches: the compiler puts them
/// into lanes.
#[inline(always)]
fn each<'a>(
    pairs: impl Iterator<Item = (&'a f64, (&'a mut f64, &'a mut f64))>,
    force_and_weight: impl Fn(f64) -> (f64, f64),
) {
    for (squared, (ratio, weight)) in pairs {
        let distance = squared.sqrt();
        let (force, its_weight) = force_and_weight(distance);
        let along = force / distance;
        *ratio = if distance > 0.0 { along } else { 0.0 };
        *weight = its_weight;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pair(fade: Fade) -> AlphaPair {
        AlphaPair {
            action: Action::new(1.0, 5.0),
            spacing: 7.0,
            range: 8.4,
            fade,
        }
    }

    #[test]
    fn force_is_the_potential_s_derivative() {
        let bump = Bump::new(5.0 / 6.0);
        for fade in [Fade::Sharp, Fade::Smooth(bump)] {
            let pair = pair(fade);
            for k in 1..83 {
                let (d, h) = (0.1 * f64::from(k), 1e-6);
                let numeric = (pair.potential(d + h) - pair.potential(d - h)) / (2.0 * h);
                assert!((numeric - pair.force(d)).abs() < 1e-6, "at {d}");
            }
        }
    }

    #[test]
    fn many_pairs_at_once_get_the_same_to_the_last_bit() {
        let bump = Bump::new(0.4);
        let squared: Vec<f64> = (0..77).map(|k| (0.12 * f64::from(k)).powi(2)).collect();
        for fade in [Fade::Sharp, Fade::Smooth(bump), Fade::Approximate(bump)] {
            let pair = pair(fade);
            let mut ratios = [f64::NAN; 77];
            let mut weights = [f64::NAN; 77];
            pair.ratios_and_weights(&squared, &mut ratios, &mut weights);
            for (k, squared) in squared.iter().enumerate() {
                let distance = squared.sqrt();
                let (force, weight) = pair.force_and_weight(distance);
                let ratio = if k == 0 { 0.0 } else { force / distance };
                assert_eq!((ratios[k], weights[k]), (ratio, weight), "at {distance}");
            }
        }
    }

    #[test]
    fn approximation_leaves_out_the_gradient_of_the_weight_alone() {
        let bump = Bump::new(5.0 / 6.0);
        let (exact, approximate) = (pair(Fade::Smooth(bump)), pair(Fade::Approximate(bump)));
        // Where the bump is flat the two agree; where it falls they do not.
        assert_eq!(exact.force(6.0), approximate.force(6.0));
        let difference = exact.force(7.8) - approximate.force(7.8);
        let gradient = bump.slope(7.8 / 8.4) / 8.4 * exact.action.potential(0.8);
        assert!((difference - gradient).abs() < 1e-14 && difference < 0.0);
    }
}

//! The force and the potential between two α-agents.

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
            Fade::Smooth(bump) | Fade::Approximate(bump) => bump.value(distance / self.range),
        }
    }

    /// The acceleration towards the other agent at a distance within the range;
    /// negative away from it. But for `Approximate` it is the potential's derivative.
    #[inline]
    pub fn force(&self, distance: f64) -> f64 {
        let z = distance - self.spacing;
        match self.fade {
            Fade::Sharp => self.action.force(z),
            Fade::Smooth(bump) => {
                let share = distance / self.range;
                bump.value(share) * self.action.force(z)
                    + bump.slope(share) / self.range * self.action.potential(z)
            }
            Fade::Approximate(bump) => bump.value(distance / self.range) * self.action.force(z),
        }
    }

    /// The pair's share a_ij ψ_α of the structural potential V, at a distance within
    /// the range.
    #[inline]
    pub fn potential(&self, distance: f64) -> f64 {
        self.weight(distance) * self.action.potential(distance - self.spacing)
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

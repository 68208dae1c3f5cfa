//! Potentials between two agents, and the forces that come of them.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A potential V(r) of two agents at a distance r. Each agent is pushed down its slope: the
/// force on agent i is −∇_i V(r) = −V'(r)/r · (x_i − x_j), away from j where V falls.
///
/// World files hold it as it is.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Potential {
    /// A bond of some length: V = k_a/2 (r − η)². Song et al. (2013), (8), (12).
    Bond {
        /// Stiffness k_a (1/time²).
        #[schemars(range(min = 0))]
        stiffness: f64,
        /// Length η at which the bond neither pulls nor pushes.
        #[schemars(range(min = 0))]
        length: f64,
    },
    /// Attraction in proportion to the distance: V = k_a/2 r². With the share `mean`, that of
    /// Song et al. (2013), (17).
    Attraction {
        /// Stiffness k_a (1/time²).
        #[schemars(range(min = 0))]
        stiffness: f64,
    },
    /// A bounded repulsion: V = Q exp(−μ r²). Song et al. (2013), (5).
    Gaussian {
        /// Height Q at distance 0 (length²/time²).
        #[schemars(range(min = 0))]
        height: f64,
        /// Decay μ (1/length²).
        #[schemars(extend("exclusiveMinimum" = 0))]
        decay: f64,
    },
    /// Attraction from afar, repulsion without bound from near: V = a ln r² + b/r², least at
    /// r = √(b/a). Shi, Wang & Chu, below Definition 3; in their simulations a = 1/2, b = 5/2.
    Logarithmic {
        /// Attraction a (length²/time²).
        #[schemars(range(min = 0))]
        attraction: f64,
        /// Repulsion b (length⁴/time²).
        #[schemars(extend("exclusiveMinimum" = 0))]
        repulsion: f64,
    },
    /// Attraction in proportion to the distance, bounded repulsion:
    /// V = a r²/2 + b c/2 exp(−r²/c), least at r = √(c ln(b/a)). Gazi & Passino, as in Song
    /// et al. (2013), (16), where the force is −a(x_i − x_j) + b(x_i − x_j) exp(−r²/c).
    GaziPassino {
        /// Attraction a (1/time² of an acceleration, 1/time of a velocity).
        #[schemars(range(min = 0))]
        attraction: f64,
        /// Repulsion b, in the unit of the attraction.
        #[schemars(range(min = 0))]
        repulsion: f64,
        /// Square c of the length over which the repulsion decays (length²).
        #[schemars(extend("exclusiveMinimum" = 0))]
        squared_length: f64,
    },
    /// V = C_r exp(−r/l_r) − C_a exp(−r/l_a): M. R. D'Orsogna et al., "Self-propelled particles
    /// with soft-core interactions", Phys. Rev. Lett. 96, 2006, (2).
    Morse {
        /// Strength C_a of the attraction (length²/time²).
        #[schemars(range(min = 0))]
        attraction: f64,
        /// Length l_a over which the attraction decays.
        #[schemars(extend("exclusiveMinimum" = 0))]
        attraction_length: f64,
        /// Strength C_r of the repulsion (length²/time²).
        #[schemars(range(min = 0))]
        repulsion: f64,
        /// Length l_r over which the repulsion decays.
        #[schemars(extend("exclusiveMinimum" = 0))]
        repulsion_length: f64,
    },
}

impl Potential {
    /// V(r) at a distance r ≥ 0; infinite at 0 where it is logarithmic.
    pub fn value(self, r: f64) -> f64 {
        let squared = r * r;
        match self {
            Self::Bond { stiffness, length } => 0.5 * stiffness * (r - length) * (r - length),
            Self::Attraction { stiffness } => 0.5 * stiffness * squared,
            Self::Gaussian { height, decay } => height * libm::exp(-decay * squared),
            // Both terms are infinite here, and the repulsion wins.
            Self::Logarithmic { .. } if squared == 0.0 => f64::INFINITY,
            Self::Logarithmic {
                attraction,
                repulsion,
            } => attraction * libm::log(squared) + repulsion / squared,
            Self::GaziPassino {
                attraction,
                repulsion,
                squared_length,
            } => {
                let bump = squared_length * libm::exp(-squared / squared_length);
                0.5 * (attraction * squared + repulsion * bump)
            }
            Self::Morse {
                attraction,
                attraction_length,
                repulsion,
                repulsion_length,
            } => {
                repulsion * libm::exp(-r / repulsion_length)
                    - attraction * libm::exp(-r / attraction_length)
            }
        }
    }

    /// The force over the distance, −V'(r)/r, by the square of the distance: what x_i − x_j is
    /// multiplied by, positive where the agents repel each other. At 0, where there is no
    /// direction, there is no force.
    #[inline]
    pub fn force_over_distance(self, squared: f64) -> f64 {
        if squared == 0.0 {
            return 0.0;
        }
        match self {
            Self::Bond { stiffness, length } => stiffness * (length / squared.sqrt() - 1.0),
            Self::Attraction { stiffness } => -stiffness,
            Self::Gaussian { height, decay } => 2.0 * height * decay * libm::exp(-decay * squared),
            Self::Logarithmic {
                attraction,
                repulsion,
            } => 2.0 * (repulsion / squared - attraction) / squared,
            Self::GaziPassino {
                attraction,
                repulsion,
                squared_length,
            } => repulsion * libm::exp(-squared / squared_length) - attraction,
            Self::Morse {
                attraction,
                attraction_length,
                repulsion,
                repulsion_length,
            } => {
                let r = squared.sqrt();
                let slope = |height: f64, length: f64| height / length * libm::exp(-r / length);
                (slope(repulsion, repulsion_length) - slope(attraction, attraction_length)) / r
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [Potential; 6] = [
        Potential::Bond {
            stiffness: 0.7,
            length: 1.5,
        },
        Potential::Attraction { stiffness: 0.3 },
        Potential::Gaussian {
            height: 4.0,
            decay: 1.8,
        },
        Potential::Logarithmic {
            attraction: 0.5,
            repulsion: 2.5,
        },
        Potential::GaziPassino {
            attraction: 1.0,
            repulsion: 20.0,
            squared_length: 0.2,
        },
        Potential::Morse {
            attraction: 0.5,
            attraction_length: 2.0,
            repulsion: 1.0,
            repulsion_length: 0.5,
        },
    ];

    #[test]
    fn force_is_the_negative_slope_of_the_potential() {
        for potential in ALL {
            for k in 1..60 {
                let (r, h) = (0.1 * f64::from(k), 1e-5);
                let slope = (potential.value(r + h) - potential.value(r - h)) / (2.0 * h);
                let force = potential.force_over_distance(r * r) * r;
                let error = (force + slope).abs();
                // The logarithmic one is steep: its third derivative at 0.1 is 60b/r⁵.
                assert!(error < 1e-5 * slope.abs().max(1.0), "{potential:?} at {r}");
            }
        }
    }

    #[test]
    fn rests_where_the_papers_say() {
        let logarithmic = ALL[3].force_over_distance(5.0);
        let gazi_passino = ALL[4].force_over_distance(0.2 * libm::log(20.0));
        assert!(logarithmic.abs() < 1e-15 && gazi_passino.abs() < 1e-14);
        assert_eq!(ALL[0].force_over_distance(2.25), 0.0);
    }

    #[test]
    fn has_no_force_at_distance_zero_and_is_nowhere_undefined() {
        for potential in ALL {
            assert_eq!(potential.force_over_distance(0.0), 0.0);
            for r in [0.0, 1e-200, 1e-100, 1.0, 1e100, 1e200] {
                assert!(!potential.value(r).is_nan(), "{potential:?} at {r}");
                let force = potential.force_over_distance(r * r);
                assert!(!force.is_nan(), "{potential:?} at {r}");
            }
        }
        assert_eq!(ALL[3].value(0.0), f64::INFINITY);
        assert_eq!(ALL[2].value(0.0), 4.0);
    }
}

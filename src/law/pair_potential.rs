//! Forces of a potential between any two agents.
//!
//! u_i = −Σ_j ∇_i V(r_ij), or that over N; v̇_i = u_i, or u_i/m_i where it acts as a force.
//!
//! | potential | V(r) | source |
//! |---|---|---|
//! | `bond` | k_a/2 (r − η)² | Song et al. (2013), (8) |
//! | `attraction`, share `mean` | k_a/2 r² | Song et al. (2013), (17) |
//! | `gaussian` | Q exp(−μ r²) | Song et al. (2013), (5) |
//! | `logarithmic` | a ln r² + b/r² | Shi, Wang & Chu, (6); acts as `force` |
//! | `gazi_passino` | a r²/2 + b c/2 exp(−r²/c) | Song et al. (2013), (16) |
//! | `morse` | C_r exp(−r/l_r) − C_a exp(−r/l_a) | D'Orsogna et al. (2006), (2) |
//!
//! Shi, Wang & Chu's (15), a force that is weighted by the mass, is the one that acts as
//! `acceleration`. Units of the parameters are those of [`Potential`](crate::math::Potential);
//! where it acts as a force they have one mass more.
//!
//! The forces on a pair are equal and opposite, so without scopes and senses the sum over all
//! agents is zero. Two agents at the same point have no direction between them and exert no
//! force. A logarithmic potential keeps agents apart only while the step resolves it.
//!
//! On bodies it is of second order in the step without a `range`; with one of first order, as links
//! come and go.

use crate::law::Law;
use crate::law::pair_force::PairForce;
use crate::math::Vector;
use crate::sense::Scene;
use crate::world::spec::{ActsAs, PairPotentialSpec, Share};

/// Forces of a potential between any two agents; see the module.
pub struct PairPotential<const D: usize> {
    force: PairForce<D>,
    acts_as: ActsAs,
}

impl<const D: usize> PairPotential<D> {
    /// The law with the parameters of a world file.
    pub fn new(spec: &PairPotentialSpec) -> Self {
        Self {
            force: PairForce::of(spec.potential, spec.share, spec.range, spec.summation),
            acts_as: spec.acts_as,
        }
    }

    /// The law with a potential of one's own, given by its force over the distance,
    /// −V'(r)/r, as a function of r² > 0: positive where agents repel each other. Without a
    /// range it acts between all pairs.
    pub fn from_function(
        force_over_distance: impl Fn(f64) -> f64 + Send + Sync + 'static,
        share: Share,
        acts_as: ActsAs,
        range: Option<f64>,
    ) -> Self {
        Self {
            force: PairForce::new(force_over_distance, share, range),
            acts_as,
        }
    }
}

impl<const D: usize> Law<D> for PairPotential<D> {
    fn name(&self) -> &str {
        "pair_potential"
    }

    fn range(&self) -> f64 {
        self.force.range()
    }

    fn jump(&self) -> Option<f64> {
        self.force.jump()
    }

    fn prepare(&mut self, scene: &Scene<'_, D>) {
        self.force.prepare(scene);
    }

    fn gather(&mut self, scene: &Scene<'_, D>) {
        self.force.gather(scene);
    }

    fn accelerate(&self, scene: &Scene<'_, D>, first: usize, out: &mut [Vector<D>]) {
        let forces = self.force.on(scene, first, out.len());
        for ((i, acceleration), force) in (first..).zip(out).zip(forces) {
            *acceleration += force * self.acts_as.factor(scene.mass(i));
        }
    }
}

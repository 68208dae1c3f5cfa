//! Repulsion in proportion to the disagreement of the velocities.
//!
//! u_i = Λ(v) Σ_j f(|x_i − x_j|²)(x_i − x_j) with Λ(v) = (1/N Σ_{i<j} |v_i − v_j|²)^½ and
//! f(s) = K/(s − d0)^θ: Cucker & Dong, as in Song et al. (2013), (3). v̇_i = u_i, or u_i/m_i where
//! it acts as a force.
//!
//! | parameter | symbol | unit |
//! |---|---|---|
//! | `strength` | K | length^(2θ − 1)/time |
//! | `exponent` | θ > 1 | 1 |
//! | `squared_distance` | d0 | length² |
//! | `floor` | least s − d0 that f is taken at | length² |
//! | `range` | beyond which f counts as 0; absent in the paper | length |
//!
//! f acts on the square of the distance, so what it guarantees is a distance above √d0, not the
//! print's d0: ∫f over s from d0 is infinite, hence θ > 1. The guarantee is that of the true
//! motion. A step too long, or a contact, may bring a pair nearer; `floor` then keeps its
//! repulsion finite, and pointing outward.
//!
//! Λ is that of the true velocities of the agents that the law may count as neighbours, whom
//! each agent sees or not: by Lemma 9 it is (Σ_i |v_i − v̄|²)^½ over them. When they agree, nothing
//! repels.
//!
//! On bodies it is of second order in the step without a `range`; with one of first order, as links
//! come and go.

use crate::law::Law;
use crate::law::pair_force::PairForce;
use crate::math::{Repulsion, Vector, mean};
use crate::sense::Scene;
use crate::world::spec::{ActsAs, CuckerDongSpec, Share};

/// Repulsion in proportion to the disagreement of the velocities; see the module.
pub struct CuckerDong<const D: usize> {
    force: PairForce<D>,
    acts_as: ActsAs,
    /// Λ.
    disagreement: f64,
}

impl<const D: usize> CuckerDong<D> {
    /// The law with the parameters of a world file.
    pub fn new(spec: &CuckerDongSpec) -> Self {
        let &CuckerDongSpec {
            strength,
            exponent,
            squared_distance,
            floor,
            acts_as,
            range,
        } = spec;
        let repulsion = Repulsion {
            strength,
            exponent,
            squared_distance,
            floor,
        };
        Self {
            force: PairForce::repulsion(repulsion, range),
            acts_as,
            disagreement: 0.0,
        }
    }

    /// The law with one's own f, a function of the squared distance, above 0. Without a range
    /// it acts between all pairs.
    pub fn from_function(
        f: impl Fn(f64) -> f64 + Send + Sync + 'static,
        acts_as: ActsAs,
        range: Option<f64>,
    ) -> Self {
        Self {
            force: PairForce::new(f, Share::Sum, range),
            acts_as,
            disagreement: 0.0,
        }
    }
}

impl<const D: usize> Law<D> for CuckerDong<D> {
    fn name(&self) -> &str {
        "cucker_dong"
    }

    fn range(&self) -> f64 {
        self.force.range()
    }

    fn jump(&self) -> Option<f64> {
        self.force.jump()
    }

    fn prepare(&mut self, scene: &Scene<'_, D>) {
        self.force.prepare(scene);
        let velocity = |place: usize| scene.sees(place).then_some(scene.velocities[place]);
        let seen = scene.in_world_order(velocity).flatten();
        let seen: Vec<Vector<D>> = seen.collect();
        let mean = mean(&seen);
        let squares = seen.iter().map(|velocity| (velocity - mean).norm_squared());
        self.disagreement = squares.sum::<f64>().sqrt();
    }

    fn gather(&mut self, scene: &Scene<'_, D>) {
        self.force.gather(scene);
    }

    fn accelerate(&self, scene: &Scene<'_, D>, first: usize, out: &mut [Vector<D>]) {
        let forces = self.force.on(scene, first, out.len());
        for ((i, acceleration), force) in (first..).zip(out).zip(forces) {
            let factor = self.disagreement * self.acts_as.factor(scene.mass(i));
            *acceleration += force * factor;
        }
    }
}

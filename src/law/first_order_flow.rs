//! Steering to the velocities of a swarm of first order.
//!
//! v̇_i = k (u_i − v_i) with u_i = −Σ_j ∇_i V(r_ij), or that over N: the larger k, the nearer the
//! motion is to ẋ_i = u_i. With the potential `gazi_passino` that is the swarm of Gazi & Passino,
//! Song et al. (2013), (16).
//!
//! | parameter | symbol | unit |
//! |---|---|---|
//! | `potential` | V | length²/time |
//! | `rate` | k | 1/time |
//! | `range` | beyond which ∇V counts as 0; absent in the paper | length |
//!
//! A body cannot have a velocity at once, so what (16) prescribes is what it is steered to. Two
//! agents at the same point have no direction between them and do not part.
//!
//! On bodies it is of second order in the step without a `range`; with one of first order, as links
//! come and go.

use crate::law::Law;
use crate::law::pair_force::PairForce;
use crate::math::Vector;
use crate::sense::Scene;
use crate::world::spec::{FirstOrderFlowSpec, Share, SummationSpec};

/// Steering to the velocities of a swarm of first order; see the module.
pub struct FirstOrderFlow<const D: usize> {
    flow: PairForce<D>,
    rate: f64,
}

impl<const D: usize> FirstOrderFlow<D> {
    /// The law with the parameters of a world file.
    pub fn new(spec: &FirstOrderFlowSpec) -> Self {
        Self {
            flow: PairForce::of(
                spec.potential,
                spec.share,
                spec.range,
                SummationSpec::Direct,
            ),
            rate: spec.rate,
        }
    }

    /// The law with a potential of one's own, given by −V'(r)/r as a function of r² > 0:
    /// positive where agents part. Without a range it acts between all pairs.
    pub fn from_function(
        flow_over_distance: impl Fn(f64) -> f64 + Send + Sync + 'static,
        share: Share,
        rate: f64,
        range: Option<f64>,
    ) -> Self {
        Self {
            flow: PairForce::new(flow_over_distance, share, range),
            rate,
        }
    }
}

impl<const D: usize> Law<D> for FirstOrderFlow<D> {
    fn name(&self) -> &str {
        "first_order_flow"
    }

    fn range(&self) -> f64 {
        self.flow.range()
    }

    fn jump(&self) -> Option<f64> {
        self.flow.jump()
    }

    fn prepare(&mut self, scene: &Scene<'_, D>) {
        self.flow.prepare(scene);
    }

    fn gather(&mut self, scene: &Scene<'_, D>) {
        self.flow.gather(scene);
    }

    fn accelerate(&self, scene: &Scene<'_, D>, first: usize, out: &mut [Vector<D>]) {
        let flow = self.flow.on(scene, first, out.len());
        for ((i, acceleration), flow) in (first..).zip(out).zip(flow) {
            *acceleration += (flow - scene.velocities[i]) * self.rate;
        }
    }
}

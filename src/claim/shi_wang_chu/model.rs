//! The paper's flock in a world: law (6) or (15), with or without damping.

use nalgebra::DMatrix;

use super::damping::{Damping, damping_rates, damping_scale, is_linear};
use crate::claim::{Judging, Run};
use crate::math::{Potential, Vector};
use crate::metric::{Observation, center_of_mass, kinetic_energy};
use crate::net::Adjacency;
use crate::world::spec::{
    ActsAs, AlignmentSpec, GainSpec, GraphSpec, KernelSpec, LawSpec, PairPotentialSpec, Share,
};

/// A world's alignment law and pair potential, seen as law (6), or as (15) where they are
/// weighted by the masses.
pub(super) struct Model<'r, const D: usize> {
    pub run: &'r Run<'r, D>,
    alignment: &'r AlignmentSpec,
    index: usize,
    force: &'r PairPotentialSpec,
    /// What weighs velocities in J and in the velocity kept: masses with (6), ones with (15).
    pub inertia: Vec<f64>,
    /// k_i, less what is compensated, in the units of `inertia` over time.
    damping: Vec<f64>,
}

impl<'r, const D: usize> Model<'r, D> {
    /// Nothing where the world has no velocity alignment or no pair potential.
    pub fn of(run: &'r Run<'r, D>) -> Option<Self> {
        let world = run.world;
        let mut laws = world.laws().enumerate();
        let (index, alignment) = laws.find_map(|(index, (_, law))| match law {
            LawSpec::Alignment(law) => Some((index, law)),
            _ => None,
        })?;
        let force = world.laws().find_map(|(_, law)| match law {
            LawSpec::PairPotential(law) => Some(law),
            _ => None,
        })?;
        let masses = &world.agents.mass;
        let inertia = match alignment.acts_as {
            ActsAs::Force => masses.clone(),
            ActsAs::Acceleration => vec![1.0; masses.len()],
        };
        let damping = damping_rates(world).into_iter().zip(&inertia);
        Some(Self {
            damping: damping.map(|(rate, inertia)| rate * inertia).collect(),
            run,
            alignment,
            index,
            force,
            inertia,
        })
    }

    /// Supposes what all of the paper's theorems do, of the control and of the damping.
    pub fn suppose(&self, judging: &mut Judging, damping: Damping) {
        let world = self.run.world;
        let (alignment, force) = (self.alignment, self.force);
        judging.suppose("there are two agents or more", world.agents.len() > 1);
        judging.suppose(
            "the control is (6), whose terms are forces, or (15), whose terms are accelerations",
            alignment.acts_as == force.acts_as,
        );
        judging.suppose(
            "the velocity neighbours and their weights never change",
            is_fixed(alignment),
        );
        judging.suppose(
            "the potentials of all pairs are summed",
            force.share == Share::Sum && force.range.is_none(),
        );
        judging.suppose(
            "the potential of a pair grows without bound as it meets and as it parts",
            matches!(force.potential, Potential::Logarithmic { attraction, .. } if attraction > 0.0),
        );
        judging.suppose("no other forces act", self.is_alone());
        let largest = damping_scale(world);
        match damping {
            Damping::None => judging.suppose(
                "there is no damping, or it is compensated",
                self.is_undamped(),
            ),
            Damping::All => judging.suppose(
                "velocities of all agents are damped: k_i > 0",
                self.damping.iter().all(|k| *k > 1e-12 * largest),
            ),
            Damping::Any => judging.suppose(
                "no agent is driven: k_i ≥ 0",
                self.damping.iter().all(|k| *k >= -1e-12 * largest),
            ),
        }
    }

    /// Supposes the weight balance condition.
    pub fn suppose_balance(&self, judging: &mut Judging) {
        let weights = self.weights(self.run.start());
        let largest = weights.out_degrees().into_iter().fold(0.0, f64::max);
        let imbalance = weights.imbalance();
        judging.suppose_less(
            "the weights are balanced: Σ_j w_ij = Σ_j w_ji",
            imbalance,
            // Rounding of sums of weights, gains and masses.
            1e-9 * largest.max(f64::MIN_POSITIVE),
        );
    }

    /// Supposes Assumption 2.
    pub fn suppose_connection(&self, judging: &mut Judging) {
        let weights = self.weights(self.run.start());
        judging.suppose(
            "the velocity neighbouring graph is weakly connected",
            weights.partition().is_flock(),
        );
    }

    /// Whether there is no damping, or all of it is compensated.
    pub fn is_undamped(&self) -> bool {
        let largest = damping_scale(self.run.world);
        self.damping.iter().all(|k| k.abs() <= 1e-12 * largest)
    }

    fn is_alone(&self) -> bool {
        let world = self.run.world;
        let count = |is: fn(&LawSpec) -> bool| world.laws().filter(|(_, law)| is(law)).count();
        let ours = |law: &LawSpec| match law {
            LawSpec::Alignment(_) | LawSpec::PairPotential(_) => true,
            LawSpec::Friction(law) | LawSpec::FrictionCompensation(law) => is_linear(law),
            _ => false,
        };
        world
            .laws()
            .all(|(scope, law)| scope.is_none() && ours(law))
            && count(|law| matches!(law, LawSpec::Alignment(_))) == 1
            && count(|law| matches!(law, LawSpec::PairPotential(_))) == 1
            && world.gravity.norm() == 0.0
    }

    /// The coefficients w_ij of the control as it acts in a state.
    pub fn weights(&self, seen: &Observation<D>) -> Adjacency {
        let mut rows = vec![Vec::new(); self.inertia.len()];
        if let Some(aligned) = &seen.alignments[self.index] {
            let agents = aligned.influences.agents();
            for (row, &i) in agents.iter().enumerate() {
                let factor = self.inertia[i] * aligned.gains[row];
                let entries = agents.iter().enumerate();
                let entries = entries.map(|(k, &j)| (j, factor * aligned.matrix()[(row, k)]));
                rows[i] = entries.collect();
            }
        }
        Adjacency::new(rows)
    }

    /// The Laplacian L of (10).
    pub fn laplacian(&self) -> DMatrix<f64> {
        self.weights(self.run.start()).laplacian()
    }

    /// Potential of one pair.
    pub fn potential(&self) -> Potential {
        self.force.potential
    }

    /// The least potential of a pair, and the distance at which it has it.
    pub fn least(&self) -> Option<(f64, f64)> {
        match self.force.potential {
            Potential::Logarithmic {
                attraction,
                repulsion,
            } if attraction > 0.0 => {
                let distance = (repulsion / attraction).sqrt();
                Some((self.force.potential.value(distance), distance))
            }
            _ => None,
        }
    }

    /// The most by which others draw an agent in a state, Σ_j 2a/r_ij: the size of what cancels in
    /// the forces on it.
    pub fn largest_pull(&self, seen: &Observation<D>) -> f64 {
        let Potential::Logarithmic { attraction, .. } = self.force.potential else {
            return 0.0;
        };
        let pull = |x: &Vector<D>| -> f64 {
            let distances = seen.positions.iter().map(|y| (x - y).norm());
            let others = distances.filter(|distance| *distance > 0.0);
            others.map(|distance| 2.0 * attraction / distance).sum()
        };
        seen.positions.iter().map(pull).fold(0.0, f64::max)
    }

    /// Number of pairs.
    pub fn pairs(&self) -> f64 {
        let agents = self.inertia.len() as f64;
        0.5 * agents * (agents - 1.0)
    }

    /// The velocity that the control keeps: that of the centre of mass, Theorem 2, or the
    /// average with (15), Remark 5.
    pub fn kept_velocity(&self, seen: &Observation<D>) -> Vector<D> {
        center_of_mass(&self.inertia, &seen.velocities)
    }

    /// Velocities less that one, e_v.
    pub fn errors(&self, seen: &Observation<D>) -> Vec<Vector<D>> {
        let kept = self.kept_velocity(seen);
        seen.velocities.iter().map(|v| v - kept).collect()
    }

    /// J of velocities seen from somewhere: their energy and the potential of all pairs.
    pub fn energy(&self, seen: &Observation<D>, velocities: &[Vector<D>]) -> f64 {
        // An infinite potential has no record.
        let potential = seen.laws.potential.unwrap_or(f64::INFINITY);
        kinetic_energy(&self.inertia, velocities) + potential
    }

    /// dJ/dt by velocities and accelerations, and the size of the powers that make it up.
    pub fn power(&self, seen: &Observation<D>, velocities: &[Vector<D>]) -> (f64, f64) {
        let gradient = gradient(self.potential(), &seen.positions);
        let (mut sum, mut size) = (0.0, 0.0);
        for (i, a) in seen.accelerations.iter().enumerate() {
            let kinetic = self.inertia[i] * velocities[i].dot(a);
            let potential = gradient[i].dot(&velocities[i]);
            sum += kinetic + potential;
            size += kinetic.abs() + potential.abs();
        }
        (sum, size)
    }

    /// −½ vᵀ((L + Lᵀ) ⊗ I)v less the power of the damping: what (9) and the proof of Theorem 3
    /// say that dJ/dt is.
    pub fn dissipation(&self, laplacian: &DMatrix<f64>, velocities: &[Vector<D>]) -> f64 {
        let mut sum = 0.0;
        for (i, v) in velocities.iter().enumerate() {
            for (j, w) in velocities.iter().enumerate() {
                sum -= laplacian[(i, j)] * v.dot(w);
            }
            sum -= self.damping[i] * v.norm_squared();
        }
        sum
    }

    /// Slack of an energy J, as seen from a velocity.
    pub fn energy_slack(&self, seen: &Observation<D>, energy: f64, center: &Vector<D>) -> f64 {
        let kinetic = kinetic_energy(&self.inertia, &seen.velocities);
        let scale = energy.abs().max(kinetic);
        self.run
            .energy_slack(seen, scale, center, |i| self.inertia[i])
    }
}

/// The gradient of the potential of all pairs with respect to each position.
pub(super) fn gradient<const D: usize>(
    potential: Potential,
    positions: &[Vector<D>],
) -> Vec<Vector<D>> {
    let mut gradient = vec![Vector::zeros(); positions.len()];
    for (i, x) in positions.iter().enumerate() {
        for (j, y) in positions.iter().enumerate().skip(i + 1) {
            let offset = x - y;
            let slope = offset * potential.force_over_distance(offset.norm_squared());
            gradient[i] -= slope;
            gradient[j] += slope;
        }
    }
    gradient
}

fn is_fixed(law: &AlignmentSpec) -> bool {
    let constant = matches!(law.kernel, KernelSpec::Constant { .. })
        && matches!(law.gain, GainSpec::Constant(_));
    let nobody_moves_it = law.range.is_none()
        && law.orientation.is_none()
        && law.masking.is_none()
        && law.line_of_sight.is_none();
    constant && nobody_moves_it && !matches!(law.graph, Some(GraphSpec::OpenLoop(_)))
}

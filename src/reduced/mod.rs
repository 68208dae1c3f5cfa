//! The reduced model of fast flocking.
//!
//! Where agents align within a time of order ε and all else takes a time of order 1, all soon
//! have one velocity v^f, and go on with it side by side. G. A. Djokam and M. Rathinam, "A
//! generalized model of flocking with steering", section 4: the family (4.1),
//! v̇_i = ξ_i(u_i)u_i/ε + η_i with u_i = Σ_j a_ij (v_j − v_i), has the leading order (4.19),
//!
//! ẋ_i = v^f, v̇^f = Σ_j π_j η_j(x_j, v^f, t), where πQ = 0, Σπ_j = 1 and q_ij = ξ_i(0) a_ij.
//!
//! It starts where the transient layer (4.23) ends. The paper's (4.25) has v^f(0) = Σπ_i v_i(0),
//! which holds where the gain ξ does not fall with |u|. Otherwise Σπ_i V_i is not conserved in
//! the layer, and its end has to be computed: both are given here.

mod chain;
mod coupling;
mod layer;
mod leading;

pub use chain::stationary;
pub use leading::{Leading, write_leading};

use nalgebra::DMatrix;

use crate::law::{Field, Law, build_where};
use crate::math::{Stuck, Vector};
use crate::world::World;
use crate::world::spec::LawSpec;
use coupling::Coupling;

/// The most agents of a reduced model; its work grows with the cube of their number.
pub const MOST_AGENTS: usize = 1000;

/// The reduced model of fast flocking of a world; see the module.
pub struct FastFlocking<'w, const D: usize> {
    world: &'w World<D>,
    aligning: Field<'w, D>,
    others: Field<'w, D>,
    /// P: the influence a_ij of agent j on agent i at the start, a_ii included, (4.7).
    pub influences: DMatrix<f64>,
    /// Q: the rates ξ_i(0)a_ij, and on the diagonal minus the sum of the others of the row,
    /// below (4.13); ε and masses divide them where the law has it so.
    pub rates: DMatrix<f64>,
    /// π: the share of each agent in the flock's velocity. Those that influence nobody who
    /// counts have none.
    pub weights: Vec<f64>,
    /// v^f(0) = Σπ_i v_i(0), as printed in (4.25).
    pub printed: Vector<D>,
    /// v^f(0) as the limit of the transient layer (4.23), from which the leading order starts.
    pub start: Vector<D>,
}

/// Why a world has no reduced model.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum NoReduction {
    /// There must be one law that aligns.
    #[error("the reduced model is that of one alignment law, and the world has {found}")]
    Laws {
        /// How many there are.
        found: usize,
    },
    /// Flatness makes up for the alignment itself, and so is as fast.
    #[error(
        "a flatness law steers as fast as the agents align: there is nothing slow to reduce to"
    )]
    Flatness,
    /// What agents perceive must be a smooth function of the state now.
    #[error(
        "agents perceive with delay, noise or dropout, which the reduced model leaves no room for"
    )]
    Perception,
    /// Too many for matrices of all pairs.
    #[error("the world has {agents} agents; a reduced model has at most {MOST_AGENTS}")]
    TooMany {
        /// How many there are.
        agents: usize,
    },
    /// There is no one velocity that all come to.
    #[error("there is no one flock: parts of the agents are influenced by no other part")]
    Parts,
    /// The layer takes for ever.
    #[error(
        "the agents do not come to one velocity within {steps} steps of the layer's integration; \
         gains that are bounded with a very small scale make it stiff"
    )]
    Endless {
        /// The steps taken.
        steps: usize,
    },
    /// The numbers leave what can be computed with.
    #[error(transparent)]
    Stuck(#[from] Stuck),
}

impl<'w, const D: usize> FastFlocking<'w, D> {
    /// The reduced model of a world with exactly one alignment law.
    ///
    /// # Errors
    /// Where there is none.
    pub fn new(world: &'w World<D>) -> Result<Self, NoReduction> {
        let aligns = |law: &LawSpec| matches!(law, LawSpec::Alignment(_));
        let found = world.laws().filter(|(_, law)| aligns(law)).count();
        if found != 1 {
            return Err(NoReduction::Laws { found });
        }
        if world
            .laws()
            .any(|(_, law)| matches!(law, LawSpec::Flatness(_)))
        {
            return Err(NoReduction::Flatness);
        }
        let others = build_where(world, |law| !aligns(law));
        Self::of_laws(world, build_where(world, aligns), others)
    }

    /// The reduced model of the agents of a world under laws of one's own: those that align,
    /// of which each agent obeys at most one, and the others.
    ///
    /// # Errors
    /// Where there is none.
    pub fn of_laws(
        world: &'w World<D>,
        aligning: Vec<Box<dyn Law<D>>>,
        others: Vec<Box<dyn Law<D>>>,
    ) -> Result<Self, NoReduction> {
        let agents = &world.agents;
        if agents.len() > MOST_AGENTS {
            return Err(NoReduction::TooMany {
                agents: agents.len(),
            });
        }
        let mut senses = world
            .spec
            .agents
            .iter()
            .filter_map(|it| it.sensing.as_ref());
        let plain = crate::world::spec::NoiseSpec::default();
        if senses.any(|it| it.delay > 0.0 || it.dropout > 0.0 || it.noise != plain) {
            return Err(NoReduction::Perception);
        }
        let mut aligning = Field::new(world, aligning);
        let coupling = Coupling::of(&mut aligning, 0.0, &agents.positions, &agents.velocities);
        let rates = coupling.rates();
        let weights = stationary(&rates).ok_or(NoReduction::Parts)?;
        let printed = weighted(&weights, &agents.velocities);
        let start = layer::limit(
            &mut aligning,
            &agents.positions,
            &agents.velocities,
            &weights,
        )?;
        Ok(Self {
            world,
            aligning,
            others: Field::new(world, others),
            influences: coupling.influences,
            rates,
            weights,
            printed,
            start,
        })
    }
}

/// Σ_i w_i z_i, summed in order.
fn weighted<const D: usize>(weights: &[f64], vectors: &[Vector<D>]) -> Vector<D> {
    let terms = weights.iter().zip(vectors);
    terms.map(|(weight, vector)| vector * *weight).sum()
}

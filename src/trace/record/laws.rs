//! What a frame may record of its laws.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What the laws' own quantities are in one state: energies, centres, and what each law is
/// about.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct LawsRecord {
    /// Mean of the positions, x_c; Song et al. (2013), (9).
    pub mean_position: Vec<f64>,
    /// Mean of the velocities, v_c; Song et al. (2013), (9).
    pub mean_velocity: Vec<f64>,
    /// Centre of mass, x*; Shi, Wang & Chu.
    pub mass_center: Vec<f64>,
    /// Velocity of the centre of mass, v*; Shi, Wang & Chu.
    pub mass_velocity: Vec<f64>,
    /// E = max ½|v_i|²; Djokam & Rathinam, Lemma 1.
    pub largest_kinetic_energy: f64,
    /// Sum of the potentials of all pair potentials among the laws, each pair counted once; 0
    /// without any, null where it is infinite.
    pub potential: Option<f64>,
    /// W = ½ Σ |v_i − v_c|² + potential; Song et al. (2013), (12) and (19).
    pub energy: Option<f64>,
    /// J = ½ Σ m_i |v_i|² + potential; Shi, Wang & Chu.
    pub total_energy: Option<f64>,
    /// d_β: largest difference between the accelerations by which two agents steer, of
    /// navigation, tracking, steering and flatness together; Djokam & Rathinam, (3.3).
    pub steering_diameter: f64,
    /// The laws, in the order of the world, those inside scopes in the place of the scope.
    pub laws: Vec<LawRecord>,
}

/// What one law is about. Only the fields that it has something to say in are there.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
pub struct LawRecord {
    /// Name of the law.
    pub law: String,
    /// Potential of a pair potential, each pair counted once; absent where it is infinite.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub potential: Option<f64>,
    /// Largest distance of an agent from the line or sphere of a pattern.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub residual: Option<f64>,
    /// Largest distance of an agent from its target.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub position_error: Option<f64>,
    /// Largest difference between an agent's velocity and that of its target.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub velocity_error: Option<f64>,
    /// The influences of an alignment law.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub influence: Option<InfluenceRecord>,
}

/// The influences a_ij of an alignment law in one state.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct InfluenceRecord {
    /// The least influence of any agent on any agent, itself included: the largest θ for which
    /// all agents are in the global active set.
    pub least: f64,
    /// λ(θ), the number of agents whose influence on everyone is at least θ =
    /// `record.active_at`; Djokam & Rathinam, (3.4) and (3.5). Absent without a θ.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub active: Option<usize>,
    /// Largest difference between what an agent is influenced by all others and what it
    /// influences them; 0 where the weights are balanced. Shi, Wang & Chu.
    pub imbalance: f64,
    /// Second smallest eigenvalue λ2 of L + Lᵀ, with L the Laplacian of the influences; Shi,
    /// Wang & Chu, (18). Negative only where they are not balanced; null for one agent.
    pub connectivity: Option<f64>,
}

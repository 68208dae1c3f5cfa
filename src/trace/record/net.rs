//! The analysis of the net that a frame may record.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The analysis of the net that the world's first (α, α) interaction defines: agents at
/// most its range r apart are joined. Olfati-Saber (2003), §§2 to 9. "Nonsmooth" weighs
/// all edges with 1, "smooth" with a_ij = ρ(distance/r), whatever the protocol; null where
/// a state does not define a value, or it is too large to compute with.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
pub struct NetRecord {
    /// Edges, each counted once.
    pub edges: usize,
    /// Connected components.
    pub components: usize,
    /// Agents in the largest component.
    pub largest: usize,
    /// Agents in the smallest component.
    pub smallest: usize,
    /// Density δ0: share of agents in the largest component; (7). A flock has 1.
    pub density: f64,
    /// Smallest number of neighbours of an agent; (9).
    pub smallest_degree: usize,
    /// Largest number of neighbours of an agent; (9).
    pub largest_degree: usize,
    /// Whether in-degrees equal out-degrees; Proposition 1.
    pub balanced: bool,
    /// Algebraic connectivity λ2 of the nonsmooth Laplacian (11); null for one agent.
    pub algebraic_connectivity: Option<f64>,
    /// λ2 of the smooth Laplacian, (11) with (17).
    pub smooth_algebraic_connectivity: Option<f64>,
    /// Connectivity λ2/N, 0 to 1, of the nonsmooth net; SwarmLab (Soria et al. 2020).
    pub connectivity: Option<f64>,
    /// Nonsmooth structural potential V; (28).
    pub potential: Option<f64>,
    /// Smooth structural potential V; (30) with (17).
    pub smooth_potential: Option<f64>,
    /// Structural energy H_s with the nonsmooth potential; (27).
    pub structural_energy: Option<f64>,
    /// Structural energy H_s with the smooth potential; (27).
    pub smooth_structural_energy: Option<f64>,
    /// Length |∇V| of the nonsmooth potential's gradient.
    pub gradient: Option<f64>,
    /// Length |∇V| of the smooth potential's gradient.
    pub smooth_gradient: Option<f64>,
    /// Defect factor μ of the nonsmooth potential with weight w = 1; (46).
    pub defect: Option<f64>,
    /// Normalised defect factor μ_n = μ/(|E| h0); (47). Null without edges.
    pub normalised_defect: Option<f64>,
    /// Largest | |q_j − q_i| − d_α | over the edges, 0 without edges; (20).
    pub realisation_error: Option<f64>,
    /// Whether the framework of the edges is infinitesimally rigid.
    pub rigid: bool,
    /// Degrees of freedom that the edges leave besides those of a rigid body.
    pub freedoms: usize,
    /// Whether the net is planar as an abstract graph.
    pub planar: bool,
    /// Pairs of edges that cross as drawn; null in space.
    pub crossings: Option<usize>,
    /// Agents whose neighbours vote for coming closer, S_i > 0; (41).
    pub positive_votes: usize,
    /// Agents whose neighbours vote against, S_i < 0; (42).
    pub negative_votes: usize,
    /// Agents whose neighbours' votes cancel, S_i = 0 (45), or that have none.
    pub zero_votes: usize,
    /// Edges that were not there in the frame before; null in the first frame.
    pub links_created: Option<usize>,
    /// Edges of the frame before that are gone; null in the first frame.
    pub links_lost: Option<usize>,
    /// Energy h0 = ψ_α(r − d_α) by which the nonsmooth energy jumps with each link; (31).
    pub link_energy: Option<f64>,
}

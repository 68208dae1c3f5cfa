//! The analysis of the net that a frame may carry.

use serde::{Deserialize, Serialize};

use crate::dynamics::Snapshot;
use crate::math::{AlphaPair, Bump, Fade, Vector};
use crate::metric::computable;
use crate::net::{
    Adjacency, LinkChanges, Net, Rigidity, Verdict, algebraic_connectivity, crossings, defect,
    is_planar, link_energy, neighborhood, normalised_defect, potential_gradient, realisation_error,
    structural_energy, structural_potential, votes,
};
use crate::trace::record::NetRecord;
use crate::world::World;

/// The weight w of the defect factor, Olfati-Saber (2003), (46), which names none.
const DEFECT_WEIGHT: f64 = 1.0;

/// Analyses the net of a world state by state, and remembers the last one for the links
/// that come and go.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct NetAnalysis {
    before: Option<Net>,
}

impl NetAnalysis {
    /// The record of this state; `None` in a world without an (α, α) interaction, which
    /// defines the net.
    ///
    /// Connectivity and rigidity are cubic in the number of agents: a few hundred are fine.
    pub fn record<const D: usize>(
        &mut self,
        world: &World<D>,
        state: &Snapshot<'_, D>,
    ) -> Option<NetRecord> {
        let alpha = world.alpha_interaction()?;
        let net = Net::new(state.positions, alpha.range);
        let bump = Bump::new(alpha.bump_start);
        let mut record = analyse(state, &net, &alpha.pair(), bump);
        if let Some(before) = &self.before {
            let changes = LinkChanges::between(before, &net);
            record.links_created = Some(changes.created.len());
            record.links_lost = Some(changes.lost.len());
        }
        self.before = Some(net);
        Some(record)
    }
}

fn analyse<const D: usize>(
    state: &Snapshot<'_, D>,
    net: &Net,
    pair: &AlphaPair,
    bump: Bump,
) -> NetRecord {
    let faded = |fade| AlphaPair { fade, ..*pair };
    let (sharp, smooth) = (&faded(Fade::Sharp), &faded(Fade::Smooth(bump)));
    let (positions, velocities) = (state.positions, state.velocities);
    let adjacency = Adjacency::from(net);
    let parts = net.partition();
    let degrees = net.degrees();
    let rigidity = Rigidity::new(positions, net);
    let connectivity = algebraic_connectivity(&adjacency);
    let weighted = neighborhood::smooth(positions, pair.range, &bump);
    let verdicts: Vec<Verdict> = votes(positions, &adjacency, sharp)
        .iter()
        .map(|vote| vote.verdict())
        .collect();
    let count = |verdict| verdicts.iter().filter(|&&v| v == verdict).count();
    let gradient_norm = |pair| {
        potential_gradient(positions, net, pair)
            .iter()
            .map(Vector::norm_squared)
            .sum::<f64>()
            .sqrt()
    };
    NetRecord {
        edges: net.edges().len(),
        components: parts.count(),
        largest: parts.largest(),
        smallest: parts.smallest(),
        density: parts.density(),
        smallest_degree: degrees.iter().copied().min().unwrap_or(0),
        largest_degree: degrees.iter().copied().max().unwrap_or(0),
        balanced: adjacency.is_balanced(),
        algebraic_connectivity: connectivity,
        smooth_algebraic_connectivity: algebraic_connectivity(&weighted),
        connectivity: connectivity.map(|value| value / positions.len() as f64),
        potential: computable(structural_potential(positions, net, sharp)),
        smooth_potential: computable(structural_potential(positions, net, smooth)),
        structural_energy: computable(structural_energy(positions, velocities, net, sharp)),
        smooth_structural_energy: computable(structural_energy(positions, velocities, net, smooth)),
        gradient: computable(gradient_norm(sharp)),
        smooth_gradient: computable(gradient_norm(smooth)),
        defect: computable(defect(positions, net, sharp, DEFECT_WEIGHT)),
        normalised_defect: normalised_defect(positions, net, sharp, DEFECT_WEIGHT)
            .and_then(computable),
        realisation_error: computable(realisation_error(positions, net, sharp.spacing)),
        rigid: rigidity.is_rigid(),
        freedoms: rigidity.freedoms(),
        planar: is_planar(net),
        crossings: plane(positions).map(|plane| crossings(&plane, net)),
        positive_votes: count(Verdict::Positive),
        negative_votes: count(Verdict::Negative),
        zero_votes: count(Verdict::Zero),
        links_created: None,
        links_lost: None,
        link_energy: computable(link_energy(sharp)),
    }
}

/// The positions as points of the plane, where the world is one.
fn plane<const D: usize>(positions: &[Vector<D>]) -> Option<Vec<Vector<2>>> {
    let point = |q: &Vector<D>| Vector::<2>::new(q[0], q[1]);
    (D == 2).then(|| positions.iter().map(point).collect())
}

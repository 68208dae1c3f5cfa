//! Uniform nets are balanced, Proposition 1.

use crate::claim::{About, Bound, Claim, Finding, Judging, Reading, Run, Side};
use crate::math::Vector;
use crate::net::neighborhood;
use crate::world::World;
use crate::world::spec::{LawSpec, PerAgent, SensingSpec};

const BALANCED: About = About {
    name: "olfati-saber-2003/uniform-nets-are-balanced",
    source: "Olfati-Saber (2003), Proposition 1",
    reading: Reading::Printed,
    statement: "A uniform net is balanced: as many see an agent as it sees. A net is balanced if and \
                only if 1ᵀL = 0.",
    hypotheses: "The net that the agents' own radii induce, (1) to (3), is uniform: all radii are \
                 equal, and neighbourhoods spherical.",
    measured: "In every observation, the largest |deg_in − deg_out|, and the largest entry of 1ᵀL.",
    tolerance: "None: degrees are whole numbers.",
};

/// Proposition 1.
pub(super) struct Balanced;

impl<const D: usize> Claim<D> for Balanced {
    fn about(&self) -> &'static About {
        &BALANCED
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let world = run.world;
        let mut ranges = world.laws().filter_map(|(_, law)| match law {
            LawSpec::AlphaInteraction(law) => Some(law.range),
            LawSpec::HeadingConsensus(law) => Some(law.range),
            _ => None,
        });
        let range = ranges.next()?;
        let mut judging = Judging::of_states();
        let radii = radii(world, range);
        judging.suppose(
            "the net is uniform: all radii are equal",
            radii.windows(2).all(|two| two[0] == two[1]),
        );
        judging.suppose("neighbourhoods are spherical", is_spherical(world));
        let net = |positions: &[Vector<D>]| neighborhood::shells(positions, &radii);
        let mut nets = run.observations.iter().map(|seen| net(&seen.positions));
        judging.suppose("some agents are neighbours", nets.any(|net| net.arcs() > 0));
        let imbalance = run.series(|seen| net(&seen.positions).imbalance());
        let sums = run.series(|seen| {
            let laplacian = net(&seen.positions).laplacian();
            laplacian.row_sum().amax()
        });
        for (name, values) in [("max |deg_in − deg_out|", imbalance), ("max |1ᵀL|", sums)] {
            judging.bound(Bound {
                name,
                times: run.times(),
                bounds: vec![0.0; values.len()],
                slack: vec![0.0; values.len()],
                values,
                side: Side::Below,
                scale: 1.0,
            });
        }
        Some(judging.finding())
    }
}

/// The radius of each agent's neighbourhood.
fn radii<const D: usize>(world: &World<D>, range: f64) -> Vec<f64> {
    let mut radii = Vec::new();
    for group in &world.spec.agents {
        let count = group.count.unwrap_or(0);
        let radius = group.sensing.as_ref().and_then(|it| it.radius.as_ref());
        match radius {
            None => radii.extend(vec![range; count]),
            Some(PerAgent::All(radius)) => radii.extend(vec![radius.min(range); count]),
            Some(PerAgent::Each(each)) => radii.extend(each.iter().map(|it| it.min(range))),
        }
    }
    radii
}

/// Whether nothing but radii limits who sees whom.
fn is_spherical<const D: usize>(world: &World<D>) -> bool {
    let mut sensing = world
        .spec
        .agents
        .iter()
        .filter_map(|group| group.sensing.as_ref());
    sensing.all(|sensing| {
        let radius_alone = SensingSpec {
            radius: sensing.radius.clone(),
            ..Default::default()
        };
        *sensing == radius_alone
    })
}

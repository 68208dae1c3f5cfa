//! Starts at which so many agents are neighbours that what is recorded of them would fill the
//! memory.

use crate::world::agents::Agents;
use crate::world::limits::MOST_EDGES;
use crate::world::problem::Problem;
use crate::world::spec::{LawSpec, WorldSpec, each_law, each_path};
use crate::world::standing::Standing;
use crate::world::words::number;

/// Agents whose neighbours are counted; those of the others are taken to be as many.
const SAMPLE: usize = 1000;

/// What is wrong with a range that makes too many edges of the proximity net, which every frame
/// measures, or too many links, where these are recorded.
pub(super) fn too_many<const D: usize>(spec: &WorldSpec, agents: &Agents<D>) -> Option<Problem> {
    if agents.len().saturating_mul(agents.len()) / 2 <= MOST_EDGES {
        return None;
    }
    let laws = || each_law(&spec.laws).zip(each_path(&spec.laws));
    let net = laws().find_map(|((_, law), path)| match law {
        LawSpec::AlphaInteraction(law) => {
            Some((law.range, format!("{path}.alpha_interaction.range")))
        }
        _ => None,
    });
    if let Some((range, path)) = net {
        let edges = pairs_within(agents, range);
        if edges > MOST_EDGES as f64 {
            let what = format!("makes about {} edges of the proximity net", number(edges));
            let problem = Problem::new(path, what);
            return Some(problem.allowed(format!("at most {MOST_EDGES}")));
        }
    }
    let range = laws()
        .filter_map(|((_, law), _)| range(law))
        .fold(0.0, f64::max);
    if spec.record.links {
        let links = 2.0 * pairs_within(agents, range);
        if links > MOST_EDGES as f64 {
            let what = format!("records about {} links in a frame", number(links));
            let problem = Problem::new("record.links", what);
            return Some(problem.allowed(format!("at most {MOST_EDGES}")));
        }
    }
    None
}

/// How far a law looks for neighbours; nothing where it does not.
fn range(law: &LawSpec) -> Option<f64> {
    let or_all = |range: Option<f64>| Some(range.unwrap_or(f64::INFINITY));
    match law {
        LawSpec::AlphaInteraction(law) => Some(law.range),
        LawSpec::HeadingConsensus(law) => Some(law.range),
        LawSpec::Alignment(law) => or_all(law.range),
        LawSpec::PairPotential(law) => or_all(law.range),
        LawSpec::CuckerDong(law) => or_all(law.range),
        LawSpec::ParkBonding(law) => or_all(law.range),
        LawSpec::FirstOrderFlow(law) => or_all(law.range),
        _ => None,
    }
}

/// About how many pairs of agents are at most so far apart.
fn pairs_within<const D: usize>(agents: &Agents<D>, range: f64) -> f64 {
    let (count, all) = (agents.len(), agents.len() as f64);
    if range.is_infinite() {
        return 0.5 * all * (all - 1.0);
    }
    let mut standing = Standing::new(std::iter::once(range));
    for (i, at) in agents.positions.iter().enumerate() {
        standing.put(at, range, i);
    }
    let (mut looked, mut found) = (0, 0usize);
    // Spread over all agents by a step that is prime to few numbers of columns.
    for i in (0..count).step_by((count / SAMPLE).max(1) | 1) {
        looked += 1;
        let at = &agents.positions[i];
        let near = standing.near(at, range);
        let near = near.filter(|&&j| j != i && (agents.positions[j] - at).norm() <= range);
        found += near.count();
        // Enough to know, and looking on would take long.
        if found as f64 * all / SAMPLE as f64 > 4.0 * MOST_EDGES as f64 {
            break;
        }
    }
    0.5 * all * found as f64 / f64::from(looked)
}

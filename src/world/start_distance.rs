//! Starts at which a law is not defined.

use crate::world::agents::Agents;
use crate::world::problem::Problem;
use crate::world::spec::{LawSpec, WorldSpec, acting_on, each_law, each_path, seen_by};
use crate::world::standing::Standing;
use crate::world::words::number;

/// The pairs that start nearer than a law of Cucker & Dong allows, one for each law: those of
/// an agent that the law acts on and another that it sees.
pub(super) fn too_near<const D: usize>(spec: &WorldSpec, agents: &Agents<D>) -> Vec<Problem> {
    let mut found = Vec::new();
    for ((scope, law), path) in each_law(&spec.laws).zip(each_path(&spec.laws)) {
        let LawSpec::CuckerDong(law) = law else {
            continue;
        };
        let (acts, sees) = (acting_on(scope, &spec.agents), seen_by(scope, &spec.agents));
        let pushes = |a: usize, b: usize| acts[agents.group[a]] && sees[agents.group[b]];
        // A hair more, for roots round.
        let room = law.squared_distance.sqrt() * (1.0 + 1e-9);
        let mut standing = Standing::new(std::iter::once(room));
        let first = (0..agents.len()).find_map(|b| {
            let at = &agents.positions[b];
            let near = standing.near(at, room).copied().filter_map(|a: usize| {
                let squared = (agents.positions[a] - at).norm_squared();
                let bad = squared <= law.squared_distance && (pushes(a, b) || pushes(b, a));
                bad.then_some((a, b, squared))
            });
            let first = near.min_by_key(|pair| pair.0);
            standing.put(at, room, b);
            first
        });
        if let Some((a, b, squared)) = first {
            let squared = number(squared);
            let what = format!(
                "must be less than {squared}, the squared distance of agents {a} and {b} at the start"
            );
            let path = format!("{path}.cucker_dong.squared_distance");
            let hint = "agents farther apart, or a smaller squared distance";
            found.push(Problem::new(path, what).hint(hint));
        }
    }
    found
}

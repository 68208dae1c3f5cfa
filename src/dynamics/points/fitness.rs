//! Which worlds have points.

use crate::dynamics::Failure;
use crate::world::World;

/// Refuses a world that asks for what points do not have, by the first such field.
pub(super) fn check<const D: usize>(world: &World<D>) -> Result<(), Failure> {
    for (index, group) in world.spec.agents.iter().enumerate() {
        let sensing = group.sensing.as_ref();
        let delay = sensing.is_some_and(|it| it.delay > 0.0);
        let noise = sensing.is_some_and(|it| it.noise.position > 0.0 || it.noise.velocity > 0.0);
        let dropout = sensing.is_some_and(|it| it.dropout > 0.0);
        let problems = [
            (!group.is_round(), "shape", "have no attitude"),
            (
                group.force_rate_limit.is_some(),
                "force_rate_limit",
                "remember no earlier force",
            ),
            (
                group.top_speed.is_some(),
                "top_speed",
                "are held back by nothing but forces",
            ),
            (delay, "sensing.delay", "remember no past"),
            (
                noise,
                "sensing.noise",
                "follow equations without random errors",
            ),
            (
                dropout,
                "sensing.dropout",
                "follow equations without random losses",
            ),
        ];
        if let Some((_, field, why)) = problems.into_iter().find(|(found, ..)| *found) {
            return Err(Failure::NotForPoints {
                field: format!("agents[{index}].{field}"),
                why,
            });
        }
    }
    Ok(())
}

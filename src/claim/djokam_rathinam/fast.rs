//! The family (4.1) that a world is of: the same with other ε.

use super::closed_loop::ClosedLoop;
use super::model::Model;
use super::spread::velocity_spread;
use crate::claim::{Judging, Run};
use crate::metric::Observation;
use crate::reduced::FastFlocking;
use crate::world::World;
use crate::world::spec::{AlignmentSpec, LawSpec, Steered};

/// The ε of the runs that are compared, over that of the world.
const SHARES: [f64; 2] = [0.316_227_766_016_837_94, 0.1];

/// Velocities agree, the layer is over, where d_V is this share of its start.
const AGREED: f64 = 0.01;

/// One run of the family.
pub(super) struct Member<'a, const D: usize> {
    pub epsilon: f64,
    pub world: &'a World<D>,
    pub seen: &'a [Observation<D>],
}

/// Whether a world is of such a family: one alignment law, with an ε below 1.
pub(super) fn is_fast<const D: usize>(world: &World<D>) -> bool {
    let laws = world.laws().filter_map(|(_, law)| match law {
        LawSpec::Alignment(law) => Some(law.epsilon),
        _ => None,
    });
    let epsilons: Vec<f64> = laws.collect();
    matches!(epsilons[..], [epsilon] if epsilon < 1.0)
}

/// The world with smaller ε.
pub(super) fn companions<const D: usize>(world: &World<D>) -> Vec<World<D>> {
    let shares = SHARES.iter().filter(|_| is_fast(world));
    let with = |share: &f64| {
        let mut world = world.clone();
        let divide = |law: &mut AlignmentSpec| law.epsilon *= share;
        for law in &mut world.spec.laws {
            match law {
                LawSpec::Alignment(law) => divide(law),
                LawSpec::Scope(scope) => scope.laws.iter_mut().for_each(|law| {
                    if let LawSpec::Alignment(law) = law {
                        divide(law);
                    }
                }),
                _ => {}
            }
        }
        world
    };
    shares.map(with).collect()
}

/// The family, from the largest ε on, where all its runs are there.
pub(super) fn family<'a, const D: usize>(
    run: &'a Run<'_, D>,
    claim: &str,
) -> Option<Vec<Member<'a, D>>> {
    let member = |world: &'a World<D>, seen: &'a [Observation<D>]| {
        let epsilon = world.laws().find_map(|(_, law)| match law {
            LawSpec::Alignment(law) => Some(law.epsilon),
            _ => None,
        })?;
        Some(Member {
            epsilon,
            world,
            seen,
        })
    };
    let mut family = vec![member(run.world, &run.observations)?];
    for (world, seen) in run.companions(claim) {
        family.push(member(world, seen)?);
    }
    // A companion that contacts cut short cannot be compared.
    let whole = family
        .iter()
        .all(|it| it.seen.len() == run.observations.len());
    (whole && family.len() > SHARES.len()).then_some(family)
}

/// Supposes (4.1) with steering (4.16), and that there is one flock to come to.
pub(super) fn suppose<const D: usize>(judging: &mut Judging, run: &Run<'_, D>) {
    let Some(model) = Model::of(run) else { return };
    ClosedLoop::suppose(judging, run, &model, true);
    let own = run.world.laws().all(|(_, law)| match law {
        LawSpec::Flatness(_) => false,
        LawSpec::Navigation(law) => law.steer == Steered::Agent,
        _ => true,
    });
    judging.suppose(
        "each agent steers by its own state and the time, (4.16)",
        own,
    );
    let blind = model.law.orientation.is_none();
    judging.suppose("influences depend on positions alone", blind);
    let differ = velocity_spread(run.start()).length > 0.0;
    judging.suppose("velocities differ at the start", differ);
    if judging.is_supposed() {
        let reduced = FastFlocking::new(run.world).is_ok();
        judging.suppose("the layer (4.23) comes to one velocity", reduced);
    }
}

/// The first observation at which velocities agree.
pub(super) fn agreed<const D: usize>(seen: &[Observation<D>]) -> Option<usize> {
    let start = velocity_spread(seen.first()?).length;
    seen.iter()
        .position(|seen| velocity_spread(seen).length <= AGREED * start)
}

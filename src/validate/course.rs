//! From a world to a run that claims can judge.

use std::convert::Infallible;

use crate::claim::{MovedBy, Run, closer};
use crate::dynamics::{Accuracy, Dynamics, Engine, Failure};
use crate::law::Field;
use crate::metric::Observation;
use crate::shape::In;
use crate::simulation::{Pause, Simulation};
use crate::trace::record::Record;
use crate::world::World;

/// How near two agents come to each other as points in the two steps from a time on: the engine
/// may feel a contact up to a step before the surfaces meet.
///
/// # Errors
/// Where the run cannot begin or go on.
pub fn least_distance<const D: usize>(
    world: &World<D>,
    accuracy: Accuracy,
    [i, j]: [usize; 2],
    from: f64,
) -> Result<f64, Failure>
where
    In<D>: Engine<D>,
{
    let dynamics = Dynamics::Points(accuracy);
    let mut simulation = Simulation::with_dynamics(world.clone(), Vec::new(), dynamics)?;
    let mut least = f64::INFINITY;
    let step = world.spec.time.step;
    while simulation.snapshot().time < from + 2.5 * step {
        let state = simulation.snapshot();
        if state.time > from - 0.5 * step {
            least = least.min((state.positions[i] - state.positions[j]).norm());
        }
        simulation.step()?;
    }
    Ok(least)
}

/// Runs a world to its end and looks at it whenever it records a frame. Of bodies, what is
/// seen from the first contact on is kept apart.
///
/// # Errors
/// Where the run cannot begin or go on.
pub fn course<const D: usize>(world: &World<D>, dynamics: Dynamics) -> Result<Run<'_, D>, Failure>
where
    In<D>: Engine<D>,
{
    let mut simulation = Simulation::with_dynamics(world.clone(), Vec::new(), dynamics)?;
    let mut field = Field::of_world(world);
    let moved_by = match dynamics {
        Dynamics::Points(Accuracy { relative }) => MovedBy::Points { relative },
        Dynamics::Bodies => MovedBy::Bodies {
            step: world.spec.time.step,
        },
    };
    let mut run = Run::of_states(world, moved_by, []);
    if let Some(solver) = simulation.solver() {
        run.method = format!("{} of order {}, {moved_by}", solver.method, solver.order);
    }
    let mut contacts = Vec::new();
    loop {
        let state = simulation.snapshot();
        let closest = match run.first_contact {
            None => &mut run.closest,
            Some(_) => &mut run.closest_after_contact,
        };
        *closest = closer(*closest, state.time, state.positions);
        let over = state.step >= world.steps();
        if over || state.step.is_multiple_of(world.frame_steps()) {
            let (x, v) = (state.positions.to_vec(), state.velocities.to_vec());
            let seen = Observation::new(&mut field, state.time, x, v);
            match run.first_contact {
                None => run.observations.push(seen),
                Some(_) => run.after_contact.push(seen),
            }
        }
        if over {
            break;
        }
        let begin = simulation.snapshot().time;
        contacts.extend(simulation.step()?);
        let ledger = simulation.ledger();
        let episodes = ledger.agent_contacts().episodes + ledger.obstacle_contacts().episodes;
        if episodes > 0 {
            run.first_contact.get_or_insert(begin);
        }
    }
    let end = simulation.finish(Pause::Reached, &mut |record| {
        if let Record::Contact(contact) = record {
            contacts.push(contact);
        }
        Ok::<_, Infallible>(())
    });
    let Ok(_) = end;
    contacts.sort_by(|a, b| a.begin.total_cmp(&b.begin));
    run.contacts = contacts;
    Ok(run)
}

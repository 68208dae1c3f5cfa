//! From a world to a run that claims can judge.

use std::convert::Infallible;

use crate::claim::{Closest, MovedBy, Run, closer, closer_between};
use crate::dynamics::{Accuracy, Dynamics, Engine, Failure};
use crate::law::Field;
use crate::math::Vector;
use crate::metric::Observation;
use crate::shape::In;
use crate::simulation::{Pause, Simulation};
use crate::trace::record::Record;
use crate::world::World;

/// How near two agents come to each other as points within a step of some time: bodies are where
/// points are to the order of the step.
///
/// # Errors
/// Where the run cannot begin or go on.
pub fn least_distance<const D: usize>(
    world: &World<D>,
    accuracy: Accuracy,
    [i, j]: [usize; 2],
    about: f64,
) -> Result<f64, Failure>
where
    In<D>: Engine<D>,
{
    let dynamics = Dynamics::Points(accuracy);
    let mut simulation = Simulation::with_dynamics(world.clone(), Vec::new(), dynamics)?;
    let mut least: Option<Closest> = None;
    let step = world.spec.time.step;
    while simulation.snapshot().time < about + step {
        let (time, x, v) = pair(&simulation, [i, j]);
        simulation.step()?;
        let (end, next_x, next_v) = pair(&simulation, [i, j]);
        if end > about - step {
            least = closer_between(least, [time, end], [&x, &next_x], [&v, &next_v]);
        }
    }
    Ok(least.map_or(f64::INFINITY, |it| it.distance))
}

/// Time, positions and velocities of two agents.
fn pair<const D: usize>(
    simulation: &Simulation<D>,
    agents: [usize; 2],
) -> (f64, [Vector<D>; 2], [Vector<D>; 2]) {
    let state = simulation.snapshot();
    let of = |list: &[Vector<D>]| agents.map(|i| list[i]);
    (state.time, of(state.positions), of(state.velocities))
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
        let before = (
            state.time,
            state.positions.to_vec(),
            state.velocities.to_vec(),
        );
        contacts.extend(simulation.step()?);
        run.first_contact = simulation.ledger().first_contact();
        // A way on which bodies struck each other is none that a curve through its ends follows.
        if run.first_contact.is_none() {
            let (time, x, v) = before;
            let state = simulation.snapshot();
            let (times, x) = ([time, state.time], [&x[..], state.positions]);
            run.closest = closer_between(run.closest, times, x, [&v, state.velocities]);
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

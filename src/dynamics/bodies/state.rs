//! What bodies must know to go on: captured, and restored.

use serde::{Deserialize, Serialize};

use super::Bodies;
use crate::dynamics::attitude::Stances;
use crate::dynamics::contact::ContactsState;
use crate::dynamics::{Cuts, Engine, Unusable};
use crate::math::Vector;
use crate::shape::In;
use crate::world::World;

/// What bodies must know between two steps, besides their world, to go on bit for bit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BodiesState<const D: usize> {
    engine: Vec<u8>,
    step: u64,
    velocities: Vec<Vector<D>>,
    headings: Vec<Vector<D>>,
    stances: Option<Stances<D>>,
    wanted: Vec<Vector<D>>,
    wanted_before: Vec<Vector<D>>,
    pushes: Vec<Vector<D>>,
    forces: Vec<Vector<D>>,
    applied: Vec<Vector<D>>,
    ahead: Vec<Vector<D>>,
    late: Vec<Vector<D>>,
    earlier: Vec<Option<Vector<D>>>,
    cuts: Cuts,
    contacts: ContactsState,
}

impl<const D: usize> Bodies<D> {
    /// The bodies of a world as they were when [`Bodies::capture`] gave `state`. Until the
    /// next step there are no [`Bodies::touches`].
    ///
    /// # Errors
    /// Where the state is not one of this world.
    pub fn restore(world: &World<D>, state: BodiesState<D>) -> Result<Self, Unusable>
    where
        In<D>: Engine<D>,
    {
        let agents = world.agents.len();
        let lists = [
            &state.velocities,
            &state.headings,
            &state.wanted,
            &state.wanted_before,
            &state.pushes,
            &state.forces,
            &state.applied,
            &state.ahead,
        ];
        let soft = [state.late.len(), state.earlier.len()];
        if lists.map(Vec::len) != [agents; 8] || ![[0; 2], [agents; 2]].contains(&soft) {
            return Err(Unusable("it has another number of agents".to_owned()));
        }
        let physics = <In<D> as Engine<D>>::restore(world, &state.engine)?;
        let mut bodies = Self {
            step: state.step,
            velocities: state.velocities,
            headings: state.headings,
            wanted: state.wanted,
            wanted_before: state.wanted_before,
            pushes: state.pushes,
            forces: state.forces,
            applied: state.applied,
            ahead: state.ahead,
            late: state.late,
            earlier: state.earlier,
            ..Self::around(physics, world)
        };
        bodies.actuators.resume(state.cuts);
        match (&mut bodies.attitudes, state.stances) {
            (Some(attitudes), Some(stances)) if stances.len() == agents => {
                attitudes.stances = stances;
            }
            (None, None) => {}
            _ => return Err(Unusable("its bodies have other shapes".to_owned())),
        }
        let (positions, velocities) = (&mut bodies.positions, &mut bodies.engine_velocities);
        bodies.physics.read(positions, velocities);
        bodies.move_obstacles(bodies.step);
        bodies.look_around();
        bodies.contacts.resume(state.contacts);
        Ok(bodies)
    }

    /// What [`Bodies::restore`] needs.
    ///
    /// # Errors
    /// Where the engine cannot tell its state.
    pub fn capture(&self) -> Result<BodiesState<D>, Unusable> {
        // Every field is named, so that a new one cannot be forgotten here.
        let Self {
            physics,
            step,
            velocities,
            headings,
            attitudes,
            wanted,
            wanted_before,
            pushes,
            forces,
            applied,
            ahead,
            late,
            earlier,
            actuators,
            contacts,
            // Part of the world, and of the time.
            groups: _,
            obstacles: _,
            masses: _,
            gravity: _,
            step_size: _,
            substeps: _,
            // Known to the engine as well.
            positions: _,
            engine_velocities: _,
            // Computed anew in every step.
            next: _,
            pulls: _,
            touches: _,
            pressed: _,
            stood: _,
            stood_turned: _,
            // The past alone.
            verdicts: _,
            watches: _,
        } = self;
        Ok(BodiesState {
            engine: physics.save()?,
            step: *step,
            velocities: velocities.clone(),
            headings: headings.clone(),
            stances: attitudes.as_ref().map(|it| it.stances.clone()),
            wanted: wanted.clone(),
            wanted_before: wanted_before.clone(),
            pushes: pushes.clone(),
            forces: forces.clone(),
            applied: applied.clone(),
            ahead: ahead.clone(),
            late: late.clone(),
            earlier: earlier.clone(),
            cuts: actuators.cuts(),
            contacts: contacts.capture(),
        })
    }
}

//! The leading order of fast flocking, (4.19).

use std::iter;
use std::path::Path;

use nalgebra::DMatrix;

use super::coupling::Coupling;
use super::{FastFlocking, NoReduction, stationary, weighted};
use crate::csv::{Cell, write_row};
use crate::file::{FileError, write_whole};
use crate::math::{DormandPrince, Solution, Vector};
use crate::world::World;

/// How exactly the leading order is integrated: the error of a step, over the larger of 1 and
/// what is integrated.
const TOLERANCE: f64 = 1e-11;

/// The leading order at one time.
#[derive(Debug, Clone, PartialEq)]
pub struct Leading<const D: usize> {
    /// The time.
    pub time: f64,
    /// v^f, the velocity of every agent.
    pub velocity: Vector<D>,
    /// The place of each agent: as far from the others as at the start.
    pub positions: Vec<Vector<D>>,
}

impl<const D: usize> Leading<D> {
    /// How far a state is from it: max_i |x_i − x_i0| and max_i |v_i − v_i0|, section 5; 0 and 0
    /// without agents.
    pub fn errors(&self, positions: &[Vector<D>], velocities: &[Vector<D>]) -> [f64; 2] {
        let pairs = positions.iter().zip(&self.positions);
        let positions = pairs.map(|(x, there)| (x - there).norm());
        let velocities = velocities.iter().map(|v| (v - self.velocity).norm());
        [
            positions.fold(0.0, f64::max),
            velocities.fold(0.0, f64::max),
        ]
    }
}

impl<const D: usize> FastFlocking<'_, D> {
    /// The leading order (4.19) at some times, which increase from 0 on. π is that of the
    /// present rates: where these depend on more than relative positions, it changes on the
    /// way.
    ///
    /// # Errors
    /// Where it cannot be computed, or the flock falls into parts on the way.
    pub fn leading_order(&mut self, times: &[f64]) -> Result<Vec<Leading<D>>, NoReduction> {
        let world = self.world;
        let (aligning, others) = (&mut self.aligning, &mut self.others);
        let mut known = (self.rates.clone(), self.weights.clone());
        let mut apart = false;
        let slope = |time: f64, state: &[f64], out: &mut [f64]| {
            let (moved, velocity) = halves(state);
            let positions = shifted(world, &moved);
            let velocities = vec![velocity; positions.len()];
            let rates = Coupling::of(aligning, time, &positions, &velocities).rates();
            if differ(&rates, &known.0) {
                match stationary(&rates) {
                    Some(weights) => known = (rates, weights),
                    None => apart = true,
                }
            }
            let steering = others.accelerations(time, &positions, &velocities);
            let acceleration = match apart {
                true => Vector::repeat(f64::NAN),
                false => weighted(&known.1, &steering) + world.gravity,
            };
            out[..D].copy_from_slice(velocity.as_slice());
            out[D..].copy_from_slice(acceleration.as_slice());
        };
        let mut state = vec![0.0; D];
        state.extend(self.start.iter());
        let mut solution = Solution::new(slope, DormandPrince::default(), 0.0, state, TOLERANCE);
        let mut course = Vec::with_capacity(times.len());
        let mut stuck = None;
        for &time in times {
            if let Err(problem) = solution.advance_to(time) {
                stuck = Some(problem);
                break;
            }
            let (moved, velocity) = halves(solution.state());
            course.push(Leading {
                time,
                velocity,
                positions: shifted(world, &moved),
            });
        }
        drop(solution);
        match stuck {
            Some(_) if apart => Err(NoReduction::Parts),
            Some(problem) => Err(problem.into()),
            None => Ok(course),
        }
    }

    /// The leading order at the times at which the world records its frames.
    ///
    /// # Errors
    /// As [`FastFlocking::leading_order`].
    pub fn recorded(&mut self) -> Result<Vec<Leading<D>>, NoReduction> {
        let (steps, every) = (self.world.steps(), self.world.frame_steps());
        let frames = (0..steps).step_by(usize::try_from(every).unwrap_or(usize::MAX));
        let time = |step: u64| step as f64 * self.world.spec.time.step;
        let times: Vec<f64> = frames.chain([steps]).map(time).collect();
        self.leading_order(&times)
    }
}

/// Displacement and velocity.
fn halves<const D: usize>(state: &[f64]) -> (Vector<D>, Vector<D>) {
    let half = |from: usize| Vector::from_column_slice(&state[from..from + D]);
    (half(0), half(D))
}

/// The places of the agents, all displaced alike since the start.
fn shifted<const D: usize>(world: &World<D>, moved: &Vector<D>) -> Vec<Vector<D>> {
    world.agents.positions.iter().map(|x| x + moved).collect()
}

/// Whether rates differ by more than rounding: for most laws they are always the same.
fn differ(a: &DMatrix<f64>, b: &DMatrix<f64>) -> bool {
    let largest = a.amax().max(b.amax());
    a.iter()
        .zip(b)
        .any(|(a, b)| (a - b).abs() > 1e-13 * largest)
}

/// Writes a leading order to a file: as a table with a line of names where its name ends in
/// `.csv`, otherwise as JSON Lines. The file appears whole or not at all; an existing one is
/// refused without `overwrite`.
///
/// # Errors
/// Where it cannot be written.
pub fn write_leading<const D: usize>(
    path: &Path,
    course: &[Leading<D>],
    overwrite: bool,
) -> Result<(), FileError> {
    let ending = path.extension().map(|ending| ending.to_ascii_lowercase());
    let text = match ending.is_some_and(|ending| ending == "csv") {
        true => table(course),
        false => course.iter().map(line).collect::<String>().into_bytes(),
    };
    write_whole(path, &text, overwrite)
}

fn line<const D: usize>(leading: &Leading<D>) -> String {
    let list = |vector: &Vector<D>| vector.as_slice().to_vec();
    let positions: Vec<_> = leading.positions.iter().map(list).collect();
    let line = serde_json::json!({
        "time": leading.time, "velocity": list(&leading.velocity), "positions": positions,
    });
    format!("{line}\n")
}

fn table<const D: usize>(course: &[Leading<D>]) -> Vec<u8> {
    let axes = &["x", "y", "z"][..D];
    let agents = course.first().map_or(0, |leading| leading.positions.len());
    let mut names = vec!["time".to_owned()];
    names.extend(axes.iter().map(|axis| format!("v{axis}")));
    let places = (0..agents).flat_map(|i| axes.iter().map(move |axis| format!("{axis}{i}")));
    names.extend(places);
    let mut text = Vec::new();
    write_row(&mut text, names.iter().map(|name| name.as_str().into()));
    for leading in course {
        let vectors = iter::once(&leading.velocity).chain(&leading.positions);
        let numbers = iter::once(&leading.time).chain(vectors.flatten());
        write_row(&mut text, numbers.map(|number| Cell::Number(*number)));
    }
    text
}

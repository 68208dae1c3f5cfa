//! What takes the steps of points.

use serde::{Deserialize, Serialize};

use super::accuracy::Solver;
use super::field::Field;
use crate::math::Vector;
use crate::math::{DormandPrince, Method, Radau, Solution, Stand, Stuck, System, mean};

/// Rate of decay × step of the world from which on the implicit method is the quicker one:
/// the explicit one is stable up to about 6 in each of its steps.
const STIFF: f64 = 30.0;

/// The most coordinates of positions for the implicit method, whose work grows with the cube
/// of their number.
const MOST_COORDINATES: usize = 600;

/// What takes the steps of points, and how it was about to go on.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub(super) struct Integrator {
    /// None for the explicit method, which remembers nothing.
    implicit: Option<Radau>,
    /// The next step to try; none at the start.
    step: Option<f64>,
    jumps: u64,
}

impl Integrator {
    /// The method that suits a state at the start: where velocities decay fast there, or would
    /// once all agents have the same velocity, the implicit one.
    pub(super) fn choose<const D: usize>(
        mut field: Field<'_, D>,
        state: &[f64],
        step_size: f64,
    ) -> Self {
        let half = state.len() / 2;
        if half > MOST_COORDINATES {
            return Self::default();
        }
        let mut velocities = vec![Vector::<D>::zeros(); half / D];
        super::field::read(&state[half..], &mut velocities);
        let middle = mean(&velocities);
        let mut together = state[..half].to_vec();
        together.extend(velocities.iter().flat_map(|_| middle.iter().copied()));
        let rate = [state, &together].map(|state| {
            let mut slope = vec![0.0; state.len()];
            field.settle(0.0, state);
            field.slope(0.0, state, &mut slope);
            let stand = Stand {
                time: 0.0,
                state,
                slope: &slope,
                tolerance: 1.0,
            };
            Radau::fastest_decay(&mut field, stand)
        });
        let stiff = f64::max(rate[0], rate[1]) * step_size >= STIFF;
        Self {
            implicit: stiff.then(Radau::default),
            ..Self::default()
        }
    }

    /// Takes a state from one time to another, to a relative accuracy.
    ///
    /// # Errors
    /// Where it gets stuck; then the state stays.
    pub(super) fn advance<const D: usize>(
        &mut self,
        field: Field<'_, D>,
        state: &mut [f64],
        times: [f64; 2],
        relative: f64,
    ) -> Result<(), Stuck> {
        match self.implicit.take() {
            None => {
                self.solve(field, DormandPrince::default(), state, times, relative)?;
            }
            Some(radau) => {
                self.implicit = Some(Radau::default());
                self.implicit = Some(self.solve(field, radau, state, times, relative)?);
            }
        }
        Ok(())
    }

    fn solve<const D: usize, M: Method>(
        &mut self,
        field: Field<'_, D>,
        method: M,
        state: &mut [f64],
        [begin, end]: [f64; 2],
        relative: f64,
    ) -> Result<M, Stuck> {
        let mut solution = Solution::new(field, method, begin, state.to_vec(), relative);
        if let Some(step) = self.step {
            solution = solution.with_step(step);
        }
        solution.advance_to(end)?;
        self.step = Some(solution.next_step());
        self.jumps += solution.jumps() as u64;
        state.copy_from_slice(solution.state());
        Ok(solution.into_method())
    }

    /// Counts jumps that were met between its steps.
    pub(super) fn note_jumps(&mut self, jumps: usize) {
        self.jumps += jumps as u64;
    }

    /// Whether it can go on with this many coordinates of positions.
    pub(super) fn fits(&self, coordinates: usize) -> bool {
        self.implicit.as_ref().is_none_or(|it| it.fits(coordinates))
    }

    /// What it is called.
    pub(super) fn solver(&self, relative: f64) -> Solver {
        let (method, order) = match self.implicit {
            None => ("Dormand-Prince 8(5,3)", DormandPrince::ORDER),
            Some(_) => ("Radau IIA", Radau::ORDER),
        };
        Solver {
            method,
            order,
            relative,
            jumps: self.jumps,
        }
    }
}

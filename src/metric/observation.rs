//! All that can be said of one state without knowing how it came about.

use nalgebra::DMatrix;

use crate::law::{Field, Pulls};
use crate::math::Vector;
use crate::metric::{Influences, Terms, laws_record};
use crate::trace::record::LawsRecord;

/// A state of a world's agents, with what the laws make of it. What is derived is worked out
/// from time, positions and velocities alone.
#[derive(Debug, Clone)]
pub struct Observation<const D: usize> {
    /// The time.
    pub time: f64,
    /// Position of each agent.
    pub positions: Vec<Vector<D>>,
    /// Velocity of each agent.
    pub velocities: Vec<Vector<D>>,
    /// What all laws and gravity together accelerate each agent by.
    pub accelerations: Vec<Vector<D>>,
    /// How fast these accelerations change along the motion; a difference over one step of the
    /// world to either side.
    pub jerks: Vec<Vector<D>>,
    /// What each law accelerates each agent by, in the order of [`World::laws`].
    ///
    /// [`World::laws`]: crate::world::World::laws
    pub by_law: Vec<Vec<Vector<D>>>,
    /// How each law aligns velocities, in the same order; nothing for those that do not.
    pub alignments: Vec<Option<Aligned<D>>>,
    /// Energies, centres and what each law is about.
    pub laws: LawsRecord,
}

/// How one law aligns velocities: v̇_i = α_i u_i with u_i = Σ_j a_ij (v_j − v_i). Djokam &
/// Rathinam, (2.7). Entries go by the agents of `influences`.
#[derive(Debug, Clone)]
pub struct Aligned<const D: usize> {
    /// The influences a_ij, a_ii included.
    pub influences: Influences,
    /// The gains α_i, divided by ε and mass where the law has it so.
    pub gains: Vec<f64>,
    /// u_i, which is v̄_i − v_i where the influences on an agent sum to 1.
    pub drives: Vec<Vector<D>>,
}

impl<const D: usize> Observation<D> {
    /// A state of the world of `field`.
    pub fn new(
        field: &mut Field<'_, D>,
        time: f64,
        positions: Vec<Vector<D>>,
        velocities: Vec<Vector<D>>,
    ) -> Self {
        let world = field.world();
        let (flock, state) = field.at(time, &positions, &velocities);
        let terms = Terms::new(flock, &state);
        let laws = laws_record(world, &terms, &state);
        let aligned = |pulls| Aligned::new(pulls, &velocities);
        let alignments = terms.pulls.iter().map(aligned).collect();
        let by_law: Vec<_> = terms.by_law.into_iter().map(|(_, it)| it).collect();
        let mut accelerations = vec![world.gravity; positions.len()];
        for of_law in &by_law {
            for (sum, term) in accelerations.iter_mut().zip(of_law) {
                *sum += term;
            }
        }
        let step = world.spec.time.step;
        let mut moved = |by: f64| {
            let along = |of: &[Vector<D>], rates: &[Vector<D>]| -> Vec<Vector<D>> {
                let pairs = of.iter().zip(rates);
                pairs.map(|(x, rate)| x + rate * by).collect()
            };
            let positions = along(&positions, &velocities);
            let velocities = along(&velocities, &accelerations);
            field.accelerations(f64::max(time + by, 0.0), &positions, &velocities)
        };
        let (before, after) = (moved(-step), moved(step));
        let jerks = before.iter().zip(&after);
        let jerks = jerks.map(|(before, after)| (after - before) / (2.0 * step));
        Self {
            time,
            jerks: jerks.collect(),
            positions,
            velocities,
            accelerations,
            by_law,
            alignments,
            laws,
        }
    }
}

impl<const D: usize> Aligned<D> {
    /// From the pulls of a law; nothing where it has none.
    fn new(pulls: &Pulls<D>, velocities: &[Vector<D>]) -> Option<Self> {
        let mut rows: Vec<_> = pulls.rows().iter().collect();
        rows.sort_by_key(|row| row.agent);
        let drives = rows.iter().map(|row| pulls.drive(row, velocities));
        let drives: Vec<_> = drives.collect();
        let gains = rows.iter().zip(&drives);
        let gains = gains.map(|(row, u)| row.gain.at(u.norm())).collect();
        (!pulls.is_empty()).then(|| Self {
            influences: Influences::new(pulls),
            gains,
            drives,
        })
    }

    /// The influences as a matrix, the row of agent i holding what influences it.
    pub fn matrix(&self) -> &DMatrix<f64> {
        self.influences.matrix()
    }
}

//! Sums over all pairs, for laws that need no more of a pair than its distance.

use std::borrow::Cow;
use std::fmt;
use std::sync::Arc;

use crate::math::{LARGEST_SQUARE, Vector};
use crate::parallel::gather;
use crate::sense::Scene;
use crate::sum::fast::{FastSums, Kernel};
use crate::sum::{Cloud, Direct, Fast, Point, Summable, Sums, direct, fast_sums};
use crate::world::spec::{FastSpec, SummationSpec};

/// Fewer agents are looked at one by one: that is as quick, and small worlds' runs stay what
/// they were to the last bit.
const FROM: usize = 64;

/// The sums Σ_j φ(r_ij²) and Σ_j φ(r_ij²)(c_j − c_i) over all agents j that a law sees, where
/// they see each other as they are.
///
/// A law that acts on all agents has them worked out at once, each pair for both of its
/// agents; in a scope they are worked out for the agents that are asked for. The two agree to
/// rounding, and neither depends on the number of threads.
#[derive(Clone)]
pub(super) struct AllPairs<const D: usize> {
    direct: Arc<dyn Direct<D>>,
    cloud: Cloud<D>,
    /// Whether the scene is one of which sums can be had.
    ready: bool,
    /// The sums of all agents, where they were worked out at once: in the order of the scene,
    /// and, to come there, in that of the world.
    gathered: Vec<Sums<D>>,
    by_agent: Vec<Sums<D>>,
    /// The fast way, and from how many agents on it is taken.
    fast: Option<(Box<dyn Fast<D>>, usize)>,
    /// What it is told in the order of the world: where the agents are and what they carry.
    told: [Vec<Vector<D>>; 2],
}

impl<const D: usize> AllPairs<D> {
    /// The sums of a function; nothing where it is not known on lanes.
    pub fn new(function: &impl Summable) -> Option<Self> {
        Some(Self {
            direct: direct(function)?,
            cloud: Cloud::default(),
            ready: false,
            gathered: Vec::new(),
            by_agent: Vec::new(),
            fast: None,
            told: Default::default(),
        })
    }

    /// The same, with the fast way where it is wanted and can be had.
    pub fn summed(self, summation: SummationSpec, kernel: Kernel) -> Self {
        let (fast, from) = match summation {
            SummationSpec::Direct => (None, 0),
            SummationSpec::Auto => {
                let error = FastSpec::default().relative_error;
                (fast_sums(kernel, error), FastSums::<D>::CROSSOVER)
            }
            SummationSpec::Fast(fast) => (fast_sums(kernel, fast.relative_error), 0),
        };
        Self {
            fast: fast.map(|fast| (fast, from)),
            ..self
        }
    }

    /// As [`crate::law::Law::prepare`], with what the agents of the scene carry.
    pub fn prepare(&mut self, scene: &Scene<'_, D>, carried: &[Vector<D>]) {
        self.gathered.clear();
        let many = scene.positions.len() >= FROM;
        self.ready = many && scene.perception.is_none() && is_tame(scene.positions);
        if self.ready {
            let seen = scene.in_world_order(|i| i).filter(|&i| scene.sees(i));
            self.cloud.refill(seen.map(|i| point(scene, carried, i)));
        }
    }

    /// As [`crate::law::Law::gather`], with what the agents carry.
    pub fn gather(&mut self, scene: &Scene<'_, D>, carried: &[Vector<D>]) {
        if self.ready && scene.visible.is_none() {
            self.add_up(scene, carried);
            self.gathered.clone_from(&self.by_agent);
            gather(scene.agents, &self.by_agent, &mut self.gathered);
        }
    }

    /// Sums in the order of the world, over all agents.
    fn add_up(&mut self, scene: &Scene<'_, D>, carried: &[Vector<D>]) {
        if let Some((fast, from)) = &mut self.fast
            && scene.positions.len() >= *from
        {
            let [positions, numbers] = &mut self.told;
            for (told, values) in [(positions, scene.positions), (numbers, carried)] {
                told.clear();
                told.extend(scene.in_world_order(|i| values[i]));
            }
            let [positions, numbers] = &self.told;
            if fast.run(positions, numbers, &mut self.by_agent) {
                return;
            }
        }
        self.direct.mutual(&self.cloud, &mut self.by_agent);
    }

    /// The sums of `count` agents of the scene from number `first` on; nothing where the
    /// agents must be looked at one by one.
    pub fn sums(
        &self,
        scene: &Scene<'_, D>,
        carried: &[Vector<D>],
        first: usize,
        count: usize,
    ) -> Option<Cow<'_, [Sums<D>]>> {
        let range = first..first + count;
        if !self.ready {
            return None;
        }
        if !self.gathered.is_empty() {
            return Some(Cow::Borrowed(&self.gathered[range]));
        }
        let mut targets = Cloud::default();
        targets.refill(range.map(|i| point(scene, carried, i)));
        Some(Cow::Owned(self.direct.at(&targets, &self.cloud)))
    }
}

fn point<const D: usize>(scene: &Scene<'_, D>, carried: &[Vector<D>], i: usize) -> Point<D> {
    Point {
        number: scene.agents[i] as usize,
        position: scene.positions[i],
        carried: carried[i],
    }
}

/// Whether squared distances are at most [`LARGEST_SQUARE`].
fn is_tame<const D: usize>(positions: &[Vector<D>]) -> bool {
    let largest = positions.iter().map(|x| x.amax()).fold(0.0, f64::max);
    // No distance is more than 2√D times that, and lengths of kernels come on top.
    largest <= 0.1 * LARGEST_SQUARE.sqrt()
}

impl<const D: usize> fmt::Debug for AllPairs<D> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("AllPairs").finish_non_exhaustive()
    }
}

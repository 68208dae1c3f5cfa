//! Velocity alignment.
//!
//! v̇_i = g_i(|u_i|) u_i with u_i = Σ_j a_ij (v_j − v_i) over the agents j within the range:
//! G. A. Djokam and M. Rathinam, "A generalized model of flocking with steering". Where
//! Σ_j a_ij = 1, a_ii included, u_i = v̄_i − v_i, (2.7).
//!
//! a_ij is a product, then normalised. What is left out of it is 1.
//!
//! | factor | formula | source |
//! |---|---|---|
//! | kernel | φ(r_ij), see [`Influence`] | (1.1) |
//! | senses | the weight with which i perceives j | |
//! | graph | w_ij, or a_ij(t) | Shi, Wang & Chu, (6); (2.6) |
//! | orientation | of σ_i(v_i) and the direction to j | (2.4) |
//! | masking | exp(−Σ_l h(w_ijl + w_jil)) | (B.1) |
//! | line of sight | a factor for each body and obstacle between i and j | |
//!
//! | normalisation | a_ij divided by | source |
//! |---|---|---|
//! | `none` | 1 | Shi, Wang & Chu, (6) |
//! | `mean_field` | N | (1.1) |
//! | `motsch_tadmor` | Σ_k a_ik, with a_ii = φ(0) or without | (1.2) |
//!
//! | parameter | symbol | unit |
//! |---|---|---|
//! | `gain` | g, α_i(t) | 1/time |
//! | `gain.bounded.bound`, `gain.bounded.scale` | A, a | acceleration, velocity |
//! | `epsilon` | ε, which divides the gain, (4.1) | 1 |
//! | `range` | | length |
//!
//! As a force it is divided by the agent's mass. Where the gain is bounded, |v̇_i| ≤ A/ε
//! holds for any state, not even broken by rounding. Where i and j influence each other
//! alike (no Motsch–Tadmor, no orientation, no senses; one constant gain; forces or equal
//! masses) the sum of the forces is zero to rounding.
//!
//! On bodies, where rate × step may reach a quarter, it is followed exactly over each step, with the
//! influences of its middle; below, it is held over the step, at velocities of third order: of second
//! order in the step both ways, with errors of about the same size, so that they fall through the
//! change. Of first order are the one step in which a flock of stiff alignment falls in line while
//! other laws act, and a `range` within that of the kernel, where links come and go.
//!
//! Masking and sight go by where agents truly are, whatever the senses tell. An agent that
//! no influence reaches is not accelerated.

mod crowd;
mod gains;
mod line_of_sight;
mod masking;
mod orientation;
mod weights;

use crate::law::all_pairs::AllPairs;
use crate::law::{Law, Link, Pull};
use crate::math::{Influence, Vector};
use crate::sense::{Neighbour, Scene};
use crate::sum::Sums;
use crate::sum::fast::Kernel;
use crate::world::World;
use crate::world::spec::{
    AlignmentSpec, NormalisationSpec, RelaxationSpec, ScopeSpec, SummationSpec, seen_by,
};

use crowd::Crowd;
use gains::Gains;
use line_of_sight::LineOfSight;
use masking::Masking;
use orientation::Orientation;
use weights::Weights;

/// Velocity alignment; see the module.
#[derive(Debug, Clone)]
pub struct Alignment<const D: usize> {
    kernel: Influence,
    /// Infinite for all pairs.
    range: f64,
    normalisation: NormalisationSpec,
    self_influence: bool,
    gains: Gains,
    weights: Option<Weights>,
    orientation: Option<Orientation>,
    masking: Option<Masking<D>>,
    sight: Option<LineOfSight<D>>,
    /// All agents, where it matters whose body stands between two.
    crowd: Crowd<D>,
    /// Where influence is a known kernel of all pairs and nothing else.
    all_pairs: Option<AllPairs<D>>,
    relaxation: RelaxationSpec,
    /// Number of agents that it can see, and the step of time: what its rates are judged by.
    visible: usize,
    step: f64,
}

impl<const D: usize> Alignment<D> {
    /// The law with the parameters of a checked world file, in a scope of that world or in
    /// none.
    pub fn new(spec: &AlignmentSpec, scope: Option<&ScopeSpec>, world: &World<D>) -> Self {
        let groups = &world.spec.agents;
        let seen = seen_by(scope, groups);
        let sees = |group: &&usize| seen[**group];
        let weights = |graph| Weights::new(graph, world.agents.len(), world.spec.seed);
        let kernel = spec.kernel.influence();
        let bare = spec.range.is_none()
            && spec.graph.is_none()
            && spec.orientation.is_none()
            && spec.masking.is_none()
            && spec.line_of_sight.is_none();
        // What is left of a sum without the agent itself may be too little to be told from it.
        let alone = spec.normalisation == NormalisationSpec::MotschTadmor && !spec.self_influence;
        let summation = match alone {
            true => SummationSpec::Direct,
            false => spec.summation,
        };
        Self {
            all_pairs: (AllPairs::new(&kernel).filter(|_| bare))
                .map(|it| it.summed(summation, Kernel::Influence(kernel.clone()))),
            kernel,
            range: spec.range.unwrap_or(f64::INFINITY),
            normalisation: spec.normalisation,
            self_influence: spec.self_influence,
            gains: Gains::new(spec, &world.acted_on(scope), &world.agents.mass),
            weights: spec.graph.as_ref().map(weights),
            orientation: spec.orientation.as_ref().map(Orientation::new),
            masking: spec.masking.as_ref().map(Masking::new),
            sight: (spec.line_of_sight.as_ref()).map(|sight| LineOfSight::new(sight, world)),
            crowd: Crowd::default(),
            relaxation: spec.relaxation,
            visible: world.agents.group.iter().filter(sees).count(),
            step: world.spec.time.step,
        }
    }

    /// The same with a kernel of one's own: φ ≥ 0 as a function of the *squared* distance.
    /// It must be a function indeed: the same value for the same distance.
    pub fn with_kernel(self, kernel: impl Fn(f64) -> f64 + Send + Sync + 'static) -> Self {
        Self {
            kernel: Influence::own(kernel),
            all_pairs: None,
            ..self
        }
    }

    /// The same with a gain of one's own: α_i(t) ≥ 0 by the agent's index in the world and
    /// the time. ε and the masses divide it as before.
    pub fn with_gain(self, gain: impl Fn(usize, f64) -> f64 + Send + Sync + 'static) -> Self {
        Self {
            gains: self.gains.with(gain),
            ..self
        }
    }

    /// The same with influences of one's own in the place of a graph: a_ij(t) ≥ 0 by the
    /// indices of i and j in the world and the time, by which the kernel is multiplied. a_ii(t)
    /// counts for the sum of Motsch and Tadmor only.
    pub fn with_influences(
        self,
        influences: impl Fn(usize, usize, f64) -> f64 + Send + Sync + 'static,
    ) -> Self {
        Self {
            weights: Some(Weights::own(influences)),
            all_pairs: None,
            ..self
        }
    }

    /// The influences a_ij on agent `i` of the scene, appended to `links`, and a_ii, which is
    /// returned.
    fn row(&self, scene: &Scene<'_, D>, i: usize, links: &mut Vec<Link<D>>) -> f64 {
        let first = links.len();
        self.unseen(scene, i, links);
        if let Some(sight) = &self.sight {
            for link in &mut links[first..] {
                link.weight *= sight.factor(&self.crowd, scene, i, link.index);
            }
            drop_idle(links, first);
        }
        let own = self.own(scene, i);
        let links = &mut links[first..];
        let sum = links.iter().fold(own, |sum, link| sum + link.weight);
        let divisor = self.divisor(sum, || scene.count());
        links.iter_mut().for_each(|link| link.weight /= divisor);
        own / divisor
    }

    /// What influences are divided by whose sum, a_ii included, is this, among some agents;
    /// 1 where there are none.
    fn divisor(&self, sum: f64, count: impl Fn() -> usize) -> f64 {
        let divisor = match self.normalisation {
            NormalisationSpec::None => 1.0,
            NormalisationSpec::MeanField => count() as f64,
            NormalisationSpec::MotschTadmor => sum,
        };
        if divisor == 0.0 { 1.0 } else { divisor }
    }

    /// The influences on agent `i` before normalisation, whatever stands in the line of sight,
    /// appended to `links`.
    fn unseen(&self, scene: &Scene<'_, D>, i: usize, links: &mut Vec<Link<D>>) {
        let first = links.len();
        scene.neighbours(i, self.reach(), |neighbour| {
            links.push(Link {
                index: neighbour.index,
                weight: self.unmasked(scene, i, &neighbour),
                velocity: neighbour.velocity,
            });
        });
        drop_idle(links, first);
        if let Some(masking) = &self.masking {
            masking.weaken(scene.positions, i, &mut links[first..]);
            drop_idle(links, first);
        }
    }

    /// The influence of a neighbour before normalisation, whatever stands between.
    fn unmasked(&self, scene: &Scene<'_, D>, i: usize, neighbour: &Neighbour<D>) -> f64 {
        let mut weight = self.kernel.value(neighbour.squared) * neighbour.weight;
        if let Some(weights) = &self.weights {
            let [me, other] = [i, neighbour.index].map(|place| scene.agents[place] as usize);
            weight *= weights.between(me, other, scene.time);
        }
        if let Some(orientation) = &self.orientation {
            weight *= orientation.factor(&scene.velocities[i], &neighbour.offset);
        }
        weight
    }

    /// a_ii before normalisation.
    fn own(&self, scene: &Scene<'_, D>, i: usize) -> f64 {
        if !self.self_influence {
            return 0.0;
        }
        let weights = self.weights.as_ref();
        let me = scene.agents[i] as usize;
        self.kernel.value(0.0) * weights.map_or(1.0, |it| it.of_itself(me, scene.time))
    }

    /// Accelerations from the sums Σ φ and Σ φ(v_j − v_i) of each agent.
    fn accelerate_by(
        &self,
        sums: &[Sums<D>],
        scene: &Scene<'_, D>,
        first: usize,
        out: &mut [Vector<D>],
    ) {
        let count = scene.count();
        let own = match self.self_influence {
            true => self.kernel.value(0.0),
            false => 0.0,
        };
        for ((i, acceleration), sums) in (first..).zip(out).zip(sums) {
            let divisor = self.divisor(own + sums.weight, || count);
            let gain = self.gains.of(scene.agents[i] as usize, scene.time);
            *acceleration += gain.of(&(sums.drive / divisor));
        }
    }

    /// The distance beyond which nobody has influence.
    fn reach(&self) -> f64 {
        self.range.min(self.kernel.reach())
    }

    /// A bound of the rate at which a velocity is pulled, for any state; infinite where
    /// nothing is known.
    fn largest_rate(&self) -> f64 {
        let others = self.visible.saturating_sub(1) as f64;
        let weights = self.weights.as_ref();
        let sum = self.kernel.largest() * weights.map_or(others, Weights::largest_row);
        let sum = match self.normalisation {
            NormalisationSpec::None => sum,
            NormalisationSpec::MeanField => sum / self.visible.max(1) as f64,
            NormalisationSpec::MotschTadmor => 1.0,
        };
        match self.gains.largest() * sum {
            // Nothing, times something without bound.
            rate if rate.is_nan() => 0.0,
            rate => rate,
        }
    }
}

impl<const D: usize> Law<D> for Alignment<D> {
    fn name(&self) -> &str {
        "alignment"
    }

    fn range(&self) -> f64 {
        self.reach()
    }

    fn jump(&self) -> Option<f64> {
        // However little the only one weighs, it weighs 1 once divided by itself.
        let alone = self.normalisation == NormalisationSpec::MotschTadmor && !self.self_influence;
        let reach = self.reach();
        let ends = reach.is_finite() && (self.range < self.kernel.reach() || alone);
        ends.then_some(reach)
    }

    fn prepare(&mut self, scene: &Scene<'_, D>) {
        if let Some(largest) = self.sight.as_ref().and_then(LineOfSight::largest_body) {
            self.crowd.rebuild(scene.positions, largest);
        }
        let all = self.reach().is_infinite()
            && self.weights.is_none()
            && scene.perception.is_none()
            && scene.visible.is_none();
        if let Some(masking) = &mut self.masking {
            masking.prepare(scene.positions, scene.agents, all);
        }
        if let Some(all_pairs) = &mut self.all_pairs {
            all_pairs.prepare(scene, scene.velocities);
        }
    }

    fn gather(&mut self, scene: &Scene<'_, D>) {
        if let Some(all_pairs) = &mut self.all_pairs {
            all_pairs.gather(scene, scene.velocities);
        }
    }

    fn pull(&self, scene: &Scene<'_, D>, i: usize, links: &mut Vec<Link<D>>) -> Option<Pull> {
        let own = self.row(scene, i, links);
        let gain = self.gains.of(scene.agents[i] as usize, scene.time);
        Some(Pull { gain, own })
    }

    fn relaxes(&self) -> bool {
        self.relaxation == RelaxationSpec::Always
    }

    fn stiffness(&self) -> f64 {
        match self.relaxation {
            RelaxationSpec::Auto => self.largest_rate() * self.step,
            RelaxationSpec::Always | RelaxationSpec::Never => 0.0,
        }
    }

    fn blocked(&self, scene: &Scene<'_, D>, i: usize, visit: &mut dyn FnMut(usize)) {
        let Some(sight) = &self.sight else {
            return;
        };
        let mut links = Vec::new();
        self.unseen(scene, i, &mut links);
        for link in links {
            if sight.blockers(&self.crowd, scene, i, link.index) != [0, 0] {
                visit(link.index);
            }
        }
    }

    fn accelerate(&self, scene: &Scene<'_, D>, first: usize, out: &mut [Vector<D>]) {
        let all_pairs = self.all_pairs.as_ref();
        if let Some(sums) =
            all_pairs.and_then(|it| it.sums(scene, scene.velocities, first, out.len()))
        {
            return self.accelerate_by(&sums, scene, first, out);
        }
        let mut links = Vec::new();
        for (k, acceleration) in out.iter_mut().enumerate() {
            let i = first + k;
            links.clear();
            let Some(pull) = self.pull(scene, i, &mut links) else {
                continue;
            };
            let velocity = scene.velocities[i];
            let u = links.iter().fold(Vector::zeros(), |u, link| {
                u + (link.velocity - velocity) * link.weight
            });
            *acceleration += pull.gain.of(&u);
        }
    }
}

/// Takes out what has no influence. What is no number must stay, so that the run fails.
fn drop_idle<const D: usize>(links: &mut Vec<Link<D>>, first: usize) {
    links.extract_if(first.., |link| link.weight == 0.0).count();
}

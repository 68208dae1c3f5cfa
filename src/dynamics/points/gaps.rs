//! The smallest gaps between the bodies that points would be, at any time.
//!
//! Each step is taken as a cubic [`Way`]. Who is too far from the smallest gap so far to beat it
//! within the step is not looked at: after a search it is known by how much all others miss it,
//! and until agents have gone that far, no search is needed.

use serde::{Deserialize, Serialize};

use crate::dynamics::{Closest, Gaps, Touched};
use crate::math::{Vector, Way, turning_place};
use crate::sense::Cells;
use crate::shape::Obstacle;

/// Steps that a search is made to last for, where agents keep their pace.
const LASTING: f64 = 8.0;

/// Looks for the smallest gaps.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub(super) struct GapWatch {
    found: Gaps,
    /// By how much all pairs miss the smallest gap between agents at least.
    agents_miss: f64,
    /// The same of agents and obstacles.
    obstacles_miss: f64,
}

/// A step that was taken.
pub(super) struct Taken<'a, const D: usize> {
    pub(super) times: [f64; 2],
    pub(super) positions: [&'a [Vector<D>]; 2],
    pub(super) velocities: [&'a [Vector<D>]; 2],
    pub(super) radii: &'a [f64],
    /// Where they are at its end.
    pub(super) obstacles: &'a [Obstacle<D>],
}

impl GapWatch {
    /// The smallest gaps so far.
    pub(super) fn gaps(&self) -> Gaps {
        self.found
    }

    /// Looks at the start.
    pub(super) fn begin<const D: usize>(
        &mut self,
        positions: &[Vector<D>],
        radii: &[f64],
        obstacles: &[Obstacle<D>],
    ) {
        let rest = vec![Vector::zeros(); positions.len()];
        let start = Taken {
            times: [0.0; 2],
            positions: [positions; 2],
            velocities: [&rest; 2],
            radii,
            obstacles,
        };
        let ways = start.ways();
        // A short range first, so that one far agent does not make neighbours of all others.
        let widest = radii.iter().copied().fold(0.0, f64::max);
        let far = |far, p: &Vector<D>| f64::max(far, (p - positions[0]).norm());
        let spread = positions.iter().fold(0.0, far);
        let mut margin = f64::max(2.0 * widest, 1e-6 * spread);
        while positions.len() > 1 {
            self.search_agents(&start, &ways, 0.0, margin);
            // Others may be nearer than a pair that the search could have missed.
            if self.found.agents.is_some_and(|it| it.gap <= margin) {
                break;
            }
            self.found.agents = None;
            margin = f64::max(2.0 * margin, f64::MIN_POSITIVE);
        }
        self.search_obstacles(&start, &ways, 0.0);
    }

    /// Looks at a step.
    pub(super) fn look<const D: usize>(&mut self, step: &Taken<'_, D>) {
        let ways = step.ways();
        if self.found.agents.is_some() {
            // What all do alike brings nobody nearer to another.
            let drift = mean(&ways);
            let reach = 2.0 * reach(&ways, &drift);
            match self.agents_miss >= reach {
                true => self.agents_miss -= reach,
                false => self.search_agents(step, &ways, reach, LASTING * reach),
            }
        }
        if !step.obstacles.is_empty() {
            let reach = reach(&ways, &[Vector::zeros(); 4]);
            let moving = step.obstacles.iter().any(|it| it.motion().is_some());
            match self.obstacles_miss >= reach && !moving {
                true => self.obstacles_miss -= reach,
                false => self.search_obstacles(step, &ways, reach),
            }
        }
    }

    /// Looks at all pairs that may have come nearer than any before, `reach` being how much
    /// nearer a pair may have been within the step than at its end; and, so as to know by how
    /// much the others miss it, at those that miss it by less than `margin`. Nothing is known before
    /// the first search, which is sure of gaps up to the margin only.
    fn search_agents<const D: usize>(
        &mut self,
        step: &Taken<'_, D>,
        ways: &[Way<D>],
        reach: f64,
        margin: f64,
    ) {
        let known = self.found.agents.map_or(0.0, |it| it.gap);
        let radii = step.radii;
        let mut order: Vec<usize> = (0..radii.len()).collect();
        order.sort_by(|&i, &j| radii[j].total_cmp(&radii[i]));
        let mut at: Vec<Vector<D>> = order.iter().map(|&i| step.positions[1][i]).collect();
        let mut cells = Cells::default();
        let mut hits: Vec<(usize, f64)> = Vec::new();
        let mut miss = known + reach + margin;
        // Large bodies look for small ones, never small ones as far as for large ones.
        let mut rest = &order[..];
        while let Some(&largest) = rest.first() {
            let top = radii[largest];
            let alike = rest.partition_point(|&i| radii[i] >= 0.5 * top);
            let range = (known + 2.0 * top + reach + margin).max(f64::MIN_POSITIVE);
            cells.rebuild(&at, range);
            for (k, &i) in rest[..alike].iter().enumerate() {
                hits.clear();
                cells.for_each_within(&at[k], range, |place, _, squared| {
                    let other = cells.order()[place] as usize;
                    if other > k {
                        hits.push((rest[other], squared.sqrt()));
                    }
                });
                for &(j, distance) in &hits {
                    let apart = radii[i] + radii[j];
                    miss = miss.min(distance - apart);
                    self.compare_agents(step, ways, [i, j], distance - apart - reach);
                }
            }
            at.drain(..alike);
            rest = &rest[alike..];
        }
        let found = self.found.agents.map_or(0.0, |it| it.gap);
        self.agents_miss = (miss - found).max(0.0);
    }

    /// Looks at a pair whose gap is at least this.
    fn compare_agents<const D: usize>(
        &mut self,
        step: &Taken<'_, D>,
        ways: &[Way<D>],
        [i, j]: [usize; 2],
        least: f64,
    ) {
        let best = self.found.agents.map_or(f64::INFINITY, |it| it.gap);
        if least >= best {
            return;
        }
        let (distance, share) = ways[i].seen_from(&ways[j]).nearest();
        let gap = distance - step.radii[i] - step.radii[j];
        if gap < best {
            self.found.agents = Some(Closest {
                gap,
                agent: i.min(j),
                to: Touched::Agent(i.max(j)),
                time: step.time(share),
            });
        }
    }

    /// The same of obstacles. Those that move are looked at where they are at the end of the step.
    fn search_obstacles<const D: usize>(
        &mut self,
        step: &Taken<'_, D>,
        ways: &[Way<D>],
        reach: f64,
    ) {
        let margin = (1.0 + LASTING) * reach;
        let mut miss = f64::INFINITY;
        for (i, (place, radius)) in step.positions[1].iter().zip(step.radii).enumerate() {
            for (index, obstacle) in step.obstacles.iter().enumerate() {
                let best = self.found.obstacles.map_or(f64::INFINITY, |it| it.gap);
                if !obstacle.may_reach(place, best + radius + margin) {
                    miss = miss.min(best + margin);
                    continue;
                }
                let gap = obstacle.project(place).distance - radius;
                miss = miss.min(gap);
                if gap - reach >= best {
                    continue;
                }
                let (gap, share) = match obstacle.motion() {
                    None => passing(&ways[i], obstacle, *radius),
                    Some(_) => (gap, 1.0),
                };
                if gap < best {
                    self.found.obstacles = Some(Closest {
                        gap,
                        agent: i,
                        to: Touched::Obstacle(index),
                        time: step.time(share),
                    });
                }
            }
        }
        let found = self.found.obstacles.map_or(0.0, |it| it.gap);
        self.obstacles_miss = (miss - found).max(0.0);
    }
}

impl<const D: usize> Taken<'_, D> {
    fn time(&self, share: f64) -> f64 {
        self.times[0] + share * (self.times[1] - self.times[0])
    }

    fn ways(&self) -> Vec<Way<D>> {
        let duration = self.times[1] - self.times[0];
        let way = |i: usize| {
            let positions = self.positions.map(|it| it[i]);
            Way::new(positions, self.velocities.map(|it| it[i]), duration)
        };
        (0..self.radii.len()).map(way).collect()
    }
}

/// The smallest gap to a fixed obstacle on the way, and after which share of the step: at the
/// ends, or at the place in between up to which it falls.
fn passing<const D: usize>(way: &Way<D>, obstacle: &Obstacle<D>, radius: f64) -> (f64, f64) {
    let gap = |share| obstacle.project(&way.at(share)).distance - radius;
    let slope = |share| {
        let normal = obstacle.project(&way.at(share)).normal;
        normal.dot(&way.rate(share))
    };
    let inside = turning_place(slope).map(|share| (gap(share), share));
    let mut nearest = (gap(0.0), 0.0);
    for place in inside.into_iter().chain([(gap(1.0), 1.0)]) {
        if place.0 < nearest.0 {
            nearest = place;
        }
    }
    nearest
}

/// How all ways together go, from where they start.
fn mean<const D: usize>(ways: &[Way<D>]) -> [Vector<D>; 4] {
    let mut sum = [Vector::zeros(); 4];
    for way in ways {
        for (sum, point) in sum.iter_mut().zip(way.points()) {
            *sum += point - way.points()[0];
        }
    }
    sum.map(|it| it / ways.len().max(1) as f64)
}

/// How far any way leads from either of its ends, seen from what drifts so.
fn reach<const D: usize>(ways: &[Way<D>], drift: &[Vector<D>; 4]) -> f64 {
    let mut farthest: f64 = 0.0;
    for way in ways {
        let points = way.points();
        for end in [0, 3] {
            for k in 0..4 {
                let gone = (points[k] - points[end]) - (drift[k] - drift[end]);
                farthest = farthest.max(gone.norm_squared());
            }
        }
    }
    farthest.sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::{Pose, Shape};
    use proptest::prelude::*;

    /// Every pair at many moments of every step.
    fn brute_force(steps: &[[Vec<Vector<2>>; 2]], radii: &[f64], time: f64) -> f64 {
        let mut least = f64::INFINITY;
        for ends in steps.windows(2) {
            let [before, after] = ends else { continue };
            let way = |i: usize| {
                let positions = [before[0][i], after[0][i]];
                Way::new(positions, [before[1][i], after[1][i]], time)
            };
            let ways: Vec<_> = (0..radii.len()).map(way).collect();
            for (i, one) in ways.iter().enumerate() {
                for (j, other) in ways.iter().enumerate().skip(i + 1) {
                    let relative = one.seen_from(other);
                    for k in 0..=50 {
                        let distance = relative.at(f64::from(k) / 50.0).norm();
                        least = least.min(distance - radii[i] - radii[j]);
                    }
                }
            }
        }
        least
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]
        /// Agents that swing to and fro while all drift fast: whatever searches are left out, the
        /// smallest gap of all moments is found, with who and when.
        #[test]
        fn nothing_is_missed(
            starts in prop::collection::vec(prop::array::uniform2(-6.0..6.0f64), 2..14),
            swings in prop::collection::vec(prop::array::uniform3(0.0..2.0f64), 14),
            large in 0.1..3.0f64,
        ) {
            let time = 0.1;
            let radii: Vec<f64> = (0..starts.len()).map(|i| if i == 3 { large } else { 0.1 }).collect();
            let state = |t: f64| -> [Vec<Vector<2>>; 2] {
                let each = starts.iter().zip(&swings).map(|(start, [size, rate, phase])| {
                    let angle = rate * t + 3.0 * phase;
                    let place = Vector::from(*start) + Vector::<2>::new(50.0 * t, size * angle.sin());
                    (place, Vector::<2>::new(50.0, size * rate * angle.cos()))
                });
                let (positions, velocities) = each.unzip();
                [positions, velocities]
            };
            let steps: Vec<_> = (0..60).map(|k| state(time * f64::from(k))).collect();
            let mut watch = GapWatch::default();
            watch.begin(&steps[0][0], &radii, &[]);
            for (k, ends) in steps.windows(2).enumerate() {
                watch.look(&Taken {
                    times: [time * k as f64, time * (k + 1) as f64],
                    positions: [&ends[0][0], &ends[1][0]],
                    velocities: [&ends[0][1], &ends[1][1]],
                    radii: &radii,
                    obstacles: &[],
                });
            }
            let found = watch.gaps().agents.expect("there are pairs");
            let least = brute_force(&steps, &radii, time);
            prop_assert!(found.gap <= least + 1e-12, "{found:?}, but {least}");
            prop_assert!(found.gap > least - 0.05, "{found:?}, but {least}");
            let Touched::Agent(other) = found.to else { panic!("{found:?}") };
            let [positions, _] = state(found.time);
            let there = (positions[found.agent] - positions[other]).norm();
            let gap = there - radii[found.agent] - radii[other];
            prop_assert!((gap - found.gap).abs() < 1e-4, "{found:?}, but {gap} then");
        }
    }

    /// A fast agent passes a wall's corner between two states that are far from it.
    #[test]
    fn an_obstacle_is_passed_between_states() {
        let shape = Shape::Ball { radius: 1.0 };
        let ball = Obstacle::<2>::new(
            "ball".to_owned(),
            shape,
            Pose::new(Vector::zeros(), [0.0; 3]),
        );
        let obstacles = [ball.expect("a ball")];
        let velocity = [Vector::<2>::new(80.0, 0.0)];
        let at = |x: f64| [Vector::<2>::new(x, 1.75)];
        let mut watch = GapWatch::default();
        watch.begin(&at(-9.0), &[0.5], &obstacles);
        for k in 0..3 {
            let x = -9.0 + 8.0 * f64::from(k);
            watch.look(&Taken {
                times: [0.1 * f64::from(k), 0.1 * f64::from(k + 1)],
                positions: [&at(x), &at(x + 8.0)],
                velocities: [&velocity, &velocity],
                radii: &[0.5],
                obstacles: &obstacles,
            });
        }
        let found = watch.gaps().obstacles.expect("there is one");
        assert!((found.gap - 0.25).abs() < 1e-12, "{found:?}");
        assert!((found.time - 0.1125).abs() < 1e-9, "{found:?}");
        assert_eq!(watch.gaps().agents, None);
    }
}

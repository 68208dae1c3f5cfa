//! Cubic splines through points at given times.

use super::Moment;
use crate::math::Vector;

/// A curve through points at given times, cubic between them, whose acceleration is
/// continuous.
#[derive(Debug, Clone, PartialEq)]
pub struct Spline<const D: usize> {
    times: Vec<f64>,
    points: Vec<Vector<D>>,
    /// The acceleration at each point.
    accelerations: Vec<Vector<D>>,
    periodic: bool,
}

impl<const D: usize> Spline<D> {
    /// The natural spline: no acceleration at its ends. Before and after its times it goes on
    /// straight ahead, so that the acceleration is continuous at all times. `times` increase,
    /// one for each of the `points`.
    pub fn natural(times: Vec<f64>, points: Vec<Vector<D>>) -> Self {
        let mut accelerations = vec![Vector::zeros(); points.len()];
        if points.len() > 2 {
            let rows: Vec<Row<D>> = (1..points.len() - 1)
                .map(|k| {
                    Row::new(
                        &times[k - 1..=k + 1],
                        [&points[k - 1], &points[k], &points[k + 1]],
                    )
                })
                .collect();
            let inner = points.len() - 1;
            accelerations[1..inner].copy_from_slice(&solve(&rows));
        }
        Self {
            times,
            points,
            accelerations,
            periodic: false,
        }
    }

    /// The closed spline, run through again and again. `times` increase, one for each of the
    /// `points`, at least four, of which the last is the first again.
    pub fn periodic(times: Vec<f64>, points: Vec<Vector<D>>) -> Self {
        let legs = points.len().saturating_sub(1);
        if legs < 3 {
            // Too few to bend; no checked world comes here.
            return Self::natural(times, points);
        }
        let period = times[legs] - times[0];
        let rows: Vec<Row<D>> = (0..legs)
            .map(|k| {
                // Before the first point comes the last but one, a period earlier.
                let (before, earlier) = match k {
                    0 => (legs - 1, period),
                    _ => (k - 1, 0.0),
                };
                let times = [times[before] - earlier, times[k], times[k + 1]];
                Row::new(&times, [&points[before], &points[k], &points[k + 1]])
            })
            .collect();
        let mut accelerations = solve_cyclic(rows);
        accelerations.push(accelerations[0]);
        Self {
            times,
            points,
            accelerations,
            periodic: true,
        }
    }

    /// Place, velocity and acceleration at a time.
    pub fn at(&self, time: f64) -> Moment<D> {
        let last = self.times.len().saturating_sub(1);
        if last == 0 {
            let place = self.points.first().copied();
            return Moment::at_rest(place.unwrap_or_else(Vector::zeros));
        }
        let (begin, end) = (self.times[0], self.times[last]);
        let within = match self.periodic {
            true => begin + (time - begin).rem_euclid(end - begin),
            false => time.clamp(begin, end),
        };
        let after = self.times.partition_point(|known| *known <= within);
        let mut moment = self.on_leg(after.clamp(1, last) - 1, within);
        if !self.periodic && within != time {
            moment.position += moment.velocity * (time - within);
            moment.acceleration = Vector::zeros();
        }
        moment
    }

    /// On the leg from point `k` to the next.
    fn on_leg(&self, k: usize, time: f64) -> Moment<D> {
        let h = self.times[k + 1] - self.times[k];
        let b = (time - self.times[k]) / h;
        let a = 1.0 - b;
        let (from, to) = (self.points[k], self.points[k + 1]);
        let (first, second) = (self.accelerations[k], self.accelerations[k + 1]);
        let bend = first * (a * a * a - a) + second * (b * b * b - b);
        let turn = second * (3.0 * b * b - 1.0) - first * (3.0 * a * a - 1.0);
        Moment {
            position: from * a + to * b + bend * (h * h / 6.0),
            velocity: (to - from) / h + turn * (h / 6.0),
            acceleration: first * a + second * b,
        }
    }
}

/// One equation for the accelerations at a point and on either side of it:
/// before · M₋ + own · M + after · M₊ = right.
#[derive(Clone, Copy)]
struct Row<const D: usize> {
    before: f64,
    own: f64,
    after: f64,
    right: Vector<D>,
}

impl<const D: usize> Row<D> {
    /// That the velocity is continuous at the middle one of three points.
    fn new(times: &[f64], points: [&Vector<D>; 3]) -> Self {
        let [h, k] = [times[1] - times[0], times[2] - times[1]];
        Self {
            before: h,
            own: 2.0 * (h + k),
            after: k,
            right: ((points[2] - points[1]) / k - (points[1] - points[0]) / h) * 6.0,
        }
    }
}

/// Solves rows of which the first has no `before` and the last no `after`. They are diagonally
/// dominant, so elimination needs no pivots.
fn solve<const D: usize>(rows: &[Row<D>]) -> Vec<Vector<D>> {
    let mut rows = rows.to_vec();
    for k in 1..rows.len() {
        let factor = rows[k].before / rows[k - 1].own;
        rows[k].own -= factor * rows[k - 1].after;
        rows[k].right = rows[k].right - rows[k - 1].right * factor;
    }
    let mut next = Vector::zeros();
    let mut solution: Vec<Vector<D>> = (rows.iter().enumerate().rev())
        .map(|(k, row)| {
            let after = if k + 1 == rows.len() { 0.0 } else { row.after };
            next = (row.right - next * after) / row.own;
            next
        })
        .collect();
    solution.reverse();
    solution
}

/// Solves rows of which the first has the last before it, and the last the first after it: as
/// a change of rank one of rows without, by Sherman and Morrison.
fn solve_cyclic<const D: usize>(mut rows: Vec<Row<D>>) -> Vec<Vector<D>> {
    let last = rows.len() - 1;
    let (corner, other_corner) = (rows[0].before, rows[last].after);
    let gamma = -rows[0].own;
    rows[0].own -= gamma;
    rows[last].own -= corner * other_corner / gamma;
    let plain = solve(&rows);
    for (k, row) in rows.iter_mut().enumerate() {
        let value = match k {
            0 => gamma,
            _ if k == last => other_corner,
            _ => 0.0,
        };
        row.right = Vector::repeat(value);
    }
    let change = solve(&rows);
    let share = corner / gamma;
    let along = 1.0 + change[0][0] + share * change[last][0];
    let factor = (plain[0] + plain[last] * share) / along;
    let corrected = plain.iter().zip(&change);
    corrected
        .map(|(plain, change)| plain - factor * change[0])
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const TIMES: [f64; 5] = [0.0, 0.7, 1.1, 2.4, 3.0];

    fn points() -> Vec<Vector<2>> {
        [[0.0, 0.0], [1.0, -0.5], [0.5, 2.0], [3.0, 0.0], [0.0, 0.0]]
            .map(Vector::<2>::from)
            .to_vec()
    }

    fn jump(spline: &Spline<2>, time: f64) -> f64 {
        let (before, after) = (spline.at(time - 1e-9), spline.at(time + 1e-9));
        (before.position - after.position).norm()
            + (before.velocity - after.velocity).norm()
            + (before.acceleration - after.acceleration).norm()
    }

    #[test]
    fn points_are_met_and_nothing_jumps() {
        let natural = Spline::natural(TIMES.to_vec(), points());
        let periodic = Spline::periodic(TIMES.to_vec(), points());
        for spline in [natural, periodic] {
            for (time, point) in TIMES.iter().zip(points()) {
                assert!((spline.at(*time).position - point).norm() < 1e-14);
                assert!(jump(&spline, *time) < 1e-6, "{time}");
            }
        }
    }

    #[test]
    fn natural_ends_do_not_bend() {
        let spline = Spline::natural(TIMES.to_vec(), points());
        for time in [-5.0, 0.0, 3.0, 8.0] {
            assert!(spline.at(time).acceleration.norm() < 1e-14, "{time}");
        }
        assert_eq!(spline.at(-5.0).velocity, spline.at(0.0).velocity);
        assert!(spline.at(1.1).acceleration.norm() > 1.0);
        // Two points make a line.
        let line = Spline::natural(vec![1.0, 3.0], points()[..2].to_vec());
        assert!((line.at(2.0).position - points()[1] / 2.0).norm() < 1e-15);
    }

    #[test]
    fn periodic_splines_repeat_and_follow_a_circle() {
        let spline = Spline::periodic(TIMES.to_vec(), points());
        for k in 0..50 {
            let time = 0.0613 * f64::from(k);
            let (once, again) = (spline.at(time), spline.at(time + 6.0));
            assert!((once.position - again.position).norm() < 1e-12);
            assert!((once.acceleration - again.acceleration).norm() < 1e-10);
        }
        let turn = |k: usize| (k % 32) as f64 * std::f64::consts::TAU / 32.0;
        let times: Vec<f64> = (0..=32).map(|k| k as f64 / 32.0).collect();
        let ring = (0..=32).map(|k| Vector::<2>::new(turn(k).cos(), turn(k).sin()));
        let circle = Spline::periodic(times, ring.collect());
        for k in 0..200 {
            let moment = circle.at(0.0137 * f64::from(k));
            assert!((moment.position.norm() - 1.0).abs() < 1e-5);
            let centripetal = -moment.position * std::f64::consts::TAU.powi(2);
            assert!((moment.acceleration - centripetal).norm() < 0.2);
        }
    }
}

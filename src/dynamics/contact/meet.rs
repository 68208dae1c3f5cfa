//! When surfaces meet.
//!
//! Between convex bodies the plane through the nearest points of one, across the line to the
//! other, separates them. So they cannot meet before their ways along that line have used the
//! gap up: a step to that time is never too long (B. Mirtich, "Impulse-based dynamic simulation
//! of rigid body systems", 1996, §2.3). Without turning the gap along a straight way is convex in
//! time, the step is Newton's, and it converges quadratically. Two balls on straight ways
//! have a closed form.

use super::way::Way;
use crate::math::Vector;
use crate::shape::Separation;

/// Steps that a search takes at most. One that is not over by then has found no meeting: what
/// it leaves overlapping is found at the start of the next step.
const STEPS: usize = 1000;

/// Parts of a step at which surfaces that are near each other, or slide along each other, are
/// looked at; of the whole of it, or who is stopped again and again would never reach its end.
const SLIDING: f64 = 16.0;

/// Share of the size from which on a step is taken by the speed of the nearest points
/// themselves; it may end too late, and the meeting is then between.
const NEAR: f64 = 1e-2;

/// Share of their size by which bodies that do not bounce may sink into each other between two
/// looks.
const SINKS: f64 = 2e-3;

/// Share of a part of a step below which sliding is not looked at more closely.
const SHORTEST: f64 = 1e-6;

/// Speeds below this come to nothing before they bring anything anywhere: what bounces less and
/// less ends with them, not with the last bits of the smallest numbers.
const NOTHING: f64 = 1e-200;

/// Two bodies on their ways.
pub(super) struct Pair<'a, const D: usize> {
    /// Their ways.
    pub(super) ways: [&'a Way<D>; 2],
    /// Distance from each one's centre within which its surface lies, where it turns.
    pub(super) reaches: [f64; 2],
    /// Size of the smaller one.
    pub(super) size: f64,
    /// Their speeds before the first blow of the step, of which later ones keep the rounding.
    pub(super) speeds: f64,
    /// Whether they bounce. Those that do not may stay at each other, and are looked at less closely
    /// while they do.
    pub(super) bounces: bool,
}

/// What surfaces that are no farther apart than rounding tells are taken for: touching.
pub(super) fn tolerance<const D: usize>(size: f64, place: &Vector<D>) -> f64 {
    4e-13 * size + 8.0 * f64::EPSILON * place.amax()
}

/// The slowest approach that is told from none by bodies of some speed.
pub(super) fn slowest(speed: f64) -> f64 {
    (1e-13 * speed).max(NOTHING)
}

impl<const D: usize> Pair<'_, D> {
    /// How much their surfaces approach each other at a time, where they are nearest.
    pub(super) fn approach(&self, found: &Separation<D>, time: f64) -> f64 {
        let [one, other] = self.ways;
        let velocity = |way: &Way<D>, k: usize| match way.turns() {
            true => way.velocity_of(&found.points[k], time),
            false => way.velocity_at(time),
        };
        (velocity(one, 0) - velocity(other, 1)).dot(&found.normal)
    }

    /// The slowest approach that is told from none.
    pub(super) fn least(&self, time: f64) -> f64 {
        let speed = |way: &Way<D>, reach: f64| {
            way.velocity_at(time).amax() + way.spin.amax() * reach.min(1e100)
        };
        let [one, other] = self.ways;
        let now = speed(one, self.reaches[0]) + speed(other, self.reaches[1]);
        slowest(now.max(self.speeds))
    }

    /// The first time from `from` to `end` at which they touch and approach each other, and how
    /// they stand then. Touches that `counts` refuses are passed over.
    pub(super) fn meet(
        &self,
        from: f64,
        end: f64,
        separation: impl Fn(f64) -> Separation<D>,
        counts: impl Fn(f64, &Separation<D>) -> bool,
    ) -> Option<(f64, Separation<D>)> {
        let [one, other] = self.ways;
        let swing = |way: &Way<D>, reach: f64| match way.turns() {
            true => way.turning.norm() * reach,
            false => 0.0,
        };
        let swing = swing(one, self.reaches[0]) + swing(other, self.reaches[1]);
        let acceleration = one.acceleration - other.acceleration;
        let mut time = from;
        let mut found = separation(time);
        for _ in 0..STEPS {
            let tolerance = tolerance(self.size, &found.points[0]);
            let speed = (one.velocity_at(time) - other.velocity_at(time)).dot(&found.normal);
            let pull = acceleration.dot(&found.normal);
            if found.gap <= tolerance {
                let approach = self.approach(&found, time);
                if approach > self.least(time) && counts(time, &found) {
                    return Some((time, found));
                }
                if approach <= 0.0 && pull <= 0.0 && swing == 0.0 {
                    return None;
                }
                let part = end / SLIDING;
                let range = [time, (time + part).min(end)];
                (time, found) = self.slide(range, (&found, tolerance), &separation);
            } else {
                let gap = found.gap - 0.5 * tolerance;
                let step = first_root(gap, speed + swing, pull)?;
                if swing > 0.0 && found.gap < NEAR * self.size {
                    let newton = first_root(gap, self.approach(&found, time), pull);
                    let part = end / SLIDING;
                    let farthest = time + newton.unwrap_or(part).min(part).max(step);
                    let range = [time, farthest.min(end)];
                    let here = (&found, tolerance);
                    (time, found) = self.between(range, here, &separation);
                    if time >= end && found.gap > tolerance {
                        return None;
                    }
                    continue;
                }
                // A step too short to be told from none must not be taken for ever.
                time += step.max(f64::EPSILON * end);
                found = separation(time);
            }
            if time >= end {
                return None;
            }
        }
        None
    }

    /// A later time at which surfaces that touch do so still, or no longer; sooner than the last
    /// one where they would sink into each other meanwhile.
    fn slide(
        &self,
        [from, to]: [f64; 2],
        (found, tolerance): (&Separation<D>, f64),
        separation: &impl Fn(f64) -> Separation<D>,
    ) -> (f64, Separation<D>) {
        let sunk = found.gap < -tolerance;
        let deeper = match self.bounces {
            true => tolerance,
            false => SINKS * self.size,
        };
        let mut part = to - from;
        loop {
            let then = separation(from + part);
            let sinks = found.gap.min(0.0) - then.gap;
            let loose = self.bounces && sunk;
            if loose || sinks <= deeper || part <= SHORTEST * (to - from) {
                return (from + part, then);
            }
            // They sink in with the square of the time.
            part *= (0.8 * (deeper / sinks).sqrt()).min(0.5);
        }
    }

    /// A time in a range, after its start, at which the gap that is found there is not yet used up,
    /// or just is.
    fn between(
        &self,
        [from, to]: [f64; 2],
        (before, tolerance): (&Separation<D>, f64),
        separation: &impl Fn(f64) -> Separation<D>,
    ) -> (f64, Separation<D>) {
        let after = separation(to);
        let (mut high, mut sunk) = (to, after.gap);
        if after.gap >= -tolerance {
            if after.gap <= tolerance || !self.dips([from, to], [before, &after]) {
                return (to, after);
            }
            // They were nearer to each other meanwhile.
            match self.nearest([from, to], tolerance, separation) {
                Some(nearest) => (high, sunk) = nearest,
                None => return (to, after),
            }
        }
        // False position, halving the end that stays (the Illinois rule).
        let (mut low, mut clear) = (from, before.gap);
        let mut stays = 0.0;
        while high - low > f64::EPSILON * high {
            let guess = low + (high - low) * (clear / (clear - sunk));
            let middle = match guess > low && guess < high {
                true => guess,
                false => 0.5 * (low + high),
            };
            let found = separation(middle);
            if found.gap.abs() <= tolerance {
                return (middle, found);
            }
            if found.gap > 0.0 {
                (low, clear) = (middle, found.gap);
                sunk *= if stays > 0.0 { 0.5 } else { 1.0 };
            } else {
                (high, sunk) = (middle, found.gap);
                clear *= if stays < 0.0 { 0.5 } else { 1.0 };
            }
            stays = found.gap;
            if middle == low && middle == high {
                break;
            }
        }
        (high, separation(high))
    }

    /// Whether surfaces that are apart at both ends of a range may meet in it: where they approach
    /// each other at its start and part at its end, so that the tangents of the gap, less what
    /// turning may bend it, come to nothing.
    fn dips(&self, [from, to]: [f64; 2], [before, after]: [&Separation<D>; 2]) -> bool {
        let (falls, rises) = (self.approach(before, from), -self.approach(after, to));
        if falls <= 0.0 || rises <= 0.0 {
            return false;
        }
        let part = to - from;
        let meet = (before.gap - after.gap + rises * part) / (falls + rises);
        let bends = |k: usize| self.ways[k].turning.norm_squared() * self.reaches[k];
        let bent = 0.5 * (bends(0) + bends(1)) * part * part;
        before.gap - falls * meet.clamp(0.0, part) <= bent
    }

    /// A time in a range, at whose start surfaces approach each other and at whose end they part,
    /// when they overlap, and the gap then.
    fn nearest(
        &self,
        [mut low, mut high]: [f64; 2],
        tolerance: f64,
        separation: &impl Fn(f64) -> Separation<D>,
    ) -> Option<(f64, f64)> {
        while high - low > 1e-9 * high {
            let middle = 0.5 * (low + high);
            let found = separation(middle);
            if found.gap < -tolerance {
                return Some((middle, found.gap));
            }
            match self.approach(&found, middle) > 0.0 {
                true => low = middle,
                false => high = middle,
            }
        }
        None
    }
}

/// The first time at which a gap is used up by an approach that accelerates; nothing if never.
fn first_root(gap: f64, speed: f64, pull: f64) -> Option<f64> {
    // gap = speed t + pull t²/2
    let root = speed * speed + 2.0 * pull * gap;
    if root < 0.0 {
        return None;
    }
    let sum = speed + root.sqrt();
    (sum > 0.0).then(|| 2.0 * gap / sum)
}

/// The time from now after which two balls on straight ways touch, given the way from one to
/// the other, the velocity of the one against the other, and the distance at which they
/// touch; 0 where they touch already, nothing where they never do.
pub(super) fn balls<const D: usize>(
    apart: &Vector<D>,
    velocity: &Vector<D>,
    touching: f64,
) -> Option<f64> {
    let along = apart.dot(velocity);
    if along <= 0.0 {
        return None;
    }
    let distance = apart.norm();
    let outside = (distance - touching) * (distance + touching);
    if outside <= 0.0 {
        return Some(0.0);
    }
    let squared = velocity.norm_squared();
    // How far the one passes the other's centre by.
    let miss = (apart - velocity * (along / squared)).norm();
    if miss > touching {
        return None;
    }
    let root = (squared * (touching - miss) * (touching + miss)).sqrt();
    Some(outside / (along + root))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn balls_meet_as_on_paper() {
        let apart = Vector::<2>::new(3.0, 4.0);
        // Head-on: the gap of 5 − 1 at speed 2.
        let time = balls(&apart, &(apart / 5.0 * 2.0), 1.0);
        assert!((time.expect("they meet") - 2.0).abs() < 1e-15);
        // Passing at a distance of 1.0000001, and 0.9999999.
        let pass = |miss: f64| {
            balls(
                &Vector::<2>::new(7.0, miss),
                &Vector::<2>::new(1.0, 0.0),
                1.0,
            )
        };
        assert_eq!(pass(1.000_000_1), None);
        let expected = 7.0 - (1.0f64 - 0.999_999_9 * 0.999_999_9).sqrt();
        assert!((pass(0.999_999_9).expect("they meet") - expected).abs() < 1e-9);
        assert_eq!(balls(&apart, &-apart, 1.0), None);
        assert_eq!(balls(&apart, &apart, 6.0), Some(0.0));
    }

    #[test]
    fn a_gap_is_used_up_when_it_is() {
        assert_eq!(first_root(2.0, 1.0, 0.0), Some(2.0));
        assert_eq!(first_root(2.0, 0.0, 1.0), Some(2.0));
        assert_eq!(first_root(2.0, -1.0, 0.0), None);
        // Up against gravity, and not up to the ceiling.
        assert_eq!(first_root(2.0, 1.0, -1.0), None);
        let time = first_root(0.5, -1.0, 2.0).expect("it comes back");
        assert!((-time + time * time - 0.5).abs() < 1e-15);
    }
}

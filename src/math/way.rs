//! The way between two states that are a step apart.

use super::Vector;

/// How often the place of the nearest point is bettered; each time the error is about squared.
const ROUNDS: usize = 12;

/// A way through a step: the cubic with these positions and velocities at its ends, of fourth
/// order in the step where nothing strikes on the way. As a Bézier curve it stays in the hull of
/// its four points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Way<const D: usize> {
    points: [Vector<D>; 4],
}

impl<const D: usize> Way<D> {
    /// The way between two positions, at these velocities at its ends, in this time.
    pub fn new(positions: [Vector<D>; 2], velocities: [Vector<D>; 2], time: f64) -> Self {
        let third = time / 3.0;
        let [from, to] = positions;
        let points = [
            from,
            from + velocities[0] * third,
            to - velocities[1] * third,
            to,
        ];
        Self { points }
    }

    /// The way as seen from who goes another way.
    pub fn seen_from(&self, other: &Self) -> Self {
        let mut points = self.points;
        for (point, from) in points.iter_mut().zip(&other.points) {
            *point -= from;
        }
        Self { points }
    }

    /// The points in whose hull it stays; the first and the last are its ends.
    pub fn points(&self) -> &[Vector<D>; 4] {
        &self.points
    }

    /// Where it is after this share of the time.
    pub fn at(&self, share: f64) -> Vector<D> {
        let [a, b, c, d] = &self.points;
        let rest = 1.0 - share;
        a * (rest * rest * rest)
            + b * (3.0 * rest * rest * share)
            + c * (3.0 * rest * share * share)
            + d * (share * share * share)
    }

    /// How fast it goes there, in lengths for the whole time.
    pub fn rate(&self, share: f64) -> Vector<D> {
        let [a, b, c, d] = &self.points;
        let rest = 1.0 - share;
        ((b - a) * (rest * rest) + (c - b) * (2.0 * rest * share) + (d - c) * (share * share)) * 3.0
    }

    /// How near it comes to the origin, and after which share of the time: at its ends, or at the
    /// place in between up to which it approaches.
    pub fn nearest(&self) -> (f64, f64) {
        let slope = |share| self.at(share).dot(&self.rate(share));
        let ends = [(self.points[0].norm(), 0.0), (self.points[3].norm(), 1.0)];
        let inside = turn(slope).map(|share| (self.at(share).norm(), share));
        let mut nearest = ends[0];
        for place in inside.into_iter().chain([ends[1]]) {
            if place.0 < nearest.0 {
                nearest = place;
            }
        }
        nearest
    }
}

/// Where between 0 and 1 a slope that is negative at first and positive in the end is zero;
/// nothing for other slopes. By false position, each end that stays being halved (Illinois).
pub fn turn(slope: impl Fn(f64) -> f64) -> Option<f64> {
    let (mut low, mut high) = (0.0, 1.0);
    let (mut falling, mut rising) = (slope(low), slope(high));
    if !(falling < 0.0 && rising > 0.0) {
        return None;
    }
    let mut share = 0.5;
    let mut before = 0.0;
    for _ in 0..ROUNDS {
        share = (low * rising - high * falling) / (rising - falling);
        let found = slope(share);
        if found == 0.0 {
            break;
        }
        if found < 0.0 {
            (low, falling) = (share, found);
            rising *= if before < 0.0 { 0.5 } else { 1.0 };
        } else {
            (high, rising) = (share, found);
            falling *= if before > 0.0 { 0.5 } else { 1.0 };
        }
        before = found;
    }
    Some(share)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn way(numbers: [[f64; 2]; 4], time: f64) -> Way<2> {
        let [a, b, c, d] = numbers.map(Vector::from);
        Way::new([a, b], [c, d], time)
    }

    #[test]
    fn a_straight_way_passes_where_geometry_says() {
        let way = way([[-3.0, 2.0], [5.0, 2.0], [8.0, 0.0], [8.0, 0.0]], 1.0);
        let (distance, share) = way.nearest();
        assert!((distance - 2.0).abs() < 1e-15 && (share - 0.375).abs() < 1e-9);
    }

    #[test]
    fn a_parabola_is_followed() {
        // x = t, y = 1 − t + t² over [0, 2]: nearest where x + y y' = 0.
        let way = way([[0.0, 1.0], [2.0, 3.0], [1.0, -1.0], [1.0, 3.0]], 2.0);
        let half = way.at(0.25);
        assert!(
            (half - Vector::<2>::new(0.5, 0.75)).norm() < 1e-15,
            "{half}"
        );
        let (distance, share) = way.nearest();
        let t = 2.0 * share;
        let slope = t + (1.0 - t + t * t) * (2.0 * t - 1.0);
        assert!(slope.abs() < 1e-9, "{slope}");
        assert!((distance - 0.845).abs() < 1e-4, "{distance}");
    }

    #[test]
    fn who_only_leaves_or_comes_is_nearest_at_an_end() {
        let leaves = way([[1.0, 0.0], [2.0, 0.0], [1.0, 0.0], [1.0, 0.0]], 1.0);
        assert_eq!(leaves.nearest(), (1.0, 0.0));
        let comes = way([[2.0, 0.0], [1.0, 0.0], [-1.0, 0.0], [-1.0, 0.0]], 1.0);
        assert_eq!(comes.nearest(), (1.0, 1.0));
        let rests = way([[2.0, 0.0], [2.0, 0.0], [0.0, 0.0], [0.0, 0.0]], 1.0);
        assert_eq!(rests.nearest(), (2.0, 0.0));
    }

    proptest! {
        /// Nothing on a nearly straight way is nearer than what is found, and all of it lies
        /// within reach of its points.
        #[test]
        fn nothing_on_the_way_is_nearer(
            from in prop::array::uniform2(-3.0..3.0f64),
            velocity in prop::array::uniform2(-5.0..5.0f64),
            bend in prop::array::uniform2(-0.1..0.1f64),
        ) {
            let [start, velocity, bend]: [Vector<2>; 3] = [from, velocity, bend].map(Vector::from);
            let way = Way::new([start, start + velocity], [velocity - bend, velocity + bend], 1.0);
            let (nearest, share) = way.nearest();
            prop_assert!((way.at(share).norm() - nearest).abs() < 1e-12);
            for k in 0..=1000 {
                let place = way.at(f64::from(k) / 1000.0);
                prop_assert!(place.norm() >= nearest - 1e-6, "{} {nearest}", place.norm());
            }
        }
    }
}

//! Which pairs count as within the distances at which laws jump, and how near that is to changing.
//!
//! Between two jumps every pair is held on its side of each distance, wherever the stages of a step
//! take it. Pairs that are near a distance are watched; while nobody has moved far since the list
//! was made, no other pair can have come to it.

use super::course::{first_root, quintic};
use super::watched::{LOOKS, Side, Watched};
use crate::math::Vector;
use crate::sense::{Cells, Hold};

/// Pairs are watched that are nearer to a distance than this share of it, at first.
const SKIN: f64 = 0.05;

/// The largest such share: who moves farther in one step must take shorter ones.
const THICKEST: f64 = 8.0;

/// How far beyond a distance a pair must be to have crossed it, in roundings of its square.
const SLACK: f64 = 16.0 * f64::EPSILON;

/// The pairs near each of some distances, at which laws jump.
#[derive(Debug, Default)]
pub(super) struct Links<const D: usize> {
    distances: Vec<f64>,
    /// By distance, then by pair.
    watched: Vec<Watched>,
    /// Where the agents were when the list was made, and up to what share of a distance from it.
    reference: Vec<Vector<D>>,
    skin: f64,
    /// What rounding may do to an excess.
    slack: f64,
    /// The pair that is about to cross, by its place in the list.
    next: Option<usize>,
    patience: f64,
    cells: Cells<D>,
}

impl<const D: usize> Links<D> {
    /// Without any pair yet.
    pub fn new(distances: &[f64]) -> Self {
        Self {
            distances: distances.to_vec(),
            ..Self::default()
        }
    }

    /// Whether there is nothing to look for.
    pub fn is_empty(&self) -> bool {
        self.distances.is_empty()
    }

    /// Notes the pairs as they are, at the start of a step of the world; of those that slide it
    /// is known.
    pub fn settle(&mut self, positions: &[Vector<D>], sliding: &[([u32; 2], f64)]) {
        self.watched.clear();
        self.reference.clear();
        self.reference.extend_from_slice(positions);
        let far = positions.iter().map(Vector::amax).fold(0.0, f64::max);
        let near = self.distances.iter().copied().fold(f64::INFINITY, f64::min);
        self.slack = SLACK * (1.0 + far / near);
        self.next = None;
        self.list(SKIN);
        for one in &mut self.watched {
            if sliding.contains(&(one.pair, one.distance)) {
                one.side = Side::Sliding;
            }
        }
    }

    /// Makes the list anew around the same reference; what is known of pairs is kept.
    fn list(&mut self, skin: f64) {
        let before = std::mem::take(&mut self.watched);
        self.next = None;
        self.skin = skin;
        for &distance in &self.distances {
            let reach = (1.0 + skin) * distance;
            let least = (1.0 - skin).max(0.0) * distance;
            let begin = self.watched.len();
            let square = distance * distance;
            self.cells.rebuild(&self.reference, reach);
            let watched = &mut self.watched;
            each_pair(&self.cells, reach, |pair, squared| {
                if squared >= least * least {
                    // A pair at the very distance counts as within, for laws as well.
                    watched.push(Watched::new(pair, distance, squared <= square));
                }
            });
            self.watched[begin..].sort_unstable_by_key(|one| one.pair);
        }
        for known in before {
            let key = |one: &Watched| (one.distance, one.pair);
            let order = |one: &Watched| {
                let (a, b) = (key(one), key(&known));
                a.0.total_cmp(&b.0).then(a.1.cmp(&b.1))
            };
            if let Ok(place) = self.watched.binary_search_by(order) {
                self.watched[place] = known;
            }
        }
    }

    /// Sees to it that all pairs are watched that may have come to a distance. False where
    /// agents have gone too far for that, or are nowhere.
    pub fn follow(&mut self, positions: &[Vector<D>]) -> bool {
        let least = self.distances.iter().copied().fold(f64::INFINITY, f64::min);
        let ways = positions.iter().zip(&self.reference);
        let way = ways.map(|(x, from)| (x - from).norm_squared());
        let longer = |a: f64, b: f64| if a.is_nan() || b <= a { a } else { b };
        let way = way.fold(0.0, longer).sqrt();
        let wanted = 2.0 * way / least;
        if wanted <= self.skin {
            return true;
        }
        // Also where it is no number.
        let watched = wanted <= THICKEST;
        if watched {
            self.list(f64::min(2.0 * wanted, THICKEST));
        }
        watched
    }

    /// The same where a step has ended, with the list made around where the agents are now if
    /// they are far from where they were.
    pub fn arrive(&mut self, time: f64, positions: &[Vector<D>]) -> bool {
        let mut changed = false;
        for one in &mut self.watched {
            let Some(until) = one.blurred.filter(|_| one.side != Side::Sliding) else {
                continue;
            };
            let side = Side::of(one.excess(positions) <= 0.0);
            changed |= side != one.side;
            one.side = side;
            if time >= until {
                (one.blurred, one.crossings) = (None, 0);
            }
        }
        let least = self.distances.iter().copied().fold(f64::INFINITY, f64::min);
        let ways = positions.iter().zip(&self.reference);
        let way = ways.map(|(x, from)| (x - from).norm_squared());
        let way = way.fold(0.0, f64::max).sqrt();
        if 4.0 * way > self.skin * least {
            // Who was not watched is on the side on which it is.
            self.reference.copy_from_slice(positions);
            self.list(SKIN.max(8.0 * way / least).min(THICKEST));
        }
        changed
    }

    /// How far the next pair is from crossing, as a share of the distance's square; negative once
    /// one has.
    pub fn margin(&self, positions: &[Vector<D>]) -> f64 {
        let counting = self.watched.iter().filter(|one| one.counts());
        let margins = counting.map(|one| one.sign() * one.excess(positions) + self.slack);
        margins.fold(f64::INFINITY, f64::min)
    }

    /// Writes down the pairs that are not on the side that their distance tells, for laws to
    /// hold them.
    pub fn hold(&self, positions: &[Vector<D>], holds: &mut Vec<Hold>) {
        for one in &self.watched {
            let within = one.excess(positions) <= 0.0;
            let share = match one.side {
                Side::Within if !within => 1.0,
                Side::Beyond if within => 0.0,
                _ => continue,
            };
            holds.push(one.held(share));
        }
    }

    /// About how long it takes to the next crossing, from positions, velocities and
    /// accelerations; or to where pairs are to be looked at.
    pub fn foresee(&mut self, state: [&[Vector<D>]; 3]) -> f64 {
        self.next = None;
        let mut least = f64::INFINITY;
        for (place, one) in self.watched.iter().enumerate() {
            if !one.counts() || one.faint {
                continue;
            }
            let [value, rate, bend] = one.course(state).map(|it| it * one.sign());
            // What rounding has taken beyond is before, as long as it is not said to be beyond.
            let value = f64::max(value + self.slack, f64::MIN_POSITIVE);
            if let Some(time) = first_root([value, rate, bend])
                && time < least
            {
                (least, self.next) = (time, Some(place));
            }
        }
        let patience = self.patience();
        if patience < least {
            (least, self.next) = (patience, None);
        }
        least
    }

    /// How long ago the first of the pairs that have crossed did so.
    pub fn hindsight(&mut self, state: [&[Vector<D>]; 3]) -> Option<f64> {
        self.next = None;
        let mut longest = None;
        for (place, one) in self.watched.iter().enumerate() {
            if !one.counts() {
                continue;
            }
            let [value, rate, bend] = one.course(state).map(|it| it * one.sign());
            let value = value + self.slack;
            if value < 0.0 {
                // None where it turns round too soon: then long ago.
                let ago = first_root([-value, rate, -bend]).unwrap_or(f64::INFINITY);
                if longest.is_none_or(|longest| ago > longest) {
                    (longest, self.next) = (Some(ago), Some(place));
                }
            }
        }
        longest
    }

    /// When a pair that is before a distance at both ends of a step may have been beyond.
    pub fn dip(&self, step: f64, begin: [&[Vector<D>]; 3], end: [&[Vector<D>]; 3]) -> Option<f64> {
        let mut first: Option<f64> = None;
        for one in &self.watched {
            if !one.counts() || one.faint {
                continue;
            }
            let [a, da, dda] = one.course(begin).map(|it| it * one.sign());
            let [b, db, ddb] = one.course(end).map(|it| it * one.sign());
            if !(da < 0.0 && db > 0.0) {
                continue;
            }
            let path = quintic(step, [a, da, 2.0 * dda], [b, db, 2.0 * ddb]);
            let shares = (1..64).map(|k| f64::from(k) / 64.0);
            let values = shares.map(|share| (share, path(share)));
            let Some((share, least)) = values.min_by(|a, b| a.1.total_cmp(&b.1)) else {
                continue;
            };
            if least + self.slack < 1e-3 * f64::min(a, b) {
                let time = share * step;
                first = Some(first.map_or(time, |first| first.min(time)));
            }
        }
        first
    }

    /// Takes the pair that is about to cross, and those that have crossed, to the other side;
    /// returns their places in the list. See [`Watched::cross`].
    pub fn cross(
        &mut self,
        [time, free]: [f64; 2],
        positions: &[Vector<D>],
        faint: bool,
    ) -> Vec<usize> {
        let next = self.next.take();
        let mut crossed = Vec::new();
        for (place, one) in self.watched.iter_mut().enumerate() {
            let margin = one.sign() * one.excess(positions) + self.slack;
            if one.counts() && (next == Some(place) || margin < 0.0) {
                one.cross(time, free, faint);
                crossed.push(place);
                if one.blurred.is_some() {
                    self.patience = LOOKS * free;
                }
            }
        }
        crossed
    }

    /// The pairs near a distance.
    pub fn watched(&self) -> &[Watched] {
        &self.watched
    }

    /// Puts a pair on a side.
    pub fn put(&mut self, place: usize, side: Side) {
        self.watched[place].side = side;
    }

    /// The places of the pairs that slide.
    pub fn sliding(&self) -> Vec<usize> {
        let places = self.watched.iter().enumerate();
        let sliding = places.filter(|(_, one)| one.side == Side::Sliding);
        sliding.map(|(place, _)| place).collect()
    }

    /// How soon to look at pairs whose crossings are not waited for; infinite where there are none.
    fn patience(&self) -> f64 {
        match self.watched.iter().any(|one| one.blurred.is_some()) {
            true => self.patience,
            false => f64::INFINITY,
        }
    }
}

/// Calls `visit` with each pair of agents within a distance, and the square of theirs.
fn each_pair<const D: usize>(
    cells: &Cells<D>,
    distance: f64,
    mut visit: impl FnMut([u32; 2], f64),
) {
    let (order, positions) = (cells.order(), cells.sorted());
    for (place, position) in positions.iter().enumerate() {
        cells.for_each_within(position, distance, |other, _, squared| {
            if order[place] < order[other] {
                visit([order[place], order[other]], squared);
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(places: [f64; 3]) -> Vec<Vector<2>> {
        places.map(|x| Vector::<2>::new(x, 0.0)).to_vec()
    }

    #[test]
    fn pairs_are_held_until_they_are_said_to_cross() {
        let mut links = Links::<2>::new(&[2.0]);
        links.settle(&row([0.0, 1.95, 4.0]), &[]);
        let margin = |links: &mut Links<2>, places| {
            assert!(links.follow(&row(places)));
            links.margin(&row(places))
        };
        let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-13, "{a} {b}");
        near(
            margin(&mut links, [0.0, 1.95, 4.0]),
            1.0 - 1.95f64.powi(2) / 4.0,
        );
        // Beyond from within, by any way; the other pair comes near as well.
        near(margin(&mut links, [0.0, 2.2, 4.3]), -0.21);
        let mut holds = Vec::new();
        links.hold(&row([0.0, 2.2, 4.3]), &mut holds);
        let held = |pair, share| Hold {
            pair,
            distance: 2.0,
            share,
        };
        assert_eq!(holds, [held([0, 1], 1.0)]);
        holds.clear();
        links.hold(&row([0.0, 1.95, 3.9]), &mut holds);
        assert_eq!(holds, [held([1, 2], 0.0)]);
        assert_eq!(
            links.cross([0.0, 1.0], &row([0.0, 1.95, 3.9]), false).len(),
            1
        );
        holds.clear();
        links.hold(&row([0.0, 1.95, 3.9]), &mut holds);
        assert_eq!(holds, []);
        assert!(!links.follow(&row([0.0, 2.0, 1e3])));
        assert!(!links.follow(&row([0.0, 2.0, f64::NAN])));
    }

    #[test]
    fn crossings_are_foreseen_and_dated() {
        let mut links = Links::<2>::new(&[2.0]);
        let still = row([0.0; 3]);
        let rates = row([0.0, 0.5, 0.0]);
        links.settle(&row([0.0, 1.9, 9.0]), &[]);
        let start = row([0.0, 1.9, 9.0]);
        let time = links.foresee([&start, &rates, &still]);
        assert!((time - 0.2).abs() < 1e-12, "{time}");
        let later = row([0.0, 2.05, 9.0]);
        let ago = links.hindsight([&later, &rates, &still]);
        assert!(ago.is_some_and(|ago| (ago - 0.1).abs() < 1e-12), "{ago:?}");
        // Out and back: to 2.025 at most.
        let back = row([0.0, -0.5, 0.0]);
        let turning = row([0.0, -1.0, 0.0]);
        let end = row([0.0, 1.9, 9.0]);
        let dip = links.dip(1.0, [&start, &rates, &turning], [&end, &back, &turning]);
        assert!(dip.is_some_and(|dip| (dip - 0.5).abs() < 0.02), "{dip:?}");
    }
}

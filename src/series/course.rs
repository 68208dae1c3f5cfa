//! Points along a run, thinned while they come.

/// How many points in a row are looked at together when they get too many.
const BUCKET: usize = 8;

/// Points along a run, in their order, with gaps where there were none.
///
/// When they get too many, of every eight in a row those stay that lie farthest to the left,
/// right, bottom and top, and one gap: so a quantity over time keeps its extremes. The first and
/// the last point always stay.
#[derive(Debug, Clone, PartialEq)]
pub struct Course {
    points: Vec<Option<[f64; 2]>>,
    most: usize,
}

impl Default for Course {
    fn default() -> Self {
        Self::of_at_most(Self::MOST)
    }
}

impl Course {
    /// The least bound of points.
    pub const LEAST: usize = 64;
    /// The largest bound of points, that of [`Course::default`]: several for each pixel of a wide
    /// picture.
    pub const MOST: usize = 1 << 14;

    /// One that keeps so many points and gaps, or [`LEAST`](Self::LEAST) where these are more, or
    /// [`MOST`](Self::MOST) where these are fewer.
    pub fn of_at_most(points: usize) -> Self {
        Self {
            points: Vec::new(),
            most: points.clamp(Self::LEAST, Self::MOST),
        }
    }

    /// Adds a point, or a gap.
    pub fn push(&mut self, point: Option<[f64; 2]>) {
        let gap = point.is_none();
        if gap && self.points.last().is_none_or(Option::is_none) {
            return;
        }
        if self.points.len() == self.most {
            self.thin();
        }
        self.points.push(point);
    }

    /// The points so far; `None` is a gap.
    pub fn points(&self) -> &[Option<[f64; 2]>] {
        &self.points
    }

    /// The points without the gaps.
    pub fn known(&self) -> impl DoubleEndedIterator<Item = [f64; 2]> + '_ {
        self.points.iter().flatten().copied()
    }

    /// Whether there is no point.
    pub fn is_empty(&self) -> bool {
        self.known().next().is_none()
    }

    /// Halves the points, about.
    fn thin(&mut self) {
        let ends = [
            self.points.iter().position(Option::is_some),
            self.points.iter().rposition(Option::is_some),
        ];
        let mut kept: Vec<Option<[f64; 2]>> = Vec::with_capacity(self.most);
        for (k, bucket) in self.points.chunks(BUCKET).enumerate() {
            let first = k * BUCKET;
            let mut places = extremes(bucket);
            places.extend(bucket.iter().position(Option::is_none));
            let ends = ends
                .iter()
                .flatten()
                .filter_map(|end| end.checked_sub(first));
            places.extend(ends.filter(|place| *place < bucket.len()));
            places.sort_unstable();
            places.dedup();
            kept.extend(places.into_iter().map(|place| bucket[place]));
        }
        self.points = kept;
    }
}

/// The places of those points that lie farthest to the left, right, bottom and top.
fn extremes(bucket: &[Option<[f64; 2]>]) -> Vec<usize> {
    let known = || {
        bucket
            .iter()
            .enumerate()
            .filter_map(|(k, it)| Some((k, (*it)?)))
    };
    let mut places = Vec::with_capacity(BUCKET);
    for axis in 0..2 {
        let order = |a: &(usize, [f64; 2]), b: &(usize, [f64; 2])| a.1[axis].total_cmp(&b.1[axis]);
        places.extend(known().min_by(order).map(|it| it.0));
        places.extend(known().max_by(order).map(|it| it.0));
    }
    places
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn course(values: impl Iterator<Item = f64>) -> Course {
        let mut course = Course::default();
        for (k, value) in values.enumerate() {
            course.push(Some([k as f64, value]));
        }
        course
    }

    #[test]
    fn gaps_stay_and_are_not_doubled() {
        let mut course = Course::default();
        for point in [None, Some([0.0, 1.0]), None, None, Some([1.0, 2.0])] {
            course.push(point);
        }
        assert_eq!(course.points(), [Some([0.0, 1.0]), None, Some([1.0, 2.0])]);
    }

    /// Gaps cannot keep a course from being thinned.
    #[test]
    fn courses_full_of_gaps_are_short() {
        let mut course = Course::of_at_most(0);
        for k in 0..10_000 {
            course.push((k % 2 == 0).then_some([f64::from(k), 0.0]));
            assert!(course.points().len() <= Course::LEAST);
        }
        assert!(course.points().contains(&None));
        let known: Vec<_> = course.known().collect();
        assert_eq!((known[0][0], known[known.len() - 1][0]), (0.0, 9998.0));
    }

    /// A spiral begins and ends within what its turns reach.
    #[test]
    fn first_and_last_points_stay() {
        let point = |k: u32| {
            let turn = f64::from(k) * 0.7;
            let far = 1.0 + turn * (600.0 - turn);
            [far * turn.cos(), far * turn.sin()]
        };
        let mut course = Course::of_at_most(Course::LEAST);
        for k in 0..800 {
            course.push(Some(point(k)));
            assert_eq!(course.known().next(), Some(point(0)));
            assert_eq!(course.known().next_back(), Some(point(k)));
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(16))]

        /// However long a run is, its course is short and reaches as far.
        #[test]
        fn extremes_are_kept(
            seed in 0..u64::MAX,
            count in 1..6 * Course::MOST,
            spikes in prop::collection::vec((0..6 * Course::MOST, -9.0..9.0_f64), 4),
        ) {
            let noise = |k: usize| (seed.wrapping_mul(k as u64 * 2 + 1) >> 40) as f64 / 2_f64.powi(24);
            let spike = |k: usize| spikes.iter().find(|it| it.0 == k).map_or(0.0, |it| it.1);
            let values: Vec<f64> = (0..count).map(|k| noise(k) + spike(k)).collect();
            let course = course(values.iter().copied());
            prop_assert!(course.points().len() <= Course::MOST);
            prop_assert!(course.points().len() >= count.min(Course::MOST / 5));
            let least = |values: &mut dyn Iterator<Item = f64>| values.fold(f64::INFINITY, f64::min);
            prop_assert_eq!(
                least(&mut course.known().map(|it| it[1])), least(&mut values.iter().copied())
            );
            prop_assert_eq!(
                least(&mut course.known().map(|it| -it[1])), least(&mut values.iter().map(|it| -it))
            );
            let times: Vec<f64> = course.known().map(|it| it[0]).collect();
            prop_assert!(times.windows(2).all(|two| two[0] < two[1]));
            prop_assert_eq!((times[0], times[times.len() - 1]), (0.0, (count - 1) as f64));
        }
    }
}

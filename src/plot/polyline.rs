//! Lines through many points, drawn by few.

/// Pixels that a line may be off: too little to see, even enlarged.
const OFF: f64 = 0.05;

/// The points of a line, in pixels, without those that can be left out: where they were, it is
/// no more than a twentieth of a pixel off. It keeps the first and the last, and turns wherever
/// the line turns back, so that what is leftmost or highest stays so to that.
///
/// Between two points kept, the directions from the first to all points on the way lie in one
/// wedge, that of the circles of this radius about them: H. Imai and M. Iri's cone
/// intersection, as in J. Sklansky and V. Gonzalez, "Fast polygonal approximation of digitized
/// curves", 1980.
pub fn thin(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut kept: Vec<[f64; 2]> = Vec::new();
    let mut last: Option<[f64; 2]> = None;
    let mut wedge = Wedge::default();
    for &point in points {
        let Some(&anchor) = kept.last() else {
            kept.push(point);
            continue;
        };
        let mut way = minus(point, anchor);
        if !wedge.passes(way)
            && let Some(before) = last
        {
            kept.push(before);
            way = minus(point, before);
            wedge = Wedge::default();
        }
        wedge.narrow(way);
        last = Some(point);
    }
    kept.extend(last);
    kept
}

/// Directions from a point that pass all points seen since.
#[derive(Default)]
struct Wedge {
    /// Its sides: the one to the right, the one to the left; all directions without.
    sides: Option<[[f64; 2]; 2]>,
    /// Distance of the farthest point seen.
    far: f64,
}

impl Wedge {
    /// Whether a line to a point that is this way would pass all points seen.
    fn passes(&self, way: [f64; 2]) -> bool {
        let within = self
            .sides
            .is_none_or(|[right, left]| cross(right, way) >= 0.0 && cross(way, left) >= 0.0);
        within && length(way) >= self.far
    }

    /// Leaves only directions that pass a point that is this way.
    fn narrow(&mut self, way: [f64; 2]) {
        let distance = length(way);
        self.far = self.far.max(distance);
        if distance <= OFF {
            return;
        }
        let sine = OFF / distance;
        let cosine = (1.0 - sine * sine).sqrt();
        let [x, y] = way;
        let turned = |sine: f64| [cosine * x - sine * y, cosine * y + sine * x];
        let (mut right, mut left) = (turned(-sine), turned(sine));
        if let Some([old_right, old_left]) = self.sides {
            if cross(right, old_right) > 0.0 {
                right = old_right;
            }
            if cross(old_left, left) > 0.0 {
                left = old_left;
            }
        }
        self.sides = Some([right, left]);
    }
}

fn minus(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

fn length([x, y]: [f64; 2]) -> f64 {
    x.hypot(y)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn straight_lines_need_two_points() {
        let line: Vec<_> = (0..500).map(|k| [k as f64, 3.0 * k as f64]).collect();
        assert_eq!(thin(&line), [line[0], line[499]]);
        let corner = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 9.0], [4.0, 9.0]];
        assert_eq!(thin(&corner), [corner[0], corner[2], corner[3], corner[4]]);
        let back = [[0.0, 0.0], [5.0, 0.0], [9.0, 0.0], [4.0, 0.0]];
        assert_eq!(thin(&back), [back[0], back[2], back[3]]);
        assert_eq!(thin(&[]), [[0.0; 2]; 0]);
        assert_eq!(thin(&corner[..1]), corner[..1]);
    }

    #[test]
    fn a_smooth_line_of_many_points_needs_few() {
        let turn = |k: i32| f64::from(k) / 1e4 * std::f64::consts::TAU;
        let circle: Vec<_> = (0..=10_000)
            .map(|k| [100.0 * turn(k).cos(), 100.0 * turn(k).sin()])
            .collect();
        let kept = thin(&circle).len();
        assert!((20..200).contains(&kept), "{kept} points");
    }

    /// Distance of a point from a line through points.
    fn distance(point: [f64; 2], line: &[[f64; 2]]) -> f64 {
        let to = |two: &[[f64; 2]]| {
            let (way, own) = (minus(two[1], two[0]), minus(point, two[0]));
            let squared = way[0] * way[0] + way[1] * way[1];
            let share = (own[0] * way[0] + own[1] * way[1]) / squared;
            let share = if squared > 0.0 {
                share.clamp(0.0, 1.0)
            } else {
                0.0
            };
            length(minus(own, [share * way[0], share * way[1]]))
        };
        let least = line.windows(2).map(to).fold(f64::INFINITY, f64::min);
        least.min(length(minus(point, line[0])))
    }

    proptest! {
        /// Also where lines turn back, and stand still.
        #[test]
        fn no_point_is_far_from_the_line(
            steps in prop::collection::vec((-1.5..1.5_f64, -1.0..1.0_f64), 1..60),
        ) {
            let mut at = [0.0, 0.0];
            let points: Vec<_> = steps.iter().map(|(x, y)| {
                at = [at[0] + x, at[1] + y];
                at
            }).collect();
            let kept = thin(&points);
            prop_assert_eq!(kept.first(), points.first());
            prop_assert_eq!(kept.last(), points.last());
            for point in &points {
                prop_assert!(distance(*point, &kept) <= OFF + 1e-9);
            }
            for axis in 0..2 {
                let most = |points: &[[f64; 2]]| points.iter().map(|it| it[axis]).fold(f64::MIN, f64::max);
                prop_assert!(most(&points) - most(&kept) <= OFF + 1e-9);
            }
        }
    }
}

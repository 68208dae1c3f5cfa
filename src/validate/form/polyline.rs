//! Lines through many points, drawn by few.

/// Pixels that a line may be off, up or down: too little to see.
const OFF: f64 = 0.25;

/// The points of a line, from left to right, without those that can be left out: where they
/// were, it is no more than a quarter of a pixel off.
pub(super) fn thin(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let mut kept: Vec<(f64, f64)> = Vec::new();
    let mut last: Option<(f64, f64)> = None;
    // Slopes from the point kept last that pass all points behind it.
    let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
    for &(x, y) in points {
        let Some(&(mut x0, mut y0)) = kept.last() else {
            kept.push((x, y));
            continue;
        };
        let slope = (y - y0) / (x - x0);
        if !(low..=high).contains(&slope)
            && let Some(before) = last
        {
            kept.push(before);
            (x0, y0) = before;
            (low, high) = (f64::NEG_INFINITY, f64::INFINITY);
        }
        let run = x - x0;
        if run > 0.0 {
            low = low.max((y - OFF - y0) / run);
            high = high.min((y + OFF - y0) / run);
        }
        last = Some((x, y));
    }
    kept.extend(last);
    kept
}

/// The points in the letters of SVG.
pub(super) fn coordinates(points: &[(f64, f64)]) -> String {
    let points = points.iter().map(|(x, y)| format!("{x:.1},{y:.1}"));
    points.collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn straight_lines_need_two_points() {
        let line: Vec<_> = (0..500).map(|k| (k as f64, 3.0 * k as f64)).collect();
        assert_eq!(thin(&line), [line[0], line[499]]);
        let corner = [(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (3.0, 9.0), (4.0, 9.0)];
        assert_eq!(thin(&corner), [corner[0], corner[2], corner[3], corner[4]]);
        assert_eq!(thin(&[]), []);
        assert_eq!(thin(&corner[..1]), corner[..1]);
    }

    proptest! {
        #[test]
        fn no_point_is_far_from_the_line(
            ys in prop::collection::vec(0.0..3.0_f64, 1..60),
        ) {
            let points: Vec<_> = ys.iter().enumerate().map(|(k, y)| (k as f64, *y)).collect();
            let kept = thin(&points);
            prop_assert_eq!(kept.first(), points.first());
            prop_assert_eq!(kept.last(), points.last());
            for (x, y) in points {
                let right = kept.iter().position(|it| it.0 >= x).unwrap();
                let (b, a) = (kept[right], kept[right.saturating_sub(1)]);
                let share = if b.0 > a.0 { (x - a.0) / (b.0 - a.0) } else { 1.0 };
                prop_assert!((a.1 + share * (b.1 - a.1) - y).abs() <= OFF + 1e-9);
            }
        }
    }
}

//! Closed courses that are run through again and again, drawn once: dashes over dashes would
//! make a solid line.

/// How many points of a course are compared with another.
const COMPARED: usize = 24;

/// The points of a course, without what only repeats it from the start.
pub(super) fn once(mut points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    let steps = points.windows(2).map(|two| distance(two[0], two[1]));
    let near = 1.5 * steps.fold(0.0, f64::max);
    let repeats = |lap: usize| {
        let later = points[lap..].iter().zip(&points);
        later.clone().count() > 1 && later.into_iter().all(|(a, b)| distance(*a, *b) <= near)
    };
    let mut away = false;
    let lap = (1..points.len()).find(|&k| {
        let off = distance(points[k], points[0]);
        away |= off > 4.0 * near;
        away && off <= near && repeats(k)
    });
    if let Some(lap) = lap {
        points.truncate(lap + 1);
    }
    points
}

/// Whether a course runs along another, as far as can be seen.
pub(super) fn along(points: &[[f64; 2]], other: &[[f64; 2]]) -> bool {
    let steps = other.windows(2).map(|two| distance(two[0], two[1]));
    let near = steps.fold(0.0, f64::max);
    let stride = (points.len() / COMPARED).max(1);
    let mut some = points.iter().step_by(stride);
    some.all(|it| other.iter().any(|its| distance(*it, *its) <= near))
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn circle(laps: f64, phase: f64) -> Vec<[f64; 2]> {
        let turn = |k: u32| laps * std::f64::consts::TAU * f64::from(k) / 2000.0 + phase;
        (0..=2000).map(|k| [turn(k).cos(), turn(k).sin()]).collect()
    }

    #[test]
    fn a_lap_is_drawn_once() {
        assert!((400..402).contains(&once(circle(5.0, 0.3)).len()));
        assert_eq!(once(circle(0.9, 0.0)).len(), 2001);
        // There and back, through the start the other way, is no lap; there and back again is.
        let swing = |k: u32| {
            [
                (f64::from(k) / 2000.0 * 7.0 * std::f64::consts::PI).sin(),
                0.0,
            ]
        };
        let swings = once((0..=2000).map(swing).collect());
        assert!((560..580).contains(&swings.len()), "{}", swings.len());
        // What comes back to its start and goes on elsewhere is whole.
        let mut points = circle(1.0, 0.0);
        points.extend((1..500).map(|k| [1.0 + f64::from(k) * 0.003, 0.0]));
        assert_eq!(once(points.clone()), points);
        assert_eq!(once(vec![[1.0, 2.0]; 9]).len(), 9);
        assert_eq!(once(Vec::new()), [[0.0; 2]; 0]);
    }

    #[test]
    fn circles_run_along_each_other() {
        assert!(along(&circle(1.0, 1.0), &circle(1.0, 0.0)));
        assert!(along(&circle(0.3, 1.0), &circle(1.0, 0.0)));
        assert!(!along(&circle(1.0, 0.0), &circle(0.7, 0.0)));
        assert!(!along(&[[0.0, 0.0]], &circle(1.0, 0.0)));
    }
}

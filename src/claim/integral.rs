//! Integrals of what was seen along a run.

/// The integral of a quantity from the first time to each of the times, by the trapezoid rule.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Integral {
    /// The integral up to each time.
    pub(super) values: Vec<f64>,
    /// What each may be off: twice h³/12 |f''| of every stretch up to there, with the larger of
    /// the second derivatives that its neighbours show; where it changes by a third or more, so
    /// that these show little, half of the change times h, which no monotone quantity exceeds.
    pub(super) errors: Vec<f64>,
}

/// The integral of values at increasing times.
pub(super) fn integral(times: &[f64], values: &[f64]) -> Integral {
    let bend = |k: usize| -> Option<f64> {
        let (t, f) = (times.get(k..k + 3)?, values.get(k..k + 3)?);
        let (first, last) = ((f[1] - f[0]) / (t[1] - t[0]), (f[2] - f[1]) / (t[2] - t[1]));
        Some(2.0 * (last - first).abs() / (t[2] - t[0]))
    };
    let mut integral = Integral {
        values: vec![0.0; values.len()],
        errors: vec![0.0; values.len()],
    };
    for k in 1..values.len() {
        let h = times[k] - times[k - 1];
        let around = [k.checked_sub(2).and_then(bend), bend(k - 1)];
        let around = around.into_iter().flatten().reduce(f64::max);
        // Of two values nothing tells how they bend.
        let change = (values[k] - values[k - 1]).abs();
        let seldom = change > 0.3 * values[k].abs().max(values[k - 1].abs());
        let off = match around {
            Some(second) if !seldom => h.powi(3) / 6.0 * second,
            _ => 0.5 * h * change,
        };
        integral.values[k] = integral.values[k - 1] + 0.5 * h * (values[k] + values[k - 1]);
        integral.errors[k] = integral.errors[k - 1] + off;
    }
    integral
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn is_off_by_less_than_it_says_and_not_by_much_less() {
        let times: Vec<f64> = (0..=50).map(|k| 0.1 * f64::from(k)).collect();
        let values: Vec<f64> = times.iter().map(|t| (-2.0 * t).exp()).collect();
        let integral = integral(&times, &values);
        for (k, t) in times.iter().enumerate().skip(1) {
            let off = (integral.values[k] - 0.5 * (1.0 - (-2.0 * t).exp())).abs();
            let said = integral.errors[k];
            assert!(off < said && said < 4.0 * off, "{t}: {off} {said}");
        }
    }

    #[test]
    fn short_runs_have_integrals() {
        assert_eq!(integral(&[0.0], &[3.0]).values, [0.0]);
        let two = integral(&[0.0, 2.0], &[1.0, 3.0]);
        assert_eq!((two.values[1], two.errors[1]), (4.0, 2.0));
    }
}

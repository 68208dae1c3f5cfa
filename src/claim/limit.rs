//! What a run that ends says of what happens for ever.
//!
//! Nothing, strictly, and little where it is short. The rule here is stated and always the same. With E1, E2, E3 the largest
//! values of a quantity in the stretches of time (T/8, T/4], (T/4, T/2] and (T/2, T], its decay
//! exponents are p = log2(E1/E2) before and q = log2(E2/E3) last: equal for a power of time,
//! growing for an exponential, falling towards 0 where something is left over.

/// What the end of a run suggests.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Trend {
    /// Whether the limit is seen, refuted, or neither.
    pub seen: Option<bool>,
    /// The largest value in the last half over the largest of all.
    pub left: f64,
    /// The rate λ of the exponential c·e^(−λt) that fits the last half best, by least squares
    /// on the logarithms; 0 where nothing is left to fit.
    pub rate: f64,
}

/// States that each stretch of a run must hold for it to say anything.
const FEWEST: usize = 8;

/// Whether a quantity ≥ 0 tends to 0; `floor` is what cannot be told from 0.
///
/// Seen: all of the last half is below the floor; or at most a hundredth of the largest value
/// is left there, q ≥ 1 (it halves whenever time doubles) and q ≥ p/2 (the decay does not
/// flatten out).
///
/// Refuted: it stands still in the last half, which is to say that all values there agree to
/// nine digits; or that they agree to one part in a hundred and, since it did change before,
/// are a fiftieth to nine tenths of the largest. Or it runs away: it doubled from stretch to
/// stretch, to a hundred times what it was in the first eighth. All of it above ten times the
/// floor.
///
/// Neither where a stretch holds less than eight states.
pub fn vanishes(times: &[f64], values: &[f64], floor: f64) -> Trend {
    let end = times.last().copied().unwrap_or(0.0);
    let within = |from: f64, to: f64| {
        let within = times.iter().zip(values);
        let within = within.filter(move |(time, _)| **time > from * end && **time <= to * end);
        within.map(|(_, value)| *value)
    };
    let largest = |from: f64, to: f64| within(from, to).fold(0.0, f64::max);
    let [e0, e1, e2, e3] = [
        largest(-1.0, 0.125),
        largest(0.125, 0.25),
        largest(0.25, 0.5),
        largest(0.5, 1.0),
    ];
    let most = values.iter().copied().fold(0.0, f64::max);
    let least = within(0.5, 1.0).fold(f64::INFINITY, f64::min);
    let (p, q) = ((e1 / e2).log2(), (e2 / e3).log2());
    let left = if most > 0.0 { e3 / most } else { 0.0 };
    let enough = within(0.5, 1.0).count() >= FEWEST && within(0.25, 0.5).count() >= FEWEST / 2;
    let below = e3 <= floor;
    let decays = left <= 0.01 && q >= 1.0 && q >= 0.5 * p;
    let rests = least >= (1.0 - 1e-9) * e3;
    let stays = rests || (least >= 0.99 * e3 && (0.02..0.9).contains(&left));
    let grows = e3 > 2.0 * e2 && e2 > 2.0 * e1 && e3 > 100.0 * e0;
    let seen = match () {
        () if !enough => None,
        () if !e3.is_finite() => Some(false),
        () if below || decays => Some(true),
        () if (stays || grows) && e3 > 10.0 * floor => Some(false),
        () => None,
    };
    Trend {
        seen,
        left,
        rate: rate(times, values, 0.5 * end),
    }
}

/// Whether a quantity stays bounded.
///
/// Seen: its largest value of the last half exceeds that of the first by no more than a
/// hundredth. Refuted: it is four times what it was in the first eighth, has grown by more than
/// a tenth since half time, and in the last quarter by at least nine tenths as much as in the one
/// before: it does not level off. Neither where the last half holds less than eight states.
pub fn bounded(times: &[f64], values: &[f64]) -> Trend {
    let end = times.last().copied().unwrap_or(0.0);
    let up_to = |share: f64| {
        let until = times
            .iter()
            .zip(values)
            .filter(|(time, _)| **time <= share * end);
        until.map(|(_, value)| *value).fold(0.0, f64::max)
    };
    let [start, half, three, all] = [up_to(0.125), up_to(0.5), up_to(0.75), up_to(1.0)];
    let late = times.iter().filter(|time| **time > 0.5 * end).count();
    let steady = all > 1.1 * half && all - three >= 0.9 * (three - half);
    let seen = match () {
        () if late < FEWEST => None,
        () if !all.is_finite() => Some(false),
        () if all <= 1.01 * half => Some(true),
        () if steady && all > 4.0 * start => Some(false),
        () => None,
    };
    Trend {
        seen,
        left: if half > 0.0 { all / half } else { 1.0 },
        rate: rate(times, values, 0.5 * end),
    }
}

/// The rate of the exponential that fits the values after a time best.
fn rate(times: &[f64], values: &[f64], after: f64) -> f64 {
    let late = times.iter().zip(values);
    let late = late.filter(|(time, value)| **time > after && **value > 0.0 && value.is_finite());
    let points: Vec<(f64, f64)> = late.map(|(time, value)| (*time, value.ln())).collect();
    let count = points.len() as f64;
    if points.len() < 2 {
        return 0.0;
    }
    let mean = points.iter().fold((0.0, 0.0), |sum, it| {
        (sum.0 + it.0 / count, sum.1 + it.1 / count)
    });
    let (mut sxy, mut sxx) = (0.0, 0.0);
    for (x, y) in points {
        sxy += (x - mean.0) * (y - mean.1);
        sxx += (x - mean.0) * (x - mean.0);
    }
    if sxx > 0.0 { -sxy / sxx } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(f: impl Fn(f64) -> f64) -> Option<bool> {
        let times: Vec<f64> = (0..=400).map(|k| 0.1 * f64::from(k)).collect();
        let values: Vec<f64> = times.iter().map(|t| f(*t)).collect();
        vanishes(&times, &values, 1e-12).seen
    }

    #[test]
    fn decay_is_told_from_what_is_left_over() {
        assert_eq!(of(|t| (-t).exp()), Some(true));
        assert_eq!(
            of(|t| (-0.3 * t).exp() * (1.0 + (5.0 * t).sin().abs())),
            Some(true)
        );
        assert_eq!(of(|t| 1.0 / (1.0 + t * t)), Some(true));
        assert_eq!(of(|_| 0.0), Some(true));
        assert_eq!(of(|t| 0.676 + (-t).exp()), Some(false));
        assert_eq!(of(|_| 3.0), Some(false));
        // It has hardly begun, or creeps.
        assert_eq!(of(|t| (-1e-4 * t).exp()), None);
        assert_eq!(of(|t| 0.003 + (-t).exp()), None);
        assert_eq!(of(|t| t.exp()), Some(false));
        // Too slow, or not yet over: nobody can tell.
        assert_eq!(of(|t| 1.0 / (1.0 + t)), None);
        assert_eq!(of(|t| (-0.02 * t).exp()), None);
        assert_eq!(of(|t| 0.004 + (-0.2 * t).exp()), None);
        // All but over, and stirring again.
        assert_eq!(of(|t| (-t).exp() + 1e-6 * (0.1 * t).exp()), None);
    }

    #[test]
    fn few_states_say_nothing() {
        for count in 0..8 {
            let times: Vec<f64> = (0..count).map(f64::from).collect();
            let zeros = vec![0.0; times.len()];
            assert_eq!(vanishes(&times, &zeros, 1e-9).seen, None);
            assert_eq!(bounded(&times, &zeros).seen, None);
            assert_eq!(bounded(&times, &times).seen, None);
        }
    }

    #[test]
    fn rates_are_those_of_the_exponential() {
        let times: Vec<f64> = (0..100).map(f64::from).collect();
        let values: Vec<f64> = times.iter().map(|t| 3.0 * (-0.25 * t).exp()).collect();
        assert!((vanishes(&times, &values, 0.0).rate - 0.25).abs() < 1e-12);
    }

    #[test]
    fn growth_is_told_from_levelling_off() {
        let times: Vec<f64> = (0..=400).map(|k| 0.1 * f64::from(k)).collect();
        let of = |f: fn(f64) -> f64| {
            let values: Vec<f64> = times.iter().map(|t| f(*t)).collect();
            bounded(&times, &values).seen
        };
        assert_eq!(of(|t| 3.0 - (-t).exp()), Some(true));
        assert_eq!(of(|t| (2.0 * t).sin().abs()), Some(true));
        assert_eq!(of(|t| 1.0 + t), Some(false));
        assert_eq!(of(|t| 1.0 - (-0.05 * t).exp()), None);
    }
}

//! Putting a finding together.

use super::limit::{Trend, bounded, vanishes};
use super::{Curve, Finding, Hypothesis, Quantity, Run, Side, Verdict};
use crate::math::digits;
use crate::world::World;
use crate::world::spec::SensingSpec;

/// A finding in the making. Hypotheses and conclusions are added one by one; a claim holds
/// where all of its hypotheses are met and all of its conclusions hold.
#[derive(Debug, Clone, Default)]
pub struct Judging {
    hypotheses: Vec<Hypothesis>,
    conclusions: Vec<Conclusion>,
    quantities: Vec<Quantity>,
    curves: Vec<Curve>,
    first_contact: Option<f64>,
    /// Whether the run was seen in one state only.
    is_still: bool,
}

/// A quantity that must stay on one side of a bound, at each of some times.
#[derive(Debug, Clone)]
pub struct Bound<'a> {
    /// What it is, as a formula: `W(t)`, `d_X(t)`.
    pub name: &'a str,
    /// The times.
    pub times: Vec<f64>,
    /// The values.
    pub values: Vec<f64>,
    /// The bound at each time.
    pub bounds: Vec<f64>,
    /// What is allowed beyond the bound at each time.
    pub slack: Vec<f64>,
    /// The side of the bound to stay on.
    pub side: Side,
    /// What margins are measured in; where it is 0, the size of the bound, slack included, at
    /// the time.
    pub scale: f64,
}

#[derive(Debug, Clone)]
struct Conclusion {
    verdict: Verdict,
    margin: Option<f64>,
    closest: Option<f64>,
    reason: String,
}

impl Judging {
    /// Nothing as yet, of a run but that its agents can do what their laws ask of them, and
    /// know what these need.
    pub fn new<const D: usize>(run: &Run<'_, D>) -> Self {
        let mut judging = Self::of_states();
        judging.first_contact = run.first_contact;
        judging.is_still = run.observations.len() < 2;
        judging.suppose("nothing limits the forces", is_unlimited(run.world));
        judging.suppose_perception(run.world);
        judging
    }

    /// Nothing as yet, of a claim on what holds in each state by itself, whatever comes of it:
    /// limits of forces and contacts between bodies have no part in it, and one state is enough.
    pub fn of_states() -> Self {
        Self::default()
    }

    /// The hypothesis that agents perceive each other as they are.
    pub fn suppose_perception<const D: usize>(&mut self, world: &World<D>) {
        let plain = SensingSpec::default();
        let mut groups = world.spec.agents.iter();
        let plain = groups.all(|group| group.sensing.as_ref().is_none_or(|it| *it == plain));
        self.suppose("agents perceive without limits or errors", plain);
    }

    /// A hypothesis that is met or not.
    pub fn suppose(&mut self, statement: impl Into<String>, met: bool) {
        self.hypotheses.push(Hypothesis {
            statement: statement.into(),
            met,
            margin: None,
        });
    }

    /// The hypothesis that `value` is less than `bound`.
    pub fn suppose_less(&mut self, statement: impl Into<String>, value: f64, bound: f64) {
        self.hypotheses.push(Hypothesis {
            statement: statement.into(),
            met: value < bound,
            margin: share(bound - value, bound.abs().max(value.abs())),
        });
    }

    /// Whether all hypotheses so far are met.
    pub fn is_supposed(&self) -> bool {
        self.hypotheses.iter().all(|it| it.met)
    }

    /// A number that a reader wants to see.
    pub fn measure(&mut self, name: impl Into<String>, value: f64) {
        self.quantities.push(Quantity {
            name: name.into(),
            value: value.is_finite().then_some(value),
        });
    }

    /// A curve that decides nothing.
    pub fn plot(&mut self, name: impl Into<String>, times: &[f64], values: &[f64]) {
        self.curves.push(Curve {
            name: name.into(),
            times: times.to_vec(),
            values: values.iter().map(|it| finite(*it)).collect(),
            bounds: Vec::new(),
            side: Side::Below,
        });
    }

    /// The conclusion that a quantity stays on its side of a bound.
    pub fn bound(&mut self, bound: Bound<'_>) {
        let sign = match bound.side {
            Side::Below => 1.0,
            Side::Above => -1.0,
        };
        let allowed = bound.bounds.iter().zip(&bound.slack);
        let allowed: Vec<f64> = allowed.map(|(it, slack)| it + sign * slack).collect();
        let mut least = (f64::INFINITY, 0);
        for (k, (value, allowed)) in bound.values.iter().zip(&allowed).enumerate() {
            let scale = match bound.scale > 0.0 {
                true => bound.scale,
                false => allowed.abs().max(f64::MIN_POSITIVE),
            };
            let margin = sign * (allowed - value) / scale;
            // What is not a number is no bound kept.
            let margin = if margin.is_nan() {
                f64::NEG_INFINITY
            } else {
                margin
            };
            if margin < least.0 {
                least = (margin, k);
            }
        }
        let (margin, k) = least;
        if let (Some(value), Some(allowed)) = (bound.values.get(k), allowed.get(k)) {
            let (name, time) = (bound.name, bound.times[k]);
            let (verdict, word) = match (margin >= 0.0, bound.side) {
                (true, Side::Below) => (Verdict::Holds, "at most"),
                (true, Side::Above) => (Verdict::Holds, "at least"),
                (false, Side::Below) => (Verdict::Violated, "above"),
                (false, Side::Above) => (Verdict::Violated, "below"),
            };
            let (value, allowed) = (brief(*value), brief(*allowed));
            let reason = match verdict {
                Verdict::Violated => {
                    format!(
                        "{name} is {value} at time {}, {word} {allowed}",
                        brief(time)
                    )
                }
                _ => format!(
                    "{name} stays {word} its bound, closest at time {}: {value}, allowed {allowed}",
                    brief(time)
                ),
            };
            self.conclusions.push(Conclusion {
                verdict,
                margin: finite(margin),
                closest: Some(time),
                reason,
            });
        }
        self.curves.push(Curve {
            name: bound.name.to_owned(),
            times: bound.times,
            values: bound.values.into_iter().map(finite).collect(),
            bounds: allowed.into_iter().map(finite).collect(),
            side: bound.side,
        });
    }

    /// The conclusion that a number has a value, or comes as near to it as `slack`, in units
    /// of `scale`.
    pub fn equal(&mut self, name: &str, value: f64, expected: f64, slack: f64, scale: f64) {
        self.measure(name, value);
        self.measure(format!("{name}, claimed"), expected);
        let off = (value - expected).abs();
        let holds = off <= slack;
        let word = if holds { "is" } else { "is not" };
        self.conclusions.push(Conclusion {
            verdict: if holds {
                Verdict::Holds
            } else {
                Verdict::Violated
            },
            margin: share(slack - off, scale),
            closest: None,
            reason: format!(
                "{name} {word} {}: it is {}, and {} off where {} is allowed",
                brief(expected),
                brief(value),
                brief(off),
                brief(slack)
            ),
        });
    }

    /// A conclusion that the run does not allow, and why.
    pub fn undecided(&mut self, reason: impl Into<String>) {
        self.conclusions.push(Conclusion {
            verdict: Verdict::Undecided,
            margin: None,
            closest: None,
            reason: reason.into(),
        });
    }

    /// The conclusion that a quantity ≥ 0 tends to 0, by the rule of [`vanishes`]; `floor` is
    /// what cannot be told from 0.
    pub fn tends_to_zero(&mut self, name: &str, times: &[f64], values: &[f64], floor: f64) {
        let trend = vanishes(times, values, floor);
        let what = match trend.seen {
            Some(true) => "tends to 0",
            Some(false) => "does not tend to 0",
            None => "has not come near enough to 0 to tell",
        };
        let last = values.last().copied().unwrap_or(0.0);
        let reason = format!(
            "{name} {what}: {} at the end, {} of its largest left in the last half, there \
             {} at a rate of {}",
            brief(last),
            brief(trend.left),
            if trend.rate < 0.0 {
                "rising"
            } else {
                "falling"
            },
            brief(trend.rate.abs())
        );
        let margin = match trend.seen {
            Some(false) => -trend.left,
            _ => 1.0 - trend.left,
        };
        self.trend(trend, margin, times, reason);
        self.plot(name, times, values);
    }

    /// The conclusion that a quantity stays bounded, by the rule of [`bounded`].
    pub fn stays_bounded(&mut self, name: &str, times: &[f64], values: &[f64]) {
        let trend = bounded(times, values);
        let what = match trend.seen {
            Some(true) => "stays bounded",
            Some(false) => "grows on and on",
            None => "has not been seen for long enough to tell",
        };
        let reason = format!(
            "{name} {what}: its largest value is {} times that of the first half",
            brief(trend.left)
        );
        self.trend(trend, 1.1 - trend.left, times, reason);
        self.plot(name, times, values);
    }

    fn trend(&mut self, trend: Trend, margin: f64, times: &[f64], reason: String) {
        self.conclusions.push(Conclusion {
            verdict: match (trend.seen, self.first_contact) {
                (Some(true), _) => Verdict::Holds,
                // Bodies that touched had no time to come to a limit.
                (Some(false), None) => Verdict::Violated,
                _ => Verdict::Undecided,
            },
            margin: finite(margin),
            closest: times.last().copied(),
            reason,
        });
    }

    /// The finding: the worst of the conclusions where the hypotheses are met. On bodies that
    /// touch it is at best that the hypotheses are not met, from then on.
    pub fn finding(self) -> Finding {
        let rank = |verdict: Verdict| match verdict {
            Verdict::Violated => 0,
            Verdict::Undecided => 1,
            _ => 2,
        };
        let order = |it: &Conclusion| (rank(it.verdict), it.margin.unwrap_or(f64::INFINITY));
        let worst = self.conclusions.iter().min_by(|a, b| {
            let (a, b) = (order(a), order(b));
            a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
        });
        let unmet = self.hypotheses.iter().find(|it| !it.met);
        let (verdict, margin, closest, reason) = match (unmet, worst) {
            (Some(unmet), _) => {
                let reason = format!("not met: {}", unmet.statement);
                (Verdict::HypothesisNotMet, unmet.margin, None, reason)
            }
            (None, None) => match self.first_contact {
                Some(time) => {
                    let reason = format!("bodies touch at time {}, before all else", brief(time));
                    (Verdict::HypothesisNotMet, None, Some(time), reason)
                }
                None => {
                    let reason = "nothing was seen to judge by".to_owned();
                    (Verdict::Undecided, None, None, reason)
                }
            },
            (None, Some(worst)) if self.is_still && worst.verdict == Verdict::Holds => {
                let reason = "one state, in which nothing has moved yet, shows nothing";
                let verdict = match self.first_contact {
                    Some(_) => Verdict::HypothesisNotMet,
                    None => Verdict::Undecided,
                };
                (verdict, None, self.first_contact, reason.to_owned())
            }
            (None, Some(worst)) => {
                let touched = self
                    .first_contact
                    .filter(|_| worst.verdict != Verdict::Violated);
                match touched {
                    Some(time) => (
                        Verdict::HypothesisNotMet,
                        worst.margin,
                        Some(time),
                        format!(
                            "bodies touch at time {}, and points do not: nothing is claimed from \
                             then on; until then, {}",
                            brief(time),
                            worst.reason
                        ),
                    ),
                    None => {
                        let Conclusion {
                            verdict,
                            margin,
                            closest,
                            reason,
                        } = worst.clone();
                        (verdict, margin, closest, reason)
                    }
                }
            }
        };
        Finding {
            verdict,
            margin,
            closest,
            reason,
            hypotheses: self.hypotheses,
            quantities: self.quantities,
            curves: self.curves,
        }
    }
}

/// Whether forces, their rates and speeds have no limits.
fn is_unlimited<const D: usize>(world: &World<D>) -> bool {
    world.spec.agents.iter().all(|group| {
        let limits = [group.force_limit, group.force_rate_limit, group.top_speed];
        limits.iter().all(Option::is_none)
    })
}

fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}

fn share(part: f64, of: f64) -> Option<f64> {
    finite(part / of)
}

/// A number in a sentence: five digits.
pub(super) fn brief(value: f64) -> String {
    digits(value, 5)
}

//! Reports made by hand, with all that can stand in one.

use volary::claim::{Curve, Finding, Hypothesis, Quantity, Reading, Side, Verdict};
use volary::validate::report::{
    ClaimReport, ClosestReport, ContactOutcome, ContactReport, Departure, ExclusionReport, FORMAT,
    FirstContact, JudgedRun, Report, RunReport, VERSION, WorldReport,
};
use volary::world::spec::DynamicsName;

/// A name with every letter that some form has to write in another way.
pub const WEIRD: &str = "<b>&\"it's\"</b> | `a_b*` \\ ]]> <!-- \u{7}";

/// The name of a claim that fits in no column.
pub const LONG: &str =
    "song-2013/a-claim-whose-name-is-so-long-that-nobody-would-ever-type-it-twice";

/// Times from 0 to the end.
pub fn times(end: f64) -> Vec<f64> {
    (0..=240).map(|k| end * k as f64 / 240.0).collect()
}

/// A curve of a function of time against a bound; without one where it is nowhere a number.
pub fn curve(
    name: &str,
    times: &[f64],
    value: impl Fn(f64) -> f64,
    bound: impl Fn(f64) -> f64,
    side: Side,
) -> Curve {
    let finite = |value: f64| value.is_finite().then_some(value);
    let bounds: Vec<_> = times.iter().map(|t| finite(bound(*t))).collect();
    Curve {
        name: name.to_owned(),
        times: times.to_vec(),
        values: times.iter().map(|t| finite(value(*t))).collect(),
        bounds: match bounds.iter().any(Option::is_some) {
            true => bounds,
            false => Vec::new(),
        },
        side,
    }
}

/// A finding with a verdict and a reason.
pub fn finding(verdict: Verdict, margin: f64, reason: &str) -> Finding {
    Finding {
        verdict,
        margin: Some(margin),
        closest: None,
        reason: reason.to_owned(),
        hypotheses: vec![Hypothesis {
            statement: "no other forces act".to_owned(),
            met: verdict != Verdict::HypothesisNotMet,
            margin: None,
        }],
        quantities: Vec::new(),
        curves: Vec::new(),
    }
}

/// A finding on a run that the world expects, or not.
pub fn judged(dynamics: DynamicsName, expected: Option<Verdict>, finding: Finding) -> JudgedRun {
    let as_expected = match expected {
        Some(verdict) => finding.verdict == verdict,
        None => finding.verdict != Verdict::Violated,
    };
    JudgedRun {
        dynamics,
        expected,
        as_expected,
        finding,
    }
}

/// A claim with what it came to.
pub fn claim(name: &str, reading: Reading, findings: Vec<JudgedRun>) -> ClaimReport {
    ClaimReport {
        claim: name.to_owned(),
        source: "Song, Liu, Cao & Qiu, Theorem 10".to_owned(),
        reading,
        statement: "The energy W never rises, and so no two agents ever meet.".to_owned(),
        findings,
    }
}

fn run(dynamics: DynamicsName, first_contact: Option<f64>) -> RunReport {
    RunReport {
        dynamics,
        method: match dynamics {
            DynamicsName::Points => "Dormand–Prince 8(7), to 1e-12 in each step".to_owned(),
            DynamicsName::Bodies => "in steps of 0.01".to_owned(),
        },
        observations: 241,
        first_contact,
        agent_contacts: usize::from(first_contact.is_some()),
        obstacle_contacts: 0,
        closest: Some(ClosestReport {
            agents: [3, 17],
            distance: 0.912_345_6,
            time: 12.25,
        }),
    }
}

/// A world in which points and bodies agree, until bodies touch.
fn touching() -> WorldReport {
    use DynamicsName::{Bodies, Points};
    let (whole, until) = (times(40.0), times(21.5));
    let energy = |t: f64| 3.0 + 5.0 * (-0.2 * t).exp() * (1.1 + (0.9 * t).cos());
    let distance = |t: f64| 1.4 + 1.2 * (0.3 * t).cos() * (-0.02 * t).exp();
    let with = |mut finding: Finding, closest: f64, curves: Vec<Curve>| {
        finding.closest = Some(closest);
        finding.curves = curves;
        finding.quantities = vec![
            Quantity {
                name: "W(0)".to_owned(),
                value: Some(13.5),
            },
            Quantity {
                name: "R".to_owned(),
                value: None,
            },
        ];
        finding
    };
    let of_energy = |times: &[f64], slack: f64| {
        vec![curve("W(t)", times, energy, |_| 13.6 + slack, Side::Below)]
    };
    let of_distance = |times: &[f64]| {
        let name = "min_{i≠j} |x_i − x_j|";
        vec![curve(name, times, distance, |_| 0.31, Side::Above)]
    };
    let spread = |times: &[f64]| {
        let none = |_| f64::NAN;
        vec![curve(
            "max_i |v_i − v_c|",
            times,
            |t| 4.0 * (-0.6 * t).exp(),
            none,
            Side::Below,
        )]
    };
    let envelope = |times: &[f64]| {
        let value = |t: f64| 4.0 * (-0.5 * t).exp();
        vec![curve(
            "d_V(t)",
            times,
            value,
            |t| 5.0 * (-0.3 * t).exp(),
            Side::Below,
        )]
    };
    let holds = |margin| finding(Verdict::Holds, margin, "W(t) stays at most its bound");
    let energy_rises = "W(t) is 13.7 at time 0, above 13.6";
    let theorem = "song-2013/theorem-10-energy";
    let apart = "song-2013/theorem-10-distance";
    let reason = "min_{i≠j} |x_i − x_j| stays at least its bound";
    WorldReport {
        world: "song-2013/cucker-dong".to_owned(),
        description: "Twenty agents under bounded cohesion.".to_owned(),
        agents: 20,
        dimension: 3,
        end: 40.0,
        runs: vec![run(Points, None), run(Bodies, Some(21.5))],
        claims: vec![
            claim(
                theorem,
                Reading::Printed,
                vec![
                    judged(
                        Points,
                        Some(Verdict::Violated),
                        with(
                            finding(Verdict::Violated, -0.0074, energy_rises),
                            0.0,
                            of_energy(&whole, 0.0),
                        ),
                    ),
                    judged(Bodies, None, with(holds(0.02), 0.0, of_energy(&until, 1.5))),
                ],
            ),
            claim(
                apart,
                Reading::Sharpened,
                vec![
                    judged(
                        Points,
                        None,
                        with(
                            finding(Verdict::Holds, 0.66, reason),
                            10.0,
                            of_distance(&whole),
                        ),
                    ),
                    judged(
                        Bodies,
                        None,
                        with(
                            finding(
                                Verdict::HypothesisNotMet,
                                0.66,
                                "bodies touch at time 21.5, and points do not: nothing is \
                                 claimed from then on; until then, all is well",
                            ),
                            21.5,
                            of_distance(&until),
                        ),
                    ),
                ],
            ),
            claim(
                "song-2013/theorem-10-velocity-consensus",
                Reading::Printed,
                vec![
                    judged(
                        Points,
                        None,
                        with(
                            finding(Verdict::Undecided, 0.9, "it has not come near enough to 0"),
                            40.0,
                            spread(&whole),
                        ),
                    ),
                    judged(
                        Bodies,
                        None,
                        with(
                            finding(Verdict::Undecided, 0.9, "it has not come near enough to 0"),
                            21.5,
                            spread(&until),
                        ),
                    ),
                ],
            ),
            claim(
                "song-2013/theorem-10-envelope",
                Reading::Corrected,
                vec![judged(
                    Points,
                    Some(Verdict::Holds),
                    with(holds(0.3), 0.0, envelope(&whole)),
                )],
            ),
        ],
        contact: Some(ContactReport {
            radius: 0.5,
            exclusions: vec![ExclusionReport {
                claim: apart.to_owned(),
                formula: "P⁻¹(W(0))".to_owned(),
                distance: 0.31,
                radius: 0.155,
                outcome: ContactOutcome::AllowedAndSeen,
            }],
            points_radius: Some(0.4),
            bodies_radius: Some(0.49),
            first: Some(FirstContact {
                time: 21.5,
                agent: 3,
                other_agent: Some(17),
                obstacle: None,
                approach_speed: 0.25,
                blow: 1.5,
                points_apart: Some(0.98),
                cause: "the bodies are larger than theory keeps apart".to_owned(),
            }),
            departure: Some(Departure {
                before_contact: 2e-5,
                velocities_before_contact: 3e-4,
                at_end: 0.7,
                times: whole.clone(),
                distances: whole
                    .iter()
                    .map(|t| match *t {
                        t if t < 21.5 => 1e-6 * t,
                        t => 2e-5 + 0.04 * (t - 21.5),
                    })
                    .collect(),
            }),
        }),
    }
}

/// A world with a weird name, and a finding that nobody expected.
fn weird() -> WorldReport {
    use DynamicsName::{Bodies, Points};
    let unmet = |margin| {
        finding(
            Verdict::HypothesisNotMet,
            margin,
            "not met: <no> other | forces_act",
        )
    };
    WorldReport {
        world: WEIRD.to_owned(),
        description: format!("{WEIRD}\nin two lines"),
        agents: 1,
        dimension: 2,
        end: 1e-7,
        runs: vec![run(Points, None), run(Bodies, None)],
        claims: vec![
            claim(
                LONG,
                Reading::Printed,
                vec![
                    judged(Points, None, unmet(-0.5)),
                    judged(Bodies, None, unmet(-0.5)),
                ],
            ),
            claim(
                "djokam-rathinam/acceleration-bound",
                Reading::Printed,
                vec![
                    judged(Points, None, finding(Verdict::Holds, 0.5, "it holds")),
                    judged(
                        Bodies,
                        None,
                        finding(
                            Verdict::Violated,
                            -1.5e-9,
                            "|a_i| is 1.2 at time 0, above 1",
                        ),
                    ),
                ],
            ),
            claim(
                WEIRD,
                Reading::Corrected,
                vec![judged(
                    Points,
                    Some(Verdict::Violated),
                    finding(Verdict::Holds, 0.25, WEIRD),
                )],
            ),
        ],
        contact: Some(ContactReport {
            radius: 0.0,
            exclusions: Vec::new(),
            points_radius: None,
            bodies_radius: None,
            first: None,
            departure: None,
        }),
    }
}

/// A world of which no claim speaks, run as points alone.
fn silent() -> WorldReport {
    WorldReport {
        world: "mixtures/silent".to_owned(),
        description: String::new(),
        agents: 1,
        dimension: 2,
        end: 5.0,
        runs: vec![RunReport {
            closest: None,
            ..run(DynamicsName::Points, None)
        }],
        claims: Vec::new(),
        contact: None,
    }
}

/// A report of these worlds.
pub fn report(worlds: Vec<WorldReport>) -> Report {
    let claims = worlds.iter().flat_map(|world| &world.claims);
    let mut findings = claims.flat_map(|claim| &claim.findings);
    Report {
        format: FORMAT.to_owned(),
        version: VERSION,
        program: "volary 0.1.0".to_owned(),
        as_expected: findings.all(|run| run.as_expected),
        worlds,
    }
}

/// All of it.
pub fn full() -> Report {
    report(vec![touching(), weird(), silent()])
}

/// One world.
pub fn single() -> Report {
    report(vec![touching()])
}

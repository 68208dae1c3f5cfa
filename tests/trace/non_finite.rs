//! Numbers that no trace may hold.

use volary::trace::record::*;
use volary::trace::{Format, TraceWriter};

use crate::sample::*;

type Field<T> = (&'static str, fn(&mut T) -> &mut f64);

/// Puts each bad number into each field and asks the writer to refuse it.
fn refuses<T: Clone>(sample: T, wrap: fn(T) -> Record, called: &str, fields: &[Field<T>]) {
    for (field, at) in fields {
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let mut spoilt = sample.clone();
            *at(&mut spoilt) = bad;
            let mut bytes = Vec::new();
            let mut writer = TraceWriter::new(&mut bytes, Format::default());
            write_all(&mut writer, &[]);
            let text = message(writer.write(&wrap(spoilt)));
            assert!(
                text.contains(&format!("{field} is {bad}")),
                "{field}: {text}"
            );
            assert!(text.contains(called), "{text}");
            // The trace goes on as if nothing had been.
            writer.write(&wrap(sample.clone())).unwrap();
            writer.finish().unwrap();
            let mut expected = bytes_of("t.jsonl", &[]);
            serde_json::to_writer(&mut expected, &wrap(sample.clone())).unwrap();
            expected.push(b'\n');
            assert_eq!(bytes, expected, "{field}");
        }
    }
}

#[test]
fn non_finite_numbers_are_refused_in_every_field() {
    fn last(frame: &mut Frame) -> &mut Metrics {
        frame.metrics.as_mut().unwrap()
    }
    let frame_fields: &[Field<Frame>] = &[
        ("positions[1][0]", |f| &mut f.positions[1][0]),
        ("velocities[0][1]", |f| &mut f.velocities[0][1]),
        ("metrics.density", |f| last(f).density.as_mut().unwrap()),
        ("metrics.structural_energy", |f| {
            last(f).structural_energy.as_mut().unwrap()
        }),
        ("metrics.polarization", |f| &mut last(f).polarization),
        ("metrics.velocity_mismatch", |f| {
            &mut last(f).velocity_mismatch
        }),
        ("metrics.agent_gap", |f| last(f).agent_gap.as_mut().unwrap()),
        ("metrics.obstacle_gap", |f| {
            last(f).obstacle_gap.as_mut().unwrap()
        }),
        ("metrics.position_diameter", |f| {
            &mut last(f).position_diameter
        }),
        ("metrics.velocity_diameter", |f| {
            &mut last(f).velocity_diameter
        }),
        ("accelerations[0].values[1][1]", |f| {
            &mut f.accelerations.as_mut().unwrap()[0].values[1][1]
        }),
        ("beta_agents[0].position[0]", |f| {
            &mut f.beta_agents.as_mut().unwrap()[0].position[0]
        }),
        ("beta_agents[0].velocity[1]", |f| {
            &mut f.beta_agents.as_mut().unwrap()[0].velocity[1]
        }),
        ("beta_agents[0].distance", |f| {
            &mut f.beta_agents.as_mut().unwrap()[0].distance
        }),
    ];
    refuses(
        frame(10),
        Record::Frame,
        "the frame at time 1 (step 10)",
        frame_fields,
    );
    refuses(
        frame(10),
        Record::Frame,
        "(step 10)",
        &[("time", |f| &mut f.time)],
    );
    let called = "the contact of agent 0 with obstacle 3";
    refuses(
        contact(),
        Record::Contact,
        called,
        &[
            ("begin", |c| &mut c.begin),
            ("end", |c| &mut c.end),
            ("largest_impulse", |c| &mut c.largest_impulse),
            ("deepest_penetration", |c| &mut c.deepest_penetration),
            ("approach_speed", |c| &mut c.approach_speed),
            ("position[1]", |c| &mut c.position[1]),
        ],
    );
    refuses(
        summary(),
        |s| Record::Summary(Box::new(s)),
        "the summary",
        &[
            ("time", |s| &mut s.time),
            ("agent_contacts.largest_impulse", |s| {
                &mut s.agent_contacts.largest_impulse
            }),
            ("smallest_agent_gap", |s| {
                s.smallest_agent_gap.as_mut().unwrap()
            }),
            ("final.polarization", |s| &mut s.last.polarization),
        ],
    );
    refuses(
        header(),
        |h| Record::Header(Box::new(h)),
        "the header",
        &[
            ("world.time.step", |h| &mut h.world.time.step),
            ("world.agents[0].radius", |h| {
                h.world.agents[0].radius.as_mut().unwrap()
            }),
            ("bodies.mass[1]", |h| &mut h.bodies.mass[1]),
            ("bodies.force_limit[0]", |h| {
                h.bodies.force_limit[0].as_mut().unwrap()
            }),
        ],
    );
}

//! Exports of made-up traces.

use std::io::Cursor;

use proptest::prelude::*;
use serde_json::json;

use super::*;
use crate::trace::Layout;
use crate::trace::record::{Bodies, FORMAT, Frame, Header, VERSION};

fn header(dimension: usize, agents: usize) -> Header {
    let group = json!({ "positions": { "explicit": [] } });
    let world = json!({
        "dimension": dimension, "time": { "end": 1 }, "agents": [group, group]
    });
    Header {
        format: FORMAT.to_owned(),
        version: VERSION,
        program: "a test".to_owned(),
        dynamics: "bodies".to_owned(),
        solver: None,
        name: "a test".to_owned(),
        world: serde_json::from_value(world).expect("it has what a world must have"),
        bodies: Bodies {
            group: (0..agents).map(|agent| agent % 2).collect(),
            radius: vec![0.5; agents],
            mass: vec![1.0; agents],
            force_limit: vec![None; agents],
        },
    }
}

fn lines(records: &[Record]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut writer = TraceWriter::new(&mut bytes, Format::default());
    for record in records {
        writer.write(record).unwrap();
    }
    writer.finish().unwrap();
    bytes
}

fn export(trace: Vec<u8>, form: Form) -> Result<Vec<u8>, ExportError> {
    let mut bytes = Vec::new();
    let export = Export {
        form,
        compression: Compression::None,
        selection: Selection::default(),
    };
    let trace = TraceReader::new(Cursor::new(trace), "t".to_owned())?;
    export.write_to(trace, &mut bytes, "the export", || false)?;
    Ok(bytes)
}

prop_compose! {
    /// A trace of a few agents at any numbers.
    fn trace()(dimension in 2..=3_usize, agents in 1..4_usize)(
        frames in prop::collection::vec(
            prop::collection::vec(any::<f64>().prop_filter("finite", |x| x.is_finite()),
                2 * dimension * agents),
            0..4,
        ),
        dimension in Just(dimension),
        agents in Just(agents),
    ) -> (usize, Vec<Record>) {
        let mut records = vec![Record::Header(Box::new(header(dimension, agents)))];
        for (step, numbers) in frames.iter().enumerate() {
            let mut vectors: Vec<_> = numbers.chunks(dimension).map(<[f64]>::to_vec).collect();
            let velocities = vectors.split_off(agents);
            records.push(Record::Frame(Frame {
                step: step as u64,
                time: step as f64 * 0.1,
                positions: vectors,
                velocities,
                ..Frame::default()
            }));
        }
        (dimension, records)
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn a_trace_comes_back_from_a_document((_, records) in trace()) {
        let whole = lines(&records);
        let document = export(whole.clone(), Form::Trace(Layout::Array)).unwrap();
        prop_assert_ne!(&document, &whole);
        prop_assert_eq!(export(document, Form::Trace(Layout::Lines)).unwrap(), whole);
    }

    #[test]
    fn a_table_holds_every_number((dimension, records) in trace()) {
        let text = export(lines(&records), Form::Table(Table::Agents)).unwrap();
        let text = String::from_utf8(text).unwrap();
        let cells = text.lines().skip(1).flat_map(|row| row.split(',').skip(4));
        let found: Vec<u64> = cells.map(|x| x.parse::<f64>().unwrap().to_bits()).collect();
        let mut expected = Vec::new();
        for record in &records {
            let Record::Frame(frame) = record else { continue };
            for (position, velocity) in frame.positions.iter().zip(&frame.velocities) {
                expected.extend(position.iter().chain(velocity).map(|x| x.to_bits()));
            }
        }
        prop_assert_eq!(found, expected);
        let groups = text.lines().skip(1).filter_map(|row| row.split(',').nth(3));
        let agents = records.iter().find_map(|record| match record {
            Record::Frame(frame) => Some(frame.positions.len()),
            _ => None,
        });
        for (row, group) in groups.enumerate() {
            let agent = row % agents.unwrap_or(1);
            prop_assert_eq!(group, format!("group_{}", agent % 2));
        }
        prop_assert_eq!(text.contains(",z,"), dimension == 3);
    }
}

#[test]
fn frames_of_other_columns_are_refused() {
    let mut records = vec![Record::Header(Box::new(header(2, 1)))];
    for rotations in [None, Some(vec![crate::world::spec::Rotation::Angle(0.5)])] {
        records.push(Record::Frame(Frame {
            step: records.len() as u64,
            positions: vec![vec![0.0; 2]],
            velocities: vec![vec![0.0; 2]],
            rotations,
            ..Frame::default()
        }));
    }
    let refused = |form| export(lines(&records), form).unwrap_err().to_string();
    assert!(refused(Form::Table(Table::Agents)).starts_with("t: the frame at step 2"));
    assert!(refused(Form::Table(Table::Metrics)).starts_with("t records no metrics"));
    let Record::Header(header) = &mut records[0] else {
        unreachable!("it is the first")
    };
    header.bodies.group = vec![7];
    let problem = export(lines(&records), Form::Xyz).unwrap_err().to_string();
    assert!(problem.starts_with("t: the header"), "{problem}");
}

#[test]
fn whoever_stops_it_gets_nothing() {
    let records = [
        Record::Header(Box::new(header(2, 0))),
        Record::Frame(Frame::default()),
    ];
    let trace = TraceReader::new(Cursor::new(lines(&records)), "t".to_owned()).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("t.csv");
    let (form, compression) = Form::of(&path).unwrap();
    let export = Export {
        form,
        compression,
        selection: Selection::default(),
    };
    let stopped = export.write(trace, &path, false, || true);
    assert!(matches!(stopped, Err(ExportError::Stopped)));
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}

//! Traces that a thread of their own writes.

use std::fs;
use std::path::Path;

use volary::trace::record::*;
use volary::trace::{BackgroundWriter, TraceWriter};

use crate::sample::*;

/// More records than may wait, so that whoever gives them is held up.
fn many() -> Vec<Record> {
    (0..300).map(|step| Record::Frame(frame(step))).collect()
}

fn background(path: &Path) -> BackgroundWriter {
    let writer = TraceWriter::create_resumable(path, true).unwrap();
    let mut writer = BackgroundWriter::new(writer, path).unwrap();
    writer.write(Record::Header(Box::new(header()))).unwrap();
    writer
}

#[test]
fn it_leaves_the_bytes_of_a_writer_that_is_waited_for() {
    let folder = tempfile::tempdir().unwrap();
    for name in NAMES {
        let paths =
            ["a", "b"].map(|folder_name| folder.path().join(format!("{folder_name}-{name}")));
        let mut direct = TraceWriter::create_resumable(&paths[0], true).unwrap();
        direct.write(&Record::Header(Box::new(header()))).unwrap();
        let mut writer = background(&paths[1]);
        for (k, record) in many().into_iter().enumerate() {
            direct.write(&record).unwrap();
            writer.write(record).unwrap();
            if k % 100 == 50 {
                // All records that were given before are in it.
                assert_eq!(
                    writer.position().unwrap(),
                    direct.position().unwrap(),
                    "{name}"
                );
            }
        }
        direct.finish().unwrap();
        writer.finish().unwrap();
        let [direct, background] = paths.map(|path| fs::read(path).unwrap());
        assert_eq!(direct, background, "{name}");
    }
}

#[test]
fn what_a_dropped_one_was_given_is_all_there() {
    let folder = tempfile::tempdir().unwrap();
    for name in NAMES {
        let path = folder.path().join(name);
        let mut writer = background(&path);
        for record in many() {
            writer.write(record).unwrap();
        }
        drop(writer);
        let other = folder.path().join(format!("direct-{name}"));
        let mut direct = TraceWriter::create_resumable(&other, true).unwrap();
        direct.write(&Record::Header(Box::new(header()))).unwrap();
        for record in many() {
            direct.write(&record).unwrap();
        }
        drop(direct);
        let [path, other] = [path, other].map(|path| fs::read(path).unwrap());
        assert_eq!(path, other, "{name}");
        let (records, truncated) = read(&path).unwrap();
        assert!(truncated, "{name}: nobody closed it");
        assert_eq!(records, many()[..records.len()], "{name}");
    }
}

#[test]
fn errors_are_told_later() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("t.jsonl");
    let mut writer = background(&path);
    let mut wrong = frame(0);
    wrong.positions[0][0] = f64::NAN;
    writer.write(Record::Frame(wrong)).unwrap();
    let told = (1..1_000).find_map(|step| writer.write(Record::Frame(frame(step))).err());
    let told = told.expect("more than may wait").to_string();
    assert!(told.contains("the frame at time 0"), "{told}");
    // Whoever does not listen is told again that nothing goes on.
    assert!(message(writer.write(Record::Frame(frame(0)))).contains("after an error"));
    assert!(writer.position().is_err());
    assert!(writer.finish().is_err());

    let mut writer = background(&path);
    let mut wrong = frame(0);
    wrong.positions[0][0] = f64::INFINITY;
    writer.write(Record::Frame(wrong)).unwrap();
    let told = message(writer.finish());
    assert!(told.contains("the frame at time 0"), "{told}");
}

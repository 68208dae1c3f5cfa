//! Traces that are taken up again.

use std::fs::{self, OpenOptions};
use std::io::Write;
use std::path::Path;

use volary::trace::record::*;
use volary::trace::{TraceError, TraceWriter};

use crate::sample::*;

/// Enough records for several members of a compressed trace.
fn many() -> Vec<Record> {
    let mut all: Vec<Record> = (0..12)
        .flat_map(|step| {
            let mut large = frame(step);
            let x = |i: u64| vec![(i as f64 + step as f64).sin(), (i as f64).cos()];
            large.positions = (0..700).map(x).collect();
            [Record::Frame(large), Record::Contact(contact())]
        })
        .collect();
    all.push(Record::Summary(Box::new(summary())));
    all
}

fn whole(path: &Path, records: &[Record]) -> Vec<u8> {
    let mut writer = TraceWriter::create_resumable(path, false).unwrap();
    write_all(&mut writer, records);
    writer.finish().unwrap();
    let bytes = fs::read(path).unwrap();
    fs::remove_file(path).unwrap();
    bytes
}

#[test]
fn a_trace_goes_on_between_any_two_records() {
    let folder = tempfile::tempdir().unwrap();
    let records = many();
    for name in NAMES {
        let path = folder.path().join(name);
        let whole = whole(&path, &records);
        assert_eq!(read(&whole).unwrap(), (records.clone(), false), "{name}");
        for count in 0..records.len() {
            let mut writer = TraceWriter::create_resumable(&path, true).unwrap();
            write_all(&mut writer, &records[..count]);
            let position = writer.position().unwrap();
            // What comes behind that is forgotten: records, and half a record.
            writer.write(&records[count]).unwrap();
            drop(writer);
            let mut file = OpenOptions::new().append(true).open(&path).unwrap();
            file.write_all(b"{\"record\": ").unwrap();
            drop(file);
            // Its name matters no more.
            let moved = folder.path().join("moved");
            fs::rename(&path, &moved).unwrap();
            let mut writer = TraceWriter::resume(&moved, &position).unwrap();
            assert_eq!(writer.position().unwrap(), position, "{name} at {count}");
            for record in &records[count..] {
                writer.write(record).unwrap();
            }
            writer.finish().unwrap();
            assert!(fs::read(&moved).unwrap() == whole, "{name} at {count}");
        }
    }
}

#[test]
fn a_position_before_the_header_is_one_as_well() {
    let folder = tempfile::tempdir().unwrap();
    for name in NAMES {
        let path = folder.path().join(name);
        let whole = whole(&path, &records());
        let position = TraceWriter::create_resumable(&path, false)
            .unwrap()
            .position()
            .unwrap();
        fs::write(&path, "something else").unwrap();
        let mut writer = TraceWriter::resume(&path, &position).unwrap();
        write_all(&mut writer, &records());
        writer.finish().unwrap();
        assert!(fs::read(&path).unwrap() == whole, "{name}");
    }
}

#[test]
fn members_cut_anywhere_give_their_whole_records() {
    let folder = tempfile::tempdir().unwrap();
    let records = many();
    for name in &NAMES[2..] {
        let path = folder.path().join(name);
        let mut writer = TraceWriter::create_resumable(&path, false).unwrap();
        writer.write(&Record::Header(Box::new(header()))).unwrap();
        let mut ends = vec![(fs::metadata(&path).unwrap().len() as usize, 0)];
        for (count, record) in records.iter().enumerate() {
            writer.write(record).unwrap();
            let length = fs::metadata(&path).unwrap().len() as usize;
            if length > ends[ends.len() - 1].0 {
                ends.push((length, count + 1));
            }
        }
        writer.finish().unwrap();
        assert!(ends.len() > 4, "{name}: {ends:?}");
        let bytes = fs::read(&path).unwrap();
        for (place, &(end, count)) in ends.iter().enumerate() {
            let next = ends.get(place + 1).map_or(records.len(), |next| next.1);
            for cut in (end..bytes.len().min(end + 30)).chain([end + 5000]) {
                let (found, truncated) = read(&bytes[..cut.min(bytes.len() - 1)]).unwrap();
                assert!((count..=next).contains(&found.len()), "{name} cut at {cut}");
                assert!(found[..] == records[..found.len()], "{name} cut at {cut}");
                assert_eq!(truncated, found.len() < records.len(), "{name}");
            }
        }
    }
}

#[test]
fn only_the_same_trace_goes_on() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("t.jsonl");
    let mut writer = TraceWriter::create_resumable(&path, false).unwrap();
    write_all(&mut writer, &records()[..2]);
    let position = writer.position().unwrap();
    if cfg!(unix) {
        for error in [
            TraceWriter::resume(&path, &position).unwrap_err(),
            TraceWriter::create_resumable(&path, true).unwrap_err(),
        ] {
            assert!(matches!(error, TraceError::InUse { .. }), "{error}");
        }
    }
    drop(writer);
    assert!(TraceWriter::resume(&path, &position).is_ok());
    let bytes = fs::read(&path).unwrap();
    for wrong in [&bytes[..bytes.len() - 1], &[b"x", &bytes[1..]].concat()] {
        fs::write(&path, wrong).unwrap();
        let error = TraceWriter::resume(&path, &position).unwrap_err();
        assert!(matches!(error, TraceError::NotTheSame { .. }), "{error}");
        assert!(fs::read(&path).unwrap() == wrong);
    }

    let path = folder.path().join("t.jsonl.gz");
    let mut writer = TraceWriter::create(&path, false).unwrap();
    write_all(&mut writer, &records()[..1]);
    let error = message(writer.position());
    assert!(error.contains("one compressed stream"), "{error}");
    // Asking does no harm.
    writer.write(&records()[1]).unwrap();
    writer.finish().unwrap();
    assert_eq!(read(&fs::read(&path).unwrap()).unwrap().0.len(), 2);
}

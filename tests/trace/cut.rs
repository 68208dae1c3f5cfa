//! Traces that end too early.

use std::fs;

use volary::trace::record::*;
use volary::trace::{Compression, TraceError, TraceWriter};

use crate::sample::*;

#[test]
fn a_trace_cut_anywhere_gives_its_whole_records() {
    for name in NAMES {
        let bytes = bytes_of(name, &records());
        let plain = format(name).compression == Compression::None;
        // Where each record ends, its header's first; only told by a plain trace.
        let ends: Vec<usize> = (0..bytes.len())
            .filter(|&at| plain && bytes[at] == b'}' && matches!(bytes[at + 1], b'\n' | b','))
            .filter(|&at| {
                let line = bytes[..at]
                    .iter()
                    .rposition(|&b| b == b'\n')
                    .map_or(0, |end| end + 1);
                serde_json::from_slice::<Record>(&bytes[line..=at]).is_ok()
            })
            .collect();
        assert!(
            !plain || ends.len() == 1 + records().len(),
            "{name}: {ends:?}"
        );
        let mut most = 0;
        for cut in 0..bytes.len() {
            let found = match read(&bytes[..cut]) {
                Ok((found, truncated)) => {
                    assert_eq!(found, records()[..found.len()], "{name} cut at {cut}");
                    assert_eq!(
                        truncated,
                        found.len() < records().len(),
                        "{name} cut at {cut}"
                    );
                    Some(found.len())
                }
                Err(TraceError::NotATrace { .. }) => None,
                Err(e) => panic!("{name} cut at {cut}: {e}"),
            };
            if plain {
                let whole = ends.iter().filter(|&&end| end < cut).count();
                assert_eq!(found, whole.checked_sub(1), "{name} cut at {cut}");
            }
            let found = found.map_or(0, |count| count + 1);
            assert!(found >= most, "{name} cut at {cut}: fewer than before");
            most = found;
        }
        assert_eq!(
            most,
            1 + records().len(),
            "{name}: only the end of the stream is missing"
        );
    }
}

#[test]
fn a_dropped_writer_leaves_a_readable_trace() {
    let records = &records()[..3];
    for name in NAMES {
        let mut bytes = Vec::new();
        let mut writer = TraceWriter::new(&mut bytes, format(name));
        write_all(&mut writer, records);
        drop(writer);
        assert_eq!(read(&bytes).unwrap(), (records.to_vec(), true), "{name}");
    }
}

#[test]
fn a_killed_run_leaves_what_was_flushed() {
    let folder = tempfile::tempdir().unwrap();
    let mut large = frame(0);
    large.positions = (0..8000)
        .map(|i| vec![(i as f64).sin(), (i as f64).cos()])
        .collect();
    for name in NAMES {
        let path = folder.path().join(name);
        let mut writer = TraceWriter::create(&path, true).unwrap();
        write_all(&mut writer, &[]);
        let read_file = || read(&fs::read(&path).unwrap()).unwrap();
        assert_eq!(read_file(), (vec![], true), "{name}: the header at once");
        for count in 1..4 {
            writer.write(&Record::Frame(large.clone())).unwrap();
            assert_eq!(
                read_file().0.len(),
                count,
                "{name}: each frame of more than 64 KiB"
            );
        }
        for _ in 0..200 {
            writer.write(&Record::Contact(contact())).unwrap();
        }
        let plain = format(name).compression == Compression::None;
        assert_eq!(
            read_file().0.len() == 203,
            plain,
            "{name}: small records wait where it pays"
        );
        std::mem::forget(writer);
    }
}

//! Files on disk: kept, overwritten, refused, full.

use std::fs;
use std::io::{self, Write};

use volary::trace::record::*;
use volary::trace::{Compression, Format, Layout, TraceReader, TraceWriter, write_summary};

use crate::sample::*;

#[test]
fn an_existing_file_is_kept_unless_it_may_be_overwritten() {
    let folder = tempfile::tempdir().unwrap();
    for name in NAMES {
        let path = folder.path().join(name);
        let old = [7; 100_000];
        fs::write(&path, old).unwrap();
        let text = message(TraceWriter::create(&path, false));
        assert!(
            text.contains(name) && text.ends_with("exists already"),
            "{text}"
        );

        drop(TraceWriter::create(&path, true).unwrap());
        TraceWriter::create(&path, true).unwrap().finish().unwrap();
        assert_eq!(
            fs::read(&path).unwrap(),
            old,
            "{name}: nothing to write, nothing lost"
        );

        let mut writer = TraceWriter::create(&path, true).unwrap();
        write_all(&mut writer, &records());
        writer.finish().unwrap();
        assert_eq!(
            fs::read(&path).unwrap(),
            bytes_of(name, &records()),
            "{name}"
        );
        let reader = TraceReader::open(&path).unwrap();
        assert_eq!(reader.header(), &header());
    }
}

#[test]
fn unfit_paths_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let inside = folder.path().join("d.jsonl");
    fs::create_dir(&inside).unwrap();
    let missing = folder.path().join("missing").join("t.jsonl");
    for overwrite in [false, true] {
        let text = message(TraceWriter::create(&inside, overwrite));
        assert!(text.contains("d.jsonl: this is a folder"), "{text}");
        let text = message(write_summary(&inside, &summary(), overwrite));
        assert!(text.contains("d.jsonl: this is a folder"), "{text}");
        for text in [
            message(TraceWriter::create(&missing, overwrite)),
            message(write_summary(&missing, &summary(), overwrite)),
        ] {
            assert!(text.contains("t.jsonl: the folder"), "{text}");
            assert!(text.contains("missing does not exist"), "{text}");
        }
    }
    assert!(message(TraceReader::open(&inside)).contains("this is a folder"));
    let absent = folder.path().join("absent.jsonl");
    let text = message(TraceReader::open(&absent));
    assert!(
        text.starts_with("cannot open") && text.contains("absent.jsonl"),
        "{text}"
    );
    let csv = folder.path().join("t.csv");
    assert!(message(TraceWriter::create(&csv, true)).contains(".ndjson"));
    assert!(!csv.exists());
}

/// A sink that is full after some bytes.
struct Disk(usize);

impl Write for Disk {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let taken = bytes.len().min(self.0);
        self.0 -= taken;
        if taken == 0 {
            Err(io::ErrorKind::StorageFull.into())
        } else {
            Ok(taken)
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[test]
fn a_full_disk_is_reported_and_ends_the_trace() {
    for layout in [Layout::Lines, Layout::Array] {
        for compression in [Compression::None, Compression::Gzip, Compression::Zstd] {
            let format = Format {
                layout,
                compression,
            };
            let mut writer = TraceWriter::new(Disk(100), format);
            let text = message(writer.write(&Record::Header(Box::new(header()))));
            assert!(text.starts_with("cannot write the trace:"), "{text}");
            let text = message(writer.write(&records()[0]));
            assert!(text.contains("after an error"), "{text}");
            assert!(writer.finish().is_err());

            let room = match compression {
                Compression::None => bytes_of("t.jsonl", &[]).len(),
                _ => 2_000,
            };
            let mut writer = TraceWriter::new(Disk(room), format);
            // The header may or may not fit; a thousand frames do not.
            let _ = writer.write(&Record::Header(Box::new(header())));
            let rest =
                (0..1_000_u64).try_for_each(|step| writer.write(&Record::Frame(frame(step))));
            assert!(rest.and(writer.finish()).is_err(), "{format:?}");
        }
    }
}

#[test]
fn a_summary_file_appears_whole() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("summary.json");
    write_summary(&path, &summary(), false).unwrap();
    let read = fs::read_to_string(&path).unwrap();
    assert_eq!(serde_json::from_str::<Summary>(&read).unwrap(), summary());

    let other = Summary {
        steps: 7,
        ..summary()
    };
    let text = message(write_summary(&path, &other, false));
    assert!(text.ends_with("summary.json exists already"), "{text}");
    assert_eq!(fs::read_to_string(&path).unwrap(), read);

    let bad = Summary {
        time: f64::NAN,
        ..summary()
    };
    assert!(message(write_summary(&path, &bad, true)).contains("time is NaN"));
    assert_eq!(fs::read_to_string(&path).unwrap(), read);

    write_summary(&path, &other, true).unwrap();
    assert_eq!(
        serde_json::from_slice::<Summary>(&fs::read(&path).unwrap()).unwrap(),
        other
    );
    assert_eq!(
        fs::read_dir(folder.path()).unwrap().count(),
        1,
        "nothing else is left behind"
    );
}

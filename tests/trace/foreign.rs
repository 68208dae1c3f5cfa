//! Files that are no traces, and damaged ones.

use serde_json::json;
use volary::trace::TraceError;
use volary::trace::record::*;

use crate::sample::*;

fn header_with(change: impl Fn(&mut serde_json::Value)) -> Vec<u8> {
    let mut value = serde_json::to_value(Record::Header(Box::new(header()))).unwrap();
    change(&mut value);
    format!("{value}\n").into_bytes()
}

#[test]
fn other_files_are_no_traces() {
    for (bytes, found) in [
        (&b""[..], "it holds no data"),
        (b"\n \n", "it holds no records"),
        (b"[]", "it holds no records"),
        (b"\x7fELF\x02\x01", "it does not begin with a JSON object"),
        (b"step,time\n0,0\n", "it does not begin with a JSON object"),
        (b"{\"dimension\": 2}\n", "its first record is no header"),
        (
            b"{\n  \"dimension\": 2\n}\n",
            "its first record is no header",
        ),
        (b"[1, 2, 3]", "expected a record"),
        (b"{\"record\":\"head", "it ends inside its first record"),
    ] {
        let text = message(open(bytes));
        assert!(text.contains("the test is not a trace"), "{text}");
        assert!(text.contains(found), "{text}");
    }
    let frame_first = format!("{}\n", serde_json::to_string(&records()[0]).unwrap());
    assert!(message(open(frame_first.as_bytes())).contains("its first record is no header"));
    assert!(matches!(
        open(b"\x1f\x8b and then something else"),
        Err(TraceError::Io { .. })
    ));
}

#[test]
fn other_formats_and_versions_are_named() {
    let other = header_with(|header| header["format"] = json!("a-log"));
    let text = message(open(&other));
    assert_eq!(
        text,
        "the test is not a trace: its format is \"a-log\", not \"volary-trace\""
    );

    // A later version may hold the world in another shape.
    let later = header_with(|header| {
        header["version"] = json!(VERSION + 1);
        header["world"] = json!("elsewhere");
    });
    let text = message(open(&later));
    let expected = format!(
        "the test has version {} of the trace format; only version {VERSION}",
        VERSION + 1
    );
    assert!(text.starts_with(&expected), "{text}");

    let broken = header_with(|header| header["world"] = json!("elsewhere"));
    let text = message(open(&broken));
    assert!(
        text.starts_with("the test, line 1: not a trace record:"),
        "{text}"
    );
}

#[test]
fn garbage_between_records_is_an_error_with_its_line() {
    let lines = String::from_utf8(bytes_of("t.jsonl", &records())).unwrap();
    let lines: Vec<&str> = lines.lines().collect();
    for (place, garbage, problem) in [
        (2, "garbage", "not a trace record"),
        (
            2,
            r#"{"record":"frame","step":1,"time":0."#,
            "not a trace record",
        ),
        (3, r#"{"record":"dream"}"#, "unknown variant `dream`"),
        (
            1,
            r#"{"record":"contact","agent":1}"#,
            "missing field `with`",
        ),
        (3, lines[0], "a second header"),
        (5, lines[1], "behind its summary"),
    ] {
        let mut spoilt = lines.clone();
        spoilt.insert(place, garbage);
        let mut reader = open((spoilt.join("\n") + "\n").as_bytes()).unwrap();
        let before: Vec<_> = reader
            .by_ref()
            .take(place - 1)
            .map(Result::unwrap)
            .collect();
        assert_eq!(before, records()[..place - 1]);
        let text = message(reader.next().unwrap());
        assert!(
            text.starts_with(&format!("the test, line {}: ", place + 1)),
            "{text}"
        );
        assert!(text.contains(problem), "{text}");
        assert!(reader.next().is_none(), "the iterator ends behind an error");
    }
}

#[test]
fn garbage_in_an_array_is_an_error_with_its_line() {
    let array = String::from_utf8(bytes_of("t.json", &records())).unwrap();
    let lines: Vec<&str> = array.lines().collect();
    for (place, garbage, problem) in [
        (3, "garbage", "expected a record"),
        (3, ",", "expected a record"),
        (3, r#"{"record":"dream"},"#, "unknown variant `dream`"),
        (6, lines[2], "expected a comma"),
        (7, "[", "expected nothing"),
    ] {
        let mut spoilt = lines.clone();
        spoilt.insert(place, garbage);
        let text = message(read(spoilt.join("\n").as_bytes()));
        assert!(
            text.starts_with(&format!("the test, line {}: ", place + 1)),
            "{text}"
        );
        assert!(text.contains(problem), "{text}");
    }
}

#[test]
fn a_last_line_counts_if_its_record_is_closed() {
    let mut bytes = bytes_of("t.jsonl", &[]);
    bytes.extend(br#"{"record":"frame","step":0,"time":0.5,"positions":[],"velocities":[]}"#);
    assert_eq!(read(&bytes).unwrap().0.len(), 1);
    bytes.pop();
    assert_eq!(read(&bytes).unwrap(), (vec![], true), "cut");
    bytes.extend(b"\0\0\0\0");
    assert_eq!(
        read(&bytes).unwrap(),
        (vec![], true),
        "zeros left by a power cut"
    );
    bytes.push(b'\n');
    assert!(read(&bytes).is_err(), "a whole line that is no record");
}

#[test]
fn damage_to_a_compressed_stream_is_an_error() {
    for name in ["t.jsonl.gz", "t.json.zst"] {
        let mut bytes = bytes_of(name, &records());
        let middle = bytes.len() / 2;
        bytes[middle] ^= 0x40;
        assert!(read(&bytes).is_err(), "{name}");
    }
}

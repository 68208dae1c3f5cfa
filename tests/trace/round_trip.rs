//! What is written is read, in every format.

use proptest::prelude::*;
use volary::trace::record::*;

use crate::sample::*;

/// Every finite number, the odd ones often.
fn number() -> impl Strategy<Value = f64> {
    let odd = [
        0.0,
        -0.0,
        5e-324,
        -2.225e-308,
        f64::MIN_POSITIVE,
        f64::MAX,
        f64::MIN,
        1e16,
        0.1,
    ];
    prop_oneof![
        3 => any::<u64>().prop_map(f64::from_bits).prop_filter("finite", |x| x.is_finite()),
        1 => prop::sample::select(odd.to_vec()),
    ]
}

fn bits(vectors: &[Vec<f64>]) -> Vec<Vec<u64>> {
    let of = |vector: &Vec<f64>| vector.iter().map(|x| x.to_bits()).collect();
    vectors.iter().map(of).collect()
}

proptest! {
    #[test]
    fn numbers_read_back_bit_for_bit(
        time in number(),
        vectors in prop::collection::vec(prop::collection::vec(number(), 3), 0..20),
        gap in prop::option::of(number()),
    ) {
        let mut sent = frame(7);
        (sent.time, sent.positions) = (time, vectors.clone());
        sent.metrics = Some(Metrics { agent_gap: gap, ..metrics() });
        for name in NAMES {
            let (read, truncated) = read(&bytes_of(name, &[Record::Frame(sent.clone())])).unwrap();
            prop_assert!(truncated, "there is no summary");
            let [Record::Frame(got)] = &read[..] else { panic!("{read:?}") };
            prop_assert_eq!(bits(&got.positions), bits(&vectors), "{}", name);
            prop_assert_eq!(got.time.to_bits(), time.to_bits());
            let got_gap = got.metrics.as_ref().unwrap().agent_gap;
            prop_assert_eq!(got_gap.map(f64::to_bits), gap.map(f64::to_bits));
        }
    }
}

#[test]
fn every_format_gives_back_every_record() {
    for name in NAMES {
        let bytes = bytes_of(name, &records());
        assert_eq!(open(&bytes).unwrap().header(), &header(), "{name}");
        assert_eq!(read(&bytes).unwrap(), (records(), false), "{name}");
        assert_eq!(
            bytes,
            bytes_of(name, &records()),
            "{name}: the same bytes every time"
        );
    }
}

#[test]
fn lines_hold_a_record_each_and_an_array_is_one_document() {
    let lines = String::from_utf8(bytes_of("t.jsonl", &records())).unwrap();
    let each: Vec<Record> = lines
        .lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect();
    assert_eq!(each[1..], records());
    assert!(lines.ends_with("}\n"));

    let array = String::from_utf8(bytes_of("t.json", &records())).unwrap();
    let all: Vec<Record> = serde_json::from_str(&array).unwrap();
    assert_eq!(all, each);
    assert_eq!(
        array.lines().count(),
        each.len() + 2,
        "brackets on lines of their own"
    );
}

#[test]
fn arrays_may_be_formatted_anew() {
    let document: serde_json::Value =
        serde_json::from_slice(&bytes_of("t.json", &records())).unwrap();
    for text in [document.to_string(), format!("{document:#}")] {
        assert_eq!(read(text.as_bytes()).unwrap(), (records(), false), "{text}");
    }
}

//! Which part of a trace is exported.

use std::num::NonZeroU64;

use crate::trace::Record;

/// Times are met within this share of a step: what people write in decimals is seldom a sum of
/// steps to the last bit.
const SLACK: f64 = 1e-6;

/// Which records of a trace are exported; all of them by default.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Selection {
    /// The first time of interest; the trace's first when absent.
    pub from: Option<f64>,
    /// The last time of interest; the trace's last when absent.
    pub to: Option<f64>,
    /// Take every so-manieth frame from the first of interest on; 1 when absent.
    pub every: Option<NonZeroU64>,
}

/// A selection on its way along a trace.
#[derive(Debug)]
pub(super) struct Selecting {
    from: f64,
    to: f64,
    every: u64,
    /// Frames of interest so far.
    seen: u64,
}

impl Selecting {
    /// Selects from a trace with steps of this size.
    pub fn new(selection: &Selection, step: f64) -> Self {
        let slack = SLACK * step;
        Self {
            from: selection.from.map_or(f64::NEG_INFINITY, |t| t - slack),
            to: selection.to.map_or(f64::INFINITY, |t| t + slack),
            every: selection.every.map_or(1, NonZeroU64::get),
            seen: 0,
        }
    }

    /// Whether the next record is exported: frames at times of interest, contacts that lasted
    /// at one, and whatever has no time of its own.
    pub fn takes(&mut self, record: &Record) -> bool {
        match record {
            Record::Frame(frame) if (self.from..=self.to).contains(&frame.time) => {
                self.seen += 1;
                (self.seen - 1).is_multiple_of(self.every)
            }
            Record::Frame(_) => false,
            Record::Contact(contact) => contact.end >= self.from && contact.begin <= self.to,
            Record::Header(_) | Record::Summary(_) => true,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trace::record::Frame;

    fn taken(selection: Selection) -> Vec<u64> {
        let mut selecting = Selecting::new(&selection, 0.1);
        let steps = (0..=10).filter(|&step| {
            let time = step as f64 * 0.1;
            let frame = Frame {
                step,
                time,
                ..Frame::default()
            };
            selecting.takes(&Record::Frame(frame))
        });
        steps.collect()
    }

    #[test]
    fn takes_frames_by_time_and_number() {
        assert_eq!(taken(Selection::default()), (0..=10).collect::<Vec<_>>());
        // 3 × 0.1 is above 0.3, and 7 × 0.1 above 0.7.
        let (from, to) = (Some(0.3), Some(0.7));
        let some = Selection {
            from,
            to,
            every: None,
        };
        assert_eq!(taken(some), [3, 4, 5, 6, 7]);
        let every = NonZeroU64::new(3);
        assert_eq!(taken(Selection { every, ..some }), [3, 6]);
        assert_eq!(
            taken(Selection {
                to: None,
                every,
                ..some
            }),
            [3, 6, 9]
        );
    }
}

//! Going through a trace once.

use std::collections::BTreeSet;
use std::path::Path;

use serde_json::{Map, Value, to_value};

use super::derived::{Derived, NAMES};
use super::frames::Frames;
use super::path::each_leaf;
use super::quantity::Found;
use super::{Course, Listing, Probe, Quantity, SeriesError};
use crate::trace::record::{Contact, Frame, Header, Partner};
use crate::trace::{Record, TraceReader};
use crate::world::nearest_path;

/// Times are met within this share of a step, as by exports: what people write in decimals is
/// seldom a sum of steps to the last bit.
const SLACK: f64 = 1e-6;

/// The points that all courses of a run keep together.
const POINTS: usize = 1 << 20;

/// A stretch of time, both ends within; open where there is none.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Span {
    /// Where it begins.
    pub from: Option<f64>,
    /// Where it ends.
    pub to: Option<f64>,
}

impl Span {
    /// Whether a time is in it.
    pub fn holds(&self, time: f64) -> bool {
        self.from.is_none_or(|from| time >= from) && self.to.is_none_or(|to| time <= to)
    }

    /// The same with room at its ends for how times of steps of this size are written.
    fn with_slack(self, step: f64) -> Self {
        Self {
            from: self.from.map(|from| from - SLACK * step),
            to: self.to.map(|to| to + SLACK * step),
        }
    }

    fn words(&self) -> String {
        match (self.from, self.to) {
            (None, None) => "at all".to_owned(),
            (Some(from), None) => format!("from time {from} on"),
            (None, Some(to)) => format!("up to time {to}"),
            (Some(from), Some(to)) => format!("from time {from} to {to}"),
        }
    }
}

/// A trace that is about to be read.
#[derive(Debug)]
pub struct Reading {
    name: String,
    trace: TraceReader,
    frames: Frames,
}

/// What was kept of a trace.
#[derive(Debug, Clone)]
pub struct Run {
    /// The trace: the path that it was opened by.
    pub name: String,
    /// What ran.
    pub header: Header,
    /// What was probed, one course for each probe.
    pub courses: Vec<Course>,
    /// The values of the probes that are quantities in the first frame of the trace, also where
    /// that is before the time asked for.
    pub starts: Vec<Option<f64>>,
    /// Times at which contacts between agents began, in the time asked for.
    pub agent_contacts: Vec<f64>,
    /// Times at which contacts with obstacles began, in the time asked for.
    pub obstacle_contacts: Vec<f64>,
    /// First and last time of a frame in the time asked for.
    pub times: [f64; 2],
    /// Whether the trace ends without its summary.
    pub truncated: bool,
}

impl Reading {
    /// Opens a trace and reads its header.
    ///
    /// # Errors
    /// What keeps it from being read as a trace; a world of other than 2 or 3 dimensions.
    pub fn open(path: &Path) -> Result<Self, SeriesError> {
        let name = path.display().to_string();
        let trace = TraceReader::open(path)?;
        let frames = Frames::of(&name, trace.header())?;
        Ok(Self {
            name,
            trace,
            frames,
        })
    }

    /// The path that it was opened by.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The header.
    pub fn header(&self) -> &Header {
        self.trace.header()
    }

    /// Reads the trace to its end, or as far as it goes, and keeps what the probes tell in this
    /// time, ends met within a millionth of a step. `seen` is told the steps of each frame. All
    /// courses together keep about a million points, each at least [`Course::LEAST`] and at most
    /// [`Course::MOST`].
    ///
    /// # Errors
    /// A record that is none; a frame without a position and a velocity for each agent, or not
    /// later than the one before; no frame in this time; a quantity that is not recorded.
    pub fn keep(
        mut self,
        probes: &[Probe],
        span: Span,
        mut seen: impl FnMut(u64),
    ) -> Result<Run, SeriesError> {
        let header = self.trace.header().clone();
        let derived = Derived::of(&header);
        let near = span.with_slack(header.world.time.step);
        let quantities = || probes.iter().filter_map(Probe::quantity);
        let mut recorded = BTreeSet::new();
        let mut missing: Vec<bool> = vec![true; probes.len()];
        let mut courses = vec![Course::of_at_most(POINTS / probes.len().max(1)); probes.len()];
        let mut starts = vec![None; probes.len()];
        let (mut agent_contacts, mut obstacle_contacts) = (Vec::new(), Vec::new());
        let mut times: Option<[f64; 2]> = None;
        let mut first = true;
        for record in self.trace.by_ref() {
            let frame = match record? {
                Record::Frame(frame) => frame,
                Record::Contact(Contact { begin, with, .. }) => {
                    let begins = match with {
                        Partner::Agent => &mut agent_contacts,
                        Partner::Obstacle => &mut obstacle_contacts,
                    };
                    begins.extend(near.holds(begin).then_some(begin));
                    continue;
                }
                Record::Header(_) | Record::Summary(_) => continue,
            };
            self.frames.check(&frame)?;
            seen(frame.step);
            let within = near.holds(frame.time);
            if within {
                times = Some([times.map_or(frame.time, |it| it[0]), frame.time]);
            }
            if !within && !first {
                continue;
            }
            let tree = match quantities().next() {
                Some(_) => tree(&frame, quantities()),
                None => Value::Null,
            };
            for (k, probe) in probes.iter().enumerate() {
                let found = probe.of(&tree, &frame, &derived);
                missing[k] &= found == Found::Nothing;
                if found == Found::Nothing {
                    each_leaf(&tree, "", &mut |path, _| {
                        if !recorded.contains(path) {
                            recorded.insert(path.to_owned());
                        }
                    });
                }
                if first && let Found::Value(value) = found {
                    starts[k] = Some(value);
                }
                if within {
                    courses[k].push(probe.point(found, &frame));
                }
            }
            first = false;
        }
        let times = times.ok_or_else(|| SeriesError::Empty {
            name: self.name.clone(),
            between: span.words(),
        })?;
        for (k, probe) in probes.iter().enumerate() {
            if let Some(quantity) = probe.quantity()
                && missing[k]
            {
                return Err(unknown(&self.name, quantity, &recorded));
            }
        }
        Ok(Run {
            truncated: self.trace.truncated(),
            name: self.name,
            header,
            courses,
            starts,
            agent_contacts,
            obstacle_contacts,
            times,
        })
    }

    /// Reads the trace to its end and lists what it records.
    ///
    /// # Errors
    /// A record that is none; a frame as [`keep`](Self::keep) refuses it; a trace without frames.
    pub fn list(mut self, mut seen: impl FnMut(u64)) -> Result<Listing, SeriesError> {
        let header = self.trace.header().clone();
        let derived = Derived::of(&header);
        let mut listing = Listing::default();
        for record in self.trace.by_ref() {
            if let Record::Frame(frame) = record? {
                self.frames.check(&frame)?;
                seen(frame.step);
                listing.add(&tree(&frame, std::iter::empty()), &frame, &derived);
            }
        }
        listing.truncated = self.trace.truncated();
        match listing.frames {
            0 => Err(SeriesError::Empty {
                name: self.name,
                between: Span::default().words(),
            }),
            _ => Ok(listing),
        }
    }
}

impl Probe {
    fn quantity(&self) -> Option<&Quantity> {
        match self {
            Self::Quantity(quantity) => Some(quantity),
            _ => None,
        }
    }

    /// What a frame has of a quantity; of other probes nothing that could be missing.
    fn of(&self, tree: &Value, frame: &Frame, derived: &Derived) -> Found {
        match self {
            Self::Quantity(quantity) => quantity.of(tree, frame, derived),
            _ => Found::Undefined,
        }
    }

    /// The point of a frame.
    fn point(&self, found: Found, frame: &Frame) -> Option<[f64; 2]> {
        match *self {
            Self::Quantity(_) => match found {
                Found::Value(value) => Some([frame.time, value]),
                _ => None,
            },
            Self::Component {
                agent,
                motion,
                axis,
            } => Some([frame.time, motion.of(frame, agent, axis)?]),
            Self::Place {
                agent,
                motion,
                axes: [x, y],
            } => Some([motion.of(frame, agent, x)?, motion.of(frame, agent, y)?]),
        }
    }
}

/// What a frame records, as JSON, without the lists of all agents that no quantity reads.
fn tree<'a>(frame: &Frame, quantities: impl Iterator<Item = &'a Quantity> + Clone) -> Value {
    let mut fields = Map::new();
    let mut put = |name: &str, value: serde_json::Result<Value>| {
        if let Ok(value) = value
            && !value.is_null()
        {
            fields.insert(name.to_owned(), value);
        }
    };
    put("metrics", to_value(&frame.metrics));
    put("laws", to_value(&frame.laws));
    put("net", to_value(&frame.net));
    let reads = |field: &str| quantities.clone().any(|it| it.reads(field));
    let mut of_agents = |name: &str, value: &dyn Fn() -> serde_json::Result<Value>| {
        if reads(name) {
            put(name, value());
        }
    };
    of_agents("positions", &|| to_value(&frame.positions));
    of_agents("velocities", &|| to_value(&frame.velocities));
    of_agents("rotations", &|| to_value(&frame.rotations));
    of_agents("accelerations", &|| to_value(&frame.accelerations));
    of_agents("beta_agents", &|| to_value(&frame.beta_agents));
    of_agents("obstacles", &|| to_value(&frame.obstacles));
    Value::Object(fields)
}

/// How many names a message lists at most.
const LISTED: usize = 12;

/// What there is instead of a quantity.
fn unknown(name: &str, quantity: &Quantity, recorded: &BTreeSet<String>) -> SeriesError {
    let all = recorded.iter().map(String::as_str);
    let all: Vec<&str> = all.chain(NAMES).collect();
    // Names by place, as shipped worlds are by paper.
    let places: Vec<String> = all.iter().map(|it| it.replace('.', "/")).collect();
    let places: Vec<&str> = places.iter().map(String::as_str).collect();
    let near = nearest_path(&quantity.name().replace('.', "/"), &places);
    SeriesError::Unknown {
        name: name.to_owned(),
        quantity: quantity.name().to_owned(),
        hint: match near {
            Some(near) => format!(" did you mean {}?", near.replace('/', ".")),
            None => String::new(),
        },
        recorded: match all.len() <= LISTED {
            true => format!("it records {}", all.join(", ")),
            false => "`--list` names all that it does".to_owned(),
        },
    }
}

//! A folder with worlds, and the command run in it.

use std::path::{Path, PathBuf};
use std::time::Duration;
use std::{fs, process};

use serde_json::{Value, json};
use tempfile::TempDir;
use volary::trace::record::{Frame, Summary};
use volary::trace::{Record, TraceReader};

/// The program under test.
pub const VOLARY: &str = env!("CARGO_BIN_EXE_volary");

/// A folder of its own for each test.
pub struct Scene(TempDir);

/// What the command did.
#[derive(Debug)]
pub struct Done {
    pub code: Option<i32>,
    pub out: String,
    pub err: String,
}

impl Scene {
    /// An empty folder.
    pub fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    /// A folder with one world, `w.json`.
    pub fn with(world: &Value) -> Self {
        let scene = Self::new();
        scene.put("w.json", &world.to_string());
        scene
    }

    /// A path in the folder.
    pub fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// Writes a file.
    pub fn put(&self, name: &str, text: &str) {
        fs::write(self.path(name), text).unwrap();
    }

    /// The bytes of a file.
    pub fn bytes(&self, name: &str) -> Vec<u8> {
        fs::read(self.path(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    /// The names of all files, sorted.
    pub fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(self.0.path()).unwrap();
        let name = |entry: fs::DirEntry| entry.file_name().into_string().unwrap();
        let mut names: Vec<_> = entries.map(|entry| name(entry.unwrap())).collect();
        names.sort();
        names
    }

    /// Runs the command, its arguments parted by spaces.
    pub fn volary(&self, arguments: &str) -> Done {
        let output = assert_cmd::Command::new(VOLARY)
            .args(arguments.split_whitespace())
            .current_dir(self.0.path())
            .timeout(Duration::from_secs(120))
            .output()
            .unwrap();
        Done::from(output)
    }

    /// As [`Scene::volary`], for a command that must succeed.
    pub fn succeeds(&self, arguments: &str) -> String {
        let done = self.volary(arguments);
        assert_eq!(done.code, Some(0), "volary {arguments}: {done:?}");
        assert_eq!(done.err, "", "volary {arguments}");
        done.out
    }

    /// As [`Scene::volary`], for a command that must end with this code and say all of this.
    pub fn fails(&self, arguments: &str, code: i32, says: &[&str]) {
        let done = self.volary(arguments);
        assert_eq!(done.code, Some(code), "volary {arguments}: {done:?}");
        for text in says {
            assert!(
                done.err.contains(text),
                "volary {arguments} does not say {text:?}: {done:?}"
            );
        }
        let plain = !done.err.contains(['\u{1b}', '\r']) && !done.err.contains("panicked");
        assert!(plain, "volary {arguments}: {done:?}");
    }

    /// The records of a trace behind its header.
    pub fn records(&self, trace: &str) -> Vec<Record> {
        let reader = TraceReader::open(&self.path(trace)).unwrap();
        reader.map(Result::unwrap).collect()
    }

    /// The frames of a trace.
    pub fn frames(&self, trace: &str) -> Vec<Frame> {
        let frame = |record| match record {
            Record::Frame(frame) => Some(frame),
            _ => None,
        };
        self.records(trace).into_iter().filter_map(frame).collect()
    }

    /// The summary that ends a trace.
    pub fn summary(&self, trace: &str) -> Summary {
        match self.records(trace).pop() {
            Some(Record::Summary(summary)) => *summary,
            other => panic!("{trace} ends in {other:?}"),
        }
    }
}

impl From<process::Output> for Done {
    fn from(output: process::Output) -> Self {
        Self {
            code: output.status.code(),
            out: String::from_utf8(output.stdout).unwrap(),
            err: String::from_utf8(output.stderr).unwrap(),
        }
    }
}

/// JSON of a file.
pub fn json(path: &Path) -> Value {
    serde_json::from_slice(&fs::read(path).unwrap()).unwrap()
}

/// Agents that touch each other and fly into an obstacle, in 100 steps.
pub fn crowd(dimension: usize) -> Value {
    pack(dimension, 30, 5.0)
}

/// As [`crowd`], with this many agents in a box of this side.
pub fn pack(dimension: usize, count: usize, side: f64) -> Value {
    let along_x = |x: f64, rest: f64| {
        let mut vector = vec![rest; dimension];
        vector[0] = x;
        vector
    };
    json!({
        "dimension": dimension,
        "time": { "end": 1 },
        "agents": [{
            "count": count,
            "radius": 0.3,
            "positions": { "box": { "min": along_x(0.0, 0.0), "max": along_x(side, side) } },
            "velocities": { "uniform": { "min": along_x(-1.0, -1.0), "max": along_x(5.0, 1.0) } }
        }],
        "obstacles": [
            { "shape": { "ball": { "radius": side / 2.0 } }, "position": along_x(1.5 * side + 0.5, side / 2.0) },
            { "shape": { "half_space": { "normal": along_x(1.0, 0.0) } }, "position": along_x(-0.5, 0.0) }
        ],
        "laws": [
            { "alpha_interaction": { "spacing": 0.5, "range": 1.5 } },
            { "obstacle_avoidance": { "range": 0.6, "standoff": 0.5, "gain": 0.2 } },
            { "navigation": { "velocity": along_x(4.0, 0.0), "velocity_gain": 3 } }
        ]
    })
}

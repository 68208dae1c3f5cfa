//! A world file being read: its text, and what is set from outside.

use std::panic::resume_unwind;
use std::sync::Mutex;

use serde_json::Value;

use super::check;
use super::problem::Problem;
use super::report::Report;
use super::resolve::AnyWorld;
use super::set::Override;
use super::spec::WorldSpec;
use super::watch::{Stage, Watch};
use super::{syntax, validate};

/// Stack for reading, in bytes. Brackets may stand 127 deep, and an override a hundred deep more;
/// without optimisation a level takes a few kilobytes.
const STACK: usize = 16 << 20;

/// The text of a world file with the overrides that apply to it.
///
/// It is read in stages: JSON, overrides, schema, and last what only the fields
/// together can tell. Each stage reports everything that it finds; the next one
/// starts only where it finds nothing.
#[derive(Debug, Clone)]
pub struct Document {
    name: String,
    text: String,
    overrides: Vec<Override>,
    watch: Watch,
    motion: check::Motion,
}

impl Document {
    /// A document; its name is what messages call it, mostly the file's path.
    pub fn new(name: impl Into<String>, text: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            text: text.into(),
            overrides: Vec::new(),
            watch: Watch::default(),
            motion: check::Motion::OfBodies,
        }
    }

    /// The same document with more overrides, which apply in order.
    pub fn with(mut self, overrides: impl IntoIterator<Item = Override>) -> Self {
        self.overrides.extend(overrides);
        self
    }

    /// The same document, with someone who watches while it becomes a world.
    pub fn watched(mut self, watch: Watch) -> Self {
        self.watch = watch;
        self
    }

    /// The same document, of a world whose agents move in this way: points need no steps that
    /// are short enough for bodies.
    pub fn moved(self, motion: check::Motion) -> Self {
        Self { motion, ..self }
    }

    /// What the messages call it.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The checked world, or everything that is wrong with it.
    pub fn spec(&self) -> Result<WorldSpec, Report> {
        with_room(|| self.read())
    }

    /// The resolved world under a name of its own, or everything that is wrong with it.
    pub fn world(&self, name: impl Into<String>) -> Result<AnyWorld, Report> {
        let name = name.into();
        // In one go: what reading frees serves the world, as it does not from thread to thread.
        with_room(|| {
            self.tell(Stage::Reading)?;
            let spec = self.read()?;
            AnyWorld::resolve(name, spec, &self.watch).map_err(|problems| self.report(problems))
        })
    }

    /// Problems, found here or later, placed in this document by their paths.
    pub fn report(&self, problems: Vec<Problem>) -> Report {
        Report::placed(&self.name, &self.text, &self.overrides, problems)
    }

    fn read(&self) -> Result<WorldSpec, Report> {
        let mut world = syntax::value(&self.text)
            .map_err(|found| Report::found(&self.name, &self.text, found))?;
        self.clear(self.override_in(&mut world))?;
        settle_whole_numbers(&mut world);
        let problems = validate::problems(&world);
        if !problems.is_empty() {
            // It takes far more memory than the text, and telling of problems takes as much.
            drop(world);
            return Err(self.report(problems));
        }
        let spec: WorldSpec = serde_json::from_value(world)
            .map_err(|error| self.report(vec![Problem::new("", error.to_string())]))?;
        self.clear(check::joint_problems(&spec, self.motion))?;
        Ok(spec)
    }

    fn tell(&self, stage: Stage) -> Result<(), Report> {
        let told = self.watch.tell(stage);
        told.map_err(|stopped| self.report(vec![stopped]))
    }

    fn clear(&self, problems: Vec<Problem>) -> Result<(), Report> {
        match problems.is_empty() {
            true => Ok(()),
            false => Err(self.report(problems)),
        }
    }

    fn override_in(&self, world: &mut Value) -> Vec<Problem> {
        let results = self.overrides.iter().map(|set| set.apply(world));
        results.filter_map(Result::err).collect()
    }
}

/// Does something on a stack of its own: what stands inside one another is read so as well, and
/// the caller's stack may be small.
fn with_room<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    let work = Mutex::new(Some(work));
    let todo = || work.lock().ok().and_then(|mut work| work.take());
    let there = std::thread::scope(|scope| {
        let thread = std::thread::Builder::new().stack_size(STACK);
        let thread = thread
            .spawn_scoped(scope, || todo().map(|work| work()))
            .ok()?;
        thread.join().unwrap_or_else(|panic| resume_unwind(panic))
    });
    // Where the system has no thread to give, here.
    there.unwrap_or_else(|| todo().expect("it was not begun")())
}

/// Writes 10.0 and 1e1 as 10: JSON Schema takes them for whole numbers, serde
/// does not.
fn settle_whole_numbers(value: &mut Value) {
    /// Above this, doubles skip whole numbers.
    const EXACT: f64 = 9_007_199_254_740_992.0;
    match value {
        Value::Array(entries) => entries.iter_mut().for_each(settle_whole_numbers),
        Value::Object(fields) => fields.values_mut().for_each(settle_whole_numbers),
        Value::Number(number) if number.is_f64() => {
            let x = number.as_f64().unwrap_or_default();
            // −0.0 stays, since no whole number has its sign.
            if x.fract() == 0.0 && x.abs() <= EXACT && !(x == 0.0 && x.is_sign_negative()) {
                *number = (x as i64).into();
            }
        }
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WORLD: &str = r#"{
  "dimension": 2,
  "time": {"end": 1},
  "agents": [{"radius": 0.5, "positions": {"explicit": [[0, 0], [2, 0]]}}]
}"#;

    fn read(sets: &[&str]) -> Result<WorldSpec, String> {
        let sets = sets.iter().map(|set| set.parse().unwrap());
        let document = Document::new("w.json", WORLD).with(sets);
        document.spec().map_err(|report| report.to_string())
    }

    #[test]
    fn overrides_apply_in_order() {
        let spec = read(&[
            "time.end=2",
            "time.end=3.0",
            "seed=7.0",
            "physics.friction=0.5",
        ])
        .unwrap();
        assert_eq!(
            (spec.time.end, spec.seed, spec.physics.friction),
            (3.0, 7, 0.5)
        );
    }

    #[test]
    fn problems_name_the_override() {
        let bad = |set| read(&[set]).unwrap_err();
        assert_eq!(
            bad("time.step=-1"),
            "w.json: --set time.step=-1: must be greater than 0"
        );
        assert_eq!(
            bad("time={\"end\": 1, \"step\": 0}"),
            "w.json: --set time={\"end\": 1, \"step\": 0}: time.step: must be greater than 0"
        );
        assert_eq!(
            bad("tine.end=1"),
            "w.json: --set tine.end=1: tine: unknown field; allowed: agents, claims, \
             description, dimension, laws, notes, obstacles, physics, record, seed, time; did you mean `time`?"
        );
        assert_eq!(
            bad("agents[1].radius=1"),
            "w.json: --set agents[1].radius=1: `agents` has no entry 1; allowed: 0"
        );
        assert_eq!(
            bad("time.end=soon"),
            "w.json: --set time.end=soon: must be a number, not a string"
        );
    }

    #[test]
    fn problems_of_the_file_keep_their_line() {
        let bad = read(&["agents[0].count=3"]).unwrap_err();
        assert_eq!(
            bad,
            "w.json: --set agents[0].count=3: must be 2, the number of positions listed; it may be left out"
        );
        let bad = read(&["dimension=3"]).unwrap_err();
        let first =
            "w.json:4:57: agents[0].positions.explicit[0] = [0, 0]: must have 3 numbers, not 2";
        assert_eq!(bad.lines().next(), Some(first));
    }

    #[test]
    fn seeds_fill_64_bits_and_no_more() {
        assert_eq!(read(&["seed=18446744073709551615"]).unwrap().seed, u64::MAX);
        let bad = read(&["seed=18446744073709551616"]).unwrap_err();
        assert!(
            bad.starts_with("w.json: --set seed=18446744073709551616: must be"),
            "{bad}"
        );
        assert!(read(&["seed=-1"]).is_err());
        assert!(read(&["seed=1e300"]).is_err());
    }

    #[test]
    fn later_stages_can_report() {
        let document = Document::new("w.json", WORLD);
        let problem = Problem::new("agents[0].radius", "leaves no room");
        let report = document.report(vec![problem]);
        assert_eq!(
            report.to_string(),
            "w.json:4:25: agents[0].radius = 0.5: leaves no room"
        );
        assert_eq!(report.problems().len(), 1);
        assert!(report.render(false).contains("w.json:4:25"));
        assert!(!report.render(false).contains('\u{1b}'));
        assert!(report.render(true).contains('\u{1b}'));
    }
}

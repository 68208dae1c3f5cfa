//! Figure 8: the full model and its leading order, from either start.

use super::{FAST, epsilon};
use crate::figure::course::{Course, Courses, Of};
use crate::figure::page::{against_time, page};
use crate::figure::{Trouble, number, numbers};
use crate::picture::{Picture, Theme};
use crate::plot::{Axis, Item};
use crate::reduced::{FastFlocking, NoReduction};

/// From when on velocities are compared; before, the layer is not over.
const AFTER: f64 = 10.0;

/// Where the leading order starts from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::figure) enum Start {
    /// (4.25).
    Printed,
    /// The limit of the layer (4.23).
    Limit,
}

/// The differences of one run from its leading order.
pub(in crate::figure) struct Differences {
    pub(in crate::figure) epsilon: f64,
    /// The time, max |x_i − x_i0| and max |v_i − v_i0|, at each frame.
    pub(in crate::figure) seen: Vec<[f64; 3]>,
}

impl Differences {
    pub(in crate::figure) fn of(course: &Course, start: Start) -> Result<Self, Trouble> {
        let trouble = |problem: NoReduction| Trouble::new(&course.world.name, problem);
        let mut reduced = FastFlocking::new(&course.world).map_err(trouble)?;
        if start == Start::Printed {
            reduced.start = reduced.printed;
        }
        let leading = reduced.leading_order(&course.times());
        let leading = leading.map_err(trouble)?;
        let pairs = course.frames.iter().zip(&leading);
        let seen = pairs.map(|(frame, leading)| {
            let states = [Of::Positions, Of::Velocities].map(|of| of.vectors(frame));
            let [position, velocity] = leading.errors(&states[0], &states[1]);
            [frame.time, position, velocity]
        });
        Ok(Self {
            epsilon: epsilon(&course.world),
            seen: seen.collect(),
        })
    }

    /// The differences at the end, as in `seen`.
    fn last(&self) -> [f64; 3] {
        self.seen.last().copied().unwrap_or([f64::NAN; 3])
    }

    /// The largest difference in positions (1) or velocities (2) from a time on.
    pub(in crate::figure) fn largest(&self, which: usize, from: f64) -> f64 {
        let late = self.seen.iter().filter(|seen| seen[0] >= from);
        late.map(|seen| seen[which]).fold(0.0, f64::max)
    }
}

/// Whether differences fall in proportion to ε down to the least one.
fn vanish(family: &[Differences]) -> bool {
    let slopes = [1, 2].map(|which| slopes(family, which, AFTER));
    slopes
        .iter()
        .flatten()
        .all(|slope| (slope - 1.0).abs() < 0.1)
}

/// By which power of ε a difference goes from each run to the next.
pub(in crate::figure) fn slopes(family: &[Differences], which: usize, from: f64) -> Vec<f64> {
    let pairs = family.windows(2);
    let slope = |pair: &[Differences]| {
        let [a, b] = [0, 1].map(|k| pair[k].largest(which, from));
        (a / b).ln() / (pair[0].epsilon / pair[1].epsilon).ln()
    };
    pairs.map(slope).collect()
}

/// From v^f(0) as (4.25) has it.
pub(super) fn printed(courses: &Courses, theme: &Theme) -> Result<(String, Picture), Trouble> {
    let family = family(courses, Start::Printed)?;
    let world = &courses.get(&FAST[0])?.world;
    let reduced = FastFlocking::new(world).map_err(|problem| Trouble::new(&world.name, problem))?;
    let [printed, limit] = [reduced.printed, reduced.start];
    let finding = format!(
        "{} What is left of them as ε tends to 0 is no error of the integration: (4.25) has v^f(0) = \
         ({:.6}, {:.6}), {} off the limit of the layer, ({:.6}, {:.6}).",
        measured(&family),
        printed.x,
        printed.y,
        number((printed - limit).norm()),
        limit.x,
        limit.y,
    );
    Ok((finding, draw(&family, theme)))
}

/// From the limit of the layer.
pub(super) fn corrected(courses: &Courses, theme: &Theme) -> Result<(String, Picture), Trouble> {
    let family = family(courses, Start::Limit)?;
    Ok((measured(&family), draw(&family, theme)))
}

fn family(courses: &Courses, start: Start) -> Result<Vec<Differences>, Trouble> {
    let members = FAST.iter();
    let members = members.map(|wanted| Differences::of(courses.get(wanted)?, start));
    members.collect()
}

fn measured(family: &[Differences]) -> String {
    let what = |which: usize| {
        let largest: Vec<f64> = family.iter().map(|it| it.largest(which, AFTER)).collect();
        let slopes = slopes(family, which, AFTER);
        let last: Vec<f64> = family.iter().map(|it| it.last()[which]).collect();
        format!(
            "{} (powers {} of ε), at the end {}",
            numbers(&largest),
            numbers(&slopes),
            numbers(&last)
        )
    };
    let epsilons: Vec<f64> = family.iter().map(|it| it.epsilon).collect();
    let trend = match vanish(family) {
        true => "Both fall in proportion to ε: there is no floor.",
        false => "They do not fall in proportion to ε.",
    };
    format!(
        "The largest differences from t = {} on for ε = {}: in positions {}; in velocities {}. \
         {trend}",
        number(AFTER),
        numbers(&epsilons),
        what(1),
        what(2),
    )
}

fn draw(family: &[Differences], theme: &Theme) -> Picture {
    let plots = [
        (1, 0.0, "(a) Positions", "max |xᵢ − xᵢ₀|"),
        (2, AFTER, "(b) Velocities, from t = 10 on", "max |vᵢ − vᵢ₀|"),
    ];
    let plots = plots.map(|(which, from, title, label)| {
        let lines = family.iter().enumerate().map(|(k, member)| {
            let seen = member.seen.iter().filter(|seen| seen[0] >= from);
            let points = seen.map(|seen| [seen[0], seen[which]]);
            Item::line(points, theme.of(k)).named(format!("ε = {}", member.epsilon))
        });
        against_time(title, Axis::new(label).logarithmic(), lines.collect())
    });
    page(plots.into(), 2, [520.0, 380.0], theme)
}

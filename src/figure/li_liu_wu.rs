//! X. Li, Y. Liu and J. Wu, "Flocking and pattern motion in a modified Cucker-Smale model",
//! Figures 1 to 4.

use super::course::{Course, Courses, Of, Wanted};
use super::page::{at_agents, page, plane};
use super::{Entry, Trouble, number, numbers};
use crate::math::{Vector, direction, mean};
use crate::metric::{ball_residual, diameter, line_residual};
use crate::picture::{Picture, Theme};
use crate::plot::{Item, Marker, Plot};
use crate::trace::record::Frame;
use crate::world::spec::LawSpec;
use crate::world::vector;

const FIGURES: [Wanted; 4] = [
    Wanted::bodies("li-liu-wu/figure-1", &[]),
    Wanted::bodies("li-liu-wu/figure-2", &[]),
    Wanted::bodies("li-liu-wu/figure-3", &[]),
    Wanted::bodies("li-liu-wu/figure-4", &[]),
];

pub(super) const ENTRIES: [Entry; 4] = [
    Entry {
        id: "li-liu-wu-1",
        source: "Li, Liu & Wu, Figure 1",
        caption: "Twenty agents with symmetric influence at the start, at half run time and at \
                  the end: they come to a line along (1, 1).",
        wanted: &[FIGURES[0]],
        draw: |courses, theme| draw(courses, 0, theme),
    },
    Entry {
        id: "li-liu-wu-2",
        source: "Li, Liu & Wu, Figure 2",
        caption: "The same with nonsymmetric influence, from the same initial values: they come \
                  to a line along (−1, 1).",
        wanted: &[FIGURES[1]],
        draw: |courses, theme| draw(courses, 1, theme),
    },
    Entry {
        id: "li-liu-wu-3",
        source: "Li, Liu & Wu, Figure 3",
        caption: "Forty-five agents with symmetric influence at the start, at half run time and \
                  at the end: they come to a circle of radius 5.",
        wanted: &[FIGURES[2]],
        draw: |courses, theme| draw(courses, 2, theme),
    },
    Entry {
        id: "li-liu-wu-4",
        source: "Li, Liu & Wu, Figure 4",
        caption: "The same with nonsymmetric influence, from the same initial values: they come \
                  to a circle of radius 4.",
        wanted: &[FIGURES[3]],
        draw: |courses, theme| draw(courses, 3, theme),
    },
];

/// What agents are driven to.
#[derive(Debug, Clone, Copy)]
enum Pattern {
    /// A line through the mean position along this vector.
    Line(Vector<2>),
    /// A circle about the mean position, of this radius.
    Circle(f64),
}

impl Pattern {
    fn of(course: &Course) -> Result<Self, Trouble> {
        let pattern = course.world.laws().find_map(|(_, law)| match law {
            LawSpec::LinePattern(law) => Some(Self::Line(vector(&law.direction))),
            LawSpec::BallPattern(law) => Some(Self::Circle(law.radius)),
            _ => None,
        });
        pattern.ok_or_else(|| Trouble::new(&course.world.name, "no law drives to a pattern"))
    }

    fn name(self) -> &'static str {
        match self {
            Self::Line(_) => "line",
            Self::Circle(_) => "circle",
        }
    }

    /// The largest distance of an agent from it.
    fn residual(self, frame: &Frame) -> f64 {
        let positions = Of::Positions.vectors(frame);
        match self {
            Self::Line(along) => line_residual(&positions, &along),
            Self::Circle(radius) => ball_residual(&positions, radius),
        }
    }

    /// How far it and the agents reach from their mean position, along either axis.
    fn reach(self, frame: &Frame) -> f64 {
        let positions = Of::Positions.vectors(frame);
        let center = mean(&positions);
        let agents = positions.iter().map(|it| (it - center).amax());
        let own = match self {
            Self::Line(_) => 0.0,
            Self::Circle(radius) => radius,
        };
        agents.fold(own, f64::max)
    }

    /// It as it lies among the agents.
    fn item(self, frame: &Frame, theme: &Theme) -> Item {
        let positions = Of::Positions.vectors(frame);
        let center = mean(&positions);
        match self {
            Self::Line(along) => {
                let reach = direction(&along) * (0.6 * diameter(&positions));
                let ends = [center - reach, center + reach].map(|it| [it.x, it.y]);
                Item::line(ends, theme.faint).dashed()
            }
            Self::Circle(radius) => {
                Item::disks([([center.x, center.y], radius)], theme.faint).hollow()
            }
        }
    }
}

fn draw(courses: &Courses, figure: usize, theme: &Theme) -> Result<(String, Picture), Trouble> {
    let course = courses.get(&FIGURES[figure])?;
    let pattern = Pattern::of(course)?;
    let end = course.last().time;
    let moments = [0.0, 0.5 * end, end].map(|time| course.at(time));
    // One width for all, so that the flock can be seen to shrink or to keep its size.
    let reach = moments.map(|frame| pattern.reach(frame));
    let half = 1.08 * reach.into_iter().fold(0.0, f64::max);
    let plots: Vec<Plot> = moments
        .iter()
        .map(|frame| {
            let agents = at_agents(&frame.positions, Marker::Disk, theme.of(0)).sized(3.0);
            let title = format!("t = {}", number(frame.time));
            let items = vec![pattern.item(frame, theme), agents];
            let mut plot = plane(&title, ["x¹", "x²"], items);
            let center = mean(&Of::Positions.vectors(frame));
            let about = |middle: f64| Some([middle - half, middle + half]);
            [plot.x.range, plot.y.range] = [about(center.x), about(center.y)];
            plot
        })
        .collect();
    let residuals = moments.map(|frame| pattern.residual(frame));
    let differ = moments.map(|frame| diameter(&Of::Velocities.vectors(frame)));
    let finding = format!(
        "The largest distance of an agent from the {} is {} at t = {}; the largest difference of \
         two velocities is {}. The paper proves nothing of this force, and leaves open γ, initial \
         values and run time; ours are those of the world {}.",
        pattern.name(),
        numbers(&residuals),
        numbers(&moments.map(|frame| frame.time)),
        numbers(&differ),
        course.world.name,
    );
    Ok((finding, page(plots, 3, [400.0, 400.0], theme)))
}

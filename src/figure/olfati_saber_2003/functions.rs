//! Figures 2, 4 and 5: what the protocols are made of.

use crate::figure::course::Courses;
use crate::figure::page::page;
use crate::figure::{Trouble, lowest, number};
use crate::math::{Action, AlphaPair, Bump, Fade};
use crate::net::link_energy;
use crate::picture::{Picture, Theme};
use crate::plot::{Axis, Item, Plot};

/// k₀ of the bump.
const START: f64 = 5.0 / 6.0;
/// r and d_α of Figures 2 and 5.
const RANGE: f64 = 12.0;
const SPACING: f64 = 10.0;
/// a and b.
const ATTRACTION: f64 = 1.0;
const REPULSION: f64 = 5.0;

/// Points of a function between two ends, so many that no bend is missed.
pub(in crate::figure) fn curve(ends: [f64; 2], of: impl Fn(f64) -> f64) -> Vec<[f64; 2]> {
    const PIECES: u32 = 1200;
    let at = |k: u32| ends[0] + (ends[1] - ends[0]) * f64::from(k) / f64::from(PIECES);
    (0..=PIECES).map(at).map(|z| [z, of(z)]).collect()
}

/// Where a curve first crosses a height, between two of its points.
pub(in crate::figure) fn crossing(points: &[[f64; 2]], height: f64) -> f64 {
    let pairs = points.windows(2);
    let mut crossed = pairs.filter(|pair| (pair[0][1] - height) * (pair[1][1] - height) <= 0.0);
    crossed.next().map_or(f64::NAN, |pair| {
        let rise = pair[1][1] - pair[0][1];
        match rise == 0.0 {
            true => pair[0][0],
            false => pair[0][0] + (pair[1][0] - pair[0][0]) * (height - pair[0][1]) / rise,
        }
    })
}

/// The potential between two agents, (32), with either fade.
pub(in crate::figure) fn pair_of(fade: Fade) -> AlphaPair {
    AlphaPair {
        action: Action::new(ATTRACTION, REPULSION),
        spacing: SPACING,
        range: RANGE,
        fade,
    }
}

/// Figure 2.
pub(super) fn bump(_: &Courses, theme: &Theme) -> Result<(String, Picture), Trouble> {
    let bump = Bump::new(START);
    let value = curve([0.0, 14.0], |z| bump.value(z / RANGE));
    let slope = curve([0.0, 14.0], |z| bump.slope(z / RANGE) / RANGE);
    let [steepest, least] = lowest(slope.iter().copied());
    let finding = format!(
        "ρ leaves 1 at z = {}, is ½ at {} and comes to 0 at {}; its derivative is least, {}, at z = {}. \
         The paper gives conditions on ρ and no formula; ours is ½(1 + cos(π(z/r − k₀)/(1 − k₀))) in \
         between.",
        number(START * RANGE),
        number(crossing(&value, 0.5)),
        number(RANGE),
        number(least),
        number(steepest),
    );
    let plots = [
        ("(a) ρ(z/r)", "ρ", value),
        ("(b) its derivative by z", "ρ′", slope),
    ];
    Ok((finding, two(plots, "z", theme)))
}

/// Figure 4.
pub(super) fn action(_: &Courses, theme: &Theme) -> Result<(String, Picture), Trouble> {
    let action = Action::new(ATTRACTION, REPULSION);
    let ends = [-10.0, 10.0];
    let potential = curve(ends, |z| action.potential(z));
    let force = curve(ends, |z| action.force(z));
    let [rest, least] = lowest(potential.iter().copied());
    let finding = format!(
        "ψ_α is least, {}, at z = {}; φ_α is zero at z = {} and goes from {} at z = {} to {} at z = {}, \
         between its limits −b and a.",
        number(least),
        number(rest),
        number(crossing(&force, 0.0)),
        number(force[0][1]),
        number(ends[0]),
        number(force[force.len() - 1][1]),
        number(ends[1]),
    );
    // The letters have no α as an index.
    let plots = [
        ("(a) Potential ψα(z)", "ψα", potential),
        ("(b) Action φα(z)", "φα", force),
    ];
    Ok((finding, two(plots, "z", theme)))
}

/// Figure 5.
pub(super) fn pair(_: &Courses, theme: &Theme) -> Result<(String, Picture), Trouble> {
    let jumps = RANGE - SPACING;
    let sharp = pair_of(Fade::Sharp);
    let smooth = pair_of(Fade::Smooth(Bump::new(START)));
    let potential = |pair: &AlphaPair, eta: f64| match eta > jumps {
        true => 0.0,
        false => pair.potential(SPACING + eta),
    };
    let ends = [-4.0, 4.0];
    let below = curve([ends[0], jumps], |eta| potential(&sharp, eta));
    let beyond = [[jumps, 0.0], [ends[1], 0.0]];
    let smoothed = curve(ends, |eta| potential(&smooth, eta));
    let hill = smoothed.iter().filter(|point| point[0] > 0.0);
    let [at, below_top] = lowest(hill.map(|[eta, value]| [*eta, -value]));
    let finding = format!(
        "(a) jumps from {} to 0 at η = {}, by the link energy h₀ = {} of (31); (b) rises to {} at η = {} \
         and falls to 0 without a jump.",
        number(below[below.len() - 1][1]),
        number(jumps),
        number(link_energy(&sharp)),
        number(-below_top),
        number(at),
    );
    let line = |points: Vec<[f64; 2]>| Item::line(points, theme.of(0));
    let plot = |title: &str, items: Vec<Item>| Plot {
        title: title.to_owned(),
        x: Axis::new("η").linear(),
        y: Axis::new("V").linear().range([-0.15, 3.0]),
        items,
        ..Plot::default()
    };
    let plots = vec![
        plot(
            "(a) Nonsmooth potential",
            vec![line(below), line(beyond.to_vec())],
        ),
        plot("(b) Smooth potential", vec![line(smoothed)]),
    ];
    Ok((finding, page(plots, 2, [480.0, 360.0], theme)))
}

/// Two functions beside each other.
fn two(plots: [(&str, &str, Vec<[f64; 2]>); 2], along: &str, theme: &Theme) -> Picture {
    let plots = plots.map(|(title, label, points)| Plot {
        title: title.to_owned(),
        x: Axis::new(along).linear(),
        y: Axis::new(label).linear(),
        items: vec![Item::line(points, theme.of(0))],
        ..Plot::default()
    });
    page(plots.into(), 2, [480.0, 360.0], theme)
}

//! Figures 7 to 9: flocks at some moments.

use crate::figure::course::{Course, Courses, Of, Wanted};
use crate::figure::{Trouble, lowest, number, numbers};
use crate::math::{AlphaPair, Fade};
use crate::net::{Net, Rigidity, crossings, is_planar, normalised_defect};
use crate::picture::{Picture, Theme};
use crate::render::{Layer, Layers, Look, Moment, Panel, Scene, Size, Survey, strip};
use crate::trace::record::{Frame, Metrics, Record};
use crate::world::spec::LawSpec;

/// The first task: the six obstacles (59).
pub(super) const SIX_OBSTACLES: Wanted = Wanted::bodies(
    "olfati-saber-2003/six-obstacles",
    &["record.edges=true", "record.every=0.1"],
);

/// The second task: a sink.
pub(super) const SINK: Wanted = Wanted::bodies(
    "olfati-saber-2003/sink",
    &["record.edges=true", "record.every=0.1"],
);

/// Moments before, among and behind the obstacles.
const AMONG: [f64; 8] = [0.0, 6.0, 9.0, 12.0, 15.0, 18.0, 21.0, 27.0];

/// Moments of the conformation.
const TO_THE_SINK: [f64; 6] = [0.0, 1.0, 4.0, 10.0, 30.0, 200.0];

/// Figure 7.
pub(super) fn cluster(courses: &Courses, theme: &Theme) -> Result<(String, Picture), Trouble> {
    let course = courses.get(&SIX_OBSTACLES)?;
    let summary = &course.summary;
    let finding = format!(
        "Bodies of radius {}. Contacts between agents: {}, with obstacles: {}; the smallest gap to \
         an obstacle, looked at every {} of time, is {}. The flock is parted most, with a density of {}, at t = {}. The paper's \
         velocity (0, 10) is (10, 0) here, for its obstacles lie along the first axis; it leaves its \
         gains open, and ours were chosen so that bodies hardly touch.",
        number(course.world.agents.radius[0]),
        summary.agent_contacts.episodes,
        summary.obstacle_contacts.episodes,
        number(course.world.spec.record.every),
        summary
            .smallest_obstacle_gap
            .map_or("none".to_owned(), number),
        number(parted(course)[1]),
        number(parted(course)[0]),
    );
    Ok((finding, snapshots(course, &AMONG, false, theme)?))
}

/// Figure 8.
pub(super) fn net(courses: &Courses, theme: &Theme) -> Result<(String, Picture), Trouble> {
    let course = courses.get(&SIX_OBSTACLES)?;
    let last = course.last();
    let drawn = course.at(AMONG[AMONG.len() - 1]);
    let density = |frame| metrics(frame).density.map_or("unknown".to_owned(), number);
    let apart = metrics(last)
        .largest_component
        .map(|it| course.agents() - it);
    let finding = format!(
        "The density falls to {} at t = {}, and is {} at t = {}, the last that is drawn, and {} at t = \
         {}, with {} of {} agents outside the main flock; their velocities are {} (root mean square) off the one steered to. The paper has \
         0.97, three agents of a hundred.",
        number(parted(course)[1]),
        number(parted(course)[0]),
        density(drawn),
        number(drawn.time),
        density(last),
        number(last.time),
        apart.unwrap_or(0),
        course.agents(),
        number(metrics(last).velocity_mismatch),
    );
    Ok((finding, snapshots(course, &AMONG, true, theme)?))
}

/// Figure 9.
pub(super) fn sink(courses: &Courses, theme: &Theme) -> Result<(String, Picture), Trouble> {
    let course = courses.get(&SINK)?;
    let world = &course.world;
    let none = || Trouble::new(&world.name, "it has no (α, α) interaction");
    let alpha = world.alpha_interaction().ok_or_else(none)?;
    let parts = |frame: &Frame| metrics(frame).components.unwrap_or(0);
    let parted = course.frames.iter().rposition(|frame| parts(frame) != 1);
    let joined = parted.map_or(0, |k| k + 1);
    let connected = match course.frames.get(joined) {
        Some(frame) => format!("connected for good from t = {} on", number(frame.time)),
        None => "not connected in the end".to_owned(),
    };
    let positions = Of::Positions.vectors(course.last());
    let net = Net::new(&positions, alpha.range);
    let sharp = AlphaPair {
        fade: Fade::Sharp,
        ..alpha.pair()
    };
    let defect = |pair: &AlphaPair| {
        normalised_defect(&positions, &net, pair, 1.0).map_or("none".to_owned(), number)
    };
    let lengths = net.edges().iter();
    let lengths = lengths.map(|[i, j]| (positions[*i] - positions[*j]).norm());
    let [shortest, longest] = lengths.fold([f64::INFINITY, 0.0], |[least, most], length| {
        [f64::min(least, length), f64::max(most, length)]
    });
    let gains = course.world.laws().filter_map(|(_, law)| match law {
        LawSpec::Navigation(law) => Some(law.position_gain),
        _ => None,
    });
    let gains: Vec<f64> = gains.collect();
    let is = |yes: bool| if yes { "" } else { "not " };
    let finding = format!(
        "{} components at the start; {connected}. At t = {} the net has {} edges from {} to {} \
         long, where d_α = {}, of which {} pairs cross; it is {}planar and {}rigid, with a normalised defect factor (47) of {} \
         by the nonsmooth potential and {} by the smooth one. The gain of \
         the sink, the crossed diamond, 1 as printed in (50), is {} here: 1 presses the flock together.",
        parts(course.first()),
        number(course.last().time),
        net.edges().len(),
        number(shortest),
        number(longest),
        number(alpha.pair().spacing),
        crossings(&positions, &net),
        is(is_planar(&net)),
        is(Rigidity::new(&positions, &net).is_rigid()),
        defect(&sharp),
        defect(&alpha.pair()),
        numbers(&gains),
    );
    Ok((finding, snapshots(course, &TO_THE_SINK, true, theme)?))
}

/// The moments beside each other, within one window.
fn snapshots(
    course: &Course,
    moments: &[f64],
    edges: bool,
    theme: &Theme,
) -> Result<Picture, Trouble> {
    let world = &course.world;
    let frames: Vec<&Frame> = moments.iter().map(|time| course.at(*time)).collect();
    let records: Vec<Record> = frames.iter().map(|&it| Record::Frame(it.clone())).collect();
    let survey =
        Survey::of(world, &records).map_err(|problem| Trouble::new(&world.name, problem))?;
    let mut layers = Layers::from_iter([
        Layer::Obstacles,
        Layer::Targets,
        Layer::Bodies,
        Layer::Scale,
    ]);
    if edges {
        layers.show(Layer::Edges);
    }
    let look = Look {
        theme: *theme,
        layers: Some(layers),
        size: Size::Within([1400.0, 1000.0]),
        ..Look::default()
    };
    let panels: Vec<Panel> = frames
        .into_iter()
        .map(|frame| Panel {
            caption: Some(format!("t = {}", number(frame.time))),
            moment: Moment::new(frame.clone()),
        })
        .collect();
    Ok(strip(&Scene::new(world, &survey, look), &panels))
}

/// When the largest component is smallest, and its share of the agents then.
fn parted(course: &Course) -> [f64; 2] {
    // At the start agents lie at random, and the net is not yet a flock.
    let settled = course.frames.iter().filter(|frame| frame.time > 5.0);
    let densities = settled.filter_map(|frame| Some([frame.time, metrics(frame).density?]));
    lowest(densities)
}

fn metrics(frame: &Frame) -> Metrics {
    frame.metrics.clone().unwrap_or_default()
}

//! Several moments in one picture: side by side, or over each other.

use crate::picture::{Anchor, Label, Mark, Picture, text};
use crate::render::{Layer, Moment, Scene};

use super::frame::State;
use super::layout::{Layout, MARGIN, TIME};

/// One picture of several.
#[derive(Debug, Clone)]
pub struct Panel {
    /// What stands above it; its time where absent.
    pub caption: Option<String>,
    /// What it shows.
    pub moment: Moment,
}

impl Panel {
    /// A moment under its time.
    pub fn new(moment: Moment) -> Self {
        Self {
            caption: None,
            moment,
        }
    }
}

/// Moments side by side, in rows where they are many, with one scale and one legend.
pub fn strip<const D: usize>(scene: &Scene<'_, D>, panels: &[Panel]) -> Picture {
    let caption = |panel: &Panel| match &panel.caption {
        Some(caption) => Some(caption.clone()),
        None => (scene.layers.has(Layer::Time)).then(|| scene.time(panel.moment.frame.time)),
    };
    let captions: Vec<Option<String>> = panels.iter().map(caption).collect();
    let widths = captions.iter().flatten();
    let widest = widths
        .map(|it| text::width(it, TIME, true))
        .reduce(f64::max);
    let layout = Layout::new(scene, panels.len().max(1), widest, false);
    let mut picture = Picture::new(layout.page, scene.look.theme.page, scene.title());
    for (index, (panel, caption)) in panels.iter().zip(captions).enumerate() {
        picture.place(
            layout.corners[index],
            scene.bare(&panel.moment, layout.stage),
        );
        picture
            .marks
            .extend(caption.map(|caption| scene.heading(&layout, index, caption)));
    }
    let scale = scene.view(None, 0.0, layout.stage).scale();
    picture.marks.extend(layout.foot(scene, scale));
    picture
}

/// Moments in one scene, each in a colour of its own, with the time above its flock. There are as
/// many colours as the theme's palette has.
pub fn overlay<const D: usize>(scene: &Scene<'_, D>, moments: &[Moment]) -> Picture {
    let timed = scene.layers.has(Layer::Time);
    let layout = Layout::new(scene, 1, timed.then_some(0.0), true);
    let mut picture = Picture::new(layout.page, scene.look.theme.page, scene.title());
    let view = scene.view(None, 0.0, layout.stage);
    let mut marks = scene.back(&*view);
    let mut labels = Vec::new();
    for (index, moment) in moments.iter().enumerate() {
        let color = scene.look.theme.of(index);
        let state = State::new(scene, moment, Some(color));
        marks.extend(scene.front(&*view, &state));
        let Some(sight) = view.see(&state.middle()) else {
            continue;
        };
        let at = [
            layout.corners[0][0] + sight.at[0],
            layout.corners[0][1] - 8.0,
        ];
        let time = scene.time(moment.frame.time);
        labels.push(
            Label::new(time, at, TIME, color)
                .bold()
                .anchor(Anchor::Middle),
        );
    }
    picture.add(Mark::Group {
        corner: layout.corners[0],
        size: layout.stage,
        background: None,
        marks,
    });
    if timed {
        spread(&mut labels, layout.page[0]);
        picture.marks.extend(labels.into_iter().map(Mark::Label));
    }
    picture.marks.extend(layout.foot(scene, view.scale()));
    picture
}

/// Moves labels apart that would stand on each other, and on to the page; smaller where they are
/// too many.
fn spread(labels: &mut [Label], page: f64) {
    const APART: f64 = 8.0;
    let width = |label: &Label| text::width(&label.text, label.size, label.bold);
    let room = page - 2.0 * MARGIN;
    let needed = labels.iter().map(width).sum::<f64>() + APART * labels.len() as f64;
    for label in labels.iter_mut() {
        label.size *= f64::min(1.0, room / needed);
    }
    labels.sort_by(|a, b| a.at[0].total_cmp(&b.at[0]));
    let mut free = MARGIN;
    for label in labels.iter_mut() {
        let half = 0.5 * width(label);
        label.at[0] = label.at[0].max(free + half);
        free = label.at[0] + half + APART;
    }
    let mut free = page - MARGIN;
    for label in labels.iter_mut().rev() {
        let half = 0.5 * width(label);
        label.at[0] = label.at[0].min(free - half);
        free = label.at[0] - half - APART;
    }
}

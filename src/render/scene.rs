//! A scene: a world, and how its moments look.

use crate::law::ObstacleAvoidance;
use crate::math::Vector;
use crate::picture::{Color, Label, Mark, Picture};
use crate::render::{Coloring, Eye, Form, Framing, Layer, Layers, Look, Moment, Survey, View};
use crate::shape::{Bounds, In};
use crate::world::World;

use super::frame::State;
use super::framing::{ground, whole};
use super::layer::targets::Aims;
use super::layer::{avoidance, bodies, contacts, field, net, obstacles, targets, trails};
use super::layout::{Layout, TIME};
use super::scale_bar::round_below;
use super::view::Canvas;

/// A world, and how its moments look.
#[derive(Debug)]
pub struct Scene<'a, const D: usize> {
    pub(super) world: &'a World<D>,
    pub(super) survey: &'a Survey<D>,
    pub(super) look: Look,
    pub(super) layers: Layers,
    /// The form of each group's bodies.
    pub(super) solids: Vec<Form<D>>,
    /// The form of each part of each obstacle.
    pub(super) obstacles: Vec<Vec<Form<D>>>,
    pub(super) aims: Aims<D>,
    /// The laws that may have γ-agents, and whether there are any.
    pub(super) avoidance: Vec<ObstacleAvoidance<D>>,
    pub(super) has_gamma: bool,
    /// Half the width and the radius of each agent's field of view.
    pub(super) fields: Vec<Option<[f64; 2]>>,
    /// What is to be seen, but for what follows the flock.
    bounds: Bounds<D>,
    ground: f64,
    view: fn(&Framing<D>) -> Box<dyn View<D>>,
}

impl<'a, const D: usize> Scene<'a, D>
where
    In<D>: Eye<D>,
{
    /// The scene of a world and of what happens there.
    pub fn new(world: &'a World<D>, survey: &'a Survey<D>, look: Look) -> Self {
        let layers = look.layers.unwrap_or_else(|| Layers::usual(survey));
        let aims = Aims::new(world, survey.span());
        let mut places: Vec<Vector<D>> = Vec::new();
        if layers.has(Layer::Targets) {
            places.extend(&aims.destinations);
            places.extend(aims.ways.iter().flatten());
        }
        let bounds = whole(world, survey, layers.has(Layer::Obstacles), &places);
        // Fine enough that faces are sorted well, coarse enough to be drawn quickly.
        let piece = (bounds.1 - bounds.0).norm() / 16.0;
        let form = |shape| <In<D> as Eye<D>>::form(shape, piece);
        let avoidance = avoidance::laws(world);
        let gamma = |law: &ObstacleAvoidance<D>| {
            let mut agents = world.obstacles.iter().flat_map(|it| law.gamma_agents(it));
            agents.any(|agent| agent.is_some())
        };
        Self {
            world,
            survey,
            layers,
            solids: world
                .solids
                .iter()
                .map(|solid| form(solid.shape()))
                .collect(),
            obstacles: world
                .obstacles
                .iter()
                .map(|obstacle| {
                    obstacle
                        .parts()
                        .iter()
                        .map(|part| form(&part.shape))
                        .collect()
                })
                .collect(),
            aims,
            has_gamma: avoidance.iter().any(gamma),
            avoidance,
            fields: match layers.has(Layer::View) {
                true => field::fields(world),
                false => Vec::new(),
            },
            ground: ground(world, &bounds),
            bounds,
            view: <In<D> as Eye<D>>::view,
            look,
        }
    }
}

/// What draws a layer.
type Draw<const D: usize> = fn(&Scene<'_, D>, &State<'_, D>, &mut Canvas<'_, D>);

impl<const D: usize> Scene<'_, D> {
    /// The picture of a moment: the scene with its time, scale and legend.
    pub fn picture(&self, moment: &Moment) -> Picture {
        let mut picture = self.still();
        picture.marks.extend(self.moving(moment));
        picture
    }

    /// What of every picture is the same: see [`Scene::moving`].
    pub fn still(&self) -> Picture {
        let layout = self.layout();
        let mut picture = Picture::new(layout.page, self.look.theme.page, self.title());
        let view = self.view(None, 0.0, layout.stage);
        if !self.look.follow && !self.look.camera.orbits {
            picture.add(self.group(&layout, self.back(&*view)));
        }
        picture.marks.extend(layout.foot(self, view.scale()));
        picture
    }

    /// What of the picture of a moment comes on top of [`Scene::still`].
    pub fn moving(&self, moment: &Moment) -> Vec<Mark> {
        let layout = self.layout();
        let state = State::new(self, moment, None);
        let view = self.view(Some(&state), moment.turn, layout.stage);
        let mut marks = Vec::new();
        if self.look.follow || self.look.camera.orbits {
            marks.extend(self.back(&*view));
        }
        marks.extend(self.front(&*view, &state));
        let mut marks = vec![self.group(&layout, marks)];
        if layout.head > 0.0 {
            marks.push(self.heading(&layout, 0, self.time(moment.frame.time)));
        }
        marks
    }

    /// The picture of a moment without time, scale and legend, on a page of this size.
    pub fn bare(&self, moment: &Moment, size: [f64; 2]) -> Picture {
        let mut picture = Picture::new(size, self.look.theme.page, self.title());
        let state = State::new(self, moment, None);
        let view = self.view(Some(&state), moment.turn, size);
        picture.marks.extend(self.back(&*view));
        picture.marks.extend(self.front(&*view, &state));
        picture
    }

    /// What was asked for and cannot be shown, and why; a line each.
    pub fn notes(&self) -> Vec<String> {
        let asked = |layer| self.layers.has(layer);
        let recorded = &self.survey.recorded;
        let unknown = [
            (
                asked(Layer::Edges) && !self.has_edges(),
                "edges are not in the trace (record.edges), and the world has no \
                 alpha_interaction whose range tells them",
            ),
            (
                self.look.coloring == Coloring::Component && !self.has_edges(),
                "components are not known: the trace has no edges (record.edges), and the world \
                 no alpha_interaction",
            ),
            (
                asked(Layer::Beta) && !recorded.beta_agents,
                "β-agents are not in the trace (record.beta_agents)",
            ),
            (
                asked(Layer::Blocked) && !recorded.blocked,
                "blocked lines of sight are not in the trace (record.blocked)",
            ),
            (
                asked(Layer::Gamma) && !self.has_gamma,
                "there are no γ-agents in this world",
            ),
            (
                asked(Layer::View) && self.fields.iter().all(Option::is_none),
                "no agent of this world has a field of view",
            ),
        ];
        let notes = unknown.into_iter().filter(|(missing, _)| *missing);
        notes.map(|(_, why)| why.to_owned()).collect()
    }

    /// Whether edges are recorded, or can be told by a range.
    pub(super) fn has_edges(&self) -> bool {
        self.survey.recorded.edges || self.world.alpha_interaction().is_some()
    }

    /// What the picture shows, in a line.
    pub(super) fn title(&self) -> String {
        format!("{}: {} agents", self.world.name, self.world.agents.len())
    }

    /// A time, with as many digits as tell the frames apart.
    pub(super) fn time(&self, time: f64) -> String {
        let [first, last] = self.survey.span();
        let count = self.survey.times.len().max(2) - 1;
        let apart = (last - first) / count as f64;
        let digits = (0..6).find(|&digits| {
            let unit = 10f64.powi(digits);
            ((apart * unit).round() - apart * unit).abs() < 1e-3 && apart * unit > 0.5
        });
        let digits = digits.unwrap_or(2) as usize;
        format!("t = {time:.digits$}")
    }

    /// Width and height of what is to be seen, in any unit.
    pub(super) fn sides(&self) -> [f64; 2] {
        self.view(None, 0.0, [1.0; 2]).sides()
    }

    fn layout(&self) -> Layout {
        let title = self.layers.has(Layer::Time).then_some(0.0);
        Layout::new(self, 1, title, false)
    }

    /// The box that is to be seen.
    fn framed(&self, state: Option<&State<'_, D>>) -> Bounds<D> {
        let (mut min, mut max) = self.bounds;
        if let Some(window) = self.look.window {
            for k in 0..D.min(2) {
                (min[k], max[k]) = (window[0][k], window[1][k]);
            }
        }
        if !self.look.follow {
            return (min, max);
        }
        let half = match self.look.window {
            Some(_) => (max - min) * 0.5,
            None => {
                let largest = self.survey.spread.amax();
                self.survey
                    .spread
                    .map(|half| half.max(0.5 * largest) * 1.15)
            }
        };
        let middle = match state {
            Some(state) => state.middle(),
            None => (min + max) * 0.5,
        };
        (middle - half, middle + half)
    }

    /// The view of what is to be seen, at a moment where it follows the flock.
    pub(super) fn view(
        &self,
        state: Option<&State<'_, D>>,
        turn: f64,
        size: [f64; 2],
    ) -> Box<dyn View<D>> {
        let mut camera = self.look.camera;
        camera.azimuth += turn;
        (self.view)(&Framing {
            bounds: self.framed(state),
            size,
            theme: self.look.theme,
            camera,
            ground: self.ground,
        })
    }

    /// What is always the same, where the view does not move.
    pub(super) fn back(&self, view: &dyn View<D>) -> Vec<Mark> {
        let mut canvas = Canvas::new(view);
        if self.layers.has(Layer::Grid) {
            let (min, max) = self.framed(None);
            let apart = round_below((max - min).amax() / 6.0);
            view.grid(apart, self.look.theme.grid, &mut canvas.seen);
        }
        // In space, what stands farther back need not be behind what moves.
        if D == 2 {
            self.always(&mut canvas);
        }
        canvas.finish()
    }

    fn always(&self, canvas: &mut Canvas<'_, D>) {
        if self.layers.has(Layer::Obstacles) {
            obstacles::fixed(self, canvas);
        }
        if self.layers.has(Layer::Targets) {
            targets::ways(self, canvas);
        }
    }

    /// What changes from moment to moment.
    pub(super) fn front(&self, view: &dyn View<D>, state: &State<'_, D>) -> Vec<Mark> {
        let shows = |layer| self.layers.has(layer);
        let mut canvas = Canvas::new(view);
        if D == 3 {
            if shows(Layer::Shadows) {
                let (things, bodies) = (shows(Layer::Obstacles), shows(Layer::Bodies));
                obstacles::shadows(self, state, things, bodies, &mut canvas);
            }
            self.always(&mut canvas);
        }
        let layers: [(Layer, Draw<D>); 12] = [
            (Layer::Obstacles, obstacles::moving),
            (Layer::View, field::draw),
            (Layer::Trails, trails::draw),
            (Layer::Edges, net::edges),
            (Layer::Blocked, net::blocked),
            (Layer::Beta, avoidance::beta),
            (Layer::Gamma, avoidance::gamma),
            (Layer::Bodies, bodies::bodies),
            (Layer::Headings, bodies::headings),
            (Layer::Velocities, bodies::velocities),
            (Layer::Contacts, contacts::draw),
            (Layer::Targets, targets::now),
        ];
        for (layer, draw) in layers {
            if shows(layer) {
                draw(self, state, &mut canvas);
            }
        }
        canvas.finish()
    }

    /// Marks of the only scene of a page.
    fn group(&self, layout: &Layout, marks: Vec<Mark>) -> Mark {
        Mark::Group {
            corner: layout.corners[0],
            size: layout.stage,
            background: None,
            marks,
        }
    }

    /// The line above a scene of a page.
    pub(super) fn heading(&self, layout: &Layout, scene: usize, text: String) -> Mark {
        let [x, y] = layout.corners[scene];
        let color: Color = self.look.theme.ink;
        Mark::Label(Label::new(text, [x, y - 8.0], TIME, color).bold())
    }
}

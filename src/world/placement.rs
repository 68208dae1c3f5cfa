//! Where agents start: separated from each other and clear of obstacles, or refused.

use std::collections::HashMap;

use crate::math::Vector;
use crate::shape::Obstacle;
use crate::world::problem::Problem;
use crate::world::random::{Purpose, Random};
use crate::world::spec::{GroupSpec, PlacementSpec};
use crate::world::vector;

/// Draws for one agent before a random placement gives up. Random sequential placement
/// fills about half of a region before such a number of draws fails.
const DRAWS: usize = 20_000;

/// The agents placed so far, in cells of a fixed size.
pub(super) struct Placement<'a, const D: usize> {
    obstacles: &'a [Obstacle<D>],
    side: f64,
    cells: HashMap<[i64; D], Vec<usize>>,
    positions: Vec<Vector<D>>,
    radii: Vec<f64>,
}

/// What keeps an agent from a place.
enum Conflict {
    Agent(usize),
    Obstacle(usize),
}

impl<'a, const D: usize> Placement<'a, D> {
    /// An empty placement for these groups among these obstacles.
    pub(super) fn new(groups: &[GroupSpec], obstacles: &'a [Obstacle<D>]) -> Self {
        let widest = groups.iter().map(|group| 2.0 * group.radius);
        let separations = groups
            .iter()
            .filter_map(|group| separation(&group.positions));
        Self {
            obstacles,
            side: widest.chain(separations).fold(f64::MIN_POSITIVE, f64::max),
            cells: HashMap::new(),
            positions: Vec::new(),
            radii: Vec::new(),
        }
    }

    /// Places all agents of a group and returns their positions.
    pub(super) fn place(
        &mut self,
        index: usize,
        group: &GroupSpec,
        count: usize,
        seed: u64,
    ) -> Result<Vec<Vector<D>>, Problem> {
        let first = self.positions.len();
        let path = format!("agents[{index}].positions");
        let mut random = Random::new(seed, Purpose::Positions(index));
        match &group.positions {
            PlacementSpec::Explicit(positions) => {
                for (k, position) in positions.iter().enumerate() {
                    let position = vector(position);
                    if let Some(conflict) = self.conflict(&position, group.radius, 0.0, first) {
                        return Err(Problem::new(
                            format!("{path}.explicit[{k}]"),
                            self.describe(&conflict, &position, group.radius),
                        ));
                    }
                    self.insert(position, group.radius);
                }
            }
            PlacementSpec::Box(region) => {
                let (min, max) = (vector(&region.min), vector(&region.max));
                let apart = region.separation.unwrap_or(0.0);
                self.draw(&format!("{path}.box"), group, count, apart, || {
                    random.in_box(&min, &max)
                })?;
            }
            PlacementSpec::Ball(region) => {
                let center = vector(&region.center);
                let apart = region.separation.unwrap_or(0.0);
                self.draw(&format!("{path}.ball"), group, count, apart, || {
                    random.in_ball(&center, region.radius)
                })?;
            }
        }
        Ok(self.positions[first..].to_vec())
    }

    fn draw(
        &mut self,
        path: &str,
        group: &GroupSpec,
        count: usize,
        apart: f64,
        mut candidate: impl FnMut() -> Vector<D>,
    ) -> Result<(), Problem> {
        let first = self.positions.len();
        for placed in 0..count {
            let place = (0..DRAWS)
                .map(|_| candidate())
                .find(|place| self.conflict(place, group.radius, apart, first).is_none());
            let Some(place) = place else {
                let distance = apart.max(2.0 * group.radius);
                return Err(Problem::new(
                    path,
                    format!(
                        "has room for {placed} of the {count} agents only, {distance} apart and \
                         clear of obstacles and other groups (after {DRAWS} draws for the next one)"
                    ),
                )
                .hint("a larger region, fewer agents or a smaller separation"));
            };
            self.insert(place, group.radius);
        }
        Ok(())
    }

    /// What is in the way of a body at `place`: another body closer than touching, an
    /// agent of the same group (from `first` on) closer than `apart`, or an obstacle.
    fn conflict(
        &self,
        place: &Vector<D>,
        radius: f64,
        apart: f64,
        first: usize,
    ) -> Option<Conflict> {
        let cell = self.cell(place);
        for shift in 0..3usize.pow(D as u32) {
            let near: [i64; D] = std::array::from_fn(|axis| {
                let step = (shift / 3usize.pow(axis as u32) % 3) as i64 - 1;
                cell[axis].saturating_add(step)
            });
            for &other in self.cells.get(&near).into_iter().flatten() {
                let touching = radius + self.radii[other];
                let least = if other >= first {
                    touching.max(apart)
                } else {
                    touching
                };
                if (self.positions[other] - place).norm() < least {
                    return Some(Conflict::Agent(other));
                }
            }
        }
        let blocks = |obstacle: &Obstacle<D>| {
            obstacle.may_reach(place, radius) && obstacle.project(place).distance < radius
        };
        self.obstacles
            .iter()
            .position(blocks)
            .map(Conflict::Obstacle)
    }

    fn describe(&self, conflict: &Conflict, place: &Vector<D>, radius: f64) -> String {
        match *conflict {
            Conflict::Agent(other) => format!(
                "lies {} from agent {other}: bodies of radius {radius} and {} overlap there",
                (self.positions[other] - place).norm(),
                self.radii[other]
            ),
            Conflict::Obstacle(index) => format!(
                "overlaps obstacle {index} ({}): its surface is {} from the body's centre, whose \
                 radius is {radius}",
                self.obstacles[index].name,
                self.obstacles[index].project(place).distance
            ),
        }
    }

    fn insert(&mut self, place: Vector<D>, radius: f64) {
        let cell = self.cell(&place);
        self.cells
            .entry(cell)
            .or_default()
            .push(self.positions.len());
        self.positions.push(place);
        self.radii.push(radius);
    }

    fn cell(&self, place: &Vector<D>) -> [i64; D] {
        std::array::from_fn(|axis| (place[axis] / self.side).floor() as i64)
    }
}

fn separation(positions: &PlacementSpec) -> Option<f64> {
    match positions {
        PlacementSpec::Explicit(_) => None,
        PlacementSpec::Box(region) => region.separation,
        PlacementSpec::Ball(region) => region.separation,
    }
}

//! Where agents start: separated from each other and clear of obstacles, or refused.

use crate::math::Vector;
use crate::shape::{Boxes, Obstacle, Reach, Solid};
use crate::world::check::size;
use crate::world::limits::MOST_PROBLEMS;
use crate::world::problem::Problem;
use crate::world::random::{Purpose, Random};
use crate::world::sites::{self, Hexagonal};
use crate::world::spec::{GroupSpec, PlacementSpec};
use crate::world::standing::Standing;
use crate::world::vector;
use crate::world::watch::{Stage, Watch};
use crate::world::words::number;

/// Draws for one agent before a random placement gives up. Random sequential placement
/// fills about half of a region before such a number of draws fails.
const DRAWS: usize = 20_000;

/// Bodies that touch exactly may seem to overlap by rounding; this share of the distance
/// at which they touch is forgiven.
pub(super) const ROUNDING: f64 = 1e-9;

/// The agents placed so far. Only bodies in nobody's way are there, so that they stand sparse
/// even where a file lists all agents at one place.
pub(super) struct Placement<'a, const D: usize> {
    solids: &'a [Solid<D>],
    obstacles: &'a [Obstacle<D>],
    boxes: Boxes<D>,
    placed: Standing<D, Placed<D>>,
    /// The room of each group's bodies.
    rooms: Vec<f64>,
    watch: &'a Watch,
    agents: usize,
    /// Looks for places so far.
    looks: usize,
}

/// A body that has its place.
#[derive(Clone, Copy)]
struct Placed<const D: usize> {
    group: usize,
    /// Index within the group.
    index: usize,
    listed: bool,
    /// Whether the file says where it is, rather than a draw.
    fixed: bool,
    radius: f64,
    position: Vector<D>,
}

/// What keeps an agent from a place.
enum Conflict<'a, const D: usize> {
    Agent(Placed<D>),
    Obstacle(usize, &'a Obstacle<D>),
}

impl<'a, const D: usize> Placement<'a, D> {
    /// An empty placement for these groups, with a solid each, among these obstacles.
    pub(super) fn new(
        groups: &[GroupSpec],
        solids: &'a [Solid<D>],
        obstacles: &'a [Obstacle<D>],
        watch: &'a Watch,
    ) -> Self {
        let rooms: Vec<f64> = (groups.iter().zip(solids))
            .map(|(group, solid)| {
                let apart = separation(&group.positions).unwrap_or(0.0);
                apart.max(2.0 * solid.radius())
            })
            .collect();
        let mut boxes = Boxes::default();
        boxes.about(obstacles);
        Self {
            solids,
            obstacles,
            boxes,
            placed: Standing::new(rooms.iter().copied()),
            rooms,
            watch,
            agents: groups
                .iter()
                .filter_map(size)
                .fold(0, usize::saturating_add),
            looks: 0,
        }
    }

    /// Tells now and then how far it is, before another look for a place.
    fn look(&mut self) -> Result<(), Vec<Problem>> {
        /// Looks take about a microsecond.
        const LOOKS: usize = 4096;
        self.looks += 1;
        match self.looks % LOOKS {
            1 => {
                let (placed, of) = (self.placed.len(), self.agents);
                let told = self.watch.tell(Stage::Placing { placed, of });
                told.map_err(|stopped| vec![stopped])
            }
            _ => Ok(()),
        }
    }

    /// Places all agents of a group and returns their positions, or what is in the way of
    /// every one that a list puts in an impossible place.
    pub(super) fn place(
        &mut self,
        index: usize,
        group: &GroupSpec,
        count: usize,
        seed: u64,
    ) -> Result<Vec<Vector<D>>, Vec<Problem>> {
        let mut random = Random::new(seed, Purpose::Positions(index));
        match &group.positions {
            PlacementSpec::Explicit(positions) => self.list(index, positions),
            PlacementSpec::Grid(grid) => {
                let sites = sites::grid(&vector(&grid.corner), grid.spacing, &grid.points);
                self.fix(index, "grid", sites)
            }
            PlacementSpec::Line(line) => {
                let sites = sites::line(&vector(&line.from), &vector(&line.to), count);
                self.fix(index, "line", sites)
            }
            PlacementSpec::Hexagonal(lattice) => {
                let width = 2.0 * self.solids[index].radius();
                if lattice.spacing < width * (1.0 - ROUNDING) {
                    // Bodies would skip places for one another and leave a wider lattice.
                    let path = format!("agents[{index}].positions.hexagonal.spacing");
                    let width = number(width);
                    let what = format!("must be at least {width}, the width of a body");
                    return Err(vec![Problem::new(path, what)]);
                }
                let mut sites = Hexagonal::new(vector(&lattice.center), lattice.spacing);
                self.draw(index, group, count, "hexagonal", || sites.next())
            }
            PlacementSpec::Box(region) => {
                let (min, max) = (vector(&region.min), vector(&region.max));
                self.draw(index, group, count, "box", || random.in_box(&min, &max))
            }
            PlacementSpec::Ball(region) => {
                let center = vector(&region.center);
                let candidate = || random.in_ball(&center, region.radius);
                self.draw(index, group, count, "ball", candidate)
            }
        }
    }

    fn list(
        &mut self,
        group_index: usize,
        positions: &[Vec<f64>],
    ) -> Result<Vec<Vector<D>>, Vec<Problem>> {
        let mut problems = Vec::new();
        let mut places = Vec::new();
        for (index, position) in positions.iter().enumerate() {
            self.look()?;
            if problems.len() >= MOST_PROBLEMS {
                break;
            }
            let body = Placed {
                group: group_index,
                index,
                listed: true,
                fixed: true,
                radius: self.solids[group_index].radius(),
                position: vector(position),
            };
            match self.conflict(&body, 0.0) {
                Some(conflict) => problems.push(Problem::new(name(&body), conflict.with(&body))),
                None => self.insert(body),
            }
            places.push(body.position);
        }
        if problems.is_empty() {
            Ok(places)
        } else {
            Err(problems)
        }
    }

    /// Places agents where a rule puts them; the first that cannot be there is named.
    fn fix(
        &mut self,
        group_index: usize,
        kind: &str,
        sites: Vec<Vector<D>>,
    ) -> Result<Vec<Vector<D>>, Vec<Problem>> {
        for (index, &position) in sites.iter().enumerate() {
            self.look()?;
            let body = Placed {
                group: group_index,
                index,
                listed: false,
                fixed: true,
                radius: self.solids[group_index].radius(),
                position,
            };
            if let Some(conflict) = self.conflict(&body, 0.0) {
                return Err(vec![misplaced(
                    group_index,
                    kind,
                    index,
                    &conflict.with(&body),
                )]);
            }
            self.insert(body);
        }
        Ok(sites)
    }

    fn draw(
        &mut self,
        group_index: usize,
        group: &GroupSpec,
        count: usize,
        kind: &str,
        mut candidate: impl FnMut() -> Vector<D>,
    ) -> Result<Vec<Vector<D>>, Vec<Problem>> {
        let apart = separation(&group.positions).unwrap_or(0.0);
        let mut places = Vec::new();
        for index in 0..count {
            let body = |position| Placed {
                group: group_index,
                index,
                listed: false,
                fixed: false,
                radius: self.solids[group_index].radius(),
                position,
            };
            let mut found = None;
            for _ in 0..DRAWS {
                self.look()?;
                let body = body(candidate());
                if self.conflict(&body, apart).is_none() {
                    found = Some(body);
                    break;
                }
            }
            let Some(body) = found else {
                let distance = number(apart.max(2.0 * self.solids[group_index].radius()));
                let problem = Problem::new(
                    format!("agents[{group_index}].positions.{kind}"),
                    format!(
                        "has room for {index} of the {count} agents only, {distance} apart and \
                         clear of obstacles and other groups (after {DRAWS} tries for the next one)"
                    ),
                );
                let hint = "a larger region, fewer agents or a smaller separation may help";
                return Err(vec![problem.hint(hint)]);
            };
            self.insert(body);
            places.push(body.position);
        }
        Ok(places)
    }

    /// What is in the way of a body: another body closer than touching, an agent of the
    /// same group closer than `apart`, or an obstacle.
    fn conflict(&self, body: &Placed<D>, apart: f64) -> Option<Conflict<'a, D>> {
        let others = self.placed.near(&body.position, self.rooms[body.group]);
        let mut in_the_way = others.filter(|other| {
            let touching = self.touching(body, other);
            let least = match other.group == body.group {
                true => touching.max(apart),
                false => touching,
            };
            (other.position - body.position).norm() < least
        });
        // A message names the first one.
        let found = match body.fixed {
            true => in_the_way.min_by_key(|other| (other.group, other.index)),
            false => in_the_way.next(),
        };
        if let Some(other) = found {
            return Some(Conflict::Agent(*other));
        }
        let touching = body.radius * (1.0 - ROUNDING);
        if body.fixed && !self.solids[body.group].is_ball() {
            return None;
        }
        let (point, range) = (body.position, body.radius);
        let mut near = self.boxes.reached(Reach::Around { point, range });
        let blocks = |index: &usize| self.obstacles[*index].project(&point).distance < touching;
        let index = near.find(blocks)?;
        Some(Conflict::Obstacle(index, &self.obstacles[index]))
    }

    /// The distance below which two bodies overlap, judged by the balls that hold them. None
    /// for those that the file puts near a body that is not round: they are looked at when all
    /// stand and it is known how they are turned.
    fn touching(&self, body: &Placed<D>, other: &Placed<D>) -> f64 {
        let balls = [body, other].map(|one| self.solids[one.group].is_ball());
        if body.fixed && balls != [true, true] {
            return 0.0;
        }
        (body.radius + other.radius) * (1.0 - ROUNDING)
    }

    fn insert(&mut self, body: Placed<D>) {
        let room = self.rooms[body.group];
        self.placed.put(&body.position, room, body);
    }
}

impl<const D: usize> Conflict<'_, D> {
    /// What is wrong with a body that conflicts so.
    fn with(&self, body: &Placed<D>) -> String {
        match self {
            Self::Agent(other) => match (other.position - body.position).norm() {
                0.0 => format!("is the same place as {}", name(other)),
                apart => format!(
                    "overlaps {}: their centres are {} apart, their radii add up to {}",
                    name(other),
                    number(apart),
                    number(body.radius + other.radius)
                ),
            },
            Self::Obstacle(index, obstacle) => {
                let distance = obstacle.project(&body.position).distance;
                let place = match distance < 0.0 {
                    true => format!("{} inside its surface", number(-distance)),
                    false => format!("{} from its surface", number(distance)),
                };
                format!(
                    "overlaps obstacles[{index}], {}: the centre is {place}, the radius is {}",
                    obstacle.name,
                    number(body.radius)
                )
            }
        }
    }
}

/// What is wrong with a rule that puts an agent at an impossible place.
pub(super) fn misplaced(group: usize, kind: &str, index: usize, what: &str) -> Problem {
    Problem::new(
        format!("agents[{group}].positions.{kind}"),
        format!("puts agent {index} at a place that {what}"),
    )
}

fn name<const D: usize>(body: &Placed<D>) -> String {
    agent_name(body.group, body.index, body.listed)
}

/// What messages call an agent: its place in the file, where it has one.
pub(super) fn agent_name(group: usize, index: usize, listed: bool) -> String {
    match listed {
        true => format!("agents[{group}].positions.explicit[{index}]"),
        false => format!("agent {index} of agents[{group}]"),
    }
}

fn separation(positions: &PlacementSpec) -> Option<f64> {
    match positions {
        PlacementSpec::Explicit(_)
        | PlacementSpec::Grid(_)
        | PlacementSpec::Hexagonal(_)
        | PlacementSpec::Line(_) => None,
        PlacementSpec::Box(region) => region.separation,
        PlacementSpec::Ball(region) => region.separation,
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;
    use crate::shape::{Pose, Shape};

    fn problems<const D: usize>(radius: f64, positions: &[Vec<f64>]) -> Vec<Problem>
    where
        crate::shape::In<D>: crate::shape::Geometry<D>,
    {
        let group = json!({ "radius": radius, "positions": { "explicit": positions } });
        let group: GroupSpec = serde_json::from_value(group).unwrap();
        let groups = std::slice::from_ref(&group);
        let solids = crate::world::agents::solids(groups).unwrap();
        let placed = Placement::<D>::new(groups, &solids, &[], &Watch::default()).place(
            0,
            &group,
            positions.len(),
            1,
        );
        placed.err().unwrap_or_default()
    }

    #[test]
    fn bodies_may_touch() {
        let row: Vec<_> = (0..50).map(|i| vec![0.1 * f64::from(i), -0.3]).collect();
        assert_eq!(problems::<2>(0.05, &row), []);
        assert_eq!(problems::<2>(0.0501, &row).len(), 25);
    }

    fn agrees_with_brute_force<const D: usize>()
    where
        crate::shape::In<D>: crate::shape::Geometry<D>,
    {
        // Points of a low-discrepancy sequence, dense enough for some overlaps.
        let share = |i: usize, axis: usize| (i as f64 * [0.7549, 0.5698, 0.3319][axis]).fract();
        let point = |i| (0..D).map(|axis| 4.0 * share(i, axis) - 2.0).collect();
        let points: Vec<Vec<f64>> = (0..300).map(point).collect();
        let (mut free, mut expected): (Vec<Vector<D>>, _) = (Vec::new(), Vec::new());
        for (i, point) in points.iter().enumerate() {
            let point = vector(point);
            if free.iter().any(|other| (other - point).norm() < 0.3) {
                expected.push(format!("agents[0].positions.explicit[{i}]"));
            } else {
                free.push(point);
            }
        }
        let found = problems::<D>(0.15, &points);
        let found: Vec<String> = found.into_iter().map(|one| one.path).collect();
        assert!(!expected.is_empty() && expected.len() < 300);
        assert_eq!(found, expected);
    }

    #[test]
    fn finds_every_overlap() {
        agrees_with_brute_force::<2>();
        agrees_with_brute_force::<3>();
    }

    #[test]
    fn a_lattice_goes_around_obstacles_and_other_groups() {
        let group = |radius: f64, count: usize| -> GroupSpec {
            let lattice = json!({ "hexagonal": { "center": [0, 0], "spacing": 2 } });
            let group = json!({ "radius": radius, "count": count, "positions": lattice });
            serde_json::from_value(group).unwrap()
        };
        let groups = [group(1.0, 7), group(0.5, 6)];
        let pole = Pose::new(Vector::zeros(), [0.0; 3]);
        let pole = Obstacle::new("pole".into(), Shape::Ball { radius: 0.5 }, pole).unwrap();
        let balls = [1.0, 0.5].map(|radius| Solid::new(Shape::Ball { radius }).unwrap());
        let watch = Watch::default();
        let mut placement =
            Placement::<2>::new(&groups, &balls, std::slice::from_ref(&pole), &watch);
        let far = |positions: Vec<Vector<2>>| {
            let squares = positions.iter().map(|at| (at.norm_squared() / 4.0).round());
            squares.collect::<Vec<_>>()
        };
        // The pole takes the centre; six are on the first ring, the seventh on the second.
        let first = placement.place(0, &groups[0], 7, 1).unwrap();
        assert_eq!(far(first), [1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 3.0]);
        let second = placement.place(1, &groups[1], 6, 1).unwrap();
        assert_eq!(far(second), [3.0, 3.0, 3.0, 3.0, 3.0, 4.0]);
    }

    #[test]
    fn survives_extreme_places() {
        let far = [vec![1e100, -1e100], vec![1e100, -1e100], vec![-1e100, 0.0]];
        assert_eq!(problems::<2>(1e-300, &far).len(), 1);
    }
}

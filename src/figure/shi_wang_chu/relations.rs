//! Agents, who senses whose velocity, and how that is drawn.

use super::point;
use crate::figure::Trouble;
use crate::figure::course::Of;
use crate::math::Vector;
use crate::metric::diameter;
use crate::net::Adjacency;
use crate::picture::Theme;
use crate::plot::{Item, Marker};
use crate::trace::record::Frame;
use crate::world::World;
use crate::world::spec::LawSpec;

/// The time in which an agent flies as far as the arrow of its velocity is long.
pub(super) const AHEAD: f64 = 0.4;

/// Who senses whose velocity.
pub(in crate::figure) struct Relations {
    /// Pairs that sense each other, first below second.
    pub(in crate::figure) mutual: Vec<[usize; 2]>,
    /// Who senses, and who is sensed and does not sense back.
    pub(in crate::figure) one_way: Vec<[usize; 2]>,
}

impl Relations {
    pub(in crate::figure) fn of(world: &World<2>) -> Result<Self, Trouble> {
        let graph = world.laws().find_map(|(_, law)| match law {
            LawSpec::Alignment(law) => law.graph.as_ref(),
            _ => None,
        });
        let rows = graph.and_then(|graph| graph.rows(world.agents.len(), world.spec.seed));
        let rows = rows.ok_or_else(|| {
            Trouble::new(&world.name, "no law aligns velocities along a fixed graph")
        })?;
        let weights = Adjacency::new(rows);
        let (mut mutual, mut one_way) = (Vec::new(), Vec::new());
        for i in 0..weights.agents() {
            for &(j, _) in weights.row(i) {
                match weights.weight(j, i) > 0.0 {
                    true if i < j => mutual.push([i, j]),
                    true => {}
                    false => one_way.push([i, j]),
                }
            }
        }
        Ok(Self { mutual, one_way })
    }
}

/// Agents at these places with their relations, as the paper has them: blue the mutual ones, red
/// those of one side.
pub(super) fn configuration(
    positions: &[Vector<2>],
    relations: &Relations,
    theme: &Theme,
) -> Vec<Item> {
    let ends = |[i, j]: [usize; 2]| [positions[i], positions[j]];
    // Arrows end before the marker that they point to.
    let room = 0.015 * diameter(positions);
    let to_edge = |[from, to]: [Vector<2>; 2]| {
        let way = to - from;
        [point(from), point(to - way * (room / way.norm()).min(0.5))]
    };
    let blue = relations.mutual.iter().map(|pair| ends(*pair).map(point));
    let red = relations.one_way.iter().map(|pair| to_edge(ends(*pair)));
    let agents = positions.iter().copied().map(point);
    vec![
        Item::segments(blue, theme.of(0)).sized(1.4).named("mutual"),
        Item::arrows(red, theme.alarm)
            .sized(1.0)
            .named("one senses the other"),
        Item::markers(agents, Marker::Disk, theme.ink),
    ]
}

/// The agents of a frame with their relations and velocities.
pub(super) fn moving(frame: &Frame, relations: &Relations, theme: &Theme) -> Vec<Item> {
    let [positions, velocities] = [Of::Positions, Of::Velocities].map(|of| of.vectors(frame));
    let pairs = positions.iter().zip(velocities);
    let arrows = pairs.map(|(x, v)| [point(*x), point(x + v * AHEAD)]);
    let arrows = Item::arrows(arrows, theme.ink).sized(1.8);
    let mut items = configuration(&positions, relations, theme);
    items.push(arrows.named(format!("velocity × {AHEAD}")));
    items
}

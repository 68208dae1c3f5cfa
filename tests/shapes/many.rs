//! Thin shapes and shapes of many parts, against samples or closed forms of their definition.

use proptest::prelude::*;
use serde_json::{Value, json};
use volary::math::Vector;
use volary::shape::{Acting, Geometry, In, Obstacle};

use crate::{along, obstacle};

/// Steps of the samples along an edge.
const FINE: usize = 400;

/// The distance to some simplices, by points sampled on them; `step` is set to how far from
/// a sample a point of them can be.
fn sampled<const D: usize>(simplices: &[Vec<[f64; 3]>], q: &Vector<D>, step: &mut f64) -> f64 {
    let mut least = f64::INFINITY;
    for simplex in simplices {
        let corners: Vec<Vector<D>> = simplex.iter().map(|&corner| along(corner)).collect();
        let fine = if corners.len() == 2 { FINE } else { 60 };
        let longest = corners
            .iter()
            .map(|c| (c - corners[0]).norm())
            .fold(0.0, f64::max);
        *step = step.max(2.0 * longest / fine as f64);
        for i in 0..=fine {
            let rest = if corners.len() == 2 { 0 } else { fine - i };
            for j in 0..=rest {
                let share = |k: usize| k as f64 / fine as f64;
                let mut at = corners[0] + (corners[1] - corners[0]) * share(i);
                if let Some(third) = corners.get(2) {
                    at += (third - corners[0]) * share(j);
                }
                least = least.min((at - q).norm());
            }
        }
    }
    least
}

/// The parts of a projection fit together.
fn coherent<const D: usize>(name: &str, obstacle: &Obstacle<D>, q: &Vector<D>) {
    let it = obstacle.project(q);
    assert!((it.normal.norm() - 1.0).abs() < 1e-9, "{name}: {q}");
    let back = it.point + it.normal * it.distance;
    assert!((back - q).norm() < 1e-7, "{name}: {back} is not {q}");
    let again = obstacle.project(&it.point).distance;
    assert!(again.abs() < 1e-7, "{name}: {again} on the surface");
    assert!(obstacle.may_reach(q, it.distance.max(0.0) + 1e-9), "{name}");
}

fn quad(corners: [[f64; 3]; 4]) -> Vec<Vec<[f64; 3]>> {
    let [a, b, c, d] = corners;
    vec![vec![a, b, c], vec![a, c, d]]
}

/// Thin shapes, and what they are by definition.
fn thin(dimension: usize) -> Vec<(Value, Vec<Vec<[f64; 3]>>)> {
    let points = [
        [-1.0, 0.3, 0.2],
        [0.8, 1.0, -0.6],
        [1.4, -0.9, 0.5],
        [-0.2, -1.2, 0.0],
    ];
    let cut = |point: &[f64; 3]| point[..dimension].to_vec();
    let lists: Vec<_> = points.iter().map(cut).collect();
    let chain = |closed: bool| {
        let count = if closed { 4 } else { 3 };
        (0..count)
            .map(|k| vec![points[k], points[(k + 1) % 4]])
            .collect()
    };
    // A right angle, two wide, its mitred walls worked out by hand.
    let walls = [
        [[0.0, 1.0], [3.0, 1.0]],
        [[3.0, 1.0], [3.0, 4.0]],
        [[0.0, -1.0], [5.0, -1.0]],
        [[5.0, -1.0], [5.0, 4.0]],
    ];
    let corridor: Vec<_> = match dimension {
        2 => walls
            .map(|wall| wall.map(|[x, y]| [x, y, 0.0]).to_vec())
            .to_vec(),
        _ => {
            let sides = walls.iter().flat_map(|[[a, b], [c, d]]| {
                quad([[*a, *b, -1.0], [*c, *d, -1.0], [*c, *d, 1.0], [*a, *b, 1.0]])
            });
            let covers = [-1.0, 1.0].into_iter().flat_map(|z| {
                let first = quad([[0.0, -1.0, z], [5.0, -1.0, z], [3.0, 1.0, z], [0.0, 1.0, z]]);
                let second = quad([[3.0, 1.0, z], [5.0, -1.0, z], [5.0, 4.0, z], [3.0, 4.0, z]]);
                first.into_iter().chain(second)
            });
            sides.chain(covers).collect()
        }
    };
    let bend = [[0.0; 3], [4.0, 0.0, 0.0], [4.0, 4.0, 0.0]].map(|point| cut(&point));
    let mut shapes = vec![
        (
            json!({ "segment": { "from": lists[0], "to": lists[1] } }),
            vec![points[..2].to_vec()],
        ),
        (json!({ "polyline": { "points": lists } }), chain(false)),
        (
            json!({ "polyline": { "points": lists, "closed": true } }),
            chain(true),
        ),
        (
            json!({ "corridor": { "points": bend, "width": 2 } }),
            corridor,
        ),
    ];
    if dimension == 2 {
        let field = [
            [-1.5, 0.2, 0.0],
            [-0.5, 1.0, 0.0],
            [0.5, -0.4, 0.0],
            [1.5, 0.3, 0.0],
        ];
        shapes.push((
            json!({ "heightfield": { "width": 3, "heights": [0.2, 1.0, -0.4, 0.3] } }),
            field.windows(2).map(<[_]>::to_vec).collect(),
        ));
    } else {
        shapes.push((
            json!({ "triangle": { "points": lists[..3] } }),
            vec![points[..3].to_vec()],
        ));
        shapes.push((
            json!({ "mesh": { "vertices": lists, "triangles": [[0, 1, 2], [3, 1, 0]] } }),
            vec![points[..3].to_vec(), vec![points[3], points[1], points[0]]],
        ));
        let at = |x: f64, y: f64, z: f64| [x, y, z];
        // Two rows of three, each cell cut from its first corner to its last.
        let low = [at(-1.0, -0.5, 0.1), at(0.0, -0.5, 0.9), at(1.0, -0.5, -0.2)];
        let high = [at(-1.0, 0.5, 0.4), at(0.0, 0.5, -0.7), at(1.0, 0.5, 0.0)];
        let cells = (0..2).flat_map(|k| quad([low[k], low[k + 1], high[k + 1], high[k]]));
        shapes.push((
            json!({ "heightfield": {
                "width": 2, "depth": 1, "heights": [[0.1, 0.9, -0.2], [0.4, -0.7, 0.0]]
            } }),
            cells.collect(),
        ));
    }
    shapes
}

fn check_thin<const D: usize>(at: [f64; 3])
where
    In<D>: Geometry<D>,
{
    let q = along::<D>(at);
    for (shape, simplices) in thin(D) {
        let wall = obstacle::<D>(&json!({ "shape": shape }));
        let name = shape.to_string();
        coherent(&name, &wall, &q);
        let mut step = 0.0;
        let rough = sampled(&simplices, &q, &mut step);
        let exact = wall.project(&q).distance;
        assert!(
            exact >= 0.0 && exact <= rough + 1e-12,
            "{name}: {exact} {rough}"
        );
        assert!(rough <= exact + step, "{name}: {exact} {rough}");
    }
}

/// Signed distance to a box about the origin.
fn in_box<const D: usize>(q: &Vector<D>, half: &Vector<D>) -> f64 {
    let out = q.abs() - half;
    out.map(|x| x.max(0.0)).norm() + out.max().min(0.0)
}

/// Solids of several parts, and their signed distance by definition.
#[expect(clippy::type_complexity, reason = "said once")]
fn solid<const D: usize>() -> Vec<(Value, Box<dyn Fn(&Vector<D>) -> f64>)> {
    let half = along::<D>([1.0, 0.5, 0.7]);
    let center = along::<D>([2.0, 0.3, 0.1]);
    let mut solids: Vec<(Value, Box<dyn Fn(&Vector<D>) -> f64>)> = vec![
        (
            json!({ "room": { "half_extents": half.as_slice() } }),
            Box::new(move |q| (half - q.abs()).min()),
        ),
        (
            json!({ "compound": { "parts": [
                { "shape": { "cuboid": { "half_extents": half.as_slice() } } },
                { "shape": { "ball": { "radius": 0.8 } }, "position": center.as_slice() }
            ] } }),
            Box::new(move |q| in_box(q, &half).min((q - center).norm() - 0.8)),
        ),
    ];
    if D == 2 {
        // A square of four triangles about its middle: their inner edges are no surface.
        solids.push((
            json!({ "mesh": {
                "vertices": [[0, 0], [1, 1], [-1, 1], [-1, -1], [1, -1]],
                "triangles": [[0, 1, 2], [0, 2, 3], [4, 3, 0], [0, 4, 1]]
            } }),
            Box::new(|q| in_box(q, &Vector::repeat(1.0))),
        ));
    }
    solids
}

fn check_solid<const D: usize>(at: [f64; 3])
where
    In<D>: Geometry<D>,
{
    let q = along::<D>(at);
    for (shape, distance) in solid::<D>() {
        // Moved out of the way of the test's agent.
        let shift = Vector::<D>::repeat(50.0);
        let name = shape.to_string();
        let far = match shape.get("room") {
            Some(_) => Vector::repeat(0.4),
            None => shift,
        };
        let it = obstacle::<D>(&json!({ "shape": shape, "position": far.as_slice() }));
        let found = it.project(&(q + far)).distance;
        let exact = distance(&q);
        assert!(
            (found - exact).abs() < 1e-7,
            "{name} at {q}: {found} {exact}"
        );
        if exact > 0.0 || name.contains("mesh") {
            coherent(&name, &it, &(q + far));
        }
    }
}

/// A rough surface of many facets (segments).
fn rough<const D: usize>() -> Value {
    let height = |k: usize| ((k * 7919) % 101) as f64 / 101.0;
    let row = |j: usize| (0..15).map(|i| height(31 * j + i)).collect::<Vec<_>>();
    match D {
        2 => json!({ "heightfield": { "width": 10, "heights": row(0) } }),
        _ => json!({ "heightfield": {
            "width": 10, "depth": 8, "heights": (0..12).map(row).collect::<Vec<_>>()
        } }),
    }
}

fn tree_misses_nothing<const D: usize>(at: [f64; 3], range: f64)
where
    In<D>: Geometry<D>,
{
    let spec = json!({ "shape": rough::<D>(), "position": vec![0.2; D], "beta_agents": "each" });
    let field = obstacle::<D>(&spec);
    let q = along::<D>(at);
    let single = |part: &volary::shape::Part<D>| {
        let alone = vec![part.clone()];
        let it = Obstacle::of_parts("one".into(), alone, Acting::Each, field.pose.clone());
        it.expect("a part").project(&q)
    };
    let all: Vec<_> = field.parts().iter().map(single).collect();
    let least = all
        .iter()
        .map(|it| it.distance)
        .fold(f64::INFINITY, f64::min);
    assert_eq!(field.project(&q).distance, least);
    let within: Vec<_> = (0..all.len())
        .filter(|&k| all[k].distance <= range)
        .collect();
    let found: Vec<_> = field.projections(&q, range).collect();
    assert_eq!(
        found.iter().map(|(part, _)| *part).collect::<Vec<_>>(),
        within
    );
    for (part, projection) in found {
        assert_eq!(projection, all[part]);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn thin_shapes_are_what_they_say(at in prop::array::uniform3(-2.5..2.5f64)) {
        check_thin::<2>(at);
        check_thin::<3>(at);
    }

    #[test]
    fn solids_of_parts_have_their_signed_distance(at in prop::array::uniform3(-2.5..2.5f64)) {
        check_solid::<2>(at);
        check_solid::<3>(at);
    }

    #[test]
    fn the_tree_finds_what_all_parts_give(
        at in prop::array::uniform3(-6.0..6.0f64),
        range in 0.1..6.0f64,
    ) {
        tree_misses_nothing::<2>(at, range);
        tree_misses_nothing::<3>(at, range);
    }
}

#[test]
fn inner_edges_of_a_plane_mesh_are_no_surface() {
    let (spec, _) = solid::<2>().pop().expect("the mesh");
    let square = obstacle::<2>(&json!({ "shape": spec, "position": [10, 0] }));
    for at in [[0.0, 0.0], [0.5, 0.5], [-0.25, 0.25]] {
        let q = Vector::<2>::from(at) + Vector::<2>::new(10.0, 0.0);
        let exact = at[0].abs().max(at[1].abs()) - 1.0;
        assert!((square.project(&q).distance - exact).abs() < 1e-9, "{at:?}");
    }
}

#[test]
fn tunnels_keep_their_width_through_bends_in_space() {
    let points = [
        [0.0, 0.0, 0.0],
        [5.0, 0.0, 0.0],
        [5.0, 5.0, 0.0],
        [5.0, 5.0, 5.0],
    ];
    let spec = json!({ "corridor": { "points": points, "width": 2 } });
    // The agent of the test sits in the tunnel and clear of its walls.
    let tunnel = obstacle::<3>(&json!({ "shape": spec }));
    for middle in [[2.0, 0.0, 0.0], [5.0, 2.5, 0.0], [5.0, 5.0, 3.0]] {
        let distance = tunnel.project(&middle.into()).distance;
        assert!((distance - 1.0).abs() < 1e-9, "{middle:?}: {distance}");
    }
    assert_eq!(tunnel.parts().len(), 3 * 4 * 2);
}

#[test]
fn parts_act_each_or_as_one() {
    let two = |beta_agents: &str| {
        obstacle::<2>(&json!({
            "shape": { "compound": { "parts": [
                { "shape": { "ball": { "radius": 1 } }, "position": [-2, 5] },
                { "shape": { "ball": { "radius": 1 } }, "position": [2, 5] }
            ] } },
            "beta_agents": beta_agents
        }))
    };
    let q = Vector::<2>::new(0.1, 5.0);
    let parts = |it: &Obstacle<2>, range| -> Vec<usize> {
        it.projections(&q, range).map(|(part, _)| part).collect()
    };
    let (each, nearest) = (two("each"), two("nearest"));
    assert_eq!(parts(&each, 3.0), [0, 1]);
    assert_eq!(parts(&each, 1.0), [1]);
    assert_eq!(parts(&nearest, 3.0), [1]);
    assert!(parts(&nearest, 0.5).is_empty());
    assert!(each.center().is_none());
    let gamma = each.part_interior_point(1, &Vector::<2>::new(0.0, 1.0), 0.5);
    assert!((gamma.expect("a ball has a centre") - Vector::<2>::new(2.0, 5.5)).norm() < 1e-9);
}

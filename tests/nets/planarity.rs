//! Planarity against Wagner's theorem, and on large graphs whose answer is known.

use std::collections::BTreeMap;

use volary::math::Vector;
use volary::net::{crossings, is_planar};

use crate::sample::{Edge, Stream, bipartite, complete, graph, petersen};

/// Planarity of small graphs by Wagner's theorem: no minor is K5 or K3,3. A minor is a
/// subgraph of a contraction, so every contraction is searched for the two.
#[derive(Default)]
struct Wagner {
    known: BTreeMap<Vec<u16>, bool>,
}

impl Wagner {
    fn is_planar(&mut self, around: &[u16]) -> bool {
        if around.len() < 5 {
            return true;
        }
        if let Some(&known) = self.known.get(around) {
            return known;
        }
        let mut planar = !has_k5(around) && !has_k33(around);
        for j in 0..around.len() {
            for i in 0..j {
                if planar && around[i] >> j & 1 == 1 {
                    planar = self.is_planar(&contracted(around, i, j));
                }
            }
        }
        self.known.insert(around.to_vec(), planar);
        planar
    }
}

/// The neighbours of each vertex as bits, after `j` has become one with `i` < `j`.
fn contracted(around: &[u16], i: usize, j: usize) -> Vec<u16> {
    let drop = |bits: u16| (bits & ((1 << j) - 1)) | (bits >> (j + 1) << j);
    let mut joined = around.to_vec();
    joined[i] |= joined[j];
    for (k, bits) in joined.iter_mut().enumerate() {
        if *bits >> j & 1 == 1 {
            *bits |= 1 << i;
        }
        *bits &= !(1 << k);
    }
    joined.remove(j);
    let mut joined: Vec<u16> = joined.into_iter().map(drop).collect();
    joined[i] &= !(1 << i);
    joined
}

fn subsets(n: usize, size: u32) -> impl Iterator<Item = u16> {
    (0..1u16 << n).filter(move |bits| bits.count_ones() == size)
}

fn members(bits: u16) -> impl Iterator<Item = usize> {
    (0..16).filter(move |i| bits >> i & 1 == 1)
}

fn has_k5(around: &[u16]) -> bool {
    subsets(around.len(), 5).any(|five| members(five).all(|i| around[i] & five == five & !(1 << i)))
}

fn has_k33(around: &[u16]) -> bool {
    subsets(around.len(), 3).any(|three| {
        let common = members(three).fold(!0, |common, i| common & around[i]);
        (common & !three).count_ones() >= 3
    })
}

fn bits(n: usize, edges: &[Edge]) -> Vec<u16> {
    let mut around = vec![0; n];
    for &[i, j] in edges {
        around[i] |= 1 << j;
        around[j] |= 1 << i;
    }
    around
}

#[test]
fn every_graph_of_six_vertices_is_told_right() {
    let (all, mut wagner, mut planar) = (complete(6), Wagner::default(), 0);
    for chosen in 0..1u32 << all.len() {
        let edges: Vec<Edge> = (0..all.len())
            .filter(|k| chosen >> k & 1 == 1)
            .map(|k| all[k])
            .collect();
        let expected = wagner.is_planar(&bits(6, &edges));
        assert_eq!(
            is_planar(&graph(6, edges.iter().copied())),
            expected,
            "{edges:?}"
        );
        planar += u32::from(expected);
    }
    // The number of labelled planar graphs, OEIS A066537.
    assert_eq!(planar, 32_071);
}

#[test]
fn random_graphs_of_seven_and_eight_vertices_are_told_right() {
    let (mut stream, mut wagner) = (Stream(1), Wagner::default());
    let mut planar = 0;
    for round in 0..3000 {
        let n = 7 + round % 2;
        // Around 2n edges, where both answers are common.
        let share = 0.4 + 0.35 * stream.share();
        let edges: Vec<Edge> = complete(n)
            .into_iter()
            .filter(|_| stream.share() < share)
            .collect();
        let expected = wagner.is_planar(&bits(n, &edges));
        assert_eq!(
            is_planar(&graph(n, edges.iter().copied())),
            expected,
            "{edges:?}"
        );
        planar += i32::from(expected);
    }
    assert!((600..2400).contains(&planar), "{planar} are planar");
}

#[test]
fn kuratowski_and_his_friends() {
    let planar = |n, edges: Vec<Edge>| is_planar(&graph(n, edges));
    assert!(planar(4, complete(4)));
    assert!(!planar(5, complete(5)));
    assert!(planar(5, complete(5)[1..].to_vec()));
    assert!(!planar(6, bipartite(3, 3)));
    assert!(planar(6, bipartite(3, 3)[1..].to_vec()));
    assert!(planar(42, bipartite(2, 40)));
    assert!(!planar(10, petersen()));
    assert!(planar(0, vec![]) && planar(3, vec![]));
}

/// Points in the plane and straight edges between them, none of which cross.
fn drawing(stream: &mut Stream, n: usize) -> (Vec<Vector<2>>, Vec<Edge>) {
    let points: Vec<_> = (0..n)
        .map(|_| Vector::<2>::new(stream.share(), stream.share()))
        .collect();
    let (mut edges, mut candidates) = (Vec::<Edge>::new(), complete(n));
    while !candidates.is_empty() && edges.len() < 2 * n {
        let pick = stream.below(candidates.len());
        let edge = candidates.swap_remove(pick);
        let free = |old: &Edge| crossings(&points, &graph(n, [*old, edge])) == 0;
        if edges.iter().all(free) {
            edges.push(edge);
        }
    }
    (points, edges)
}

/// The edges with `times` of them split by a new vertex, which changes no planarity.
fn subdivided(stream: &mut Stream, n: usize, edges: &[Edge], times: usize) -> (usize, Vec<Edge>) {
    let mut edges = edges.to_vec();
    for new in n..n + times {
        let pick = stream.below(edges.len());
        let [i, j] = edges[pick];
        edges[pick] = [i, new];
        edges.push([new, j]);
    }
    (n + times, edges)
}

/// The edges with their vertices named anew, at random.
fn shuffled(stream: &mut Stream, n: usize, edges: &[Edge]) -> Vec<Edge> {
    let mut name: Vec<usize> = (0..n).collect();
    for i in (1..n).rev() {
        name.swap(i, stream.below(i + 1));
    }
    edges.iter().map(|&[i, j]| [name[i], name[j]]).collect()
}

#[test]
fn drawings_without_crossings_are_planar_and_hidden_kuratowski_graphs_are_not() {
    let mut stream = Stream(7);
    for round in 0..40 {
        let n = 20 + stream.below(30);
        let (points, edges) = drawing(&mut stream, n);
        assert_eq!(crossings(&points, &graph(n, edges.iter().copied())), 0);
        let (n, edges) = subdivided(&mut stream, n, &edges, 10);
        let named = shuffled(&mut stream, n, &edges);
        assert!(is_planar(&graph(n, named)), "round {round}");

        // A subdivided K5 or K3,3 shares a vertex, or two, with the planar graph.
        let (m, bad) = if round % 2 == 0 {
            (5, complete(5))
        } else {
            (6, bipartite(3, 3))
        };
        let (m, bad) = subdivided(&mut stream, m, &bad, 15);
        let shared = 1 + round % 3 % 2;
        let place = |k: usize| if k < shared { k } else { n + k };
        let both: Vec<Edge> = edges
            .iter()
            .copied()
            .chain(bad.iter().map(|&[i, j]| [place(i), place(j)]))
            .collect();
        let named = shuffled(&mut stream, n + m, &both);
        assert!(!is_planar(&graph(n + m, named)), "round {round}");
    }
}

#[test]
fn one_edge_too_many_or_in_the_wrong_place() {
    let mut stream = Stream(3);
    for _ in 0..40 {
        // A stacked triangulation is maximal planar and has but one drawing: without an
        // edge ij of a stacked vertex i, only edges inside the hole can be added.
        let n = 12 + stream.below(30);
        let mut faces = vec![[0, 1, 2], [0, 1, 2]];
        let mut edges: Vec<Edge> = vec![[0, 1], [1, 2], [0, 2]];
        for new in 3..n {
            let pick = stream.below(faces.len());
            let [a, b, c] = faces.swap_remove(pick);
            faces.extend([[a, b, new], [b, c, new], [a, c, new]]);
            edges.extend([[a, new], [b, new], [c, new]]);
        }
        assert!(is_planar(&graph(n, edges.iter().copied())));
        // Every chord of a maximal planar graph makes it nonplanar, and so it stays when
        // all edges are split, and Euler's count no longer tells.
        let missing: Vec<Edge> = complete(n)
            .into_iter()
            .filter(|[i, j]| !edges.contains(&[*i, *j]) && !edges.contains(&[*j, *i]))
            .collect();
        let chord = missing[stream.below(missing.len())];
        edges.push(chord);
        let times = 3 * edges.len();
        let (n, edges) = subdivided(&mut stream, n, &edges, times);
        assert!(edges.len() < 3 * n - 6);
        assert!(!is_planar(&graph(n, edges)));
    }
}

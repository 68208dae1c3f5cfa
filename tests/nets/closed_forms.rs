//! Nets whose analysis is known in closed form.

use std::f64::consts::{PI, TAU};

use volary::math::Vector;
use volary::metric::{deviation_energy, union};
use volary::net::{
    Adjacency, Net, Rigidity, algebraic_connectivity, crossings, defect, is_planar, is_realisation,
    neighborhood, normalised_defect, potential_gradient, realisation_error, structural_potential,
};

use crate::sample::{Edge, bipartite, chain, complete, cycle, graph, lattice, pair, petersen};

fn plane<const N: usize>(at: [(f64, f64); N]) -> Vec<Vector<2>> {
    at.map(|(x, y)| Vector::<2>::new(x, y)).to_vec()
}

fn close(found: f64, expected: f64) {
    assert!((found - expected).abs() < 1e-9, "{found} is not {expected}");
}

#[test]
fn algebraic_connectivity_of_known_graphs() {
    let of = |n: usize, edges: Vec<Edge>| {
        algebraic_connectivity(&Adjacency::from(&graph(n, edges))).expect("two or more agents")
    };
    for n in 3..20 {
        let angle = 1.0 / n as f64;
        close(of(n, cycle(n)), 2.0 - 2.0 * (TAU * angle).cos());
        close(of(n, chain(n)), 2.0 - 2.0 * (PI * angle).cos());
        close(of(n, complete(n)), n as f64);
        close(of(n + 1, bipartite(1, n)), 1.0);
    }
    close(of(7, bipartite(3, 4)), 3.0);
    close(of(10, petersen()), 2.0);
    assert_eq!(of(4, vec![[0, 1], [2, 3]]), 0.0);
    // A ring that is seen one way only: the mirror's weights are one half.
    let ring = Adjacency::new((0..9).map(|i| vec![((i + 1) % 9, 1.0)]).collect());
    close(
        algebraic_connectivity(&ring).expect("nine agents"),
        1.0 - (TAU / 9.0).cos(),
    );
}

/// The net at these places with this range: edges, rank missing, crossings, planarity.
fn analysis<const D: usize>(positions: &[Vector<D>], range: f64) -> (usize, usize, bool) {
    let net = Net::new(positions, range);
    let freedoms = Rigidity::new(positions, &net).freedoms();
    (net.edges().len(), freedoms, is_planar(&net))
}

#[test]
fn small_frameworks() {
    let square = plane([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]);
    let hexagon: Vec<_> = (0..6)
        .map(|k| f64::from(k) * PI / 3.0)
        .map(|angle| Vector::<2>::new(angle.cos(), angle.sin()))
        .collect();
    assert_eq!(analysis(&square[..2], 1.0), (1, 0, true));
    assert_eq!(analysis(&square[..2], 0.9), (0, 1, true));
    assert_eq!(
        analysis(&plane([(0.0, 0.0), (1.0, 0.0), (0.5, 0.9)]), 1.1),
        (3, 0, true)
    );
    assert_eq!(analysis(&square, 1.1), (4, 1, true));
    assert_eq!(analysis(&square, 1.5), (6, 0, true));
    assert_eq!(crossings(&square, &Net::new(&square, 1.5)), 1);
    let braced = graph(4, [[0, 1], [1, 2], [2, 3], [0, 3], [0, 2]]);
    assert!(Rigidity::new(&square, &braced).is_rigid());
    assert_eq!(crossings(&square, &braced), 0);
    // A chain of n bends at each inner agent; a hexagon has 9 − 6 freedoms.
    let line: Vec<_> = (0..7)
        .map(|k| Vector::<2>::new(f64::from(k), 0.0))
        .collect();
    assert_eq!(analysis(&line, 1.0), (6, 5, true));
    assert_eq!(analysis(&hexagon, 1.1), (6, 3, true));
    // All of K6 in convex position: one crossing for every four agents.
    assert_eq!(analysis(&hexagon, 2.1), (15, 0, false));
    let convex: Vec<_> = (0..6)
        .map(|k| hexagon[k] * (1.0 + 0.01 * k as f64))
        .collect();
    assert_eq!(crossings(&convex, &Net::new(&convex, 9.0)), 15);
    // Two triangles that share an agent hinge there; apart, they move as they like.
    let bow = plane([
        (0.0, 0.0),
        (1.0, 0.5),
        (1.0, -0.5),
        (-1.0, 0.5),
        (-1.0, -0.5),
    ]);
    assert_eq!(analysis(&bow, 1.2), (6, 1, true));
}

#[test]
fn frameworks_in_space() {
    let tetrahedron = [
        (1.0, 1.0, 1.0),
        (1.0, -1.0, -1.0),
        (-1.0, 1.0, -1.0),
        (-1.0, -1.0, 1.0),
    ]
    .map(|(x, y, z)| Vector::<3>::new(x, y, z));
    assert_eq!(analysis(&tetrahedron, 2.9), (6, 0, true));
    let net = Net::new(&tetrahedron, 2.9);
    assert!(realisation_error(&tetrahedron, &net, 8f64.sqrt()) < 1e-15);
    // A cube of bars: 3·8 − 6 − 12. With all diagonals it is rigid, and not planar.
    let cube: Vec<_> = (0..8)
        .map(|k| Vector::<3>::new(f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2)))
        .collect();
    assert_eq!(analysis(&cube, 1.1), (12, 6, true));
    assert_eq!(analysis(&cube, 1.8), (28, 0, false));
    // The octahedron, Cauchy's rigid polyhedron; two of its pyramids hinge on nothing.
    let octahedron: Vec<_> = (0..3)
        .flat_map(|axis| [1.0, -1.0].map(|sign| Vector::<3>::ith(axis, sign)))
        .collect();
    assert_eq!(analysis(&octahedron, 1.5), (12, 0, true));
}

#[test]
fn a_triangular_lattice_is_the_perfect_net() {
    let positions = lattice(7, 8);
    let net = Net::new(&positions, 1.2);
    assert_eq!(
        analysis(&positions, 1.2),
        (7 * 7 + 6 * (2 * 8 - 1), 0, true)
    );
    assert_eq!(crossings(&positions, &net), 0);
    assert!(realisation_error(&positions, &net, 1.0) < 1e-14);
    assert!(is_realisation(&positions, &net, 1.0, 1e-12));
    assert!(deviation_energy(&positions, &net, 1.0) < 1e-28);
    assert_eq!(union(&net.partition()), Some(1.0));
    for smooth in [false, true] {
        let pair = pair(1.0, 1.2, smooth);
        assert!(structural_potential(&positions, &net, &pair).abs() < 1e-12);
        assert!(defect(&positions, &net, &pair, 1.0).abs() < 1e-12);
        assert!(
            normalised_defect(&positions, &net, &pair, 1.0)
                .unwrap()
                .abs()
                < 1e-12
        );
        let gradient = potential_gradient(&positions, &net, &pair);
        assert!(gradient.iter().all(|slope| slope.norm() < 1e-12));
    }
    // Range 2: second neighbours as well, and nothing of this holds.
    let wide = Net::new(&positions, 1.99);
    assert!(!is_planar(&wide) && crossings(&positions, &wide) > 0);
    assert!(!is_realisation(&positions, &wide, 1.0, 0.5));
}

#[test]
fn two_flocks_are_no_flock() {
    let mut positions = lattice(3, 3);
    positions.extend(lattice(2, 3).iter().map(|q| q + Vector::<2>::new(9.0, 0.0)));
    let net = Net::new(&positions, 1.2);
    let parts = net.partition();
    assert_eq!(parts.sizes(), [9, 6]);
    assert_eq!(parts.density(), 0.6);
    assert!(!parts.is_flock() && !parts.is_quasi_flock(0.3) && parts.is_quasi_flock(0.4));
    assert_eq!(Rigidity::new(&positions, &net).freedoms(), 3);
    assert_eq!(algebraic_connectivity(&Adjacency::from(&net)), Some(0.0));
}

#[test]
fn jumps_of_the_laplacian_and_their_smoothing() {
    // (14) to (19): two agents, just outside and just inside the range.
    let at = |x: f64| plane([(0.0, 0.0), (x, 0.0)]);
    assert!(
        neighborhood::uniform(&at(1.01), 1.0)
            .laplacian()
            .iter()
            .all(|l| *l == 0.0)
    );
    let inside = neighborhood::uniform(&at(0.99), 1.0).laplacian();
    assert_eq!(inside.as_slice(), [1.0, -1.0, -1.0, 1.0]);
    let bump = volary::math::Bump::new(0.6);
    let smooth = neighborhood::smooth(&at(0.8), 1.0, &bump).laplacian();
    for (found, expected) in smooth.iter().zip([0.5, -0.5, -0.5, 0.5]) {
        close(*found, expected);
    }
}

//! Neighbourhoods: who sees whom, from positions and headings.
//!
//! | function | who sees whom | weight | source |
//! |---|---|---|---|
//! | [`shells`] | j within i's own radius | 1 | (1) to (3) |
//! | [`uniform`] | j within the common range | 1 | (8) |
//! | [`smooth`] | j within the common range | ρ(distance/r) | (17) |
//! | [`cones`] | j within i's radius, headings within i's angle | 1 | (4) |
//! | [`conic`] | j within the range, headings within the angle | 1 | (5) |
//! | [`smooth_conic`] | the same | ρ(distance/r) ρ(angle/φ0) | (18) |
//! | [`attitude_cones`] | j within i's radius, attitudes within i's bound | 1 | (6) |
//! | [`field_of_view`] | j within the range and in front of i | 1 | text before (4) |
//!
//! Numbers are those of R. Olfati-Saber, "Flocking with Obstacle Avoidance", 2003. The
//! paper calls uniform conic nets directed; as its (5) compares headings with each other,
//! they are not. What is directed is a field of view: where j is, seen from i.
//!
//! Positions, ranges and radii are finite. A negative or undefined radius sees nobody. An
//! agent whose heading is zero has none: it is in nobody's cone, and sees nobody.

use crate::math::{Bump, Matrix, Vector, direction};
use crate::net::Adjacency;
use crate::sense::Cells;

/// Each agent sees the others within its own radius: (1) to (3). Directed where radii
/// differ.
pub fn shells<const D: usize>(positions: &[Vector<D>], radii: &[f64]) -> Adjacency {
    build(positions, |i| radii[i], |_, _, _, _| 1.0)
}

/// The uniform net: all radii are `range`, (8).
pub fn uniform<const D: usize>(positions: &[Vector<D>], range: f64) -> Adjacency {
    build(positions, |_| range, |_, _, _, _| 1.0)
}

/// The smooth uniform net: a_ij = ρ(|q_j − q_i|/r), (17).
pub fn smooth<const D: usize>(positions: &[Vector<D>], range: f64, bump: &Bump) -> Adjacency {
    let weight = |_, _, _: &_, distance: f64| bump.value(distance / range);
    build(positions, |_| range, weight)
}

/// Each agent sees the others within its own radius whose headings are within its own
/// angle (radians) of its own: (4). Headings may have any length.
pub fn cones<const D: usize>(
    positions: &[Vector<D>],
    headings: &[Vector<D>],
    radii: &[f64],
    angles: &[f64],
) -> Adjacency {
    let headings = unit(headings);
    let weight = |i: usize, j: usize, _: &_, _| {
        let within = angle(&headings[i], &headings[j]).is_some_and(|angle| angle <= angles[i]);
        f64::from(u8::from(within))
    };
    build(positions, |i| radii[i], weight)
}

/// The uniform net with conic shells: headings within `limit` (radians) of each other,
/// (5). In the plane |θ_j − θ_i| is taken on the circle, from 0 to π; in any dimension it
/// is the angle between the headings.
pub fn conic<const D: usize>(
    positions: &[Vector<D>],
    headings: &[Vector<D>],
    range: f64,
    limit: f64,
) -> Adjacency {
    let alike = |value: f64| vec![value; positions.len()];
    cones(positions, headings, &alike(range), &alike(limit))
}

/// The smooth net with conic shells: a_ij = ρ(|x_j − x_i|/r) ρ(|θ_j − θ_i|/φ0), (18).
pub fn smooth_conic<const D: usize>(
    positions: &[Vector<D>],
    headings: &[Vector<D>],
    range: f64,
    limit: f64,
    bump: &Bump,
) -> Adjacency {
    let headings = unit(headings);
    let weight = |i: usize, j: usize, _: &_, distance: f64| {
        angle(&headings[i], &headings[j]).map_or(0.0, |angle| {
            bump.value(distance / range) * bump.value(angle / limit)
        })
    };
    build(positions, |_| range, weight)
}

/// Each agent sees the others within its own radius whose attitude R is within its own
/// bound of its own: φ(R, R_i) = ½ tr(I − RᵀR_i) ≤ φ_i, Remark 1, (6). In two and three
/// dimensions φ is 1 − cos of the angle that turns one attitude into the other, from 0
/// to 2.
pub fn attitude_cones<const D: usize>(
    positions: &[Vector<D>],
    attitudes: &[Matrix<D>],
    radii: &[f64],
    bounds: &[f64],
) -> Adjacency {
    let weight = |i: usize, j: usize, _: &_, _| {
        // The trace of RᵀR_i is the sum of the products of their entries.
        let apart = 0.5 * (D as f64 - attitudes[j].dot(&attitudes[i]));
        f64::from(u8::from(apart <= bounds[i]))
    };
    build(positions, |i| radii[i], weight)
}

/// Each agent sees the others within the range that are at most `half_angle` (radians) off
/// its heading: what the text before (4) describes. Directed. Agents at the same point
/// see each other whatever their headings.
pub fn field_of_view<const D: usize>(
    positions: &[Vector<D>],
    headings: &[Vector<D>],
    range: f64,
    half_angle: f64,
) -> Adjacency {
    let headings = unit(headings);
    let weight = |i: usize, _, offset: &Vector<D>, distance: f64| {
        let seen = headings[i] != Vector::<D>::zeros()
            && (distance == 0.0
                || angle(&headings[i], &direction(offset)).is_some_and(|a| a <= half_angle));
        f64::from(u8::from(seen))
    };
    build(positions, |_| range, weight)
}

/// The net with a_ij = weight(i, j, q_j − q_i, |q_j − q_i|) within each agent's reach.
fn build<const D: usize>(
    positions: &[Vector<D>],
    reach: impl Fn(usize) -> f64,
    weight: impl Fn(usize, usize, &Vector<D>, f64) -> f64,
) -> Adjacency {
    let widest = (0..positions.len()).map(&reach).fold(0.0, f64::max);
    let mut cells = Cells::default();
    cells.rebuild(positions, if widest > 0.0 { widest } else { 1.0 });
    let row = |i: usize| {
        let mut row = Vec::new();
        if reach(i) >= 0.0 {
            cells.for_each_within(&positions[i], reach(i), |place, offset, squared| {
                let j = cells.order()[place] as usize;
                if j != i {
                    row.push((j, weight(i, j, &offset, squared.sqrt())));
                }
            });
        }
        row
    };
    Adjacency::new((0..positions.len()).map(row).collect())
}

fn unit<const D: usize>(headings: &[Vector<D>]) -> Vec<Vector<D>> {
    headings.iter().map(direction).collect()
}

/// The angle between two unit vectors, 0 to π; `None` where one of them is zero.
fn angle<const D: usize>(a: &Vector<D>, b: &Vector<D>) -> Option<f64> {
    // Kahan's form: exact for small angles and near π, where the arc cosine is not.
    let defined = *a != Vector::<D>::zeros() && *b != Vector::<D>::zeros();
    defined.then(|| 2.0 * (a - b).norm().atan2((a + b).norm()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    fn v(x: f64, y: f64) -> Vector<2> {
        Vector::<2>::new(x, y)
    }

    #[test]
    fn unequal_radii_make_a_directed_net() {
        let net = shells(&[v(0.0, 0.0), v(2.0, 0.0)], &[3.0, 1.0]);
        assert_eq!((net.weight(0, 1), net.weight(1, 0)), (1.0, 0.0));
        let blind = shells(&[v(0.0, 0.0), v(0.0, 0.0)], &[-1.0, 0.0]);
        assert_eq!((blind.weight(0, 1), blind.weight(1, 0)), (0.0, 1.0));
    }

    #[test]
    fn headings_are_compared_on_the_circle() {
        let at = [v(0.0, 0.0), v(1.0, 0.0), v(0.0, 1.0), v(1.0, 1.0)];
        // Just below and just above the seam at π; across; and none.
        let headings = [v(-1.0, -0.1), v(-2.0, 0.2), v(1.0, 0.0), v(0.0, 0.0)];
        let net = conic(&at, &headings, 2.0, 0.3);
        assert_eq!(net.row(0), [(1, 1.0)]);
        assert_eq!(net.row(1), [(0, 1.0)]);
        assert_eq!(net.arcs(), 2);
        assert_eq!(conic(&at, &headings, 2.0, PI).arcs(), 6);
    }

    #[test]
    fn who_looks_away_does_not_see() {
        let at = [v(0.0, 0.0), v(1.0, 0.0), v(0.0, 0.0)];
        let ahead = [v(2.0, 0.0), v(1.0, 0.0), v(0.0, 0.0)];
        let net = field_of_view(&at, &ahead, 1.5, FRAC_PI_2);
        assert_eq!(net.row(0), [(1, 1.0), (2, 1.0)]);
        assert!(net.row(1).is_empty() && net.row(2).is_empty());
    }

    #[test]
    fn attitudes_differ_by_one_minus_cosine() {
        let turn = |a: f64| Matrix::<2>::new(a.cos(), -a.sin(), a.sin(), a.cos());
        let (at, attitudes) = ([v(0.0, 0.0), v(1.0, 0.0)], [turn(0.4), turn(1.4)]);
        let bound = 1.0 - 1f64.cos();
        let net = |bound| attitude_cones(&at, &attitudes, &[1.0, 1.0], &[bound, 0.0]);
        assert_eq!(net(bound + 1e-12).arcs(), 1);
        assert_eq!(net(bound - 1e-12).arcs(), 0);
    }

    #[test]
    fn a_smooth_net_fades_with_distance_and_angle() {
        let bump = Bump::new(0.5);
        let at = [v(0.0, 0.0), v(0.75, 0.0)];
        assert!((smooth(&at, 1.0, &bump).weight(0, 1) - 0.5).abs() < 1e-15);
        let headings = [v(1.0, 0.0), v(0.0, 1.0)];
        let net = smooth_conic(&at, &headings, 1.0, FRAC_PI_2 / 0.75, &bump);
        assert!((net.weight(1, 0) - 0.25).abs() < 1e-15);
    }
}

//! How fast agents start.

use crate::math::{Vector, cross, direction, mean};
use crate::world::random::{Purpose, Random};
use crate::world::spec::VelocitySpec;
use crate::world::{vector, vector_or_zero};

/// The velocities of the agents of group `index`, which start at `positions`.
pub(super) fn velocities<const D: usize>(
    index: usize,
    spec: &VelocitySpec,
    positions: &[Vector<D>],
    seed: u64,
) -> Vec<Vector<D>> {
    let count = positions.len();
    let from_center = |center: &Option<Vec<f64>>| -> Vec<Vector<D>> {
        let center = center.as_deref().map_or_else(|| mean(positions), vector);
        positions.iter().map(|position| position - center).collect()
    };
    let mut random = Random::new(seed, Purpose::Velocities(index));
    match spec {
        VelocitySpec::Rest => vec![Vector::zeros(); count],
        VelocitySpec::Common(velocity) => vec![vector(velocity); count],
        VelocitySpec::Explicit(velocities) => velocities.iter().map(|v| vector(v)).collect(),
        VelocitySpec::Uniform(region) => {
            let (min, max) = (vector(&region.min), vector(&region.max));
            (0..count).map(|_| random.in_box(&min, &max)).collect()
        }
        VelocitySpec::Ball(region) => {
            let center = vector_or_zero(&region.center);
            let draw = |_| random.in_ball(&center, region.radius);
            (0..count).map(draw).collect()
        }
        VelocitySpec::Outward(outward) => {
            let ways = from_center(&outward.center).into_iter();
            ways.map(|way| direction(&way) * outward.speed).collect()
        }
        VelocitySpec::Rotating(rotating) => {
            let spin = cross(rotating.rate.turn());
            let ways = from_center(&rotating.center).into_iter();
            ways.map(|way| spin * way).collect()
        }
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    fn drawn<const D: usize>(spec: serde_json::Value, positions: &[[f64; D]]) -> Vec<Vector<D>> {
        let positions: Vec<Vector<D>> = positions.iter().copied().map(Vector::from).collect();
        velocities(0, &serde_json::from_value(spec).unwrap(), &positions, 1)
    }

    #[test]
    fn outward_is_away_from_the_centre_at_one_speed() {
        let places = [[0.0, 0.0], [2.0, 0.0], [1.0, 3.0], [1.0, 1.0]];
        // The mean is (1, 1), where an agent is.
        let found = drawn(json!({ "outward": { "speed": 2 } }), &places);
        assert_eq!(found[2], Vector::<2>::new(0.0, 2.0));
        assert_eq!(found[3], Vector::<2>::zeros());
        assert!((found[0] + Vector::<2>::repeat(2.0_f64.sqrt())).norm() < 1e-15);
        let inward = drawn(
            json!({ "outward": { "speed": -2, "center": [1, 9] } }),
            &places,
        );
        assert_eq!(inward[2], Vector::<2>::new(0.0, 2.0));
    }

    #[test]
    fn rotating_is_a_rigid_rotation() {
        let flat = drawn(
            json!({ "rotating": { "rate": 2, "center": [1, 0] } }),
            &[[4.0, 0.0]],
        );
        assert_eq!(flat, [Vector::<2>::new(0.0, 6.0)]);
        let spec = json!({ "rotating": { "rate": [0, 0, 2], "center": [1, 0, 5] } });
        let solid = drawn(spec, &[[4.0, 0.0, 7.0]]);
        assert_eq!(solid, [Vector::<3>::new(0.0, 6.0, 0.0)]);
    }

    #[test]
    fn a_ball_of_velocities_is_filled_evenly() {
        let spec = json!({ "ball": { "center": [10, 0], "radius": 3 } });
        let found = drawn(spec, &[[0.0, 0.0]; 4000]);
        let far: Vec<f64> = found
            .iter()
            .map(|v| (v - Vector::<2>::new(10.0, 0.0)).norm())
            .collect();
        assert!(far.iter().all(|&far| far <= 3.0));
        // Half of the area lies within 1/√2 of the radius.
        let inner = far
            .iter()
            .filter(|&&far| far < 3.0 / 2.0_f64.sqrt())
            .count();
        assert!((1850..2150).contains(&inner), "{inner}");
    }
}

//! How far agents are off their targets.

use crate::math::{Moment, Vector};

/// The largest distance of an agent from its target, max_i |x_i − y_i|, and the largest
/// difference of their velocities, max_i |v_i − ẏ_i|: Djokam & Rathinam, section 5. `targets`
/// has one entry for each agent; 0 and 0 without agents.
pub fn target_errors<const D: usize>(
    positions: &[Vector<D>],
    velocities: &[Vector<D>],
    targets: &[Moment<D>],
) -> [f64; 2] {
    let largest = |states: &[Vector<D>], target: fn(&Moment<D>) -> &Vector<D>| {
        let errors = states.iter().zip(targets);
        errors
            .map(|(state, moment)| (state - target(moment)).norm())
            .fold(0.0, f64::max)
    };
    [
        largest(positions, |moment| &moment.position),
        largest(velocities, |moment| &moment.velocity),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_farthest_and_the_fastest_off_count() {
        let at = |x, y| Vector::<2>::new(x, y);
        let targets = [Moment::at_rest(at(0.0, 0.0)), Moment::at_rest(at(5.0, 0.0))];
        let positions = [at(3.0, 4.0), at(5.0, 1.0)];
        let velocities = [at(0.0, 0.5), at(0.0, -2.0)];
        let errors = target_errors(&positions, &velocities, &targets);
        assert_eq!(errors, [5.0, 2.0]);
        assert_eq!(target_errors::<2>(&[], &[], &[]), [0.0, 0.0]);
    }
}

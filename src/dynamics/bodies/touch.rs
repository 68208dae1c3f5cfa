//! Touches, put in order and measured.

use crate::dynamics::{Touch, Touched};
use crate::math::Vector;
use crate::shape::Obstacle;

/// Orders touches by who touched what. Those of one agent with several parts of one
/// obstacle become one: the closest, with the impulses of all.
pub(super) fn sort<const D: usize>(touches: &mut Vec<Touch<D>>) {
    touches.sort_by(|a, b| {
        let key = |touch: &Touch<D>| (touch.agent, touch.touched);
        key(a).cmp(&key(b)).then(a.gap.total_cmp(&b.gap))
    });
    touches.dedup_by(|next, kept| {
        let same = (next.agent, next.touched) == (kept.agent, kept.touched);
        if same {
            kept.press += next.press;
        }
        same
    });
}

/// Fills in the speeds along the normal, the obstacles being where they are now.
pub(super) fn set_speeds<const D: usize>(
    touch: &mut Touch<D>,
    velocities: &[Vector<D>],
    obstacles: &[Obstacle<D>],
) {
    let other = match touch.touched {
        Touched::Agent(other) => velocities[other],
        Touched::Obstacle(other) => match obstacles[other].twist() {
            Some(twist) => {
                let velocity = twist.at(&touch.point);
                touch.push_speed = (-velocity.dot(&touch.normal)).max(0.0);
                velocity
            }
            None => Vector::zeros(),
        },
    };
    touch.approach_speed = (velocities[touch.agent] - other).dot(&touch.normal);
}

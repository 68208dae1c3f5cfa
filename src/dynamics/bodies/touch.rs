//! Touches, put in order and measured.

use crate::dynamics::{Touch, Touched};
use crate::math::Vector;
use crate::shape::Obstacle;

/// Orders touches by who touched what. Those of one agent with several parts of one
/// obstacle, or held and struck in one step, become one: the first, with the impulses of all.
pub(super) fn sort<const D: usize>(touches: &mut Vec<Touch<D>>) {
    touches.sort_by(|a, b| {
        let key = |touch: &Touch<D>| (touch.agent, touch.touched);
        let order = key(a).cmp(&key(b)).then(a.time.total_cmp(&b.time));
        order.then(a.gap.total_cmp(&b.gap))
    });
    touches.dedup_by(|next, kept| {
        let same = (next.agent, next.touched) == (kept.agent, kept.touched);
        if same {
            kept.blow += next.blow;
            kept.press += next.press;
            kept.friction += next.friction;
            kept.gap = kept.gap.min(next.gap);
            kept.push_speed = kept.push_speed.max(next.push_speed);
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

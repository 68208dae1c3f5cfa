//! What touches in the engine, and the surfaces that do.

use super::super::D;
use super::super::rapier::geometry::ContactPair;
use super::super::rapier::math::Vector as RapierVector;
use super::super::rapier::prelude::{ColliderHandle, ContactModificationContext, PhysicsHooks};
use super::Rapier;
use crate::dynamics::{Touch, Touched};
use crate::math::Vector;

/// Restitution and friction of each obstacle, where its own count.
pub(super) struct Surfaces {
    pub(super) agents: usize,
    pub(super) own: Vec<(Option<f64>, Option<f64>)>,
}

impl PhysicsHooks for Surfaces {
    fn modify_solver_contacts(&self, context: &mut ContactModificationContext<'_>) {
        let owner = [context.collider1, context.collider2]
            .map(|collider| context.colliders[collider].user_data as usize)
            .into_iter()
            .find_map(|index| index.checked_sub(self.agents));
        let Some((restitution, friction)) = owner.and_then(|index| self.own.get(index)) else {
            return;
        };
        if let Some(contact) = context.rigid_mut() {
            if let Some(restitution) = restitution {
                *contact.restitution = *restitution;
            }
            if let Some(friction) = friction {
                *contact.friction = *friction;
            }
        }
    }
}

impl Rapier {
    /// The contacts of the pass just taken.
    pub(super) fn found(&self) -> impl Iterator<Item = Touch<D>> + '_ {
        let pairs = self.world.narrow_phase.contact_pairs();
        pairs.filter_map(|pair| self.touch(pair))
    }

    /// What a collider belongs to, by its user data: the agents count first, then the
    /// obstacles.
    fn owner(&self, collider: ColliderHandle) -> Touched {
        let index = self.world.colliders[collider].user_data as usize;
        match index.checked_sub(self.bodies.len()) {
            None => Touched::Agent(index),
            Some(obstacle) => Touched::Obstacle(obstacle),
        }
    }

    fn touch(&self, pair: &ContactPair) -> Option<Touch<D>> {
        let mut gap = f64::INFINITY;
        let mut impulse = 0.0;
        let mut normal = RapierVector::ZERO;
        let mut places = [RapierVector::ZERO; 2];
        for manifold in pair.manifolds() {
            for point in &manifold.points {
                impulse += point.data.impulse;
                if point.dist < gap {
                    gap = point.dist;
                    normal = manifold.data.normal;
                    places = [point.local_p1, point.local_p2];
                }
            }
        }
        // The engine calls a pair in contact from a gap of 2% of a length unit on.
        if impulse <= 0.0 && gap > 0.0 {
            return None;
        }
        let (first, second) = (self.owner(pair.collider1), self.owner(pair.collider2));
        let place = |collider: ColliderHandle, k: usize| {
            let collider = &self.world.colliders[collider];
            collider.position().transform_point(places[k])
        };
        let on_first = || (first, -normal, place(pair.collider1, 0));
        let on_second = || (second, normal, place(pair.collider2, 1));
        let (agent, (touched, normal, point)) = match (first, second) {
            (Touched::Agent(a), Touched::Agent(b)) if b < a => (b, on_first()),
            (Touched::Agent(a), _) => (a, on_second()),
            (Touched::Obstacle(_), Touched::Agent(b)) => (b, on_first()),
            (Touched::Obstacle(_), Touched::Obstacle(_)) => return None,
        };
        Some(Touch {
            agent,
            touched,
            time: 0.0,
            gap,
            blow: 0.0,
            press: impulse,
            friction: 0.0,
            approach_speed: 0.0,
            push_speed: 0.0,
            normal: normal.to_array().into(),
            point: point.to_array().into(),
            position: Vector::zeros(),
        })
    }
}

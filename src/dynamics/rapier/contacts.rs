//! What touches in the engine, and the surfaces that do.

use super::super::D;
use super::super::rapier::geometry::ContactPair;
use super::super::rapier::math::Vector as RapierVector;
use super::super::rapier::prelude::{
    Collider, ColliderHandle, ContactModificationContext, PairFilterContext, PhysicsHooks,
    SolverFlags,
};
use super::Rapier;
use crate::dynamics::contact::{Other, Pair};
use crate::dynamics::{Touch, Touched};
use crate::math::Vector;

/// What the engine is told about pairs.
pub(super) struct Surfaces {
    pub(super) agents: usize,
    /// Friction of each obstacle, where its own counts.
    pub(super) friction: Vec<Option<f64>>,
    /// The pairs that are held together in this step, in their order.
    pub(super) lasting: Vec<Pair>,
}

impl Surfaces {
    /// The pair of two colliders, of which one is an agent's.
    fn pair(&self, colliders: [&Collider; 2]) -> Option<Pair> {
        let agents = self.agents as u64;
        let of =
            |collider: &Collider| (collider.user_data as u64, (collider.user_data >> 64) as u32);
        let mut both = colliders.map(of);
        both.sort_unstable_by_key(|it| it.0);
        let [(one, _), (other, part)] = both;
        let other = match other.checked_sub(agents) {
            None => Other::Agent(other as u32),
            Some(obstacle) => Other::Part(obstacle as u32, part),
        };
        let agent = one as u32;
        (one < agents).then_some(Pair { agent, other })
    }
}

impl PhysicsHooks for Surfaces {
    fn filter_contact_pair(&self, context: &PairFilterContext<'_>) -> Option<SolverFlags> {
        let colliders = [context.collider1, context.collider2];
        let pair = self.pair(colliders.map(|it| &context.colliders[it]))?;
        let held = self.lasting.binary_search(&pair).is_ok();
        held.then(SolverFlags::default)
    }

    fn modify_solver_contacts(&self, context: &mut ContactModificationContext<'_>) {
        let colliders = [context.collider1, context.collider2];
        let Some(pair) = self.pair(colliders.map(|it| &context.colliders[it])) else {
            return;
        };
        if let Other::Part(obstacle, _) = pair.other
            && let Some(friction) = self.friction[obstacle as usize]
            && let Some(contact) = context.rigid_mut()
        {
            *contact.friction = friction;
        }
    }
}

impl Rapier {
    /// The contacts of the step just taken.
    pub(super) fn found(&self) -> impl Iterator<Item = Touch<D>> + '_ {
        let pairs = self.world.narrow_phase.contact_pairs();
        pairs.filter_map(|pair| self.touch(pair))
    }

    /// What a collider belongs to, by its user data: the agents count first, then the
    /// obstacles.
    fn owner(&self, collider: ColliderHandle) -> Touched {
        let index = self.world.colliders[collider].user_data as u64 as usize;
        match index.checked_sub(self.bodies.len()) {
            None => Touched::Agent(index),
            Some(obstacle) => Touched::Obstacle(obstacle),
        }
    }

    fn touch(&self, pair: &ContactPair) -> Option<Touch<D>> {
        let mut gap = f64::INFINITY;
        let (mut impulse, mut friction) = (0.0, 0.0);
        let mut normal = RapierVector::ZERO;
        let mut places = [RapierVector::ZERO; 2];
        for manifold in pair.manifolds() {
            for point in &manifold.points {
                impulse += point.data.impulse;
                friction += point.data.tangent_impulse.norm();
                if point.dist < gap {
                    gap = point.dist;
                    normal = manifold.data.normal;
                    places = [point.local_p1, point.local_p2];
                }
            }
        }
        // The engine also finds what is merely near.
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
            gap: self.units.distance(gap),
            blow: 0.0,
            press: self.units.impulse(impulse),
            friction: self.units.impulse(friction),
            approach_speed: 0.0,
            push_speed: 0.0,
            normal: normal.to_array().into(),
            point: self.units.read(point),
            position: Vector::zeros(),
        })
    }
}

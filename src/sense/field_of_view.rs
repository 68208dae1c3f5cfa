//! Fields of view and cones of headings.

use crate::math::{Bump, Vector, angle_between, direction};
use crate::world::spec::ConeSpec;

/// Whether a field of view of half the width `angle` about `heading` holds what lies at
/// `offset`: Olfati-Saber (2003), §2. Where there is no way, it does.
pub fn in_view<const D: usize>(heading: &Vector<D>, offset: &Vector<D>, angle: f64) -> bool {
    angle_between(heading, &direction(offset)) <= angle
}

/// The conic neighbourhood of Olfati-Saber (2003), (4), (5) and (18): a condition on the
/// angle between two headings.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cone {
    angle: f64,
    bump: Option<Bump>,
}

impl Cone {
    /// The cone of a world file.
    pub fn new(spec: &ConeSpec) -> Self {
        Self {
            angle: spec.angle,
            bump: spec.smooth.then(|| Bump::new(spec.bump_start)),
        }
    }

    /// The weight that agents with these headings have for each other: ρ(|θ_j − θ_i|/φ0),
    /// or 1, within the cone; nothing outside.
    pub fn weight<const D: usize>(&self, heading: &Vector<D>, other: &Vector<D>) -> Option<f64> {
        let angle = angle_between(heading, other);
        let weight = |bump: Bump| bump.value(angle / self.angle);
        (angle <= self.angle).then(|| self.bump.map_or(1.0, weight))
    }
}

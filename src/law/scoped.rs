//! A law for some groups only.

use crate::law::{Law, Link, Pull};
use crate::math::{Vector, mean};
use crate::sense::Scene;
use crate::world::spec::{GroupSpec, ScopeSpec, acting_on, seen_by};

/// A law that acts on the agents of some groups only, or sees only some groups as
/// neighbours. The means that it sees are those of the agents that it acts on.
///
/// It is called `law(agents<-neighbours)`, with the groups' names joined by `+` and `*` for
/// all of them: `alpha_interaction(sheep<-dog)`, `navigation(dog+fox<-*)`.
pub struct Scoped<const D: usize> {
    law: Box<dyn Law<D>>,
    name: String,
    /// For each group, whether the law acts on it.
    acts_on: Vec<bool>,
    /// For each group, whether the law sees it; absent where it sees all.
    sees: Option<Vec<bool>>,
    /// Of positions and velocities.
    means: [Vector<D>; 2],
}

impl<const D: usize> Scoped<D> {
    /// A law in a checked scope, in a world with these groups.
    pub fn new(law: Box<dyn Law<D>>, scope: &ScopeSpec, groups: &[GroupSpec]) -> Self {
        let names = |names: &Option<Vec<String>>| match names {
            Some(names) => names.join("+"),
            None => "*".to_owned(),
        };
        let (agents, neighbours) = (names(&scope.agents), names(&scope.neighbours));
        let sees = seen_by(Some(scope), groups);
        Self {
            name: format!("{}({agents}<-{neighbours})", law.name()),
            acts_on: acting_on(Some(scope), groups),
            sees: sees.contains(&false).then_some(sees),
            law,
            means: [Vector::zeros(); 2],
        }
    }

    fn acts_on(&self, group: u32) -> bool {
        self.acts_on[group as usize]
    }

    /// The mean over the agents that the law acts on, summed in the order of the world.
    fn mean(&self, scene: &Scene<'_, D>, values: &[Vector<D>]) -> Vector<D> {
        let value = |place: usize| self.acts_on(scene.groups[place]).then_some(values[place]);
        mean(&scene.in_world_order(value).flatten().collect::<Vec<_>>())
    }
}

impl<const D: usize> Law<D> for Scoped<D> {
    fn name(&self) -> &str {
        &self.name
    }

    fn range(&self) -> f64 {
        self.law.range()
    }

    fn jump(&self) -> Option<f64> {
        self.law.jump()
    }

    fn prepare(&mut self, scene: &Scene<'_, D>) {
        let means = [scene.positions, scene.velocities].map(|values| self.mean(scene, values));
        self.means = means;
        let scene = narrowed(scene, means, self.sees.as_deref());
        self.law.prepare(&scene);
    }

    fn pull(&self, scene: &Scene<'_, D>, i: usize, links: &mut Vec<Link<D>>) -> Option<Pull> {
        let scene = narrowed(scene, self.means, self.sees.as_deref());
        self.acts_on(scene.groups[i])
            .then(|| self.law.pull(&scene, i, links))
            .flatten()
    }

    fn relaxes(&self) -> bool {
        self.law.relaxes()
    }

    fn stiffness(&self) -> f64 {
        self.law.stiffness()
    }

    fn blocked(&self, scene: &Scene<'_, D>, i: usize, visit: &mut dyn FnMut(usize)) {
        if self.acts_on(scene.groups[i]) {
            let scene = narrowed(scene, self.means, self.sees.as_deref());
            self.law.blocked(&scene, i, visit);
        }
    }

    fn accelerate(&self, scene: &Scene<'_, D>, first: usize, out: &mut [Vector<D>]) {
        let scene = narrowed(scene, self.means, self.sees.as_deref());
        let mut begin = 0;
        let groups = &scene.groups[first..first + out.len()];
        // Agents of one scope often stand together: the law takes each run in one call.
        for run in groups.chunk_by(|a, b| self.acts_on(*a) == self.acts_on(*b)) {
            let end = begin + run.len();
            if self.acts_on(run[0]) {
                self.law
                    .accelerate(&scene, first + begin, &mut out[begin..end]);
            }
            begin = end;
        }
    }
}

/// A scene as a law in a scope sees it.
fn narrowed<'a, const D: usize>(
    scene: &Scene<'a, D>,
    [mean_position, mean_velocity]: [Vector<D>; 2],
    visible: Option<&'a [bool]>,
) -> Scene<'a, D> {
    Scene {
        mean_position,
        mean_velocity,
        visible,
        ..*scene
    }
}

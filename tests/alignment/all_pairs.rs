//! Sums over all pairs at once against the same influences one by one.

use rayon::ThreadPoolBuilder;
use serde_json::{Value, json};
use volary::law::{Alignment, Flock, Law, Scoped};
use volary::math::Vector;
use volary::shape::{Geometry, In};
use volary::world::World;
use volary::world::spec::{LawSpec, ScopeSpec};

use crate::common::{from_json, headings, state};
use crate::scene::{Dice, law, world};

/// The law of a world as it is, and with its kernel as a function of one's own, of which
/// nothing is known.
fn both<const D: usize>(world: &World<D>, scope: Option<&ScopeSpec>) -> [Box<dyn Law<D>>; 2] {
    let LawSpec::Alignment(spec) = &world.spec.laws[0] else {
        panic!("the world has another law");
    };
    let kernel = spec.kernel.influence();
    let known = Alignment::new(spec, scope, world);
    let own = known
        .clone()
        .with_kernel(move |squared| kernel.value(squared));
    [known, own].map(|law| -> Box<dyn Law<D>> {
        match scope {
            Some(scope) => Box::new(Scoped::new(Box::new(law), scope, &world.spec.agents)),
            None => Box::new(law),
        }
    })
}

fn compare<const D: usize>(law_of_file: Value, scope: Option<&ScopeSpec>)
where
    In<D>: Geometry<D>,
{
    const COUNT: usize = 300;
    let world = world::<D>(&[1.5; COUNT], law_of_file, json!({}));
    let mut dice = Dice(3);
    let x = dice.vectors::<D>(COUNT, -9.0, 9.0);
    let mut v = dice.vectors::<D>(COUNT, -0.5, 0.5);
    // A large common velocity must cost no digits of the differences.
    v.iter_mut().for_each(|v| v[0] += 1e4);
    let headings = headings(&v);
    let state = state(&world, 0.5, &x, &v, &headings);
    let [found, right] = both(&world, scope).map(|law| {
        let mut out = vec![Vector::zeros(); COUNT];
        Flock::new(vec![law]).accelerations(&state, &mut out);
        out
    });
    let largest = right.iter().map(|it| it.norm()).fold(0.0, f64::max);
    assert!(largest > 1e-3, "nothing moves");
    for (found, right) in found.iter().zip(&right) {
        assert!((found - right).norm() <= 1e-14 * largest, "{found} {right}");
    }
}

#[test]
fn sums_at_once_are_those_one_by_one() {
    let scope: ScopeSpec = from_json(json!({ "agents": ["flock"], "laws": [] }));
    for kernel in [
        json!({ "constant": { "strength": 2 } }),
        json!({ "cucker_smale": { "strength": 2, "length": 0.7, "exponent": 0.5 } }),
        json!({ "cucker_smale": { "strength": 2, "length": 0.7, "exponent": 0.3 } }),
        json!({ "exponential": { "strength": 2, "length": 1.5 } }),
    ] {
        for normalisation in ["none", "mean_field", "motsch_tadmor"] {
            for own in [false, true] {
                let law = json!({
                    "kernel": kernel, "normalisation": normalisation, "self_influence": own,
                    "gain": { "bounded": { "bound": 2, "scale": 0.3 } }
                });
                compare::<2>(law.clone(), None);
                compare::<3>(law, Some(&scope));
            }
        }
    }
}

#[test]
fn accelerations_of_all_pairs_do_not_depend_on_the_number_of_threads() {
    const COUNT: usize = 1_500;
    let kernel = json!({ "cucker_smale": { "exponent": 0.5 } });
    let alignment = json!({ "kernel": kernel, "normalisation": "motsch_tadmor" });
    let world = world::<2>(&[1.0; COUNT], alignment, json!({}));
    let mut dice = Dice(5);
    let x = dice.vectors::<2>(COUNT, -9.0, 9.0);
    let v = dice.vectors::<2>(COUNT, -1.0, 1.0);
    let headings = headings(&v);
    let state = state(&world, 0.5, &x, &v, &headings);
    let by_threads = [1, 2, 3, 4].map(|threads| {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build();
        let mut out = vec![Vector::zeros(); COUNT];
        let mut flock = Flock::new(vec![law(&world)]);
        pool.expect("threads can be made")
            .install(|| flock.accelerations(&state, &mut out));
        out.iter()
            .flat_map(|a| [a[0].to_bits(), a[1].to_bits()])
            .collect::<Vec<_>>()
    });
    assert!(by_threads.iter().all(|bits| *bits == by_threads[0]));
}

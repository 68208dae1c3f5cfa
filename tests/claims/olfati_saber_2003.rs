//! The claims of Olfati-Saber (2003).

use crate::runs::{bodies, doctored, holds, plane, points, shipped, unmet, violated};
use volary::claim::{Run, claims};
use volary::math::Vector;
use volary::world::AnyWorld;

const SHORT: &[&str] = &["time.end=10"];
const WEIGHTED: &str = "laws[0].alpha_interaction.protocol=smooth_weighted_damping";

#[test]
fn uniform_nets_are_balanced_and_keep_the_mean_heading() {
    let world = plane("olfati-saber-2003/attitude-alignment", &[]);
    let run = points(&world);
    holds("olfati-saber-2003/uniform-nets-are-balanced", &run);
    holds("olfati-saber-2003/mean-heading", &run);
    holds("olfati-saber-2003/mean-heading", &bodies(&world));
    let turned = doctored(&world, |k, (_, _, v)| {
        if k == 30 {
            v[2] = Vector::<2>::new(-v[2][1], v[2][0]);
        }
    });
    let finding = violated("olfati-saber-2003/mean-heading", &turned);
    assert_eq!(finding.closest, Some(6.0));
    let radii = "agents[0].sensing={\"radius\":[1,2,3,4,5,5,4,3,2,1]}";
    let uneven = plane(
        "olfati-saber-2003/attitude-alignment",
        &["time.end=1", radii],
    );
    let uneven = points(&uneven);
    unmet("olfati-saber-2003/uniform-nets-are-balanced", &uneven);
    unmet("olfati-saber-2003/mean-heading", &uneven);
}

#[test]
fn smooth_energy_falls_and_a_flock_comes_to_agree() {
    let world = plane("olfati-saber-2003/smooth-flock", &["time.end=60"]);
    let run = points(&world);
    holds("olfati-saber-2003/smooth-dissipation", &run);
    holds("olfati-saber-2003/smooth-flocking", &run);
    unmet("olfati-saber-2003/weighted-dissipation", &run);
    unmet("olfati-saber-2003/nonsmooth-dissipation", &run);
    let kicked = doctored(&world, |k, (_, _, v)| {
        if k == 40 {
            v[0] *= 10.0;
        }
    });
    let finding = violated("olfati-saber-2003/smooth-dissipation", &kicked);
    assert_eq!(finding.closest, Some(20.0));
    let apart = |_: usize, (_, _, v): &mut crate::runs::Seen<2>| v[0][0] = 7.0;
    violated(
        "olfati-saber-2003/smooth-flocking",
        &doctored(&world, apart),
    );

    let world = plane("olfati-saber-2003/smooth-flock", &["time.end=60", WEIGHTED]);
    let run = points(&world);
    holds("olfati-saber-2003/weighted-dissipation", &run);
    holds("olfati-saber-2003/weighted-flocking", &run);
    let torn = doctored(&world, apart);
    violated("olfati-saber-2003/weighted-flocking", &torn);
    let kicked = doctored(&world, |k, (_, _, v)| {
        if k == 40 {
            v[0] *= 10.0;
        }
    });
    violated("olfati-saber-2003/weighted-dissipation", &kicked);
}

#[test]
fn nonsmooth_energy_falls_but_where_links_are_made() {
    let world = plane("olfati-saber-2003/links-add-energy", &[]);
    let run = points(&world);
    holds("olfati-saber-2003/nonsmooth-dissipation", &run);
    let finding = violated("olfati-saber-2003/switching-energies-printed", &run);
    assert!(
        finding.closest.is_some_and(|time| time > 0.5),
        "{finding:?}"
    );
    holds("olfati-saber-2003/nonsmooth-flocking", &run);
    let apart = doctored(&world, |_, (_, _, v)| v[0][1] = 3.0);
    violated("olfati-saber-2003/nonsmooth-flocking", &apart);
    let kicked = doctored(&world, |k, (_, _, v)| {
        if k == 100 {
            v[0][1] = 5.0;
        }
    });
    violated("olfati-saber-2003/nonsmooth-dissipation", &kicked);
    // Links that are lost take energy with them.
    let set = [
        "agents[0].positions.explicit=[[-4.1,0],[4.1,0]]",
        "agents[0].velocities.explicit=[[-3,0],[3,0]]",
        "time.end=4",
    ];
    let parting = plane("olfati-saber-2003/links-add-energy", &set);
    let parting = points(&parting);
    holds("olfati-saber-2003/switching-energies-printed", &parting);
    holds("olfati-saber-2003/nonsmooth-dissipation", &parting);
    unmet("olfati-saber-2003/nonsmooth-flocking", &parting);
}

#[test]
fn zero_energy_is_rest_in_a_lattice_and_the_other_way_round() {
    let world = plane("olfati-saber-2003/zero-energy", &[]);
    let run = points(&world);
    holds("olfati-saber-2003/zero-potential", &run);
    holds("olfati-saber-2003/zero-relative-motion", &run);
    holds("olfati-saber-2003/constant-distances", &run);
    holds("olfati-saber-2003/zero-energy", &run);
    let bodies = bodies(&world);
    holds("olfati-saber-2003/zero-energy", &bodies);
    holds("olfati-saber-2003/zero-relative-motion", &bodies);

    // Nobody's neighbour flies off without a velocity.
    let far = "agents[0].positions={\"line\":{\"from\":[0,0],\"to\":[110,0]}}";
    let far = plane("olfati-saber-2003/zero-energy", &[far]);
    let off = doctored(&far, |k, (_, x, _)| x[0][1] = 0.1 * k as f64);
    violated("olfati-saber-2003/zero-relative-motion", &off);
    violated("olfati-saber-2003/zero-energy", &off);
    // Velocities that differ, at places that do not.
    let still = doctored(&world, |_, (_, _, v)| {
        v[0] = Vector::<2>::new(2.0, 3.1);
    });
    violated("olfati-saber-2003/constant-distances", &still);
    let loose = plane("olfati-saber-2003/smooth-flock", SHORT);
    let loose = points(&loose);
    unmet("olfati-saber-2003/zero-potential", &loose);
    unmet("olfati-saber-2003/constant-distances", &loose);
}

#[test]
fn the_approximation_error_needs_the_nonsmooth_potential() {
    let world = plane("olfati-saber-2003/smooth-flock", SHORT);
    let run = points(&world);
    holds("olfati-saber-2003/approximation-error-corrected", &run);
    holds("olfati-saber-2003/locality", &run);
    let mut pushed = run.clone();
    pushed.observations[7].by_law[0][3][0] += 0.01;
    let finding = violated("olfati-saber-2003/locality", &pushed);
    assert_eq!(finding.closest, Some(3.5));

    // Near the range all that is left of the smooth potential is its slope.
    let set = |protocol: &'static str| {
        [
            "agents[0].positions.explicit=[[-4.15,0],[4.15,0]]",
            "agents[0].velocities.explicit=[[0,0],[0,0]]",
            "time.end=1",
            protocol,
        ]
    };
    let smooth = set("laws[0].alpha_interaction.protocol=smooth");
    let stretched = plane("olfati-saber-2003/links-add-energy", &smooth);
    let stretched = points(&stretched);
    violated("olfati-saber-2003/approximation-error-printed", &stretched);
    holds(
        "olfati-saber-2003/approximation-error-corrected",
        &stretched,
    );
    let sharp = set("laws[0].alpha_interaction.protocol=nonsmooth");
    let sharp = plane("olfati-saber-2003/links-add-energy", &sharp);
    let sharp = points(&sharp);
    unmet("olfati-saber-2003/approximation-error-corrected", &sharp);
    unmet("olfati-saber-2003/approximation-error-printed", &sharp);
    // Where no link fades there is no error, and both are right.
    let near = [
        "agents[0].positions.explicit=[[-3,0],[3,0]]",
        "agents[0].velocities.explicit=[[0,0],[0,0]]",
        "time.end=1",
        "laws[0].alpha_interaction.protocol=smooth",
    ];
    let near = plane("olfati-saber-2003/links-add-energy", &near);
    let near = points(&near);
    holds("olfati-saber-2003/approximation-error-printed", &near);
}

#[test]
fn energy_keeps_agents_apart_and_protocols_keep_the_mean() {
    let world = plane("olfati-saber-2003/smooth-flock", SHORT);
    let run = points(&world);
    let finding = holds("olfati-saber-2003/no-contact-sharpened", &run);
    let nearest = finding.quantities.iter().find(|it| it.name == "r");
    let nearest = nearest.and_then(|it| it.value).expect("there is a bound");
    let all = claims::<2>();
    let claim = all
        .iter()
        .find(|it| it.about().name == "olfati-saber-2003/no-contact-sharpened");
    let exclusion = claim.and_then(|it| it.exclusion(&run));
    assert_eq!(exclusion.map(|it| it.distance), Some(nearest));
    assert!(nearest > 3.0 && nearest < 6.5, "{nearest}");
    let near = doctored(&world, |k, (_, x, _)| {
        if k == 9 {
            x[1] = x[0] + Vector::<2>::new(0.99 * nearest, 0.0);
        }
    });
    violated("olfati-saber-2003/no-contact-sharpened", &near);
    let fast = ["time.end=1", "agents[0].velocities.ball.radius=8"];
    let fast = plane("olfati-saber-2003/smooth-flock", &fast);
    unmet("olfati-saber-2003/no-contact-sharpened", &points(&fast));

    holds("olfati-saber-2003/momentum", &run);
    let drifting = doctored(&world, |_, (t, _, v)| {
        v.iter_mut().for_each(|v| v[0] += 0.01 * *t);
    });
    violated("olfati-saber-2003/momentum", &drifting);
}

#[test]
fn structure_and_translation_do_not_mind_each_other() {
    for navigation in [
        "laws[1].navigation.velocity_gain=1",
        "laws[1].navigation={\"steer\":\"mean\",\"velocity\":[2,1],\"velocity_gain\":0.7}",
    ] {
        let world = plane("olfati-saber-2003/separation", &["time.end=20", navigation]);
        let run = points(&world);
        holds("olfati-saber-2003/separation-structural", &run);
        holds("olfati-saber-2003/separation-translational", &run);
        holds("olfati-saber-2003/separation-whole", &run);
        holds("olfati-saber-2003/controller-bounds", &run);
        holds("olfati-saber-2003/no-contact-sharpened", &run);
        let kicked = doctored(&world, |k, (_, _, v)| {
            if k == 30 {
                v[0] *= 100.0;
            }
        });
        violated("olfati-saber-2003/separation-structural", &kicked);
        violated("olfati-saber-2003/separation-translational", &kicked);
        violated("olfati-saber-2003/separation-whole", &kicked);
        let mut pushed = run.clone();
        pushed.observations[4].by_law[1][3] *= 1e3;
        violated("olfati-saber-2003/controller-bounds", &pushed);
        unmet("olfati-saber-2003/smooth-flocking", &run);
    }
    // Steering of each agent for itself pulls at the structure.
    let own = ["time.end=1", "laws[1].navigation.steer=agent"];
    let own = plane("olfati-saber-2003/separation", &own);
    unmet("olfati-saber-2003/separation-structural", &points(&own));
}

#[test]
fn claims_hold_in_space_and_on_bodies() {
    let set = [
        "dimension=3",
        "agents[0].positions={\"hexagonal\":{\"center\":[0,0,0],\"spacing\":6.5}}",
        "agents[0].velocities={\"ball\":{\"radius\":0.5}}",
        "agents[0].mass=[1,2,3,1,2,3,1,2,3,1,2,3]",
        "time.end=20",
    ];
    let AnyWorld::Space(space) = shipped("olfati-saber-2003/smooth-flock", &set) else {
        panic!("the world is in space");
    };
    all_of_proposition_5(&points(&space));
    let world = plane(
        "olfati-saber-2003/smooth-flock",
        &["time.end=20", "agents[0].radius=1"],
    );
    all_of_proposition_5(&bodies(&world));
    let world = plane("olfati-saber-2003/links-add-energy", &[]);
    holds("olfati-saber-2003/nonsmooth-dissipation", &bodies(&world));
    let world = plane("olfati-saber-2003/separation", &["time.end=20"]);
    holds("olfati-saber-2003/separation-whole", &bodies(&world));
}

fn all_of_proposition_5<const D: usize>(run: &Run<'_, D>) {
    for name in [
        "smooth-dissipation",
        "no-contact-sharpened",
        "momentum",
        "locality",
        "approximation-error-corrected",
        "uniform-nets-are-balanced",
    ] {
        holds(&format!("olfati-saber-2003/{name}"), run);
    }
}

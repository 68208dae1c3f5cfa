//! Fast sums against direct ones.

use proptest::array::uniform2;
use proptest::collection::vec;
use proptest::prelude::{ProptestConfig, prop_assert, proptest};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

use super::grade::of_pair;
use super::{FastSums, Kernel};
use crate::math::{Influence, Potential, Radial, Vector, WithRadial, mean};
use crate::sum::{Cloud, Point, Sums, mutual};

/// How agents lie.
#[derive(Debug, Clone, Copy)]
enum Layout {
    /// Evenly in a box of this side.
    Box(f64),
    /// In two tight clusters far from each other.
    Clusters,
    /// Along a thin curve.
    Filament,
    /// Ever denser towards the middle.
    Dense,
    /// A flock of side 50, and some that are up to a million away.
    Strays,
    /// A tight flock, and one agent at some distance that sees it all under one angle.
    Apart,
    /// All at the same few points.
    Points,
    /// All on a straight line along no axis.
    Line,
}

const LAYOUTS: [Layout; 9] = [
    Layout::Line,
    Layout::Box(40.0),
    Layout::Box(2.0),
    Layout::Clusters,
    Layout::Filament,
    Layout::Dense,
    Layout::Strays,
    Layout::Apart,
    Layout::Points,
];

/// Uniform numbers from 0 to 1.
fn draws(seed: u64) -> impl FnMut() -> f64 {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    move || (random.next_u64() >> 11) as f64 * 0.5f64.powi(53)
}

/// Positions, and velocities about a common one that is far greater than their differences.
fn flock<const D: usize>(layout: Layout, count: usize) -> [Vec<Vector<D>>; 2] {
    let mut draw = draws(7);
    let mut any = || Vector::<D>::from_fn(|_, _| draw());
    let positions = (0..count).map(|agent| match (layout, any()) {
        (Layout::Box(side), place) => place * side,
        (Layout::Clusters, place) => place + Vector::repeat(1e3 * (agent % 2) as f64),
        (Layout::Filament, place) => {
            let turn = 9.0 * place[0];
            Vector::from_fn(|axis, _| match axis {
                0 => 100.0 * place[0],
                _ => 20.0 * libm::sin(turn + axis as f64) + 0.1 * place[axis],
            })
        }
        (Layout::Dense, place) => (place - Vector::repeat(0.5)) * (100.0 * place[0].powi(4)),
        (Layout::Strays, place) if agent % 300 == 0 => {
            (place - Vector::repeat(0.5)) * (1e4 * (1 + agent / 300 * 20) as f64)
        }
        (Layout::Strays, place) => place * 50.0,
        (Layout::Apart, _) if agent == 0 => Vector::repeat(31.0),
        (Layout::Apart, place) => place * 0.1,
        (Layout::Line, place) => Vector::from_fn(|axis, _| place[0] * (50.0 - 20.0 * axis as f64)),
        (Layout::Points, place) => place.map(|x| (x * 3.0).floor() * 5.0),
    });
    let positions = positions.collect();
    let common = Vector::repeat(1e4);
    let velocities = (0..count).map(|_| common + any()).collect();
    [positions, velocities]
}

struct Direct<'a, const D: usize>(&'a Cloud<D>);

impl<const D: usize> WithRadial for Direct<'_, D> {
    type Output = Vec<Sums<D>>;

    fn with<K: Radial>(self, radial: K) -> Vec<Sums<D>> {
        let mut sums = Vec::new();
        mutual(radial, self.0, &mut sums);
        sums
    }
}

fn direct<const D: usize>(kernel: &Kernel, points: [&[Vector<D>]; 2]) -> Vec<Sums<D>> {
    let mut cloud = Cloud::default();
    cloud.refill(points[0].iter().zip(points[1]).enumerate().map(
        |(number, (&position, &carried))| Point {
            number,
            position,
            carried,
        },
    ));
    kernel.with_radial(Direct(&cloud)).expect("a known kernel")
}

/// Errors of sums, as shares of what they are to be measured by: those of drives or those of
/// weights, whichever are more.
#[derive(Debug, Clone, Copy)]
struct Errors {
    /// In root mean square over the agents.
    rms: f64,
    worst: f64,
}

impl Errors {
    /// Whether they are as promised where an error was asked for.
    fn are_within(self, error: f64) -> bool {
        self.rms <= error && self.worst <= of_pair(error)
    }
}

fn errors<const D: usize>(kernel: &Kernel, error: f64, layout: Layout, count: usize) -> Errors {
    let [positions, velocities] = flock::<D>(layout, count);
    let carried = match kernel.along() {
        true => &positions,
        false => &velocities,
    };
    errors_of(kernel, error, &positions, carried)
}

/// The same of given agents.
fn errors_of<const D: usize>(
    kernel: &Kernel,
    error: f64,
    positions: &[Vector<D>],
    carried: &[Vector<D>],
) -> Errors {
    let count = positions.len();
    let exact = direct(kernel, [positions, carried]);
    let mut fast = FastSums::new(kernel.clone(), error).expect("a smooth kernel");
    let mut sums = Vec::new();
    assert!(fast.run(positions, carried, &mut sums), "it can be had");
    let middle = mean(carried);
    let spread = |i: usize| match kernel.along() {
        true => 0.0,
        false => (carried[i] - middle).norm(),
    };
    let far = (0..count).map(spread).sum::<f64>() / count as f64;
    let (bounded, _) = kernel.parts().expect("a smooth kernel");
    let peak = bounded.as_ref().map_or(0.0, Kernel::peak);
    let floor = peak * if kernel.along() { 1.0 } else { far };
    let (mut worst, mut squares, mut looked_at) = (0.0f64, [0.0; 2], 0.0);
    for i in (0..count).step_by(7) {
        let (mut weight, mut drive) = (peak, floor + peak * spread(i));
        for j in 0..count {
            let squared = (positions[i] - positions[j]).norm_squared();
            let value = kernel.value(squared).abs();
            weight += value;
            drive += match kernel.along() {
                true => value * squared.sqrt(),
                false => value * (spread(i) + spread(j)),
            };
        }
        let of_drive = (sums[i].drive - exact[i].drive).norm() / drive;
        let of_weight = match kernel.along() {
            true => 0.0,
            false => (sums[i].weight - exact[i].weight).abs() / weight,
        };
        looked_at += 1.0;
        for (squares, error) in squares.iter_mut().zip([of_drive, of_weight]) {
            *squares += error * error;
            worst = worst.max(error);
        }
    }
    let rms = (squares[0].max(squares[1]) / looked_at).sqrt();
    Errors { rms, worst }
}

fn cucker_smale(exponent: f64) -> Kernel {
    Kernel::Influence(Influence::CuckerSmale {
        strength: 2.0,
        length: 1.0,
        exponent,
    })
}

fn gaussian() -> Kernel {
    Kernel::Force(Potential::Gaussian {
        height: 3.0,
        decay: 1.5,
    })
}

fn gazi_passino() -> Kernel {
    Kernel::Force(Potential::GaziPassino {
        attraction: 1.0,
        repulsion: 20.0,
        squared_length: 0.2,
    })
}

fn exponential(length: f64) -> Kernel {
    Kernel::Influence(Influence::Exponential {
        strength: 1.0,
        length,
    })
}

fn assert_within<const D: usize>(kernel: &Kernel, error: f64, layout: Layout, count: usize) {
    let found = errors::<D>(kernel, error, layout, count);
    let case = format!("{D}-D, {kernel:?}, {layout:?}, {error}: {found:?}");
    assert!(found.are_within(error), "{case}");
    // It is no direct sum in disguise.
    assert!(found.worst > 1e-16, "{case}");
}

#[test]
fn errors_are_those_asked_for_in_the_plane() {
    for kernel in [
        cucker_smale(0.5),
        cucker_smale(2.0),
        exponential(1.0),
        gaussian(),
    ] {
        for layout in LAYOUTS {
            for error in [1e-3, 1e-6, 1e-9] {
                assert_within::<2>(&kernel, error, layout, 1500);
            }
        }
    }
}

#[test]
fn errors_are_those_asked_for_in_space() {
    for layout in LAYOUTS {
        for error in [1e-3, 1e-6] {
            assert_within::<3>(&cucker_smale(0.5), error, layout, 2000);
        }
    }
    assert_within::<3>(&cucker_smale(0.5), 1e-9, Layout::Box(20.0), 2000);
    assert_within::<3>(&gaussian(), 1e-6, Layout::Box(8.0), 2000);
}

#[test]
fn errors_are_those_asked_for_of_all_kernels() {
    let constant = Kernel::Influence(Influence::Constant(0.3));
    let others = [exponential(30.0), constant, gazi_passino()];
    for kernel in others
        .into_iter()
        .chain([0.1, 0.4, 1.0, 4.0].map(cucker_smale))
    {
        assert_within::<2>(&kernel, 1e-6, Layout::Box(40.0), 1500);
        assert_within::<2>(&kernel, 1e-6, Layout::Apart, 1500);
    }
}

#[test]
fn errors_are_those_asked_for_at_the_ends_of_what_can_be_asked_for() {
    for error in [1e-1, 1e-10] {
        for layout in [Layout::Box(40.0), Layout::Dense] {
            assert_within::<2>(&cucker_smale(0.5), error, layout, 1500);
        }
    }
}

/// All that counts is what two clusters tell each other, each as good as one point of its cell:
/// the kernel hardly falls off, and two strays hold the tree in place.
#[test]
fn errors_are_those_asked_for_of_two_clusters_wherever_they_lie_in_their_cells() {
    let mut draw = draws(3);
    for _ in 0..60 {
        let middles: [Vector<2>; 2] = [(); 2].map(|()| Vector::from_fn(|_, _| 1e3 * draw()));
        let mut positions: Vec<_> = (0..400)
            .map(|agent| middles[agent % 2] + Vector::from_fn(|_, _| 1e-3 * draw()))
            .collect();
        positions.extend([Vector::zeros(), Vector::repeat(1e3)]);
        let carried: Vec<_> = (0..402)
            .map(|agent| Vector::repeat((agent % 2) as f64))
            .collect();
        for exponent in [0.1, 0.5] {
            let found = errors_of(&cucker_smale(exponent), 1e-6, &positions, &carried);
            assert!(found.are_within(1e-6), "{exponent}, {middles:?}: {found:?}");
        }
    }
}

#[test]
fn attraction_in_proportion_to_the_distance_is_exact_but_for_rounding() {
    let attraction = Kernel::Force(Potential::Attraction { stiffness: 0.7 });
    for layout in [Layout::Box(40.0), Layout::Strays, Layout::Points] {
        let found = errors::<3>(&attraction, 1e-6, layout, 1500);
        assert!(found.worst <= 1e-13, "{layout:?}: {found:?}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..ProptestConfig::default() })]

    /// What agents give each other cancels, for kernels are even; and it is what direct sums
    /// say, of any flock.
    #[test]
    fn any_flock_keeps_its_mean(
        places in vec(uniform2(-1.0..1.0f64), 2..200),
        scale in -2.0..3.0f64,
        stretch in -4.0..0.0f64,
        exponent in 0.1..2.0f64,
        error in -9.0..-1.0f64,
    ) {
        let size = [10f64.powf(scale), 10f64.powf(scale + stretch)];
        let positions: Vec<_> = places
            .iter()
            .map(|place| Vector::<2>::from_fn(|axis, _| size[axis] * place[axis]))
            .collect();
        let velocities: Vec<_> = places.iter().rev().map(|&place| place.into()).collect();
        let (kernel, error) = (cucker_smale(exponent), 10f64.powf(error));
        let found = errors_of(&kernel, error, &positions, &velocities);
        prop_assert!(found.are_within(error), "{found:?}");
        let mut sums = Vec::new();
        let mut fast = FastSums::new(kernel.clone(), error).expect("a smooth kernel");
        prop_assert!(fast.run(&positions, &velocities, &mut sums));
        let total: Vector<2> = sums.iter().map(|it| it.drive).sum();
        let size: f64 = sums.iter().map(|it| it.weight + kernel.peak()).sum();
        prop_assert!(total.norm() <= 4.0 * error * size, "{total} of {size}");
    }
}

#[test]
fn bits_do_not_depend_on_threads_nor_on_what_was_summed_before() {
    let [positions, velocities] = flock::<2>(Layout::Dense, 3000);
    let alone = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.expect("threads can be made").install(|| {
            let mut fast = FastSums::new(cucker_smale(0.5), 1e-6).expect("a smooth kernel");
            let mut sums = Vec::new();
            assert!(fast.run(&positions, &velocities, &mut sums));
            sums
        })
    };
    let one = alone(1);
    for threads in 2..5 {
        assert_eq!(one, alone(threads));
    }
    let mut fast = FastSums::new(cucker_smale(0.5), 1e-6).expect("a smooth kernel");
    let mut sums = Vec::new();
    for layout in [Layout::Box(300.0), Layout::Strays, Layout::Points] {
        let [positions, velocities] = flock::<2>(layout, 3000);
        assert!(fast.run(&positions, &velocities, &mut sums));
    }
    assert!(fast.run(&positions, &velocities, &mut sums));
    assert_eq!(one, sums);
}

#[test]
fn order_and_place_matter_to_rounding_only() {
    let [positions, velocities] = flock::<2>(Layout::Box(40.0), 1500);
    let run = |positions: &[Vector<2>], velocities: &[Vector<2>]| {
        let mut fast = FastSums::new(cucker_smale(0.5), 1e-6).expect("a smooth kernel");
        let mut sums = Vec::new();
        assert!(fast.run(positions, velocities, &mut sums));
        sums
    };
    let sums = run(&positions, &velocities);
    let reversed = |vectors: &[Vector<2>]| vectors.iter().rev().copied().collect::<Vec<_>>();
    let mut turned = run(&reversed(&positions), &reversed(&velocities));
    turned.reverse();
    // A power of two, so that places differ by rounding alone.
    let moved: Vec<_> = positions
        .iter()
        .map(|x| x + Vector::repeat(1024.0))
        .collect();
    let moved = run(&moved, &velocities);
    for other in [turned, moved] {
        for (sums, other) in sums.iter().zip(&other) {
            assert!((sums.weight - other.weight).abs() <= 1e-9 * sums.weight);
            assert!((sums.drive - other.drive).norm() <= 1e-9 * sums.weight);
        }
    }
}

#[test]
fn what_cannot_be_summed_fast_is_refused() {
    let refused = [
        Kernel::Influence(Influence::own(|_| 1.0)),
        cucker_smale(9.0),
        Kernel::Force(Potential::Bond {
            stiffness: 1.0,
            length: 1.0,
        }),
    ];
    for kernel in refused {
        assert!(FastSums::<2>::new(kernel, 1e-6).is_none());
    }
    let mut fast = FastSums::<2>::new(cucker_smale(0.5), 1e-6).expect("a smooth kernel");
    // No two places, and places that are no numbers.
    for place in [1.0, f64::NAN] {
        let here = [Vector::repeat(place); 3];
        assert!(!fast.run(&here, &here, &mut Vec::new()));
    }
    assert!(!fast.run(&[], &[], &mut Vec::new()));
}

//! Sums in blocks against a plain double loop.

use crate::math::{Influence, Potential, Radial, Vector, WithRadial};
use crate::sum::{Cloud, Point, Sums, at, mutual};

/// A number within [0, 1) that looks random.
fn mixed(k: usize) -> f64 {
    (k as f64 * 0.618_033_988_749_894_9 + ((k * k) % 1013) as f64 * 0.414_213_562_373) % 1.0
}

/// Points in a box, one of them far away, and some at the same place as others.
fn points<const D: usize>(count: usize) -> Vec<Point<D>> {
    let coordinate = |i: usize, axis: usize| match i {
        3 => 1e12,
        // Pairs in the same block, and in different ones.
        5 | 6 | 299 => 4.0,
        _ => 9.0 * mixed(7 * i + axis),
    };
    (0..count)
        .map(|i| Point {
            number: i,
            position: Vector::from_fn(|axis, _| coordinate(i, axis)),
            // They differ little from a large common velocity.
            carried: Vector::from_fn(|axis, _| 1e6 + mixed(11 * i + axis + 4)),
        })
        .collect()
}

fn cloud<const D: usize>(points: &[Point<D>]) -> Cloud<D> {
    let mut cloud = Cloud::default();
    cloud.refill(points.iter().copied());
    cloud
}

/// The sums at some points over others, one by one, and what they would be if no terms
/// cancelled.
fn one_by_one<K: Radial, const D: usize>(
    radial: K,
    targets: &[Point<D>],
    sources: &[Point<D>],
) -> Vec<[Sums<D>; 2]> {
    let sums = |target: &Point<D>| {
        let zero = Sums {
            weight: 0.0,
            drive: Vector::zeros(),
        };
        let others = sources.iter().filter(|it| it.number != target.number);
        others.fold([zero; 2], |[sum, size], other| {
            let weight = radial.value((other.position - target.position).norm_squared());
            let difference = other.carried - target.carried;
            let add = |sums: Sums<D>, weight: f64, difference: Vector<D>| Sums {
                weight: sums.weight + weight,
                drive: sums.drive + difference * weight,
            };
            [
                add(sum, weight, difference),
                add(size, weight.abs(), difference.abs()),
            ]
        })
    };
    targets.iter().map(sums).collect()
}

/// Compares both ways to sum with a plain double loop.
struct Check<const D: usize> {
    count: usize,
}

impl<const D: usize> WithRadial for Check<D> {
    type Output = ();

    fn with<K: Radial>(self, radial: K) {
        let points = points::<D>(self.count);
        let near = |found: &[Sums<D>], right: &[[Sums<D>; 2]]| {
            assert_eq!(found.len(), right.len());
            for (found, [right, size]) in found.iter().zip(right) {
                // Of 700 terms, each with an error of its own from offset, kernel and product.
                let allowed = 40.0 * f64::EPSILON;
                let error = (found.weight - right.weight).abs();
                assert!(error <= allowed * size.weight, "{found:?} {right:?}");
                for axis in 0..D {
                    let error = (found.drive[axis] - right.drive[axis]).abs();
                    assert!(error <= allowed * size.drive[axis], "{found:?} {right:?}");
                }
            }
        };
        let all = cloud(&points);
        let mut sums = Vec::new();
        mutual(radial, &all, &mut sums);
        near(&sums, &one_by_one(radial, &points, &points));

        // Those that are even see those that a third of them are, and the last.
        let targets: Vec<_> = points.iter().copied().step_by(2).collect();
        let sources: Vec<_> = points.iter().copied().skip(1).step_by(3).collect();
        let found = at(radial, &cloud(&targets), &cloud(&sources));
        near(&found, &one_by_one(radial, &targets, &sources));
        let mut split = Vec::new();
        for part in targets.chunks(37) {
            split.extend(at(radial, &cloud(part), &cloud(&sources)));
        }
        assert_eq!(split, found, "the sums depend on how they are asked for");
    }
}

fn check(influence: &Influence) {
    for count in [0, 1, 2, 9, 255, 256, 257, 700] {
        assert!(influence.with_radial(Check::<2> { count }).is_some());
        assert!(influence.with_radial(Check::<3> { count }).is_some());
    }
}

#[test]
fn sums_equal_a_plain_double_loop() {
    check(&Influence::Constant(2.0));
    for exponent in [0.25, 0.5, 0.3, 1.5] {
        check(&Influence::CuckerSmale {
            strength: 3.0,
            length: 0.5,
            exponent,
        });
    }
    let potential = Potential::Logarithmic {
        attraction: 0.5,
        repulsion: 2.5,
    };
    for count in [2, 9, 257, 700] {
        assert!(potential.with_radial(Check::<2> { count }).is_some());
        assert!(potential.with_radial(Check::<3> { count }).is_some());
    }
}

/// The sums of 1,900 points by one kernel.
struct Mutual;

impl WithRadial for Mutual {
    type Output = Vec<Sums<2>>;

    fn with<K: Radial>(self, radial: K) -> Self::Output {
        let mut sums = Vec::new();
        mutual(radial, &cloud(&points::<2>(1_900)), &mut sums);
        sums
    }
}

#[test]
fn sums_do_not_depend_on_the_number_of_threads_and_cancel_over_all() {
    let kernel = Influence::CuckerSmale {
        strength: 1.0,
        length: 1.0,
        exponent: 0.5,
    };
    let by_threads: Vec<_> = (1..=4)
        .map(|threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
            let pool = pool.build().expect("threads can be made");
            pool.install(|| kernel.with_radial(Mutual).expect("the kernel is known"))
        })
        .collect();
    let bits = |sums: &[Sums<2>]| -> Vec<[u64; 3]> {
        let bits = |it: &Sums<2>| [it.weight, it.drive[0], it.drive[1]].map(f64::to_bits);
        sums.iter().map(bits).collect()
    };
    for sums in &by_threads {
        assert!(bits(sums) == bits(&by_threads[0]));
    }
    let total: Vector<2> = by_threads[0].iter().map(|sums| sums.drive).sum();
    let size: f64 = by_threads[0].iter().map(|sums| sums.drive.norm()).sum();
    assert!(total.norm() <= 1e-15 * size, "{total} of {size}");
}

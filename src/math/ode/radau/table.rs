//! The numbers of Radau IIA with five stages.
//!
//! The nodes are the zeros of the fourth derivative of x⁴(x − 1)⁵; a_ij is the integral to c_i
//! of the polynomial that is 1 at c_j and 0 at the other nodes. With s = 5 the embedded
//! solution has the weights of order 5 at the nodes, and 1/γ at the start of the step. All
//! were computed to 60 digits; tests check them by what defines them.

/// Number of stages.
pub(super) const STAGES: usize = 5;

/// An eigenvector of A⁻¹. Complex numbers are pairs.
pub(super) struct Mode {
    /// Its eigenvalue.
    pub rate: (f64, f64),
    /// The eigenvector: what the mode adds to each stage.
    pub to: [(f64, f64); STAGES],
    /// The left eigenvector, its product with the other 1: what each stage adds to the mode.
    pub from: [(f64, f64); STAGES],
}

/// The times of the stages, as shares of the step.
pub(super) const NODES: [f64; STAGES] = [
    0.05710419611451768,
    0.2768430136381238,
    0.5835904323689168,
    0.8602401356562195,
    1.0,
];

/// What the stages' ways, z_i, add to step × slope / γ for the error of the embedded solution.
pub(super) const ERROR: [f64; STAGES] = [
    -4.418997716796381,
    0.57923485225667,
    -0.199237560953468,
    0.09416748369194548,
    -0.03181316888549383,
];

/// The modes: the real one, with its eigenvalue γ, and one of each conjugate pair.
pub(super) const MODES: [Mode; 3] = [
    Mode {
        rate: (6.2867047517292765, 0.0),
        to: [
            (0.013576867344947943, 0.0),
            (0.0016179004017190875, 0.0),
            (0.07915785334744721, 0.0),
            (0.41225608268046143, 0.0),
            (1.0, 0.0),
        ],
        from: [
            (27.697693775684087, 0.0),
            (12.783337911304406, 0.0),
            (3.20848938671343, 0.0),
            (-0.9514904122489162, 0.0),
            (0.7415504960259897, 0.0),
        ],
    },
    Mode {
        rate: (5.70095329867179, 3.2102656003085497),
        to: [
            (-0.011478515255229515, 0.01401985889287541),
            (-0.007668830749180163, -0.024708578426518527),
            (0.01939846399882895, -0.08180035370375117),
            (0.40760117128019907, -0.19968242788680252),
            (1.0, 0.0),
        ],
        from: [
            (-16.5209401067595, -4.305721989937646),
            (-8.688476739531783, 4.849995704764404),
            (-0.08606453162700278, 0.9573643198484372),
            (-0.04958488899127132, 1.20934600304247),
            (0.2656140579191533, -0.5237317439676688),
        ],
    },
    Mode {
        rate: (3.655694325463572, 6.543736899360077),
        to: [
            (-0.010242047817908826, -0.04767387729029572),
            (0.05017286451737106, 0.09433181918161143),
            (-0.23053953404341795, -0.1027030453801259),
            (0.37789390224886127, -0.46674413033249434),
            (1.0, 0.0),
        ],
        from: [
            (2.672093218917456, 1.8740299037199024),
            (2.2968077838795806, -1.9924828681719424),
            (-1.5181801617297122, -0.5222078208040094),
            (0.5253300951157295, 0.5920492840689743),
            (-0.13638930593214812, -0.22495888507839018),
        ],
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Complex, SMatrix};

    type Square = SMatrix<f64, STAGES, STAGES>;

    /// A⁻¹, from the nodes: A maps x^k at the nodes to x^(k+1)/(k+1).
    fn inverse() -> Square {
        let powers = Square::from_fn(|i, k| NODES[i].powi(k as i32));
        let integrals = Square::from_fn(|i, k| NODES[i].powi(k as i32 + 1) / (k as f64 + 1.0));
        powers * integrals.try_inverse().expect("nodes that differ")
    }

    #[test]
    fn nodes_make_the_quadrature_exact_to_the_order() {
        // The weights are the last row of A.
        let weights = inverse().try_inverse().expect("a regular matrix");
        for power in 0..9 {
            let terms = (0..STAGES).map(|j| weights[(STAGES - 1, j)] * NODES[j].powi(power));
            let sum: f64 = terms.sum();
            let wanted = 1.0 / (f64::from(power) + 1.0);
            assert!((sum - wanted).abs() < 1e-13, "{power}: {sum} {wanted}");
        }
    }

    #[test]
    fn modes_are_the_eigenvectors() {
        let inverse = inverse();
        let number = |pair: (f64, f64)| Complex::new(pair.0, pair.1);
        for mode in &MODES {
            let rate = number(mode.rate);
            for i in 0..STAGES {
                let right: Complex<f64> = (0..STAGES)
                    .map(|j| number(mode.to[j]) * inverse[(i, j)])
                    .sum();
                assert!((right - rate * number(mode.to[i])).norm() < 1e-11);
                let left: Complex<f64> = (0..STAGES)
                    .map(|j| number(mode.from[j]) * inverse[(j, i)])
                    .sum();
                assert!((left - rate * number(mode.from[i])).norm() < 1e-10);
            }
            let product: Complex<f64> = (0..STAGES)
                .map(|j| number(mode.from[j]) * number(mode.to[j]))
                .sum();
            assert!((product - 1.0).norm() < 1e-12);
        }
    }

    #[test]
    fn the_embedded_solution_is_of_order_five() {
        let gamma = MODES[0].rate.0;
        // With z = A F, the weights' differences at the nodes are ERROR · A.
        let a = inverse().try_inverse().expect("a regular matrix");
        for power in 0..5 {
            let weight = |j: usize| (0..STAGES).map(|i| ERROR[i] * a[(i, j)]).sum::<f64>();
            let sum: f64 = (0..STAGES).map(|j| weight(j) * NODES[j].powi(power)).sum();
            let at_start = if power == 0 { 1.0 / gamma } else { 0.0 };
            assert!((sum + at_start).abs() < 1e-13, "{power}: {sum}");
        }
    }
}

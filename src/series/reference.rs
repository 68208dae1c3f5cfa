//! What a quantity is compared with.

/// A level that means something.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Reference {
    /// The value at the start of the run, above which theorems keep the quantity: its name.
    Start(&'static str),
    /// A value, and what it is.
    Value(f64, &'static str),
}

/// What a quantity is compared with, by what it is.
pub(super) fn of(stem: &str) -> Option<Reference> {
    Some(match stem {
        // H never rises without other laws; Olfati-Saber (2003), section 4.
        "structural_energy" | "smooth_structural_energy" => Reference::Start("H(0)"),
        // Song et al. (2013), Theorem 7.
        "energy" => Reference::Start("W(0)"),
        // Shi, Wang & Chu, Theorem 1.
        "total_energy" => Reference::Start("J(0)"),
        // Djokam & Rathinam, Lemma 1.
        "largest_kinetic_energy" => Reference::Start("E(0)"),
        "agent_gap" | "obstacle_gap" | "smallest_agent_gap" | "smallest_obstacle_gap" => {
            Reference::Value(0.0, "contact")
        }
        "density" => Reference::Value(1.0, "one flock"),
        _ => return None,
    })
}

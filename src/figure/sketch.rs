//! Figures that show no result.

/// A figure of a paper that there is nothing to make of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Sketch {
    /// Its name, as an [`Entry`](super::Entry) would have it: `djokam-rathinam-1`.
    pub id: &'static str,
    /// Which figure of which paper it is.
    pub source: &'static str,
    /// What it shows, and why it is not made.
    pub reason: &'static str,
}

impl Sketch {
    /// Whether a figure of this name is of the same paper.
    fn is_beside(&self, id: &str) -> bool {
        let paper = self.id.rsplit_once('-').map(|(paper, _)| paper);
        let rest = paper.and_then(|paper| id.strip_prefix(paper));
        rest.is_some_and(|rest| rest.starts_with('-'))
    }
}

/// The sketches in the papers that figures of these names are of.
pub fn sketches<'a>(ids: impl IntoIterator<Item = &'a str>) -> Vec<Sketch> {
    let ids: Vec<&str> = ids.into_iter().collect();
    let all = SKETCHES.into_iter();
    all.filter(|sketch| ids.iter().any(|id| sketch.is_beside(id)))
        .collect()
}

const SKETCHES: [Sketch; 5] = [
    Sketch {
        id: "djokam-rathinam-1",
        source: "Djokam & Rathinam, Figure 1",
        reason: "A sketch of masking and of orientation bias; it shows no data.",
    },
    Sketch {
        id: "djokam-rathinam-2",
        source: "Djokam & Rathinam, Figure 2",
        reason: "A sketch of the step in a proof: the hyperplane through a velocity; it shows no data.",
    },
    Sketch {
        id: "olfati-saber-2003-1",
        source: "Olfati-Saber (2003), Figure 1",
        reason: "A sketch of a spherical and of a conic neighbourhood; it shows no data.",
    },
    Sketch {
        id: "olfati-saber-2003-3",
        source: "Olfati-Saber (2003), Figure 3",
        reason: "A sketch of six realizations of a structural net of four agents; it shows no run.",
    },
    Sketch {
        id: "olfati-saber-2003-6",
        source: "Olfati-Saber (2003), Figure 6",
        reason: "A sketch of an agent, its β-agent and its γ-agent at an obstacle; it shows no run.",
    },
];

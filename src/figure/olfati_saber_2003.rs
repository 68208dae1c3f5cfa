//! R. Olfati-Saber, "Flocking with obstacle avoidance", 2003, Figures 2, 4, 5 and 7 to 9.

mod functions;
mod snapshots;

#[cfg(test)]
pub(super) use functions::{crossing, curve, pair_of};

use super::Entry;

pub(super) const ENTRIES: [Entry; 6] = [
    Entry {
        id: "olfati-saber-2003-2",
        source: "Olfati-Saber (2003), Figure 2",
        caption: "(a) A bump function ρ(z/r) with k₀ = 5/6 and r = 12, and (b) its derivative.",
        wanted: &[],
        draw: functions::bump,
    },
    Entry {
        id: "olfati-saber-2003-4",
        source: "Olfati-Saber (2003), Figure 4",
        caption: "(a) The potential ψ_α(z) and (b) the action function φ_α(z), (29), with a = 1 and \
                  b = 5.",
        wanted: &[],
        draw: functions::action,
    },
    Entry {
        id: "olfati-saber-2003-5",
        source: "Olfati-Saber (2003), Figure 5",
        caption: "The potential of two α-agents as a function of the edge deviation η, with d_α = \
                  10, r = 12, a = 1 and b = 5: (a) nonsmooth, with a jump at η = 2, and (b) \
                  smooth.",
        wanted: &[],
        draw: functions::pair,
    },
    Entry {
        id: "olfati-saber-2003-7",
        source: "Olfati-Saber (2003), Figure 7",
        caption: "Snapshots of a cluster of a hundred agents among six obstacles: they split, \
                  rejoin and squeeze between the two large ones.",
        wanted: &[snapshots::SIX_OBSTACLES],
        draw: snapshots::cluster,
    },
    Entry {
        id: "olfati-saber-2003-8",
        source: "Olfati-Saber (2003), Figure 8",
        caption: "The same with the edges of the net: hardly an agent is lost on the way; the \
                  largest component has a share of about 0.97 of them in the end.",
        wanted: &[snapshots::SIX_OBSTACLES],
        draw: snapshots::net,
    },
    Entry {
        id: "olfati-saber-2003-9",
        source: "Olfati-Saber (2003), Figure 9",
        caption: "Snapshots of a hundred agents that come to a sink at the origin: a net becomes a \
                  flock, connected after 4 s, in the end planar, rigid and mostly of equilateral \
                  triangles, its normalised defect factor rather low.",
        wanted: &[snapshots::SINK],
        draw: snapshots::sink,
    },
];

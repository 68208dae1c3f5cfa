//! The graphs that a world file names.

use serde_json::json;
use volary::net::{Adjacency, is_strongly_connected, symmetric_connectivity};
use volary::world::spec::GraphSpec;

use crate::common::from_json;

fn net(graph: serde_json::Value, agents: usize, seed: u64) -> Adjacency {
    let graph: GraphSpec = from_json(graph);
    Adjacency::new(graph.rows(agents, seed).expect("its weights are fixed"))
}

#[test]
fn random_graphs_are_balanced_and_strongly_connected_whatever_the_seed() {
    for seed in 0..150 {
        for agents in [2, 3, 5, 12, 30] {
            let most = agents * (agents - 1);
            for arcs in [agents, (agents + 1).min(most), (agents + most) / 2, most] {
                let graph = || net(json!({ "random": { "arcs": arcs } }), agents, seed);
                let net = graph();
                assert_eq!(net.arcs(), arcs);
                assert!(net.is_balanced() && is_strongly_connected(&net));
                assert!(net.imbalance() < 1e-13, "{}", net.imbalance());
                let weights = (0..agents).flat_map(|i| net.row(i).iter().map(|&(_, w)| w));
                assert!(weights.into_iter().all(|w| w > 0.0 && w < 1.0));
                assert!(symmetric_connectivity(&net) > Some(1e-9));
                assert_eq!(net, graph());
            }
        }
    }
}

#[test]
fn seeds_and_numbers_draw_different_graphs() {
    let graph = |number: u32, seed| {
        net(
            json!({ "random": { "arcs": 20, "number": number } }),
            8,
            seed,
        )
    };
    assert_ne!(graph(0, 1), graph(0, 2));
    assert_ne!(graph(0, 1), graph(1, 1));
    // Whoever changes this changes every world with a random graph.
    let first = graph(0, 1);
    assert_eq!(first.row(0).len(), 3);
    assert!((first.weight(0, 2) - 0.5915234993063578).abs() < 1e-15);
}

#[test]
fn rings_and_complete_graphs_are_what_they_are_called() {
    let ring = net(json!({ "ring": { "weight": 0.5 } }), 4, 1);
    assert_eq!(
        (ring.weight(0, 1), ring.weight(3, 0), ring.weight(1, 0)),
        (0.5, 0.5, 0.0)
    );
    assert_eq!(ring.arcs(), 4);
    let both = net(json!({ "ring": { "both_ways": true } }), 4, 1);
    assert!(both.is_undirected() && both.arcs() == 8 && both.weight(0, 3) == 1.0);
    assert_eq!(
        net(json!({ "ring": { "both_ways": true } }), 2, 1).arcs(),
        2
    );
    assert_eq!(net(json!({ "ring": {} }), 1, 1).arcs(), 0);
    let complete = net(json!({ "complete": { "weight": 2 } }), 5, 1);
    assert_eq!(complete.arcs(), 20);
    assert!((symmetric_connectivity(&complete).unwrap() - 20.0).abs() < 1e-12);
    let matrix = net(json!({ "matrix": [[0, 0.5], [2, 0]] }), 2, 1);
    assert_eq!((matrix.weight(0, 1), matrix.weight(1, 0)), (0.5, 2.0));
    assert_eq!(matrix.imbalance(), 1.5);
}

#[test]
fn check_tells_what_a_graph_is_like() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("graphs.json");
    let law = |graph: serde_json::Value| json!({ "alignment": { "graph": graph } });
    let world = json!({
        "dimension": 2, "time": { "end": 1 },
        "agents": [{ "radius": 0.1, "positions": { "explicit": [[0, 0], [1, 0], [2, 0]] } }],
        "laws": [
            law(json!({ "ring": { "weight": 0.5 } })),
            law(json!({ "matrix": [[0, 1, 0], [0, 0, 1], [0, 0, 0]] })),
            law(json!({ "matrix": [[0, 1, 0], [1, 0, 0], [0, 0, 0]] })),
            law(json!({ "open_loop": [[0, 1, 1], [1, 0, 1], [1, 1, 0]] }))
        ]
    });
    std::fs::write(&file, world.to_string()).expect("a file");
    let mut volary = assert_cmd::Command::cargo_bin("volary").expect("the command");
    let output = volary.arg("check").arg(&file).output().expect("it runs");
    let text = String::from_utf8(output.stdout).expect("text");
    let lines: Vec<&str> = text.lines().skip(1).collect();
    // Of the chain it is the middle root of λ³ − 4λ² + 2λ + 2.
    let expected = [
        "  alignment, law 0: 3 arcs, strongly connected, balanced, λ2(L + Lᵀ) = 1.500000",
        "  alignment, law 1: 2 arcs, weakly connected only, out of balance by up to 1.000e0, \
         λ2(L + Lᵀ) = 1.311108",
        "  alignment, law 2: 2 arcs, not connected, balanced, λ2(L + Lᵀ) = 0.000000",
        "  alignment, law 3: its weights are functions of time",
    ];
    assert_eq!(lines, expected);
}

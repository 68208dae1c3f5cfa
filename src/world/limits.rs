//! How much a world may hold.
//!
//! Everything here is far above what a world needs for its purpose, and below what fills a
//! memory of 16 GiB or takes a night to read. What is larger is refused with its size and the one
//! that is allowed. Reading, checking and placing take a time that grows like the size of the
//! world, up to logarithms, so nothing below these limits takes for ever.

/// Bytes of a world file. A million agents in space with positions, velocities and masses, all
/// digits written out, take about 150 MiB.
pub const MOST_BYTES: usize = 256 << 20;

/// Numbers, texts, lists and objects in a world file. A million agents in space with positions,
/// velocities and masses make nine million; the value of each takes up to 200 bytes while it is
/// read.
pub const MOST_VALUES: usize = 30_000_000;

/// Agents. Bodies take about 2 kB each, points a tenth of that.
pub const MOST_AGENTS: usize = 10_000_000;

/// Steps of a run.
pub const MOST_STEPS: u64 = 10_000_000_000;

/// Groups of agents.
pub const MOST_GROUPS: usize = 1_000_000;

/// Obstacles.
pub const MOST_OBSTACLES: usize = 1_000_000;

/// Convex parts of obstacles, counted as pieces, triangles and sides: all of them together.
pub const MOST_PARTS: usize = 2_000_000;

/// Obstacles, or parts of them, without bounds: every agent must be held against each of them.
pub const MOST_UNBOUNDED: usize = 1_000;

/// Points of one convex shape: what finds its faces compares them with one another.
pub const MOST_CORNERS: usize = 10_000;

/// Pairs of parts of obstacles whose boxes overlap.
pub const MOST_OVERLAPS: usize = 10_000_000;

/// Edges of the proximity net, or links that are recorded, at the start: a frame holds them all.
pub const MOST_EDGES: usize = 100_000_000;

/// Laws, those inside scopes counted one by one: each is asked in every step.
pub const MOST_LAWS: usize = 1_000;

/// Arcs of a graph that is not written out.
pub const MOST_ARCS: usize = 1_000_000;

/// Agents in a world that records the analysis of its net: its time grows with their cube, and
/// so many take some ten seconds a frame.
pub const MOST_IN_NET: usize = 1_000;

/// Agents in a world that records what laws are about, pair by pair: ten thousand make fifty
/// million pairs a frame.
pub const MOST_IN_LAWS: usize = 10_000;

/// Parts of the path of an override. Without compounds inside one another, the deepest field
/// lies some ten deep.
pub const MOST_STEPS_OF_A_PATH: usize = 100;

/// Bytes of an override's path.
pub const MOST_BYTES_OF_A_PATH: usize = 10_000;

/// Problems that are kept. A file with so many has one mistake that all of them come from.
pub const MOST_PROBLEMS: usize = 100_000;

//! Claims of this paper.

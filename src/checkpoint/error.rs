//! What can go wrong with a checkpoint.

use super::envelope::VERSION;
use crate::file::FileError;

/// Why a checkpoint could not be written, read or gone on with. Each message names the
/// file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CheckpointError {
    /// The file could not be created, written, opened or read.
    #[error(transparent)]
    File(#[from] FileError),
    /// The file is something else.
    #[error("{file} is not a checkpoint")]
    NotACheckpoint {
        /// The file.
        file: String,
    },
    /// The file is not as it was written.
    #[error("{file} is damaged: {problem}")]
    Damaged {
        /// The file.
        file: String,
        /// How that shows.
        problem: String,
    },
    /// The file has a version that this program cannot read.
    #[error(
        "{file} has version {found} of the checkpoint format; only version {} is supported",
        VERSION
    )]
    Version {
        /// The file.
        file: String,
        /// The file's version.
        found: u32,
    },
    /// Another version of the program made it, or the same one on another kind of machine.
    #[error(
        "{file} was made by {found}, and this is {here}: only the same version on the same kind \
         of machine goes on bit for bit"
    )]
    Program {
        /// The file.
        file: String,
        /// What made it.
        found: String,
        /// What would go on with it.
        here: String,
    },
    /// The file is whole, but there is no going on from what it holds.
    #[error("{file} cannot be gone on with: {problem}")]
    Unusable {
        /// The file.
        file: String,
        /// What is wrong.
        problem: String,
    },
}

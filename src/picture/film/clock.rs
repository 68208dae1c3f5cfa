//! When frames are shown, in whole ticks.

/// The beginnings of evenly spaced frames, each rounded to a tick, so that what rounding takes
/// from one frame it gives to another.
#[derive(Debug, Clone, Copy)]
pub(super) struct Clock {
    /// Frames a second.
    pub(super) rate: f64,
    /// Number of frames.
    pub(super) frames: u32,
    /// Ticks a second.
    pub(super) ticks: f64,
}

impl Clock {
    /// The tick at which a frame begins; of the number of frames, at which the film ends.
    pub(super) fn begin(&self, frame: u32) -> u64 {
        (f64::from(frame) * self.ticks / self.rate).round() as u64
    }

    /// How long a frame is shown, in ticks.
    pub(super) fn delay(&self, frame: u32) -> u16 {
        let ticks = self.begin(frame + 1) - self.begin(frame);
        u16::try_from(ticks).unwrap_or(u16::MAX)
    }
}

//! Products of spectra.

use pulp::{Simd, WithSimd};

use super::convolution::Channels;
use super::gemm::LANES;

/// Real parts and imaginary parts of this many frequencies lie side by side.
pub(super) const PAIR: usize = 2 * LANES;

/// The products of spectra of some targets with those of their sources, summed.
pub(super) struct Gather<'a> {
    pub channels: Channels,
    /// Registers' worths of frequencies, and ways in which cells may lie.
    pub parts: usize,
    pub ways: usize,
    /// For each target, those sources' places in `spectra` and the ways in which they lie.
    pub sources: &'a [&'a [(u32, u32)]],
    pub spectra: &'a [f64],
    pub symbols: &'a [f64],
    pub sums: &'a mut [f64],
}

impl WithSimd for Gather<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        // The numbers of channels are known to the compiler, so that sums stay in registers.
        match (self.channels.given, self.channels.wanted) {
            (1, 1) => self.run::<S, 1, 1>(simd),
            (1, 2) => self.run::<S, 1, 2>(simd),
            (1, 3) => self.run::<S, 1, 3>(simd),
            (3, 3) => self.run::<S, 3, 3>(simd),
            (4, 4) => self.run::<S, 4, 4>(simd),
            other => unreachable!("no law has channels {other:?}"),
        }
    }
}

impl Gather<'_> {
    /// G channels given, W wanted.
    #[inline(always)]
    fn run<S: Simd, const G: usize, const W: usize>(self, simd: S) {
        let lanes = S::F64_LANES;
        // Registers in half a pair.
        let half = LANES / lanes;
        let zero = simd.splat_f64s(0.0);
        let kernels = if G == W { 1 } else { W };
        let spectra = S::as_simd_f64s(self.spectra).0;
        let symbols = S::as_simd_f64s(self.symbols).0;
        let sums = S::as_mut_simd_f64s(self.sums).0;
        for part in 0..self.parts {
            for (target, sources) in self.sources.iter().enumerate() {
                for register in 0..half {
                    let mut re = [zero; W];
                    let mut im = [zero; W];
                    for &(source, way) in *sources {
                        let from = (source as usize * self.parts + part) * G * 2 * half + register;
                        let from = &spectra[from..][..(2 * G - 1) * half + 1];
                        let by = (part * self.ways + way as usize) * kernels * 2 * half + register;
                        let by = &symbols[by..][..(2 * kernels - 1) * half + 1];
                        for w in 0..W {
                            let (g, k) = if G == W { (w, 0) } else { (0, w) };
                            let (a, b) = (from[2 * g * half], from[(2 * g + 1) * half]);
                            let (c, d) = (by[2 * k * half], by[(2 * k + 1) * half]);
                            re[w] = simd.mul_add_e_f64s(a, c, re[w]);
                            im[w] = simd.mul_add_e_f64s(a, d, im[w]);
                            re[w] = simd.negate_mul_add_e_f64s(b, d, re[w]);
                            im[w] = simd.mul_add_e_f64s(b, c, im[w]);
                        }
                    }
                    let out = (target * self.parts + part) * W * 2 * half + register;
                    for w in 0..W {
                        sums[out + 2 * w * half] = re[w];
                        sums[out + (2 * w + 1) * half] = im[w];
                    }
                }
            }
        }
    }
}

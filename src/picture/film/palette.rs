//! The colours of a film that cannot have all.

use std::collections::BTreeMap;

/// A colour that covers.
type Rgb = [u8; 3];

/// Up to 255 colours, and which of them is nearest to any other.
///
/// Colours are told apart in cells of four levels each of red, green and blue. Colours in one
/// cell become that which the samples have most often, so that plain areas keep their exact
/// colour.
#[derive(Debug, Clone)]
pub(super) struct Palette {
    colors: Vec<Rgb>,
    /// The number of the nearest colour, cell by cell, once it was asked for.
    nearest: Vec<u16>,
}

/// Not yet asked for.
const UNKNOWN: u16 = u16::MAX;

/// The most colours; one more number stands for "as before".
pub(super) const MOST: usize = 255;

impl Palette {
    /// The palette of these pixels: the most frequent colour, and then, again and again, the
    /// one whose pixels are all in all furthest from their nearest colour so far.
    pub(super) fn of<'a>(samples: impl Iterator<Item = &'a [[u8; 4]]>) -> Self {
        let candidates = candidates(samples);
        let mut palette = Self {
            colors: Vec::new(),
            nearest: vec![UNKNOWN; 1 << 18],
        };
        // How far each candidate is from its nearest colour: at first, all the same.
        let mut distances = vec![1; candidates.len()];
        while palette.colors.len() < MOST {
            let errors = candidates.iter().zip(&distances);
            let errors = errors.map(|((_, count), distance)| count * u64::from(*distance));
            // The first of equals, so that the order of the candidates decides.
            let worst = errors.enumerate().max_by_key(|(k, e)| (*e, usize::MAX - k));
            let Some((worst, 1..)) = worst else {
                break;
            };
            let chosen = candidates[worst].0;
            let first = palette.colors.is_empty();
            for ((color, _), distance) in candidates.iter().zip(&mut distances) {
                let here = square_distance(*color, chosen);
                *distance = if first { here } else { here.min(*distance) };
            }
            palette.nearest[cell(chosen)] = palette.colors.len() as u16;
            palette.colors.push(chosen);
        }
        palette
    }

    /// Red, green and blue of all colours in turn.
    pub(super) fn bytes(&self) -> &[u8] {
        self.colors.as_flattened()
    }

    /// The numbers of the colours nearest to these.
    pub(super) fn numbers(&mut self, pixels: &[[u8; 4]], numbers: &mut Vec<u8>) {
        numbers.clear();
        let (mut last, mut number) = ([0; 4], None);
        numbers.extend(pixels.iter().map(|&pixel| match number {
            // Plain areas are most of what there is.
            Some(number) if pixel == last => number,
            _ => {
                let [red, green, blue, _] = pixel;
                last = pixel;
                *number.insert(self.number([red, green, blue]))
            }
        }));
    }

    fn number(&mut self, color: Rgb) -> u8 {
        let cell = cell(color);
        if self.nearest[cell] == UNKNOWN {
            let distances = self.colors.iter().map(|c| square_distance(*c, color));
            let nearest = distances.enumerate().min_by_key(|(_, d)| *d);
            self.nearest[cell] = nearest.map_or(0, |(k, _)| k as u16);
        }
        self.nearest[cell] as u8
    }

    /// Shades of all colours, for films of which nothing is known.
    pub(super) fn of_anything() -> Self {
        let levels = |count: u32| (0..count).map(move |k| (k * 255 / (count - 1)) as u8);
        let shades = levels(6).flat_map(|red| {
            levels(7).flat_map(move |green| levels(6).map(move |blue| [red, green, blue, 255]))
        });
        let shades: Vec<_> = shades.collect();
        Self::of([shades.as_slice()].into_iter())
    }
}

/// One colour of each cell that occurs, the most frequent, with the number of pixels in the
/// cell.
fn candidates<'a>(samples: impl Iterator<Item = &'a [[u8; 4]]>) -> Vec<(Rgb, u64)> {
    let mut counts = BTreeMap::<(usize, Rgb), u64>::new();
    for sample in samples {
        for run in sample.chunk_by(|a, b| a == b) {
            let [red, green, blue, _] = run[0];
            let color = [red, green, blue];
            *counts.entry((cell(color), color)).or_default() += run.len() as u64;
        }
    }
    let counts: Vec<_> = counts.into_iter().collect();
    let cells = counts.chunk_by(|((a, _), _), ((b, _), _)| a == b);
    cells
        .filter_map(|colors| {
            let ((_, color), _) = colors.iter().max_by_key(|(_, count)| *count)?;
            Some((*color, colors.iter().map(|(_, count)| count).sum()))
        })
        .collect()
}

fn cell(color: Rgb) -> usize {
    let [red, green, blue] = color.map(|level| usize::from(level >> 2));
    red << 12 | green << 6 | blue
}

/// Square of the distance, weighted by how well each part is seen.
fn square_distance(a: Rgb, b: Rgb) -> u32 {
    const WEIGHTS: [u32; 3] = [3, 6, 2];
    let parts = (0..3).map(|k| u32::from(a[k].abs_diff(b[k])).pow(2) * WEIGHTS[k]);
    parts.sum()
}

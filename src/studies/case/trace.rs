//! Trace of one pixel of a case.

use refsim::machine::{Executor, FragmentTrace};

use super::{CaseError, Loaded, Setup};

/// Radius of the search for a covered pixel around an uncovered one, in pixels.
const AROUND: u32 = 16;

/// Trace of a pixel.
#[derive(Clone, Debug)]
pub struct PixelTrace {
    /// Column and row.
    pub pixel: [u32; 2],
    /// Fragments of all triangles that cover the pixel, in order.
    pub fragments: Vec<FragmentTrace>,
    /// Nearest covered pixel within 16 columns and rows, if there are no fragments.
    pub nearest: Option<[u32; 2]>,
}

/// Traces a pixel through the draw of a case. Fails if the device cannot execute the case, or the pixel lies outside
/// the targets.
pub fn trace(setup: &Setup, executor: impl Into<Executor>, pixel: [u32; 2]) -> Result<PixelTrace, CaseError> {
    let loaded = Loaded::new(setup, executor)?;
    let [x, y] = pixel;
    let fragments: Vec<FragmentTrace> = loaded.trace(&[(x, y)])?.into_iter().flatten().collect();
    let nearest = if fragments.is_empty() { nearest(&loaded, setup.size, pixel)? } else { None };
    Ok(PixelTrace { pixel, fragments, nearest })
}

fn nearest(loaded: &Loaded<'_>, size: [u32; 2], pixel: [u32; 2]) -> Result<Option<[u32; 2]>, CaseError> {
    let range = |axis: usize| pixel[axis].saturating_sub(AROUND)..(pixel[axis] + AROUND + 1).min(size[axis]);
    let mut around: Vec<(u32, u32)> = range(1).flat_map(|y| range(0).map(move |x| (x, y))).collect();
    let square = |a: u32, b: u32| a.abs_diff(b).pow(2);
    around.sort_by_key(|&(x, y)| (square(x, pixel[0]) + square(y, pixel[1]), y, x));
    let traces = loaded.trace(&around)?;
    let covered = around.iter().zip(&traces).find(|(_, fragments)| !fragments.is_empty());
    Ok(covered.map(|(&(x, y), _)| [x, y]))
}

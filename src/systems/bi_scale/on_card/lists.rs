//! Lists of places as textures, grouped into passes that sum the same number of texels per fragment.
//!
//! Sums are sorted by the lengths of their lists, so that lists within a row of the target have similar lengths. A pass
//! covers rows whose longest lists have the same number of texels, and reads that many texels per fragment. Shorter
//! lists are padded with places that hold 0.

use crate::card::{CardError, Texels};

/// The number of places that stay distinct in single precision when one half is added: 23 bits.
const MOST_PLACES: usize = 1 << 23;

/// Rejects more sums or columns than there are distinct places.
pub(super) fn check_places(what: &str, found: usize) -> Result<(), CardError> {
    if found < MOST_PLACES {
        return Ok(());
    }
    let most = MOST_PLACES - 1;
    Err(CardError::input(format!(
        "expected at most {most} {what}, whose places single precision tells apart, found {found}"
    )))
}

/// Width and height of a texture with at least `count` texels: powers of two, width at least height.
pub(super) fn extents(count: usize) -> [usize; 2] {
    let bits = count.max(1).next_power_of_two().ilog2();
    [1 << bits.div_ceil(2), 1 << (bits / 2)]
}

#[derive(Clone, Copy, Debug)]
pub(super) struct ListLimits<'a> {
    /// Largest number of list texels per fragment.
    pub(super) texels: usize,
    pub(super) side: usize,
    pub(super) device: &'a str,
}

/// A pass: a range of rows of the target, and the list texels that it reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct ListPass {
    /// First target row, and number of rows.
    pub(super) rows: [usize; 2],
    /// The index of the texture of lists, and its first row for this pass.
    pub(super) sheet: usize,
    pub(super) sheet_row: usize,
    pub(super) texels: usize,
    /// The index of this pass among the passes over the same rows, and the number of these passes.
    pub(super) pass: [usize; 2],
}

#[derive(Clone, Debug)]
pub(super) struct Lists {
    /// Index of the sum at each place of the target.
    pub(super) order: Vec<u32>,
    /// Width and height of the target.
    pub(super) size: [usize; 2],
    pub(super) passes: Vec<ListPass>,
    pub(super) sheets: Vec<Texels>,
}

impl Lists {
    /// Creates the lists of `lengths.len()` sums with `lengths[i]` texels each; `texel(i, n)` gives the n-th texel of
    /// list i, and `filler` is a texel of places that hold 0. The target has at least one unused place, which stays 0.
    /// Fails with [`CardError`] if the target exceeds the largest texture, or has more places than single precision
    /// distinguishes.
    pub(super) fn new(
        what: &'static str,
        lengths: &[usize],
        texel: &dyn Fn(usize, usize) -> [f32; 4],
        filler: [f32; 4],
        limits: ListLimits<'_>,
    ) -> Result<Self, CardError> {
        let count = lengths.len();
        check_places(what, count)?;
        let size = extents(count + 1);
        let [width, height] = size;
        if width > limits.side {
            return Err(CardError::input(format!(
                "{count} {what} need a texture of {width} x {height} texels; `{}` has textures of {} per side \
                 (limits.max_texture_size); use fewer",
                limits.device, limits.side
            )));
        }
        let mut order: Vec<u32> = (0..count as u32).collect();
        order.sort_by_key(|&sum| lengths[sum as usize]);
        let mut lists = Self { order, size, passes: Vec::new(), sheets: Vec::new() };
        // Lists are sorted by length, so the last list of a row is its longest.
        let longest = |row: usize| lengths[lists.order[((row + 1) * width).min(count) - 1] as usize];
        let rows: Vec<usize> = (0..count.div_ceil(width)).map(longest).collect();
        let mut first = 0;
        for class in rows.chunk_by(|a, b| a == b) {
            lists.push_class(first, class.len(), class[0], limits);
            first += class.len();
        }
        lists.fill(lengths, texel, filler);
        Ok(lists)
    }

    /// Adds the passes over rows whose longest lists have the same number of texels.
    fn push_class(&mut self, first: usize, count: usize, texels: usize, limits: ListLimits<'_>) {
        if texels == 0 {
            return;
        }
        let passes = texels.div_ceil(limits.texels);
        let rows_of_pass = (limits.side / texels.min(limits.texels)).max(1);
        for first_row in (0..count).step_by(rows_of_pass) {
            let rows = [first + first_row, rows_of_pass.min(count - first_row)];
            for pass in 0..passes {
                let texels = limits.texels.min(texels - pass * limits.texels);
                let (sheet, sheet_row) = self.reserve(rows[1] * texels, limits.side);
                self.passes.push(ListPass { rows, sheet, sheet_row, texels, pass: [pass, passes] });
            }
        }
    }

    /// Reserves rows in the last sheet if they fit, otherwise in a new one; returns the sheet and its first row.
    fn reserve(&mut self, rows: usize, side: usize) -> (usize, usize) {
        if self.sheets.last().is_none_or(|last| last.height + rows > side) {
            self.sheets.push(Texels { width: self.size[0], height: 0, texels: Vec::new() });
        }
        let sheet = self.sheets.len() - 1;
        let last = &mut self.sheets[sheet];
        last.height += rows;
        (sheet, last.height - rows)
    }

    fn fill(&mut self, lengths: &[usize], texel: &dyn Fn(usize, usize) -> [f32; 4], filler: [f32; 4]) {
        let width = self.size[0];
        let mut begun = 0;
        for pass in &self.passes {
            if pass.pass[0] == 0 {
                begun = 0;
            }
            let into = &mut self.sheets[pass.sheet].texels;
            for at in begun..begun + pass.texels {
                for place in pass.rows[0] * width..(pass.rows[0] + pass.rows[1]) * width {
                    let sum = self.order.get(place).map(|&sum| sum as usize);
                    into.push(sum.filter(|&sum| at < lengths[sum]).map_or(filler, |sum| texel(sum, at)));
                }
            }
            begun += pass.texels;
        }
    }
}

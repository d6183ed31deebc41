//! Rays and triangles in the units of the card.
//!
//! A card's registers have a range, its ray textures another, its depth buffer a third. The host brings rays and
//! scene into them by powers of two alone, so that no bit of the input is lost before the card rounds it.

use refsim::texture::Region;

use crate::geom::Ray;

/// Side of the squares that lists are laid out in: a tile of the card, and the paper's bucket of 256 rays (section 5.3).
const SQUARE: usize = 16;
/// Squares in a row of a list's batch.
const SQUARES_A_ROW: usize = 16;

/// Rays as a rectangle of pixels, row by row from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct RayBatch {
    width: u32,
    height: u32,
    rays: Vec<Ray>,
}

/// The rays fill no such rectangle.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("expected {width} x {height} rays for a batch of that size, found {found}")]
pub struct RayBatchError {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// The rays given.
    pub found: usize,
}

impl RayBatch {
    /// `width * height` rays, row by row.
    ///
    /// # Errors
    /// [`RayBatchError`] if there are more or fewer.
    pub fn new(width: u32, height: u32, rays: Vec<Ray>) -> Result<Self, RayBatchError> {
        if rays.len() == width as usize * height as usize {
            Ok(Self { width, height, rays })
        } else {
            Err(RayBatchError { width, height, found: rays.len() })
        }
    }

    /// A list of rays, 256 after 256 in squares of 16 x 16 pixels, 16 squares a row: neighbours in the list are neighbours
    /// on the screen. The last square is padded by repeating the last ray; [`Self::pixel_of`] finds the answers again. An
    /// empty list gives a batch of no rows.
    pub fn from_list(rays: &[Ray]) -> Self {
        let squares = rays.len().div_ceil(SQUARE * SQUARE);
        let columns = squares.clamp(1, SQUARES_A_ROW);
        let (width, height) = (columns * SQUARE, squares.div_ceil(columns) * SQUARE);
        let mut pixels: Vec<Ray> = rays.last().into_iter().cycle().take(width * height).copied().collect();
        for (i, ray) in rays.iter().enumerate() {
            pixels[Self::pixel_in(width, i)] = *ray;
        }
        let side = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
        Self { width: side(width), height: side(height), rays: pixels }
    }

    /// The pixel, counted row by row, that holds ray `ray` of the list that [`Self::from_list`] was given.
    pub const fn pixel_of(&self, ray: usize) -> usize {
        Self::pixel_in(self.width as usize, ray)
    }

    const fn pixel_in(width: usize, ray: usize) -> usize {
        let (square, within) = (ray / (SQUARE * SQUARE), ray % (SQUARE * SQUARE));
        let columns = width / SQUARE;
        let (x, y) = (square % columns * SQUARE + within % SQUARE, square / columns * SQUARE + within / SQUARE);
        y * width + x
    }

    /// Rays in a row.
    pub const fn width(&self) -> u32 {
        self.width
    }

    /// Rows.
    pub const fn height(&self) -> u32 {
        self.height
    }

    /// The rays, row by row.
    pub fn rays(&self) -> &[Ray] {
        &self.rays
    }

    /// The rays of a region as a batch of their own; what of the region lies outside is left out.
    pub(super) fn part(&self, region: Region) -> Self {
        let whole = Region { x: 0, y: 0, width: self.width, height: self.height };
        let Region { x, y, width, height } = region.intersect(whole);
        let rows = self.rays.chunks(self.width.max(1) as usize).skip(y as usize).take(height as usize);
        let rays = rows.flat_map(|row| &row[x as usize..(x + width) as usize]).copied().collect();
        Self { width, height, rays }
    }

    /// The point at which all rays start, if there is one: eye rays, or rays from a point light.
    pub fn common_origin(&self) -> Option<[f32; 3]> {
        let first = self.rays.first()?.origin();
        self.rays.iter().all(|r| r.origin() == first).then_some(first)
    }
}

/// The exponent of the largest power of two that is not above `x`; `x` finite and above zero.
fn floor_log2(x: f64) -> i32 {
    // Denormal f64 can't come from f32 inputs, so the biased exponent says it all.
    ((x.to_bits() >> 52) & 0x7ff) as i32 - 1023
}

/// 2^`exponent`, for exponents in the range of normal f64.
pub(super) fn power_of_two(exponent: i32) -> f64 {
    f64::from_bits(((exponent.clamp(-1022, 1023) + 1023) as u64) << 52)
}

/// A direction scaled by a power of two so that its largest component lies in [1/2, 1), and the power.
///
/// `scaled = direction * power`, hence `t = t_scaled * power`.
pub(super) fn normalise_range(direction: [f32; 3]) -> ([f64; 3], f64) {
    let d = direction.map(f64::from);
    let largest = d.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    let power = power_of_two(-1 - floor_log2(largest));
    (d.map(|x| x * power), power)
}

/// The smallest power of two that is not below `x`; 1 for 0.
pub(super) fn ceil_power_of_two(x: f64) -> f64 {
    if x == 0.0 {
        return 1.0;
    }
    let floor = power_of_two(floor_log2(x));
    if floor == x { floor } else { floor * 2.0 }
}

/// The largest power of two `s` with `s * extent <= range`; 1 for an empty scene.
pub(super) fn scale_into(extent: f64, range: f64) -> f64 {
    if extent == 0.0 { 1.0 } else { 1.0 / ceil_power_of_two(extent / range) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_are_powers_of_two() {
        assert_eq!(ceil_power_of_two(5.0), 8.0, "rounds up");
        assert_eq!(ceil_power_of_two(0.25), 0.25, "exact powers stay");
        assert_eq!(scale_into(5.0, 8.0), 1.0, "5 fits 8 as it is");
        assert_eq!(scale_into(17.0, 8.0), 0.25, "17 / 4 fits 8, 17 / 2 does not");
        let (d, power) = normalise_range([0.0, -3.0, 1.0]);
        assert_eq!((d, power), ([0.0, -0.75, 0.25], 0.25), "largest component in [1/2, 1)");
        let (d, _) = normalise_range([f32::from_bits(1), 0.0, 0.0]);
        assert_eq!(d[0], 0.5, "denormal f32 directions too");
    }

    #[test]
    fn lists_are_laid_out_in_squares_and_padded_with_their_last_ray() {
        let ray = |x: usize| Ray::new([x as f32, 0.0, 0.0], [0.0, 0.0, 1.0]).expect("a ray");
        for count in [1, 255, 256, 257, 4096, 5000] {
            let list: Vec<Ray> = (0..count).map(ray).collect();
            let batch = RayBatch::from_list(&list);
            assert_eq!(batch.rays().len(), batch.width() as usize * batch.height() as usize, "a full rectangle");
            for (i, r) in list.iter().enumerate() {
                assert_eq!(batch.rays()[batch.pixel_of(i)], *r, "ray {i} of {count}");
            }
            let last = batch.rays().iter().filter(|r| *r == &ray(count - 1)).count();
            assert_eq!(last, batch.rays().len() - count + 1, "the last one is repeated");
        }
        assert_eq!(RayBatch::from_list(&[ray(1); 3]).common_origin(), Some([1.0, 0.0, 0.0]), "one origin");
        assert_eq!(RayBatch::from_list(&[]).height(), 0, "no rays, no rows");
    }
}

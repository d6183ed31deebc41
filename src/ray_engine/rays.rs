//! Rays and triangles in the units of the card.
//!
//! A card's registers have a range, its ray textures another, its depth buffer a third. The host brings rays and
//! scene into them by powers of two alone, so that no bit of the input is lost before the card rounds it.

/// Rays as a rectangle of pixels, row by row from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct RayBatch {
    /// Rays in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Where the rays start.
    pub origins: Origins,
    /// `width * height` directions, of any length but zero.
    pub directions: Vec<[f32; 3]>,
}

/// Where the rays of a batch start.
#[derive(Clone, Debug, PartialEq)]
pub enum Origins {
    /// All at one point: eye rays, or rays from a point light.
    Common([f32; 3]),
    /// `width * height` points.
    Each(Vec<[f32; 3]>),
}

/// The batch is no rectangle of rays.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RayBatchError {
    /// The lists' lengths and the rectangle differ.
    #[error("expected {expected} {what} for a batch of {width} x {height} rays, found {found}")]
    Count {
        /// What was counted.
        what: &'static str,
        /// Columns.
        width: u32,
        /// Rows.
        height: u32,
        /// `width * height`.
        expected: usize,
        /// The list's length.
        found: usize,
    },
    /// A ray has no direction, or a component is NaN or infinite.
    #[error("ray {ray}: expected finite components and a direction other than zero")]
    BadRay {
        /// The ray's number.
        ray: usize,
    },
}

impl RayBatch {
    /// A batch that has been looked over: counts agree, all components are finite, no direction is zero.
    ///
    /// # Errors
    /// [`RayBatchError`] says which ray or list is wrong.
    pub fn new(
        width: u32,
        height: u32,
        origins: Origins,
        directions: Vec<[f32; 3]>,
    ) -> Result<Self, RayBatchError> {
        let expected = width as usize * height as usize;
        let count = |what, found| {
            if found == expected { Ok(()) } else { Err(RayBatchError::Count { what, width, height, expected, found }) }
        };
        count("directions", directions.len())?;
        let finite = |v: &[f32; 3]| v.iter().all(|x| x.is_finite());
        match &origins {
            Origins::Common(origin) if !finite(origin) => return Err(RayBatchError::BadRay { ray: 0 }),
            Origins::Common(_) => {}
            Origins::Each(each) => {
                count("origins", each.len())?;
                if let Some(ray) = each.iter().position(|o| !finite(o)) {
                    return Err(RayBatchError::BadRay { ray });
                }
            }
        }
        match directions.iter().position(|d| !finite(d) || d.iter().all(|x| *x == 0.0)) {
            Some(ray) => Err(RayBatchError::BadRay { ray }),
            None => Ok(Self { width, height, origins, directions }),
        }
    }

    /// A list of rays, laid out in rows of `width` and padded by repeating the last one.
    /// The answers to the padding are to be dropped. An empty list gives a batch of no rows.
    ///
    /// # Errors
    /// As [`RayBatch::new`].
    pub fn from_list(rays: &[([f32; 3], [f32; 3])], width: u32) -> Result<Self, RayBatchError> {
        let height = u32::try_from(rays.len().div_ceil(width as usize)).unwrap_or(u32::MAX);
        let count = width as usize * height as usize;
        let padded = rays.iter().chain(rays.last().into_iter().cycle()).take(count);
        let (origins, directions) = padded.copied().unzip();
        Self::new(width, height, Origins::Each(origins), directions)
    }

    /// The origin of ray `ray`.
    pub fn origin(&self, ray: usize) -> [f32; 3] {
        match &self.origins {
            Origins::Common(origin) => *origin,
            Origins::Each(each) => each[ray],
        }
    }
}

/// The exponent of the largest power of two that is not above `x`; `x` finite and above zero.
fn floor_log2(x: f64) -> i32 {
    // Denormal f64 can't come from f32 inputs, so the biased exponent says it all.
    ((x.to_bits() >> 52) & 0x7ff) as i32 - 1023
}

/// 2^`exponent`, for exponents in the range of normal f64.
pub fn power_of_two(exponent: i32) -> f64 {
    f64::from_bits(((exponent.clamp(-1022, 1023) + 1023) as u64) << 52)
}

/// A direction scaled by a power of two so that its largest component lies in [1/2, 1), and the power.
///
/// `scaled = direction * power`, hence `t = t_scaled * power`.
pub fn normalise_range(direction: [f32; 3]) -> ([f64; 3], f64) {
    let d = direction.map(f64::from);
    let largest = d.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    let power = power_of_two(-1 - floor_log2(largest));
    (d.map(|x| x * power), power)
}

/// The smallest power of two that is not below `x`; 1 for 0.
pub fn ceil_power_of_two(x: f64) -> f64 {
    if x == 0.0 {
        return 1.0;
    }
    let floor = power_of_two(floor_log2(x));
    if floor == x { floor } else { floor * 2.0 }
}

/// The largest power of two `s` with `s * extent <= range`; 1 for an empty scene.
pub fn scale_into(extent: f64, range: f64) -> f64 {
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
    fn lists_are_padded_with_their_last_ray() {
        let ray = |x| ([x, 0.0, 0.0], [0.0, 0.0, 1.0]);
        let batch = RayBatch::from_list(&[ray(1.0), ray(2.0), ray(3.0)], 2).expect("three good rays");
        assert_eq!((batch.width, batch.height), (2, 2), "two rows of two");
        assert_eq!(batch.origin(3), [3.0, 0.0, 0.0], "the last one is repeated");
    }
}

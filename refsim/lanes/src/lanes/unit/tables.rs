//! Tables of vectorized functions, as arrays of doubles.

use std::sync::LazyLock;

use crate::num::unit::tables::{GT200_RCP, GT200_RSQRT, NV_RCP, NV_RSQ};

/// Tables of reciprocals and of reciprocal roots, indexed by the upper bits of the mantissa, with `C` numbers per
/// entry.
#[derive(Debug)]
pub(crate) struct Tables<const RCP: usize, const C: usize> {
    pub(super) rcp: [[f64; C]; RCP],
    pub(super) rsq: [[f64; C]; 128],
}

impl<const RCP: usize, const C: usize> Tables<RCP, C> {
    fn new(rcp: &[[i64; C]], rsq: &[[i64; C]]) -> Self {
        let double = |row: [i64; C]| row.map(|number| number as f64);
        Self { rcp: std::array::from_fn(|i| double(rcp[i])), rsq: std::array::from_fn(|i| double(rsq[i])) }
    }
}

/// First approximations of the reciprocal and the reciprocal root in the vertex units.
pub(super) static NV: LazyLock<Tables<64, 1>> = LazyLock::new(|| Tables::new(&NV_RCP, &NV_RSQ));
/// Coefficients of GT200.
pub(super) static GT200: LazyLock<Tables<128, 3>> = LazyLock::new(|| Tables::new(&GT200_RCP, &GT200_RSQRT));

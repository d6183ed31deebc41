//! The tables of the chips, read once from `tables/*.csv`, without the files' index column.

use std::sync::LazyLock;

/// A table of `N` columns.
pub type Table<const N: usize> = LazyLock<Vec<[i64; N]>>;

/// Parses a table. A cell that is not a number would read as 0; the files are part of the program, and tests read every
/// row.
fn parse<const N: usize>(text: &str) -> Vec<[i64; N]> {
    let row = |line: &str| {
        let mut row = [0; N];
        for (cell, text) in row.iter_mut().zip(line.split(',').skip(1)) {
            *cell = text.trim().parse().unwrap_or(0);
        }
        row
    };
    text.lines().skip(1).map(row).collect()
}

macro_rules! tables {
    ($($(#[doc = $doc:literal])* $name:ident: $columns:literal = $file:literal;)*) => {$(
        $(#[doc = $doc])*
        pub static $name: Table<$columns> =
            LazyLock::new(|| parse(include_str!(concat!("tables/", $file, ".csv"))));
    )*};
}

tables! {
    /// First approximations of reciprocals, by the upper 6 bits of the mantissa.
    NV_RCP: 1 = "nv_rcp";
    /// First approximations of reciprocal roots: entries for odd exponent fields, then for even ones.
    NV_RSQ: 1 = "nv_rsq";
    /// Base and slope of `2^x - 1` in EXP.
    NV_EXP: 2 = "nv_exp";
    /// Base and slope of the logarithm in LOG.
    NV_LOG: 2 = "nv_log";
    /// Coefficients of LG2.
    NV3X_LG2: 3 = "nv3x_lg2";
    /// Coefficients of EX2.
    NV3X_EX2: 3 = "nv3x_ex2";
    /// Coefficients of SIN and COS.
    NV3X_SINCOS: 3 = "nv3x_sincos";
    /// The contribution of each bit of the mantissa to an angle in turns.
    NV3X_SINCOS_MULTIPLIER: 1 = "nv3x_sincos_multiplier";
    /// Coefficients of RCP.
    GT200_RCP: 3 = "gt200_rcp";
    /// Coefficients of RSQRT.
    GT200_RSQRT: 3 = "gt200_rsqrt";
    /// Coefficients of LG2.
    GT200_LG2: 3 = "gt200_lg2";
    /// Coefficients of SIN and COS.
    GT200_SIN: 3 = "gt200_sin";
    /// Coefficients of EX2.
    GT200_EX2: 3 = "gt200_ex2";
}

//! Tables of cards' units as WGSL functions, which return rows packed into one or two words.

use std::fmt::Write;

use refsim_lanes::num::unit::tables as data;

/// A function that returns row `i` of a table.
fn function(name: &str, width: usize, rows: impl Iterator<Item = Vec<u32>>) -> String {
    let of = if width == 1 { "u32" } else { "vec2<u32>" };
    let row = |row: Vec<u32>| match row.as_slice() {
        [one] => format!("{one}u"),
        row => format!("vec2<u32>({}u, {}u)", row[0], row[row.len() - 1]),
    };
    let rows: Vec<String> = rows.map(row).collect();
    let mut text = format!("\nfn {name}(i: u32) -> {of} {{\n");
    // Writing to a string cannot fail.
    let _ = writeln!(text, "    var rows = array<{of}, {}>({});", rows.len(), rows.join(", "));
    text + "    return rows[i];\n}\n"
}

/// The low 32 bits of a cell's magnitude.
fn word(cell: i64) -> u32 {
    cell.unsigned_abs() as u32
}

/// Tables of the vertex units.
pub(super) fn vertex() -> String {
    let single = |name, table: &[[i64; 1]]| function(name, 1, table.iter().map(|row| vec![word(row[0])]));
    // Rows of one word: a base in the low `bits` bits, and the slope above.
    let linear = |name, table: &[[i64; 2]], bits: u32| {
        function(name, 1, table.iter().map(|row| vec![word(row[0]) | word(row[1]) << bits]))
    };
    // Rows of two words: a base and a slope of 24 bits, each with half of the curvature in the upper 8 bits.
    let quadratic = |name, table: &[[i64; 3]]| {
        let pack = |&[base, slope, curve]: &[i64; 3]| {
            vec![word(base) | (word(curve) & 0xff) << 24, word(slope) | (word(curve) >> 8) << 24]
        };
        function(name, 2, table.iter().map(pack))
    };
    single("v_rcp_row", &data::NV_RCP)
        + &single("v_rsq_row", &data::NV_RSQ)
        + &linear("v_exp_row", &data::NV_EXP, 16)
        + &linear("v_log_row", &data::NV_LOG, 18)
        + &quadratic("v_lg2_row", &data::NV3X_LG2)
        + &quadratic("v_ex2_row", &data::NV3X_EX2)
        + &quadratic("v_sincos_row", &data::NV3X_SINCOS)
        + &single("v_angle_row", &data::NV3X_SINCOS_MULTIPLIER)
}

/// Tables of GT200. The signs of slopes and curvatures are constants in the functions.
pub(super) fn gt200() -> String {
    let rows = |name, table: &[[i64; 3]]| {
        let pack = |&[base, slope, curve]: &[i64; 3]| vec![word(base), word(slope) | word(curve) << 16];
        function(name, 2, table.iter().map(pack))
    };
    rows("g_rcp_row", &data::GT200_RCP)
        + &rows("g_rsq_row", &data::GT200_RSQRT)
        + &rows("g_lg2_row", &data::GT200_LG2)
        + &rows("g_sin_row", &data::GT200_SIN)
        + &rows("g_ex2_row", &data::GT200_EX2)
}

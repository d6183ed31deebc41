//! Tables of GT200 as WGSL functions, which return rows packed into two words.

use std::fmt::Write;

use refsim_lanes::num::unit::tables as data;

/// A function that returns row `i` of a table.
fn function(name: &str, rows: &[[i64; 3]]) -> String {
    let row =
        |&[base, slope, curve]: &[i64; 3]| format!("vec2<u32>({}u, {}u)", word(base), word(slope) | word(curve) << 16);
    let rows: Vec<String> = rows.iter().map(row).collect();
    let mut text = format!("\nfn {name}(i: u32) -> vec2<u32> {{\n");
    // Writing to a string cannot fail.
    let _ = writeln!(text, "    var rows = array<vec2<u32>, {}>({});", rows.len(), rows.join(", "));
    text + "    return rows[i];\n}\n"
}

/// The low 32 bits of a cell's magnitude.
fn word(cell: i64) -> u32 {
    cell.unsigned_abs() as u32
}

/// Tables of GT200. The signs of slopes and curvatures are constants in the functions.
pub(super) fn gt200() -> String {
    function("g_rcp_row", &data::GT200_RCP)
        + &function("g_rsq_row", &data::GT200_RSQRT)
        + &function("g_lg2_row", &data::GT200_LG2)
        + &function("g_sin_row", &data::GT200_SIN)
        + &function("g_ex2_row", &data::GT200_EX2)
}

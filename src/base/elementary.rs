//! Elementary functions by libm, with the same bits on every platform; the standard library's results vary.

pub use libm::{acos, asinh, atan2, cbrt, cosh, exp, expm1 as exp_m1, hypot, log as ln, log10, pow, sincos as sin_cos};

/// Point of the unit circle at `turns` full turns from (1, 0), counter-clockwise. Exact at multiples of a quarter turn.
pub fn on_circle(turns: f64) -> [f64; 2] {
    let quarters = turns * 4.0;
    let whole = (quarters + 0.5).floor();
    let (sin, cos) = sin_cos((quarters - whole) * std::f64::consts::FRAC_PI_2);
    match whole.rem_euclid(4.0) {
        0.0 => [cos, sin],
        1.0 => [-sin, cos],
        2.0 => [-cos, -sin],
        _ => [sin, -cos],
    }
}

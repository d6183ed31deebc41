//! Elementary functions by libm, with the same bits on every platform; the standard library's results vary.

/// Natural logarithm.
pub fn ln(x: f64) -> f64 {
    libm::log(x)
}

/// Logarithm to base 10.
pub fn log10(x: f64) -> f64 {
    libm::log10(x)
}

/// x to the power y.
pub fn pow(x: f64, y: f64) -> f64 {
    libm::pow(x, y)
}

/// e to the power x.
pub fn exp(x: f64) -> f64 {
    libm::exp(x)
}

/// e to the power x minus 1, without cancellation near 0.
pub fn exp_m1(x: f64) -> f64 {
    libm::expm1(x)
}

/// Square root of x^2 + y^2, without overflow.
pub fn hypot(x: f64, y: f64) -> f64 {
    libm::hypot(x, y)
}

/// Cube root.
pub fn cbrt(x: f64) -> f64 {
    libm::cbrt(x)
}

/// Angle of the point (x, y) from the x axis, in radians.
pub fn atan2(y: f64, x: f64) -> f64 {
    libm::atan2(y, x)
}

/// Angle in [0, pi] whose cosine is x.
pub fn acos(x: f64) -> f64 {
    libm::acos(x)
}

/// Hyperbolic cosine.
pub fn cosh(x: f64) -> f64 {
    libm::cosh(x)
}

/// Inverse hyperbolic sine.
pub fn asinh(x: f64) -> f64 {
    libm::asinh(x)
}

/// Sine and cosine of an angle in radians.
pub fn sin_cos(radians: f64) -> (f64, f64) {
    libm::sincos(radians)
}

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

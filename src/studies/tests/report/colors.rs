//! Perception of colors: contrast by WCAG 2, and distances under color vision deficiencies.

use crossbar_base::elementary::pow;

/// Red, green, blue in sRGB.
pub(super) type Color = [u8; 3];

/// Parses a color of a style sheet, such as `#1c1e21`.
pub(super) fn color(text: &str) -> Color {
    let digits = text.trim().strip_prefix('#').expect("a color");
    [0, 2, 4].map(|at| u8::from_str_radix(&digits[at..at + 2], 16).expect("hexadecimal"))
}

/// Matrices of Machado, Oliveira and Fernandes (2009) for linear RGB, at full severity: normal vision, protanopia,
/// deuteranopia and tritanopia.
const VISIONS: [[[f64; 3]; 3]; 4] = [
    [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
    [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
    [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]],
    [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]],
];
/// Linear sRGB to XYZ, divided by the white point.
const TO_XYZ: [[f64; 3]; 3] = [[0.43395, 0.37621, 0.18984], [0.21267, 0.71516, 0.07217], [0.01776, 0.10947, 0.87276]];

fn linear(color: Color) -> [f64; 3] {
    color.map(|byte| {
        let x = f64::from(byte) / 255.0;
        if x <= 0.04045 { x / 12.92 } else { pow((x + 0.055) / 1.055, 2.4) }
    })
}

fn times(matrix: &[[f64; 3]; 3], v: [f64; 3]) -> [f64; 3] {
    matrix.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

/// WCAG contrast ratio, from 1 to 21.
pub(crate) fn contrast(a: Color, b: Color) -> f64 {
    let luminance = |color| times(&TO_XYZ, linear(color))[1];
    let (a, b) = (luminance(a), luminance(b));
    (a.max(b) + 0.05) / (a.min(b) + 0.05)
}

/// Converts linear sRGB to CIELAB.
fn lab(linear: [f64; 3]) -> [f64; 3] {
    let f = |t: f64| if t > 0.008856 { pow(t, 1.0 / 3.0) } else { 7.787 * t + 16.0 / 116.0 };
    let [x, y, z] = times(&TO_XYZ, linear.map(|x| x.clamp(0.0, 1.0))).map(f);
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

/// Smallest CIELAB distance between two of the colors, over all kinds of vision.
pub(crate) fn least_distance(colors: &[Color]) -> f64 {
    let mut least = f64::INFINITY;
    for vision in &VISIONS {
        let seen: Vec<[f64; 3]> = colors.iter().map(|color| lab(times(vision, linear(*color)))).collect();
        for (n, a) in seen.iter().enumerate() {
            for b in &seen[..n] {
                least = least.min((0..3).map(|i| (a[i] - b[i]) * (a[i] - b[i])).sum::<f64>().sqrt());
            }
        }
    }
    least
}

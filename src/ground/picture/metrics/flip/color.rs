//! Color spaces: linear sRGB, XYZ, the opponent space YCxCz, CIELAB.

use crate::elementary::cbrt;

/// Matrix from linear sRGB (IEC 61966-2-1: primaries of Rec. 709, white D65) to CIE XYZ.
const TO_XYZ: [[f64; 3]; 3] = [
    [506_752.0 / 1_228_815.0, 87_881.0 / 245_763.0, 12_673.0 / 70_218.0],
    [87_098.0 / 409_605.0, 175_762.0 / 245_763.0, 12_673.0 / 175_545.0],
    [7_918.0 / 409_605.0, 87_881.0 / 737_289.0, 1_001_167.0 / 1_053_270.0],
];
/// Matrix from CIE XYZ to linear sRGB: the inverse of [`TO_XYZ`].
const FROM_XYZ: [[f64; 3]; 3] = [
    [12_831.0 / 3_959.0, -329.0 / 214.0, -1_974.0 / 3_959.0],
    [-851_781.0 / 878_810.0, 1_648_619.0 / 878_810.0, 36_519.0 / 878_810.0],
    [705.0 / 12_673.0, -2_585.0 / 12_673.0, 705.0 / 667.0],
];
/// White point D65, from its chromaticities (0.3127, 0.3290).
const WHITE: [f64; 3] = [0.3127 / 0.329, 1.0, 0.3583 / 0.329];

fn product(matrix: &[[f64; 3]; 3], vector: [f64; 3]) -> [f64; 3] {
    matrix.map(|row| row[0] * vector[0] + row[1] * vector[1] + row[2] * vector[2])
}

fn relative_xyz(linear: [f64; 3]) -> [f64; 3] {
    let xyz = product(&TO_XYZ, linear);
    [0, 1, 2].map(|i| xyz[i] / WHITE[i])
}

/// Converts linear sRGB to YCxCz: lightness, red-green, yellow-blue.
pub(super) fn to_opponents(linear: [f64; 3]) -> [f64; 3] {
    let [x, y, z] = relative_xyz(linear);
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

/// Converts YCxCz to linear sRGB.
pub(super) fn from_opponents([lightness, cx, cz]: [f64; 3]) -> [f64; 3] {
    let y = (lightness + 16.0) / 116.0;
    let relative = [y + cx / 500.0, y, y - cz / 200.0];
    product(&FROM_XYZ, [0, 1, 2].map(|i| relative[i] * WHITE[i]))
}

/// Converts linear sRGB to CIELAB with the chroma of dark colors reduced (the Hunt effect).
pub(super) fn to_hunt_lab(linear: [f64; 3]) -> [f64; 3] {
    const KNEE: f64 = 6.0 / 29.0;
    let root = |t: f64| if t > KNEE * KNEE * KNEE { cbrt(t) } else { t / (3.0 * KNEE * KNEE) + 4.0 / 29.0 };
    let [x, y, z] = relative_xyz(linear).map(root);
    let lightness = 116.0 * y - 16.0;
    let chroma = 0.01 * lightness;
    [lightness, chroma * 500.0 * (x - y), chroma * 200.0 * (y - z)]
}

/// HyAB distance, for large color differences: absolute difference of lightness plus Euclidean distance of chroma.
pub(super) fn hyab(a: [f64; 3], b: [f64; 3]) -> f64 {
    let [l, x, y] = [0, 1, 2].map(|i| a[i] - b[i]);
    l.abs() + (x * x + y * y).sqrt()
}

//! Rounding hypotheses for interpolated colors that no emulated device implements, applied to the exact planes of the
//! measured gradients.

use super::colors::{GRADIENTS, gradient_quad, is_falling};
use super::rule::Redraw;
use super::table::{Row, table};
use super::values::Values;

/// Hypotheses about how the card rounds an interpolated color, by name. v0 to v2 are a triangle's vertices in the order
/// of a quad's corners 0 to 3: its triangles are (0, 1, 2) and (0, 2, 3).
pub(crate) const WAYS: &[(&str, Redraw)] = &[
    ("256ths toward 128, -1 where v1 = 0", |_, _| each(|p| p.toward_128(1 - p.colors[1]))),
    ("256ths toward 128, -1 where v0 = 1", |_, _| each(|p| p.toward_128(p.colors[0]))),
    ("256ths toward 128, -1 where v2 = 1", |_, _| each(|p| p.toward_128(p.colors[2]))),
    ("256ths toward 128, -1 where v alone in y = 1", |_, _| each(|p| p.toward_128(p.alone(1)))),
    ("256ths toward 128, -1 where v at the tip = 1", |_, _| each(|p| p.toward_128(p.apex()))),
    ("256ths toward 128", |_, _| each(|p| p.toward_128(0))),
    ("256ths toward 128, -1", |_, _| each(|p| p.toward_128(1))),
    ("256ths, cut", |_, _| each(|p| (256 * p.color).div_euclid(p.whole))),
    ("256ths, to nearest", |_, _| each(|p| (512 * p.color + p.whole).div_euclid(2 * p.whole))),
    ("255ths, cut", |_, _| each(|p| (255 * p.color).div_euclid(p.whole))),
    ("255ths, to nearest", |_, _| each(|p| (510 * p.color + p.whole).div_euclid(2 * p.whole))),
];

/// A pixel of a gradient. Positions are in 16ths of a pixel, truncated as on the card.
struct Pixel {
    corners: [[i64; 2]; 3],
    /// Colors at the corners, 0 or 1.
    colors: [i64; 3],
    /// The exact color is `color / whole`.
    color: i64,
    whole: i64,
    /// The measured code.
    code: u8,
}

impl Pixel {
    fn new(row: &Row) -> Self {
        let ([left, mut top, right, mut bottom], across) = gradient_quad(row.text("picture"));
        if across {
            // Two quads of 64 rows, one below the other.
            top = 448.0 / 3.0 + if is_falling(row) { 64.0 } else { 0.0 };
            bottom = top + 64.0;
        }
        let [left, top, right, bottom] = [left, top, right, bottom].map(|place| (16.0 * place) as i64);
        let at = ["column", "row"].map(|name| 16 * row.number::<i64>(name) + 8);
        let quad = [[left, top], [right, top], [right, bottom], [left, bottom]];
        let ends = match (across, is_falling(row)) {
            (false, _) => [0, 0, 1, 1],
            (true, false) => [0, 1, 1, 0],
            (true, true) => [1, 0, 0, 1],
        };
        let is_upper = (at[0] - left) * (bottom - top) > (at[1] - top) * (right - left);
        let chosen: [usize; 3] = if is_upper { [0, 1, 2] } else { [0, 2, 3] };
        let (corners, colors) = (chosen.map(|i| quad[i]), chosen.map(|i| ends[i]));
        let cross =
            |p: [i64; 2], q: [i64; 2], r: [i64; 2]| (q[0] - p[0]) * (r[1] - p[1]) - (r[0] - p[0]) * (q[1] - p[1]);
        let [p, q, r] = corners;
        let (whole, second, third) = (cross(p, q, r), cross(p, at, r), cross(p, q, at));
        assert!(whole > 0, "rows count downward");
        let color = colors[0] * whole + (colors[1] - colors[0]) * second + (colors[2] - colors[0]) * third;
        let exact = color as f64 / whole as f64 * 256.0;
        assert!((exact - row.number::<f64>("exact_256ths")).abs() < 1e-4, "the exact color of the file");
        Self { corners, colors, color, whole, code: row.number("code") }
    }

    /// The color in 256ths, minus `less`, rounded toward 128.
    fn toward_128(&self, less: i64) -> i64 {
        128 + (256 * self.color - (128 + less) * self.whole) / self.whole
    }

    /// Color of the vertex that shares its coordinate on this axis with no other vertex.
    fn alone(&self, axis: usize) -> i64 {
        let shared = |i: usize| self.corners.iter().filter(|corner| corner[axis] == self.corners[i][axis]).count();
        self.colors[(0..3).min_by_key(|&i| shared(i)).expect("three vertices")]
    }

    /// Color of the vertex opposite the shortest edge.
    fn apex(&self) -> i64 {
        let square = |i: usize| {
            let [p, q] = [self.corners[(i + 1) % 3], self.corners[(i + 2) % 3]];
            (p[0] - q[0]).pow(2) + (p[1] - q[1]).pow(2)
        };
        self.colors[(0..3).min_by_key(|&i| square(i)).expect("three vertices")]
    }
}

fn each(code: fn(&Pixel) -> i64) -> Values {
    let mut values = Values::default();
    for pixel in table(GRADIENTS).iter().map(Pixel::new) {
        values.add_code(pixel.code, code(&pixel).clamp(0, 255) as u8);
    }
    values
}

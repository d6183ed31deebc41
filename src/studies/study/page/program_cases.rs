//! The programs of the page as case files: pixel programs of the systems, with inputs for a picture of 16 x 16 pixels.
//!
//! Row 0 is the upper one. Textures are computed by rational operations and square roots alone, so that they have the
//! same bits everywhere.

use std::fmt::Write as _;

use crate::card::WrittenKernel;
use crate::cpca::kernels::ExitKernel;
use crate::radiosity::kernels::LUMINANCE_NEXT;
use crate::ray_engine::kernels::{FLOAT, ONE_ORIGIN_SETUP, ONE_ORIGIN_UNSIGNED, SEVEN_VECTORS_SETUP};
use crate::subsurface::kernels::LIGHT_TEXELS;

pub(super) const SIDE: u32 = 16;

pub(super) struct ProgramCase {
    pub(super) name: &'static str,
    pub(super) title: &'static str,
    pub(super) about: &'static str,
    pub(super) device: &'static str,
    /// Register formats other than the device's own.
    pub(super) formats: [&'static str; 2],
    pixel: String,
    vertex: Option<&'static str>,
    /// Tables of the case after the programs.
    tables: String,
}

impl ProgramCase {
    /// The case file, with registers in `format`, or in the device's own format if it is `None`.
    pub(super) fn text(&self, format: Option<&str>) -> String {
        let [head, rest] = self.parts();
        let line = format.map_or_else(String::new, |format| format!("format = \"{format}\"\n"));
        head + &line + &rest
    }

    /// The case file before and after the line of its format.
    pub(super) fn parts(&self) -> [String; 2] {
        let Self { title, about, device, pixel, .. } = self;
        let head = format!("# {about}\ntitle = \"{title}\"\ndevice = \"{device}\"\n");
        let mut rest = format!("\n[pixel]\nsource = '''\n{pixel}'''\n");
        if let Some(vertex) = self.vertex {
            let _ = write!(rest, "\n[vertex]\nsource = '''\n{vertex}'''\n");
        }
        [head, rest + "\n" + &self.tables]
    }
}

pub(super) fn all() -> [ProgramCase; 5] {
    [one_origin(), any_origin(), radiosity(), subsurface(), exit_radiance()]
}

/// A texture as a table: `texel` gives the channels at a column and row.
fn texture<const CHANNELS: usize>(
    slot: usize,
    more: &str,
    [width, height]: [u32; 2],
    texel: impl Fn(u32, u32) -> [f64; CHANNELS],
) -> String {
    let mut text = format!("\n[[texture]]\nslot = {slot}\n{more}\nsize = [{width}, {height}]\ntexels = [\n");
    for y in 0..height {
        for x in 0..width {
            // Single precision has few digits, and is enough for every texel format.
            let channels = texel(x, y).map(|value| (value as f32).to_string()).join(", ");
            let _ = write!(text, "[{channels}],");
        }
        text.push('\n');
    }
    text + "]\n"
}

/// Center of a pixel or texel in [-1, 1], y upwards.
fn center(x: u32, y: u32) -> [f64; 2] {
    let side = f64::from(SIDE);
    [(2.0 * f64::from(x) + 1.0) / side - 1.0, 1.0 - (2.0 * f64::from(y) + 1.0) / side]
}

const RECTANGLE: &str = "kind = \"rectangle\"\nformat = \"rgba32f\"";
const FLAT: &str = "format = \"rgba32f\"\naddress = \"clamp\"";
const TARGET: &str = "[target]\nsize = [16, 16]\nformat = \"bgra8\"\nclear = [0, 0, 0, 0]\n";
/// The triangle of both intersection programs, drawn over the whole picture as the Ray Engine does.
const TRIANGLE: &str = "[geometry]\nprimitive = \"quads\"\nconvention = \"opengl\"\nattributes = { v1 = [-1.5, -1.25, 1], \
     v2 = [0.25, 1.75, 1.25, 1], v3 = [1.25, -0.75, 1], v4 = [1, 0.625, 0.125, 1] }\nvertices = [\n    \
     { v0 = [-1, -1, 0, 0] },\n    { v0 = [1, -1, 1, 0] },\n    { v0 = [1, 1, 1, 1] },\n    { v0 = [-1, 1, 0, 1] },\n]\n\n\
     [depth]\ntest = \"less\"\nwrite = true\n\n";

fn one_origin() -> ProgramCase {
    let codes = |components: [f64; 2]| components.map(|x| (65535.0 * (x + 1.0) / 2.0).round());
    // The card has no signed textures of 16 bits.
    let unsigned = "format = \"rg16\"\nraw = true\naddress = \"clamp\"";
    ProgramCase {
        name: "intersection",
        title: "Ray Engine (2002): ray against triangle, one origin",
        about: "Each pixel is a ray, and all rays have one origin; one triangle is drawn over all pixels.",
        device: "r200",
        formats: ["e5m10", "e8m23"],
        pixel: ONE_ORIGIN_UNSIGNED.text.to_owned(),
        vertex: Some(ONE_ORIGIN_SETUP.text),
        tables: format!(
            "[vertex_constants]\nc1 = [1, 0, 0.125, 0]\nc2 = [0, 0, 0, 1]\n\n{TRIANGLE}[alpha]\ntest = \"greater\"\nreference = 0\n\n{TARGET}"
        ) + &texture(1, unsigned, [SIDE, SIDE], |x, y| codes(center(x, y)))
            + &texture(2, unsigned, [SIDE, SIDE], |_, _| codes([0.5, 0.0])),
    }
}

fn any_origin() -> ProgramCase {
    let third = |[x, y]: [f64; 2]| [x / 3.0, y / 3.0, 0.5 / 3.0, 0.0];
    let origin = |[x, y]: [f64; 2]| [x / 8.0, y / 8.0, 0.0, 0.0];
    ProgramCase {
        name: "intersection-any-origin",
        title: "Ray Engine (2002): ray against triangle, any origin",
        about: "Each pixel is a ray with its own origin and direction.",
        device: "r300",
        formats: ["e5m10", "e8m23"],
        pixel: FLOAT.text.to_owned(),
        vertex: Some(SEVEN_VECTORS_SETUP.text),
        tables: format!(
            "[constants]\nc0 = [0.125, 0, 0, 0]\n\n[vertex_constants]\nc1 = [1, 0, 0, 0]\n\n{TRIANGLE}{TARGET}"
        ) + &texture(0, FLAT, [SIDE, SIDE], |x, y| origin(center(x, y)))
            + &texture(1, FLAT, [SIDE, SIDE], |x, y| third(center(x, y))),
    }
}

fn radiosity() -> ProgramCase {
    /// Texels per row of a block of the matrix; each texel holds four columns.
    const BLOCK: u32 = 4;
    // Minus reflectance times form factor between patches of the floor and the lamp, with centers at distance 1.
    let factor = |patch: u32, source: u32| {
        let [x, y] = center(patch % SIDE, patch / SIDE);
        let dx = x - (f64::from(source % 4) - 1.5) / 4.0 - 0.25;
        let dy = y - (f64::from(source / 4) - 1.5) / 4.0;
        let square = dx * dx + dy * dy + 1.0;
        -0.7 / (16.0 * std::f64::consts::PI * square * square)
    };
    let rows = SIDE * SIDE;
    let geometry = "[geometry]\nprimitive = \"quads\"\nconvention = \"opengl\"\nvertices = [\n    \
         { position = [-1, -1], t0 = [0.5, -8, 0.5], t1 = [-8, 0.5] },\n    \
         { position = [1, -1], t0 = [0.5, 8, 0.5], t1 = [8, 0.5] },\n    \
         { position = [1, 1], t0 = [0.5, 264, 0.5], t1 = [264, 0.5] },\n    \
         { position = [-1, 1], t0 = [0.5, 248, 0.5], t1 = [248, 0.5] },\n]\n\n";
    ProgramCase {
        name: "radiosity",
        title: "Matrix radiosity (2003): a block of matrix times vector",
        about: "Each pixel is a patch of a floor, which gets light from 16 patches of a lamp in one pass.",
        device: "nv35",
        formats: ["e5m10", "e7m16"],
        pixel: LUMINANCE_NEXT.unrolled(BLOCK as usize),
        vertex: None,
        tables: format!("{geometry}{TARGET}")
            + &texture(0, RECTANGLE, [BLOCK, rows], |x, row| [0, 1, 2, 3].map(|k| factor(row, 4 * x + k)))
            + &texture(1, RECTANGLE, [BLOCK, 1], |x, _| [0, 1, 2, 3].map(|k| 4.0 + f64::from(4 * x + k) / 8.0))
            + &texture(2, RECTANGLE, [rows, 1], |x, _| [f64::from((x ^ (x / SIDE)) & 1) / 20.0; 4]),
    }
}

fn subsurface() -> ProgramCase {
    // A dome over the square.
    let position = |[x, y]: [f64; 2]| [x, y, 1.0 - (x * x + y * y) / 2.0, 1.0];
    let normal = |[x, y]: [f64; 2]| {
        let length = (x * x + y * y + 1.0).sqrt();
        [x / length, y / length, 1.0 / length, 0.0]
    };
    let geometry = "[geometry]\nprimitive = \"quads\"\nconvention = \"opengl\"\nvertices = [\n    \
         { position = [-1, -1], t0 = [0, 0] },\n    { position = [1, -1], t0 = [16, 0] },\n    \
         { position = [1, 1], t0 = [16, 16] },\n    { position = [-1, 1], t0 = [0, 16] },\n]\n\n";
    ProgramCase {
        name: "subsurface",
        title: "Subsurface scattering (2003): light that enters the surface",
        about: "Each pixel is a texel of the surface, lit by one OpenGL light.",
        device: "nv35",
        formats: ["e5m10", "e7m16"],
        pixel: LIGHT_TEXELS.text.to_owned(),
        vertex: None,
        tables: format!(
            "[constants]\n\"p[0]\" = [0.69, 1.69, 1.3, 0.0001]\n\"p[1]\" = [0.03, 0.04, 0.06, 4]\n\
             \"p[2]\" = [0.75, 0.5, 1.75, 1]\n\"p[3]\" = [1.6, 1.35, 1.1, 0]\n\"p[4]\" = [0.25, 0.125, 0.5, 0]\n\n{geometry}{TARGET}"
        ) + &texture(0, RECTANGLE, [SIDE, SIDE], |x, y| position(center(x, y)))
            + &texture(1, RECTANGLE, [SIDE, SIDE], |x, y| normal(center(x, y))),
    }
}

fn exit_radiance() -> ProgramCase {
    // Spherical harmonics over parabolic coordinates.
    let harmonics = |[p, q]: [f64; 2]| {
        let square = p * p + q * q;
        let [x, y, z] = [2.0 * p, 2.0 * q, 1.0 - square].map(|component| component / (1.0 + square));
        let second = [1.092_548 * x * y, 1.092_548 * y * z, 0.315_392 * (3.0 * z * z - 1.0), 1.092_548 * x * z];
        [[0.282_095, 0.488_603 * y, 0.488_603 * z, 0.488_603 * x], second]
    };
    // Rows of a map run from -1 to 1.
    let map = |slot: usize| {
        texture(slot, FLAT, [SIDE, SIDE], |x, y| {
            let [p, q] = center(x, y);
            harmonics([p, -q])[slot]
        })
    };
    let geometry = "[geometry]\nprimitive = \"quads\"\nconvention = \"opengl\"\n\
         attributes = { t0 = [0.9, 0.2, 0.6, -0.3], t1 = [0.25, 0.3, 0.45, -0.2] }\nvertices = [\n    \
         { position = [-1, -1], t2 = [-1, 1, 1] },\n    { position = [1, -1], t2 = [1, 1, 1] },\n    \
         { position = [1, 1], t2 = [1, -1, 1] },\n    { position = [-1, 1], t2 = [-1, -1, 1] },\n]\n\n";
    ProgramCase {
        name: "exit-radiance",
        title: "CPCA (2003): exit radiance at the view vector",
        about: "Each pixel shows one point from another direction; eight coefficients weight eight functions.",
        device: "r300",
        formats: ["e5m10", "e8m23"],
        pixel: ExitKernel { registers: 2 }.text(),
        vertex: None,
        tables: format!("{geometry}{TARGET}") + &map(0) + &map(1),
    }
}

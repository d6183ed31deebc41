//! Layouts of pictures of the whole sphere: lat-long, angular probe, cube cross, cube strip.
//!
//! In the first three the picture's middle is +y, its right +x, and its top +z, as a viewer sees a scene with z up.
//! In y-up conventions these are -Z, +X and +Y.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::cube::{CUBE_FACES, FaceAxes, face_solid_angle};
use crate::elementary::{atan2, hypot, on_circle, sin_cos};
use crate::quadrature::{GaussPoint, gauss_legendre};

/// Layout of a picture of the whole sphere.
#[derive(Clone, Copy, Debug, PartialEq, Eq, strum::Display, strum::EnumIter)]
pub enum EnvironmentLayout {
    /// Width twice the height: rows are polar angles from +z, columns azimuths; -y is at both sides.
    #[strum(to_string = "lat-long")]
    LatLong,
    /// A square: the distance from the middle is proportional to the angle from +y; -y is the rim of the inscribed
    /// circle. Pixels beyond it are ignored.
    #[strum(to_string = "angular probe")]
    AngularProbe,
    /// An unfolded cube seen from inside, six squares of a grid of 4 x 3 or 3 x 4. Around the middle square are the
    /// right, left, upper and lower ones; the back is beyond the right square (4 x 3), or upside down beyond the lower
    /// square (3 x 4). Other squares are ignored.
    #[strum(to_string = "cube cross")]
    CubeCross,
    /// Six squares one below the other: the faces of a cube map, in the order and orientation of
    /// [`CUBE_FACES`](super::CUBE_FACES).
    #[strum(to_string = "cube strip")]
    CubeStrip,
}

impl EnvironmentLayout {
    /// The layout of pictures of this shape, if there is one; no two layouts share a shape.
    pub fn of(width: u32, height: u32) -> Option<Self> {
        let [w, h] = [u64::from(width), u64::from(height)];
        let cross = (3 * w == 4 * h && h % 3 == 0) || (4 * w == 3 * h && w % 3 == 0);
        match () {
            () if w * h == 0 => None,
            () if w == 2 * h => Some(Self::LatLong),
            () if w == h => Some(Self::AngularProbe),
            () if cross => Some(Self::CubeCross),
            () if h == 6 * w => Some(Self::CubeStrip),
            () => None,
        }
    }
}

/// Texels of a picture in the layout of its shape.
#[derive(Debug)]
pub(super) struct LayoutGrid {
    layout: EnvironmentLayout,
    width: usize,
    height: usize,
    /// Quadrature for the edges of a probe's pixels.
    edge_rule: Vec<GaussPoint>,
}

impl LayoutGrid {
    pub(super) fn new(layout: EnvironmentLayout, width: usize, height: usize) -> Self {
        Self { layout, width, height, edge_rule: gauss_legendre(if width < 32 { 16 } else { 6 }) }
    }

    /// Returns `true` if a pixel shows a direction.
    pub(super) fn shows(&self, column: usize, row: usize) -> bool {
        self.solid_angle(column, row) > 0.0
    }

    /// Index, row by row, of the pixel that shows a unit direction. A direction on the border of two pixels may give
    /// either.
    pub(super) fn pixel(&self, direction: DVec3) -> usize {
        let within = |at: f64, count: usize| (at.max(0.0) as usize).min(count - 1);
        let [width, height] = [self.width, self.height];
        let across = hypot(direction.x, direction.z);
        let [column, row] = match self.layout {
            EnvironmentLayout::LatLong => {
                let turns = atan2(direction.x, direction.y) / TAU + 0.5;
                let polar = atan2(hypot(direction.x, direction.y), direction.z) / PI;
                [within(turns * width as f64, width), within(polar * height as f64, height)]
            }
            EnvironmentLayout::AngularProbe => {
                let scale = if across > 0.0 { atan2(across, direction.y) / PI / across } else { 0.0 };
                let [x, y] = [scale * direction.x, scale * direction.z];
                let (width, side) = (width as f64 / 2.0, width);
                [within((1.0 + x) * width, side), within((1.0 - y) * width, side)]
            }
            EnvironmentLayout::CubeCross | EnvironmentLayout::CubeStrip => return self.cube_pixel(direction),
        };
        row * width + column
    }

    /// Pixel of a cube, on the face of the direction's largest component (on ties, the first).
    fn cube_pixel(&self, direction: DVec3) -> usize {
        let side = self.cube_side();
        let tiles = (0..self.height / side).flat_map(|row| (0..self.width / side).map(move |column| [column, row]));
        let faces = tiles.filter_map(|[column, row]| {
            let (axes, ..) = self.cube_texel(column * side, row * side)?;
            Some((axes.center.dot(direction), axes, [column, row]))
        });
        let most = faces.reduce(|best, face| if face.0 > best.0 { face } else { best });
        let Some((ahead, axes, [column, row])) = most else { return 0 };
        let place = |axis: DVec3| {
            let at = (axis.dot(direction) / ahead + 1.0) / 2.0 * side as f64;
            (at.max(0.0) as usize).min(side - 1)
        };
        (row * side + place(axes.down)) * self.width + column * side + place(axes.right)
    }

    /// Edges of a probe's pixel, in the square from -1 to 1 with y up: left, bottom, right, top.
    fn probe_pixel(&self, [column, row]: [usize; 2]) -> [f64; 4] {
        let edge = |at: usize| 2.0 * at as f64 / self.width as f64 - 1.0;
        [edge(column), -edge(row + 1), edge(column + 1), -edge(row)]
    }

    /// Face of a cube that contains a pixel, and the pixel's column and row on the face.
    fn cube_texel(&self, column: usize, row: usize) -> Option<(FaceAxes, usize, usize)> {
        let (side, wide) = (self.cube_side(), self.width > self.height);
        let [right, up] = [DVec3::X, DVec3::Z];
        let face = |center, right, down| Some(FaceAxes { center, right, down });
        let axes = match (column / side, row / side) {
            (_, face) if self.layout == EnvironmentLayout::CubeStrip => Some(CUBE_FACES[face]),
            (1, 0) => face(up, right, DVec3::Y),
            (0, 1) => face(-right, DVec3::Y, -up),
            (1, 1) => face(DVec3::Y, right, -up),
            (2, 1) => face(right, -DVec3::Y, -up),
            (1, 2) => face(-up, right, -DVec3::Y),
            (3, 1) if wide => face(-DVec3::Y, -right, -up),
            (1, 3) if !wide => face(-DVec3::Y, right, up),
            _ => None,
        };
        axes.map(|axes| (axes, column % side, row % side))
    }

    fn cube_side(&self) -> usize {
        if self.layout == EnvironmentLayout::CubeStrip { self.width } else { self.width.max(self.height) / 4 }
    }

    /// Number of columns and rows.
    pub(super) fn size(&self) -> [usize; 2] {
        [self.width, self.height]
    }

    /// Solid angle of a pixel, 0 if it shows no direction.
    pub(super) fn solid_angle(&self, column: usize, row: usize) -> f64 {
        match self.layout {
            EnvironmentLayout::LatLong => {
                // cos a - cos b = 2 sin((a + b) / 2) sin((b - a) / 2).
                let half_turns = |at: f64| on_circle(at / (2.0 * self.height as f64))[1];
                TAU / self.width as f64 * 2.0 * half_turns(row as f64 + 0.5) * half_turns(0.5)
            }
            EnvironmentLayout::AngularProbe => probe_solid_angle(self.probe_pixel([column, row]), &self.edge_rule),
            EnvironmentLayout::CubeCross | EnvironmentLayout::CubeStrip => self
                .cube_texel(column, row)
                .map_or(0.0, |(_, column, row)| face_solid_angle(self.cube_side(), column, row)),
        }
    }

    /// Returns the direction at u, v in [0, 1] of a pixel that shows directions, and a density proportional to solid
    /// angle per du dv.
    pub(super) fn at(&self, texel: [usize; 2], u: f64, v: f64) -> (DVec3, f64) {
        let [column, row] = texel.map(|at| at as f64);
        match self.layout {
            EnvironmentLayout::LatLong => {
                let [cos_polar, sin_polar] = on_circle((row + v) / (2.0 * self.height as f64));
                // Azimuth from +y towards +x.
                let [cos, sin] = on_circle((column + u) / self.width as f64 - 0.5);
                (DVec3::new(sin * sin_polar, cos * sin_polar, cos_polar), sin_polar)
            }
            EnvironmentLayout::AngularProbe => {
                let [left, bottom, right, top] = self.probe_pixel(texel);
                probe_direction(left + u * (right - left), top + v * (bottom - top))
            }
            EnvironmentLayout::CubeCross | EnvironmentLayout::CubeStrip => {
                let side = self.cube_side() as f64;
                match self.cube_texel(texel[0], texel[1]) {
                    Some((axes, column, row)) => axes.at([(column as f64 + u) / side, (row as f64 + v) / side]),
                    None => (DVec3::Y, 0.0),
                }
            }
        }
    }
}

/// Direction at a point of an angular probe, and the density of solid angle there: pi sin(pi r) / r.
fn probe_direction(x: f64, y: f64) -> (DVec3, f64) {
    let r = hypot(x, y);
    if r >= 1.0 {
        return (-DVec3::Y, 0.0);
    }
    let (sin, cos) = sin_cos(PI * r);
    let across = if r > 0.0 { sin / r } else { PI };
    (DVec3::new(across * x, cos, across * y), PI * across)
}

/// Solid angle of a pixel within the unit circle of an angular probe.
///
/// The solid angle is the integral of (1 - cos(pi r)) dphi around the pixel's part of the disk, counter-clockwise.
/// Along a straight edge the integrand is F(r) (x dy - y dx) with F = (1 - cos(pi r)) / r^2, which is smooth
/// everywhere; along the rim it is 2 dphi.
fn probe_solid_angle([left, bottom, right, top]: [f64; 4], rule: &[GaussPoint]) -> f64 {
    let density = |r: f64| {
        let (sin, _) = sin_cos(PI / 2.0 * r);
        if r > 1e-8 { 2.0 * (sin / r) * (sin / r) } else { PI * PI / 2.0 }
    };
    // Edges counter-clockwise, each cut to the disk.
    let edges = [
        cut(bottom, left, right).map(|[a, b]| [[a, bottom], [b, bottom]]),
        cut(right, bottom, top).map(|[a, b]| [[right, a], [right, b]]),
        cut(top, left, right).map(|[a, b]| [[b, top], [a, top]]),
        cut(left, bottom, top).map(|[a, b]| [[left, b], [left, a]]),
    ];
    let within: Vec<[[f64; 2]; 2]> = edges.into_iter().flatten().collect();
    let mut sum = 0.0;
    for (at, [[x0, y0], [x1, y1]]) in within.iter().enumerate() {
        // x dy - y dx is constant along a straight line.
        let around = x0 * y1 - y0 * x1;
        let along = rule.iter().map(|&(t, weight)| weight * density(hypot(x0 + t * (x1 - x0), y0 + t * (y1 - y0))));
        sum += around * along.sum::<f64>();
        let [x2, y2] = within[(at + 1) % within.len()][0];
        // Along the rim to the start of the next edge; a corner within the disk adds nothing.
        sum += 2.0 * atan2(x1 * y2 - y1 * x2, x1 * x2 + y1 * y2);
    }
    sum.max(0.0)
}

/// Part inside the unit circle of the segment from a to b on a line at distance `offset` from the middle.
fn cut(offset: f64, a: f64, b: f64) -> Option<[f64; 2]> {
    let square = (1.0 - offset) * (1.0 + offset);
    let half = (square >= 0.0).then(|| square.sqrt())?;
    (a <= half && b >= -half).then(|| [a.max(-half), b.min(half)])
}

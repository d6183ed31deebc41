//! Pinhole camera.

use glam::{DMat3, DVec3};

use crate::error::{InputError, ensure, input_error};
use crate::geom::vector::{narrow, unit, wide};
use crate::geom::{Ray, UnitFrame};

/// Maximum tangent of half the field of view.
const MAX_TANGENT: f32 = 1e6;

/// Sine of the smallest angle between `up` and the view.
const MIN_SINE: f64 = 1e-6;

/// Near distance for bodies drawn in a frame, in units of the frame.
const NEAREST: f64 = 1e-3;

/// Pinhole camera: one ray through the centre of each pixel, pixel (0, 0) at the upper left.
///
/// All arithmetic is f64 additions, multiplications, divisions and square roots in a fixed order, rounded to f32 once
/// at the end: the same bits everywhere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    eye: [f32; 3],
    width: u32,
    height: u32,
    /// Unit vector to the target.
    forward: DVec3,
    /// Vector from the centre of the picture to its right edge, in the plane at distance 1.
    right: DVec3,
    /// Vector from the centre of the picture to its upper edge, in the plane at distance 1.
    up: DVec3,
}

fn flat_error() -> InputError {
    input_error!(
        "eye, target and up define no picture plane: expected a target away from the eye, and an up \
         vector not along the view"
    )
}

impl Camera {
    /// Creates a camera at `eye` that looks at `target`, with `up` upwards in the picture. `tan_half_height` is the
    /// tangent of half the vertical field of view; pixels are square.
    pub fn new(
        eye: [f32; 3],
        target: [f32; 3],
        up: [f32; 3],
        tan_half_height: f32,
        width: u32,
        height: u32,
    ) -> Result<Self, InputError> {
        // This is checked first, because callers derive the eye from the tangent.
        ensure!(
            tan_half_height > 0.0 && tan_half_height <= MAX_TANGENT,
            "expected a tangent of half the vertical field of view above 0 and up to 1000000, found {tan_half_height}"
        );
        for (what, found) in [("eye", eye), ("target", target), ("up", up)] {
            ensure!(found.iter().all(|value| value.is_finite()), "expected finite figures for {what}, found {found:?}");
        }
        let pixels = u64::from(width) * u64::from(height);
        ensure!((1..=1 << 30).contains(&pixels), "expected a picture of 1 to 2^30 pixels, found {width}x{height}");
        let [from, to, up] = [eye, target, up].map(wide);
        let forward = unit(to - from).ok_or_else(flat_error)?;
        let sideways = forward.cross(unit(up).ok_or_else(flat_error)?);
        if sideways.length() < MIN_SINE {
            return Err(flat_error());
        }
        let right = unit(sideways).ok_or_else(flat_error)?;
        let up = right.cross(forward);
        let half_height = f64::from(tan_half_height);
        let half_width = half_height * f64::from(width) / f64::from(height);
        Ok(Self { eye, width, height, forward, right: right * half_width, up: up * half_height })
    }

    /// Creates the camera of the studies: a three-quarter view of the teapot from the front, a little from above, spout
    /// to the right. The teapot fills a square picture.
    pub fn teapot(width: u32, height: u32) -> Result<Self, InputError> {
        Self::new([2.125, -5.625, 3.875], [0.625, 0.0, 1.3125], [0.0, 0.0, 1.0], 0.5625, width, height)
    }

    /// Returns the camera rotated around a point.
    pub fn carried(&self, about: DVec3, turn: &DMat3) -> Self {
        let eye = narrow(about + *turn * (wide(self.eye) - about));
        let [forward, right, up] = [self.forward, self.right, self.up].map(|axis| *turn * axis);
        Self { eye, forward, right, up, ..*self }
    }

    /// Origin of all rays.
    pub fn eye(&self) -> [f32; 3] {
        self.eye
    }

    /// Width in pixels.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Height in pixels.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// Unit vector along the middle of the view; the direction of every pixel has component 1 along it.
    pub fn forward(&self) -> DVec3 {
        self.forward
    }

    /// Returns the direction through the centre of a pixel, unnormalised: its component along the view is 1. Pixels
    /// outside the picture continue its plane.
    pub fn direction(&self, x: u32, y: u32) -> [f32; 3] {
        narrow(self.direction_at(f64::from(x) + 0.5, f64::from(y) + 0.5))
    }

    /// Returns the ray through the centre of a pixel, unnormalised.
    pub fn ray(&self, x: u32, y: u32) -> Ray {
        Ray::new(self.eye, self.direction(x, y)).expect("a pixel's direction is finite and not zero")
    }

    /// Returns the rays of all pixels, row by row from the upper left.
    pub fn rays(&self) -> Vec<Ray> {
        (0..self.height).flat_map(|y| (0..self.width).map(move |x| self.ray(x, y))).collect()
    }

    /// Vector from the centre of the picture to its right edge, in the plane at distance 1.
    pub fn right(&self) -> DVec3 {
        self.right
    }

    /// Vector from the centre of the picture to its upper edge, in the plane at distance 1.
    pub fn up(&self) -> DVec3 {
        self.up
    }

    /// Matrix from scene to camera coordinates for row vectors: x to the right, y up, z along the view.
    pub fn world_to_camera(&self) -> [f32; 16] {
        let [right, up] = [self.right, self.up].map(|axis| unit(axis).unwrap_or(axis));
        let (axes, eye) = ([right, up, self.forward], wide(self.eye));
        let row = |component: usize| axes.map(|axis| axis[component] as f32);
        let [moved_x, moved_y, moved_z] = axes.map(|axis| -axis.dot(eye) as f32);
        let ([a, b, c], [d, e, f], [g, h, i]) = (row(0), row(1), row(2));
        [a, b, c, 0.0, d, e, f, 0.0, g, h, i, 0.0, moved_x, moved_y, moved_z, 1.0]
    }

    /// Rows of the matrix from a body's frame, with w = 1, to clip space: x to the right, y up, z from 0 at the body's
    /// near side to w at its far side, w the distance along the view. If the eye is inside the body, the near plane is
    /// 0.001 units in front of the eye.
    pub fn clip_rows(&self, frame: &UnitFrame) -> [[f32; 4]; 4] {
        let eye = frame.of_scene(wide(self.eye));
        let per_square = |v: DVec3| v / v.dot(v);
        let row = |axis: DVec3, scale: f64, offset: f64| {
            let [x, y, z] = (axis * scale).to_array();
            [x, y, z, offset - scale * axis.dot(eye)].map(|value| value as f32)
        };
        let along = -self.forward.dot(eye);
        let near = (along - 1.0).max(NEAREST);
        let far = (along + 1.0).max(2.0 * NEAREST);
        let depth = far / (far - near);
        [
            row(per_square(self.right), 1.0, 0.0),
            row(per_square(self.up), 1.0, 0.0),
            row(self.forward, depth, -near * depth),
            row(self.forward, 1.0, 0.0),
        ]
    }

    /// Returns the direction through any point of the picture, in pixels from its upper left corner, before rounding to
    /// f32; the centre of pixel (0, 0) is at (0.5, 0.5).
    pub fn direction_at(&self, x: f64, y: f64) -> DVec3 {
        let across = 2.0 * x / f64::from(self.width) - 1.0;
        let upwards = 1.0 - 2.0 * y / f64::from(self.height);
        self.forward + across * self.right + upwards * self.up
    }
}

//! Attribute interpolation: weights, then a fixed sequence of rounded operations per component.

use super::plane::{Plane, plane};
use super::state::PixelCenter;
use super::triangle::TriangleSetup;
use super::vertex::{COLOR_COMPONENT, ComponentMask, FOG_COMPONENT, POSITION_COMPONENT};
use crate::num::{self, Format};
use crate::texture::value;

/// Interpolated inputs of a pixel program. All numbers are FP32 bits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FragmentInput {
    /// Texture coordinate sets.
    pub t: [[u32; 4]; 8],
    /// Interpolated colours, before clamping and rounding to the precision of the colour iterator.
    pub v: [[u32; 4]; 2],
    /// Fog factor.
    pub fog: u32,
    /// Depth.
    pub depth: u32,
    /// Window position: column and row of the pixel's centre, depth, and 1 / w of clip space.
    pub position: [u32; 4],
}

/// Barycentric weights of vertices 1 and 2 at a pixel, as FP32 bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Weights {
    /// Weights linear in screen space; for depth.
    pub linear: [u32; 2],
    /// Perspective-correct weights; for all other components.
    pub perspective: [u32; 2],
}

impl TriangleSetup {
    /// Weights at a pixel's centre, which may lie outside the triangle.
    ///
    /// `l1 = E1/A` and `l2 = E2/A`, with the exact integers first rounded to FP32. Unless all w are equal,
    /// `g0 = ((1-l1)-l2) * (1/w0)`, `g1 = l1 * (1/w1)`, `g2 = l2 * (1/w2)`, `s = (g0+g1)+g2`, and the weights are
    /// `g1/s` and `g2/s`. Each step is rounded to FP32.
    pub fn weights(&self, x: u32, y: u32) -> Weights {
        let share = |i: usize| value::div(value::from_integer(self.edges[i].at(x, y)), self.area_bits);
        let linear = [share(1), share(2)];
        if self.affine {
            return Weights { linear, perspective: linear };
        }
        let [l1, l2] = linear;
        let l0 = value::sub(value::sub(value::ONE, l1), l2);
        let [r0, r1, r2] = self.reciprocal_w;
        let (g0, g1, g2) = (value::mul(l0, r0), value::mul(l1, r1), value::mul(l2, r2));
        let sum = value::add(value::add(g0, g1), g2);
        Weights { linear, perspective: [value::div(g1, sum), value::div(g2, sum)] }
    }

    /// Depth at the given weights, as FP32 bits.
    pub fn depth_at(&self, weights: &Weights) -> u32 {
        if self.depth_constant { self.depth.base } else { along(&self.depth, weights.linear, Format::FP32) }
    }

    /// A component at the given weights, as FP32 bits; 0 past the last component.
    ///
    /// `(a0 + l1*(a1-a0)) + l2*(a2-a0)`, each step rounded to the iterator format. Constant components are returned
    /// unchanged.
    pub fn component_at(&self, component: usize, weights: &Weights) -> u32 {
        let Some(plane) = self.planes.get(component) else { return 0 };
        if self.constant.has(component) {
            return plane.base;
        }
        let format = self.iterator_format;
        if format == Format::FP32 {
            return along(plane, weights.perspective, format);
        }
        interpolated(plane, weights.perspective, format)
    }

    /// 1 / w over the triangle, as an FP32 plane that is linear in screen space. Constant if all w are equal.
    pub(crate) fn reciprocal_w_plane(&self) -> Plane {
        plane(self.reciprocal_w, Format::FP32)
    }

    /// Offset from a pixel's column and row to its centre, in half pixels.
    pub(crate) fn half_pixels(&self) -> u32 {
        u32::from(self.center == PixelCenter::OpenGl)
    }

    /// Window position of pixel (x, y) at the given weights. 1 / w is `(r0 + l1*(r1-r0)) + l2*(r2-r0)` of the vertices'
    /// reciprocals with the screen-space weights, each step rounded to FP32.
    fn position_at(&self, x: u32, y: u32, weights: &Weights) -> [u32; 4] {
        let center =
            |n: u32| value::mul(value::from_integer(2 * i64::from(n) + i64::from(self.half_pixels())), value::HALF);
        let w = match self.affine {
            true => self.reciprocal_w[0],
            false => along(&self.reciprocal_w_plane(), weights.linear, Format::FP32),
        };
        [center(x), center(y), self.depth_at(weights), w]
    }

    /// Interpolates the inputs of the fragment at pixel (x, y): depth and the needed components; other components are
    /// 0.
    pub fn interpolate(&self, x: u32, y: u32, needed: ComponentMask) -> FragmentInput {
        let weights = self.weights(x, y);
        let mut input = FragmentInput { depth: self.depth_at(&weights), ..FragmentInput::default() };
        if needed.has(POSITION_COMPONENT) {
            input.position = self.position_at(x, y, &weights);
        }
        let mut left = needed.0 & ComponentMask::ALL.0;
        while left != 0 {
            let component = left.trailing_zeros() as usize;
            left &= left - 1;
            let value = self.component_at(component, &weights);
            match component {
                FOG_COMPONENT => input.fog = value,
                COLOR_COMPONENT.. => input.v[(component - COLOR_COMPONENT) / 4][component % 4] = value,
                _ => input.t[component / 4][component % 4] = value,
            }
        }
        input
    }
}

/// Interpolates a non-constant component with FP32 weights, in an iterator format other than FP32. Returns FP32 bits.
pub(crate) fn interpolated(plane: &Plane, weights: [u32; 2], format: Format) -> u32 {
    let converted = weights.map(|w| num::ops::convert(&Format::FP32, format, w).bits);
    num::ops::convert(&format, Format::FP32, along(plane, converted, format)).bits
}

/// `(base + l1 * d1) + l2 * d2`
fn along(plane: &Plane, [l1, l2]: [u32; 2], format: Format) -> u32 {
    let add = |a, b| num::ops::add(format, a, b).bits;
    let mul = |a, b| num::ops::mul(format, a, b).bits;
    add(add(plane.base, mul(l1, plane.d1)), mul(l2, plane.d2))
}

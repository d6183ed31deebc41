//! Interpolation in packed lanes, one triangle per lane.

use refsim_lanes::{AnyLane, LANES, LaneRow, Slots};

use super::packed::{PackedFragment, PackedLanes};
use super::shader::InputSlots;
use crate::exec::batch::formats::LaneFormats;
use crate::exec::batch::vertex::{PlaneRows, Surfaces};
use crate::exec::lower::{Arith, TRUE};
use crate::num::Format;
use crate::raster::{Plane, TriangleSetup, interpolated};

impl PackedLanes {
    /// Computes the rows of the lanes and fills the slots of varying components.
    pub(crate) fn fill(&mut self, surfaces: &Surfaces, inputs: &InputSlots, formats: &LaneFormats, slots: &mut Slots) {
        let single = formats.lane(Arith::Single);
        let mut planes = [0; LANES];
        let mut constant = 0;
        let mut w = [[1.0; LANES]; 3];
        let mut affine = [0; LANES];
        let (mut covered, mut run) = ([0; LANES], [0; LANES]);
        let (mut linear, mut depth) = ([[0.0; LANES]; 2], [0; LANES]);
        for (lane, fragment) in self.fragments() {
            let setup = &surfaces.shapes[fragment.shape as usize];
            run[lane] = TRUE;
            covered[lane] = if fragment.covered { TRUE } else { 0 };
            planes[lane] = fragment.planes;
            constant |= surfaces.constant[fragment.planes as usize];
            (linear[0][lane], linear[1][lane]) = (fragment.linear[0], fragment.linear[1]);
            depth[lane] = fragment.depth;
            affine[lane] = if setup.affine { TRUE } else { 0 };
            for (w, bits) in w.iter_mut().zip(setup.reciprocal_w) {
                w[lane] = f32::from_bits(bits);
            }
        }
        (self.covered, self.run, self.linear, self.depth) = (covered, run, linear, depth);
        let (linear, perspective) = (&self.linear, &mut self.perspective);
        self.simd.run(
            #[inline(always)]
            || along_surface(linear, &w, &affine, perspective),
        );
        for &(axis, slot) in &inputs.position {
            let row = slots.row_mut(slot);
            for (lane, fragment) in self.fragments() {
                row[lane] = position(&surfaces.shapes[fragment.shape as usize], fragment, axis);
            }
        }
        for &(number, slot) in &inputs.rows {
            let Some(row) = surfaces.rows.get(number) else { continue };
            self.component(row, surfaces.iterator_format, &planes, single, slots.row_mut(slot));
            if constant >> row.component & 1 == 0 {
                continue;
            }
            for (value, &planes) in slots.row_mut(slot).iter_mut().zip(&planes) {
                if surfaces.constant[planes as usize] >> row.component & 1 == 1 {
                    *value = single.decode(row.base[planes as usize]);
                }
            }
        }
    }

    /// Interpolates a varying component.
    fn component(&self, row: &PlaneRows, format: Format, planes: &LaneRow, single: &AnyLane, out: &mut LaneRow) {
        let (mut base, mut d1, mut d2) = ([0; LANES], [0; LANES], [0; LANES]);
        for (lane, &number) in planes.iter().enumerate() {
            Plane { base: base[lane], d1: d1[lane], d2: d2[lane] } = row.plane(number);
        }
        let weights = &self.perspective;
        if format == Format::FP32 {
            return self.simd.run(
                #[inline(always)]
                || along(&base, [&d1, &d2], weights, out),
            );
        }
        for (lane, _) in self.run.iter().enumerate().filter(|(_, run)| **run != 0) {
            let plane = Plane { base: base[lane], d1: d1[lane], d2: d2[lane] };
            let weights = [0, 1].map(|k: usize| single.encode(weights[k][lane].to_bits()));
            out[lane] = single.decode(interpolated(&plane, weights, format));
        }
    }
}

/// Computes a component of the window position in single precision.
fn position(setup: &TriangleSetup, fragment: &PackedFragment, axis: usize) -> u32 {
    let half = setup.half_pixels() as f32 * 0.5;
    match axis {
        0 => (fragment.x as f32 + half).to_bits(),
        1 => (fragment.y as f32 + half).to_bits(),
        2 => fragment.depth,
        _ if setup.affine => setup.reciprocal_w[0],
        _ => {
            let Plane { base, d1, d2 } = setup.reciprocal_w_plane();
            let [base, d1, d2] = [base, d1, d2].map(f32::from_bits);
            ((base + fragment.linear[0] * d1) + fragment.linear[1] * d2).to_bits()
        }
    }
}

/// Perspective-correct weights, given 1 / w at the vertices; screen-space weights in lanes where `affine` is nonzero.
#[inline(always)]
fn along_surface(linear: &[[f32; LANES]; 2], w: &[[f32; LANES]; 3], affine: &LaneRow, out: &mut [[f32; LANES]; 2]) {
    let [first, second] = out;
    for i in 0..LANES {
        let (l1, l2) = (linear[0][i], linear[1][i]);
        let l0 = (1.0 - l1) - l2;
        let (g0, g1, g2) = (l0 * w[0][i], l1 * w[1][i], l2 * w[2][i]);
        let sum = (g0 + g1) + g2;
        first[i] = if affine[i] != 0 { l1 } else { g1 / sum };
        second[i] = if affine[i] != 0 { l2 } else { g2 / sum };
    }
}

#[inline(always)]
fn along(base: &LaneRow, [d1, d2]: [&LaneRow; 2], weights: &[[f32; LANES]; 2], out: &mut LaneRow) {
    let single = f32::from_bits;
    for i in 0..LANES {
        out[i] = ((single(base[i]) + weights[0][i] * single(d1[i])) + weights[1][i] * single(d2[i])).to_bits();
    }
}

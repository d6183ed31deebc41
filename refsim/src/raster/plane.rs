//! Attribute planes of a triangle.

use super::clip::ClipVertex;
use super::vertex::{COMPONENTS, ComponentMask};
use crate::num::{self, Format};

/// A component as a function of the weights: `(base + l1 * d1) + l2 * d2`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Plane {
    /// Value at vertex 0; for a constant component, the FP32 value everywhere.
    pub base: u32,
    /// Value at vertex 1 minus the value at vertex 0, rounded.
    pub d1: u32,
    /// Value at vertex 2 minus the value at vertex 0, rounded.
    pub d2: u32,
}

pub(super) fn plane(values: [u32; 3], format: Format) -> Plane {
    let [a0, a1, a2] = values;
    Plane { base: a0, d1: num::ops::sub(format, a1, a0).bits, d2: num::ops::sub(format, a2, a0).bits }
}

/// The plane through the FP32 values of a component at the vertices, and `true` if the component is constant.
pub(crate) fn component_plane(values: [u32; 3], format: Format) -> (Plane, bool) {
    let into = |bits| if format == Format::FP32 { bits } else { num::ops::convert(&Format::FP32, format, bits).bits };
    let back = |bits| if format == Format::FP32 { bits } else { num::ops::convert(&format, Format::FP32, bits).bits };
    if values[0] == values[1] && values[1] == values[2] {
        // Zero needs no conversion: it is zero in every format, and most unused components are zero.
        let base = if values[0] == 0 { 0 } else { back(into(values[0])) };
        return (Plane { base, d1: 0, d2: 0 }, true);
    }
    (plane(values.map(into), format), false)
}

/// Planes of all components, and the set of constant components.
pub(super) fn planes(vertices: &[ClipVertex; 3], format: Format) -> ([Plane; COMPONENTS], ComponentMask) {
    let mut planes = [Plane::default(); COMPONENTS];
    let mut constant = ComponentMask::NONE;
    for (i, slot) in planes.iter_mut().enumerate() {
        let same;
        (*slot, same) = component_plane([0, 1, 2].map(|v: usize| vertices[v].components[i]), format);
        if same {
            constant = constant.with(i);
        }
    }
    (planes, constant)
}

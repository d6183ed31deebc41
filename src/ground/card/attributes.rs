//! Attributes of vertices, as the bits of f32.

use rayon::prelude::*;
use refsim::machine::{AttributeStream, StepRate, VertexStreams};
use refsim::num::{Format, ops};

use super::CardError;

/// The values of an attribute register, one per vertex.
pub type Attribute = Vec<[u32; 4]>;

/// Attribute of three numbers, each rounded once to f32, and a fourth number.
pub fn attribute([x, y, z]: [f64; 3], w: f32) -> [u32; 4] {
    [x as f32, y as f32, z as f32, w].map(f32::to_bits)
}

/// Attributes of one instance, from register 0 up. The length of the first is the number of vertices.
pub fn vertex_streams<'a>(attributes: impl IntoIterator<Item = &'a Attribute>) -> VertexStreams<'a> {
    let of = |(register, data): (usize, &'a Attribute)| AttributeStream { register, step: StepRate::Vertex, data };
    let streams: Vec<_> = attributes.into_iter().enumerate().map(of).collect();
    VertexStreams { vertex_count: streams.first().map_or(0, |first| first.data.len()), instance_count: 1, streams }
}

/// Transposes the attributes of `vertices` vertices into one attribute per register.
pub fn by_register(
    registers: usize,
    vertices: usize,
    of_vertex: impl Fn(usize) -> Vec<[u32; 4]> + Send + Sync,
) -> Vec<Attribute> {
    let by_vertex: Vec<Vec<[u32; 4]>> = (0..vertices).into_par_iter().map(of_vertex).collect();
    (0..registers).map(|register| by_vertex.iter().map(|vertex| vertex[register]).collect()).collect()
}

/// Fails with [`CardError::Input`] if an attribute overflows single precision; `what` names the expected value in the
/// message.
pub fn check_finite(what: &str, attributes: &[Attribute]) -> Result<(), CardError> {
    let mut numbers = attributes.iter().flatten().flatten().map(|&bits| f32::from_bits(bits));
    match numbers.find(|value| !value.is_finite()) {
        Some(found) => Err(CardError::figure(what, f64::from(found))),
        None => Ok(()),
    }
}

/// Rounds a number to half precision and back, as programs read a half-precision attribute.
pub fn through_half(value: f32) -> f32 {
    let half = ops::convert(&Format::FP32, Format::FP16, value.to_bits()).bits;
    f32::from_bits(ops::convert(&Format::FP16, Format::FP32, half).bits)
}

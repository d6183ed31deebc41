//! The module that the tests run.

use refsim::exec::wgsl::parts::Parts;
use refsim::exec::wgsl::{number, texture};

const HEAD: &str = "
@group(0) @binding(0) var<storage, read> draw: array<u32>;
@group(0) @binding(1) var<storage, read> samplers: array<u32>;
@group(0) @binding(2) var<storage, read> video: array<u32>;
@group(0) @binding(3) var<storage, read> reads: array<u32>;
@group(0) @binding(4) var<storage, read_write> made: array<u32>;
const MAIN: u32 = 0u;
fn format(k: u32) -> Format {
    return Format(draw[0], draw[1], draw[2], draw[3], draw[4], draw[5], draw[6], draw[7]);
}
";

const READING: &str = "
var<private> t_at: u32;
var<private> t_to: u32;
fn texture_operand(number: u32, lane: u32) -> u32 {
    // Coordinates, bias, gradients; three words (detail, sampler, lanes) precede the gradients.
    let gradient = select(24u + 4u * (number - 4u), 16u, reads[t_at + 21u] != DETAIL_GRADIENTS);
    return reads[t_at + select(gradient, 4u * number, number < 4u) + lane];
}
fn texture_result(component: u32, lane: u32, value: u32) { made[t_to + 4u * component + lane] = value; }
@compute @workgroup_size(64)
fn read_texels(@builtin(global_invocation_id) id: vec3<u32>) {
    t_at = 56u * id.x;
    if (t_at >= arrayLength(&reads)) { return; }
    t_to = 16u * id.x;
    let run = ((vec4<u32>(reads[t_at + 22u]) >> vec4<u32>(0u, 1u, 2u, 3u)) & vec4<u32>(1u)) != vec4<u32>(0u);
    texture_read(reads[t_at + 20u], reads[t_at + 21u], run);
}
";

const DECODING: &str = "
@compute @workgroup_size(64)
fn decode_texels(@builtin(global_invocation_id) id: vec3<u32>) {
    let at = 8u * id.x;
    if (at >= arrayLength(&reads)) { return; }
    let words = vec4<u32>(reads[at], reads[at + 1u], reads[at + 2u], reads[at + 3u]);
    for (var c = 0u; c < 4u; c++) { made[4u * id.x + c] = texel_decode(format(MAIN), reads[at + 4u + c], words); }
}
";

fn module(more: &str, entry: &str) -> String {
    Parts::all().of(&[HEAD, &number::library(), &texture::library(), more].concat(), entry)
}

/// The module that reads.
pub(crate) fn reading() -> String {
    module(READING, "read_texels")
}

/// The module that decodes.
pub(crate) fn decoding() -> String {
    module(DECODING, "decode_texels")
}

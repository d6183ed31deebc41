//! The module that the tests run.

use refsim::exec::wgsl::{NativeOperations, NumberMode, number, texture};

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
fn row(at: u32) -> vec4<u32> { return vec4<u32>(reads[at], reads[at + 1u], reads[at + 2u], reads[at + 3u]); }
@compute @workgroup_size(64) fn read_texels(@builtin(global_invocation_id) id: vec3<u32>) {
    let at = 56u * id.x;
    if (at >= arrayLength(&reads)) { return; }
    var gradients: array<vec4<u32>, 8>;
    for (var i = 0u; i < 8u; i++) { gradients[i] = row(at + 24u + 4u * i); }
    let run = ((vec4<u32>(reads[at + 22u]) >> vec4<u32>(0u, 1u, 2u, 3u)) & vec4<u32>(1u)) != vec4<u32>(0u);
    var texel = texture_read(
        reads[at + 20u], row(at), row(at + 4u), row(at + 8u), row(at + 12u), reads[at + 21u], row(at + 16u), gradients, run,
    );
    for (var i = 0u; i < 16u; i++) { made[16u * id.x + i] = texel[i / 4u][i % 4u]; }
}
";

const DECODING: &str = "
@compute @workgroup_size(64) fn decode_texels(@builtin(global_invocation_id) id: vec3<u32>) {
    let at = 8u * id.x;
    if (at >= arrayLength(&reads)) { return; }
    let words = vec4<u32>(reads[at], reads[at + 1u], reads[at + 2u], reads[at + 3u]);
    for (var c = 0u; c < 4u; c++) { made[4u * id.x + c] = texel_decode(format(MAIN), reads[at + 4u + c], words); }
}
";

fn module(entry: &str, mode: NumberMode, native: NativeOperations) -> String {
    [HEAD, &number::library(mode, native), &texture::library(), entry].concat()
}

/// The module that reads, in integers alone.
pub(crate) fn reading() -> String {
    module(READING, NumberMode::Integer, NativeOperations::empty())
}

/// The module that reads with all the `f32` there is.
pub(crate) fn reading_native() -> String {
    module(READING, NumberMode::Native, NativeOperations::all())
}

/// The module that decodes.
pub(crate) fn decoding() -> String {
    module(DECODING, NumberMode::Integer, NativeOperations::empty())
}

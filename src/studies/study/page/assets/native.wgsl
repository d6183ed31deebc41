// The adapter's own floats: the operations of the table in the type `real`, which the page replaces by f32 or f16, on
// the operand sets of the table's column of that format. The page puts the constants before this text.

@group(0) @binding(0) var<storage, read> jobs: array<u32>;
@group(0) @binding(1) var<storage, read> operands: array<u32>;
@group(0) @binding(2) var<storage, read_write> results: array<u32>;

@compute @workgroup_size(64)
fn native_main(@builtin(global_invocation_id) place: vec3<u32>) {
    let at = 12u * place.y;
    if (place.x >= jobs[at + 10u]) {
        return;
    }
    let item = jobs[at + 9u] + place.x;
    let a = from_bits(operands[3u * item]);
    let b = from_bits(operands[3u * item + 1u]);
    let c = from_bits(operands[3u * item + 2u]);
    results[item] = to_bits(native(jobs[at + 8u], a, b, c));
}

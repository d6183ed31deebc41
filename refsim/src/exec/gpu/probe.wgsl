// One single precision operation per item: number, three operands; the result's bits, a NaN in its one form. Numbers
// are those of accuracy.rs.
@group(0) @binding(0) var<storage, read> items: array<u32>;
@group(0) @binding(1) var<storage, read_write> results: array<u32>;

// A NaN is told by its bits: a compiler may take it that no comparison ever meets one.
fn canonical(x: f32) -> u32 {
    let bits = bitcast<u32>(x);
    return select(bits, 0x7fc00000u, (bits & 0x7fffffffu) > 0x7f800000u);
}

@compute @workgroup_size(64)
fn run_probe(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&results) {
        return;
    }
    let at = 4u * id.x;
    let a = bitcast<f32>(items[at + 1u]);
    let b = bitcast<f32>(items[at + 2u]);
    let c = bitcast<f32>(items[at + 3u]);
    var result = 0.0;
    switch items[at] {
        case 0u: { result = a + b; }
        case 1u: { result = a - b; }
        case 2u: { result = a * b; }
        case 3u: { result = a * b + c; }
        case 4u: { result = a / b; }
        case 5u: { result = 1.0 / a; }
        case 6u: { result = sqrt(a); }
        case 7u: { result = floor(a); }
        case 8u: { result = f32(bitcast<i32>(items[at + 1u])); }
        case 9u: { result = min(a, b); }
        default: { result = max(a, b); }
    }
    results[id.x] = canonical(result);
}

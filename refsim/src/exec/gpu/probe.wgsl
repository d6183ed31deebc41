// One single precision operation an item: number, three operands; the result's bits, a NaN in its one form.
@group(0) @binding(0) var<storage, read> items: array<u32>;
@group(0) @binding(1) var<storage, read_write> results: array<u32>;

@compute @workgroup_size(64)
fn run_probe(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&results) {
        return;
    }
    let at = 4u * id.x;
    let op = items[at];
    let a = items[at + 1u];
    let b = items[at + 2u];
    let c = items[at + 3u];
    let x = bitcast<f32>(a);
    let y = bitcast<f32>(b);
    var result = 0u;
    switch op {
        case N_CONVERT: { result = s_from_i32(i32(a)); }
        case N_MIN: { result = n_canonical(min(x, y)); }
        case N_MAX: { result = n_canonical(max(x, y)); }
        default: { result = n_native_alu(op, a, b, c); }
    }
    results[id.x] = result;
}

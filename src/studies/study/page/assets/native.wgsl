// The adapter's own floats: the operations of the table in the type `real`, which the page replaces by f32 or f16, on
// the operand sets of the table's column of that format. The page puts the constants before this text.

@group(0) @binding(0) var<storage, read> jobs: array<u32>;
@group(0) @binding(1) var<storage, read> operands: array<u32>;
@group(0) @binding(2) var<storage, read_write> results: array<u32>;

fn native(operation: u32, a: real, b: real, c: real) -> real {
    switch operation {
        case N_ADD: { return a + b; }
        case N_SUB: { return a - b; }
        case N_MUL: { return a * b; }
        case N_DIV: { return a / b; }
        case N_MAD: { return a * b + c; }
        case N_FUSED_MAD: { return fma(a, b, c); }
        case N_RCP: { return 1.0 / a; }
        case N_RSQ: { return inverseSqrt(a); }
        case N_SQRT: { return sqrt(a); }
        case N_MIN: { return min(a, b); }
        case N_MAX: { return max(a, b); }
        case N_FLOOR: { return floor(a); }
        case N_FRC: { return fract(a); }
        case N_EXP2: { return exp2(a); }
        case N_LOG2: { return log2(a); }
        case N_SIN: { return sin(a); }
        case N_COS: { return cos(a); }
        default: { return a; }
    }
}

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

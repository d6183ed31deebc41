// One operation in the adapter's own floats, which have the type `real`.
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

// Single precision: nearest even, with subnormals and infinities. Operands may be any NaN; results have one NaN.

fn s_is_nan(a: u32) -> bool {
    return (a & 0x7fffffffu) > N_INFINITY;
}

// N_ADD, N_SUB, N_MUL; N_DIV only if there are cube maps.
const S_DIVIDE: u32 = N_DIV;

fn s_alu(op: u32, a: u32, b: u32) -> u32 {
    var w: Real;
    switch op {
        case S_DIVIDE: { w = n_quotient(op, N_FP32, n_unpack(N_FLOAT, 0u, a), n_unpack(N_FLOAT, 0u, b)); }
        default: { w = n_term(op, N_FP32, N_FLOAT, 0u, 0u, a, b); }
    }
    return n_finish(N_FP32, w);
}

// N_ADD, N_SUB or N_MUL of a number of this kind and a single; any other operation converts the first operand, divided
// by `over` if it is normalized.
fn n_term(op: u32, f: Format, kind: u32, fraction: u32, over: u32, a: u32, b: u32) -> Real {
    let x = n_unpack(kind, fraction, a);
    let second = n_unpack(N_FLOAT, 0u, b);
    let product = op == N_MUL;
    var y = N_ONE;
    var z = Number(0u, x.sign, -N_FAR, 0u);
    if op == N_ADD || op == N_SUB {
        z = second;
        z.sign ^= select(0u, 1u, op == N_SUB);
    }
    if product {
        y = second;
        z.sign ^= y.sign;
    }
    var w = n_in_units(f, n_sum(f, x, y, z));
    if (HAS_NORMALIZED) {
        if over != 0u {
            w.m = n_divided(w.m, over);
        }
    }
    return w;
}

// Key that orders single-precision patterns except NaN; equal for both zeros.
fn s_key(a: u32) -> i32 {
    let magnitude = i32(a & 0x7fffffffu);
    return select(magnitude, -magnitude, (a >> 31u) == 1u);
}

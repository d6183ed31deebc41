// Single precision: nearest even, subnormals kept, infinities; bits of any NaN in, the one NaN out.

fn s_is_nan(a: u32) -> bool {
    return (a & 0x7fffffffu) > N_INFINITY;
}

// N_ADD, N_SUB, N_MUL or N_DIV.
fn s_alu(op: u32, a: u32, b: u32) -> u32 {
    if n_native(op, N_FP32) {
        return n_native_alu(op, a, b, 0u);
    }
    let x = n_unpack(N_FLOAT, 0u, a);
    var y = n_unpack(N_FLOAT, 0u, b);
    var z = Number(0u, x.sign ^ y.sign, -N_FAR, 0u);
    var w: Real;
    if op == N_DIV {
        w = n_quotient(op, N_FP32, x, y);
    } else {
        if op != N_MUL {
            z = y;
            z.sign ^= select(0u, 1u, op == N_SUB);
            y = N_ONE;
        }
        w = n_sum(N_FP32, x, y, z);
    }
    return n_finish(N_FP32, w);
}

fn s_add(a: u32, b: u32) -> u32 { return s_alu(N_ADD, a, b); }
fn s_sub(a: u32, b: u32) -> u32 { return s_alu(N_SUB, a, b); }
fn s_mul(a: u32, b: u32) -> u32 { return s_alu(N_MUL, a, b); }
fn s_div(a: u32, b: u32) -> u32 { return s_alu(N_DIV, a, b); }

fn s_key(a: u32) -> i32 {
    let magnitude = i32(a & 0x7fffffffu);
    return select(magnitude, -magnitude, (a >> 31u) == 1u);
}

fn s_lt(a: u32, b: u32) -> bool { return s_key(a) < s_key(b) && !s_is_nan(a) && !s_is_nan(b); }
fn s_le(a: u32, b: u32) -> bool { return s_key(a) <= s_key(b) && !s_is_nan(a) && !s_is_nan(b); }
fn s_eq(a: u32, b: u32) -> bool { return s_key(a) == s_key(b) && !s_is_nan(a) && !s_is_nan(b); }

// An integer in single precision.
fn s_whole(x: i32) -> u32 {
    return n_round(N_FP32, x < 0, vec2<u32>(u32(abs(x)), 0u), 0, false);
}

// The largest integer not above a 2^k, saturated to an i32; NaN gives 0.
fn s_scaled_floor(a: u32, k: i32) -> i32 {
    var x = n_unpack(N_FLOAT, 0u, a);
    x.exp += k;
    return i32(n_integer(n_integral(x, false)));
}

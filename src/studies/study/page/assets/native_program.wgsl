// Programs in the adapter's own floats: the functions that replace the number library for the machine. If a format is
// marked as the adapter's (NATIVE is added to its `special`), its operations are computed in f32. The number library
// does everything else, such as interpolation, texture reads, selections and registers of other formats.
alias real = f32;

fn native_bits(x: f32) -> Real {
    let bits = bitcast<u32>(x);
    return n_known(select(bits, N_NAN, (bits & 0x7fffffffu) > N_INFINITY));
}

// The format without its mark.
fn native_format(f: Format) -> Format {
    var exact = f;
    exact.special = f.special % NATIVE;
    return exact;
}

fn native_short(op: u32, f: Format, a: u32, b: u32, c: u32) -> Real {
    if (f.special >= NATIVE) {
        switch op {
            case N_ADD, N_SUB, N_MUL, N_FUSED_MAD, N_MIN, N_MAX, N_FLOOR, N_FRC: {
                return native_bits(native(op, bitcast<f32>(a), bitcast<f32>(b), bitcast<f32>(c)));
            }
            default: {}
        }
    }
    return n_short(op, native_format(f), a, b, c);
}

fn native_long(op: u32, f: Format, a: u32, b: u32) -> Real {
    if (f.special >= NATIVE) {
        // Direct3D takes the reciprocal root of the magnitude.
        let first = select(a, a & 0x7fffffffu, op == N_RSQ && f.special == NATIVE);
        switch op {
            case N_DIV, N_RCP, N_RSQ, N_SQRT, N_EXP2, N_LOG2, N_SIN, N_COS: {
                return native_bits(native(op, bitcast<f32>(first), bitcast<f32>(b), 0.0));
            }
            default: {}
        }
    }
    return n_long(op, native_format(f), a, b);
}

fn native_dot(f: Format, terms: u32, a: vec4<u32>, b: vec4<u32>) -> Real {
    if (f.special >= NATIVE) {
        var sum = 0.0;
        for (var k = 0u; k < terms; k++) {
            sum += bitcast<f32>(a[k]) * bitcast<f32>(b[k]);
        }
        return native_bits(sum);
    }
    return n_dot(native_format(f), terms, a, b);
}

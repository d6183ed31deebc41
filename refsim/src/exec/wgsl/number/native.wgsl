// Single precision operations left to the device's own floats: those in N_NATIVE, which the host states.

// A NaN result is told by its bits: a compiler may take it that no comparison ever meets one.
fn n_canonical(x: f32) -> u32 {
    let bits = bitcast<u32>(x);
    return select(bits, N_NAN, (bits & 0x7fffffffu) > N_INFINITY);
}

fn n_native(op: u32, f: Format) -> bool {
    if f.kind != 1u || f.upper != 8u || f.frac != 23u || f.rounding != 0u || f.overflow != 2u || f.denormals != 0u {
        return false;
    }
    var needs = 0u;
    switch op {
        case N_ADD, N_SUB: { needs = N_NATIVE_ADD; }
        case N_MUL: { needs = N_NATIVE_MUL; }
        case N_MAD: { needs = N_NATIVE_MUL_ADD; }
        case N_DIV, N_RCP: { needs = N_NATIVE_DIV; }
        case N_SQRT: { needs = N_NATIVE_SQRT; }
        case N_FLOOR: { needs = N_NATIVE_FLOOR; }
        default: {}
    }
    return (needs & N_NATIVE) != 0u;
}

fn n_native_alu(op: u32, a: u32, b: u32, c: u32) -> u32 {
    let x = bitcast<f32>(a);
    let y = bitcast<f32>(b);
    let z = bitcast<f32>(c);
    switch op {
        case N_ADD: { return n_canonical(x + y); }
        case N_SUB: { return n_canonical(x - y); }
        case N_MUL: { return n_canonical(x * y); }
        case N_MAD: { return n_canonical(x * y + z); }
        case N_DIV: { return n_canonical(x / y); }
        case N_RCP: { return n_canonical(1.0 / x); }
        case N_SQRT: { return n_canonical(sqrt(x)); }
        case N_FLOOR: { return n_canonical(floor(x)); }
        default: { return N_NAN; }
    }
}

fn s_from_i32(x: i32) -> u32 {
    if (N_NATIVE & N_NATIVE_CONVERT) != 0u {
        return bitcast<u32>(f32(x));
    }
    return s_whole(x);
}

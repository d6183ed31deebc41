// Packing of numbers into parts of a word.

// Encodes a number as bits of a word: its pattern of up to 16 bits; a single clamped to [0, 1] in 16 or 8 bits; or 128
// + 127 x for x from -128/127 to 1, and 128 for NaN. Halves are rounded up.
fn n_part(op: u32, f: Format, a: u32) -> u32 {
    let x = n_unpack(N_FLOAT, 23u, a);
    switch op {
        case N_JOIN_PATTERN: { return n_encode(f, a) & 0xffffu; }
        case N_JOIN_SHORT: { return n_step(x, 65535u); }
        case N_JOIN_BYTE: { return n_step(x, 255u); }
        default: {}
    }
    if x.kind == 2u || x.sign == 0u {
        return 128u + n_step(x, 127u);
    }
    if x.kind == 1u || x.exp > -31 {
        return 0u;
    }
    // 127 |x| with two extra bits, the last one jammed; halves go up, which here is toward zero.
    let product = n_mul32(x.sig, 127u);
    let quarters = n_right(vec3<u32>(0u, product.x, product.y), u32(-x.exp) - 2u).z;
    return 128u - min((quarters + 1u) >> 2u, 128u);
}

// Extracts what N_JOIN_... (except N_JOIN_PATTERN) stored at this bit of a word, to be divided by its number of steps.
fn n_taken(op: u32, word: u32, bit: u32) -> Number {
    let digits = word >> (bit & 31u);
    if op == N_SPLIT_SHORT {
        return n_whole(digits & 0xffffu);
    }
    let byte = digits & 0xffu;
    if op == N_SPLIT_BYTE {
        return n_whole(byte);
    }
    let below = byte < 128u;
    var x = n_whole(select(byte - 128u, 128u - byte, below));
    x.sign = select(0u, 1u, below);
    return x;
}

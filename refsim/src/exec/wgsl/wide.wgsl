// 64-bit integers as pairs of words, the lower word first; signed integers are in two's complement.

fn k_add(a: vec2<u32>, b: vec2<u32>) -> vec2<u32> {
    let low = a.x + b.x;
    return vec2<u32>(low, a.y + b.y + select(0u, 1u, low < a.x));
}

fn k_neg(a: vec2<u32>) -> vec2<u32> {
    return k_add(~a, vec2<u32>(1u, 0u));
}

// a < b, unsigned.
fn k_less(a: vec2<u32>, b: vec2<u32>) -> bool {
    return a.y < b.y || (a.y == b.y && a.x < b.x);
}

// a * b modulo 2^64, even for a signed a.
fn k_scale(a: vec2<u32>, b: u32) -> vec2<u32> {
    let low = n_mul32(a.x, b).yx;
    return vec2<u32>(low.x, low.y + a.y * b);
}

// a >> n for n below 64, unsigned.
fn k_shr(a: vec2<u32>, n: u32) -> vec2<u32> {
    let part = n & 31u;
    // Shifts by 32 - part in two steps, because WGSL has no shift by 32.
    let near = vec2<u32>((a.x >> part) | ((a.y << 1u) << (31u - part)), a.y >> part);
    return select(near, vec2<u32>(near.y, 0u), n >= 32u);
}

// a << n for n below 64.
fn k_shl(a: vec2<u32>, n: u32) -> vec2<u32> {
    let part = n & 31u;
    let near = vec2<u32>(a.x << part, (a.y << part) | ((a.x >> 1u) >> (31u - part)));
    return select(near, vec2<u32>(0u, near.x), n >= 32u);
}

// value / 2^shift for shift from 1 to 63, to nearest, ties to even; the result has at most 32 bits.
fn k_round_even(value: vec2<u32>, shift: u32) -> u32 {
    let kept = k_shr(value, shift).x;
    // The dropped bits, moved to the top: the highest of them is the half.
    let rest = k_shl(value, 64u - shift);
    let half = (rest.y >> 31u) == 1u;
    let more = ((rest.y & 0x7fffffffu) | rest.x) != 0u;
    return kept + select(0u, 1u, half && (more || (kept & 1u) == 1u));
}

// Converts a signed integer to single precision, to nearest, ties to even.
fn k_to_single(value: vec2<u32>) -> u32 {
    let negative = (value.y >> 31u) == 1u;
    let size = select(value, k_neg(value), negative);
    let top = select(31u - countLeadingZeros(size.x), 63u - countLeadingZeros(size.y), size.y != 0u);
    var significand = size.x << (23u - min(top, 23u));
    if (top > 23u) {
        significand = k_round_even(size, top - 23u);
    }
    // Adding the significand's leading one increments the exponent, and so does a carry.
    let single = select(0u, 0x80000000u, negative) | (((top + 126u) << 23u) + significand);
    return select(single, 0u, (size.x | size.y) == 0u);
}

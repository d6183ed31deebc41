
// Units of cards. The `special` of a format in which one computes is 2 for NV20 and NV25, 3 for NV30 and NV35 in their
// legacy mode, 4 in their modern one, 5 for GT200, 6 for GT200 where 0 times anything is 0. Raw values are then plain
// words: no NaN but that of results is the same as another, and subnormal numbers stay.
//
// Integers of 64 bits are vec2, the first word the high one; in two's complement where they are signed.

const U_NAN: u32 = 0x7fffffffu;
const U_ONE: u32 = 0x3f800000u;
const U_SIGN: u32 = 0x80000000u;

// The third operand of a long operation, in this lane and in all.
var<private> u_third: u32;
var<private> u_thirds: vec4<u32>;

fn u_is_nan(word: u32) -> bool {
    return (word & 0x7fffffffu) > N_INFINITY;
}

fn u_is_zero(word: u32) -> bool {
    return (word & 0x7f800000u) == 0u;
}

fn u_field(word: u32) -> i32 {
    return i32((word >> 23u) & 0xffu);
}

fn u_significand(word: u32) -> u32 {
    return (word & 0x7fffffu) | 0x800000u;
}

fn u_flushed(word: u32) -> u32 {
    return select(word, word & U_SIGN, u_is_zero(word));
}

// A number of single precision without its subnormals.
fn u_normal(x: Number) -> Number {
    var y = x;
    if x.kind == 0u && x.exp < -157 {
        y.exp = -N_FAR;
        y.sig = 0u;
    }
    return y;
}

fn u_add(a: vec2<u32>, b: vec2<u32>) -> vec2<u32> {
    let low = a.y + b.y;
    return vec2<u32>(a.x + b.x + select(0u, 1u, low < a.y), low);
}

fn u_minus(a: vec2<u32>, b: vec2<u32>) -> vec2<u32> {
    return vec2<u32>(a.x - b.x - select(0u, 1u, a.y < b.y), a.y - b.y);
}

fn u_times(a: vec2<u32>, b: u32) -> vec2<u32> {
    let low = n_mul32(a.y, b);
    return vec2<u32>(low.x + a.x * b, low.y);
}

// a >> n of a signed integer, n from 1 to 31.
fn u_right(a: vec2<u32>, n: u32) -> vec2<u32> {
    return vec2<u32>(u32(i32(a.x) >> n), (a.y >> n) | (a.x << (32u - n)));
}

// x 2^n, n below 32.
fn u_wide(x: i32, n: u32) -> vec2<u32> {
    return vec2<u32>(u32((x >> 1u) >> (31u - n)), u32(x) << n);
}

// The float of a magnitude with so many fraction bits, its top 24 bits cut; 0 is a zero of the sign.
fn u_cut(negative: bool, magnitude: vec2<u32>, fraction: i32) -> u32 {
    let high = magnitude.x != 0u;
    let zeros = countLeadingZeros(select(magnitude.y, magnitude.x, high));
    let left = zeros & 31u;
    let both = (magnitude.x << left) | ((magnitude.y >> 1u) >> (31u - left));
    let top = select(magnitude.y << left, both, high);
    let field = 127 + select(31, 63, high) - i32(zeros) - fraction;
    let word = (u32(field) << 23u) | ((top >> 8u) & 0x7fffffu);
    return select(0u, U_SIGN, negative) | select(word, 0u, (magnitude.x | magnitude.y) == 0u);
}

// The same of a number whose magnitude below zero is its one's complement.
fn u_cut_signed(value: vec2<u32>, fraction: i32) -> u32 {
    let negative = (value.x >> 31u) == 1u;
    return u_cut(negative, select(value, ~value, negative), fraction);
}

// What orders words. Legacy vertex units know signs and magnitudes; others have one zero.
fn u_key(unit: u32, word: u32) -> i32 {
    let magnitude = word & 0x7fffffffu;
    let key = select(i32(word), ~i32(magnitude), word > 0x7fffffffu);
    return select(key, 0, unit > 3u && u_is_zero(word));
}

fn u_less(unit: u32, a: u32, b: u32) -> bool {
    return u_key(unit, a) < u_key(unit, b);
}

// Comparisons, and what hands words on.
fn u_simple(op: u32, f: Format, a: u32, b: u32, c: u32) -> Real {
    let unit = f.special;
    let unordered = unit > 3u && (u_is_nan(a) || u_is_nan(b));
    let first = u_key(unit, a);
    let second = u_key(unit, b);
    let less = first < second && !unordered;
    let equal = first == second && !unordered;
    var known = true;
    var raw = 0u;
    switch op {
        case N_NEG: { raw = a ^ U_SIGN; }
        case N_ABS: { raw = a & 0x7fffffffu; }
        case N_LESS: { raw = n_mask(less); }
        case N_LESS_EQUAL: { raw = n_mask(less || equal); }
        case N_EQUAL: { raw = n_mask(equal); }
        case N_SET_LESS: { raw = select(0u, U_ONE, less); }
        case N_SET_LESS_EQUAL: { raw = select(0u, U_ONE, less || equal); }
        case N_SET_EQUAL: { raw = select(0u, U_ONE, equal); }
        case N_SET_NOT_EQUAL: { raw = select(U_ONE, 0u, equal); }
        case N_SELECT_NON_NEGATIVE: { raw = n_select(first >= 0 && !(unit > 3u && u_is_nan(a)), b, c); }
        case N_SELECT_ABOVE_HALF: { raw = n_select(first > 0x3f000000 && !(unit > 3u && u_is_nan(a)), b, c); }
        case N_MIN, N_MAX: {
            raw = select(select(b, a, less), U_NAN, unordered);
            if op == N_MAX {
                raw = select(select(a, b, less), U_NAN, unordered);
            }
            if (HAS_GT200) {
                if unit > 4u {
                    raw = g_choose(a, b, op == N_MAX);
                }
            }
        }
        case N_SATURATE: {
            raw = select(select(u_flushed(a), U_ONE, u_field(a) > 126), 0u, a > 0x7fffffffu);
            raw = select(raw, select(0u, U_NAN, unit > 4u), u_is_nan(a));
        }
        case N_DECODE, N_ENCODE: { raw = a; }
        default: { known = false; }
    }
    if (HAS_VERTEX_UNIT) {
        switch op {
            case N_SET_LESS, N_SET_LESS_EQUAL, N_SET_EQUAL, N_SET_NOT_EQUAL: {
                raw = select(raw, U_NAN, unordered && unit == 4u);
            }
            case N_SIGN: {
                raw = select(select(0u, U_ONE, first > 0), U_ONE | U_SIGN, first < 0);
                raw = select(raw, U_NAN, unit == 4u && u_is_nan(a));
                known = true;
            }
            default: {}
        }
    }
    return Real(known, raw, 0u, 0, vec3<u32>());
}

// What the unit makes of an operation that is not long; known is false if the ideal unit computes it.
fn u_short(op: u32, f: Format, a: u32, b: u32, c: u32) -> Real {
    var own = u_simple(op, f, a, b, c);
    if (HAS_VERTEX_UNIT) {
        if f.special < 5u && !own.known {
            own = v_short(op, f.special, a, b, c);
        }
    }
    if (HAS_GT200) {
        if f.special > 4u && !own.known {
            own = g_short(op, f, a, b, c);
        }
    }
    return own;
}

// The same of a long operation.
fn u_long(op: u32, f: Format, a: u32, b: u32) -> Real {
    var own = Real(false, 0u, 0u, 0, vec3<u32>());
    if (HAS_VERTEX_UNIT) {
        if f.special < 5u {
            own = v_long(op, f.special, a, b);
        }
    }
    if (HAS_GT200) {
        if f.special > 4u {
            own = g_long(op, a);
        }
    }
    return own;
}

// The sum of so many products, at most 4, as the unit makes it.
fn u_dot(f: Format, terms: u32, a: vec4<u32>, b: vec4<u32>) -> u32 {
    var left = a;
    var right = b;
    var products: vec4<u32>;
    var sum = 0u;
    for (var k = 0u; k < min(terms, 4u); k++) {
        if (HAS_VERTEX_UNIT) {
            products[k] = v_mul(f.special, left[k], right[k]);
        }
        if (HAS_GT200) {
            if f.special > 4u {
                sum = g_sum(select(N_FUSED_MAD, N_MUL, k == 0u), f, left[k], right[k], sum);
            }
        }
    }
    if (HAS_VERTEX_UNIT) {
        if f.special < 5u {
            sum = v_sum(f.special, products);
        }
    }
    return sum;
}


// The unit of GT200: `special` of a format is 2, or 3 if 0 times anything is 0. Raw values are then plain words: NaN
// operands keep their bits, results have one NaN, and subnormal numbers are kept.
//
// 64-bit integers are vec2, the high word first; signed integers are in two's complement.

const U_NAN: u32 = 0x7fffffffu;
const U_ONE: u32 = 0x3f800000u;
const U_SIGN: u32 = 0x80000000u;

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

// Replaces a subnormal number of single precision by zero.
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

// a >> n of a signed integer, n from 1 to 31.
fn u_right(a: vec2<u32>, n: u32) -> vec2<u32> {
    return vec2<u32>(u32(i32(a.x) >> n), (a.y >> n) | (a.x << (32u - n)));
}

// x 2^n, n below 32.
fn u_wide(x: i32, n: u32) -> vec2<u32> {
    return vec2<u32>(u32((x >> 1u) >> (31u - n)), u32(x) << n);
}

// Converts magnitude / 2^fraction to a float, truncated to 24 bits; 0 becomes a zero of the sign.
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

// u_cut with a sign: a negative number is represented by its one's complement.
fn u_cut_signed(value: vec2<u32>, fraction: i32) -> u32 {
    let negative = (value.x >> 31u) == 1u;
    return u_cut(negative, select(value, ~value, negative), fraction);
}

// Key that orders words as sign and magnitude; -0 is below +0.
fn u_order(word: u32) -> i32 {
    return select(i32(word), ~i32(word & 0x7fffffffu), word > 0x7fffffffu);
}

// Key that orders numbers; both zeros give 0.
fn u_key(word: u32) -> i32 {
    return select(u_order(word), 0, u_is_zero(word));
}

fn u_less(a: u32, b: u32) -> bool {
    return u_key(a) < u_key(b);
}

// Result of an operation, except long ones, by the unit; `known` is false if the ideal unit computes it.
fn u_short(op: u32, f: Format, a: u32, b: u32, c: u32) -> Real {
    let unordered = u_is_nan(a) || u_is_nan(b);
    let first = u_key(a);
    let second = u_key(b);
    let less = first < second && !unordered;
    let equal = first == second && !unordered;
    var known = true;
    var raw = 0u;
    switch op {
        case N_ADD, N_SUB, N_MUL, N_FUSED_MAD, N_SCALE: { raw = g_sum(op, f, a, b, c); }
        case N_NEG: { raw = a ^ U_SIGN; }
        case N_ABS: { raw = a & 0x7fffffffu; }
        case N_LESS: { raw = n_mask(less); }
        case N_LESS_EQUAL: { raw = n_mask(less || equal); }
        case N_EQUAL: { raw = n_mask(equal); }
        case N_SET_LESS: { raw = select(0u, U_ONE, less); }
        case N_SET_LESS_EQUAL: { raw = select(0u, U_ONE, less || equal); }
        case N_SET_EQUAL: { raw = select(0u, U_ONE, equal); }
        case N_SET_NOT_EQUAL: { raw = select(U_ONE, 0u, equal); }
        case N_SELECT_NON_NEGATIVE: { raw = n_select(first >= 0 && !u_is_nan(a), b, c); }
        case N_SELECT_ABOVE_HALF: { raw = n_select(first > 0x3f000000 && !u_is_nan(a), b, c); }
        case N_MIN, N_MAX: { raw = g_choose(a, b, op == N_MAX); }
        case N_SATURATE: {
            raw = select(select(u_flushed(a), U_ONE, u_field(a) > 126), 0u, a > 0x7fffffffu);
            raw = select(raw, U_NAN, u_is_nan(a));
        }
        case N_DECODE, N_ENCODE: { raw = a; }
        default: { known = false; }
    }
    return Real(known, raw, 0u, 0, vec3<u32>());
}

// Sum of the first `terms` products, at most 4, as drivers compile it: a product, then a MAD for every further term.
fn u_dot(f: Format, terms: u32, a: vec4<u32>, b: vec4<u32>) -> u32 {
    var left = a;
    var right = b;
    var sum = 0u;
    for (var k = 0u; k < min(terms, 4u); k++) {
        sum = g_sum(select(N_FUSED_MAD, N_MUL, k == 0u), f, left[k], right[k], sum);
    }
    return sum;
}

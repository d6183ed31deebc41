// Every operation of the lane arithmetic, selected by one switch. Operations with one operand ignore the others.

// Splits a number of units of 1 / over: integer part, and remainder in units.
fn n_parted(x: Number, over: u32) -> vec2<u32> {
    let size = n_shift(x.sig, x.exp);
    return vec2<u32>(size / over, size % over);
}

// x / over, rounded down or to the nearest integer (ties to even).
fn n_integral(x: Number, over: u32, nearest: bool) -> Number {
    if (HAS_NORMALIZED) {
        if over != 1u {
            let parts = n_parted(x, over);
            let up = select(x.sign == 1u && parts.y != 0u, 2u * parts.y > over, nearest);
            var n = n_whole(parts.x + select(0u, 1u, up));
            n.sign = x.sign;
            return n;
        }
    }
    if x.kind != 0u || x.exp >= 0 || x.sig == 0u {
        return x;
    }
    let places = u32(-x.exp);
    let integer = n_shift(x.sig, x.exp);
    let rest = select(x.sig, x.sig & ((1u << (places & 31u)) - 1u), places < 32u);
    let half = select(0u, 1u << ((places - 1u) & 31u), places <= 32u);
    var up = x.sign == 1u && rest != 0u;
    if nearest {
        up = half != 0u && (rest > half || (rest == half && (integer & 1u) == 1u));
    }
    var n = n_whole(integer + select(0u, 1u, up));
    n.sign = x.sign;
    return n;
}

// Fraction of x / over, in units of 1 / over; +0 for an integer.
fn n_rest(x: Number, over: u32) -> Number {
    if (HAS_NORMALIZED) {
        if over != 1u {
            var n = n_whole(n_parted(x, over).y);
            n.sign = select(x.sign, 0u, n.sig == 0u);
            return n;
        }
    }
    if x.kind != 0u || (x.exp <= -32 && x.sig != 0u) {
        return x;
    }
    var n = n_whole(select(0u, x.sig & ((1u << (u32(-x.exp) & 31u)) - 1u), x.exp < 0));
    n.exp += x.exp;
    n.sign = select(x.sign, 0u, n.sig == 0u);
    return n;
}

// x, clamped to [0, 1], as a number of steps: nearest, halves up. `steps` is below 2^24.
fn n_step(x: Number, steps: u32) -> u32 {
    if x.kind == 2u || x.sign == 1u || x.sig == 0u {
        return 0u;
    }
    if x.kind == 1u || x.exp >= -31 {
        return steps;
    }
    let product = n_mul32(x.sig, steps);
    // Keeps two extra bits; the last, which is jammed, is not needed.
    let m = n_right(vec3<u32>(0u, product.x, product.y), u32(-x.exp) - 2u);
    return ((m.z >> 1u) + 1u) >> 1u;
}

// The integer part as an i32, saturated; NaN gives 0.
fn n_integer(x: Number) -> u32 {
    if x.kind == 2u {
        return 0u;
    }
    if x.kind == 1u || x.exp >= 0 {
        return select(0x7fffffffu, 0x80000000u, x.sign == 1u);
    }
    let part = n_shift(x.sig, x.exp);
    return select(part, 0u - part, x.sign == 1u);
}

// Key that orders raw values like their numbers; both zeros give 0.
fn n_key(f: Format, a: u32) -> i32 {
    return select(i32(a), s_key(a), n_is_float(f));
}

fn n_is_nan(f: Format, a: u32) -> bool {
    return n_is_float(f) && (a & 0x7fffffffu) > N_INFINITY;
}

// Converts an addend to the denominator of a product.
fn n_addend(z: Number, over: u32) -> Number {
    if (HAS_NORMALIZED) {
        if over != 1u {
            return n_multiple(z, over);
        }
    }
    return z;
}

// Operations that consist of a product and a sum, before rounding. N_CONVERT: b is 0 if a is a float, else 1 plus the
// fraction bits of a's fixed-point format; its second byte is the denominator of a normalized one. N_SCALE: b is the
// power as an i32.
fn n_arith(op: u32, f: Format, a: u32, b: u32, c: u32) -> Real {
    var kind = f.kind;
    var frac = f.frac;
    // Denominators: of the format, and of the result in units of the format.
    let over = n_over(f);
    var divisor = 1u;
    if op == N_CONVERT {
        kind = select(N_FIXED, N_FLOAT, b == 0u);
        frac = (b & 0xffu) - 1u;
        divisor = max(b >> 8u, 1u);
    }
    var x = n_unpack(kind, frac, a);
    var y = n_unpack(f.kind, f.frac, b);
    var z = n_unpack(f.kind, f.frac, c);
    if (HAS_UNITS) {
        if op == N_CONVERT && b >= U_SIGN {
            x = u_normal(n_unpack(N_FLOAT, 23u, a));
            divisor = 1u;
            // GT200 flushes magnitudes below 2^-33 to zero half floats in every rounding.
            if f.upper == 5u && f.frac == 10u && f.kind == 1u && x.kind == 0u && x.exp < -64 {
                x = Number(0u, x.sign, -N_FAR, 0u);
            }
        } else if op != N_CONVERT && f.special > 1u {
            x = u_normal(x);
        }
    }
    // An addend that changes nothing, not even the sign of a zero.
    let nothing = Number(0u, x.sign, -N_FAR, 0u);
    switch op {
        case N_ADD, N_SUB: {
            z = y;
            z.sign ^= select(0u, 1u, op == N_SUB);
            y = N_ONE;
        }
        case N_MUL: {
            z = nothing;
            z.sign ^= y.sign;
            divisor = over;
        }
        case N_FUSED_MAD: {
            z = n_addend(z, over);
            divisor = over;
        }
        case N_SCALE: {
            y = N_ONE;
            y.exp += clamp(i32(b), -4096, 4096);
            z = nothing;
        }
        case N_CONVERT: {
            y = n_whole(over);
            z = nothing;
        }
        case N_FLOOR, N_ADDRESS_FLOOR, N_ADDRESS_NEAREST: {
            x = n_integral(x, over, op == N_ADDRESS_NEAREST);
            y = n_whole(over);
            z = nothing;
        }
        case N_FRC: {
            let rest = n_rest(x, over);
            let below = x.sign == 1u && rest.sig != 0u;
            // An opposite infinity for infinities, 1 for negative numbers with a rest, else a zero.
            z = Number(select(0u, 1u, x.kind == 1u), select(1u - x.sign, 1u, rest.sig == 0u), -N_FAR, 0u);
            if below && x.kind == 0u {
                z = n_whole(over);
            }
            x = rest;
            y = N_ONE;
        }
        default: {}
    }
    var w = n_sum(f, x, y, z);
    if (HAS_NORMALIZED) {
        if divisor != 1u {
            w.m = n_divided(w.m, divisor);
        }
    }
    return w;
}

// Operations computed digit by digit, before rounding. N_STEPS: a in single precision, b the number of steps.
// N_SPLIT_...: a is a word, b the bit position.
fn n_long(op: u32, f: Format, a: u32, b: u32) -> Real {
    var x = n_unpack(select(f.kind, N_FLOAT, op == N_STEPS), f.frac, a);
    var y = n_unpack(f.kind, f.frac, b);
    if (HAS_UNITS) {
        if f.special > 1u {
            let own = u_long(op, a);
            if own.known {
                return own;
            }
            x = u_normal(x);
            y = u_normal(y);
        }
    }
    let over = n_over(f);
    switch op {
        case N_RCP: {
            y = x;
            x = n_whole(over * over);
        }
        case N_DIV, N_SQRT: { x = n_addend(x, over); }
        case N_STEPS: {
            x = n_whole(n_step(x, b) * over);
            y = n_whole(b);
        }
        case N_SPLIT_SHORT, N_SPLIT_BYTE, N_SPLIT_SIGNED_BYTE: {
            x = n_addend(n_taken(op, a, b), over);
            y = n_whole(select(select(127u, 255u, op == N_SPLIT_BYTE), 65535u, op == N_SPLIT_SHORT));
        }
        default: {}
    }
    var w: Real;
    switch op {
        case N_EXP2, N_LOG2: { w = n_in_units(f, n_power(op, f, x)); }
        case N_SIN, N_COS: { w = n_in_units(f, n_circle(op, f, x)); }
        default: { w = n_quotient(op, f, x, y); }
    }
    return w;
}

fn n_select(condition: bool, yes: u32, no: u32) -> u32 {
    return select(no, yes, condition);
}

fn n_mask(condition: bool) -> u32 {
    return select(0u, 0xffffffffu, condition);
}

// Operations that need no rounding; `known` is false for all others.
fn n_simple(op: u32, f: Format, a: u32, b: u32, c: u32) -> Real {
    let float = n_is_float(f);
    let first = n_key(f, a);
    let second = n_key(f, b);
    let unordered = n_is_nan(f, a) || n_is_nan(f, b);
    let sign = a & 0x80000000u;
    var known = true;
    var raw = 0u;
    switch op {
        case N_MIN, N_MAX: {
            let takes_first = !unordered && select((first < second), (first >= second), op == N_MAX);
            raw = select(select(b, a, takes_first), N_NAN, unordered && f.special == 1u);
            if f.special == 1u && !unordered && first == second {
                raw = select(a | b, a & b, op == N_MAX);
            }
        }
        case N_NEG, N_ABS: {
            let flips = op == N_NEG || sign != 0u;
            raw = select(select(a, a ^ 0x80000000u, flips), N_NAN, n_is_nan(f, a));
            if (HAS_FINITE) {
                raw = select(raw, n_zero(f, raw >> 31u), (a & 0x7fffffffu) == 0u);
            }
            if !float {
                let least = n_extreme(f, 1u);
                let turned = select(0u - a, select(~least, least, f.overflow == 1u), a == least);
                raw = select(a, turned, flips);
            }
        }
        case N_SATURATE: {
            var one = 0x3f800000u;
            if !float {
                one = max(select(1u << f.frac, n_extreme(f, 0u), f.upper == 0u), f.over);
            }
            let clamped = select(select(a, one, first >= i32(one)), 0u, first <= 0);
            raw = select(clamped, select(0u, N_NAN, f.special == 1u), n_is_nan(f, a));
        }
        case N_FACTOR: {
            let ends = max(a & 0x7fffffffu, b & 0x7fffffffu) >= N_INFINITY;
            let zero = (a & 0x7fffffffu) == 0u || (b & 0x7fffffffu) == 0u;
            raw = select(a, 0u, float && ends && zero);
        }
        case N_SELECT_NON_NEGATIVE: { raw = n_select(first >= 0 && !n_is_nan(f, a), b, c); }
        case N_SELECT_ABOVE_HALF: {
            let half = select(max(1u << (f.frac & 31u), f.over) >> 1u, 0x3f000000u, float);
            raw = n_select(first > i32(half) && !n_is_nan(f, a), b, c);
        }
        case N_LESS: { raw = n_mask(first < second && !unordered); }
        case N_LESS_EQUAL: { raw = n_mask(first <= second && !unordered); }
        case N_EQUAL: { raw = n_mask(first == second && !unordered); }
        case N_DECODE: { raw = n_decode(f, a); }
        case N_ENCODE: { raw = n_encode(f, a); }
        case N_JOIN_PATTERN, N_JOIN_SHORT, N_JOIN_BYTE, N_JOIN_SIGNED_BYTE: {
            raw = a | (n_part(op, f, b) << (c & 31u));
        }
        case N_SPLIT_PATTERN: { raw = n_decode(f, (a >> (b & 31u)) & 0xffffu); }
        default: { known = false; }
    }
    return Real(known, raw, 0u, 0, vec3<u32>());
}

// Any operation except long ones, by its number, before rounding.
fn n_short(op: u32, f: Format, a: u32, b: u32, c: u32) -> Real {
    if (HAS_UNITS) {
        if f.special > 1u {
            let own = u_short(op, f, a, b, c);
            if own.known {
                return own;
            }
        }
    }
    var exact = n_simple(op, f, a, b, c);
    if !exact.known {
        exact = n_arith(op, f, a, b, c);
    }
    return exact;
}

// Rounds the result of an operation.
fn n_result(op: u32, f: Format, exact: Real) -> u32 {
    var result = n_finish(f, exact);
    switch op {
        case N_ADDRESS_FLOOR, N_ADDRESS_NEAREST: {
            result = n_integer(n_unpack(f.kind, f.frac, result));
            if (HAS_NORMALIZED) {
                result = u32(i32(result) / i32(n_over(f)));
            }
        }
        default: {}
    }
    return result;
}

// Any operation except N_MAD, which is a product followed by a sum.
fn n_alu(op: u32, f: Format, a: u32, b: u32, c: u32) -> u32 {
    var exact: Real;
    switch op {
        case N_DIV, N_RCP, N_SQRT, N_RSQ, N_STEPS, N_EXP2, N_LOG2, N_SIN, N_COS: { exact = n_long(op, f, a, b); }
        case N_SPLIT_SHORT, N_SPLIT_BYTE, N_SPLIT_SIGNED_BYTE: { exact = n_long(op, f, a, b); }
        default: { exact = n_short(op, f, a, b, c); }
    }
    return n_result(op, f, exact);
}

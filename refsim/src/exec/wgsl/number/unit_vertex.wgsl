
// The vertex units of NV20, NV25, NV30 and NV35.

// A result of any exponent, its sign in place: underflow gives a zero, overflow what the unit has.
fn v_finish(unit: u32, sign: u32, field: i32, mantissa: u32) -> u32 {
    let most = select(N_INFINITY, 0x7f7fffffu, unit == 2u);
    let word = select((u32(field) << 23u) | mantissa, most, field > 254);
    return sign | select(word, 0u, field < 1);
}

// The product, cut to 24 bits.
fn v_mul(unit: u32, a: u32, b: u32) -> u32 {
    let sign = (a ^ b) & U_SIGN;
    let ends = max(a & 0x7fffffffu, b & 0x7fffffffu) >= N_INFINITY;
    let zero = u_is_zero(a) || u_is_zero(b);
    // The product of 48 bits without the lowest 16.
    let high = n_mul32(u_significand(a) << 8u, u_significand(b) << 8u).x;
    let two = high >> 31u;
    let mantissa = (high >> (7u + two)) & 0x7fffffu;
    var raw = v_finish(unit, sign, u_field(a) + u_field(b) - 127 + i32(two), mantissa);
    raw = select(raw, sign | N_INFINITY, ends);
    raw = select(raw, U_NAN, u_is_nan(a) || u_is_nan(b));
    return select(raw, select(0u, U_NAN, ends && unit == 4u), zero);
}

// The sum of all addends at once: aligned to the largest with five bits more, cut, and the sum cut to 24 bits. NV2x adds
// subnormal numbers, too, in units of field 0; NV3x leaves them out.
fn v_sum(unit: u32, x: vec4<u32>) -> u32 {
    let magnitude = x & vec4<u32>(0x7fffffffu);
    let negative = x > magnitude;
    let infinite = magnitude == vec4<u32>(N_INFINITY);
    let up = any(infinite & !negative);
    let down = any(infinite & negative);
    let nan = any(magnitude > vec4<u32>(N_INFINITY)) || (up && down);
    let field = magnitude >> vec4<u32>(23u);
    let top = max(max(field.x, field.y), max(field.z, field.w));
    let mantissa = magnitude & vec4<u32>(0x7fffffu);
    let small = select(vec4<u32>(0u), mantissa, vec4<bool>(unit == 2u));
    let significand = select(mantissa | vec4<u32>(0x800000u), small, field == vec4<u32>(0u));
    let aligned = vec4<i32>((significand << vec4<u32>(5u)) >> min(vec4<u32>(top) - field, vec4<u32>(31u)));
    let addends = select(aligned, -aligned, negative);
    let total = addends.x + addends.y + addends.z + addends.w;
    let size = u32(abs(total));
    let zeros = countLeadingZeros(size);
    let sign = select(0u, U_SIGN, total < 0);
    let kept = ((size << (zeros & 31u)) >> 8u) & 0x7fffffu;
    var raw = v_finish(unit, sign, i32(top) + 3 - i32(zeros), kept);
    raw = select(raw, 0u, total == 0);
    raw = select(raw, N_INFINITY | select(0u, U_SIGN, down), up || down);
    return select(raw, U_NAN, nan);
}

// The largest integer not above; zeros give +0.
fn v_floor(x: u32) -> u32 {
    let field = u_field(x);
    let negative = x > 0x7fffffffu;
    let rest = 0x7fffffu >> u32(clamp(field - 127, 0, 23));
    var raw = (x + select(0u, rest, negative)) & ~rest;
    // Not a choice of -1 and +0: Mesa's drivers make a negated float of that, and so -0.
    raw = select(raw, select(0u, U_ONE, negative) | (x & U_SIGN), field < 127);
    raw = select(raw, x, field > 149);
    return select(select(raw, U_NAN, u_is_nan(x)), 0u, field == 0);
}

fn v_short(op: u32, unit: u32, a: u32, b: u32, c: u32) -> Real {
    var raw = 0u;
    var known = true;
    var first = a;
    var second = b;
    switch op {
        case N_ADD: {}
        case N_SUB: { second = b ^ U_SIGN; }
        case N_MUL, N_FUSED_MAD: {
            first = v_mul(unit, a, b);
            second = c;
        }
        case N_FLOOR, N_ADDRESS_FLOOR, N_FRC: {
            raw = v_floor(a);
            second = raw ^ U_SIGN;
        }
        default: { known = false; }
    }
    switch op {
        case N_MUL: { raw = first; }
        case N_FLOOR, N_ADDRESS_FLOOR: {}
        default: { raw = v_sum(unit, vec4<u32>(first, second, 0u, 0u)); }
    }
    return Real(known, raw, 0u, 0, vec3<u32>());
}

fn v_rcp(x: u32) -> u32 {
    let mantissa = x & 0x7fffffu;
    let significand = u_significand(x);
    var a = v_rcp_row(mantissa >> 17u);
    a = u_right(n_mul32(0x80000000u - a * significand, a), 24u).y;
    a = u_right(u_times(u_minus(vec2<u32>(32u, 0u), n_mul32(a, significand)), a), 25u).y;
    let power = mantissa == 0u;
    let field = select(253, 254, power) - u_field(x);
    var raw = select((u32(field) << 23u) | select(a & 0x7fffffu, 0u, power), 0u, field < 1);
    raw = select(raw, N_INFINITY, u_is_zero(x)) | (x & U_SIGN);
    return select(raw, U_NAN, u_is_nan(x));
}

fn v_rsq(unit: u32, x: u32) -> u32 {
    let negative = unit == 4u && x > 0x7fffffffu;
    let even = 1u - ((x >> 23u) & 1u);
    let mantissa = x & 0x7fffffu;
    let g = u_significand(x) << even;
    var a = v_rsq_row(64u * even + (mantissa >> 17u));
    a = u_times(u_minus(vec2<u32>(96u, 0u), n_mul32(a * a, g)), a).x;
    a = u_times(u_minus(vec2<u32>(0x60000u, 0u), n_mul32(a * a, g)), a).x >> 7u;
    let power = unit != 2u && even == 0u && mantissa == 0u;
    let field = u32(126 - ((u_field(x) - 127 - i32(even)) >> 1u)) + select(0u, 1u, power);
    var raw = (field << 23u) | select(a & 0x7fffffu, 0u, power);
    raw = select(raw, 0u, (x & 0x7fffffffu) == N_INFINITY);
    raw = select(raw, U_NAN, negative);
    raw = select(raw, N_INFINITY | select(0u, U_SIGN, negative), u_is_zero(x));
    return select(raw, U_NAN, u_is_nan(x));
}

// x 2^13 rounded down, saturated; what is below 2^-23 gives 0.
fn v_fixed(x: u32) -> i32 {
    let field = u_field(x);
    let negative = x > 0x7fffffffu;
    let size = i32(u_significand(x));
    let value = select(size, -size, negative);
    let near = select(value >> u32(clamp(137 - field, 0, 31)), value << u32(clamp(field - 137, 0, 7)), field > 137);
    let far = select(0x7fffffff, i32(0x80000000u), negative && !u_is_nan(x));
    return select(select(near, far, field > 144), 0, field < 104);
}

// 2^(p / 2^13).
fn v_power(p: i32) -> u32 {
    let row = v_exp_row(u32(p >> 8u) & 31u);
    let whole = p >> 13u;
    let raw = (u32(whole + 127) << 23u) | (2u * (256u * (row & 0xffffu) + (row >> 16u) * (u32(p) & 255u)));
    return select(select(raw, N_INFINITY, whole > 127), 0u, whole < -126);
}

// log2 |x| in units of 2^-26.
fn v_logarithm(x: u32) -> vec2<u32> {
    let mantissa = x & 0x7fffffu;
    let row = v_log_row(mantissa >> 18u);
    let part = 256u * (row & 0x3ffffu) + (row >> 18u) * ((mantissa >> 10u) & 255u);
    return u_add(u_wide(u_field(x) - 127, 26u), vec2<u32>(0u, part));
}

// The fraction of EXP.
fn v_fraction(x: u32) -> u32 {
    let field = u_field(x);
    let negative = x > 0x7fffffffu;
    let significand = u_significand(x);
    // A negative number above -1 is first rounded down to a multiple of 2^-23.
    let down = u32(clamp(127 - field, 0, 24));
    let size = (significand + (1u << down) - 1u) >> down;
    let places = u32(clamp(150 - max(field, 127), 0, 31));
    let value = select(size, 0u - size, negative) & ((1u << places) - 1u);
    var raw = u_cut(false, vec2<u32>(0u, value), i32(places));
    raw = select(raw, U_ONE, negative && field < 104);
    raw = select(raw, x, !negative && field < 127);
    raw = select(raw, 0u, field == 0 || field > 149);
    return select(raw, x, u_is_nan(x));
}

// What LOG gives in every component, if the operand is no number, or negative in modern programs.
fn v_log_special(unit: u32, x: u32, raw: u32) -> u32 {
    let nan = select(U_NAN, x & 0x7fffffffu, unit == 2u);
    return select(select(raw, U_NAN, unit == 4u && x > 0x7fffffffu), nan, u_is_nan(x));
}

// EXP, LOG and LIT, whose powers and logarithms are the same.
fn v_lighting(op: u32, unit: u32, x: u32, y: u32, w: u32) -> u32 {
    let field = u_field(x);
    let negative = x > 0x7fffffffu;
    let logarithm = v_logarithm(select(x, y, op == N_LIT_SPECULAR));
    var p = v_fixed(select(x, w, op == N_LIT_SPECULAR));
    var over = false;
    var under = false;
    switch op {
        case N_EXP_FLOOR: { p = p & ~8191; }
        case N_LIT_SPECULAR: {
            let exponent = clamp(p, -1048576, 1048575);
            var product = u_times(logarithm, u32(exponent));
            product.x -= select(0u, logarithm.y, exponent < 0);
            product = u_right(product, 26u);
            let size = i32(product.x);
            p = i32(product.y);
            over = size > 0 || (size == 0 && p < 0);
            under = size < -1 || (size == -1 && p >= 0);
        }
        default: {}
    }
    let power = select(select(v_power(p), N_INFINITY, over), 0u, under);
    var raw = 0u;
    switch op {
        case N_EXP_FLOOR: { raw = power; }
        case N_EXP_FRACTION: { raw = v_fraction(x); }
        case N_EXP_POWER: { raw = select(power, U_NAN, u_is_nan(x)); }
        case N_LOG_EXPONENT: {
            let whole = field - 127;
            raw = u_cut(whole < 0, vec2<u32>(0u, u32(abs(whole))), 0);
            raw = select(raw, N_INFINITY, field == 255);
            raw = v_log_special(unit, x, select(raw, N_INFINITY | U_SIGN, field == 0));
        }
        case N_LOG_MANTISSA: {
            raw = v_log_special(unit, x, U_ONE | select(x & 0x7fffffu, 0u, field == 0));
        }
        case N_LOG_POWER: {
            let below = (logarithm.x >> 31u) == 1u;
            raw = u_cut(below, select(logarithm, u_minus(vec2<u32>(), logarithm), below), 26);
            raw = select(raw, N_INFINITY, field == 255);
            raw = v_log_special(unit, x, select(raw, N_INFINITY | U_SIGN, field == 0));
        }
        case N_LIT_DIFFUSE: { raw = select(x, 0u, negative); }
        default: {
            let down = w > 0x7fffffffu;
            raw = select(power, select(N_INFINITY, 0u, down), (y & 0x7fffffffu) == N_INFINITY);
            raw = select(raw, select(0u, N_INFINITY, down), y > 0x7fffffffu || u_is_zero(y));
            raw = select(raw, U_NAN, u_is_nan(y) || u_is_nan(w));
            raw = select(raw, U_ONE, u_is_zero(w));
            raw = select(raw, 0u, negative || field == 0);
        }
    }
    return raw;
}

// v / 2^k, halves up; k above 0.
fn v_half(v: i32, k: u32) -> i32 {
    return (v + (1 << (k - 1u))) >> k;
}

// Quadratic interpolation of 23 bits x, in units of 2^-38: partial products are rounded one by one.
fn v_interpolate(op: u32, x: u32) -> vec2<u32> {
    let odd = (x >> 16u) & 1u;
    let r = i32(x & 0xffffu) - i32(odd << 16u);
    let at = (x >> 17u) + odd;
    var row: vec2<u32>;
    switch op {
        case N_LOG2: { row = v_lg2_row(at); }
        case N_EXP2: { row = v_ex2_row(at); }
        case N_SIN, N_COS: { row = v_sincos_row(at); }
        default: {}
    }
    let q = r >> 7u;
    var square = q * q + select(0, q, (r & 64) != 0);
    for (var i = 0u; i < 6u; i++) {
        square += select(0, v_half(r, 13u - i), ((r >> i) & 1) != 0);
    }
    var product = 0;
    var slope = (row.y & 0xffffffu) << 1u;
    for (var i = 0u; i < 13u; i++) {
        // Booth's digits: 0 1 1 2 -2 -1 -1 0.
        let bits = slope & 7u;
        let place = 2 * i32(i) - 14 + select(0, 1, bits == 3u || bits == 4u);
        let part = select(v_half(r, u32(max(-place, 1))), r << u32(max(place, 0)), place >= 0);
        product += select(select(part, -part, bits > 3u), 0, bits == 0u || bits == 7u);
        slope = slope >> 2u;
    }
    let curve = i32(((row.x >> 24u) | ((row.y >> 24u) << 8u))) * square;
    let bend = select(-((curve + ((square - 1024) >> 12u) + 32) >> 5u), curve >> 5u, op == N_EXP2);
    let base = row.x & 0xffffffu;
    return u_add(u_add(vec2<u32>(base >> 17u, base << 15u), u_wide(product, 6u)), u_wide(bend, 0u));
}

// An angle in units of 2^-25 turns.
fn v_angle(x: u32) -> u32 {
    var sum = vec2<u32>(2u, 2347109816u);
    for (var i = 0u; i < 23u; i++) {
        if ((x >> i) & 1u) == 1u {
            sum = u_add(sum, vec2<u32>(select(0u, 1u, i == 22u), v_angle_row(i)));
        }
    }
    let turns = (sum.x << 24u) | (sum.y >> 8u);
    let field = u_field(x);
    let shift = field - select(select(select(select(130, 98, field < 99), 162, field >= 162), 194, field >= 194), 226, field >= 226);
    let scaled = select(turns >> u32(max(-shift, 0)), turns << u32(max(shift, 0)), shift >= 0);
    return select(scaled, ~scaled, x > 0x7fffffffu);
}

// LG2, EX2, SIN and COS of NV3x.
fn v_function(op: u32, x: u32) -> u32 {
    let field = u_field(x);
    let negative = x > 0x7fffffffu;
    var place = x & 0x7fffffu;
    var whole = field - 127;
    var turns = 0u;
    switch op {
        case N_EXP2: {
            let size = i32(u_significand(x));
            var value = select(size >> u32(clamp(127 - field, 0, 31)), size << u32(clamp(field - 127, 0, 6)), field > 126);
            value = select(value, ~value, negative);
            whole = value >> 23u;
            place = u32(value) & 0x7fffffu;
        }
        case N_SIN, N_COS: {
            turns = v_angle(x) + select(0u, 0x800000u, op == N_COS);
            place = select(turns, ~turns, (turns & 0x800000u) != 0u) & 0x7fffffu;
        }
        default: {}
    }
    let found = v_interpolate(op, place);
    var raw = 0u;
    switch op {
        case N_LOG2: {
            raw = u_cut_signed(u_add(found, vec2<u32>(u32(whole) << 6u, 0u)), 38);
            raw = select(select(raw, N_INFINITY, field == 255), U_NAN, negative || u_is_nan(x));
            raw = select(raw, N_INFINITY | U_SIGN, field == 0);
        }
        case N_EXP2: {
            raw = (u32(whole + 127) << 23u) | (found.x << 17u) | (found.y >> 15u);
            raw = select(raw, 0u, whole < -126);
            raw = select(raw, U_ONE, field < 70);
            raw = select(raw, select(N_INFINITY, 0u, negative), field > 133);
            raw = select(raw, U_NAN, u_is_nan(x));
        }
        case N_SIN, N_COS: {
            raw = u_cut((turns & 0x1000000u) != 0u, found, 38);
            let small = select(select(raw, 0u, field < 96), select(raw, U_ONE, field < 112), op == N_COS);
            raw = select(small, U_NAN, field == 255);
        }
        default: {}
    }
    return raw;
}

fn v_long(op: u32, unit: u32, a: u32, b: u32) -> Real {
    var raw = 0u;
    var known = true;
    switch op {
        case N_RCP: { raw = v_rcp(a); }
        case N_RSQ: { raw = v_rsq(unit, a); }
        case N_EXP2, N_LOG2, N_SIN, N_COS: {
            known = unit != 2u;
            raw = v_function(op, a);
        }
        case N_EXP_FLOOR, N_EXP_FRACTION, N_EXP_POWER, N_LOG_EXPONENT, N_LOG_MANTISSA, N_LOG_POWER, N_LIT_DIFFUSE, N_LIT_SPECULAR: {
            raw = v_lighting(op, unit, a, b, u_third);
        }
        default: { known = false; }
    }
    return Real(known, raw, 0u, 0, vec3<u32>());
}

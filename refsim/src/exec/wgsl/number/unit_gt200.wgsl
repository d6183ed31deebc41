
// GT200. Subnormal operands always count as zeros of their sign.

// Rounds (-1)^sign m 2^exp to 24 bits with an unlimited exponent; a result below 2^-126 becomes a zero. A sum of MAD
// below 2^-126 is rounded to a multiple of 2^-149, which is 2^-126 or flushed.
fn g_round(zero: bool, mad: bool, x: Real) -> u32 {
    var m = x.m;
    var top = x.exp + 95;
    for (var i = 0u; i < 2u; i++) {
        let empty = m.x == 0u;
        m = select(m, vec3<u32>(m.y, m.z, 0u), empty);
        top -= select(0, 32, empty);
    }
    let left = countLeadingZeros(m.x) & 31u;
    top -= i32(left);
    m = (m << vec3<u32>(left)) | ((vec3<u32>(m.y, m.z, 0u) >> vec3<u32>(1u)) >> vec3<u32>(31u - left));
    let kept = m.x >> 8u;
    let half = (m.x & 0x80u) != 0u;
    let below = ((m.x & 0x7fu) | m.y | m.z) != 0u;
    let up = (!zero && half && (below || (kept & 1u) == 1u)) || (mad && top == -127);
    let rounded = kept + select(0u, 1u, up);
    let field = top + 127 + i32(rounded >> 24u);
    var raw = (u32(field) << 23u) | ((rounded >> (rounded >> 24u)) & 0x7fffffu);
    raw = select(raw, select(N_INFINITY, 0x7f7fffffu, zero), field > 254);
    raw = select(raw, 0u, field < 1 || (m.x | m.y | m.z) == 0u);
    return (x.sign << 31u) | raw;
}

// N_ADD, N_SUB, N_MUL, N_FUSED_MAD, N_SCALE (b is the power). The product of a MAD is truncated to 24 bits, unless an
// operand is zero.
fn g_sum(op: u32, f: Format, a: u32, b: u32, c: u32) -> u32 {
    let wins = f.special == 3u && (u_is_zero(a) || u_is_zero(b));
    var x = u_normal(n_unpack(N_FLOAT, 23u, a));
    var y = u_normal(n_unpack(N_FLOAT, 23u, b));
    var z = u_normal(n_unpack(N_FLOAT, 23u, c));
    let mad = op == N_FUSED_MAD;
    switch op {
        case N_ADD, N_SUB: {
            z = y;
            z.sign ^= select(0u, 1u, op == N_SUB);
            y = N_ONE;
        }
        case N_FUSED_MAD: {
            if wins {
                x = z;
                y = N_ONE;
                z = n_whole(0u);
            }
        }
        case N_SCALE: {
            y = N_ONE;
            y.exp += clamp(i32(b), -1000, 1000);
            z = Number(0u, x.sign, -N_FAR, 0u);
        }
        default: {
            if wins {
                x = n_whole(0u);
                y = N_ONE;
            }
            z = Number(0u, x.sign ^ y.sign, -N_FAR, 0u);
        }
    }
    let plain = (x.kind | y.kind | z.kind) != 0u || x.sig == 0u || y.sig == 0u || z.sig == 0u;
    let cut = mad && !plain;
    if cut {
        let product = n_mul32(x.sig, y.sig);
        let two = product.x >> 31u;
        x.sign ^= y.sign;
        x.exp += y.exp + 31 + i32(two);
        x.sig = select((product.x << 1u) | (product.y >> 31u), product.x, two == 1u) & 0xffffff00u;
        y = N_ONE;
    }
    let exact = n_sum(N_FP32, x, y, z);
    var raw = g_round(f.rounding == 2u && !mad, cut, exact);
    // A product that is flushed to zero is still added to a zero addend: -0 only if both are -0.
    if mad && z.kind == 0u && z.sig == 0u && (raw & 0x7fffffffu) == 0u {
        raw &= z.sign << 31u;
    }
    raw = select(raw, exact.raw, exact.known);
    return select(raw, U_NAN, u_is_nan(raw));
}

// MIN, or MAX if `greater`. If one operand is NaN, returns the other one; -0 is below +0.
fn g_choose(a: u32, b: u32, greater: bool) -> u32 {
    let x = u_flushed(a);
    let y = u_flushed(b);
    let first = ((u_order(y) < u_order(x)) == greater || u_is_nan(b)) && !u_is_nan(a);
    return select(select(y, x, first), U_NAN, u_is_nan(a) && u_is_nan(b));
}

// The square of the 17-bit y, in units of 2^17, from individually truncated partial products.
fn g_square(y: u32) -> u32 {
    var sum = 0u;
    for (var i = 0u; i < 17u; i++) {
        sum += select(0u, y >> (18u - i), ((y >> i) & 1u) == 1u);
    }
    return sum >> 1u;
}

// Assembles a result from its interpolated significand, 2^23 to 2^24.
fn g_finish(sign: u32, field: i32, significand: u32) -> u32 {
    let place = field + i32(significand >> 24u);
    let raw = select((u32(place) << 23u) | (significand & 0x7fffffu), N_INFINITY, place > 254);
    return sign | select(raw, 0u, place < 1);
}

// Converts an operand of SIN and COS to quarter turns in units of 2^-23, 25 bits.
fn g_angle(x: u32) -> u32 {
    let turns = n_mul32(u_significand(x), 10680707u);
    let size = (turns.x << 16u) | (turns.y >> 16u);
    let shift = u_field(x) - 135;
    let raw = select(size >> u32(clamp(-shift, 0, 31)), size << u32(clamp(shift, 0, 31)), shift >= 0);
    return select(raw, 0u, shift > 31 || u_is_zero(x) || (shift < -31)) & 0x1ffffffu;
}

// RCP, RSQRT, LG2, SIN, COS, EX2: table lookup, quadratic interpolation, assembly of the result.
fn g_function(op: u32, x: u32) -> u32 {
    let field = u_field(x);
    let sign = x & U_SIGN;
    let negative = sign != 0u;
    let mantissa = x & 0x7fffffu;
    let nan = u_is_nan(x);
    var whole = field - 127;
    // 23 bits; 24 bits for RSQRT.
    var place = mantissa;
    var quarter = 0u;
    switch op {
        case N_RSQ: {
            place = mantissa | ((u32(whole) & 1u) << 23u);
            whole = whole >> 1u;
        }
        case N_SIN, N_COS: {
            let turns = g_angle(x);
            quarter = (turns >> 23u) + select(0u, 1u, op == N_COS);
            place = turns & 0x7fffffu;
            place = select(place, 0x7fffffu - place, (quarter & 1u) == 1u);
        }
        case N_EXP2: {
            let size = u_significand(x);
            let shifted = select(size >> u32(clamp(127 - field, 0, 31)), size << u32(clamp(whole, 0, 6)), whole > 0);
            let fixed_point = select(shifted, 0u, field == 0);
            let part = fixed_point & 0x7fffffu;
            whole = i32(fixed_point >> 23u);
            whole = select(whole, -whole - select(0, 1, part != 0u), negative);
            place = select(part, 0x7fffffu - part, negative && part != 0u);
        }
        default: {}
    }
    var row: vec2<u32>;
    var r = place & 0x1ffffu;
    var left = 13u;
    var scale = 1u;
    var more = 0u;
    var falls = false;
    var bends_down = false;
    switch op {
        case N_RCP: {
            row = g_rcp_row(place >> 16u);
            r = place & 0xffffu;
            more = 18407u;
            falls = true;
        }
        case N_RSQ: {
            row = g_rsq_row(place >> 17u);
            left = 14u;
            scale = 4u;
            more = 32767u;
            falls = true;
        }
        case N_LOG2: {
            row = g_lg2_row(place >> 17u);
            left = 12u;
            scale = 2u;
            more = 13125u;
            bends_down = true;
        }
        case N_SIN, N_COS: {
            row = g_sin_row(place >> 17u);
            left = 11u;
            bends_down = true;
        }
        case N_EXP2: {
            row = g_ex2_row(place >> 17u);
            more = 30690u;
        }
        default: {}
    }
    var slope = n_mul32(row.y & 0xffffu, r);
    var bend = vec2<u32>(0u, (row.y >> 16u) * scale * g_square(select(r, 2u * r, op == N_RCP)));
    slope = select(slope, u_minus(vec2<u32>(), slope), falls);
    bend = select(bend, u_minus(vec2<u32>(), bend), bends_down);
    let sum = u_add(u_add(u_add(u_wide(i32(row.x), left), slope), bend), vec2<u32>(0u, more));
    var raw = 0u;
    switch op {
        case N_RCP: {
            raw = g_finish(sign, 253 - field, u_right(sum, 15u).y);
            raw = select(raw, sign, field == 255);
            raw = select(raw, sign | N_INFINITY, field == 0);
        }
        case N_RSQ: {
            raw = g_finish(0u, 126 - whole, u_right(sum, 16u).y);
            raw = select(raw, u32(127 - whole) << 23u, place == 0u);
            raw = select(select(raw, 0u, field == 255), U_NAN, negative);
            raw = select(raw, sign | N_INFINITY, field == 0);
        }
        case N_LOG2: {
            let part = select(u_right(sum, 2u), vec2<u32>(), mantissa == 0u && field == 127);
            raw = u_cut_signed(u_add(part, vec2<u32>(u32(whole) << 4u, 0u)), 36);
            raw = select(select(raw, N_INFINITY, field == 255), U_NAN, negative);
            raw = select(raw, U_SIGN | N_INFINITY, field == 0);
        }
        case N_SIN, N_COS: {
            let below = (negative && op == N_SIN) != ((quarter & 2u) != 0u);
            raw = select(u_cut(below, sum, 37), U_NAN, field == 255);
        }
        case N_EXP2: {
            raw = g_finish(0u, whole + 127, u_right(sum, 15u).y);
            raw = select(raw, select(N_INFINITY, 0u, negative), field > 133);
        }
        default: {}
    }
    return select(raw, U_NAN, nan);
}

// Result of a long operation by the unit; `known` is false if the ideal unit computes it.
fn u_long(op: u32, a: u32) -> Real {
    var raw = 0u;
    var known = true;
    switch op {
        case N_RCP, N_RSQ, N_EXP2, N_LOG2, N_SIN, N_COS: { raw = g_function(op, a); }
        default: { known = false; }
    }
    return Real(known, raw, 0u, 0, vec3<u32>());
}

// The operations by name. Each call is a copy of its text for some compilers: where there are many, call n_alu from one place.

fn n_add(f: Format, a: u32, b: u32) -> u32 { return n_alu(N_ADD, f, a, b, 0u); }
fn n_sub(f: Format, a: u32, b: u32) -> u32 { return n_alu(N_SUB, f, a, b, 0u); }
fn n_mul(f: Format, a: u32, b: u32) -> u32 { return n_alu(N_MUL, f, a, b, 0u); }
fn n_div(f: Format, a: u32, b: u32) -> u32 { return n_alu(N_DIV, f, a, b, 0u); }
fn n_mad(f: Format, a: u32, b: u32, c: u32) -> u32 { return n_alu(N_MAD, f, a, b, c); }
fn n_fma(f: Format, a: u32, b: u32, c: u32) -> u32 { return n_alu(N_FUSED_MAD, f, a, b, c); }
fn n_sqrt(f: Format, a: u32) -> u32 { return n_alu(N_SQRT, f, a, 0u, 0u); }
fn n_rcp(f: Format, a: u32) -> u32 { return n_alu(N_RCP, f, a, 0u, 0u); }
fn n_rsq(f: Format, a: u32) -> u32 { return n_alu(N_RSQ, f, a, 0u, 0u); }
fn n_exp2(f: Format, a: u32) -> u32 { return n_alu(N_EXP2, f, a, 0u, 0u); }
fn n_log2(f: Format, a: u32) -> u32 { return n_alu(N_LOG2, f, a, 0u, 0u); }
fn n_floor(f: Format, a: u32) -> u32 { return n_alu(N_FLOOR, f, a, 0u, 0u); }
fn n_frc(f: Format, a: u32) -> u32 { return n_alu(N_FRC, f, a, 0u, 0u); }
fn n_scale(f: Format, a: u32, shift: i32) -> u32 { return n_alu(N_SCALE, f, a, u32(shift), 0u); }
fn n_min(f: Format, a: u32, b: u32) -> u32 { return n_simple(N_MIN, f, a, b, 0u).raw; }
fn n_max(f: Format, a: u32, b: u32) -> u32 { return n_simple(N_MAX, f, a, b, 0u).raw; }
fn n_neg(f: Format, a: u32) -> u32 { return n_simple(N_NEG, f, a, 0u, 0u).raw; }
fn n_abs(f: Format, a: u32) -> u32 { return n_simple(N_ABS, f, a, 0u, 0u).raw; }
fn n_saturate(f: Format, a: u32) -> u32 { return n_simple(N_SATURATE, f, a, 0u, 0u).raw; }
fn n_factor(f: Format, a: u32, b: u32) -> u32 { return n_simple(N_FACTOR, f, a, b, 0u).raw; }
fn n_lt(f: Format, a: u32, b: u32) -> bool { return n_simple(N_LESS, f, a, b, 0u).raw != 0u; }
fn n_le(f: Format, a: u32, b: u32) -> bool { return n_simple(N_LESS_EQUAL, f, a, b, 0u).raw != 0u; }
fn n_eq(f: Format, a: u32, b: u32) -> bool { return n_simple(N_EQUAL, f, a, b, 0u).raw != 0u; }
fn n_above_half(f: Format, a: u32) -> bool { return n_simple(N_SELECT_ABOVE_HALF, f, a, 1u, 0u).raw != 0u; }
fn n_address_floor(f: Format, a: u32) -> i32 { return i32(n_alu(N_ADDRESS_FLOOR, f, a, 0u, 0u)); }
fn n_address_nearest(f: Format, a: u32) -> i32 { return i32(n_alu(N_ADDRESS_NEAREST, f, a, 0u, 0u)); }

// A single precision value clamped to [0, 1] and rounded to so many steps, halves up, as a number of the format.
fn n_unorm(f: Format, steps: u32, single: u32) -> u32 {
    return n_arith(N_STEPS, f, single, steps, 0u);
}

// A raw value of one format rounded into another.
fn n_convert(from_format: Format, to: Format, a: u32) -> u32 {
    let x = n_unpack(from_format.kind, from_format.frac, a);
    return n_finish(to, n_sum(to, x, N_ONE, Number(0u, x.sign, -N_FAR, 0u)));
}

// The sum of the first products, at most 4, rounded once: an integer of 672 bits in units of 2^-384 holds every partial sum.
fn n_dot(f: Format, terms: u32, a: vec4<u32>, b: vec4<u32>) -> u32 {
    var left = a;
    var right = b;
    var sum: array<u32, 21>;
    var bad = false;
    var nan = false;
    var infinite = vec2<bool>(false, false);
    var signs = vec2<bool>(false, false);
    for (var k = 0u; k < min(terms, 4u); k++) {
        let x = n_unpack(f.kind, f.frac, left[k]);
        let y = n_unpack(f.kind, f.frac, right[k]);
        let sign = x.sign ^ y.sign;
        let side = vec2<bool>(sign == 0u, sign == 1u);
        let ends = x.kind == 1u || y.kind == 1u;
        let zero = (x.kind == 0u && x.sig == 0u) || (y.kind == 0u && y.sig == 0u);
        signs = signs | side;
        if x.kind == 2u || y.kind == 2u {
            nan = true;
        } else if ends && zero {
            bad = true;
        } else if ends {
            infinite = infinite | side;
        } else if !zero {
            let p = n_mul32(x.sig, y.sig);
            let place = u32(x.exp + y.exp + 384);
            let spread = n_right(vec3<u32>(p.x, p.y, 0u), 32u - (place & 31u));
            let at = place >> 5u;
            var carry = sign;
            for (var j = 0u; j < 21u; j++) {
                var word = 0u;
                if j == at { word = spread.z; }
                if j == at + 1u { word = spread.y; }
                if j == at + 2u { word = spread.x; }
                word = select(word, ~word, sign == 1u);
                let low = sum[j] + word;
                let total = low + carry;
                carry = select(0u, 1u, low < word || total < low);
                sum[j] = total;
            }
        }
    }
    if bad || nan || all(infinite) {
        return n_nan(f);
    }
    if any(infinite) {
        return n_infinite(f, select(0u, 1u, infinite.y));
    }
    // The three highest words that hold something, the rest jammed.
    let negative = sum[20] >> 31u;
    var carry = negative;
    for (var j = 0u; j < 21u; j++) {
        let word = select(sum[j], ~sum[j], negative == 1u);
        sum[j] = word + carry;
        carry = select(0u, 1u, sum[j] < word);
    }
    var m = vec3<u32>();
    var count = 0u;
    var rest = 0u;
    var last = 0u;
    for (var j = 0u; j < 21u; j++) {
        let word = sum[20u - j];
        if count == 3u {
            rest |= word;
        } else if count > 0u || word != 0u || j == 18u {
            m = vec3<u32>(m.y, m.z, word);
            count += 1u;
            last = 20u - j;
        }
    }
    m.z |= select(0u, 1u, rest != 0u);
    // An exact zero has the sign of the products, or the one of the rounding if theirs differ.
    var sign = negative;
    if (m.x | m.y | m.z) == 0u {
        sign = select(0u, 1u, select(signs.y, f.rounding == 3u, all(signs)));
    }
    return n_round_real(f, sign, 32 * i32(last) - 384, m);
}

// Number formats, and the only place that rounds.
//
// Values are raw: a fixed-point number is a sign-extended integer, a float of any format is the binary32 pattern of the
// same number, and NaN is 0x7fc00000. Magnitudes of 96 bits are vec3, the highest word first. A last bit of 1 may
// represent any nonzero bits after it ("jammed"); rounding at least two places above gives the same result.

struct Format {
    kind: u32,       // 0 fixed, 1 IEEE float; 2 float without infinity, 3 also without NaN, 4 without infinity and -0
    upper: u32,      // integer bits, or exponent bits
    frac: u32,       // fraction bits, or stored mantissa bits
    rounding: u32,   // 0 nearest even, 1 nearest away, 2 toward zero, 3 down, 4 up, 5 to odd
    overflow: u32,   // 0 saturate, 1 wrap, 2 infinity, 3 as NV_fragment_program
    denormals: u32,  // 0 keep, 1 flush
    special: u32,    // 0 Direct3D, 1 NV_fragment_program
    over: u32,       // denominator of a normalized format (of kind 0, without fraction bits), else 0
}

const N_FIXED: u32 = 0u;
const N_FLOAT: u32 = 1u;
const N_NAN: u32 = 0x7fc00000u;
const N_INFINITY: u32 = 0x7f800000u;
const N_FP32: Format = Format(1u, 8u, 23u, 0u, 2u, 0u, 0u, 0u);
// Larger than every exponent.
const N_FAR: i32 = 1048576;

// (-1)^sign sig 2^exp, with the leading bit of sig set; zero has sig 0 and exp -N_FAR. kind: 0 finite, 1 infinite, 2
// NaN.
struct Number {
    kind: u32,
    sign: u32,
    exp: i32,
    sig: u32,
}

// An unrounded result, (-1)^sign m 2^exp divided by the denominator of the format; or, if `known`, the final raw value.
struct Real {
    known: bool,
    raw: u32,
    sign: u32,
    exp: i32,
    m: vec3<u32>,
}

fn n_known(raw: u32) -> Real {
    return Real(true, raw, 0u, 0, vec3<u32>());
}

fn n_is_float(f: Format) -> bool {
    if (HAS_FIXED) {
        return f.kind != N_FIXED;
    }
    return true;
}

// Result of an invalid operation: NaN, or zero in formats without NaN.
fn n_nan(f: Format) -> u32 {
    if (HAS_FINITE) {
        if f.kind == 3u {
            return 0u;
        }
    }
    if (HAS_UNITS) {
        if f.special > 1u {
            return U_NAN;
        }
    }
    return select(0u, N_NAN, n_is_float(f));
}

fn n_zero(f: Format, sign: u32) -> u32 {
    if (HAS_FINITE) {
        if f.kind == 4u {
            return 0u;
        }
    }
    return select(0u, sign << 31u, n_is_float(f));
}

// The largest finite number, with a sign.
fn n_extreme(f: Format, sign: u32) -> u32 {
    var exponent = (1u << ((f.upper - 1u) & 31u)) + 126u;
    var ones = (1u << f.frac) - 1u;
    if (HAS_FINITE) {
        exponent += select(0u, 1u, f.kind == 2u || f.kind == 3u);
        ones -= select(0u, 1u, f.kind == 2u);
    }
    let float = (sign << 31u) | (exponent << 23u) | (ones << ((23u - f.frac) & 31u));
    let most = (1u << (f.upper + f.frac)) - 1u;
    return select(select(most, ~most, sign == 1u), float, n_is_float(f));
}

// The value for an infinite result: infinity if the format has it, else NaN, else the largest number.
fn n_unbounded(f: Format, sign: u32) -> u32 {
    if (HAS_FINITE) {
        if f.kind == 3u {
            return n_extreme(f, sign);
        }
        if f.kind > 1u {
            return N_NAN;
        }
    }
    return select(n_extreme(f, sign), (sign << 31u) | N_INFINITY, n_is_float(f));
}

// An exactly infinite result of finite operands.
fn n_pole(f: Format, sign: u32) -> u32 {
    return select(n_extreme(f, sign), n_unbounded(f, sign), f.overflow != 0u);
}

// The result of an infinite operand.
fn n_infinite(f: Format, sign: u32) -> u32 {
    if (HAS_FINITE) {
        if f.kind > 1u {
            return n_pole(f, sign);
        }
    }
    return n_unbounded(f, sign);
}

// Result of a float overflow; `huge` if the exponent is too large even before rounding.
fn n_overflow(f: Format, sign: u32, huge: bool) -> u32 {
    var infinite = f.rounding < 2u || f.rounding == 4u - sign;
    if f.overflow == 0u {
        infinite = false;
    } else if f.overflow == 3u {
        infinite = huge;
    }
    return select(n_extreme(f, sign), n_unbounded(f, sign), infinite);
}

// x 2^s, without the bits that leave the word on either side.
fn n_shift(x: u32, s: i32) -> u32 {
    if s >= 32 || s <= -32 {
        return 0u;
    }
    return select(x >> (u32(-s) & 31u), x << (u32(s) & 31u), s >= 0);
}

// m / 2^s, with the last bit jammed.
fn n_right(m: vec3<u32>, s: u32) -> vec3<u32> {
    let one = (s >> 5u) == 1u;
    let two = (s >> 5u) == 2u;
    let more = s >= 96u;
    var y = select(select(m, vec3<u32>(0u, m.x, m.y), one), vec3<u32>(0u, 0u, m.x), two);
    y = select(y, vec3<u32>(), more);
    var lost = select(select(0u, m.z, one), m.y | m.z, two);
    lost = select(lost, m.x | m.y | m.z, more);
    // Shifts by 32 - bits in two parts, because WGSL has no shift by 32.
    let bits = vec3<u32>(s & 31u);
    let back = vec3<u32>(31u) - bits;
    lost |= (y.z << 1u) << back.z;
    y = (y >> bits) | ((vec3<u32>(0u, y.x, y.y) << vec3<u32>(1u)) << back);
    y.z |= select(0u, 1u, lost != 0u);
    return y;
}

// a + b + carry modulo 2^96.
fn n_add96(a: vec3<u32>, b: vec3<u32>, carry: u32) -> vec3<u32> {
    let low = a.z + b.z;
    let z = low + carry;
    let c = select(0u, 1u, low < a.z || z < low);
    let middle = a.y + b.y;
    let y = middle + c;
    let d = select(0u, 1u, middle < a.y || y < middle);
    return vec3<u32>(a.x + b.x + d, y, z);
}

// The 64-bit product, high word first.
fn n_mul32(a: u32, b: u32) -> vec2<u32> {
    let a0 = a & 0xffffu;
    let a1 = a >> 16u;
    let b0 = b & 0xffffu;
    let b1 = b >> 16u;
    let low = a0 * b0;
    let middle = a1 * b0 + (low >> 16u);
    let other = a0 * b1 + (middle & 0xffffu);
    return vec2<u32>(a1 * b1 + (middle >> 16u) + (other >> 16u), (other << 16u) | (low & 0xffffu));
}

// Denominator of the format's numbers.
fn n_over(f: Format) -> u32 {
    if (HAS_NORMALIZED) {
        return max(f.over, 1u);
    }
    return 1u;
}

// m k modulo 2^96.
fn n_times(m: vec3<u32>, k: u32) -> vec3<u32> {
    let middle = n_mul32(m.y, k);
    let low = n_mul32(m.z, k);
    return n_add96(vec3<u32>(m.x * k, middle.y, low.y), vec3<u32>(middle.x, low.x, 0u), 0u);
}

// Converts m 2^exp to units of the format.
fn n_in_units(f: Format, x: Real) -> Real {
    var y = x;
    if (HAS_NORMALIZED) {
        if f.over != 0u {
            let high = (x.m.x >> 24u) != 0u;
            y.m = n_times(select(x.m, n_right(x.m, 8u), high), f.over);
            y.exp += select(0, 8, high);
        }
    }
    return y;
}

// Converts an integer to a number.
fn n_whole(x: u32) -> Number {
    let zeros = countLeadingZeros(x);
    return Number(0u, 0u, select(-i32(zeros), -N_FAR, x == 0u), x << (zeros & 31u));
}

// Decodes a raw value of a format of this kind; `frac` is the number of fraction bits in fixed point.
fn n_unpack(kind: u32, frac: u32, raw: u32) -> Number {
    let sign = raw >> 31u;
    let field = (raw >> 23u) & 0xffu;
    let mantissa = raw & 0x7fffffu;
    var size = mantissa | select(0u, 0x800000u, field != 0u);
    var exp = i32(max(field, 1u)) - 150;
    var special = field == 255u;
    if (HAS_FIXED) {
        if kind == N_FIXED {
            size = select(raw, 0u - raw, sign == 1u);
            exp = -i32(frac);
            special = false;
        }
    }
    var n = n_whole(size);
    n.sign = sign;
    n.exp += exp;
    n.kind = select(0u, select(1u, 2u, mantissa != 0u), special);
    return n;
}

// Rounds (-1)^sign m 2^exp once into the format. No early return: drivers compile that to much longer code.
fn n_round_real(f: Format, sign: u32, exp: i32, magnitude: vec3<u32>) -> u32 {
    var m = magnitude;
    var e = exp;
    let first = m.x == 0u;
    m = select(m, vec3<u32>(m.y, m.z, 0u), first);
    e -= select(0, 32, first);
    let second = m.x == 0u;
    m = select(m, vec3<u32>(m.y, m.z, 0u), second);
    e -= select(0, 32, second);
    let zeros = countLeadingZeros(m.x) & 31u;
    m = (m << vec3<u32>(zeros)) | ((vec3<u32>(m.y, m.z, 0u) >> vec3<u32>(1u)) >> vec3<u32>(31u - zeros));
    e -= i32(zeros);
    let float = n_is_float(f);
    let top = e + 95;
    let places = i32(f.frac);
    // Exponents of the smallest and the largest normal number.
    var lowest = 2 - (1 << (f.upper - select(0u, 1u, float)));
    var highest = 1 - lowest;
    if (HAS_FINITE) {
        highest += select(0, 1, f.kind == 2u || f.kind == 3u);
        lowest -= select(0, 1, f.kind == 4u);
    }
    let unit = select(-places, max(top, lowest) - places, float);
    let shift = unit - e;
    // A shift below 2 occurs only in fixed point, for integers far above the unit. Of their last 32 bits only the first
    // can be 1, and only if the shift is 1. (Normalized formats have 16 bits or fewer, and these are 0.)
    var y = n_right(m, u32(max(shift, 2) - 2));
    y = select(y, vec3<u32>(0u, select(0u, m.y << 1u, shift == 1), 0u), shift < 2);
    let kept = (y.z >> 2u) | (y.y << 30u);
    let half = (y.z & 2u) != 0u;
    let below = (y.z & 1u) != 0u;
    var up = f.rounding == 0u && half && (below || (kept & 1u) != 0u);
    up = up || (f.rounding == 1u && half) || (f.rounding == 4u - sign && (half || below));
    up = up || (f.rounding == 5u && (half || below) && (kept & 1u) == 0u);
    let rounded = kept + select(0u, 1u, up);
    var result = 0u;
    if (HAS_FIXED) {
        let bits = f.upper + f.frac;
        // Two's complement has one more unit on the negative side.
        let limit = (1u << bits) - 1u + sign;
        let over = shift < 2 || y.x != 0u || (y.y >> 2u) != 0u || rounded > limit || rounded < kept;
        let value = select(rounded, 0u - rounded, sign == 1u);
        let wrapped = u32(i32(value << (31u - bits)) >> (31u - bits));
        result = select(wrapped, n_extreme(f, sign), over && f.overflow != 1u);
    }
    if float {
        let flushed = rounded == 0u || (f.denormals == 1u && (rounded >> (f.frac & 31u)) == 0u);
        let clear = countLeadingZeros(rounded) & 31u;
        let exponent = 31 - i32(clear) + unit;
        let normal = (u32(exponent + 127) << 23u) | (((rounded << clear) << 1u) >> 9u);
        let size = select(normal, rounded << (u32(unit + 149) & 31u), exponent < -126);
        result = select((sign << 31u) | size, n_zero(f, sign), flushed);
        var most = (2u << (f.frac & 31u)) - 1u;
        if (HAS_FINITE) {
            most -= select(0u, 1u, f.kind == 2u);
        }
        if top > highest || (top == highest && rounded > most) {
            result = n_overflow(f, sign, top > highest);
        }
    }
    return select(result, n_zero(f, sign), m.x == 0u);
}

fn n_finish(f: Format, x: Real) -> u32 {
    return select(n_round_real(f, x.sign, x.exp, x.m), x.raw, x.known);
}

// Rounds (-1)^negative v into the format: v is sig 2^exponent (x the low word, y the high one), or, if `sticky`,
// strictly between that and (sig + 1) 2^exponent.
fn n_round(f: Format, negative: bool, sig: vec2<u32>, exponent: i32, sticky: bool) -> u32 {
    let m = vec3<u32>(sig.y, sig.x, select(0u, 1u, sticky));
    let x = n_in_units(f, Real(false, 0u, select(0u, 1u, negative), exponent - 32, m));
    return n_round_real(f, x.sign, x.exp, x.m);
}

// Decodes a bit pattern of the format to a raw value.
fn n_decode(f: Format, bits: u32) -> u32 {
    if (HAS_UNITS) {
        if f.special > 1u {
            return bits;
        }
    }
    if !n_is_float(f) {
        let spare = 31u - f.upper - f.frac;
        return u32(i32(bits << spare) >> spare);
    }
    let width = f.upper + f.frac;
    let sign = ((bits >> width) & 1u) << 31u;
    let field = (bits >> f.frac) & ((1u << f.upper) - 1u);
    let mantissa = bits & ((1u << f.frac) - 1u);
    let ones = field == (1u << f.upper) - 1u;
    var ieee = true;
    if (HAS_FINITE) {
        ieee = f.kind == 1u;
        let last = f.kind == 2u && ones && mantissa == (1u << f.frac) - 1u;
        if last || (f.kind == 4u && sign != 0u && (field | mantissa) == 0u) {
            return N_NAN;
        }
    }
    if ieee && ones {
        return select(sign | N_INFINITY, N_NAN, mantissa != 0u);
    }
    if field == 0u && (mantissa == 0u || f.denormals == 1u) {
        return n_zero(f, sign >> 31u);
    }
    let above = 23u - f.frac;
    if f.upper == 8u {
        return sign | (field << 23u) | (mantissa << above);
    }
    var bias = (1u << (f.upper - 1u)) - 1u;
    if (HAS_FINITE) {
        bias += select(0u, 1u, f.kind == 4u);
    }
    if field != 0u {
        return sign | ((field + 127u - bias) << 23u) | (mantissa << above);
    }
    let clear = countLeadingZeros(mantissa);
    // The leading bit has the value of 2^(31 - clear) units of 2^(1 - bias - frac).
    return sign | ((159u - clear - bias - f.frac) << 23u) | (((mantissa << clear) << 1u) >> 9u);
}

// Encodes a raw value as a bit pattern of the format.
fn n_encode(f: Format, raw: u32) -> u32 {
    if (HAS_UNITS) {
        if f.special > 1u {
            return raw;
        }
    }
    let width = f.upper + f.frac;
    if !n_is_float(f) {
        return raw & (0xffffffffu >> (31u - width));
    }
    let magnitude = raw & 0x7fffffffu;
    let infinity = ((1u << f.upper) - 1u) << f.frac;
    if magnitude > N_INFINITY {
        if (HAS_FINITE) {
            if f.kind > 1u {
                return select((1u << width) - 1u, 1u << width, f.kind == 4u);
            }
        }
        return infinity | (1u << (f.frac - 1u));
    }
    let sign = (raw >> 31u) << width;
    let above = 23u - f.frac;
    if magnitude == N_INFINITY {
        return sign | infinity;
    }
    if f.upper == 8u || magnitude == 0u {
        return sign | (magnitude >> above);
    }
    var bias = (1 << (f.upper - 1u)) - 1;
    if (HAS_FINITE) {
        bias += select(0, 1, f.kind == 4u);
    }
    let exponent = i32(magnitude >> 23u) - 127;
    let mantissa = magnitude & 0x7fffffu;
    if exponent >= 1 - bias {
        return sign | (u32(exponent + bias) << f.frac) | (mantissa >> above);
    }
    return sign | ((mantissa | 0x800000u) >> (above + u32(1 - bias - exponent)));
}

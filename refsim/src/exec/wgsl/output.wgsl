// Output stage of one fragment: tests, blending, rounding into texels, masked write.

// A number: significand * 2^exponent / over, with its sign; NaN is stored as 0, infinity as 1. `over` is 1, except for
// normalized numbers, whose exponent is 0.
struct Exact {
    negative: bool,
    significand: u32,
    exponent: i32,
    over: u32,
}

// An output of the program in a lane.
fn o_given(operand: u32, lane: u32) -> u32 {
    return scratch[q_row(operand)][lane];
}

// Returns true if registers are in fixed point.
fn o_main_is_fixed() -> bool {
    if (HAS_FIXED) {
        return draw[8u * MAIN] == 0u;
    }
    return false;
}

// Denominator of the main format if it is normalized, else 0.
fn o_main_over() -> u32 {
    if (HAS_NORMALIZED) {
        return draw[8u * MAIN + 7u];
    }
    return 0u;
}

// Decodes a raw value: a fixed-point number of the main format, or a float.
fn o_exact(raw: u32, fixed_point: bool) -> Exact {
    let negative = (raw >> 31u) == 1u;
    let size = raw & 0x7fffffffu;
    let ends = size >= 0x7f800000u;
    let nan = size > 0x7f800000u;
    let field = size >> 23u;
    let significand = (size & 0x7fffffu) | select(0x800000u, 0u, field == 0u);
    var number = Exact(
        negative && !nan, select(significand, select(1u, 0u, nan), ends), select(i32(max(field, 1u)) - 150, 0, ends), 1u,
    );
    if (HAS_FIXED) {
        if (fixed_point) {
            let fraction = draw[8u * MAIN + 2u];
            number = Exact(negative, select(raw, 0u - raw, negative), -i32(fraction), max(o_main_over(), 1u));
        }
    }
    return number;
}

// Magnitude of a number times `scale`, as an integer of at most `scale`: nearest, halves away from zero, or truncated.
fn o_scaled(number: Exact, scale: u32, nearest: bool) -> u32 {
    let product = n_mul32(number.significand, scale).yx;
    // Numbers below 1 have a negative exponent. `halves` counts halves of a unit: its last bit is the half.
    let shift = u32(-number.exponent) - 1u;
    let halves = select(vec2<u32>(0u), k_shr(product, min(shift, 63u)), shift < 64u);
    var cut = ((halves.x >> 1u) | (halves.y << 31u)) + select(0u, halves.x & 1u, nearest);
    var above = 31 - i32(countLeadingZeros(number.significand)) + number.exponent >= 0;
    if (HAS_NORMALIZED) {
        if (number.over != 1u) {
            above = number.significand >= number.over;
            cut = o_quotient(product, number.over, nearest);
        }
    }
    return select(select(cut, scale, above), 0u, number.significand == 0u);
}

// product / over, at most 32 bits, for a divisor of 8 bits: nearest, halves away from zero, or truncated.
fn o_quotient(product: vec2<u32>, over: u32, nearest: bool) -> u32 {
    var rest = product.y;
    var quotient = 0u;
    for (var i = 0u; i < 4u; i++) {
        rest = (rest << 8u) | ((product.x >> (24u - 8u * i)) & 0xffu);
        quotient = (quotient << 8u) | (rest / over);
        rest = rest % over;
    }
    return quotient + select(0u, 1u, nearest && 2u * rest > over);
}

// Encodes a depth as an unsigned float with `mantissa` mantissa bits; depths of 1 and more give 1.
fn o_depth_float(given: Exact, bias: i32, mantissa: u32) -> u32 {
    var number = given;
    if (HAS_NORMALIZED) {
        if (given.over != 1u) {
            // The leading bits of the quotient, the rest jammed. It is below 1, except for depths that give 1.
            let size = min(given.significand, given.over);
            let quotient = n_divided(vec3<u32>(size << 16u, 0u, 0u), given.over).xy;
            number = Exact(given.negative, (quotient.x << 15u) | (quotient.y >> 17u), -31, 1u);
            number.significand |= select(0u, 1u, size % given.over != 0u);
        }
    }
    let one = u32(bias) << mantissa;
    let top = number.exponent + 31 - i32(countLeadingZeros(number.significand));
    let unit = max(top, 1 - bias) - i32(mantissa);
    let shift = unit - number.exponent;
    let below = k_round_even(vec2<u32>(number.significand, 0u), u32(clamp(shift, 1, 63)));
    let kept = select(below, number.significand << u32(clamp(-shift, 0, 31)), shift <= 0);
    let base = u32(unit + i32(mantissa) + bias - 1) << mantissa;
    let pattern = select(min(base + kept, one), one, top >= 0);
    return select(pattern, 0u, number.significand == 0u);
}

// Pattern of a depth in the draw's depth buffer; 0 for negative numbers and NaN.
fn o_depth(raw: u32, in_main: bool) -> u32 {
    var number = o_exact(raw, in_main && o_main_is_fixed());
    if (number.negative) {
        number.significand = 0u;
    }
    if (HAS_UNITS) {
        if in_main && draw[8u * MAIN + 6u] > 1u && u_is_zero(raw) {
            number.significand = 0u;
        }
    }
    var pattern = o_scaled(number, draw[D_DEPTH_SCALE], draw[D_DEPTH_NEAREST] == 1u);
    if (HAS_FLOAT_DEPTH) {
        let kind = draw[D_DEPTH_FORMAT];
        let short = kind == DEPTH_FLOAT24;
        if (short || kind == DEPTH_FLOAT32) {
            pattern = o_depth_float(number, select(127, 15, short), select(23u, 20u, short));
        }
    }
    return pattern;
}

fn o_is_below(a: u32, b: u32) -> bool {
    return !s_is_nan(a) && !s_is_nan(b) && s_key(a) < s_key(b);
}

// Evaluates a comparison, given as the set of orders that pass: bit 0 below, 1 equal, 2 above, 3 unordered.
fn o_holds(comparison: u32, below: bool, above: bool) -> bool {
    return ((comparison >> select(select(1u, 2u, above), 0u, below)) & 1u) == 1u;
}

fn o_alpha_passes(alpha: u32) -> bool {
    let comparison = draw[D_ALPHA];
    let reference = draw[D_ALPHA + 1u];
    let integers = o_main_is_fixed();
    let value = select(s_key(alpha), i32(alpha), integers);
    let bound = select(s_key(reference), i32(reference), integers);
    let unordered = !integers && (s_is_nan(alpha) || s_is_nan(reference));
    if (HAS_UNITS) {
        if draw[8u * MAIN + 6u] > 1u && !unordered {
            return o_holds(comparison, u_less(alpha, reference), u_less(reference, alpha));
        }
    }
    return select(o_holds(comparison, (value < bound), (value > bound)), (comparison >> 3u) == 1u, unordered);
}

// A stored channel.
struct Channel {
    shift: u32,
    bits: u32,
    // 0 unsigned, 1 signed, 2 signed in fifteenths and sixteenths, 3 a float.
    kind: u32,
    component: u32,
    // Index of a float's format.
    format: u32,
    denominator: u32,
}

fn o_channel(at: u32) -> Channel {
    return Channel(draw[at], draw[at + 1u], draw[at + 2u], draw[at + 3u], draw[at + 4u], draw[at + 5u]);
}

fn o_low_bits(n: u32) -> u32 {
    return 0xffffffffu >> (32u - n);
}

// Encodes a raw value of the main format for an integer channel.
fn o_encode(channel: Channel, raw: u32) -> u32 {
    let number = o_exact(raw, o_main_is_fixed());
    let scaled = o_scaled(number, o_whole(channel, number.negative), draw[D_NEAREST] == 1u);
    let size = select(scaled, 0u, number.negative && channel.kind == 0u);
    return select(size, 0u - size, number.negative) & o_low_bits(channel.bits);
}

// Largest magnitude of a channel's codes with this sign.
fn o_whole(channel: Channel, negative: bool) -> u32 {
    let largest = o_low_bits(channel.bits);
    return select((largest >> 1u) + select(0u, 1u, channel.kind == 2u && negative), largest, channel.kind == 0u);
}

// Numerator of a channel's value, over the channel's denominator.
fn o_numerator(channel: Channel, bits: u32) -> i32 {
    if (channel.kind == 0u) {
        return i32(bits);
    }
    let spare = 32u - channel.bits;
    let number = i32(bits << spare) >> spare;
    if (channel.kind == 2u) {
        return number * select(16, 15, number < 0);
    }
    return max(number, -i32(channel.denominator));
}

// Inputs of the blender: source, destination and their alphas, as numerators or single-precision patterns.
struct Blend {
    source: u32,
    destination: u32,
    source_alpha: u32,
    destination_alpha: u32,
}

// The value that a blend factor from 2 to 9 selects; odd factors are 1 minus that value.
fn o_factor(values: Blend, factor: u32) -> u32 {
    switch factor >> 1u {
        case 1u: {
            return values.source;
        }
        case 2u: {
            return values.source_alpha;
        }
        case 3u, 5u: {
            return values.destination_alpha;
        }
        default: {
            return values.destination;
        }
    }
}

// size / denominator, below 1, as a code of a channel whose code for 1 is `whole`.
fn o_divide(size: vec2<u32>, denominator: vec2<u32>, whole: u32, nearest: bool) -> u32 {
    let divisor = k_add(denominator, denominator);
    var rest = k_scale(k_add(size, size), whole);
    if (nearest) {
        rest = k_add(rest, denominator);
    }
    var code = 0u;
    for (var i = 0u; i < 17u; i++) {
        let bit = 16u - i;
        let part = k_shl(divisor, bit);
        if (!k_less(rest, part)) {
            rest = k_add(rest, k_neg(part));
            code |= 1u << bit;
        }
    }
    return code;
}

// Blends in an integer channel: exact fractions, rounded once.
//
// Every term is a product of two fractions: a numerator over the channel's denominator D, and a factor over 1, D or the
// alpha's denominator A. So D D A is a common denominator (D D, if A equals D).
fn o_blend_integer(channel: Channel, values: Blend, alpha_denominator: u32, equation: u32) -> u32 {
    let op = draw[equation + 2u];
    let d = channel.denominator;
    let a = alpha_denominator;
    let same = a == d;
    var total: vec2<u32>;
    var denominator: vec2<u32>;
    if (op >= 3u) {
        let lower = i32(values.source) < i32(values.destination);
        let chosen = select(values.destination, values.source, lower == (op == 3u));
        total = vec2<u32>(chosen, select(0u, 0xffffffffu, i32(chosen) < 0));
        denominator = vec2<u32>(d, 0u);
    } else {
        denominator = n_mul32(d * d, select(a, 1u, same)).yx;
        for (var k = 0u; k < 2u; k++) {
            let factor = draw[equation + k];
            let value = i32(select(values.source, values.destination, k == 1u));
            var by = 1;
            var rest = select(d * a, d, same);
            if (factor == 0u) {
                by = 0;
            } else if (factor > 1u && !(factor == 10u && channel.component == 3u)) {
                let of_alpha = (factor >= 4u && factor <= 7u) || factor == 10u;
                by = i32(o_factor(values, factor));
                if ((factor & 1u) == 1u || factor == 10u) {
                    by = i32(select(d, a, of_alpha)) - by;
                }
                if (factor == 10u) {
                    by = min(by, i32(values.source_alpha));
                }
                rest = select(select(a, d, of_alpha), 1u, same);
            }
            var term = n_mul32(u32(abs(value)) * u32(abs(by)), rest).yx;
            // source - destination, or destination - source
            let turned = (op == 1u && k == 1u) || (op == 2u && k == 0u);
            if (((value < 0) != (by < 0)) != turned) {
                term = k_neg(term);
            }
            total = k_add(total, term);
        }
    }
    let negative = (total.y >> 31u) == 1u;
    let size = select(total, k_neg(total), negative);
    if (negative && channel.kind == 0u) {
        return 0u;
    }
    let whole = o_whole(channel, negative);
    var code = whole;
    if (k_less(size, denominator)) {
        code = o_divide(size, denominator, whole, draw[D_NEAREST] == 1u);
    }
    return select(code, 0u - code, negative) & o_low_bits(channel.bits);
}

// Encodes a raw value of the main format for a float channel.
fn o_float(channel: Channel, raw: u32) -> u32 {
    let into = format_of_draw(channel.format);
    let kind = select(N_FLOAT, N_FIXED, o_main_is_fixed());
    return n_encode(into, n_finish(into, n_term(N_CONVERT, into, kind, draw[8u * MAIN + 2u], o_main_over(), raw, 0u)));
}

// As `o_float`, but blended in single precision. All roundings are at one place, because drivers compile a copy of the
// arithmetic for each place.
fn o_blend_float(channel: Channel, raw: u32, raw_alpha: u32, held: u32, held_alpha: u32, equation: u32) -> u32 {
    let is_alpha = channel.component == 3u;
    let op = draw[equation + 2u];
    var values = Blend(raw, held, raw_alpha, held_alpha);
    var terms: vec2<u32>;
    var there: vec2<bool>;
    var result = raw;
    for (var step = 0u; step < 8u; step++) {
        var code_of = N_CONVERT;
        var a = 0u;
        var b = 0u;
        var to = SINGLE;
        // Steps 2 and 3 compute the source's term, steps 4 and 5 the destination's.
        let k = select(0u, 1u, step >= 4u);
        let factor = draw[equation + k];
        let value = select(values.source, values.destination, k == 1u);
        let multiplied = factor > 1u && !(factor == 10u && is_alpha);
        switch step {
            case 0u: {
                a = raw_alpha;
            }
            case 1u: {
                a = raw;
            }
            case 2u, 4u: {
                there[k] = factor != 0u;
                terms[k] = value;
                if (op >= 3u || !multiplied) {
                    // Skips the multiplication too.
                    step++;
                    continue;
                }
                let by = o_factor(values, factor);
                terms[k] = by;
                if ((factor & 1u) == 0u && factor != 10u) {
                    continue;
                }
                code_of = N_ADD;
                a = 0x3f800000u;
                b = by ^ 0x80000000u;
            }
            case 3u, 5u: {
                code_of = N_MUL;
                a = value;
                b = terms[k];
                if (factor == 10u && !o_is_below(b, values.source_alpha)) {
                    b = values.source_alpha;
                }
            }
            case 6u: {
                if (op == 3u) {
                    result = select(values.source, values.destination, o_is_below(values.destination, values.source));
                    continue;
                }
                if (op == 4u) {
                    result = select(values.source, values.destination, o_is_below(values.source, values.destination));
                    continue;
                }
                // Minuend x and subtrahend y; for an addition, the addends.
                let x = select(terms.x, terms.y, op == 2u);
                let y = select(terms.y, terms.x, op == 2u);
                let has_x = select(there.x, there.y, op == 2u);
                let has_y = select(there.y, there.x, op == 2u);
                if (!has_y || (op == 0u && !has_x)) {
                    result = select(select(0u, x, has_x), y, has_y);
                    continue;
                }
                code_of = N_ADD;
                a = select(0u, x, has_x);
                b = select(y ^ 0x80000000u, y, op == 0u);
            }
            default: {
                a = result;
                to = channel.format;
            }
        }
        // In steps 0 and 1 the operands are the program's outputs, in the main format.
        let given = step < 2u;
        let kind = select(N_FLOAT, N_FIXED, given && o_main_is_fixed());
        let fraction = select(0u, draw[8u * MAIN + 2u], given);
        let into = format_of_draw(to);
        let made = n_finish(into, n_term(code_of, into, kind, fraction, select(0u, o_main_over(), given), a, b));
        switch step {
            case 0u: {
                values.source_alpha = made;
            }
            case 1u: {
                values.source = made;
            }
            case 6u, 7u: {
                result = made;
            }
            default: {
                terms[k] = made;
            }
        }
    }
    return n_encode(format_of_draw(channel.format), result);
}

// Writes the colour of one lane into target `t`.
fn o_write(t: u32, lane: u32, x: u32, y: u32) {
    let at = D_TARGETS + TARGET_WORDS * t;
    let size = draw[at + 3u];
    let texel = draw[at + 1u] + (y * draw[at + 2u] + x) * size;
    let floats = draw[at + 5u] == 1u;
    let blends = draw[D_BLEND] == 1u;
    let alpha_channel = draw[at + 11u];
    // The fifth channel in the table rounds the source's alpha if the target stores no alpha.
    let rounded_alpha = o_channel(at + 16u + 8u * min(alpha_channel, 4u));
    if (HAS_UNITS) {
        // Outputs of a card's unit are flushed: subnormal numbers become zeros.
        if draw[8u * MAIN + 6u] > 1u {
            for (var c = 0u; c < 4u; c++) {
                let place = q_row(ROW_COLORS + 4u * t + c);
                scratch[place][lane] = u_flushed(scratch[place][lane]);
            }
        }
    }
    let raw_alpha = o_given(ROW_COLORS + 4u * t + 3u, lane);
    var held_alpha = select(rounded_alpha.denominator, 0x3f800000u, floats);
    var made: vec4<u32>;
    // An extra pass, the first, reads the target's alpha.
    for (var pass_number = 0u; pass_number <= draw[at + 4u]; pass_number++) {
        let of_alpha = pass_number == 0u;
        if (of_alpha && (!blends || alpha_channel >= 4u)) {
            continue;
        }
        let channel = o_channel(at + 16u + 8u * select(pass_number - 1u, alpha_channel, of_alpha));
        let stored = (video[texel + (channel.shift >> 5u)] >> (channel.shift & 31u)) & o_low_bits(channel.bits);
        let raw = o_given(ROW_COLORS + 4u * t + channel.component, lane);
        let equation = D_BLEND + select(1u, 4u, channel.component == 3u);
        var held = 0u;
        var bits = 0u;
        if (HAS_FLOAT_TARGETS) {
            if (floats) {
                bits = o_float(channel, raw);
            }
        }
        if (HAS_FLOAT_BLENDING) {
            if (floats && blends) {
                held = n_decode(format_of_draw(channel.format), stored);
                bits = o_blend_float(channel, raw, raw_alpha, held, held_alpha, equation);
            }
        }
        if (HAS_INTEGER_TARGETS) {
            if (!floats) {
                bits = o_encode(channel, raw);
            }
        }
        if (HAS_INTEGER_BLENDING) {
            if (!floats && blends) {
                held = u32(o_numerator(channel, stored));
                let alpha = u32(o_numerator(rounded_alpha, o_encode(rounded_alpha, raw_alpha)));
                let values = Blend(u32(o_numerator(channel, bits)), held, alpha, held_alpha);
                bits = o_blend_integer(channel, values, rounded_alpha.denominator, equation);
            }
        }
        if (of_alpha) {
            held_alpha = held;
            continue;
        }
        made[channel.shift >> 5u] |= bits << (channel.shift & 31u);
    }
    for (var w = 0u; w < size; w++) {
        let mask = draw[at + 6u + w];
        video[texel + w] = (video[texel + w] & ~mask) | (made[w] & mask);
    }
}

// Runs the output stage for one covered lane. Returns the fragment's fate: 1 killed, 2 failed the alpha test, 3 failed
// the depth test, 4 passed.
fn o_merge(lane: u32, x: u32, y: u32) -> u32 {
    var fate = select(4u, 1u, o_given(ROW_KILLED, lane) != 0u);
    if (HAS_ALPHA_TEST) {
        if (fate == 4u && !o_alpha_passes(o_given(ROW_COLORS + 3u, lane))) {
            fate = 2u;
        }
    }
    if (HAS_DEPTH_TEST) {
        if (fate == 4u) {
            let comparison = draw[D_DEPTH];
            let at = draw[D_DEPTH_BASE] + y * draw[D_DEPTH_WIDTH] + x;
            let made = o_depth(o_given(ROW_DEPTH, lane), o_given(ROW_DEPTH_IS_MAIN, lane) != 0u);
            let old = video[at];
            if (!o_holds(comparison, (made < old), (made > old))) {
                fate = 3u;
            } else if (draw[D_DEPTH + 1u] == 1u) {
                video[at] = made;
            }
        }
    }
    for (var t = 0u; t < 4u; t++) {
        if (fate == 4u && draw[D_TARGETS + TARGET_WORDS * t] == 1u) {
            o_write(t, lane, x, y);
        }
    }
    return fate;
}

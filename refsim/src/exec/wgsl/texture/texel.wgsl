// Texels: extraction of components from stored words, and the only rounding into the register format.
//
// A component is described by a word: class (bits 0 to 7), shift (8 to 15), width (16 to 23).

// Stored bits of a component; `words` are the texel's words, low ones first.
fn texel_bits(component: u32, words: vec4<u32>) -> u32 {
    let shift = (component >> 8u) & 0xffu;
    let word = words[shift >> 5u];
    return extractBits(word, shift & 31u, component >> 16u);
}

// Returns true if a component is a floating-point pattern.
fn texel_is_float(component: u32) -> bool {
    return (component & 0xffu) >= TEXEL_FP16;
}

// Returns true if a component that is not a float is a byte: 8 bits, or bits repeated to 8, or not stored.
fn texel_is_byte(component: u32) -> bool {
    let kind = component & 0xffu;
    return kind <= TEXEL_ONE || kind >= TEXEL_BYTE || component >> 16u == 8u;
}

// Code of a component that is a fraction, as filters on bytes use it.
fn texel_code(component: u32, bits: u32) -> i32 {
    let width = component >> 16u;
    let spare = 32u - width;
    let signed_bits = bitcast<i32>(bits << (spare & 31u)) >> (spare & 31u);
    // Repeats the bits. If there are 8 already, the last step would shift by 32, which wraps to 0 and changes nothing.
    let top = (bits << (8u - min(width, 8u))) & 0xffu;
    let two = top | (top >> (width & 31u));
    let four = two | (two >> ((2u * width) & 31u));
    let byte = four | (four >> ((4u * width) & 31u));
    var code = signed_bits;
    switch component & 0xffu {
        case TEXEL_ZERO: { code = 0; }
        case TEXEL_ONE: { code = 255; }
        case TEXEL_UNORM: { code = bitcast<i32>(bits); }
        case TEXEL_SPLIT: { code = signed_bits * select(16, 15, signed_bits < 0); }
        case TEXEL_BYTE: { code = bitcast<i32>(byte); }
        case TEXEL_SIGNED_BYTE, TEXEL_SIGNED_BYTE_CLAMPED: { code = bitcast<i32>(byte << 24u) >> 24u; }
        default: { }
    }
    return code;
}

// Numerator of a component that is a fraction, from its code.
fn texel_numerator(component: u32, code: i32) -> i32 {
    let least = -bitcast<i32>(texel_denominator(component));
    var numerator = code;
    switch component & 0xffu {
        case TEXEL_SNORM_CLAMPED: { numerator = max(code, least); }
        case TEXEL_SIGNED_BYTE: { numerator = 2 * code; }
        case TEXEL_SIGNED_BYTE_CLAMPED: { numerator = max(2 * code, least); }
        default: { }
    }
    return numerator;
}

// Denominator of a component that is a fraction, at most 65535.
fn texel_denominator(component: u32) -> u32 {
    let width = component >> 16u;
    var denominator = 255u;
    switch component & 0xffu {
        case TEXEL_UNORM: { denominator = (1u << width) - 1u; }
        case TEXEL_SNORM, TEXEL_SNORM_CLAMPED: { denominator = max((1u << (width - 1u)) - 1u, 1u); }
        case TEXEL_SPLIT: { denominator = 240u; }
        default: { }
    }
    return denominator;
}

// Decodes a component of a floating-point texel to FP32 bits, exactly; NaN becomes canonical.
fn texel_single(component: u32, bits: u32) -> u32 {
    let kind = component & 0xffu;
    var fraction_bits = 23u;
    var exponent_bits = 8u;
    if (kind == TEXEL_FP16) { fraction_bits = 10u; exponent_bits = 5u; }
    if (kind == TEXEL_FP24) { fraction_bits = 16u; exponent_bits = 7u; }
    let sign = ((bits >> (fraction_bits + exponent_bits)) & 1u) << 31u;
    let top_field = (1u << exponent_bits) - 1u;
    let field = (bits >> fraction_bits) & top_field;
    let fraction = bits & ((1u << fraction_bits) - 1u);
    // The bias is half the largest field, rounded down.
    let rebias = 127u - (top_field >> 1u);
    let above = 23u - fraction_bits;
    let left = countLeadingZeros(fraction) - (31u - fraction_bits); // places up to the hidden bit
    let hidden = (fraction << left) & ((1u << fraction_bits) - 1u);
    let kept = fraction == 0u || kind == TEXEL_FP32;
    let small = select(((rebias + 1u - left) << 23u) | (hidden << above), fraction, kept);
    var size = select(((field + rebias) << 23u) | (fraction << above), small, field == 0u);
    size = select(size, 0x7f800000u, field == top_field);
    var single = select(sign | size, 0x7fc00000u, field == top_field && fraction != 0u);
    single = select(single, 0u, kind < TEXEL_FP16);
    if (HAS_UNITS) {
        // Units of cards use single floats unchanged; NaN of other formats becomes the unit's own NaN.
        if format(MAIN).special > 1u && u_is_nan(single) {
            single = select(U_NAN, bits, kind == TEXEL_FP32);
        }
    }
    return select(single, 0x3f800000u, kind == TEXEL_ONE);
}

// An unrounded number: (-1)^negative * significand * 2^exponent, plus less than one unit if `sticky`, divided by the
// denominator of the format.
struct TexelParts {
    significand: vec2<u32>,
    exponent: i32,
    negative: bool,
    sticky: bool,
    infinite: bool,
    nan: bool,
}

// The parts of an FP32 pattern.
fn texel_parts_of_single(bits: u32, over: u32) -> TexelParts {
    let field = (bits >> 23u) & 0xffu;
    let fraction = bits & 0x7fffffu;
    let significand = fraction | select(0u, 0x800000u, field != 0u);
    let special = field == 255u;
    return TexelParts(
        texture_wide(significand, over), i32(max(field, 1u)) - 150, (bits >> 31u) == 1u, false,
        special && fraction == 0u, special && fraction != 0u,
    );
}

// The parts of numerator / (denominator * 2^shift). The numerator is in two's complement and has at most 54 bits, the
// denominator at most 16 bits.
fn texel_parts_of_ratio(numerator: vec2<u32>, denominator: u32, shift: u32, over: u32) -> TexelParts {
    let negative = (numerator.y >> 31u) == 1u;
    var magnitude = numerator;
    if (negative) { magnitude = texture_negated(numerator); }
    var left = countLeadingZeros(magnitude.y);
    if (magnitude.y == 0u) { left = 32u + countLeadingZeros(magnitude.x); }
    // Leaves room for the product with `over`.
    left -= select(8u, 0u, over == 1u);
    magnitude = texture_left(magnitude, left);
    // Divides sixteen bits at a time: at least 48 bits of quotient, more than any rounding needs.
    var quotient = vec2<u32>(0u);
    var rest = 0u;
    for (var digit = 0u; digit < 4u; digit++) {
        let dividend = (rest << 16u) | (magnitude.y >> 16u);
        let part = dividend / denominator;
        rest = dividend - part * denominator;
        magnitude = vec2<u32>(magnitude.x << 16u, (magnitude.y << 16u) | (magnitude.x >> 16u));
        quotient = vec2<u32>((quotient.x << 16u) | part, (quotient.y << 16u) | (quotient.x >> 16u));
    }
    if (HAS_NORMALIZED) {
        let part = rest * over;
        rest = part % denominator;
        quotient = texture_add(texture_wide(quotient.x, over), vec2<u32>(part / denominator, quotient.y * over));
    }
    return TexelParts(quotient, -i32(left + shift), negative, rest != 0u, false, false);
}

// Rounds the number once into a format; returns the raw value.
fn texel_rounded(f: Format, parts: TexelParts) -> u32 {
    let sign = select(0u, 1u, parts.negative);
    let raw = select(n_infinite(f, sign), n_nan(f), parts.nan);
    let m = vec3<u32>(parts.significand.y, parts.significand.x, select(0u, 1u, parts.sticky));
    return n_finish(f, Real(parts.nan || parts.infinite, raw, sign, parts.exponent - 32, m));
}

// A component of a stored texel in a format, as a raw value: the result of a nearest read. (`texture_read` does not use
// this, because it filters before it rounds.)
fn texel_decode(f: Format, component: u32, words: vec4<u32>) -> u32 {
    let bits = texel_bits(component, words);
    var parts: TexelParts;
    if (texel_is_float(component)) {
        parts = texel_parts_of_single(texel_single(component, bits), n_over(f));
    } else {
        let numerator = texel_numerator(component, texel_code(component, bits));
        let wide = vec2<u32>(bitcast<u32>(numerator), bitcast<u32>(numerator >> 31u));
        parts = texel_parts_of_ratio(wide, texel_denominator(component), 0u, n_over(f));
    }
    return texel_rounded(f, parts);
}

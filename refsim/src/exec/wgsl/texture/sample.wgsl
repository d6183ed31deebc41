// Texture reads: refsim::texture::sample over the sampler table.

struct TextureLevels {
    linear: bool, // the filter within a level
    level: vec2<u32>,
    weight: u32, // of the second level, in units of 2^-FLAG_LOD_BITS
}

fn texture_levels(s: TextureState, wanted: u32) -> TextureLevels {
    let bits = texture_flag(s, FLAG_LOD_BITS, 4u);
    var lambda = 0;
    if ((wanted & 0x7fffffffu) <= 0x7f800000u) {
        // Larger values, infinity included, act like 1024.
        let near = (wanted & 0x80000000u) | min(wanted & 0x7fffffffu, 0x44800000u);
        let position = texture_position(near, 0x44800000u, 1u, bits, false);
        lambda = clamp(bitcast<i32>(position.x), -(128 << bits), 128 << bits);
    }
    let first = i32(s.level_range & 0xffu);
    let last = i32(s.level_range >> 8u);
    var level = first;
    var weight = 0u;
    switch texture_flag(s, FLAG_MIP, 2u) {
        case MIP_NEAREST: { level = clamp((lambda + i32((1u << bits) >> 1u)) >> bits, first, last); }
        case MIP_LINEAR: {
            let clamped = clamp(lambda, first << bits, last << bits);
            level = clamped >> bits;
            weight = u32(clamped) & ((1u << bits) - 1u);
        }
        default: { }
    }
    let linear = texture_flag(s, select(FLAG_MAG, FLAG_MIN, lambda > 0), 1u) != 0u;
    return TextureLevels(linear, vec2<u32>(u32(level), u32(min(level + 1, last))), weight);
}

// Texel indices of both taps along an axis (x and y), and the weight of the second tap (z).
fn texture_taps(s: TextureState, coordinate: u32, axis: u32, size: u32, linear: bool) -> vec3<u32> {
    let scale = select(1u, size, texture_flag(s, FLAG_NORMALISED, 1u) != 0u);
    let mode = texture_flag(s, FLAG_ADDRESS + 2u * axis, 2u);
    let fraction = select(0u, texture_flag(s, FLAG_FILTER_BITS, 4u), linear);
    let half_up = fraction != 0u && texture_flag(s, FLAG_CUT, 1u) == 0u;
    // From 2^24 on every FP32 number is an even integer, and all numbers with the same sign have the same address.
    var position = texture_position(coordinate, 0x4b800000u, scale, fraction, half_up);
    if (fraction != 0u) {
        position = texture_add(position, texture_negated(vec2<u32>(1u << (fraction - 1u), 0u)));
    }
    let weight = position.x & ((1u << fraction) - 1u);
    let sign = bitcast<u32>(bitcast<i32>(position.y) >> 31u);
    var whole = texture_right(position, fraction);
    if (fraction != 0u) { whole.y |= sign << (32u - fraction); }
    var index = vec2<u32>(0u);
    for (var tap = 0u; tap < 2u; tap++) {
        index[tap] = texture_resolved(mode, whole, size);
        if (weight == 0u) { break; }
        whole = texture_add(whole, vec2<u32>(1u, 0u));
    }
    return vec3<u32>(index, weight);
}

// Words of the texel at a column, row and slice of a level (`row` is the level's entry in the table).
fn texture_words(s: TextureState, row: vec4<u32>, at: vec3<u32>) -> vec4<u32> {
    var words = vec4<u32>(0u);
    let size = texture_flag(s, FLAG_TEXEL_WORDS, 3u);
    let first = row[LEVEL_OFFSET] + ((at.z * row[LEVEL_HEIGHT] + at.y) * row[LEVEL_WIDTH] + at.x) * size;
    words.x = video[first];
    if (size > 1u) { words.y = video[first + 1u]; }
    if (size > 2u) { words.z = video[first + 2u]; words.w = video[first + 3u]; }
    return words;
}

// Components of the texel at a column, row and slice of a level, or of the border: codes, or single-precision numbers.
fn texture_codes(s: TextureState, row: vec4<u32>, at: vec3<u32>) -> vec4<u32> {
    var codes = vec4<u32>(0u);
    if (max(max(at.x, at.y), at.z) == TEXTURE_BORDER) {
        let border = s.base + SAMPLER_BORDER;
        return vec4<u32>(samplers[border], samplers[border + 1u], samplers[border + 2u], samplers[border + 3u]);
    }
    let words = texture_words(s, row, at);
    let components = s.components;
    for (var c = 0u; c < 4u; c++) {
        let bits = texel_bits(components[c], words);
        if (HAS_FLOAT_TEXELS) {
            codes[c] = texel_single(components[c], bits);
        }
        if (HAS_RATIO_TEXELS) {
            if (texture_flag(s, FLAG_FLOAT, 1u) == 0u) { codes[c] = bitcast<u32>(texel_code(components[c], bits)); }
        }
    }
    return codes;
}

// Interpolates floats, a + w (b - a) along each axis and between levels, in single precision; a weight of 0 gives a
// itself. Codes of bytes are interpolated in the same steps, each rounded to an integer, halves up.
fn texture_blend(
    s: TextureState, axis_weights: array<vec3<u32>, 2>, level_weight: u32, texels: ptr<function, array<vec4<u32>, 16>>,
) {
    var weights = axis_weights;
    let floats = texture_flag(s, FLAG_FLOAT, 1u) != 0u;
    for (var axis = 0u; axis < 4u; axis++) {
        for (var pair = 0u; pair < (8u >> axis); pair++) {
            var weight = level_weight;
            var bits = texture_flag(s, FLAG_LOD_BITS, 4u);
            if (axis < 3u) {
                weight = weights[pair >> (2u - axis)][axis];
                bits = texture_flag(s, FLAG_FILTER_BITS, 4u);
            }
            var a = (*texels)[2u * pair];
            if (weight != 0u) {
                let b = (*texels)[2u * pair + 1u];
                if (HAS_BYTE_FILTERS) {
                    if (!floats) {
                        let first = bitcast<vec4<i32>>(a);
                        let change = (bitcast<vec4<i32>>(b) - first) * i32(weight) + vec4<i32>((1 << bits) >> 1u);
                        a = bitcast<vec4<u32>>(first + (change >> vec4<u32>(bits)));
                    }
                }
                if (HAS_FLOAT_FILTERS) {
                    if (floats) {
                        let single = texture_fixed(i32(weight), bits);
                        for (var c = 0u; c < 4u; c++) {
                            var x = b[c];
                            for (var k = 0u; k < 3u; k++) {
                                var op = N_ADD;
                                var other = a[c];
                                if (k == 0u) { op = N_SUB; }
                                if (k == 1u) { op = N_MUL; other = single; }
                                x = s_alu(op, x, other);
                            }
                            a[c] = x;
                        }
                    }
                }
            }
            (*texels)[pair] = a;
        }
    }
}

// Texel of one lane. Integer texels are summed exactly and rounded once, or interpolated as bytes; floats are
// interpolated in single precision.
fn texture_texel(s: TextureState, place: TexturePlace) -> vec4<u32> {
    var levels = TextureLevels(false, vec2<u32>(s.level_range & 0xffu), 0u);
    if (HAS_FILTERS) {
        levels.linear = texture_flag(s, FLAG_MAG, 1u) != 0u;
    }
    if (HAS_LEVELS) {
        levels = texture_levels(s, place.wanted);
    }
    let floats = texture_flag(s, FLAG_FLOAT, 1u) != 0u;
    let filter_bits = texture_flag(s, FLAG_FILTER_BITS, 4u);
    let lod_bits = texture_flag(s, FLAG_LOD_BITS, 4u);
    let axes = texture_flag(s, FLAG_AXES, 2u);
    let components = s.components;
    var sums = array<vec2<u32>, 4>();
    var texels: array<vec4<u32>, 16>;
    var weights = array<vec3<u32>, 2>();
    var out = vec4<u32>(0u);
    let rows = select(1u, 2u, levels.weight != 0u);
    for (var r = 0u; r < rows; r++) {
        let at = s.base + SAMPLER_LEVELS + 4u * levels.level[r];
        let row = vec4<u32>(samplers[at], samplers[at + 1u], samplers[at + 2u], samplers[at + 3u]);
        var near = vec3<u32>(0u, 0u, place.face);
        var far = vec3<u32>(0u);
        var second = vec3<u32>(0u);
        for (var axis = 0u; axis < axes; axis++) {
            let taps = texture_taps(s, place.coordinates[axis], axis, row[LEVEL_WIDTH + axis], levels.linear);
            near[axis] = taps.x;
            far[axis] = taps.y;
            second[axis] = taps.z;
        }
        weights[r] = second;
        let part = select(levels.weight, (1u << lod_bits) - levels.weight, r == 0u);
        var mask = 0u;
        if (HAS_FILTERS) {
            let used = select(vec3<u32>(0u), vec3<u32>(1u, 2u, 4u), second != vec3<u32>(0u));
            mask = used.x | used.y | used.z;
        }
        for (var corner = 0u; corner <= mask; corner++) {
            if ((corner & ~mask) != 0u) { continue; }
            let side = (vec3<u32>(corner) & vec3<u32>(1u, 2u, 4u)) != vec3<u32>(0u);
            out = texture_codes(s, row, select(near, far, side));
            let factors = select(vec3<u32>(1u << filter_bits) - second, second, side);
            let weight = texture_wide(factors.x * factors.y, factors.z * part); // at most 2^44
            if (HAS_RATIO_TEXELS) {
                if (HAS_FILTERS) {
                    for (var c = 0u; c < 4u; c++) {
                        let numerator = texel_numerator(components[c], bitcast<i32>(out[c])); // at most 2^16
                        let size = u32(abs(numerator));
                        var product = texture_wide(weight.x, size);
                        product.y += weight.y * size;
                        if (numerator < 0) { product = texture_negated(product); }
                        sums[c] = texture_add(sums[c], product);
                    }
                }
            }
            if (HAS_INTERPOLATION) {
                texels[8u * r + corner] = out;
            }
        }
    }
    let f = format(MAIN);
    let bytes = texture_flag(s, FLAG_BYTES, 1u) != 0u;
    if (HAS_INTERPOLATION) {
        if (floats || bytes) {
            texture_blend(s, weights, levels.weight, &texels);
            out = texels[0];
        }
    }
    if (HAS_UNITS) {
        // Units of cards use single floats unchanged.
        if (floats && f.special > 1u) {
            return out;
        }
    }
    // Single floats need no rounding into single precision.
    if (!(floats && f.kind == 1u && f.upper == 8u && f.frac == 23u && f.denormals == 0u)) {
        for (var c = 0u; c < 4u; c++) {
            var parts: TexelParts;
            if (HAS_FLOAT_TEXELS) {
                parts = texel_parts_of_single(out[c], n_over(f));
            }
            if (HAS_RATIO_TEXELS) {
                if (!floats) {
                    let numerator = texel_numerator(components[c], bitcast<i32>(out[c]));
                    var sum = vec2<u32>(bitcast<u32>(numerator), bitcast<u32>(numerator >> 31u));
                    var shift = 0u;
                    if (HAS_FILTERS) {
                        if (!(bytes && texel_is_byte(components[c]))) {
                            sum = sums[c];
                            shift = 3u * filter_bits + lod_bits;
                        }
                    }
                    parts = texel_parts_of_ratio(sum, texel_denominator(components[c]), shift, n_over(f));
                }
            }
            out[c] = texel_rounded(f, parts);
        }
    }
    return out;
}

// Reads a texture for the lanes that run: raw components in the main format; 0 in the other lanes. `texture_operand`
// provides the coordinates and the operands of the detail, all in single precision.
fn texture_read(number: u32, detail: u32, run: vec4<bool>) {
    let s = texture_state(number);
    for (var lane = 0u; lane < 4u; lane++) {
        var texel = vec4<u32>(0u);
        if (run[lane]) {
            texel = texture_texel(s, texture_place(s, lane, detail));
        }
        for (var c = 0u; c < 4u; c++) {
            texture_result(c, lane, texel[c]);
        }
    }
}

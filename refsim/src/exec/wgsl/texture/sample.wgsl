// Texture reads: refsim::texture::sample over the sampler table.

struct TextureLevels {
    filter_linear: bool,
    level: array<u32, 2>,
    weight: u32, // of the second level, in units of 2^-SAMPLER_LOD_BITS
}

fn texture_levels(base: u32, wanted: u32) -> TextureLevels {
    let bits = samplers[base + SAMPLER_LOD_BITS];
    var lambda = 0;
    if ((wanted & 0x7fffffffu) <= 0x7f800000u) {
        // 1024 stands for all that is larger, infinity included.
        let near = (wanted & 0x80000000u) | min(wanted & 0x7fffffffu, 0x44800000u);
        let position = texture_position(near, 0x44800000u, 1u, bits, false);
        lambda = clamp(bitcast<i32>(position.x), -(128 << bits), 128 << bits);
    }
    let first = i32(samplers[base + SAMPLER_FIRST_LEVEL]);
    let last = i32(samplers[base + SAMPLER_LAST_LEVEL]);
    var level = first;
    var weight = 0u;
    switch samplers[base + SAMPLER_MIP] {
        case MIP_NEAREST: { level = clamp((lambda + i32((1u << bits) >> 1u)) >> bits, first, last); }
        case MIP_LINEAR: {
            let clamped = clamp(lambda, first << bits, last << bits);
            level = clamped >> bits;
            weight = u32(clamped) & ((1u << bits) - 1u);
        }
        default: { }
    }
    let filter_word = select(SAMPLER_MAG, SAMPLER_MIN, lambda > 0);
    let levels = array<u32, 2>(u32(level), u32(min(level + 1, last)));
    return TextureLevels(samplers[base + filter_word] == FILTER_LINEAR, levels, weight);
}

// The taps of up to two levels: by level and axis, two indices and the weight of the second.
struct TextureTaps {
    index: array<vec2<u32>, 6>,
    weight: array<u32, 6>,
}

fn texture_taps(base: u32, place: TexturePlace, levels: TextureLevels) -> TextureTaps {
    var pick = levels;
    var taps: TextureTaps;
    let axes = samplers[base + SAMPLER_AXES];
    let fraction = select(0u, samplers[base + SAMPLER_FILTER_BITS], levels.filter_linear);
    let half_up = fraction != 0u;
    for (var slot = 0u; slot < 6u; slot++) {
        let row = slot / 3u;
        let axis = slot - 3u * row;
        if (row == 1u && levels.weight == 0u) { break; }
        if (axis >= axes) {
            taps.index[slot] = vec2<u32>(select(0u, place.face, axis == 2u));
            continue;
        }
        let size = samplers[base + SAMPLER_LEVELS + 4u * pick.level[row] + LEVEL_WIDTH + axis];
        let scale = select(1u, size, samplers[base + SAMPLER_NORMALISED] != 0u);
        let mode = samplers[base + SAMPLER_ADDRESS + axis];
        // From 2^24 on every FP32 number is an even integer: all of one sign address alike.
        var position = texture_position(place.coordinates[axis], 0x4b800000u, scale, fraction, half_up);
        if (half_up) {
            position = texture_add(position, texture_negated(vec2<u32>(1u << (fraction - 1u), 0u)));
        }
        let weight = position.x & ((1u << fraction) - 1u);
        let sign = bitcast<u32>(bitcast<i32>(position.y) >> 31u);
        var whole = texture_right(position, fraction);
        if (fraction != 0u) { whole.y |= sign << (32u - fraction); }
        for (var tap = 0u; tap < 2u; tap++) {
            taps.index[slot][tap] = texture_resolved(mode, whole, size);
            if (weight == 0u) { break; }
            whole = texture_add(whole, vec2<u32>(1u, 0u));
        }
        taps.weight[slot] = weight;
    }
    return taps;
}

// The stored words of the texel at a column, row and slice of a level.
fn texture_words(base: u32, level: u32, x: u32, y: u32, slice: u32) -> vec4<u32> {
    if (max(max(x, y), slice) == TEXTURE_BORDER) {
        let border = base + SAMPLER_BORDER;
        return vec4<u32>(samplers[border], samplers[border + 1u], samplers[border + 2u], samplers[border + 3u]);
    }
    let row = base + SAMPLER_LEVELS + 4u * level;
    let size = samplers[base + SAMPLER_TEXEL_WORDS];
    let number = (slice * samplers[row + LEVEL_HEIGHT] + y) * samplers[row + LEVEL_WIDTH] + x;
    let at = samplers[row + LEVEL_OFFSET] + number * size;
    var words = vec4<u32>(video[at], 0u, 0u, 0u);
    if (size > 1u) { words.y = video[at + 1u]; }
    if (size > 2u) { words.z = video[at + 2u]; words.w = video[at + 3u]; }
    return words;
}

// a + w (b - a) along each axis and between the levels, single precision; a weight of 0 gives a itself.
fn texture_blend(base: u32, taps: TextureTaps, level_weight: u32, texels: ptr<function, array<vec4<u32>, 16>>) {
    var weights = taps.weight;
    for (var axis = 0u; axis < 4u; axis++) {
        for (var pair = 0u; pair < (8u >> axis); pair++) {
            var weight = level_weight;
            var bits = samplers[base + SAMPLER_LOD_BITS];
            if (axis < 3u) {
                weight = weights[3u * (pair >> (2u - axis)) + axis];
                bits = samplers[base + SAMPLER_FILTER_BITS];
            }
            var a = (*texels)[2u * pair];
            if (weight != 0u) {
                let b = (*texels)[2u * pair + 1u];
                let single = texture_fixed(i32(weight), bits);
                for (var c = 0u; c < 4u; c++) {
                    var x = b[c];
                    for (var k = 0u; k < 3u; k++) {
                        var code = N_ADD;
                        var other = a[c];
                        if (k == 0u) { code = N_SUB; }
                        if (k == 1u) { code = N_MUL; other = single; }
                        x = s_alu(code, x, other);
                    }
                    a[c] = x;
                }
            }
            (*texels)[pair] = a;
        }
    }
}

// One lane's texel: texels that are integers are summed exactly and rounded once, floats blended in single precision.
fn texture_texel(base: u32, place: TexturePlace) -> vec4<u32> {
    var levels = texture_levels(base, place.wanted);
    var taps = texture_taps(base, place, levels);
    let floats = samplers[base + SAMPLER_FLOAT] != 0u;
    let filter_bits = samplers[base + SAMPLER_FILTER_BITS];
    let lod_bits = samplers[base + SAMPLER_LOD_BITS];
    var sums = array<vec2<u32>, 4>();
    var texels = array<vec4<u32>, 16>();
    let rows = select(1u, 2u, levels.weight != 0u);
    for (var row = 0u; row < rows; row++) {
        var part = levels.weight;
        if (row == 0u) { part = (1u << lod_bits) - part; }
        let slot = 3u * row;
        let second = vec3<u32>(taps.weight[slot], taps.weight[slot + 1u], taps.weight[slot + 2u]);
        let used = select(vec3<u32>(0u), vec3<u32>(1u, 2u, 4u), second != vec3<u32>(0u));
        let mask = used.x | used.y | used.z;
        for (var corner = 0u; corner <= mask; corner++) {
            if ((corner & ~mask) != 0u) { continue; }
            let side = vec3<u32>(corner & 1u, (corner >> 1u) & 1u, corner >> 2u);
            let words = texture_words(
                base, levels.level[row], taps.index[slot][side.x], taps.index[slot + 1u][side.y],
                taps.index[slot + 2u][side.z],
            );
            let weights = select(vec3<u32>(1u << filter_bits) - second, second, side == vec3<u32>(1u));
            let weight = texture_wide(weights.x * weights.y, weights.z * part); // at most 2^44
            for (var c = 0u; c < 4u; c++) {
                let component = samplers[base + SAMPLER_COMPONENTS + c];
                let bits = texel_bits(component, words);
                if (floats) {
                    texels[8u * row + corner][c] = texel_single(component, bits);
                } else {
                    let numerator = texel_numerator(component, bits); // at most 2^16
                    let size = u32(abs(numerator));
                    var product = texture_wide(weight.x, size);
                    product.y += weight.y * size;
                    if (numerator < 0) { product = texture_negated(product); }
                    sums[c] = texture_add(sums[c], product);
                }
            }
        }
    }
    if (floats) { texture_blend(base, taps, levels.weight, &texels); }
    let f = format(MAIN);
    var out = vec4<u32>(0u);
    // Single precision keeps what is single precision.
    if (floats && f.kind == 1u && f.upper == 8u && f.frac == 23u && f.denormals == 0u) { return texels[0]; }
    for (var c = 0u; c < 4u; c++) {
        var parts: TexelParts;
        if (floats) {
            parts = texel_parts_of_single(texels[0][c]);
        } else {
            let component = samplers[base + SAMPLER_COMPONENTS + c];
            parts = texel_parts_of_ratio(sums[c], texel_denominator(component), 3u * filter_bits + lod_bits);
        }
        out[c] = texel_rounded(f, parts);
    }
    return out;
}

// A texture read of the lanes that run: components by lanes, raw in the main format; 0 in the other lanes. Coordinates,
// bias and gradients (x, y, z, w along x, then along y) are single precision.
fn texture_read(
    number: u32, u: vec4<u32>, v: vec4<u32>, w: vec4<u32>, q: vec4<u32>, detail: u32, bias: vec4<u32>,
    gradients: array<vec4<u32>, 8>, run: vec4<bool>,
) -> array<vec4<u32>, 4> {
    let base = number * SAMPLER_WORDS;
    var out = array<vec4<u32>, 4>();
    for (var lane = 0u; lane < 4u; lane++) {
        if (!run[lane]) { continue; }
        let texel = texture_texel(base, texture_place(base, lane, u, v, w, detail, bias, gradients));
        for (var c = 0u; c < 4u; c++) { out[c][lane] = texel[c]; }
    }
    return out;
}

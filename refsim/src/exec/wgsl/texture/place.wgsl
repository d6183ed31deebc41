// Position of a lane's read: coordinates on the face of a cube, and level of detail (refsim::texture::lod).

const TEXTURE_ONE: u32 = 0x3f800000u;
const TEXTURE_HALF: u32 = 0x3f000000u;

// Words of a sampler that are read once per quad.
struct TextureState {
    base: u32,
    flags: u32,
    level_range: u32,
    lod_bias: u32,
    components: vec4<u32>,
}

fn texture_state(number: u32) -> TextureState {
    let base = number * SAMPLER_WORDS;
    let c = base + SAMPLER_COMPONENTS;
    return TextureState(
        base, samplers[base + SAMPLER_FLAGS], samplers[base + SAMPLER_LEVEL_RANGE], samplers[base + SAMPLER_LOD_BIAS],
        vec4<u32>(samplers[c], samplers[c + 1u], samplers[c + 2u], samplers[c + 3u]),
    );
}

fn texture_flag(s: TextureState, at: u32, width: u32) -> u32 {
    return extractBits(s.flags, at, width);
}

struct TexturePlace {
    coordinates: vec3<u32>,
    face: u32,
    wanted: u32, // the level of detail with all biases, single precision
}

// An integer with a magnitude below 2^24 divided by 2^bits, as FP32.
fn texture_fixed(value: i32, bits: u32) -> u32 {
    if (value == 0) { return 0u; }
    let magnitude = u32(abs(value));
    let left = countLeadingZeros(magnitude) - 8u;
    let sign = select(0u, 0x80000000u, value < 0);
    return sign | ((150u - left - bits) << 23u) | ((magnitude << left) & 0x7fffffu);
}

// Half the base-2 logarithm of an FP32 number >= 0, rounded down to a multiple of 2^-bits.
fn texture_half_log2(squared: u32, bits: u32) -> u32 {
    if (squared >= 0x7f800000u) { return texture_fixed(select(127, 0, squared > 0x7f800000u), 0u); }
    if (squared == 0u) { return texture_fixed(-127, 0u); }
    let field = squared >> 23u;
    let significand = (squared & 0x7fffffu) | select(0u, 0x800000u, field != 0u);
    let top = 31u - countLeadingZeros(significand);
    var result = i32(max(field, 1u)) - 150 + i32(top);
    var m = texture_left(vec2<u32>(significand, 0u), 62u - top); // in [1, 2), 62 fraction bits
    for (var k = 0u; k < bits; k++) {
        // Computes the square (128 bits, in three words from 2^32 up), then extracts the bits from 2^62 up.
        let outer = texture_wide(m.y, m.y);
        let cross = texture_left(texture_wide(m.x, m.y), 1u);
        let low = texture_add(vec2<u32>(texture_wide(m.x, m.x).y, 0u), cross);
        let high = texture_add(outer, vec2<u32>(low.y, 0u));
        m = vec2<u32>((high.x << 2u) | (low.x >> 30u), (high.y << 2u) | (high.x >> 30u));
        let carry = m.y >> 31u;
        m = texture_right(m, carry);
        result = result * 2 + i32(carry);
    }
    return texture_fixed(result >> 1u, bits);
}

// Steps of texture_place; each executes one operation of single precision.
const TEXTURE_STEP_AXES: u32 = 0u; // no operation: a new direction begins
const TEXTURE_STEP_CHANGE: u32 = 1u;
const TEXTURE_STEP_MOVE: u32 = 2u;
const TEXTURE_STEP_QUOTIENT: u32 = 3u;
const TEXTURE_STEP_MINOR: u32 = 4u;
const TEXTURE_STEP_MAJOR: u32 = 5u;
const TEXTURE_STEP_TURN: u32 = 6u;
const TEXTURE_STEP_SLOPE: u32 = 7u;
const TEXTURE_STEP_SHRINK: u32 = 8u;
const TEXTURE_STEP_HALVE: u32 = 9u;
const TEXTURE_STEP_SCALE: u32 = 10u;
const TEXTURE_STEP_SQUARE: u32 = 11u;
const TEXTURE_STEP_SUM: u32 = 12u;
const TEXTURE_STEP_BIAS: u32 = 13u;
const TEXTURE_STEP_STATE: u32 = 14u;
const TEXTURE_STEP_DIVIDE: u32 = 15u;
const TEXTURE_STEP_SHIFT: u32 = 16u;
const TEXTURE_STEP_FACE: u32 = 17u;
const TEXTURE_STEP_END: u32 = 18u;

// All single-precision arithmetic before the texels goes through the one call of s_alu below, so that an inlining
// compiler makes one copy of it.
fn texture_place(s: TextureState, lane: u32, detail: u32) -> TexturePlace {
    var at = vec3<u32>(0u);
    for (var i = 0u; i < 3u; i++) { at[i] = texture_operand(i, lane); }
    let cube = texture_flag(s, FLAG_KIND, 3u) == KIND_CUBE;
    let axes = texture_flag(s, FLAG_AXES, 2u);
    let start = vec3<u32>(texture_finite(at.x), texture_finite(at.y), texture_finite(at.z));
    let face = texture_face(start);
    let own = texture_face_axes(face, start); // of a cube: both minor axes and the magnitude of the major one
    var place = TexturePlace(at, 0u, s.lod_bias);
    if (HAS_CUBES) {
        if (cube) { place = TexturePlace(vec3<u32>(own.x, own.y, 0u), face, place.wanted); }
    }

    var change = vec3<u32>(0u);
    var moved = vec3<u32>(0u);
    var low = vec3<u32>(0u);
    var high = vec3<u32>(0u);
    var axis = 0u;
    var direction = 0u;
    var sum = 0u;
    var largest = 0u;
    var x = 0u;
    var y = 0u;
    if (HAS_TEXTURE_DETAIL) {
        var step = select(TEXTURE_STEP_END, TEXTURE_STEP_DIVIDE, cube);
        if (texture_flag(s, FLAG_DETAIL, 1u) != 0u) { step = TEXTURE_STEP_AXES; }
        loop {
            if (step == TEXTURE_STEP_AXES) {
                sum = 0u;
                axis = 0u;
                if (detail == DETAIL_GRADIENTS) {
                    let first = 4u * direction;
                    for (var i = 0u; i < 3u; i++) { change[i] = texture_operand(4u + first + i, lane); }
                    step = select(TEXTURE_STEP_SCALE, TEXTURE_STEP_MOVE, cube);
                } else {
                    let from_lane = lane & ~(1u << direction);
                    let to_lane = lane | (1u << direction);
                    for (var i = 0u; i < 3u; i++) {
                        low[i] = texture_operand(i, from_lane);
                        high[i] = texture_operand(i, to_lane);
                    }
                    step = TEXTURE_STEP_CHANGE;
                }
            }
            if (step == TEXTURE_STEP_END) { break; }
            var op = N_MUL;
            var a = x;
            var b = x;
            switch step {
                case TEXTURE_STEP_CHANGE: { op = N_SUB; a = high[axis]; b = low[axis]; }
                case TEXTURE_STEP_MOVE: { op = N_ADD; a = start[axis]; b = change[axis]; }
                case TEXTURE_STEP_QUOTIENT: { op = N_DIV; a = own[axis]; b = own.z; }
                case TEXTURE_STEP_MINOR: { op = N_SUB; a = moved[axis]; b = own[axis]; }
                case TEXTURE_STEP_MAJOR: { op = N_SUB; a = moved.z; b = own.z; }
                case TEXTURE_STEP_TURN: { a = y; b = low.x; }
                case TEXTURE_STEP_SLOPE: { op = N_SUB; a = x; b = y; }
                case TEXTURE_STEP_SHRINK: { op = N_DIV; b = own.z; }
                case TEXTURE_STEP_HALVE: { b = TEXTURE_HALF; }
                case TEXTURE_STEP_SCALE: { a = select(change[axis], x, cube); b = samplers[s.base + SAMPLER_SCALES + axis]; }
                case TEXTURE_STEP_SQUARE: { }
                case TEXTURE_STEP_SUM: { op = N_ADD; a = sum; }
                case TEXTURE_STEP_BIAS: { op = N_ADD; a = place.wanted; b = texture_operand(4u, lane); }
                case TEXTURE_STEP_STATE: { op = N_ADD; a = place.wanted; b = s.lod_bias; }
                case TEXTURE_STEP_DIVIDE: { op = N_DIV; a = own[axis]; b = own.z; }
                case TEXTURE_STEP_SHIFT: { op = N_ADD; b = TEXTURE_ONE; }
                default: { b = TEXTURE_HALF; }
            }
            let r = s_alu(op, a, b);
            switch step {
                case TEXTURE_STEP_CHANGE: {
                    change[axis] = r;
                    axis++;
                    if (axis == 3u) {
                        axis = 0u;
                        step = select(TEXTURE_STEP_SCALE, TEXTURE_STEP_MOVE, cube);
                    }
                }
                case TEXTURE_STEP_MOVE: {
                    moved[axis] = r;
                    axis++;
                    if (axis == 3u) {
                        axis = 0u;
                        moved = texture_face_axes(face, moved);
                        step = TEXTURE_STEP_QUOTIENT;
                    }
                }
                case TEXTURE_STEP_QUOTIENT: { y = r; step = TEXTURE_STEP_MINOR; }
                case TEXTURE_STEP_MAJOR: { low.x = r; step = TEXTURE_STEP_TURN; }
                case TEXTURE_STEP_TURN: { y = r; step = TEXTURE_STEP_SLOPE; }
                case TEXTURE_STEP_SUM: {
                    sum = r;
                    axis++;
                    if (axis < axes) {
                        step = select(TEXTURE_STEP_SCALE, TEXTURE_STEP_QUOTIENT, cube);
                    } else {
                        // Patterns of numbers >= 0 have the order of the numbers, with the canonical NaN above all.
                        largest = max(largest, sum);
                        direction++;
                        axis = 0u;
                        step = TEXTURE_STEP_AXES;
                        if (direction == 2u) {
                            place.wanted = texture_half_log2(largest, texture_flag(s, FLAG_LOD_BITS, 4u));
                            step = select(TEXTURE_STEP_STATE, TEXTURE_STEP_BIAS, detail == DETAIL_BIASED);
                        }
                    }
                }
                case TEXTURE_STEP_BIAS: { place.wanted = r; step = TEXTURE_STEP_STATE; }
                case TEXTURE_STEP_STATE: {
                    place.wanted = r;
                    step = select(TEXTURE_STEP_END, TEXTURE_STEP_DIVIDE, cube);
                }
                case TEXTURE_STEP_FACE: {
                    place.coordinates[axis] = r;
                    axis++;
                    step = select(TEXTURE_STEP_END, TEXTURE_STEP_DIVIDE, axis == 1u);
                }
                default: { x = r; step++; }
            }
        }
    }
    return place;
}

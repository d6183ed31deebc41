// Conversion of coordinates to texel indices: refsim::texture::address in pairs of words (x low, y high).

// Index of the border texel.
const TEXTURE_BORDER: u32 = 0xffffffffu;

fn texture_wide(a: u32, b: u32) -> vec2<u32> {
    let low = (a & 0xffffu) * (b & 0xffffu);
    let middle = (a >> 16u) * (b & 0xffffu) + (low >> 16u);
    let cross = (a & 0xffffu) * (b >> 16u) + (middle & 0xffffu);
    return vec2<u32>((cross << 16u) | (low & 0xffffu), (a >> 16u) * (b >> 16u) + (middle >> 16u) + (cross >> 16u));
}

fn texture_add(a: vec2<u32>, b: vec2<u32>) -> vec2<u32> {
    let low = a.x + b.x;
    return vec2<u32>(low, a.y + b.y + select(0u, 1u, low < a.x));
}

fn texture_negated(a: vec2<u32>) -> vec2<u32> {
    return vec2<u32>(~a.x + 1u, ~a.y + select(0u, 1u, a.x == 0u));
}

fn texture_left(a: vec2<u32>, shift: u32) -> vec2<u32> {
    let part = shift & 31u;
    // Shifts by 32 - part in two steps, because WGSL has no shift by 32.
    let near = vec2<u32>(a.x << part, (a.y << part) | ((a.x >> 1u) >> (31u - part)));
    let moved = select(near, vec2<u32>(0u, near.x), shift >= 32u);
    return select(moved, vec2<u32>(0u), shift >= 64u);
}

fn texture_right(a: vec2<u32>, shift: u32) -> vec2<u32> {
    let part = shift & 31u;
    let near = vec2<u32>((a.x >> part) | ((a.y << 1u) << (31u - part)), a.y >> part);
    let moved = select(near, vec2<u32>(near.y, 0u), shift >= 32u);
    return select(moved, vec2<u32>(0u), shift >= 64u);
}

// floor(coordinate * scale * 2^fraction) in two's complement; with `half_up`, rounded to nearest, halves up. NaN and
// infinities count as 0. Larger magnitudes than `most` (FP32 bits of a finite number) are clamped to it, so that the
// result has at most 54 bits.
fn texture_position(coordinate: u32, most: u32, scale: u32, fraction: u32, half_up: bool) -> vec2<u32> {
    let given = coordinate & 0x7fffffffu;
    let size = select(min(given, most), 0u, given >= 0x7f800000u);
    let field = size >> 23u;
    let significand = (size & 0x7fffffu) | select(0u, 0x800000u, field != 0u);
    let product = texture_wide(significand, scale);
    // One extra fraction bit, so that a half can be added before the floor.
    let shift = i32(max(field, 1u)) - 150 + i32(fraction) + 1;
    var doubled = product;
    var lost = false;
    if (shift >= 0) {
        doubled = texture_left(product, u32(shift));
    } else {
        doubled = texture_right(product, u32(-shift));
        let back = texture_left(doubled, u32(-shift));
        lost = any(back != product);
    }
    if ((coordinate >> 31u) == 1u) {
        doubled = texture_negated(doubled);
        if (lost) { doubled = texture_add(doubled, vec2<u32>(0xffffffffu)); }
    }
    if (half_up) { doubled = texture_add(doubled, vec2<u32>(1u, 0u)); }
    return vec2<u32>((doubled.x >> 1u) | (doubled.y << 31u), bitcast<u32>(bitcast<i32>(doubled.y) >> 1u));
}

// Applies an address mode to a position in two's complement; returns an index, or TEXTURE_BORDER.
fn texture_resolved(mode: u32, position: vec2<u32>, size: u32) -> u32 {
    let below = (position.y >> 31u) == 1u;
    let inside = position.y == 0u && position.x < size;
    let outside = select(select(size - 1u, 0u, below), TEXTURE_BORDER, mode == ADDRESS_BORDER);
    var index = select(outside, position.x, inside);
    if (HAS_PERIODS) {
        if (mode <= ADDRESS_MIRROR) {
            let period = size << mode; // mirrored images repeat every two sizes
            var rest = position.x & (period - 1u);
            if ((period & (period - 1u)) != 0u) {
                var magnitude = position;
                if (below) { magnitude = texture_negated(position); }
                // The period has at most 16 bits: a remainder and sixteen more bits fit a word.
                rest = magnitude.y % period;
                rest = ((rest << 16u) | (magnitude.x >> 16u)) % period;
                rest = ((rest << 16u) | (magnitude.x & 0xffffu)) % period;
                if (below && rest != 0u) { rest = period - rest; }
            }
            index = select(rest, 2u * size - 1u - rest, rest >= size);
        }
    }
    return index;
}

// Signed axes of a face, and signed major axis, of a vector on this face.
fn texture_face_axes(face: u32, v: vec3<u32>) -> vec3<u32> {
    let flipped = v ^ vec3<u32>(0x80000000u);
    switch face {
        case 0u: { return vec3<u32>(flipped.z, flipped.y, v.x); }
        case 1u: { return vec3<u32>(v.z, flipped.y, flipped.x); }
        case 2u: { return vec3<u32>(v.x, v.z, v.y); }
        case 3u: { return vec3<u32>(v.x, flipped.z, flipped.y); }
        case 4u: { return vec3<u32>(v.x, flipped.y, v.z); }
        default: { return vec3<u32>(flipped.x, flipped.y, flipped.z); }
    }
}

// The cube face that a finite direction hits; for equal magnitudes z precedes y, and y precedes x.
fn texture_face(v: vec3<u32>) -> u32 {
    let size = v & vec3<u32>(0x7fffffffu);
    let below = v >> vec3<u32>(31u);
    if (size.z >= size.y && size.z >= size.x) { return 4u + below.z; }
    if (size.y >= size.x) { return 2u + below.y; }
    return below.x;
}

fn texture_finite(bits: u32) -> u32 {
    return select(bits, 0u, (bits & 0x7f800000u) == 0x7f800000u);
}

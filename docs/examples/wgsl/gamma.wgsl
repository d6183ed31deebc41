// Two sRGB colors, decoded, blended in linear light, and encoded again.
fn decode(c: vec3f) -> vec3f {
    let high = pow((c + vec3f(0.055)) / 1.055, vec3f(2.4));
    return select(high, c / 12.92, c <= vec3f(0.04045));
}

fn encode(c: vec3f) -> vec3f {
    let high = 1.055 * pow(c, vec3f(1.0 / 2.4)) - vec3f(0.055);
    return select(high, c * 12.92, c <= vec3f(0.0031308));
}

@fragment
fn main(@location(0) uv: vec2f) -> @location(0) vec4f {
    let ramp = decode(vec3f(uv.x, 1.0 - uv.x, 0.5 * uv.x));
    let flat_color = decode(vec3f(0.2, 0.1, 0.05));
    return vec4f(encode(mix(flat_color, ramp, uv.y)), 1.0);
}

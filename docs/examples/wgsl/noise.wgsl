// Three octaves of value noise: hashes of the four corners of a cell, interpolated.
@group(0) @binding(0) var<uniform> scale: f32;

fn hash(p: vec2f) -> f32 {
    return fract(sin(dot(p, vec2f(12.9898, 78.233))) * 43758.547);
}

fn noise(p: vec2f) -> f32 {
    let cell = floor(p);
    let f = fract(p);
    let t = f * f * (3.0 - 2.0 * f);
    let low = mix(hash(cell), hash(cell + vec2f(1.0, 0.0)), t.x);
    let high = mix(hash(cell + vec2f(0.0, 1.0)), hash(cell + vec2f(1.0, 1.0)), t.x);
    return mix(low, high, t.y);
}

@fragment
fn main(@location(0) uv: vec2f) -> @location(0) vec4f {
    var sum = 0.0;
    var weight = 0.5;
    var p = uv * scale;
    for (var octave = 0; octave < 3; octave++) {
        sum += noise(p) * weight;
        weight *= 0.5;
        p = p * 2.0 + vec2f(17.0);
    }
    return vec4f(vec3f(sum), 1.0);
}

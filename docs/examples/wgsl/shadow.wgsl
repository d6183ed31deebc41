// A shadow-map test with slope-scaled bias, on a plane that shadows itself where depths have too few bits.
@group(0) @binding(0) var<uniform> bias: f32;
@group(0) @binding(1) var<uniform> texels: f32;

@fragment
fn main(@location(0) uv: vec2f) -> @location(0) vec4f {
    // Depths of a sloped plane from 0.5 to 0.9, and the depths that a map with so many texels stores.
    let depth = 0.5 + 0.4 * uv.x;
    let kept = 0.5 + 0.4 * (floor(uv.x * texels) + 0.5) / texels;
    let slope = fwidth(depth);
    var lit = 1.0;
    if (depth - bias * slope > kept) {
        lit = 0.3;
    }
    if (uv.y > 0.5) {
        lit = lit * 0.5;
    }
    return vec4f(vec3f(lit), 1.0);
}

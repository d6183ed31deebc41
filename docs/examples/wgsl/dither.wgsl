// A dark gradient in eight bits, dithered with interleaved gradient noise at the pixel's position.
@group(0) @binding(0) var<uniform> levels: f32;

@fragment
fn main(@builtin(position) at: vec4f, @location(0) uv: vec2f) -> @location(0) vec4f {
    let noise = fract(52.982918 * fract(dot(at.xy, vec2f(0.06711056, 0.00583715))));
    let shade = 0.1 + 0.1 * uv.x;
    let code = floor(shade * levels + noise);
    return vec4f(vec3f(code / levels), 1.0);
}

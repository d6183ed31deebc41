// Filmic tone mapping with a quotient of quadratic polynomials, on a ramp of 12 stops.
@group(0) @binding(0) var<uniform> exposure: f32;

fn film(x: vec3f) -> vec3f {
    let over = x * (2.51 * x + vec3f(0.03));
    let under = x * (2.43 * x + vec3f(0.59)) + vec3f(0.14);
    return saturate(over / under);
}

@fragment
fn main(@location(0) uv: vec2f) -> @location(0) vec4f {
    let radiance = exp2(uv.x * 12.0 - 6.0) * exposure;
    let tint = mix(vec3f(1.0, 0.6, 0.3), vec3f(0.3, 0.6, 1.0), uv.y);
    let mapped = film(tint * radiance);
    return vec4f(pow(mapped, vec3f(1.0 / 2.2)), 1.0);
}

// Schlick's approximation of Fresnel reflectance, which brightens the rim of a sphere.
@group(0) @binding(0) var<uniform> f0: vec3f;

@fragment
fn main(@location(0) uv: vec2f) -> @location(0) vec4f {
    let xy = uv * 2.0 - vec2f(1.0);
    let n_dot_v = sqrt(saturate(1.0 - dot(xy, xy)));
    let rest = 1.0 - n_dot_v;
    let rest2 = rest * rest;
    let power = rest2 * rest2 * rest;
    return vec4f(f0 + (vec3f(1.0) - f0) * power, 1.0);
}

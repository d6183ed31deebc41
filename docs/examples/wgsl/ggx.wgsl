// A highlight with the distribution of Trowbridge and Reitz (GGX), on a sphere seen from the front.
@group(0) @binding(0) var<uniform> roughness: f32;

fn distribution(n_dot_h: f32, alpha: f32) -> f32 {
    let alpha2 = alpha * alpha;
    let d = n_dot_h * n_dot_h * (alpha2 - 1.0) + 1.0;
    return alpha2 / (3.14159265 * d * d);
}

fn visibility(n_dot_l: f32, n_dot_v: f32, alpha: f32) -> f32 {
    let k = alpha * 0.5;
    let light = n_dot_l * (1.0 - k) + k;
    let view = n_dot_v * (1.0 - k) + k;
    return 0.25 / (light * view);
}

@fragment
fn main(@location(0) uv: vec2f) -> @location(0) vec4f {
    let xy = uv * 1.8 - vec2f(0.9);
    let n = vec3f(xy, sqrt(max(1.0 - dot(xy, xy), 0.01)));
    let l = normalize(vec3f(0.4, 0.3, 0.8));
    let h = normalize(l + vec3f(0.0, 0.0, 1.0));
    let n_dot_l = max(dot(n, l), 0.0);
    let n_dot_h = max(dot(n, h), 0.0);
    let alpha = roughness * roughness;
    let specular = distribution(n_dot_h, alpha) * visibility(n_dot_l, n.z, alpha) * n_dot_l;
    return vec4f(vec3f(min(specular * 0.2, 1.0)), 1.0);
}

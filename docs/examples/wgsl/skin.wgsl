// Skinning: a normal is turned by the weighted sum of two bone matrices, then lit by wrapped, tinted light.
struct Bones {
    first: mat3x3f,
    second: mat3x3f,
}
@group(0) @binding(0) var<uniform> bones: Bones;

@fragment
fn main(@location(0) uv: vec2f) -> @location(0) vec4f {
    let xy = uv * 1.6 - vec2f(0.8);
    let rest = vec3f(xy, sqrt(max(1.0 - dot(xy, xy), 0.0)));
    let weight = smoothstep(0.2, 0.8, uv.x);
    let turned = bones.first * (rest * (1.0 - weight)) + bones.second * (rest * weight);
    let n = normalize(turned);
    let wrapped = (dot(n, vec3f(0.6, 0.64, 0.48)) + 0.4) / 1.4;
    let light = max(wrapped, 0.0);
    let scatter = smoothstep(0.0, 0.35, light) * smoothstep(0.7, 0.35, light);
    return vec4f(vec3f(0.9, 0.7, 0.6) * light + vec3f(0.3, 0.05, 0.02) * scatter, 1.0);
}

// Tangent-space normals from a texture, lit from one direction.
@group(0) @binding(0) var normals: texture_2d<f32>;
@group(0) @binding(1) var linear_repeat: sampler;
@group(0) @binding(2) var<uniform> light: vec3f;

@fragment
fn main(@location(0) uv: vec2f) -> @location(0) vec4f {
    let texel = textureSample(normals, linear_repeat, uv * 2.0).xyz;
    let n = normalize(texel * 2.0 - vec3f(1.0));
    let l = normalize(light);
    let diffuse = max(dot(n, l), 0.0);
    let mirrored = reflect(-l, n);
    let highlight = pow(max(mirrored.z, 0.001), 32.0);
    return vec4f(vec3f(0.1) + vec3f(0.6, 0.5, 0.4) * diffuse + vec3f(0.3 * highlight), 1.0);
}

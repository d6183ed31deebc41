// The bright part of a picture for bloom: a threshold with a soft knee, then a blur over five texels.
@group(0) @binding(0) var scene: texture_2d<f32>;
@group(0) @binding(1) var linear_clamp: sampler;
@group(0) @binding(2) var<uniform> threshold: f32;
@group(0) @binding(3) var<uniform> knee: f32;

const WEIGHTS = array<f32, 3>(0.375, 0.25, 0.0625);

fn bright(color: vec3f) -> vec3f {
    let brightness = max(color.r, max(color.g, color.b));
    let soft = clamp(brightness - threshold + knee, 0.0, 2.0 * knee);
    let curve = soft * soft / (4.0 * knee + 0.00001);
    let part = max(curve, brightness - threshold) / max(brightness, 0.00001);
    return color * part;
}

@fragment
fn main(@location(0) uv: vec2f) -> @location(0) vec4f {
    var sum = bright(4.0 * textureSample(scene, linear_clamp, uv).rgb) * WEIGHTS[0];
    for (var i = 1; i < 3; i++) {
        let offset = vec2f(f32(i) / 16.0, 0.0);
        sum += bright(4.0 * textureSample(scene, linear_clamp, uv + offset).rgb) * WEIGHTS[i];
        sum += bright(4.0 * textureSample(scene, linear_clamp, uv - offset).rgb) * WEIGHTS[i];
    }
    return vec4f(sum, 1.0);
}

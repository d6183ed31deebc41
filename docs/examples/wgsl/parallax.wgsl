// Parallax mapping: a few steps along the ray through a height field, then one interpolation.
@group(0) @binding(0) var<uniform> view: vec3f;
@group(0) @binding(1) var<uniform> depth: f32;

fn height(at: vec2f) -> f32 {
    let wave = sin(at * 18.849556);
    return 0.5 + 0.25 * (wave.x + wave.y);
}

@fragment
fn main(@location(0) uv: vec2f) -> @location(0) vec4f {
    let step_over = view.xy / view.z * depth / 8.0;
    var at = uv;
    var layer = 0.0;
    var before = 0.0;
    for (var i = 0; i < 8; i++) {
        let below = 1.0 - height(at);
        if (layer >= below) {
            break;
        }
        before = below - layer;
        at -= step_over;
        layer += 0.125;
    }
    let after = layer - (1.0 - height(at));
    let part = after / max(after + before, 0.0001);
    let hit = at + step_over * part;
    return vec4f(vec3f(height(hit)), 1.0);
}

// A box with round corners, from its signed distance, with an edge one pixel wide.
struct Box {
    half_size: vec2f,
    radius: f32,
}
@group(0) @binding(0) var<uniform> box: Box;

fn distance_to_box(p: vec2f) -> f32 {
    let q = abs(p) - box.half_size + vec2f(box.radius);
    return length(max(q, vec2f(0.0))) + min(max(q.x, q.y), 0.0) - box.radius;
}

@fragment
fn main(@location(0) uv: vec2f) -> @location(0) vec4f {
    // Pixels in the right part of a screen that is 1920 pixels wide.
    let p = uv * 64.0 + vec2f(1500.0, 800.0);
    let d = distance_to_box(p - vec2f(1532.0, 832.0));
    let inside = 1.0 - smoothstep(-0.5, 0.5, d);
    return vec4f(mix(vec3f(0.95), vec3f(0.1, 0.3, 0.7), inside), 1.0);
}

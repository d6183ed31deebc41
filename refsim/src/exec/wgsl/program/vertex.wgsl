// Vertex programs: four vertices an invocation, one a lane. Attributes are 64 words a vertex, v0 first; results 47: the
// outputs in the order of program/lower.rs, then the instruction slots of the four in the first one's.

@group(0) @binding(0) var<storage, read> draw: array<u32>;
@group(0) @binding(1) var<storage, read> attributes: array<u32>;
@group(0) @binding(2) var<storage, read> code: array<u32>;
@group(0) @binding(3) var<storage, read_write> scratch: array<vec4<u32>>;
@group(0) @binding(4) var<storage, read_write> vertices: array<u32>;

const MAIN: u32 = 0u;
const SINGLE: u32 = 2u;

fn format(k: u32) -> Format {
    let at = 8u * k;
    return Format(
        draw[at], draw[at + 1u], draw[at + 2u], draw[at + 3u],
        draw[at + 4u], draw[at + 5u], draw[at + 6u], draw[at + 7u],
    );
}

var<private> q_input: array<vec4<u32>, 64>;
var<private> q_run: vec4<bool>;
var<private> q_covered: vec4<bool>;
var<private> q_invocation: u32;
var<private> q_stride: u32;
// Vertex programs are never broken off.
var<private> q_passes: u32;
var<private> q_save: u32;
var<private> q_suspended: bool;
// Nor are steps counted.
var<private> q_counts_steps: bool;
var<private> q_step_budget: u32;
var<private> q_cut: vec4<bool>;
var<private> q_code: u32;
var<private> q_trace: u32;
var<private> q_traced: u32;
var<private> q_color: array<array<vec4<u32>, 4>, 4>;
var<private> q_depth: vec4<u32>;
var<private> q_depth_is_main: vec4<bool>;
var<private> q_killed: vec4<bool>;
var<private> q_fetched: array<u32, 16>;
var<private> q_executed: u32;
var<private> v_first: u32;
var<private> v_count: u32;

fn trace_put(at: u32, word: u32) {
}

fn texture_read(
    sampler_number: u32, u: vec4<u32>, v: vec4<u32>, w: vec4<u32>, q: vec4<u32>, detail: u32, bias: vec4<u32>,
    gradients: array<vec4<u32>, 8>, run: vec4<bool>,
) -> array<vec4<u32>, 4> {
    return array<vec4<u32>, 4>();
}

fn output_put(word: u32, row: vec4<u32>) {
    for (var i = 0u; i < v_count; i += 1u) {
        vertices[47u * (v_first + i) + word] = row[i];
    }
}

@compute @workgroup_size(64)
fn vertex_main(
    @builtin(global_invocation_id) invocation: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>,
) {
    q_invocation = invocation.x;
    q_stride = 64u * groups.x;
    q_passes = 0xffffffffu;
    let all = draw[40];
    for (var first = 4u * q_invocation; first < all; first += 4u * q_stride) {
        v_first = first;
        v_count = min(all - first, 4u);
        q_covered = vec4<u32>(0u, 1u, 2u, 3u) < vec4<u32>(v_count);
        q_run = q_covered;
        for (var c = 0u; c < 64u; c += 1u) {
            var row = vec4<u32>(0u);
            for (var i = 0u; i < v_count; i += 1u) {
                let bits = attributes[64u * (first + i) + c];
                row[i] = select(bits, 0x7fc00000u, (bits & 0x7fffffffu) > 0x7f800000u);
            }
            q_input[c] = row;
        }
        for (var word = 0u; word < 47u; word += 1u) {
            output_put(word, vec4<u32>(0u));
        }
        shade();
        vertices[47u * first + 46u] = q_executed;
    }
}

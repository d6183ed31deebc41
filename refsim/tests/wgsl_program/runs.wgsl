// Nothing but the program: inputs from `setups`, results into `video`.

@compute @workgroup_size(64)
fn run(@builtin(local_invocation_index) invocation: u32) {
    q_invocation = invocation;
    q_stride = 64u;
    let from_word = invocation * 166u;
    for (var i = 0u; i < 41u; i += 1u) {
        for (var lane = 0u; lane < 4u; lane += 1u) {
            q_input[i][lane] = setups[from_word + 4u * i + lane];
        }
    }
    let bits = vec4<u32>(1u, 2u, 4u, 8u);
    q_run = (vec4<u32>(setups[from_word + 164u]) & bits) != vec4<u32>(0u);
    q_covered = (vec4<u32>(setups[from_word + 165u]) & bits) != vec4<u32>(0u);
    q_depth = vec4<u32>(0u);
    q_trace = select(0u, draw[40], invocation == 0u);
    q_passes = 0xffffffffu;
    shade();
    if (q_trace != 0u) {
        atomicStore(&counts[0], q_traced);
    }
    let to_word = invocation * 93u;
    for (var lane = 0u; lane < 4u; lane += 1u) {
        for (var i = 0u; i < 16u; i += 1u) {
            video[to_word + 4u * i + lane] = q_color[i / 4u][i % 4u][lane];
        }
        video[to_word + 64u + lane] = q_depth[lane];
        video[to_word + 68u + lane] = select(0u, 1u, q_depth_is_main[lane]);
        video[to_word + 72u + lane] = select(0u, 1u, q_killed[lane]);
    }
    for (var i = 0u; i < 16u; i += 1u) {
        video[to_word + 76u + i] = q_fetched[i];
    }
    video[to_word + 92u] = q_executed + samplers[0] + tiles[0];
}

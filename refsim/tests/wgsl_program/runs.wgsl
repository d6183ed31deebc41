// Nothing but the program: inputs from `setups`, results into `video`.

@compute @workgroup_size(64)
fn run(@builtin(local_invocation_index) invocation: u32) {
    q_invocation = invocation;
    q_stride = 64u;
    q_rows = draw[41];
    q_save = q_rows + 66u;
    let from_word = invocation * 166u;
    for (var i = 0u; i < 41u; i += 1u) {
        for (var lane = 0u; lane < 4u; lane += 1u) {
            scratch[q_row(0xff00u + i)][lane] = setups[from_word + 4u * i + lane];
        }
    }
    let bits = vec4<u32>(1u, 2u, 4u, 8u);
    q_run = (vec4<u32>(setups[from_word + 164u]) & bits) != vec4<u32>(0u);
    q_covered = (vec4<u32>(setups[from_word + 165u]) & bits) != vec4<u32>(0u);
    q_trace = select(0u, draw[40], invocation == 0u);
    q_passes = 0xffffffffu;
    q_step_budget = 0xffffffffu;
    shade();
    if (q_trace != 0u) {
        atomicStore(&counts[0], q_traced);
    }
    let to_word = invocation * 92u;
    for (var i = 0u; i < 76u; i += 1u) {
        video[to_word + i] = scratch[q_row(ROW_COLORS + i / 4u)][i % 4u];
    }
    for (var i = 0u; i < 16u; i += 1u) {
        video[to_word + 76u + i] = q_fetched[i];
    }
    // Every binding is used.
    video[0] += (samplers[0] + tiles[0]) & 0u;
}

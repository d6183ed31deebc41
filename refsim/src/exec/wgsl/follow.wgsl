// Traces pixels. Each invocation runs one pixel through its triangles up to the first that covers it, and records what
// every instruction wrote and the fragment's fate. Workgroups have one invocation, because divergent lanes would use up
// each other's loop iterations.
//
// `tiles` holds four words per pixel: column, row, first triangle of its list, number of triangles. Pixel k uses column
// k of the copies of the targets.

// Index in `video` of the first step of the record.
var<private> f_steps: u32;

fn trace_put(at: u32, word: u32) {
    if (at < draw[D_FOLLOW + 2u]) {
        video[f_steps + at] = word;
    }
}

@compute @workgroup_size(1)
fn follow_main(@builtin(workgroup_id) group: vec3<u32>) {
    let job = group.x;
    if (job >= draw[D_TILES]) {
        return;
    }
    let x = tiles[4u * job];
    let y = tiles[4u * job + 1u];
    let first = tiles[4u * job + 2u];
    let count = tiles[4u * job + 3u];
    let lane = (x & 1u) | ((y & 1u) << 1u);
    q_invocation = job;
    q_stride = draw[D_STRIDE];
    q_rows = draw[D_ROWS];
    q_save = q_rows + IN_OUT_ROWS;
    let record = draw[D_FOLLOW] + job * draw[D_FOLLOW + 1u];
    f_steps = record + FOLLOW_HEAD;
    let state_at = (q_save + SAVED_ROWS - 1u) * q_stride + q_invocation;
    var i = 0u;
    if (draw[D_RESUMES] == 1u) {
        let state = scratch[state_at];
        if (state.w == 1u) {
            return;
        }
        i = state.x;
        q_suspended = state.y == 1u;
        q_traced = state.z;
    }
    var passes_left = draw[D_PASSES];
    var status = FOLLOW_NOTHING;
    for (; i < count; i++) {
        if (passes_left < LOOK_COST + draw[D_COST]) {
            status = FOLLOW_UNFINISHED;
            break;
        }
        passes_left -= LOOK_COST;
        let at = tiles[first + i] * draw[D_SETUP_WORDS];
        if (!r_cover(at, x & 0xfffffffeu, y & 0xfffffffeu)[lane]) {
            continue;
        }
        r_start(at, x & 0xfffffffeu, y & 0xfffffffeu);
        q_covered = vec4<u32>(lane) == vec4<u32>(0u, 1u, 2u, 3u);
        q_run = vec4<bool>(true);
        q_trace = lane + 1u;
        q_passes = passes_left - draw[D_COST];
        shade();
        status = select(FOLLOW_FRAGMENT, FOLLOW_UNFINISHED, q_suspended);
        break;
    }
    video[record] = status;
    if (status == FOLLOW_FRAGMENT) {
        video[record + 1u] = o_merge(lane, job, 0u);
        video[record + 2u] = q_traced;
    }
    let ended = select(1u, 0u, status == FOLLOW_UNFINISHED);
    scratch[state_at] = vec4<u32>(i, select(0u, 1u, q_suspended), q_traced, ended);
    // A driver that terminates loops early terminates this loop too, and the sum is wrong.
    var passes = 0u;
    for (var k = 0u; k < draw[D_PROOF]; k++) {
        passes += draw[D_PROOF + 1u];
    }
    if (passes != draw[D_PROOF] * draw[D_PROOF + 1u]) {
        atomicAdd(&counts[COUNT_CUT], 1u);
    }
}

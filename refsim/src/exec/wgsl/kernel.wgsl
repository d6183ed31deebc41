// A workgroup draws a tile of 16 x 16 pixels. Each invocation draws a quad: all triangles of the tile, in order.

// Number of fragments by fate: killed, failed the alpha test, failed the depth test, passed.
var<private> k_fates: vec4<u32>;

fn k_count(word: u32, more: u32) {
    let before = atomicAdd(&counts[2u * word], more);
    if (before + more < before) {
        atomicAdd(&counts[2u * word + 1u], 1u);
    }
}

// Loop iterations per group of eight invocations: lavapipe runs eight in lockstep, and counts an iteration if any of
// them makes it. The arrays hold the iterations so far, the triangle (from 1) last charged for, and the most iterations
// that the program used for this triangle.
var<workgroup> k_spent: array<atomic<u32>, 8>;
var<workgroup> k_last: array<atomic<u32>, 8>;
var<workgroup> k_most: array<atomic<u32>, 8>;

@compute @workgroup_size(64)
fn pixel_main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) place: u32) {
    let tile = group.x + group.y * draw[D_GROUPS];
    if (tile >= draw[D_TILES]) {
        return;
    }
    let x = tiles[4u * tile] + 2u * (place & 7u);
    let y = tiles[4u * tile + 1u] + 2u * (place >> 3u);
    let first = tiles[4u * tile + 2u];
    let count = tiles[4u * tile + 3u];
    q_invocation = 64u * tile + place;
    q_stride = draw[D_STRIDE];
    q_rows = draw[D_ROWS];
    q_save = q_rows + IN_OUT_ROWS;
    let passes_left = draw[D_PASSES];
    let cost = draw[D_COST];
    let eight = place >> 3u;
    var looked = 0u;
    let state_at = (q_save + SAVED_ROWS - 1u) * q_stride + q_invocation;
    var i = 0u;
    if (draw[D_RESUMES] == 1u) {
        i = scratch[state_at].x;
        q_suspended = scratch[state_at].y == 1u;
    }
    for (; i < count; i++) {
        looked += LOOK_COST;
        let spent = atomicLoad(&k_spent[eight]) + looked + cost;
        if (spent >= passes_left) {
            break;
        }
        let at = tiles[first + i] * draw[D_SETUP_WORDS];
        q_covered = r_cover(at, x, y);
        if (!any(q_covered)) {
            continue;
        }
        if (atomicExchange(&k_last[eight], i + 1u) != i + 1u) {
            atomicAdd(&k_spent[eight], cost);
            atomicStore(&k_most[eight], 0u);
        }
        q_passes = passes_left - spent;
        r_start(at, x, y);
        q_run = vec4<bool>(true);
        shade();
        let used = passes_left - spent - q_passes;
        let most = atomicMax(&k_most[eight], used);
        atomicAdd(&k_spent[eight], max(used, most) - most);
        if (q_suspended) {
            break;
        }
        for (var lane = 0u; lane < 4u; lane++) {
            if (q_covered[lane]) {
                let fate = o_merge(lane, x + (lane & 1u), y + (lane >> 1u));
                k_fates += select(vec4<u32>(0u), vec4<u32>(1u), vec4<u32>(fate) == vec4<u32>(1u, 2u, 3u, 4u));
            }
        }
    }
    scratch[state_at] = vec4<u32>(i, select(0u, 1u, q_suspended), 0u, 0u);
    if (i < count) {
        atomicAdd(&counts[COUNT_UNFINISHED], 1u);
    }
    // A driver that terminates loops early terminates this loop too, and the sum is wrong.
    var passes = 0u;
    for (var k = 0u; k < draw[D_PROOF]; k++) {
        passes += draw[D_PROOF + 1u];
    }
    if (passes != draw[D_PROOF] * draw[D_PROOF + 1u]) {
        atomicAdd(&counts[COUNT_CUT], 1u);
    }
    // Each pair of words is one count: shaded fragments, unused, the four fates, texture reads by sampler. The atomic
    // operation is at one place only, because drivers compile it to long code.
    for (var k = 0u; k < 22u; k++) {
        var more = 0u;
        if (k == 0u) {
            more = k_fates.x + k_fates.y + k_fates.z + k_fates.w;
        } else if (k >= 6u) {
            more = q_fetched[k - 6u];
        } else if (k >= 2u) {
            more = k_fates[k - 2u];
        }
        if (more != 0u) {
            k_count(k, more);
        }
    }
}

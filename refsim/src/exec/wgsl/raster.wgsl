// Coverage of one quad, and inputs of its interpolation, as refsim::raster defines them.

// Layout of a set-up: three edges of seven words each (a, b, c as pairs, bias), then these fields.
const S_BOUNDS: u32 = 22u;
const S_FLAGS: u32 = 26u;

// Flag: pixel centres are at integers plus one half.
const S_HALF: u32 = 8u;

fn r_inside(edge: vec2<u32>, bias: u32) -> bool {
    return (edge.y >> 31u) == 0u && (bias == 0u || (edge.x | edge.y) != 0u);
}

// Value of an edge function at a pixel.
fn r_edge(start: u32, x: u32, y: u32) -> vec2<u32> {
    let a = vec2<u32>(setups[start], setups[start + 1u]);
    let b = vec2<u32>(setups[start + 2u], setups[start + 3u]);
    let c = vec2<u32>(setups[start + 4u], setups[start + 5u]);
    return k_add(k_add(k_scale(a, x), k_scale(b, y)), c);
}

// Lanes of the quad at (x, y) that a triangle covers.
fn r_cover(at: u32, x: u32, y: u32) -> vec4<bool> {
    let left = x - setups[at + S_BOUNDS];
    let top = y - setups[at + S_BOUNDS + 1u];
    let width = setups[at + S_BOUNDS + 2u];
    let height = setups[at + S_BOUNDS + 3u];
    // Columns and rows before the bounds wrap to large numbers, which are outside too.
    let columns = vec2<bool>(left < width, left + 1u < width);
    let rows = vec2<bool>(top < height, top + 1u < height);
    var covered = vec4<bool>(columns.x && rows.x, columns.y && rows.x, columns.x && rows.y, columns.y && rows.y);
    for (var e = 0u; e < 3u; e++) {
        let start = at + 7u * e;
        let a = vec2<u32>(setups[start], setups[start + 1u]);
        let b = vec2<u32>(setups[start + 2u], setups[start + 3u]);
        let bias = setups[start + 6u];
        let upper = r_edge(start, x, y);
        let lower = k_add(upper, b);
        covered = covered & vec4<bool>(
            r_inside(upper, bias), r_inside(k_add(upper, a), bias), r_inside(lower, bias), r_inside(k_add(lower, a), bias),
        );
    }
    return covered;
}

// Writes the inputs of interpolation in single precision: edge functions at the four lanes, and columns and rows of the
// pixels' centres.
fn r_start(at: u32, x: u32, y: u32) {
    let half = select(0u, 1u, (setups[at + S_FLAGS] & S_HALF) != 0u);
    for (var i = 0u; i < 16u; i++) {
        let lane = i & 3u;
        let column = x + (lane & 1u);
        let row = y + (lane >> 1u);
        let is_edge = i < 8u;
        let twice = vec2<u32>(2u * select(row, column, i < 12u) + half, 0u);
        let single = k_to_single(select(twice, r_edge(at + select(14u, 7u, i < 4u), column, row), is_edge));
        let value = select(single, single - 0x800000u, !is_edge && single != 0u);
        scratch[q_row(select(0xff29u - 2u, ROW_EDGES, is_edge) + (i >> 2u))][lane] = value;
    }
    q_setup = at;
}

// Coverage and interpolation of one quad, step by step as the raster room defines them.

// A set-up: three edges of seven words (a, b, c as pairs, bias), then these.
const S_AREA: u32 = 21u;
const S_BOUNDS: u32 = 22u;
const S_FLAGS: u32 = 26u;
const S_RECIPROCAL: u32 = 27u;
const S_DEPTH: u32 = 30u;
const S_CONSTANT: u32 = 33u;
const S_PLANES: u32 = 35u;

const S_IS_AFFINE: u32 = 1u;
const S_DEPTH_CONSTANT: u32 = 2u;
const S_ALL_CONSTANT: u32 = 4u;
// Set: centres of pixels lie between their corners.
const S_HALF: u32 = 8u;

// The component that is 1 / w; the others of the window position come before it.
const R_RECIPROCAL: u32 = 44u;

// The edge functions at the four lanes.
var<private> r_edge: array<array<vec2<u32>, 4>, 3>;
// Registers of the interpolation's steps.
var<private> r_value: array<vec4<u32>, 16>;

fn r_inside(edge: vec2<u32>, bias: u32) -> bool {
    return (edge.y >> 31u) == 0u && (bias == 0u || (edge.x | edge.y) != 0u);
}

// Which lanes of the quad at (x, y) a triangle covers; leaves the edge functions behind.
fn r_cover(at: u32, x: u32, y: u32) -> vec4<bool> {
    let left = x - setups[at + S_BOUNDS];
    let top = y - setups[at + S_BOUNDS + 1u];
    let width = setups[at + S_BOUNDS + 2u];
    let height = setups[at + S_BOUNDS + 3u];
    // Columns and rows before the bounds wrap to numbers past them.
    let columns = vec2<bool>(left < width, left + 1u < width);
    let rows = vec2<bool>(top < height, top + 1u < height);
    var covered = vec4<bool>(columns.x && rows.x, columns.y && rows.x, columns.x && rows.y, columns.y && rows.y);
    if (!any(covered)) {
        return covered;
    }
    for (var e = 0u; e < 3u; e++) {
        let start = at + 7u * e;
        let a = vec2<u32>(setups[start], setups[start + 1u]);
        let b = vec2<u32>(setups[start + 2u], setups[start + 3u]);
        let c = vec2<u32>(setups[start + 4u], setups[start + 5u]);
        let bias = setups[start + 6u];
        var row = k_add(k_add(k_scale(a, x), k_scale(b, y)), c);
        for (var r = 0u; r < 4u; r += 2u) {
            let next = k_add(row, a);
            r_edge[e][r] = row;
            r_edge[e][r + 1u] = next;
            covered[r] = covered[r] && r_inside(row, bias);
            covered[r + 1u] = covered[r + 1u] && r_inside(next, bias);
            row = k_add(row, b);
        }
    }
    return covered;
}

// Steps from one to another of the table in the draw: code, result, operands, format.
fn r_run(first: u32, end: u32) {
    for (var s = first; s < end; s++) {
        let step = draw[D_STEPS + s];
        let a = r_value[(step >> 12u) & 15u];
        let b = r_value[(step >> 16u) & 15u];
        var result: vec4<u32>;
        for (var lane = 0u; lane < 4u; lane++) {
            result[lane] = n_alu(step & 255u, format(step >> 20u), a[lane], b[lane], 0u);
        }
        r_value[(step >> 8u) & 15u] = result;
    }
}

// Plane `at` into the registers of base and differences.
fn r_plane(at: u32) {
    r_value[6] = vec4<u32>(setups[at]);
    r_value[7] = vec4<u32>(setups[at + 1u]);
    r_value[8] = vec4<u32>(setups[at + 2u]);
}

// Columns or rows of a quad's pixels as single precision, at their centres.
fn r_centers(first: u32, steps: vec4<u32>, half: u32) -> vec4<u32> {
    var result: vec4<u32>;
    for (var lane = 0u; lane < 4u; lane++) {
        let doubled = k_to_single(vec2<u32>(2u * (first + steps[lane]) + half, 0u));
        result[lane] = select(doubled - 0x800000u, 0u, doubled == 0u);
    }
    return result;
}

// Depth and the components of the draw for a quad whose edge functions are known. All steps run at one place, since
// each place costs a copy of the arithmetic.
fn r_interpolate(at: u32, x: u32, y: u32) {
    let flags = setups[at + S_FLAGS];
    let affine = (flags & S_IS_AFFINE) != 0u;
    let count = draw[D_COMPONENTS];
    let start = select(0u, 2u, (flags & S_ALL_CONSTANT) != 0u);
    for (var item = start; item < 3u + count; item++) {
        var first = 0u;
        var end = 0u;
        var component = 0u;
        switch item {
            case 0u: {
                for (var lane = 0u; lane < 4u; lane++) {
                    r_value[0][lane] = k_to_single(r_edge[1][lane]);
                    r_value[1][lane] = k_to_single(r_edge[2][lane]);
                }
                r_value[9] = vec4<u32>(setups[at + S_AREA]);
                r_value[10] = vec4<u32>(0x3f800000u);
                for (var i = 0u; i < 3u; i++) {
                    r_value[11u + i] = vec4<u32>(setups[at + S_RECIPROCAL + i]);
                }
                end = select(STEPS_LINEAR + STEPS_PERSPECTIVE, STEPS_LINEAR, affine);
            }
            case 1u: {
                if (affine) {
                    r_value[2] = r_value[0];
                    r_value[3] = r_value[1];
                }
                r_value[4] = r_value[2];
                r_value[5] = r_value[3];
                // The formats that conversions come from, as N_CONVERT takes them.
                r_value[11] = vec4<u32>(0u);
                r_value[12] = vec4<u32>(draw[D_CONVERTS + 2u]);
                first = STEPS_LINEAR + STEPS_PERSPECTIVE;
                end = first + draw[D_CONVERTS];
            }
            case 2u: {
                r_plane(at + S_DEPTH);
                r_value[14] = r_value[6];
                first = STEPS_DEPTH;
                end = select(STEPS_DEPTH + 4u, STEPS_DEPTH, (flags & S_DEPTH_CONSTANT) != 0u);
            }
            default: {
                let k = item - 3u;
                component = draw[D_COMPONENTS + 1u + k];
                r_plane(at + S_PLANES + 3u * k);
                r_value[14] = r_value[6];
                let constant = (setups[at + S_CONSTANT + (component >> 5u)] >> (component & 31u)) & 1u;
                first = STEPS_COMPONENT;
                end = STEPS_COMPONENT + 4u + draw[D_CONVERTS_BACK];
                if (component == R_RECIPROCAL) {
                    // Along the screen, in single precision, like depth.
                    first = STEPS_DEPTH;
                    end = STEPS_DEPTH + 4u;
                }
                end = select(end, first, constant == 1u);
            }
        }
        r_run(first, end);
        if (component == R_RECIPROCAL) {
            let half = select(0u, 1u, (flags & S_HALF) != 0u);
            q_input[R_RECIPROCAL - 3u] = r_centers(x, vec4<u32>(0u, 1u, 0u, 1u), half);
            q_input[R_RECIPROCAL - 2u] = r_centers(y, vec4<u32>(0u, 0u, 1u, 1u), half);
            q_input[R_RECIPROCAL - 1u] = q_depth;
        }
        if (item == 2u) {
            q_depth = r_value[14];
        } else if (item > 2u) {
            q_input[component] = r_value[14];
        }
    }
}

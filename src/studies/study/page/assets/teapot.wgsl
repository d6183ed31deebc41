// Rays against triangles: the machine runs the Ray Engine's pixel program once per triangle of a bucket and quad of
// pixels, and keeps the nearest depth. The page's script computes geometry set-up and ray textures.

// Words of `draw`, after the tables of formats: quads, width in quads, first row of inputs and outputs in `scratch`,
// width in buckets, words per triangle of `setups`, 1 if depth is a float, first word of results and number of pixels in
// `video`, triangles of a bucket to draw (first and number), then the input components, in the order of `setups`.
const P_QUADS: u32 = 128u;
const P_COLUMNS: u32 = 129u;
const P_ROWS: u32 = 130u;
const P_BUCKETS: u32 = 131u;
const P_INPUTS: u32 = 132u;
const P_FLOAT_DEPTH: u32 = 133u;
const P_RESULTS: u32 = 134u;
const P_PIXELS: u32 = 135u;
const P_FIRST: u32 = 136u;
const P_COUNT: u32 = 137u;
const P_CODES: u32 = 138u;
const P_COMPONENTS: u32 = 140u;
// Pixels of a bucket along each side, and words of ray textures per pixel: four for each of three samplers.
const BUCKET: u32 = 32u;
const RAY_WORDS: u32 = 12u;

var<private> p_pixels: vec4<u32>;

// A ray texture's texel, in the register format.
fn texture_read(sampler_number: u32, detail: u32, lanes: vec4<bool>) {
    for (var lane = 0u; lane < 4u; lane++) {
        for (var c = 0u; c < 4u; c++) {
            texture_result(c, lane, video[RAY_WORDS * p_pixels[lane] + 4u * sampler_number + c]);
        }
    }
}

// The depth buffer's code: 24 bits, or single precision. NaN and negative numbers are 0.
fn stored_depth(raw: u32) -> u32 {
    let main = format_of_draw(MAIN);
    if (draw[P_FLOAT_DEPTH] == 1u) {
        return select(min(raw, 0x3f800000u), 0u, (raw >> 31u) == 1u || n_is_nan(main, raw));
    }
    return n_step(n_unpack(main.kind, main.frac, raw), 0xffffffu);
}

@compute @workgroup_size(64)
fn trace_main(@builtin(global_invocation_id) place: vec3<u32>) {
    let quad = place.x;
    if (quad >= draw[P_QUADS]) {
        return;
    }
    q_invocation = quad;
    q_stride = draw[P_QUADS];
    q_rows = draw[P_ROWS];
    q_code = 0u;
    q_covered = vec4<bool>(true);
    q_run = vec4<bool>(true);
    let columns = draw[P_COLUMNS];
    let x = 2u * (quad % columns);
    let y = 2u * (quad / columns);
    p_pixels = vec4<u32>(0u, 1u, 2u * columns, 2u * columns + 1u) + vec4<u32>(2u * columns * y + x);
    let bucket = 2u * ((y / BUCKET) * draw[P_BUCKETS] + x / BUCKET);
    let first = draw[P_FIRST];
    let end = min(tiles[bucket + 1u], first + draw[P_COUNT]);
    let results = draw[P_RESULTS];
    let depths = results + draw[P_PIXELS];
    let main = format_of_draw(MAIN);
    for (var i = first; i < end; i++) {
        let triangle = tiles[tiles[bucket] + i];
        let inputs = draw[P_INPUTS];
        for (var k = 0u; k < inputs; k++) {
            scratch[q_row(0xff00u + draw[P_COMPONENTS + k])] = vec4<u32>(setups[triangle * inputs + k]);
        }
        shade();
        let killed = scratch[q_row(ROW_KILLED)];
        let alpha = scratch[q_row(ROW_COLORS + 3u)];
        let depth = scratch[q_row(ROW_DEPTH)];
        for (var lane = 0u; lane < 4u; lane++) {
            let lives = killed[lane] == 0u && n_key(main, alpha[lane]) > 0 && !n_is_nan(main, alpha[lane]);
            let stored = stored_depth(depth[lane]);
            if (lives && stored < video[depths + p_pixels[lane]]) {
                video[depths + p_pixels[lane]] = stored;
                video[results + p_pixels[lane]] = triangle;
            }
        }
    }
}

// Ray textures in the register format: signed 16-bit codes as fractions of 32767, or single precision.
@compute @workgroup_size(64)
fn rays_main(@builtin(global_invocation_id) place: vec3<u32>) {
    if (place.x >= RAY_WORDS * draw[P_PIXELS]) {
        return;
    }
    let main = format_of_draw(MAIN);
    let code = video[place.x];
    if (draw[P_CODES] == 1u) {
        var x = n_whole(select(code, 0u - code, (code >> 31u) == 1u));
        x.sign = code >> 31u;
        video[place.x] = n_finish(main, n_quotient(N_DIV, main, x, n_whole(32767u)));
    } else {
        video[place.x] = n_alu(N_CONVERT, main, code, 0u, 0u);
    }
}

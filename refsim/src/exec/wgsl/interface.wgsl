// Declarations shared by all parts of a pixel module: bindings, number formats, variables of kernel and program.
//
// A quad's values are rows of four lanes: (0, 0), (1, 0), (0, 1), (1, 1). Values are "raw": a fixed-point number is a
// sign-extended integer; a float of any format is the single-precision pattern of the same number, and 0x7fc00000 is
// the only NaN.

@group(0) @binding(0) var<storage, read> draw: array<u32>;
@group(0) @binding(1) var<storage, read> setups: array<u32>;
@group(0) @binding(2) var<storage, read> tiles: array<u32>;
@group(0) @binding(3) var<storage, read> samplers: array<u32>;
@group(0) @binding(4) var<storage, read_write> video: array<u32>;
@group(0) @binding(5) var<storage, read> code: array<u32>;
@group(0) @binding(6) var<storage, read_write> scratch: array<vec4<u32>>;
@group(0) @binding(7) var<storage, read_write> counts: array<atomic<u32>>;

const MAIN: u32 = 0u;
const PARTIAL: u32 = 1u;
const SINGLE: u32 = 2u;
const WRAPPED: u32 = 3u;
const ITERATOR: u32 = 4u;

// The format with an index from above. Indices from 5 on are formats of target channels; 9 and 10 are half and fixed
// precision of OpenGL's programs; indices from 11 on are formats of single instructions.
fn format_of_draw(k: u32) -> Format {
    let at = 8u * k;
    return Format(
        draw[at], draw[at + 1u], draw[at + 2u], draw[at + 3u],
        draw[at + 4u], draw[at + 5u], draw[at + 6u], draw[at + 7u],
    );
}

// A format of the program. If all are FP32 with default rules, it is a constant, so that compilers can simplify.
fn format(k: u32) -> Format {
    if (HAS_FORMATS) {
        return format_of_draw(k);
    }
    return N_FP32;
}

// Rows of four lanes in `scratch`: the program's registers by slot, then, as operands from 0xff00 on, inputs and
// outputs. Inputs: components in single precision by number (0 to 31 coordinates, 32 to 39 colours, 40 fog, 41 to 44
// window position), and edge functions 1 and 2, from which the program interpolates all inputs except column and row.
// Outputs: colours of four targets in the main format, masks of killed lanes, depth, masks of lanes whose depth is in
// the main format and not single.
const ROW_EDGES: u32 = 0xff2du;
const ROW_COLORS: u32 = 0xff2fu;
const ROW_KILLED: u32 = 0xff3fu;
const ROW_DEPTH: u32 = 0xff40u;
const ROW_DEPTH_IS_MAIN: u32 = 0xff41u;
var<private> q_invocation: u32;
var<private> q_stride: u32;
// First row of inputs and outputs, and first row of the state that a suspended program saves.
var<private> q_rows: u32;
var<private> q_save: u32;

fn q_row(operand: u32) -> u32 {
    return select(operand, q_rows + operand - 0xff00u, operand >= 0xff00u) * q_stride + q_invocation;
}

// First word of the triangle's set-up; the lanes that run (all four if any is covered); the lanes that are fragments.
var<private> q_setup: u32;
var<private> q_run: vec4<bool>;
var<private> q_covered: vec4<bool>;
// Approximate number of loop iterations left for the invocation in this dispatch: no dispatch may run for seconds, and
// lavapipe terminates all loops of an invocation after 65,535 iterations. A program that has used them up saves its
// state, sets `q_suspended` and returns; the next call resumes it.
var<private> q_passes: u32;
var<private> q_suspended: bool;
// Index in `code` of the program's first word.
var<private> q_code: u32;
// The traced lane, counted from 1, or 0 for none; and the number of words recorded for it.
var<private> q_trace: u32;
var<private> q_traced: u32;

// Index in `code` of the texture read being executed.
var<private> q_read: u32;
// Texture reads of covered lanes by sampler; the kernel clears these counts and sums them.
var<private> q_fetched: array<u32, 16>;

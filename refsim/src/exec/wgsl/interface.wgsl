// What the parts of a pixel module share: bindings, number formats, and the variables between kernel and program.
//
// A quad's values are rows of four lanes: (0, 0), (1, 0), (0, 1), (1, 1). A value is "raw": in fixed point the number
// as a sign-extended integer, in floating point of whatever width the single precision pattern of its exact value, with
// 0x7fc00000 as the only NaN.

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

// The format of an index above; from 5 on those of targets' channels, 9 and 10 the half and fixed precision of OpenGL's
// programs, from 11 on those of single instructions.
fn format_of_draw(k: u32) -> Format {
    let at = 8u * k;
    return Format(
        draw[at], draw[at + 1u], draw[at + 2u], draw[at + 3u],
        draw[at + 4u], draw[at + 5u], draw[at + 6u], draw[at + 7u],
    );
}

// A format of the program, which may be one that compilers know.
fn format(k: u32) -> Format {
    if (HAS_FORMATS) {
        return format_of_draw(k);
    }
    return N_FP32;
}

// Rows of four lanes in `scratch`: those of the program's registers by their slots, then from operand 0xff00 on what
// goes in and out. In: components in single precision by their number (0 to 31 coordinates, 32 to 39 colours, 40 fog,
// 41 to 44 window position), edge functions 1 and 2, from which the program interpolates all but columns and rows. Out:
// colours of four targets in the main format, masks of killed lanes, depth, masks of lanes whose depth is in the main
// format, not single.
const ROW_EDGES: u32 = 0xff2du;
const ROW_COLORS: u32 = 0xff2fu;
const ROW_KILLED: u32 = 0xff3fu;
const ROW_DEPTH: u32 = 0xff40u;
const ROW_DEPTH_IS_MAIN: u32 = 0xff41u;
var<private> q_invocation: u32;
var<private> q_stride: u32;
// Where the second part begins, and where the program puts what it needs to go on.
var<private> q_rows: u32;
var<private> q_save: u32;

fn q_row(operand: u32) -> u32 {
    return select(operand, q_rows + operand - 0xff00u, operand >= 0xff00u) * q_stride + q_invocation;
}

// The first word of the triangle's set-up; the lanes that run (a quad with a covered lane runs whole) and those that
// are fragments.
var<private> q_setup: u32;
var<private> q_run: vec4<bool>;
var<private> q_covered: vec4<bool>;
// Loop passes, about, that the invocation may still make in this dispatch: no dispatch shall run for seconds, and
// lavapipe ends all loops of an invocation after 65,535 passes. A program that runs out of them puts its state down,
// says so and returns;
// called again, it goes on.
var<private> q_passes: u32;
var<private> q_suspended: bool;
// Where the program's words begin in `code`.
var<private> q_code: u32;
// The lane that is followed, counted from 1; 0 for none. And how many words were put down about it.
var<private> q_trace: u32;
var<private> q_traced: u32;

// The word of the texture read at work.
var<private> q_read: u32;
// Texture reads of covered lanes by sampler; the kernel clears and adds up.
var<private> q_fetched: array<u32, 16>;

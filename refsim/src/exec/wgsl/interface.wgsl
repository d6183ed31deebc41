// What the parts of a pixel module share: bindings, number formats, and the variables between kernel and program.
//
// A quad's values are rows of four lanes: (0, 0), (1, 0), (0, 1), (1, 1). A value is "raw": in fixed point the number as a
// sign-extended integer, in floating point of whatever width the single precision pattern of its exact value, with
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

// The format of an index above; from 5 on those of the draw's own, 9 and 10 the half and fixed precision of OpenGL's programs.
fn format(k: u32) -> Format {
    let at = 8u * k;
    return Format(
        draw[at], draw[at + 1u], draw[at + 2u], draw[at + 3u],
        draw[at + 4u], draw[at + 5u], draw[at + 6u], draw[at + 7u],
    );
}

// Given to the program: components in single precision by their number (0 to 31 coordinates, 32 to 39 colours, 40 fog, 41 to 44 window
// position),
// the lanes that run (a quad with a covered lane runs whole) and those that are fragments.
var<private> q_input: array<vec4<u32>, 45>;
var<private> q_run: vec4<bool>;
var<private> q_covered: vec4<bool>;
// Where the program's registers lie: value `slot` at scratch[slot * q_stride + q_invocation].
var<private> q_invocation: u32;
var<private> q_stride: u32;
// Loop passes, about, that the invocation may still make in this dispatch: no dispatch shall run for seconds, and lavapipe ends
// all loops of an invocation after 65,535 passes. A program that runs out of them puts its state down in `scratch` from row
// `q_save` on, says so and returns; called again, it goes on.
var<private> q_passes: u32;
var<private> q_save: u32;
var<private> q_suspended: bool;
// Whether the steps of each lane are counted, how many it may make, and which lanes were cut off in front of one more.
var<private> q_counts_steps: bool;
var<private> q_step_budget: u32;
var<private> q_cut: vec4<bool>;
// Where the program's words begin in `code`.
var<private> q_code: u32;
// The lane that is followed, counted from 1; 0 for none. And how many words were put down about it.
var<private> q_trace: u32;
var<private> q_traced: u32;

// Left by the program. Colours in the main format. Depth is the interpolated one in single precision before the program
// runs; a program that decides depth in the main format says so lane by lane.
var<private> q_color: array<array<vec4<u32>, 4>, 4>;
var<private> q_depth: vec4<u32>;
var<private> q_depth_is_main: vec4<bool>;
var<private> q_killed: vec4<bool>;
// Texture reads of covered lanes by sampler; the kernel clears and adds up.
var<private> q_fetched: array<u32, 16>;
// Instruction slots executed by covered lanes.
var<private> q_executed: u32;

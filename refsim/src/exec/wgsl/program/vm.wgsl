// The virtual machine, which runs programs given as words, so that arithmetic is compiled only once. Arms of operations
// that a draw's programs don't use are removed from the text (parts.rs).
//
// The words of a program start at code[q_code]: first word, first constant, first word of interpolation (offsets from
// q_code). Operands are slots below 0x8000, constants below 0xfe00, words of the triangle's set-up below 0xff00, then
// input components. program/microcode.rs encodes these words.

// Unrounded results of long operations by lane, and a flag that the next operation uses them. They are rows of words,
// not an array of structures, because CPU drivers would access each word of each lane separately.
var<private> vm_known: vec4<bool>;
var<private> vm_raw: vec4<u32>;
var<private> vm_sign: vec4<u32>;
var<private> vm_exp: vec4<i32>;
var<private> vm_high: vec4<u32>;
var<private> vm_middle: vec4<u32>;
var<private> vm_low: vec4<u32>;
var<private> vm_prepared: bool;

fn vm_keep(lane: u32, x: Real) {
    vm_known[lane] = x.known;
    vm_raw[lane] = x.raw;
    vm_sign[lane] = x.sign;
    vm_exp[lane] = x.exp;
    vm_high[lane] = x.m.x;
    vm_middle[lane] = x.m.y;
    vm_low[lane] = x.m.z;
}

fn vm_kept(lane: u32) -> Real {
    let m = vec3<u32>(vm_high[lane], vm_middle[lane], vm_low[lane]);
    return Real(vm_known[lane], vm_raw[lane], vm_sign[lane], vm_exp[lane], m);
}

// Value of an operand in every lane. It is called at few places, because most drivers copy its text to each call.
fn vm_row(operand: u32) -> vec4<u32> {
    var value: vec4<u32>;
    if (operand < 0x8000u || operand >= 0xff00u) {
        value = scratch[q_row(operand)];
    } else if (operand < 0xfe00u) {
        value = vec4<u32>(code[q_code + code[q_code + 1u] + operand - 0x8000u]);
    } else {
        value = vec4<u32>(setups[q_setup + operand - 0xfe00u]);
    }
    return value;
}

// Value of an operand in a lane.
fn vm_read(operand: u32, lane: u32) -> u32 {
    return vm_row(operand)[lane];
}

// Operand `number` of an instruction; a word holds two, the lower half first.
fn vm_operand(at: u32, number: u32) -> u32 {
    return (code[at + number / 2u] >> (16u * (number & 1u))) & 0xffffu;
}

fn vm_bits(mask: vec4<bool>) -> u32 {
    let bits = select(vec4<u32>(0u), vec4<u32>(1u, 2u, 4u, 8u), mask);
    return bits.x | bits.y | bits.z | bits.w;
}

// Interface of the texture library, for the read at word `q_read`: coordinates, then a bias or gradients (x, y, z, w
// along x, then along y); and destinations of a texel's components.
fn texture_operand(number: u32, lane: u32) -> u32 {
    return vm_read(vm_operand(q_read + 1u + select(0u, 2u, number >= 4u), number), lane);
}

fn texture_result(component: u32, lane: u32, value: u32) {
    let to = vm_operand(q_read + 3u, component);
    if (to != 0xffffu) {
        scratch[q_row(to)][lane] = value;
    }
}

// Records what an instruction wrote in the traced lane: its index, the components written, their values.
fn vm_trace(at: u32) {
    if (q_trace == 0u) {
        return;
    }
    trace_put(q_traced, code[at + 1u]);
    trace_put(q_traced + 1u, (code[at] >> 16u) & 15u);
    for (var i = 0u; i < 4u; i += 1u) {
        let operand = vm_operand(at + 2u, i);
        var value = 0u;
        if (operand != 0xffffu) {
            value = vm_read(operand, q_trace - 1u);
        }
        trace_put(q_traced + 2u + i, value);
    }
    q_traced += 6u;
}

// Computes the unrounded result of a long operation on two operands, or of a sum of up to four products.
fn vm_prepare(op: u32, word: u32, at: u32) {
    let f = format(word >> 24u);
    let operation = (word >> 16u) & 255u;
    var terms = 1u;
    if (HAS_DOTS) {
        terms = select(1u, operation, op == VM_DOT);
    }
    var left: array<vec4<u32>, 4>;
    var right: array<vec4<u32>, 4>;
    for (var k = 0u; k < terms; k += 1u) {
        left[k] = vm_row(vm_operand(at + 1u, 2u * k + 1u));
        right[k] = vm_row(vm_operand(at + 1u, 2u * k + 2u));
    }
    for (var lane = 0u; lane < 4u; lane += 1u) {
        let a = vec4<u32>(left[0][lane], left[1][lane], left[2][lane], left[3][lane]);
        let b = vec4<u32>(right[0][lane], right[1][lane], right[2][lane], right[3][lane]);
        var exact: Real;
        switch op {
            case VM_DOT: { exact = n_dot(f, operation, a, b); }
            default: { exact = n_long(operation, f, a.x, b.x); }
        }
        vm_keep(lane, exact);
    }
    vm_prepared = true;
}
fn vm_sum(word: u32, at: u32) {
    // A sum computed by one adder: result, four operands. The word holds the number of aligned terms and of kept bits;
    // without terms, this is a multiply-add with a truncated product. For the place of this comment see n_cut_sum.
    let f = format(word >> 24u);
    let terms = (word >> 16u) & 7u;
    let bits = (word >> 19u) & 31u;
    var rows: array<vec4<u32>, 4>;
    for (var k = 0u; k < 4u; k += 1u) {
        rows[k] = vm_row(vm_operand(at + 1u, k + 1u));
    }
    var result: vec4<u32>;
    for (var lane = 0u; lane < 4u; lane += 1u) {
        let x = vec4<u32>(rows[0][lane], rows[1][lane], rows[2][lane], rows[3][lane]);
        var exact: Real;
        if (terms == 0u) {
            let a = n_unpack(f.kind, f.frac, x.x);
            exact = n_cut_sum(f, a, n_unpack(f.kind, f.frac, x.y), n_unpack(f.kind, f.frac, x.z));
        } else {
            exact = n_aligned(f, terms, bits, x);
        }
        result[lane] = n_finish(f, exact);
    }
    scratch[q_row(vm_operand(at + 1u, 0u))] = result;
}

// Computes an operation lane by lane: result, up to three operands.
fn vm_compute(op: u32, word: u32, at: u32) {
    let f = format(word >> 24u);
    let operation = (word >> 16u) & 255u;
    // Differences within the quad: 1 is right minus left neighbour, 2 is lower minus upper.
    let other = (word >> 12u) & 3u;
    // One call in a loop instead of three calls: this halves the compile time. An array would be slower to compile than
    // moving the rows.
    var first: vec4<u32>;
    var second: vec4<u32>;
    var third: vec4<u32>;
    for (var k = 1u; k < 4u; k += 1u) {
        first = second;
        second = third;
        third = vm_row(vm_operand(at + 1u, k));
    }
    var result = first;
    switch op {
        case VM_COPY: {}
        case VM_AND: { result = first & second; }
        case VM_OR: { result = first | second; }
        case VM_AND_NOT: { result = second & ~first; }
        case VM_SELECT: { result = (first & second) | (~first & third); }
        default: {
            for (var lane = 0u; lane < 4u; lane += 1u) {
                var exact = vm_kept(lane);
                if (!vm_prepared) {
                    exact = n_short(operation, f, first[lane | other], second[lane & ~other], third[lane]);
                }
                result[lane] = n_result(operation, f, exact);
            }
            vm_prepared = false;
        }
    }
    scratch[q_row(vm_operand(at + 1u, 0u))] = result;
}

// Maximum number of loop iterations of an instruction, by the class in its word.
fn vm_cost(word: u32) -> u32 {
    return vec4<u32>(20u, 600u, 1000u, 8000u)[(word >> 14u) & 3u];
}

// Index in `scratch` at which a suspended program saves the offset of its next instruction.
fn vm_saved() -> u32 {
    return q_save * q_stride + q_invocation;
}

// Interpolates and runs the program. Loops are nested because CPU drivers have no branches: every iteration executes
// the whole text of the loop's body and discards most of the results. So the innermost loop contains the most frequent
// operations, and the text for texture reads runs only once per texture read.
fn shade() {
    var next = code[q_code + 2u];
    vm_prepared = false;
    loop {
        var at: u32;
        var word: u32;
        var op: u32;
        loop {
            loop {
                at = q_code + next;
                word = code[at];
                op = word & 0xffu;
                let is_long = (op == VM_DOT || op == VM_LONG) && !vm_prepared;
                if (HAS_SUSPENSION) {
                    let cost = vm_cost(word);
                    // The cost of a triangle includes interpolation, so only the program is charged here.
                    if (!vm_prepared && next < code[q_code + 2u]) {
                        if (q_passes < cost) {
                            q_suspended = true;
                            scratch[vm_saved()].x = next;
                            return;
                        }
                        q_passes -= cost;
                    }
                }
                var is_short = !is_long;
                switch select(op, VM_END, is_long) {
                    case VM_ALU, VM_LONG, VM_DOT, VM_COPY, VM_AND, VM_OR, VM_AND_NOT, VM_SELECT: {
                        vm_compute(op, word, at);
                        next += select(3u, 6u, op == VM_DOT);
                    }
                    case VM_UNLESS: { // jumps if a bit of a set-up word is 1
                        let bits = setups[q_setup + (word >> 16u)];
                        next = select(next + 2u, code[at + 1u], ((bits >> ((word >> 8u) & 31u)) & 1u) == 1u);
                    }
                    default: { is_short = false; }
                }
                if (!is_short) {
                    break;
                }
            }
            if (op != VM_DOT && op != VM_LONG) {
                break;
            }
            vm_prepare(op, word, at);
        }
        switch op {
            case VM_ENTER: { // the program begins or resumes
                next = code[q_code];
                if (HAS_SUSPENSION) {
                    if (q_suspended) {
                        q_suspended = false;
                        next = scratch[vm_saved()].x;
                    }
                }
            }
            case VM_FETCH: { // a texture read: sampler, detail
                q_read = at;
                texture_read((word >> 16u) & 0xffu, word >> 24u, q_run);
                next += 5u + select(word >> 24u, 4u, word >> 24u == 2u);
            }
            case VM_FETCHED: { // counts texture reads of covered lanes
                q_fetched[word >> 16u] += code[at + 1u] * countOneBits(vm_bits(q_covered));
                next += 2u;
            }
            case VM_SUM: { // a sum computed by one adder
                vm_sum(word, at);
                next += 4u;
            }
            case VM_ZERO: { // zeros in consecutive slots
                for (var i = 0u; i < code[at + 2u]; i += 1u) {
                    scratch[q_row(code[at + 1u] + i)] = vec4<u32>(0u);
                }
                next += 3u;
            }
            case VM_TRACE: {
                vm_trace(at);
                next += 4u;
            }
            default: {
                return;
            }
        }
    }
}

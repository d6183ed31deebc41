// The machine that runs programs given as words, so that arithmetic is compiled once, at one place. Arms of operations
// that the programs of a draw don't use are left out of the text (parts.rs).
//
// The words of a program start at code[q_code]: first word, word of the end, constants, table of the float constants
// and their number, first slot of the frames, number of slots, first word of interpolation (offsets count from q_code).
// Operands are slots below 0x8000, constants below 0xfe00, words of the triangle's set-up below 0xff00, then input
// components. program/microcode.rs writes what this reads.


var<private> vm_active: u32;
var<private> vm_depth: u32;
var<private> vm_counter: u32;
// Steps of each lane.
var<private> vm_steps: vec4<u32>;

// What long operations come to before their rounding, lane by lane, and whether the next operation finds it there. Rows
// of words, not an array of structures, in which drivers of processors would reach for each word of each lane alone.
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

// The value of an operand in every lane. There are few calls, since each is a copy of the text for most drivers.
fn vm_row(operand: u32) -> vec4<u32> {
    var value: vec4<u32>;
    if (operand < 0x8000u || operand >= 0xff00u) {
        value = scratch[q_row(operand)];
    } else if (operand < 0xfe00u) {
        value = vec4<u32>(code[q_code + code[q_code + 2u] + operand - 0x8000u]);
    } else {
        value = vec4<u32>(setups[q_setup + operand - 0xfe00u]);
    }
    return value;
}

// The value of an operand in a lane.
fn vm_read(operand: u32, lane: u32) -> u32 {
    return vm_row(operand)[lane];
}

// The operand in a half of a word: the lower one is number 0.
fn vm_operand(at: u32, number: u32) -> u32 {
    return (code[at + number / 2u] >> (16u * (number & 1u))) & 0xffffu;
}

// The lanes in which an operand is not zero.
fn vm_lanes(operand: u32) -> u32 {
    return vm_bits(vm_row(operand) != vec4<u32>(0u));
}

fn vm_bits(mask: vec4<bool>) -> u32 {
    let bits = select(vec4<u32>(0u), vec4<u32>(1u, 2u, 4u, 8u), mask);
    return bits.x | bits.y | bits.z | bits.w;
}

fn vm_mask(bits: u32) -> vec4<bool> {
    return (vec4<u32>(bits) & vec4<u32>(1u, 2u, 4u, 8u)) != vec4<u32>(0u);
}

// Slot 0 is the mask of active lanes.
fn vm_activate(bits: u32) {
    vm_active = bits;
    scratch[q_row(0u)] = select(vec4<u32>(0u), vec4<u32>(0xffffffffu), vm_mask(bits));
}

// Slot 3 is the loop counter.
fn vm_count(counter: u32) {
    vm_counter = counter;
    scratch[q_row(3u)] = vec4<u32>(counter);
}

// A frame is two rows: kind, lanes to run afterwards, lanes of `else` or still in the loop, passes left or way back;
// then of loops what the counter grows by and what it was.
fn vm_frame(number: u32) -> u32 {
    return (code[q_code + 5u] + 2u * number) * q_stride + q_invocation;
}

fn vm_push(first: vec4<u32>, second: vec4<u32>) {
    let at = vm_frame(vm_depth);
    scratch[at] = first;
    scratch[at + q_stride] = second;
    vm_depth += 1u;
}

// Takes lanes out of everything up to and including the innermost loop's passes.
fn vm_leave_loop(lanes: u32) {
    var inside = false;
    for (var i = vm_depth; i > 0u; i -= 1u) {
        let kind = scratch[vm_frame(i - 1u)].x;
        inside = kind == VM_LOOP;
        if (kind != VM_IF) {
            break;
        }
    }
    if (!inside) {
        return;
    }
    vm_activate(vm_active & ~lanes);
    for (var i = vm_depth; i > 0u; i -= 1u) {
        let at = vm_frame(i - 1u);
        var frame = scratch[at];
        frame.z &= ~lanes;
        if (frame.x == VM_IF) {
            frame.y &= ~lanes;
        }
        scratch[at] = frame;
        if (frame.x == VM_LOOP) {
            break;
        }
    }
}

// Counts a step for every active lane, and cuts off the lanes that have none left.
fn vm_charge() {
    let lanes = vm_mask(vm_active);
    let spent = lanes & (vm_steps == vec4<u32>(q_step_budget));
    vm_steps += select(vec4<u32>(0u), vec4<u32>(1u), lanes & !spent);
    if (!any(spent)) {
        return;
    }
    q_cut |= spent;
    let cut = vm_bits(spent);
    vm_activate(vm_active & ~cut);
    for (var i = 0u; i < vm_depth; i += 1u) {
        let at = vm_frame(i);
        var frame = scratch[at];
        frame.y &= ~cut;
        frame.z &= ~cut;
        scratch[at] = frame;
    }
}

// The active lanes are done with the subroutine, or with the program, in the middle of a block.
fn vm_retire() {
    let done = vm_active;
    vm_activate(0u);
    for (var i = vm_depth; i > 0u; i -= 1u) {
        let at = vm_frame(i - 1u);
        var frame = scratch[at];
        if (frame.x == VM_CALL) {
            break;
        }
        frame.y &= ~done;
        frame.z &= ~done;
        scratch[at] = frame;
    }
}

// Ends the innermost subroutine: where its caller goes on; the end of the program if there is none.
fn vm_return() -> u32 {
    while (vm_depth > 0u) {
        vm_depth -= 1u;
        let frame = scratch[vm_frame(vm_depth)];
        if (frame.x == VM_CALL) {
            vm_activate(frame.y);
            return frame.w;
        }
    }
    return code[q_code + 1u];
}

// Flow control; `at` is the word of the instruction. Returns where the program goes on, from q_code.
fn vm_flow(op: u32, at: u32, next: u32) -> u32 {
    let target_word = code[at + 1u];
    var lanes = 0u;
    switch op {
        case VM_IF, VM_BREAK, VM_CALL: { lanes = vm_lanes(code[at + 2u]); }
        default: {}
    }
    switch op {
        case VM_IF: { // if
            vm_push(vec4<u32>(VM_IF, vm_active, vm_active & ~lanes, 0u), vec4<u32>(0u));
            vm_activate(lanes);
            return select(target_word, next, lanes != 0u);
        }
        case VM_ELSE: { // else
            if (vm_depth > 0u) {
                let frame = scratch[vm_frame(vm_depth - 1u)];
                if (frame.x == VM_IF) {
                    vm_activate(frame.z);
                }
            }
            return select(target_word, next, vm_active != 0u);
        }
        case VM_END_IF: { // endif
            if (vm_depth > 0u) {
                let frame = scratch[vm_frame(vm_depth - 1u)];
                if (frame.x == VM_IF) {
                    vm_activate(frame.y);
                    vm_depth -= 1u;
                }
            }
            return next;
        }
        case VM_LOOP: { // rep, loop: target past the end, passes, start, step, whether it counts
            let passes = code[at + 2u];
            if (passes == 0u || vm_active == 0u) {
                return target_word;
            }
            vm_push(vec4<u32>(VM_LOOP, vm_active, vm_active, passes), vec4<u32>(code[at + 4u], vm_counter, 0u, 0u));
            if (code[at + 5u] != 0u) {
                vm_count(code[at + 3u]);
            }
            return next;
        }
        case VM_END_LOOP: { // endrep, endloop
            if (vm_depth == 0u) {
                return next;
            }
            let place = vm_frame(vm_depth - 1u);
            var frame = scratch[place];
            let second = scratch[place + q_stride];
            if (frame.x != VM_LOOP) {
                return next;
            }
            frame.w -= 1u;
            if (frame.w > 0u && frame.z != 0u) {
                scratch[place] = frame;
                vm_activate(frame.z);
                vm_count(vm_counter + second.x);
                return target_word;
            }
            vm_activate(frame.y);
            vm_depth -= 1u;
            vm_count(second.y);
            return next;
        }
        case VM_BREAK: { // break; the lanes are those of the operand
            vm_leave_loop(lanes);
            return next;
        }
        case VM_CALL: { // call
            if (lanes == 0u || target_word == 0u) {
                return next;
            }
            vm_push(vec4<u32>(VM_CALL, vm_active, 0u, next), vec4<u32>(0u));
            vm_activate(lanes);
            return target_word;
        }
        case VM_RET: { // ret
            if (vm_depth == 0u) {
                return code[q_code + 1u];
            }
            if (scratch[vm_frame(vm_depth - 1u)].x == VM_CALL) {
                return vm_return();
            }
            vm_retire();
            return next;
        }
        default: { // label
            return vm_return();
        }
    }
}

// What the texture library asks for, of the read at word `q_read`: coordinates, then a bias or gradients (x, y, z, w
// along x, then along y); and where it puts a texel's components.
fn texture_operand(number: u32, lane: u32) -> u32 {
    return vm_read(vm_operand(q_read + 1u + select(0u, 2u, number >= 4u), number), lane);
}

fn texture_result(component: u32, lane: u32, value: u32) {
    let to = vm_operand(q_read + 3u, component);
    if (to != 0xffffu) {
        scratch[q_row(to)][lane] = value;
    }
}

// What an instruction wrote in the followed lane: its number, the components written, their values.
fn vm_trace(at: u32) {
    if (q_trace == 0u || ((vm_active >> (q_trace - 1u)) & 1u) == 0u) {
        return;
    }
    var mask = 0u;
    for (var i = 0u; i < 4u; i += 1u) {
        let allowed = vm_operand(at + 4u, i);
        var value = 0u;
        if (allowed != 0xffffu) {
            if (vm_read(allowed, q_trace - 1u) != 0u) {
                mask |= 1u << i;
                value = vm_read(vm_operand(at + 2u, i), q_trace - 1u);
            }
        }
        trace_put(q_traced + 2u + i, value);
    }
    trace_put(q_traced, code[at + 1u]);
    trace_put(q_traced + 1u, mask);
    q_traced += 6u;
}

// A float constant with a relative number.
fn vm_relative(word: u32, base: i32, address: i32) -> u32 {
    let count = bitcast<i32>(code[q_code + 4u]);
    var result = 0u;
    // Without overflow: 0 <= base < 2^16.
    if (address >= -base && address < count - base) {
        result = code[q_code + code[q_code + 3u] + 4u * u32(base + address) + (word >> 16u)];
    }
    return result;
}

// What a long operation comes to before its rounding: of two operands, or the sum of up to four products.
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
    // A sum that one adder makes: result, four operands. The word says how many are aligned, and to how many bits; none:
    // a multiply-add that cuts its product. This stands inside as in n_cut_sum.
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

// What is computed lane by lane: result, up to three operands.
fn vm_compute(op: u32, word: u32, at: u32) {
    let f = format(word >> 24u);
    let operation = (word >> 16u) & 255u;
    // Differences within the quad: bit 1 right neighbour less left one, bit 2 lower less upper.
    let other = (word >> 12u) & 3u;
    // One call in a loop, not three: compilers take half of the time. An array would cost them more than moving the
    // rows.
    var first: vec4<u32>;
    var second: vec4<u32>;
    var third: vec4<u32>;
    for (var k = 1u; k < 4u; k += 1u) {
        first = second;
        second = third;
        if (k == 1u || op != VM_RELATIVE) {
            third = vm_row(vm_operand(at + 1u, k));
        }
    }
    var result = first;
    switch op {
        case VM_COPY: {}
        case VM_AND: { result = first & second; }
        case VM_OR: { result = first | second; }
        case VM_AND_NOT: { result = second & ~first; }
        case VM_SELECT: { result = (first & second) | (~first & third); }
        case VM_RELATIVE: {
            for (var lane = 0u; lane < 4u; lane += 1u) {
                result[lane] = vm_relative(word, bitcast<i32>(code[at + 2u]), bitcast<i32>(first[lane]));
            }
        }
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

// Loop passes of an instruction at most, by the class that its word names.
fn vm_cost(word: u32) -> u32 {
    return vec4<u32>(20u, 600u, 1000u, 8000u)[(word >> 14u) & 3u];
}

fn vm_saved(row: u32) -> u32 {
    return (q_save + row) * q_stride + q_invocation;
}

// Puts down what the program needs to go on at `next`.
fn vm_suspend(next: u32) {
    q_suspended = true;
    scratch[vm_saved(0u)] = vec4<u32>(next, vm_active, vm_depth, vm_counter);
    scratch[vm_saved(1u)] = vm_steps;
    scratch[vm_saved(2u)] = vec4<u32>(q_cut);
}

// Takes it up again; returns where the program goes on.
fn vm_resume() -> u32 {
    q_suspended = false;
    let state = scratch[vm_saved(0u)];
    vm_activate(state.y);
    vm_depth = state.z;
    vm_counter = state.w;
    vm_steps = scratch[vm_saved(1u)];
    q_cut = scratch[vm_saved(2u)] != vec4<u32>(0u);
    return state.x;
}

fn vm_begin() -> u32 {
    q_cut = vec4<bool>(false);
    vm_steps = vec4<u32>(0u);
    vm_depth = 0u;
    vm_activate(vm_bits(q_run));
    return code[q_code];
}

// Interpolates and runs the program. Loops stand in loops because drivers of processors have no branches: they run all
// the text of a loop's body at each pass, with the results of most of it thrown away. So the innermost loop holds what
// programs do most, and the text for texture reads runs as often as there are texture reads.
fn shade() {
    var next = code[q_code + 7u];
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
                    // Interpolation is part of what a triangle costs.
                    if (!vm_prepared && next < code[q_code + 7u]) {
                        if (q_passes < cost) {
                            vm_suspend(next);
                            return;
                        }
                        q_passes -= cost;
                    }
                }
                var is_short = !is_long;
                switch select(op, VM_END, is_long) {
                    case VM_ALU, VM_LONG, VM_DOT, VM_COPY, VM_AND, VM_OR, VM_AND_NOT, VM_SELECT, VM_RELATIVE: {
                        vm_compute(op, word, at);
                        next += select(3u, 6u, op == VM_DOT);
                    }
                    case VM_UNLESS: { // goes on elsewhere if a bit of a word of the set-up is 1
                        let bits = setups[q_setup + (word >> 16u)];
                        next = select(next + 2u, code[at + 1u], ((bits >> ((word >> 8u) & 31u)) & 1u) == 1u);
                    }
                    case VM_STEP: { // an instruction: where to go on if no lane runs; the sampler it reads
                        if (HAS_STEP_BUDGET) {
                            vm_charge();
                        }
                        let lanes = countOneBits(vm_bits(q_covered) & vm_active);
                        let sampler_number = code[at + 2u];
                        if (sampler_number != 0xffffu && lanes != 0u) {
                            q_fetched[sampler_number] += lanes;
                        }
                        next = select(next + 3u, code[at + 1u], vm_active == 0u);
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
            case VM_ENTER: { // the program begins, or goes on
                next = vm_begin();
                if (HAS_SUSPENSION) {
                    if (q_suspended) {
                        next = vm_resume();
                    }
                }
            }
            case VM_FETCH: { // a texture read: sampler, detail
                q_read = at;
                texture_read((word >> 16u) & 0xffu, word >> 24u, q_run);
                next += 5u + select(word >> 24u, 4u, word >> 24u == 2u);
            }
            case VM_FETCHED: { // texture reads of every covered lane
                q_fetched[word >> 16u] += code[at + 1u] * countOneBits(vm_bits(q_covered));
                next += 2u;
            }
            case VM_SUM: { // a sum that one adder makes
                vm_sum(word, at);
                next += 4u;
            }
            case VM_ZERO: { // zeros in so many slots
                for (var i = 0u; i < code[at + 2u]; i += 1u) {
                    scratch[q_row(code[at + 1u] + i)] = vec4<u32>(0u);
                }
                next += 3u;
            }
            case VM_TRACE: {
                vm_trace(at);
                next += 6u;
            }
            case VM_IF, VM_ELSE, VM_END_IF, VM_LOOP, VM_END_LOOP, VM_BREAK, VM_CALL, VM_RET, VM_LABEL: {
                next = vm_flow(op, at, next + select(3u, 6u, op == VM_LOOP));
            }
            default: {
                return;
            }
        }
    }
}

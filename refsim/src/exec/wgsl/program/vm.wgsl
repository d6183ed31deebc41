// Programs as words: one machine for all of them, so that its arithmetic is compiled once and has few call sites.
//
// The words of a program start at code[q_code]: first word, words of the end, constants, table of the float constants and
// their number, first slot of the frames, number of slots (offsets count from q_code). Operands are slots below 0x8000,
// constants below 0xff00, then input components. program/microcode.rs writes what this reads.

const VM_IF: u32 = 0u;
const VM_LOOP: u32 = 1u;
const VM_CALL: u32 = 2u;

var<private> vm_active: u32;
var<private> vm_depth: u32;
var<private> vm_counter: u32;
// Steps of each lane.
var<private> vm_steps: vec4<u32>;

fn vm_read(operand: u32) -> vec4<u32> {
    if (operand < 0x8000u) {
        return scratch[operand * q_stride + q_invocation];
    }
    if (operand < 0xff00u) {
        return vec4<u32>(code[q_code + code[q_code + 2u] + operand - 0x8000u]);
    }
    return q_input[operand - 0xff00u];
}

fn vm_write(slot: u32, row: vec4<u32>) {
    scratch[slot * q_stride + q_invocation] = row;
}

fn vm_bits(mask: vec4<u32>) -> u32 {
    let bits = select(vec4<u32>(0u), vec4<u32>(1u, 2u, 4u, 8u), mask != vec4<u32>(0u));
    return bits.x | bits.y | bits.z | bits.w;
}

fn vm_mask(bits: u32) -> vec4<u32> {
    return select(vec4<u32>(0u), vec4<u32>(0xffffffffu), (vec4<u32>(bits) & vec4<u32>(1u, 2u, 4u, 8u)) != vec4<u32>(0u));
}

fn vm_covered() -> u32 {
    return vm_bits(select(vec4<u32>(0u), vec4<u32>(1u), q_covered));
}

// Slot 0 is the mask of active lanes.
fn vm_activate(bits: u32) {
    vm_active = bits;
    vm_write(0u, vm_mask(bits));
}

// Slot 3 is the loop counter.
fn vm_count(counter: u32) {
    vm_counter = counter;
    vm_write(3u, vec4<u32>(counter));
}

// A frame is two rows: kind, lanes to run afterwards, lanes of `else` or still in the loop, passes left or way back; then
// of loops what the counter grows by and what it was.
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
    let lanes = vm_mask(vm_active) != vec4<u32>(0u);
    let spent = lanes & (vm_steps == vec4<u32>(q_step_budget));
    vm_steps += select(vec4<u32>(0u), vec4<u32>(1u), lanes & !spent);
    if (!any(spent)) {
        return;
    }
    q_cut |= spent;
    let cut = vm_bits(select(vec4<u32>(0u), vec4<u32>(1u), spent));
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
    switch op {
        case 32u: { // if
            let taken = vm_bits(vm_read(code[at + 2u]));
            vm_push(vec4<u32>(VM_IF, vm_active, vm_active & ~taken, 0u), vec4<u32>(0u));
            vm_activate(taken);
            return select(target_word, next, taken != 0u);
        }
        case 33u: { // else
            if (vm_depth > 0u) {
                let frame = scratch[vm_frame(vm_depth - 1u)];
                if (frame.x == VM_IF) {
                    vm_activate(frame.z);
                }
            }
            return select(target_word, next, vm_active != 0u);
        }
        case 34u: { // endif
            if (vm_depth > 0u) {
                let frame = scratch[vm_frame(vm_depth - 1u)];
                if (frame.x == VM_IF) {
                    vm_activate(frame.y);
                    vm_depth -= 1u;
                }
            }
            return next;
        }
        case 35u: { // rep, loop: target past the end, passes, start, step, whether it counts
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
        case 36u: { // endrep, endloop
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
        case 37u: { // break; the lanes are those of the operand
            vm_leave_loop(vm_bits(vm_read(code[at + 2u])));
            return next;
        }
        case 38u: { // call
            let entering = vm_bits(vm_read(code[at + 2u]));
            if (entering == 0u || target_word == 0u) {
                return next;
            }
            vm_push(vec4<u32>(VM_CALL, vm_active, 0u, next), vec4<u32>(0u));
            vm_activate(entering);
            return target_word;
        }
        case 39u: { // ret
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

// A texture read: sampler, detail, coordinates, destinations, bias or gradients.
fn vm_fetch(at: u32, sampler_number: u32, detail: u32) {
    var coordinates: array<vec4<u32>, 4>;
    var gradients: array<vec4<u32>, 8>;
    for (var i = 0u; i < 4u; i += 1u) {
        coordinates[i] = vm_read((code[at + 1u + i / 2u] >> (16u * (i & 1u))) & 0xffffu);
    }
    var bias = vec4<u32>(0u);
    if (detail == 1u) {
        bias = vm_read(code[at + 5u]);
    }
    if (detail == 2u) {
        for (var i = 0u; i < 8u; i += 1u) {
            gradients[i] = vm_read((code[at + 5u + i / 2u] >> (16u * (i & 1u))) & 0xffffu);
        }
    }
    var texel = texture_read(
        sampler_number, coordinates[0], coordinates[1], coordinates[2], coordinates[3], detail, bias, gradients, q_run,
    );
    for (var i = 0u; i < 4u; i += 1u) {
        let to = (code[at + 3u + i / 2u] >> (16u * (i & 1u))) & 0xffffu;
        if (to != 0xffffu) {
            vm_write(to, texel[i]);
        }
    }
}

// What an instruction wrote in the followed lane: its number, the components written, their values.
fn vm_trace(at: u32) {
    if (q_trace == 0u || (vm_active >> (q_trace - 1u) & 1u) == 0u) {
        return;
    }
    var mask = 0u;
    for (var i = 0u; i < 4u; i += 1u) {
        let shift = 16u * (i & 1u);
        let allowed = (code[at + 4u + i / 2u] >> shift) & 0xffffu;
        var value = 0u;
        if (allowed != 0xffffu) {
            let row = vm_read(allowed);
            if (row[q_trace - 1u] != 0u) {
                mask |= 1u << i;
                let held = vm_read((code[at + 2u + i / 2u] >> shift) & 0xffffu);
                value = held[q_trace - 1u];
            }
        }
        trace_put(q_traced + 2u + i, value);
    }
    trace_put(q_traced, code[at + 1u]);
    trace_put(q_traced + 1u, mask);
    q_traced += 6u;
}

fn vm_alu(word: u32, at: u32) {
    let second = code[at + 2u];
    var a = vm_read(code[at + 1u] >> 16u);
    var b = vm_read(second & 0xffffu);
    var c = vm_read(second >> 16u);
    switch (word >> 12u) & 3u {
        case 1u: { // right neighbour less left one
            b = a.xxzz;
            a = a.yyww;
        }
        case 2u: { // lower less upper
            b = a.xyxy;
            a = a.zwzw;
        }
        default: {}
    }
    let f = format((word >> 8u) & 15u);
    let operation = word >> 16u;
    var result: vec4<u32>;
    for (var i = 0u; i < 4u; i += 1u) {
        result[i] = n_alu(operation, f, a[i], b[i], c[i]);
    }
    vm_write(code[at + 1u] & 0xffffu, result);
}

fn vm_dot(word: u32, at: u32) {
    var rows: array<vec4<u32>, 8>;
    let terms = word >> 16u;
    for (var i = 0u; i < 2u * terms; i += 1u) {
        rows[i] = vm_read((code[at + 1u + (i + 1u) / 2u] >> (16u * ((i + 1u) & 1u))) & 0xffffu);
    }
    let f = format((word >> 8u) & 15u);
    var result: vec4<u32>;
    for (var i = 0u; i < 4u; i += 1u) {
        let a = vec4<u32>(rows[0][i], rows[2][i], rows[4][i], rows[6][i]);
        let b = vec4<u32>(rows[1][i], rows[3][i], rows[5][i], rows[7][i]);
        result[i] = n_dot(f, terms, a, b);
    }
    vm_write(code[at + 1u] & 0xffffu, result);
}

fn vm_bitwise(word: u32, at: u32) {
    let second = code[at + 2u];
    let a = vm_read(code[at + 1u] >> 16u);
    let b = vm_read(second & 0xffffu);
    var result = a;
    switch word >> 16u {
        case 1u: {
            result = a & b;
        }
        case 2u: {
            result = a | b;
        }
        case 3u: {
            result = b & ~a;
        }
        case 4u: {
            result = (a & b) | (~a & vm_read(second >> 16u));
        }
        default: {}
    }
    vm_write(code[at + 1u] & 0xffffu, result);
}

fn vm_relative(word: u32, at: u32) {
    let address = bitcast<vec4<i32>>(vm_read(code[at + 1u] >> 16u));
    let base = bitcast<i32>(code[at + 2u]);
    let count = bitcast<i32>(code[q_code + 4u]);
    var result = vec4<u32>(0u);
    for (var i = 0u; i < 4u; i += 1u) {
        // Without overflow: 0 <= base < 2^16.
        if (address[i] >= -base && address[i] < count - base) {
            result[i] = code[q_code + code[q_code + 3u] + 4u * u32(base + address[i]) + (word >> 16u)];
        }
    }
    vm_write(code[at + 1u] & 0xffffu, result);
}

// Loop passes of an instruction at most.
fn vm_cost(op: u32, word: u32, at: u32) -> u32 {
    switch op {
        case 1u: {
            switch (word >> 16u) & 0x7fffu {
                case N_DIV, N_RCP, N_RSQ, N_SQRT, N_STEPS, N_SPLIT_SHORT, N_SPLIT_BYTE, N_SPLIT_SIGNED_BYTE: {
                    return 450u;
                }
                case N_SIN, N_COS: {
                    return 500u;
                }
                case N_EXP2, N_LOG2: {
                    return 1000u;
                }
                default: {
                    return 20u;
                }
            }
        }
        case 3u: {
            return 600u;
        }
        case 5u: {
            return 450u;
        }
        case 7u: {
            return 8000u;
        }
        case 13u: {
            return code[at + 2u] + 1u;
        }
        default: {
            return 20u;
        }
    }
}

fn vm_saved(row: u32) -> u32 {
    return (q_save + row) * q_stride + q_invocation;
}

// Puts down what the program needs to go on at `next`.
fn vm_suspend(next: u32) {
    q_suspended = true;
    scratch[vm_saved(0u)] = vec4<u32>(next, vm_active, vm_depth, vm_counter);
    scratch[vm_saved(1u)] = vec4<u32>(q_killed);
    scratch[vm_saved(2u)] = vec4<u32>(q_depth_is_main);
    scratch[vm_saved(3u)] = q_depth;
    for (var i = 0u; i < 16u; i += 1u) {
        scratch[vm_saved(4u + i)] = q_color[i >> 2u][i & 3u];
    }
    scratch[vm_saved(20u)] = vm_steps;
    scratch[vm_saved(21u)] = vec4<u32>(q_cut);
}

// Takes it up again; returns where the program goes on.
fn vm_resume() -> u32 {
    q_suspended = false;
    let state = scratch[vm_saved(0u)];
    vm_active = state.y;
    vm_depth = state.z;
    vm_counter = state.w;
    q_killed = scratch[vm_saved(1u)] != vec4<u32>(0u);
    q_depth_is_main = scratch[vm_saved(2u)] != vec4<u32>(0u);
    q_depth = scratch[vm_saved(3u)];
    for (var i = 0u; i < 16u; i += 1u) {
        q_color[i >> 2u][i & 3u] = scratch[vm_saved(4u + i)];
    }
    vm_steps = scratch[vm_saved(20u)];
    q_cut = scratch[vm_saved(21u)] != vec4<u32>(0u);
    return state.x;
}

fn vm_begin() -> u32 {
    q_color = array<array<vec4<u32>, 4>, 4>();
    q_killed = vec4<bool>(false);
    q_depth_is_main = vec4<bool>(false);
    q_executed = 0u;
    q_cut = vec4<bool>(false);
    vm_steps = vec4<u32>(0u);
    vm_depth = 0u;
    vm_activate(vm_bits(select(vec4<u32>(0u), vec4<u32>(1u), q_run)));
    return code[q_code];
}

fn shade() {
    var next: u32;
    if (q_suspended) {
        next = vm_resume();
    } else {
        next = vm_begin();
    }
    loop {
        let at = q_code + next;
        let word = code[at];
        let op = word & 0xffu;
        let cost = vm_cost(op, word, at);
        if (q_passes < cost) {
            vm_suspend(next);
            return;
        }
        q_passes -= cost;
        if (op >= 32u) {
            next = vm_flow(op, at, next + select(3u, 6u, op == 35u));
            continue;
        }
        switch op {
            case 1u: {
                vm_alu(word, at);
                next += 3u;
            }
            case 2u: {
                vm_bitwise(word, at);
                next += 3u;
            }
            case 3u: {
                vm_dot(word, at);
                next += 6u;
            }
            case 6u: {
                vm_relative(word, at);
                next += 3u;
            }
            case 7u: {
                let detail = word >> 24u;
                vm_fetch(at, (word >> 16u) & 0xffu, detail);
                next += 5u + select(detail, 4u, detail == 2u);
            }
            case 8u: { // a component of a colour
                let number = word >> 16u;
                q_color[number >> 2u][number & 3u] = vm_read(code[at + 1u]);
                next += 2u;
            }
            case 9u: { // killed lanes
                q_killed = vm_read(code[at + 1u]) != vec4<u32>(0u);
                next += 2u;
            }
            case 10u: { // depth, in the main format or single, where decided
                let decided = vm_read(code[at + 1u] >> 16u) != vec4<u32>(0u);
                q_depth = select(q_depth, vm_read(code[at + 1u] & 0xffffu), decided);
                q_depth_is_main = decided & vec4<bool>(word >> 16u == MAIN);
                next += 2u;
            }
            case 11u: { // texture reads of every covered lane
                q_fetched[word >> 16u] += code[at + 1u] * countOneBits(vm_covered());
                next += 2u;
            }
            case 12u: { // a step: slots of an instruction; where to go on if no lane runs; the sampler it reads
                if (q_counts_steps) {
                    vm_charge();
                }
                let lanes = countOneBits(vm_covered() & vm_active);
                q_executed += (code[at + 2u] & 0xffffu) * lanes;
                let sampler_number = code[at + 2u] >> 16u;
                if (sampler_number != 0xffffu && lanes != 0u) {
                    q_fetched[sampler_number] += lanes;
                }
                next = select(next + 3u, code[at + 1u], vm_active == 0u);
            }
            case 13u: { // zeros in so many slots
                for (var i = 0u; i < code[at + 2u]; i += 1u) {
                    vm_write(code[at + 1u] + i, vec4<u32>(0u));
                }
                next += 3u;
            }
            case 14u: {
                vm_trace(at);
                next += 6u;
            }
            case 15u: { // an output of a vertex
                output_put(word >> 16u, vm_read(code[at + 1u]));
                next += 2u;
            }
            default: {
                return;
            }
        }
    }
}

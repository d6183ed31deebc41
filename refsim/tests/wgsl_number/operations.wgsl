// One operation per item: its number, its format (an index into `formats`), three operands as bit patterns.
@group(0) @binding(0) var<storage, read> formats: array<u32>;
@group(0) @binding(1) var<storage, read> items: array<u32>;
@group(0) @binding(2) var<storage, read_write> results: array<u32>;

fn format_at(k: u32) -> Format {
    let at = 8u * k;
    return Format(formats[at], formats[at + 1u], formats[at + 2u], formats[at + 3u], formats[at + 4u], formats[at + 5u],
        formats[at + 6u], formats[at + 7u]);
}

@compute @workgroup_size(64)
fn run_operations(@builtin(global_invocation_id) id: vec3<u32>) {
    let at = 5u * id.x;
    if id.x >= arrayLength(&results) {
        return;
    }
    let op = items[at];
    let f = format_at(items[at + 1u]);
    var operands = vec3<u32>(items[at + 2u], items[at + 3u], items[at + 4u]);
    // The second operand of a conversion is the first one's format; a scaling has a power, and steps have a count.
    // Words, and singles that are packed as steps, are not decoded.
    let first = format_at(select(items[at + 1u], items[at + 4u], op == N_CONVERT));
    let joins = op >= N_JOIN_PATTERN && op <= N_JOIN_SIGNED_BYTE;
    let packs = joins || (op >= N_SPLIT_PATTERN && op <= N_SPLIT_SIGNED_BYTE);
    let numbers = select(3u, 1u, op == N_CONVERT || op == N_SCALE || op == N_STEPS || packs);
    for (var i = 0u; i < numbers; i++) {
        let one = operands[i];
        operands[i] = select(n_decode(first, one), one, op == N_STEPS || packs);
    }
    if op == N_JOIN_PATTERN {
        operands.y = n_decode(f, operands.y);
    }
    let result = n_alu(op, f, operands.x, operands.y, operands.z);
    let plain = joins || op == N_LESS || op == N_LESS_EQUAL || op == N_EQUAL || op == N_ADDRESS_FLOOR || op == N_ADDRESS_NEAREST;
    results[id.x] = select(n_encode(f, result), result, plain);
}

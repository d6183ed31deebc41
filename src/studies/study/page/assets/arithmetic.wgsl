// Operations of the number library on bit patterns; each row of workgroups computes one cell of the table.
//
// A job is twelve words: a format (struct Format), the operation, the first operand set, the number of sets, unused.

const JOB_WORDS: u32 = 12u;

@group(0) @binding(0) var<storage, read> jobs: array<u32>;
// Three operands per set.
@group(0) @binding(1) var<storage, read> operands: array<u32>;
@group(0) @binding(2) var<storage, read_write> results: array<u32>;

// The job's format.
fn job_format(at: u32) -> Format {
    return Format(
        jobs[at], jobs[at + 1u], jobs[at + 2u], jobs[at + 3u],
        jobs[at + 4u], jobs[at + 5u], jobs[at + 6u], jobs[at + 7u],
    );
}

@compute @workgroup_size(64)
fn alu_main(@builtin(global_invocation_id) place: vec3<u32>) {
    let at = JOB_WORDS * place.y;
    if (place.x >= jobs[at + 10u]) {
        return;
    }
    let item = jobs[at + 9u] + place.x;
    let f = job_format(at);
    let operation = jobs[at + 8u];
    // The library has no multiply-add with two roundings.
    let two = operation == N_MAD;
    var a = n_decode(f, operands[3u * item]);
    var b = n_decode(f, operands[3u * item + 1u]);
    let c = n_decode(f, operands[3u * item + 2u]);
    for (var step = 0u; step < select(1u, 2u, two); step++) {
        let now = select(operation, select(N_MUL, N_ADD, step == 1u), two);
        a = n_alu(now, f, a, b, c);
        b = select(b, c, two);
    }
    results[item] = n_encode(f, a);
}

@compute @workgroup_size(64)
fn power_main(@builtin(global_invocation_id) place: vec3<u32>) {
    let at = JOB_WORDS * place.y;
    if (place.x >= jobs[at + 10u]) {
        return;
    }
    let item = jobs[at + 9u] + place.x;
    let f = job_format(at);
    let x = n_unpack(f.kind, f.frac, n_decode(f, operands[3u * item]));
    results[item] = n_encode(f, n_finish(f, n_in_units(f, n_power(jobs[at + 8u], f, x))));
}

@compute @workgroup_size(64)
fn circle_main(@builtin(global_invocation_id) place: vec3<u32>) {
    let at = JOB_WORDS * place.y;
    if (place.x >= jobs[at + 10u]) {
        return;
    }
    let item = jobs[at + 9u] + place.x;
    let f = job_format(at);
    let x = n_unpack(f.kind, f.frac, n_decode(f, operands[3u * item]));
    results[item] = n_encode(f, n_finish(f, n_in_units(f, n_circle(jobs[at + 8u], f, x))));
}

// Functions other than n_alu, one per item: number of the function, two formats, eight operands.
@group(0) @binding(0) var<storage, read> formats: array<u32>;
@group(0) @binding(1) var<storage, read> items: array<u32>;
@group(0) @binding(2) var<storage, read_write> results: array<u32>;

fn format_at(k: u32) -> Format {
    let at = 8u * k;
    return Format(formats[at], formats[at + 1u], formats[at + 2u], formats[at + 3u], formats[at + 4u], formats[at + 5u],
        formats[at + 6u], formats[at + 7u]);
}

@compute @workgroup_size(64)
fn run_functions(@builtin(global_invocation_id) id: vec3<u32>) {
    let at = 11u * id.x;
    if id.x >= arrayLength(&results) {
        return;
    }
    let f = format_at(items[at + 1u]);
    let g = format_at(items[at + 2u]);
    var x: array<u32, 8>;
    for (var i = 0u; i < 8u; i++) {
        x[i] = items[at + 3u + i];
    }
    var result = 0u;
    switch items[at] {
        case 2u, 3u, 4u: {
            var a: vec4<u32>;
            var b: vec4<u32>;
            for (var i = 0u; i < 4u; i++) {
                a[i] = n_decode(f, x[i]);
                b[i] = n_decode(f, x[i + 4u]);
            }
            result = n_encode(f, n_finish(f, n_dot(f, items[at], a, b)));
        }
        case 5u: { result = n_encode(g, n_finish(g, n_term(N_CONVERT, g, f.kind, f.frac, f.over, n_decode(f, x[0]), 0u))); }
        case 7u: {
            result = n_encode(f, n_round(f, (x[2] & 1u) == 1u, vec2<u32>(x[0], x[1]), i32(x[3]), (x[2] & 2u) == 2u));
        }
        case 8u: { result = s_alu(x[2], x[0], x[1]); }
        default: {}
    }
    results[id.x] = result;
}

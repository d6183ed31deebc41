// What programs written out as WGSL consist of: operations on rows of four lanes.

fn p_alu(operation: u32, f: Format, a: vec4<u32>, b: vec4<u32>, c: vec4<u32>) -> vec4<u32> {
    var left = a;
    var right = b;
    var third = c;
    var result: vec4<u32>;
    for (var i = 0u; i < 4u; i += 1u) {
        result[i] = n_alu(operation, f, left[i], right[i], third[i]);
    }
    return result;
}

fn p_dot(f: Format, terms: u32, a: array<vec4<u32>, 4>, b: array<vec4<u32>, 4>) -> vec4<u32> {
    var left = a;
    var right = b;
    var result: vec4<u32>;
    for (var i = 0u; i < 4u; i += 1u) {
        let x = vec4<u32>(left[0][i], left[1][i], left[2][i], left[3][i]);
        let y = vec4<u32>(right[0][i], right[1][i], right[2][i], right[3][i]);
        result[i] = n_dot(f, terms, x, y);
    }
    return result;
}

// A float constant with a relative number: `table` its place in the words, `count` how many there are.
fn p_relative(table: u32, count: i32, base: i32, component: u32, address: vec4<u32>) -> vec4<u32> {
    var result = vec4<u32>(0u);
    for (var i = 0u; i < 4u; i += 1u) {
        let number = bitcast<i32>(address[i]);
        if (number >= -base && number < count - base) {
            result[i] = code[q_code + table + 4u * u32(base + number) + component];
        }
    }
    return result;
}

fn p_constant(at: u32) -> vec4<u32> {
    return vec4<u32>(code[q_code + at]);
}

fn p_select(mask: vec4<u32>, a: vec4<u32>, b: vec4<u32>) -> vec4<u32> {
    return (mask & a) | (~mask & b);
}

fn p_mask(holds: vec4<bool>) -> vec4<u32> {
    return select(vec4<u32>(0u), vec4<u32>(0xffffffffu), holds);
}

// Single precision as the device has it. A NaN is any NaN here, and told by its bits: a compiler may take it that no
// comparison ever meets one. What leaves the program has the one NaN.

fn p_is_nan(a: vec4<u32>) -> vec4<bool> {
    return (a & vec4<u32>(0x7fffffffu)) > vec4<u32>(0x7f800000u);
}

fn p_clean(a: vec4<u32>) -> vec4<u32> {
    return select(a, vec4<u32>(0x7fc00000u), p_is_nan(a));
}

fn p_f32(a: vec4<u32>) -> vec4<f32> {
    return bitcast<vec4<f32>>(a);
}

// Zeros, which no compiler knows: the first of the program's words. A result that they might change is a result on its own,
// and is neither contracted with the next operation nor moved about in a sum.
var<private> p_zeros: vec4<u32>;

fn p_u32(a: vec4<f32>) -> vec4<u32> {
    return bitcast<vec4<u32>>(a) ^ p_zeros;
}

// What orders patterns as their numbers; both zeros give 0.
fn p_key(a: vec4<u32>) -> vec4<i32> {
    let magnitude = bitcast<vec4<i32>>(a & vec4<u32>(0x7fffffffu));
    return select(magnitude, -magnitude, (a >> vec4<u32>(31u)) == vec4<u32>(1u));
}

fn p_add(a: vec4<u32>, b: vec4<u32>) -> vec4<u32> {
    return p_u32(p_f32(a) + p_f32(b));
}

fn p_sub(a: vec4<u32>, b: vec4<u32>) -> vec4<u32> {
    return p_u32(p_f32(a) - p_f32(b));
}

fn p_mul(a: vec4<u32>, b: vec4<u32>) -> vec4<u32> {
    return p_u32(p_f32(a) * p_f32(b));
}

fn p_div(a: vec4<u32>, b: vec4<u32>) -> vec4<u32> {
    return p_u32(p_f32(a) / p_f32(b));
}

fn p_floor(a: vec4<u32>) -> vec4<u32> {
    return p_u32(floor(p_f32(a)));
}

fn p_less(a: vec4<u32>, b: vec4<u32>) -> vec4<u32> {
    return p_mask((p_key(a) < p_key(b)) & !p_is_nan(a) & !p_is_nan(b));
}

fn p_less_equal(a: vec4<u32>, b: vec4<u32>) -> vec4<u32> {
    return p_mask((p_key(a) <= p_key(b)) & !p_is_nan(a) & !p_is_nan(b));
}

fn p_equal(a: vec4<u32>, b: vec4<u32>) -> vec4<u32> {
    return p_mask((p_key(a) == p_key(b)) & !p_is_nan(a) & !p_is_nan(b));
}

fn p_min(a: vec4<u32>, b: vec4<u32>) -> vec4<u32> {
    return p_select(p_less(a, b), a, b);
}

fn p_max(a: vec4<u32>, b: vec4<u32>) -> vec4<u32> {
    return p_select(p_less_equal(b, a), a, b);
}

fn p_neg(a: vec4<u32>) -> vec4<u32> {
    return a ^ vec4<u32>(0x80000000u);
}

fn p_abs(a: vec4<u32>) -> vec4<u32> {
    return a & vec4<u32>(0x7fffffffu);
}

fn p_saturate(a: vec4<u32>) -> vec4<u32> {
    let key = p_key(a);
    let high = select(a, vec4<u32>(0x3f800000u), key >= vec4<i32>(0x3f800000));
    return select(high, vec4<u32>(0u), (key <= vec4<i32>(0)) | p_is_nan(a));
}

fn p_factor(a: vec4<u32>, b: vec4<u32>) -> vec4<u32> {
    let x = a & vec4<u32>(0x7fffffffu);
    let y = b & vec4<u32>(0x7fffffffu);
    let ends = max(x, y) >= vec4<u32>(0x7f800000u);
    return select(a, vec4<u32>(0u), ends & (min(x, y) == vec4<u32>(0u)));
}

fn p_non_negative(a: vec4<u32>, b: vec4<u32>, c: vec4<u32>) -> vec4<u32> {
    return select(c, b, (p_key(a) >= vec4<i32>(0)) & !p_is_nan(a));
}

fn p_above_half(a: vec4<u32>, b: vec4<u32>, c: vec4<u32>) -> vec4<u32> {
    return select(c, b, (p_key(a) > vec4<i32>(0x3f000000)) & !p_is_nan(a));
}

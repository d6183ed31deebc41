fn n_cut_sum(f: Format, x: Number, y: Number, z: Number) -> Real {
    // x y + z, with the product truncated to the format's significand. The comment is inside the function, and there
    // are no empty lines, because text between functions would remain in programs that don't use them.
    let high = n_mul32(x.sig, y.sig);
    let shift = countLeadingZeros(high.x) & 1u;
    let leading = (high.x << shift) | ((high.y >> 31u) & shift);
    let below = (1u << (31u - f.frac)) - 1u;
    let product = Number(0u, x.sign ^ y.sign, x.exp + y.exp + 32 - i32(shift), leading & ~below);
    let finite = x.kind == 0u && y.kind == 0u && x.sig != 0u && y.sig != 0u;
    var first = x;
    var second = y;
    if finite {
        first = product;
        second = N_ONE;
    }
    return n_sum(f, first, second, z);
}
fn n_aligned(f: Format, terms: u32, bits: u32, addends: vec4<u32>) -> Real {
    // The sum of the first `terms` numbers: each is aligned to the largest exponent and truncated to `bits` bits below
    // it, at most 28; the results are added exactly.
    var numbers = addends;
    var top = -N_FAR;
    var nan = false;
    var infinite = vec2<bool>(false, false);
    var signs = vec2<bool>(false, false);
    for (var k = 0u; k < min(terms, 4u); k++) {
        let x = n_unpack(f.kind, f.frac, numbers[k]);
        let side = vec2<bool>(x.sign == 0u, x.sign == 1u);
        signs = signs | side;
        nan = nan || x.kind == 2u;
        infinite = infinite | (side & vec2<bool>(x.kind == 1u));
        top = max(top, x.exp);
    }
    var sum = 0;
    for (var k = 0u; k < min(terms, 4u); k++) {
        let x = n_unpack(f.kind, f.frac, numbers[k]);
        let kept = i32((x.sig >> (31u - bits)) >> u32(min(top - x.exp, 31)));
        sum += select(kept, -kept, x.sign == 1u);
    }
    nan = nan || all(infinite);
    let raw = select(n_infinite(f, select(0u, 1u, infinite.y)), n_nan(f), nan);
    let zero = select(0u, 1u, select(signs.y, f.rounding == 3u, all(signs)));
    let sign = select(select(0u, 1u, sum < 0), zero, sum == 0);
    return Real(nan || any(infinite), raw, sign, top + 31 - i32(bits), vec3<u32>(0u, 0u, u32(abs(sum))));
}

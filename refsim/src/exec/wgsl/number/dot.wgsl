// Sum of the first `terms` products, at most 4, before its only rounding: an integer of 672 bits in units of 2^-384
// holds every partial sum.
fn n_dot(f: Format, terms: u32, a: vec4<u32>, b: vec4<u32>) -> Real {
    if (HAS_UNITS) {
        if f.special > 1u {
            return n_known(u_dot(f, terms, a, b));
        }
    }
    var left = a;
    var right = b;
    var sum: array<u32, 21>;
    var bad = false;
    var nan = false;
    var infinite = vec2<bool>(false, false);
    var signs = vec2<bool>(false, false);
    for (var k = 0u; k < min(terms, 4u); k++) {
        let x = n_unpack(f.kind, f.frac, left[k]);
        let y = n_unpack(f.kind, f.frac, right[k]);
        let sign = x.sign ^ y.sign;
        let side = vec2<bool>(sign == 0u, sign == 1u);
        let ends = x.kind == 1u || y.kind == 1u;
        let zero = (x.kind == 0u && x.sig == 0u) || (y.kind == 0u && y.sig == 0u);
        signs = signs | side;
        if x.kind == 2u || y.kind == 2u {
            nan = true;
        } else if ends && zero {
            bad = true;
        } else if ends {
            infinite = infinite | side;
        } else if !zero {
            let p = n_mul32(x.sig, y.sig);
            let place = u32(x.exp + y.exp + 384);
            let spread = n_right(vec3<u32>(p.x, p.y, 0u), 32u - (place & 31u));
            let at = place >> 5u;
            var carry = sign;
            for (var j = 0u; j < 21u; j++) {
                var word = 0u;
                if j == at { word = spread.z; }
                if j == at + 1u { word = spread.y; }
                if j == at + 2u { word = spread.x; }
                word = select(word, ~word, sign == 1u);
                let low = sum[j] + word;
                let total = low + carry;
                carry = select(0u, 1u, low < word || total < low);
                sum[j] = total;
            }
        }
    }
    bad = bad || nan || all(infinite);
    let known = bad || any(infinite);
    let raw = select(n_infinite(f, select(0u, 1u, infinite.y)), n_nan(f), bad);
    // The three words from the highest nonzero one down; the rest is jammed into the last bit.
    let negative = sum[20] >> 31u;
    var carry = negative;
    for (var j = 0u; j < 21u; j++) {
        let word = select(sum[j], ~sum[j], negative == 1u);
        sum[j] = word + carry;
        carry = select(0u, 1u, sum[j] < word);
    }
    var m = vec3<u32>();
    var count = 0u;
    var rest = 0u;
    var last = 0u;
    for (var j = 0u; j < 21u; j++) {
        let word = sum[20u - j];
        if count == 3u {
            rest |= word;
        } else if count > 0u || word != 0u || j == 18u {
            m = vec3<u32>(m.y, m.z, word);
            count += 1u;
            last = 20u - j;
        }
    }
    m.z |= select(0u, 1u, rest != 0u);
    if (HAS_NORMALIZED) {
        if f.over != 0u {
            m = n_divided(m, f.over);
        }
    }
    // An exact zero has the products' common sign, or, if their signs differ, the sign that the rounding gives.
    var sign = negative;
    if (m.x | m.y | m.z) == 0u {
        sign = select(0u, 1u, select(signs.y, f.rounding == 3u, all(signs)));
    }
    return Real(known, raw, sign, 32 * i32(last) - 384, m);
}

// Sine and cosine.

// sin x and cos x, with a relative accuracy of 2^-85. Except at 0 both are irrational, and no operand of any format is
// expected to have a result nearer than 2^-64 to a rounding boundary.
fn n_circle(op: u32, f: Format, x: Number) -> Real {
    let cosine = op == N_COS;
    if x.kind != 0u {
        return n_known(n_nan(f));
    }
    if x.sig == 0u {
        if cosine {
            return Real(false, 0u, 0u, 0, vec3<u32>(0u, 0u, 1u));
        }
        return n_known(n_zero(f, x.sign));
    }
    // |x| is `quarters` quarter turns plus angle * 2^e, which is below 1 and is subtracted if `negative`.
    var angle = vec3<u32>(x.sig, 0u, 0u);
    var e = x.exp - 64;
    var quarters = 0u;
    var negative = 0u;
    let far = x.exp >= -32;
    if far {
        // 2 / pi after 64 zero bits. Bits that only contribute whole turns are skipped; the next 160 bits are used.
        var digits = array<u32, 10>(
            0u, 0u, 0xa2f9836eu, 0x4e441529u, 0xfc2757d1u, 0xf534ddc0u, 0xdb629599u, 0x3c439041u, 0xfe5163abu, 0xdebbc561u,
        );
        // Before a later division no whole turns may be skipped: 16 bits remain for them.
        let start = u32(clamp(x.exp + 62 - select(16, 0, n_over(f) == 1u), 0, 159));
        let first = start >> 5u;
        let bits = start & 31u;
        var part: array<u32, 6>;
        var carry = 0u;
        for (var i = 5u; i > 0u; i--) {
            let word = (digits[first + i - 1u] << bits) | ((digits[first + i] >> 1u) >> (31u - bits));
            let product = n_mul32(x.sig, word);
            let low = product.y + carry;
            carry = product.x + select(0u, 1u, low < carry);
            part[i - 1u] = low;
        }
        if (HAS_NORMALIZED) {
            if f.over != 0u {
                var rest = 0u;
                var digit = 0u;
                for (var i = 0u; i < 10u; i++) {
                    let next = (part[i >> 1u] >> (16u - 16u * (i & 1u))) & 0xffffu;
                    let dividend = (rest << 16u) | next;
                    let before = digit;
                    digit = dividend / f.over;
                    rest = dividend - digit * f.over;
                    // A word consists of two 16-bit digits; the first digit of the quotient is dropped.
                    if (i & 1u) == 0u && i > 0u {
                        part[(i >> 1u) - 1u] = (before << 16u) | digit;
                    }
                }
                part[4] = digit << 16u;
            }
        }
        // Two integer bits, then the fraction of a quarter turn, relative to the nearest whole quarter.
        quarters = part[0] >> 30u;
        negative = (part[0] >> 29u) & 1u;
        quarters += negative;
        for (var i = 0u; i < 5u; i++) {
            part[i] = ((part[i] << 2u) | (part[i + 1u] >> 30u)) ^ (0u - negative);
        }
        // No number of 32 bits is nearer than 2^-40 to a whole quarter turn.
        let skip = select(0u, 1u, part[0] == 0u);
        let zeros = countLeadingZeros(part[skip]) & 31u;
        let high = vec3<u32>(part[skip], part[skip + 1u], part[skip + 2u]);
        angle = (high << vec3<u32>(zeros)) | ((vec3<u32>(high.y, high.z, part[skip + 3u]) >> vec3<u32>(1u)) >> vec3<u32>(31u - zeros));
        e = -96 - i32(32u * skip + zeros);
    }
    // Multiplies by pi / 2, squares, and sums the power series from its last term: 1 - z (1 - z (..) / 12) / 2 or
    // similar, which stays below 1. All products are computed at one place.
    let turn = quarters + select(0u, 1u, cosine);
    let even = (turn & 1u) == 1u;
    var square = vec3<u32>();
    var sum = vec3<u32>(0xffffffffu);
    for (var i = select(1u, 0u, far); i < 16u; i++) {
        var left = angle;
        var right = sum;
        if i == 0u {
            right = vec3<u32>(0xc90fdaa2u, 0x2168c234u, 0xc4c6628bu);
        } else if i == 1u {
            right = angle;
        } else if i < 15u {
            left = square;
        }
        let product = n_mul96(left, right);
        if i == 0u {
            angle = product;
            e += 1;
        } else if i == 1u {
            square = n_right(product, u32(-192 - 2 * e));
        } else if i < 15u {
            let k = 30u - 2u * i;
            sum = ~n_div96(product, k * select(k + 1u, k - 1u, even));
        } else {
            angle = product;
        }
    }
    let sign = ((turn >> 1u) & 1u) ^ select(negative, 0u, even) ^ select(x.sign, 0u, cosine);
    return Real(false, 0u, sign, select(e, -96, even), select(angle, sum, even) | vec3<u32>(0u, 0u, 1u));
}

// Exact sums and products; quotients, roots, powers and logarithms with enough bits to be rounded once.

const N_ONE: Number = Number(0u, 0u, -31, 0x80000000u);

// x k, for x of at most 24 bits and k below 256.
fn n_multiple(x: Number, k: u32) -> Number {
    var n = n_whole((x.sig >> 8u) * k);
    n.kind = x.kind;
    n.sign = x.sign;
    n.exp += x.exp + 8;
    return n;
}

// m / k for k below 2^16, jammed.
fn n_divided(m: vec3<u32>, k: u32) -> vec3<u32> {
    var q = n_div96(m, k);
    q.z |= select(0u, 1u, m.z != q.z * k);
    return q;
}

// x y + z
fn n_sum(f: Format, x: Number, y: Number, z: Number) -> Real {
    let sign = x.sign ^ y.sign;
    let infinite = x.kind == 1u || y.kind == 1u;
    let zero = (x.kind == 0u && x.sig == 0u) || (y.kind == 0u && y.sig == 0u);
    let differ = sign != z.sign;
    let nan = x.kind == 2u || y.kind == 2u || z.kind == 2u || (infinite && (zero || (z.kind == 1u && differ)));
    let known = nan || infinite || z.kind == 1u;
    let raw = select(n_infinite(f, select(z.sign, sign, infinite)), n_nan(f), nan);
    let product = n_mul32(x.sig, y.sig);
    // The larger term's leading bit moves to place 94. Bits that the smaller term loses below place 0 are below all
    // bits of the larger term.
    let first = x.exp + y.exp + 63;
    let second = z.exp + 31;
    let top = max(first, second);
    let u = n_right(vec3<u32>(product.x, product.y, 0u), u32(top - first) + 1u);
    var v = n_right(vec3<u32>(z.sig, 0u, 0u), u32(top - second) + 1u);
    v = select(v, ~v, differ);
    var total = n_add96(u, v, select(0u, 1u, differ));
    let turned = differ && (total.x >> 31u) == 1u;
    total = n_add96(select(total, ~total, turned), vec3<u32>(), select(0u, 1u, turned));
    // The terms have different signs and cancel exactly.
    let cancelled = differ && (total.x | total.y | total.z) == 0u;
    let negative = select(select(sign, z.sign, turned), select(0u, 1u, f.rounding == 3u), cancelled);
    return Real(known, raw, negative, top - 94, total);
}

// One step of a long division: remainder and digits, extended by one bit.
fn n_digit(state: vec2<u32>, divisor: u32) -> vec2<u32> {
    let rest = state.x << 1u;
    let one = (state.x >> 31u) == 1u || (divisor != 0u && rest >= divisor);
    return vec2<u32>(rest - select(0u, divisor, one), (state.y << 1u) | select(0u, 1u, one));
}

// x / y, sqrt x, 1 / sqrt x by long division, two bits per step; each step yields one bit of a root.
fn n_quotient(op: u32, f: Format, x: Number, y: Number) -> Real {
    var inverse = false;
    var root = false;
    if (HAS_ROOTS) {
        inverse = op == N_RSQ;
        root = inverse || op == N_SQRT;
    }
    // Results that need no digits; NaN takes precedence over infinity, and infinity over zero. There is no early
    // return, because drivers compile that to much longer code.
    let empty = x.kind == 0u && x.sig == 0u;
    let by_zero = y.kind == 0u && y.sig == 0u;
    let sign = select(x.sign ^ y.sign, select(0u, x.sign, empty), root);
    let undefined = y.kind == 2u || (x.kind == 1u && y.kind == 1u) || (empty && by_zero);
    let nan = x.kind == 2u || select(undefined, x.sign == 1u && !empty, root);
    let infinite = x.kind == 1u && !inverse;
    let pole = select(by_zero, empty && inverse, root) && !infinite;
    let zero = select(empty || y.kind == 1u, select(empty, x.kind == 1u, inverse), root);
    var raw = select(n_pole(f, sign), n_infinite(f, sign), infinite);
    raw = select(n_zero(f, sign), raw, infinite || pole);
    raw = select(raw, n_nan(f), nan);
    // rest / divisor is below 1. Divisor 0 represents 2^32: the digits are then the bits of rest.
    var rest = x.sig;
    var divisor = 0u;
    var digits = 0u;
    var steps = select(34u, 28u, n_is_float(f));
    var exp = x.exp + 32;
    if inverse {
        // In units of 1 / n, 1 / sqrt(x / n) is sqrt(n^3 / x).
        let cube = n_whole(n_over(f) * n_over(f) * n_over(f));
        steps = select(50u, 28u, n_is_float(f));
        rest = cube.sig >> 1u;
        divisor = x.sig;
        exp = cube.exp + 1 - x.exp;
    }
    // For an odd exponent, and after the integer bit of a quotient, the first pair has only one bit.
    var skip = u32(exp & 1);
    exp = (exp + i32(skip)) / 2 - i32(steps);
    if !root {
        steps = select(32u, 16u, n_is_float(f));
        divisor = y.sig;
        if rest >= divisor {
            rest -= divisor;
            digits = 1u;
        }
        skip = 1u;
        exp = x.exp - y.exp - 2 * i32(steps) + 1;
    }
    // The result and the remainder of a root: two words each, the high word first.
    var result = vec2<u32>();
    var left = vec2<u32>();
    for (var i = 0u; i < steps; i++) {
        let begun = vec2<u32>(rest, digits);
        let pair = n_digit(select(n_digit(begun, divisor), begun, skip == 1u), divisor);
        rest = pair.x;
        digits = pair.y;
        skip = 0u;
        let quadruple = vec2<u32>((result.x << 2u) | (result.y >> 30u), result.y << 2u);
        if root {
            left = vec2<u32>((left.x << 2u) | (left.y >> 30u), (left.y << 2u) | digits);
            let trial = quadruple.y | 1u;
            let fits = left.x > quadruple.x || (left.x == quadruple.x && left.y >= trial);
            if fits {
                left = vec2<u32>(left.x - quadruple.x - select(0u, 1u, left.y < trial), left.y - trial);
            }
            result = vec2<u32>((result.x << 1u) | (result.y >> 31u), (result.y << 1u) | select(0u, 1u, fits));
        } else {
            result = vec2<u32>(quadruple.x, quadruple.y | digits);
        }
        digits = 0u;
    }
    let sticky = select(0u, 1u, (rest | left.x | left.y) != 0u);
    return Real(nan || infinite || pole || zero, raw, sign, exp - 32, vec3<u32>(result.x, result.y, sticky));
}

// Upper half of a product, too small by at most 4 units.
fn n_mul96(a: vec3<u32>, b: vec3<u32>) -> vec3<u32> {
    let high = n_mul32(a.x, b.x);
    let one = n_mul32(a.x, b.y);
    let two = n_mul32(a.y, b.x);
    let low = vec3<u32>(n_mul32(a.y, b.y).x, n_mul32(a.x, b.z).x, n_mul32(a.z, b.x).x);
    var sum = n_add96(vec3<u32>(high.x, high.y, one.y), vec3<u32>(0u, one.x, two.y), 0u);
    sum = n_add96(sum, vec3<u32>(0u, two.x, low.x), 0u);
    sum = n_add96(sum, vec3<u32>(0u, 0u, low.y), 0u);
    return n_add96(sum, vec3<u32>(0u, 0u, low.z), 0u);
}

// p / k for k below 2^16.
fn n_div96(p: vec3<u32>, k: u32) -> vec3<u32> {
    var rest = 0u;
    var source = p;
    var to = vec3<u32>();
    for (var i = 0u; i < 6u; i++) {
        rest = (rest << 16u) | (source.x >> 16u);
        let digit = rest / k;
        rest -= digit * k;
        source = (source << vec3<u32>(16u)) | (vec3<u32>(source.y, source.z, 0u) >> vec3<u32>(16u));
        to = (to << vec3<u32>(16u)) | (vec3<u32>(to.y, to.z, digit << 16u) >> vec3<u32>(16u));
    }
    return to;
}

// 2^x and log2 x, accurate to 2^-90 and 2^-84 (2^-80 for normalized numbers). Inexact results are irrational, and no
// operand of any format is expected to have a result nearer than 2^-64 to a rounding boundary.
fn n_power(op: u32, f: Format, x: Number) -> Real {
    let exponential = op == N_EXP2;
    if x.kind == 2u {
        return n_known(n_nan(f));
    }
    let empty = x.kind == 0u && x.sig == 0u;
    var whole = x.exp + 31;
    var u = vec3<u32>(x.sig, 0u, 0u);
    if exponential {
        if x.kind == 1u {
            return n_known(select(n_infinite(f, 0u), n_zero(f, 0u), x.sign == 1u));
        }
        let far = whole >= 20;
        var integral = far || empty || i32(countTrailingZeros(x.sig)) >= -x.exp;
        whole = select(i32(n_shift(x.sig, x.exp)), N_FAR, far);
        // The fraction in units of 2^-96; for a negative number, complemented below to x - floor(x).
        let s = x.exp + 96;
        u = vec3<u32>(n_shift(x.sig, s - 64), n_shift(x.sig, s - 32), n_shift(x.sig, s));
        if (HAS_NORMALIZED) {
            if f.over != 0u {
                let part = u32(whole) % f.over;
                whole = whole / i32(f.over);
                integral = part == 0u;
                u = n_times(n_div96(vec3<u32>(part << 24u, 0u, 0u), f.over), 256u);
            }
        }
        if x.sign == 1u {
            whole = select(-whole - 1, -whole, integral);
            u = n_add96(~u, vec3<u32>(), select(1u, 0u, s < 0));
        }
        if !n_is_float(f) && f.overflow == 1u && whole >= i32(f.upper - 32u + countLeadingZeros(f.over)) {
            return n_known(n_extreme(f, 0u));
        }
        if integral {
            return Real(false, 0u, 0u, whole, vec3<u32>(0u, 0u, 1u));
        }
    } else {
        if empty {
            return n_known(n_pole(f, 1u));
        }
        if x.sign == 1u {
            return n_known(n_nan(f));
        }
        if x.kind == 1u {
            return n_known(n_infinite(f, 0u));
        }
        var power = x.sig == 0x80000000u;
        if (HAS_NORMALIZED) {
            // The quotient, shifted until its leading bit is in place.
            power = x.sig == n_whole(n_over(f)).sig;
            u = n_div96(u, n_over(f));
            let zeros = countLeadingZeros(u.x) & 31u;
            u = n_times(u, 1u << zeros);
            whole -= i32(zeros);
        }
        if power {
            return Real(false, 0u, select(0u, 1u, whole < 0), 0, vec3<u32>(0u, 0u, u32(abs(whole))));
        }
    }
    // Exponential: the first step computes t = u ln 2, each further step 1 + t v / k, for k from 27 down: e^t in units
    // of 2^-94. Logarithm: squaring doubles it, so each square that reaches 2 yields the binary digit 1.
    let one = vec3<u32>(0x40000000u, 0u, 0u);
    var v = select(u, vec3<u32>(0xb17217f7u, 0xd1cf79abu, 0xc9e3b398u), exponential);
    var digits = vec3<u32>();
    let steps = select(84u, 28u, exponential);
    for (var i = 0u; i < steps; i++) {
        let p = n_mul96(u, v);
        if exponential {
            if i == 0u {
                u = p;
                v = one;
            } else {
                v = n_add96(one, n_div96(p, 28u - i), 0u);
            }
        } else {
            let passed = p.x >> 31u;
            u = n_add96(p, select(p, vec3<u32>(), passed == 1u), 0u);
            v = u;
            digits = n_add96(digits, digits, passed);
        }
    }
    if exponential {
        return Real(false, 0u, 0u, whole - 94, v | vec3<u32>(0u, 0u, 1u));
    }
    digits.x += u32(whole) << 20u;
    // Digits are truncated toward minus infinity, so the magnitude of a negative number is one less.
    let negative = whole < 0;
    let magnitude = select(digits, ~digits, negative);
    return Real(false, 0u, select(0u, 1u, negative), -84, magnitude | vec3<u32>(0u, 0u, 1u));
}

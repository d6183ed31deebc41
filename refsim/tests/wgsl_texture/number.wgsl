struct Format {
    kind: u32, upper: u32, frac: u32, rounding: u32, overflow: u32, denormals: u32, special: u32, spare: u32,
}

fn n_nan(f: Format) -> u32 { return select(0u, 0x7fc00000u, f.kind == 1u); }

fn n_extreme(f: Format, negative: bool) -> u32 {
    if (f.kind == 0u) {
        let most = (1u << (f.upper + f.frac)) - 1u;
        return select(most, ~most, negative);
    }
    return n_widened(f, negative, (((1u << f.upper) - 1u) << f.frac) - 1u);
}

fn n_infinite(f: Format, negative: bool) -> u32 {
    if (f.kind == 0u) { return n_extreme(f, negative); }
    return select(0x7f800000u, 0xff800000u, negative);
}

fn n_widened(f: Format, negative: bool, pattern: u32) -> u32 {
    let sign = select(0u, 0x80000000u, negative);
    let field = pattern >> f.frac;
    let fraction = pattern & ((1u << f.frac) - 1u);
    let rebias = 127u - ((1u << (f.upper - 1u)) - 1u);
    if (field == (1u << f.upper) - 1u) { return sign | 0x7f800000u; }
    if (field != 0u) { return sign | ((field + rebias) << 23u) | (fraction << (23u - f.frac)); }
    if (fraction == 0u) { return sign; }
    if (rebias == 0u) { return sign | (fraction << (23u - f.frac)); }
    let left = countLeadingZeros(fraction) - (31u - f.frac);
    return sign | ((rebias + 1u - left) << 23u) | (((fraction << left) & ((1u << f.frac) - 1u)) << (23u - f.frac));
}

fn n_up(f: Format, negative: bool, odd: bool, half: bool, below: bool) -> u32 {
    var up = false;
    switch f.rounding {
        case 0u: { up = half && (below || odd); }
        case 1u: { up = half; }
        case 2u: { up = false; }
        default: { up = negative && (half || below); }
    }
    return select(0u, 1u, up);
}

fn n_shifted(f: Format, negative: bool, sig: vec2<u32>, shift: i32, sticky: bool) -> vec2<u32> {
    if (shift <= 0) { return texture_left(sig, u32(-shift)); }
    if (shift > 64) { return vec2<u32>(n_up(f, negative, false, false, sticky || any(sig != vec2<u32>(0u))), 0u); }
    let half_place = texture_right(sig, u32(shift - 1));
    let half = (half_place.x & 1u) == 1u;
    let below = sticky || any(texture_left(half_place, u32(shift - 1)) != sig);
    let kept = texture_right(sig, u32(shift));
    return texture_add(kept, vec2<u32>(n_up(f, negative, (kept.x & 1u) == 1u, half, below), 0u));
}

fn n_clz(a: vec2<u32>) -> u32 {
    if (a.y != 0u) { return countLeadingZeros(a.y); }
    return 32u + countLeadingZeros(a.x);
}

fn n_round(f: Format, negative: bool, sig: vec2<u32>, exponent: i32, sticky: bool) -> u32 {
    let zero = all(sig == vec2<u32>(0u));
    if (f.kind == 0u) {
        let shift = -(exponent + i32(f.frac));
        let kept = n_shifted(f, negative, sig, shift, sticky);
        let over = shift <= 0 && !zero && n_clz(sig) < u32(-shift);
        let bits = f.upper + f.frac;
        let limit = (1u << bits) - select(1u, 0u, negative);
        var low = kept.x;
        if (negative) { low = 0u - low; }
        if ((over || kept.y != 0u || kept.x > limit) && f.overflow != 1u) { return n_extreme(f, negative); }
        return bitcast<u32>(bitcast<i32>(low << (31u - bits)) >> (31u - bits));
    }
    if (zero && !sticky) { return select(0u, 0x80000000u, negative); }
    let man = i32(f.frac);
    let least = 2 - (1 << (f.upper - 1u));
    let left = n_clz(sig) & 63u;
    let s = texture_left(sig, left);
    let e = exponent - i32(left);
    let top = select(e + 63, e - 1, zero);
    let unit = max(top - man, least - man);
    let kept = n_shifted(f, negative, s, unit - e, sticky);
    let infinity = ((1u << f.upper) - 1u) << f.frac;
    let far = unit - least + man >= (1 << f.upper);
    let magnitude = (u32(unit - least + man) << f.frac) + kept.x;
    if (far || magnitude >= infinity) {
        var infinite = false;
        switch f.overflow {
            case 0u: { }
            case 3u: { infinite = top > 1 - least; }
            default: { infinite = f.rounding < 2u || (f.rounding == 3u && negative); }
        }
        if (infinite) { return n_infinite(f, negative); }
        return n_extreme(f, negative);
    }
    if (f.denormals == 1u && (magnitude >> f.frac) == 0u) { return select(0u, 0x80000000u, negative); }
    return n_widened(f, negative, magnitude);
}

fn s_alu(code: u32, a: u32, b0: u32) -> u32 {
    let f = Format(1u, 8u, 23u, 0u, 2u, 0u, 0u, 0u);
    var b = b0;
    if (code == 1u) { b = b ^ 0x80000000u; }
    let ma = a & 0x7fffffffu;
    let mb = b & 0x7fffffffu;
    if (ma > 0x7f800000u || mb > 0x7f800000u) { return 0x7fc00000u; }
    let sign = ((a ^ b) >> 31u) == 1u;
    let ia = ma == 0x7f800000u;
    let ib = mb == 0x7f800000u;
    var sa = (ma & 0x7fffffu) | select(0u, 0x800000u, ma >= 0x800000u);
    var sb = (mb & 0x7fffffu) | select(0u, 0x800000u, mb >= 0x800000u);
    var ea = i32(max(ma >> 23u, 1u)) - 150;
    var eb = i32(max(mb >> 23u, 1u)) - 150;
    var negative = sign;
    var sig = vec2<u32>(0u);
    var e = 0;
    var sticky = false;
    if (code < 2u) {
        if (ia && ib) { return select(a, 0x7fc00000u, sign); }
        if (ia) { return a; }
        if (ib) { return b; }
        if (ma == 0u && mb == 0u) { return a & b; }
        var na = (a >> 31u) == 1u;
        if (ma < mb) {
            let t = sa; sa = sb; sb = t;
            let u = ea; ea = eb; eb = u;
            na = (b >> 31u) == 1u;
        }
        let high = texture_left(vec2<u32>(sa, 0u), 37u);
        let whole = texture_left(vec2<u32>(sb, 0u), 37u);
        let low = texture_right(whole, u32(ea - eb));
        sticky = any(texture_left(low, u32(ea - eb)) != whole);
        e = ea - 37;
        negative = na;
        if (sign) {
            sig = texture_add(high, texture_negated(low));
            if (all(sig == vec2<u32>(0u)) && !sticky) { return 0u; }
            if (sticky) { sig = texture_add(sig, vec2<u32>(0xffffffffu)); }
        } else {
            sig = texture_add(high, low);
        }
    } else if (code == 2u) {
        if ((ia && mb == 0u) || (ib && ma == 0u)) { return 0x7fc00000u; }
        if (ia || ib) { return select(0x7f800000u, 0xff800000u, sign); }
        sig = texture_wide(sa, sb);
        e = ea + eb;
    } else {
        if ((ia && ib) || (ma == 0u && mb == 0u)) { return 0x7fc00000u; }
        if (ia || mb == 0u) { return select(0x7f800000u, 0xff800000u, sign); }
        if (ib || ma == 0u) { return select(0u, 0x80000000u, sign); }
        let la = countLeadingZeros(sa) - 8u;
        let lb = countLeadingZeros(sb) - 8u;
        sa <<= la; ea -= i32(la);
        sb <<= lb; eb -= i32(lb);
        var rest = sa;
        for (var k = 0u; k < 40u; k++) {
            sig = texture_left(sig, 1u);
            if (rest >= sb) { rest -= sb; sig.x |= 1u; }
            rest <<= 1u;
        }
        sticky = rest != 0u;
        e = ea - eb - 39;
    }
    return n_round(f, negative, sig, e, sticky);
}

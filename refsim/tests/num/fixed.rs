//! Fixed point compared with plain integers.

use refsim::num::{Format, Rounding, ops};

/// Widths up to 32 bits, with the widest intermediate results.
#[test]
fn wide_fixed_point_equals_integers() {
    let mut cases = crate::random::Random::new(7);
    for (int_bits, frac_bits) in [(0, 31), (31, 0), (15, 16), (1, 30), (8, 23), (3, 12), (1, 10)] {
        let f = Format::fixed(int_bits, frac_bits).expect("a format").with_rounding(Rounding::Down);
        let signed = |bits: u32| i128::from((bits << (32 - f.width())).cast_signed() >> (32 - f.width()));
        let fit = |exact: i128| {
            let end = 1i128 << (f.width() - 1);
            exact.clamp(-end, end - 1) as u32 & f.mask()
        };
        for _ in 0..20_000 {
            let [a, b, c] = std::array::from_fn(|_| {
                let r = cases.next();
                (r as u32).cast_signed() >> (r >> 59)
            });
            let [a, b, c] = [a, b, c].map(|x| x.cast_unsigned() & f.mask());
            let (x, y, z) = (signed(a), signed(b), signed(c));
            assert_eq!(ops::add(f, a, b).bits, fit(x + y), "{f} {a:#x} + {b:#x}");
            assert_eq!(ops::sub(f, a, b).bits, fit(x - y), "{f} {a:#x} - {b:#x}");
            assert_eq!(ops::mul(f, a, b).bits, fit((x * y) >> frac_bits), "{f} {a:#x} * {b:#x}");
            let fused = ((x * y) + (z << frac_bits)) >> frac_bits;
            assert_eq!(ops::fused_mad(f, a, b, c).bits, fit(fused), "{f} {a:#x} * {b:#x} + {c:#x}");
            if y != 0 {
                let (n, d) = if y < 0 { (-x, -y) } else { (x, y) };
                assert_eq!(ops::div(f, a, b).bits, fit((n << frac_bits).div_euclid(d)), "{f} {a:#x} / {b:#x}");
            }
            if x >= 0 {
                let root = (x << frac_bits).isqrt();
                assert_eq!(ops::sqrt(f, a).bits, fit(root), "{f} sqrt {a:#x}");
            }
        }
    }
}

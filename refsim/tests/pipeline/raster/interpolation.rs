//! Attribute interpolation.

use super::support::{CONVENTIONS, RULES, set_up, state};
use proptest::prelude::*;
use refsim::num::Format;
use refsim::raster::{ComponentMask, RasterRules, Vertex};

fn value() -> impl Strategy<Value = f32> {
    prop_oneof![-2.0f32..2.0, -1e6f32..1e6, Just(0.0), Just(1.0)]
}

fn corner() -> impl Strategy<Value = Vertex> {
    ([-1.2f32..1.2, -1.2f32..1.2, 0.0f32..1.0], prop_oneof![Just(1.0f32), 0.2f32..5.0], [value(), value(), value()])
        .prop_map(|([x, y, z], w, [a, b, c])| {
            let mut v = Vertex { position: [x * w, y * w, (z * w).min(w), w].map(f32::to_bits), ..Vertex::default() };
            v.texcoords[2][1] = a.to_bits();
            v.colors[1][3] = b.to_bits();
            v.fog = c.to_bits();
            v.texcoords[7][0] = 0xffc0_1234; // a NaN with a payload, the same everywhere
            v
        })
}

proptest! {
    /// The definition, implemented in host floats on the public set-up data, produces the same bits.
    #[test]
    fn host_floats_give_the_same_bits(v in [corner(), corner(), corner()], x in 0u32..64, y in 0u32..64) {
        let s = state(64, 64, CONVENTIONS[0]);
        for done in set_up([&v[0], &v[1], &v[2]], &s, &RULES).0 {
            let f = f32::from_bits;
            let area = done.area as f32;
            prop_assert_eq!(area.to_bits(), done.area_bits);
            let (mut l1, mut l2) = (done.edges[1].at(x, y) as f32 / area, done.edges[2].at(x, y) as f32 / area);
            let depth = (f(done.depth.base) + l1 * f(done.depth.d1)) + l2 * f(done.depth.d2);
            if !done.affine {
                let l0 = (1.0 - l1) - l2;
                let g = [l0, l1, l2].map(f32::to_bits);
                let g: [f32; 3] = std::array::from_fn(|i| f(g[i]) * f(done.reciprocal_w[i]));
                let sum = (g[0] + g[1]) + g[2];
                (l1, l2) = (g[1] / sum, g[2] / sum);
            }
            let found = done.interpolate(x, y, ComponentMask::ALL);
            let canonical = |v: f32| if v.is_nan() { 0x7fc0_0000 } else { v.to_bits() };
            if !done.depth_constant {
                prop_assert_eq!(found.depth, canonical(depth));
            }
            for (component, bits) in [(9, found.t[2][1]), (39, found.v[1][3]), (40, found.fog)] {
                let p = done.planes[component];
                let want = (f(p.base) + l1 * f(p.d1)) + l2 * f(p.d2);
                prop_assert_eq!(bits, if done.constant.has(component) { p.base } else { canonical(want) });
            }
            prop_assert!(done.constant.has(28));
            prop_assert_eq!(found.t[7][0], 0xffc0_1234);
            // Components not requested are 0; requested ones do not depend on the others.
            let few = done.interpolate(x, y, ComponentMask::NONE.with_texcoord(2));
            prop_assert_eq!((few.t[2], few.v, few.fog), (found.t[2], [[0; 4]; 2], 0));
        }
    }

    /// Perspective: attributes are linear in clip space. Compared with the f64 solution.
    #[test]
    fn perspective_is_right(ws in [0.5f32..4.0, 0.5f32..4.0, 0.5f32..4.0], values in [-1.0f32..1.0, -1.0f32..1.0, -1.0f32..1.0]) {
        let places = [[-0.9f32, 0.9], [0.9, 0.8], [-0.2, -0.9]];
        let v: [Vertex; 3] = std::array::from_fn(|i| {
            let w = ws[i];
            let mut v = Vertex { position: [places[i][0] * w, places[i][1] * w, 0.5 * w, w].map(f32::to_bits), ..Vertex::default() };
            v.texcoords[0][0] = values[i].to_bits();
            v
        });
        let s = state(64, 64, CONVENTIONS[2]);
        let done = set_up([&v[0], &v[1], &v[2]], &s, &RULES).0.remove(0);
        for (x, y) in [(20, 20), (30, 10), (31, 40)] {
            let e: [f64; 3] = std::array::from_fn(|i| done.edges[i].at(x, y) as f64 / done.area as f64 / f64::from(ws[i]));
            let want = (0..3).map(|i| e[i] * f64::from(values[i])).sum::<f64>() / e.iter().sum::<f64>();
            let found = f64::from(f32::from_bits(done.interpolate(x, y, ComponentMask::ALL).t[0][0]));
            prop_assert!((found - want).abs() < 2e-6, "{} {}", found, want);
        }
    }

    /// With another iterator format, every step is rounded to that format.
    #[test]
    fn iterator_formats_are_obeyed(v in [corner(), corner(), corner()], x in 0u32..64, y in 0u32..64, which in 0usize..3) {
        let format = [Format::FP16, Format::S3_12, Format::FP24][which];
        let rules = RasterRules { iterator_format: format, ..RULES };
        for done in set_up([&v[0], &v[1], &v[2]], &state(64, 64, CONVENTIONS[0]), &rules).0 {
            let bits = done.interpolate(x, y, ComponentMask::ALL).v[1][3];
            let there = refsim::num::ops::convert(&Format::FP32, format, bits);
            prop_assert!(there.flags.is_empty(), "{:#x} is not a value of {}", bits, format);
        }
    }
}

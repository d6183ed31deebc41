//! Tests every arithmetic operation of the scalar executor against the steps in its documentation, carried out with the
//! operations of `num`.

use crate::random::Random;
use crate::running::{bits, constants, ideal, into, run, run_vertex};
use refsim::device::{LrpMode, MadMode, Profile, Rules};
use refsim::exec::Constants;
use refsim::num::{DotOrder, Format, ops};

type V = [u32; 4];

/// Reference operations under a device's rules.
struct Reference<'a>(&'a Rules, Format);

impl Reference<'_> {
    fn add(&self, a: u32, b: u32) -> u32 {
        ops::add(self.1, a, b).bits
    }
    fn sub(&self, a: u32, b: u32) -> u32 {
        ops::sub(self.1, a, b).bits
    }
    fn mul(&self, a: u32, b: u32) -> u32 {
        ops::mul(self.1, a, b).bits
    }
    fn mad(&self, a: u32, b: u32, c: u32) -> u32 {
        match self.0.mad {
            MadMode::TwoRoundings => self.add(self.mul(a, b), c),
            MadMode::Fused => ops::fused_mad(self.1, a, b, c).bits,
        }
    }
    fn dot(&self, n: usize, a: &V, b: &V) -> u32 {
        let terms: Vec<(u32, u32)> = (0..n).map(|i| (a[i], b[i])).collect();
        ops::dot(self.1, self.0.dot, &terms).bits
    }
    fn neg(&self, a: u32) -> u32 {
        ops::neg(self.1, a).bits
    }
    fn lrp(&self, s: u32, a: u32, b: u32) -> u32 {
        match self.0.lrp {
            LrpMode::SubMulAdd => self.mad(s, self.sub(a, b), b),
            LrpMode::TwoProducts => self.add(self.mul(s, a), self.mul(self.sub(self.1.one(), s), b)),
        }
    }

    /// Expected result of an operation.
    fn expected(&self, op: &str, s: &[V; 3]) -> V {
        let f = self.1;
        let [a, b, c] = s;
        let each = |g: &dyn Fn(usize) -> u32| [g(0), g(1), g(2), g(3)];
        match op {
            "mov" => *a,
            "add" => each(&|i| self.add(a[i], b[i])),
            "sub" => each(&|i| self.sub(a[i], b[i])),
            "mul" => each(&|i| self.mul(a[i], b[i])),
            "mad" => each(&|i| self.mad(a[i], b[i], c[i])),
            "lrp" => each(&|i| self.lrp(a[i], b[i], c[i])),
            "dp3" => [self.dot(3, a, b); 4],
            "dp4" => [self.dot(4, a, b); 4],
            "cnd" => each(&|i| ops::cnd(f, a[i], b[i], c[i]).bits),
            "cmp" => each(&|i| ops::cmp(f, a[i], b[i], c[i]).bits),
            "abs" => each(&|i| ops::abs(f, a[i]).bits),
            "min" => each(&|i| ops::min(f, a[i], b[i]).bits),
            "max" => each(&|i| ops::max(f, a[i], b[i]).bits),
            "frc" => each(&|i| ops::frc(f, a[i]).bits),
            "rcp" => [ops::rcp(f, a[0]).bits; 4],
            "rsq" => [ops::rsq(f, a[0]).bits; 4],
            "exp" => [ops::exp2(f, a[0]).bits; 4],
            "log" => [ops::log2(f, a[0]).bits; 4],
            "pow" => [ops::exp2(f, self.mul(b[0], ops::log2(f, a[0]).bits)).bits; 4],
            "crs" => {
                let part = |i: usize, j: usize| self.mad(a[i], b[j], self.neg(self.mul(a[j], b[i])));
                [part(1, 2), part(2, 0), part(0, 1), 0]
            }
            "nrm" => {
                let factor = ops::rsq(f, self.dot(3, a, a)).bits;
                each(&|i| self.mul(a[i], factor))
            }
            _ => panic!("no expectation for {op}"),
        }
    }
}

/// Vectors with components in [-1, 1).
fn vectors(random: &mut Random) -> [[f32; 4]; 3] {
    let mut next = || random.between(-1.0, 1.0);
    let mut vector = || [next(), next(), next(), next()];
    [vector(), vector(), vector()]
}

fn profiles() -> Vec<Profile> {
    let mut out = Vec::new();
    for format in ["s3.12", "s3.12:rdn:wrap", "n3.8:rna", "e5m10", "e7m16:rtz:ftz", "e8m23"] {
        for (mad, dot, lrp) in [("two-roundings", "sequential", "sub-mul-add"), ("fused", "exact", "two-products")] {
            let mut profile = ideal(format);
            profile.set_switch("mad", mad).unwrap();
            profile.set_switch("dot", dot).unwrap();
            profile.set_switch("lrp", lrp).unwrap();
            out.push(profile);
        }
    }
    let mut tree = ideal("e5m10");
    tree.rules.dot = DotOrder::Tree;
    out.push(tree);
    out
}

#[test]
fn operations_are_their_documented_steps() {
    let (ps_1_4, ps_2_0) = (("ps_1_4", "mov r0, r4"), ("ps_2_0", "mov oC0, r4"));
    let table = [
        (ps_1_4, "mov", 1, ""),
        (ps_1_4, "add", 2, ""),
        (ps_1_4, "sub", 2, ""),
        (ps_1_4, "mul", 2, ""),
        (ps_1_4, "mad", 3, ""),
        (ps_1_4, "lrp", 3, ""),
        (ps_1_4, "dp3", 2, ""),
        (ps_1_4, "dp4", 2, ""),
        (ps_1_4, "cnd", 3, ""),
        (ps_1_4, "cmp", 3, ""),
        (ps_2_0, "abs", 1, ""),
        (ps_2_0, "min", 2, ""),
        (ps_2_0, "max", 2, ""),
        (ps_2_0, "frc", 1, ""),
        (ps_2_0, "rcp", 1, ".x"),
        (ps_2_0, "rsq", 1, ".x"),
        (ps_2_0, "exp", 1, ".x"),
        (ps_2_0, "log", 1, ".x"),
        (ps_2_0, "pow", 2, ".x"),
        (ps_2_0, "nrm", 1, ""),
        (ps_2_0, "mad", 3, ""),
        (ps_2_0, "lrp", 3, ""),
        (ps_2_0, "dp4", 2, ""),
        (ps_2_0, "cmp", 3, ""),
    ];
    let mut random = Random::new(1);
    for profile in profiles() {
        let format = profile.rules.format;
        let reference = Reference(&profile.rules, format);
        for ((version, end), op, count, suffix) in table {
            for _ in 0..8 {
                let mut values = vectors(&mut random);
                if matches!(op, "rsq" | "log" | "pow") {
                    values[0][0] = values[0][0].abs() + 0.01;
                }
                let operands = (0..count).map(|i| format!("r{i}{suffix}")).collect::<Vec<_>>().join(", ");
                let text = format!("{version}\nmov r0, c0\nmov r1, c1\nmov r2, c2\n{op} r4, {operands}\n{end}");
                let ran = run(&text, &profile, &values);
                let s = values.map(|v| into(format, v));
                assert_eq!(ran.value(3), reference.expected(op, &s), "{op} in {format}: {values:?}");
            }
        }
    }
}

#[test]
fn cross_products_dp2add_and_matrices() {
    let mut random = Random::new(3);
    for profile in profiles() {
        let format = profile.rules.format;
        let reference = Reference(&profile.rules, format);
        let values = vectors(&mut random);
        let [a, b, c] = values.map(|v| into(format, v));
        let load = "ps_2_0\nmov r0, c0\nmov r1, c1\nmov r2, c2\n";
        let ran = run(&format!("{load}crs r3.xyz, r0, r1\nmov r3.w, r0.x\nmov oC0, r3"), &profile, &values);
        assert_eq!(ran.value(3)[..3], reference.expected("crs", &[a, b, c])[..3], "crs in {format}");
        let ran = run(&format!("{load}dp2add r3, r0, r1, r2.z\nmov oC0, r3"), &profile, &values);
        assert_eq!(ran.value(3), [reference.add(reference.dot(2, &a, &b), c[2]); 4], "dp2add in {format}");
        for (op, rows, terms, mask) in [("m3x2", 2, 3, "xy"), ("m3x3", 3, 3, "xyz"), ("m4x3", 3, 4, "xyz")] {
            let text = format!("{load}{op} r3.{mask}, r2, c0\nmov oC0, r2");
            let ran = run(&text, &profile, &values);
            let matrix = [a, b, c];
            for (row, vector) in matrix.iter().enumerate().take(rows) {
                assert_eq!(ran.value(3)[row], reference.dot(terms, &c, vector), "{op} row {row} in {format}");
            }
        }
    }
}

#[test]
fn sincos_is_the_half_angle_series() {
    let first = [-1.550_099_2e-6, -2.170_139e-5, 0.002_604_166_7, 2.604_166_8e-4];
    let second = [-0.020_833_334, -0.125, 1.0, 0.5];
    let profile = ideal("e8m23");
    for x in [-3.1f32, -1.0, -0.25, 0.0, 0.5, 1.5, 3.0] {
        let text = "ps_2_0\nmov r0, c2\nsincos r1.xy, r0.x, c0, c1\nmov r0.xy, r1\nmov oC0, r0";
        // c0 and c1 hold the coefficients: two constants in one instruction.
        let ran = run(text, &profile, &[first, second, [x, 0.0, 0.0, 0.0]]);
        let [cos, sin, ..] = ran.value(1).map(f32::from_bits);
        // Direct3D promises an error of at most 0.002; the series itself is worst at pi.
        assert!((cos * cos + sin * sin - 1.0).abs() < 4e-3, "{x}: {cos} {sin}");
        if x == 0.0 {
            assert_eq!((cos, sin), (1.0, 0.0));
        }
        if x == 0.5 {
            assert!((cos - 0.877_582_6).abs() < 1e-6 && (sin - 0.479_425_55).abs() < 1e-6, "{cos} {sin}");
        }
        if x == 3.0 {
            assert!((cos + 0.989_992_5).abs() < 2e-3 && (sin - 0.141_120).abs() < 2e-3, "{cos} {sin}");
        }
    }
}

#[test]
fn nrm_of_a_zero_vector_is_zero() {
    for format in ["s3.12", "e5m10", "e8m23"] {
        let profile = ideal(format);
        let text = "ps_2_0\nmov r0, c0\nnrm r1, r0\nmov oC0, r1";
        assert_eq!(run(text, &profile, &[[0.0; 4]]).value(1), [0; 4], "{format}");
    }
}

#[test]
fn vertex_operations() {
    let profile = ideal("e8m23");
    let vs = |body: &str, values: &[[f32; 4]]| {
        let text = format!("vs_1_1\ndcl_position v0\ndcl_normal v1\nmov oPos, v0\n{body}");
        run_vertex(&text, &profile, &Constants::default(), values).vertex.texcoords[0]
    };
    let (a, b) = ([0.5, -2.0, 3.0, 4.0], [0.5, 1.0, -3.0, 2.0]);
    assert_eq!(vs("sge oT0, v0, v1", &[a, b]), bits([1.0, 0.0, 1.0, 1.0]));
    assert_eq!(vs("slt oT0, v0, v1", &[a, b]), bits([0.0, 1.0, 0.0, 0.0]));
    assert_eq!(vs("dst oT0, v0, v1", &[a, b]), bits([1.0, -2.0, 3.0, 2.0]));
    assert_eq!(vs("lit oT0, v0", &[[0.5, 2.0, 9.0, 3.0], b]), bits([1.0, 0.5, 8.0, 1.0]));
    assert_eq!(vs("lit oT0, v0", &[[-0.5, 2.0, 9.0, 3.0], b]), bits([1.0, 0.0, 0.0, 1.0]));
    assert_eq!(vs("expp oT0, v0.w", &[[0.0, 0.0, 0.0, -1.5], b])[..2], bits([0.25, 0.5, 0.0, 0.0])[..2]);
    assert_eq!(vs("logp oT0, v0.w", &[[0.0, 0.0, 0.0, -6.0], b])[..2], bits([2.0, 1.5, 0.0, 0.0])[..2]);
    assert_eq!(vs("mul oT0, v0, -v1.wzyx", &[a, b]), bits([-1.0, -6.0, -3.0, -2.0]));
}

#[test]
fn m4x4_transforms_rows_by_columns() {
    let profile = ideal("e8m23");
    let rows = [[1.0, 2.0, 3.0, 4.0], [0.0, 1.0, 0.0, 5.0], [0.5, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0]];
    let text = "vs_1_1\ndcl_position v0\nm4x4 oPos, v0, c0";
    let result = run_vertex(text, &profile, &constants(&rows), &[[1.0, 2.0, 3.0, 1.0]]);
    assert_eq!(result.vertex.position, bits([18.0, 7.0, 0.5, 1.0]));
    assert_eq!(result.slots, 4, "a matrix product costs its rows");
}

#[test]
fn relative_addresses_reach_their_constant_and_zero_beyond() {
    let profile = ideal("e8m23");
    let values: Vec<[f32; 4]> = (0..10).map(|i| [i as f32; 4]).collect();
    let text = "vs_1_1\ndcl_position v0\nmov a0.x, v0.x\nmov oT0, c[a0.x + 2]\nmov oPos, v0";
    let at = |x: f32| {
        let result = run_vertex(text, &profile, &constants(&values), &[[x, 0.0, 0.0, 1.0]]);
        f32::from_bits(result.vertex.texcoords[0][0])
    };
    // mov to a0 in vs_1_1 rounds down.
    for (x, expected) in [
        (0.0, 2.0),
        (3.9, 5.0),
        (-1.5, 0.0),
        (-2.0, 0.0),
        (-3.0, 0.0),
        (7.0, 9.0),
        (8.0, 0.0),
        (1e30, 0.0),
        (f32::NAN, 2.0),
    ] {
        assert_eq!(at(x), expected, "{x}");
    }
    let nearest = "vs_2_0\ndcl_position v0\nmova a0.y, v0.x\nmov oT0, c[a0.y + 2]\nmov oPos, v0";
    let result = run_vertex(nearest, &profile, &constants(&values), &[[3.9, 0.0, 0.0, 1.0]]);
    assert_eq!(f32::from_bits(result.vertex.texcoords[0][0]), 6.0, "mova rounds to nearest");
}

#[test]
fn vertex_colors_are_clamped_and_coordinates_are_not() {
    let profile = ideal("e8m23");
    let text = "vs_1_1\ndcl_position v0\nmov oPos, v0\nmov oD0, v0\nmov oT3, v0";
    let vertex = run_vertex(text, &profile, &Constants::default(), &[[-1.0, 0.5, 7.0, 1.0]]).vertex;
    assert_eq!(vertex.colors[0], bits([0.0, 0.5, 1.0, 1.0]));
    assert_eq!(vertex.texcoords[3], bits([-1.0, 0.5, 7.0, 1.0]));
}

//! All executors produce bit-identical results.
//!
//! A suite draws cases from a seed: a program, a device, a scene. The scalar executor and every other executor, at
//! every SIMD level and thread count, draw each case, and all targets, the depth buffer and every counter are compared.
//! A failing case is shrunk, and printed with the command that reproduces it: the suite's name and `CROSSBAR_SEED`.
//! `CROSSBAR_FULL=1` runs 105 times as many cases, `CROSSBAR_FUZZ=10m` runs for ten minutes.

mod agreement;
mod all_frequency;
mod bi_scale;
mod blame;
mod constants;
mod coverage;
mod dice;
#[path = "../../refsim/tests/common/environment.rs"]
mod environment;
mod executors;
mod files;
mod fuzz;
mod generate;
mod mipmaps;
mod planted;
mod prt;
mod radiosity;
#[path = "../../refsim/tests/common/random.rs"]
mod random;
mod rules;
mod scene;
mod shapes;
mod shrink;
mod steps;
mod subsurface;
mod suite;
mod system;
mod traces;

/// Runs the suite with a test's name: the test's path without the crate.
fn suite(module: &str, test: &str) {
    let path = module.split_once("::").map_or(String::new(), |(_, path)| format!("{path}::"));
    let name = format!("{path}{test}");
    let suites = suite::all();
    let suite = suites.iter().find(|s| s.name == name).unwrap_or_else(|| panic!("no suite is called {name}"));
    agreement::run(suite);
}

/// One test per suite.
macro_rules! suites {
    ($($test:ident)*) => {
        $(#[test] fn $test() { crate::suite(module_path!(), stringify!($test)); })*
    };
}

/// One module per family of formats, with a suite per group of rules.
macro_rules! families {
    ($groups:tt $($family:ident)*) => {
        $(mod $family { suites! $groups })*
    };
}

macro_rules! versions {
    ($groups:tt $($version:ident)*) => {
        $(mod $version { families! { $groups s3_12 short_fixed long_fixed fp16 fp24 fp32 odd_float units } })*
    };
}

/// Random programs: version, family of formats, group of rules.
mod programs {
    versions! { { arithmetic sampling pipeline together } ps_1_1 ps_1_2 ps_1_3 ps_1_4 ps_2_0 ps_2_a ps_2_b }
    versions! { { arithmetic sampling pipeline together } fp_1_0 arbfp_1_0 }
    versions! { { arithmetic together } vs_1_1 vs_2_0 }
}

/// Random programs whose instructions have their own formats.
mod mixed {
    suites! { ps_1_1 ps_1_2 ps_1_3 ps_1_4 ps_2_0 ps_2_a ps_2_b fp_1_0 arbfp_1_0 vs_1_1 vs_2_0 }
}

/// Random programs on the cards, with every switch set at random.
#[rustfmt::skip]
mod cards {
    mod nv20 { suites! { ps_1_1 vs_1_1 } }
    mod r200 { suites! { ps_1_1 ps_1_2 ps_1_3 ps_1_4 vs_1_1 } }
    mod nv25 { suites! { ps_1_1 ps_1_2 ps_1_3 vs_1_1 } }
    mod r300 { suites! { ps_1_1 ps_1_2 ps_1_3 ps_1_4 ps_2_0 vs_1_1 vs_2_0 arbfp_1_0 } }
    mod nv30 { suites! { ps_1_1 ps_1_2 ps_1_3 ps_1_4 ps_2_0 ps_2_a vs_1_1 vs_2_0 fp_1_0 arbfp_1_0 } }
    mod r350 { suites! { ps_1_1 ps_1_2 ps_1_3 ps_1_4 ps_2_0 vs_1_1 vs_2_0 arbfp_1_0 } }
    mod nv35 { suites! { ps_1_1 ps_1_2 ps_1_3 ps_1_4 ps_2_0 ps_2_a vs_1_1 vs_2_0 fp_1_0 arbfp_1_0 } }
    mod gt200 { suites! { ps_1_1 ps_1_2 ps_1_3 ps_1_4 ps_2_0 ps_2_a ps_2_b vs_1_1 vs_2_0 arbfp_1_0 } }
}

/// Every texel format as a texture.
mod textures {
    suites! {
        a8 l8 la8 l16 bgr233 bgr565 bgrx5551 bgra5551 bgra4444 r8 rg8 rgba8 bgra8 bgrx8 rgb111110 rgb10a2 r16 rg16 rgba16
        r8s rg8s rgba8s r16s rg16s rgba16s l6v5u5 x8l8v8u8 r16f rg16f rgba16f r24f rgba24f r32f rg32f rgba32f
    }
}

/// Every kind of texture, read beyond its edge.
#[rustfmt::skip]
mod addressing {
    mod d1 { suites! { wrap mirror clamp border } }
    mod d2 { suites! { wrap mirror clamp border } }
    mod rectangle { suites! { wrap mirror clamp border } }
    mod cube { suites! { wrap mirror clamp border } }
    mod volume { suites! { wrap mirror clamp border } }
}

/// Every texel format as a target.
mod targets {
    suites! {
        a8 l8 la8 l16 bgr233 bgr565 bgrx5551 bgra5551 bgra4444 r8 rg8 rgba8 bgra8 bgrx8 rgb111110 rgb10a2 r16 rg16 rgba16
        r8s rg8s rgba8s r16s rg16s rgba16s l6v5u5 x8l8v8u8 r16f rg16f rgba16f r24f rgba24f r32f rg32f rgba32f
    }
}

/// Every depth format, every comparison.
mod depth {
    suites! { d16 d24 d32 d32f d24f never less equal less_equal greater not_equal greater_equal always }
}

/// Every blend operation.
mod blending {
    suites! { add subtract reverse_subtract min max }
}

/// Every kind of geometry.
mod geometry {
    suites! { ordinary flat layers clipped huge degenerate special fine }
}

/// Programs and cases that are files of the project. (`files` is the module that reads them.)
mod project {
    suites! { kernels shaders cases }
}

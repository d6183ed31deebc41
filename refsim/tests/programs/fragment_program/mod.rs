//! Tests OpenGL fragment programs on the scalar executor against the two specifications.

mod arb;
mod fog;
mod numbers;
mod position;
mod text;
mod verdicts;

use crate::running::{QuadRun, bits, constants, run_quad};
use refsim::device::Profile;
use refsim::exec::{Constants, PixelBindings};
use refsim::raster::FragmentInput;

/// A GeForce FX 5900 Ultra.
fn nv35() -> Profile {
    Profile::named("nv35").unwrap()
}

/// Runs `!!FP1.0` statements with parameters from `p[0]` on, then outputs R0.
fn run(statements: &str, values: &[[f32; 4]]) -> QuadRun {
    run_with(statements, &constants(values), &FragmentInput::default())
}

fn run_with(statements: &str, host: &Constants, input: &FragmentInput) -> QuadRun {
    let text = format!("!!FP1.0\n{statements}\nMOV o[COLR], R0;\nEND\n");
    run_quad(&text, &nv35(), &PixelBindings::new(host), &[*input; 4])
}

/// Final color of lane 0.
fn color(ran: &QuadRun) -> [f32; 4] {
    ran.results[0].colors[0].map(f32::from_bits)
}

/// Result of one instruction on `p[0]`, as bits.
fn one(instruction: &str, value: [f32; 4]) -> [u32; 4] {
    run(&format!("{instruction};"), &[value]).results[0].colors[0]
}

#[test]
fn registers_start_at_zero_and_do_not_share_what_they_hold() {
    let ran = run("MOVR R1, p[0]; MOVH H2, p[1]; MOVH H3, p[1]; ADDR R0, R1, R5;", &[[1.0, 2.0, 3.0, 4.0], [9.0; 4]]);
    assert_eq!(color(&ran), [1.0, 2.0, 3.0, 4.0]);
}

#[test]
fn condition_codes_are_tested_as_the_table_says() {
    let value = [-1.0, 0.0, 1.0, f32::NAN];
    for (test, want) in [
        ("EQ", [0, 1, 0, 0]),
        ("NE", [1, 0, 1, 1]),
        ("LT", [1, 0, 0, 0]),
        ("LE", [1, 1, 0, 0]),
        ("GT", [0, 0, 1, 0]),
        ("GE", [0, 1, 1, 0]),
        ("TR", [1, 1, 1, 1]),
        ("FL", [0, 0, 0, 0]),
    ] {
        let ran = run(&format!("MOVRC RC, p[0]; MOVR R0 ({test}), {{1, 1, 1, 1}};"), &[value]);
        assert_eq!(color(&ran), want.map(|n: u8| f32::from(n)), "{test}");
        let ran = run(&format!("MOVHC HC, p[0]; MOVR R0 ({test}.wzyx), {{1, 1, 1, 1}};"), &[value]);
        let [x, y, z, w] = want.map(|n: u8| f32::from(n));
        assert_eq!(color(&ran), [w, z, y, x], "{test} swizzled");
    }
}

#[test]
fn condition_codes_start_as_equal_and_change_only_where_something_is_written() {
    let ran = run("MOVR R0 (EQ), p[0];", &[[5.0; 4]]);
    assert_eq!(color(&ran), [5.0; 4]);
    // The mask keeps y, z and w "equal"; then the condition keeps x "less".
    let ran = run(
        "MOVRC R1.x, p[0]; MOVRC R1 (GE), p[1]; MOVR R0 (LT), {1,1,1,1}; MOVR R0 (GT), {2,2,2,2};",
        &[[-1.0; 4], [3.0; 4]],
    );
    assert_eq!(color(&ran), [1.0, 2.0, 2.0, 2.0]);
}

#[test]
fn the_codes_take_the_result_after_saturation_and_in_the_destinations_format() {
    // -1 saturates to 0; 2^-30 is zero in fp16, but not in fp32.
    let ran = run("MOVRC_SAT RC, p[0]; MOVR R0 (EQ), {1,1,1,1};", &[[-1.0; 4]]);
    assert_eq!(color(&ran), [1.0; 4]);
    let tiny = f32::from_bits(0x3080_0000);
    let ran = run("MOVRC HC.x, p[0]; MOVRC RC.y, p[0]; MOVR R0 (EQ), {1,1,1,1};", &[[tiny; 4]]);
    assert_eq!(color(&ran), [1.0, 0.0, 1.0, 1.0]);
}

#[test]
fn kil_asks_the_condition_codes() {
    let killed = |text: &str| run(text, &[[-1.0, 0.0, 1.0, 2.0]]).results[0].killed;
    assert!(killed("MOVRC RC, p[0]; KIL LT;"));
    assert!(!killed("MOVRC RC, p[0]; KIL LT.y;"));
    assert!(killed("MOVRC RC, p[0]; KIL (LT.yyyx);"));
    assert!(!killed("KIL NE;"), "codes start as equal");
    assert!(killed("KIL TR;") && !killed("KIL FL;"));
}

#[test]
fn interpolated_operands_ask_for_full_precision() {
    let third = 1.0_f32 / 3.0;
    let input = crate::running::input(&[[third; 4]]);
    let host = constants(&[[third; 4]]);
    let own = run_with("ADDH R0, f[TEX0], f[TEX0];", &host, &input);
    assert_eq!(color(&own), [third + third; 4]);
    let rounded = run_with("ADDH R0, p[0], p[0];", &host, &input);
    // 1/3 in fp16 is 0x3555.
    assert_eq!(color(&rounded)[0].to_bits(), (0.333_251_95_f32 * 2.0).to_bits());
}

#[test]
fn colors_leave_in_either_precision_and_depth_through_z() {
    let host = constants(&[[0.1, 0.2, 0.3, 0.4]]);
    let ran = run_quad(
        "!!FP1.0\nMOVR o[COLH], p[0];\nMOVR o[DEPR].z, p[0];\nEND",
        &nv35(),
        &PixelBindings::new(&host),
        &[FragmentInput::default(); 4],
    );
    // 0.1 in fp16 is 0x2e66.
    assert_eq!(ran.results[0].colors[0][0], 0x3dcc_c000);
    assert_eq!(ran.results[0].depth.map(|d| d.bits), Some(0.3_f32.to_bits()));
}

#[test]
fn words_keep_their_bits() {
    // Pairs of halves whose word, read as a float, is a NaN or subnormal.
    for halves in [[0x7e01_u32, 0x7fff], [0x0001, 0x0000], [0xffff, 0xff80]] {
        let text = "MOVR R1, R1; MOVRC RC, p[1]; MOVR R2 (GT), R1; UP2H R0, R2.x;";
        let parts =
            halves.map(|h| refsim::num::ops::convert(&nv35().rules.partial.unwrap(), nv35().rules.format, h).bits);
        let host = [parts[0], parts[1], 0, 0].map(f32::from_bits);
        let ran = run(&format!("PK2H R1, p[0]; {text}"), &[host, [1.0; 4]]);
        let got = ran.results[0].colors[0];
        assert_eq!([got[0], got[1]], parts, "{halves:x?}");
    }
}

#[test]
fn packing_rounds_to_the_nearest_step() {
    let word = |name: &str, value: [f32; 4]| {
        // UP4UB unpacks the word, one byte per component.
        run(&format!("{name} R1.x, p[0]; UP4UB R0, R1.x;"), &[value]).results[0].colors[0]
    };
    let bytes = |b: [u8; 4]| b.map(|k| (f32::from(k) / 255.0).to_bits());
    assert_eq!(word("PK4UB", [0.0, 0.5, 1.0, 7.0]), bytes([0, 128, 255, 255]));
    assert_eq!(word("PK4UB", [-1.0, f32::NAN, 0.25, 0.001]), bytes([0, 0, 64, 0]));
    assert_eq!(word("PK4B", [-128.0 / 127.0, -1.0, 0.0, 1.0]), bytes([0, 1, 128, 255]));
    assert_eq!(word("PK4B", [-9.0, 9.0, f32::NAN, -0.5]), bytes([0, 255, 128, 65]));
    assert_eq!(word("PK2US", [1.0, 0.5, 0.0, 0.0]), bytes([255, 255, 0, 128]));
    assert_eq!(word("PK2H", [1.0, -2.0, 0.0, 0.0]), bytes([0x00, 0x3c, 0x00, 0xc0]));
}

#[test]
fn named_constants_are_the_hosts_to_change() {
    let text = "DECLARE gain = {1, 2, 3, 4}; DECLARE bias; MULR R1, gain, gain.w; ADDR R0, R1, bias;";
    let mut host = Constants::default();
    let plain = run_with(text, &host, &FragmentInput::default());
    assert_eq!(color(&plain), [4.0, 8.0, 12.0, 16.0]);
    host.named.insert("bias".to_owned(), bits([0.5; 4]));
    host.named.insert("gain".to_owned(), bits([1.0; 4]));
    host.named.insert("nobody's".to_owned(), bits([9.0; 4]));
    let changed = run_with(text, &host, &FragmentInput::default());
    assert_eq!(color(&changed), [1.5; 4]);
}

#[test]
fn fog_and_colors_are_read() {
    let mut input = FragmentInput { fog: 0.75_f32.to_bits(), ..FragmentInput::default() };
    input.v[1] = bits([0.25, 0.5, 2.0, -1.0]);
    let ran = run_with("MOVR R1, f[FOGC]; MOVR R0, f[COL1]; ADDR R0.x, R0, R1;", &Constants::default(), &input);
    assert_eq!(color(&ran), [1.0, 0.5, 1.0, 0.0]);
}

#[test]
fn derivatives_are_differences_across_the_quad() {
    let inputs = [0.0, 1.0, 10.0, 11.0].map(|x| crate::running::input(&[[x; 4]]));
    let host = Constants::default();
    let text = "!!FP1.0\nDDXR R0.xy, f[TEX0];\nDDYH R0.zw, f[TEX0];\nMOV o[COLR], R0;\nEND";
    let ran = run_quad(text, &nv35(), &PixelBindings::new(&host), &inputs);
    assert_eq!(color(&ran), [1.0, 1.0, 10.0, 10.0]);
}

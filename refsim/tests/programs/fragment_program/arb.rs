//! `!!ARBfp1.0`.

use crate::running::{constants, input, run_quad};
use refsim::device::Profile;
use refsim::exec::{Constants, PixelBindings};
use refsim::raster::FragmentInput;

fn run(device: &str, statements: &str, host: &Constants, from: &FragmentInput) -> ([f32; 4], bool) {
    let text = format!("!!ARBfp1.0\nTEMP a, b, c;\n{statements}\nMOV result.color, a;\nEND\n");
    let profile = Profile::named(device).unwrap();
    let ran = run_quad(&text, &profile, &PixelBindings::new(host), &[*from; 4]);
    let single = |x| refsim::num::ops::convert(&profile.rules.format, refsim::num::Format::FP32, x).bits;
    (ran.results[0].colors[0].map(|x| f32::from_bits(single(x))), ran.results[0].killed)
}

fn color(statements: &str, values: &[[f32; 4]]) -> [f32; 4] {
    run("nv35", statements, &constants(values), &FragmentInput::default()).0
}

#[test]
fn parameters_are_numbered_bound_and_written_out() {
    let host = Constants { float: (0..300).map(|n| [(n as f32).to_bits(); 4]).collect(), ..Constants::default() };
    let text = "PARAM k = {1, 2}; PARAM t[4] = { program.local[5..7], {0.5} }; PARAM e = program.env[3]; ALIAS d = e;
        ATTRIB coords = fragment.texcoord[1];
        ADD a, t[1], t[3].x; MAD a, d, 2, a; ADD a, a, k; ADD a, a, coords;";
    let (got, _) = run("nv35", text, &host, &input(&[[0.0; 4], [1000.0; 4]]));
    // local[6] = 6, env[3] = c259.
    let base = 6.0 + 0.5 + 2.0 * 259.0 + 1000.0;
    assert_eq!(got, [base + 1.0, base + 2.0, base, base + 1.0]);
}

#[test]
fn components_can_be_chosen_one_by_one() {
    assert_eq!(
        color("MOV b, program.local[0]; SWZ a, b, -w, 0, 1, -x;", &[[1.0, 2.0, 3.0, 4.0]]),
        [-4.0, 0.0, 1.0, -1.0]
    );
    assert_eq!(
        color("MOV b, program.local[0]; SWZ a, b, -0, -1, y, z;", &[[1.0, 2.0, 3.0, 4.0]])[1..],
        [-1.0, 2.0, 3.0]
    );
    assert_eq!(color("MOV a, program.local[0].rrba;", &[[1.0, 2.0, 3.0, 4.0]]), [1.0, 1.0, 3.0, 4.0]);
}

#[test]
fn what_only_arb_has() {
    let values = [[1.0, 2.0, 3.0, 4.0], [5.0, 6.0, 7.0, 8.0]];
    let with = |line: &str| color(&format!("MOV b, program.local[0]; MOV c, program.local[1]; {line}"), &values);
    assert_eq!(with("XPD a.xyz, b, c;")[..3], [-4.0, 8.0, -4.0]);
    assert_eq!(with("DPH a, b, c;"), [5.0 + 12.0 + 21.0 + 8.0; 4]);
    assert_eq!(with("ABS a, -b;"), values[0]);
    assert_eq!(with("SUB c, b, {2, 2, 2, 2}; CMP a, c, b, -b;"), [1.0, -2.0, -3.0, -4.0]);
    assert_eq!(with("SCS a.xy, 0.0.x;")[..2], [1.0, 0.0]);
    assert_eq!(with("MUL_SAT a, b, 0.3;"), [0.3, 0.6, 0.90000004, 1.0]);
}

#[test]
fn kil_kills_below_zero() {
    let killed = |x: f32| {
        let text = "MOV a, program.local[0]; KIL a;";
        run("nv35", text, &constants(&[[1.0, x, 1.0, 1.0]]), &FragmentInput::default()).1
    };
    assert!(killed(-1.0) && !killed(-0.0) && !killed(0.0) && !killed(f32::NAN));
}

#[test]
fn registers_have_the_cards_format() {
    // 1 + 2^-17 is not representable in fp24.
    let text = "ADD a, program.local[0], {1, 1, 1, 1};";
    let host = constants(&[[1.0 / 131_072.0; 4]]);
    assert_eq!(run("r300", text, &host, &FragmentInput::default()).0, [1.0; 4]);
    assert_eq!(run("nv35", text, &host, &FragmentInput::default()).0, [1.0 + 1.0 / 131_072.0; 4]);
}

#[test]
fn what_is_not_there_is_said() {
    let error = |statements: &str| {
        let text = format!("!!ARBfp1.0\n{statements}\nEND\n");
        let errors = refsim::asm::assemble(&text).unwrap_err().errors;
        format!("{}\n  help: {}", errors[0], errors[0].help)
    };
    let programs = [
        "PARAM m = state.matrix.mvp;",
        "PARAM m = state.light[0].shininess;",
        "PARAM m = state.sky;",
        "OPTION ARB_fog_exp; OPTION ARB_fog_exp2;",
        "TEMP a; OPTION ARB_fog_exp;",
        "TEMP a; SWZ a, a, x, y, b, a;",
        "TEMP texture;",
        "END MOV",
        "OPTION ARB_fragment_program_shadow;",
        "OPTION ARB_precision_hint_fastest; OPTION ARB_precision_hint_nicest;",
        "MOV R0, fragment.color;",
        "TEMP a; MOVR a, a;",
        "TEMP a; TEMP a;",
        "PARAM p[3] = { 1, 2 };",
        "TEMP a; MOV a, program.env[900];",
    ];
    insta::assert_snapshot!(programs.map(error).join("\n"));
}

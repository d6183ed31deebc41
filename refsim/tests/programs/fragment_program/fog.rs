//! `state.*` and the fog options of `!!ARBfp1.0`.

use crate::running::{bits, quads, run_quad, screen};
use refsim::asm::{assemble, print};
use refsim::check::{RuleId, check};
use refsim::device::Profile;
use refsim::exec::{Constants, FixedFunctionState, PixelBindings};
use refsim::isa::{LightingColor, MaterialFace, MatrixForm, StateBinding, StateMatrix};
use refsim::machine::{ExecutorKind, Machine};
use refsim::raster::FragmentInput;
use refsim::texture::TexelFormat;

fn nv35() -> Profile {
    Profile::named("nv35").unwrap()
}

fn with(state: FixedFunctionState) -> Constants {
    Constants { state: Some(Box::new(state)), ..Constants::default() }
}

/// Color of a program at fog coordinate `c`.
fn color(text: &str, host: &Constants, c: f32) -> [f32; 4] {
    let input = FragmentInput { fog: c.to_bits(), ..FragmentInput::default() };
    let ran = run_quad(&format!("!!ARBfp1.0\n{text}\nEND"), &nv35(), &PixelBindings::new(host), &[input; 4]);
    ran.results[0].colors[0].map(f32::from_bits)
}

/// Runs fog by the specification's equations: red fog over a program's green.
fn fogged(mode: &str, density: f32, start: f32, end: f32, c: f32) -> [f32; 4] {
    let mut state = FixedFunctionState::default();
    state.fog.color = bits([1.0, 0.0, 0.5, 0.125]);
    (state.fog.density, state.fog.start, state.fog.end) = (density.to_bits(), start.to_bits(), end.to_bits());
    color(&format!("OPTION ARB_fog_{mode};\nMOV result.color, {{0.0, 1.0, 0.5, 0.75}};"), &with(state), c)
}

fn near(found: [f32; 4], factor: f64) {
    let wanted = [1.0 - factor, factor, 0.5];
    for (found, wanted) in found.into_iter().zip(wanted) {
        assert!((f64::from(found) - wanted).abs() < 1e-6, "found {found}, wanted {wanted}");
    }
    assert_eq!(found[3], 0.75, "alpha is not fogged");
}

#[test]
fn fog_follows_the_equations_of_the_specification() {
    // exp(-0.5 * 3), exp(-(0.25 * 3)^2), (5 - 2) / (5 - 1).
    near(fogged("exp", 0.5, 0.0, 1.0, 3.0), 0.223_130_160_148_429_83);
    near(fogged("exp2", 0.25, 0.0, 1.0, 3.0), 0.569_782_824_730_922_9);
    near(fogged("linear", 9.0, 1.0, 5.0, 2.0), 0.75);
}

#[test]
fn fog_factors_end_at_0_and_1() {
    near(fogged("linear", 1.0, 1.0, 5.0, 0.5), 1.0);
    near(fogged("linear", 1.0, 1.0, 5.0, 7.0), 0.0);
    near(fogged("exp", 1.0, 0.0, 1.0, -2.0), 1.0);
    near(fogged("exp2", 1.0, 0.0, 1.0, 0.0), 1.0);
}

#[test]
fn colors_written_in_parts_are_fogged_as_one() {
    let mut state = FixedFunctionState::default();
    state.fog.color = bits([1.0; 4]);
    let text = "OPTION ARB_fog_linear;\nOUTPUT o = result.color;\nTEMP t;\nMOV o.w, 0.25;\nMOV t, 0.5;
        MUL o.xy, t, t;\nMOV result.color.z, t;";
    assert_eq!(color(text, &with(state), 0.5), [0.625, 0.625, 0.75, 0.25]);
}

/// A program of `count` instructions; the last one writes the color.
fn long(option: &str, count: usize) -> String {
    let body = "ADD R0, R0, R0;\n".repeat(count - 1);
    format!("!!ARBfp1.0\n{option}TEMP R0;\n{body}MOV result.color, R0;\nEND\n")
}

#[test]
fn fog_takes_the_instructions_that_the_specification_counts() {
    for (option, takes) in [("", 0), ("exp", 3), ("exp2", 4), ("linear", 2)] {
        let option = if option.is_empty() { String::new() } else { format!("OPTION ARB_fog_{option};\n") };
        let verdict = |count| check(assemble(&long(&option, count)).unwrap(), &nv35());
        assert!(verdict(1024 - takes).is_ok(), "{option}");
        let report = verdict(1024 - takes + 1).unwrap_err();
        assert_eq!(report.violations[0].rule, RuleId::TooManyInstructions, "{option}");
        let place = report.violations[0].span.start as usize;
        assert!(option.is_empty() || long(&option, 9)[place..].starts_with("ARB_fog"), "{option} {place}");
    }
}

#[test]
fn fog_takes_a_temporary() {
    let text = |option: &str| {
        let names: Vec<String> = (0..32).map(|n| format!("R{n}")).collect();
        format!("!!ARBfp1.0\n{option}TEMP {};\nMOV result.color, R31;\nEND", names.join(", "))
    };
    assert!(check(assemble(&text("")).unwrap(), &nv35()).is_ok());
    let report = check(assemble(&text("OPTION ARB_fog_exp;")).unwrap(), &nv35()).unwrap_err();
    assert_eq!(report.violations[0].rule, RuleId::NoSuchRegister);
}

#[test]
fn options_and_bindings_are_printed_as_they_are_read() {
    let text = "!!ARBfp1.0\nOPTION ARB_fog_exp2;\nTEMP R0;\nMAD R0, state.light[1].back.half, 2.0, R0;\nEND\n";
    assert!(assemble(text).is_err());
    let text = "!!ARBfp1.0\nOPTION ARB_fog_exp2;\nTEMP R0;\nDP4 R0.x, state.matrix.texture[2].invtrans.row[3], R0;\n\
        MUL result.color, state.lightprod[3].back.specular, state.light[4].spot.direction.w;\nEND\n";
    let program = assemble(text).unwrap();
    assert_eq!(print(&program), text);
    // In the checked program the option is expanded into instructions, which can also be printed and parsed.
    let expanded = print(&check(program, &nv35()).unwrap());
    insta::assert_snapshot!(expanded);
    assert_eq!(print(&assemble(&expanded).unwrap()), expanded);
}

fn draw(kind: ExecutorKind, text: &str, constants: &Constants) -> Vec<u8> {
    let program = check(assemble(text).unwrap(), &nv35()).unwrap();
    let mut card = Machine::new(nv35(), kind);
    let target = card.create_target(TexelFormat::Rgba32f, 9, 5).unwrap();
    card.clear_target(target, bits([0.25, 0.5, 0.75, 1.0])).unwrap();
    let mut quad = screen();
    for (i, vertex) in quad.iter_mut().enumerate() {
        vertex.fog = (i as f32 * 0.9 - 0.2).to_bits();
    }
    card.draw(&quads(&quad, &program, constants, target)).unwrap();
    card.read_back(target).unwrap().bytes().to_vec()
}

#[test]
fn a_program_that_writes_nothing_leaves_the_target() {
    let cleared: Vec<u8> = [0.25_f32, 0.5, 0.75, 1.0].iter().flat_map(|x| x.to_le_bytes()).collect();
    for body in ["", "TEMP r;\nMOV r, fragment.texcoord[0];\n", "OPTION ARB_fog_exp;\n"] {
        for kind in [ExecutorKind::Scalar, ExecutorKind::Batch] {
            let found = draw(kind, &format!("!!ARBfp1.0\n{body}END"), &Constants::default());
            assert_eq!(found, cleared.repeat(45), "{kind:?} {body}");
        }
    }
}

fn value(state: &FixedFunctionState, binding: StateBinding) -> [f32; 4] {
    state.value(binding).map(f32::from_bits)
}

#[test]
fn defaults_are_those_of_opengl() {
    use {LightingColor as C, MaterialFace as F, StateBinding as B};
    let state = FixedFunctionState::default();
    for (binding, wanted) in [
        (B::Material(F::Front, C::Ambient), [0.2, 0.2, 0.2, 1.0]),
        (B::Material(F::Back, C::Diffuse), [0.8, 0.8, 0.8, 1.0]),
        (B::Shininess(F::Front), [0.0, 0.0, 0.0, 1.0]),
        (B::Light(0, C::Specular), [1.0; 4]),
        (B::Light(1, C::Diffuse), [0.0, 0.0, 0.0, 1.0]),
        (B::LightPosition(3), [0.0, 0.0, 1.0, 0.0]),
        (B::LightAttenuation(0), [1.0, 0.0, 0.0, 0.0]),
        (B::SpotDirection(0), [0.0, 0.0, -1.0, -1.0]),
        (B::LightHalf(0), [0.0, 0.0, 1.0, 1.0]),
        // 0.2 as a float, squared.
        (B::SceneColor(F::Front), [0.040_000_003, 0.040_000_003, 0.040_000_003, 1.0]),
        (B::LightProduct(0, F::Front, C::Diffuse), [0.8, 0.8, 0.8, 1.0]),
        (B::TextureEnvironment(0), [0.0; 4]),
        (B::FogColor, [0.0; 4]),
        (B::FogParams, [1.0, 0.0, 1.0, 1.0]),
        (B::DepthRange, [0.0, 1.0, 1.0, 1.0]),
        (B::MatrixRow(StateMatrix::Mvp, MatrixForm::InvTrans, 2), [0.0, 0.0, 1.0, 0.0]),
    ] {
        assert_eq!(value(&state, binding), wanted, "{binding}");
    }
}

#[test]
fn what_no_call_sets_is_derived() {
    let mut state = FixedFunctionState {
        modelview: [[2.0, 0.0, 0.0, 3.0], [0.0, 4.0, 0.0, -1.0], [0.0, 0.0, 0.5, 2.0], [0.0, 0.0, 0.0, 1.0]].map(bits),
        projection: [[1.0, 2.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, -3.0, -4.0], [0.0, 0.0, -1.0, 0.0]]
            .map(bits),
        ..FixedFunctionState::default()
    };
    let rows = |state: &FixedFunctionState, matrix, form| {
        [0, 1, 2, 3].map(|row| value(state, StateBinding::MatrixRow(matrix, form, row)))
    };
    let mvp = [[2.0, 8.0, 0.0, 1.0], [0.0, 4.0, 0.0, -1.0], [0.0, 0.0, -1.5, -10.0], [0.0, 0.0, -0.5, -2.0]];
    assert_eq!(rows(&state, StateMatrix::Mvp, MatrixForm::Plain), mvp);
    let inverse = rows(&state, StateMatrix::ModelView, MatrixForm::Inverse);
    assert_eq!(inverse, [[0.5, 0.0, 0.0, -1.5], [0.0, 0.25, 0.0, 0.25], [0.0, 0.0, 2.0, -4.0], [0.0, 0.0, 0.0, 1.0]]);
    let transposed = |m: [[f32; 4]; 4]| [0, 1, 2, 3].map(|r: usize| [m[0][r], m[1][r], m[2][r], m[3][r]]);
    assert_eq!(rows(&state, StateMatrix::ModelView, MatrixForm::InvTrans), transposed(inverse));
    assert_eq!(rows(&state, StateMatrix::Mvp, MatrixForm::Transpose), transposed(mvp));

    state.lights[1].position = bits([3.0, 0.0, 4.0, 0.0]);
    state.lights[1].spot_cutoff = 60.0_f32.to_bits();
    let half = value(&state, StateBinding::LightHalf(1));
    // (0.6, 0, 1.8) normalized: (1, 0, 3) / sqrt 10.
    assert_eq!(half, [0.316_227_77, 0.0, 0.948_683_3, 1.0]);
    assert!((value(&state, StateBinding::SpotDirection(1))[3] - 0.5).abs() < 1e-7);
    (state.fog.start, state.fog.end) = (2.0_f32.to_bits(), 10.0_f32.to_bits());
    assert_eq!(value(&state, StateBinding::FogParams), [1.0, 2.0, 10.0, 0.125]);
    assert_eq!(value(&state, StateBinding::FogFactors), [-0.125, 1.25, std::f32::consts::LOG2_E, 1.201_122_4]);
}

#[test]
fn programs_read_state_where_they_name_it() {
    let mut state = FixedFunctionState::default();
    state.texture_environment[2] = bits([1.0, 2.0, 3.0, 4.0]);
    state.program[1][3] = bits([5.0, 6.0, 7.0, 8.0]);
    let text = "PARAM all[5] = { state.texenv[2].color, state.matrix.program[1] };\nTEMP a;\nMOV a, all[4];
        SUB result.color, a, state.texenv[2].color.wzyx;";
    assert_eq!(color(text, &with(state), 0.0), [1.0, 3.0, 5.0, 7.0]);
}

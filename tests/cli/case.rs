//! `crossbar run`: the example cases, and messages about bad cases.

use std::{fs, path::Path, sync::LazyLock};

use crate::answers::{folder_with, listed, names_in};
use crate::{crossbar, crossbar_in};

/// The example cases by name.
pub(crate) static CASES: LazyLock<Vec<String>> = LazyLock::new(|| {
    let names = names_in(&Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/cases"));
    names.iter().filter_map(|name| name.strip_suffix(".toml").map(str::to_owned)).collect()
});

pub(crate) fn example(name: &str) -> String {
    format!("{}/fixtures/cases/{name}.toml", env!("CARGO_MANIFEST_DIR"))
}

#[test]
fn examples_pass_and_write_their_pictures() {
    let said = listed(CASES.iter().map(|name| {
        let folder = tempfile::tempdir().expect("a folder for the test");
        let ran = crossbar_in(folder.path(), &["run", &example(name)], "");
        assert_eq!((ran.code, ran.stderr.as_str()), (Some(0), ""), "{name}");
        assert!(folder.path().join("out").join(name).is_dir(), "{name} has its folder");
        (name.as_str(), ran.stdout.replace('\\', "/"))
    }));
    insta::assert_snapshot!(said);
}

#[test]
fn constants_of_opengl_programs_have_the_programs_names() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let fixtures = format!("{}/fixtures/cases", env!("CARGO_MANIFEST_DIR"));
    fs::copy(format!("{fixtures}/stripes.fp"), folder.path().join("stripes.fp")).expect("a copy");
    let [nv, arb] = ["opengl_nv", "opengl_arb"].map(|name| fs::read_to_string(example(name)).expect("a case"));
    let said = [
        (&nv, "tint", "hue"),
        (&nv, "p[0]", "p[256]"),
        (&arb, "\"program.env[1]\"", "\"p[0]\""),
        (&arb, "\"program.env[1]\"", "c0"),
    ]
    .map(|(text, from, to)| {
        fs::write(folder.path().join("case.toml"), text.replace(from, to)).expect("a file");
        let ran = crossbar_in(folder.path(), &["run", "case.toml"], "");
        assert_eq!((ran.code, ran.stdout.as_str()), (Some(2), ""), "{to}");
        ran.stderr
    });
    insta::assert_snapshot!(said.join("----\n"));
    fs::write(folder.path().join("case.toml"), nv.replace("tint", "c0 = [1, 0, 0, 0]\ntint")).expect("a file");
    let twice = crossbar_in(folder.path(), &["run", "case.toml"], "").refusal("one constant by two names");
    assert!(twice.contains("`c0` and `p[0]` are the same constant"), "{twice}");
}

#[test]
fn bad_state() {
    let good = fs::read_to_string(example("opengl_state")).expect("a case");
    let changed = [
        ("[state.light.1]", "[state.light.8]"),
        ("[state.light.1]", "[state.light.01]"),
        ("[state.light.1]", "[state.light.1]\nspot_cutoff = 91"),
        ("start = 1", "starts = 1"),
    ]
    .map(|(from, to)| {
        assert!(good.contains(from), "{from} is there");
        refused(&good.replace(from, to))
    });
    let unread = refused(&SMALL.replace("[[texture]]", "[state]\nambient = [1, 1, 1, 1]\n[[texture]]"));
    insta::assert_snapshot!([changed.join("----\n"), unread].join("----\n"));
}

/// Registers have the names of the program, and the executors agree.
#[test]
fn opengl_programs_are_followed() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let traced = |name: &str, executor: &str| {
        let arguments = ["run", &example(name), "--trace", "1,1", "--executor", executor];
        let ran = crossbar_in(folder.path(), &arguments, "");
        assert_eq!((ran.code, ran.stderr.as_str()), (Some(0), ""), "{name}");
        let from = ran.stdout.find("pixel 1, 1").expect("the trace is printed");
        ran.stdout[from..].to_owned()
    };
    let [nv, arb] = ["opengl_nv", "opengl_arb"].map(|name| traced(name, "batch"));
    let bits = |text: &str| text.matches("0x").count();
    assert_eq!(bits(&traced("opengl_nv", "scalar")), bits(&nv), "as many components of instructions");
    insta::assert_snapshot!(nv + &arb);
}

#[test]
fn a_report_for_machines() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let ran = crossbar_in(folder.path(), &["run", &example("modulate"), "--json"], "");
    let report = ran.json();
    assert_eq!(report["device"], "r200");
    assert_eq!(report["switches"]["constants"], "register");
    assert_eq!(report["counts"]["fragments_shaded"], 4);
    assert_eq!(report["counts"]["shader_slots"], 8);
    assert_eq!(report["probes"][1]["found"], serde_json::json!([0, 255, 0, 255]));
    assert_eq!(report["passed"], true);
}

/// A small valid case; tests replace one of its lines.
const SMALL: &str = r#"device = "r200"
[pixel]
source = "ps_1_4\nmov r0, c0"
[constants]
c0 = [1, 0.5, 0.25, 1]
[[texture]]
slot = 0
format = "rgba8"
size = [1, 1]
texels = [[1]]
[geometry]
full_screen = true
[target]
size = [2, 2]
format = "bgra8"
[[probe]]
pixel = [0, 0]
expected = [1]
"#;

#[test]
fn a_failing_probe_is_exit_code_1() {
    let folder = folder_with(&[("case.toml", SMALL.replace("expected = [1]", "expected = [0.5]"))]);
    let ran = crossbar_in(folder.path(), &["run", "case.toml"], "");
    assert_eq!(ran.code, Some(1));
    assert!(ran.stdout.ends_with("0 passed, 1 failed\n"), "{}", ran.stdout);
}

/// Runs `text` in a fresh folder and expects an error that leaves nothing behind.
fn refused(text: &str) -> String {
    let folder = folder_with(&[("case.toml", text), ("text.png", "this is no picture")]);
    let ran = crossbar_in(folder.path(), &["run", "case.toml", "--out", "new/out"], "");
    assert_eq!((ran.code, ran.stdout.as_str()), (Some(2), ""), "{text}\n{}", ran.stderr);
    assert!(!ran.stderr.contains("panicked"), "{}", ran.stderr);
    assert!(!folder.path().join("new").exists(), "nothing is left behind");
    ran.stderr
}

#[test]
fn bad_cases() {
    let cases = [
        ("unknown_field", "full_screen = true", "fullscreen = true"),
        ("not_toml", "full_screen = true", "full_screen = = true"),
        ("unknown_device", "\"r200\"", "\"r2000\""),
        ("no_device", "device = \"r200\"", ""),
        ("bad_format_string", "\"r200\"", "\"r200\"\nformat = \"fp17\""),
        ("unknown_switch", "[pixel]", "[switches]\nsparkle = \"on\"\n[pixel]"),
        ("switch_value", "[pixel]", "[switches]\nrounding = \"up\"\n[pixel]"),
        ("missing_shader", "source = \"ps_1_4\\nmov r0, c0\"", "file = \"nowhere.psa\""),
        ("malformed_shader", "mov r0, c0", "mov r0 c0 garbage"),
        ("illegal_shader", "mov r0, c0", "mov r0, c9"),
        ("vertex_shader_as_pixel", "ps_1_4", "vs_1_1"),
        ("constant_of_three", "c0 = [1, 0.5, 0.25, 1]", "c0 = [1, 0.5, 0.25]"),
        ("no_such_constant", "c0 =", "d0 ="),
        ("constant_beyond_the_card", "c0 =", "c99 ="),
        ("no_number", "c0 = [1,", "c0 = [\"one\","),
        ("texel_count", "size = [1, 1]", "size = [2, 2]"),
        ("huge_texture", "size = [1, 1]", "size = [4294967295, 4294967295]"),
        ("unknown_texel_format", "format = \"rgba8\"", "format = \"rgba9\""),
        ("texel_format_of_another_card", "format = \"rgba8\"", "format = \"rgba32f\""),
        ("missing_image", "size = [1, 1]\ntexels = [[1]]", "file = \"nowhere.png\""),
        ("image_of_the_wrong_kind", "size = [1, 1]\ntexels = [[1]]", "file = \"text.png\""),
        ("target_format", "format = \"bgra8\"", "format = \"rgba32f\""),
        ("empty_target", "size = [2, 2]", "size = [0, 2]"),
        ("probe_outside", "pixel = [0, 0]", "pixel = [2, 0]"),
        ("probe_of_nothing", "expected = [1]", ""),
        ("size_of_three", "size = [2, 2]", "size = [2, 2, 2]"),
        ("size_in_halves", "size = [2, 2]", "size = [2.5, 2]"),
        ("pixel_of_three", "pixel = [0, 0]", "pixel = [0, 0, 0]"),
        ("vertex_constants_of_nothing", "[[texture]]", "[vertex_constants]\nc0 = [1, 1, 1, 1]\n[[texture]]"),
        ("depth_below_zero", "[[probe]]", "[depth]\nclear = -5\n[[probe]]"),
        ("depth_infinite", "[[probe]]", "[depth]\nclear = inf\n[[probe]]"),
        ("depth_no_number", "[[probe]]", "[depth]\nclear = nan\n[[probe]]"),
        ("depth_written_untested", "[[probe]]", "[depth]\nwrite = true\n[[probe]]"),
        ("alpha_beyond_one", "[[probe]]", "[alpha]\ntest = \"less\"\nreference = 2\n[[probe]]"),
        ("bump_of_five", "[geometry]", "[[bump]]\nstage = 0\nmatrix = [1, 0, 0, 1, 0]\n[geometry]"),
        ("bump_beyond_the_stages", "[geometry]", "[[bump]]\nstage = 8\nmatrix = [1, 0, 0, 1]\n[geometry]"),
        (
            "bump_twice",
            "[geometry]",
            "[[bump]]\nstage = 1\nmatrix = [1, 0, 0, 1]\n[[bump]]\nstage = 1\nmatrix = [1, 0, 0, 1]\n[geometry]",
        ),
        ("projected_in_ps_1_4", "format = \"rgba8\"", "format = \"rgba8\"\nprojected = \"w\""),
        ("raw_of_too_few", "texels = [[1]]", "raw = true\ntexels = [[1]]"),
        ("raw_too_large", "texels = [[1]]", "raw = true\ntexels = [[1, 2, 3, 256]]"),
        ("raw_below_zero", "texels = [[1]]", "raw = true\ntexels = [[1, 2, 3, -1]]"),
        ("raw_picture", "size = [1, 1]\ntexels = [[1]]", "raw = true\nfile = \"text.png\""),
        ("fog_unread", "full_screen = true", "full_screen = true\nattributes = { fog = [2] }"),
        ("primitive_of_the_screen", "full_screen = true", "full_screen = true\nprimitive = \"triangles\""),
        ("border_unread", "texels = [[1]]", "texels = [[1]]\nborder = [1, 1, 1, 1]"),
        (
            "filter_beside_both",
            "texels = [[1]]",
            "texels = [[1]]\nfilter = \"linear\"\nmin = \"linear\"\nmag = \"nearest\"",
        ),
        ("address_of_three_axes", "texels = [[1]]", "texels = [[1]]\naddress = [\"wrap\", \"wrap\", \"wrap\"]"),
        ("mip_level_beyond", "texels = [[1]]", "texels = [[1]]\nmax_mip_level = 1"),
        ("tolerance_of_raw", "expected = [1]", "raw = [255]\ntolerance = 1"),
        ("target_of_depth", "expected = [1]", "depth = 1\ntarget = 0\n[depth]"),
    ];
    let said = listed(cases.map(|(name, from, to)| {
        assert!(SMALL.contains(from), "{name} changes something");
        (name, refused(&SMALL.replace(from, to)))
    }));
    insta::assert_snapshot!(said);
}

/// A program that reads a value that the case never set runs on Direct3D's default, zeros, with a warning; so does one
/// whose constants are clamped. Each warning is printed once and does not change the exit code.
#[test]
fn warnings() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let unprobed = SMALL.split("[[probe]]").next().expect("the case without its probe");
    let unset = unprobed.replace("ps_1_4\\nmov r0, c0", "ps_1_1\\ntex t0\\ntexbem t1, t0\\nmov r0, t1");
    let clamped = SMALL.replace("ps_1_4\\n", "ps_1_4\\ndef c0, 2, 0, 0, 1\\n");
    let said = [unset, clamped].map(|text| {
        fs::write(folder.path().join("case.toml"), text).expect("a file");
        let ran = crossbar_in(folder.path(), &["run", "case.toml"], "");
        assert_eq!(ran.code, Some(0), "{}", ran.stderr);
        assert_eq!(ran.stderr.matches("Warning").count(), 1, "{}", ran.stderr);
        ran.stderr
    });
    insta::assert_snapshot!(said.join("----\n"));
}

#[test]
fn the_documentation_describes_every_field() {
    let page = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/cases.md")).expect("the page");
    let schema = include_str!("../../src/studies/case/schema.rs");
    let fields = schema.lines().filter_map(|line| line.trim().strip_prefix("pub ")?.split_once(": "));
    for (field, _) in fields.filter(|(field, _)| !field.contains(' ')) {
        // The parts of a case have their own headings.
        if ["pixel", "vertex", "texture", "bump", "geometry", "target", "alpha", "blend", "probe"].contains(&field) {
            assert!(page.contains(&format!("[{field}]")), "docs/cases.md says nothing of [{field}]");
            continue;
        }
        assert!(page.contains(&format!("`{field}`")), "docs/cases.md says nothing of `{field}`");
    }
}

#[test]
fn the_example_of_the_documentation_runs() {
    let page = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/cases.md")).expect("the page");
    let example = page.split("```toml\n").nth(1).and_then(|rest| rest.split("```").next()).expect("an example");
    let folder = folder_with(&[("case.toml", example)]);
    let ran = crossbar_in(folder.path(), &["run", "case.toml"], "");
    assert_eq!((ran.code, ran.stderr.as_str()), (Some(0), ""), "{}", ran.stdout);
    assert_eq!(crossbar(&["run", "--help"], "").code, Some(0));
}

/// Four nested loops of 255 passes: runs, traces and comparisons end with an error that names the instruction, on every
/// executor.
#[test]
fn a_program_that_runs_too_long_is_an_error() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let rep = "rep i0\\n".repeat(4);
    let endrep = "endrep\\n".repeat(4);
    let text = format!(
        "device = \"nv30\"\n[pixel]\nsource = \"ps_2_a\\nmov r0, c0\\n{rep}add r0, r0, c0\\n{endrep}mov oC0, r0\"\n\
         [constants]\ni0 = [255, 0, 0, 0]\n[geometry]\nfull_screen = true\n[target]\nsize = [18, 18]\n\
         format = \"bgra8\"\n"
    );
    fs::write(folder.path().join("case.toml"), &text).expect("a file");
    let fails = |arguments: &[&str]| {
        let ran = crossbar_in(folder.path(), arguments, "");
        assert_eq!((ran.code, ran.stdout.as_str()), (Some(2), ""), "{arguments:?}: {}", ran.stderr);
        assert!(!folder.path().join("out/case/target0.png").exists(), "{arguments:?} leaves nothing");
        ran.stderr
    };
    let said = fails(&["run", "case.toml"]);
    insta::assert_snapshot!(said);
    assert_eq!(said, fails(&["run", "case.toml", "--executor", "batch"]));
    assert!(fails(&["compare", "case.toml"]).contains("pixel (0, 0)"));
    let with_budget = |budget: u32, text: &str| {
        fs::write(folder.path().join("case.toml"), format!("step_budget = {budget}\n{text}")).expect("a file");
    };
    with_budget(1000, &text);
    let traced = fails(&["run", "case.toml", "--trace", "7,3"]);
    assert!(traced.contains("pixel (7, 3)") && traced.contains("1000"), "{traced}");
    with_budget(5, &text);
    assert!(fails(&["compare", "case.toml"]).contains("budget of 5"));
    with_budget(0, &text);
    assert!(fails(&["run", "case.toml"]).contains("step budget of 1 or more"));
    let fits = text.replace("[255, 0, 0, 0]", "[2, 0, 0, 0]");
    for (budget, code) in [(63, 0), (62, 2)] {
        with_budget(budget, &fits);
        let ran = crossbar_in(folder.path(), &["run", "case.toml"], "");
        assert_eq!(ran.code, Some(code), "{budget}: {}", ran.stderr);
    }
}

/// A shader in WGSL runs only with a number for each component and a texture for each read.
#[cfg(feature = "wgsl")]
#[test]
fn inputs_of_shaders_are_complete() {
    let root = crate::commands::copy_of_the_repository();
    fs::write(root.path().join("docs/examples/wgsl/few.toml"), {
        let case = fs::read_to_string(root.path().join("docs/examples/wgsl/skin.toml")).expect("a case");
        case.replace("\"bones.first[1]\" = [0, 1, 0]", "\"bones.first[1]\" = [0, 1]")
    })
    .expect("a file");
    for (arguments, expected) in [
        ("fresnel.wgsl --uniform f0=0.04", "expected 3 numbers for `f0`, found 1"),
        ("ggx.wgsl --uniform roughness=0.3,0.4", "expected 1 number for `roughness`, found 2"),
        ("ggx.wgsl", "reads the uniform `roughness`, which has no value"),
        ("few.toml", "expected 3 numbers for `bones.first[1]`, found 2"),
        (
            "normal_map.wgsl --uniform light=1,0,0",
            "this expression reads the texture of slot 0, which the case does not have",
        ),
        ("missing.wgsl", "cannot be read"),
    ] {
        let all = format!("run docs/examples/wgsl/{arguments} --out out");
        let found = crossbar_in(root.path(), &all.split(' ').collect::<Vec<_>>(), "");
        assert_eq!(found.code, Some(2), "{}", found.transcript());
        assert!(found.stderr.contains(expected) && !found.stderr.contains("full_screen"), "{}", found.transcript());
    }
}

//! The page that compares a GPU with the emulator, tested through its data.

use std::sync::LazyLock;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use crossbar_base::geom::exact::Sides;
use crossbar_studies::study::page::page;
use crossbar_systems::ray_engine::Kernel;
use refsim::device::Profile;
use refsim::exec::wgsl::program::PixelShader;
use refsim::exec::{Constants, PixelBindings, SamplerBinding};
use refsim::num::{Format, NumberOperation, to_f64};
use refsim::texture::{Image, SamplerState, TexelFormat};
use serde_json::Value;

/// Number of operand sets per operation and format.
const SETS: usize = 2048;

/// The data of the page, in the form that its script reads.
static DATA: LazyLock<Value> = LazyLock::new(|| {
    let page = page(None, &mut |_, _, _| {}).expect("the page is written");
    let (_, data) = page.split_once("type=\"application/json\">").expect("the data");
    serde_json::from_str(data.split_once("</script>").expect("its end").0).expect("JSON")
});

fn list(value: &Value) -> &[Value] {
    value.as_array().expect("a list")
}

fn text(value: &Value) -> &str {
    value.as_str().expect("a text")
}

fn words(value: &Value) -> Vec<u32> {
    list(value).iter().map(|word| word.as_u64().expect("a number") as u32).collect()
}

/// Results of an operation in a format, set by set.
fn results(operation: &str, format: &str) -> Vec<u32> {
    let arithmetic = &DATA["arithmetic"];
    let at = |list_name: &str, name: &str| {
        let found = list(&arithmetic[list_name]).iter().position(|entry| entry["name"] == name);
        found.unwrap_or_else(|| panic!("no {name}"))
    };
    let bytes = STANDARD.decode(text(&arithmetic["expected"][at("operations", operation)][at("formats", format)]));
    let bytes = bytes.expect("base64");
    let size = bytes.len() / SETS;
    bytes.chunks(size).map(|word| word.iter().rev().fold(0, |word, byte| word << 8 | u32::from(*byte))).collect()
}

/// With different operands, the page would call a correct GPU wrong: the results must belong to the operands that the
/// page's script generates.
#[test]
fn operands_are_those_of_the_script() {
    let script = [
        [0x8000_0001, 0x7fff_ffff, 0xc051_1094],
        [0xc058_1d02, 0xc084_a859, 0x40ae_1611],
        [0x7f80_0000, 0x7efe_b5a0, 0xd1f0_4361],
        [0x70a2_6012, 0xc8ad_abe1, 0x60ed_0ff8],
    ];
    let expected = script
        .map(|operands| NumberOperation::Sub.evaluate(Format::FP32, operands).expect("an operation of floats").bits);
    assert_eq!(results("sub", "e8m23")[..4], expected);
}

/// The operands of float formats include zeros, subnormals, infinities, NaN and neighbors: the smaller or the larger of
/// two operands is one of them, and neighbors differ by less than four units in the last place.
#[test]
fn operands_reach_the_corners_of_a_format() {
    for (name, format) in [("e5m10", Format::FP16), ("e8m23", Format::FP32)] {
        let sign = 1 << (format.width() - 1);
        let operands = [results("min", name), results("max", name)].concat();
        let infinity = results("rcp", name).into_iter().find(|bits| format.is_infinite(*bits)).expect("1 / 0") & !sign;
        let value = |bits: u32| to_f64(&format, bits).abs();
        let least =
            [results("sub", name), results("max", name)].map(|all| all.into_iter().map(value).collect::<Vec<_>>());
        let digits = if name == "e5m10" { 1024.0 } else { 8_388_608.0 };
        let are_near = |(sub, max): (&f64, &f64)| *sub > 0.0 && sub * digits < 4.0 * max;
        for (what, found) in [
            ("zero", operands.iter().any(|&x| x & !sign == 0)),
            ("subnormal", operands.iter().any(|&x| format.is_subnormal(x))),
            ("infinity", operands.iter().any(|&x| x & !sign == infinity)),
            ("NaN", results("add", name).iter().any(|&x| format.is_nan(x))),
            ("two neighbours", least[0].iter().zip(&least[1]).any(are_near)),
        ] {
            assert!(found, "{name}: {what}");
        }
    }
}

/// The intersection program of a format in the machine's code.
fn microcode(format: &str) -> Vec<u32> {
    let profile = Profile::named(&format!("ideal-{format}")).expect("a device");
    let kernel = Kernel::choose(&profile, true, Sides::Front).expect("a program");
    let constants = Constants { float: vec![[0.5_f32.to_bits(), 0, 0, 0]], ..Constants::default() };
    let image = Image::new_2d(TexelFormat::Rg16Snorm, 1, 1).expect("a texture");
    let mut bindings = PixelBindings::new(&constants);
    bindings.samplers[..3].fill(Some(SamplerBinding { image: &image, state: SamplerState::NEAREST_CLAMP }));
    let shader = PixelShader::new(&kernel.pixel, &profile.rules, &bindings, false).expect("no flow control");
    shader.microcode(None).expect("it fits").words
}

/// If the visitor chooses another format, the page changes only these words: all others are equal in the code of all
/// fixed-point formats of at most 24 bits, and in the code of all floats. The code of single precision omits
/// conversions from single precision to itself, which change nothing.
#[test]
fn one_program_serves_all_formats_of_its_kind() {
    let [fixed, float] = ["fixed", "float"].map(|kind| &DATA["teapot"][kind]);
    for (format, one) in [("s1.10", 1 << 10), ("s7.16", 1 << 16), ("s3.4:rtz:wrap", 1 << 4), ("s0.15", 0x7fff)] {
        let mut changed = words(&fixed["words"]);
        words(&fixed["ones"]).into_iter().for_each(|at| changed[at as usize] = one);
        assert_eq!(changed, microcode(format), "{format}");
    }
    let code = words(&float["words"]);
    assert!(list(&float["ones"]).is_empty() && list(&float["depth_scales"]).len() == 1);
    for format in ["e5m10", "e8m23:rtz", "e8m22", "e5m2:rtz:ftz", "e4m3:rdn"] {
        assert_eq!(code, microcode(format), "{format}");
    }
    // First word of a conversion, which has two more.
    const CONVERSION: u32 = 4 | (NumberOperation::Convert as u32) << 16;
    let conversions = |words: &[u32]| words.iter().filter(|&&word| word == CONVERSION).count();
    let single = microcode("e8m23");
    assert_eq!(conversions(&single), 0);
    assert_eq!(single.len() + 3 * conversions(&code), code.len());
}

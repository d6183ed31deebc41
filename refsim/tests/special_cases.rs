//! Draws every row of `fixtures/special_cases/rules.csv`, the special-case rules of the specifications, with the scalar
//! and the batch executor and on an adapter. The table's README explains it.

#[path = "common/adapter.rs"]
mod adapter;
#[path = "common/running.rs"]
mod running;

use refsim::device::Profile;
use refsim::exec::{CheckedProgram, Constants};
use refsim::machine::{AttributeStream, DrawCall, ExecutorKind, Machine, StepRate, VertexSource, VertexStreams};
use refsim::num::{Denormals, Format, Unit};
use refsim::raster::{Primitive, Vertex};
use refsim::texture::{Image, SamplerState, TargetRounding, TexelFormat, TextureKind};
use running::{bits, checked};
use std::collections::BTreeMap;
use std::process::ExitCode;

fn main() -> ExitCode {
    #[cfg_attr(not(feature = "wgpu"), expect(unused_mut, reason = "adapters add to them"))]
    let mut trials =
        adapter::trials![on_host: the_table_is_sound, scalar, batch, measured_units_depart_from_the_specifications];
    #[cfg(feature = "wgpu")]
    trials.extend(adapter::trials![on_adapter: wgsl]);
    adapter::run(trials)
}

type V = [u32; 4];

struct Row {
    line: usize,
    language: &'static str,
    device: &'static str,
    opcode: &'static str,
    operands: Vec<&'static str>,
    /// The project's expected result: the specification's result, or the row's exception.
    expected: &'static str,
}

fn rows() -> Vec<Row> {
    let text = include_str!("../../fixtures/special_cases/rules.csv");
    let lines = text.lines().enumerate().skip(1).map(|(number, line)| {
        let fields: Vec<&str> = line.split(',').collect();
        let &[language, device, section, rule, opcode, a, b, c, result, ours, note] = fields.as_slice() else {
            panic!("line {}: {} fields instead of 11: {line}", number + 1, fields.len());
        };
        assert!(!section.is_empty() && !rule.is_empty(), "line {}: the place in the specification", number + 1);
        assert_eq!(ours.is_empty(), note.is_empty(), "line {}: a deviation has a reason", number + 1);
        assert_ne!(ours, result, "line {}: no deviation", number + 1);
        let operands = [a, b, c].into_iter().filter(|operand| !operand.is_empty()).collect();
        let expected = if ours.is_empty() { result } else { ours };
        Row { line: number + 1, language, device, opcode, operands, expected }
    });
    lines.collect()
}

/// Parses a word as a single-precision number; `nan` is a NaN.
fn number(word: &str) -> u32 {
    word.parse::<f32>().unwrap_or_else(|e| panic!("{word}: {e}")).to_bits()
}

/// Parses one number for all components, or four numbers.
fn vector(text: &str) -> V {
    let numbers: Vec<u32> = text.split(' ').map(number).collect();
    match *numbers.as_slice() {
        [x] => [x; 4],
        [x, y, z, w] => [x, y, z, w],
        _ => panic!("{text}: one number or four"),
    }
}

/// Returns `true` if a number satisfies the expectation `word`.
fn agrees(found: u32, word: &str) -> bool {
    let value = f32::from_bits(found);
    match word {
        "*" => true,
        "finite" => value.is_finite(),
        "nan" => value.is_nan(),
        _ => word.split('|').any(|word| number(word) == found),
    }
}

/// Every language has rows, and every word is a number or a keyword.
fn the_table_is_sound() {
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    for row in rows() {
        *counts.entry(row.language).or_default() += 1;
        if row.expected != "commutes" {
            row.expected.split(' ').for_each(|word| _ = agrees(0, word));
        }
    }
    let languages = ["ARBfp1.0", "FP1.0", "VP1.0", "VP2.0", "ps_2_0", "vs_1_1", "vs_2_0"];
    assert_eq!(counts.keys().copied().collect::<Vec<_>>(), languages);
    assert!(counts.values().sum::<usize>() > 900 && counts.values().all(|&count| count > 40), "{counts:?}");
}

/// The device of a row; vertex programs use the measured unit of the card.
fn with_unit(row: &Row) -> Profile {
    let named = |name| Profile::named(name).unwrap();
    if row.language != "VP1.0" {
        return named(row.device);
    }
    // The card's vertex unit, followed by a pixel stage that preserves every number.
    let (mut profile, card) = (named("ideal-fp32"), named(row.device));
    profile.rules.vertex_format = card.rules.vertex_format;
    profile.rules.vertex_zero_times_anything = card.rules.vertex_zero_times_anything;
    profile
}

/// The device of a row; vertex programs follow the specifications: exact results, rounded once.
fn profile(row: &Row) -> Profile {
    let mut profile = with_unit(row);
    profile.rules.vertex_format = match (row.language, profile.rules.vertex_format.unit) {
        (_, Unit::Ideal) => profile.rules.vertex_format,
        ("VP1.0", _) => Format::FP32.with_denormals(Denormals::Flush),
        _ => Format::FP32,
    };
    profile
}

const SCALAR: [&str; 14] =
    ["COS", "SIN", "EX2", "LG2", "RCP", "RSQ", "POW", "rcp", "rsq", "exp", "log", "expp", "logp", "pow"];

/// The vertex program, if the row has one, and the pixel program.
fn programs(row: &Row) -> (Option<String>, String) {
    let op = row.opcode;
    let list = |register: &str| {
        let suffix = if SCALAR.contains(&op) { ".x" } else { "" };
        let count = if op == "sgn" { 3 } else { row.operands.len() };
        (0..count).map(|i| format!(", {register}{i}{suffix}")).collect::<String>()
    };
    let target = if row.operands[0].starts_with("CUBE") { "CUBE" } else { "2D" };
    let reads = matches!(op, "TEX" | "TXP" | "texld");
    match (op, row.language) {
        ("FOGC", "FP1.0") => return (None, "!!FP1.0\nMOVR o[COLR], f[FOGC];\nEND".to_owned()),
        ("FOGC", _) => return (None, "!!ARBfp1.0\nMOV result.color, fragment.fogcoord;\nEND".to_owned()),
        _ => {}
    }
    match row.language {
        "FP1.0" => {
            let operands = if reads { format!(", R0, TEX0, {target}") } else { list("R") };
            let loads = "MOVR R0, f[TEX0];\nMOVR R1, f[TEX1];\nMOVR R2, f[TEX2];";
            (None, format!("!!FP1.0\n{loads}\n{op} R3{operands};\nMOVR o[COLR], R3;\nEND"))
        }
        "ARBfp1.0" => {
            let operands = if reads { format!(", R0, texture[0], {target}") } else { list("R") };
            let loads: String = (0..3).map(|i| format!("MOV R{i}, fragment.texcoord[{i}];\n")).collect();
            (None, format!("!!ARBfp1.0\nTEMP R0, R1, R2, R3;\n{loads}{op} R3{operands};\nMOV result.color, R3;\nEND"))
        }
        "ps_2_0" => {
            let operands = if reads { ", t0, s0".to_owned() } else { list("r") };
            let declared: String = (0..3).map(|i| format!("dcl t{i}\n")).collect();
            let loads: String = (0..3).map(|i| format!("mov r{i}, t{i}\n")).collect();
            (None, format!("ps_2_0\n{declared}dcl_2d s0\n{loads}{op} r3{operands}\nmov oC0, r3"))
        }
        version => {
            let version = if version == "VP1.0" { "vs_1_1" } else { version };
            let declared: String = (0..3).map(|i| format!("dcl_texcoord{i} v{}\n", i + 1)).collect();
            let loads: String = (0..3).map(|i| format!("mov r{i}, v{}\n", i + 1)).collect();
            let operands = list("r");
            let text =
                format!("{version}\ndcl_position v0\n{declared}{loads}mov oPos, v0\n{op} r3{operands}\nmov oT0, r3");
            (Some(text), "ps_2_0\ndcl t0\nmov oC0, t0".to_owned())
        }
    }
}

/// An image with one texel per face: (2, 3, 4, 5), or, for a cube map, the face's number from 1 to 6 in every
/// component.
fn texture(name: &str) -> Image {
    let texel = [2.0, 3.0, 4.0, 5.0].map(f32::to_bits);
    let (format, kind, values) = match name {
        "CUBE" => {
            let faces = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0].map(|face: f32| [face.to_bits(); 4]);
            (TexelFormat::Rgba32f, TextureKind::Cube, faces.to_vec())
        }
        _ => {
            let format = TexelFormat::ALL.iter().find(|format| format.name() == name);
            (*format.unwrap_or_else(|| panic!("{name}: a format")), TextureKind::D2, vec![texel])
        }
    };
    Image::from_values(format, kind, [1, 1, 1], Format::FP32, &values, TargetRounding::Nearest).unwrap()
}

/// Draws one pixel and returns its color.
fn draw(machine: &mut Machine, row: &Row, programs: &(Option<CheckedProgram>, CheckedProgram), operands: &[V]) -> V {
    let corners = [[-1.0, -1.0, 0.5, 1.0], [-1.0, 3.0, 0.5, 1.0], [3.0, -1.0, 0.5, 1.0]].map(bits);
    let operand = |i: usize| operands.get(i).copied().unwrap_or_default();
    let target = machine.create_target(TexelFormat::Rgba32f, 1, 1).unwrap();
    let host = Constants::default();
    let vertices = corners.map(|position| {
        let mut texcoords = [[0; 4]; 8];
        (0..3).for_each(|i| texcoords[i] = operand(i));
        Vertex { position, texcoords, fog: operand(0)[0], ..Vertex::default() }
    });
    let data: [[V; 3]; 4] = [corners, [operand(0); 3], [operand(1); 3], [operand(2); 3]];
    let source = match &programs.0 {
        None => VertexSource::Transformed(&vertices),
        Some(program) => {
            let stream = |(register, data)| AttributeStream { register, step: StepRate::Vertex, data };
            let streams = data.iter().map(|data| data.as_slice()).enumerate().map(stream).collect();
            let streams = VertexStreams { vertex_count: 3, instance_count: 1, streams };
            VertexSource::Program { program, constants: &host, streams }
        }
    };
    let mut call = DrawCall::new(source, Primitive::TriangleList, &programs.1, &host, target);
    let image = row.operands[0].split(' ').next().filter(|_| matches!(row.opcode, "TEX" | "TXP" | "texld"));
    if let Some(name) = image.filter(|&name| name != "unbound") {
        let id = machine.create_texture(texture(name)).unwrap();
        call = call.with_texture(0, id, SamplerState::NEAREST_CLAMP);
    }
    machine.draw(&call).unwrap_or_else(|e| panic!("line {}: {e}", row.line));
    let image = machine.read_back(target).unwrap();
    let raw = image.raw(0, 0, 0, 0);
    machine.release_texture(target).unwrap();
    [0, 32, 64, 96].map(|shift| (raw >> shift) as u32)
}

/// Draws all rows; returns a line of text for each unexpected result.
fn departures(profile: impl Fn(&Row) -> Profile, machine: impl Fn(&Profile) -> Machine) -> String {
    let (mut machines, mut assembled) = (BTreeMap::new(), BTreeMap::new());
    let mut wrong = String::new();
    for row in rows().iter().filter(|row| row.language != "VP2.0") {
        let device = (row.device, row.language == "VP1.0");
        let machine = machines.entry(device).or_insert_with(|| machine(&profile(row)));
        let texts = programs(row);
        let key = (device, texts.clone());
        let programs = assembled.entry(key).or_insert_with(|| {
            let checked = |text: &String| checked(text, machine.profile());
            (texts.0.as_ref().map(checked), checked(&texts.1))
        });
        let direction = |text: &str| match text.strip_prefix("CUBE ") {
            Some(direction) => vector(direction),
            None => vector(text),
        };
        let reads = matches!(row.opcode, "TEX" | "texld");
        let mut operands: Vec<V> = row.operands.iter().filter(|_| !reads).map(|text| direction(text)).collect();
        let found = draw(machine, row, programs, &operands);
        let (agreed, expected) = if row.expected == "commutes" {
            operands.swap(0, 1);
            let other = draw(machine, row, programs, &operands);
            (found == other, format!("{:?}, as the other way round", other.map(f32::from_bits)))
        } else {
            let words: Vec<&str> = row.expected.split(' ').collect();
            ((0..4).all(|i| agrees(found[i], words[i % words.len()])), row.expected.to_owned())
        };
        if !agreed {
            let (line, found) = (row.line, found.map(f32::from_bits));
            wrong += &format!(
                "line {line}: {} {} {:?} on {}: expected {expected}, found {found:?}\n",
                row.language, row.opcode, row.operands, row.device
            );
        }
    }
    wrong
}

fn run(machine: impl Fn(&Profile) -> Machine) {
    let wrong = departures(profile, machine);
    assert!(wrong.is_empty(), "{} rows:\n{wrong}", wrong.lines().count());
}

/// Lines of the table for which the measured vertex units of NV20 and of NV30's family differ from the expected
/// results: 0 to the power 0, powers and logarithms from tables, NaN in comparisons, and signs of zeros.
const MEASURED_OTHERWISE: &[usize] = &[
    576, 577, 578, 579, 583, 584, 597, 598, 604, 608, 609, 610, 624, 625, 626, 627, 631, 632, 645, 646, 652, 656, 657,
    658, 676, 677, 679, 682, 685, 686, 687, 693, 702, 703, 708, 709, 712, 715, 724, 728, 729, 732, 733, 739, 740,
];

fn measured_units_depart_from_the_specifications() {
    let found = departures(with_unit, |profile| Machine::new(profile.clone(), ExecutorKind::Scalar));
    let number = |line: &str| line.strip_prefix("line ")?.split_once(':')?.0.parse().ok();
    assert_eq!(found.lines().filter_map(number).collect::<Vec<usize>>(), MEASURED_OTHERWISE, "{found}");
}

fn scalar() {
    run(|profile| Machine::new(profile.clone(), ExecutorKind::Scalar));
}

fn batch() {
    run(|profile| Machine::new(profile.clone(), ExecutorKind::Batch));
}

#[cfg(feature = "wgpu")]
fn wgsl(gpu: &std::sync::Arc<refsim::exec::gpu::Gpu>) {
    run(|profile| Machine::with_gpu(profile.clone(), std::sync::Arc::clone(gpu)).unwrap());
}

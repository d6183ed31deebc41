//! Tests the batch executor against the scalar one on random programs of both languages in several formats. The long
//! form, with all pipeline state, is `tests/agree` of the root package.

use super::text::{Choices, statement};
use crate::environment::by_form;
use proptest::prelude::*;
use refsim::asm::assemble;
use refsim::check::check;
use refsim::device::Profile;
use refsim::exec::CheckedProgram;
use refsim::isa::Version;
use refsim::machine::{BoundTexture, DrawCall, ExecutorKind, Machine, VertexSource};
use refsim::raster::{PixelCenter, Primitive, Vertex};
use refsim::texture::{Image, SamplerState, TexelFormat, TextureKind};

const DEVICES: [&str; 5] = ["nv35", "ideal-e8m23", "ideal-e5m10", "ideal-s3.12", "ideal-e7m16:rtz:ftz"];

/// Statements at the start of every program.
fn header(version: Version) -> String {
    let rest = match version {
        Version::Fp1_0 => {
            "DEFINE half = 0.5;\nDECLARE gain = {1, 2};\nDECLARE none;\n".to_owned() + &fill("f[TEX", "p[")
        }
        _ => {
            let names: Vec<String> = (0..8).map(|n| format!("R{n}")).collect();
            let temporaries = format!("TEMP {};\nPARAM half = 0.5;\nPARAM gain = {{1, 2}};\n", names.join(", "));
            temporaries + &fill("fragment.texcoord[", "program.local[")
        }
    };
    format!("{version}\n{rest}")
}

/// Initialises every temporary.
fn fill(attribute: &str, constant: &str) -> String {
    let nv = attribute.starts_with("f[");
    (0..8)
        .map(|n| match (n % 3, nv) {
            (0, true) => format!("MOV R{n}, {attribute}{n}];\nMOV H{n}, {constant}{n}];\n"),
            (1, true) => format!("MOV R{n}, {constant}{n}];\nMOV H{n}, {attribute}{n}];\n"),
            (0, false) => format!("MOV R{n}, {attribute}{n}];\n"),
            _ => format!("MOV R{n}, {constant}{n}];\n"),
        })
        .collect()
}

/// A legal program: the legal ones among random statements.
fn program(version: Version, choices: &[u32], profile: &Profile) -> Option<CheckedProgram> {
    let mut c = Choices::new(choices);
    let end = if version == Version::Fp1_0 { "MOV o[COLR], R0;\nEND" } else { "MOV result.color, R0;\nEND" };
    let legal = |body: &str| check(assemble(&format!("{body}{end}")).ok()?, profile).ok();
    let mut body = header(version);
    for _ in 0..24 {
        let line = statement(&mut c, version);
        if line.starts_with("KIL") && c.below(3) > 0 {
            continue;
        }
        let longer = format!("{body}{line}\n");
        if legal(&longer).is_some() {
            body = longer;
        }
    }
    legal(&body)
}

fn vertices(choices: &[u32]) -> [Vertex; 4] {
    let mut c = Choices::new(choices);
    let mut number = || {
        let special = [0.0, -0.0, 1.0, f32::INFINITY, f32::NAN, 1.0e-39, 7.0e4, -3.0e-6];
        let n = c.below(40);
        special.get(n).copied().unwrap_or((n as f32 - 24.0) / 7.0).to_bits()
    };
    [(-1.0, 1.0), (1.0, 1.0), (1.0, -1.0), (-1.0, -1.0_f32)].map(|(x, y)| {
        let mut vector = || [number(), number(), number(), number()];
        Vertex {
            position: [x, y, 0.5, 1.0].map(f32::to_bits),
            colors: [vector(), vector()],
            texcoords: std::array::from_fn(|_| vector()),
            fog: number(),
            ..Vertex::default()
        }
    })
}

/// Number of programs tested.
fn cases() -> u32 {
    by_form(60, 3000)
}

fn drawn(kind: ExecutorKind, profile: &Profile, program: &CheckedProgram, quad: &[Vertex], texels: u32) -> Vec<u8> {
    let mut card = Machine::new(profile.clone(), kind);
    let target = card.create_target(TexelFormat::Rgba32f, 20, 9).unwrap();
    let mut image = Image::new(TexelFormat::Rgba8, TextureKind::D2, [5, 4, 1], 1).unwrap();
    for (i, byte) in image.bytes_mut().iter_mut().enumerate() {
        *byte = (texels >> (i % 24)) as u8;
    }
    let texture = card.create_texture(image).unwrap();
    let constants = refsim::exec::Constants {
        float: quad.iter().flat_map(|v| v.texcoords).collect(),
        ..refsim::exec::Constants::default()
    };
    let mut call = DrawCall::new(VertexSource::Transformed(quad), Primitive::QuadList, program, &constants, target);
    call.center = PixelCenter::OpenGl;
    for slot in call.samplers.iter_mut().step_by(2) {
        *slot = Some(BoundTexture { texture, state: SamplerState::NEAREST_CLAMP });
    }
    card.draw(&call).unwrap();
    card.read_back(target).unwrap().bytes().to_vec()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(cases()))]

    #[test]
    fn executors_draw_the_same_bits(
        nv in any::<bool>(),
        device in 0..DEVICES.len(),
        choices in prop::collection::vec(any::<u32>(), 300),
        corners in prop::collection::vec(any::<u32>(), 170),
        texels in any::<u32>(),
    ) {
        let profile = Profile::named(DEVICES[device]).unwrap();
        let version = if nv { Version::Fp1_0 } else { Version::ArbFp1_0 };
        let Some(program) = program(version, &choices, &profile) else {
            return Err(TestCaseError::fail("the shortest program is not legal"));
        };
        let quad = vertices(&corners);
        let expected = drawn(ExecutorKind::Scalar, &profile, &program, &quad, texels);
        let found = drawn(ExecutorKind::Batch, &profile, &program, &quad, texels);
        prop_assert_eq!(found, expected, "{}\n{}", DEVICES[device], refsim::asm::print(&program));
    }
}

//! Generated mip levels: a target with levels is drawn into, its levels are generated, and a second draw reads them
//! with explicit derivatives (`TXD`), on every executor.

use crate::environment::seeds;
use crate::executors::{EXECUTORS, Executor, REFERENCE};
use crate::random::Random;
use crate::rules;
use refsim::asm::assemble;
use refsim::check::check;
use refsim::device::Profile;
use refsim::event::Event;
use refsim::exec::{CheckedProgram, Constants};
use refsim::machine::{DrawCall, Machine, MachineError, VertexSource};
use refsim::raster::{PixelCenter, Primitive, Vertex};
use refsim::texture::{AddressMode, Filter, Image, MipFilter, SamplerState, TexelFormat, TextureKind};

/// Draws colors that change from pixel to pixel.
const PAINT: &str = "!!FP1.0\nMULR R0, f[TEX0], f[TEX0].yxwz;\nFRCR R0, R0;\nMOVR o[COLR], R0;\nEND";
/// Reads a texture at TEX0 with the derivatives of TEX1.
const READ: &str = "!!FP1.0\nMOVR R1, f[TEX1];\nTXD R0, f[TEX0], R1, R1.zwxy, TEX0, 2D;\nMOVR o[COLR], R0;\nEND";

struct Fixture {
    profile: Profile,
    format: TexelFormat,
    size: [u32; 2],
    levels: u32,
    state: SamplerState,
    painted: [Vertex; 4],
    read: [Vertex; 4],
}

/// All levels of the target, the data read from them, and the log.
type Drawn = (Vec<u8>, Vec<u8>, Vec<Event>);

impl Fixture {
    fn new(seed: u64) -> Self {
        let mut r = Random::named("mipmaps", seed);
        let device = r.of(&["nv35", "nv30", "ideal-fp32", "ideal-fp16"]);
        let profile = if device.starts_with("nv") { rules::card(device, &mut r) } else { rules::profile(device) };
        let formats: Vec<TexelFormat> = TexelFormat::ALL
            .iter()
            .copied()
            .filter(|f| !f.record().is_float() || profile.limits.float_filtering && profile.limits.float_mipmaps)
            .filter(|f| profile.limits.texture_formats.contains(f) && profile.limits.target_formats.contains(f))
            .collect();
        let size = r.of(&[[1, 1], [1, 23], [19, 1], [16, 16], [32, 8], [13, 21], [7, 5]]);
        let most = Image::most_levels(TextureKind::D2, [size[0], size[1], 1]);
        let levels = if r.one_in(4) && most > 1 { 2 + r.below(most as usize - 1) as u32 } else { most };
        r.tame = true;
        let state = SamplerState {
            min: r.of(&[Filter::Nearest, Filter::Linear]),
            mag: Filter::Linear,
            mip: r.of(&[MipFilter::Nearest, MipFilter::Linear, MipFilter::Linear]),
            address_u: r.of(&[AddressMode::Wrap, AddressMode::Clamp]),
            max_mip_level: r.below(3) as u8,
            ..SamplerState::NEAREST_CLAMP
        };
        let format = r.of(&formats);
        let (painted, read) = (quad(6.0, &mut r), quad(0.3, &mut r));
        Self { profile, format, size, levels, state, painted, read }
    }

    fn program(&self, text: &str) -> CheckedProgram {
        let program = assemble(text).unwrap_or_else(|e| panic!("{e}"));
        check(program, &self.profile).unwrap_or_else(|e| panic!("{e}"))
    }

    /// All levels of the target, the data read from them, and the log.
    fn draw(&self, executor: &Executor) -> Result<Drawn, MachineError> {
        let mut machine = executor.machine(&self.profile)?;
        machine.record(true);
        let [width, height] = self.size;
        let map = machine.create_target_with_levels(self.format, width, height, self.levels)?;
        let seen = machine.create_target(TexelFormat::Rgba32f, 24, 24)?;
        let (paint, read, host) = (self.program(PAINT), self.program(READ), Constants::default());
        let call = |vertices, program, target| {
            let call = DrawCall::new(VertexSource::Transformed(vertices), Primitive::QuadList, program, &host, target);
            DrawCall { center: PixelCenter::OpenGl, ..call }
        };
        // Twice: the levels are generated again after the card has read the first ones.
        for vertices in [&self.painted, &self.read] {
            machine.draw(&call(vertices, &paint, map))?;
            machine.generate_mipmaps(map)?;
            machine.draw(&call(&self.read, &read, seen).with_texture(0, map, self.state))?;
        }
        let (map, seen) = (machine.read_back(map)?.bytes().to_vec(), machine.read_back(seen)?.bytes().to_vec());
        Ok((map, seen, log(&mut machine)))
    }
}

/// The event log without the details that only observed draws record.
fn log(machine: &mut Machine) -> Vec<Event> {
    let mut log = machine.take_log();
    for event in &mut log {
        if let Event::Draw(draw) = event {
            draw.samplers.iter_mut().for_each(|sampler| sampler.traffic = None);
        }
    }
    log
}

/// A quad over the target with coordinates up to `scale`; the derivatives in TEX1 range from zero to a whole texture.
fn quad(scale: f32, r: &mut Random) -> [Vertex; 4] {
    [[-1.0_f32, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[x, y]| {
        let mut number = |scale: f32| ((r.below(2001) as f32 - 1000.0) / 1000.0 * scale).to_bits();
        let mut texcoords = [[0; 4]; 8];
        texcoords[0] = [0; 4].map(|_| number(scale));
        texcoords[1] = [0; 4].map(|_| number(0.8));
        Vertex { position: [x, y, 0.5, 1.0].map(f32::to_bits), texcoords, ..Vertex::default() }
    })
}

#[test]
fn generated_levels_are_read_alike() {
    let (seeds, mut levels) = (seeds(20, 150), 0);
    for seed in seeds.clone() {
        let fixture = Fixture::new(seed);
        let drawn = |executor: &Executor| fixture.draw(executor).unwrap_or_else(|e| panic!("seed {seed}: {e}"));
        let expected = drawn(&REFERENCE);
        levels += usize::from(expected.1.chunks(16).any(|texel| texel != &expected.1[..16]));
        for executor in EXECUTORS.iter().filter(|e| seed.is_multiple_of(e.every)) {
            let place = format!("seed {seed}, {}, {} {:?}", executor.name, fixture.format, fixture.size);
            let found = drawn(executor);
            assert_eq!(expected.0, found.0, "{place}: the levels");
            assert_eq!(expected.1, found.1, "{place}: what was read");
            assert_eq!(expected.2, found.2, "{place}: the log");
        }
    }
    let count = seeds.count();
    assert!(count == 1 || 2 * levels > count, "{levels} of {count} pictures are of more than one colour");
}

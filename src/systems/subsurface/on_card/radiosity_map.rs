//! Pass 1 (4.2.2): the light that enters each texel, times the texel's area divided by the mean area.

use refsim::exec::{CheckedProgram, Constants};
use refsim::machine::{DrawCall, Machine, TextureId, VertexSource};
use refsim::output::WriteMask;
use refsim::raster::{PixelCenter, Primitive};
use refsim::texture::{SamplerState, TexelFormat};

use super::light::{CardLight, CardLights, LEAST_LENGTH, LEAST_SQUARE, colored};
use super::model::CardModel;
use super::options::{LightStage, MapFormat};
use crate::card::{
    Attribute, CardError, FullScreenPass, PingPong, ReadTexture, Texels, constants, nearest, vertex_streams,
};
use crate::subsurface::fresnel::mean_transmittance;
use crate::subsurface::kernels::{self, LightKernel};
use crate::subsurface::material::check_eta;

#[derive(Debug)]
pub(super) struct LightPass {
    format: MapFormat,
    eta: f64,
    mean_transmittance: f64,
    side: u32,
    /// Maximum number of lights per pass.
    most: usize,
    stage: StageData,
    /// Targets of the passes before the last one.
    between: Option<PingPong>,
    /// Texture of given irradiances, one per texel.
    table: Option<TextureId>,
}

#[derive(Debug)]
enum StageData {
    Vertices(RectangleVertices),
    /// Positions and normals.
    Texels([TextureId; 2]),
}

/// The corners of all faces' rectangles.
#[derive(Debug)]
struct RectangleVertices {
    /// Positions, normals, and clip-space positions with the area factor.
    attributes: [Attribute; 3],
    indices: Vec<u32>,
}

/// Data in which the passes of a frame differ.
#[derive(Clone, Copy, Debug)]
struct Part<'a> {
    lights: &'a [CardLight],
    sky: [f32; 4],
    before: Option<TextureId>,
    target: TextureId,
    /// The largest value of the target.
    largest: f32,
}

impl LightPass {
    pub(super) fn new(
        machine: &mut Machine,
        model: &CardModel,
        stage: LightStage,
        format: MapFormat,
        eta: f64,
    ) -> Result<Self, CardError> {
        check_eta(eta).map_err(CardError::input)?;
        let most = lights_per_pass(machine, stage);
        let stage = match stage {
            LightStage::Vertices => StageData::Vertices(RectangleVertices::new(model)),
            LightStage::Texels => {
                let positions = model.positions.upload(machine, TexelFormat::Rgba32f)?;
                StageData::Texels([positions, model.normals.upload(machine, TexelFormat::Rgba32f)?])
            }
        };
        let mean_transmittance = mean_transmittance(eta);
        Ok(Self { format, eta, mean_transmittance, side: model.side(), most, stage, between: None, table: None })
    }

    /// Passes for this number of lights other than skies.
    pub(super) fn passes(&self, lights: usize) -> usize {
        lights.div_ceil(self.most).max(1)
    }

    pub(super) fn run(&mut self, machine: &mut Machine, lights: &CardLights, map: TextureId) -> Result<(), CardError> {
        let passes = self.passes(lights.list.len());
        if passes > 1 && self.between.is_none() {
            self.between = Some(PingPong::new(machine, TexelFormat::Rgba32f, [self.side as usize; 2])?);
        }
        let mut rest = &lights.list[..];
        for pass in 0..passes {
            let (now, later) = rest.split_at(self.most.min(rest.len()));
            rest = later;
            let (target, largest) = match self.between {
                Some(between) if pass + 1 < passes => (between.written_by(pass), f32::MAX),
                _ => (map, self.format.largest()),
            };
            let before = self.between.filter(|_| pass > 0).map(|between| between.read_by(pass));
            let sky = match before {
                None => lights.sky_irradiance(self.mean_transmittance, self.format.scale()),
                Some(_) => [0.0; 4],
            };
            let part = Part { lights: now, sky, before, target, largest };
            match &self.stage {
                StageData::Vertices(vertices) => self.by_vertex(machine, vertices, part)?,
                StageData::Texels(textures) => self.by_texel(machine, *textures, part)?,
            }
        }
        Ok(())
    }

    /// eta^2 - 1 (above 0, by which the program divides), eta^2, eta, and the smallest squared distance to a light.
    fn refraction(&self) -> [f32; 4] {
        let square = self.eta * self.eta;
        [((square - 1.0) as f32).max(1e-12), square as f32, self.eta as f32, LEAST_SQUARE]
    }

    /// The three constants of each light.
    fn of_lights(&self, lights: &[CardLight]) -> impl Iterator<Item = [f32; 4]> {
        let twice = 2.0 * self.format.scale();
        let constants: Vec<[f32; 4]> =
            lights.iter().flat_map(|light| [light.place, colored(light.color, |_| twice), light.attenuation]).collect();
        constants.into_iter()
    }

    fn by_vertex(&self, machine: &mut Machine, vertices: &RectangleVertices, part: Part<'_>) -> Result<(), CardError> {
        let profile = machine.profile();
        let program = kernels::VERTEX_LIGHTS.checked(profile, part.lights.len())?;
        let pixel = if part.before.is_some() { kernels::LIT_NEXT } else { kernels::LIT }.checked(profile)?;
        let head = [self.refraction(), part.sky, [0.0, 1.0, LEAST_LENGTH, 0.0]];
        let lit = constants(head.into_iter().chain(self.of_lights(part.lights)));
        let pixel_constants = constants([[part.largest; 4]]);
        let source =
            VertexSource::Program { program: &program, constants: &lit, streams: vertex_streams(&vertices.attributes) };
        let mut call = DrawCall::new(source, Primitive::TriangleList, &pixel, &pixel_constants, part.target);
        call.indices = Some(&vertices.indices);
        call.center = PixelCenter::OpenGl;
        if let Some(before) = part.before {
            call = call.with_texture(0, before, SamplerState::NEAREST_CLAMP);
        }
        machine.draw(&call)?;
        Ok(())
    }

    fn by_texel(
        &self,
        machine: &mut Machine,
        [positions, normals]: [TextureId; 2],
        part: Part<'_>,
    ) -> Result<(), CardError> {
        let kernel = kernels::TEXEL_LIGHTS[usize::from(part.before.is_some())];
        let program = kernel.checked(machine.profile(), part.lights.len())?;
        let [r, g, b, _] = part.sky;
        let head = [self.refraction(), [r, g, b, part.largest]];
        let constants = constants(head.into_iter().chain(self.of_lights(part.lights)));
        let mut textures = nearest([positions, normals]).to_vec();
        textures.extend(part.before.map(|before| (before, SamplerState::NEAREST_CLAMP)));
        self.over_map(machine, &program, &constants, &textures, part.target)
    }

    /// Draws a pass over all texels of `target`: the radiosity map, or an intermediate target.
    fn over_map(
        &self,
        machine: &mut Machine,
        program: &CheckedProgram,
        constants: &Constants,
        textures: &[ReadTexture],
        target: TextureId,
    ) -> Result<(), CardError> {
        FullScreenPass { program, constants, textures, target, mask: WriteMask::ALL, part: None }
            .draw_counting(machine, [self.side as usize; 2])?;
        Ok(())
    }

    /// Fills the map with given irradiances (equation 8), one per texel.
    pub(super) fn fill(
        &mut self,
        machine: &mut Machine,
        model: &CardModel,
        irradiances: &[[f64; 3]],
        map: TextureId,
    ) -> Result<(), CardError> {
        let texels = self.side as usize * self.side as usize;
        CardError::check_size("irradiances, one per texel", texels, irradiances.len())?;
        if let Some(&found) = irradiances.iter().flatten().find(|value| !(value.is_finite() && **value >= 0.0)) {
            return Err(CardError::figure("finite irradiances of at least 0", found));
        }
        let (scale, largest) = (self.format.scale(), f64::from(self.format.largest()));
        let side = self.side as usize;
        let mut texels = Texels::from_fn([side; 2], |_, _| [0.0; 4]);
        for (face, area) in &model.faces {
            let [x0, y0, x1, y1] = face.bounds.map(|bound| bound as usize);
            for at in (y0..=y1).flat_map(|row| row * side + x0..=row * side + x1) {
                let [r, g, b] = irradiances[at].map(|value| (value * f64::from(*area) * scale).min(largest) as f32);
                texels.texels[at] = [r, g, b, 0.0];
            }
        }
        let table = match self.table {
            Some(table) => {
                texels.update(machine, table, TexelFormat::Rgba32f)?;
                table
            }
            None => *self.table.insert(texels.upload(machine, TexelFormat::Rgba32f)?),
        };
        let program = kernels::COPY.checked(machine.profile())?;
        self.over_map(machine, &program, &Constants::default(), &nearest([table]), map)
    }
}

/// The maximum number of lights of one pass on a machine's device.
fn lights_per_pass(machine: &Machine, stage: LightStage) -> usize {
    let limits = &machine.profile().limits;
    let most = |kernel: LightKernel, [slots, constants]: [usize; 2]| kernel.most_lights(slots, constants).max(1);
    match stage {
        LightStage::Vertices => most(kernels::VERTEX_LIGHTS, kernels::vertex_room(limits)),
        LightStage::Texels => {
            let [first, next] = kernels::TEXEL_LIGHTS.map(|kernel| most(kernel, kernels::fragment_room(limits)));
            first.min(next)
        }
    }
}

impl RectangleVertices {
    fn new(model: &CardModel) -> Self {
        let side = model.side() as f32;
        let mut attributes = [(); 3].map(|()| Vec::with_capacity(4 * model.faces.len()));
        let mut indices = Vec::with_capacity(6 * model.faces.len());
        for (face, area) in &model.faces {
            let first = attributes[0].len() as u32;
            // The triangles a b m and a m c.
            indices.extend([0, 1, 3, 0, 3, 2].map(|corner| first + corner));
            let [[a, b, m], [_, _, c]] = face.triangles;
            for vertex in [a, b, c, m] {
                let ([position, normal], [x, y]) = (model.attributes(&vertex), vertex.at.map(|at| at as f32));
                let place = [2.0 * x / side - 1.0, 1.0 - 2.0 * y / side, *area, 0.0].map(f32::to_bits);
                attributes.iter_mut().zip([position, normal, place]).for_each(|(into, value)| into.push(value));
            }
        }
        Self { attributes, indices }
    }
}

//! Pass 3 (4.2.4): the model from a camera, with the scattered irradiance as a texture, and direct light.

use std::f64::consts::PI;

use refsim::machine::{AttributeStream, DrawCall, Machine, StepRate, TextureId, VertexSource, VertexStreams};
use refsim::num::Format;
use refsim::output::DepthFormat;
use refsim::raster::Primitive;
use refsim::texture::{Filter, Image, SamplerState, TargetRounding, TexelFormat, TextureKind};

use super::error::SubsurfaceCardError;
use super::light::{CardLight, CardLights, LEAST_LENGTH, LEAST_SQUARE, colored};
use super::model::CardModel;
use crate::card::{NearestTarget, constants};
use crate::geom::vector::wide;
use crate::scene::Camera;
use crate::subsurface::fresnel::{fresnel_transmittance, mean_transmittance};
use crate::subsurface::kernels::{self, Combine, DirectLight, EyeTransmittance, ViewKernel};

/// Texels of the table of transmittances.
const TABLE: u32 = 256;

/// How the model is shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// The camera.
    pub camera: Camera,
    /// The program.
    pub kernel: ViewKernel,
    /// What radiances are multiplied by in the picture.
    pub exposure: f64,
    /// Diffuse reflectance for direct light.
    pub diffuse: [f64; 3],
    /// Specular coefficient for direct light.
    pub specular: [f64; 3],
    /// OpenGL's specular exponent, 0 to 128.
    pub shininess: f64,
    /// The picture's format: [`TexelFormat::Bgra8`] clamps to 0 to 1, floats keep all.
    pub format: TexelFormat,
}

impl View {
    /// Scattered light alone, with the exact transmittance, as it is.
    pub fn scattered(camera: Camera) -> Self {
        let kernel = ViewKernel { direct: DirectLight::None, ..ViewKernel::default() };
        let (diffuse, specular) = ([0.0; 3], [0.0; 3]);
        Self { camera, kernel, exposure: 1.0, diffuse, specular, shininess: 0.0, format: TexelFormat::Rgba32f }
    }

    fn check(&self) -> Result<(), SubsurfaceCardError> {
        let figures =
            [("an exposure of 0 to 1e30", self.exposure, 1e30), ("a shininess of 0 to 128", self.shininess, 128.0)];
        let colors = self.diffuse.iter().map(|&value| ("a diffuse reflectance of 0 to 1", value, 1.0));
        let shine = self.specular.iter().map(|&value| ("a specular coefficient of 0 to 1e30", value, 1e30));
        let wrong =
            figures.into_iter().chain(colors).chain(shine).find(|(_, value, most)| !(0.0..=*most).contains(value));
        wrong.map_or(Ok(()), |(what, found, _)| Err(SubsurfaceCardError::Figure { what, found }))
    }
}

/// The model's faces, the table of transmittances, and the target of the last view.
#[derive(Debug)]
pub(super) struct ViewPass {
    eta: f64,
    positions: Vec<[u32; 4]>,
    normals: Vec<[u32; 4]>,
    places: Vec<[u32; 4]>,
    bounds: Vec<[u32; 4]>,
    table: Option<TextureId>,
    target: Option<(NearestTarget, TexelFormat, [u32; 2])>,
}

impl ViewPass {
    pub(super) fn new(model: &CardModel, eta: f64) -> Self {
        let mut pass = Self {
            eta,
            positions: Vec::new(),
            normals: Vec::new(),
            places: Vec::new(),
            bounds: Vec::new(),
            table: None,
            target: None,
        };
        for face in &model.faces {
            for vertex in &face.whole {
                let ([px, py, pz], [nx, ny, nz]) = (vertex.position, vertex.normal);
                pass.positions.push([px, py, pz, 1.0].map(f32::to_bits));
                pass.normals.push([nx, ny, nz, 0.0].map(f32::to_bits));
                pass.places.push(vertex.at.map(f32::to_bits));
                pass.bounds.push(face.bounds.map(f32::to_bits));
            }
        }
        pass
    }

    /// Draws a view. The target holds it until the next one.
    pub(super) fn draw(
        &mut self,
        machine: &mut Machine,
        (model, lights): (&CardModel, &CardLights),
        scattered: TextureId,
        view: &View,
    ) -> Result<NearestTarget, SubsurfaceCardError> {
        view.check()?;
        let target = self.target(machine, view)?;
        let direct = direct_lights(machine, lights, view.kernel)?;
        let table = match view.kernel.transmittance {
            EyeTransmittance::Table => Some(self.table(machine)?),
            EyeTransmittance::Exact | EyeTransmittance::Mean => None,
        };
        target.clear(machine)?;
        let profile = machine.profile();
        let pixel = view.kernel.checked(profile, direct.len())?;
        let vertex = match view.kernel.direct {
            DirectLight::ByVertex => kernels::VIEW_LIGHTS.checked(profile, direct.len())?,
            DirectLight::None | DirectLight::ByFragment => kernels::VIEW.checked(profile)?,
        };
        let scene = ViewConstants { eta: self.eta, model, view, lights, direct };
        let (vertex_constants, pixel_constants) = (constants(scene.of_vertices()), constants(scene.of_fragments()));
        let source = VertexSource::Program { program: &vertex, constants: &vertex_constants, streams: self.streams() };
        let mut call = DrawCall::new(source, Primitive::TriangleList, &pixel, &pixel_constants, target.color)
            .with_texture(0, scattered, SamplerState::NEAREST_CLAMP);
        if let Some(table) = table {
            let state = SamplerState { min: Filter::Linear, mag: Filter::Linear, ..SamplerState::NEAREST_CLAMP };
            call = call.with_texture(1, table, state);
        }
        target.keep_nearest(&mut call);
        machine.draw(&call)?;
        Ok(target)
    }

    fn streams(&self) -> VertexStreams<'_> {
        let streams = [&self.positions, &self.normals, &self.places, &self.bounds].into_iter().enumerate();
        let streams = streams.map(|(register, data)| AttributeStream { register, step: StepRate::Vertex, data });
        VertexStreams { vertex_count: self.positions.len(), instance_count: 1, streams: streams.collect() }
    }

    /// The target for a view: the last one, if that is like it.
    fn target(&mut self, machine: &mut Machine, view: &View) -> Result<NearestTarget, SubsurfaceCardError> {
        let size = [view.camera.width(), view.camera.height()];
        match self.target.take() {
            Some(last) if (last.1, last.2) == (view.format, size) => {
                self.target = Some(last);
                return Ok(last.0);
            }
            Some((last, ..)) => {
                machine.release_texture(last.color)?;
                machine.release_depth(last.depth)?;
            }
            None => {}
        }
        let target = NearestTarget::new(machine, (view.format, DepthFormat::Unorm24), size)?;
        self.target = Some((target, view.format, size));
        Ok(target)
    }

    /// Transmittances of cosines 0 to 1, 16 bits each.
    fn table(&mut self, machine: &mut Machine) -> Result<TextureId, SubsurfaceCardError> {
        if let Some(table) = self.table {
            return Ok(table);
        }
        let texel = |at: u32| {
            let transmittance = fresnel_transmittance(self.eta, f64::from(at) / f64::from(TABLE - 1));
            [(transmittance as f32).to_bits(); 4]
        };
        let values: Vec<[u32; 4]> = (0..TABLE).map(texel).collect();
        let extents = [TABLE, 1, 1];
        let rounding = TargetRounding::Nearest;
        let image = Image::from_values(TexelFormat::L16, TextureKind::D1, extents, Format::FP32, &values, rounding)
            .map_err(refsim::machine::MachineError::from)?;
        Ok(*self.table.insert(machine.create_texture(image)?))
    }
}

/// The lights that a program of direct light computes.
fn direct_lights<'a>(
    machine: &Machine,
    lights: &'a CardLights,
    kernel: ViewKernel,
) -> Result<&'a [CardLight], SubsurfaceCardError> {
    let limits = &machine.profile().limits;
    let or = |limit: Option<u32>, usual: usize| limit.map_or(usual, |limit| limit as usize);
    let most = match kernel.direct {
        DirectLight::None => return Ok(&[]),
        DirectLight::ByVertex => {
            kernels::VIEW_LIGHTS.most_lights(or(limits.vertex_instructions, 256), or(limits.vertex_constants, 256))
        }
        DirectLight::ByFragment => {
            kernel.most_lights(or(limits.fragment_instructions, 1024), or(limits.fragment_parameters, 64))
        }
    };
    let found = lights.list.len();
    if found > most {
        return Err(SubsurfaceCardError::Lights { device: machine.profile().name.clone(), found, most });
    }
    Ok(&lights.list)
}

/// What the constants of a view are made of.
struct ViewConstants<'a> {
    eta: f64,
    model: &'a CardModel,
    view: &'a View,
    lights: &'a CardLights,
    direct: &'a [CardLight],
}

impl ViewConstants<'_> {
    fn eye(&self, w: f32) -> [f32; 4] {
        let [x, y, z] = self.model.frame().of_scene(wide(self.view.camera.eye())).to_array().map(|value| value as f32);
        [x, y, z, w]
    }

    /// The factor of direct light: in a product the exposure is in the scattered light already.
    fn direct_exposure(&self) -> f64 {
        if self.view.kernel.combine == Combine::Modulated { 1.0 } else { self.view.exposure }
    }

    /// Sky that is reflected: of a diffuse surface the radiance times reflectance.
    fn ambient(&self) -> [f32; 4] {
        let [r, g, b, _] = colored(self.lights.sky, |channel| self.view.diffuse[channel] * self.direct_exposure());
        [r, g, b, 1.0]
    }

    /// Diffuse and specular light.
    fn colors(&self, light: &CardLight) -> [[f32; 4]; 2] {
        let exposure = self.direct_exposure();
        [
            colored(light.color, |channel| self.view.diffuse[channel] / PI * exposure),
            colored(light.color, |channel| self.view.specular[channel] * exposure),
        ]
    }

    fn of_vertices(&self) -> Vec<[f32; 4]> {
        let mut all = self.view.camera.clip_rows(self.model.frame()).to_vec();
        all.extend([[0.0, 1.0, LEAST_LENGTH, self.view.shininess as f32], self.eye(LEAST_SQUARE), self.ambient()]);
        for light in self.direct {
            let [diffuse, specular] = self.colors(light);
            all.extend([light.place, light.attenuation, diffuse, specular]);
        }
        all
    }

    fn of_fragments(&self) -> Vec<[f32; 4]> {
        let shininess = self.view.shininess as f32;
        let square = self.eta * self.eta;
        let (factor, [x, y, z]) = match self.view.kernel.transmittance {
            EyeTransmittance::Exact => (2.0, [((square - 1.0) as f32).max(1e-12), square as f32, self.eta as f32]),
            EyeTransmittance::Table => {
                let texels = TABLE as f32;
                (1.0, [(texels - 1.0) / texels, 0.5 / texels, 0.0])
            }
            EyeTransmittance::Mean => (mean_transmittance(self.eta), [0.0; 3]),
        };
        let factor = (factor * self.view.exposure / PI) as f32;
        let mut all =
            vec![[factor, factor, factor, LEAST_SQUARE], self.eye(LEAST_LENGTH), [x, y, z, shininess], self.ambient()];
        for light in self.direct {
            let [diffuse, specular] = self.colors(light);
            all.extend([light.place, light.attenuation, diffuse, specular]);
        }
        all
    }
}

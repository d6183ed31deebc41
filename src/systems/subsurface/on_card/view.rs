//! Pass 3 (4.2.4): the model from a camera, with the scattered irradiance as a texture, and direct light.

use std::f64::consts::PI;

use refsim::machine::{Machine, TextureId};
use refsim::output::WriteMask;
use refsim::texture::{SamplerState, TexelFormat, TextureKind};

use super::light::{CardLight, CardLights, LEAST_LENGTH, LEAST_SQUARE, colored};
use super::model::CardModel;
use crate::card::{
    Attribute, BILINEAR, CardError, KeptFragments, MeshDisplay, MeshDraw, MeshPass, MeshView, Texels, new_texture,
};
use crate::subsurface::fresnel::fresnel_transmittance;
use crate::subsurface::kernels::{self, DirectLight, EyeTransmittance, ViewKernel, fragment_room, vertex_room};

/// Texels of the table of transmittances.
const TABLE: u32 = 256;

/// Options of the view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// The camera, exposure, and format: [`TexelFormat::Bgra8`] clamps to [0, 1], float formats do not clamp.
    pub mesh: MeshView,
    /// The program.
    pub kernel: ViewKernel,
    /// Diffuse reflectance for direct light.
    pub diffuse: [f64; 3],
    /// Specular coefficient for direct light.
    pub specular: [f64; 3],
    /// OpenGL's specular exponent, 0 to 128.
    pub shininess: f64,
}

impl View {
    /// A view of scattered light alone, with exact transmittance.
    pub fn scattered(mesh: impl Into<MeshView>) -> Self {
        let kernel = ViewKernel { direct: DirectLight::None, ..ViewKernel::default() };
        Self { mesh: mesh.into(), kernel, diffuse: [0.0; 3], specular: [0.0; 3], shininess: 0.0 }
    }

    fn check(&self) -> Result<(), CardError> {
        let shininess = [("a shininess of 0 to 128", self.shininess, 128.0)];
        let colors = self.diffuse.iter().map(|&value| ("a diffuse reflectance of 0 to 1", value, 1.0));
        let shine = self.specular.iter().map(|&value| ("a specular coefficient of 0 to 1e30", value, 1e30));
        let wrong =
            shininess.into_iter().chain(colors).chain(shine).find(|(_, value, most)| !(0.0..=*most).contains(value));
        wrong.map_or(Ok(()), |(what, found, _)| Err(CardError::figure(what, found)))
    }
}

/// The display of the model's faces, and the table of transmittances.
#[derive(Debug)]
pub(super) struct ViewPass {
    eta: f64,
    /// The card, which all passes share.
    pub(super) display: MeshDisplay,
    /// Normals, pairs of places in the atlas, and bounds of reads.
    beside: [Attribute; 3],
    table: Option<TextureId>,
}

impl ViewPass {
    pub(super) fn new(machine: Machine, model: &CardModel, eta: f64) -> Self {
        let (mut positions, mut beside) = (Vec::new(), [const { Vec::new() }; 3]);
        for (face, vertex) in
            model.faces.iter().flat_map(|(face, _)| face.whole.iter().map(move |vertex| (face, vertex)))
        {
            let ([position, normal], [[x0, y0], [x1, y1]]) = (model.attributes(vertex), vertex.at);
            let places = [x0, y0, x1, y1].map(|at| (at as f32).to_bits());
            let bounds = face.bounds.map(|bound| (bound as f32).to_bits());
            positions.push(position);
            beside.iter_mut().zip([normal, places, bounds]).for_each(|(into, value)| into.push(value));
        }
        Self { eta, display: MeshDisplay::in_frame(machine, *model.frame(), positions), beside, table: None }
    }

    pub(super) fn show(&mut self, lights: &CardLights, scattered: TextureId, view: &View) -> Result<Texels, CardError> {
        view.check()?;
        let direct = direct_lights(self.display.machine(), lights, view.kernel)?;
        let mut textures = vec![(scattered, SamplerState::NEAREST_CLAMP)];
        if view.kernel.transmittance == EyeTransmittance::Table {
            textures.push((self.table()?, BILINEAR));
        }
        let profile = self.display.machine().profile();
        let pixel = view.kernel.checked(profile, direct.len())?;
        let vertex = match view.kernel.direct {
            DirectLight::ByVertex => kernels::VIEW_LIGHTS.checked(profile, direct.len())?,
            DirectLight::None | DirectLight::ByFragment => kernels::VIEW.checked(profile)?,
        };
        let scene = ViewConstants { eta: self.eta, view, lights, direct };
        let (texels, _) = self.display.show(&view.mesh, false, |pass| {
            pass.draw(MeshDraw {
                vertex: (&vertex, scene.of_vertices(pass)),
                attributes: [pass.positions()].into_iter().chain(&self.beside).collect(),
                indices: None,
                pixel: (&pixel, scene.of_fragments(pass)),
                textures,
                fragments: KeptFragments::Nearest,
                mask: WriteMask::ALL,
            })
        })?;
        Ok(texels)
    }

    /// Transmittances for cosines 0 to 1, in 16 bits each.
    fn table(&mut self) -> Result<TextureId, CardError> {
        if let Some(table) = self.table {
            return Ok(table);
        }
        let machine = self.display.machine_mut();
        let texel = |at: u32| [fresnel_transmittance(self.eta, f64::from(at) / f64::from(TABLE - 1)) as f32; 4];
        let texture = new_texture(machine, TexelFormat::L16, TextureKind::D1, [TABLE, 1, 1], (0..TABLE).map(texel))?;
        Ok(*self.table.insert(texture))
    }
}

/// The lights for which a program computes direct light.
fn direct_lights<'a>(
    machine: &Machine,
    lights: &'a CardLights,
    kernel: ViewKernel,
) -> Result<&'a [CardLight], CardError> {
    let limits = &machine.profile().limits;
    let ([slots, constants], [pixel_slots, pixel_constants]) = (vertex_room(limits), fragment_room(limits));
    let most = match kernel.direct {
        DirectLight::None => return Ok(&[]),
        DirectLight::ByVertex => kernels::VIEW_LIGHTS.most_lights(slots, constants),
        DirectLight::ByFragment => kernel.most_lights(pixel_slots, pixel_constants),
    };
    let found = lights.list.len();
    if found > most {
        return Err(CardError::input(format!(
            "found {found} lights other than skies, but direct light on device `{}` supports at most {most}",
            machine.profile().name
        )));
    }
    Ok(&lights.list)
}

struct ViewConstants<'a> {
    eta: f64,
    view: &'a View,
    lights: &'a CardLights,
    direct: &'a [CardLight],
}

impl ViewConstants<'_> {
    /// Reflected sky: a diffuse surface reflects the sky's radiance times the reflectance.
    fn ambient(&self) -> [f32; 4] {
        let [r, g, b, _] = colored(self.lights.sky, |channel| self.view.diffuse[channel] * self.view.mesh.exposure);
        [r, g, b, 1.0]
    }

    /// Place, attenuation, diffuse and specular light of each light.
    fn of_lights(&self) -> impl Iterator<Item = [f32; 4]> {
        let exposure = self.view.mesh.exposure;
        self.direct.iter().flat_map(move |light| {
            let diffuse = colored(light.color, |channel| self.view.diffuse[channel] / PI * exposure);
            let specular = colored(light.color, |channel| self.view.specular[channel] * exposure);
            [light.place, light.attenuation, diffuse, specular]
        })
    }

    fn of_vertices(&self, pass: &MeshPass<'_>) -> Vec<[f32; 4]> {
        let mut all = pass.rows().to_vec();
        all.extend([[0.0, 1.0, LEAST_LENGTH, self.view.shininess as f32], pass.eye(LEAST_SQUARE), self.ambient()]);
        all.extend(self.of_lights());
        all
    }

    fn of_fragments(&self, pass: &MeshPass<'_>) -> Vec<[f32; 4]> {
        let shininess = self.view.shininess as f32;
        let square = self.eta * self.eta;
        let (factor, [x, y, z]) = match self.view.kernel.transmittance {
            EyeTransmittance::Exact => (2.0, [((square - 1.0) as f32).max(1e-12), square as f32, self.eta as f32]),
            EyeTransmittance::Table => {
                let texels = TABLE as f32;
                (1.0, [(texels - 1.0) / texels, 0.5 / texels, 0.0])
            }
        };
        let factor = (factor * self.view.mesh.exposure / PI) as f32;
        let mut all =
            vec![[factor, factor, factor, LEAST_SQUARE], pass.eye(LEAST_LENGTH), [x, y, z, shininess], self.ambient()];
        all.extend(self.of_lights());
        all
    }
}

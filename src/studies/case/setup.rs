//! Binding of a case to a device, programs, images and state.

use std::{collections::BTreeMap, path::Path};

use refsim::{
    check::{Checked, WarningId},
    device::{Profile, Storage},
    exec::{BUMP_STAGES, BumpStage, Constants, Projection},
    isa::{Program, Register, RegisterFile, Stage, Version},
    machine::{ExecutorKind, Machine, MachineError},
    output::{AlphaTest, BlendState, DepthFormat, DepthState},
    texture::TexelFormat,
};
use toml::Spanned;

use super::{
    CaseError, CaseWarning, Overrides,
    binder::Binder,
    constants,
    error::CaseText,
    schema::{self, Case},
    stages,
    state::{self, Probe},
    texels::{self, CaseTexture},
    translated,
    value::Exactly,
    vertices::{self, Geometry},
};
use crate::{
    compare,
    error::{InputError, input_error},
    io::read_limited,
    shader::{ShaderError, ShaderText, is_wgsl},
};

const MAX_BYTES: u64 = 1 << 26;

/// Case that is ready to be drawn.
#[derive(Clone, Debug)]
pub struct Setup {
    /// Title of the case.
    pub title: Option<String>,
    /// Device with the case's switches and format.
    pub profile: Profile,
    /// Switches of the case that a replacement device lacks.
    pub left_out: Vec<String>,
    /// Pixel program.
    pub pixel: Checked<Program>,
    /// Text of the pixel program.
    pub pixel_text: ShaderText,
    /// Vertex program.
    pub vertex: Option<Checked<Program>>,
    pub(crate) vertex_text: Option<ShaderText>,
    /// Constants of the pixel program.
    pub pixel_constants: Constants,
    /// Constants of the vertex program.
    pub vertex_constants: Constants,
    /// Textures by sampler.
    pub textures: BTreeMap<usize, CaseTexture>,
    pub(crate) bump: [BumpStage; BUMP_STAGES],
    pub(crate) projections: [Projection; BUMP_STAGES],
    pub(crate) geometry: Geometry,
    /// Width and height of all targets, in pixels.
    pub size: [u32; 2],
    /// Color targets.
    pub targets: Vec<TexelFormat>,
    /// Clear color of the targets, as IEEE singles.
    pub(crate) clear: [u32; 4],
    /// Mask of the written channels: red is bit 0.
    pub(crate) write_mask: u8,
    /// Depth buffer: format, clear depth (IEEE single), state.
    pub depth: Option<(DepthFormat, u32, DepthState)>,
    pub(crate) alpha: Option<AlphaTest>,
    pub(crate) blend: Option<BlendState>,
    pub(crate) probes: Vec<Probe>,
    /// Warnings about the case.
    pub warnings: Vec<CaseWarning>,
}

impl Setup {
    /// Reads a case and all files that it names. Fails with a [`CaseError`] for the first error in the case.
    pub fn read(path: &Path) -> Result<Self, CaseError> {
        Self::read_with(path, &Overrides::default())
    }

    /// Like [`Setup::read`], with replacements for the case's device settings. Fails as [`Setup::read`] does.
    pub fn read_with(path: &Path, overrides: &Overrides) -> Result<Self, CaseError> {
        let unreadable =
            |source| CaseError::Unreadable { path: path.to_owned(), source, source_code: None, span: None };
        let folder = path.parent().unwrap_or_else(|| Path::new(""));
        if is_wgsl(path) {
            ShaderText::read(path)?;
            let case = translated::lone_shader(path);
            return Self::from_bytes_with(&path.display().to_string(), case.as_bytes(), folder, overrides);
        }
        // Reads no more than the limit: the path may name an endless device file.
        let bytes = read_limited(path, MAX_BYTES).map_err(unreadable)?.ok_or_else(too_long)?;
        Self::from_bytes_with(&path.display().to_string(), &bytes, folder, overrides)
    }

    /// This case on another device; fails if a program violates rules of that device.
    pub fn on_device(&self, profile: Profile) -> Result<Self, CaseError> {
        let pixel = self.pixel_text.check((*self.pixel).clone(), &profile)?;
        let vertex = match (&self.vertex, &self.vertex_text) {
            (Some(program), Some(text)) => Some(text.check((**program).clone(), &profile)?),
            _ => None,
        };
        Ok(Self { profile, pixel, vertex, ..self.clone() })
    }

    /// Reads a case from the bytes of a file called `name`; its paths are relative to `folder`.
    pub fn from_bytes(name: &str, bytes: &[u8], folder: &Path) -> Result<Self, CaseError> {
        Self::from_bytes_with(name, bytes, folder, &Overrides::default())
    }

    /// Like [`Setup::from_bytes`], with replacements for the case's device settings. Fails as [`Setup::read`] does.
    pub fn from_bytes_with(name: &str, bytes: &[u8], folder: &Path, overrides: &Overrides) -> Result<Self, CaseError> {
        if bytes.len() as u64 > MAX_BYTES {
            return Err(too_long().into());
        }
        let text = std::str::from_utf8(bytes).map_err(|error| {
            let offset = error.valid_up_to();
            let byte = bytes.get(offset).copied().unwrap_or_default();
            input_error!("crossbar::case::text" =>
                "expected a case file in UTF-8, found byte {byte:#04x} at offset {offset}"; help "save the file as UTF-8")
        })?;
        let place = CaseText::new(name, text);
        let case: Case = toml::from_str(text).map_err(|error| place.toml(&error))?;
        Binder { place, name, folder, overrides }.bind(case)
    }

    /// Number of constants `c0`, `c1` and so on of the pixel program.
    pub fn float_constants(&self) -> usize {
        constants::counts(self.pixel.version, &self.profile)[0] as usize
    }

    /// Name of a component of a pixel register in program syntax.
    pub fn component(&self, register: &Register, component: usize) -> String {
        compare::component(&self.pixel, register, component)
    }
}

fn too_long() -> InputError {
    input_error!("crossbar::case::length" => "expected a case file of at most {MAX_BYTES} bytes, found a longer one";
        help "keep texels in image files")
}

/// Warns of instruction and storage formats in the device file that the programs of the case do not use.
fn unused_formats(profile: &Profile, pixel: &Program, vertex: Option<&Program>) -> Vec<CaseWarning> {
    let programs: Vec<&Program> = [pixel].into_iter().chain(vertex).collect();
    let own: Vec<String> = programs.iter().map(|program| format!("{:016x}", program.digest())).collect();
    let of_unused = |(digest, index): (u64, Option<usize>)| CaseWarning::Formats {
        device: profile.name.clone(),
        formats: match index {
            Some(index) => format!("a format for instruction {index} of program {digest:016x}"),
            None => format!("formats for instructions of program {digest:016x}"),
        },
        reason: if index.is_some() { "cannot have a format" } else { "the case does not run" },
        help: match index {
            Some(_) => "only instructions that write numbers to a register can have a format".to_owned(),
            None => format!(
                "a changed program has a new digest; the digests of this case's programs are {}",
                own.join(" and ")
            ),
        },
    };
    let of_storage = |storage: Storage| CaseWarning::Formats {
        device: profile.name.clone(),
        formats: format!("a format for {}", storage.name()),
        reason: "the pixel program does not use",
        help: "remove the format from the device file, or run another program".to_owned(),
    };
    let instructions = profile.instruction_formats().unused(&programs).into_iter().map(of_unused);
    instructions.chain(profile.rules.storage.unused(pixel).into_iter().map(of_storage)).collect()
}

fn reads_fog(pixel: &Program) -> bool {
    let mut sources = pixel.instructions.iter().flat_map(|instruction| &instruction.sources);
    sources.any(|source| source.register.file == RegisterFile::FogIn)
}

impl Binder<'_> {
    fn bind(&self, case: Case) -> Result<Setup, CaseError> {
        let (profile, model, left_out) = self.profile(&case)?;
        // A trial card, whose errors are reported at the positions in the case.
        let mut card = Machine::new(profile.clone(), ExecutorKind::default());
        let (pixel, pixel_text) = self.program(&case.pixel, "pixel", Stage::Pixel, &profile, model)?;
        let vertex = case.vertex.as_ref().map(|shader| self.program(shader, "vertex", Stage::Vertex, &profile, None));
        let (vertex, vertex_text) = vertex.transpose()?.unzip();
        let stages = stages::bump(self, &case.bump)?;
        let mut warnings: Vec<CaseWarning> = pixel_text.warnings(&pixel).map(CaseWarning::Shader).collect();
        if let (Some(text), Some(program)) = (&vertex_text, &vertex) {
            // OpenGL's pixel programs read the fog coordinate.
            let fog = reads_fog(&pixel).then_some(WarningId::FogIsNotBlended.code());
            let ignored = text.warnings(program).filter(|warning| Some(warning.id()) != fog);
            warnings.extend(ignored.map(CaseWarning::Shader));
        }
        warnings.extend(stages::unset(self, &case.pixel, &pixel, &stages));
        warnings.extend(unused_formats(&profile, &pixel, vertex.as_deref()));
        let mut projections = [Projection::None; BUMP_STAGES];
        let mut textures = BTreeMap::new();
        for texture in &case.texture {
            if let Some(projected) = &texture.get_ref().projected {
                let slot = *texture.get_ref().slot.get_ref();
                stages::project(self, projected, slot, &pixel, &mut projections)?;
            }
            let (slot, bound) = texels::bind(self, texture)?;
            let made = self.accepted(card.create_texture(bound.image.clone()), texture.get_ref().format.span())?;
            if let Some(mipmaps) = texture.get_ref().mipmaps.as_ref().filter(|_| bound.generate_mipmaps) {
                self.accepted(card.generate_mipmaps(made), mipmaps.span())?;
            }
            if textures.insert(slot, bound).is_some() {
                let help = "give every texture a slot of its own";
                return Err(self.place.wrong(texture.get_ref().slot.span(), format!("slot {slot} is taken"), help));
            }
        }
        self.has_textures(&pixel, &pixel_text, &textures)?;
        let geometry = vertices::bind(self, &case.geometry, vertex.as_deref(), reads_fog(&pixel))?;
        let size = self.size(&case.target.size)?;
        let targets = state::targets(self, &case.target)?;
        for &target in &targets {
            self.accepted(card.create_target(target, size[0], size[1]), case.target.format.span())?;
        }
        let depth = case.depth.as_ref().map(|depth| state::depth(self, depth)).transpose()?;
        let probes = state::probes(self, &case.probe, size, targets.len(), depth.is_some())?;
        Ok(Setup {
            title: case.title,
            pixel_constants: Constants {
                state: self.fixed_function(case.state.as_ref(), &pixel)?,
                ..self.uniforms(self.constants(&case.constants, &pixel, &profile)?, &pixel, &pixel_text)?
            },
            vertex_constants: match (&vertex, case.vertex_constants.first_key_value()) {
                (Some(program), _) => self.constants(&case.vertex_constants, program, &profile)?,
                (None, None) => Constants::default(),
                (None, Some((name, value))) => {
                    let message = format!("`{name}` in [vertex_constants], but the case has no [vertex]");
                    let help = "the pixel program's constants go into [constants]";
                    return Err(self.place.wrong(value.span(), message, help));
                }
            },
            clear: self.optional_vector(case.target.clear.as_ref(), [0; 4])?,
            write_mask: state::write_mask(self, case.target.write.as_ref())?,
            alpha: case.alpha.as_ref().map(|alpha| state::alpha(self, alpha)).transpose()?,
            blend: case.blend.as_ref().map(state::blend),
            profile,
            left_out,
            pixel,
            pixel_text,
            vertex,
            vertex_text,
            textures,
            bump: stages.map(Option::unwrap_or_default),
            projections,
            geometry,
            size,
            targets,
            depth,
            probes,
            warnings,
        })
    }

    /// Attaches a position in the case to an error of the card.
    fn accepted<T>(&self, answer: Result<T, MachineError>, span: std::ops::Range<usize>) -> Result<T, CaseError> {
        let help = "change the case, or choose a device that can draw it: `crossbar devices` lists the devices";
        answer.map_err(|error| self.place.wrong(span, error.to_string(), help))
    }

    fn program(
        &self,
        shader: &Spanned<schema::ShaderSource>,
        table: &str,
        stage: Stage,
        profile: &Profile,
        model: Option<Version>,
    ) -> Result<(Checked<Program>, ShaderText), CaseError> {
        let text = match (&shader.get_ref().file, &shader.get_ref().source) {
            (Some(file), None) => {
                let path = self.path(file.get_ref());
                ShaderText::read(&path).map_err(|error| match error {
                    ShaderError::Unreadable { source, .. } => self.place.unreadable(file.span(), path, source),
                    other => CaseError::from(other),
                })?
            }
            (None, Some(source)) => ShaderText::new(format!("{} [{table}]", self.name), source.get_ref().as_str()),
            (Some(_), Some(source)) => {
                let help = "keep one of the two";
                return Err(self.place.wrong(source.span(), format!("[{table}] has both `file` and `source`"), help));
            }
            (None, None) => {
                let help = "give a `file`, or write the program as `source`";
                return Err(self.place.wrong(shader.span(), format!("[{table}] has no program"), help));
            }
        };
        let program = text.assemble()?;
        let wrong = |expected: &str, help: &str| {
            let message = format!("expected {expected} program in [{table}], found `{}`", program.version);
            Err(self.place.wrong(shader.span(), message, help))
        };
        if program.version.stage() != stage {
            return match stage {
                Stage::Pixel => wrong("a pixel", "a vertex program goes into [vertex]"),
                Stage::Vertex => wrong("a vertex", "a pixel program goes into [pixel]"),
            };
        }
        if let Some(model) = model.filter(|model| *model != program.version) {
            return wrong(&format!("a {model}"), "make `shader_model` and the program's first line agree");
        }
        Ok((text.check(program, profile)?, text))
    }

    fn size(&self, size: &Spanned<Exactly<u32, 2>>) -> Result<[u32; 2], CaseError> {
        let [width, height] = size.get_ref().0;
        if (1..=4096).contains(&width) && (1..=4096).contains(&height) {
            return Ok([width, height]);
        }
        let message = format!("expected a target of 1 to 4096 pixels a side, found {width}x{height}");
        Err(self.place.wrong(size.span(), message, "write `size = [width, height]`"))
    }
}

//! Product of light and biclusters on a card (section V, Algorithm 2): first the bicluster buffer, then the sums of
//! rows, both as sums over lists in textures. Red, green and blue are computed in parallel.
//!
//! Additions have the order of [`Gather::multiply`](crate::bi_scale::product::Gather::multiply), so a card with single
//! precision gives the same bits, except for subnormal numbers, which `gt200` flushes. Lists have about the paper's
//! size: four bytes per row of a bicluster, eight per column. Values of biclusters are rounded to single precision,
//! which is exact for visibility.

use std::collections::BTreeMap;
use std::sync::Arc;

use refsim::device::Profile;
use refsim::event::Event;
use refsim::exec::CheckedProgram;
use refsim::isa::Version;
use refsim::machine::{Executor, Machine, TextureId};
use refsim::num::Format;
use refsim::output::WriteMask;
use refsim::raster::Viewport;
use refsim::texture::{AddressMode, Image, SamplerState, TargetRounding, TexelFormat, TextureKind};

use super::lists::{ListLimits, ListPass, Lists, check_places, extents};
use super::options::LightFormat;
use crate::bi_scale::bicluster::Biclustering;
use crate::bi_scale::kernels::ListSumKernel;
use crate::card::{CardError, FullScreenPass, KernelError, Texels, WrittenKernel, constants, require_versions};

const FORMAT: TexelFormat = TexelFormat::Rgba32f;
/// Largest texture side where the device states no limit.
const SIDE: usize = 8192;
/// Instructions where the device states no limit: the limit of ps_2_b.
const INSTRUCTIONS: usize = 512;
/// Wraps in u, because a texel is addressed only by its index.
const BY_NUMBER: SamplerState = SamplerState { address_u: AddressMode::Wrap, ..SamplerState::NEAREST_CLAMP };

/// One stage of the product: sums over lists, whose entries are positions of texels in a texture.
#[derive(Debug)]
struct Stage {
    is_weighted: bool,
    size: [usize; 2],
    order: Vec<u32>,
    passes: Vec<ListPass>,
    sheets: Vec<(TextureId, usize)>,
    /// The first target has the final sums, the second intermediate sums.
    targets: [TextureId; 2],
}

/// Counts of a product's reads and draws.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct GatherCounts {
    /// Passes for the bicluster buffer, and for the rows.
    pub passes: [usize; 2],
    /// Number of places read in these passes, including padding.
    pub places: [u64; 2],
    /// Bytes of the lists for the bicluster buffer, and for the rows.
    pub list_bytes: [u64; 2],
}

/// Biclusters on a card, which multiplies them with light.
#[derive(Debug)]
pub struct GatherCard {
    machine: Machine,
    columns: usize,
    rows: usize,
    light: (TextureId, [usize; 2]),
    format: LightFormat,
    /// The bicluster buffer, and the rows.
    stages: [Stage; 2],
    programs: BTreeMap<ListSumKernel, CheckedProgram>,
    version: Version,
}

/// The shader version used for both kinds of programs on a device.
pub(super) fn version(profile: &Profile, what: &str) -> Result<Version, KernelError> {
    let has_ps_2_b = profile.limits.versions.contains(&Version::Ps2B);
    let version = if has_ps_2_b { Version::Ps2B } else { Version::Ps2A };
    require_versions(profile, &[version], what)?;
    Ok(version)
}

impl GatherCard {
    /// Uploads the lists of biclusters.
    pub fn new(
        profile: impl Into<Arc<Profile>>,
        executor: impl Into<Executor>,
        biclusters: &Biclustering,
        format: LightFormat,
    ) -> Result<Self, CardError> {
        let profile = profile.into();
        let version = version(&profile, "the product with biclusters")?;
        let limits = &profile.limits;
        let sides = [limits.max_texture_size, limits.max_target_size].into_iter().flatten();
        let side = sides.fold(SIDE, |side, limit| side.min(limit as usize));
        let [rows, columns] = biclusters.matrix_size();
        check_places("columns", columns)?;
        let instructions = limits.instructions.map_or(INSTRUCTIONS, |limit| limit as usize).min(INSTRUCTIONS);
        let of = |is_weighted| {
            let texels = ListSumKernel::most_texels(is_weighted, instructions);
            ListLimits { texels, side, device: &profile.name }
        };
        let buffer = buffer_lists(biclusters, of(true))?;
        let sums = row_lists(biclusters, &buffer, of(false))?;
        let mut machine = executor.into().machine(profile.clone())?;
        let size = extents(columns + 1);
        let empty = light_image(&[], size, format, 1.0)?;
        let light = (machine.create_texture(empty)?, size);
        let stages = [Stage::new(&mut machine, buffer, true)?, Stage::new(&mut machine, sums, false)?];
        let mut programs = BTreeMap::new();
        for stage in &stages {
            for pass in &stage.passes {
                let kernel = stage.kernel(pass, version);
                if let std::collections::btree_map::Entry::Vacant(entry) = programs.entry(kernel) {
                    entry.insert(kernel.checked(&profile)?);
                }
            }
        }
        Ok(Self { machine, columns, rows, light, format, stages, programs, version })
    }

    /// Counts of a product's reads and draws.
    pub fn counts(&self) -> GatherCounts {
        let places = |stage: &Stage| {
            let of = |pass: &ListPass| (pass.rows[1] * stage.size[0] * pass.texels) as u64;
            ListSumKernel::places_per_texel(stage.is_weighted) as u64 * stage.passes.iter().map(of).sum::<u64>()
        };
        let bytes = |stage: &Stage| stage.sheets.iter().map(|&(_, rows)| 16 * (rows * stage.size[0]) as u64).sum();
        GatherCounts {
            passes: self.stages.each_ref().map(|stage| stage.passes.len()),
            places: self.stages.each_ref().map(places),
            list_bytes: self.stages.each_ref().map(bytes),
        }
    }

    /// Local light of each row in red, green and blue, from one color per column. Fails with [`CardError`] if the light
    /// has another size, a number is not finite (or negative in [`LightFormat::Bytes`]), or the card rejects a draw.
    pub fn multiply(&mut self, light: &[[f32; 3]]) -> Result<Vec<[f32; 3]>, CardError> {
        let scale = self.draw(light)?;
        let texels = Texels::read_back(&self.machine, self.stages[1].targets[0])?.texels;
        let mut local = vec![[0.0; 3]; self.rows];
        for (&row, &[red, green, blue, _]) in self.stages[1].order.iter().zip(&texels) {
            local[row as usize] = [red, green, blue].map(|value| scale * value);
        }
        Ok(local)
    }

    /// Like [`Self::multiply`], with the log of the work of host and card: upload of light and passes, but not the
    /// read-back, because the paper leaves local light on the card.
    pub fn logged_multiply(&mut self, light: &[[f32; 3]]) -> Result<(Vec<[f32; 3]>, Vec<Event>), CardError> {
        self.machine.record(true);
        let drawn = self.draw(light);
        self.machine.record(false);
        let log = self.machine.take_log();
        drawn?;
        // The second draw is not recorded, because the read-back must not enter the log.
        Ok((self.multiply(light)?, log))
    }

    /// Draws the sums; returns the factor that scales them to local light.
    fn draw(&mut self, light: &[[f32; 3]]) -> Result<f32, CardError> {
        CardError::check_size("numbers of light", self.columns, light.len())?;
        let is_good = |value: &&f32| value.is_finite() && (**value >= 0.0 || self.format != LightFormat::Bytes);
        if let Some(&found) = light.as_flattened().iter().find(|value| !is_good(value)) {
            let what = "finite light, of 0 or more if it is stored in bytes";
            return Err(CardError::figure(what, f64::from(found)));
        }
        let largest = light.as_flattened().iter().fold(0.0_f32, |most, value| most.max(value.abs()));
        let scale = self.format.scale(largest);
        let (texture, size) = self.light;
        self.machine.update_texture(texture, &light_image(light, size, self.format, scale)?)?;
        let [buffer, rows] = &self.stages;
        for (stage, (source, size)) in [(buffer, self.light), (rows, (buffer.targets[0], buffer.size))] {
            for pass in &stage.passes {
                let program = &self.programs[&stage.kernel(pass, self.version)];
                stage.draw(&mut self.machine, pass, program, source, size)?;
            }
        }
        Ok(scale)
    }
}

impl Stage {
    fn new(machine: &mut Machine, lists: Lists, is_weighted: bool) -> Result<Self, CardError> {
        let Lists { order, size, passes, sheets } = lists;
        let mut textures = Vec::new();
        for sheet in sheets {
            let bytes = sheet.texels.as_flattened().iter().flat_map(|value| value.to_le_bytes()).collect();
            let extents = [sheet.width as u32, sheet.height as u32, 1];
            let image = Image::from_bytes(FORMAT, TextureKind::D2, extents, 1, bytes)?;
            textures.push((machine.create_texture(image)?, sheet.height));
        }
        let [width, height] = size.map(|side| side as u32);
        let mut target = || machine.create_target(FORMAT, width, height);
        let targets = [target()?, target()?];
        Ok(Self { is_weighted, size, order, passes, sheets: textures, targets })
    }

    fn kernel(&self, pass: &ListPass, version: Version) -> ListSumKernel {
        ListSumKernel { texels: pass.texels, is_weighted: self.is_weighted, is_first: pass.pass[0] == 0, version }
    }

    /// Draws a pass. The last pass over a range of rows writes the first target.
    fn draw(
        &self,
        machine: &mut Machine,
        pass: &ListPass,
        program: &CheckedProgram,
        source: TextureId,
        [width, height]: [usize; 2],
    ) -> Result<(), CardError> {
        let [number, count] = pass.pass;
        let written = (count - 1 - number) % 2;
        let (sheet, sheet_rows) = self.sheets[pass.sheet];
        let [first, rows] = pass.rows;
        let of_sheet = |row: f32| (pass.sheet_row as f32 + row) / sheet_rows as f32;
        let of_target = |row: f32| (first as f32 + row) / self.size[1] as f32;
        let across = 1.0 / width as f32;
        let constants =
            constants([[across, across / height as f32, 0.0, 0.0], [0.0, rows as f32 / sheet_rows as f32, 0.0, 0.0]]);
        let nearest = SamplerState::NEAREST_CLAMP;
        let mut textures = vec![(sheet, nearest), (source, BY_NUMBER)];
        if number > 0 {
            textures.push((self.targets[1 - written], nearest));
        }
        let part = Viewport { y: (first as u32).cast_signed(), ..Viewport::new(self.size[0] as u32, rows as u32) };
        let pass = FullScreenPass {
            program,
            constants: &constants,
            textures: &textures,
            target: self.targets[written],
            mask: WriteMask::ALL,
            part: Some(part),
        };
        pass.draw(machine, |u, v| {
            let row = v * rows as f32;
            [[u, of_sheet(row), 0.0, 1.0], [u, of_target(row), 0.0, 1.0]]
        })?;
        Ok(())
    }
}

/// The lists of the bicluster buffer: columns in increasing order, with their values. The texel after the last column
/// is 0.
fn buffer_lists(biclusters: &Biclustering, limits: ListLimits<'_>) -> Result<Lists, CardError> {
    let [_, columns] = biclusters.matrix_size();
    let none = columns as f32 + 0.5;
    let lengths: Vec<usize> =
        (0..biclusters.len()).map(|bicluster| biclusters.columns_of(bicluster).len().div_ceil(2)).collect();
    let texel = |bicluster: usize, at: usize| {
        let columns = biclusters.columns_of(bicluster);
        let of = |at: usize| {
            let value = |value: i32| biclusters.value(value) as f32;
            columns.get(at).map_or([none, 0.0], |entry| [entry.index as f32 + 0.5, value(entry.value)])
        };
        let ([a, b], [c, d]) = (of(2 * at), of(2 * at + 1));
        [a, b, c, d]
    };
    Lists::new("biclusters", &lengths, &texel, [none, 0.0, none, 0.0], limits)
}

/// One list per row: the buffer places of the row's biclusters, in the order in which the biclusters were found. The
/// buffer is 0 after the last place.
fn row_lists(biclusters: &Biclustering, buffer: &Lists, limits: ListLimits<'_>) -> Result<Lists, CardError> {
    let mut places = vec![0; biclusters.len()];
    (0_u32..).zip(&buffer.order).for_each(|(place, &bicluster)| places[bicluster as usize] = place);
    let none = biclusters.len() as f32 + 0.5;
    let (begins, of_row) = biclusters.by_row();
    let lengths: Vec<usize> = begins.windows(2).map(|ends| (ends[1] - ends[0]).div_ceil(4)).collect();
    let texel = |row: usize, at: usize| {
        let list = &of_row[begins[row]..begins[row + 1]];
        [0, 1, 2, 3].map(|k| list.get(4 * at + k).map_or(none, |&bicluster| places[bicluster as usize] as f32 + 0.5))
    };
    Lists::new("rows", &lengths, &texel, [none; 4], limits)
}

/// Light as texels, row by row, padded with zeros.
fn light_image(light: &[[f32; 3]], size: [usize; 2], format: LightFormat, scale: f32) -> Result<Image, CardError> {
    let texel = |number: usize| {
        let [red, green, blue] = light.get(number).map_or([0.0; 3], |rgb| rgb.map(|value| value / scale));
        [red, green, blue, 0.0].map(f32::to_bits)
    };
    let values: Vec<[u32; 4]> = (0..size[0] * size[1]).map(texel).collect();
    let [width, height] = size.map(|side| side as u32);
    let extents = [width, height, 1];
    let format = format.texels();
    Ok(Image::from_values(format, TextureKind::D2, extents, Format::FP32, &values, TargetRounding::Nearest)?)
}

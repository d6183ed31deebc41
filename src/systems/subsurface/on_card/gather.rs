//! Pass 2 (4.2.3): scattered irradiance, gathered over the links of each texel.

use refsim::device::Profile;
use refsim::exec::{CheckedProgram, Constants};
use refsim::machine::{Machine, TextureId};
use refsim::output::WriteMask;

use super::levels::LeveledMap;
use super::link_textures::LinkTextures;
use super::options::SubsurfaceCardOptions;
use crate::card::{CardError, FullScreenPass, constants, nearest, new_target};
use crate::subsurface::kernels::{GatherKernel, LinkLayout, MapTexture, fragment_room};

/// A program of pass 2, checked for the device.
#[derive(Clone, Debug)]
pub struct GatherProgram {
    /// The kernel that generated the program.
    pub kernel: GatherKernel,
    /// The first link of the program.
    pub from: usize,
    /// The number of links of the program.
    pub links: usize,
    checked: CheckedProgram,
}

impl GatherProgram {
    /// The number of its instructions.
    pub fn instructions(&self) -> usize {
        self.checked.instructions.len()
    }

    /// The number of textures that it reads.
    pub fn samplers(&self) -> usize {
        self.kernel.samplers(self.links)
    }

    /// The number of textures on the card for the program's links, including unused tiles.
    pub(super) fn link_textures(&self) -> usize {
        (self.samplers() - 1 - usize::from(self.kernel.continues)) * self.kernel.tiles * self.kernel.tiles
    }
}

#[derive(Debug)]
pub(super) struct Gather {
    side: u32,
    level: Option<u32>,
    /// Factor of the final sum.
    factor: f32,
    textures: Vec<TextureId>,
    pub(super) programs: Vec<GatherProgram>,
    /// One target, or two that passes write in turn.
    targets: Vec<TextureId>,
}

impl Gather {
    pub(super) fn new(
        machine: &mut Machine,
        links: &LinkTextures,
        options: &SubsurfaceCardOptions,
    ) -> Result<Self, CardError> {
        let map = map_texture(options);
        let programs = programs(machine.profile(), links, options)?;
        let format = options.links.format();
        let (tiles, mut textures, mut next) = (options.tiles_per_edge(), Vec::new(), 0);
        for program in &programs {
            let end = next + program.kernel.link_textures(program.links);
            while next < end {
                let count = (tiles * tiles).min(end - next);
                textures.push(links.tiled(next, count, tiles, map).upload(machine, format)?);
                next += count;
            }
        }
        let target = |_| Ok(new_target(machine, options.scattered.format(), [links.side as usize; 2])?);
        let targets = (0..programs.len().min(2)).map(target).collect::<Result<_, CardError>>()?;
        let factor = (1.0 / options.map.scale()) as f32;
        Ok(Self { side: links.side, level: links.level, factor, textures, programs, targets })
    }

    pub(super) fn run(&self, machine: &mut Machine, map: &LeveledMap) -> Result<(), CardError> {
        let mut next = 0;
        for (pass, program) in self.programs.iter().enumerate() {
            let kernel = program.kernel;
            let mut textures = vec![map.read(self.level)];
            if kernel.continues {
                textures.extend(nearest([self.target(pass - 1)]));
            }
            let count = program.samplers() - textures.len();
            textures.extend(self.textures[next..next + count].iter().flat_map(|&texture| nearest([texture])));
            next += count;
            let constants = self.constants(program, pass + 1 == self.programs.len());
            let target = self.target(pass);
            let (program, constants, textures) = (&program.checked, &constants, &textures);
            FullScreenPass { program, constants, textures, target, mask: WriteMask::ALL, part: None }
                .draw_counting(machine, [self.side as usize; 2])?;
        }
        Ok(())
    }

    fn constants(&self, program: &GatherProgram, last: bool) -> Constants {
        let factor = if last { self.factor } else { 1.0 };
        let places = match (self.level, program.kernel.map) {
            (Some(level), map) => {
                let width = self.side >> level;
                let unit = if map == MapTexture::Leveled { width as f32 } else { 1.0 };
                let place = |link: usize| {
                    let [x, y] = [link as u32 % width, link as u32 / width].map(|at| (at as f32 + 0.5) / unit);
                    [x, y, 0.0, 0.0]
                };
                (program.from..program.from + program.links).map(place).collect()
            }
            (None, MapTexture::Rectangle) => vec![[-2.0, 2.0 * self.side as f32, 0.0, 0.0]],
            (None, MapTexture::Leveled) => Vec::new(),
        };
        let tiles = program.kernel.tiles;
        let corner = |tile: usize| [(tile % tiles) as f32, (tile / tiles) as f32].map(|at| at * self.side as f32);
        let corners = (1..tiles * tiles).take(program.kernel.link_textures(program.links).saturating_sub(1));
        let corners = corners.map(|tile| [corner(tile)[0], corner(tile)[1], 0.0, 0.0]);
        constants(std::iter::once([factor; 4]).chain(places).chain(corners))
    }

    fn target(&self, pass: usize) -> TextureId {
        self.targets[pass % self.targets.len()]
    }

    pub(super) fn scattered(&self) -> TextureId {
        self.target(self.programs.len() - 1)
    }
}

pub(super) fn map_texture(options: &SubsurfaceCardOptions) -> MapTexture {
    if options.map.is_leveled() { MapTexture::Leveled } else { MapTexture::Rectangle }
}

/// The programs for all links, with as many links per pass as the device's samplers, constants and instructions allow.
pub(super) fn programs(
    profile: &Profile,
    links: &LinkTextures,
    options: &SubsurfaceCardOptions,
) -> Result<Vec<GatherProgram>, CardError> {
    let mut programs = Vec::new();
    let mut from = 0;
    while from < links.count {
        let tiles = options.tiles_per_edge();
        let kernel = GatherKernel { continues: from > 0, tiles, ..links.kernel(map_texture(options), options.half) };
        let most = most_links(profile, kernel)?.min(links.count - from);
        programs.push(GatherProgram { kernel, from, links: most, checked: kernel.checked(profile, most)? });
        from += most;
    }
    Ok(programs)
}

/// The maximum number of links of one pass; a multiple of four for fixed links, which share textures.
fn most_links(profile: &Profile, kernel: GatherKernel) -> Result<usize, CardError> {
    let samplers = profile.limits.samplers.unwrap_or(16).min(16);
    let [instructions, constants] = fragment_room(&profile.limits);
    let fits = |links: &usize| {
        kernel.samplers(*links) <= samplers as usize
            && kernel.constants(*links) <= constants
            && kernel.instructions(*links) <= instructions
    };
    let step = if kernel.layout == LinkLayout::Fixed { 4 } else { 1 };
    let most = (1..=64).map(|count| count * step).take_while(fits).last();
    most.ok_or_else(|| {
        CardError::input(format!(
            "device `{}` has no room for a link in a program: {samplers} samplers, {constants} constants",
            profile.name
        ))
    })
}

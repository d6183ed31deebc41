//! The two timing models of a card: published rates, or a simulated pipeline.

use super::pipeline::{CacheSize, FragmentClocks, PipelineClocks, fragment_clocks, mipmap_clocks, pipeline_clocks};
use super::{Bottleneck, Clocks, DrawCost, Hertz, Picoseconds, TimingError};
use crate::device::{Bus, Confidence, FigureRow, Profile, Rates};
use crate::event::{DrawRecord, MipmapRecord, ProgramWork};

/// Level of detail of a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Level {
    /// Equation 11 of the Ray Engine paper: a fill rate (measured if available) and the rates of the bus.
    Rates,
    /// A simulated pipeline: clocks of the units, memory traffic, latencies.
    Pipeline,
}

/// Figures that determine the traffic stored in a recorded log, so they cannot be scaled afterwards.
const SPENT: [&str; 5] = [
    "rates.texture_cache_line_bytes",
    "rates.texture_cache_ways",
    "rates.textures_tiled",
    "rates.texture_blocks_arithmetic",
    "rates.automatic_pairs",
];

/// Figures required by [`Level::Pipeline`].
const PIPELINE_FIGURES: [&str; 15] = [
    "core_clock_hz",
    "memory_bytes_per_s",
    "pixel_pipes",
    "raster_pixels_per_clock",
    "texel_bytes_per_clock",
    "trilinear_clocks",
    "vertex_clocks_per_slot",
    "setup_clocks_per_triangle",
    "pipeline_clocks",
    "draw_clocks",
    "state_clocks",
    "constant_clocks",
    "memory_efficiency_percent",
    "texture_cache_bytes",
    "texture_cache_line_bytes",
];

const CONSTANT_BYTES: u64 = 16;

/// Bus figures required by both levels.
const BUS_FIGURES: [&str; 2] = ["upload_bytes_per_s", "readback_bytes_per_s"];

/// A timing model of one device: maps events to durations.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Model {
    level: Level,
    device: String,
    rates: Rates,
    bus: Bus,
    figures: Vec<FigureRow>,
    cache: CacheSize,
    vertex_cache: CacheSize,
}

impl Model {
    /// Creates the model of a device.
    ///
    /// # Errors
    /// [`TimingError::Missing`] if the device lacks a figure that the level needs; `ideal-` devices have none.
    pub fn new(level: Level, profile: &Profile) -> Result<Self, TimingError> {
        let timed = |row: &FigureRow| ["rates.", "clocks.", "bus."].iter().any(|s| row.key.starts_with(s));
        let model = Self {
            level,
            device: profile.name.clone(),
            rates: profile.rates.clone(),
            bus: profile.bus.clone(),
            figures: profile.figures().into_iter().filter(timed).collect(),
            cache: CacheSize::Stated,
            vertex_cache: CacheSize::Stated,
        };
        match level {
            Level::Rates if model.rates.measured_fill_pixels_per_s.is_none() => model.need("fill_pixels_per_s")?,
            Level::Rates => {}
            Level::Pipeline => PIPELINE_FIGURES.into_iter().try_for_each(|figure| model.need(figure))?,
        }
        BUS_FIGURES.into_iter().try_for_each(|figure| model.need(figure))?;
        Ok(model)
    }

    /// The level.
    pub fn level(&self) -> Level {
        self.level
    }

    /// The name of the device.
    pub fn device(&self) -> &str {
        &self.device
    }

    /// Cost of a draw.
    pub fn draw(&self, draw: &DrawRecord) -> DrawCost {
        match self.level {
            Level::Rates => self.fill(draw.counts.fragments.generated),
            Level::Pipeline => self.cost(&self.clocks(draw)),
        }
    }

    /// Cost of generating mip levels: each level is timed as a draw over that level. [`Level::Rates`] counts the texels
    /// written as fragments.
    pub fn mipmaps(&self, record: &MipmapRecord) -> DrawCost {
        match self.level {
            Level::Rates => self.fill(record.texels_written()),
            Level::Pipeline => {
                let levels = mipmap_clocks(record, &self.rates);
                levels.iter().map(|clocks| self.cost(clocks)).fold(DrawCost::default(), DrawCost::and_then)
            }
        }
    }

    /// Busy clocks of each unit for a draw, in core clocks; computed by the pipeline model at either level.
    pub fn clocks(&self, draw: &DrawRecord) -> PipelineClocks {
        pipeline_clocks(draw, &self.rates, (self.cache, self.vertex_cache))
    }

    /// Clocks per fragment of a program in a pixel pipeline, assuming 32-bit texels.
    pub fn fragment(&self, program: &ProgramWork) -> FragmentClocks {
        fragment_clocks(program, &[], &self.rates)
    }

    /// Clocks per vertex of a program in a vertex unit.
    pub fn vertex(&self, program: &ProgramWork) -> Clocks {
        Clocks(program.arithmetic_slots().saturating_mul(self.rates.vertex_clocks_per_slot.unwrap_or(1)))
    }

    /// Duration of an upload.
    pub fn upload(&self, bytes: u64) -> Picoseconds {
        rate(self.bus.upload_bytes_per_s).time_of(bytes) + self.latency(self.bus.upload_latency_ns)
    }

    /// Duration of a read-back once the data is ready.
    pub fn read_back(&self, bytes: u64) -> Picoseconds {
        rate(self.bus.readback_bytes_per_s).time_of(bytes) + self.latency(self.bus.readback_latency_ns)
    }

    /// Duration of a state change on the card. The command processor's work and the transfer of constants overlap.
    pub fn state_change(&self, changes: u32, constants: u32) -> Picoseconds {
        match self.level {
            Level::Rates => Picoseconds::ZERO,
            Level::Pipeline => {
                let clocks = |count: u32, each: Option<u64>| u64::from(count).saturating_mul(each.unwrap_or_default());
                let pieces = clocks(changes, self.rates.state_clocks);
                let all = pieces.saturating_add(clocks(constants, self.rates.constant_clocks));
                let sent = rate(self.bus.upload_bytes_per_s).time_of(u64::from(constants) * CONSTANT_BYTES);
                rate(self.rates.core_clock_hz).time_of(all).max(sent)
            }
        }
    }

    /// Duration of filling memory with one value, at the full memory rate; zero at [`Level::Rates`].
    pub fn clear(&self, bytes: u64) -> Picoseconds {
        match self.level {
            Level::Rates => Picoseconds::ZERO,
            Level::Pipeline => rate(self.rates.memory_bytes_per_s).time_of(bytes),
        }
    }

    /// All figures that the level reads, with current value, source and confidence.
    pub fn constants(&self) -> Vec<FigureRow> {
        let read = |row: &&FigureRow| self.level == Level::Pipeline || self.read_by_rates(&row.key);
        let mut rows: Vec<FigureRow> = self.figures.iter().filter(read).cloned().collect();
        for row in &mut rows {
            if let Some(value) = self.figure(&row.key) {
                row.value = value.to_string();
            }
        }
        rows
    }

    /// Keys of the figures that are guesses and can be scaled.
    pub fn guesses(&self) -> Vec<String> {
        let rows = self.constants().into_iter();
        let open = rows.filter(|row| row.confidence == Confidence::Guess && self.figure(&row.key).is_some());
        open.map(|row| row.key).filter(|key| !SPENT.contains(&key.as_str())).collect()
    }

    /// Returns the model with one guess scaled, rounded down but not to 0. For cache sizes the nearest recorded size is
    /// used: draw records have misses at half, one and two times the size (for textures only if observed).
    ///
    /// # Errors
    /// [`TimingError::NoGuess`] if the key is not among [`Self::guesses`], [`TimingError::Scale`] for a factor of 0.
    pub fn with_scaled(&self, key: &str, numerator: u64, denominator: u64) -> Result<Self, TimingError> {
        if numerator == 0 || denominator == 0 {
            return Err(TimingError::Scale { numerator, denominator });
        }
        let known = self.guesses();
        let mut scaled = self.clone();
        let slot = if known.iter().any(|k| k == key) { scaled.figure_mut(key) } else { None };
        let Some(slot) = slot else {
            let (device, known) = (self.device.clone(), known.join(" "));
            return Err(TimingError::NoGuess { device, key: key.chars().take(60).collect(), known });
        };
        let before = *slot;
        let wide = u128::from(before) * u128::from(numerator) / u128::from(denominator);
        *slot = u64::try_from(wide).unwrap_or(u64::MAX).max(before.min(1));
        let size = match () {
            () if numerator >= denominator.saturating_mul(2) => CacheSize::Double,
            () if numerator.saturating_mul(2) <= denominator => CacheSize::Half,
            () => CacheSize::Stated,
        };
        match key {
            "rates.texture_cache_bytes" => scaled.cache = size,
            "rates.vertex_cache_entries" => scaled.vertex_cache = size,
            _ => {}
        }
        Ok(scaled)
    }

    fn figure(&self, key: &str) -> Option<u64> {
        match key.split_once('.')? {
            ("rates", name) => self.rates.figure(name),
            ("bus", name) => self.bus.figure(name),
            ("clocks", name) => self.rates.instruction_clocks.get(name).map(|&n| n.into()),
            _ => None,
        }
    }

    fn figure_mut(&mut self, key: &str) -> Option<&mut u64> {
        match key.split_once('.')? {
            ("rates", name) => self.rates.figure_mut(name)?.as_mut(),
            ("bus", name) => self.bus.figure_mut(name)?.as_mut(),
            _ => None,
        }
    }

    fn read_by_rates(&self, key: &str) -> bool {
        match key {
            "rates.measured_fill_pixels_per_s" => true,
            "rates.fill_pixels_per_s" => self.rates.measured_fill_pixels_per_s.is_none(),
            "bus.kind" | "bus.upload_bytes_per_s" | "bus.readback_bytes_per_s" => true,
            _ => false,
        }
    }

    /// Returns an error if the device does not state a figure.
    fn need(&self, figure: &'static str) -> Result<(), TimingError> {
        if self.rates.figure(figure).or(self.bus.figure(figure)).is_some_and(|n| n > 0) {
            return Ok(());
        }
        let states = |name: &&str| {
            let profile = Profile::named(name);
            profile.is_ok_and(|p| p.rates.figure(figure).or(p.bus.figure(figure)).is_some())
        };
        let names = Profile::card_names().into_iter().chain(Profile::variant_names());
        let have: Vec<&str> = names.filter(states).collect();
        Err(TimingError::Missing { device: self.device.clone(), figure, have: have.join(" ") })
    }

    /// Latency; zero at [`Level::Rates`].
    fn latency(&self, nanoseconds: Option<u64>) -> Picoseconds {
        match self.level {
            Level::Rates => Picoseconds::ZERO,
            Level::Pipeline => Picoseconds(nanoseconds.unwrap_or_default().saturating_mul(1000)),
        }
    }

    /// Cost of `fragments` at the fill rate.
    fn fill(&self, fragments: u64) -> DrawCost {
        let fill = rate(self.rates.measured_fill_pixels_per_s.or(self.rates.fill_pixels_per_s));
        let total = fill.time_of(fragments);
        let core = u128::from(self.rates.core_clock_hz.unwrap_or_default());
        let clocks = (u128::from(fragments) * core).div_ceil(u128::from(fill.per_second()));
        DrawCost {
            shader: total,
            total,
            core_clocks: Clocks(u64::try_from(clocks).unwrap_or(u64::MAX)),
            bottleneck: Bottleneck::Rate,
            ..DrawCost::default()
        }
    }

    fn cost(&self, clocks: &PipelineClocks) -> DrawCost {
        let core = rate(self.rates.core_clock_hz);
        DrawCost {
            front_end: core.time_of(clocks.front_end().0),
            shader: core.time_of(clocks.shader().0),
            memory: core.time_of(clocks.memory.0),
            total: core.time_of(clocks.total().0),
            core_clocks: clocks.total(),
            bottleneck: clocks.bottleneck(),
        }
    }
}

/// A rate whose presence [`Model::new`] has checked.
fn rate(figure: Option<u64>) -> Hertz {
    figure.and_then(Hertz::new).unwrap_or(Hertz::ONE)
}

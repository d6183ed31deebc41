//! Cases on emulated cards.

use std::path::Path;
use std::sync::Arc;

use crossbar::case::{self, CaseOutcome, ComparedSides, Loaded, Overrides, Scope, Setup, Side, Traced, device_named};
use numpy::ndarray::{Array2, Array3};
use numpy::{IntoPyArray, PyArray2, PyArray3, PyReadonlyArray3};
use pyo3::prelude::*;
use refsim::event::Event;
use refsim::machine::ExecutorKind;
use refsim::num::{Format, FormatError};
use refsim::texture::{Image, TargetRounding, TextureKind};
use refsim::timing::replay::{Options, replay};
use refsim::timing::{Level, Model};
use serde_json::{Value, json};

use crate::error::{refused, value_error};
use crate::signals;

/// Case bound to a device, with inputs that replace those of the case.
#[pyclass(frozen, module = "crossbar_gi._native")]
pub(crate) struct Case {
    /// Shared with draws, which continue in the background after Ctrl-C.
    pub(crate) setup: Arc<Setup>,
    pub(crate) name: String,
}

/// Result of a draw: a JSON document, the targets, the depth buffer.
type Drawn<'py> = (String, Vec<Bound<'py, PyArray3<f64>>>, Option<Bound<'py, PyArray2<f64>>>);

fn executor(name: &str) -> PyResult<ExecutorKind> {
    match name {
        "scalar" => Ok(ExecutorKind::Scalar),
        "batch" => Ok(ExecutorKind::Batch),
        other => Err(value_error(format!("expected the executor \"scalar\" or \"batch\", found \"{other}\""))),
    }
}

#[pymethods]
impl Case {
    /// Reads a case from a file, or from a text with paths relative to `folder`.
    #[new]
    fn new(
        source: (&str, Option<&str>),
        device: Option<&str>,
        format: Option<&str>,
        switches: Vec<(String, String)>,
        step_budget: Option<u32>,
    ) -> PyResult<Self> {
        let (source, folder) = source;
        let is_format = |text: &str| text.parse::<Format>().and_then(Format::for_registers).map(|_| text.to_owned());
        let overrides = Overrides {
            device: device.map(device_named).transpose().map_err(|error| refused(&error))?,
            format: format.map(is_format).transpose().map_err(|error: FormatError| refused(&error))?,
            switches,
            step_budget,
            ..Overrides::default()
        };
        let (read, name) = match folder {
            Some(folder) => {
                let name = "the case";
                (Setup::from_bytes_with(name, source.as_bytes(), Path::new(folder), &overrides), name)
            }
            None => (Setup::read_with(Path::new(source), &overrides), source),
        };
        Ok(Self { setup: Arc::new(read.map_err(|error| refused(&error))?), name: name.to_owned() })
    }

    /// The case with replacements for some constants of its pixel program and for some textures.
    fn with_inputs(
        &self,
        constants: Vec<(usize, [f64; 4])>,
        textures: Vec<(usize, PyReadonlyArray3<'_, f32>)>,
    ) -> PyResult<Self> {
        let mut setup = Setup::clone(&self.setup);
        let count = setup.float_constants();
        let float = &mut setup.pixel_constants.float;
        for (index, value) in constants {
            if index >= count {
                let device = &setup.profile.name;
                return Err(value_error(format!("expected one of the {count} constants of {device}, found c{index}")));
            }
            float.resize(float.len().max(index + 1), [0; 4]);
            // Rounds to nearest even, like the numbers of a case.
            float[index] = value.map(|number| (number as f32).to_bits());
        }
        for (slot, texels) in textures {
            let Some(bound) = setup.textures.get_mut(&slot) else {
                return Err(value_error(format!("expected a texture that the case binds, found t{slot}")));
            };
            bound.image = image(&bound.image, slot, &texels)?;
        }
        Ok(Self { setup: Arc::new(setup), name: self.name.clone() })
    }

    /// Warnings about the case, as text.
    fn warnings(&self) -> Vec<String> {
        self.setup.warnings.iter().map(ToString::to_string).collect()
    }

    /// Draws the case.
    fn run<'py>(&self, py: Python<'py>, executor_name: &str) -> PyResult<Drawn<'py>> {
        let kind = executor(executor_name)?;
        let setup = Arc::clone(&self.setup);
        let drawn = signals::aside(py, move || drawn(&setup, kind))?;
        let (document, targets, depth) = drawn.map_err(|error| refused(&error))?;
        let targets = targets.into_iter().map(|target| target.into_pyarray(py)).collect();
        Ok((document, targets, depth.map(|depth| depth.into_pyarray(py))))
    }

    /// Traces a pixel; returns a JSON document.
    fn trace(&self, py: Python<'_>, x: u32, y: u32, executor_name: &str) -> PyResult<String> {
        let kind = executor(executor_name)?;
        let [width, height] = self.setup.size;
        if x >= width || y >= height {
            let found = format!("expected a pixel within {width}x{height}, found column {x}, row {y}");
            return Err(value_error(found));
        }
        let setup = Arc::clone(&self.setup);
        let trace = signals::aside(py, move || case::trace(&setup, kind, [x, y]))?.map_err(|error| refused(&error))?;
        let traced = Traced { setup: &self.setup, trace: &trace };
        Ok(traced.document().to_string())
    }
}

/// JSON document, targets and depth of a draw.
type DrawnArrays = (String, Vec<Array3<f64>>, Option<Array2<f64>>);

fn drawn(setup: &Setup, kind: ExecutorKind) -> Result<DrawnArrays, case::CaseError> {
    let mut loaded = Loaded::recording(setup, kind)?;
    let events = loaded.draw()?;
    // Each call would log another read-back.
    let (surfaces, depth) = (loaded.targets()?, loaded.depth()?);
    let outcome = CaseOutcome::new(setup, &events, &surfaces, depth)?;
    let minimum = setup.profile.rules.signed_texel_minimum;
    let numbers = |target: &Image| {
        let (height, width) = (target.height(), target.width());
        Array3::from_shape_fn((height as usize, width as usize, 4), |(y, x, channel)| {
            target.texel(0, 0, y as u32, x as u32, minimum).to_f64()[channel]
        })
    };
    let targets: Vec<Array3<f64>> = surfaces.into_iter().map(numbers).collect();
    let depth = depth.map(|surface| {
        let [width, height] = setup.size.map(|side| side as usize);
        Array2::from_shape_fn((height, width), |(y, x)| {
            let stored = surface.get(x as u32, y as u32).unwrap_or_default();
            f64::from(f32::from_bits(surface.format().to_format(stored, Format::FP32)))
        })
    });
    let mut document = outcome.document(setup);
    document["modelled"] = modelled(setup, &loaded.take_log());
    Ok((document.to_string(), targets, depth))
}

/// A texture's image, replaced by an array of equal size: red, green, blue, alpha in single precision.
fn image(old: &Image, slot: usize, texels: &PyReadonlyArray3<'_, f32>) -> PyResult<Image> {
    if !matches!(old.kind(), TextureKind::D1 | TextureKind::D2 | TextureKind::Rectangle) || old.levels().len() > 1 {
        let sentence = format!("t{slot}: arrays replace 1d, 2d and rectangle textures of one level, not this one");
        return Err(value_error(sentence));
    }
    let view = texels.as_array();
    let &[height, width, channels] = view.shape() else { return Err(value_error("expected three axes")) };
    if channels != 4 || height == 0 || width == 0 {
        let sentence = format!("t{slot}: expected texels of shape (height, width, 4), found {:?}", view.shape());
        return Err(value_error(sentence));
    }
    let values: Vec<[u32; 4]> =
        view.rows().into_iter().map(|texel| [0, 1, 2, 3].map(|channel| f32::to_bits(texel[channel]))).collect();
    let extents = [width, height, 1].map(|side| u32::try_from(side).unwrap_or(u32::MAX));
    Image::from_values(old.format(), old.kind(), extents, Format::FP32, &values, TargetRounding::Nearest)
        .map_err(|error| value_error(format!("t{slot}: {error}")))
}

/// Modelled time on the card in microseconds; null if the device lacks a figure.
fn modelled(setup: &Setup, log: &[Event]) -> Value {
    let time = |level: Level| {
        let model = Model::new(level, &setup.profile).ok()?;
        let run = replay(log, &model, &Options::of(level)).ok()?;
        Some(run.timeline.makespan().0 as f64 / 1e6)
    };
    json!({ "rates_us": time(Level::Rates), "pipeline_us": time(Level::Pipeline) })
}

/// Compares a case on two sides; returns JSON. `pixel` is always traced; `registers` traces all pixels.
#[pyfunction]
#[pyo3(signature = (left, right, executors, pixel, registers))]
pub(crate) fn compare(
    py: Python<'_>,
    left: &Case,
    right: &Case,
    executors: (&str, &str),
    pixel: Option<[u32; 2]>,
    registers: bool,
) -> PyResult<String> {
    let sides = [
        Side { setup: &left.setup, executor: executor(executors.0)?.into() },
        Side { setup: &right.setup, executor: executor(executors.1)?.into() },
    ];
    let [width, height] = left.setup.size;
    if right.setup.size != left.setup.size || right.setup.targets.len() != left.setup.targets.len() {
        return Err(value_error("expected one case on both sides, found targets of other sizes or numbers"));
    }
    if let Some([x, y]) = pixel.filter(|[x, y]| *x >= width || *y >= height) {
        let found = format!("expected a pixel within {width}x{height}, found column {x}, row {y}");
        return Err(value_error(found));
    }
    let scope = match pixel {
        Some(pixel) => Scope::Pixel(pixel),
        None if registers => Scope::Registers,
        None => Scope::Results,
    };
    let setups = [Arc::clone(&left.setup), Arc::clone(&right.setup)];
    let (here, there) = (sides[0].executor.clone(), sides[1].executor.clone());
    let comparison = signals::aside(py, move || {
        let [left, right] = setups.each_ref().map(|setup| &**setup);
        case::compare(&Side { setup: left, executor: here }, &Side { setup: right, executor: there }, scope)
    })?;
    let comparison = comparison.map_err(|error| refused(&error))?;
    let compared = ComparedSides { case: &left.name, sides: &sides, comparison: &comparison };
    Ok(compared.document().to_string())
}

//! Studies as JSON documents, and the difference of two pictures.

use std::str::FromStr;

use crossbar::case::{Setup, device_named};
use crossbar::error::InputError;
use crossbar::picture::metrics::{ScreenPicture, flip, ssim};
use crossbar::picture::{ChannelUnit, Picture, Samples};
use crossbar::study::precision::{CaseSubject, FormatFamily, Goal, PaperSystem, Precision};
use crossbar::study::reproduce::{ENTRIES, Parameters, choose};
use crossbar::study::{Study as _, StudyError};
use numpy::ndarray::Array2;
use numpy::{IntoPyArray, PyArray2, PyReadonlyArray3};
use pyo3::prelude::*;
use refsim::device::DeviceError;

use crate::cases::Case;
use crate::error::{refused, value_error};
use crate::signals;

/// Names and titles of the entries of the reproduction.
#[pyfunction]
pub(crate) fn entries() -> Vec<(&'static str, &'static str)> {
    ENTRIES.iter().map(|entry| (entry.id, entry.title)).collect()
}

/// JSON document of the given entries of the reproduction.
#[pyfunction]
pub(crate) fn reproduce(py: Python<'_>, ids: Vec<String>, full_size: bool) -> PyResult<String> {
    let entries = choose(&ids).map_err(|error| refused(&error))?;
    let study = Parameters { entries, full_size };
    let found = signals::study(py, move |progress| Ok(study.findings(progress)?.plain_document().to_string()))?;
    found.map_err(|error: StudyError| refused(&error))
}

/// JSON document of a search for the fewest bits, for a case or for a system on a device with switches.
#[pyfunction]
pub(crate) fn precision(
    py: Python<'_>,
    case: Option<&Case>,
    system: (Option<&str>, Option<&str>, Vec<(String, String)>),
    goal: Option<&str>,
    families: Vec<String>,
    budget: u64,
) -> PyResult<String> {
    let family = |name: &String| match name.as_str() {
        "float" => Ok(FormatFamily::Float),
        "fixed" => Ok(FormatFamily::Fixed),
        other => Err(value_error(format!("expected the family \"float\" or \"fixed\", found \"{other}\""))),
    };
    let families = families.iter().map(family).collect::<PyResult<Vec<_>>>()?;
    let goal = goal.map(Goal::from_str).transpose().map_err(|error| value_error(error.to_string()))?;
    let (system, device, switches) = system;
    let system = system.map(PaperSystem::from_str).transpose();
    let system = system.map_err(|_| value_error("expected a system, found another name"))?;
    let set = |system: PaperSystem| {
        let mut profile = device_named(device.unwrap_or(system.card()))?;
        switches.iter().try_for_each(|(name, value)| profile.set_switch(name, value))?;
        Ok(profile)
    };
    let profile = system.map(set).transpose().map_err(|error: DeviceError| refused(&error))?;
    let case = case.map(|case| (Setup::clone(&case.setup), case.name.clone()));
    let found = signals::study(py, move |progress| {
        let subject = match (case, system.zip(profile)) {
            (Some((setup, name)), _) => Box::new(CaseSubject::new(setup, &name)?),
            (None, Some((system, profile))) => system.subject(profile)?,
            (None, None) => return Err(StudyError::new("crossbar::precision", "expected a case or a system")),
        };
        let study = Precision { subject, goal, families, budget };
        Ok(study.findings(progress)?.plain_document().to_string())
    })?;
    found.map_err(|error: StudyError| refused(&error))
}

/// SSIM (`None` for pictures smaller than its window), mean and largest FLIP, and FLIP of each pixel.
type Difference<'py> = (Option<f64>, f64, f64, Bound<'py, PyArray2<f64>>);

/// Compares two pictures of shape (height, width, 3) as an observer perceives them.
#[pyfunction]
pub(crate) fn diff<'py>(
    py: Python<'py>,
    pictures: (PyReadonlyArray3<'py, f32>, PyReadonlyArray3<'py, f32>),
    is_srgb: bool,
    exposure_ppd: (f64, f64),
) -> PyResult<Difference<'py>> {
    let unit = if is_srgb { ChannelUnit::Srgb } else { ChannelUnit::Linear };
    let (exposure, ppd) = exposure_ppd;
    let shape = pictures.0.as_array().shape().to_vec();
    let pictures = [picture(&pictures.0, unit)?, picture(&pictures.1, unit)?];
    let found = py.detach(|| {
        let screens = [ScreenPicture::new(&pictures[0], exposure)?, ScreenPicture::new(&pictures[1], exposure)?];
        Ok(flip(&screens[0], &screens[1], ppd).map(|map| (ssim(&screens[0], &screens[1]), map)))
    });
    let refuse = |error: InputError| value_error(error.to_string());
    let Some((ssim, map)) = found.map_err(refuse)? else {
        return Err(value_error("expected two pictures of the same size, with a positive number of pixels per degree"));
    };
    let errors = Array2::from_shape_vec((shape[0], shape[1]), map.errors).map_err(|e| value_error(e.to_string()))?;
    Ok((ssim, map.mean, map.maximum, errors.into_pyarray(py)))
}

fn picture(array: &PyReadonlyArray3<'_, f32>, unit: ChannelUnit) -> PyResult<Picture> {
    let view = array.as_array();
    let &[height, width, 3] = view.shape() else {
        return Err(value_error(format!("expected a picture of shape (height, width, 3), found {:?}", view.shape())));
    };
    let side = |side: usize| u32::try_from(side).unwrap_or(u32::MAX);
    let mut picture = Picture::new(side(width), side(height));
    for (place, name) in ["R", "G", "B"].into_iter().enumerate() {
        let samples = view.iter().skip(place).step_by(3).copied().collect();
        let refuse = |error: InputError| value_error(error.to_string());
        picture = picture.with(name, unit, Samples::Float(samples)).map_err(refuse)?;
    }
    Ok(picture)
}

//! A medium: scattering and absorption per mm, and the index of refraction.

use crate::error::{InputError, ensure, input_error};

/// The least reduced scattering coefficient, per mm.
pub const MIN_SCATTERING: f64 = 1e-30;
/// The largest coefficient, per mm.
pub const MAX_COEFFICIENT: f64 = 1e30;
/// The largest index of refraction. The polynomial for the internal reflectance, fitted to common dielectrics, has an
/// error of 0.0003 at 1.3 and 0.016 at 3, and exceeds 1 from 3.85.
pub const MAX_ETA: f64 = 3.0;

fn check_finite(what: &str, found: f64) -> Result<(), InputError> {
    ensure!(found.is_finite(), "subsurface::material" => "expected a finite number for the {what}, found {found}");
    Ok(())
}

/// Scattering and absorption of one channel, per mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coefficients {
    /// The reduced scattering coefficient sigma'_s = (1 - g) sigma_s, as if scattering were isotropic.
    pub sigma_s_prime: f64,
    /// The absorption coefficient sigma_a.
    pub sigma_a: f64,
}

impl Coefficients {
    /// Checks that the coefficients are valid: both finite, absorption at least 0, scattering above 0.
    pub fn check(self) -> Result<(), InputError> {
        let scattering = "reduced scattering coefficient";
        for (what, found) in [(scattering, self.sigma_s_prime), ("absorption coefficient", self.sigma_a)] {
            check_finite(what, found)?;
            ensure!(found >= 0.0, "subsurface::material" => "expected at least 0 for the {what}, found {found}");
            ensure!(found <= MAX_COEFFICIENT, "subsurface::material" =>
                "expected at most {MAX_COEFFICIENT:e} per mm for the {what}, found {found:e}");
        }
        let found = self.sigma_s_prime;
        ensure!(found != 0.0, "subsurface::material" =>
            "expected a {scattering} above 0: without scattering no light comes back");
        ensure!(found >= MIN_SCATTERING, "subsurface::material" =>
            "expected at least {MIN_SCATTERING:e} per mm for the {scattering}, found {found:e}");
        Ok(())
    }

    /// The reduced extinction coefficient sigma'_t = sigma'_s + sigma_a, per mm.
    pub fn sigma_t_prime(self) -> f64 {
        self.sigma_s_prime + self.sigma_a
    }

    /// The fraction of extinction that is scattering, alpha' = sigma'_s / sigma'_t.
    pub fn alpha_prime(self) -> f64 {
        self.sigma_s_prime / self.sigma_t_prime()
    }
}

/// Checks that `eta` is a valid index of refraction for the dipole.
pub(crate) fn check_eta(eta: f64) -> Result<(), InputError> {
    check_finite("index of refraction", eta)?;
    ensure!((1.0..=MAX_ETA).contains(&eta), "subsurface::material" =>
        "expected an index of refraction from 1 to {MAX_ETA}, found {eta:?}");
    Ok(())
}

/// A medium in red, green and blue.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Name of the material.
    pub name: String,
    /// Red, green and blue.
    pub channels: [Coefficients; 3],
    /// The index of refraction relative to the outside.
    pub eta: f64,
}

impl Material {
    /// Names of the channels, in their order.
    pub const CHANNELS: [&'static str; 3] = ["red", "green", "blue"];

    /// Creates a material and checks its numbers.
    pub fn new(name: impl Into<String>, channels: [Coefficients; 3], eta: f64) -> Result<Self, InputError> {
        check_eta(eta)?;
        for (channel, coefficients) in Self::CHANNELS.into_iter().zip(channels) {
            let checked = coefficients.check();
            checked.map_err(|problem| input_error!("subsurface::material" => "{channel} channel: {problem}"))?;
        }
        Ok(Self { name: name.into(), channels, eta })
    }
}

//! A medium: how much it scatters and absorbs per mm of path, and its index of refraction.

use thiserror::Error;

/// The least reduced scattering coefficient, per mm.
pub const MIN_SCATTERING: f64 = 1e-30;
/// The largest coefficient, per mm.
pub const MAX_COEFFICIENT: f64 = 1e30;
/// The largest index of refraction. The polynomial for the internal reflectance, fitted to common dielectrics, is
/// 0.0003 off at 1.3, 0.016 at 3, and exceeds 1 from 3.85.
pub const MAX_ETA: f64 = 3.0;

/// Why there is no such medium.
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, Error)]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum MaterialError {
    /// A coefficient or index is NaN or infinite.
    #[error("expected a finite number for the {what}, found {found}")]
    NotFinite { what: &'static str, found: f64 },
    /// A coefficient below 0.
    #[error("expected at least 0 for the {what}, found {found}")]
    Negative { what: &'static str, found: f64 },
    /// Nothing is scattered, so that no light comes back.
    #[error("expected a reduced scattering coefficient above 0: without scattering no light comes back")]
    NoScattering,
    /// A coefficient that no medium has, which the lengths would overflow with.
    #[error("expected {MIN_SCATTERING:e} to {MAX_COEFFICIENT:e} per mm for the {what}, found {found:e}")]
    OutOfRange { what: &'static str, found: f64 },
    /// The index of refraction relative to the outside is below 1 or above [`MAX_ETA`].
    #[error("expected an index of refraction from 1 to {MAX_ETA}, found {found:?}")]
    Eta { found: f64 },
    /// One channel of a material is wrong.
    #[error("{channel} channel: {problem}")]
    Channel { channel: &'static str, problem: Box<MaterialError> },
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
    /// The coefficients, checked as in [`Self::check`].
    ///
    /// # Errors
    /// [`MaterialError`] for figures that make no medium.
    pub fn new(sigma_s_prime: f64, sigma_a: f64) -> Result<Self, MaterialError> {
        let coefficients = Self { sigma_s_prime, sigma_a };
        coefficients.check().map(|()| coefficients)
    }

    /// Checks that the coefficients make a medium: both finite, absorption at least 0, scattering above 0.
    ///
    /// # Errors
    /// [`MaterialError`] says which figure is wrong.
    pub fn check(self) -> Result<(), MaterialError> {
        let scattering = ("reduced scattering coefficient", self.sigma_s_prime);
        for (what, found) in [scattering, ("absorption coefficient", self.sigma_a)] {
            if !found.is_finite() {
                return Err(MaterialError::NotFinite { what, found });
            }
            if found < 0.0 {
                return Err(MaterialError::Negative { what, found });
            }
            if found > MAX_COEFFICIENT {
                return Err(MaterialError::OutOfRange { what, found });
            }
        }
        let (what, found) = scattering;
        match found {
            0.0 => Err(MaterialError::NoScattering),
            _ if found < MIN_SCATTERING => Err(MaterialError::OutOfRange { what, found }),
            _ => Ok(()),
        }
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

/// Checks that the dipole takes `eta` as an index of refraction.
///
/// # Errors
/// [`MaterialError`] if it is not in [1, [`MAX_ETA`]].
pub(crate) fn check_eta(eta: f64) -> Result<(), MaterialError> {
    if !eta.is_finite() {
        return Err(MaterialError::NotFinite { what: "index of refraction", found: eta });
    }
    if (1.0..=MAX_ETA).contains(&eta) { Ok(()) } else { Err(MaterialError::Eta { found: eta }) }
}

/// A medium in red, green and blue.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Its name.
    pub name: String,
    /// Red, green and blue.
    pub channels: [Coefficients; 3],
    /// The index of refraction relative to the outside.
    pub eta: f64,
}

impl Material {
    /// Names of the channels, in their order.
    pub const CHANNELS: [&'static str; 3] = ["red", "green", "blue"];

    /// A material out of checked figures.
    ///
    /// # Errors
    /// [`MaterialError`] says which figure of which channel is wrong.
    pub fn new(name: impl Into<String>, channels: [Coefficients; 3], eta: f64) -> Result<Self, MaterialError> {
        check_eta(eta)?;
        for (channel, coefficients) in Self::CHANNELS.into_iter().zip(channels) {
            coefficients.check().map_err(|problem| MaterialError::Channel { channel, problem: Box::new(problem) })?;
        }
        Ok(Self { name: name.into(), channels, eta })
    }
}

//! The dipole of Jensen, Marschner, Levoy and Hanrahan 2001: the exitance of a half space, by the distance from the
//! point at which light enters.
//!
//! The radial integral of R_d has a closed form, for discs and the plane.

use std::f64::consts::PI;

use super::fresnel::internal_reflectance_polynomial;
use super::material::{Coefficients, check_eta};
use crate::elementary::{exp, exp_m1, hypot};
use crate::error::InputError;
use crate::quadrature::graded_integral;

/// Intervals of the quadrature over the plane; the first ends at 2^-59 of the end of the last.
const PANELS: u32 = 60;

/// The dipole of one channel, with lengths in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dipole {
    coefficients: Coefficients,
    eta: f64,
    /// A = (1 + F_dr) / (1 - F_dr), the boundary's effect by internal reflection.
    boundary: f64,
    sigma_tr: f64,
    z_r: f64,
    z_v: f64,
}

impl Dipole {
    /// Creates the dipole of a medium, with the polynomial for internal reflection. Fails as [`Coefficients::check`]
    /// does, and if `eta` is below 1 or above [`super::MAX_ETA`].
    pub fn new(c: Coefficients, eta: f64) -> Result<Self, InputError> {
        c.check()?;
        check_eta(eta)?;
        let f_dr = internal_reflectance_polynomial(eta);
        let boundary = (1.0 + f_dr) / (1.0 - f_dr);
        let sigma_t = c.sigma_t_prime();
        let z_r = 1.0 / sigma_t;
        // sqrt(3 sigma_a sigma'_t), without overflow.
        let sigma_tr = sigma_t * (3.0 * (c.sigma_a / sigma_t)).sqrt();
        Ok(Self { coefficients: c, eta, boundary, sigma_tr, z_r, z_v: z_r * (1.0 + 4.0 / 3.0 * boundary) })
    }

    /// The medium.
    pub fn coefficients(&self) -> Coefficients {
        self.coefficients
    }

    /// The index of refraction.
    pub fn eta(&self) -> f64 {
        self.eta
    }

    /// The reduced extinction coefficient sigma'_t, per mm.
    pub fn sigma_t_prime(&self) -> f64 {
        self.coefficients.sigma_t_prime()
    }

    /// The reduced albedo alpha' = sigma'_s / sigma'_t.
    pub fn alpha_prime(&self) -> f64 {
        self.coefficients.alpha_prime()
    }

    /// The effective transport coefficient sigma_tr = sqrt(3 sigma_a sigma'_t), per mm.
    pub fn sigma_tr(&self) -> f64 {
        self.sigma_tr
    }

    /// 1 / sigma_tr: the distance over which diffuse light falls by the factor e. Infinite without absorption.
    pub fn diffusion_length(&self) -> f64 {
        1.0 / self.sigma_tr
    }

    /// The mean free path 1 / sigma'_t, equal to [`Self::z_r`].
    pub fn mean_free_path(&self) -> f64 {
        self.z_r
    }

    /// The depth of the real source below the surface.
    pub fn z_r(&self) -> f64 {
        self.z_r
    }

    /// The height of the virtual source above the surface.
    pub fn z_v(&self) -> f64 {
        self.z_v
    }

    /// R_d at a distance of r mm, per mm^2: the exitance there per flux that enters at a point; 0 for infinite r.
    pub fn r_d(&self, r: f64) -> f64 {
        let source = |z: f64| {
            let d = hypot(r, z);
            z / d * ((self.sigma_tr + 1.0 / d) / d) * exp(-self.sigma_tr * d)
        };
        if r.is_infinite() {
            return 0.0;
        }
        self.alpha_prime() / (4.0 * PI) * (source(self.z_r) + source(self.z_v))
    }

    /// G(r), the integral of R_d over a disc of radius r: the fraction of light that leaves within r mm of its entry.
    pub fn disc(&self, r: f64) -> f64 {
        self.disc_at(0.0, r)
    }

    /// The integral of R_d over a disc of radius `rho`, from the point `height` above its centre, to full
    /// precision even if the disc is small or far away. It is `G(sqrt(rho^2 + height^2)) - G(height)`.
    pub fn disc_at(&self, height: f64, rho: f64) -> f64 {
        if rho.is_infinite() {
            return self.beyond(height);
        }
        let source = |z: f64| {
            let near = hypot(height, z);
            let far = hypot(near, rho);
            // far - near.
            let longer = rho * (rho / (near + far));
            let fall = exp_m1(-self.sigma_tr * longer);
            z / near * exp(-self.sigma_tr * near) * (longer / far * (1.0 + fall) - fall)
        };
        0.5 * self.alpha_prime() * (source(self.z_r) + source(self.z_v))
    }

    /// G(outer) - G(inner), the integral of R_d over a ring, to full precision even if the ring is narrow.
    pub fn ring(&self, inner: f64, outer: f64) -> f64 {
        self.disc_at(inner, (outer - inner).sqrt() * (outer + inner).sqrt())
    }

    /// The integral of R_d over the plane outside a disc of radius r.
    pub fn beyond(&self, r: f64) -> f64 {
        if r.is_infinite() {
            return 0.0;
        }
        let source = |z: f64| {
            let d = hypot(r, z);
            z / d * exp(-self.sigma_tr * d)
        };
        0.5 * self.alpha_prime() * (source(self.z_r) + source(self.z_v))
    }

    /// The integral of R_d over the plane: `alpha' / 2 (1 + e^(-4/3 A q)) e^-q`, `q = sqrt(3 (1 - alpha'))`.
    pub fn total(&self) -> f64 {
        let q = (3.0 * (self.coefficients.sigma_a / self.sigma_t_prime())).sqrt();
        0.5 * self.alpha_prime() * (1.0 + exp(-4.0 / 3.0 * self.boundary * q)) * exp(-q)
    }

    /// [`Self::total`] by quadrature of R_d, over a disc of radius 10^4 z_v; the rest is in closed form.
    pub fn integrated_total(&self) -> f64 {
        let radius = 1e4 * self.z_v;
        graded_integral(radius, PANELS, |r| 2.0 * PI * r * self.r_d(r)) + self.beyond(radius)
    }

    /// The radius of the disc that contains `fraction` of [`Self::total`]; 0 for fractions up to 0, infinite from 1.
    pub fn radius_of(&self, fraction: f64) -> f64 {
        if fraction <= 0.0 || fraction.is_nan() {
            return 0.0;
        }
        if fraction >= 1.0 {
            return f64::INFINITY;
        }
        let left = (1.0 - fraction) * self.beyond(0.0);
        let [mut low, mut high] = [0.0, self.z_r];
        while self.beyond(high) > left && high.is_finite() {
            [low, high] = [high, 2.0 * high];
        }
        // Bisects until no number lies between the bounds.
        loop {
            let middle = low + 0.5 * (high - low);
            if middle <= low || middle >= high {
                return high;
            }
            if self.beyond(middle) > left {
                low = middle;
            } else {
                high = middle;
            }
        }
    }
}

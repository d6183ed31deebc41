//! Equations 1 and 2 in plain f64: the linear system, and its updates with unchanged form factors. [`solve`] has the
//! Jacobi iteration of equations 3 and 4, and other solvers.

use super::FormFactors;
use super::solve::{self, Options, Solution, Solver};
use crate::error::{InputError, ensure, input_error};
use crate::linalg::Matrix;

/// Red, green and blue per patch.
type PerPatch = Vec<[f64; 3]>;

/// Form factors with the reflectances and emittances of the patches, which can be replaced.
#[derive(Clone, Debug, PartialEq)]
pub struct System {
    factors: FormFactors,
    reflectance: PerPatch,
    emittance: PerPatch,
}

/// Solutions of the three channels.
#[derive(Clone, Debug, PartialEq)]
pub struct RgbSolution {
    /// The solutions of red, green and blue.
    pub channels: [Solution; 3],
}

impl RgbSolution {
    /// Radiosity of each patch: red, green, blue.
    pub fn radiosity(&self) -> PerPatch {
        let [red, green, blue] = &self.channels;
        (0..red.radiosity.len()).map(|i| [red, green, blue].map(|channel| channel.radiosity[i])).collect()
    }
}

impl System {
    /// Creates a system with one reflectance, in [0, 1), and one emittance per patch.
    pub fn new(factors: FormFactors, reflectance: PerPatch, emittance: PerPatch) -> Result<Self, InputError> {
        ensure!(!factors.is_empty(), "radiosity::system" => "expected patches, found none");
        let mut system = Self { factors, reflectance, emittance: Vec::new() };
        system.count("reflectances", &system.reflectance)?;
        if let Some((patch, value)) = first(&system.reflectance, |value| !(0.0..1.0).contains(&value)) {
            return Err(input_error!("radiosity::system" =>
                "expected reflectances of at least 0 and below 1, found {value} for patch {patch} (counted from 0); \
                 a surface that absorbs nothing has no solution"));
        }
        system.set_emittance(emittance)?;
        Ok(system)
    }

    /// Replaces the emittances. The matrix does not change. Fails with [`InputError`]; the system is then unchanged.
    pub fn set_emittance(&mut self, emittance: PerPatch) -> Result<(), InputError> {
        self.count("emittances", &emittance)?;
        if let Some((patch, value)) = first(&emittance, |value| !(value >= 0.0 && value.is_finite())) {
            return Err(input_error!("radiosity::system" =>
                "expected finite emittances of at least 0, found {value} for patch {patch} (counted from 0)"));
        }
        self.emittance = emittance;
        Ok(())
    }

    fn count(&self, what: &'static str, values: &PerPatch) -> Result<(), InputError> {
        let (patches, found) = (self.factors.len(), values.len());
        ensure!(patches == found, "radiosity::system" => "expected {patches} {what}, one per patch, found {found}");
        Ok(())
    }

    /// The form factors.
    pub fn factors(&self) -> &FormFactors {
        &self.factors
    }

    /// The reflectance of each patch.
    pub fn reflectance(&self) -> &[[f64; 3]] {
        &self.reflectance
    }

    /// The emittance of each patch.
    pub fn emittance(&self) -> &[[f64; 3]] {
        &self.emittance
    }

    /// Returns the right-hand side of equation 2 in a channel (0 red, 1 green, 2 blue). Panics for another channel.
    pub fn right_hand_side(&self, channel: usize) -> Vec<f64> {
        self.emittance.iter().map(|e| e[channel]).collect()
    }

    /// The matrix of equation 2 in a channel, the identity minus reflectance times form factor. Panics above 2.
    pub fn matrix(&self, channel: usize) -> Matrix {
        let mut matrix = self.factors.matrix().clone();
        for (i, rho) in self.reflectance.iter().enumerate() {
            let row = matrix.row_mut(i);
            row.iter_mut().for_each(|value| *value = -(rho[channel] * *value));
            row[i] += 1.0;
        }
        matrix
    }

    /// Solves one channel.
    pub fn solve_channel(&self, channel: usize, solver: Solver, options: &Options) -> Result<Solution, InputError> {
        let right_hand_side = &self.right_hand_side(channel);
        let problem = solve::Problem { matrix: &self.matrix(channel), right_hand_side, areas: self.factors.areas() };
        solve::solve(solver, &problem, options)
    }

    /// Solves all three channels; equal channels are solved only once. Fails with [`InputError`].
    pub fn solve(&self, solver: Solver, options: &Options) -> Result<RgbSolution, InputError> {
        let channel = |c: usize| self.solve_channel(c, solver, options);
        let alike = |c: usize, d: usize| {
            let same = |values: &[[f64; 3]]| values.iter().all(|value| value[c].to_bits() == value[d].to_bits());
            same(&self.reflectance) && same(&self.emittance)
        };
        let red = channel(0)?;
        let green = if alike(1, 0) { red.clone() } else { channel(1)? };
        let blue = match [0, 1].map(|d| alike(2, d)) {
            [true, _] => red.clone(),
            [_, true] => green.clone(),
            _ => channel(2)?,
        };
        Ok(RgbSolution { channels: [red, green, blue] })
    }

    /// Computes the mean square of the residual of equation 2, E - M B, in each channel: Figure 3's error. M is not
    /// formed. Panics if there is not one radiosity per patch.
    pub fn residual(&self, radiosity: &[[f64; 3]]) -> [f64; 3] {
        assert_eq!(radiosity.len(), self.factors.len(), "one radiosity per patch");
        [0, 1, 2].map(|c| {
            let b: Vec<f64> = radiosity.iter().map(|b| b[c]).collect();
            let arriving = self.factors.matrix().times(&b);
            let left = |i: usize| self.emittance[i][c] - (b[i] - self.reflectance[i][c] * arriving[i]);
            solve::mean_square(&(0..b.len()).map(left).collect::<Vec<_>>())
        })
    }

    /// Computes the energy-balance error in each channel: power emitted, minus power absorbed and power that leaves the
    /// room. It is 0 for reciprocal form factors and an exact solution.
    pub fn energy_balance_error(&self, radiosity: &[[f64; 3]]) -> [f64; 3] {
        [0, 1, 2].map(|c| {
            let b: Vec<f64> = radiosity.iter().map(|b| b[c]).collect();
            let arriving = self.factors.matrix().times(&b);
            let sums = self.factors.row_sums();
            let (mut emitted, mut gone) = (0.0, 0.0);
            for (i, area) in self.factors.areas().iter().enumerate() {
                emitted += area * self.emittance[i][c];
                gone += area * ((1.0 - self.reflectance[i][c]) * arriving[i] + (1.0 - sums[i]) * b[i]);
            }
            emitted - gone
        })
    }
}

fn first(values: &PerPatch, wrong: impl Fn(f64) -> bool) -> Option<(usize, f64)> {
    let mut all = values.iter().enumerate().flat_map(|(patch, color)| color.map(|value| (patch, value)));
    all.find(|&(_, value)| wrong(value))
}

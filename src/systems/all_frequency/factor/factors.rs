//! G and F of equation 9.

use std::f64::consts::PI;

use glam::DVec3;

use crate::linalg::dot;
use crate::sphere::ParabolicMap;

/// f(v, s) as the sum over k of G_k(v) F_k(s), by texels of parabolic maps and bilinear between their centers.
#[derive(Clone, Debug, PartialEq)]
pub struct ProductFactors {
    terms: usize,
    view: FactorMap,
    light: FactorMap,
}

/// Terms by texels.
#[derive(Clone, Debug, PartialEq)]
struct FactorMap {
    map: ParabolicMap,
    /// All terms of a texel, followed by those of the next.
    values: Vec<f64>,
}

impl FactorMap {
    fn texel(&self, terms: usize, texel: usize) -> &[f64] {
        &self.values[texel * terms..(texel + 1) * terms]
    }

    fn read(&self, direction: DVec3, into: &mut [f64]) {
        let taps = self.map.taps(direction).map(|(texel, weight)| (self.texel(into.len(), texel), weight));
        for (k, value) in into.iter_mut().enumerate() {
            *value = taps.iter().map(|(texel, weight)| weight * texel[k]).sum();
        }
    }
}

impl ProductFactors {
    /// Factors of this many terms from two maps, each with the values of its texels, term by term.
    ///
    /// # Panics
    /// If a map does not have `terms` values per texel.
    pub fn new(terms: usize, view: (ParabolicMap, Vec<f64>), light: (ParabolicMap, Vec<f64>)) -> Self {
        let of = |(map, values): (ParabolicMap, Vec<f64>)| FactorMap { map, values };
        let (view, light) = (of(view), of(light));
        for map in [&view, &light] {
            assert_eq!(map.values.len(), map.map.texels() * terms, "all terms of each texel");
        }
        Self { terms, view, light }
    }

    /// m, the number of terms.
    pub const fn terms(&self) -> usize {
        self.terms
    }

    /// The map of G.
    pub const fn view_map(&self) -> ParabolicMap {
        self.view.map
    }

    /// The map of F.
    pub const fn light_map(&self) -> ParabolicMap {
        self.light.map
    }

    /// Both maps' values, texel by texel: G, then F.
    pub fn values(&self) -> [&[f64]; 2] {
        [&self.view.values, &self.light.values]
    }

    /// G at a texel, by row times side plus column.
    ///
    /// # Panics
    /// If there is no such texel.
    pub fn view_texel(&self, texel: usize) -> &[f64] {
        self.view.texel(self.terms, texel)
    }

    /// F at a texel.
    ///
    /// # Panics
    /// If there is no such texel.
    pub fn light_texel(&self, texel: usize) -> &[f64] {
        self.light.texel(self.terms, texel)
    }

    /// G at a direction of length 1 towards the viewer.
    ///
    /// # Panics
    /// If there is not a place per term.
    pub fn view(&self, direction: DVec3, into: &mut [f64]) {
        assert_eq!(into.len(), self.terms, "a place per term");
        self.view.read(direction, into);
    }

    /// F at a direction of length 1 towards the light.
    ///
    /// # Panics
    /// If there is not a place per term.
    pub fn light(&self, direction: DVec3, into: &mut [f64]) {
        assert_eq!(into.len(), self.terms, "a place per term");
        self.light.read(direction, into);
    }

    /// G(v) . F(s).
    pub fn product(&self, view: DVec3, light: DVec3) -> f64 {
        let [mut g, mut f] = [vec![0.0; self.terms], vec![0.0; self.terms]];
        self.view(view, &mut g);
        self.light(light, &mut f);
        dot(&g, &f)
    }
}

/// The one term of a diffuse surface, exact: F = s_z and G = albedo / pi. A table would lose s_z to interpolation, most
/// at the horizon.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DiffuseFactor {
    /// Reflectance.
    pub albedo: f64,
}

impl DiffuseFactor {
    /// G, the same for all views.
    pub const fn view(self) -> f64 {
        self.albedo / PI
    }

    /// F at a direction of length 1 towards the light: 0 below the horizon.
    pub const fn light(direction: DVec3) -> f64 {
        direction.z.max(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::all_frequency::factor::{FactorSampling, Factorization, Lobe, Supersamples};
    use crate::transfer::brdf::Brdf;

    fn factorization(product: &dyn super::super::ProductFunction, terms: usize) -> Factorization {
        let sampling = FactorSampling { side: 8, supersamples: Supersamples::NONE, ..FactorSampling::default() };
        Factorization::new(&sampling.table(product, &mut |_, _| ()).expect("a table"), terms).expect("terms")
    }

    #[test]
    fn the_root_of_a_singular_value_is_in_both() {
        let found = factorization(&Lobe::cook_torrance(0.5, 0.5), 3);
        let factors = found.factors(3);
        for k in 0..3 {
            let energy = |texel: &dyn Fn(usize) -> f64| (0..64).map(|at| texel(at) * texel(at)).sum::<f64>();
            for squares in [energy(&|at| factors.view_texel(at)[k]), energy(&|at| factors.light_texel(at)[k])] {
                assert!((squares - found.singular_values()[k]).abs() < 1e-12 * squares, "{k}: {squares}");
            }
            let f = (0..64).map(|at| factors.light_texel(at)[k]);
            assert!(f.fold(0.0_f64, |most, f| if f.abs() > most.abs() { f } else { most }) > 0.0, "the sign of {k}");
        }
    }

    #[test]
    fn texel_centers_read_their_texels() {
        let factors = factorization(&Lobe::schlick(0.4, 0.5, 0.8), 4).factors(4);
        let [view, light] = [factors.view_map().direction(2, 5), factors.light_map().direction(4, 3)];
        let expected = dot(factors.view_texel(42), factors.light_texel(28));
        assert!((factors.product(view, light) - expected).abs() < 1e-14);
        assert_eq!(factors.terms(), 4);
    }

    #[test]
    fn a_diffuse_surface_has_one_term() {
        let lambert = Brdf::Lambert { albedo: 0.6 };
        let table = FactorSampling::default().table(&lambert, &mut |_, _| ()).expect("a table");
        let found = Factorization::new(&table, 1).expect("a term");
        assert_eq!(found.rank(), 1);
        assert!(found.relative_squared_error(1) < 1e-28, "{}", found.relative_squared_error(1));
        let exact = DiffuseFactor { albedo: 0.6 };
        // Texels at the horizon are means with 0 below it.
        for z in [0.4_f64, 0.6, 0.9] {
            let light = DVec3::new((1.0 - z * z).sqrt(), 0.0, z);
            let [tabled, expected] =
                [found.factors(1).product(DVec3::Z, light), exact.view() * DiffuseFactor::light(light)];
            assert!((tabled - expected).abs() < 2e-3 * 0.6, "{z}: {tabled} {expected}");
        }
        assert_eq!(DiffuseFactor::light(DVec3::NEG_Z), 0.0);
    }
}

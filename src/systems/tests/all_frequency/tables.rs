//! Tables of reflectance, sampled from a lobe or given as numbers.

use std::path::Path;

use crossbar_systems::all_frequency::factor::{
    FactorSampling, FresnelForm, Lobe, ProductFunction, ProductSymmetry, ProductTable, Supersamples,
};
use crossbar_systems::transfer::brdf::Brdf;
use glam::DVec3;

use crate::io::NumberTable;
use crate::sphere::ParabolicMap;

/// A product function that declares no symmetry.
struct Plain(Lobe);

impl ProductFunction for Plain {
    fn value(&self, view: DVec3, light: DVec3) -> f64 {
        self.0.value(view, light)
    }

    fn symmetry(&self) -> ProductSymmetry {
        ProductSymmetry::None
    }
}

fn sampled(sampling: FactorSampling, product: &dyn ProductFunction) -> ProductTable {
    sampling.table(product, &mut |_, _| ()).expect("a table")
}

fn largest_difference(a: &ProductTable, b: &ProductTable) -> f64 {
    let pairs = a.values().rows().flatten().zip(b.values().rows().flatten());
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

#[test]
fn symmetry_saves_work_and_changes_nothing() {
    for lobe in [Lobe::cook_torrance(0.4, 0.5), Lobe::schlick(0.2, 0.2, 0.8)] {
        for side in [1, 2, 5, 8] {
            let supersamples = Supersamples { view: 2, light: 3 };
            let sampling = FactorSampling { side, supersamples, ..FactorSampling::default() };
            let difference = largest_difference(&sampled(sampling, &lobe), &sampled(sampling, &Plain(lobe)));
            assert!(difference < 1e-11, "{lobe:?} {side}: {difference}");
        }
    }
}

#[test]
fn values_are_means_over_the_samples_of_a_pair() {
    let lobe = Lobe { fresnel: FresnelForm::Constant, ..Lobe::cook_torrance(0.5, 0.6) };
    let supersamples = Supersamples { view: 2, light: 2 };
    let sampling = FactorSampling { side: 4, supersamples, limit: f64::INFINITY };
    let found = sampled(sampling, &lobe);
    let (fine, mut sum) = (ParabolicMap::new(8), 0.0);
    // View texel (1, 2) and light texel (3, 2), which lies partly below the horizon.
    for (a, b, c, d) in (0..16).map(|at| (at & 1, at >> 1 & 1, at >> 2 & 1, at >> 3 & 1)) {
        let [view, light] = [fine.direction(2 + a, 4 + b), fine.direction(6 + c, 4 + d)];
        sum += if light.z > 0.0 { lobe.value(view, light) } else { 0.0 };
    }
    let value = found.values().row(9)[11];
    assert!((value - sum / 16.0).abs() < 1e-15 && value > 0.0, "{value} {}", sum / 16.0);
}

#[test]
fn bad_figures_are_refused() {
    let ward = Brdf::Ward { albedo: 0.0, specular: 0.5, roughness: [0.2, 0.3] };
    let message =
        |sampling: FactorSampling| sampling.table(&ward, &mut |_, _| ()).map(|_| ()).expect_err("refused").to_string();
    let base = FactorSampling::default();
    assert_eq!(
        message(FactorSampling { side: 0, ..base }),
        "expected 1 to 48 texels for the side of the maps, found 0"
    );
    assert!(message(FactorSampling { limit: f64::NAN, ..base }).contains("limit of f"));
    let supersamples = Supersamples { view: 17, light: 1 };
    assert!(message(FactorSampling { supersamples, ..base }).contains("1 to 16"));
}

fn table(rows: usize, columns: usize, values: &[f64]) -> Result<ProductTable, String> {
    let values = values.iter().copied().cycle().take(rows * columns).collect();
    let found = ProductTable::of_numbers(&NumberTable { columns, values }, Path::new("q.csv"));
    found.map_err(|error| error.to_string())
}

#[test]
fn maps_may_differ_in_size() {
    let table = table(4, 9, &[1.0, 2.0, 3.0]).expect("a table");
    assert_eq!([table.view().side(), table.light().side()], [2, 3]);
    assert_eq!(table.values().row(1)[5], 3.0);
    // Texel 4 is at the center of the light's map, with value 2 for any view.
    assert_eq!(table.interpolated(DVec3::Z, DVec3::Z), 2.0);
}

#[test]
fn what_is_no_table_is_named() {
    let error = |rows, columns, values: &[f64]| table(rows, columns, values).expect_err("no table");
    assert_eq!(
        error(5, 4, &[1.0]),
        "q.csv: expected a square number of rows up to 2304, a texel of a square map each, found 5"
    );
    assert!(error(4, 7, &[1.0]).contains("columns"));
    assert_eq!(
        error(4, 4, &[1.0, 2.0, 3.0, -0.5]),
        "q.csv: expected finite numbers of at least 0, found -0.5 in row 0, column 3 (counted from 0)"
    );
    assert!(error(4, 4, &[f64::NAN]).contains("found NaN in row 0, column 0"));
    assert!(error(1, 49 * 49, &[0.0]).contains("2401"));
}

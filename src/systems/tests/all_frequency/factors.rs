//! Factors of tables of reflectance, and the errors of the factors.

use std::f64::consts::PI;

use crossbar_systems::all_frequency::factor::{
    DiscSamples, FactorSampling, Factorization, HemisphereSamples, Lobe, ProductErrors, ProductFunction, Supersamples,
};
use crossbar_systems::transfer::brdf::Brdf;
use glam::DVec3;

use crate::linalg::{LeadingSvd, dot};

fn factorization(product: &dyn ProductFunction, terms: usize) -> Factorization {
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
fn a_map_of_32_has_812_texels_in_its_disc() {
    for (side, inside) in [(1, 1), (2, 4), (32, 812)] {
        let sampling = FactorSampling { side, supersamples: Supersamples::NONE, ..FactorSampling::default() };
        let table = sampling.table(&Brdf::Lambert { albedo: 1.0 }, &mut |_, _| ()).expect("a table");
        assert_eq!(DiscSamples::new(&table).counts(), [inside; 2]);
    }
    let directions = ProductErrors::directions();
    let mean = directions.iter().sum::<DVec3>() / 1024.0;
    assert!(mean.x.abs() < 1e-2 && mean.y.abs() < 1e-2 && (mean.z - 0.5).abs() < 1e-12, "{mean}");
}

/// With as many terms as the rank there is no error; with fewer, the error follows from the dropped singular values.
/// All directions have equal solid angles.
#[test]
fn terms_of_equal_angles_are_those_of_their_singular_values() {
    let samples = HemisphereSamples::of_equal_angles(&Brdf::Lambert { albedo: 0.6 }, 3.0);
    let whole: f64 = samples.solid_angles[0].iter().sum();
    assert!(
        (whole - 2.0 * PI).abs() < 1e-12 && [samples.values.row_count(), samples.values.column_count()] == [1024; 2]
    );
    assert!(samples.term_errors(1).expect("a term").max < 1e-14, "Lambert has one term");
    let lobe = HemisphereSamples::of_equal_angles(&Brdf::Phong { albedo: 0.1, specular: 0.8, exponent: 9.0 }, 3.0);
    let values = LeadingSvd::new(&lobe.values, 1).expect("values").values;
    let expected = (values[4..].iter().map(|value| value * value).sum::<f64>() / (1024.0 * 1024.0)).sqrt();
    let found = lobe.term_errors(4).expect("terms").rms;
    assert!((found - expected).abs() < 1e-9 * expected, "{found} {expected}");
}

#[test]
fn errors_are_those_of_plain_sums() {
    let sampling = FactorSampling { side: 6, supersamples: Supersamples::NONE, ..FactorSampling::default() };
    let phong = Brdf::Phong { albedo: 0.1, specular: 0.8, exponent: 30.0 };
    let table = sampling.table(&phong, &mut |_, _| ()).expect("a table");
    let factors = Factorization::new(&table, 2).expect("terms").factors(2);
    let errors = DiscSamples::new(&table).errors(&factors);
    let (mut squared, mut energy, mut max, mut least, mut negative, mut pairs) = (0.0, 0.0, 0.0_f64, 1.0_f64, 0, 0);
    let (map, is_in) = (table.view(), |texel: usize| table.view().direction(texel % 6, texel / 6).z > 0.0);
    for (view, light) in (0..36).flat_map(|view| (0..36).map(move |light| (view, light))) {
        if is_in(view) && is_in(light) {
            let f = table.values().row(view)[light];
            let [v, s] = [view, light].map(|texel| map.direction(texel % 6, texel / 6));
            let found = factors.product(v, s);
            (squared, energy, pairs) = (squared + (found - f) * (found - f), energy + f * f, pairs + 1);
            (max, least) = (max.max((found - f).abs()), least.min(found));
            negative += usize::from(found < 0.0);
        }
    }
    let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-12, "{a} {b}");
    close(errors.rms, (squared / f64::from(pairs)).sqrt());
    close(errors.relative_squared_error, squared / energy);
    close(errors.max, max);
    close(errors.least, least);
    assert_eq!(errors.negative, negative as f64 / f64::from(pairs));
    assert!(errors.least < 0.0, "two terms of a sharp lobe ring");
}

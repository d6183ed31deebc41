//! Properties of the SVD, and of reflectance approximated by few terms.

use crossbar::all_frequency::factor::{
    Denominators, FactorSampling, Factorization, FresnelForm, Lobe, ProductFunction, ProductSymmetry, ProductTable,
    Shadowing, Supersamples,
};
use crossbar::geom::random::CounterRng;
use crossbar::io::NumberTable;
use crossbar::linalg::{Matrix, dot};
use crossbar::sphere::ParabolicMap;
use crossbar::transfer::brdf::Brdf;
use glam::DVec3;

const COOK_TORRANCE: Lobe = Lobe::cook_torrance(0.4, 0.5);
const SCHLICK: Lobe = Lobe::schlick(0.2, 0.2, 0.8);

fn sampled(side: usize, product: &dyn ProductFunction) -> ProductTable {
    let sampling =
        FactorSampling { side, supersamples: Supersamples { view: 2, light: 2 }, ..FactorSampling::default() };
    sampling.table(product, &mut |_, _| ()).expect("a table")
}

/// A table of random numbers in which no two rows are alike.
fn random([views, lights]: [usize; 2]) -> ProductTable {
    let draw = CounterRng::new(7);
    let [rows, columns] = [views * views, lights * lights];
    let values = (0..rows * columns).map(|at| draw.unit(at as u64, 0, 0)).collect();
    ProductTable::of_numbers(&NumberTable { columns, values }, "random".as_ref()).expect("a table")
}

fn tables() -> Vec<ProductTable> {
    let phong = Brdf::Phong { albedo: 0.1, specular: 0.7, exponent: 40.0 };
    vec![sampled(8, &COOK_TORRANCE), sampled(8, &SCHLICK), sampled(6, &phong), random([5, 7]), random([8, 3])]
}

fn all_terms(table: &ProductTable) -> Factorization {
    let rank = Factorization::new(table, 1).expect("a term").rank();
    Factorization::new(table, rank).expect("all terms")
}

/// The table minus its approximation with `terms` terms, for all pairs of a view and a light texel.
fn differences(table: &ProductTable, found: &Factorization, terms: usize) -> Matrix {
    let (factors, mut values) = (found.factors(terms), table.values().clone());
    for view in 0..table.view().texels() {
        for (light, value) in values.row_mut(view).iter_mut().enumerate() {
            *value -= dot(factors.view_texel(view), factors.light_texel(light));
        }
    }
    values
}

fn squares(values: &Matrix) -> f64 {
    values.rows().map(|row| dot(row, row)).sum()
}

/// "With enough terms (big enough m), ... our work can drive the approximation error to 0 for arbitrary BRDFs."
#[test]
fn as_many_terms_as_the_rank_are_the_table() {
    for table in tables() {
        let found = all_terms(&table);
        let left = differences(&table, &found, found.rank());
        let most = left.rows().flatten().fold(0.0_f64, |most, value| most.max(value.abs()));
        let rounding = f64::EPSILON * found.singular_values()[0] * table.view().texels() as f64;
        assert!(most <= rounding, "{most} of {rounding}");
        assert!(found.relative_squared_error(found.rank()) < 1e-28);
    }
}

/// The squared error of m terms is the sum of the squared omitted singular values, and no row has a larger error than
/// the first omitted singular value.
#[test]
fn the_error_is_the_tail_of_the_spectrum() {
    for table in tables() {
        let found = all_terms(&table);
        let energy = squares(table.values());
        let mut before = f64::INFINITY;
        for terms in [1, 2, 3, 5, 8] {
            let left = differences(&table, &found, terms);
            let [direct, said] = [squares(&left) / energy, found.relative_squared_error(terms)];
            assert!((direct - said).abs() < 1e-13, "{terms}: {direct} {said}");
            assert!(said < before, "one more term is nearer");
            before = said;
            let first = found.singular_values()[terms] * (1.0 + 1e-12);
            assert!(left.rows().all(|row| dot(row, row).sqrt() <= first), "{terms}");
        }
    }
}

#[test]
fn a_diffuse_surface_has_rank_1() {
    for side in [4, 9] {
        let sampling = FactorSampling { side, ..FactorSampling::default() };
        let table = sampling.table(&Brdf::Lambert { albedo: 0.7 }, &mut |_, _| ()).expect("a table");
        assert_eq!(Factorization::new(&table, 1).expect("a term").rank(), 1, "{side}");
        let refused = Factorization::new(&table, 2);
        assert_eq!(refused.unwrap_err().to_string(), "expected 1 to 1 terms, the rank of the table, found 2");
        assert_eq!(Factorization::up_to(&table, 10).expect("a term").terms(), 1);
    }
    let zeros = ProductTable::of_numbers(&NumberTable { columns: 4, values: vec![0.0; 16] }, "0".as_ref());
    assert_eq!(Factorization::new(&zeros.expect("a table"), 1).unwrap_err().error_code(), "crossbar::factor::dark");
}

/// Without the cosine and with the same samples for both sides, a reciprocal reflectance is a symmetric table.
#[test]
fn reciprocity_makes_a_symmetric_table() {
    struct WithoutCosine(Lobe);
    impl ProductFunction for WithoutCosine {
        fn value(&self, view: DVec3, light: DVec3) -> f64 {
            self.0.value(view, light) / light.z
        }
        fn symmetry(&self) -> ProductSymmetry {
            self.0.symmetry()
        }
    }
    for lobe in [COOK_TORRANCE, SCHLICK, Lobe { denominators: Denominators::Product, ..COOK_TORRANCE }] {
        let table = sampled(8, &WithoutCosine(lobe));
        let transposed = table.values().transposed();
        for (a, b) in table.values().rows().flatten().zip(transposed.rows().flatten()) {
            assert!((a - b).abs() <= 1e-12 * a.abs().max(1.0), "{a} {b}");
        }
    }
}

/// Singular values of isotropic lobes come in pairs: only a number of terms that splits a pair is reported.
#[test]
fn split_pairs_are_found() {
    let bare = Lobe {
        denominators: Denominators::Product,
        fresnel: FresnelForm::Constant,
        shadowing: Shadowing::None,
        ..COOK_TORRANCE
    };
    let sampling = FactorSampling { supersamples: Supersamples::NONE, ..FactorSampling::default() };
    let table = sampling.table(&bare, &mut |_, _| ()).expect("a table");
    let found = Factorization::new(&table, 12).expect("terms");
    let split: Vec<usize> = (1..=11).filter(|&terms| found.split_pair(terms).is_some()).collect();
    assert_eq!(split, [2, 4, 6, 9, 11]);
    let pair = found.split_pair(2).expect("a pair");
    assert!(pair.values[0] >= pair.values[1] && pair.terms == 2);
    assert_eq!(found.split_pair(0), None);
}

/// Means over finer samples converge; no texel exceeds the limit.
#[test]
fn more_samples_agree_and_the_limit_holds() {
    let table = |edge: usize, limit: f64| {
        let supersamples = Supersamples { view: edge, light: edge };
        let sampling = FactorSampling { side: 6, supersamples, limit };
        sampling.table(&COOK_TORRANCE, &mut |_, _| ()).expect("a table")
    };
    let distance = |a: &ProductTable, b: &ProductTable| {
        let pairs = a.values().rows().flatten().zip(b.values().rows().flatten());
        pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    };
    let [one, three, six] = [1, 3, 6].map(|edge| table(edge, f64::INFINITY));
    assert!(distance(&three, &six) < 0.5 * distance(&one, &six));
    assert!(table(3, 0.2).values().rows().flatten().all(|&value| (0.0..=0.2).contains(&value)));
    assert_eq!(ParabolicMap::new(6).texels(), 36);
}

//! Products in matrix units: errors, promotion, and where sums first differ.

use crossbar_ground::io::{NumberArray, NumbersOrCodes};
use crossbar_studies::report::Verdict;
use crossbar_studies::study::Study;
use crossbar_studies::study::matrix_product::{MatrixInput, MatrixProduct};
use refsim::num::{matrix::MatrixUnit, power_of_two, random_word};

use super::{StudyFiles, findings, number};

/// Numbers uniform in [0, 448), the range of E4M3.
fn uniform(shape: [usize; 2], seed: u64) -> MatrixInput {
    let number = |k: usize| 448.0 * f64::from(random_word(seed, k as u64)) / 4_294_967_296.0;
    let values = (0..shape[0] * shape[1]).map(number).collect();
    MatrixInput {
        name: "random".to_owned(),
        data: NumbersOrCodes::Numbers(NumberArray { shape: shape.to_vec(), values }),
    }
}

fn product(units: &[&str], [rows, depth, columns]: [usize; 3]) -> MatrixProduct {
    MatrixProduct {
        factors: [uniform([rows, depth], 1), uniform([depth, columns], 2)],
        addend: None,
        units: units.iter().map(|name| MatrixUnit::find(name).expect("a unit")).collect(),
        elements: [None, None],
        promotions: vec![None],
        against: None,
        blame: None,
        goal: None,
    }
}

#[test]
fn eight_bit_sums_drift_on_hopper_and_promotion_helps() {
    let mut study = product(&["hopper-fp8", "blackwell-f8f6f4"], [16, 4096, 16]);
    study.promotions = vec![None, Some(512), Some(128)];
    let rows = StudyFiles::of(&study).rows("errors.csv");
    let worst: Vec<f64> = rows.iter().map(|row| number(row, "worst")).collect();
    for (worst, printed) in worst.iter().zip([7.8e-2, 6.4e-3, 6.5e-4, 1.7e-6]) {
        assert!((worst / printed - 1.0).abs() < 0.15, "{worst} against {printed}");
    }
    assert!(rows.iter().take(3).all(|row| number(row, "mean") < 0.0), "cut sums are too small");
}

/// Product of a row and a column.
fn of_vectors(unit: &str, a: &[f64], b: &[f64]) -> MatrixProduct {
    let mut study = product(&[unit], [1, 1, 1]);
    for (factor, (shape, values)) in study.factors.iter_mut().zip([([1, a.len()], a), ([b.len(), 1], b)]) {
        factor.data = NumbersOrCodes::Numbers(NumberArray { shape: shape.to_vec(), values: values.to_vec() });
    }
    study
}

/// By exact arithmetic: 1.25 + 2^-40 is above the tie between 1 and 1.5, the scale of 1e300 is 2^127 and its element 6,
/// and the square of the double 1/3 is not a double.
#[test]
fn numbers_are_rounded_once_and_doubles_kept() {
    let result = |unit: &str, a: &[f64], b: &[f64]| {
        let study = of_vectors(unit, a, b);
        let files = StudyFiles::of(&study);
        let data = &files.bytes(&format!("{}.npy", study.units[0].name))[128..];
        let value = match data.len() {
            8 => f64::from_le_bytes(data.try_into().expect("eight bytes")),
            _ => f64::from(f32::from_le_bytes(data.try_into().expect("four bytes"))),
        };
        (value, number(&files.rows("errors.csv")[0], "differing"))
    };
    let tie = 1.25 + power_of_two(-40);
    assert_eq!(result("blackwell-mxf4", &[tie, 6.0], &[1.0, 0.0]), (1.5, 0.0));
    assert_eq!(result("blackwell-mxf4", &[1e300], &[power_of_two(-100)]).0, 1.5 * power_of_two(29));
    assert_eq!(result("fma-f64", &[1.0 / 3.0], &[1.0 / 3.0]), (1.0 / 9.0, 1.0));
}

/// A result of 0 in place of a number is too small, whatever the sign of the number.
#[test]
fn the_mean_error_of_lost_results_is_negative() {
    for small in [power_of_two(-20), -power_of_two(-20)] {
        let rows = StudyFiles::of(&of_vectors("volta-f16-f16", &[small], &[power_of_two(-20)])).rows("errors.csv");
        assert_eq!(number(&rows[0], "mean"), -1.0, "{small}");
    }
}

/// Elements that are infinite or NaN are counted, and an infinite sum is the exact one.
#[test]
fn what_is_not_finite_is_said() {
    for value in [f64::NAN, f64::INFINITY] {
        let study = of_vectors("hopper-f16", &[value, 1.0], &[1.0, 1.0]);
        let reference = "the exact product of the quantised operands";
        let excluded = format!(
            "1 of 1 elements are infinite or NaN in the result of hopper_f16_f32 with one accumulator or in \
             {reference}; the errors exclude them."
        );
        assert_eq!(
            findings(&study).conclusions(),
            [format!("Every finite element equals that of {reference}."), excluded]
        );
    }
}

#[test]
fn an_element_is_followed_to_the_block_where_it_parts() {
    let mut study = product(&["hopper-f16"], [3, 100, 4]);
    study.against = Some(MatrixUnit::find("ampere-f16").expect("a unit"));
    study.blame = Some([1, 2]);
    let files = StudyFiles::of(&study);
    let addends = files.rows("addends.csv");
    assert!(addends.iter().any(|row| number(row, "cut") != 0.0), "something was cut");
    assert!(addends.iter().all(|row| number(row, "exact") - number(row, "kept") == number(row, "cut")));
    assert_eq!(files.bytes("hopper_f16_f32.npy").len(), 128 + 4 * 12);
    study.blame = Some([3, 0]);
    assert!(study.findings(&mut |_, _, _| {}).is_err(), "there are three rows");
}

#[test]
fn goals_find_bits_and_promotion() {
    let mut study = product(&["hopper-fp8"], [4, 1024, 4]);
    study.goal = Some("worst<=1e-3".parse().expect("a goal"));
    let found = findings(&study);
    let document = found.plain_document();
    let [bits, promotion] = ["fewest_bits", "rarest_promotion"].map(|name| document[name].as_u64().expect("a number"));
    assert!((14..=24).contains(&bits) && (32..1024).contains(&promotion), "{bits} {promotion}");
    assert_eq!(found.verdict(), Verdict::Done);
    study.goal = Some("largest<=1".parse().expect("a goal"));
    assert!(study.findings(&mut |_, _, _| {}).is_err(), "no such measure");
}

#[test]
fn matrices_that_do_not_fit_are_refused() {
    let refused = |change: fn(&mut MatrixProduct)| {
        let mut study = product(&["hopper-fp8"], [2, 64, 2]);
        change(&mut study);
        assert!(study.findings(&mut |_, _, _| {}).is_err());
    };
    let codes = |shape: &[usize], code| MatrixInput {
        name: "codes".to_owned(),
        data: NumbersOrCodes::Codes(NumberArray { shape: shape.to_vec(), values: vec![code; shape.iter().product()] }),
    };
    assert!(codes(&[64], 0).shape().is_err());
    refused(|study| study.factors[1] = uniform([63, 2], 3));
    refused(|study| study.promotions = vec![Some(48)]);
    refused(|study| study.addend = Some(uniform([2, 3], 3)));
    refused(|study| study.elements = [MatrixUnit::find("volta-f16").ok().map(|unit| unit.operands[0]); 2]);
    refused(|study| study.units = vec![MatrixUnit::find("blackwell-nvf4").expect("a unit")]);
    let mut study = product(&["hopper-fp8", "blackwell-mxf8f6f4"], [2, 64, 2]);
    assert_eq!(StudyFiles::of(&study).rows("errors.csv").len(), 2);
    study.units.truncate(1);
    study.factors[0] = codes(&[2, 64], 0x38);
    assert_eq!(StudyFiles::of(&study).rows("errors.csv").len(), 1);
    study.factors[0] = codes(&[2, 64], 0x100);
    assert!(study.findings(&mut |_, _, _| {}).is_err(), "nine bits");
}

#[test]
fn arrays_of_halves_are_numbers_and_unsigned_ones_patterns() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a.npy");
    let load = |descr: &str, shape: &str, data: &[u8]| {
        let header = format!("{{'descr': '{descr}', 'fortran_order': False, 'shape': {shape}, }}\n");
        let length = (header.len() as u16).to_le_bytes();
        std::fs::write(&path, [b"\x93NUMPY\x01\x00", &length[..], header.as_bytes(), data].concat()).expect("written");
        MatrixInput::load(&path).map(|input| input.data)
    };
    let words: Vec<u8> = [0x3c00_u16, 0xc500, 0x0001, 0x7c00].iter().flat_map(|word| word.to_le_bytes()).collect();
    let values = vec![1.0, -5.0, power_of_two(-24), f64::INFINITY];
    let numbers = NumbersOrCodes::Numbers(NumberArray { shape: vec![2, 2], values });
    assert_eq!(load("<f2", "(2, 2)", &words).expect("halves"), numbers);
    let codes = NumbersOrCodes::Codes(NumberArray { shape: vec![1, 4], values: vec![0x3c00, 0xc500, 1, 0x7c00] });
    assert_eq!(load("<u2", "(1, 4)", &words).expect("patterns"), codes);
    for (descr, shape, data) in [("<i2", "(2, 2)", &words[..]), ("<f2", "(4,)", &words), ("<f2", "(0, 4)", &[])] {
        assert!(load(descr, shape, data).is_err(), "{descr} {shape}");
    }
}

//! Tests of held-back input.

use crossbar_studies::study::StudyError;

use super::*;

/// Case that computes `1 + c1`; its goal is the exact result.
fn sum(c1: f64) -> String {
    case("mov r0, c0\nadd r0, r0, c1", &format!("c0 = [1, 1, 1, 1]\nc1 = [{c1}, {c1}, {c1}, {c1}]"))
}

fn holding_back(searched: &str, other: &str) -> Result<Precision, StudyError> {
    let subject = subject(searched).holding_back(&setup(other), "other")?;
    Ok(study_of(Box::new(subject), "largest_absolute=0", &[FormatFamily::Float]))
}

/// 1 + 2^-2 needs two mantissa bits, 1 + 2^-4 needs four: with two it is rounded to 1 or to 1.25.
#[test]
fn mixed_formats_are_tried_on_input_that_was_held_back() {
    for (other, error) in [(0.25, 0.0), (0.0625, 0.0625)] {
        let document = document(&holding_back(&sum(0.25), &sum(other)).expect("the same program"));
        let family = &document["families"][0];
        assert_eq!((digits(&family["minimum"]), family["held_back"].as_f64()), (Some(2), Some(error)), "{other}");
    }
    let other = holding_back(&sum(0.25), &case("mov r0, c0\nsub r0, r0, c1", "c0 = [1, 1, 1, 1]\nc1 = [1, 1, 1, 1]"));
    let message = other.err().expect("another program").to_string();
    assert_eq!(message, "other: expected a case with the same pixel program, found another program");
    let other = holding_back(&sum(0.25).replace("rgba32f", "rgba8"), &sum(0.25));
    let message = other.err().expect("no codes").to_string();
    assert_eq!(message, "other: expected a case with the measure `largest_codes`, found none");
}

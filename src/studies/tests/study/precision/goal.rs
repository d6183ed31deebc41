//! Goals.

use crossbar_studies::study::precision::Goal;

fn goal(text: &str) -> Goal {
    text.parse().expect("a goal")
}

#[test]
fn goals_read_back() {
    for text in ["leaks=0", "ssim>=0.99", "mean_relative<0.01", "largest_codes<=1", "x>-2.5"] {
        assert_eq!(goal(text).to_string(), text);
    }
    assert_eq!(goal(" flip <= 1e-3 "), goal("flip<=0.001"));
}

#[test]
fn other_text_is_refused() {
    for text in ["", "ssim", "<=1", "ssim<=", "ssim<=x", "ssim==1", "ssim<=inf", "ssim<=NaN", "=<1", "ssim<=>1"] {
        let error = text.parse::<Goal>().expect_err(text);
        assert!(error.to_string().ends_with(&format!("found `{text}`")), "{error}");
    }
}

#[test]
fn a_value_meets_its_bound_and_nan_meets_none() {
    let met = |text: &str| [0.5, 1.0, 2.0, f64::NAN].map(|value| goal(text).met(value));
    assert_eq!(met("a<=1"), [true, true, false, false]);
    assert_eq!(met("a<1"), [true, false, false, false]);
    assert_eq!(met("a>=1"), [false, true, true, false]);
    assert_eq!(met("a>1"), [false, false, true, false]);
    assert_eq!(met("a=1"), [false, true, false, false]);
}

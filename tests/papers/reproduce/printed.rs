//! Rows that compare printed figures with each other, and printed figures that the emulator and the systems use.

use crossbar::all_frequency::on_card::time::TABLE_1;
use crossbar::study::reproduce::{PaperRow, RowVerdict, printed};
use refsim::timing::host::CPU_ONLY_RAYS_PER_SECOND;

use super::{findings, row};

/// Printed values that follow from printed values are consistent; values that determined a constant are calibrated;
/// values that contradict each other are marked as contradictory, with the computation.
#[test]
fn print_is_set_against_print() {
    use RowVerdict::{Calibrated, Consistent, Contradictory};
    for (id, expected) in [
        ("cpca/computation-saved", Consistent),
        ("all-frequency/multiplications", Consistent),
        ("bi-scale/bytes-left-temple", Consistent),
        ("bi-scale/dense-armor", Calibrated),
        ("bi-scale/biclusters-temple", Calibrated),
        ("bi-scale/textures-chair", Calibrated),
        ("bi-scale/textures-armor", Contradictory),
        ("bi-scale/left-least", Contradictory),
        ("bi-scale/left-largest", Contradictory),
    ] {
        assert_eq!(row(id).verdict(), expected, "{id}");
    }
    let armor = row("bi-scale/textures-armor").contradiction();
    assert!(armor.expect("a computation").text().starts_with("254.80 MB: "));
}

/// Three rows are within their bounds only because of the printed value's rounding: "about 8 of 24" segments, and two
/// frame rates, which calibrated a constant.
#[test]
fn about_8_segments_need_the_rounding() {
    let rounded = findings("all-frequency-counts").rows.iter().filter(|row| row.holds_by_rounding());
    let rounded: Vec<&str> = rounded.map(|row: &PaperRow| row.target.id.as_str()).collect();
    let [bunny, teapot] = ["all-frequency/fps-alone-bunny", "all-frequency/fps-alone-teapot"];
    assert_eq!(rounded, ["all-frequency/below-mean", bunny, teapot]);
}

/// The emulator and the systems cannot use studies, so they store rates of hosts themselves; these equal the rates in
/// the data.
#[test]
fn hosts_have_the_rates_of_the_data() {
    let value = |id: &str| printed(id).expect("a figure").value;
    assert_eq!(value("ray-engine/host-alone"), CPU_ONLY_RAYS_PER_SECOND as f64);
    let columns = [
        ("bunny", "bunny"),
        ("teapot", "teapot"),
        ("tweety", "tweety-diffuse"),
        ("tweety", "tweety-glossy"),
        ("buddha", "buddha-diffuse"),
        ("buddha", "buddha-glossy"),
    ];
    for (ours, (model, column)) in TABLE_1.iter().zip(columns) {
        let tenfold = |what: &str, of: &str| (10.0 * value(&format!("all-frequency/{what}-{of}"))).round() as u64;
        assert_eq!(ours.vertex_hundreds, tenfold("vertices", model), "{column}");
        assert_eq!(ours.omega_thousandths, tenfold("omega", model), "{column}");
        assert_eq!(10 * ours.clusters, tenfold("clusters", column), "{column}");
        assert_eq!(ours.frames_in_ten_seconds, ["fps", "fps-alone"].map(|what| tenfold(what, column)), "{column}");
    }
}

//! Rows of the entries that draw nothing.

use std::collections::BTreeSet;

use refsim::timing::host::CPU_ONLY_RAYS_PER_SECOND;

use super::{ENTRIES, ModelSize, PaperRow, RowVerdict, printed, reproduce};
use crate::all_frequency::on_card::time::TABLE_1;

fn rows(ids: &[&str]) -> Vec<PaperRow> {
    let entries: Vec<_> = ENTRIES.iter().filter(|entry| ids.contains(&entry.id)).copied().collect();
    let found = reproduce(&entries, ModelSize::Reduced, &mut |_, _, _| ()).expect("the entries run");
    found.into_iter().flat_map(|(_, found)| found.rows).collect()
}

fn verdict(rows: &[PaperRow], id: &str) -> RowVerdict {
    rows.iter().find(|row| row.target.id == id).expect("a row").verdict()
}

/// Print set against print is consistent; what it chose is calibrated; where it disagrees with itself, it is
/// contradictory, with the computation.
#[test]
fn print_is_set_against_print() {
    let rows = rows(&["cpca-section-6", "all-frequency-counts", "bi-scale-counts"]);
    let names: BTreeSet<&str> = rows.iter().map(|row| row.target.id.as_str()).collect();
    assert_eq!(names.len(), rows.len(), "a figure stands in two rows");
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
        assert_eq!(verdict(&rows, id), expected, "{id}");
    }
    let armor = rows.iter().find(|row| row.target.id == "bi-scale/textures-armor").and_then(PaperRow::contradiction);
    assert!(armor.expect("a computation").text().starts_with("254.80 MB: "));
}

/// "About 8 of 24" segments are below the horizon only by the rounding of the print.
#[test]
fn about_8_segments_need_the_rounding() {
    let rows = rows(&["all-frequency-counts"]);
    let rounded: Vec<&str> =
        rows.iter().filter(|row| row.holds_by_rounding()).map(|row| row.target.id.as_str()).collect();
    assert_eq!(rounded, ["all-frequency/below-mean", "all-frequency/fps-alone-tweety-glossy"]);
}

/// The emulator and the systems know no study, and have the rates of hosts themselves: they are those of the data.
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

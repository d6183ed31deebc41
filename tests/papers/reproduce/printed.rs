//! Printed figures that the emulator and the systems use.

use crossbar::all_frequency::on_card::time::TABLE_1;
use crossbar::study::reproduce::printed;
use refsim::timing::host::CPU_ONLY_RAYS_PER_SECOND;

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

//! Speed of real cards, and of formats with different rules, relative to the ideal device with the same format.
//!
//! On a shared machine, the fastest of many short runs is more reliable than a median of long ones. So the devices draw
//! alternately, on one thread, many times; the fastest draw of each counts. Goal: at most 1.5 times the time of the
//! ideal device with the same format.

use std::fmt::Write as _;
use std::hint::black_box;
use std::time::Instant;

use crossbar::geom::Sides;
use crossbar::ray_engine::Crossbar;
use refsim::device::Profile;
use refsim::machine::ExecutorKind;

/// Cards that run the engine, each with the ideal format from which its own format differs.
const CARDS: [(&str, &str); 6] =
    [("r200", "s3.12"), ("r300", "fp24"), ("r350", "fp24"), ("nv30", "fp32"), ("nv35", "fp32"), ("gt200", "fp32")];
/// Formats, each with different rules to measure.
const RULES: [(&str, &[&str]); 4] = [
    ("s3.12", &["rna", "rtz", "rdn", "wrap"]),
    ("fp32", &["rna", "rtz", "rdn", "ftz", "sat", "nvovf", "nv"]),
    ("fp16", &["rna", "rtz", "rdn", "ftz", "sat", "nvovf", "nv"]),
    ("fp24", &["rna", "rtz", "rdn", "ftz", "sat", "nvovf", "nv"]),
];
/// Rays per side of the picture: 4,096 in all, 16 tiles.
const SIDE: u32 = 64;
/// Number of draws per device.
const ROUNDS: usize = 25;
/// Maximum time of a card or a rule, relative to the ideal device.
const MOST: f64 = 1.5;

/// The cards and formats, each with the format of its ideal device; then these ideal devices.
fn all() -> Vec<(String, &'static str)> {
    let ideal = |format: &str| format!("ideal-{format}");
    let of_rules = RULES.iter().flat_map(|&(format, rules)| {
        let with_rules = rules.iter().map(move |rule| (format!("{}:{rule}", ideal(format)), format));
        std::iter::once((ideal(format), format)).chain(with_rules)
    });
    CARDS.map(|(card, format)| (card.to_owned(), format)).into_iter().chain(of_rules).collect()
}

/// Measures, and returns the table.
pub(crate) fn table() -> String {
    let (mesh, rays) = (crate::mesh(), crate::rays(SIDE));
    let devices = all();
    let cards: Vec<Crossbar> = devices
        .iter()
        .map(|(device, _)| Profile::named(device).expect("a device"))
        .map(|profile| Crossbar::new(profile, ExecutorKind::Batch).all_pairs(true))
        .collect();
    let mut residents: Vec<_> =
        cards.iter().map(|card| card.make_resident(&mesh, &rays, Sides::Front).expect("the card takes them")).collect();
    let mut shaded = vec![0; residents.len()];
    let mut quickest = vec![f64::INFINITY; residents.len()];
    for _ in 0..ROUNDS {
        for ((resident, shaded), quickest) in residents.iter_mut().zip(&mut shaded).zip(&mut quickest) {
            let start = Instant::now();
            let drawn = black_box(resident.intersect().expect("the card intersects"));
            *quickest = quickest.min(start.elapsed().as_secs_f64());
            *shaded = drawn.events.fragments.shaded;
        }
    }
    let rate = |index: usize| shaded[index] as f64 / quickest[index] / 1e6;
    let mut out = String::from(
        "\n| one thread, 4096 rays x 256 triangles, resident | batch | ideal format | its time / that of the format | to beat |\n\
         |---|---|---|---|---|\n",
    );
    for (index, (device, format)) in devices.iter().enumerate() {
        let ideal = devices.iter().position(|(other, _)| *other == format!("ideal-{format}")).expect("it is listed");
        let ratio = rate(ideal) / rate(index);
        let _: Result<(), std::fmt::Error> =
            writeln!(out, "| {device} | {:.1} | {format} | {ratio:.2} | {MOST} |", rate(index));
    }
    out
}

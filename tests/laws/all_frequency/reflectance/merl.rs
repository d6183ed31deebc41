//! MERL's files: cells by angles, and bytes of any kind.

use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::sync::LazyLock;

use crossbar::all_frequency::factor::{
    FactorSampling, Factorization, MERL_CELLS, MerlBrdf, MerlChannel, Supersamples, parse_merl,
};
use crossbar::elementary::sin_cos;
use glam::{DMat3, DVec3};
use proptest::prelude::*;

const CELLS: usize = MERL_CELLS[0] * MERL_CELLS[1] * MERL_CELLS[2];

fn header(sizes: [i32; 3]) -> Vec<u8> {
    sizes.iter().flat_map(|size| size.to_le_bytes()).collect()
}

/// A file whose numbers are a function of channel and cell.
fn file(value: impl Fn(usize, usize) -> f64) -> Vec<u8> {
    let numbers = (0..3).flat_map(|channel| (0..CELLS).map(move |cell| (channel, cell)));
    header([90, 90, 180]).into_iter().chain(numbers.flat_map(|(c, at)| value(c, at).to_le_bytes())).collect()
}

/// Each cell holds its number, each channel another multiple of it.
static NUMBERED: LazyLock<MerlBrdf> = LazyLock::new(|| {
    let bytes = file(|channel, cell| (channel + 1) as f64 * 1500.0 * cell as f64);
    parse_merl(&bytes, "numbered".as_ref()).expect("a measurement")
});

/// View and light of a half vector at an angle from the normal and an azimuth, of a light at an angle from it and
/// around it.
fn directions([half, turn]: [f64; 2], [difference, around]: [f64; 2]) -> [DVec3; 2] {
    let about = |axis: usize, angle: f64| {
        let (s, c) = sin_cos(angle);
        match axis {
            1 => DMat3::from_cols(DVec3::new(c, 0.0, -s), DVec3::Y, DVec3::new(s, 0.0, c)),
            _ => DMat3::from_cols(DVec3::new(c, s, 0.0), DVec3::new(-s, c, 0.0), DVec3::Z),
        }
    };
    let to_world = about(2, turn) * about(1, half);
    let ((sine, cosine), (y, x)) = (sin_cos(difference), sin_cos(around));
    let light = DVec3::new(sine * x, sine * y, cosine);
    [DVec3::new(-light.x, -light.y, light.z), light].map(|direction| to_world * direction)
}

proptest! {
    /// The middle of a cell, seen from above the horizon, reads the cell, whatever the azimuth of the half vector; view
    /// and light exchanged read the same.
    #[test]
    fn the_middle_of_a_cell_reads_the_cell(
        half in 0..MERL_CELLS[0], difference in 0..MERL_CELLS[1], azimuth in 0..MERL_CELLS[2], turn in 0.0..TAU,
    ) {
        let share = (half as f64 + 0.5) / 90.0;
        let angles = [(difference as f64 + 0.5) / 90.0 * FRAC_PI_2, (azimuth as f64 + 0.5) / 180.0 * PI];
        let [view, light] = directions([share * share * FRAC_PI_2, turn], angles);
        if view.z > 0.0 && light.z > 0.0 {
            let expected = ((half * MERL_CELLS[1] + difference) * MERL_CELLS[2] + azimuth) as f64;
            let read = |channel, view, light| NUMBERED.value(channel, view, light);
            prop_assert!((read(MerlChannel::Red, view, light) - expected).abs() < 1e-6);
            prop_assert!((read(MerlChannel::Red, light, view) - expected).abs() < 1e-6, "exchanged");
            prop_assert!((read(MerlChannel::Green, view, light) - 2.0 * 1.15 * expected).abs() < 1e-6 * (1.0 + expected));
            prop_assert!((read(MerlChannel::Blue, view, light) - 3.0 * 1.66 * expected).abs() < 1e-6 * (1.0 + expected));
        }
    }

    #[test]
    fn any_bytes_are_refused_without_a_panic(bytes in prop::collection::vec(any::<u8>(), 0..200), whole in any::<bool>()) {
        let bytes = if whole { [header([90, 90, 180]), bytes].concat() } else { bytes };
        let error = parse_merl(&bytes, "any.binary".as_ref()).expect_err("no measurement").to_string();
        prop_assert!(error.starts_with("any.binary: expected "), "{error}");
    }

    #[test]
    fn other_sizes_are_named(sizes in any::<[i32; 3]>()) {
        prop_assume!(sizes != [90, 90, 180]);
        let error = parse_merl(&header(sizes), "other.binary".as_ref()).expect_err("other sizes");
        let [a, b, c] = sizes;
        let named = format!("other.binary: expected 90 x 90 x 180 cells, found {a} x {b} x {c}");
        prop_assert_eq!(error.to_string(), named);
    }
}

/// A white measurement is a diffuse surface; cells that were not measured count as 0; others must be numbers.
#[test]
fn measurements_are_factored_and_faults_are_named() {
    let mut bytes = file(|_, _| 1500.0 / PI);
    let white = parse_merl(&bytes, "white".as_ref()).expect("a measurement");
    assert_eq!(white.invalid, 0);
    let sampling = FactorSampling { side: 8, supersamples: Supersamples::NONE, ..FactorSampling::default() };
    let table = sampling.table(&white.channel(MerlChannel::Red), &mut |_, _| ()).expect("a table");
    let found = Factorization::up_to(&table, 10).expect("a term");
    assert_eq!(found.rank(), 1);
    let [view, light] = [table.view().direction(3, 2), table.light().direction(5, 5)];
    assert!((found.factors(1).product(view, light) - light.z / PI).abs() < 1e-12);

    bytes[12..20].copy_from_slice(&(-1.0_f64).to_le_bytes());
    let holed = parse_merl(&bytes, "holed".as_ref()).expect("a measurement");
    assert_eq!((holed.invalid, holed.value(MerlChannel::Red, DVec3::Z, DVec3::Z)), (1, 0.0));
    assert!(holed.value(MerlChannel::Green, DVec3::Z, DVec3::Z) > 0.3);

    let error = |bytes: &[u8]| parse_merl(bytes, "m.binary".as_ref()).expect_err("no measurement").to_string();
    let (length, short) = (bytes.len(), &bytes[..bytes.len() - 1]);
    assert_eq!(error(short), format!("m.binary: expected {length} bytes of a MERL measurement, found {}", length - 1));
    assert!(error(&[&bytes[..], &[0]].concat()).ends_with(&format!("found {}", length + 1)));
    let at = 12 + 8 * (CELLS + 5);
    bytes[at..at + 8].copy_from_slice(&f64::NAN.to_le_bytes());
    assert!(error(&bytes).contains("found NaN in cell 5 of channel 1"), "{}", error(&bytes));
}

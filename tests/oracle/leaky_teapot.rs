//! The leaky teapot: assertions about the paper's Figure 4; identical bits on every executor and thread count.

use crate::environment::by_form;
use crossbar::geom::exact::Sides;
use crossbar::study::configuration::Configuration;
use crossbar::study::leaky_teapot::TeapotOutcome;
use refsim::machine::ExecutorKind;

use super::teapot_study::{assert_same, formats, parameters, small_study, study};

#[test]
fn s3_12_leaks_fp32_does_not_and_the_formats_between_are_ordered() {
    // Small by default, the program's defaults with `CROSSBAR_FULL=1`.
    let (size, rate) = by_form((128, 6), (512, 8));
    let mut configurations = vec![Configuration::device("r200").expect("a card")];
    configurations.extend(formats(&["fp16", "fp24", "fp32"]));
    let outcome = study(&parameters(size, rate, configurations));
    let leaks: Vec<u64> = outcome.rows.iter().map(|r| r.tally.leaks).collect();
    let surface = outcome.rows[0].tally.surface;
    let wrong: Vec<u64> =
        outcome.rows.iter().map(|r| r.tally.leaks + r.tally.false_hits + r.tally.wrong_triangle).collect();
    assert!(leaks[0] * 200 > surface, "a Radeon 8500 leaks visibly: {} of {surface} pixels", leaks[0]);
    assert_eq!(leaks[3], 0, "fp32 does not leak from the default camera");
    assert!(wrong[1] > wrong[2] && wrong[2] >= wrong[3], "fp16, fp24, fp32 are ordered: {wrong:?}");
    assert!(leaks[1] > leaks[2] && leaks[2] >= leaks[3], "and so are their leaks: {leaks:?}");
    let errors: Vec<f64> = outcome.rows.iter().map(|r| r.tally.largest_t_error).collect();
    assert!(errors[0] > errors[3] && errors[1] > errors[2] && errors[2] > errors[3], "t too: {errors:?}");
}

#[test]
fn scalar_and_batch_give_the_same_study() {
    let (mut small, batch) = small_study();
    small.executor = ExecutorKind::Scalar.into();
    assert_same(&batch, &study(&small), "scalar");
}

#[test]
fn cards_of_2003_trace_the_teapot_as_their_formats_do() {
    let mut configurations: Vec<_> =
        ["r300", "r350", "nv30", "nv35"].map(|c| Configuration::device(c).expect("a card")).to_vec();
    configurations.push(Configuration::device_in_format("nv35", "fp16").expect("a card"));
    let mut parameters = parameters(96, 6, configurations);
    parameters.options.rays_per_edge = 0;
    for sides in [Sides::Front, Sides::Both] {
        parameters.options.sides = sides;
        let outcome = study(&parameters);
        let wrong: Vec<u64> =
            outcome.rows.iter().map(|r| r.tally.leaks + r.tally.false_hits + r.tally.wrong_triangle).collect();
        assert_eq!(wrong[2..4], [0, 0], "{sides:?}: fp32 on NV30 and NV35 is right everywhere: {wrong:?}");
        assert!(wrong[0] <= 8 && wrong[0] == wrong[1], "{sides:?}: fp24 on R300 and R350 nearly so: {wrong:?}");
        assert!(wrong[4] > 50 && wrong[4] * 10 < outcome.rows[4].tally.surface, "{sides:?}: fp16 is not: {wrong:?}");
    }
}

/// Both faces cost the Radeon nothing if rays have one origin: the vertex program reverses the triangles.
#[test]
fn a_radeon_8500_sees_both_faces() {
    let mut card = Configuration::device("r200").expect("a card");
    card.profile.set_switch("rounding", "rne").expect("a switch of r200");
    let mut parameters = parameters(96, 6, vec![card]);
    parameters.options.rays_per_edge = 0;
    let front = study(&parameters).rows[0].tally;
    parameters.options.sides = Sides::Both;
    let both = study(&parameters).rows[0].tally;
    assert!(both.surface >= front.surface && both.leaks * 50 < both.surface, "both faces: {both:?}");
    assert!(both.wrong_triangle * 10 < both.surface, "mostly the right triangles: {both:?}");
}

#[test]
fn buckets_lose_nothing_that_the_whole_crossbar_finds() {
    let mut configurations = Configuration::device_under_each_switch("r200").expect("a card");
    configurations.retain(|c| !c.label.contains("bits") && !c.label.contains("iterator"));
    configurations.extend(formats(&["fp16", "fp32"]));
    let mut parameters = parameters(64, 3, configurations);
    parameters.options.rays_per_edge = 0;
    let buckets = digest(&study(&parameters));
    parameters.options.all_pairs = true;
    assert_eq!(buckets, digest(&study(&parameters)), "the same triangles and the same t, to the bit");
}

/// FNV-1a hash of a run's results at every pixel.
fn digest(outcome: &TeapotOutcome) -> u64 {
    let mut h = 0xcbf2_9ce4_8422_2325_u64;
    for row in &outcome.rows {
        for (t, triangle) in row.t.iter().zip(&row.triangle) {
            for word in [t.to_bits(), *triangle] {
                h = (h ^ u64::from(word)).wrapping_mul(0x0000_0100_0000_01b3);
            }
        }
    }
    h
}

/// Golden bits: equal in debug and release builds and on every CPU. If a change of the arithmetic is intended, give the
/// reason in the commit, and replace the number with the one that the failing test prints.
#[test]
fn golden_bits_whatever_the_number_of_threads() {
    let mut configurations = Configuration::device_under_each_switch("r200").expect("a card");
    configurations.extend(formats(&["fp16", "fp24", "fp32"]));
    let parameters = parameters(48, 2, configurations);
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        digest(&pool.install(|| study(&parameters)))
    };
    let one = on(1);
    assert_eq!([on(2), on(3)], [one; 2], "the number of threads changes no bit");
    assert_eq!(format!("{one:#018x}"), GOLDEN, "stored bits");
}

const GOLDEN: &str = "0x2826fc63067a49e3";

//! A leaky teapot that is small enough for every executor, for tests of identical bits here and on a GPU (tests/gpu).

use crossbar::geom::exact::Sides;
use crossbar::geom::teapot::teapot;
use crossbar::ray_engine::RayBatch;
use crossbar::scene::Camera;
use crossbar::study::configuration::Configuration;
use crossbar::study::leaky_teapot::{LeakyTeapotOptions, Parameters, TeapotOutcome, run};
use refsim::machine::ExecutorKind;

pub(crate) fn parameters(size: u32, rate: u32, configurations: Vec<Configuration>) -> Parameters {
    let camera = Camera::teapot(size, size).expect("a camera");
    Parameters {
        mesh: teapot(rate).expect("a teapot"),
        view: RayBatch::new(size, size, camera.rays()).expect("a square of rays"),
        configurations,
        model: None,
        listed: None,
        shared: Vec::new(),
        executor: ExecutorKind::Batch.into(),
        options: LeakyTeapotOptions { rays_per_edge: 2, sides: Sides::Front, all_pairs: false },
    }
}

pub(crate) fn study(parameters: &Parameters) -> TeapotOutcome {
    run(parameters, &mut |_, _, _| ()).expect("the study runs")
}

pub(crate) fn formats(names: &[&str]) -> Vec<Configuration> {
    names.iter().map(|n| Configuration::format(n).expect("a format")).collect()
}

/// The study by the batch executor, small enough for every executor.
pub(crate) fn small_study() -> (Parameters, TeapotOutcome) {
    let mut configurations = vec![Configuration::device("r200").expect("a card")];
    for card in ["r300", "nv35"] {
        configurations.push(Configuration::device(card).expect("a card"));
    }
    configurations.push(Configuration::device_in_format("nv35", "fp16").expect("a card"));
    configurations.extend(formats(&["fp16", "fp24", "fp32", "s5.10", "e6m9:rtz"]));
    let small = parameters(24, 2, configurations);
    let batch = study(&small);
    (small, batch)
}

pub(crate) fn assert_same(batch: &TeapotOutcome, other: &TeapotOutcome, who: &str) {
    for (b, o) in batch.rows.iter().zip(&other.rows) {
        let bits = |t: &[f32]| t.iter().map(|t| t.to_bits()).collect::<Vec<_>>();
        assert_eq!(b.triangle, o.triangle, "{who}, {}: triangles", b.configuration.label);
        assert_eq!(bits(&b.t), bits(&o.t), "{who}, {}: t", b.configuration.label);
        assert_eq!((b.edges, b.vertices), (o.edges, o.vertices), "{who}, {}: aimed rays", b.configuration.label);
    }
}

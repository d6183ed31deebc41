//! Form factors that a card draws.

use super::tracer;
use crossbar::radiosity::form_factor::{Hemicube, VisibilityParameters, point_to_polygon};
use crossbar::radiosity::rooms::{self, CornellBox};
use crossbar::radiosity::{FormFactors, Patches, Subdivision};
use refsim::device::Profile;
use refsim::machine::ExecutorKind;
use std::sync::Arc;

fn drawn(patches: &Patches, resolution: u32, kind: ExecutorKind) -> FormFactors {
    FormFactors::hemicube(patches, &Hemicube::new(resolution), &kind.into(), &mut |_, _| ()).expect("factors")
}

fn cut_cornell(blocks: bool, patches: usize) -> Patches {
    Patches::new(&rooms::cornell(CornellBox { blocks, open: false }), Subdivision::AtMost(patches)).expect("patches")
}

#[test]
fn rows_of_a_closed_room_are_the_whole_hemicube() {
    let furnace = Patches::new(&rooms::furnace(0.5), Subdivision::PerSide(3)).expect("patches");
    // A pixel is off by 36 roundings of 1/4, and each sum of at most 1 by a rounding: 3 resolution^2 pixels.
    let tolerance = |resolution: f64| 3.0 * resolution * resolution * 10.0 * f64::EPSILON / 2.0;
    for (patches, resolution) in [(furnace, 16), (cut_cornell(false, 120), 32), (cut_cornell(true, 150), 32)] {
        let factors = drawn(&patches, resolution, ExecutorKind::Batch);
        for (patch, sum) in factors.row_sums().into_iter().enumerate() {
            let off = (sum - 1.0).abs();
            assert!(sum == 0.0 || off <= tolerance(f64::from(resolution)), "patch {patch}: {sum}");
        }
        assert!(factors.summary().blind * 20 < patches.list().len(), "hardly any patch is under a block");
    }
}

#[test]
fn finer_hemicubes_come_nearer_to_what_the_centre_sees() {
    let patches = Patches::new(&rooms::furnace(0.5), Subdivision::PerSide(2)).expect("patches");
    let list = patches.list();
    let off = |resolution: u32| {
        let factors = drawn(&patches, resolution, ExecutorKind::Batch);
        let mut most = 0.0_f64;
        for (patch, row) in list.iter().zip(factors.matrix().rows()) {
            for (other, found) in list.iter().zip(row) {
                let exact = point_to_polygon(patch.center(), patch.normal(), other.corners());
                let exact = if other.face == patch.face { 0.0 } else { exact };
                most = most.max((found - exact).abs());
            }
        }
        most
    };
    let errors = [8, 32, 128].map(off);
    // Pixels on the outline of a patch decide: their number grows with the resolution, their worth falls with its
    // square.
    assert!(errors[1] < 0.5 * errors[0] && errors[2] < 0.5 * errors[1], "{errors:?}");
    assert!(errors[2] < 2e-3, "{errors:?}");
}

#[test]
fn hemicubes_agree_with_rays_in_a_room_with_blocks() {
    let scene = rooms::cornell(CornellBox { blocks: true, open: false });
    let patches = Patches::new(&scene, Subdivision::AtMost(200)).expect("patches");
    let found = drawn(&patches, 64, ExecutorKind::Batch);
    let rays =
        FormFactors::with_visibility(&patches, &mut tracer(&scene), VisibilityParameters::default(), &mut |_, _| ())
            .expect("factors");
    // One eye for a whole patch is coarse where patches touch; on the average over a row it is not.
    let (mut off, mut all) = (0.0, 0.0);
    for (a, b) in found.matrix().rows().zip(rays.matrix().rows()) {
        off += a.iter().zip(b).map(|(x, y)| (x - y).abs()).sum::<f64>();
        all += b.iter().sum::<f64>();
    }
    assert!(off < 0.15 * all, "off by {} of all", off / all);
}

#[test]
fn scalar_and_batch_draw_the_same_factors_and_enforcement_makes_them_reciprocal() {
    let patches = cut_cornell(true, 60);
    let mut batch = drawn(&patches, 8, ExecutorKind::Batch);
    assert!(drawn(&patches, 8, ExecutorKind::Scalar) == batch);
    assert!(batch.reciprocity_error() > 0.01);
    batch.enforce_reciprocity();
    assert!(batch.reciprocity_error() < 1e-15);
}

#[test]
fn what_a_card_cannot_draw_is_refused() {
    let patches = Patches::new(&rooms::furnace(0.5), Subdivision::PerSide(1)).expect("patches");
    let refused = |hemicube: Hemicube| {
        FormFactors::hemicube(&patches, &hemicube, &ExecutorKind::Batch.into(), &mut |_, _| ()).expect_err("refused")
    };
    for resolution in [0, 7, 2050, u32::MAX - 1] {
        let error = refused(Hemicube::new(resolution));
        let text = error.to_string();
        assert!(text.contains(" from 2 to 2048 ") && text.ends_with(" allows 4096 pixels a side"), "{text}");
    }
    insta::assert_snapshot!("hemicube_resolution", refused(Hemicube::new(0)));
    let r300 = Hemicube { resolution: 8, device: Arc::new(Profile::named("r300").expect("a device")) };
    insta::assert_snapshot!("hemicube_without_fragment_programs", refused(r300));
}

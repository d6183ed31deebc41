//! The Ray Engine: the sign of equation 8, and the size of the kernels on the cards.

use approx::abs_diff_eq;
use crossbar::geom::exact::Sides;
use crossbar::geom::random::CounterRng;
use crossbar::geom::teapot::teapot;
use crossbar::ray_engine::paper::intersect;
use crossbar::ray_engine::{Answer, Crossbar, Form, Kernel, RayBatch, intersect_in_vertices, kernels};
use crossbar::scene::Camera;
use glam::DVec3;
use refsim::asm::assemble;
use refsim::check::check;
use refsim::device::Profile;
use refsim::isa::{OpcodeClass, Program, RegisterFile};
use refsim::machine::{ExecutorKind, Machine};

/// Random triangles, and rays through their interiors.
fn interior_hits(count: u64) -> impl Iterator<Item = (DVec3, DVec3, [DVec3; 3])> {
    let random = CounterRng::new(8);
    (0..count).map(move |i| {
        let point = |sample| DVec3::from([0, 1, 2].map(|axis| 4.0 * random.unit(i, sample, axis) - 2.0));
        let (a, b, c, o) = (point(0), point(1), point(2), point(3));
        let [x, y] = [0, 1].map(|k| 0.05 + 0.425 * random.unit(i, 4, k));
        let inside = a + x * (b - a) + y * (c - a);
        (o, inside - o, [a, b, c])
    })
}

#[test]
fn equation_8_as_printed_has_the_wrong_sign() {
    let mut front = 0;
    for (o, d, [a, b, c]) in interior_hits(20_000) {
        let found = intersect(o, d, [a, b, c]);
        let printed_w = (c - b).dot((o - b).cross(d));
        assert_eq!(printed_w, -found.w, "ours is the printed one with its sign changed");
        let all_as_printed = found.u >= 0.0 && found.v >= 0.0 && printed_w >= 0.0;
        assert!(!all_as_printed, "as printed, no interior ray passes");
        assert!(found.hits_either(), "with the other sign every one does: {found:?}");
        assert_eq!(found.hits_front(), found.n_dot_d < 0.0, "and the front-facing ones from the front");
        front += u32::from(found.n_dot_d < 0.0);
        assert!(abs_diff_eq!(found.t, 1.0, epsilon = 1e-9), "equation 3: the target is at t = 1, found {}", found.t);
    }
    assert!((8_000..12_000).contains(&front), "about half of them face the origin, found {front}");
}

/// For integers of this size f64 is exact, so the identities hold exactly or not at all.
#[test]
fn the_three_areas_add_up_so_the_second_cross_product_can_go() {
    let random = CounterRng::new(9);
    for i in 0..20_000 {
        let point =
            |sample| DVec3::from([0, 1, 2].map(|axis| (2000.0 * random.unit(i, sample, axis)).floor() - 1000.0));
        let (a, b, c, o, d) = (point(0), point(1), point(2), point(3), point(4));
        let found = intersect(o, d, [a, b, c]);
        assert_eq!(found.u + found.v + found.w, -found.n_dot_d, "u + v + w = -n.d");
        let aod = (o - a).cross(d);
        assert_eq!(-(c - b).dot(aod) - found.n_dot_d, found.w, "w = -bc.aod - n.d");
    }
}

/// Slots of each phase of a ps_1_4 program: (texture, arithmetic).
fn slots(program: &Program) -> [(u32, u32); 2] {
    let marker = program.phase_marker().expect("two phases");
    let mut slots = [(0, 0); 2];
    for (i, instruction) in program.instructions.iter().enumerate() {
        let (texture, arithmetic) = &mut slots[usize::from(i > marker)];
        match instruction.opcode.info().class {
            OpcodeClass::Texture => *texture += 1,
            OpcodeClass::Arithmetic if !instruction.coissue => *arithmetic += 1,
            _ => {}
        }
    }
    slots
}

#[test]
fn the_radeon_8500_kernels_take_the_slots_that_the_book_says() {
    let expected = [
        (kernels::ONE_ORIGIN_UNSIGNED, [(5, 6), (6, 5)]),
        (kernels::ONE_ORIGIN_SHARED_UNSIGNED, [(6, 6), (3, 3)]),
        (kernels::ANY_ORIGIN_UNSIGNED, [(5, 8), (6, 5)]),
        (kernels::ANY_ORIGIN_BOTH_UNSIGNED, [(5, 8), (5, 8)]),
        (kernels::ANY_ORIGIN_BYTES, [(4, 6), (6, 5)]),
    ];
    for (kernel, wanted) in expected {
        let program = assemble(kernel.text).expect("a kernel assembles");
        assert_eq!(slots(&program), wanted, "{}", kernel.name);
        let highest = |file| {
            let sources = program.instructions.iter().flat_map(|i| &i.sources).map(|s| s.register);
            let destinations = program.instructions.iter().filter_map(|i| i.destination).map(|d| d.register);
            sources.chain(destinations).filter(|r| r.file == file).map(|r| r.index).max()
        };
        assert_eq!(highest(RegisterFile::Temp), Some(5), "{}: six temporaries", kernel.name);
        assert_eq!(highest(RegisterFile::Texture), Some(5), "{}: six coordinate sets", kernel.name);
        assert_eq!(highest(RegisterFile::Constant), Some(0), "{}: one constant", kernel.name);
    }
}

#[test]
fn every_kernel_is_accepted_by_the_cards_that_run_it() {
    let profile = |name| Profile::named(name).expect("a profile");
    for kernel in kernels::ALL {
        let devices: &[&str] = match kernel.name {
            name if name.ends_with(".vsa") => &["r200", "nv20", "nv25", "r300", "r350", "nv35"],
            "id.psa" => &["r200", "nv20", "nv25", "r300", "nv35"],
            name if name.starts_with("float") => &["r300", "r350", "nv30", "nv35"],
            _ => &["r200"],
        };
        for device in devices {
            let mut device = profile(device);
            if kernel.name.contains("_signed") && device.name == "r200" {
                device.set_switch("ray-textures", "signed").expect("an open question of r200");
            }
            let program = assemble(kernel.text).expect("a kernel assembles");
            assert!(check(program, &device).is_ok(), "{} on {}", kernel.name, device.name);
        }
    }
}

#[test]
fn cards_get_the_form_that_they_can_run() {
    let form = |name: &str, one_origin| {
        let profile = Profile::named(name).expect("a profile");
        Kernel::choose(&profile, one_origin, Sides::Front).map(|k| k.form)
    };
    assert_eq!(form("r200", true).ok(), Some(Form::OneOrigin), "ao from the vertex program");
    assert_eq!(form("r200", false).ok(), Some(Form::AnyOrigin), "one pass");
    assert_eq!(form("r300", true).ok(), Some(Form::Float), "all eight equations");
    assert_eq!(form("ideal-s3.12", true).ok(), Some(Form::OneOrigin), "fixed point as the cards had it");
    assert!(form("nv20", true).is_err(), "a GeForce3 has neither");
}

#[test]
fn the_vertex_units_find_what_the_pixel_pipelines_find() {
    let mesh = teapot(1).expect("the teapot tessellates");
    let camera = Camera::teapot(16, 16).expect("a camera of any size");
    let rays = RayBatch::new(16, 16, camera.rays()).expect("a ray a pixel");
    let profile = |name| Profile::named(name).expect("a profile");
    let mut machine = Machine::new(profile("nv20"), ExecutorKind::Batch);
    let vertex = intersect_in_vertices(&mut machine, &mesh, &rays).expect("it runs");
    let pixel = Crossbar::new(profile("ideal-fp32"), ExecutorKind::Batch)
        .intersect(&mesh, &rays, Sides::Front)
        .expect("it runs");
    let triangles = |answer: &Answer| answer.hits.iter().map(|h| h.map(|h| h.triangle)).collect::<Vec<_>>();
    assert_eq!(triangles(&vertex), triangles(&pixel));
    let hits = vertex.hits.iter().flatten().count();
    assert!(hits > 40, "the teapot fills a part of the picture: {hits} of 256");
    for (a, b) in vertex.hits.iter().flatten().zip(pixel.hits.iter().flatten()) {
        assert!((a.t - b.t).abs() <= b.t * 2e-5, "24 bits of depth against fp32: {} and {}", a.t, b.t);
    }
    assert_eq!(vertex.events.vertices, 3 * 256 * mesh.len() as u64, "three vertices a test");
    assert_eq!(vertex.events.vertex_instructions, 20 * vertex.events.vertices);
}

//! Invalid input of a radiosity solution is refused with helpful messages.

use crossbar::geom::Mesh;
use crossbar::radiosity::rooms::{self, CornellBox};
use crossbar::radiosity::{FormFactors, MAX_PATCHES, Patches, Subdivision, System, packing};
use crossbar::scene::{Material, Scene, Surface};

use super::white;

#[test]
fn scenes_that_make_no_patches() {
    let corners = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [2.0, 0.0, 0.0]];
    let one = Subdivision::PerSide(1);
    let scene = |positions: &[[f32; 3]], triangles: &[[u32; 3]]| {
        white(Mesh::new(positions.to_vec(), triangles.to_vec()).expect("a mesh"))
    };
    let said = |scene: &Scene, cut| Patches::new(scene, cut).unwrap_err().to_string();
    let nothing = "expected a scene with surfaces, found none";
    assert_eq!(said(&Scene::default(), one), nothing);
    let flat = scene(&corners, &[[0, 1, 2], [0, 1, 3]]);
    let patches = Patches::new(&flat, one).expect("a triangle without area has no patch");
    assert_eq!((patches.list().len(), patches.list()[0].area()), (1, 0.5));
    assert_eq!(said(&scene(&corners, &[[0, 1, 3]]), one), nothing);
    let thin = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 1e-30]];
    let expected = "triangle 0 (counted from 0) is too thin for a patch; remove it, or merge its corners";
    assert_eq!(said(&scene(&thin, &[[0, 1, 2]]), one), expected);
    let good = scene(&corners, &[[0, 1, 2]]);
    assert_eq!(said(&good, Subdivision::PerSide(0)), "expected sides cut into 1 part or more, found 0");
    let expected = format!("expected at most {MAX_PATCHES} patches, found 40000; cut the faces into fewer");
    assert_eq!(said(&good, Subdivision::PerSide(200)), expected);
    assert!(Patches::new(&good, Subdivision::AtMost(MAX_PATCHES)).is_ok());
    let mirror = Material { surface: Surface::Mirror { reflectance: [1.0; 3] }, ..good.materials()[0].clone() };
    let mirror = Scene::new(good.mesh().clone(), vec![mirror], vec![0], Vec::new()).expect("a scene");
    let expected = "material `white` is a mirror, expected a diffuse surface: radiosity supports no other";
    assert_eq!(said(&mirror, one), expected);
}

#[test]
fn an_open_room_has_a_solution() {
    let patches = Patches::new(&rooms::cornell(CornellBox { blocks: false, open: true }), Subdivision::AtMost(60))
        .expect("patches");
    let factors = FormFactors::unoccluded(&patches).expect("factors");
    assert!(factors.summary().escaping > 1e-3, "no front wall");
    System::new(factors, patches.reflectances(), patches.emittances()).expect("open rooms have solutions");
}

#[test]
fn systems_of_impossible_surfaces() {
    let patches = Patches::new(&rooms::furnace(0.5), Subdivision::PerSide(1)).expect("patches");
    let factors = FormFactors::unoccluded(&patches).expect("factors");
    let system = |rho: f64, e: f64| System::new(factors.clone(), vec![[rho, 0.5, 0.5]; 6], vec![[e; 3]; 6]).map(|_| ());
    assert!(system(0.0, 0.0).is_ok());
    for rho in [1.0, -0.1, f64::NAN] {
        let refused = system(rho, 0.0).expect_err("impossible").to_string();
        assert!(refused.contains("at least 0 and below 1") && refused.contains("patch 0"), "{refused}");
    }
    for e in [-1.0, f64::INFINITY] {
        assert!(system(0.5, e).expect_err("impossible").to_string().starts_with("expected finite emittances"));
    }
    let short = System::new(factors, vec![[0.5; 3]; 5], vec![[0.0; 3]; 6]).expect_err("one too few").to_string();
    assert_eq!(short, "expected 6 reflectances, one per patch, found 5");
}

#[test]
fn a_matrix_beyond_the_cards_textures_names_the_limit() {
    let refused = packing::rgb_vector(&[[0.0; 3]; 2049], 2048).expect_err("2049 > 2048").to_string();
    let words = "expected a vector that fits a texture of 2048 x 2048 texels, the card's largest, found 2049 x 1; use fewer patches";
    assert_eq!(refused, words);
}

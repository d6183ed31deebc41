//! Invalid input of a radiosity solution is refused with helpful messages.

use crossbar::geom::Mesh;
use crossbar::radiosity::rooms;
use crossbar::radiosity::{FormFactors, MAX_PATCHES, Patches, Subdivision, System};
use crossbar::scene::{Material, Scene, Surface};

use super::white;

#[test]
fn scenes_that_make_no_patches() {
    let corners = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [2.0, 0.0, 0.0]];
    let one = Subdivision::PerSide(1);
    let scene = |positions: &[[f32; 3]], triangles: &[[u32; 3]]| {
        white(Mesh::new(positions.to_vec(), triangles.to_vec()).expect("a mesh"))
    };
    let flat = scene(&corners, &[[0, 1, 2], [0, 1, 3]]);
    let patches = Patches::new(&flat, one).expect("a triangle without area has no patch");
    assert_eq!((patches.list().len(), patches.list()[0].area()), (1, 0.5));
    let good = scene(&corners, &[[0, 1, 2]]);
    assert!(Patches::new(&good, Subdivision::AtMost(MAX_PATCHES)).is_ok());
    let mirror = Material { surface: Surface::Mirror { reflectance: [1.0; 3] }, ..good.materials()[0].clone() };
    let mirror = Scene::new(good.mesh().clone(), vec![mirror], vec![0], Vec::new()).expect("a scene");
    let many = scene(&corners, &[[0, 1, 2]; MAX_PATCHES + 1]);
    let thin = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 1e-30]];
    for (scene, cut, word) in [
        (&Scene::default(), one, "surfaces"),
        (&scene(&corners, &[[0, 1, 3]]), one, "surfaces"),
        (&scene(&thin, &[[0, 1, 2]]), one, "triangle 0 (counted from 0) is too thin"),
        (&good, Subdivision::PerSide(0), "found 0"),
        (&good, Subdivision::PerSide(200), "found 40000"),
        (&many, Subdivision::AtMost(9), "faces, each at least one patch, found 16385"),
        (&mirror, one, "material `white` is a mirror"),
    ] {
        let error = Patches::new(scene, cut).unwrap_err().to_string();
        assert!(error.contains(word), "{error}");
    }
}

#[test]
fn systems_of_impossible_surfaces() {
    let patches = Patches::new(&rooms::furnace(0.5), Subdivision::PerSide(1)).expect("patches");
    let factors = FormFactors::unoccluded(&patches).expect("factors");
    let system = |rho: f64, e: f64| System::new(factors.clone(), vec![[rho, 0.5, 0.5]; 6], vec![[e; 3]; 6]).map(|_| ());
    assert!(system(0.0, 0.0).is_ok());
    assert!([1.0, -0.1, f64::NAN].into_iter().all(|rho| system(rho, 0.0).is_err()));
    assert!([-1.0, f64::INFINITY].into_iter().all(|e| system(0.5, e).is_err()));
    assert!(System::new(factors, vec![[0.5; 3]; 5], vec![[0.0; 3]; 6]).is_err(), "one reflectance too few");
}

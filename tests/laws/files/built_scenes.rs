//! The scenes that the project builds: exact counts, valid triangles, and only front faces are visible.

use approx::abs_diff_eq;
use crossbar::geom::Contact;
use crossbar::geom::exact::{Sides, nearest_all};
use crossbar::geom::vector::wide;
use crossbar::io::scenes;
use crossbar::scene::Scene;

fn scene(name: &str) -> Scene {
    scenes::named(name).expect("a scene of that name")
}

#[test]
fn counts_are_those_of_the_paper() {
    let counts = [
        ("teapot-room", 2_650),
        ("office", 34_000),
        ("office-floor", 11_052),
        ("cornell-box", 42),
        ("harbour", 19_130),
        ("white-box", 12),
    ];
    for (name, triangles) in counts {
        assert_eq!(scene(name).mesh().len(), triangles, "{name}");
    }
    assert!(scenes::named("nowhere").is_none());
}

#[test]
fn triangles_have_areas_and_normals_lean_to_the_front() {
    for name in scenes::names() {
        let scene = scene(name);
        assert_eq!(scene.mesh().degenerate_count(), 0, "{name}");
        assert!(!scene.views.is_empty(), "{name} has a view");
        assert!(!scene.emitters().is_empty(), "{name} has a light");
        for (triangle, [a, b, c]) in (0..).zip(scene.mesh().iter_corners()) {
            let Some(normals) = scene.corner_normals(triangle) else { continue };
            let [a, b, c] = [a, b, c].map(wide);
            let face = (b - a).cross(c - a);
            for normal in normals {
                let normal = wide(normal);
                assert!(
                    abs_diff_eq!(normal.length_squared(), 1.0, epsilon = 1e-6),
                    "{name}: normal {normal:?} of triangle {triangle}"
                );
                assert!(normal.dot(face) > 0.0, "{name}: normal {normal:?} of triangle {triangle} leans back");
            }
        }
    }
}

#[test]
fn views_see_fronts_only() {
    for name in scenes::names() {
        let scene = scene(name);
        for view in &scene.views {
            let rays = view.camera(64, 64).expect("a camera").rays();
            let front = nearest_all(scene.mesh(), &rays, Sides::Front);
            let both = nearest_all(scene.mesh(), &rays, Sides::Both);
            for (pixel, (front, both)) in front.iter().zip(&both).enumerate() {
                // Two coincident faces would cause noise in a card's depth buffer.
                if let Some(hit) = both {
                    let apart = hit
                        .ties
                        .iter()
                        .find(|&&tie| scene.mesh().contact(tie, hit.triangle) == Contact::None && tie != hit.triangle);
                    assert_eq!(apart, None, "{name}, {}: pixel {pixel} sees two faces in one plane", view.name);
                }
                if front == both {
                    continue;
                }
                // The teapot is open between pot and lid, so its inside is visible there.
                let seen = both.as_ref().map(|hit| scene.material(hit.triangle));
                let through = seen.is_some_and(|material| material.name == "copper");
                assert!(through, "{name}, {}: pixel {pixel} sees the back of {seen:?}", view.name);
            }
        }
    }
}

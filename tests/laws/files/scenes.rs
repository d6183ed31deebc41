//! Scene files: writing and reading back yields the same bits, and no bytes cause a panic.

use std::io;
use std::path::Path;

use crossbar::geom::Mesh;
use crossbar::io::{
    ModelOptions, UpAxis, load_mesh_with, load_scene_with, parse_mtl, parse_scene, scene_file, scene_files, scenes,
    write_mtl, write_scene,
};
use crossbar::scene::{Material, Scene, Surface};
use proptest::prelude::*;

use super::mutation::mutated;
use crate::support::file;

const OBJ: &str = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 .5 0\nvn 0 0 1\nvn .6 0 .8\nusemtl red\nf 1//1 2//2 3//-1\n\
                   usemtl glass\nf 1 2 3 4\nusemtl mirror\nf 1/1/1 -1/2/1 \\\n-2/3/1\n";
const MTL: &str = "newmtl red\nKd 0.5 0.1 .1\nKs .25 .25 .25\nNs 20\nillum 2\nd 1\nmap_Kd a.png\n\nnewmtl glass\nillum 6\n\
                   Ni 1.33\nTf .9 1 .9\nKe 0 1 2\n# end\nnewmtl mirror\nKs .5\nillum 3\n";
const TOML: &str = "mesh = \"a.obj\"\n[[view]]\nname = \"v\"\neye = [0.0, 0, 1]\ntarget = [1.0, 0, 0]\nup = [0.0, 0, 1]\n\
                    tan_half_height = 0.5\n[[point_light]]\nposition = [0.0, 0, 0]\nintensity = [1.0, 1, 1]\n";

fn parse(obj: &[u8], mtl: &[u8]) -> Option<Scene> {
    let library = &mut |name: &Path| match name.to_str() {
        Some("a.mtl") => Ok(mtl.to_vec()),
        _ => Err(io::Error::from(io::ErrorKind::NotFound)),
    };
    parse_scene(obj, Path::new("a.obj"), library).ok()
}

fn round_trip(scene: &Scene) -> Scene {
    let (mut obj, mut mtl) = (Vec::new(), Vec::new());
    write_scene(scene, "a.mtl", &mut obj).expect("written");
    write_mtl(scene.materials(), &mut mtl).expect("written");
    parse(&obj, &mtl).expect("a scene")
}

/// The bits of three points.
type Bits = [[u32; 3]; 3];

/// Everything that must survive a round trip, as bits: corners, normals and materials of all triangles.
fn bits(scene: &Scene) -> Vec<(Bits, Option<Bits>, String)> {
    let bits = |corners: [[f32; 3]; 3]| corners.map(|corner| corner.map(f32::to_bits));
    let triangle =
        |(id, corners)| (bits(corners), scene.corner_normals(id).map(bits), format!("{:?}", scene.material(id)));
    (0..).zip(scene.mesh().iter_corners()).map(triangle).collect()
}

#[test]
fn the_good_scene_is_good() {
    let scene = parse(OBJ.as_bytes(), MTL.as_bytes()).expect("a scene");
    assert_eq!(scene.mesh().len(), 4);
    assert_eq!(scene.material_of(), [0, 1, 1, 2]);
    let names: Vec<&str> = scene.materials().iter().map(|material| material.name.as_str()).collect();
    assert_eq!(names, ["red", "glass", "mirror"]);
    let red = Surface::Glossy { albedo: [0.5, 0.1, 0.1], specular: [0.25; 3], exponent: 20.0 };
    assert_eq!(scene.materials()[0].surface, red);
    assert_eq!(scene.materials()[1].surface, Surface::Glass { index: 1.33, transmittance: [0.9, 1.0, 0.9] });
    assert_eq!(scene.materials()[1].emission, [0.0, 1.0, 2.0]);
    assert_eq!(scene.materials()[2].surface, Surface::Mirror { reflectance: [0.5; 3] });
    assert_eq!(scene.corner_normals(0), Some([[0.0, 0.0, 1.0], [0.6, 0.0, 0.8], [0.6, 0.0, 0.8]]));
    assert_eq!(scene.corner_normals(1), None);
    assert_eq!(scene.emitters(), [1, 2]);
    assert!(scene_file::parse(TOML, Path::new("a.toml")).is_ok());
}

#[test]
fn built_scenes_read_back_whole() {
    for name in scenes::names() {
        let scene = scenes::named(name).expect("a scene");
        let mut back = round_trip(&scene);
        let files = scene_files(&scene, "a").expect("files");
        let text = std::str::from_utf8(&files[0].1).expect("text");
        (_, back.views, back.point_lights) = scene_file::parse(text, Path::new("a.toml")).expect("a scene file");
        assert_eq!(back, scene, "{name}");
    }
}

fn word() -> impl Strategy<Value = String> {
    let known = "v vn f usemtl mtllib newmtl Kd Ks Ke Ns Ni Tf d Tr illum a.mtl red 0 1 0.5 -1 2 6 3 7 11 1e39 nan -0 1//1 1//-1 \
                 2//2 3//9 2/1/1 1e-45 # \\ [[view]] name = \" é";
    let mut known: Vec<&str> = known.split(' ').collect();
    known.extend(["\n"; 12]);
    prop::sample::select(known).prop_map(str::to_owned)
}

fn surface() -> impl Strategy<Value = Surface> {
    let share = || (0_u32..=0x3f00_0000).prop_map(f32::from_bits);
    let color = move || [share(), share(), share()];
    let above = || (1_u32..0x7f80_0000).prop_map(f32::from_bits);
    prop_oneof![
        color().prop_map(|albedo| Surface::Diffuse { albedo }),
        (color(), color(), above())
            .prop_filter("a lobe that is not black", |(_, specular, _)| specular != &[0.0; 3])
            .prop_map(|(albedo, specular, exponent)| Surface::Glossy { albedo, specular, exponent }),
        color().prop_map(|reflectance| Surface::Mirror { reflectance }),
        (above(), color()).prop_map(|(index, transmittance)| Surface::Glass { index, transmittance }),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1500))]

    #[test]
    fn mutated_files_do_no_harm(obj in mutated(OBJ, 0..8), mtl in mutated(MTL, 0..8), toml in mutated(TOML, 0..8)) {
        if let Some(scene) = parse(&obj, &mtl) {
            let plain = |material: &Material| !material.name.contains(|c: char| c.is_whitespace() || c == '\\');
            if scene.materials().iter().all(plain) {
                prop_assert_eq!(bits(&round_trip(&scene)), bits(&scene));
            }
        }
        let _ = scene_file::parse(&String::from_utf8_lossy(&toml), Path::new("a.toml"));
    }

    #[test]
    fn known_words_in_any_order_do_no_harm(words in prop::collection::vec(word(), 0..60)) {
        let text = words.join(" ");
        let _ = parse(text.as_bytes(), MTL.as_bytes());
        let _ = parse_mtl(text.as_bytes(), Path::new("a.mtl"));
        let _ = scene_file::parse(&text, Path::new("a.toml"));
    }

    #[test]
    fn materials_read_back_to_the_same_bits(
        surfaces in prop::collection::vec((surface(), any::<bool>(), (0_u32..0x7f80_0000).prop_map(f32::from_bits)), 1..8),
    ) {
        let materials: Vec<Material> = (0..).zip(surfaces).map(|(number, (surface, emits, emission))| {
            let emission = if emits { [emission, 0.0, 1.0] } else { [0.0; 3] };
            Material { name: format!("m{number}"), surface, emission }
        }).collect();
        let triangle = Mesh::new(vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], vec![[0, 1, 2]]).expect("a triangle");
        let scene = Scene::new(triangle, materials, vec![0], Vec::new()).expect("a scene");
        prop_assert_eq!(round_trip(&scene), scene);
    }
}

/// Materials of modelling tools that reflect more light than arrives are scaled with a note, or refused with
/// `--strict`.
#[test]
fn materials_of_modellers_are_scaled_and_noted() {
    let folder = tempfile::tempdir().expect("a folder");
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).expect("written");
    let model = folder.path().join("m.obj");
    write("m.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n");
    let read = |strict| load_scene_with(&model, ModelOptions { strict, ..ModelOptions::default() });
    let at = |line: usize| format!("{}:{line}: material a: ", folder.path().join("m.mtl").display());
    for (mtl, note, surface) in [
        (
            "newmtl a\nNs 225\nKd 0.8 0.8 0.8\nKs 0.5 0.5 0.5\nNi 1.45\nd 1\nillum 2\n",
            "`Kd` and `Ks` scaled by 1 / 1.3, to reflect at most all light",
            Surface::Glossy { albedo: [0.8 / 1.3; 3], specular: [0.5 / 1.3; 3], exponent: 225.0 },
        ),
        (
            "newmtl a\nKd 0.8 0.4 0.2\nd 0.5\nillum 1\n",
            "read as opaque; only glass (`illum 6`) lets 0.5 pass",
            Surface::Diffuse { albedo: [0.8, 0.4, 0.2] },
        ),
        (
            "newmtl a\nKd 2 1 0\n",
            "`Kd` and `Ks` scaled by 1 / 2, to reflect at most all light",
            Surface::Diffuse { albedo: [1.0, 0.5, 0.0] },
        ),
        (
            "newmtl a\nNs 0\nKd 0.5 0.5 0.5\nKs 0.5 0.5 0.5\nillum 2\n",
            "`Ns 0` read as 1, the widest lobe",
            Surface::Glossy { albedo: [0.5; 3], specular: [0.5; 3], exponent: 1.0 },
        ),
    ] {
        write("m.mtl", mtl);
        let (scene, notes) = read(false).expect("a scene");
        assert_eq!(scene.material(0).surface, surface, "{mtl}");
        assert_eq!(notes.iter().map(ToString::to_string).collect::<Vec<_>>(), [at(1) + note]);
        assert!(read(true).is_err() && parse_mtl(mtl.as_bytes(), Path::new("m.mtl")).is_err(), "{mtl}");
    }
    write("m.mtl", "newmtl a\nKd 0.5 0.5 0.5\n");
    assert_eq!(read(false).expect("a scene").1, []);
}

/// A model with y up has the same bits as its z-up version, and so does its scene; glTF has y up by definition.
#[test]
fn models_stand_up() {
    let models = file("fixtures/models");
    let up = |up| ModelOptions { up, strict: true };
    for name in ["square.obj", "square.stl", "square.ply", "square.gltf"] {
        let path = models.join(name);
        let [plain, y, z] = [None, Some(UpAxis::Y), Some(UpAxis::Z)].map(|axis| {
            let (mesh, _) = load_mesh_with(&path, up(axis)).expect("a mesh");
            let (scene, _) = load_scene_with(&path, up(axis)).expect("a scene");
            assert_eq!(
                scene.mesh().iter_corners().collect::<Vec<_>>(),
                mesh.iter_corners().collect::<Vec<_>>(),
                "{name}"
            );
            mesh
        });
        assert_eq!(plain, if name == "square.gltf" { y.clone() } else { z.clone() }, "{name}");
        assert_eq!(z.rotated(|[x, y, z]| [x, -z, y]), y, "{name}");
    }
}

/// Flipped triangles are reversed with their normals, and counted; degenerate triangles and edges of many faces are
/// counted, too.
#[test]
fn odd_models_are_mended_and_counted() {
    let folder = tempfile::tempdir().expect("a folder");
    let model = folder.path().join("m.obj");
    let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 1\nv 2 1 1\nv 1 0 9\nvn 0 0 1\nvn 0 1 0\nvn 1 0 0\n\
                f 1//1 2//2 3//3\nf 1//1 4//2 3//3\nf 2//1 5//1 3//1\nf 5//1 6//1 3//1\nf 2//1 3//1 7//1\n\
                f 5//1 5//1 6//1\nf 5//1 6//1 5//1\n";
    std::fs::write(&model, text).expect("written");
    let lenient = ModelOptions::default();
    let (scene, notes) = load_scene_with(&model, lenient).expect("a scene");
    let said: Vec<String> = notes.iter().map(ToString::to_string).collect();
    assert_eq!(
        said,
        [
            "1 triangle flipped, to face like the neighbours",
            "2 triangles without area: never hit",
            "1 edge of three triangles or more"
        ]
    );
    assert_eq!(scene.mesh().triangles()[1], [0, 2, 3]);
    assert_eq!(scene.corner_normals(1), Some([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]));
    let (mesh, of_mesh) = load_mesh_with(&model, lenient).expect("a mesh");
    assert_eq!(of_mesh, notes);
    assert_eq!(mesh.iter_corners().collect::<Vec<_>>(), scene.mesh().iter_corners().collect::<Vec<_>>());
    let as_it_is = load_mesh_with(&model, ModelOptions { strict: true, ..lenient }).expect("a mesh");
    assert_eq!(as_it_is, (crossbar::io::load_mesh(&model).expect("a mesh"), Vec::new()));
}

/// Names as 3ds Max and other programs write them: with spaces and `#`, or several libraries in a line.
#[test]
fn names_run_to_the_end_of_their_line() {
    let folder = tempfile::tempdir().expect("a folder");
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).expect("written");
    write("a.mtl", "\u{feff}# 3ds Max\nnewmtl Material #25\nKd 0.1 0.1 0.1 # dark\nnewmtl Material #26\nKd .2 .2 .2\n");
    // In Latin-1, in which each of these bytes is a character.
    let latin_1 = b"# caf\xe9\nnewmtl caf\xe9\nKd .5 0 0\nnewmtl caf\xe8\nKd .6 0 0\n";
    std::fs::write(folder.path().join("c.mtl"), latin_1).expect("written");
    let text = b"# caf\xe9\nmtllib c.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl caf\xe8\ng caf\xe9\nf 1 2 3\n";
    let latin_1 = folder.path().join("latin_1.obj");
    std::fs::write(&latin_1, text).expect("written");
    let scene = load_scene_with(&latin_1, ModelOptions { strict: true, up: None }).expect("a scene").0;
    assert_eq!(scene.material(0).name, "caf\u{e8}");
    write("my b.mtl", "newmtl red\nKd 0.3 0 0\nnewmtl blue\nKd 0 0 0.4\n");
    let model = folder.path().join("m.obj");
    let face = "\nf 1 2 3\n";
    let names = ["Material #25", "Material #26", "red", "blue", "blue # sky"];
    let text = |libraries: &str, names: &[&str]| {
        let faces: String = names.iter().map(|name| format!("usemtl {name}{face}")).collect();
        format!("\u{feff}mtllib {libraries}\nv 0 0 0\nv 1 0 0\nv 0 1 0\n{faces}")
    };
    let albedos = |names: &[&str], libraries: &str| {
        write("m.obj", &text(libraries, names));
        let (scene, notes) = load_scene_with(&model, ModelOptions::default()).expect("a scene");
        let albedo = |triangle| match scene.material(triangle).surface {
            Surface::Diffuse { albedo } => albedo,
            other => panic!("{other:?}"),
        };
        ((0..names.len() as u32).map(albedo).collect::<Vec<_>>(), notes)
    };
    let (found, notes) = albedos(&names, "a.mtl my b.mtl # both");
    let (red, blue) = ([0.3, 0.0, 0.0], [0.0, 0.0, 0.4]);
    assert_eq!(found, [[0.1; 3], [0.2; 3], red, blue, [0.5; 3]]);
    let unknown = format!("{}:13: material blue # sky: in no library, read as grey", model.display());
    assert_eq!(notes.iter().map(ToString::to_string).collect::<Vec<_>>()[0], unknown);
    let refused = load_scene_with(&model, ModelOptions { strict: true, up: None }).expect_err("unknown").to_string();
    assert!(
        refused
            .ends_with("m.obj:13: material blue # sky: expected a material of its libraries, found no such material"),
        "{refused}"
    );
    // Whether a line with spaces names one file or several is a guess.
    assert_eq!(albedos(&["Material"], "a.mtl").0, [[0.5; 3]]);
    assert_eq!(albedos(&["blue"], "my b.mtl").0, [blue]);
    write("a.mtl b.mtl", "newmtl blue\nKd 0.6 0.6 0.6\n");
    assert_eq!(albedos(&["blue"], "a.mtl b.mtl").0, [[0.6; 3]], "a file of this name counts first");
    for (line, missing) in [("none.mtl", "none.mtl"), ("a.mtl d.mtl", "d.mtl"), ("a.mtl d", "d")] {
        write("m.obj", &text(line, &["blue"]));
        let error = load_scene_with(&model, ModelOptions::default()).expect_err(line).to_string();
        let expected = format!("m.obj:1: cannot read the material library {}", folder.path().join(missing).display());
        assert!(error.ends_with(&expected), "{error}");
    }
    let scene = scene_file::parse("\u{feff}mesh = \"m.obj\"\n", Path::new("s.toml")).expect("a scene");
    assert_eq!(scene.0, Path::new("m.obj"));
}

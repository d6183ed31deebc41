//! The glTF reader: geometry and materials by the format's definition, messages, and no panic for any bytes.

use std::io;
use std::path::Path;

use base64::{Engine as _, engine::general_purpose::STANDARD};
use crossbar::geom::Mesh;
use crossbar::io::{load_mesh, load_scene, parse_gltf};
use crossbar::scene::{Scene, Surface};
use proptest::prelude::*;
use serde_json::{Value, json};

use crate::support::file;

/// The four vertices of a square, with y up: position, normal along y, texture coordinates.
const SQUARE: [[f32; 8]; 4] = [
    [0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0],
    [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0],
    [1.0, 0.0, -1.0, 0.0, 1.0, 0.0, 1.0, 1.0],
    [0.0, 0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 1.0],
];
const FAN: [u16; 4] = [0, 1, 2, 3];
const STRIP: [u16; 4] = [0, 1, 3, 2];
const TWO: [u16; 6] = [0, 1, 2, 0, 2, 3];

/// The vertices interleaved (128 bytes), then the indices of two triangles (12), a fan (8) and a strip (8).
fn bytes() -> Vec<u8> {
    let vertices = SQUARE.iter().flatten().flat_map(|number| number.to_le_bytes());
    let indices = TWO.iter().chain(&FAN).chain(&STRIP).flat_map(|index| index.to_le_bytes());
    vertices.chain(indices).collect()
}

/// A document with the square as two triangles, as a fan, as a strip and without indices: meshes 0 to 3.
fn document(nodes: Value) -> Value {
    let view = |offset: usize, length: usize, stride: Option<usize>| match stride {
        Some(stride) => json!({ "buffer": 0, "byteOffset": offset, "byteLength": length, "byteStride": stride }),
        None => json!({ "buffer": 0, "byteOffset": offset, "byteLength": length }),
    };
    let floats = |offset: usize, kind: &str| {
        json!({ "bufferView": 0, "byteOffset": offset, "componentType": 5126, "count": 4, "type": kind,
                "min": [0, 0, -1], "max": [1, 0, 0] })
    };
    let indices = |view: usize, count: usize| json!({ "bufferView": view, "componentType": 5123, "count": count, "type": "SCALAR" });
    let all = json!({ "POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2 });
    let mesh = |primitive: Value| json!({ "primitives": [primitive] });
    json!({
        "asset": { "version": "2.0" },
        "scene": 0,
        "scenes": [{ "nodes": (0..nodes.as_array().map_or(0, Vec::len)).collect::<Vec<_>>() }],
        "nodes": nodes,
        "meshes": [
            mesh(json!({ "attributes": all, "indices": 3, "material": 0 })),
            mesh(json!({ "attributes": all, "indices": 4, "mode": 6 })),
            mesh(json!({ "attributes": all, "indices": 5, "mode": 5 })),
            mesh(json!({ "attributes": { "POSITION": 0 }, "mode": 6, "material": 1 })),
        ],
        "materials": [
            { "name": "red paint", "pbrMetallicRoughness": { "baseColorFactor": [0.8, 0.1, 0.2, 1.0] } },
            { "emissiveFactor": [1.0, 0.5, 0.25],
              "extensions": { "KHR_materials_emissive_strength": { "emissiveStrength": 8.0 } } },
        ],
        "extensionsUsed": ["KHR_materials_emissive_strength"],
        "accessors": [
            floats(0, "VEC3"), floats(12, "VEC3"),
            { "bufferView": 0, "byteOffset": 24, "componentType": 5126, "count": 4, "type": "VEC2" },
            indices(1, 6), indices(2, 4), indices(3, 4),
        ],
        "bufferViews": [view(0, 128, Some(32)), view(128, 12, None), view(140, 8, None), view(148, 8, None)],
        "buffers": [{ "byteLength": 156 }],
    })
}

/// The document and the buffer as GLB.
fn glb(document: &Value, buffer: &[u8]) -> Vec<u8> {
    let padded = |mut bytes: Vec<u8>, with: u8| {
        bytes.resize(bytes.len().next_multiple_of(4), with);
        bytes
    };
    let chunk = |kind: &[u8; 4], bytes: Vec<u8>| [&(bytes.len() as u32).to_le_bytes()[..], kind, &bytes].concat();
    let chunks =
        [chunk(b"JSON", padded(document.to_string().into_bytes(), b' ')), chunk(b"BIN\0", padded(buffer.to_vec(), 0))]
            .concat();
    let length = 12 + chunks.len() as u32;
    [&b"glTF"[..], &2_u32.to_le_bytes(), &length.to_le_bytes(), &chunks].concat()
}

fn nothing_beside(_: &Path) -> io::Result<Vec<u8>> {
    Err(io::ErrorKind::NotFound.into())
}

fn read(document: &Value) -> Scene {
    parse_gltf(&glb(document, &bytes()), Path::new("m.glb"), &mut nothing_beside).expect("a scene")
}

fn message(document: &Value) -> String {
    parse_gltf(&glb(document, &bytes()), Path::new("m.glb"), &mut nothing_beside).expect_err("no scene").to_string()
}

/// The corners of all triangles.
fn soup(mesh: &Mesh) -> Vec<[[f32; 3]; 3]> {
    mesh.iter_corners().collect()
}

#[test]
fn all_primitives_make_the_same_square_and_z_is_up() {
    let scenes = [0, 1, 2, 3].map(|mesh| read(&document(json!([{ "mesh": mesh }]))));
    let [a, b, c, d] = [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    for scene in [&scenes[0], &scenes[1], &scenes[3]] {
        assert_eq!(soup(scene.mesh()), [[a, b, c], [a, c, d]]);
    }
    assert_eq!(soup(scenes[2].mesh()), [[a, b, d], [b, c, d]], "every second triangle of a strip is turned");
    for scene in &scenes[..3] {
        assert_eq!(scene.corner_normals(1), Some([[0.0, 0.0, 1.0]; 3]));
        assert_eq!(scene.mesh().texcoords().map(|uv| uv[2]), Some([1.0, 1.0]));
    }
    assert_eq!((scenes[3].corner_normals(0), scenes[3].mesh().normals()), (None, None));
}

#[test]
fn materials_have_base_color_and_emission() {
    let scene = read(&document(json!([{ "mesh": 0 }, { "mesh": 3 }, { "mesh": 1 }])));
    let names: Vec<&str> = scene.materials().iter().map(|material| material.name.as_str()).collect();
    assert_eq!(names, ["red_paint", "_1", "default"], "names have no white space");
    assert_eq!(scene.material_of(), [0, 0, 1, 1, 2, 2]);
    assert_eq!(scene.material(0).surface, Surface::Diffuse { albedo: [0.8, 0.1, 0.2] });
    assert_eq!(scene.material(2).emission, [8.0, 4.0, 2.0]);
    assert_eq!(scene.emitters(), [2, 3]);
}

#[test]
fn nodes_move_turn_scale_and_mirror() {
    // A quarter turn about y takes x to -z in glTF, which is y in the mesh.
    let half = 0.5_f32.sqrt();
    let nodes = json!([
        { "mesh": 0, "translation": [1, 2, 3], "rotation": [0, half, 0, half], "scale": [2, 1, 1] },
        { "children": [2], "scale": [-1, 1, 1] },
        { "mesh": 0, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 0, 0, 1] },
    ]);
    let mut all = document(nodes);
    all["scenes"][0]["nodes"] = json!([0, 1]);
    let scene = read(&all);
    let near = |found: [f32; 3], want: [f32; 3]| found.iter().zip(want).all(|(x, y)| (x - y).abs() < 1e-6);
    let corners: Vec<[f32; 3]> = soup(scene.mesh())[0].to_vec();
    assert!(near(corners[0], [1.0, -3.0, 2.0]) && near(corners[1], [1.0, -1.0, 2.0]), "{corners:?}");
    let [a, b, c] = soup(scene.mesh())[2];
    assert_eq!(
        [a, b, c],
        [[-5.0, 0.0, 0.0], [-6.0, 1.0, 0.0], [-6.0, 0.0, 0.0]],
        "a mirrored triangle stays outside out"
    );
    assert_eq!(scene.corner_normals(2), Some([[0.0, 0.0, 1.0]; 3]), "and so does its normal");
}

#[test]
fn texture_coordinates_may_be_unsigned_fractions() {
    let mut fractions = document(json!([{ "mesh": 0 }]));
    // The bytes of 1.0, little-endian: 0, 0, 128, 63.
    fractions["accessors"][2] = json!({ "bufferView": 0, "byteOffset": 2, "componentType": 5121, "count": 4, "type": "VEC2", "normalized": true });
    fractions["bufferViews"][0]["byteOffset"] = json!(0);
    let first = |document: &Value| read(document).mesh().texcoords().map(|uv| uv[1]);
    assert_eq!(first(&fractions), Some([128.0 / 255.0, 63.0 / 255.0]));
    fractions["accessors"][2]["componentType"] = json!(5123);
    assert_eq!(first(&fractions), Some([16256.0 / 65535.0, 0.0]));
}

/// The specification allows each of these documents, and none of them changes the square.
#[test]
fn rare_but_legal_documents_are_read() {
    let square = read(&document(json!([{ "mesh": 0 }])));
    let with = |changes: &[(&str, &str, Value)]| {
        let mut all = document(json!([{ "mesh": 0 }]));
        for (pointer, key, value) in changes {
            all.pointer_mut(pointer).unwrap_or_else(|| panic!("{pointer}"))[*key] = value.clone();
        }
        all
    };
    let attributes = "/meshes/0/primitives/0/attributes";
    for changes in [
        // 5.27: scenes need no nodes, and animation channels need no targets.
        vec![("", "scene", json!(1)), ("", "scenes", json!([{}, { "nodes": [0] }]))],
        vec![(
            "",
            "animations",
            json!([{ "channels": [{ "sampler": 0, "target": { "path": "pointer" } }], "samplers": [{ "input": 0, "output": 0 }] }]),
        )],
        // 3.7.2.1: attributes of applications begin with an underscore.
        vec![
            (attributes, "_TEMPERATURE", json!(0)),
            (attributes, "_ID", json!(1)),
            (attributes, "TEXCOORD_7", json!(2)),
        ],
        vec![
            (attributes, "JOINTS_0", json!(2)),
            (attributes, "WEIGHTS_0", json!(2)),
            (attributes, "COLOR_3", json!(0)),
        ],
        // 5.29: a texture needs no source, and an image may have a type that the core does not define.
        vec![
            (
                "",
                "textures",
                json!([{}, { "sampler": 0, "source": 0, "extensions": { "KHR_texture_basisu": { "source": 0 } } }]),
            ),
            ("", "images", json!([{ "uri": "a.ktx2", "mimeType": "image/ktx2" }])),
            ("", "samplers", json!([{ "extras": [1] }])),
            ("/materials/0", "normalTexture", json!({ "index": 0, "texCoord": 3 })),
            ("/materials/0/pbrMetallicRoughness", "baseColorTexture", json!({ "index": 1 })),
        ],
        // 5.18: extras are of any type.
        vec![("", "extras", json!("text")), ("/nodes/0", "extras", json!([1])), ("/asset", "extras", json!(5))],
        vec![
            ("/nodes/0", "camera", json!(0)),
            ("", "cameras", json!([{ "type": "x", "extensions": { "EXT_x": {} } }])),
        ],
        vec![("", "extensionsUsed", json!(["EXT_x"])), ("/nodes/0", "extensions", json!({ "EXT_x": { "a": [] } }))],
    ] {
        assert_eq!(read(&with(&changes)), square, "{changes:?}");
    }
    // 3.7.2.1: without positions a primitive is skipped; points and lines are not a surface.
    for skipped in [json!({ "attributes": { "NORMAL": 1 } }), json!({ "attributes": { "POSITION": 0 }, "mode": 1 })] {
        let mut all = document(json!([{ "mesh": 0 }]));
        all["meshes"][0]["primitives"].as_array_mut().expect("primitives").push(skipped);
        assert_eq!(read(&all), square);
    }
    // 3.6.1.1: a reader may ignore a byte order mark before JSON.
    let text = document(json!([{ "mesh": 0 }])).to_string();
    let uri = format!("{{\"uri\":\"data:application/gltf-buffer;base64,{}\",", STANDARD.encode(bytes()));
    let marked = format!("\u{feff}{}", text.replace("\"buffers\":[{", &format!("\"buffers\":[{uri}")));
    assert_eq!(parse_gltf(marked.as_bytes(), Path::new("m.gltf"), &mut nothing_beside).expect("a scene"), square);
}

#[test]
fn errors_say_where_and_what() {
    let with = |pointer: &str, value: Value| {
        let mut document = document(json!([{ "mesh": 0 }]));
        *document.pointer_mut(pointer).unwrap_or_else(|| panic!("{pointer}")) = value;
        message(&document)
    };
    let text =
        |bytes: &[u8]| parse_gltf(bytes, Path::new("m.gltf"), &mut nothing_beside).expect_err("no scene").to_string();
    let mut required = document(json!([{ "mesh": 0 }]));
    required["extensionsRequired"] = json!(["KHR_draco_mesh_compression"]);
    let said = [
        with("/asset/version", json!("1.0")),
        with("/asset", json!({ "version": "2.1", "minVersion": "2.1" })),
        with("/scenes/0/nodes", json!([7])),
        with("/meshes/0/primitives/0/attributes", json!({ "POSITION": 99 })),
        with("/accessors/3/count", json!(5)),
        with("/accessors/3/count", json!(7)),
        with("/accessors/0/count", json!(2)),
        with("/accessors/3/componentType", json!(5126)),
        with("/bufferViews/0/byteLength", json!(1000)),
        with("/buffers/0/byteLength", json!(157)),
        with("/buffers/0", json!({ "byteLength": 1, "uri": "../../etc/hosts" })),
        with("/materials/0/pbrMetallicRoughness/baseColorFactor", json!([2, 0, 0, 1])),
        with("/nodes/0", json!({ "children": [0] })),
        with("/nodes/0", json!({ "mesh": 0, "rotation": [0, 0, 0, 0] })),
        with("/nodes/0", json!({})),
        message(&required),
        text(b"glTF\x01\0\0\0"),
        text(b"glTF\x02\0\0\0\x0c\0\0\0"),
        text(b"glTF\x02\0\0\0\x05\0\0\0"),
    ];
    insta::assert_snapshot!(said.join("\n"));
    assert!(text(b"{\n\"asset\": x").starts_with("m.gltf:2: expected a glTF 2.0 document, found something else: "));
}

#[test]
fn buffers_stand_in_the_text_or_beside_it() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let mut all = document(json!([{ "mesh": 0 }]));
    all["buffers"][0]["uri"] = json!(format!("data:application/octet-stream;base64,{}", STANDARD.encode(bytes())));
    let inside = folder.path().join("inside.gltf");
    std::fs::write(&inside, all.to_string()).expect("written");
    all["buffers"][0]["uri"] = json!("my%20parts/a.bin");
    let beside = folder.path().join("beside.gltf");
    std::fs::write(&beside, all.to_string()).expect("written");
    let missing = load_mesh(&beside).expect_err("no buffer yet").to_string();
    assert!(missing.contains("buffers[0]: cannot read ") && missing.contains("my parts/a.bin"), "{missing}");
    std::fs::create_dir(folder.path().join("my parts")).expect("a folder");
    std::fs::write(folder.path().join("my parts/a.bin"), bytes()).expect("written");
    assert_eq!(load_mesh(&inside).expect("a mesh"), load_mesh(&beside).expect("a mesh"));
    let square = load_scene(&file("fixtures/models/square.gltf")).expect("a scene");
    assert_eq!(square.mesh().len(), 2);
}

/// A small document with several kinds of everything.
fn rich() -> Vec<u8> {
    let nodes = json!([{ "mesh": 0, "scale": [1, 2, 1] }, { "mesh": 1 }, { "mesh": 2 }, { "mesh": 3, "children": [] }]);
    glb(&document(nodes), &bytes())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(3000))]

    /// Replacing digits keeps all lengths, so that more files pass the JSON parser.
    #[test]
    fn replaced_digits_do_no_harm(places in prop::collection::vec((any::<prop::sample::Index>(), 0..20_u32), 1..4)) {
        let mut bytes = rich();
        let digits: Vec<usize> = (0..bytes.len()).filter(|&at| bytes[at].is_ascii_digit()).collect();
        for (place, digit) in places {
            bytes[digits[place.index(digits.len())]] = b"0123456789-e.[]{},\" "[digit as usize];
        }
        let _ = parse_gltf(&bytes, Path::new("m.glb"), &mut nothing_beside);
    }
}

#[test]
fn the_rich_file_is_good() {
    let scene = parse_gltf(&rich(), Path::new("m.glb"), &mut nothing_beside).expect("a scene");
    assert_eq!(scene.mesh().len(), 8);
}

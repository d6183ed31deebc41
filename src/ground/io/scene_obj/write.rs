//! Writes scenes as text that reads back with the same bits: corners, normals, materials.

use std::collections::BTreeMap;
use std::io::{self, Write};

use crate::scene::{Color, Material, Scene, Surface};

/// Writes the triangles with their normals and the names of their materials; `library` is the file that [`write_mtl`]
/// fills.
pub fn write_scene(scene: &Scene, library: &str, out: &mut dyn Write) -> io::Result<()> {
    check_names(scene.materials())?;
    writeln!(out, "mtllib {library}")?;
    for [x, y, z] in scene.mesh().positions() {
        // Rust prints the shortest decimal that reads back to the same f32.
        writeln!(out, "v {x} {y} {z}")?;
    }
    let mut place_of = BTreeMap::<[u32; 3], usize>::new();
    for triangle in 0..scene.mesh().len() as u32 {
        for normal in scene.corner_normals(triangle).into_iter().flatten() {
            let next = place_of.len() + 1;
            if *place_of.entry(normal.map(f32::to_bits)).or_insert(next) == next {
                writeln!(out, "vn {} {} {}", normal[0], normal[1], normal[2])?;
            }
        }
    }
    let mut current = None;
    for (triangle, corners) in (0..).zip(scene.mesh().triangles()) {
        let material = scene.material_of()[triangle as usize];
        if current != Some(material) {
            writeln!(out, "usemtl {}", scene.material(triangle).name)?;
            current = Some(material);
        }
        let [a, b, c] = corners.map(|index| u64::from(index) + 1);
        match scene.corner_normals(triangle) {
            None => writeln!(out, "f {a} {b} {c}")?,
            Some(normals) => {
                let [na, nb, nc] = normals.map(|normal| place_of[&normal.map(f32::to_bits)]);
                writeln!(out, "f {a}//{na} {b}//{nb} {c}//{nc}")?;
            }
        }
    }
    Ok(())
}

/// Writes the materials. A glossy material with a black lobe reads back as diffuse, which is equivalent.
pub fn write_mtl(materials: &[Material], out: &mut dyn Write) -> io::Result<()> {
    check_names(materials)?;
    for material in materials {
        writeln!(out, "newmtl {}", material.name)?;
        match material.surface {
            Surface::Diffuse { albedo } => {
                color(out, "Kd", albedo)?;
                writeln!(out, "illum 1")?;
            }
            Surface::Glossy { albedo, specular, exponent } => {
                color(out, "Kd", albedo)?;
                color(out, "Ks", specular)?;
                writeln!(out, "Ns {exponent}\nillum 2")?;
            }
            Surface::Mirror { reflectance } => {
                color(out, "Ks", reflectance)?;
                writeln!(out, "illum 3")?;
            }
            Surface::Glass { index, transmittance } => {
                color(out, "Tf", transmittance)?;
                writeln!(out, "Ni {index}\nillum 6")?;
            }
        }
        if material.emits() {
            color(out, "Ke", material.emission)?;
        }
    }
    Ok(())
}

fn color(out: &mut dyn Write, key: &str, [r, g, b]: Color) -> io::Result<()> {
    writeln!(out, "{key} {r} {g} {b}")
}

/// Checks that names read back unchanged and are unique.
fn check_names(materials: &[Material]) -> io::Result<()> {
    let mut seen = std::collections::BTreeSet::new();
    for Material { name, .. } in materials {
        let is_line = name.trim_ascii() == name && !name.contains(char::is_control) && !name.ends_with('\\');
        let plain = !name.is_empty() && is_line;
        if !plain || !seen.insert(name) {
            let problem = format!("expected different names of materials that can end a line, found {name:?}");
            return Err(io::Error::new(io::ErrorKind::InvalidInput, problem));
        }
    }
    Ok(())
}

//! Reads glTF's materials: the base color as diffuse reflectance, and the emission.

use std::collections::BTreeSet;
use std::path::Path;

use gltf::Document;

use crate::error::InputError;
use crate::io::error::material_error;
use crate::io::scene_obj::{DEFAULT, GREY};
use crate::scene::Material;

/// The materials of a file, by their index.
pub(super) struct Materials {
    pub(super) list: Vec<Material>,
    grey: Option<u32>,
}

impl Materials {
    /// Reads the materials. Names are the file's without white space, made unique.
    pub(super) fn of(document: &Document, name: &Path) -> Result<Self, InputError> {
        let (mut list, mut names) = (Vec::new(), BTreeSet::from([DEFAULT.to_owned()]));
        for (index, material) in document.materials().enumerate() {
            let mut plain: String = material.name().unwrap_or_default().to_owned();
            plain = plain.replace(|c: char| c.is_whitespace() || c.is_control() || matches!(c, '#' | '\\'), "_");
            if plain.is_empty() || !names.insert(plain.clone()) {
                plain = format!("{plain}_{index}");
                names.insert(plain.clone());
            }
            let wrong = |expected: &'static str, [r, g, b]: [f32; 3]| {
                material_error(name, plain.chars().take(80).collect::<String>(), expected, format!("{r} {g} {b}"))
            };
            let [r, g, b, _] = material.pbr_metallic_roughness().base_color_factor();
            if [r, g, b].iter().any(|channel| !(0.0..=1.0).contains(channel)) {
                return Err(wrong("a base color within [0, 1]", [r, g, b]));
            }
            let strength = material.emissive_strength().unwrap_or(1.0);
            let emission = material.emissive_factor().map(|channel| channel * strength);
            if emission.iter().any(|channel| !(0.0..=f32::MAX).contains(channel)) {
                return Err(wrong("a finite emission of at least 0", emission));
            }
            list.push(Material { emission, ..Material::diffuse(plain, [r, g, b]) });
        }
        Ok(Self { list, grey: None })
    }

    /// The index of a primitive's material.
    pub(super) fn place(&mut self, material: Option<usize>) -> u32 {
        match material {
            Some(index) => index as u32,
            // Added on first use, so that only a file that needs a default material gets one.
            None => *self.grey.get_or_insert_with(|| {
                self.list.push(Material::diffuse(DEFAULT, [GREY; 3]));
                self.list.len() as u32 - 1
            }),
        }
    }
}

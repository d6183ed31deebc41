//! Transforms of the mesh instances of the default scene.

use std::path::Path;

use crate::error::InputError;
use crate::io::error::part_error;
use glam::{DMat4, DQuat, DVec3, DVec4};
use gltf::scene::Transform;
use gltf::{Document, Mesh, Node};

const UPRIGHT: DMat4 = DMat4::from_cols(DVec4::X, DVec4::Z, DVec4::NEG_Y, DVec4::W);

/// A mesh with its transform to the scene.
pub(super) struct Instance<'a> {
    pub(super) mesh: Mesh<'a>,
    pub(super) to_scene: DMat4,
}

/// The mesh instances of the default scene, else of the first scene, else of all root nodes, in the order of the tree.
pub(super) fn instances<'a>(document: &'a Document, name: &Path) -> Result<Vec<Instance<'a>>, InputError> {
    let wrong = |node: &Node<'_>, expected: &'static str, found: &str| {
        part_error(name, format!("nodes[{}]", node.index()), expected, found)
    };
    let mut open: Vec<(Node<'_>, DMat4)> = roots(document).into_iter().rev().map(|node| (node, UPRIGHT)).collect();
    let (mut seen, mut found) = (vec![false; document.nodes().len()], Vec::new());
    while let Some((node, parent)) = open.pop() {
        if std::mem::replace(&mut seen[node.index()], true) {
            return Err(wrong(&node, "at most one parent, and no cycle", "a second path to it"));
        }
        let local = local(&node).ok_or_else(|| wrong(&node, "a rotation of length 1", "a rotation of length 0"))?;
        let to_scene = parent * local;
        if let Some(mesh) = node.mesh() {
            let weights = node.weights().or(mesh.weights()).unwrap_or_default();
            if node.skin().is_some() {
                return Err(wrong(&node, "a mesh without a skin", "a skin; export the pose as triangles"));
            }
            if weights.iter().any(|&weight| weight != 0.0) {
                return Err(wrong(&node, "morph targets of weight 0", "other weights; export the shape as triangles"));
            }
            found.push(Instance { mesh, to_scene });
        }
        let children: Vec<Node<'_>> = node.children().collect();
        open.extend(children.into_iter().rev().map(|child| (child, to_scene)));
    }
    Ok(found)
}

fn roots(document: &Document) -> Vec<Node<'_>> {
    if let Some(scene) = document.default_scene().or_else(|| document.scenes().next()) {
        return scene.nodes().collect();
    }
    let mut child = vec![false; document.nodes().len()];
    document.nodes().for_each(|node| node.children().for_each(|one| child[one.index()] = true));
    document.nodes().filter(|node| !child[node.index()]).collect()
}

/// A node's own transform; `None` if its rotation has no length.
fn local(node: &Node<'_>) -> Option<DMat4> {
    Some(match node.transform() {
        Transform::Matrix { matrix } => DMat4::from_cols_array_2d(&matrix.map(|column| column.map(f64::from))),
        Transform::Decomposed { translation, rotation, scale } => {
            let [scale, translation] = [scale, translation].map(|v| DVec3::from_array(v.map(f64::from)));
            let rotation = DVec4::from_array(rotation.map(f64::from));
            // Stored in single precision, the quaternion is only approximately of length 1.
            let rotation = DQuat::from_vec4(rotation.try_normalize()?);
            DMat4::from_scale_rotation_translation(scale, rotation, translation)
        }
    })
}

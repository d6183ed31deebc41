use crossbar_base::geom::Mesh;
use crossbar_ground::scene::{Material, Scene};

#[test]
fn lists_that_do_not_fit_are_refused() {
    let mesh = Mesh::new(vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], vec![[0, 1, 2]]).expect("a triangle");
    let white = vec![Material::diffuse("white", [0.5; 3])];
    let scene = |material_of, normals| Scene::new(mesh.clone(), white.clone(), material_of, normals);
    assert!(scene(vec![0], Vec::new()).is_ok());
    let error = |material_of| scene(material_of, Vec::new()).expect_err("refused").to_string();
    assert_eq!(error(vec![0, 0]), "expected 1 materials, one per triangle, found 2");
    assert_eq!(error(vec![1]), "triangle 0 has material 1, expected one below 1 (counted from 0)");
    assert!(scene(vec![0], vec![[[0.0; 3]; 3]; 2]).is_err());
}

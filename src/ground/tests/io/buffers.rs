use std::path::Path;

use crossbar_ground::io::parse_gltf;

/// Buffers are read only from files in the model's folder.
#[test]
fn uris_stay_within_the_folder() {
    let read = |uri: &str| {
        let text = format!(r#"{{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":1,"uri":"{uri}"}}]}}"#);
        let mut asked = None;
        let scene = parse_gltf(text.as_bytes(), Path::new("m.gltf"), &mut |file| {
            asked = Some(file.to_owned());
            Ok(vec![0])
        });
        (asked, scene.expect_err("no triangle").to_string())
    };
    for (inside, file) in
        [("a.bin", "a.bin"), ("./a.bin", "./a.bin"), ("parts/a%20b.bin", "parts/a b.bin"), ("..a", "..a")]
    {
        let (asked, error) = read(inside);
        assert_eq!(asked.as_deref(), Some(Path::new(file)), "{inside}");
        assert!(error.contains("expected at least one triangle"), "{error}");
    }
    for outside in [
        "",
        "../a.bin",
        "parts/../../a.bin",
        "/etc/hosts",
        "%2e%2e/a.bin",
        "%2Fetc/hosts",
        "file:///a",
        "c:a",
        r"..\\a",
        "a%00",
    ] {
        let (asked, error) = read(outside);
        assert_eq!(asked, None, "{outside}");
        assert!(error.contains("expected a file in the folder of the model"), "{error}");
    }
}

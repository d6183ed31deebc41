//! Tests that the page of `crossbar page` is self-contained. `tests/page` opens it in Chromium.

use serde_json::Value;

use crate::crossbar_in;

#[test]
fn the_page_stands_alone() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let ran = crossbar_in(folder.path(), &["page", "--out", "written"], "");
    assert_eq!((ran.code, ran.stderr.as_str()), (Some(0), ""));
    let path = folder.path().join("written/index.html");
    let page = std::fs::read_to_string(&path).expect("the page");
    assert!(page.len() < 5_000_000, "{} bytes", page.len());
    assert_eq!(ran.stdout, format!("wrote written/index.html ({} bytes)\n", page.len()));
    for address in ["http:", "https:", "//cdn", "@import", "url("] {
        assert!(!page.contains(address), "{address}");
    }
    let sources: Vec<&str> = page.split("src=\"").skip(1).collect();
    assert_eq!(sources.len(), 6, "stored pictures");
    assert!(sources.iter().all(|source| source.starts_with("data:image/png;base64,")));
    assert_eq!(page.matches("<script").count(), 2, "the data and the script");
    assert_eq!(page.matches("</script>").count(), 2);

    let data = page.split_once("type=\"application/json\">").and_then(|(_, rest)| rest.split_once("</script>"));
    let data: Value = serde_json::from_str(data.expect("data").0).expect("JSON");
    assert_eq!(data["version"], env!("CARGO_PKG_VERSION"));
    let cells = data["arithmetic"]["expected"].as_array().expect("a table");
    assert!(cells.len() == 17 && cells.iter().all(|row| row.as_array().is_some_and(|row| row.len() == 8)));
    // s3.12 leaks and fp24 does not, so the pictures of the formats differ.
    let digests: Vec<&Value> = ["s3.12", "e5m10", "e7m16"]
        .iter()
        .enumerate()
        .map(|(at, name)| {
            let picture = &data["teapot"]["views"][0]["pictures"][at];
            assert_eq!(picture["format"], *name);
            &picture["digest"]
        })
        .collect();
    assert!(digests[0] != digests[1] && digests[1] != digests[2]);
}

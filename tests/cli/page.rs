//! Tests that the page of `crossbar page` is self-contained. `tests/page` opens it in Chromium.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
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

/// The page's traces equal `run --trace` on its cases.
#[test]
fn stored_traces_are_those_of_the_cases() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let ran = crossbar_in(folder.path(), &["page", "--out", "page"], "");
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let page = std::fs::read_to_string(folder.path().join("page/index.html")).expect("the page");
    let data = page.split_once("type=\"application/json\">").and_then(|(_, rest)| rest.split_once("</script>"));
    let data: Value = serde_json::from_str(data.expect("data").0).expect("JSON");
    let programs = data["programs"]["programs"].as_array().expect("programs");
    assert_eq!(programs.len(), 5);
    let variants = |program: &'_ Value| program["variants"].as_array().cloned().expect("variants");
    for (program, variant) in
        programs.iter().flat_map(|program| variants(program).into_iter().map(move |v| (program, v)))
    {
        let format = variant["named"].as_str().map_or_else(String::new, |format| format!("format = \"{format}\"\n"));
        let [head, rest] = [0, 1].map(|part| program["case"][part].as_str().expect("text"));
        std::fs::write(folder.path().join("case.toml"), format!("{head}{format}{rest}")).expect("a file");
        let ran = crossbar_in(folder.path(), &["run", "case.toml", "--trace", "9,6", "--json"], "");
        assert_eq!(ran.code, Some(0), "{}", ran.stderr);
        let told: Value = serde_json::from_str(&ran.stdout).expect("JSON");
        let pass = &told["trace"]["passes"][0];
        let inputs = pass["inputs"].as_array().expect("inputs").iter();
        let steps = pass["steps"].as_array().expect("steps").iter();
        let written = inputs.chain(steps.flat_map(|step| step["written"].as_array().expect("values")));
        let expected: Vec<[&str; 2]> =
            written.map(|w| ["name", "bits"].map(|key| w[key].as_str().expect("text"))).collect();
        let stored = stored(&variant, 6 * 16 + 9);
        let stored: Vec<[&str; 2]> = stored.iter().map(|pair| pair.each_ref().map(String::as_str)).collect();
        assert_eq!(stored, expected, "{} {}", variant["device"], variant["format"]);
    }
}

/// Names and bits that the page stores for a pixel.
fn stored(variant: &Value, pixel: usize) -> Vec<[String; 2]> {
    let bytes = STANDARD.decode(variant["values"].as_str().expect("values")).expect("base64");
    let mut bytes = bytes.into_iter();
    let mut all = Vec::new();
    for at in 0..=pixel {
        for entry in variant["entries"].as_array().expect("entries") {
            let width = variant["formats"][entry["format"].as_u64().expect("a number") as usize]["width"].as_u64();
            let width = width.expect("a width") as usize;
            for name in entry["names"].as_array().expect("names") {
                let pattern =
                    bytes.by_ref().take(width.div_ceil(8)).zip(0..).map(|(byte, k)| u32::from(byte) << (8 * k));
                let bits = format!("0x{:0digits$x}", pattern.sum::<u32>(), digits = width.div_ceil(4));
                if at == pixel {
                    all.push([name.as_str().expect("a name").to_owned(), bits]);
                }
            }
        }
    }
    all
}

#[test]
fn what_is_no_module_is_refused() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    std::fs::write(folder.path().join("other.txt"), "no module").expect("a file");
    let ran = crossbar_in(folder.path(), &["page", "--emulator", "other.txt", "--out", "page"], "");
    assert_eq!(ran.code, Some(2), "{}", ran.stderr);
    assert!(ran.stderr.contains("expected a WebAssembly module"), "{}", ran.stderr);
    let ran = crossbar_in(folder.path(), &["page", "--emulator", "none.wasm", "--out", "page"], "");
    assert_eq!(ran.code, Some(2), "{}", ran.stderr);
    assert!(!folder.path().join("page/index.html").exists());
}

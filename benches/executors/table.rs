//! The tables of docs/performance.md: criterion's results, and alternating measurements (`devices`).

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::{fs, io};

use crate::devices;

const BEGIN: &str = "<!-- measured: begin -->";
const END: &str = "<!-- measured: end -->";

/// Figures to beat, in millions of elements per second.
const GOALS: [(&str, f64); 8] = [
    ("256 rays x 256 triangles, resident s3.12", 450.0),
    ("256 rays x 256 triangles, resident fp32", 390.0),
    ("256 rays x 256 triangles, resident fp16", 150.0),
    ("256 rays x 256 triangles, resident fp24", 100.0),
    // Draws with uploads have no goal, but are shown for comparison.
    ("256 rays x 256 triangles s3.12", 450.0),
    ("256 rays x 256 triangles fp32", 390.0),
    ("256 rays x 256 triangles fp16", 150.0),
    ("256 rays x 256 triangles fp24", 100.0),
];

/// Elements per second by benchmark and implementation.
type Figures = BTreeMap<String, BTreeMap<String, f64>>;

/// Writes the figures into the document, between its two markers.
pub(crate) fn write() -> io::Result<()> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let target = std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), PathBuf::from);
    let mut figures = Figures::new();
    collect(&target.join("criterion").join("executors"), &mut figures)?;
    let path = root.join("docs/performance.md");
    let text = fs::read_to_string(&path)?;
    let missing = || io::Error::other(format!("{}: expected `{BEGIN}` and `{END}`", path.display()));
    let (before, rest) = text.split_once(BEGIN).ok_or_else(missing)?;
    let (_, after) = rest.split_once(END).ok_or_else(missing)?;
    fs::write(&path, format!("{before}{BEGIN}\n{}{END}{after}", table(&figures)))
}

/// Reads every `new/estimates.json` with the `benchmark.json` in the same folder.
fn collect(folder: &Path, figures: &mut Figures) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.ends_with("new") {
            let read = |name| -> io::Result<serde_json::Value> {
                serde_json::from_str(&fs::read_to_string(path.join(name))?).map_err(io::Error::other)
            };
            let (estimates, benchmark) = (read("estimates.json")?, read("benchmark.json")?);
            let nanoseconds = estimates["median"]["point_estimate"].as_f64();
            let elements = benchmark["throughput"]["Elements"].as_f64();
            if let (Some(time), Some(elements), Some(what), Some(who)) =
                (nanoseconds, elements, benchmark["function_id"].as_str(), benchmark["value_str"].as_str())
            {
                figures.entry(what.to_owned()).or_default().insert(who.to_owned(), elements / time * 1e3);
            }
        } else if path.is_dir() {
            collect(&path, figures)?;
        }
    }
    Ok(())
}

fn table(figures: &Figures) -> String {
    let mut out = String::from(
        "Millions of elements a second: criterion's median.\n\n\
         | | batch | scalar | batch / scalar | to beat | batch / to beat |\n|---|---|---|---|---|---|\n",
    );
    let cell = |value: Option<f64>| value.map_or(String::new(), |v| format!(" {v:.3}"));
    let mut line = |name: &str, who: &BTreeMap<String, f64>| {
        let (batch, scalar) = (who.get("batch").copied(), who.get("scalar").copied());
        let goal = GOALS.iter().find(|(what, _)| *what == name).map(|g| g.1);
        let ratio = |a: Option<f64>, b: Option<f64>| a.zip(b).map_or(String::new(), |(a, b)| format!(" {:.2}", a / b));
        let _: Result<(), std::fmt::Error> = writeln!(
            out,
            "| {name} |{} |{} |{} |{} |{} |",
            cell(batch),
            cell(scalar),
            ratio(batch, scalar),
            goal.map_or(String::new(), |g| format!(" {g}")),
            ratio(batch, goal),
        );
    };
    for (name, who) in figures.iter().filter(|(_, who)| who.contains_key("batch")) {
        line(name, who);
    }
    out.push_str(&devices::table());
    out.push_str("\n| one thread, f32, 256 rays x 256 triangles | tests | batch fp32 / it | batch s3.12 / it |\n|---|---|---|---|\n");
    let batch = |format: &str| {
        figures.get(&format!("256 rays x 256 triangles, resident {format}")).and_then(|who| who.get("batch")).copied()
    };
    for (who, &tests) in figures.values().flatten().filter(|(who, _)| who.starts_with("crate ")) {
        let ratio = |format| batch(format).map_or(String::new(), |b| format!(" {:.2}", b / tests));
        let _: Result<(), std::fmt::Error> =
            writeln!(out, "| {who} | {tests:.1} |{} |{} |", ratio("fp32"), ratio("s3.12"));
    }
    out
}

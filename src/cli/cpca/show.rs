//! `crossbar cpca show`: contents of a `.npz` file of low-frequency transfer.

use std::collections::BTreeMap;
use std::path::PathBuf;

use serde_json::{Value, json};

use crate::cli::words::counted;
use crate::clustering::{AffineSubspace, Clustering};
use crate::report::{Cell, Findings, Table};
use crate::transfer::file::{PrtMeaning, load_prt};

const EXAMPLES: &str = "\
Examples:
  crossbar cpca show docs/examples/step_small.npz
      the header, and the clusters with their spectra
  crossbar cpca show docs/examples/step.npz --json
      the header of uncompressed transfer, as JSON

The file is an archive of NumPy arrays: docs/npz.md lists them.";

const EIGENVALUES: usize = 4;

/// Show the contents of a .npz file: header, clusters with spectra
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Args {
    /// The file
    #[arg(value_name = "FILE.npz")]
    file: PathBuf,
}

pub(super) fn run(args: &Args) -> miette::Result<Findings> {
    let file = load_prt(&args.file, None)?;
    let mut found = Findings::new("Low-frequency transfer");
    let mut say = |what: &str, text: String| found.introduce(format!("{what:9} {text}"));
    let meaning = match &file.meaning {
        PrtMeaning::Numbers { dimension } => {
            say("numbers", format!("{dimension} per point"));
            json!({ "numbers_per_point": dimension })
        }
        PrtMeaning::Transfer { channels, exit_functions, light_order, includes_albedo } => {
            let what = if exit_functions[..] == [0] { "diffuse" } else { "glossy" };
            let functions: Vec<String> = exit_functions.iter().map(u16::to_string).collect();
            say("transfer", format!("{what}, {} x {}", functions.len(), light_order * light_order));
            say("rows", format!("functions {} of exit radiance", functions.join(", ")));
            say("columns", format!("light of order {light_order}"));
            say("channels", channels.to_string());
            say("albedo", if *includes_albedo { "included" } else { "to be multiplied" }.to_owned());
            json!({ "channels": channels, "exit_functions": exit_functions, "light_order": light_order,
                    "includes_albedo": includes_albedo })
        }
    };
    say("points", counted(file.points()));
    let mesh = file.mesh.map(|mesh| {
        say("mesh", mesh.to_string());
        let [vertex_crc, triangle_crc] = [mesh.vertex_crc, mesh.triangle_crc].map(|crc| format!("{crc:08x}"));
        json!({ "vertices": mesh.vertices, "triangles": mesh.triangles, "tangents": mesh.tangents.to_string(),
                "vertex_crc": vertex_crc, "triangle_crc": triangle_crc })
    });
    let parts = [file.transfer.is_some().then_some("transfer"), file.clustering.is_some().then_some("clusters")];
    say("holds", parts.into_iter().flatten().collect::<Vec<_>>().join(" and "));
    // The words of the provenance line, by name.
    let made: Option<BTreeMap<&str, &str>> = file.provenance.as_deref().map(|line| {
        say("made", line.to_owned());
        line.split(' ').map(|word| word.split_once('=').unwrap_or((word, "yes"))).collect()
    });
    let clusters = file.clustering.as_ref().map(|clustering| {
        let (stored, numbers) = (clustering.stored_numbers(), clustering.points() * clustering.dimension());
        say("stored", format!("{} numbers in place of {}", counted(stored), counted(numbers)));
        let cluster = |(subspace, points): (&AffineSubspace, usize)| {
            json!({ "points": points, "vectors": subspace.len(), "eigenvalues": subspace.eigenvalues })
        };
        let clusters: Vec<Value> = clustering.subspaces().iter().zip(sizes(clustering)).map(cluster).collect();
        json!({ "stored_numbers": stored, "clusters": clusters })
    });
    found.fields(json!({
        "meaning": meaning, "points": file.points(), "mesh": mesh, "has_transfer": file.transfer.is_some(),
        "clusters": clusters, "made": made,
    }));
    file.clustering.iter().for_each(|clustering| found.table(spectra(clustering)));
    Ok(found)
}

fn spectra(clustering: &Clustering) -> Table {
    let mut headings = vec!["cluster".to_owned(), "points".to_owned(), "vectors".to_owned()];
    headings.extend((1..=EIGENVALUES).map(|number| format!("eigenvalue {number}")));
    let clusters = clustering.subspaces().iter().enumerate().zip(sizes(clustering));
    Table::new("Clusters", &headings).with(clusters.map(|((cluster, subspace), points)| {
        let eigenvalues = subspace.eigenvalues.iter().take(EIGENVALUES).map(|&value| Cell::measured(value));
        [Cell::from(cluster), points.into(), subspace.len().into()].into_iter().chain(eigenvalues)
    }))
}

/// Number of points of each cluster.
fn sizes(clustering: &Clustering) -> Vec<usize> {
    let mut sizes = vec![0; clustering.subspaces().len()];
    clustering.of_point().iter().for_each(|&cluster| sizes[cluster as usize] += 1);
    sizes
}

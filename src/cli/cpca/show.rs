//! `crossbar cpca show`: contents of a `.npz` file of low-frequency transfer.

use std::collections::BTreeMap;
use std::path::PathBuf;

use serde_json::{Value, json};

use crate::cli::words::counted;
use crate::clustering::{AffineSubspace, Clustering};
use crate::report::{Cell, Findings, Table};
use crate::transfer::file::{PrtFile, PrtMeaning, load_prt};

const EXAMPLES: &str = "\
Examples:
  crossbar cpca show docs/examples/step_small.npz
      the header, and the clusters with their spectra
  crossbar cpca show docs/examples/step.npz --json
      the header of uncompressed transfer, as JSON

The file itself is an archive of NumPy's arrays: docs/npz.md says which.";

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
    found.fields(document(&file));
    all(&file, &mut found);
    Ok(found)
}

fn all(file: &PrtFile, found: &mut Findings) {
    match &file.meaning {
        PrtMeaning::Numbers { dimension } => found.introduce(format!("numbers   {dimension} per point")),
        PrtMeaning::Transfer { channels, exit_functions, light_order, includes_albedo } => {
            let rows = exit_functions.len();
            let what = if exit_functions[..] == [0] { "diffuse" } else { "glossy" };
            let columns = light_order * light_order;
            found.introduce(format!("transfer  {what}, {rows} x {columns}"));
            let functions: Vec<String> = exit_functions.iter().map(u16::to_string).collect();
            found.introduce(format!("rows      functions {} of exit radiance", functions.join(", ")));
            found.introduce(format!("columns   light of order {light_order}"));
            found.introduce(format!("channels  {channels}"));
            found.introduce(format!("albedo    {}", if *includes_albedo { "included" } else { "to be multiplied" }));
        }
    }
    found.introduce(format!("points    {}", counted(file.points())));
    if let Some(mesh) = file.mesh {
        found.introduce(format!("mesh      {mesh}"));
    }
    let parts = [file.transfer.is_some().then_some("transfer"), file.clustering.is_some().then_some("clusters")];
    found.introduce(format!("holds     {}", parts.into_iter().flatten().collect::<Vec<_>>().join(" and ")));
    let Some(clustering) = &file.clustering else { return };
    if let Some(line) = &file.provenance {
        found.introduce(format!("made      {line}"));
    }
    let [stored, numbers] = [clustering.stored_numbers(), clustering.points() * clustering.dimension()].map(counted);
    found.introduce(format!("stored    {stored} numbers in place of {numbers}"));
    found.table(spectra(clustering));
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

fn document(file: &PrtFile) -> Value {
    let meaning = match &file.meaning {
        PrtMeaning::Numbers { dimension } => json!({ "numbers_per_point": dimension }),
        PrtMeaning::Transfer { channels, exit_functions, light_order, includes_albedo } => json!({
            "channels": channels, "exit_functions": exit_functions, "light_order": light_order,
            "includes_albedo": includes_albedo,
        }),
    };
    let mesh = file.mesh.map(|mesh| {
        let [vertex_crc, triangle_crc] = [mesh.vertex_crc, mesh.triangle_crc].map(|crc| format!("{crc:08x}"));
        json!({ "vertices": mesh.vertices, "triangles": mesh.triangles, "tangents": mesh.tangents.to_string(),
                "vertex_crc": vertex_crc, "triangle_crc": triangle_crc })
    });
    let clusters = file.clustering.as_ref().map(|clustering| {
        let cluster = |(subspace, points): (&AffineSubspace, usize)| {
            json!({ "points": points, "vectors": subspace.len(), "eigenvalues": subspace.eigenvalues })
        };
        let clusters: Vec<Value> = clustering.subspaces().iter().zip(sizes(clustering)).map(cluster).collect();
        json!({ "stored_numbers": clustering.stored_numbers(), "clusters": clusters })
    });
    // The words of the provenance line, by name.
    let made: Option<BTreeMap<&str, &str>> = (file.provenance.as_deref())
        .map(|line| line.split(' ').map(|word| word.split_once('=').unwrap_or((word, "yes"))).collect());
    json!({ "meaning": meaning, "points": file.points(), "mesh": mesh, "has_transfer": file.transfer.is_some(),
            "clusters": clusters, "made": made })
}

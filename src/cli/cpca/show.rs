//! `crossbar cpca show`: what is in a `.npz` file of low-frequency transfer.

use std::collections::BTreeMap;
use std::path::PathBuf;

use serde_json::{Value, json};

use super::coherence::count;
use crate::cli::transfer::model::chosen_vertex;
use crate::cli::words::{counted, measured};
use crate::clustering::Clustering;
use crate::report::{Cell, Findings, Table};
use crate::transfer::file::{PrtFile, PrtMeaning, load_prt};

const EXAMPLES: &str = "\
Examples:
  crossbar cpca show docs/examples/step_small.npz
      the header, and the clusters with their spectra
  crossbar cpca show docs/examples/step_small.npz --vertex 12
      one vertex: its cluster, its weights, its transfer
  crossbar cpca show docs/examples/step.npz --vertex 12 --json
      the same of uncompressed transfer, for machines

The file itself is an archive of NumPy's arrays: docs/npz.md says which.";

/// Eigenvalues that a table has room for.
const EIGENVALUES: usize = 4;

/// Show what a .npz file holds: header, clusters with spectra, transfer and weights of a vertex
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Args {
    /// The file
    #[arg(value_name = "FILE.npz")]
    file: PathBuf,

    /// A vertex, or another point, counted from 0
    #[arg(long, value_name = "N")]
    vertex: Option<u32>,
}

pub(super) fn run(args: &Args) -> miette::Result<Findings> {
    let file = load_prt(&args.file, None)?;
    let vertex = chosen_vertex("cpca", args.vertex, file.points())?;
    let mut found = Findings::new("Low-frequency transfer");
    found.fields(header_document(&file));
    found.fields(json!({
        "clusters": file.clustering.as_ref().map(clusters_document),
        "superclusters": file.superclusters,
        "made": file.provenance.as_deref().map(made_document),
        "vertex": vertex.map(|vertex| vertex_document(&file, vertex)),
    }));
    match vertex {
        Some(vertex) => one(&file, vertex, &mut found),
        None => all(&file, &mut found),
    }
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
    if let Some(superclusters) = &file.superclusters {
        found.introduce(format!("together  {} superclusters", counted(count(superclusters))));
    }
    let [stored, numbers] = [clustering.stored_numbers(), clustering.points() * clustering.dimension()].map(counted);
    found.introduce(format!("stored    {stored} numbers in place of {numbers}"));
    found.table(spectra(clustering, file.superclusters.as_deref()));
}

/// Clusters with their sizes and largest eigenvalues.
fn spectra(clustering: &Clustering, superclusters: Option<&[u32]>) -> Table {
    let mut headings = vec!["cluster".to_owned(), "points".to_owned(), "vectors".to_owned()];
    headings.extend(superclusters.map(|_| "supercluster".to_owned()));
    headings.extend((1..=EIGENVALUES).map(|number| format!("eigenvalue {number}")));
    let mut table = Table::new("Clusters", &headings);
    for ((cluster, subspace), points) in clustering.subspaces().iter().enumerate().zip(sizes(clustering)) {
        let eigenvalue = |at: usize| subspace.eigenvalues.get(at).map_or(Cell::Empty, |&value| Cell::measured(value));
        let mut row: Vec<Cell> = vec![cluster.into(), points.into(), subspace.len().into()];
        row.extend(superclusters.map(|of| (of[cluster] as usize).into()));
        row.extend((0..EIGENVALUES).map(eigenvalue));
        table.push(row);
    }
    table
}

/// Points of each cluster.
fn sizes(clustering: &Clustering) -> Vec<usize> {
    let mut sizes = vec![0; clustering.subspaces().len()];
    clustering.of_point().iter().for_each(|&cluster| sizes[cluster as usize] += 1);
    sizes
}

fn one(file: &PrtFile, vertex: usize, found: &mut Findings) {
    found.introduce(format!("point     {vertex}"));
    let approximation = file.clustering.as_ref().map(|clustering| approximation(clustering, vertex));
    if let Some(clustering) = &file.clustering {
        let weights: Vec<String> = clustering.weights(vertex).iter().map(|weight| measured(*weight)).collect();
        found.introduce(format!("cluster   {}", clustering.of_point()[vertex]));
        let weights = if weights.is_empty() { "none".to_owned() } else { weights.join(", ") };
        found.introduce(format!("weights   {weights}"));
    }
    let original: Option<Vec<f64>> =
        file.transfer.as_ref().map(|signal| signal.point(vertex).iter().map(|&value| f64::from(value)).collect());
    for (title, values) in [("Transfer", original), ("Approximation", approximation)] {
        if let Some(values) = values {
            found.table(matrix(title, &file.meaning, &values));
        }
    }
}

fn approximation(clustering: &Clustering, vertex: usize) -> Vec<f64> {
    let mut values = vec![0.0; clustering.dimension()];
    clustering.approximation(vertex, &mut values);
    values
}

/// A line per number: the columns of a matrix would not fit.
fn matrix(title: &str, meaning: &PrtMeaning, values: &[f64]) -> Table {
    let PrtMeaning::Transfer { exit_functions, light_order, .. } = meaning else {
        let mut table = Table::new(title, &["number", "value"]);
        values.iter().enumerate().for_each(|(at, &value)| table.push([at.into(), Cell::measured(value)]));
        return table;
    };
    let (rows, columns) = (exit_functions.len(), (light_order * light_order) as usize);
    let mut table = Table::new(title, &["channel", "row", "column", "value"]);
    for (at, &value) in values.iter().enumerate() {
        let (row, column) = (at / columns, at % columns);
        let function = usize::from(exit_functions[row % rows]);
        table.push([(row / rows).into(), function.into(), column.into(), Cell::measured(value)]);
    }
    table
}

fn header_document(file: &PrtFile) -> Value {
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
    json!({ "meaning": meaning, "points": file.points(), "mesh": mesh, "has_transfer": file.transfer.is_some() })
}

/// The words of a line of provenance, by name.
fn made_document(line: &str) -> BTreeMap<&str, &str> {
    line.split(' ').map(|word| word.split_once('=').unwrap_or((word, "yes"))).collect()
}

fn clusters_document(clustering: &Clustering) -> Value {
    let clusters = clustering.subspaces().iter().zip(sizes(clustering));
    let clusters: Vec<Value> = clusters
        .map(|(subspace, points)| {
            json!({ "points": points, "vectors": subspace.len(), "eigenvalues": subspace.eigenvalues })
        })
        .collect();
    json!({ "stored_numbers": clustering.stored_numbers(), "clusters": clusters })
}

fn vertex_document(file: &PrtFile, vertex: usize) -> Value {
    let clustered = file.clustering.as_ref().map(|clustering| {
        json!({ "cluster": clustering.of_point()[vertex], "weights": clustering.weights(vertex),
                "approximation": approximation(clustering, vertex) })
    });
    let transfer = file.transfer.as_ref().map(|signal| signal.point(vertex));
    json!({ "number": vertex, "transfer": transfer, "clustered": clustered })
}

//! `crossbar cpca show`: what is in a `.prt` file of low-frequency transfer.

use std::collections::BTreeMap;
use std::path::PathBuf;

use serde_json::{Value, json};

use super::arrays;
use super::coherence::count;
use super::file::model_of;
use crate::cli::transfer::model::nearest;
use crate::cli::transfer::vertex_names::VertexNames;
use crate::cli::words::{counted, measured};
use crate::cli::{Out, Problem, number, view};
use crate::report::{Cell, Table};
use crate::transfer::clustering::Clustering;
use crate::transfer::file::{PrtFile, PrtMeaning, load_prt};

const EXAMPLES: &str = "\
Examples:
  crossbar cpca show docs/examples/step_small.prt
      the header, and the clusters with their spectra
  crossbar cpca show docs/examples/step_small.prt --vertex 12
      one vertex: its cluster, its weights, its transfer
  crossbar cpca show docs/examples/step.prt --at 0.5,0,0 --model docs/examples/step.obj --json
      the vertex nearest to a place of its model, for machines
  crossbar cpca show docs/examples/step_small.prt --arrays arrays
      transfer, means, vectors, weights and clusters as arrays of NumPy's

`crossbar cpca render --values csv` writes the radiance of all vertices under a light.";

/// Eigenvalues that a table has room for.
const EIGENVALUES: usize = 4;

/// Show what a .prt file holds: header, clusters with spectra, transfer and weights of a vertex
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Args {
    /// The file
    #[arg(value_name = "FILE.prt")]
    file: PathBuf,

    /// A vertex, or another point, counted from 0
    #[arg(long, value_name = "N", group = "which")]
    vertex: Option<u32>,

    /// The vertex nearest to this place of the model
    #[arg(long, value_name = "X,Y,Z", value_parser = number::point, requires = "model", group = "which",
          allow_hyphen_values = true)]
    at: Option<[f32; 3]>,

    /// The model that the file was made from: it says where the vertex is, and its number in the model's file
    #[arg(long, value_name = "MODEL", requires = "which")]
    model: Option<PathBuf>,

    /// Write what the file holds to this folder as arrays of NumPy's: transfer.npy with a row per point, and of
    /// clusters means.npy, vectors.npy (each with its cluster's number in front), weights.npy and clusters.npy
    #[arg(long, value_name = "DIR")]
    arrays: Option<PathBuf>,
}

pub(super) fn run(args: &Args, out: &mut Out) -> miette::Result<()> {
    view::require_file(&args.file, 3, "name a smaller file")?;
    let file = load_prt(&args.file, None)?;
    let of_model = args.model.as_ref().map(|model| model_of(&args.file, file.mesh, model)).transpose()?;
    let vertices = of_model.as_ref().map(|(_, vertices, _)| vertices);
    let nearest = || nearest(vertices?.positions(), args.at?);
    let vertex = args.vertex.map(|vertex| vertex as usize).or_else(nearest);
    if let Some(vertex) = vertex.filter(|&vertex| vertex >= file.points()) {
        let what = format!("expected a vertex below {} (counted from 0), found {vertex}", file.points());
        return Err(Problem::usage(what, "`crossbar cpca show` says how many there are").into());
    }
    let names = args.model.as_ref().zip(vertices).map(|(model, vertices)| VertexNames::new(model, vertices));
    let written = args.arrays.as_deref().map(|folder| arrays::write(&file, folder)).transpose()?;
    if out.json() {
        let mut document = header_document(&file);
        document["arrays"] = json!(written);
        document["clusters"] = json!(file.clustering.as_ref().map(clusters_document));
        document["superclusters"] = json!(file.superclusters);
        document["made"] = json!(file.provenance.as_deref().map(made_document));
        document["vertex"] = json!(vertex.map(|vertex| vertex_document(&file, vertex, names.as_ref())));
        return Ok(out.document(&document)?);
    }
    match vertex {
        Some(vertex) => one(&file, vertex, names.as_ref(), out)?,
        None => all(&file, out)?,
    }
    if let (Some(written), Some(folder)) = (written, &args.arrays) {
        out.line(format_args!("written   {} arrays in {}", written.len(), folder.display()))?;
    }
    Ok(())
}

fn all(file: &PrtFile, out: &mut Out) -> miette::Result<()> {
    match &file.meaning {
        PrtMeaning::Numbers { dimension } => out.line(format_args!("numbers   {dimension} per point"))?,
        PrtMeaning::Transfer { channels, exit_functions, light_order, includes_albedo } => {
            let rows = exit_functions.len();
            let what = if exit_functions[..] == [0] { "diffuse" } else { "glossy" };
            let columns = light_order * light_order;
            out.line(format_args!("transfer  {what}, {rows} x {columns}"))?;
            let functions: Vec<String> = exit_functions.iter().map(u16::to_string).collect();
            out.sentence(format_args!("rows      functions {} of exit radiance", functions.join(", ")))?;
            out.line(format_args!("columns   light of order {light_order}"))?;
            out.line(format_args!("channels  {channels}"))?;
            out.line(format_args!("albedo    {}", if *includes_albedo { "included" } else { "to be multiplied" }))?;
        }
    }
    out.line(format_args!("points    {}", counted(file.points())))?;
    if let Some(mesh) = file.mesh {
        out.line(format_args!("mesh      {mesh}"))?;
    }
    let parts = [file.transfer.is_some().then_some("transfer"), file.clustering.is_some().then_some("clusters")];
    out.line(format_args!("holds     {}", parts.into_iter().flatten().collect::<Vec<_>>().join(" and ")))?;
    let Some(clustering) = &file.clustering else { return Ok(()) };
    if let Some(line) = &file.provenance {
        out.sentence(format_args!("made      {line}"))?;
    }
    if let Some(superclusters) = &file.superclusters {
        out.line(format_args!("together  {} superclusters", counted(count(superclusters))))?;
    }
    let numbers = clustering.points() * clustering.dimension();
    out.line(format_args!(
        "stored    {} numbers in place of {}",
        counted(clustering.stored_numbers()),
        counted(numbers)
    ))?;
    out.line("")?;
    let mut headings = vec!["cluster".to_owned(), "points".to_owned(), "vectors".to_owned()];
    headings.extend(file.superclusters.as_ref().map(|_| "supercluster".to_owned()));
    headings.extend((1..=EIGENVALUES).map(|number| format!("eigenvalue {number}")));
    let mut table = Table::new("Clusters", &headings);
    for ((cluster, subspace), points) in clustering.subspaces().iter().enumerate().zip(sizes(clustering)) {
        let eigenvalue = |at: usize| subspace.eigenvalues.get(at).map_or(Cell::Empty, |&value| Cell::measured(value));
        let mut row: Vec<Cell> = vec![cluster.into(), points.into(), subspace.len().into()];
        row.extend(file.superclusters.as_ref().map(|of| (of[cluster] as usize).into()));
        row.extend((0..EIGENVALUES).map(eigenvalue));
        table.push(row);
    }
    out.table(&table)?;
    Ok(())
}

/// Points of each cluster.
fn sizes(clustering: &Clustering) -> Vec<usize> {
    let mut sizes = vec![0; clustering.subspaces().len()];
    clustering.of_point().iter().for_each(|&cluster| sizes[cluster as usize] += 1);
    sizes
}

fn one(file: &PrtFile, vertex: usize, names: Option<&VertexNames<'_>>, out: &mut Out) -> miette::Result<()> {
    out.line(format_args!("point     {vertex}"))?;
    if let Some(names) = names {
        out.line(format_args!("is        {}", names.phrase(vertex)))?;
    }
    let approximation = file.clustering.as_ref().map(|clustering| approximation(clustering, vertex));
    if let Some(clustering) = &file.clustering {
        let weights: Vec<String> = clustering.weights(vertex).iter().map(|weight| measured(*weight)).collect();
        out.line(format_args!("cluster   {}", clustering.of_point()[vertex]))?;
        out.sentence(format_args!(
            "weights   {}",
            if weights.is_empty() { "none".to_owned() } else { weights.join(", ") }
        ))?;
    }
    let original: Option<Vec<f64>> =
        file.transfer.as_ref().map(|signal| signal.point(vertex).iter().map(|&value| f64::from(value)).collect());
    for (title, values) in [("Transfer", original), ("Approximation", approximation)] {
        let Some(values) = values else { continue };
        out.line("")?;
        out.titled_table(&matrix(title, &file.meaning, &values))?;
    }
    Ok(())
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

fn vertex_document(file: &PrtFile, vertex: usize, names: Option<&VertexNames<'_>>) -> Value {
    let clustered = file.clustering.as_ref().map(|clustering| {
        json!({ "cluster": clustering.of_point()[vertex], "weights": clustering.weights(vertex),
                "approximation": approximation(clustering, vertex) })
    });
    let transfer = file.transfer.as_ref().map(|signal| signal.point(vertex));
    let of_model = names.map(|names| names.document(vertex));
    json!({ "number": vertex, "of_model": of_model, "transfer": transfer, "clustered": clustered })
}

//! The contents of a file of all-frequency transfer as NumPy arrays.

use std::io;
use std::path::{Path, PathBuf};

use crate::all_frequency::Reflectance;
use crate::all_frequency::code::CodedSegment;
use crate::all_frequency::file::AllFrequencyFile;
use crate::cli::Problem;
use crate::io::atomic::FileSet;
use crate::io::{NumberTable, write_npy};
use crate::transfer::grid::FINE_DIRECTIONS;

/// Writes them into a folder, whole or not at all: factors, and each segment's representatives, weights, and vertices
/// with their clusters; of a vertex what it sees and its decoded transfer.
pub(super) fn write(file: &AllFrequencyFile, vertex: Option<usize>, folder: &Path) -> Result<Vec<PathBuf>, Problem> {
    let mut set = FileSet::new(folder)?;
    let mut put = |name: String, columns: usize, values: &mut dyn Iterator<Item = f32>| {
        let table = NumberTable { columns, values: values.collect() };
        set.write(Path::new(&name), |out: &mut dyn io::Write| write_npy(&table, out))
    };
    if let Reflectance::Factored(factors) = &file.reflectance {
        let [view, light] = factors.values();
        for (name, values) in [("view_factors", view), ("light_factors", light)] {
            put(format!("{name}.npy"), factors.terms(), &mut values.iter().map(|&value| value as f32))?;
        }
    }
    for part in file.coded.iter().flat_map(|coded| &coded.segments) {
        segment(part, &mut put)?;
    }
    if let Some(vertex) = vertex {
        if let Some(maps) = &file.visibility {
            let bit = |fine| if maps.is_visible(vertex, fine) { 1.0 } else { 0.0 };
            put(format!("vertex_{vertex}_visibility.npy"), 128, &mut (0..FINE_DIRECTIONS).map(bit))?;
        }
        if let Some(coded) = &file.coded {
            // Rows of 24 segments of Haar coefficients, 0 where there is no transfer.
            let mut matrix = vec![0.0_f32; coded.rows * 24 * coded.coefficients];
            for part in &coded.segments {
                let Ok(at) = part.vertices.binary_search(&(vertex as u32)) else { continue };
                for (row, values) in part.decoded(at).chunks_exact(coded.coefficients).enumerate() {
                    let begin = (row * 24 + part.segment) * coded.coefficients;
                    let into = &mut matrix[begin..][..coded.coefficients];
                    into.iter_mut().zip(values).for_each(|(into, &value)| *into = value as f32);
                }
            }
            put(format!("vertex_{vertex}_transfer.npy"), 24 * coded.coefficients, &mut matrix.into_iter())?;
        }
    }
    Ok(set.commit()?)
}

/// Writes numbers as an array with a name, in rows of so many.
type Put<'a, E> = dyn FnMut(String, usize, &mut dyn Iterator<Item = f32>) -> Result<(), E> + 'a;

fn segment<E>(part: &CodedSegment, put: &mut Put<'_, E>) -> Result<(), E> {
    let (name, columns) = (format!("segment_{:02}", part.segment), part.representatives.columns());
    let codes = part.representatives.decode();
    let rows = codes.chunks_exact(columns).zip(&part.representative_steps);
    let mut values = rows.flat_map(|(row, &step)| row.iter().map(move |&code| f32::from(code) * step));
    put(format!("{name}_representatives.npy"), columns, &mut values)?;
    let most = part.counts.iter().map(|&count| usize::from(count)).max().unwrap_or(0).max(1);
    // Vertices of clusters with fewer representatives have zeros behind their weights.
    let mut weights = part.decoded_weights().flat_map(|mut weights| {
        weights.resize(most, 0.0);
        weights.into_iter().map(|weight| weight as f32)
    });
    put(format!("{name}_weights.npy"), most, &mut weights)?;
    let pairs = part.vertices.iter().zip(&part.cluster_of);
    let mut pairs = pairs.flat_map(|(&vertex, &cluster)| [vertex as f32, f32::from(cluster)]);
    put(format!("{name}_clusters.npy"), 2, &mut pairs)
}

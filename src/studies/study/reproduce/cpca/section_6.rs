//! Sections 4.1, 6 and 6.2: numbers, registers and host work, which follow from sizes.

use super::signals::SIGNALS;
use super::{EntryFindings, REGISTERS, Shared, StudyError, number, paragraph};
use crate::cpca::on_card::model::TransferSize;
use crate::report::{Cell, Table};

const HOW: &str = "Nothing is run: sizes follow from printed ones by the formulas of sections 4.1 and 6.2. A register \
    holds {} numbers, and each vector takes whole registers, while the paper divides. Per frame, the host multiplies \
    every mean and vector by the light of three channels; without compression, every vertex's matrix.";

pub(in crate::study::reproduce) fn findings(_: &Shared) -> Result<EntryFindings, StudyError> {
    Ok(EntryFindings::new([paragraph(HOW, [number(4.0, 0)])], [], [], [sizes()]))
}

/// Table of the sizes of Table 1's signals, and of the encodings of Figures 10 and 11 that Table 1 lacks.
fn sizes() -> Table {
    let mut table = Table::of(
        "Printed sizes, and derived quantities",
        "signal clusters vectors raw_M stored_M ratio registers_per_cluster clusters_per_batch batches \
         uploaded_registers host_M uncompressed_M less_host_work",
    );
    let bird = SIGNALS[super::signals::BIRD].size;
    let others = [(256, 2), (256, 4), (256, 12), (1792, 0), (1, 20)]
        .map(|(clusters, vectors)| ("bird gloss-anis", TransferSize { clusters, vectors, ..bird }));
    for (name, size) in SIGNALS[..7].iter().map(|paper| (paper.name, paper.size)).chain(others) {
        let [raw, stored, host, uncompressed] =
            [size.raw_numbers(), size.stored_numbers(), size.host_multiply_adds(), size.uncompressed_multiply_adds()]
                .map(|count| count as f64);
        table.push([
            name.into(),
            size.clusters.into(),
            size.vectors.into(),
            Cell::decimals(raw / 1e6, 2),
            Cell::decimals(stored / 1e6, 3),
            Cell::decimals(raw / stored, 1),
            size.registers_per_cluster().into(),
            size.clusters_per_batch(REGISTERS).into(),
            size.batches(REGISTERS).into(),
            size.uploaded_registers().into(),
            Cell::decimals(host / 1e6, 3),
            Cell::decimals(uncompressed / 1e6, 2),
            Cell::decimals(uncompressed / host, 1),
        ]);
    }
    table
}

//! The tables of the study.

use super::picture::ChunkCounts;
use crate::card::frame_time::FrameTime;
use crate::cpca::on_card::model::TransferSize;
use crate::report::Cell;
use crate::study::prt::card::frame;

pub(super) const TIME: &str = "Modelled, not measured: the pipeline model of the card, and a host whose speed follows \
    from the paper's 2.9 frames per second of uncompressed transfer. Host and card work in parallel, frame after \
    frame.";

/// Sizes and counts: the columns of the paper's Table 1, and the counts that section 6.2 derives from them.
pub(super) fn sizes(size: &TransferSize, draws: &ChunkCounts) -> impl Iterator<Item = (&'static str, Cell)> {
    let overdraw = draws.drawn as f64 / draws.triangles.max(1) as f64;
    let rows = [
        ("vertices", size.vertices as u64),
        ("clusters", size.clusters as u64),
        ("vectors of a cluster", size.vectors as u64),
        ("numbers uncompressed", size.raw_numbers() as u64),
        ("numbers stored", size.stored_numbers() as u64),
        ("constants of a cluster", size.registers_per_cluster() as u64),
        ("superclusters", draws.superclusters as u64),
        ("passes over each", size.passes() as u64),
        ("constants sent for a frame", size.uploaded_registers() as u64),
        ("host multiply-adds of a frame", size.host_multiply_adds() as u64),
        ("triangles", draws.triangles as u64),
        ("triangles drawn in a pass", draws.drawn),
    ];
    rows.into_iter().map(|(what, number)| (what, number.into())).chain([("overdraw", Cell::ratio(overdraw))])
}

/// Sentence about the rate, its bottleneck, and the drawn data.
pub(super) fn time_sentence(time: &FrameTime, card: &str) -> String {
    let rate = frame::rate(time, card);
    format!(
        "{rate}; {} vertices are run and {} triangles set up in {} draws.",
        time.vertices_run, time.triangles, time.calls
    )
}

//! Figure 8: glossy Phong models, compressed and not, and the speed-up of drawing.

use refsim::device::Profile;

use super::drawn::DrawnClusters;
use super::figure_3::EYE;
use super::mesh_cost::CARD;
use super::rates::{OWN_INPUTS, modelled_from_clusters, ratio_row, uncompressed};
use super::shared::iterative;
use super::signals::{GLOSSY_BUDDHA, HEAD, SIGNALS};
use super::views::{ModelView, RED_AND_BLUE, RIM};
use super::{
    EntryFindings, Method, PaperRow, Prose, Setting, Shared, Standing, StudyError, Sweep, number, paper_row, printed,
    printed_value,
};
use crate::cpca::on_card::model::TransferSize;
use crate::report::{Cell, PictureGrid, Table};
use crate::sphere::HarmonicLight;

/// Signal, its name, the same in the names of its figures, and the figure of its frames per second in Table 1.
const MODELS: [(usize, &str, &str, &str); 2] = [
    (HEAD, "head", "head", "cpca/rate-head-gloss-iso"),
    (GLOSSY_BUDDHA, "Buddha", "buddha", "cpca/rate-buddha-gloss-iso"),
];
/// Rows of an uncompressed matrix in section 7.
const ROWS: [usize; 2] = [25, 16];
/// "A Radeon 9800 runs 20% faster with CPCA".
const NEWER: &str = "r350";
/// Pairs of cards by the clocks of core and memory in MHz. The profiles are of the Pro cards; the text does not name
/// the model. The clocks of the others are from manufacturers' tables ("AMD ATI Chips Comparison Table": 275 and 540
/// MHz, 325 and 580 MHz, data on both edges).
const CLOCKS: [(&str, [[u64; 2]; 2]); 3] = [
    ("both Pro", [[325, 310], [380, 340]]),
    ("neither Pro", [[275, 270], [325, 290]]),
    ("the newer Pro", [[275, 270], [380, 340]]),
];

const HOW: &str = "Phong models, {} rows, {} clusters of {} vectors. Errors are those of pictures: root mean square over that of the picture without \
    compression. Frames are timed on the {} from printed sizes and the overdraw of our own clusters with both optimisations of section 5.";
const NEWER_CARD: &str = "\"Runs {} % faster\" stands in the paragraph on these models, so it is judged on them. Which cards are meant is unsaid, so the clocks of \
    core and memory are swept. The host is the same: where it is the slower of the two, a faster card gains nothing.";
const QUESTION: &str = "which models of the two Radeons were compared, and with what processor: from Pro to Pro the core's clock rises by less than is printed.";

pub(in crate::study::reproduce) fn findings(shared: &Shared) -> Result<EntryFindings, StudyError> {
    let light = HarmonicLight::red_and_blue(5);
    let mut table = Table::of(
        "Compressed and uncompressed",
        "model error_of_picture_% silhouettes_% overdraw Hz_printed Hz host_ms constants_ms draws_ms",
    );
    let (mut rows, mut gains, mut shown_light) = (Vec::new(), Vec::new(), None);
    let mut grid = PictureGrid::new("Figure 8", ["compressed", "uncompressed"]);
    let mut plain_gains = Vec::new();
    for (at, name, id, rate) in MODELS {
        let (computed, clustering) = iterative(shared, at)?;
        let drawn = shared.get::<DrawnClusters>(at)?;
        let view = ModelView::new(computed, &light, EYE)?;
        shown_light = Some(view.light("cpca-figure-8", RED_AND_BLUE)?);
        let plain = view.colors(None)?;
        let errors = [
            view.difference(Some(clustering), &plain, |_| true)?,
            view.difference(Some(clustering), &plain, |cosine| cosine < RIM)?,
        ];
        let (model, size) = (computed.paper.model, computed.paper.size);
        let on = |card: &Profile| modelled_from_clusters(card, shared, (model, size), drawn);
        let time = on(&Profile::named(CARD)?)?;
        let cells = [
            Cell::percent(100.0 * errors[0]),
            Cell::percent(100.0 * errors[1]),
            Cell::decimals(drawn.overdraw[3], 3),
            printed(rate)?.cell(),
            Cell::measured(time.per_second()),
            Cell::measured(1e3 * time.host.seconds()),
            Cell::measured(1e3 * time.state.seconds()),
            Cell::measured(1e3 * time.draws.seconds()),
        ];
        table.push([Cell::from(name)].into_iter().chain(cells));
        rows.extend(without_compression(id, size)?);
        let faster = time.per_second() / uncompressed(of_rows(size, 25))?;
        rows.push(ratio_row(&format!("faster-{id}"), ((&time).into(), faster), OWN_INPUTS)?);
        // Without compression the host's products and the card's drawing overlap, as they do with it.
        let host = 1.0 / uncompressed(of_rows(size, 25))?;
        let plain = |card: Result<Profile, StudyError>| -> Result<f64, StudyError> {
            Ok(1.0 / host.max(on(&card?)?.draws.seconds()))
        };
        let [[old, new], ..] = CLOCKS.map(|(_, clocks)| [clocked(CARD, clocks[0]), clocked(NEWER, clocks[1])]);
        plain_gains.push(100.0 * (plain(new)? / plain(old)? - 1.0));
        let mut gain_by_clocks = Vec::new();
        for (_, clocks) in CLOCKS {
            let [old, new] = [(CARD, clocks[0]), (NEWER, clocks[1])].map(|(card, clocks)| clocked(card, clocks));
            gain_by_clocks.push(100.0 * (on(&new?)?.per_second() / on(&old?)?.per_second() - 1.0));
        }
        gains.push(gain_by_clocks);
        let mut pictures = Vec::new();
        for (clustering, how) in [(Some(clustering), "compressed"), (None, "uncompressed")] {
            pictures.push(view.picture(clustering, format!("cpca-figure-8-{name}-{how}"), format!("{name}, {how}"))?);
        }
        grid = grid.row(name, pictures);
    }
    let grid = grid.row("", shown_light);
    let row = newer_row("newer-card-uncompressed", plain_gains[0])?;
    rows.push(row.with_readings(plain_gains[1..].iter().copied()));
    let (newer, swept) = newer_card(&gains)?;
    rows.push(newer);
    let size = SIGNALS[HEAD].size;
    let sizes = [size.rows, size.clusters, size.vectors].map(|count| number(count as f64, 0));
    Ok(EntryFindings {
        text: vec![
            Prose::new(HOW, sizes.into_iter().chain([CARD.to_owned()])),
            Prose::new(NEWER_CARD, [number(printed_value("cpca/newer-card")?, 0)]),
        ],
        rows,
        questions: vec![QUESTION],
        tables: vec![table, swept],
        pictures: vec![grid],
        ..EntryFindings::default()
    })
}

fn of_rows(size: TransferSize, rows: usize) -> TransferSize {
    TransferSize { rows, ..size }
}

/// Profile of a card with other clocks, in MHz.
fn clocked(card: &str, [core, memory]: [u64; 2]) -> Result<Profile, StudyError> {
    let mut profile = Profile::named(card)?;
    (profile.rates.core_clock_hz, profile.rates.memory_clock_hz) = (Some(core * 1_000_000), Some(memory * 1_000_000));
    Ok(profile)
}

/// Rows on rates without compression, of which one calibrated the host's rate.
fn without_compression(id: &str, size: TransferSize) -> Result<Vec<PaperRow>, StudyError> {
    let mut found = Vec::new();
    for rows in ROWS {
        let rate = (Method::Equation, uncompressed(of_rows(size, rows))?);
        let mut row = ratio_row(&format!("uncompressed-{id}-{rows}"), rate, OWN_INPUTS)?;
        if (id, rows) == ("head", 25) {
            row.standing = Standing::Calibrated { on: OWN_INPUTS };
        }
        found.push(row);
    }
    Ok(found)
}

/// Row on a gain of the newer card. Both frames have the same work, so that the gain is that of the clocks, or none
/// where the host decides.
fn newer_row(id: &str, gain: f64) -> Result<PaperRow, StudyError> {
    let ours = (gain, Standing::Predicted { from: OWN_INPUTS });
    paper_row(&format!("cpca/{id}"), (NEWER, Method::Equation), ours)
}

/// Row on the gain of the newer card by the clocks of the profiles, of both models, and a table of other clocks.
fn newer_card(gains: &[Vec<f64>]) -> Result<(PaperRow, Table), StudyError> {
    let row = newer_row("newer-card", gains[0][0])?;
    let mut rows = [row.with_readings(gains[1..].iter().map(|by_clocks| by_clocks[0]))];
    let target = rows[0].target.value;
    let farthest = |one: &f64, other: &f64| (one - target).abs().total_cmp(&(other - target).abs());
    let setting = |(at, (cards, _)): (usize, &(&str, _))| Setting {
        at: (*cards).to_owned(),
        values: vec![gains.iter().map(|by_clocks| by_clocks[at]).max_by(farthest).unwrap_or(f64::NAN)],
    };
    let settings = CLOCKS.iter().enumerate().map(setting).collect();
    let sweep = Sweep { name: "clocks", parameter: "cards", settings };
    sweep.explain(&mut rows);
    let table = sweep.table("What the newer card gains", &rows, (None, |value| value));
    let [row] = rows;
    Ok((row, table))
}

//! Figure 6: diffuse transfer of order 10 on a ground below a blocker.

use super::figure_3::over_readings;
use super::signals::{ComputedSignal, POLYGONS};
use super::views::ModelView;
use super::{EntryFindings, HOST, Prose, Shared, StudyError, failed, number};
use crate::report::{Cell, PictureGrid, Table};
use crate::sphere::{HarmonicLight, function_count};
use crate::transfer::clustering::CpcaMethod;

/// "m_c = 64"; Table 1's row for the figure has 32.
const CLUSTERS: [usize; 2] = [64, 32];
const VECTORS: [usize; 3] = [1, 2, 4];
const ORDERS: [usize; 2] = [10, 5];
/// Small light to the side of the blocker: direction, and radius in radians.
const LIGHT: (glam::DVec3, f64) = (glam::DVec3::new(0.6, 0.4, 1.0), 0.15);
const EYE: ([f32; 3], f32) = ([0.8, -3.4, 3.2], 0.42);

const HOW: &str = "A ground and a blocker of {} vertices together, light of order {}. The caption has {} clusters, Table 1's row for the figure {}: \
    both are compressed, each by its share for a model of our size, and the row has all of them. Pictures are under a small disk, exposed alike.";

pub(in crate::study::reproduce) fn findings(shared: &Shared) -> Result<EntryFindings, StudyError> {
    let computed = shared.get::<ComputedSignal>(POLYGONS)?;
    let light = disk()?;
    let view = ModelView::new(computed, &light, EYE)?;
    let mut table =
        Table::of("Squared errors", "clusters_printed clusters vectors static iterative static_over_iterative");
    let (mut ratios, mut pictures) = (Vec::new(), Vec::new());
    for printed in CLUSTERS {
        for vectors in VECTORS {
            let methods = [(CpcaMethod::Static, "static"), (CpcaMethod::Iterative, "iterative")];
            let mut errors = [0.0; 2];
            for (error, (method, name)) in errors.iter_mut().zip(methods) {
                let clustering = computed.compressed(printed, vectors, method)?;
                *error = computed.error(&clustering);
                if printed == CLUSTERS[0] && (method == CpcaMethod::Iterative || vectors == VECTORS[0]) {
                    let name_of_file = format!("cpca-figure-6-{name}-{vectors}");
                    pictures.push(view.picture(Some(&clustering), name_of_file, format!("{name}, n' = {vectors}"))?);
                }
            }
            let ratio = errors[0] / errors[1];
            let counts = [printed, computed.clusters(printed), vectors].map(Cell::from);
            table.push(counts.into_iter().chain(errors.map(Cell::measured)).chain([Cell::ratio(ratio)]));
            ratios.push(ratio);
        }
    }
    let low = low_order(&light)?;
    let mut plain = Vec::new();
    for (order, light) in ORDERS.into_iter().zip([&light, &low]) {
        let view = ModelView::new(computed, light, EYE)?;
        let caption = format!("order {order}, uncompressed");
        plain.push(view.picture(None, format!("cpca-figure-6-order-{order}"), caption)?);
    }
    pictures.extend(plain.pop());
    plain.push(view.light("cpca-figure-6", "a small disk at order 10")?);
    let columns = ["static, n' = 1", "iterative, n' = 1", "n' = 2", "n' = 4", "N = 25, uncompressed"];
    let grid = PictureGrid::new("Figure 6: N = 100", columns).row("", pictures).row("N = 100, uncompressed", plain);
    let figures = [computed.signal.points(), ORDERS[0], CLUSTERS[0], CLUSTERS[1]].map(|count| number(count as f64, 0));
    Ok(EntryFindings {
        text: vec![Prose::new(HOW, figures)],
        rows: vec![over_readings("figure-6", &ratios)?],
        tables: vec![table],
        pictures: vec![grid],
        ..EntryFindings::default()
    })
}

fn disk() -> Result<HarmonicLight, StudyError> {
    HarmonicLight::disk(ORDERS[0], LIGHT.0, LIGHT.1, [40.0, 38.0, 34.0]).map_err(|e| failed(HOST)(&e))
}

/// Removes the higher bands of a light: transfer of order 10 then gives the result of order 5.
fn low_order(light: &HarmonicLight) -> Result<HarmonicLight, StudyError> {
    let mut channels = light.channels().clone();
    channels.iter_mut().for_each(|channel| channel[function_count(ORDERS[1])..].fill(0.0));
    HarmonicLight::new(channels).map_err(|e| failed(HOST)(&e))
}

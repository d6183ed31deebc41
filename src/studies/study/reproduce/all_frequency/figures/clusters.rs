//! Figures 4 and 5: clusters of three segments, and the number of representatives.

use glam::DVec3;

use super::baselines::COLORS;
use super::lit::Surface;
use super::scene::{FigureScene, stand_in};
use super::{FigureParts, Prose, Shared, StudyError, models, number, solved};
use crate::all_frequency::Reflectance;
use crate::all_frequency::code::CodedTransfer;
use crate::picture::rgb8;
use crate::report::{Cell, NamedPicture, PictureGrid, Table};
use crate::study::prt::cluster_color;
use crate::transfer::grid::Segmentation;
use crate::transfer::light::HaarLight;

/// Numbers of representatives; the paper's is the last.
const VECTORS: [usize; 4] = [1, 4, 8, 16];
/// Number of segments whose clusters are drawn.
const SEGMENTS: usize = 3;

const HOW: &str = "Figure 4 and figure 5 have a diffuse Buddha of {} vertices, {} clusters in all {} segments that are not empty, {} \
    vertices each on average.";

/// Reason why the error falls with more representatives.
const FEWER: &str =
    "representatives are added to the clusters of fewer; their code of 16 bits adds far less error than they take away";

pub(super) fn figure(shared: &Shared) -> Result<FigureParts, StudyError> {
    let size = shared.models;
    let scene = FigureScene::new(&models::buddha(size), 2, DVec3::new(1.0, -2.0, 0.6), size)?;
    let light = HaarLight::new(&stand_in()?, Segmentation::Quarters);
    let surface = Surface {
        scene: &scene,
        maps: &scene.of_model,
        reflectance: &Reflectance::Diffuse,
        color: COLORS[0],
        pieces: (shared, "figure-5"),
    };
    let dark = vec![[0.0; 3]; scene.of_ground.len()];
    let raw = surface.raw(&[&light])?.remove(0);
    let exact = scene.joined(&surface.exit_of_rows((1, &raw)), &dark);
    let exposure = scene.exposure(&exact);
    let mut table = Table::of("Figure 5: representatives per cluster", "representatives squared_error rms_% flip");
    let (mut pictures, mut errors, mut last) = (Vec::new(), Vec::new(), None);
    for vectors in VECTORS {
        let (coded, tally) = surface.coded(models::options(size, vectors))?;
        let found = scene.joined(&surface.of_code(&coded, &light)?, &dark);
        let error = scene.error(&found, &exact, exposure)?;
        let squared = tally.sum(|part| part.coded_squared_error) / tally.sum(|part| part.squares);
        table.push([
            vectors.into(),
            Cell::measured(squared),
            Cell::measured(100.0 * error.rms),
            Cell::measured(error.flip),
        ]);
        let name = (format!("figure-5-{vectors}"), format!("representatives: {vectors}"));
        pictures.push(scene.picture(&found, exposure, name)?);
        errors.push(squared);
        last = Some(coded);
    }
    let caption = "without compression".to_owned();
    pictures.push(scene.picture(&exact, exposure, ("figure-5-exact".to_owned(), caption))?);
    let coded = last.as_ref();
    let columns = VECTORS.map(|vectors| format!("n = {vectors}")).into_iter().chain(["without compression".to_owned()]);
    let figure_5 = PictureGrid::new("Figure 5", columns).row("", pictures);
    let segments = coded.map(|coded| of_segments(&scene, coded)).unwrap_or_default();
    let labels = segments.iter().map(|picture| picture.name.replace("figure-4-", "segment "));
    let pictures = vec![PictureGrid::new("Figure 4", labels.collect::<Vec<_>>()).row("", segments), figure_5];
    let row = solved("one-representative-over-16", errors[0] / errors[3])?.confined([1.0, f64::INFINITY], FEWER);
    let [clusters, segments] = coded.map_or([0, 0], |coded| [coded.clusters(), coded.segments.len()]);
    let text = vec![Prose::new(
        HOW,
        [scene.of_model.len(), clusters, segments, models::points_per_cluster(size)]
            .map(|count| number(count as f64, 0)),
    )];
    Ok(FigureParts { text, rows: vec![row], tables: vec![table], pictures })
}

/// Pictures of the clusters of the segments that most vertices see; black where none of the light arrives.
fn of_segments(scene: &FigureScene, coded: &CodedTransfer) -> Vec<NamedPicture> {
    let mut largest: Vec<_> = coded.segments.iter().collect();
    largest.sort_by_key(|part| std::cmp::Reverse(part.vertices.len()));
    let picture = |part: &&crate::all_frequency::code::CodedSegment| {
        let color = |vertex: u32| {
            let at = part.vertices.binary_search(&vertex);
            at.map_or([0; 3], |at| cluster_color(u32::from(part.cluster_of[at])))
        };
        let image = rgb8(scene.fine.side(), scene.fine.side(), scene.fine.nearest(color));
        let caption =
            format!("segment {}; clusters: {}; black sees none of its light", part.segment, part.counts.len());
        NamedPicture::new(format!("figure-4-{}", part.segment), image, caption)
    };
    largest.iter().take(SEGMENTS).map(picture).collect()
}

//! Section 5.3: the shape of a block of 256 rays, which "can be found through experimentation".

use refsim::device::Profile;
use refsim::event::TexelObserver;
use refsim::machine::ExecutorKind;
use refsim::timing::cache::TextureCaches;

use super::pipeline::timed;
use super::radeon_8500::{mesh, moved_rays};
use super::{EntryFindings, RunResult, Shared, StudyError, no_time, paragraph};
use crate::geom::exact::Sides;
use crate::ray_engine::{Crossbar, RayBatch, Recording};
use crate::report::{Cell, Table};

const DEVICES: [&str; 2] = ["r200", "nv35"];
/// Widths and heights of blocks of 256 rays.
const SHAPES: [[u32; 2]; 6] = [[256, 1], [128, 2], [64, 4], [32, 8], [16, 16], [1, 256]];
/// Triangles per pass, as in section 6.3.
const TRIANGLES: usize = 10;
const HOW: &str = "One pass tests {} triangles against the same 256 rays, arranged in blocks of each shape. The scalar \
    executor reads each texel through a model of the card's texture cache, whose size and line length are guesses; \
    misses are listed for half that size, for that size and for twice that size. The column lines counts the distinct \
    cache lines that are read: the misses of an unlimited cache. The cards fill pixels in quads of 2 x 2. The paper \
    prints no numbers for this, so nothing is judged.";

pub(in crate::study::reproduce) fn findings(_: &Shared) -> Result<EntryFindings, StudyError> {
    let (mesh, rays) = (mesh(TRIANGLES)?, moved_rays(16)?);
    let mut table = Table::of(
        "Blocks of 256 rays by shape",
        "device width height texels_read lines misses_half misses misses_double clocks_per_test bound_by",
    );
    for device in DEVICES {
        let profile = Profile::named(device)?;
        let caches = TextureCaches::new(&profile).map_err(no_time)?;
        let observer = || -> Box<dyn TexelObserver> { Box::new(caches.clone()) };
        let card = Crossbar::new(profile.clone(), ExecutorKind::Scalar).all_pairs(true);
        for [width, height] in SHAPES {
            let block = RayBatch::new(width, height, rays.rays().to_vec()).on(device)?;
            let recording = Recording { new_observer: Some(&observer), done: None };
            let answer = card.intersect_recorded(&mesh, &block, Sides::Front, recording)?;
            let drawn = timed(device, answer.log)?;
            let traffic = || drawn.record.samplers.iter().filter_map(|sampler| sampler.traffic);
            let misses = [0, 1, 2].map(|size| traffic().map(|seen| seen.misses[size]).sum::<u64>());
            let tests = (256 * TRIANGLES) as f64;
            let clocks = profile.rates.core_clock_hz.map(|hz| drawn.cost.total.seconds() * hz as f64 / tests);
            table.push([
                device.into(),
                width.into(),
                height.into(),
                traffic().map(|seen| seen.accesses).sum::<u64>().into(),
                traffic().map(|seen| seen.distinct).sum::<u64>().into(),
                misses[0].into(),
                misses[1].into(),
                misses[2].into(),
                clocks.map(Cell::measured).into(),
                drawn.cost.bottleneck.to_string().into(),
            ]);
        }
    }
    Ok(EntryFindings::new([paragraph(HOW, &[&TRIANGLES])], [], [], [table]))
}

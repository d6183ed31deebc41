//! Table 5: the teapot room by the number of rays in a pass.

use super::super::{Findings, ReproduceError};
use super::{HOW, TeapotRoom, lines, parameters, rows};
use crate::ray_engine::engine::EngineParameters;

const SIZE: &str = "Larger passes cost less a ray, but more caches never fill, and their rays are forced to the host: the more so, the fewer rays a picture \
    has. At 192 x 192 pixels the four speed-ups are 29, 31, 25 and 14 %, at 256 x 256 those below, at 512 x 512 they are 36, 42, 42 and 37 %, in nearly the \
    printed order.";

/// R, and rays a second.
const PRINTED: [(usize, f64); 4] = [(64, 165_098.0), (128, 177_647.0), (256, 180_558.0), (512, 175_904.0)];

pub(in super::super) fn findings() -> Result<Findings, ReproduceError> {
    let room = TeapotRoom::new()?;
    let wanted =
        PRINTED.map(|(rays, printed)| (format!("{rays} rays"), printed, EngineParameters { rays, ..parameters() }));
    let lines = lines(&room, wanted.to_vec())?;
    let (rows, table) = rows(&room, &lines, "Table 5")?;
    Ok(Findings { text: vec![HOW.to_owned(), SIZE.to_owned()], rows, tables: vec![table], charts: Vec::new() })
}

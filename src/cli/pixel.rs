//! `X,Y` on the command line.

use super::Problem;

pub(super) fn parse(text: &str) -> Result<[u32; 2], String> {
    let number = |part: &str| part.trim().parse::<u32>().ok();
    text.split_once(',')
        .and_then(|(x, y)| Some([number(x)?, number(y)?]))
        .ok_or_else(|| format!("expected a pixel such as `3,4`: column and row, counted from 0; found `{text}`"))
}

/// The pixel, if it lies within a surface of this size.
pub(super) fn within([x, y]: [u32; 2], [width, height]: [u32; 2]) -> Result<[u32; 2], Problem> {
    if x < width && y < height {
        return Ok([x, y]);
    }
    let help = format!("columns run from 0 to {}, rows from 0 to {}", width - 1, height - 1);
    Err(Problem::usage(format!("expected a pixel of the {width}x{height} target, found {x},{y}"), help))
}

//! `--uniform NAME=X,Y,..`

/// A uniform with its numbers, as IEEE singles.
pub(super) type Uniform = (String, Vec<u32>);

pub(super) fn parse(text: &str) -> Result<Uniform, String> {
    let wrong = || format!("expected a uniform with up to four numbers, such as `u.color=1,0.5,0`, found `{text}`");
    let (name, list) = text.split_once('=').filter(|(name, _)| !name.is_empty()).ok_or_else(wrong)?;
    let numbers = list.split(',').map(|number| number.trim().parse().map(f32::to_bits));
    let numbers: Vec<u32> = numbers.collect::<Result<_, _>>().map_err(|_| wrong())?;
    Ok((name.to_owned(), numbers))
}

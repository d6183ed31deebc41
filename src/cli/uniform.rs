//! `--uniform NAME=X,Y,..`

/// A uniform with up to four numbers, as IEEE singles.
pub(super) type Uniform = (String, [u32; 4]);

pub(super) fn parse(text: &str) -> Result<Uniform, String> {
    let wrong = || format!("expected a uniform with up to four numbers, as `u.color=1,0.5,0`, found `{text}`");
    let (name, list) = text.split_once('=').filter(|(name, _)| !name.is_empty()).ok_or_else(wrong)?;
    let mut value = [0; 4];
    for (index, number) in list.split(',').enumerate() {
        let number: f32 = number.trim().parse().map_err(|_| wrong())?;
        *value.get_mut(index).ok_or_else(wrong)? = number.to_bits();
    }
    Ok((name.to_owned(), value))
}

//! Pictures with names, and such pictures in rows and columns.

use crate::picture::RgbImage;

/// Picture with its file name and caption.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedPicture {
    /// File name without folder and extension.
    pub name: String,
    /// Picture in display encoding.
    pub image: RgbImage,
    /// Caption, also the text alternative.
    pub caption: String,
    /// Rank of each pixel in downscaling, higher ranks win; missing ranks count as 0.
    pub(super) ranks: Vec<u8>,
}

impl NamedPicture {
    /// Creates a picture with its name and caption.
    pub fn new(name: impl Into<String>, image: RgbImage, caption: impl Into<String>) -> Self {
        Self { name: name.into(), image, caption: caption.into(), ranks: Vec::new() }
    }

    /// Marks pixels that must survive downscaling: a rank per pixel, 0 for those that need not.
    #[must_use]
    pub fn marked(self, ranks: Vec<u8>) -> Self {
        Self { ranks, ..self }
    }
}

/// Pictures in rows and columns with labels, as a printed figure has them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PictureGrid {
    /// Title.
    pub title: String,
    /// Labels of the columns.
    pub columns: Vec<String>,
    /// Rows.
    pub rows: Vec<PictureRow>,
}

/// Row of a [`PictureGrid`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PictureRow {
    /// Label; empty for none.
    pub label: String,
    /// Pictures in the columns from the left; `None` leaves a place free.
    pub pictures: Vec<Option<NamedPicture>>,
}

impl PictureGrid {
    /// Creates an empty grid.
    pub fn new<T: Into<String>>(title: impl Into<String>, columns: impl IntoIterator<Item = T>) -> Self {
        Self { title: title.into(), columns: columns.into_iter().map(Into::into).collect(), rows: Vec::new() }
    }

    /// Appends a row in which no place is free.
    #[must_use]
    pub fn row(self, label: impl Into<String>, pictures: impl IntoIterator<Item = NamedPicture>) -> Self {
        self.sparse_row(label, pictures.into_iter().map(Some))
    }

    /// Appends a row.
    #[must_use]
    pub fn sparse_row(
        mut self,
        label: impl Into<String>,
        pictures: impl IntoIterator<Item = Option<NamedPicture>>,
    ) -> Self {
        self.rows.push(PictureRow { label: label.into(), pictures: pictures.into_iter().collect() });
        self
    }

    /// Pictures, row by row.
    pub fn pictures(&self) -> impl Iterator<Item = &NamedPicture> {
        self.rows.iter().flat_map(|row| row.pictures.iter().flatten())
    }
}

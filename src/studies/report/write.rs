//! Encoding of findings as files: tables, pictures, charts, document and page.

use super::findings::{Findings, NamedFile, NamedPicture};
use super::{Provenance, page};
use crate::error::InputError;
use crate::picture::{PictureNotes, exr_with_notes, png_with_notes};

impl Findings {
    /// Encodes all files of the output folder, and takes the additional files out of the findings.
    pub fn take_files(&mut self, provenance: &Provenance) -> Result<Vec<NamedFile>, InputError> {
        let notes = PictureNotes { world_to_camera: self.world_to_camera, ..provenance.notes() };
        let encoded = |found: &NamedPicture| png_with_notes(&found.image, &notes);
        let pngs = self.pictures.iter().map(encoded).collect::<Result<Vec<_>, _>>()?;
        let drawings = self.charts.iter().map(|found| found.chart.svg()).collect::<Result<Vec<_>, _>>()?;
        let page = page::html(self, &pngs, &drawings, provenance)?;
        let mut files = std::mem::take(&mut self.files);
        for (name, picture) in std::mem::take(&mut self.layers) {
            files.push((format!("{name}.exr"), exr_with_notes(&picture, &notes)?));
        }
        for found in self.tables.iter().filter(|found| !found.table.rows().is_empty()) {
            if let Some(name) = found.csv {
                files.push((format!("{name}.csv"), found.whole().csv()?.into_bytes()));
            }
        }
        files.extend(self.pictures.iter().zip(pngs).map(|(found, png)| (format!("{}.png", found.name), png)));
        let drawings = self.charts.iter().zip(drawings);
        files.extend(drawings.map(|(found, svg)| (format!("{}.svg", found.name), svg.into_bytes())));
        files.push(("study.json".to_owned(), format!("{:#}\n", self.document(provenance)).into_bytes()));
        files.push(("index.html".to_owned(), page.into_bytes()));
        Ok(files)
    }
}

//! Studies: their findings, in the JSON document and in files.

mod error;
mod framing;
mod leaky_teapot;
mod matrix_product;
mod measure;
mod page;
mod picture_difference;
mod precision;
mod prt;
mod radiosity;
mod reproduce;
mod subsurface;

use std::collections::BTreeMap;

use crossbar_ground::io::load_picture;
use crossbar_ground::picture::Picture;
use crossbar_studies::report::{Findings, Provenance};
use crossbar_studies::study::Study;

fn findings(study: &dyn Study) -> Findings {
    study.findings(&mut |_, _, _| {}).expect("the study ends")
}

/// Output files of a study, by name.
struct StudyFiles(BTreeMap<String, Vec<u8>>);

impl StudyFiles {
    fn of(study: &dyn Study) -> Self {
        let mut found = findings(study);
        Self(found.take_files(&Provenance::new("test")).expect("all of it can be encoded").into_iter().collect())
    }

    fn bytes(&self, name: &str) -> &[u8] {
        self.0.get(name).unwrap_or_else(|| panic!("no {name} among {:?}", self.0.keys()))
    }

    /// Red, green and blue of a picture, linear, row by row.
    fn linear(&self, name: &str) -> Vec<[f32; 3]> {
        self.picture(name).linear().expect("a picture in color")
    }

    fn picture(&self, name: &str) -> Picture {
        let folder = tempfile::tempdir().expect("a folder");
        std::fs::write(folder.path().join(name), self.bytes(name)).expect("a file");
        load_picture(&folder.path().join(name)).expect("a picture")
    }

    /// Rows of a table; each maps headings to cells.
    fn rows(&self, name: &str) -> Vec<BTreeMap<String, String>> {
        let mut reader = csv::Reader::from_reader(self.bytes(name));
        reader.deserialize().collect::<Result<_, _>>().expect("a table")
    }
}

fn number(row: &BTreeMap<String, String>, heading: &str) -> f64 {
    let text = row.get(heading).unwrap_or_else(|| panic!("no {heading} in {:?}", row.keys()));
    text.parse().unwrap_or_else(|_| panic!("{heading} is {text}"))
}

/// Red, green and blue of a row, from the columns with this prefix.
fn rgb(row: &BTreeMap<String, String>, name: &str) -> [f64; 3] {
    ["r", "g", "b"].map(|channel| number(row, &format!("{name}_{channel}")))
}

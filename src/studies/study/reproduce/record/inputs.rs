//! Inputs that determine the rows of an entry with a choice of model size: printed figures, models, parameters.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::error::StaleRecord;
use crate::geom::Mesh;
use crate::geom::teapot::teapot;
use crate::report::sha256;
use crate::scene::built::flat_models::FlatModel;
use crate::scene::built::transfer_models::TransferModel;
use crate::study::reproduce::shared::{Shared, SharedResult};
use crate::study::reproduce::{ModelSize, ReproduceEntry, StudyError, all_frequency, bi_scale, cpca, papers};

/// Model at full size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum FullModel {
    Transfer(TransferModel),
    Flat(FlatModel),
    Teapot,
}

use FullModel::{Flat, Teapot, Transfer};
use TransferModel::{BiScaleArmor, BiScaleBunny, Buddha, Bumpy, Bunny, Head, Polygons, Smooth, Tweety};

/// Entry whose rows depend on the size of models: its name, its models, and the parameters of runs at full size.
type SizedEntry = (&'static str, &'static [FullModel], fn() -> String);

const SIZED: &[SizedEntry] = &[
    ("cpca-figure-2", &[Transfer(Smooth)], cpca::full_size),
    ("cpca-figures-3-4", &[Transfer(Smooth)], cpca::full_size),
    ("cpca-figure-6", &[Transfer(Polygons)], cpca::full_size),
    ("cpca-figure-7", &[Transfer(Smooth)], cpca::full_size),
    ("cpca-figure-8", &[Transfer(Head), Transfer(Bumpy)], cpca::full_size),
    ("cpca-figure-9", &[Transfer(Bumpy)], cpca::full_size),
    ("cpca-figure-10", &[Transfer(Bumpy)], cpca::full_size),
    ("cpca-figure-11", &[Transfer(Bumpy), Transfer(Smooth)], cpca::full_size),
    ("cpca-table-1", &[Transfer(Bumpy), Transfer(Smooth), Transfer(Head), Transfer(Polygons)], cpca::full_size),
    ("cpca-coherence", &[Transfer(Bumpy), Transfer(Smooth)], cpca::full_size),
    ("all-frequency-figures", &[Transfer(Tweety), Transfer(Buddha), Teapot], all_frequency::full_size),
    ("all-frequency-table-1", &[Transfer(Bunny), Transfer(Tweety), Transfer(Buddha), Teapot], all_frequency::full_size),
    ("bi-scale-figure-8", &[Transfer(BiScaleBunny)], bi_scale::full_size),
    (
        "bi-scale-figures",
        &[Transfer(BiScaleBunny), Transfer(BiScaleArmor), Flat(FlatModel::Chair), Flat(FlatModel::Temple)],
        bi_scale::full_size,
    ),
    (
        "bi-scale-table-1",
        &[Transfer(BiScaleArmor), Flat(FlatModel::Chair), Flat(FlatModel::Temple)],
        bi_scale::full_size,
    ),
    ("bi-scale-figure-6", &[Flat(FlatModel::Chair)], bi_scale::full_size),
];

fn terms(entry: &ReproduceEntry) -> Option<&'static SizedEntry> {
    SIZED.iter().find(|(id, ..)| *id == entry.id)
}

/// Returns those of some entries whose rows depend on the size of models, which can be recorded.
pub fn sized(entries: &[ReproduceEntry]) -> Vec<ReproduceEntry> {
    entries.iter().filter(|entry| is_sized(entry)).copied().collect()
}

/// Returns `true` if the entry's rows depend on the size of models.
pub(super) fn is_sized(entry: &ReproduceEntry) -> bool {
    terms(entry).is_some()
}

/// Digests of the inputs of a run at full size, as far as reduced models do not show them: 16 hexadecimal digits each.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RecordInputs {
    /// Values, units and places of the paper's figures; neither bounds nor the classes of misses.
    figures: String,
    /// Parameters of the run.
    parameters: String,
    /// Each model.
    models: BTreeMap<String, String>,
}

impl RecordInputs {
    /// Inputs of an entry; `None` if its rows do not depend on the size of models.
    pub(super) fn of(entry: &ReproduceEntry, shared: &Shared) -> Result<Option<Self>, StudyError> {
        let Some((id, models, parameters)) = terms(entry) else { return Ok(None) };
        let digest_of = |model: &FullModel| Ok((model.name(), shared.get::<ModelDigest>(*model)?.0.clone()));
        let models = models.iter().map(digest_of).collect::<Result<_, StudyError>>()?;
        let parameters = format!("{} {}", parameters(), ModelSize::Printed.picture_side());
        Ok(Some(Self { figures: figures(id)?, parameters: digest(parameters.as_bytes()), models }))
    }

    /// First input that is another one now.
    pub(super) fn stale(&self, now: &Self) -> Option<StaleRecord> {
        let pair = |recorded: &String, found: &String| (recorded.clone(), found.clone());
        if self.figures != now.figures {
            let (recorded, found) = pair(&self.figures, &now.figures);
            return Some(StaleRecord::Figures { recorded, found });
        }
        if self.parameters != now.parameters {
            let (recorded, found) = pair(&self.parameters, &now.parameters);
            return Some(StaleRecord::Parameters { recorded, found });
        }
        let of = |inputs: &Self, model: &String| inputs.models.get(model).map_or("none", String::as_str).to_owned();
        let mut models = self.models.keys().chain(now.models.keys());
        let model = models.find(|model| of(self, model) != of(now, model))?;
        Some(StaleRecord::Model { model: model.clone(), recorded: of(self, model), found: of(now, model) })
    }
}

/// Digest of the printed figures of an entry's paper, which has the beginning of the entry's name.
fn figures(entry: &str) -> Result<String, StudyError> {
    let all = papers()?.iter().filter(|paper| entry.starts_with(paper.id)).flat_map(|paper| &paper.figures);
    let line = |figure: &crate::study::reproduce::PaperFigure| {
        format!("{}|{:?}|{}|{}|{}\n", figure.id, figure.value, figure.decimals, figure.unit, figure.place)
    };
    Ok(digest(all.map(line).collect::<String>().as_bytes()))
}

/// Digest of a model's mesh at full size.
struct ModelDigest(String);

impl SharedResult for ModelDigest {
    type Key = FullModel;

    fn compute(model: &FullModel, _: &Shared) -> Result<Self, StudyError> {
        let mesh = model.mesh()?;
        let mut bytes = Vec::new();
        let mut floats = |values: &[f32]| bytes.extend(values.iter().flat_map(|value| value.to_le_bytes()));
        floats(mesh.positions().as_flattened());
        floats(mesh.normals().unwrap_or_default().as_flattened());
        floats(mesh.texcoords().unwrap_or_default().as_flattened());
        bytes.extend(mesh.triangles().as_flattened().iter().flat_map(|corner| corner.to_le_bytes()));
        Ok(Self(digest(&bytes)))
    }
}

impl FullModel {
    fn name(self) -> String {
        match self {
            Transfer(model) => format!("{model:?}"),
            Flat(model) => format!("{model:?}"),
            Teapot => "Teapot".to_owned(),
        }
    }

    fn mesh(self) -> Result<Mesh, StudyError> {
        Ok(match self {
            Transfer(model) => model.mesh(1),
            Flat(model) => model.model(1).mesh,
            Teapot => teapot(40).map_err(|error| StudyError::coded("reproduce::record", error))?,
        })
    }
}

fn digest(bytes: &[u8]) -> String {
    let mut digest = sha256(bytes).expect("memory can be read");
    digest.truncate(16);
    digest
}

#[cfg(test)]
mod tests {
    use super::super::super::ENTRIES;
    use super::*;

    fn inputs(id: &str) -> RecordInputs {
        let entry = ENTRIES.iter().find(|entry| entry.id == id).expect("an entry");
        RecordInputs::of(entry, &Shared::new(ModelSize::Reduced)).expect("digests").expect("a choice of size")
    }

    #[test]
    fn sized_entries_exist() {
        for (id, models, _) in SIZED {
            assert!(ENTRIES.iter().any(|entry| entry.id == *id) && !models.is_empty(), "{id}");
        }
    }

    /// Another figure, model or parameter is said; what is the same is not stale.
    #[test]
    fn each_input_is_held() {
        let now = inputs("bi-scale-figure-8");
        assert_eq!(now.stale(&now), None);
        let other = || "0".repeat(16);
        let figures = RecordInputs { figures: other(), ..now.clone() };
        let parameters = RecordInputs { parameters: other(), ..now.clone() };
        let mut model = now.clone();
        model.models.insert("BiScaleBunny".to_owned(), other());
        let none = RecordInputs { models: BTreeMap::new(), ..now.clone() };
        let said = [figures, parameters, model, none].map(|inputs| inputs.stale(&now).expect("stale").to_string());
        for (said, word) in said.iter().zip(["figures", "parameters", "`BiScaleBunny`", "had none"]) {
            assert!(said.contains(word), "{said}");
        }
    }
}

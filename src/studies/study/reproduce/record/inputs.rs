//! Inputs that determine the rows of an entry with a choice of model size: printed figures, models, parameters.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::error::StaleRecord;
use crate::geom::Mesh;
use crate::report::sha256;
use crate::study::reproduce::full_size::{FullModel, FullSize};
use crate::study::reproduce::shared::{Shared, SharedResult};
use crate::study::reproduce::{ModelSize, ReproduceEntry, StudyError, papers};

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
        let Some(FullSize { models, parameters }) = entry.full_size else { return Ok(None) };
        let digest_of = |model: &FullModel| Ok((model.name(), shared.get::<ModelDigest>(*model)?.0.clone()));
        let models = models.iter().map(digest_of).collect::<Result<_, StudyError>>()?;
        let parameters = format!("{} {}", parameters(), ModelSize::Printed.picture_side());
        Ok(Some(Self { figures: figures(entry.id)?, parameters: digest(parameters.as_bytes()), models }))
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

    fn compute(model: &FullModel, shared: &Shared) -> Result<Self, StudyError> {
        let mesh = shared.get::<Mesh>(*model)?;
        let mut bytes = Vec::new();
        let mut floats = |values: &[f32]| bytes.extend(values.iter().flat_map(|value| value.to_le_bytes()));
        floats(mesh.positions().as_flattened());
        floats(mesh.normals().unwrap_or_default().as_flattened());
        floats(mesh.texcoords().unwrap_or_default().as_flattened());
        bytes.extend(mesh.triangles().as_flattened().iter().flat_map(|corner| corner.to_le_bytes()));
        Ok(Self(digest(&bytes)))
    }
}

fn digest(bytes: &[u8]) -> String {
    let mut digest = sha256(bytes).expect("memory can be read");
    digest.truncate(16);
    digest
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::built::transfer_models::TransferModel;
    use crate::study::reproduce::EntryFindings;

    /// Another figure, model or parameter is said; what is the same is not stale.
    #[test]
    fn each_input_is_held() {
        let entry = ReproduceEntry::new("bi-scale-entry", "A table", |_| Ok(EntryFindings::default()))
            .sized(&[FullModel::Transfer(TransferModel::Polygons)], || "4 views".to_owned());
        let now =
            RecordInputs::of(&entry, &Shared::new(ModelSize::Reduced)).expect("digests").expect("a choice of size");
        assert_eq!(now.stale(&now), None);
        let other = || "0".repeat(16);
        let figures = RecordInputs { figures: other(), ..now.clone() };
        let parameters = RecordInputs { parameters: other(), ..now.clone() };
        let mut model = now.clone();
        model.models.insert("Polygons".to_owned(), other());
        let none = RecordInputs { models: BTreeMap::new(), ..now.clone() };
        let said = [figures, parameters, model, none].map(|inputs| inputs.stale(&now).expect("stale").to_string());
        for (said, word) in said.iter().zip(["figures", "parameters", "`Polygons`", "had none"]) {
            assert!(said.contains(word), "{said}");
        }
    }
}

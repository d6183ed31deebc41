//! Inputs that determine the rows of an entry with a choice of model size: printed figures, models, parameters.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::error::StaleRecord;
use crate::geom::Mesh;
use crate::report::sha256;
use crate::study::reproduce::full_size::{FullModel, FullSize};
use crate::study::reproduce::shared::{Shared, SharedResult};
use crate::study::reproduce::{ModelSize, Paper, PaperFigure, ReproduceEntry, StudyError, figures};

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
        Ok(Some(Self { figures: figures_of(entry.paper)?, parameters: digest(parameters.as_bytes()), models }))
    }

    /// First input that is another one now.
    pub(super) fn stale(&self, now: &Self) -> Option<StaleRecord> {
        let of = |inputs: &Self, model: &str| inputs.models.get(model).map_or("none", String::as_str).to_owned();
        let models = self.models.keys().chain(now.models.keys());
        let models = models.map(|model| (format!("the model `{model}` has"), of(self, model), of(now, model)));
        let [figures, parameters] = [
            ("the paper's printed figures have", &self.figures, &now.figures),
            ("the parameters of a run at full size have", &self.parameters, &now.parameters),
        ]
        .map(|(inputs, recorded, found)| (inputs.to_owned(), recorded.clone(), found.clone()));
        let mut inputs = [figures, parameters].into_iter().chain(models);
        let (inputs, recorded, found) = inputs.find(|(_, recorded, found)| recorded != found)?;
        Some(StaleRecord::of_digests(&inputs, &recorded, &found))
    }
}

/// Digest of the printed figures of a paper.
fn figures_of(paper: Paper) -> Result<String, StudyError> {
    let of_paper = figures()?.iter().filter(|figure| figure.paper == paper);
    let line = |figure: &PaperFigure| {
        format!("{}|{:?}|{}|{}|{}\n", figure.id, figure.value, figure.decimals, figure.unit, figure.place)
    };
    Ok(digest(of_paper.map(line).collect::<String>().as_bytes()))
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
        let entry = Paper::BiScale
            .entry("bi-scale-entry", "A table", |_| Ok(EntryFindings::default()))
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

//! Findings of the study.

use serde_json::json;

use super::subject::BrdfFactors;
use super::{sphere, tables};
use crate::all_frequency::factor::{DiscSamples, Factorization, ProductErrors, ProductFactors, ProductTable};
use crate::report::digits::{Quantity, shown};
use crate::report::words::percent;
use crate::report::{Findings, FoundTable, NamedPicture};
use crate::sphere::function_count;
use crate::study::prt::lit_view::{auto_exposure, signed_picture};
use crate::study::{ProgressFn, Study, StudyError};

impl Study for BrdfFactors {
    fn findings(&self, progress: &mut ProgressFn<'_>) -> Result<Findings, StudyError> {
        self.check_terms()?;
        let table = self.subject.table(&self.sampling, &mut |done, of| progress("views", done, of))?;
        progress("singular values", 0, 1);
        let all = self.factorization(&table)?;
        let factors = all.factors(all.terms());
        let disc = DiscSamples::new(&table);
        progress("errors", 0, 1);
        let errors = disc.errors(&factors);
        let harmonics = tables::harmonics(&disc)?;
        let mut found = Findings::new(format!("Factors of {}", self.name));
        self.conclude(&mut found, &all, &errors, &harmonics);
        self.pictures(&mut found, &table, &factors)?;
        found.heading("Errors by terms");
        found.table(FoundTable::from(tables::terms(&disc, &all)).csv("terms").field("terms"));
        tables::charts(&all).for_each(|chart| found.chart(chart));
        if !harmonics.is_empty() {
            found.heading("Compared with spherical harmonics");
        }
        found.table(FoundTable::from(tables::harmonic_table(&harmonics)).csv("harmonics").field("harmonics"));
        tables::keep(&mut found, &all, &factors)?;
        let pair = all.split_pair(all.terms()).map(|pair| json!({ "terms": pair.terms, "values": pair.values }));
        found.fields(json!({
            "singular_values": all.singular_values(), "terms_kept": all.terms(), "rank": all.rank(),
            "rms": errors.rms, "max": errors.max, "least": errors.least, "negative_share": errors.negative,
            "relative_squared_error": all.relative_squared_error(all.terms()), "split_pair": pair,
        }));
        Ok(found)
    }
}

impl BrdfFactors {
    fn conclude(
        &self,
        found: &mut Findings,
        all: &Factorization,
        errors: &ProductErrors,
        harmonics: &[(usize, ProductErrors)],
    ) {
        let error = |value: f64| shown(value, Quantity::Error);
        let count = all.terms();
        let [relative, rms, max] = [all.relative_squared_error(count), errors.rms, errors.max].map(error);
        let terms = if count == 1 { "term" } else { "terms" };
        found.conclusion(format!(
            "{count} {terms} of {}: relative squared error {relative}; at texels above the horizon RMS {rms}, largest {max}.",
            self.name
        ));
        if let Some((order, harmonic)) = harmonics.iter().find(|(_, harmonic)| harmonic.rms <= errors.rms) {
            found.conclusion(format!(
                "Spherical harmonics for view and light need {} functions (order {order}) for the same accuracy: RMS \
                 {}.",
                function_count(*order),
                error(harmonic.rms)
            ));
        }
        if let Some(pair) = all.split_pair(count) {
            let [kept, left] = pair.values.map(|value| shown(value, Quantity::Measured));
            found.conclusion(format!(
                "Warning: terms {count} and {} have almost equal singular values, {kept} and {left}, and only one of \
                 them is kept: the approximation favors a direction that the reflectance does not favor.",
                count + 1
            ));
        }
        if errors.negative > 0.0 {
            let least = shown(errors.least, Quantity::Measured);
            found.conclusion(format!(
                "The approximation is negative at {} of the pairs of texels; its minimum is {least}.",
                percent(errors.negative)
            ));
        }
    }

    /// Adds pictures of a sphere shaded by f, by the table and by the terms.
    fn pictures(&self, found: &mut Findings, table: &ProductTable, factors: &ProductFactors) -> Result<(), StudyError> {
        let limit = self.sampling.limit;
        let of_formula =
            self.subject.with_product(|product| sphere::radiance(&|view, light| product.value(view, light).min(limit)));
        let of_table = sphere::radiance(&|view, light| table.interpolated(view, light));
        let of_terms = sphere::radiance(&|view, light| factors.product(view, light));
        let exposure = auto_exposure(&of_table);
        let named = |name: &str, radiance: &[[f64; 3]], caption: String| -> Result<NamedPicture, StudyError> {
            Ok(NamedPicture::new(name, sphere::picture(radiance).display(exposure)?, caption))
        };
        let mut pictures = Vec::new();
        if let Some(radiance) = &of_formula {
            pictures.push(named("f", radiance, "f itself, clipped".to_owned())?);
        }
        pictures.push(named("table", &of_table, "f interpolated from its table".to_owned())?);
        pictures.push(named("approximation", &of_terms, format!("by terms: {}", factors.terms()))?);
        let difference: Vec<f64> = of_terms.iter().zip(&of_table).map(|(terms, table)| terms[0] - table[0]).collect();
        let largest = difference.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
        if largest > 0.0 {
            pictures.push(signed_picture("difference", "terms minus table:", sphere::SIZE, &difference, largest));
        }
        found.pictures(pictures);
        Ok(())
    }
}

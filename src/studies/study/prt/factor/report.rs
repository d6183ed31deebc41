//! Findings of the study.

use glam::DVec3;
use serde_json::json;

use super::subject::BrdfFactors;
use super::{files, harmonics, sphere, terms};
use crate::all_frequency::factor::{DiscSamples, Factorization, ProductErrors, ProductFactors, ProductTable};
use crate::report::digits::{Quantity, shown};
use crate::report::words::percent;
use crate::report::{Cell, Findings, FoundTable, NamedPicture, Table, false_color};
use crate::sphere::{DirectionRule, function_count};
use crate::study::{ProgressFn, Study, StudyError};

/// Degree of the quadrature rule for directional albedos.
const ALBEDO_DEGREE: usize = 95;

impl Study for BrdfFactors {
    fn findings(&self, progress: &mut ProgressFn<'_>) -> Result<Findings, StudyError> {
        self.check_terms()?;
        let table = self.subject.table(&self.sampling, &mut |done, of| progress("views", done, of))?;
        progress("singular values", 0, 1);
        let all = self.factorization(&table)?;
        let factors = all.factors(all.terms());
        let disc = DiscSamples::new(&table);
        progress("errors", 0, 1);
        let by_terms = terms::by_terms(&disc, &all);
        let errors = disc.errors(&factors);
        let harmonic = harmonics::rows(&disc)?;
        let mut found = Findings::new(format!("Factors of {}", self.name));
        self.conclude(&mut found, &all, &errors, &harmonic);
        self.pictures(&mut found, &table, &factors)?;
        found.heading("Errors by terms");
        found.table(FoundTable::from(terms::table(&by_terms, &all)).csv("terms").field("terms"));
        terms::charts(&all).into_iter().for_each(|chart| found.chart(chart));
        self.between(&mut found, &factors);
        if !harmonic.is_empty() {
            found.heading("Compared with spherical harmonics");
        }
        found.table(FoundTable::from(harmonics::table(&harmonic)).csv("harmonics").field("harmonics"));
        found.heading("Directional albedo");
        found.table(FoundTable::from(self.albedos(&table, &factors)).csv("albedo").field("albedo"));
        files::keep(&mut found, &all, &factors)?;
        self.fields(&mut found, &all, &errors);
        Ok(found)
    }
}

impl BrdfFactors {
    fn conclude(
        &self,
        found: &mut Findings,
        all: &Factorization,
        errors: &ProductErrors,
        harmonic: &[harmonics::HarmonicRow],
    ) {
        let error = |value: f64| shown(value, Quantity::Error);
        let count = all.terms();
        let [relative, rms, max] = [all.relative_squared_error(count), errors.rms, errors.max].map(error);
        let terms = if count == 1 { "1 term of".to_owned() } else { format!("{count} terms of") };
        found.conclusion(format!(
            "{terms} {}: relative squared error {relative}; at texels above the horizon RMS {rms}, largest {max}.",
            self.name
        ));
        if let Some(row) = harmonic.iter().find(|row| row.errors.rms <= errors.rms) {
            found.conclusion(format!(
                "Spherical harmonics by integrals on both sides need {} functions (order {}) for the same accuracy: RMS {}.",
                function_count(row.order),
                row.order,
                error(row.errors.rms)
            ));
        }
        if let Some(pair) = all.split_pair(count) {
            let [kept, left] = pair.values.map(|value| shown(value, Quantity::Measured));
            found.conclusion(format!(
                "Warning: terms {count} and {} are a pair of singular values, {kept} and {left}, and only one of them is \
                 kept: the approximation favors a direction that the reflectance does not.",
                count + 1
            ));
        }
        if errors.negative > 0.0 {
            let least = shown(errors.least, Quantity::Measured);
            found.conclusion(format!(
                "The approximation is negative at {} of these pairs; its minimum is {least}.",
                percent(errors.negative)
            ));
        }
    }

    fn fields(&self, found: &mut Findings, all: &Factorization, errors: &ProductErrors) {
        found.field("singular_values", json!(all.singular_values()));
        found.field("terms_kept", json!(all.terms()));
        found.field("rank", json!(all.rank()));
        found.field("rms", json!(errors.rms));
        found.field("max", json!(errors.max));
        found.field("least", json!(errors.least));
        found.field("negative_share", json!(errors.negative));
        found.field("relative_squared_error", json!(all.relative_squared_error(all.terms())));
        let pair = all.split_pair(all.terms()).map(|pair| json!({ "terms": pair.terms, "values": pair.values }));
        found.field("split_pair", json!(pair));
    }

    /// Adds pictures of a sphere shaded by f, by the table and by the terms.
    fn pictures(&self, found: &mut Findings, table: &ProductTable, factors: &ProductFactors) -> Result<(), StudyError> {
        let limit = self.sampling.limit;
        let of_formula =
            self.subject.with_product(|product| sphere::radiance(&|view, light| product.value(view, light).min(limit)));
        let of_table = sphere::radiance(&|view, light| table.interpolated(view, light));
        let of_terms = sphere::radiance(&|view, light| factors.product(view, light));
        let exposure = sphere::exposure(&of_table);
        let named = |name: &str, radiance: &[f64], caption: String| -> Result<NamedPicture, StudyError> {
            Ok(NamedPicture::new(name, sphere::picture(radiance).display(exposure)?, caption))
        };
        let mut pictures = Vec::new();
        if let Some(radiance) = &of_formula {
            pictures.push(named("f", radiance, "f itself, cut off".to_owned())?);
        }
        pictures.push(named("table", &of_table, "f interpolated from its table".to_owned())?);
        pictures.push(named("approximation", &of_terms, format!("by terms: {}", factors.terms()))?);
        let difference: Vec<f64> = of_terms.iter().zip(&of_table).map(|(terms, table)| terms - table).collect();
        let largest = difference.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
        if largest > 0.0 {
            let scale = shown(largest, Quantity::Measured);
            let caption = format!("terms minus table: blue -{scale}, white 0, red +{scale}");
            pictures.push(NamedPicture::new(
                "difference",
                false_color::signed(sphere::SIZE, &difference, largest),
                caption,
            ));
        }
        found.pictures(pictures);
        Ok(())
    }

    /// Adds errors between texels, if f is known there.
    fn between(&self, found: &mut Findings, factors: &ProductFactors) {
        let limit = self.sampling.limit;
        let Some(errors) = self.subject.with_product(|product| ProductErrors::between_texels(product, limit, factors))
        else {
            return;
        };
        let mut table = Table::of(
            "Errors against f itself, at 1,024 x 1,024 directions between texels",
            "terms relative_squared_error rms max least below_0_%",
        );
        table.push([
            factors.terms().into(),
            Cell::error(errors.relative_squared_error),
            Cell::error(errors.rms),
            Cell::error(errors.max),
            Cell::measured(errors.least),
            Cell::percent(100.0 * errors.negative),
        ]);
        found.table(FoundTable::from(table).csv("between").field("between_texels"));
    }

    /// Directional albedo, the reflected fraction of uniform light: a white furnace test.
    fn albedos(&self, table: &ProductTable, factors: &ProductFactors) -> Table {
        let mut rows =
            Table::of("Directional albedo: light of radiance 1 from everywhere", "view_degrees f table terms");
        let rule = DirectionRule::hemisphere(ALBEDO_DEGREE);
        let limit = self.sampling.limit;
        for degrees in [0.0_f64, 30.0, 45.0, 60.0, 75.0] {
            let [z, x] = crate::elementary::on_circle(degrees / 360.0);
            let view = DVec3::new(x, 0.0, z);
            let formula =
                self.subject.with_product(|product| rule.integral(|light| product.value(view, light).min(limit)));
            rows.push([
                degrees.into(),
                formula.map_or(Cell::Empty, Cell::measured),
                Cell::measured(rule.integral(|light| table.interpolated(view, light))),
                Cell::measured(rule.integral(|light| factors.product(view, light))),
            ]);
        }
        rows
    }
}

//! Runs on reduced models, and their rows as a record judges them.

use std::rc::Rc;

use super::error::StaleRecord;
use super::file::{EntryRecord, RecordedRow};
use super::inputs::RecordInputs;
use super::status::RecordStatus;
use crate::split::KeptResults;
use crate::study::reproduce::shared::Shared;
use crate::study::reproduce::{
    EntryFindings, ModelSize, PaperRow, Prose, ReproduceEntry, RowSource, StudyError, Sweep,
};

/// Run of an entry on reduced models, with the inputs of a run at full size.
#[derive(Debug)]
pub struct SmokeRun {
    entry: ReproduceEntry,
    inputs: RecordInputs,
    found: EntryFindings,
}

impl SmokeRun {
    /// Runs an entry on reduced models.
    pub(super) fn new(entry: &ReproduceEntry, shared: &Shared) -> Result<Self, StudyError> {
        let inputs = RecordInputs::of(entry, shared)?.unwrap_or_default();
        Ok(Self { entry: *entry, inputs, found: entry.run(shared)? })
    }

    /// Runs an entry alone on reduced models; `None` for an entry whose rows do not depend on the size of models.
    ///
    /// # Errors
    /// Those of the entry.
    pub fn of(entry: &ReproduceEntry) -> Result<Option<Self>, StudyError> {
        let run = || Self::new(entry, &Shared::new(ModelSize::Reduced));
        entry.is_sized().then(run).transpose()
    }

    /// Runs the entry at full size, and records it. Finished pieces of entries that take hours are kept, and taken.
    ///
    /// # Errors
    /// Those of the entry, and of a folder in which pieces cannot be kept.
    pub fn record(&self, kept: Rc<KeptResults>) -> Result<EntryRecord, StudyError> {
        let full = self.entry.run(&Shared::new(ModelSize::Printed).keeping(Some(kept)))?;
        Ok(EntryRecord::new(self.entry.id, self.inputs.clone(), (&full, &self.found)))
    }

    /// Reason why a record is of another program.
    pub fn stale(&self, record: &EntryRecord) -> Option<StaleRecord> {
        record.inputs.stale(&self.inputs).or_else(|| judged(record, self.found.clone()).err())
    }

    /// Findings with the values, sentences and tables of a record; without one, or with one of another program, those
    /// of the reduced models, which judge nothing.
    pub fn judged_by(self, record: Option<&EntryRecord>) -> EntryFindings {
        let restored = record.map(|record| {
            let stale = record.inputs.stale(&self.inputs);
            stale.map_or_else(|| judged(record, self.found.clone()), Err)
        });
        match restored.transpose() {
            Ok(Some(found)) => found,
            Ok(None) => reduced(self.found, None),
            Err(stale) => reduced(self.found, Some(stale)),
        }
    }
}

fn reduced(mut found: EntryFindings, stale: Option<StaleRecord>) -> EntryFindings {
    found.rows.iter_mut().for_each(|row| row.source = RowSource::Reduced);
    EntryFindings { record: Some(RecordStatus::Reduced(stale)), ..found }
}

/// Findings on reduced models with the record's values, or why the record is not of this program.
fn judged(record: &EntryRecord, found: EntryFindings) -> Result<EntryFindings, StaleRecord> {
    let rows = rows(record, &found.rows)?;
    let text = sentences(record, &found.text)?;
    Ok(EntryFindings {
        rows,
        text,
        tables: record.tables(),
        record: Some(RecordStatus::Recorded(record.made().clone())),
        ..found
    })
}

/// The record's rows in the order of the run's, and explained by its sweeps.
fn rows(record: &EntryRecord, smaller: &[PaperRow]) -> Result<Vec<PaperRow>, StaleRecord> {
    let names = |names: &mut dyn Iterator<Item = &str>| names.collect::<Vec<_>>().join(", ");
    let [recorded, found] = [
        names(&mut record.row.iter().map(|row| row.figure.as_str())),
        names(&mut smaller.iter().map(|row| row.target.id.as_str())),
    ];
    if recorded != found {
        return Err(StaleRecord::of_structure("rows", &recorded, &found));
    }
    let value = |(row, recorded): (&PaperRow, &RecordedRow)| {
        let found: Vec<f64> = row.values().collect();
        if !same_bits(&found, &recorded.reduced) {
            return Err(StaleRecord::of_values(&recorded.figure, &recorded.reduced, &found));
        }
        let source = RowSource::Recorded { reduced: row.ours };
        Ok(row.clone().with_values(recorded.ours, recorded.readings.clone(), source))
    };
    let mut rows = smaller.iter().zip(&record.row).map(value).collect::<Result<Vec<_>, _>>()?;
    for recorded in &record.sweep {
        let of_row = |row: &PaperRow| row.swept().iter().find(|applied| applied.name == recorded.name).cloned();
        let of_record = format!("{} of {}", recorded.name, recorded.figures.join(", "));
        let structure = |found: &str| StaleRecord::of_structure("sweeps", &of_record, found);
        let applied = smaller.iter().find_map(of_row).ok_or_else(|| structure("none of this name"))?;
        if applied.figures != recorded.figures {
            return Err(structure(&applied.figures.join(", ")));
        }
        let sweep = Sweep { name: applied.name, parameter: applied.parameter, settings: recorded.setting.clone() };
        sweep.explain(rows.iter_mut().filter(|row| applied.figures.contains(&row.target.id)));
    }
    Ok(rows)
}

/// The run's sentences with the record's numbers.
fn sentences(record: &EntryRecord, text: &[Prose]) -> Result<Vec<Prose>, StaleRecord> {
    let counts = |counts: &mut dyn Iterator<Item = usize>| {
        let counts: Vec<String> = counts.map(|count| count.to_string()).collect();
        counts.join(", ")
    };
    let [recorded, found] = [
        counts(&mut record.text.iter().map(Vec::len)),
        counts(&mut text.iter().map(|paragraph| paragraph.figures().len())),
    ];
    if recorded != found {
        return Err(StaleRecord::of_structure("numbers in its paragraphs", &recorded, &found));
    }
    let numbers = record.text.iter().cloned();
    Ok(text.iter().zip(numbers).map(|(paragraph, numbers)| Prose::new(paragraph.template(), numbers)).collect())
}

/// Findings of a run at full size, whose rows are held against those of a record.
pub(super) fn compared(record: Option<&EntryRecord>, mut found: EntryFindings) -> EntryFindings {
    let Some(record) = record else { return EntryFindings { record: Some(RecordStatus::New), ..found } };
    let source = |row: &PaperRow| match record.row.iter().find(|recorded| recorded.figure == row.target.id) {
        None => RowSource::Computed,
        Some(recorded) => {
            let values: Vec<f64> = std::iter::once(recorded.ours).chain(recorded.readings.iter().copied()).collect();
            let same = same_bits(&row.values().collect::<Vec<_>>(), &values);
            if same { RowSource::Confirmed } else { RowSource::Differs { recorded: recorded.ours } }
        }
    };
    found.rows.iter_mut().for_each(|row| row.source = source(row));
    let differ = found.rows.iter().filter(|row| row.differs()).count();
    EntryFindings { record: Some(RecordStatus::Computed { made: record.made().clone(), differ }), ..found }
}

/// Returns `true` if numbers have the same bits; one NaN is as good as another.
fn same_bits(some: &[f64], others: &[f64]) -> bool {
    let same = |(one, other): (&f64, &f64)| one.to_bits() == other.to_bits() || (one.is_nan() && other.is_nan());
    some.len() == others.len() && some.iter().zip(others).all(same)
}

#[cfg(test)]
mod tests {
    use super::super::error::RecordError;
    use super::super::status::RecordMade;
    use super::*;
    use crate::report::{Cell, Table};
    use crate::study::reproduce::row::tests::{row, target};
    use crate::study::reproduce::{Paper, RowVerdict, Setting};

    /// Findings whose rows are 1 and 2 times `value`, the second explained by a sweep that reaches what is printed.
    fn found(value: f64, points: &str) -> EntryFindings {
        let second = crate::study::reproduce::PaperFigure { id: "p/second".to_owned(), ..target(15.6, 1) };
        let mut rows = vec![row(value).with_readings([value, value / 3.0]), row(value * 2.0)];
        rows[1].target = second;
        let settings = vec![Setting { at: points.to_owned(), values: vec![15.0, value / 2.0] }];
        Sweep { name: "sizes", parameter: "size", settings }.explain(&mut rows);
        let mut table = Table::of("Points", "points error");
        table.push([points.into(), Cell::measured(value / 7.0).marked("*")]);
        let text = vec![Prose::new("Of {} points", [points.to_owned()])];
        EntryFindings { rows, text, tables: vec![table], questions: vec!["which?"], ..EntryFindings::default() }
    }

    fn entry() -> ReproduceEntry {
        Paper::BiScale.entry("bi-scale-figure-8", "A figure", |_| Ok(EntryFindings::default()))
    }

    fn smoke(value: f64) -> SmokeRun {
        let inputs = RecordInputs::default();
        SmokeRun { entry: entry(), inputs, found: found(value, "9") }
    }

    fn record() -> EntryRecord {
        let made = RecordMade {
            command: "crossbar reproduce bi-scale-figure-8 --full-size".to_owned(),
            version: "0.1.0".to_owned(),
            commit: "8a205f4a1".to_owned(),
            processor_s: Some(812.5),
            wall_s: 500.25,
        };
        let record = EntryRecord::new(entry().id, RecordInputs::default(), (&found(31.2, "10,000"), &found(1.0, "9")));
        record.made_by(made)
    }

    /// A record gives the findings of the run at full size again. Verdicts follow from bounds and are not in the file.
    #[test]
    fn records_round_trip() {
        let text = record().text().expect("a file");
        assert_eq!(EntryRecord::parse(entry().id, &text), Ok(record()));
        assert_eq!(EntryRecord::parse(entry().id, &text.replace('\n', "\r\n")), Ok(record()));
        assert!(!text.contains("missed") && !text.contains("explained"), "no verdict is stored: {text}");
        let judged = smoke(1.0).judged_by(Some(&record()));
        let full = found(31.2, "10,000");
        assert_eq!((&judged.text, &judged.tables, &judged.questions), (&full.text, &full.tables, &full.questions));
        let of = |found: &EntryFindings| -> Vec<_> {
            found
                .rows
                .iter()
                .map(|row| (row.ours, row.readings.clone(), row.verdict(), row.explanation().cloned()))
                .collect()
        };
        assert_eq!(of(&judged), of(&full));
        assert_eq!(judged.rows[1].verdict(), RowVerdict::Explained);
        assert!(judged.rows.iter().zip([1.0, 2.0]).all(|(row, reduced)| row.source == RowSource::Recorded { reduced }));
    }

    #[test]
    fn a_value_that_was_changed_by_hand_is_refused() {
        let text = record().text().expect("a file");
        for (from, to) in [("31.2", "15.6"), ("812.5", "81.25"), ("10,000", "10,001")] {
            let edited = text.replace(from, to);
            assert!(
                edited != text && matches!(EntryRecord::parse(entry().id, &edited), Err(RecordError::Edited { .. }))
            );
        }
        assert!(matches!(EntryRecord::parse("cpca-figure-2", &text), Err(RecordError::Entry { .. })));
        for text in ["", "digest = \"\"\n", "entry = \"bi-scale-figure-8\"\n"] {
            let refused = EntryRecord::parse(entry().id, text);
            assert!(matches!(refused, Err(RecordError::Malformed { .. } | RecordError::Edited { .. })), "{text}");
        }
    }

    /// Another value on reduced models, another row, another number in a paragraph, other inputs.
    #[test]
    fn a_record_of_another_program_is_stale_and_judges_nothing() {
        let mut fewer = smoke(1.0);
        fewer.found.rows.pop();
        let mut words = smoke(1.0);
        words.found.text.clear();
        for other in [smoke(1.0_f64.next_up()), fewer, words] {
            let stale = other.stale(&record()).expect("stale");
            let found = other.judged_by(Some(&record()));
            assert_eq!(found.record, Some(RecordStatus::Reduced(Some(stale))));
            assert!(found.rows.iter().all(|row| row.verdict() == RowVerdict::Reduced));
        }
        assert_eq!(smoke(1.0).stale(&record()), None);
        assert_eq!(smoke(1.0).judged_by(None).record, Some(RecordStatus::Reduced(None)));
    }

    #[test]
    fn a_run_at_full_size_is_held_against_its_record() {
        let sources = |value: f64| -> Vec<_> {
            compared(Some(&record()), found(value, "10,000")).rows.iter().map(|row| row.source).collect()
        };
        assert_eq!(sources(31.2), [RowSource::Confirmed; 2]);
        assert_eq!(sources(31.0)[0], RowSource::Differs { recorded: 31.2 });
        assert_eq!(compared(None, found(31.2, "")).record, Some(RecordStatus::New));
    }
}

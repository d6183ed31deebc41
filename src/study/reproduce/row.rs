//! A printed figure beside what the models give.

/// Pipeline figures may differ by so much from a printed one that they were not calibrated on.
pub const TOLERANCE: f64 = 0.15;

/// A figure as a paper prints it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Printed {
    /// The value, in units of `unit`.
    pub value: f64,
    /// Digits behind the point, as printed.
    pub decimals: usize,
    /// The unit.
    pub unit: &'static str,
    /// Where it stands.
    pub place: &'static str,
}

impl Printed {
    /// Whether `value` reads as printed, rounded to as many digits.
    pub fn reads(&self, value: f64) -> bool {
        let scale = (0..self.decimals).fold(1.0, |scale: f64, _| scale * 10.0);
        let digits = |v: f64| (v * scale).round();
        digits(value) == digits(self.value)
    }
}

/// What a model gives for a printed figure.
#[derive(Clone, Debug, PartialEq)]
pub struct Modelled {
    /// The value, in the unit of the printed one.
    pub value: f64,
    /// The printed figures that went into it, if this one is among them: agreement then says nothing.
    pub calibrated_on: Option<&'static str>,
}

impl Modelled {
    /// A value that this figure had no part in.
    pub const fn predicted(value: f64) -> Option<Self> {
        Some(Self { value, calibrated_on: None })
    }

    /// A value that follows from the figure itself.
    pub const fn calibrated(value: f64, on: &'static str) -> Option<Self> {
        Some(Self { value, calibrated_on: Some(on) })
    }
}

/// How a model stands to a printed figure.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Judgement {
    /// The model says nothing of it.
    Silent,
    /// Equal in every digit that is printed.
    Reproduced,
    /// Inside [`TOLERANCE`].
    Near,
    /// The figure is an input of the model, or chose one of its constants.
    Calibrated,
    /// Outside, and the row says why and what would have to be known.
    Explained,
    /// Outside.
    Missed,
}

impl Judgement {
    /// One word for tables.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Silent => "-",
            Self::Reproduced => "reproduced",
            Self::Near => "near",
            Self::Calibrated => "calibrated",
            Self::Explained => "explained",
            Self::Missed => "missed",
        }
    }
}

/// A printed figure with both models' values.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// What is measured.
    pub what: String,
    /// The card.
    pub device: &'static str,
    /// As printed.
    pub printed: Printed,
    /// From printed or measured rates alone.
    pub rates: Option<Modelled>,
    /// From first principles.
    pub pipeline: Option<Modelled>,
    /// Why a value is off, and what would have to be known.
    pub note: String,
}

impl Row {
    /// The difference of both in units of the smaller: the same for twice as much and half as much.
    pub fn symmetric_error(&self, value: f64) -> f64 {
        (value - self.printed.value) / value.min(self.printed.value)
    }

    /// The rates model: it has to give every printed digit.
    pub fn judge_rates(&self) -> Judgement {
        self.judge(self.rates.as_ref(), |value| self.printed.reads(value), Judgement::Reproduced)
    }

    /// The pipeline model: it has to come near.
    pub fn judge_pipeline(&self) -> Judgement {
        if self.pipeline.as_ref().is_some_and(|p| p.calibrated_on.is_none() && self.printed.reads(p.value)) {
            return Judgement::Reproduced;
        }
        let near = |value: f64| self.symmetric_error(value).abs() <= TOLERANCE;
        self.judge(self.pipeline.as_ref(), near, Judgement::Near)
    }

    fn judge(&self, model: Option<&Modelled>, holds: impl Fn(f64) -> bool, held: Judgement) -> Judgement {
        match model {
            None => Judgement::Silent,
            Some(Modelled { calibrated_on: Some(_), .. }) => Judgement::Calibrated,
            Some(model) if holds(model.value) => held,
            Some(_) if !self.note.is_empty() => Judgement::Explained,
            Some(_) => Judgement::Missed,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(value: f64, note: &str) -> Row {
        Row {
            what: "tests".to_owned(),
            device: "nv20",
            printed: Printed { value: 15.6, decimals: 1, unit: "M/s", place: "section 6.1" },
            rates: Modelled::predicted(value),
            pipeline: Modelled::predicted(value),
            note: note.to_owned(),
        }
    }

    #[test]
    fn digits_are_compared_as_printed() {
        assert_eq!(row(15.625, "").judge_rates(), Judgement::Reproduced);
        assert_eq!(row(15.66, "").judge_rates(), Judgement::Missed);
        assert_eq!(row(15.66, "scanned badly").judge_rates(), Judgement::Explained);
    }

    #[test]
    fn the_error_is_symmetric() {
        assert_eq!(row(31.2, "").symmetric_error(31.2), 1.0);
        assert_eq!(row(7.8, "").symmetric_error(7.8), -1.0);
        assert_eq!(row(15.6 * 1.14, "").judge_pipeline(), Judgement::Near);
        assert_eq!(row(15.6 / 1.14, "").judge_pipeline(), Judgement::Near);
        assert_eq!(row(15.6 / 1.16, "").judge_pipeline(), Judgement::Missed);
    }

    #[test]
    fn a_calibrated_value_proves_nothing() {
        let circular = Row { rates: Modelled::calibrated(15.6, "itself"), ..row(1.0, "") };
        assert_eq!(circular.judge_rates(), Judgement::Calibrated);
    }
}

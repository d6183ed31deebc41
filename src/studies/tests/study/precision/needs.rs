//! Bits that a format and an instruction need, for a subject with given values.

use std::cell::RefCell;
use std::collections::BTreeSet;
use std::rc::Rc;

use crossbar_base::elementary::pow;
use crossbar_studies::study::StudyError;
use crossbar_studies::study::precision::{Goal, Measured, PrecisionMeasure, StudiedProgram};
use proptest::prelude::*;

use super::*;

const MEASURE: &str = "largest_absolute";

/// Values of the measure by the formats of the two instructions; `None` is the exact format.
type Values = Box<dyn Fn([Option<Layout>; 2]) -> f64>;

/// Case of two moves with given values.
struct Told {
    case: CaseSubject,
    goal: String,
    family: FormatFamily,
    values: Values,
    /// Formats of all runs so far.
    seen: Rc<RefCell<BTreeSet<[Option<String>; 2]>>>,
}

impl Told {
    fn new(family: FormatFamily, goal: &str, values: impl Fn([Option<Layout>; 2]) -> f64 + 'static) -> Self {
        Self {
            case: subject(&case("mov r0, c0", "c0 = [1, 1, 1, 1]")),
            goal: format!("{MEASURE}{goal}"),
            family,
            values: Box::new(values),
            seen: Rc::default(),
        }
    }

    /// Subject that needs a format with at least these bits of range and of precision in every instruction.
    fn minimum(text: &str) -> Self {
        let least = Layout::of(text);
        let misses = move |format: Layout| format.range < least.range || format.digits < least.digits;
        Self::new(least.family, "=0", move |formats| f64::from(u8::from(formats.into_iter().flatten().any(misses))))
    }

    /// Subject whose exact value meets the goal. With both instructions in a format of less than 8 digits, the value is
    /// `both`; with only one, it is that instruction's value in `alone`.
    fn shares(goal: &str, exact: f64, both: f64, alone: [f64; 2]) -> Self {
        Self::new(FormatFamily::Float, goal, move |formats| {
            match formats.map(|format| format.is_some_and(|format| format.digits < 8)) {
                [false, false] => exact,
                [true, false] => alone[0],
                [false, true] => alone[1],
                [true, true] => both,
            }
        })
    }

    /// Subject with values by number of digits, starting at 1; the last value holds for all larger numbers.
    fn curve(values: &'static [f64]) -> Self {
        Self::new(FormatFamily::Float, "<=1", move |formats| {
            let value = |format: Layout| values[usize::from(format.digits).min(values.len()) - 1];
            formats.into_iter().flatten().map(value).fold(0.0, f64::max)
        })
    }

    fn study(self) -> Precision {
        let (goal, family) = (self.goal.clone(), self.family);
        study_of(Box::new(self), &goal, &[family])
    }
}

impl PrecisionSubject for Told {
    fn title(&self) -> String {
        self.case.title()
    }

    fn profile(&self) -> &Profile {
        self.case.profile()
    }

    fn programs(&self) -> Vec<StudiedProgram<'_>> {
        self.case.programs()
    }

    fn measures(&self) -> &[PrecisionMeasure] {
        self.case.measures()
    }

    fn default_goal(&self) -> Goal {
        self.case.default_goal()
    }

    fn measure(&self, profile: &Profile, _: Option<&str>) -> Result<Measured, StudyError> {
        let formats: Vec<_> = profile.instruction_formats().iter().flat_map(|(_, formats)| formats).collect();
        let text = |at: usize| {
            let (_, format) = formats.iter().find(|(index, _)| **index == at)?;
            Some(format.to_string().split(':').next().expect("a layout").to_owned())
        };
        let texts = [text(0), text(1)];
        let value = (self.values)(texts.each_ref().map(|text| text.as_deref().map(Layout::of)));
        self.seen.borrow_mut().insert(texts);
        Ok(Measured { values: vec![(MEASURE, value)], ..Measured::default() })
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// The study finds the fewest bits of a family, whatever they are, as a format of the emulator and as a device
    /// file. Each refuted format has one bit less, and nothing is narrower than the narrowest format. Fixed point keeps
    /// two spare integer bits.
    #[test]
    fn the_fewest_bits_are_found((is_float, range, digits) in (any::<bool>(), 0..=8_u8, 0..=23_u8)) {
        let minimum = if is_float {
            Layout { family: FormatFamily::Float, range: range.max(2), digits: digits.max(1) }
        } else {
            Layout { family: FormatFamily::Fixed, range, digits: digits.min(29 - range).max(u8::from(range == 0)) }
        };
        let text = minimum.to_string();
        let study = Told::minimum(&text).study();
        let document = document(&study);
        prop_assert_eq!(&document["families"][0]["minimum"], &text);
        let name = if is_float { "float" } else { "fixed" };
        let format: Format = text.parse().expect("a format");
        prop_assert_eq!(texts(&document, &format!("mixed_{name}"), "format"), [&*text; 2]);
        prop_assert_eq!(column(&document, &format!("mixed_{name}"), "bits"), [format.width(); 2]);
        for (_, formats) in mixed_device(&study).instruction_formats().iter() {
            prop_assert!(formats.values().all(|own| *own == format));
        }
        let points = texts(&document, "curve", "format").into_iter().zip(column(&document, "curve", "bits"));
        for (point, width) in points {
            prop_assert_eq!(point.parse::<Format>().expect("a format").width(), width.as_u64().expect("bits") as u32);
        }
        let less = minimum.narrower();
        prop_assert_eq!(texts(&document, &format!("refuted_{name}"), "format"), [&*less, &*less].concat());
        for less in less {
            prop_assert_eq!(less.parse::<Format>().expect("a format").width() + 1, format.width());
        }
    }
}

#[test]
fn rules_of_a_card_are_kept_within_its_family() {
    for (minimum, expected) in [("e4m3", "e4m3:rtz:nvovf:ftz"), ("s4.3", "s4.3:rtz")] {
        let text = case("mov r0, c0", "c0 = [1, 1, 1, 1]").replace("fp32", "e5m10:rtz:ftz:nvovf");
        let study = Told { case: subject(&text), ..Told::minimum(minimum) }.study();
        let device = mixed_device(&study);
        let found: Vec<String> =
            device.instruction_formats().iter().flat_map(|(_, own)| own.values()).map(Format::to_string).collect();
        assert_eq!(found, [expected; 2]);
    }
}

/// A few runs find the fewest bits of all instructions together; bisection finds the fewest bits of one instruction.
#[test]
fn a_falling_error_is_bisected() {
    for smallest in 1..=23_u8 {
        let told = Told::new(FormatFamily::Float, "<=1", move |formats| {
            let value = |format: Layout| 1.5 * pow(2.0, f64::from(smallest) - f64::from(format.digits) - 1.0);
            formats.into_iter().flatten().map(value).fold(0.0, f64::max)
        });
        let seen = Rc::clone(&told.seen);
        let document = document(&told.study());
        let family = &document["families"][0];
        assert_eq!((digits(&family["minimum"]), &family["counterexample"]), (Some(smallest), &Value::Null));
        assert!(column(&document, "curve", "format").len() <= 13);
        assert_eq!(column(&document, "instructions_float", "alone"), [smallest; 2]);
        // One additional run is for the blame.
        let alone = seen.borrow().iter().filter(|formats| formats[0].is_some() && formats[1].is_none()).count();
        assert!(alone <= 7 + 1, "{alone} runs");
    }
    assert_eq!(document(&Told::curve(&[4.0, 3.0, 2.0]).study())["families"][0]["minimum"], Value::Null);
}

#[test]
fn a_rising_error_is_scanned_and_named() {
    let family = |values: &'static [f64]| {
        let document = document(&Told::curve(values).study());
        let family = &document["families"][0];
        let points = column(&document, "curve", "format").len();
        (digits(&family["minimum"]), family["counterexample"].clone(), points)
    };
    assert_eq!(family(&[9.0, 0.5, 3.0, 0.5, 0.25, 0.0]), (Some(4), serde_json::json!([2, 3]), 23));
    // All numbers of bits from 2 on meet the goal, although one is worse than a smaller number.
    assert_eq!(family(&[9.0, 0.5, 0.75, 0.5]).0, Some(2));
    // The largest number of bits is worse than all others.
    const LAST: [f64; 23] = {
        let mut values = [0.0; 23];
        values[22] = 9.0;
        values
    };
    assert_eq!(family(&LAST).0, None);
}

/// Losses are relative to the exact run, and shares are relative to the loss of both instructions together.
#[test]
fn losses_are_against_the_exact_run() {
    let blame = |told: Told| {
        let document = document(&told.study());
        assert_eq!(document["families"][0]["minimum"], "e2m8");
        ["blame_percent", "regained_percent"]
            .map(|key| column(&document, "instructions_float", key).into_iter().map(Value::as_f64).collect::<Vec<_>>())
    };
    let some = |shares: [f64; 2]| shares.map(Some).to_vec();
    assert_eq!(blame(Told::shares("<=1", 0.25, 1.25, [0.5, 0.0])), [some([25.0, 0.0]), some([100.0, 75.0])]);
    assert_eq!(blame(Told::shares(">=1", 1.0, 0.0, [0.5, 1.0])), [some([50.0, 0.0]), some([100.0, 50.0])]);
    assert_eq!(blame(Told::shares("=1", 1.0, 3.0, [0.5, 1.5])), [some([25.0, 25.0]), some([75.0, 75.0])]);
    // Only one value is not finite: its instruction has all of the loss, and the share of the other is unknown.
    let nan = blame(Told::shares("<=1", 0.0, f64::NAN, [f64::NAN, 0.5]));
    assert_eq!(nan, [vec![Some(100.0), None], some([100.0, 0.0])]);
    // Values that are already infinite in the exact run are not a loss.
    let infinite = blame(Told::shares(">=1", f64::INFINITY, 0.0, [f64::INFINITY, f64::INFINITY]));
    assert_eq!(infinite[0], some([0.0, 0.0]));
}

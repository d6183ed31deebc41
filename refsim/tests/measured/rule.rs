//! Rules of a card, their hypotheses, and the number of measured values that each predicts.

use super::CARDS;
use super::values::Values;
use refsim::device::{MeasuredCounts, Profile, Rules};
use refsim::machine::{Executor, ExecutorKind};

/// A question about a card, and the draws that answer it.
#[derive(Clone)]
pub(crate) struct Rule {
    /// Name of the rule, as the page shows it.
    pub(crate) name: &'static str,
    /// Files with the measured values, in `fixtures/measured`.
    pub(crate) data: &'static str,
    /// One measured value, in the singular: "swatch".
    pub(crate) unit: &'static str,
    /// The possible answers.
    pub(crate) hypotheses: Hypotheses,
    /// Draws all rows on a device.
    pub(crate) redraw: Redraw,
    /// Number of values that the cards' own setting does not predict; the page gives the reason.
    pub(crate) unexplained: usize,
    /// `true` if the cards' own setting is settled: it predicts the most values, all but the unexplained ones.
    pub(crate) settled: bool,
    /// The open points; empty if there are none.
    pub(crate) open: &'static str,
}

/// A device's results for all measured values.
pub(crate) type Redraw = fn(&Profile, &Executor) -> Values;

/// A hypothesis of a rule by its name, and its setting.
pub(crate) type RuleOption = (&'static str, fn(&mut Rules));

/// The hypotheses of a rule. The cards' own hypothesis is their profile's setting.
#[derive(Clone, Copy)]
pub(crate) enum Hypotheses {
    /// The values of a switch of the cards.
    Switch(&'static str),
    /// Names of settings, the cards' own first, and the change that each makes.
    Options(&'static [RuleOption]),
    /// The name of the cards' own setting; and hypotheses that no device setting expresses, each with a function that
    /// computes its results.
    Computed(&'static str, &'static [(&'static str, Redraw)]),
}

pub(crate) struct Measured {
    pub(crate) rule: Rule,
    /// Hypotheses, the cards' own first, and the results of each for all values.
    pub(crate) values: Vec<(String, Values)>,
}

impl Rule {
    /// The chip: the folder name of the files, in capitals.
    fn chip(&self) -> String {
        self.data.split('/').next().unwrap_or_default().to_uppercase()
    }

    /// Names of the hypotheses, each with a card that has this setting and the function that draws the values; the
    /// card's own hypothesis is first.
    fn ways(&self, card: &Profile) -> Vec<(String, Profile, Redraw)> {
        match self.hypotheses {
            Hypotheses::Switch(name) => {
                let switch = card.switches().iter().find(|switch| switch.name == name).expect("a switch of the card");
                let others = switch.values.iter().filter(|value| **value != switch.default);
                let values = std::iter::once(&switch.default).chain(others);
                let device = |value: &String| {
                    let mut device = card.clone();
                    device.set_switch(name, value).expect("a value of the switch");
                    (value.clone(), device, self.redraw)
                };
                values.map(device).collect()
            }
            Hypotheses::Options(options) => {
                let device = |(name, change): &(&str, fn(&mut Rules))| {
                    let mut device = card.clone();
                    change(&mut device.rules);
                    ((*name).to_owned(), device, self.redraw)
                };
                options.iter().map(device).collect()
            }
            Hypotheses::Computed(own, others) => {
                let all = std::iter::once((own, self.redraw)).chain(others.iter().copied());
                all.map(|(name, redraw)| (name.to_owned(), card.clone(), redraw)).collect()
            }
        }
    }
}

impl Measured {
    /// Draws the rows of a rule under each hypothesis on the executors of the host, and on all cards with their own
    /// setting. Panics if executors or cards disagree, or if a settled rule is not the best of its hypotheses.
    pub(crate) fn of(rule: Rule) -> Self {
        let [host, batch] = [ExecutorKind::Scalar, ExecutorKind::Batch].map(Executor::from);
        let [first, others @ ..] = CARDS.map(|card| Profile::named(card).expect("a card"));
        let ways = rule.ways(&first);
        assert_eq!(ways[0].1.rules, first.rules, "{}: the first hypothesis is the card's own", rule.name);
        let values: Vec<(String, Values)> = ways
            .into_iter()
            .map(|(hypothesis, device, redraw)| {
                let values = redraw(&device, &host);
                assert!(redraw(&device, &batch) == values, "{}, {hypothesis}: batch", rule.name);
                (hypothesis, values)
            })
            .collect();
        let (name, own) = &values[0];
        for card in others {
            for executor in [&host, &batch] {
                assert!((rule.redraw)(&card, executor) == *own, "{}: {}", rule.name, card.name);
            }
        }
        assert!(own.all() > 0 && values.iter().all(|(_, values)| values.all() == own.all()), "{}: values", rule.name);
        if rule.settled {
            assert_eq!(own.right() + rule.unexplained, own.all(), "{}: {name} predicts", rule.name);
            for (hypothesis, values) in &values[1..] {
                assert!(values.right() < own.right(), "{}: {hypothesis} predicts {}", rule.name, values.right());
            }
        }
        Self { values, rule }
    }

    /// Name of the cards' own setting, and the number of values.
    pub(crate) fn own(&self) -> (&str, usize) {
        let (name, values) = &self.values[0];
        (name, values.all())
    }

    /// Panics if the figure of a settled switch does not state the counts.
    pub(crate) fn stands_in_the_profiles(&self) {
        let Hypotheses::Switch(name) = self.rule.hypotheses else { return };
        if !self.rule.settled {
            return;
        }
        let mut right: Vec<_> =
            self.values.iter().map(|(name, values)| (name.clone(), values.right() as u64)).collect();
        right.sort_by_key(|(_, right)| std::cmp::Reverse(*right));
        let expected = MeasuredCounts { of: self.rule.chip(), all: self.own().1 as u64, right };
        for card in CARDS {
            let figures = Profile::named(card).expect("a card").figures();
            let figure = figures.into_iter().find(|row| row.key == format!("rules.{name}")).expect("a figure");
            let found = figure.counts.map(|counts| counts.to_string()).unwrap_or_default();
            assert_eq!(found, expected.to_string(), "{card}, {name}: counts of the profile");
        }
    }
}

/// Draws the cards' own settings on a GPU of the host.
#[cfg(feature = "wgpu")]
pub(crate) fn an_adapter_draws_what_the_host_draws(gpu: &std::sync::Arc<refsim::exec::gpu::Gpu>) {
    let (card, gpu) = (Profile::named(CARDS[0]).expect("a card"), Executor::Gpu { gpu: std::sync::Arc::clone(gpu) });
    for rule in super::topics() {
        let expected = (rule.redraw)(&card, &ExecutorKind::Scalar.into());
        assert!((rule.redraw)(&card, &gpu) == expected, "{}", rule.name);
    }
}

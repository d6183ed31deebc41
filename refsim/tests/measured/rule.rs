//! Rules of a card, their hypotheses, and how many measured values each of them predicts.

use super::CARDS;
use refsim::device::{MeasuredCounts, Profile, Rules};
use refsim::machine::{Executor, ExecutorKind};
use std::ops::AddAssign;

/// A question about a card, and the draws that answer it.
#[derive(Clone)]
pub(crate) struct Rule {
    /// Name of the rule, as the page shows it.
    pub(crate) name: &'static str,
    /// The files with the measured values, in `fixtures/measured`.
    pub(crate) data: &'static str,
    /// One measured value, in the singular: "swatch".
    pub(crate) unit: &'static str,
    /// The possible answers.
    pub(crate) hypotheses: Hypotheses,
    /// Draws all rows on a device and compares them.
    pub(crate) redraw: fn(&Profile, &Executor) -> Count,
    /// Number of values that the cards' own answer does not predict; the page says why.
    pub(crate) unexplained: usize,
    /// `true` if the cards' own answer is settled: it predicts all but the unexplained values, and more than any other.
    pub(crate) settled: bool,
    /// What remains open; empty if nothing does.
    pub(crate) open: &'static str,
}

impl Rule {
    /// The chip, which is the folder of the files.
    fn chip(&self) -> String {
        self.data.split('/').next().unwrap_or_default().to_uppercase()
    }
}

/// An answer of a rule by its name, and what sets it.
pub(crate) type RuleOption = (&'static str, fn(&mut Rules));

/// The answers to a rule. The cards' own answer is what their profile says.
#[derive(Clone, Copy)]
pub(crate) enum Hypotheses {
    /// The values of a switch of the cards.
    Switch(&'static str),
    /// Names of answers, the cards' own first, and what each one changes.
    Options(&'static [RuleOption]),
}

/// Number of values compared and of those that were right.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Count {
    pub(crate) right: usize,
    pub(crate) all: usize,
}

impl Count {
    /// Counts one value.
    pub(crate) fn add(&mut self, right: bool) {
        *self += Self { right: right.into(), all: 1 };
    }
}

impl AddAssign for Count {
    fn add_assign(&mut self, other: Self) {
        self.right += other.right;
        self.all += other.all;
    }
}

/// A rule with its counts.
pub(crate) struct Measured {
    pub(crate) rule: Rule,
    /// The cards' own answer, which is the name of one of the hypotheses.
    pub(crate) own: String,
    /// Hypotheses and the number of values that each predicts.
    pub(crate) right: Vec<(String, usize)>,
    /// Number of values.
    pub(crate) all: usize,
}

impl Hypotheses {
    /// Names, and a card with each of them; the card's own answer comes first.
    fn devices(self, card: &Profile) -> Vec<(String, Profile)> {
        match self {
            Self::Switch(name) => {
                let switch = card.switches().iter().find(|switch| switch.name == name).expect("a switch of the card");
                let others = switch.values.iter().filter(|value| **value != switch.default);
                let values = std::iter::once(&switch.default).chain(others);
                let device = |value: &String| {
                    let mut device = card.clone();
                    device.set_switch(name, value).expect("a value of the switch");
                    (value.clone(), device)
                };
                values.map(device).collect()
            }
            Self::Options(options) => {
                let device = |(name, change): &(&str, fn(&mut Rules))| {
                    let mut device = card.clone();
                    change(&mut device.rules);
                    ((*name).to_owned(), device)
                };
                options.iter().map(device).collect()
            }
        }
    }
}

impl Measured {
    /// Draws the rows of a rule under each hypothesis on the executors of the host, on all cards with their own answer.
    /// Panics where executors or cards disagree, or where a settled rule is not the best of its hypotheses.
    pub(crate) fn of(rule: Rule) -> Self {
        let [host, batch] = [ExecutorKind::Scalar, ExecutorKind::Batch].map(Executor::from);
        let [first, others @ ..] = CARDS.map(|card| Profile::named(card).expect("a card"));
        let devices = rule.hypotheses.devices(&first);
        assert_eq!(devices[0].1.rules, first.rules, "{}: the first hypothesis is the card's own", rule.name);
        let counts: Vec<(String, Count)> = devices
            .into_iter()
            .map(|(hypothesis, device)| {
                let count = (rule.redraw)(&device, &host);
                assert_eq!((rule.redraw)(&device, &batch), count, "{}, {hypothesis}: batch", rule.name);
                (hypothesis, count)
            })
            .collect();
        let own = counts[0].1;
        for card in others {
            for executor in [&host, &batch] {
                assert_eq!((rule.redraw)(&card, executor), own, "{}: {}", rule.name, card.name);
            }
        }
        assert!(own.all > 0 && counts.iter().all(|(_, count)| count.all == own.all), "{}: values", rule.name);
        if rule.settled {
            assert_eq!(own.right + rule.unexplained, own.all, "{}: {} predicts", rule.name, counts[0].0);
            for (hypothesis, count) in &counts[1..] {
                assert!(count.right < own.right, "{}: {hypothesis} predicts {}", rule.name, count.right);
            }
        }
        let right = counts.iter().map(|(hypothesis, count)| (hypothesis.clone(), count.right)).collect();
        Self { own: counts[0].0.clone(), right, all: own.all, rule }
    }

    /// Panics if the figure of a settled switch does not have the counts.
    pub(crate) fn stands_in_the_profiles(&self) {
        let Hypotheses::Switch(name) = self.rule.hypotheses else { return };
        if !self.rule.settled {
            return;
        }
        let mut right: Vec<_> = self.right.iter().map(|(name, right)| (name.clone(), *right as u64)).collect();
        right.sort_by_key(|(_, right)| std::cmp::Reverse(*right));
        let expected = MeasuredCounts { of: self.rule.chip(), all: self.all as u64, right };
        for card in CARDS {
            let figures = Profile::named(card).expect("a card").figures();
            let figure = figures.into_iter().find(|row| row.key == format!("rules.{name}")).expect("a figure");
            let found = figure.counts.map(|counts| counts.to_string()).unwrap_or_default();
            assert_eq!(found, expected.to_string(), "{card}, {name}: counts of the profile");
        }
    }
}

/// The cards' own answers on a GPU of the host.
#[cfg(feature = "wgpu")]
pub(crate) fn an_adapter_draws_what_the_host_draws(gpu: &std::sync::Arc<refsim::exec::gpu::Gpu>) {
    let (card, gpu) = (Profile::named(CARDS[0]).expect("a card"), Executor::Gpu { gpu: std::sync::Arc::clone(gpu) });
    for rule in super::topics() {
        let expected = (rule.redraw)(&card, &ExecutorKind::Scalar.into());
        assert_eq!((rule.redraw)(&card, &gpu), expected, "{}", rule.name);
    }
}

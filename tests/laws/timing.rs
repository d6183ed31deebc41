//! Time and values are separate: no clock changes a pixel. (`tests/agree` checks that the log does not depend on the
//! executor.)

use crate::support::file;
use crossbar::case::{self, Setup};
use refsim::device::Profile;
use refsim::event::Event;
use refsim::machine::ExecutorKind;
use refsim::timing::{Level, Model};
use std::path::PathBuf;

fn cases() -> Vec<(PathBuf, Setup)> {
    let files = std::fs::read_dir(file("fixtures/cases")).expect("the cases");
    let mut paths: Vec<PathBuf> = files.map(|f| f.expect("a file").path()).collect();
    paths.retain(|p| p.extension().is_some_and(|e| e == "toml"));
    paths.sort();
    paths.into_iter().map(|p| (p.clone(), Setup::read(&p).unwrap_or_else(|e| panic!("{}: {e}", p.display())))).collect()
}

/// The device with every figure of the timing model multiplied or divided by a thousand.
fn absurd(profile: &Profile, up: bool) -> Profile {
    let mut out = profile.clone();
    for row in profile.figures() {
        let slot = match row.key.split_once('.') {
            Some(("rates", name)) => out.rates.figure_mut(name),
            Some(("bus", name)) => out.bus.figure_mut(name),
            _ => None,
        };
        if let Some(Some(value)) = slot {
            *value = if up { value.saturating_mul(1000) } else { (*value / 1000).max(1) };
        }
    }
    out.rates.instruction_clocks.values_mut().for_each(|clocks| *clocks *= if up { 1000 } else { 1 });
    out
}

#[test]
fn time_never_changes_a_pixel() {
    for (path, setup) in cases() {
        let Ok(model) = Model::new(Level::Pipeline, &setup.profile) else { continue };
        for executor in [ExecutorKind::Scalar, ExecutorKind::Batch] {
            let plain = case::run(&setup, executor).expect("the case draws");
            let log = case::log(&setup, executor).expect("the case draws");
            for up in [false, true] {
                let mut strange = setup.clone();
                strange.profile = absurd(&setup.profile, up);
                let found = case::run(&strange, executor).expect("the case draws");
                let bytes =
                    |o: &case::CaseOutcome| o.pictures.iter().map(|(_, bytes)| bytes.clone()).collect::<Vec<_>>();
                assert_eq!(bytes(&found), bytes(&plain), "{}: a pixel changed", path.display());
                assert!(case::log(&strange, executor).expect("the case draws") == log, "{}", path.display());
                // But time did change.
                let slow = Model::new(Level::Pipeline, &strange.profile).expect("all figures are there");
                let differs = log.iter().any(|event| match event {
                    Event::Draw(draw) => slow.draw(draw) != model.draw(draw),
                    _ => false,
                });
                assert!(differs, "{}", path.display());
            }
        }
    }
}

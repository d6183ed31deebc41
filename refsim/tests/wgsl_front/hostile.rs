//! Tests shaders with parts removed, doubled and exchanged.

use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};
use refsim::device::Profile;
use refsim::front::translate_wgsl;

use super::texts::EXAMPLES;

/// Words and punctuation marks of a text.
fn pieces(text: &str) -> Vec<&str> {
    text.split_inclusive(|c: char| !c.is_alphanumeric() && c != '_').collect()
}

/// The front end recurses for each term of an expression.
pub(crate) fn long_expressions_have_an_end() {
    let terms = vec!["uv.x"; 40_000].join("-");
    let text = format!("@fragment fn main(@location(0) uv: vec2f) -> @location(0) vec4f {{ return vec4f({terms}); }}");
    assert!(translate_wgsl(&text).is_err(), "no program is as long");
}

pub(crate) fn mutated_shaders_do_not_panic() {
    let profile = Profile::named("ideal-fp32").expect("an ideal device");
    let change = (any::<prop::sample::Index>(), any::<prop::sample::Index>(), 0_u8..4);
    let strategy = (0..EXAMPLES.len(), prop::collection::vec(change, 1..4));
    let mut runner = TestRunner::new(Config { cases: 300, failure_persistence: None, ..Config::default() });
    let outcome = runner.run(&strategy, |(example, changes)| {
        let mut text = pieces(EXAMPLES[example].1);
        for (at, other, how) in changes {
            let (at, other) = (at.index(text.len()), other.index(text.len()));
            match how {
                0 => drop(text.remove(at)),
                1 => text.insert(at, text[other]),
                2 => text[at] = text[other],
                _ => text.swap(at, other),
            }
        }
        if let Ok(program) = translate_wgsl(&text.concat()) {
            prop_assert!(refsim::check::check(program, &profile).is_ok());
        }
        Ok(())
    });
    outcome.unwrap_or_else(|failure| panic!("{failure}"));
}

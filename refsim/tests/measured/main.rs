//! Measured values of real chips: draws the rows of `fixtures/measured` on the cards' profiles, on every executor, bit
//! by bit, under every hypothesis of each rule. Checks `docs/measured.md` and the counts of the profiles;
//! `INSTA_UPDATE=always cargo test -p refsim --test measured` writes the page.
//!
//! A topic is a file with a function `rules`, named in [`topics`].

#[path = "../common/adapter.rs"]
mod adapter;
mod blending;
mod colors;
mod combiners;
mod coverage;
mod depth;
mod draws;
#[path = "../common/environment.rs"]
mod environment;
mod filters;
mod iterated;
mod page;
mod pictures;
mod rule;
#[path = "../common/running.rs"]
mod running;
mod table;
mod texels;
mod values;

use rule::Rule;

/// The siblings of NV2A. The hypotheses are tried on the first.
const CARDS: [&str; 2] = ["nv20", "nv25"];

/// Rules of all topics, in the order of the page.
fn topics() -> Vec<Rule> {
    [
        coverage::rules(),
        depth::rules(),
        colors::rules(),
        blending::rules(),
        combiners::rules(),
        texels::rules(),
        filters::rules(),
    ]
    .concat()
}

fn main() -> std::process::ExitCode {
    #[cfg_attr(not(feature = "wgpu"), expect(unused_mut, reason = "adapters add to them"))]
    let mut trials = adapter::trials![on_host: page::the_page_has_the_counts];
    #[cfg(feature = "wgpu")]
    trials.extend(adapter::trials![on_adapter: rule::an_adapter_draws_what_the_host_draws]);
    adapter::run(trials)
}

//! Tests of modelled time: the cache, the pipeline model, the command queue, and laws of all of them.

mod cache;
mod laws;
mod model;
mod queue;
#[path = "../common/running.rs"]
mod running;
mod units;

use refsim::event::{DrawRecord, Event};

fn only_draw(log: &[Event]) -> &DrawRecord {
    log.iter().find_map(|e| if let Event::Draw(draw) = e { Some(&**draw) } else { None }).expect("one draw")
}

//! Random numbers for built scenes, in sequence: for positions and angles only.

use crate::geom::random::CounterRng;

/// Seed of all scenes.
pub const SEED: u64 = 2002;

/// Random number generator with the seed [`SEED`]; its numbers depend on the order of calls.
pub(super) struct SceneRng {
    random: CounterRng,
    drawn: u64,
}

impl Default for SceneRng {
    fn default() -> Self {
        Self { random: CounterRng::new(SEED), drawn: 0 }
    }
}

impl SceneRng {
    /// Returns a number in [`low`, `high`).
    pub(super) fn between(&mut self, low: f64, high: f64) -> f64 {
        self.drawn += 1;
        low + (high - low) * self.random.unit(self.drawn, 0, 0)
    }

    /// Chooses one of several items.
    pub(super) fn one_of<T: Copy>(&mut self, things: &[T]) -> T {
        let place = self.between(0.0, things.len() as f64) as usize;
        things[place.min(things.len() - 1)]
    }
}

//! Host cost of commands, and limits of the queue.

use crate::device::{Confidence, FigureRow};

macro_rules! queue_figures {
    ($($(#[$doc:meta])* $field:ident = $value:literal $unit:literal $source:literal;)*) => {
        /// Host cost of commands, and limits of the queue between host and card. No source publishes these, so every
        /// figure is a guess; `crossbar timeline --sensitivity` shows the effect of each.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub struct QueueFigures {
            $($(#[$doc])* pub $field: u64,)*
        }

        impl Default for QueueFigures {
            fn default() -> Self {
                Self { $($field: $value,)* }
            }
        }

        impl QueueFigures {
            /// The figures with source and confidence; keys start with `queue.`.
            pub fn rows(&self) -> Vec<FigureRow> {
                vec![$(row(stringify!($field), self.$field, $unit, $source),)*]
            }

            /// Mutable access to the figure with this key; `None` if there is no such key.
            pub fn figure_mut(&mut self, key: &str) -> Option<&mut u64> {
                match key.strip_prefix("queue.")? {
                    $(stringify!($field) => Some(&mut self.$field),)*
                    _ => None,
                }
            }
        }
    };
}

queue_figures! {
    /// Host time to start an upload, without the transfer, in picoseconds.
    upload_ps = 2_000_000 "ps" "no source was found; a driver call with an address check on a processor of 2002";
    /// Host time to change state, in picoseconds.
    state_ps = 200_000 "ps" "no source was found; a few hundred clocks of a processor of 2002";
    /// Host time per constant of four numbers, in picoseconds.
    constant_ps = 20_000 "ps" "no source was found; 16 bytes written to a command buffer, with the driver's share";
    /// Host time to submit a clear, in picoseconds.
    clear_ps = 500_000 "ps" "no source was found";
    /// Host time to submit a draw, in picoseconds.
    draw_ps = 1_000_000 "ps" "no source was found; about a million draws a second without other work";
    /// Host time to submit a read-back, without the transfer, in picoseconds.
    read_back_ps = 2_000_000 "ps" "no source was found; assumed equal to an upload";
    /// Host time to start waiting for a fence, in picoseconds.
    finish_fence_ps = 200_000 "ps" "no source was found; assumed equal to a change of state";
    /// Commands that the queue holds before the host has to wait; at least 1.
    commands = 256 "command" "no source was found; a command buffer of a few KiB";
    /// Number of draws by which the front end may be ahead of the draw in the pixel pipelines.
    draws_ahead = 4 "draw" "no source was found; set-up keeps some primitives ready";
}

impl QueueFigures {
    /// The figures with zero host cost of commands.
    #[must_use]
    pub fn without_overhead(self) -> Self {
        Self {
            upload_ps: 0,
            state_ps: 0,
            constant_ps: 0,
            clear_ps: 0,
            draw_ps: 0,
            read_back_ps: 0,
            finish_fence_ps: 0,
            ..self
        }
    }
}

fn row(field: &str, value: u64, unit: &str, source: &str) -> FigureRow {
    FigureRow {
        key: format!("queue.{field}"),
        value: value.to_string(),
        unit: unit.to_owned(),
        source: source.to_owned(),
        confidence: Confidence::Guess,
        counts: None,
    }
}
